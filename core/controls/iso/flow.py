"""Flow: which line comes next: subprograms by M98, O-words, and what both may not do."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

from core.controls.control_run import Log
from core.controls.iso.dialect import Dialect
from core.controls.iso.owords import OWords, found_in
from core.controls.iso.parameters import Kept, Parameters
from core.controls.iso.words import Block, is_plain, whole
from core.finding import Severity

MOST_BLOCKS: Final = 400_000
"""Blocks that subprograms and loops may run again; beyond it the run stops."""

LONG: Final = 64
WORKED_OUT: Final = 4
"""A line that is more than plain words counts as two blocks, and as one more for so many signs: reading takes time, and
working out expressions a lot of it."""

MOST_OWORDS: Final = 15_000
"""O-words that may run."""

GIVEN_UP: Final = "The run is given up here and not judged: end the loop, or let it run less often."

_LABEL: Final = re.compile(r"[ \t]*+(?:[Nn][ \t]*+[0-9]++)?[ \t]*+[Oo][ \t]*+([0-9]{1,9})(?![0-9])")


@dataclass(slots=True)
class _Call:
    """A subprogram that runs: its number, the line index it starts at and returns to, how often it runs again.

    `depth` is the number of O-word subprograms in which it was called.
    """

    number: int
    start: int
    back: int
    again: int
    depth: int


class Flow:
    """The lines of a program and the one to run next, `at` from 0; `values` are its parameters, if it has any."""

    def __init__(self, lines: list[str], dialect: Dialect, log: Log) -> None:
        self.lines = lines
        self.dialect = dialect
        self.log = log
        self.at = 0
        self.calls: list[_Call] = []
        self.budget = MOST_BLOCKS
        self.ran = bytearray(len(lines))
        self.words_left = MOST_OWORDS
        self.labels: dict[int, int] | None = None
        self.percents = 0
        self.values = Parameters(dialect.parameters) if dialect.parameters else None
        words = found_in(lines) if dialect.parameters is Kept.NGC else {}
        self.owords = OWords(words, self.values, log) if words and self.values else None

    def follow(self, index: int) -> bool:
        """Follows the O-word of a line, if it has one."""
        word = self.owords.words.get(index) if self.owords else None
        if word is None or self.owords is None:
            return False
        if word.word in ("ENDSUB", "RETURN") and self.calls and self.calls[-1].depth == len(self.owords.frames):
            text = "A subprogram called by M98 ends with M99; call it with its O-word, or write M99."
            self.log.stop("OWORD", text, index + 1, word.line.column(word.begin))
        self.words_left -= 1
        if self.words_left < 0:
            text = f"The program has run more than {MOST_OWORDS} O-words. {GIVEN_UP}"
            self.log.stop("LIMIT", text, index + 1, word.line.column(word.begin))
        self.at = self.owords.run(word)
        return True

    @property
    def depth(self) -> int:
        """O-word subprograms that run."""
        return len(self.owords.frames) if self.owords else 0

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
        times = whole(block.words.get("L", 1.0))
        if times is None or times < 0:
            text = "L, how often the subprogram runs, is a whole number, not below 0."
            self.log.stop("SUBPROGRAM", text, block.line, block.column("L"))
        if times > 0:
            self.calls.append(_Call(number, start, self.at, times - 1, self.depth))
            self.at = start

    def _return(self, block: Block) -> bool:
        if "P" in block.words:
            text = "M99 with P goes on at a block number, which is not followed here; write the blocks as they run."
            self.log.stop("BRANCH", text, block.line, block.column("P"))
        if self.owords and self.depth and (not self.calls or self.calls[-1].depth != self.depth):
            text = "A subprogram called by its O-word ends with endsub or return, not with M99."
            self.log.stop("OWORD", text, block.line, block.column("M", 990))
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
            words = self.owords.words if self.owords else {}
            found = ((index, _LABEL.match(line)) for index, line in enumerate(self.lines) if index not in words)
            self.labels = {}
            for index, match in found:
                if match:
                    self.labels.setdefault(int(match[1]), index)
        return self.labels

    def next_line(self, line: int) -> None:
        """Counts a line that is about to run, if it ran before: a plain one as one block, any other as more."""
        if not self.ran[line - 1]:
            self.ran[line - 1] = True
            return
        text = self.lines[line - 1]
        signs = WORKED_OUT if "#" in text or "[" in text else LONG
        self.budget -= 1 if is_plain(text) else 2 + len(text) // signs
        if self.budget < 0:
            text = f"Subprograms or loops run more than {MOST_BLOCKS} blocks again, long ones counted several times"
            self.log.stop("LIMIT", f"{text}. {GIVEN_UP}", line, 1)

    def ended(self) -> None:
        """The file is at its end; what is not closed by then is told."""
        if self.calls or self.depth:
            text = "The file ends inside a subprogram; end the subprogram with M99."
            self.log.tell(Severity.WARNING, "SUBPROGRAM", text, len(self.lines), 1)
        elif self.dialect.end_needed and self.percents < 2:
            self.log.tell(Severity.WARNING, "END", "The program has no end; write M2 or M30.", len(self.lines), 1)
