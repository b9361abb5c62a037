"""A block made of the one before an edit is the same as made at once, whatever is typed, put in or taken out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from core.program.model import Entry, Program, Segment
from core.program.solve.solve import solve_block
from core.program.solve.solved import SolvedBlock
from tests.core.program.parts import arc, blend, line, program

Edit = tuple[str, int, Segment]

SIDES = (
    line(x_end=4.0, y_end=0.0),
    line(x_end=4.0, y_end=3.0),
    arc("CCW", x_end=1.0, y_end=3.0, radius=2.0, choice=0),
    line(x_end=1.0, y_end=1.0),
    line(x_end=0.0, y_end=0.0),
)

KINDS: tuple[Segment, ...] = (
    *SIDES,
    blend(0.1),
    blend(9.0),
    line(x_end=2.0),
    line(x_end=4.0, y_end=0.0, z_end=-0.125),
    line(),
    arc("CW", x_end=2.0, y_end=2.0, radius=5.0),
    line(x_end=1.0, y_end=1.0, feed=7.0),
)

edits = st.tuples(st.sampled_from(("put in", "take out", "change", "start")), st.integers(0, 9), st.sampled_from(KINDS))


def edited(part: Program, edit: Edit) -> Program:
    """The program with a segment put in, taken out or changed at a place, or with another START."""
    what, place, one = edit
    (whole,) = part.blocks
    segments = list(whole.segments)
    at = place % (len(segments) + 1)
    if what == "start":
        whole = replace(whole, x_start=Entry(place / 8.0 + 0.125))
    elif what == "put in":
        segments.insert(at, one)
    else:
        segments[at : at + 1] = [] if what == "take out" else [one]
    return replace(part, blocks=(replace(whole, segments=tuple(segments)),))


def solved(part: Program, before: SolvedBlock | None = None) -> SolvedBlock:
    return solve_block(part.blocks[0], part, before)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(KINDS), max_size=6), st.lists(edits, min_size=1, max_size=6))
def test_step_by_step_is_as_at_once(segments: list[Segment], steps: Sequence[Edit]) -> None:
    part = program(*SIDES, *segments)
    found = solved(part)
    for step in steps:
        part = edited(part, step)
        found = solved(part, found)
        assert found == solved(part)


def test_the_last_blend_taken_out_leaves_its_neighbors_whole():
    part = program(SIDES[0], blend(0.5), *SIDES[1:])
    before = solved(part)
    after = solved(edited(part, ("take out", 1, SIDES[0])), before)
    assert after.pieces[0][1].end == (4.0, 0.0)
    assert after == solved(program(*SIDES))


def test_start_is_taken_over_only_from_the_same():
    part = program(*SIDES)
    before = solved(part)
    assert solved(edited(part, ("change", 2, KINDS[3])), before).making.start is before.making.start
    tools, (whole,) = part.tools, part.blocks
    for other in (
        replace(part, tools=(replace(tools[0], diameter=Entry(0.125)), *tools[1:])),
        replace(part, blocks=(replace(whole, z_bottom=Entry(-0.5)),)),
        replace(part, blocks=(replace(whole, segments=()),)),
    ):
        after = solved(other, before)
        assert after.making.start is not before.making.start
        assert after == solved(other)


def test_a_blend_that_does_not_fit_is_told_anew_where_its_neighbor_is_another():
    part = program(SIDES[0], blend(9.0), *SIDES[1:])
    before = solved(part)
    other = edited(part, ("change", 2, line(x_end=4.0, y_end=1.0)))
    assert solved(other, before) == solved(other)
    fitting = edited(part, ("change", 1, blend(0.5)))
    assert solved(part, solved(fitting)) == before
    assert solved(other, solved(fitting, before)) == solved(other)


def test_a_blend_behind_an_undetermined_segment_is_told_anew_where_it_is_last_no_more():
    part = program(line(), blend(0.5))
    after = edited(part, ("put in", 2, SIDES[0]))
    assert solved(after, solved(part)) == solved(after)
    assert solved(part, solved(after)) == solved(part)
