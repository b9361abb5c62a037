"""The App: owns the session, opens the screens, runs the workers."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

from textual import on, work
from textual.binding import Binding, BindingType
from textual.command import CommandPalette
from textual.events import AppBlur, Key
from textual.filter import LineFilter
from textual.markup import escape
from textual.notifications import SeverityLevel
from textual.reactive import var
from textual.screen import ModalScreen, Screen
from textual.timer import Timer
from textual.worker import get_current_worker

from app import theme
from app.documents.document import ContourDocument, NcDocument
from app.documents.folders import current_folder
from app.documents.service import DocumentService, Opened
from app.documents.settings import SettingsFile
from app.file_actions import FileActions
from app.screens.base import BaseScreen
from app.screens.contour import ContourScreen
from app.session.block_findings import Entry
from app.session.derivation import Request, advised, derived, lookahead_table
from app.session.messages import ProgramDerived, TableMade, Tone
from app.session.posting import CENTER_PATH
from app.session.session import SEGMENT, Session
from app.session.work import Work
from app.terminal.split_keys import TOLD
from app.transform_actions import TransformActions
from app.widgets.printable import PRINTABLE
from app.widgets.status import Surroundings
from app.work_actions import WorkActions
from core.pipeline.derived import DerivedBlock
from core.program.edit import Edited, FormPlace, Refused
from core.program.model import Program
from core.progress import Stopped
from core.units import Unit

if TYPE_CHECKING:
    from textual.command import Provider

    from app.nc_proof.screen import ProofScreen
    from core.advice.lookahead_table import Table
    from core.pipeline.checking import Asked

MESSAGE_GOES: Final = 0.2
"""Seconds between two looks at whether a message has gone."""
QUIET = 0.2
"""Seconds without a key after which it is looked for what would help: a key never waits for that."""


def _actions() -> type[Provider]:
    """The palette's commands.  All screens but the first are imported when they are opened: it stands sooner."""
    from app.screens.palette import Actions

    return Actions


NOT_UNDER_DIALOGS: Final = frozenset({"undo", "redo", "quit", "save", "save_as", "home", "new"})
"""Actions whose keys wait until a dialog is answered."""


class CutcompApp(FileActions, TransformActions, WorkActions):
    """The only place where the session changes.

    `session` is the work as it has been accepted.  `shown` is what verdict and drawings show: the same, or the session
    as a half-typed number would make it.
    """

    CSS_PATH = "app.tcss"
    TITLE = "cutcomp"
    HORIZONTAL_BREAKPOINTS = BaseScreen.HORIZONTAL_BREAKPOINTS
    VERTICAL_BREAKPOINTS = BaseScreen.VERTICAL_BREAKPOINTS
    COMMAND_PALETTE_BINDING = "ctrl+k"
    COMMANDS: ClassVar[set[type[Provider] | Callable[[], type[Provider]]]] = {_actions}
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+z", "undo", "Undo", show=False, priority=True),
        Binding("ctrl+y", "redo", "Redo", show=False, priority=True),
        Binding("ctrl+q", "quit", "Quit", show=False, priority=True),
        Binding("ctrl+l", "redraw", "Redraw the screen", show=False, priority=True),
        Binding("ctrl+g", "help", "Help", show=False),
        Binding("ctrl+s", "save", "Save", show=False, priority=True),
        Binding("ctrl+o", "home", "Open", show=False, priority=True),
        Binding("escape", "stop_work", "Stop", show=False, priority=True),
        Binding("escape", "leave_guide", "Leave the guide", show=False, priority=True),
    ]

    session: var[Session] = var(lambda: Session.of(Program()), init=False)
    shown: var[Session] = var(lambda: Session.of(Program()), init=False)
    guided: var[bool] = var(default=False, init=False)
    """The prompt leads through a first part; Esc ends it."""
    characters: var[str] = var("braille", init=False)
    """The set of characters that drawings and signs are made of."""

    def __init__(
        self,
        session: Session,
        *,
        surroundings: Surroundings | None = None,
        few_colors: bool = False,
        light: bool = False,
        character_sets: tuple[str, ...] = ("braille", "block", "ascii"),
        service: DocumentService | None = None,
        opened: Opened[Any] | None = None,
        settings_file: SettingsFile | None = None,
        home: bool = False,
        asked: Asked | None = None,
    ) -> None:
        super().__init__(ansi_color=few_colors or None)
        self.surroundings = surroundings or Surroundings()
        self.service, self._opened, self._home, self._asked = service, opened, home, asked
        self.drawing: Path | None = None
        self.settings_file = settings_file or SettingsFile()
        self.settings = self.settings_file.held
        self.document = _contour_document(session, service, opened)
        self.character_sets = character_sets
        self.set_reactive(CutcompApp.characters, character_sets[0])
        self._wanted: Request | None = None
        self._deriving: tuple[Request, Work] | None = None
        self._table_wanted: DerivedBlock | None = None
        self._making_table: tuple[DerivedBlock, Work] | None = None
        self.posted_for = CENTER_PATH
        """The control for which an NC file was posted last, or the center path."""
        self.stopped: Program | DerivedBlock | None = None
        """What is not worked out since Esc has stopped it: all of a program, or the look-ahead table of a block."""
        self._advice_timer: Timer | None = None
        self._unit_mentioned = self._unit_settled = False
        self.set_reactive(CutcompApp.session, session)
        self.set_reactive(CutcompApp.shown, session)
        for each in theme.themes():
            self.register_theme(each)
        self.theme = theme.SIXTEEN if few_colors else theme.LIGHT if light else theme.DARK

    def get_line_filters(self) -> Sequence[LineFilter]:
        """Nothing that a file holds may move the terminal's cursor, wherever it is shown."""
        return [*super().get_line_filters(), PRINTABLE]

    def notify(
        self,
        message: str,
        *,
        title: str = "",
        severity: SeverityLevel = "information",
        timeout: float | None = None,
        markup: bool = True,
    ) -> None:
        """What has been done, over the screen; brackets in a file's name stay what they are."""
        text = escape(message) if markup else message
        super().notify(text, title=title, severity=severity, timeout=timeout, markup=markup)
        self.set_timer(timeout or self.NOTIFICATION_TIMEOUT, self._paint_behind_messages)

    def _paint_behind_messages(self) -> None:
        """Textual may leave a piece of a message standing where something else changes as it goes."""
        if not self.screen_stack:
            # the program is ending
            return
        if self.screen.query("Toast"):
            self.set_timer(MESSAGE_GOES, self._paint_behind_messages)
        else:
            self.screen.refresh()

    def get_default_screen(self) -> Screen[None]:
        """MILL CONTOUR."""
        return ContourScreen()

    def on_mount(self) -> None:
        """The first screen, before the first key is read."""
        if self._home:
            self.action_home()

    def on_ready(self) -> None:
        """Once the first screen is painted, work out what follows from the program; ask what is to be asked."""
        self.call_after_refresh(self._first_painted)
        if self.drawing is not None:
            self.show_drawing(self.drawing, fresh=True)
        if self._opened is not None:
            document = self._opened.document
            if isinstance(document, NcDocument):
                self.show_nc(document, self._asked)
            elif document.file.path is not None:
                self.keep_settings(self.settings.using(document.file.path))
            self.tell_and_ask(self._opened)

    def on_app_blur(self, event: AppBlur) -> None:
        """A look at another window takes nothing: a field keeps the cursor and what is half-typed in it."""
        event.prevent_default()

    def _first_painted(self) -> None:
        """The numeric libraries come now: the first paint does without them, and without the garbage collector."""
        if not gc.isenabled():
            # what stands by now stays to the end
            gc.freeze()
            gc.enable()
        if not self._deriving:
            self._derive(Request(self.session.program))

    # ---- the session

    def apply(self, edited: Edited, label: str) -> bool:
        """Take an edit, or say why it is refused; whether it was taken."""
        if isinstance(edited, Refused):
            self.say(edited.text, Tone.ERROR)
            return False
        if self.looking:
            self.try_out(None)
            self.say(self.looking, Tone.ERROR)
            return False
        self._change(self.session.with_program(edited, label))
        return True

    def move(self, place: FormPlace, field: str | None = SEGMENT) -> None:
        """Put the cursor of the MILL CONTOUR form on a segment, and there on a field.

        A new segment in which nothing was typed is gone once the cursor has left it.
        """
        session, here = self.session, self.session.place
        if place != here and (rest := session.without_empty()) is not session:
            session = rest
            if place.block == here.block and place.segment > here.segment:
                place = FormPlace(place.block, place.segment - 1)
        self._change(session.at(place, field))

    def action_undo(self) -> None:
        """Take one edit back; what is half-typed is forgotten."""
        if isinstance(self.screen, BaseScreen) and self.screen.take_over("undo"):
            return
        self._forget_typed()
        label = self.session.history.undo_label
        if label is None:
            self.say("There is nothing to undo.")
            return
        self._change(self.session.undone())
        self.say(f"Undone: {label}. Ctrl+Y brings it back.")

    def action_redo(self) -> None:
        """Make one undone edit again; what is half-typed is forgotten."""
        if isinstance(self.screen, BaseScreen) and self.screen.take_over("redo"):
            return
        self._forget_typed()
        label = self.session.history.redo_label
        if label is None:
            self.say("There is nothing to redo.")
            return
        self._change(self.session.redone())
        self.say(f"Done again: {label}.")

    def _forget_typed(self) -> None:
        if isinstance(self.screen, BaseScreen):
            self.screen.forget_typed()

    def _change(self, session: Session) -> None:
        """The journal first, then the session, then what follows from it."""
        before = self.session
        if session is before:
            # such as a number typed over with the same one
            self.try_out(None)
            return
        self.keep(session)
        self.session = session
        self.shown = session
        self._advise_later()
        if session.program is not before.program:
            self._derive(Request(session.program))

    def on_key(self, event: Key) -> None:
        """Keys that nobody took: of what a slow link has split, and of what was pasted in part, say so."""
        if event.key in TOLD:
            self.say(TOLD[event.key], Tone.WARNING)

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """A sentence on the prompt line of the screen in front, or of the one under a dialog."""
        screens = self._screens()
        if screens:
            screens[-1].say(text, tone)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Under a dialog nothing is done to files and edits; Esc ends the guide only with nothing else to take back."""
        if action == "leave_guide":
            return self.guided and isinstance(self.screen, BaseScreen) and self.screen.at_rest
        dialog = isinstance(self.screen, ModalScreen) and not isinstance(self.screen, CommandPalette)
        return not (dialog and action in NOT_UNDER_DIALOGS) and super().check_action(action, parameters)

    # ---- what follows from the program

    def try_out(self, program: Program | None) -> None:
        """Show what a half-typed number would do; None for nothing half-typed."""
        self._advise_later()
        if program is not None:
            self._derive(Request(program, trial=True))
            return
        if self.shown is not self.session:
            self.shown = self.session
        if self._wanted is not None and self._wanted.trial:
            self._wanted = None
        if self._deriving is not None and self._deriving[0].trial:
            self._deriving[1].stopped = True
        if not self.session.derived_block.known and self._wanted is None:
            self._derive(Request(self.session.program))

    def _derive(self, request: Request) -> None:
        """Have a program derived; of several that wait only the newest is, and one nobody waits for is given up."""
        running = self._deriving
        if running is None:
            self._deriving = running = request, self.begin_work(self._calculation_stopped)
            self._derive_in_thread(*running)
        elif running[0].program is not request.program or running[1].stopped:
            self._wanted = request
            if running[0].trial or not request.trial:
                running[1].stopped = True

    # described, as every worker that takes a program: else Textual writes all of it down, before the next key
    @work(thread=True, group="derive", description="derive")
    def _derive_in_thread(self, request: Request, work: Work) -> None:
        try:
            result = derived(request, work)
        except Stopped:
            result = None
        self.post_message(ProgramDerived(result, request.trial))

    @on(ProgramDerived)
    def _program_derived(self, message: ProgramDerived) -> None:
        if not self.is_running:
            # the screens are gone
            return
        stopped = False
        if self._deriving is not None:
            stopped = self._deriving[1].stopped
            self.end_work(self._deriving[1])
        self._deriving, wanted, self._wanted, result = None, self._wanted, None, None if stopped else message.derived
        if result is not None and result.program is self.session.program:
            self.session = self.session.knowing(result)
            if wanted is None or not wanted.trial:
                self.shown = self.session
                self._mention_unit()
        elif result is not None and message.trial and wanted is None:
            self.shown = self.session.trying(result)
        if wanted is not None:
            self._derive(wanted)
        else:
            self._make_table()

    def _unit_question(self) -> str:
        """INCH or MM? as a sentence, empty where the part's size is as usual or nothing is known of it."""
        from core.pipeline.unit_question import unit_question
        from core.units import sentence

        question = unit_question(self.session.derived)
        return "" if question is None else sentence(question, self.session.program.unit)

    def _mention_unit(self) -> None:
        """Ask for the unit on the form, once for a program."""
        if not self._unit_mentioned and isinstance(self.screen, ContourScreen) and (text := self._unit_question()):
            self._unit_mentioned = True
            self.say(f"{text} UNITS is in PROGRAM PARAMETERS.", Tone.WARNING)

    def _make_table(self) -> None:
        """Have the look-ahead table of the block in front made, where it is not known yet."""
        block, running = self.session.derived_block, self._making_table
        if running is not None and running[0] is not block:
            running[1].stopped = True
        known = not block.known or self.stopped is block or (self.session.table and self.session.table[0] is block)
        if running is not None or known:
            self._advise_later()
            return
        self._making_table = block, self.begin_work(self._calculation_stopped)
        self._make_table_in_thread(block, self.session.program, self._making_table[1])

    @work(thread=True, group="table", description="table")
    def _make_table_in_thread(self, block: DerivedBlock, program: Program, work: Work) -> None:
        try:
            self.post_message(TableMade(block, lookahead_table(block, program, work)))
        except Stopped:
            self.post_message(TableMade(None, None))

    @on(TableMade)
    def _table_made(self, message: TableMade) -> None:
        if not self.is_running:
            return
        if not message.advised and self._making_table is not None:
            self.end_work(self._making_table[1])
            self._making_table = None
        if message.block is not None:
            trial = self.shown is not self.session
            self.session = self.session.with_table(message.block, message.table)
            if not trial:
                self.shown = self.session
        if not message.advised:
            self._make_table()

    def _calculation_stopped(self) -> None:
        """Esc has stopped the derivation or the table: it is begun again by an edit, or when it is asked for."""
        block = self.session.derived_block
        self.stopped = block if block.known else self.session.program
        self.say("Stopped. Any edit calculates again, or Ctrl+K and CALCULATE.", Tone.WARNING)

    def begin_guide(self) -> None:
        """The prompt leads through a first part from now on."""
        self.guided = True

    def action_leave_guide(self) -> None:
        """The prompt is the screens' own again; what was typed stays."""
        self.end_guide("The guide is off, the plate stays. GUIDED FIRST PART in Ctrl+K begins it anew.")

    def end_guide(self, text: str) -> None:
        """The prompt is the screens' own again; says so where it was not."""
        if self.guided:
            self.guided = False
            self.say(text)

    def watch_session(self, session: Session) -> None:
        """All screens follow the session."""
        for screen in self._screens():
            screen.follow(session)

    def watch_shown(self, shown: Session) -> None:
        """So they do what half-typed numbers would do."""
        for screen in self._screens():
            screen.follow_shown(shown)

    def watch_characters(self, characters: str) -> None:
        """All screens draw with these characters."""
        for screen in self._screens():
            screen.draw_with(characters)

    def _screens(self) -> list[BaseScreen]:
        return [screen for screen in self.screen_stack if isinstance(screen, BaseScreen)]

    def watch_guided(self) -> None:
        """The prompt changes at once."""
        if isinstance(self.screen, BaseScreen):
            self.screen.refresh_frame()

    def action_calculate(self) -> None:
        """Begin again what Esc has stopped."""
        self.stopped = None
        if self.session.derived_block.known:
            self._make_table()
        else:
            self._derive(Request(self.session.program))

    def _advise_later(self) -> None:
        """Stop looking for what would help; begin again once no key has come for a while."""
        self.workers.cancel_group(self, "advice")
        if self._advice_timer is not None:
            self._advice_timer.stop()
        self._advice_timer = self.set_timer(QUIET, self._advise) if self.is_running else None

    def _advise(self) -> None:
        """Have notes added to the look-ahead table of the block in front, where they are not known yet."""
        table, block = self.session.lookahead_table, self.session.derived_block
        if table is not None and not table.complete and self.shown is self.session and self._deriving is None:
            self._advise_in_thread(block, self.session.program, table)

    @work(thread=True, group="advice", exclusive=True, description="advice")
    def _advise_in_thread(self, block: DerivedBlock, program: Program, table: Table) -> None:
        worker = get_current_worker()
        for noted in advised(block, program, table, lambda: not worker.is_cancelled):
            if not worker.is_cancelled:
                self.post_message(TableMade(block, noted, advised=True))

    # ---- screens

    def bring(self, kind: type[BaseScreen]) -> None:
        """The screen of this kind to the front: the one that is open under others, else a new one over all."""
        depths = [depth for depth, screen in enumerate(self.screen_stack) if isinstance(screen, kind)]
        if not depths:
            self.push_screen(kind())
        elif any(proof in self.screen_stack[depths[-1] + 1 :] for proof in self.proofs):
            self._bring_over_proofs(depths[-1])
        else:
            self._uncover(depths[-1])

    def _uncover(self, depth: int) -> None:
        """The screen at a depth of the stack to the front; those over it are closed."""
        for _ in self.screen_stack[depth + 1 :]:
            self.pop_screen()

    @work(group="question")
    async def _bring_over_proofs(self, depth: int) -> None:
        """The same where NC texts are open over it: they are closed, and asked about first."""
        over = self.screen_stack[depth + 1 :]
        documents = [proof.document for proof in self.proofs if proof in over]
        if await self.may_close("LEAVE NC PROOF?", documents):
            await self.close_documents(documents)
            self._uncover(depth)

    def action_command_palette(self) -> None:
        """The palette of all actions."""
        from app.screens.palette import Palette

        if isinstance(self.screen, BaseScreen):
            # without Textual's id: the palette of a moment ago may still be going
            self.push_screen(Palette())

    def action_segment(self, number: int) -> None:
        """MILL CONTOUR with the cursor on a segment."""
        self.action_contour()
        self.move(FormPlace(self.session.place.block, number))

    def action_contour(self) -> None:
        """MILL CONTOUR, the form of the block with the cursor."""
        self.bring(ContourScreen)

    def action_program(self) -> None:
        """PROGRAM, the list of blocks."""
        from app.screens.program import ProgramScreen

        self.drop_empty_segment()
        self.bring(ProgramScreen)

    def action_home(self) -> None:
        """HOME, the files of a folder; once more, they are listed anew."""
        from app.screens.home import HomeScreen

        if isinstance(self.screen, HomeScreen):
            self.screen.list_anew()
        elif self.take_typed():
            proof = self.proof
            file = self.session.file if proof is None else proof.document.file.path
            self.push_screen(HomeScreen(current_folder() if file is None else file.absolute().parent))

    def action_parameters(self) -> None:
        """PROGRAM PARAMETERS."""
        from app.screens.parameters import ParametersScreen

        self.bring(ParametersScreen)

    def action_part_setup(self) -> None:
        """PART SETUP."""
        from app.screens.parameters import PartSetupScreen

        self.bring(PartSetupScreen)

    def action_tools(self) -> None:
        """TOOL SETUP."""
        from app.screens.tools import ToolsScreen

        self.bring(ToolsScreen)

    def action_lookahead(self) -> None:
        """LOOKAHEAD TABLE."""
        from app.screens.lookahead import LookaheadScreen

        self.bring(LookaheadScreen)

    def action_draw(self) -> None:
        """DRAW."""
        from app.screens.draw import DrawScreen

        self.bring(DrawScreen)

    def action_post(self) -> None:
        """POST NC, with the program's name; a part of unusual size is asked about first, once."""
        if not self._unit_settled and (text := self._unit_question()):
            self._ask_unit(text)
        else:
            self._show_post()

    @work(exclusive=True, group="question")
    async def _ask_unit(self, text: str) -> None:
        from app.documents.questions import GO_BACK, Answer
        from app.screens.dialogs import Question

        own = "INCH" if self.session.program.unit is Unit.IN else "MM"
        answers = [Answer(word, "as it is: go on" if word == own else "PROGRAM PARAMETERS") for word in ("INCH", "MM")]
        word = await self.push_screen_wait(Question("INCH or MM?", [text], answers, own))
        self._unit_settled = word != GO_BACK
        if word == own:
            self._show_post()
        elif word != GO_BACK:
            self.action_parameters()
            self.say("UNITS converts what is typed. Numbers typed in the wrong unit are typed again.", Tone.WARNING)

    def _show_post(self) -> None:
        from app.screens.post import PostScreen

        self.drop_empty_segment()
        file = self.session.file
        self.push_screen(PostScreen("part.nc" if file is None else str(file.with_suffix(".nc"))))

    def action_sheet(self) -> None:
        """SETUP SHEET, with the program's name."""
        from app.screens.sheet import SheetScreen

        file = self.session.file
        self.push_screen(SheetScreen("part.html" if file is None else str(file.with_suffix(".html"))))

    def action_import_tools(self) -> None:
        """IMPORT TOOL TABLE, in the program's unit."""
        from app.screens.import_tools import ImportToolsScreen

        self.push_screen(ImportToolsScreen("tool.tbl", self.session.program.unit))

    def action_help(self) -> None:
        """HELP for what has the cursor."""
        from app.screens.help import HelpScreen

        if isinstance(self.screen, HelpScreen) or not isinstance(self.screen, BaseScreen):
            return
        self.push_screen(HelpScreen(self.screen.current_field, self.screen.help_lines()))

    def action_redraw(self) -> None:
        """Send the whole screen again: others may have written on the terminal."""
        # the driver needs a terminal, which not every system has
        from app.terminal.driver import redraw

        redraw(self)

    def action_mouse(self) -> None:
        """Take the mouse, or leave it to the terminal, from now on."""
        # the driver needs a terminal, which not every system has
        from app.terminal.driver import has_mouse, take_mouse

        take_mouse(self, not has_mouse(self))
        words = (
            "Clicks act here." if has_mouse(self) else "The mouse is the terminal's again: it marks and copies text."
        )
        self.say(words)
        self.keep_settings(replace(self.settings, mouse=has_mouse(self)))

    def action_next_characters(self) -> None:
        """Draw with the next set of characters that the terminal has, from now on."""
        if len(self.character_sets) == 1:
            self.say("LANG or TERM says that there is no UTF-8: drawings are made of ASCII.")
            return
        here = self.character_sets.index(self.characters)
        self.characters = self.character_sets[(here + 1) % len(self.character_sets)]
        self.say(f"Drawn with {self.characters} characters.")
        self.keep_settings(replace(self.settings, characters=self.characters))

    def action_light_or_dark(self) -> None:
        """The other of the two themes, from now on; sixteen colors have none."""
        if self.theme == theme.SIXTEEN:
            self.say("This terminal has its own sixteen colors: its settings make it light or dark.")
            return
        light = self.theme == theme.DARK
        self.theme = theme.LIGHT if light else theme.DARK
        self.keep_settings(replace(self.settings, theme="light" if light else "dark"))

    def go_to(self, entry: Entry) -> None:
        """MILL CONTOUR with the cursor on the place of a finding."""
        segment = entry.segment or 0
        self.action_contour()
        self.move(FormPlace(self.session.place.block, segment), entry.field or SEGMENT)

    def now(self) -> datetime:
        """The time of day, in its zone."""
        return datetime.now().astimezone()

    # ---- what the actions on files need

    @property
    def current_session(self) -> Session:
        """The session as it is now."""
        return self.session

    def drop_empty_segment(self) -> None:
        """Take a new segment with the cursor away in which nothing was typed."""
        self._change(self.session.without_empty())

    def begin(self, session: Session) -> None:
        """Work on another program from now on, or on the same one under another name."""
        same = session.program is self.session.program and session.derived is self.session.derived
        if session.program is not self.session.program:
            self.guided = self._unit_mentioned = self._unit_settled = False
            self.quiet()
        self.session = self.shown = session
        if not same:
            self._derive(Request(session.program))

    def bring_form(self) -> None:
        """MILL CONTOUR to the front."""
        self._uncover(0)

    def bring_proof(self, proof: ProofScreen) -> None:
        """An NC PROOF that is open to the front."""
        self._uncover(self.screen_stack.index(proof))

    def quiet(self) -> None:
        """The prompts again, on every screen."""
        for screen in self.screen_stack:
            if isinstance(screen, BaseScreen):
                screen.quiet()

    def take_typed(self) -> bool:
        """Take what is half-typed on the screen in front; False where it is refused."""
        return not isinstance(self.screen, BaseScreen) or self.screen.take()

    def show_screen(self, screen: BaseScreen) -> None:
        """A screen over all others."""
        self.push_screen(screen)

    def show_nc(self, document: NcDocument, asked: Asked | None = None) -> None:
        """NC PROOF on a text, with the control, the tools and the unit that were asked for at the start."""
        from app.nc_proof.screen import ProofScreen

        path, settings = document.file.path, self.settings
        remembered = "" if path is None else settings.tools_of(path)
        self.push_screen(ProofScreen(document, self.keep_document, asked, settings.control, remembered))

    def keep_control(self, control: str) -> None:
        """NC programs are run on this control from now on."""
        self.keep_settings(replace(self.settings, control=control))

    def keep_tools(self, file: Path | None, text: str) -> None:
        """An NC program has these tools from now on."""
        if file is not None:
            self.keep_settings(self.settings.with_tools(file, text))

    @property
    def proof(self) -> ProofScreen | None:
        """NC PROOF, where it is in front."""
        from app.nc_proof.screen import ProofScreen

        return self.screen if isinstance(self.screen, ProofScreen) else None

    @property
    def proofs(self) -> list[ProofScreen]:
        """Every NC PROOF that is open."""
        from app.nc_proof.screen import ProofScreen

        return [screen for screen in self.screen_stack if isinstance(screen, ProofScreen)]

    @property
    def proof_is_open(self) -> bool:
        """Whether an NC PROOF is open, in front or below."""
        return bool(self.proofs)

    def action_nc_proof(self) -> None:
        """Ask for the path of an NC program."""
        self.action_open_path()

    def show_folder(self, folder: Path, at: Path | None = None) -> None:
        """HOME with the files of a folder, the cursor on one of them."""
        from app.screens.home import HomeScreen

        self.push_screen(HomeScreen(folder, at))


def _contour_document(session: Session, service: DocumentService | None, opened: Opened[Any] | None) -> ContourDocument:
    """The program to begin with: beside an NC text it is a new one, which the service has to know."""
    if opened is not None and isinstance(opened.document, ContourDocument):
        return opened.document
    return ContourDocument.of(session.program) if service is None else service.new().document
