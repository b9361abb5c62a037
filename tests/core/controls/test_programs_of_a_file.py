"""The program of a file that runs, and findings on the rest of the file."""

from __future__ import annotations

import pytest

from core.controls import registry
from core.finding import Severity
from core.units import Unit
from tests.core.controls.hand import findings_of, lines_and_ends, run_of

SUB = "O5101 (PASS)\nG1 X7. F100.\nM99\n"
MAIN = "O5100 (PART)\nG21 G90 G0 X1.\nM98 P5101\nM30\n"


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_the_main_program_runs_wherever_it_is_in_the_file(control: str) -> None:
    run = run_of(f"%\n{SUB}{MAIN}%\n", control)
    assert lines_and_ends(run) == [(1.0, 0.0), (7.0, 0.0)]
    (message,) = findings_of(run, "PROGRAM")
    assert (message.severity, message.line) == (Severity.INFO, 5)
    assert message.text == "cutcomp runs O5100: O5101, which stands before it, is called."
    assert not findings_of(run_of(f"%\n{MAIN}{SUB}%\n", control), "PROGRAM")


def test_programs_that_only_call_each_other_start_with_the_first() -> None:
    run = run_of("O1\nG1 X1. F100.\nM98 P2\nM30\nO2\nX2.\nM98 P1\nM99\n", "fanuc:a")
    assert lines_and_ends(run)[:2] == [(1.0, 0.0), (2.0, 0.0)]
    assert not findings_of(run, "PROGRAM")


def test_programs_that_are_not_called_are_reported() -> None:
    run = run_of(f"{MAIN}{SUB}O2 (OTHER)\nG1 X2. F100.\nM30\n:3\nM30\n", "fanuc:a")
    (message,) = findings_of(run, "NOT_RUN")
    assert (message.severity, message.line) == (Severity.WARNING, 8)
    assert (
        message.text
        == "Programs that nothing in this file calls were not run: O2 (line 8), O3 (line 11). Check each by itself."
    )
    assert not findings_of(run_of(MAIN + SUB, "fanuc:a"), "NOT_RUN")


def test_calls_with_a_variable_and_with_a_number_are_distinguished() -> None:
    main = MAIN.replace("M30", "#100=5102\nM98 P#100\nM30")
    run = run_of(f"{SUB}{main}O5102\nX9.\nM99\nO3\nM30\n", "fanuc:a")
    assert lines_and_ends(run) == [(1.0, 0.0), (7.0, 0.0), (9.0, 0.0)]
    (message,) = findings_of(run, "NOT_RUN")
    assert message.text == (
        "Programs that a call with a variable may mean were not run: O3 (line 13). Check each by itself."
    )
    exponent = run_of(f"{MAIN.replace('M98 P5101', 'G65 A[EXP[1]] P5101')}{SUB}O3\nM30\n", "fanuc:a")
    assert findings_of(exponent, "NOT_RUN")[0].text.startswith(
        "Programs that nothing in this file calls were not run: O3"
    )


def test_only_fanuc_takes_the_repeat_count_from_p() -> None:
    text = "O2 (SUB)\nX9. M99\nO1\nG21 G90 G1 X1. F100.\nM98 P10002\nM30\n"
    assert findings_of(run_of(text, "fanuc:a"), "PROGRAM")
    assert not findings_of(run_of(text, "haas:a"), "PROGRAM")


def test_only_a_few_of_many_programs_not_run_are_named() -> None:
    many = "".join(f"O{number}\nM30\n" for number in range(100, 200))
    (message,) = findings_of(run_of(MAIN + SUB + many, "fanuc:a"), "NOT_RUN")
    assert "were not run: O100 (line 8), O101 (line 10), O102 (line 12) and 97 more." in message.text


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc"])
def test_lines_after_m30_are_reported_unless_a_jump_or_call_may_reach_them(control: str) -> None:
    text = "G21 G90 F100.\nG1 X2.\nM30\n"
    assert findings_of(run_of(f"{text}G1 X3.\nM30\n", control), "NOT_RUN")[0].line == 4
    assert not findings_of(run_of(f"{text}(NOTE)\nREMARK\n\x1a\n", control), "NOT_RUN")
    if control == "linuxcnc":
        assert not findings_of(run_of(f"{text}O7 sub\nG1 X3.\nO7 endsub\n", control), "NOT_RUN")
    else:
        assert not findings_of(run_of(f"{text}N900 G1 X3.\nM30\n", control), "NOT_RUN")


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
def test_lines_after_a_single_percent_sign_are_reported(control: str) -> None:
    run = run_of("O1\nG21 G90 F100.\nG1 X1.\nM30\n%\nO2\nG1 X2.\nM30\n", control)
    assert findings_of(run, "NOT_RUN")[0].line == 6


def test_a_program_whose_call_is_skipped_by_a_condition_is_not_reported() -> None:
    run = run_of(f"O1\n#1=0\nG21\nIF[#1EQ0]GOTO9\nM98 P5101\nN9 M30\n{SUB}", "fanuc:a")
    assert not findings_of(run, "NOT_RUN")


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "nine-series"])
def test_lines_after_the_end_are_reported(control: str) -> None:
    run = run_of("%\nG21 G1 X1. F100.\nM30\n%\n(NEXT PART)\nG1 X2. F100.\nM30\n%\n", control)
    assert lines_and_ends(run) == [(1.0, 0.0)]
    (message,) = findings_of(run, "NOT_RUN")
    assert (message.severity, message.line) == (Severity.WARNING, 6)
    assert message.text == "The lines from here on come after the end of the program and were not run. Check them."


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "nine-series"])
def test_a_remark_after_the_end_is_not_reported(control: str) -> None:
    assert not findings_of(run_of("%\nG21 G1 X1. F100.\nM30\n%\n(END)\n\n%\n", control), "NOT_RUN")


def test_a_second_program_in_klartext_is_reported() -> None:
    text = "BEGIN PGM A MM\nL X+1 Y+0 F100\nEND PGM A MM\n;\nBEGIN PGM B MM\nL X+2\nEND PGM B MM\n"
    (message,) = findings_of(run_of(text, "klartext"), "NOT_RUN")
    assert (message.severity, message.line) == (Severity.WARNING, 5)
    assert not findings_of(run_of(text[: text.index(";")], "klartext"), "NOT_RUN")


O_WORDS = "o<prof> sub\nG1 X5 F100\no<prof> endsub\nG21 G1 X1 F100\no<prof> call\nM2\n"


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a"])
@pytest.mark.parametrize("text", [O_WORDS, O_WORDS.replace("<prof>", "100"), f"O7\n{O_WORDS}"])
def test_o_words_of_linuxcnc_are_no_program_heads(text: str, control: str) -> None:
    run = run_of(text, control)
    assert run.stopped_at == (2 if text.startswith("O7") else 1)
    assert [finding.code for finding in run.findings if finding.severity is Severity.ERROR] == ["PS0009"]


@pytest.mark.parametrize(
    "head", ["<PART-1>", "O<PART-1>", "O<PART-1> G21", "O1 (PART)", ":1", "O1 G21", "<PART-1> (REV B)"]
)
def test_every_form_of_a_program_head_is_accepted(head: str) -> None:
    run = run_of(f"%\n{head}\nG21 G1 X1. F100.\nM30\n%\n", "fanuc:a")
    assert (run.stopped_at, lines_and_ends(run)) == (None, [(1.0, 0.0)])


def test_haas_refuses_a_program_name_without_o() -> None:
    assert run_of("%\n<PART-1>\nG21 G1 X1. F100.\nM30\n%\n", "haas:a").stopped_at == 2


FILES: dict[int | str, tuple[str, bytes]] = {
    2: ("O2.nc", b"O2\nG1 X5.\nM99\n"),
    3: ("O3.nc", b"%\nO3\nX6.\nG33 X1.\nM99\n%\n"),
    "a": ("a.ngc", b"o<a> sub\nG1 X5.\no<b> call\no<a> endsub\n"),
    "b": ("b.ngc", b"o<b> sub\nX6.\nG33 X1.\no<b> endsub\n"),
    "c": ("c.ngc", b"o<d> sub\no<d> endsub\n"),
}


@pytest.mark.parametrize(
    ("control", "calls", "ends", "stop", "text"),
    [
        ("fanuc:a", "M98 P2\nM98 P3", [(2, 1.0), (3, 5.0), (4, 6.0)], 4, "O3.nc line 4: cutcomp does not"),
        ("linuxcnc", "o<a> call", [(2, 1.0), (3, 5.0), (3, 6.0)], 3, "b.ngc line 3: cutcomp does not support G33"),
        ("linuxcnc", "o<c> call", [(2, 1.0)], 3, "c.ngc is called here and has no subprogram O<c>."),
        ("linuxcnc", "o<e> call", [(2, 1.0)], 3, "There is no subprogram O<e> in this file, and no file e.ngc"),
    ],
)
def test_moves_and_findings_of_a_called_file_count_for_the_line_that_calls_it(
    control: str, calls: str, ends: list[tuple[int, float]], stop: int, text: str
) -> None:
    run = registry.run(f"G21 F9.\nG0 X1.\n{calls}\nM30\n".encode(), control, {}, Unit.MM, FILES.get)
    assert [(move.line, move.point[0]) for move in run.moves if move.line] == ends
    assert (run.stopped_at, run.findings[-1].line) == (stop, stop)
    assert run.findings[-1].text.startswith(text)
