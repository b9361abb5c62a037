"""Circular path functions: C about the pole, CR by its radius, CT tangent to what is before, and polar CP and CTP."""

from __future__ import annotations

from math import hypot
from typing import Final

from core.controls.compensation.corners import arc_element
from core.controls.iso.arcs import NoArc, through
from core.controls.klartext.blocks import Block
from core.controls.klartext.functions import functions
from core.controls.klartext.polar import POLAR, polar_target, pole_of
from core.controls.klartext.rounding import NoRoom, polar, tangent_center
from core.controls.klartext.state import AXES, COMMON, State, Words
from core.controls.klartext.steps import Role, Step
from core.controls.moves import solid
from core.geometry.piece import Point
from core.tolerance import JOINED

RADII: Final = 0.016
"""Millimeters by which the radii at the start and the end of an arc about the pole may differ."""

MOST_TURN: Final = 5400.0
"""Degrees a helix may turn."""

_LINE: Final = COMMON | frozenset(AXES)
_ARC: Final = _LINE | {"DR"}
_POLAR: Final = COMMON | POLAR


def circle(state: State, block: Block) -> None:
    """C: an arc about the pole to an end point; an end at the start is the full circle."""
    words = state.words(block, _ARC)
    turn = _direction(state, block, words)
    _about_pole(state, block, words, state.target(block, words), turn)


def radius_arc(state: State, block: Block) -> None:
    """CR: an arc of a radius; above 0 it is at most half a circle, below 0 at least half."""
    words = state.words(block, _ARC | {"R"})
    turn = _direction(state, block, words)
    if "R" not in words:
        state.stop("ARC", "CR needs a radius; write R+ or R- with a number.", block)
    end, radius = state.target(block, words), state.length(block, words, "R")
    if abs(radius) <= JOINED:
        state.stop("ARC", "An arc cannot have the radius 0.", block, "R")
    found = through(state.flat(state.position)[0], state.flat(end)[0], radius, turn)
    if isinstance(found, NoArc):
        state.stop("ARC", found.text, block, "R", *found.lengths)
    _arc_to(state, block, words, end, found, turn)


def tangent_arc(state: State, block: Block) -> None:
    """CT: an arc tangent to the contour element before it."""
    words = state.words(block, _LINE)
    _tangent_to(state, block, words, state.target(block, words))


def polar_tangent(state: State, block: Block) -> None:
    """CTP: the same to a point given from the pole."""
    words = state.words(block, _POLAR)
    _tangent_to(state, block, words, polar_target(state, block, words)[0])


def polar_circle(state: State, block: Block) -> None:
    """CP: an arc about the pole to an angle; with IPA and the tool axis a helix of any number of turns."""
    words = state.words(block, _POLAR | {"DR"})
    turn = _direction(state, block, words)
    end, angle = polar_target(state, block, words)
    if "IPA" in words:
        _helix(state, block, words, end, angle, turn)
        return
    if state.flat(end)[1] != state.flat(state.position)[1]:
        state.stop("ARC", "A helix needs its angle as IPA; write IPA with the sign of DR.", block)
    _about_pole(state, block, words, end, turn)


def _about_pole(state: State, block: Block, words: Words, end: list[float], turn: int) -> None:
    pole = pole_of(state, block)
    _same_radius(state, block, pole, state.flat(end)[0])
    _arc_to(state, block, words, end, pole, turn)


def _same_radius(state: State, block: Block, pole: Point, goal: Point) -> None:
    start = state.flat(state.position)[0]
    first, last = hypot(start[0] - pole[0], start[1] - pole[1]), hypot(goal[0] - pole[0], goal[1] - pole[1])
    if abs(first - last) > RADII or min(first, last) <= JOINED:
        text = "The arc's radius is {0} at its start and {1} at its end; correct CC or the end point."
        state.stop("ARC", text, block, "", first, last)


def _tangent_to(state: State, block: Block, words: Words, end: list[float]) -> None:
    if state.last is None or state.blend:
        text = "A tangent arc needs a contour element directly before it; write an L or C block first, or use CR."
        state.stop("HE6", text, block)
    found = tangent_center(state.flat(state.position)[0], state.flat(end)[0], state.last.arriving)
    if isinstance(found, NoRoom):
        state.stop("ARC", found.text, block)
    _arc_to(state, block, words, end, *found)


def _helix(state: State, block: Block, words: Words, end: list[float], angle: float, turn: int) -> None:
    """The full turns of a CP block with IPA, and the rest."""
    swept = state.number(block, words, "IPA")
    if swept * turn <= 0.0 or abs(swept) > MOST_TURN:
        text = "IPA and DR must have one sign, and IPA lies within 5400 degrees; correct one of them."
        state.stop("ARC", text, block, "IPA")
    pole, goal = pole_of(state, block), state.flat(end)[0]
    _same_radius(state, block, pole, goal)
    start, low = state.flat(state.position)
    high, size = state.flat(end)[1], hypot(start[0] - pole[0], start[1] - pole[1])
    share = 360.0 / abs(swept)
    whole, rest = divmod(abs(swept), 360.0)
    for count in range(1, int(whole) + 1):
        height = high if not rest and count == whole else low + (high - low) * share * count
        _arc_to(state, block, words, list(solid(*start, height, state.plane)), pole, turn, helix=True)
    if rest:
        goal = goal if "PR" in words or "IPR" in words else polar(pole, size, angle)
        _arc_to(state, block, words, list(solid(*goal, high, state.plane)), pole, turn, helix=True)


def _direction(state: State, block: Block, words: Words) -> int:
    sign = words.pop("DR", None)
    if sign not in ("+", "-"):
        text = "The direction is missing; write DR+ (counter-clockwise) or DR- (clockwise)."
        state.stop("ARC", text, block, "" if sign is None else "DR")
    return 1 if sign == "+" else -1


def _arc_to(
    state: State, block: Block, words: Words, end: list[float], middle: Point, turn: int, *, helix: bool = False
) -> None:  # fmt: skip
    """An arc to `end` about `middle`, as the next contour element."""
    state.chosen_side(block, words)
    rapid, feed = state.chosen_feed(block, words)
    corner = functions(state, block, words)
    start, low = state.flat(state.position)
    goal, high = state.flat(end)
    if high != low and not helix:
        state.stop("ARC", "The tool axis cannot move in this arc; write a helix as CP with IPA.", block)
    if state.side != state.applied:
        _refuse_change(state, block)
    state.moving(block, rapid=rapid, feed=feed)
    if hypot(goal[0] - start[0], goal[1] - start[1]) <= JOINED:
        goal = start
    element = arc_element(start, goal, middle, turn, low, high, feed, block.line, block.column - len(block.head))
    if rapid:
        element = element._replace(rapid=True)
    state.position = end
    role = Role.CONTOUR if state.applied else Role.FREE
    state.push(Step(role, element, state.offset, state.plane, corner, state.speed))
    state.last = element


def _refuse_change(state: State, block: Block) -> None:
    verb = "applied" if state.side else "canceled"
    text = f"Compensation cannot be {verb} in an arc; do it in an L block before or behind, or with APPR and DEP."
    state.stop("HE2", text, block, ("R0", "RL", "RR")[state.side])
