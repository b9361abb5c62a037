"""BLEND ARCs: each put between its two neighbors at their corner, which it shortens.

In order of the segments; a neighbor that one blend has shortened is blended further as it then is.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.fillet import Fillet, NoFillet, Reason, fillet
from core.geometry.piece import Piece
from core.program.model import BlendSegment, Segment


@dataclass(slots=True)
class Blends:
    """The surface with its blends, by index of segment: pieces as they are left, and what is wrong with a blend.

    `waiting` are blends that are not in place: faulty, without radius, or next to a segment not determined yet.
    """

    pieces: list[Piece | None]
    faults: dict[int, Finding] = field(default_factory=dict)
    waiting: set[int] = field(default_factory=set)


def put_blends_in(
    segments: Sequence[Segment], pieces: Sequence[Piece | None], radii: dict[int, float], lengthless: Set[int]
) -> Blends:
    """The pieces of the segments with every BLEND ARC put in.

    `radii` holds the typed radii of blends (mm), `lengthless` the determined segments without length.
    """
    blends = Blends(list(pieces))
    determined = lengthless | {index for index, piece in enumerate(pieces) if piece is not None}
    for index, segment in enumerate(segments):
        if not isinstance(segment, BlendSegment):
            continue
        fault = _misplaced(segments, index)
        if fault is None and index in radii:
            fault = _blend(blends.pieces, index, radii[index], determined)
        if fault is not None:
            blends.faults[index] = fault
        if blends.pieces[index] is None:
            blends.waiting.add(index)
    return blends


def _fault(code: str, text: str, value: float | None = None, *lengths: float) -> Finding:
    return Finding(code, Severity.ERROR, text, field="radius", value=value, lengths=lengths)


def _misplaced(segments: Sequence[Segment], index: int) -> Finding | None:
    if index == 0:
        return _fault("BLEND_PLACE", "A BLEND ARC cannot be the first segment: put a LINE or an ARC before it.")
    if isinstance(segments[index - 1], BlendSegment):
        text = "A BLEND ARC cannot follow another BLEND ARC: delete one or put a segment between."
        return _fault("BLEND_PLACE", text)
    if index + 1 == len(segments):
        return _fault("BLEND_PLACE", "A BLEND ARC cannot be the last segment: add the LINE or ARC after it.")
    return None


def _blend(pieces: list[Piece | None], index: int, radius: float, determined: Set[int]) -> Finding | None:
    """Put the blend in and shorten its neighbors, or say why not; nothing while a neighbor is not determined."""
    before, after = pieces[index - 1], pieces[index + 1]
    if before is None or after is None:
        return _no_neighbor(pieces, index, determined)
    rounding = fillet(before, after, radius)
    match rounding:
        case Fillet(first, arc, last):
            pieces[index - 1 : index + 2] = first, arc, last
            return None
        case NoFillet():
            return _refusal(rounding, index + 1, radius)
        case _:
            assert_never(rounding)


def _no_neighbor(pieces: Sequence[Piece | None], index: int, determined: Set[int]) -> Finding | None:
    """What is wrong where a determined neighbor has no length, or none any more."""
    for neighbor in (index - 1, index + 1):
        if pieces[neighbor] is None and neighbor in determined:
            text = f"Segment {neighbor + 1} has no length left to blend: correct it or delete this BLEND ARC."
            return _fault("BLEND_RADIUS", text)
    return None


def _refusal(refused: NoFillet, number: int, radius: float) -> Finding:
    pair = f"segments {number - 1} and {number + 1}"
    match refused.reason:
        case Reason.TANGENT:
            text = f"There is no corner to blend: {pair} already run smoothly into each other."
            return _fault("BLEND_TANGENT", text)
        case Reason.REVERSAL:
            text = f"No arc fits: segment {number + 1} goes straight back along segment {number - 1}."
            return _fault("BLEND_RADIUS", text)
        case Reason.TOO_LARGE if refused.largest is not None:
            text = f"RADIUS {{value~0}} does not fit between {pair}: the largest that fits is {{0~value}}."
            return _fault("BLEND_RADIUS", text, radius, refused.largest)
        case Reason.TOO_LARGE:
            text = f"RADIUS {{value}} does not fit between {pair}: enter a smaller one."
            return _fault("BLEND_RADIUS", text, radius)
        case _:
            assert_never(refused.reason)
