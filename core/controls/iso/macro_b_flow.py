"""This module follows IF, GOTO, WHILE, DO, END and calls of subprograms and macros as Fanuc and Haas controls do.

A row is one block's text: a line, or a part of it between semicolons.  A program runs from its O to the next one.  A
program that is not in the file is read from a library, and its moves and findings count for the line that calls it.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right, insort
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Final, NamedTuple, NoReturn

from core.controls.control_run import NOT_RUN_TEXT, Place, Spot
from core.controls.iso.expressions import COMMENT_GAP, CompactText, FaultError, plain
from core.controls.iso.flow import Call, Flow, ProgramLibrary, o_words_of
from core.controls.iso.macro_b import INCREMENTS, AlarmByProgramError, MacroReader, Variables, set_variables, words_of
from core.controls.iso.macro_b_machine import MacroMachine
from core.controls.iso.reader import (
    Block,
    between_semicolons,
    fill_words,
    has_words,
    is_words,
    pairs_in,
    without_comments,
)
from core.controls.program_text import capitals, lines_of, quoted
from core.units import Unit

MAX_ROWS_RUN_AGAIN: Final = 1_000_000
MAX_ROWS_WITHOUT_MOVEMENT: Final = 100_000
MAX_ROWS_WITHOUT_PROGRESS: Final = 20_000
"""Rows after which a program counts as endless; a row's first run does not count.

The rows without progress may be more by the rows and calls of the program, since a subprogram runs that long without
any loop.
"""

ROWS_OF_CALL: Final = 10
"""Rows without progress for which a call counts in the program that makes it, however long it runs."""

BUILDER_PROGRAMS: Final = range(9000, 10_000)
"""Program numbers that usually belong to the machine builder, as for a probe or the tool changer."""

MAX_CALLS: Final = 4
"""How deep subprograms may nest; macros have the same limit of their own."""

MAX_TIMES: Final = 9999

_KEYWORD: Final = re.compile(
    r"(?:/[0-9]?)?(?:N[0-9]++)?(?:/[0-9]?)?(IF(?=\[)|WH(?:ILE)?(?=\[)|"
    r"DO(?=[0-9#\[])|END(?=[0-9#\[])|GO(?:TO)?(?=[-+0-9#\[])|#|(?=\[))"
)
_EXTERNAL: Final = re.compile(r"(?:/[0-9]?)?(?:N[0-9]++)?(DPRNT|BPRNT|POPEN|PCLOS|SETVN)")
_CONSEQUENCE: Final = re.compile(r"(TH(?:EN)?)?(GO(?:TO)?)?")
_NO_O_WORD: Final = (
    r"(?![ \t]*+(?:sub|endsub|call|return|if|elseif|else|endif|while|endwhile|do|repeat|endrepeat|break|continue)\b)"
)
"""Rejects LinuxCNC's O-words, which do not begin a program."""
_LEADER_CHARACTERS: Final = " \t\0\x11\x12\x13\x14\x7f"
"""Characters that may precede the first %: blanks, and what paper tapes and their readers leave."""

_PROGRAM: Final = re.compile(r"[ \t]*+[O:][ \t]*+([0-9]{1,8})(?![0-9.])" + _NO_O_WORD, re.IGNORECASE)
_NAME: Final = re.compile(r"[ \t]*+(O?)[ \t]*+(<[^>]*+>)" + _NO_O_WORD, re.IGNORECASE)
_CALLING: Final = re.compile(r"(?:M98|G6[56])(?![0-9])")
_CALLED: Final = re.compile(r"(?<![A-Z])P([0-9]*+)")
MAX_NAMED_PROGRAMS: Final = 3
"""Most programs that a finding names as not run; the rest are only counted."""
_NUMBER: Final = re.compile(r"[ \t/0-9]*?N[ \t]*+([0-9]{1,8})", re.IGNORECASE)
_NO_POINT: Final = r"[ \t]*+[-+]?[0 \t]*+[1-9][0-9 \t]*+(?![0-9.])"
_WITHOUT_POINT: Final = re.compile(f"[XYZIJKRQ]{_NO_POINT}")
_WITHOUT_POINT_NO_CENTER: Final = re.compile(f"[XYZRQ]{_NO_POINT}")
_ARGUMENTS_WITHOUT_POINT: Final = re.compile(f"[ABCIJKQRUVWXYZ]{_NO_POINT}")
_ARC: Final = re.compile(r"G0?[23](?![0-9])|[IJ]")
_SCALE: Final = re.compile(r"G51(?![.0-9])")
_MACRO_CALL: Final = re.compile(r"G6[56]")
_NO_LENGTHS: Final = re.compile(r"G0?5(?![0-9])|M9[6789]")
_SPINDLE_ANGLE: Final = re.compile(r"(M19[ \t]*+)R")
_LETTERS: Final = re.compile(r"(?<![A-Z])(?!DPRNT|BPRNT|POPEN|PCLOS|SETVN)[A-Z]{2,}(?![A-Z\[])|[A-Z][ \t]++[A-Z]{2}")
_FOR_EDITORS: Final = re.compile(r"[ \t]*+(?:\$[a-z]|#(?:end)?region\b)", re.IGNORECASE)
"""Lines such as $AddRegPart and #region, which never reach a control."""
_EXPRESSION_CHARACTERS: Final = frozenset("#[,")

ARGUMENT_NUMBERS: Final[Mapping[str, int]] = dict(
    zip("ABCIJKDEFHMQRSTUVWXYZ", (*range(1, 10), 11, 13, *range(17, 27)), strict=True)
)
"""The variable that each argument of G65 sets; each repeat of I, J or K sets the one three further on."""


class Statement(NamedTuple):
    """A row as a macro statement: its keyword (empty for a block of words), its text, and where the rest begins.

    `plain` is the block of a row that holds only letters with numbers, as most do.
    """

    keyword: str
    line: CompactText
    at: int = 0
    plain: Block | None = None


@dataclass(frozen=True, slots=True)
class ModalCall:
    """G66: the macro that runs after every move, and the call depth at which moves trigger it."""

    number: int
    times: int
    arguments: Mapping[int, float]
    depth: int


class MacroFlow(Flow):
    """The rows of a program with macro statements; `spots` are the places at which they begin.

    `programs` has the rows at which the programs of a number begin, those of called files last.
    """

    def __init__(self, lines: list[str], machine: MacroMachine, library: ProgramLibrary) -> None:
        super().__init__([], machine, library)
        self.machine = machine
        self.variables = Variables(machine.value_of, machine.set_variable)
        self.spots: list[Spot] = []
        self.begins: list[int] = []
        self.main_lines = len(lines)
        self.statements: dict[int, Statement] = {}
        self.ends: dict[int, int] = {}
        self.numbered: dict[int, list[int]] = {}
        self.calls = [Call(0)]
        self.programs: dict[int, list[int]] = {}
        self.modal_call: ModalCall | None = None
        self.no_point: list[tuple[str, Spot]] = []
        self.rows_run_again = 0
        self.rows_without_movement = 0
        self.least_of_run: dict[tuple[int, int], float] = {}
        self.tape_length = 0
        kept, self.line_before, self.unread_line = _between_percents(lines)
        self._append(kept, 1)
        self.calls[0].back = len(self.lines)
        self.called_programs, self.calls_by_variable = self._called_by_others()
        self.at = self._main_program()
        self.program = self._range_of(self.at)

    # programs

    def _programs(self) -> list[int]:
        """Return the rows at which the file's own programs begin, without those of called files."""
        first = [self._first_row()] if self.lines else []
        return sorted({*first, *(row for row in self.begins if self.spots[row].line <= self.main_lines)})

    def _called_by_others(self) -> tuple[set[int], bool]:
        """Return the rows where programs begin that others in the file call; True if a variable may name another."""
        called, by_variable = set[int](), False
        for row, text in enumerate(self.lines):
            if "P" not in (squeezed := "".join(without_comments(capitals(text)).split())):
                continue
            numbers = _CALLED.findall(squeezed) if _CALLING.search(squeezed) else []
            by_variable |= numbers[-1:] == [""]
            if not numbers or not numbers[-1]:
                continue
            number = int(numbers[-1])
            # on a Fanuc, a P of more than four digits also holds the number of repeats
            for label in {number} if self.dialect.m97_calls else {number, number % 10_000}:
                if (begins := self.programs.get(label)) and not begins[0] <= row < self._range_of(begins[0])[1]:
                    called.add(begins[0])
        return called, by_variable

    def _main_program(self) -> int:
        """Return the row at which the run begins: that of the first program that no other in the file calls."""
        programs = self._programs()
        first = programs[0] if programs else 0
        main = next((row for row in programs if row not in self.called_programs), first)
        if main != first:
            text = f"cutcomp runs {self._name_of(main)}: {self._name_of(first)}, which stands before it, is called."
            self.log.inform("PROGRAM", text, self.spots[main])
        return main

    def _name_of(self, row: int) -> str:
        """Return what findings call the program that begins at a row."""
        return self._head(self.lines[row]) or "what stands first"

    def _head(self, text: str) -> str:
        """Return the number or name of the program that begins with a row, "" if none does."""
        if number := _PROGRAM.match(text):
            return f"O{number[1]}"
        bare = without_comments(text)
        name = _NAME.match(bare)
        if name is None:
            return ""
        alone = self.dialect.program_names and not bare[name.end() :].strip()
        return quoted(name[2]) if name[1] or alone else ""

    def _report_not_run(self) -> None:
        """Report programs that neither ran nor are called, and words before the first % or after the end."""
        ranges = (self._range_of(row) for row in self._programs())
        idle = [first for first, last in ranges if first not in self.called_programs and not any(self.ran[first:last])]
        if idle:
            names = ", ".join(
                f"{self._name_of(row)} (line {self.spots[row].line})" for row in idle[:MAX_NAMED_PROGRAMS]
            )
            more = f" and {len(idle) - MAX_NAMED_PROGRAMS} more" if len(idle) > MAX_NAMED_PROGRAMS else ""
            which = "a call with a variable may mean" if self.calls_by_variable else "nothing in this file calls"
            text = f"Programs that {which} were not run: {names}{more}. Check each by itself."
            self.log.warn("NOT_RUN", text, self.spots[idle[0]])
        if self.line_before is not None:
            text = "The lines from here to the % stand before the program and were not run. Check them."
            self.log.warn("NOT_RUN", text, Spot(self.line_before))
        line_after = self._line_after_end() or self.unread_line
        if line_after is not None:
            self.log.warn("NOT_RUN", NOT_RUN_TEXT, Spot(line_after))

    def _line_after_end(self) -> int | None:
        """Return the first line with words after the last row that ran; None if its N may be the target of a jump."""
        first, last = self.program
        ended = max((row for row in range(first, last) if self.ran[row]), default=last)
        after = next((row for row in range(ended + 1, last) if has_words(self.lines[row])), None)
        return None if after is None or _NUMBER.match(self.lines[after]) else self.spots[after].line

    # rows

    def _append(self, lines: Sequence[str], first_number: int) -> int:
        """Add lines, cut at their semicolons, as rows; return the index of the first one."""
        begin = len(self.lines)
        for number, line in enumerate(lines, first_number):
            if _FOR_EDITORS.match(line):
                message = f"A line for an editor or a simulator is ignored: {quoted(line.strip())}"
                self.log.inform("TEXT", message, Spot(number))
                continue
            for start, text in between_semicolons(line):
                if start and _is_remark(text):
                    message = f"Text after the end of the block is ignored: {quoted(text)}"
                    self.log.inform("TEXT", message, Spot(number, start + 1))
                    continue
                row = len(self.lines)
                self.lines.append(text)
                self.spots.append(Spot(number, start + 1))
                self.ran.append(0)
                if self._head(text):
                    self.begins.append(row)
                if program := _PROGRAM.match(text):
                    self.programs.setdefault(int(program[1]), []).append(row)
                sequence = _NUMBER.match(text)
                if sequence:
                    self.numbered.setdefault(int(sequence[1]), []).append(row)
        return begin

    def _first_row(self, begin: int = 0) -> int:
        """Return the first row from `begin` on that has more than blanks and comments."""
        rows = range(begin, len(self.lines))
        return next((row for row in rows if without_comments(self.lines[row]).strip()), begin)

    def _range_of(self, row: int) -> tuple[int, int]:
        """Return the first row of the program that a row belongs to, and the first row after it."""
        index = bisect_right(self.begins, row)
        first = self.begins[index - 1] if index else 0
        return first, self.begins[index] if index < len(self.begins) else len(self.lines)

    def count_repeat(self, line: int) -> None:
        """Count rows that run again, and those since the last movement; stop a program that does not end."""
        if len(self.machine.control.tape) != self.tape_length:
            self.tape_length, self.rows_without_movement = len(self.machine.control.tape), 0
        if self.ran[line - 1]:
            self.rows_without_movement += 1
            self.rows_run_again += 1
            self.calls[-1].rows_without_progress += 1
        self.ran[line - 1] = True
        rows_without_progress = self.calls[-1].rows_without_progress
        if rows_without_progress > MAX_ROWS_WITHOUT_PROGRESS + (1 + ROWS_OF_CALL) * len(self.lines):
            text = f"The program does not end: for {rows_without_progress} blocks or more, no condition of a loop or"
            self.log.stop("LIMIT", f"{text} a jump came closer to its end. cutcomp stops here.", self.spots[line - 1])
        if self.rows_run_again > MAX_ROWS_RUN_AGAIN or self.rows_without_movement > MAX_ROWS_WITHOUT_MOVEMENT:
            text = "The program does not end: a loop or a jump runs for ever. cutcomp stops here."
            self.log.stop("LIMIT", text, self.spots[line - 1])

    def _note_progress(self, row: int, differences: list[float]) -> None:
        """Reset the count of rows without progress if the values that a condition compares are closer than ever before.

        Conditions inside its loop then start afresh.  A condition that compares nothing always resets the count.
        """
        call = self.calls[-1]
        for index, difference in enumerate(differences):
            condition = (row, index)
            if difference < self.least_of_run.get(condition, inf):
                # an exit in a subprogram also ends the loops of its callers
                self.least_of_run[condition] = difference
                for caller in self.calls[:-1]:
                    caller.rows_without_progress = 0
            least = call.least_differences.get(condition)
            if least is not None and difference < least:
                # conditions evaluated since the last time this one was are inside its loop
                order = list(call.least_differences)
                for inside in order[order.index(condition) :]:
                    del call.least_differences[inside]
            if least is None or difference < least:
                call.rows_without_progress = 0
                least = difference
            call.least_differences.pop(condition, None)
            call.least_differences[condition] = least
        if not differences:
            call.rows_without_progress = 0

    def ends_here(self, _line: int, /) -> bool:
        """True if the next row is outside the program that runs: nothing has called what follows."""
        first, last = self.program
        return not first <= self.at < last

    # reading rows

    def blocks(self, line: int) -> Iterator[Block]:
        """Yield the blocks of words of a row, and run its macro statement if it has one."""
        row = line - 1
        statement = self._statement(row)
        try:
            if statement.keyword == "[":
                statement = self._after_condition(statement, row)
            elif statement.keyword:
                self.at = self._run_statement(statement, row)
        except FaultError as fault:
            self._fault(fault, statement.line)
        except AlarmByProgramError as alarm:
            self._program_alarm(alarm.number, row)
        self._report_unset(row)
        if not statement.keyword:
            yield from self._run_block(self._block(row, statement), row)

    def _note_points(self, bare: str, row: int) -> None:
        """Note lengths without a decimal point; without an arc, K counts the repeats of a cycle or is a factor."""
        if not _NO_LENGTHS.search(bare):
            centered = _ARC.search(bare) and not _SCALE.search(bare)
            pattern = _WITHOUT_POINT if centered else _WITHOUT_POINT_NO_CENTER
            pattern = _ARGUMENTS_WITHOUT_POINT if _MACRO_CALL.search(bare) else pattern
            line, column = self.spots[row]
            lengths = pattern.finditer(_SPINDLE_ANGLE.sub(r"\1P", bare))
            self.no_point += [(match[0], Spot(line, match.start() + column)) for match in lengths]

    def _report_unset(self, row: int) -> None:
        """Report the first common variable that a row reads before the program sets it."""
        unset, self.variables.unset = self.variables.unset, []
        if unset:
            text = f"The program does not set #{unset[0]}; cutcomp takes it as vacant, 0 in a sum."
            self.log.warn("PARAMETER", f"{text} The control may keep a value in it.", self.spots[row])

    def _statement(self, row: int) -> Statement:
        """Return a row as a macro statement, read once."""
        kept = self.statements.get(row)
        if kept is None:
            kept = self.statements[row] = self._read(row)
        return kept

    def _read(self, row: int) -> Statement:
        text = capitals(self.lines[row])
        words = without_comments(text)
        if is_words(words):
            self._note_points(words, row)
            block = Block(self.spots[row].line, self.lines[row], self.spots[row].column - 1)
            plain = fill_words(block, pairs_in(words), self.log, last_counts=True) if words.strip() else None
            return Statement("", CompactText("", (), self.spots[row].line), plain=plain)
        bare = without_comments(text, COMMENT_GAP)
        line = CompactText.of(bare, self.spots[row].line, self.spots[row].column - 1)
        if o_words_of([text]):
            message = "O-words are LinuxCNC's. Call subprograms with M98 and macros with G65; write IF, WHILE and GOTO."
            self.log.stop("WORD", message, line.place(0))
        if not _EXPRESSION_CHARACTERS.intersection(bare):
            self._note_points(bare, row)
        keyword = _KEYWORD.match(line.text)
        if keyword:
            return Statement(keyword[1] or "[", line, keyword.end())
        return Statement("OUT" if _EXTERNAL.match(line.text) else "", line)

    def _fault(self, fault: FaultError, line: CompactText) -> NoReturn:
        self.log.stop(fault.code, fault.text, line.place(fault.at))

    def _program_alarm(self, number: int, row: int) -> NoReturn:
        comment = re.search(r"\(([^)]*)", self.lines[row])
        quotation = f': "{quoted(comment[1])}"' if comment else ""
        text = f"The program stops itself here with alarm {3000 + number}{quotation}."
        self.log.stop(f"MC{3000 + number}", text, self.spots[row])

    # macro statements

    def _run_statement(self, statement: Statement, row: int) -> int:
        """Run a macro statement and return the row that comes next."""
        self.machine.line = self.spots[row].line
        reader = MacroReader(statement.line.text, self.variables, statement.at)
        match statement.keyword:
            case "#":
                reader.at -= 1
                self._set(reader, statement.line, row)
            case "IF":
                return self._if(reader, statement.line, row)
            case "WH" | "WHILE":
                return self._while(reader, row)
            case "DO":
                return self._enter_loop(self._loop_number(reader), row)
            case "END":
                return self._end_loop(self._loop_number(reader), row)
            case "GO" | "GOTO":
                return self._go_to(reader, row)
        return row + 1

    def _set(self, reader: MacroReader, line: CompactText, row: int) -> None:
        set_variables(reader, line, self.variables, self.log)
        if "#3006=" in line.text:
            text = "The program shows a message here and waits for cycle start; cutcomp goes on."
            self.log.inform("FN-MESSAGE", text, self.spots[row])

    def _if(self, reader: MacroReader, line: CompactText, row: int) -> int:
        holds, consequence = self._condition(reader, row), _CONSEQUENCE.match(line.text, reader.at)
        if consequence is None or not consequence[0]:
            at = min(reader.at, len(line.text) - 1)
            raise FaultError("PS0114", "IF needs GOTO or THEN after its condition.", at)
        reader.at = consequence.end()
        if holds and consequence[2]:
            return self._go_to(reader, row)
        if holds:
            self._set(reader, line, row)
        return row + 1

    def _condition(self, reader: MacroReader, row: int) -> bool:
        """True if the condition of IF or WHILE holds."""
        holds = reader.brackets() != 0.0
        self._note_progress(row, reader.differences)
        return holds

    def _after_condition(self, statement: Statement, row: int) -> Statement:
        """Return the words of Haas's `[condition] M99 P`, none unless the condition is true."""
        self.machine.line = self.spots[row].line
        reader = MacroReader(statement.line.text, self.variables, statement.at)
        true = reader.brackets() != 0.0
        return Statement("", statement.line, reader.at if true else len(reader.text))

    def _go_to(self, reader: MacroReader, row: int) -> int:
        begin = reader.at
        number = reader.value()
        self._check_end(reader, "GOTO")
        return self._row_of(number, row, begin)

    @staticmethod
    def _check_end(reader: MacroReader, what: str) -> None:
        """Refuse anything but comments after a number."""
        if reader.at < len(reader.text.rstrip(COMMENT_GAP)):
            raise FaultError("PS0114", f"{quoted(reader.text[reader.at :])} cannot follow {what}.", reader.at)

    def _row_of(self, number: float, row: int, at: int) -> int:
        """Return the row of a sequence number, the next one or else the program's first; close the loops it leaves."""
        first, last = self._range_of(row)
        rows = [other for other in self.numbered.get(round(number), ()) if first <= other < last]
        if not rows or number != round(number):
            raise FaultError("PS0128", f"There is no block N{number:g} in this program. Correct the number.", at)
        target = next((other for other in rows if other > row), rows[0])
        call = self.calls[-1]
        call.loops = {loop: begin for loop, begin in call.loops.items() if begin < target <= self._end_of(loop, begin)}
        return target

    def _loop_number(self, reader: MacroReader) -> int:
        begin = reader.at
        number = reader.value()
        if number not in (1.0, 2.0, 3.0):
            raise FaultError("PS0126", "The number of a loop is 1, 2 or 3.", begin)
        self._check_end(reader, "here")
        return round(number)

    def _while(self, reader: MacroReader, row: int) -> int:
        holds = self._condition(reader, row)
        if not reader.text.startswith("DO", reader.at):
            raise FaultError("PS0114", "WHILE needs DO and a number after its condition.", len(reader.text) - 1)
        reader.at += 2
        number = self._loop_number(reader)
        if holds:
            return self._enter_loop(number, row)
        self.calls[-1].loops.pop(number, None)
        return self._end_of(number, row) + 1

    def _enter_loop(self, number: int, row: int) -> int:
        self._end_of(number, row)
        self.calls[-1].loops[number] = row
        return row + 1

    def _end_of(self, number: int, row: int) -> int:
        """Return the row of the END that belongs to a DO."""
        end = self.ends.get(row)
        if end is None:
            wanted = re.compile(rf"(?:/[0-9]?)?(?:N[0-9]++)?END{number}(?![0-9.])")
            last = self._range_of(row)[1]
            end = next((other for other in range(row + 1, last) if wanted.match(self._squeezed(other))), None)
            if end is None:
                self.log.stop("PS0124", f"The loop DO{number} has no END{number}. Write it.", self.spots[row])
            self.ends[row] = end
        return end

    def _squeezed(self, row: int) -> str:
        text = self.lines[row]
        return without_comments(capitals(text)).replace(" ", "").replace("\t", "") if "d" in text.lower() else ""

    def _end_loop(self, number: int, row: int) -> int:
        call = self.calls[-1]
        begin = call.loops.get(number)
        if begin is None or self._end_of(number, begin) != row:
            text = f"END{number} has no DO{number} before it that is running. A jump must not lead into a loop."
            self.log.stop("PS0124", text, self.spots[row])
        call.loops = {loop: other for loop, other in call.loops.items() if other < begin}
        return begin

    # words

    def _run_block(self, block: Block | None, row: int) -> Iterator[Block]:
        """Yield a block to run, then start the macro that it calls or that G66 runs after it."""
        if block is None:
            return
        if 650 in block.g or 660 in block.g:
            yield replace(block, words={}, g=[650])
            self._call_macro(block, modal=660 in block.g)
            return
        if 670 in block.g:
            self.modal_call = None
        if block.corner:
            self.machine.following = self._following(row)
        moved = len(self.machine.control.tape)
        yield block
        self._after_move(block, moved)

    def _block(self, row: int, statement: Statement) -> Block | None:
        """Return the block of words of a row, None if it has none."""
        if statement.plain is not None:
            return statement.plain
        number = self.machine.line = self.spots[row].line
        line, start = statement.line, statement.at
        if line.text.startswith(":"):
            line = line._replace(text=f"O{line.text[1:]}")
        if row in self.begins and (name := re.match(r"O?<[^>]*>", line.text)):
            start = name.end()
        increment = INCREMENTS["21" if self.machine.unit is Unit.MM else "20"]
        try:
            words, corner, skip = words_of(line, self.variables, increment, start)
        except FaultError as fault:
            self._fault(fault, line)
        self._report_unset(row)
        if skip:
            self.log.inform("SKIP", "Block skip is assumed off, so this block runs.", Spot(number, skip))
        if not words:
            return None
        block = Block(number, line.text, self.spots[row].column - 1, evaluated=words, corner=corner)
        return fill_words(block, words, self.log, last_counts=True)

    def _following(self, row: int) -> Block | None:
        """Return the next block of words, for the corner before it; None if a macro statement comes first."""
        for other in range(row + 1, self.program[1]):
            statement = self._statement(other)
            if statement.keyword:
                return None
            block = self._block(other, statement)
            if block is not None:
                return block
        return None

    def _after_move(self, block: Block, moved: int) -> None:
        """Start the macro of G66 after a block that moves."""
        modal = self.modal_call
        if modal is None or len(self.calls) != modal.depth or {"X", "Y", "Z"}.isdisjoint(block.words):
            return
        if len(self.machine.control.tape) > moved or self.machine.control.active:
            self._begin_macro(modal.number, modal.times, modal.arguments, block)

    # calls

    def follow_call(self, block: Block) -> bool:
        """Follow a block's M98, M97 or M99; False if the program ends with it."""
        if 980 in block.m or (970 in block.m and self.dialect.m97_calls):
            self._call(block)
            return True
        for code in (960, 1980):
            if code in block.m and "P" in block.words:
                text = f"cutcomp does not follow M{code // 10} P, which may run other blocks. Check them by themselves."
                self.log.stop("BEYOND", text, block.at("M", code))
        return self._return(block) if 990 in block.m else True

    def _call(self, block: Block) -> None:
        """Follow M98, which runs a program, or M97, which runs blocks of the one that calls."""
        place = block.at("M", 980)
        number, times = self._called(block, place, least=0)
        self._check_depth(place, macro=False)
        self._push(self._target(number, place) if 970 in block.m else self._start_of(number, block), times, None)

    def _call_macro(self, block: Block, *, modal: bool) -> None:
        """Call a macro with its arguments (G65), or keep it for the moves that follow (G66)."""
        number, times = self._called(block, block.at("G"), least=1)
        if modal:
            self.modal_call = ModalCall(number, times, arguments_of(block), len(self.calls))
        else:
            self._begin_macro(number, times, arguments_of(block), block)

    def _called(self, block: Block, place: Place, least: int) -> tuple[int, int]:
        """Return the program that a block calls, and how often it runs."""
        if "P" not in block.words:
            self.log.stop("PS0076", "The call needs P and the number of a program.", place)
        number, times = round(block.words["P"]), round(block.words.get("L", 1.0))
        if "L" not in block.words and number > MAX_TIMES and 980 in block.m and not self.dialect.m97_calls:
            times, number = divmod(number, 10_000)
        if not least <= times <= MAX_TIMES:
            self.log.stop("PS0007", f"L is a number of times from 1 to {MAX_TIMES}.", block.at("L"))
        return number, max(times, 1)

    def _check_depth(self, place: Place, *, macro: bool) -> None:
        if sum(call.macro is macro for call in self.calls[1:]) >= MAX_CALLS:
            what = "Macros" if macro else "Subprograms"
            self.log.stop("PS0077", f"{what} run more than {MAX_CALLS} deep.", place)

    def _begin_macro(self, number: int, times: int, arguments: Mapping[int, float], block: Block) -> None:
        self._check_depth(block.at("G"), macro=True)
        self._push(self._start_of(number, block), times, arguments)

    def _start_of(self, number: int, block: Block) -> int:
        """Return where a program begins in the main file, or in a file added for the line that makes this call."""
        caller = self.origin_of(block.line)[0]
        for start in self.programs.get(number, ()):
            if self.spots[start].line <= self.main_lines or self.origin_of(self.spots[start].line)[0] == caller:
                return start
        return self._from_library(number, block)

    def _push(self, start: int, times: int, arguments: Mapping[int, float] | None) -> None:
        self.calls[-1].rows_without_progress += ROWS_OF_CALL
        self.calls.append(Call(self.at, number=0, start=start, again=times - 1, macro=arguments is not None))
        if arguments is not None:
            self.variables.enter(arguments)
        self.at = start
        self.program = self._range_of(start)

    def _from_library(self, number: int, block: Block) -> int:
        """Add a program that is not in the file, its lines numbered on from the file's; return where it begins."""
        program, starts = self.library(number), self.programs.setdefault(number, [])
        if program is None and starts:  # it stands in a file that another line has called
            return starts[0]
        if program is None and number in BUILDER_PROGRAMS:
            text = f"O{number} may be a macro of the machine, such as for a probe. Add it to the file or its folder."
            self.log.stop("BEYOND", text, block.at("P"))
        if program is None:
            self.log.stop("PS0076", f"There is no program O{number} in this file or its folder. Add it.", block.at("P"))
        name, content = program
        lines, _, _ = _between_percents(lines_of(content))
        first = self._append(lines, self.add_called(name, len(lines), block.line))
        begin = self._first_row(first)
        if begin not in self.begins:
            insort(self.begins, begin)
        starts.insert(bisect_left(starts, first), begin)
        return begin

    def _return(self, block: Block) -> bool:
        """Follow M99, with P to a block of the calling program; False if it ends the run."""
        call, target = self.calls[-1], block.words.get("P")
        if target is None and (call.again or len(self.calls) == 1):
            call.loops = {}
            # the conditions of the next call begin at their first values again
            call.rows_without_progress = 0
            call.least_differences.clear()
            return super()._return(block)
        if len(self.calls) > 1:
            if call.macro:
                self.variables.leave()
            self.calls.pop()
            self.at = call.back
            self.program = self._range_of(call.back - 1)
        if target is not None:
            self.at = self._target(round(target), block.at("P"))
        return True

    def _target(self, number: int, place: Place) -> int:
        """Return the row of a sequence number that a call or a return names."""
        try:
            return self._row_of(float(number), self.at - 1, 0)
        except FaultError as fault:
            self.log.stop(fault.code, fault.text, place)

    def finish(self, *, alarmed: bool) -> None:
        """Report what concerns the program as a whole once the run is over, at its end or an alarm."""
        text = "\n".join(self.lines).upper()
        if self.variables.vacant_arguments and "M99" in text and not re.search(r"M0?2(?!\d)|M30", text):
            message = "This looks like the body of a macro: it reads arguments that nothing sets. Call it with G65."
            self.log.inform("FN-BODY", message, Spot(1))
        if self.no_point:
            (word, place), count = self.no_point[0], len(self.no_point)
            word = "".join(word.split())
            value = float(word[1:])
            least = f"{plain(value / 1000)} mm" if self.machine.unit is Unit.MM else f"{plain(value / 10000)} in"
            which = f"{count} lengths, the first one here, have" if count > 1 else "This length has"
            units = "unit" if abs(value) == 1.0 else "units"
            taken = (
                f"cutcomp takes {word} as {plain(value)} {units}; {self.dialect.least_increment_setting} it is {least}."
            )
            self.log.warn("FN-POINT", f"{which} no decimal point. {taken}", place)
        if not alarmed:
            self._report_not_run()

    def end_of_file(self) -> None:
        """Warn that the program ends without M30, M02 or M99."""
        text = "The program has no end. Write M30, or M99 in a subprogram."
        self.log.warn("END", text, self.spots[-1] if self.spots else Spot(1))


def arguments_of(block: Block) -> dict[int, float]:
    """Return the variables that the words of G65 set; the last word for a variable counts."""
    arguments, seen = dict[int, float](), dict[str, int]()
    for letter, value, _ in block.written():
        number = ARGUMENT_NUMBERS.get(letter)
        if number is None:
            continue
        if letter in "IJK":
            number += 3 * seen.get(letter, 0)
            seen[letter] = seen.get(letter, 0) + 1
        arguments[number] = float(value)
    return arguments


def _between_percents(lines: Sequence[str]) -> tuple[list[str], int | None, int | None]:
    """Return the lines, empty outside the two % lines, and the first lines with words before and after those.

    A single % begins the program, or ends it if more than comments precede it.
    """
    percents = [index for index, line in enumerate(lines) if line.lstrip(_LEADER_CHARACTERS).startswith("%")]
    if not percents:
        return list(lines), None, None
    first, last = percents[0], percents[1] if len(percents) > 1 else len(lines)
    if len(percents) == 1 and any(line.strip() and not line.strip().startswith("(") for line in lines[:first]):
        first, last = -1, percents[0]
    kept = [line if first < index < last else "" for index, line in enumerate(lines)]
    if first >= 0 and _PROGRAM.match(head := lines[first].lstrip(_LEADER_CHARACTERS)[1:]):
        kept[first] = head
    before = next((index + 1 for index in range(first) if has_words(lines[index])), None)
    return kept, before, next((index + 1 for index in range(last + 1, len(lines)) if has_words(lines[index])), None)


def _is_remark(text: str) -> bool:
    """True if text after a semicolon is a remark: a number, or letters that are neither words nor a macro statement."""
    bare = capitals(without_comments(text))
    if bare.strip()[:1] in "+-.0123456789" and bare.strip():
        return True
    return _LETTERS.search(bare) is not None and not _KEYWORD.match("".join(bare.split()))
