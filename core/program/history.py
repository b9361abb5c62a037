"""Undo and redo: every program the operator has had, and what differs between two of them in an operator's words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from core.program.edit import set_unit
from core.program.fields import STORED, Form, form_of
from core.program.model import Block, Number, PartSetup, Program, ProgramParameters, Relative, Segment, Tool, Unread
from core.units import Kind, Unit, printable, show


@dataclass(frozen=True, slots=True)
class UndoStep:
    """A program and what the edit was called that led away from it."""

    program: Program
    label: str


@dataclass(frozen=True, slots=True)
class History:
    """The program as it is, with those before it (oldest first) and those undone (the last undone last)."""

    program: Program
    past: tuple[UndoStep, ...] = ()
    future: tuple[UndoStep, ...] = ()

    def do(self, program: Program, label: str) -> History:
        """The history with an edit made; an edit that changes nothing leaves it as it is."""
        if program == self.program:
            return self
        return History(program, (*self.past, UndoStep(self.program, label)))

    def undo(self) -> History:
        """One edit taken back; as it is when there is none."""
        if not self.past:
            return self
        *earlier, last = self.past
        return History(last.program, tuple(earlier), (*self.future, UndoStep(self.program, last.label)))

    def redo(self) -> History:
        """One edit made again; as it is when none was taken back."""
        if not self.future:
            return self
        *later, following = self.future
        return History(following.program, (*self.past, UndoStep(self.program, following.label)), tuple(later))

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


Item = TypeVar("Item")

FormPart = Block | Segment | Tool | ProgramParameters | PartSetup


@dataclass(frozen=True, slots=True)
class Splice(Generic[Item]):
    """What of one tuple is replaced by what of another, from index `at` (0 is the first)."""

    at: int
    old: tuple[Item, ...]
    new: tuple[Item, ...]


def splice(old: tuple[Item, ...], new: tuple[Item, ...]) -> Splice[Item]:
    """The shortest middle in which two tuples differ."""
    shorter = min(len(old), len(new))
    front = next((index for index in range(shorter) if not same(old[index], new[index])), shorter)
    most = shorter - front
    back = next((step for step in range(most) if not same(old[-1 - step], new[-1 - step])), most)
    return Splice(front, old[front : len(old) - back], new[front : len(new) - back])


def same(first: object, second: object) -> bool:
    """Whether two parts are equal, at once where they are the same object."""
    return first is second or first == second


def differences(old: Program, new: Program) -> tuple[str, ...]:
    """One sentence for each field, segment, block and tool in which `new` is not as `old`; none if they are equal."""
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
    for field in STORED[form]:
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
    """How many were taken out and put in from index `at` on."""
    if old == 0:
        return f"{where}{_run(thing, at, new)} {'is' if new == 1 else 'are'} new."
    if new == 0:
        return f"{where}{_run(thing, at, old)} {'is' if old == 1 else 'are'} deleted."
    return f"{where}{_run(thing, at, old)}: {old} replaced by {new}."


def _run(thing: str, at: int, count: int) -> str:
    return f"{thing} {at + 1}" if count == 1 else f"{thing}s {at + 1} to {at + count}"
