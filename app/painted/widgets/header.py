"""The two lines at the top: which block, which segment, which file."""

from __future__ import annotations

from typing import Final

from app.painted.session import Session
from app.painted.widgets.rows import Look, Row, Span, padded, shortened, text_of

LEAST: Final = 10
"""Cells in which a shortened name can still be told from others."""
LONGEST: Final = 24
"""Cells of a name, however wide the terminal is."""
LOOKING: Final = "LOOK ONLY"
"""Before the name of a program that somebody else has open."""


def header(first: str, second: Row, session: Session, width: int, about: str = "") -> tuple[Row, Row]:
    """Two header lines; the file's name stands at the right of the second, with * while it is not saved, or behind
    the words that it can only be looked at.

    What stands at the left comes first: on a terminal of a few cells the name is shortened, or left out.
    `about` is the file's name where the screen is about another file than the session's program.
    """
    name, left = short(printable(about)) or file_name(session), width - len(text_of(second)) - 2
    if len(name) > left:
        name = shortened(name, left) if left >= LEAST else ""
    room = max(width - len(name) - 2, 1)
    look = Look.WARNING if session.guard.looking and not about else Look.DIM
    return (
        (Span(f" {first}", Look.HEAD),),
        (*padded(second, room), Span(f" {name}", look)) if name else padded(second, width),
    )


def file_name(session: Session) -> str:
    """The program's name as the screens print it, shortened to a reasonable length."""
    unnamed = f"example {session.title}" if session.title else "new program"
    name = unnamed if session.file is None else printable(session.file.stem)
    if session.guard.looking:
        # nothing that is half typed will change it: no * while a number is tried out
        return f"{LOOKING} {short(name, LONGEST - 1 - len(LOOKING))}"
    return f"{short(name)}{'*' if session.unsaved else ''}"


def short(name: str, room: int = LONGEST) -> str:
    """A file's name in so many cells: of a long one beginning and end, which tell a copy from what it is of."""
    return shortened(name, room)


def printable(text: str) -> str:
    """Text from outside with every control character made visible as a question mark."""
    return "".join(character if character.isprintable() else "?" for character in text)


def block_line(session: Session) -> str:
    """`BLOCK n  MILL CONTOUR`."""
    return f"BLOCK{session.where.block:>8}   MILL CONTOUR"


def segment_line(number: str, title: str, *, cursor: bool, typing: bool = False) -> Row:
    """`SEGMENT n  START`, with the mark > while the cursor is on it."""
    look = Look.CURSOR if cursor else Look.HEAD
    behind = Span(" ", Look.CARET) if typing else Span(" ")
    return (
        Span(" SEGMENT", Look.HEAD),
        Span(" > " if cursor else "   ", Look.TAG),
        Span(f"{number:>3}", look),
        behind,
        Span(f"  {title}", Look.HEAD),
    )
