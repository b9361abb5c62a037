"""This module tells which moves of a compensated stretch are contours, and which only lead to them."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise
from math import cos, dist, pi, radians
from typing import Final, NamedTuple

import numpy as np

from core.controls.control_run import Stretch
from core.controls.judging.repeated_passes import path_key
from core.geometry.distance import distance, foot
from core.geometry.path import Floats, Path, Rows, coordinates, joined
from core.geometry.piece_arrays import at, direction, piece_arrays
from core.tolerance import CLOSED

MAX_LEAD_MOVES: Final = 2
"""Most moves that may lead in, out, or from one contour to the next: a line and an arc.  More are surface."""

MAX_CONTOURS: Final = 32
"""Most contours of different shapes in a path; beyond this all moves count as surface, to limit the work."""

MAX_TANGENT_ANGLE: Final = radians(1.0)
"""Largest angle between the directions of a lead and of the contour at which they still run on tangent."""

MAX_LEAD_SHARE: Final = 0.5
"""Share of the longest contour beyond which moves that lead to or from a contour may be walls."""

MAX_RETRACE_ANGLE: Final = 1e-3
"""Largest angle in radians between a wall and a move that runs along it again, with rounded ends."""

RowRange = tuple[int, int]
"""First row and one after the last."""


def contours_of(path: Path) -> tuple[RowRange, ...]:
    """Return the contours as ranges of their pieces' rows, ascending; rows outside them are leads.

    A closed run of pieces is a contour; the longest one is taken first.  Pieces before, between and after closed runs
    are an open contour if there are more than MAX_LEAD_MOVES of them, because nothing says that they are not surface.
    Between two closed runs, an arc out of one and an arc into the other are not counted.  Pieces after the longest run
    that repeat its beginning belong to no contour.
    """
    all_rows = (0, len(path))
    if not len(path):
        return (all_rows,)
    if passes := _linked_passes(path, all_rows):
        return passes
    point_ids = _point_ids(path)
    sums = _sums(path)
    longest = _longest(sums, point_ids)
    if longest is None:
        return (all_rows,)
    passes = _linked_passes(path, longest) or (_between_leads(path, sums, point_ids, longest),)
    first, after = passes[0][0], end_of_overlap(path, (passes[0][0], passes[-1][1]))
    contours = (*_within(sums, point_ids, (0, first)), *passes, *_within(sums, point_ids, (after, len(path))))
    contours = tuple(rows for rows in contours if is_closed(path, rows) or not _joins_by_arcs(path, rows))
    return contours if len({path_key(path.part(*rows)) for rows in contours}) <= MAX_CONTOURS else (all_rows,)


def _linked_passes(whole: Path, rows: RowRange) -> tuple[RowRange, ...]:
    """Return the closed passes in rows that have nothing else but short links to, between and from them.

    A pass ends where its first point comes again.  A link begins where the path no longer runs along the pass.  It
    joins by arcs, or has at most MAX_LEAD_MOVES moves, where lines that continue each other are one, and at most
    MAX_LEAD_SHARE of the shortest pass's length.
    """
    path = whole.part(*rows)
    sums, passes, around, last_seen = _sums(path), list[RowRange](), (0, 0), dict[int, int]()
    for index, point_id in enumerate(_point_ids(path)):
        begin = last_seen.get(point_id, index)
        last_seen[point_id] = index
        if not _encloses(sums, (begin, index)):
            continue
        last_seen = {point_id: index}
        if around[1] == begin and _links_passes(path, around, (begin, index)):
            continue
        around = (begin, index)
        if passes and passes[-1][1] == begin:
            passes[-1] = (passes[-1][0], index)
        else:
            passes.append(around)
    starts = [*(begin for begin, _ in passes), len(path)]
    after = [0, *(min(end_of_overlap(path, each), start) for each, start in zip(passes, starts[1:], strict=True))]
    limit = MAX_LEAD_SHARE * min((sums[1, end] - sums[1, begin] for begin, end in passes), default=0.0)
    if len(passes) < 2 or not all(_is_link(path, each, limit) for each in zip(after, starts, strict=True)):
        return ()
    if len({path_key(path.part(*each)) for each in passes}) > MAX_CONTOURS:
        return ()
    return tuple((rows[0] + begin, rows[0] + end) for begin, end in passes)


def _is_link(path: Path, rows: RowRange, limit: float) -> bool:
    """True if these rows are at most MAX_LEAD_MOVES moves no longer than a limit, or join two contours by arcs."""
    part = path.part(*rows)
    lines = part.turns == 0
    straight = (part.end_directions[:-1] * part.start_directions[1:]).sum(axis=1) > cos(MAX_RETRACE_ANGLE)
    moves = len(part) - int((straight & lines[:-1] & lines[1:]).sum())
    return (moves <= MAX_LEAD_MOVES and part.lengths.sum() <= limit) or _joins_by_arcs(path, rows)


def _joins_by_arcs(path: Path, rows: RowRange) -> bool:
    """True if an arc leads out of the contour before these rows, and another one into the contour after them.

    Between both arcs are at most MAX_LEAD_MOVES moves.
    """
    first, last = rows
    if first == 0 or last == len(path) or last - first > MAX_LEAD_MOVES + 2:
        return False
    return _blends(path, range(first - 1, first + 1)) and _blends(path, range(last, last - 2, -1))


def _links_passes(path: Path, around: RowRange, rows: RowRange) -> bool:
    """True if arcs of at most half a turn lead out of a pass and back to its start, on a link shorter than the pass.

    Before the arc out, a few of the rows may run along the pass again.
    """
    last = rows[1]
    first = rows[0] + _running_along(path, rows[0], around[0], min(last - rows[0], MAX_LEAD_MOVES))
    if first == last or not _joins_by_arcs(path, (first, last)):
        return False
    if np.abs(path.sweeps[[first, last - 1]]).max() > pi + MAX_TANGENT_ANGLE:
        return False
    return bool(path.lengths[first:last].sum() < path.lengths[slice(*around)].sum())


def closed_passes(path: Path, contour: RowRange) -> tuple[RowRange, ...]:
    """Return the closed runs of a contour that passes its first point again, else the contour.

    Leads at the beginning and the end of a run are left out.
    """
    first, last = contour
    point_ids, sums = _point_ids(path), _sums(path)
    passes = [row for row in range(first, last + 1) if point_ids[row] == point_ids[first]]
    runs = [run for run in pairwise(passes) if _encloses(sums, run)]
    if len(runs) < 2 or passes[-1] != last:
        return (contour,)
    return tuple(_between_leads(path, sums, point_ids, run) for run in runs)


def between_lead_arcs(path: Path, contour: RowRange, stretch: Stretch, *, cut_short: bool) -> RowRange:
    """Return the rows of an open contour without an arc that leads in or out; those of a closed one stay.

    Such an arc is next to the move that turns compensation on or off.  It is at most a quarter turn, wider than the
    cutter, runs on tangent from the wall, and has its center on the cutter's side.  `cut_short`: the control stops
    before the contour's end, so that no arc leads out.
    """
    first, last = contour
    if is_closed(path, contour):
        return contour

    def leads(arc: int, wall: int) -> bool:
        before, after = min(arc, wall), max(arc, wall)
        tangent = float(path.end_directions[before] @ path.start_directions[after]) >= cos(MAX_TANGENT_ANGLE)
        wide = path.turns[arc] == stretch.side.sign and path.radii[arc] > stretch.radius
        return bool(wide and abs(path.sweeps[arc]) <= pi / 2 + MAX_TANGENT_ANGLE and tangent)

    if stretch.entry and first == 0 and last > 1 and leads(0, 1):
        first = 1
    if not cut_short and last == len(path) and last - first > 1 and leads(last - 1, last - 2):
        last -= 1
    return first, last


def is_closed(path: Path, rows: RowRange) -> bool:
    """True if there are pieces in these rows, and they end where they begin."""
    return rows[0] < rows[1] and bool(np.abs(path.points[rows[0]] - path.points[rows[1]]).max() <= CLOSED)


class SplitContours(NamedTuple):
    """A path with its pieces split where contours close within them, and its contours."""

    path: Path
    contours: tuple[RowRange, ...]


def split_where_it_closes(path: Path) -> SplitContours:
    """Split in two the lines and arcs that run past the point at which the contour begins.

    The contour begins after at most MAX_LEAD_MOVES moves, or ends before as many.  Programs cut it a little past the
    point where it closes, cut all of it once more, or start beyond its corner.
    """
    if len(path) and (passes := _linked_passes(path, (0, len(path)))):
        return SplitContours(path, passes)
    split = _split_at_start(path)
    if split is None and contours_of(path) == ((0, len(path)),):
        back = _split_at_start(path.reversed())
        split = None if back is None else (back[0].reversed(), back[1].reversed())
    if split is None:
        path = _split_at_corner(path) or _split_at_overlap(path)
        return _split_open_contours(path, contours_of(path))
    straight, closing = split
    return _split_open_contours(straight, contours_of(closing))


def _split_open_contours(path: Path, contours: tuple[RowRange, ...]) -> SplitContours:
    """Split the open contours among several in the same way, each by itself."""
    parts, divided, next_row, added = list[Path](), list[RowRange](), 0, 0
    for first, last in contours:
        part = path.part(first, last)
        alone = len(contours) == 1 or is_closed(path, (first, last))
        split = SplitContours(part, ((0, len(part)),)) if alone else split_where_it_closes(part)
        parts += [path.part(next_row, first), split.path]
        divided += [(begin + first + added, end + first + added) for begin, end in split.contours]
        next_row, added = last, added + len(split.path) - len(part)
    return SplitContours(joined([*parts, path.part(next_row, len(path))]), tuple(divided))


def _split_at_start(path: Path) -> tuple[Path, Path] | None:
    """Split the lines and arcs that run past the point where the first moves end, trying the most moves first.

    Return the path split on the piece, and split at the point itself, which may be off the piece by rounding.
    """
    directions = path.start_directions
    for lead in range(min(MAX_LEAD_MOVES, len(path) - 2), -1, -1):
        point = path.points[lead]
        rows, places = _running_over(path, point, directions[lead])
        later = rows > lead
        if later.any():
            rows, places = rows[later], places[later]
            return _split(path, rows, places), _split(path, rows, np.repeat(point[None], len(rows), axis=0))
    return None


def _split_at_corner(path: Path) -> Path | None:
    """Split the last line where the first one ends, if they are leads out and back beyond a corner.

    Or split the first line where the last one begins.
    """
    if len(path) < 4 or not is_closed(path, (0, len(path))):
        return None
    for directed, is_reversed in ((path, False), (path.reversed(), True)):
        row = len(directed) - 1
        lines = not directed.turns[0] and not directed.turns[row]
        if lines and row in _running_over(directed, directed.points[1], directed.end_directions[row])[0]:
            split = _split(directed, np.array([row]), directed.points[1:2])
            return split.reversed() if is_reversed else split
    return None


def _split_at_overlap(path: Path) -> Path:
    """Split the first and the last line where the contour between them has a corner and follows that line."""
    if len(path) < 4:
        return path
    for is_last in (False, True):
        row, headings = (len(path) - 1, path.end_directions[:-1]) if is_last else (0, path.start_directions[1:])
        start, end = path.points[row], path.points[row + 1]
        length, along = float(path.lengths[row]), path.start_directions[row]
        arms = path.points[1:-1] - start
        stations, offsets = arms @ along, arms @ np.array((-along[1], along[0]))
        over = (stations > CLOSED) & (stations < length - CLOSED) & (np.abs(offsets) <= CLOSED)
        corners = np.flatnonzero(over & (headings @ along > cos(MAX_TANGENT_ANGLE)))
        if not path.turns[row] and len(corners):
            place = start + (end - start) * stations[corners[0]] / length
            path = _split(path, np.array([row]), place[None])
    return path


def _running_over(path: Path, point: Floats, heading: Floats) -> tuple[Rows, Floats]:
    """Return the rows (m,) of pieces that run over a point, and the places (m, 2) where they are nearest to it.

    They run in direction `heading`, with both ends away from the point.  A full circle does not: it closes by itself.
    """
    with np.errstate(all="ignore"):
        pieces = piece_arrays(path)
        points = np.full(len(pieces), complex(*point))
        share = foot(pieces, points)
        near = distance(pieces, points) <= CLOSED
        straight_on = (direction(pieces, share) * np.conj(complex(*heading))).real > cos(MAX_TANGENT_ANGLE)
    reach, ends_apart = share * pieces.length, (path.starts != path.ends).any(axis=1)[pieces.rows]
    over = near & straight_on & (reach > CLOSED) & (reach < pieces.length - CLOSED) & ends_apart
    rows, places = pieces.rows[over], coordinates(at(pieces, share)[over])
    # the ends of a rounded arc have two radii: with one between them here, neither half is more uneven than the whole
    arms, last_arms = places - path.centers[rows], (path.ends - path.centers)[rows]
    first, last = path.radii[rows], np.hypot(last_arms[:, 0], last_arms[:, 1])
    size = np.hypot(arms[:, 0], arms[:, 1])
    grown = (first + share[over] * (last - first)) / np.where(size == 0.0, 1.0, size)
    return rows, np.where(path.turns[rows, None] == 0, places, path.centers[rows] + arms * grown[:, None])


def _split(path: Path, rows: Rows, places: Floats) -> Path:
    """Return the path with pieces split in two at places (m, 2); both halves keep the piece's number."""
    points, twice = np.insert(path.points, rows + 1, places, axis=0), np.insert(np.arange(len(path)), rows + 1, rows)
    return Path.of(points, path.centers[twice], path.turns[twice], path.numbers[twice])


def has_long_leads(path: Path, contours: tuple[RowRange, ...]) -> bool:
    """True if the moves before, between or after contours are long compared with the longest contour."""
    length = np.concatenate((np.zeros(1), np.cumsum(path.lengths)))
    ends = length[[0, *(row for both in contours for row in both), len(path)]]
    gaps, perimeters = ends[1::2] - ends[::2], ends[2::2] - ends[1:-1:2]
    return bool(gaps.max() > MAX_LEAD_SHARE * perimeters.max())


def leads_at_corner(path: Path, contours: tuple[RowRange, ...]) -> bool:
    """True if a line out and back at a corner of a contour is treated as its leads; it may be a wall run twice."""
    for first, last in contours:
        lines = first > 0 and last < len(path) and not path.turns[first - 1] and not path.turns[last]
        back = lines and np.abs(path.points[first - 1] - path.points[last + 1]).max() <= CLOSED
        if back and float(path.end_directions[last - 1] @ path.start_directions[first]) < cos(MAX_RETRACE_ANGLE):
            return True
    return False


def blend_leads(path: Path, contours: tuple[RowRange, ...]) -> frozenset[int]:
    """Return the rows of leads that blend into or out of a contour: in line with it up to an arc, and beyond.

    No program has surface of this kind: these moves certainly are leads.
    """
    rows = set[int]()
    ends = [0, *(row for both in contours for row in both), len(path)]
    for first, last in zip(ends[::2], ends[1::2], strict=True):  # the moves between contours
        outward, inward = range(first - 1, last), range(last, first - 1, -1)
        if (first > 0 and _blends(path, outward)) or (last < len(path) and _blends(path, inward)):
            rows.update(range(first, last))
    return frozenset(rows)


def _blends(path: Path, rows: range) -> bool:
    """True if the moves run on tangent from the contour's row, the first one, out to an arc."""
    for row, next_row in pairwise(rows):
        before, after = min(row, next_row), max(row, next_row)
        if float(path.end_directions[before] @ path.start_directions[after]) < cos(MAX_TANGENT_ANGLE):
            return False
        if path.turns[next_row]:
            return True
    return False


def contour_of(path: Path) -> RowRange:
    """Return the rows of the only contour without its leads; all rows if there are several or none is closed."""
    contours = contours_of(path)
    return contours[0] if len(contours) == 1 else (0, len(path))


def _point_ids(path: Path) -> list[int]:
    """Return for each point of the path the index of an earlier point within CLOSED of it, or its own index."""
    point_ids = list[int]()
    firsts = defaultdict[tuple[int, int], list[int]](list)
    points, cells = path.points.tolist(), np.floor(path.points / CLOSED).astype(np.int64).tolist()
    for index, (point, (column, row)) in enumerate(zip(points, cells, strict=True)):
        around = ((column + across, row + up) for across in (0, -1, 1) for up in (0, -1, 1))
        near = (first for cell in around for first in firsts.get(cell, ()) if dist(points[first], point) <= CLOSED)
        point_id = next(near, index)
        point_ids.append(point_id)
        if point_id == index:
            firsts[column, row].append(index)
    return point_ids


def _longest(sums: Floats, point_ids: list[int]) -> RowRange | None:
    """Return the closed run of the most pieces that encloses something."""
    first_seen: dict[int, int] = {}
    best = (0, 0)
    for index, point_id in enumerate(point_ids):
        begin = first_seen.setdefault(point_id, index)
        if index - begin > best[1] - best[0] and _encloses(sums, (begin, index)):
            best = (begin, index)
    return best if best[1] else None


def _between_leads(path: Path, sums: Floats, point_ids: list[int], rows: RowRange) -> RowRange:
    """Return the closed run inside a closed one that starts and ends with a lead.

    These leads are a line out and back in the middle of a wall or off a corner, or arcs of at most a quarter turn in
    line with the wall: around a square corner both arcs of a blend may begin and end at one point.  In a bore they may
    be half a turn.  With a further move before and behind, they are shorter than the run between them.
    """
    for count in range(1, MAX_LEAD_MOVES + 1):
        begin, end = rows[0] + count, rows[1] - count
        if begin >= end or point_ids[begin] != point_ids[end] or not _encloses(sums, (begin, end)):
            continue
        if not path.turns[begin - 1] and not path.turns[end]:
            return (begin, end) if count == 1 and _leads_off(path, begin, end) else rows
        largest = pi if _inside_of_circle(path, (begin - 1, end), (begin, end)) else pi / 2
        arcs = all(path.turns[row] and abs(path.sweeps[row]) <= largest + MAX_TANGENT_ANGLE for row in (begin - 1, end))
        tangent = _blends(path, range(begin, begin - 2, -1)) and _blends(path, range(end - 1, end + 1))
        lead_in, around, lead_out = np.diff(sums[1, [rows[0], begin, end, rows[1]]]).tolist()
        short = count == 1 or lead_in + lead_out < around
        return (begin, end) if arcs and tangent and short else rows
    return _between_arcs(path, sums, point_ids, rows) or rows


def _between_arcs(path: Path, sums: Floats, point_ids: list[int], rows: RowRange) -> RowRange | None:
    """Return the closed run inside a closed one that goes back to the beginning of its lead-in behind its lead-out.

    The leads are as in `_between_leads`, but not as many moves before as behind.
    """
    for begin in range(rows[0] + 1, min(rows[0] + MAX_LEAD_MOVES, rows[1]) + 1):
        for end in range(rows[1] - 1, begin, -1):
            if point_ids[begin] != point_ids[end] or not _encloses(sums, (begin, end)):
                continue
            out = end_of_overlap(path, (begin, end))
            if not out < rows[1] <= out + MAX_LEAD_MOVES:
                continue
            arcs = [begin - 1, out]
            quarters = path.turns[arcs].all() and np.abs(path.sweeps[arcs]).max() <= pi / 2 + MAX_TANGENT_ANGLE
            tangent = _blends(path, range(begin, begin - 2, -1)) and _blends(path, range(out - 1, out + 1))
            lead_in, around, _, lead_out = np.diff(sums[1, [rows[0], begin, end, out, rows[1]]]).tolist()
            if quarters and tangent and lead_in + lead_out < around:
                return begin, end
    return None


def _leads_off(path: Path, begin: int, end: int) -> bool:
    """True if the line in row `end` leads off the closed run that begins and ends there.

    It does from the middle of a wall, and at a corner if it is at least square to both walls or continues one of them;
    any other line may be a wall that is run twice by mistake.
    """
    before, after = -path.end_directions[end - 1], path.start_directions[begin]
    lead = path.start_directions[end]
    smooth = float(before @ after) < -cos(MAX_RETRACE_ANGLE)
    straight_on = min(float(lead @ before), float(lead @ after)) < -cos(MAX_RETRACE_ANGLE)
    return smooth or straight_on or max(float(lead @ before), float(lead @ after)) <= MAX_RETRACE_ANGLE


def _inside_of_circle(path: Path, arcs: tuple[int, int], rows: RowRange) -> bool:
    """True if the rows are one circle, and the arcs that touch it lie inside it."""
    turns, centers, radii = (values[slice(*rows)] for values in (path.turns, path.centers, path.radii))
    circle = bool(turns[0] and (turns == turns[0]).all() and np.abs(centers - centers[0]).max() <= CLOSED)
    return circle and all(path.turns[arc] == turns[0] and path.radii[arc] < radii[0] for arc in arcs)


def _within(sums: Floats, point_ids: list[int], rows: RowRange) -> list[RowRange]:
    """Return the contours among rows outside the longest one: closed runs, and long open runs between them."""
    begin, end = rows
    last_seen = {point_ids[index]: index for index in range(begin, end + 1)}
    contours: list[RowRange] = []
    row = open_start = begin
    while row < end:
        close = last_seen[point_ids[row]]
        if close > row and _encloses(sums, (row, close)):
            contours += [*_open((open_start, row)), (row, close)]
            row = open_start = close
        else:
            row += 1
    return [*contours, *_open((open_start, end))]


def _sums(path: Path) -> Floats:
    """Return (4, n + 1) twice the area and the length up to each of the path's points, and its x, y from the first."""
    corners = (path.points - path.points[:1]).T
    areas = corners[0, :-1] * corners[1, 1:] - corners[1, :-1] * corners[0, 1:]
    areas += np.where(path.turns != 0, path.radii**2 * (path.sweeps - np.sin(path.sweeps)), 0.0)
    sums = np.concatenate((np.zeros((2, 1)), np.cumsum((areas, path.lengths), axis=1)), axis=1)
    return np.concatenate((sums, corners))


def _encloses(sums: Floats, rows: RowRange) -> bool:
    """True if a closed run is more than a move out and back; a line closes the gap that rounding leaves at its end."""
    (first_area, first_length, x0, y0), (last_area, last_length, x1, y1) = sums[:, rows].T.tolist()
    area = last_area - first_area + x1 * y0 - y1 * x0
    return bool(abs(area) > CLOSED * (last_length - first_length))


def end_of_overlap(path: Path, rows: RowRange) -> int:
    """Return the first row after a closed run that does not run along its beginning again."""
    first, last = rows
    return last + _running_along(path, last, first, min(len(path) - last, last - first))


def _running_along(path: Path, row: int, earlier_row: int, most: int) -> int:
    """Return how many pieces from a row on, `most` at most, run along those from the earlier row on.

    Such a piece starts where the other one does, goes the same way, and is no longer than that one.
    """
    later, earlier = path.part(row, row + most), path.part(earlier_row, earlier_row + most)
    distances = np.maximum(np.abs(later.starts - earlier.starts), np.abs(later.centers - earlier.centers)).max(axis=1)
    same = (later.turns == earlier.turns) & (distances <= CLOSED)
    same &= (later.start_directions * earlier.start_directions).sum(axis=1) > cos(MAX_RETRACE_ANGLE)
    same &= later.lengths <= earlier.lengths + CLOSED
    return most if same.all() else int(same.argmin())


def _open(rows: RowRange) -> list[RowRange]:
    return [rows] if rows[1] - rows[0] > MAX_LEAD_MOVES else []
