"""This module lists the files of a folder that can be opened, with each contour program's date, tools and verdict."""

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
from app.documents.lock import alive, user
from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import is_drawing
from app.documents.programs import examples, is_program
from app.documents.time_limits import FILE_SECONDS, FOLDER_SECONDS, within
from app.documents.unsaved_work import (
    KeptCopy,
    kept_copies,
    never_saved,
    state_folder,
    unsaved_work_on,
    work_of_dead_processes,
)
from core.finding import Severity
from core.pipeline.derived import DerivedBlock
from core.program.file.read import StoreError
from core.program.model import Number, Program

MAX_LISTED: Final = 500
"""The most programs, other files and folders that are listed, each; others are opened by typing a path."""
DRAWING: Final = "drawing"
NC_PROGRAM: Final = "NC program"
SHEET_START: Final = b"SETUP SHEET\n"
"""The first line of a setup sheet, which is no NC program."""


class Outcome(StrEnum):
    """The verdict on a file in one word, the gravest first; unsaved work comes before every verdict."""

    NOT_SAVED = "not saved"
    OPEN = "open"
    GOUGE = "gouge"
    NOT_READY = "not ready"
    UNREADABLE = "unreadable"
    UNCUT = "uncut"
    WARNING = "warning"
    CLEAN = "clean"
    EMPTY = "empty"


@dataclass(frozen=True, slots=True)
class Facts:
    """What is known of a file, valid while its `stamp` (time and size) stays the same; `trouble` is a sentence."""

    path: Path
    stamp: tuple[int, int] = (0, 0)
    changed: datetime | None = None
    blocks: str = ""
    tools: str = ""
    outcome: Outcome | None = None
    trouble: str = ""


def facts_of(path: Path, known: Facts | None = None) -> Facts:
    """Return the facts of a file on disk; call this in a worker, since it derives the whole program."""
    try:
        facts, program = within(FILE_SECONDS, lambda: _read(path, known))
    except TimeoutError as error:
        return Facts(path, outcome=Outcome.UNREADABLE, trouble=f"{path.name}: {error}.")
    if program is None:
        return facts
    # imported here, since the first paint needs neither numpy nor shapely
    from core.pipeline.derive import derive

    outcomes = map(outcome_of, derive(program).blocks)
    gravest = min(outcomes, key=list(Outcome).index, default=Outcome.EMPTY)
    return replace(facts, blocks=str(len(program.blocks)), tools=_tools(program), outcome=gravest)


def _read(path: Path, known: Facts | None) -> tuple[Facts, Program | None]:
    """Return what the disk says of a file, and its program if that must still be judged."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return _without_file(path), None
    stamp = (status.st_mtime_ns, status.st_size)
    left = list(work_of_dead_processes(path, state_folder(), user()))
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
    """Return the facts of a program without a file: it was never saved, or the file is gone."""
    gone = Facts(path, outcome=Outcome.UNREADABLE)
    try:
        left = [journal for _, journal in unsaved_work_on(path, Kind.CONTOUR, state_folder())]
    except (OSError, ValueError):
        left = []
    journals = [journal for journal in left if isinstance(journal, Journal)]
    if any(not alive(journal.owner) for journal in journals):
        return _not_saved(gone)
    if journals:
        return replace(gone, outcome=Outcome.OPEN, trouble="This program is open and has not been saved yet.")
    if left:
        return replace(gone, trouble="Unsaved work on this program cannot be read. It is kept; opening it says where.")
    return replace(gone, trouble="This file is not there any more, or its folder cannot be read.")


def _not_saved(facts: Facts) -> Facts:
    text = "There is unsaved work on this program. Opening it asks whether you want it back."
    return replace(facts, outcome=Outcome.NOT_SAVED, trouble=text)


def outcome_of(block: DerivedBlock) -> Outcome:
    """Return the verdict on a block in one word."""
    if block.errors:
        gouges = any(finding.code.endswith(("GOUGE", "GOUGES", "WRONG_SIDE")) for finding in block.errors)
        return Outcome.GOUGE if gouges else Outcome.NOT_READY
    verdict = None if block.paths is None else block.paths.verdict
    if verdict is not None and verdict.uncut:
        return Outcome.UNCUT
    warned = any(finding.severity is Severity.WARNING for finding in block.findings)
    return Outcome.WARNING if warned else Outcome.CLEAN


def _tools(program: Program) -> str:
    """Return the numbers of the tools that the blocks call, in ascending order."""
    typed = [value for block in program.blocks for value in (block.tool, block.finish_tool)]
    called = {value.value for value in typed if isinstance(value, Number) and value.value > 0.0}
    return " ".join(f"{number:g}" for number in sorted(called))


def day_of(changed: datetime, now: datetime) -> str:
    """Return a file's time in a few cells: the time if today, weekday and date within a week, else the date."""
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
        """True if it is the file of a contour program."""
        return self.copy is None and not (self.folder or self.kind)


def openable_files(folder: Path) -> tuple[Listed, ...]:
    """Return a folder's files that can be opened, examples and kept copies; raise OSError if it cannot be read."""
    entries = within(FOLDER_SECONDS, lambda: tuple(_listed_files(folder)))
    parts = tuple(example_programs())
    # in the folder of the examples, list each of them only once, as an example
    programs = (entry for entry in entries if not entry.folder and entry.path not in {part.path for part in parts})
    folders = (entry for entry in entries if entry.folder)
    copies = within(FOLDER_SECONDS, lambda: kept_copies(folder, state_folder()))
    return (*programs, *parts, *folders, *(Listed(copy.path, copy.name, copy=copy) for copy in copies))


def example_programs() -> Iterator[Listed]:
    """Yield the example parts, by name."""
    for path in sorted(examples().glob("*.toml")):
        yield Listed(path, path.stem, example=True)


def _listed_files(folder: Path) -> Iterator[Listed]:
    with os.scandir(folder) as scanned:
        entries = sorted(scanned, key=lambda entry: entry.name.lower())
    programs = [entry for entry in entries if entry.name.lower().endswith(".toml") and not entry.is_dir()]
    visible = [entry for entry in entries if not entry.name.startswith(".")]
    others = [(entry, kind) for entry in visible if (kind := _kind(entry.name)) and not entry.is_dir()]
    folders = [entry for entry in visible if entry.is_dir()]
    saved = [path for path in (Path(entry.path) for entry in programs[:MAX_LISTED]) if is_program(path)]
    for path in sorted((*saved, *never_saved(folder, state_folder())), key=lambda path: path.name.lower()):
        yield Listed(path, path.name.removesuffix(".toml"))
    # drawings before NC programs
    for entry, kind in sorted(others, key=lambda other: other[1] != DRAWING)[:MAX_LISTED]:
        path = Path(entry.path)
        if path.suffix.lower() != ".txt" or read_start(path, len(SHEET_START)) != SHEET_START:
            yield Listed(path, entry.name, kind=kind)
    for entry in folders[:MAX_LISTED]:
        yield Listed(Path(entry.path), f"{entry.name}/", folder=True)


def _kind(name: str) -> str:
    """Return the kind of a drawing or an NC program by its file name, empty for any other file."""
    path = Path(name)
    return DRAWING if is_drawing(path) else NC_PROGRAM if path.suffix.lower() in NC_SUFFIXES else ""
