"""This module solves the unknown numbers of a chain by Newton's method: the residuals of all data vanish.

A LINE has a heading and a length, an ARC a heading, a radius and a sweep.  Typed numbers, and headings that follow from
the element before, are not unknowns.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, dist, hypot, inf, sin, tau
from typing import Final, NamedTuple

from core.geometry import construct
from core.geometry.oriented import OrientedLine
from core.geometry.piece import Arc, Line, Piece, Point
from core.program.solve.reading import heading_at
from core.program.solve.run.answer_check import Pieces, objections
from core.program.solve.run.branch import Branch, Element, Run
from core.tolerance import ARC_RADII, JOINED

MAX_STEPS: Final = 30
"""Newton steps from one start."""

HOPELESS_RESIDUAL: Final = (8, 0.1)
"""Steps after which a start is given up if its residual still exceeds this fraction of the run's size."""

CONVERGED_RESIDUAL: Final = 1e-14
"""Residual, as a fraction of the run's size, at which the steps stop."""

MAX_ROOT_RESIDUAL: Final = 1e-11
"""Largest residual of a root, as a fraction of the run's size."""

Numbers = list[float]

HEADING: Final = 0
SIZE: Final = 1
SWEEP: Final = 2
"""The values of an element of the chain: its initial heading, its length or radius, and the angle an ARC turns by."""


class _Placed(NamedTuple):
    """An element placed on the chain: its start, end and center, its headings and its size."""

    start: Point
    end: Point
    center: Point
    leaving: float
    arriving: float
    size: float


class ChainProblem:
    """The unknown numbers of a run, and the residual of each datum for given numbers.

    `unknown` are the unknown values in order, each by the index of its element and HEADING, SIZE or SWEEP; a heading
    that follows from the element before is neither unknown nor known.  With `surplus` there may be no exact root: more
    data are typed than needed, or a line only grazes a circle.
    """

    def __init__(self, run: Run, known: Branch) -> None:
        self.run = run
        self.surplus = run.missing < 0 or any(known.grazes)
        self.scale = max(run.size, 1.0)
        self.known: dict[tuple[int, int], float] = {}
        self.unknown: list[tuple[int, int]] = []
        for index, element in enumerate(run.elements):
            radius = None if (rho := known.rho[index]) is None else abs(rho)
            sizes = (radius, known.sweep[index]) if element.turn else (known.length[index], 0.0)
            for quantity, value in enumerate((known.heading_in[index], *sizes)):
                if value is not None:
                    self.known[index, quantity] = value
                elif quantity != HEADING or index == 0 or element.link is None:
                    self.unknown.append((index, quantity))

    @property
    def angular(self) -> list[bool]:
        """Whether each unknown is an angle."""
        return [quantity != SIZE for _, quantity in self.unknown]

    def values(self, numbers: Numbers) -> dict[tuple[int, int], float]:
        """Return all values of the elements for these numbers of the unknowns."""
        return self.known | dict(zip(self.unknown, numbers, strict=True))

    def walk(self, numbers: Numbers) -> list[_Placed]:
        """Place the elements of the chain that has these numbers."""
        at, before = self.run.start, self.run.heading or 0.0
        values, walked = self.values(numbers), []
        for index, element in enumerate(self.run.elements):
            heading = values.get((index, HEADING), before + (element.link or 0.0))
            size, turn = values[index, SIZE], element.turn
            c, s = cos(heading), sin(heading)
            if turn:
                arriving = heading + turn * values[index, SWEEP]
                center = (at[0] - turn * size * s, at[1] + turn * size * c)
                end = (center[0] + turn * size * sin(arriving), center[1] - turn * size * cos(arriving))
            else:
                arriving, center, end = heading, at, (at[0] + size * c, at[1] + size * s)
            walked.append(_Placed(at, end, center, heading, arriving, size))
            at, before = end, arriving
        return walked

    def residuals(self, numbers: Numbers) -> Numbers:
        """Return the residuals: by how much the chain misses each datum, in millimeters."""
        residuals: Numbers = []
        walked, values = self.walk(numbers), self.values(numbers)
        before = self.run.heading
        for index, (element, placed) in enumerate(zip(self.run.elements, walked, strict=True)):
            known = element.known
            if (index, HEADING) in values:
                if element.link is not None and before is not None:
                    residuals.append(self._angle(placed.leaving - before - element.link))
            else:
                typed = (known[name] for name in ("angle", "start_angle") if name in known)
                residuals += [self._angle(placed.leaving - angle) for angle in typed]
            residuals += [value - known[name] for name, value in _measured(placed) if name in known]
            residuals += self._point(element, placed)
            residuals += self._parallel(element, placed, walked)
            before = placed.arriving
        return residuals

    def _angle(self, difference: float) -> float:
        return 2.0 * sin(difference / 2.0) * self.scale

    def _point(self, element: Element, placed: _Placed) -> Numbers:
        point = element.point
        if point is None:
            return []
        if element.turn:
            return [dist(point, placed.center) - placed.size]
        side = (point[1] - placed.start[1]) * cos(placed.leaving) - (point[0] - placed.start[0]) * sin(placed.leaving)
        return [abs(side) - element.known["point_dist"]] if element.known.get("point_dist") else [side]

    def _parallel(self, element: Element, placed: _Placed, walked: list[_Placed]) -> Numbers:
        parallel = element.parallel
        if parallel is None:
            return []
        if isinstance(parallel, OrientedLine):
            heading, (nx, ny) = parallel.heading, parallel.normal
            side = nx * placed.start[0] + ny * placed.start[1] - parallel.offset
        else:
            target = walked[parallel]
            heading, at = target.leaving, target.start
            side = (placed.start[1] - at[1]) * cos(heading) - (placed.start[0] - at[0]) * sin(heading)
        residuals = [sin(placed.leaving - heading) * self.scale]
        return [*residuals, abs(side) - element.known["offset"]] if "offset" in element.known else residuals

    def numbers_of(self, pieces: Pieces) -> Numbers:
        """Return the values of the unknowns in a chain of pieces."""
        values: dict[tuple[int, int], float] = {}
        for index, piece in enumerate(pieces):
            sizes = (piece.radius, abs(piece.sweep)) if isinstance(piece, Arc) else (piece.length, 0.0)
            for quantity, value in enumerate((heading_at(piece, piece.start), *sizes)):
                values[index, quantity] = value
        return [values[unknown] for unknown in self.unknown]

    def chain(self, numbers: Numbers) -> Pieces | None:
        """Return the pieces of a root; None if a size or chord vanishes, or a sweep is not within one turn."""
        pieces: list[Piece] = []
        start = self.run.start
        values = self.values(numbers)
        for index, (element, placed) in enumerate(zip(self.run.elements, self.walk(numbers), strict=True)):
            known, turn, sweep = element.known, element.turn, values[index, SWEEP]
            # typed coordinates are met to the last digit
            end = (known.get("x_end", placed.end[0]), known.get("y_end", placed.end[1]))
            if placed.size <= JOINED or dist(start, end) <= JOINED or (turn and not 0.0 < sweep < tau):
                return None
            if turn:
                center = (known.get("x_center", placed.center[0]), known.get("y_center", placed.center[1]))
                pieces.append(construct.exact_arc(start, end, center, turn))
            else:
                pieces.append(Line(start, end))
            start = end
        return tuple(pieces)


def _measured(placed: _Placed) -> Iterator[tuple[str, float]]:
    (x, y), (x_end, y_end), (cx, cy) = placed.start, placed.end, placed.center
    yield from (("x_end", x_end), ("y_end", y_end), ("x_end_inc", x_end - x), ("y_end_inc", y_end - y))
    yield from (("x_center", cx), ("y_center", cy), ("x_center_inc", cx - x), ("y_center_inc", cy - y))


def newton_root(problem: ChainProblem, numbers: Numbers) -> Numbers | None:
    """Return the root that damped Newton steps (Levenberg-Marquardt) reach from a start, None if they reach none."""
    residuals = problem.residuals(numbers)
    size, damping = hypot(*residuals), 1e-3
    for count in range(MAX_STEPS):
        if size <= CONVERGED_RESIDUAL * problem.scale:
            return numbers
        if count >= HOPELESS_RESIDUAL[0] and size > HOPELESS_RESIDUAL[1] * problem.scale:
            return None
        columns = slopes(problem, numbers, residuals)
        for _ in range(4):
            step = _step(columns, residuals, damping)
            trial = [value + change for value, change in zip(numbers, step, strict=True)]
            trial_residuals = problem.residuals(trial)
            if hypot(*trial_residuals) < size:
                break
            damping *= 10.0
        else:
            break
        numbers, residuals, size, damping = trial, trial_residuals, hypot(*trial_residuals), damping * 0.1
    close = ARC_RADII if problem.surplus else MAX_ROOT_RESIDUAL * problem.scale
    return numbers if max(map(abs, residuals), default=inf) <= close else None


def slopes(problem: ChainProblem, numbers: Numbers, residuals: Numbers) -> list[Numbers]:
    """Return the derivatives of the residuals, one column for each unknown, per radian or per millimeter."""
    columns = []
    for index, angular in enumerate(problem.angular):
        increment = 1e-7 if angular else 1e-7 * problem.scale
        shifted = problem.residuals([*numbers[:index], numbers[index] + increment, *numbers[index + 1 :]])
        columns.append([(after - before) / increment for after, before in zip(shifted, residuals, strict=True)])
    return columns


def _step(columns: list[Numbers], residuals: Numbers, damping: float) -> Numbers:
    """Return the damped least-squares step toward vanishing residuals."""
    square = [[sum(a * b for a, b in zip(column, other, strict=True)) for other in columns] for column in columns]
    right = [-sum(a * b for a, b in zip(column, residuals, strict=True)) for column in columns]
    for index, row in enumerate(square):
        row[index] += damping * row[index] + 1e-300
    return _eliminated(square, right)


def _eliminated(square: list[Numbers], right: Numbers) -> Numbers:
    """Solve by Gaussian elimination with partial pivoting; an unknown without a pivot does not change."""
    rows = [[*row, value] for row, value in zip(square, right, strict=True)]
    count = len(rows)
    for index in range(count):
        pivot = max(range(index, count), key=lambda row: abs(rows[row][index]))
        rows[index], rows[pivot] = rows[pivot], rows[index]
        head = rows[index]
        if abs(head[index]) < 1e-290:
            continue
        for row in rows[index + 1 :]:
            factor = row[index] / head[index]
            if factor:
                row[index:] = [a - factor * b for a, b in zip(row[index:], head[index:], strict=True)]
    values = [0.0] * count
    for index in range(count - 1, -1, -1):
        row = rows[index]
        remainder = row[count] - sum(row[at] * values[at] for at in range(index + 1, count))
        values[index] = remainder / row[index] if abs(row[index]) >= 1e-290 else 0.0
    return values


POLISHED_RESIDUAL: Final = 1e-11
"""Largest residual, as a fraction of the run's size, that needs no polishing."""


def polished(run: Run, chain: Pieces) -> Pieces:
    """Restore digits that a nearly singular step has lost; return the same pieces if that does not improve it."""
    problem = ChainProblem(run, Branch(run))
    numbers = problem.numbers_of(chain)
    if max(map(abs, problem.residuals(numbers)), default=0.0) <= POLISHED_RESIDUAL * problem.scale:
        return chain
    root = newton_root(problem, numbers)
    better = None if root is None else problem.chain(root)
    if better is None or objections(run, better):
        return chain
    near = all(dist(a.end, b.end) <= ARC_RADII for a, b in zip(chain, better, strict=True))
    return better if near else chain
