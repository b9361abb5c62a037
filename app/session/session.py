"""The session: one frozen value with everything the screens show.

The App owns the only one; every accepted field makes a new one by the pure methods here.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.session.changes import changed
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.fields_stage import solve_fields
from core.program.edit import FormPlace, is_empty
from core.program.history import History
from core.program.model import Block, Program, Segment

if TYPE_CHECKING:
    from core.advice.lookahead_table import Table

SEGMENT: Final = "segment"
"""The name of the SEGMENT line, where the cursor walks from segment to segment."""

START_OF_FIRST_BLOCK: Final = FormPlace(1, 0)


@dataclass(frozen=True, eq=False, slots=True)
class Cursor:
    """Where a move has put the cursor of the MILL CONTOUR form: the segment, and the field to begin with, if any.

    Every move makes a new one, so that a screen knows a move by its identity; from there the focus goes its own way.
    """

    place: FormPlace = START_OF_FIRST_BLOCK
    field: str | None = SEGMENT


@dataclass(frozen=True, eq=False, slots=True)
class Session:
    """What is being worked on.

    `file` is None until the program has a name, `saved` is the program as the file holds it.  `derived` always belongs
    to `program`: without paths at first, in full once the worker is done.  `title` names the example it began with.
    `table` is the look-ahead table of the block that it was made of.  `look_only`: somebody else has the file open.
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
        """A session that begins with this program, the cursor on START of block 1."""
        cursor = Cursor(field=_first_field(program))
        return Session(History(program), program, solve_fields(program), cursor, title=title)

    @staticmethod
    def of_history(
        history: History,
        saved: Program,
        place: FormPlace,
        field: str,
        file: Path | None,
        title: str,
        *,
        look_only: bool = False,
    ) -> Session:
        """A session on work that has a history, the cursor where it was; in a new program in its first field."""
        if field == SEGMENT and not history.past:
            field = _first_field(history.program)
        cursor = Cursor(nearest_place(history.program, place), field)
        derived = solve_fields(history.program)
        return Session(history, saved, derived, cursor, file, title, look_only=look_only)

    def like(self, before: Session) -> Session:
        """The session with what was known of the same program before."""
        return replace(self, derived=before.derived, cursor=before.cursor, table=before.table)

    @property
    def program(self) -> Program:
        """The program as it is now."""
        return self.history.program

    @property
    def unsaved(self) -> bool:
        """The file does not hold the program as it is now."""
        return self.program is not self.saved and self.program != self.saved

    @property
    def file_label(self) -> str:
        """The program's name as screens show it; a star where something is not saved."""
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
        """The segment with the cursor, None on START."""
        return self.block.segments[self.place.segment - 1] if self.place.segment else None

    @property
    def derived_block(self) -> DerivedBlock:
        """What follows from the block with the cursor."""
        return self.derived.block(self.place.block)

    @property
    def lookahead_table(self) -> Table | None:
        """The look-ahead table of the block with the cursor, None until it is known."""
        return self.table[1] if self.table is not None and self.table[0] is self.derived_block else None

    def with_program(self, program: Program, label: str) -> Session:
        """The session after an edit."""
        return self._with_history(self.history.do(program, label))

    def undone(self) -> Session:
        """One edit taken back, the cursor on what it had changed."""
        return self._moved_to_change(self.history.undo())

    def redone(self) -> Session:
        """One undone edit made again, the cursor on what it changes."""
        return self._moved_to_change(self.history.redo())

    def at(self, place: FormPlace, field: str | None = SEGMENT) -> Session:
        """The cursor moved; a place that does not exist becomes the nearest one that does."""
        return replace(self, cursor=Cursor(nearest_place(self.program, place), field))

    def without_empty(self) -> Session:
        """The session with the making of the new segment with the cursor undone, where nothing was typed in it."""
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

    def knowing(self, derived: Derived) -> Session:
        """The session with what follows from its program; a result for another program is dropped."""
        return replace(self, derived=derived) if derived.program is self.program else self

    def with_table(self, block: DerivedBlock, table: Table | None) -> Session:
        """The session with the look-ahead table of a block, as long as that block is what is worked on."""
        return replace(self, table=(block, table)) if block in self.derived.blocks else self

    def trying(self, derived: Derived) -> Session:
        """The session as it would be with another program; only to be shown."""
        return replace(self, history=replace(self.history, program=derived.program), derived=derived)

    def _moved_to_change(self, history: History) -> Session:
        place = changed(self.program, history.program)
        session = self._with_history(history)
        return session if place is None else session.at(place[0], place[1] or SEGMENT)

    def _with_history(self, history: History) -> Session:
        if history is self.history:
            return self
        place = nearest_place(history.program, self.place)
        same_form = place == self.place and _kind(history.program, place) is _kind(self.program, place)
        cursor = self.cursor if same_form else Cursor(place)
        return replace(self, history=history, derived=solve_fields(history.program), cursor=cursor)


def _first_field(program: Program) -> str:
    """Where the cursor begins: in TOOL of a new program, else on SEGMENT."""
    new = len(program.blocks) == 1 and not program.blocks[0].segments and program.blocks[0].x_start is None
    return "tool" if new else SEGMENT


def nearest_place(program: Program, place: FormPlace) -> FormPlace:
    """The place, or the nearest one that the program has."""
    block = min(max(place.block, 1), len(program.blocks))
    return FormPlace(block, min(max(place.segment, 0), len(program.blocks[block - 1].segments)))


def _kind(program: Program, place: FormPlace) -> type[Segment] | None:
    return type(program.blocks[place.block - 1].segments[place.segment - 1]) if place.segment else None
