"""Expressions: numbers, #parameters, [brackets] and functions, as LinuxCNC and RosettaCNC work them out.

Operators of one rank go from left to right, the power too.  Angles are degrees.  Two values are equal within 0.0001.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from math import acos, asin, atan2, ceil, cos, degrees, exp, floor, fmod, isfinite, log, radians, sin, sqrt, tan
from typing import Final

from core.controls.iso.parameters import FaultError, Kept, Parameters
from core.controls.program_text import quoted

EQUAL: Final = 1e-4
"""How far two values may be apart and still be equal."""

_WHOLE: Final = 1e-4
_DEEPEST: Final = 50
_NUMBER: Final = re.compile(r"(?:[0-9]++(?:\.[0-9]*+)?|\.[0-9]++)")
_OPERATOR: Final = re.compile(r"\*\*|MOD|AND|XOR|OR|EQ|NE|GT|GE|LT|LE|[-+*/&|^]")
_NAME: Final = re.compile(r"<([^<>#=]++(?:\[[^\]]*+\])?[^<>#=]*+)>")
_FUNCTION: Final = re.compile(r"([A-Z]{2,6})\[")


def _modulo(left: float, right: float) -> float:
    rest = fmod(left, right)
    return rest + abs(right) if rest < 0.0 else rest


def _power(left: float, right: float) -> float:
    if left < 0.0 and right != floor(right):
        raise ValueError
    return float(left**right)


_RANKS: Final[Mapping[str, tuple[int, Callable[[float, float], float]]]] = {
    "**": (4, _power),
    "*": (3, lambda left, right: left * right),
    "/": (3, lambda left, right: left / right),
    "MOD": (3, _modulo),
    "+": (2, lambda left, right: left + right),
    "-": (2, lambda left, right: left - right),
    "EQ": (1, lambda left, right: float(abs(left - right) < EQUAL)),
    "NE": (1, lambda left, right: float(abs(left - right) >= EQUAL)),
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

_FUNCTIONS: Final[Mapping[str, Callable[[float], float]]] = {
    "ABS": abs,
    "ACOS": lambda value: degrees(acos(value)),
    "ASIN": lambda value: degrees(asin(value)),
    "COS": lambda value: cos(radians(value)),
    "EXP": exp,
    "FIX": lambda value: float(floor(value)),
    "FUP": lambda value: float(ceil(value)),
    "LN": log,
    "ROUND": lambda value: float(int(value + (-0.5 if value < 0.0 else 0.5))),
    "SIN": lambda value: sin(radians(value)),
    "SQRT": sqrt,
    "TAN": lambda value: tan(radians(value)),
}


class Reader:
    """Reads values out of a text in capitals without blanks; `at` is where it stands.

    `unset` are the numbers read that nothing had set, and where.
    """

    def __init__(self, text: str, values: Parameters, at: int = 0) -> None:
        self.text = text
        self.values = values
        self.at = at
        self.unset: list[tuple[int, int]] = []
        self._depth = 0

    def value(self) -> float:
        """One value: a number, a parameter, brackets, a function, any of them with signs before."""
        sign, text = 1.0, self.text
        while text[self.at : self.at + 1] in ("+", "-"):
            sign = -sign if text[self.at] == "-" else sign
            self.at += 1
        self._depth += 1
        if self._depth > _DEEPEST:
            raise FaultError("MACRO", "Too many brackets or signs # lie inside each other; use parameters.", self.at)
        value = sign * self._bare()
        self._depth -= 1
        return value

    def _bare(self) -> float:
        found = _NUMBER.match(self.text, self.at)
        if found:
            self.at = found.end()
            return self._worked(found.start(), "This number", float, found[0])
        first = self.text[self.at : self.at + 1]
        if first == "[":
            return self.brackets()
        if first == "#":
            return self._parameter()
        return self._function()

    def brackets(self) -> float:
        """An expression in square brackets."""
        begin = self.at
        if self.text[begin : begin + 1] != "[":
            raise FaultError("MACRO", f"A value in square brackets is missing{self._before()}.", begin)
        self.at += 1
        value = self._ranked(0)
        if self.text[self.at : self.at + 1] != "]":
            if self.at >= len(self.text):
                raise FaultError("MACRO", "The bracket is not closed; write the closing one.", begin)
            raise FaultError("MACRO", f"An operator or a closing bracket is missing{self._before()}.", self.at)
        self.at += 1
        return value

    def _ranked(self, rank: int) -> float:
        value = self.value()
        while (found := _OPERATOR.match(self.text, self.at)) and _RANKS[found[0]][0] >= rank:
            if found[0] in "&|^" and self.values.kept is not Kept.MACRO_B:
                break
            begin, self.at = self.at, found.end()
            above, work = _RANKS[found[0]]
            value = self._worked(begin, found[0], work, value, self._ranked(above + 1))
        return value

    def _worked(self, at: int, name: str, work: Callable[..., float], *values: float | str) -> float:
        try:
            value = work(*values)
        except (ValueError, ArithmeticError):
            value = float("nan")
        if not isfinite(value):
            raise FaultError("MACRO", f"{name} has no value here; correct what it is worked out from.", at)
        return value

    def _parameter(self) -> float:
        begin, key = self.at, self.key()
        if isinstance(key, str):
            return self.values.named(key, begin)
        value = self.values.number(key, begin)
        if value is None:
            self.unset.append((key, begin))
        return value or 0.0

    def key(self) -> int | str:
        """The number or the name behind a sign #."""
        begin = self.at
        self.at += 1
        if self.text[self.at : self.at + 1] == "<":
            return self.name()
        value = self.value()
        if abs(value - round(value)) > _WHOLE:
            raise FaultError("PARAMETER", "The number of a parameter has to be a whole one.", begin)
        return round(value)

    def name(self) -> str:
        """A name between < and >."""
        found = _NAME.match(self.text, self.at)
        if found is None:
            raise FaultError("MACRO", "The name is not closed; write > behind it.", self.at)
        self.at = found.end()
        return found[1]

    def _function(self) -> float:
        begin, found = self.at, _FUNCTION.match(self.text, self.at)
        if found is None:
            raise FaultError("MACRO", f"A value is missing{self._before()}.", begin)
        name, self.at = found[1], found.end(1)
        if name == "EXISTS":
            return self._exists()
        if name == "ATAN":
            return self._atan(begin)
        if name not in _FUNCTIONS:
            raise FaultError("MACRO", f"{name} is no function of this control.", begin)
        return self._worked(begin, name, _FUNCTIONS[name], self.brackets())

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
        if self.text[self.at : self.at + 1] != "]":
            raise FaultError("MACRO", "The bracket is not closed; write the closing one.", begin)
        self.at += 1
        return float(self.values.exists(name))

    def _before(self) -> str:
        rest = quoted(self.text[self.at :])
        return f" before {rest}" if rest else " at the end"
