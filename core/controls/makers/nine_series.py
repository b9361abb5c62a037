"""Rockwell / Allen-Bradley 9/Series mills are `nine-series:a` and `:b`; `-g39.1` makes arcs the default at corners.

D is an offset number and may stand before, in or after the block with G41 or G42.  The first straight move in the plane
is the entry.  The side and the radius may change under compensation; a vector I, J, K with G40 shifts the start of the
exit.  Backwards moves, inside arcs no larger than the radius, and crossing vectors are alarms.  Generated blocks have
any length: cutcomp takes the machine builder's least length as 0, and the least feed inside arcs too.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Final, NamedTuple

from core.controls.compensation import corner_rules
from core.controls.compensation.corner_rules import CornerKind, CornerRules, Joint, Outside
from core.controls.compensation.element_queue import ElementQueue
from core.controls.compensation.elements import Element, fits, offset_end, offset_radius, offset_start
from core.controls.control_run import Log, Place
from core.controls.iso.dialect import CYCLES_APART, PLANE_OF_CODE, USUAL_CODES, CodeAction, Dialect, codes
from core.controls.iso.flow import MakeControl
from core.controls.iso.machine import Control
from core.controls.iso.reader import COMPENSATION_CODES, Block, Syntax, whole_word
from core.geometry.piece import Point, Side
from core.units import Unit

DIALECT: Final = Dialect(
    codes(
        *USUAL_CODES,
        *CYCLES_APART,
        ("units", CodeAction.UNITS, (700, 710)),
        ("corners", CodeAction.OF_THIS_CONTROL, (390, 391)),
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

NON_MOTION: Final = 10
"""Most blocks without motion in the plane that compensation looks across: assumed, as the machine builder sets it."""

_MACHINE_POSITION_CODES: Final = frozenset((280, 300, 530))
_OFFSET_CHANGE_CODES: Final = frozenset((520, 920, 921, 540, 550, 560, 570, 580, 590))


class Before(NamedTuple):
    """The state before the last element came in: rows on the tape, the element held then, its start, its Z moves."""

    rows: int
    held: Element | None
    start: Point | None
    standing: tuple[Element, ...]


class NineSeries(ElementQueue, Control):
    """The compensation of the 9/Series.

    `coming` is the next element's signed radius, `offset` that of the held one, in millimeters; `written_side` is the
    side of the G41 or G42 in force.  `entering`: the entry has not ended yet.  `exit_block` is the block with G40, kept
    until the exit move; `motionless` counts blocks without motion in the plane.
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

    def before_block(self, block: Block) -> None:
        """Act on everything in a block but its motion: D, M800 and M801, stops, and changes of origin or plane."""
        if "D" in block.words:
            self._take_number(block)
        for code, on in ((8000, False), (8010, True)):
            if code in block.m:
                self.checks = on
                text = f"M{code // 10} turns the alarms for backwards moves and crossing vectors"
                self.log.inform("R11", f"{text} {'on' if on else 'off'}.", block.at("M", code))
        if self.active and not {0, 10}.isdisjoint(block.m):
            text = "Moves by hand or MDI at this stop are not compensated; compensation starts anew after them."
            self.log.inform("R6", text, block.at("M"))
        if self.active and not _OFFSET_CHANGE_CODES.isdisjoint(block.g):
            self._interrupt(block)
        if self.active and not _MACHINE_POSITION_CODES.isdisjoint(block.g):
            text = "cutcomp does not know what compensation does with a move to a machine point. Write G40 before it."
            self.log.stop("HOME", text, block.at("G"))
        if self.active and self.exit_block is None and not PLANE_OF_CODE.keys().isdisjoint(block.g):
            self.log.stop("PLANE", "The plane is not changed under compensation; write G40 before.", block.at_side())

    def _take_number(self, block: Block) -> None:
        self.number = number = whole_word(block, "D", self.log, "NUMBER", "D is an offset number, a whole number.")
        if number == 0 and (self.active or not COMPENSATION_CODES.isdisjoint(block.g)):
            text = "D0 does not cancel compensation, it goes on with radius 0; write G40 to cancel."
            self.log.warn("R3", text, block.at("D"))
        goes_on = self.active and self.exit_block is None and COMPENSATION_CODES.isdisjoint(block.g)
        if goes_on and self.written_side is not None:
            self.coming = self._offset_radius(block) * self.written_side.sign

    def _offset_radius(self, block: Block) -> float:
        """Return half the diameter of the offset in force, millimeters."""
        if self.number == 0:
            return 0.0
        tool = self.machine.tools.get(self.number)
        if tool is None:
            text = f"Offset {self.number} is not entered; enter its radius or write another D."
            self.log.stop("TOOL", text, block.at("DG"), tool=self.number)
        radius = tool.diameter_mm(self.machine.unit) / 2
        self.note_radius(radius, "R4", "The radius is negative: the tool runs on the other side.", block.at("DG"))
        self.machine.compare_offset(radius, f"D{self.number}", block.at("DG"))
        return radius

    def maker_code(self, code: int, _: Block) -> None:
        """G39 and G39.1: round sharp outside corners by lines or by an arc."""
        self.rules = CornerRules(outside=Outside.MITER_OR_ARC if code == 391 else Outside.LINES)

    def _continue_stretch(self, joint: Joint) -> None:
        """Give the stretch the next side and radius from this joint on; right after the entry, from its start on."""
        if self.elements == 1:
            self.begin_stretch(self.coming)
        else:
            self.change_stretch(self.coming, 1 + len(self.standing), joint.moves)

    def _report_assumed(self, rule: str, text: str, place: Place) -> None:
        """Report once that the path depends on a value that the machine builder sets."""
        if not self.log.has(rule):
            words = f"This depends on a value the machine builder sets (first at this line): {text}"
            self.log.inform(rule, words, place)

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41 and G42: start compensation or change the side."""
        if self.exit_block is not None:
            self.release_at_end()
            self._cancel()
        if not self.active:
            if self.machine.mode in (20, 30):
                self._circular_start(block.at_side())
            self.active, self.entering, self.motionless = True, True, 0
            self.held, self.start, self.elements = None, None, 0
        self.written_side = side
        self.coming = self._offset_radius(block) * side.sign

    def _circular_start(self, place: Place) -> None:
        self.log.stop("R1", "Compensation cannot be started in G2 or G3; write G1 and a straight entry move.", place)

    def compensation_off(self, block: Block) -> None:
        """G40: make the next straight move in the plane the exit, or cancel at once if no move is held."""
        if self.entering and self.held is not None:
            self._without_offset(self.held)
        if self.active and (self.held is None or (self.entering and self.elements == 0)):
            self._cancel()
        elif self.active:
            self.exit_block = block

    def block_without_motion(self, block: Block) -> None:
        """Count a block without motion in the plane; after too many, the held move ends square."""
        self.motionless += 1
        if self.motionless <= NON_MOTION or self.held is None or self.exit_block is not None:
            return
        text = f"More than {NON_MOTION} blocks without motion (an assumed limit, the machine builder sets it)"
        self.log.warn("R5", f"{text}: the move ends square and may overcut. Remove some of these blocks.", block)
        self.release_at_end()
        self.entering = True

    def travel(self, element: Element) -> None:
        """Run one element: as entry, compensated, as exit, or without compensation."""
        if not self.active:
            if self.leaving and element.turn:
                self._circular_exit(element)
            super().travel(element)
        elif not element.moves:
            self._across(element)
        elif self.exit_block is not None:
            self._exit(element)
        else:
            self._compensated(element)

    def _across(self, element: Element) -> None:
        """Run a move across the plane, or let it wait with the held element."""
        self.motionless += 1
        if self.held is None or self.exit_block is not None:
            what = "start" if self.exit_block is None else "end"
            self.log.inform("R12", f"Compensation will {what} at the next move in the plane, not at this one.", element)
        if self.held is None:
            self.note(element)
            self.straight(element, self.here)
        else:
            self.hold(element)

    def _compensated(self, element: Element) -> None:
        self.motionless = 0
        if self.held is None and self.entering:
            if element.turn:
                self._circular_start(element)
            if not self.stretch_open:
                self.open_stretch(self.coming, element)
        elif not fits(element, self.coming):
            text = "The arc radius {0} must be larger than the cutter radius {1}. Use a smaller cutter."
            self.log.stop("R9", text, element, lengths=(element.radius, abs(self.coming)))
        self.before = Before(len(self.tape), self.held, self.start, tuple(self.standing))
        self.hold(element)
        self.offset = self.coming

    def _without_offset(self, element: Element) -> None:
        if self.coming == 0.0:
            self.machine.nothing_compensated("The offset is 0; write D and an offset's number.", element)

    def joint(self, first: Element, second: Element) -> Joint:
        """Return this control's joint: at the entry, at a change, or at an inside or outside corner."""
        if self.entering:
            self._without_offset(first)  # up to here a D may come in a block of its own
            self.entering = False
            self.offset = self.coming
            if not self.type_a and corner_rules.inward_turn(first, second, self.offset) < 0.0:
                text = (
                    "cutcomp takes the generated blocks of a type B entry from figures; the manual's text lacks them."
                )
                self.log.inform("TYPE-B", text, first)
            joint = corner_rules.entry_joint(first, second, self.coming, self.rules.outside, direct=self.type_a)
            self._continue_stretch(joint)
            return self._with_notice(joint, second)
        if self.coming != self.offset:
            text = "The side or the radius changes at this line. cutcomp assumes the moves across; the manual has none."
            self.log.inform("CHANGE", text, second)
            joint = corner_rules.offset_change_joint(first, second, self.offset, self.coming)
            self._continue_stretch(joint)
            return joint
        joint = super().joint(first, second)
        if joint.missed:
            return self._missed(first, second)
        return self._with_notice(joint, second) if joint.corner is CornerKind.OUTSIDE else joint

    def _with_notice(self, joint: Joint, element: Element) -> Joint:
        """Return the joint, and report that its generated blocks may have any length."""
        if joint.through or joint.center is not None or joint.end != joint.start:
            text = "cutcomp takes the least length of a generated block (AMP) as 0; the control drops a shorter one."
            self._report_assumed("AMP", text, element)
        return joint

    def _missed(self, first: Element, second: Element) -> Joint:
        """Return the joint of an inside corner whose offsets do not meet: it is tangent, or an alarm."""
        end = offset_end(first, self.offset)
        if corner_rules.inward_turn(first, second, self.offset) < corner_rules.MAX_TANGENT_ANGLE:
            return Joint(end, end)
        text = "The offset paths do not meet at this inside corner: the compensation vectors cross."
        self._interference("R10", text, second)
        return Joint(end, offset_start(second, self.offset))

    def backwards(self, element: Element) -> None:
        """Report a line that would run backwards, or an arc whose ends have crossed."""
        if element.turn:
            text = "The compensation vectors of this arc cross: the cutter is too large for it."
            self._interference("R10", text, element)
        else:
            text = "The compensated move runs backwards: the cutter is too large for this block."
            self._interference("R8", text, element)

    def _interference(self, rule: str, text: str, place: Place) -> None:
        if self.checks:
            self.log.stop(rule, f"{text} Use a smaller cutter.", place)
        self.log.warn(rule, f"{text} The alarm is switched off by M800.", place)

    def feed_of(self, element: Element) -> float:
        """Return the feed of the center: inside an arc the surface keeps the programmed feed, outside the center."""
        if not element.turn or element.turn * self.offset <= 0.0:
            return element.feed
        text = "cutcomp takes the least feed inside arcs (MFR) as 0; the control may feed faster."
        self._report_assumed("MFR", text, element)
        return element.feed * offset_radius(element, self.offset) / element.radius

    def _circular_exit(self, place: Place) -> None:
        self.log.stop("R2", "Block format error: the move that cancels compensation must be straight. Write G1.", place)

    def _exit(self, element: Element) -> None:
        """Run the exit move: from the square end, around the corner (type B), or from the end that a vector sets."""
        if element.turn:
            self._circular_exit(element)
        held, block = self.held, self.exit_block
        if held is not None and block is not None and not {"I", "J", "K"}.isdisjoint(block.words):
            self.release(held, corner_rules.vector_end(held, self.vector_of(block) or (0.0, 0.0), self.offset))
        elif held is None or self.type_a or self.offset == 0.0:
            self.release_at_end()
        else:
            joint = self._with_notice(corner_rules.exit_joint(held, element, self.offset, self.rules.outside), element)
            self.release(held, joint.end)
            self.run_joint(joint, element, self.offset)
        self._cancel()
        super().travel(element)

    def _cancel(self) -> None:
        self.active, self.entering, self.exit_block, self.written_side = False, False, None, None
        self.held, self.start, self.standing = None, None, []
        self.leave()

    def _interrupt(self, block: Block) -> None:
        """At a change of origin, make the last move an exit move and, without a G40, the next one an entry move."""
        again = " and the next one enters it again" if self.exit_block is None else ""
        text = f"The origin changes under compensation: the last move leaves it{again}."
        self.log.warn("R7", text, block.at("G"))
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
        if self.exit_block is not None:
            self._cancel()
            self.close_stretch()

    def end_of_program(self) -> None:
        """End of the program: cancel compensation; the held move ends square."""
        if self.entering and self.held is not None:
            self._without_offset(self.held)
        self.release_at_end()


VARIANTS: Final[Mapping[str, MakeControl]] = {
    f"{kind}{corners}": partial(NineSeries, type_a=kind == "a", outside=outside)
    for kind in ("a", "b")
    for corners, outside in (("", Outside.LINES), ("-g39", Outside.LINES), ("-g39.1", Outside.MITER_OR_ARC))
}
"""Type A or B, and what rounds sharp outside corners when the program starts: lines (G39) or an arc (G39.1)."""
