"""Fanuc mills with cutter compensation C are `fanuc:a`, `:b` and `:c`; with `-arc` sharp outside corners are arcs.

D is an offset number and may stand in any block.  The first movement in the plane under G41 or G42 is the start-up.
The control looks across one block without movement; after more, the last move ends square and the next runs at a slant.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Final

from core.controls.compensation.corner_rules import Outside
from core.controls.compensation.elements import Element, line_element
from core.controls.control_run import Log, Place, Spot
from core.controls.iso.dialect import CYCLES_APART, PLANE_OF_CODE, USUAL_CODES, CodeAction, Dialect, codes
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.flow import MakeControl
from core.controls.iso.machine import ARC_CENTER_LETTERS, LEFT_OPEN, NON_MODAL_ACTIONS, Control
from core.controls.iso.macro_b_machine import ARC_CODES, HAAS_SYSTEMS, MacroMachine
from core.controls.iso.reader import COMPENSATION_CODES, Block, whole_word
from core.controls.makers.fanuc_vectors import Alarms, VectorQueue, VectorRules, vector_meeting
from core.controls.moves import flat
from core.geometry.piece import Point, Side
from core.units import Unit

CODE_GROUPS: Final = (
    *USUAL_CODES,
    *CYCLES_APART,
    ("cycle", CodeAction.CYCLE, (730, 740, 760)),
    ("length", CodeAction.MODE, (440,)),
    ("length", CodeAction.UNSUPPORTED, (431, 434, 435)),
    ("system", CodeAction.SYSTEM, (541,)),
    ("path", CodeAction.MODE, (620, 630)),
    ("stroke", CodeAction.MODE, (220, 230)),
    ("scaling", CodeAction.TRANSFORM, (500, 510)),
    ("mirror", CodeAction.TRANSFORM, (501, 511)),
    ("rotation", CodeAction.TRANSFORM, (680, 690)),
    ("rotation", CodeAction.UNSUPPORTED, (682, 683, 684)),
    ("polar", CodeAction.TRANSFORM, (150, 160)),
    ("macro", CodeAction.MODE, (660, 670)),
    ("macro", CodeAction.UNSUPPORTED, (661,)),
    ("centers", CodeAction.UNAVAILABLE, (911,)),
    ("motion", CodeAction.UNSUPPORTED, (330, 21, 31, 22, 32, 23, 33, 24, 34, 62)),
    ("once", CodeAction.MODE, (50, 51, 80, 90, 110, 270, 600, 650)),
    ("corner", CodeAction.OF_THIS_CONTROL, (390,)),
    ("once", CodeAction.SKIP, (310,)),
    ("once", CodeAction.UNSUPPORTED, (70, 71, 290, 370, 450, 460, 470, 480, 121, 131)),
)
"""Codes in addition to those that all word-address controls share."""

RULE_NAMES: Final[Mapping[str, str]] = {
    "CODE": "PS0010",
    "WORD": "PS0009",
    "COMMENT": "PS0004",
    "NUMBER": "PS0007",
    "PARAMETER": "PS0115",
    "ARC-RADII": "PS0020",
    "ARC-POINT": "PS0038",
    "ARC-PLANE": "PS0021",
    "ARC": "PS0022",
    "SUBPROGRAM": "PS0076",
    "MACRO": "PS0114",
    "LIMIT": "FN-ENDLESS",
    "MOTION": "PS0010",
    "CYCLE": "PS0005",
    "DATA": "PS0031",
    "FEED": "PS0011",
}
"""Fanuc's alarm for each rule that all word-address controls share, by the rule's id."""

DIALECT: Final = Dialect(
    codes(*CODE_GROUPS),
    Unit.MM,
    percent_ends=True,
    parameters=ParameterStore.FANUC,
    cycle_rule="FN-CYCLE",
    d_anywhere=True,
    rule_names=RULE_NAMES,
    last_code_counts=True,
    feed_needed=True,
    repeat_letters="KL",
    fanuc_cycles=True,
    program_names=True,
    g54_takes_p=True,
    scales_axes=True,
    least_increment_setting="at 3401#0 = 0",
    macro_codes="parameters 6050 to 6059",
)

ALARMS: Final = Alarms(arc="PS0034", arc_off="PS0034", no_meeting="PS0033", crossing="PS0041", point="PS0038")

SHARED_OFFSETS: Final = (20, 30, 40, 50, 60, 100)
"""Numbers that shops add to a tool's number to get its D if lengths and radii share one memory."""

_PLANE_LETTERS: Final = ("XY", "ZX", "YZ")
_NEW_ORIGIN: Final = frozenset((520, 920, 540, 541, 550, 560, 570, 580, 590, 1540, *HAAS_SYSTEMS))
_HOME_CODES: Final = frozenset((280, 300))
_MACHINE_POSITION_CODES: Final = _HOME_CODES | {530}
_UNBUFFERED_G: Final = frozenset((280, 300, 310, 530))
_UNBUFFERED_M: Final = frozenset((0, 10, 20, 300))
_CALL_CODES: Final = frozenset((980, 990))
_TRANSFORM_CODES: Final = frozenset((680, 690, 510, 500, 511, 501))


class Fanuc(VectorQueue, Control):
    """Compensation of a Fanuc mill.

    `side` is the side of the G41 or G42 in force, `number` the D, `radius` its value in millimeters, as last read.
    `exiting`: this block turns compensation off, with `exit_vector` if it has I, J or K.  `in_plane`: the block moved
    in the plane, or must not count as one without movement; `too_many`: it alone counts as too many of these.
    `calls_counted`: a call or a return is among the blocks counted.  `away`: a new origin or a move to the machine's
    point has turned compensation off for a while.
    """

    alarms = ALARMS
    machine: MacroMachine

    def __init__(self, log: Log, rules: VectorRules) -> None:
        super().__init__(log, rules)
        self.side: Side | None = None
        self.number = 0
        self.radius = 0.0
        self.exiting = False
        self.exit_vector: Point | None = None
        self.block: Block | None = None
        self.in_plane = False
        self.too_many = False
        self.warned_of_zero = False
        self.calls_counted = False
        self.away = False

    def before_block(self, block: Block) -> None:
        """Count the block before, then check this one, read its D, and suspend compensation if the block does."""
        self._count()
        self.block, self.in_plane, self.exiting = block, False, False
        self.too_many = not (_UNBUFFERED_G.isdisjoint(block.g) and _UNBUFFERED_M.isdisjoint(block.m))
        if self.active:
            self._refuse(block)
        if "D" in block.words and self._is_known(block):
            self._take_number(block)
        if self.active:
            self._leave_for_a_while(block)

    def _is_known(self, block: Block) -> bool:
        """True if the control supports all G codes of a block: in another control's cycle D is not an offset number."""
        codes = (self.machine.dialect.codes.get(number) for number in block.g)
        return all(code is not None and code.action is not CodeAction.UNSUPPORTED for code in codes)

    def _refuse(self, block: Block) -> None:
        """Stop the run at codes that compensation does not allow."""
        for code in block.g:
            place = block.at("G", code)
            if code in PLANE_OF_CODE and PLANE_OF_CODE[code] is not self.plane:
                self.log.stop("PS0037", "The plane cannot change under compensation. Write G40 before it.", place)
            if code == 310:
                self.log.stop("PS0036", "G31 does not go with compensation. Write G40 before it.", place)
            if code in (450, 460, 470, 480):
                self.log.stop("PS0042", "G45 to G48 do not go with compensation. Write G40 before them.", place)
            if code in _TRANSFORM_CODES and code != 500 and not (code in (690, 501) and not self.machine.transform):
                text = f"cutcomp does not follow G{code / 10:g} under compensation. Write G40 before it."
                self.log.stop("FN-TRANSFORM", text, place)

    def _take_number(self, block: Block) -> None:
        self.number = number = whole_word(block, "D", self.log, "NUMBER", "D is an offset number, a whole number.")
        if self.active and number == 0:
            self._cancel_in(block, None)
        elif self.side is not None or not COMPENSATION_CODES.isdisjoint(block.g):
            self.radius = self._offset_value(block.at("D"))
            if self.active and self.side is not None:
                self.coming = self.radius * self.side.sign

    def _offset_value(self, place: Place) -> float:
        """Return the radius stored under the D in force, millimeters."""
        if self.number == 0:
            return 0.0
        machine, number = self.machine, self.number
        radius, tool = machine.offset_radius(number), machine.tool or machine.next_tool
        if radius is None and machine.tools.get(tool) is not None and number - tool in SHARED_OFFSETS:
            radius = machine.offset_radius(tool)
            text = f"D{number} is not in the tool table; cutcomp takes it for tool {tool}"
            self.log.inform("D-AS-T", f"{text}, as shared offset memories do.", place)
        if radius is None:
            text = f"Offset {number} is not in the tool table. Enter its tool or write another D."
            self.log.stop("PS0030", text, place, tool=number)
        self.note_radius(radius, "FN-D2", "The radius is negative, so G41 and G42 change places.", place)
        machine.compare_offset(radius, f"D{number}", place)
        return radius

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41 and G42: start compensation, change the side, or repeat it."""
        old, self.side = self.side, side
        if not self.active:
            self.warned_of_zero = False
            if self.vector_rules.at_once and not self._moves_in_plane(block):
                self._shift_on(block)
            return
        self.coming = self.radius * side.sign
        if side is not old:
            if self.held is not None and self.held.startup:
                text = "The side cannot change right after the start-up. Write a move first."
                self.log.stop(self.alarms.no_meeting, text, block.at_side())
        elif self._moves_in_plane(block):
            text = "G41 or G42 is in force already; cutcomp assumes that it has no effect in a block that moves."
            self.log.inform("FN-G2", text, block.at_side())
        else:
            self.end_square()

    def _shift_on(self, block: Block) -> None:
        """Type C: let a block without movement move the tool square to the next element."""
        self._read_radius(block.at("DG"))
        if self.coming:
            self.in_plane = True
            self._report_parameters(block)
            self.start_up(self._standing_element(block))

    def _standing_element(self, block: Block) -> Element:
        """Return a line of no length at the programmed point."""
        machine = self.machine
        x, y, height = flat(machine.position, self.plane)
        return line_element((x, y), (x, y), height, height, machine.mode == 0, machine.feed, block.line)

    def _read_radius(self, place: Place) -> None:
        """Read the offset under D, as it is when compensation starts."""
        self.radius = self._offset_value(place)
        self.coming = self.radius * (self.side.sign if self.side else 0)

    def compensation_off(self, block: Block) -> None:
        """G40: turn compensation off, with the block's I, J or K as exit vector."""
        self.side = None
        if self.active:
            self._cancel_in(block, self.vector_of(block))

    def _cancel_in(self, block: Block, vector: Point | None) -> None:
        """Turn compensation off in this block: with its move in the plane, or at once if it has none."""
        self.exit_vector = vector
        if self._moves_in_plane(block):
            self.exiting = True
            return
        held = self.held
        if held is not None and vector is not None:
            self.end_at(vector_meeting(held.element, vector, held.offset))
        self.end_square()
        self.stop_compensation()
        if self.vector_rules.at_once:
            element = self._standing_element(block)
            self._line(element, element.end)
            self.close_stretch()

    def _moves_in_plane(self, block: Block) -> bool:
        codes = self.machine.dialect.codes
        if any(code in codes and codes[code].action in NON_MODAL_ACTIONS for code in block.g):
            return False
        letters = _PLANE_LETTERS[self.plane]
        turns = self.machine.mode in ARC_CODES and not ARC_CENTER_LETTERS.isdisjoint(block.words)
        return letters[0] in block.words or letters[1] in block.words or turns

    def maker_code(self, code: int, block: Block) -> None:
        """G39: request an arc around the corner, which ends square to the block's vector if it has one."""
        if not self.active:
            self.log.stop("PS0035", "G39 goes with compensation only. Write G41 or G42 before it.", block.at("G", code))
        self.round_corner, self.in_plane = self.vector_of(block) or (0.0, 0.0), True

    def travel(self, element: Element) -> None:
        """Run one element: as start-up, compensated, as cancel, or without compensation."""
        self.in_plane = self.in_plane or element.moves
        if not self.active:
            self._without_compensation(element)
        elif not element.moves:
            self._in_place(element)
        elif self.exiting:
            self.cancel_with(element, self.exit_vector)
        else:
            self.compensate(element)

    def _without_compensation(self, element: Element) -> None:
        if not element.moves and not (self.block and self._moves_in_plane(self.block)):
            # after a G40 without movement the tool is still off the programmed point
            self.straight(element, self.here)
            return
        # on the way to the intermediate point of G28 the vector is dropped (5003#2 = 0)
        homing = self.block is not None and not _HOME_CODES.isdisjoint(self.block.g)
        if self.side is None or not element.moves or homing:
            super().travel(element)
            return
        self._read_radius(element)
        if self.coming == 0.0:
            if not self.warned_of_zero:
                text = "The offset is 0. Write D and the number of an offset."
                self.machine.nothing_compensated(text, element, code="FN-D0")
            self.warned_of_zero = True
            super().travel(element)
            return
        self._report_parameters(element)
        if self.machine.start_unknown:
            self._start_from_the_machine(element)
        self.start_up(element)

    def _start_from_the_machine(self, place: Place) -> None:
        """Report a start-up from an unknown machine point; type B needs the point and stops, the others do not."""
        text = "Where this move starts is not known after the move to the machine's point."
        if not self.vector_rules.type_a:
            self.log.stop("FN-WHERE", f"{text} Write a rapid to a point before it.", place)
        text = f"{text} What it cuts on its way is not judged. Write a rapid to a point before it."
        self.log.warn("FN-WHERE", text, place)

    def _in_place(self, element: Element) -> None:
        """Run a move across the plane, or one of no length."""
        if self.exiting:
            self.end_square()
            self.stop_compensation()
            super().travel(element)
            return
        self.too_many = self.too_many or element.start_height == element.end_height
        self.across(element)

    def _report_parameters(self, place: Place) -> None:
        if not self.log.has("FN-PARAM"):
            self.log.inform("FN-PARAM", self.assumed_parameters(), place)

    def assumed_parameters(self) -> str:
        """Return the sentence about what the machine builder or the shop sets, and what cutcomp assumes."""
        read = self.vector_rules.blocks_read
        return (
            "cutcomp assumes parameters 5003, 5008 and 19607 as this control's name says, 19625 = "
            f"{read} blocks read, 5004 ODI 0, 5001 EVR 0, 5010 and 1710 = 0. Only neighbors' vectors are compared."
        )

    def _count(self) -> None:
        """Count the last block if it did not move in the plane, and act on too many such blocks."""
        block = self.block
        if block is None or not self.active or self.in_plane or self.held is None:
            return
        if not block.g and not block.m and {"N", "O"}.issuperset(block.words):
            return
        self.calls_counted = not _CALL_CODES.isdisjoint(block.m) or (self.calls_counted and self.motionless > 0)
        self.motionless += 1
        if self.too_many or self.motionless > self.vector_rules.blocks_read - 2:
            self.after_too_many(block)

    def after_too_many(self, block: Block) -> None:
        """Warn of more blocks without movement than the control looks across, and end the held element square."""
        read = self.vector_rules.blocks_read
        why = f"Too many blocks without movement in the plane follow (19625 = {read} looks past {read - 2})"
        remedy = "Remove some."
        if self.too_many:
            why = "The control does not look past a stop, a move of no length or a move to the machine's zero"
            remedy = "Write G40 before it."
        text = f"{why}: the tool stands square here and the next move runs slanting. It may overcut or leave stock. "
        text += remedy
        if self.calls_counted:
            text += " Some controls count M98 and M99 as such blocks, as here."
        self.log.warn("FN-N2", text, block)
        self.end_square()

    def _leave_for_a_while(self, block: Block) -> None:
        """At a new origin or a move to a machine point, turn compensation off until the next move in the plane."""
        moved = any(letter in block.words for letter in _PLANE_LETTERS[self.plane])
        away = moved and not _MACHINE_POSITION_CODES.isdisjoint(block.g)
        new_origin = not _NEW_ORIGIN.isdisjoint(block.g) or (100 in block.g and block.words.get("L") in (2.0, 20.0))
        if not away and not new_origin:
            return
        what = "The move to the machine's point" if away else "The new origin"
        text = f"{what} turns compensation off for a while; the next move in the plane starts it again."
        self.log.warn("FN-G5", text, block.at("G"))
        if away:
            self.end_square()
        else:
            self.leave_straight()
        self.stop_compensation()
        self.close_stretch()
        self.away = True

    def end(self, _: int) -> None:
        """End of the program: under compensation the last move ends square."""
        if self.active:
            self.end_square()
        if self.active or (self.away and self.side is not None):
            self.left_open(self.block or Spot(1))

    def left_open(self, place: Place) -> None:
        """Report a program that ends under compensation."""
        self.log.warn("FN-OPEN", LEFT_OPEN, place)


VECTOR_RULES: Final[Mapping[str, VectorRules]] = {
    f"{kind}{corners}": VectorRules(type_a=kind != "b", at_once=kind == "c", outside=outside)
    for kind in ("a", "b", "c")
    for corners, outside in (("", Outside.LINES), ("-arc", Outside.MITER_OR_ANY_ARC))
}
"""The start-up type of each variant, and how it rounds sharp outside corners."""

VARIANTS: Final[Mapping[str, MakeControl]] = {name: partial(Fanuc, rules=rules) for name, rules in VECTOR_RULES.items()}
"""The variants, the default first."""
