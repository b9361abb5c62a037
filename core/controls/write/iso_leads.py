"""The straight moves into a compensated contour and out of it, as each word-address control needs them."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Final

from core.controls.compensation.corners import Element, arc_element, beyond, line_element
from core.controls.write.iso_style import Entry, IsoStyle
from core.controls.write.programmed_contour import Cut, End, Programmed, Terms, begin, finish, programmed
from core.finding import Finding
from core.geometry.piece import Point, Side

ON_LINE: Final = 1e-6
"""Millimeters by which the joint of two lines may lie beside the line they are merged to."""


@dataclass(frozen=True, eq=False, slots=True)
class Ready:
    """A run with what is run of it: elements, leads included, and the points it is entered from and left to."""

    cut: Terms
    side: Side
    shape: Programmed
    start: Point
    to: Point
    out: Point
    offset: int


def start_of(end: End, style: IsoStyle, reach: float) -> Point:
    """Where the entry starts: `reach` away from where it ends, on the line the control needs it on."""
    if end.blend:
        return beyond(end.corner if style.entry is Entry.OWN else end.at, end.off, reach)
    if style.entry is Entry.NEXT:
        return beyond(end.at, end.off, reach)
    return beyond(end.corner if style.entry is Entry.OWN else end.at, end.way, -reach)


def out_of(end: End, reach: float) -> Point:
    """Where the exit ends."""
    return beyond(end.at, end.off, reach)


def ready(cut: Cut, style: IsoStyle, reach: float, offset: int) -> Ready | Finding:
    """A cut with its leads of a length."""
    shape = programmed(cut.compensated)
    if isinstance(shape, Finding):
        return shape
    first, last = begin(cut.compensated), finish(cut.compensated)
    shape = _led(merged(shape) if style.merged else shape, cut, first, last)
    start, out = start_of(first, style, reach), out_of(last, reach)
    return Ready(cut, cut.compensated.side, shape, start, first.corner, out, offset)


def _led(shape: Programmed, cut: Cut, first: End, last: End) -> Programmed:
    """With the blends as programmed arcs."""
    if not first.blend:
        return shape
    lead_in, lead_out = cut.compensated.lead_in, cut.compensated.lead_out
    elements, segments = shape.elements, shape.segments
    (ax, ay), (bx, by) = lead_in.centers[0].tolist(), lead_out.centers[-1].tolist()
    turn_in, turn_out = int(lead_in.turns[0]), int(lead_out.turns[-1])
    into = arc_element(first.corner, elements[0].start, (ax, ay), turn_in, 0.0, 0.0, 0.0, 0)
    off = arc_element(elements[-1].end, last.corner, (bx, by), turn_out, 0.0, 0.0, 0.0, 0)
    return Programmed((into, *elements, off), (segments[0], *segments, segments[-1]))


def merged(shape: Programmed) -> Programmed:
    """Lines that go on in one line made one, with the first one's segment."""
    elements, segments = [shape.elements[0]], [shape.segments[0]]
    for element, segment in zip(shape.elements[1:], shape.segments[1:], strict=True):
        if _goes_on(elements[-1], element):
            elements[-1] = line_element(elements[-1].start, element.end, 0.0, 0.0, rapid=False, feed=0.0, line=0)
        else:
            elements.append(element)
            segments.append(segment)
    return Programmed(tuple(elements), tuple(segments))


def _goes_on(first: Element, second: Element) -> bool:
    if first.turn or second.turn:
        return False
    (ax, ay), (bx, by) = first.leaving, second.leaving
    length = min(hypot(one.end[0] - one.start[0], one.end[1] - one.start[1]) for one in (first, second))
    return ax * bx + ay * by > 0.0 and abs(ax * by - ay * bx) * length <= ON_LINE
