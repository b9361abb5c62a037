"""What a session knows of its file besides the program: who holds it, and what it was when it was read."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.documents.files import Stamp
from app.documents.lock import Lock

THE_WAY: Final = "SAVE AS: F8 until PROGRAM, then F7, F3."
"""How to come to SAVE AS from every screen: no key does it at once."""


@dataclass(frozen=True, eq=False, slots=True)
class Guard:
    """`stamp` is the file's as it was read or saved last, None where there was none.

    `looking` is empty, or says who has the program open: then nothing can be changed.  `lock` is ours, if there is
    one.  `linked` says that the operator agreed to write where a link leads.  `earlier` is a journal that was set aside
    and that somebody wants back.  `origin` tells one opening of a program from another.
    """

    stamp: Stamp | None = None
    lock: Lock | None = None
    looking: str = ""
    linked: bool = False
    earlier: Path | None = None
    origin: object = field(default_factory=object)


UNGUARDED: Final = Guard()
"""Of a session that was made without opening anything."""
