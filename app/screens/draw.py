"""DRAW: the drawing on the whole terminal, finding by finding, with keys to enlarge, move and walk."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, Final

from textual import on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.widgets import Label

from app.screens.base import BaseScreen
from app.session.block_findings import Entry, block_findings
from app.session.messages import Sentence
from app.session.session import Session
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList, heading
from app.widgets.softkeys import Softkey
from app.widgets.verdict import MARKS, Case, chips
from core.program.edit import FormPlace

if TYPE_CHECKING:
    from core.draw.view import View
    from core.pipeline.plot import Subject

ZOOM: Final = 1.25
"""One press enlarges by this factor."""
PAN: Final = 0.125
"""One arrow moves the window by this part of it."""
FARTHEST: Final = 2.0
"""The window may move so many times the whole drawing away from it."""
PROMPT: Final = (
    "n p go from finding to finding, + - zoom, arrows move, 0 shows the whole part, "
    "Page Up and Page Down walk over the segments, Enter goes to the finding's field."
)


class FullDrawing(Drawing, can_focus=True):
    """The drawing with the keys of DRAW."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("n", "screen.finding(1)", "Next finding", show=False),
        Binding("p", "screen.finding(-1)", "Finding before", show=False),
        Binding("plus,equals_sign", "screen.zoom(1)", "Zoom in", show=False),
        Binding("minus", "screen.zoom(-1)", "Zoom out", show=False),
        Binding("0,home", "screen.fit", "Whole part", show=False),
        Binding("left", "screen.pan(-1, 0)", "Move left", show=False),
        Binding("right", "screen.pan(1, 0)", "Move right", show=False),
        Binding("up", "screen.pan(0, 1)", "Move up", show=False),
        Binding("down", "screen.pan(0, -1)", "Move down", show=False),
        Binding("pageup", "screen.walk(-1)", "Segment before", show=False),
        Binding("pagedown", "screen.walk(1)", "Next segment", show=False),
        Binding("enter", "screen.edit_finding", "Go to the field", show=False),
        Binding("m", "app.next_characters", "Characters", show=False),
    ]


class DrawScreen(BaseScreen):
    """One block, as it is posted; `finding` is the number of the finding in hand, None for the whole part."""

    AUTO_FOCUS: ClassVar[str | None] = "#full-drawing"
    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape", "app.back", "Back", show=False)]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("FINDING BEFORE", "finding(-1)", "BEFORE", lambda screen: bool(screen.entries), "No findings."),
        Softkey("NEXT FINDING", "finding(1)", "NEXT", lambda screen: bool(screen.entries), "No findings."),
        Softkey("ZOOM IN", "zoom(1)", "ZOOM+"),
        Softkey("ZOOM OUT", "zoom(-1)", "ZOOM-"),
        Softkey("WHOLE PART", "fit", "WHOLE"),
        Softkey("CHARACTERS", "app.next_characters", "CHARS"),
        None,
        Softkey("BACK", "app.back", "BACK"),
    )

    def __init__(self) -> None:
        super().__init__()
        self.entries: tuple[Entry, ...] = ()
        self.at: int | None = None
        self._subject: Subject | None = None

    def compose_body(self) -> ComposeResult:
        """Title, chips, the drawing, and on a wide terminal the findings beside it."""
        with Horizontal(classes="head"):
            yield Label("BLOCK", classes="head-label")
            yield Label(id="draw-block", classes="head-value")
            yield Label(id="draw-segment", classes="head-kind")
        yield Label(id="draw-chips")
        with Horizontal(id="draw-body"):
            with Vertical(id="draw-picture"):
                yield FullDrawing(id="full-drawing")
            yield FindingsList(id="draw-findings", classes="panel")

    @property
    def drawing(self) -> Drawing:
        """The drawing."""
        return self.query_exactly_one("#full-drawing", FullDrawing)

    def show_session(self, session: Session) -> None:
        """The block with the cursor as it is now, in the same window."""
        # shapely and numpy are not needed by the first paint
        from core.pipeline.plot import Subject

        block, unit = session.derived_block, session.program.unit
        self.entries = block_findings(block, session.lookahead_table, unit)
        self.query_exactly_one(FindingsList).entries = self.entries
        if self.at is not None and self.at >= len(self.entries):
            self.at = None
        segment = session.place.segment
        self.query_exactly_one("#draw-block", Label).update(str(block.number))
        self.query_exactly_one("#draw-segment", Label).update(
            f"DRAW   segment {segment}" if segment else "DRAW   START"
        )
        case = Case(block, session.lookahead_table, unit)
        self.query_exactly_one("#draw-chips", Label).update(chips(case, MARKS[self.host.characters]))
        before = self._subject
        near, view = (None, None) if before is None else (before.near, before.view)
        self._draw(Subject(block, unit, segment, near=near, view=view))
        self._head()

    def _draw(self, subject: Subject) -> None:
        self._subject = self.drawing.subject = subject

    def _head(self) -> None:
        marks = MARKS[self.host.characters]
        self.drawing.heading = "DRAWING" if self.at is None else heading(self.entries, self.at, marks)

    def action_finding(self, by: int) -> None:
        """The next finding that has a place, or the one before, in the middle of the window."""
        placed = [number for number, entry in enumerate(self.entries) if entry.at is not None]
        if not placed:
            self.say("No finding has a place in the drawing.")
            return
        here = placed.index(self.at) if self.at in placed else -1 if by > 0 else 0
        self._take(placed[(here + by) % len(placed)])

    def _take(self, number: int) -> None:
        self.at = number
        entry = self.entries[number]
        if self._subject is not None and entry.at is not None:
            self._draw(replace(self._subject, near=entry.at, view=None))
        self._head()
        self.query_exactly_one(FindingsList).highlighted = number
        self.say(entry.text)

    @on(FindingsList.Stepped)
    def _stepped(self, event: FindingsList.Stepped) -> None:
        if self.query_exactly_one(FindingsList).has_focus and event.number != self.at:
            self._take(event.number)

    @on(FindingsList.Chosen)
    def _chosen(self, event: FindingsList.Chosen) -> None:
        self.host.go_to(event.entry)

    def action_edit_finding(self) -> None:
        """The form, with the cursor on the place of the finding in hand."""
        if self.at is not None:
            self.host.go_to(self.entries[self.at])

    def action_zoom(self, steps: int) -> None:
        """Enlarge or shrink about the middle of the window."""
        if self.drawing.drawn is not None:
            self._look(self.drawing.drawn.view.zoom(ZOOM**steps))

    def action_pan(self, right: int, up: int) -> None:
        """Move the window over the part, but never far away from it."""
        drawn, size = self.drawing.drawn, self.drawing.size
        if drawn is None:
            return
        view = drawn.view.pan(PAN * right, PAN * up, size.width, size.height)
        if view.touches(drawn.bounds, FARTHEST):
            self._look(view)

    def _look(self, view: View) -> None:
        if self._subject is not None:
            self._draw(replace(self._subject, view=view))

    def action_fit(self) -> None:
        """The whole part."""
        self.at = None
        if self._subject is not None:
            self._draw(replace(self._subject, near=None, view=None))
        self._head()
        self.quiet()

    def action_walk(self, by: int) -> None:
        """The segment before or after, with the cutter at its end."""
        place = self.current_session.place
        self.host.move(FormPlace(place.block, place.segment + by))

    @on(Drawing.Wheel)
    def _wheel(self, event: Drawing.Wheel) -> None:
        self.action_zoom(event.steps)

    def prompt_text(self) -> Sentence:
        """What the keys do."""
        return Sentence(PROMPT)
