"""LinuxCNC 2.9: compensation with one move of look-ahead.

The first move ends square to itself.  After that one move in the plane is held back until the next one is known; Z
moves may stand behind it in the queue.  An outside corner gets an arc, an inside corner moves the ends of what is held,
and anything under 0.05 radians is taken as tangent.  G40 lets the held move end square; the next move goes straight
from there to its own point.
"""

from __future__ import annotations

from math import hypot, pi
from typing import Final, NamedTuple

from core.controls.corners import Element, meetings, offset_radius, square_end, square_start, sweep, turning
from core.controls.dialect import Arcs, Dialect, Do, codes
from core.controls.follower import Follower
from core.controls.moves import Plane
from core.controls.report import Log, Run
from core.controls.runner import execute
from core.controls.tools import ToolTable
from core.controls.words import Block, whole
from core.finding import Severity
from core.geometry.piece import Point
from core.geometry.side import Side
from core.units import Unit

TANGENT: Final = 0.05
"""Radians under which a corner is none."""

NO_FIT: Final = "The cutter does not fit into this corner without gouging; use a smaller cutter or open the corner."

_ARCS: Final = Arcs(inch=0.002828427, mm=0.02828427, worst=100.0)

DIALECT: Final = Dialect(
    "linuxcnc",
    codes(
        ("motion", Do.CYCLE, (730, 740)),
        ("compensation", Do.SIDE, (411, 421)),
        ("centres", Do.CENTRES, (901, 911)),
        ("system", Do.SYSTEM, (591, 592, 593)),
        ("length", Do.MODE, (431, 432)),
        ("path", Do.MODE, (610, 611, 640)),
        ("spindle", Do.MODE, (960, 970)),
        ("retract", Do.MODE, (980, 990)),
        ("lathe", Do.MODE, (80,)),
        ("once", Do.SHIFT, (520,)),
        ("once", Do.MACHINE, (530,)),
        ("once", Do.DATA, (100,)),
        ("once", Do.UNSHIFT, (921, 922)),
    ),
    Unit.MM,
    mode=None,
    arcs=_ARCS,
    moves_alone=True,
    feed_needed=True,
    table_needed=True,
    unit_first=False,
    percent_ends=True,
    end_needed=True,
    group_rule="N-TWOG",
)

REFUSED: Final = {
    **dict.fromkeys((520, 920, 921, 922, 100), ("N-OFFSETS", "changes the origin")),
    **dict.fromkeys((540, 550, 560, 570, 580, 590, 591, 592, 593), ("N-OFFSETS", "changes the work offset")),
    **dict.fromkeys((280, 300), ("N-HOME", "goes to the reference point")),
    530: ("N-G53", "moves in machine coordinates"),
    **dict.fromkeys((610, 611, 640), ("N-MODE", "changes the path mode")),
    **dict.fromkeys((980, 990), ("N-MODE", "changes the retract mode")),
    **dict.fromkeys((730, 740, *range(810, 900, 10)), ("N-CYCLE", "is a drilling cycle")),
}
"""What G codes are refused while compensation is on: rule and reason."""


class Held(NamedTuple):
    """A move that waits: where it would end, and its rapid or feed element; Z moves have their own element."""

    element: Element
    end: Point


class LookAhead(Follower):
    """The queue of LinuxCNC; `radius` signed, positive on the left, in millimetres."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.offset = 0.0
        self.first = True
        self.queue: list[Held] = []
        self.started: Point | None = None
        self.no_arc = False

    def watch(self, block: Block) -> None:
        """Codes that compensation does not allow."""
        for code in block.g:
            self._refused(code, block)

    def _refused(self, code: int, block: Block) -> None:
        column = block.column("G", code)
        if code in REFUSED:
            rule, what = REFUSED[code]
            text = f"G{code / 10:g} {what}, which is not allowed under compensation; write G40 before it."
            self.log.stop(rule, text, block.line, column)
        if code in (170, 180, 190) and _PLANES[code] is not self.machine.plane:
            text = "The plane cannot be changed under compensation; write G40 before it."
            self.log.stop("N-PLANE", text, block.line, column)

    def begin(self, side: Side, block: Block) -> None:
        """G41, G42, G41.1 and G42.1."""
        if self.machine.plane is Plane.YZ:
            text = "Compensation works in the planes G17 and G18 only; write one of them before it."
            self.log.stop("N-XZYZ", text, block.line, block.column("G"))
        if self.active:
            text = "Compensation is on already; write G40 before it is turned on again."
            self.log.stop("N-ONWHENON", text, block.line, block.column("G"))
        radius = self.radius(block)
        self.offset = radius * side.sign
        self.active = self.watching = True
        self.first = True

    def radius(self, block: Block) -> float:
        """The radius asked for, millimetres; negative flips the side."""
        if not {411, 421}.isdisjoint(block.g):
            if "D" not in block.words:
                text = "G41.1 and G42.1 need D and the cutter's diameter."
                self.log.stop("N-DMISSING", text, block.line, block.column("G"))
            self._orientation(block)
            return block.words["D"] * self.machine.scale / 2
        number = self.machine.tool
        if "D" in block.words:
            number = self._tool_number(block)
        tool = self.machine.tools.get(number)
        if tool is None:
            if number == 0 or "D" not in block.words:
                text = "No tool is loaded, so the radius is 0 and nothing is compensated."
                self.log.tell(Severity.WARNING, "RADIUS0", text, block.line, block.column("G"))
                return 0.0
            text = f"The tool table has no tool {number}; enter it, or write the number of one that is there."
            self.log.stop("N-DBIG", text, block.line, block.column("D"))
        return tool.diameter_mm(self.machine.unit) / 2

    def _tool_number(self, block: Block) -> int:
        number = whole(block.words["D"])
        if number is None or number < 0:
            text = "D is a tool number: a whole number, not below 0; a diameter goes with G41.1."
            self.log.stop("N-DNEGATIVE", text, block.line, block.column("D"))
        return number

    def _orientation(self, block: Block) -> None:
        if "L" in block.words and self.machine.plane is not Plane.ZX:
            text = "L, the orientation of a lathe tool, goes with G18 only; leave it out."
            self.log.stop("N-ORIENTATION", text, block.line, block.column("L"))

    def finish(self, block: Block) -> None:
        """G40: what is held ends square."""
        if self.active and self.offset and not self.first:
            self._move_ends(square_end(self._front, self.offset), block.line)
            self.no_arc = True
            self.leave(entry=1, exits=0)
        self.active = self.watching = False
        self.first = True

    def close(self) -> None:
        """The end of the program: what is held ends square."""
        if self.queue:
            self._move_ends(square_end(self._front, self.offset), self.queue[-1].element.line)

    def travel(self, element: Element) -> None:
        """One element: alone, as entry, or against what is held."""
        if element.turn and self.no_arc:
            text = "The first move after G40 is straight; write a line before the arc."
            self.log.stop("N-ARCEXIT", text, element.line, 1)
        self.no_arc = False
        if not self.active or not self.offset:
            super().travel(element)
        elif self.first:
            self._enter(element)
        elif element.moves:
            self._corner(element)
        else:
            self.note(element)
            self.queue.append(Held(element, square_end(self._front, self.offset)))

    @property
    def _front(self) -> Element:
        return self.queue[0].element

    def _enter(self, element: Element) -> None:
        """The first move: longer than the radius, and square to itself at its end."""
        length = hypot(element.end[0] - element.start[0], element.end[1] - element.start[1])
        if length <= abs(self.offset):
            text = "The entry move is {0} long and the radius is {1}; it has to be longer than the radius."
            self.log.stop("N-GOUGE", text, element.line, 1, lengths=(length, abs(self.offset)))
        if element.turn and offset_radius(element, self.offset) <= 0.0:
            self._too_small(element)
        side = Side.LEFT if self.offset > 0.0 else Side.RIGHT
        self.open_span(side, self.offset, element)
        self.note(element)
        end = square_end(element, self.offset)
        self.queue = [Held(self._as_entry(element, end), end)]
        self.started = None if element.turn else element.start
        self.first = False

    def _as_entry(self, element: Element, end: Point) -> Element:
        """The entry as it runs; LinuxCNC does not look whether a later trim turns it round."""
        if not element.turn:
            return element._replace(leaving=(0.0, 0.0))
        return element._replace(start=element.end, centre=self._entry_centre(element, end))

    def _entry_centre(self, element: Element, end: Point) -> Point:
        """The centre of the entry arc: from the present point to the square end, with the programmed tangent there."""
        (sx, sy), (ex, ey), (cx, cy) = element.start, end, element.centre
        half = hypot(sx - ex, sy - ey) / 2
        reach = hypot(cx - ex, cy - ey) or 1.0
        way = ((cx - ex) / reach, (cy - ey) / reach)
        lean = ((sx - ex) * way[0] + (sy - ey) * way[1]) / (2 * half)
        if abs(lean) < 1e-6:
            self._too_small(element)
        return ex + way[0] * half / lean, ey + way[1] * half / lean

    def _too_small(self, element: Element) -> None:
        text = "The arc's radius {0} is not larger than the cutter's {1}; use a smaller cutter or a larger arc."
        self.log.stop("N-ARCRADIUS", text, element.line, 1, lengths=(element.radius, abs(self.offset)))

    def _corner(self, element: Element) -> None:
        """A further move in the plane, against the one that is held."""
        if element.turn and element.turn * self.offset > 0.0 and offset_radius(element, self.offset) <= 0.0:
            self._too_small(element)
        front = self._front
        angle = turning(front, element) * (1 if self.offset > 0.0 else -1)
        back = abs(angle) > pi - TANGENT
        if (angle > TANGENT and not back) or (back and self._hooks(front, element)):
            self._inside(front, element)
        elif angle < -TANGENT or back:
            self._outside(front, element)
        else:
            self._run_queue()
            self.started = square_end(front, self.offset)
        self.note(element)
        self.queue = [Held(element, square_end(element, self.offset))]

    def _hooks(self, front: Element, element: Element) -> bool:
        """Reversals that are inside corners: off the top of an arc, or onto one, with the cutter outside of it."""
        bent = element.turn or front.turn
        return bent * self.offset < 0.0

    def _inside(self, front: Element, element: Element) -> None:
        points = meetings(front, element, self.offset)
        if not points:
            self.log.stop("N-CONCAVE", NO_FIT, element.line, 1, at=element.start)
        self._move_ends(points[self._which(front, element)] if len(points) > 1 else points[0], element.line)

    def _which(self, front: Element, element: Element) -> int:
        """Which of two meetings: along a line the first one outside its arc, two arcs by the side they bend to."""
        if not front.turn:
            return 1 if element.turn * self.offset > 0.0 else 0
        if not element.turn:
            return 0 if front.turn * self.offset > 0.0 else 1
        return 0 if (front.turn * self.offset > 0.0) == (element.turn > 0) else 1

    def _outside(self, front: Element, element: Element) -> None:
        corner = square_end(front, self.offset)
        if element.turn:
            self._run_queue()
        else:
            self._move_ends(corner, element.line)
        start = square_start(element, self.offset)
        if element.rapid:
            self.straight(element, start, low=True)
        else:
            self.bend(element, start, element.start, -1 if self.offset > 0.0 else 1, element.low)
        self.started = start

    def _move_ends(self, point: Point, line: int) -> None:
        """Everything held ends at this point instead; a move that would run backwards stops the program."""
        for held in self.queue:
            if held.element.turn:
                self._check_arc(held, point, line)
            elif self.started is not None:
                self._check_line(held, point, line)
        self.queue = [held._replace(end=point) for held in self.queue]
        self._run_queue()
        self.started = point

    def _check_line(self, held: Held, point: Point, line: int) -> None:
        way, start = held.element.leaving, self.started or point
        if (point[0] - start[0]) * way[0] + (point[1] - start[1]) * way[1] < 0.0:
            self.log.stop("N-CONCAVE", NO_FIT, line, 1, at=held.element.end)

    def _check_arc(self, held: Held, point: Point, line: int) -> None:
        element = held.element
        if self.started is None:
            return
        swept = sweep(element.start, element.end, element.centre, element.turn) or 2 * pi
        now = sweep(self.started, point, element.centre, element.turn) or 2 * pi
        slack = 0.001 if self.machine.unit is Unit.IN else 0.0254
        if now > swept + slack:
            self.log.stop("N-CONCAVE", NO_FIT, line, 1, at=element.end)

    def _run_queue(self) -> None:
        for element, end in self.queue:
            if element.turn:
                self.arc(element, end, element.centre)
            else:
                self.straight(element, end)
        self.queue = []
        self.started = None


_PLANES: Final = {170: Plane.XY, 180: Plane.ZX, 190: Plane.YZ}


def run(text: bytes, _: str, tools: ToolTable) -> Run:
    """A program as LinuxCNC runs it; there are no variants."""
    return execute(text, "linuxcnc", DIALECT, tools, Log(), LookAhead)
