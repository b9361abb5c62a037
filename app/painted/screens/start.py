"""START: recent programs, a folder's programs with what is known of them, the examples, a new program, the guide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType
from typing import ClassVar, Final

from app.painted.messages import Browse, Close, Do, Leave, Load, Message
from app.painted.screens.page import Answer, Layout, Page, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session, Tone
from app.painted.survey import Facts
from app.painted.widgets.header import printable
from app.painted.widgets.rows import Look, Row, Span, plain, shortened
from core.units import Unit

PROMPT: Final = (
    "Up and down choose, Enter opens; a letter goes to the next name that begins with it. ? tells every key."
)
STEPS: Final = {"up": -1, "down": 1, "pageup": -10, "pagedown": 10}
SHOWN: Final = 500
"""So many files of a folder are listed; more are reached by typing a path."""


class Group(StrEnum):
    """Where an item comes from; the list has a heading for each."""

    RECENT = "RECENT"
    FOLDER = "FOLDER"
    EXAMPLE = "EXAMPLES"


@dataclass(frozen=True, slots=True)
class Entry:
    """One line that can be chosen: a program, or a folder to go to."""

    group: Group
    path: Path
    name: str
    folder: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class StartPage(Page):
    """The list; `facts` are known, those of `unseen` are still to be found out or to be checked again.

    `first` is the screen the program begins with: its last softkey then leaves the program.  `trouble` is why there is
    no folder on it.
    """

    layout: ClassVar[Layout] = Layout.TEXT
    folder: Path = Path()
    entries: tuple[Entry, ...] = ()
    unit: Unit = Unit.IN
    first: bool = False
    row: int = 0
    facts: Mapping[Path, Facts] = field(default_factory=lambda: MappingProxyType({}))
    unseen: tuple[Path, ...] = ()
    trouble: str = ""

    @property
    def entry(self) -> Entry | None:
        """The line with the cursor."""
        return self.entries[min(self.row, len(self.entries) - 1)] if self.entries else None

    @property
    def wanted(self) -> Path | None:
        """The file to look at next: that under the cursor, else the first below it."""
        here = [entry.path for entry in (*self.entries[self.row :], *self.entries[: self.row])]
        return next((path for path in here if path in self.unseen), None)

    def knowing(self, facts: Facts) -> StartPage:
        """The page after a file was looked at."""
        unseen = tuple(path for path in self.unseen if path != facts.path)
        return replace(self, facts=MappingProxyType({**self.facts, facts.path: facts}), unseen=unseen)

    def softkeys(self, session: Session) -> Softkeys:
        """Open, new, a path, the guide."""
        from app.painted.starting import guide, other_unit, walk

        other, name = (Unit.MM, "MM") if self.unit is Unit.IN else (Unit.IN, "INCH")
        return {
            1: Softkey("OPEN", self._chosen()),
            2: Softkey(f"NEW PROGRAM ({self.unit})", (Load(None),)),
            3: Softkey(f"{name} FOR NEW PROGRAMS", (Do(other_unit(other)),)),
            4: Softkey("OPEN A PATH", (Browse(self.folder),)),
            5: Softkey("FOLDER ABOVE", (Do(walk(self.folder.parent)),)),
            7: Softkey("GUIDED FIRST PART", (Do(guide),)),
            8: Softkey("EXIT", (Leave() if self.first else Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Walking over the list."""
        from app.painted.starting import walk

        last = max(len(self.entries) - 1, 0)
        if key in STEPS:
            return Answer(replace(self, row=min(max(self.row + STEPS[key], 0), last)))
        if key in ("home", "end"):
            return Answer(replace(self, row=0 if key == "home" else last))
        if key in ("enter", "right"):
            return Answer(self, self._chosen())
        if key in ("left", "backspace"):
            return Answer(self, (Do(walk(self.folder.parent)),))
        return self._lettered(character) if character is not None and character.isalnum() else None

    def _lettered(self, character: str) -> Answer:
        order = [*range(self.row + 1, len(self.entries)), *range(self.row + 1)]
        fits = (row for row in order if self.entries[row].name.lower().startswith(character.lower()))
        return Answer(replace(self, row=next(fits, self.row)))

    def _chosen(self) -> tuple[Message, ...]:
        from app.painted.starting import walk

        entry = self.entry
        if entry is None:
            return ()
        return (Do(walk(entry.path)),) if entry.folder else (Load(entry.path),)

    def help(self, session: Session) -> tuple[str, ...]:
        """What the columns say."""
        return (
            "START",
            "Programs that were open lately, the programs of a folder, and example parts.",
            "Enter opens a program or goes into a folder; left arrow or Backspace goes to the folder above.",
            "VERDICT is that of the whole program: clean, uncut (material stays), warning, GOUGE, not ready (something "
            "is missing or cannot be used), not saved (work on it was left behind), unreadable (no program of this "
            "kind), gone. It appears when it is calculated.",
            "F2 begins a new program, F7 leads through a first part key by key.",
        )

    def view(self, session: Session, surface: Surface) -> View:
        """The list with its headings, the line with the cursor in sight."""
        rows, at = self._rows(surface.width)
        room = max(surface.body - 1, 1)
        top = max(0, min(at - room // 2, len(rows) - room))
        where = printable(str(self.entry.path if self.entry else self.folder))
        headings = plain(f"  {'PROGRAM':<{_name(surface.width)}} {'DATE':<10} BLK {'TOOLS':<7} VERDICT", Look.LABEL)
        return View(
            (plain(" START", Look.HEAD), plain(f" {where[-(surface.width - 2) :]}", Look.LABEL)),
            (headings, *rows[top : top + room]),
            self._said(),
            1 + at - top,
        )

    def _said(self) -> Said:
        known = self.facts.get(self.entry.path) if self.entry else None
        trouble = self.trouble or (known.trouble if known is not None else "")
        return Said(trouble, Tone.WARNING) if trouble else Said(PROMPT)

    def _rows(self, width: int) -> tuple[list[Row], int]:
        """Every line, and which has the cursor."""
        rows: list[Row] = []
        at, group = 0, None
        for index, entry in enumerate(self.entries):
            if entry.group is not group:
                group = entry.group
                rows.append(plain(f" {group}", Look.HEAD))
            if index == self.row:
                at = len(rows)
            rows.append(_entry_row(entry, self.facts.get(entry.path), width, on_it=index == self.row))
        return rows, at


def _name(width: int) -> int:
    """Cells for a name: what the other columns leave."""
    return min(max(width - 37, 8), 60)


def _entry_row(entry: Entry, facts: Facts | None, width: int, *, on_it: bool) -> Row:
    room = _name(width)
    name = printable(entry.name) + ("/" if entry.folder else "")
    name = shortened(name, room)
    mark = Span("> " if on_it else "  ", Look.TAG)
    look = Look.CURSOR if on_it else Look.TYPED
    if entry.folder:
        return (mark, Span(name, look))
    known = facts or Facts(entry.path)
    tools = known.tools if len(known.tools) <= 7 else f"{known.tools[:6]}…"
    text = f" {known.date:<10} {known.blocks:>3} {tools:<7} "
    return (mark, Span(f"{name:<{room}}", look), Span(text, Look.LABEL), Span(known.word, known.look))
