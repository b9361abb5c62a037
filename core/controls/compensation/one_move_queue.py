"""The queue of LinuxCNC and what follows its rules: one move of the plane is held until the next one is known.

The first move ends square to itself.  Z moves may stand behind the held move in the queue.  An outside corner gets an
arc, an inside corner moves the ends of what is held, anything under 0.05 radians is taken as tangent.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from math import hypot, pi
from types import MappingProxyType
from typing import Final, NamedTuple

from core.controls.compensation.corners import (
    Element,
    meetings,
    offset_radius,
    square_end,
    square_start,
    sweep,
    turning,
)
from core.controls.compensation.follower import Follower
from core.controls.control_run import Log
from core.controls.iso.words import Block
from core.controls.moves import Plane, Point3, flat, solid
from core.geometry.piece import Point, Side
from core.units import Unit

TANGENT: Final = 0.05
"""Radians under which a corner is none."""

NO_FIT: Final = "The cutter does not fit into this corner without gouging; use a smaller cutter or open the corner."


NOSES: Final[Mapping[int, tuple[int, int]]] = MappingProxyType(
    {1: (1, -1), 2: (-1, -1), 3: (-1, 1), 4: (1, 1), 5: (1, 0), 6: (0, -1), 7: (-1, 0), 8: (0, 1)}
)
"""Lathe orientation: in which direction of Z and X the controlled point lies from the nose's center, in radii."""


@dataclass(frozen=True, slots=True)
class Rules:
    """The ids of a control's rules for the same faults."""

    entry: str
    arc_radius: str
    concave: str
    arc_exit: str


class Held(NamedTuple):
    """A move that waits: where it would end, and its rapid or feed element; Z moves have their own element."""

    element: Element
    end: Point


_held: Final = partial(tuple.__new__, Held)


class LookAhead(Follower):
    """The queue; `offset` is the radius in millimeters, positive with the tool on the left."""

    always = False
    """Whether blocks are watched without compensation too."""

    rules = Rules("N-GOUGE", "N-ARCRADIUS", "N-CONCAVE", "N-ARCEXIT")

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.offset = 0.0
        self.first = True
        self.queue: list[Held] = []
        self.started: Point | None = None
        self.no_arc = False
        self.watching = self.always
        self.nose: Point = (0.0, 0.0)
        self.lathe = False

    def turn_on(self, offset: float, orientation: int = 0) -> None:
        """Compensation is on from the next move on; a lathe tool's orientation shifts its moves by the nose radius."""
        self.offset = offset
        ways = NOSES.get(orientation, (0, 0)) if self.plane is Plane.ZX else (0, 0)
        self.nose = (ways[0] * abs(offset), ways[1] * abs(offset))
        self.lathe = ways != (0, 0)
        self.active = self.watching = True
        self.first = True

    def finish(self, block: Block) -> None:
        """G40: what is held ends square."""
        if self.active and self.offset and not self.first:
            self._move_ends(square_end(self._front, self.offset), block.line)
            self.no_arc = True
            self.leave(entry=1, exits=0)
        self.active, self.watching = False, self.always
        self.first = True

    def close(self) -> None:
        """The end of the program: what is held ends square."""
        if self.queue:
            self._move_ends(square_end(self._front, self.offset), self.queue[-1].element.line)

    def straight(self, element: Element, end: Point, *, low: bool = False) -> None:
        """A straight move, of a lathe tool's controlled point."""
        Follower.straight(self, element, self._nosed(end) if self.lathe else end, low=low)

    def bend(self, element: Element, end: Point, center: Point, turn: int, height: float) -> None:
        """An arc, of a lathe tool's controlled point."""
        if self.lathe:
            end, center = self._nosed(end), self._nosed(center)
        Follower.bend(self, element, end, center, turn, height)

    def _nosed(self, point: Point) -> Point:
        return (point[0] + self.nose[0], point[1] + self.nose[1]) if self.active else point

    def place(self, programmed: Point3) -> Point3:
        """Under compensation where the held move would end, were it not changed by the next one."""
        if not self.active or not self.queue:
            return programmed
        first, second = self.queue[-1].end
        return solid(first, second, flat(programmed, self.plane)[2], self.plane)

    def travel(self, element: Element) -> None:
        """One element: alone, as entry, or against what is held."""
        if element.turn and self.no_arc:
            text = "The first move after G40 is straight; write a line before the arc."
            self.log.stop(self.rules.arc_exit, text, element.line, 1)
        self.no_arc = False
        if not self.active or not self.offset:
            super().travel(element)
        elif self.first:
            self._enter(element)
        elif element.turn or element.start != element.end:
            self._corner(element)
        else:
            self.note(element)
            self.queue.append(Held(element, square_end(self._front, self.offset)))

    @property
    def _front(self) -> Element:
        return self.queue[0].element

    def _enter(self, element: Element) -> None:
        """The first move: longer than the radius, and square to itself at its end."""
        length = hypot(element.end[0] - element.start[0], element.end[1] - element.start[1])
        if length <= abs(self.offset):
            text = "The entry move is {0} long and the radius is {1}; it has to be longer than the radius."
            self.log.stop(self.rules.entry, text, element.line, 1, lengths=(length, abs(self.offset)))
        if element.turn and offset_radius(element, self.offset) <= 0.0:
            self._too_small(element)
        side = Side.LEFT if self.offset > 0.0 else Side.RIGHT
        self.open_span(side, self.offset, element)
        self.note(element)
        end = square_end(element, self.offset)
        if element.turn and self.nose != (0.0, 0.0):
            self.straight(element, element.start, low=True)
        self.queue = [Held(self._as_entry(element, end), end)]
        self.started = None if element.turn else element.start
        self.first = False

    def _as_entry(self, element: Element, end: Point) -> Element:
        """The entry as it runs; LinuxCNC does not look whether a later trim turns it round."""
        if not element.turn:
            return element._replace(leaving=(0.0, 0.0))
        return element._replace(start=element.end, center=self._entry_center(element, end))

    def _entry_center(self, element: Element, end: Point) -> Point:
        """The center of the entry arc: from the present point to the square end, with the programmed tangent there."""
        (sx, sy), (ex, ey), (cx, cy) = element.start, end, element.center
        half = hypot(sx - ex, sy - ey) / 2
        reach = hypot(cx - ex, cy - ey) or 1.0
        way = ((cx - ex) / reach, (cy - ey) / reach)
        lean = ((sx - ex) * way[0] + (sy - ey) * way[1]) / (2 * half)
        if abs(lean) < 1e-6:
            self._too_small(element)
        return ex + way[0] * half / lean, ey + way[1] * half / lean

    def _too_small(self, element: Element) -> None:
        text = "The arc's radius {0} is not larger than the cutter's {1}; use a smaller cutter or a larger arc."
        self.log.stop(self.rules.arc_radius, text, element.line, 1, lengths=(element.radius, abs(self.offset)))

    def _corner(self, element: Element) -> None:
        """A further move in the plane, against the one that is held."""
        if element.turn and element.turn * self.offset > 0.0 and offset_radius(element, self.offset) <= 0.0:
            self._too_small(element)
        front = self.queue[0].element
        angle = turning(front, element) * (1 if self.offset > 0.0 else -1)
        back = abs(angle) > pi - TANGENT
        if (angle > TANGENT and not back) or (back and self._hooks(front, element)):
            self._inside(front, element)
        elif angle < -TANGENT or back:
            self._outside(front, element)
        else:
            self._run_queue()
            self.started = square_end(front, self.offset)
        self.note(element)
        self.queue = [_held((element, square_end(element, self.offset)))]

    def _hooks(self, front: Element, element: Element) -> bool:
        """Reversals that are inside corners: off the top of an arc, or onto one, with the cutter outside of it."""
        bent = element.turn or front.turn
        return bent * self.offset < 0.0

    def _inside(self, front: Element, element: Element) -> None:
        points = meetings(front, element, self.offset, self.offset)
        if not points:
            self.log.stop(self.rules.concave, NO_FIT, element.line, 1, at=element.start)
        self._move_ends(points[self._which(front, element)] if len(points) > 1 else points[0], element.line)

    def _which(self, front: Element, element: Element) -> int:
        """Which of two meetings: along a line the first one outside its arc, two arcs by the side they bend to."""
        if not front.turn:
            return 1 if element.turn * self.offset > 0.0 else 0
        if not element.turn:
            return 0 if front.turn * self.offset > 0.0 else 1
        return 0 if (front.turn * self.offset > 0.0) == (element.turn > 0) else 1

    def _outside(self, front: Element, element: Element) -> None:
        corner = square_end(front, self.offset)
        if element.turn:
            self._run_queue()
        else:
            self._move_ends(corner, element.line)
        start = square_start(element, self.offset)
        if element.rapid:
            self.straight(element, start, low=True)
        else:
            self.bend(element, start, element.start, -1 if self.offset > 0.0 else 1, element.low)
        self.started = start

    def _move_ends(self, point: Point, line: int) -> None:
        """Everything held ends at this point instead; a move that would run backwards stops the program."""
        for held in self.queue:
            if held.element.turn:
                self._check_arc(held, point, line)
            elif self.started is not None:
                self._check_line(held, point, line)
        self.queue = [_held((element, point)) for element, _ in self.queue]
        self._run_queue()
        self.started = point

    def _check_line(self, held: Held, point: Point, line: int) -> None:
        way, start = held.element.leaving, self.started or point
        if (point[0] - start[0]) * way[0] + (point[1] - start[1]) * way[1] < 0.0:
            self.log.stop(self.rules.concave, NO_FIT, line, 1, at=held.element.end)

    def _check_arc(self, held: Held, point: Point, line: int) -> None:
        element = held.element
        if self.started is None:
            return
        swept = sweep(element.start, element.end, element.center, element.turn) or 2 * pi
        now = sweep(self.started, point, element.center, element.turn) or 2 * pi
        if now > swept + self._slack:
            self.log.stop(self.rules.concave, NO_FIT, line, 1, at=element.end)

    @property
    def _slack(self) -> float:
        """Radians by which an arc's sweep may grow."""
        return 0.001 if self.machine.unit is Unit.IN else 0.0254

    def _run_queue(self) -> None:
        for element, end in self.queue:
            if element.turn:
                self.arc(element, end, element.center)
            else:
                self.straight(element, end)
        self.queue = []
        self.started = None
