"""The recorder collects the moves a control makes, and its compensated stretches with what was programmed there."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import copysign, dist
from typing import Final

from core.controls.compensation.corner_rules import Joint
from core.controls.compensation.elements import Element
from core.controls.control_run import Change, Log, Place, Stretch
from core.controls.moves import Plane, Point3, Tape, flat, solid
from core.geometry.piece import Point, Side
from core.tolerance import ON_PATH
from core.units import Unit

MAX_WEAR: Final = 0.254
"""Millimeters (0.010 in) up to which a negative radius is the wear of a center path; a larger one flips the side."""

_OUTLINE_JUDGED: Final = "The programmed path is judged as the part's outline, not as a center path with a wear offset."
_WEAR_LEFT_OUT: Final = (
    "So small a radius is taken for wear: the program is judged as the path of the cutter's center, without the wear. "
    "If it is the part's outline, the cutter gouges it by half its diameter: correct the offset."
)
"""What a negative radius is taken to mean."""


@dataclass(slots=True)
class _OpenStretch:
    """A stretch of compensated moves that is not closed yet."""

    side: Side
    radius: float
    plane: Plane
    first: int
    programmed: Tape
    wear: bool
    changes: list[Change] = field(default_factory=list)


def side_of(offset: float) -> Side:
    """Return the side of the path on which a tool of this signed radius runs; -0.0 is on the right."""
    return Side.LEFT if copysign(1.0, offset) > 0.0 else Side.RIGHT


def record_programmed(tape: Tape, element: Element, plane: Plane) -> None:
    """Record an element on a tape as it is programmed in a plane."""
    target = solid(*element.end, element.end_height, plane)
    if element.turn:
        center = solid(*element.center, element.end_height, plane)
        tape.arc(target, center, element.turn, plane, element.feed, element.line, rapid=element.rapid)
    else:
        tape.straight(target, element.feed, element.line, rapid=element.rapid)


class Recorder:
    """Records the moves of programmed elements, without compensation unless a control adds it.

    `active`: compensation is in force.  `plane` and `unit` are those in force.  `leaving`: compensation is canceled,
    but the next move in the plane still belongs to the stretch.  `wear`: the radius last read is a wear.
    """

    def __init__(self, log: Log) -> None:
        self.log = log
        self.tape = Tape()
        self.plane = Plane.XY
        self.unit = Unit.MM
        self.active = False
        self.leaving = False
        self.wear = False
        self.stretches: list[Stretch] = []
        self._open: _OpenStretch | None = None

    def travel(self, element: Element) -> None:
        """Run one programmed element."""
        if element.turn:
            self.arc(element, element.end, element.center)
        else:
            self.straight(element, element.end)
        if self.leaving and element.moves:
            self.close_stretch()

    def straight(self, element: Element, end: Point, *, at_start_height: bool = False) -> None:
        """Make an element's straight move to a point of its plane, at the height of its end or still of its start."""
        target = solid(*end, element.start_height if at_start_height else element.end_height, self.plane)
        self.tape.straight(target, 0.0 if element.rapid else element.feed, element.line, rapid=element.rapid)

    def arc(self, element: Element, end: Point, center: Point) -> None:
        """Make an element's arc, or its offset, to a point of its plane.

        A full circle ends where it starts: a rounding gap between its ends would leave almost no arc.
        """
        here = self.here
        if element.start == element.end and dist(end, here) <= ON_PATH:
            end = here
        self.arc_about(element, end, center, element.turn, element.end_height)

    def arc_about(
        self, element: Element, end: Point, center: Point, turn: int, height: float, *, rapid: bool = False
    ) -> None:  # fmt: skip
        """Make any arc at an element's feed."""
        target, middle = solid(*end, height, self.plane), solid(*center, height, self.plane)
        self.tape.arc(target, middle, turn, self.plane, element.feed, element.line, rapid=rapid)

    def run_joint(self, joint: Joint, element: Element, offset: float) -> None:
        """Make the moves of a joint, from the end of one offset to the start of the next element's offset."""
        for point in joint.through:
            self.straight(element, point, at_start_height=True)
        if joint.center is not None:
            self.arc_about(element, joint.start, joint.center, -1 if offset > 0.0 else 1, element.start_height)
        elif joint.moves > len(joint.through):
            self.straight(element, joint.start, at_start_height=True)

    @property
    def here(self) -> Point:
        """The position of the axes, in the plane."""
        return flat(self.tape.last, self.plane)[:2]

    def readable_position(self, programmed: Point3) -> Point3:
        """Return the axis position that a program reads, millimeters; uncompensated, the programmed point."""
        return programmed

    def note_radius(self, radius: float, rule: str, flips: str, place: Place) -> None:
        """Note whether a radius is a wear; report a negative one with the sentence that it flips the side."""
        self.wear = -MAX_WEAR <= radius < 0.0
        if self.wear:
            self.log.warn(rule, f"{flips} {_WEAR_LEFT_OUT}", place)
        elif radius < 0.0:
            self.log.inform(rule, f"{flips} {_OUTLINE_JUDGED}", place)

    def open_stretch(self, offset: float, element: Element) -> None:
        """Begin a stretch of compensated moves with this element; moves already on the tape come before it."""
        self.close_stretch()
        start = Tape(solid(element.start[0], element.start[1], element.start_height, self.plane))
        self._open = _OpenStretch(side_of(offset), abs(offset), self.plane, len(self.tape) - 1, start, self.wear)

    @property
    def stretch_open(self) -> bool:
        """True while compensated moves are being collected."""
        return self._open is not None

    def change_stretch(self, offset: float, before: int, across: int) -> None:
        """Give the stretch this signed radius from the element noted last on.

        `before` moves with the old ones are yet to be made up to there, and then `across` moves to the new ones.
        """
        stretch = self._open
        if stretch is None:
            return
        row = len(self.tape) - 1 + before
        now, side, radius = stretch.changes[-1] if stretch.changes else stretch, side_of(offset), abs(offset)
        if (now.side, now.radius) != (side, radius):
            stretch.changes.append(Change(len(stretch.programmed) - 1, row, row + across, side, radius))

    def begin_stretch(self, offset: float) -> None:
        """Give the stretch this signed radius from its first element on."""
        if self._open is not None:
            self._open.side, self._open.radius, self._open.wear = side_of(offset), abs(offset), self.wear

    def note(self, element: Element) -> None:
        """Record an element programmed under compensation."""
        if self._open is not None:
            record_programmed(self._open.programmed, element, self.plane)

    def leave(self) -> None:
        """Note that compensation is canceled; the next motion in the plane still belongs to the stretch."""
        self.leaving = self._open is not None

    def close_stretch(self) -> None:
        """End the open stretch, if any, and keep it."""
        opened, self._open, self.leaving = self._open, None, False
        if opened is None:
            return
        stretch = Stretch(
            opened.side,
            opened.radius,
            opened.plane,
            opened.programmed.moves(),
            entry=1,
            exit=0,
            first=opened.first,
            last=len(self.tape),
            changes=tuple(opened.changes),
            wear=opened.wear,
        )
        self.stretches.append(stretch)
