"""This module gives the texts of a field: its value, why a value cannot be used, its prompt, and its cell in a form."""

from __future__ import annotations

from app.widgets.field import Cell, State
from core.pipeline.derived import Tag
from core.program.fields import TYPE_AGAIN, Field, text_refusal, unread_reason, unread_sentence, value_refusal
from core.program.model import Number, Relative, Unread
from core.program.solve.solved import Origin, Solved, Value
from core.units import Unit, show

TAGS = {State.OVERRIDDEN: str(Tag.USR), State.UNREAD: "ERR"}
"""The tag of a typed field in each state that has one; other fields have the tag of their origin."""


def cell_of(
    field: Field,
    value: Value | str,
    unit: Unit,
    column: int,
    *,
    needed: bool = False,
    overrides: bool = False,
    visible: bool = True,
) -> Cell:
    """Return a field's cell with the state of its value; `overrides` if a typed value replaces a calculated one."""
    state = _state(field, value, unit, needed=needed, overrides=overrides)
    tag = str(value.origin) if isinstance(value, Solved) else TAGS.get(state, "")
    if isinstance(value, Relative) and not tag:
        tag = "INC"
    text = "?" if state is State.NEEDED else shown_text(value, field, unit)
    full = full_text(value, field, unit) if isinstance(value, Number | Relative) else ""
    return Cell(field.name, field.label, text, column, state, tag, full, field.choices, visible)


def _state(field: Field, value: Value | str, unit: Unit, *, needed: bool, overrides: bool) -> State:
    match value:
        case Unread() | Number() | Relative() if unusable(value, field, unit) is not None:
            return State.UNREAD
        case Solved():
            return State.USUAL if value.origin in (Origin.USUAL, Origin.TOOL) else State.CALCULATED
        case Number() if overrides:
            return State.OVERRIDDEN
        case None if needed:
            return State.NEEDED
        case _:
            return State.TYPED


def shown_text(value: Value | str, field: Field, unit: Unit) -> str:
    """Return a value as a form prints it."""
    match value:
        case None:
            return ""
        case str(text):
            return text
        case Unread(text, _):
            return text
        case Relative(number):
            return f"I{show(number, field.kind, unit)}"
        case Number(number) | Solved(number):
            return show(number, field.kind, unit)


def full_text(entry: Number | Relative, field: Field, unit: Unit) -> str:
    """Return a typed number, with all digits if the form's decimals would lose some."""
    text = show(entry.value, field.kind, unit)
    number = text if float(text) == entry.value else f"{entry.value:.12g}"
    return f"I{number}" if isinstance(entry, Relative) else number


def unusable(value: Value | str, field: Field, unit: Unit) -> str | None:
    """Return why a value cannot be used, unreadable text or a number out of range; None if it can."""
    if isinstance(value, Unread):
        return unread_text(value, field, unit)
    return value_refusal(field, value.value, unit) if isinstance(value, Number | Relative) else None


def unread_text(unread: Unread, field: Field, unit: Unit) -> str:
    """Return the error for text that cannot be read."""
    if outside := text_refusal(unread.text, field, unit):
        return outside
    if unread_reason(unread.text, field, unit) == TYPE_AGAIN:
        return f"{unread.text.strip()} has not been taken yet: type it again."
    return unread_sentence(unread)


def prompt_of(field: Field, *, narrow: bool = False) -> str:
    """Return the field's prompt, the short one if `narrow`; for a choice, add the choices and how to pick one."""
    prompt = (narrow and field.short_prompt) or field.prompt
    return f"{prompt} Letters pick {', '.join(field.choices)}." if field.choices else prompt
