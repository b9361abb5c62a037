"""How each word-address control wants its own G41 and G42 programs written: frozen data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto
from types import MappingProxyType
from typing import Final

from core.units import Unit


class EntryRule(Enum):
    """Where the first compensated move ends, which decides where it must start."""

    SQUARE_TO_NEXT = auto()
    """Square to the start of the next element: it may come from anywhere."""
    TANGENT = auto()
    """On the tangent to the tool where it stands: it must come along the tool's path."""
    SQUARE_TO_ITSELF = auto()
    """Square to itself: it must run as the next element does."""


class Radius(Enum):
    """How a program says the radius."""

    DATA = auto()
    """`T1//.5` in the text."""
    DIAMETER = auto()
    """`D` and the tool's number; `G41.1 D` and a diameter where the run leaves stock."""
    REDUCED = auto()
    """`D` and the tool's number, with `I` less where the run leaves stock."""
    OFFSET = auto()
    """`D` and the number of an offset."""


@dataclass(frozen=True, slots=True)
class IsoStyle:
    """A control's way of being written to.

    `inch` and `metric` are its codes for the units, `safe` the codes that stand before anything moves; `{offset}` in
    them is the work offset.  `decimals` of inches and of millimeters.  `absolute`: I and J count from the origin.
    `merged`: lines on one line are written as one.  `comments`: the text may hold remarks.  `length`: G43 H names the
    tool's length.  `spaced`: words stand apart.  `corner_code` sets the way around outside corners, whatever was in
    force before; empty where a control has one way only.  `head` and `tail` stand around the whole text.
    """

    inch: str
    metric: str
    safe: tuple[str, ...]
    decimals: tuple[int, int]
    entry: EntryRule
    radius: Radius
    absolute: bool = False
    merged: bool = False
    comments: bool = True
    length: bool = True
    spaced: bool = True
    corner_code: str = ""
    head: tuple[str, ...] = ()
    tail: tuple[str, ...] = ()

    @property
    def writes_work_offset(self) -> bool:
        """Whether the program selects a work offset."""
        return any("{offset}" in line for line in self.safe)

    def digits(self, unit: Unit) -> int:
        """Decimals of a length."""
        return self.decimals[0 if unit is Unit.IN else 1]


FREE_ENTRY: Final = IsoStyle(
    "G20", "G21", ("G17 {unit} G40 G49 {offset} G50 G69 G90",), (6, 5), EntryRule.SQUARE_TO_NEXT, Radius.REDUCED
)
"""A style whose leads may come from anywhere."""

_NINE_SERIES: Final = IsoStyle(
    "G20", "G21", ("G17 {unit} G40 G49 {offset} G80 G90 G94",), (4, 3), EntryRule.SQUARE_TO_NEXT, Radius.OFFSET
)
_FANUC: Final = replace(_NINE_SERIES, head=("%", "O0001"), tail=("%",))

STYLES: Final[Mapping[str, IsoStyle]] = MappingProxyType(
    {
        "threeblock": IsoStyle(
            "G70",
            "G71",
            ("G17{unit}G40G90",),
            (4, 3),
            EntryRule.SQUARE_TO_NEXT,
            Radius.DATA,
            absolute=True,
            merged=True,
            comments=False,
            length=False,
            spaced=False,
        ),
        "rosettacnc:nist": replace(FREE_ENTRY, entry=EntryRule.TANGENT),
        "rosettacnc:easy": FREE_ENTRY,
        "rosettacnc:normal": replace(FREE_ENTRY, entry=EntryRule.SQUARE_TO_ITSELF),
        **{
            f"nine-series:{kind}{corners}": replace(_NINE_SERIES, corner_code=code)
            for kind in ("a", "b")
            for corners, code in (("", "G39"), ("-g39", "G39"), ("-g39.1", "G39.1"))
        },
        **{f"fanuc:{kind}{corners}": _FANUC for kind in ("a", "b", "c") for corners in ("", "-arc")},
        **{f"haas:{kind}{corners}": _FANUC for kind in ("a", "b") for corners in ("", "-yasnac")},
        "linuxcnc": IsoStyle(
            "G20",
            "G21",
            ("G17 {unit} G40 G49 {offset} G80 G90 G91.1 G94", "G64 P{rounding}"),
            (6, 5),
            EntryRule.SQUARE_TO_ITSELF,
            Radius.DIAMETER,
        ),
    }
)
"""By a control's full name."""
