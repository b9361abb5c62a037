"""Fits ellipses and B-splines with tangent arcs (biarcs) that deviate from them by no more than FIT.

A biarc is two arcs that meet tangentially, with given ends and given tangents there.  A curve is split at its corners;
between them each biarc is as long as FIT allows.  Millimeters; points are complex numbers.

Formula of the biarc with equal tangent lengths d: |v|^2 - 2 d v.(t1 + t2) - 2 d^2 (1 - t1.t2) = 0 for the chord v and
the unit tangents t1, t2; K. M. Bolton, "Biarc curves", Computer-Aided Design 7 (1975).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import atan2, ceil, cos, floor, hypot, pi, tau
from typing import Final, TypeVar

import numpy as np

from core.geometry.path import Floats, Points
from core.geometry.piece import Arc, Line, Piece, Turn, point_of
from core.importing.drawing import BSpline, EllipseArc

SAMPLE_FRACTIONS: Final = np.linspace(0.0, 1.0, 25)
"""Where the distance of a biarc from the curve is sampled, as fractions of its parameter range in each span."""

MAX_ERROR_SHARE: Final = 0.98
"""Fraction of FIT that the sampled distance may reach; between two samples it is a little larger."""

MIN_CORNER_ANGLE: Final = 1e-3
"""A knot is a corner if the curve turns there by more than this, in radians."""

MAX_BEND: Final = 0.55 * pi
"""Largest turn of a curve within one biarc, in radians."""

MAX_LINE_DEVIATION: Final = 1e-6
"""A curve counts as a line if it deviates from its chord by no more than this, in millimeters."""

MAX_RADIUS: Final = 100_000.0
"""Largest radius of an arc in millimeters: beyond it the center is out of a form's range."""

SAME_ARC: Final = 1e-6
"""Two arcs are one if centers and radii differ by no more than this in mm, times a radius above 1 mm."""

MAX_CIRCLE_DIFFERENCE: Final = 1e-9
"""An ellipse is a circle if its semi-diameters differ by no more than this fraction."""

MIN_ARC_FACTOR: Final = 10.0
"""Shortest arc as a multiple of FIT; shorter ones remain only if FIT requires them."""

MOVED_STOPS: Final = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Fractions of the range of two neighboring biarcs at which a new stop between them is tried."""

MIN_GROWTH_FACTOR: Final = 1.5
"""A stop is moved only if the shortest arc grows by more than this factor."""

LONG_ENOUGH: Final = 0.6
"""The last biarc stays as it is if it has at least this fraction of the others' length."""

LONGEST_ERROR_SHARE: Final = 0.9
"""A biarc counts as the longest if its error is at least this fraction of FIT."""

SAMPLES_PER_SPAN: Final = 32
"""Curvature samples per smooth span."""


@dataclass(frozen=True, eq=False, slots=True)
class _SplineCurve:
    """Bezier spans of one degree: (degree + 1, spans) control points x + iy, each times its weight, and the weights.

    The parameter counts spans.  `weights` is None if all are equal.
    """

    control: Points
    weights: Floats | None

    def at(self, parameters: Floats) -> tuple[Points, Points]:
        """Evaluate by de Casteljau's interpolation; the last two points before the result give the derivative."""
        span = np.minimum(parameters.astype(np.intp), self.control.shape[1] - 1)
        share = parameters - span
        point, tangent = _interpolated(self.control[:, span], share)
        if self.weights is None:
            return point, tangent
        weight, change = _interpolated(self.weights[:, span], share)
        # the derivative of a quotient
        return point / weight, (tangent * weight - point * change) / (weight * weight)

    def part(self, first: int, last: int) -> _SplineCurve:
        """Return spans first ... last - 1 as a curve; its end direction does not depend on the span after it."""
        return _SplineCurve(self.control[:, first:last], None if self.weights is None else self.weights[:, first:last])


Curve = EllipseArc | _SplineCurve
"""A smooth curve over a parameter."""

Row = TypeVar("Row", Points, Floats)


def _interpolated(rows: Row, share: Floats) -> tuple[Row, Row]:
    """Return values and derivatives of polynomials with Bezier coefficients `rows`, (degree + 1, n), at (n,) shares."""
    degree = len(rows) - 1
    while len(rows) > 2:
        rows = rows[:-1] + (rows[1:] - rows[:-1]) * share
    ahead = rows[1] - rows[0]
    return rows[0] + ahead * share, degree * ahead


def pieces_of_ellipse(shape: EllipseArc, fit: float) -> list[Piece]:
    """Return an ellipse or part of one as arcs; a circle is one arc, or a line if huge (MAX_RADIUS) and flat (FIT)."""
    a, b = abs(shape.first), abs(shape.second)
    across = abs((shape.first.conjugate() * shape.second).real)
    if abs(a - b) <= MAX_CIRCLE_DIFFERENCE * max(a, b) and across <= MAX_CIRCLE_DIFFERENCE * a * b:
        arc, sweep = _circle(shape), shape.end - shape.begin
        nearly_straight = a > MAX_RADIUS and a * (1.0 - cos(sweep / 2.0)) <= fit
        return [Line(arc.start, arc.end) if nearly_straight else arc]
    flat = abs((shape.first.conjugate() * shape.second).imag)
    if flat <= MAX_LINE_DEVIATION * max(a, b):
        return _flattened(shape)
    if (shape.first.conjugate() * shape.second).imag < 0.0:
        # a mirrored copy drawn over an arc gives the same arcs
        shape = EllipseArc(shape.center, shape.first, -shape.second, -shape.end, -shape.begin)
    # cached about the origin: drawings often repeat an ellipse of one size
    x, y = shape.center.real, shape.center.imag
    return [moved_piece(piece, x, y) for piece in _ellipse_about_origin(replace(shape, center=0j), fit)]


@lru_cache(maxsize=256)
def _ellipse_about_origin(curve: EllipseArc, fit: float) -> tuple[Piece, ...]:
    """Return the arcs of an ellipse about the origin; each quarter mirrors the one before it."""
    stations = _ellipse_stations(curve)
    stops, quarter, row = stations[:1], list[float](), 0
    for number, (here, there) in enumerate(pairwise(stations)):
        if abs(there - here - pi / 2) > MAX_CIRCLE_DIFFERENCE:
            stops += _balanced_stops(curve, here, there, fit)[1:]
            continue
        if not quarter:
            quarter, row = [stop - here for stop in _balanced_stops(curve, here, there, fit)], number
        turned = quarter if (number - row) % 2 == 0 else [pi / 2 - stop for stop in reversed(quarter)]
        stops += [*(here + stop for stop in turned[1:-1]), there]
    pieces = _biarcs(curve, stops, fit)
    if curve.end - curve.begin >= tau * (1.0 - MAX_CIRCLE_DIFFERENCE):
        pieces = _merged([*pieces[:-1], replace(pieces[-1], end=pieces[0].start)])
    return tuple(pieces)


def moved_piece(piece: Piece, x: float, y: float) -> Piece:
    """Return a piece moved by x and y."""
    start, end = (piece.start[0] + x, piece.start[1] + y), (piece.end[0] + x, piece.end[1] + y)
    if isinstance(piece, Arc):
        return Arc(start, end, (piece.center[0] + x, piece.center[1] + y), piece.turn)
    return Line(start, end)


def _circle(shape: EllipseArc) -> Arc:
    turn = Turn.CCW if (shape.first.conjugate() * shape.second).imag > 0.0 else Turn.CW
    start, end = shape.at(np.array([shape.begin, shape.end]))[0].tolist()
    center = (shape.center.real, shape.center.imag)
    first = (start.real, start.imag)
    full_turn = shape.end - shape.begin >= tau * (1.0 - MAX_CIRCLE_DIFFERENCE)
    return Arc(first, first if full_turn else (end.real, end.imag), center, turn)


def _flattened(shape: EllipseArc) -> list[Piece]:
    """Return the lines of an ellipse seen edge-on, from each reversal of its travel to the next."""
    first, second = (
        (shape.first, shape.second) if abs(shape.first) >= abs(shape.second) else (shape.second, shape.first)
    )
    along = first / abs(first)
    turning = atan2((second * along.conjugate()).real, abs(first)) if first is shape.first else pi / 2
    steps = range(ceil((shape.begin - turning) / pi), int((shape.end - turning) // pi) + 1)
    stations = np.array([shape.begin, *(turning + step * pi for step in steps), shape.end])
    points = shape.at(stations)[0].tolist()
    return [Line((p.real, p.imag), (q.real, q.imag)) for p, q in pairwise(points) if p != q]


def _ellipse_stations(shape: EllipseArc) -> list[float]:
    """Return the ends of part of an ellipse and the vertices between them, where its curvature is extreme."""
    u, v = shape.first, shape.second
    axis = 0.5 * atan2(2.0 * (u.conjugate() * v).real, abs(u) ** 2 - abs(v) ** 2)
    first = ceil((shape.begin - axis) / (pi / 2) + MAX_CIRCLE_DIFFERENCE)
    last = ceil((shape.end - axis) / (pi / 2) - MAX_CIRCLE_DIFFERENCE)
    vertices = [axis + step * pi / 2 for step in range(first, last)]
    return [shape.begin, *vertices, shape.end]


def pieces_of_spline(shape: BSpline, fit: float) -> list[Piece]:
    """Return a B-spline as arcs and lines."""
    curve = _bezier_curve(shape)
    return [piece for first, last in _smooth_runs(curve) for piece in _fitted(curve.part(first, last), fit)]


def ends_of_spline(shape: BSpline) -> tuple[complex, complex]:
    """Return the start and the end of a B-spline, in the unit of its control points."""
    curve = _bezier_curve(shape)
    start, end = curve.at(np.array([0.0, float(curve.control.shape[1])]))[0].tolist()
    return start, end


def _fitted(curve: _SplineCurve, fit: float) -> list[Piece]:
    """Return a smooth curve as arcs and lines: split at its curvature extremes or not, whichever needs fewer."""
    end = float(curve.control.shape[1])
    stations = _curvature_extremes(curve, 0.0, end)
    divided = [_stops(curve, here, there, fit * MAX_ERROR_SHARE) for here, there in pairwise(stations) if there > here]
    undivided = [_stops(curve, 0.0, end, fit * MAX_ERROR_SHARE)] if len(divided) > 1 else divided
    chosen = min((divided, undivided), key=lambda runs: sum(len(run) - 1 for run in runs))
    balanced = [_balanced(curve, run, fit * MAX_ERROR_SHARE) for run in chosen]
    return _biarcs(curve, [0.0, *(stop for run in balanced for stop in run[1:])], fit)


def _bezier_curve(shape: BSpline) -> _SplineCurve:
    """Return the Bezier span of every knot interval that has a length, by blossoming."""
    degree, knots = shape.degree, shape.knots
    size = float(knots[-1] - knots[0])
    spans = [k for k in range(degree, len(shape.points)) if knots[k + 1] - knots[k] > 1e-12 * size]
    weights = shape.weights / shape.weights[0]
    rows = np.column_stack((shape.points * weights, weights)).astype(np.complex128)
    coefficients = np.array([[_blossom(rows, knots, degree, k, j) for k in spans] for j in range(degree + 1)])
    return _SplineCurve(coefficients[..., 0], None if np.all(weights == 1.0) else coefficients[..., 1].real)


def _blossom(rows: Points, knots: Floats, degree: int, k: int, j: int) -> Points:
    """Return control point j of the span from knot k: the blossom at degree - j times its start and j times its end."""
    values = rows[k - degree : k + 1]
    arguments = [knots[k]] * (degree - j) + [knots[k + 1]] * j
    for level, at in enumerate(arguments, 1):
        low = knots[k - degree + level : k + 1]
        high = knots[k + 1 : k + 1 + degree - level + 1]
        share = ((at - low) / (high - low))[:, None]
        values = values[:-1] * (1.0 - share) + values[1:] * share
    first: Points = values[0]
    return first


def _smooth_runs(curve: _SplineCurve) -> list[tuple[int, int]]:
    """Return the runs of spans between corners as (first, after last); spans without length belong to none."""
    count = curve.control.shape[1]
    flat = curve.control if curve.weights is None else curve.control / curve.weights
    spread = np.maximum(np.ptp(flat.real, axis=0), np.ptp(flat.imag, axis=0))
    runs: list[tuple[int, int]] = []
    for span in range(count):
        if spread[span] <= MAX_LINE_DEVIATION * 1e-3:
            continue
        if runs and runs[-1][1] == span and _is_smooth(curve, span):
            runs[-1] = (runs[-1][0], span + 1)
        else:
            runs.append((span, span + 1))
    return runs


def _is_smooth(curve: _SplineCurve, span: int) -> bool:
    near = np.array([span - 1e-6, span + 1e-6])
    before, after = curve.at(near)[1].tolist()
    turned = before.conjugate() * after
    return abs(atan2(turned.imag, turned.real)) <= MIN_CORNER_ANGLE and abs(turned) > 0.0


def _curvature_extremes(curve: Curve, first: float, last: float) -> list[float]:
    """Return the ends of a stretch and, between them, where its curvature is extreme or changes sign."""
    at = np.linspace(first, last, max(int(last - first) * SAMPLES_PER_SPAN, SAMPLES_PER_SPAN) + 1)
    _, tangents = curve.at(at)
    size = np.abs(tangents)
    size[size == 0.0] = 1.0
    direction = np.unwrap(np.angle(tangents))
    bend = np.gradient(direction, at) / size
    change = np.diff(np.abs(bend))
    noise = 1e-6 * float(np.abs(bend).max()) if len(bend) else 0.0
    rows = np.flatnonzero((change[:-1] * change[1:] < 0.0) & (np.abs(change[:-1]) > noise)) + 1
    return [first, *(float(at[row]) for row in rows), last]


def _biarcs(curve: Curve, stops: list[float], fit: float) -> list[Piece]:
    """Return the biarcs from stop to stop, none shorter than it must be."""
    stops = _without_short_arcs(curve, stops, fit)
    return _merged([piece for first, last in pairwise(stops) for piece in _biarc_between(curve, first, last)[0]])


def _without_short_arcs(curve: Curve, stops: list[float], fit: float) -> list[float]:
    """Remove the stops that make arcs shorter than `MIN_ARC_FACTOR` times FIT, if FIT allows it.

    A biarc with such an arc is merged with its neighbor, or the stop between the two is moved.
    """
    biarcs = [_biarc_between(curve, first, last)[0] for first, last in pairwise(stops)]
    row = 0
    while row < len(biarcs):
        change = None
        if _shortest(biarcs[row]) < MIN_ARC_FACTOR * fit:
            change = next(filter(None, (_replacement(curve, stops, biarcs, at, fit) for at in (row, row + 1))), None)
        if change is None:
            row += 1
            continue
        at, between = change
        stops[at : at + 1] = between
        ends = [stops[at - 1], *between, stops[at + len(between)]]
        biarcs[at - 1 : at + 1] = [_biarc_between(curve, first, last)[0] for first, last in pairwise(ends)]
        # a neighbor may merge with the longer biarc now
        row = max(at - 2, 0)
    return stops


def _replacement(
    curve: Curve, stops: list[float], biarcs: list[list[Piece]], at: int, fit: float
) -> tuple[int, list[float]] | None:
    """Return an inner stop and its replacement: nothing, or a stop that gives both neighbors longer arcs."""
    if not 0 < at < len(stops) - 1:
        return None
    begin, end = stops[at - 1], stops[at + 1]
    if _biarc_between(curve, begin, end)[1] <= fit * MAX_ERROR_SHARE:
        return at, []
    worst = min(_shortest(biarcs[at - 1]), _shortest(biarcs[at]))
    for share in MOVED_STOPS:
        middle = begin + share * (end - begin)
        halves = [_biarc_between(curve, begin, middle), _biarc_between(curve, middle, end)]
        if all(error <= fit * MAX_ERROR_SHARE for _, error in halves):
            shortest = min(_shortest(pieces) for pieces, _ in halves)
            if shortest > MIN_GROWTH_FACTOR * worst:
                return at, [middle]
    return None


def _shortest(pieces: list[Piece]) -> float:
    return min((piece.length for piece in pieces), default=float("inf"))


def _balanced_stops(curve: Curve, begin: float, end: float, fit: float) -> list[float]:
    return _balanced(curve, _stops(curve, begin, end, fit * MAX_ERROR_SHARE), fit * MAX_ERROR_SHARE)


def _balanced(curve: Curve, stops: list[float], fit: float) -> list[float]:
    """Even out the stops: with the last biarc about as long as the others, all hold a tighter tolerance."""
    if len(stops) == 2:
        return stops
    # the error of a biarc grows with the cube of its length
    last = (_biarc_between(curve, stops[-2], stops[-1])[1] / fit) ** (1 / 3)
    share = (len(stops) - 2 + last) / (len(stops) - 1)
    if last >= LONG_ENOUGH:
        return stops
    for smaller in (share, (share + 1.0) / 2.0):
        other = _stops(curve, stops[0], stops[-1], fit * smaller**3)
        if len(other) <= len(stops):
            return other
    return stops


def _stops(curve: Curve, begin: float, end: float, fit: float) -> list[float]:
    """Return the parameters at which the biarcs end, from the first to the last."""
    stops, step = [begin], end - begin
    while stops[-1] < end:
        here = stops[-1]
        step = _longest_step(curve, here, min(step, end - here), end - here, fit)
        stops.append(end if here + step >= end - 1e-12 * abs(end - begin) else here + step)
    return stops


def _longest_step(curve: Curve, here: float, step: float, largest_step: float, fit: float) -> float:
    """Return the longest step within FIT, to `LONGEST_ERROR_SHARE` of FIT.

    A biarc's error grows with the cube of its length.
    """
    low, high = 0.0, 0.0
    for _ in range(60):
        error = _biarc_between(curve, here, here + step)[1]
        if error <= fit:
            low = step
            if step >= largest_step or error >= LONGEST_ERROR_SHARE * fit:
                break
        else:
            high = step
        guess = step * (0.97 * fit / error) ** (1 / 3) if 0.0 < error < float("inf") else 2.0 * step
        if high and not low < guess < high:
            guess = (low + high) / 2.0
        step = min(max(guess, step / 4.0), 4.0 * step, largest_step)
        if high and high - low <= 1e-3 * high and low:
            break
    return low or high


def _biarc_between(curve: Curve, first: float, last: float) -> tuple[list[Piece], float]:
    """Return the biarc between two parameters and its distance from the curve, infinite if it turns too much."""
    points, tangents = curve.at(_samples(curve, first, last))
    start, end = complex(points[0]), complex(points[-1])
    turned = tangents[1:] * tangents[:-1].conj()
    if not turned.all():
        return [_line(start, end)], float(np.abs(points - start).max())
    if np.abs(np.arctan2(turned.imag, turned.real)).sum() > MAX_BEND and last - first > 1e-9:
        return [], float("inf")
    if _deviation_from_chord(points) <= MAX_LINE_DEVIATION:
        return [_line(start, end)], 0.0
    t1, t2 = complex(tangents[0]), complex(tangents[-1])
    pieces = biarc(start, end, t1 / abs(t1), t2 / abs(t2))
    return pieces, _deviation(points, pieces)


def _samples(curve: Curve, first: float, last: float) -> Floats:
    """Return parameters at which a biarc's distance from the curve is measured.

    They are equally many in each span of a spline, since a long span may be next to very short ones.
    """
    joints = range(floor(first) + 1, ceil(last)) if isinstance(curve, _SplineCurve) else ()
    stops = np.array([first, *joints, last])
    begins, sizes = stops[:-1, None], np.diff(stops)[:, None]
    return np.append((begins + sizes * SAMPLE_FRACTIONS[:-1]).ravel(), last)


def _deviation_from_chord(points: Points) -> float:
    """Return how far points deviate from the line between the first and the last of them."""
    chord = complex(points[-1] - points[0])
    size = abs(chord)
    if size == 0.0:
        return float(np.abs(points - points[0]).max())
    local = (points - points[0]) * (chord.conjugate() / size)
    ahead = local.real
    return float(max(np.abs(local.imag).max(), -ahead.min(), ahead.max() - size))


def biarc(start: complex, end: complex, first: complex, last: complex) -> list[Piece]:
    """Return the two arcs, or an arc and a line, that join two ends with these unit tangents; equal tangent lengths."""
    chord = end - start
    across = first + last
    a, b, c = 2.0 * (1.0 - _dot(first, last)), 2.0 * _dot(chord, across), -(abs(chord) ** 2)
    # the root of a d^2 + b d + c that stays finite where a vanishes
    below = b + (b * b - 4.0 * a * c) ** 0.5
    length = -2.0 * c / below if below > 0.0 else 0.0
    if length <= 0.0:
        return [_line(start, end)]
    joint = (start + first * length + end - last * length) / 2.0
    return [_tangent_arc(start, joint, first), _tangent_arc(end, joint, -last).reversed()]


def _dot(u: complex, v: complex) -> float:
    return u.real * v.real + u.imag * v.imag


def _tangent_arc(start: complex, end: complex, tangent: complex) -> Piece:
    """Return the arc that leaves `start` along a tangent and reaches `end`; a line if its radius would be too large."""
    chord = end - start
    normal = tangent * 1j
    side = 2.0 * _dot(chord, normal)
    if abs(side) * MAX_RADIUS <= abs(chord) ** 2:
        return _line(start, end)
    center = start + normal * (abs(chord) ** 2 / side)
    return Arc(point_of(start), point_of(end), point_of(center), Turn.CCW if side > 0.0 else Turn.CW)


def _line(start: complex, end: complex) -> Line:
    return Line(point_of(start), point_of(end))


def _deviation(points: Points, pieces: list[Piece]) -> float:
    """Return how far points are from one or two tangent pieces along them; each belongs to the piece next to it."""
    distances = _distances_from_carrier(points, pieces[0])
    if len(pieces) == 2:
        joint, along = complex(*pieces[0].end), complex(*pieces[0].direction_at(pieces[0].end))
        beyond = ((points - joint) * along.conjugate()).real > 0.0
        distances = np.where(beyond, _distances_from_carrier(points, pieces[1]), distances)
    return float(distances.max())


def _distances_from_carrier(points: Points, piece: Piece) -> Floats:
    """Return the distances of points from the circle or line that carries a piece."""
    if isinstance(piece, Arc):
        return np.abs(np.abs(points - complex(*piece.center)) - piece.radius)
    start = complex(*piece.start)
    chord = complex(*piece.end) - start
    size = abs(chord)
    return np.abs(points - start) if size == 0.0 else np.abs(((points - start) * (chord.conjugate() / size)).imag)


def _merged(pieces: list[Piece]) -> list[Piece]:
    """Merge consecutive arcs of one circle, and consecutive lines of one direction."""
    merged: list[Piece] = []
    for piece in pieces:
        last = merged[-1] if merged else None
        joined = None if last is None else _joined_pair(last, piece)
        if joined is None:
            merged.append(piece)
        else:
            merged[-1] = joined
    if len(merged) > 1 and merged[0].start == merged[-1].end and (joined := _joined_pair(merged[-1], merged[0])):
        merged = [joined, *merged[1:-1]] if len(merged) > 2 or joined.start != joined.end else [joined]
    return merged


def _joined_pair(first: Piece, second: Piece) -> Piece | None:
    if isinstance(first, Line) and isinstance(second, Line):
        points = np.array([complex(*first.start), complex(*first.end), complex(*second.end)])
        return Line(first.start, second.end) if _deviation_from_chord(points) <= MAX_LINE_DEVIATION else None
    if not (isinstance(first, Arc) and isinstance(second, Arc)) or first.turn is not second.turn:
        return None
    center_distance = hypot(first.center[0] - second.center[0], first.center[1] - second.center[1])
    slack = SAME_ARC * max(1.0, first.radius)
    if center_distance > slack or abs(first.radius - second.radius) > slack or first.start == first.end:
        return None
    total_sweep = abs(first.sweep) + abs(second.sweep)
    if total_sweep > tau + 1e-6:
        return None
    end = first.start if total_sweep > tau - 1e-6 else second.end
    return Arc(first.start, end, first.center, first.turn)
