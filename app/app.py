"""CutcompApp owns the session, opens the screens and runs the workers."""

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
from app.documents.document_service import DocumentService, Opened
from app.documents.paths import current_folder
from app.documents.settings import SettingsFile
from app.documents.time_limits import Disk
from app.file_actions import session_of
from app.screens.base import HEIGHT_CLASSES, WIDTH_CLASSES, BaseScreen, OpeningScreen
from app.screens.contour import ContourScreen
from app.session.block_findings import Entry
from app.session.messages import Tone
from app.session.posting import CENTER_PATH
from app.session.session import Session
from app.terminal.capabilities import CHARACTER_SETS
from app.terminal.driver import has_mouse, redraw, take_mouse
from app.terminal.split_keys import KEY_WARNINGS
from app.transform_actions import TransformActions
from app.widgets.plain import PRINTABLE
from app.widgets.status import Surroundings
from core.program.edit import SEGMENT_FIELD, FormPlace
from core.units import Unit

if TYPE_CHECKING:
    from textual.command import Provider

    from core.pipeline.checking import CheckRequest

SECONDS_BETWEEN_MESSAGE_CHECKS: Final = 0.2
"""Seconds between two checks whether a message has disappeared."""


def _actions() -> type[Provider]:
    """Return the palette's commands.  Only the first screen is imported at startup, so that it appears sooner."""
    from app.screens.palette import Actions

    return Actions


NOT_UNDER_DIALOGS: Final = frozenset({"undo", "redo", "quit", "save", "save_as", "home", "new"})
"""Actions whose keys do nothing while a dialog is open."""


class CutcompApp(TransformActions):
    """The App: its startup, and the actions that all screens share."""

    CSS_PATH = "app.tcss"
    TITLE = "cutcomp"
    HORIZONTAL_BREAKPOINTS = WIDTH_CLASSES
    VERTICAL_BREAKPOINTS = HEIGHT_CLASSES
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
        session: Session | None = None,
        *,
        surroundings: Surroundings | None = None,
        few_colors: bool = False,
        light: bool = False,
        character_sets: tuple[str, ...] = CHARACTER_SETS,
        service: DocumentService | None = None,
        opened: Opened[Any] | None = None,
        settings_file: SettingsFile | None = None,
        home: bool = False,
        check_request: CheckRequest | None = None,
    ) -> None:
        super().__init__(ansi_color=few_colors or None)
        self.surroundings = surroundings or Surroundings()
        self.service, self.disk = service or DocumentService(), Disk()
        self._opened, self._home, self._check_request = opened, home, check_request
        self.drawing: Path | None = None
        self.settings_file = settings_file or SettingsFile()
        document = None if opened is None else opened.document
        # an NC text opens over a new program
        self.document = document if isinstance(document, ContourDocument) else self.service.new().document
        self.character_sets = character_sets
        self.set_reactive(CutcompApp.characters, character_sets[0])
        self.posted_for = CENTER_PATH
        """The control of the last posted NC file, or the center path."""
        session = session or session_of(self.document)
        self.set_reactive(CutcompApp.session, session)
        self.set_reactive(CutcompApp.displayed, session)
        for each in theme.themes():
            self.register_theme(each)
        # without the watcher, which would parse every style once more
        self.set_reactive(
            CutcompApp.theme,
            theme.SIXTEEN_COLOR_THEME if few_colors else theme.LIGHT_THEME if light else theme.DARK_THEME,
        )
        self.stylesheet.set_variables(self.get_css_variables())

    def get_line_filters(self) -> Sequence[LineFilter]:
        """Add a filter so that no text from a file can move the terminal's cursor, wherever it is shown."""
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
        """Show a message over the screen; brackets in a file name stay plain text."""
        text = escape(message) if markup else message
        super().notify(text, title=title, severity=severity, timeout=timeout, markup=markup)
        self.set_timer(timeout or self.NOTIFICATION_TIMEOUT, self._paint_behind_messages)

    def clear_notifications(self) -> None:
        """Take the messages over the screen away."""
        if self.screen.query("Toast"):
            super().clear_notifications()
            self.set_timer(SECONDS_BETWEEN_MESSAGE_CHECKS, self._paint_behind_messages)

    def _paint_behind_messages(self) -> None:
        """Repaint once the messages are gone: Textual may leave part of one if something else changes then."""
        if not self.screen_stack:
            # the program is ending
            return
        if self.screen.query("Toast"):
            self.set_timer(SECONDS_BETWEEN_MESSAGE_CHECKS, self._paint_behind_messages)
        else:
            self.screen.refresh()

    def get_default_screen(self) -> Screen[None]:
        """Return MILL CONTOUR."""
        return ContourScreen()

    def on_mount(self) -> None:
        """Show HOME first if asked to, or that a file is being opened whose screen is loaded later.

        Nobody may type into the form of a new program that is not meant.
        """
        opened = None if self._opened is None else self._opened.document
        opened_later = self.drawing or (opened.file.path if isinstance(opened, NcDocument) else None)
        if self._home:
            self.action_home()
        elif opened_later is not None:
            self.push_screen(OpeningScreen(opened_later.name))

    def on_ready(self) -> None:
        """Start the first calculation once the first screen is painted; show the opened file and its question."""
        self.call_after_refresh(self._first_painted)
        if isinstance(self.screen, OpeningScreen):
            self.call_after_refresh(self._show_first_file)
        else:
            self._show_first_file()

    def _show_first_file(self) -> None:
        """Show the opened file and its question; loading the screen of a drawing or an NC text takes a while."""
        if isinstance(self.screen, OpeningScreen):
            self.pop_screen()
        if self.drawing is not None:
            self.show_drawing(self.drawing, fresh=True)
        if self._opened is not None:
            document = self._opened.document
            if isinstance(document, NcDocument):
                self.show_nc(document, self._check_request)
            else:
                self.keep_settings(self.settings.using(document.file.path))
            self.show_notice_and_ask(self._opened)

    def on_app_blur(self, event: AppBlur) -> None:
        """Ignore a switch to another window: the field keeps the cursor and its half-typed text."""
        event.prevent_default()

    def _first_painted(self) -> None:
        """Turn the garbage collector on and start calculating; the first paint waits for neither."""
        if not gc.isenabled():
            # all objects so far live until the program ends
            gc.freeze()
            gc.enable()
        if self._deriving is None:
            self._derive(self.session.program)

    # ---- keys and actions of all screens

    def on_key(self, event: Key) -> None:
        """Warn about a key that a slow link has split, or a paste that came without its end."""
        if event.key in KEY_WARNINGS:
            self.say(KEY_WARNINGS[event.key], Tone.WARNING)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Block file and edit actions under a dialog; let Esc end the guide only if it has nothing else to do."""
        if action == "leave_guide":
            return self.guided and isinstance(self.screen, BaseScreen) and self.screen.at_rest
        dialog = isinstance(self.screen, ModalScreen) and not isinstance(self.screen, CommandPalette)
        return not (dialog and action in NOT_UNDER_DIALOGS) and super().check_action(action, parameters)

    def action_leave_guide(self) -> None:
        """End the guide; what was typed stays."""
        self.end_guide("The guide is off, what you typed stays. GUIDED FIRST PART in Ctrl+K starts it again.")

    # ---- screens

    def bring(self, kind: type[BaseScreen]) -> None:
        """Bring the open screen of this kind to the front, or open a new one on top."""
        depths = [depth for depth, screen in enumerate(self.screen_stack) if isinstance(screen, kind)]
        if not depths:
            self.push_screen(kind())
        elif any(proof in self.screen_stack[depths[-1] + 1 :] for proof in self.proofs):
            self._bring_over_proofs(depths[-1])
        else:
            self._uncover(depths[-1])

    @work(group="question")
    async def _bring_over_proofs(self, depth: int) -> None:
        """Bring the screen at `depth` to the front; ask about the NC texts on top of it and close them."""
        above = [proof for proof in self.proofs if proof in self.screen_stack[depth + 1 :]]
        if await self.close_documents("LEAVE NC PROOF?", above):
            self._uncover(depth)

    def action_command_palette(self) -> None:
        """Open the palette of all actions."""
        from app.screens.palette import Palette

        if isinstance(self.screen, BaseScreen):
            # what was said before does not concern the action that comes next
            self.screen.clear_notice()
            # without Textual's id, as the previous palette may still be closing
            self.push_screen(Palette())

    def action_segment(self, number: int) -> None:
        """Show MILL CONTOUR with the cursor on a segment."""
        self.action_contour()
        self.move(FormPlace(self.session.place.block, number))

    def action_contour(self) -> None:
        """Show MILL CONTOUR, the form of the block with the cursor."""
        self.bring(ContourScreen)

    def form_in_front(self) -> ContourScreen | None:
        """Take what is half-typed and bring MILL CONTOUR to the front; None if either is refused or waits."""
        if self.take_typed():
            self.action_contour()
        if not isinstance(self.screen, ContourScreen):
            return None
        self.screen.follow(self.session)
        self.screen.follow_displayed(self.displayed)
        return self.screen

    def action_program(self) -> None:
        """Show PROGRAM, the list of blocks."""
        from app.screens.program import ProgramScreen

        self.drop_empty_segment()
        self.bring(ProgramScreen)

    def action_home(self) -> None:
        """Show HOME, the files of a folder; on HOME, refresh the list."""
        from app.screens.home import HomeScreen

        if isinstance(self.screen, HomeScreen):
            self.screen.list_anew()
        elif self.take_typed():
            proof = self.proof
            file = self.session.file if proof is None else proof.document.file.path
            self.push_screen(HomeScreen(current_folder() if file is None else (current_folder() / file).parent))

    def action_parameters(self) -> None:
        """Show PROGRAM PARAMETERS."""
        from app.screens.parameters import ParametersScreen

        self.bring(ParametersScreen)

    def action_part_setup(self) -> None:
        """Show PART SETUP."""
        from app.screens.parameters import PartSetupScreen

        self.bring(PartSetupScreen)

    def action_tools(self) -> None:
        """Show TOOL SETUP."""
        from app.screens.tools import ToolsScreen

        self.bring(ToolsScreen)

    def action_lookahead(self) -> None:
        """Show LOOKAHEAD TABLE."""
        from app.screens.lookahead import LookaheadScreen

        self.bring(LookaheadScreen)

    def action_draw(self) -> None:
        """Show DRAW."""
        from app.screens.draw import DrawScreen

        self.bring(DrawScreen)

    def action_post(self) -> None:
        """Show POST NC with the program's name; first, once, ask about the unit if the part's size is unusual."""
        if not self._unit_settled and (text := self._unit_question()):
            self._ask_unit(text)
        else:
            self._show_post()

    @work(exclusive=True, group="question")
    async def _ask_unit(self, text: str) -> None:
        from app.documents.questions import GO_BACK, Answer
        from app.screens.dialogs import Question

        unit = "INCH" if self.session.program.unit is Unit.IN else "MM"
        answers = [Answer(word, "as it is: go on" if word == unit else "PROGRAM PARAMETERS") for word in ("INCH", "MM")]
        word = await self.push_screen_wait(Question("INCH or MM?", [text], answers, unit))
        self._unit_settled = word != GO_BACK
        if word == unit:
            self._show_post()
        elif word != GO_BACK:
            self.action_parameters()
            self.say("UNITS converts what is typed. Numbers that it makes wrong must be typed again.", Tone.WARNING)

    def _show_post(self) -> None:
        from app.screens.post import PostScreen

        self.drop_empty_segment()
        file = self.session.file
        self.push_screen(PostScreen("part.nc" if file is None else str(file.with_suffix(".nc"))))

    def action_sheet(self) -> None:
        """Show SETUP SHEET with the program's name."""
        from app.screens.sheet import SheetScreen

        file = self.session.file
        self.push_screen(SheetScreen("part.html" if file is None else str(file.with_suffix(".html"))))

    def action_import_tools(self) -> None:
        """Show IMPORT TOOL TABLE, starting with the program's unit."""
        from app.screens.import_tools import ImportToolsScreen

        self.push_screen(ImportToolsScreen("tool.tbl", self.session.program.unit))

    def action_help(self) -> None:
        """Show HELP for the field with the cursor and its screen."""
        from app.screens.help import HelpScreen

        if isinstance(self.screen, HelpScreen) or not isinstance(self.screen, BaseScreen):
            return
        self.push_screen(HelpScreen(self.screen.current_field, self.screen.help_lines()))

    def action_redraw(self) -> None:
        """Send the whole screen again: other programs may have written to the terminal."""
        redraw(self)

    def action_mouse(self) -> None:
        """Turn the mouse on, or leave it to the terminal, from now on."""
        take_mouse(self, not has_mouse(self))
        text = "Clicks act here." if has_mouse(self) else "The mouse is the terminal's again: it marks and copies text."
        self.say(text)
        self.keep_settings(replace(self.settings, mouse=has_mouse(self)))

    def action_next_characters(self) -> None:
        """Switch to the terminal's next character set, from now on."""
        if len(self.character_sets) == 1:
            self.say("LANG or TERM says that there is no UTF-8: drawings are made of ASCII.")
            return
        here = self.character_sets.index(self.characters)
        self.characters = self.character_sets[(here + 1) % len(self.character_sets)]
        self.say(f"Drawn with {self.characters} characters.")
        self.keep_settings(replace(self.settings, characters=self.characters))

    def action_light_or_dark(self) -> None:
        """Switch between light and dark, from now on; a sixteen-color terminal has only one theme."""
        if self.theme == theme.SIXTEEN_COLOR_THEME:
            self.say("This terminal has its own sixteen colors: its settings make it light or dark.")
            return
        light = self.theme == theme.DARK_THEME
        self.theme = theme.LIGHT_THEME if light else theme.DARK_THEME
        self.keep_settings(replace(self.settings, theme="light" if light else "dark"))

    def go_to(self, entry: Entry) -> None:
        """Show the form of a finding's field, MILL CONTOUR or a program-wide one, with the cursor on the field."""
        from app.screens.parameters import ParametersScreen, PartSetupScreen

        segment = entry.segment or 0
        self.action_contour()
        for screen in (ParametersScreen, PartSetupScreen):
            if entry.field in {field.name for field in screen.FIELDS}:
                self.push_screen(screen(entry.field or ""))
                return
        self.move(FormPlace(self.session.place.block, segment), entry.field or SEGMENT_FIELD)

    def now(self) -> datetime:
        """Return the local date and time with its time zone."""
        return datetime.now().astimezone()
