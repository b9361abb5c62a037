"""The parts of a program as plain values that JSON holds exactly, for the journal.

A typed number is a number, a text that could not be read is `[text, reason]`, a blank is null.  Unlike a program
file this keeps every part as it is, in memory's own words; it is read back as strictly.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from enum import StrEnum
from math import isfinite
from types import MappingProxyType
from typing import Any, Final, TypeVar

from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    CutterComp,
    Direction,
    Entry,
    LineSegment,
    Part,
    PathChoice,
    Segment,
    Tool,
    Typed,
    Unread,
    changed,
)
from core.tolerance import LARGEST


class Damaged(Exception):
    """Values that are no part of a program."""


Word = TypeVar("Word", bound=StrEnum)
EMPTY: Final[Mapping[str, Segment]] = MappingProxyType(
    {"LINE": LineSegment(), "ARC": ArcSegment(), "BLEND ARC": BlendSegment()}
)
"""The kinds of segments with nothing typed."""
EMPTY_BLOCK: Final = Block()
EMPTY_TOOL: Final = Tool(1)
_KINDS: Final = MappingProxyType({type(empty): kind for kind, empty in EMPTY.items()})


def packed(value: Typed | str | int) -> float | list[str] | str | None:
    """One field's value."""
    match value:
        case Entry(number):
            return number
        case Unread(text, reason):
            return [text, reason]
        case _:
            return value


def difference(old: Part, new: Part) -> dict[str, Any]:
    """The fields of `new` that are not as in `old`, but for the segments of a block."""
    names = [name for name in _names(type(new)) if getattr(new, name) != getattr(old, name)]
    return {name: packed(getattr(new, name)) for name in names}


def altered(part: Part, values: object) -> Part:
    """The part with `difference`'s fields put in; Damaged for anything that is none."""
    names = _names(type(part))
    if not isinstance(values, dict) or not all(name in names for name in values):
        raise Damaged
    return changed(part, {name: _READ.get(name, _typed)(value) for name, value in values.items()})


def _names(kind: type) -> tuple[str, ...]:
    return tuple(one.name for one in fields(kind) if one.name != "segments")


def packed_segment(segment: Segment) -> list[Any]:
    """Kind and what was typed."""
    kind = _KINDS[type(segment)]
    return [kind, difference(EMPTY[kind], segment)]


def segment_of(values: object) -> Segment:
    """The segment of `packed_segment`."""
    match values:
        case [str(kind), dict(typed)] if kind in EMPTY:
            return altered(EMPTY[kind], typed)
        case _:
            raise Damaged


def packed_block(block: Block) -> list[Any]:
    """The fields of START, and the segments."""
    return [difference(EMPTY_BLOCK, block), [packed_segment(segment) for segment in block.segments]]


def block_of(values: object) -> Block:
    """The block of `packed_block`."""
    match values:
        case [dict(typed), list(segments)]:
            return changed(altered(EMPTY_BLOCK, typed), {"segments": tuple(map(segment_of, segments))})
        case _:
            raise Damaged


def packed_tool(tool: Tool) -> dict[str, Any]:
    """A line of the tool table."""
    return difference(EMPTY_TOOL, tool)


def tool_of(values: object) -> Tool:
    """The tool of `packed_tool`."""
    return altered(EMPTY_TOOL, values)


def text_of(value: object) -> str:
    """A text on one line without control characters."""
    if isinstance(value, str) and value.isprintable():
        return value
    raise Damaged


def whole_of(value: object) -> int:
    """A whole number that is no truth value."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise Damaged


def word_of(words: type[Word], value: object) -> Word:
    """One of an Enum's words."""
    found = next((word for word in words if word == value), None)
    if found is None:
        raise Damaged
    return found


def _typed(value: object) -> Typed:
    match value:
        case None:
            return None
        case [str(text), str(reason)]:
            return Unread(text, reason)
        case int() | float() if not isinstance(value, bool) and isfinite(value) and abs(value) <= LARGEST:
            return Entry(float(value))
        case _:
            raise Damaged


_READ: Final[Mapping[str, Callable[[object], Any]]] = MappingProxyType(
    {
        "number": whole_of,
        "type": text_of,
        "name": text_of,
        "choice": lambda value: None if value is None else whole_of(value),
        "cutter_comp": lambda value: word_of(CutterComp, value),
        "direction": lambda value: word_of(Direction, value),
        "path": lambda value: word_of(PathChoice, value),
    }
)
"""The fields that hold no typed number."""
