"""Saves that were interrupted: new content that lies whole beside a file, since whoever wrote it was killed.

What was not written to its end is removed; what the file holds by now, too.  The rest is offered as work that was not
saved.
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

NOBODY: Final = 0
"""The number of no process: whoever wrote the content is dead."""
_NAME: Final = re.compile(r"\.[0-9a-f]{12}-(?P<size>\d{1,12})\.tmp")


@dataclass(frozen=True, slots=True)
class InterruptedSave:
    """The whole new content that a save has left, and when it was written, in nanoseconds since 1970."""

    path: Path
    data: bytes
    changed: int

    def journal(self, document: Document, user: str) -> Journal | None:
        """The content as this user's work on a document, one edit; None where it is no content of this kind."""
        work = document.work_of(self.data)
        if work is None:
            return None
        owner = Owner(user, gethostname(), NOBODY, "", "")
        head = Head(owner, str(document.file.path), document.file.stamp)
        return Journal(document.kind, head, work, (), times.of(self.changed))


def interrupted_saves(file: Path, kind: Kind) -> Iterator[InterruptedSave]:
    """What interrupted saves of this login have left of a file; what is not whole is removed, and nothing of others."""
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
                # a power cut leaves zeros in place of what was not on the disk yet
                path.unlink()
                continue
            yield InterruptedSave(path, data, status.st_mtime_ns)


def _temporaries(target: Path) -> list[tuple[Path, int]]:
    begin = f".{short_name(target.name)}"
    with suppress(OSError), os.scandir(target.parent) as inside:
        names = [entry.name for entry in inside if entry.name.startswith(begin)]
        matches = ((name, _NAME.fullmatch(name[len(begin) :])) for name in names)
        return [(target.with_name(name), int(match["size"])) for name, match in matches if match is not None]
    return []


def _being_written(path: Path) -> bool:
    """Whether somebody is at it now."""
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
