"""Contours and leads: which moves of a compensated stretch are contours, and which only lead to them."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, dist, pi, radians
from typing import Final

import numpy as np

from core.geometry.path import Flags, Floats, Path
from core.tolerance import CLOSED

MAX_LEAD_MOVES: Final = 2
"""Most moves that may lead in, out, or from one contour to the next: a line and an arc.  More are surface."""

MAX_CONTOURS: Final = 32
"""With more contours than this all moves count as surface: each contour is judged with the whole path."""

BLEND: Final = radians(1.0)
"""How far the directions of a lead and of the contour may be apart where they run on tangent."""

LONG: Final = 0.5
"""Share of the longest contour from which on moves that lead to one or away from it may be walls."""

OVERLAP: Final = 1e-3
"""Radians between the directions of a wall and of a move that runs along it again, with rounded ends."""

RowRange = tuple[int, int]
"""First row and one after the last."""


def contours_of(path: Path) -> tuple[RowRange, ...]:
    """The contours as ranges of their pieces' rows, ascending; rows in none of them are leads.

    A closed run of pieces is a contour, the longest one before all others.  What is before, between and after closed
    ones is a contour too where it has more than MAX_LEAD_MOVES pieces, an open one: nothing says that it is no surface.
    Pieces behind the longest one that run along its beginning again count as neither.
    """
    whole = (0, len(path))
    if not len(path):
        return (whole,)
    places = _places(path)
    sums = _sums(path)
    longest = _longest(sums, places)
    if longest is None:
        return (whole,)
    longest = _between_leads(path, sums, places, longest)
    behind = _behind_overlap(path, longest)
    contours = (*_within(sums, places, (0, longest[0])), longest, *_within(sums, places, (behind, len(path))))
    return contours if len(contours) <= MAX_CONTOURS else (whole,)


def open_contours(path: Path, contours: tuple[RowRange, ...]) -> dict[RowRange, frozenset[float]]:
    """The open contours of a path among closed ones, with their lines: they may only lead to the closed ones."""
    if len(contours) == 1:
        return {}
    places = _places(path)
    open_rows = [rows for rows in contours if places[rows[0]] != places[rows[1]]]
    return {(first, last): frozenset(path.numbers[first:last].tolist()) for first, last in open_rows}


@dataclass(frozen=True, eq=False, slots=True)
class SplitContours:
    """A path with lines split where contours close within them, its contours, and the open ones among closed ones.

    `open_lines` has all lines of each of these.
    """

    path: Path
    contours: tuple[RowRange, ...]
    open_lines: dict[RowRange, frozenset[float]]

    @staticmethod
    def of(path: Path) -> SplitContours:
        """The contours of a path as it is."""
        contours = contours_of(path)
        return SplitContours(path, contours, open_contours(path, contours))


def split_where_it_closes(path: Path) -> SplitContours:
    """The path with lines split in two that run on over the point at which the contour begins.

    It begins behind at most MAX_LEAD_MOVES moves, or ends before so many.  Contours are cut a little further than to
    where they close, once more as a whole, or from a start beyond their corner.
    """
    split = _split_at_start(path)
    if split is None and contours_of(path) == ((0, len(path)),):
        back = _split_at_start(path.reversed())
        split = None if back is None else (back[0].reversed(), back[1].reversed())
    if split is None:
        return SplitContours.of(_split_at_corner(path) or path)
    straight, closing = split
    return replace(SplitContours.of(closing), path=straight)


def _split_at_start(path: Path) -> tuple[Path, Path] | None:
    """The path with lines split in two that run on over the point behind its first moves, of most moves first.

    Once split on the line, and once at the point itself, which may be off the line by rounding.
    """
    directions = path.start_directions
    for lead in range(min(MAX_LEAD_MOVES, len(path) - 2), -1, -1):
        point = path.points[lead]
        over = _runs_over(path, point, directions[lead])
        rows = [row for row in over.nonzero()[0].tolist() if row >= lead + 2]
        if rows:
            along, starts = directions[rows], path.starts[rows]
            feet = starts + ((point - starts) * along).sum(axis=1)[:, None] * along
            return _split(path, rows, feet), _split(path, rows, np.repeat(point[None], len(rows), axis=0))
    return None


def _split_at_corner(path: Path) -> Path | None:
    """The path with its last line split where its first one ends, of leads there and back beyond a corner.

    Or with its first line split where its last one begins.
    """
    if len(path) < 4 or np.abs(path.points[0] - path.points[-1]).max() > CLOSED:
        return None
    for way, turned in ((path, False), (path.reversed(), True)):
        row = len(way) - 1
        if not way.turns[0] and _runs_over(way, way.points[1], way.end_directions[row])[row]:
            split = _split(way, [row], way.points[1:2])
            return split.reversed() if turned else split
    return None


def _runs_over(path: Path, point: Floats, way: Floats) -> Flags:
    """(n,) whether a piece is a line that runs over a point, in a direction, with both ends away from it."""
    steps, along = point - path.starts, path.start_directions
    reach, off = (steps * along).sum(axis=1), np.abs(steps[:, 0] * along[:, 1] - steps[:, 1] * along[:, 0])
    inside = (reach > CLOSED) & (reach < path.lengths - CLOSED)
    over: Flags = (path.turns == 0) & inside & (off <= CLOSED) & (along @ way > cos(BLEND))
    return over


def _split(path: Path, rows: list[int], at: Floats) -> Path:
    """The path with lines in two pieces of their number each, parted at points (m, 2)."""
    behind = [row + 1 for row in rows]
    points, centers = np.insert(path.points, behind, at, axis=0), np.insert(path.centers, behind, at, axis=0)
    turns, numbers = np.insert(path.turns, behind, 0), np.insert(path.numbers, behind, path.numbers[rows])
    return Path.of(points, centers, turns, numbers)


def has_long_leads(path: Path, contours: tuple[RowRange, ...]) -> bool:
    """Whether the moves before the first contour, behind the last one or between two are long beside the longest."""
    length = np.concatenate((np.zeros(1), np.cumsum(path.lengths)))
    ends = length[[0, *(row for both in contours for row in both), len(path)]]
    ways, around = ends[1::2] - ends[::2], ends[2::2] - ends[1:-1:2]
    return bool(ways.max() > LONG * around.max())


def leads_at_corner(path: Path, contours: tuple[RowRange, ...]) -> bool:
    """Whether a line there and back at a corner of a contour is taken for its leads: it may be a wall run twice."""
    for first, last in contours:
        lines = first > 0 and last < len(path) and not path.turns[first - 1] and not path.turns[last]
        back = lines and np.abs(path.points[first - 1] - path.points[last + 1]).max() <= CLOSED
        if back and float(path.end_directions[last - 1] @ path.start_directions[first]) < cos(OVERLAP):
            return True
    return False


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


def _places(path: Path) -> list[int]:
    """The place of each of the path's points: the index of an earlier one within CLOSED of it, or its own."""
    places = list[int]()
    firsts = defaultdict[tuple[int, int], list[int]](list)
    points, cells = path.points.tolist(), np.floor(path.points / CLOSED).astype(np.int64).tolist()
    for index, (point, (column, row)) in enumerate(zip(points, cells, strict=True)):
        around = ((column + across, row + up) for across in (0, -1, 1) for up in (0, -1, 1))
        near = (first for cell in around for first in firsts.get(cell, ()) if dist(points[first], point) <= CLOSED)
        place = next(near, index)
        places.append(place)
        if place == index:
            firsts[column, row].append(index)
    return places


def _longest(sums: Floats, places: list[int]) -> RowRange | None:
    """The run of most pieces that ends where it begins and encloses something."""
    first_seen: dict[int, int] = {}
    best = (0, 0)
    for index, place in enumerate(places):
        begin = first_seen.setdefault(place, index)
        if index - begin > best[1] - best[0] and _encloses(sums, (begin, index)):
            best = (begin, index)
    return best if best[1] else None


def _between_leads(path: Path, sums: Floats, places: list[int], rows: RowRange) -> RowRange:
    """The closed run inside a closed one that starts and ends with a lead.

    That is a line there and back in the middle of a wall or off a corner, or an arc of a quarter turn at most, in line
    with the wall: around a square corner both arcs of a blend may begin and end at one point.  In a bore they may be
    half a turn.
    """
    begin, end = rows[0] + 1, rows[1] - 1
    if begin >= end or places[begin] != places[end] or not _encloses(sums, (begin, end)):
        return rows
    if not path.turns[begin - 1] and not path.turns[end]:
        return (begin, end) if _leads_off(path, begin, end) else rows
    largest = pi if _inside_of_circle(path, (begin - 1, end), (begin, end)) else pi / 2
    arcs = all(path.turns[row] and abs(path.sweeps[row]) <= largest + BLEND for row in (begin - 1, end))
    tangent = _blends(path, range(begin, begin - 2, -1)) and _blends(path, range(end - 1, end + 1))
    return (begin, end) if arcs and tangent else rows


def _leads_off(path: Path, begin: int, end: int) -> bool:
    """Whether the line behind row `end` leads off the closed run that begins and ends there.

    It does from the middle of a wall, and at a corner square to both walls at least or straight on from one of them:
    any other may be a wall that is run twice by mistake.
    """
    before, after = -path.end_directions[end - 1], path.start_directions[begin]
    off = path.start_directions[end]
    smooth = float(before @ after) < -cos(OVERLAP)
    straight_on = min(float(off @ before), float(off @ after)) < -cos(OVERLAP)
    return smooth or straight_on or max(float(off @ before), float(off @ after)) <= OVERLAP


def _inside_of_circle(path: Path, arcs: tuple[int, int], rows: RowRange) -> bool:
    """Whether rows are one circle, and arcs that touch it lie inside of it."""
    turns, centers, radii = (values[slice(*rows)] for values in (path.turns, path.centers, path.radii))
    circle = bool(turns[0] and (turns == turns[0]).all() and np.abs(centers - centers[0]).max() <= CLOSED)
    return circle and all(path.turns[arc] == turns[0] and path.radii[arc] < radii[0] for arc in arcs)


def _within(sums: Floats, places: list[int], rows: RowRange) -> list[RowRange]:
    """The contours among rows outside the longest one: closed runs in their order, and what is long between them."""
    begin, end = rows
    last_seen = {places[index]: index for index in range(begin, end + 1)}
    contours: list[RowRange] = []
    at = open_from = begin
    while at < end:
        close = last_seen[places[at]]
        if close > at and _encloses(sums, (at, close)):
            contours += [*_open((open_from, at)), (at, close)]
            at = open_from = close
        else:
            at += 1
    return [*contours, *_open((open_from, end))]


def _sums(path: Path) -> Floats:
    """(4, n + 1) twice the area and the length up to each of the path's points, and the point from the first one."""
    corners = (path.points - path.points[:1]).T
    areas = corners[0, :-1] * corners[1, 1:] - corners[1, :-1] * corners[0, 1:]
    areas += np.where(path.turns != 0, path.radii**2 * (path.sweeps - np.sin(path.sweeps)), 0.0)
    sums = np.concatenate((np.zeros((2, 1)), np.cumsum((areas, path.lengths), axis=1)), axis=1)
    return np.concatenate((sums, corners))


def _encloses(sums: Floats, rows: RowRange) -> bool:
    """Whether a closed run is more than a way there and back; the gap of rounding at its end is closed by a line."""
    (begun, before, x0, y0), (ended, behind, x1, y1) = sums[:, rows].T.tolist()
    area = ended - begun + x1 * y0 - y1 * x0
    return bool(abs(area) > CLOSED * (behind - before))


def _behind_overlap(path: Path, rows: RowRange) -> int:
    """The first row behind a closed run that does not run along its beginning again."""
    first, last = rows
    behind = last
    while behind < len(path) and behind - last < last - first and _runs_along(path, behind, first + behind - last):
        behind += 1
    return behind


def _runs_along(path: Path, row: int, other: int) -> bool:
    """Whether a piece runs along another one from its start, no longer than that."""
    apart = [path.points[row] - path.points[other]]
    if path.turns[row]:
        apart.append(path.centers[row] - path.centers[other])
    same = bool(path.turns[row] == path.turns[other] and np.abs(apart).max() <= CLOSED)
    along = float(path.start_directions[row] @ path.start_directions[other]) > cos(OVERLAP)
    return same and along and float(path.lengths[row]) <= float(path.lengths[other]) + CLOSED


def _open(rows: RowRange) -> list[RowRange]:
    return [rows] if rows[1] - rows[0] > MAX_LEAD_MOVES else []
