"""A run is what is typed of its elements; a branch of its solution holds what is known of each element and joint.

A branch derives what needs no choice (CALCULATED_RUNS.md, section 2, with anchors).  Joint k lies before element k;
joint 0 is the run's start.  Each value is None until known, and never changes later.  If a value can be derived in two
ways, `answer_check` finds at the end, by walking the chain, whether they agree.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, hypot, pi, sin, tau
from typing import Final, NamedTuple

from core.finding import Finding
from core.geometry.oriented import Circle, Locus, OrientedLine, direction, line_through, meeting, normal, touch_point
from core.geometry.piece import Point, Turn
from core.tolerance import ARC_RADII, JOINED, MIN_INDEPENDENT_SINE

MAX_RUN_LENGTH: Final = 12
"""The largest number of LINEs and ARCs that are solved together."""

POINT_FIELDS: Final = frozenset(("point_x", "point_y", "point_dist"))
"""The data that count as one together, as far as they give a point."""


Parallel = int | OrientedLine
"""PARALLEL TO: the index of the line in the run, or the line itself if it lies before the run."""


@dataclass(frozen=True)
class Element:
    """A LINE (`turn` NONE) or an ARC of a run.

    `typed` are its data by name.  `link` is the angle from the final heading of the element before to its own initial
    heading: 0 for TANGENT, None if nothing is typed about it.
    """

    number: int
    turn: Turn
    typed: tuple[tuple[str, float], ...] = ()
    link: float | None = None
    parallel: Parallel | None = None

    @cached_property
    def known(self) -> Mapping[str, float]:
        """The data by name, in millimeters and radians; names of relative data end in `_inc`."""
        return dict(self.typed)

    @property
    def point(self) -> Point | None:
        """The point that the element's line passes at DISTANCE, or that its circle passes through."""
        if "point_x" in self.known and "point_y" in self.known:
            return self.known["point_x"], self.known["point_y"]
        return None

    @property
    def missing(self) -> int:
        """The number of values that it needs beside its start and its typed data; negative if more are typed."""
        relations = sum(value is not None for value in (self.point, self.parallel, self.link))
        return (3 if self.turn else 2) - len(self.known.keys() - POINT_FIELDS) - relations


@dataclass(frozen=True)
class Run:
    """Elements that are solved together, from `start`, after a piece that ends in direction `heading`."""

    start: Point
    heading: float | None
    elements: tuple[Element, ...]

    @property
    def indices(self) -> tuple[int, ...]:
        """The indices of its segments in the block, from 0."""
        return tuple(element.number - 1 for element in self.elements)

    @property
    def missing(self) -> int:
        """The least number of data still needed; 0 or less if there are enough."""
        return sum(element.missing for element in self.elements)

    @property
    def enough(self) -> bool:
        """True if the data may suffice: counted for the whole run, and for its last elements, however many."""
        rest = 0
        for element in reversed(self.elements):
            rest += element.missing
            if rest > 0:
                return False
        return True

    @property
    def size(self) -> float:
        """The greatest of the X and Y ranges of its typed points and its typed lengths and radii."""
        xs, ys, sizes = [self.start[0]], [self.start[1]], [0.0]
        for element in self.elements:
            known = element.known
            xs += [known[name] for name in ("x_end", "x_center", "point_x") if name in known]
            ys += [known[name] for name in ("y_end", "y_center", "point_y") if name in known]
            sizes += [known[name] for name in ("length", "radius") if name in known]
        return max(max(xs) - min(xs), max(ys) - min(ys), *sizes)


Numbers = list[float | None]

ARRIVING: Final = 1
DEPARTING: Final = -1
"""The heading at a joint in whose frame an anchor is given: that of the element before it, or of the one after."""

FULL_TURN_DOUBT: Final = 1e-6
"""Radians from 0 or a full turn within which two headings do not give a sweep: it could be either."""


class Anchor(NamedTuple):
    """A known point to which a joint is tied: the joint lies `along` and `left` of it, in the frame of its heading."""

    at: Point
    along: float
    left: float

    @property
    def tied(self) -> float:
        """The distance between the point and the joint."""
        return hypot(self.along, self.left)

    def turned(self, angle: float) -> Anchor:
        """Return the same tie in a frame rotated by `angle`, counterclockwise positive."""
        c, s = cos(angle), sin(angle)
        return Anchor(self.at, self.along * c + self.left * s, self.left * c - self.along * s)


class LineTie(NamedTuple):
    """A point that a LINE passes at a known `distance`, positive if the point is on its left."""

    point: Point
    distance: float
    end: str = ""
    """`start` or `end` if the foot of the point is that end of the LINE, else empty."""


class DeadEnd(Exception):
    """The known values contradict each other; `finding` says why."""

    def __init__(self, finding: Finding) -> None:
        super().__init__(finding.code)
        self.finding = finding


class Branch:
    """What is known of a run; `choices` are the roots taken so far, 0 or 1 each, `grazes` flags the double ones."""

    def __init__(self, run: Run) -> None:
        count = len(run.elements)
        self.run = run
        self.heading_in: Numbers = [None] * count
        self.heading_out: Numbers = [None] * count
        self.length: Numbers = [None] * count
        self.rho: Numbers = [None] * count
        self.sweep: Numbers = [None] * count
        self.offset: Numbers = [None] * count
        self.point_side: Numbers = [None] * count
        self.center_x: Numbers = [None] * count
        self.center_y: Numbers = [None] * count
        self.x: Numbers = [None] * (count + 1)
        self.y: Numbers = [None] * (count + 1)
        self.choices: tuple[int, ...] = ()
        self.grazes: tuple[bool, ...] = ()
        self.changed = True
        self._take_typed()

    def copy(self) -> Branch:
        """Return an independent branch with the same known values."""
        twin = Branch.__new__(Branch)
        for name, value in vars(self).items():
            setattr(twin, name, list(value) if isinstance(value, list) else value)
        return twin

    def chosen(self, root: int, *, grazing: bool = False) -> Branch:
        """Return a copy that takes root 0 or 1 of a step."""
        twin = self.copy()
        twin.choices = (*self.choices, root)
        twin.grazes = (*self.grazes, grazing)
        return twin

    def put(self, values: Numbers, index: int, value: float) -> None:
        """Record a value; a value that is already known stays."""
        if values[index] is None:
            values[index] = value
            self.changed = True

    def put_joint(self, index: int, at: Point) -> None:
        """Record the coordinates of a joint that are not known yet."""
        self.put(self.x, index, at[0])
        self.put(self.y, index, at[1])

    def put_center(self, index: int, at: Point) -> None:
        """Record the coordinates of a center that are not known yet."""
        self.put(self.center_x, index, at[0])
        self.put(self.center_y, index, at[1])

    def put_heading(self, index: int, heading: float) -> None:
        """Record a LINE's heading."""
        self.put(self.heading_in, index, heading)
        self.put(self.heading_out, index, heading)

    def put_heading_at(self, headings: Numbers, index: int, heading: float) -> None:
        """Record the heading at the start or at the end of an element, which is the heading of all of a LINE."""
        self.put(headings, index, heading)
        if not self.run.elements[index].turn:
            self.put_heading(index, heading)

    def joint(self, index: int) -> Point | None:
        """Return a joint, None unless both coordinates are known."""
        x, y = self.x[index], self.y[index]
        return None if x is None or y is None else (x, y)

    def center(self, index: int) -> Point | None:
        """Return a center, None unless both coordinates are known."""
        x, y = self.center_x[index], self.center_y[index]
        return None if x is None or y is None else (x, y)

    def link(self, index: int) -> float | None:
        """Return the typed angle from the heading before joint `index` to the heading after it, None if not typed."""
        return self.run.elements[index].link if 0 < index < len(self.run.elements) else None

    def line(self, index: int) -> OrientedLine | None:
        """Return the line of an element, None unless it is known."""
        heading, offset = self.heading_in[index], self.offset[index]
        return None if heading is None or offset is None else OrientedLine(heading, offset)

    @property
    def complete(self) -> bool:
        """True if every joint and every center is known."""
        joints = all(self.joint(index) is not None for index in range(len(self.x)))
        arcs = (index for index, element in enumerate(self.run.elements) if element.turn)
        return joints and all(self.center(index) is not None for index in arcs)

    def _take_typed(self) -> None:
        run = self.run
        self.put_joint(0, run.start)
        for index, element in enumerate(run.elements):
            known = element.known
            typed: tuple[tuple[Numbers, int, str], ...] = (
                (self.x, index + 1, "x_end"),
                (self.y, index + 1, "y_end"),
                (self.length, index, "length"),
                (self.center_x, index, "x_center"),
                (self.center_y, index, "y_center"),
                (self.sweep, index, "sweep"),
                (self.heading_in, index, "start_angle"),
            )
            for values, at, name in typed:
                if name in known:
                    values[at] = known[name]
            if "radius" in known:
                self.rho[index] = element.turn * known["radius"]
            if "angle" in known:
                self.put_heading(index, known["angle"])
        first = run.elements[0]
        if first.link is not None and run.heading is not None:
            self.put_heading_at(self.heading_in, 0, run.heading + first.link)

    # values that need no choice

    def settle(self) -> None:
        """Derive every value that needs no choice, until no more can be derived.

        Lines and circles come before lengths: if both give a joint, `answer_check` compares the length with it.
        """
        while self.changed:
            while self.changed:
                self.changed = False
                for index, element in enumerate(self.run.elements):
                    self._linked(index)
                    self._relative(index)
                    if element.turn:
                        self._arc(index)
                    else:
                        self._line(index)
                for index in range(1, len(self.x)):
                    self._joint(index, carried=False)
            for index in range(1, len(self.x)):
                self._joint(index, carried=True)

    def _linked(self, index: int) -> None:
        """Derive one heading at the joint before an element from the other, and a touch point if they are tangent."""
        link = self.link(index)
        if link is None:
            return
        before, after = self.heading_out[index - 1], self.heading_in[index]
        if before is not None:
            self.put_heading_at(self.heading_in, index, before + link)
        elif after is not None:
            self.put_heading_at(self.heading_out, index - 1, after - link)
        first, second = self.center(index - 1), self.center(index)
        rho, sigma = self.rho[index - 1], self.rho[index]
        tangent = link == 0.0 and self.joint(index) is None
        if tangent and first is not None and second is not None and rho is not None and sigma is not None:
            touch = touch_point(first, rho, second, sigma)
            if touch is not None:
                self.put_joint(index, touch[0])

    def _relative(self, index: int) -> None:
        """Derive points from relative coordinates, from either end; both of a center also give radius and heading."""
        known = self.run.elements[index].known
        for values, other, at, name in (
            (self.x, self.x, index + 1, "x_end_inc"),
            (self.y, self.y, index + 1, "y_end_inc"),
            (self.center_x, self.x, index, "x_center_inc"),
            (self.center_y, self.y, index, "y_center_inc"),
        ):
            if name not in known:
                continue
            start, end = other[index], values[at]
            if start is not None:
                self.put(values, at, start + known[name])
            elif end is not None:
                self.put(other, index, end - known[name])
        if "x_center_inc" in known and "y_center_inc" in known:
            dx, dy, turn = known["x_center_inc"], known["y_center_inc"], self.run.elements[index].turn
            self.put(self.rho, index, turn * hypot(dx, dy))
            self.put(self.heading_in, index, atan2(-turn * dx, turn * dy))

    def _line(self, index: int) -> None:
        if self.length[index] is not None and self.offset[index] is not None:
            return
        known = self.run.elements[index].known
        start, end, heading = self.joint(index), self.joint(index + 1), self.heading_in[index]
        if start is not None and end is not None:
            vector = (end[0] - start[0], end[1] - start[1])
            if hypot(*vector) > JOINED:
                self.put_heading(index, atan2(vector[1], vector[0]))
                self.put(self.length, index, hypot(*vector))
        if "x_end_inc" in known and "y_end_inc" in known:
            self.put(self.length, index, hypot(known["x_end_inc"], known["y_end_inc"]))
            self.put_heading(index, atan2(known["y_end_inc"], known["x_end_inc"]))
        if heading is None or self.offset[index] is not None:
            return
        nx, ny = normal(heading)
        for (x, y), distance, _ in self.line_ties(index):
            self.put(self.offset, index, nx * x + ny * y - distance)
            return

    def _arc(self, index: int) -> None:
        center, rho = self.center(index), self.rho[index]
        element = self.run.elements[index]
        known = (rho, self.sweep[index], self.heading_in[index], self.heading_out[index])
        if center is not None and None not in known:
            return
        if center is not None and rho is None:
            for point in (self.joint(index), self.joint(index + 1), element.point):
                if point is not None:
                    radius = hypot(point[0] - center[0], point[1] - center[1])
                    self.put(self.rho, index, element.turn * radius)
                    break
        self._turn(index)
        if rho is None or center is not None:
            return
        for at, heading in ((index, self.heading_in[index]), (index + 1, self.heading_out[index])):
            joint = self.joint(at)
            if joint is not None and heading is not None:
                nx, ny = normal(heading)
                self.put_center(index, (joint[0] + rho * nx, joint[1] + rho * ny))
                return

    def _turn(self, index: int) -> None:
        """Derive the third of an arc's two headings and its sweep from the other two."""
        turn = self.run.elements[index].turn
        first, last, sweep = self.heading_in[index], self.heading_out[index], self.sweep[index]
        if first is not None and last is not None:
            turned = turn * (last - first) % tau
            if FULL_TURN_DOUBT < turned < tau - FULL_TURN_DOUBT:
                self.put(self.sweep, index, turned)
        elif sweep is not None and first is not None:
            self.put(self.heading_out, index, first + turn * sweep)
        elif sweep is not None and last is not None:
            self.put(self.heading_in, index, last - turn * sweep)

    def _joint(self, index: int, *, carried: bool) -> None:
        """Derive a joint from a heading and an anchor, or from two lines; or a heading from the joint and an anchor.

        Anchors carried along by lengths give a joint only if `carried`.
        """
        last = len(self.run.elements)
        headings_known = (self.heading_out[index - 1], 0.0 if index == last else self.heading_in[index])
        if self.joint(index) is not None and None not in headings_known:
            return
        sides = [(self.heading_out, index - 1, self.anchors(index, ARRIVING))]
        if index < last:
            sides.append((self.heading_in, index, self.anchors(index, DEPARTING)))
        for headings, element, anchors in sides:
            heading = headings[element]
            for anchor in anchors:
                if anchor.tied > JOINED and (carried or anchor.along == 0.0 or heading is None):
                    self._derive_from_anchor(index, anchor, headings, element, heading)
        if self.joint(index) is None:
            self._between_lines(index)

    def _derive_from_anchor(
        self, index: int, anchor: Anchor, headings: Numbers, element: int, heading: float | None
    ) -> None:
        joint, (x, y) = self.joint(index), anchor.at
        if joint is None and heading is not None:
            (tx, ty), (nx, ny) = direction(heading), normal(heading)
            u, v = anchor.along, anchor.left
            self.put_joint(index, (x + u * tx + v * nx, y + u * ty + v * ny))
        elif joint is not None and heading is None and hypot(joint[0] - x, joint[1] - y) > JOINED:
            derived = atan2(joint[1] - y, joint[0] - x) - atan2(anchor.left, anchor.along)
            self.put_heading_at(headings, element, derived)

    def _between_lines(self, index: int) -> None:
        """Derive a joint from two lines that are not parallel."""
        lines = [locus for locus in self.loci(index) if isinstance(locus, OrientedLine)]
        for line in lines[1:]:
            met = meeting(lines[0], line)
            if met.points:
                self.put_joint(index, met.points[0])
                return

    # anchors, loci and ties

    def anchors(self, index: int, sense: int) -> Iterator[Anchor]:
        """Yield a joint's anchors in the frame of the contour's heading as it arrives there or departs from there.

        They are those of the element that ends or begins there, and the joint itself.
        """
        element = index - 1 if sense == ARRIVING else index
        if 0 <= element < len(self.run.elements):
            center, rho = self.center(element), self.rho[element]
            if center is not None and rho is not None:
                yield Anchor(center, 0.0, -rho)
            if self._shape_known(element):
                yield from self._carried(element, sense)
        joint = self.joint(index)
        if joint is not None:
            yield Anchor(joint, 0.0, 0.0)

    def _shape_known(self, element: int) -> bool:
        """True if an element's shape is known: a LINE's length, an ARC's radius and sweep."""
        if self.run.elements[element].turn:
            return self.rho[element] is not None and self.sweep[element] is not None
        return self.length[element] is not None

    def anchors_across(self, index: int, sense: int) -> Iterator[Anchor]:
        """Yield a joint's anchors from before it (ARRIVING) in the frame of the heading after it, or the other way.

        They need the typed angle between the two headings, unless the joint is known.
        """
        joint, link = self.joint(index), self.link(index)
        if joint is not None:
            yield Anchor(joint, 0.0, 0.0)
        elif link is not None:
            yield from (anchor.turned(sense * link) for anchor in self.anchors(index, sense))

    def _carried(self, element: int, sense: int) -> Iterator[Anchor]:
        """Yield the anchors of an element's start carried to its end (ARRIVING), or of its end carried back."""
        rho, turn = self.rho[element] or 0.0, self.run.elements[element].turn
        for anchor in self.anchors_across(element if sense == ARRIVING else element + 1, sense):
            if turn:
                swept = sense * turn * (self.sweep[element] or 0.0)
                at_center = Anchor(anchor.at, anchor.along, anchor.left + rho).turned(swept)
                yield Anchor(anchor.at, at_center.along, at_center.left - rho)
            else:
                yield Anchor(anchor.at, anchor.along + sense * (self.length[element] or 0.0), anchor.left)

    def line_ties(self, index: int) -> Iterator[LineTie]:
        """Yield the points A at known distances n.A - p left of a LINE."""
        element = self.run.elements[index]
        for anchor in self.anchors_across(index, ARRIVING):
            yield LineTie(anchor.at, -anchor.left, "" if anchor.along else "start")
        for anchor in self.anchors_across(index + 1, DEPARTING):
            yield LineTie(anchor.at, -anchor.left, "" if anchor.along else "end")
        point, distance = element.point, element.known.get("point_dist", 0.0)
        if point is not None and (distance == 0.0 or self.point_side[index] is not None):
            yield LineTie(point, distance * (self.point_side[index] or 1.0))

    def vector(self, element: int) -> Point | None:
        """Return the vector from an element's start to its end, if known without them; else None."""
        known = self.run.elements[element].known
        if "x_end_inc" in known and "y_end_inc" in known:
            return known["x_end_inc"], known["y_end_inc"]
        heading = self.heading_in[element]
        if heading is None or not self._shape_known(element):
            return None
        (tx, ty), (nx, ny) = direction(heading), normal(heading)
        rho, turn = self.rho[element], self.run.elements[element].turn
        if turn and rho is not None:
            ox, oy = normal(heading + turn * (self.sweep[element] or 0.0))
            return rho * (nx - ox), rho * (ny - oy)
        size = self.length[element] or 0.0
        return size * tx, size * ty

    def loci(self, index: int) -> list[Locus]:
        """Return the distinct loci of an unknown joint, from its own conditions and those of joints tied to it."""
        loci: list[Locus] = []
        for dx, dy, joint in self._tied_joints(index):
            for locus in self._loci_at(joint):
                moved = locus.shifted(-dx, -dy)
                if not any(type(other) is type(moved) and meeting(other, moved).coincident for other in loci):
                    loci.append(moved)
        return loci

    def _keeps_coordinate(self, element: int, line: OrientedLine) -> bool:
        """True if a line leaves a coordinate that both its joints have as it is, but for the rounding of numbers."""
        for coordinates, axis in ((self.x, pi / 2.0), (self.y, 0.0)):
            begin, end = coordinates[element], coordinates[element + 1]
            along = abs(sin(line.heading - axis)) < MIN_INDEPENDENT_SINE
            if along and begin is not None and end is not None and abs(end - begin) <= ARC_RADII:
                return True
        return False

    def _tied_joints(self, index: int) -> Iterator[tuple[float, float, int]]:
        """Yield (dx, dy, joint): the joint itself, and each joint at a known vector from it."""
        yield 0.0, 0.0, index
        for elements, sense in ((range(index, len(self.run.elements)), 1), (range(index - 1, -1, -1), -1)):
            dx = dy = 0.0
            for element in elements:
                vector = self.vector(element)
                if vector is None:
                    break
                dx, dy = dx + sense * vector[0], dy + sense * vector[1]
                yield dx, dy, element + 1 if sense > 0 else element

    def _loci_at(self, index: int) -> Iterator[Locus]:
        x, y = self.x[index], self.y[index]
        if x is not None:
            yield line_through((x, 0.0), -pi / 2.0)
        if y is not None:
            yield line_through((0.0, y), pi)
        elements = [element for element in (index - 1, index) if 0 <= element < len(self.run.elements)]
        for element in elements:
            line = self.line(element)
            if line is not None and not self._keeps_coordinate(element, line):
                yield line
        # circles of elements come before circles about a joint
        anchors = [*self.anchors(index, ARRIVING), *self.anchors(index, DEPARTING)] if elements else []
        for anchor in sorted(anchors, key=lambda anchor: anchor.along != 0.0):
            if anchor.tied > JOINED:
                yield Circle(anchor.at, anchor.tied)
