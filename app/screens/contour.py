"""MILL CONTOUR is the form for START and the segments of one block, filled in field by field."""

from __future__ import annotations

from dataclasses import replace
from math import dist
from textwrap import wrap
from typing import TYPE_CHECKING, ClassVar, Final

from textual import events, on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.widget import Widget
from textual.widgets import DataTable, Label, OptionList
from textual.widgets.option_list import Option

from app.documents.tool_tables import tool_line
from app.screens.base import LIST_KEYS
from app.screens.block_actions import COPY_AND_MOVE, INSERT_AND_DELETE, BlockActions
from app.screens.contour_cells import (
    RIGHT_COLUMN,
    cells_at,
    fields_at,
    form_at,
    next_stop,
    run_here,
    run_label,
    run_lacks,
    run_stops,
    run_trouble,
    solved_segment,
    unanswered,
    value_at,
)
from app.screens.dialogs import ChooseLine
from app.screens.form_screen import TONES, FormScreen
from app.session.block_findings import TO_TYPE, WAITING_CODES, Entry, block_findings, remedy
from app.session.guide import on_form
from app.session.messages import Sentence, Tone
from app.session.session import Cursor, Session
from app.session.work import Work
from app.widgets.block_drawings import BlockDrawings
from app.widgets.drawing import Drawing
from app.widgets.field import LISTED_FIELDS, ChoiceField, Form, NumberField
from app.widgets.findings_list import FindingsList
from app.widgets.plain import PlainLabel, show_text
from app.widgets.segment_list import SegmentList
from app.widgets.softkeys import Softkey
from app.widgets.verdict import Case, Verdict
from core.finding import Finding, Severity
from core.pipeline.derived import DerivedBlock
from core.program import edit
from core.program import fields as table
from core.program.edit import SEGMENT_FIELD, Edited, FormPlace, Refused
from core.program.fields import SEGMENT_PROMPT, Field, read_typed
from core.program.model import ArcSegment, BlendSegment, ChamferSegment, LineSegment, Number, Segment, Typed
from core.program.solve.solved import Value
from core.units import Kind, sentence

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row

FIRST_SEGMENT: Final = "Use ENTER to edit START, then right arrow or Page Down for the first segment."
NEW_SEGMENTS: Final[dict[str, type[Segment]]] = {
    "l": LineSegment,
    "a": ArcSegment,
    "b": BlendSegment,
    "c": ChamferSegment,
}
"""The letters that add a new segment, or change the kind of one that is still empty."""
LETTER_FIELDS: Final = ("x_end", "y_end", "radius", "length")
"""The number fields of an empty segment that take those letters."""
KINDS_PROMPT: Final = "L LINE, A ARC, B BLEND ARC, C CHAMFER"
LATER_PROMPT: Final = "Or Page Down: the next segment may give it."
CLOSED_PROMPT: Final = "The contour is closed. F8 leaves it; right arrow adds a segment."

DEPTH_FIELDS: Final = frozenset({"z_start", "z_bottom"})
"""The fields of START between which the cut lies."""
SWITCHED_FIELDS: Final = frozenset({"choice", "tangent"})
"""Choices that Space steps through: SOLUTION to the next answer, TANGENT to the other one."""

NEAR_CELLS: Final = 1.5
"""Columns within which a click picks the number of a finding."""
PANELS: Final = ("segments", "findings")
"""The lists that replace the drawing when the terminal has no room for both."""

LIST_PROMPTS: Final = {
    "segments": "Up and down choose a segment. Enter edits it, Del deletes it, Ins inserts one before it. F9",
    "findings": "Up and down show the places of the findings. Enter goes to the field to be corrected. F10",
}
"""What the keys of each list do, up to what its own key does."""


class SegmentField(NumberField):
    """SEGMENT: a typed number goes to that segment, the left and right arrows step through the segments."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("left", "screen.walk(-1)", "Segment before", show=False),
        Binding("right", "screen.walk(1)", "Next segment", show=False),
    ]
    letters = "".join(NEW_SEGMENTS)


class ContourScreen(BlockActions, FormScreen):
    """The form of one block; the cursor is on SEGMENT or in a field."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("pageup", "walk(-1)", "Segment before", show=False),
        Binding("pagedown", "walk(1)", "Next segment", show=False),
        Binding("ctrl+home", "go(0)", "START", show=False),
        Binding("ctrl+end", "go(-1)", "Last segment", show=False),
        Binding("space", "list_field", "List of this field", show=False, priority=True),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey(
            "DELETE SEGMENT", "delete_segment", "DELETE", lambda screen: screen.on_segment, "START cannot be deleted."
        ),
        Softkey(
            "INSERT SEGMENT BEFORE",
            "insert_segment",
            "INSERT",
            lambda screen: screen.on_segment,
            "START is always first.",
        ),
        Softkey(
            "RECALCULATE LOOKAHEAD",
            "recalculate",
            "RECALC",
            lambda screen: screen.has_lookahead,
            "RECALCULATE LOOKAHEAD is on START, with CUTTER COMP. LEFT or RIGHT.",
        ),
        Softkey("PROGRAM PARAMETERS", "app.parameters", "PARAMS"),
        Softkey("PART SETUP", "app.part_setup", "SETUP"),
        Softkey("TOOL SETUP", "app.tools", "TOOLS"),
        Softkey("DRAW", "app.draw", "DRAW"),
        Softkey("EXIT to program", "app.program", "EXIT"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (*LIST_KEYS, ("?", "KEYS, HELP"))
    PALETTE_ACTIONS: ClassVar[tuple[tuple[str, str, str], ...]] = (
        *FormScreen.PALETTE_ACTIONS,
        *COPY_AND_MOVE,
        *INSERT_AND_DELETE,
    )

    def __init__(self) -> None:
        super().__init__()
        self._displayed: Session | None = None
        self._forms: dict[table.Form, Form] = {}
        self._form = table.Form.START
        self._cursor: Cursor | None = None
        self.entries: tuple[Entry, ...] = ()
        self.selected_finding: int | None = None
        """The index of the selected placed finding; None shows the segment, or on START the first finding."""
        self._shows_trial = False
        """Whether the other fields show what they would be with a half-typed number."""
        self._left_field: tuple[FormPlace, str] | None = None
        """The segment and field that the cursor left to go to a list."""

    # ---- display

    def compose_body(self) -> ComposeResult:
        """Lay out the title lines, the form, the verdict, the drawings and the two lists."""
        session = self.host.session
        with Vertical(id="work"):
            with Vertical(id="form", classes="panel") as form:
                form.border_title = "MILL CONTOUR"
                with Horizontal(id="block", classes="head"):
                    yield PlainLabel("BLOCK", classes="head-label")
                    yield PlainLabel(id="block-number", classes="head-value")
                    yield PlainLabel("MILL CONTOUR", classes="head-kind")
                    yield PlainLabel(id="file", classes="head-note")
                with Horizontal(classes="head"):
                    yield PlainLabel("SEGMENT", id="segment-label", classes="head-label")
                    yield SegmentField(SEGMENT_FIELD, str(session.place.segment), id=SEGMENT_FIELD)
                    yield PlainLabel(id="segment-kind", classes="head-kind")
                    yield PlainLabel(id="segment-count", classes="head-note")
                with Vertical(id="fields"):
                    yield self._made_form(session)
            yield Verdict(id="verdict", classes="panel")
        yield BlockDrawings(id="drawings")
        yield SegmentList(id="segments", classes="panel")
        yield FindingsList(id="findings", classes="panel")

    def _made_form(self, session: Session) -> Form:
        self._form = form_at(session)
        return self._forms.setdefault(self._form, Form(cells_at(session)))

    def form(self) -> Form:
        """Return the form of the segment with the cursor."""
        return self._forms[self._form]

    def show_session(self, session: Session) -> None:
        """Show the form of the segment with the cursor; if the cursor has moved, focus its field."""
        wanted = form_at(session)
        if wanted is not self._form:
            self._switch_form(session, wanted)
        self._shows_trial = False
        self.form().show(cells_at(session))
        self._show_titles(session)
        self._offer_letters(session)
        if session.cursor is not self._cursor:
            self._cursor = session.cursor
            self.selected_finding = None
            if session.cursor.field is not None:
                self.focus_field(session.cursor.field)

    def _switch_form(self, session: Session, wanted: table.Form) -> None:
        """Switch to another kind of form; each is made when it is first needed."""
        self.form().display = False
        self._form = wanted
        if wanted in self._forms:
            self.form().display = True
        else:
            self.call_next(self._mount_form, self._made_form(session))

    async def _mount_form(self, form: Form) -> None:
        """Mount a new form and focus its field; the next key is read only when this is done."""
        await self.query_one("#fields").mount(form)
        self._offer_letters(self.current_session)
        if self.current_session.cursor.field is not None:
            self.focus_field(self.current_session.cursor.field)
        self.refresh_frame()

    def _offer_letters(self, session: Session) -> None:
        """Let letters in the first numbers of an empty segment change its kind."""
        empty = session.segment is not None and edit.is_empty(session.segment)
        for name in LETTER_FIELDS:
            if isinstance(field := self.form().field(name), NumberField):
                field.letters = "".join(NEW_SEGMENTS) if empty else ""

    def _show_titles(self, session: Session) -> None:
        last, segment = len(session.block.segments), session.place.segment
        texts = {
            "block-number": str(session.place.block),
            # a half-typed number changes nothing yet, and the status line says so too
            "file": self.current_session.file_label,
            "segment-kind": f"{form_at(session):<8}{run_label(session)}".rstrip(),
            "segment-count": f"of {last}" if last else "",
        }
        for name, text in texts.items():
            show_text(self.query_one(f"#{name}", Label), text, layout=True)
        self.query_one(f"#{SEGMENT_FIELD}", SegmentField).show(str(segment))

    def follow_displayed(self, displayed: Session) -> None:
        """Update verdict, drawings and lists; keep the block's last ones while a new path is being calculated."""
        if not self.in_view or displayed is self._displayed:
            return
        self._displayed = displayed
        self._show_trial(displayed)
        block, unit, verdict = displayed.derived_block, displayed.program.unit, self.query_one(Verdict)
        before = verdict.case
        if not block.complete and before is not None and before.block.number == block.number and before.block.complete:
            return
        verdict.case = Case(block, displayed.lookahead_table, unit)
        self.entries = block_findings(block, displayed.lookahead_table, unit)
        findings = self.query_one(FindingsList)
        findings.entries = self.entries
        if self.entries and before is not None and before.block.number != block.number:
            findings.highlighted = 0
        self._show_lists(displayed)
        if block.complete or before is not None:
            # skipped in the first paint, which must not load the numeric libraries
            self._show_drawings(displayed)

    def show_signs(self) -> None:
        """Redraw the signs of the segment list and of the loupe's title."""
        self._show_lists(self.host.displayed)
        self._show_drawings(self.host.displayed)

    def show_work(self, work: Work | None) -> None:
        """Show the progress in the verdict's title too; the last verdict stays until the work is done."""
        super().show_work(work)
        if not self.is_live:
            return
        verdict, displayed = self.query_one(Verdict), self.host.displayed
        if verdict.case is not None and not displayed.derived_block.complete:
            stopped = self.host.stopped is displayed.program
            verdict.case = replace(verdict.case, working=None if work is None else work.done, stopped=stopped)

    def show_rows(self, block: DerivedBlock, rows: tuple[Row, ...]) -> None:
        """Fill in the judged values of a look-ahead table that is still being made."""
        verdict = self.query_one(Verdict)
        if verdict.case is not None and verdict.case.block is block and verdict.case.table is None:
            verdict.case = replace(verdict.case, rows=rows)

    def _show_trial(self, displayed: Session) -> None:
        """Show the other fields as a half-typed number would make them, or as they were."""
        trial = displayed is not self.current_session
        if trial or self._shows_trial:
            inputs = {name: row.input for name, row in self.form().rows.items() if trial}
            # also a field that a click has left, until its text is taken: it must not pass for the program's
            typed = {
                name
                for name, each in inputs.items()
                if each is not None and (each is self.current or (isinstance(each, NumberField) and each.edited))
            }
            self.form().show([cell for cell in cells_at(displayed) if cell.name not in typed])
            self._show_titles(displayed)
            self._shows_trial = trial

    def _show_lists(self, displayed: Session) -> None:
        segments = self.query_one(SegmentList)
        if segments.display:
            segments.show(displayed)

    @on(events.Resize)
    def _fill_lists(self) -> None:
        """Refresh the lists: a larger terminal may show one that was hidden."""
        self.call_after_refresh(lambda: self._show_lists(self.host.displayed))

    @property
    def placed(self) -> list[Entry]:
        """The findings that have a position in the drawing."""
        return [entry for entry in self.entries if entry.at is not None]

    def _show_drawings(self, displayed: Session) -> None:
        placed = self.placed
        selected_finding = self.selected_finding
        if selected_finding is None and not displayed.place.segment and placed:
            selected_finding = 0
        self.query_one(BlockDrawings).show(displayed, placed, selected_finding, self.host.characters)

    def action_finding(self, by: int) -> None:
        """Move the loupe to the next or previous finding; on START it is on the first one at the beginning."""
        first = None if self.on_segment else 0
        self.step_finding(by, first if self.selected_finding is None else self.selected_finding)

    def step_finding(self, by: int, here: int | None) -> None:
        """Move the loupe to the finding after or before `here`, or to the first or last one if that is None."""
        placed = self.placed
        if not placed:
            self.say("There are no findings.")
        else:
            self._select((0 if by > 0 else len(placed) - 1) if here is None else (here + by) % len(placed))

    def _select(self, at: int) -> None:
        """Move the loupe and the list to one of the findings that have a position in the drawing."""
        self.selected_finding = at
        self._show_drawings(self.host.displayed)
        self.query_one(FindingsList).highlighted = self.entries.index(self.placed[at])

    @on(Drawing.Picked)
    def _picked_in_drawing(self, event: Drawing.Picked) -> None:
        """Select the finding whose number was clicked; any other click goes to the nearest segment."""
        from core.pipeline.plot import nearest_segment

        placed = self.placed
        reach = NEAR_CELLS * (0.0 if event.drawing.drawn is None else event.drawing.drawn.view.scale)
        near = [at for at, entry in enumerate(placed) if entry.at is not None and dist(entry.at, event.at) <= reach]
        if near and event.drawing.id == "outline":
            self._select(near[0])
        elif (segment := nearest_segment(self.current_session.derived_block, event.at)) is not None and self.take():
            self.go(segment)

    # ---- panels

    def open_panel(self, name: str) -> None:
        """Move the cursor into a list, even if it is open already."""
        self._close_panels()
        self.action_panel(name)

    def _close_panels(self) -> None:
        self.remove_class("-full", *(f"-{panel}" for panel in PANELS))

    def _can_grow(self, name: str | None) -> bool:
        """Return whether an open list has few rows and could have those of the form too."""
        small = self.has_class("-narrow") or (name == "findings" and self.has_class("-native"))
        return small and not self.has_class("-full")

    def action_panel(self, name: str) -> None:
        """Move the cursor into a list, which replaces the drawing unless there is room for both, or close the list.

        A list of few rows first gets the place of the form too.
        After the list the cursor returns to the field where it was.
        """
        if not self.take():
            return
        self.clear_notice()
        if self.current is not None:
            self._left_field = (self.current_session.place, self.current.name or SEGMENT_FIELD)
        is_open, target = self.has_class(f"-{name}"), self.query_one(f"#{name}", Widget)
        if is_open and self._can_grow(name):
            self.add_class("-full")
            self.set_focus(target)
            self.refresh_frame()
            return
        for panel in PANELS:
            self.set_class(panel == name and not is_open, f"-{panel}")
        self.remove_class("-full")
        if is_open:
            self._focus_left_field()
        else:
            self._show_lists(self.host.displayed)
            self.set_focus(target)

    def _focus_left_field(self) -> None:
        """Focus the field that the cursor left to go to a list, or SEGMENT if another segment was chosen there."""
        place, name = self._left_field or (None, SEGMENT_FIELD)
        self.focus_field(name if place == self.current_session.place else SEGMENT_FIELD)

    def action_restore(self) -> None:
        """Restore the old value; from a list, go back to the form and the drawing."""
        if not self.half_typed:
            self._close_panels()
            if self.current is None:
                # the next digit is typed into the field and does not press a softkey
                self.clear_notice()
                self._focus_left_field()
                return
        super().action_restore()

    @on(DataTable.RowHighlighted)
    def _segment_highlighted(self, event: DataTable.RowHighlighted) -> None:
        """Move the form to the highlighted row's segment; skip events for rows the cursor has already left."""
        late = event.cursor_row != event.data_table.cursor_row
        if event.data_table.has_focus and not late and event.cursor_row != self.current_session.place.segment:
            self.query_one(SegmentList).program_row = event.cursor_row
            self.host.move(FormPlace(self.current_session.place.block, event.cursor_row), None)

    @on(DataTable.RowSelected)
    def _segment_selected(self) -> None:
        self.focus_field(self.names()[1])

    @on(OptionList.OptionHighlighted, "#findings")
    def _finding_stepped(self, event: OptionList.OptionHighlighted) -> None:
        """Move the loupe to the highlighted finding; skip events for rows the cursor has already left."""
        if not event.option_list.has_focus or event.option_index != event.option_list.highlighted:
            return
        entry = self.entries[event.option_index]
        placed = self.placed
        self.selected_finding = placed.index(entry) if entry in placed else None
        self._show_drawings(self.host.displayed)

    # ---- the fields

    def fields(self) -> tuple[Field, ...]:
        """Return the fields of START or of the segment."""
        return fields_at(self.current_session)

    def names(self) -> list[str]:
        """Return SEGMENT, the left column, then the right; SOLUTION, last for Enter, is in the left column."""
        right = RIGHT_COLUMN[form_at(self.current_session)]
        return [SEGMENT_FIELD, *sorted(super().names(), key=right.__contains__)]

    def widget(self, name: str) -> NumberField | ChoiceField | None:
        """Return the widget of SEGMENT or of a field of the form."""
        return self.query_one(f"#{SEGMENT_FIELD}", SegmentField) if name == SEGMENT_FIELD else super().widget(name)

    def focus_field(self, name: str) -> None:
        """Put the cursor on a field, or on SEGMENT if the field belongs to another form, as a finding's may."""
        # the form comes back if the findings had its place
        self.remove_class("-full")
        super().focus_field(SEGMENT_FIELD if self.widget(name) is None else name)

    def value(self, name: str) -> Value | str:
        """Return what a field holds."""
        return value_at(self.current_session, name)

    def edited(self, field: Field, text: str) -> Edited:
        """Return the program with this text in a field of the form."""
        session = self.current_session
        if field.name == "choice":
            return edit.take_solution(session.program, session.place, int(text.partition(" ")[0]) - 1)
        if field.kind is Kind.CHOICE:
            return edit.choose(session.program, session.place, field.name, text or None)
        typed = read_typed(text, field, session.program.unit)
        return edit.type_field(session.program, session.place, field.name, typed)

    def label(self, field: Field) -> str:
        """Return FIELD of START or of a segment, plus the run whose calculated fields the edit changes."""
        place, run = self.current_session.place, run_here(self.current_session)
        where = "START" if place.segment == 0 else f"segment {place.segment}"
        where += f", run {run.first}-{run.last}" if run is not None and run.first < run.last else ""
        return f"{field.label} of {where}, block {place.block}"

    def trouble(self, field: Field) -> Sentence | None:
        """Return an error about this field, a doubt about the tool's size, advice, or why the run has no answer.

        The verdict has the rest.
        """
        session = self.current_session
        for finding in session.derived_block.findings:
            here = finding.field == field.name and int(finding.segment or 0) == session.place.segment
            to_type = finding.code in TO_TYPE
            if here and finding.severity is Severity.ERROR and (session.block.segments or not to_type):
                text = sentence(finding, session.program.unit) + self._or_later(finding)
                if not to_type:
                    return Sentence(text, Tone.ERROR)
                return Sentence(self._with_prompt(text, field) or text, Tone.WARNING)
            if here and finding.code == "TOOL_SIZE":
                # a number in the wrong unit is to be seen where the tool is called
                return Sentence(sentence(finding, session.program.unit), Tone.WARNING)
        advice = "" if self.on_segment else remedy(session.lookahead_table, field.name, session.program.unit)
        return Sentence(advice, Tone.WARNING) if advice else self._run_sentence(self.prompt_of(field), field)

    def _or_later(self, finding: Finding) -> str:
        """Return a hint that the next segment may determine this one; empty if it does not apply."""
        session, segment = self.current_session, self.current_session.segment
        last = session.place.segment == len(session.block.segments)
        if finding.code != "MISSING" or not last or segment is None or edit.is_empty(segment) or run_stops(session):
            return ""
        return f" {LATER_PROMPT}"

    def _run_sentence(self, prompt: str, field: Field | None = None) -> Sentence | None:
        """Return why this segment's run has no answer, with the prompt if there is room.

        While a run waits for values, the prompt of a field comes first, and alone if there is no room for both and
        the sentence does not name the field.
        """
        session = self.current_session
        finding = run_trouble(session)
        if finding is None:
            return None
        waits = finding.code in WAITING_CODES
        tone = Tone.WARNING if finding.code in TO_TYPE else Tone.ERROR
        text = sentence(finding, session.program.unit) + self._or_later(finding)
        elsewhere = finding.segment != session.place.segment and f"egment {finding.segment:g} " not in text
        if not waits and finding.field not in (None, "choice") and elsewhere:
            text = f"Segment {finding.segment:g}: {text}"
        if finding.code == "NOT_YET":
            text += f" Or F7: point to the end of segment {finding.segment:g}."
        if field is None or not waits:
            fits = finding.code != "NOT_YET" and len(text) < self.size.width - 1
            return Sentence(f"{text}\n{prompt}" if fits else text, tone)
        both = self._with_prompt(text, field)
        if not both and finding.code in TO_TYPE and field.label not in text:
            return Sentence(prompt)
        return Sentence(both or text, tone)

    def _with_prompt(self, text: str, field: Field) -> str:
        """Return a field's prompt and then a text, if both fit the two lines of the prompt; else an empty text."""
        for both in (f"{self.prompt_of(field)}\n{text}", f"{self.prompt_of(field)} {text}"):
            if sum(len(wrap(line, self.size.width - 2)) for line in both.split("\n")) <= 2:
                return both
        return ""

    def prompt_text(self) -> Sentence:
        """Return a list's keys, the prompt of SEGMENT, an empty LINE's other kinds, or the field's prompt."""
        if self.focused is not None and self.focused.id in LIST_PROMPTS:
            empty = self.focused.id == "findings" and not self.entries
            keys = "There are no findings in this block. F10" if empty else LIST_PROMPTS[self.focused.id]
            return Sentence(f"{keys} {'makes it taller' if self._can_grow(self.focused.id) else 'closes'}.")
        segment, field = self.current_session.segment, self.current_field
        if isinstance(segment, LineSegment) and edit.is_empty(segment) and field is not None and field.name == "x_end":
            widget = self.current
            if isinstance(widget, NumberField) and not widget.edited:
                return Sentence(f"{field.prompt} Or: {KINDS_PROMPT.partition(', ')[2]}.")
        if field is not None and field.name == "direction" and segment is not None and edit.is_empty(segment):
            return Sentence(f"{super().prompt_text().text} Or: L LINE, B BLEND ARC.")
        if isinstance(self.current, SegmentField):
            prompt = SEGMENT_PROMPT if self.current_session.block.segments else FIRST_SEGMENT
            return self._run_sentence("Right arrow: next segment. ENTER: edit this one.") or Sentence(prompt)
        return super().prompt_text()

    def guide_text(self) -> str:
        """Return the next step of the guide's plate."""
        session, at = self.current_session, "" if self.current is None else self.current.name or ""
        return on_form(session, self.names(), at, next_stop(session, at))

    @property
    def at_rest(self) -> bool:
        """True if the cursor is in a field and nothing in it is half-typed."""
        return self.current is not None and self.focused is self.current and not self.half_typed

    def refresh_frame(self) -> None:
        """Also mark SEGMENT with > while it has the cursor."""
        super().refresh_frame()
        text = "SEGMENT >" if isinstance(self.current, SegmentField) else "SEGMENT"
        show_text(self.query_one("#segment-label", Label), text)

    # ---- moving between segments

    def take(self) -> bool:
        """Take the field; discard a segment number that was not confirmed by Enter."""
        if isinstance(self.current, SegmentField):
            self.current.restore()
            return True
        return super().take()

    def action_accept(self) -> None:
        """Take the field and go to the next one that needs an answer; after the last one, to the next segment.

        A new value that leaves a run unsolved or nothing to cut keeps the cursor once.  On SEGMENT a typed number goes
        to that segment.
        """
        widget = self.current
        if widget is None or (isinstance(widget, SegmentField) and widget.edited):
            if isinstance(widget, SegmentField):
                self._jump(widget)
            return
        self.clear_notice()
        before = self.current_session.program
        if not self.take():
            return
        session = self.current_session
        stop = next_stop(session, widget.name or "")
        # a later field of this segment may still supply what is missing
        may_follow = stop is not None and run_lacks(session)
        if session.program is not before and run_stops(session) and not may_follow:
            return
        depths = (each for each in session.derived_block.findings if each.code == "Z_ORDER")
        no_depth = next(depths, None) if widget.name in DEPTH_FIELDS else None
        if session.program is not before and no_depth is not None:
            # after a new Z START the old Z BOTTOM is the one to be corrected
            self.focus_field("z_bottom")
            self.say(sentence(no_depth, session.program.unit), TONES[no_depth.severity])
            return
        if stop is not None:
            self.focus_field(stop)
        else:
            self._form_done()

    def _form_done(self) -> None:
        """After a form's last field, go back to a field that still needs an answer, else to the next segment."""
        session = self.current_session
        missing = unanswered(session)
        if missing is not None:
            self.focus_field(missing)
        elif session.place.segment == 0 and session.block.segments:
            self.focus_field(SEGMENT_FIELD)
        elif session.place.segment < len(session.block.segments):
            self.go(session.place.segment + 1)
        elif session.derived_block.solved.closed:
            self.focus_field(SEGMENT_FIELD)
            if not self.host.guided:
                self.say(CLOSED_PROMPT)
        elif (fault := self._fault_here()) is not None and fault.field in self.names():
            # no later segment mends numbers that contradict each other
            self.focus_field(fault.field)
            self.say(sentence(fault, session.program.unit), Tone.ERROR)
        else:
            self._insert(session.place.segment + 1, LineSegment())

    def _fault_here(self) -> Finding | None:
        """Return what is wrong with the numbers of the LINE or ARC with the cursor, if other segments do not matter."""
        run = run_here(self.current_session)
        if not isinstance(self.current_session.segment, LineSegment | ArcSegment) or (run and run.first != run.last):
            return None
        findings = solved_segment(self.current_session).findings
        errors = (each for each in findings if each.severity is Severity.ERROR)
        return next((each for each in errors if each.code not in WAITING_CODES), None)

    def _jump(self, widget: SegmentField) -> None:
        text, session = widget.value.strip(), self.current_session
        last = len(session.block.segments)
        widget.restore()
        if not text:
            self.clear_notice()
        elif not (text.isascii() and text.isdigit()):
            self.say(f"{text} is not a segment number: type digits only, such as 3, then Enter.", Tone.ERROR)
        elif not last and int(text):
            self.say(f"No segment {text} yet. ENTER edits START, right arrow adds segment 1.", Tone.ERROR)
        elif int(text) > last:
            self.say(f"No segment {text}. 0 to {last}, or right arrow past {last} for a new one.", Tone.ERROR)
        else:
            self.clear_notice()
            self.go(int(text))

    def go(self, number: int) -> None:
        """Move the cursor to a segment of this block; in one that is still empty, to its first field."""
        session = self.current_session
        field, segment = SEGMENT_FIELD, session.block.segments[number - 1] if number else None
        if segment is not None and edit.is_empty(segment):
            field = table.FIELDS_OF_FORM[table.form_of(segment)][0].name
        self.host.move(FormPlace(session.place.block, number), field)

    def action_go(self, segment: int) -> None:
        """Go to a segment; -1 is the last one."""
        if self.take():
            self.go(len(self.current_session.block.segments) if segment < 0 else segment)

    def action_walk(self, by: int) -> None:
        """Go to the previous or next segment; past the last one, add a new LINE."""
        self.clear_notice()
        if not self.take():
            return
        session = self.current_session
        there = session.place.segment + by
        if there < 0:
            self.say("START is the first segment.")
        elif there > len(session.block.segments):
            self._insert(there, LineSegment())
        else:
            self.go(there)

    @on(NumberField.Letter)
    def _letter(self, message: NumberField.Letter) -> None:
        """Change the kind of an empty segment; after any other, insert a new segment of that kind."""
        self._take_kind(NEW_SEGMENTS[message.letter])

    def refuse_choice(self, typed: str) -> None:
        """Take a letter that is no DIRECTION for another kind of an empty ARC; else say that it is no choice."""
        segment, field, kind = self.current_session.segment, self.current_field, NEW_SEGMENTS.get(typed.lower())
        at_direction = field is not None and field.name == "direction"
        if kind is None or segment is None or not edit.is_empty(segment) or not at_direction:
            super().refuse_choice(typed)
        elif not isinstance(segment, kind):
            self._take_kind(kind)

    def _take_kind(self, kind: type[Segment]) -> None:
        session = self.current_session
        segment = session.segment
        if segment is None or not edit.is_empty(segment):
            self._insert(session.place.segment + 1, kind())
            return
        without = edit.delete_segment(session.program, session.place)
        # an empty segment can still have FEED: typed, or taken from the block before
        new = replace(kind(), feed=segment.feed)
        outcome = without if isinstance(without, Refused) else edit.insert_segment(without, session.place, new)
        if self.host.apply(outcome, f"{table.form_of(new)} {session.place.segment}, block {session.place.block}"):
            self.go(session.place.segment)

    def action_insert_segment(self) -> None:
        """Insert a LINE before the segment with the cursor."""
        self._insert(self.current_session.place.segment, LineSegment())

    def _insert(self, number: int, segment: Segment) -> None:
        session = self.current_session
        if session.segment is not None and edit.is_empty(session.segment) and number > session.place.segment:
            self.say(f"Nothing is typed yet in segment {session.place.segment}: {KINDS_PROMPT}.")
            first = self.names()[1]
            # in a choice field a letter selects an option
            self.focus_field(first if isinstance(self.widget(first), NumberField) else SEGMENT_FIELD)
            return
        place = FormPlace(session.place.block, number)
        if number == 1 and not session.block.segments:
            segment = replace(segment, feed=_last_feed(session))
        outcome = edit.insert_segment(session.program, place, segment)
        if self.host.apply(outcome, f"new {table.form_of(segment)} {number}, block {place.block}"):
            self.go(number)

    @on(ChoiceField.Blanked)
    def _blanked(self, event: ChoiceField.Blanked) -> None:
        """Clear COOLANT on Del; every other choice always has a value."""
        field = self._field(event.name)
        if field is not None:
            self.clear_notice()
            self.pick(field, "")

    # ---- the list of a field

    def action_list_field(self) -> None:
        """Open the list of the field with the cursor: its choices, the tools, or the look-ahead table."""
        widget = self.current
        if isinstance(widget, ChoiceField) and widget.name in SWITCHED_FIELDS:
            widget.action_step(1)
        elif isinstance(widget, ChoiceField):
            widget.action_spell_or_list()
        elif widget is not None and widget.name == "lookahead" and self.take():
            self.app.call_later(self.app.run_action, "app.lookahead")
        elif widget is not None and widget.name in LISTED_FIELDS:
            self._choose_tool(widget.name or "")

    @work(exclusive=True, group="question")
    async def _choose_tool(self, name: str) -> None:
        """Choose a tool from the tool table for TOOL or FINISH TOOL."""
        session = self.current_session
        rows = [Option(tool_line(tool, session.program.unit), id=f"{tool.number}") for tool in session.program.tools]
        if name == "finish_tool":
            rows.insert(0, Option("no finish pass", id="0"))
        field = self._field(name)
        value = self.value(name)
        current = f"{value.value:g}" if isinstance(value, Number) else ""
        number = await self.app.push_screen_wait(ChooseLine("TOOLS", rows, current))
        if number and field is not None:
            self.host.apply(self.edited(field, number), self.label(field))
        self.focus_field(name)

    # ---- softkeys

    @property
    def on_segment(self) -> bool:
        """True if the cursor is on a segment, not on START."""
        return self.current_session.place.segment > 0

    @property
    def has_lookahead(self) -> bool:
        """True if the cursor is on START and the block has a look-ahead."""
        return not self.on_segment and self.current_session.derived_block.side is not None

    def action_delete_segment(self) -> None:
        """Delete the segment with the cursor."""
        session, place = self.current_session, self.current_session.place
        label = f"DELETE SEGMENT {place.segment}, block {place.block}"
        segments = self.query_one(SegmentList)
        in_list = segments.has_focus
        if self.host.apply(edit.delete_segment(session.program, place), label):
            self.notify(f"Deleted segment {place.segment}. Ctrl+Z brings it back.", timeout=3)
            if in_list:
                self.call_after_refresh(self.set_focus, segments)


def _last_feed(session: Session) -> Typed:
    """Return the last feed typed in earlier blocks, for a first segment; None if the tool has a feed."""
    tools = {tool.number: tool for tool in session.program.tools}
    number = session.block.tool
    tool = tools.get(int(number.value)) if isinstance(number, Number) else None
    if tool is not None and tool.feed is not None:
        return None
    before = session.program.blocks[: session.place.block - 1]
    feeds = [segment.feed for block in before for segment in block.segments if isinstance(segment.feed, Number)]
    return feeds[-1] if feeds else None
