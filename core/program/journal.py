"""The journal: every accepted edit as one line, so that a program that dies loses no more than a half-typed field.

A line is a sum over itself and everything before it, a blank, and a JSON object.  A line that was torn by a power
cut, or that is not what was written, ends what can be read.  The first line holds the program the work began with.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from typing import Any, Final
from zlib import crc32

from core.program.coding import Damaged, text_of, whole_of
from core.program.delta import applied, delta
from core.program.edit import Where
from core.program.file.stamp import Stamp
from core.program.history import History, Step
from core.program.lock import Owner, owner_of
from core.program.model import Program

FORMAT: Final = 1
"""The format of journals that is read and written."""

Record = Mapping[str, Any]
"""One line of the journal."""


@dataclass(frozen=True, slots=True)
class Head:
    """Whose work it is, on which file (None without a name), and what that file was when it was read."""

    owner: Owner
    file: str | None = None
    stamp: Stamp | None = None


@dataclass(frozen=True, slots=True)
class Cursor:
    """Where the operator was: place, name of the field, and the time in ISO format."""

    where: Where
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


def lines(records: Iterable[Record], total: int = 0) -> tuple[bytes, int]:
    """The records as lines that go on from the sum `total`, and the sum at their end."""
    written = []
    for record in records:
        data = json.dumps(record, separators=(",", ":"), allow_nan=False).encode()
        total = crc32(data, total)
        written.append(b"%08x %s\n" % (total, data))
    return b"".join(written), total


def whole_lines(data: bytes) -> Iterator[tuple[bytes, int, int]]:
    """The JSON of each line up to the first that is not what was written, with the length and the sum up to its end."""
    length, total = 0, 0
    for line in data.splitlines(keepends=True):
        total = crc32(line[9:-1], total)
        if not line.endswith(b"\n") or line[:9] != b"%08x " % total:
            return
        length += len(line)
        yield line[9:], length, total


def recovered(data: bytes) -> Recovered | None:
    """What a journal holds; None where not even its first line can be read."""
    replay, length, total = _Replay(), 0, 0
    for line, behind, following in whole_lines(data):
        try:
            replay.take(json.loads(line))
        except (Damaged, ValueError, RecursionError):
            break
        length, total = behind, following
    if replay.head is None or replay.cursor is None:
        return None
    history = History(replay.program, tuple(replay.past), tuple(replay.future))
    return Recovered(replay.head, history, replay.cursor, length, total, b"\n" in data[length:])


@dataclass(slots=True)
class _Replay:
    """A journal read so far; lists, since histories are copied at each step."""

    program: Program = field(default_factory=Program)
    past: list[Step] = field(default_factory=list)
    future: list[Step] = field(default_factory=list)
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
        self.past.append(Step(self.program, label))
        self.future.clear()
        self.program = program

    def _step(self, source: list[Step], target: list[Step]) -> None:
        step = source.pop()
        target.append(Step(self.program, step.label))
        self.program = step.program


def _common(old: tuple[Step, ...], new: tuple[Step, ...]) -> int:
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
            return Cursor(Where(whole_of(block), whole_of(segment)), text_of(name), text_of(time))
        case _:
            raise Damaged
