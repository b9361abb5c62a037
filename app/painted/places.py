"""Where journals are: beside the program, or in this person's own folder where there is no place beside it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from stat import S_ISREG
from typing import TYPE_CHECKING

from app.documents import times
from app.documents.journal_file import SUFFIX, JournalFile, asides, journal_path, why_aside
from app.documents.lock import Owner, alive

if TYPE_CHECKING:
    from app.painted.journal import Recovered


def own_folder() -> Path:
    """This person's folder for what a program keeps from one time to the next."""
    from platformdirs import user_state_path

    return user_state_path("cutcomp", appauthor=False)


def place(file: Path | None, me: Owner, own: Path) -> Path:
    """The journal of work on a file, or of work that has no file yet."""
    if file is None:
        return own / f"unnamed-{me.host}-{me.pid}-{times.stamp(me.since)}{SUFFIX}"
    beside = journal_path(file)
    return beside if os.access(beside.parent, os.W_OK) else elsewhere(file, own)


def journal_at(path: Path, file: Path | None) -> JournalFile:
    """A journal that is to be begun there; beside its program, whoever may read that one may read it too."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    beside = file is not None and path == journal_path(file)
    return JournalFile(path, program=Path(os.path.realpath(file)) if file is not None and beside else None)


def elsewhere(file: Path, own: Path) -> Path:
    """The journal of work on a file whose folder takes nothing."""
    from hashlib import blake2b

    target = os.path.realpath(file)
    digest = blake2b(target.encode("utf-8", "surrogateescape"), digest_size=8).hexdigest()
    return own / f"{_begin(target)}{digest}{SUFFIX}"


def _begin(target: str) -> str:
    return f"{Path(target).name[:100]}-"


@dataclass(frozen=True, slots=True)
class Unreadable:
    """Work that was left behind and cannot be read: who wrote it, and when, in ISO format.

    `hidden` from us, else damaged; `ours`: the file belongs to this login.
    """

    user: str
    time: str
    hidden: bool
    ours: bool


def left(file: Path | None, own: Path, user: str) -> Iterator[tuple[Path, Recovered]]:
    """The journals that a program has left behind which died, the last one first; of those set aside only this
    user's, since nobody else is asked about them."""
    for path, found in found_of(file, own):
        if not isinstance(found, Unreadable) and (not why_aside(path) or of_user(found.head.owner, path, own, user)):
            yield path, found


def of_user(owner: Owner, path: Path, own: Path, user: str) -> bool:
    """Whether work is this user's: everything in a person's own folder is."""
    return owner.user == user or path.parent == own


def found_of(file: Path | None, own: Path) -> Iterator[tuple[Path, Recovered | Unreadable]]:
    """What was left behind of a file, or of work without a name, whosever it is.

    Not what was discarded, nor what was set aside while somebody else typed on in it, unless he did and died.
    """
    for path in _unnamed(own) if file is None else of_file(file, own):
        found = read(path) or unreadable(path)
        if found is None:
            continue
        living = not isinstance(found, Unreadable) and alive(found.head.owner)
        if not (living and (file is None or why_aside(path))):
            yield path, found


def of_file(file: Path, own: Path) -> Iterator[Path]:
    """The journals of a file that are to be offered, those set aside behind the others."""
    places = [journal_path(file)]
    begin = _begin(os.path.realpath(file))
    if any(path.name.startswith(begin) for path in _inside(own)):
        places.append(elsewhere(file, own))
    yield from (path for path in places if path.exists())
    yield from (path for one in places for path in asides(one) if _offered(path))


def never_saved(folder: Path, own: Path) -> list[Path]:
    """The programs of a folder that have no file yet, of which there is a journal; OSError where it cannot be read."""
    beside = [folder / path.name[1:].removesuffix(SUFFIX) for path in folder.iterdir() if path.name.endswith(SUFFIX)]
    there = [path for path in beside if _holds(journal_path(path))]
    named = ((path, path.name.removesuffix(SUFFIX).rpartition("-")[0]) for path in _inside(own))
    there += [folder / name for path, name in named if elsewhere(folder / name, own) == path and _holds(path)]
    return sorted({path for path in there if path.suffix.lower() == ".toml" and not path.exists()})


def _holds(path: Path) -> bool:
    """Whether there is something in a file."""
    try:
        return path.stat().st_size > 0
    except OSError:
        return False


def _offered(path: Path) -> bool:
    """Whether a journal that was set aside still wants an answer."""
    why, _, length = why_aside(path).partition("-at-")
    if why == "kept" or not length.isdecimal():
        return why.partition("-")[0] in ("kept", "theirs")
    with suppress(OSError):
        return path.stat().st_size > int(length)
    return False


def _inside(folder: Path) -> list[Path]:
    with suppress(OSError):
        return list(folder.iterdir())
    return []


def _unnamed(own: Path) -> list[Path]:
    found = own.glob(f"unnamed-*{SUFFIX}")
    return sorted(found, key=lambda path: (_changed(path), path.name), reverse=True)


def _changed(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def read(path: Path) -> Recovered | None:
    """What a journal holds, None where there is none or nothing of it can be read."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    from app.painted.journal import recovered

    return recovered(data)


def unreadable(path: Path) -> Unreadable | None:
    """What can be said of a journal that cannot be read; None where there is none, or nothing in it."""
    hidden = False
    try:
        status = path.stat()
        if not status.st_size or not S_ISREG(status.st_mode):
            return None
        path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError:
        hidden = True
    return Unreadable(login(status.st_uid), times.of(status.st_mtime_ns), hidden, status.st_uid == os.getuid())


def login(number: int) -> str:
    """The name of a login, its number where it has none."""
    from pwd import getpwuid

    try:
        return getpwuid(number).pw_name
    except KeyError:
        return str(number)
