"""A program file as a session."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.files import load, stamp_of
from app.painted.session import Session


def opened(path: Path) -> Session:
    """The session on a program file; StoreError when it is none.

    The stamp is taken first: a file that is written in between is then taken for changed, never for read.
    """
    stamp = stamp_of(path)
    session = Session.of(load(path), path)
    return replace(session, guard=replace(session.guard, stamp=stamp))
