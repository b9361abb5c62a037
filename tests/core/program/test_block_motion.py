from __future__ import annotations

import json
from dataclasses import replace
from math import dist
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.piece import Arc, Piece, Turn
from core.program.block_motion import (
    MAX_COPIES,
    Motion,
    no_longer_typed,
    reflection,
    repeat_segments,
    rotation,
    shift,
    transform_block,
)
from core.program.edit import Refused
from core.program.file.read import loads_bytes
from core.program.model import ArcSegment, BlendSegment, CutterComp, Direction, LineSegment, Number, Program, Segment
from core.program.solve.block import solve_block
from tests.core.program.run_files import Case, program_of

GOLDEN = json.loads((Path(__file__).parents[2] / "data/calculated_runs/golden.json").read_text(encoding="utf-8"))
EXAMPLES = Path(__file__).parents[3] / "app" / "examples"


def example(name: str) -> Program:
    return loads_bytes((EXAMPLES / f"{name}.toml").read_bytes(), name)


NAMES = ("pocket", "notch", "flange", "plate-mm", "overrun-square")


def in_block(*segments: Segment) -> Program:
    """A program in millimeters with one contour of these segments from X 0 Y 0, on the line at Z -5."""
    program = example("plate-mm")
    block = replace(program.blocks[0], cutter_comp=CutterComp.ON, finish_tool=None, segments=segments)
    at_zero = replace(block, x_start=Number(0.0), y_start=Number(0.0), z_bottom=Number(-5.0))
    return replace(program, blocks=(at_zero,))


def shapes(program: Program) -> list[Piece | None]:
    return [segment.sharp for segment in solve_block(program.blocks[0], program).segments]


def held_against(before: Program, after: Program, motion: Motion) -> None:
    """Each piece lies where a direct calculation puts it."""
    for old, new in zip(shapes(before), shapes(after), strict=True):
        if old is None:
            continue
        assert dist(new.start, motion.point(old.start)) < 1e-3
        assert dist(new.end, motion.point(old.end)) < 1e-3
        assert new.length == pytest.approx(old.length, abs=1e-3)
        if isinstance(old, Arc):
            assert dist(new.center, motion.point(old.center)) < 1e-3
            assert new.turn == (-old.turn if motion.mirrored else old.turn)


def motions():
    number = st.floats(-50.0, 50.0)
    point = st.tuples(number, number)
    angle = st.floats(-180.0, 180.0)
    return st.one_of(
        st.builds(shift, number, number), st.builds(rotation, point, angle), st.builds(reflection, point, angle)
    )


@given(st.sampled_from(NAMES), motions())
@settings(max_examples=120, derandomize=True, deadline=None)
def test_every_piece_of_a_block_lies_where_the_motion_puts_it(name, motion):
    program = example(name)
    after = transform_block(program, 1, motion)
    assert not isinstance(after, Refused), after
    held_against(program, after, motion)
    assert len(after.blocks[0].segments) == len(program.blocks[0].segments)


def test_a_reflection_turns_direction_and_cutter_comp_round():
    program = example("pocket")
    after = transform_block(program, 1, reflection((0.0, 0.0), 90.0))
    assert isinstance(after, Program)
    assert after.blocks[0].cutter_comp is CutterComp.RIGHT
    before = [segment.direction for segment in program.blocks[0].segments if isinstance(segment, ArcSegment)]
    now = [segment.direction for segment in after.blocks[0].segments if isinstance(segment, ArcSegment)]
    assert now == [Direction.CCW if way is Direction.CW else Direction.CW for way in before]
    assert after.blocks[0].x_start == Number(-2.0)


def test_calculated_fields_stay_blank_where_they_still_follow():
    program = example("pocket")
    segments = (LineSegment(length=Number(1.0), angle=Number(30.0)), ArcSegment(radius=Number(0.5), x_end=Number(4.0)))
    block = replace(program.blocks[0], segments=(segments[0],))
    program = replace(program, blocks=(block,))
    after = transform_block(program, 1, rotation((0.0, 0.0), 15.0))
    assert isinstance(after, Program)
    assert after.blocks[0].segments[0] == LineSegment(length=Number(1.0), angle=Number(45.0))


def test_numbers_are_typed_with_six_decimals():
    after = transform_block(example("pocket"), 1, rotation((0.0, 0.0), 10.0))
    assert isinstance(after, Program)
    x = after.blocks[0].x_start
    assert isinstance(x, Number)
    assert x.value == round(x.value, 6)


def test_what_is_not_determined_is_not_moved_and_the_sentence_names_it():
    program = example("pocket")
    block = replace(program.blocks[0], segments=(*program.blocks[0].segments[:2], LineSegment()))
    outcome = transform_block(replace(program, blocks=(block,)), 1, shift(1.0, 0.0))
    assert isinstance(outcome, Refused)
    assert "Segment 3" in outcome.text


def test_teeth_are_repeated_round_a_center_and_close_the_contour():
    tooth = (LineSegment(x_end=Number(1.2), y_end=Number(0.0)), LineSegment(x_end=Number(0.5), y_end=Number(0.866025)))
    block = replace(example("pocket").blocks[0], x_start=Number(1.0), y_start=Number(0.0), segments=tooth)
    program = replace(example("pocket"), blocks=(block,))
    after = repeat_segments(program, 1, 1, 2, rotation((0.0, 0.0), 60.0), 5)
    assert isinstance(after, Program)
    solved = solve_block(after.blocks[0], after)
    assert len(after.blocks[0].segments) == 12
    assert solved.closed


def test_a_line_leads_to_a_copy_that_begins_elsewhere():
    program = example("notch")
    after = repeat_segments(program, 1, 1, 1, shift(0.0, 10.0), 1)
    assert isinstance(after, Program)
    assert len(after.blocks[0].segments) == len(program.blocks[0].segments) + 2


@given(motions(), motions(), st.tuples(st.floats(-9, 9), st.floats(-9, 9)))
@settings(max_examples=200, derandomize=True, deadline=None)
def test_one_motion_after_another_is_one_motion(first, second, at):
    assert first.then(second).point(at) == pytest.approx(second.point(first.point(at)), abs=1e-9)


def test_repeated_segments_keep_parallel_to_on_its_line() -> None:
    ends = ((10.0, 0.0), (20.0, 10.0), (30.0, 10.0), (40.0, 30.0))
    lines = [LineSegment(Number(x), Number(y)) for x, y in ends]
    before = in_block(*lines, LineSegment(Number(60.0), parallel=Number(4.0)))
    after = repeat_segments(before, 1, 1, 2, shift(20.0, 10.0), 1)
    assert not isinstance(after, Refused)
    assert after.blocks[0].segments[-1] == LineSegment(Number(60.0), parallel=Number(6.0))
    assert shapes(after)[-1].end == pytest.approx((60.0, 70.0))


def test_a_copy_has_the_feed_and_the_heights_of_what_is_copied() -> None:
    first = LineSegment(Number(10.0), Number(0.0), feed=Number(300.0))
    ramp = LineSegment(Number(20.0), Number(5.0), Number(-2.0), feed=Number(50.0))
    before = in_block(first, LineSegment(Number(10.0), Number(5.0)), ramp)
    after = repeat_segments(before, 1, 2, 3, shift(10.0, 5.0), 2)
    assert not isinstance(after, Refused)
    solved = solve_block(after.blocks[0], after).segments
    assert [segment.feed for segment in solved] == [300.0, *(300.0, 50.0) * 3]
    assert [segment.z_end for segment in solved] == [-5.0, *(-5.0, -2.0) * 3]


def test_a_line_that_leads_to_a_copy_also_leads_to_its_height() -> None:
    ramp = LineSegment(Number(20.0), Number(5.0), Number(-2.0), feed=Number(50.0))
    before = in_block(LineSegment(Number(10.0), Number(0.0)), ramp)
    after = repeat_segments(before, 1, 2, 2, shift(0.0, 50.0), 1)
    assert not isinstance(after, Refused)
    solved = solve_block(after.blocks[0], after).segments
    assert [(segment.z_start, segment.z_end) for segment in solved[1:]] == [(-5.0, -2.0), (-2.0, -5.0), (-5.0, -2.0)]


RUN: Case = {
    "start": [0, 0],
    "segments": [
        {"kind": "LINE", "angle": 0},
        {"kind": "ARC", "direction": "CCW", "tangent": True, "radius": 10},
        {"kind": "LINE", "tangent": True, "angle": 90, "x_end": 60, "y_end": 40},
    ],
}


@pytest.mark.parametrize("motion", [shift(3.0, -2.0), rotation((1.0, 2.0), 33.0), reflection((1.0, 2.0), 20.0)])
def test_a_moved_run_keeps_its_data(motion: Motion) -> None:
    before = program_of(RUN)
    after = transform_block(before, 1, motion)
    assert not isinstance(after, Refused)
    held_against(before, after, motion)
    line, arc, last = after.blocks[0].segments
    assert line == LineSegment(angle=Number(round(motion.angle(0.0), 6)))
    assert arc == ArcSegment(Direction.CW if motion.mirrored else Direction.CCW, radius=Number(10.0), tangent=True)
    assert isinstance(last, LineSegment)
    assert last.tangent
    assert no_longer_typed(before.blocks[0], after.blocks[0]) == []


def test_data_that_cannot_be_kept_are_named() -> None:
    before = program_of({"start": [0, 0], "segments": [{"kind": "LINE", "x_end": 50, "angle": 30}]})
    shifted = transform_block(before, 1, shift(1.0, 0.0))
    assert not isinstance(shifted, Refused)
    assert shifted.blocks[0].segments == (LineSegment(Number(51.0), angle=Number(30.0)),)
    turned = transform_block(before, 1, rotation((0.0, 0.0), 10.0))
    assert not isinstance(turned, Refused)
    assert no_longer_typed(before.blocks[0], turned.blocks[0]) == [1]


@pytest.mark.parametrize("case", [case for case in GOLDEN if case["solutions"]], ids=lambda case: case["name"])
@pytest.mark.parametrize(
    "motion",
    [
        shift(3.0, -2.0),
        rotation((1.0, 2.0), 90.0),
        rotation((1.0, 2.0), 33.0),
        reflection((0.0, 0.0), 90.0),
        reflection((1.0, 2.0), 20.0),
    ],
)
def test_every_calculated_run_lies_where_the_motion_puts_it(case: Case, motion: Motion) -> None:
    for choice in range(len(case["solutions"])):
        before = program_of(case, {1: choice})
        after = transform_block(before, 1, motion)
        if isinstance(after, Refused):
            assert "not determined" in after.text, "the choice belongs to a later segment"
            continue
        held_against(before, after, motion)
        if motion == shift(3.0, -2.0):
            assert no_longer_typed(before.blocks[0], after.blocks[0]) == []


CORNER = (LineSegment(Number(10.0), Number(0.0)), BlendSegment(Number(1.0)), LineSegment(Number(10.0), Number(9.0)))


@pytest.mark.parametrize(
    ("first", "last", "copies", "motion", "text"),
    [
        (2, 1, 1, shift(5.0, 0.0), "The last segment, 1, is before the first, 2."),
        (0, 1, 1, shift(5.0, 0.0), "This block has segments 1 to 3, not 0 to 1."),
        (1, 4, 1, shift(5.0, 0.0), "This block has segments 1 to 3, not 1 to 4."),
        (1, 3, 0, shift(5.0, 0.0), f"Type a number of copies from 1 to {MAX_COPIES}."),
        (1, 3, MAX_COPIES + 1, shift(5.0, 0.0), f"Type a number of copies from 1 to {MAX_COPIES}."),
        (1, 3, 2, reflection((0.0, 0.0), 0.0), "Only one mirrored copy can be made."),
        (2, 3, 1, shift(5.0, 0.0), "Begin and end the copied segments with a LINE or an ARC."),
        (1, 2, 1, shift(5.0, 0.0), "Begin and end the copied segments with a LINE or an ARC."),
    ],
)
def test_copies_that_cannot_be_made_are_refused(first: int, last: int, copies: int, motion: Motion, text: str) -> None:
    assert repeat_segments(in_block(*CORNER), 1, first, last, motion, copies) == Refused(text)


def test_a_block_without_its_start_is_neither_moved_nor_copied() -> None:
    program = in_block(*CORNER)
    block = program.blocks[0]
    for blank in (replace(block, x_start=None), replace(block, y_start=None)):
        part = replace(program, blocks=(blank,))
        assert transform_block(part, 1, shift(1.0, 0.0)) == Refused("Type X START and Y START first.")
        assert repeat_segments(part, 1, 1, 3, shift(5.0, 0.0), 1) == Refused("Type X START and Y START first.")


def test_a_full_circle_stays_one_where_it_is_moved_and_mirrored() -> None:
    circle = ArcSegment(Direction.CW, x_center=Number(5.0), y_center=Number(0.0), sweep=Number(360.0))
    before = in_block(circle)
    after = transform_block(before, 1, reflection((0.0, 0.0), 90.0))
    assert isinstance(after, Program)
    assert shapes(after) == [Arc((0.0, 0.0), (0.0, 0.0), (-5.0, 0.0), Turn.CCW)]
