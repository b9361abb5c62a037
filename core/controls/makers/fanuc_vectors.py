"""This module makes the vectors of cutter compensation C as Fanuc and Haas mills do, from start-up to cancel.

Every corner has one or more vectors, given here by their end points.  The element before the corner ends at the first
one, and moves across the plane follow there; the element after it runs over the others and starts at the last one.  An
element runs only when both its ends are known, because only then can the control see whether its vectors cross.  If
they do, it drops the pair of vectors nearest to each other, then the next pair, before it gives an alarm.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import copysign, hypot
from typing import Final

from core.controls.compensation import corner_rules, elements
from core.controls.compensation.corner_rules import SAME_POINT, CornerKind, CornerRules, Joint, Outside
from core.controls.compensation.elements import SAME_DIRECTION, Element
from core.controls.compensation.recorder import Recorder
from core.controls.control_run import Log
from core.controls.moves import solid
from core.geometry.piece import Point

POINT_ARC: Final = 1e-6
"""Millimeters: an inside arc whose radius differs from the tool's by at most this is a point of the center path."""


@dataclass(frozen=True, slots=True)
class VectorRules:
    """The rules that parameters and the kind of control set."""

    type_a: bool = True
    """The start-up and the cancel go straight."""
    at_once: bool = False
    """A G41 or G40 without movement moves the tool by itself (type C)."""
    outside: Outside = Outside.LINES
    """How outside corners are rounded."""
    blocks_read: int = 3
    """Two more than the blocks without movement that the control looks across."""
    checks: bool = True
    """Crossing vectors are an alarm."""
    point_arcs: bool = True
    """An inside arc of the tool's own radius is a point of the path, not an alarm."""


@dataclass(frozen=True, slots=True)
class Alarms:
    """A control's alarm numbers for the faults that Fanuc and Haas mills share."""

    arc: str
    arc_off: str
    no_meeting: str
    crossing: str
    point: str


@dataclass(slots=True)
class Held:
    """An element whose end is not known yet; `standing` are moves across the plane that wait with it.

    `vectors` are the points at its start; the tool stands at the first one.  `center` is the center of the arc to the
    last one, None for straight moves.  `offset` applies at its end.  `startup`: it turns compensation on.
    `straightened`: it has lost vectors, so an arc runs as a line.
    """

    element: Element
    vectors: list[Point]
    offset: float
    startup: bool = False
    center: Point | None = None
    straightened: bool = False
    standing: list[Element] = field(default_factory=list)


class VectorQueue(Recorder):
    """Compensation C of a run.

    `coming` is the signed radius for the next corner, positive with the tool on the left.  `held` waits for its end; if
    it is None under compensation, the next element starts where the tool stands.  `motionless` counts blocks without
    movement since `held`.  `round_corner` is the vector of a pending G39, (0, 0) if it has none.
    """

    alarms: Alarms

    def __init__(self, log: Log, rules: VectorRules) -> None:
        super().__init__(log)
        self.vector_rules = rules
        self.rules = CornerRules(outside=rules.outside)
        self.held: Held | None = None
        self.before: tuple[int, Held] | None = None
        self.coming = 0.0
        self.motionless = 0
        self.round_corner: Point | None = None

    # what elements do

    def start_up(self, element: Element) -> None:
        """Hold the first movement under G41 or G42; the next element determines its end."""
        if element.turn:
            self._no_arc(element, self.alarms.arc)
        self.active, self.motionless, self.before = True, 0, None
        self.open_stretch(self.coming, element)
        self.note(element)
        self.held = Held(element, [self.here], self.coming, startup=True)

    def _no_arc(self, element: Element, code: str) -> None:
        self.log.stop(code, "Compensation cannot start or end in G2 or G3. Write G1 and a straight move.", element)

    def across(self, element: Element) -> None:
        """Take in a move across the plane, which runs at the end of the element before it."""
        self.note(element)
        if self.held is None:
            self.straight(element, self.here)
        else:
            self.held.standing.append(element)

    def compensate(self, element: Element) -> None:
        """Hold the next element in the plane, and run the one before it, whose end is now known."""
        self._check_center(element)
        self.motionless = 0
        held = self.held
        if held is None:
            self._go_on(element)
            return
        start = copysign(held.offset, self.coming)
        if element.turn and abs(self.coming) != abs(start):
            text = "The offset changes in an arc, which cutcomp does not follow. Write the new D in a straight move."
            self.log.stop("FN-DARC", text, element)
        joint = self._corner(held, element, start)
        vectors = _points(joint, element)
        self._release(held, vectors)
        self._follow(element, vectors, joint.center if len(vectors) > 1 else None)
        least = -POINT_ARC if self.vector_rules.point_arcs else POINT_ARC
        if self.vector_rules.checks and element.turn and elements.offset_radius(element, start) < least:
            # the alarm comes as soon as the arc is read
            what = "smaller" if self.vector_rules.point_arcs else "no larger"
            text = f"The arc radius {{0}} is {what} than the cutter radius {{1}}. Use a smaller cutter."
            lengths = (element.radius, abs(self.coming))
            self.log.stop(self.alarms.crossing, text, element, lengths=lengths)

    def _check_center(self, element: Element) -> None:
        ends = (element.start, element.end) if element.turn else ()
        if any(hypot(x - element.center[0], y - element.center[1]) < SAME_DIRECTION for x, y in ends):
            self.log.stop(self.alarms.point, "The arc starts or ends at its center. Correct I and J.", element)

    def _go_on(self, element: Element) -> None:
        """Hold an element after a square end: it starts there and runs at a slant to its own end."""
        self.note(element)
        vectors = [self.here]
        if element.turn:
            text = "The arc after a square end begins with a straight move to its start. cutcomp assumes this move."
            self.log.inform("FN-N2-ARC", text, element)
            vectors.append(elements.offset_start(element, self.coming))
        self.before = None
        self.held = Held(element, vectors, self.coming)

    def _corner(self, held: Held, element: Element, start: float) -> Joint:
        first, offset = held.element, held.offset
        rounded, self.round_corner = self.round_corner, None
        if rounded is not None:
            return self._rounded(first, element, offset, rounded)
        if held.startup and not first.moves:
            return Joint(elements.offset_start(element, start), elements.offset_start(element, start))
        if held.startup:
            return corner_rules.entry_joint(first, element, start, self.rules.outside, direct=self.vector_rules.type_a)
        if start != offset:
            text = "The side changes here. cutcomp takes the way across from other makers' manuals."
            self.log.inform("FN-G1", text, element)
            return corner_rules.offset_change_joint(first, element, offset, start)
        return self._joined(first, element, offset)

    def _joined(self, first: Element, second: Element, offset: float) -> Joint:
        """Return the joint of a corner with the same radius before and after it.

        The offset of an arc no larger than the tool is a point or runs backwards, and is met beyond the arc's center.
        """
        beyond = _reaches_center(first, offset) or _reaches_center(second, offset)
        if beyond and corner_rules.corner_kind(first, second, offset, self.rules) is CornerKind.INSIDE:
            point = elements.meeting(first, second, offset, beyond_center=True)
            return self._without_meeting(first, second, offset) if point is None else Joint(point, point)
        joint = corner_rules.join(first, second, offset, self.rules)
        return self._without_meeting(first, second, offset) if joint.missed else joint

    def _without_meeting(self, first: Element, second: Element, offset: float) -> Joint:
        if corner_rules.inward_turn(first, second, offset) >= corner_rules.MAX_TANGENT_ANGLE:
            text = "The offsets of this inside corner do not meet. Use a smaller cutter or open the corner."
            self.log.stop(self.alarms.no_meeting, text, second, at=first.end)
        return Joint(elements.offset_end(first, offset), elements.offset_start(second, offset))

    def _rounded(self, first: Element, second: Element, offset: float, vector: Point) -> Joint:
        """Return the joint of G39: an arc about the corner, to the start of the next element or square to a vector."""
        start = elements.offset_start(second, offset)
        if vector != (0.0, 0.0):
            size = hypot(*vector)
            start = elements.offset_point(second.start, (vector[0] / size, vector[1] / size), offset)
        return Joint(elements.offset_end(first, offset), start, center=second.start, corner=CornerKind.OUTSIDE)

    def _follow(self, element: Element, vectors: list[Point], center: Point | None) -> None:
        """Hold the next element; from its start on, the stretch may have another side or radius."""
        last = self.held
        self.note(element)
        if last is not None and last.startup:
            self.begin_stretch(last.offset)
        elif last is not None:
            # a smaller radius applies from the slanting element on, a larger one only after it
            radius = min(abs(last.offset), abs(self.coming))
            self.change_stretch(copysign(radius, self.coming), 0, len(vectors) - 1)
        self.held = Held(element, vectors, self.coming, center=center)

    # how elements run

    def _release(self, held: Held, ahead: list[Point]) -> None:
        """Run an element from the last vector at its start to the first one at its end, and the moves across there."""
        if not held.startup:
            self._uncross(held, ahead)
        self.before = (len(self.tape), held)
        self._run(held, ahead[0])

    def _run(self, held: Held, end: Point) -> None:
        self._run_around(held)
        self._run_element(held, end)
        for standing in held.standing:
            self.straight(standing, self.here)

    def _run_around(self, held: Held) -> None:
        *between, start = held.vectors[1:] or held.vectors
        for point in between:
            self._line(held.element, point, at_start_height=True)
        if held.center is not None:
            # a rapid goes around the corner as a rapid
            element, turn = held.element, -1 if held.offset > 0.0 else 1
            self.arc_about(element, start, held.center, turn, element.start_height, rapid=element.rapid)
        else:
            self._line(held.element, start, at_start_height=True)

    def _run_element(self, held: Held, end: Point) -> None:
        element, start = held.element, held.vectors[-1]
        radius = elements.offset_radius(element, held.offset)
        vanished = element.start != element.end and hypot(start[0] - end[0], start[1] - end[1]) < SAME_POINT
        if not element.turn or held.straightened or vanished or abs(radius) <= POINT_ARC:
            self._line(element, end)
            return
        inside = element.turn * held.offset > 0.0
        feed = element.feed * abs(radius) / element.radius if inside else element.feed
        self.arc(element._replace(feed=feed), end, element.center)

    def _line(self, element: Element, end: Point, *, at_start_height: bool = False) -> None:
        """Make a straight move, unless the tool is there already."""
        height = element.start_height if at_start_height else element.end_height
        target, now = solid(*end, height, self.plane), self.tape.last
        if any(abs(a - b) > SAME_POINT for a, b in zip(target, now, strict=True)):
            self.straight(element, end, at_start_height=at_start_height)

    # interference

    def _uncross(self, held: Held, ahead: list[Point]) -> None:
        """Drop crossing vectors, from the middle of the element outward; stop with an alarm if none can be dropped."""
        if not self.vector_rules.checks:
            return
        dropped = False
        while _crosses(held.element, held.vectors[-1], ahead[0]):
            at_start, at_end = len(held.vectors) > 1, len(ahead) > 1
            if not at_start and not at_end:
                what = "inside this arc" if held.element.turn else "along this move"
                text = f"The tool does not fit {what}: its path would run backwards. Use a smaller cutter."
                self.log.stop(self.alarms.crossing, text, held.element, at=held.element.end)
            if at_start:
                held.vectors.pop()
                held.center = None
            held.straightened = True
            if at_end:
                ahead.pop(0)
            dropped = True
        if dropped:
            text = "Vectors cross here; the control drops some and shortens the way around the corner."
            self.log.warn("FN-VECTOR", text, held.element)

    # square ends and the cancel

    def end_square(self) -> None:
        """Run the held element to its square end; the next element starts there."""
        if self.held is not None:
            self.end_at(elements.offset_end(self.held.element, self.held.offset))

    def end_at(self, point: Point) -> None:
        """Run the held element to a point."""
        held, self.held = self.held, None
        if held is not None:
            self._release(held, [point])

    def cancel_with(self, element: Element, vector: Point | None) -> None:
        """Run a straight move that turns compensation off; a vector of I, J, K shifts the last element's end."""
        if element.turn:
            self._no_arc(element, self.alarms.arc_off)
        if self.held is not None:
            self._run_to_cancel(self.held, element, vector)
        self.stop_compensation()
        super().travel(element)

    def _run_to_cancel(self, held: Held, element: Element, vector: Point | None) -> None:
        if vector is not None:
            self.end_at(vector_meeting(held.element, vector, held.offset))
            return
        rounded, self.round_corner = self.round_corner, None
        if rounded is not None:
            joint = self._rounded(held.element, element, held.offset, rounded)
        elif self.vector_rules.type_a or held.startup:
            self.end_square()
            return
        else:
            joint = corner_rules.exit_joint(held.element, element, held.offset, self.rules.outside)
        vectors = _points(joint, None)
        if not held.element.turn and joint.center is None and len(vectors) > 1:
            vectors.pop(0)
        self._release(held, vectors)
        self._run_around(Held(element, vectors, held.offset, center=joint.center if len(vectors) > 1 else None))

    def stop_compensation(self) -> None:
        """Turn compensation off; the next move in the plane still belongs to the stretch."""
        self.active, self.held, self.before, self.round_corner = False, None, None, None
        self.leave()

    def leave_straight(self) -> None:
        """Let the last element turn compensation off, as at a change of origin."""
        last, self.held = self.held, None
        if last is None:
            return
        if self.before is not None:
            rows, before = self.before
            self.tape.cut(rows)
            self._run(before, elements.offset_end(before.element, before.offset))
        for element in (last.element, *last.standing):
            self.straight(element, last.element.end)


def _points(joint: Joint, element: Element | None) -> list[Point]:
    """Return the vectors of a joint, without the last one if the move to it only extends the line that follows."""
    points = [joint.end]
    for point in (*joint.through, joint.start):
        if hypot(point[0] - points[-1][0], point[1] - points[-1][1]) > SAME_POINT:
            points.append(point)
    if element is not None and not element.turn and len(points) > 1 and joint.center is None:
        (ax, ay), (bx, by), direction = points[-2], points[-1], element.start_direction
        if (
            abs((bx - ax) * direction[1] - (by - ay) * direction[0]) < SAME_POINT
            and (bx - ax) * direction[0] + (by - ay) * direction[1] > 0.0
        ):
            points.pop()
    return points


def _reaches_center(element: Element, offset: float) -> bool:
    """True if an arc's offset is a point or lies beyond its center."""
    return element.turn != 0 and elements.offset_radius(element, offset) <= POINT_ARC


def _crosses(element: Element, start: Point, end: Point) -> bool:
    """True if an element from one vector to another runs against its programmed direction."""
    at_one_point = element.turn != 0 and hypot(start[0] - end[0], start[1] - end[1]) < SAME_POINT
    return not at_one_point and elements.runs_back(element, start, end)


def vector_meeting(last: Element, vector: Point, offset: float) -> Point:
    """Return where the last element's offset meets that of the vector through its end, else the square end."""
    size = hypot(*vector)
    if not size:
        return elements.offset_end(last, offset)
    towards = (last.end[0] + vector[0] / size, last.end[1] + vector[1] / size)
    line = elements.line_element(last.end, towards)
    return elements.meeting(last, line, offset) or elements.offset_end(last, offset)
