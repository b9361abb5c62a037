"""This module holds an NC text that is being edited: its lines as in the file, and the changes to them.

A line keeps its own line end, so that unedited lines are written back byte for byte.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from core.program.history import Splice, splice

MAX_NC_BYTES: Final = 64_000_000
"""The size of the largest NC text that is opened in bytes."""
BYTE_ORDER_MARKS: Final = ((b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
"""The byte order marks of UTF-16."""
BYTE_ORDER_MARK: Final = "\ufeff"
"""The byte order mark as the first character of a text."""
_COMMON: Final = (".nc", ".ngc", ".tap", ".cnc", ".txt", ".iso", ".eia", ".gcode", ".din", ".mpf", ".spf", ".min", ".h")
NC_SUFFIXES: Final = frozenset((*_COMMON, ".anc", ".i", ".ncc", ".ncf", ".prg", ".ptp"))
"""The suffixes of files that are listed as NC programs."""
_LINE: Final = re.compile(r"[^\r\n]*(?:\r\n|\n|\r)|[^\r\n]+\Z")
_END: Final = re.compile(r"(?:\r\n|\n|\r)\Z")


NEVER_SAVED: Final[Splice[str]] = Splice(-1, (), ())
"""The `saved` change of a text none of whose states any file holds."""


@dataclass(frozen=True, eq=False, slots=True)
class NcText:
    """An NC text: `lines` with line ends; `origin` is the file's content, `saved` the last change that it includes."""

    lines: tuple[str, ...] = ()
    encoding: str = "utf-8"
    origin: bytes = b""
    past: tuple[Splice[str], ...] = ()
    future: tuple[Splice[str], ...] = ()
    saved: Splice[str] | None = None

    @staticmethod
    def read(data: bytes, known: str = "") -> NcText:
        """Return a file's text, in the known encoding or else UTF-16 by its mark or UTF-8; Latin-1 if that fails."""
        for encoding in (
            (known,) if known else (*(name for mark, name in BYTE_ORDER_MARKS if data.startswith(mark)), "utf-8")
        ):
            try:
                text = data.decode(encoding)
            except (UnicodeDecodeError, LookupError):
                continue
            if text.encode(encoding) == data:
                return NcText(tuple(_LINE.findall(text)), encoding, data)
        return NcText(tuple(_LINE.findall(data.decode("latin-1"))), "latin-1", data)

    @property
    def data(self) -> bytes:
        """The content that would be written to the file."""
        return self.origin if not self.unsaved else "".join(self.lines).encode(self.encoding)

    @property
    def unsaved(self) -> bool:
        """True if the file does not hold the current lines."""
        return (self.past[-1] if self.past else None) is not self.saved

    def __len__(self) -> int:
        return len(self.lines)

    def text(self, row: int) -> str:
        """Return a line without its end, empty for a row that does not exist."""
        return _END.sub("", self.lines[row]).removeprefix(BYTE_ORDER_MARK) if 0 <= row < len(self.lines) else ""

    def takes(self, text: str) -> bool:
        """True if the file's encoding can hold a text."""
        try:
            text.encode(self.encoding)
        except UnicodeEncodeError:
            return False
        return True

    @property
    def texts(self) -> tuple[str, ...]:
        """The lines without their ends, as an editor shows them: a final line end is followed by an empty line."""
        texts = tuple(self.text(row) for row in range(len(self.lines)))
        return (*texts, "") if not self.lines or self._end_of(len(self.lines) - 1) else texts

    def with_texts(self, texts: Sequence[str]) -> NcText:
        """Return the text with these lines, given as in `texts`, by one change; unchanged lines keep their ends."""
        changed, before = splice(self.texts, tuple(texts)), len(self.texts)
        after = len(texts) - changed.at - len(changed.new)
        lines = []
        for row, text in enumerate(texts[:-1]):
            old = row if row < min(len(texts), before) - after else row + before - len(texts)
            lines.append(text + (self._end_of(old) if 0 <= old < len(self.lines) else ""))
            if not _END.search(lines[-1]):
                # the usual line end of this file: that of its first line
                lines[-1] += (self._end_of(0) if self.lines else "") or "\n"
        lines += [text for text in texts[-1:] if text]
        if self.lines and self.lines[0].startswith(BYTE_ORDER_MARK):
            lines[:1] = [BYTE_ORDER_MARK + "".join(lines[:1])]
        change = splice(self.lines, tuple(lines))
        return self._with_change(change) if change.old or change.new else self

    def _end_of(self, row: int) -> str:
        match = _END.search(self.lines[row])
        return match[0] if match else ""

    def _with_change(self, change: Splice[str]) -> NcText:
        return replace(_with_lines(self, change), past=(*self.past, change), future=())

    def undo(self) -> NcText:
        """Return the text with the last change undone."""
        if not self.past:
            return self
        change = self.past[-1]
        back = _with_lines(self, Splice(change.at, change.new, change.old))
        return replace(back, past=self.past[:-1], future=(*self.future, change))

    def redo(self) -> NcText:
        """Return the text with the last undone change redone."""
        if not self.future:
            return self
        change = self.future[-1]
        return replace(_with_lines(self, change), past=(*self.past, change), future=self.future[:-1])

    @property
    def first(self) -> NcText:
        """The text before every change that can be undone."""
        # in one list: a new tuple for each change would take seconds for thousands of them
        lines = list(self.lines)
        for change in reversed(self.past):
            lines[change.at : change.at + len(change.new)] = change.old
        return replace(self, lines=tuple(lines), past=(), future=())

    def done(self, change: Splice[str]) -> NcText:
        """Return the text after one more change; raise ValueError if the lines that it removes are not there."""
        lines = self.lines[change.at : change.at + len(change.old)]
        if lines != change.old or not 0 <= change.at <= len(self):
            raise ValueError("another text")
        return self._with_change(change)

    def known_in(self, file: NcText) -> NcText:
        """Return the text, marked with the change after which it equals the file: nothing is unsaved at that one."""
        lines, wanted = list(self.first.lines), list(file.lines)
        for change in (None, *self.past, *reversed(self.future)):
            if change is not None:
                lines[change.at : change.at + len(change.old)] = change.new
            if lines == wanted and self.encoding == file.encoding:
                return replace(self, saved=change)
        return self

    def saved_as(self, written: NcText) -> NcText:
        """Return the text after it, or an earlier state of it, was written to the file."""
        return replace(self, origin=written.data, saved=written.past[-1] if written.past else None)


def _with_lines(listing: NcText, change: Splice[str]) -> NcText:
    lines, after = listing.lines, change.at + len(change.old)
    return replace(listing, lines=lines[: change.at] + change.new + lines[after:])
