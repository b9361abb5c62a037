"""Cleans up pieces before chaining: drops those without length and duplicates, joins overlaps, and counts each.

The result is sorted, so that a drawing whose entities are shuffled or drawn backward gives the same contours.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, pairwise
from math import atan2, dist, floor, inf, pi, tau
from typing import Final, NamedTuple, TypeGuard

import numpy as np
import shapely

from core.geometry.path import Path, chords_of
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.importing.nesting import CHORD_ERROR
from core.importing.nodes import KEY_DECIMALS, Groups, Nodes, nodes_of

MAX_OVERLAP_DISTANCE: Final = 0.01
"""Largest distance in millimeters of equal or collinear pieces, even if TOLERANCE is larger."""

NO_LENGTH: Final = 1e-7
"""Millimeters below which a piece is a point."""

ANGLE_CELL: Final = 0.002
"""Lines whose directions differ by more than this, in radians, are not collinear."""


class LayeredPiece(NamedTuple):
    """A piece in millimeters with its layer and the number of its entity, 0 if not known."""

    piece: Piece
    layer: str
    entity: int = 0


@dataclass(slots=True)
class Cleaned:
    """The pieces that stay, and how many were too short, equal to others, or joined with those they overlap.

    `closed` holds the pieces of each closed entity, or cell, that meets another one: these are chained alone.  `shared`
    counts the edges of cells that are drawn twice.  `largest_difference` is the largest of a duplicate, and its place.
    """

    pieces: list[LayeredPiece] = field(default_factory=list)
    closed: list[list[LayeredPiece]] = field(default_factory=list)
    tiny: int = 0
    duplicates: int = 0
    overlaps: int = 0
    shared: int = 0
    largest_difference: tuple[float, Point] = (0.0, (0.0, 0.0))


_Continuations = tuple[tuple[int, ...], tuple[int, ...]]
"""The rows of the pieces that continue at a piece's start and at its end."""


def clean_up(pieces: Iterable[LayeredPiece], tolerance: float) -> Cleaned:
    """Return the pieces without those that chaining cannot use."""
    oriented = sorted((_oriented(item) for item in pieces), key=_key)
    long = _without_tiny(oriented, tolerance)
    cleaned = Cleaned(tiny=len(oriented) - len(long))
    single = _without_duplicates(long, tolerance, cleaned)
    joined = _without_overlaps(single, tolerance, min(tolerance, MAX_OVERLAP_DISTANCE))
    cleaned.duplicates, cleaned.overlaps = len(long) - len(single), len(single) - len(joined)
    cleaned.pieces, cleaned.closed = _closed_entities(sorted(joined, key=_key), tolerance)
    return cleaned


def is_circle(piece: Piece) -> TypeGuard[Arc]:
    """True if a piece is a full circle."""
    return isinstance(piece, Arc) and piece.start == piece.end


def _oriented(item: LayeredPiece) -> LayeredPiece:
    """Return the piece from its lower left end; a full circle counterclockwise from its leftmost point."""
    piece = item.piece
    if is_circle(piece):
        start = (piece.center[0] - piece.radius, piece.center[1])
        return item._replace(piece=Arc(start, start, piece.center, Turn.CCW))
    first, last = (tuple(round(value, KEY_DECIMALS) for value in point) for point in (piece.start, piece.end))
    return item if first <= last else item._replace(piece=piece.reversed())


def _key(item: LayeredPiece) -> tuple[float, ...]:
    piece = item.piece
    center = piece.center if isinstance(piece, Arc) else piece.point_at(0.5)
    turn = float(piece.turn) if isinstance(piece, Arc) else 0.0
    rounded = (round(value, KEY_DECIMALS) for value in (*piece.start, *piece.end, *center, turn))
    return (*rounded, *piece.start, *piece.end, *center)


def _without_tiny(items: list[LayeredPiece], tolerance: float) -> list[LayeredPiece]:
    """Drop short pieces that lead nowhere; a run of short pieces stays if it extends as far as the tolerance.

    A piece of a run whose own ends are one point is dropped: alone it would be a closed chain without length.
    """
    # a piece without length has no direction either
    items = [item for item in items if item.piece.length >= NO_LENGTH]
    small = [row for row, item in enumerate(items) if item.piece.length < tolerance]
    if not small:
        return items
    pieces = [items[row].piece for row in small]
    nodes = nodes_of(pieces, tolerance, exact=True)
    dropped = {row for row, (start, end) in zip(small, nodes.of_piece, strict=True) if start == end}
    for run in _runs(nodes):
        run_pieces = [pieces[member] for member in run]
        x, y = zip(
            *(point for piece in run_pieces for point in (piece.start, piece.point_at(0.5), piece.end)), strict=True
        )
        if max(max(x) - min(x), max(y) - min(y)) < tolerance:
            dropped |= {small[member] for member in run}
    return [item for row, item in enumerate(items) if row not in dropped]


def _runs(nodes: Nodes) -> list[list[int]]:
    """Return the connected groups of pieces, as rows."""
    groups, runs = Groups(len(nodes.places)), defaultdict[int, list[int]](list)
    for ends in nodes.of_piece:
        groups.join(*ends)
    for row, (first, _) in enumerate(nodes.of_piece):
        runs[groups.root(first)].append(row)
    return list(runs.values())


def _without_duplicates(items: list[LayeredPiece], tolerance: float, cleaned: Cleaned) -> list[LayeredPiece]:
    """Drop each piece that equals another one, forward or backward, unless both are edges of closed contours.

    Closed contours are closed entities, and cells: faces between pieces of which each has a copy of every edge.
    """
    copies = _without_partial_copies(items, _equal_rows(items, tolerance), tolerance)
    differences = (
        (_difference(items[rows[0]].piece, items[row].piece), items[row].piece) for rows in copies for row in rows[1:]
    )
    cleaned.largest_difference = max(
        ((off, _middle(piece)) for off, piece in differences), default=cleaned.largest_difference
    )
    shared = {items[row].entity for rows in copies for row in rows if len(rows) > 1} - {0}
    edges: defaultdict[int, dict[int, int]] = defaultdict(dict)
    for number, rows in enumerate(copies):
        for row in rows:
            if items[row].entity in shared:
                edges[items[row].entity].setdefault(number, row)
    # an entity with the same edges as one before it is a copy
    complete = {frozenset(edge_rows): edge_rows for edge_rows in reversed(edges.values()) if len(edge_rows) > 1}
    closed = {
        key: rows for key, rows in complete.items() if _is_closed([items[row] for row in rows.values()], tolerance)
    }
    owners = {entity for entity, edge_rows in edges.items() if frozenset(edge_rows) in closed}
    taken_edges = frozenset[int]().union(*closed)
    free = [[row for row in rows if items[row].entity not in owners] for rows in copies]
    cells, sides = _cells(free, taken_edges, _faces(items, free, taken_edges, tolerance))
    used = Counter(number for cell in cells for number in cell)
    cleaned.shared = sum(sides[number] > 1 or number in taken_edges for number in used)
    kept = [items[row] for rows in closed.values() for row in rows.values()]
    # a cell is no entity of the drawing: its number is below 0
    kept += [items[free[number].pop()]._replace(entity=-row) for row, cell in enumerate(cells, 1) for number in cell]
    kept += [
        items[rows[0]]
        for number, rows in enumerate(free)
        if rows and number not in taken_edges and used[number] < max(sides[number], 1)
    ]
    return sorted(kept, key=_key)


def _cells(
    free: Sequence[Sequence[int]], taken: frozenset[int], faces: list[list[int]]
) -> tuple[list[list[int]], Counter[int]]:
    """Return the faces that share an edge and have copies enough of all theirs, and the number of faces at each edge.

    Edges of closed entities are taken: a face may use another copy of some of them.
    """
    sides = Counter(number for face in faces for number in face)
    # if all of the drawing is drawn twice, a dividing line is no edge of two cells
    times = min((len(free[number]) for number in sides if sides[number] == 1 and number not in taken), default=1)
    cells = [
        face
        for face in faces
        if all(len(free[number]) >= times * sides[number] for number in face)
        and any(sides[number] > 1 or number in taken for number in face)
        and not taken.issuperset(face)
    ]
    return cells, sides


def _faces(
    items: Sequence[LayeredPiece], free: Sequence[Sequence[int]], taken: frozenset[int], tolerance: float
) -> list[list[int]]:
    """Return the edges of each face between pieces, by their numbers; none if no piece has a copy to spare."""
    numbers = [number for number, rows in enumerate(free) if rows and not is_circle(items[rows[0]].piece)]
    if not any(len(free[number]) > 1 or number in taken for number in numbers):
        return []
    pieces = [items[free[number][0]].piece for number in numbers]
    nodes = nodes_of(pieces, tolerance)
    chords: list[list[Point]] = []
    for piece, (start, end) in zip(pieces, nodes.of_piece, strict=True):
        inner = [] if isinstance(piece, Line) else chords_of(Path.from_pieces([piece]), CHORD_ERROR)[1:-1].tolist()
        chords.append([nodes.places[start], *map(tuple, inner), nodes.places[end]])
    number_of = {frozenset(points[:2]): number for points, number in zip(chords, numbers, strict=True)}
    rings = [face.exterior.coords for face in shapely.polygonize([shapely.LineString(line) for line in chords]).geoms]
    return [[number_of[ends] for ends in map(frozenset, pairwise(ring)) if ends in number_of] for ring in rings]


def _closed_entities(
    items: Sequence[LayeredPiece], tolerance: float
) -> tuple[list[LayeredPiece], list[list[LayeredPiece]]]:
    """Return the pieces of each closed entity that meets another one, and apart from them all other pieces."""
    curves = [item for item in items if not is_circle(item.piece)]
    nodes = nodes_of([item.piece for item in curves], tolerance)
    meeting = {curves[row].entity for rows in nodes.pieces if len(rows) > 2 for row in rows} - {0}
    entities: defaultdict[int, list[LayeredPiece]] = defaultdict(list)
    for item in curves:
        if item.entity in meeting:
            entities[item.entity].append(item)
    closed = {number: own for number, own in entities.items() if len(own) > 1 and _is_closed(own, tolerance)}
    return [item for item in items if item.entity not in closed], list(closed.values())


def _is_closed(items: Sequence[LayeredPiece], tolerance: float) -> bool:
    """True if an even number of ends meets at each node: the pieces make loops alone."""
    return all(len(ends) % 2 == 0 for ends in nodes_of([item.piece for item in items], tolerance).pieces)


def _without_partial_copies(
    items: Sequence[LayeredPiece], copies: Sequence[list[int]], tolerance: float
) -> list[list[int]]:
    """Take a piece for a copy only if it touches the other one, or if all pieces connected to it are copies.

    A contour that runs near another one for a while keeps its pieces: without some of them it would be open.
    """
    runs = _runs(nodes_of([item.piece for item in items], tolerance, exact=True))
    run_of = {row: number for number, run in enumerate(runs) for row in run}
    run_sets = [{run_of[row] for row in rows} for rows in copies]
    unlike = frozenset[int]().union(*(numbers for numbers in run_sets if len(numbers) == 1))
    divided: list[list[int]] = []
    for rows in copies:
        parts: defaultdict[int, list[int]] = defaultdict(list)
        for row in rows:
            parts[run_of[row] if run_of[row] in unlike else -1].append(row)
        whole = parts.pop(-1, [])
        first, *others = parts.values() or [[]]
        divided += [[*first, *whole], *others]
    return divided


def _equal_rows(items: Sequence[LayeredPiece], tolerance: float) -> list[list[int]]:
    """Return the rows of equal pieces together, in order of the first of them."""
    # each of perhaps a thousand copies is compared only with the first of them
    slack, groups = min(tolerance, MAX_OVERLAP_DISTANCE), list[list[int]]()
    width = max(slack, 1e-7)
    cells: defaultdict[tuple[int, int], list[list[int]]] = defaultdict(list)
    for row, item in enumerate(items):
        piece = item.piece
        middle = _middle(piece)
        x, y = floor(middle[0] / width), floor(middle[1] / width)
        near = max(min(slack, piece.length / 4.0), 1e-7)
        around = (rows for right in (-1, 0, 1) for up in (-1, 0, 1) for rows in cells.get((x + right, y + up), ()))
        group = next((rows for rows in around if _difference(piece, items[rows[0]].piece) <= near), [])
        if not group:
            cells[x, y].append(group)
            groups.append(group)
        group.append(row)
    return groups


def _middle(piece: Piece) -> Point:
    return piece.center if is_circle(piece) else piece.point_at(0.5)


def _difference(first: Piece, second: Piece) -> float:
    """Return how far two pieces are from each other, infinite if one of them is a full circle."""
    if is_circle(first) and is_circle(second):
        return dist(first.center, second.center) + abs(first.radius - second.radius)
    if is_circle(first) or is_circle(second):
        return inf
    forward = max(dist(first.start, second.start), dist(first.end, second.end))
    backward = max(dist(first.start, second.end), dist(first.end, second.start))
    return max(min(forward, backward), dist(first.point_at(0.5), second.point_at(0.5)))


def _without_overlaps(items: list[LayeredPiece], tolerance: float, slack: float) -> list[LayeredPiece]:
    """Join pieces that overlap on one line or one circle, if an end of one of them is loose.

    If no end is loose, each belongs to a contour of its own that runs along the other one, and both stay.
    """
    before, joined = 0, items
    while len(joined) != before:
        # an end may be loose now that the piece beyond it is joined
        before, joined = len(joined), _joined_once(joined, tolerance, slack)
    return joined


def _joined_once(items: list[LayeredPiece], tolerance: float, slack: float) -> list[LayeredPiece]:
    items = items.copy()
    open_rows = [row for row, item in enumerate(items) if not is_circle(item.piece)]
    nodes = nodes_of([items[row].piece for row in open_rows], tolerance)
    continuing: dict[int, _Continuations] = {}
    for at, row in enumerate(open_rows):
        start, end = (
            tuple(open_rows[other] for other in nodes.pieces[node] if other != at) for node in nodes.of_piece[at]
        )
        continuing[row] = start, end
    joiner = _Joiner(items, continuing, slack)
    for first, second in _candidates(items, slack):
        joiner.join(first, second)
    return [item for row, item in enumerate(items) if row not in joiner.joined_into]


def _candidates(items: Sequence[LayeredPiece], slack: float) -> Iterator[tuple[int, int]]:
    """Yield pairs of rows of pieces that may overlap on one line or one circle, the lower row first."""
    circles: defaultdict[tuple[int, ...], list[int]] = defaultdict(list)
    directions: defaultdict[int, list[int]] = defaultdict(list)
    cell = max(4.0 * slack, 1e-6)
    count = int(pi / ANGLE_CELL)
    for row, item in enumerate(items):
        piece = item.piece
        # each goes into two cells, half a cell apart, so that near pieces share one of them
        for half in (0, 1):
            if isinstance(piece, Arc):
                numbers = (*piece.center, piece.radius)
                circles[(half, *(floor(value / cell + half / 2.0) for value in numbers))].append(row)
            else:
                directions[2 * (int(_direction(piece) / ANGLE_CELL + half / 2.0) % count) + half].append(row)
    for rows in circles.values():
        yield from combinations(rows, 2)
    for key in sorted(directions):
        if len(directions[key]) > 1:
            yield from _near_lines(items, directions[key], slack)


def _direction(piece: Piece) -> float:
    """Return the direction of a line in radians, the same forward and backward."""
    (x0, y0), (x1, y1) = piece.start, piece.end
    return atan2(y1 - y0, x1 - x0) % pi


def _near_lines(items: Sequence[LayeredPiece], rows: list[int], slack: float) -> list[tuple[int, int]]:
    """Return pairs of nearly parallel lines whose boxes overlap in a frame aligned with them."""
    pieces = [items[row].piece for row in rows]
    starts = np.array([complex(*piece.start) for piece in pieces])
    ends = np.array([complex(*piece.end) for piece in pieces])
    along = ends - starts
    # squares ignore a line's sign: the mean direction is half that of their sum
    ahead = np.sqrt((along * along).sum())
    if abs(ahead) == 0.0:
        return []
    turned = [points * (ahead.conjugate() / abs(ahead)) for points in (starts, ends)]
    low, high = np.minimum(turned[0].real, turned[1].real), np.maximum(turned[0].real, turned[1].real)
    below, above = np.minimum(turned[0].imag, turned[1].imag), np.maximum(turned[0].imag, turned[1].imag)
    boxes = shapely.box(low - slack, below - slack, high + slack, above + slack)
    first, second = shapely.STRtree(boxes).query(boxes)
    order = first < second
    return sorted((rows[i], rows[j]) for i, j in zip(first[order].tolist(), second[order].tolist(), strict=True))


@dataclass(slots=True)
class _Joiner:
    """Joins overlapping pieces two at a time; `joined_into` maps a row to the row it was joined into.

    `continuing` holds the rows that continue at the start and at the end of each piece; an end without any is loose.
    """

    items: list[LayeredPiece]
    continuing: dict[int, _Continuations]
    slack: float
    joined_into: dict[int, int] = field(default_factory=dict)

    def join(self, first: int, second: int) -> None:
        """Replace the first of two pieces by their union, if they overlap and an end is loose.

        No end where another piece continues may vanish inside the union: a stray line opens no contour.  An exception
        is a piece that the other of the two overlaps as well: it is joined with them next.
        """
        first, second = self._row(first), self._row(second)
        both = self.continuing.get(first, ((), ())), self.continuing.get(second, ((), ()))
        circles = first not in self.continuing, second not in self.continuing
        if first == second or all(is_circle or all(ends) for is_circle, ends in zip(circles, both, strict=True)):
            return
        union = _union(self.items[first].piece, self.items[second].piece, self.slack)
        if union is None:
            return
        pieces = self.items[first].piece, self.items[second].piece
        for row, end in {(0, 0), (0, 1), (1, 0), (1, 1)} - {union.start, union.end}:
            at, other = (pieces[row].start, pieces[row].end)[end], pieces[1 - row]
            continuing = {self._row(neighbor) for neighbor in both[row][end]} - {first, second}
            if min(dist(at, other.start), dist(at, other.end)) > self.slack and any(
                _union(self.items[neighbor].piece, other, self.slack) is None for neighbor in continuing
            ):
                return
        self.joined_into[second] = first
        (start_of, start), (end_of, end) = union.start, union.end
        longer = second if start_of == end_of == 1 else first
        self.items[first] = self.items[longer]._replace(piece=union.piece)
        self.continuing[first] = both[start_of][start], both[end_of][end]

    def _row(self, row: int) -> int:
        while row in self.joined_into:
            row = self.joined_into[row]
        return row


_PieceEnd = tuple[int, int]
"""Which of two pieces, and which end of it: 0 for its start."""


class _Directed(NamedTuple):
    """A piece, perhaps reversed, and what its ends are: which piece it comes from, and which end of that."""

    piece: Piece
    start: _PieceEnd
    end: _PieceEnd


def _directed(number: int, piece: Piece, *, back: bool) -> _Directed:
    return _Directed(piece.reversed() if back else piece, (number, int(back)), (number, int(not back)))


def _union(first: Piece, second: Piece, slack: float) -> _Directed | None:
    """Return the two pieces as one if they overlap by more than the slack, else None."""
    if isinstance(first, Line) and isinstance(second, Line):
        return _line_union(first, second, slack)
    if isinstance(first, Arc) and isinstance(second, Arc):
        return _arc_union(first, second, slack)
    return None


def _line_union(first: Line, second: Line, slack: float) -> _Directed | None:
    longer, number, shorter = (first, 0, second) if first.length >= second.length else (second, 1, first)
    if longer.length <= 4.0 * slack:
        return None
    (x, y), (dx, dy) = longer.start, longer.direction_at(longer.start)
    local = [((px - x) * dx + (py - y) * dy, (py - y) * dx - (px - x) * dy) for px, py in (shorter.start, shorter.end)]
    if any(abs(off) > slack for _, off in local):
        return None
    (begin, _), (end, _) = local
    after = _directed(1 - number, shorter, back=begin > end)
    interval = min(begin, end), max(begin, end)
    return _united(_directed(number, longer, back=False), longer.length, after, interval, slack)


def _arc_union(first: Arc, second: Arc, slack: float) -> _Directed | None:
    if dist(first.center, second.center) > slack or abs(first.radius - second.radius) > slack:
        return None
    for number, arc in enumerate((first, second)):
        if arc.start == arc.end:
            return _directed(number, arc, back=False)
    base, after = (_directed(number, arc, back=arc.turn < 0) for number, arc in enumerate((first, second)))
    sweeps, reach = (abs(first.sweep), abs(second.sweep)), slack / first.radius
    # angles from the start of the first, counterclockwise
    begin = _angle(first.center, base.piece.start, after.piece.start)
    if tau - begin <= sweeps[1] - reach:
        begin -= tau
    end = begin + sweeps[1]
    union = _united(base, sweeps[0], after, (begin, end), reach)
    if union is not None and max(sweeps[0], end) - min(0.0, begin) >= tau - reach:
        circle = Arc(base.piece.start, base.piece.start, first.center, Turn.CCW)
        return _Directed(circle, (0, 0), (0, 1))
    return union


def _united(
    base: _Directed, size: float, after: _Directed, interval: tuple[float, float], slack: float
) -> _Directed | None:
    """Return two pieces as one, measured along the first, which has this size; the second covers the interval."""
    begin, end = interval
    if min(end, size) - max(begin, 0.0) <= slack:
        return None
    first, last = after if begin < -slack else base, after if end > size + slack else base
    return _Directed(replace(base.piece, start=first.piece.start, end=last.piece.end), first.start, last.end)


def _angle(center: Point, first: Point, second: Point) -> float:
    """Return the counterclockwise angle from one point to another about a center, 0 to a full turn."""
    angles = [atan2(point[1] - center[1], point[0] - center[0]) for point in (first, second)]
    return (angles[1] - angles[0]) % tau
