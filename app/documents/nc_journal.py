"""This module turns edits of an NC text into plain values for JSON and back."""

from __future__ import annotations

import zlib
from base64 import b85decode, b85encode
from dataclasses import replace
from typing import Final

from app.documents.journal_file import DamagedError
from app.documents.nc_text import MAX_NC_BYTES, Change, NcText

NEVER_SAVED: Final = Change(-1, (), ())
"""The `saved` change of a text none of whose states any file holds."""


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
