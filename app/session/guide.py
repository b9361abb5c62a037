"""The guide gives the next step of a small first part, a plate, from its first field to the posted file.

The guide has no state of its own: it derives the next step from the program and the field with the cursor, so no key,
wrong or right, can make it lose its place.  The plate is 2 by 1, milled around its outside from the middle of its lower
side, clockwise, with the tool on the left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from app.session.session import Session
from core.program.fields import Form, field_of, form_of
from core.program.model import Block, LineSegment, Number

EXAMPLE_CORNERS: Final = (("0", "0"), ("0", "1"), ("2", "1"), ("2", "0"), ("1", "0"))
"""The end points of the five lines."""
SAVE_NAME: Final = "Type a name such as plate, then Enter. Without a folder it goes where you started the program."
POST_NAME: Final = "Enter writes the NC file under the name that stands there."
NOT_NEEDED: Final = "This screen is not needed now: Ctrl+K, then 8 goes back."
GUIDE_COMPLETED: Final = "Typed, checked, saved, posted: that is the whole way."


@dataclass(frozen=True, slots=True)
class Step:
    """One field of the plate: the text to type there, and why."""

    segment: int
    name: str
    text: str
    why: str


STEPS: Final = (
    Step(0, "tool", "1", "Tool 1 of the tool table is an end mill of 0.5."),
    Step(0, "cutter_comp", "LEFT", "Seen along the travel, the tool runs on the left."),
    Step(0, "x_start", "1", "The contour begins in the middle of the lower side."),
    Step(0, "y_start", "0", "The lower side lies on Y 0."),
    Step(0, "z_start", "0", "The top of the material is Z 0."),
    Step(0, "z_bottom", "-.25", "The cut goes a quarter deep."),
    Step(0, "plunge_feed", "5", "The tool goes down into the material at this feed."),
    Step(0, "speed", "1000", "The spindle turns so many times a minute."),
    Step(1, "feed", "10", "The feed holds for the segments that follow too."),
    Step(1, "x_end", EXAMPLE_CORNERS[0][0], "First to the left corner."),
    Step(1, "y_end", EXAMPLE_CORNERS[0][1], "It lies on Y 0 too."),
    *(
        Step(
            number,
            name,
            text,
            f"Corner {number} of the plate." if number < len(EXAMPLE_CORNERS) else "Back to the start.",
        )
        for number, corner in enumerate(EXAMPLE_CORNERS[1:], 2)
        for name, text in zip(("x_end", "y_end"), corner, strict=True)
    ),
)


def next_step(session: Session) -> Step | None:
    """Return the first field of block 1 that does not yet match the plate; None if all do."""
    block = session.program.blocks[0]
    for step in STEPS:
        if step.segment > len(block.segments):
            return step
        held = _held(block, step)
        if held != step.text and not (isinstance(held, Number) and held.value == float(step.text)):
            return step
    return None


def _held(block: Block, step: Step) -> object:
    """Return what the block holds in the field of a step; None if the field is blank or the segment has none."""
    return getattr(block.segments[step.segment - 1] if step.segment else block, step.name, None)


def on_program(session: Session) -> str:
    """Return the next step on PROGRAM, the list of blocks."""
    if len(session.program.blocks) > 1:
        here = session.place.block
        return "Down goes to block 2." if here == 1 else f"The plate needs no block {here}: F1 deletes it."
    if next_step(session) is not None:
        return "Enter opens block 1, in which the contour is typed."
    if session.file is None or session.unsaved:
        return "Ctrl+S saves the program; it asks for a name."
    return "F3 POST NC writes the file for the machine (or Ctrl+K, then 3)."


def on_form(session: Session, names: Sequence[str], at: str, stop: str | None) -> str:
    """Return the next step on MILL CONTOUR: `names` are its fields, `at` has the cursor, Enter goes to `stop`."""
    step = next_step(session)
    if step is None:
        return _finished(session)
    block, place = session.program.blocks[0], session.place
    if place.block != 1:
        return "The plate is in block 1: F8 goes to the list of blocks."
    if step.segment > len(block.segments):
        return f"{len(block.segments)} of {len(EXAMPLE_CORNERS)} sides stand. Ctrl+End, then Page Down adds a LINE."
    held = block.segments[step.segment - 1] if step.segment else None
    typed = _held(block, step)
    label = field_of(Form.LINE if step.segment else Form.START, step.name).label.rstrip(".")
    wrong = f"{label} is {typed.value:g}, and the plate has {step.text}. " if isinstance(typed, Number) else ""
    if place.segment != step.segment:
        if step.segment == 0:
            return f"{wrong}START is next: Ctrl+Home goes there (or 0 and Enter on the SEGMENT line)."
        key = "Down" if place.segment < step.segment else "Up"
        return f"{wrong}Segment {step.segment} is next: Page {key} goes there."
    if held is not None and not isinstance(held, LineSegment):
        return f"The plate has a LINE here, and this is {form_of(held)}. F1 deletes it (or Ctrl+K, then 1)."
    if at != step.name:
        return f"{wrong}{'Enter' if stop == step.name else _arrow(names, at, step.name)} goes to {label}."
    if step.name == "cutter_comp":
        return f"{label}: press L until LEFT stands there. {step.why}"
    return f"{label}: type {step.text}, then Enter. {step.why}"


def _arrow(names: Sequence[str], at: str, there: str) -> str:
    """Return the arrow of the shorter way, which may wrap around, and how often to press it."""
    here = names.index(at) if at in names else 0
    down = (names.index(there) - here) % len(names)
    key, count = ("Down", down) if down <= len(names) - down else ("Up", len(names) - down)
    return key if count == 1 else f"{key}, {count} times,"


def _finished(session: Session) -> str:
    block = session.derived.block(1)
    if not block.complete:
        return "The contour is closed. The verdict is being calculated."
    if block.errors:
        return "The contour stands, but something is against it: F10 lists it, Ctrl+Z takes back what made it."
    if session.file is None or session.unsaved:
        return "The verdict says GOUGE none, and the drawing shows the tool's path. Ctrl+S saves; it asks for a name."
    return "Saved. F8 goes to the list of blocks (or Ctrl+K, then 8)."
