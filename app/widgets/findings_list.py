"""FindingsList lists the findings of a block, each with its title and full sentence; Enter goes to its place."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import ClassVar

from textual.binding import Binding, BindingType
from textual.content import Content
from textual.geometry import Size
from textual.reactive import reactive
from textual.widgets.option_list import Option

from app.session.block_findings import Entry, EntryKind
from app.widgets.rows import OptionRows
from app.widgets.verdict import MARKS_OF_CHARACTERS, Marks

ROLES = {
    EntryKind.GOUGE: "$c-gouge",
    EntryKind.ERROR: "$c-err",
    EntryKind.TO_TYPE: "$c-warn",
    EntryKind.REMEDY: "$c-good",
    EntryKind.UNCUT: "$c-uncut",
    EntryKind.WARNING: "$c-warn",
    EntryKind.NOTE: "$c-label",
}
"""The color of each kind of finding."""
HEADING_WIDTH = 37
"""The width in cells of a heading over the loupe on the narrowest screens."""
MIN_WIDTH = 20
"""The narrowest width in cells to which sentences are wrapped."""


def mark(kind: EntryKind, marks: Marks) -> str:
    """Return the sign of a kind of finding."""
    if kind in (EntryKind.GOUGE, EntryKind.ERROR):
        return marks.gouge
    return "?" if kind is EntryKind.TO_TYPE else "i" if kind in (EntryKind.REMEDY, EntryKind.NOTE) else marks.warning


def heading(entries: Sequence[Entry], at: int, marks: Marks) -> str:
    """Return the selected finding as one line: its sign, which of how many, its title, its segments."""
    entry = entries[at]
    where = entry.where.replace("segment", "seg").replace("corner", "seg")
    titles = (entry.title, entry.title.removesuffix(" thick"))
    lines = [f"{mark(entry.kind, marks)} {at + 1}/{len(entries)} {title}  {where}".rstrip() for title in titles]
    return lines[0] if len(lines[0]) <= HEADING_WIDTH else lines[1]


class FindingsList(OptionRows):
    """The list; the selected finding is highlighted; n and p step through it and wrap around."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("n,N", "screen.finding(1)", "Next finding", show=False),
        Binding("p,P", "screen.finding(-1)", "Finding before", show=False),
    ]

    entries: reactive[tuple[Entry, ...]] = reactive((), repaint=False)
    characters: reactive[str] = reactive("braille", repaint=False)

    def __init__(self, *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(id=id, classes=classes)
        self._room = Size()
        self.border_subtitle = "n next  p before"

    def on_resize(self) -> None:
        """Wrap the sentences again at a new size."""
        if self._room != self.content_region.size:
            self._show()

    def _show(self) -> None:
        """Show the findings; the highlight keeps its index, or goes to the last one if there are fewer."""
        entries, at, self._room = self.entries, self.highlighted, self.content_region.size
        self.border_title = f"FINDINGS  {len(entries)}" if entries else "FINDINGS  none"
        lines = self._wrapped_entries(self._room.width)
        if sum(line.plain.count("\n") + 1 for line in lines) > self._room.height:
            # the scroll bar takes a column
            lines = self._wrapped_entries(self._room.width - self.styles.scrollbar_size_vertical)
        self.clear_options()
        self.add_options([Option(line, id=str(number)) for number, line in enumerate(lines)])
        self.highlighted = None if not entries else min(at or 0, len(entries) - 1)

    watch_entries = watch_characters = _show

    def _wrapped_entries(self, width: int) -> list[Content]:
        return [self._line(number, entry, width) for number, entry in enumerate(self.entries)]

    def _line(self, number: int, entry: Entry, width: int) -> Content:
        """Return the title and the segment, then what the sentence says besides its title."""
        sign = mark(entry.kind, MARKS_OF_CHARACTERS[self.characters])
        where = "" if entry.where in entry.title else f"  {entry.where}"
        head = _wrapped(f"{sign} {number + 1} {entry.title}{where}", width)
        more = entry.text.removeprefix(entry.title).lstrip(".,; ")
        title = Content.styled(head, f"bold {ROLES[entry.kind]}")
        if not more:
            return title
        return Content.assemble(title, "\n", Content.styled(_wrapped(f"    {more}", width), "$c-label"))


def _wrapped(text: str, width: int) -> str:
    """Return a text wrapped to the list's width, with all lines but the first indented; as it is while hidden."""
    return fill(text, max(width, MIN_WIDTH), subsequent_indent=" " * 4) if width > 0 else text
