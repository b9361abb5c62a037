"""Edits of a contour program as plain values that JSON keeps exactly, and the way back from them.

A typed number is a number, a text that could not be read is `[text, reason]`, a blank is null.  Values are read back as
strictly as a program file.  Parts that two programs share are recognized by identity, so that one field typed into a
thousand segments costs no more than a look at each.
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
"""Edits with which a journal begins that follows a save: it is written between two keys."""


class DamagedError(Exception):
    """Values that are no part of a document."""


Item = TypeVar("Item")
Word = TypeVar("Word", bound=StrEnum)
EMPTY: Final[Mapping[str, Segment]] = MappingProxyType({form_of(kind()).value: kind() for kind in get_args(Segment)})
"""The kinds of segments with nothing typed."""
EMPTY_BLOCK: Final = Block()
EMPTY_TOOL: Final = Tool(1)
_KINDS: Final = MappingProxyType({type(empty): kind for kind, empty in EMPTY.items()})


# ---- records


def whole_records(history: History) -> Iterator[Record]:
    """A history, of a long one its last edits; the first record holds the program before them."""
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
    """What led from one history to the next, empty for no edit; None where the one does not lead to the other."""
    common = _common_steps(old.past, new.past)
    records: list[Record] = [{"undo": 1} for _ in old.past[common:]]
    now = old
    for _ in old.past[common:]:
        now = now.undo()
    programs = (*(step.program for step in new.past[common:]), new.program)
    for step, (before, after) in zip(new.past[common:], pairwise(programs), strict=True):
        again = now.redo()
        if again.program is after and again.past[-1].label == step.label:
            records.append({"redo": 1})
            now = again
        else:
            records.append({"do": step.label, "delta": delta(before, after)})
            now = History(after, (*now.past, step))
    return records if now == new else None


def _common_steps(old: tuple[UndoStep, ...], new: tuple[UndoStep, ...]) -> int:
    """How many steps both begin with; nearly always all of the shorter one."""
    shorter = min(len(old), len(new))
    if old[:shorter] == new[:shorter]:
        return shorter
    return next(index for index in range(shorter) if old[index] != new[index])


@dataclass(slots=True)
class ContourReplay:
    """The edits of a journal made again; lists, since histories are copied at each step."""

    program: Program
    past: list[UndoStep] = field(default_factory=list)
    future: list[UndoStep] = field(default_factory=list)

    @classmethod
    def begun(cls, base: object) -> ContourReplay:
        """Before the first edit; DamagedError for what is no program."""
        return cls(applied(Program(), base))

    def do(self, label: str, values: object) -> None:
        """One edit; DamagedError leaves everything as it was."""
        after = applied(self.program, values)
        self.past.append(UndoStep(self.program, text_of(label)))
        self.future.clear()
        self.program = after

    def undo(self) -> None:
        """One edit taken back."""
        self._step(self.past, self.future)

    def redo(self) -> None:
        """One undone edit made again."""
        self._step(self.future, self.past)

    def _step(self, source: list[UndoStep], target: list[UndoStep]) -> None:
        if not source:
            raise DamagedError
        step = source.pop()
        target.append(UndoStep(self.program, step.label))
        self.program = step.program

    def work(self) -> History:
        """The history that the edits led to."""
        return History(self.program, tuple(self.past), tuple(self.future))


# ---- programs


def delta(old: Program, new: Program) -> dict[str, Any]:
    """What makes `new` of `old`, as values for JSON."""
    changes: dict[str, Any] = {} if old.unit is new.unit else {"unit": str(new.unit)}
    for part in ("parameters", "setup"):
        before, after = getattr(old, part), getattr(new, part)
        if before is not after:
            changes[part] = difference(before, after)
    if old.tools is not new.tools:
        changes["tools"] = _spliced(old.tools, new.tools, partial(difference, EMPTY_TOOL))
    return changes if old.blocks is new.blocks else changes | _blocks(old.blocks, new.blocks)


def _blocks(old: tuple[Block, ...], new: tuple[Block, ...]) -> dict[str, Any]:
    """One block changed in itself, or blocks taken out and put in."""
    middle = splice(old, new)
    if len(middle.old) == len(middle.new) == 1:
        before, after = middle.old[0], middle.new[0]
        segments = _spliced(before.segments, after.segments, packed_segment)
        return {"block": [middle.at, difference(before, after), segments]}
    return {"blocks": _spliced(old, new, packed_block)}


def _spliced(old: tuple[Item, ...], new: tuple[Item, ...], pack: Callable[[Item], Any]) -> list[Any]:
    middle = splice(old, new)
    return [middle.at, len(middle.old), [pack(item) for item in middle.new]]


def applied(program: Program, values: object) -> Program:
    """The program with a delta put in; DamagedError for anything that is none or does not fit."""
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
            tools = _put(program.tools, value, partial(altered, EMPTY_TOOL))
            if len({tool.number for tool in tools}) < len(tools):
                raise DamagedError
            return replace(program, tools=tools)
        case "blocks", _:
            return replace(program, blocks=_put(program.blocks, value, block_of))
        case "block", [int(at), dict(typed), list(segments)] if 0 <= at < len(program.blocks):
            block = altered(program.blocks[at], typed)
            block = changed(block, {"segments": _put(block.segments, segments, segment_of)})
            return replace(program, blocks=(*program.blocks[:at], block, *program.blocks[at + 1 :]))
        case _:
            raise DamagedError


def _put(old: tuple[Item, ...], value: object, unpack: Callable[[object], Item]) -> tuple[Item, ...]:
    match value:
        case [int(at), int(gone), list(new)] if 0 <= at <= at + gone <= len(old):
            return (*old[:at], *map(unpack, new), *old[at + gone :])
        case _:
            raise DamagedError


# ---- blocks, segments


def packed_block(block: Block) -> list[Any]:
    """The fields of START, and the segments."""
    return [difference(EMPTY_BLOCK, block), [packed_segment(segment) for segment in block.segments]]


def block_of(values: object) -> Block:
    """The block of `packed_block`."""
    match values:
        case [dict(typed), list(segments)]:
            return changed(altered(EMPTY_BLOCK, typed), {"segments": tuple(map(segment_of, segments))})
        case _:
            raise DamagedError


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
            raise DamagedError


# ---- fields


def difference(old: Part, new: Part) -> dict[str, Any]:
    """The fields of `new` that are not as in `old`, but for the segments of a block."""
    names = [name for name in _READERS[type(new)] if getattr(new, name) != getattr(old, name)]
    return {name: packed(getattr(new, name)) for name in names}


RELATIVE: Final = "inc"
"""The key of a number that was typed relative."""


def packed(value: Typed | str | int) -> float | list[str] | str | dict[str, float] | None:
    """One field's value."""
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
    """The part with `difference`'s fields put in; DamagedError for anything that is none."""
    readers = _READERS[type(part)]
    if not isinstance(values, dict) or not values.keys() <= readers.keys():
        raise DamagedError
    return changed(part, {name: readers[name](value) for name, value in values.items()})


def _reader(hint: object) -> Callable[[object], Any]:
    """What reads a field declared like this: a word, a word or nothing, a truth value, a text, else what was typed."""
    words = [kind for kind in (hint, *get_args(hint)) if isinstance(kind, type) and issubclass(kind, StrEnum)]
    if words:
        return partial(_word_of if hint is words[0] else _word_or_none, words[0])
    if hint is bool:
        return _truth
    if hint is str:
        return text_of
    # a new kind of field without a reader must not make journals that nobody can read
    assert hint == Typed, hint
    return _typed


def _word_or_none(words: type[StrEnum], value: object) -> StrEnum | None:
    return None if value is None else _word_of(words, value)


def _truth(value: object) -> bool:
    if isinstance(value, bool):
        return value
    raise DamagedError


def _word_of(words: type[Word], value: object) -> Word:
    """One of an Enum's words."""
    matched = next((word for word in words if word == value), None)
    if matched is None:
        raise DamagedError
    return matched


def text_of(value: object) -> str:
    """A text on one line without control characters."""
    if isinstance(value, str) and value.isprintable():
        return value
    raise DamagedError


def _as_typed(text: str) -> str:
    """A text that a file can hold."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise DamagedError from error
    return text


def whole_of(value: object) -> int:
    """A whole number that is no truth value."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise DamagedError


def _tool_number(value: object) -> int:
    number = whole_of(value)
    if not 1 <= number <= MAX_TOOL_NUMBER:
        raise DamagedError
    return number


def _choice(value: object) -> int | None:
    if value is None or (type(value) is int and 0 <= value <= MAX_CHOICE):
        return value
    raise DamagedError


def _lookahead(value: object) -> Typed:
    """As in a program file: the form never holds a number out of its range."""
    typed, lookahead = _typed(value), field_of(Form.START, "lookahead")
    if isinstance(typed, Number) and value_refusal(lookahead, typed.value, Unit.IN):
        raise DamagedError
    return typed


def _typed(value: object) -> Typed:
    match value:
        case None:
            return None
        case [str(text), str(reason)]:
            return Unread(_as_typed(text), text_of(reason))
        case int() | float() if not isinstance(value, bool) and abs(value) <= LARGEST and isfinite(value):
            return Number(float(value))
        case {"inc": int() | float() as number, **rest} if not rest:
            return _relative(_typed(number))
        case _:
            raise DamagedError


def _relative(typed: Typed) -> Relative:
    if isinstance(typed, Number):
        return Relative(typed.value)
    raise DamagedError


_FIELD_READERS: Final[Mapping[str, Callable[[object], Any]]] = MappingProxyType(
    {"number": _tool_number, "choice": _choice, "lookahead": _lookahead}
)
"""Fields that take less than their type."""


def _readers(kind: type) -> Mapping[str, Callable[[object], Any]]:
    hints = get_type_hints(kind)
    return {name: _FIELD_READERS.get(name) or _reader(hints[name]) for name in hints if name != "segments"}


_READERS: Final[Mapping[type, Mapping[str, Callable[[object], Any]]]] = MappingProxyType(
    {kind: _readers(kind) for kind in (Block, Tool, ProgramParameters, PartSetup, *_KINDS)}
)
"""What reads each field of a part, by the type that the part declares for it."""
