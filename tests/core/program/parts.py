"""Small programs for tests: segments from plain numbers, a block around them, random programs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hypothesis import strategies as st

from core.finding import Severity
from core.program.fields import PICK, STORED_FIELDS, Field, Form
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    ChamferSegment,
    Coolant,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    PartSetup,
    PathChoice,
    Program,
    ProgramParameters,
    Relative,
    Segment,
    Tool,
    Typed,
    Unread,
    changed,
)
from core.program.solve.solved import Solved, SolvedBlock, SolvedSegment
from core.units import Kind, Unit, Unreadable, parse

BLOCK = Block(
    tool=Number(1.0),
    cutter_comp=CutterComp.LEFT,
    finish_tool=Number(0.0),
    x_start=Number(0.0),
    y_start=Number(0.0),
    z_start=Number(0.0),
    z_bottom=Number(-0.25),
    plunge_feed=Number(20.0),
    speed=Number(300.0),
    peck_depth=Number(0.0),
)
"""START at X 0 Y 0 with everything typed."""


def line(**typed: float) -> LineSegment:
    """A LINE with these fields typed, and `choice` picked."""
    return changed(LineSegment(), _typed(typed))


def arc(direction: str, **typed: float) -> ArcSegment:
    """An ARC with these fields typed, and `choice` picked."""
    return changed(ArcSegment(Direction(direction)), _typed(typed))


def _typed(typed: dict[str, float]) -> dict[str, Number | int]:
    return {name: int(value) if name == "choice" else Number(value) for name, value in typed.items()}


def blend(radius: float) -> BlendSegment:
    """A BLEND ARC of this radius."""
    return BlendSegment(Number(radius))


def chamfer(length: float) -> ChamferSegment:
    """A CHAMFER of this length."""
    return ChamferSegment(Number(length))


def program(
    *segments: Segment, unit: Unit = Unit.MM, x: float = 0.0, y: float = 0.0, start: Mapping[str, object] | None = None
) -> Program:
    """A program of one block from x, y, with tool 1 of diameter 0.5; `start` changes fields of START."""
    block = changed(BLOCK, {"segments": segments, "x_start": Number(x), "y_start": Number(y), **(start or {})})
    return Program(unit=unit, tools=(Tool(1, "END MILL", Number(0.5)),), blocks=(block,))


RELATIONS = (*(field.name for field in PICK), "point_x", "point_y", "point_dist", "parallel", "offset")
"""Fields that stay blank where they are not typed."""


def tags(segment: SolvedSegment | SolvedBlock) -> dict[str, str]:
    """Which fields were typed, which calculated, which are neither."""
    names = {Number: "typed", Solved: "CAL", Unread: "unread", type(None): "blank"}
    return {name: names[type(value)] for name, value in segment.values.items() if value or name not in RELATIONS}


def number(segment: SolvedSegment, name: str) -> float:
    """A typed or calculated field's number."""
    value = segment.values[name]
    assert isinstance(value, Number | Solved)
    return value.value


def _numbers(one: Field) -> st.SearchStrategy[float]:
    if one.kind is Kind.COUNT:
        return st.integers(int(one.low or 0), int(one.high or 0)).map(float)
    low = one.low if one.above is None else one.above
    return st.floats(low, one.high, allow_subnormal=False, exclude_min=one.above is not None)


def _unread(one: Field, unit: Unit) -> st.SearchStrategy[Unread]:
    def kept(text: str) -> Unread:
        value = parse(text, one.kind, unit)
        assert isinstance(value, Unreadable)
        return Unread(text, value.reason)

    return st.text(st.characters(codec="utf-8"), max_size=4).map(lambda text: kept("x" + text))


def typed(one: Field, unit: Unit) -> st.SearchStrategy[Typed]:
    """A blank, a number the field takes, a relative one where it takes such, or text that cannot be read."""
    relative = (_numbers(one).map(Relative),) if one.relative else ()
    return st.one_of(st.none(), _numbers(one).map(Number), *relative, _unread(one, unit))


def _entries(form: Form, unit: Unit, *but: str) -> dict[str, st.SearchStrategy[Typed]]:
    fields = (one for one in STORED_FIELDS[form] if one.kind not in (Kind.CHOICE, Kind.TEXT) and one.name not in but)
    return {one.name: typed(one, unit) for one in fields}


def segments(unit: Unit) -> st.SearchStrategy[Segment]:
    """A random segment."""
    ties = {"choice": st.sampled_from((None, 0, 1, 5, 4096)), "tangent": st.booleans()}
    lines = st.builds(LineSegment, **_entries(Form.LINE, unit), **ties).map(_tied_once)
    arcs = st.builds(ArcSegment, st.sampled_from(Direction), **_entries(Form.ARC, unit), **ties).map(_tied_once)
    blends = st.builds(BlendSegment, **_entries(Form.BLEND, unit))
    return st.one_of(lines, arcs, blends, st.builds(ChamferSegment, **_entries(Form.CHAMFER, unit)))


def _tied_once(segment: LineSegment | ArcSegment) -> LineSegment | ArcSegment:
    """A segment with TANGENT or an angle to the segment before, not both: one takes the place of the other."""
    angle = segment.angle if isinstance(segment, LineSegment) else segment.start_angle
    return replace(segment, tangent=False) if isinstance(angle, Relative) else segment


coolants = st.one_of(st.none(), st.sampled_from(Coolant))


def blocks(unit: Unit) -> st.SearchStrategy[Block]:
    """A random block."""
    return st.builds(
        Block,
        **_entries(Form.START, unit),
        cutter_comp=st.sampled_from(CutterComp),
        coolant=coolants,
        segments=st.lists(segments(unit), max_size=3).map(tuple),
    )


def _programs(unit: Unit) -> st.SearchStrategy[Program]:
    names = st.text(st.characters(codec="utf-8"), max_size=8).filter(str.isprintable)
    numbers = _entries(Form.TOOL, unit, "number")
    tools = st.lists(
        st.builds(Tool, st.integers(1, 9999), names, **numbers, coolant=coolants),
        max_size=2,
        unique_by=lambda one: one.number,
    )
    return st.builds(
        Program,
        st.just(unit),
        st.builds(ProgramParameters, **_entries(Form.PARAMETERS, unit), path=st.sampled_from(PathChoice)),
        st.builds(PartSetup, names, **_entries(Form.SETUP, unit)),
        tools.map(lambda some: tuple(sorted(some, key=lambda one: one.number))),
        st.lists(blocks(unit), max_size=2).map(tuple),
    )


programs: st.SearchStrategy[Program] = st.sampled_from(Unit).flatmap(_programs)
"""A random program such as the edits can make."""


def postable(block: SolvedBlock) -> bool:
    """True if there is a surface, every segment is determined and no finding is an error."""
    sound = all(finding.severity is not Severity.ERROR for finding in block.all_findings)
    return block.fully_determined and bool(block.pieces) and sound
