"""This module turns edits of a contour program into plain values that JSON keeps exactly, and reads them back.

A typed number is a number, a text that could not be read is `[text, reason]`, a blank is null.  Values are read back as
strictly as a program file.  Parts that two programs share are recognized by identity, so that one field typed into a
thousand segments costs no more than one comparison for each.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import partial
from itertools import pairwise
from math import isfinite
from types import MappingProxyType
from typing import Any, Final, TypeVar, get_args, get_type_hints

from app.documents.journal_file import Record
from core.program.fields import MAX_CHOICE, Form, field_of, form_of, value_refusal
from core.program.history import History, UndoStep, splice
from core.program.model import (
    Block,
    Number,
    Part,
    PartSetup,
    Program,
    ProgramParameters,
    Relative,
    Segment,
    Tool,
    Typed,
    Unread,
    changed,
)
from core.tolerance import LARGEST
from core.units import Unit

MAX_TOOL_NUMBER: Final = 9999
MAX_WHOLE_EDITS: Final = 500
"""The most undo steps that a new journal begins with, since it is written between two keystrokes."""


class DamagedError(Exception):
    """The values do not describe a valid document or edit."""


Item = TypeVar("Item")
Word = TypeVar("Word", bound=StrEnum)
EMPTY: Final[Mapping[str, Segment]] = MappingProxyType({form_of(kind()).value: kind() for kind in get_args(Segment)})
"""An empty segment of each kind, by its form's name."""
EMPTY_BLOCK: Final = Block()
EMPTY_TOOL: Final = Tool(1)
_KINDS: Final = MappingProxyType({type(empty): kind for kind, empty in EMPTY.items()})


# ---- records


def whole_records(history: History) -> Iterator[Record]:
    """Yield a history as records, only the last edits of a long one; the first record holds the program before them."""
    history = replace(history, past=history.past[-MAX_WHOLE_EDITS:])
    programs = (*(step.program for step in history.past), history.program)
    undone = history.future[::-1]
    labels = (*(step.label for step in history.past), *(step.label for step in undone))
    yield {"base": delta(Program(), programs[0])}
    for label, (before, after) in zip(labels, pairwise((*programs, *(step.program for step in undone))), strict=True):
        yield {"do": label, "delta": delta(before, after)}
    for _ in undone:
        yield {"undo": 1}


def records_between(old: History, new: History) -> list[Record] | None:
    """Return the edits that lead from `old` to `new`, empty if they are equal; None if `old` does not lead to `new`."""
    common = _common_steps(old.past, new.past)
    records: list[Record] = [{"undo": 1} for _ in old.past[common:]]
    current = old
    for _ in old.past[common:]:
        current = current.undo()
    programs = (*(step.program for step in new.past[common:]), new.program)
    for step, (before, after) in zip(new.past[common:], pairwise(programs), strict=True):
        redone = current.redo()
        if redone.program is after and redone.past[-1].label == step.label:
            records.append({"redo": 1})
            current = redone
        else:
            records.append({"do": step.label, "delta": delta(before, after)})
            current = History(after, (*current.past, step))
    return records if current == new else None


def _common_steps(old: tuple[UndoStep, ...], new: tuple[UndoStep, ...]) -> int:
    """Return how many steps both begin with; nearly always all of the shorter one."""
    shorter = min(len(old), len(new))
    if old[:shorter] == new[:shorter]:
        return shorter
    return next(index for index in range(shorter) if old[index] != new[index])


@dataclass(slots=True)
class ContourReplay:
    """A replay of a journal's edits; it uses lists, since a History is copied at each step."""

    program: Program
    past: list[UndoStep] = field(default_factory=list)
    future: list[UndoStep] = field(default_factory=list)

    @classmethod
    def begun(cls, base: object) -> ContourReplay:
        """Return the replay before the first edit; raise DamagedError if `base` is not a program."""
        return cls(applied(Program(), base))

    def do(self, label: str, values: object) -> None:
        """Apply one edit; DamagedError leaves everything unchanged."""
        after = applied(self.program, values)
        self.past.append(UndoStep(self.program, text_of(label)))
        self.future.clear()
        self.program = after

    def undo(self) -> None:
        """Undo one edit; raise DamagedError if there is none."""
        self._step(self.past, self.future)

    def redo(self) -> None:
        """Redo one undone edit; raise DamagedError if there is none."""
        self._step(self.future, self.past)

    def _step(self, source: list[UndoStep], target: list[UndoStep]) -> None:
        if not source:
            raise DamagedError
        step = source.pop()
        target.append(UndoStep(self.program, step.label))
        self.program = step.program

    def work(self) -> History:
        """Return the history that the edits led to."""
        return History(self.program, tuple(self.past), tuple(self.future))


# ---- programs


def delta(old: Program, new: Program) -> dict[str, Any]:
    """Return the changes that turn `old` into `new`, as values for JSON."""
    changes: dict[str, Any] = {} if old.unit is new.unit else {"unit": str(new.unit)}
    for part in ("parameters", "setup"):
        before, after = getattr(old, part), getattr(new, part)
        if before is not after:
            changes[part] = difference(before, after)
    if old.tools is not new.tools:
        changes["tools"] = _packed_splice(old.tools, new.tools, partial(difference, EMPTY_TOOL))
    return changes if old.blocks is new.blocks else changes | _blocks(old.blocks, new.blocks)


def _blocks(old: tuple[Block, ...], new: tuple[Block, ...]) -> dict[str, Any]:
    """Return the change within one block, or the blocks removed and inserted."""
    middle = splice(old, new)
    if len(middle.old) == len(middle.new) == 1:
        before, after = middle.old[0], middle.new[0]
        segments = _packed_splice(before.segments, after.segments, packed_segment)
        return {"block": [middle.at, difference(before, after), segments]}
    return {"blocks": _packed_splice(old, new, packed_block)}


def _packed_splice(old: tuple[Item, ...], new: tuple[Item, ...], pack: Callable[[Item], Any]) -> list[Any]:
    middle = splice(old, new)
    return [middle.at, len(middle.old), [pack(item) for item in middle.new]]


def applied(program: Program, values: object) -> Program:
    """Return the program with a delta applied; raise DamagedError if the values are no delta or do not fit."""
    if not isinstance(values, dict):
        raise DamagedError
    for name, value in values.items():
        program = _with_part(program, name, value)
    return program


def _with_part(program: Program, name: str, value: object) -> Program:
    match name, value:
        case "unit", _:
            return replace(program, unit=_word_of(Unit, value))
        case (("parameters" | "setup"), _):
            return replace(program, **{name: altered(getattr(program, name), value)})
        case "tools", _:
            tools = _replaced(program.tools, value, partial(altered, EMPTY_TOOL))
            if len({tool.number for tool in tools}) < len(tools):
                raise DamagedError
            return replace(program, tools=tools)
        case "blocks", _:
            return replace(program, blocks=_replaced(program.blocks, value, block_of))
        case "block", [int(at), dict(typed), list(segments)] if 0 <= at < len(program.blocks):
            block = altered(program.blocks[at], typed)
            block = changed(block, {"segments": _replaced(block.segments, segments, segment_of)})
            return replace(program, blocks=(*program.blocks[:at], block, *program.blocks[at + 1 :]))
        case _:
            raise DamagedError


def _replaced(old: tuple[Item, ...], value: object, unpack: Callable[[object], Item]) -> tuple[Item, ...]:
    match value:
        case [int(at), int(gone), list(new)] if 0 <= at <= at + gone <= len(old):
            return (*old[:at], *map(unpack, new), *old[at + gone :])
        case _:
            raise DamagedError


# ---- blocks, segments


def packed_block(block: Block) -> list[Any]:
    """Return the changed fields of START, and the segments, as values for JSON."""
    return [difference(EMPTY_BLOCK, block), [packed_segment(segment) for segment in block.segments]]


def block_of(values: object) -> Block:
    """Return the block that `packed_block` packed."""
    match values:
        case [dict(typed), list(segments)]:
            return changed(altered(EMPTY_BLOCK, typed), {"segments": tuple(map(segment_of, segments))})
        case _:
            raise DamagedError


def packed_segment(segment: Segment) -> list[Any]:
    """Return a segment's kind and typed fields as values for JSON."""
    kind = _KINDS[type(segment)]
    return [kind, difference(EMPTY[kind], segment)]


def segment_of(values: object) -> Segment:
    """Return the segment that `packed_segment` packed."""
    match values:
        case [str(kind), dict(typed)] if kind in EMPTY:
            return altered(EMPTY[kind], typed)
        case _:
            raise DamagedError


# ---- fields


def difference(old: Part, new: Part) -> dict[str, Any]:
    """Return the fields of `new` that differ from `old`, without a block's segments."""
    names = [name for name in _READERS[type(new)] if getattr(new, name) != getattr(old, name)]
    return {name: packed(getattr(new, name)) for name in names}


RELATIVE: Final = "inc"
"""The key of a number that was typed with an I."""


def packed(value: Typed | str | int) -> float | list[str] | str | dict[str, float] | None:
    """Return one field's value as a value for JSON."""
    match value:
        case Number(number):
            return number
        case Relative(number):
            return {RELATIVE: number}
        case Unread(text, reason):
            return [text, reason]
        case _:
            return value


def altered(part: Part, values: object) -> Part:
    """Return the part with the fields of a `difference` replaced; raise DamagedError for any other values."""
    readers = _READERS[type(part)]
    if not isinstance(values, dict) or not values.keys() <= readers.keys():
        raise DamagedError
    return changed(part, {name: readers[name](value) for name, value in values.items()})


def _reader_of(hint: object) -> Callable[[object], Any]:
    """Return the reader for a field of this type: an Enum's word, that or None, a bool, a text, or a typed value."""
    words = [kind for kind in (hint, *get_args(hint)) if isinstance(kind, type) and issubclass(kind, StrEnum)]
    if words:
        return partial(_word_of if hint is words[0] else _word_or_none, words[0])
    if hint is bool:
        return _bool_of
    if hint is str:
        return text_of
    # a new field type without a reader must not produce journals that cannot be read
    assert hint == Typed, hint
    return _typed_of


def _word_or_none(words: type[StrEnum], value: object) -> StrEnum | None:
    return None if value is None else _word_of(words, value)


def _bool_of(value: object) -> bool:
    if isinstance(value, bool):
        return value
    raise DamagedError


def _word_of(words: type[Word], value: object) -> Word:
    """Return the Enum member with this value; raise DamagedError if there is none."""
    matched = next((word for word in words if word == value), None)
    if matched is None:
        raise DamagedError
    return matched


def text_of(value: object) -> str:
    """Return a text of one line without control characters; raise DamagedError for any other value."""
    if isinstance(value, str) and value.isprintable():
        return value
    raise DamagedError


def _encodable(text: str) -> str:
    """Return a text that UTF-8 can encode; raise DamagedError for any other."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise DamagedError from error
    return text


def whole_of(value: object) -> int:
    """Return an integer that is not a bool; raise DamagedError for any other value."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise DamagedError


def _tool_number_of(value: object) -> int:
    number = whole_of(value)
    if not 1 <= number <= MAX_TOOL_NUMBER:
        raise DamagedError
    return number


def _choice_of(value: object) -> int | None:
    if value is None or (type(value) is int and 0 <= value <= MAX_CHOICE):
        return value
    raise DamagedError


def _lookahead_of(value: object) -> Typed:
    """Return a look-ahead, checked as in a program file: the form never holds a number out of range."""
    typed, lookahead = _typed_of(value), field_of(Form.START, "lookahead")
    if isinstance(typed, Number) and value_refusal(lookahead, typed.value, Unit.IN):
        raise DamagedError
    return typed


def _typed_of(value: object) -> Typed:
    match value:
        case None:
            return None
        case [str(text), str(reason)]:
            return Unread(_encodable(text), text_of(reason))
        case int() | float() if not isinstance(value, bool) and abs(value) <= LARGEST and isfinite(value):
            return Number(float(value))
        case {"inc": int() | float() as number, **rest} if not rest:
            return _relative_of(_typed_of(number))
        case _:
            raise DamagedError


def _relative_of(typed: Typed) -> Relative:
    if isinstance(typed, Number):
        return Relative(typed.value)
    raise DamagedError


_FIELD_READERS: Final[Mapping[str, Callable[[object], Any]]] = MappingProxyType(
    {"number": _tool_number_of, "choice": _choice_of, "lookahead": _lookahead_of}
)
"""The readers of fields that are limited more than their type."""


def _readers_of(kind: type) -> Mapping[str, Callable[[object], Any]]:
    hints = get_type_hints(kind)
    return {name: _FIELD_READERS.get(name) or _reader_of(hints[name]) for name in hints if name != "segments"}


_READERS: Final[Mapping[type, Mapping[str, Callable[[object], Any]]]] = MappingProxyType(
    {kind: _readers_of(kind) for kind in (Block, Tool, ProgramParameters, PartSetup, *_KINDS)}
)
"""The reader of each field of each part, chosen by the field's declared type."""
