"""Corner rules say how a control joins the offsets of two elements at their corner, at its entry and at its exit.

`join` is the central algorithm: from two elements, the signed tool radius and a control's `CornerRules` it makes the
`Joint`: where the first offset ends, the moves from there, and where the second one starts.  E1 is the offset point at
the end of the first element, E2 the one at the start of the second, M the miter point, Q1 and Q2 the ends of the two
offsets extended by the radius.  Entries, exits and changes of the radius are joints too.
"""

from __future__ import annotations

from enum import Enum, auto
from math import dist, hypot, pi, radians
from typing import Final, NamedTuple

from core.controls.compensation.elements import (
    SAME_DIRECTION,
    Element,
    line_element,
    meeting,
    meetings,
    miter,
    offset_end,
    offset_start,
    point_along,
    turn_angle,
)
from core.geometry.piece import Point

SAME_POINT: Final = 1e-9
"""Millimeters within which the axes count as being at a point already."""

LEAST_INCREMENT: Final = 0.001
"""Millimeters that controls count in: points so near are one point."""

MAX_TANGENT_ANGLE: Final = radians(0.05)
"""The angle under which corners count as tangent on controls whose own limit is not known.

Centers are rounded to three digits: where an arc and a line were drawn tangent, their offsets may not meet.
"""

RIGHT_ANGLE: Final = pi / 2 + 1e-9
"""Turns up to this angle are extended to the miter point."""


class CornerKind(Enum):
    """The kind of a corner for a tool on one side of the path."""

    TANGENT = auto()
    INSIDE = auto()
    OUTSIDE = auto()


class Outside(Enum):
    """How a control goes around an outside corner."""

    ARC = auto()
    """An arc of the tool radius about the corner."""
    LINES = auto()
    """Over M up to a right angle, over Q1 and Q2 beyond it."""
    MITER_OR_ARC = auto()
    """Over M up to a right angle; beyond it by an arc between two lines, else over Q1 and Q2."""
    MITER_OR_ANY_ARC = auto()
    """Over M up to a right angle; beyond it by an arc, between lines and arcs alike."""
    MEETING = auto()
    """At the meeting of the two offsets, as at an inside corner."""


class Inside(Enum):
    """How a control joins two offsets at an inside corner."""

    NEAREST = auto()
    """At the meeting nearest the corner."""
    BY_SIDE = auto()
    """At the meeting LinuxCNC picks, by the side of the arc the tool is on; for two arcs also by the second's turn."""
    OPEN = auto()
    """No joining: straight from E1 to E2."""


class CornerRules(NamedTuple):
    """The corner rules of a control, as data.

    Corners count as tangent up to a turn of `tangent` radians, or with E1 and E2 at most `touching` millimeters apart.
    Turns within `reversal` radians of half a turn are outside corners whatever their sign; with `hooks` they are inside
    off or onto an arc that has the cutter outside it.  `rapid_straight`: a rapid goes straight to E2, not by an arc.
    """

    tangent: float = SAME_DIRECTION
    reversal: float = SAME_DIRECTION
    outside: Outside = Outside.ARC
    inside: Inside = Inside.NEAREST
    hooks: bool = False
    rapid_straight: bool = False
    touching: float = 0.0


class Joint(NamedTuple):
    """How two offsets meet: the first ends at `end`, straight moves go to each point of `through`, the second begins.

    `center`: the last move, to `start`, is an arc about this point on the tool's side.  `missed`: the offsets of an
    inside corner do not meet.
    """

    end: Point
    start: Point
    through: tuple[Point, ...] = ()
    center: Point | None = None
    corner: CornerKind = CornerKind.TANGENT
    missed: bool = False

    @property
    def moves(self) -> int:
        """The number of moves from `end` to `start`."""
        last = self.through[-1] if self.through else self.end
        apart = abs(last[0] - self.start[0]) > SAME_POINT or abs(last[1] - self.start[1]) > SAME_POINT
        return len(self.through) + (self.center is not None or apart)


def inward_turn(first: Element, second: Element, offset: float) -> float:
    """Return the turn at a corner in radians, positive toward the tool; a reversal turns away from it."""
    angle = turn_angle(first, second) * (1 if offset > 0.0 else -1)
    return -pi if abs(angle) > pi - SAME_DIRECTION else angle


def corner_kind(first: Element, second: Element, offset: float, rules: CornerRules) -> CornerKind:
    """Return the kind of the corner between two elements for a tool `offset` to their left."""
    inward = inward_turn(first, second, offset)
    if not offset:
        return CornerKind.TANGENT
    if abs(inward) > pi - rules.reversal:
        hooked = rules.hooks and (second.turn or first.turn) * offset < 0.0
        return CornerKind.INSIDE if hooked else CornerKind.OUTSIDE
    if abs(inward) <= rules.tangent or (
        rules.touching and dist(offset_end(first, offset), offset_start(second, offset)) <= rules.touching
    ):
        return CornerKind.TANGENT
    return CornerKind.INSIDE if inward > 0.0 else CornerKind.OUTSIDE


def join(first: Element, second: Element, offset: float, rules: CornerRules) -> Joint:
    """Return the joint of two consecutive elements, with the tool `offset` millimeters to their left."""
    kind = corner_kind(first, second, offset, rules)
    end, start = offset_end(first, offset), offset_start(second, offset)
    if kind is CornerKind.TANGENT:
        return Joint(end, end)
    if kind is CornerKind.INSIDE and rules.inside is Inside.OPEN:
        return Joint(end, start, corner=kind)
    if kind is CornerKind.INSIDE or rules.outside is Outside.MEETING:
        point = _meeting_point(first, second, offset, rules.inside)
        if point is None:
            return Joint(end, start, corner=kind, missed=True)
        # offsets that are nearly tangent, as those of two arcs of one circle, meet anywhere along each other
        if dist(end, start) <= LEAST_INCREMENT < dist(end, point):
            point = end
        return Joint(point, point, corner=kind)
    return _outside(first, second, offset, rules)._replace(corner=kind)


def _meeting_point(first: Element, second: Element, offset: float, rule: Inside) -> Point | None:
    if rule is not Inside.BY_SIDE:
        return meeting(first, second, offset)
    points = meetings(first, second, offset, offset)
    return points[_index_by_side(first, second, offset) if len(points) > 1 else 0] if points else None


def _index_by_side(first: Element, second: Element, offset: float) -> int:
    if not first.turn:
        return 1 if second.turn * offset > 0.0 else 0
    if not second.turn:
        return 0 if first.turn * offset > 0.0 else 1
    return 0 if (first.turn * offset > 0.0) == (second.turn > 0) else 1


def _outside(first: Element, second: Element, offset: float, rules: CornerRules) -> Joint:
    """Return the joint of an outside corner; a line itself is extended, an arc by a block of its own."""
    if rules.outside is Outside.ARC and rules.rapid_straight and second.rapid:
        start = offset_start(second, offset)
        return Joint(offset_end(first, offset), start, (start,))
    around = _around(first, second, offset, rules.outside)
    if around.center is not None:
        return around
    leaving, coming = around.through[0], around.through[-1]
    through = () if not first.turn else (leaving,)
    if second.turn and coming != leaving:
        through = (*through, coming)
    return Joint(leaving if not first.turn else around.end, around.start if second.turn else coming, through)


def _around(first: Element, second: Element, offset: float, rule: Outside) -> Joint:
    """Return the joint from E1 to E2 around an outside corner: by an arc, over M, or over Q1 and Q2."""
    end, start, angle = offset_end(first, offset), offset_start(second, offset), turn_angle(first, second)
    if rule is not Outside.ARC and abs(angle) <= RIGHT_ANGLE:
        return Joint(end, start, (miter(first.end, first.end_direction, angle, offset),))
    lines_only = not first.turn and not second.turn
    if rule in (Outside.ARC, Outside.MITER_OR_ANY_ARC) or (rule is Outside.MITER_OR_ARC and lines_only):
        return Joint(end, start, center=second.start)
    reach = abs(offset)
    extended = point_along(end, first.end_direction, reach), point_along(start, second.start_direction, -reach)
    return Joint(end, start, extended)


def entry_joint(entering: Element, first: Element, offset: float, rule: Outside, *, direct: bool) -> Joint:
    """Return the joint of the entry move and the contour's first element.

    `direct` (type A) goes straight to E2; type B goes around outside corners by `rule`.  The manual shows type B's
    polylines only in figures; they agree with those of other makers.
    """
    start = offset_start(first, offset)
    if direct or inward_turn(entering, first, offset) >= 0.0:
        return Joint(start, start)
    return _around_lead(entering, first, offset, rule)._replace(start=start)


def exit_joint(last: Element, leaving: Element, offset: float, rule: Outside) -> Joint:
    """Return type B's joint from the last element to the start of the exit move, the mirror image of the entry."""
    end = offset_end(last, offset)
    if inward_turn(last, leaving, offset) >= 0.0:
        return Joint(end, end)
    return _around_lead(last, leaving, offset, rule)._replace(end=end)


def _around_lead(first: Element, second: Element, offset: float, rule: Outside) -> Joint:
    """Return the joint around the outside corner at an entry or exit: where M is enough, it goes over M alone."""
    around = _around(first, second, offset, rule)
    if len(around.through) != 1:
        return around
    return Joint(around.through[0], around.through[0])


def offset_change_joint(first: Element, second: Element, old: float, new: float) -> Joint:
    """Return the joint at a change of radius or side: from E1 with the old offset to E2 with the new one.

    If the side changes at an arc, the joint is the meeting of the two offsets, if they meet.
    """
    if old * new < 0.0 and (first.turn or second.turn):
        point = meeting(first, second, old, new)
        if point is not None:
            return Joint(point, point)
    return Joint(offset_end(first, old), offset_start(second, new))


def vector_end(last: Element, vector: Point, offset: float) -> Point:
    """Return the end of the last element as the vector of an exit block moves it, by at most one radius.

    The line along the vector through the programmed end is offset to the tool's side; the new point is where it meets
    the offset path.  A vector along the path moves the point against the vector by the radius.
    """
    end, reach, size = offset_end(last, offset), abs(offset), hypot(*vector)
    if not size:
        return end
    towards = point_along(last.end, vector, 1.0)
    point = meeting(last, line_element(last.end, towards), offset)
    if point is None:
        return point_along(end, vector, -reach / size)
    shift = (point[0] - end[0], point[1] - end[1])
    return point_along(end, shift, 1.0 if hypot(*shift) <= reach else reach / hypot(*shift))
