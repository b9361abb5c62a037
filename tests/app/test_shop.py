"""Setup sheets and tool tables from the command line and from their screens."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.files import load, save
from app.documents.lock import Lock, release, take
from app.documents.programs import example
from app.painted.screens.ask import Ask
from app.painted.screens.import_tools import FaultsPage
from app.painted.screens.program import ProgramPage
from app.painted.screens.tools import ToolsPage
from core.program.model import Number, Tool
from tests.app.kept import ELSEWHERE
from tests.app.operator import Operator


@pytest.fixture
def part(tmp_path: Path) -> Path:
    save(load(example("pocket")), tmp_path / "pocket.toml")
    return tmp_path / "pocket.toml"


def test_a_sheet_on_standard_output_is_text(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sheet", str(part)]) == 0
    out = capsys.readouterr().out
    assert out.startswith("SETUP SHEET\n")
    assert "PROGRAM            pocket\n" in out


def test_a_sheet_with_the_drawing_and_one_that_says_do_not_run(part: Path) -> None:
    assert main(["sheet", str(part), "-o", str(part.with_suffix(".html"))]) == 0
    assert "<svg" in part.with_suffix(".html").read_text()
    assert main(["sheet", str(example("notch")), "-o", str(part.with_suffix(".txt"))]) == 1
    assert "DO NOT RUN" in part.with_suffix(".txt").read_text()


def test_what_cannot_be_read_or_written(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sheet", "none.toml"]) == 2
    assert main(["sheet", str(part), "-o", str(part / "x.txt")]) == 2
    assert main(["tools", str(part), "--import", "none.tbl"]) == 2
    assert capsys.readouterr().err.count("cutcomp: ") == 3


def test_an_import_that_is_whole(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = part.with_name("tool.tbl")
    table.write_text("T7 P1 D12.7 ;BALL\nT8\n")
    assert main(["tools", str(part), "--import", str(table), "--units", "mm"]) == 0
    assert load(part).tools[-2:] == (Tool(7, "BALL", Number(0.5)), Tool(8))
    said = capsys.readouterr()
    assert "line 2, column 1: warning: Tool 8 has no diameter" in said.err
    assert "T7          0.5000 IN  BALL\n" in said.out


def test_nothing_is_imported_into_a_program_that_somebody_has_open(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table, before = part.with_name("tool.tbl"), part.read_bytes()
    table.write_text("T7 P1 D.5\n")
    lock = take(part, ELSEWHERE)
    assert isinstance(lock, Lock)
    assert main(["tools", str(part), "--import", str(table)]) == 2
    assert "nothing was imported: bob on office has this program open since" in capsys.readouterr().err
    assert part.read_bytes() == before
    release(lock)
    assert main(["tools", str(part), "--import", str(table)]) == 0
    assert not lock.path.exists()


def test_an_import_with_a_fault_changes_nothing(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, before = part.with_name("tool.tbl"), part.read_bytes()
    table.write_text("T7 D.5\nT8 D,5\n")
    assert main(["tools", str(part), "--import", str(table)]) == 2
    assert part.read_bytes() == before
    assert "line 2, column 4: D,5 is not a word" in capsys.readouterr().err


def test_what_is_no_tool_table_is_told_alike_in_a_few_lines(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    program, before = part.with_name("a.nc"), part.read_bytes()
    program.write_text("G1 X1.\n" * 75 + "M2\n")
    assert main(["check", str(program), "--control", "linuxcnc", "--tools", str(program)]) == 2
    checked = capsys.readouterr()
    assert main(["tools", str(part), "--import", str(program)]) == 2
    imported = capsys.readouterr()
    assert (checked.out, imported.out, part.read_bytes()) == ("", "", before)
    assert checked.err + "cutcomp: nothing was imported.\n" == imported.err
    first, *_, last = checked.err.splitlines()
    assert first == f"cutcomp: {program}, line 1, column 1: G is not a word of a tool table; write T1 P1 D.25 Z0."
    assert (len(checked.err.splitlines()), last) == (4, f"{program}: 73 more faults.")


def test_the_faults_of_a_table_are_told_before_its_warnings(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = part.with_name("tool.tbl")
    table.write_text("T1\nT2\nT3\nT4\nT7 D,5\n")
    assert main(["tools", str(part), "--import", str(table)]) == 2
    assert "D,5 is not a word" in capsys.readouterr().err


def importing(text: str, folder: Path) -> Operator:
    """An operator who has typed a table's name on TOOL SETUP."""
    (folder / "my.tbl").write_text(text)
    return Operator.at().press("f6", "f3", *str(folder / "my.tbl"), "enter")


def test_the_screen_asks_before_it_imports_and_undo_takes_it_back(tmp_path: Path) -> None:
    operator = importing("T1 D.375\nT2 D.25 ;DRILL", tmp_path)
    assert isinstance(operator.desk.page, Ask)
    assert "Tools: 2. New: 1. In place of one that differs: 1." in operator.part("body")
    assert "T1 0.5000 IN END MILL becomes 0.3750 IN" in " ".join(operator.part("body").split())
    operator.press("escape")
    assert operator.session.program.tools == (Tool(1, "END MILL", Number(0.5)),)
    operator.press("enter", "i")
    assert list(operator.session.program.tools) == [Tool(1, "END MILL", Number(0.375)), Tool(2, "DRILL", Number(0.25))]
    assert isinstance(operator.desk.page, ToolsPage)
    assert operator.said.startswith("Imported: ")
    assert operator.press("ctrl+z").session.program.tools == (Tool(1, "END MILL", Number(0.5)),)


def test_the_screen_shows_every_fault_and_imports_nothing(tmp_path: Path) -> None:
    operator = importing("T1 D.375\nT2 D\x1b[2J", tmp_path)
    assert isinstance(operator.desk.page, FaultsPage)
    assert "line 2, column 4" in operator.part("body")
    assert all(line.isprintable() for line in operator.screen())
    assert operator.session.program.tools == (Tool(1, "END MILL", Number(0.5)),)


def test_a_table_in_the_other_unit(tmp_path: Path) -> None:
    operator = importing("T2 D12.7", tmp_path)
    operator.press("escape", "down")
    assert "in MM" in operator.part("body")
    operator.press("enter", "i")
    assert operator.session.program.tools[1].diameter == Number(0.5)


def test_the_sheet_from_the_program_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = Operator.at(load(example("pocket"))).press("f8", "f7", "f7", "f2")
    assert "part.html" in operator.part("body")
    operator.press("down", "enter")
    assert Path("part.txt").read_text().startswith("SETUP SHEET")
    assert isinstance(operator.desk.page, ProgramPage)
    operator.press("f7", "f7", "f2", "f1")
    assert "<svg" in Path("part.html").read_text()
    Path("part.html").write_text("mine")
    operator.press("f7", "f7", "f2", "enter")
    assert isinstance(operator.desk.page, Ask)
    operator.press("escape")
    assert Path("part.html").read_text() == "mine"
    operator.press("enter", "r")
    assert "<svg" in Path("part.html").read_text()


@pytest.mark.parametrize("keys", [("f7", "f7", "f2"), ("f6",)])
def test_neither_sheet_nor_nc_file_takes_the_place_of_a_program(part: Path, keys: tuple[str, ...]) -> None:
    before = part.read_text()
    operator = Operator.at(load(part)).press("f8", *keys)
    operator.press("delete", *part.name, "enter")
    assert "is a program and would be overwritten" in operator.said
    operator.press("r")
    assert part.read_text() == before
