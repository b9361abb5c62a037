"""IMPORT lists the contours of a DXF drawing next to the drawing and turns the chosen ones into blocks."""

from __future__ import annotations

from asyncio import CancelledError, to_thread
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from math import dist
from pathlib import Path
from typing import ClassVar, Final, TypeVar

from textual import on, work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.content import Content
from textual.widgets import DataTable, Input, Static

from app.documents.drawing_files import Progress, Worker, drawing_bytes, prepare_workers, read_and_list
from app.documents.programs import empty_program
from app.documents.questions import GO_BACK, Answer
from app.screens.base import BaseScreen
from app.screens.dialogs import ChooseSeveral, NumberEntry, NumberForm, Question, Steps
from app.session.formats import cut_in_middle, length, place
from app.session.messages import Sentence, Tone
from app.widgets.contour_table import ContourTable
from app.widgets.drawing import LOOK_KEYS, Drawing
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.softkeys import Softkey
from app.widgets.status import SPACED_UNITS, Status
from core.controls.program_text import quoted
from core.draw.characters import Mode
from core.draw.view import View
from core.geometry.piece import Line, Side
from core.importing.contour import (
    Contour,
    fit_sentence,
    fitted_contour,
    reversed_contour,
    started_at,
    started_at_corner,
    started_at_side,
    started_at_usual_place,
    traveled_like,
)
from core.importing.contours import (
    FIT_TOLERANCE,
    MAX_TOLERANCE,
    Branch,
    ContourList,
    ImportOptions,
    contours_of,
    frame_notes,
    with_joined,
)
from core.importing.drawing import Drawing as ReadDrawing
from core.importing.drawing import DrawingError, DrawingUnit
from core.importing.listing import Row, background, contours_scene, matching, rows_of, sentences, unit_question
from core.importing.segments import MAX_SEGMENTS, DoesNotFitError, ImportedBlock, with_contours
from core.pipeline.plot import Drawn, SceneSubject
from core.program.edit import FormPlace
from core.program.file.read import StoreError
from core.program.model import CutterComp, Program
from core.units import Kind, Unit, from_mm, to_mm

Result = TypeVar("Result")

SAME_START: Final = 1e-6
"""Millimeters within which a start counts as the usual one."""

NAME_WIDTH: Final = 26
"""Characters of a file's name in a message."""

MAX_NOTES: Final = 2
"""Most notes about imported contours, or about fitted arcs, that one message shows."""

PROMPT: Final = (
    "Space marks, Enter takes what is marked or the row with the cursor. Right arrow opens a row of several, / filters."
)
LARGE_DRAWING_PROMPT: Final = (
    "+ and - zoom, arrows move, 0 shows all, n and p change the chain, Space marks, F7 or Esc: the list."
)
TITLE_OF_DOUBT: Final = {"DXF_DAMAGED": "DAMAGED", "TOO_FAR": "TOO FAR AWAY"}
"""The title of the question whether to take what can be read, by the code of the error."""
STAGE_NAMES: Final = {
    "reading": "Reading",
    "fitting": "Fitting arcs to curves",
    "cleaning": "Cleaning up",
    "chaining": "Chaining",
    "nesting": "Nesting",
}
"""The stages of a worker's progress, as the operator reads them."""

_layer_of: Final = lru_cache(1)(background)
"""Return all contours of a list as one layer, cached; the thread that draws it first makes it."""


@dataclass(frozen=True, eq=False, slots=True)
class ContoursSubject:
    """The subject of the drawing: all contours dim, the chosen ones bright; `view` is the zoom window, None for all."""

    backdrop: tuple[Contour, ...]
    chosen: tuple[Contour, ...]
    unit: Unit
    view: View | None = None

    def drawn(self, columns: int, rows: int, mode: Mode) -> Drawn | None:
        """Return the picture in columns x rows character cells."""
        scene = contours_scene(_layer_of(self.backdrop), self.chosen, self.unit)
        return SceneSubject(scene, self.unit, self.view).drawn(columns, rows, mode)


class ContoursDrawing(Drawing, can_focus=True):
    """The drawing, with keys that zoom and pan it."""

    BINDINGS: ClassVar[list[BindingType]] = [
        *LOOK_KEYS,
        Binding("0,home", "fit", "Whole drawing", show=False),
        Binding("n,N,pagedown", "screen.next_row(1)", "Next chain", show=False),
        Binding("p,P,pageup", "screen.next_row(-1)", "Chain before", show=False),
        Binding("space", "screen.mark", "Mark", show=False),
        Binding("enter", "screen.take", "Take", show=False),
    ]


class FileTitle(PlainText):
    """The file's name, its unit and where that is from, its layers and how many rows are marked."""

    def __init__(self, name: str, *, id: str, classes: str) -> None:
        super().__init__(id=id, classes=classes)
        self._words = (name, "", "", "")

    def show(self, unit: str, source: str, rest: str) -> None:
        """Show these words after the name."""
        self._words = (self._words[0], unit, source, rest)
        self.refresh()

    def render(self) -> Content:
        """Return all words; if they have no room, leave out the source of the unit and cut the name in its middle."""
        (name, unit, source, rest), room = self._words, self.size.width
        whole = f"{name}{unit}{source}{rest}"
        return Content(whole if len(whole) <= room else f"{cut_in_middle(name, room - len(unit + rest))}{unit}{rest}")


class ImportScreen(BaseScreen):
    """The import of one drawing file; `fresh` if the program is new and takes the drawing's unit."""

    AUTO_FOCUS: ClassVar[str | None] = "#contours"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "leave", "Back", show=False),
        Binding("slash", "filter", "Filter", show=False),
        Binding("b,B", "branch", "Branch", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (
        Softkey("TAKE", "take", "TAKE", lambda screen: screen.contour is not None, "The list is empty."),
        Softkey("LAYERS", "layers", "LAYERS", lambda screen: screen.drawing is not None, "No drawing is read."),
        Softkey("FIT ARCS", "fit", "FIT", lambda screen: screen.contour is not None, "The list is empty."),
        Softkey("TOLERANCE", "tolerance", "TOL", lambda screen: screen.options is not None, "No drawing is read."),
        Softkey("START", "start", "START", lambda screen: screen.contour is not None, "The list is empty."),
        Softkey("REVERSE", "reverse", "REVERSE", lambda screen: screen.contour is not None, "The list is empty."),
        Softkey("DRAW", "large", "DRAW"),
        Softkey("EXIT takes nothing", "close", "EXIT"),
    )
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (("Spc", "MARK"), ("/", "FILTER"), ("?", "KEYS, HELP"))
    PALETTE_ACTIONS: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("MARK", "screen.mark", "Space"),
        ("FILTER", "screen.filter", "/"),
        ("BRANCH", "screen.branch", "B: which chain continues an open one"),
    )

    def __init__(self, path: Path, *, fresh: bool = False) -> None:
        super().__init__()
        self.path, self._fresh = path, fresh
        self.drawing: ReadDrawing | None = None
        self.options: ImportOptions | None = None
        self.listed: ContourList | None = None
        self.marked: set[int] = set()
        self.unfitted: dict[int, Contour] = {}
        """The contours as they were before FIT ARCS, by number."""
        self._unfolded: set[int] = set()
        self._backdrop: tuple[Contour, ...] = ()
        self._working, self._stopped = "", False
        self._failed = ""

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the list, the remarks on the row with the cursor, and the drawing."""
        with Vertical(id="import", classes="panel -bare"):
            with Horizontal(classes="head"):
                yield PlainLabel("IMPORT", classes="head-label")
                yield FileTitle(self.path.name, id="import-file", classes="head-kind")
            yield ContourTable(id="contours")
            with Horizontal(id="filter-line", classes="field"):
                yield PlainLabel("FILTER", classes="label")
                yield Input(id="filter", compact=True)
            yield PlainText(id="import-about")
        yield ContoursDrawing(id="import-drawing")

    def on_mount(self) -> None:
        """Start reading the file."""
        prepare_workers()
        self._read()

    def show_state_on(self, status: Status) -> None:
        """Show the unit that a new program takes from the drawing, none until it is read; else the open program's."""
        if self._fresh:
            unit = "" if self.options is None else f" {SPACED_UNITS[self.unit]} "
            status.show(unit, 0, 0, unsaved=False, saved=False, new=bool(unit))
        else:
            super().show_state_on(status)

    @property
    def unit(self) -> Unit:
        """The unit of the program that receives the contours."""
        drawing_unit = self.options.unit.program_unit if self._fresh and self.options is not None else None
        return drawing_unit or self.current_session.program.unit

    # ---- reading and listing, in a separate process

    @work(exclusive=True, group="import")
    async def _read(self) -> None:
        """Read the file and list its contours; ask whether to accept a damaged file, and for a missing unit."""
        try:
            data = await self._in_thread(drawing_bytes, self.path)
            result = await self._read_whole(data)
        except (StoreError, DrawingError) as error:
            self._fail(str(error))
            return
        if result is None:
            self.action_close()
        elif isinstance(result, ContourList):
            self._take_list(result)
        else:
            await self._list_after_question(result)

    async def _read_whole(self, data: bytes) -> ReadDrawing | ContourList | None:
        unit = None if self._fresh else self.current_session.program.unit
        try:
            return await self._run_worker(lambda: Worker(read_and_list, data, self.path.name, unit))
        except DrawingError as error:
            title = TITLE_OF_DOUBT.get(error.code)
            if title is None or not error.readable:
                raise
            answers = [Answer("YES", "what can be read"), Answer("NO", "nothing")]
            word = await self.app.push_screen_wait(Question(title, [error.text, "Take it?"], answers, "NO"))
            if word != "YES":
                return None
        return await self._run_worker(lambda: Worker(partial(read_and_list, damaged=True), data, self.path.name, unit))

    async def _list_after_question(self, drawing: ReadDrawing) -> None:
        """Ask for the unit if the file names none, then list the contours."""
        self.drawing, unit = drawing, drawing.unit
        if unit is None:
            question = [f"{unit_question(drawing)}.", "In which unit is it drawn?"]
            answers = [Answer("INCH"), Answer("MM")]
            # a unit taken by Enter alone would scale the part by 25.4 unseen
            word = await self.app.push_screen_wait(Question("UNITS?", question, answers, GO_BACK))
            if word == GO_BACK:
                self.action_close()
                return
            unit = DrawingUnit.IN if word == "INCH" else DrawingUnit.MM
        self.options = ImportOptions.usual(unit, None if self._fresh else self.current_session.program.unit)
        await self._list_again(self.options)

    @work(exclusive=True, group="import")
    async def _list(self, options: ImportOptions) -> None:
        """List the contours again with other options."""
        await self._list_again(options)

    async def _list_again(self, options: ImportOptions) -> None:
        drawing = self.drawing
        assert drawing is not None
        try:
            self._take_list(await self._run_worker(lambda: Worker(contours_of, drawing, options)))
        except DrawingError as error:
            remedy = " F2 LAYERS leaves its layer out." if error.code == "NOT_FLAT" else ""
            self._fail(f"{error.text}{remedy}")

    async def _in_thread(self, function: Callable[..., Result], *arguments: object) -> Result:
        """Return the function's result; cancel the task if the screen has been closed in the meantime."""
        result = await to_thread(function, *arguments)
        if not self.is_live:
            raise CancelledError
        return result

    async def _run_worker(self, start: Callable[[], Worker[Result]]) -> Result:
        """Return the result of a worker process, showing its progress; Esc stops it."""
        self._stopped, self._failed = False, ""
        self._tell_progress(Progress("reading", 0, 1))
        worker = await to_thread(start)
        try:
            while not self._stopped:
                message = await self._in_thread(worker.poll, 0.1)
                if isinstance(message, Progress):
                    self._tell_progress(message)
                elif message is not None:
                    return message
            raise DrawingError("STOPPED", "Stopped. Nothing was changed.")
        finally:
            self._working = ""
            worker.cancel()

    def _tell_progress(self, progress: Progress) -> None:
        percent = 100 * progress.done // max(progress.whole, 1)
        self._working = f"{STAGE_NAMES.get(progress.stage, progress.stage)} {self.path.name}  {percent} %   Esc stops."
        self.notice = None
        self.refresh_frame()

    def _fail(self, text: str) -> None:
        """Say why there is no list, or no new one; close the screen if Esc stopped the first reading."""
        if self._stopped and self.listed is None:
            self.action_close()
            return
        self._failed = "" if self.listed is not None else text
        self.say(text, Tone.WARNING if self._stopped else Tone.ERROR)

    def _take_list(self, listed: ContourList) -> None:
        self.drawing, self.options, self.listed = listed.drawing, listed.options, listed
        self.marked.clear()
        self.unfitted.clear()
        self._unfolded.clear()
        self._backdrop = listed.contours
        self.clear_notice()
        self.show_state()
        self._show_rows(1)
        if not listed.contours:
            self.say("These layers hold no contour. F2 chooses others.", Tone.WARNING)

    # ---- the list

    @property
    def table(self) -> ContourTable:
        """The table of contours."""
        return self.query_one(ContourTable)

    @property
    def picture(self) -> ContoursDrawing:
        """The drawing widget."""
        return self.query_one(ContoursDrawing)

    @property
    def contour(self) -> Contour | None:
        """The contour with the cursor; in a row of several, the first one."""
        row = self.table.current if self.is_mounted else None
        return None if row is None else self._contour(row[0].number)

    @property
    def row_numbers(self) -> tuple[int, ...]:
        """The numbers of the contours in the row with the cursor."""
        row = self.table.current
        return () if row is None else tuple(contour.number for contour in row)

    @property
    def chosen(self) -> tuple[Contour, ...]:
        """The marked contours, or if none is marked those of the row with the cursor, in list order."""
        return tuple(self._contour(number) for number in sorted(self.marked or self.row_numbers))

    def _contour(self, number: int) -> Contour:
        assert self.listed is not None
        return self.listed.contours[number - 1]

    def _show_rows(self, at: int) -> None:
        """Refill the list and put the cursor on contour `at`."""
        listed = self.listed
        if listed is None:
            return
        text = self.query_one("#filter", Input).value
        contours = matching(listed.contours, text, self.unit) if text.strip() else listed.contours
        rows: list[Row] = []
        for row in rows_of(contours):
            rows += [(each,) for each in row] if row[0].number in self._unfolded else [row]
        self.table.fill(rows, self.unit, self.marked, at)
        self._show_title()
        self._show_row()

    def _show_title(self) -> None:
        unit = source = rest = ""
        if self.options is not None and self.drawing is not None:
            count, most = len(self.options.layers or self.drawing.layers), len(self.drawing.layers)
            unit, source = f"  {self.options.unit}", " ($INSUNITS)" if self.drawing.unit is not None else ""
            rest = f"  layers {count} of {most}"
        if self.marked:
            rest += f"  {len(self.marked)} marked"
        self.query_one(FileTitle).show(unit, source, rest)

    def _show_row(self) -> None:
        """Show the remarks on the row with the cursor, and its drawing."""
        self.query_one("#import-about", Static).update(Content("\n").join(self._about()))
        self.refresh_frame()
        self._draw()

    def _draw(self) -> None:
        drawing, contour = self.picture, self.contour
        before = drawing.subject
        view = before.view if isinstance(before, ContoursSubject) and before.backdrop is self._backdrop else None
        if contour is None:
            drawing.heading, drawing.subject = "DRAWING", None
            return
        marked = f"   {len(self.marked)} marked" if self.marked else ""
        drawing.heading = f"chain {contour.number}  {contour.kind}{marked}"
        drawing.subject = ContoursSubject(self._backdrop, self.chosen, self.unit, view)

    def _about(self) -> list[Content]:
        """Return start and direction, problems or fitted arcs, and what the reader did to the drawing, line by line."""
        contour, listed, unit = self.contour, self.listed, self.unit
        if listed is None:
            return []
        first, second = "", Content("")
        if contour is not None:
            first = f" start {place(contour.start, unit)}{start_words(contour)}"
            second = self._remark(contour)
        about = Content.styled(" " + "  ".join(sentences(listed, unit)), "$c-label")
        # without a second line the sentences have room for two
        return [each for each in (Content(first), second, about) if each.plain]

    def _remark(self, contour: Contour) -> Content:
        branch = self._branch_of(contour)
        if branch is not None:
            continuations = len(branch.contours) - 1
            return Content.styled(
                f" branch at {place(branch.at, self.unit)}: {continuations} ways. B chooses.", "$c-warn"
            )
        if contour.problems:
            return Content.styled(f" {contour.kind} {'; '.join(contour.problems)}.", "$c-warn")
        if contour.fitted is not None:
            return Content(f" {fit_sentence(contour, self.unit)}. F3 brings the lines back.")
        return Content(f" {len(contour.layers)} layers: {', '.join(contour.layers)}" if len(contour.layers) > 1 else "")

    @on(DataTable.RowHighlighted)
    def _highlighted(self) -> None:
        if not self._failed:
            self.clear_notice()
        self._show_row()

    def action_mark(self) -> None:
        """Mark or unmark the row with the cursor."""
        numbers = set(self.row_numbers)
        self.marked = self.marked - numbers if numbers <= self.marked else self.marked | numbers
        self.table.show_marks(self.marked)
        self._show_title()
        self._show_row()

    def action_unfold(self, wide: bool) -> None:
        """Unfold a row of several circles into one row each, or fold them again."""
        contour, numbers = self.contour, self.row_numbers
        if contour is None or self.listed is None:
            return
        if wide and len(numbers) > 1:
            self._unfolded.add(numbers[0])
            self._show_rows(contour.number)
        elif not wide:
            rows = [[each.number for each in row] for row in rows_of(self.listed.contours)]
            first = next((numbers[0] for numbers in rows if contour.number in numbers), 0)
            if first in self._unfolded:
                self._unfolded.remove(first)
                self._show_rows(first)

    def action_next_row(self, by: int) -> None:
        """Move the cursor `by` rows."""
        self.table.move_cursor(row=self.table.cursor_row + by)

    # ---- filter

    def action_filter(self) -> None:
        """Open the filter line, which takes part of a layer, kind, length or size."""
        self.add_class("-filtering")
        self.query_one("#filter", Input).focus()
        self.refresh_frame()

    @on(Input.Changed, "#filter")
    def _filtered(self) -> None:
        contour = self.contour
        self._show_rows(0 if contour is None else contour.number)

    @on(Input.Submitted, "#filter")
    def _filter_done(self, event: Input.Submitted) -> None:
        self.table.focus()
        self.set_class(bool(event.value.strip()), "-filtering")
        self.refresh_frame()

    # ---- softkeys

    def _change(self, change: Callable[[Contour], Contour], contours: Collection[Contour]) -> None:
        """Replace some contours by changed ones; their rows stay where they are."""
        assert self.listed is not None
        changed = {contour.number: change(contour) for contour in contours}
        self.listed = replace(
            self.listed, contours=tuple(changed.get(contour.number, contour) for contour in self.listed.contours)
        )

    def action_reverse(self) -> None:
        """Reverse the chosen contours; the proposed side of the tool changes with the direction."""
        self._change(reversed_contour, self.chosen)
        self._show_row()

    @work(exclusive=True, group="question")
    async def action_start(self) -> None:
        """Move the start of the contour with the cursor step by step; the drawing follows each step."""
        contour, unit = self.contour, self.unit
        if contour is None:
            return
        end = "the start stays where it is"
        steps = Steps("START", self._start_line(contour), START_ANSWERS, end, self._step_start)
        if await self.app.push_screen_wait(steps) == "X Y":
            entries = [NumberEntry(f"{axis} START", Kind.LENGTH, "0") for axis in "XY"]
            values = await self.app.push_screen_wait(
                NumberForm("START", ["The chain then starts at its point nearest to X, Y."], entries, unit)
            )
            if values:
                x, y = (to_mm(value, unit) for value in values)
                self._change(lambda each: started_at(each, (x, y)), [self._contour(contour.number)])
        self._show_row()

    def _step_start(self, word: str) -> str | None:
        """Move the start as an answer to START says; return where it is now, None for an answer that moves nothing."""
        before = self.contour
        if before is None or word not in CHANGE_OF_ANSWER:
            return None
        self._change(CHANGE_OF_ANSWER[word], [before])
        self._show_row()
        after = self._contour(before.number)
        if not before.closed:
            return f"chain {before.number} is open: only X Y moves its start to the other end"
        if before.circle is not None and "CORNER" in word:
            return f"chain {before.number} is a circle: it has no corner"
        return self._start_line(after)

    def _start_line(self, contour: Contour) -> str:
        return f"chain {contour.number} starts at {place(contour.start, self.unit)}"

    @work(exclusive=True, group="question")
    async def action_fit(self) -> None:
        """Fit arcs to runs of short lines; if a chosen contour is already fitted, bring its lines back instead."""
        await self._fit_chosen()

    async def _fit_chosen(self) -> None:
        contours, options = self.chosen, self.options
        assert options is not None
        if any(contour.number in self.unfitted for contour in contours):
            self._change(lambda each: traveled_like(self.unfitted.pop(each.number, each), each), contours)
            self._after_fit("The lines are back.")
            return
        self.say("Fitting arcs.")
        fitted = await self._in_thread(
            lambda: [fitted_contour(contour, options.fit or FIT_TOLERANCE[self.unit]) for contour in contours]
        )
        better = [new for old, new in zip(contours, fitted, strict=True) if new.drawn < old.drawn]
        if not better:
            self.say(f"FIT ARCS finds no arc within {length(options.fit, self.unit)}. F4 changes FIT.")
            return
        self.unfitted |= {contour.number: self._contour(contour.number) for contour in better}
        new = {contour.number: contour for contour in better}
        self._change(lambda each: new[each.number], better)
        self._after_fit("  ".join(fit_sentence(contour, self.unit) for contour in better[:MAX_NOTES]))

    def _after_fit(self, text: str) -> None:
        assert self.listed is not None
        contour = self.contour
        self._backdrop = self.listed.contours
        self._show_rows(0 if contour is None else contour.number)
        self.call_after_refresh(self.say, text)

    @work(exclusive=True, group="question")
    async def action_tolerance(self) -> None:
        """Ask for the joint tolerance and the arc fit tolerance, then rebuild the list."""
        options, unit = self.options, self.unit
        if options is None:
            return
        most = from_mm(MAX_TOLERANCE[unit], unit)
        values = [("TOLERANCE", options.tolerance), ("FIT", options.fit)]
        entries = [NumberEntry(name, Kind.LENGTH, length(value, unit), most) for name, value in values]
        lines = ["Ends within TOLERANCE are joined. Arcs deviate from curves and lines by FIT at most."]
        typed = await self.app.push_screen_wait(NumberForm("TOLERANCE", lines, entries, unit))
        if typed:
            tolerance, fit = (to_mm(value, unit) for value in typed)
            self._list(replace(options, tolerance=tolerance, fit=fit or FIT_TOLERANCE[unit]))

    @work(exclusive=True, group="question")
    async def action_layers(self) -> None:
        """Ask for the layers, then rebuild the list."""
        drawing, options = self.drawing, self.options
        if drawing is None or options is None:
            return
        layers = drawing.layers
        chosen = await self.app.push_screen_wait(ChooseSeveral("LAYERS", layers, options.layers or layers))
        if chosen is None:
            return
        if not chosen:
            self.say("No layer is marked: nothing was changed.", Tone.WARNING)
            return
        self._list(replace(options, layers=None if len(chosen) == len(layers) else chosen))

    def _branch_of(self, contour: Contour) -> Branch | None:
        """Return the first branch at which this contour and at least one other open contour end."""
        branches = () if self.listed is None else self.listed.branches
        return next((each for each in branches if contour.number in each.contours and len(each.contours) > 1), None)

    @work(exclusive=True, group="question")
    async def action_branch(self) -> None:
        """Ask which contour continues the one with the cursor at a branch, and join the two."""
        contour = self.contour
        branch = None if contour is None else self._branch_of(contour)
        if contour is None or branch is None:
            self.say("This chain does not end at a branch.")
            return
        continuations = [self._contour(number) for number in branch.contours if number != contour.number]
        words = [(f"CHAIN {way.number}", f"{length(way.length, self.unit)} long") for way in continuations]
        answers = [Answer(f"{row} {chain}", long) for row, (chain, long) in enumerate(words, 1)]
        title = f"branch at {place(branch.at, self.unit)}: {len(continuations)} ways"
        lines = [f"Which chain continues chain {contour.number}?"]
        word = await self.app.push_screen_wait(Question(title, lines, answers, GO_BACK))
        if word != GO_BACK:
            self._join(contour, continuations[int(word.split()[0]) - 1])

    def _join(self, contour: Contour, other: Contour) -> None:
        assert self.listed is not None
        joined = with_joined(self.listed, contour.number, other.number)
        if joined is None:
            self.say(f"Chain {other.number} does not meet chain {contour.number} there.", Tone.ERROR)
            return
        total = contour.length + other.length
        joined_contour = min(joined.contours, key=lambda each: abs(each.length - total))
        self._take_list(joined)
        self._show_rows(joined_contour.number)
        kind = "closed" if joined_contour.closed else "open"
        text = f"Chain {joined_contour.number}: {joined_contour.drawn} pieces, {kind}."
        self.call_after_refresh(self.say, f"{text} The chains have new numbers.")

    def action_large(self) -> None:
        """Switch between the full-size drawing and the list."""
        self.toggle_class("-large")
        (self.picture if self.has_class("-large") else self.table).focus()
        self.refresh_frame()

    def action_leave(self) -> None:
        """Go one step back: stop the work, else leave the large drawing, the filter, or the screen."""
        filter_text = self.query_one("#filter", Input)
        if self._working:
            self._stopped = True
        elif self.has_class("-large"):
            self.action_large()
        elif self.has_class("-filtering"):
            self.remove_class("-filtering")
            filter_text.value = ""
            self.table.focus()
        else:
            self.action_close()

    def action_close(self) -> None:
        """Leave the screen; the program stays as it is, and START, REVERSE and the marks are forgotten."""
        if self.listed is not None:
            self.app.notify(f"Nothing is taken from {self.path.name}. Ctrl+O opens it again.", timeout=4)
        self.app.call_later(self.app.run_action, "app.back")

    # ---- take

    @on(DataTable.RowSelected)
    @work(exclusive=True, group="question")
    async def action_take(self) -> None:
        """Make a block of each chosen contour, in one edit."""
        contours = self.chosen
        if not contours or self._working:
            return
        count = max(len(contour.pieces) for contour in contours)
        if count > MAX_SEGMENTS and not all(contour.number in self.unfitted for contour in contours):
            lines = [f"{count:,} segments: the form shows them, the look-ahead of a control may not."]
            answers = [Answer("FIT ARCS", "then look at the list"), Answer("TAKE", "as they are")]
            word = await self.app.push_screen_wait(Question("MANY SEGMENTS", lines, answers, "FIT ARCS"))
            if word == "FIT ARCS":
                await self._fit_chosen()
            if word != "TAKE":
                return
        side = None
        if open_ones := [contour.number for contour in contours if not contour.closed]:
            side = await self._ask_side(open_ones)
            if side is None:
                return
        await self._make_blocks(contours, side)

    async def _ask_side(self, numbers: Sequence[int]) -> CutterComp | None:
        """Ask for the CUTTER COMP. of open contours, which have no default; return None on GO BACK."""
        several = f"{len(numbers)} open chains" if len(numbers) > 1 else f"chain {numbers[0]}, which is open"
        answers = [Answer("LEFT"), Answer("RIGHT"), Answer("ON", "the tool's center on the chain")]
        word = await self.app.push_screen_wait(
            Question("CUTTER COMP.?", [f"Side of the tool on {several}, along travel:"], answers, GO_BACK)
        )
        return None if word == GO_BACK else CutterComp(word)

    async def _make_blocks(self, contours: Sequence[Contour], side: CutterComp | None) -> None:
        program = self.current_session.program
        if self.unit is not program.unit:
            program = empty_program(self.unit)
        self.say("Writing the segments.")
        try:
            edited, blocks = await self._in_thread(with_contours, program, contours, side)
        except DoesNotFitError as error:
            self.say(str(error), Tone.ERROR)
            return
        drawn = self.host.part_is_drawn or not any(block.segments for block in program.blocks)
        if self.host.apply(edited, f"IMPORT {self.path.name}"):
            self.host.part_is_drawn = drawn
            numbers = {contour.number for contour in contours}
            self._show_taken(edited, blocks, [] if self.listed is None else frame_notes(self.listed, numbers))

    def _show_taken(self, program: Program, blocks: Sequence[ImportedBlock], frames: Sequence[str]) -> None:
        """Show the form of the first new block, and the notes on all of them."""
        first = len(program.blocks) - len(blocks) + 1
        self.host.move(FormPlace(first))
        self.host.action_contour()
        blocks_text = f"blocks {first}-{len(program.blocks)}" if len(blocks) > 1 else f"block {first}"
        text = f"Took {blocks_text} from {cut_in_middle(self.path.name, NAME_WIDTH)}. Ctrl+Z undoes it."
        if len(blocks) > 1 and blocks[0].block.z_bottom is None:
            text += " Depths typed in one block go into all of them with Ctrl+K SAME VALUES."
        self.app.notify(text, timeout=4 if len(blocks) == 1 else 8)
        notes = [*frames, *(note for block in blocks for note in block.notes)]
        if notes:
            rest = f" {len(notes) - MAX_NOTES} more notes." if len(notes) > MAX_NOTES else ""
            text = f"{' '.join(notes[:MAX_NOTES])}{rest}"
            self.app.call_later(self.host.say, text, Tone.WARNING)

    # ---- texts

    def prompt_text(self) -> Sentence:
        """Return the progress, the reason why there is no list, or what the keys do."""
        if self._working:
            return Sentence(self._working)
        if self._failed:
            return Sentence(self._failed, Tone.ERROR)
        if self.has_class("-filtering"):
            return self._filter_prompt()
        return Sentence(LARGE_DRAWING_PROMPT if self.has_class("-large") else PROMPT)

    def _filter_prompt(self) -> Sentence:
        """Return the filter's prompt; warn if no chain matches."""
        text = self.query_one("#filter", Input).value.strip()
        if text and self.listed is not None and not matching(self.listed.contours, text, self.unit):
            return Sentence(
                f"No chain has '{quoted(text)}' in its layer, kind, length or size. Esc shows all.", Tone.WARNING
            )
        return Sentence("Type a part of a layer, kind, length or size. Enter goes to the list, Esc shows all.")

    def help_lines(self) -> tuple[str, ...]:
        """Return the keys, then what the reader did to the drawing."""
        reading_notes = () if self.listed is None else tuple(sentences(self.listed, self.unit))
        return (*HELP_LINES, *reading_notes)


START_ANSWERS: Final = (
    Answer("NEXT CORNER"),
    Answer("CORNER BEFORE"),
    Answer("SIDE", "middle of the next one"),
    Answer("BACK ONE SIDE", "middle of the one before"),
    Answer("LONGEST", "middle of the longest side"),
    Answer("X Y", "typed"),
)
CHANGE_OF_ANSWER: Final[dict[str, Callable[[Contour], Contour]]] = {
    "NEXT CORNER": lambda contour: started_at_corner(contour, 1),
    "CORNER BEFORE": lambda contour: started_at_corner(contour, -1),
    "SIDE": lambda contour: started_at_side(contour, 1),
    "BACK ONE SIDE": lambda contour: started_at_side(contour, -1),
    "LONGEST": started_at_usual_place,
}
"""What each answer to START does to a contour."""

HELP_LINES: Final = (
    "Each row is one chain of the drawing: closed ones by size, holes after the chain around them, open ones last.",
    "Space marks a row, Enter or F1 makes a MILL CONTOUR block of each marked chain, in one edit.",
    "F3 FIT ARCS makes arcs of runs of short lines; F3 again brings the lines back.",
    "F5 START moves the start: its keys step on, Enter repeats a step, Esc ends. The drawing follows.",
    "F6 REVERSE turns the direction; CUTTER COMP. follows it.",
    "B asks which chain continues an open chain at a branch.",
)


def start_words(contour: Contour) -> str:
    """Return the kind of start, the direction of travel and the side of the tool."""
    if not contour.closed:
        return "  open: TAKE asks for CUTTER COMP."
    side = "LEFT" if contour.side is Side.LEFT else "RIGHT"
    if contour.circle is not None:
        where = ""
    elif dist(contour.start, started_at_usual_place(contour).start) <= SAME_START:
        where = f"  mid longest {'side' if any(isinstance(p, Line) for p in contour.pieces) else 'arc'}"
    else:
        where = "  side" if len(contour.pieces) > contour.drawn else "  corner"
    return f"{where}  {contour.turn.name}  {side}"
