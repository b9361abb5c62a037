"""A contour pass is one pass along a contour at one depth, as elements for a control's own compensation.

Elements that the look-ahead deleted are left out, and the lines and arcs next to them are extended until they meet.  A
blend arc on the tool's path is programmed as an arc about the same center, larger by the tool's radius: the tool runs
the blend inside it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot, inf, pi
from typing import Final, NamedTuple

from core.comp.compensated import Compensated
from core.controls.compensation.elements import (
    Element,
    arc_element,
    element_point,
    element_sweep,
    line_element,
    meeting,
    offset_point,
    point_along,
)
from core.finding import Finding, Severity
from core.geometry.path import Path, point_of_row
from core.geometry.piece import Arc, Piece, Point, Side
from core.tolerance import CLOSED
from core.units import Unit, from_mm

MAX_GAP: Final = 0.001
"""Largest gap in millimeters across which two programmed elements still join."""


class CenterMove(NamedTuple):
    """A move of the tool's center to (x, y, z), a rapid without a `feed`.

    `turn` 0 is a straight move; else the tool turns about `center` in the XY plane, and z changes evenly with the
    angle; an arc that ends where it began in XY is one full turn.
    """

    x: float
    y: float
    z: float
    feed: float | None = None
    turn: int = 0
    center: Point = (0.0, 0.0)

    @property
    def rapid(self) -> bool:
        """True without a feed: the move is as fast as the machine can."""
        return self.feed is None


class WrittenLine(NamedTuple):
    """A line of a program being written, the segment it cuts, and whether it only leads to or from that.

    `travel` is the move that the line must make without compensation; `block` is the number of its MILL CONTOUR block.
    """

    text: str
    segment: float | None = None
    lead: bool = False
    travel: CenterMove | None = None
    block: int | None = None


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class ContourPass:
    """How to make a pass along a contour at one depth: millimeters, millimeters per minute, revolutions per minute.

    The pass is compensated for the tool's `diameter` and the `stock` it leaves.  `feeds` are by segment number.  The
    tool approaches at height `travel`, moves at rapid down to `near`, at feed to `depth`, and up to `leave`.  `block`
    is the number of the pass's MILL CONTOUR block, None if it has none.
    """

    tool: int
    diameter: float
    stock: float
    speed: float
    feeds: Mapping[int, float]
    plunge_feed: float
    travel: float
    near: float
    depth: float
    leave: float
    block: int | None = None


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class CompensatedPass(ContourPass):
    """A pass and the compensated contour that it follows; its leads are at most `longest_lead` tool radii long."""

    compensated: Compensated
    longest_lead: float = inf


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class UncompensatedPass(ContourPass):
    """A pass without compensation, move by move; the first one is a rapid in the plane at height `travel`."""

    travels: tuple[CenterMove, ...]


PassToWrite = CompensatedPass | UncompensatedPass


@dataclass(frozen=True, eq=False, slots=True)
class ProgrammedElements:
    """The elements of a contour in order, and the segment number of each."""

    elements: tuple[Element, ...]
    segments: tuple[float, ...]


@dataclass(frozen=True, eq=False, slots=True)
class PassWithLeads:
    """A pass with its leads: the elements, and the points where it starts and ends.

    The entry ends at the programmed point `to`.
    """

    contour_pass: ContourPass
    side: Side
    shape: ProgrammedElements
    start: Point
    to: Point
    out: Point


@dataclass(frozen=True, slots=True)
class PathEnd:
    """One end of the tool's path: the point `at`, and unit vectors: `direction` of travel, and `outward` from the part.

    `corner` is the programmed point that belongs to `at`.  With a blend the tool enters and leaves along `outward`.
    """

    at: Point
    corner: Point
    direction: Point
    outward: Point
    blend: float


def not_written(text: str, segment: float | None = None, *, lengths: tuple[float, ...] = ()) -> Finding:
    """Return the error that says why a control's own program is not written."""
    return Finding("NOTWRITTEN", Severity.ERROR, text, segment=segment, lengths=lengths)


def programmed_elements(compensated: Compensated) -> ProgrammedElements | Finding:
    """Return the surviving elements, then the overlap's again, cut to what is run; or why there are none."""
    if not len(compensated.path):
        return not_written("There is no path to write.")
    # rounding leaves shorter bridges where two segments nearly run on tangent
    bridged = compensated.bridged & (compensated.path.lengths > MAX_GAP)
    if bool(bridged.any()):
        number = float(compensated.path.numbers[bridged][0])
        return not_written("The tool cannot run a bridged part of the path: the control would stop there.", number)
    rows = _rows(compensated)
    offset = compensated.side.sign * compensated.radius
    elements = [element_of(compensated.contour[row]) for row in rows]
    numbers = compensated.contour.numbers[rows].tolist()
    for index in range(len(rows) - 1):
        first, second = elements[index], elements[index + 1]
        if hypot(first.end[0] - second.start[0], first.end[1] - second.start[1]) <= MAX_GAP:
            continue
        corner = meeting(first, second, 0.0)
        if corner is None:
            text = "The look-ahead deletes the next segments; no control's own compensation does that."
            return not_written(f"{text} Post the center path.", numbers[index])
        elements[index], elements[index + 1] = first._replace(end=corner), second._replace(start=corner)
    path, again = compensated.path, overlap(compensated)
    first_point, last_point = point_of_row(path.points[0]), point_of_row((again if len(again) else path).points[-1])
    elements[0] = _whole(elements[0], elements[0]._replace(start=element_point(elements[0], first_point, offset)))
    elements[-1] = _whole(elements[-1], elements[-1]._replace(end=element_point(elements[-1], last_point, offset)))
    return ProgrammedElements(tuple(map(_rebuilt, elements)), tuple(numbers))


def _rows(compensated: Compensated) -> list[int]:
    """Return the rows of the contour that the path and its overlap run along.

    A move from the path's end to its start, left there by a corner of almost no angle, is not an element.
    """
    again = dict.fromkeys(overlap(compensated).numbers.tolist())
    numbers = [*compensated.path.numbers.tolist(), *again]
    row_of = {number: row for row, number in enumerate(compensated.contour.numbers.tolist())}
    return [row_of[number] for number in numbers if number in row_of]


def overlap(compensated: Compensated) -> Path:
    """Return the part of the path that is run once more before the tool leaves it."""
    out = compensated.lead_out
    return out.part(0, len(out) - 1) if blend_of(compensated) else out


def blend_of(compensated: Compensated) -> float:
    """Return the radius of the blend moves; 0 without them."""
    lead = compensated.lead_in
    return float(lead.radii[0]) if len(lead) else 0.0


def element_of(piece: Piece) -> Element:
    """Return a line or an arc of a path as an element."""
    if isinstance(piece, Arc):
        return arc_element(piece.start, piece.end, piece.center, int(piece.turn))
    return line_element(piece.start, piece.end)


def _whole(whole: Element, cut: Element) -> Element:
    """Return a cut element; a full circle stays one even if rounding has moved an end."""
    apart = hypot(cut.start[0] - cut.end[0], cut.start[1] - cut.end[1])
    return cut._replace(start=cut.end) if whole.turn and whole.start == whole.end and apart < MAX_GAP / 1000 else cut


def _rebuilt(element: Element) -> Element:
    """Return the element with directions for its new ends; a short arc that ends next to its start becomes a line.

    The digits of most controls cannot tell such an end from the start, and some take the arc for a full circle.
    """
    (x, y), (ex, ey) = element.start, element.end
    short = (x, y) != (ex, ey) and max(abs(ex - x), abs(ey - y)) <= CLOSED
    if element.turn and not (short and element_sweep(element) < pi):
        return arc_element(element.start, element.end, element.center, element.turn)
    return line_element(element.start, element.end)


def path_begin(compensated: Compensated) -> PathEnd:
    """Return where and how the tool's path begins."""
    return _end(compensated, compensated.with_leads, compensated.lead_in, 1)


def path_finish(compensated: Compensated) -> PathEnd:
    """Return where and how the tool's path ends."""
    return _end(compensated, compensated.with_leads.reversed(), compensated.lead_out.reversed(), -1)


def _end(compensated: Compensated, whole: Path, lead: Path, sense: int) -> PathEnd:
    """Return the end at which `whole` begins; `sense` is -1 for a reversed path."""
    at, blend = point_of_row(whole.points[0]), blend_of(compensated)
    if blend:
        (cx, cy), (ex, ey) = lead.centers[0].tolist(), lead.points[1].tolist()
        direction = (sense * (cx - at[0]) / blend, sense * (cy - at[1]) / blend)
        outward = ((cx - ex) / blend, (cy - ey) / blend)
        side = (-sense * direction[0], -sense * direction[1])
    else:
        dx, dy = whole.start_directions[0].tolist()
        direction = (sense * dx, sense * dy)
        outward = side = offset_point((0.0, 0.0), direction, compensated.side.sign)
        side = (-side[0], -side[1])
    corner = point_along(at, side, compensated.radius)
    return PathEnd(at, corner, direction, outward, blend)


def number_text(value: float, unit: Unit, decimals: int) -> str:
    """Return millimeters as a number in program units, without needless zeros and never -0; `2.` for 2."""
    text = f"{from_mm(value, unit):.{decimals}f}".rstrip("0")
    return "0." if text in ("0.", "-0.") else text
