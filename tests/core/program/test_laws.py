"""Properties of calculated fields of any contour: moved, mirrored, rotated, in the other unit, typed in again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, dist, hypot, radians, sin

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core.geometry.piece import Arc, Piece, Point
from core.program import edit
from core.program.edit import FormPlace
from core.program.fields import field_of, form_of, value_refusal
from core.program.model import ArcSegment, CornerSegment, Direction, Number, Program, Segment
from core.program.solve.block import solve_block
from core.program.solve.solved import Solved, SolvedBlock
from core.units import Unit
from tests.core.program.parts import arc, blend, line, program

laws = settings(derandomize=True, max_examples=40, deadline=None)


@dataclass(frozen=True)
class Corner:
    """A point of a random contour, reached by a line or by an arc that bulges to one side."""

    point: Point
    bulge: float


coordinates = st.integers(-400, 400).map(lambda value: value / 8)
corners = st.builds(Corner, st.tuples(coordinates, coordinates), st.sampled_from((0.0, 0.0, 0.3, -0.3, 0.8, -1.7)))


def typed_segment(start: Point, corner: Corner) -> Segment:
    """The segment to a corner; a bulge b is the height of the center over the chord, in chords."""
    (x0, y0), (x1, y1) = start, corner.point
    if not corner.bulge:
        return line(x_end=x1, y_end=y1)
    x, y = (x0 + x1) / 2 - (y1 - y0) * corner.bulge, (y0 + y1) / 2 + (x1 - x0) * corner.bulge
    direction = "CW" if corner.bulge > 0.5 else "CCW"
    return arc(direction, x_end=x1, y_end=y1, x_center=x, y_center=y)


@st.composite
def contours(draw: st.DrawFn) -> Program:
    """A determined contour of lines and arcs with some blends."""
    chain = draw(st.lists(corners, min_size=3, max_size=7))
    points = [corner.point for corner in chain]
    assume(all(dist(*pair) > 5.0 for pair in pairwise(points)))
    blends = draw(st.lists(st.booleans(), min_size=len(chain), max_size=len(chain)))
    segments: list[Segment] = []
    for blended, start, corner in zip(blends, points, chain[1:], strict=False):
        if segments and blended:
            segments.append(blend(0.5))
        segments.append(typed_segment(start, corner))
    part = program(*segments, x=points[0][0], y=points[0][1])
    assume(solved(part).determined == len(segments))
    return part


def solved(given_program: Program) -> SolvedBlock:
    return solve_block(given_program.blocks[0], given_program)


def places(piece: Piece) -> list[Point]:
    return [piece.start, piece.end, *([piece.center] if isinstance(piece, Arc) else [])]


def turns(block: SolvedBlock) -> list[int]:
    return [int(piece.turn) if isinstance(piece, Arc) else 0 for _, piece in block.pieces]


def same(block: SolvedBlock, other: SolvedBlock, tolerance: float = 1e-6) -> bool:
    """Whether two blocks have the same pieces under the same numbers."""
    assert [number for number, _ in block.pieces] == [number for number, _ in other.pieces]
    pairs = zip(block.pieces, other.pieces, strict=True)
    return turns(block) == turns(other) and all(
        dist(place, other_place) <= tolerance
        for (_, piece), (_, other_piece) in pairs
        for place, other_place in zip(places(piece), places(other_piece), strict=True)
    )


def moved(part: Program, dx: float, dy: float) -> Program:
    """The same part with every typed coordinate shifted."""
    block = part.blocks[0]
    segments = tuple(shifted(segment, dx, dy) for segment in block.segments)
    x, y = Number(value(block.x_start) + dx), Number(value(block.y_start) + dy)
    return replace(part, blocks=(replace(block, segments=segments, x_start=x, y_start=y),))


def value(typed: object) -> float:
    assert isinstance(typed, Number)
    return typed.value


def shifted(segment: Segment, dx: float, dy: float) -> Segment:
    if isinstance(segment, CornerSegment):
        return segment
    result = replace(segment, x_end=Number(value(segment.x_end) + dx), y_end=Number(value(segment.y_end) + dy))
    if isinstance(result, ArcSegment):
        x, y = value(result.x_center) + dx, value(result.y_center) + dy
        return replace(result, x_center=Number(x), y_center=Number(y))
    return result


def mirrored(part: Program) -> Program:
    """The same part mirrored in the Y axis."""
    block = part.blocks[0]
    segments = tuple(mirrored_segment(segment) for segment in block.segments)
    return replace(part, blocks=(replace(block, x_start=Number(-value(block.x_start)), segments=segments),))


def mirrored_segment(segment: Segment) -> Segment:
    if isinstance(segment, CornerSegment):
        return segment
    result = replace(segment, x_end=Number(-value(segment.x_end)))
    if isinstance(result, ArcSegment):
        turned = Direction.CW if result.direction is Direction.CCW else Direction.CCW
        return replace(result, x_center=Number(-value(result.x_center)), direction=turned)
    return result


@laws
@given(contours(), coordinates, coordinates)
def test_a_moved_part_has_moved_pieces(part, dx, dy):
    original, changed = solved(part), solved(moved(part, dx, dy))
    assert turns(original) == turns(changed)
    for (_, piece), (_, changed_piece) in zip(original.pieces, changed.pieces, strict=True):
        for (x, y), place in zip(places(piece), places(changed_piece), strict=True):
            assert dist((x + dx, y + dy), place) < 1e-6


@laws
@given(contours())
def test_a_mirrored_part_has_mirrored_pieces(part):
    original, changed = solved(part), solved(mirrored(part))
    assert turns(original) == [-turn for turn in turns(changed)]
    for (_, piece), (_, changed_piece) in zip(original.pieces, changed.pieces, strict=True):
        for (x, y), place in zip(places(piece), places(changed_piece), strict=True):
            assert dist((-x, y), place) < 1e-6


@laws
@given(contours(), st.floats(0, 360))
def test_lines_of_length_and_angle_rotate_with_their_angles(part, degrees):
    """A part of lengths and angles only is rotated when all angles grow by the same amount."""
    block = solved(part)
    lines = [one for one in block.segments if one.piece is not None and "angle" in one.values]
    assume(len(lines) > 1)
    typed = [(number(one.values["length"]), number(one.values["angle"])) for one in lines]
    plain = solved(program(*(line(length=length, angle=angle) for length, angle in typed)))
    turned = (line(length=length, angle=(angle + degrees) % 360.0) for length, angle in typed)
    other = solved(program(*turned))
    way = radians(degrees)
    for (_, one), (_, two) in zip(plain.pieces, other.pieces, strict=True):
        x, y = one.end
        assert dist((x * cos(way) - y * sin(way), x * sin(way) + y * cos(way)), two.end) < 1e-6


def number(given_value: object) -> float:
    assert isinstance(given_value, Number | Solved)
    return given_value.value


@laws
@given(contours())
def test_the_part_is_the_same_in_the_other_unit(part):
    inches = edit.set_unit(part, Unit.IN)
    assert same(solved(part), solved(inches))
    assert solved(part).closed is solved(inches).closed
    assert same(solved(part), solved(edit.set_unit(inches, Unit.MM)), 1e-9)


@laws
@given(contours())
def test_typing_calculated_values_changes_nothing(part):
    """Every typed CAL number agrees with the others: there is no finding and the path stays the same."""
    before = solved(part)
    typed = part
    for segment in before.segments:
        for name, solved_value in segment.values.items():
            if isinstance(solved_value, Solved):
                typed = program_of(
                    edit.type_field(typed, FormPlace(1, segment.number), name, Number(solved_value.value))
                )
    after = solved(typed)
    assert after.all_findings == ()
    assert same(before, after)
    assert not any(
        isinstance(solved_value, Solved) for segment in after.segments for solved_value in segment.values.values()
    )


def program_of(edited: edit.Edited) -> Program:
    assert isinstance(edited, Program)
    return edited


@laws
@given(contours())
def test_calculated_numbers_are_within_the_range_of_their_fields(part):
    for typed, result in zip(part.blocks[0].segments, solved(part).segments, strict=True):
        for name, field_value in result.values.items():
            if isinstance(field_value, Solved):
                assert value_refusal(field_of(form_of(typed), name), field_value.value, part.unit) is None


@laws
@given(contours())
def test_pieces_join_and_arcs_are_exact(part):
    block = solved(part)
    pieces = [piece for _, piece in block.pieces]
    for before, after in pairwise(pieces):
        assert before.end == after.start
    for piece in pieces:
        if isinstance(piece, Arc):
            (x, y), (cx, cy) = piece.end, piece.center
            assert hypot(x - cx, y - cy) == pytest.approx(piece.radius, abs=1e-8)


@laws
@given(contours(), st.integers(1, 6))
def test_deleting_an_inserted_segment_restores_the_part(part, at):
    place = FormPlace(1, min(at, len(part.blocks[0].segments) + 1))
    longer = program_of(edit.insert_segment(part, place, line(x_end=1.0, y_end=2.0)))
    assert program_of(edit.delete_segment(longer, place)) == part


@laws
@given(st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=8, unique=True), st.integers(0, 6))
def test_deleting_a_segment_joins_its_neighbors(points, index):
    assume(index + 1 < len(points))
    part = program(*(line(x_end=x, y_end=y) for x, y in points), x=1000.0)
    shorter = solved(program_of(edit.delete_segment(part, FormPlace(1, index + 1))))
    before = solved(part)
    assert shorter.segments[index].start == before.segments[index].start
    assert shorter.segments[index].end == before.segments[index + 1].end
    assert len(shorter.segments) == len(points) - 1
