"""DRAW: the drawing on the whole terminal, with keys to enlarge, move and walk over the segments."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Final

from app.painted.messages import Close, Message, Move, NextMode, Open, Say, Swap
from app.painted.screens.contour_cells import form_at
from app.painted.screens.findings import FindingsPage
from app.painted.screens.page import Answer, Layout, Page, Sketch, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.header import block_line, header, segment_line
from app.painted.widgets.words import number
from core.program.edit import FormPlace

STEP: Final = 1.25
"""One key press enlarges or shrinks by this factor."""
PAN: Final = 0.125
"""One arrow moves the window by this part of it."""
ARROWS: Final = {"left": (-PAN, 0.0), "right": (PAN, 0.0), "up": (0.0, PAN), "down": (0.0, -PAN)}
SEGMENTS: Final = {"n": 1, "pagedown": 1, "p": -1, "pageup": -1}
PROMPT: Final = (
    "+ - zoom on the {}, arrows move, 0 fits, n p walk, m characters, Esc goes back. "
    "S START, o plunge, # deleted, x by what, ! gouge."
)
SHORT: Final = "n p walk, Esc goes back. # deleted, x by what."
"""What stands behind a sentence on the cutter; the softkeys name the other keys."""
ZOOMING: Final = (
    "+ and - zoom on the cutter, where there is none on the segment or START. The arrows move the window: from then on "
    "they zoom on its middle. n and p go to the next segment and the one before, with the cutter in the window again. "
    "0 shows everything, m changes the characters."
)
LEGEND: Final = (
    "S is START, o where the tool goes down, the arrow the way it travels.",
    "# is surface that the look-ahead has deleted, x where two pieces meet that delete what is between them.",
    "! is where the path gouges. The ring is the cutter at the end of the segment's path, or where the path passes "
    "what is deleted.",
    "With block and ASCII characters the contour has whole lines, the center path dots.",
)
FARTHEST: Final = 2.0
"""One may move so many times the whole drawing away from it."""


@dataclass(frozen=True, eq=False, slots=True)
class DrawPage(Page):
    """The window is kept relative to the whole part, so that it survives edits and another terminal size."""

    layout: ClassVar[Layout] = Layout.DRAW
    sketch: Sketch = field(default_factory=Sketch)

    def softkeys(self, session: Session) -> Softkeys:
        """Every key of the drawing as a softkey."""
        return {
            1: Softkey("SEGMENT BACK", self._walked(session, -1)),
            2: Softkey("SEGMENT ADVANCE", self._walked(session, 1)),
            3: Softkey("FINDINGS", (Open(FindingsPage()),)),
            4: Softkey("ZOOM IN", (Swap(replace(self, sketch=zoomed(self.sketch, STEP))),)),
            5: Softkey("ZOOM OUT", (Swap(replace(self, sketch=zoomed(self.sketch, 1 / STEP))),)),
            6: Softkey("FIT", (Swap(replace(self, sketch=Sketch())),)),
            7: Softkey("CHARACTERS", (NextMode(),)),
            8: Softkey("EXIT", (Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enlarge, move, walk."""
        if character in ("+", "=", "-"):
            return self._with(zoomed(self.sketch, 1 / STEP if character == "-" else STEP))
        if key in ("0", "home"):
            return self._with(Sketch())
        if key in ARROWS:
            return self._with(panned(self.sketch, *ARROWS[key]))
        if key in SEGMENTS:
            return Answer(self, self._walked(session, SEGMENTS[key]))
        return Answer(self, (NextMode(),)) if key == "m" else None

    def escape(self, session: Session) -> Answer | None:
        """Back to the form."""
        return Answer(self, (Close(),))

    def _walked(self, session: Session, step: int) -> tuple[Message, ...]:
        """To another segment, its cutter in the window."""
        return (Swap(replace(self, sketch=followed(self.sketch))), *_walk(session, step))

    def _with(self, sketch: Sketch) -> Answer:
        return Answer(replace(self, sketch=sketch))

    def view(self, session: Session, surface: Surface) -> View:
        """The drawing; the two prompt lines name its keys and its signs."""
        form = form_at(session)
        title = f"{form}   zoom {self.sketch.zoom:.2g}" if self.sketch.zoom != 1.0 else str(form)
        line = segment_line(str(session.where.segment), title, cursor=False)
        return View(
            header(block_line(session), line, session, surface.width),
            (),
            Said(_prompt(session, self.sketch)),
            0,
            self.sketch,
        )

    def help(self, session: Session) -> tuple[str, ...]:
        """What the signs and lines of the drawing are."""
        return ("DRAW", ZOOMING, *LEGEND)


def _prompt(session: Session, sketch: Sketch) -> str:
    """Keys and signs, behind what is to be said of the cutter."""
    note = _cutter_note(session)
    return f"{note} {SHORT}" if note else PROMPT.format("middle" if _moved(sketch) else "cutter")


def _cutter_note(session: Session) -> str:
    """Why the cutter is not at the end of the segment: it was deleted, or nobody knows yet where its path runs."""
    found, segment = session.found, session.where.segment
    if segment > found.solved.determined:
        return f"Segment {segment} is not determined yet: no cutter is drawn."
    if not segment or not found.known or found.paths is None:
        return ""
    from core.pipeline.plot import cutter_at_segment

    place = cutter_at_segment(found, segment)
    if place is None:
        return f"No path runs along segment {segment}: no cutter is drawn."
    if place.by is None:
        return ""
    first, last = map(number, place.by)
    return f"Segment {segment} is deleted: the cutter stands where the path passes it, {first} meeting {last}."


def zoomed(sketch: Sketch, factor: float) -> Sketch:
    """The window enlarged about the cutter; about its middle, once the arrows have moved it."""
    zoom = min(max(sketch.zoom * factor, 0.02), 1e4)
    if not _moved(sketch):
        return replace(sketch, zoom=zoom)
    # what stands in the middle stays there: offsets are in parts of a window that shrinks
    by = zoom / sketch.zoom
    return _held(replace(sketch, zoom=zoom, middle=sketch.middle * by), sketch.dx * by, sketch.dy * by)


def followed(sketch: Sketch) -> Sketch:
    """As much enlarged, with the cutter in the window, wherever the arrows have moved it."""
    return Sketch(zoom=sketch.zoom)


def _moved(sketch: Sketch) -> bool:
    """Whether the arrows have moved the window since it showed everything or the cursor walked."""
    return sketch != followed(sketch)


def panned(sketch: Sketch, dx: float, dy: float) -> Sketch:
    """The window moved by parts of it."""
    return _held(sketch, sketch.dx + dx, sketch.dy + dy)


def _held(sketch: Sketch, dx: float, dy: float) -> Sketch:
    limit = FARTHEST * max(sketch.zoom, 1.0)
    return replace(sketch, dx=min(max(dx, -limit), limit), dy=min(max(dy, -limit), limit))


def _walk(session: Session, step: int) -> tuple[Message, ...]:
    there = session.where.segment + step
    if not 0 <= there <= len(session.block.segments):
        return (Say("That is the last segment." if step > 0 else "START is the first."),)
    return (Move(FormPlace(session.where.block, there)),)
