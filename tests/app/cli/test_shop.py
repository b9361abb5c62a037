"""Setup sheets and tool tables from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.__main__ import main
from app.documents.files import load, save
from app.documents.lock import Lock, Owner, release, take
from app.documents.programs import example
from core.program.model import Number, Tool


@pytest.fixture
def part(tmp_path: Path) -> Path:
    save(load(example("pocket")), tmp_path / "pocket.toml")
    return tmp_path / "pocket.toml"


def test_a_sheet_on_standard_output_is_text(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sheet", str(part)]) == 0
    out = capsys.readouterr().out
    assert out.startswith("SETUP SHEET\n")
    assert "PROGRAM            pocket\n" in out


def test_an_html_sheet_has_a_drawing_and_a_gouged_one_says_do_not_run(part: Path) -> None:
    assert main(["sheet", str(part), "-o", str(part.with_suffix(".html"))]) == 0
    assert "<svg" in part.with_suffix(".html").read_text()
    assert main(["sheet", str(example("notch")), "-o", str(part.with_suffix(".txt"))]) == 1
    assert "DO NOT RUN" in part.with_suffix(".txt").read_text()


def test_two_diameters_of_tool_0_are_refused(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(part), "--control", "linuxcnc", "--tool", "0=.5", "--tool", "0=.6"]) == 2
    assert "tool 0 has two diameters" in capsys.readouterr().err


def test_unreadable_and_unwritable_files_are_one_sentence_each(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sheet", "none.toml"]) == 2
    assert main(["sheet", str(part), "-o", str(part / "x.txt")]) == 2
    assert main(["tools", str(part), "--import", "none.tbl"]) == 2
    assert capsys.readouterr().err.count("cutcomp: ") == 3


def test_an_import_adds_the_tools_of_a_table(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = part.with_name("tool.tbl")
    table.write_text("T7 P1 D12.7 ;BALL\nT8\n")
    assert main(["tools", str(part), "--import", str(table), "--units", "mm"]) == 0
    assert load(part).tools[-2:] == (Tool(7, "BALL", Number(0.5)), Tool(8))
    output = capsys.readouterr()
    assert "line 2, column 1: warning: Tool 8 has no diameter" in output.err
    assert "T7          0.5000 IN  BALL\n" in output.out


def test_nothing_is_imported_into_a_program_open_elsewhere(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, before = part.with_name("tool.tbl"), part.read_bytes()
    table.write_text("T7 P1 D.5\n")
    # a process of another host may be alive
    lock = take(part, Owner("bob", "office", 7, "", "2025-03-04T05:00:00+01:00"))
    assert isinstance(lock, Lock)
    assert main(["tools", str(part), "--import", str(table)]) == 2
    assert "nothing was imported: bob on office has had this program open since" in capsys.readouterr().err
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


def test_check_and_tools_report_an_invalid_tool_table_alike_in_a_few_lines(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
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


def test_faults_of_a_table_are_reported_even_after_many_warnings(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = part.with_name("tool.tbl")
    table.write_text("T1\nT2\nT3\nT4\nT7 D,5\n")
    assert main(["tools", str(part), "--import", str(table)]) == 2
    assert "D,5 is not a word" in capsys.readouterr().err
