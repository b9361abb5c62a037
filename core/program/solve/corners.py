"""This module inserts BLEND ARCs and CHAMFERs: each goes at the corner of its two neighbors and shortens both.

They are inserted in the order of the segments; a neighbor that is already shortened is shortened further.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field
from typing import assert_never

from core.finding import Finding, Severity
from core.geometry.corner import NoCorner, Reason, chamfer, fillet
from core.geometry.piece import Piece
from core.program.fields import form_of
from core.program.model import BlendSegment, CornerSegment, Segment


@dataclass(slots=True)
class Corners:
    """The surface with its blends and chamfers, by segment index: the remaining pieces, and the faults.

    `waiting` holds the corners that are not inserted: faulty, without a size, or next to an undetermined segment.
    """

    pieces: list[Piece | None]
    faults: dict[int, Finding] = field(default_factory=dict)
    waiting: set[int] = field(default_factory=set)


def put_corners_in(
    segments: Sequence[Segment], pieces: Sequence[Piece | None], sizes: dict[int, float], lengthless: Set[int]
) -> Corners:
    """Return the pieces of the segments with every BLEND ARC and CHAMFER inserted.

    `sizes` holds the typed radii and lengths (mm), `lengthless` the determined segments without length.
    """
    corners = Corners(list(pieces))
    determined = lengthless | {index for index, piece in enumerate(pieces) if piece is not None}
    for index, segment in enumerate(segments):
        if not isinstance(segment, CornerSegment):
            continue
        fault = _misplaced(segments, index, segment)
        if fault is None and index in sizes:
            fault = _put_in(corners.pieces, index, segment, sizes[index], determined)
        if fault is not None:
            corners.faults[index] = fault
        if corners.pieces[index] is None:
            corners.waiting.add(index)
    return corners


def _fault(segment: CornerSegment, what: str, text: str, value: float | None = None, *lengths: float) -> Finding:
    verb, _, label = _words(segment)
    return Finding(f"{verb.upper()}_{what}", Severity.ERROR, text, field=label.lower(), value=value, lengths=lengths)


def _misplaced(segments: Sequence[Segment], index: int, segment: CornerSegment) -> Finding | None:
    name = form_of(segment)
    if index == 0:
        text = f"A {name} cannot be the first segment: put a LINE or an ARC before it."
    elif isinstance(before := segments[index - 1], CornerSegment):
        other = f"another {name}" if form_of(before) is name else f"a {form_of(before)}"
        text = f"A {name} cannot follow {other}: delete one or put a segment between."
    elif index + 1 == len(segments):
        text = f"A {name} cannot be the last segment: add the LINE or ARC after it."
    else:
        return None
    return _fault(segment, "PLACE", text)


def _put_in(
    pieces: list[Piece | None], index: int, segment: CornerSegment, size: float, determined: Set[int]
) -> Finding | None:
    """Insert a blend or chamfer and shorten its neighbors, or return why not; wait for an undetermined neighbor."""
    before, after = pieces[index - 1], pieces[index + 1]
    if before is None or after is None:
        return _no_neighbor(pieces, index, segment, determined)
    corner = (fillet if isinstance(segment, BlendSegment) else chamfer)(before, after, size)
    if isinstance(corner, NoCorner):
        return _refused(corner, segment, index + 1, size)
    pieces[index - 1 : index + 2] = corner.before, corner.between, corner.after
    return None


def _no_neighbor(
    pieces: Sequence[Piece | None], index: int, segment: CornerSegment, determined: Set[int]
) -> Finding | None:
    """Return a fault if a determined neighbor has no length, or none left."""
    verb, _, what = _words(segment)
    for neighbor in (index - 1, index + 1):
        if pieces[neighbor] is None and neighbor in determined:
            text = f"Segment {neighbor + 1} has no length left to {verb}: correct it or delete this {form_of(segment)}."
            return _fault(segment, what, text)
    return None


def _words(segment: CornerSegment) -> tuple[str, str, str]:
    """Return the verb for what is done to the corner, the noun for what fills it, and the label of its size field."""
    return ("blend", "arc", "RADIUS") if isinstance(segment, BlendSegment) else ("chamfer", "chamfer", "LENGTH")


def _refused(refused: NoCorner, segment: CornerSegment, number: int, size: float) -> Finding:
    verb, noun, what = _words(segment)
    pair = f"segments {number - 1} and {number + 1}"
    match refused.reason:
        case Reason.TANGENT:
            text = f"There is no corner to {verb}: {pair} already run smoothly into each other."
            return _fault(segment, "TANGENT", text)
        case Reason.REVERSAL:
            text = f"No {noun} fits: segment {number + 1} goes straight back along segment {number - 1}."
            return _fault(segment, what, text)
        case Reason.TOO_LARGE if refused.largest is not None:
            text = f"{what} {{value~0}} does not fit between {pair}: the largest that fits is {{0-}}."
            return _fault(segment, what, text, size, refused.largest)
        case Reason.TOO_LARGE:
            text = f"{what} {{value}} does not fit between {pair}: enter a smaller one."
            return _fault(segment, what, text, size)
        case _:
            assert_never(refused.reason)
