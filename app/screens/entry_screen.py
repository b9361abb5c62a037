"""EntryScreen is a screen with one line to type a name in, which Enter acts on; SAVE AS and OPEN A PATH are two."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from textual import on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical, VerticalScroll
from textual.widgets import Input

from app.documents.paths import path_of_text
from app.screens.base import NO_LIST_KEYS, BaseScreen
from app.session.guide import SAVE_NAME
from app.session.messages import Tone
from app.widgets.field import LineInput
from app.widgets.plain import PlainLabel
from app.widgets.softkeys import Softkey


def entry_keys(verb: str, *others: Softkey) -> tuple[Softkey | None, ...]:
    """Return the softkeys of such a screen: what Enter does too, others if there are any, and BACK."""
    rest = (*others, *(None,) * 6)[:6]
    return (Softkey(verb, "enter", verb), *rest, Softkey("BACK", "app.back", "BACK"))


class EntryScreen(BaseScreen):
    """A title, an input line, and below it whatever the subclass adds.

    The name is selected at first, so that typing replaces it.
    """

    AUTO_FOCUS: ClassVar[str | None] = "#entry"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "leave", "Back", show=False),
        Binding("pagedown", "scroll(1)", "Next page", show=False),
        Binding("pageup", "scroll(-1)", "Page before", show=False),
    ]
    TITLE: ClassVar[str] = ""
    LABEL: ClassVar[str] = "FILE"
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = NO_LIST_KEYS

    def __init__(self, text: str = "") -> None:
        super().__init__()
        self._text = text

    def compose_body(self) -> ComposeResult:
        """Lay out the title, the input line and the rest."""
        with Vertical(id="entry-form", classes="panel -bare"):
            with Horizontal(classes="head"):
                yield PlainLabel(self.TITLE, classes="head-title")
                yield from self.compose_head()
            with Horizontal(id="entry-line", classes="field"):
                yield PlainLabel(self.LABEL, classes="label")
                yield LineInput(self._text, id="entry", compact=True)
            yield from self.compose_rest()

    def compose_head(self) -> ComposeResult:
        """Yield widgets next to the title."""
        yield from ()

    def compose_rest(self) -> ComposeResult:
        """Yield widgets below the input line."""
        yield from ()

    @property
    def text(self) -> str:
        """The name as typed, without spaces around it."""
        return self.query_one("#entry", Input).value.strip()

    @abstractmethod
    def entered(self, text: str) -> object:
        """Act on the name."""

    @on(Input.Changed, "#entry")
    def _typing(self) -> None:
        self.clear_notice()

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """Show a sentence on the prompt line; after an error, select the name so that typing replaces it."""
        super().say(text, tone)
        if tone is Tone.ERROR:
            self.query_one("#entry", Input).select_all()

    def action_leave(self) -> None:
        """Go back to the name, then restore it if it was changed, then close the screen."""
        entry = self.query_one("#entry", Input)
        if not entry.has_focus:
            entry.focus()
        elif entry.value != self._text:
            entry.value = self._text
            entry.select_all()
        else:
            self.call_later(self.run_action, "app.back")

    def action_scroll(self, by: int) -> None:
        """Scroll what is below the input line down or up by a page."""
        for text in self.query(VerticalScroll):
            (text.scroll_page_down if by > 0 else text.scroll_page_up)(animate=False)

    @on(Input.Submitted, "#entry")
    def action_enter(self) -> None:
        """Act on the name, or ask for one if it is empty."""
        if not self.text:
            self.say("Type a name.", Tone.ERROR)
            return
        self.clear_notice()
        self.entered(self.text)


class SaveAsScreen(EntryScreen):
    """SAVE AS asks for the file name of the program or NC text."""

    TITLE: ClassVar[str] = "SAVE AS"
    PROMPT: ClassVar[str] = "Name of the program file, Enter saves. Without a folder it goes beside the open program."
    GUIDE: ClassVar[str] = SAVE_NAME
    SHOWS_STATE_OF_BELOW: ClassVar[bool] = True
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = entry_keys("SAVE")

    def entered(self, text: str) -> None:
        """Save under this name."""
        self.host.save_as(text)


class OpenPathScreen(EntryScreen):
    """OPEN A PATH asks for a program, an NC file, a drawing, or a folder."""

    TITLE: ClassVar[str] = "OPEN A PATH"
    PROMPT: ClassVar[str] = "Path of a program (.toml), an NC file, a drawing (.dxf), or a folder. Enter opens it."
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = entry_keys("OPEN")

    def entered(self, text: str) -> None:
        """Open the file, or show the folder."""
        self.host.open_file(path_of_text(text))
