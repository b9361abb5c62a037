"""Where journals are: beside the program, or in this person's own folder where there is no place beside it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from app import times
from core.program.journal_file import SUFFIX, journal_path
from core.program.lock import Owner, alive

if TYPE_CHECKING:
    from core.program.journal import Recovered


def own_folder() -> Path:
    """This person's folder for what a program keeps from one time to the next."""
    from platformdirs import user_state_path

    return user_state_path("cutcomp", appauthor=False)


def place(file: Path | None, me: Owner, own: Path) -> Path:
    """The journal of work on a file, or of work that has no file yet."""
    if file is None:
        return own / f"unnamed-{me.host}-{me.pid}-{times.stamp(me.since)}{SUFFIX}"
    beside = journal_path(file)
    return beside if os.access(beside.parent, os.W_OK) else _elsewhere(file, own)


def _elsewhere(file: Path, own: Path) -> Path:
    from hashlib import blake2b

    target = os.path.realpath(file)
    digest = blake2b(target.encode("utf-8", "surrogateescape"), digest_size=8).hexdigest()
    return own / f"{_begin(target)}{digest}{SUFFIX}"


def _begin(target: str) -> str:
    return f"{Path(target).name[:100]}-"


def left(file: Path | None, own: Path) -> Iterator[tuple[Path, Recovered]]:
    """The journals that a program has left behind which died, the last one first."""
    for path in _unnamed(own) if file is None else _of(file, own):
        found = read(path)
        if found is not None and (file is not None or not alive(found.head.owner)):
            yield path, found


def _of(file: Path, own: Path) -> Iterator[Path]:
    yield journal_path(file)
    begin = _begin(os.path.realpath(file))
    if any(path.name.startswith(begin) for path in _inside(own)):
        yield _elsewhere(file, own)


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
    from core.program.journal import recovered

    return recovered(data)
