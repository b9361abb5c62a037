"""What the blocks of a 9/Series program say beside their motion: offsets, alarms on and off, changes of origin."""

from __future__ import annotations

from typing import Final

from core.controls.compensation.generated import Corners
from core.controls.compensation.offset_chain import Chain, Joint
from core.controls.control_run import Log
from core.controls.iso.words import SWITCHES, Block, whole
from core.finding import Severity
from core.geometry.piece import Side

_MACHINE: Final = frozenset((280, 300, 530))
_CHANGES: Final = frozenset((520, 920, 921, 540, 550, 560, 570, 580, 590))


class NineWords(Chain):
    """The words; `coming` is the next element's signed radius, `offset` that of what is held, in millimeters."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.watching = True
        self.corners = Corners.LINES
        self.side: Side | None = None
        self.number = 0
        self.coming = 0.0
        self.leaving: Block | None = None
        self.checks = True

    def interrupt(self, block: Block) -> None:
        """The origin changes while compensation is on."""

    def watch(self, block: Block) -> None:
        """What a block says beside its motion: D, M800 and M801, a change of origin."""
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
            self.interrupt(block)
        if self.active and not _MACHINE.isdisjoint(block.g):
            text = "What compensation does with a move to the machine's own points is not known; write G40 before."
            self.log.stop("HOME", text, block.line, block.column("G"))
        if self.active and self.leaving is None and not {170, 180, 190}.isdisjoint(block.g):
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
        if self.active and self.leaving is None and SWITCHES.isdisjoint(block.g) and self.side is not None:
            self.coming = self.radius(block) * self.side.sign

    def radius(self, block: Block) -> float:
        """Half the diameter of the offset in force, millimeters."""
        if self.number == 0:
            return 0.0
        tool = self.machine.tools.get(self.number)
        if tool is None:
            text = f"Offset {self.number} is not entered; enter its radius or write another D."
            self.log.stop("TOOL", text, block.line, block.column("DG"))
        radius = tool.diameter_mm(self.machine.unit) / 2
        if radius < 0.0:
            text = "The radius is negative: the tool runs on the other side."
            self.log.tell(Severity.INFO, "R4", text, block.line, block.column("DG"))
        return radius

    @property
    def running(self) -> Side:
        """The side on which the tool runs: a negative radius is on the other one, offset 0 on the one written."""
        sign = self.coming or (self.side.sign if self.side else 0)
        return Side.LEFT if sign > 0.0 else Side.RIGHT

    def own(self, code: int, _: Block) -> None:
        """G39 and G39.1."""
        self.corners = Corners.ARC if code == 391 else Corners.LINES

    def goes_on(self, joint: Joint) -> None:
        """The stretch has the coming side and radius behind this joint; behind its entry it had no other one."""
        if self.elements == 1:
            self.begin_span(self.running, self.coming)
        else:
            self.change_span(self.running, self.coming, 1 + len(self.standing), joint.moves)

    def generates(self, line: int) -> None:
        """A generated block, made however short it is."""
        text = "the least length of a generated block (AMP) is taken as 0; the control drops a shorter one."
        self._assumed("AMP", text, line)

    def slows(self, line: int) -> None:
        """The feed inside an arc, however small it is."""
        self._assumed("MFR", "the least feed inside arcs (MFR) is taken as 0; the control may feed faster.", line)

    def _assumed(self, rule: str, text: str, line: int) -> None:
        """Tells once of a value that the machine builder sets."""
        if rule not in self.log.counts:
            words = f"The machine builder sets a value that counts here, and first here: {text}"
            self.log.tell(Severity.INFO, rule, words, line, 1)
