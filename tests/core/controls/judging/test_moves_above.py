"""Moves above the part: rapids and leads above all cuts are no contour; a warning reports them."""

from __future__ import annotations

from math import dist

import pytest

from core.controls.control_run import ControlRun
from core.controls.judging.judged_findings import judged_findings
from core.controls.judging.judged_runs import judge_run
from core.finding import Finding, Severity
from core.units import Unit, sentence
from tests.core.controls.hand import run_of

ISO = ["fanuc:a", "fanuc:b-arc", "haas:a", "linuxcnc", "rosettacnc:normal"]
RADIUS = 6.0
HEAD = "G21 G17 G90 G40\nT1 M6\nS1000 M3\n"
SQUARE = "G1 Y50.\nX50.\nY0.\nX-10.\n"
"""A square cut outside, from below its corner X0 Y0 to the left of it."""


def judged(text: str, control: str, *, head: str = HEAD) -> tuple[ControlRun, list[Finding]]:
    """The run of a program with a 12 mm tool and its findings."""
    run = run_of(f"{head}{text}M30\n", control, t1=2 * RADIUS)
    assert run.stopped_at is None, run.findings
    return run, list(judged_findings(judge_run(run)))


def codes(findings: list[Finding]) -> list[str]:
    """The codes of warnings and errors."""
    return [finding.code for finding in findings if finding.severity is not Severity.INFO]


def above(findings: list[Finding]) -> list[Finding]:
    """The findings on moves above the part."""
    return [finding for finding in findings if finding.code == "ABOVE"]


def in_and_out(way_in: str, way_out: str, *, up: str = "10.") -> str:
    """The square with these moves in and out."""
    return f"{way_in}{SQUARE}G0 Z{up}\n{way_out}"


AT_DEPTH = "G0 X-20. Y-20.\nG43 H1 Z10.\nG1 Z-2. F200\nG41 D1 G1 X0. Y-10.\n"
IN_THE_AIR = "G0 X25. Y25.\nG43 H1 Z50.\nZ10.\nG41 D1 G0 X0. Y-10.\nG1 Z-2. F200\n"
OUTWARD = "G40 G0 X-30. Y-20.\n"
ACROSS = "G40 G0 X25. Y25.\n"


@pytest.mark.parametrize("control", ISO)
@pytest.mark.parametrize(
    ("program", "line"),
    [
        (in_and_out(AT_DEPTH, OUTWARD), None),
        (in_and_out(AT_DEPTH, ACROSS), 13),
        (in_and_out(AT_DEPTH, ACROSS.replace("G0", "G1")), 13),
        (in_and_out(AT_DEPTH.replace("Z10.", "Z50."), ACROSS), 13),
        (in_and_out(AT_DEPTH.replace("G1 Z-2.", "G0 Z-2.\n"), ACROSS), 14),
        (in_and_out(IN_THE_AIR, OUTWARD), 7),
        (in_and_out(IN_THE_AIR.replace("D1 G0", "D1 F200 G1"), OUTWARD), 7),
    ],
)
def test_a_lead_above_the_part_is_only_a_warning_if_it_passes_over_the_part(
    program: str, line: int | None, control: str
) -> None:
    _, findings = judged(program, control)
    assert codes(findings) == (["ABOVE"] if line else [])
    if line:
        (warning,) = above(findings)
        assert warning.line == line
        text = "The tool passes over the part at Z 10.000 or higher"
        assert sentence(warning, Unit.MM) == f"{text} (line {line}). Check that it clears part and clamps."


NEAR_THE_DEPTH = "G0 X-20. Y-20.\nG43 H1 Z50.\nZ-1.\nG1 Z-2. F200\nG41 D1 G1 X0. Y-10.\n"
PECKED = "G0 X-20. Y-20.\nG43 H1 Z10.\nG1 Z-2. F200\nG0 Z-1.\nG1 Z-4.\nG41 D1 G1 X0. Y-10.\n"
LEAD_BETWEEN = "G0 X-20. Y-20.\nG43 H1 Z10.\nG1 Z-1. F200\nG41 D1 G1 X0. Y-10.\nZ-2.\n"
RAMP = (
    f"G0 X-40. Y-20.\nG43 H1 Z5.\nG1 X-20. Z-5. F200\nG41 D1 G1 X0. Y-10.\n{SQUARE}G40 G1 X-20. Y-20.\n"
    "Z-10.\nG41 D1 G1 X0. Y-10.\n"
)


@pytest.mark.parametrize("control", ISO)
@pytest.mark.parametrize(
    ("way_in", "up"),
    [(AT_DEPTH, "-1."), (NEAR_THE_DEPTH, "-1."), (PECKED, "-1."), (LEAD_BETWEEN, "-1."), (RAMP, "-5."), (RAMP, "4.")],
)
def test_a_lead_below_zero_or_below_a_cut_gouges(way_in: str, up: str, control: str) -> None:
    _, findings = judged(in_and_out(way_in, ACROSS, up=up), control)
    assert "GOUGE" in codes(findings)
    assert not above(findings)


@pytest.mark.parametrize("control", ISO)
def test_a_lead_below_the_depth_of_another_contour_gouges(control: str) -> None:
    high = AT_DEPTH.replace("Z10.", "Z30.").replace("Z-2.", "Z20.")
    low = f"G0 Z30.\nX-20. Y-20.\nG1 Z-2.\nG41 D1 X0. Y-10.\n{SQUARE}"
    _, findings = judged(f"{high}{SQUARE}G40 G1 X-30. Y-20.\n{low}G0 Z10.\n{ACROSS}", control)
    assert "GOUGE" in codes(findings)


@pytest.mark.parametrize("control", ISO)
def test_a_lead_at_the_depth_of_an_earlier_contour_gouges(control: str) -> None:
    first = f"{AT_DEPTH}{SQUARE}G40 G1 X-30. Y-20.\n"
    second = f"G41 D1 X0. Y-10.\nZ-4.\n{SQUARE}G0 Z-2.\n{ACROSS}"
    _, findings = judged(first + second, control)
    assert "GOUGE" in codes(findings)


def between(x: float, link: str = "G0 Z10.\nX-20. Y25.\nX170.\nY-10.\n") -> str:
    """The square and another one on its right at `x`, with compensation on between them."""
    first = f"{AT_DEPTH}G1 Y50.\nX50.\nY0.\nX-20.\n"
    second = f"G1 Z-2.\nX{x}\nY50.\nX{x + 50}\nY-20.\nG0 Z10.\n"
    return f"{first}{link}G0 X{x + 50}\n{second}{OUTWARD}"


@pytest.mark.parametrize("control", ISO)
def test_a_rapid_above_the_part_between_contours_is_no_contour(control: str) -> None:
    _, findings = judged(between(100.0), control)
    assert codes(findings) == ["ABOVE"]
    (warning,) = above(findings)
    assert "(lines 13, 14, 15, 16)" in warning.text


@pytest.mark.parametrize("control", ISO)
@pytest.mark.parametrize("x", [62.5, 61.5, 55.0])
def test_a_contour_gouges_the_contour_cut_before_the_rapid(x: float, control: str) -> None:
    _, findings = judged(between(x), control)
    gouges = [finding for finding in findings if finding.code == "GOUGE"]
    # the center runs a radius left of the wall at x and must stay a radius away from the wall at 50
    missing = 2 * RADIUS - (x - 50.0)
    assert bool(gouges) is (missing > 0.0)
    if gouges:
        assert max(finding.value or 0.0 for finding in gouges) == pytest.approx(missing, abs=1e-6)


@pytest.mark.parametrize("control", ISO)
def test_passes_with_a_rapid_back_under_compensation_are_clean(control: str) -> None:
    back = "G0 Z10.\nX-20. Y-20.\nX0. Y-10.\n"
    passes = "".join(f"{back}G1 Z-{depth}.\n{SQUARE}" for depth in (4, 6))
    _, findings = judged(f"{AT_DEPTH}{SQUARE}{passes}G0 Z10.\n{OUTWARD}", control)
    assert codes(findings) == ["ABOVE"]


@pytest.mark.parametrize("control", ISO)
def test_passes_that_plunge_beyond_the_corner_are_clean(control: str) -> None:
    """Each pass plunges at X-20 Y-20 and moves to the over-run from there without gouging."""
    passes = "".join(f"G0 Z10.\nX-20. Y-20.\nG1 Z-{depth}.\nX0. Y-10.\n{SQUARE}" for depth in (4, 6))
    _, findings = judged(f"{AT_DEPTH}{SQUARE}{passes}G0 Z10.\n{OUTWARD}", control)
    assert {"GOUGE", "WRONG-SIDE"}.isdisjoint(codes(findings))


@pytest.mark.parametrize(
    ("link", "warned"), [("G0 X-20. Y25.\nX170.\nY-10.\n", [22]), ("G0 Z10.\nG1 X-20. Y25.\nX170.\nY-10.\n", [])]
)
def test_moves_that_may_be_a_contour_are_judged_as_one(link: str, warned: list[int]) -> None:
    """A rapid at the depth of the cut, and feed moves above the part without a rapid."""
    _, findings = judged(between(100.0, link), "fanuc:a")
    assert "GOUGE" in codes(findings)
    assert [finding.line for finding in above(findings)] == warned


@pytest.mark.parametrize("control", ISO)
@pytest.mark.parametrize(("y", "wrong"), [("-30.", ["ABOVE"]), ("-10.", ["ABOVE", "GOUGE"])])
def test_a_piece_that_is_only_an_entry_is_judged_against_the_next_contour(
    y: str, wrong: list[str], control: str
) -> None:
    """Calculated by hand: an entry to X0 Y-10 leaves the center at X-2.7 Y-4.6, 5.4 from the corner X0 Y0."""
    around = "G0 Z10.\nX40. Y-40.\nY-60.\nX-60.\nY-5.\nX80.\nY-10.\nX0.\n"
    entry = AT_DEPTH.replace("Y-10.", f"Y{y}")
    _, findings = judged(f"{entry}{around}G1 Z-2.\n{SQUARE}G0 Z10.\n{OUTWARD}", control)
    assert codes(findings) == wrong


STEP = "Y50.\nX50.\nG0 Z3.\nX80.\nG1 Y100.\nX130.\nG40 X100. Y70.\n"
PLUNGE = f"{SQUARE}G0 Z10.\nX-30.\nX-30. Y25.\nX-2.\nG1 Z-2.\nG0 Z10.\nX-30.\nY80.\nG40 X-40.\n"


@pytest.mark.parametrize("behind", [STEP, PLUNGE])
def test_a_feed_move_at_a_step_and_a_plunge_between_rapids_are_judged(behind: str) -> None:
    _, findings = judged(AT_DEPTH + behind, "linuxcnc")
    assert "GOUGE" in codes(findings)
    assert not above(findings)


CLAMP = "Y50.\nX20.\nG0 Z10.\nX30.\nG1 Z-2.\nX50.\nY0.\nX-10.\nG0 Z10.\n"


@pytest.mark.parametrize("control", ISO)
def test_a_rapid_over_a_clamp_along_a_contour_is_clean(control: str) -> None:
    _, findings = judged(AT_DEPTH + CLAMP + OUTWARD, control)
    assert not codes(findings)


@pytest.mark.parametrize("control", ["fanuc:a", "haas:a", "nine-series:a"])
def test_a_plunge_into_a_wall_gouges_at_the_first_move_at_depth(control: str) -> None:
    """The rapid in line 5 ends 5.1 off the wall at X0, but above the part."""
    way_in = "G0 X30. Y30. Z10.\nG41 D1 X5.1 Y6.\nG1 Z-2. F200\nX30. Y6.\nY0.\n"
    _, findings = judged(f"{way_in}X60.\nY60.\nX0.\nY0.\nX30.\nG40 Y30.\nG0 Z10.\n", control)
    assert [finding.line for finding in findings if finding.code == "GOUGE"] == [7]


def test_klartext_leads_above_the_part_cut_nothing() -> None:
    program = (
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 DR+0\nL X-20 Y-20 R0 FMAX\nL Z+10 R0 FMAX\nL Z-2 R0 F200\n"
        "L X+0 Y-10 RL F200\nL Y+50\nL X+50\nL Y+0\nL X-10\nL Z+10 FMAX\nL X+25 Y+25 R0 FMAX\nEND PGM A MM\n"
    )
    run = run_of(program, "heidenhain", t1=2 * RADIUS)
    assert run.stopped_at is None
    findings = list(judged_findings(judge_run(run)))
    assert codes(findings) == ["ABOVE"]
    assert [finding.line for finding in above(findings)] == [12]
    assert dist(run.moves.points[-1].tolist(), (25.0, 25.0, 10.0)) < 1e-9
