"""Klartext program: compensated contours written with RL and RR.

The contour is written, not the tool's path: the control offsets it.  Blend moves become APPR CT and DEP CT over 90
degrees; without them the tool goes down on the path's first point and RL takes effect there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees, hypot, tau
from typing import Final

from core.controls.compensation.corners import Element, sweep
from core.controls.write.programmed_contour import (
    Cut,
    Led,
    Line,
    Plain,
    Programmed,
    Terms,
    Travel,
    blend_of,
    programmed,
)
from core.finding import Finding
from core.geometry.piece import Point, Side
from core.units import Unit, from_mm, to_mm

DECIMALS: Final = {Unit.IN: 5, Unit.MM: 4}
"""Decimals the control takes."""

_Shaped = tuple[Cut, Programmed] | Plain


def write(
    cuts: Sequence[Cut | Plain], name: str, unit: Unit, remarks: Sequence[str] = ()
) -> tuple[Line, ...] | Finding:
    """The lines of the program; or why the control would not run one of these paths by its own compensation."""
    shaped: list[_Shaped] = []
    for cut in cuts:
        if isinstance(cut, Plain):
            shaped.append(cut)
            continue
        shape = programmed(cut.compensated)
        if isinstance(shape, Finding):
            return shape
        shaped.append((cut, shape))
    lines = _Writer(unit).program(shaped, name, remarks)
    return tuple(line._replace(text=f"{number} {line.text}") for number, line in enumerate(lines))


def write_led(runs: Sequence[Led], unit: Unit) -> tuple[Line, ...]:
    """The lines of a program that comes to each contour square to it and leaves it so, with APPR LN and DEP LN."""
    return tuple(_Writer(unit).led_program(runs))


@dataclass(frozen=True, slots=True)
class _Writer:
    """Writes blocks in a unit."""

    unit: Unit

    def led_program(self, runs: Sequence[Led]) -> Iterator[Line]:
        """Runs with straight leads, from BEGIN PGM to END PGM."""
        frame = f"PGM CONTOUR {'INCH' if self.unit is Unit.IN else 'MM'}"
        yield Line(f"BEGIN {frame}")
        yield from self.tools([one.terms for one in runs])
        before: Terms | None = None
        for one in runs:
            yield from self.tool(one.terms, before)
            yield from self.led(one)
            before = one.terms
        yield Line("M30")
        yield Line(f"END {frame}")

    def led(self, one: Led) -> Iterator[Line]:
        """One run: down away from the contour, square to it, along, square away, up."""
        cut, shape = one.terms, one.shape
        (x, y), (cx, cy) = one.start, one.to
        length = self.length(hypot(x - cx, y - cy) - cut.diameter / 2)
        feeds = [cut.feeds[int(number)] for number in shape.segments]
        word = "RL" if one.side is Side.LEFT else "RR"
        yield Line(f"L {self.place(one.start)} R0 FMAX")
        yield Line(f"L Z{self.length(cut.depth)} R0 F{self.feed(cut.plunge_feed)}")
        into = f"APPR LN {self.place(one.to)} LEN{length} {word} F{self.feed(feeds[0])}"
        yield Line(into, shape.segments[0], lead=True)
        for element, feed, segment in zip(shape.elements, feeds, shape.segments, strict=True):
            yield from self.element(element, feed, segment)
        yield Line(f"DEP LN LEN{length}", shape.segments[-1], lead=True)
        yield Line(f"L Z{self.length(cut.leave)} R0 FMAX")

    def program(self, cuts: Sequence[_Shaped], name: str, remarks: Sequence[str]) -> Iterator[Line]:
        """Everything from BEGIN PGM to END PGM; remarks after a semicolon."""
        frame = f"PGM {name} {'INCH' if self.unit is Unit.IN else 'MM'}"
        yield Line(f"BEGIN {frame}")
        yield from (Line(f"; {remark}") for remark in remarks)
        yield from self.tools([one if isinstance(one, Plain) else one[0] for one in cuts])
        before: Terms | None = None
        for one in cuts:
            terms = one if isinstance(one, Plain) else one[0]
            yield from self.tool(terms, before)
            yield from self.plain(one) if isinstance(one, Plain) else self.cut(*one)
            before = terms
        yield Line("M30")
        yield Line(f"END {frame}")

    def tools(self, cuts: Sequence[Terms]) -> Iterator[Line]:
        """TOOL DEF of every tool."""
        for number, diameter in {cut.tool: cut.diameter for cut in cuts}.items():
            yield Line(f"TOOL DEF {number} L+0 R{self.length(diameter / 2)}")

    def tool(self, cut: Terms, before: Terms | None) -> Iterator[Line]:
        """TOOL CALL where the tool, its speed or what it leaves changes; then up."""
        if before is None or (before.tool, before.stock, before.speed) != (cut.tool, cut.stock, cut.speed):
            stock = f" DR{self.length(cut.stock)}" if cut.stock else ""
            yield Line(f"TOOL CALL {cut.tool} Z S{round(cut.speed)}{stock}")
            yield Line(f"L Z{self.length(cut.travel)} R0 FMAX M3")
        else:
            yield Line(f"L Z{self.length(cut.travel)} R0 FMAX")

    def cut(self, cut: Cut, shape: Programmed) -> Iterator[Line]:
        """One run: down, in, along, out, up."""
        whole = cut.compensated.whole
        (x, y), (bx, by) = whole.points[0].tolist(), whole.points[-1].tolist()
        feeds = [cut.feeds[int(number)] for number in shape.segments]
        yield Line(f"L {self.place((x, y))} R0 FMAX")
        yield Line(f"L Z{self.length(cut.near)} R0 FMAX")
        yield Line(f"L Z{self.length(cut.depth)} R0 F{self.feed(cut.plunge_feed)}")
        yield self.begin(cut, shape, feeds[0])
        for element, feed, segment in zip(shape.elements, feeds, shape.segments, strict=True):
            yield from self.element(element, feed, segment)
        blend = blend_of(cut.compensated)
        last = shape.segments[-1]
        yield Line(f"DEP CT CCA+90 R{self.length(blend)}" if blend else f"L {self.place((bx, by))} R0", last)
        yield Line(f"L Z{self.length(cut.leave)} R0 FMAX")

    def plain(self, one: Plain) -> Iterator[Line]:
        """One run without compensation, as its moves are."""
        x, y, z = self.at((0.0, 0.0), one.travel)
        for travel in one.travels:
            start, (x, y, z) = (x, y, z), self.at((travel.x, travel.y), travel.z)
            feed = "FMAX" if travel.feed is None else f"F{self.feed(travel.feed)}"
            if not travel.turn:
                words = [
                    new for new, old in zip((x, y, z), start, strict=True) if new != old or travel is one.travels[0]
                ]
                if words:
                    yield Line(f"L {' '.join(words)} R0 {feed}", travel=travel)
                continue
            cx, cy = travel.center
            yield Line(f"CC X{self.length(cx)} Y{self.length(cy)}")
            sense = "+" if travel.turn > 0 else "-"
            if z == start[2]:
                yield Line(f"C {x} {y} DR{sense} R0 {feed}", travel=travel)
            else:
                angle = self.turned(start, (x, y), travel)
                yield Line(f"CP IPA{sense}{angle:.6f} {z} DR{sense} R0 {feed}", travel=travel)

    def at(self, point: Point, height: float) -> tuple[str, str, str]:
        """X, Y and Z as words."""
        return f"X{self.length(point[0])}", f"Y{self.length(point[1])}", f"Z{self.length(height)}"

    def turned(self, start: tuple[str, str, str], end: tuple[str, str], travel: Travel) -> float:
        """Degrees that a helix turns between places as they are written."""
        (sx, sy), (ex, ey) = ([to_mm(float(word[1:]), self.unit) for word in words[:2]] for words in (start, end))
        return degrees(sweep((sx, sy), (ex, ey), travel.center, travel.turn) or tau)

    def begin(self, cut: Cut, shape: Programmed, feed: float) -> Line:
        """APPR CT onto the first element, or a straight block with RL or RR."""
        word, blend = "RL" if cut.compensated.side is Side.LEFT else "RR", blend_of(cut.compensated)
        start = self.place(shape.elements[0].start)
        text = f"APPR CT {start} CCA+90 R{self.length(blend)} {word} F{self.feed(feed)}" if blend else ""
        return Line(text or f"L {start} {word}", shape.segments[0])

    def element(self, element: Element, feed: float, segment: float) -> Iterator[Line]:
        """One element, an arc on two lines."""
        end, at = self.place(element.end), f"F{self.feed(feed)}"
        if element.turn:
            cx, cy = element.center
            yield Line(f"CC X{self.length(cx)} Y{self.length(cy)}", segment)
            yield Line(f"C {end} DR{'+' if element.turn > 0 else '-'} {at}", segment)
        else:
            yield Line(f"L {end} {at}", segment)

    def place(self, point: Point) -> str:
        """X and Y."""
        return f"X{self.length(point[0])} Y{self.length(point[1])}"

    def length(self, value: float) -> str:
        """A length with its sign, as fine as the control takes it."""
        text = f"{from_mm(value, self.unit):+.{DECIMALS[self.unit]}f}".rstrip("0").rstrip(".")
        return "+0" if text in ("+0", "-0", "+", "-") else text

    def feed(self, value: float) -> str:
        """A feed."""
        return f"{from_mm(value, self.unit):.3f}".rstrip("0").rstrip(".")
