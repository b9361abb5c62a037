"""Survey: the files that can be opened, and what the list of them tells of a contour program: date, tools, verdict."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from enum import StrEnum
from pathlib import Path
from typing import Final

from app.documents.document import ContourDocument
from app.documents.files import load, read_start
from app.documents.journal import Journal, Kind
from app.documents.left_overs import KeptCopy, kept_copies, left_by_dead, left_of, never_saved, state_folder
from app.documents.lock import alive, user
from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import is_drawing
from app.documents.patience import FILE, FOLDER, within
from app.documents.programs import examples, is_program
from core.finding import Severity
from core.pipeline.derived import Derived, DerivedBlock
from core.program.file.read import StoreError
from core.program.model import Number, Program

MAX_LISTED: Final = 500
"""Files of a folder that are listed; more are reached by typing a path."""
DRAWING: Final = "drawing"
NC_PROGRAM: Final = "NC program"
SHEET_START: Final = b"SETUP SHEET\n"
"""The first line of a setup sheet's text."""


class Outcome(StrEnum):
    """The verdict on a file in one word, the gravest first; work that was not saved comes before it."""

    NOT_SAVED = "not saved"
    OPEN = "open"
    GOUGE = "gouge"
    NOT_READY = "not ready"
    UNREADABLE = "unreadable"
    WARNING = "warning"
    UNCUT = "uncut"
    CLEAN = "clean"
    EMPTY = "empty"


@dataclass(frozen=True, slots=True)
class Facts:
    """One file.  `stamp` is its time and size: while it stays, so does what is known.  `trouble` is a sentence."""

    path: Path
    stamp: tuple[int, int] = (0, 0)
    changed: datetime | None = None
    blocks: str = ""
    tools: str = ""
    outcome: Outcome | None = None
    trouble: str = ""


def facts_of(path: Path, known: Facts | None = None) -> Facts:
    """The facts of a file, from the disk; for a worker, since it derives the whole program."""
    try:
        facts, program = within(FILE, lambda: _read(path, known))
    except TimeoutError as error:
        return Facts(path, outcome=Outcome.UNREADABLE, trouble=f"{path.name}: {error}.")
    return facts if program is None else _judged(facts, program)


def _read(path: Path, known: Facts | None) -> tuple[Facts, Program | None]:
    """What the disk tells, and the program where it has to be judged."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return _without_file(path), None
    stamp = (status.st_mtime_ns, status.st_size)
    left = [journal for _, journal in left_by_dead(path, Kind.CONTOUR, state_folder(), user())]
    if known is not None and known.stamp == stamp and not left and known.outcome is not Outcome.NOT_SAVED:
        return known, None
    facts = Facts(path, stamp, datetime.fromtimestamp(status.st_mtime).astimezone())
    try:
        program = load(path)
    except StoreError as error:
        return _not_saved(facts) if left else replace(facts, outcome=Outcome.UNREADABLE, trouble=str(error)), None
    saved = ContourDocument.of(program)
    if any(journal.damaged or not saved.holds(journal) for journal in left):
        return _not_saved(replace(facts, blocks=str(len(program.blocks)), tools=_tools(program))), None
    return facts, program


def _without_file(path: Path) -> Facts:
    """The facts of a program that is not there: it was never saved, or it is lost."""
    gone = Facts(path, outcome=Outcome.UNREADABLE)
    try:
        left = [journal for _, journal in left_of(path, Kind.CONTOUR, state_folder())]
    except (OSError, ValueError):
        left = []
    journals = [journal for journal in left if isinstance(journal, Journal)]
    if any(not alive(journal.head.owner) for journal in journals):
        return _not_saved(gone)
    if journals:
        text = "This program is open and has not been saved yet."
        return replace(gone, outcome=Outcome.OPEN, trouble=text)
    if left:
        return replace(gone, trouble="Unsaved work on this program is damaged. It is kept; opening it says where.")
    return replace(gone, trouble="This file is not there any more, or its folder cannot be read.")


def _not_saved(facts: Facts) -> Facts:
    text = "There is unsaved work on this program. Opening it asks whether you want it back."
    return replace(facts, outcome=Outcome.NOT_SAVED, trouble=text)


def _judged(facts: Facts, program: Program) -> Facts:
    # numpy and shapely are not needed by the first paint
    from core.pipeline.derive import derive

    return replace(facts, blocks=str(len(program.blocks)), tools=_tools(program), outcome=gravest(derive(program)))


def gravest(derived: Derived) -> Outcome:
    """The gravest outcome of a program's blocks."""
    order = list(Outcome)
    return min((outcome_of(block) for block in derived.blocks), key=order.index, default=Outcome.EMPTY)


def outcome_of(block: DerivedBlock) -> Outcome:
    """The verdict on a block in one word."""
    if block.errors:
        gouges = any(finding.code.endswith(("GOUGE", "GOUGES", "WRONG_SIDE")) for finding in block.errors)
        return Outcome.GOUGE if gouges else Outcome.NOT_READY
    if any(finding.severity is Severity.WARNING for finding in block.findings):
        return Outcome.WARNING
    verdict = None if block.paths is None else block.paths.verdict
    return Outcome.UNCUT if verdict is not None and verdict.uncut else Outcome.CLEAN


def _tools(program: Program) -> str:
    """The tools the blocks call, in order."""
    typed = [value for block in program.blocks for value in (block.tool, block.finish_tool)]
    called = {value.value for value in typed if isinstance(value, Number) and value.value > 0.0}
    return " ".join(f"{number:g}" for number in sorted(called))


def day_of(changed: datetime, now: datetime) -> str:
    """A file's time in a few cells: the hour of today, the weekday of this week, else the date."""
    age = (now.date() - changed.date()).days
    if age <= 0:
        return f"{changed:%H:%M} today"
    day = f"{changed.day} {changed:%b}"
    if age < 7:
        return f"{changed:%a} {day}"
    return day if changed.year == now.year else f"{day} {changed.year}"


@dataclass(frozen=True, slots=True)
class Listed:
    """A line of the list of files: a contour program, an example, a folder, a kept copy of unsaved work, or a file of
    another `kind`, which is a drawing or an NC program."""

    path: Path
    name: str
    folder: bool = False
    example: bool = False
    kind: str = ""
    copy: KeptCopy | None = None

    @property
    def program(self) -> bool:
        """Whether it is the file of a contour program."""
        return self.copy is None and not (self.folder or self.kind)


def programs_of(folder: Path) -> tuple[Listed, ...]:
    """What a folder holds that can be opened, the examples, and kept copies; OSError where it cannot be read."""
    inside = within(FOLDER, lambda: tuple(_inside(folder)))
    parts = tuple(example_programs())
    # in their own folder the examples stand once, as examples
    programs = (each for each in inside if not each.folder and each.path not in {part.path for part in parts})
    folders = (each for each in inside if each.folder)
    copies = within(FOLDER, lambda: tuple(_copies(folder)))
    return (*programs, *parts, *folders, *copies)


def _copies(folder: Path) -> Iterator[Listed]:
    """The unsaved work on programs and NC texts that was set aside here, the last first."""
    state = state_folder()
    kept = (copy for kind in Kind for copy in kept_copies(folder, state, kind))
    for copy in sorted(set(kept), key=lambda copy: copy.time, reverse=True):
        yield Listed(copy.path, copy.name, copy=copy)


def example_programs() -> Iterator[Listed]:
    """The example parts."""
    for path in sorted(examples().glob("*.toml")):
        yield Listed(path, path.stem, example=True)


def _inside(folder: Path) -> Iterator[Listed]:
    with os.scandir(folder) as entries:
        inside = sorted(entries, key=lambda each: each.name.lower())
    programs = [each for each in inside if each.name.lower().endswith(".toml") and not each.is_dir()]
    shown = [each for each in inside if not each.name.startswith(".")]
    others = [(each, kind) for each in shown if (kind := _kind(each.name)) and not each.is_dir()]
    folders = [each for each in shown if each.is_dir()]
    saved = [path for path in (Path(each.path) for each in programs[:MAX_LISTED]) if is_program(path)]
    for path in sorted((*saved, *never_saved(folder, state_folder())), key=lambda path: path.name.lower()):
        yield Listed(path, path.name.removesuffix(".toml"))
    # drawings before NC programs
    for each, kind in sorted(others, key=lambda other: other[1] != DRAWING)[:MAX_LISTED]:
        if not _is_sheet(Path(each.path)):
            yield Listed(Path(each.path), each.name, kind=kind)
    for each in folders[:MAX_LISTED]:
        yield Listed(Path(each.path), f"{each.name}/", folder=True)


def _kind(name: str) -> str:
    """What a file is by its name, where it is no contour program."""
    path = Path(name)
    return DRAWING if is_drawing(path) else NC_PROGRAM if path.suffix.lower() in NC_SUFFIXES else ""


def _is_sheet(path: Path) -> bool:
    """Whether a text is the setup sheet of a program."""
    try:
        return path.suffix.lower() == ".txt" and read_start(path, len(SHEET_START)) == SHEET_START
    except OSError:
        return False
