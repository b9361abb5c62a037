"""Each step of this module chooses: it returns the one or two branches that continue a branch, in a fixed order.

The first step that applies is taken, in this order: PARALLEL, a circle without a choice, a LINE's heading, a joint, a
circle, the side of a POINT at DISTANCE, the side of an OFFSET, a LINE along an axis.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import dist, pi
from typing import Final

from core.geometry.oriented import OrientedLine, headings_at_distances, meeting
from core.geometry.piece import Point
from core.program.solve.run import reasons
from core.program.solve.run.branch import Branch, DeadEnd
from core.program.solve.run.circle import Circles, circles
from core.tolerance import JOINED

Ways = list[Branch]
Step = Callable[[Branch], Ways | None]
"""Returns the branches that follow, None if the step does not apply; raises DeadEnd if nothing fits."""


def next_branches(branch: Branch) -> Ways | None:
    """Return the branches of the first step that applies; None if no step does."""
    for step in STEPS:
        ways = step(branch)
        if ways is not None:
            return ways
    return None


def _parallel(branch: Branch) -> Ways | None:
    """Choose the heading of a line PARALLEL TO a known one: the same heading first, then the opposite."""
    for index, element in enumerate(branch.run.elements):
        target = element.parallel
        if target is None:
            continue
        theirs = target.heading if isinstance(target, OrientedLine) else branch.heading_in[target]
        ours = branch.heading_in[index]
        if theirs is not None and ours is None:
            return _headed(branch, index, (theirs, theirs + pi))
        if theirs is None and ours is not None and not isinstance(target, OrientedLine):
            return _headed(branch, target, (ours, ours + pi))
    return None


def _headed(branch: Branch, index: int, headings: tuple[float, ...], *, grazing: bool = False) -> Ways:
    """Return a branch for each heading that a LINE may have."""
    ways = [branch.chosen(root, grazing=grazing) for root in range(len(headings))]
    for way, heading in zip(ways, headings, strict=True):
        way.put_heading(index, heading)
    return ways


def _joint(branch: Branch) -> Ways | None:
    """Choose a joint among the points where two loci meet."""
    for index in range(1, len(branch.x)):
        if branch.joint(index) is not None or len(loci := branch.loci(index)) < 2:
            continue
        met = meeting(loci[0], loci[1])
        if not met.points:
            raise DeadEnd(reasons.no_meeting(branch, index, loci[0], loci[1], met.apart))
        ways = [branch.chosen(root, grazing=met.grazing) for root in range(len(met.points))]
        for way, point in zip(ways, met.points, strict=True):
            way.put_joint(index, point)
        return ways
    return None


def _arcs(branch: Branch) -> Iterator[tuple[int, Circles]]:
    """Yield the arcs whose unknown circle can be calculated, with the circles that fit."""
    for index, element in enumerate(branch.run.elements):
        if not element.turn or (branch.center(index) is not None and branch.rho[index] is not None):
            continue
        answer = circles(branch, index)
        if answer is not None:
            yield index, answer


def _single_circle(branch: Branch) -> Ways | None:
    """Set a circle that is the only one that fits."""
    for index, answer in _arcs(branch):
        if len(answer.fitting) == 1 and not answer.grazing:
            return _circle_ways(branch, index, answer)
    return None


def _circle(branch: Branch) -> Ways | None:
    """Choose one of the circles that fit."""
    for index, answer in _arcs(branch):
        return _circle_ways(branch, index, answer)
    return None


def _circle_ways(branch: Branch, index: int, answer: Circles) -> Ways:
    element = branch.run.elements[index]
    if not answer.fitting:
        raise DeadEnd(reasons.no_circle(element))
    single = len(answer.fitting) == 1 and not answer.grazing
    ways = []
    for root, (center, rho) in enumerate(answer.fitting):
        if rho * element.turn <= JOINED:
            continue
        way = branch.copy() if single else branch.chosen(root, grazing=answer.grazing)
        way.put_center(index, center)
        way.put(way.rho, index, rho)
        ways.append(way)
    if not ways:
        raise DeadEnd(reasons.wrong_sense(element))
    return ways


def _plain_headings(branch: Branch) -> Ways | None:
    """Set the headings of all LINEs from one known point or circle to another: each has one root."""
    way: Branch | None = None
    for index, first, second in _tied_lines(branch):
        if (first[2], second[2]) != ("start", "end"):
            continue
        headings, _ = headings_at_distances(first[0], first[1], second[0], second[1])
        if not headings:
            raise DeadEnd(reasons.no_tangent(branch, index, first, second))
        way = way or branch.copy()
        way.put_heading(index, headings[0])
    return None if way is None else [way]


def _heading(branch: Branch) -> Ways | None:
    """Choose a LINE's heading from two points that it passes at known distances."""
    for index, first, second in _tied_lines(branch):
        headings, grazing = headings_at_distances(first[0], first[1], second[0], second[1])
        if not headings:
            raise DeadEnd(reasons.no_tangent(branch, index, first, second))
        return _headed(branch, index, headings, grazing=grazing)
    return None


Tie = tuple[Point, float, str]


def _tied_lines(branch: Branch) -> Iterator[tuple[int, Tie, Tie]]:
    """Yield the LINEs of unknown heading that pass two points at known distances, with these points."""
    for index, element in enumerate(branch.run.elements):
        if element.turn or branch.heading_in[index] is not None:
            continue
        ties = list(branch.line_ties(index))
        pairs = ((a, b) for at, a in enumerate(ties) for b in ties[at + 1 :] if dist(a[0], b[0]) > JOINED)
        pair = next(pairs, None)
        if pair is not None:
            yield index, *pair


def _point_side(branch: Branch) -> Ways | None:
    """Choose the side on which a LINE passes its POINT at DISTANCE: the point to its left first."""
    for index, element in enumerate(branch.run.elements):
        distance = element.known.get("point_dist", 0.0)
        if element.turn or element.point is None or distance == 0.0 or branch.point_side[index] is not None:
            continue
        ties = sum(1 for _ in branch.line_ties(index))
        if branch.offset[index] is not None or ties + (branch.heading_in[index] is not None) != 1:
            continue
        ways = [branch.chosen(root) for root in (0, 1)]
        for way, side in zip(ways, (1.0, -1.0), strict=True):
            way.put(way.point_side, index, side)
        return ways
    return None


def _offset_side(branch: Branch) -> Ways | None:
    """Choose the side on which a LINE lies OFFSET from its parallel: left of the parallel first."""
    for index, element in enumerate(branch.run.elements):
        heading, offset, parallel = branch.heading_in[index], element.known.get("offset"), element.parallel
        if parallel is None or heading is None or offset is None or branch.offset[index] is not None:
            continue
        target = parallel if isinstance(parallel, OrientedLine) else branch.line(parallel)
        if target is not None:
            return _offset_ways(branch, index, target, offset)
    return None


def _offset_ways(branch: Branch, index: int, target: OrientedLine, offset: float) -> Ways:
    heading = branch.heading_in[index] or 0.0
    same = abs((heading - target.heading + pi) % (2.0 * pi) - pi) < pi / 2.0
    ways = []
    for root, side in enumerate((1.0, -1.0) if offset else (1.0,)):
        way = branch.chosen(root) if offset else branch.copy()
        shifted = target.offset + side * offset
        way.put(way.offset, index, shifted if same else -shifted)
        ways.append(way)
    return ways


def _along_axis(branch: Branch) -> Ways | None:
    """Choose the heading of a LINE whose ends have the same known X or the same known Y: to +X or +Y first."""
    for index, element in enumerate(branch.run.elements):
        if element.turn or branch.heading_in[index] is not None:
            continue
        for coordinates, heading in ((branch.y, 0.0), (branch.x, pi / 2.0)):
            start, end = coordinates[index], coordinates[index + 1]
            if start is not None and end is not None and abs(end - start) <= JOINED:
                return _headed(branch, index, (heading, heading + pi))
    return None


STEPS: Final[tuple[Step, ...]] = (
    _parallel,
    _single_circle,
    _plain_headings,
    _heading,
    _joint,
    _circle,
    _point_side,
    _offset_side,
    _along_axis,
)
