"""Table: a contour's center path at several look-aheads, offset and crossed once for all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from core.comp.compensate import offset_contour
from core.comp.result import Compensated
from core.geometry.path import Path
from core.geometry.piece import Side


def compensate_all(
    contour: Path,
    side: Side,
    radius: float,
    lookaheads: Sequence[int],
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> tuple[Compensated, ...]:
    """`compensate` at several look-aheads, in their order; those that test the same crossings are walked once."""
    if not lookaheads:
        return ()
    offset = offset_contour(contour, side, radius, lookaheads, closed=closed)
    first = {offset.tested(lookahead): lookahead for lookahead in reversed(lookaheads)}
    walked = {tested: offset.path_at(lookahead, blend, overlap) for tested, lookahead in first.items()}
    return tuple(replace(walked[offset.tested(lookahead)], lookahead=lookahead) for lookahead in lookaheads)
