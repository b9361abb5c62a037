"""What an edit leaves as it was is not worked out again, and everything is as if it had been."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.files import load
from app.files import example
from core.pipeline.derive import derive
from core.pipeline.derived import Derived, Work
from core.pipeline.outline import outline
from core.program.edit import Refused, Where, delete_segment, set_unit, type_field
from core.program.model import BlendSegment, Entry, Program, Tool
from core.units import Unit

PARTS = [load(example(name)) for name in ("pocket", "flange", "plate-mm")]
VALUES = st.integers(-40, 40).map(lambda value: value / 8)
FIELDS = st.sampled_from(("x_end", "y_end", "radius", "feed", "z_end", "x_start", "z_bottom", "tool", "lookahead"))
EDITS = st.lists(st.tuples(st.integers(0, 12), FIELDS, st.none() | VALUES.map(Entry)), min_size=1, max_size=5)


def edited(program: Program, segment: int, field: str, value: Entry | None) -> Program:
    """The program after one edit, itself where that is refused."""
    count = len(program.blocks[0].segments)
    where = Where(1, min(segment, count))
    outcome: Program | Refused
    if value == Entry(5.0):
        outcome = set_unit(program, Unit.MM if program.unit is Unit.IN else Unit.IN)
    elif value == Entry(-5.0) and where.segment:
        outcome = delete_segment(program, where)
    elif value == Entry(4.0):
        outcome = replace(program, tools=(Tool(1, diameter=Entry(0.25)),))
    else:
        try:
            outcome = type_field(program, where, field, value)
        except (KeyError, TypeError, AttributeError):
            return program
    return program if isinstance(outcome, Refused) else outcome


def told(derived: Derived) -> list[object]:
    """Everything that is derived, arrays as lists."""
    return [
        (one.solved, one.lookahead, one.side, one.radius, one.findings, None if one.work is None else _paths(one.work))
        for one in derived.blocks
    ]


def _paths(work: Work) -> tuple[object, ...]:
    loops = [loop.whole.points.tolist() for loop in work.loops]
    verdict = None if work.verdict is None else (work.verdict.depth, work.verdict.uncut_length)
    return work.surface.points.tolist(), work.surface.numbers.tolist(), loops, verdict


@settings(derandomize=True, max_examples=60, deadline=None)
@given(st.sampled_from(PARTS), EDITS)
def test_step_by_step_is_as_at_once(part: Program, edits: list[tuple[int, str, Entry | None]]) -> None:
    now = derive(part)
    for edit in edits:
        program = edited(now.program, *edit)
        now = derive(program, now)
        assert told(now) == told(derive(program))


def test_a_segment_that_stays_is_not_solved_again():
    before = outline(PARTS[0])
    after = outline(edited(PARTS[0], 4, "y_end", Entry(3.625)), before)
    old, new = (one.blocks[0].solved.segments for one in (before, after))
    same = [index for index, pair in enumerate(zip(old, new, strict=True), 1) if pair[0] is pair[1]]
    beside = [index for index, one in enumerate(PARTS[0].blocks[0].segments, 1) if isinstance(one, BlendSegment)]
    assert beside == [4]
    assert {1, 2, 7, 8, 9, 10, 11} <= set(same)


def test_a_depth_changes_no_path():
    before = derive(PARTS[0])
    after = derive(edited(PARTS[0], 0, "z_bottom", Entry(-0.5)), before)
    assert after.blocks[0].work is before.blocks[0].work
    assert after.blocks[0].solved.z_bottom != before.blocks[0].solved.z_bottom


def test_another_point_changes_the_path():
    before = derive(PARTS[0])
    after = derive(edited(PARTS[0], 1, "x_end", Entry(3.5)), before)
    assert after.blocks[0].work is not before.blocks[0].work
