"""ISO programs are compensated contours written for a word-address control's own G41 or G42.

The contour is written as typed, and the control offsets it.  The tool goes down away from the part, enters along a
straight line onto the blend, and leaves the same way; without a blend the line itself ends on the path.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from typing import Final

from core.controls.compensation.elements import Element
from core.controls.control_tools import CutterTool, ToolTable, table_of
from core.controls.write.contour_pass import (
    CenterMove,
    ContourPass,
    PassWithLeads,
    UncompensatedPass,
    WrittenLine,
    number_text,
)
from core.controls.write.iso_style import IsoStyle, Radius
from core.geometry.piece import Point, Side
from core.units import Unit, from_mm

FIRST_STOCK_OFFSET: Final = 51
"""First offset number for the radii of runs that leave stock."""

CORNER_TOLERANCE: Final = {Unit.IN: "0.0002", Unit.MM: "0.005"}
"""How far the machine may leave the path at a corner, in program units."""


def offsets(cuts: Sequence[ContourPass], style: IsoStyle) -> dict[tuple[int, float], int]:
    """Return the numbers under which a control finds the radii, by tool and by the stock it leaves."""
    numbers: dict[tuple[int, float], int] = {}
    free = count(FIRST_STOCK_OFFSET)
    for cut in cuts:
        key = (cut.tool, cut.stock)
        if key not in numbers:
            numbers[key] = next(free) if cut.stock and style.radius is Radius.OFFSET else cut.tool
    return numbers


def tools_of(cuts: Sequence[ContourPass], style: IsoStyle) -> ToolTable:
    """Return the tool or offset table that the program needs, in millimeters; none if its text has the diameters."""
    if style.radius is Radius.DATA:
        return {}
    numbers = offsets(cuts, style)
    stock = style.radius is Radius.OFFSET
    return table_of(
        *(
            CutterTool(numbers[cut.tool, cut.stock], cut.diameter + (2 * cut.stock if stock else 0.0), unit=Unit.MM)
            for cut in cuts
        )
    )


def write_iso(
    cuts: Sequence[PassWithLeads | UncompensatedPass],
    style: IsoStyle,
    unit: Unit,
    remarks: Sequence[str] = (),
    work_offset: int = 54,
) -> tuple[WrittenLine, ...]:
    """Return the lines of the program; `remarks` are ready comment lines, which follow the style's head."""
    passes = [run if isinstance(run, UncompensatedPass) else run.contour_pass for run in cuts]
    writer = _Writer(style, unit, offsets(passes, style))
    code = style.inch if unit is Unit.IN else style.metric
    offset, rounding = f"G{work_offset}", CORNER_TOLERANCE[unit]
    texts = [*style.head, *(remarks if style.comments else ())]
    texts += [safe.format(unit=code, offset=offset, rounding=rounding) for safe in style.safe]
    if style.corner_code:
        texts.append(style.corner_code)
    lines = [WrittenLine(text) for text in texts]
    before: ContourPass | None = None
    for run, contour_pass in zip(cuts, passes, strict=True):
        lines += writer.tool(contour_pass, before)
        moves = writer.plain(run) if isinstance(run, UncompensatedPass) else writer.cut(run)
        lines += (line._replace(block=contour_pass.block) for line in moves)
        before = contour_pass
    return (*lines, *map(WrittenLine, ("M5", "M30", *style.tail)))


class _Writer:
    """Writes words in one style, with `offsets` by tool and stock.

    `feed`, `height` and `at` are the modal state, as text; `tool_length` has the words for the next rapid in Z.
    """

    def __init__(self, style: IsoStyle, unit: Unit, offsets: Mapping[tuple[int, float], int]) -> None:
        self.style = style
        self.unit = unit
        self.offsets = offsets
        self.feed = ""
        self.height = ""
        self.at: tuple[str, str] = ("", "")
        self.tool_length: tuple[str, ...] = ()

    def tool(self, cut: ContourPass, before: ContourPass | None) -> Iterator[WrittenLine]:
        """Yield the changes of tool, tool data and speed; F is written again after one, where a run may restart."""
        speed = f"S{speed_text(cut.speed)}"
        changed = before is None or before.tool != cut.tool
        if changed and before is not None:
            yield WrittenLine("M5")
        if self.style.radius is Radius.DATA and (before is None or changed or before.stock != cut.stock):
            yield WrittenLine(f"T{cut.tool}//{self.length(cut.diameter + 2 * cut.stock)}")
        if before is None or changed:
            self.feed = self.height = ""
            yield self.words(f"T{cut.tool}", "M6")
            if self.style.length:
                # in a block of its own, some controls would move Z by the length at once
                self.tool_length = ("G43", f"H{cut.tool}")
            yield self.words(speed, "M3")
        elif before.speed != cut.speed:
            yield WrittenLine(speed)

    def cut(self, run: PassWithLeads) -> Iterator[WrittenLine]:
        """Yield one run: down away from the part, in, along, out, up."""
        cut, shape = run.contour_pass, run.shape
        in_plunge = self.style.radius is Radius.DATA
        down = ("G1", self.code(run)) if in_plunge else ("G1",)
        yield from self.rapid(cut.travel)
        yield self.words("G0", *self.place(run.start))
        yield from self.rapid(cut.near)
        yield self.words(*down, f"Z{self.length(cut.depth)}", *self.feed_word(cut.plunge_feed))
        feeds = [cut.feeds[int(number)] for number in shape.segments]
        words = ("G1",) if in_plunge else (*self.switch(run), "G1")
        into = self.words(*words, *self.place(run.to), *self.feed_word(feeds[0]), segment=shape.segments[0])
        yield into._replace(lead=True)
        for element, feed, segment in zip(shape.elements, feeds, shape.segments, strict=True):
            yield from self.element(element, feed, segment)
        yield self.words("G40", "G1", *self.place(run.out), segment=shape.segments[-1])._replace(lead=True)
        self.height = ""
        yield from self.rapid(cut.leave)

    def plain(self, run: UncompensatedPass) -> Iterator[WrittenLine]:
        yield from self.rapid(run.travel)
        first, *rest = run.travels
        yield self.words("G0", *self.place((first.x, first.y)))._replace(travel=first)
        for travel in rest:
            yield from self.traveled(travel)

    def traveled(self, travel: CenterMove) -> Iterator[WrittenLine]:
        """Yield a move with the words that change; nothing if it makes no move as written."""
        start, height = self.at, self.height
        self.height, place = f"Z{self.length(travel.z)}", self.place((travel.x, travel.y))
        up = (self.height,) if self.height != height else ()
        if travel.turn:
            words = ("G2" if travel.turn < 0 else "G3", *place, *up, *self.center(travel.center, start))
        elif place != start or up:
            words = ("G0" if travel.feed is None else "G1", *(place if place != start else ()), *up)
        else:
            return
        yield self.words(*words, *(() if travel.feed is None else self.feed_word(travel.feed)))._replace(travel=travel)

    def rapid(self, height: float) -> Iterator[WrittenLine]:
        """Yield a rapid to a height, unless the tool is there already."""
        text = f"Z{self.length(height)}"
        if text != self.height:
            self.height, length, self.tool_length = text, self.tool_length, ()
            yield self.words("G0", *length, text)

    def code(self, run: PassWithLeads) -> str:
        return "G41" if run.side is Side.LEFT else "G42"

    def switch(self, run: PassWithLeads) -> tuple[str, ...]:
        """Return the words that turn compensation on in the entry block."""
        code, cut = self.code(run), run.contour_pass
        if cut.stock and self.style.radius is Radius.DIAMETER:
            return f"{code}.1", f"D{self.length(cut.diameter + 2 * cut.stock)}"
        offset = f"D{self.offsets[cut.tool, cut.stock]}"
        reduced = cut.stock and self.style.radius is Radius.REDUCED
        return (code, offset, f"I{self.length(-cut.stock)}") if reduced else (code, offset)

    def element(self, element: Element, feed: float, segment: float) -> Iterator[WrittenLine]:
        """Yield one element; skip it if it makes no move as written."""
        start, end = self.at, self.place(element.end)
        whole = element.turn != 0 and element.start == element.end
        if start == end and not whole:
            return
        code = "G1" if not element.turn else "G2" if element.turn < 0 else "G3"
        center = self.center(element.center, start) if element.turn else ()
        yield self.words(code, *end, *center, *self.feed_word(feed), segment=segment)

    def center(self, center: Point, start: tuple[str, str]) -> tuple[str, str]:
        """Return I and J, from the origin or from the start as written."""
        x, y = (from_mm(value, self.unit) for value in center)
        if not self.style.absolute:
            x, y = x - float(start[0][1:]), y - float(start[1][1:])
        digits = self.style.digits(self.unit)
        return f"I{number_text(x, Unit.MM, digits)}", f"J{number_text(y, Unit.MM, digits)}"

    def place(self, point: Point) -> tuple[str, str]:
        """Return the words X and Y, and keep them as the position."""
        self.at = f"X{self.length(point[0])}", f"Y{self.length(point[1])}"
        return self.at

    def length(self, value: float) -> str:
        return number_text(value, self.unit, self.style.digits(self.unit))

    def feed_word(self, feed: float) -> tuple[str, ...]:
        """Return the F word if the feed changes."""
        text = f"F{number_text(feed, self.unit, 3)}"
        if text == self.feed:
            return ()
        self.feed = text
        return (text,)

    def words(self, *words: str, segment: float | None = None) -> WrittenLine:
        return WrittenLine((" " if self.style.spaced else "").join(words), segment)


def speed_text(speed: float) -> str:
    """Return a spindle speed without a needless decimal."""
    return f"{speed:.1f}".removesuffix(".0")
