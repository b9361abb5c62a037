"""What a field held before something was typed into it that cannot be read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from app.painted.session import Session
from core.program.fields import Field, read_typed
from core.program.history import History
from core.program.model import Number, Program, Unread
from core.program.solve.solved import Value


def last_good(session: Session, one: Field, typed: Callable[[Session, str], Value | str]) -> str:
    """The text that makes field `one` again what it last was; empty where it was blank, or where nobody knows.

    `typed` reads a field of a session.  Only edits of one place each are gone back over: behind an edit that moved
    segments, renumbered tools or converted the unit the same field would be another one, or its number another length.
    """
    after = session.program
    for step in reversed(session.history.past):
        if not _one_place(step.program, after):
            return ""
        held = typed(replace(session, history=History(step.program)), one.name)
        if not isinstance(held, Unread):
            return _text(held.value, one, session) if isinstance(held, Number) else ""
        after = step.program
    return ""


def _text(value: float, one: Field, session: Session) -> str:
    """A number as it may have been typed, nothing lost."""
    texts = (f"{value:.12g}", repr(value))
    return next((text for text in texts if read_typed(text, one, session.program.unit) == Number(value)), "")


def _one_place(before: Program, after: Program) -> bool:
    """Whether both have the same fields, and differ in one segment, in one START or in no block."""
    if before.unit is not after.unit or _numbers(before) != _numbers(after) or len(before.blocks) != len(after.blocks):
        return False
    pairs = [(one, other) for one, other in zip(before.blocks, after.blocks, strict=True) if one != other]
    if len(pairs) != 1:
        return not pairs
    one, other = pairs[0]
    if [*map(type, one.segments)] != [*map(type, other.segments)]:
        return False
    different = sum(left != right for left, right in zip(one.segments, other.segments, strict=True))
    return different + (replace(one, segments=()) != replace(other, segments=())) == 1


def _numbers(program: Program) -> list[int]:
    return [tool.number for tool in program.tools]
