"""Corner rounding puts the arc of an RND or the line of a CHF between two programmed elements."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Final

from core.controls.compensation import elements
from core.controls.compensation.elements import Element, arc_element, line_element
from core.controls.klartext.center_path import KLARTEXT_CORNERS, CenterPathRecorder, ProgrammedStep, Role
from core.geometry.piece import Point
from core.tolerance import JOINED

NOT_BETWEEN: Final = "RND and CHF must stand directly between two contour elements of one side. Move the block."
NO_LEAD: Final = "cutcomp follows RND only directly between two contour elements of one side, and not as a lead."


@dataclass(frozen=True, slots=True)
class PendingCorner:
    """An RND or CHF that waits for the element after it; `size` is the radius or the leg."""

    line: int
    column: int
    size: float
    rounded: bool
    feed: float


@dataclass(slots=True)
class CornerBuffer:
    """Holds the last contour element until no RND or CHF can follow it, then hands it on to the center path."""

    center: CenterPathRecorder
    step: ProgrammedStep | None = None
    pending: PendingCorner | None = None

    def push(self, step: ProgrammedStep) -> None:
        """Take the next step."""
        if step.role is not Role.CONTOUR and step.role is not Role.FREE:
            if self.pending and self.pending.rounded:
                self.center.log.stop("BEYOND", NO_LEAD, self.pending)
            self.flush()
            self.center.push(step)
            return
        if self.pending:
            step = self._blended(self.pending, step)
        elif self.step:
            self.center.push(self.step)
        self.step = step

    def flush(self) -> None:
        """Hand on the waiting element, because no RND or CHF follows it."""
        if self.pending:
            self.center.log.stop("CORNER", NOT_BETWEEN, self.pending)
        step, self.step = self.step, None
        if step:
            self.center.push(step)

    def _blended(self, pending: PendingCorner, second: ProgrammedStep) -> ProgrammedStep:
        """Hand on the waiting element and its rounding or chamfer; return the next element, cut short."""
        first, self.step, self.pending = self.step, None, None
        if first is None or first.role is not second.role or first.plane is not second.plane:
            self.center.log.stop("CORNER", NOT_BETWEEN, pending)
        parts = (rounding if pending.rounded else chamfer)(first.element, second.element, pending.size)
        if isinstance(parts, str):
            self.center.log.stop("CORNER", parts, pending)
        between = parts[1]._replace(line=pending.line, column=pending.column, rapid=False, feed=pending.feed)
        self.center.push(first._replace(element=parts[0], corner=KLARTEXT_CORNERS))
        self.center.push(first._replace(element=between, corner=KLARTEXT_CORNERS))
        return second._replace(element=parts[2])


Blended = tuple[Element, Element, Element]
"""The first element cut short, the rounding or chamfer, and the second element cut short."""


def rounding(first: Element, second: Element, radius: float) -> Blended | str:
    """Return two elements with a tangent arc of `radius` millimeters, or the sentence that says why there is none."""
    angle = elements.turn_angle(first, second)
    if abs(angle) < elements.SAME_DIRECTION or not _level(first, second):
        return "There is no corner to round. Both blocks must lie in the working plane and meet at an angle."
    offset = radius if angle > 0.0 else -radius
    ending = first._replace(start=first.end) if first.turn else first
    center = elements.meeting(ending, second, offset)
    if center is None:
        return "No arc of this radius touches both blocks. Write a smaller R."
    start, end = (elements.element_point(element, center, offset) for element in (ending, second))
    if not _lies_on(first, start) or not _lies_on(second, end):
        return "The rounding is longer than the blocks it joins. Write a smaller R."
    turn = 1 if angle > 0.0 else -1
    arc = arc_element(start, end, center, turn, first.end_height, first.end_height, first.feed, first.line)
    return _cut(first, first.start, start), arc, _cut(second, end, second.end)


def chamfer(first: Element, second: Element, leg: float) -> Blended | str:
    """Return two lines with one that cuts `leg` millimeters off both, or the sentence that says why there is none."""
    if first.turn or second.turn or not _level(first, second):
        return "A chamfer needs two straight blocks in the working plane. Use RND."
    start, end = (
        elements.point_along(first.end, first.end_direction, -leg),
        elements.point_along(first.end, second.start_direction, leg),
    )
    if not _lies_on(first, start) or not _lies_on(second, end):
        return "The chamfer is longer than the blocks it joins. Write a shorter one."
    between = line_element(start, end, first.end_height, first.end_height, first.rapid, first.feed, first.line)
    return _cut(first, first.start, start), between, _cut(second, end, second.end)


def _level(first: Element, second: Element) -> bool:
    return first.start_height == first.end_height == second.start_height == second.end_height


def _lies_on(element: Element, point: Point) -> bool:
    if not element.turn:
        (x, y), direction = element.start, element.start_direction
        along = (point[0] - x) * direction[0] + (point[1] - y) * direction[1]
        return -JOINED <= along <= hypot(element.end[0] - x, element.end[1] - y) + JOINED
    return elements.sweep(element.start, point, element.center, element.turn) <= elements.element_sweep(element)


def _cut(element: Element, start: Point, end: Point) -> Element:
    """Return an element between two of its points."""
    if not element.turn:
        return element._replace(start=start, end=end, center=start)
    first, last = (elements.tangent(at, element.center, element.turn) for at in (start, end))
    return element._replace(start=start, end=end, start_direction=first, end_direction=last)
