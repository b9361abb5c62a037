"""This module locks open programs by a small hidden file beside each, created in one step, with the owner's name in it.

The lock is advisory: a second user may look or take over, and the first one finds the other name in the file before
saving.  Two processes that find the same dead lock at the same moment may both believe that they have it; before
saving, one of them finds the other's name.
"""

from __future__ import annotations

import json
import os
from contextlib import suppress
from dataclasses import asdict, dataclass
from getpass import getuser
from pathlib import Path
from socket import gethostname
from time import sleep
from typing import Final

from app.documents.files import NotAFileError, TooLargeError, read_file, short_name, write_all

LOCK_SUFFIX: Final = ".cutcomp-lock"


@dataclass(frozen=True, slots=True)
class Owner:
    """A running program: its user, host and process; `started` tells it from a later process of the same number.

    `since` is a time in ISO format.
    """

    user: str
    host: str
    pid: int
    started: str
    since: str


UNKNOWN_OWNER: Final = Owner("somebody", "", 0, "", "")
"""The owner of a lock that this login may not read."""
MAX_PID: Final = 2**31 - 1
"""The largest process number that a system can assign."""
MAX_LOCK_BYTES: Final = 4096
ENDED: Final = "ended"
MAX_READS: Final = 4
SECONDS_BETWEEN_READS: Final = 0.05
"""How many times, and how many seconds apart, an incomplete lock is read; writing one takes only a moment."""


@dataclass(frozen=True, slots=True)
class Lock:
    """A lock that is held: its file and the owner in it."""

    path: Path
    owner: Owner


def myself(since: str) -> Owner:
    """Return this process as an owner."""
    return Owner(user(), gethostname(), os.getpid(), started(os.getpid()), since)


def user() -> str:
    """Return the login that this process runs under."""
    try:
        return getuser()
    except (OSError, KeyError):
        return str(os.getuid())


def started(pid: int) -> str:
    """Return what distinguishes a process from a later one of the same number, empty if the system does not say it.

    Return ENDED for a process that is dead but not yet reaped, so that its number is still taken.
    """
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        status = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return ""
    state, *rest = status.rpartition(")")[2].split()
    return ENDED if state in "ZX" else f"{boot}:{rest[18]}"


def alive(owner: Owner) -> bool:
    """True if the owner may still be running; on another host it always may."""
    if owner == UNKNOWN_OWNER or owner.host != gethostname():
        return True
    if not 0 < owner.pid <= MAX_PID:
        # kill takes 0 and negative numbers for groups of processes
        return False
    try:
        os.kill(owner.pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    now = started(owner.pid)
    return now != ENDED and (not now or not owner.started or now == owner.started)


def lock_path(path: Path) -> Path:
    """Return the path of a file's lock: hidden, beside the file that a symbolic link leads to."""
    target = Path(os.path.realpath(path))
    return target.with_name(f".{short_name(target.name)}{LOCK_SUFFIX}")


def take(path: Path, me: Owner) -> Lock | Owner:
    """Lock a file, which need not exist yet, or return who has it; raise OSError if no lock can be written."""
    lock = Lock(lock_path(path), me)
    for _ in range(3):
        try:
            _create(lock)
        except FileExistsError:
            owner = _owner(lock.path)
            if owner is not None and alive(owner):
                return owner
            _clear(lock.path)
        else:
            return lock
    return _owner(lock.path) or UNKNOWN_OWNER


def take_over(path: Path, me: Owner) -> Lock:
    """Lock a file no matter who has it; raise OSError if no lock can be written."""
    lock = Lock(lock_path(path), me)
    _clear(lock.path)
    _create(lock)
    return lock


def taken_by(lock: Lock) -> Owner | None:
    """Return who has taken over a lock, None while its owner still has it or if nobody has."""
    owner = _owner(lock.path)
    return None if owner == lock.owner else owner


def held_by(path: Path) -> Owner | None:
    """Return who has a file open, without locking it; None if nobody has, or if that process is dead."""
    owner = _owner(lock_path(path))
    return owner if owner is not None and alive(owner) else None


def release(lock: Lock) -> None:
    """Release a lock, unless somebody has taken it over."""
    if _owner(lock.path) == lock.owner:
        with suppress(OSError):
            lock.path.unlink()


def _clear(path: Path) -> None:
    """Remove what is in a lock's place; rename a folder, since it may hold something."""
    with suppress(FileNotFoundError):
        if path.is_dir() and not path.is_symlink():
            path.rename(path.with_name(f"{path.name}.{os.urandom(4).hex()}"))
        else:
            path.unlink()


def _create(lock: Lock) -> None:
    """Create the lock's file completely or not at all: half a lock names no owner."""
    handle = os.open(lock.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
    try:
        try:
            # the file holds only a name; if a umask hid it, others could never see that its owner is dead
            os.fchmod(handle, 0o644)
            write_all(handle, json.dumps(asdict(lock.owner)).encode())
            # a power cut may take the whole lock, whose owner dies too, but must not leave half of it
            os.fsync(handle)
        finally:
            os.close(handle)
    except BaseException:
        # the file is this process's own: O_EXCL created it
        with suppress(OSError):
            lock.path.unlink()
        raise


def _owner(path: Path) -> Owner | None:
    """Return the owner in a lock file; None if there is no lock or owner; `UNKNOWN_OWNER` if it may not be read.

    An incomplete lock is just being written, or its writer met a full disk or a power cut: it is read again for a
    moment, and then counts as nobody's.
    """
    for _ in range(MAX_READS):
        try:
            return owner_of(json.loads(read_file(path, MAX_LOCK_BYTES)[0]))
        except FileNotFoundError:
            return None
        except (NotAFileError, TooLargeError):
            # not a lock of this program: nobody's
            return None
        except OSError:
            return UNKNOWN_OWNER
        except (ValueError, RecursionError):
            sleep(SECONDS_BETWEEN_READS)
    return None


def owner_of(values: object) -> Owner:
    """Return the owner that `dataclasses.asdict` wrote; raise ValueError for anything else."""
    match values:
        case {"user": str(user), "host": str(host), "pid": int(pid), "started": str(begun), "since": str(since)}:
            if isinstance(pid, bool):
                raise ValueError("no owner")
            return Owner(user, host, pid, begun, since)
        case _:
            raise ValueError("no owner")
