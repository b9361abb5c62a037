"""This module turns edits of an NC text into plain values for JSON and back, and describes how two texts differ."""

from __future__ import annotations

import zlib
from base64 import b85decode, b85encode
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from difflib import SequenceMatcher
from typing import Final

from app.documents.contour_journal import DamagedError
from app.documents.journal_file import Record
from app.documents.nc_text import MAX_NC_BYTES, Change, NcText
from core.units import printable

NEVER_SAVED: Final = Change(-1, (), ())
"""The `saved` change of a text none of whose states any file holds."""
MAX_COMPARED_LINES: Final = 500
"""The most differing lines that are described line by line."""


def whole_records(text: NcText) -> Iterator[Record]:
    """Yield a text with all that can be undone and redone; the first record holds the packed text before all of it."""
    first = text.first
    data = "".join(first.lines).encode(text.encoding)
    yield {"base": [text.encoding, b85encode(zlib.compress(data, 1)).decode()]}
    for change in (*text.past, *reversed(text.future)):
        yield _edit(change)
    for _ in text.future:
        yield {"undo": 1}


def records_between(old: NcText, new: NcText) -> list[Record] | None:
    """Return the edits that lead from `old` to `new`; None if `old` does not lead to `new`."""
    common = _common_changes(old.past, new.past)
    records: list[Record] = [{"undo": 1} for _ in old.past[common:]]
    current = old
    for _ in old.past[common:]:
        current = current.undone()
    for change in new.past[common:]:
        redoes = bool(current.future) and current.future[-1] is change
        records.append({"redo": 1} if redoes else _edit(change))
        current = current.redone() if redoes else current.done(change)
    return records if current.past == new.past and current.future == new.future else None


def _common_changes(old: tuple[Change, ...], new: tuple[Change, ...]) -> int:
    """Return how many changes both begin with; nearly always all of the shorter one."""
    shorter = min(len(old), len(new))
    if not shorter or old[shorter - 1] is new[shorter - 1]:
        return shorter
    return next(index for index in range(shorter) if old[index] is not new[index])


def _edit(change: Change) -> Record:
    return {"do": "", "delta": [change.row, change.removed, change.inserted]}


@dataclass(slots=True)
class NcReplay:
    """A replay of a journal's edits in one list of lines."""

    encoding: str
    lines: list[str]
    past: list[Change] = field(default_factory=list)
    future: list[Change] = field(default_factory=list)

    @classmethod
    def begun(cls, base: object) -> NcReplay:
        """Return the replay before the first edit; raise DamagedError or ValueError if `base` is not a text."""
        match base:
            case [str(encoding), str(packed)]:
                unpacking = zlib.decompressobj()
                try:
                    data = unpacking.decompress(b85decode(packed), 2 * MAX_NC_BYTES)
                except zlib.error as error:
                    raise DamagedError from error
                text = NcText.read(data, encoding)
                if text.encoding != encoding or not unpacking.eof:
                    raise DamagedError
                return cls(encoding, list(text.lines))
            case _:
                raise DamagedError

    def do(self, _label: str, values: object) -> None:
        """Apply one edit; an error leaves everything unchanged."""
        match values:
            case [int(row), [*removed], [*inserted]] if row >= 0 and not isinstance(row, bool):
                change = Change(row, tuple(map(self._text, removed)), tuple(map(self._text, inserted)))
            case _:
                raise DamagedError
        self._replace_lines(change.row, change.removed, change.inserted)
        self.past.append(change)
        self.future.clear()

    def _text(self, value: object) -> str:
        if not isinstance(value, str):
            raise DamagedError
        value.encode(self.encoding)
        return value

    def _replace_lines(self, row: int, removed: tuple[str, ...], inserted: tuple[str, ...]) -> None:
        if row > len(self.lines) or tuple(self.lines[row : row + len(removed)]) != removed:
            raise DamagedError
        self.lines[row : row + len(removed)] = inserted

    def undo(self) -> None:
        """Undo one edit; raise DamagedError if there is none."""
        if not self.past:
            raise DamagedError
        change = self.past.pop()
        self._replace_lines(change.row, change.inserted, change.removed)
        self.future.append(change)

    def redo(self) -> None:
        """Redo one undone edit; raise DamagedError if there is none."""
        if not self.future:
            raise DamagedError
        change = self.future.pop()
        self._replace_lines(change.row, change.removed, change.inserted)
        self.past.append(change)

    def work(self) -> NcText:
        """Return the text that the edits led to, marked as not saved in any file."""
        return NcText(
            tuple(self.lines), self.encoding, past=tuple(self.past), future=tuple(self.future), saved=NEVER_SAVED
        )


def known_in_file(work: NcText, file: NcText) -> NcText:
    """Return the work, marked with the change after which it equals the file: undone to there, nothing is unsaved."""
    at = work.first
    for change in (None, *work.past, *reversed(work.future)):
        at = at if change is None else at.done(change)
        if at.lines == file.lines and at.encoding == file.encoding:
            return replace(work, saved=change)
    return work


def differences(file: NcText, work: NcText, other: str = "in the file") -> tuple[str, ...]:
    """Describe line by line how the work differs from the file; for long differences, only the range of lines.

    `other` says in the sentence on a line where its other text is from.
    """
    old, new = ([text.text(row) for row in range(len(text))] for text in (file, work))
    shorter = min(len(old), len(new))
    first = next((row for row in range(shorter) if old[row] != new[row]), shorter)
    after = next((row for row in range(shorter - first) if old[-1 - row] != new[-1 - row]), shorter - first)
    old, new = old[first : len(old) - after], new[first : len(new) - after]
    if max(len(old), len(new)) > MAX_COMPARED_LINES:
        if not new:
            return (f"Lines {first + 1} to {first + len(old)} of the file are deleted.",)
        return (f"Lines {first + 1} to {first + len(new)} differ from the file.",)
    return tuple(_compared(old, new, first + 1, other))


def _compared(old: list[str], new: list[str], first: int, other: str) -> Iterator[str]:
    for kind, a, b, c, d in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind == "equal":
            continue
        for row in range(max(b - a, d - c)):
            if a + row >= b:
                yield f"Line {first + c + row} is new: {printable(new[c + row])}"
            elif c + row >= d:
                yield f"Line {first + a + row} of the file is deleted: {printable(old[a + row])}"
            else:
                yield f"Line {first + c + row}: {printable(new[c + row])} ({other}: {printable(old[a + row])})"
