"""The journal of a program: every accepted edit as one line, so that a crash loses no more than a half-typed field.

A line holds what an edit changed, as plain values that JSON keeps exactly: a typed number is a number, a text that
could not be read is `[text, reason]`, a blank is null.  It is read back as strictly as a program file.  Parts that two
programs share are recognized by identity, so that one field typed into a thousand segments costs no more than a look
at each.  The first line holds the program the work began with.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from enum import StrEnum
from itertools import pairwise
from math import isfinite
from types import MappingProxyType
from typing import Any, Final, TypeVar

from app.documents.files import Stamp
from app.documents.journal_file import Record, whole_lines
from app.documents.lock import Owner, owner_of
from core.program.edit import FormPlace
from core.program.history import History, UndoStep, splice
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    ChamferSegment,
    Coolant,
    CutterComp,
    Direction,
    LineSegment,
    Number,
    Part,
    PathChoice,
    Program,
    Relative,
    Segment,
    Tool,
    Typed,
    Unread,
    changed,
)
from core.tolerance import LARGEST
from core.units import Unit

FORMAT: Final = 1
"""The format of journals that is read and written."""

RELATIVE: Final = "inc"
"""The key of a number that was typed relative."""


class Damaged(Exception):
    """Values that are no part of a program."""


One = TypeVar("One")
Word = TypeVar("Word", bound=StrEnum)
EMPTY: Final[Mapping[str, Segment]] = MappingProxyType(
    {"LINE": LineSegment(), "ARC": ArcSegment(), "BLEND ARC": BlendSegment(), "CHAMFER": ChamferSegment()}
)
"""The kinds of segments with nothing typed."""
EMPTY_BLOCK: Final = Block()
EMPTY_TOOL: Final = Tool(1)
_KINDS: Final = MappingProxyType({type(empty): kind for kind, empty in EMPTY.items()})


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
    return tuple(field.name for field in fields(kind) if field.name != "segments")


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
    matched = next((word for word in words if word == value), None)
    if matched is None:
        raise Damaged
    return matched


def _typed(value: object) -> Typed:
    match value:
        case None:
            return None
        case [str(text), str(reason)]:
            return Unread(text, reason)
        case int() | float() if not isinstance(value, bool) and isfinite(value) and abs(value) <= LARGEST:
            return Number(float(value))
        case {"inc": number, **rest} if not rest:
            relative = _typed(number)
            if isinstance(relative, Number):
                return Relative(relative.value)
            raise Damaged
        case _:
            raise Damaged


def truth_of(value: object) -> bool:
    """A truth value."""
    if isinstance(value, bool):
        return value
    raise Damaged


_READ: Final[Mapping[str, Callable[[object], Any]]] = MappingProxyType(
    {
        "number": whole_of,
        "type": text_of,
        "name": text_of,
        "choice": lambda value: None if value is None else whole_of(value),
        "tangent": truth_of,
        "cutter_comp": lambda value: word_of(CutterComp, value),
        "direction": lambda value: word_of(Direction, value),
        "path": lambda value: word_of(PathChoice, value),
        "coolant": lambda value: None if value is None else word_of(Coolant, value),
    }
)
"""The fields that hold no typed number."""


def delta(old: Program, new: Program) -> dict[str, Any]:
    """What makes `new` of `old`, as values for JSON."""
    changes: dict[str, Any] = {} if old.unit is new.unit else {"unit": str(new.unit)}
    if old.parameters is not new.parameters:
        changes["parameters"] = difference(old.parameters, new.parameters)
    if old.setup is not new.setup:
        changes["setup"] = difference(old.setup, new.setup)
    if old.tools is not new.tools:
        changes["tools"] = _spliced(old.tools, new.tools, packed_tool)
    return changes if old.blocks is new.blocks else changes | _blocks(old.blocks, new.blocks)


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
    return [middle.at, len(middle.old), [pack(item) for item in middle.new]]


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


@dataclass(frozen=True, slots=True)
class Head:
    """Whose work it is, on which file (None without a name), and what that file was when it was read."""

    owner: Owner
    file: str | None = None
    stamp: Stamp | None = None


@dataclass(frozen=True, slots=True)
class Cursor:
    """Where the operator was: place, name of the field, and the time in ISO format."""

    where: FormPlace
    field: str
    time: str


@dataclass(frozen=True, slots=True)
class Recovered:
    """What a journal holds: `length` bytes of it could be read, `damaged` says that more than a torn end was not.

    `total` is the sum at the end of what could be read; further lines go on from it.
    """

    head: Head
    history: History
    cursor: Cursor
    length: int
    total: int
    damaged: bool


def head_record(head: Head, program: Program, cursor: Cursor) -> Record:
    """The first line: the work begins with this program."""
    return {"journal": FORMAT, **_head(head), "base": delta(Program(), program), **_cursor(cursor)}


def moved_record(head: Head, cursor: Cursor) -> Record:
    """The work goes on in other hands, or on another file, or the file was saved."""
    return {**_head(head), **_cursor(cursor)}


def edit_records(old: History, new: History, cursor: Cursor) -> tuple[Record, ...] | None:
    """What led from one history to the next, none for no edit; None where the one does not lead to the other."""
    records: list[Record] = []
    common = _common(old.past, new.past)
    now = old
    for _ in range(len(old.past) - common):
        records.append({"undo": 1, **_cursor(cursor)})
        now = now.undo()
    programs = (*(step.program for step in new.past[common:]), new.program)
    for step, (before, after) in zip(new.past[common:], pairwise(programs), strict=True):
        again = now.redo()
        if again.program is after and again.past[-1].label == step.label:
            records.append({"redo": 1, **_cursor(cursor)})
            now = again
        else:
            records.append({"do": step.label, "delta": delta(before, after), **_cursor(cursor)})
            now = History(after, (*now.past, step))
    return tuple(records) if now == new else None


def history_records(head: Head, history: History, cursor: Cursor) -> Iterator[Record]:
    """A whole history from its first program on, as a journal that begins."""
    programs = (*(step.program for step in history.past), history.program)
    undone = history.future[::-1]
    labels = (*(step.label for step in history.past), *(step.label for step in undone))
    yield head_record(head, programs[0], cursor)
    for label, (before, after) in zip(labels, pairwise((*programs, *(step.program for step in undone))), strict=True):
        yield {"do": label, "delta": delta(before, after), **_cursor(cursor)}
    for _ in undone:
        yield {"undo": 1, **_cursor(cursor)}


def recovered(data: bytes) -> Recovered | None:
    """What a journal holds; None where not even its first line can be read."""
    replay, length, total = _Replay(), 0, 0
    for line, after, following in whole_lines(data):
        try:
            replay.take(json.loads(line))
        except (Damaged, ValueError, RecursionError):
            break
        length, total = after, following
    if replay.head is None or replay.cursor is None:
        return None
    history = History(replay.program, tuple(replay.past), tuple(replay.future))
    return Recovered(replay.head, history, replay.cursor, length, total, b"\n" in data[length:])


@dataclass(slots=True)
class _Replay:
    """A journal read so far; lists, since histories are copied at each step."""

    program: Program = field(default_factory=Program)
    past: list[UndoStep] = field(default_factory=list)
    future: list[UndoStep] = field(default_factory=list)
    head: Head | None = None
    cursor: Cursor | None = None

    def take(self, record: object) -> None:
        """One line; Damaged or ValueError leave everything as it was."""
        if not isinstance(record, dict) or (self.head is None) is not (record.get("journal") == FORMAT):
            raise Damaged
        cursor = _read_cursor(record)
        match record:
            case {"base": base}:
                self.head, self.program = _read_head(record), applied(Program(), base)
            case {"owner": _}:
                self.head = _read_head(record)
            case {"do": str(label), "delta": values}:
                self._do(label, applied(self.program, values))
            case {"undo": 1} if self.past:
                self._step(self.past, self.future)
            case {"redo": 1} if self.future:
                self._step(self.future, self.past)
            case _:
                raise Damaged
        self.cursor = cursor

    def _do(self, label: str, program: Program) -> None:
        self.past.append(UndoStep(self.program, label))
        self.future.clear()
        self.program = program

    def _step(self, source: list[UndoStep], target: list[UndoStep]) -> None:
        step = source.pop()
        target.append(UndoStep(self.program, step.label))
        self.program = step.program


def _common(old: tuple[UndoStep, ...], new: tuple[UndoStep, ...]) -> int:
    """How many steps both begin with; nearly always all of the shorter one."""
    shorter = min(len(old), len(new))
    if old[:shorter] == new[:shorter]:
        return shorter
    return next(index for index in range(shorter) if old[index] != new[index])


def _head(head: Head) -> Record:
    stamp = None if head.stamp is None else [head.stamp.size, head.stamp.changed, head.stamp.digest]
    return {"owner": asdict(head.owner), "file": head.file, "stamp": stamp}


def _cursor(cursor: Cursor) -> Record:
    return {"at": [cursor.where.block, cursor.where.segment, cursor.field], "time": cursor.time}


def _read_head(record: Record) -> Head:
    head = Head(owner_of(record["owner"]))
    match record:
        case {"file": None | str() as file, "stamp": None}:
            return replace(head, file=file)
        case {"file": None | str() as file, "stamp": [size, changed, str(digest)]}:
            return replace(head, file=file, stamp=Stamp(whole_of(size), whole_of(changed), digest))
        case _:
            raise Damaged


def _read_cursor(record: Record) -> Cursor:
    match record:
        case {"at": [block, segment, name], "time": time}:
            return Cursor(FormPlace(whole_of(block), whole_of(segment)), text_of(name), text_of(time))
        case _:
            raise Damaged
