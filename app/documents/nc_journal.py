"""This module turns edits of an NC text into plain values for JSON and back, and describes how two texts differ."""

from __future__ import annotations

import zlib
from base64 import b85decode, b85encode
from collections.abc import Iterator, Sequence
from dataclasses import replace
from difflib import SequenceMatcher
from typing import Final

from app.documents.journal_file import DamagedError
from app.documents.nc_text import MAX_NC_BYTES, Change, NcText
from core.program.history import splice
from core.units import printable

NEVER_SAVED: Final = Change(-1, (), ())
"""The `saved` change of a text none of whose states any file holds."""
MAX_COMPARED_LINES: Final = 500
"""The most differing lines that are described line by line."""


def packed(text: NcText) -> list[str]:
    """Return a text without its edits."""
    data = "".join(text.lines).encode(text.encoding)
    return [text.encoding, b85encode(zlib.compress(data, 1)).decode()]


def unpacked(values: object) -> NcText:
    """Return the text that `packed` packed, marked as not saved in any file; raise DamagedError or ValueError."""
    match values:
        case [str(encoding), str(data)]:
            unpacking = zlib.decompressobj()
            try:
                text = NcText.read(unpacking.decompress(b85decode(data), 2 * MAX_NC_BYTES), encoding)
            except zlib.error as error:
                raise DamagedError from error
        case _:
            raise DamagedError
    if text.encoding != encoding or not unpacking.eof:
        raise DamagedError
    return replace(text, origin=b"", saved=NEVER_SAVED)


def delta(change: Change) -> list[object]:
    """Return one change as values for JSON."""
    return [change.row, change.removed, change.inserted]


def applied(text: NcText, values: object) -> NcText:
    """Return the text after the change of a `delta`; raise DamagedError or ValueError if it does not fit."""
    match values:
        case [int(row), [*removed], [*inserted]]:
            return text.done(Change(row, _lines_of(text, removed), _lines_of(text, inserted)))
        case _:
            raise DamagedError


def _lines_of(text: NcText, values: list[object]) -> tuple[str, ...]:
    lines = tuple(value for value in values if isinstance(value, str) and text.takes(value))
    if len(lines) < len(values):
        raise DamagedError
    return lines


def known_in_file(work: NcText, file: NcText) -> NcText:
    """Return the work, marked with the change after which it equals the file: undone to there, nothing is unsaved."""
    lines, wanted = list(work.first.lines), list(file.lines)
    for change in (None, *work.past, *reversed(work.future)):
        if change is not None:
            lines[change.row : change.row + len(change.removed)] = change.inserted
        if lines == wanted and work.encoding == file.encoding:
            return replace(work, saved=change)
    return work


def differences(file: NcText, work: NcText, other: str = "in the file") -> tuple[str, ...]:
    """Describe line by line how the work differs from the file; for long differences, only the range of lines.

    `other` says in the sentence on a line where its other text is from.
    """
    change = splice(*(tuple(text.text(row) for row in range(len(text))) for text in (file, work)))
    first, old, new = change.at, change.old, change.new
    if max(len(old), len(new)) > MAX_COMPARED_LINES:
        if not new:
            return (f"Lines {first + 1} to {first + len(old)} of the file are deleted.",)
        return (f"Lines {first + 1} to {first + len(new)} differ from the file.",)
    return tuple(_compared(old, new, first + 1, other))


def _compared(old: Sequence[str], new: Sequence[str], first: int, other: str) -> Iterator[str]:
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
