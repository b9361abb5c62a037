"""The journal's file: what is added to it is on the disk before `add` returns."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final, Self

from core.program.disk import sync_folder, write_all
from core.program.store import write_text
from core.records import dataclass

if TYPE_CHECKING:
    from core.program.journal import Record, Recovered

SUFFIX: Final = ".cutcomp-journal"

LARGEST_KEPT: Final = 1_000_000
"""Bytes of a journal that is kept in memory over a save; of a longer one undo behind the next crash ends there."""


@dataclass(slots=True)
class JournalFile:
    """A journal that is being written.  `handle` is None while there is no file; `total` is the sum of all lines.

    `unwritten` holds lines that could not be written yet, such as on a full disk: the next `add` tries them again.
    """

    path: Path
    unwritten: bytes = b""
    total: int = 0
    length: int = 0
    handle: int | None = None

    @classmethod
    def resumed(cls, path: Path, found: Recovered) -> Self:
        """The journal of a program that died, cut behind its last whole line; OSError if that cannot be done."""
        handle = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CLOEXEC)
        try:
            os.ftruncate(handle, found.length)
        except OSError:
            os.close(handle)
            raise
        return cls(path, total=found.total, length=found.length, handle=handle)

    def add(self, records: Iterable[Record]) -> None:
        """Put lines on the disk, with those that could not be written before; OSError keeps them for the next time."""
        from core.program.journal import lines

        data, self.total = lines(records, self.total)
        self.unwritten += data
        if self.handle is None:
            self._create()
            return
        try:
            write_all(self.handle, self.unwritten)
            os.fsync(self.handle)
        except OSError:
            with suppress(OSError):
                os.ftruncate(self.handle, self.length)
            raise
        self.length += len(self.unwritten)
        self.unwritten = b""

    def _create(self) -> None:
        """Make the file; one that stands in its place is moved aside, never overwritten."""
        if self.path.exists():
            set_aside(self.path, "kept")
        handle = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_APPEND | os.O_CLOEXEC, 0o600)
        try:
            write_all(handle, self.unwritten)
            os.fsync(handle)
        except OSError:
            os.close(handle)
            with suppress(OSError):
                self.path.unlink()
            raise
        sync_folder(self.path.parent)
        self.handle, self.length, self.unwritten = handle, len(self.unwritten), b""

    def replace(self, records: Iterable[Record]) -> None:
        """Put a shorter journal in the place of this one, in one step; StoreError leaves the long one."""
        from core.program.journal import lines

        data, total = lines(records)
        write_text(self.path, data.decode())
        self.close()
        self.unwritten, self.total, self.length = b"", total, len(data)
        self.handle = os.open(self.path, os.O_RDWR | os.O_APPEND | os.O_CLOEXEC)

    def put_away(self) -> bool:
        """Remove the file after a save; its lines go first into the next one.  False where they are too many."""
        kept = self.length + len(self.unwritten) <= LARGEST_KEPT
        if kept and self.handle is not None:
            written = os.pread(self.handle, self.length, 0)
            kept, self.unwritten = len(written) == self.length, written + self.unwritten
        self.remove()
        return kept

    def remove(self) -> None:
        """Remove the file, unless another one stands in its place by now."""
        if self.handle is not None:
            with suppress(OSError):
                if os.path.samestat(self.path.stat(), os.fstat(self.handle)):
                    self.path.unlink()
                    sync_folder(self.path.parent)
        self.close()

    def close(self) -> None:
        """Leave the file where it is."""
        if self.handle is not None:
            os.close(self.handle)
        self.handle, self.length = None, 0


def journal_path(path: Path) -> Path:
    """The journal of a program file: hidden, beside the file that a symbolic link leads to."""
    target = Path(os.path.realpath(path))
    return target.with_name(f".{target.name[:200]}{SUFFIX}")


def set_aside(path: Path, why: str) -> Path:
    """Rename a journal to a name under which it is not offered again; returns that name."""
    number = 1
    while (aside := path.with_name(f"{path.name}.{why}-{number}")).exists():
        number += 1
    path.rename(aside)
    sync_folder(aside.parent)
    return aside
