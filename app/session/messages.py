"""Messages pass data between widgets, workers and the App; they hold no callables and no screens."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

from textual.message import Message

if TYPE_CHECKING:
    from core.advice.lookahead_table import Row, Table
    from core.pipeline.derived import Derived, DerivedBlock


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
class ProgramDerived(Message):
    """A worker has derived a program, or None if stopped; `trial` if it came from a half-typed number."""

    derived: Derived | None
    trial: bool


@dataclass
class RowsKnown(Message):
    """A worker has judged some values of a block's look-ahead table; `rows` are all that are known so far."""

    block: DerivedBlock
    rows: tuple[Row, ...]


@dataclass
class TableMade(Message):
    """A worker has made a block's look-ahead table, or added notes (`advised`); `block` is None if it was stopped."""

    block: DerivedBlock | None
    table: Table | None
    advised: bool = False
