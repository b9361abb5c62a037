"""`cutcomp import`: what it lists, takes, asks and refuses, and its exit status."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from argparse import Namespace
from collections.abc import Callable
from dataclasses import replace
from multiprocessing import active_children
from pathlib import Path

import pytest

from app.__main__ import main
from app.cli.drawing_list import list_drawing
from app.cli.screens import begin
from app.documents.document_service import DocumentService, Trouble
from app.documents.drawing_files import Worker, drawing_bytes, read_and_list
from app.documents.files import load
from app.documents.programs import example
from core.importing.contours import ContourList, contours_of
from core.importing.drawing import DrawingError
from core.program.model import CutterComp
from core.program.solve.block import solve_block
from core.units import Unit
from tests.core.importing.drawings import dxf, square

DATA = Path(__file__).parents[1] / "data" / "dxf"


class InlineWorker:
    """Does a worker's work in this process: starting a process for each command would take most of the time."""

    def __init__(self, function: Callable[..., object], *arguments: object) -> None:
        self.function, self.arguments = function, arguments

    def result(self) -> object:
        return self.function(*self.arguments, progress=lambda *_: None)


@pytest.fixture(autouse=True)
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.cli.import_contours.Worker", InlineWorker)


def test_the_kind_of_each_chain_and_a_frame_around_them_are_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, out = tmp_path / "frame.dxf", tmp_path / "part.toml"
    source.write_bytes(dxf(*square(0, 0, 80), *square(5, 5, 40), *square(15, 15, 20)))
    assert main(["import", str(source), "--chain", "2,3", "-o", str(out)]) == 0
    told = capsys.readouterr().err
    assert "Chain 1 around chains 2, 3 is not taken. If it is only a frame, reverse them." in told
    assert "chain 2: HOLE, 5 segments from" in told
    assert "chain 3: ISLAND, 5 segments from" in told


def test_the_list_has_a_row_for_each_contour(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(DATA / "d14-layers.dxf"), "--list"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert rows[0] == "MM ($INSUNITS), layers 0, HOLES"
    assert rows[2].split() == ["1", "OUTSIDE", "0", "4", "140.000", "40.000", "x", "30.000"]
    assert rows[3].split() == ["2", "HOLE", "HOLES", "4", "100.000", "30.000", "x", "20.000"]


def test_contours_become_blocks_that_close_on_their_start(tmp_path: Path) -> None:
    out = tmp_path / "part.toml"
    assert main(["import", str(DATA / "d14-layers.dxf"), "--chain", "all", "-o", str(out)]) == 0
    assert out.read_text().splitlines()[1] == "# from d14-layers.dxf, layers 0, HOLES"
    program = load(out)
    assert [block.cutter_comp for block in program.blocks] == [CutterComp.LEFT, CutterComp.LEFT]
    for block in program.blocks:
        solved = solve_block(block, program)
        assert solved.closed
        assert len(solved.pieces) == 5


def test_one_of_several_contours_must_be_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = str(DATA / "d14-layers.dxf"), tmp_path / "part.toml"
    assert main(["import", source, "-o", str(out)]) == 2
    assert "The drawing has 2 chains: add --chain N" in capsys.readouterr().err
    assert not out.exists()
    assert main(["import", source, "--chain", "2", "-o", str(out)]) == 0
    assert len(load(out).blocks) == 1
    assert main(["import", source, "--chain", "3", "-o", str(out)]) == 2
    assert main(["import", source, "--layer", "HOLES", "-o", str(out)]) == 0
    assert main(["import", source, "--layer", "NONE", "-o", str(out)]) == 2


def test_a_line_that_is_not_flat_is_deleted_or_left_out_by_its_layer(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, ends = tmp_path / "slope.dxf", "10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n9\n"
    source.write_text(f"0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n{ends}0\nENDSEC\n0\nEOF\n", encoding="ascii")
    assert main(["import", str(source), "--list", "--units", "mm"]) == 2
    remedy = "does not lie in the XY plane. Delete it from the drawing, or name the layers to take with --layer."
    assert remedy in capsys.readouterr().err


def test_a_drawing_without_a_unit_needs_the_units_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = str(DATA / "d04-nounits.dxf"), tmp_path / "part.toml"
    assert main(["import", source, "-o", str(out)]) == 2
    assert "as IN 40.0000 x 30.0000, as MM 40.000 x 30.000: add --units in or --units mm." in capsys.readouterr().err
    assert main(["import", source, "--units", "in", "-o", str(out)]) == 0
    assert load(out).unit is Unit.IN


def test_start_and_reverse_change_the_block(tmp_path: Path) -> None:
    out = tmp_path / "part.toml"
    arguments = ["import", str(DATA / "d01-square.dxf"), "--start", "40,10", "--reverse", "-o", str(out)]
    assert main(arguments) == 0
    block = load(out).blocks[0]
    assert (block.x_start.value, block.y_start.value) == (40.0, 10.0)
    assert block.cutter_comp is CutterComp.RIGHT


def test_a_truncated_file_is_taken_only_with_the_damaged_option(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, out = str(DATA / "d19-cut-off.dxf"), tmp_path / "part.toml"
    assert main(["import", source, "-o", str(out)]) == 2
    assert "This file breaks off at line 40: 1 entity could be read." in capsys.readouterr().err
    assert main(["import", source, "--damaged", "-o", str(out)]) == 0
    assert "what comes after it is missing" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("d20-not-dxf.dxf", "d20-not-dxf.dxf is not a DXF file."),
        ("d17-empty.dxf", "1 TEXT was skipped"),
        ("gone.dxf", "gone.dxf cannot be read: there is no such file or folder."),
    ],
)
def test_an_unreadable_drawing_is_refused_in_a_sentence(
    name: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["import", str(DATA / name), "--list"]) == 2
    assert words in capsys.readouterr().err


def wait_for_ever(*, progress: object) -> int:
    while progress:
        pass
    return 0


def test_a_worker_ends_at_its_limit_and_can_be_canceled() -> None:
    with pytest.raises(DrawingError, match="takes longer than"):
        Worker(wait_for_ever, limit=0.5).result()
    assert active_children() == []
    worker = Worker(wait_for_ever)
    assert worker.poll() is None
    assert len(active_children()) == 1
    worker.cancel()
    assert active_children() == []


def fail(*, progress: object) -> int:
    raise ValueError(progress)


def die(*, progress: object) -> int:
    os.kill(os.getpid(), signal.SIGKILL)
    return wait_for_ever(progress=progress)


def test_only_a_killed_worker_may_have_lacked_memory() -> None:
    with pytest.raises(DrawingError, match="want of memory"):
        Worker(die).result()
    with pytest.raises(DrawingError, match="cutcomp has an error"):
        Worker(fail).result()


def test_an_nc_program_is_imported_as_the_contour_it_was_posted_from(tmp_path: Path) -> None:
    nc, out = tmp_path / "part.nc", tmp_path / "part.toml"
    assert main(["post", str(example("overrun-square")), "--control", "linuxcnc", "-o", str(nc)]) == 0
    assert main(["import", str(nc), "--control", "linuxcnc", "--tool", "1=.5", "-o", str(out)]) == 0
    original, imported = load(example("overrun-square")).blocks[0], load(out).blocks[0]
    ends = [(segment.x_end, segment.y_end) for segment in imported.segments]
    assert ends == [(segment.x_end, segment.y_end) for segment in original.segments]
    assert (imported.z_bottom, imported.cutter_comp, imported.speed) == (
        original.z_bottom,
        original.cutter_comp,
        original.speed,
    )


def test_the_missing_diameter_of_a_tool_names_the_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nc = tmp_path / "part.nc"
    assert main(["post", str(example("overrun-square")), "--control", "linuxcnc", "-o", str(nc)]) == 0
    assert main(["import", str(nc), "--control", "linuxcnc"]) == 2
    assert "On the command line: --tool 1=DIAMETER." in capsys.readouterr().err


def test_a_center_path_program_needs_side_and_diameter(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nc, out = tmp_path / "part.nc", tmp_path / "part.toml"
    assert main(["post", str(example("overrun-square")), "-o", str(nc)]) == 0
    command = ["import", str(nc), "--control", "linuxcnc", "--tool", "1=.5", "-o", str(out)]
    assert main(command) == 2
    assert "its side and the tool's diameter are needed" in capsys.readouterr().err
    assert main([*command, "--side", "right"]) == 2
    assert main([*command, "--side", "right", "--diameter", "0.5"]) == 0
    original, imported = load(example("overrun-square")).blocks[0], load(out).blocks[0]
    assert [segment.x_end for segment in imported.segments] == [segment.x_end for segment in original.segments]


def test_a_missing_nc_program_is_refused_and_not_created(tmp_path: Path) -> None:
    answer = begin(DocumentService(), tmp_path / "gone.nc", None)
    assert isinstance(answer, Trouble)
    assert answer.text.endswith("gone.nc: there is no such NC program.")
    assert not list(tmp_path.iterdir())


def test_a_missing_drawing_is_reported_before_the_screens_start(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(DATA / "gone.dxf")]) == 2
    assert "there is no such drawing" in capsys.readouterr().err


def test_a_screen_reads_and_lists_a_drawing_in_workers() -> None:
    path = DATA / "d14-layers.dxf"
    listed = Worker(read_and_list, drawing_bytes(path), path.name, None).result()
    assert isinstance(listed, ContourList)
    assert [contour.kind.value for contour in listed.contours] == ["OUTSIDE", "HOLE"]
    holes = replace(listed.options, layers=frozenset(("HOLES",)))
    assert len(Worker(contours_of, listed.drawing, holes).result().contours) == 1
    with pytest.raises(DrawingError) as error:
        Worker(read_and_list, drawing_bytes(DATA / "d19-cut-off.dxf"), "d19-cut-off.dxf", None).result()
    assert error.value.readable == 1


KILLED = """
import os, signal, time
from app.documents.drawing_files import Worker
from tests.app.test_import import wait_for_ever

if __name__ == "__main__":
    worker = Worker(wait_for_ever)
    print(worker._process.pid, flush=True)
    time.sleep(1.0)
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_worker_ends_when_its_program_is_killed(tmp_path: Path) -> None:
    script = tmp_path / "killed.py"
    script.write_text(KILLED)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    parent = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, env=environment, check=False)
    child = int(parent.stdout)
    for _ in range(500):
        if not running(child):
            break
        time.sleep(0.02)
    assert not running(child)


def running(pid: int) -> bool:
    """Whether a process still runs; a zombie does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize("option", [["--damaged"], ["--fit", "0"], ["--tolerance", "0"]])
def test_a_drawing_option_is_refused_for_an_nc_program(option: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "part.nc", "--control", "linuxcnc", *option]) == 2
    assert f"{option[0]} goes with a drawing only" in capsys.readouterr().err


@pytest.mark.parametrize("option", [["--side", "left"], ["--diameter", "6"], ["--tools", "t.tbl"], ["--tool", "1=6"]])
def test_an_nc_option_is_refused_for_a_drawing(option: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(DATA / "d14-layers.dxf"), *option]) == 2
    assert f"{option[0]} goes with an NC program only: add --control NAME." in capsys.readouterr().err


@pytest.mark.parametrize("option", [["--chain", "1"], ["--start", "0,0"], ["--reverse"], ["--output", "part.toml"]])
def test_an_option_that_takes_contours_is_refused_with_list(
    option: list[str], capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawing = (DATA / "d14-layers.dxf").resolve()
    monkeypatch.chdir(tmp_path)
    assert main(["import", str(drawing), "--list", *option]) == 2
    assert f"{option[0]} takes contours and --list takes none" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_fitting_arcs_within_0_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(DATA / "d14-layers.dxf"), "--list", "--fit", "0"]) == 2
    assert "--fit 0: type a length above 0, or leave --fit out." in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--tolerance", "--fit", "--diameter"])
@pytest.mark.parametrize("text", ["nan", "inf", "-1", "a"])
def test_an_unusable_length_is_refused(option: str, text: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["import", str(DATA / "d14-layers.dxf"), "--list", f"{option}={text}"])
    assert f"{option}: {text} is not a length of 0 or more" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["nan,0", "0,inf", "1", "1,2,3"])
def test_a_start_that_is_not_a_point_is_refused(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(DATA / "d14-layers.dxf"), "--chain", "1", "--start", text]) == 2
    assert f"--start {text}: type X,Y" in capsys.readouterr().err


def test_a_drawing_without_contours_writes_no_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.cli.import_contours.list_drawing", without_contours)
    out = tmp_path / "part.toml"
    assert main(["import", str(DATA / "d14-layers.dxf"), "-o", str(out)]) == 2
    assert "no contour" in capsys.readouterr().err
    assert not out.exists()


def without_contours(data: bytes, options: Namespace, *, progress: Callable[..., None]) -> ContourList:
    return replace(list_drawing(data, options, progress=progress), contours=())


def test_a_chosen_chain_of_an_nc_program_is_reported_by_its_number(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    nc, out = tmp_path / "two.nc", tmp_path / "part.toml"
    cuts = "".join(f"G0 X{x}. Y-1.\nG1 Z-.1 F5.\nG41 D1 X{x}. Y0\nX{x + 2}.\nY2.\nG40 X9.\nG0 Z1.\n" for x in (0, 4))
    nc.write_text(f"G20 G17 G90\nT1 M6\nS1000 M3\nG0 Z1.\n{cuts}M2\n")
    assert main(["import", str(nc), "--control", "linuxcnc", "--tool", "1=.5", "--chain", "2", "-o", str(out)]) == 0
    assert capsys.readouterr().err.startswith("cutcomp: chain 2: 2 segments.")
