"""Fits runs of many short lines with the longest arcs and lines that deviate from them by no more than FIT.

A corner sharper than `MIN_CORNER_ANGLE` stays.  The ends of the new pieces are points of the run, so that everything
still joins.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import radians, tau
from typing import Final

import numpy as np

from core.geometry.path import Floats, Points
from core.geometry.piece import Arc, Line, Piece, Turn, point_of
from core.importing.curves import MAX_RADIUS

MIN_CORNER_ANGLE: Final = radians(5.05)
"""5 degrees, the turns of a circle of 72 lines, and what rounded coordinates add to them."""
MIN_LINES: Final = 3
"""Fewest lines that an arc replaces."""

MAX_NARROWING_STEPS: Final = 40
"""Most steps that narrow down the best arc between two points."""


@dataclass(frozen=True, slots=True)
class Fitted:
    """The pieces of a chain with arcs fitted, their number before, and their largest distance from those."""

    pieces: tuple[Piece, ...]
    before: int
    deviation: float


_Fit = tuple[Piece, float]
"""An arc or a line through the ends of some points, and its largest distance from their lines."""

_Make = Callable[[Points, float], _Fit | None]
"""Fits some points within FIT; None if that is not possible."""


def fit_arcs(pieces: Sequence[Piece], fit: float, *, closed: bool) -> Fitted:
    """Fit the runs of lines in a joined chain within `fit` millimeters."""
    # the first piece of a ring that starts a new run; None if it is smooth lines all around
    breaks = (row for row, piece in enumerate(pieces) if not _goes_on(pieces[row - 1], piece))
    start = next(breaks, None) if closed else 0
    if start is None:
        fitted, deviation = _ring(_points(pieces), fit)
        return Fitted(tuple(fitted), len(pieces), deviation)
    runs: list[list[Piece]] = []
    for piece in (*pieces[start:], *pieces[:start]):
        if runs and _goes_on(runs[-1][-1], piece):
            runs[-1].append(piece)
        else:
            runs.append([piece])
    fits = [_open_run(_points(run), fit) if isinstance(run[0], Line) else (run, 0.0) for run in runs]
    made = tuple(piece for fitted, _ in fits for piece in fitted)
    return Fitted(made, len(pieces), max((deviation for _, deviation in fits), default=0.0))


def _goes_on(before: Piece, after: Piece) -> bool:
    """True if two pieces are lines without a corner between them."""
    if not (isinstance(before, Line) and isinstance(after, Line)):
        return False
    u = complex(*before.end) - complex(*before.start)
    v = complex(*after.end) - complex(*after.start)
    return bool(abs(np.angle(v * u.conjugate())) <= MIN_CORNER_ANGLE)


def _points(pieces: Sequence[Piece]) -> Points:
    return np.array([complex(*pieces[0].start), *(complex(*piece.end) for piece in pieces)])


def _ring(points: Points, fit: float) -> tuple[list[Piece], float]:
    """Fit a smooth ring: one circle if that will do, else from the first break of a fit that starts anywhere."""
    circle = _circle(points[:-1], fit)
    if circle is not None:
        return [circle[0]], circle[1]
    pieces, _ = _open_run(points, fit)
    at = int(np.argmin(np.abs(points[:-1] - complex(*pieces[0].end))))
    turned = np.concatenate((points[at:-1], points[: at + 1]))
    return _open_run(turned, fit)


def _circle(points: Points, fit: float) -> _Fit | None:
    """Return the full circle through points that turn once about their middle, or None.

    The points of a smooth ring are many: it turns by a corner's angle at most at each.
    """
    # least squares of x^2 + y^2 = 2 a x + 2 b y + c about the middle
    middle = points.mean()
    local = points - middle
    rows = np.column_stack((2.0 * local.real, 2.0 * local.imag, np.ones(len(local))))
    (a, b, _), *_ = np.linalg.lstsq(rows, np.abs(local) ** 2, rcond=None)
    center = complex(a, b)
    away = np.abs(local - center)
    radius = float((away.max() + away.min()) / 2.0)
    ends = np.concatenate((points[1:], points[:1]))
    deviation = max(float(np.abs(away - radius).max()), _sagitta(points, ends, middle + center, radius))
    turned = np.angle((np.roll(local, -1) - center) * (local - center).conj())
    if deviation > fit or radius > MAX_RADIUS or abs(abs(turned.sum()) - tau) > 1e-6 or not _turns_one_way(turned):
        return None
    at = middle + center
    begin = point_of(at + radius)
    return Arc(begin, begin, point_of(at), Turn.CCW if turned.sum() > 0.0 else Turn.CW), deviation


def _turns_one_way(turned: Floats) -> bool:
    return bool((turned > 0.0).all() or (turned < 0.0).all())


def _sagitta(starts: Points, ends: Points, center: complex, radius: float) -> float:
    """Return how far the points of chords that are nearest to the center are from a circle at most."""
    along = ends - starts
    share = np.clip(((center - starts) * along.conj()).real / np.abs(along) ** 2, 0.0, 1.0)
    return float(np.abs(np.abs(starts + share * along - center) - radius).max())


def _open_run(points: Points, fit: float) -> tuple[list[Piece], float]:
    """Return the longest arcs and lines from the first point to the last, and their largest deviation."""
    pieces: list[Piece] = []
    deviation, at, last = 0.0, 0, len(points) - 1
    while at < last:
        piece: Piece = Line(point_of(points[at]), point_of(points[at + 1]))
        off, reach = 0.0, at + 1
        for make in (_straight, _bent):
            made, end = _longest(points, at, fit, make)
            if made is not None and end > reach:
                (piece, off), reach = made, end
        pieces.append(piece)
        deviation = max(deviation, off)
        at = reach
    return pieces, deviation


def _longest(points: Points, at: int, fit: float, make: _Make) -> tuple[_Fit | None, int]:
    """Return the longest fit from a point, and its end: steps double while they fit, then the last one is bisected."""
    last = len(points) - 1
    end, longest, step = at + 1, None, MIN_LINES
    high = last + 1
    while at + step <= last:
        candidate = make(points[at : at + step + 1], fit)
        if candidate is None:
            high = at + step
            break
        end, longest = at + step, candidate
        step *= 2
    while high - end > 1:
        middle = min((end + high) // 2, last)
        candidate = make(points[at : middle + 1], fit)
        if candidate is None:
            high = middle
        else:
            end, longest = middle, candidate
    return longest, end


def _straight(points: Points, fit: float) -> _Fit | None:
    chord = points[-1] - points[0]
    if abs(chord) == 0.0:
        return None
    local = (points - points[0]) * (chord.conjugate() / abs(chord))
    deviation = float(np.abs(local.imag).max())
    if deviation > fit or (np.diff(local.real) <= 0.0).any():
        return None
    return Line(point_of(points[0]), point_of(points[-1])), deviation


def _bent(points: Points, fit: float) -> _Fit | None:
    """Return the arc through both ends that is nearest to all points; a search finds its height over the chord."""
    if len(points) < MIN_LINES + 1:
        return None
    chord = points[-1] - points[0]
    size = abs(chord)
    if size <= 1e-9:
        return None
    local = (points - points[0]) * (chord.conjugate() / size) - size / 2.0
    bend = np.angle(np.diff(local)[1:] * np.diff(local)[:-1].conj())
    if not (_turns_one_way(bend) or np.abs(bend[bend * bend.sum() < 0.0]).max(initial=0.0) < MIN_CORNER_ANGLE):
        return None
    turn = 1.0 if bend.sum() > 0.0 else -1.0
    if abs(bend.sum()) > tau * 0.95:
        return None
    # heights of the arc above the chord, on the side to which it bulges
    local = np.where(turn > 0.0, local.conj(), local)
    low, high = 0.0, max(2.0 * float(local.imag.max()), 1e-9)
    for _ in range(MAX_NARROWING_STEPS):
        first, second = low + (high - low) / 3.0, high - (high - low) / 3.0
        if _deviation_from_arc(local, size, first) <= _deviation_from_arc(local, size, second):
            high = second
        else:
            low = first
        if high - low <= fit * 1e-3:
            break
    height = (low + high) / 2.0
    deviation = _deviation_from_arc(local, size, height)
    radius = (size * size / 4.0 + height * height) / (2.0 * height)
    if deviation > fit or radius > MAX_RADIUS:
        return None
    below = height - radius
    center = (complex(0.0, -below if turn > 0.0 else below) + size / 2.0) * (chord / size) + points[0]
    return Arc(point_of(points[0]), point_of(points[-1]), point_of(center), Turn(int(turn))), deviation


def _deviation_from_arc(local: Points, size: float, height: float) -> float:
    """Return how far points and their lines are from the arc of this height, above 0, over its chord."""
    radius = (size * size / 4.0 + height * height) / (2.0 * height)
    center = complex(0.0, height - radius)
    deviation = float(np.abs(np.abs(local - center) - radius).max())
    return max(deviation, _sagitta(local[:-1], local[1:], center, radius))
