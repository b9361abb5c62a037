"""Messages between widgets, workers and the App: frozen data, no callables, no screens."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, NamedTuple

from textual.message import Message

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table
    from core.pipeline.derived import Derived, DerivedBlock


class Tone(StrEnum):
    """How a sentence on the prompt line is meant."""

    PLAIN = "plain"
    WARNING = "warning"
    ERROR = "error"


class Sentence(NamedTuple):
    """A sentence on the prompt line."""

    text: str
    tone: Tone = Tone.PLAIN


@dataclass
class ProgramDerived(Message):
    """A worker has derived a program, None where it was stopped; `trial` for that of a half-typed number."""

    derived: Derived | None
    trial: bool


@dataclass
class TableMade(Message):
    """A worker has made the look-ahead table of a block, or added notes to it: `advised`; no block: stopped."""

    block: DerivedBlock | None
    table: Table | None
    advised: bool = False
