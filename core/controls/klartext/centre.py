"""The tool centre's path: Klartext steps offset by the tool radius, joined at their corners.

Outside corners get an arc about the corner, inside corners the meeting of the two offsets.  One contour element is
held back until the next one is known.  A contour's first point and its last are reached square to it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, pi, tau
from typing import Final, NoReturn

from core.controls import corners
from core.controls.corners import Element
from core.controls.klartext import leads
from core.controls.klartext.leads import Form
from core.controls.klartext.record import Record
from core.controls.klartext.steps import Corner, Role, Speed, Step
from core.controls.report import Log
from core.finding import Severity
from core.geometry.piece import Point
from core.tolerance import JOINED

NO_CONTOUR: Final = "No contour element follows the start of compensation; write the contour before its end."
DEPTH_FIRST: Final = "At this outside corner the tool axis is taken to move before the arc about the corner."
INSIDE_CIRCLE: Final = "Here stands PS or PN inside the circle of radius {0} of the lead; move it out or shorten R."


@dataclass(slots=True)
class Centre:
    """Takes steps in their order and records the centre's moves.

    `held` is the contour element whose end is not known yet, `begin` the point at which its offset starts;
    `entry` a start of compensation that waits for its first element; `depths` tool-axis moves that wait with either.
    """

    log: Log
    record: Record = field(default_factory=Record)
    held: Step | None = None
    begin: Point = (0.0, 0.0)
    entry: Step | None = None
    depths: list[Step] = field(default_factory=list)

    def push(self, step: Step) -> None:
        """The next step; raises the alarm where the control would stop."""
        match step.role:
            case Role.CONTOUR:
                self._contour(step)
            case Role.FREE:
                if self.entry:  # an approach without compensation
                    self._arrive(self.entry, step.element)
                    self.record.close()
                self.record.plain(step, step.element.end)
            case Role.DEPTH if self.held or self.entry:
                self.depths.append(step)
            case Role.DEPTH:
                self.record.sink(step)
                self.record.remember(step)
            case Role.ENTRY | Role.APPROACH:
                self._enter(step)
            case Role.EXIT | Role.DEPARTURE:
                self._leave(step)

    def finish(self) -> None:
        """The program ends: the last element ends square to the contour, compensated or not."""
        if self.entry:
            self._no_contour(self.entry)
        self._run_out()
        self.record.close()

    def give_up(self) -> None:
        """The control has stopped: what is recorded so far stays."""
        self.record.close()

    def _enter(self, step: Step) -> None:
        if self.entry:
            self._no_contour(self.entry)
        self._run_out()  # an approach under compensation connects two contours
        self.record.close()
        self.entry = step
        self.record.open(step)

    def _leave(self, step: Step) -> None:
        if self.entry:
            self._no_contour(self.entry)
        self._run_out()
        if step.lead is None:
            self.record.plain(step, step.element.end)
        else:
            self._depart(step, step.lead)
        self.record.remember(step)
        self.record.close()

    def _no_contour(self, entry: Step) -> NoReturn:
        self.log.stop("HE7", NO_CONTOUR, entry.element.line, entry.element.column)

    def _arrive(self, entry: Step, first: Element) -> Point:
        """Run the entry to the point square to the first element's start; that point."""
        goal = corners.square_start(first, entry.offset)
        if entry.lead is None:
            self.record.plain(entry, goal)
        else:
            self._approach(entry, entry.lead, goal, first.leaving)
        self.entry = None
        self._sink_waiting()
        return goal

    def _approach(self, step: Step, lead: leads.Lead, goal: Point, way: Point) -> None:
        x, y, height = self.record.at(step)
        curve = leads.approach(lead, (x, y), goal, way, step.hand)
        if curve is None:
            self._inside_circle(step, lead)
        depth = step.element.high
        if lead.form is Form.LCT:
            self.record.line(curve.point, depth, step)
        else:
            self.record.line(curve.point, height, step, lead=True)
            if depth != height:
                self.record.line(curve.point, depth, step, lead=True)
        self._curve(goal, depth, curve, step)

    def _depart(self, step: Step, lead: leads.Lead) -> None:
        x, y, height = self.record.at(step)
        curve = leads.departure(lead, (x, y), step.element.end, step.element.leaving, step.hand)
        if curve is None:
            self._inside_circle(step, lead)
        self._curve(curve.point, height, curve, step)
        if lead.form is Form.LCT:
            self.record.line(step.element.end, height, step)
        if step.element.high != height:
            self.record.sink(step)

    def _curve(self, end: Point, height: float, curve: leads.Curve, step: Step) -> None:
        if curve.turn:
            self.record.arc(end, height, curve.centre, curve.turn, step)
        elif curve.point != end or self.record.at(step)[:2] != end:
            self.record.line(end, height, step)

    def _inside_circle(self, step: Step, lead: leads.Lead) -> NoReturn:
        line, column = step.element.line, step.element.column
        self.log.stop("HE5", INSIDE_CIRCLE, line, column, lengths=(lead.radius,))

    def _contour(self, step: Step) -> None:
        element = step.element
        if element.turn and corners.offset_radius(element, step.offset) <= JOINED:
            why = "the tool of radius {0} cannot run inside this arc of radius {1}"
            self._too_large(element, why, abs(step.offset), element.radius)
        if self.entry:
            begin = self._arrive(self.entry, element)
        elif self.held:
            begin = self._corner(self.held, step)
        else:
            begin = corners.square_start(element, step.offset)
        self.held, self.begin = step, begin

    def _corner(self, before: Step, after: Step) -> Point:
        """Finish the held element at its corner with the next; the point at which that one's offset starts."""
        first, second, offset = before.element, after.element, before.offset
        end, begin = corners.square_end(first, offset), corners.square_start(second, offset)
        if hypot(end[0] - begin[0], end[1] - begin[1]) <= JOINED:
            self._finish(before, end)
            return end
        match is_inside(first, second, offset), before.corner:
            case (True, Corner.M98):
                self._finish(before, end)
                self.record.line(begin, first.high, before)
            case (False, Corner.PLAIN | Corner.M98):
                if self.depths:
                    line, column = self.depths[0].element.line, self.depths[0].element.column
                    self.log.tell(Severity.INFO, "INTERPRETED", DEPTH_FIRST, line, column)
                self._finish(before, end)
                self.record.arc(begin, self.record.at(before)[2], first.end, -1 if offset > 0.0 else 1, before)
            case (inside, _):
                begin = self._meeting(first, second, offset, inside=inside)
                self._finish(before, begin)
        return begin

    def _meeting(self, first: Element, second: Element, offset: float, *, inside: bool) -> Point:
        meeting = corners.meeting(ending(first), second, offset)
        end, begin = corners.square_end(first, offset), corners.square_start(second, offset)
        if meeting is None or (inside and min(advance(first, meeting, end), advance(second, begin, meeting)) < -JOINED):
            self._too_large(second, "the tool of radius {0} cannot come into the corner before this block", abs(offset))
        return meeting

    def _finish(self, step: Step, end: Point) -> None:
        """Record the held element, now that its end is known."""
        element = step.element
        left = remaining(element, self.begin, end, step.offset)
        if left < -JOINED:
            self._too_large(element, "between its neighbours nothing is left of this block", abs(step.offset))
        if element.turn and left > JOINED:
            if left >= tau * corners.offset_radius(element, step.offset) - JOINED:
                end = self.begin
            self.record.arc(end, element.high, element.centre, element.turn, step, _arc_feed(step))
        else:
            self.record.line(end, element.high, step)
        self.record.remember(step)
        self.held = None
        self._sink_waiting()

    def _run_out(self) -> None:
        if self.held:
            self._finish(self.held, corners.square_end(self.held.element, self.held.offset))

    def _sink_waiting(self) -> None:
        for step in self.depths:
            self.record.sink(step)
            self.record.remember(step)
        self.depths.clear()

    def _too_large(self, element: Element, why: str, *lengths: float) -> NoReturn:
        text = f"Tool radius too large: {why}; take a smaller tool or open the contour."
        self.log.stop("HE3", text, element.line, element.column, lengths=lengths)


def is_inside(first: Element, second: Element, offset: float) -> bool:
    """Does the path turn towards the tool?  An exact reversal does not, whatever sign its half turn has."""
    (ax, ay), (bx, by) = first.arriving, second.leaving
    back = hypot(ax + bx, ay + by) <= corners.WHOLE
    return not back and corners.turning(first, second) * offset > 0.0


def ending(element: Element) -> Element:
    """The element as it is at its end: an arc's radius there may differ a little from that at its start."""
    return element._replace(start=element.end) if element.turn else element


def advance(element: Element, start: Point, end: Point) -> float:
    """Millimetres along an element from one point of its offset to another, negative backwards, at most half an arc."""
    if not element.turn:
        way = element.leaving
        return (end[0] - start[0]) * way[0] + (end[1] - start[1]) * way[1]
    angle = corners.sweep(start, end, element.centre, element.turn)
    return (angle - tau if angle > pi else angle) * hypot(start[0] - element.centre[0], start[1] - element.centre[1])


def remaining(element: Element, begin: Point, end: Point, offset: float) -> float:
    """Millimetres left of an element's offset between the points its corners trim it to; negative if they cross."""
    if not element.turn:
        return advance(element, begin, end)
    whole = corners.element_sweep(element) * corners.offset_radius(element, offset)
    first, last = corners.square_start(element, offset), corners.square_end(element, offset)
    return whole - advance(element, first, begin) - advance(element, end, last)


def _arc_feed(step: Step) -> float:
    element = step.element
    share = corners.offset_radius(element, step.offset) / element.radius
    if step.speed is Speed.EDGE or (step.speed is Speed.INSIDE and share < 1.0):
        return element.feed * share
    return element.feed
