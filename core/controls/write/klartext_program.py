"""Klartext programs are compensated contours written with RL and RR.

The contour is written, not the tool's path, and the control offsets it.  Blend moves become APPR CT and DEP CT over 90
degrees; without them the tool goes down on the path's first point, and RL takes effect there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees, dist, tau
from typing import Final

from core.controls.compensation.elements import sweep
from core.controls.write.contour_pass import (
    CenterMove,
    CompensatedPass,
    ContourPass,
    PassToWrite,
    PassWithLeads,
    ProgrammedElements,
    UncompensatedPass,
    WrittenLine,
    blend_of,
    path_begin,
    path_finish,
    programmed_elements,
)
from core.finding import Finding
from core.geometry.piece import Point, Side
from core.units import Unit, from_mm, to_mm

KLARTEXT_DECIMALS: Final = {Unit.IN: 5, Unit.MM: 4}
"""Decimals that the control accepts."""

_Run = PassWithLeads | UncompensatedPass


def write_klartext(
    cuts: Sequence[PassToWrite], name: str, unit: Unit, remarks: Sequence[str] = ()
) -> tuple[WrittenLine, ...] | Finding:
    """Return the lines of the program, or why the control's own compensation would not run one of these paths."""
    runs: list[_Run] = []
    for cut in cuts:
        if isinstance(cut, UncompensatedPass):
            runs.append(cut)
            continue
        shape = programmed_elements(cut.compensated)
        if isinstance(shape, Finding):
            return shape
        start, out = path_begin(cut.compensated).at, path_finish(cut.compensated).at
        runs.append(PassWithLeads(cut, cut.compensated.side, shape, start, shape.elements[0].start, out))
    lines = _Writer(unit).program(runs, name, remarks)
    return tuple(line._replace(text=f"{number} {line.text}") for number, line in enumerate(lines))


def write_klartext_contours(runs: Sequence[PassWithLeads], unit: Unit) -> tuple[WrittenLine, ...]:
    """Return the lines of a program that enters and leaves contours square to them, with APPR LN and DEP LN."""
    return tuple(_Writer(unit).program(runs, "CONTOUR", ()))


@dataclass(frozen=True, slots=True)
class _Writer:
    """Writes blocks in one unit."""

    unit: Unit

    def program(self, runs: Sequence[_Run], name: str, remarks: Sequence[str]) -> Iterator[WrittenLine]:
        """Yield all lines from BEGIN PGM to END PGM: remarks after a semicolon, every tool's TOOL DEF, the runs."""
        frame = f"PGM {name} {'INCH' if self.unit is Unit.IN else 'MM'}"
        yield WrittenLine(f"BEGIN {frame}")
        yield from (WrittenLine(f"; {remark}") for remark in remarks)
        passes = [run.contour_pass if isinstance(run, PassWithLeads) else run for run in runs]
        for number, diameter in {contour_pass.tool: contour_pass.diameter for contour_pass in passes}.items():
            yield WrittenLine(f"TOOL DEF {number} L+0 R{self.length(diameter / 2)}")
        before: ContourPass | None = None
        for run, contour_pass in zip(runs, passes, strict=True):
            yield from self.tool(contour_pass, before)
            moves = self.cut(run) if isinstance(run, PassWithLeads) else self.plain(run)
            yield from (line._replace(block=contour_pass.block) for line in moves)
            before = contour_pass
        yield WrittenLine("M30")
        yield WrittenLine(f"END {frame}")

    def elements(self, cut: ContourPass, shape: ProgrammedElements) -> Iterator[WrittenLine]:
        """Yield the elements of a run with their feeds; an arc takes two lines."""
        for element, segment in zip(shape.elements, shape.segments, strict=True):
            end, feed = self.place(element.end), f"F{self.feed(cut.feeds[int(segment)])}"
            if element.turn:
                yield WrittenLine(f"CC {self.place(element.center)}", segment)
                yield WrittenLine(f"C {end} DR{'+' if element.turn > 0 else '-'} {feed}", segment)
            else:
                yield WrittenLine(f"L {end} {feed}", segment)

    def tool(self, cut: ContourPass, before: ContourPass | None) -> Iterator[WrittenLine]:
        """Yield TOOL CALL if the tool, its speed or its stock changes; then the move up."""
        same = before is not None and (before.tool, before.stock, before.speed) == (cut.tool, cut.stock, cut.speed)
        if not same:
            stock = f" DR{self.length(cut.stock)}" if cut.stock else ""
            yield WrittenLine(f"TOOL CALL {cut.tool} Z S{round(cut.speed)}{stock}")
        up = self.length(cut.travel)
        # the pass before has left the tool at this height already
        if before is None or not same or self.length(_end_height(before)) != up:
            yield WrittenLine(f"L Z{up} R0 FMAX{'' if same else ' M3'}")

    def cut(self, run: PassWithLeads) -> Iterator[WrittenLine]:
        """Yield one run: down, in, along, out, up."""
        cut = run.contour_pass
        into, off = self.leads(run)
        yield WrittenLine(f"L {self.place(run.start)} R0 FMAX")
        yield WrittenLine(f"L Z{self.length(cut.near)} R0 FMAX")
        yield WrittenLine(f"L Z{self.length(cut.depth)} R0 F{self.feed(cut.plunge_feed)}")
        yield into
        yield from self.elements(cut, run.shape)
        yield off
        yield WrittenLine(f"L Z{self.length(cut.leave)} R0 FMAX")

    def leads(self, run: PassWithLeads) -> tuple[WrittenLine, WrittenLine]:
        """Return the moves into a contour and out of it: its own, or straight ones square to it."""
        cut, first, last = run.contour_pass, run.shape.segments[0], run.shape.segments[-1]
        word, feed = "RL" if run.side is Side.LEFT else "RR", f"F{self.feed(cut.feeds[int(first)])}"
        start = self.place(run.to)
        if not isinstance(cut, CompensatedPass):
            length = self.length(dist(run.start, run.to) - cut.diameter / 2)
            into, off = f"APPR LN {start} LEN{length} {word} {feed}", f"DEP LN LEN{length}"
            return WrittenLine(into, first, lead=True), WrittenLine(off, last, lead=True)
        if blend := blend_of(cut.compensated):
            into = f"APPR CT {start} CCA+90 R{self.length(blend)} {word} {feed}"
            return WrittenLine(into, first), WrittenLine(f"DEP CT CCA+90 R{self.length(blend)}", last)
        return WrittenLine(f"L {start} {word}", first), WrittenLine(f"L {self.place(run.out)} R0", last)

    def plain(self, run: UncompensatedPass) -> Iterator[WrittenLine]:
        x, y, z = self.at((0.0, 0.0), run.travel)
        for travel in run.travels:
            start, (x, y, z) = (x, y, z), self.at((travel.x, travel.y), travel.z)
            feed = "FMAX" if travel.feed is None else f"F{self.feed(travel.feed)}"
            if not travel.turn:
                words = [
                    new for new, old in zip((x, y, z), start, strict=True) if new != old or travel is run.travels[0]
                ]
                if words:
                    yield WrittenLine(f"L {' '.join(words)} R0 {feed}", travel=travel)
                continue
            yield WrittenLine(f"CC {self.place(travel.center)}")
            sense = "+" if travel.turn > 0 else "-"
            if z == start[2]:
                yield WrittenLine(f"C {x} {y} DR{sense} R0 {feed}", travel=travel)
            else:
                angle = self.turned(start, (x, y), travel)
                yield WrittenLine(f"CP IPA{sense}{angle:.6f} {z} DR{sense} R0 {feed}", travel=travel)

    def at(self, point: Point, height: float) -> tuple[str, str, str]:
        return f"X{self.length(point[0])}", f"Y{self.length(point[1])}", f"Z{self.length(height)}"

    def turned(self, start: tuple[str, str, str], end: tuple[str, str], travel: CenterMove) -> float:
        """Return the degrees that a helix turns between its ends as written."""
        (sx, sy), (ex, ey) = ([to_mm(float(word[1:]), self.unit) for word in words[:2]] for words in (start, end))
        return degrees(sweep((sx, sy), (ex, ey), travel.center, travel.turn) or tau)

    def place(self, point: Point) -> str:
        return f"X{self.length(point[0])} Y{self.length(point[1])}"

    def length(self, value: float) -> str:
        """Return a length with its sign, as fine as the control accepts."""
        text = f"{from_mm(value, self.unit):+.{KLARTEXT_DECIMALS[self.unit]}f}".rstrip("0").rstrip(".")
        return "+0" if text in ("+0", "-0", "+", "-") else text

    def feed(self, value: float) -> str:
        return f"{from_mm(value, self.unit):.3f}".rstrip("0").rstrip(".")


def _end_height(cut: ContourPass) -> float:
    return cut.travels[-1].z if isinstance(cut, UncompensatedPass) and cut.travels else cut.leave
