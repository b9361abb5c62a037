"""Path functions run lines and arcs in Cartesian or polar coordinates, the pole CC, and RND and CHF."""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import Final

from core.controls.compensation import elements
from core.controls.compensation.elements import Element, arc_element, line_element
from core.controls.iso.arcs import ArcTolerance, NoArc, center_by_radius
from core.controls.klartext.center_path import ProgrammedStep, Role
from core.controls.klartext.corner_rounding import NO_LEAD, PendingCorner
from core.controls.klartext.m_functions import functions, leaves_workpiece
from core.controls.klartext.reader import Block
from core.controls.klartext.state import AXIS_WORDS, COMMON_WORDS, SIDE_WORDS, State, Words
from core.controls.moves import Plane, solid, without_rounding
from core.controls.transform import rotated
from core.geometry.piece import Point
from core.tolerance import JOINED

POLAR_WORDS: Final = frozenset(("PR", "PA", "IPR", "IPA", *AXIS_WORDS))
"""The words of a polar point and of the axes; of the axes only the one across the plane of CC may stand with PR, PA."""

KLARTEXT_ARC_TOLERANCE: Final = ArcTolerance(inch=0.016 / 25.4, mm=0.016, share=0.0, interpreted=False)
"""The largest difference between the radii at the start and the end of an arc about the pole."""

MAX_HELIX: Final = 5400.0
"""Most degrees that a helix may turn."""

NOT_YET: Final = "cutcomp assumes RL, RR or R0 with the tool axis alone acts in the next line of the working plane."
ONE_STRAIGHT: Final = "The end point lies straight ahead or back: no tangent arc leads there. Write L."

_LINE_WORDS: Final = COMMON_WORDS | frozenset(AXIS_WORDS)
_POLAR_LINE: Final = COMMON_WORDS | POLAR_WORDS
_CORNER_WORDS: Final = frozenset(("R", "F", "LEN"))


def line(state: State, block: Block) -> None:
    """L and LP: a straight line; a new RL, RR or R0 in it applies or cancels compensation."""
    polar = block.head == "LP"
    words = state.words(block, _POLAR_LINE if polar else _LINE_WORDS)
    if not polar and ("FMAX" in words or "MB" in words):
        state.chosen_side(words)
        if leaves_workpiece(state, words):
            return
    end = end_point(state, words, polar=polar)
    state.chosen_side(words)
    rapid, feed = state.chosen_feed(words)
    corner_rules = functions(state, words)
    end = list(without_rounding(end, state.position))
    if end == state.position:
        return
    state.moving(block, rapid=rapid, feed=feed)
    element = straight_element(state, block, end, rapid=rapid, feed=feed)
    state.position = end
    if element.start == element.end:
        state.last = None
        state.push(ProgrammedStep(Role.DEPTH, element, 0.0, state.plane))
        if state.side != state.applied and SIDE_WORDS.keys() & words.keys():
            state.log.inform("INTERPRETED", NOT_YET, block)
    elif state.side == state.applied:
        role = Role.CONTOUR if state.side else Role.FREE
        state.push(ProgrammedStep(role, element, state.offset, state.plane, corner_rules, state.feed_at))
        state.last = element
    else:
        _change_side(state, block, element)


def straight_element(state: State, block: Block, end: list[float], *, rapid: bool, feed: float) -> Element:
    """Return the line from the programmed position to another one."""
    (start, low), (goal, high) = state.flat(state.position), state.flat(end)
    return line_element(start, goal, low, high, rapid, feed, block.line, block.column)


def _change_side(state: State, block: Block, element: Element) -> None:
    """Pass on the line in which RL, RR or R0 takes effect."""
    state.last = None
    if state.side:
        state.apply(block)
        state.push(ProgrammedStep(Role.ENTRY, element, state.offset, state.plane))
    else:
        state.release()
        state.push(ProgrammedStep(Role.EXIT, element, 0.0, state.plane))


def pole(state: State, block: Block) -> None:
    """CC: the pole and circle center by two axes; arcs about it lie in the plane of these axes.

    Without words the pole is the tool's position, in the working plane.
    """
    words, known, unknown = state.words(block, frozenset(AXIS_WORDS)), set(state.known), set(state.at_machine_place)
    target = state.target(words)
    state.known, state.at_machine_place = known, unknown
    plane = _plane_of(words) if words else state.plane
    if plane is None:
        state.log.stop("ARC", "CC needs two axes, or none for where the tool stands.", block)
    state.pole, state.pole_plane = state.flat(target, plane)[0], plane


def _plane_of(words: Words) -> Plane | None:
    """Return the plane of the two axes that a block names; None if they are not two."""
    axes = {AXIS_WORDS[name][0] for name in words if name in AXIS_WORDS}
    return next((plane for plane in Plane if len(axes) == 2 and axes == set(plane.axes[:2])), None)


def pole_of(state: State, words: Words) -> Point:
    """Return the pole, which polar coordinates and C need; stop the run if there is none."""
    if state.pole is None:
        state.log.stop("ARC", "No center is programmed. Write a CC block before this one.", words.block)
    return state.pole


def polar_point(pole: Point, radius: float, angle: float) -> Point:
    """Return the point at a distance and an angle in degrees from a pole; multiples of 90 degrees are exact."""
    x, y = rotated((radius, 0.0), angle)
    return pole[0] + x, pole[1] + y


def polar_target(state: State, words: Words) -> tuple[list[float], float]:
    """Return the position that PR, PA, IPR, IPA and the word of the axis across lead to, and its angle in degrees."""
    center, plane = pole_of(state, words), state.pole_plane
    (x, y), _ = state.flat(state.position, plane)
    radius, angle = hypot(x - center[0], y - center[1]), degrees(atan2(y - center[1], x - center[0]))
    radius = _polar_value(state, words, "PR", radius)
    angle = _polar_value(state, words, "PA", angle)
    target = state.target(words)
    if state.flat(target, plane)[0] != (x, y):
        text = "A polar block takes only the axis across the plane of CC with PR and PA. Write an L or C block instead."
        state.log.stop("WORD", text, words.block)
    point = polar_point(center, radius, angle)
    if "PR" in words and "PA" in words:
        state.now_known(plane.axes[:2])
    else:
        state.known.update(plane.axes[:2])
    return list(solid(*point, state.flat(target, plane)[1], plane)), angle


def end_point(state: State, words: Words, *, polar: bool) -> list[float]:
    """Return the position that the polar words or the axis words of a block lead to."""
    return polar_target(state, words)[0] if polar else state.target(words)


def check_pole_plane(state: State, block: Block) -> None:
    """Stop the run unless the last CC lies in the working plane."""
    if state.pole_plane is not state.plane:
        text = f"{block.head} needs its CC in the working plane; the last CC names other axes. Write a new CC before."
        state.log.stop("ARC", text, block)


def _polar_value(state: State, words: Words, name: str, now: float) -> float:
    """Return PR in millimeters or PA in degrees: absolute, incremental, or unchanged."""
    read = state.length if name == "PR" else state.number
    if name in words and f"I{name}" in words:
        state.log.stop("TWICE", f"{name} and I{name} are in one block. Keep one.", words.at(f"I{name}"))
    if name in words:
        return read(words, name)
    return now + read(words, f"I{name}") if f"I{name}" in words else now


def circle(state: State, block: Block) -> None:
    """C: an arc about the pole to an end point; an end point at the start makes a full circle."""
    words = state.words(block, _LINE_WORDS | {"DR"})
    turn = _direction(state, words)
    _about_pole(state, words, state.target(words), turn)


def polar_circle(state: State, block: Block) -> None:
    """CP: an arc about the pole to an angle; with IPA it may turn more than once, and with the tool axis be a helix."""
    words = state.words(block, _POLAR_LINE | {"DR"})
    turn = _direction(state, words)
    end, angle = polar_target(state, words)
    if "IPA" in words:
        _helix(state, words, end, angle, turn)
        return
    plane = state.pole_plane
    if state.flat(end, plane)[1] != state.flat(state.position, plane)[1]:
        state.log.stop("ARC", "A helix needs its angle as IPA. Write IPA with the same sign as DR.", block)
    _about_pole(state, words, end, turn)


def radius_arc(state: State, block: Block) -> None:
    """CR: an arc by its radius; R above 0 makes at most half a circle, R below 0 at least half."""
    words = state.words(block, _LINE_WORDS | {"DR", "R"})
    turn = _direction(state, words)
    if "R" not in words:
        state.log.stop("ARC", "CR needs a radius. Write R+ or R- with a number.", block)
    plane = _radius_plane(state, words)
    end, radius = state.target(words), state.length(words, "R")
    if abs(radius) <= JOINED:
        state.log.stop("ARC", "An arc cannot have the radius 0.", block.at("R"))
    center = center_by_radius(state.flat(state.position, plane)[0], state.flat(end, plane)[0], radius, turn)
    if isinstance(center, NoArc):
        state.log.stop("ARC", center.text, block.at("R"), lengths=center.lengths)
    _arc_to(state, words, end, center, turn, plane)


def _radius_plane(state: State, words: Words) -> Plane:
    """Return the plane of a CR block: that of its two axes, or the working plane if it names one axis of that."""
    axes = {AXIS_WORDS[name][0] for name in words if name in AXIS_WORDS}
    plane = _plane_of(words)
    one_of_two = axes <= set(state.plane.axes[:2]) and (state.pole is None or state.pole_plane is state.plane)
    if plane is None and (len(axes) > 2 or not one_of_two):
        text = "The plane of this arc is not clear. Write both axes of its plane, and no third one."
        state.log.stop("ARC", text, words.block)
    return plane or state.plane


def tangent_arc(state: State, block: Block) -> None:
    """CT and CTP: an arc tangent to the contour element before it."""
    polar = block.head == "CTP"
    words = state.words(block, _POLAR_LINE if polar else _LINE_WORDS)
    if polar:
        check_pole_plane(state, block)
    end = end_point(state, words, polar=polar)
    if state.last is None or state.waiting.pending:
        text = "A tangent arc needs a contour element directly before it. Write an L or C block first, or use CR."
        state.log.stop("HE6", text, block)
    start, goal, direction = state.flat(state.position)[0], state.flat(end)[0], state.last.end_direction
    dx, dy = goal[0] - start[0], goal[1] - start[1]
    cross, chord = direction[0] * dy - direction[1] * dx, hypot(dx, dy)
    if chord <= JOINED:
        state.log.stop("ARC", "The end point must differ from the start point.", block)
    if abs(cross) <= chord * elements.SAME_DIRECTION:
        state.log.stop("ARC", ONE_STRAIGHT, block)
    center = elements.offset_point(start, direction, chord * chord / (2.0 * cross))
    _arc_to(state, words, end, center, 1 if cross > 0.0 else -1, state.plane)


def _about_pole(state: State, words: Words, end: list[float], turn: int) -> None:
    _arc_to(state, words, end, _center(state, words, end), turn, state.pole_plane)


def _center(state: State, words: Words, end: list[float]) -> Point:
    """Return the pole as the center of an arc to `end`; stop the run if the radii differ too much."""
    center = pole_of(state, words)
    start, goal = (state.flat(position, state.pole_plane)[0] for position in (state.position, end))
    if refused := KLARTEXT_ARC_TOLERANCE.refused(start, goal, center, state.unit):
        state.log.stop("ARC", refused.text, words.block, lengths=refused.lengths)
    return center


def _helix(state: State, words: Words, end: list[float], angle: float, turn: int) -> None:
    """Run the full turns of a CP block with IPA, and the rest."""
    swept = state.number(words, "IPA")
    if swept * turn <= 0.0 or abs(swept) > MAX_HELIX:
        state.log.stop("ARC", f"IPA needs the same sign as DR and at most {MAX_HELIX:.0f} degrees.", words.at("IPA"))
    plane = state.pole_plane
    center, (goal, high) = _center(state, words, end), state.flat(end, plane)
    start, low = state.flat(state.position, plane)
    size = hypot(start[0] - center[0], start[1] - center[1])
    whole, rest = divmod(abs(swept), 360.0)
    share = 360.0 / abs(swept)
    for count in range(1, int(whole) + 1):
        height = high if not rest and count == whole else low + (high - low) * share * count
        _arc_to(state, words, list(solid(*start, height, plane)), center, turn, plane, helix=True)
    if rest:
        goal = goal if "PR" in words or "IPR" in words else polar_point(center, size, angle)
        _arc_to(state, words, list(solid(*goal, high, plane)), center, turn, plane, helix=True)


def _direction(state: State, words: Words) -> int:
    sign = words.pop("DR", None)
    if sign not in ("+", "-"):
        text = "The direction is missing. Write DR+ (counterclockwise) or DR- (clockwise)."
        state.log.stop("ARC", text, words.at("" if sign is None else "DR"))
    return 1 if sign == "+" else -1


def _arc_to(
    state: State, words: Words, end: list[float], center: Point, turn: int, plane: Plane, *, helix: bool = False
) -> None:  # fmt: skip
    """Run an arc in a plane to `end` about `center`, as the next contour element."""
    state.chosen_side(words)
    rapid, feed = state.chosen_feed(words)
    corner_rules = functions(state, words)
    start, low = state.flat(state.position, plane)
    goal, high = state.flat(end, plane)
    if high != low and not helix:
        what = "The tool axis" if plane is state.plane else "The axis across its plane"
        state.log.stop("ARC", f"{what} cannot move in this arc. Write a helix as CP with IPA.", words.block)
    if state.side != state.applied:
        verb = "applied" if state.side else "canceled"
        text = f"Compensation cannot be {verb} in an arc. Do it in an L block before or after it, or with APPR and DEP."
        state.log.stop("HE2", text, words.at(("R0", "RL", "RR")[state.side]))
    if plane is not state.plane and state.applied:
        text = "An arc outside the working plane is not compensated. Cancel compensation in an L block with R0 before."
        state.log.stop("HE2", text, words.block)
    if plane is not state.plane and state.transform:
        text = "cutcomp mirrors and turns only arcs in the working plane. Write out the moves."
        state.log.stop("BEYOND", text, words.block)
    state.moving(words.block, rapid=rapid, feed=feed)
    if hypot(goal[0] - start[0], goal[1] - start[1]) <= JOINED:
        goal = start
    element = arc_element(start, goal, center, turn, low, high, feed, words.block.line, words.block.column)
    element = element._replace(rapid=rapid)
    state.position = end
    role = Role.CONTOUR if state.applied else Role.FREE
    state.push(ProgrammedStep(role, element, state.offset, plane, corner_rules, state.feed_at))
    state.last = element if plane is state.plane else None


def corner(state: State, block: Block) -> None:
    """RND R and CHF: a rounding or chamfer between the element before and the one after."""
    start, body = block.column, block.body.lstrip()
    if body and body[0] in "+-.0123456789Q":  # the size has no name, as in CHF 5
        block = block._replace(body=f"LEN{body}", begin=block.begin + len(block.body) - len(body) - 3)
    words = state.words(block, _CORNER_WORDS)
    name = next((word for word in ("R", "LEN") if word in words), "")
    if not name:
        state.log.stop("CORNER", f"{block.head} needs its size. Write RND R5 or CHF 5.", block)
    size = state.length(words, name)
    if size <= JOINED:
        state.log.stop("CORNER", f"The size of {block.head} must be above 0.", block)
    if block.head == "RND" and state.waiting.step is None and state.side:
        state.log.stop("BEYOND", NO_LEAD, block)
    if state.waiting.step is None or state.last is None or state.waiting.pending:
        state.log.stop("CORNER", "RND and CHF need a contour element directly before them. Move the block.", block)
    feed = state.length(words, "F") if "F" in words else state.feed
    state.waiting.pending = PendingCorner(block.line, start, size, block.head == "RND", feed)
