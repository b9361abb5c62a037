"""The element queue holds each offset element until the next one is known, and joins the two by the corner rules.

`OneMoveQueue` is LinuxCNC's queue; RosettaCNC's entry `normal` follows it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import dist, hypot, tau
from typing import Final

from core.controls.compensation.corner_rules import CornerKind, CornerRules, Inside, Joint, join
from core.controls.compensation.elements import Element, element_sweep, fits, offset_end, runs_back, sweep
from core.controls.compensation.recorder import Recorder
from core.controls.control_run import Log, Place
from core.controls.moves import Plane, Point3, flat, solid
from core.geometry.piece import Point
from core.units import Unit


class ElementQueue(Recorder):
    """Joins offset elements; `offset` is the tool radius in millimeters, positive with the tool on the left.

    `held` waits for the next element and starts at `start`; `standing` are moves along the tool axis that wait with it.
    """

    rules = CornerRules()

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.offset = 0.0
        self.held: Element | None = None
        self.start: Point | None = None
        self.standing: list[Element] = []
        self.elements = 0

    def joint(self, first: Element, second: Element) -> Joint:
        """Return this control's joint of two elements."""
        return join(first, second, self.offset, self.rules)

    def backwards(self, element: Element) -> None:
        """Handle a trimmed element that would run against its programmed direction; by default do nothing."""

    def feed_of(self, element: Element) -> float:
        """Return the feed at which an offset element runs."""
        return element.feed

    def hold(self, element: Element) -> None:
        """Take in the next element, and run the one before it, whose end is now known."""
        self.note(element)
        held = self.held
        if not element.moves and held is not None:
            self.standing.append(element)
            return
        if held is not None:
            joint = self.joint(held, element)
            self.release(held, joint.end)
            self.run_joint(joint, element, self.offset)
            self.start = joint.start
        self.held = element
        self.elements += 1

    def release(self, held: Element, end: Point) -> None:
        """Run the held element to a point, and the waiting moves along the tool axis there."""
        if self.start is not None and runs_back(held, self.start, end):
            self.backwards(held)
        self.run_held(held, end)

    def run_held(self, held: Element, end: Point) -> None:
        """Run the held element to a point without checking its direction."""
        standing, self.held, self.standing = self.standing, None, []
        feed = self.feed_of(held)
        held = held if feed == held.feed else held._replace(feed=feed)
        if held.turn:
            self.arc(held, end, held.center)
        else:
            self.straight(held, end)
        for element in standing:
            self.straight(element, end)

    def release_at_end(self) -> None:
        """Run the held element to the offset point at its end."""
        if self.held is not None:
            self.release(self.held, offset_end(self.held, self.offset))
        self.start = None


NOSE_DIRECTIONS: Final[Mapping[int, tuple[int, int]]] = {
    1: (1, -1),
    2: (-1, -1),
    3: (-1, 1),
    4: (1, 1),
    5: (1, 0),
    6: (0, -1),
    7: (-1, 0),
    8: (0, 1),
}
"""Direction in Z and X from the nose's center to the controlled point, in radii, by lathe orientation."""

NO_FIT: Final = "The cutter does not fit into this corner without gouging. Use a smaller cutter or open the corner."

ARC_RUN_AT_STOP: Final = (
    "The stop let the arc before this block run to its end, into this inside corner. Move the stop."
)


@dataclass(frozen=True, slots=True)
class AlarmCodes:
    """A control's rule ids for the faults that `OneMoveQueue` detects."""

    entry: str
    arc_radius: str
    concave: str
    arc_exit: str


class OneMoveQueue(ElementQueue):
    """The queue of LinuxCNC: it holds one move of the plane and the moves along the tool axis after it.

    The first move ends at its own offset point.  `first`: it has yet to come.  `ran`: the held move has run at a
    program stop, and only its corner with the next move has yet to come.
    """

    rules = CornerRules(tangent=0.05, reversal=0.05, inside=Inside.BY_SIDE, hooks=True, rapid_straight=True)
    alarms = AlarmCodes("N-GOUGE", "N-ARCRADIUS", "N-CONCAVE", "N-ARCEXIT")

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.first = True
        self.ran = False
        self.no_arc = False
        self.nose: Point = (0.0, 0.0)

    def turn_on(self, offset: float, orientation: int = 0) -> None:
        """Start compensation with the next move; a lathe tool's orientation shifts moves by the nose radius."""
        self.offset = offset
        direction = NOSE_DIRECTIONS.get(orientation, (0, 0)) if self.plane is Plane.ZX else (0, 0)
        self.nose = (direction[0] * abs(offset), direction[1] * abs(offset))
        self.active = self.first = True

    def compensation_off(self, place: Place) -> None:
        """G40: run the held move to its offset point."""
        if self.active and self.offset and not self.first:
            self._run_out(place)
            self.no_arc = True
            self.leave()
        self.active, self.first = False, True

    def end_of_program(self) -> None:
        """End of the program: run the held move to its offset point."""
        if self.held is not None:
            self._run_out((self.standing or [self.held])[-1])

    def _run_out(self, place: Place) -> None:
        if self.held is not None:
            end = offset_end(self.held, self.offset)
            self._check(self.held, end, place)
            self.run_held(self.held, end)

    def run_out_at_stop(self) -> None:
        """Program stop: run the held move to its own offset point, which no later corner changes."""
        held = self.held
        if held is None:
            return
        self._run_out(held)
        self.held, self.start, self.ran = held, None, True

    def run_held(self, held: Element, end: Point) -> None:
        """Run the held move to a point without checking its direction; if it ran at a stop, do not run it again."""
        if not self.ran:
            super().run_held(held, end)
            return
        standing, self.held, self.standing, self.ran = self.standing, None, [], False
        for element in standing:
            self.straight(element, end)

    def straight(self, element: Element, end: Point, *, at_start_height: bool = False) -> None:
        """Make a straight move of a lathe tool's controlled point."""
        super().straight(element, self._controlled(end), at_start_height=at_start_height)

    def arc_about(
        self, element: Element, end: Point, center: Point, turn: int, height: float, *, rapid: bool = False
    ) -> None:  # fmt: skip
        """Make an arc of a lathe tool's controlled point."""
        super().arc_about(element, self._controlled(end), self._controlled(center), turn, height, rapid=rapid)

    def _controlled(self, point: Point) -> Point:
        return (point[0] + self.nose[0], point[1] + self.nose[1]) if self.active else point

    def readable_position(self, programmed: Point3) -> Point3:
        """Return where the held move would end if the next one did not change it; else the programmed point."""
        if not self.active or self.held is None:
            return programmed
        first, second = offset_end(self.held, self.offset)
        return solid(first, second, flat(programmed, self.plane)[2], self.plane)

    def travel(self, element: Element) -> None:
        """Run one element: by itself, as the entry, or joined to the held one."""
        if element.turn and self.no_arc:
            text = "The first move after G40 is straight; write a line before the arc."
            self.log.stop(self.alarms.arc_exit, text, element)
        self.no_arc = False
        if not self.active or not self.offset:
            super().travel(element)
        elif self.first:
            self._enter(element)
        elif element.moves and self.held is not None:
            self._follow(self.held, element)
        else:
            self.note(element)
            self.standing.append(element)

    def _enter(self, element: Element) -> None:
        """Take in the first move, which must be longer than the radius and ends at its own offset point."""
        length = hypot(element.end[0] - element.start[0], element.end[1] - element.start[1])
        if length <= abs(self.offset):
            text = "The entry move is {0} long; it must be longer than the radius {1}."
            self.log.stop(self.alarms.entry, text, element, lengths=(length, abs(self.offset)))
        self._check_radius(element)
        self.open_stretch(self.offset, element)
        self.note(element)
        if element.turn and self.nose != (0.0, 0.0):
            self.straight(element, element.start, at_start_height=True)
        self.start = None if element.turn else element.start
        self.held, self.standing, self.first = self._as_entry(element), [], False

    def _as_entry(self, element: Element) -> Element:
        """Return the entry as it runs; LinuxCNC does not check whether a later trim turns it around."""
        if not element.turn:
            return element._replace(start_direction=(0.0, 0.0))
        return element._replace(start=element.end, center=self._entry_center(element))

    def _entry_center(self, element: Element) -> Point:
        """Return the center of the entry arc: to the offset point at its end, with the programmed tangent there."""
        (sx, sy), (ex, ey), (cx, cy) = element.start, offset_end(element, self.offset), element.center
        half = hypot(sx - ex, sy - ey) / 2
        reach = hypot(cx - ex, cy - ey) or 1.0
        inward = ((cx - ex) / reach, (cy - ey) / reach)
        lean = ((sx - ex) * inward[0] + (sy - ey) * inward[1]) / (2 * half)
        if abs(lean) < 1e-6:
            self._too_small(element)
        return ex + inward[0] * half / lean, ey + inward[1] * half / lean

    def _check_radius(self, element: Element) -> None:
        # the interpreter takes the radius at the arc's end, which may differ
        at_end = dist(element.end, element.center) - element.turn * self.offset
        if element.turn and (at_end <= 0.0 or not fits(element, self.offset)):
            self._too_small(element)

    def _too_small(self, element: Element) -> None:
        text = "The arc radius {0} must be larger than the cutter radius {1}. Use a smaller cutter or a larger arc."
        self.log.stop(self.alarms.arc_radius, text, element, lengths=(element.radius, abs(self.offset)))

    def _follow(self, held: Element, element: Element) -> None:
        """Join a move to the held one, whose direction is checked inside, and outside before a line."""
        self._check_radius(element)
        joint = self.joint(held, element)
        if self.ran and held.turn and joint.corner is CornerKind.INSIDE:
            self.log.stop(self.alarms.concave, ARC_RUN_AT_STOP, element, at=element.start)
        if joint.missed:
            self.log.stop(self.alarms.concave, NO_FIT, element, at=element.start)
        if joint.corner is CornerKind.INSIDE or (joint.corner is CornerKind.OUTSIDE and not element.turn):
            self._check(held, joint.end, element)
        unchecked = self.ran and not self.standing and joint.corner is CornerKind.INSIDE
        self.run_held(held, joint.end)
        self.run_joint(joint, element, self.offset)
        self.note(element)
        self.held, self.start = element, None if unchecked else joint.start

    def _check(self, held: Element, end: Point, place: Place) -> None:
        """Stop the program if the held move would run backwards, or around its arc nearly once more."""
        if self.start is None:
            return
        if held.turn:
            traveled = sweep(self.start, end, held.center, held.turn) or tau
            back = traveled > element_sweep(held) + (0.001 if self.unit is Unit.IN else 0.0254)
        else:
            direction = held.start_direction
            back = (end[0] - self.start[0]) * direction[0] + (end[1] - self.start[1]) * direction[1] < 0.0
        if back:
            self.log.stop(self.alarms.concave, NO_FIT, place, at=held.end)
