"""Units: the text of a form's field to millimeters or radians and back, and how the screens print it.

A field takes the sums of `core.arithmetic`; a suffix (`12.7mm`, `.5in`, `.5"`, `22.5deg`) converts into program units.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, StrEnum, auto
from fractions import Fraction
from functools import lru_cache
from math import degrees, isfinite, radians
from types import MappingProxyType
from typing import Final, assert_never

from core.arithmetic import CannotReadError, evaluate
from core.finding import Finding
from core.tolerance import LARGEST, ROUNDING

MAX_QUOTED: Final = 24
"""Characters of somebody's text that a message repeats."""

MAX_SHOWN: Final = 10
"""Characters `show` takes at most: larger numbers lose decimals."""


class Unit(StrEnum):
    """The unit of every length and feed of a program."""

    IN = "IN"
    MM = "MM"


class Kind(Enum):
    """What sort of value a field takes; it decides how it is read, shown and converted."""

    LENGTH = auto()
    FEED = auto()
    ANGLE = auto()
    COUNT = auto()
    PERCENT = auto()
    CHOICE = auto()
    TEXT = auto()


@dataclass(frozen=True, slots=True)
class Unreadable:
    """Text that is no value; `reason` is a sentence for the operator."""

    reason: str


MM_PER: Final[Mapping[Unit, Fraction]] = MappingProxyType({Unit.IN: Fraction(127, 5), Unit.MM: Fraction(1)})
"""Millimeters in one unit, exactly."""


KEPT_DECIMALS: Final[Mapping[Unit, int]] = MappingProxyType({Unit.IN: 10, Unit.MM: 8})
"""Decimals that a conversion keeps: more than a drawing has."""

MOST_DECIMALS: Final = 20
"""A conversion that needs more decimals keeps all that there are."""

EXTRA_DECIMALS: Final = 6
"""More decimals than a form's that a sentence shows at most of two lengths that are nearly equal."""


def to_mm(value: float, unit: Unit) -> float:
    """Millimeters (per minute) of a length (a feed) in program units."""
    return value * 25.4 if unit is Unit.IN else value


def from_mm(value: float, unit: Unit) -> float:
    """Program units (per minute) of a length (a feed) in millimeters."""
    return value / 25.4 if unit is Unit.IN else value


def to_radians(value: float) -> float:
    """Radians of an angle as the form shows it, in degrees."""
    return radians(value)


def from_radians(value: float) -> float:
    """Degrees, as the form shows them, of an angle in radians."""
    return degrees(value)


def convert(value: float, old: Unit, new: Unit) -> float:
    """A typed length or feed in another unit, such that there and back gives any number of 14 digits again.

    Inches keep ten decimals and millimeters eight: 3 mm is 0.1181102362 in, and that is 3 mm again.  Where these do not
    lead back, as those of 1/3 in, there are as many more as do.
    """
    if old is new:
        return value
    exact = Fraction(value) * MM_PER[old] / MM_PER[new]
    candidates = (float(round(exact, decimals)) for decimals in range(KEPT_DECIMALS[new], MOST_DECIMALS))
    return next((candidate for candidate in candidates if _leads_back(candidate, value, old, new)), float(exact))


def _leads_back(converted: float, value: float, old: Unit, new: Unit) -> bool:
    """Whether converting `converted` back gives `value`: with the decimals that are kept if these will do."""
    factor = MM_PER[new] / MM_PER[old]
    kept = float(round(Fraction(converted) * factor, KEPT_DECIMALS[old]))
    will_do = float(round(Fraction(kept) / factor, KEPT_DECIMALS[new])) == converted
    return value == (kept if will_do else float(Fraction(converted) * factor))


def show(value: float, kind: Kind, unit: Unit) -> str:
    """A value in program units as the screens print it, at most `MAX_SHOWN` characters, never a negative zero."""
    if not isfinite(value):
        return str(value)
    decimals = decimals_shown(kind, unit)
    text = f"{value:.{decimals}f}"
    if len(text) > MAX_SHOWN:
        texts = (f"{value:.{digits}f}" for digits in range(decimals - 1, -1, -1))
        text = next((text for text in texts if len(text) <= MAX_SHOWN), f"{value:.3g}")
    return text.removeprefix("-") if not text.strip("-0.") else text


def decimals_shown(kind: Kind, unit: Unit) -> int:
    """Decimals with which the screens print a value."""
    match kind:
        case Kind.LENGTH:
            return 4 if unit is Unit.IN else 3
        case Kind.ANGLE:
            return 3
        case Kind.FEED | Kind.PERCENT:
            return 1
        case _:
            return 0


def plain(text: str) -> str:
    """A text with a question mark in place of each character that does not print."""
    return "".join(character if character.isprintable() else "?" for character in text)


def printable(text: str) -> str:
    """Somebody's text as it may stand in a message: on one line, short, and nothing that moves a terminal's cursor."""
    whole = plain(text.strip())
    return whole if len(whole) <= MAX_QUOTED else f"{whole[:MAX_QUOTED]}..."


def sentence(finding: Finding, unit: Unit) -> str:
    """A finding's text with its lengths filled in, in program units."""
    known: dict[str, float] = {str(index): length for index, length in enumerate(finding.lengths)}
    if finding.value is not None:
        known["value"] = finding.value
    if finding.at is not None:
        known["x"], known["y"] = finding.at
    if finding.area is not None:
        # a length as well once it is divided by an inch
        known["area"] = from_mm(finding.area, unit)

    def fill(place: re.Match[str]) -> str:
        length, other = known.get(place[1]), known.get(place[2] or "")
        if length is None or (place[2] and other is None):
            return place[0]
        here = from_mm(length, unit)
        if other is None or abs(length - other) <= ROUNDING:
            return show(here, Kind.LENGTH, unit)
        return _telling_digits(here, from_mm(other, unit), unit)

    return re.sub(r"\{(\w+)(?:~(\w+))?\}", fill, finding.text)


def segment_name(number: float) -> str:
    """`segment 3`, or `corner 3-4` for the corner arc after segment 3, which has the number 3.5."""
    return f"segment {number:g}" if number == int(number) else f"corner {int(number)}-{int(number) + 1}"


def located_sentence(finding: Finding, unit: Unit) -> str:
    """A finding's sentence after its block and its segment: `Block 1, segment 2: ...`."""
    parts = [] if finding.block is None else [f"block {finding.block}"]
    if finding.segment is not None:
        parts.append(segment_name(finding.segment) if finding.segment else "START")
    where = ", ".join(parts)
    return f"{where[:1].upper()}{where[1:]}: {sentence(finding, unit)}" if where else sentence(finding, unit)


def _telling_digits(value: float, other: float, unit: Unit) -> str:
    """A length with a form's decimals, or as many more as tell how far it is from another."""
    if not (isfinite(value) and isfinite(other)):
        return show(value, Kind.LENGTH, unit)
    apart, fewest = abs(value - other), decimals_shown(Kind.LENGTH, unit)
    enough = (
        digits
        for digits in range(fewest, fewest + EXTRA_DECIMALS)
        if abs(abs(round(value, digits) - round(other, digits)) - apart) <= apart / 10.0
    )
    return f"{value:.{next(enough, fewest + EXTRA_DECIMALS)}f}"


def parse(text: str, kind: Kind, unit: Unit) -> float | Unreadable:
    """The value of an operator's text in program units (degrees for an angle), or why there is none."""
    try:
        exact = evaluate(with_decimal_point(text, unit), _scales(kind, unit), _EXPECTED.get(kind, ""))
    except CannotReadError as fault:
        return Unreadable(str(fault))
    if kind is Kind.COUNT and exact.denominator != 1:
        return Unreadable("Type a whole number, such as 2.")
    if abs(exact) * (MM_PER[unit] if kind in (Kind.LENGTH, Kind.FEED) else 1) > Fraction(LARGEST):
        return Unreadable("Too large for any machine.")
    return float(exact)


def with_decimal_point(text: str, unit: Unit) -> str:
    """A text whose one comma stands for the decimal point; CannotReadError where it may be a thousands comma.

    In inch programs that is a comma with exactly three digits behind it.
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
    """What each suffix that a kind takes multiplies by to give program units."""
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


_EXPECTED: Final[Mapping[Kind, str]] = MappingProxyType(
    {
        Kind.LENGTH: "type a number such as 2.5, 1 1/2, 2.5-.125 or 12.7mm",
        Kind.FEED: "type a number such as 20 or 500mm",
        Kind.ANGLE: "type degrees such as 22.5",
        Kind.COUNT: "type a whole number",
        Kind.PERCENT: "type a percentage such as 50",
    }
)
