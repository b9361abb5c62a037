"""Clean-up before chaining: pieces without length, equal pieces and overlapping ones, each counted.

The pieces come out in an order of their own, so that a drawing whose entities are shuffled or drawn backwards gives
the same contours.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from math import atan2, cos, dist, pi, sin, tau
from typing import Final, NamedTuple

from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.importing.nodes import Nodes, PointGrid, exact_nodes, nodes_of

MOST_SLACK: Final = 0.01
"""Millimeters within which pieces may be equal or lie on one line, whatever TOLERANCE is above it."""

ANGLE_CELL: Final = 0.002
"""Radians: lines whose directions differ by more are not on one line."""

KEY_DECIMALS: Final = 6


class LayeredPiece(NamedTuple):
    """A piece in millimeters with its layer and the line of its entity."""

    piece: Piece
    layer: str
    line: int = 0


@dataclass(slots=True)
class Cleaned:
    """The pieces that stay, and how many went: too short, equal to others, joined with what they overlap."""

    pieces: list[LayeredPiece] = field(default_factory=list)
    tiny: int = 0
    duplicates: int = 0
    overlaps: int = 0


def clean_up(pieces: Iterable[LayeredPiece], tolerance: float) -> Cleaned:
    """The pieces without what chaining cannot use."""
    kept = sorted((_oriented(item) for item in pieces), key=_key)
    count = len(kept)
    kept = _without_tiny(kept, tolerance)
    cleaned = Cleaned(tiny=count - len(kept))
    slack = min(tolerance, MOST_SLACK)
    count = len(kept)
    kept = _without_duplicates(kept, slack)
    cleaned.duplicates = count - len(kept)
    count = len(kept)
    kept = _without_overlaps(kept, tolerance, slack)
    cleaned.overlaps = count - len(kept)
    cleaned.pieces = sorted(kept, key=_key)
    return cleaned


def reversed_piece(piece: Piece) -> Piece:
    """The piece traveled the other way."""
    if isinstance(piece, Line):
        return Line(piece.end, piece.start)
    return Arc(piece.end, piece.start, piece.center, Turn(-piece.turn))


def is_circle(piece: Piece) -> bool:
    """Whether a piece is a full circle."""
    return isinstance(piece, Arc) and piece.start == piece.end


def _oriented(item: LayeredPiece) -> LayeredPiece:
    """The piece from its lower left end on; a full circle counterclockwise from its leftmost point."""
    piece = item.piece
    if isinstance(piece, Arc) and piece.start == piece.end:
        (x, y), radius = piece.center, piece.radius
        return item._replace(piece=Arc((x - radius, y), (x - radius, y), (x, y), Turn.CCW))
    start, end = (tuple(round(value, KEY_DECIMALS) for value in point) for point in (piece.start, piece.end))
    return item if start <= end else item._replace(piece=reversed_piece(piece))


def _key(item: LayeredPiece) -> tuple[float, ...]:
    piece = item.piece
    center = piece.center if isinstance(piece, Arc) else piece.point_at(0.5)
    turn = float(piece.turn) if isinstance(piece, Arc) else 0.0
    rounded = (round(value, KEY_DECIMALS) for value in (*piece.start, *piece.end, *center, turn))
    return (*rounded, *piece.start, *piece.end, *center)


def _without_tiny(items: list[LayeredPiece], tolerance: float) -> list[LayeredPiece]:
    """Without the pieces that lead nowhere: a run of short ones stays where it is longer than the tolerance."""
    small = [row for row, item in enumerate(items) if item.piece.length < max(tolerance, 1e-7)]
    if not small:
        return items
    runs = _runs([items[row].piece for row in small], tolerance)
    dropped: set[int] = set()
    for run in runs:
        ends = [point for member in run for point in _extent(items[small[member]].piece)]
        width = max(x for x, _ in ends) - min(x for x, _ in ends)
        height = max(y for _, y in ends) - min(y for _, y in ends)
        if max(width, height) < max(tolerance, 1e-7):
            dropped |= {small[member] for member in run}
    return [item for row, item in enumerate(items) if row not in dropped]


def _extent(piece: Piece) -> tuple[Point, ...]:
    return piece.start, piece.point_at(0.5), piece.end


def _runs(pieces: Sequence[Piece], tolerance: float) -> Iterator[list[int]]:
    """The pieces in groups that hang together."""
    nodes = exact_nodes(pieces, tolerance)
    seen = [False] * len(pieces)
    for first in range(len(pieces)):
        if seen[first]:
            continue
        seen[first], run, waiting = True, list[int](), [first]
        while waiting:
            row = waiting.pop()
            run.append(row)
            for node in nodes.of_piece[row]:
                for other in nodes.pieces[node]:
                    if not seen[other]:
                        seen[other] = True
                        waiting.append(other)
        yield run


def _without_duplicates(items: list[LayeredPiece], slack: float) -> list[LayeredPiece]:
    """Without the pieces that another one equals, forward or backward."""
    grid, kept = PointGrid(max(slack, 1e-7)), list[LayeredPiece]()
    for item in items:
        middle = item.piece.point_at(0.5) if not is_circle(item.piece) else item.piece.start
        near = max(min(slack, item.piece.length / 4.0), 1e-7)
        if not any(_equal(item.piece, kept[other].piece, near) for other in grid.near(middle)):
            grid.add(middle, len(kept))
            kept.append(item)
    return kept


def _equal(first: Piece, second: Piece, slack: float) -> bool:
    if is_circle(first) is not is_circle(second):
        return False
    if is_circle(first):
        assert isinstance(first, Arc)
        assert isinstance(second, Arc)
        return dist(first.center, second.center) <= slack and abs(first.radius - second.radius) <= slack
    forward = dist(first.start, second.start) <= slack and dist(first.end, second.end) <= slack
    backward = dist(first.start, second.end) <= slack and dist(first.end, second.start) <= slack
    return (forward or backward) and dist(first.point_at(0.5), second.point_at(0.5)) <= slack


class _Span(NamedTuple):
    """A stretch of a carrier from `low` to `high`, and the piece it is of."""

    low: float
    high: float
    row: int


def _without_overlaps(items: list[LayeredPiece], tolerance: float, slack: float) -> list[LayeredPiece]:
    """With pieces that overlap on one line or one circle joined to one, where an end of one of them leads nowhere.

    Where no end is loose, each belongs to a contour of its own that runs along the other one, and stays.
    """
    open_rows = [row for row, item in enumerate(items) if not is_circle(item.piece)]
    nodes = nodes_of([items[row].piece for row in open_rows], tolerance)
    loose = {row: _loose(nodes, at) for at, row in enumerate(open_rows)}
    gone: set[int] = set()
    for rows in _carriers(items, slack):
        _join_on_carrier(items, rows, slack, loose, gone)
    return [item for row, item in enumerate(items) if row not in gone]


def _loose(nodes: Nodes, at: int) -> tuple[bool, bool]:
    first, last = nodes.of_piece[at]
    return nodes.degree(first) == 1, nodes.degree(last) == 1


def _carriers(items: Sequence[LayeredPiece], slack: float) -> Iterator[list[int]]:
    """Groups of pieces that may lie on one line or one circle."""
    circles: defaultdict[tuple[int, ...], list[int]] = defaultdict(list)
    directions: defaultdict[int, list[int]] = defaultdict(list)
    cell = max(4.0 * slack, 1e-6)
    for row, item in enumerate(items):
        piece = item.piece
        if isinstance(piece, Arc):
            for shift in (0.0, 0.5):
                numbers = (*piece.center, piece.radius)
                circles[(int(2 * shift), *(int(value / cell + shift) for value in numbers))].append(row)
        else:
            angle = atan2(piece.end[1] - piece.start[1], piece.end[0] - piece.start[0]) % pi
            for shift in (0.0, 0.5):
                directions[2 * (int(angle / ANGLE_CELL + shift) % int(pi / ANGLE_CELL)) + int(2 * shift)].append(row)
    yield from (rows for rows in circles.values() if len(rows) > 1)
    for key in sorted(directions):
        if len(directions[key]) > 1:
            yield from _strips(items, directions[key], (key // 2 + 0.5 - key % 2 / 2) * ANGLE_CELL, slack)


def _strips(items: Sequence[LayeredPiece], rows: list[int], angle: float, slack: float) -> Iterator[list[int]]:
    """Lines of nearly one direction in groups whose distances from the origin overlap, each in order along them."""
    ahead, spans = (cos(angle), sin(angle)), list[_Span]()
    begins: dict[int, float] = {}
    for row in rows:
        ends = (items[row].piece.start, items[row].piece.end)
        offsets = [y * ahead[0] - x * ahead[1] for x, y in ends]
        begins[row] = min(x * ahead[0] + y * ahead[1] for x, y in ends)
        spans.append(_Span(min(offsets) - slack, max(offsets) + slack, row))
    group, high = list[int](), float("-inf")
    for span in sorted(spans):
        if span.low > high and group:
            yield sorted(group, key=lambda row: begins[row])
            group = []
        high = max(high, span.high) if group else span.high
        group.append(span.row)
    yield sorted(group, key=lambda row: begins[row])


def _join_on_carrier(
    items: list[LayeredPiece], rows: list[int], slack: float, loose: dict[int, tuple[bool, bool]], gone: set[int]
) -> None:
    """Join the pieces of a group that overlap; the group is in the order in which its lines begin."""
    active: list[int] = []
    for row in rows:
        if row in gone:
            continue
        active = [other for other in active if other not in gone and _reaches(items[other].piece, items[row].piece)]
        for other in active:
            if any(loose.get(row, ())) or any(loose.get(other, ())):
                _join_pair(items, (other, row), slack, loose, gone)
            if row in gone:
                break
        else:
            active.append(row)


def _reaches(first: Piece, second: Piece) -> bool:
    """Whether two pieces of a carrier may overlap: the boxes of lines do, but for their slack."""
    if isinstance(first, Arc) or isinstance(second, Arc):
        return True
    return all(
        max(first.start[axis], first.end[axis]) + MOST_SLACK >= min(second.start[axis], second.end[axis])
        and max(second.start[axis], second.end[axis]) + MOST_SLACK >= min(first.start[axis], first.end[axis])
        for axis in (0, 1)
    )


def _join_pair(
    items: list[LayeredPiece],
    pair: tuple[int, int],
    slack: float,
    loose: dict[int, tuple[bool, bool]],
    gone: set[int],
) -> None:
    """Put what two pieces cover together into the first of them, if they overlap."""
    first, second = pair
    union = _union(items[first].piece, items[second].piece, slack)
    if union is None:
        return
    piece, ends = union
    both = (loose.get(first, (True, True)), loose.get(second, (True, True)))
    gone.add(second)
    items[first] = items[first]._replace(piece=piece)
    loose[first] = (both[ends[0][0]][ends[0][1]], both[ends[1][0]][ends[1][1]])


_EndsOf = tuple[tuple[int, int], tuple[int, int]]
"""Of the joined piece's start and end: which piece it comes from, and which end of that."""


def _union(first: Piece, second: Piece, slack: float) -> tuple[Piece, _EndsOf] | None:
    """The two pieces as one, if they overlap by more than the slack."""
    if isinstance(first, Line) and isinstance(second, Line):
        return _line_union(first, second, slack)
    if isinstance(first, Arc) and isinstance(second, Arc):
        return _arc_union(first, second, slack)
    return None


def _line_union(first: Line, second: Line, slack: float) -> tuple[Piece, _EndsOf] | None:
    longer, number, shorter = (first, 0, second) if first.length >= second.length else (second, 1, first)
    if longer.length <= 4.0 * slack:
        return None
    (x, y), (dx, dy) = longer.start, longer.direction_at(longer.start)
    local = [((px - x) * dx + (py - y) * dy, (py - y) * dx - (px - x) * dy) for px, py in (shorter.start, shorter.end)]
    if any(abs(off) > slack for _, off in local):
        return None
    low, high = min(local[0][0], local[1][0]), max(local[0][0], local[1][0])
    if min(high, longer.length) - max(low, 0.0) <= slack:
        return None
    forward = local[0][0] <= local[1][0]
    start, end = (longer.start, (number, 0)), (longer.end, (number, 1))
    if low < -slack:
        start = (shorter.start, (1 - number, 0)) if forward else (shorter.end, (1 - number, 1))
    if high > longer.length + slack:
        end = (shorter.end, (1 - number, 1)) if forward else (shorter.start, (1 - number, 0))
    return Line(start[0], end[0]), (start[1], end[1])


def _arc_union(first: Arc, second: Arc, slack: float) -> tuple[Piece, _EndsOf] | None:
    if dist(first.center, second.center) > slack or abs(first.radius - second.radius) > slack:
        return None
    whole: _EndsOf = ((0, 0), (0, 1))
    for arc in (first, second):
        if arc.start == arc.end:
            return arc, whole
    one, other = (arc if arc.turn > 0 else reversed_piece(arc) for arc in (first, second))
    assert isinstance(one, Arc)
    assert isinstance(other, Arc)
    reach = slack / first.radius
    # angles from the start of the first, counterclockwise
    begin = _angle(first.center, one.start, other.start)
    end = begin + other.sweep
    behind = begin - tau if tau - begin <= other.sweep - reach else begin
    if behind < 0.0:
        begin, end = behind, end - tau
    if min(one.sweep, end) - max(0.0, begin) <= reach:
        return None
    ends = [
        [(0, 0), (0, 1)] if first.turn > 0 else [(0, 1), (0, 0)],
        [(1, 0), (1, 1)] if second.turn > 0 else [(1, 1), (1, 0)],
    ]
    start_at, start_of = (other.start, ends[1][0]) if begin < -reach else (one.start, ends[0][0])
    end_at, end_of = (other.end, ends[1][1]) if end > one.sweep + reach else (one.end, ends[0][1])
    if max(one.sweep, end) - min(0.0, begin) >= tau - reach:
        return Arc(one.start, one.start, one.center, Turn.CCW), whole
    return Arc(start_at, end_at, one.center, Turn.CCW), (start_of, end_of)


def _angle(center: Point, first: Point, second: Point) -> float:
    """The angle from one point to another about a center, counterclockwise, 0 to a full turn."""
    angles = [atan2(point[1] - center[1], point[0] - center[0]) for point in (first, second)]
    return (angles[1] - angles[0]) % tau
