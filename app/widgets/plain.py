"""This module shows text literally: typed text and files may have brackets, which Textual takes for markup.

PrintableFilter drops unprintable characters, so that no text from a file can be a command to the terminal.
"""

from __future__ import annotations

from typing import Final

from rich.segment import Segment
from textual.color import Color
from textual.filter import LineFilter
from textual.visual import VisualType
from textual.widgets import Label, Static


class PlainText(Static):
    """Lines of text as wide as their container."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)


class PlainLabel(Label):
    """A line of text as wide as the text."""

    def __init__(self, content: VisualType = "", *, id: str | None = None, classes: str | None = None) -> None:
        super().__init__(content, id=id, classes=classes, markup=False)


def show_text(line: Static, text: VisualType, *, layout: bool = False) -> None:
    """Show a text; do nothing if it is shown already.  `layout` lets the widget become as wide as the text."""
    if line.content != text:
        line.update(text, layout=layout)


class PrintableFilter(LineFilter):
    """Drops characters that a terminal could take for a command; the line keeps its width in cells."""

    def apply(self, segments: list[Segment], _background: Color) -> list[Segment]:
        """Return the segments with printable characters only; the same list if they have no others."""
        if all(segment.text.isprintable() for segment in segments):
            return segments
        return [Segment(_printable(segment), segment.style, segment.control) for segment in segments]


def _printable(segment: Segment) -> str:
    """Return the printable text, filled with ? to the same number of cells."""
    text = "".join(character for character in segment.text if character.isprintable())
    return text.ljust(len(text) + segment.cell_length - Segment(text).cell_length, "?")


PRINTABLE: Final = PrintableFilter()
