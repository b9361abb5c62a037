"""Chains pieces, closed chains first: the outline around all connected pieces, then the outlines of what is in it.

A walk that turns to the right as far as it can, wherever more than two ends meet, goes along one face.  Of connected
pieces the outermost face is the one whose walk encloses most, counterclockwise.  Where a walk returns to a node it has
completed a closed chain; pieces that it travels both ways are in none.  Every piece is in one chain.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from math import atan2, tau
from typing import Final, NamedTuple

from core.geometry.piece import Arc, Line, Piece, Point, signed_area
from core.importing.clean_up import is_circle
from core.importing.nodes import KEY_DECIMALS, Groups, Nodes, nodes_of

SAME_DIRECTION: Final = 10.0**-KEY_DECIMALS
"""Directions in radians that differ by less are one; which of two pieces is on the right follows from their bend."""


class Link(NamedTuple):
    """A piece by its row, traveled forward or backward."""

    row: int
    forward: bool

    @property
    def back(self) -> Link:
        """The same piece traveled the other way."""
        return Link(self.row, not self.forward)


@dataclass(slots=True)
class Chain:
    """Links in order of travel."""

    links: list[Link]
    closed: bool


def chained(pieces: Sequence[Piece], tolerance: float) -> tuple[list[Chain], list[tuple[Point, int]]]:
    """Chain the pieces, which are in an order that does not depend on the drawing's.

    Also return the branches, the points where more than two ends meet, with their number.
    """
    rows = [row for row, piece in enumerate(pieces) if not is_circle(piece)]
    chains = [Chain([Link(row, True)], True) for row, piece in enumerate(pieces) if is_circle(piece)]
    curves = [pieces[row] for row in rows]
    nodes = nodes_of(curves, tolerance)
    for chain in _Chainer(curves, nodes).run():
        chains.append(Chain([Link(rows[link.row], link.forward) for link in chain.links], chain.closed))
    crowded = [(at, len(meeting)) for at, meeting in zip(nodes.places, nodes.pieces, strict=True) if len(meeting) > 2]
    return chains, sorted(crowded)


@dataclass(slots=True)
class _Chainer:
    pieces: list[Piece]
    nodes: Nodes
    leaving: list[list[Link]] = field(default_factory=list)
    """For each node the links that leave it, counterclockwise."""
    areas: list[float] = field(default_factory=list)
    """The area between each piece and a point, positive if it passes that point counterclockwise."""

    def run(self) -> list[Chain]:
        """Return the closed chains, then what is left as open chains."""
        self.areas = [signed_area((Line(self.nodes.places[0], piece.start), piece)) for piece in self.pieces]
        self.leaving = [[] for _ in self.nodes.places]
        for row, (first, last) in enumerate(self.nodes.of_piece):
            self.leaving[first].append(Link(row, True))
            self.leaving[last].append(Link(row, False))
        for links in self.leaving:
            links.sort(key=self._direction)
        chains, unchained = list[Chain](), set(range(len(self.pieces)))
        while loops := self._loops(self._outlines(unchained)):
            chains += [Chain(loop, True) for loop in loops]
            unchained -= {link.row for loop in loops for link in loop}
        return chains + self._open_chains(sorted(unchained))

    def _direction(self, link: Link) -> tuple[float, float, int]:
        """Return the sort key of a link: its direction from its first node, then how it bends to the left."""
        piece = self.pieces[link.row] if link.forward else self.pieces[link.row].reversed()
        dx, dy = piece.direction_at(piece.start)
        direction = atan2(dy, dx) % tau
        if tau - direction < SAME_DIRECTION:
            direction = 0.0
        bend = int(piece.turn) / piece.radius if isinstance(piece, Arc) else 0.0
        return round(direction, KEY_DECIMALS), bend, link.row

    def _end(self, link: Link) -> int:
        return self.nodes.of_piece[link.row][link.forward]

    def _outlines(self, rows: Collection[int]) -> list[list[Link]]:
        """Return the walk around all of each group of connected pieces."""
        following: dict[Link, Link] = {}
        groups = Groups(len(self.leaving))
        for row in rows:
            groups.join(*self.nodes.of_piece[row])
        for links in self.leaving:
            candidates = [link for link in links if link.row in rows]
            # an arriving walk turns to the right as far as possible: to the next leaving link counterclockwise
            following |= {
                link.back: after for link, after in zip(candidates, (*candidates[1:], *candidates[:1]), strict=True)
            }
        outlines: dict[int, tuple[float, list[Link]]] = {}
        for first in list(following):
            if first not in following:
                continue
            walk = [first]
            while (after := following.pop(walk[-1])) != walk[0]:
                walk.append(after)
            area = sum(self.areas[link.row] if link.forward else -self.areas[link.row] for link in walk)
            group = groups.root(self._end(walk[0]))
            if group not in outlines or area > outlines[group][0]:
                outlines[group] = area, walk
        return [walk for _, walk in outlines.values()]

    def _loops(self, walks: list[list[Link]]) -> list[list[Link]]:
        """Return the closed chains of walks: each begins and ends at one node and passes no other one twice."""
        loops, taken = list[list[Link]](), set[int]()
        for walk in walks:
            trail, passed = list[Link](), {self._end(walk[-1]): 0}
            for link in walk:
                trail.append(link)
                first = passed.setdefault(self._end(link), len(trail))
                if first == len(trail):
                    continue
                loop = trail[first:]
                del trail[first:]
                for inner in loop[:-1]:
                    del passed[self._end(inner)]
                rows = {inner.row for inner in loop}
                if len(rows) == len(loop) and rows.isdisjoint(taken):
                    loops.append(loop)
                    taken |= rows
        return loops

    def _open_chains(self, rows: Sequence[int]) -> list[Chain]:
        """Chain the pieces of no closed chain, each chain from a loose end or branch to the next."""
        ends: dict[int, list[int]] = {}
        for row in rows:
            for node in self.nodes.of_piece[row]:
                ends.setdefault(node, []).append(row)
        chains, used = list[Chain](), set[int]()
        # start at the ends of chains; what is left after them is rings
        for node in sorted(ends, key=lambda node: (len(ends[node]) == 2, *self.nodes.places[node])):
            chains += [self._open_from(node, row, ends, used) for row in ends[node] if row not in used]
        return chains

    def _open_from(self, node: int, row: int, ends: dict[int, list[int]], used: set[int]) -> Chain:
        links: list[Link] = []
        start = node
        while True:
            used.add(row)
            link = Link(row, self.nodes.of_piece[row][0] == node)
            links.append(link)
            node = self._end(link)
            further = [other for other in ends[node] if other not in used]
            if len(ends[node]) != 2 or not further:
                return Chain(links, node == start and len(links) > 1)
            row = further[0]
