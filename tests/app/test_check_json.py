"""`check --json`: one shape for every request, with a state for every outcome of a program."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.cli.check import check

GROOVE = "G21 G17 G90 G1 F100\nX-20 Y0\nG41 D1 X0\nX50\nY-20\nX58\nY0\nX100\nG40 X120\nM30\n"
SLANTING = "G21 G17 G90 G1 F100\nX-20 Y0\nG41 D1 X0\nX50\nM8\nM9\nY40\nX20\nG40 X0\nM30\n"


def results(
    capsys: pytest.CaptureFixture[str], folder: Path, text: str, control: str
) -> list[dict[str, object]]:  # fmt: skip
    file = folder / "program.nc"
    file.write_text(text)
    check([str(file), "--control", control, "--tool", "1=10", "--units", "MM", "--json"])
    answer = json.loads(capsys.readouterr().out)
    assert answer["version"] == 1
    return list(answer["results"])


@pytest.mark.parametrize(
    ("text", "control", "state"),
    [
        ("G21 G90 G0 X10.\nM30\n", "fanuc", "clean"),
        (GROOVE, "fanuc", "alarm"),
        (SLANTING, "fanuc", "gouges"),
        ("G21 G90 G1 F9\nG41 X5.\nX9.\nM30\n", "fanuc", "uncompensated"),
        ("N1 GOTO1\n", "fanuc", "not_followed"),
        ("", "fanuc", "empty"),
        ("O1 (NO MOVES)\nG21\nM30\n", "fanuc", "empty"),
    ],
)
def test_the_state_names_the_outcome_of_a_program(
    text: str, control: str, state: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (result,) = results(capsys, tmp_path, text, control)
    assert result["state"] == state


def test_a_gouge_has_its_depth_and_line_in_program_units(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (result,) = results(capsys, tmp_path, SLANTING, "fanuc:a")
    # the path slants from (50, 5) to (45, 35) beside the wall at x = 50, which it should stay 5 away from
    assert result["deepest_gouge"] == {"depth": pytest.approx(5.0, abs=0.1), "line": 4}


def test_results_of_all_controls_have_one_shape_and_say_where_they_differ(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    answers = results(capsys, tmp_path, SLANTING, "all")
    assert len({tuple(sorted(result)) for result in answers}) == 1
    by_name = {result["control"]: result for result in answers}
    assert {"fanuc:a", "fanuc:b", "haas:a", "allen-bradley:a", "heidenhain", "three-block"} <= by_name.keys()
    parting = by_name["fanuc:a"]["parts_from"]
    assert isinstance(parting, dict)
    assert set(parting) == {"control", "line", "farthest_line", "distance"}


def test_the_result_of_an_unreadable_file_has_the_same_shape(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (readable,) = results(capsys, tmp_path, GROOVE, "fanuc")
    assert check([str(tmp_path / "none.nc"), "--control", "fanuc", "--json"]) == 2
    (result,) = json.loads(capsys.readouterr().out)["results"]
    assert set(result) == set(readable)
    assert (result["state"], result["control"]) == ("unreadable", None)


def test_moves_of_a_called_file_have_the_line_of_the_call(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "O3001.nc").write_text("%\nO3001\nG1 X#1 F9.\nG1 Y#2 Z[1/0]\nM99\n%\n")
    (result,) = results(capsys, tmp_path, "O1\nG21 G90\nG65 P3001 A5. B7.\nM30\n", "fanuc")
    moves, findings = result["moves"], result["findings"]
    assert isinstance(moves, list)
    assert isinstance(findings, list)
    assert [(move["line"], move["x"]) for move in moves] == [(0, 0.0), (3, 5.0)]
    (alarm,) = (finding for finding in findings if finding["severity"] == "error")
    assert (alarm["rule"], alarm["line"]) == ("PS0112", 3)
    assert alarm["text"].startswith("O3001.nc line 4: ")
