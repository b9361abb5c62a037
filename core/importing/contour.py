"""A contour of a drawing, and what an operator may change of it: its start, its direction, arcs for its short lines."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product
from math import dist

import numpy as np

from core.geometry.distance import distance, foot
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn, signed_area
from core.geometry.piece_arrays import piece_arrays
from core.importing.arc_fitting import Fitted, fit_arcs
from core.importing.clean_up import is_circle
from core.importing.joints import joined_chain, reversed_pieces
from core.importing.nesting import box_of
from core.importing.nodes import KEY_DECIMALS, SAME_POINT
from core.units import Unit, length_text


class ContourKind(StrEnum):
    """The kind of a contour by its nesting."""

    OUTSIDE = "OUTSIDE"
    HOLE = "HOLE"
    ISLAND = "ISLAND"
    OPEN = "OPEN"


@dataclass(frozen=True, eq=False, slots=True)
class Contour:
    """One contour in millimeters, in its direction of travel, from its start.

    `number` counts from 1 in list order.  `drawn` is the number of pieces in the drawing, before a start in the middle
    of one divides it.  `gap` is the largest gap closed in it.  `inside` is the number of the contour around it,
    0 for none; `depth` counts the contours around it.  `open_gap` is the distance of an open contour's nearest end from
    another loose end, that of contour `open_gap_to`.  `fitted` is the result of FIT ARCS.
    """

    number: int
    pieces: tuple[Piece, ...]
    closed: bool
    kind: ContourKind
    layers: tuple[str, ...]
    drawn: int
    gap: float = 0.0
    depth: int = 0
    inside: int = 0
    open_gap: float | None = None
    open_gap_to: int = 0
    problems: tuple[str, ...] = ()
    fitted: Fitted | None = None

    @property
    def layer(self) -> str:
        """The layer's name in a list, with a plus sign if there are more."""
        return self.layers[0] + ("+" if len(self.layers) > 1 else "")

    @property
    def length(self) -> float:
        """Length in millimeters."""
        return sum(piece.length for piece in self.pieces)

    @property
    def area(self) -> float:
        """The area inside a closed contour in square millimeters, 0 for an open one."""
        return abs(signed_area(self.pieces)) if self.closed else 0.0

    @property
    def size(self) -> tuple[float, float]:
        """Width and height in millimeters."""
        left, bottom, right, top = box_of(self.pieces)
        return right - left, top - bottom

    @property
    def start(self) -> Point:
        """The start point."""
        return self.pieces[0].start

    @property
    def end(self) -> Point:
        """The end point."""
        return self.pieces[-1].end

    @property
    def turn(self) -> Turn:
        """The direction of travel; NONE for an open contour."""
        if not self.closed:
            return Turn.NONE
        return Turn.CCW if signed_area(self.pieces) > 0.0 else Turn.CW

    @property
    def side(self) -> Side | None:
        """The proposed side of the tool: inside a hole, outside any other closed contour; None for an open one."""
        if not self.closed:
            return None
        outside = self.kind is not ContourKind.HOLE
        return Side.LEFT if outside is (self.turn is Turn.CW) else Side.RIGHT

    @property
    def circle(self) -> float | None:
        """The radius of a contour that is one full circle, None for any other."""
        piece = self.pieces[0]
        return piece.radius if len(self.pieces) == 1 and is_circle(piece) else None


def rounded(point: Point) -> tuple[float, float]:
    """Return a point rounded for sorting."""
    return round(point[0], KEY_DECIMALS), round(point[1], KEY_DECIMALS)


def reversed_contour(contour: Contour) -> Contour:
    """Return the contour traveled the other way; a closed one keeps its start, and its proposed side changes."""
    return replace(contour, pieces=reversed_pieces(contour.pieces))


def traveled_like(contour: Contour, other: Contour) -> Contour:
    """Give a contour the direction and the start of another one along the same line."""
    turned = contour if contour.turn is other.turn else reversed_contour(contour)
    return turned if turned.start == other.start else started_at(turned, other.start)


def started_at_usual_place(contour: Contour) -> Contour:
    """Start a closed contour at the middle of its longest line (or arc), a circle at its leftmost point."""
    if not contour.closed:
        return contour
    circle = contour.pieces[0]
    if len(contour.pieces) == 1 and is_circle(circle):
        start = (circle.center[0] - circle.radius, circle.center[1])
        return replace(contour, pieces=(replace(circle, start=start, end=start),))
    contour = _undivided(contour)
    lines = [row for row, piece in enumerate(contour.pieces) if isinstance(piece, Line)]
    rows = lines or list(range(len(contour.pieces)))
    longest = max(contour.pieces[row].length for row in rows)
    equal = [row for row in rows if contour.pieces[row].length >= longest - 10.0**-KEY_DECIMALS]
    row = min(equal, key=lambda row: tuple(reversed(rounded(contour.pieces[row].point_at(0.5)))))
    return _started_on(contour, row, 0.5)


def started_at(contour: Contour, point: Point) -> Contour:
    """Start a closed contour where it is nearest to a point, an open one at the nearer of its ends."""
    if not contour.closed:
        first, last = dist(point, contour.start), dist(point, contour.end)
        return contour if first <= last else reversed_contour(contour)
    whole = _undivided(contour)
    pieces = piece_arrays(Path.from_pieces(whole.pieces))
    points = np.full(len(pieces), complex(*point))
    nearest = int(distance(pieces, points).argmin())
    return _started_on(whole, int(pieces.rows[nearest]), float(foot(pieces, points)[nearest]))


def started_at_corner(contour: Contour, step: int) -> Contour:
    """Start a closed contour at the corner that is `step` corners after (or before, if negative) its start."""
    if not contour.closed or contour.circle is not None:
        return contour
    whole = _undivided(contour)
    # a start between two corners first goes to the end of its piece, in the step's direction
    ahead = step - 1 if len(whole.pieces) < len(contour.pieces) and step > 0 else step
    return _started_on(whole, (ahead + (0 if whole is contour else 1)) % len(whole.pieces), 0.0)


def started_at_side(contour: Contour, step: int) -> Contour:
    """Start a closed contour at the middle of the piece that is `step` pieces after (or before) the one it starts on.

    From a corner the first step leads to the middle of the piece that begins there.  A circle moves by quarter turns.
    """
    if not contour.closed:
        return contour
    if contour.circle is not None:
        circle = contour.pieces[0]
        return started_at(contour, circle.point_at((step % 4) / 4.0))
    whole = _undivided(contour)
    ahead = step if len(whole.pieces) < len(contour.pieces) or step < 0 else step - 1
    return _started_on(whole, ahead % len(whole.pieces), 0.5)


def _undivided(contour: Contour) -> Contour:
    """Rejoin the piece that the contour's start divides: the contour then starts at that piece's beginning."""
    first, last = contour.pieces[0], contour.pieces[-1]
    if len(contour.pieces) <= contour.drawn:
        return contour
    return replace(contour, pieces=(replace(first, start=last.start), *contour.pieces[1:-1]))


def _started_on(contour: Contour, row: int, share: float) -> Contour:
    """Start an undivided closed contour at a fraction of one of its pieces, which is divided there."""
    pieces, piece = contour.pieces, contour.pieces[row]
    if contour.circle is not None:
        point = piece.point_at(share)
        return replace(contour, pieces=(replace(piece, start=point, end=point),))
    if min(share, 1.0 - share) * piece.length <= SAME_POINT:
        row = row if share < 0.5 else (row + 1) % len(pieces)
        return replace(contour, pieces=(*pieces[row:], *pieces[:row]))
    middle = piece.point_at(share)
    first, second = replace(piece, end=middle), replace(piece, start=middle)
    return replace(contour, pieces=(second, *pieces[row + 1 :], *pieces[:row], first))


def fitted_contour(contour: Contour, fit: float) -> Contour:
    """Fit arcs to the contour's runs of short lines; `fitted` then holds the result."""
    whole = _undivided(contour)
    fitted = fit_arcs(whole.pieces, fit, closed=contour.closed)
    made = replace(whole, pieces=fitted.pieces, drawn=len(fitted.pieces), fitted=replace(fitted, before=contour.drawn))
    return started_at_usual_place(made)


def fit_sentence(contour: Contour, unit: Unit) -> str:
    """Return the result of FIT ARCS on a contour, such as `3000 lines -> 1 ARC, off by 0.0000`."""
    fitted = contour.fitted
    if fitted is None:
        return ""
    arcs = sum(isinstance(piece, Arc) for piece in fitted.pieces)
    lines = len(fitted.pieces) - arcs
    parts = [f"{count} {name}{'S' if count > 1 else ''}" for count, name in ((arcs, "ARC"), (lines, "LINE")) if count]
    return f"{fitted.before} lines -> {' and '.join(parts)}, off by {length_text(fitted.deviation, unit)}"


def joined_open(first: Contour, second: Contour, tolerance: float) -> Contour | None:
    """Join two open contours at a branch, as the operator chose.  None if their ends do not meet."""
    ways = ((contour.pieces, reversed_pieces(contour.pieces)) for contour in (first, second))
    for before, after in product(*ways):
        if dist(before[-1].end, after[0].start) <= tolerance:
            closed = dist(after[-1].end, before[0].start) <= tolerance
            joined = joined_chain((*before, *after), closed=closed, tolerance=tolerance)
            layers = tuple(dict.fromkeys((*first.layers, *second.layers)))
            kind = ContourKind.OUTSIDE if closed else ContourKind.OPEN
            return replace(
                first, pieces=joined.pieces, closed=closed, kind=kind, layers=layers, drawn=len(joined.pieces)
            )  # fmt: skip
    return None
