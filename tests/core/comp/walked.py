"""The look-ahead walk done slowly, one piece after the other with real trimming: what the fast walk must agree with.

Pieces are cut as the walk goes on, and every test is made anew on what is left.  Nothing here comes from the code
under test but the tolerances; points are complex numbers.
"""

from __future__ import annotations

from cmath import phase, rect
from dataclasses import dataclass, replace
from math import sqrt, tau

from core.geometry.piece import Line, Piece
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True)
class Cut:
    """A piece of the chain: the whole of it, and from where to where on it is left (distances from its start).

    `turn` is 0 for a line; `partner` is False for bridges.
    """

    label: float
    whole_start: complex
    whole_end: complex
    low: float
    high: float
    center: complex = 0j
    turn: int = 0
    partner: bool = True

    @property
    def radius(self) -> float:
        return abs(self.whole_start - self.center)

    @property
    def start(self) -> complex:
        return self.at(self.low)

    @property
    def end(self) -> complex:
        return self.at(self.high)

    def at(self, along: float) -> complex:
        """The point at a distance from the whole piece's start."""
        if self.turn:
            return self.center + (self.whole_start - self.center) * rect(1.0, self.turn * along / self.radius)
        length = abs(self.whole_end - self.whole_start)
        return self.whole_start + (self.whole_end - self.whole_start) * (along / length if length else 0.0)

    def along(self, point: complex) -> float:
        """How far along the whole piece a point of its line or circle is, as near to what is left as can be."""
        if not self.turn:
            unit = (self.whole_end - self.whole_start) / abs(self.whole_end - self.whole_start)
            return ((point - self.whole_start) * unit.conjugate()).real
        angle = self.turn * phase((point - self.center) / (self.whole_start - self.center)) % tau
        laps = [(angle + lap) * self.radius for lap in (-tau, 0.0)]
        return min(laps, key=lambda along: max(self.low - along, along - self.high, 0.0))

    def holds(self, point: complex) -> bool:
        return self.low - ON_PATH <= self.along(point) <= self.high + ON_PATH


def meetings(a: Cut, b: Cut) -> tuple[list[complex], bool]:
    """The points on both pieces in the order of a, and whether they only touch."""
    if not a.turn and not b.turn:
        found, touch = _line_line(a, b), False
    elif not a.turn:
        found, touch = _line_circle(a, b)
    elif not b.turn:
        found, touch = _line_circle(b, a)
    else:
        found, touch = _circles(a, b)
    return sorted((point for point in found if a.holds(point) and b.holds(point)), key=a.along), touch


def _line_line(a: Cut, b: Cut) -> list[complex]:
    one, two = a.whole_end - a.whole_start, b.whole_end - b.whole_start
    cross = (one.conjugate() * two).imag
    if abs(cross) <= ON_PATH * min(abs(one), abs(two)):
        return []
    return [a.whole_start + ((b.whole_start - a.whole_start).conjugate() * two).imag / cross * one]


def _line_circle(line: Cut, arc: Cut) -> tuple[list[complex], bool]:
    unit = (line.whole_end - line.whole_start) / abs(line.whole_end - line.whole_start)
    across = ((arc.center - line.whole_start) * unit.conjugate()).imag
    foot = arc.center - 1j * across * unit
    room = arc.radius - abs(across)
    if room < -ON_PATH:
        return [], False
    half = sqrt(max(room * (arc.radius + abs(across)), 0.0))
    return _pair(foot, half, unit), abs(room) <= ON_PATH


def _circles(a: Cut, b: Cut) -> tuple[list[complex], bool]:
    apart = abs(b.center - a.center)
    if apart <= ON_PATH:
        return [], False
    room = min(a.radius + b.radius - apart, apart - abs(a.radius - b.radius))
    if room < -ON_PATH:
        return [], False
    unit = (b.center - a.center) / apart
    foot = (apart**2 + a.radius**2 - b.radius**2) / (2 * apart)
    half = sqrt(max(a.radius**2 - foot**2, 0.0))
    return _pair(a.center + foot * unit, half, 1j * unit), abs(room) <= ON_PATH


def _pair(foot: complex, half: float, unit: complex) -> list[complex]:
    """The chord's two points; within JOINED they are one, and that is the foot."""
    return [foot - half * unit, foot + half * unit] if half > JOINED else [foot]


@dataclass
class Walk:
    """One walk: the rule's numbers, the pieces that are left, and what was deleted, by which labels, where."""

    sign: int
    radius: float
    lookahead: int
    closed: bool
    last: int
    path: list[Cut]
    deleted: list[tuple[float, tuple[float, float], complex]]


def walk(contour: list[Piece], sign: int, radius: float, lookahead: int, *, closed: bool) -> Walk:
    """Compensate a contour without zero-length segments; sign +1 is LEFT."""
    done = Walk(sign, radius, lookahead, closed, len(contour), [], [])
    for row, piece in enumerate(contour):
        here = _offset(piece, row + 1, sign * radius)
        if row:
            here = _joint(done, contour[row - 1], piece, here)
        _push(done, here)
    done.path = [cut for cut in done.path if abs(cut.end - cut.start) > JOINED or cut.high - cut.low > JOINED]
    return done


def _offset(piece: Piece, label: int, shift: float) -> Cut:
    start = complex(*piece.start) + shift * _normal(piece, complex(*piece.start))
    end = complex(*piece.end) + shift * _normal(piece, complex(*piece.end))
    if isinstance(piece, Line):
        return Cut(label, start, end, 0.0, abs(end - start))
    radius = piece.radius - piece.turn * shift
    if radius <= JOINED:
        return Cut(label, start, end, 0.0, abs(end - start), partner=False)
    return Cut(label, start, end, 0.0, radius * abs(piece.sweep), complex(*piece.center), int(piece.turn))


def _normal(piece: Piece, at: complex) -> complex:
    """The unit normal on the piece's left."""
    if isinstance(piece, Line):
        along = complex(*piece.end) - complex(*piece.start)
    else:
        along = 1j * piece.turn * (at - complex(*piece.center))
    return 1j * along / abs(along)


def _joint(done: Walk, before: Piece, behind: Piece, here: Cut) -> Cut:
    """Put a corner arc, a trim or a bridge between the last piece and `here`; returns what `here` then is."""
    corner = complex(*behind.start)
    one, two = _normal(before, corner), _normal(behind, corner)
    if done.radius * abs(one - two) <= JOINED:
        return here
    bend = one.conjugate() * two
    label, previous = here.label - 0.5, done.path[-1]
    if done.sign * bend.imag < 0.0 or (bend.real < 0.0 and done.radius * abs(bend.imag) <= JOINED):
        swept = -done.sign * phase(bend) % tau
        _push(done, Cut(label, previous.end, here.start, 0.0, swept * done.radius, corner, -done.sign))
        return here
    points = meetings(previous, here)[0] if previous.partner and here.partner else []
    if not points:
        done.path.append(Cut(label, previous.end, here.start, 0.0, abs(here.start - previous.end), partner=False))
        return here
    point = points[-1] if done.closed and done.last == 2 else points[0]
    done.path[-1] = replace(previous, high=previous.along(point))
    return replace(here, low=here.along(point))


def _push(done: Walk, here: Cut) -> None:
    """Test a piece against all earlier ones but its predecessor, then append it."""
    for row, a in enumerate(done.path[:-1]):
        point = _crossing(done, a, here)
        if point is not None:
            done.path[row] = replace(a, high=a.along(point))
            between = [cut.label for cut in done.path[row + 1 :] if cut.label == int(cut.label)]
            done.deleted += [(label, (a.label, here.label), point) for label in between]
            del done.path[row + 1 :]
            here = replace(here, low=here.along(point))
            break
    done.path.append(here)


def _crossing(done: Walk, a: Cut, here: Cut) -> complex | None:
    """The first point at which what is left of a is crossed, if the look-ahead tests the pair at all."""
    if not (a.partner and here.partner) or here.label - a.label > done.lookahead:
        return None
    if done.closed and a.label == 1 and here.label == done.last:
        return None
    points, touch = meetings(a, here)
    for point in [] if touch else points:
        ends = abs(point - a.end) <= ON_PATH and abs(point - here.start) <= ON_PATH
        starts = abs(point - a.start) <= ON_PATH and abs(point - here.end) <= ON_PATH
        if not ends and not starts:
            return point
    return None
