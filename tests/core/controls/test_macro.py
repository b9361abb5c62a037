"""Parameters, expressions and O-words: as LinuxCNC's interpreter works them out, and what RosettaCNC has of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.iso.expressions import ExpressionReader, FaultError, MacroParameters, ParameterStore
from core.controls.iso.flow import o_words_of
from core.finding import Severity
from core.units import Unit
from tests.core.controls.compare_rs274 import outcome
from tests.core.controls.hand import findings_of, lines_and_ends, ran, ran_up_to, same, shape
from tests.core.controls.macro_programs import REFUSED, SAME, generated, whole
from tests.rs274 import WITNESS

needs_witness = pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")

DIAMETERS = {1: 0.5, 2: 0.25}


@needs_witness
@pytest.mark.parametrize("name", SAME)
def test_the_interpreter_itself_makes_the_same_moves(name: str, tmp_path: Path) -> None:
    assert outcome(whole(SAME[name]), tmp_path, DIAMETERS, Unit.IN) == ("same moves", "")


@needs_witness
@pytest.mark.parametrize("name", REFUSED)
def test_the_interpreter_itself_refuses(name: str, tmp_path: Path) -> None:
    fared, apart = outcome(whole(REFUSED[name][0]), tmp_path, DIAMETERS, Unit.IN)
    assert fared.startswith("both refuse")
    assert not apart


@pytest.mark.parametrize("name", REFUSED)
def test_a_refusal_names_its_place(name: str) -> None:
    body, line, column = REFUSED[name]
    run = ran(whole(body), "linuxcnc", t1=0.5)
    found = [finding for finding in run.findings if finding.severity is Severity.ERROR]
    assert [(one.line, one.column) for one in found] == [(line, column)]
    assert run.stopped_at == line
    assert found[0].text.isprintable()


@needs_witness
def test_generated_contours_fare_as_with_the_interpreter_itself(tmp_path: Path) -> None:
    fared = [outcome(generated(seed), tmp_path, DIAMETERS, Unit.IN) for seed in range(60)]
    assert not [one for one in fared if not one[0].startswith(("same moves", "both refuse"))]
    assert sum(one[0] == "same moves" for one in fared) >= 20


def test_a_number_nobody_set_is_0_and_reported() -> None:
    run = ran("G20 F9\nG1 X[#100 + 1]\nM2\n", "linuxcnc")
    assert lines_and_ends(run) == [(1.0, 0.0)]
    assert [(one.severity, one.line, one.column) for one in findings_of(run, "PARAMETER")] == [(Severity.WARNING, 2, 6)]


def test_an_argument_nobody_gave_is_0_in_the_subprogram() -> None:
    run = ran("G20 F9\no1 sub\nG1 X1 Y#2\no1 endsub\no1 call [1]\nM2\n", "linuxcnc")
    assert not findings_of(run, "PARAMETER")


def test_moves_of_a_subprogram_have_its_lines() -> None:
    run = ran("G20 F9\no1 sub\nG1 X#1\no1 endsub\no1 call [1]\no1 call [2]\nM2\n", "linuxcnc")
    assert lines_and_ends(run, 3) == [(1.0, 0.0), (2.0, 0.0)]


def test_columns_of_words_that_are_worked_out() -> None:
    run = ran("G20 F9\n#1=2\nG1 X[#1 + 1] X#1\nM2\n", "linuxcnc")
    assert [(one.line, one.column) for one in findings_of(run, "TWICE")] == [(3, 14)]


def test_what_the_control_keeps_is_not_guessed() -> None:
    for value in ("#5161", "#5221", "#<_rpm>", "#<_hal[pin]>"):
        run = ran(f"G20 F9\nG1 X{value}\nM2\n", "linuxcnc")
        assert [(one.line, one.column) for one in findings_of(run, "BEYOND")] == [(2, 5)], value
    assert findings_of(ran("G20 F9\n#5221=1\nM2\n", "linuxcnc"), "BEYOND")


def test_an_endless_loop_is_given_up() -> None:
    assert findings_of(ran("G20 F9\no1 while [1]\no1 endwhile\nM2\n", "linuxcnc"), "LIMIT")


@pytest.mark.parametrize("piece", ["[", "#", "-", "SIN[", "[1+", "#[", "1+", "##1"])
def test_what_lies_deep_is_refused_or_read(piece: str) -> None:
    run = ran(f"G20 F9\nG1 X{piece * 20000}\nM2\n", "linuxcnc")
    assert run.stopped_at == 2


@pytest.mark.parametrize(
    "text", ["#99999[", f"G1 X[{'9' * 400}]", f"#{'9' * 400}=1", f"o{'9' * 5000} sub", "G1 X#<\x1b[2J>"]
)
def test_signs_and_sizes_nobody_writes_are_refused(text: str) -> None:
    run = ran(f"G20 F9\n{text}\nM2\n", "linuxcnc")
    assert run.stopped_at == 2
    assert all(finding.text.isprintable() for finding in run.findings)


def test_rosettacnc_works_its_variables_out() -> None:
    text = "G21 F100\n#500=10 #1=2\nG1 X[#500 * #1] Y-#1\nG1 X[#500 & 3]\nM30\n"
    run = ran(text, "rosettacnc")
    assert same(shape(run), [("line", 20, -2), ("line", 2, -2)])


def test_rosettacnc_gives_subprograms_by_m98_the_same_variables() -> None:
    run = ran("G21 F100\n#1=3\nM98 P7\nG1 X#1\nM30\nO7\n#1=5\nM99\n", "rosettacnc")
    assert lines_and_ends(run) == [(5.0, 0.0)]


@pytest.mark.parametrize(
    ("word", "code"),
    [("#0", "PARAMETER"), ("#500", "PARAMETER"), ("#100", "PARAMETER"), ("#5001", "BEYOND"), ("#6000", "BEYOND")],
)
def test_rosettacnc_does_not_guess_what_is_empty_or_the_control_s(word: str, code: str) -> None:
    run = ran(f"G21 F100\nG1 X{word}\n", "rosettacnc")
    assert [(one.line, one.column) for one in findings_of(run, code)] == [(2, 5)]
    assert run.stopped_at == 2


@pytest.mark.parametrize("number", [0, 5000, 6001])
def test_rosettacnc_sets_its_own_variables_only(number: int) -> None:
    assert findings_of(ran(f"G21 F100\n#{number}=1\n", "rosettacnc"), "PARAMETER")


@pytest.mark.parametrize(
    "line", ["IF [#1 EQ 2] GOTO 5", "WHILE [#1 LT 3] DO 1", "GOTO 7", "END 1", "N5 IF[#1 GT 2]THEN#2=1", "DO1"]
)
@pytest.mark.parametrize("control", ["rosettacnc", "nine-series", "threeblock"])
def test_branches_of_other_controls_stop_with_their_name(control: str, line: str) -> None:
    run = ran(f"G20 G1 F9 X1.\n{line}\nX2.\n", control)
    assert [one.line for one in findings_of(run, "BRANCH")] == [2]
    assert run.stopped_at == 2


@pytest.mark.parametrize("control", ["nine-series", "threeblock"])
def test_controls_of_which_nothing_is_known_stop_at_an_expression(control: str) -> None:
    run = ran("G20 G1 F9 X1.\nX[1+1]\n", control)
    assert [(one.line, one.column) for one in findings_of(run, "MACRO")] == [(2, 1)]


@given(st.text(alphabet="#[]<>-+*/.0123456789ABSINATMODGTEQ=_", max_size=40))
@settings(max_examples=500, derandomize=True)
def test_any_expression_is_a_number_or_a_fault(text: str) -> None:
    reader = ExpressionReader(text, MacroParameters(ParameterStore.MACRO_B))
    fault: FaultError | None = None
    value = 0.0
    try:
        value = reader.value()
    except FaultError as caught:
        fault = caught
    assert abs(value) < float("inf")
    assert fault is None or (0 <= fault.at <= len(text) and fault.text.isprintable())


def test_brackets_that_never_close_are_read_once() -> None:
    assert o_words_of(["o1 sub (", "o1 " + "(" * 200_000, "o2 sub (a ; b)", "o3 sub ; (", "(o4 sub"]).keys() == {2, 3}


def looped(line: str, kind: str) -> str:
    """A hundred such lines again and again, without end or nearly so."""
    body = "\n".join([line] * 100)
    if kind == "while":
        return f"G20 F9\no1 while [1]\n{body}\no1 endwhile\nM2\n"
    return f"G20 F9\nM98 P1 L999999\nM2\nO1\n{body}\nM99\n"


@pytest.mark.parametrize("kind", ["while", "M98"])
def test_what_takes_long_to_work_out_is_given_up_sooner(kind: str) -> None:
    plain, long = "G1 X1 Y2", "G1 X[1+2*sin[30]/2.5] Y[2+3*[3+4]-5] F[100+2*2]"
    few, many = (ran_up_to(looped(line, kind), 20_000) for line in (long, plain))
    assert findings_of(few, "LIMIT")
    assert findings_of(many, "LIMIT")
    assert len(many.moves) > 18_000
    assert 1_000 < len(few.moves) < 3_000
    for given_up in (few, many):
        assert "does not judge the run. Fix the loop or repeat fewer times." in findings_of(given_up, "LIMIT")[0].text


def test_blocks_that_run_once_are_no_repeats() -> None:
    lines = "\n".join(f"G1 X[{index}+1]\nG1 X{index}" for index in range(200))
    assert not findings_of(ran_up_to(f"G20 F9\n{lines}\nM98 P1\nM2\nO1\n{lines}\nM99\n", 10), "LIMIT")


def test_lines_with_more_than_moves_may_run_often() -> None:
    for line in ("G90 G1 X1.0000 Y2.0000 F100. (a note)", "N10 G1 X1.0000 Y2.0000 F1000 M8"):
        body = "\n".join([line] * 200)
        assert not findings_of(ran_up_to(f"G20 F9\nM98 P1 L25\nM2\nO1\n{body}\nM99\n", 20_000), "LIMIT")


def test_a_loop_of_o_words_that_is_given_up_says_what_to_do() -> None:
    run = ran("G20 F9\no1 while [1]\no1 endwhile\nM2\n", "linuxcnc")
    assert "does not judge the run. Fix the loop or repeat fewer times." in findings_of(run, "LIMIT")[0].text


def test_a_long_subprogram_may_run_often() -> None:
    body = "\n".join(f"G1 X{index % 7} Y{index}" for index in range(1000))
    run = ran(f"G20 F9\nM98 P1 L201\nM2\nO1\n{body}\nM99\n", "linuxcnc")
    assert run.stopped_at is None
    assert len(run.moves) == 201_001
