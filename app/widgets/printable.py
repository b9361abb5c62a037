"""What a file holds is shown, and never a command to the terminal: characters that cannot be printed are left out."""

from __future__ import annotations

from typing import Final

from rich.segment import Segment
from textual.color import Color
from textual.filter import LineFilter


class PrintableFilter(LineFilter):
    """Leaves out what a terminal would take for a command; such characters have no width in the line anyway."""

    def apply(self, segments: list[Segment], _background: Color) -> list[Segment]:
        """Only characters that can be printed; the same list where it has no others."""
        if all(segment.text.isprintable() for segment in segments):
            return segments
        return [Segment(_printable(segment), segment.style, segment.control) for segment in segments]


def _printable(segment: Segment) -> str:
    """The text of as many cells."""
    text = "".join(character for character in segment.text if character.isprintable())
    return text.ljust(len(text) + segment.cell_length - Segment(text).cell_length, "?")


PRINTABLE: Final = PrintableFilter()
