"""ISO styles say, as frozen data, how each word-address control wants its own G41 and G42 programs written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import Final

from core.units import Unit


class EntryRule(Enum):
    """Where the first compensated move ends, which decides where it must start."""

    SQUARE_TO_NEXT = auto()
    """Square to the start of the next element: the entry may come from anywhere."""
    TANGENT = auto()
    """On the tangent to the tool at its position: the entry must come along the tool's path."""
    SQUARE_TO_ITSELF = auto()
    """Square to the entry itself: it must run in the direction of the next element."""


class Radius(Enum):
    """How a program states the tool radius."""

    DATA = auto()
    """`T1//.5` in the text."""
    DIAMETER = auto()
    """`D` and the tool number; `G41.1 D` and a diameter if the run leaves stock."""
    REDUCED = auto()
    """`D` and the tool number; also `I` with the stock, negative, if the run leaves any."""
    OFFSET = auto()
    """`D` and an offset number."""


@dataclass(frozen=True, slots=True)
class IsoStyle:
    """How a program is written for a word-address control."""

    inch: str
    metric: str
    """The codes of the two units."""
    safe: tuple[str, ...]
    """The lines before anything moves, with `{offset}` for the work offset and `{unit}` for the code of the unit."""
    decimals: tuple[int, int]
    """Of a length in inches and in millimeters."""
    entry: EntryRule
    radius: Radius
    absolute: bool = False
    """I and J count from the origin."""
    merged: bool = False
    """Collinear lines are written as one."""
    comments: bool = True
    """The text may hold remarks."""
    length: bool = True
    """G43 H names the tool length."""
    spaced: bool = True
    """Spaces separate words."""
    corner_code: str = ""
    """Sets how the tool goes around outside corners; empty if the control has one way only."""
    head: tuple[str, ...] = ()
    tail: tuple[str, ...] = ()
    """The lines before and after the whole text."""

    @property
    def writes_work_offset(self) -> bool:
        """True if the program selects a work offset."""
        return any("{offset}" in line for line in self.safe)

    def digits(self, unit: Unit) -> int:
        """Return the decimals of a length."""
        return self.decimals[0 if unit is Unit.IN else 1]


FREE_ENTRY: Final = IsoStyle(
    "G20", "G21", ("G17 {unit} G40 G49 {offset} G50 G69 G90",), (6, 5), EntryRule.SQUARE_TO_NEXT, Radius.REDUCED
)
"""A style whose leads may come from anywhere."""

_NINE_SERIES: Final = IsoStyle(
    "G20", "G21", ("G17 {unit} G40 G49 {offset} G80 G90 G94",), (4, 3), EntryRule.SQUARE_TO_NEXT, Radius.OFFSET
)
_FANUC: Final = replace(_NINE_SERIES, head=("%", "O0001"), tail=("%",))

STYLE_OF_CONTROL: Final[Mapping[str, IsoStyle]] = {
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
"""The styles, by a control's full name."""
