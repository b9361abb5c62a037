"""This module defines the fields of the screens (label, kind, range, prompt, default) and reads what is typed in them.

The forms, the file reader and the messages share one table, so that a field has the same name everywhere.
A field's `name` is its attribute in the model and its key in the program file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from math import isfinite
from typing import Final

from core.program.model import (
    ArcSegment,
    BlendSegment,
    ChamferSegment,
    Coolant,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    PathChoice,
    Relative,
    Segment,
    Typed,
    Unread,
)
from core.units import Kind, Unit, Unreadable, from_mm, parse, printable


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `low` and `high` are inclusive bounds on what may be typed, None means no bound.

    Bounds on lengths and feeds are in millimeters, so that a field accepts the same part in both units.
    """

    name: str
    label: str
    kind: Kind
    prompt: str
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()
    """The words it takes: the members of its enumeration, except for TANGENT."""
    above: float | None = None
    """An exclusive lower bound, such as 0 for a diameter."""
    relative: bool = False
    """True if an I before or after the number makes it relative."""
    short_prompt: str = ""
    """What stands for a prompt that is too long for two lines of 60 columns."""


class Form(StrEnum):
    """The screens that have fields."""

    START = "START"
    LINE = "LINE"
    ARC = "ARC"
    BLEND = "BLEND ARC"
    CHAMFER = "CHAMFER"
    TOOL = "TOOL SETUP"
    PARAMETERS = "PROGRAM PARAMETERS"
    SETUP = "PART SETUP"


LARGEST_LENGTH: Final = 254000.0
"""Largest coordinate or length in millimeters, and feed in millimeters per minute: 10000 in, beyond any machine."""

LARGEST_SPEED: Final = 100000
"""Largest SPEED in revolutions per minute."""

SEGMENT_PROMPT: Final = (
    "Enter a segment number, use ENTER to edit segment, or use left arrow (back), right arrow (advance), or softkey."
)

LOOKAHEAD_PROMPT: Final = (
    "Enter a cutter comp lookahead value to override the calculated value. Not recommended unless necessary. "
    "1 to 20. F3 goes back to CAL."
)
SHORT_LOOKAHEAD_PROMPT: Final = "1 to 20 in place of the calculated value. Not recommended unless necessary. F3: CAL."


def _place(name: str, label: str, prompt: str, *, relative: bool = False) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, -LARGEST_LENGTH, LARGEST_LENGTH, relative=relative)


def _heading(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.ANGLE, prompt, -360.0, 360.0, relative=True)


def _size(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, high=LARGEST_LENGTH, above=0.0)


def _allowance(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.LENGTH, prompt, 0.0, LARGEST_LENGTH)


def _feed(name: str, label: str, prompt: str) -> Field:
    return Field(name, label, Kind.FEED, prompt, high=LARGEST_LENGTH, above=0.0)


def _count(name: str, label: str, prompt: str, low: float, high: float) -> Field:
    return Field(name, label, Kind.COUNT, prompt, low, high)


def _choice(name: str, label: str, prompt: str, choices: Iterable[str]) -> Field:
    return Field(name, label, Kind.CHOICE, prompt, choices=tuple(choices))


def _coolant(prompt: str) -> Field:
    return _choice("coolant", "COOLANT", prompt, Coolant)


_FEED: Final = _feed("feed", "FEED", "Feed along this segment. Blank: as the segment before.")
_X_END: Final = _place("x_end", "X END", "X of the end of this segment. I5: 5 from its start.", relative=True)
_Y_END: Final = _place("y_end", "Y END", "Y of the end of this segment. I5: 5 from its start.", relative=True)
_Z_END: Final = _place("z_end", "Z END", "Z at the end of this segment. Blank: as the segment before.")

_TANGENT: Final = _choice("tangent", "TANGENT", "YES: smooth from the segment before. Space switches.", ("NO", "YES"))

START: Final = (
    _count("tool", "TOOL", "Tool number. Space lists the tools.", 1, 9999),
    _choice("cutter_comp", "CUTTER COMP.", "Side of the tool, seen along travel. Space lists.", CutterComp),
    _count("finish_tool", "FINISH TOOL", "Tool for the finish pass; 0 = none.", 0, 9999),
    _place("x_start", "X START", "X where the contour starts."),
    _place("y_start", "Y START", "Y where the contour starts."),
    _place("z_start", "Z START", "Z of the top of the material."),
    _place("z_bottom", "Z BOTTOM", "Z of the bottom of the cut."),
    _feed("plunge_feed", "PLUNGE FEED", "Plunge feed."),
    _count("speed", "SPEED (RPM)", "Spindle speed, revolutions per minute.", 1, LARGEST_SPEED),
    _allowance("peck_depth", "PECK DEPTH", "Depth of one pass; 0 = full depth."),
    replace(_count("lookahead", "CUTCOMP LOOKAHEAD", LOOKAHEAD_PROMPT, 1, 20), short_prompt=SHORT_LOOKAHEAD_PROMPT),
    _coolant("Coolant of the block. Del blanks it: as TOOL SETUP has it for the tool."),
)

LINE: Final = (
    _X_END,
    _Y_END,
    _Z_END,
    _place("point_x", "POINT X", "X of a point that the line passes, on it or at DISTANCE."),
    _place("point_y", "POINT Y", "Y of a point that the line passes, on it or at DISTANCE."),
    _allowance("point_dist", "DISTANCE", "Distance of the point from the line. Blank: the point is on the line."),
    _size("length", "XY LENGTH", "Length of the line in the XY plane."),
    _heading("angle", "XY ANGLE", "Angle from +X, counterclockwise, degrees. I90: from the segment before, left."),
    _count("parallel", "PARALLEL TO", "Number of an earlier LINE to which this one is parallel.", 1, 9999),
    _allowance("offset", "OFFSET", "Distance from the line that PARALLEL TO names. Blank: any."),
    _FEED,
    _TANGENT,
)

ARC: Final = (
    _choice("direction", "DIRECTION", "Direction of travel along the arc.", Direction),
    _X_END,
    _Y_END,
    _Z_END,
    _place("point_x", "POINT X", "X of a point on the arc's circle."),
    _place("point_y", "POINT Y", "Y of a point on the arc's circle."),
    _place("x_center", "X CENTER", "X of the center of the arc. I5: 5 from its start.", relative=True),
    _place("y_center", "Y CENTER", "Y of the center of the arc. I5: 5 from its start.", relative=True),
    _size("radius", "RADIUS", "Radius of the arc."),
    Field("sweep", "SWEEP ANGLE", Kind.ANGLE, "Angle the arc turns through; 360 = full circle.", high=360.0, above=0.0),
    _heading("start_angle", "START ANGLE", "Direction in which the arc starts, from +X. I90: from the segment before."),
    _FEED,
    _TANGENT,
)

BLEND: Final = (_size("radius", "RADIUS", "Radius of the arc between the segments before and after."), _FEED)

CHAMFER: Final = (_size("length", "LENGTH", "Length cut off both segments at their corner."), _FEED)

TOOL: Final = (
    _count("number", "TOOL", "Tool number.", 1, 9999),
    Field("type", "TYPE", Kind.TEXT, "Type of the tool, such as END MILL."),
    _size("diameter", "TOOL DIAMETER", "Diameter of the tool."),
    _count("speed", "SPEED (RPM)", "Spindle speed of blocks that leave theirs blank.", 1, LARGEST_SPEED),
    _feed("feed", "FEED", "Feed of contours that leave theirs blank."),
    _feed("plunge_feed", "PLUNGE FEED", "Plunge feed of blocks that leave theirs blank."),
    _coolant("Coolant of blocks that leave theirs blank."),
)

PARAMETERS: Final = (
    _allowance("blend_offset", "BLEND OFFSET", "Radius of the blend-in and blend-out arcs; 0 = none."),
    _allowance("blend_overlap", "BLEND OVERLAP", "How far a closed contour runs past its start."),
    _allowance("finish_xy", "FINISH XY", "Material the roughing tool leaves on the sides."),
    _allowance("finish_z", "FINISH Z", "Material the roughing tool leaves on the floor."),
    Field(
        "pocket_overlap",
        "POCKET OVERLAP",
        Kind.PERCENT,
        "Overlap of PROFILE passes, percent of the tool diameter.",
        0.0,
        99.0,
    ),
    _allowance("max_offset", "MAX OFFSET", "How far outside the contour PROFILE passes begin."),
    _size("retract_clearance", "RETRACT CLEARANCE", "How far above Z START the tool moves between pecks."),
    _allowance("peck_clearance", "PECK CLEARANCE", "How far above the last depth a rapid down stops."),
    _choice("path", "PATH", "Path to post. CONTROL: as the look-ahead makes it. BEST: the true offset.", PathChoice),
    _feed("rapid_feed", "RAPID RATE", "Rapid rate of the machine a minute, for the times. Faster feeds are reported."),
)

SETUP: Final = (
    Field("name", "PART NAME", Kind.TEXT, "Part name, for the head of the NC file."),
    _count("work_offset", "WORK OFFSET", "Work offset, 54 to 59 for G54 to G59.", 54, 59),
    _place("safe_z", "SAFE Z", "Z at which the tool moves freely above the part."),
)

SOLUTION: Final = Field(
    "choice", "SOLUTION", Kind.CHOICE, "Space shows the next solution; the others are dotted in the drawing."
)
"""The solution that a LINE, an ARC or a run of them takes; a screen shows this field only if there is a choice."""

MAX_CHOICE: Final = (1 << 24) - 1
"""The largest solution number in a program file."""

PICK: Final = (
    _place("pick_x", "PICK X", "X of a point near the end of the run's first segment, as on the drawing."),
    _place("pick_y", "PICK Y", "Y of a point near the end of the run's first segment, as on the drawing."),
)
"""The point the operator picks on the drawing, stored on a run's first segment; not fields of its form."""

FIELDS_OF_FORM: Final[Mapping[Form, tuple[Field, ...]]] = {
    Form.START: START,
    Form.LINE: LINE,
    Form.ARC: ARC,
    Form.BLEND: BLEND,
    Form.CHAMFER: CHAMFER,
    Form.TOOL: TOOL,
    Form.PARAMETERS: PARAMETERS,
    Form.SETUP: SETUP,
}

STORED_FIELDS: Final[Mapping[Form, tuple[Field, ...]]] = {
    form: (*table, *PICK) if form in (Form.LINE, Form.ARC) else table for form, table in FIELDS_OF_FORM.items()
}
"""Everything that is stored for each screen: its fields, and the pick of a LINE or an ARC."""

NUMBER_FIELDS: Final[Mapping[Form, tuple[Field, ...]]] = {
    form: tuple(field for field in table if field.kind not in (Kind.CHOICE, Kind.TEXT))
    for form, table in STORED_FIELDS.items()
}
"""The fields of each screen that take a number."""

_BY_NAME: Final[Mapping[tuple[Form, str], Field]] = {
    (form, field.name): field for form, table in STORED_FIELDS.items() for field in table
} | {(Form.LINE, "choice"): SOLUTION, (Form.ARC, "choice"): SOLUTION}


SEGMENT_FORMS: Final[Mapping[type[Segment], Form]] = {
    LineSegment: Form.LINE,
    ArcSegment: Form.ARC,
    BlendSegment: Form.BLEND,
    ChamferSegment: Form.CHAMFER,
}


def form_of(segment: Segment) -> Form:
    """Return the screen on which a segment is typed."""
    return SEGMENT_FORMS[type(segment)]


def field_of(form: Form, name: str) -> Field:
    """Return the field `name` of a screen; raise KeyError if it has no such field."""
    return _BY_NAME[form, name]


def value_refusal(field: Field, value: float, unit: Unit) -> str | None:
    """Return the sentence that refuses a value (in program units), None if the field accepts it."""
    whole_number = field.kind is Kind.COUNT
    low, high = bounds(field, unit)
    refused = (
        not isfinite(value)
        or (whole_number and value != int(value))
        or (low is not None and value < low)
        or (high is not None and value > high)
        or (field.above is not None and value <= field.above)
    )
    if not refused:
        return None
    wanted = f"{'a whole number ' if whole_number else ''}{range_of(field, unit) or 'a finite number'}"
    return f"{field.label} must be {wanted}."


def bounds(field: Field, unit: Unit) -> tuple[float | None, float | None]:
    """Return the smallest and the largest value a field accepts, in program units."""
    low, high = field.low, field.high
    if unit is Unit.MM or field.kind not in (Kind.LENGTH, Kind.FEED):
        return low, high
    return None if low is None else from_mm(low, unit), None if high is None else from_mm(high, unit)


def range_of(field: Field, unit: Unit) -> str:
    """Describe the range of a field, such as `from 1 to 20`; return an empty string if it is unbounded."""
    low, high = bounds(field, unit)
    if field.above is not None:
        return f"above {field.above:g}" + ("" if high is None else f", at most {_plain(high)}")
    return "" if low is None or high is None else f"from {_plain(low)} to {_plain(high)}"


def _plain(bound: float) -> str:
    return f"{bound:.0f}" if bound == int(bound) else f"{bound:g}"


_DEFAULTS: Final[Mapping[str, tuple[float, float]]] = {
    "blend_offset": (0.125, 3.0),
    "blend_overlap": (0.125, 3.0),
    "finish_xy": (0.0, 0.0),
    "finish_z": (0.0, 0.0),
    "pocket_overlap": (50.0, 50.0),
    "max_offset": (0.0, 0.0),
    "retract_clearance": (0.1, 2.5),
    "peck_clearance": (0.05, 1.0),
    "rapid_feed": (200.0, 5000.0),
    "work_offset": (54.0, 54.0),
    "safe_z": (1.0, 25.0),
}


def default_value(name: str, unit: Unit) -> float | None:
    """Return the default for a blank on PROGRAM PARAMETERS or PART SETUP, in program units; None if it has none."""
    inch, millimeter = _DEFAULTS.get(name, (None, None))
    return inch if unit is Unit.IN else millimeter


TYPE_AGAIN: Final = "Type it again."
"""The message for a text that was refused before but could be read now."""


def read_typed(text: str, field: Field, unit: Unit) -> Typed:
    """Return what was typed: None for a blank, a number, or Unread text that is unreadable or out of range."""
    if not text.strip():
        return None
    number, relative = split_relative(text, field)
    value = parse(number, field.kind, unit)
    if isinstance(value, Unreadable):
        return Unread(text, value.reason)
    refusal = text_refusal(text, field, unit)
    if refusal is not None:
        return Unread(text, refusal)
    return Relative(value) if relative else Number(value)


def split_relative(text: str, field: Field) -> tuple[str, bool]:
    """Strip the I before or after a number; return the text and True if there was an I that makes it relative."""
    bare = text.strip()
    if field.relative and len(bare) > 1:
        if bare[0] in "Ii" and not bare[1].isalpha():
            return bare[1:], True
        if bare[-1] in "Ii" and not bare[-2].isalpha():
            return bare[:-1], True
    return text, False


def text_refusal(text: str, field: Field, unit: Unit) -> str | None:
    """Return the sentence that refuses a readable number outside the field's range; None for any other text."""
    value = parse(split_relative(text, field)[0], field.kind, unit)
    refusal = None if isinstance(value, Unreadable) else value_refusal(field, value, unit)
    return None if refusal is None else f"{refusal.removesuffix('.')}, not {printable(text)}."


def unread_reason(text: str, field: Field, unit: Unit) -> str:
    """Return why a text stays unread; a text that the field would now accept must be typed again."""
    typed = read_typed(text, field, unit)
    return typed.reason if isinstance(typed, Unread) else TYPE_AGAIN


def unread_sentence(unread: Unread) -> str:
    """Return the sentence about an unread text: its reason, preceded by the text unless the reason quotes it."""
    typed = printable(unread.text)
    return unread.reason if typed in unread.reason else f"{typed} cannot be read. {unread.reason}"


def typed_trouble(field: Field, typed: Number | Relative | Unread, unit: Unit) -> tuple[str, str] | None:
    """Return the code and the sentence of the fault in a typed field, None if it can be used."""
    if isinstance(typed, Number | Relative):
        refusal = value_refusal(field, typed.value, unit)
    elif (refusal := text_refusal(typed.text, field, unit)) is None:
        return "UNREADABLE", f"{field.label}: {unread_sentence(typed)}"
    return None if refusal is None else ("OUT_OF_RANGE", refusal)
