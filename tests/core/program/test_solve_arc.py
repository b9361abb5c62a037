"""An ARC from what is typed of it."""

from __future__ import annotations

from math import dist, radians, tau

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.finding import Severity
from core.geometry.piece import Arc, Turn
from core.program.model import ArcSegment
from core.program.solve.block import solve_block
from core.program.solve.solved import SolvedSegment
from core.units import Unit, sentence
from tests.core.program.parts import arc, number, program, tags


def solved(segment: ArcSegment, x: float = 0.0, y: float = 0.0) -> SolvedSegment:
    """The segment as the only one of a metric block that starts at x, y."""
    given_program = program(segment, x=x, y=y)
    return solve_block(given_program.blocks[0], given_program).segments[0]


def text(segment: SolvedSegment) -> str:
    (finding,) = segment.findings
    return f"{finding.code} {finding.field}: {sentence(finding, Unit.MM)}"


QUARTER = Arc((5.0, 0.0), (0.0, 5.0), (0.0, 0.0), Turn.CCW)
"""From X 5 a quarter turn about the origin."""


@pytest.mark.parametrize(
    "typed",
    [
        {"x_end": 0.0, "y_end": 5.0, "x_center": 0.0, "y_center": 0.0},
        {"x_end": 0.0, "y_end": 5.0, "x_center": 0.0, "y_center": 0.0, "radius": 5.0, "sweep": 90.0},
        {"x_center": 0.0, "y_center": 0.0, "sweep": 90.0},
        {"x_center": 0.0, "y_center": 0.0, "y_end": 5.0},
        {"x_center": 0.0, "y_center": 0.0, "x_end": 0.0, "choice": 0},
        {"x_center": 0.0, "y_center": 0.0, "x_end": 0.0, "sweep": 90.0},
        {"x_end": 0.0, "y_end": 5.0, "radius": 5.0, "choice": 0},
        {"x_end": 0.0, "y_end": 5.0, "radius": 5.0, "sweep": 90.0},
        {"x_end": 0.0, "y_end": 5.0, "radius": 5.0, "y_center": 0.0},
        {"x_end": 0.0, "y_end": 5.0, "sweep": 90.0},
        {"x_end": 0.0, "y_end": 5.0, "x_center": 0.0},
        {"x_end": 0.0, "y_end": 5.0, "y_center": 0.0},
        {"radius": 5.0, "sweep": 90.0, "x_center": 0.0},
        {"radius": 5.0, "sweep": 90.0, "y_center": 0.0, "choice": 1},
        {"radius": 5.0, "sweep": 90.0, "x_end": 0.0, "choice": 0},
        {"radius": 5.0, "sweep": 90.0, "y_end": 5.0, "choice": 1},
    ],
)
def test_solves(typed):
    found = solved(arc("CCW", **typed), 5.0, 0.0)
    assert found.findings == ()
    assert isinstance(found.piece, Arc)
    assert dist(found.piece.end, QUARTER.end) < 1e-9
    assert dist(found.piece.center, QUARTER.center) < 1e-9
    assert found.piece.turn is Turn.CCW
    assert number(found, "radius") == pytest.approx(5.0)
    assert number(found, "sweep") == pytest.approx(90.0)


def test_what_was_typed_and_what_was_calculated():
    found = solved(arc("CCW", x_end=0.0, y_end=5.0, x_center=0.0, y_center=0.0), 5.0, 0.0)
    calculated = {name for name, tag in tags(found).items() if tag == "CAL"}
    assert calculated == {"z_end", "radius", "sweep", "feed"}


def test_the_other_way_round_is_the_long_way():
    found = solved(arc("CW", x_end=0.0, y_end=5.0, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert number(found, "sweep") == pytest.approx(270.0)


@pytest.mark.parametrize("direction", ["CW", "CCW"])
def test_end_and_radius_offer_the_shorter_arc_first(direction):
    found = solved(arc(direction, x_end=0.0, y_end=5.0, radius=5.0), 5.0, 0.0)
    assert text(found) == "PICK_SOLUTION choice: Two solutions fit: pick one on SOLUTION."
    assert [abs(piece.sweep) for piece in found.choices if isinstance(piece, Arc)] == [
        pytest.approx(tau / 4),
        pytest.approx(tau * 3 / 4),
    ]
    assert found.sketch == found.choices[0]
    long = solved(arc(direction, x_end=0.0, y_end=5.0, radius=5.0, choice=1), 5.0, 0.0)
    assert long.piece == found.choices[1]


def test_a_typed_sweep_picks():
    short = solved(arc("CW", x_end=0.0, y_end=5.0, radius=5.0, sweep=90.0), 5.0, 0.0)
    long = solved(arc("CW", x_end=0.0, y_end=5.0, radius=5.0, sweep=270.0), 5.0, 0.0)
    assert isinstance(short.piece, Arc)
    assert isinstance(long.piece, Arc)
    assert dist(short.piece.center, (5.0, 5.0)) < 1e-9
    assert dist(long.piece.center, (0.0, 0.0)) < 1e-9


def test_a_half_circle_needs_no_picking():
    found = solved(arc("CW", x_end=10.0, y_end=0.0, radius=5.0))
    assert found.findings == ()
    assert found.piece == Arc((0.0, 0.0), (10.0, 0.0), (5.0, 0.0), Turn.CW)


@pytest.mark.parametrize(
    "typed",
    [
        {"x_end": 5.0, "y_end": 0.0, "x_center": 0.0, "y_center": 0.0},
        {"x_center": 0.0, "y_center": 0.0, "sweep": 360.0},
        {"x_center": 0.0, "y_center": 0.0, "y_end": 0.0, "sweep": 360.0},
        {"radius": 5.0, "x_center": 0.0, "sweep": 360.0},
    ],
)
def test_a_full_circle(typed):
    found = solved(arc("CW", **typed), 5.0, 0.0)
    assert found.findings == ()
    assert isinstance(found.piece, Arc)
    assert found.piece.end == found.piece.start == (5.0, 0.0)
    assert found.piece.sweep == -tau
    assert number(found, "sweep") == 360.0


def test_radii_that_differ_are_refused_with_both():
    found = solved(arc("CCW", x_end=0.0, y_end=5.01, x_center=0.0, y_center=0.0), 5.0, 0.0)
    words = "The arc's radius is 5.000 at its start and 5.010 at its end: correct the end or the center."
    assert text(found) == f"RADII_DIFFER x_center: {words}"
    assert found.piece is None
    assert found.end is None


def test_radii_that_differ_at_the_limit_are_shown_with_the_digits_that_differ():
    found = solved(arc("CCW", x_end=0.0, y_end=5.00264, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert text(found).split(": ")[1] == "The arc's radius is 5.0000 at its start and 5.0026 at its end"


def test_radii_that_differ_by_rounding_give_an_exact_arc_and_are_told():
    found = solved(arc("CCW", x_end=0.0, y_end=5.0025, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert text(found) == "ARC_ADJUSTED None: Radius 5.0000 at start, 5.0025 at end: the arc is fitted to both."
    assert found.findings[0].severity is Severity.INFO
    assert isinstance(found.piece, Arc)
    assert dist(found.piece.center, found.piece.start) == pytest.approx(dist(found.piece.center, found.piece.end))
    assert number(found, "x_center") == 0.0


def test_a_radius_that_does_not_fit_the_end_by_rounding_is_told():
    found = solved(arc("CCW", x_end=-5.0, y_end=0.0, radius=4.999), 5.0, 0.0)
    assert text(found) == "ARC_ADJUSTED None: RADIUS 4.999 does not fit the other numbers: 5.000 is used."
    assert isinstance(found.piece, Arc)
    assert found.piece.radius == 5.0


def test_arcs_that_are_fitted_are_told_once_where_the_numbers_differ_most():
    ends = [(0.0, 5.0001), (-5.0, 0.002), (0.0, -5.0)]
    arcs = [arc("CCW", x_end=x, y_end=y, x_center=0.0, y_center=0.0) for x, y in ends]
    part = program(*arcs, x=5.0)
    findings = solve_block(part.blocks[0], part).every_finding
    assert [(one.code, one.segment) for one in findings] == [("ARC_ADJUSTED", 1)]
    assert sentence(findings[0], Unit.MM) == (
        "Radius 5.0000 at start, 5.0001 at end: the arc is fitted to both. 2 more arcs differ by less."
    )


def test_exact_arcs_are_fitted_to_nothing():
    found = solved(arc("CCW", x_end=3.0, y_end=4.0, x_center=0.0, y_center=0.0, radius=5.0, sweep=53.130102), 5.0, 0.0)
    assert found.findings == ()


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        (
            {"x_end": 0.0, "y_end": 5.0, "x_center": 0.0, "y_center": 0.0, "radius": 6.0},
            "radius: RADIUS is 6.000, but 5.000 by X END and Y END and X CENTER and Y CENTER: "
            "correct or blank one of them.",
        ),
        (
            {"x_center": 0.0, "y_center": 0.0, "sweep": 90.0, "radius": 6.0},
            "radius: RADIUS is 6.000, but 5.000 by X CENTER and Y CENTER and SWEEP ANGLE: "
            "correct or blank one of them.",
        ),
        (
            {"x_end": 0.0, "y_end": 5.0, "x_center": 0.0, "y_center": 0.0, "sweep": 80.0},
            "sweep: SWEEP ANGLE is 80.000, but 90.000 by X END and Y END and X CENTER and Y CENTER: "
            "correct or blank one of them.",
        ),
        (
            {"x_end": 0.0, "y_end": 5.0, "radius": 2.0},
            "radius: RADIUS 2.000 does not reach the end: it takes 3.536.",
        ),
        (
            {"x_center": 0.0, "y_center": 0.0, "x_end": 6.0},
            "x_end: The arc's radius is 5.000: it does not come to X END 6.000.",
        ),
        (
            {"x_center": 5.0, "y_center": 0.0, "sweep": 90.0},
            "x_center: X CENTER and Y CENTER are the start itself: an arc needs a radius.",
        ),
        (
            {"radius": 1.0, "sweep": 90.0, "x_center": 0.0},
            "radius: RADIUS 1.000 does not reach X CENTER 0.000: it takes at least 5.000.",
        ),
        (
            {"radius": 1.0, "sweep": 180.0, "x_end": 0.0},
            "x_end: RADIUS and SWEEP ANGLE make the end 2.000 from the start: that does not reach X END 0.000.",
        ),
    ],
)
def test_contradictions_name_both_sides(typed, words):
    found = solved(arc("CCW", **typed), 5.0, 0.0)
    assert found.piece is None
    assert text(found) == f"CONTRADICTION {words}"


@pytest.mark.parametrize(
    ("typed", "missing", "words"),
    [
        (
            {},
            ("x_end", "y_end", "x_center", "y_center", "radius", "sweep"),
            "type the end and the center, the end and RADIUS, or the center and SWEEP ANGLE.",
        ),
        ({"x_center": 0.0, "y_center": 0.0}, ("x_end", "y_end", "sweep"), "type X END, Y END or SWEEP ANGLE."),
        (
            {"x_end": 0.0, "y_end": 5.0},
            ("x_center", "y_center", "radius", "sweep"),
            "type X CENTER, Y CENTER, RADIUS or SWEEP ANGLE.",
        ),
        ({"x_end": 0.0, "radius": 5.0}, ("y_end", "sweep"), "type Y END or SWEEP ANGLE."),
        (
            {"x_end": 5.0, "y_end": 0.0, "radius": 5.0},
            ("x_center", "y_center"),
            "the end is at the start. For the full circle type X CENTER and Y CENTER; for a shorter arc the center "
            "and SWEEP ANGLE, with X END and Y END blank.",
        ),
    ],
)
def test_says_what_is_missing(typed, missing, words):
    found = solved(arc("CCW", **typed), 5.0, 0.0)
    assert found.piece is None
    assert found.missing == missing
    assert text(found) == f"MISSING {missing[0]}: More data needed: {words}"


coordinates = st.floats(-50, 50).map(lambda value: round(value, 4))
GIVEN = (
    ("x_end", "y_end", "x_center", "y_center"),
    ("x_center", "y_center", "sweep"),
    ("x_center", "y_center", "x_end", "sweep"),
    ("x_center", "y_center", "y_end", "sweep"),
    ("x_end", "y_end", "radius", "sweep"),
    ("x_end", "y_end", "sweep"),
    ("x_end", "y_end", "x_center", "radius", "sweep"),
)


@settings(derandomize=True, max_examples=200)
@given(
    st.tuples(coordinates, coordinates),
    st.tuples(coordinates, coordinates),
    st.floats(5, 355).filter(lambda sweep: abs(sweep - 180) > 5),
    st.sampled_from(("CW", "CCW")),
)
def test_calculated_fields_give_the_arc_again(start, center, sweep, direction):
    assume(dist(start, center) > 1.0)
    whole = solved(arc(direction, x_center=center[0], y_center=center[1], sweep=sweep), *start)
    assert isinstance(whole.piece, Arc)
    assert abs(whole.piece.sweep) == pytest.approx(radians(sweep))
    for names in GIVEN:
        found = solved(arc(direction, **{name: number(whole, name) for name in names}), *start)
        candidates = found.choices or (found.piece,)
        assert found.findings == () or len(found.choices) == 2
        assert any(
            isinstance(one, Arc)
            and dist(one.end, whole.piece.end) < 1e-4
            and dist(one.center, whole.piece.center) < 1e-4
            for one in candidates
        )
