"""Followers: what turns programmed elements into moves.  This one does not compensate; controls build on it.

The machine hands over every element in plane coordinates, and tells when compensation is asked for.  A follower
writes moves to the tape and keeps, for the verdict, what was programmed under compensation.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from core.controls.compensation.corners import Element
from core.controls.control_run import Change, Log, Stretch
from core.controls.iso.words import Block
from core.controls.moves import Plane, Point3, Tape, flat, solid
from core.geometry.piece import Point, Side

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


@dataclass(slots=True)
class Span:
    """A stretch of compensated moves being gathered."""

    side: Side
    radius: float
    plane: Plane
    first: int
    programmed: Tape
    entry: int = 1
    exit: int = 0
    changes: list[Change] = field(default_factory=list)


class Follower:
    """Moves without compensation, and the bookkeeping every control's compensation needs.

    `machine` is set by the machine that it follows.  `active`: compensation is in force.  `watching`: every block is
    shown to `watch`.
    """

    def __init__(self, log: Log) -> None:
        self.log = log
        self.machine: Machine
        self.tape = Tape()
        self.plane = Plane.XY
        self.active = False
        self.watching = False
        self.stretches: list[Stretch] = []
        self._span: Span | None = None
        self._leaving = False

    def begin(self, side: Side, block: Block) -> None:
        """G41 or G42, also while already active; before the block's motion."""

    def finish(self, block: Block) -> None:
        """G40; before the block's motion."""

    def watch(self, block: Block) -> None:
        """Any block while watching, before anything of it happens."""

    def tool_called(self, number: int, block: Block) -> None:
        """A T word or tool data, before it takes effect."""

    def idle(self, block: Block) -> None:
        """A block without motion while active, after its codes."""

    def own(self, code: int, block: Block) -> None:
        """A G code of this control alone, in tenths."""

    def close(self) -> None:
        """The program ends."""

    def travel(self, element: Element) -> None:
        """One programmed element."""
        if element.turn:
            self.arc(element, element.end, element.center)
        else:
            self.straight(element, element.end)
        if self._leaving and element.moves:
            self._left()

    def straight(self, element: Element, end: Point, *, low: bool = False) -> None:
        """A straight move of an element's to a point of its plane, at its end's height or still at its start's."""
        x, y = end
        z = element.low if low else element.high
        if self.plane is not Plane.XY:
            x, y, z = solid(x, y, z, self.plane)
        if element.rapid:
            self.tape.rapid(x, y, z, element.line)
        else:
            self.tape.straight(x, y, z, element.feed, element.line)

    def arc(self, element: Element, end: Point, center: Point) -> None:
        """An element's own arc, or its offset, to a point of its plane."""
        self.bend(element, end, center, element.turn, element.high)

    def bend(self, element: Element, end: Point, center: Point, turn: int, height: float) -> None:
        """Any arc of an element's, at its feed."""
        plane = self.plane
        target, middle = (*end, height), (*center, height)
        if plane is not Plane.XY:
            target, middle = solid(*target, plane), solid(*middle, plane)
        self.tape.arc(target, middle, turn, plane, element.feed, element.line)

    @property
    def here(self) -> Point:
        """Where the axes stand, in the plane."""
        return flat(self.tape.last, self.plane)[:2]

    def place(self, programmed: Point3) -> Point3:
        """Where the axes stand as a program can read it, millimeters; without compensation the programmed point."""
        return programmed

    def open_span(self, side: Side, radius: float, element: Element) -> None:
        """Compensated moves begin with this element; whatever is on the tape is before them."""
        self.close_span()
        start = Tape(solid(element.start[0], element.start[1], element.low, self.plane))
        self._span = Span(side, abs(radius), self.plane, len(self.tape) - 1, start)

    def change_span(self, side: Side, radius: float, before: int, across: int) -> None:
        """From the element noted last on the stretch has this side and radius.

        `before` moves are still to be made up to there with the old one, and `across` from there to the new one.
        """
        span = self._span
        if span is None:
            return
        row = len(self.tape) - 1 + before
        now = span.changes[-1] if span.changes else span
        if (now.side, now.radius) != (side, abs(radius)):
            span.changes.append(Change(len(span.programmed) - 1, row, row + across, side, abs(radius)))

    def begin_span(self, side: Side, radius: float) -> None:
        """The stretch has this side and radius from its first element on."""
        if self._span is not None:
            self._span.side, self._span.radius = side, abs(radius)

    def note(self, element: Element) -> None:
        """An element programmed under compensation."""
        if self._span is None:
            return
        plane, height, tape = self.plane, element.high, self._span.programmed
        target = (*element.end, height)
        if plane is not Plane.XY:
            target = solid(*target, plane)
        if element.turn:
            middle = solid(*element.center, height, plane)
            tape.arc(target, middle, element.turn, plane, element.feed, element.line)
        else:
            tape.straight(*target, element.feed, element.line)

    def leave(self, *, entry: int, exits: int) -> None:
        """Compensation is canceled: the next motion in the plane still belongs to the stretch."""
        if self._span is not None:
            self._span.entry, self._span.exit = entry, exits
            self._leaving = True

    def _left(self) -> None:
        self.close_span()

    def close_span(self) -> None:
        """Nothing more belongs to the stretch."""
        span, self._span, self._leaving = self._span, None, False
        if span is None:
            return
        moves, last = span.programmed.moves(), len(self.tape)
        entry, exits, first = span.entry, span.exit, span.first
        stretch = Stretch(span.side, span.radius, span.plane, moves, entry, exits, first, last)
        self.stretches.append(replace(stretch, changes=tuple(span.changes)))
