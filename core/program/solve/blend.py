"""BLEND ARCs: each put between its two neighbors at their corner, which it shortens.

In order of the segments; a neighbor that one blend has shortened is blended further as it then is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.fillet import Fillet, NoFillet, Reason, fillet
from core.geometry.piece import Piece
from core.program.model import BlendSegment, Segment


@dataclass(slots=True)
class Blends:
    """The surface with its blends, by index of segment: pieces as they are left, and what is wrong with a blend.

    `waiting` are blends that are not in place: faulty, without radius, or beside a segment not determined yet.
    """

    pieces: list[Piece | None]
    faults: dict[int, Finding] = field(default_factory=dict)
    waiting: set[int] = field(default_factory=set)


def blended(
    typed: Sequence[Segment],
    blends: Sequence[int],
    pieces: list[Piece | None],
    radii: dict[int, float],
    empty: frozenset[int],
) -> Blends:
    """Every BLEND ARC put in, of rising indices `blends`.

    `radii` holds their typed radii (mm), `empty` the segments without length.
    """
    made = Blends(list(pieces))
    known = empty.union(index for index, piece in enumerate(pieces) if piece is not None)
    for index in blends:
        fault = _misplaced(typed, index)
        if fault is None and index in radii:
            fault = _blend(made, index, radii[index], known)
        if fault is not None:
            made.faults[index] = fault
        if made.pieces[index] is None:
            made.waiting.add(index)
    return made


def _wrong(code: str, text: str, value: float | None = None, *lengths: float) -> Finding:
    return Finding(code, Severity.ERROR, text, field="radius", value=value, lengths=lengths)


def _misplaced(typed: Sequence[Segment], index: int) -> Finding | None:
    if index == 0:
        return _wrong("BLEND_PLACE", "A BLEND ARC cannot be the first segment: put a LINE or an ARC before it.")
    if isinstance(typed[index - 1], BlendSegment):
        return _wrong(
            "BLEND_PLACE", "A BLEND ARC cannot stand beside another BLEND ARC: delete one or put a segment between."
        )
    if index + 1 == len(typed):
        return _wrong("BLEND_PLACE", "A BLEND ARC cannot be the last segment: add the LINE or ARC behind it.")
    return None


def _blend(made: Blends, index: int, radius: float, known: frozenset[int]) -> Finding | None:
    """Put the blend in and shorten its neighbors, or tell why not; nothing while a neighbor is not determined."""
    before, behind = made.pieces[index - 1], made.pieces[index + 1]
    if before is None or behind is None:
        return _beside_nothing(made, index, known)
    found = fillet(before, behind, radius)
    match found:
        case Fillet(first, arc, last):
            made.pieces[index - 1 : index + 2] = first, arc, last
            return None
        case NoFillet():
            return _refusal(found, index + 1, radius)
        case _:
            assert_never(found)


def _beside_nothing(made: Blends, index: int, known: frozenset[int]) -> Finding | None:
    """What is wrong where a neighbor has no length, or none any more; `known` are the determined segments."""
    for beside in (index - 1, index + 1):
        if made.pieces[beside] is None and beside in known:
            text = f"Segment {beside + 1} has no length left to blend: correct it or delete this BLEND ARC."
            return _wrong("BLEND_RADIUS", text)
    return None


def _refusal(made: NoFillet, number: int, radius: float) -> Finding:
    pair = f"segments {number - 1} and {number + 1}"
    match made.reason:
        case Reason.TANGENT:
            text = f"There is no corner to blend: {pair} already run smoothly into each other."
            return _wrong("BLEND_TANGENT", text)
        case Reason.REVERSAL:
            text = f"No arc fits: segment {number + 1} goes straight back along segment {number - 1}."
            return _wrong("BLEND_RADIUS", text)
        case Reason.TOO_LARGE if made.largest is not None:
            text = f"RADIUS {{value}} does not fit between {pair}: the largest that fits is {{0}}."
            return _wrong("BLEND_RADIUS", text, radius, made.largest)
        case Reason.TOO_LARGE:
            text = f"RADIUS {{value}} does not fit between {pair}: enter a smaller one."
            return _wrong("BLEND_RADIUS", text, radius)
        case _:
            assert_never(made.reason)
