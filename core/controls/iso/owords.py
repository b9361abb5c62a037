"""O-words: LinuxCNC's subprograms, branches and loops, from line to line.

`O100 sub` ... `O100 endsub`, `O100 call [1] [2]`, `if`, `elseif`, `else`, `endif`, `while`, `endwhile`, `do`, `repeat`,
`endrepeat`, `break`, `continue`, `return`.  A label is a number or a name; where a word leads is found by its label.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple, NoReturn

from core.controls.control_run import Log
from core.controls.iso.expressions import Reader
from core.controls.iso.macro import Squeezed, tell_unset
from core.controls.iso.parameters import FaultError, Parameters
from core.controls.program_text import quoted

DEEPEST: Final = 9
"""Subprograms that may run inside each other."""

_MOST_ARGUMENTS: Final = 30
_WORDS: Final = "ENDSUB|SUB|CALL|ELSEIF|ENDIF|IF|ELSE|ENDWHILE|WHILE|DO|ENDREPEAT|REPEAT|BREAK|CONTINUE|RETURN"
_LINE: Final = re.compile(rf"(?:N[0-9]++)?O(?:([0-9]++)|<([^<>]++)>|([#\[].*?))({_WORDS})(?=[\[#]|$)")
_COMMENT: Final = re.compile(r"\([^)]*+(?:\)|$)|;.*")
"""One that is not closed is found too, so that no line is searched again from each of its brackets."""
_ENDS: Final = {"WHILE": "ENDWHILE", "DO": "WHILE"}


class OWord(NamedTuple):
    """An O-word: its row of the file from 0, label and word; the line, where the word begins, and what is behind it.

    The label is empty where it is worked out when it runs.
    """

    row: int
    label: str
    word: str
    line: Squeezed
    begin: int
    behind: int


@dataclass(slots=True)
class Open:
    """A branch or a loop that runs: its first word, where that stands, how often a repeat runs again."""

    word: str
    row: int
    again: int = 0


@dataclass(slots=True)
class Frame:
    """A subprogram that runs: its label, where it returns to, what is open in it."""

    label: str
    back: int
    opened: dict[str, Open] = field(default_factory=dict)


def found_in(lines: Sequence[str]) -> dict[int, OWord]:
    """The O-words of a program by their line's index."""
    found = ((index, _read(index, line)) for index, line in enumerate(lines) if "o" in line or "O" in line)
    return {index: word for index, word in found if word is not None}


def _read(index: int, line: str) -> OWord | None:
    if not line.isascii():
        return None
    bare = _COMMENT.sub(_blank, line.upper())
    squeezed = Squeezed.of(bare)
    match = _LINE.match(squeezed.text)
    if match is None:
        return None
    label = match[1].lstrip("0") or "0" if match[1] else match[2] or ""
    return OWord(index, label, match[4], squeezed, match.start(4), match.end())


def _blank(comment: re.Match[str]) -> str:
    """Blanks for a comment; one that is not closed is left for the words' reader to tell."""
    text = comment[0]
    return " " * len(text) if text.endswith(")") or text.startswith(";") else text


class OWords:
    """Follows them; `run` gives the index of the next line."""

    def __init__(self, words: dict[int, OWord], values: Parameters, log: Log) -> None:
        self.words = words
        self.values = values
        self.log = log
        self.frames: list[Frame] = []
        self.opened: dict[str, Open] = {}
        self.begun: dict[tuple[str, str], int] = {}
        self.by_label: dict[str, list[OWord]] = {}
        for word in words.values():
            self.by_label.setdefault(word.label, []).append(word)
        self._steps: dict[str, Callable[[OWord], int]] = {
            "SUB": self._sub,
            "CALL": self._call,
            "ENDSUB": self._end,
            "RETURN": self._end,
            "IF": self._if,
            "ELSEIF": self._else,
            "ELSE": self._else,
            "ENDIF": self._endif,
            "WHILE": self._while,
            "ENDWHILE": self._again,
            "DO": self._do,
            "REPEAT": self._repeat,
            "ENDREPEAT": self._again,
            "BREAK": self._break,
            "CONTINUE": self._continue,
        }

    def run(self, word: OWord) -> int:
        """Runs an O-word."""
        if not word.label and word.word != "CALL":
            self._stop(word, "Only call takes a label that is worked out; write the number itself.")
        return self._steps[word.word](word)

    def _stop(self, word: OWord, text: str) -> NoReturn:
        self.log.stop("OWORD", text, word.row + 1, word.line.column(word.begin))

    def _fault(self, word: OWord, fault: FaultError) -> NoReturn:
        self.log.stop(fault.code, fault.text, word.row + 1, word.line.column(fault.at))

    @property
    def _opened(self) -> dict[str, Open]:
        return self.frames[-1].opened if self.frames else self.opened

    def _values(self, word: OWord, most: int) -> list[float]:
        """The bracketed values behind a word; anything else there stops the run."""
        text, found = word.line.text, list[float]()
        reader = Reader(text, self.values, word.behind)
        try:
            while reader.at < len(text) and len(found) < most:
                found.append(reader.brackets())
            if reader.at < len(text):
                rest = f"{quoted(text[reader.at :])} has no place behind {word.word.lower()} here."
                raise FaultError("OWORD", rest, reader.at)
        except FaultError as fault:
            self._fault(word, fault)
        tell_unset(reader, word.line, word.row + 1, self.log)
        return found

    def _true(self, word: OWord) -> bool:
        values = self._values(word, 1)
        if not values:
            self._stop(word, f"{word.word.lower()} needs a condition in square brackets.")
        return values[0] != 0.0

    def _seek(self, word: OWord, *wanted: str) -> OWord:
        """The next of some words of the same label behind a word."""
        later = (other for other in self.by_label[word.label] if other.row > word.row and other.word in wanted)
        found = next(later, None)
        if found is None:
            self._stop(word, f"There is no {wanted[-1].lower()} of this label behind {word.word.lower()}.")
        return found

    def _open(self, word: OWord, *wanted: str) -> Open:
        """What is open under a word's label."""
        opened = self._opened.get(word.label)
        if opened is None or opened.word not in wanted:
            before = " or ".join(one.lower() for one in wanted)
            self._stop(word, f"{word.word.lower()} has no {before} of its label before it.")
        return opened

    def _sub(self, word: OWord) -> int:
        """A subprogram that is met is stepped over."""
        if self.frames:
            self._stop(word, "A subprogram begins inside a subprogram; write it behind the end of that one.")
        self._fresh(word)
        self._values(word, 0)
        end = self._seek(word, "ENDSUB")
        nested = next((one for one in self.words.values() if one.word == "SUB" and word.row < one.row < end.row), None)
        if nested:
            self._stop(nested, "A subprogram begins inside a subprogram; write it behind the end of that one.")
        return end.row + 1

    def _call(self, word: OWord) -> int:
        label = word.label or self._worked_label(word)
        begun = next((other for other in self.by_label.get(label, ()) if other.word == "SUB"), None)
        if begun is None:
            name = f"O{label}" if label.isdigit() else f"O<{label.lower()}>"
            self._stop(word, f"There is no subprogram {quoted(name)} in this file; other files are not read.")
        if len(self.frames) >= DEEPEST:
            self._stop(word, f"More than {DEEPEST} subprograms run inside each other; the control stops here.")
        self.values.enter(self._values(word, _MOST_ARGUMENTS))
        self.frames.append(Frame(label, word.row + 1))
        return begun.row + 1

    def _worked_label(self, word: OWord) -> str:
        at = word.line.text.index("O") + 1
        reader = Reader(word.line.text, self.values, at)
        try:
            value = reader.value()
        except FaultError as fault:
            self._fault(word, fault)
        if reader.at != word.begin or value != round(value):
            self._stop(word, "The label of a subprogram has to be a whole number.")
        return str(round(value))

    def _end(self, word: OWord) -> int:
        if not self.frames:
            self._stop(word, f"{word.word.lower()} stands outside of any subprogram that was called.")
        if word.word == "ENDSUB" and self.frames[-1].label != word.label:
            self._stop(word, "Another subprogram is running than the one that ends here.")
        values = self._values(word, 1)
        self.values.leave(values[0] if values else None)
        return self.frames.pop().back

    def _if(self, word: OWord) -> int:
        self._fresh(word)
        if self._true(word):
            self._opened[word.label] = Open("IF", word.row)
            return word.row + 1
        return self._other_branch(word)

    def _other_branch(self, word: OWord) -> int:
        """The branch that runs where a condition is false."""
        while True:
            word = self._seek(word, "ELSEIF", "ELSE", "ENDIF")
            if word.word == "ENDIF":
                return word.row + 1
            if word.word == "ELSE" or self._true(word):
                self._opened[word.label] = Open("IF", word.row)
                return word.row + 1

    def _else(self, word: OWord) -> int:
        """The end of a branch that ran."""
        self._open(word, "IF")
        del self._opened[word.label]
        return self._seek(word, "ENDIF").row + 1

    def _endif(self, word: OWord) -> int:
        self._open(word, "IF")
        del self._opened[word.label]
        return word.row + 1

    def _fresh(self, word: OWord) -> None:
        """A label that began something once cannot begin anything else in its subprogram."""
        key = (self.frames[-1].label if self.frames else "", word.label)
        if self.begun.setdefault(key, word.row) != word.row:
            text = f"This label is in use since line {self.begun[key] + 1}; give this {word.word.lower()} its own."
            self._stop(word, text)

    def _while(self, word: OWord) -> int:
        opened = self._opened.get(word.label)
        if opened is not None and opened.word == "DO":
            if self._true(word):
                return opened.row + 1
            del self._opened[word.label]
            return word.row + 1
        self._fresh(word)
        if not self._true(word):
            self._opened.pop(word.label, None)
            return self._seek(word, "ENDWHILE").row + 1
        self._opened[word.label] = Open("WHILE", word.row)
        return word.row + 1

    def _do(self, word: OWord) -> int:
        self._fresh(word)
        self._values(word, 0)
        self._opened[word.label] = Open("DO", word.row)
        return word.row + 1

    def _repeat(self, word: OWord) -> int:
        self._fresh(word)
        values = self._values(word, 1)
        if not values:
            self._stop(word, "repeat needs a number in square brackets.")
        times = round(values[0])
        if times <= 0:
            return self._seek(word, "ENDREPEAT").row + 1
        self._opened[word.label] = Open("REPEAT", word.row, times - 1)
        return word.row + 1

    def _again(self, word: OWord) -> int:
        """The end of a loop."""
        opened = self._open(word, word.word.removeprefix("END"))
        if opened.word == "WHILE":
            return opened.row
        if opened.again > 0:
            opened.again -= 1
            return opened.row + 1
        del self._opened[word.label]
        return word.row + 1

    def _break(self, word: OWord) -> int:
        opened = self._open(word, "WHILE", "DO")
        end = self._seek(word, _ENDS[opened.word])
        del self._opened[word.label]
        return end.row + 1

    def _continue(self, word: OWord) -> int:
        opened = self._open(word, "WHILE", "DO")
        return self._seek(word, _ENDS[opened.word]).row
