"""This module evaluates the variables and expressions of custom macro B as Fanuc and Haas controls do.

Functions are applied before * / AND MOD, these before + - OR XOR, and these before relations; operators of equal rank
go from left to right.  AND, OR and XOR work on the bits of whole numbers.  A variable that nothing has set is vacant:
a word with it counts as not written, in sums it is 0, and only EQ and NE distinguish it from 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import asin, atan, atan2, ceil, degrees, floor, fmod
from typing import Final

from core.controls.control_run import Log
from core.controls.iso.expressions import (
    COMMENT_GAP,
    FUNCTION,
    FUNCTIONS,
    CompactText,
    ExpressionReader,
    FaultError,
    MacroParameters,
    Operation,
    ParameterStore,
    Word,
    not_a_word,
    plain,
)
from core.controls.program_text import quoted

MAX_EQUAL_SHARE: Final = 1e-8
"""How far apart two values may be, relative to the larger one, and still be equal."""

MAX_BRACKETS: Final = 5
"""How deep brackets may nest, those of functions included."""

LAST_LOCAL: Final = 33
LAST_ARGUMENT: Final = 26


class Vacant(float):
    """The value of a variable that nothing has set: 0 in sums.  `number` is a common variable's, 0 for any other."""

    number = 0

    @classmethod
    def of(cls, number: int) -> Vacant:
        """Return the value of a common variable that nothing has set; the control may keep another value in it."""
        value = cls(0.0)
        value.number = number
        return value


VACANT: Final = Vacant(0.0)


class AlarmByProgramError(Exception):
    """Raised by #3000: the program stops itself with an alarm number of its own."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


SetSystem = Callable[[int, float], bool]
"""Sets a variable of the control itself; False if there is no such variable or it can only be read."""


class Variables(MacroParameters):
    """The variables of one run: #1 to #33 of each macro, the common ones, and those of the control.

    `vacant_arguments`: the main program has read one of #1 to #26 that nothing had set.  `unset` are common variables
    read in a sum, a word or a comparison before anything set them; the control may keep a value in them.
    """

    def __init__(self, machine_value: Callable[[int | str], float | str | None], set_system: SetSystem) -> None:
        super().__init__(ParameterStore.FANUC, machine_value)
        self.set_system = set_system
        self.common: dict[int, float] = {}
        self.vacant_arguments = False
        self.unset: list[int] = []

    def number(self, index: int, at: int) -> float:
        """Return a variable's value, a `Vacant` if nothing has set it."""
        if index == 0:
            return VACANT
        if 1 <= index <= LAST_LOCAL:
            value = self.local.get(index)
            if value is None and not self._outer and index <= LAST_ARGUMENT:
                self.vacant_arguments = True
            return VACANT if value is None else value
        if is_common(index):
            return self.common[index] if index in self.common else Vacant.of(index)
        system = self.machine_value(index)
        if isinstance(system, str):
            raise FaultError("PS0115", system, at)
        if system is None:
            raise FaultError("PS0115", f"#{index} is not a variable cutcomp knows. Use #100 to #199.", at)
        return system

    def named(self, name: str, at: int) -> float:
        """Refuse a name."""
        raise FaultError("BEYOND", f"cutcomp does not follow named variables such as {quoted(name)}. Use numbers.", at)

    def settable(self, key: int | str, at: int) -> None:
        """Refuse names, #0 and negative numbers."""
        if isinstance(key, str):
            self.named(key, at)
        if key == 0:
            raise FaultError("PS0116", "#0 is always vacant and cannot be set. Choose another variable.", at)
        if not isinstance(key, int) or key < 0:
            raise FaultError("PS0115", "The number of a variable cannot be negative.", at)

    def set(self, key: int | str, value: float) -> None:
        """Give a `settable` variable its value."""
        assert isinstance(key, int)
        if 1 <= key <= LAST_LOCAL:
            self.local[key] = value
        elif is_common(key):
            self.common[key] = value
        elif key == 3000:
            raise AlarmByProgramError(round(value))
        elif not self.set_system(key, value):
            raise FaultError("PS0116", f"#{key} cannot be set by a program. Choose #100 to #199.", 0)


def is_common(index: int) -> bool:
    """True if a variable is common to all programs."""
    return 100 <= index <= 199 or 500 <= index <= 999 or 98000 <= index <= 99999


def bits(operation: Callable[[int, int], int]) -> Operation:
    """Return an operation on the bits of two whole numbers."""
    return lambda left, right: float(operation(round(left), round(right)))


def equal(left: float, right: float) -> bool:
    """True if EQ is: vacant equals only vacant."""
    if isinstance(left, Vacant) or isinstance(right, Vacant):
        return isinstance(left, Vacant) and isinstance(right, Vacant)
    return abs(left - right) <= MAX_EQUAL_SHARE * max(abs(left), abs(right), 1e-3)


_RELATION_RANK: Final = 0
_BINARY_OPERATORS: Final[Mapping[str, tuple[int, Operation]]] = {
    "EQ": (_RELATION_RANK, equal),
    "NE": (_RELATION_RANK, lambda left, right: not equal(left, right)),
    "GT": (_RELATION_RANK, lambda left, right: left > right),
    "LT": (_RELATION_RANK, lambda left, right: left < right),
    "GE": (_RELATION_RANK, lambda left, right: left >= right),
    "LE": (_RELATION_RANK, lambda left, right: left <= right),
    "+": (1, lambda left, right: left + right),
    "-": (1, lambda left, right: left - right),
    "OR": (1, bits(int.__or__)),
    "XOR": (1, bits(int.__xor__)),
    "*": (2, lambda left, right: left * right),
    "/": (2, lambda left, right: left / right),
    "AND": (2, bits(int.__and__)),
    "MOD": (2, fmod),
}


def _rounded(value: float) -> float:
    return float(floor(value + 0.5) if value >= 0.0 else -floor(0.5 - value))


_FUNCTIONS: Final[Mapping[str, Callable[[float], float]]] = {
    **FUNCTIONS,
    "ASIN": lambda value: degrees(asin(value)) % 360.0,
    "ATAN": lambda value: degrees(atan(value)),
    "ROUND": _rounded,
    "FIX": lambda value: float(floor(value) if value >= 0.0 else ceil(value)),
    "FUP": lambda value: float(ceil(value) if value >= 0.0 else floor(value)),
    # a number's decimal digits are the value's groups of four bits, and the reverse
    "BIN": lambda value: float(int(f"{round(value):x}")),
    "BCD": lambda value: float(int(str(round(value)), 16)),
    "ADP": float,
    "POW": float,
}
_LENGTH_LETTERS: Final = frozenset("IJKQRUVWXYZ")
INCREMENTS: Final = {"20": 0.0001, "21": 0.001}
"""The least increment of a length in the unit that each G code chooses."""


class MacroReader(ExpressionReader):
    """Reads values as a Fanuc control does; `increment` is the least one of a length in a word, 0 outside words."""

    increment = 0.0
    ranks = _BINARY_OPERATORS
    max_nested = 40
    nested_rule = "PS0118"
    no_value = "PS0114", "A variable needs = and a value, or a letter before it."

    def __init__(self, text: str, values: Variables, at: int = 0) -> None:
        super().__init__(text, values, at)
        self.variables = values
        self.differences: list[float] = []
        """How far apart the values were in each comparison."""
        self._brackets = 0

    def right_side(self) -> float:
        """Return the value right of an equal sign: that of an expression."""
        return self._ranked(0)

    def value(self) -> float:
        """Return one factor; a vacant variable stays vacant unless a minus precedes it."""
        sign, second = self.text[self.at : self.at + 1], self.text[self.at + 1 : self.at + 2]
        negative = sign == "-"
        if sign in ("+", "-"):
            self.at += 1
            if second in ("+", "-"):
                raise FaultError("PS0006", "Two signs stand before a value. Keep one.", self.at)
        value = self._nested()
        if negative:
            self.note_use(value)
        return -value if negative else value

    def to_increment(self, value: float) -> float:
        """Return a value rounded to the increment."""
        return _rounded(value / self.increment) * self.increment

    def note_use(self, *values: float | None) -> None:
        """Note common variables that nothing has set and whose values matter here."""
        self.variables.unset += [value.number for value in values if isinstance(value, Vacant) and value.number]

    def brackets(self) -> float:
        """Return the value of an expression in square brackets; refuse brackets nested too deep."""
        self._enter_bracket()
        value = super().brackets()
        self._brackets -= 1
        return value

    def _enter_bracket(self) -> None:
        self._brackets += 1
        if self._brackets > MAX_BRACKETS:
            text = f"More than {MAX_BRACKETS} brackets lie inside each other. Use a variable for the inner ones."
            raise FaultError("PS0118", text, self.at)

    def _operator(self) -> str:
        name = super()._operator()
        if name == "**":
            raise FaultError("PS0114", "This control has no **. Write POW[a,b] or multiply.", self.at)
        return name

    def _apply_operator(self, at: int, name: str, operation: Operation, left: float, right: float) -> float:
        # a comparison with #0 asks whether a variable is set
        if name not in ("EQ", "NE") or not any(isinstance(side, Vacant) and not side.number for side in (left, right)):
            self.note_use(left, right)
        if _BINARY_OPERATORS[name][0] == _RELATION_RANK:
            self.differences.append(abs(left - right))
        if name in "/MOD" and right == 0.0:
            raise FaultError("PS0112", "A division by 0. Check the divisor.", at)
        return float(self._computed(at, name, operation, left, right))

    def function_named(self, written: str) -> str | None:
        """Return the function that a name means; its first two letters are enough."""
        return next((known for known in _FUNCTIONS if known.startswith(written)), None)

    def call(self, name: str, begin: int) -> float:
        """Return the value of a function, whose arguments come next."""
        first, second = self._arguments()
        self.note_use(first, second)
        if name == "ATAN" and second is None and self.text.startswith("/[", self.at):
            self.at += 1
            second = self.brackets()
        if name == "POW" or second is not None:
            return self._apply_to_two(begin, name, first, second)
        if name == "ROUND" and self.increment:
            return self.to_increment(first)
        try:
            return self._computed(begin, name, _FUNCTIONS[name], first)
        except FaultError as fault:
            raise FaultError("PS0119", fault.text, begin) from None

    def _arguments(self) -> tuple[float, float | None]:
        """Return the value in a function's brackets, or the two that a comma separates."""
        begin = self.at
        self._enter_bracket()
        self.at += 1
        first, second = self._ranked(0), None
        if self.text[self.at : self.at + 1] == ",":
            self.at += 1
            second = self._ranked(0)
        self._close(begin)
        self._brackets -= 1
        return first, second

    def _apply_to_two(self, begin: int, name: str, first: float, second: float | None) -> float:
        if second is None or name not in ("ATAN", "POW"):
            raise FaultError("PS0114", f"{name} takes {'two values' if name == 'POW' else 'one value'}.", begin)
        if name == "ATAN":
            return degrees(atan2(first, second)) % 360.0
        return float(self._computed(begin, name, lambda base, power: float(base**power), first, second))


def set_variables(reader: MacroReader, line: CompactText, values: Variables, log: Log) -> None:
    """Run an assignment, `#1=...`; a second one in its block runs too, and is reported."""
    text = line.text
    for count in range(len(text)):
        if text[reader.at : reader.at + 1] == COMMENT_GAP:
            reader.at += 1
            continue
        if reader.at >= len(text):
            return
        begin = reader.at
        if text[begin] != "#":
            rule = "PS0127" if text[begin].isalpha() else "PS0114"
            raise FaultError(rule, f"{quoted(text[begin:])} cannot follow an assignment. Use its own block.", begin)
        if count:
            message = "A second assignment in this block; cutcomp runs both. Write them in two blocks."
            log.warn("PS0127", message, line.place(begin))
        values.set(*reader.setting())


def words_of(
    line: CompactText, values: Variables, increment: float, start: int = 0
) -> tuple[list[Word], tuple[str, float] | None, int]:
    """Return a block's words with the values of their variables, words with vacant ones left out.

    A calculated length is rounded to the increment, as the control rounds it; the argument of a macro call is not.
    Return also the block's `,R` or `,C`, and the column of its block skip, 0 without one.
    """
    text, reader = line.text, MacroReader(line.text, values, start)
    reader.increment = increment
    if ")" in text:
        raise FaultError("PS0114", "A ) has no ( before it: a comment cannot hold another one.", text.index(")"))
    words, corner, skip, macro_call = list[Word](), None, 0, False
    while reader.at < len(text):
        begin, first = reader.at, text[reader.at]
        reader.at += 1
        if first == COMMENT_GAP:
            continue
        if first == "/":
            reader.at += text[reader.at : reader.at + 1].isdigit()
            skip = line.place(begin).column
        elif first == "," and text[reader.at : reader.at + 1] in ("R", "C"):
            reader.at += 1
            corner = text[begin + 1], reader.value()
            reader.note_use(corner[1])
        elif "A" <= first <= "Z":
            value = _word_value(reader, first, begin)
            reader.note_use(value)
            if not isinstance(value, Vacant):
                calculated = "#" in text[begin : reader.at] or "[" in text[begin : reader.at]
                if calculated and first in _LENGTH_LETTERS and not macro_call:
                    value = reader.to_increment(value)
                number = plain(value)
                # the point of a number that is written with one still counts
                point = "." if "." in text[begin : reader.at] and "." not in number else ""
                words.append(Word(first, f"{number}{point}", line.place(begin).column))
                if first == "G":
                    macro_call = macro_call or number in ("65", "66")
                    reader.increment = INCREMENTS.get(number, reader.increment)
        else:
            raise FaultError("WORD", not_a_word(text[begin:]), begin)
    return words, corner, skip


def _word_value(reader: MacroReader, letter: str, begin: int) -> float:
    """Return the value of a word; a vacant variable stays vacant with a sign before it too."""
    text = reader.text
    signed = text[reader.at : reader.at + 1] in ("+", "-") and text[reader.at + 1 : reader.at + 2] == "#"
    if text[reader.at : reader.at + 1] in ("", COMMENT_GAP) or (
        text[reader.at].isalpha() and not FUNCTION.match(text, reader.at)
    ):
        raise FaultError("PS0005", f"{letter} has no number. Write one or remove {letter}.", begin)
    if not signed:
        return reader.value()
    negative = text[reader.at] == "-"
    reader.at += 1
    value = reader.value()
    return value if isinstance(value, Vacant) or not negative else -value
