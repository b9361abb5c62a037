"""Rockwell / Allen-Bradley 9/Series mill: `nine-series:a` and `:b`, with `-g39.1` where arcs are the default corners.

D is an offset number and may stand before, in or after the block with G41 or G42.  The first straight move of the
plane is the entry.  The side and the radius may change meanwhile; a vector I, J, K with G40 bends the exit.
Backwards moves, inside arcs under the radius and crossing vectors are alarms.  Generated blocks of any length are made:
the least length that the machine builder can set is taken as 0, and so is the least feed inside arcs.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from math import radians
from types import MappingProxyType
from typing import Final, NamedTuple

from core.controls.compensation.corner_rules import (
    CornerKind,
    CornerRules,
    Joint,
    Outside,
    entry_joint,
    exit_joint,
    inward_turn,
    offset_change_joint,
    vector_end,
)
from core.controls.compensation.element_queue import ElementQueue
from core.controls.compensation.elements import Element, fits, offset_end, offset_radius, offset_start
from core.controls.control_run import Log
from core.controls.iso.arcs import IN_PLANE
from core.controls.iso.dialect import CYCLES_APART, PLANES, CodeAction, Dialect, codes
from core.controls.iso.flow import MakeControl
from core.controls.iso.machine import Control
from core.controls.iso.modal_state import OUTLINE_JUDGED
from core.controls.iso.reader import SWITCHES, Block, Syntax, whole
from core.finding import Severity
from core.geometry.piece import Point, Side
from core.units import Unit

DIALECT: Final = Dialect(
    codes(
        *CYCLES_APART,
        ("units", CodeAction.UNITS, (700, 710)),
        ("corners", CodeAction.OF_THIS_CONTROL, (390, 391)),
        ("path", CodeAction.MODE, (610, 640)),
        ("spindle", CodeAction.SPINDLE, (960, 970)),
        ("retract", CodeAction.RETRACT, (980, 990)),
        ("once", CodeAction.SHIFT, (520,)),
        ("once", CodeAction.MACHINE, (530,)),
        ("once", CodeAction.DATA, (100,)),
        ("once", CodeAction.UNSHIFT, (921,)),
        ("once", CodeAction.UNSUPPORTED, (141, 160, 511, 680)),
        ("scaling", CodeAction.MODE, (140,)),
        ("polar", CodeAction.MODE, (150,)),
        ("mirror", CodeAction.MODE, (501,)),
        ("rotation", CodeAction.MODE, (690,)),
    ),
    Unit.IN,
    syntax=Syntax(semicolon_ends=True, corners=True),
    d_anywhere=True,
)

TANGENT: Final = radians(0.05)
"""Inside corners under this angle whose offsets miss each other are tangent; the control's own limit is not known."""

NON_MOTION: Final = 10
"""Blocks without motion in the plane that compensation looks across; the machine builder sets it, this is assumed."""

_MACHINE: Final = frozenset((280, 300, 530))
_CHANGES: Final = frozenset((520, 920, 921, 540, 550, 560, 570, 580, 590))


class Before(NamedTuple):
    """What stood before the last element was taken in: rows on the tape, the element then held, its start, Z moves."""

    rows: int
    held: Element | None
    start: Point | None
    standing: tuple[Element, ...]


class NineSeries(ElementQueue, Control):
    """The compensation of the 9/Series.

    `coming` is the next element's signed radius, `offset` that of what is held, in millimeters; `written_side` the side
    of the word in force; `entering` until the entry has ended; `exit_block` the block with G40 until the exit move;
    `motionless` counts blocks without motion in the plane.
    """

    def __init__(self, log: Log, *, type_a: bool, outside: Outside) -> None:
        super().__init__(log)
        self.type_a = type_a
        self.rules = CornerRules(outside=outside)
        self.number = 0
        self.coming = 0.0
        self.written_side: Side | None = None
        self.entering = False
        self.exit_block: Block | None = None
        self.checks = True
        self.motionless = 0
        self.before = Before(0, None, None, ())

    def watch(self, block: Block) -> None:
        """What a block says besides its motion: D, M800 and M801, a change of origin."""
        if "D" in block.words:
            self._take_number(block)
        for code, on in ((8000, False), (8010, True)):
            if code in block.m:
                self.checks = on
                text = (
                    f"M{code // 10} turns the alarms for backwards moves and crossing vectors {'on' if on else 'off'}."
                )
                self.log.tell(Severity.INFO, "R11", text, block.line, block.column("M", code))
        if self.active and not {0, 10}.isdisjoint(block.m):
            text = "Moves by hand or MDI at this stop are not compensated; compensation starts anew after them."
            self.log.tell(Severity.INFO, "R6", text, block.line, block.column("M"))
        if self.active and not _CHANGES.isdisjoint(block.g):
            self._interrupt(block)
        if self.active and not _MACHINE.isdisjoint(block.g):
            text = "cutcomp does not know what compensation does with a move to a machine point. Write G40 before it."
            self.log.stop("HOME", text, block.line, block.column("G"))
        if self.active and self.exit_block is None and not PLANES.keys().isdisjoint(block.g):
            text = "The plane is not changed under compensation; write G40 before."
            self.log.stop("PLANE", text, block.line, block.side_column())

    def _take_number(self, block: Block) -> None:
        number = whole(block.words["D"])
        if number is None or number < 0:
            text = "D is an offset number, a whole number."
            self.log.stop("NUMBER", text, block.line, block.column("D"))
        self.number = number
        if number == 0 and (self.active or not SWITCHES.isdisjoint(block.g)):
            text = "D0 does not cancel compensation, it goes on with radius 0; write G40 to cancel."
            self.log.tell(Severity.WARNING, "R3", text, block.line, block.column("D"))
        if self.active and self.exit_block is None and SWITCHES.isdisjoint(block.g) and self.written_side is not None:
            self.coming = self._offset_radius(block) * self.written_side.sign

    def _offset_radius(self, block: Block) -> float:
        """Half the diameter of the offset in force, millimeters."""
        if self.number == 0:
            return 0.0
        tool = self.machine.tools.get(self.number)
        if tool is None:
            text = f"Offset {self.number} is not entered; enter its radius or write another D."
            self.log.stop("TOOL", text, block.line, block.column("DG"))
        radius = tool.diameter_mm(self.machine.unit) / 2
        if radius < 0.0:
            text = f"The radius is negative: the tool runs on the other side. {OUTLINE_JUDGED}"
            self.log.tell(Severity.INFO, "R4", text, block.line, block.column("DG"))
        self.machine.compare_offset(radius, f"D{self.number}", block.line, block.column("DG"))
        return radius

    @property
    def _tool_side(self) -> Side:
        """The side on which the tool runs: a negative radius is on the other one, offset 0 on the one written."""
        sign = self.coming or (self.written_side.sign if self.written_side else 0)
        return Side.LEFT if sign > 0.0 else Side.RIGHT

    def own_code(self, code: int, _: Block) -> None:
        """G39 and G39.1."""
        self.rules = CornerRules(outside=Outside.MITER_OR_ARC if code == 391 else Outside.LINES)

    def _continue_stretch(self, joint: Joint) -> None:
        """From this joint on the stretch has the next side and radius; right after the entry, from its start."""
        if self.elements == 1:
            self.begin_stretch(self._tool_side, self.coming)
        else:
            self.change_stretch(self._tool_side, self.coming, 1 + len(self.standing), joint.moves)

    def _assumed(self, rule: str, text: str, line: int) -> None:
        """Reports a value that the machine builder sets, once."""
        if not self.log.has(rule):
            words = f"This depends on a value the machine builder sets (first at this line): {text}"
            self.log.tell(Severity.INFO, rule, words, line, 1)

    def begin(self, side: Side, block: Block) -> None:
        """G41 and G42: the start, or a change of side."""
        if self.exit_block is not None:
            self.release_at_end()
            self._cancel()
        if not self.active:
            if self.machine.mode in (20, 30):
                self._circular_start(block.line, block.side_column())
            self.active, self.entering, self.motionless = True, True, 0
            self.held, self.start, self.elements = None, None, 0
        self.written_side = side
        self.coming = self._offset_radius(block) * side.sign

    def _circular_start(self, line: int, column: int) -> None:
        text = "Compensation cannot be started in G2 or G3; write G1 and a straight entry move."
        self.log.stop("R1", text, line, column)

    def finish(self, block: Block) -> None:
        """G40: the next straight move of the plane is the exit."""
        if self.entering and self.held is not None:
            self._without_offset(self.held)
        if self.active and (self.held is None or (self.entering and self.elements == 0)):
            self._cancel()
        elif self.active:
            self.exit_block = block

    def idle(self, block: Block) -> None:
        """A block without motion in the plane."""
        self.motionless += 1
        if self.motionless <= NON_MOTION or self.held is None or self.exit_block is not None:
            return
        text = (
            f"More than {NON_MOTION} blocks without motion (an assumed limit, the machine builder sets it): the move "
            "ends square and may overcut. Remove some of these blocks."
        )
        self.log.tell(Severity.WARNING, "R5", text, block.line, 1)
        self.release_at_end()
        self.entering = True

    def travel(self, element: Element) -> None:
        """One element: entry, compensated, exit or none of them."""
        if not self.active:
            if self.leaving and element.turn:
                self._circular_exit(element.line)
            super().travel(element)
        elif not element.moves:
            self._across(element)
        elif self.exit_block is not None:
            self._exit(element)
        else:
            self._compensated(element)

    def _across(self, element: Element) -> None:
        """A move that does not lie in the plane."""
        self.motionless += 1
        if self.held is None or self.exit_block is not None:
            what = "start" if self.exit_block is None else "end"
            text = f"Compensation will {what} at the next move in the plane, not at this one."
            self.log.tell(Severity.INFO, "R12", text, element.line, 1)
        if self.held is None:
            self.note(element)
            self.straight(element, self.here)
        else:
            self.hold(element)

    def _compensated(self, element: Element) -> None:
        self.motionless = 0
        if self.held is None and self.entering:
            if element.turn:
                self._circular_start(element.line, 1)
            if not self.stretch_open:
                self.open_stretch(self._tool_side, self.coming, element)
        elif not fits(element, self.coming):
            text = "The arc radius {0} must be larger than the cutter radius {1}. Use a smaller cutter."
            self.log.stop("R9", text, element.line, 1, lengths=(element.radius, abs(self.coming)))
        self.before = Before(len(self.tape), self.held, self.start, tuple(self.standing))
        self.hold(element)
        self.offset = self.coming

    def _without_offset(self, element: Element) -> None:
        if self.coming == 0.0:
            self.machine.nothing_compensated("The offset is 0; write D and an offset's number.", element.line, 1)

    def joint(self, first: Element, second: Element) -> Joint:
        """How this control joins: the entry, a change, inside and outside corners."""
        if self.entering:
            self._without_offset(first)  # until here D may stand in a block of its own
            self.entering = False
            self.offset = self.coming
            self._interpreted(first, second)
            joint = entry_joint(first, second, self.coming, self.rules.outside, direct=self.type_a)
            self._continue_stretch(joint)
            return self._with_notice(joint, second)
        if self.coming != self.offset:
            text = "The side or the radius changes at this line. cutcomp assumes the moves across; the manual has none."
            self.log.tell(Severity.INFO, "CHANGE", text, second.line, 1)
            joint = offset_change_joint(first, second, self.offset, self.coming)
            self._continue_stretch(joint)
            return joint
        joint = super().joint(first, second)
        if joint.missed:
            return self._missed(first, second)
        return self._with_notice(joint, second) if joint.corner is CornerKind.OUTSIDE else joint

    def _with_notice(self, joint: Joint, element: Element) -> Joint:
        """The joint; reports that generated blocks are made at any length."""
        if joint.through or joint.center is not None or joint.end != joint.start:
            text = "cutcomp takes the least length of a generated block (AMP) as 0; the control drops a shorter one."
            self._assumed("AMP", text, element.line)
        return joint

    def _interpreted(self, first: Element, second: Element) -> None:
        if not self.type_a and inward_turn(first, second, self.offset) < 0.0:
            text = "cutcomp takes the generated blocks of a type B entry from figures; the manual's text lacks them."
            self.log.tell(Severity.INFO, "TYPE-B", text, first.line, 1)

    def _missed(self, first: Element, second: Element) -> Joint:
        """The offsets of an inside corner do not meet: tangent, or an alarm."""
        end = offset_end(first, self.offset)
        if inward_turn(first, second, self.offset) < TANGENT:
            return Joint(end, end)
        text = "The offset paths do not meet at this inside corner: the compensation vectors cross."
        self._interference("R10", text, second.line)
        return Joint(end, offset_start(second, self.offset))

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
        text = "cutcomp takes the least feed inside arcs (MFR) as 0; the control may feed faster."
        self._assumed("MFR", text, element.line)
        return element.feed * offset_radius(element, self.offset) / element.radius

    def _circular_exit(self, line: int) -> None:
        text = "Block format error: the move that cancels compensation must be straight. Write G1."
        self.log.stop("R2", text, line, 1)

    def _exit(self, element: Element) -> None:
        """The exit move: from the square end, type B's way around the corner, or as the vector bends it."""
        if element.turn:
            self._circular_exit(element.line)
        held, block = self.held, self.exit_block
        if held is None or block is None:
            return
        if not {"I", "J", "K"}.isdisjoint(block.words):
            first, second, _ = IN_PLANE[self.plane]
            scale = self.machine.scale
            vector = block.words.get(first, 0.0) * scale, block.words.get(second, 0.0) * scale
            self.release(vector_end(held, vector, self.offset))
        elif self.type_a or self.offset == 0.0:
            self.release_at_end()
        else:
            joint = self._with_notice(exit_joint(held, element, self.offset, self.rules.outside), element)
            self.release(joint.end)
            self.run_joint(joint, element, self.offset)
        self._cancel()
        super().travel(element)

    def _cancel(self) -> None:
        self.active, self.entering, self.exit_block, self.written_side = False, False, None, None
        self.held, self.start, self.standing = None, None, []
        self.leave()

    def _interrupt(self, block: Block) -> None:
        """A change of origin: the last move becomes an exit move, the next one an entry move."""
        text = "The origin changes under compensation: the last move leaves it and the next one enters it again."
        self.log.tell(Severity.WARNING, "R7", text, block.line, block.column("G"))
        before, last, standing = self.before, self.held, self.standing
        if last is None:
            return
        if before.held is not None and not self.entering:
            self.tape.cut(before.rows)
            self.held, self.start, self.standing = before.held, before.start, list(before.standing)
            self.release_at_end()
        for element in (last, *standing):
            self.straight(element, last.end)
        self.held, self.start, self.standing, self.entering = None, None, [], True

    def close(self) -> None:
        """The end of the program cancels compensation."""
        if self.entering and self.held is not None:
            self._without_offset(self.held)
        self.release_at_end()


VARIANTS: Final[Mapping[str, MakeControl]] = MappingProxyType(
    {
        f"{kind}{corners}": partial(NineSeries, type_a=kind == "a", outside=outside)
        for kind in ("a", "b")
        for corners, outside in (("", Outside.LINES), ("-g39", Outside.LINES), ("-g39.1", Outside.MITER_OR_ARC))
    }
)
"""Type A or B, and how sharp outside corners are rounded at the start: by lines (G39) or an arc (G39.1)."""
