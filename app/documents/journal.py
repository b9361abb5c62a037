"""This module journals every accepted edit as one line, so that a crash loses no more than a half-typed field.

The first line says whose work it is, on which file, and what it began with; each later one holds an edit, an undo or a
redo, with the time and the operator's place.  Both kinds of document have the same lines; only the content of an edit
differs.  Journals of format 1 are read, too; there each kind had its own format.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Final

from app.documents.contour_journal import ContourReplay, DamagedError, text_of, whole_of
from app.documents.files import Stamp
from app.documents.journal_file import Record, whole_lines
from app.documents.lock import Owner, owner_of
from app.documents.nc_journal import NcReplay
from app.documents.nc_text import NcText
from core.program.history import History

FORMAT: Final = 2
MAX_JOURNAL_BYTES: Final = 200_000_000
"""The size in bytes of the largest journal that is read: room for the largest NC text and edits as long as it."""
_DIGEST: Final = re.compile(r"(?:[0-9a-f]{8}){1,2}")
_DAMAGE: Final = (DamagedError, ValueError, RecursionError, OverflowError)
"""The errors that reading a damaged line raises."""

Place = tuple[int | str, ...]
"""The operator's place in a document, in the form that its kind has; empty if unknown."""


class Kind(StrEnum):
    """The two kinds of document."""

    CONTOUR = "contour program"
    NC = "NC text"


@dataclass(frozen=True, slots=True)
class Head:
    """Whose work it is, on which file (None without a name), and the stamp of that file when it was read."""

    owner: Owner
    file: str | None = None
    stamp: Stamp | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Journal:
    """The content of a journal; `time` is that of the last edit, in ISO format.

    `damaged`: more than a torn last line could not be read.
    """

    kind: Kind
    head: Head
    work: History | NcText
    place: Place
    time: str
    damaged: bool = False

    @property
    def edits(self) -> int:
        """The number of edits that can be undone."""
        return len(self.work.past)


def beginning(kind: Kind, head: Head, work: Iterable[Record], place: Place, time: str) -> Iterator[Record]:
    """Yield the records of a new journal that begins with all of this work."""
    at: Record = {"at": place, "time": time}
    stamp = None if head.stamp is None else [head.stamp.size, head.stamp.changed, head.stamp.digest]
    whose = {"owner": asdict(head.owner), "file": head.file, "stamp": stamp}
    records = iter(work)
    yield {"journal": FORMAT, "kind": kind, **whose, **next(records), **at}
    for record in records:
        yield {**record, **at}


def continuing(records: Iterable[Record], place: Place, time: str) -> Iterator[Record]:
    """Return the records of further edits."""
    return ({**record, "at": place, "time": time} for record in records)


def read_journal(data: bytes) -> Journal | None:
    """Return what a journal holds; None if not even its first line can be read."""
    reading, length = _Reading(), 0
    for line, after, _ in whole_lines(data):
        try:
            reading.take(json.loads(line))
        except _DAMAGE:
            break
        length = after
    return reading.journal(damaged=b"\n" in data[length:])


@dataclass(slots=True)
class _Reading:
    """The part of a journal that has been read so far."""

    kind: Kind = Kind.CONTOUR
    head: Head | None = None
    replay: ContourReplay | NcReplay | None = None
    place: Place = ()
    time: str = ""
    old_nc: bool = field(default=False)

    def journal(self, *, damaged: bool) -> Journal | None:
        """Return what was read, None if nothing was."""
        if self.head is None or self.replay is None:
            return None
        return Journal(self.kind, self.head, self.replay.work(), self.place, self.time, damaged)

    def take(self, record: object) -> None:
        """Apply one line; an error of `_DAMAGE` leaves everything unchanged."""
        if not isinstance(record, dict):
            raise DamagedError
        if self.replay is None:
            self._begin(record)
            return
        if self.old_nc:
            record = _edit_of_format_1(record)
        place, time = _place_of(record), text_of(record.get("time"))
        match record:
            case {"owner": _}:
                self.head = _head_of(record)
            case {"do": str(label), "delta": values}:
                self.replay.do(label, values)
            case {"undo": 1}:
                self.replay.undo()
            case {"redo": 1}:
                self.replay.redo()
            case _:
                raise DamagedError
        self.place, self.time = place, time

    def _begin(self, record: Record) -> None:
        match record:
            case {"journal": 2, "kind": str(name), "base": base} if name in tuple(Kind):
                kind = Kind(name)
            case {"journal": 1, "base": base}:
                kind = Kind.CONTOUR
            case {"nc": 1, "encoding": encoding, "text": text}:
                kind, base = Kind.NC, [encoding, text]
                record, self.old_nc = _head_of_format_1(record), True
            case _:
                raise DamagedError
        head, place, time = _head_of(record), _place_of(record), text_of(record.get("time"))
        replay = ContourReplay.begun(base) if kind is Kind.CONTOUR else NcReplay.begun(base)
        self.kind, self.head, self.replay, self.place, self.time = kind, head, replay, place, time


def _head_of(record: Record) -> Head:
    match record:
        case {"owner": owner, "file": None | str() as file, "stamp": None}:
            return Head(owner_of(owner), _path_of(file))
        case {"owner": owner, "file": None | str() as file, "stamp": [size, time, str(digest)]}:
            if not _DIGEST.fullmatch(digest):
                raise DamagedError
            return Head(owner_of(owner), _path_of(file), Stamp(whole_of(size), whole_of(time), digest))
        case _:
            raise DamagedError


def _path_of(file: str | None) -> str | None:
    """Return the path; raise DamagedError if no file can have it."""
    if file is not None and (not Path(file).name or b"\0" in os.fsencode(file)):
        raise DamagedError
    return file


def _place_of(record: Record) -> Place:
    match record.get("at", []):
        case [] | [int()]:
            return tuple(record.get("at", ()))
        case [int(block), int(segment), str(name)]:
            return (block, segment, text_of(name))
        case _:
            raise DamagedError


def _head_of_format_1(record: Record) -> Record:
    """Convert the head of an NC text's journal of format 1, which holds the file's checksum but not its name."""
    match record.get("file"):
        case [int(size), int(total)] if 0 <= total < 2**32:
            return {**record, "file": None, "stamp": [size, 0, f"{total:08x}"]}
        case _:
            raise DamagedError


def _edit_of_format_1(record: Record) -> Record:
    match record:
        case {"row": row, "out": removed, "in": inserted}:
            return {"do": "", "delta": [row, removed, inserted], "time": record.get("time")}
        case _:
            return record
