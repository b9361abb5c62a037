"""Where two programs differ: the one field, or the one segment, that undo and redo lead the cursor to."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

from core.program.edit import FormPlace
from core.program.model import Block, Program, Segment

Place = tuple[FormPlace, str | None]
"""A segment, and the name of its field where one alone is different."""
SEGMENTS: Final = "segments"


def changed(before: Program, after: Program) -> Place | None:
    """The place in `after`; None where more than one block is different, or none, and where all are by their unit."""
    if before.unit is not after.unit:
        return None
    one, other = before.blocks, after.blocks
    if len(one) != len(other):
        return FormPlace(_first(one, other)), None
    different = [number for number, pair in enumerate(zip(one, other, strict=True), 1) if pair[0] != pair[1]]
    return _in_block(one[different[0] - 1], other[different[0] - 1], different[0]) if len(different) == 1 else None


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
    """The fields that differ; none of two segments of different kinds."""
    if type(before) is not type(after):
        return []
    return [one.name for one in fields(before) if getattr(before, one.name) != getattr(after, one.name)]


def _first(before: tuple[object, ...], after: tuple[object, ...]) -> int:
    """The number of the first that differs, or of the first that only one has."""
    pairs = enumerate(zip(before, after, strict=False), 1)
    return next((number for number, pair in pairs if pair[0] != pair[1]), min(len(before), len(after)) + 1)
