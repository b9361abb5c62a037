"""Rockwell / Allen-Bradley 9/Series mill: `nine-series:a` and `:b`, with `-g39.1` where arcs are the default corners.

D is an offset number and may stand before, in or behind the block with G41 or G42.  The first straight move of the
plane is the entry.  The side and the radius may change meanwhile; a vector I, J, K with G40 bends the exit.
Backwards moves, inside arcs under the radius and crossing vectors are alarms.  Generated blocks of any length are made:
the least length that the machine builder can set is taken as 0, and so is the least feed inside arcs.
"""

from __future__ import annotations

from math import radians
from typing import Final, NamedTuple

from core.controls.compensation import generated
from core.controls.compensation.corners import Element, fits, meeting, offset_radius, square_end, square_start
from core.controls.compensation.generated import Corners
from core.controls.compensation.offset_chain import Joint
from core.controls.compensation.radius_zero import nothing_compensated
from core.controls.control_run import Log, Run
from core.controls.control_tools import ToolTable
from core.controls.iso.dialect import Dialect, Do, codes
from core.controls.iso.runner import execute
from core.controls.iso.words import Block, Semicolon, Syntax
from core.controls.makers.nine_words import NineWords
from core.finding import Severity
from core.geometry.piece import Point, Side
from core.units import Unit

DIALECT: Final = Dialect(
    "nine-series",
    codes(
        ("units", Do.UNITS, (700, 710)),
        ("corners", Do.OWN, (390, 391)),
        ("path", Do.MODE, (610, 640)),
        ("spindle", Do.SPINDLE, (960, 970)),
        ("retract", Do.RETRACT, (980, 990)),
        ("once", Do.SHIFT, (520,)),
        ("once", Do.MACHINE, (530,)),
        ("once", Do.DATA, (100,)),
        ("once", Do.UNSHIFT, (921,)),
    ),
    Unit.IN,
    syntax=Syntax(Semicolon.END),
    d_anywhere=True,
)

TANGENT: Final = radians(0.05)
"""Inside corners under this angle whose offsets miss each other are tangent; the control's own limit is not known."""

NON_MOTION: Final = 10
"""Blocks without motion in the plane that compensation looks across; the machine builder sets it, this is assumed."""


class Before(NamedTuple):
    """What stood before the last element was taken in: rows on the tape, the element then held, its start, Z moves."""

    rows: int
    held: Element | None
    start: Point | None
    standing: tuple[Element, ...]


class NineSeries(NineWords):
    """The compensation itself."""

    short = True

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.entering = False
        self.quiet = 0
        self.before = Before(0, None, None, ())

    def begin(self, side: Side, block: Block) -> None:
        """G41 and G42: the start, or a change of side."""
        if self.leaving is not None:
            self._leave_square()
        if not self.active:
            if self.machine.mode in (20, 30):
                self._circular_start(block.line, block.side_column())
            self.active, self.entering, self.quiet = True, True, 0
            self.held, self.start, self.elements = None, None, 0
        self.side = side
        self.coming = self.radius(block) * side.sign

    def _circular_start(self, line: int, column: int) -> None:
        text = "Compensation cannot be started in G2 or G3; write G1 and a straight entry move."
        self.log.stop("R1", text, line, column)

    def finish(self, block: Block) -> None:
        """G40: the next straight move of the plane is the exit."""
        if self.active and (self.held is None or (self.entering and self.elements == 0)):
            self._cancel()
        elif self.active:
            self.leaving = block

    def idle(self, block: Block) -> None:
        """A block without motion in the plane."""
        self.quiet += 1
        if self.quiet <= NON_MOTION or self.held is None or self.leaving is not None:
            return
        text = (
            f"More than {NON_MOTION} blocks without motion (an assumed limit, the machine builder sets it): the move "
            "ends square and may cut too far; take some of them out."
        )
        self.log.tell(Severity.WARNING, "R5", text, block.line, 1)
        self.release_square()
        self.entering = True

    def travel(self, element: Element) -> None:
        """One element: entry, compensated, exit or none of them."""
        if not self.active:
            if self._leaving and element.turn:
                self._circular_exit(element.line)
            super().travel(element)
        elif not element.moves:
            self._across(element)
        elif self.leaving is not None:
            self._exit(element)
        else:
            self._compensated(element)

    def _across(self, element: Element) -> None:
        """A move that does not lie in the plane."""
        self.quiet += 1
        if self.held is None or self.leaving is not None:
            what = "start" if self.leaving is None else "end"
            text = (
                f"This move is not in the plane: compensation does not {what} with it, but with the next one that is."
            )
            self.log.tell(Severity.INFO, "R12", text, element.line, 1)
        if self.held is None:
            self.note(element)
            self.straight(element, self.here)
        else:
            self.hold(element)

    def _compensated(self, element: Element) -> None:
        self.quiet = 0
        if self.held is None and self.entering:
            if element.turn:
                self._circular_start(element.line, 1)
            self._without_offset(element)
            if self._span is None:
                self.open_span(self.running, self.coming, element)
        elif not fits(element, self.coming):
            text = "The arc's radius {0} is not larger than the cutter's {1}; use a smaller cutter."
            self.log.stop("R9", text, element.line, 1, lengths=(element.radius, abs(self.coming)))
        self.before = Before(len(self.tape), self.held, self.start, tuple(self.standing))
        self.hold(element)
        self.offset = self.coming

    def _without_offset(self, element: Element) -> None:
        if self.coming == 0.0:
            nothing_compensated(self.machine, "The offset is 0; write D and an offset's number.", element.line, 1)

    def joint(self, first: Element, second: Element) -> Joint:
        """How this control joins: the entry, a change, inside and outside corners."""
        if self.entering:
            self.entering = False
            self.offset = self.coming
            self._interpreted(first, second)
            joint = generated.entry(first, second, self.coming, self.corners, short=self.short)
            self.goes_on(joint)
            return self._told(joint, second)
        if self.coming != self.offset:
            text = "The side or the radius changes here; the way across is an interpretation."
            self.log.tell(Severity.INFO, "CHANGE", text, second.line, 1)
            joint = generated.changed(first, second, self.offset, self.coming)
            self.goes_on(joint)
            return joint
        angle = generated.inward(first, second, self._sign)
        if abs(angle) < generated.STRAIGHT or self.offset == 0.0:
            end = square_end(first, self.offset)
            return Joint(end, end)
        if angle < 0.0:
            return self._told(generated.outside(first, second, self.offset, self.corners), second)
        return self._inside(first, second, angle)

    def _told(self, joint: Joint, element: Element) -> Joint:
        """The joint; that its generated blocks are made however short they are is told."""
        if joint.through or joint.center is not None or joint.end != joint.start:
            self.generates(element.line)
        return joint

    @property
    def _sign(self) -> int:
        return 1 if self.offset > 0.0 else -1

    def _interpreted(self, first: Element, second: Element) -> None:
        if not self.short and generated.inward(first, second, self._sign) < 0.0:
            text = "The generated blocks of a type B entry are read from figures: an interpretation."
            self.log.tell(Severity.INFO, "TYPE-B", text, first.line, 1)

    def _inside(self, first: Element, second: Element, angle: float) -> Joint:
        point = meeting(first, second, self.offset)
        if point is not None:
            return Joint(point, point)
        if angle < TANGENT:
            end = square_end(first, self.offset)
            return Joint(end, end)
        text = "The offset paths do not meet at this inside corner: the compensation vectors cross."
        self._interference("R10", text, second.line)
        return Joint(square_end(first, self.offset), square_start(second, self.offset))

    def backwards(self, element: Element) -> None:
        """A line that would run backwards, or an arc whose ends have crossed."""
        if element.turn:
            text = "The compensation vectors of this arc cross: the cutter is too large for it."
            self._interference("R10", text, element.line)
        else:
            text = "The compensated move runs backwards: the cutter is too large for this block."
            self._interference("R8", text, element.line)

    def _interference(self, rule: str, text: str, line: int) -> None:
        if self.checks:
            self.log.stop(rule, f"{text} Use a smaller cutter.", line, 1)
        self.log.tell(Severity.WARNING, rule, f"{text} The alarm is switched off by M800.", line, 1)

    def feed_of(self, element: Element) -> float:
        """Inside an arc the surface keeps the feed; outside the center does."""
        if not element.turn or element.turn * self.offset <= 0.0:
            return element.feed
        self.slows(element.line)
        return element.feed * offset_radius(element, self.offset) / element.radius

    def _circular_exit(self, line: int) -> None:
        text = "Block format error: the move that cancels compensation has to be straight; write G1."
        self.log.stop("R2", text, line, 1)

    def _exit(self, element: Element) -> None:
        """The exit move: from the square end, type B's way round the corner, or as the vector bends it."""
        if element.turn:
            self._circular_exit(element.line)
        held, block = self.held, self.leaving
        if held is None or block is None:
            return
        if not {"I", "J", "K"}.isdisjoint(block.words):
            self.release(generated.bent(held, self._vector(block), self.offset))
        elif self.short or self.offset == 0.0:
            self.release_square()
        else:
            joint = self._told(generated.exit_points(held, element, self.offset, self.corners), element)
            self.release(joint.end)
            self._between(joint, element)
        self._cancel()
        super().travel(element)

    def _vector(self, block: Block) -> Point:
        first, second = (("I", "J"), ("K", "I"), ("J", "K"))[self.plane]
        scale = self.machine.scale
        return block.words.get(first, 0.0) * scale, block.words.get(second, 0.0) * scale

    def _cancel(self) -> None:
        self.active, self.entering, self.leaving, self.side = False, False, None, None
        self.held, self.start, self.standing = None, None, []
        self.leave(entry=1, exits=0)

    def _leave_square(self) -> None:
        self.release_square()
        self._cancel()

    def interrupt(self, block: Block) -> None:
        """A change of origin: the last move becomes an exit move, the next one an entry move."""
        text = "The origin changes under compensation: the last move leaves it and the next one enters it again."
        self.log.tell(Severity.WARNING, "R7", text, block.line, block.column("G"))
        before, last, standing = self.before, self.held, self.standing
        if last is None:
            return
        if before.held is not None and not self.entering:
            self.tape.cut(before.rows)
            self.held, self.start, self.standing = before.held, before.start, list(before.standing)
            self.release_square()
        for element in (last, *standing):
            self.straight(element, last.end)
        self.held, self.start, self.standing, self.entering = None, None, [], True

    def close(self) -> None:
        """The end of the program cancels compensation."""
        self.release_square()


def run(text: bytes, variant: str, tools: ToolTable, unit: Unit | None = None) -> Run:
    """A program as the 9/Series runs it, type `a` or `b`, with the corners of G39 or `-g39.1` in force."""
    kind, _, corners = variant.partition("-")

    def make(log: Log) -> NineSeries:
        follower = NineSeries(log)
        follower.short = kind == "a"
        follower.corners = Corners(corners or "g39")
        return follower

    return execute(text, f"nine-series:{variant}", DIALECT.starting(unit), tools, Log(), make)
