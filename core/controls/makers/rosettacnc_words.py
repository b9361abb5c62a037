"""What G41, G42, G41.1 and G42.1 ask for on RosettaCNC, and what is refused while they are in force."""

from __future__ import annotations

from typing import Final

from core.controls.compensation.follower import Follower
from core.controls.compensation.radius_zero import nothing_compensated
from core.controls.control_tools import not_there
from core.controls.iso.words import SWITCHES, Block, whole
from core.controls.moves import Plane
from core.finding import Severity
from core.geometry.piece import Side

_NOT_NOW: Final = frozenset((170, 180, 190, 280, 300, 520, 530, 920, 540, 550, 560, 570, 580, 590, 591, 592, 593))
_PLANES: Final = {170: Plane.XY, 180: Plane.ZX, 190: Plane.YZ}


class Switch:
    """What G41, G42, G41.1 and G42.1 ask for on this control, and what is refused while they are in force."""

    def __init__(self, follower: Follower) -> None:
        self.follower = follower

    def offset(self, side: Side, block: Block) -> float:
        """The signed radius asked for, in millimeters; trouble stops the run."""
        column = block.side_column()
        if self.follower.active:
            text = "Compensation is on already; write G40 before it is turned on again."
            self.follower.log.stop("C2", text, block.line, column)
        point_one = not {411, 421}.isdisjoint(block.g)
        radius = self._diameter(block) / 2 if point_one else self._table(block)
        if radius == 0.0:
            nothing_compensated(self.follower.machine, "The radius is 0.", block.line, column)
        if radius < 0.0:
            text = "The radius is negative and changes the side; that is an interpretation."
            self.follower.log.tell(Severity.INFO, "NEGATIVE", text, block.line, column)
        return radius * side.sign

    def _diameter(self, block: Block) -> float:
        machine, log = self.follower.machine, self.follower.log
        if machine.plane is Plane.YZ:
            text = "G41.1 and G42.1 do not work in the plane G19; write G41 or another plane."
            log.stop("C3", text, block.line, block.side_column())
        if "D" not in block.words:
            text = "G41.1 and G42.1 need D and the cutter's diameter."
            log.stop("C1", text, block.line, block.side_column())
        self._orientation(block)
        return block.words["D"] * machine.scale

    def _orientation(self, block: Block) -> None:
        log, column = self.follower.log, block.column("L")
        if "L" not in block.words:
            return
        number = whole(block.words["L"])
        if number is None or not 0 <= number <= 9:
            log.stop("C4", "L, the orientation of a lathe tool, is 0 to 9.", block.line, column)
        if self.follower.machine.plane is not Plane.ZX:
            log.stop("C5", "L goes with the plane G18 only; leave it out.", block.line, column)
        self._nose(number, block, column)

    def _nose(self, orientation: int, block: Block, column: int) -> None:
        if orientation not in (0, 9):
            text = "The moves are those of the center of the tool's nose; the orientation does not shift them here."
            self.follower.log.tell(Severity.WARNING, "ORIENTATION", text, block.line, column)

    def _table(self, block: Block) -> float:
        machine, log = self.follower.machine, self.follower.log
        number = machine.tool
        if "D" in block.words:
            wanted = whole(block.words["D"])
            if wanted is None or wanted <= 0:
                text = "D is a tool number, 1 or more; a diameter goes with G41.1."
                log.stop("C1", text, block.line, block.column("D"))
            number = wanted
        tool = machine.tools.get(number)
        if tool is None and number:
            column = block.column("D") if "D" in block.words else block.side_column()
            log.stop("C1", not_there(number), block.line, column)
        if tool is None:
            text = "No tool is loaded and there is no D, so the radius is 0."
            nothing_compensated(machine, text, block.line, block.side_column())
        if tool is not None:
            self._nose(tool.orientation, block, block.side_column())
        radius = tool.diameter_mm(machine.unit) / 2 if tool else 0.0
        return radius - block.words.pop("I", 0.0) * machine.scale

    def watch(self, block: Block) -> None:
        """The list of NIST, of which nobody said that it holds here."""
        log = self.follower.log
        if "D" in block.words and SWITCHES.isdisjoint(block.g):
            text = "D needs G41 or G42 in its block. That is an interpretation, by the list of NIST."
            log.stop("C8", text, block.line, block.column("D"))
        if not self.follower.active:
            return
        for code in _NOT_NOW.intersection(block.g):
            if _PLANES.get(code) is not self.follower.machine.plane:
                text = f"G{code / 10:g} is not allowed under compensation. That is an interpretation, by NIST's list."
                log.stop("C8", text, block.line, block.column("G", code))
