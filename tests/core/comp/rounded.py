"""Random smooth and mixed contours as a drawing carries them: every number rounded to some decimals of a millimeter."""

from __future__ import annotations

from cmath import exp, phase
from dataclasses import dataclass
from math import tan, tau

import numpy as np
from numpy.random import Generator

from core.comp.best_path.best_path import BestPath, best_path
from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.verify.judge import judge

DECIMALS = (3, 4, 5, 6, 7)


@dataclass(frozen=True)
class Drawing:
    """A closed contour of exact numbers with its side and radius."""

    contour: Path
    side: Side
    radius: float

    def rounded(self, decimals: int) -> Path:
        """The contour as it is typed from a drawing with this many decimals."""
        points, centers = (np.round(values, decimals) for values in (self.contour.points, self.contour.centers))
        return Path.of(points, centers, self.contour.turns, self.contour.numbers)

    def best(self, decimals: int, wider: float = 0.0) -> BestPath:
        """The best path of the rounded contour, of a cutter by so much wider."""
        return best_path(self.rounded(decimals), self.side, self.radius + wider, closed=True)

    def is_neck(self, decimals: int) -> bool:
        """Does moving the wall by the rounding itself open or close a neck?"""
        slack = 2.0 * 10.0**-decimals
        narrow, wide = (self.best(decimals, wider) for wider in (-slack, slack))
        return len(narrow.loops) != len(wide.loops) or abs(length(narrow) - length(wide)) > 1000.0 * slack

    def gouges(self, decimals: int) -> bool:
        """Does the judge find a gouge, or a piece on the part's side, in the best path of the rounded contour?"""
        best = self.best(decimals)
        verdict = judge(self.rounded(decimals), self.side, self.radius, best.loops)
        return not verdict.judged or bool(verdict.gouges) or bool(verdict.wrong_side)


def length(best: BestPath) -> float:
    """Length of all loops."""
    return sum(float(loop.lengths.sum()) for loop in best.loops)


def widest_end_gap(best: BestPath) -> float:
    """How far the ends of any loop are apart."""
    return max((float(np.hypot(*(loop.points[-1] - loop.points[0]))) for loop in best.loops), default=0.0)


def drawing(seed: int) -> Drawing:
    """The drawing of a seed: rounded polygons, biarc curves or slots, smooth or with corners."""
    rng = np.random.default_rng(seed)
    kind, mixed = int(rng.integers(5)), bool(rng.integers(2))
    if kind == 4:
        return _slots(rng)
    pieces = _biarcs(rng, mixed=mixed) if kind >= 2 else _filleted(rng, mixed=mixed)
    radius = float(rng.choice([1.0, 2.0, 3.0, 5.0, 8.0, 10.0])) if rng.random() < 0.7 else float(rng.uniform(0.2, 12.0))
    return Drawing(Path.from_pieces(pieces), Side.LEFT if rng.random() < 0.5 else Side.RIGHT, round(radius, 3))


def _point(place: complex) -> Point:
    return place.real, place.imag


def _line(start: complex, end: complex) -> Line:
    return Line(_point(start), _point(end))


def _arc(start: complex, end: complex, center: complex, turn: int) -> Arc:
    return Arc(_point(start), _point(end), _point(center), Turn(turn))


def _around(rng: Generator, count: int, reach: Floats) -> list[complex]:
    shares = np.arange(count) + rng.uniform(-0.35, 0.35, count)
    places: list[complex] = (reach * np.exp(1j * shares * tau / count)).tolist()
    return places


def _filleted(rng: Generator, *, mixed: bool) -> list[Piece]:
    """A star-shaped polygon whose corners are rounded, some by the cutter's own radius, some not at all."""
    count = int(rng.integers(4, 13))
    corners = _around(rng, count, rng.uniform(15.0, 60.0, count))
    pieces: list[Piece] = []
    first = at = (corners[-1] + corners[0]) / 2.0
    for row, corner in enumerate(corners):
        before, behind = corner - corners[row - 1], corners[(row + 1) % count] - corner
        bend = phase(behind / before)
        room = 0.499 * min(abs(before), abs(behind)) / max(abs(tan(bend / 2.0)), 1e-6)
        size = min(float(rng.choice([3.0, 5.0, 8.0, rng.uniform(0.5, 20.0), room])), room, 500.0)
        if (mixed and rng.random() < 0.4) or size * abs(bend) < 0.05:
            # rounding may turn a shorter arc into a full circle
            pieces.append(_line(at, corner))
            at = corner
            continue
        turn, cut = 1 if bend > 0.0 else -1, size * abs(tan(bend / 2.0))
        unit = before / abs(before)
        start, end = corner - cut * unit, corner + cut * behind / abs(behind)
        if abs(start - at) > 1e-3:
            pieces.append(_line(at, start))
        pieces.append(_arc(pieces[-1].end[0] + 1j * pieces[-1].end[1], end, start + 1j * turn * size * unit, turn))
        at = end
    return [*pieces, _line(at, first)]


def _biarcs(rng: Generator, *, mixed: bool) -> list[Piece]:
    """A closed curve of pairs of tangent arcs, some replaced by straight lines."""
    count = int(rng.integers(4, 12))
    places = _around(rng, count, rng.uniform(20.0, 55.0, count))
    headings = [places[(row + 1) % count] - places[row - 1] for row in range(count)]
    headings = [heading / abs(heading) * exp(1j * rng.uniform(-0.3, 0.3)) for heading in headings]
    pieces: list[Piece] = []
    for row, start in enumerate(places):
        end, out, back = places[(row + 1) % count], headings[row], headings[(row + 1) % count]
        straight = 2.0 * (1.0 - (out.conjugate() * back).real)
        if straight < 1e-9 or (mixed and rng.random() < 0.3):
            pieces.append(_line(start, end))
            continue
        along = ((end - start).conjugate() * (out + back)).real
        reach = (-along + (along**2 + straight * abs(end - start) ** 2) ** 0.5) / straight
        middle = (start + end + reach * (out - back)) / 2.0
        pieces += [_tangent(start, middle, out, start), _tangent(middle, end, back, end)]
    return pieces


def _tangent(start: complex, end: complex, heading: complex, at: complex) -> Piece:
    """The arc between two points that is tangent to a heading at one of them; a line where that is all but straight."""
    chord = end - start if at == start else start - end
    aside = (chord.conjugate() * 1j * heading).real
    if abs(aside) < 1e-9 or abs(chord) ** 2 / abs(2.0 * aside) > 3000.0:
        return _line(start, end)
    return _arc(start, end, at + 1j * heading * abs(chord) ** 2 / (2.0 * aside), 1 if aside > 0.0 else -1)


def _slots(rng: Generator) -> Drawing:
    """A plate with round-ended slots as wide as the cutter or nearly, their mouths rounded."""
    radius, x = float(rng.choice([2.0, 3.0, 5.0])), 0.0
    pieces: list[Piece] = []
    at = 0j
    for _ in range(int(rng.integers(1, 4))):
        half = radius + float(rng.choice([0.0, 1e-3, 1e-4, -1e-3, 0.5, -0.3]))
        mouth, deep = float(rng.uniform(0.5, 3.0)), float(rng.uniform(8.0, 20.0))
        x += 10.0
        left, right = x + mouth, x + mouth + 2.0 * half
        pieces += [_line(at, complex(x)), _arc(complex(x), left - 1j * mouth, x - 1j * mouth, -1)]
        pieces += [_line(left - 1j * mouth, left - 1j * deep)]
        pieces += [_arc(left - 1j * deep, right - 1j * deep, left + half - 1j * deep, 1)]
        pieces += [_line(right - 1j * deep, right - 1j * mouth)]
        x = right + mouth
        pieces += [_arc(right - 1j * mouth, complex(x), x - 1j * mouth, -1)]
        at = complex(x)
    for place in (x + 10.0 + 0j, x + 10.0 + 60j, 60j, 0j):
        pieces.append(_line(at, place))
        at = place
    turned = exp(1j * float(rng.uniform(0.0, tau)))
    path = Path.from_pieces(pieces)
    points, centers = ((values[:, 0] + 1j * values[:, 1]) * turned for values in (path.points, path.centers))
    rows, middles = (np.stack((places.real, places.imag), axis=1) for places in (points, centers))
    return Drawing(Path.of(rows, middles, path.turns), Side.LEFT, radius)
