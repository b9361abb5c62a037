"""`cutcomp check` on the command line: text, tables, JSON and whole folders."""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from subprocess import PIPE, Popen

import pytest

from app.cli.check import check
from app.documents.nc_library import called_program
from core.controls.control_names import display_name
from core.pipeline.checking import CheckRequest, answer_all

NC = Path(__file__).parents[1] / "data" / "nc"

MOVE_KEYS = {"type", "mode", "line", "x", "y", "z"}
RESULT_KEYS = {
    *("file", "control", "units", "state", "stopped_at", "deepest_gouge", "parts_from", "stretches", "moves"),
    "findings",
}
ARC_KEYS = {"cx", "cy", "cz", "plane", "ccw"}


def output(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> tuple[int, str, str]:
    status = check([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    return status, out, err


def test_json_is_one_object_in_program_units(capsys: pytest.CaptureFixture[str]) -> None:
    file = NC / "threeblock-square.nc"
    status, out, _ = output(capsys, file, "--control", "threeblock", "--tool", "1=.5", "--json")
    answer = json.loads(out)
    assert set(answer) == {"version", "results"}
    assert answer["version"] == 1
    (result,) = answer["results"]
    assert set(result) == RESULT_KEYS
    assert (result["control"], result["units"], result["stopped_at"]) == ("three-block", "IN", None)
    assert (result["file"], result["state"], result["parts_from"]) == (str(file), "gouges", None)
    assert status == (1 if any(finding["severity"] == "error" for finding in result["findings"]) else 0)
    first, second = result["moves"][0], result["moves"][1]
    assert (first["mode"], first["line"], first["x"], first["y"], first["z"]) == ("rapid", 0, 0, 0, 0)
    assert (second["x"], second["y"]) == pytest.approx((-1, 1))
    assert set(first) == MOVE_KEYS | {"feed"}
    assert first["feed"] is None
    arc = next(move for move in result["moves"] if move["type"] == "arc")
    assert set(arc) == MOVE_KEYS | ARC_KEYS | {"feed"}
    assert (arc["cx"], arc["cy"], arc["plane"], arc["ccw"]) == (pytest.approx(1.5), pytest.approx(0), "XY", False)
    keys = {"rule", "severity", "line", "column", "text", "lengths"}
    assert all(set(finding) == keys for finding in result["findings"])


@pytest.mark.parametrize(
    ("typed", "same"),
    [
        ("1=1/2", "1=.5"),
        ("1=1/2in", "1=.5in"),
        ('1=.5"', "1=.5in"),
        ("1=.5inch", "1=.5in"),
        ("1=12/2mm", "1=6mm"),
        ("1=(6mm)", "1=6mm"),
        ("1=6mm/1", "1=6mm"),
        ("1=6mm", "1=6"),
    ],
)
def test_a_diameter_may_be_an_expression_with_a_unit(typed: str, same: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The program is metric."""
    file = NC / "rosettacnc-square.ngc"
    result = output(capsys, file, "--control", "all", "--tool", typed)
    assert result == output(capsys, file, "--control", "all", "--tool", same)
    assert result != output(capsys, file, "--control", "all", "--tool", "1=7")


@pytest.mark.parametrize("typed", ["1", "1=", "=.5", "x=y", "1=1/0", "1=nan", "1=1e9"])
def test_an_unusable_tool_diameter_is_refused(typed: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = output(capsys, NC / "rosettacnc-square.ngc", "--control", "all", "--tool", typed)
    assert status == 2
    assert "write a tool and a diameter, as in 1=.5, 2=6mm or 3=1/2." in err


def test_two_diameters_of_one_tool_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    typed = ("--tool", "1=.5", "--tool", "2=.25", "--tool", "01=.4")
    status, _, err = output(capsys, NC / "rosettacnc-square.ngc", "--control", "all", *typed)
    assert (status, "tool 1 has two diameters" in err) == (2, True)


def test_an_alarm_has_line_column_and_rule(capsys: pytest.CaptureFixture[str]) -> None:
    file = NC / "rosettacnc-square.ngc"
    status, out, _ = output(capsys, file, "--control", "rosettacnc", "--tool", "1=6", "--json")
    (result,) = json.loads(out)["results"]
    assert (status, result["stopped_at"], result["state"]) == (1, 15, "alarm")
    (alarm,) = [finding for finding in result["findings"] if finding["severity"] == "error"]
    assert (alarm["rule"], alarm["line"]) == ("C6", 15)


def test_the_text_ends_with_the_outcome(capsys: pytest.CaptureFixture[str]) -> None:
    file = NC / "rosettacnc-square.ngc"
    status, out, _ = output(capsys, file, "--control", "rosettacnc:easy", "--tool", "1=6")
    assert status == 0
    assert out.splitlines()[-1] == "rosettacnc:easy: runs; 23 moves, 1 compensated stretch, MM."


def test_all_controls_are_compared_in_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = output(capsys, NC / "rosettacnc-square.ngc", "--control", "all", "--tool", "1=6")
    # the reasons follow the table; reversed, so that a table row wins over a reason of the same control
    rows = dict(line.split(maxsplit=1) for line in reversed(out.splitlines()))
    assert status == 1
    assert rows["rosettacnc:nist"] == "alarms at line 15 (C6)"
    assert rows["rosettacnc:easy"].strip() == "runs"
    assert "differs from rosettacnc:easy from line 14, by 3.075 at line 14" in rows["rosettacnc:normal"]
    assert rows["heidenhain"].split("  ", 1)[0] == "runs"
    assert "its contour only" in rows["heidenhain"]


def test_a_sentence_after_the_table_says_why_a_control_stops(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = output(capsys, NC / "rosettacnc-square.ngc", "--control", "all", "--tool", "1=6")
    reasons = [line for line in out.splitlines() if "line 15 (C6): " in line]
    assert reasons == [
        "rosettacnc:nist at line 15 (C6): An inside corner is an error with this entry. "
        "Round it in the program or use the normal entry."
    ]


def test_an_unknown_tool_is_reported_with_the_option_to_add(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "w.nc"
    file.write_text("G20 G90\nT3 M6\nG0 X0 Y0\nG1 F10.\nG41 D3 X1. Y0\nX3.\nY2.\nG40 X5. Y2.\nM2\n")
    _, out, _ = output(capsys, file, "--control", "all")
    rows = out.splitlines()
    advice = "No diameter of tool 3 is known: add --tool 3=0.5in with the real diameter, or --tools TABLE."
    assert rows[-1] == advice
    assert all(name in out for name in ("B5-TOOL", "C1", "(TOOL)"))
    assert advice not in output(capsys, file, "--control", "all", "--tool", "3=.5")[1]


def test_the_diameter_of_an_unknown_tool_is_quoted_from_a_comment(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "w.nc"
    file.write_text("G20 G90\n(TOOL 3 END MILL DIAMETER 0.5000)\nT3 M6\nG41 D3 G1 X1. Y0 F10.\nM2\n")
    rows = output(capsys, file, "--control", "all")[1].splitlines()
    assert rows[-1] == "The comment in line 2 says diameter 0.5000 for tool 3."


@pytest.mark.parametrize("text", ["G20 T3 M6\nG43 H3\nG0 X1.\nM2\n", "G20 G43 H3\nG0 X1.\nM2\n"])
def test_the_option_for_an_unknown_tool_follows_the_findings_of_one_control(
    text: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file, other, known = tmp_path / "w.nc", tmp_path / "other.tbl", tmp_path / "known.tbl"
    file.write_text(text)
    other.write_text("T2 D.5\n")
    known.write_text("T3 D.5\n")
    arguments = (file, "--control", "linuxcnc")
    advice = "No diameter of tool 3 is known: add --tool 3=0.5in with the real diameter, or --tools TABLE."
    assert output(capsys, *arguments)[1].splitlines()[-1] == advice
    assert output(capsys, *arguments, "--tools", other)[1].splitlines()[-1] == advice
    status, out, _ = output(capsys, *arguments, "--tools", known)
    assert (status, out.splitlines()[-1]) == (0, "linuxcnc: runs; 1 move, 0 compensated stretches, IN.")


def test_no_tool_option_is_advised_when_every_tool_is_known(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "w.nc"
    file.write_text("G20 T1 M6\nG0 X1.\nG43 H1.5\nM2\n")
    _, out, _ = output(capsys, file, "--control", "linuxcnc", "--tool", "1=.5")
    assert "has no tool of this number" in out
    assert "--tool" not in out


def test_every_control_that_lacks_a_size_names_the_tool() -> None:
    text = b"G20 G90\nT3 M6\nG0 X0 Y0\nG1 F10.\nG41 D3 X1. Y0\nX3.\nY2.\nG40 X5. Y2.\nM2\n"
    for answer in answer_all(text, CheckRequest("all", {}, shop=False, unit=None)):
        assert answer.missing == (None if answer.control == "klartext" else 3), answer.control


def test_compensation_with_radius_0_is_reported_as_nothing_compensated(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "w.nc"
    file.write_text("T1/.5/0.\nG0 X0 Y0\nG41 X1. Y0\nG1 X3. F10.\nY2.\nX1.\nG40 X1. Y3.\nM2\n")
    _, out, _ = output(capsys, file, "--control", "threeblock")
    assert out.splitlines()[-1].startswith("three-block: runs, nothing compensated; ")


def test_shop_rules_are_checked_only_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = (NC / "threeblock-square.nc", "--control", "threeblock", "--tool", "1=.5")
    assert " H4 " not in output(capsys, *arguments)[1]
    assert " H8 " in output(capsys, *arguments, "--shop")[1]


def test_a_folder_is_reported_with_one_line_per_file(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = output(capsys, NC, "--control", "nine-series:b", "--tool", "1=.5")
    lines = out.splitlines()
    files = len(list(NC.iterdir()))
    assert status == 1
    assert len(lines) == files + 1
    assert lines[-1].startswith(f"{files} files: ")


def test_json_results_of_several_files_have_their_names(capsys: pytest.CaptureFixture[str]) -> None:
    files = [NC / "threeblock-line.nc", NC / "threeblock-circle.nc"]
    answer = json.loads(output(capsys, *files, "--control", "threeblock", "--tool", "1=.5", "--json")[1])
    assert [result["file"] for result in answer["results"]] == [str(file) for file in files]


def test_json_lengths_follow_the_tool_table_and_the_units(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    table, file = tmp_path / "tool.tbl", tmp_path / "a.nc"
    table.write_text("T1 P1 D10 ;mill\n")
    file.write_text("G41 D1\nG1 X20 F100\nX40\nM2\n")
    arguments = (file, "--control", "linuxcnc", "--tools", table, "--json")
    (metric,) = json.loads(output(capsys, *arguments, "--units", "mm")[1])["results"]
    assert (metric["units"], metric["moves"][1]["y"]) == ("MM", 5)
    (other,) = json.loads(output(capsys, *arguments, "--units", "IN", "--tool", "1=25.4mm")[1])["results"]
    assert (other["units"], other["moves"][1]["y"]) == ("IN", pytest.approx(0.5))


@pytest.mark.parametrize(
    "arguments",
    [
        ("nowhere.nc", "--control", "linuxcnc"),
        (str(NC / "threeblock-line.nc"), "--control", "siemens"),
        (str(NC / "threeblock-line.nc"), "--control", "linuxcnc", "--tool", "1"),
        (str(NC / "threeblock-line.nc"), "--control", "linuxcnc", "--tool", "1=nan"),
        (str(NC / "threeblock-line.nc"), "--control", "linuxcnc", "--tools", "nowhere.tbl"),
        (str(NC / "threeblock-line.nc"), "--control", "linuxcnc", "--tools", str(NC)),
    ],
)
def test_unusable_arguments_give_status_2_and_one_sentence(
    arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    status, out, err = output(capsys, *arguments)
    assert (status, out) == (2, "")
    assert err.startswith("cutcomp: ")
    assert err.count("\n") == 1


def test_unparsable_arguments_give_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as error:
        check(["file.nc"])
    assert error.value.code == 2
    assert "--control" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "expected"),
    [(b"", 1), (b"\x00\xff\x1b[2J\x07" * 50, 1), (b"G1 X\x1b[31m", 1), (b"%", 0), (b"M98P1\nO1\nM98P1\nM99", 1)],
)
def test_no_control_characters_of_a_file_reach_the_terminal(
    content: bytes, expected: int, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "x.nc"
    file.write_bytes(content)
    status, out, err = output(capsys, file, "--control", "linuxcnc")
    assert status == expected
    assert "linuxcnc: " in out
    assert (out + err).replace("\n", "").isprintable()


def test_an_empty_folder_gives_status_2(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert output(capsys, tmp_path, "--control", "linuxcnc")[0] == 2


KLARTEXT = """BEGIN PGM A MM
TOOL DEF 1 L+0 R+3
TOOL CALL 1 Z S1000
L X-20 Y+0 R0 FMAX
L X+0 Y+0 RL F100
L Y+40
CC X+20 Y+40
C X+40 Y+40 DR-
L Y+{end}
L X+0
L X-20 R0
END PGM A MM
"""

ISO = "G21 F100\nG0 X-20 Y0\nG41 D1\nG1 X0 Y0\nY40\nG2 X40 I20\nG1 Y20\nY0\nX0\nG40\nG1 X-20\nM2\n"


@pytest.mark.parametrize(("end", "status"), [("0", 0), ("1", 1)])
def test_klartext_and_iso_are_compared_by_their_contours(
    end: str, status: int, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    first, second = tmp_path / "a.h", tmp_path / "b.nc"
    first.write_text(KLARTEXT.format(end=end))
    second.write_text(ISO)
    exit_status, out, _ = output(capsys, first, second, "--control", "linuxcnc", "--contour", "--tool", "1=6")
    assert exit_status == status, out
    same = "Contour 1: the same.\n"
    different = "Contour 1: line 10 of the first is 1.000 MM off, line 8 of the second is 1.000 MM off.\n"
    assert out == (different if status else same)


def test_comparing_contours_explains_why_a_program_stops(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    first, second = tmp_path / "a.nc", tmp_path / "b.nc"
    first.write_text(ISO)
    second.write_text(ISO)
    status, out, _ = output(capsys, first, second, "--control", "linuxcnc", "--contour")
    assert status == 1, out
    assert "The second program stops at line 3; what follows is not compared. The tool table has no tool 1." in out
    assert "On the command line: --tool 1=DIAMETER." in out


def test_comparing_contours_needs_two_files(capsys: pytest.CaptureFixture[str]) -> None:
    assert output(capsys, NC / "threeblock-line.nc", "--control", "linuxcnc", "--contour")[0] == 2


def test_an_empty_program_is_an_error(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "a.nc"
    for data in (b"", b"\n \r\n", b"\xef\xbb\xbf"):
        file.write_bytes(data)
        for control in ("linuxcnc", "threeblock", "klartext"):
            status, out, _ = output(capsys, file, "--control", control)
            assert status == 1
            assert "1:1  error    EMPTY" in out
            assert f"{display_name(control)}: has nothing to run" in out
            assert "; 0 moves, " in out
        assert "runs" not in output(capsys, file, "--control", "all")[1].replace("that runs", "")


def test_the_table_of_all_controls_names_the_rules_that_warn(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """After G40, a rapid crosses the wall that was just cut."""
    file = tmp_path / "a.nc"
    file.write_text(
        "G21 G17 G40 G90\nT1 M6\nG0 X-20. Y-20.\nG1 Z-5. F300.\nG41 D1 X0. Y-10.\nY40.\nX60.\nY0.\nX-10.\n"
        "G40 X-20. Y-20.\nG0 X80. Y60.\nM30\n"
    )
    status, out, _ = output(capsys, file, "--control", "all", "--tool", "1=10")
    rows = {line.split()[0]: line for line in out.splitlines()}
    assert "runs, 1 warning (RAPID)" in rows["fanuc:a"]
    assert status == 1


def test_an_empty_folder_is_reported_and_the_other_files_are_checked(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "empty").mkdir()
    file = NC / "rosettacnc-square.ngc"
    status, out, err = output(capsys, tmp_path / "empty", file, "--control", "rosettacnc:easy", "--tool", "1=6")
    assert status == 2
    assert "is a folder without programs (.anc .cnc .din" in err
    assert out.splitlines()[-1] == "2 files: 1 clean, 0 with warnings, 0 with errors, 1 not readable."


def test_a_folder_report_names_skipped_files_and_counts_warnings(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    good = "G21 G90 G17 G40\nT1 M6\nG0 X-20. Y-20.\nG1 Z-1. F100.\nG41 D1 X0. Y-10.\nY30.\nG40 X-20.\nM30\n"
    (tmp_path / "O1234").write_text(good)
    (tmp_path / "part.spf").write_text(good.replace("Z-1.", "Z-1"))
    (tmp_path / "notes.pdf").write_text("?")
    (tmp_path / "README").write_text("?")
    status, out, err = output(capsys, tmp_path, "--control", "fanuc:a", "--tool", "1=6")
    assert status == 0
    assert "2 files left out, whose names are not those of programs: .pdf README" in err
    first, second, last = out.splitlines()
    assert first.endswith("O1234: fanuc:a: runs")
    assert second.endswith("part.spf: fanuc:a: runs, 1 warning (FN-POINT)")
    assert last == "2 files: 1 clean, 1 with warnings, 0 with errors, 0 not readable."


def test_ctrl_c_ends_the_check_of_a_folder_quietly(tmp_path: Path) -> None:
    text = b"G21 G17 G90 F100\nG1 X0 Y0\n" + b"".join(b"X%d Y%d\n" % (row, row % 9) for row in range(6_000)) + b"M2\n"
    (tmp_path / "0.nc").write_bytes(text)
    for number in range(1, 600):
        os.link(tmp_path / "0.nc", tmp_path / f"{number}.nc")
    command = [sys.executable, "-m", "app", "check", str(tmp_path), "--control", "linuxcnc"]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    # a shell may start the tests with SIGINT ignored, and their child processes would inherit that
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    running = Popen(
        command, stdout=PIPE, stderr=PIPE, start_new_session=True, cwd=Path(__file__).parents[2], env=environment
    )
    signal.signal(signal.SIGINT, handler)
    with running:
        assert running.stdout is not None
        running.stdout.readline()
        os.killpg(running.pid, signal.SIGINT)
        _, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert err == b""


FRAGMENT = "L X-20 Y+0 R0 FMAX\nL X+0 Y+0 RL F200\nL X+30\nL X+60 R0\n"


def test_a_klartext_tool_is_given_by_its_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "named.h"
    file.write_text('BEGIN PGM A MM\nTOOL CALL "Rough D10" Z S3000 F500\n' + FRAGMENT + "END PGM A MM\n")
    status, out, _ = output(capsys, file, "--control", "klartext")
    assert status == 1
    assert "On the command line: --tool 'ROUGH D10'=DIAMETER." in out
    assert out.endswith("add --tool 'ROUGH D10'=10mm with the real diameter.\n")
    _, out, _ = output(capsys, file, "--control", "klartext", "--tool", "rough d10=10")
    assert "alarms" not in out


def test_a_klartext_fragment_names_the_tool_option_and_runs_with_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:  # fmt: skip
    file = tmp_path / "piece.h"
    file.write_text(FRAGMENT)
    status, out, _ = output(capsys, file, "--control", "klartext")
    assert status == 1
    assert "On the command line: --tool 1=DIAMETER." in out
    assert "LANGUAGE" not in out
    _, out, _ = output(capsys, file, "--control", "klartext", "--tool", "1=10")
    assert "cutcomp takes tool 1, the only one given." in out
    assert "4 moves, 1 compensated stretch, MM." in out


def test_the_missing_diameter_of_a_tool_names_the_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "part.ngc"
    file.write_text("G20 F9\nG41 D4\nG1 X1\nM2\n")
    _, out, _ = output(capsys, file, "--control", "linuxcnc")
    assert "--tool 4=DIAMETER" in out


def test_klartext_on_an_iso_control_is_reported_as_another_language(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:  # fmt: skip
    file = tmp_path / "piece.h"
    file.write_text(FRAGMENT)
    _, out, _ = output(capsys, file, "--control", "linuxcnc")
    assert "LANGUAGE" in out


def test_a_program_is_found_by_the_number_it_begins_with(tmp_path: Path) -> None:
    """A file on disk may be named like gauge_o1002.cnc."""
    (tmp_path / "other.nc").write_text("%\nO1003\nM99\n%")
    (tmp_path / "gauge_o1002.cnc").write_text("%\n(GAUGE)\nO1002 (PART)\nG1 X5. F100.\nM99\n%")
    entry = called_program(tmp_path, 1002)
    assert entry is not None
    assert entry[0] == "gauge_o1002.cnc"
    assert b"X5." in entry[1]
    assert called_program(tmp_path, 1004) is None
    assert called_program(None, 1002) is None


POCKET = "o<pocket> sub\n  G1 X#1 Y#2\n  o100 if [#1 GT 5]\n  X[#1+1]\n  o100 endif\no<pocket> endsub\nM2\n"


def test_linuxcnc_finds_a_named_subprogram_in_its_own_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "pocket.ngc").write_text(POCKET)
    main = tmp_path / "main.ngc"
    # the real interpreter moves to (10, 20), (11, 20), (1, 2), (50, 2) and never reaches the M2 of pocket.ngc
    main.write_text("G21 G90 F100\no<Pocket> call [10] [20]\no<pocket> call [1] [2]\nX50\n")
    assert check([str(main), "--control", "linuxcnc", "--json"]) == 0
    (result,) = json.loads(capsys.readouterr().out)["results"]
    moves = [(move["line"], move["x"], move["y"]) for move in result["moves"][1:]]
    assert moves == [(2, 10.0, 20.0), (2, 11.0, 20.0), (3, 1.0, 2.0), (4, 50.0, 2.0)]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("o<lost> call", "There is no subprogram O<lost> in this file, and no file lost.ngc in its folder."),
        ("o7 call", "There is no subprogram O7 in this file, and no file 7.ngc in its folder."),
        ("o<plain> call", "plain.ngc is called here and has no subprogram O<plain>."),
        ("o<bad> call", "bad.ngc line 2: "),
        ("o<badly> call", "badly.ngc line 4: This label is in use since badly.ngc line 2; "),
        ("o<../outside> call", "There is no subprogram O<../outside> in this file"),
    ],
)
def test_a_subprogram_that_cannot_be_called_is_reported_at_its_call(
    call: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    (tmp_path / "outside.ngc").write_text("o<../outside> sub\no<../outside> endsub\n")
    (folder / "plain.ngc").write_text("G0 X1\n")
    (folder / "bad.ngc").write_text("o<bad> sub\nG1 X1 X2\no<bad> endsub\n")
    twice = "o100 if [1]\no100 endif\no100 while [0]\no100 endwhile\n"
    (folder / "badly.ngc").write_text(f"o<badly> sub\n{twice}o<badly> endsub\n")
    (folder / "main.ngc").write_text(f"G21 F9\n{call}\nM2\n")
    assert check([str(folder / "main.ngc"), "--control", "linuxcnc", "--json"]) == 1
    (result,) = json.loads(capsys.readouterr().out)["results"]
    (finding,) = (finding for finding in result["findings"] if finding["severity"] == "error")
    assert finding["text"].startswith(message)
    assert finding["line"] == result["stopped_at"] == 2
    assert finding["column"] == (1 if "bad" in call else call.index("call") + 1)


def test_a_tool_of_an_unusual_size_is_a_warning(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_text("G20 G90\nT1 M6\nG0 X0 Y0 Z1\nG1 Z0 F5\nG1 X9\nG0 Z1\nM30\n")
    _, out, _ = output(capsys, file, "--control", "linuxcnc", "--tool", "1=2400")
    assert "Tool 1 is 2400.0000 across, more than any usual cutter. Is its unit right? The program is in INCH." in out
    assert "1 warning (TOOL_SIZE)" in out
    _, out, _ = output(capsys, file, "--control", "linuxcnc", "--tool", "1=.5")
    assert "TOOL_SIZE" not in out
    _, out, _ = output(capsys, file, "--control", "all", "--tool", "1=2400")
    assert "TOOL_SIZE" in out
