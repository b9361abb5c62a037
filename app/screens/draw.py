"""DRAW shows the drawing on the whole terminal; its keys zoom, pan, and step through findings and segments."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, Final, cast

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.widgets import Label, OptionList

from app.screens.base import BaseScreen
from app.screens.contour_cells import run_here, run_trouble
from app.screens.dialogs import NumberEntry, NumberForm
from app.session.block_findings import Entry, block_findings
from app.session.formats import length, place
from app.session.messages import Sentence, Tone
from app.session.session import Session
from app.widgets.drawing import LOOK_KEYS, Drawing
from app.widgets.findings_list import FindingsList, heading
from app.widgets.plain import PlainLabel
from app.widgets.softkeys import Softkey
from app.widgets.verdict import MARKS_OF_CHARACTERS, Case, chips
from core.program.edit import FormPlace, pick_joint
from core.program.model import Number
from core.program.solve.solved import SolvedRun
from core.units import Kind, sentence, to_mm

if TYPE_CHECKING:
    from core.geometry.piece import Point
    from core.pipeline.plot import Subject

NO_PICK: Final = "This segment needs no pick."
PROMPT: Final = (
    "N and P step the findings, Enter edits. + and - zoom, arrows move, 0 is the whole part, Page Up and Down walk."
)


class FullDrawing(Drawing, can_focus=True):
    """The drawing with the keys of DRAW."""

    BINDINGS: ClassVar[list[BindingType]] = [
        *LOOK_KEYS,
        Binding("n,N", "screen.finding(1)", "Next finding", show=False),
        Binding("p,P", "screen.finding(-1)", "Finding before", show=False),
        Binding("0,home", "screen.fit", "Whole part", show=False),
        Binding("pageup", "screen.walk(-1)", "Segment before", show=False),
        Binding("pagedown", "screen.walk(1)", "Next segment", show=False),
        Binding("enter", "screen.enter", "Go to the field", show=False),
        Binding("shift+left", "screen.move_cross(-8, 0)", "Cross left", show=False),
        Binding("shift+right", "screen.move_cross(8, 0)", "Cross right", show=False),
        Binding("shift+up", "screen.move_cross(0, 8)", "Cross up", show=False),
        Binding("shift+down", "screen.move_cross(0, -8)", "Cross down", show=False),
        Binding("x,X", "screen.type_cross", "Type X and Y of the pick", show=False),
    ]

    def action_pan(self, right: int, up: int) -> None:
        """Move the cross while picking a joint, otherwise the window."""
        if isinstance(self.screen, DrawScreen) and self.screen.cross is not None:
            self.screen.action_move_cross(right, up)
        else:
            super().action_pan(right, up)


class DrawScreen(BaseScreen):
    """The drawing of one block as it is posted; `at` is the index of the selected finding, None for none."""

    AUTO_FOCUS: ClassVar[str | None] = "#full-drawing"
    BINDINGS: ClassVar[list[BindingType]] = [Binding("escape", "leave", "Back", show=False)]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("FINDING BEFORE", "finding(-1)", "BEFORE", lambda screen: bool(screen.entries), "No findings."),
        Softkey("NEXT FINDING", "finding(1)", "NEXT", lambda screen: bool(screen.entries), "No findings."),
        Softkey("ZOOM IN", "zoom(1)", "ZOOM+"),
        Softkey("ZOOM OUT", "zoom(-1)", "ZOOM-"),
        Softkey("WHOLE PART", "fit", "WHOLE"),
        Softkey("CHARACTERS", "app.next_characters", "CHARS"),
        Softkey("PICK JOINT", "pick", "PICK", lambda screen: screen.run is not None, NO_PICK),
        Softkey("BACK", "app.back", "BACK"),
    )

    def __init__(self) -> None:
        super().__init__()
        self.entries: tuple[Entry, ...] = ()
        self.at: int | None = None
        self.cross: Point | None = None
        """The cross that the operator moves while picking a joint, in millimeters; None at other times."""

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the chips, the drawing, and on a wide terminal the findings next to it."""
        with Horizontal(classes="head"):
            yield PlainLabel("BLOCK", classes="head-label")
            yield PlainLabel(id="draw-block", classes="head-value")
            yield PlainLabel(id="draw-segment", classes="head-kind")
        yield PlainLabel(id="draw-chips")
        with Horizontal(id="draw-body"):
            with Vertical(id="draw-picture"):
                yield FullDrawing(id="full-drawing")
            yield FindingsList(id="draw-findings", classes="panel")

    @property
    def drawing(self) -> Drawing:
        """The drawing widget."""
        return self.query_one("#full-drawing", FullDrawing)

    def _redraw(self, **changes: object) -> None:
        """Change what the drawing shows."""
        if self.drawing.subject is not None:
            self.drawing.subject = replace(self.drawing.subject, **changes)

    def show_session(self, session: Session) -> None:
        """Show the block with the cursor as it is now; the window stays."""
        # imported here: the first paint must not load shapely and numpy
        from core.pipeline.plot import Subject

        block, unit = session.derived_block, session.program.unit
        self.entries = block_findings(block, session.lookahead_table, unit)
        self.query_one(FindingsList).entries = self.entries
        if self.at is not None and self.at >= len(self.entries):
            self.at = None
        segment = session.place.segment
        self.query_one("#draw-block", Label).update(str(block.number))
        self.query_one("#draw-segment", Label).update(f"DRAW   segment {segment}" if segment else "DRAW   START")
        case = Case(block, session.lookahead_table, unit)
        self.query_one("#draw-chips", Label).update(
            chips(case, MARKS_OF_CHARACTERS[self.host.characters], findings_key="N")
        )
        before = cast("Subject | None", self.drawing.subject)
        near, view = (None, None) if before is None else (before.near, before.view)
        self.drawing.subject = Subject(block, unit, segment, near=near, view=view, cross=self.cross)
        self._show_heading()
        if before is None and self.run is not None and self.run.code == "NOT_YET":
            self.action_pick()

    def _show_heading(self) -> None:
        marks = MARKS_OF_CHARACTERS[self.host.characters]
        self.drawing.heading = "DRAWING" if self.at is None else heading(self.entries, self.at, marks)

    def action_finding(self, by: int) -> None:
        """Say the next or previous finding, and center the window on it if it has a place in the drawing."""
        if not self.entries:
            self.say("No findings.")
            return
        here = self.at if self.at is not None else -1 if by > 0 else 0
        self._take((here + by) % len(self.entries))

    def action_panel(self, name: str) -> None:
        """Move the cursor between the drawing and the findings if they are in view; else go to MILL CONTOUR."""
        findings = self.query_one(FindingsList)
        if name == "findings" and findings.display:
            (self.drawing if findings.has_focus else findings).focus()
        else:
            super().action_panel(name)

    def _take(self, number: int) -> None:
        self.at = number
        entry = self.entries[number]
        if entry.at is not None:
            self._redraw(near=entry.at, view=None)
        self._show_heading()
        self.query_one(FindingsList).highlighted = number
        self.say(entry.text)

    @on(OptionList.OptionHighlighted)
    def _stepped(self, event: OptionList.OptionHighlighted) -> None:
        late = event.option_index != event.option_list.highlighted
        if event.option_list.has_focus and not late and event.option_index != self.at:
            self._take(event.option_index)

    def action_zoom(self, steps: int) -> None:
        """Zoom in or out about the cross, or about the center of the window without one."""
        self.drawing.action_zoom(steps)

    def action_fit(self) -> None:
        """Show the whole part and select no finding."""
        self.at = None
        self._redraw(near=None, view=None)
        self._show_heading()
        self.clear_notice()

    def action_walk(self, by: int) -> None:
        """Go to the previous or next segment; the cutter is drawn at its end."""
        place = self.current_session.place
        self.host.move(FormPlace(place.block, place.segment + by))

    # ---- picking a joint of a run that cannot be solved without one

    @property
    def run(self) -> SolvedRun | None:
        """The run of the segment with the cursor, if it needs a pick or has one."""
        session = self.current_session
        run = run_here(session)
        if run is None or run.code == "NOT_YET":
            return run
        first = session.block.segments[run.first - 1]
        return run if getattr(first, "pick_x", None) is not None else None

    def action_pick(self) -> None:
        """Show or hide the cross, which the arrows move."""
        run, session = self.run, self.current_session
        if run is None or self.cross is not None:
            self._show_cross(None)
            return
        first = session.block.segments[run.first - 1]
        at = [getattr(first, name) for name in ("pick_x", "pick_y")]
        if all(isinstance(each, Number) for each in at):
            self._show_cross((to_mm(at[0].value, session.program.unit), to_mm(at[1].value, session.program.unit)))
        else:
            pieces = run.sketch or tuple(piece for answer in run.answers for _, piece in answer.pieces)
            self._show_cross(pieces[-1].point_at(0.5) if pieces else (0.0, 0.0))

    def _show_cross(self, at: Point | None) -> None:
        self.cross = self.drawing.zoomed_about = at
        self._redraw(cross=at)
        self.clear_notice()
        self.refresh_frame()

    def action_move_cross(self, right: int, up: int) -> None:
        """Move the cross by character cells; the window follows it."""
        drawn, size = self.drawing.drawn, self.drawing.size
        if self.cross is None or drawn is None:
            return
        view = drawn.view
        column, row = view.cell(self.cross, size.width, size.height)
        column, row = column + right, row - up
        if not (0 <= column < size.width and 0 <= row < size.height):
            self.drawing.show_view(view.pan(right / size.width, up / size.height, size.width, size.height))
        self._show_cross(view.at(column, row, size.width, size.height))

    @work(exclusive=True, group="question")
    async def action_type_cross(self) -> None:
        """Ask for X and Y of the pick and take it."""
        run, unit = self.run, self.current_session.program.unit
        if run is None:
            self.say(NO_PICK)
            return
        line = f"A point near the end of segment {run.first}."
        form = NumberForm("PICK JOINT", [line], [NumberEntry(name, Kind.LENGTH, "") for name in ("X", "Y")], unit)
        typed = await self.app.push_screen_wait(form)
        if typed:
            self._show_cross((to_mm(typed[0], unit), to_mm(typed[1], unit)))
            self._take_cross(run, *typed)

    def action_enter(self) -> None:
        """Take the pick at the cross; without a cross, go to the field of the selected finding, or back."""
        run, unit = self.run, self.current_session.program.unit
        if self.cross is not None and run is not None:
            x, y = (float(length(each, unit)) for each in self.cross)
            self._take_cross(run, x, y)
        elif self.at is not None:
            self.host.go_to(self.entries[self.at])
        else:
            self.call_later(self.run_action, "app.back")

    def _take_cross(self, run: SolvedRun, x: float, y: float) -> None:
        """Write the pick, in program units, into the program and report the result."""
        session = self.current_session
        place = FormPlace(session.place.block, run.first)
        name = f"segments {run.first} to {run.last}" if run.first < run.last else f"segment {run.first}"
        if not self.host.apply(pick_joint(session.program, place, x, y), f"PICK JOINT of {name}"):
            return
        trouble, run_after = run_trouble(self.current_session), run_here(self.current_session)
        if trouble is not None:
            self.say(sentence(trouble, session.program.unit), Tone.ERROR)
        elif run_after is not None:
            self._show_cross(None)
            more = f" SOLUTION on the form has {count - 1} more." if (count := len(run_after.answers)) > 1 else ""
            self.say(f"{name.capitalize()} calculated.{more} Esc goes back to the form.")

    async def action_leave(self) -> None:
        """Hide the cross; without one, leave the screen."""
        if self.cross is not None:
            self._show_cross(None)
        else:
            await self.run_action("app.back")

    @on(Drawing.Picked)
    def _picked(self, event: Drawing.Picked) -> None:
        """Put the cross where the click was; without a cross, go to the nearest segment."""
        from core.pipeline.plot import nearest_segment

        if self.cross is not None:
            self._show_cross(event.at)
            return
        session = self.current_session
        if (segment := nearest_segment(session.derived_block, event.at)) is not None:
            self.host.move(FormPlace(session.place.block, segment))

    def prompt_text(self) -> Sentence:
        """Return what the keys do, with the cross's position while it is shown."""
        run, unit = self.run, self.current_session.program.unit
        if self.cross is None or run is None:
            return Sentence(PROMPT)
        return Sentence(
            f"Point near the end of segment {run.first}: {place(self.cross, unit)}. Arrows move the cross, with Shift "
            "8 cells, + - zoom, x types X and Y, Enter takes it, Esc leaves it."
        )
