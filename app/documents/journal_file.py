"""The journal's file: lines that are on the disk before `add` returns, and where it is stored.

A line is a sum over itself and everything before it, a blank, and a JSON object.  A line that was torn by a power
cut, or that is not what was written, ends what can be read.
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
"""One line of the journal."""

SUFFIX: Final = ".cutcomp-journal"


@dataclass(slots=True)
class JournalFile:
    """A journal that is being written.  `handle` is None while there is no file; `total` is the sum of all lines.

    `unwritten` holds lines that could not be written yet, such as on a full disk: the next `add` tries them again.
    `program` is the file it is about where it lies next to it: whoever may read or write that one may read or write the
    journal.  `aside` is what a file that stood in its place is called now.
    """

    path: Path
    unwritten: bytes = b""
    total: int = 0
    length: int = 0
    handle: int | None = None
    program: Path | None = None
    aside: Path | None = None

    def add(self, records: Iterable[Record]) -> None:
        """Put lines on the disk, with those that could not be written before; OSError keeps them for the next time."""
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
        """Make the file; one that stands in its place is moved aside, never overwritten, unless it holds nothing."""
        if os.path.lexists(self.path):
            status = self.path.lstat()
            if status.st_size or not stat.S_ISREG(status.st_mode):
                self.aside = set_aside(self.path, "kept")
            else:
                self.path.unlink()
        handle, data = self._beside_first(self.unwritten, _named), self.unwritten
        self.handle, self.length, self.unwritten = handle, len(data), b""

    def replace(self, records: Iterable[Record]) -> None:
        """Put a journal with these lines in the place of this one, in one step; OSError leaves the one that stands."""
        data, total = lines(records)
        if self.handle is not None and self.standing() != self.path:
            # somebody has taken over: what stands in the place is not ours
            self.close()
            self.unwritten, self.total = data, total
            self._create()
            return
        handle = self._beside_first(data)
        self.close()
        self.unwritten, self.total, self.length, self.handle = b"", total, len(data), handle

    def _beside_first(self, data: bytes, put: Callable[[Path, Path], object] = Path.replace) -> int:
        """The open file, written beside its place and put into it: half of it would be offered as older work."""
        new = new_path(self.path)
        new.unlink(missing_ok=True)
        handle = os.open(new, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_APPEND | os.O_CLOEXEC, 0o600)
        try:
            if self.program is not None:
                _share(handle, self.program)
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
        """Remove the file, wherever it stands by now; never another one in its place."""
        standing = self.standing()
        if standing is not None:
            with suppress(OSError):
                standing.unlink()
                sync_folder(standing.parent)
        self.close()

    def standing(self) -> Path | None:
        """Where the file that is written stands: somebody may have moved it aside; None where it is gone."""
        if self.handle is None:
            return None
        status = os.fstat(self.handle)
        for path in chain((self.path,), asides(self.path)):
            with suppress(OSError):
                if os.path.samestat(path.stat(), status):
                    return path
        return None

    def lost(self) -> bool:
        """Whether the file that was written is gone: removed, moved away, replaced, or not as long as it was."""
        if self.handle is None:
            return False
        return os.fstat(self.handle).st_size != self.length or self.standing() is None

    def close(self) -> None:
        """Leave the file where it is."""
        if self.handle is not None:
            os.close(self.handle)
        self.handle, self.length = None, 0


def lines(records: Iterable[Record], total: int = 0) -> tuple[bytes, int]:
    """The records as lines that go on from the sum `total`, and the sum at their end."""
    written = []
    for record in records:
        data = json.dumps(record, separators=(",", ":"), allow_nan=False).encode()
        total = crc32(data, total)
        written.append(b"%08x %s\n" % (total, data))
    return b"".join(written), total


def whole_lines(data: bytes) -> Iterator[tuple[bytes, int, int]]:
    """The JSON of each line up to the first that is not what was written, with the length and the sum up to its end."""
    length, total = 0, 0
    for line in data.splitlines(keepends=True):
        total = crc32(line[9:-1], total)
        if not line.endswith(b"\n") or line[:9] != b"%08x " % total:
            return
        length += len(line)
        yield line[9:], length, total


def journal_path(path: Path) -> Path:
    """The journal of a program file: hidden, next to the file that a symbolic link leads to."""
    target = Path(os.path.realpath(path))
    return target.with_name(f".{short_name(target.name)}{SUFFIX}")


def new_path(path: Path) -> Path:
    """Where a journal is written that is to take the place of another; a program that was killed may leave it."""
    return path.with_name(f"{path.name}.new")


def asides(path: Path) -> Iterator[Path]:
    """The journals that were moved aside from a place, the last one first; looked for when the first is asked for."""
    begin, new = f"{place_of(path).name}.", new_path(place_of(path)).name
    dated = list[tuple[int, Path]]()
    with suppress(OSError), os.scandir(path.parent) as inside:
        for entry in inside:
            if entry.name.startswith(begin) and entry.name != new:
                with suppress(OSError):
                    dated.append((entry.stat().st_mtime_ns, Path(entry.path)))
    yield from (path for _, path in sorted(dated, reverse=True))


def place_of(path: Path) -> Path:
    """The place of a journal that was moved aside; its own where it was not."""
    begin, suffix, _ = path.name.partition(SUFFIX)
    return path.with_name(begin + suffix)


def why_aside(path: Path) -> str:
    """Why a journal was moved aside, as `set_aside` recorded it; empty where it was not."""
    return path.name.partition(f"{SUFFIX}.")[2].rpartition("-")[0]


def set_aside(path: Path, why: str) -> Path:
    """Rename a journal; returns the name it has then, from which `why_aside` and `place_of` are read."""
    place, number = place_of(path), 1
    while os.path.lexists(aside := place.with_name(f"{place.name}.{why}-{number}")):
        number += 1
    path.rename(aside)
    sync_folder(aside.parent)
    return aside


def _named(new: Path, path: Path) -> None:
    """Give a file its name; FileExistsError where another journal has it by now."""
    try:
        os.link(new, path)
    except FileExistsError:
        raise
    except OSError:
        # a file system without links
        new.replace(path)
    else:
        new.unlink()


def _share(handle: int, program: Path) -> None:
    """Give a new journal the group and the mode of its program's file, which will hold the same as soon as it is saved.

    Where the group cannot be given, the journal's own group may do what everybody may.
    """
    try:
        like = program.stat()
    except OSError:
        return
    with suppress(OSError):
        os.fchown(handle, -1, like.st_gid)
    mode = stat.S_IMODE(like.st_mode) & 0o666 | 0o600
    if os.fstat(handle).st_gid != like.st_gid:
        mode = mode & 0o606 | (mode & 0o006) << 3
    with suppress(OSError):
        os.fchmod(handle, mode)
