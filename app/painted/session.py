"""The session: one frozen value with everything the screens are drawn from.

`App` owns the only one; every key makes a new one by the pure methods here.  Nothing that has been accepted is kept
anywhere else: a screen drawn afresh from the session equals the one that stands.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Final, NamedTuple

from app.documents.files import Stamp
from app.painted.guard import THE_WAY, UNGUARDED, Guard
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.outline import outline
from core.program.edit import Edited, FormPlace, Refused
from core.program.history import History
from core.program.model import Block, Program, Segment

SEGMENT: Final = "segment"
"""The name of the SEGMENT line, where the cursor walks from segment to segment."""


FIRST: Final = FormPlace(1, 0)
"""START of block 1."""


class Tone(StrEnum):
    """How a message on the prompt line is meant."""

    PLAIN = "plain"
    WARNING = "warning"
    ERROR = "error"


class Said(NamedTuple):
    """A sentence on the prompt line; it stays until the next key, or until one that does more than walk."""

    text: str
    tone: Tone = Tone.PLAIN
    stays: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Session:
    """What is being worked on.

    `where` and `field` are the cursor on the MILL CONTOUR form.  `file` is None until the program has a name, `saved`
    is the program as the file holds it.  `derived` belongs to `derived.program`, which lags behind only while a new
    one is being derived.  `title` names the example part that it began with.
    """

    history: History
    saved: Program
    derived: Derived
    file: Path | None = None
    where: FormPlace = FIRST
    field: str = SEGMENT
    said: Said | None = None
    guard: Guard = UNGUARDED
    title: str = ""

    @staticmethod
    def of(program: Program, file: Path | None = None, *, saved: Program | None = None) -> Session:
        """A session that begins with this program, the cursor on SEGMENT of START of block 1."""
        history, held = History(program), program if saved is None else saved
        return Session(history, held, outline(program), file, guard=Guard())

    @property
    def program(self) -> Program:
        """The program as it is now."""
        return self.history.program

    @property
    def unsaved(self) -> bool:
        """The file does not hold the program as it is now."""
        return self.program is not self.saved and self.program != self.saved

    @property
    def stale(self) -> bool:
        """`derived` is still that of an earlier program."""
        return self.derived.program is not self.program

    @property
    def block(self) -> Block:
        """The block with the cursor."""
        return self.program.blocks[self.where.block - 1]

    @property
    def segment(self) -> Segment | None:
        """The segment with the cursor, None on START."""
        return self.block.segments[self.where.segment - 1] if self.where.segment else None

    @property
    def found(self) -> DerivedBlock:
        """What is known of the block with the cursor."""
        return self.derived.block(self.where.block)

    def saying(self, text: str, tone: Tone = Tone.PLAIN, *, stays: bool = False) -> Session:
        """The session with a sentence on the prompt line."""
        return replace(self, said=Said(text, tone, stays))

    def quiet(self) -> Session:
        """The session with nothing to say."""
        return self if self.said is None else replace(self, said=None)

    def apply(self, edited: Edited, label: str) -> Session:
        """An edit taken, or the sentence why it is refused."""
        if isinstance(edited, Refused):
            return self.saying(edited.text, Tone.ERROR)
        if self.guard.looking:
            return self.saying(
                f"{self.guard.looking} Nothing can be changed but in your own copy. {THE_WAY}", Tone.ERROR
            )
        return self._with(self.history.do(edited, label))

    def undo(self) -> Session:
        """One edit taken back, saying which."""
        label = self.history.undo_label
        if label is None:
            return self.saying("There is nothing to undo.")
        return self._back(self.history.undo()).saying(f"Undone: {label}. Ctrl+Y brings it back.")

    def redo(self) -> Session:
        """One undone edit made again, saying which."""
        label = self.history.redo_label
        if label is None:
            return self.saying("There is nothing to redo.")
        return self._back(self.history.redo()).saying(f"Done again: {label}.")

    def at(self, where: FormPlace, field: str = SEGMENT) -> Session:
        """The cursor moved; a place that does not exist becomes the nearest one that does."""
        return replace(self, where=_nearest(self.program, where), field=field)

    def named(self, file: Path, stamp: Stamp | None = None, *, linked: bool = False) -> Session:
        """The session after its program was saved under a name, the file having this stamp now."""
        guard = self.guard if file == self.file else replace(self.guard, looking="", linked=False)
        guard = replace(guard, stamp=stamp, linked=guard.linked or linked)
        return replace(self, file=file, saved=self.program, guard=guard)

    def knowing(self, derived: Derived) -> Session:
        """The session with what follows from its program; a result for another program is dropped."""
        return replace(self, derived=derived) if derived.program is self.program else self

    def trying(self, derived: Derived) -> Session:
        """The session as it would be with another program; for showing only."""
        return replace(self, history=replace(self.history, program=derived.program), derived=derived)

    def _back(self, history: History) -> Session:
        """The history with the cursor on what it changed."""
        from app.session.changes import changed

        place = changed(self.program, history.program)
        there = self._with(history)
        return there if place is None else there.at(place[0], place[1] or SEGMENT)

    def _with(self, history: History) -> Session:
        where = _nearest(history.program, self.where)
        same = where == self.where and _kind(history.program, where) is _kind(self.program, where)
        return replace(self, history=history, where=where, field=self.field if same else SEGMENT)


def _nearest(program: Program, where: FormPlace) -> FormPlace:
    block = min(max(where.block, 1), len(program.blocks))
    return FormPlace(block, min(max(where.segment, 0), len(program.blocks[block - 1].segments)))


def _kind(program: Program, where: FormPlace) -> type[Segment] | None:
    return type(program.blocks[where.block - 1].segments[where.segment - 1]) if where.segment else None
