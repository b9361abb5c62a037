"""Undo and redo: every program the operator has had, each with the words for the edit that left it."""

from __future__ import annotations

from dataclasses import dataclass

from core.program.model import Program


@dataclass(frozen=True, slots=True)
class Step:
    """A program and what the edit was called that led away from it."""

    program: Program
    label: str


@dataclass(frozen=True, slots=True)
class History:
    """The program as it is, with those before it (oldest first) and those undone (the last undone last)."""

    program: Program
    past: tuple[Step, ...] = ()
    future: tuple[Step, ...] = ()

    def do(self, program: Program, label: str) -> History:
        """The history with an edit made; an edit that changes nothing leaves it as it is."""
        if program == self.program:
            return self
        return History(program, (*self.past, Step(self.program, label)))

    def undo(self) -> History:
        """One edit taken back; as it is when there is none."""
        if not self.past:
            return self
        *earlier, last = self.past
        return History(last.program, tuple(earlier), (*self.future, Step(self.program, last.label)))

    def redo(self) -> History:
        """One edit made again; as it is when none was taken back."""
        if not self.future:
            return self
        *later, following = self.future
        return History(following.program, (*self.past, Step(self.program, following.label)), tuple(later))

    @property
    def undo_label(self) -> str | None:
        """What the next undo takes back."""
        return self.past[-1].label if self.past else None

    @property
    def redo_label(self) -> str | None:
        """What the next redo makes again."""
        return self.future[-1].label if self.future else None

    @property
    def undo_count(self) -> int:
        """How many edits can be taken back."""
        return len(self.past)

    @property
    def redo_count(self) -> int:
        """How many edits can be made again."""
        return len(self.future)
