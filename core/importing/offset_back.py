"""Finds the contour of a tool center path: offsets its moves back by the tool radius.

Lines move back by the radius, arcs get the radius R - r or R + r, and the arc about a corner shrinks to that corner.
The result is compensated again; it is the contour only if that gives the program's path.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import dist
from typing import Final

from core.comp.compensate import compensate
from core.comp.lookahead import MAX_LOOKAHEAD, MIN_LOOKAHEAD, calculated
from core.controls.compared_contours import Parting, apart
from core.geometry.carrier import carriers_meet
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side
from core.importing.joints import joined_chain
from core.importing.nc_contour import Cut, NcError
from core.tolerance import CLOSED, JOINED

SAME_PATH: Final = 0.001
"""Largest distance in millimeters of a contour's path from the program's."""

CORNER_RADIUS: Final = 0.002
"""An arc of the contour no larger than this, in millimeters, is a corner that the tool center turned about."""


def offset_back(cuts: Sequence[Cut], side: Side, radius: float) -> tuple[list[Cut], int | None]:
    """Return the contour whose path at this radius and side is `cuts`, and the look-ahead that it needs.

    The look-ahead is None if the calculated one gives the path.  NcError with the line if there is no contour.
    """
    shifted = [(cut, piece) for cut in cuts if (piece := _shifted(cut, side, radius)) is not None]
    if not shifted:
        raise NcError(f"Line {cuts[0].line}: the path only turns about a point; there is no contour.")
    ring = dist(cuts[0].piece.start, cuts[-1].piece.end) <= CLOSED
    closed = ring or dist(shifted[0][1].start, shifted[-1][1].end) <= CLOSED
    extended, corner_at_start = _extended(shifted, closed=closed)
    pieces = joined_chain([cut.piece for cut in extended], closed=closed, tolerance=SAME_PATH).pieces
    if len(pieces) != len(extended):
        raise NcError(f"Line {cuts[0].line}: no contour has this path.")
    contour = [cut._replace(piece=piece) for cut, piece in zip(extended, pieces, strict=True)]
    if ring and corner_at_start:
        contour = _from_side(contour)
    return contour, _proved(contour, cuts, side, radius, closed=closed)


def _from_side(contour: list[Cut]) -> list[Cut]:
    """Start a ring at the middle of its longest line: started at an inside corner it would have another path."""
    lines = [row for row, cut in enumerate(contour) if isinstance(cut.piece, Line)] or list(range(len(contour)))
    row = max(lines, key=lambda row: contour[row].piece.length)
    cut = contour[row]
    middle = cut.piece.point_at(0.5)
    first, second = replace(cut.piece, end=middle), replace(cut.piece, start=middle)
    return [cut._replace(piece=second), *contour[row + 1 :], *contour[:row], cut._replace(piece=first)]


def _shifted(cut: Cut, side: Side, radius: float) -> Piece | None:
    """Return the piece whose offset is the path's piece; None if that is a corner."""
    piece = cut.piece
    if isinstance(piece, Line):
        dx, dy = piece.direction_at(piece.start)
        x, y = dy * side.sign * radius, -dx * side.sign * radius
        return Line((piece.start[0] + x, piece.start[1] + y), (piece.end[0] + x, piece.end[1] + y))
    size = piece.radius + radius * int(piece.turn) * side.sign
    if abs(size) <= CORNER_RADIUS:
        return None
    if size < 0.0:
        raise NcError(f"Line {cut.line}: an arc of the path is smaller than the tool and curves around the contour.")
    factor = size / piece.radius
    (cx, cy) = piece.center
    start, end = ((cx + (x - cx) * factor, cy + (y - cy) * factor) for x, y in (piece.start, piece.end))
    return Arc(start, start if piece.start == piece.end else end, piece.center, piece.turn)


def _extended(kept: Sequence[tuple[Cut, Piece]], *, closed: bool) -> tuple[list[Cut], bool]:
    """Return the pieces extended to the inside corners, and whether the start is such a corner.

    If carriers do not meet, the tool has left material: a line then continues an arc along its tangent.
    """
    made = [cut._replace(piece=piece) for cut, piece in kept]
    result: list[Cut] = []
    corner = False
    for index in range(len(made)):
        following = (index + 1) % len(made)
        first, second = made[index], made[following]
        last = following == 0
        if (last and (not closed or len(made) == 1)) or dist(first.piece.end, second.piece.start) <= SAME_PATH:
            result.append(first)
            continue
        corner = corner or last
        before, between, after = _to_corner(first, second)
        result += [before, *between]
        made[following] = after
        if last:
            result[0] = result[0]._replace(piece=replace(result[0].piece, start=after.piece.start))
    return result, corner


def _to_corner(first: Cut, second: Cut) -> tuple[Cut, list[Cut], Cut]:
    """Extend two pieces to the corner between them; add lines that lead there if they do not reach it."""
    before, after = first.piece, second.piece
    here, there = before.end, after.start
    if min(before.length, after.length) <= JOINED:
        # the corner before it has cut it away
        raise NcError(f"Line {second.line}: no contour has this path.")
    meetings = carriers_meet(before, after)
    reach = 4.0 * dist(here, there) + SAME_PATH
    near = [point for point in meetings if max(dist(point, here), dist(point, there)) <= reach]
    if near:
        at = min(near, key=lambda point: dist(point, here) + dist(point, there))
        return first._replace(piece=replace(before, end=at)), [], second._replace(piece=replace(after, start=at))
    tangents = [_tangent_line(before, here), _tangent_line(after, there)]
    meetings = carriers_meet(*tangents)
    if not meetings or max(dist(meetings[0], here), dist(meetings[0], there)) > reach:
        raise NcError(f"Line {second.line}: two pieces of the contour do not meet; no contour has this path.")
    at = meetings[0]
    if isinstance(before, Line):
        first = first._replace(piece=Line(before.start, at))
        return first, [first._replace(piece=Line(at, there), line=second.line)], second
    if isinstance(after, Line):
        return first, [first._replace(piece=Line(here, at))], second._replace(piece=Line(at, after.end))
    return first, [first._replace(piece=Line(here, at)), second._replace(piece=Line(at, there))], second


def _tangent_line(piece: Piece, at: Point) -> Line:
    """Return the tangent of a piece at one of its points, as a line of length 1."""
    (x, y), (dx, dy) = at, piece.direction_at(at)
    return Line(at, (x + dx, y + dy))


def _proved(contour: Sequence[Cut], cuts: Sequence[Cut], side: Side, radius: float, *, closed: bool) -> int | None:
    """Compensate the contour again; return the look-ahead that gives the program's path, None for CAL."""
    surface = Path.from_pieces([cut.piece for cut in contour])
    path = Path.from_pieces([cut.piece for cut in cuts], [float(cut.line) for cut in cuts])
    calculated_value = calculated(len(contour), closed=closed)
    best: Parting | None = None
    for value in dict.fromkeys((calculated_value, *range(MIN_LOOKAHEAD, MAX_LOOKAHEAD + 1))):
        again = compensate(surface, side, radius, value, closed=closed).path
        if not len(again):
            continue
        parting = apart(path, again, SAME_PATH) or apart(again, path, SAME_PATH)
        if parting is None:
            return None if value == calculated_value else value
        best = parting if best is None or parting.distance < best.distance else best
    if best is None:
        raise NcError(f"Line {cuts[0].line}: no contour has this path.")
    raise NcError(
        f"Line {best.line or cuts[0].line}: no contour has this path; the nearest one is {best.distance:.3f} mm off. "
        "Is the diameter or the side another one?"
    )
