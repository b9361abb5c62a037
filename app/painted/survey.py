"""What the start screen tells of a program file: its date, blocks, tools and verdict; found out behind the screens."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents.files import load
from app.documents.lock import alive, user
from app.documents.patience import FILE, within
from app.painted import places
from app.painted.widgets.header import printable
from app.painted.widgets.rows import Look
from core.program.file.read import StoreError
from core.program.model import Number, Program

if TYPE_CHECKING:
    from app.painted.journal import Recovered
    from core.pipeline.derived import Derived

GRAVEST: Final = (Look.ERROR, Look.WARNING, Look.DIM, Look.GOOD)


@dataclass(frozen=True, slots=True)
class Facts:
    """One file.  `stamp` is its time and size: while it stays, so does what is known.  `trouble` is a sentence.

    `left`: a program that died has left unsaved work on it behind.
    """

    path: Path
    stamp: tuple[int, int] = (0, 0)
    date: str = ""
    blocks: str = ""
    tools: str = ""
    word: str = "..."
    look: Look = Look.DIM
    trouble: str = ""
    left: bool = False


def facts_of(path: Path, known: Facts | None = None) -> Facts:
    """The facts of a file, from the disk; for a thread, since it derives the whole program."""
    try:
        facts, program = within(FILE, lambda: _read(path, known))
    except TimeoutError as error:
        return Facts(path, word="no answer", trouble=f"{printable(path.name)}: {error}.")
    return facts if program is None else _judged(facts, program)


def _read(path: Path, known: Facts | None) -> tuple[Facts, Program | None]:
    """What the disk tells, and the program where it has to be judged."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return _without_file(path), None
    stamp = (status.st_mtime_ns, status.st_size)
    works = [found for found in _works(path) if not alive(found.head.owner)]
    if known is not None and known.stamp == stamp and not works and not known.left:
        return known, None
    date = datetime.fromtimestamp(status.st_mtime).astimezone().strftime("%Y-%m-%d")
    facts = Facts(path, stamp, date)
    try:
        program = load(path)
    except StoreError as error:
        facts = replace(facts, word="unreadable", look=Look.DIM, trouble=printable(str(error)))
        return (_left(facts) if works else facts), None
    if any(found.damaged or found.history.program != program for found in works):
        counted = replace(facts, blocks=str(len(program.blocks)), tools=_tools(program))
        return _left(counted), None
    return facts, program


def _works(path: Path) -> list[Recovered]:
    return [found for _, found in places.left(path, places.own_folder(), user())]


def _without_file(path: Path) -> Facts:
    """Of a program that is not there: it was never saved, or it is lost."""
    gone = Facts(path, word="gone", trouble="This file is not there any more, or its folder cannot be read.")
    with suppress(OSError, ValueError):
        works = _works(path)
        if any(not alive(found.head.owner) for found in works):
            return _left(gone)
        if works:
            return replace(gone, word="open", trouble="This program is open and has not been saved yet.")
        if any(places.found_of(path, places.own_folder())):
            told = "Unsaved work on this program was left behind and cannot be read. It is kept; opening it says where."
            return replace(gone, word="unreadable", trouble=told)
    return gone


def _left(facts: Facts) -> Facts:
    """Of a file with unsaved work: that comes before the verdict on what was saved."""
    told = "Unsaved work on this program was left behind. Opening it asks whether you want it back."
    return replace(facts, word="not saved", look=Look.WARNING, trouble=told, left=True)


def _judged(facts: Facts, program: Program) -> Facts:
    from core.pipeline.derive import derive

    word, look = worst(derive(program))
    return replace(facts, blocks=str(len(program.blocks)), tools=_tools(program), word=word, look=look)


def worst(derived: Derived) -> tuple[str, Look]:
    """The gravest verdict of a program's blocks in one word."""
    from app.painted.screens.program import verdict_word

    words = [verdict_word(found) for found in derived.blocks] or [("empty", Look.DIM)]
    return min(words, key=lambda pair: GRAVEST.index(pair[1]))


def _tools(program: Program) -> str:
    """The tools the blocks call, in order."""
    typed = [one for block in program.blocks for one in (block.tool, block.finish_tool)]
    called = {one.value for one in typed if isinstance(one, Number) and one.value > 0.0}
    return " ".join(f"{number:g}" for number in sorted(called))
