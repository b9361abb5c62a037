"""Runs a program: lines in order, subprograms in their places, until its end or an alarm."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from core.controls.dialect import Dialect
from core.controls.follower import Follower
from core.controls.machine import Machine
from core.controls.report import AlarmError, Log, Run
from core.controls.source import lines_of
from core.controls.tools import ToolTable
from core.controls.words import Block, read_line, whole
from core.finding import Severity

MOST_BLOCKS: Final = 400_000
"""Blocks that subprograms may add to those of the file; beyond it the run stops."""

_LABEL: Final = re.compile(r"[ \t]*+(?:[Nn][ \t]*+[0-9]++)?[ \t]*+[Oo][ \t]*+([0-9]{1,9})(?![0-9])")


@dataclass(slots=True)
class _Call:
    """A subprogram that runs: its number, the line index it starts at and returns to, how often it runs again."""

    number: int
    start: int
    back: int
    again: int


class _Flow:
    """Which line comes next."""

    def __init__(self, lines: list[str], dialect: Dialect, log: Log) -> None:
        self.lines = lines
        self.dialect = dialect
        self.log = log
        self.at = 0
        self.calls: list[_Call] = []
        self.budget = len(lines) + MOST_BLOCKS
        self.labels: dict[int, int] | None = None
        self.percents = 0

    def after(self, block: Block) -> bool:
        """Follows a block's M98 or M99; False where the program ends with it."""
        if 980 in block.m:
            self._call(block)
        elif 990 in block.m:
            return self._return(block)
        elif "O" in block.words and not self.calls and self.at > 1 and self._code_before():
            text = "The program runs into a subprogram; end it with M30 or M2 before the subprograms."
            self.log.tell(Severity.WARNING, "SUBPROGRAM", text, block.line, block.column("O"))
        return True

    def _code_before(self) -> bool:
        return any(line.strip() and line.strip()[0] not in "(;%" for line in self.lines[: self.at - 1])

    def _call(self, block: Block) -> None:
        number = whole(block.words.get("P", -1.0))
        column = block.column("P" if "P" in block.words else "M", None if "P" in block.words else 980)
        if not self.dialect.subprograms:
            self.log.stop("SUBPROGRAM", "This control has no subprograms; write the blocks out.", block.line, column)
        if number is None or number < 0:
            self.log.stop("SUBPROGRAM", "M98 needs P and the number of a subprogram.", block.line, column)
        if any(call.number == number for call in self.calls):
            self.log.stop("SUBPROGRAM", f"Subprogram O{number} calls itself without end.", block.line, column)
        start = self._labels().get(number)
        if start is None:
            text = f"There is no subprogram O{number} in this file; write it behind the end of the program."
            self.log.stop("SUBPROGRAM", text, block.line, column)
        times = int(block.words.get("L", 1.0))
        if times > 0:
            self.calls.append(_Call(number, start, self.at, times - 1))
            self.at = start

    def _return(self, block: Block) -> bool:
        if not self.calls:
            text = "M99 in the main program starts it again without end; it is taken as its end here."
            self.log.tell(Severity.INFO, "SUBPROGRAM", text, block.line, block.column("M", 990))
            return False
        call = self.calls[-1]
        if call.again:
            call.again -= 1
            self.at = call.start
        else:
            self.calls.pop()
            self.at = call.back
        return True

    def _labels(self) -> dict[int, int]:
        if self.labels is None:
            found = ((index, _LABEL.match(line)) for index, line in enumerate(self.lines))
            self.labels = {}
            for index, match in found:
                if match:
                    self.labels.setdefault(int(match[1]), index)
        return self.labels

    def next_line(self, line: int) -> None:
        """Counts a line that is about to run."""
        self.budget -= 1
        if self.budget < 0:
            text = f"The program has run more than {MOST_BLOCKS} blocks of subprograms and is given up."
            self.log.stop("LIMIT", text, line, 1)


def execute(
    text: bytes,
    name: str,
    dialect: Dialect,
    tools: ToolTable,
    log: Log,
    make: Callable[[Log], Follower],
) -> Run:
    """A program on a control, compensated by the follower that `make` gives."""
    follower = make(log)
    machine = Machine(dialect, follower, tools, log)
    stopped_at = None
    try:
        _run(_Flow(lines_of(text), dialect, log), machine)
    except AlarmError as alarm:
        log.add(alarm.finding)
        stopped_at = alarm.line
    follower.close_span()
    unit = machine.moved_in or machine.unit
    return Run(name, unit, follower.tape.moves(), log.closed(), stopped_at, tuple(follower.stretches))


def _run(flow: _Flow, machine: Machine) -> None:
    """Runs lines until the program ends."""
    lines, dialect, log = flow.lines, flow.dialect, flow.log
    while flow.at < len(lines):
        line = flow.at = flow.at + 1
        flow.next_line(line)
        text = lines[line - 1]
        for block in read_line(text, line, log, dialect.syntax):
            machine.step(block)
            if block.moves_only:
                continue
            if machine.ended or (_calls(block) and not flow.after(block)):
                machine.follower.close()
                return
        if dialect.percent_ends and text.strip() == "%":
            flow.percents += 1
            if flow.percents > 1:
                break
    if flow.calls:
        text = "The file ends inside a subprogram; end the subprogram with M99."
        log.tell(Severity.WARNING, "SUBPROGRAM", text, len(lines), 1)
    elif dialect.end_needed and flow.percents < 2:
        log.tell(Severity.WARNING, "END", "The program has no end; write M2 or M30.", len(lines), 1)
    machine.follower.close()


def _calls(block: Block) -> bool:
    return bool(block.m) or "O" in block.words
