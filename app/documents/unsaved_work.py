"""This module finds journals on disk: their paths, the unsaved work of processes that died, and kept copies.

A journal lies beside its document, or in the user's own folder if it cannot lie there.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.documents import times
from app.documents.files import NotAFileError, read_file
from app.documents.journal import MAX_JOURNAL_BYTES, Journal, Kind, owner_in_another_version, read_journal
from app.documents.journal_file import (
    JOURNAL_SUFFIX,
    JournalFile,
    entries,
    journal_path,
    journals_set_aside,
    newest_first,
    original_path,
    reason_set_aside,
)
from app.documents.lock import Owner, alive
from core.units import plain

MAX_KEPT_COPIES: Final = 40
"""The most kept copies that are listed, the newest; the others stay in the folder."""
UNNAMED_PROGRAM: Final = "a program without a name"
MAX_NAME_CHARACTERS: Final = 100
"""The number of characters of a file's name that the name of a journal in the user's folder begins with."""
KEPT_COPY_WORDS: Final = {"kept": "kept", "discarded": "discarded", "theirs": "taken-over", "damaged": "damaged"}


# ---- where journals are


def state_folder() -> Path:
    """Return the user's folder for what a program keeps between runs."""
    from platformdirs import user_state_path

    return user_state_path("cutcomp", appauthor=False)


def journal_place(file: Path | None, me: Owner, state: Path) -> Path:
    """Return the path of the journal for work on a file, or for work without a file."""
    if file is None:
        return state / f"unnamed-{me.host}-{me.pid}-{times.for_file_name(me.since)}{JOURNAL_SUFFIX}"
    adjacent = journal_path(file)
    return adjacent if os.access(adjacent.parent, os.W_OK) else elsewhere(file, state)


def elsewhere(file: Path, state: Path) -> Path:
    """Return the path of the journal for a file whose folder cannot be written."""
    from hashlib import blake2b

    target = os.path.realpath(file)
    digest = blake2b(target.encode("utf-8", "surrogateescape"), digest_size=8).hexdigest()
    return state / f"{_name_prefix(target)}{digest}{JOURNAL_SUFFIX}"


def _name_prefix(target: str) -> str:
    return f"{Path(target).name[:MAX_NAME_CHARACTERS]}-"


def new_journal(path: Path, file: Path | None) -> JournalFile:
    """Return a journal that will begin at this path; beside its document it gets the document's group and mode."""
    adjacent = file is not None and path == journal_path(file)
    if not adjacent:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    return JournalFile(path, program=Path(os.path.realpath(file)) if file is not None and adjacent else None)


# ---- what was left


@dataclass(frozen=True, slots=True)
class UnreadableWork:
    """Unsaved work that cannot be read: who wrote it, and when, in ISO format.

    `hidden`: we may not read it.  `ours`: the file belongs to this login.  `what` says what the path is if it is not a
    regular file.  `owner` began it with another version of this program, which can read it; without one it is damaged.
    """

    user: str
    time: str
    hidden: bool
    ours: bool
    what: str = ""
    owner: Owner | None = None


def unsaved_work_on(file: Path | None, kind: Kind, state: Path) -> Iterator[tuple[Path, Journal | UnreadableWork]]:
    """Yield the unsaved work on a file, or work without a name, of every user; those set aside come last, newest first.

    Skip what was discarded, and what was set aside from a running process unless that wrote more and has died.
    """
    unnamed = f"unnamed-*{JOURNAL_SUFFIX}"
    paths = journals_of(file, state) if file is not None else (path for _, path in newest_first(state.glob(unnamed)))
    for path in paths:
        left = left_at(path, kind)
        living = left is not None and left.owner is not None and alive(left.owner)
        if left is not None and not (living and (file is None or reason_set_aside(path))):
            yield path, left


def work_of_dead_processes(file: Path, state: Path, user: str) -> Iterator[Journal]:
    """Yield the journals on a contour program that this user is asked about, left by processes that died."""
    for path, left in unsaved_work_on(file, Kind.CONTOUR, state):
        if isinstance(left, UnreadableWork) or alive(left.owner):
            continue
        if not reason_set_aside(path) or of_user(left.owner, path, state, user):
            yield left


def of_user(owner: Owner, path: Path, state: Path, user: str) -> bool:
    """True if work is this user's; everything in the user's own folder is."""
    return owner.user == user or path.parent == state


def journals_of(file: Path, state: Path) -> Iterator[Path]:
    """Yield the journals of a file that are to be offered; those set aside come last."""
    candidates = [journal_path(file)]
    prefix = _name_prefix(os.path.realpath(file))
    if any(path.name.startswith(prefix) for path in entries(state)):
        candidates.append(elsewhere(file, state))
    yield from (path for path in candidates if os.path.lexists(path))
    yield from (path for place in candidates for path in journals_set_aside(place) if _still_wants_answer(path))


def wants_answer(path: Path) -> bool:
    """True if a journal is offered by itself; False if it is a copy that is only listed."""
    return reason_set_aside(path).partition("-")[0] in ("", "kept", "theirs")


def _still_wants_answer(path: Path) -> bool:
    why, _, length = reason_set_aside(path).partition("-at-")
    if why == "kept" or not length.isdecimal():
        return wants_answer(path)
    with suppress(OSError):
        return path.stat().st_size > int(length)
    return False


def never_saved(folder: Path, state: Path) -> list[Path]:
    """Return a folder's programs that have a journal but no file yet; raise OSError if the folder cannot be read."""
    journals = [path for path in folder.iterdir() if path.name.endswith(JOURNAL_SUFFIX) and path.name.startswith(".")]
    named = [(folder / path.name[1:].removesuffix(JOURNAL_SUFFIX), path) for path in journals]
    for path in entries(state):
        file = folder / path.name.removesuffix(JOURNAL_SUFFIX).rpartition("-")[0]
        if elsewhere(file, state) == path:
            named.append((file, path))
    programs = {file for file, journal in named if file.suffix.lower() == ".toml" and _holds_something(journal)}
    return sorted(file for file in programs if not file.exists())


def _holds_something(path: Path) -> bool:
    try:
        return path.stat().st_size > 0
    except OSError:
        return False


def read(path: Path, kind: Kind | None = None) -> Journal | None:
    """Return what a journal holds; None if there is none, it is unreadable, or it is not of this kind."""
    left = left_at(path, kind)
    return left if isinstance(left, Journal) else None


def left_at(path: Path, kind: Kind | None) -> Journal | UnreadableWork | None:
    """Return the work in a journal of this kind, or of any; None if there is none or it is empty."""
    try:
        status = path.stat()
    except OSError:
        return None
    if stat.S_ISREG(status.st_mode) and not status.st_size:
        return None
    data, refused = b"", None
    try:
        data = read_file(path, MAX_JOURNAL_BYTES)[0]
    except FileNotFoundError:
        return None
    except OSError as error:
        refused = error
    journal = read_journal(data)
    if journal is not None and kind in (None, journal.kind):
        return journal
    hidden, what = isinstance(refused, PermissionError), refused.what if isinstance(refused, NotAFileError) else ""
    try:
        user = path.owner()
    except (OSError, KeyError):
        user = str(status.st_uid)
    time = times.of_file(status.st_mtime_ns)
    return UnreadableWork(user, time, hidden, status.st_uid == os.getuid(), what, owner_in_another_version(data))


# ---- kept copies


@dataclass(frozen=True, slots=True)
class KeptCopy:
    """A journal that was set aside: why, when it last changed in ISO format, and the name of its file."""

    path: Path
    word: str
    time: str
    name: str

    def sentence(self, today: str) -> str:
        """Describe the copy for the operator."""
        return f"Unsaved work on {self.name}, {self.word} {times.in_words(self.time, today)}."


def kept_copies(folder: Path, state: Path) -> list[KeptCopy]:
    """Return the journals that were set aside in a folder or in the user's own folder, newest first."""
    beside = (path for path in entries(folder) if path.name.startswith("."))
    aside = {path for path in (*beside, *entries(state)) if _why(path) in KEPT_COPY_WORDS}
    listed = newest_first(path for path in aside if _is_listed(path, folder, state))
    return [
        KeptCopy(path, KEPT_COPY_WORDS[_why(path)], times.of_file(time), plain(_file_name(path)))
        for time, path in listed[:MAX_KEPT_COPIES]
    ]


def file_of_copy(path: Path, folder: Path) -> Path | None:
    """Return the file that a kept copy is about; None for work without a name.

    It is beside the copy, even if the folder has moved; if a long name was cut, the journal holds the full one.
    """
    journal = read(path)
    name = None if journal is None else journal.file
    if not path.name.startswith("."):
        if name is not None:
            return Path(name)
        return None if _file_name(path) == UNNAMED_PROGRAM else folder / _file_name(path)
    adjacent = path.with_name(Path(name).name if name is not None else _file_name(path))
    return adjacent if journal_path(adjacent) == original_path(path.resolve()) else path.with_name(_file_name(path))


def _why(path: Path) -> str:
    return reason_set_aside(path).partition("-")[0]


def _is_listed(path: Path, folder: Path, state: Path) -> bool:
    """True unless a copy in the user's folder is about an NC text in another folder.

    The name alone decides, so that listing reads no journal; a name whose end is cut may be a program's.
    """
    name = _file_name(path)
    here = path.name.startswith(".") or original_path(path) == elsewhere(folder / name, state)
    return here or name == UNNAMED_PROGRAM or name.lower().endswith(".toml") or len(name) >= MAX_NAME_CHARACTERS


def _file_name(path: Path) -> str:
    """Return the name of the file that a journal is about, possibly cut, from the journal's own name."""
    name = original_path(path).name.removesuffix(JOURNAL_SUFFIX)
    if name.startswith("."):
        return name[1:]
    return UNNAMED_PROGRAM if name.startswith("unnamed-") else name.rpartition("-")[0]
