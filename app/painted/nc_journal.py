"""The journal of an NC program being edited: its text, and every change, undo and redo as one line.

The lines are those of the journal of a program file, a sum and a JSON object each.  The first one holds the text as it
was before every change that can be undone, packed.
"""

from __future__ import annotations

import json
import zlib
from base64 import b85decode, b85encode
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from difflib import SequenceMatcher
from typing import Any, Final

from app.documents.journal_file import whole_lines
from app.documents.lock import Owner, owner_of
from app.documents.nc_text import MAX_NC_BYTES, Change, NcText
from core.units import printable

FORMAT: Final = 1
NEVER: Final = Change(-1, (), ())
"""As the change that the file has: it has none of those in the listing."""

MOST: Final = 500
"""Lines up to which differences are told line by line."""

Record = Mapping[str, Any]
"""One line of the journal."""


@dataclass(frozen=True, eq=False, slots=True)
class Found:
    """What a journal holds: whose work, the text with what can be undone, and the time of the last change.

    `file` is what the file was when the journal was begun, as `mark` has it.  `damaged` says that more than a torn end
    could not be read.
    """

    owner: Owner
    file: list[int]
    listing: NcText
    time: str
    damaged: bool


def whole(listing: NcText, owner: Owner, time: str) -> Iterator[Record]:
    """A listing with everything that can be undone and redone, as a journal that begins."""
    first = listing.first
    text = "".join(first.lines).encode(listing.encoding)
    packed = b85encode(zlib.compress(text, 1)).decode()
    head = {"nc": FORMAT, "owner": asdict(owner), "file": mark(listing.origin), "time": time}
    yield {**head, "encoding": listing.encoding, "text": packed}
    for change in (*listing.past, *reversed(listing.future)):
        yield _change(change, time)
    for _ in listing.future:
        yield {"undo": 1, "time": time}


def mark(data: bytes) -> list[int]:
    """What tells one content of a file from another."""
    return [len(data), zlib.crc32(data)]


def steps(old: NcText, new: NcText, time: str) -> list[Record] | None:
    """What led from one listing to the next; None where the one does not lead to the other."""
    common = _common(old.past, new.past)
    found: list[Record] = [{"undo": 1, "time": time} for _ in old.past[common:]]
    now = old
    for _ in old.past[common:]:
        now = now.undone()
    for change in new.past[common:]:
        again = bool(now.future) and now.future[-1] is change
        found.append({"redo": 1, "time": time} if again else _change(change, time))
        now = now.redone() if again else now.done(change)
    return found if now.past == new.past and now.future == new.future else None


def _common(one: tuple[Change, ...], other: tuple[Change, ...]) -> int:
    """How many changes both begin with; nearly always all of the shorter one."""
    shorter = min(len(one), len(other))
    if not shorter or one[shorter - 1] is other[shorter - 1]:
        return shorter
    return next(index for index in range(shorter) if one[index] is not other[index])


def _change(change: Change, time: str) -> Record:
    return {"row": change.row, "out": change.removed, "in": change.inserted, "time": time}


def found_in(data: bytes) -> Found | None:
    """What a journal holds; None where it is none of an NC program."""
    lines = whole_lines(data)
    try:
        line, length, _ = next(lines)
        head = json.loads(line)
        owner, listing, time = _begun(head)
    except (StopIteration, ValueError, KeyError, TypeError, RecursionError, zlib.error):
        return None
    for line, behind, _ in lines:
        try:
            record = json.loads(line)
            listing, time = _replayed(listing, record), str(record["time"])
        except (ValueError, KeyError, TypeError, RecursionError):
            break
        length = behind
    return Found(owner, head["file"], replace(listing, saved=NEVER), time, b"\n" in data[length:])


def _begun(record: Record) -> tuple[Owner, NcText, str]:
    if record["nc"] != FORMAT:
        raise ValueError("another format")
    text = zlib.decompressobj().decompress(b85decode(record["text"]), 2 * MAX_NC_BYTES)
    return owner_of(record["owner"]), NcText.read(text, str(record["encoding"])), str(record["time"])


def _replayed(listing: NcText, record: object) -> NcText:
    match record:
        case {"row": int(row), "out": [*out], "in": [*into]}:
            return listing.done(Change(row, tuple(map(str, out)), tuple(map(str, into))))
        case {"undo": 1} if listing.past:
            return listing.undone()
        case {"redo": 1} if listing.future:
            return listing.redone()
        case _:
            raise ValueError("no change")


def differences(file: NcText, work: NcText) -> tuple[str, ...]:
    """What the work has changed in the file, line by line in words; of very much only where it begins and ends."""
    old, new = ([one.text(row) for row in range(len(one))] for one in (file, work))
    shorter = min(len(old), len(new))
    begin = next((row for row in range(shorter) if old[row] != new[row]), shorter)
    behind = next((row for row in range(shorter - begin) if old[-1 - row] != new[-1 - row]), shorter - begin)
    old, new = old[begin : len(old) - behind], new[begin : len(new) - behind]
    if max(len(old), len(new)) > MOST:
        return (f"Lines {begin + 1} to {begin + len(new)} are others than in the file.",)
    return tuple(_told(old, new, begin + 1))


def _told(old: list[str], new: list[str], first: int) -> Iterator[str]:
    for kind, a, b, c, d in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind == "equal":
            continue
        for row in range(max(b - a, d - c)):
            if a + row >= b:
                yield f"Line {first + c + row} is new: {printable(new[c + row])}"
            elif c + row >= d:
                yield f"Line {first + a + row} of the file is taken out: {printable(old[a + row])}"
            else:
                yield f"Line {first + c + row}: {printable(new[c + row])} (in the file: {printable(old[a + row])})"
