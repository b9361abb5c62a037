"""The fields of the screens: label, kind, range and prompt of everything that can be typed.

One table for the form, the reader of files, and the messages, so that a field has one name everywhere.
`name` is the attribute of the model and the key of the program file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from types import MappingProxyType
from typing import Final, assert_never

from core.program.model import (
    ArcSegment,
    BlendSegment,
    CutterComp,
    Direction,
    LineSegment,
    PathChoice,
    Segment,
)
from core.units import Kind, Unit, from_mm


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `low` and `high` bound what may be typed (inclusive), None is open.

    Lengths and feeds are bounded in millimeters, so that a field takes the same part in both units.
    """

    name: str
    label: str
    kind: Kind
    prompt: str
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()
    above: float | None = None
    """A bound that itself is not allowed, such as 0 for a diameter."""


class Form(StrEnum):
    """The screens that have fields."""

    START = "START"
    LINE = "LINE"
    ARC = "ARC"
    BLEND = "BLEND ARC"
    TOOL = "TOOL SETUP"
    PARAMETERS = "PROGRAM PARAMETERS"
    SETUP = "PART SETUP"


FARTHEST: Final = 254000.0
"""Largest coordinate and length in millimeters, and feed in millimeters a minute: 10000 in, beyond any machine."""

FASTEST: Final = 100000
"""Largest SPEED in revolutions a minute."""

SEGMENT_PROMPT: Final = (
    "Enter a segment number, use ENTER to edit segment, or use left arrow (back), right arrow (advance), or softkey."
)

LOOKAHEAD_PROMPT: Final = (
    "Enter a cutter comp lookahead value to override the calculated value. Not recommended unless necessary. "
    "1 to 20. F3 goes back to CAL."
)


def _place(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, -FARTHEST, FARTHEST)


def _size(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, high=FARTHEST, above=0.0)


def _allowance(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, 0.0, FARTHEST)


def _feed(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.FEED, prompt, high=FARTHEST, above=0.0)


def _count(name: str, label: str, prompt: str, low: float, high: float) -> Field:
    return Field(name, label, Kind.COUNT, prompt, low, high)


_FEED: Final = _feed(
    "feed",
    "FEED",
    "Enter the feed along this segment. Blank takes it from the segment before, on the first from PLUNGE FEED.",
)
_X_END: Final = _place("x_end", "X END", "Enter the X coordinate of the end of this segment.")
_Y_END: Final = _place("y_end", "Y END", "Enter the Y coordinate of the end of this segment.")
_Z_END: Final = _place("z_end", "Z END", "Enter Z at the end of this segment. Blank keeps Z of the segment before.")

START: Final = (
    _count("tool", "TOOL", "Enter the number of the tool that mills this contour.", 1, 9999),
    Field(
        "cutter_comp",
        "CUTTER COMP.",
        Kind.CHOICE,
        "Select the side of the contour the tool runs on, seen along travel.",
        choices=tuple(comp.value for comp in CutterComp),
    ),
    _count("finish_tool", "FINISH TOOL", "Enter the number of the tool for the finish pass, or 0 for none.", 0, 9999),
    _place("x_start", "X START", "Enter the X coordinate where the contour starts."),
    _place("y_start", "Y START", "Enter the Y coordinate where the contour starts."),
    _place("z_start", "Z START", "Enter the Z coordinate of the top of the material."),
    _place("z_bottom", "Z BOTTOM", "Enter the Z coordinate of the bottom of the cut."),
    _feed("plunge_feed", "PLUNGE FEED", "Enter the feed with which the tool goes down."),
    _count("speed", "SPEED (RPM)", "Enter the spindle speed in revolutions per minute.", 1, FASTEST),
    _allowance("peck_depth", "PECK DEPTH", "Enter the depth of one pass, or 0 for the full depth in one pass."),
    _count("lookahead", "CUTCOMP LOOKAHEAD", LOOKAHEAD_PROMPT, 1, 20),
)

LINE: Final = (
    _X_END,
    _Y_END,
    _Z_END,
    _size("length", "XY LENGTH", "Enter the length of the line in the XY plane."),
    Field("angle", "XY ANGLE", Kind.ANGLE, "Enter the angle of the line, counter-clockwise from +X.", -360.0, 360.0),
    _FEED,
)

ARC: Final = (
    Field(
        "direction",
        "DIRECTION",
        Kind.CHOICE,
        "Select the direction of travel along the arc.",
        choices=tuple(direction.value for direction in Direction),
    ),
    _X_END,
    _Y_END,
    _Z_END,
    _place("x_center", "X CENTER", "Enter the X coordinate of the center of the arc."),
    _place("y_center", "Y CENTER", "Enter the Y coordinate of the center of the arc."),
    _size("radius", "RADIUS", "Enter the radius of the arc."),
    Field(
        "sweep",
        "SWEEP ANGLE",
        Kind.ANGLE,
        "Enter the angle the arc turns through in its direction, up to 360 for the full circle.",
        high=360.0,
        above=0.0,
    ),
    _FEED,
)

BLEND: Final = (
    _size("radius", "RADIUS", "Enter the radius of the arc that blends the segments before and after."),
    _FEED,
)

TOOL: Final = (
    _count("number", "TOOL", "Enter the number of the tool.", 1, 9999),
    Field("type", "TYPE", Kind.TEXT, "Enter the type of the tool, such as END MILL."),
    _size("diameter", "TOOL DIAMETER", "Enter the diameter of the tool."),
)

PARAMETERS: Final = (
    _allowance("blend_offset", "BLEND OFFSET", "Enter the radius of the blend-in and blend-out arcs, or 0 for none."),
    _allowance("blend_overlap", "BLEND OVERLAP", "Enter how far a closed contour runs past its start."),
    _allowance("finish_xy", "FINISH XY", "Enter the material the roughing tool leaves on the sides."),
    _allowance("finish_z", "FINISH Z", "Enter the material the roughing tool leaves on the floor."),
    Field(
        "pocket_overlap",
        "POCKET OVERLAP",
        Kind.PERCENT,
        "Enter how much PROFILE passes overlap, in percent of the tool diameter.",
        0.0,
        99.0,
    ),
    _allowance("max_offset", "MAX OFFSET", "Enter how far outside the contour PROFILE passes begin."),
    _size("retract_clearance", "RETRACT CLEARANCE", "Enter how far above Z START the tool moves between pecks."),
    _allowance("peck_clearance", "PECK CLEARANCE", "Enter how far above the last depth a rapid down stops."),
    Field(
        "path",
        "PATH",
        Kind.CHOICE,
        "Select which center path is posted: the control's, or the best one.",
        choices=tuple(choice.value for choice in PathChoice),
    ),
)

SETUP: Final = (
    Field("name", "PART NAME", Kind.TEXT, "Enter a name for the part; it stands at the head of the NC file."),
    _count("work_offset", "WORK OFFSET", "Enter the work offset, 54 to 59 for G54 to G59.", 54, 59),
    _place("safe_z", "SAFE Z", "Enter the Z at which the tool may move freely above the part."),
)

SOLUTION: Final = Field(
    "choice",
    "SOLUTION",
    Kind.CHOICE,
    "Two solutions fit what is typed: select the one on the drawing.",
    choices=("0", "1"),
)
"""Which of two solutions a LINE or an ARC takes; a screen shows it only where there are two."""

TABLES: Final[Mapping[Form, tuple[Field, ...]]] = MappingProxyType(
    {
        Form.START: START,
        Form.LINE: LINE,
        Form.ARC: ARC,
        Form.BLEND: BLEND,
        Form.TOOL: TOOL,
        Form.PARAMETERS: PARAMETERS,
        Form.SETUP: SETUP,
    }
)

_BY_NAME: Final[Mapping[tuple[Form, str], Field]] = MappingProxyType(
    {(form, one.name): one for form, table in TABLES.items() for one in table}
    | {(Form.LINE, "choice"): SOLUTION, (Form.ARC, "choice"): SOLUTION}
)


def form_of(segment: Segment) -> Form:
    """The screen on which a segment is typed."""
    match segment:
        case LineSegment():
            return Form.LINE
        case ArcSegment():
            return Form.ARC
        case BlendSegment():
            return Form.BLEND
        case _:
            assert_never(segment)


def field(form: Form, name: str) -> Field:
    """The field `name` of a screen; KeyError if it has none of that name."""
    return _BY_NAME[form, name]


def check(one: Field, value: float, unit: Unit) -> str | None:
    """The sentence that refuses a value, in program units, that a field does not take, None for one it takes."""
    whole = one.kind is Kind.COUNT
    low, high = bounds(one, unit)
    fits = isfinite(value) and (not whole or value == int(value))
    fits = fits and (low is None or value >= low) and (high is None or value <= high)
    if fits and (one.above is None or value > one.above):
        return None
    return f"{one.label} must be {'a whole number ' if whole else ''}{range_of(one, unit) or 'a finite number'}."


def bounds(one: Field, unit: Unit) -> tuple[float | None, float | None]:
    """The least and the largest value a field takes, in program units."""
    low, high = one.low, one.high
    if unit is Unit.MM or one.kind not in (Kind.LENGTH, Kind.FEED):
        return low, high
    return None if low is None else from_mm(low, unit), None if high is None else from_mm(high, unit)


def range_of(one: Field, unit: Unit) -> str:
    """What a field takes, such as `from 1 to 20`; empty where everything goes."""
    low, high = bounds(one, unit)
    if one.above is not None:
        return f"above {one.above:g}" + ("" if high is None else f", at most {_plain(high)}")
    return "" if low is None or high is None else f"from {_plain(low)} to {_plain(high)}"


def _plain(bound: float) -> str:
    return f"{bound:.0f}" if bound == int(bound) else f"{bound:g}"


_DEFAULTS: Final[Mapping[str, tuple[float, float]]] = MappingProxyType(
    {
        "blend_offset": (0.125, 3.0),
        "blend_overlap": (0.125, 3.0),
        "finish_xy": (0.0, 0.0),
        "finish_z": (0.0, 0.0),
        "pocket_overlap": (50.0, 50.0),
        "max_offset": (0.0, 0.0),
        "retract_clearance": (0.1, 2.5),
        "peck_clearance": (0.05, 1.0),
        "work_offset": (54.0, 54.0),
        "safe_z": (1.0, 25.0),
    }
)


def default(name: str, unit: Unit) -> float | None:
    """What a blank on PROGRAM PARAMETERS or PART SETUP stands for, in program units; None if it stands for nothing."""
    inch, millimeter = _DEFAULTS.get(name, (None, None))
    return inch if unit is Unit.IN else millimeter
