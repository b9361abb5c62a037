"""Contours of any number of segments for the benchmark, one function for each family."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.geometry.path import Floats, Path
from core.geometry.piece import Side


@dataclass(frozen=True, eq=False)
class Work:
    """A contour with what it is compensated by; `accepted` is a radius at which LinuxCNC takes it too."""

    contour: Path
    side: Side
    radius: float
    closed: bool
    accepted: float
    lookahead: int = 8


def _polyline(places: NDArray[np.complex128]) -> Path:
    points = np.stack((places.real, places.imag), axis=1)
    return Path.of(points, points[:-1], np.zeros(len(points) - 1, np.int8))


def _steps(count: int) -> Floats:
    return np.arange(count + 1.0)


def lines(count: int) -> Work:
    """A zigzag of long lines: corners in and out in turn, nothing deleted."""
    step = _steps(count)
    return Work(_polyline(step + 2j * (step % 2)), Side.LEFT, 0.25, False, 0.25)


def arcs(count: int) -> Work:
    """Half circles to and fro, each tangent to the next."""
    points = np.stack((2.0 * _steps(count), np.zeros(count + 1)), axis=1)
    turns = np.where(np.arange(count) % 2, 1, -1)
    return Work(Path.of(points, points[:-1] + np.array((1.0, 0.0)), turns), Side.LEFT, 0.25, False, 0.25)


def gear(count: int) -> Work:
    """A closed gear of lines and arcs whose tips the cutter cannot enter: deletions at every tooth."""
    teeth = max(count // 4, 2)
    pitch, radius = 2.0 * pi / teeth, 6.0 * teeth / pi / 2.0
    angles = np.arange(teeth) * pitch
    corners = [
        reach * np.exp(1j * (angles + part * pitch))
        for reach, part in ((radius, 0.0), (radius, 0.3), (radius + 2.0, 0.5), (radius + 2.0, 0.8))
    ]
    places = np.stack(corners, axis=1).ravel()
    places = np.append(places, places[0])
    points = np.stack((places.real, places.imag), axis=1)
    turns = np.tile((1, 0, 1, 0), teeth)
    centers = np.where(turns[:, None] == 0, points[:-1], 0.0)
    return Work(Path.of(points, centers, turns), Side.LEFT, 2.0, True, 0.2)


def spline(count: int) -> Work:
    """A wave drawn by many tiny segments."""
    x = 0.05 * _steps(count)
    return Work(_polyline(x + 1j * np.sin(2.0 * pi / 6.0 * x)), Side.LEFT, 0.25, False, 0.25)


def spiral(count: int) -> Work:
    """A spiral of small lines, its turns farther apart than the cutter is wide."""
    angle = 0.35 * np.sqrt(_steps(count) + 100.0)
    return Work(_polyline(0.3 * angle * np.exp(1j * angle)), Side.LEFT, 0.2, False, 0.2)


def teeth(count: int) -> Work:
    """Teeth much finer than the cutter: nearly everything is deleted."""
    step = _steps(count)
    return Work(_polyline(0.1 * step + 0.3j * (step % 2)), Side.LEFT, 0.25, False, 0.01)


def notches(count: int) -> Work:
    """A line with a notch every few millimeters that the cutter cannot enter."""
    block = np.array([0.0, 2.0, 2.0 - 0.3j, 2.3 - 0.3j, 2.3])
    places = (4.0 * np.arange(count // 5 + 1)[:, None] + block).ravel()[: count + 1]
    return Work(_polyline(places.astype(np.complex128)), Side.LEFT, 0.25, False, 0.1)


def stair(count: int) -> Work:
    """Steps smaller than the cutter."""
    step = np.arange(count + 1)
    return Work(_polyline((step + 1) // 2 * 0.2 + 1j * (step // 2) * 0.1), Side.LEFT, 0.25, False, 0.04)


def dense_disc(count: int) -> Work:
    """A wavy disc of 116 mm drawn by ever shorter chords, 4 micrometers at 100,000, for a cutter of 6 mm."""
    angle = 2.0 * pi * _steps(count) / count
    angle[-1] = 0.0
    return Work(_polyline((58.0 + 2.0 * np.cos(12.0 * angle)) * np.exp(1j * angle)), Side.RIGHT, 3.0, True, 1.0)


def dense_waves(count: int) -> Work:
    """Forty waves of 10 mm, the cutter too wide for their bottoms, drawn by ever shorter chords."""
    x = 400.0 * _steps(count) / count
    return Work(_polyline(x + 4j * np.sin(2.0 * pi / 10.0 * x)), Side.LEFT, 2.0, False, 0.3)


def dense_ripples(count: int) -> Work:
    """A disc with 300 ripples of 0.05 mm drawn by ever shorter chords, that a cutter of 6 mm gouges at look-ahead 3."""
    angle = 2.0 * pi * _steps(count) / count
    angle[-1] = 0.0
    return Work(_polyline((58.0 + 0.05 * np.sin(300.0 * angle)) * np.exp(1j * angle)), Side.RIGHT, 3.0, True, 0.1, 3)


def dense_spiral(count: int) -> Work:
    """Thirty turns 2 mm apart for a cutter of 1.2 mm, drawn by ever shorter chords."""
    angle = 2.0 * pi * np.sqrt(900.0 * _steps(count) / count + 4.0)
    return Work(_polyline(2.0 * angle / (2.0 * pi) * np.exp(1j * angle)), Side.LEFT, 0.6, False, 0.6)


def tangent_slots(count: int) -> Work:
    """Slots exactly as wide as the cutter, one beside the other: the offsets of their walls lie on one another."""
    slot = np.array([0.0, 1.0, 1.0 - 8j, 2.0 - 8j])
    places = (2.0 * np.arange(count // 4 + 2)[:, None] + slot).ravel()[: count + 1]
    return Work(_polyline(places.astype(np.complex128)), Side.LEFT, 0.5, False, 0.05)


def tangent_stack(count: int) -> Work:
    """Half circles whose offsets all touch one another in one line: a meander with walls two radii apart."""
    row = np.arange(count + 1)
    points = np.stack((40.0 * ((row + 1) // 2 % 2), 2.0 * (row // 2)), axis=1)
    turns = np.where(row[:-1] % 2 == 0, 0, np.where(row[:-1] % 4 == 1, 1, -1))
    centers = np.where(turns[:, None] == 0, points[:-1], points[:-1] + np.array((0.0, 1.0)))
    return Work(Path.of(points, centers, turns), Side.LEFT, 1.0, False, 0.5)


FAMILIES: Final[tuple[Callable[[int], Work], ...]] = (
    lines,
    arcs,
    gear,
    spline,
    spiral,
    teeth,
    notches,
    stair,
    dense_disc,
    dense_waves,
    dense_ripples,
    dense_spiral,
    tangent_slots,
    tangent_stack,
)
