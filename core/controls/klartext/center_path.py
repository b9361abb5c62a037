"""The center path is a Klartext program's steps, offset by the tool radius and joined at their corners.

An outside corner gets an arc about the corner, an inside corner the meeting of the two offsets.  A contour element
waits until the next one is known.  The path starts and ends square to the contour's first and last points.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, auto
from math import hypot, pi, tau
from typing import Final, NamedTuple, NoReturn

from core.controls.compensation import elements
from core.controls.compensation.corner_rules import CornerKind, CornerRules, Inside, Joint, Outside, join
from core.controls.compensation.elements import Element
from core.controls.compensation.recorder import record_programmed
from core.controls.control_run import Log, Stretch
from core.controls.klartext import lead_curves
from core.controls.klartext.lead_curves import Lead, LeadShape
from core.controls.klartext.m120 import PathAhead, Unreached, path_ahead
from core.controls.moves import Plane, Point3, Tape, flat, solid
from core.controls.transform import Transform
from core.geometry.path import Path
from core.geometry.piece import Arc, Point, Side
from core.tolerance import JOINED

KLARTEXT_CORNERS: Final = CornerRules(tangent=0.0, touching=JOINED)
M97: Final = KLARTEXT_CORNERS._replace(outside=Outside.MEETING)
"""An outside corner goes to the meeting of the two offsets, not around an arc."""
M98: Final = KLARTEXT_CORNERS._replace(inside=Inside.OPEN)
"""An inside corner is not trimmed: both elements run their full length."""

ROUNDING_ERROR: Final = 1e-11
"""Millimeters by which rounding moves a line that is meters from the origin; it moves the meeting with a nearly
parallel line by this over the angle in radians."""

NO_CONTOUR: Final = "No contour element follows the start of compensation. Write the contour before its end."
DEPTH_FIRST: Final = "cutcomp assumes the tool axis moves before this corner arc."
NOT_UNDER_M120: Final = "Under M120 only moves in the working plane without M97 and M98 are supported. End it with LA0."
LEFT_OUT: Final = "M120 skips this block: the {0}-radius tool cannot reach it."
INSIDE_CIRCLE: Final = "PS or PN lies inside the circle of radius {0} of the lead. Move it out or shorten R."


class Role(Enum):
    """The role of a step in compensation."""

    FREE = auto()
    """Moved as programmed, without compensation."""
    ENTRY = auto()
    """The straight move in which RL or RR takes effect."""
    CONTOUR = auto()
    """An element of the compensated contour."""
    DEPTH = auto()
    """Only the tool axis moves."""
    EXIT = auto()
    """The straight move in which R0 takes effect."""
    APPROACH = auto()
    DEPARTURE = auto()


class FeedAt(Enum):
    """The point of an arc move at which the programmed feed applies."""

    CENTER = auto()
    """M111: at the tool's center."""
    EDGE = auto()
    """M109: at the cutting edge, inside and outside."""
    INSIDE_EDGE = auto()
    """M110: at the cutting edge inside, at the center outside."""


class ProgrammedStep(NamedTuple):
    """One programmed element: `offset` is the tool radius, positive with the tool on the left, 0 without compensation.

    `element` starts at the programmed point before it.  Approaches and departures have a `lead`; their `hand` is the
    side of RL (+1), RR (-1) or R0 (0), flipped by a negative radius; `before` is the rapid flag and the feed of the
    block before.  A departure's element is straight but starts in the contour's last direction.  `corner` holds the
    rules at its end, `ahead` the LA of M120, 0 without.  `lost`: only the machine knows its height.
    """

    role: Role
    element: Element
    offset: float
    plane: Plane
    corner: CornerRules = KLARTEXT_CORNERS
    feed_at: FeedAt = FeedAt.CENTER
    lead: Lead | None = None
    hand: int = 0
    before: tuple[bool, float] = (False, 0.0)
    ahead: int = 0
    lost: bool = False

    def placed(self, transform: Transform) -> ProgrammedStep:
        """Return the step as the control runs it, which is placed before the tool radius is added.

        A mirror image of one axis makes RL run on the right and turns arcs around.
        """
        if not transform:
            return self
        element, plane, flip = self.element, self.plane, -1 if transform.flips(self.plane) else 1
        points = (solid(*point, 0.0, plane) for point in (element.start, element.end, element.center))
        vectors = (solid(*vector, 0.0, plane) for vector in (element.start_direction, element.end_direction))
        start, end, center = (flat(transform.applied(point), plane)[:2] for point in points)
        first, last = (flat(transform.vector(vector), plane)[:2] for vector in vectors)
        element = element._replace(start=start, end=end, center=center, start_direction=first, end_direction=last)
        element = element._replace(turn=flip * element.turn)
        return self._replace(element=element, offset=flip * self.offset, hand=flip * self.hand)

    @property
    def arc_feed(self) -> float:
        """The feed of the tool center along the step's offset arc."""
        share = elements.offset_radius(self.element, self.offset) / self.element.radius
        at_edge = self.feed_at is FeedAt.EDGE or (self.feed_at is FeedAt.INSIDE_EDGE and share < 1.0)
        return self.element.feed * share if at_edge else self.element.feed


@dataclass(slots=True)
class Record:
    """Center moves on `tape`, and the compensated `stretches` of them.

    `steps` are those of the open stretch so far, the one that turns compensation on first; it begins at row `first` of
    the tape, at the point `start`.  `share` is the fraction of the tool radius that the run uses.
    """

    log: Log
    share: float = 1.0
    tape: Tape = field(default_factory=Tape)
    stretches: list[Stretch] = field(default_factory=list)
    steps: list[ProgrammedStep] = field(default_factory=list)
    first: int = 0
    start: Point3 = (0.0, 0.0, 0.0)

    def at(self, step: ProgrammedStep) -> Point3:
        """Return the position of the center, in the coordinates of the step's plane."""
        return flat(self.tape.last, step.plane)

    def line(self, end: Point, height: float, step: ProgrammedStep, *, lead: bool = False) -> None:
        """Record a straight move at the step's feed, or for a `lead` at that of the block before it."""
        target = solid(end[0], end[1], height, step.plane)
        rapid, feed = step.before if lead else (step.element.rapid, step.element.feed)
        self.tape.lost = step.lost
        self.tape.straight(target, feed, step.element.line, rapid=rapid)

    def arc(
        self, end: Point, height: float, center: Point, turn: int, step: ProgrammedStep, feed: float | None = None
    ) -> None:
        """Record an arc in the step's plane, at the step's feed unless another is given."""
        target, middle = solid(*end, height, step.plane), solid(*center, height, step.plane)
        element = step.element
        speed = element.feed if feed is None else feed
        self.tape.lost = step.lost
        self.tape.arc(target, middle, turn, step.plane, speed, element.line, rapid=element.rapid)

    def plain(self, step: ProgrammedStep, end: Point) -> None:
        """Record the step's element as programmed, but ending at `end`."""
        self.tape.lost = step.lost
        record_programmed(self.tape, step.element._replace(end=end), step.plane)

    def sink(self, step: ProgrammedStep) -> None:
        """Record a move of the tool axis alone, at the position of the center."""
        x, y, _ = self.at(step)
        self.line((x, y), step.element.end_height, step)

    def open(self, step: ProgrammedStep) -> None:
        """Compensation begins: make the next moves a stretch."""
        self.steps, self.first, self.start = [step], len(self.tape) - 1, self.tape.last

    def note(self, *steps: ProgrammedStep) -> None:
        """Add steps to the open stretch, if any."""
        if self.steps:
            self.steps += steps

    def close(self) -> None:
        """Compensation ends: keep the stretch, unless it has no offset or no moves yet."""
        steps, self.steps = self.steps, []
        if not steps or not steps[0].offset or len(self.tape) <= self.first + 1:
            return
        programmed, entry, last = Tape(self.start), steps[0], steps[-1].role
        for step in steps:
            record_programmed(programmed, step.element, step.plane)
        stretch = Stretch(
            Side.LEFT if entry.offset > 0.0 else Side.RIGHT,
            abs(entry.offset) / self.share,
            entry.plane,
            programmed.moves(),
            entry=1,
            exit=int(last in (Role.EXIT, Role.DEPARTURE)),
            first=self.first,
            last=len(self.tape),
            led_in=entry.role is Role.APPROACH,
            led_out=last is Role.DEPARTURE,
        )
        self.stretches.append(stretch)


@dataclass(slots=True)
class CenterPathRecorder(Record):
    """Takes steps in their order and records the center's moves.

    `held` is the contour element whose end is not known yet, `begin` the point at which its offset starts; `entry` is a
    start of compensation that waits for its first element; `depths` are tool-axis moves that wait with either.  `ahead`
    are the elements gathered under M120, `stands` is the point already reached on the first one's offset, if any.
    """

    held: ProgrammedStep | None = None
    begin: Point = (0.0, 0.0)
    entry: ProgrammedStep | None = None
    depths: list[ProgrammedStep] = field(default_factory=list)
    ahead: list[ProgrammedStep] = field(default_factory=list)
    stands: Point | None = None

    def push(self, step: ProgrammedStep) -> None:
        """Take the next step; raise the alarm if the control would stop."""
        match step.role:
            case Role.CONTOUR:
                self._contour(step)
            case Role.FREE:
                if self.entry and self.entry.plane is not step.plane:
                    self.log.stop("HE7", NO_CONTOUR, self.entry.element)
                if self.entry:  # an approach without compensation
                    goal = elements.offset_start(step.element, self.entry.offset)
                    self._arrive(self.entry, goal, step.element.start_direction)
                    self.close()
                self.plain(step, step.element.end)
            case Role.DEPTH if self.ahead:
                self._stop_m120(step)
            case Role.DEPTH if self.held or self.entry:
                self.depths.append(step)
            case Role.DEPTH:
                self.sink(step)
                self.note(step)
            case Role.ENTRY | Role.APPROACH:
                self._enter(step)
            case Role.EXIT | Role.DEPARTURE:
                self._leave(step)

    def finish(self) -> None:
        """Run what waits; the last element ends square to the contour, compensated or not."""
        self._run_out()
        self.close()

    def _enter(self, step: ProgrammedStep) -> None:
        self._run_out()  # an approach under compensation connects two contours
        self.close()
        self.entry = step
        self.open(step)

    def _leave(self, step: ProgrammedStep) -> None:
        self._run_out()
        if step.lead is None:
            self.plain(step, step.element.end)
        else:
            self._depart(step, step.lead)
        self.note(step)
        self.close()

    def _run_out(self) -> None:
        """Finish what waits, because nothing follows it."""
        self._run_ahead(goes_on=False)
        if self.held:
            self._finish(self.held, elements.offset_end(self.held.element, self.held.offset))
        if self.entry:
            self.log.stop("HE7", NO_CONTOUR, self.entry.element)

    def _arrive(self, entry: ProgrammedStep, goal: Point, direction: Point) -> None:
        """Run the entry to the point square to the first element's start, where the element has this direction."""
        if entry.lead is None:
            self.plain(entry, goal)
        else:
            self._approach(entry, entry.lead, goal, direction)
        self.entry = None
        self._sink_waiting()

    def _approach(self, step: ProgrammedStep, lead: Lead, goal: Point, direction: Point) -> None:
        x, y, height = self.at(step)
        curve = lead_curves.approach(lead, (x, y), goal, direction, step.hand)
        if curve is None:
            self.log.stop("HE5", INSIDE_CIRCLE, step.element, lengths=(lead.radius,))
        depth = step.element.end_height
        if lead.shape is LeadShape.LCT:
            self.line(curve.point, depth, step)
        else:
            self.line(curve.point, height, step, lead=True)
            if depth != height:
                self.line(curve.point, depth, step, lead=True)
        self._run_curve(goal, depth, curve, step)

    def _depart(self, step: ProgrammedStep, lead: Lead) -> None:
        x, y, height = self.at(step)
        curve = lead_curves.departure(lead, (x, y), step.element.end, step.element.start_direction, step.hand)
        if curve is None:
            self.log.stop("HE5", INSIDE_CIRCLE, step.element, lengths=(lead.radius,))
        self._run_curve(curve.point, height, curve, step)
        if lead.shape is LeadShape.LCT:
            self.line(step.element.end, height, step)
        if step.element.end_height != height:
            self.sink(step)

    def _run_curve(self, end: Point, height: float, curve: lead_curves.Curve, step: ProgrammedStep) -> None:
        if curve.turn:
            self.arc(end, height, curve.center, curve.turn, step)
        elif curve.point != end or self.at(step)[:2] != end:
            self.line(end, height, step)

    def _contour(self, step: ProgrammedStep) -> None:
        element = step.element
        if self.ahead and step.ahead != self.ahead[-1].ahead:
            self._run_ahead(goes_on=True)
        if step.ahead:
            self._gather(step)
            return
        if element.turn and elements.offset_radius(element, step.offset) <= JOINED:
            why = "the {0}-radius tool cannot run inside this arc of radius {1}"
            self._stop_too_large(step, why, abs(step.offset), element.radius)
        begin = elements.offset_start(element, step.offset)
        if self.entry:
            self._arrive(self.entry, begin, element.start_direction)
        elif self.held:
            begin = self._corner(self.held, step)
        self.held, self.begin = step, begin

    def _corner(self, before: ProgrammedStep, after: ProgrammedStep) -> Point:
        """Finish the held element at its corner with the next, and return the start of the next one's offset."""
        first, offset = _at_its_end(before.element), before.offset
        joint = join(first, after.element, offset, before.corner)
        if joint.missed or (joint.corner is CornerKind.INSIDE and self._overruns(first, after.element, offset, joint)):
            why = "the {0}-radius tool cannot enter the corner before this block"
            self._stop_too_large(after, why, abs(offset))
        if joint.center is not None and self.depths:
            self.log.inform("INTERPRETED", DEPTH_FIRST, self.depths[0].element)
        self._finish(before, joint.end)
        if joint.center is not None:
            height, turn = self.at(before)[2], -1 if offset > 0.0 else 1
            self.arc(joint.start, height, first.end, turn, before)
        elif joint.start != joint.end:
            self.line(joint.start, first.end_height, before)
        return joint.start

    @staticmethod
    def _overruns(first: Element, second: Element, offset: float, joint: Joint) -> bool:
        """True if two offsets meet only beyond their ends at the corner."""
        if joint.start != joint.end:
            return False
        slack = max(JOINED, ROUNDING_ERROR / max(abs(elements.turn_angle(first, second)), elements.SAME_DIRECTION))
        end, begin = elements.offset_end(first, offset), elements.offset_start(second, offset)
        return min(advance(first, joint.end, end), advance(second, begin, joint.end)) < -slack

    def _finish(self, step: ProgrammedStep, end: Point) -> None:
        """Record the held element, now that its end is known."""
        element = step.element
        left = remaining(element, self.begin, end, step.offset)
        if left < -JOINED:
            self._stop_too_large(step, "its neighbors leave no length for this block", abs(step.offset))
        if element.turn and left > JOINED:
            if left >= tau * elements.offset_radius(element, step.offset) - JOINED:
                end = self.begin
            self.arc(end, element.end_height, element.center, element.turn, step, step.arc_feed)
        else:
            self.line(end, element.end_height, step)
        self.note(step)
        self.held = None
        self._sink_waiting()

    def _sink_waiting(self) -> None:
        for step in self.depths:
            self.sink(step)
            self.note(step)
        self.depths.clear()

    def _gather(self, step: ProgrammedStep) -> None:
        """Gather an element under M120; its path is known once the last element is."""
        if step.corner is not KLARTEXT_CORNERS or step.element.start_height != step.element.end_height:
            self._stop_m120(step)
        if self.depths and not self.entry:
            self._stop_m120(self.depths[0])
        if self.held and not self.ahead:
            self.ahead.append(self.held)
            self.stands, self.held = self.begin, None
        self.ahead.append(step)

    def _run_ahead(self, *, goes_on: bool) -> None:
        """Run along the elements gathered under M120; `goes_on`: the last one waits for its corner with the next."""
        steps, stands = self.ahead, self.stands
        self.ahead, self.stands = [], None
        if not steps:
            return
        path = path_ahead([step.element for step in steps], steps[0].offset, steps[-1].ahead, stands)
        if isinstance(path, Unreached):
            if path.before:
                self._run_along(steps, path.before, path.before.path)
                self.note(*steps[: path.row])
            self._stop_too_large(steps[path.row], path.text, abs(steps[0].offset))
        for row in path.left_out:
            self.log.warn("M120", LEFT_OUT, steps[row].element, lengths=(abs(steps[0].offset),))
        along = path.path.part(0, len(path.path) - int(goes_on))
        self._run_along(steps, path, along)
        self.note(*(steps[:-1] if goes_on else steps))
        if goes_on:
            self.held, self.begin = steps[-1], along[-1].end if len(along) else path.start

    def _run_along(self, steps: list[ProgrammedStep], ahead: PathAhead, path: Path) -> None:
        """Run any entry to a path computed ahead, then a part of the path."""
        if self.entry:
            self._arrive(self.entry, ahead.start, ahead.direction)
        for piece, number in zip(path, path.numbers.tolist(), strict=True):
            step = steps[int(number)]
            height = step.element.end_height
            if isinstance(piece, Arc):
                feed = step.arc_feed if number == int(number) else None
                self.arc(piece.end, height, piece.center, piece.turn, step, feed)
            else:
                self.line(piece.end, height, step)

    def _stop_m120(self, step: ProgrammedStep) -> NoReturn:
        self.log.stop("WORD", NOT_UNDER_M120, step.element)

    def _stop_too_large(self, step: ProgrammedStep, why: str, *lengths: float) -> NoReturn:
        text = f"Tool radius too large: {why}. Take a smaller tool or open the contour."
        self.log.stop("HE3", text, step.element, lengths=lengths)


def _at_its_end(element: Element) -> Element:
    """Return the element as it is at its end: an arc's radius there may differ a little from that at its start."""
    return element._replace(start=element.end) if element.turn else element


def advance(element: Element, start: Point, end: Point) -> float:
    """Return the millimeters along an offset between two of its points, negative backwards, at most half a circle."""
    if not element.turn:
        (x, y), (ex, ey), direction = start, end, element.start_direction
        return (ex - x) * direction[0] + (ey - y) * direction[1]
    angle = elements.sweep(start, end, element.center, element.turn)
    return (angle - tau if angle > pi else angle) * hypot(start[0] - element.center[0], start[1] - element.center[1])


def remaining(element: Element, begin: Point, end: Point, offset: float) -> float:
    """Return the millimeters left of an element's offset between its trimmed ends; negative if these cross."""
    if not element.turn:
        return advance(element, begin, end)
    whole = elements.element_sweep(element) * elements.offset_radius(element, offset)
    first, last = elements.offset_start(element, offset), elements.offset_end(element, offset)
    return whole - advance(element, first, begin) - advance(element, end, last)
