"""A chain of offset elements: each is held until its neighbor is known, then ends as the control's joint says.

The base of the controls that read ahead and then join two offset elements in their own way.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from core.controls.compensation.corners import Element, runs_back, square_end
from core.controls.compensation.follower import Follower
from core.controls.control_run import Log
from core.geometry.piece import Point

SAME: Final = 1e-9
"""Millimeters within which the axes are taken to stand at a point already."""


@dataclass(frozen=True, slots=True)
class Joint:
    """How two offset elements meet: the first ends, a line or an arc to each point between, the second starts.

    `through` are the ends of straight moves between them.  `center`: the last of the way to `start` is an arc about it
    on the tool's side.
    """

    end: Point
    start: Point
    through: tuple[Point, ...] = ()
    center: Point | None = None

    @property
    def moves(self) -> int:
        """How many moves lead from the end to the start."""
        last = self.through[-1] if self.through else self.end
        apart = abs(last[0] - self.start[0]) > SAME or abs(last[1] - self.start[1]) > SAME
        return len(self.through) + (1 if self.center is not None or apart else 0)


class Chain(Follower):
    """Offset elements being joined; `offset` is the tool radius in millimeters, positive with the tool on the left."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.offset = 0.0
        self.held: Element | None = None
        self.start: Point | None = None
        self.standing: list[Element] = []
        self.elements = 0

    def joint(self, first: Element, second: Element) -> Joint:
        """How this control joins two elements."""
        raise NotImplementedError

    def backwards(self, element: Element) -> None:
        """A trimmed element would run against its programmed direction."""

    def feed_of(self, element: Element) -> float:
        """The feed at which an offset element runs."""
        return element.feed

    def hold(self, element: Element) -> None:
        """Takes the next element in; the one before it can run now."""
        self.note(element)
        if not element.moves and self.held is not None:
            self.standing.append(element)
            return
        if self.held is not None:
            joint = self.joint(self.held, element)
            self.release(joint.end)
            self._between(joint, element)
            self.start = joint.start
        self.held = element
        self.elements += 1

    def release(self, end: Point) -> None:
        """Runs what is held to a point, and moves across the plane there."""
        element, start = self.held, self.start
        if element is None:
            return
        if start is not None and runs_back(element, start, end):
            self.backwards(element)
        self.offset_move(element, end)
        for standing in self.standing:
            self.straight(standing, end)
        self.held, self.standing = None, []

    def offset_move(self, element: Element, end: Point) -> None:
        """An element on its offset to a point, at the control's feed."""
        element = element._replace(feed=self.feed_of(element))
        if element.turn:
            self.arc(element, end, element.center)
        else:
            self.straight(element, end)

    def _between(self, joint: Joint, element: Element) -> None:
        for point in joint.through:
            self.straight(element, point, low=True)
        if joint.center is not None:
            self.bend(element, joint.start, joint.center, -1 if self.offset > 0.0 else 1, element.low)
        else:
            here = self.here
            if abs(here[0] - joint.start[0]) > SAME or abs(here[1] - joint.start[1]) > SAME:
                self.straight(element, joint.start, low=True)

    def release_square(self) -> None:
        """Runs what is held to its end at right angles."""
        if self.held is not None:
            self.release(square_end(self.held, self.offset))
        self.start = None
