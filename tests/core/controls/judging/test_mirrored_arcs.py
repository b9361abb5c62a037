"""An arc on the wrong side of its chord, among corners that are rounded, is a warning at its line."""

from __future__ import annotations

import pytest

from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.finding import Finding, Severity
from core.units import Unit, sentence
from tests.core.controls.hand import run_of

POCKET = (
    "G21 G17 G90 G40\nT1 M6\nG0 X40. Y20.\nZ5.\nG1 Z-5. F300.\nG41 D1 X30. Y10.\nG3 X40. Y0. R10.\n"
    "G1 X72.\nG3 X80. Y8. R8.\nG1 Y42.\nG3 X72. Y50. R8.\nG1 X8.\nG3 X0. Y42. R8.\nG1 Y8.\nG3 X8. Y0. R8.\nG1 X40.\n"
    "G3 X50. Y10. R10.\nG1 G40 X40. Y20.\nG0 Z50.\nM30\n"
)
"""A pocket of 80 by 50 mm with corners of 8 mm, counterclockwise from the middle of its lower wall."""

CORNER = "G3 X72. Y50. R8."
LINE = 11


def arc_sides(program: str, control: str = "fanuc:a", diameter: float = 6.0) -> list[Finding]:
    """The findings on arcs that another one would replace."""
    run = run_of(program, control, t1=diameter)
    assert run.stopped_at is None, run.findings
    return [finding for finding in judged_findings(judge_run(run)) if finding.code == "ARC-SIDE"]


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "linuxcnc", "rosettacnc:normal", "nine-series:a"])
def test_rounded_corners_are_not_reported(control: str) -> None:
    assert not arc_sides(POCKET, control)


@pytest.mark.parametrize(
    "wrong", ["G3 X72. Y50. R-8.", "G2 X72. Y50. R8.", "G2 X72. Y50. I-8. J0.", "G3 X72. Y50. I0. J8."]
)
def test_a_wrong_sign_direction_or_center_is_a_warning_at_its_line(wrong: str) -> None:
    """By hand: the corner's center is X72 Y42; the center X80 Y50, or the other way around, is square to both walls."""
    (warning,) = arc_sides(POCKET.replace(CORNER, wrong))
    assert (warning.severity, warning.line, warning.at) == (Severity.WARNING, LINE, (76.0, 46.0))
    assert sentence(warning, Unit.MM) == (
        "This arc makes a corner at both ends. The shorter counterclockwise arc of the same radius is tangent there. "
        "Check its direction, center and the sign of R."
    )


def test_a_long_arc_that_should_be_one_is_described_as_longer() -> None:
    """A round head on a bar: its two fillets are tangent, and so is the head itself where R has its minus sign."""
    # by hand: the fillet of 4 about Y8+4 touches the bar at X and the head of 20 at 24 from its middle
    side = (24.0**2 - 12.0**2) ** 0.5
    x, y = side * 20.0 / 24.0, 12.0 * 20.0 / 24.0
    head = (
        f"G21 G17 G90 G40\nT1 M6\nG0 X80. Y30.\nZ5.\nG1 Z-5. F300.\nG42 D1 X70. Y8.\nX{side:.4f}\n"
        f"G2 X{x:.4f} Y{y:.4f} R4.\nG3 X{x:.4f} Y-{y:.4f} R{{sign}}20.\nG2 X{side:.4f} Y-8. R4.\nG1 X60.\nY-30.\n"
        "G40 X80.\nG0 Z50.\nM30\n"
    )
    assert not arc_sides(head.format(sign="-"))
    (warning,) = arc_sides(head.format(sign=""))
    assert warning.line == 9
    assert "The longer counterclockwise arc" in warning.text


def test_corners_that_are_all_scalloped_are_only_a_note() -> None:
    """Four arcs about the corners themselves: probably meant so."""
    plaque = POCKET.replace("G3 X80.", "G2 X80.").replace("G3 X72.", "G2 X72.")
    (note,) = arc_sides(plaque.replace("G3 X0.", "G2 X0.").replace("G3 X8.", "G2 X8."))
    assert (note.severity, note.line) == (Severity.INFO, 9)


def test_a_single_scallop_is_doubtful() -> None:
    """The only arc of a contour has no other one to compare it with: it may be a swapped G2 and G3."""
    plate = (
        "G21 G17 G90 G40\nT1 M6\nG0 X-30. Y-30.\nZ5.\nG1 Z-5. F300.\nG41 D1 X0. Y-10.\nY50.\nX72.\n{}G1 Y0.\nX-10.\n"
    )
    plate += "G40 X-30. Y-30.\nG0 Z50.\nM30\n"
    for more in ("", "G1 Y8.\nG2 X72. Y0. R8.\n"):
        (warning,) = arc_sides(plate.format(f"G3 X80. Y42. R8.\n{more}"))
        assert (warning.severity, warning.line) == (Severity.WARNING, 9)
    assert not arc_sides(plate.format("G2 X80. Y42. R8.\n"))


def test_an_arc_without_a_tangent_alternative_is_not_reported() -> None:
    """A half-round notch in a straight wall is square to it whichever side it is on."""
    notch = POCKET.replace("G1 X8.\n", "G1 X50.\nG2 X30. R10.\nG1 X8.\n")
    assert not arc_sides(notch)


def test_klartext_arcs_are_compared_too() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X-20 Y-30 Z+5 R0 FMAX\nL Z-5 F300\nL X+0 Y-10 RL\nL Y+40\n"
        "CR X+10 Y+50 R{}10 DR-\nL X+60\nL Y+0\nL X-10\nL X-20 Y-30 R0\nL Z+50 FMAX\nEND PGM A MM\n"
    )
    assert not arc_sides(program.format("+"), "heidenhain")
    assert [finding.line for finding in arc_sides(program.format("-"), "heidenhain")] == [7]
