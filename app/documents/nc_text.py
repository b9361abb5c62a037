"""A program text being edited: its lines as the file has them, and what was changed.

A line keeps its own line end, so that what nobody touched is written back byte by byte.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

MAX_NC_BYTES: Final = 64_000_000
"""Bytes of a file that is opened."""
MARKS: Final = ((b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
"""The marks of UTF-16."""
MARK: Final = "\ufeff"
"""The mark of an encoding, as the first character of a text."""
_COMMON: Final = (".nc", ".ngc", ".tap", ".cnc", ".txt", ".iso", ".eia", ".gcode", ".din", ".mpf", ".spf", ".min", ".h")
NC_SUFFIXES: Final = frozenset((*_COMMON, ".anc", ".i", ".ncc", ".ncf", ".prg", ".ptp"))
"""Files of a folder that are shown as NC programs."""
_LINE: Final = re.compile(r"[^\r\n]*(?:\r\n|\n|\r)|[^\r\n]+\Z")
_END: Final = re.compile(r"(?:\r\n|\n|\r)\Z")


@dataclass(frozen=True, eq=False, slots=True)
class Change:
    """Lines from `row` on, from 0, that were put in the place of others."""

    row: int
    removed: tuple[str, ...]
    inserted: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class NcText:
    """`lines` with their ends; `origin` is what the file held; `saved` is the last change that the file has."""

    lines: tuple[str, ...] = ()
    encoding: str = "utf-8"
    origin: bytes = b""
    past: tuple[Change, ...] = ()
    future: tuple[Change, ...] = ()
    saved: Change | None = None

    @staticmethod
    def read(data: bytes, known: str = "") -> NcText:
        """The lines of a file in an encoding that is known, else UTF-16 by its mark, UTF-8, or byte for byte."""
        for encoding in (known,) if known else (*(name for mark, name in MARKS if data.startswith(mark)), "utf-8"):
            try:
                text = data.decode(encoding)
            except (UnicodeDecodeError, LookupError):
                continue
            if text.encode(encoding) == data:
                return NcText(tuple(_LINE.findall(text)), encoding, data)
        return NcText(tuple(_LINE.findall(data.decode("latin-1"))), "latin-1", data)

    @property
    def data(self) -> bytes:
        """The file as it would be written."""
        return self.origin if not self.unsaved else "".join(self.lines).encode(self.encoding)

    @property
    def unsaved(self) -> bool:
        """The file does not hold the lines as they are."""
        return (self.past[-1] if self.past else None) is not self.saved

    def __len__(self) -> int:
        return len(self.lines)

    def text(self, row: int) -> str:
        """A line without its end; none past the last line."""
        return _END.sub("", self.lines[row]).removeprefix(MARK) if 0 <= row < len(self.lines) else ""

    def takes(self, text: str) -> bool:
        """Whether the file's encoding can hold a text."""
        try:
            text.encode(self.encoding)
        except UnicodeEncodeError:
            return False
        return True

    @property
    def texts(self) -> tuple[str, ...]:
        """The lines without their ends, as an editor shows them: after a last line end there is an empty one."""
        texts = tuple(self.text(row) for row in range(len(self.lines)))
        return (*texts, "") if not self.lines or self._end_of(len(self.lines) - 1) else texts

    def with_texts(self, texts: Sequence[str]) -> NcText:
        """The text with these lines, as `texts` gives them, by one change; lines that stay keep their own ends."""
        before = self.texts
        first, after = _shared(before, texts)
        moved = len(before) - len(texts)
        lines = []
        for row, text in enumerate(texts[:-1]):
            old = row if row < min(len(texts), len(before)) - after else row + moved
            lines.append(text + (self._end_of(old) if 0 <= old < len(self.lines) else ""))
            if not _END.search(lines[-1]):
                lines[-1] += self._usual()
        lines += [text for text in texts[-1:] if text]
        if self.lines and self.lines[0].startswith(MARK):
            lines[:1] = [MARK + "".join(lines[:1])]
        first, after = _shared(self.lines, lines)
        removed, inserted = self.lines[first : len(self.lines) - after], lines[first : len(lines) - after]
        return self._do(Change(first, removed, tuple(inserted))) if removed or inserted else self

    def _end_of(self, row: int) -> str:
        match = _END.search(self.lines[row])
        return match[0] if match else ""

    def _usual(self) -> str:
        """The line end of this file."""
        return (self._end_of(0) if self.lines else "") or "\n"

    def _do(self, change: Change) -> NcText:
        return replace(_with(self, change), past=(*self.past, change), future=())

    def undone(self) -> NcText:
        """Without the last change."""
        if not self.past:
            return self
        change = self.past[-1]
        back = _with(self, Change(change.row, change.inserted, change.removed))
        return replace(back, past=self.past[:-1], future=(*self.future, change))

    def redone(self) -> NcText:
        """With the last undone change made again."""
        if not self.future:
            return self
        change = self.future[-1]
        return replace(_with(self, change), past=(*self.past, change), future=self.future[:-1])

    @property
    def first(self) -> NcText:
        """The lines as they were before every change that can be undone."""
        listing = self
        while listing.past:
            listing = listing.undone()
        return replace(listing, future=())

    def done(self, change: Change) -> NcText:
        """A change made as the next one; ValueError where the lines are not those that it takes out."""
        if self.lines[change.row : change.row + len(change.removed)] != change.removed or change.row < 0:
            raise ValueError("another text")
        return self._do(change)

    def written(self, data: bytes) -> NcText:
        """After the file was written with this content."""
        return replace(self, origin=data, saved=self.past[-1] if self.past else None)


def _with(listing: NcText, change: Change) -> NcText:
    lines, after = listing.lines, change.row + len(change.removed)
    return replace(listing, lines=(*lines[: change.row], *change.inserted, *lines[after:]))


def _shared(before: Sequence[str], after: Sequence[str]) -> tuple[int, int]:
    """How many lines at the beginning, and after these at the end, are the same."""
    most = min(len(before), len(after))
    first = next((row for row in range(most) if before[row] != after[row]), most)
    last = next((row for row in range(most - first) if before[-1 - row] != after[-1 - row]), most - first)
    return first, last
