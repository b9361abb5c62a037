"""The prompt: two lines that say what the field takes, or what is wrong."""

from __future__ import annotations

from functools import lru_cache
from re import compile
from textwrap import TextWrapper, wrap
from typing import Final

from app.painted.session import Said, Tone
from app.painted.widgets.rows import Look, Row, Span, shortened

LINES: Final = 2
LONG: Final = 32
"""Cells of a whole path where there is no room for all of it."""
_MARKS: Final = {Tone.PLAIN: "", Tone.WARNING: "! ", Tone.ERROR: "!! "}
_LOOKS: Final = {Tone.PLAIN: Look.PLAIN, Tone.WARNING: Look.WARNING, Tone.ERROR: Look.ERROR}


@lru_cache(64)
def prompt_rows(said: Said, width: int, height: int = LINES) -> tuple[Row, ...]:
    """The sentence on its lines, marked by !! and a color when it is an error.

    Of what is longer, whole paths are parted between lines, then lose their middle: the reason stands behind them.
    The rest is an ellipsis.
    """
    lines = _lines(said, width)
    if len(lines) > height > 0:
        parted, short = Parting(max(width - 2, 1)).wrap(_text(said)), _lines(said, width, LONG)
        lines = parted if len(parted) <= height else short
    if len(lines) > height > 0:
        lines = [*lines[: height - 1], f"{lines[height - 1][: max(width - 3, 0)]}…"]
    rows = [(Span(f" {line}", _LOOKS[said.tone]),) for line in lines]
    return (*rows, *[()] * (height - len(rows)))


def needed(said: Said, width: int) -> int:
    """Lines that the whole sentence takes."""
    return len(_lines(said, width))


def _lines(said: Said, width: int, longest: int | None = None) -> list[str]:
    text = _text(said)
    if longest is not None:
        text = " ".join(shortened(word, longest) if "/" in word else word for word in text.split(" "))
    return wrap(text, max(width - 2, 1), break_on_hyphens=False) or [""]


def _text(said: Said) -> str:
    return _MARKS[said.tone] + "".join(character if character.isprintable() else "?" for character in said.text)


class Parting(TextWrapper):
    """Parts lines at blanks and behind the strokes of a path."""

    wordsep_simple_re = compile(r"( +)|(?<=/)")

    def __init__(self, width: int) -> None:
        super().__init__(width, break_on_hyphens=False)
