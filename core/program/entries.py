"""What an operator's text is in a field of numbers: a blank, an entry, or text that stays as it was typed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from core.program.fields import Field, check
from core.program.model import Entry, Program, Typed, Unread
from core.units import Unit, Unreadable, parse, printable

AGAIN: Final = "Type it again."


def read(text: str, one: Field, unit: Unit) -> Typed:
    """A blank, an entry, or a text that cannot be read or is a number the field does not take, which is kept."""
    if not text.strip():
        return None
    value = parse(text, one.kind, unit)
    if isinstance(value, Unreadable):
        return Unread(text, value.reason)
    outside = misfit(text, one, unit)
    return Entry(value) if outside is None else Unread(text, outside)


def unread(program: Program) -> Iterator[Unread]:
    """Every text of a program that stands as it was typed, on whatever form."""
    blocks = program.blocks
    segments = (segment for block in blocks for segment in block.segments)
    for part in (program.parameters, program.setup, *program.tools, *blocks, *segments):
        held = (getattr(part, name) for name in part.__match_args__)
        yield from (value for value in held if isinstance(value, Unread))


def misfit(text: str, one: Field, unit: Unit) -> str | None:
    """The sentence about a text that is a number, and none the field takes; None for any other text."""
    value = parse(text, one.kind, unit)
    told = None if isinstance(value, Unreadable) else check(one, value, unit)
    return None if told is None else f"{told.removesuffix('.')}, not {printable(text)}."


def unread_reason(text: str, one: Field, unit: Unit) -> str:
    """Why a text stands as it was typed, found again; what the field would take now waits to be typed again."""
    value = parse(text, one.kind, unit)
    if isinstance(value, Unreadable):
        return value.reason
    return misfit(text, one, unit) or AGAIN
