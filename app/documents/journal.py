"""This module journals every accepted edit as one line, so that a crash loses no more than a half-typed field.

The first line says whose work it is, on which file, and what it began with; each later one holds an edit, an undo or a
redo, with the time and the operator's place.  Both kinds of document have the same lines; only the content of an edit
differs.

What an edit puts into a contour program, a segment or a block, is the text of a program file that holds nothing else,
so that a journal is read as strictly as a file.  Parts that two programs share are recognized by identity, so that one
field typed into a thousand segments costs no more than one comparison for each.
"""

from __future__ import annotations

import json
import os
import re
import zlib
from base64 import b85decode, b85encode
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Final, TypeVar

from app.documents.files import Stamp
from app.documents.journal_file import DamagedError, Record, valid_lines
from app.documents.lock import Owner, owner_of
from app.documents.nc_text import MAX_NC_BYTES, NEVER_SAVED, NcText
from core.program.file.read import StoreError, loads
from core.program.file.write import dumps
from core.program.history import History, Splice, UndoStep, splice
from core.program.model import Program

JOURNAL_FORMAT: Final = 3
MAX_JOURNAL_BYTES: Final = 200_000_000
"""The size in bytes of the largest journal that is read: room for the largest NC text and edits as long as it."""
MAX_UNDO_EDITS: Final = 500
"""The most undo steps that a new journal begins with, since it is written between two keystrokes."""
_DIGEST: Final = re.compile(r"[0-9a-f]{16}")
_DAMAGE: Final = (DamagedError, StoreError, ValueError, RecursionError, OverflowError, zlib.error)
"""The errors that reading a damaged line raises."""

Work = History | NcText
"""What a document's edits have made, with all that can be undone and redone."""
Place = tuple[int | str, ...]
"""The operator's place in a document, in the form that its kind has; empty if unknown."""
Item = TypeVar("Item")


class Kind(StrEnum):
    """The two kinds of document."""

    CONTOUR = "contour program"
    NC = "NC text"


@dataclass(frozen=True, eq=False, slots=True)
class Journal:
    """The content of a journal: whose work it is, on which file (None without a name), and the work itself.

    `stamp` is that of the file when it was read, `time` that of the last edit, in ISO format.  `damaged`: more than a
    torn last line could not be read.
    """

    owner: Owner
    file: str | None
    stamp: Stamp | None
    work: Work
    place: Place
    time: str
    damaged: bool = False

    @property
    def kind(self) -> Kind:
        """The kind of the document."""
        return Kind.CONTOUR if isinstance(self.work, History) else Kind.NC


# ---- writing


def beginning(journal: Journal) -> Iterator[Record]:
    """Yield the records of a new journal: what the last edits of its work began with, and these edits."""
    first = journal.work
    for _ in journal.work.past[-MAX_UNDO_EDITS:]:
        first = first.undo()
    stamp = None if journal.stamp is None else [journal.stamp.size, journal.stamp.changed, journal.stamp.digest]
    whose = {"owner": asdict(journal.owner), "file": journal.file, "stamp": stamp}
    end = {"at": journal.place, "time": journal.time}
    yield {"journal": JOURNAL_FORMAT, "kind": journal.kind, **whose, "base": _base(first), **end}
    edits = []
    while first.future:
        before, first = first, first.redo()
        edits.append(_edit(before, first))
    yield from continuing([*edits, *({"undo": 1} for _ in journal.work.future)], journal.place, journal.time)


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
    """Return a work without its edits as values for JSON."""
    if isinstance(work, History):
        return delta(Program(), work.program)
    data = "".join(work.lines).encode(work.encoding)
    return [work.encoding, b85encode(zlib.compress(data, 1)).decode()]


def _edit(before: Work, after: Work) -> Record:
    """Return the record of the last edit of `after`."""
    if isinstance(before, History) and isinstance(after, History):
        return {"do": after.undo_label, "delta": delta(before.program, after.program)}
    assert isinstance(after, NcText)
    change = after.past[-1]
    return {"do": "", "delta": [change.at, change.old, change.new]}


def delta(old: Program, new: Program) -> Record:
    """Return the changes that turn `old` into `new`: where tools and blocks are replaced, and the text of the new ones.

    Within one block only segments are replaced; the block in the text then holds only the new ones.
    """
    tools, blocks = splice(old.tools, new.tools), splice(old.blocks, new.blocks)
    inserted, within = blocks.new, None
    if len(blocks.old) == len(blocks.new) == 1:
        segments = splice(blocks.old[0].segments, blocks.new[0].segments)
        inserted = (replace(blocks.new[0], segments=segments.new),)
        within = [segments.at, len(segments.old)]
    return {
        "tools": [tools.at, len(tools.old)],
        "blocks": [blocks.at, len(blocks.old)],
        "segments": within,
        "text": dumps(replace(new, tools=tools.new, blocks=inserted)),
    }


# ---- reading


def read_journal(data: bytes) -> Journal | None:
    """Return what a journal holds; None if not even its first line can be read."""
    journal: Journal | None = None
    length = 0
    for line, after in valid_lines(data):
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
    line = next((line for line, _ in valid_lines(data[: data.find(b"\n") + 1])), b"null")
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
            work = History(applied(Program(), base))
        case {"journal": 3, "kind": Kind.NC.value, "base": base}:
            work = _unpacked(base)
        case _:
            raise DamagedError
    match record:
        case {"owner": owner, "file": None | str() as file, "stamp": None | [int(), int(), str()] as values}:
            stamp = None if values is None else Stamp(*values)
            if file is not None and (not Path(file).name or b"\0" in os.fsencode(file)):
                # no file can have this path
                raise DamagedError
            if stamp is not None and not _DIGEST.fullmatch(stamp.digest):
                raise DamagedError
            return Journal(owner_of(owner), file, stamp, work, _place_of(record), _text_of(record.get("time")))
        case _:
            raise DamagedError


def _continued(journal: Journal, record: Record) -> Journal:
    """Return what a journal holds up to another line."""
    work = journal.work
    match record:
        case {"do": str(label), "delta": values}:
            work = _done(work, label, values)
        case {"undo": 1} if work.past:
            work = work.undo()
        case {"redo": 1} if work.future:
            work = work.redo()
        case _:
            raise DamagedError
    return replace(journal, work=work, place=_place_of(record), time=_text_of(record.get("time")))


def _done(work: Work, label: str, values: object) -> Work:
    if isinstance(work, History):
        # not `work.do`: every edit counts, since undo records count them
        past = (*work.past, UndoStep(work.program, _text_of(label)))
        return History(applied(work.program, values), past)
    match values:
        case [int(row), [*removed], [*inserted]]:
            old, new = (tuple(each for each in texts if isinstance(each, str)) for texts in (removed, inserted))
            if len(old) + len(new) == len(removed) + len(inserted) and work.takes("".join((*old, *new))):
                return work.done(Splice(row, old, new))
    raise DamagedError


def applied(program: Program, values: object) -> Program:
    """Return the program after the changes of a `delta`; raise DamagedError or StoreError if they do not fit."""
    match values:
        case {"tools": tools, "blocks": blocks, "segments": segments, "text": str(text)}:
            new = loads(text, "")
        case _:
            raise DamagedError
    if segments is not None:
        match blocks, new.blocks:
            case [int(at), 1], [block] if 0 <= at < len(program.blocks):
                replaced = _replaced(program.blocks[at].segments, segments, block.segments)
                new = replace(new, blocks=(replace(block, segments=replaced),))
            case _:
                raise DamagedError
    table = _replaced(program.tools, tools, new.tools)
    if len({tool.number for tool in table}) < len(table):
        raise DamagedError
    return replace(new, tools=table, blocks=_replaced(program.blocks, blocks, new.blocks))


def _replaced(old: tuple[Item, ...], place: object, new: tuple[Item, ...]) -> tuple[Item, ...]:
    match place:
        case [int(at), int(gone)] if 0 <= at <= at + gone <= len(old):
            return (*old[:at], *new, *old[at + gone :])
        case _:
            raise DamagedError


def _unpacked(values: object) -> NcText:
    """Return an NC text without edits, marked as not saved in any file."""
    match values:
        case [str(encoding), str(data)]:
            unpacking = zlib.decompressobj()
            text = NcText.read(unpacking.decompress(b85decode(data), 2 * MAX_NC_BYTES), encoding)
        case _:
            raise DamagedError
    if text.encoding != encoding or not unpacking.eof:
        raise DamagedError
    return replace(text, origin=b"", saved=NEVER_SAVED)


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
