"""Who has a program open: a small hidden file next to it, made in one step, with the owner's name in it.

The lock tells, it does not force: a second opener may look or take over, and the first one finds another name in the
file before it saves.  Two who recognize the same dead lock in the same moment may both believe that it is theirs;
before saving, one of them finds the other's name.
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

SUFFIX: Final = ".cutcomp-lock"


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


UNKNOWN: Final = Owner("somebody", "", 0, "", "")
"""The owner of a lock that we may not read."""
MAX_PID: Final = 2**31 - 1
"""The largest number that a system could give to a process."""
MAX_LOCK_BYTES: Final = 4096
ENDED: Final = "ended"
LOOKS: Final = 4
BETWEEN: Final = 0.05
"""How often, and after how many seconds, a lock that says nothing yet is looked at: it is written in one go."""


@dataclass(frozen=True, slots=True)
class Lock:
    """A lock that is held: its file and what it says."""

    path: Path
    owner: Owner


def myself(since: str) -> Owner:
    """This process."""
    return Owner(user(), gethostname(), os.getpid(), started(os.getpid()), since)


def user() -> str:
    """The login this process runs under."""
    try:
        return getuser()
    except (OSError, KeyError):
        return str(os.getuid())


def started(pid: int) -> str:
    """What tells a process from another one of the same number, empty where the system does not say it.

    ENDED is what tells of one that is dead and that nobody has asked after yet: its number is still taken.
    """
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        status = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return ""
    state, *rest = status.rpartition(")")[2].split()
    return ENDED if state in "ZX" else f"{boot}:{rest[18]}"


def alive(owner: Owner) -> bool:
    """Whether the owner may still be running; one on another host always may."""
    if owner == UNKNOWN or owner.host != gethostname():
        return True
    if not 0 < owner.pid <= MAX_PID:
        # 0 and less would ask after groups of processes
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
    """The lock's file: hidden, next to the file that a symbolic link leads to."""
    target = Path(os.path.realpath(path))
    return target.with_name(f".{short_name(target.name)}{SUFFIX}")


def take(path: Path, me: Owner) -> Lock | Owner:
    """Lock a program file, also one that does not exist yet, or who has it; OSError where no lock can be written."""
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
    return _owner(lock.path) or UNKNOWN


def take_over(path: Path, me: Owner) -> Lock:
    """Lock a program file whoever has it; OSError where no lock can be written."""
    lock = Lock(lock_path(path), me)
    _clear(lock.path)
    _create(lock)
    return lock


def taken_by(lock: Lock) -> Owner | None:
    """Who has taken over a lock that was held, None while it is held still (or nobody has it)."""
    owner = _owner(lock.path)
    return None if owner == lock.owner else owner


def held_by(path: Path) -> Owner | None:
    """Who has a program file open, without locking it; None for nobody, or for somebody dead."""
    owner = _owner(lock_path(path))
    return owner if owner is not None and alive(owner) else None


def release(lock: Lock) -> None:
    """Give a lock back, unless somebody has taken it over."""
    if _owner(lock.path) == lock.owner:
        with suppress(OSError):
            lock.path.unlink()


def _clear(path: Path) -> None:
    """Take away what stands in a lock's place; a folder is renamed, since it may hold something."""
    with suppress(FileNotFoundError):
        if path.is_dir() and not path.is_symlink():
            path.rename(path.with_name(f"{path.name}.{os.urandom(4).hex()}"))
        else:
            path.unlink()


def _create(lock: Lock) -> None:
    """Make the lock's file, whole or not at all: half a lock has an unknown owner and is held for ever."""
    handle = os.open(lock.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
    try:
        try:
            # it holds no more than a name: hidden by a umask, others could never see that its owner is dead
            os.fchmod(handle, 0o644)
            write_all(handle, json.dumps(asdict(lock.owner)).encode())
            # that a power cut takes all of a lock away is right
            os.fsync(handle)
        finally:
            os.close(handle)
    except BaseException:
        # it is this process's own file: O_EXCL made it
        with suppress(OSError):
            lock.path.unlink()
        raise


def _owner(path: Path) -> Owner | None:
    """What a lock file says; None where there is none, or none that says anything; UNKNOWN where it is hidden from us.

    A lock of which only a beginning stands is being written just now, or whoever wrote it found the disk full or lost
    power: it is looked at again for a moment, and then it is nobody's.
    """
    for _ in range(LOOKS):
        try:
            return owner_of(json.loads(read_file(path, MAX_LOCK_BYTES)[0]))
        except FileNotFoundError:
            return None
        except (NotAFileError, TooLargeError):
            # no lock of ours, and nobody's
            return None
        except OSError:
            return UNKNOWN
        except (ValueError, RecursionError):
            sleep(BETWEEN)
    return None


def owner_of(values: object) -> Owner:
    """The owner that `dataclasses.asdict` wrote; ValueError for anything else."""
    match values:
        case {"user": str(user), "host": str(host), "pid": int(pid), "started": str(begun), "since": str(since)}:
            if isinstance(pid, bool):
                raise ValueError("no owner")
            return Owner(user, host, pid, begun, since)
        case _:
            raise ValueError("no owner")
