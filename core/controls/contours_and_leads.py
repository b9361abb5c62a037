"""Contours and leads: which moves of a compensated stretch are contours, and which only lead to them."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, radians
from typing import Final

import numpy as np

from core.geometry.path import Floats, Path
from core.tolerance import CLOSED

MAX_LEAD_MOVES: Final = 2
"""Most moves that may lead in, out, or from one contour to the next: a line and an arc.  More are surface."""

MAX_CONTOURS: Final = 32
"""With more contours than this all moves count as surface: each contour is judged with the whole path."""

BLEND: Final = radians(1.0)
"""How far the directions of a lead and of the contour may be apart where they run on tangent."""

RowRange = tuple[int, int]
"""First row and one after the last."""


def contours_of(path: Path) -> tuple[RowRange, ...]:
    """The contours as rows of their pieces, rising; pieces in none of them are leads.

    A closed run of pieces is a contour, the longest one before all others.  What is before, between and after closed
    ones is a contour too where it has more than MAX_LEAD_MOVES pieces, an open one: nothing says that it is no surface.
    """
    whole = (0, len(path))
    places = _places(path)
    longest = _longest(places)
    if longest is None:
        return (whole,)
    first, last = longest = _between_blends(path, places, longest)
    contours = (*_within(path, places, (0, first)), longest, *_within(path, places, (last, len(path))))
    return contours if len(contours) <= MAX_CONTOURS else (whole,)


def open_contours(path: Path, contours: tuple[RowRange, ...]) -> dict[RowRange, frozenset[float]]:
    """The open contours of a path among closed ones, with their lines: they may only lead to the closed ones."""
    if len(contours) == 1:
        return {}
    places = _places(path)
    open_rows = [rows for rows in contours if places[rows[0]] != places[rows[1]]]
    return {(first, last): frozenset(path.numbers[first:last].tolist()) for first, last in open_rows}


def split_where_it_closes(path: Path) -> Path:
    """The path with the line split in two that runs on over the point at which a blend led in.

    A control that allows no two moves on one line has such contours: they close within their last line.
    """
    if contours_of(path) != ((0, len(path)),):
        return path
    for lead in range(min(MAX_LEAD_MOVES, len(path) - 2)):
        if not _blends(path, range(lead + 1, lead - 1, -1)):
            continue
        point, way = path.ends[lead], path.start_directions[lead + 1]
        for row in range(lead + 2, len(path)):
            if not path.turns[row] and _runs_over(path, row, point, way):
                return _split(path, row, point)
    return path


def _runs_over(path: Path, row: int, point: Floats, way: Floats) -> bool:
    """Whether a line runs over a point, in a direction, with both ends away from it."""
    step, along = point - path.starts[row], path.start_directions[row]
    reach, off = float(step @ along), float(abs(step[0] * along[1] - step[1] * along[0]))
    inside = CLOSED < reach < float(path.lengths[row]) - CLOSED
    return inside and off <= CLOSED and float(along @ way) > cos(BLEND)


def _split(path: Path, row: int, point: Floats) -> Path:
    """The path with a line in two pieces of its number."""
    points = np.insert(path.points, row + 1, point, axis=0)
    centers = np.insert(path.centers, row + 1, point, axis=0)
    turns, numbers = np.insert(path.turns, row + 1, 0), np.insert(path.numbers, row + 1, path.numbers[row])
    return Path.of(points, centers, turns, numbers)


def blend_leads(path: Path, contours: tuple[RowRange, ...]) -> frozenset[int]:
    """The rows of leads that blend into a contour or out of it: in line with it up to an arc, and what is beyond it.

    Nothing programs a surface so: they are leads, not only taken for them.
    """
    rows = set[int]()
    ends = [0, *(row for both in contours for row in both), len(path)]
    for first, last in zip(ends[::2], ends[1::2], strict=True):  # the ways from one contour to the next
        outward, inward = range(first - 1, last), range(last, first - 1, -1)
        if (first > 0 and _blends(path, outward)) or (last < len(path) and _blends(path, inward)):
            rows.update(range(first, last))
    return frozenset(rows)


def _blends(path: Path, rows: range) -> bool:
    """Whether from the contour's row, the first, the next ones run on tangent up to an arc."""
    for near, far in pairwise(rows):
        before, after = min(near, far), max(near, far)
        if float(path.end_directions[before] @ path.start_directions[after]) < cos(BLEND):
            return False
        if path.turns[far]:
            return True
    return False


def contour_of(path: Path) -> RowRange:
    """The rows of the one contour without its leads; all rows where there are several, or none that is closed."""
    contours = contours_of(path)
    return contours[0] if len(contours) == 1 else (0, len(path))


def _places(path: Path) -> list[tuple[float, float]]:
    return [(x, y) for x, y in np.round(path.points / CLOSED).tolist()]


def _longest(places: list[tuple[float, float]]) -> RowRange | None:
    """The longest run of pieces that ends where it begins."""
    first_seen: dict[tuple[float, float], int] = {}
    best = (0, 0)
    for index, place in enumerate(places):
        begin = first_seen.setdefault(place, index)
        if index - begin > best[1] - best[0]:
            best = (begin, index)
    return best if best[1] else None


def _between_blends(path: Path, places: list[tuple[float, float]], rows: RowRange) -> RowRange:
    """The closed run inside a closed one that starts and ends with one arc of a quarter turn at most, in line with it:
    around a square corner both arcs of a blend may begin and end at one point.  In a bore they may be half a turn."""
    begin, end = rows[0] + 1, rows[1] - 1
    if begin >= end or places[begin] != places[end] or not _encloses(path, (begin, end)):
        return rows
    largest = pi if _inside_of_circle(path, (begin - 1, end), (begin, end)) else pi / 2
    arcs = all(path.turns[row] and abs(path.sweeps[row]) <= largest + BLEND for row in (begin - 1, end))
    tangent = _blends(path, range(begin, begin - 2, -1)) and _blends(path, range(end - 1, end + 1))
    return (begin, end) if arcs and tangent else rows


def _inside_of_circle(path: Path, arcs: tuple[int, int], rows: RowRange) -> bool:
    """Whether rows are one circle, and arcs that touch it lie inside of it."""
    turns, centers, radii = (values[slice(*rows)] for values in (path.turns, path.centers, path.radii))
    circle = bool(turns[0] and (turns == turns[0]).all() and np.abs(centers - centers[0]).max() <= CLOSED)
    return circle and all(path.turns[arc] == turns[0] and path.radii[arc] < radii[0] for arc in arcs)


def _within(path: Path, places: list[tuple[float, float]], rows: RowRange) -> list[RowRange]:
    """The contours among rows outside the longest one: closed runs in their order, and what is long between them."""
    begin, end = rows
    last_seen = {places[index]: index for index in range(begin, end + 1)}
    contours: list[RowRange] = []
    at = open_from = begin
    while at < end:
        close = last_seen[places[at]]
        if close > at and _encloses(path, (at, close)):
            contours += [*_open((open_from, at)), (at, close)]
            at = open_from = close
        else:
            at += 1
    return [*contours, *_open((open_from, end))]


def _encloses(path: Path, rows: RowRange) -> bool:
    """Whether a closed run is more than a line there and back."""
    first, last = rows
    return last - first > 2 or bool(path.turns[first:last].any())


def _open(rows: RowRange) -> list[RowRange]:
    return [rows] if rows[1] - rows[0] > MAX_LEAD_MOVES else []
