"""EntryPage: a page on which one line of text is typed, such as a file's name."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from app.painted.messages import Close, Message
from app.painted.screens.page import Answer, Page, unseen
from app.painted.session import Session
from app.painted.widgets.field import Editing, press, window
from app.painted.widgets.form import typed_spans
from app.painted.widgets.rows import Look, Row, Span


@dataclass(frozen=True, eq=False, slots=True)
class EntryPage(Page):
    """`entry` is the text as it stands; `fresh` while nothing was typed: the first character then replaces it."""

    entry: Editing = field(default_factory=lambda: Editing("", 0))
    fresh: bool = True

    def typed(self, key: str, character: str | None) -> Answer | None:
        """A key of editing; a question mark in the first place asks for help."""
        if self.fresh and character == "?":
            return None
        entry = press(None if self.fresh else self.entry, self.entry.text, key, character)
        return None if entry is None else Answer(replace(self, entry=entry, fresh=False))

    def accepted(self, messages: tuple[Message, ...]) -> Answer:
        """The text taken; one that is refused stands there as a field's value does: the first character replaces it."""
        return Answer(replace(self, fresh=True), messages)

    @property
    def replaced(self) -> bool:
        """Whether the first character typed replaces a text that can be seen."""
        return self.fresh and self.entry.text != ""

    def escape(self, session: Session) -> Answer | None:
        """Nothing is done."""
        return Answer(self, (Close(),))

    def everywhere(self, key: str, session: Session) -> Answer | None:
        """The program behind is not to change unseen."""
        return unseen(self, key)


def entry_row(label: str, entry: Editing, width: int, *, fresh: bool) -> Row:
    """A label and the text with its caret."""
    room = max(width - len(label) - 3, 8)
    if fresh:
        text, _ = window(entry, room)
        return (Span(f" {label} ", Look.HEAD), Span(f"{text:<{room}}"[:room], Look.CURSOR))
    return (Span(f" {label} ", Look.HEAD), *typed_spans(entry, room, right=False))
