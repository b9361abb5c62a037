"""The guided first part: while the operator keys in a small plate, the prompt lines say the next step.

The guide keeps no place of its own: what comes next follows from the program as it stands and from the screen that is
seen, so that no key, wrong or right, can lose it.  The plate is 2 by 1, milled around its outside from the middle of
its lower side, clockwise, the tool on the left.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from app.documents import programs as files
from app.painted.messages import Load, Message, Post, Save
from app.painted.screens.ask import Ask
from app.painted.screens.contour import Contour
from app.painted.screens.contour_cells import fields_at
from app.painted.screens.new_segment import NewSegment
from app.painted.screens.post import PostPage
from app.painted.screens.program import ProgramPage
from app.painted.screens.save import SaveAsPage
from app.painted.session import SEGMENT, Said, Session
from core.program.fields import Form, field_of, form_of
from core.program.model import CutterComp, LineSegment, Number
from core.units import Unit

if TYPE_CHECKING:
    from app.painted.desk import Desk

CORNERS: Final = (("0", "0"), ("0", "1"), ("2", "1"), ("2", "0"), ("1", "0"))
"""Where the five lines end."""


@dataclass(frozen=True, slots=True)
class Step:
    """One field of the plate: what is typed there, and why."""

    segment: int
    name: str
    text: str
    why: str


STEPS: Final = (
    Step(0, "tool", "1", "Tool 1 of the tool table is an end mill of 0.5."),
    Step(0, "cutter_comp", "LEFT", "Seen along the travel, the tool runs on the left of the contour."),
    Step(0, "x_start", "1", "The contour begins in the middle of the lower side."),
    Step(0, "y_start", "0", "The lower side lies on Y 0."),
    Step(0, "z_start", "0", "The top of the material is Z 0."),
    Step(0, "z_bottom", "-.25", "The cut goes a quarter deep."),
    Step(1, "x_end", CORNERS[0][0], "First to the left corner."),
    Step(1, "y_end", CORNERS[0][1], "It lies on Y 0 too."),
    Step(1, "feed", "10", "The feed holds for the segments that follow too."),
    *(
        Step(number, name, text, f"Corner {number} of the plate." if number < len(CORNERS) else "Back to the start.")
        for number, corner in enumerate(CORNERS[1:], 2)
        for name, text in zip(("x_end", "y_end"), corner, strict=True)
    ),
)

KEPT: Final = (("finish_tool", "0"), ("plunge_feed", "20"), ("speed", "300"), ("peck_depth", "0"))
"""Fields of START that the plate leaves as a new program has them."""
BLANK: Final = ("z_end", "length", "angle", "feed")
"""Fields of a line that the plate leaves blank, but for the first line's feed."""

RESTORED: Final = (
    *(Step(0, name, text, "So a new program has it.") for name, text in KEPT),
    *(
        Step(number, name, "", "The plate needs nothing there.")
        for number in range(1, len(CORNERS) + 1)
        for name in BLANK
        if (number, name) != (1, "feed")
    ),
)
"""Where something else was typed in passing: looked at when the plate stands and something stands against it."""


def begin(desk: Desk) -> Desk:
    """A new program in inches with the guide on its prompt lines; unsaved work is asked about first."""
    opened = desk.take(Load(None))
    if isinstance(opened.page, Ask):
        return opened
    return replace(opened, session=Session.of(files.empty_program(Unit.IN)), guided=True)


def turned(desk: Desk) -> Desk:
    """The guide begun, or ended where it is on."""
    if desk.guided:
        return replace(desk, guided=False, session=desk.session.saying("The guide is off; the plate stays."))
    return begin(desk)


def after(before: Desk, desk: Desk, message: Message) -> Desk:
    """The desk, guided before a message and after it: the guide ends with the posted file, and with another program."""
    if isinstance(message, Load) and desk.session.saved is not before.session.saved:
        return replace(desk, guided=False)
    said = desk.session.said
    if isinstance(message, Save) and desk.session.saved is not before.session.saved and hint(desk) is not None:
        # that it is saved, and what comes next, are the guide's own words
        return replace(desk, session=desk.session.quiet())
    if isinstance(message, Post) and len(desk.pages) < len(before.pages) and said is not None:
        text = f"{said.text} Typed, proved, saved, posted: that is the whole way."
        return replace(desk, guided=False, session=desk.session.saying(text))
    return desk


def said(desk: Desk) -> Said | None:
    """What the prompt lines say while the guide is on; None where the screen's own words are better."""
    text = hint(desk)
    return None if text is None else Said(f"GUIDE  {text}")


def hint(desk: Desk) -> str | None:
    """The next step."""
    session = desk.session
    match desk.page:
        case Contour():
            return _on_form(session)
        case NewSegment(number):
            return _on_new(session, number)
        case ProgramPage():
            return _on_list(session)
        case SaveAsPage():
            return "Type a name such as plate, then Enter. Without a folder it goes where you started the program."
        case PostPage():
            return None if desk.page.path is not None else "Enter writes the NC file under the name that stands there."
        case Ask():
            return None
        case _:
            return "This screen is not needed now: F8 goes back to the plate (or Ctrl+K, then 8)."


def next_step(session: Session) -> Step | None:
    """The first field that is not yet as the plate wants it, in block 1."""
    block = session.program.blocks[0]
    for step in (*STEPS, *(RESTORED if session.found.errors else ())):
        if step.segment > len(block.segments):
            return step
        held = block if step.segment == 0 else block.segments[step.segment - 1]
        if not _meets(getattr(held, step.name, None), step.text):
            return step
    return None


def _meets(held: object, text: str) -> bool:
    if isinstance(held, CutterComp):
        return held == text
    if not text:
        return held is None
    return isinstance(held, Number) and held.value == float(text)


def _on_list(session: Session) -> str:
    if len(session.program.blocks) > 1:
        here = session.where.block
        return "Down goes to block 2." if here == 1 else f"The plate needs no block {here}: F1 deletes it."
    if next_step(session) is not None:
        return "Enter opens block 1, in which the contour is typed."
    if session.file is None or session.unsaved:
        return "Ctrl+S saves the program; it asks for a name."
    return "F6 POST NC writes the file for the machine (or Esc, then 6)."


def _on_form(session: Session) -> str:
    step = next_step(session)
    if step is None:
        return _finished(session)
    block, place = session.program.blocks[0], session.where
    if place.block != 1:
        return "The plate is in block 1: F8 goes to the list of blocks."
    if step.segment > len(block.segments):
        return _new_line(session)
    if step.segment and not isinstance(block.segments[step.segment - 1], LineSegment):
        return _other_kind(session, step)
    if place.segment != step.segment:
        return _to_segment(session, step)
    return _on_field(session, step)


def _on_new(session: Session, number: int) -> str:
    step, last = next_step(session), len(session.program.blocks[0].segments)
    if step is None or step.segment <= last:
        return "A new segment is not what comes next: Page Up goes back."
    if number <= last or session.where.block != 1:
        return "The next line belongs behind the last one of block 1: Page Up goes back."
    return "Press L for LINE, or F1: a straight segment."


def _new_line(session: Session) -> str:
    behind = "Page Down, then L, adds a LINE." if session.where.segment == len(session.block.segments) else ""
    return f"{len(session.block.segments)} of {len(CORNERS)} sides stand. {behind or 'Ctrl+End goes to the last one.'}"


def _other_kind(session: Session, step: Step) -> str:
    kind = form_of(session.program.blocks[0].segments[step.segment - 1])
    if session.where.segment != step.segment:
        return _to_segment(session, step)
    if session.field != SEGMENT:
        return f"The plate has a LINE here, and this is {kind}. Up goes to SEGMENT, where it can be deleted."
    return f"The plate has a LINE here, and this is {kind}. F1 deletes it (or Esc, then 1)."


def _to_segment(session: Session, step: Step) -> str:
    why = _difference(session, step)
    if step.segment == 0:
        return f"START is next{why}: Ctrl+Home goes there (or 0 and Enter on the SEGMENT line)."
    key = "Down" if session.where.segment < step.segment else "Up"
    return f"Segment {step.segment} is next{why}: Page {key} goes there."


def _difference(session: Session, step: Step) -> str:
    """Which field there is not as the plate wants it; nothing to say of a segment of another kind."""
    block = session.program.blocks[0]
    held = block.segments[step.segment - 1] if step.segment else block
    if step.segment and not isinstance(held, LineSegment):
        return ""
    label = field_of(Form.LINE if step.segment else Form.START, step.name).label.rstrip(".")
    match getattr(held, step.name):
        case Number(value):
            return f", its {label} is {value:g} instead of {step.text or 'blank'}"
        case CutterComp() as side:
            return f", its {label} is {side} instead of {step.text}"
        case None:
            return f", its {label} is blank"
        case _:
            return f", its {label} cannot be read"


def _on_field(session: Session, step: Step) -> str:
    form = Form.START if step.segment == 0 else Form.LINE
    label = field_of(form, step.name).label
    names = [SEGMENT, *(one.name for one in fields_at(session))]
    here = names.index(session.field) if session.field in names else 0
    if here != names.index(step.name):
        key = "Enter or down" if here < names.index(step.name) else "Up"
        return f"{key} goes to {label.rstrip('.')}."
    if step.name == "cutter_comp":
        return f"{label}: press L until LEFT stands there. {step.why}"
    if not step.text:
        return f"{label}: press Del, then Enter: it is blank then. {step.why}"
    return f"{label}: type {step.text}, then Enter. {step.why}"


def _finished(session: Session) -> str:
    if not session.found.known:
        return "The contour is closed. The verdict is being calculated."
    if session.found.errors:
        return "The contour is there, but the lines marked !! stand against it: Ctrl+Z takes back what made them."
    if session.file is None or session.unsaved:
        return "The verdict says GOUGE none, and the drawing shows the tool's path. Ctrl+S saves; it asks for a name."
    return "Saved. F8 goes to the list of blocks (or Esc, then 8)."
