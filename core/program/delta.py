"""The difference of two programs as plain values, small for the edits of a form, and applied again.

Parts that two programs share are told by identity, so that one field typed into a thousand segments costs no more
than a look at each of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, Final, Generic, TypeVar

from core.program.coding import (
    Damaged,
    altered,
    block_of,
    difference,
    packed_block,
    packed_segment,
    packed_tool,
    segment_of,
    tool_of,
    word_of,
)
from core.program.model import Block, Program, changed
from core.units import Unit

One = TypeVar("One")


@dataclass(frozen=True, slots=True)
class Splice(Generic[One]):
    """What of one tuple is replaced by what of another, from index `at` (0 is the first)."""

    at: int
    old: tuple[One, ...]
    new: tuple[One, ...]


def splice(old: tuple[One, ...], new: tuple[One, ...]) -> Splice[One]:
    """The shortest middle in which two tuples differ."""
    shorter = min(len(old), len(new))
    front = next((index for index in range(shorter) if not same(old[index], new[index])), shorter)
    most = shorter - front
    back = next((step for step in range(most) if not same(old[-1 - step], new[-1 - step])), most)
    return Splice(front, old[front : len(old) - back], new[front : len(new) - back])


def same(one: object, other: object) -> bool:
    """Whether two parts are equal, at once where they are the same object."""
    return one is other or one == other


def delta(old: Program, new: Program) -> dict[str, Any]:
    """What makes `new` of `old`, as values for JSON."""
    found: dict[str, Any] = {} if old.unit is new.unit else {"unit": str(new.unit)}
    if old.parameters is not new.parameters:
        found["parameters"] = difference(old.parameters, new.parameters)
    if old.setup is not new.setup:
        found["setup"] = difference(old.setup, new.setup)
    if old.tools is not new.tools:
        found["tools"] = _spliced(old.tools, new.tools, packed_tool)
    return found if old.blocks is new.blocks else found | _blocks(old.blocks, new.blocks)


def _blocks(old: tuple[Block, ...], new: tuple[Block, ...]) -> dict[str, Any]:
    """One block changed in itself, or blocks taken out and put in."""
    middle = splice(old, new)
    if len(middle.old) == len(middle.new) == 1:
        before, after = middle.old[0], middle.new[0]
        segments = _spliced(before.segments, after.segments, packed_segment)
        return {"block": [middle.at, difference(before, after), segments]}
    return {"blocks": _spliced(old, new, packed_block)}


def _spliced(old: tuple[One, ...], new: tuple[One, ...], pack: Callable[[One], Any]) -> list[Any]:
    middle = splice(old, new)
    return [middle.at, len(middle.old), [pack(one) for one in middle.new]]


def applied(program: Program, values: object) -> Program:
    """The program with a delta put in; Damaged for anything that is none or does not fit."""
    if not isinstance(values, dict) or not values.keys() <= _PARTS.keys():
        raise Damaged
    for name, value in values.items():
        program = _PARTS[name](program, value)
    return program


def _block_put(program: Program, value: object) -> Program:
    match value:
        case [int(at), dict(typed), list(segments)] if 0 <= at < len(program.blocks):
            block = altered(program.blocks[at], typed)
            block = changed(block, {"segments": _put(block.segments, segments, segment_of)})
            return replace(program, blocks=(*program.blocks[:at], block, *program.blocks[at + 1 :]))
        case _:
            raise Damaged


def _put(old: tuple[One, ...], value: object, unpack: Callable[[object], One]) -> tuple[One, ...]:
    match value:
        case [int(at), int(gone), list(new)] if 0 <= at <= at + gone <= len(old):
            return (*old[:at], *map(unpack, new), *old[at + gone :])
        case _:
            raise Damaged


_PARTS: Final[Mapping[str, Callable[[Program, Any], Program]]] = MappingProxyType(
    {
        "unit": lambda program, value: replace(program, unit=word_of(Unit, value)),
        "parameters": lambda program, value: replace(program, parameters=altered(program.parameters, value)),
        "setup": lambda program, value: replace(program, setup=altered(program.setup, value)),
        "tools": lambda program, value: replace(program, tools=_put(program.tools, value, tool_of)),
        "blocks": lambda program, value: replace(program, blocks=_put(program.blocks, value, block_of)),
        "block": _block_put,
    }
)
