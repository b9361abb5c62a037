"""The modal machine of the word-address controls: blocks in, programmed elements out to a control's follower.

All positions are millimeters from the machine's zero as the program shifts it; work offsets nobody gave are zero.
"""

from __future__ import annotations

from math import dist, hypot
from typing import Final

from core.controls.compensation.corners import arc_element, element_sweep, line_element
from core.controls.compensation.follower import Follower
from core.controls.control_run import Log
from core.controls.control_tools import ToolTable
from core.controls.iso import cycles, origin, tooling, unused
from core.controls.iso.arcs import NoArc, about, given_center, through
from core.controls.iso.dialect import Code, Dialect, Do
from core.controls.iso.rates import PER_MINUTE, Rates
from core.controls.iso.words import Block, whole
from core.controls.moves import Plane, Point3, flat
from core.finding import Severity
from core.geometry.piece import Point, Side
from core.tolerance import ON_PATH
from core.units import Unit

_UNUSED: Final = "ABCUVW"
_PLANES: Final = {170: Plane.XY, 180: Plane.ZX, 190: Plane.YZ}
_METRIC: Final = (210, 710)
_TURNS: Final = {20: -1, 30: 1}
_ORDER: Final = {Do.PLANE: 1, Do.UNITS: 2, Do.DISTANCE: 3, Do.OWN: 4, Do.SIDE: 5}
_LATEST: Final = 9


class Machine:
    """What is in force, block by block.

    `position` is the programmed point and `shift` the origin the program works from, x, y, z in millimeters; `tool`
    the number in force for compensation, 0 for none; `unit` that of the words; `feed` in millimeters a minute.
    """

    def __init__(self, dialect: Dialect, follower: Follower, tools: ToolTable, log: Log) -> None:
        self.dialect = dialect
        self.follower = follower
        follower.machine = self
        self.tools = tools
        self.log = log
        self.unit = dialect.unit
        self.scale = 25.4 if dialect.unit is Unit.IN else 1.0
        self.moved_in: Unit | None = None
        self.unit_said = False
        self.mode = dialect.mode
        self.plane = Plane.XY
        self.position: Point3 = (0.0, 0.0, 0.0)
        self.shift: Point3 = (0.0, 0.0, 0.0)
        self.origin = origin.Origin()
        self.incremental = False
        self.absolute_centers = dialect.arcs.absolute
        self.feed = 0.0
        self.rates = Rates()
        self.cycles = cycles.Cycles(to_r=dialect.returns_to_r)
        self.tool = 0
        self.next_tool = 0
        self.ended = False

    def step(self, block: Block) -> None:
        """Runs one block: its codes in the order the controls take them, then its motion."""
        if self.follower.watching:
            self.follower.watch(block)
        if block.moves_only:
            if block.g:
                self.mode, self.cycles.code = block.g[0], None
            if self.dialect.tells_unused and self.mode in (0, 10) and not _CENTERS.isdisjoint(block.words):
                unused.tell(self, block)
            if self.mode in _LINES and not _AXES.isdisjoint(block.words):
                self.straight(block, self.target(block.words))
            else:
                self._motion(block)
            return
        once = self._codes(block)
        if once is None:
            self._motion(block)
        else:
            origin.run_once(self, once, block)
        if block.m and not _ENDS.isdisjoint(block.m):
            self.ended = True

    def _codes(self, block: Block) -> Code | None:
        """Everything of a block but its motion; the code that takes the block's axis words for itself, if any."""
        codes = self._grouped(block)
        for code in codes:
            if code.do is Do.RATE:
                self.rates.set(code.value, self)
            elif code.do is Do.UNITS and self.dialect.unit_first:
                self._set(code, block)
        if not self.dialect.unit_first and "F" in block.words:
            self.feed = block.words["F"] * self.scale
        self.rates.take(block)
        tooling.take(self, block)
        self._warn_unused(block)
        once = None
        for code in codes:
            if code.do in origin.ONCE or (code.do is Do.DWELL and self.dialect.dwell_takes_axes):
                once = code
            else:
                self._set(code, block)
        if self.dialect.unit_first and "F" in block.words:
            self.feed = block.words["F"] * self.scale
        if self.dialect.tells_unused:
            unused.tell(self, block)
        return once

    def _grouped(self, block: Block) -> list[Code]:
        """A block's G codes in the order of execution; one that is unknown, or two of a group, stop the run."""
        known, groups = [], set()
        for number in block.g:
            code = self.dialect.codes.get(number)
            if code is None:
                text = f"G{number / 10:g} is not known here; leave it out or write what this control has for it."
                self.log.stop("CODE", text, block.line, block.column("G", number))
            if code.group in groups:
                text = f"G{number / 10:g} is the second G code of its group in this block; keep one."
                self.log.stop(self.dialect.group_rule, text, block.line, block.column("G", number))
            groups.add(code.group)
            known.append(code)
        known.sort(key=lambda code: _ORDER.get(code.do, 0 if code.do is Do.MOTION else _LATEST))
        return known

    def _set(self, code: Code, block: Block) -> None:
        match code.do:
            case Do.MOTION:
                self.mode, self.cycles.code = code.value, None
            case Do.CYCLE:
                self.mode = code.value
            case Do.PLANE:
                self.plane = self.follower.plane = _PLANES[code.value]
            case Do.UNITS:
                self.unit = Unit.MM if code.value in _METRIC else Unit.IN
                self.scale = 1.0 if self.unit is Unit.MM else 25.4
                self.unit_said = True
            case Do.DISTANCE:
                self.incremental = code.value == 910
            case Do.CENTERS:
                self.absolute_centers = code.value == 901
            case Do.SIDE:
                self._set_side(code.value, block)
            case Do.SYSTEM | Do.UNSHIFT:
                origin.changed(self, code, block)
            case _:
                self._set_other(code, block)

    def _set_other(self, code: Code, block: Block) -> None:
        match code.do:
            case Do.BEYOND:
                text = f"G{code.value / 10:g} is not worked out here, and what follows would be wrong; nothing does."
                self.log.stop("BEYOND", text, block.line, block.column("G", code.value))
            case Do.OWN:
                self.follower.own(code.value, block)
            case Do.SPINDLE:
                self.rates.set_speed(code.value)
            case Do.RETRACT:
                self.cycles.to_r = code.value == 990
            case _:
                pass

    def _set_side(self, code: int, block: Block) -> None:
        if code == 400:
            self.follower.finish(block)
        else:
            self.follower.begin(Side.LEFT if code // 10 == 41 else Side.RIGHT, block)

    def _warn_unused(self, block: Block) -> None:
        for letter in _UNUSED:
            if letter in block.words:
                text = f"{letter} is an axis that is not followed here; only X, Y and Z are."
                self.log.tell(Severity.WARNING, "AXIS", text, block.line, block.column(letter))

    def whole_word(self, block: Block, letter: str) -> int:
        """A word's value as a whole number, which it has to be."""
        number = whole(block.words[letter])
        if number is None or number < 0:
            self.log.stop("NUMBER", f"{letter} takes a whole number, not below 0.", block.line, block.column(letter))
        return number

    def target(self, words: dict[str, float]) -> Point3:
        """Where a block's axis words lead, in millimeters."""
        (x, y, z), scale = self.position, self.scale
        base = self.position if self.incremental else self.shift
        if "X" in words:
            x = base[0] + words["X"] * scale
        if "Y" in words:
            y = base[1] + words["Y"] * scale
        if "Z" in words:
            z = base[2] + words["Z"] * scale
        return x, y, z

    def _motion(self, block: Block) -> None:
        words, mode = block.words, self.mode
        if "X" in words or "Y" in words or "Z" in words or (mode in _TURNS and not _CENTERS.isdisjoint(words)):
            self._travel(block, mode)
        elif self.dialect.moves_alone and not _MOVES.isdisjoint(block.g):
            self._alone(block)
        elif self.follower.active:
            self.follower.idle(block)

    def _alone(self, block: Block) -> None:
        if self.mode in _TURNS:
            text = "The arc has neither end point nor center; write them."
            self.log.stop("ARC", text, block.line, block.column("G", self.mode))
        self.straight(block, self.position)

    def _travel(self, block: Block, mode: int | None) -> None:
        if mode in _TURNS:
            self._arc(block, _TURNS[mode])
        elif mode == 0 or mode == 10:
            self.straight(block, self.target(block.words))
        elif mode is None or mode == 800:
            text = "Axis words without a motion in force; write G0, G1, G2 or G3."
            self.log.stop("MOTION", text, block.line, block.column("XYZ"))
        else:
            cycles.drill(self, block)

    def straight(self, block: Block, end: Point3) -> None:
        """A straight move of a block."""
        rapid, feed = self.mode == 0, self.feed
        if not rapid and self.rates.mode != PER_MINUTE:
            feed = self.rates.feed(self, block, dist(self.position, end))
        elif not rapid and not feed:
            self.no_feed(block)
        if self.moved_in is None:
            self._first_motion(block)
        if self.plane is Plane.XY:
            ax, ay, low = self.position
            bx, by, high = end
        else:
            ax, ay, low = flat(self.position, self.plane)
            bx, by, high = flat(end, self.plane)
        self.position = end
        self.follower.travel(line_element((ax, ay), (bx, by), low, high, rapid, feed, block.line))

    def _first_motion(self, block: Block) -> None:
        self.moved_in = self.unit
        if not self.unit_said:
            name = "inches" if self.unit is Unit.IN else "millimeters"
            text = f"The program does not say its unit; it is taken as {name}."
            self.log.tell(Severity.INFO, "UNIT", text, block.line, block.column("XYZ"))

    def _arc(self, block: Block, turn: int) -> None:
        if not self.feed and self.rates.mode == PER_MINUTE:
            self.no_feed(block)
        if self.moved_in is None:
            self._first_motion(block)
        end = self.target(block.words)
        ax, ay, low = flat(self.position, self.plane)
        bx, by, high = flat(end, self.plane)
        start, stop = (ax, ay), (bx, by)
        if hypot(ax - bx, ay - by) < ON_PATH and "R" not in block.words:
            stop = start
        center = self._center(block, start, stop, turn)
        if isinstance(center, NoArc):
            column = block.column("R" if "R" in block.words else "IJK")
            self.log.stop("ARC", center.text, block.line, column, lengths=center.lengths)
        self.position = end
        element = arc_element(start, stop, center, turn, low, high, self.feed, block.line)
        if self.rates.mode != PER_MINUTE:
            length = hypot(element_sweep(element) * element.radius, high - low)
            element = element._replace(feed=self.rates.feed(self, block, length))
        self.follower.travel(element)

    @property
    def centers_from_origin(self) -> bool:
        """Whether I, J, K count from the program's origin; otherwise from the arc's start."""
        return self.absolute_centers and not (self.incremental and self.dialect.arcs.absolute)

    def _center(self, block: Block, start: Point, end: Point, turn: int) -> Point | NoArc:
        origin_there = flat(self.shift, self.plane) if self.centers_from_origin else None
        if "R" in block.words and _CENTERS_IJK.isdisjoint(block.words):
            return through(start, end, block.words["R"] * self.scale, turn)
        center = given_center(block.words, self.plane, start, self.scale, origin_there)
        return (
            center if isinstance(center, NoArc) else about(start, end, center, self.dialect.arcs, self.unit) or center
        )

    def no_feed(self, block: Block) -> None:
        """A move at feed without a feed."""
        text = "There is no feed; write F before the first move at feed."
        if self.dialect.feed_needed:
            self.log.stop("FEED", text, block.line, block.column("XYZIJ"))
        self.log.tell(Severity.WARNING, "FEED", text, block.line, block.column("XYZIJ"))


_AXES: Final = frozenset("XYZ")
_LINES: Final = (0, 10)
_MOVES: Final = frozenset((0, 10, 20, 30))
_ENDS: Final = frozenset((20, 300))
_CENTERS: Final = frozenset("IJKR")
_CENTERS_IJK: Final = frozenset("IJK")
