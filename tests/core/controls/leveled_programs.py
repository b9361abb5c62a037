"""Programs that cut closed shapes of several sizes at several depths within one compensation, and planted errors."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Final

TOOL: Final = 6.0
"""Diameter of the tool in millimeters."""

LEAD: Final = 5.0
"""Radius of the arcs that lead in and out."""

Level = tuple[float, float]
"""Half the size of a pass, and its depth."""

INSIDE: Final[dict[str, Sequence[Level]]] = {
    "one size in steps": ((18, 4), (18, 7), (18, 10)),
    "wide, then deep": ((22, 2), (18, 10)),
    "deep, then wide": ((18, 10), (22, 2)),
    "wide in steps, then deep in steps": ((22, 1), (22, 2), (18, 4), (18, 7), (18, 10)),
    "deep in steps, then wide in steps": ((18, 4), (18, 7), (18, 10), (22, 1), (22, 2)),
    "roughed, wide, then deep": ((18, 10), (22, 2), (20, 10)),
    "three steps down": ((26, 2), (22, 5), (18, 9)),
    "three steps up": ((18, 9), (22, 5), (26, 2)),
    "opened circle by circle": ((14, 6), (18, 6), (22, 6)),
    "opened at each depth": ((14, 3), (18, 3), (14, 6), (18, 6)),
    "opened, then deep": ((18, 2), (22, 2), (14, 8)),
}
OUTSIDE: Final[dict[str, Sequence[Level]]] = {
    "foot, then neck": ((24, 10), (20, 2)),
    "neck, then foot": ((20, 2), (24, 10)),
    "cut down to size": ((28, 6), (24, 6), (20, 6)),
    "cut down at each depth": ((24, 3), (20, 3), (24, 6), (20, 6)),
    "neck in steps, then foot in steps": ((20, 1), (20, 2), (24, 5), (24, 8)),
}
SHAPES: Final = ("circle", "square")


def _around(shape: str, half: float, *, inside: bool) -> str:
    """The moves from the middle of the wall where a pass begins, back to it."""
    if shape == "circle":
        return f"G3 I{-half}" if inside else f"G2 I{half}"
    if inside:
        return f"G1 Y{half}\nX{-half}\nY{-half}\nX{half}\nY0."
    return f"G1 Y{half}\nX{half}\nY{-half}\nX{-half}\nY0."


def _pass(shape: str, half: float, depth: float, *, inside: bool, rapid: bool, wrong_lead: bool) -> str:
    """A pass from a point clear of every wall: down, in by an arc, around, out by an arc, and back to that point."""
    clear = "X0. Y0." if inside else "X-50. Y0."
    wall = half if inside else -half
    off = wall + LEAD if wrong_lead else wall - LEAD
    way = "G2" if wrong_lead else "G3"
    up = f"G0 Z5.\n{clear}\n" if rapid else f"G1 {clear}\n"
    return (
        f"G1 Z{-depth}\nX{off} Y{-LEAD}\n{way} X{wall} Y0. R{LEAD}\n{_around(shape, half, inside=inside)}\n"
        f"G3 X{wall - LEAD} Y{LEAD} R{LEAD}\n{up}"
    )


def program(
    shape: str,
    levels: Sequence[Level],
    *,
    inside: bool,
    rapid: bool = False,
    side: str = "G41",
    wrong_lead: int | None = None,
) -> str:
    """A program with all passes in one compensation; `wrong_lead` counts the pass that is entered through its wall."""
    start, first = ("X-8. Y0.", "X0. Y0.") if inside else ("X-60. Y0.", "X-50. Y0.")
    passes = "".join(
        _pass(shape, half, depth, inside=inside, rapid=rapid, wrong_lead=index == wrong_lead)
        for index, (half, depth) in enumerate(levels)
    )
    return f"G21 G17 G40 G90 F400\nT1 M6\nG0 {start} Z5.\n{side} D1 G1 {first}\n{passes}G0 Z5.\nG40 {start}\nM30\n"


CASES: Final = [
    (shape, levels, inside, bool((index + index // 2) % 2))
    for inside, kinds in ((True, INSIDE), (False, OUTSIDE))
    for index, (levels, shape) in enumerate(product(kinds.values(), SHAPES))
]
"""Programs without an error; every other one goes up between its passes."""
