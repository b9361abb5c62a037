"""Each step of this module chooses: it returns the one or two branches that continue a branch, in a fixed order.

The first of `STEPS` that applies is taken (CALCULATED_RUNS.md, section 3).  The circle of an ARC follows from three
conditions on its center (x, y) and its signed radius rho.  Each is linear, or a quadric |c - A|^2 = (rho + v)^2 + u^2,
two of which differ by a linear one: two linear conditions and one other leave one quadratic equation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from math import cos, dist, hypot, pi, sin, sqrt
from typing import Final, NamedTuple

from core.geometry.oriented import Locus, OrientedLine, direction, headings_at_distances, meeting, normal
from core.geometry.piece import Point
from core.program.solve.run import reasons
from core.program.solve.run.branch import ARRIVING, DEPARTING, Anchor, Branch, DeadEnd, LineTie
from core.tolerance import ARC_RADII, GRAZE, JOINED, MIN_INDEPENDENT_SINE

Point3 = tuple[float, float, float]
"""x, y and rho."""

Row = tuple[float, float, float, float]
"""(a, b, e, f): the condition a x + b y + e rho = f, or the number a x + b y + e rho - f."""

ORIGIN: Final = (0.0, 0.0, 0.0)
AXES: Final = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

VANISHING_COEFFICIENT: Final = 1e-9
"""A coefficient as small as this is zero, where the others of its condition are about 1."""


class Quadric(NamedTuple):
    """The condition first^2 + second^2 - less^2 = square on the numbers of three rows."""

    first: Row
    second: Row
    square: float
    less: Row = (0.0, 0.0, 0.0, 0.0)

    def at(self, point: Point3) -> float:
        """Return the left side less the right side of the equation."""
        u, v, w = (_dot(row, point) - row[3] for row in (self.first, self.second, self.less))
        return u * u + v * v - w * w - self.square

    def slope(self, point: Point3, along: Point3) -> float:
        """Return the derivative of `at` in a direction."""
        rows = (self.first, self.second, self.less)
        u, v, w = ((_dot(row, point) - row[3]) * _dot(row, along) for row in rows)
        return 2.0 * (u + v - w)

    def curvature(self, along: Point3) -> float:
        """Return half of the second derivative of `at` in a direction."""
        u, v, w = (_dot(row, along) for row in (self.first, self.second, self.less))
        return u * u + v * v - w * w


class Circles(NamedTuple):
    """The circles (center, rho) that fit, in a fixed order; `grazing` if two have merged into one."""

    fitting: tuple[tuple[Point, float], ...]
    grazing: bool = False


def circles(branch: Branch, index: int) -> Circles | None:
    """Return the circles of arc `index`; None if fewer than three conditions are independent.

    Two circles are ordered along the cross product of the two linear conditions, whose sense does not depend on the
    numbers.  If both have the same radius, they are ordered along the heading of a neighboring line instead; without
    one, the circle left of the vector between the two known points comes first.
    """
    origin = branch.run.start
    rows, quadrics = _conditions(branch, index, origin)
    cones = [quadric for quadric in quadrics if any(quadric.less)]
    rows += [_difference(cones[0], cone) for cone in cones[1:]]
    basis = _independent(rows)
    if len(basis) == 3:
        x, y, rho = _solved(basis)
        return Circles((((x + origin[0], y + origin[1]), rho),))
    if len(basis) < 2 or not quadrics:
        return None
    across = _cross(basis[0], basis[1])
    along = _moved(ORIGIN, 1.0 / hypot(*across), across)
    if abs(along[2]) < VANISHING_COEFFICIENT:
        along = _agreed_sense(branch, index, along, cones)
    # the point nearest to the origin
    at = _solved([basis[0], basis[1], (*along, 0.0)])
    for quadric in quadrics:
        roots = _roots(quadric, at, along)
        if roots is not None:
            values, grazing = roots
            points = (_moved(at, value, along) for value in values)
            return Circles(tuple(((x + origin[0], y + origin[1]), rho) for x, y, rho in points), grazing)
    return None


def _agreed_sense(branch: Branch, index: int, along: Point3, cones: list[Quadric]) -> Point3:
    """Return `along` or its opposite: the sense in which two centers with the same radius are ordered."""
    for neighbor in (index - 1, index + 1):
        if 0 <= neighbor < len(branch.run.elements) and not branch.run.elements[neighbor].turn:
            heading = branch.heading_in[neighbor]
            if heading is not None:
                tx, ty = direction(heading)
                ahead = tx * along[0] + ty * along[1]
                return along if ahead >= 0.0 else _moved(ORIGIN, -1.0, along)
    if len(cones) >= 2:
        vector = (cones[1].first[3] - cones[0].first[3], cones[1].second[3] - cones[0].second[3])
        left = vector[0] * along[1] - vector[1] * along[0]
        # left of the vector first: the sense leads from left to right
        return along if left <= 0.0 else _moved(ORIGIN, -1.0, along)
    return along


def _conditions(branch: Branch, index: int, origin: Point) -> tuple[list[Row], list[Quadric]]:
    """Return all linear and quadratic conditions, relative to `origin`."""
    rows: list[Row] = []
    quadrics: list[Quadric] = []
    x, y, rho = branch.center_x[index], branch.center_y[index], branch.rho[index]
    if x is not None:
        rows.append((1.0, 0.0, 0.0, x - origin[0]))
    if y is not None:
        rows.append((0.0, 1.0, 0.0, y - origin[1]))
    if rho is not None:
        rows.append((0.0, 0.0, 1.0, rho))
    at_start = _at_joint(branch, index, branch.heading_in[index], ARRIVING, origin)
    at_end = _at_joint(branch, index + 1, branch.heading_out[index], DEPARTING, origin)
    for condition in (*at_start, *at_end, *_swept(branch, index, origin)):
        if isinstance(condition, Quadric):
            quadrics.append(condition)
        else:
            rows.append(condition)
    point = branch.run.elements[index].point
    if point is not None:
        quadrics.append(_cone(Anchor(point, 0.0, 0.0), origin))
    return rows, quadrics


def _at_joint(
    branch: Branch, joint: int, heading: float | None, sense: int, origin: Point
) -> Iterator[Row | Quadric]:  # fmt: skip
    """Yield the conditions that the circle passes through a joint."""
    if heading is None:
        yield from (_cone(anchor, origin) for anchor in branch.anchors_across(joint, sense))
        return
    point, (nx, ny) = branch.joint(joint), normal(heading)
    # the joint is at c - rho n
    coordinates = (1.0, 0.0, -nx, 0.0), (0.0, 1.0, -ny, 0.0)
    for locus in branch.loci(joint) if point is None else (point,):
        yield from _on_locus(coordinates, locus, origin)


def _swept(branch: Branch, index: int, origin: Point) -> Iterator[Row | Quadric]:
    """Yield the conditions that SWEEP ANGLE rotates one joint into the other, if no start heading is known."""
    sweep = branch.sweep[index]
    if sweep is None or branch.heading_in[index] is not None:
        return
    angle = branch.run.elements[index].turn * sweep
    for start, end, turned in ((index, index + 1, angle), (index + 1, index, -angle)):
        first, second = branch.joint(start), branch.joint(end)
        if first is None:
            continue
        c, s = cos(turned), sin(turned)
        x, y = first[0] - origin[0], first[1] - origin[1]
        # the first joint rotated about c is at (1 - R) c + R first
        coordinates = (1.0 - c, s, 0.0, s * y - c * x), (-s, 1.0 - c, 0.0, -s * x - c * y)
        for locus in branch.loci(end) if second is None else (second,):
            yield from _on_locus(coordinates, locus, origin)
        if second is not None:
            return


def _cone(anchor: Anchor, origin: Point) -> Quadric:
    """Return the condition that ties the center to A: |c - A|^2 - (left + rho)^2 = along^2."""
    x, y = anchor.at[0] - origin[0], anchor.at[1] - origin[1]
    return Quadric((1.0, 0.0, 0.0, x), (0.0, 1.0, 0.0, y), anchor.along**2, (0.0, 0.0, 1.0, -anchor.left))


def _on_locus(coordinates: tuple[Row, Row], locus: Locus | Point, origin: Point) -> Iterator[Row | Quadric]:
    """Yield the conditions that a joint lies on the locus; the numbers of two rows are the joint's coordinates."""
    first, second = coordinates
    if isinstance(locus, OrientedLine):
        nx, ny = locus.normal
        a, b, e, f = (nx * x + ny * y for x, y in zip(first, second, strict=True))
        yield a, b, e, f + locus.offset - nx * origin[0] - ny * origin[1]
        return
    at = locus if isinstance(locus, tuple) else locus.center
    shifted = (*first[:3], first[3] + at[0] - origin[0]), (*second[:3], second[3] + at[1] - origin[1])
    if isinstance(locus, tuple):
        yield from shifted
    else:
        yield Quadric(*shifted, locus.radius**2)


def _difference(first: Quadric, second: Quadric) -> Row:
    """Return the linear condition by which two cones differ."""
    a, b, e = (first.slope(ORIGIN, axis) - second.slope(ORIGIN, axis) for axis in AXES)
    return a, b, e, second.at(ORIGIN) - first.at(ORIGIN)


def _independent(rows: list[Row]) -> list[Row]:
    """Return at most three independent rows, scaled to unit length; the clearly independent ones come first."""
    basis: list[Row] = []
    frame: list[Point3] = []
    for least in (0.02, MIN_INDEPENDENT_SINE):
        for row in rows:
            size = hypot(row[0], row[1], row[2])
            if len(basis) == 3 or size < VANISHING_COEFFICIENT:
                continue
            a, b, e, f = (value / size for value in row)
            remainder = (a, b, e)
            for axis in frame:
                remainder = _moved(remainder, -_dot((a, b, e), axis), axis)
            remaining_length = hypot(*remainder)
            if remaining_length > least:
                frame.append(_moved(ORIGIN, 1.0 / remaining_length, remainder))
                basis.append((a, b, e, f))
    return basis


def _dot(row: Row | Point3, point: Point3) -> float:
    return row[0] * point[0] + row[1] * point[1] + row[2] * point[2]


def _moved(point: Point3, by: float, along: Point3) -> Point3:
    return point[0] + by * along[0], point[1] + by * along[1], point[2] + by * along[2]


def _cross(first: Row, second: Row) -> Point3:
    (a, b, c, _), (d, e, f, _) = first, second
    return b * f - c * e, c * d - a * f, a * e - b * d


def _solved(basis: list[Row]) -> Point3:
    """Solve three linear conditions by Cramer's rule."""
    first, second, third = basis
    normals = _cross(second, third), _cross(third, first), _cross(first, second)
    determinant, point = _dot(first, normals[0]), ORIGIN
    for row, across in zip(basis, normals, strict=True):
        point = _moved(point, row[3] / determinant, across)
    return point


def _roots(quadric: Quadric, at: Point3, along: Point3) -> tuple[tuple[float, ...], bool] | None:
    """Intersect a line in (x, y, rho) with a quadric: the roots, and True if two merge; None if the line lies on it."""
    size = max(1.0, hypot(*at), abs(quadric.at(ORIGIN)) ** 0.5)
    a, b, c = quadric.curvature(along), quadric.slope(at, along), quadric.at(at)
    if abs(a) < VANISHING_COEFFICIENT:
        if abs(b) < VANISHING_COEFFICIENT * size:
            return None if abs(c) < ARC_RADII * size else ((), False)
        return (-c / b,), False
    middle, height = -b / (2.0 * a), c - b * b / (4.0 * a)
    reach = 2.0 * hypot(*_moved(at, middle, along))
    miss = height if a > 0.0 else -height
    if -GRAZE * reach <= miss <= ARC_RADII * reach:
        return (middle,), True
    if miss > 0.0:
        return (), False
    half = sqrt(-height / a)
    return (middle - half, middle + half), False


NextBranches = list[Branch]
Step = Callable[[Branch], NextBranches | None]
"""Returns the branches that follow, None if the step does not apply; raises DeadEnd if nothing fits."""


def _parallel(branch: Branch) -> NextBranches | None:
    """Choose the heading of a line PARALLEL TO a known one: the same heading first, then the opposite."""
    for index, element in enumerate(branch.run.elements):
        target = element.parallel
        if target is None:
            continue
        target_heading = target.heading if isinstance(target, OrientedLine) else branch.heading_in[target]
        own_heading = branch.heading_in[index]
        if target_heading is not None and own_heading is None:
            return _with_headings(branch, index, (target_heading, target_heading + pi))
        if target_heading is None and own_heading is not None and not isinstance(target, OrientedLine):
            return _with_headings(branch, target, (own_heading, own_heading + pi))
    return None


def _with_headings(branch: Branch, index: int, headings: tuple[float, ...], *, grazing: bool = False) -> NextBranches:
    """Return a branch for each heading that a LINE may have."""
    next_branches = [branch.chosen(root, grazing=grazing) for root in range(len(headings))]
    for next_branch, heading in zip(next_branches, headings, strict=True):
        next_branch.put_heading(index, heading)
    return next_branches


def _joint(branch: Branch) -> NextBranches | None:
    """Choose a joint among the points where two loci meet."""
    for index in range(1, len(branch.x)):
        if branch.joint(index) is not None or len(loci := branch.loci(index)) < 2:
            continue
        met = meeting(loci[0], loci[1])
        if not met.points:
            raise DeadEnd(reasons.no_meeting(branch, index, loci[0], loci[1], met.distance))
        next_branches = [branch.chosen(root, grazing=met.grazing) for root in range(len(met.points))]
        for next_branch, point in zip(next_branches, met.points, strict=True):
            next_branch.put_joint(index, point)
        return next_branches
    return None


def _arcs(branch: Branch) -> Iterator[tuple[int, Circles]]:
    """Yield the arcs whose unknown circle can be calculated, with the circles that fit."""
    for index, element in enumerate(branch.run.elements):
        if not element.turn or (branch.center(index) is not None and branch.rho[index] is not None):
            continue
        answer = circles(branch, index)
        if answer is not None:
            yield index, answer


def _single_circle(branch: Branch) -> NextBranches | None:
    """Set a circle that is the only one that fits."""
    for index, answer in _arcs(branch):
        if len(answer.fitting) == 1 and not answer.grazing:
            return _with_circles(branch, index, answer)
    return None


def _circle(branch: Branch) -> NextBranches | None:
    """Choose one of the circles that fit."""
    for index, answer in _arcs(branch):
        return _with_circles(branch, index, answer)
    return None


def _with_circles(branch: Branch, index: int, answer: Circles) -> NextBranches:
    element = branch.run.elements[index]
    if not answer.fitting:
        raise DeadEnd(reasons.no_circle(element))
    single = len(answer.fitting) == 1 and not answer.grazing
    next_branches = []
    for root, (center, rho) in enumerate(answer.fitting):
        if rho * element.turn <= JOINED:
            continue
        next_branch = branch.copy() if single else branch.chosen(root, grazing=answer.grazing)
        next_branch.put_center(index, center)
        next_branch.put(next_branch.rho, index, rho)
        next_branches.append(next_branch)
    if not next_branches:
        raise DeadEnd(reasons.wrong_sense(element))
    return next_branches


def _plain_headings(branch: Branch) -> NextBranches | None:
    """Set the headings of all LINEs from one known point or circle to another: each has one root."""
    next_branch: Branch | None = None
    for index, first, second in _tied_lines(branch):
        if (first.end, second.end) != ("start", "end"):
            continue
        headings, _ = headings_at_distances(first.point, first.distance, second.point, second.distance)
        if not headings:
            raise DeadEnd(reasons.no_tangent(branch, index, first, second))
        next_branch = next_branch or branch.copy()
        next_branch.put_heading(index, headings[0])
    return None if next_branch is None else [next_branch]


def _heading(branch: Branch) -> NextBranches | None:
    """Choose a LINE's heading from two points that it passes at known distances."""
    for index, first, second in _tied_lines(branch):
        headings, grazing = headings_at_distances(first.point, first.distance, second.point, second.distance)
        if not headings:
            raise DeadEnd(reasons.no_tangent(branch, index, first, second))
        return _with_headings(branch, index, headings, grazing=grazing)
    return None


def _tied_lines(branch: Branch) -> Iterator[tuple[int, LineTie, LineTie]]:
    """Yield the LINEs of unknown heading that pass two points at known distances, with these points."""
    for index, element in enumerate(branch.run.elements):
        if element.turn or branch.heading_in[index] is not None:
            continue
        ties = list(branch.line_ties(index))
        pairs = (pair for pair in combinations(ties, 2) if dist(pair[0].point, pair[1].point) > JOINED)
        pair = next(pairs, None)
        if pair is not None:
            yield index, *pair


def _point_side(branch: Branch) -> NextBranches | None:
    """Choose the side on which a LINE passes its POINT at DISTANCE: the point to its left first."""
    for index, element in enumerate(branch.run.elements):
        distance = element.known.get("point_dist", 0.0)
        if element.turn or element.point is None or distance == 0.0 or branch.point_side[index] is not None:
            continue
        ties = sum(1 for _ in branch.line_ties(index))
        if branch.offset[index] is not None or ties + (branch.heading_in[index] is not None) != 1:
            continue
        next_branches = [branch.chosen(root) for root in (0, 1)]
        for next_branch, side in zip(next_branches, (1.0, -1.0), strict=True):
            next_branch.put(next_branch.point_side, index, side)
        return next_branches
    return None


def _offset_side(branch: Branch) -> NextBranches | None:
    """Choose the side on which a LINE lies OFFSET from its parallel: left of the parallel first."""
    for index, element in enumerate(branch.run.elements):
        heading, offset, parallel = branch.heading_in[index], element.known.get("offset"), element.parallel
        if parallel is None or heading is None or offset is None or branch.offset[index] is not None:
            continue
        target = parallel if isinstance(parallel, OrientedLine) else branch.line(parallel)
        if target is not None:
            same = abs((heading - target.heading + pi) % (2.0 * pi) - pi) < pi / 2.0
            next_branches = [branch.chosen(0), branch.chosen(1)] if offset else [branch.copy()]
            for next_branch, side in zip(next_branches, (1.0, -1.0), strict=False):
                shifted = target.offset + side * offset
                next_branch.put(next_branch.offset, index, shifted if same else -shifted)
            return next_branches
    return None


def _along_axis(branch: Branch) -> NextBranches | None:
    """Choose the heading of a LINE whose ends have the same known X or the same known Y: to +X or +Y first."""
    for index, element in enumerate(branch.run.elements):
        if element.turn or branch.heading_in[index] is not None:
            continue
        for coordinates, heading in ((branch.y, 0.0), (branch.x, pi / 2.0)):
            start, end = coordinates[index], coordinates[index + 1]
            if start is not None and end is not None and abs(end - start) <= JOINED:
                return _with_headings(branch, index, (heading, heading + pi))
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
