"""Parameters, expressions and O-words as in LinuxCNC's interpreter, and those that RosettaCNC has."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.iso.expressions import ExpressionReader, FaultError, MacroParameters, ParameterStore
from core.controls.iso.flow import o_words_of
from core.controls.makers import linuxcnc
from core.finding import Severity
from core.units import Unit
from tests.core.controls.compare_rs274 import outcome
from tests.core.controls.hand import findings_of, lines_and_ends, run_of, run_until_given_up, same, shape
from tests.core.controls.macro_programs import REFUSED, SAME, generated, whole
from tests.rs274 import WITNESS

needs_witness = pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")

DIAMETERS = {1: 0.5, 2: 0.25}


@needs_witness
@pytest.mark.parametrize("name", SAME)
def test_programs_make_the_same_moves_as_in_the_interpreter(name: str, tmp_path: Path) -> None:
    assert outcome(whole(SAME[name]), tmp_path, DIAMETERS, Unit.IN) == ("same moves", "")


@needs_witness
@pytest.mark.parametrize("name", REFUSED)
def test_bad_programs_are_refused_by_the_interpreter_too(name: str, tmp_path: Path) -> None:
    result, apart = outcome(whole(REFUSED[name][0]), tmp_path, DIAMETERS, Unit.IN)
    assert result.startswith("both refuse")
    assert not apart


@pytest.mark.parametrize("name", REFUSED)
def test_a_refusal_names_line_and_column(name: str) -> None:
    body, line, column = REFUSED[name]
    run = run_of(whole(body), "linuxcnc", t1=0.5)
    errors = [finding for finding in run.findings if finding.severity is Severity.ERROR]
    assert [(finding.line, finding.column) for finding in errors] == [(line, column)]
    assert run.stopped_at == line
    assert errors[0].text.isprintable()


@needs_witness
def test_generated_contours_match_the_interpreter(tmp_path: Path) -> None:
    results = [outcome(generated(seed), tmp_path, DIAMETERS, Unit.IN) for seed in range(60)]
    assert not [result for result in results if not result[0].startswith(("same moves", "both refuse"))]
    assert sum(result[0] == "same moves" for result in results) >= 20


def test_an_unset_parameter_is_0_and_reported() -> None:
    run = run_of("G20 F9\nG1 X[#100 + 1]\nM2\n", "linuxcnc")
    assert lines_and_ends(run) == [(1.0, 0.0)]
    assert [(finding.severity, finding.line, finding.column) for finding in findings_of(run, "PARAMETER")] == [
        (Severity.WARNING, 2, 6)
    ]


def test_an_argument_that_is_not_given_is_not_reported() -> None:
    run = run_of("G20 F9\no1 sub\nG1 X1 Y#2\no1 endsub\no1 call [1]\nM2\n", "linuxcnc")
    assert not findings_of(run, "PARAMETER")


def test_moves_of_a_subprogram_have_the_lines_of_the_subprogram() -> None:
    run = run_of("G20 F9\no1 sub\nG1 X#1\no1 endsub\no1 call [1]\no1 call [2]\nM2\n", "linuxcnc")
    assert lines_and_ends(run, 3) == [(1.0, 0.0), (2.0, 0.0)]


def test_a_duplicate_word_with_an_expression_has_its_column() -> None:
    run = run_of("G20 F9\n#1=2\nG1 X[#1 + 1] X#1\nM2\n", "linuxcnc")
    assert [(finding.line, finding.column) for finding in findings_of(run, "TWICE")] == [(3, 14)]


def test_parameters_of_the_control_are_not_guessed() -> None:
    for value in ("#5161", "#5221", "#<_rpm>", "#<_hal[pin]>"):
        run = run_of(f"G20 F9\nG1 X{value}\nM2\n", "linuxcnc")
        assert [(finding.line, finding.column) for finding in findings_of(run, "BEYOND")] == [(2, 5)], value
    assert findings_of(run_of("G20 F9\n#5221=1\nM2\n", "linuxcnc"), "BEYOND")


def test_an_endless_loop_is_stopped() -> None:
    assert findings_of(run_of("G20 F9\no1 while [1]\no1 endwhile\nM2\n", "linuxcnc"), "LIMIT")


@pytest.mark.parametrize("piece", ["[", "#", "-", "SIN[", "[1+", "#[", "1+", "##1"])
def test_deep_nesting_is_refused(piece: str) -> None:
    run = run_of(f"G20 F9\nG1 X{piece * 20000}\nM2\n", "linuxcnc")
    assert run.stopped_at == 2


@pytest.mark.parametrize(
    "text", ["#99999[", f"G1 X[{'9' * 400}]", f"#{'9' * 400}=1", f"o{'9' * 5000} sub", "G1 X#<\x1b[2J>"]
)
def test_absurd_sizes_and_characters_are_refused(text: str) -> None:
    run = run_of(f"G20 F9\n{text}\nM2\n", "linuxcnc")
    assert run.stopped_at == 2
    assert all(finding.text.isprintable() for finding in run.findings)


def test_rosettacnc_evaluates_variables() -> None:
    text = "G21 F100\n#500=10 #1=2\nG1 X[#500 * #1] Y-#1\nG1 X[#500 & 3]\nM30\n"
    run = run_of(text, "rosettacnc")
    assert same(shape(run), [("line", 20, -2), ("line", 2, -2)])


def test_rosettacnc_shares_variables_with_m98_subprograms() -> None:
    run = run_of("G21 F100\n#1=3\nM98 P7\nG1 X#1\nM30\nO7\n#1=5\nM99\n", "rosettacnc")
    assert lines_and_ends(run) == [(5.0, 0.0)]


@pytest.mark.parametrize(
    ("word", "code"),
    [("#0", "PARAMETER"), ("#500", "PARAMETER"), ("#100", "PARAMETER"), ("#5001", "BEYOND"), ("#6000", "BEYOND")],
)
def test_rosettacnc_stops_at_unset_or_system_variables(word: str, code: str) -> None:
    run = run_of(f"G21 F100\nG1 X{word}\n", "rosettacnc")
    assert [(finding.line, finding.column) for finding in findings_of(run, code)] == [(2, 5)]
    assert run.stopped_at == 2


@pytest.mark.parametrize("number", [0, 5000, 6001])
def test_rosettacnc_refuses_to_set_variables_out_of_range(number: int) -> None:
    assert findings_of(run_of(f"G21 F100\n#{number}=1\n", "rosettacnc"), "PARAMETER")


@pytest.mark.parametrize(
    "line", ["IF [#1 EQ 2] GOTO 5", "WHILE [#1 LT 3] DO 1", "GOTO 7", "END 1", "N5 IF[#1 GT 2]THEN#2=1", "DO1"]
)
@pytest.mark.parametrize("control", ["rosettacnc", "nine-series", "threeblock"])
def test_branches_in_the_language_of_other_controls_stop_the_run(control: str, line: str) -> None:
    run = run_of(f"G20 G1 F9 X1.\n{line}\nX2.\n", control)
    assert [finding.line for finding in findings_of(run, "BRANCH")] == [2]
    assert run.stopped_at == 2


@pytest.mark.parametrize("control", ["nine-series", "threeblock"])
def test_controls_with_undocumented_expressions_stop_at_one(control: str) -> None:
    run = run_of("G20 G1 F9 X1.\nX[1+1]\n", control)
    assert [(finding.line, finding.column) for finding in findings_of(run, "MACRO")] == [(2, 1)]


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


def test_unclosed_brackets_are_read_in_linear_time() -> None:
    assert o_words_of(["o1 sub (", "o1 " + "(" * 200_000, "o2 sub (a ; b)", "o3 sub ; (", "(o4 sub"]).keys() == {2, 3}


def looped(line: str, kind: str) -> str:
    """A hundred such lines in an endless or very long loop."""
    body = "\n".join([line] * 100)
    if kind == "while":
        return f"G20 F9\no1 while [1]\n{body}\no1 endwhile\nM2\n"
    return f"G20 F9\nM98 P1 L999999\nM2\nO1\n{body}\nM99\n"


@pytest.mark.parametrize("kind", ["while", "M98"])
def test_loops_with_expressions_are_stopped_sooner(kind: str) -> None:
    plain, long = "G1 X1 Y2", "G1 X[1+2*sin[30]/2.5] Y[2+3*[3+4]-5] F[100+2*2]"
    slow, fast = (run_until_given_up(looped(line, kind), 5_000) for line in (long, plain))
    assert findings_of(slow, "LIMIT")
    assert findings_of(fast, "LIMIT")
    assert len(fast.moves) > 4_500
    assert 250 < len(slow.moves) < 750
    for run in (slow, fast):
        assert "does not judge the run. Fix the loop or repeat fewer times." in findings_of(run, "LIMIT")[0].text


def test_blocks_that_run_once_are_no_repeats() -> None:
    lines = "\n".join(f"G1 X[{index}+1]\nG1 X{index}" for index in range(200))
    assert not findings_of(run_until_given_up(f"G20 F9\n{lines}\nM98 P1\nM2\nO1\n{lines}\nM99\n", 10), "LIMIT")


def test_lines_with_comments_and_codes_may_run_often() -> None:
    for line in ("G90 G1 X1.0000 Y2.0000 F100. (a note)", "N10 G1 X1.0000 Y2.0000 F1000 M8"):
        body = "\n".join([line] * 200)
        assert not findings_of(run_until_given_up(f"G20 F9\nM98 P1 L25\nM2\nO1\n{body}\nM99\n", 20_000), "LIMIT")


def test_the_message_of_a_stopped_loop_says_what_to_do() -> None:
    run = run_of("G20 F9\no1 while [1]\no1 endwhile\nM2\n", "linuxcnc")
    assert "does not judge the run. Fix the loop or repeat fewer times." in findings_of(run, "LIMIT")[0].text


def test_a_long_subprogram_may_run_often() -> None:
    """A tenth of the blocks that the control may repeat, and of those that the program does."""
    assert linuxcnc.DIALECT.max_repeated_blocks >= 400_000
    body = "\n".join(f"G1 X{index % 7} Y{index}" for index in range(100))
    run = run_until_given_up(f"G20 F9\nM98 P1 L201\nM2\nO1\n{body}\nM99\n", 40_000)
    assert run.stopped_at is None
    assert len(run.moves) == 20_101
