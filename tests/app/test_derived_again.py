"""What an edit leaves as it was stays the same object, and everything is as if it had been derived anew."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.files import load
from app.documents.programs import example
from app.painted.engine import derived_again
from core.advice.block_paths import BlockPaths
from core.pipeline.derive import derive
from core.pipeline.derived import Derived
from core.program.edit import FormPlace, Refused, delete_segment, set_unit, type_field
from core.program.model import Number, Program, Tool
from core.units import Unit

PARTS = [load(example(name)) for name in ("pocket", "flange", "plate-mm")]
VALUES = st.integers(-40, 40).map(lambda value: value / 8)
FIELDS = st.sampled_from(("x_end", "y_end", "radius", "feed", "z_end", "x_start", "z_bottom", "tool", "lookahead"))
EDITS = st.lists(st.tuples(st.integers(0, 12), FIELDS, st.none() | VALUES.map(Number)), min_size=1, max_size=5)


def edited(program: Program, segment: int, field: str, value: Number | None) -> Program:
    """The program after one edit, itself where that is refused."""
    count = len(program.blocks[0].segments)
    where = FormPlace(1, min(segment, count))
    outcome: Program | Refused
    if value == Number(5.0):
        outcome = set_unit(program, Unit.MM if program.unit is Unit.IN else Unit.IN)
    elif value == Number(-5.0) and where.segment:
        outcome = delete_segment(program, where)
    elif value == Number(4.0):
        outcome = replace(program, tools=(Tool(1, diameter=Number(0.25)),))
    else:
        try:
            outcome = type_field(program, where, field, value)
        except (KeyError, TypeError, AttributeError):
            return program
    return program if isinstance(outcome, Refused) else outcome


def told(derived: Derived) -> list[object]:
    """Everything that is derived, arrays as lists."""
    return [
        (
            one.solved,
            one.lookahead,
            one.side,
            one.radius,
            one.findings,
            None if one.paths is None else _paths(one.paths),
        )
        for one in derived.blocks
    ]


def _paths(work: BlockPaths) -> tuple[object, ...]:
    loops = [loop.whole.points.tolist() for loop in work.loops]
    verdict = None if work.verdict is None else (work.verdict.depth, work.verdict.uncut_length)
    return work.surface.points.tolist(), work.surface.numbers.tolist(), loops, verdict


@settings(derandomize=True, max_examples=60, deadline=None)
@given(st.sampled_from(PARTS), EDITS)
def test_step_by_step_is_as_at_once(part: Program, edits: list[tuple[int, str, Number | None]]) -> None:
    now = derive(part)
    for edit in edits:
        program = edited(now.program, *edit)
        now = derived_again(program, now)
        assert told(now) == told(derive(program))


def test_a_depth_changes_no_path():
    before = derive(PARTS[0])
    after = derived_again(edited(PARTS[0], 0, "z_bottom", Number(-0.5)), before)
    assert after.blocks[0].paths is before.blocks[0].paths
    assert after.blocks[0].solved.z_bottom != before.blocks[0].solved.z_bottom


def test_another_point_changes_the_path():
    before = derive(PARTS[0])
    after = derived_again(edited(PARTS[0], 1, "x_end", Number(3.5)), before)
    assert after.blocks[0].paths is not before.blocks[0].paths


def test_a_block_that_did_not_change_is_the_same_object():
    part = replace(PARTS[0], blocks=PARTS[0].blocks * 2)
    before = derive(part)
    after = derived_again(
        replace(part, blocks=(part.blocks[0], replace(part.blocks[1], lookahead=Number(5.0)))), before
    )
    assert after.blocks[0] is before.blocks[0]
    assert after.blocks[1] is not before.blocks[1]
    other = replace(part, tools=(Tool(1, diameter=Number(0.25)),))
    assert derived_again(other, before).blocks[0] is not before.blocks[0]
