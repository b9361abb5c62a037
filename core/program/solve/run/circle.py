"""This module finds the circle of an ARC from three conditions on its center (x, y) and its signed radius rho.

A typed center or radius, a known joint with a known heading, a line that the circle touches, and a line on which it
ends at a known heading give conditions linear in (x, y, rho).  A known point, a circle that it touches, and a point to
which it is tied give |c - A|^2 = (rho + v)^2 + u^2; two of these differ by a linear condition.  Two linear conditions
and one other therefore leave one quadratic equation: at most two circles.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, hypot, sin, sqrt
from typing import Final, NamedTuple

from core.geometry.oriented import Locus, OrientedLine, direction, normal
from core.geometry.piece import Point
from core.program.solve.run.branch import Anchor, Branch
from core.tolerance import ARC_RADII, GRAZE, MIN_INDEPENDENT_SINE

Row = tuple[float, float, float, float]
"""a x + b y + e rho = f."""

VANISHING_COEFFICIENT: Final = 1e-9
"""A coefficient as small as this is zero, where the others of its condition are about 1."""


class Quadric(NamedTuple):
    """square (x^2 + y^2) + rho_square rho^2 + rho (cross_x x + cross_y y) + a x + b y + e rho + rest = 0."""

    square: float
    rho_square: float
    cross_x: float
    cross_y: float
    a: float
    b: float
    e: float
    rest: float

    def at(self, x: float, y: float, rho: float) -> float:
        """Return the left side of the equation."""
        return (
            self.square * (x * x + y * y)
            + self.rho_square * rho * rho
            + rho * (self.cross_x * x + self.cross_y * y)
            + self.a * x
            + self.b * y
            + self.e * rho
            + self.rest
        )

    def curvature(self, x: float, y: float, rho: float) -> float:
        """Return the quadratic terms alone."""
        return self.square * (x * x + y * y) + self.rho_square * rho * rho + rho * (self.cross_x * x + self.cross_y * y)


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
    cones = [quadric for quadric in quadrics if quadric.rho_square < 0.0]
    rows += [_difference(cones[0], cone) for cone in cones[1:]]
    basis = _independent(rows)
    if len(basis) == 3:
        x, y, rho = _solved(basis)
        return Circles((((x + origin[0], y + origin[1]), rho),))
    if len(basis) < 2 or not quadrics:
        return None
    along = _cross(basis[0], basis[1])
    if abs(along[2]) < VANISHING_COEFFICIENT:
        along = _agreed_sense(branch, index, along, cones)
    # the point nearest to the origin
    at = _solved([basis[0], basis[1], (*along, 0.0)])
    for quadric in quadrics:
        roots = _roots(quadric, at, along)
        if roots is not None:
            values, grazing = roots
            points = (tuple(a + value * d for a, d in zip(at, along, strict=True)) for value in values)
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
                return along if ahead >= 0.0 else (-along[0], -along[1], -along[2])
    if len(cones) >= 2:
        # centers of the two cones are at (-a / 2, -b / 2)
        vector = (cones[0].a - cones[1].a, cones[0].b - cones[1].b)
        left = vector[0] * along[1] - vector[1] * along[0]
        # left of the vector first: the sense leads from left to right
        return along if left <= 0.0 else (-along[0], -along[1], -along[2])
    return along


Point3 = tuple[float, float, float]


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
    at_start = _at_joint(branch, index, branch.heading_in[index], branch.arriving_linked(index), origin)
    at_end = _at_joint(branch, index + 1, branch.heading_out[index], branch.departing_linked(index + 1), origin)
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
    branch: Branch, joint: int, heading: float | None, anchors: Iterator[Anchor], origin: Point
) -> Iterator[Row | Quadric]:  # fmt: skip
    """Yield the conditions that the circle passes through a joint."""
    if heading is None:
        yield from (_cone(anchor, origin) for anchor in anchors)
        return
    point = branch.joint(joint)
    for locus in branch.loci(joint) if point is None else (point,):
        yield from _tied(heading, locus, origin)


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
        for locus in branch.loci(end) if second is None else (second,):
            yield from _turned(first, turned, locus, origin)
        if second is not None:
            return


def _cone(anchor: Anchor, origin: Point) -> Quadric:
    """Return the condition that ties the center to A: |c - A|^2 = along^2 + (left + rho)^2."""
    x, y, u, v = anchor.at[0] - origin[0], anchor.at[1] - origin[1], anchor.along, anchor.left
    return Quadric(1.0, -1.0, 0.0, 0.0, -2.0 * x, -2.0 * y, -2.0 * v, x * x + y * y - u * u - v * v)


def _tied(heading: float, locus: Locus | Point, origin: Point) -> Iterator[Row | Quadric]:
    """Yield the conditions that the joint c - rho n, with n the normal of its heading, lies on the locus."""
    nx, ny = normal(heading)
    if isinstance(locus, tuple):
        yield 1.0, 0.0, -nx, locus[0] - origin[0]
        yield 0.0, 1.0, -ny, locus[1] - origin[1]
    elif isinstance(locus, OrientedLine):
        a, b = locus.normal
        yield a, b, -(a * nx + b * ny), locus.offset - a * origin[0] - b * origin[1]
    else:
        x, y, r = locus.center[0] - origin[0], locus.center[1] - origin[1], locus.radius
        rest = x * x + y * y - r * r
        yield Quadric(1.0, 1.0, -2.0 * nx, -2.0 * ny, -2.0 * x, -2.0 * y, 2.0 * (nx * x + ny * y), rest)


def _turned(start: Point, angle: float, locus: Locus | Point, origin: Point) -> Iterator[Row | Quadric]:
    """Yield the conditions that `start` rotated about c, (1 - R) c + R start, lies on the locus."""
    c, s = cos(angle), sin(angle)
    x, y = start[0] - origin[0], start[1] - origin[1]
    px, py = c * x - s * y, s * x + c * y
    if isinstance(locus, tuple):
        yield 1.0 - c, s, 0.0, locus[0] - origin[0] - px
        yield -s, 1.0 - c, 0.0, locus[1] - origin[1] - py
    elif isinstance(locus, OrientedLine):
        a, b = locus.normal
        offset = locus.offset - a * origin[0] - b * origin[1]
        yield a * (1.0 - c) - b * s, a * s + b * (1.0 - c), 0.0, offset - a * px - b * py
    else:
        qx, qy, r = px - (locus.center[0] - origin[0]), py - (locus.center[1] - origin[1]), locus.radius
        a, b = 2.0 * (qx * (1.0 - c) - qy * s), 2.0 * (qx * s + qy * (1.0 - c))
        yield Quadric(2.0 - 2.0 * c, 0.0, 0.0, 0.0, a, b, 0.0, qx * qx + qy * qy - r * r)


def _difference(first: Quadric, second: Quadric) -> Row:
    return first.a - second.a, first.b - second.b, first.e - second.e, second.rest - first.rest


def _independent(rows: list[Row]) -> list[Row]:
    """Return at most three independent rows, scaled to unit length; the clearly independent ones come first."""
    basis: list[Row] = []
    frame: list[Point3] = []
    for least in (0.02, MIN_INDEPENDENT_SINE):
        for row in rows:
            size = hypot(row[0], row[1], row[2])
            if len(basis) == 3 or size < VANISHING_COEFFICIENT:
                continue
            a, b, e = row[0] / size, row[1] / size, row[2] / size
            rest = (a, b, e)
            for axis in frame:
                part = a * axis[0] + b * axis[1] + e * axis[2]
                rest = (rest[0] - part * axis[0], rest[1] - part * axis[1], rest[2] - part * axis[2])
            left = hypot(*rest)
            if left > least:
                frame.append((rest[0] / left, rest[1] / left, rest[2] / left))
                basis.append((a, b, e, row[3] / size))
    return basis


def _cross(first: Row, second: Row) -> Point3:
    x = first[1] * second[2] - first[2] * second[1]
    y = first[2] * second[0] - first[0] * second[2]
    z = first[0] * second[1] - first[1] * second[0]
    size = hypot(x, y, z)
    return x / size, y / size, z / size


def _determinant(rows: list[Point3]) -> float:
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def _solved(basis: list[Row]) -> Point3:
    """Solve three linear conditions by Cramer's rule."""
    whole = _determinant([(a, b, c) for a, b, c, _ in basis])
    return (
        _determinant([(d, b, c) for _, b, c, d in basis]) / whole,
        _determinant([(a, d, c) for a, _, c, d in basis]) / whole,
        _determinant([(a, b, d) for a, b, _, d in basis]) / whole,
    )


def _roots(quadric: Quadric, at: Point3, along: Point3) -> tuple[tuple[float, ...], bool] | None:
    """Intersect a line in (x, y, rho) with a quadric: the roots, and True if two merge; None if the line lies on it."""
    size = max(1.0, hypot(*at), abs(quadric.rest) ** 0.5)
    a = quadric.curvature(*along)
    b = (
        quadric.at(*(p + d * size for p, d in zip(at, along, strict=True)))
        - quadric.at(*(p - d * size for p, d in zip(at, along, strict=True)))
    ) / (2.0 * size)
    c = quadric.at(*at)
    if abs(a) < VANISHING_COEFFICIENT:
        if abs(b) < VANISHING_COEFFICIENT * size:
            return None if abs(c) < ARC_RADII * size else ((), False)
        return (-c / b,), False
    middle, height = -b / (2.0 * a), c - b * b / (4.0 * a)
    reach = 2.0 * hypot(*(p + middle * d for p, d in zip(at, along, strict=True)))
    miss = height if a > 0.0 else -height
    if -GRAZE * reach <= miss <= ARC_RADII * reach:
        return (middle,), True
    if miss > 0.0:
        return (), False
    half = sqrt(-height / a)
    return (middle - half, middle + half), False
