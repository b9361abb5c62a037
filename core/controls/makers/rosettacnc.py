"""RosettaCNC has three entries: `nist` (the default), `easy` and `normal`.

nist: every move runs without look-ahead; the first one follows the tangent from its end to the tool at its start.
Every inside corner is an error, even the one between the first two moves.  easy: the first move waits for the second
one and ends square to its start; later inside corners are errors.  normal: inside corners are where the offsets meet;
cutcomp assumes that the rest follows LinuxCNC, as the manual does not say.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import acos, atan2, copysign, cos, hypot, pi, sin
from typing import Final, NoReturn

from core.controls.compensation.corner_rules import CornerKind, CornerRules
from core.controls.compensation.element_queue import AlarmCodes, ElementQueue, OneMoveQueue
from core.controls.compensation.elements import Element, fits, offset_end, offset_start
from core.controls.control_run import Log, Place
from core.controls.control_tools import missing_tool
from core.controls.iso.code_support import D_AND_H_ANYWHERE
from core.controls.iso.dialect import PLANE_OF_CODE, USUAL_CODES, CodeAction, Dialect, codes
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.machine import Control
from core.controls.iso.reader import COMPENSATION_CODES, Block, whole_word
from core.controls.moves import Plane
from core.geometry.piece import Side
from core.units import Unit

DIALECT: Final = Dialect(
    codes(
        *USUAL_CODES,
        ("compensation", CodeAction.SIDE, (411, 421)),
        ("system", CodeAction.SYSTEM, (591, 592, 593)),
        ("scaling", CodeAction.MODE, (500,)),
        ("rotation", CodeAction.MODE, (690,)),
        ("scaling", CodeAction.UNSUPPORTED, (510,)),
        ("rotation", CodeAction.UNSUPPORTED, (680,)),
        ("once", CodeAction.UNSUPPORTED, (650, 660)),
    ),
    Unit.MM,
    parameters=ParameterStore.MACRO_B,
    cycle_rule="C8",
    rounding_moves=True,
)

CORNER_RULES: Final = CornerRules(tangent=0.01, reversal=0.01, rapid_straight=True)
"""NIST's corner rules: corners under 0.01 rad are treated as tangent."""

_NOT_NOW: Final = frozenset((170, 180, 190, 280, 300, 520, 530, 920, 540, 550, 560, 570, 580, 590, 591, 592, 593))


class RosettaCnc(Control):
    """The radius that G41, G42, G41.1 and G42.1 program on this control, and what is refused under compensation."""

    def asked_offset(self, side: Side, block: Block) -> float:
        """Return the programmed signed radius, in millimeters; stop the run if it is wrong or missing."""
        place = block.at_side()
        if self.active:
            self.log.stop("C2", "Compensation is on already; write G40 before it is turned on again.", place)
        by_diameter = not {411, 421}.isdisjoint(block.g)
        radius = self._diameter(block) / 2 if by_diameter else self._table_radius(block)
        text = "The radius is negative and changes the side. cutcomp assumes this; the manual does not say."
        self.note_programmed_radius(radius, text, block)
        return radius * side.sign

    def _diameter(self, block: Block) -> float:
        if self.plane is Plane.YZ:
            text = "G41.1 and G42.1 do not work in the plane G19; write G41 or another plane."
            self.log.stop("C3", text, block.at_side())
        if "D" not in block.words:
            self.log.stop("C1", "G41.1 and G42.1 need D and the cutter's diameter.", block.at_side())
        if "L" in block.words:
            orientation = whole_word(block, "L", self.log, "C4", "L, the orientation of a lathe tool, is 0 to 9.", 0, 9)
            if self.plane is not Plane.ZX:
                self.log.stop("C5", "L goes with the plane G18 only. Remove it.", block.at("L"))
            self._nose(orientation, block.at("L"))
        return block.words["D"] * self.machine.scale

    def _nose(self, orientation: int, place: Place) -> None:
        if orientation not in (0, 9):
            text = "The moves are those of the tool nose center; cutcomp does not shift them by the orientation."
            self.log.warn("ORIENTATION", text, place)

    def _table_radius(self, block: Block) -> float:
        machine, place, number = self.machine, block.at_side(), self.machine.tool
        if "D" in block.words:
            text = "D is a tool number, 1 or more; a diameter goes with G41.1."
            place, number = block.at("D"), whole_word(block, "D", self.log, "C1", text, 1)
        tool, radius = machine.tools.get(number), 0.0
        if tool is not None:
            self._nose(tool.orientation, block.at_side())
            radius = tool.diameter_mm(machine.unit) / 2
        elif number:
            self.log.stop("C1", missing_tool(number), place, tool=number)
        elif "I" not in block.words:
            machine.nothing_compensated("No tool is loaded and there is no D, so the radius is 0.", place)
        return radius - block.words.pop("I", 0.0) * machine.scale

    def before_block(self, block: Block) -> None:
        """Stop the run at what NIST's list forbids under compensation; cutcomp assumes that the list holds here."""
        self.machine.check_codes(block)
        if "D" in block.words and COMPENSATION_CODES.isdisjoint(block.g):
            text = "D needs G41 or G42 in its block. cutcomp assumes this from NIST's list; the manual does not say."
            self.log.stop("C8", f"{text} {D_AND_H_ANYWHERE}", block.at("D"))
        if not self.active:
            return
        for code in _NOT_NOW.intersection(block.g):
            if PLANE_OF_CODE.get(code) is not self.plane:
                text = f"G{code / 10:g} is not allowed under compensation. cutcomp assumes this from NIST's list."
                self.log.stop("C8", text, block.at("G", code))


class NormalEntry(OneMoveQueue, RosettaCnc):
    """The entry `normal`: LinuxCNC's queue, in all three planes."""

    alarms = AlarmCodes("C8", "C7", "C6", "C8")

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41, G42, G41.1 and G42.1: turn compensation on."""
        self.turn_on(self.asked_offset(side, block))
        text = "The entry follows LinuxCNC: square to its own move. cutcomp assumes this; the manual does not say."
        self.log.inform("ENTRY", text, block.at_side())


class NistEntry(ElementQueue, RosettaCnc):
    """The entry `nist`, without look-ahead; `before` is the element that ran last, None before the first one."""

    rules = CORNER_RULES

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.before: Element | None = None

    def before_block(self, block: Block) -> None:
        """Stop the run at what is refused, which includes a change of unit."""
        super().before_block(block)
        if self.active and not {200, 210}.isdisjoint(block.g):
            text = "The unit cannot change under compensation. cutcomp assumes this from NIST's list."
            self.log.stop("C8", text, block.at_side())

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41, G42, G41.1 and G42.1: turn compensation on."""
        self.offset = self.asked_offset(side, block)
        self.active, self.before = True, None

    def compensation_off(self, _: Block) -> None:
        """G40: make no move; the next one starts where the tool is."""
        if self.active and self.offset and self.before:
            self.leave()
        self.active = False

    def travel(self, element: Element) -> None:
        """Run one element at once."""
        if self.leaving and element.turn:
            self._refuse_arc(element, "The first move after G40 must be straight")
        if not self.active or not self.offset:
            super().travel(element)
        elif self.before is None:
            self.enter(element)
        elif element.moves:
            self._corner(self.before, element)
            self.follow(element)
        else:
            self.note(element)
            self.straight(element, self.here)

    def enter(self, element: Element) -> None:
        """Run the first move with the tool along the tangent from the move's end to the tool at its start."""
        (sx, sy), (px, py) = element.start, element.end
        length, radius, sign = hypot(px - sx, py - sy), abs(self.offset), copysign(1.0, self.offset)
        if element.turn:
            self._refuse_arc(element, "An arc as first move must touch the tool where it stands; write a line")
        if length <= radius:
            text = "The first move is {0} long and must be longer than the radius {1}. cutcomp takes this from NIST."
            self.log.stop("C8", text, element, lengths=(length, radius))
        self.open_stretch(self.offset, element)
        self.note(element)
        angle = atan2(sy - py, sx - px) - acos(radius / length) * sign
        heading = angle - pi / 2 * sign
        self.before = element._replace(end_direction=(cos(heading), sin(heading)))
        self.straight(element, (px + radius * cos(angle), py + radius * sin(angle)))

    def _refuse_arc(self, element: Element, what: str) -> NoReturn:
        self.log.stop("C8", f"{what}. cutcomp assumes this from NIST's rules.", element)

    def _corner(self, before: Element, element: Element) -> None:
        joint = self.joint(before, element)
        if joint.corner is CornerKind.INSIDE:
            text = "An inside corner is an error with this entry. Round it in the program or use the normal entry."
            self.log.stop("C6", text, element, at=element.start)
        self.run_joint(joint, element, self.offset)

    def follow(self, element: Element) -> None:
        """Run a move on its offset, to the offset point at its end."""
        if not fits(element, self.offset):
            text = "The arc radius {0} must be larger than the cutter radius {1}. Use a smaller cutter."
            self.log.stop("C7", text, element, lengths=(element.radius, abs(self.offset)))
        self.note(element)
        self.before = element
        self.run_held(element, offset_end(element, self.offset))


class EasyEntry(NistEntry):
    """The entry `easy`: the first move waits in `held` for the second one."""

    def enter(self, element: Element) -> None:
        """Hold the first move, then end it at the offset point of the second one's start."""
        if self.held is None:
            if element.turn:
                self._refuse_arc(element, "The first move must be straight")
            self.open_stretch(self.offset, element)
            self.note(element)
            self.held = element
        elif not element.moves:
            self.note(element)
            self.standing.append(element)
        else:
            self.run_held(self.held, offset_start(element, self.offset))
            self.follow(element)

    def compensation_off(self, block: Block) -> None:
        """G40: end a first move that still waits at its own offset point."""
        self.end_of_program()
        super().compensation_off(block)

    def end_of_program(self) -> None:
        """End of the program: end a first move that still waits at its own offset point."""
        if self.held is not None:
            self.before = self.held
            self.run_held(self.held, offset_end(self.held, self.offset))


VARIANTS: Final[Mapping[str, type[Control]]] = {"nist": NistEntry, "easy": EasyEntry, "normal": NormalEntry}
"""The entries, the default first."""
