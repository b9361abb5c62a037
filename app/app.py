"""The App: owns the session, opens the screens, runs the workers."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

from textual import work
from textual.binding import Binding, BindingType
from textual.command import CommandPalette
from textual.events import AppBlur, Key
from textual.filter import LineFilter
from textual.markup import escape
from textual.notifications import SeverityLevel
from textual.screen import ModalScreen, Screen

from app import theme
from app.documents.document import ContourDocument, NcDocument
from app.documents.folders import current_folder
from app.documents.service import DocumentService, Opened
from app.documents.settings import SettingsFile
from app.screens.base import HEIGHTS, WIDTHS, BaseScreen
from app.screens.contour import ContourScreen
from app.session.block_findings import Entry
from app.session.derivation import Request
from app.session.messages import Tone
from app.session.posting import CENTER_PATH
from app.session.session import SEGMENT, Session
from app.terminal.split_keys import TOLD
from app.transform_actions import TransformActions
from app.widgets.printable import PRINTABLE
from app.widgets.status import Surroundings
from core.program.edit import FormPlace
from core.units import Unit

if TYPE_CHECKING:
    from textual.command import Provider

    from core.pipeline.checking import Asked

MESSAGE_GOES: Final = 0.2
"""Seconds between two looks at whether a message has gone."""


def _actions() -> type[Provider]:
    """The palette's commands.  All screens but the first are imported when they are opened: it stands sooner."""
    from app.screens.palette import Actions

    return Actions


NOT_UNDER_DIALOGS: Final = frozenset({"undo", "redo", "quit", "save", "save_as", "home", "new"})
"""Actions whose keys wait until a dialog is answered."""


class CutcompApp(TransformActions):
    """The screens' actions, and how the program begins."""

    CSS_PATH = "app.tcss"
    TITLE = "cutcomp"
    HORIZONTAL_BREAKPOINTS = WIDTHS
    VERTICAL_BREAKPOINTS = HEIGHTS
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
        self.service = service or DocumentService()
        self._opened, self._home, self._asked = opened, home, asked
        self.drawing: Path | None = None
        self.settings_file = settings_file or SettingsFile()
        self.settings = self.settings_file.held
        document = None if opened is None else opened.document
        # beside an NC text the program is a new one
        self.document = document if isinstance(document, ContourDocument) else self.service.new().document
        self.character_sets = character_sets
        self.set_reactive(CutcompApp.characters, character_sets[0])
        self.posted_for = CENTER_PATH
        """The control for which an NC file was posted last, or the center path."""
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

    # ---- keys and actions of all screens

    def on_key(self, event: Key) -> None:
        """Keys that nobody took: of what a slow link has split, and of what was pasted in part, say so."""
        if event.key in TOLD:
            self.say(TOLD[event.key], Tone.WARNING)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Under a dialog nothing is done to files and edits; Esc ends the guide only with nothing else to take back."""
        if action == "leave_guide":
            return self.guided and isinstance(self.screen, BaseScreen) and self.screen.at_rest
        dialog = isinstance(self.screen, ModalScreen) and not isinstance(self.screen, CommandPalette)
        return not (dialog and action in NOT_UNDER_DIALOGS) and super().check_action(action, parameters)

    def action_leave_guide(self) -> None:
        """The prompt is the screens' own again; what was typed stays."""
        self.end_guide("The guide is off, what you typed stays. GUIDED FIRST PART in Ctrl+K begins it anew.")

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
