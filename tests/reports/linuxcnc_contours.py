"""Contours for the comparison with LinuxCNC, seeded: open and closed, lines and arcs, tangent, sharp, tiny and large.

The cutter's radius is 100 mm and everything else goes with it, so that four printed decimals are many digits.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Callable
from dataclasses import dataclass
from math import pi, tau
from random import Random
from typing import Final

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn

RADIUS: Final = 100.0


@dataclass(frozen=True, eq=False)
class Part:
    """A contour with its side; `rapid` are the numbers of segments programmed as rapid moves, all of them lines."""

    name: str
    contour: Path
    side: Side
    closed: bool
    rapid: frozenset[int] = frozenset()


def part(seed: int) -> Part:
    """The part of a seed: the kinds take turns."""
    random = Random(seed)
    kind = KINDS[seed % len(KINDS)]
    return kind(random, f"{kind.__name__} {seed}")


def open_lines(random: Random, name: str) -> Part:
    """A few lines, now and then a rapid one."""
    pieces = _chain(random, random.randint(1, 7), lambda: (0, random.uniform(1.0, 5.0)), _corner)
    rapid = frozenset(row for row in range(2, len(pieces) + 1) if random.random() < 0.06)
    return Part(name, Path.from_pieces(pieces), _side(random), False, rapid)


def open_mixed(random: Random, name: str) -> Part:
    """Lines and arcs at corners of every kind."""
    pieces = _chain(random, random.randint(1, 7), lambda: _lines_and_arcs(random), _corner)
    return Part(name, Path.from_pieces(pieces), _side(random), False)


def tangent(random: Random, name: str) -> Part:
    """Lines and arcs that run into one another."""
    pieces = _chain(random, random.randint(2, 9), lambda: _lines_and_arcs(random), lambda _: 0.0)
    return Part(name, Path.from_pieces(pieces), _side(random), False)


def nearly_tangent(random: Random, name: str) -> Part:
    """Corners about as small as LinuxCNC takes for none."""
    pieces = _chain(
        random,
        random.randint(2, 6),
        lambda: _lines_and_arcs(random),
        lambda _: random.choice((-1, 1)) * random.uniform(0.0, 0.08),
    )
    return Part(name, Path.from_pieces(pieces), _side(random), False)


def tiny(random: Random, name: str) -> Part:
    """Steps and arcs much smaller than the cutter between larger ones, arcs hardly larger or exactly as large as it."""

    def size() -> tuple[int, float]:
        kind = random.random()
        if kind < 0.25:
            return 0, random.choice((0.001, 0.02, 0.2)) * random.uniform(0.5, 1.5)
        if kind < 0.5:
            return random.choice((-1, 1)), random.choice((0.005, 0.05, 0.3, 1.0, 1.0001, 1.01))
        return 0, random.uniform(1.5, 5.0)

    pieces = _chain(random, random.randint(2, 5), size, lambda some: some.choice((0.0, 0.7, 1.0)) * _corner(some))
    return Part(name, Path.from_pieces(pieces), _side(random), False)


def convex(random: Random, name: str) -> Part:
    """A closed outline that bends one way only."""
    return _closed(random, name, lambda: 1.0, rise=(0.0, 0.4))


def star(random: Random, name: str) -> Part:
    """A closed outline with corners in and out, its sides lines and arcs."""
    return _closed(random, name, lambda: random.uniform(0.6, 1.4), rise=(-0.5, 0.5))


def _closed(random: Random, name: str, reach: Callable[[], float], rise: tuple[float, float]) -> Part:
    count = random.randint(3, 9)
    size = RADIUS * random.uniform(2.0, 9.0)
    angles = sorted(random.uniform(0.0, tau) for _ in range(count))
    corners = [rect(size * reach(), angle) for angle in angles]
    if random.random() < 0.4:
        corners.append(corners[0] + random.uniform(0.2, 0.8) * (corners[-1] - corners[0]))
        corners = corners[-1:] + corners[:-1]
    if random.random() < 0.5:
        corners.reverse()
        rise = (-rise[1], -rise[0])
    ends = [*corners[1:], corners[0]]
    pieces = [_side_piece(random, *pair, rise) for pair in zip(corners, ends, strict=True)]
    return Part(name, Path.from_pieces(pieces), _side(random), True)


def _side_piece(random: Random, start: complex, end: complex, rise: tuple[float, float]) -> Piece:
    """A line, or an arc whose bulge over the chord is between the two rises."""
    if random.random() < 0.6:
        return Line(_at(start), _at(end))
    bulge = random.uniform(*rise)
    if abs(bulge) < 0.01:
        return Line(_at(start), _at(end))
    chord = end - start
    center = (start + end) / 2 + 1j * chord * (1 - bulge * bulge) / (4 * bulge)
    return Arc(_at(start), _at(end), _at(center), Turn.CCW if bulge > 0 else Turn.CW)


def _lines_and_arcs(random: Random) -> tuple[int, float]:
    if random.random() < 0.5:
        return 0, random.uniform(0.5, 5.0)
    return random.choice((-1, 1)), random.choice((0.4, 1.5, 3.0, 8.0)) * random.uniform(0.8, 1.2)


def _corner(random: Random) -> float:
    """The angle of a corner in radians: none, small, of the usual drawings, any, or turning back."""
    kind = random.random()
    if kind < 0.25:
        return 0.0
    sign = random.choice((-1, 1))
    if kind < 0.35:
        return sign * random.uniform(0.0, 0.2)
    if kind < 0.6:
        return sign * random.choice((pi / 2, pi / 4, pi / 3))
    if kind < 0.63:
        return sign * random.choice((pi, 3.12, 3.05))
    return sign * random.uniform(0.1, 2.4)


def _chain(
    random: Random, count: int, size: Callable[[], tuple[int, float]], corner: Callable[[Random], float]
) -> list[Piece]:
    """Pieces one behind the other: each has a turn and a size in cutter radii, and a corner in front of it."""
    at, heading = complex(random.uniform(-50, 50), random.uniform(-50, 50)), rect(1.0, random.uniform(-pi, pi))
    pieces: list[Piece] = []
    for row in range(count):
        heading *= rect(1.0, corner(random)) if row else 1.0
        turn, length = size()
        piece, at, heading = _piece(random, at, heading, turn, length * RADIUS)
        pieces.append(piece)
    return pieces


def _piece(random: Random, at: complex, heading: complex, turn: int, size: float) -> tuple[Piece, complex, complex]:
    if not turn:
        end = at + size * heading
        return Line(_at(at), _at(end)), end, heading
    swept = rect(1.0, turn * random.choice((0.3, 1.0, pi / 2, pi, 4.0)) * random.uniform(0.9, 1.1))
    center = at + turn * 1j * heading * size
    end = center + (at - center) * swept
    return Arc(_at(at), _at(end), _at(center), Turn(turn)), end, heading * swept


def _side(random: Random) -> Side:
    return random.choice((Side.LEFT, Side.RIGHT))


def _at(place: complex) -> tuple[float, float]:
    return place.real, place.imag


KINDS: Final = (open_lines, open_mixed, tangent, nearly_tangent, tiny, convex, star)


def corner_angle(contour: Path, corner: int) -> float:
    """The angle turned at the end of segment `corner`, from 1, radians, positive to the left."""
    before = complex(*contour.part(corner - 1, corner).end_directions[0])
    behind = complex(*contour.part(corner, corner + 1).start_directions[0])
    return phase(before.conjugate() * behind)
