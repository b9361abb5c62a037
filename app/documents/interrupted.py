"""This module finds interrupted saves: complete new content beside a file, left by a process that was killed.

Incomplete content is removed here, and the service removes content that is stored elsewhere.  The rest is offered as
unsaved work.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from fcntl import LOCK_EX, LOCK_NB, flock
from pathlib import Path
from socket import gethostname
from typing import Final

from app.documents import times
from app.documents.document import MAX_BYTES, Document
from app.documents.files import read_file, short_name
from app.documents.journal import Head, Journal, Kind
from app.documents.lock import Owner

DEAD_PROCESS: Final = 0
"""The process number of an owner that is dead."""
_NAME: Final = re.compile(r"\.[0-9a-f]{12}-(?P<size>\d{1,12})\.tmp")


@dataclass(frozen=True, slots=True)
class InterruptedSave:
    """The complete new content that a save has left, and when it was written, in nanoseconds since 1970."""

    path: Path
    data: bytes
    changed: int

    def journal(self, document: Document, user: str) -> Journal | None:
        """Return the content as a journal of one edit by this user; None if it is not of the document's kind."""
        work = document.work_of(self.data)
        if work is None:
            return None
        owner = Owner(user, gethostname(), DEAD_PROCESS, "", "")
        head = Head(owner, str(document.file.path), document.file.stamp)
        return Journal(document.kind, head, work, (), times.of(self.changed))


def interrupted_saves(file: Path, kind: Kind) -> Iterator[InterruptedSave]:
    """Yield the complete content that this login's saves of a file have left; remove incomplete content of its own."""
    target = Path(os.path.realpath(file))
    for path, size in _temporaries(target):
        with suppress(OSError):
            status = path.lstat()
            if status.st_uid != os.geteuid() or _being_written(path):
                continue
            if status.st_size != size:
                path.unlink()
                continue
            data, status = read_file(path, MAX_BYTES[kind])
            if data.endswith(b"\0\0"):
                # after a power cut, data that had not reached the disk reads as zeros
                path.unlink()
                continue
            yield InterruptedSave(path, data, status.st_mtime_ns)


def _temporaries(target: Path) -> list[tuple[Path, int]]:
    prefix = f".{short_name(target.name)}"
    with suppress(OSError), os.scandir(target.parent) as entries:
        names = [entry.name for entry in entries if entry.name.startswith(prefix)]
        matches = ((name, _NAME.fullmatch(name[len(prefix) :])) for name in names)
        return [(target.with_name(name), int(match["size"])) for name, match in matches if match is not None]
    return []


def _being_written(path: Path) -> bool:
    """True if a process is still writing the file."""
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        flock(handle, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    finally:
        os.close(handle)
    return False
