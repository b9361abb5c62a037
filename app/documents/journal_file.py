"""This module writes journal files, whose lines are on disk before `add` returns, and names their paths.

A line is a checksum over itself and all lines before it, a blank, and a JSON object.  Reading stops at the first line
that was torn by a power cut or is not what was written.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any, Final
from zlib import crc32

from app.documents.files import short_name, sync_folder, write_all

Record = Mapping[str, Any]
"""The JSON object on one line of the journal."""

JOURNAL_SUFFIX: Final = ".cutcomp-journal"


class DamagedError(Exception):
    """The values do not describe a valid document or edit."""


@dataclass(slots=True)
class JournalFile:
    """A journal that is being written.  `handle` is None while there is no file; `total` is the checksum of all lines.

    `unwritten` holds lines that could not be written yet, for example on a full disk; the next `add` tries them again.
    `program` is the file that the journal is about if it lies beside it; the journal gets that file's group and mode.
    `aside` is the new path of a file that was in the journal's place.
    """

    path: Path
    unwritten: bytes = b""
    total: int = 0
    length: int = 0
    handle: int | None = None
    program: Path | None = None
    aside: Path | None = None

    def add(self, records: Iterable[Record]) -> None:
        """Write lines to disk, after those that could not be written before; after an OSError the next call retries."""
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
        """Create the file; set aside a file in its place rather than overwrite it, unless that file is empty."""
        if os.path.lexists(self.path):
            status = self.path.lstat()
            if status.st_size or not stat.S_ISREG(status.st_mode):
                self.aside = set_aside(self.path, "kept")
            else:
                self.path.unlink()
        handle, data = self._write_then_move(self.unwritten, _link_into_place), self.unwritten
        self.handle, self.length, self.unwritten = handle, len(data), b""

    def replace(self, records: Iterable[Record]) -> None:
        """Replace the journal by one with these lines in one step; after an OSError the old one is still there."""
        data, total = lines(records)
        if self.handle is not None and self.standing() != self.path:
            # somebody has taken over: the file in this place is not ours
            self.close()
            self.unwritten, self.total = data, total
            self._create()
            return
        handle = self._write_then_move(data)
        self.close()
        self.unwritten, self.total, self.length, self.handle = b"", total, len(data), handle

    def _write_then_move(self, data: bytes, put: Callable[[Path, Path], object] = Path.replace) -> int:
        """Write a file beside its place, move it there, return its handle: a half-written journal would be offered."""
        new = new_path(self.path)
        new.unlink(missing_ok=True)
        handle = os.open(new, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_APPEND | os.O_CLOEXEC, 0o600)
        try:
            if self.program is not None:
                _copy_permissions(handle, self.program)
            write_all(handle, data)
            os.fsync(handle)
            put(new, self.path)
        except OSError:
            os.close(handle)
            with suppress(OSError):
                new.unlink()
            raise
        sync_folder(self.path.parent)
        return handle

    def remove(self) -> None:
        """Remove the file, even if it was moved aside; never remove another file in its place."""
        standing = self.standing()
        if standing is not None:
            with suppress(OSError):
                standing.unlink()
                sync_folder(standing.parent)
        self.close()

    def standing(self) -> Path | None:
        """Return where this journal's file is now, since somebody may have moved it aside; None if it is gone."""
        if self.handle is None:
            return None
        status = os.fstat(self.handle)
        for path in chain((self.path,), journals_set_aside(self.path)):
            with suppress(OSError):
                if os.path.samestat(path.stat(), status):
                    return path
        return None

    def lost(self) -> bool:
        """True if the file that was written was removed, moved elsewhere or replaced, or its length has changed."""
        if self.handle is None:
            return False
        return os.fstat(self.handle).st_size != self.length or self.standing() is None

    def close(self) -> None:
        """Close the file and leave it where it is."""
        if self.handle is not None:
            os.close(self.handle)
        self.handle, self.length = None, 0


def lines(records: Iterable[Record], total: int = 0) -> tuple[bytes, int]:
    """Return the records as lines that continue from the checksum `total`, and the checksum after them."""
    written = []
    for record in records:
        data = json.dumps(record, separators=(",", ":"), allow_nan=False).encode()
        total = crc32(data, total)
        written.append(b"%08x %s\n" % (total, data))
    return b"".join(written), total


def valid_lines(data: bytes) -> Iterator[tuple[bytes, int]]:
    """Yield the JSON of each line before the first invalid one, with the length up to its end."""
    length, total = 0, 0
    for line in data.splitlines(keepends=True):
        total = crc32(line[9:-1], total)
        if not line.endswith(b"\n") or line[:9] != b"%08x " % total:
            return
        length += len(line)
        yield line[9:], length


def journal_path(path: Path) -> Path:
    """Return the path of a file's journal: hidden, beside the file that a symbolic link leads to."""
    target = Path(os.path.realpath(path))
    return target.with_name(f".{short_name(target.name)}{JOURNAL_SUFFIX}")


def new_path(path: Path) -> Path:
    """Return the path where a journal is written before it is moved into place; a killed process may leave it."""
    return path.with_name(f"{path.name}.new")


def journals_set_aside(path: Path) -> Iterator[Path]:
    """Yield the journals that were set aside from a place, newest first; the folder is read at the first one."""
    prefix, new = f"{original_path(path).name}.", new_path(original_path(path))
    aside = (each for each in entries(path.parent) if each.name.startswith(prefix) and each != new)
    yield from (each for _, each in newest_first(aside))


def entries(folder: Path) -> list[Path]:
    """Return what is in a folder; nothing if it cannot be read."""
    with suppress(OSError):
        return list(folder.iterdir())
    return []


def newest_first(paths: Iterable[Path]) -> list[tuple[int, Path]]:
    """Return those of the paths that exist with their times, in nanoseconds, the one that has changed last first."""
    dated = list[tuple[int, Path]]()
    for path in paths:
        with suppress(OSError):
            dated.append((path.stat().st_mtime_ns, path))
    return sorted(dated, reverse=True)


def original_path(path: Path) -> Path:
    """Return the original path of a journal that was set aside; the path itself if it was not."""
    prefix, suffix, _ = path.name.partition(JOURNAL_SUFFIX)
    return path.with_name(prefix + suffix)


def reason_set_aside(path: Path) -> str:
    """Return why a journal was set aside, as `set_aside` recorded it; empty if it was not."""
    return path.name.partition(f"{JOURNAL_SUFFIX}.")[2].rpartition("-")[0]


def set_aside(path: Path, why: str) -> Path:
    """Rename a journal and return its new path, from which `reason_set_aside` and `original_path` read."""
    place, number = original_path(path), 1
    while os.path.lexists(aside := place.with_name(f"{place.name}.{why}-{number}")):
        number += 1
    path.rename(aside)
    sync_folder(aside.parent)
    return aside


def _link_into_place(new: Path, path: Path) -> None:
    """Move a file to its path; raise FileExistsError if another journal has that path by now."""
    try:
        os.link(new, path)
    except FileExistsError:
        raise
    except OSError:
        # a file system without hard links
        new.replace(path)
    else:
        new.unlink()


def _copy_permissions(handle: int, program: Path) -> None:
    """Give a new journal the group and mode of its program's file, which will hold the same work after a save.

    If the group cannot be set, the journal's own group gets only the permissions of others.
    """
    try:
        status = program.stat()
    except OSError:
        return
    with suppress(OSError):
        os.fchown(handle, -1, status.st_gid)
    mode = stat.S_IMODE(status.st_mode) & 0o666 | 0o600
    if os.fstat(handle).st_gid != status.st_gid:
        mode = mode & 0o606 | (mode & 0o006) << 3
    with suppress(OSError):
        os.fchmod(handle, mode)
