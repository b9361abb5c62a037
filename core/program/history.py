"""This module keeps programs for undo and redo, and describes the differences of two programs for the operator."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from core.program.edit import set_unit
from core.program.fields import STORED_FIELDS, Form, form_of
from core.program.model import Block, Number, PartSetup, Program, ProgramParameters, Relative, Segment, Tool, Unread
from core.units import Kind, Unit, printable, show


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

FormPart = Block | Segment | Tool | ProgramParameters | PartSetup


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
    most = shorter - front
    back = next((step for step in range(most) if not same(old[-1 - step], new[-1 - step])), most)
    return Splice(front, old[front : len(old) - back], new[front : len(new) - back])


def same(first: object, second: object) -> bool:
    """True if two parts are equal; fast if they are the same object."""
    return first is second or first == second


def differences(old: Program, new: Program) -> tuple[str, ...]:
    """Return a sentence for each difference in fields, segments, blocks and tools; none if the programs are equal."""
    return tuple(_differences(old, new))


def _differences(old: Program, new: Program) -> Iterator[str]:
    if old.unit is not new.unit:
        yield f"Program units: {new.unit}, was {old.unit}."
        old = set_unit(old, new.unit)
    yield from _fields("PROGRAM PARAMETERS", Form.PARAMETERS, old.parameters, new.parameters, new.unit)
    yield from _fields("PART SETUP", Form.SETUP, old.setup, new.setup, new.unit)
    yield from _tools(old, new)
    yield from _blocks(old.blocks, new.blocks, new.unit)


def _fields(where: str, form: Form, old: FormPart, new: FormPart, unit: Unit) -> Iterator[str]:
    for field in STORED_FIELDS[form]:
        before, after = getattr(old, field.name), getattr(new, field.name)
        if before != after:
            yield f"{where}: {field.label} {_text(after, field.kind, unit)}, was {_text(before, field.kind, unit)}."
    if getattr(old, "choice", None) != getattr(new, "choice", None):
        yield f"{where}: solution changed."


def _text(value: object, kind: Kind, unit: Unit) -> str:
    match value:
        case Number(number):
            return show(number, kind, unit)
        case Relative(number):
            return f"I{show(number, kind, unit)}"
        case bool():
            return "YES" if value else "NO"
        case Unread(text):
            return f"{printable(text)} (cannot be used)"
        case None | "":
            return "blank"
        case StrEnum():
            return value.value
        case _:
            return printable(str(value))


def _tools(old: Program, new: Program) -> Iterator[str]:
    before, after = ({tool.number: tool for tool in program.tools} for program in (old, new))
    for number in sorted(before.keys() | after.keys()):
        if number not in before:
            yield f"Tool {number} is new."
        elif number not in after:
            yield f"Tool {number} is deleted."
        else:
            yield from _fields(f"Tool {number}", Form.TOOL, before[number], after[number], new.unit)


def _blocks(old: tuple[Block, ...], new: tuple[Block, ...], unit: Unit) -> Iterator[str]:
    middle = splice(old, new)
    if len(middle.old) != len(middle.new):
        yield _replaced("Block", "", middle.at, len(middle.old), len(middle.new))
        return
    for number, (before, after) in enumerate(zip(middle.old, middle.new, strict=True), middle.at + 1):
        yield from _fields(f"Block {number}", Form.START, before, after, unit)
        yield from _segments(f"Block {number}", before.segments, after.segments, unit)


def _segments(where: str, old: tuple[Segment, ...], new: tuple[Segment, ...], unit: Unit) -> Iterator[str]:
    middle = splice(old, new)
    if len(middle.old) != len(middle.new):
        yield _replaced("segment", f"{where}, ", middle.at, len(middle.old), len(middle.new))
        return
    for number, (before, after) in enumerate(zip(middle.old, middle.new, strict=True), middle.at + 1):
        place, form = f"{where}, segment {number}", form_of(after)
        if type(before) is type(after):
            yield from _fields(place, form, before, after, unit)
        else:
            yield f"{place}: {form.value}, was {form_of(before).value}."


def _replaced(thing: str, where: str, at: int, old: int, new: int) -> str:
    """Describe how many items were deleted and inserted from index `at` on."""
    if old == 0:
        return f"{where}{_run(thing, at, new)} {'is' if new == 1 else 'are'} new."
    if new == 0:
        return f"{where}{_run(thing, at, old)} {'is' if old == 1 else 'are'} deleted."
    return f"{where}{_run(thing, at, old)}: {old} replaced by {new}."


def _run(thing: str, at: int, count: int) -> str:
    return f"{thing} {at + 1}" if count == 1 else f"{thing}s {at + 1} to {at + count}"
