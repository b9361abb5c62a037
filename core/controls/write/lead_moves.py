"""Lead moves are the straight moves into and out of a compensated contour, as each word-address control needs them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, inf
from typing import Final

from core.controls.compensation.elements import Element, arc_element, line_element, point_along
from core.controls.write.contour_pass import PathEnd, ProgrammedElements
from core.controls.write.iso_style import EntryRule, IsoStyle
from core.geometry.path import Path
from core.geometry.piece import Line, Piece, Point, Side
from core.tolerance import GOUGE
from core.verify.judge import judge

LEAD_LENGTHS: Final = (2.0, 1.25, 1.05, 0.5, 0.25, 0.1)
"""Lengths of the straight leads in tool radii, longest first; the first that cuts nothing is used."""

MIN_SQUARE_LENGTH: Final = 1.0
"""Tool radii that an entry must exceed if it ends square to itself."""

ON_LINE: Final = 1e-6
"""Millimeters that the joint of two lines may lie off the line that replaces them."""


@dataclass(frozen=True, eq=False, slots=True)
class ProtectedContour:
    """The contour that leads must not cut, with the side and the radius of the cutter."""

    path: Path
    side: Side
    radius: float

    def gouge(self, lead: Sequence[Piece]) -> float:
        """Return how deep a lead cuts; the cutter's diameter if that cannot be judged."""
        verdict = judge(self.path, self.side, self.radius, Path.from_pieces(list(lead)))
        return verdict.depth if verdict.judged else 2.0 * self.radius


def clear_leads(
    first: PathEnd,
    last: PathEnd,
    style: IsoStyle,
    radius: float,
    surface: ProtectedContour,
    into: Sequence[Piece] = (),
    off: Sequence[Piece] = (),
    longest: float = inf,
) -> tuple[Point, Point] | float:
    """Return where the longest leads that cut nothing start and end, or how deep the shortest ones cut.

    Lengths are multiples of `radius`, at most `longest`.  `into` follows the lead-in; `off` precedes the lead-out.
    """
    depth = 0.0
    for length in LEAD_LENGTHS:
        if length > longest:
            continue
        if style.entry is EntryRule.SQUARE_TO_ITSELF and length <= MIN_SQUARE_LENGTH:
            continue
        start, out = _start(first, style, length * radius), point_along(last.at, last.outward, length * radius)
        leads = (Line(start, first.at), *into), (*off, Line(last.at, out))
        depth = max(map(surface.gouge, leads))
        if depth <= GOUGE:
            return start, out
    return depth


def _start(end: PathEnd, style: IsoStyle, length: float) -> Point:
    """Return where the entry starts: `length` from its end, on the line that the control needs."""
    at = end.corner if style.entry is EntryRule.SQUARE_TO_ITSELF else end.at
    if end.blend or style.entry is EntryRule.SQUARE_TO_NEXT:
        return point_along(at, end.outward, length)
    return point_along(at, end.direction, -length)


def with_blends(
    shape: ProgrammedElements, first: PathEnd, last: PathEnd, radius: float, segments: tuple[float, float]
) -> ProgrammedElements:
    """Add the blends as programmed arcs, larger than the center's by the tool's radius: the tool runs inside them.

    `segments` are the numbers of the two arcs.
    """
    if not first.blend:
        return shape
    elements, size = shape.elements, first.blend + radius
    turn = 1 if first.outward[1] * first.direction[0] - first.outward[0] * first.direction[1] > 0.0 else -1
    into = arc_element(first.corner, elements[0].start, point_along(first.corner, first.direction, size), turn)
    off = arc_element(elements[-1].end, last.corner, point_along(last.corner, last.direction, -size), turn)
    return ProgrammedElements((into, *elements, off), (segments[0], *shape.segments, segments[1]))


def merged(shape: ProgrammedElements) -> ProgrammedElements:
    """Return the elements with lines that continue one another merged, under the first one's segment."""
    elements, segments = [shape.elements[0]], [shape.segments[0]]
    for element, segment in zip(shape.elements[1:], shape.segments[1:], strict=True):
        if _continues(elements[-1], element):
            elements[-1] = line_element(elements[-1].start, element.end)
        else:
            elements.append(element)
            segments.append(segment)
    return ProgrammedElements(tuple(elements), tuple(segments))


def _continues(first: Element, second: Element) -> bool:
    if first.turn or second.turn:
        return False
    (ax, ay), (bx, by) = first.start_direction, second.start_direction
    length = min(hypot(line.end[0] - line.start[0], line.end[1] - line.start[1]) for line in (first, second))
    return ax * bx + ay * by > 0.0 and abs(ax * by - ay * bx) * length <= ON_LINE
