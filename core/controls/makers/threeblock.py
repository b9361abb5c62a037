"""The three-block control is an older US mill control that compensates with three blocks in view (`threeblock`).

The block with G41 or G42 runs without compensation to the turn-on point.  The next one, the approach, is straight and
ends square to the first compensated element.  Inside corners are where the offsets meet, and outside corners are arcs
about the corner.  The control looks no further ahead: what does not fit is gouged without an alarm.  The block with G40
goes straight from the square end of the last element to its own end point.
"""

from __future__ import annotations

import re
from math import dist
from typing import Final, NoReturn

from core.controls.compensation.corner_rules import MAX_TANGENT_ANGLE, CornerKind, CornerRules, Joint
from core.controls.compensation.element_queue import ElementQueue
from core.controls.compensation.elements import Element, element_sweep, fits, offset_end, offset_radius, offset_start
from core.controls.control_run import Log, Place, Spot
from core.controls.iso.code_support import D_AND_H_ANYWHERE
from core.controls.iso.dialect import CodeAction, Dialect, codes
from core.controls.iso.machine import Control
from core.controls.iso.reader import COMPENSATION_CODES, Block, Syntax
from core.controls.moves import Plane
from core.finding import Severity
from core.geometry.piece import Point, Side
from core.units import Unit

DIALECT: Final = Dialect(
    codes(
        ("units", CodeAction.UNITS, (700, 710)),
        ("ratio", CodeAction.OF_THIS_CONTROL, (440, 450)),
        ("deceleration", CodeAction.OF_THIS_CONTROL, (990,)),
    ),
    Unit.IN,
    absolute_centers=True,
    syntax=Syntax(semicolon_ends=True, tool_data=True),
    loads_at_t=True,
    subprograms=False,
    cycles=False,
)

SHORTEST_BLOCK_SECONDS: Final = 0.25
"""Seconds: a block that takes less makes the control dwell."""

LARGEST_DIAMETER: Final = 83.23072
"""Millimeters (3.2768 in); the 83.321 mm printed next to it has two digits swapped."""

_REFUSED_UNDER_COMPENSATION: Final = frozenset((40, 280, 300, 920, 540, 550, 560, 570, 580, 590, 200, 210, 700, 710))
_POINTLESS: Final = re.compile(r"[XYZIJ][ \t]*[-+]?0*[1-9][0-9]*(?![0-9.])", re.IGNORECASE)


class ThreeBlock(ElementQueue, Control):
    """Compensation that sees only the next element, and the rules for blocks under compensation.

    `opening`: this is the block with G41 or G42; `blocks` lists those after it: line, Z moved, X or Y moved.  `ratio`:
    G45 is in force.
    """

    rules = CornerRules(tangent=MAX_TANGENT_ANGLE, reversal=MAX_TANGENT_ANGLE)

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.opening = False
        self.ratio = False
        self.blocks: list[tuple[int, bool, bool]] = []
        self.turned_on = 0
        self.narrow = False

    def before_block(self, block: Block) -> None:
        """Check the rules for any block, and those for a block under compensation."""
        self.opening = False
        self.machine.check_codes(block)
        self._decimals(block)
        if self.machine.incremental and not {"I", "J"}.isdisjoint(block.words):
            text = "Under G91 cutcomp counts the center from the arc's start; the manual does not say."
            self.log.inform("G91-CENTER", text, block.at("IJ"))
        # D in a block with G41 or G42 may name the tool that is called, as on other controls
        same_tool = not COMPENSATION_CODES.isdisjoint(block.g) and self.machine.tool in (0, block.words.get("D"))
        if "D" in block.words and not same_tool:
            text = "This control has no D: its radius is that of T. Write T and the diameter, as in T1//.5."
            self.log.stop("CODE", f"{text} {D_AND_H_ANYWHERE}", block.at("D"))
        if "R" in block.words:
            self.log.warn("RADIUS", "cutcomp does not know how this control takes R. Use I and J.", block.at("R"))
        if not self.active:
            return
        if block.m:
            text = "No M code from the block after G41 or G42 to the block with G40. Write it before or after."
            self.log.stop("B14-MCODE", text, block.at("M"))
        if not {180, 190}.isdisjoint(block.g) and 170 not in block.g:
            self.wrong_plane(block)
        wrong = next((code for code in block.g if code in _REFUSED_UNDER_COMPENSATION), None)
        if wrong is not None:
            text = f"cutcomp does not know what compensation does at G{wrong / 10:g}. Write G40 before it."
            self.log.stop("ORIGIN", text, block.at("G", wrong))
        if 990 in block.g:
            text = "The control drops this G99 under compensation and puts its own between tangent moves."
            self.log.inform("B15-G99", text, block.at("G", 990))

    def wrong_plane(self, block: Block) -> NoReturn:
        """Stop the run: compensation works in the XY plane only."""
        self.log.stop("B1-PLANE", "Compensation works in the XY plane only; write G17.", block.at("G"))

    def _decimals(self, block: Block) -> None:
        pointless = _POINTLESS.search(block.text)
        if pointless:
            text = "cutcomp reads a coordinate without a decimal point as whole units. Write the point."
            self.log.warn("B22-DECIMAL", text, Spot(block.line, block.start + pointless.start() + 1))

    def tool_called(self, number: int, block: Block) -> None:
        """Stop the run at a tool number outside 1 to 24, and at any tool call under compensation."""
        if self.active:
            text = "The tool and its diameter stay while compensation is on; write G40 before."
            self.log.stop("B9-AMOUNT", text, block.at("T"))
        if not 1 <= number <= 24:
            self.log.stop("B19-TRANGE", f"This control has tools 1 to 24; {number} is not one of them.", block.at("T"))

    def maker_code(self, code: int, block: Block) -> None:
        """G45 and the G44 that ends it; G99 does not change the path."""
        if code == 450 and not self.ratio:
            text = "cutcomp assumes that G45 holds until G44; the manual does not say."
            self.log.inform("G45", text, block.at("G", 450))
        self.ratio = code == 450 if code in (440, 450) else self.ratio

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41, G42: check the conditions, and apply the offset from the next block on."""
        place = block.at_side()
        if self.active:
            self._again(side, block)
            return
        if self.machine.plane is not Plane.XY:
            self.wrong_plane(block)
        if self.machine.mode not in (0, 10):
            self.log.stop("B2-MODE", "G41 and G42 need G0 or G1; write it in this block.", place)
        offset = self._radius(block) * side.sign
        if offset == 0.0:
            text = "The diameter is 0: G41 and G42 turn nothing on."
            self.machine.nothing_compensated(text, place, code="B3-DIA0", severity=Severity.INFO)
            return
        self.offset, self.active, self.opening = offset, True, True
        self.blocks, self.held, self.start, self.elements = [], None, None, 0
        self.turned_on = block.line

    def _again(self, side: Side, block: Block) -> None:
        place = block.at_side()
        if self._radius(block) * side.sign * self.offset < 0.0:
            self.log.stop("B8-SIDE", "G41 and G42 cannot be swapped while compensation is on. Write G40 before.", place)
        text = "Compensation is on already on this side. cutcomp assumes that is allowed; the manual does not say."
        self.log.warn("B8-SIDE", text, place)

    def _radius(self, block: Block) -> float:
        """Return half the diameter in force, in millimeters."""
        number = self.machine.tool
        tool = self.machine.tools.get(number)
        if not number:
            text = "The tool number must come before G41 or G42. Write T and the number."
            self.log.stop("B5-TOOL", text, block.at_side())
        if tool is None:
            text = f"The diameter of tool {number} is not entered; write T1/length/diameter before."
            self.log.stop("B5-TOOL", text, block.at_side(), tool=number)
        diameter = tool.diameter_mm(self.machine.unit)
        if abs(diameter) > LARGEST_DIAMETER + 1e-6:
            text = "The diameter {0} is beyond the largest of this control, {1}."
            lengths = (diameter, LARGEST_DIAMETER)
            self.log.stop("B4-MAX", text, block.at_side(), lengths=lengths)
        text = "The diameter is negative: the tool runs on the other side."
        self.note_radius(diameter / 2, "NEGATIVE", text, block.at_side())
        return diameter / 2

    def block_without_motion(self, block: Block) -> None:
        """Stop the run at a block that moves nothing, unless it is the one with G41 or G42."""
        if not self.opening:
            self.log.stop("B10-NOMOVE", "Under compensation every block must move the tool. Remove this one.", block)

    def travel(self, element: Element) -> None:
        """Run the turn-on block and moves without compensation as programmed, all others on the offset."""
        if not self.active or self.opening:
            if self.leaving and element.turn:
                self._arc_exit(element)
            super().travel(element)
            return
        if not element.moves and element.start_height == element.end_height:
            self.log.stop("B10-NOMOVE", "Under compensation every block must move the tool. Remove this one.", element)
        self._height(element)
        self._approach(element)
        self._collinear(element)
        if element.turn and not fits(element, self.offset):
            text = "The arc radius {0} is not larger than the cutter radius {1}: the cutter gouges without an alarm."
            lengths = (element.radius, abs(self.offset))
            self.log.warn("B16-NARROW", text, element, lengths=lengths)
        self.hold(element)

    def _height(self, element: Element) -> None:
        """Check the rules on Z: not at the beginning, not with an arc, not twice without two moves between."""
        rises = element.start_height != element.end_height
        self.blocks.append((element.line, rises, element.moves))
        if rises and len(self.blocks) <= 3:
            text = "No Z in the first three compensated blocks; move Z in the block with G41 or after them."
            self.log.stop("B12-ZENDS", text, element)
        if rises and element.turn:
            text = "Under compensation Z goes with straight moves only. How an arc with Z runs is an assumption."
            self.log.warn("B12z-ZARC", text, element)
        if not element.moves and any(rose and not moved for _, rose, moved in self.blocks[-3:-1]):
            self.log.stop("B13-ZSEP", "Program two blocks with X or Y between two Z-only blocks.", element)

    def _approach(self, element: Element) -> None:
        if self.held is not None or not element.moves:
            return
        if element.turn:
            self.log.stop("B6-APPR", "The block after G41 or G42 is the approach; it must be straight.", element)
        self.open_stretch(self.offset, element)

    def _collinear(self, element: Element) -> None:
        held = self.held
        if held is None or self.elements < 2 or held.turn or element.turn or not element.moves:
            return
        (ax, ay), (bx, by) = held.end_direction, element.start_direction
        if abs(ax * by - ay * bx) < MAX_TANGENT_ANGLE:
            text = "Two straight moves in a row lie on one line. Join them into one move."
            self.log.stop("B11-COLLINEAR", text, element)

    def joint(self, first: Element, second: Element) -> Joint:
        """Return the approach's square end, then the meeting of the offsets inside, or an arc outside."""
        if self.elements == 1:
            start = offset_start(second, self.offset)
            return Joint(start, start)
        joint = super().joint(first, second)
        if joint.corner is CornerKind.TANGENT and not self.log.has("G99"):
            text = "Between tangent moves, first at this line, the control puts its own G99: it does not slow down."
            self.log.inform("G99", text, second)
        return joint

    def backwards(self, element: Element) -> None:
        """Report an element that is too short for the cutter, which the control does not notice."""
        rule, what = "B17-STEP", "The step is smaller than the cutter's radius"
        if self.narrow:
            rule, what = "B16-NARROW", "The feature is narrower than the cutter"
        text = f"{what}: this block runs backwards and gouges without an alarm; use a smaller cutter."
        self.log.warn(rule, text, element)

    def release(self, held: Element, end: Point) -> None:
        """Run the held element to a point; trims at both its ends mean a narrow feature, else it is a step."""
        if self.start is not None:
            square = offset_start(held, self.offset), offset_end(held, self.offset)
            self.narrow = self.start != square[0] and end != square[1]
            self._quick(held, self.start, end)
        super().release(held, end)

    def _quick(self, element: Element, start: Point, end: Point) -> None:
        feed, length = self.feed_of(element), dist(start, end)
        if element.turn:
            length = element_sweep(element) * abs(offset_radius(element, self.offset))
        if feed and not element.rapid and length / feed * 60 < SHORTEST_BLOCK_SECONDS:
            text = "This block takes less than a quarter of a second: the control dwells."
            self.log.inform("B18-SHORT", text, element)

    def feed_of(self, element: Element) -> float:
        """Return the feed; under G45 an arc's feed scales with the radius of the tool's path."""
        if not self.ratio or not element.turn or not self.active:
            return element.feed
        return element.feed * abs(offset_radius(element, self.offset)) / element.radius

    def compensation_off(self, block: Block) -> None:
        """G40: end the last element square; the block's own move follows without compensation."""
        if not self.active:
            return
        place = block.at("G", 400)
        moves = not {"X", "Y"}.isdisjoint(block.words)
        if moves and self.machine.mode not in (0, 10):
            self._arc_exit(place)
        if len(self.blocks) < 3:
            self.log.stop("B7-MIN5", "Program at least three compensated blocks between G41 or G42 and G40.", place)
        for line, rises, _ in self.blocks[-3:]:
            if rises:
                text = "No Z in the last three compensated blocks; move Z before them or after G40."
                self.log.stop("B12-ZENDS", text, Spot(line), stops_at=block.line)
        self.release_at_end()
        self.leave()
        self.active = False

    def _arc_exit(self, place: Place) -> NoReturn:
        text = "The move that leaves compensation must be straight. Write G0 or G1. The manual only implies this."
        self.log.stop("B20-G40ARC", text, place)

    def end(self, _: int) -> None:
        """End of the program: report compensation that is still on, and end the last element square."""
        if self.active:
            text = "The program ends with compensation on. Write a block with G40. That it needs one is an assumption."
            line = self.blocks[-1][0] if self.blocks else self.turned_on
            self.log.report(Severity.ERROR, "B21-NOG40", text, Spot(line))
        self.release_at_end()
