"""Groups the ends of pieces into nodes, by position first and then within TOLERANCE for the loose ends.

Ends within `SAME_POINT` are one node.  A node with a single end is loose: it joins the nearest node within TOLERANCE,
nearest pairs first.  An end that already has a partner never moves to another one, so that a curve of pieces shorter
than TOLERANCE stays a curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import dist
from typing import Final

import numpy as np
import shapely

from core.geometry.piece import Piece, Point

SAME_POINT: Final = 1e-4
"""Ends within this distance are one point, in millimeters, if TOLERANCE is no smaller; CAD drawings are as exact."""

KEY_DECIMALS: Final = 6
"""Decimals of a millimeter that count when pieces and contours are sorted."""

NEAR_BY_PATH: Final = 4.0
"""A node within this many tolerances along the pieces themselves is no partner of a loose end."""


@dataclass(frozen=True, eq=False, slots=True)
class Nodes:
    """For each piece its nodes (start, end); for each node the piece of each end, and the place of the first one."""

    of_piece: list[tuple[int, int]]
    pieces: list[list[int]]
    places: list[Point]


class Groups:
    """Disjoint sets of numbers (union-find); the smallest number represents its set."""

    def __init__(self, count: int) -> None:
        self.parent = list(range(count))

    def root(self, number: int) -> int:
        """Return the number that represents a number's set."""
        while self.parent[number] != number:
            self.parent[number] = self.parent[self.parent[number]]
            number = self.parent[number]
        return number

    def join(self, first: int, second: int) -> None:
        """Make the sets of two numbers one."""
        first, second = self.root(first), self.root(second)
        if first != second:
            self.parent[max(first, second)] = min(first, second)


def nodes_of(pieces: Sequence[Piece], tolerance: float, *, exact: bool = False) -> Nodes:
    """Return the nodes of pieces, none of them a full circle; if `exact` by position alone: loose ends stay loose."""
    ends = [point for piece in pieces for point in (piece.start, piece.end)]
    groups = _same_points(ends, min(tolerance, SAME_POINT))
    nodes = _numbered(ends, groups)
    if tolerance > SAME_POINT and not exact:
        _join_loose(pieces, nodes, groups, tolerance)
        nodes = _numbered(ends, groups)
    return nodes


def _same_points(ends: Sequence[Point], slack: float) -> Groups:
    groups = Groups(len(ends))
    if not ends:
        return groups
    # join identical ends first: a star of lines would have millions of pairs
    unique_ends, firsts, same = np.unique(np.array(ends), axis=0, return_index=True, return_inverse=True)
    for number, first in enumerate(firsts[same.ravel()].tolist()):
        groups.join(number, first)
    points = shapely.points(unique_ends)
    pairs = shapely.STRtree(points).query(points, predicate="dwithin", distance=max(slack, 1e-7))
    for first, second in firsts[pairs[:, pairs[0] < pairs[1]]].T.tolist():
        groups.join(first, second)
    return groups


def _numbered(ends: Sequence[Point], groups: Groups) -> Nodes:
    numbers: dict[int, int] = {}
    at = [numbers.setdefault(groups.root(end), len(numbers)) for end in range(len(ends))]
    pieces: list[list[int]] = [[] for _ in numbers]
    points: list[Point] = [(0.0, 0.0)] * len(numbers)
    for root, number in numbers.items():
        points[number] = ends[root]
    for end, node in enumerate(at):
        pieces[node].append(end // 2)
    return Nodes(list(zip(at[::2], at[1::2], strict=True)), pieces, points)


def _join_loose(pieces: Sequence[Piece], nodes: Nodes, groups: Groups, tolerance: float) -> None:
    """Join loose ends with the nearest nodes within the tolerance, nearest pairs first."""
    loose = [node for node, meeting in enumerate(nodes.pieces) if len(meeting) == 1]
    if not loose:
        return
    points = shapely.points(nodes.places)
    near: dict[int, list[int]] = {node: [] for node in loose}
    for at, other in shapely.STRtree(points).query(points[loose], predicate="dwithin", distance=tolerance).T.tolist():
        if other != loose[at]:
            near[loose[at]].append(other)
    pairs = []
    for node, others in near.items():
        along = _near_by_path(pieces, nodes, node, NEAR_BY_PATH * tolerance) if others else set[int]()
        place = nodes.places[node]
        pairs += [(dist(place, nodes.places[other]), node, other) for other in others if other not in along]
    end_of = {nodes.of_piece[end // 2][end % 2]: end for end in reversed(range(2 * len(pieces)))}
    still_loose = set(loose)
    for _, node, other in sorted(pairs, key=lambda pair: (pair[0], nodes.places[pair[1]], nodes.places[pair[2]])):
        if node in still_loose:
            still_loose -= {node, other}
            groups.join(end_of[node], end_of[other])


def _near_by_path(pieces: Sequence[Piece], nodes: Nodes, start: int, reach: float) -> set[int]:
    """Return the nodes within `reach` of a node, measured along the pieces."""
    best, waiting = {start: 0.0}, [start]
    while waiting:
        node = waiting.pop()
        for piece in nodes.pieces[node]:
            first, last = nodes.of_piece[piece]
            other, distance = (last if first == node else first), best[node] + pieces[piece].length
            if distance <= reach and distance < best.get(other, float("inf")):
                best[other] = distance
                waiting.append(other)
    return set(best)
