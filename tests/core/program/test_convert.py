"""A program in the other unit, field by field."""

from __future__ import annotations

import pytest

from core.program.edit import set_unit
from core.program.fields import PARAMETERS, SETUP, START, TABLES, Form
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    Entry,
    LineSegment,
    Parameters,
    PartSetup,
    Program,
    Segment,
    Tool,
    Unread,
    changed,
)
from core.units import Kind, Unit

SEGMENTS: dict[Form, Segment] = {Form.LINE: LineSegment(), Form.ARC: ArcSegment(), Form.BLEND: BlendSegment()}


def expected(kind: Kind) -> Entry:
    """What 2 inches, or 2 of anything else, is in a metric program."""
    return Entry(50.8) if kind in (Kind.LENGTH, Kind.FEED) else Entry(2.0)


def numbers(form: Form) -> list[tuple[str, Kind]]:
    return [(one.name, one.kind) for one in TABLES[form] if one.kind not in (Kind.CHOICE, Kind.TEXT)]


@pytest.mark.parametrize(("name", "kind"), numbers(Form.START))
def test_start(name, kind):
    part = set_unit(Program(Unit.IN, blocks=(changed(Block(), {name: Entry(2.0)}),)), Unit.MM)
    assert getattr(part.blocks[0], name) == expected(kind)
    others = [one.name for one in START if one.kind is not Kind.CHOICE and one.name != name]
    assert all(getattr(part.blocks[0], other) is None for other in others)


@pytest.mark.parametrize("form", SEGMENTS)
def test_segments(form):
    for name, kind in numbers(form):
        segment = changed(SEGMENTS[form], {name: Entry(2.0)})
        part = set_unit(Program(Unit.IN, blocks=(Block(segments=(segment,)),)), Unit.MM)
        assert part.blocks[0].segments == (changed(SEGMENTS[form], {name: expected(kind)}),)


@pytest.mark.parametrize(("name", "kind"), numbers(Form.PARAMETERS))
def test_parameters(name, kind):
    part = set_unit(Program(Unit.IN, changed(Parameters(), {name: Entry(2.0)})), Unit.MM)
    usual = {
        "blend_offset": Entry(3.175),
        "blend_overlap": Entry(3.175),
        "retract_clearance": Entry(2.54),
        "peck_clearance": Entry(1.27),
    }
    assert part.parameters == changed(Parameters(), usual | {name: expected(kind)})
    assert len(numbers(Form.PARAMETERS)) == len(PARAMETERS) - 1


@pytest.mark.parametrize(("name", "kind"), numbers(Form.SETUP))
def test_setup(name, kind):
    part = set_unit(Program(Unit.IN, setup=changed(PartSetup("A"), {name: Entry(2.0)})), Unit.MM)
    assert part.setup == changed(PartSetup("A"), {"safe_z": Entry(25.4)} | {name: expected(kind)})
    assert len(numbers(Form.SETUP)) == len(SETUP) - 1


def test_tools():
    part = set_unit(Program(Unit.IN, tools=(Tool(2, "BALL MILL", Entry(2.0)), Tool(3))), Unit.MM)
    assert part.tools == (Tool(2, "BALL MILL", Entry(50.8)), Tool(3))


def test_what_the_blanks_stood_for_is_blank_again_on_the_way_back():
    part = Program(Unit.IN, changed(Parameters(), {"blend_offset": Entry(0.25)}))
    there = set_unit(part, Unit.MM)
    assert there.parameters.blend_overlap == Entry(3.175)
    assert there.setup.safe_z == Entry(25.4)
    assert set_unit(there, Unit.IN) == part
    assert set_unit(set_unit(Program(Unit.MM), Unit.IN), Unit.MM) == Program(Unit.MM)


def test_a_typed_zero_stays_typed():
    part = Program(Unit.IN, changed(Parameters(), {"blend_offset": Entry(0.0), "finish_xy": Entry(0.0)}))
    there = set_unit(part, Unit.MM).parameters
    assert (there.blend_offset, there.finish_xy) == (Entry(0.0), Entry(0.0))
    assert set_unit(set_unit(part, Unit.MM), Unit.IN) == part


def test_the_same_unit_is_the_same_program():
    part = Program(Unit.MM)
    assert set_unit(part, Unit.MM) is part


def test_what_is_against_a_text_is_said_in_the_new_unit() -> None:
    feed = Unread("0", "FEED must be above 0, at most 10000, not 0.")
    plain = Program(blocks=(Block(segments=(LineSegment(feed=feed),)),))
    there = set_unit(plain, Unit.MM)
    (segment,) = there.blocks[0].segments
    assert segment.feed == Unread("0", "FEED must be above 0, at most 254000, not 0.")
    assert loads(dumps(there), "part") == there
    assert set_unit(there, Unit.IN).blocks == plain.blocks
