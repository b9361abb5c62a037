"""Journals on the disk: where they are, what a program that died has left, and the copies that are kept.

A journal lies beside its document, or in this person's own folder where there is no place beside it.
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
from app.documents.journal import MAX_JOURNAL_BYTES, Journal, Kind, read_journal
from app.documents.journal_file import SUFFIX, JournalFile, asides, journal_path, place_of, why_aside
from app.documents.lock import Owner, alive
from core.units import plain

MAX_KEPT_COPIES: Final = 20
"""So many kept copies are listed, the last ones; the folder holds the others."""
UNNAMED: Final = "a program without a name"
CUT_NAME: Final = 100
"""Characters from which on the name of a journal may not hold all of its file's name."""
KEPT_COPY_WORDS: Final = {"kept": "kept", "discarded": "discarded", "theirs": "taken-over", "damaged": "damaged"}


# ---- where journals are


def state_folder() -> Path:
    """This person's folder for what a program keeps from one time to the next."""
    from platformdirs import user_state_path

    return user_state_path("cutcomp", appauthor=False)


def journal_place(file: Path | None, me: Owner, state: Path) -> Path:
    """The journal of work on a file, or of work that has no file yet."""
    if file is None:
        return state / f"unnamed-{me.host}-{me.pid}-{times.stamp(me.since)}{SUFFIX}"
    adjacent = journal_path(file)
    return adjacent if os.access(adjacent.parent, os.W_OK) else elsewhere(file, state)


def elsewhere(file: Path, state: Path) -> Path:
    """The journal of work on a file whose folder takes nothing."""
    from hashlib import blake2b

    target = os.path.realpath(file)
    digest = blake2b(target.encode("utf-8", "surrogateescape"), digest_size=8).hexdigest()
    return state / f"{_name_begin(target)}{digest}{SUFFIX}"


def _name_begin(target: str) -> str:
    return f"{Path(target).name[:CUT_NAME]}-"


def new_journal(path: Path, file: Path | None) -> JournalFile:
    """A journal that is to be begun there; beside its document, whoever may read that one may read it too."""
    adjacent = file is not None and path == journal_path(file)
    if not adjacent:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    return JournalFile(path, program=Path(os.path.realpath(file)) if file is not None and adjacent else None)


# ---- what was left


@dataclass(frozen=True, slots=True)
class Unreadable:
    """Work that was left and cannot be read: who wrote it, and when, in ISO format.

    `hidden` from us, else damaged; `ours`: the file belongs to this login.  `what` says what stands there instead of a
    file, if something does.
    """

    user: str
    time: str
    hidden: bool
    ours: bool
    what: str = ""


def left_of(file: Path | None, kind: Kind, state: Path) -> Iterator[tuple[Path, Journal | Unreadable]]:
    """What was left of a file, or of work without a name, whosever it is, the last first.

    Not what was discarded, nor what was set aside while somebody else typed on in it, unless he did and died.
    """
    for path in _unnamed(state) if file is None else journals_of(file, state):
        left = read(path, kind) or unreadable(path)
        if left is None:
            continue
        living = not isinstance(left, Unreadable) and alive(left.head.owner)
        if not (living and (file is None or why_aside(path))):
            yield path, left


def left_by_dead(file: Path, kind: Kind, state: Path, user: str) -> Iterator[tuple[Path, Journal]]:
    """The journals of a file that this user is asked about, of programs that died."""
    for path, left in left_of(file, kind, state):
        if isinstance(left, Unreadable) or alive(left.head.owner):
            continue
        if not why_aside(path) or of_user(left.head.owner, path, state, user):
            yield path, left


def of_user(owner: Owner, path: Path, state: Path, user: str) -> bool:
    """Whether work is this user's: everything in a person's own folder is."""
    return owner.user == user or path.parent == state


def journals_of(file: Path, state: Path) -> Iterator[Path]:
    """The journals of a file that are to be offered, those set aside after the others."""
    candidates = [journal_path(file)]
    begin = _name_begin(os.path.realpath(file))
    if any(path.name.startswith(begin) for path in _inside(state)):
        candidates.append(elsewhere(file, state))
    yield from (path for path in candidates if os.path.lexists(path))
    yield from (path for place in candidates for path in asides(place) if _wants_answer_still(path))


def wants_answer(path: Path) -> bool:
    """Whether a journal is offered by itself, or is a copy that only somebody who looks for it sees."""
    return why_aside(path).partition("-")[0] in ("", "kept", "theirs")


def _wants_answer_still(path: Path) -> bool:
    why, _, length = why_aside(path).partition("-at-")
    if why == "kept" or not length.isdecimal():
        return wants_answer(path)
    with suppress(OSError):
        return path.stat().st_size > int(length)
    return False


def never_saved(folder: Path, state: Path) -> list[Path]:
    """The programs of a folder that have no file yet, of which there is a journal; OSError where it cannot be read."""
    adjacent = [folder / path.name[1:].removesuffix(SUFFIX) for path in folder.iterdir() if path.name.endswith(SUFFIX)]
    there = [path for path in adjacent if _holds_something(journal_path(path))]
    named = ((path, path.name.removesuffix(SUFFIX).rpartition("-")[0]) for path in _inside(state))
    there += [
        folder / name for path, name in named if elsewhere(folder / name, state) == path and _holds_something(path)
    ]
    return sorted({path for path in there if path.suffix.lower() == ".toml" and not path.exists()})


def _holds_something(path: Path) -> bool:
    try:
        return path.stat().st_size > 0
    except OSError:
        return False


def _inside(folder: Path) -> list[Path]:
    with suppress(OSError):
        return list(folder.iterdir())
    return []


def _unnamed(state: Path) -> list[Path]:
    journals = state.glob(f"unnamed-*{SUFFIX}")
    return sorted(journals, key=lambda path: (_changed(path), path.name), reverse=True)


def _changed(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def read(path: Path, kind: Kind | None = None) -> Journal | None:
    """What a journal of this kind, or of any, holds; None where there is none or nothing of it can be read."""
    try:
        data, _ = read_file(path, MAX_JOURNAL_BYTES)
    except OSError:
        return None
    journal = read_journal(data)
    return journal if journal is not None and kind in (None, journal.kind) else None


def unreadable(path: Path) -> Unreadable | None:
    """What can be said of a journal that cannot be read; None where there is none, or nothing in it."""
    hidden, what = False, ""
    try:
        status = path.stat()
        if stat.S_ISREG(status.st_mode) and not status.st_size:
            return None
        read_file(path, MAX_JOURNAL_BYTES)
    except FileNotFoundError:
        return None
    except NotAFileError as error:
        what = error.what
    except PermissionError:
        hidden = True
    except OSError:
        hidden = False
    try:
        status = path.stat()
    except OSError:
        return None
    return Unreadable(login(status.st_uid), times.of(status.st_mtime_ns), hidden, status.st_uid == os.getuid(), what)


def login(number: int) -> str:
    """The name of a login, its number where it has none."""
    from pwd import getpwuid

    try:
        return getpwuid(number).pw_name
    except KeyError:
        return str(number)


# ---- kept copies


@dataclass(frozen=True, slots=True)
class KeptCopy:
    """A journal that was set aside: why, its last change in ISO format, and the name of the file it is about."""

    path: Path
    word: str
    time: str
    name: str

    def sentence(self, today: str) -> str:
        """What it is."""
        return f"Unsaved work on {self.name}, {self.word} {times.in_words(self.time, today)}."


def kept_copies(folder: Path, state: Path, kind: Kind) -> list[KeptCopy]:
    """The journals of a kind set aside in a folder and in a person's own one, the last one first."""
    dated = [entry for place in dict.fromkeys((folder, state)) for entry in _set_aside_in(place, state)]
    of_kind = [(time, path) for time, path in dated if _may_be(path, kind, folder, state)]
    return [
        KeptCopy(path, KEPT_COPY_WORDS[_why(path)], times.of(time), plain(_file_name(path)))
        for time, path in sorted(of_kind, reverse=True)[:MAX_KEPT_COPIES]
    ]


def file_of_copy(path: Path, folder: Path) -> Path | None:
    """The file that a kept copy is about; None for work without a name.

    It is beside the copy, should the folder have moved; where a long name was cut, the journal knows all of it.
    """
    journal = read(path)
    name = None if journal is None else journal.head.file
    if not path.name.startswith("."):
        if name is not None:
            return Path(name)
        return None if _file_name(path) == UNNAMED else folder / _file_name(path)
    adjacent = path.with_name(Path(name).name if name is not None else _file_name(path))
    return adjacent if journal_path(adjacent) == place_of(path.resolve()) else path.with_name(_file_name(path))


def _set_aside_in(folder: Path, state: Path) -> Iterator[tuple[int, Path]]:
    with suppress(OSError):
        for path in folder.glob(f"*{SUFFIX}.*" if folder == state else f".*{SUFFIX}.*"):
            if _why(path) in KEPT_COPY_WORDS:
                with suppress(OSError):
                    yield path.stat().st_mtime_ns, path


def _why(path: Path) -> str:
    return why_aside(path).partition("-")[0]


def _may_be(path: Path, kind: Kind, folder: Path, state: Path) -> bool:
    """Whether a copy may be of this kind; one of an NC text in the own folder must be about a file of this folder.

    The name alone tells, so that a list needs no journal read; a name so long that its end is cut may be of either.
    """
    name = _file_name(path)
    if name == UNNAMED:
        return kind is Kind.CONTOUR
    if len(name) < CUT_NAME and name.lower().endswith(".toml") is (kind is Kind.NC):
        return False
    return kind is Kind.CONTOUR or path.name.startswith(".") or place_of(path) == elsewhere(folder / name, state)


def _file_name(path: Path) -> str:
    """The name of the file that a journal is about, as far as the journal's own name says it."""
    name = place_of(path).name.removesuffix(SUFFIX)
    if name.startswith("."):
        return name[1:]
    return UNNAMED if name.startswith("unnamed-") else name.rpartition("-")[0]
