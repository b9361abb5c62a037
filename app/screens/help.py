"""HELP explains the field with the cursor, the words and signs, and every key."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import ClassVar, Final

from textual import events, on
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, VerticalScroll
from textual.content import Content
from textual.widgets import Static

from app.screens.base import NO_LIST_KEYS, BaseScreen
from app.screens.topics import topic_of
from app.widgets.plain import PlainLabel, PlainText
from app.widgets.softkeys import Softkey
from core.program.fields import Field, range_of
from core.units import Kind, Unit

TEXT_OF_KIND: Final = {
    Kind.LENGTH: "A number, a fraction (1 1/2), a sum (2.5-.125, 25.4/2), or another unit (12.7mm, .5in).",
    Kind.FEED: "A number in program units a minute, or another unit (500mm, 20in).",
    Kind.ANGLE: "Degrees, counterclockwise from +X.",
    Kind.COUNT: "A whole number.",
    Kind.PERCENT: "A percentage.",
}
"""What a field of each kind takes."""
EXPLAINED_WORDS: Final[tuple[tuple[str, str], ...]] = (
    ("GOUGE", "the cutter takes material that belongs to the part: shaded, ! at the deepest place"),
    ("UNCUT", "material that stays on the wall because the cutter does not reach it: thick wall, shaded"),
    ("DELETED", "segments that the look-ahead leaves out: dotted, x where their neighbors meet"),
    ("CAL", "calculated, follows every edit"),
    ("SAME", "blank: the coordinate that the segment starts with"),
    ("INC", "typed with I: from the start of the segment"),
    ("TOOL", "blank: the tool's value in TOOL SETUP"),
    ("USR", "a look-ahead that was typed"),
    ("DEF", "blank: the usual value is in force"),
    ("ERR", "cannot be read; nothing is posted while it stands"),
    ("S > o", "START, direction of travel, plunge point"),
    ("*", "after the file's name: not saved"),
)
"""Words and signs on the screens, with their meanings."""
EXPLAINED_KEYS: Final[tuple[tuple[str, str], ...]] = (
    ("Enter", "take the field and go on"),
    ("Tab, up, down", "from field to field"),
    ("Space", "the list of this field: tools, choices, look-ahead values"),
    ("left, right", "edit the text; step a choice; on SEGMENT walk over the segments"),
    ("=", "on a length or an angle: the calculator, whose answer goes into the field"),
    ("Esc", "one step back: the old number, out of a panel, a dialog, a screen"),
    ("Del, Backspace", "empty the field; Enter makes it blank"),
    ("Page Up, Page Down", "segment before, next segment"),
    ("Ctrl+Home, Ctrl+End", "START, the last segment"),
    ("F1 to F8", "the softkeys; also Esc, then the digit within 2 seconds"),
    ("F9 or Ctrl+T", "the list of segments"),
    ("F10 or Ctrl+F", "the list of findings; again: taller"),
    ("Ctrl+N, Ctrl+P", "next finding, finding before"),
    ("Ctrl+K", "every action by its name; a digit is a softkey"),
    ("Ctrl+Z, Ctrl+Y", "undo, redo"),
    ("Ctrl+S, Ctrl+O", "save, open"),
    ("Ctrl+Q", "quit"),
    ("Ctrl+L", "redraw the screen"),
    ("? or Ctrl+G", "this help (Ctrl+G in the middle of a text)"),
)
"""Every key that is the same on all screens."""
NAME_WIDTH: Final = 22
"""Width in cells of the column with the names of words and keys."""


class HelpScreen(BaseScreen):
    """Help for the field with the cursor and its screen, then words, signs and keys."""

    AUTO_FOCUS: ClassVar[str | None] = "#help-text"
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,enter,question_mark,ctrl+g", "app.back", "Back", show=False),
        Binding("space", "page_down", "Next page", show=False),
    ]
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = (*(None,) * 7, Softkey("BACK", "app.back", "BACK"))
    MORE_KEYS: ClassVar[tuple[tuple[str, str], ...]] = NO_LIST_KEYS
    PROMPT: ClassVar[str] = "Up, down and Space read on. Enter or Esc goes back."
    SHOWS_STATE_OF_BELOW: ClassVar[bool] = True

    def __init__(self, field: Field | None = None, lines: Sequence[str] = ()) -> None:
        super().__init__()
        self._field, self._lines = field, tuple(lines)

    def compose_body(self) -> ComposeResult:
        """Lay out the title and the scrolling text."""
        with Horizontal(classes="head"):
            yield PlainLabel("HELP", classes="head-title")
        with VerticalScroll(id="help-text"):
            yield PlainText(id="help-lines")

    @on(events.Resize)
    def _fill(self) -> None:
        """Wrap the text to the width of the screen."""
        self.call_after_refresh(self._show)

    def _show(self) -> None:
        lines = self.query_one("#help-lines", Static)
        lines.update(self._text(max(lines.size.width, 2 * NAME_WIDTH)))

    def _text(self, width: int) -> Content:
        about = [*self._lines]
        if self._field is not None:
            about = [*field_help(self._field, self.host.session.program.unit), *about]
        head = [Content.styled(line, "bold" if number == 0 else "") for number, line in enumerate(about)]
        return Content("\n").join(
            [*head, Content(""), *_table(EXPLAINED_WORDS, width), Content(""), *_table(EXPLAINED_KEYS, width)]
        )

    def action_page_down(self) -> None:
        """Scroll to the next page."""
        self.query_one("#help-text", VerticalScroll).scroll_page_down(animate=False)


def _table(rows: Sequence[tuple[str, str]], width: int) -> list[Content]:
    """Return names with their meanings, each meaning wrapped with a hanging indent."""
    indent = " " * NAME_WIDTH
    texts = [fill(text, width, initial_indent=indent, subsequent_indent=indent).lstrip() for _, text in rows]
    names = [f" {name:<{NAME_WIDTH - 1}}" for name, _ in rows]
    return [Content.assemble((name, "bold"), (text, "$c-label")) for name, text in zip(names, texts, strict=True)]


def field_help(field: Field, unit: Unit) -> tuple[str, ...]:
    """Return what a field means and takes, in sentences, then its picture."""
    lines = [field.label, field.prompt]
    topic = topic_of(field)
    if topic is not None:
        lines.append(topic.words)
    if field.choices:
        lines.append(f"Choices: {', '.join(field.choices)}. Space lists, left and right step; letters spell one.")
    elif field.kind in TEXT_OF_KIND:
        lines.append(TEXT_OF_KIND[field.kind])
    if taken := range_of(field, unit):
        lines.append(f"{taken[0].upper()}{taken[1:]}.")
    return (*lines, *(topic.picture if topic is not None else ()))
