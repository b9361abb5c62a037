"""Chains pieces, closed chains first; at a branch it takes the smallest change of direction that leads back.

A trail that returns to a node it has passed completes a closed chain.  Nodes where more than two ends meet are
branches.  Every piece is in one chain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import atan2, tau
from typing import Final, NamedTuple

from core.geometry.piece import Piece, Point
from core.importing.clean_up import is_circle, reversed_piece
from core.importing.nodes import KEY_DECIMALS, Nodes, nodes_of

MAX_SEARCH: Final = 5_000_000
"""Steps of the search for ways back; the pieces left after that many stay in open chains."""


class Link(NamedTuple):
    """A piece by its row, traveled forward or backward."""

    row: int
    forward: bool


@dataclass(slots=True)
class Chain:
    """Links in order of travel."""

    links: list[Link]
    closed: bool


@dataclass(slots=True)
class Chained:
    """All chains; `branches` are the points where more than two ends meet, with their number."""

    chains: list[Chain] = field(default_factory=list)
    branches: list[tuple[Point, int]] = field(default_factory=list)
    given_up: bool = False
    """True if the branches needed a longer search than `MAX_SEARCH`."""


def chained(pieces: Sequence[Piece], tolerance: float) -> Chained:
    """Chain the pieces, which are in an order that does not depend on the drawing's."""
    result = Chained()
    rows = [row for row, piece in enumerate(pieces) if not is_circle(piece)]
    result.chains += [Chain([Link(row, True)], True) for row, piece in enumerate(pieces) if is_circle(piece)]
    walker = _Walker([pieces[row] for row in rows], nodes_of([pieces[row] for row in rows], tolerance))
    walker.run()
    for chain in walker.chains:
        chain.links = [Link(rows[link.row], link.forward) for link in chain.links]
        result.chains.append(chain)
    nodes = walker.nodes
    crowded = [(nodes.places[node], nodes.degree(node)) for node in range(len(nodes.places)) if nodes.degree(node) > 2]
    result.branches = sorted(crowded)
    result.given_up = walker.steps > MAX_SEARCH
    return result


class _Step(NamedTuple):
    """A link and the nodes it leads from and to."""

    link: Link
    begin: int
    end: int


@dataclass(slots=True)
class _Walker:
    pieces: list[Piece]
    nodes: Nodes
    chains: list[Chain] = field(default_factory=list)
    used: list[bool] = field(default_factory=list)
    steps: int = 0
    left: list[int] = field(default_factory=list)
    """For each node, how many ends of unused pieces it has."""

    def run(self) -> None:
        """Find the closed chains first, then chain what is left as open chains."""
        self.used = [False] * len(self.pieces)
        aside = self._set_trees_aside()
        for start in self._starts():
            while self.left[start] and self._closed_from(start):
                pass
        for row in aside:
            self.used[row] = False
        self._open_chains()

    def _set_trees_aside(self) -> list[int]:
        """Mark pieces that lead to a loose end as used for now: no closed chain holds them.  Return their rows."""
        self.left = [self.nodes.degree(node) for node in range(len(self.nodes.places))]
        waiting = [node for node, count in enumerate(self.left) if count == 1]
        aside: list[int] = []
        while waiting:
            node = waiting.pop()
            row = next((row for row in self.nodes.pieces[node] if not self.used[row]), None)
            if row is None or self.left[node] != 1:
                continue
            self._use(row)
            aside.append(row)
            waiting += [other for other in self.nodes.of_piece[row] if self.left[other] == 1]
        return aside

    def _use(self, row: int) -> None:
        self.used[row] = True
        for node in self.nodes.of_piece[row]:
            self.left[node] -= 1

    def _starts(self) -> list[int]:
        """Return the nodes from left to right: the leftmost of connected chains is on their outline."""
        points = self.nodes.places
        return sorted(range(len(points)), key=lambda node: tuple(round(value, KEY_DECIMALS) for value in points[node]))

    def _closed_from(self, start: int) -> bool:
        """Walk from a node until the trail ends; keep every closed chain on the way.  False if there was none."""
        trail: list[_Step] = []
        on_trail = {start: 0}
        at, heading, closed_some = start, -tau / 4, False
        while True:
            step = self._next(at, heading, on_trail)
            if step is None:
                if not trail:
                    return closed_some
                # a dead end: the last piece of the trail belongs to no closed chain
                last = trail.pop()
                on_trail.pop(last.end, None)
                at = last.begin
                heading = self._end_heading(trail[-1].link) if trail else -tau / 4
                self._leave(last)
                continue
            self._use(step.link.row)
            trail.append(step)
            at = step.end
            if at not in on_trail:
                on_trail[at] = len(trail)
                heading = self._end_heading(step.link)
                continue
            first = on_trail[at]
            self.chains.append(Chain([step.link for step in trail[first:]], True))
            closed_some = True
            for passed in trail[first:]:
                if passed.end != at:
                    on_trail.pop(passed.end, None)
            del trail[first:]
            if not trail:
                return True
            heading = self._end_heading(trail[-1].link)

    def _leave(self, step: _Step) -> None:
        """Keep a piece for the open chains; it stays used while closed chains are searched."""
        self.chains.append(Chain([step.link], False))

    def _next(self, node: int, heading: float, on_trail: dict[int, int]) -> _Step | None:
        """Return the only way on, or the one that leads back with the smallest change of direction."""
        ways = [
            way for row in dict.fromkeys(self.nodes.pieces[node]) if not self.used[row] for way in self._ways(row, node)
        ]
        if len(ways) > 1:
            ways.sort(key=lambda way: self._change(way, heading))
        return next((way for way in ways if len(ways) == 1 or self._leads_back(way, on_trail)), None)

    def _ways(self, row: int, node: int) -> list[_Step]:
        first, last = self.nodes.of_piece[row]
        ways = [_Step(Link(row, True), first, last)] if first == node else []
        return ways + ([_Step(Link(row, False), last, first)] if last == node and first != last else [])

    def _change(self, way: _Step, heading: float) -> tuple[float, float, int]:
        """Return the sort key of a way: how much it turns, to the right first if two turn equally."""
        piece = self._traveled(way.link)
        dx, dy = piece.direction_at(piece.start)
        turned = (atan2(dy, dx) - heading + tau / 2) % tau - tau / 2
        return round(abs(turned), KEY_DECIMALS), turned, way.link.row

    def _traveled(self, link: Link) -> Piece:
        return self.pieces[link.row] if link.forward else reversed_piece(self.pieces[link.row])

    def _end_heading(self, link: Link) -> float:
        piece = self._traveled(link)
        dx, dy = piece.direction_at(piece.end)
        return atan2(dy, dx)

    def _leads_back(self, way: _Step, on_trail: dict[int, int]) -> bool:
        """True if unused pieces connect the end of a way to a node of the trail."""
        if way.end in on_trail:
            return True
        seen, waiting = {way.end}, [way.end]
        while waiting and self.steps <= MAX_SEARCH:
            node = waiting.pop()
            for row in self.nodes.pieces[node]:
                self.steps += 1
                if self.used[row] or row == way.link.row:
                    continue
                for other in self.nodes.of_piece[row]:
                    if other in on_trail:
                        return True
                    if other not in seen:
                        seen.add(other)
                        waiting.append(other)
        return False

    def _open_chains(self) -> None:
        """Chain the pieces of no closed chain, each chain from a loose end or branch to the next."""
        loose = [chain for chain in self.chains if not chain.closed]
        self.chains = [chain for chain in self.chains if chain.closed]
        for chain in loose:
            for link in chain.links:
                self.used[link.row] = False
        rows = [row for row in range(len(self.pieces)) if not self.used[row]]
        ends: dict[int, list[int]] = {}
        for row in rows:
            for node in self.nodes.of_piece[row]:
                ends.setdefault(node, []).append(row)
        # start at the ends of chains; what is left after them is rings
        ordered = sorted(ends, key=lambda node: (len(ends[node]) == 2, *self.nodes.places[node]))
        for node in ordered:
            for row in ends[node]:
                if not self.used[row]:
                    self.chains.append(self._open_from(node, row, ends))

    def _open_from(self, node: int, row: int, ends: dict[int, list[int]]) -> Chain:
        links: list[Link] = []
        start = node
        while True:
            self.used[row] = True
            first, last = self.nodes.of_piece[row]
            forward = first == node
            links.append(Link(row, forward))
            node = last if forward else first
            further = [other for other in ends[node] if not self.used[other]]
            if len(ends[node]) != 2 or not further:
                return Chain(links, node == start and len(links) > 1)
            row = further[0]
