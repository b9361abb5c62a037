"""A compensated contour written as a Klartext program with RL or RR, and read back before it is given out.

The contour is written, not the tool's path: the control offsets it.  Blend moves become APPR CT and DEP CT over 90
degrees; without them the tool goes down on the path's first point and RL takes effect there.  What the look-ahead
deleted is left out and its neighbours meet where their own lines and arcs do.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import hypot
from types import MappingProxyType
from typing import Final

import numpy as np

from core.comp.result import Compensated
from core.controls import corners
from core.controls.corners import Element, arc_element, line_element
from core.controls.klartext.control import run
from core.controls.tools import ToolTable
from core.finding import Finding, Severity
from core.geometry.distance import distance
from core.geometry.measured import at, measured
from core.geometry.path import Path
from core.geometry.piece import Arc, Piece, Point
from core.geometry.side import Side
from core.units import Unit, from_mm

AGREES: Final = 0.001
"""Millimetres by which the path the control makes of the written program may miss the one it was written from."""

CLEARANCE: Final = 2.0
"""Millimetres above the top at which rapid ends."""


@dataclass(frozen=True, slots=True)
class Cut:
    """How the contour is cut: millimetres, millimetres a minute, revolutions a minute.

    `depths` are the heights of the passes, in order, `top` the height they start from; `feeds` the feeds of single
    segments, by number, where they differ from `feed`.
    """

    name: str
    unit: Unit
    tool: int
    feed: float
    plunge_feed: float
    speed: float
    safe_z: float
    depths: tuple[float, ...]
    top: float = 0.0
    feeds: Mapping[int, float] = field(default_factory=lambda: MappingProxyType({}))


def write(compensated: Compensated, cut: Cut) -> str | Finding:
    """The program's text; or why the control would not run this path by its own compensation."""
    if not len(compensated.path):
        return _refusal("There is no path to write.")
    if bool(compensated.bridged.any()):
        return _refusal("Part of the path is a bridge the tool cannot run; the control would stop there.")
    elements = _elements(compensated)
    if isinstance(elements, Finding):
        return elements
    text = "\n".join(_numbered(_blocks(compensated, cut, elements))) + "\n"
    return text if _agrees(text, compensated, len(cut.depths)) else _refusal(
        "The control's compensation gives another path than this look-ahead; write the centre path instead."
    )  # fmt: skip


def _refusal(text: str) -> Finding:
    return Finding("NOTWRITTEN", Severity.ERROR, text)


def _elements(compensated: Compensated) -> list[Element] | Finding:
    """The programmed elements in order: those that survive, the overlap's once more, cut to what is run of them."""
    rows = _rows(compensated)
    offset = compensated.side.sign * compensated.radius
    elements = [_element(compensated.contour[row]) for row in rows]
    for index in range(len(rows) - 1):
        first, second = elements[index], elements[index + 1]
        if hypot(first.end[0] - second.start[0], first.end[1] - second.start[1]) <= AGREES:
            continue
        corner = corners.meeting(first, second, 0.0)
        if corner is None:
            return _refusal("Segments on both sides of deleted ones do not meet; write the centre path instead.")
        elements[index], elements[index + 1] = first._replace(end=corner), second._replace(start=corner)
    begin, end = _run_of(compensated)
    elements[0] = elements[0]._replace(start=_surface(elements[0], begin, offset))
    elements[-1] = elements[-1]._replace(end=_surface(elements[-1], end, offset))
    return elements


def _rows(compensated: Compensated) -> list[int]:
    """Rows of the contour that the path and its overlap run along."""
    numbers = [*compensated.path.numbers.tolist(), *_overlap(compensated).numbers.tolist()]
    row_of = {number: row for row, number in enumerate(compensated.contour.numbers.tolist())}
    return [row_of[number] for number in numbers if number in row_of]


def _overlap(compensated: Compensated) -> Path:
    """What is run of the path once more before it is left."""
    out = compensated.lead_out
    return out.part(0, len(out) - 1) if _blend(compensated) else out


def _blend(compensated: Compensated) -> float:
    """Radius of the blend moves, 0 for none."""
    lead = compensated.lead_in
    return float(lead.radii[0]) if len(lead) else 0.0


def _run_of(compensated: Compensated) -> tuple[Point, Point]:
    """The first and the last point the tool runs of the contour's offset."""
    overlap = _overlap(compensated)
    last = overlap if len(overlap) else compensated.path
    (bx, by), (ex, ey) = compensated.path.points[0].tolist(), last.points[-1].tolist()
    return (bx, by), (ex, ey)


def _element(piece: Piece) -> Element:
    if isinstance(piece, Arc):
        return arc_element(piece.start, piece.end, piece.centre, int(piece.turn), 0.0, 0.0, 0.0, 0)
    return line_element(piece.start, piece.end, 0.0, 0.0, rapid=False, feed=0.0, line=0)


def _surface(element: Element, point: Point, offset: float) -> Point:
    """The point of an element that a point of its offset lies beside."""
    if not element.turn:
        return corners.square(point, element.leaving, -offset)
    share = element.radius / corners.offset_radius(element, offset)
    (x, y), (cx, cy) = point, element.centre
    return cx + (x - cx) * share, cy + (y - cy) * share


def _numbered(blocks: Iterator[str]) -> Iterator[str]:
    return (f"{number} {block}" for number, block in enumerate(blocks))


def _blocks(compensated: Compensated, cut: Cut, elements: list[Element]) -> Iterator[str]:
    unit, whole = cut.unit, compensated.whole
    length = _lengths(unit)
    frame = f"PGM {cut.name} {'INCH' if unit is Unit.IN else 'MM'}"
    yield f"BEGIN {frame}"
    yield f"TOOL DEF {cut.tool} L+0 R{length(compensated.radius)}"
    yield f"TOOL CALL {cut.tool} Z S{round(cut.speed)}"
    yield f"L Z{length(cut.safe_z)} R0 FMAX M3"
    numbers = compensated.contour.numbers[_rows(compensated)].tolist()
    feeds = [cut.feeds.get(int(number), cut.feed) for number in numbers]
    for depth in cut.depths:
        yield f"L X{length(whole.points[0, 0])} Y{length(whole.points[0, 1])} R0 FMAX"
        yield f"L Z{length(cut.top + CLEARANCE)} R0 FMAX"
        yield f"L Z{length(depth)} R0 F{_feed(cut.plunge_feed, unit)}"
        yield from _contour(compensated, unit, elements, feeds)
        yield f"L Z{length(cut.safe_z)} R0 FMAX"
    yield "M30"
    yield f"END {frame}"


def _contour(compensated: Compensated, unit: Unit, elements: list[Element], feeds: list[float]) -> Iterator[str]:
    length, blend = _lengths(unit), _blend(compensated)
    (x, y), word = elements[0].start, "RL" if compensated.side is Side.LEFT else "RR"
    start = f"X{length(x)} Y{length(y)}"
    lead = f"CCA+90 R{length(blend)}"
    yield f"APPR CT {start} {lead} {word} F{_feed(feeds[0], unit)}" if blend else f"L {start} {word}"
    for element, feed in zip(elements, feeds, strict=True):
        (x, y), (cx, cy) = element.end, element.centre
        end = f"X{length(x)} Y{length(y)}"
        if element.turn:
            yield f"CC X{length(cx)} Y{length(cy)}"
            yield f"C {end} DR{'+' if element.turn > 0 else '-'} F{_feed(feed, unit)}"
        else:
            yield f"L {end} F{_feed(feed, unit)}"
    x, y = compensated.whole.points[-1].tolist()
    yield f"DEP CT {lead}" if blend else f"L X{length(x)} Y{length(y)} R0"


@dataclass(frozen=True, slots=True)
class _Lengths:
    """Writes lengths with their sign, as fine as the control takes them."""

    unit: Unit

    def __call__(self, value: float) -> str:
        decimals = 5 if self.unit is Unit.IN else 4
        text = f"{from_mm(value, self.unit):+.{decimals}f}".rstrip("0").rstrip(".")
        return "+0" if text in ("+0", "-0", "+", "-") else text


def _lengths(unit: Unit) -> _Lengths:
    return _Lengths(unit)


def _feed(value: float, unit: Unit) -> str:
    return f"{from_mm(value, unit):.3f}".rstrip("0").rstrip(".")


def _agrees(text: str, compensated: Compensated, passes: int) -> bool:
    """Does the control, reading the text, run the path in every pass?"""
    made = run(text.encode(), "", ToolTable())
    if made.stopped_at is not None or len(made.stretches) != passes:
        return False
    paths = [made.moves.part(stretch.first, stretch.last).path() for stretch in made.stretches]
    whole = compensated.whole
    return all(_near(path, whole) and _near(whole, path) for path in paths)


def _near(path: Path, other: Path) -> bool:
    """Do the ends and the middles of a path's pieces lie on another path?"""
    pieces, onto = measured(path), measured(other)
    if not len(pieces) or not len(onto):
        return False
    places = np.concatenate([at(pieces, np.full(len(pieces), part)) for part in (0.0, 0.5, 1.0)])
    return all(float(np.min(distance(onto, np.full(len(onto), place)))) <= AGREES for place in places)
