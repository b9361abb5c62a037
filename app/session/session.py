"""The session is one frozen value with everything the screens show.

The App holds the current one; every accepted field makes a new one with the pure methods here.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

from core.pipeline.derived import Derived, DerivedBlock, solve_fields
from core.program.edit import FIRST_START, SEGMENT_FIELD, FormPlace, is_empty
from core.program.history import History, splice
from core.program.model import Block, Program, Segment

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table


@dataclass(frozen=True, eq=False, slots=True)
class Cursor:
    """The target of a cursor move on the MILL CONTOUR form: the segment, and the field to focus, if any.

    Every move makes a new cursor, so that a screen detects a move by identity; later focus changes are not recorded.
    """

    place: FormPlace = FIRST_START
    field: str | None = SEGMENT_FIELD


@dataclass(frozen=True, eq=False, slots=True)
class Session:
    """The current work.

    `file` is None until the program has a name; `saved` is the program in the file.  `derived` always belongs to
    `program`: without paths at first, complete once the worker is done.  `title` names the example it started from.
    `table` is a block and its look-ahead table.  `look_only`: someone else has the file open.
    """

    history: History
    saved: Program
    derived: Derived
    cursor: Cursor
    file: Path | None = None
    title: str = ""
    table: tuple[DerivedBlock, Table | None] | None = None
    look_only: bool = False

    @staticmethod
    def of(program: Program, title: str = "") -> Session:
        """Return a session that starts with this program, with the cursor on START of block 1."""
        cursor = Cursor(field=_first_field(program))
        return Session(History(program), program, solve_fields(program), cursor, title=title)

    @property
    def program(self) -> Program:
        """The current program."""
        return self.history.program

    @property
    def unsaved(self) -> bool:
        """True if the file does not hold the current program."""
        return self.program is not self.saved and self.program != self.saved

    @property
    def file_label(self) -> str:
        """The program's name as screens show it, with a star if it has unsaved changes."""
        if self.look_only:
            return f"LOOK ONLY {self.file.stem if self.file else ''}"
        name = self.file.stem if self.file else f"{self.title} (example)" if self.title else "NO NAME"
        return f"{name}{' *' if self.unsaved else ''}"

    @property
    def place(self) -> FormPlace:
        """The block and the segment with the cursor."""
        return self.cursor.place

    @property
    def block(self) -> Block:
        """The block with the cursor."""
        return self.program.blocks[self.place.block - 1]

    @property
    def segment(self) -> Segment | None:
        """The segment with the cursor; None on START."""
        return self.block.segments[self.place.segment - 1] if self.place.segment else None

    @property
    def derived_block(self) -> DerivedBlock:
        """The derived block with the cursor."""
        return self.derived.block(self.place.block)

    @property
    def lookahead_table(self) -> Table | None:
        """The look-ahead table of the block with the cursor; None until it is known."""
        return self.table[1] if self.table is not None and self.table[0] is self.derived_block else None

    def with_program(self, program: Program, label: str) -> Session:
        """Return the session after an edit."""
        return self._with_history(self.history.do(program, label))

    def undone(self) -> Session:
        """Return the session with one edit undone and the cursor on what it had changed."""
        return self._moved_to_change(self.history.undo())

    def redone(self) -> Session:
        """Return the session with one edit redone and the cursor on what it changes."""
        return self._moved_to_change(self.history.redo())

    def at(self, place: FormPlace, field: str | None = SEGMENT_FIELD) -> Session:
        """Return the session with the cursor moved to a place, or to the nearest one that exists."""
        return replace(self, cursor=Cursor(nearest_place(self.program, place), field))

    def without_empty(self) -> Session:
        """Return the session with the insertion of an empty new segment at the cursor undone, if there is one."""
        segment, history = self.segment, self.history
        if segment is None or not is_empty(segment) or not (history.undo_label or "").startswith("new "):
            return self
        undone = history.undo()
        same = len(undone.program.blocks) == len(self.program.blocks)
        before = undone.program.blocks[self.place.block - 1].segments if same else ()
        at = self.place.segment - 1
        if (*self.block.segments[:at], *self.block.segments[at + 1 :]) != before:
            return self
        return self._with_history(undone)

    def with_derived(self, derived: Derived) -> Session:
        """Return the session with its program's derivation; ignore a result for another program."""
        return replace(self, derived=derived) if derived.program is self.program else self

    def with_table(self, block: DerivedBlock, table: Table | None) -> Session:
        """Return the session with a block's look-ahead table; ignore it if the block is outdated."""
        return replace(self, table=(block, table)) if block in self.derived.blocks else self

    def with_trial(self, derived: Derived) -> Session:
        """Return the session as it would be with another program, for display only."""
        return replace(self, history=replace(self.history, program=derived.program), derived=derived)

    def _moved_to_change(self, history: History) -> Session:
        place = changed(self.program, history.program)
        session = self._with_history(history)
        return session if place is None else session.at(place[0], place[1] or SEGMENT_FIELD)

    def _with_history(self, history: History) -> Session:
        if history is self.history:
            return self
        place = nearest_place(history.program, self.place)
        same_form = place == self.place and _kind(history.program, place) is _kind(self.program, place)
        cursor = self.cursor if same_form else Cursor(place)
        return replace(self, history=history, derived=solve_fields(history.program), cursor=cursor)


def _first_field(program: Program) -> str:
    """Return the field where the cursor starts: TOOL in a new program, else SEGMENT."""
    new = len(program.blocks) == 1 and not program.blocks[0].segments and program.blocks[0].x_start is None
    return "tool" if new else SEGMENT_FIELD


def nearest_place(program: Program, place: FormPlace) -> FormPlace:
    """Return the place, or the nearest one that the program has."""
    block = min(max(place.block, 1), len(program.blocks))
    return FormPlace(block, min(max(place.segment, 0), len(program.blocks[block - 1].segments)))


def _kind(program: Program, place: FormPlace) -> type[Segment] | None:
    return type(program.blocks[place.block - 1].segments[place.segment - 1]) if place.segment else None


def changed(before: Program, after: Program) -> tuple[FormPlace, str | None] | None:
    """Return the changed segment in `after`, with the name of its field if exactly one differs.

    None if the unit, no block, or several of equally many blocks differ.
    """
    if before.unit is not after.unit:
        return None
    blocks = splice(before.blocks, after.blocks)
    if len(before.blocks) != len(after.blocks):
        return FormPlace(blocks.at + 1), None
    return _in_block(blocks.old[0], blocks.new[0], blocks.at + 1) if len(blocks.new) == 1 else None


def _in_block(before: Block, after: Block, number: int) -> tuple[FormPlace, str | None]:
    names = _names(before, after)
    if "segments" not in names:
        return FormPlace(number), names[0] if len(names) == 1 else None
    segments = splice(before.segments, after.segments)
    here = FormPlace(number, min(segments.at + 1, len(after.segments)))
    if len(before.segments) != len(after.segments):
        return here, None
    names = _names(segments.old[0], segments.new[0])
    return here, names[0] if len(names) == 1 else None


def _names(before: Block | Segment, after: Block | Segment) -> list[str]:
    """Return the names of the fields that differ; none for two segments of different kinds."""
    if type(before) is not type(after):
        return []
    return [field.name for field in fields(before) if getattr(before, field.name) != getattr(after, field.name)]
