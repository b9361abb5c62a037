"""Messages pass data between widgets, workers and the App; they hold no callables and no screens."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

from textual.message import Message

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row
    from core.pipeline.derived import DerivedBlock


class Tone(StrEnum):
    """The tone of a sentence on the prompt line."""

    PLAIN = "plain"
    WARNING = "warning"
    ERROR = "error"


class Sentence(NamedTuple):
    """A sentence on the prompt line."""

    text: str
    tone: Tone = Tone.PLAIN


@dataclass
class TableRowsJudged(Message):
    """A worker has judged some values of a block's look-ahead table; `rows` are all that are known so far."""

    block: DerivedBlock
    rows: tuple[Row, ...]
