"""BaseScreen is the frame of every screen: title lines, body, softkeys, prompt and status in fixed places.

To add a screen:

1. Write `app/screens/NAME.py` with a class `NameScreen(BaseScreen)`: `compose_body` yields its widgets, `SOFTKEYS` are
   its eight softkeys, `show_session` shows a new session, `PROMPT` or `prompt_text` tells what the keys do.
   A screen with fields is a `FormScreen` instead (`app/screens/form_screen.py`).
2. Give the App a method `action_NAME` that calls `self.bring(NameScreen)` (`app/app.py`).  A softkey or a binding of
   any screen then names `app.NAME`, and `app.back` closes it.  Screens never import each other.
3. Put its styles into `app/app.tcss`: the sizes are style classes, see `HORIZONTAL_BREAKPOINTS`.

A dialog is a `ModalScreen` in `app/screens/dialogs.py`.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, ClassVar, Final, cast

from textual import on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.events import DescendantFocus, Resize, ScreenResume
from textual.reactive import Reactive
from textual.screen import ModalScreen, Screen
from textual.widget import Widget
from textual.widgets import Input, OptionList

from app.session.guide import NOT_NEEDED
from app.session.messages import Sentence, Tone
from app.session.session import Session
from app.session.work import Work
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList
from app.widgets.plain import PlainLabel
from app.widgets.segment_list import SegmentList
from app.widgets.softkeys import Softkey, Softkeys
from app.widgets.status import Progress, Prompt, Status
from app.widgets.verdict import Verdict
from core.program.fields import Field
from core.units import Kind

if TYPE_CHECKING:
    from app.app import CutcompApp

SMALLEST_TERMINAL = (60, 20)
"""Columns and rows of the smallest supported terminal."""

WIDTH_CLASSES: Final = [(0, "-narrow"), (80, "-native"), (100, "-medium"), (132, "-wide"), (190, "-huge")]
HEIGHT_CLASSES: Final = [(0, "-short"), (28, "-tall")]
"""The style class of a screen from each number of columns, or of lines, upward."""

LIST_KEYS: Final = (("F9", "SEGMENTS"), ("F10", "FINDINGS"))
NO_LIST_KEYS: Final = (("^K", "ALL ACTIONS"), ("?", "KEYS, HELP"))
"""The keys under the softkeys: those of a block's lists, and those of a screen that is not of a block."""


class BaseScreen(Screen[None]):
    """A screen in the common frame; it follows the App's session while it is in view."""

    focused: Reactive[Widget | None] = Reactive(None, repaint=False)
    """Not repainting: moving the cursor repaints two fields, not the whole screen."""

    AUTO_FOCUS: ClassVar[str | None] = ""
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("question_mark", "question_mark", "Help", show=False, priority=True),
        *(Binding(f"f{number},alt+{number}", f"softkey({number})", f"F{number}", show=False) for number in range(1, 9)),
        Binding("f9,ctrl+t", "panel('segments')", "Segments", show=False),
        Binding("f10,ctrl+f", "panel('findings')", "Findings", show=False),
        Binding("ctrl+n", "finding(1)", "Next finding", show=False),
        Binding("ctrl+p", "finding(-1)", "Finding before", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (None,) * 8
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (*LIST_KEYS, *NO_LIST_KEYS)
    """Further keys, listed under the softkeys; the keys of lists and findings act only where F10 is one of them."""
    PROMPT: ClassVar[str] = ""
    """What the keys do, where that is always the same."""
    GUIDE: ClassVar[str] = NOT_NEEDED
    """The step of the guided first part on this screen, where that is always the same."""
    PALETTE_ACTIONS: ClassVar[tuple[tuple[str, str, str], ...]] = ()
    """Name, action and hint of each palette action that this screen adds to its softkeys."""
    SHOWS_STATE_OF_BELOW: ClassVar[bool] = False
    """Whether the status line is about the document of the screen below."""
    HAS_PROGRESS: ClassVar[bool] = False
    """Whether a bar in the place of the prompt shows long work, not the status line."""
    SHOWS_NC_TEXT: ClassVar[bool] = False
    """Whether this is the screen NC PROOF."""

    def __init__(self) -> None:
        super().__init__()
        self.session: Session | None = None
        """The session that is shown."""
        self.notice: Sentence | None = None
        """A sentence shown in place of the prompt until the next accepted key."""
        self._marked: dict[str, Widget | None] = {}
        self._composed = False

    @property
    def host(self) -> CutcompApp:
        """The App with its own methods."""
        return cast("CutcompApp", self.app)

    @property
    def current_session(self) -> Session:
        """The App's current session."""
        return self.host.session

    def compose(self) -> ComposeResult:
        """Lay out the frame around the body; set the size classes first, or everything would be styled twice."""
        for points, size in ((WIDTH_CLASSES, self.app.size.width), (HEIGHT_CLASSES, self.app.size.height)):
            self.add_class(max(point for point in points if point[0] <= size)[1], update=False)
        with Horizontal(id="main"):
            with Vertical(id="desk"):
                yield from self.compose_body()
            yield Softkeys(self.SOFTKEYS, self.MORE_KEYS, self.key_acts)
        yield Prompt()
        if self.HAS_PROGRESS:
            yield Progress()
        yield Status(self.host.surroundings)

    @abstractmethod
    def compose_body(self) -> ComposeResult:
        """Yield the screen's own widgets."""

    def show_session(self, session: Session) -> None:
        """Show a changed session."""

    @property
    def current_field(self) -> Field | None:
        """The definition of the field with the cursor; None if the cursor is not in a field."""
        return None

    def undo_or_redo_own_document(self, _action: str, /) -> bool:
        """Undo or redo on this screen's own document, if it has one; return whether the action was handled."""
        return False

    def action_question_mark(self) -> None:
        """Open HELP; in a text field, type the question mark."""
        field, widget = self.current_field, self.focused
        if isinstance(widget, Input) and field is not None and field.kind is Kind.TEXT:
            widget.insert_text_at_cursor("?")
        else:
            self.app.call_later(self.app.run_action, "app.help")

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Block the keys of lists and findings where the softkeys do not list them: the screen is not of a block."""
        has_lists = any(key == "F10" for key, _ in self.MORE_KEYS)
        return (has_lists or action not in ("panel", "finding")) and super().check_action(action, parameters)

    def action_panel(self, name: str) -> None:
        """Go to the list of segments or of findings on MILL CONTOUR."""
        if (form := self.host.form_in_front()) is not None:
            form.open_panel(name)

    def action_finding(self, by: int) -> None:
        """Show the next or previous finding on MILL CONTOUR."""
        if (form := self.host.form_in_front()) is not None:
            form.step_finding(by, form.selected_finding)

    @on(OptionList.OptionSelected)
    def _go_to_finding(self, event: OptionList.OptionSelected) -> None:
        """Go to the field that a finding is about; skip a finding that has gone meanwhile."""
        findings = event.option_list
        if isinstance(findings, FindingsList) and event.option_index == findings.highlighted:
            self.host.go_to(findings.entries[event.option_index])

    def help_lines(self) -> tuple[str, ...]:
        """Return sentences about this screen, for HELP."""
        return ()

    def prompt_text(self) -> Sentence:
        """Return what the focused widget takes."""
        return Sentence(self.PROMPT)

    def on_mount(self) -> None:
        """Show the App's session; from then on the App tells its screens about changes.

        A watcher would keep closed screens alive in the App's lists until the next change.
        """
        self._composed = True
        self.follow(self.host.session)
        self.draw_with(self.host.characters)

    def draw_with(self, characters: str) -> None:
        """Draw every widget that has signs with these characters."""
        for widget in self.query("*").results():
            if isinstance(widget, Drawing | Verdict | FindingsList | SegmentList):
                widget.characters = characters

    def show_signs(self) -> None:
        """Redraw everything else that has signs after the character set has changed."""
        if self.is_live:
            self.show_session(self.current_session)

    @on(ScreenResume)
    def _keep_styles(self, event: ScreenResume) -> None:
        """Keep the styles: every widget got them when it was mounted."""
        event.refresh_styles = False

    def on_screen_resume(self) -> None:
        """Catch up with changes made while another screen was in front."""
        self.follow(self.host.session)
        self.follow_displayed(self.host.displayed)
        self.show_work(self.host.longest_work)
        if self.is_live:
            self.query_one(Status).read_machine()
        self.call_after_refresh(self._place_cursor)

    def on_screen_suspend(self) -> None:
        """Forget the sentence about the last key when another screen covers this one; under a dialog it stays."""
        if not self.in_view:
            self.clear_notice()

    def _place_cursor(self) -> None:
        """Move the terminal's own hidden cursor to the field: input methods and magnifiers follow it."""
        if isinstance(self.focused, Input):
            self.app.cursor_position = self.focused.cursor_screen_offset
            self.focused.refresh()

    @property
    def in_view(self) -> bool:
        """True if only dialogs cover the screen; Textual's `is_current` is also true of the next screen below."""
        stack = self.app.screen_stack
        if not self.is_live or self not in stack:
            return False
        return all(isinstance(each, ModalScreen) for each in stack[stack.index(self) + 1 :])

    def follow(self, session: Session) -> None:
        """Show the session if it is a new one and the screen is in view."""
        if self.in_view and session is not self.session:
            self.session = session
            self.show_session(session)
            self.show_state()
            self.refresh_frame()

    def show_state(self) -> None:
        """Show the unit, the undo counts and the saved state on the status line."""
        self.show_state_on(self.query_one(Status))

    def show_state_on(self, status: Status) -> None:
        """Show them on the status line of this screen, or of one on top of it."""
        stack = self.app.screen_stack
        below = [screen for screen in stack[: stack.index(self)] if isinstance(screen, BaseScreen)]
        if not self.SHOWS_STATE_OF_BELOW:
            status.show_program(self.current_session)
        elif below:
            below[-1].show_state_on(status)

    def follow_displayed(self, displayed: Session) -> None:
        """Show what half-typed numbers would do, on screens that show this."""

    def refresh_frame(self) -> None:
        """Update prompt and softkeys; a screen that is not ready yet shows them once it is."""
        if not self.is_live:
            return
        prompt = self.notice or self.too_small() or self.prompt_text()
        if self.host.guided and self.notice is None and prompt.tone is not Tone.ERROR:
            prompt = Sentence(f"GUIDE  {self.guide_text()}")
        self.query_one(Prompt).show(prompt)
        self.query_one(Softkeys).refresh_keys()

    def guide_text(self) -> str:
        """Return the next step of the guided first part on this screen."""
        return self.GUIDE

    @property
    def is_live(self) -> bool:
        """True if the screen is composed and not being removed; a removal first turns `display` off."""
        return self._composed and self.is_attached and self.display

    @property
    def at_rest(self) -> bool:
        """True if Esc has nothing to restore or close here."""
        return False

    def show_work(self, work: Work | None) -> None:
        """Show the progress of long work in the place of the prompt or on the status line, if the screen is ready."""
        if not self.is_live:
            return
        if not self.HAS_PROGRESS:
            self.query_one(Status).show_work("" if work is None else work.text)
            return
        progress = self.query_one(Progress)
        if work is not None:
            progress.show(work)
        progress.display = work is not None
        self.query_one(Prompt).display = work is None

    def too_small(self) -> Sentence | None:
        """Return a warning if the terminal is smaller than supported; all keys still work."""
        width, height = self.app.size
        if width >= SMALLEST_TERMINAL[0] and height >= SMALLEST_TERMINAL[1]:
            return None
        return Sentence(
            f"Window is {width}x{height}; it needs {SMALLEST_TERMINAL[0]}x{SMALLEST_TERMINAL[1]}.", Tone.WARNING
        )

    def take(self) -> bool:
        """Take the text typed into the field with the cursor; return False, and say why, if it is refused."""
        return True

    @property
    def half_typed_sentence(self) -> str:
        """What is typed and not taken yet; empty if nothing is."""
        return ""

    def forget_typed(self) -> None:
        """Discard typed text that has not been taken."""

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """Show a sentence on the prompt line until the next accepted key."""
        self.notice = Sentence(text, tone)
        if self._composed:
            self.refresh_frame()

    def clear_notice(self) -> None:
        """Show the prompt again instead of a sentence."""
        if self.notice is not None:
            self.notice = None
            self.refresh_frame()

    @on(DescendantFocus)
    def _mark_focus(self, event: DescendantFocus) -> None:
        """Mark the cursor's label and panel with classes: `:focus-within` would restyle and repaint far more."""
        row = event.widget.parent
        labels = (each for each in row.children if each.has_class("label")) if row is not None else iter(())
        panels = (each for each in event.widget.ancestors if isinstance(each, Widget) and each.has_class("panel"))
        self._mark("-at", next(labels, None))
        self._mark("-here", next(panels, None))
        self.refresh_frame()

    def _mark(self, name: str, widget: Widget | None) -> None:
        before = self._marked.get(name)
        if before is widget:
            return
        self._marked[name] = widget
        changed = [each for each in (before, widget) if each is not None]
        for each in changed:
            each.set_class(each is widget, name, update=False)
        # their children look the same as before
        self.app.stylesheet.update_nodes(changed)

    @on(Resize)
    def _fit_frame(self) -> None:
        """Update the warning about a small terminal and the length of the softkey names."""
        self.call_after_refresh(self.refresh_frame)

    async def action_softkey(self, number: int) -> None:
        """Press a softkey."""
        key = self.SOFTKEYS[number - 1]
        if key is None or not self.key_acts(key):
            self.say("" if key is None else key.idle)
            return
        self.clear_notice()
        await self.run_action(key.action)

    def key_acts(self, key: Softkey) -> bool:
        """Return whether a softkey does anything now."""
        return key.acts(self)


class OpeningScreen(BaseScreen):
    """The name of an NC text or a drawing while its screen is loaded: no field takes keys that are not meant for it."""

    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = ()
    PROMPT: ClassVar[str] = "The file is being opened."

    def __init__(self, name: str) -> None:
        super().__init__()
        self._name_of_file = name

    def compose_body(self) -> ComposeResult:
        """Lay out the title."""
        with Horizontal(classes="head"):
            yield PlainLabel(self._name_of_file, classes="head-title")

    def show_state_on(self, status: Status) -> None:
        """Show no unit: the file's is not known yet."""
