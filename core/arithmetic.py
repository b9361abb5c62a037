"""Arithmetic that an operator types into a field, read as exact fractions: `1 1/2`, `2.5-.125`, `25.4/2`, `3mm+1in`.

A suffix belongs to the product it is in; in a sum either every term has one or none has.  Three inputs are ambiguous
and refused with the reason: a comma (a single one has become a decimal point before the text gets here), a dash that
shop people read as "and" (`1-1/2`), and a division by a number with a fraction (`1/2 1/2`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final

MAX_CHARACTERS: Final = 60
"""Most characters that a field accepts; more is a typing mistake."""


class CannotReadError(Exception):
    """A text cannot be read; the message is a sentence for the operator."""


_TOKEN: Final = re.compile(r"\s*(?:(?P<number>[0-9]+\.?[0-9]*|\.[0-9]+)|(?P<sign>[-+*/()])|(?P<word>[^\W\d_]+|\S))")

_REPLACED_SIGNS: Final = str.maketrans(
    {"\t": " ", "\N{MINUS SIGN}": "-", "\N{EN DASH}": "-", "\N{MULTIPLICATION SIGN}": "*"}
)

_DASHED: Final = re.compile(r"\s*([-+]?[0-9]+)-([0-9]+)/(2|4|8|16|32|64)\s*[^-+*/()0-9]*")


def evaluate(text: str, scales: Mapping[str, Fraction], expected: str) -> Fraction:
    """Return the value of a sum; raise CannotReadError if there is none.

    `scales` holds the factor of each suffix, `expected` says what the field takes, such as "type a whole number".
    """
    text = text.translate(_REPLACED_SIGNS)
    if not text.strip():
        raise CannotReadError("Type a number.")
    if len(text) > MAX_CHARACTERS:
        raise CannotReadError(f"Too long: type at most {MAX_CHARACTERS} characters.")
    if not text.isprintable():
        raise CannotReadError("It has a character that cannot be displayed: type it again.")
    if "," in text:
        raise CannotReadError("Use one decimal point (1.5) and no thousands comma.")
    _refuse_dashed(text)
    tokens = [(match.lastgroup or "", match[match.lastgroup or 0]) for match in _TOKEN.finditer(text.rstrip())]
    return _Reader(tokens, scales, expected, text.strip()).result()


def _refuse_dashed(text: str) -> None:
    dashed = _DASHED.fullmatch(text)
    if dashed and int(dashed[2]) < int(dashed[3]):
        whole, above, below = dashed.groups()
        either = f"{whole} {above}/{below} with a blank, or {whole} - {above}/{below} to subtract"
        raise CannotReadError(f"{text.strip()} is not clear: type {either}.")


@dataclass(frozen=True, slots=True)
class _Amount:
    """A number with the scale of its unit, None without a unit; `bracket` marks a sum in brackets."""

    value: Fraction
    scale: Fraction | None = None
    bracket: bool = False

    def scaled(self) -> Fraction:
        return self.value * (1 if self.scale is None else self.scale)


@dataclass(slots=True)
class _Reader:
    """Parser of sums of products of signed numbers, fractions and brackets; each grammar rule is a method."""

    tokens: list[tuple[str, str]]
    scales: Mapping[str, Fraction]
    expected: str
    typed: str
    at: int = 0

    def peek(self, ahead: int = 0) -> tuple[str, str]:
        index = self.at + ahead
        return self.tokens[index] if index < len(self.tokens) else ("end", "")

    def take(self, signs: str) -> str:
        """Take and return the next token if it is one of these signs; else return an empty string."""
        kind, text = self.peek()
        if kind != "sign" or text not in signs:
            return ""
        self.at += 1
        return text

    def result(self) -> Fraction:
        value = self.sum()
        kind, text = self.peek()
        if kind == "number":
            raise CannotReadError(f"{self.typed} is not a number.")
        if text == ")":
            raise CannotReadError("One bracket too many.")
        if kind != "end":
            raise CannotReadError(f"{text} does not belong there.")
        return value.scaled()

    def sum(self) -> _Amount:
        value = self.product()
        while sign := self.take("+-"):
            term = self.product()
            if (term.scale is None) is not (value.scale is None):
                raise CannotReadError("Give every number its unit, or use brackets: (2.5-.125)mm.")
            scaled = value.scaled() + (term.scaled() if sign == "+" else -term.scaled())
            value = _Amount(scaled, None if value.scale is None else Fraction(1))
        return value

    def product(self) -> _Amount:
        value = self.signed()
        while sign := self.take("*/"):
            factor = self.signed()
            value = _product(value, factor) if sign == "*" else _quotient(value, factor)
        return value

    def signed(self) -> _Amount:
        sign = self.take("+-")
        amount = self.single()
        return replace(amount, value=-amount.value) if sign == "-" else amount

    def single(self) -> _Amount:
        amount = self.bracket() if self.take("(") else _Amount(self.number())
        kind, text = self.peek()
        if kind != "word":
            return amount
        if text.lower() not in self.scales:
            raise CannotReadError(f"{text} is not a unit here: {self.expected}.")
        if amount.scale is not None:
            raise CannotReadError("One unit is enough for a number.")
        self.at += 1
        return replace(amount, scale=self.scales[text.lower()])

    def bracket(self) -> _Amount:
        inside = self.sum()
        if not self.take(")"):
            raise CannotReadError("A closing bracket is missing.")
        return replace(inside, bracket=True)

    def number(self) -> Fraction:
        kind, text = self.peek()
        if kind == "word":
            raise CannotReadError(f"{text} is not a number: {self.expected}.")
        if kind != "number":
            raise CannotReadError(f"A number is missing {f'before {text}' if text else 'at the end'}.")
        self.at += 1
        return Fraction(text) + self.fraction(text)

    def fraction(self, whole: str) -> Fraction:
        """Return the fraction after the whole number, as the 1/2 of 1 1/2, or 0."""
        (first, above), (_, slash), (last, below) = (self.peek(ahead) for ahead in range(3))
        if (first, slash, last) != ("number", "/", "number") or "." in whole + above + below:
            return Fraction(0)
        if int(above) >= int(below):
            raise CannotReadError(f"{whole} {above}/{below}: the fraction must be less than 1.")
        if re.search(r"/[-+]?$", "".join(text for _, text in self.tokens[: self.at - 1])):
            raise CannotReadError(
                f"{self.typed} is not clear: put {whole} {above}/{below} into brackets to divide by it."
            )
        self.at += 3
        return Fraction(int(above), int(below))


def _product(left: _Amount, right: _Amount) -> _Amount:
    if left.scale is not None and right.scale is not None:
        raise CannotReadError("Length times length: remove one unit.")
    return _Amount(left.value * right.value, right.scale if left.scale is None else left.scale)


def _quotient(left: _Amount, right: _Amount) -> _Amount:
    if right.value == 0:
        raise CannotReadError("Division by zero.")
    if right.scale is not None and (left.scale is not None or right.bracket):
        raise CannotReadError("Number divided by a length: remove the unit.")
    return _Amount(left.value / right.value, right.scale if left.scale is None else left.scale)
