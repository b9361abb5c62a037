"""Topics explain the fields in more detail than their prompts, some with a picture in plain ASCII."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from core.program.fields import FIELDS_OF_FORM, SOLUTION, Field, Form


@dataclass(frozen=True, slots=True)
class Topic:
    """Sentences about a field, and the lines of its picture, if any."""

    words: str
    picture: tuple[str, ...] = ()


_SIDES: Final = (
    "    LEFT                 RIGHT",
    "   ( o ) tool           |",
    "  ------> travel        ------> travel",
    "  part surface         ( o ) tool",
)
_ANGLE: Final = (
    "         90",
    "          |    / line, 45",
    "          |   /",
    "  180 ----+---- 0  (+X)",
    "          |",
    "        -90 = 270",
)
_SWEEP: Final = (
    "        ___",
    "      /     \\     CCW, SWEEP 180:",
    "     |   +   |    from o over the top to x",
    "     x center o",
)
_PECK: Final = (
    "  ==== Z START ====      0.0",
    "   |    first pass      -0.1",
    "   |    second pass     -0.2",
    "   v    last pass       -0.25  Z BOTTOM",
)
_BLEND: Final = (
    "  ------.    .------   path of the tool",
    "         \\  /",
    "          )(           arcs of this radius: in, out",
    "      o--'  '--o       tool goes down, comes up",
)
_AHEAD: Final = (
    "  __1__     __5__  a tool too large for the notch 2 3 4:",
    "       |2 4|       looking 1 ahead it goes in and gouges,",
    "       |_3_|       looking 3 ahead it leaves it out",
)
_OVERLAP: Final = (
    "   start            OVERLAP: on past the start, so that no",
    "  ---o======>       mark stays where path begins and ends",
)
_CORNER: Final = (
    "  ______          ______",
    "        |   ->          \\   RADIUS",
    "        |                |",
)

_FEED: Final = Topic(
    "The feed holds for the segments after it until another is typed. CAL shows the one in force: PLUNGE FEED where "
    "none is typed on segment 1."
)
_END_X: Final = Topic("Type what the drawing gives. What is blank is calculated, shown as CAL, and follows every edit.")
_END_Z: Final = Topic("Blank keeps the height. Another Z makes the tool ramp along the segment, never below Z BOTTOM.")
_CENTER: Final = Topic(
    "The point the arc turns about. End and center, or end and RADIUS, or center and SWEEP fix an arc."
)
_POINT: Final = Topic("A point that the drawing gives on this line or on the arc's circle, not one of its ends.")
_LINE_AND_ARC: Final = {
    "x_end": _END_X,
    "y_end": _END_X,
    "z_end": _END_Z,
    "point_x": _POINT,
    "point_y": _POINT,
    "tangent": Topic("YES where it continues the segment before without a corner and without turning back."),
    "choice": Topic(
        "The drawing shows all solutions. Space, left and right step through them; nothing is posted until one is "
        "picked."
    ),
}
"""The topics of fields that a LINE and an ARC share."""

TOPICS: Final[Mapping[tuple[Form, str], Topic]] = {
    (Form.START, "tool"): Topic(
        "The tool's diameter comes from TOOL SETUP; the path runs half of it away from the contour."
    ),
    (Form.START, "cutter_comp"): Topic(
        "ON runs the tool's center on the contour. LEFT and RIGHT keep the tool beside it, seen along the travel. "
        "PROFILE also clears the material outside in several passes.",
        _SIDES,
    ),
    (Form.START, "finish_tool"): Topic("0 is none. Else TOOL leaves the finish allowances, and this tool cuts them."),
    (Form.START, "x_start"): Topic(
        "START is where segment 1 begins. The middle of a side is a better place than a corner."
    ),
    (Form.START, "y_start"): Topic("START is where segment 1 begins. A contour that ends where it starts is closed."),
    (Form.START, "z_start"): Topic("The surface of the raw material. Rapids stay above it by RETRACT CLEARANCE."),
    (Form.START, "z_bottom"): Topic("The deepest the tool may go, below Z START: usually a negative number."),
    (Form.START, "plunge_feed"): Topic(
        "The feed straight down into the material. The tool also mills at it where FEED of segment 1 is blank."
    ),
    (Form.START, "speed"): Topic("Written as S before the block begins."),
    (Form.START, "peck_depth"): Topic(
        "The contour is milled once at each depth; the last pass takes what is left.", _PECK
    ),
    (Form.START, "coolant"): Topic("Turned on when the spindle turns. Blank takes the coolant of the tool."),
    (Form.START, "lookahead"): Topic(
        "How many segments ahead the path is checked for places that the tool cannot enter. CAL is the control's own "
        "value; one that is too small gouges, one that is too large leaves more uncut. Space shows all values, F3 "
        "goes back to CAL.",
        _AHEAD,
    ),
    (Form.LINE, "length"): Topic("Two of X END, Y END, XY LENGTH and XY ANGLE fix a line; the others are calculated."),
    (Form.LINE, "angle"): Topic(
        "The direction of travel, not of the edge: the same edge the other way is 180 more.", _ANGLE
    ),
    (Form.ARC, "direction"): Topic("CW turns as the hands of a clock, seen from above."),
    (Form.ARC, "x_center"): _CENTER,
    (Form.ARC, "y_center"): _CENTER,
    (Form.ARC, "radius"): Topic("The radius of the contour, not of the tool's path. With both ends, two arcs may fit."),
    (Form.ARC, "sweep"): Topic("How far around it goes, in its direction. 360 is the full circle.", _SWEEP),
    **{(form, name): topic for form in (Form.LINE, Form.ARC) for name, topic in _LINE_AND_ARC.items()},
    **{(form, "feed"): _FEED for form in (Form.LINE, Form.ARC, Form.BLEND, Form.CHAMFER)},
    (Form.LINE, "point_dist"): Topic("With POINT X and POINT Y: how far from that point the line passes."),
    (Form.LINE, "parallel"): Topic("The line runs in the direction of that LINE, or the opposite one."),
    (Form.LINE, "offset"): Topic("With PARALLEL TO: how far apart the two lines are."),
    (Form.ARC, "start_angle"): Topic("The direction of travel where the arc starts.", _ANGLE),
    (Form.BLEND, "radius"): Topic("The two segments are shortened to where this arc touches them.", _CORNER),
    (Form.CHAMFER, "length"): Topic("The two segments are shortened by this length.", _CORNER),
    (Form.TOOL, "number"): Topic("Blocks call the tool by it; T and H in the NC file have it. It sorts the table."),
    (Form.TOOL, "type"): Topic("Any words; they are in the NC file's head and on the setup sheet."),
    (Form.TOOL, "diameter"): Topic("The diameter it cuts. Every path of the tool follows a change at once."),
    (Form.TOOL, "speed"): Topic("Blocks with this tool run at it where their own SPEED is blank."),
    (Form.TOOL, "feed"): Topic("Blocks with this tool mill at it where segment 1 has no FEED."),
    (Form.TOOL, "plunge_feed"): Topic("Blocks with this tool go down at it where their own PLUNGE FEED is blank."),
    (Form.TOOL, "coolant"): Topic("Blocks with this tool turn it on where their own COOLANT is blank."),
    (Form.PARAMETERS, "blend_offset"): Topic(
        "The tool comes to the contour and leaves it on an arc. 0 goes straight.", _BLEND
    ),
    (Form.PARAMETERS, "blend_overlap"): Topic("Only closed contours have it.", _OVERLAP),
    (Form.PARAMETERS, "finish_xy"): Topic("Only with a FINISH TOOL on START: what it takes off the sides."),
    (Form.PARAMETERS, "finish_z"): Topic("Only with a FINISH TOOL on START: what it takes off the floor."),
    (Form.PARAMETERS, "pocket_overlap"): Topic("50 moves each PROFILE pass over by half the tool."),
    (Form.PARAMETERS, "max_offset"): Topic("The material outside the contour. 0 makes one pass along it."),
    (Form.PARAMETERS, "retract_clearance"): Topic("Up to this height above Z START nothing may be in the way."),
    (Form.PARAMETERS, "peck_clearance"): Topic("From there the tool goes on down at PLUNGE FEED."),
    (Form.PARAMETERS, "path"): Topic(
        "CONTROL is what the control itself would mill. BEST reaches all the tool can reach."
    ),
    (Form.PARAMETERS, "rapid_feed"): Topic("The times on PROGRAM and the setup sheet are based on it."),
    (Form.SETUP, "name"): Topic("Any words; the NC file has other characters for those that a control would act on."),
    (Form.SETUP, "work_offset"): Topic("Which of the machine's zero points the program counts from."),
    (Form.SETUP, "safe_z"): Topic("The height of tool changes and of the program's end. Clamps must be below it."),
}
"""The topics by form and field name."""


def topic_of(field: Field) -> Topic | None:
    """Return the topic of a field, or None if it has none."""
    for form, table in FIELDS_OF_FORM.items():
        for known in (*table, SOLUTION):
            if known == field and (form, field.name) in TOPICS:
                return TOPICS[form, field.name]
    return None
