"""This module journals every accepted edit as one line, so that a crash loses no more than a half-typed field.

The first line says whose work it is, on which file, and what it began with; each later one holds an edit, an undo or a
redo, with the time and the operator's place.  Both kinds of document have the same lines; only the content of an edit
differs.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Final

from app.documents import contour_journal, nc_journal
from app.documents.files import Stamp
from app.documents.journal_file import DamagedError, Record, valid_lines
from app.documents.lock import Owner, owner_of
from app.documents.nc_text import NcText
from core.program.file.read import StoreError
from core.program.history import History, UndoStep
from core.program.model import Program

JOURNAL_FORMAT: Final = 3
MAX_JOURNAL_BYTES: Final = 200_000_000
"""The size in bytes of the largest journal that is read: room for the largest NC text and edits as long as it."""
MAX_UNDO_EDITS: Final = 500
"""The most undo steps that a new journal begins with, since it is written between two keystrokes."""
_DIGEST: Final = re.compile(r"[0-9a-f]{16}")
_DAMAGE: Final = (DamagedError, StoreError, ValueError, RecursionError, OverflowError)
"""The errors that reading a damaged line raises."""

Work = History | NcText
"""What a document's edits have made, with all that can be undone and redone."""
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
    work: Work
    place: Place
    time: str
    damaged: bool = False

    @property
    def edits(self) -> int:
        """The number of edits that can be undone."""
        return len(self.work.past)


# ---- writing


def beginning(kind: Kind, head: Head, work: Work, place: Place, time: str) -> Iterator[Record]:
    """Yield the records of a new journal: what the last edits of this work began with, and these edits."""
    first = work
    for _ in work.past[-MAX_UNDO_EDITS:]:
        first = first.undo()
    stamp = None if head.stamp is None else [head.stamp.size, head.stamp.changed, head.stamp.digest]
    whose = {"owner": asdict(head.owner), "file": head.file, "stamp": stamp}
    yield {"journal": JOURNAL_FORMAT, "kind": kind, **whose, "base": _base(first), "at": place, "time": time}
    yield from continuing([*_redone(first), *({"undo": 1} for _ in work.future)], place, time)


def _redone(work: Work) -> Iterator[Record]:
    """Yield the records of all edits that can be redone."""
    while work.future:
        before, work = work, work.redo()
        yield _edit(before, work)


def continuing(records: Iterable[Record], place: Place, time: str) -> Iterator[Record]:
    """Return the records of further edits."""
    return ({**record, "at": place, "time": time} for record in records)


def records_between(old: Work, new: Work) -> list[Record] | None:
    """Return the edit, undo or redo that leads from `old` to `new`, nothing if they are equal; None if one does not."""
    if _same(old, new):
        return []
    if _same(old.undo(), new):
        return [{"undo": 1}]
    if _same(old.redo(), new):
        return [{"redo": 1}]
    edited = new.past and not new.future and _same_up_to_here(new.undo(), old)
    return [_edit(old, new)] if edited else None


def _same(first: Work, second: Work) -> bool:
    """True if the content, and all that can be undone and redone, are the same."""
    return _same_up_to_here(first, second) and first.future == second.future


def _same_up_to_here(first: Work, second: Work) -> bool:
    """True if the content and all that can be undone are the same."""
    return first.past == second.past and _content(first) == _content(second)


def _content(work: Work) -> object:
    return work.program if isinstance(work, History) else work.lines


def _base(work: Work) -> object:
    return contour_journal.delta(Program(), work.program) if isinstance(work, History) else nc_journal.packed(work)


def _edit(before: Work, after: Work) -> Record:
    """Return the record of the last edit of `after`."""
    if isinstance(before, History) and isinstance(after, History):
        return {"do": after.undo_label, "delta": contour_journal.delta(before.program, after.program)}
    assert isinstance(after, NcText)
    return {"do": "", "delta": nc_journal.delta(after.past[-1])}


def same_edits(old: Work, new: Work) -> bool:
    """True if nothing was edited, undone or redone between the two."""
    return old.past is new.past and old.future is new.future


# ---- reading


def read_journal(data: bytes) -> Journal | None:
    """Return what a journal holds; None if not even its first line can be read."""
    journal: Journal | None = None
    length = 0
    for line, after, _ in valid_lines(data):
        try:
            record = json.loads(line)
            if not isinstance(record, dict):
                break
            journal = _begun(record) if journal is None else _continued(journal, record)
        except _DAMAGE:
            break
        length = after
    return None if journal is None else replace(journal, damaged=b"\n" in data[length:])


def owner_in_another_version(data: bytes) -> Owner | None:
    """Return who began a journal in the format of another version of this program; None for any other journal."""
    line = next((line for line, _, _ in valid_lines(data[: data.find(b"\n") + 1])), b"null")
    try:
        match json.loads(line):
            case {"owner": owner, **rest} if rest.get("journal") != JOURNAL_FORMAT:
                return owner_of(owner)
            case _:
                return None
    except _DAMAGE:
        return None


def _begun(record: Record) -> Journal:
    """Return what the first line holds."""
    work: Work
    match record:
        case {"journal": 3, "kind": Kind.CONTOUR.value, "base": base}:
            work = History(contour_journal.applied(Program(), base))
        case {"journal": 3, "kind": Kind.NC.value, "base": base}:
            work = nc_journal.unpacked(base)
        case _:
            raise DamagedError
    return Journal(Kind(record["kind"]), _head_of(record), work, _place_of(record), _text_of(record.get("time")))


def _continued(journal: Journal, record: Record) -> Journal:
    """Return what a journal holds up to another line."""
    head, work = journal.head, journal.work
    match record:
        case {"owner": _}:
            head = _head_of(record)
        case {"do": str(label), "delta": values}:
            work = _done(work, label, values)
        case {"undo": 1} if work.past:
            work = work.undo()
        case {"redo": 1} if work.future:
            work = work.redo()
        case _:
            raise DamagedError
    place, time = _place_of(record), _text_of(record.get("time"))
    return replace(journal, head=head, work=work, place=place, time=time)


def _done(work: Work, label: str, values: object) -> Work:
    if isinstance(work, NcText):
        return nc_journal.applied(work, values)
    # not `work.do`: every edit counts, since undo records count them
    past = (*work.past, UndoStep(work.program, _text_of(label)))
    return History(contour_journal.applied(work.program, values), past)


def _head_of(record: Record) -> Head:
    match record:
        case {"owner": owner, "file": None | str() as file, "stamp": None}:
            return Head(owner_of(owner), _path_of(file))
        case {"owner": owner, "file": None | str() as file, "stamp": [size, time, str(digest)]}:
            if not _DIGEST.fullmatch(digest):
                raise DamagedError
            return Head(owner_of(owner), _path_of(file), Stamp(_integer_of(size), _integer_of(time), digest))
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
            return (block, segment, _text_of(name))
        case _:
            raise DamagedError


def _text_of(value: object) -> str:
    """Return a text of one line without control characters; raise DamagedError for any other value."""
    if isinstance(value, str) and value.isprintable():
        return value
    raise DamagedError


def _integer_of(value: object) -> int:
    """Return an integer that is not a bool; raise DamagedError for any other value."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise DamagedError
