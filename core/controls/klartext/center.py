"""The tool center's path: Klartext steps offset by the tool radius, joined at their corners.

Outside corners get an arc about the corner, inside corners the meeting of the two offsets.  One contour element is
held back until the next one is known.  A contour's first point and its last are reached square to it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, tau
from typing import Final, NoReturn

from core.controls.compensation import corners
from core.controls.compensation.corners import Element
from core.controls.control_run import Log
from core.controls.klartext import leads
from core.controls.klartext.ahead import Ahead, Run, Unreached, path_ahead
from core.controls.klartext.leads import Form
from core.controls.klartext.record import Record
from core.controls.klartext.steps import Corner, Role, Speed, Step
from core.controls.klartext.trims import advance, ending, is_inside, remaining
from core.finding import Severity
from core.geometry.piece import Point
from core.tolerance import JOINED

NO_CONTOUR: Final = "No contour element follows the start of compensation; write the contour before its end."
DEPTH_FIRST: Final = "At this outside corner the tool axis is taken to move before the arc about the corner."
NOT_AHEAD: Final = (
    "Under M120 only moves in the working plane without M97 and M98 are worked out here; end it with LA0."
)
LEFT_OUT: Final = "M120 leaves this block out: the tool of radius {0} does not reach it."
ROUNDED: Final = 1e-11
"""Millimeters by which rounding moves a line meters from the origin; its meeting with one that hardly turns, by this
over the angle in radians."""
INSIDE_CIRCLE: Final = "Here stands PS or PN inside the circle of radius {0} of the lead; move it out or shorten R."


@dataclass(slots=True)
class Center:
    """Takes steps in their order and records the center's moves.

    `held` is the contour element whose end is not known yet, `begin` the point at which its offset starts;
    `entry` a start of compensation that waits for its first element; `depths` tool-axis moves that wait with either.
    `ahead` are the elements that M120 looks over, `stands` where the path is on the first one's offset already.
    """

    log: Log
    record: Record = field(default_factory=Record)
    held: Step | None = None
    begin: Point = (0.0, 0.0)
    entry: Step | None = None
    depths: list[Step] = field(default_factory=list)
    ahead: list[Step] = field(default_factory=list)
    stands: Point | None = None

    def push(self, step: Step) -> None:
        """The next step; raises the alarm where the control would stop."""
        match step.role:
            case Role.CONTOUR:
                self._contour(step)
            case Role.FREE:
                if self.entry:  # an approach without compensation
                    self._arrive(
                        self.entry, corners.square_start(step.element, self.entry.offset), step.element.leaving
                    )
                    self.record.close()
                self.record.plain(step, step.element.end)
            case Role.DEPTH if self.ahead:
                self._not_ahead(step)
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
        self._run_out()
        if self.entry:
            self._no_contour(self.entry)
        self.record.close()

    def give_up(self) -> None:
        """The control has stopped: what is recorded so far stays."""
        self.record.close()

    def _enter(self, step: Step) -> None:
        self._run_out()  # an approach under compensation connects two contours
        if self.entry:
            self._no_contour(self.entry)
        self.record.close()
        self.entry = step
        self.record.open(step)

    def _leave(self, step: Step) -> None:
        self._run_out()
        if self.entry:
            self._no_contour(self.entry)
        if step.lead is None:
            self.record.plain(step, step.element.end)
        else:
            self._depart(step, step.lead)
        self.record.remember(step)
        self.record.close()

    def _no_contour(self, entry: Step) -> NoReturn:
        self.log.stop("HE7", NO_CONTOUR, entry.element.line, entry.element.column)

    def _arrive(self, entry: Step, goal: Point, way: Point) -> None:
        """Run the entry to the point square to the first element's start, where that sets off in direction `way`."""
        if entry.lead is None:
            self.record.plain(entry, goal)
        else:
            self._approach(entry, entry.lead, goal, way)
        self.entry = None
        self._sink_waiting()

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
            self.record.arc(end, height, curve.center, curve.turn, step)
        elif curve.point != end or self.record.at(step)[:2] != end:
            self.record.line(end, height, step)

    def _inside_circle(self, step: Step, lead: leads.Lead) -> NoReturn:
        line, column = step.element.line, step.element.column
        self.log.stop("HE5", INSIDE_CIRCLE, line, column, lengths=(lead.radius,))

    def _contour(self, step: Step) -> None:
        element = step.element
        if self.ahead and step.ahead != self.ahead[-1].ahead:
            self._run_ahead(goes_on=True)
        if step.ahead:
            self._gather(step)
            return
        if element.turn and corners.offset_radius(element, step.offset) <= JOINED:
            why = "the tool of radius {0} cannot run inside this arc of radius {1}"
            self._too_large(element, why, abs(step.offset), element.radius)
        begin = corners.square_start(element, step.offset)
        if self.entry:
            self._arrive(self.entry, begin, element.leaving)
        elif self.held:
            begin = self._corner(self.held, step)
        self.held, self.begin = step, begin

    def _gather(self, step: Step) -> None:
        """An element under M120: its path is known once the last one is."""
        if step.corner is not Corner.PLAIN or step.element.low != step.element.high:
            self._not_ahead(step)
        if self.depths and not self.entry:
            self._not_ahead(self.depths[0])
        if self.held and not self.ahead:
            self.ahead.append(self.held)
            self.stands, self.held = self.begin, None
        self.ahead.append(step)

    def _not_ahead(self, step: Step) -> NoReturn:
        self.log.stop("WORD", NOT_AHEAD, step.element.line, step.element.column)

    def _run_ahead(self, *, goes_on: bool) -> None:
        """Run along the elements gathered under M120; `goes_on`: the last one waits for a corner with the next."""
        steps, stands = self.ahead, self.stands
        self.ahead, self.stands = [], None
        if not steps:
            return
        found = path_ahead([step.element for step in steps], steps[0].offset, steps[-1].ahead, stands)
        if isinstance(found, Unreached):
            if found.before:
                self._along(steps, found.before, found.before.runs)
                self._remember(steps[: found.row])
            self._too_large(steps[found.row].element, found.text, abs(steps[0].offset))
        for one in found.left_out:
            element = steps[one].element
            self.log.tell(
                Severity.WARNING, "M120", LEFT_OUT, element.line, element.column, lengths=(abs(steps[0].offset),)
            )
        runs, behind = (found.runs[:-1], found.runs[-2:-1]) if goes_on else (found.runs, ())
        self._along(steps, found, runs)
        self._remember(steps[:-1] if goes_on else steps)
        if goes_on:
            self.held, self.begin = steps[-1], behind[0].end if behind else found.start

    def _along(self, steps: list[Step], path: Ahead, runs: tuple[Run, ...]) -> None:
        """The way to a path computed ahead, and pieces of it."""
        if self.entry:
            self._arrive(self.entry, path.start, path.way)
        for run in runs:
            self._run(steps[run.row], run)

    def _remember(self, steps: list[Step]) -> None:
        for step in steps:
            self.record.remember(step)

    def _run(self, step: Step, run: Run) -> None:
        """A piece of the path computed ahead."""
        height = step.element.high
        if run.turn:
            self.record.arc(run.end, height, run.center, run.turn, step, None if run.corner else _arc_feed(step))
        else:
            self.record.line(run.end, height, step)

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
        slack = max(JOINED, ROUNDED / max(abs(corners.turning(first, second)), corners.WHOLE))
        if meeting is None or (inside and min(advance(first, meeting, end), advance(second, begin, meeting)) < -slack):
            self._too_large(second, "the tool of radius {0} cannot come into the corner before this block", abs(offset))
        return meeting

    def _finish(self, step: Step, end: Point) -> None:
        """Record the held element, now that its end is known."""
        element = step.element
        left = remaining(element, self.begin, end, step.offset)
        if left < -JOINED:
            self._too_large(element, "between its neighbors nothing is left of this block", abs(step.offset))
        if element.turn and left > JOINED:
            if left >= tau * corners.offset_radius(element, step.offset) - JOINED:
                end = self.begin
            self.record.arc(end, element.high, element.center, element.turn, step, _arc_feed(step))
        else:
            self.record.line(end, element.high, step)
        self.record.remember(step)
        self.held = None
        self._sink_waiting()

    def _run_out(self) -> None:
        self._run_ahead(goes_on=False)
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


def _arc_feed(step: Step) -> float:
    element = step.element
    share = corners.offset_radius(element, step.offset) / element.radius
    if step.speed is Speed.EDGE or (step.speed is Speed.INSIDE and share < 1.0):
        return element.feed * share
    return element.feed
