"""An ARC is solved from the typed fields; an end that reads like the start never silently gives the wrong arc."""

from __future__ import annotations

import re
from math import cos, dist, hypot, radians, sin, tau

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from core.finding import Severity
from core.geometry.piece import Arc, Turn
from core.program.edit import set_unit
from core.program.model import ArcSegment
from core.program.solve.block import solve_block
from core.program.solve.solved import SolvedBlock, SolvedSegment
from core.units import Kind, Unit, sentence, show
from tests.core.program.parts import arc, line, number, program, tags


def solved(segment: ArcSegment, x: float = 0.0, y: float = 0.0) -> SolvedSegment:
    """The segment as the only one of a metric block that starts at x, y."""
    given_program = program(segment, x=x, y=y)
    return solve_block(given_program.blocks[0], given_program).segments[0]


def text(segment: SolvedSegment) -> str:
    (finding,) = segment.findings
    return f"{finding.code} {finding.field}: {sentence(finding, Unit.MM)}"


QUARTER = Arc((5.0, 0.0), (0.0, 5.0), (0.0, 0.0), Turn.CCW)
"""A quarter turn about the origin from X 5."""


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
def test_enough_data_determine_the_arc(typed):
    result = solved(arc("CCW", **typed), 5.0, 0.0)
    assert result.findings == ()
    assert isinstance(result.piece, Arc)
    assert dist(result.piece.end, QUARTER.end) < 1e-9
    assert dist(result.piece.center, QUARTER.center) < 1e-9
    assert result.piece.turn is Turn.CCW
    assert number(result, "radius") == pytest.approx(5.0)
    assert number(result, "sweep") == pytest.approx(90.0)


def test_calculated_fields_are_tagged_cal():
    result = solved(arc("CCW", x_end=0.0, y_end=5.0, x_center=0.0, y_center=0.0), 5.0, 0.0)
    calculated = {name for name, tag in tags(result).items() if tag == "CAL"}
    assert calculated == {"z_end", "radius", "sweep", "start_angle", "feed"}


def test_the_opposite_direction_takes_the_long_way():
    result = solved(arc("CW", x_end=0.0, y_end=5.0, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert number(result, "sweep") == pytest.approx(270.0)


@pytest.mark.parametrize("direction", ["CW", "CCW"])
def test_end_and_radius_offer_the_shorter_arc_first(direction):
    result = solved(arc(direction, x_end=0.0, y_end=5.0, radius=5.0), 5.0, 0.0)
    assert text(result) == "PICK_SOLUTION choice: Two solutions fit: pick one on SOLUTION."
    assert [abs(piece.sweep) for piece in result.choices if isinstance(piece, Arc)] == [
        pytest.approx(tau / 4),
        pytest.approx(tau * 3 / 4),
    ]
    assert result.sketch == result.choices[0]
    long = solved(arc(direction, x_end=0.0, y_end=5.0, radius=5.0, choice=1), 5.0, 0.0)
    assert long.piece == result.choices[1]


def test_a_typed_sweep_selects_the_arc():
    short = solved(arc("CW", x_end=0.0, y_end=5.0, radius=5.0, sweep=90.0), 5.0, 0.0)
    long = solved(arc("CW", x_end=0.0, y_end=5.0, radius=5.0, sweep=270.0), 5.0, 0.0)
    assert isinstance(short.piece, Arc)
    assert isinstance(long.piece, Arc)
    assert dist(short.piece.center, (5.0, 5.0)) < 1e-9
    assert dist(long.piece.center, (0.0, 0.0)) < 1e-9


def test_a_half_circle_needs_no_choice():
    result = solved(arc("CW", x_end=10.0, y_end=0.0, radius=5.0))
    assert result.findings == ()
    assert result.piece == Arc((0.0, 0.0), (10.0, 0.0), (5.0, 0.0), Turn.CW)


@pytest.mark.parametrize(
    "typed",
    [
        {"x_end": 5.0, "y_end": 0.0, "x_center": 0.0, "y_center": 0.0},
        {"x_center": 0.0, "y_center": 0.0, "sweep": 360.0},
        {"x_center": 0.0, "y_center": 0.0, "y_end": 0.0, "sweep": 360.0},
        {"radius": 5.0, "x_center": 0.0, "sweep": 360.0},
    ],
)
def test_data_of_a_full_circle_make_one(typed):
    result = solved(arc("CW", **typed), 5.0, 0.0)
    assert result.findings == ()
    assert isinstance(result.piece, Arc)
    assert result.piece.end == result.piece.start == (5.0, 0.0)
    assert result.piece.sweep == -tau
    assert number(result, "sweep") == 360.0


def test_different_radii_are_refused_with_both_values():
    result = solved(arc("CCW", x_end=0.0, y_end=5.01, x_center=0.0, y_center=0.0), 5.0, 0.0)
    words = "The arc's radius is 5.000 at its start and 5.010 at its end: correct the end or the center."
    assert text(result) == f"RADII_DIFFER x_center: {words}"
    assert result.piece is None
    assert result.end is None


def test_radii_that_differ_at_the_limit_are_shown_with_enough_digits():
    result = solved(arc("CCW", x_end=0.0, y_end=5.00264, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert text(result).split(": ")[1] == "The arc's radius is 5.0000 at its start and 5.0026 at its end"


def test_radii_that_differ_by_rounding_give_an_exact_arc_and_a_message():
    result = solved(arc("CCW", x_end=0.0, y_end=5.0025, x_center=0.0, y_center=0.0), 5.0, 0.0)
    assert text(result) == "ARC_ADJUSTED None: Radius 5.0000 at start, 5.0025 at end: the arc is fitted to both."
    assert result.findings[0].severity is Severity.INFO
    assert isinstance(result.piece, Arc)
    assert dist(result.piece.center, result.piece.start) == pytest.approx(dist(result.piece.center, result.piece.end))
    assert number(result, "x_center") == 0.0


def test_a_radius_that_misses_the_end_by_rounding_is_reported():
    result = solved(arc("CCW", x_end=-5.0, y_end=0.0, radius=4.999), 5.0, 0.0)
    assert text(result) == "ARC_ADJUSTED None: RADIUS 4.999 does not fit the other numbers: 5.000 is used."
    assert isinstance(result.piece, Arc)
    assert result.piece.radius == 5.0


def test_fitted_arcs_are_reported_once_at_the_largest_difference():
    ends = [(0.0, 5.0001), (-5.0, 0.02), (0.0, -5.0)]
    arcs = [arc("CCW", x_end=x, y_end=y, x_center=0.0, y_center=0.0) for x, y in ends]
    part = program(*arcs, x=5.0)
    findings = solve_block(part.blocks[0], part).all_findings
    assert [(finding.code, finding.segment) for finding in findings] == [("ARC_ADJUSTED", 1)]
    assert sentence(findings[0], Unit.MM) == (
        "Radius 5.0000 at start, 5.0001 at end: the arc is fitted to both. 2 more arcs differ by less."
    )


def test_exact_arcs_are_not_adjusted():
    result = solved(arc("CCW", x_end=3.0, y_end=4.0, x_center=0.0, y_center=0.0, radius=5.0, sweep=53.130102), 5.0, 0.0)
    assert result.findings == ()


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
            "x_end: The arc's radius is 5.000: it does not reach X END 6.000.",
        ),
        (
            {"x_center": 5.0, "y_center": 0.0, "sweep": 90.0},
            "x_center: X CENTER and Y CENTER are the same as the start: an arc needs a radius.",
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
    result = solved(arc("CCW", **typed), 5.0, 0.0)
    assert result.piece is None
    assert text(result) == f"CONTRADICTION {words}"


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
def test_missing_data_are_named(typed, missing, words):
    result = solved(arc("CCW", **typed), 5.0, 0.0)
    assert result.piece is None
    assert result.missing == missing
    assert text(result) == f"MISSING {missing[0]}: More data needed: {words}"


def test_a_center_coordinate_along_the_chord_determines_nothing_if_the_start_is_rounded():
    result = solved(arc("CW", x_end=20.0, y_end=0.0, x_center=10.0001), 0.0, 0.00004)
    assert result.piece is None
    assert text(result).startswith("MISSING y_center: More data needed: type the end and the center, ")


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
@example(start=(0.0, 0.0), center=(21.0, 0.002), sweep=90.0, direction="CW")
def test_calculated_fields_give_the_arc_again(start, center, sweep, direction):
    assume(dist(start, center) > 1.0)
    whole = solved(arc(direction, x_center=center[0], y_center=center[1], sweep=sweep), *start)
    assert isinstance(whole.piece, Arc)
    assert abs(whole.piece.sweep) == pytest.approx(radians(sweep))
    for names in GIVEN:
        result = solved(arc(direction, **{name: number(whole, name) for name in names}), *start)
        candidates = result.choices or (result.piece,)
        assert result.findings == () or len(result.choices) == 2
        assert any(
            isinstance(piece, Arc)
            and dist(piece.end, whole.piece.end) < 1e-4
            and dist(piece.center, whole.piece.center) < 1e-4
            for piece in candidates
        )


INCH = 25.4
SHOWN = {Unit.IN: (1.4142, 1.4142, 2.4142), Unit.MM: (1.414, 1.414, 2.414)}
"""The end of a line of 2 at 45 degrees as a field shows it, X and Y, and the Y one above."""

UNITS = pytest.mark.parametrize("unit", list(Unit))
DIRECTIONS = pytest.mark.parametrize("direction", ["CW", "CCW"])


def second(segment: ArcSegment, unit: Unit) -> tuple[SolvedBlock, SolvedSegment]:
    """The block and its second segment, which follows a line of 2 at 45 degrees."""
    given_program = program(line(length=2.0, angle=45.0, feed=5.0), segment, unit=unit)
    block = solve_block(given_program.blocks[0], given_program)
    return block, block.segments[1]


def messages(result: SolvedSegment, unit: Unit) -> list[tuple[Severity, str, str]]:
    """The messages of the segment, except that of a radius typed with few digits."""
    return [
        (finding.severity, finding.code, sentence(finding, unit))
        for finding in result.findings
        if finding.code != "ARC_ADJUSTED"
    ]


def is_full(result: SolvedSegment) -> bool:
    return isinstance(result.piece, Arc) and result.piece.start == result.piece.end and abs(result.piece.sweep) == tau


READS = "X END and Y END read like the arc's start: it is the full circle, and ends where it starts. "
LESS = "For a shorter arc blank X END and Y END and enter SWEEP ANGLE."


@UNITS
@DIRECTIONS
@pytest.mark.parametrize("axes", ["xy", "x", "y"])
@pytest.mark.parametrize("radius", [False, True])
def test_an_end_typed_as_the_screen_shows_the_start_is_the_full_circle(unit, direction, axes, radius):
    x, y, above = SHOWN[unit]
    typed = {"x_center": x, "y_center": above} | {name: value for name, value in (("x_end", x), ("y_end", y))}
    typed = {name: value for name, value in typed.items() if not name.endswith("_end") or name[0] in axes}
    if axes == "x":
        # an end in X alone leaves two: the other side of the circle, and the start again
        typed["choice"] = 1
    if radius:
        typed["radius"] = 1.0
    block, result = second(arc(direction, **typed), unit)
    assert is_full(result)
    assert result.end == result.start == block.segments[0].end
    assert number(result, "sweep") == 360.0
    fields = {"xy": "X END and Y END read", "x": "X END reads", "y": "Y END reads"}[axes]
    blank = {"xy": "X END and Y END", "x": "X END", "y": "Y END"}[axes]
    words = READS.replace("X END and Y END read", fields) + LESS.replace("X END and Y END", blank)
    assert messages(result, unit) == [(Severity.INFO, "FULL_CIRCLE", words)]


@UNITS
@DIRECTIONS
def test_sweep_angle_360_makes_a_full_circle_without_a_message(unit, direction):
    x, y, above = SHOWN[unit]
    for end in ({"x_end": x, "y_end": y}, {"y_end": y}, {}):
        _, result = second(arc(direction, x_center=x, y_center=above, sweep=360.0, **end), unit)
        assert is_full(result)
        assert result.findings == ()


@UNITS
@DIRECTIONS
@pytest.mark.parametrize("off", [1.0, -1.0])
def test_an_end_a_digit_or_two_from_the_start_raises_a_question_that_sweep_angle_answers(unit, direction, off):
    x, y, above = SHOWN[unit]
    step = {Unit.IN: 0.00008, Unit.MM: 0.002}[unit]
    end = {"x_end": x + off * step, "y_end": y, "x_center": x, "y_center": above}
    _, result = second(arc(direction, **end), unit)
    assert result.piece is None
    assert result.missing == ("sweep",)
    ((severity, code, text),) = messages(result, unit)
    assert (severity, code) == (Severity.ERROR, "CIRCLE_OR_ARC")
    question = re.fullmatch(
        r"The end is (0\.\d+) from the start: full circle or (short arc|arc to that end)\? "
        r"Type SWEEP ANGLE 360 or (\d+\.\d+)\.",
        text,
    )
    assert question
    assert (question[2] == "short arc") is (float(question[3]) < 180.0)
    _, full = second(arc(direction, **end, sweep=360.0), unit)
    assert is_full(full)
    assert full.end == full.start
    ((severity, code, text),) = messages(full, unit)
    assert (severity, code) == (Severity.INFO, "FULL_CIRCLE")
    assert re.search(r"it ends where it starts, 0\.\d+ from X END and Y END\.$", text)
    _, part = second(arc(direction, **end, sweep=float(question[3])), unit)
    assert isinstance(part.piece, Arc)
    scale = INCH if unit is Unit.IN else 1.0
    # the end is on the circle, as near to the typed end as radii may differ
    assert dist(part.piece.end, ((x + off * step) * scale, y * scale)) < 0.00254
    assert [code for _, code, _ in messages(part, unit)] == ["SHORT_ARC"]
    _, neither = second(arc(direction, **end, sweep=90.0), unit)
    assert messages(neither, unit) == messages(result, unit)


def after_line_to(end: tuple[float, float], segment: ArcSegment) -> SolvedSegment:
    """The segment after a line from 0, 0 to a typed end."""
    given_program = program(line(x_end=end[0], y_end=end[1]), segment)
    return solve_block(given_program.blocks[0], given_program).segments[1]


X_NEAR_START = {"x_end": 17.321, "x_center": 0.0, "y_center": 0.0}
"""From 17.3205, 10 two ends on the circle of 20 have this X: one a micrometer from the start, one at 60 degrees."""


def test_a_typed_sweep_selects_the_other_end_when_one_is_close_to_the_start():
    result = after_line_to((17.3205, 10.0), arc("CW", **X_NEAR_START, sweep=60.0))
    assert result.findings == ()
    assert isinstance(result.piece, Arc)
    assert dist(result.piece.end, (17.321, -9.9991)) < 1e-4
    full = after_line_to((17.3205, 10.0), arc("CW", **X_NEAR_START, sweep=360.0))
    assert is_full(full)
    short = after_line_to((17.3205, 10.0), arc("CW", **X_NEAR_START, sweep=0.003))
    assert isinstance(short.piece, Arc)
    assert dist(short.piece.end, (17.321, 9.9991)) < 1e-4


@pytest.mark.parametrize("typed", [{}, {"choice": 0}, {"sweep": 90.0}])
def test_the_question_names_the_sweep_angle_of_the_other_end_too(typed):
    result = after_line_to((17.3205, 10.0), arc("CW", **X_NEAR_START, **typed))
    assert result.piece is None
    assert text(result) == (
        "CIRCLE_OR_ARC sweep: The end is 0.001 from the start: full circle, short arc or arc to the other end? "
        "Type SWEEP ANGLE 360, 0.003 or 59.997."
    )


def test_the_full_circle_says_that_it_does_not_end_at_its_typed_end():
    result = solved(arc("CW", x_end=0.001, y_end=0.0, x_center=20.0, y_center=0.0, sweep=360.0))
    assert is_full(result)
    assert result.findings[0].severity is Severity.INFO
    assert text(result) == (
        "FULL_CIRCLE sweep: SWEEP ANGLE 360 makes the full circle: it ends where it starts, 0.001 from X END and Y END."
    )


@pytest.mark.parametrize(("off", "codes"), [(4e-6, []), (6e-6, ["ARC_ADJUSTED"])])
def test_radii_that_differ_by_less_than_half_a_posted_digit_are_not_reported(off, codes):
    ends = {"x_end": 0.0, "y_end": 5.0 + off, "x_center": 0.0, "y_center": 0.0}
    assert [finding.code for finding in solved(arc("CCW", **ends), 5.0, 0.0).findings] == codes
    half = {"x_end": -5.0, "y_end": 0.0, "radius": 5.0 - off}
    assert [finding.code for finding in solved(arc("CCW", **half), 5.0, 0.0).findings] == codes


@pytest.mark.parametrize("end", [7.071, 7.0711, 7.07107])
def test_a_circle_after_a_full_circle_starts_at_the_start_of_the_first(end):
    """The start is calculated, whatever end was typed for the first circle."""
    first = arc("CW", x_end=7.071, y_end=7.071, x_center=7.071, y_center=20.0)
    other = arc("CW", x_end=end, y_end=end, x_center=7.071, y_center=17.0)
    given_program = program(line(length=10.0, angle=45.0), first, other)
    segments = solve_block(given_program.blocks[0], given_program).segments
    assert [is_full(segment) for segment in segments[1:]] == [True, True]
    assert segments[2].end == segments[0].end


def test_an_arc_of_93_nanometers_does_not_become_a_circle_of_52_meters():
    end = {"x_end": 100.000093, "y_end": 50.0, "x_center": 100.0, "y_center": 8326.0}
    given_program = program(arc("CCW", **end), x=100.0, y=50.0)
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    assert result.piece is None
    ((_, code, text),) = messages(result, Unit.MM)
    assert code == "CIRCLE_OR_ARC"
    assert text == "The end is 0.0001 from the start: full circle or short arc? Type SWEEP ANGLE 360 or 0.00000064."
    given_program = program(arc("CCW", **end, sweep=0.00000064), x=100.0, y=50.0)
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    assert isinstance(result.piece, Arc)
    assert result.piece.length == pytest.approx(0.000093, rel=1e-3)


@UNITS
@pytest.mark.parametrize("digit", [1e-9, 2e-7, 1e-6, 1e-5])
def test_a_typed_end_that_differs_from_the_typed_start_in_any_digit_raises_a_question(unit, digit):
    """An end nearer than 0.1 nm, the limit for telling points apart, is the start."""
    for off in (digit, -digit):
        segment = arc("CW", x_end=0.5 + off, y_end=0.25, x_center=0.5, y_center=1.0)
        given_program = program(segment, unit=unit, x=0.5, y=0.25)
        (result,) = solve_block(given_program.blocks[0], given_program).segments
        if digit == 1e-9:
            assert is_full(result)
            assert result.findings == ()
        else:
            assert [finding.code for finding in result.findings] == ["CIRCLE_OR_ARC"]


@UNITS
def test_digits_beyond_those_the_screen_shows_of_a_calculated_start_count(unit):
    """The start is 1.41421356...: 1.41421 is the start typed with one more digit, 1.41424 is not."""
    x, y, above = SHOWN[unit]
    _, result = second(arc("CW", x_end=1.41421, y_end=1.4142136, x_center=x, y_center=above), unit)
    assert is_full(result)
    assert [code for _, code, _ in messages(result, unit)] == ["FULL_CIRCLE"]
    _, result = second(arc("CW", x_end=1.41424, y_end=y, x_center=x, y_center=above), unit)
    assert [code for _, code, _ in messages(result, unit)] == ["CIRCLE_OR_ARC"]


@UNITS
@DIRECTIONS
def test_a_full_circle_stays_one_when_the_unit_changes(unit, direction):
    x, y, above = SHOWN[unit]
    segment = arc(direction, x_end=x, y_end=y, x_center=x, y_center=above)
    given_program = program(line(length=2.0, angle=45.0, feed=5.0), segment, unit=unit)
    turned = set_unit(given_program, Unit.MM if unit is Unit.IN else Unit.IN)
    assert is_full(solve_block(turned.blocks[0], turned).segments[1])


def test_an_end_near_the_start_in_x_alone_raises_a_question():
    """Only the X of an end near the start is typed: the end may be the start or a point near it."""
    given_program = program(arc("CW", x_end=0.001, x_center=3.0, y_center=4.0))
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    assert [finding.code for finding in result.findings] == ["CIRCLE_OR_ARC"]


@UNITS
@DIRECTIONS
@pytest.mark.parametrize("sweep", [0.001, 0.0005, 359.9994, 359.998])
def test_a_tiny_arc_typed_by_sweep_angle_is_reported(unit, direction, sweep):
    x, y, above = SHOWN[unit]
    for end in ({}, {"x_end": x, "y_end": y}):
        _, result = second(arc(direction, x_center=x, y_center=above, sweep=sweep, **end), unit)
        ((severity, code, text),) = messages(result, unit)
        assert severity is Severity.WARNING
        if sweep == 359.9994:
            # it shows as 359.999, and no visible digit separates its end from the start
            assert is_full(result)
            assert code == "FULL_CIRCLE"
            continue
        assert isinstance(result.piece, Arc)
        assert abs(result.piece.sweep) == pytest.approx(radians(sweep), abs=3e-4)
        assert code == "SHORT_ARC"
        assert text.endswith("Enter SWEEP ANGLE 360 if the full circle is meant.")


@UNITS
@DIRECTIONS
@pytest.mark.parametrize("off", [0.0, 1.0])
@pytest.mark.parametrize(
    "typed",
    [
        {"radius": 1.0},
        {"radius": 1.0, "choice": 0},
        {"radius": 1.0, "choice": 1},
        {"sweep": 90.0},
        {"sweep": 360.0},
        {"sweep": 359.99},
        {"x_center": 1.0},
        {"y_center": 3.0},
        {"radius": 1.0, "x_center": 2.0},
        {"radius": 1.0, "sweep": 0.001, "choice": 0},
        {"sweep": 0.001},
    ],
)
def test_an_end_at_the_start_needs_the_center(unit, direction, typed, off):
    """Without both center coordinates, the rounding of the end would decide where the arc lies."""
    block, _ = second(arc(direction), unit)
    x, y, _ = SHOWN[unit]
    exact = [value / (INCH if unit is Unit.IN else 1.0) for value in block.segments[0].end]
    end = {"x_end": x, "y_end": y} if off else {"x_end": exact[0], "y_end": exact[1]}
    _, result = second(arc(direction, **end, **typed), unit)
    assert result.piece is None
    ((severity, code, text),) = messages(result, unit)
    assert (severity, code) == (Severity.ERROR, "MISSING")
    blank = [label for name, label in (("x_center", "X CENTER"), ("y_center", "Y CENTER")) if name not in typed]
    assert text == (
        f"More data needed: the end is at the start. For the full circle type {' and '.join(blank)}; for a shorter "
        "arc the center and SWEEP ANGLE, with X END and Y END blank."
    )
    assert set(result.missing) == {label.lower().replace(" ", "_") for label in blank}


@UNITS
@DIRECTIONS
@pytest.mark.parametrize("sweep", [0.0005, 359.9995])
@pytest.mark.parametrize("name", ["x_end", "y_end"])
def test_one_end_coordinate_at_the_start_with_radius_and_sweep_is_not_enough(unit, direction, sweep, name):
    x, _, _ = SHOWN[unit]
    _, result = second(arc(direction, radius=1.0, sweep=sweep, **{name: x}), unit)
    assert result.piece is None
    assert [finding.code for finding in result.findings] == ["MISSING"]


def test_an_end_at_the_start_with_radius_and_a_sweep_of_360_makes_a_full_circle():
    x, y, above = SHOWN[Unit.IN]
    end = {"x_end": x, "y_end": y}
    _, result = second(arc("CW", radius=1.0, sweep=360.0, y_center=above, x_center=x, **end), Unit.IN)
    assert is_full(result)
    given_program = program(arc("CW", radius=1.0, sweep=360.0, x_center=1.0, x_end=0.0, y_end=0.0))
    (segment,) = solve_block(given_program.blocks[0], given_program).segments
    assert is_full(segment)


@UNITS
def test_an_end_exactly_at_the_start_makes_a_full_circle(unit):
    given_program = program(arc("CW", x_end=0.0, y_end=0.0, x_center=1.0, y_center=0.0), unit=unit)
    block = solve_block(given_program.blocks[0], given_program)
    assert is_full(block.segments[0])
    assert block.closed
    assert block.all_findings == ()


def test_a_sweep_that_shows_360_but_leaves_a_gap_is_no_full_circle():
    _, result = second(arc("CW", x_center=1.4142, y_center=101.4142, sweep=359.999), Unit.IN)
    assert isinstance(result.piece, Arc)
    assert dist(result.piece.start, result.piece.end) > 0.04
    assert abs(result.piece.sweep) == pytest.approx(radians(359.999))


def test_an_end_that_misses_the_start_by_slightly_more_is_reported():
    """An end a few digits from the start may still mean the full circle."""
    start = 2.0 / 2.0**0.5
    _, result = second(arc("CW", x_end=start - 0.0005, y_end=start, x_center=start, y_center=start + 1.0), Unit.IN)
    assert isinstance(result.piece, Arc)
    ((severity, code, text),) = messages(result, Unit.IN)
    assert (severity, code) == (Severity.WARNING, "SHORT_ARC")
    assert text == (
        "The arc ends only 0.0005 from its start and turns 0.029 degrees. Enter SWEEP ANGLE 360 if the full circle is "
        "meant."
    )


@UNITS
def test_an_end_coordinate_at_the_extreme_of_the_circle_leaves_no_choice(unit):
    """At the extreme of the circle an end in X alone is the start itself, not a choice of two zero-length arcs."""
    given_program = program(arc("CW", x_end=1e-13, x_center=1.0, y_center=0.0), unit=unit)
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    assert is_full(result)
    assert result.choices == ()


@settings(derandomize=True, max_examples=300, deadline=None)
@given(
    st.floats(0.0, tau),
    st.floats(0.001, 500.0),
    st.floats(-2.0, 2.0),
    st.floats(-2.0, 2.0),
    st.sampled_from(["CW", "CCW"]),
    st.sampled_from(list(Unit)),
)
def test_no_arc_that_ends_near_its_start_goes_unreported(angle, radius, dx, dy, direction, unit):
    """An end typed near the start makes an exact full circle or raises a finding."""
    places = 4 if unit is Unit.IN else 3
    digit = 10.0**-places
    start = (radius * cos(angle), radius * sin(angle))
    end = (round(start[0] + dx * digit, places), round(start[1] + dy * digit, places))
    typed = {"x_end": end[0], "y_end": end[1], "x_center": 0.0, "y_center": 0.0}
    given_program = program(arc(direction, **typed), x=start[0], y=start[1], unit=unit)
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    same = all(show(a, Kind.LENGTH, unit) == show(b, Kind.LENGTH, unit) for a, b in zip(start, end, strict=True))
    if is_full(result):
        exact = hypot(start[0] - end[0], start[1] - end[1]) * (INCH if unit is Unit.IN else 1.0) <= 1e-7
        assert exact or [finding.code for finding in result.findings] == ["FULL_CIRCLE"]
    else:
        assert result.findings != ()
        assert not same or any(finding.severity is Severity.ERROR for finding in result.findings)


@settings(derandomize=True, max_examples=200, deadline=None)
@given(st.floats(0.0, tau), st.floats(0.001, 500.0), st.floats(1e-4, 360.0), st.sampled_from(list(Unit)), st.booleans())
def test_the_arc_turns_through_the_typed_sweep(angle, radius, sweep, unit, near):
    """An arc that ends near its start is reported."""
    turned = 360.0 - sweep / 1000.0 if near else sweep
    start = (radius * cos(angle), radius * sin(angle))
    segment = arc("CCW", x_center=0.0, y_center=0.0, sweep=turned)
    given_program = program(segment, x=start[0], y=start[1], unit=unit)
    (result,) = solve_block(given_program.blocks[0], given_program).segments
    if isinstance(result.piece, Arc):
        off = abs(abs(result.piece.sweep) - radians(turned)) * result.piece.radius
        assert off <= 0.00254 + 1e-6
        beside = dist(result.piece.start, result.piece.end) <= 0.00254
        assert bool(result.findings) is (beside and turned != 360.0)
    else:
        assert result.findings != ()
