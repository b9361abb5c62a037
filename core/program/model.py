"""This module defines the program as the operator typed it: frozen, with blanks, and without calculated numbers.

Numbers are in program units, as typed; `core.program.solve.block` converts them to millimeters and calculates
the blanks.  A blank is None; text that could not be read stays as `Unread`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any, TypeVar

from core.units import Unit


@dataclass(frozen=True, slots=True)
class Number:
    """A typed number, in program units (degrees for an angle)."""

    value: float


@dataclass(frozen=True, slots=True)
class Relative:
    """A number typed with an I: relative to the segment's start, or to the final heading of the segment before."""

    value: float


@dataclass(frozen=True, slots=True)
class Unread:
    """Typed text that cannot be read; it never becomes a number, and it blocks posting."""

    text: str
    reason: str


Typed = Number | Relative | Unread | None


class CutterComp(StrEnum):
    """CUTTER COMP. of a MILL CONTOUR block."""

    ON = "ON"
    LEFT = "LEFT"
    RIGHT = "RIGHT"
    PROFILE_LEFT = "PROFILE LEFT"
    PROFILE_RIGHT = "PROFILE RIGHT"


class Direction(StrEnum):
    """DIRECTION of an ARC segment."""

    CW = "CW"
    CCW = "CCW"


class PathChoice(StrEnum):
    """The center path to post: the control's, or the true offset."""

    CONTROL = "CONTROL"
    BEST = "BEST"


class Coolant(StrEnum):
    """COOLANT of a block."""

    OFF = "OFF"
    MIST = "MIST"
    FLOOD = "FLOOD"


@dataclass(frozen=True, slots=True)
class LineSegment:
    """A LINE as typed; `choice` is the picked solution, on the first segment of a run for the whole run.

    `parallel` is the number of an earlier LINE; `pick_x`, `pick_y` is a point near the end of a run's first segment.
    """

    x_end: Typed = None
    y_end: Typed = None
    z_end: Typed = None
    length: Typed = None
    angle: Typed = None
    feed: Typed = None
    choice: int | None = None
    point_x: Typed = None
    point_y: Typed = None
    point_dist: Typed = None
    parallel: Typed = None
    offset: Typed = None
    tangent: bool = False
    pick_x: Typed = None
    pick_y: Typed = None


@dataclass(frozen=True, slots=True)
class ArcSegment:
    """An ARC as typed; `choice` and the pick are as in a LINE."""

    direction: Direction = Direction.CW
    x_end: Typed = None
    y_end: Typed = None
    z_end: Typed = None
    x_center: Typed = None
    y_center: Typed = None
    radius: Typed = None
    sweep: Typed = None
    feed: Typed = None
    choice: int | None = None
    start_angle: Typed = None
    point_x: Typed = None
    point_y: Typed = None
    tangent: bool = False
    pick_x: Typed = None
    pick_y: Typed = None


@dataclass(frozen=True, slots=True)
class BlendSegment:
    """A BLEND ARC as typed: tangent to both neighbors."""

    radius: Typed = None
    feed: Typed = None


@dataclass(frozen=True, slots=True)
class ChamferSegment:
    """A CHAMFER as typed: it cuts off the corner of its neighbors, the same length from both."""

    length: Typed = None
    feed: Typed = None


CornerSegment = BlendSegment | ChamferSegment
"""The kinds of segments that lie at the corner of their two neighbors and shorten both."""

Segment = LineSegment | ArcSegment | CornerSegment
"""The kinds of segment.  A new kind also needs its form in `fields` and its rules in `solve`;
a new curve needs a piece in `geometry.piece`."""


@dataclass(frozen=True, slots=True)
class Block:
    """A MILL CONTOUR block: segment 0 is START, then segments 1 ... n.  `lookahead` None is CAL, a value is USR.

    A blank `speed`, `plunge_feed` or `coolant` takes the tool table's proposal for the tool.
    """

    tool: Typed = None
    cutter_comp: CutterComp = CutterComp.ON
    finish_tool: Typed = None
    x_start: Typed = None
    y_start: Typed = None
    z_start: Typed = None
    z_bottom: Typed = None
    plunge_feed: Typed = None
    speed: Typed = None
    peck_depth: Typed = None
    lookahead: Typed = None
    coolant: Coolant | None = None
    segments: tuple[Segment, ...] = ()


@dataclass(frozen=True, slots=True)
class Tool:
    """A line of the tool table; speed, feeds and coolant are proposals for blocks that leave theirs blank."""

    number: int
    type: str = "END MILL"
    diameter: Typed = None
    speed: Typed = None
    feed: Typed = None
    plunge_feed: Typed = None
    coolant: Coolant | None = None


@dataclass(frozen=True, slots=True)
class ProgramParameters:
    """PROGRAM PARAMETERS; a blank stands for the unit's default in `core.program.fields`."""

    blend_offset: Typed = None
    blend_overlap: Typed = None
    finish_xy: Typed = None
    finish_z: Typed = None
    pocket_overlap: Typed = None
    max_offset: Typed = None
    retract_clearance: Typed = None
    peck_clearance: Typed = None
    path: PathChoice = PathChoice.CONTROL
    rapid_feed: Typed = None


@dataclass(frozen=True, slots=True)
class PartSetup:
    """PART SETUP: the data for the header and the end of the posted file.  `work_offset` is 54 ... 59."""

    name: str = ""
    work_offset: Typed = None
    safe_z: Typed = None


@dataclass(frozen=True, slots=True)
class Program:
    """A whole program."""

    unit: Unit = Unit.IN
    parameters: ProgramParameters = field(default_factory=ProgramParameters)
    setup: PartSetup = field(default_factory=PartSetup)
    tools: tuple[Tool, ...] = ()
    blocks: tuple[Block, ...] = ()


Part = TypeVar(
    "Part",
    bound=Block | LineSegment | ArcSegment | BlendSegment | ChamferSegment | Tool | ProgramParameters | PartSetup,
)


def changed(part: Part, values: Mapping[str, Any]) -> Part:
    """Return a copy of a part with these attributes changed; the caller is responsible for names and types."""
    return replace(part, **values)


def unread_texts(program: Program) -> Iterator[Unread]:
    """Yield every text in a program that could not be read, on any form."""
    segments = (segment for block in program.blocks for segment in block.segments)
    for part in (program.parameters, program.setup, *program.tools, *program.blocks, *segments):
        values = (getattr(part, name) for name in part.__match_args__)
        yield from (value for value in values if isinstance(value, Unread))
