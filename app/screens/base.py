"""The frame of every screen: title lines, body, softkeys, prompt and status in the same places.

To add a screen:

1. Write `app/screens/NAME.py` with a class `NameScreen(BaseScreen)`: `compose_body` yields its widgets, `SOFTKEYS` are
   its eight softkeys, `show_session` shows a new session, `prompt_text` says what the widget with the cursor takes.
   A screen with fields is a `FormScreen` instead (`app/screens/form_screen.py`).
2. Give the App a method `action_NAME` that calls `self.bring(NameScreen)` (`app/app.py`).  A softkey or a binding of
   any screen then names `app.NAME`, and `app.back` closes it; a softkey whose action does not exist is dim.  Screens
   never import each other.
3. Put its looks into `app/app.tcss`: the sizes are style classes, see `HORIZONTAL_BREAKPOINTS`.

A dialog is a `ModalScreen` in `app/screens/dialogs.py`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, ClassVar, Final, Protocol, cast

from textual import on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.events import DescendantFocus, Resize
from textual.reactive import Reactive, var
from textual.screen import ModalScreen, Screen
from textual.widget import Widget
from textual.widgets import Input

from app.documents.document import NcDocument
from app.documents.settings import Settings
from app.session.block_findings import Entry as FindingEntry
from app.session.guide import NOT_NEEDED
from app.session.messages import Sentence, Tone
from app.session.session import SEGMENT, Session
from app.session.work import Work
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList
from app.widgets.prompt import Prompt
from app.widgets.segment_list import SegmentList
from app.widgets.softkeys import Softkey, Softkeys
from app.widgets.status import Status, Surroundings
from app.widgets.verdict import Verdict
from core.program.edit import Edited, FormPlace
from core.program.fields import Field
from core.program.model import Program
from core.units import Kind

SMALLEST = (60, 20)
"""Columns and rows that the screens are made for at least."""

WIDTHS: Final = [(0, "-narrow"), (80, "-native"), (100, "-medium"), (132, "-wide"), (190, "-huge")]
HEIGHTS: Final = [(0, "-short"), (28, "-tall")]
"""The style classes of a screen from so many columns and lines on."""


class Host(Protocol):
    """What screens ask of the App."""

    @property
    def session(self) -> Session:
        """The work as it has been accepted."""

    @property
    def shown(self) -> Session:
        """The same, or as a half-typed number would make it: what verdict and drawings show."""

    @property
    def characters(self) -> str:
        """What drawings are made of: braille, block or ascii."""

    @property
    def surroundings(self) -> Surroundings:
        """Where the status line takes the clock and the free room from."""

    def apply(self, edited: Edited, label: str) -> bool:
        """Take an edit, or say why it is refused; whether it was taken."""

    def action_undo(self) -> None:
        """Take one edit back."""

    def move(self, place: FormPlace, field: str | None = SEGMENT) -> None:
        """Put the cursor of the MILL CONTOUR form on a segment, and there on a field."""

    def try_out(self, program: Program | None) -> None:
        """Show what a half-typed number would do; None for nothing half-typed."""

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """A sentence on the prompt line of the screen in front."""

    def begin_work(self, on_stop: Callable[[], None]) -> Work:
        """A piece of work begins in a thread; `on_stop` is called where Esc stops it."""

    def end_work(self, work: Work | None) -> None:
        """It is done, or its result is not wanted any more; None is no work."""

    @property
    def guided(self) -> bool:
        """The prompt leads through a first part."""

    def end_guide(self, text: str) -> None:
        """The prompt is the screens' own again; says so where it was not."""

    @property
    def longest_work(self) -> Work | None:
        """What has been going on longest, where that is long enough to be shown."""

    @property
    def stopped(self) -> object:
        """The program, or the block, that is not worked out since Esc has stopped it."""

    posted_for: str
    """The control for which an NC file was posted last, or the center path."""

    def now(self) -> datetime:
        """The time of day, in its zone."""

    settings: Settings
    """What this person has chosen."""

    def keep_settings(self, settings: Settings) -> None:
        """Settings as they are from now on."""

    @property
    def proofs(self) -> Sequence[Screen[None]]:
        """Every NC PROOF that is open."""

    def open_file(self, path: Path, *, kept_copy: bool = False) -> None:
        """Work on a file, or offer the work of a kept copy; what is not saved is asked about."""

    def save_as(self, text: str) -> None:
        """Save the program under a typed name."""

    async def write_made(self, text: str, suffix: str, make: Callable[[Path], str]) -> tuple[str, str] | None:
        """Write what is made of the program under a typed name; asks.  Only in a worker."""

    def close_nc(self, document: NcDocument) -> None:
        """Leave an NC text; changes that are not saved are asked about."""

    def go_to(self, entry: FindingEntry) -> None:
        """MILL CONTOUR with the cursor on the place of a finding."""

    def action_contour(self) -> None:
        """MILL CONTOUR, the form of the block with the cursor."""


class BaseScreen(Screen[None]):
    """A screen in the common frame; `session` follows the App's while the screen is the one in front."""

    focused: Reactive[Widget | None] = Reactive(None, repaint=False)
    """Moving the cursor repaints two fields, not the screen."""

    AUTO_FOCUS: ClassVar[str | None] = ""
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("question_mark", "question_mark", "Help", show=False, priority=True),
        *(Binding(f"f{number},alt+{number}", f"softkey({number})", f"F{number}", show=False) for number in range(1, 9)),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (None,) * 8
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = (("^K", "ALL ACTIONS"), ("?", "KEYS, HELP"))
    """The keys under the softkeys."""

    session: var[Session | None] = var(None, init=False)
    said: var[Sentence | None] = var(None, init=False)
    """A sentence in place of the prompt, until the next accepted key."""

    def __init__(self) -> None:
        super().__init__()
        self._marked: dict[str, Widget | None] = {}
        self._composed = False

    @property
    def host(self) -> Host:
        """The App as far as a screen knows it."""
        return cast(Host, self.app)

    @property
    def current_session(self) -> Session:
        """The session as it is now."""
        return self.host.session

    def compose(self) -> ComposeResult:
        """The frame round the body; the classes of the size come first, or all of it would be styled twice."""
        for points, size in (
            (WIDTHS, self.app.size.width),
            (HEIGHTS, self.app.size.height),
        ):
            self.add_class(max(point for point in points if point[0] <= size)[1], update=False)
        with Horizontal(id="main"):
            with Vertical(id="desk"):
                yield from self.compose_body()
            yield Softkeys(self.SOFTKEYS, self.MORE_KEYS, self.key_acts)
        yield Prompt()
        yield Status(self.host.surroundings)

    @abstractmethod
    def compose_body(self) -> ComposeResult:
        """The widgets of the screen itself."""

    def show_session(self, session: Session) -> None:
        """Show what has changed in the session."""

    @property
    def current_field(self) -> Field | None:
        """What the table of fields says of the field with the cursor; None where that is none."""
        return None

    def take_over(self, _action: str, /) -> bool:
        """Do undo or redo on a document of this screen's own, where it has one; whether it was done."""
        return False

    def palette_actions(self) -> tuple[tuple[str, str, str], ...]:
        """Name, action and hint of what can be done on this screen besides its softkeys, for the palette."""
        return ()

    def action_question_mark(self) -> None:
        """HELP; where a text is being typed the character itself."""
        field, widget = self.current_field, self.focused
        if isinstance(widget, Input) and field is not None and field.kind is Kind.TEXT:
            widget.insert_text_at_cursor("?")
        else:
            self.app.call_later(self.app.run_action, "app.help")

    def help_lines(self) -> tuple[str, ...]:
        """Sentences about this screen, for HELP."""
        return ()

    def prompt_text(self) -> Sentence:
        """What the widget with the cursor takes."""
        return Sentence("")

    def on_mount(self) -> None:
        """Show what the App holds; from then on it tells its screens what has changed.

        A watcher would stay in the App's lists until the next change, and with it each screen that is gone.
        """
        self._composed = True
        self.follow(self.host.session)
        self.draw_with(self.host.characters)

    def draw_with(self, characters: str) -> None:
        """Every widget with signs is made of these characters."""
        for widget in self.query("*").results():
            if isinstance(widget, Drawing | Verdict | FindingsList | SegmentList):
                widget.characters = characters

    def show_signs(self) -> None:
        """Other characters were chosen: show anew what else has signs in it."""

    def on_screen_resume(self) -> None:
        """Catch up with what has changed while another screen was in front."""
        self.follow(self.host.session)
        self.follow_shown(self.host.shown)
        self.show_work(self.host.longest_work)
        if self.stands:
            self.query_one(Status).read_machine()

    @property
    def in_view(self) -> bool:
        """It is in front, or only dialogs stand on it; Textual's `is_current` is true of the next screen below too."""
        stack = self.app.screen_stack
        if not self.stands or self not in stack:
            return False
        return all(isinstance(each, ModalScreen) for each in stack[stack.index(self) + 1 :])

    def follow(self, session: Session) -> None:
        """Show the session, if it is another one than before."""
        if self.in_view and session is not self.session:
            self.session = session
            self.show_session(session)
            self.show_state()
            self.refresh_frame()

    def show_state(self) -> None:
        """The unit, and what is saved and undone, on the status line."""
        self.show_state_on(self.query_one(Status))

    def show_state_on(self, status: Status) -> None:
        """The same on the status line of this screen, or of one that lies on it."""
        status.show_program(self.current_session)

    def show_state_of_below_on(self, status: Status) -> None:
        """On the status line, the state of the screen on which this one lies."""
        stack = self.app.screen_stack
        below = [screen for screen in stack[: stack.index(self)] if isinstance(screen, BaseScreen)]
        if below:
            below[-1].show_state_on(status)

    def follow_shown(self, shown: Session) -> None:
        """Show what half-typed numbers would do, where that is shown at all."""

    def refresh_frame(self) -> None:
        """Prompt and softkeys as they are now; a screen that is still being made shows them once it stands."""
        if not self.stands:
            return
        prompt = self.said or self.too_small() or self.prompt_text()
        if self.host.guided and self.said is None and prompt.tone is not Tone.ERROR:
            prompt = Sentence(f"GUIDE  {self.guide_text()}")
        self.query_one(Prompt).show(prompt)
        self.query_one(Softkeys).refresh_keys()

    def guide_text(self) -> str:
        """The next step of the guided first part on this screen."""
        return NOT_NEEDED

    @property
    def stands(self) -> bool:
        """The screen is made and is not being taken down; `display` is off from the first step of a removal."""
        return self._composed and self.is_attached and self.display

    @property
    def at_rest(self) -> bool:
        """Esc has nothing to take back or to close here."""
        return False

    def show_work(self, work: Work | None) -> None:
        """How far long work is, on the status line; a screen that is being made or taken down has none."""
        if self.stands:
            self.query_one(Status).show_work("" if work is None else work.text)

    def too_small(self) -> Sentence | None:
        """Says that the terminal is smaller than any screen is made for; all keys act all the same."""
        width, height = self.app.size
        if width >= SMALLEST[0] and height >= SMALLEST[1]:
            return None
        return Sentence(f"Window is {width}x{height}; it needs {SMALLEST[0]}x{SMALLEST[1]}.", Tone.WARNING)

    def take(self) -> bool:
        """Take what has been typed into the field with the cursor; False where it is refused, and says why."""
        return True

    def forget_typed(self) -> None:
        """Forget what has been typed and not been taken."""

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """A sentence on the prompt line, until the next accepted key."""
        self.said = Sentence(text, tone)
        if self._composed:
            self.refresh_frame()

    def quiet(self) -> None:
        """The prompt again."""
        if self.said is not None:
            self.said = None
            self.refresh_frame()

    @on(DescendantFocus)
    def _mark_focus(self, event: DescendantFocus) -> None:
        """Mark the label and the panel of the cursor by classes: `:focus-within` would style and repaint far more."""
        row = event.widget.parent
        label = next((each for each in row.children if each.has_class("label")), None) if row is not None else None
        panel = next(
            (each for each in event.widget.ancestors if isinstance(each, Widget) and "panel" in each.classes), None
        )
        self._mark("-at", label)
        self._mark("-here", panel if isinstance(panel, Widget) else None)
        self.refresh_frame()

    def _mark(self, name: str, widget: Widget | None) -> None:
        before = self._marked.get(name)
        if before is widget:
            return
        self._marked[name] = widget
        changed = [each for each in (before, widget) if each is not None]
        for each in changed:
            each.set_class(each is widget, name, update=False)
        # what is in them looks the same as before
        self.app.stylesheet.update_nodes(changed)

    @on(Resize)
    def _fit_frame(self) -> None:
        """The prompt says whether the terminal is too small, and the softkeys have longer or shorter names."""
        self.call_after_refresh(self.refresh_frame)

    async def action_softkey(self, number: int) -> None:
        """Press a softkey."""
        key = self.SOFTKEYS[number - 1]
        if key is None or not self.key_acts(key):
            self.say("" if key is None else key.idle)
            return
        self.quiet()
        await self.run_action(key.action)

    def key_acts(self, key: Softkey) -> bool:
        """Whether a softkey does anything now."""
        target, _, name = key.action.partition("(")[0].rpartition(".")
        owner: Any = self.app if target == "app" else self
        return hasattr(owner, f"action_{name}") and key.acts(self)
