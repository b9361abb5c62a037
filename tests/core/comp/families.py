"""Contours by family as parts have them, each with what makes its offset hard; random sizes, inch or mm, anywhere."""

from __future__ import annotations

from cmath import rect
from collections.abc import Sequence
from itertools import pairwise
from math import pi, tan, tau

import numpy as np
from hypothesis import strategies as st

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Turn

IN = 25.4


def _point(place: complex) -> Point:
    return place.real, place.imag


def joined(places: Sequence[complex], bulges: Sequence[float] | None = None) -> Path:
    """The contour through these places: lines, and arcs where a bulge (tan of a quarter of the sweep) is not 0."""
    pieces: list[Piece] = []
    for row, (start, end) in enumerate(pairwise(places)):
        bulge = bulges[row] if bulges else 0.0
        if not bulge:
            pieces.append(Line(_point(start), _point(end)))
            continue
        center = (start + end) / 2.0 + 0.5j * (end - start) * (1.0 - bulge**2) / (2.0 * bulge)
        pieces.append(Arc(_point(start), _point(end), _point(center), Turn.CCW if bulge > 0.0 else Turn.CW))
    return Path.from_pieces(pieces)


def backwards(path: Path) -> Path:
    """The same pieces from the other end, renumbered."""
    return Path.from_pieces(list(path.reversed()))


def mid_side(corners: Sequence[complex]) -> list[complex]:
    """Around these corners and back, from the middle of the first side."""
    middle = (corners[0] + corners[1]) / 2.0
    return [middle, *corners[1:], corners[0], middle]


@st.composite
def gears(draw: st.DrawFn) -> Path:
    """Closed, counter-clockwise: tips and roots on two circles, straight flanks, from the middle of a tip."""
    teeth, root, height = draw(st.integers(7, 14)), draw(st.floats(2.0, 4.0)), draw(st.floats(0.2, 1.0))
    tip, gap = draw(st.floats(0.15, 0.45)), draw(st.floats(0.15, 0.45))
    places, bulges, pitch = [rect(root + height, tip * pi / teeth)], [0.0], tau / teeth
    bulges = []
    for tooth in range(teeth):
        begin = tooth * pitch + tip * pitch / 2.0
        free = (1.0 - tip - gap) * pitch / 2.0
        for angle, reach, swept in (
            (begin + free, root, 0.0),
            (begin + free + gap * pitch, root, gap * pitch),
            (begin + 2.0 * free + gap * pitch, root + height, 0.0),
            (begin + pitch, root + height, tip * pitch),
        ):
            places.append(rect(reach, angle))
            bulges.append(tan(swept / 4.0))
    half = tan(tip * pitch / 8.0)
    return joined([rect(root + height, 0.0), *places[:-1], rect(root + height, 0.0)], [half, *bulges[:-1], half])


@st.composite
def convex(draw: st.DrawFn) -> Path:
    """Closed, counter-clockwise: corners on an oval, from mid-side."""
    count, wide = draw(st.integers(3, 12)), draw(st.floats(1.0, 3.0))
    lean = draw(st.lists(st.floats(-0.3, 0.3), min_size=count, max_size=count))
    round_ = [rect(2.0, (row + part) * tau / count) for row, part in enumerate(lean)]
    return joined(mid_side([complex(wide * place.real, place.imag) for place in round_]))


@st.composite
def rounded(draw: st.DrawFn) -> Path:
    """Closed, counter-clockwise, tangent throughout: a rectangle with rounded corners, from mid-side."""
    wide, high, round_ = draw(st.floats(2.5, 6.0)), draw(st.floats(2.5, 6.0)), draw(st.floats(0.1, 1.2))
    places, bulges = [complex(0.0, -high / 2.0)], []
    for x, y, turn in ((1, -1, 1), (1, 1, 1j), (-1, 1, -1), (-1, -1, -1j)):
        corner = complex(x * wide, y * high) / 2.0
        places += [corner - round_ * turn, corner + round_ * 1j * turn]
        bulges += [0.0, tan(pi / 8.0)]
    return joined([*places, places[0]], [*bulges, 0.0])


@st.composite
def waves(draw: st.DrawFn) -> Path:
    """Closed, counter-clockwise: a curve of many tiny lines with bays."""
    count, bays, depth = draw(st.integers(40, 90)), draw(st.integers(2, 6)), draw(st.floats(0.02, 0.3))
    angle = np.arange(count) * tau / count
    return joined(mid_side((3.0 * (1.0 + depth * np.cos(bays * angle)) * np.exp(1j * angle)).tolist()))


@st.composite
def notched(draw: st.DrawFn) -> Path:
    """Closed, counter-clockwise: a square whose sides have notches and tiny steps, from mid-side."""
    places: list[complex] = []
    for turn in (1, 1j, -1, -1j):
        at, depth, wide = draw(st.floats(-1.2, 1.0)), draw(st.floats(0.02, 0.8)), draw(st.floats(0.02, 0.7))
        step = draw(st.just(0.0) | st.floats(1e-4, 0.05))
        side = [complex(-2.0, -2.0), complex(at, -2.0), complex(at, -2.0 + depth), complex(at + wide, -2.0 + depth)]
        side += [complex(at + wide, -2.0 + step)]
        side += [complex(1.9, -2.0 + step), complex(1.9, -2.0)] if step else []
        places += [turn * place for place in side]
    return joined(mid_side(places))


@st.composite
def spirals(draw: st.DrawFn) -> Path:
    """Open: tiny lines or arcs inwards or outwards, turns from wide apart to closer than the cutter."""
    count, pitch, turns = draw(st.integers(10, 60)), draw(st.floats(0.2, 2.0)), draw(st.floats(0.7, 3.0))
    angle = np.linspace(0.8, 0.8 + turns * tau, count)
    places = (pitch * angle / tau * np.exp(1j * angle)).tolist()
    bulge = draw(st.booleans()) * tan((angle[1] - angle[0]) / 4.0)
    path = joined(places, [bulge] * (count - 1))
    return backwards(path) if draw(st.booleans()) else path


@st.composite
def splines(draw: st.DrawFn) -> Path:
    """Open: a wave of tiny lines, curves wider and tighter than the cutter, joints near tangent."""
    count, length, height = draw(st.integers(10, 80)), draw(st.floats(1.0, 8.0)), draw(st.floats(0.0, 2.0))
    x = np.linspace(0.0, 10.0, count)
    return joined((x + 1j * height * np.sin(tau / length * x)).tolist())


@st.composite
def stairs(draw: st.DrawFn) -> Path:
    """Open: steps from far smaller than the cutter to wider than it, up or down."""
    run, rise, count = draw(st.floats(0.02, 1.0)), draw(st.floats(-0.5, 0.5)), draw(st.integers(2, 30))
    steps = np.arange(count)
    return joined(((steps + 1) // 2 * run + 1j * (steps // 2) * (rise or 0.1)).tolist())


@st.composite
def doubled(draw: st.DrawFn) -> Path:
    """Open, overlapping and near-tangent: a wall, a hair's turn, along it back and forth, and a full circle on it."""
    hair = draw(st.sampled_from([0.0, 1e-8, 1e-6, 1e-4, 1e-2]))
    back, on = draw(st.floats(0.2, 2.0)), draw(st.floats(0.3, 3.0))
    tip = 3.0 + 0j
    turned = tip - rect(back, hair)
    end = turned + rect(on, -hair)
    pieces: list[Piece] = [Line((0.0, 0.0), _point(tip)), Line(_point(tip), _point(turned))]
    if draw(st.booleans()):
        center = turned + 1j * draw(st.sampled_from([-1.0, 1.0])) * draw(st.floats(0.2, 1.5))
        pieces.append(Arc(_point(turned), _point(turned), _point(center), draw(st.sampled_from([Turn.CW, Turn.CCW]))))
    return Path.from_pieces([*pieces, Line(_point(turned), _point(end)), Line(_point(end), _point(end + 1j))])


rings = gears() | convex() | rounded() | waves() | notched()
"""Closed, counter-clockwise, started mid-side."""

strips = spirals() | splines() | stairs() | doubled()
"""Open."""


def placed(path: Path, unit: float, by: complex) -> Path:
    """The contour in a unit (millimeters to it), moved."""
    move = np.array((by.real, by.imag))
    return Path.of(path.points * unit + move, path.centers * unit + move, path.turns, path.numbers)


units = st.sampled_from([1.0, IN])
shifts = st.sampled_from([0j, complex(37.5, -12.25), complex(-2000.0, 1500.0)])
