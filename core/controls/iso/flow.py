"""This module finds the line to run next, by subprograms and O-words; `macro_b_flow` does so for Fanuc and Haas.

LinuxCNC's O-words take a line each: `O100 sub` ... `O100 endsub`, `O100 call [1] [2]`, `if`, `elseif`, `else`,
`endif`, `while`, `endwhile`, `do`, `repeat`, `endrepeat`, `break`, `continue`, `return`.  A label, a number or a
name, ties words that belong together.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple, NoReturn

from core.controls.control_run import NOT_RUN_TEXT, Log, Spot
from core.controls.iso.code_support import CONTROLS_WITH_JUMPS, only_on
from core.controls.iso.expressions import CompactText, ExpressionReader, FaultError, MacroParameters, report_unset
from core.controls.iso.machine import Control, Machine
from core.controls.iso.reader import Block, check_length, has_words, read_line, whole, whole_word, without_comments
from core.controls.program_text import lines_of, quoted

SIGNS_PER_BLOCK: Final = 64
SIGNS_PER_EXPRESSION: Final = 4
"""A line counts as a block more for every so many characters: reading it takes time, and evaluating expressions takes
much more."""

MAX_NESTED: Final = 9
"""How deep subprograms of O-words may nest."""

MAX_ARGUMENTS: Final = 30

MAX_O_WORDS: Final = 15_000
"""O-words that may run before cutcomp gives up the run."""

_FLOW_WORDS: Final = "ENDSUB|SUB|CALL|ELSEIF|ENDIF|IF|ELSE|ENDWHILE|WHILE|DO|ENDREPEAT|REPEAT|BREAK|CONTINUE|RETURN"
_PROGRAM_ALONE: Final = re.compile(r"[ \t]*O[ \t]*0*([0-9]+)[ \t]*(?:\(.*)?$", re.IGNORECASE)
_LINE: Final = re.compile(rf"(?:N[0-9]++)?O(?:([0-9]++)|<([^<>]++)>|([#\[].*?))({_FLOW_WORDS})(?=[\[#]|$)")
_LOOP_ENDS: Final = {"WHILE": "ENDWHILE", "DO": "WHILE", "REPEAT": "ENDREPEAT"}


ProgramLibrary = Callable[[int | str], tuple[str, bytes] | None]
"""Returns the name and text of a program outside the file, by its number or the label of LinuxCNC's O-word."""


def no_library(_: int | str) -> None:
    """Return None: a library without programs."""


class OWord(NamedTuple):
    """An O-word: its row from 0, label and word, and its text with where the word begins and ends in it.

    The label is empty if it must be evaluated when the word runs.
    """

    row: int
    label: str
    word: str
    text: CompactText
    begin: int
    end: int

    @property
    def line(self) -> int:
        """The number of its line."""
        return self.row + 1

    @property
    def column(self) -> int:
        """The column of the word."""
        return self.text.place(self.begin).column


@dataclass(slots=True)
class OpenBlock:
    """A branch or a loop that runs: its first word, that word's row, and how often a repeat runs again."""

    word: str
    row: int
    again: int = 0


@dataclass(slots=True)
class Call:
    """The program or a running subprogram: the line index it returns to, and the blocks that O-words `opened` in it.

    `label` is that of a subprogram called by an O-word, None for the program.  A subprogram called by M98 has its
    `number`, the index of its `start` and how often it runs `again`; it shares its caller's `label` and `opened`.
    `loops` are the rows of the open WHILE and DO loops by number; `macro`: it has variables of its own.  No condition
    in it came closer to its end for `rows_without_progress`; `least_differences` are the closest so far.
    """

    back: int
    label: str | None = None
    opened: dict[str, OpenBlock] = field(default_factory=dict)
    number: int | None = None
    start: int = 0
    again: int = 0
    loops: dict[int, int] = field(default_factory=dict)
    macro: bool = False
    rows_without_progress: int = 0
    least_differences: dict[tuple[int, int], float] = field(default_factory=dict)


def o_words_of(lines: Sequence[str], first: int = 0) -> dict[int, OWord]:
    """Return the O-words of a program by line index; `first` is the index of the first of these lines."""
    read = ((index, _read(index, line)) for index, line in enumerate(lines, first) if "o" in line or "O" in line)
    return {index: word for index, word in read if word is not None}


def _read(index: int, line: str) -> OWord | None:
    if not line.isascii():
        return None
    squeezed = CompactText.of(without_comments(line.upper()), index + 1)
    match = _LINE.match(squeezed.text)
    if match is None:
        return None
    label = match[1].lstrip("0") or "0" if match[1] else match[2] or ""
    return OWord(index, label, match[4], squeezed, match.start(4), match.end())


GIVEN_UP_TEXT: Final = "cutcomp stops here and does not judge the run. Fix the loop or repeat fewer times."

_LABEL: Final = re.compile(r"[ \t]*+(?:[Nn][ \t]*+[0-9]++)?[ \t]*+[Oo][ \t]*+([0-9]{1,9})(?![0-9])")


def _labels_of(lines: Sequence[str], words: Mapping[int, OWord]) -> dict[int, int]:
    """Return where the subprograms of M98 begin: by number, the index of the first line with that O but no O-word."""
    labels: dict[int, int] = {}
    for index, line in enumerate(lines):
        label = None if index in words else _LABEL.match(line)
        if label:
            labels.setdefault(int(label[1]), index)
    return labels


class CalledFile(NamedTuple):
    """A file that a line of the main file calls; `before` is the number of the line before its first one."""

    before: int
    line: int
    name: str
    lines: int


class Flow:
    """The lines of a program and the index `at` of the one to run next; `values` are its parameters, if it has any.

    Lines of called files follow the file's own, of which there are `main_lines`.  A file is added once for each line of
    the main file that calls it, so that its moves and findings count for the line of their own call.
    """

    def __init__(self, lines: list[str], machine: Machine, library: ProgramLibrary) -> None:
        self.lines = lines
        self.main_lines = len(lines)
        self.called_from: list[CalledFile] = []
        self.library = library
        self.dialect = dialect = machine.dialect
        self.log = machine.log
        self.at = 0
        code = (index for index, line in enumerate(lines) if line.strip() and line.strip()[0] not in "(;%")
        self.first_code = next(code, len(lines))
        self.calls = [Call(len(lines))]
        self.budget = dialect.max_repeated_blocks
        self.ran = bytearray(len(lines))
        self.percents = 0
        self.values = MacroParameters(dialect.parameters, machine.value_of) if dialect.parameters else None
        self.labels = _labels_of(lines, {})

    def add_called(self, name: str, count: int, line: int) -> int:
        """Note a file that a line calls; return the number of its first line."""
        last = self.called_from[-1] if self.called_from else CalledFile(self.main_lines, 0, "", 0)
        called = CalledFile(last.before + last.lines, self.origin_of(line)[0], name, count)
        self.called_from.append(called)
        return called.before + 1

    def origin_of(self, number: int) -> tuple[int, str]:
        """Return the main file's line that a line counts for, and its own place in a called file: `O3001.nc line 5`."""
        if number <= self.main_lines:
            return number, ""
        called = self.called_from[bisect_right(self.called_from, number - 1, key=lambda file: file.before) - 1]
        return called.line, f"{called.name} line {number - called.before}"

    def blocks(self, line: int) -> Iterable[Block]:
        """Return the blocks of a line."""
        if self.dialect.syntax.strict:
            check_length(self.lines[line - 1], line, self.log)
        return read_line(self.lines[line - 1], line, self.log, self.dialect.syntax, self.values)

    def ends_here(self, line: int, /) -> bool:
        """True if the program ends with a line that was run."""
        if self.dialect.percent_ends and self.lines[line - 1].strip() == "%":
            self.percents += 1
        return self.percents > 1 or (len(self.calls) == 1 and self.at >= self.main_lines)

    def follow_call(self, block: Block) -> bool:
        """Follow a block's M98 or M99; False if the program ends with it."""
        if 980 in block.m:
            self._call(block)
        elif 990 in block.m:
            return self._return(block)
        elif "O" in block.words and not self._numbers() and self.first_code < self.at - 1:
            text = "The program runs into a subprogram; end it with M30 or M2 before the subprograms."
            self.log.warn("SUBPROGRAM", text, block.at("O"))
        return True

    def _numbers(self) -> set[int]:
        """Return the numbers of the running subprograms that M98 called."""
        return {call.number for call in self.calls if call.number is not None}

    def _call(self, block: Block) -> None:
        number = whole(block.words.get("P", -1.0))
        place = block.at("P" if "P" in block.words else "M", None if "P" in block.words else 980)
        if not self.dialect.subprograms:
            self.log.stop("SUBPROGRAM", "This control has no subprograms; write the blocks out.", place)
        if number is None or number < 0:
            self.log.stop("SUBPROGRAM", "M98 needs P and the number of a subprogram.", place)
        if number in self._numbers():
            self.log.stop("SUBPROGRAM", f"Subprogram O{number} calls itself without end.", place)
        start = self.labels.get(number)
        if start is None:
            text = f"There is no subprogram O{number} in this file. Put it after the end of the program."
            self.log.stop("SUBPROGRAM", text, place)
        text = "L, how often the subprogram runs, is a whole number, not below 0."
        times = whole_word(block, "L", self.log, "SUBPROGRAM", text, default=1.0)
        if times > 0:
            caller = self.calls[-1]
            self.calls.append(Call(self.at, caller.label, caller.opened, number, start, times - 1))
            self.at = start

    def _return(self, block: Block) -> bool:
        if "P" in block.words:
            text = "M99 with P goes on at a block number, which cutcomp does not follow. Write the blocks as they run."
            self.log.stop("BRANCH", f"{text} {only_on(CONTROLS_WITH_JUMPS)}", block.at("P"))
        if len(self.calls) > 1 and self.calls[-1].number is None:
            text = "A subprogram called by its O-word ends with endsub or return, not with M99."
            self.log.stop("OWORD", text, block.at("M", 990))
        if len(self.calls) == 1:
            text = "M99 in the main program starts it again without end; cutcomp ends the run at it."
            self.log.inform("SUBPROGRAM", text, block.at("M", 990))
            return False
        call = self.calls[-1]
        if call.again:
            call.again -= 1
            self.at = call.start
        else:
            self.calls.pop()
            self.at = call.back
        return True

    def count_repeat(self, line: int) -> None:
        """Count a line that is about to run, if it ran before: a short one as one block, any other as more."""
        if not self.ran[line - 1]:
            self.ran[line - 1] = True
            return
        text = self.lines[line - 1]
        per_block = SIGNS_PER_EXPRESSION if "#" in text or "[" in text else SIGNS_PER_BLOCK
        self.budget -= 1 + len(text) // per_block
        if self.budget < 0:
            text = f"Subprograms or loops run more than {self.dialect.max_repeated_blocks} blocks again"
            self.log.stop("LIMIT", f"{text}, long ones counted several times. {GIVEN_UP_TEXT}", Spot(line))

    def finish(self, *, alarmed: bool) -> None:
        """Report what concerns the program as a whole once the run is over, at its end or an alarm."""
        if alarmed:
            return
        last = max((row for row in range(self.main_lines) if self.ran[row]), default=0)
        after = next((row for row in range(last + 1, self.main_lines) if has_words(self.lines[row])), None)
        if after is None:
            return
        # a subprogram that a condition skips needs no warning
        closed = any(self.lines[row].strip() == "%" for row in range(last, after))
        if closed or not self.lines[after].lstrip().upper().startswith("O") or self._is_uncalled(after):
            self.log.warn("NOT_RUN", NOT_RUN_TEXT, Spot(after + 1))

    def _is_uncalled(self, row: int) -> bool:
        """True if a row is a program's O and number alone, and no line has that number in a P."""
        named = _PROGRAM_ALONE.match(self.lines[row])
        return named is not None and not any(re.search(rf"P[ \t]*0*{named[1]}\b", line, re.I) for line in self.lines)

    def end_of_file(self) -> None:
        """Warn that the file ends inside a subprogram, or without the end that the control needs."""
        if len(self.calls) > 1:
            text = "The file ends inside a subprogram; end the subprogram with M99."
            self.log.warn("SUBPROGRAM", text, Spot(len(self.lines)))
        elif self.dialect.end_needed and self.percents < 2:
            self.log.warn("END", "The program has no end; write M2 or M30.", Spot(len(self.lines)))


class OWordFlow(Flow):
    """The lines of a LinuxCNC program, whose O-words are run instead of read.

    `begun` has the place of the word that began something under a label, by the subprogram that runs and that label.
    """

    values: MacroParameters

    def __init__(self, lines: list[str], machine: Machine, library: ProgramLibrary) -> None:
        super().__init__(lines, machine, library)
        self.words = dict[int, OWord]()
        self.subs = list[int]()
        self.begun: dict[tuple[str | None, str], str] = {}
        self.by_label: dict[str, list[OWord]] = {}
        self.o_words_left = MAX_O_WORDS
        self._add_words(lines)
        self.labels = _labels_of(lines, self.words)
        self._steps: dict[str, Callable[[OWord], int]] = {
            "SUB": self._sub,
            "CALL": self._call_sub,
            "ENDSUB": self._end,
            "RETURN": self._end,
            "IF": self._if,
            "ELSEIF": self._end_branch,
            "ELSE": self._end_branch,
            "ENDIF": self._end_branch,
            "WHILE": self._loop,
            "DO": self._loop,
            "REPEAT": self._loop,
            "ENDWHILE": self._again,
            "ENDREPEAT": self._again,
            "BREAK": self._leave,
            "CONTINUE": self._leave,
        }

    def _add_words(self, lines: Sequence[str], first: int = 0) -> None:
        """Note the O-words of lines; `first` is the index of the first of these lines."""
        words = o_words_of(lines, first)
        self.words.update(words)
        self.subs += [row for row, word in words.items() if word.word == "SUB"]
        for word in words.values():
            self.by_label.setdefault(word.label, []).append(word)

    def blocks(self, line: int) -> Iterable[Block]:
        """Return the blocks of a line; an O-word is run and has none."""
        word = self.words.get(line - 1)
        if word is None:
            return super().blocks(line)
        check_length(self.lines[line - 1], line, self.log)
        if word.word in ("ENDSUB", "RETURN") and self.calls[-1].number is not None:
            self._stop(word, "A subprogram called by M98 ends with M99; call it with its O-word, or write M99.")
        self.o_words_left -= 1
        if self.o_words_left < 0:
            self.log.stop("LIMIT", f"The program has run more than {MAX_O_WORDS} O-words. {GIVEN_UP_TEXT}", word)
        if not word.label and word.word != "CALL":
            self._stop(word, "Only call takes an expression as label. Write the number itself.")
        self.at = self._steps[word.word](word)
        return ()

    def _load(self, label: str, line: int) -> str:
        """Add the lines of the file that has an O-word's subprogram; return the file's name, "" if there is none."""
        program = self.library(label.lower())
        if program is None:
            return ""
        name, content = program
        lines = lines_of(content)
        first = self.add_called(name, len(lines), line) - 1
        self.lines += lines
        self.ran += bytearray(len(lines))
        self._add_words(lines, first)
        return name

    def _stop(self, word: OWord, text: str) -> NoReturn:
        self.log.stop("OWORD", text, word)

    @property
    def _opened(self) -> dict[str, OpenBlock]:
        return self.calls[-1].opened

    def _values(self, word: OWord, most: int) -> list[float]:
        """Return the bracketed values after a word, `most` at most; anything else there stops the run."""
        text, values = word.text.text, list[float]()
        reader = ExpressionReader(text, self.values, word.end)
        try:
            while reader.at < len(text) and len(values) < most:
                values.append(reader.brackets())
            if reader.at < len(text):
                raise FaultError("OWORD", f"{quoted(text[reader.at :])} cannot follow {word.word.lower()}.", reader.at)
        except FaultError as fault:
            self.log.stop(fault.code, fault.text, word.text.place(fault.at))
        report_unset(reader, word.text, self.log)
        return values

    def _value(self, word: OWord, what: str = "a condition") -> float:
        values = self._values(word, 1)
        if not values:
            self._stop(word, f"{word.word.lower()} needs {what} in square brackets.")
        return values[0]

    def _seek(self, word: OWord, *wanted: str) -> OWord:
        """Return the next of the wanted words with the same label after a word."""
        later = (other for other in self.by_label[word.label] if other.row > word.row and other.word in wanted)
        following = next(later, None)
        if following is None:
            self._stop(word, f"{word.word.lower()} has no matching {wanted[-1].lower()} with this label.")
        return following

    def _open(self, word: OWord, *wanted: str) -> OpenBlock:
        """Return the block that is open under a word's label."""
        opened = self._opened.get(word.label)
        if opened is None or opened.word not in wanted:
            before = " or ".join(wanted).lower()
            self._stop(word, f"{word.word.lower()} has no {before} of its label before it.")
        return opened

    def _sub(self, word: OWord) -> int:
        """Skip a subprogram that is reached without a call."""
        nested = "A subprogram begins inside a subprogram. Put it after the end of that subprogram."
        if self.calls[-1].label is not None:
            self._stop(word, nested)
        self._claim_label(word)
        self._values(word, 0)
        end = self._seek(word, "ENDSUB")
        after = bisect_right(self.subs, word.row)
        if after < len(self.subs) and self.subs[after] < end.row:
            self._stop(self.words[self.subs[after]], nested)
        return end.row + 1

    def _call_sub(self, word: OWord) -> int:
        label = word.label or self._evaluated_label(word)
        name = quoted(f"O{label}" if label.isdigit() else f"O<{label.lower()}>")
        begun = self._begin_of(label, word.line)
        if begun is None and (file := self._load(label, word.line)):
            begun = self._begin_of(label, word.line)
            if begun is None:
                self._stop(word, f"{file} is called here and has no subprogram {name}.")
        begun = begun or next(self._begins_of(label), None)
        if begun is None:
            missing = quoted(f"{label.lower()}.ngc")
            self._stop(word, f"There is no subprogram {name} in this file, and no file {missing} in its folder.")
        if sum(call.number is None for call in self.calls) > MAX_NESTED:
            self._stop(word, f"More than {MAX_NESTED} subprograms run inside each other; the control stops here.")
        self.values.enter(dict(enumerate(self._values(word, MAX_ARGUMENTS), 1)))
        self.calls.append(Call(word.row + 1, label))
        return begun.row + 1

    def _begins_of(self, label: str) -> Iterator[OWord]:
        return (other for other in self.by_label.get(label, ()) if other.word == "SUB")

    def _begin_of(self, label: str, line: int) -> OWord | None:
        """Return where a subprogram begins in the main file, or in a file added for the line that makes this call."""
        caller = self.origin_of(line)[0]
        for begin in self._begins_of(label):
            if begin.row < self.main_lines or self.origin_of(begin.row + 1)[0] == caller:
                return begin
        return None

    def _evaluated_label(self, word: OWord) -> str:
        reader = ExpressionReader(word.text.text, self.values, word.text.text.index("O") + 1)
        try:
            value = reader.value()
        except FaultError as fault:
            self.log.stop(fault.code, fault.text, word.text.place(fault.at))
        if reader.at != word.begin or value != round(value):
            self._stop(word, "The label of a subprogram must be a whole number.")
        return str(round(value))

    def _end(self, word: OWord) -> int:
        if self.calls[-1].label is None:
            self._stop(word, f"{word.word.lower()} is not in a called subprogram.")
        if word.word == "ENDSUB" and self.calls[-1].label != word.label:
            self._stop(word, "This endsub does not match the running subprogram.")
        values = self._values(word, 1)
        self.values.leave(values[0] if values else None)
        return self.calls.pop().back

    def _if(self, word: OWord) -> int:
        """Open the branch that runs, and return the index of its first line."""
        self._claim_label(word)
        while word.word != "ELSE" and not self._value(word):
            word = self._seek(word, "ELSEIF", "ELSE", "ENDIF")
            if word.word == "ENDIF":
                return word.row + 1
        self._opened[word.label] = OpenBlock("IF", word.row)
        return word.row + 1

    def _end_branch(self, word: OWord) -> int:
        """Leave a branch that ran, and return the index of the line after its ENDIF."""
        self._open(word, "IF")
        del self._opened[word.label]
        return (word if word.word == "ENDIF" else self._seek(word, "ENDIF")).row + 1

    def _claim_label(self, word: OWord) -> None:
        """Claim a label for a word; one that began something else in its subprogram stops the run."""
        line, place = self.origin_of(word.line)
        here = place or f"line {line}"
        begun = self.begun.setdefault((self.calls[-1].label, word.label), here)
        if begun != here:
            self._stop(word, f"This label is in use since {begun}; give this {word.word.lower()} its own.")

    def _loop(self, word: OWord) -> int:
        """Begin a loop or skip it; the `while` of a `do` ends it or returns to its beginning."""
        opened = self._opened.get(word.label)
        if word.word == "WHILE" and opened is not None and opened.word == "DO":
            if self._value(word):
                return opened.row + 1
            del self._opened[word.label]
            return word.row + 1
        self._claim_label(word)
        if word.word == "DO":
            self._values(word, 0)
            times = 1
        else:
            times = round(self._value(word, "a number")) if word.word == "REPEAT" else int(self._value(word) != 0.0)
        if times <= 0:
            self._opened.pop(word.label, None)
            return self._seek(word, _LOOP_ENDS[word.word]).row + 1
        self._opened[word.label] = OpenBlock(word.word, word.row, times - 1)
        return word.row + 1

    def _again(self, word: OWord) -> int:
        """Return from a loop's end to its beginning, or leave it."""
        opened = self._open(word, word.word.removeprefix("END"))
        if opened.word == "WHILE":
            return opened.row
        if opened.again > 0:
            opened.again -= 1
            return opened.row + 1
        del self._opened[word.label]
        return word.row + 1

    def _leave(self, word: OWord) -> int:
        """Leave a loop at a `break`, or go to its end at a `continue`."""
        end = self._seek(word, _LOOP_ENDS[self._open(word, "WHILE", "DO").word])
        if word.word == "CONTINUE":
            return end.row
        del self._opened[word.label]
        return end.row + 1


MakeControl = Callable[[Log], Control]
"""Makes a control that writes its findings to a log."""
