"""A program file that cannot be read any more, while work on it was left behind: the work is offered all the same."""

from __future__ import annotations

from pathlib import Path

from app.documents.lock import alive, user
from app.documents.programs import empty_program
from app.painted import places
from app.painted.session import Session
from core.program.file.read import StoreError


def rescued(path: Path, error: StoreError, earlier: Path | None = None) -> Session:
    """An empty program in the file's place, on which the work will be offered; the error where nothing was left.

    `earlier` is a journal that was set aside and that somebody wants back: its work is offered before any other.
    It has no stamp of the file: whoever saves it is asked, and what stands in the file is kept beside it.
    """
    dead = (found for _, found in places.left(path, places.own_folder(), user()) if not alive(found.head.owner))
    wanted = None if earlier is None else places.read(earlier)
    if (found := wanted or next(dead, None)) is None:
        if not path.exists() and any(places.found_of(path, places.own_folder())):
            # never saved, and what was left of it cannot be read: that is said on an empty program
            return Session.of(empty_program(), path)
        raise error
    return Session.of(empty_program(found.history.program.unit), path)
