"""The prompt: two lines that say what the field takes, or what is wrong."""

from __future__ import annotations

from functools import lru_cache
from textwrap import wrap
from typing import Final

from app.session import Said, Tone
from app.widgets.rows import Look, Row, Span

LINES: Final = 2
_MARKS: Final = {Tone.PLAIN: "", Tone.WARNING: "! ", Tone.ERROR: "!! "}
_LOOKS: Final = {Tone.PLAIN: Look.PLAIN, Tone.WARNING: Look.WARNING, Tone.ERROR: Look.ERROR}


@lru_cache(64)
def prompt_rows(said: Said, width: int) -> tuple[Row, ...]:
    """The sentence on two lines, marked by !! and a colour when it is an error; what is longer ends in an ellipsis."""
    text = "".join(character if character.isprintable() else "?" for character in said.text)
    room = max(width - 2, 1)
    lines = wrap(_MARKS[said.tone] + text, room, break_on_hyphens=False) or [""]
    if len(lines) > LINES:
        lines = [*lines[: LINES - 1], f"{lines[LINES - 1][: room - 1]}…"]
    rows = [(Span(f" {line}", _LOOKS[said.tone]),) for line in lines]
    return (*rows, *[()] * (LINES - len(rows)))
