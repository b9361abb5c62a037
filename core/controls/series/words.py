"""Plain lines as arrays: those that hold nothing but the words of moves, each with a number, each letter once.

Such a line means the same to every word-address control: `read_line` makes one block of it by its first expression,
before anything of the control's own way of writing counts.  What is plain here is a part of what that expression takes,
and the numbers are made by the same `float`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.controls.iso.words import NUMBER
from core.controls.moves import Floats
from core.tolerance import LARGEST

Flags = NDArray[np.bool_]

_LETTERS: Final = "GNXYZIJKRF"
_GAP: Final = r"[ \t]*+"
_WORDS: Final = rf"{_GAP}(?:[{_LETTERS}{_LETTERS.lower()}]{_GAP}{NUMBER}{_GAP})+"
_LINE_OF_WORDS: Final = re.compile(_WORDS)
_SOME_LINES: Final = re.compile(rf"(?:{_WORDS}\n){{0,500}}")
_BLANKS: Final = bytes.maketrans((_LETTERS + "\n").encode(), b" " * (len(_LETTERS) + 1))
_NUMBERS: Final = b"0123456789.+- \t"
_LINE: Final = ord("\n")
_MOTIONS: Final = (0.0, 1.0, 2.0, 3.0)


@dataclass(frozen=True, eq=False, slots=True)
class Words:
    """The words of `count` lines by letter: on which lines the letter is written, and its numbers there, else 0."""

    count: int
    given: Mapping[str, Flags]
    values: Mapping[str, Floats]

    def has(self, letters: str) -> Flags:
        """On which lines one of these letters is written."""
        found = np.zeros(self.count, np.bool_)
        for letter in letters:
            if letter in self.given:
                found |= self.given[letter][: self.count]
        return found

    def forward(self, letter: str, scale: float, base: float, before: float) -> Floats:
        """What is in force on each line: `base` and `scale` times a letter's last number, `before` up to its first."""
        if letter not in self.given:
            return np.full(self.count, before)
        given, values = self.given[letter][: self.count], self.values[letter][: self.count]
        rows = np.maximum.accumulate(np.where(given, np.arange(self.count), -1))
        return np.where(rows < 0, before, base + values[rows] * scale)

    def added(self, letter: str, scale: float, before: float) -> Floats:
        """The sums, line by line from `before` on, of what a letter adds."""
        steps = np.zeros(self.count + 1)
        steps[0] = before
        if letter in self.given:
            steps[1:] = self.values[letter][: self.count] * scale
        return np.cumsum(steps)[1:]

    def first(self, count: int) -> Words:
        """The words of the first lines only."""
        return Words(count, self.given, self.values)


def leading(fine: Flags) -> int:
    """How many there are before the first one that is not."""
    return len(fine) if fine.all() else int(np.argmin(fine))


def is_plain(line: str) -> bool:
    """Whether a line holds nothing but the words of moves; every line of `plain_words` does."""
    return _LINE_OF_WORDS.fullmatch(line) is not None


def plain_words(lines: Sequence[str]) -> Words:
    """The words of the leading lines that are plain: G is G0, G1, G2 or G3, and no number beyond what an axis has."""
    text = "\n".join((*lines, ""))
    raw = text[: _plain_up_to(text)].upper().encode("ascii")
    numbers = np.fromiter(map(float, raw.translate(_BLANKS).split()), np.float64)
    signs = np.frombuffer(raw.translate(None, _NUMBERS), np.uint8)
    ends = signs == _LINE
    count = int(np.count_nonzero(ends))
    letters, rows = signs[~ends], np.cumsum(ends)[~ends]
    doubtful = rows[~((numbers > -LARGEST) & (numbers < LARGEST))]
    given, values = {}, {}
    for letter in _LETTERS:
        at = np.flatnonzero(letters == ord(letter))
        if not len(at):
            continue
        mine, column = rows[at], np.zeros(count)
        doubtful = np.concatenate((doubtful, mine[1:][mine[1:] == mine[:-1]]))
        column[mine] = numbers[at]
        given[letter], values[letter] = np.zeros(count, np.bool_), column
        given[letter][mine] = True
    if "G" in values:
        doubtful = np.concatenate((doubtful, np.flatnonzero(~np.isin(values["G"], _MOTIONS))))
    return Words(int(doubtful.min(initial=count)), given, values)


def _plain_up_to(text: str) -> int:
    """Where the leading plain lines end.  Some at a time: an expression keeps all that it might take back."""
    before, end = -1, 0
    while before < end and (found := _SOME_LINES.match(text, end)):
        before, end = end, found.end()
    return end
