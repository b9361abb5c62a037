"""What the blocks of a threeblock program say beside their motion, and the rules on it: tools, codes, G41 and G42."""

from __future__ import annotations

import re
from typing import Final, NoReturn

from core.controls.compensation.offset_chain import Chain
from core.controls.compensation.radius_zero import nothing_compensated
from core.controls.control_run import Log
from core.controls.iso.words import Block
from core.controls.moves import Plane
from core.finding import Severity
from core.geometry.piece import Side

LARGEST_DIAMETER: Final = 83.23072
"""Millimeters (3.2768 in); the 83.321 mm printed beside it has two digits swapped."""

_ORIGINS: Final = frozenset((40, 280, 300, 920, 540, 550, 560, 570, 580, 590, 200, 210, 700, 710))
_POINTLESS: Final = re.compile(r"[XYZIJ][ \t]*[-+]?0*[1-9][0-9]*(?![0-9.])", re.IGNORECASE)


class ThreeBlockWords(Chain):
    """The words; `opening` in the block with G41 or G42, `blocks` what came behind it: line, Z moved, X or Y moved."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.watching = True
        self.opening = False
        self.ratio = False
        self.blocks: list[tuple[int, bool, bool]] = []
        self.turned_on = 0

    def watch(self, block: Block) -> None:
        """The rules that hold for any block, and those for a block under compensation."""
        self.opening = False
        self._decimals(block)
        if self.machine.incremental and not {"I", "J"}.isdisjoint(block.words):
            text = "Under G91 the center is taken as counted from the arc's start; that is an interpretation."
            self.log.tell(Severity.INFO, "G91-CENTER", text, block.line, block.column("IJ"))
        if "R" in block.words:
            text = "Nothing is known of arcs with R on this control; write the center I, J."
            self.log.tell(Severity.WARNING, "RADIUS", text, block.line, block.column("R"))
        if not self.active:
            return
        if block.m:
            text = "No M code between the block behind G41 or G42 and the one with G40; write it before or after."
            self.log.stop("B14-MCODE", text, block.line, block.column("M"))
        if not {170, 180, 190}.isdisjoint(block.g) and 170 not in block.g:
            self.wrong_plane(block)
        wrong = next((code for code in block.g if code in _ORIGINS), None)
        if wrong is not None:
            text = f"What compensation does at G{wrong / 10:g} is not known; write G40 before."
            self.log.stop("ORIGIN", text, block.line, block.column("G", wrong))
        if 990 in block.g:
            text = "G99 is taken out under compensation; the control puts its own between tangent moves."
            self.log.tell(Severity.INFO, "B15-G99", text, block.line, block.column("G", 990))

    def wrong_plane(self, block: Block) -> NoReturn:
        """Stops the run: compensation in another plane than XY."""
        text = "Compensation works in the XY plane only; write G17."
        self.log.stop("B1-PLANE", text, block.line, block.column("G"))

    def _decimals(self, block: Block) -> None:
        found = _POINTLESS.search(block.text)
        if found:
            text = "A coordinate without a decimal point is taken as whole units here; write the point."
            self.log.tell(Severity.WARNING, "B22-DECIMAL", text, block.line, block.start + found.start() + 1)

    def tool_called(self, number: int, block: Block) -> None:
        """Tool numbers are 1 to 24, and stay while compensation is on."""
        if self.active:
            text = "The tool and its diameter stay while compensation is on; write G40 before."
            self.log.stop("B9-AMOUNT", text, block.line, block.column("T"))
        if not 1 <= number <= 24:
            text = f"Tool {number} is none of the tools 1 to 24 of this control."
            self.log.stop("B19-TRANGE", text, block.line, block.column("T"))

    def own(self, code: int, block: Block) -> None:
        """G45 and the G44 that ends it; G99 does nothing to the path."""
        if code == 450 and not self.ratio:
            text = "G45 is taken to hold until G44; that is an interpretation."
            self.log.tell(Severity.INFO, "G45", text, block.line, block.column("G", 450))
        self.ratio = code == 450 if code in (440, 450) else self.ratio

    def begin(self, side: Side, block: Block) -> None:
        """G41, G42: the conditions, and the offset in force from the next block on."""
        column = block.side_column()
        if self.active:
            self._again(side, block)
            return
        if self.machine.plane is not Plane.XY:
            self.wrong_plane(block)
        if self.machine.mode not in (0, 10):
            self.log.stop("B2-MODE", "G41 and G42 need G0 or G1; write it in this block.", block.line, column)
        offset = self._radius(block) * side.sign
        if offset == 0.0:
            text = "The diameter is 0: G41 and G42 turn nothing on."
            nothing_compensated(self.machine, text, block.line, column, code="B3-DIA0", severity=Severity.INFO)
            return
        self.offset, self.active, self.opening = offset, True, True
        self.blocks, self.held, self.start, self.elements = [], None, None, 0
        self.turned_on = block.line

    def _again(self, side: Side, block: Block) -> None:
        column = block.side_column()
        if (self.offset > 0.0) != (side is Side.LEFT) and self._radius(block) > 0.0:
            text = "G41 and G42 cannot be exchanged while compensation is on; write G40 before."
            self.log.stop("B8-SIDE", text, block.line, column)
        text = "Compensation is on already on this side; that this is allowed is an interpretation."
        self.log.tell(Severity.WARNING, "B8-SIDE", text, block.line, column)

    def _radius(self, block: Block) -> float:
        """Half the diameter in force, in millimeters."""
        tool = self.machine.tools.get(self.machine.tool)
        if self.machine.tool == 0 or tool is None:
            text = f"The diameter of tool {self.machine.tool} is not entered; write T1/length/diameter before."
            if self.machine.tool == 0:
                text = "The tool number has to stand before G41 or G42; write T and the number."
            self.log.stop("B5-TOOL", text, block.line, block.side_column())
        diameter = tool.diameter_mm(self.machine.unit)
        if abs(diameter) > LARGEST_DIAMETER + 1e-6:
            text = "The diameter {0} is beyond the largest of this control, {1}."
            lengths = (diameter, LARGEST_DIAMETER)
            self.log.stop("B4-MAX", text, block.line, block.side_column(), lengths=lengths)
        return diameter / 2
