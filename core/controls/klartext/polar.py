"""Polar coordinates: distance and angle from the pole that CC sets."""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import Final

from core.controls.klartext.blocks import Block
from core.controls.klartext.rounding import polar
from core.controls.klartext.state import AXES, State, Words
from core.controls.moves import solid
from core.geometry.piece import Point

POLAR: Final = frozenset(("PR", "PA", "IPR", "IPA", *AXES))
"""The words of a polar point, and those of the axes, of which only the tool axis's may stand beside them."""


def pole_of(state: State, block: Block) -> Point:
    """The pole, without which there are no polar coordinates and no C."""
    if state.pole is None:
        state.stop("ARC", "No center is programmed; write a CC block before this one.", block)
    return state.pole


def polar_target(state: State, block: Block, words: Words) -> tuple[list[float], float]:
    """The position that PR, PA, IPR, IPA and the tool axis's word lead to, and its angle in degrees."""
    pole = pole_of(state, block)
    (x, y), _ = state.flat(state.position)
    radius, angle = hypot(x - pole[0], y - pole[1]), degrees(atan2(y - pole[1], x - pole[0]))
    radius = _value(state, block, words, "PR", radius)
    angle = _value(state, block, words, "PA", angle)
    target = state.target(block, words)
    if state.flat(target)[0] != (x, y):
        text = "In a polar block only the tool axis may stand beside PR and PA; write an L or C block instead."
        state.stop("WORD", text, block)
    point = polar(pole, radius, angle)
    state.known.update(state.plane.axes[:2])
    return list(solid(*point, state.flat(target)[1], state.plane)), angle


def _value(state: State, block: Block, words: Words, name: str, now: float) -> float:
    """PR in millimeters or PA in degrees: given, given from where the tool stands, or as it is."""
    read = state.length if name == "PR" else state.number
    if name in words and f"I{name}" in words:
        state.stop("TWICE", f"{name} and I{name} stand in one block; keep one.", block, f"I{name}")
    if name in words:
        return read(block, words, name)
    return now + read(block, words, f"I{name}") if f"I{name}" in words else now
