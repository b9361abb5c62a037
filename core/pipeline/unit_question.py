"""Asks about the unit if a part's size looks as if it was typed in the other one."""

from __future__ import annotations

from typing import Final

import numpy as np

from core.finding import Finding, Severity
from core.geometry.piece import signed_area
from core.pipeline.derived import Derived, DerivedBlock
from core.units import Unit

SMALL_PART: Final = {Unit.IN: 6.35, Unit.MM: 6.0}
"""Millimeters: a whole part is seldom meant to be smaller."""
TOOL_SHARE: Final = 0.5
"""Fraction of the part's smaller side that a tool seldom exceeds."""


def unit_question(derived: Derived, *, drawn: bool = False) -> Finding | None:
    """Return the question INCH or MM? if the tool is large or the whole part small; None if nothing is unusual.

    The part is what all closed contours enclose together; how far a part extends at an open contour is not known, and
    nothing is asked while a contour is not determined to its end.  A tool inside a contour, as in a hole, is large only
    if it does not fit, which is an error of its own.  If the part is `drawn`, its unit is that of a drawing, and only
    a very small part is doubtful: a drawing may name the wrong unit.
    """
    if any(block.block.segments and not block.solved.fully_determined for block in derived.blocks):
        return None
    closed = [
        block
        for block in derived.blocks
        if block.paths is not None
        and block.solved.fully_determined
        and block.solved.closed
        and len(block.paths.surface)
    ]
    if not closed:
        return None
    boxes = np.concatenate([block.paths.surface.boxes for block in closed if block.paths is not None], axis=1)
    sides = sorted((boxes[2:].max(axis=1) - boxes[:2].min(axis=1)).tolist())
    diameter = max((2 * (block.radius or 0.0) for block in closed if not _runs_inside(block)), default=0.0)
    unit = derived.program.unit
    unit_text = f"The program is in {'INCH' if unit is Unit.IN else 'MM'}."
    if sides[1] < SMALL_PART[unit]:
        text = f"INCH or MM? The part is only {{0}} by {{1}}. {unit_text}"
        return Finding("INCH_OR_MM", Severity.WARNING, text, lengths=(sides[1], sides[0]))
    if not drawn and diameter > TOOL_SHARE * sides[0]:
        text = f"INCH or MM? The tool is {{0}} across, more than half of the part's smaller side, {{1}}. {unit_text}"
        return Finding("INCH_OR_MM", Severity.WARNING, text, lengths=(diameter, sides[0]))
    return None


def _runs_inside(block: DerivedBlock) -> bool:
    """Return whether the tool runs inside a closed contour."""
    if block.side is None or block.paths is None:
        return False
    return signed_area(block.paths.surface) * block.side.sign > 0.0
