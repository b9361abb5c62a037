"""This module evaluates parameters and expressions as LinuxCNC and RosettaCNC do, so that words have plain numbers.

Expressions are numbers, #parameters, [brackets] and functions.  Operators of equal rank are applied from left to right,
powers too; angles are in degrees; two values are equal within 0.0001.  A name belongs to the subprogram that set it,
unless it begins with an underscore.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from enum import Enum, auto
from math import acos, asin, atan2, ceil, cos, degrees, exp, floor, fmod, isfinite, radians, sin, sqrt, tan
from math import log as natural_log
from typing import Final, NamedTuple

from core.controls.control_run import Log, Spot
from core.controls.iso.code_support import FREE_ASSIGNMENT, HIGH_PARAMETERS, only_on
from core.controls.program_text import quoted

_CONTROL_NAMES: Final = """
LINE MOTION_MODE PLANE CCOMP METRIC IMPERIAL ABSOLUTE INCREMENTAL INVERSE_TIME UNITS_PER_MINUTE UNITS_PER_REV
COORD_SYSTEM TOOL_OFFSET RETRACT_R_PLANE RETRACT_OLD_Z SPINDLE_RPM_MODE SPINDLE_CSS_MODE IJK_ABSOLUTE_MODE
LATHE_DIAMETER_MODE LATHE_RADIUS_MODE SPINDLE_ON SPINDLE_CW MIST FLOOD SPEED_OVERRIDE FEED_OVERRIDE ADAPTIVE_FEED
FEED_HOLD FEED RPM CURRENT_TOOL SELECTED_POCKET CURRENT_POCKET X Y Z A B C U V W ABS_X ABS_Y ABS_Z ABS_A ABS_B ABS_C
VALUE CALL_LEVEL REMAP_LEVEL SELECTED_TOOL VALUE_RETURNED TASK VMAJOR VMINOR
"""

SYSTEM_NAMES: Final = frozenset(f"_{name}" for name in _CONTROL_NAMES.split())
"""Names whose values the control keeps itself."""

_LAST_LOCAL: Final = 30
_FIRST_SYSTEM_PARAMETER: Final = 5001
_LAST_SYSTEM_PARAMETER: Final = 5601
_TOOL_AND_PLACE: Final = range(5400, 5429)
_MACRO_SYSTEM: Final = 5000
_MACRO_LAST: Final = 6999
_PARAMETERS_END: Final = 10_000


def _no_parameter(index: int, last: int) -> str:
    """Return the sentence that a control has no parameter with a number, and which controls have."""
    other = f" {only_on(HIGH_PARAMETERS)}" if index >= _PARAMETERS_END else ""
    return f"#{index} is not a parameter; they go from 1 to {last}.{other}"


class FaultError(Exception):
    """Raised for what cannot be evaluated: the rule's id, a sentence, and its position in the text being read."""

    def __init__(self, code: str, text: str, at: int) -> None:
        super().__init__(text)
        self.code = code
        self.text = text
        self.at = at


class ParameterStore(Enum):
    """How a control keeps parameters."""

    NGC = auto()
    """As on LinuxCNC: #1 to #30 are local to a subprogram; a parameter that nothing set is 0."""
    FANUC = auto()
    """As on Fanuc: #1 to #33 are local to a macro; a variable that nothing set is vacant."""
    MACRO_B = auto()
    """As on RosettaCNC: a variable that nothing set is empty or in the control's own table; #0 is always empty."""


MachineValue = Callable[[int | str], float | str | None]
"""Returns a machine value by number or name: the value, a sentence why it has none, or None if it is not known."""


class MacroParameters:
    """The values of one run; `machine_value` reads those that the control itself keeps.

    `local` has the first numbers, which are local to a subprogram, and `numbered` the others.
    """

    def __init__(self, kept: ParameterStore, machine_value: MachineValue = lambda _: None) -> None:
        self.kept = kept
        self.machine_value = machine_value
        self.local: dict[int, float] = {}
        self.numbered: dict[int, float] = {}
        self.names: dict[str, float] = {}
        self.shared: dict[str, float] = {}
        self.returned: float | None = None
        self._outer: list[tuple[dict[int, float], dict[str, float]]] = []

    def number(self, index: int, at: int) -> float | None:
        """Return a numbered value; None if it counts as 0 because nothing set it."""
        if self.kept is ParameterStore.MACRO_B:
            return self._variable(index, at)
        self._within(index, at)
        if index >= _FIRST_SYSTEM_PARAMETER:
            return self._system(index, f"#{index}", at)
        if index <= _LAST_LOCAL and self._outer:
            return self.local.get(index, 0.0)
        return self._store(index).get(index)

    def _store(self, index: int) -> dict[int, float]:
        return self.local if index <= _LAST_LOCAL else self.numbered

    def _within(self, index: int, at: int) -> None:
        if not 1 <= index <= _LAST_SYSTEM_PARAMETER:
            raise FaultError("PARAMETER", _no_parameter(index, _LAST_SYSTEM_PARAMETER), at)

    def _variable(self, index: int, at: int) -> float:
        if index > _MACRO_LAST:
            raise FaultError("PARAMETER", _no_parameter(index, _MACRO_LAST), at)
        if index >= _MACRO_SYSTEM:
            raise FaultError("BEYOND", f"Only the control knows #{index} at run time. Program the number.", at)
        value = self._store(index).get(index)
        if value is None:
            raise FaultError("PARAMETER", f"#{index} has no value yet in this program. Set it first.", at)
        return value

    def _system(self, key: int | str, subject: str, at: int) -> float:
        value = self.machine_value(key)
        if isinstance(value, float):
            return value
        raise FaultError("BEYOND", value or f"Only the control knows {subject} at run time. Program the number.", at)

    def named(self, name: str, at: int) -> float:
        """Return a named value; one without a value is a fault."""
        if name in SYSTEM_NAMES or name.startswith(("_HAL[", "_INI[")):
            if name == "_VALUE":
                return self.returned or 0.0
            if name == "_VALUE_RETURNED":
                return float(self.returned is not None)
            if name == "_CALL_LEVEL":
                return float(len(self._outer))
            return self._system(name, f"#<{quoted(name.lower())}>", at)
        value = self._scope(name).get(name)
        if value is None:
            raise FaultError("PARAMETER", f"#<{quoted(name.lower())}> has no value yet. Set it first.", at)
        return value

    def exists(self, name: str) -> bool:
        """True if a name has a value, or the control keeps one for it."""
        return name in SYSTEM_NAMES or name in self._scope(name)

    def _scope(self, name: str) -> dict[str, float]:
        return self.shared if name.startswith("_") else self.names

    def settable(self, key: int | str, at: int) -> None:
        """Refuse a number or name that a program cannot set."""
        if isinstance(key, str):
            if key in SYSTEM_NAMES or key.startswith(("_HAL[", "_INI[")):
                raise FaultError("PARAMETER", f"#<{quoted(key.lower())}> can only be read; choose another name.", at)
        elif self.kept is ParameterStore.MACRO_B:
            if key > _MACRO_LAST:
                raise FaultError("PARAMETER", _no_parameter(key, _MACRO_LAST), at)
            if not 1 <= key < _MACRO_SYSTEM:
                raise FaultError("PARAMETER", f"#{key} can only be read; a program sets #1 to #4999.", at)
        else:
            self._within(key, at)
            if key in _TOOL_AND_PLACE:
                raise FaultError("PARAMETER", f"#{key} can only be read; choose another number.", at)
            if key >= _FIRST_SYSTEM_PARAMETER:
                text = f"#{key} changes the control itself, and what follows would be wrong; use the G code for it."
                raise FaultError("BEYOND", text, at)

    def set(self, key: int | str, value: float) -> None:
        """Give a `settable` number or name its value."""
        if isinstance(key, str):
            self._scope(key)[key] = value
        else:
            self._store(key)[key] = value

    def enter(self, arguments: Mapping[int, float]) -> None:
        """Begin a subprogram or macro, with local numbers and names of its own."""
        self._outer.append((self.local, self.names))
        self.local, self.names = dict(arguments), {}

    def leave(self, value: float | None = None) -> None:
        """End a subprogram or macro, which may return a value."""
        self.local, self.names = self._outer.pop()
        self.returned = value


MAX_EQUAL_DIFFERENCE: Final = 1e-4
"""How far apart two values may be and still be equal."""

_MAX_INTEGER_DIFFERENCE: Final = 1e-4
_NUMBER: Final = re.compile(r"(?:[0-9]++(?:\.[0-9]*+)?|\.[0-9]++)")
_OPERATOR: Final = re.compile(r"\*\*|MOD|AND|XOR|OR|EQ|NE|GT|GE|LT|LE|[-+*/&|^]")
_NAME: Final = re.compile(r"<([^<>#=]++(?:\[[^\]]*+\])?[^<>#=]*+)>")
FUNCTION: Final = re.compile(r"([A-Z]{2,6})\[")


def _modulo(left: float, right: float) -> float:
    rest = fmod(left, right)
    return rest + abs(right) if rest < 0.0 else rest


def _power(left: float, right: float) -> float:
    if left < 0.0 and right != floor(right):
        raise ValueError
    return float(left**right)


Operation = Callable[[float, float], float]

_BINARY_OPERATORS: Final[Mapping[str, tuple[int, Operation]]] = {
    "**": (4, _power),
    "*": (3, lambda left, right: left * right),
    "/": (3, lambda left, right: left / right),
    "MOD": (3, _modulo),
    "+": (2, lambda left, right: left + right),
    "-": (2, lambda left, right: left - right),
    "EQ": (1, lambda left, right: float(abs(left - right) < MAX_EQUAL_DIFFERENCE)),
    "NE": (1, lambda left, right: float(abs(left - right) >= MAX_EQUAL_DIFFERENCE)),
    "GT": (1, lambda left, right: float(left > right)),
    "LT": (1, lambda left, right: float(left < right)),
    "GE": (1, lambda left, right: float(left >= right)),
    "LE": (1, lambda left, right: float(left <= right)),
    "AND": (0, lambda left, right: float(left != 0.0 and right != 0.0)),
    "OR": (0, lambda left, right: float(left != 0.0 or right != 0.0)),
    "XOR": (0, lambda left, right: float((left != 0.0) != (right != 0.0))),
    "&": (0, lambda left, right: float(int(left) & int(right))),
    "|": (0, lambda left, right: float(int(left) | int(right))),
    "^": (0, lambda left, right: float(int(left) ^ int(right))),
}

FUNCTIONS: Final[Mapping[str, Callable[[float], float]]] = {
    "ABS": abs,
    "ACOS": lambda value: degrees(acos(value)),
    "ASIN": lambda value: degrees(asin(value)),
    "COS": lambda value: cos(radians(value)),
    "EXP": exp,
    "FIX": lambda value: float(floor(value)),
    "FUP": lambda value: float(ceil(value)),
    "LN": natural_log,
    "ROUND": lambda value: float(int(value + (-0.5 if value < 0.0 else 0.5))),
    "SIN": lambda value: sin(radians(value)),
    "SQRT": sqrt,
    "TAN": lambda value: tan(radians(value)),
}


Setting = tuple[int | str, float]
"""A parameter's number or name, and its new value."""


class ExpressionReader:
    """Reads values from a text in capitals without blanks; `at` is its position in the text.

    `unset` has the numbers of the parameters read that nothing had set, and where they are read.  `ranks`: operators of
    a higher rank are applied first.  `max_nested`: how deep values may nest, as in ####1.
    """

    ranks = _BINARY_OPERATORS
    max_nested = 50
    nested_rule = "MACRO"
    no_value = "WORD", "A value needs a letter before it; to set a parameter write #n=value."

    def __init__(self, text: str, values: MacroParameters, at: int = 0) -> None:
        self.text = text
        self.values = values
        self.at = at
        self.unset: list[tuple[int, int]] = []
        self._depth = 0

    def value(self) -> float:
        """Return one value: a number, a parameter, brackets or a function, with any signs before it."""
        sign, text = 1.0, self.text
        while text[self.at : self.at + 1] in ("+", "-"):
            sign = -sign if text[self.at] == "-" else sign
            self.at += 1
        return sign * self._nested()

    def _nested(self) -> float:
        """Return a value without signs, unless values lie inside each other too deep."""
        self._depth += 1
        if self._depth > self.max_nested:
            text = "Too many brackets or signs # lie inside each other; use parameters."
            raise FaultError(self.nested_rule, text, self.at)
        value = self._bare()
        self._depth -= 1
        return value

    def _bare(self) -> float:
        number = _NUMBER.match(self.text, self.at)
        if number:
            self.at = number.end()
            return self._computed(number.start(), "This number", float, number[0])
        first = self.text[self.at : self.at + 1]
        if first == "[":
            return self.brackets()
        if first == "#":
            return self._parameter()
        return self._function()

    def brackets(self) -> float:
        """Return the value of an expression in square brackets."""
        begin = self.at
        if self.text[begin : begin + 1] != "[":
            raise FaultError("MACRO", f"A value in square brackets is missing{self._before()}.", begin)
        self.at += 1
        value = self._ranked(0)
        if self.at < len(self.text) and self.text[self.at] != "]":
            raise FaultError("MACRO", f"An operator or a closing bracket is missing{self._before()}.", self.at)
        self._close(begin)
        return value

    def _close(self, begin: int) -> None:
        """Pass the bracket that closes the one at `begin`."""
        if self.text[self.at : self.at + 1] != "]":
            raise FaultError("MACRO", "The bracket is not closed; write the closing one.", begin)
        self.at += 1

    def setting(self) -> Setting:
        """Return what an assignment sets, and its value."""
        begin, key = self.at, self.key()
        if self.text[self.at : self.at + 1] != "=":
            raise FaultError(*self.no_value, begin)
        self.values.settable(key, begin)
        self.at += 1
        return key, self.right_side()

    def right_side(self) -> float:
        """Return the value right of an equal sign: that of an expression, on LinuxCNC of a single value."""
        if self.values.kept is ParameterStore.MACRO_B:
            return self._ranked(0)
        value, operator = self.value(), _OPERATOR.match(self.text, self.at)
        if operator is not None:
            text = "Right of = this control takes one value. Write the expression in square brackets."
            raise FaultError("MACRO", f"{text} Without them {only_on(FREE_ASSIGNMENT)}", self.at)
        return value

    def _ranked(self, rank: int) -> float:
        value = self.value()
        while (name := self._operator()) and self.ranks[name][0] >= rank:
            begin, (operator_rank, operation) = self.at, self.ranks[name]
            self.at += len(name)
            value = self._apply_operator(begin, name, operation, value, self._ranked(operator_rank + 1))
        return value

    def _operator(self) -> str:
        """Return the operator that comes next, "" if none that this control has does."""
        operator = _OPERATOR.match(self.text, self.at)
        if operator is None or (operator[0] in "&|^" and self.values.kept is not ParameterStore.MACRO_B):
            return ""
        return operator[0]

    def _apply_operator(self, at: int, name: str, operation: Operation, left: float, right: float) -> float:
        return self._computed(at, name, operation, left, right)

    def _computed(self, at: int, name: str, function: Callable[..., float], *values: float | str) -> float:
        try:
            value = function(*values)
        except (ValueError, ArithmeticError):
            value = float("nan")
        if not isfinite(value):
            raise FaultError("MACRO", f"{name} has no value for these numbers. Check its arguments.", at)
        return value

    def _parameter(self) -> float:
        begin, key = self.at, self.key()
        if isinstance(key, str):
            return self.values.named(key, begin)
        value = self.values.number(key, begin)
        if value is None:
            self.unset.append((key, begin))
        return 0.0 if value is None else value

    def key(self) -> int | str:
        """Return the number or the name after a #."""
        begin = self.at
        self.at += 1
        if self.text[self.at : self.at + 1] == "<":
            return self.name()
        value = self.value()
        if abs(value - round(value)) > _MAX_INTEGER_DIFFERENCE:
            raise FaultError("PARAMETER", "The number of a parameter must be a whole number.", begin)
        return round(value)

    def name(self) -> str:
        """Return the name between < and >."""
        name = _NAME.match(self.text, self.at)
        if name is None:
            raise FaultError("MACRO", "The name is not closed. Write > after it.", self.at)
        self.at = name.end()
        return name[1]

    def _function(self) -> float:
        begin, function = self.at, FUNCTION.match(self.text, self.at)
        if function is None:
            raise FaultError("MACRO", f"A value is missing{self._before()}.", begin)
        name = self.function_named(function[1])
        if name is None:
            raise FaultError("MACRO", f"This control has no function {function[1]}.", begin)
        self.at = function.end(1)
        return self.call(name, begin)

    def function_named(self, written: str) -> str | None:
        """Return the function of this control that a name means."""
        return written if written in FUNCTIONS or written in ("ATAN", "EXISTS") else None

    def call(self, name: str, begin: int) -> float:
        """Return the value of a function, whose arguments come next."""
        if name == "EXISTS":
            return self._exists()
        if name == "ATAN":
            return self._atan(begin)
        return self._computed(begin, name, FUNCTIONS[name], self.brackets())

    def _atan(self, begin: int) -> float:
        first = self.brackets()
        if self.text[self.at : self.at + 2] != "/[":
            raise FaultError("MACRO", "ATAN takes two values: ATAN[y]/[x].", begin)
        self.at += 1
        return degrees(atan2(first, self.brackets()))

    def _exists(self) -> float:
        begin = self.at
        if self.text[begin : begin + 3] != "[#<":
            raise FaultError("MACRO", "EXISTS takes a name: EXISTS[#<name>].", begin)
        self.at += 2
        name = self.name()
        self._close(begin)
        return float(self.values.exists(name))

    def _before(self) -> str:
        rest = quoted(self.text[self.at :])
        return f" before {rest}" if rest else " at the end"


_POINT_ENDS: Final = re.compile(r"[0-9]+\.(?![0-9])")

COMMENT_GAP: Final = "\x01"
"""Marks where a comment was: it may be between words, but not between digits."""


class CompactText(NamedTuple):
    """A text of a line in capitals without blanks, and the column less one of each character."""

    text: str
    columns: tuple[int, ...]
    line: int

    @staticmethod
    def of(text: str, line: int, start: int = 0) -> CompactText:
        """Return a text without its blanks; `start` is where it begins on its line."""
        kept = [(character, start + index) for index, character in enumerate(text) if character not in " \t"]
        return CompactText("".join(character for character, _ in kept), tuple(column for _, column in kept), line)

    def place(self, at: int) -> Spot:
        """Return the place of a position in the text; past its end, that of its last character."""
        return Spot(self.line, self.columns[min(at, len(self.columns) - 1)] + 1 if self.columns else 1)


class Word(NamedTuple):
    """A word: its letter, its number as text, and its column on the line."""

    letter: str
    number: str
    column: int


STRICT_N: Final = "N stands first in a line, and its number has no point at its end. Write it so, or delete it."

POLAR: Final = frozenset("@^")
POLAR_TEXT: Final = "cutcomp does not follow @ and ^, polar coordinates. Write X and Y."


def evaluated_line(line: CompactText, values: MacroParameters, log: Log) -> list[Word]:
    """Return a line's words with the values of their expressions; set the parameters that the line sets.

    What cannot be evaluated stops the run.
    """
    reader = ExpressionReader(line.text, values)
    words: list[Word] = []
    settings: list[Setting] = []
    try:
        while reader.at < len(line.text):
            _item(reader, line, words, settings)
    except FaultError as fault:
        log.stop(fault.code, fault.text, line.place(fault.at))
    report_unset(reader, line, log)
    for key, value in settings:
        values.set(key, value)
    return words


def _item(reader: ExpressionReader, line: CompactText, words: list[Word], settings: list[Setting]) -> None:
    """Read one word, or one setting of a parameter."""
    begin, text, strict = reader.at, line.text, reader.values.kept is ParameterStore.NGC
    first = text[begin]
    if first == COMMENT_GAP:
        reader.at += 1
    elif first == "#":
        settings.append(reader.setting())
    elif first == "N" and text[begin + 1 : begin + 2] not in frozenset("0123456789"):
        raise FaultError("WORD", "A block number is plain digits.", begin)
    elif first == "N" and strict and (words or settings or _POINT_ENDS.match(text, begin + 1)):
        raise FaultError("WORD", STRICT_N, begin)
    elif "A" <= first <= "Z":
        reader.at += 1
        value = reader.value()
        words.append(Word(first, exact(value) if strict else plain(value), line.place(begin).column))
    elif first in POLAR and strict:
        raise FaultError("BEYOND", POLAR_TEXT, begin)
    else:
        raise FaultError("WORD", not_a_word(text[begin:]), begin)


def not_a_word(text: str) -> str:
    """Return the sentence that no word begins with a text; an invisible character is named by its number."""
    if text and not text[0].isprintable():
        return f"An invisible character (U+{ord(text[0]):04X}) stands here. Delete it."
    return f"{quoted(text)} is not a word. Write a letter and a value."


def report_unset(reader: ExpressionReader, line: CompactText, log: Log) -> None:
    """Warn of parameters that were read before anything set them."""
    for index, at in reader.unset:
        text = f"The program does not set #{index}; cutcomp takes 0, and the control may keep another value in it."
        log.warn("PARAMETER", text, line.place(at))


def exact(value: float) -> str:
    """Return a value to its last digit, without exponent: LinuxCNC makes a move even of a rounding error."""
    return f"{Decimal(repr(value)):f}"


def plain(value: float) -> str:
    """Return a value as a number without exponent."""
    return f"{value:.12f}".rstrip("0").rstrip(".")
