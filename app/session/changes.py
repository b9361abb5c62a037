"""This module finds where two programs differ: the field or segment to which undo and redo move the cursor."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

from core.program.edit import FormPlace
from core.program.model import Block, Program, Segment

Place = tuple[FormPlace, str | None]
"""A segment, and the name of its field if exactly one differs."""
SEGMENTS: Final = "segments"


def changed(before: Program, after: Program) -> Place | None:
    """Return the changed place in `after`; None if the unit, no block, or several of equally many blocks differ."""
    if before.unit is not after.unit:
        return None
    old, new = before.blocks, after.blocks
    if len(old) != len(new):
        return FormPlace(_first(old, new)), None
    different = [number for number, pair in enumerate(zip(old, new, strict=True), 1) if pair[0] != pair[1]]
    return _in_block(old[different[0] - 1], new[different[0] - 1], different[0]) if len(different) == 1 else None


def _in_block(before: Block, after: Block, number: int) -> Place:
    names = _names(before, after)
    if SEGMENTS not in names:
        return FormPlace(number), names[0] if len(names) == 1 else None
    first = _first(before.segments, after.segments)
    here = FormPlace(number, min(first, len(after.segments)))
    if len(before.segments) != len(after.segments):
        return here, None
    names = _names(before.segments[first - 1], after.segments[first - 1])
    return here, names[0] if len(names) == 1 else None


def _names(before: Block | Segment, after: Block | Segment) -> list[str]:
    """Return the names of the fields that differ; none for two segments of different kinds."""
    if type(before) is not type(after):
        return []
    return [field.name for field in fields(before) if getattr(before, field.name) != getattr(after, field.name)]


def _first(before: tuple[object, ...], after: tuple[object, ...]) -> int:
    """Return the number, from 1, of the first item that differs or that only one side has."""
    pairs = enumerate(zip(before, after, strict=False), 1)
    return next((number for number, pair in pairs if pair[0] != pair[1]), min(len(before), len(after)) + 1)
