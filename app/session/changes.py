"""This module finds where two programs differ: the field or segment to which undo and redo move the cursor."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

from core.program.edit import FormPlace
from core.program.history import splice
from core.program.model import Block, Program, Segment

Place = tuple[FormPlace, str | None]
"""A segment, and the name of its field if exactly one differs."""
SEGMENTS: Final = "segments"


def changed(before: Program, after: Program) -> Place | None:
    """Return the changed place in `after`; None if the unit, no block, or several of equally many blocks differ."""
    if before.unit is not after.unit:
        return None
    blocks = splice(before.blocks, after.blocks)
    if len(before.blocks) != len(after.blocks):
        return FormPlace(blocks.at + 1), None
    return _in_block(blocks.old[0], blocks.new[0], blocks.at + 1) if len(blocks.new) == 1 else None


def _in_block(before: Block, after: Block, number: int) -> Place:
    names = _names(before, after)
    if SEGMENTS not in names:
        return FormPlace(number), names[0] if len(names) == 1 else None
    segments = splice(before.segments, after.segments)
    here = FormPlace(number, min(segments.at + 1, len(after.segments)))
    if len(before.segments) != len(after.segments):
        return here, None
    names = _names(segments.old[0], segments.new[0])
    return here, names[0] if len(names) == 1 else None


def _names(before: Block | Segment, after: Block | Segment) -> list[str]:
    """Return the names of the fields that differ; none for two segments of different kinds."""
    if type(before) is not type(after):
        return []
    return [field.name for field in fields(before) if getattr(before, field.name) != getattr(after, field.name)]
