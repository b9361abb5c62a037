"""The road for long programs: chunks of plain lines that are run at once, between lines that are run one by one.

The same program gives the same run on both roads: lines are plain or they are not (`words`); the machine says nothing
of a block or the block is left to it (`blocks`); and a follower takes elements as it would one by one
(`travel_all`).  How many lines are tried at a time has no bearing on what comes out, only on the time: few behind a
line that was not plain, twice as many each time all of them were.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from core.controls.series import blocks
from core.controls.series.words import plain_words

if TYPE_CHECKING:
    from core.controls.iso.flow import Flow
    from core.controls.iso.machine import Machine

LEAST: Final = 24
"""Lines from which on arrays are faster than one line after the other."""

FEW: Final = 64
MANY: Final = 8192
"""How many lines are tried at a time, at least and at most."""

LONGEST: Final = 512
"""Lines that are run one by one at most before plain ones are looked for again."""


class Road:
    """What is tried next: `size` lines at a time, after `wait` lines that run one by one."""

    def __init__(self) -> None:
        self.size = FEW
        self.wait = 0
        self.pause = LEAST

    def ahead(self, flow: Flow, machine: Machine) -> bool:
        """Runs the plain lines from here on, if they are worth it; whether there is a line behind them."""
        if self.wait:
            self.wait -= 1
        else:
            while flow.at + LEAST <= len(flow.lines) and blocks.ready(machine) and self._whole(flow, machine):
                pass
        return flow.at < len(flow.lines)

    def _whole(self, flow: Flow, machine: Machine) -> bool:
        """Tries the next lines, and tells whether all of them are run."""
        lines = flow.lines[flow.at : flow.at + min(self.size, flow.budget)]
        count = self._run(lines, flow, machine)
        few = count < LEAST
        self.pause = min(2 * self.pause, LONGEST) if few else LEAST
        self.wait = self.pause if few else 0
        self.size = max(FEW, min(2 * count, MANY))
        return not few and count == len(lines)

    def _run(self, lines: Sequence[str], flow: Flow, machine: Machine) -> int:
        """Runs as many of the next lines as can be, and tells how many."""
        words = plain_words(lines)
        if words.count < LEAST or not machine.follower.passes(words, lines):
            return 0
        course = blocks.course(machine, words, flow.at + 1)
        if course.elements.size < LEAST:
            return 0
        count = machine.follower.travel_all(course.elements)
        course.settle(machine, count)
        flow.passed(count)
        return count
