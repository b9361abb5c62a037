"""BLEND ARCs: each put between its two neighbours at their corner, which it shortens.

In order of the segments; a neighbour that one blend has shortened is blended further as it then is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.fillet import Fillet, NoFillet, Reason, fillet
from core.program.model import BlendSegment, Segment
from core.program.solved import SolvedSegment


def blended(typed: Sequence[Segment], solved: list[SolvedSegment], radii: dict[int, float]) -> list[SolvedSegment]:
    """The segments with every BLEND ARC in place; `radii` holds their typed radii (mm) by index."""
    done = list(solved)
    for index, segment in enumerate(typed):
        if isinstance(segment, BlendSegment):
            place = _misplaced(typed, index)
            if place is not None:
                done[index] = _failed(done[index], Finding("BLEND_PLACE", Severity.ERROR, place))
            elif index in radii:
                _blend(done, index, radii[index])
            else:
                done[index] = replace(done[index], end=None)
    return done


def _misplaced(typed: Sequence[Segment], index: int) -> str | None:
    if index == 0:
        return "A BLEND ARC cannot be the first segment: put a LINE or an ARC before it."
    if isinstance(typed[index - 1], BlendSegment):
        return "A BLEND ARC cannot stand beside another BLEND ARC: delete one or put a segment between."
    if index + 1 == len(typed):
        return "A BLEND ARC cannot be the last segment: add the LINE or ARC behind it."
    return None


def _failed(blend: SolvedSegment, finding: Finding) -> SolvedSegment:
    found = replace(finding, segment=blend.number, field="radius")
    return replace(blend, end=None, findings=(*blend.findings, found))


def _blend(done: list[SolvedSegment], index: int, radius: float) -> None:
    """Put the blend `index` in and shorten its neighbours, or mark it with the reason why not."""
    before, blend, behind = done[index - 1 : index + 2]
    if before.piece is None or behind.piece is None:
        done[index] = _between_unknown(before, blend, behind)
        return
    made = fillet(before.piece, behind.piece, radius)
    match made:
        case Fillet(first, arc, last):
            done[index - 1 : index + 2] = (
                replace(before, piece=first),
                replace(blend, piece=arc),
                replace(behind, piece=last),
            )
        case NoFillet():
            done[index] = _failed(blend, _refusal(made, blend.number, radius))
        case _:
            assert_never(made)


def _between_unknown(before: SolvedSegment, blend: SolvedSegment, behind: SolvedSegment) -> SolvedSegment:
    """A blend beside a segment that is not determined waits for it; beside one without length it is wrong."""
    for one in (before, behind):
        if one.start is not None and one.end is not None:
            text = f"Segment {one.number} has no length left to blend: correct it or delete this BLEND ARC."
            if one.piece is None:
                return _failed(blend, Finding("BLEND_RADIUS", Severity.ERROR, text))
    return replace(blend, end=None)


def _refusal(made: NoFillet, number: int, radius: float) -> Finding:
    pair = f"segments {number - 1} and {number + 1}"
    match made.reason:
        case Reason.TANGENT:
            text = f"There is no corner to blend: {pair} already run smoothly into each other."
            return Finding("BLEND_TANGENT", Severity.ERROR, text)
        case Reason.REVERSAL:
            text = f"No arc fits: segment {number + 1} goes straight back along segment {number - 1}."
            return Finding("BLEND_RADIUS", Severity.ERROR, text)
        case Reason.TOO_LARGE if made.largest is not None:
            text = f"RADIUS {{value}} does not fit between {pair}: the largest that fits is {{0}}."
            return Finding("BLEND_RADIUS", Severity.ERROR, text, value=radius, lengths=(made.largest,))
        case Reason.TOO_LARGE:
            text = f"RADIUS {{value}} does not fit between {pair}: enter a smaller one."
            return Finding("BLEND_RADIUS", Severity.ERROR, text, value=radius)
        case _:
            assert_never(made.reason)
