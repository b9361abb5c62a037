"""The commands without a screen: pipes, full disks, and messages on standard error."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.programs import example

FULL = Path("/dev/full")


def piped(monkeypatch: pytest.MonkeyPatch, data: bytes) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))


def test_a_program_is_read_from_a_pipe(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    piped(monkeypatch, example("pocket").read_bytes())
    assert main(["path", "-", "--json"]) == 0
    piped_result = json.loads(capsys.readouterr().out)
    assert main(["path", str(example("pocket")), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == piped_result


def test_the_version_is_the_package_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert (main(["--version"]), capsys.readouterr().out) == (0, f"cutcomp {version('cutcomp')}\n")


def test_a_program_posted_from_a_pipe_has_a_name(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    piped(monkeypatch, example("pocket").read_bytes())
    assert main(["post", "-"]) == 0
    assert capsys.readouterr().out.startswith("(PROGRAM standard input)\n")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"format = ", "standard input, line 1"),
        (b"a\n\xff", "standard input, line 2: this is not UTF-8 text."),
        (b" " * 4_000_001, "standard input cannot be read: "),
    ],
)
def test_unusable_input_from_a_pipe_is_called_standard_input(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], data: bytes, words: str
) -> None:
    piped(monkeypatch, data)
    assert main(["path", "-"]) == 2
    assert capsys.readouterr().err.startswith(f"cutcomp: {words}")


@pytest.mark.parametrize("name", ["p.png", "p.PDF", "p.svgz", "p.svg.jpeg"])
def test_plot_refuses_other_picture_suffixes(capsys: pytest.CaptureFixture[str], tmp_path: Path, name: str) -> None:
    assert main(["plot", str(example("flange")), "-o", str(tmp_path / name)]) == 2
    output = capsys.readouterr()
    assert (output.out, list(tmp_path.iterdir())) == ("", [])
    message = "plot writes SVG and DXF; name a file that ends in .svg or .dxf."
    assert output.err == f"cutcomp: -o {tmp_path / name}: {message}\n"


@pytest.mark.parametrize("name", ["p.svg", "P.SVG", "drawing", "p.xml"])
def test_plot_writes_svg_unless_another_picture_suffix_is_given(tmp_path: Path, name: str) -> None:
    assert main(["plot", str(example("flange")), "-o", str(tmp_path / name)]) == 0
    assert "<svg" in (tmp_path / name).read_text()


@pytest.mark.parametrize(
    ("name", "what"), [("a.NC", "an NC program"), ("a.h", "an NC program"), ("a.dxf", "a drawing")]
)
def test_another_kind_of_file_is_named_in_the_refusal(tmp_path, capsys, name, what):
    (tmp_path / name).write_text("%\nM30\n")
    assert main(["post", str(tmp_path / name)]) == 2
    assert f"{name} is {what}, not a contour program. cutcomp " in capsys.readouterr().err


@pytest.mark.parametrize("command", ["post", "plot", "sheet"])
def test_a_dash_means_standard_output(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path, command: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([command, str(example("flange")), "-o", "-"]) == 0
    assert len(capsys.readouterr().out) > 100
    assert list(tmp_path.iterdir()) == []


SQUARE_NC = Path(__file__).parents[1] / "data" / "nc" / "rosettacnc-square.ngc"


@pytest.mark.skipif(not FULL.exists(), reason="there is no device that is always full")
@pytest.mark.parametrize(
    "words",
    [
        ("sheet", str(example("flange"))),
        ("tools", str(example("flange"))),
        ("check", str(SQUARE_NC), "--control", "rosettacnc:easy", "--tool", "1=6"),
    ],
)
def test_a_full_standard_output_is_reported_without_an_error_number(words: tuple[str, ...]) -> None:
    with FULL.open("w") as full:
        result = subprocess.run([sys.executable, "-m", "app", *words], stdout=full, stderr=subprocess.PIPE, text=True)
    assert result.returncode == 2
    assert "Errno" not in result.stderr
    assert "standard output cannot be written: the disk is full." in result.stderr


@pytest.mark.parametrize("words", [("path",), ("check", "--control", "linuxcnc"), ("sheet",), ("tools",)])
def test_a_too_long_name_is_reported_without_an_error_number(words: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "app", words[0], "n" * 300, *words[1:]]
    result = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert result.returncode == 2
    assert "the name is too long. Choose a shorter one." in result.stderr
    assert "Errno" not in result.stderr + result.stdout


@pytest.mark.skipif(not FULL.exists(), reason="there is no device that is always full")
@pytest.mark.parametrize("words", [("path",), ("path", "--json"), ("lookahead",), ("lookahead", "--json"), ("post",)])
def test_a_full_standard_output_is_reported_in_one_sentence(words: tuple[str, ...]) -> None:
    command, *rest = words
    full_command = [sys.executable, "-m", "app", command, str(example("flange")), *rest]
    with FULL.open("w") as full:
        result = subprocess.run(full_command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert result.returncode == 2
    assert (
        result.stderr == "cutcomp: standard output cannot be written: the disk is full. Make room or save elsewhere.\n"
    )


def test_a_finding_names_its_segment(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["path", str(example("notch"))]) == 1
    err = capsys.readouterr().err
    assert "cutcomp: block 1, segment 4: error: GOUGE 0.2500 deep in segment 4" in err
    assert "cutcomp: block 1, corner 3-4: warning: Corner too tight for the tool" in err


CORNERED = """
format = 1
units = "MM"
[[tool]]
number = 1
type = "END MILL"
diameter = 3.0
[[block]]
kind = "MILL CONTOUR"
tool = 1
cutter_comp = "LEFT"
x_start = 0.0
y_start = 0.0
z_bottom = -1.0
plunge_feed = 20.0
speed = 300
"""


def cornered(*ends: tuple[float, float]) -> bytes:
    """An inside contour of lines from (0, 0), in program text."""
    segments = (f'[[block.segment]]\nkind = "LINE"\nx_end = {x}\ny_end = {y}\nfeed = 10.0\n' for x, y in ends)
    return (CORNERED + "".join(segments)).encode()


SQUARE = cornered((20, 0), (20, 20), (0, 20), (0, 0))


def test_the_look_ahead_table_says_what_the_contour_needs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    piped(monkeypatch, SQUARE)
    assert main(["lookahead", "-"]) == 1
    lines = capsys.readouterr().out.splitlines()
    advice = lines[lines.index("  No value is clean.") + 1 :]
    assert "START is in an inside corner" in advice[0]
    assert advice[1].startswith("  Start in the middle of segment 1, at X 10.000 Y 0.000: look-ahead ")


def test_the_look_ahead_json_says_what_the_contour_needs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    piped(monkeypatch, SQUARE)
    assert main(["lookahead", "-", "--json"]) == 1
    (block,) = json.loads(capsys.readouterr().out)["blocks"]
    assert [need["code"] for need in block["needs"]] == ["CAL_NOT_CLEAN", "START_MID_SIDE"]
    assert (block["needs"][1]["x"], block["needs"][1]["y"]) == (10.0, 0.0)
    assert main(["lookahead", str(example("pocket")), "--json"]) == 0
    assert [need["needs"] for need in json.loads(capsys.readouterr().out)["blocks"]] == [[]]


@pytest.mark.parametrize("command", ["path", "lookahead"])
def test_a_contour_of_zero_length_is_an_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], command: str
) -> None:
    piped(monkeypatch, cornered((0, 0), (0, 0)))
    assert main([command, "-"]) == 1
    assert "block 1, segment 1: error: No segment has a length: " in capsys.readouterr().err


def undetermined() -> bytes:
    """A line, and an arc whose center is its start."""
    at = "x_end = 20\ny_end = 0\nx_center = 20\ny_center = 0\n"
    point = f'[[block.segment]]\nkind = "ARC"\ndirection = "CW"\n{at}feed = 10.0\n'
    return cornered((20, 0)) + point.encode()


def test_the_look_ahead_table_explains_why_the_rest_of_a_contour_is_left_out(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    piped(monkeypatch, undetermined())
    assert main(["lookahead", "-"]) == 1
    assert (
        "cutcomp: block 1, segment 2: error: X CENTER and Y CENTER are the same as the start" in capsys.readouterr().err
    )


def test_the_look_ahead_json_explains_why_the_rest_of_a_contour_is_left_out(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    piped(monkeypatch, undetermined())
    assert main(["lookahead", "-", "--json"]) == 1
    (block,) = json.loads(capsys.readouterr().out)["blocks"]
    assert (2, "error") in {(finding["segment"], finding["severity"]) for finding in block["findings"]}


@pytest.mark.parametrize(("name", "blocks"), [("pocket", "1 block"), ("flange", "blocks 1 to 2")])
def test_a_missing_block_is_reported_with_the_existing_ones(
    name: str, blocks: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["path", str(example(name)), "--block", "3"]) == 2
    assert capsys.readouterr().err == f"cutcomp: --block 3: {example(name)} has {blocks}.\n"
