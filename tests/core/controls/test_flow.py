"""The order of execution: subprograms, labels, ends."""

from __future__ import annotations

import pytest

from tests.core.controls.hand import findings_of, lines_and_ends, run_of

HEAD = "G21 G1 F100\n"


def test_subprograms_after_the_end_are_called_and_repeated() -> None:
    run = run_of(f"{HEAD}M98 P10 L2\nM30\nO10 ; there\nG91 X1\nG90\nM99\n", "rosettacnc")
    assert lines_and_ends(run) == [(1.0, 0.0), (2.0, 0.0)]


def test_subprograms_may_call_others() -> None:
    run = run_of(f"{HEAD}M98P1\nX9\nM2\nO1\nX1\nM98P2\nX3\nM99\nO2\nX2\nM99\n", "rosettacnc")
    assert [x for x, _ in lines_and_ends(run)] == [1.0, 2.0, 3.0, 9.0]


def test_a_label_may_have_a_block_number_and_small_letters() -> None:
    assert lines_and_ends(run_of(f"{HEAD}m98p0007\nm2\nn5 o7 (x)\nx1\nm99\n", "rosettacnc")) == [(1.0, 0.0)]


@pytest.mark.parametrize(
    ("body", "line", "column"),
    [
        ("M98 P5\nM2\n", 2, 5),
        ("M98\nM2\n", 2, 1),
        ("M98 P1\nM2\nO1\nM98 P1\nM99\n", 5, 5),
        ("M98 P1\nM2\nO1\nM98 P2\nM99\nO2\nM98 P1\nM99\n", 8, 5),
    ],
)
def test_calls_without_a_target_or_in_a_circle_stop(body: str, line: int, column: int) -> None:
    run = run_of(HEAD + body, "rosettacnc")
    assert [(finding.line, finding.column) for finding in findings_of(run, "SUBPROGRAM")] == [(line, column)]
    assert run.stopped_at == line


def test_the_threeblock_control_has_no_subprograms() -> None:
    assert findings_of(run_of("G0X1.\nM98P1\nM2\nO1\nX2.\nM99\n", "threeblock"), "SUBPROGRAM")


def test_running_into_a_subprogram_is_reported() -> None:
    assert findings_of(run_of(f"{HEAD}X1\nO7\nX2\nM99\n", "rosettacnc"), "SUBPROGRAM")
    assert not findings_of(run_of(f"O7\n{HEAD}X1\nM2\n", "rosettacnc"), "SUBPROGRAM")


def test_a_file_that_ends_in_a_subprogram_is_reported() -> None:
    assert findings_of(run_of(f"{HEAD}M98 P1\nM2\nO1\nX1\n", "rosettacnc"), "SUBPROGRAM")


def test_nothing_after_the_end_runs() -> None:
    assert lines_and_ends(run_of(f"{HEAD}X1\nM30\nX2\n", "rosettacnc")) == [(1.0, 0.0)]
    assert lines_and_ends(run_of("%\nG21 F100\nG1 X1\n%\nX2\n", "linuxcnc")) == [(1.0, 0.0)]


@pytest.mark.parametrize("control", ["threeblock", "rosettacnc", "nine-series", "linuxcnc", "klartext"])
@pytest.mark.parametrize("text", [b"", b"\n\n", b"%", b"\x00" * 100, b"\xff\xfeG\x00", bytes(range(256))])
def test_any_file_gives_a_run(control: str, text: bytes) -> None:
    run = run_of(text, control)
    assert len(run.moves) >= 1
    assert all(finding.text.isprintable() for finding in run.findings)


@pytest.mark.parametrize("control", ["linuxcnc", "nine-series:a", "rosettacnc:normal"])
def test_a_main_program_after_a_subprogram_is_reported(control: str) -> None:
    """The first program of the file ends with M99, so the program after it never runs."""
    begin, after = "O9000\nG21 G91 G1 Z-5. F100.\nG90\nM99\n", "O1\nG21 G90\nG0 X1.\nM30\n"
    assert "NOT_RUN" in {finding.code for finding in run_of(begin + after, control).findings}
    # a subprogram that is not called because of a condition is not reported
    main = "G21 G90 G40\n/M98 P1\nG0 X1.\nM30\n"
    assert "NOT_RUN" not in {finding.code for finding in run_of(main + "O1\nG0 X2.\nM99\n", control).findings}
