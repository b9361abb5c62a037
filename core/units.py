"""Units: convert the text of a form's field to millimeters or radians and back, and format values for the screens.

A field takes the sums of `core.arithmetic`; a suffix (`12.7mm`, `.5in`, `.5"`, `22.5deg`) converts to program units.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, StrEnum, auto
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor, isfinite
from typing import Final, assert_never

from core.arithmetic import CannotReadError, evaluate
from core.finding import Finding
from core.tolerance import LARGEST_COORDINATE, ROUNDING

MAX_QUOTED: Final = 24
"""Most characters of a user's text that a message quotes."""

MAX_SHOWN: Final = 10
"""Most characters in the output of `show`: larger numbers lose decimals."""


class Unit(StrEnum):
    """The unit of every length and feed of a program."""

    IN = "IN"
    MM = "MM"


class Kind(Enum):
    """The kind of value that a field takes; it decides how the value is read, displayed and converted."""

    LENGTH = auto()
    FEED = auto()
    ANGLE = auto()
    COUNT = auto()
    PERCENT = auto()
    CHOICE = auto()
    TEXT = auto()


@dataclass(frozen=True, slots=True)
class Unreadable:
    """Text that is not a value; `reason` is a sentence for the operator."""

    reason: str


MM_PER: Final[Mapping[Unit, Fraction]] = {Unit.IN: Fraction(127, 5), Unit.MM: Fraction(1)}
"""Millimeters in one unit, exactly."""


KEPT_DECIMALS: Final[Mapping[Unit, int]] = {Unit.IN: 10, Unit.MM: 8}
"""Decimals that a conversion keeps: more than a drawing has."""

MOST_DECIMALS: Final = 20
"""A conversion that needs this many decimals or more keeps them all."""

EXTRA_DECIMALS: Final = 6
"""Most decimals that a sentence adds to a form's decimals: for two nearly equal lengths, or a limit that shows as 0."""
LAST_DIGITS: Final = 1e-9
"""By how much, in program units, rounding may have moved a limit that was calculated from typed numbers."""


def to_mm(value: float, unit: Unit) -> float:
    """Convert a length (or a feed) in program units to millimeters (per minute)."""
    return value * 25.4 if unit is Unit.IN else value


def from_mm(value: float, unit: Unit) -> float:
    """Convert a length (or a feed) in millimeters (per minute) to program units."""
    return value / 25.4 if unit is Unit.IN else value


def convert(value: float, old: Unit, new: Unit) -> float:
    """Convert a typed length or feed to another unit, so that converting back restores any number of 14 digits.

    Inches keep ten decimals and millimeters eight: 3 mm is 0.1181102362 in, and that is 3 mm again.  If these do not
    lead back, as for 1/3 in, there are as many more as it takes.
    """
    if old is new:
        return value
    exact = Fraction(value) * MM_PER[old] / MM_PER[new]
    candidates = (float(round(exact, decimals)) for decimals in range(KEPT_DECIMALS[new], MOST_DECIMALS))
    return next((candidate for candidate in candidates if _converts_back(candidate, value, old, new)), float(exact))


def _converts_back(converted: float, value: float, old: Unit, new: Unit) -> bool:
    """True if converting `converted` back gives `value`, with the kept decimals if these are enough."""
    factor = MM_PER[new] / MM_PER[old]
    rounded = float(round(Fraction(converted) * factor, KEPT_DECIMALS[old]))
    rounded_converts_again = float(round(Fraction(rounded) / factor, KEPT_DECIMALS[new])) == converted
    return value == (rounded if rounded_converts_again else float(Fraction(converted) * factor))


def show(value: float, kind: Kind, unit: Unit) -> str:
    """Format a value in program units for the screens, in at most `MAX_SHOWN` characters, never as a negative zero."""
    if not isfinite(value):
        return str(value)
    decimals = decimals_shown(kind, unit)
    if kind in (Kind.FEED, Kind.PERCENT):
        # a slow feed has digits behind the first one
        decimals = next((more for more in (1, 2) if round(value, more) == round(value, 3)), 3)
    text = f"{value:.{decimals}f}"
    if len(text) > MAX_SHOWN:
        texts = (f"{value:.{digits}f}" for digits in range(decimals - 1, -1, -1))
        text = next((text for text in texts if len(text) <= MAX_SHOWN), f"{value:.3g}")
    return text.removeprefix("-") if not text.strip("-0.") else text


def decimals_shown(kind: Kind, unit: Unit) -> int:
    """Return the number of decimals with which the screens print a value; a feed or a percentage may have more."""
    match kind:
        case Kind.LENGTH:
            return 4 if unit is Unit.IN else 3
        case Kind.ANGLE:
            return 3
        case Kind.FEED | Kind.PERCENT:
            return 1
        case _:
            return 0


def length_text(millimeters: float, unit: Unit) -> str:
    """Format a length given in millimeters in program units, with the decimals of the form."""
    return show(from_mm(millimeters, unit), Kind.LENGTH, unit)


def plain(text: str) -> str:
    """Return a text with a question mark in place of each character that does not print."""
    return "".join(character if character.isprintable() else "?" for character in text)


def printable(text: str) -> str:
    """Return a user's text fit for a message: on one line, short, and without characters that move the cursor."""
    line = plain(text.strip())
    return line if len(line) <= MAX_QUOTED else f"{line[:MAX_QUOTED]}..."


def sentence(finding: Finding, unit: Unit) -> str:
    """Return a finding's text with its lengths filled in, in program units."""
    known: dict[str, float] = {str(index): length for index, length in enumerate(finding.lengths)}
    if finding.value is not None:
        known["value"] = finding.value
    if finding.at is not None:
        known["x"], known["y"] = finding.at
    if finding.area is not None:
        # dividing by one inch here and another in `fill` gives square inches
        known["area"] = from_mm(finding.area, unit)

    def fill(place: re.Match[str]) -> str:
        length, other = known.get(place[1]), known.get(place[2] or "")
        if length is None or (place[2] and other is None):
            return place[0]
        value = from_mm(length, unit)
        if place[3]:
            return _rounded_inward(value, unit, up=place[3] == "+")
        if other is None or abs(length - other) <= ROUNDING:
            return show(value, Kind.LENGTH, unit)
        return _distinguishing_digits(value, from_mm(other, unit), unit)

    return re.sub(r"\{(\w+)(?:~(\w+)|([-+]))?\}", fill, finding.text)


def segment_name(number: float) -> str:
    """Return `segment 3`, or `corner 3-4` for the corner arc after segment 3, which has the number 3.5."""
    return f"segment {number:g}" if number == int(number) else f"corner {int(number)}-{int(number) + 1}"


def located_sentence(finding: Finding, unit: Unit) -> str:
    """Return a finding's sentence with its block and segment in front: `Block 1, segment 2: ...`."""
    parts = [] if finding.block is None else [f"block {finding.block}"]
    if finding.segment is not None:
        parts.append(segment_name(finding.segment) if finding.segment else "START")
    where = ", ".join(parts)
    return f"{where[:1].upper()}{where[1:]}: {sentence(finding, unit)}" if where else sentence(finding, unit)


def _rounded_inward(value: float, unit: Unit, *, up: bool) -> str:
    """Format a limit with a form's decimals so that the number typed is within it; more decimals if it were 0."""
    form_decimals = decimals_shown(Kind.LENGTH, unit)
    text = show(value, Kind.LENGTH, unit)
    if not isfinite(value) or abs(value) <= LAST_DIGITS:
        return text
    for digits in range(form_decimals, form_decimals + EXTRA_DECIMALS):
        # a difference of typed numbers may miss what it should be by its last digits
        steps = ceil((value - LAST_DIGITS) * 10**digits) if up else floor((value + LAST_DIGITS) * 10**digits)
        text = f"{steps / 10**digits:.{digits}f}"
        if steps:
            break
    return text


def _distinguishing_digits(value: float, other: float, unit: Unit) -> str:
    """Format a length with a form's decimals, or with as many more as it takes to show its distance from another."""
    if not (isfinite(value) and isfinite(other)):
        return show(value, Kind.LENGTH, unit)
    difference, form_decimals = abs(value - other), decimals_shown(Kind.LENGTH, unit)
    enough = (
        digits
        for digits in range(form_decimals, form_decimals + EXTRA_DECIMALS)
        if abs(abs(round(value, digits) - round(other, digits)) - difference) <= difference / 10.0
    )
    return f"{value:.{next(enough, form_decimals + EXTRA_DECIMALS)}f}"


def parse(text: str, kind: Kind, unit: Unit) -> float | Unreadable:
    """Return the value of an operator's text in program units (degrees for an angle), or why it is unreadable."""
    try:
        exact = evaluate(with_decimal_point(text, unit), _scales(kind, unit), _EXPECTED.get(kind, ""))
    except CannotReadError as fault:
        return Unreadable(str(fault))
    if kind is Kind.COUNT and exact.denominator != 1:
        return Unreadable(f"Type a whole number, such as {max(round(exact), 1)}.")
    if abs(exact) * (MM_PER[unit] if kind in (Kind.LENGTH, Kind.FEED) else 1) > Fraction(LARGEST_COORDINATE):
        return Unreadable("Too large for any machine.")
    return float(exact)


def with_decimal_point(text: str, unit: Unit) -> str:
    """Replace a text's single comma with a decimal point; raise CannotReadError if it may be a thousands comma.

    In inch programs that is a comma followed by exactly three digits.
    """
    if text.count(",") != 1 or "." in text:
        return text
    thousands = _THOUSANDS.search(text) if unit is Unit.IN else None
    if thousands is not None:
        before, after = thousands.groups()
        raise CannotReadError(f"Type {before}.{after} or {before}{after}.")
    return text.replace(",", ".")


_THOUSANDS: Final = re.compile(r"([0-9]*),([0-9]{3})(?![0-9])")


@lru_cache
def _scales(kind: Kind, unit: Unit) -> Mapping[str, Fraction]:
    """Return the factor of each suffix that a kind takes, to program units."""
    match kind:
        case Kind.LENGTH | Kind.FEED:
            inch, mm = (MM_PER[source] / MM_PER[unit] for source in (Unit.IN, Unit.MM))
            return {"in": inch, "inch": inch, '"': inch, "mm": mm}
        case Kind.ANGLE:
            return {"\N{DEGREE SIGN}": Fraction(1), "deg": Fraction(1)}
        case Kind.PERCENT:
            return {"%": Fraction(1)}
        case Kind.COUNT:
            return {}
        case Kind.CHOICE | Kind.TEXT:
            raise CannotReadError("This field does not take a number.")
        case _:
            assert_never(kind)


_EXPECTED: Final[Mapping[Kind, str]] = {
    Kind.LENGTH: "type a number such as 2.5, 1 1/2, 2.5-.125 or 12.7mm",
    Kind.FEED: "type a number such as 20 or 500mm",
    Kind.ANGLE: "type degrees such as 22.5",
    Kind.COUNT: "type a whole number",
    Kind.PERCENT: "type a percentage such as 50",
}
