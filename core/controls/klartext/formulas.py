"""Formulas compute Q parameters, as in `Q1 = +Q2 * SIN 30` and `FN 4: Q1 = +Q2 DIV +3`, and conditions (FN 9 to 12).

Angles are in degrees.  A formula has either a value or a sentence that says why it has none.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from core.controls.iso.expressions import FUNCTIONS
from core.controls.program_text import quoted

MAX_NESTING: Final = 50
"""Most brackets and functions within one another in a formula."""

_TOKEN: Final = re.compile(r"\s*(?:(\d+[.,]?\d*|[.,]\d+)|(Q[LR]?\d+)|([A-Z]+|[-+*/^()])|(\S))", re.ASCII)

_FUNCTIONS: Final[Mapping[str, Callable[[float], float]]] = {
    **{name: FUNCTIONS[name] for name in ("ABS", "ACOS", "ASIN", "COS", "EXP", "LN", "SIN", "SQRT", "TAN")},
    "ATAN": lambda x: math.degrees(math.atan(x)),
    "SQ": lambda x: x * x,
    "INT": lambda x: float(math.trunc(x)),
    "FRAC": lambda x: math.modf(x)[0],
    "NEG": lambda x: -x,
    "SGN": lambda x: float((x > 0.0) - (x < 0.0)),
    "LOG": math.log10,
}
_OPERATORS: Final[Mapping[str, tuple[int, Callable[[float, float], float]]]] = {
    "+": (0, lambda a, b: a + b),
    "-": (0, lambda a, b: a - b),
    "*": (1, lambda a, b: a * b),
    "/": (1, lambda a, b: a / b),
    "DIV": (1, lambda a, b: a / b),
    "LEN": (1, math.hypot),
    "ANG": (1, lambda a, b: math.degrees(math.atan2(a, b)) % 360.0),
    "^": (2, math.pow),
}
"""The rank and the function of each operator; a higher rank binds first."""


class _FaultError(Exception):
    """Why a formula has no value; it leaves the recursion and is caught by `evaluate`."""


def evaluate(text: str, parameters: Mapping[str, float]) -> float | str:
    """Return the value of a formula in upper case with these Q parameters, or the sentence that says why not."""
    tokens = [token.group(token.lastindex or 0).strip() for token in _TOKEN.finditer(text)]
    parser = _Parser(tokens, parameters)
    try:
        value = parser.ranked()
    except _FaultError as fault:
        return str(fault)
    except (ArithmeticError, ValueError):
        return "The formula divides by zero, or a function or power is outside its range."
    if parser.at < len(tokens):
        return f"A formula cannot have {quoted(tokens[parser.at])} at this place."
    return value if math.isfinite(value) else "The formula's value is too large."


@dataclass(slots=True)
class _Parser:
    tokens: list[str]
    parameters: Mapping[str, float]
    at: int = 0
    depth: int = 0

    def next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        token = self.next()
        self.at += 1
        return token

    def ranked(self, rank: int = 0) -> float:
        """Return the value of operators of a rank or a higher one; those of one rank go from left to right."""
        value = self.operand()
        while (name := self.next()) in _OPERATORS and _OPERATORS[name][0] >= rank:
            operator_rank, operate = _OPERATORS[self.take()]
            value = operate(value, self.ranked(operator_rank + 1))
        return value

    def operand(self) -> float:
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise _FaultError(f"The formula nests more than {MAX_NESTING} brackets and functions.")
        value = self._operand(self.take())
        self.depth -= 1
        return value

    def _operand(self, token: str) -> float:
        if token in ("+", "-"):
            return self.operand() if token == "+" else -self.operand()
        if token == "(":
            value = self.ranked()
            if self.take() != ")":
                raise _FaultError("A bracket is not closed in this formula.")
            return value
        if token == "PI":
            return math.pi
        if token in _FUNCTIONS:
            return _FUNCTIONS[token](self.operand())
        return self.number(token)

    def number(self, token: str) -> float:
        if token.startswith("Q"):
            if token not in self.parameters:
                raise _FaultError(f"{token} has no value yet. Set it before.")
            return self.parameters[token]
        if not token or not (token[0].isdigit() or token[0] in ".,"):
            raise _FaultError(f"A formula needs a number at {quoted(token) or 'its end'}.")
        return float(token.replace(",", "."))
