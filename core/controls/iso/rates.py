"""Rates: what an F word means (G93, G94, G95), and the spindle that it may go by."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from core.controls.iso.words import Block
from core.finding import Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


INVERSE: Final = 930
PER_MINUTE: Final = 940
PER_TURN: Final = 950

_SURFACE: Final = 960
_SPINDLE: Final = {30: 1, 40: -1, 50: 0, 190: 0}


class Rates:
    """The meaning of F in force; `speed` in turns a minute, `turning` +1 for M3, -1 for M4, 0 for none."""

    def __init__(self) -> None:
        self.mode = PER_MINUTE
        self.speed = 0.0
        self.turning = 0
        self.surface = False

    def take(self, block: Block) -> None:
        """S, M3, M4, M5, G96 and G97."""
        if "S" in block.words:
            self.speed = abs(block.words["S"])
        for code in block.m:
            self.turning = _SPINDLE.get(code, self.turning)

    def set(self, code: int, machine: Machine) -> None:
        """G93, G94 or G95; where the meaning changes there is no feed any more."""
        if code != self.mode:
            machine.feed = 0.0
        self.mode = code

    def set_speed(self, code: int) -> None:
        """G96, where S is the speed of the cutter's edge, or G97."""
        self.surface = code == _SURFACE

    def feed(self, machine: Machine, block: Block, length: float) -> float:
        """The feed of a move of this length under G93 or G95, millimeters a minute; 0 where it is not known."""
        column = block.column("FXYZIJ")
        if self.mode == INVERSE:
            if "F" not in block.words:
                text = "Under G93 every move at feed needs its own F; write it in this block."
                machine.log.stop("FEED", text, block.line, column)
            return block.words["F"] * length
        if not machine.feed:
            return 0.0
        if not self.speed or self.surface:
            text = "Under G95 the feed goes with the spindle, whose speed is not known here; write S in turns a minute."
            if machine.dialect.feed_needed and not self.surface:
                machine.log.stop("FEED", text, block.line, column)
            machine.log.tell(Severity.WARNING, "FEED", text, block.line, column)
        return 0.0 if self.surface else machine.feed * self.speed
