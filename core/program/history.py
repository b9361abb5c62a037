"""This module keeps programs for undo and redo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

from core.program.model import Program


@dataclass(frozen=True, slots=True)
class UndoStep:
    """A program, and the label of the edit that separates it from its neighbor in the history."""

    program: Program
    label: str


@dataclass(frozen=True, slots=True)
class History:
    """The current program, the earlier ones (oldest first) and the undone ones (the last undone last)."""

    program: Program
    past: tuple[UndoStep, ...] = ()
    future: tuple[UndoStep, ...] = ()

    def do(self, program: Program, label: str) -> History:
        """Return the history after an edit; an edit that changes nothing leaves the history unchanged."""
        if program == self.program:
            return self
        return History(program, (*self.past, UndoStep(self.program, label)))

    def undo(self) -> History:
        """Return the history with one edit undone, unchanged if there is none."""
        if not self.past:
            return self
        *earlier, last = self.past
        return History(last.program, tuple(earlier), (*self.future, UndoStep(self.program, last.label)))

    def redo(self) -> History:
        """Return the history with one edit redone, unchanged if none was undone."""
        if not self.future:
            return self
        *later, following = self.future
        return History(following.program, (*self.past, UndoStep(self.program, following.label)), tuple(later))

    @property
    def undo_label(self) -> str | None:
        """The label of the edit that the next undo reverses, None if there is none."""
        return self.past[-1].label if self.past else None

    @property
    def redo_label(self) -> str | None:
        """The label of the edit that the next redo repeats, None if there is none."""
        return self.future[-1].label if self.future else None

    @property
    def undo_count(self) -> int:
        """The number of edits that can be undone."""
        return len(self.past)

    @property
    def redo_count(self) -> int:
        """The number of edits that can be redone."""
        return len(self.future)


Item = TypeVar("Item")


@dataclass(frozen=True, slots=True)
class Splice(Generic[Item]):
    """The items of one tuple that those of another replace, from index `at` (0 is the first)."""

    at: int
    old: tuple[Item, ...]
    new: tuple[Item, ...]


def splice(old: tuple[Item, ...], new: tuple[Item, ...]) -> Splice[Item]:
    """Return the shortest middle part in which two tuples differ."""
    shorter = min(len(old), len(new))
    front = next((index for index in range(shorter) if not same(old[index], new[index])), shorter)
    remaining = shorter - front
    back = next((step for step in range(remaining) if not same(old[-1 - step], new[-1 - step])), remaining)
    return Splice(front, old[front : len(old) - back], new[front : len(new) - back])


def same(first: object, second: object) -> bool:
    """True if two parts are equal; fast if they are the same object."""
    return first is second or first == second
