"""A LINE is solved from the typed fields."""

from __future__ import annotations

from dataclasses import replace
from math import dist, tau

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.geometry.piece import Arc, Line
from core.program.model import LineSegment, Unread
from core.program.solve.block import solve_block
from core.program.solve.solved import Origin, Solved, SolvedSegment
from core.units import Unit, sentence
from tests.core.program.parts import arc, line, number, program, tags


def solved(segment: LineSegment, x: float = 0.0, y: float = 0.0) -> SolvedSegment:
    """The segment as the only one of a metric block that starts at x, y."""
    given_program = program(segment, x=x, y=y)
    return solve_block(given_program.blocks[0], given_program).segments[0]


def text(segment: SolvedSegment) -> str:
    (finding,) = segment.findings
    return f"{finding.code} {finding.field}: {sentence(finding, Unit.MM)}"


@pytest.mark.parametrize(
    ("typed", "end"),
    [
        ({"x_end": 4.0, "y_end": 5.0}, (4.0, 5.0)),
        ({"length": 5.0, "angle": 90.0}, (1.0, 6.0)),
        ({"x_end": 4.0, "angle": 45.0}, (4.0, 4.0)),
        ({"y_end": 4.0, "angle": 135.0}, (-2.0, 4.0)),
        ({"x_end": 1.0, "angle": 90.0, "length": 2.0}, (1.0, 3.0)),
        ({"x_end": 4.0, "length": 5.0, "choice": 0}, (4.0, 5.0)),
        ({"x_end": 4.0, "length": 5.0, "choice": 1}, (4.0, -3.0)),
        ({"y_end": 4.0, "length": 5.0, "choice": 0}, (5.0, 4.0)),
        ({"x_end": 4.0, "length": 3.0}, (4.0, 1.0)),
        ({"x_end": 4.0, "y_end": 5.0, "length": 5.0, "angle": 53.130}, (4.0, 5.0)),
        ({"x_end": 4.0, "length": 5.0, "angle": -53.130}, (4.0, -3.0)),
    ],
)
def test_enough_data_determine_the_line(typed, end):
    result = solved(line(**typed), 1.0, 1.0)
    assert result.findings == ()
    assert isinstance(result.piece, Line)
    assert dist(result.piece.end, end) < 1e-4
    assert result.piece.start == (1.0, 1.0)


def test_an_end_gives_length_and_angle():
    result = solved(line(x_end=3.0, y_end=-4.0))
    assert number(result, "length") == 5.0
    assert number(result, "angle") == pytest.approx(306.8698976)
    assert tags(result) == {
        "x_end": "typed",
        "y_end": "typed",
        "z_end": "CAL",
        "length": "CAL",
        "angle": "CAL",
        "feed": "CAL",
    }


def test_typed_values_are_never_replaced():
    result = solved(line(x_end=4.0, y_end=3.0, length=5.001))
    assert result.findings == ()
    assert number(result, "length") == 5.001
    assert tags(result)["length"] == "typed"


def test_two_solutions_must_be_picked():
    result = solved(line(x_end=4.0, length=5.0))
    assert text(result) == "PICK_SOLUTION choice: Two solutions fit: pick one on SOLUTION."
    assert result.piece is None
    assert result.end is None
    assert [piece.end for piece in result.choices] == [(4.0, 3.0), (4.0, -3.0)]
    assert result.sketch == result.choices[0]
    assert tags(result)["y_end"] == "blank"


def test_a_picked_solution_keeps_both_choices():
    result = solved(line(x_end=4.0, length=5.0, choice=1))
    assert len(result.choices) == 2
    assert result.piece == result.choices[1]
    assert number(result, "y_end") == -3.0


@pytest.mark.parametrize(
    ("typed", "missing", "words"),
    [
        (
            {},
            ("x_end", "y_end", "length", "angle"),
            "type X END and Y END, or XY LENGTH and XY ANGLE, or one end and one of these.",
        ),
        ({"length": 3.0}, ("x_end", "y_end", "angle"), "type X END, Y END or XY ANGLE."),
        ({"angle": 3.0}, ("x_end", "y_end", "length"), "type X END, Y END or XY LENGTH."),
        ({"x_end": 1.0, "angle": 90.0}, ("y_end", "length"), "type Y END or XY LENGTH."),
    ],
)
def test_missing_data_are_named(typed, missing, words):
    result = solved(line(**typed), 1.0, 1.0)
    assert result.piece is None
    assert result.missing == missing
    assert text(result) == f"MISSING {missing[0]}: More data needed: {words}"


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        (
            {"x_end": 3.0, "y_end": 4.0, "length": 6.0},
            "length: XY LENGTH is 6.000, but 5.000 by X END and Y END: correct or blank one of them.",
        ),
        (
            {"x_end": 3.0, "y_end": 4.0, "angle": 50.0},
            "angle: XY ANGLE is 50.000, but 53.130 by X END and Y END: correct or blank one of them.",
        ),
        (
            {"x_end": 3.0, "y_end": -4.0, "angle": -30.0},
            "angle: XY ANGLE is -30.000, but -53.130 by X END and Y END: correct or blank one of them.",
        ),
        (
            {"x_end": 3.0, "angle": 45.0, "length": 6.0},
            "length: XY LENGTH is 6.000, but 4.243 by X END and XY ANGLE: correct or blank one of them.",
        ),
        (
            {"x_end": 1.0, "angle": 90.0, "length": 6.0},
            "x_end: X END is 1.000, but 0.000 by XY LENGTH and XY ANGLE: correct or blank one of them.",
        ),
        ({"x_end": -3.0, "angle": 45.0}, "angle: XY ANGLE 45.000 leads away from X END -3.000. Correct one of them."),
        ({"y_end": 6.0, "length": 5.0}, "length: XY LENGTH 5.000 does not reach Y END 6.000: it takes at least 6.000."),
    ],
)
def test_contradictions_name_both_sides(typed, words):
    result = solved(line(**typed))
    assert result.piece is None
    assert text(result) == f"CONTRADICTION {words}"


def test_a_line_without_length_is_skipped():
    result = solved(line(x_end=1.0, y_end=1.0), 1.0, 1.0)
    assert text(result) == "ZERO_LENGTH None: No length: skipped. Type its end, or F1 deletes it."
    assert result.piece is None
    assert result.end == (1.0, 1.0)


def test_a_sketch_leads_to_the_typed_coordinate():
    half_typed = replace(line(x_end=3.0), y_end=Unread("2-", "Type a number."))
    assert solved(half_typed, 1.0, 1.0).sketch == Line((1.0, 1.0), (3.0, 1.0))
    assert solved(line(angle=3.0), 1.0, 1.0).sketch is None
    contradictory = line(x_end=1.0, length=5.0, angle=0.0)
    assert solved(contradictory, 1.0, 1.0).sketch == Line((1.0, 1.0), (6.0, 1.0))


@pytest.mark.parametrize(("name", "end", "kept"), [("x_end", (3.0, 1.0), "y_end"), ("y_end", (1.0, 3.0), "x_end")])
def test_a_single_end_coordinate_keeps_the_other(name, end, kept):
    result = solved(line(**{name: 3.0}, z_end=-2.0, feed=5.0), 1.0, 1.0)
    assert result.piece == Line((1.0, 1.0), end)
    assert result.values[kept] == Solved(1.0, Origin.SAME)
    assert result.findings == ()


@pytest.mark.parametrize(
    "segment",
    [
        line(),
        line(x_end=3.0, length=9.0),
        line(y_end=3.0, angle=180.0),
        replace(line(x_end=3.0), angle=Unread("9-", "Type a number.")),
        replace(line(), x_end=Unread("9-", "Type a number.")),
    ],
    ids=["blank", "length", "angle", "unread angle", "unread"],
)
def test_no_coordinate_is_kept_if_anything_else_is_typed(segment):
    result = solved(segment, 1.0, 1.0)
    assert Origin.SAME not in [value.origin for value in result.values.values() if isinstance(value, Solved)]


def test_no_coordinate_is_kept_that_would_give_a_zero_length():
    """A horizontal line with only Y typed has no end yet; its angle and the next segment then determine it."""
    result = solved(line(y_end=1.0), 1.0, 1.0)
    assert result.missing
    assert result.values["x_end"] is None
    assert [finding.code for finding in result.findings] != ["ZERO_LENGTH"]
    given_program = program(line(y_end=1.0, angle=180.0), line(x_end=-4.0, y_end=6.0, angle=135.0), x=3.0, y=1.0)
    first, second = solve_block(given_program.blocks[0], given_program).segments
    assert first.end == pytest.approx((1.0, 1.0))
    assert second.end == (-4.0, 6.0)


def test_a_kept_coordinate_equals_that_of_the_segment_before_exactly():
    given_program = program(line(x_end=1.0 / 3.0, y_end=0.1), line(y_end=7.0), line(x_end=0.0), x=0.0, y=0.0)
    first, second, third = solve_block(given_program.blocks[0], given_program).segments
    assert second.values["x_end"] == Solved(1.0 / 3.0, Origin.SAME)
    assert (first.end, second.end, third.end) == ((1.0 / 3.0, 0.1), (1.0 / 3.0, 7.0), (0.0, 7.0))


def test_a_full_circle_after_a_kept_coordinate_is_exact():
    typed = {"x_end": 0.3, "y_end": 7.0, "x_center": 0.3, "y_center": 9.0}
    given_program = program(line(x_end=0.3, y_end=0.1), line(y_end=7.0), arc("CW", **typed), x=0.0, y=0.0)
    circle = solve_block(given_program.blocks[0], given_program).segments[2].piece
    assert isinstance(circle, Arc)
    assert abs(circle.sweep) == pytest.approx(tau)


def test_no_coordinate_is_kept_after_an_undetermined_segment():
    given_program = program(line(), line(y_end=7.0), x=0.0, y=0.0)
    assert solve_block(given_program.blocks[0], given_program).segments[1].piece is None


coordinates = st.floats(-50, 50).map(lambda value: round(value, 4))
PAIRS = (("x_end", "y_end"), ("length", "angle"), ("x_end", "angle"), ("y_end", "angle"))


@settings(derandomize=True, max_examples=200)
@given(st.tuples(coordinates, coordinates), st.tuples(coordinates, coordinates))
def test_any_two_calculated_fields_give_the_line_again(start, end):
    assume(min(abs(start[0] - end[0]), abs(start[1] - end[1])) > 0.5)
    whole = solved(line(x_end=end[0], y_end=end[1]), *start)
    for pair in PAIRS:
        result = solved(line(**{name: number(whole, name) for name in pair}), *start)
        assert result.findings == ()
        assert result.piece is not None
        assert dist(result.piece.end, end) < 1e-9
    for name in ("x_end", "y_end"):
        ambiguous = solved(line(**{name: number(whole, name), "length": number(whole, "length")}), *start)
        assert min(dist(piece.end, end) for piece in ambiguous.choices) < 1e-5


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        (line(x_end=3.0, angle=90.0), "XY ANGLE 90.000 holds X at 1.000: it never reaches X END 3.000"),
        (line(y_end=-2.0, angle=180.0), "XY ANGLE 180.000 holds Y at 1.000: it never reaches Y END -2.000"),
    ],
)
def test_an_angle_that_never_reaches_the_end_coordinate_is_a_contradiction(typed: LineSegment, message: str) -> None:
    assert text(solved(typed, 1.0, 1.0)) == f"CONTRADICTION angle: {message}. Correct one of them."


def test_an_angle_along_the_end_coordinate_needs_more_data() -> None:
    assert text(solved(line(x_end=1.0, angle=90.0), 1.0, 1.0)).startswith("MISSING y_end: More data needed: type Y END")
