"""The second tier: a run that the steps do not solve, by Newton's method from the operator's pick on the drawing.

The pick is a point near the first joint of the run that is not known (nearly always the end of its first segment).
From it a few dozen starts are laid out; each is led to an answer by damped Newton steps on the numbers of the chain
that are not known yet.  Every answer is proved by walking its chain; the one whose joint is nearest to the pick is
taken.  Nothing is taken where another pick nearby would lead elsewhere, where the answer is far from the pick, or where
the data leave the answer free to move.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import atan2, cos, dist, hypot, inf, pi, sin, sqrt, tau
from typing import Final

from core.geometry import construct
from core.geometry.piece import Arc, Line, Piece, Point
from core.program.solve.run.branch import Branch
from core.program.solve.run.element import Element, Run
from core.program.solve.run.proof import Chain, objections
from core.program.solve.run.search import SAME, Answer, search
from core.tolerance import ARC_RADII, JOINED

STARTS: Final = 48
"""Starts that are laid out about a pick."""

STEPS: Final = 30
"""Newton steps from one start."""

HOPELESS: Final = (8, 0.1)
"""A start that has come no nearer than this part of the run's size after so many steps is given up."""

CONVERGED: Final = 1e-10
"""A residual that is nothing, in parts of the run's size."""

FARTHEST_PICK: Final = 0.4
"""How far an answer's joint may be from its pick, in parts of the run's size."""

NEARBY: Final = 0.01
"""How far another pick is for which the answer must be the same, in parts of the run's size."""

SINGULAR: Final = 1e-7
"""The least pivot, in parts of the largest, of data that determine an answer."""

Numbers = list[float]


@dataclass(frozen=True, slots=True)
class _Slot:
    """One number of an element: its value, or the index of the unknown that it is."""

    value: float = 0.0
    index: int | None = None

    def of(self, numbers: Numbers) -> float:
        """The number."""
        return self.value if self.index is None else numbers[self.index]


@dataclass(frozen=True, slots=True)
class _Part:
    """An element of the chain: heading (None where it follows from the one before), size and sweep."""

    element: Element
    heading: _Slot | None
    size: _Slot
    sweep: _Slot


@dataclass(frozen=True, slots=True)
class _Walked:
    """An element of a chain: where it starts and ends, its center, and its headings."""

    start: Point
    end: Point
    center: Point
    leaving: float
    arriving: float
    size: float


class _Problem:
    """The numbers of a run that are not known, and what a choice of them misses each datum by."""

    def __init__(self, run: Run, known: Branch) -> None:
        self.run, self.count = run, 0
        self.scale = max(run.size, 1.0)
        self.angular: list[bool] = []
        self.parts = [self._part(index, element, known) for index, element in enumerate(run.elements)]

    def _slot(self, value: float | None, *, angular: bool) -> _Slot:
        if value is not None:
            return _Slot(value)
        self.angular.append(angular)
        self.count += 1
        return _Slot(index=self.count - 1)

    def _part(self, index: int, element: Element, known: Branch) -> _Part:
        follows = index > 0 and element.link is not None
        heading = known.heading_in[index]
        slot = None if follows and heading is None else self._slot(heading, angular=True)
        if not element.turn:
            return _Part(element, slot, self._slot(known.length[index], angular=False), _Slot())
        rho = known.rho[index]
        size = self._slot(None if rho is None else abs(rho), angular=False)
        return _Part(element, slot, size, self._slot(known.sweep[index], angular=True))

    def walk(self, numbers: Numbers) -> list[_Walked]:
        """The chain of these numbers."""
        at, before = self.run.start, self.run.heading or 0.0
        walked = []
        for part in self.parts:
            link, turn = part.element.link, part.element.turn
            heading = before + (link or 0.0) if part.heading is None else part.heading.of(numbers)
            size = part.size.of(numbers)
            c, s = cos(heading), sin(heading)
            if turn:
                out = heading + turn * part.sweep.of(numbers)
                center = (at[0] - turn * size * s, at[1] + turn * size * c)
                end = (center[0] + turn * size * sin(out), center[1] - turn * size * cos(out))
            else:
                out, center, end = heading, at, (at[0] + size * c, at[1] + size * s)
            walked.append(_Walked(at, end, center, heading, out, size))
            at, before = end, out
        return walked

    def residuals(self, numbers: Numbers) -> Numbers:
        """What the chain misses each datum by, in millimeters."""
        missed: Numbers = []
        walked = self.walk(numbers)
        before = self.run.heading
        for part, there in zip(self.parts, walked, strict=True):
            known = part.element.known
            if part.heading is not None and part.element.link is not None and before is not None:
                missed.append(self._angle(there.leaving - before - part.element.link))
            for name in ("angle", "start_angle"):
                if name in known and part.heading is None:
                    missed.append(self._angle(there.leaving - known[name]))
            missed += [value - known[name] for name, value in _measured(there) if name in known]
            missed += self._point(part.element, there)
            missed += self._parallel(part.element, there, walked)
            before = there.arriving
        return missed

    def _angle(self, off: float) -> float:
        return 2.0 * sin(off / 2.0) * self.scale

    def _point(self, element: Element, there: _Walked) -> Numbers:
        point = element.point
        if point is None:
            return []
        if element.turn:
            return [dist(point, there.center) - there.size]
        side = (point[1] - there.start[1]) * cos(there.leaving) - (point[0] - there.start[0]) * sin(there.leaving)
        return [abs(side) - element.known["point_dist"]] if element.known.get("point_dist") else [side]

    def _parallel(self, element: Element, there: _Walked, walked: list[_Walked]) -> Numbers:
        parallel = element.parallel
        if parallel is None:
            return []
        if parallel.line is not None:
            heading, (nx, ny) = parallel.line.heading, parallel.line.normal
            side = nx * there.start[0] + ny * there.start[1] - parallel.line.offset
        else:
            target = walked[parallel.index or 0]
            heading, at = target.leaving, target.start
            side = (there.start[1] - at[1]) * cos(heading) - (there.start[0] - at[0]) * sin(heading)
        missed = [sin(there.leaving - heading) * self.scale]
        return [*missed, abs(side) - element.known["offset"]] if "offset" in element.known else missed

    def chain(self, numbers: Numbers) -> Chain | None:
        """The pieces of a root; None where a length, a radius or a sweep is none."""
        pieces: list[Piece] = []
        start = self.run.start
        for part, there in zip(self.parts, self.walk(numbers), strict=True):
            known, turn = part.element.known, part.element.turn
            # what is typed is met to the last digit
            end = (known.get("x_end", there.end[0]), known.get("y_end", there.end[1]))
            sweep = part.sweep.of(numbers)
            if there.size <= JOINED or dist(start, end) <= JOINED or (turn and not 0.0 < sweep < tau):
                return None
            if turn:
                center = (known.get("x_center", there.center[0]), known.get("y_center", there.center[1]))
                pieces.append(construct.even_arc(start, end, center, turn))
            else:
                pieces.append(Line(start, end))
            start = end
        return Chain(tuple(pieces))


def _measured(there: _Walked) -> Iterator[tuple[str, float]]:
    (x, y), (x_end, y_end), (cx, cy) = there.start, there.end, there.center
    yield from (("x_end", x_end), ("y_end", y_end), ("x_end_inc", x_end - x), ("y_end_inc", y_end - y))
    yield from (("x_center", cx), ("y_center", cy), ("x_center_inc", cx - x), ("y_center_inc", cy - y))


@dataclass(frozen=True, slots=True)
class Picked:
    """The answers near a pick, the shortest first, and the index of the one that is taken, if any.

    `joint` is the first joint that is not known: the end of element `joint` - 1, to which the pick points.
    """

    joint: int
    answers: tuple[Answer, ...] = ()
    taken: int | None = None


@lru_cache(64)
def picked_answers(run: Run, pick: Point) -> Picked:
    """The answers to which the starts about a pick lead, and the one that is nearest to it."""
    known = search(run).known
    problem = _Problem(run, known)
    joint = next((index for index in range(1, len(run.elements) + 1) if known.joint(index) is None), 1)
    answers = _answers(problem, joint, pick)
    answers.sort(key=lambda answer: round(answer.length, 5))
    return Picked(joint, tuple(answers), _nearest(answers, joint, pick, problem.scale))


def _nearest(answers: list[Answer], joint: int, pick: Point, size: float) -> int | None:
    """The index of the answer that lies nearest to the pick and to all picks nearby."""
    if not answers:
        return None
    reach = NEARBY * size
    picks = [pick, *((pick[0] + reach * cos(turn), pick[1] + reach * sin(turn)) for turn in (0.0, pi / 2, pi, -pi / 2))]
    nearest = {min(range(len(answers)), key=lambda index: _distances(answers[index], joint, at)) for at in picks}
    taken = nearest.pop()
    far = _distances(answers[taken], joint, pick)[0] > FARTHEST_PICK * size
    return None if nearest or far else taken


def _distances(answer: Answer, joint: int, pick: Point) -> tuple[float, ...]:
    """How far a pick is from the joint; where answers share that, from the next ones, and then from the centers."""
    following = answer.pieces[joint - 1 :]
    points = [piece.end for piece in following] + [piece.center for piece in following if isinstance(piece, Arc)]
    return tuple(round(dist(point, pick), 4) for point in points)


def _answers(problem: _Problem, joint: int, pick: Point) -> list[Answer]:
    """All proved answers to which the starts lead; none where the data leave one free to move."""
    answers: list[Answer] = []
    for start in _starts(problem, joint, pick):
        root = _root(problem, start)
        chain = None if root is None else problem.chain(root)
        if root is None or chain is None or objections(problem.run, chain):
            continue
        if any(_same_ends(chain.pieces, answer.pieces) for answer in answers):
            continue
        if _free(problem, root):
            return []
        answers.append(Answer(0, chain.pieces, chain.length))
    return answers


def _same_ends(first: tuple[Piece, ...], second: tuple[Piece, ...]) -> bool:
    pairs = list(zip(first, second, strict=True))
    centers = all(dist(a.center, b.center) <= SAME * 10 for a, b in pairs if isinstance(a, Arc) and isinstance(b, Arc))
    return centers and all(dist(a.end, b.end) <= SAME * 10 for a, b in pairs)


def _starts(problem: _Problem, joint: int, pick: Point) -> Iterator[Numbers]:
    """Starts laid out so that the chain passes near the pick, the rest spread evenly (golden ratio in each number)."""
    for count in range(STARTS):
        numbers = [_spread(count, index) * tau for index in range(problem.count)]
        for index, angular in enumerate(problem.angular):
            if not angular:
                numbers[index] = problem.scale * (0.05 + 1.2 * _spread(count, index) ** 2)
        if count % 8 != 7:
            _aim(problem, joint, pick, numbers, count)
        yield numbers


def _spread(count: int, index: int) -> float:
    """A number from 0 to 1 that is spread evenly over the starts, another one for each unknown."""
    return (0.5 + (count + 1) * sqrt(_PRIMES[index % len(_PRIMES)])) % 1.0


_PRIMES: Final = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53)


def _aim(problem: _Problem, joint: int, pick: Point, numbers: Numbers, count: int) -> None:
    """Let the element before the joint end at the pick, as far as its numbers are unknown."""
    part = problem.parts[joint - 1]
    start = problem.walk(numbers)[joint - 1].start
    way = (pick[0] - start[0], pick[1] - start[1])
    chord = hypot(*way)
    turned = part.sweep.of(numbers) / 2.0 * part.element.turn
    if part.heading is not None and part.heading.index is not None:
        numbers[part.heading.index] = atan2(way[1], way[0]) - turned
    if part.size.index is not None:
        numbers[part.size.index] = chord / max(0.2, 2.0 * abs(sin(turned))) if part.element.turn else chord
    for following in problem.parts[joint:]:
        if following.heading is not None and following.heading.index is not None and count % 2:
            end = problem.run.elements[-1].known
            at = problem.walk(numbers)[problem.parts.index(following)].start
            goal = (end.get("x_end", at[0] + 1.0), end.get("y_end", at[1]))
            numbers[following.heading.index] = atan2(goal[1] - at[1], goal[0] - at[0])


def _root(problem: _Problem, numbers: Numbers) -> Numbers | None:
    """Where damped Newton steps (Levenberg and Marquardt) lead from a start, if that is a root."""
    missed = problem.residuals(numbers)
    size, damping = _norm(missed), 1e-3
    for count in range(STEPS):
        if size <= CONVERGED * problem.scale:
            return numbers
        if count >= HOPELESS[0] and size > HOPELESS[1] * problem.scale:
            return None
        slopes = _slopes(problem, numbers, missed)
        for _ in range(4):
            step = _step(slopes, missed, damping)
            tried = [value + change for value, change in zip(numbers, step, strict=True)]
            after = problem.residuals(tried)
            if _norm(after) < size:
                break
            damping *= 10.0
        else:
            break
        numbers, missed, size, damping = tried, after, _norm(after), damping * 0.1
    surplus = len(missed) > problem.count
    close = max(map(abs, missed), default=inf) <= (ARC_RADII if surplus else CONVERGED * 10.0 * problem.scale)
    return numbers if close else None


def _norm(values: Numbers) -> float:
    return sqrt(sum(value * value for value in values))


def _slopes(problem: _Problem, numbers: Numbers, missed: Numbers) -> list[Numbers]:
    """Derivatives of the residuals by each unknown (a list of columns), angles counted in the run's size."""
    columns = []
    for index, angular in enumerate(problem.angular):
        small = 1e-7 if angular else 1e-7 * problem.scale
        moved = problem.residuals([*numbers[:index], numbers[index] + small, *numbers[index + 1 :]])
        columns.append([(after - before) / small for after, before in zip(moved, missed, strict=True)])
    return columns


def _step(columns: list[Numbers], missed: Numbers, damping: float) -> Numbers:
    """The damped step that lets the residuals vanish."""
    square = [[sum(a * b for a, b in zip(one, other, strict=True)) for other in columns] for one in columns]
    right = [-sum(a * b for a, b in zip(column, missed, strict=True)) for column in columns]
    for index, row in enumerate(square):
        row[index] += damping * row[index] + 1e-300
    return _eliminated(square, right)


def _eliminated(square: list[Numbers], right: Numbers) -> Numbers:
    """Gauss's elimination with pivots by size; an unknown without a pivot stays."""
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
        rest = row[count] - sum(row[at] * values[at] for at in range(index + 1, count))
        values[index] = rest / row[index] if abs(row[index]) >= 1e-290 else 0.0
    return values


def _free(problem: _Problem, root: Numbers) -> bool:
    """Whether the data leave an answer free to move: some unknown follows from none of them (Gram and Schmidt)."""
    columns = _slopes(problem, root, problem.residuals(root))
    sizes = [problem.scale if angular else 1.0 for angular in problem.angular]
    vectors = [[value / size for value in column] for column, size in zip(columns, sizes, strict=True)]
    largest = max((_norm(vector) for vector in vectors), default=0.0)
    while vectors:
        vectors.sort(key=_norm)
        head = vectors.pop()
        length = _norm(head)
        if length <= SINGULAR * largest:
            return True
        unit = [value / length for value in head]
        for vector in vectors:
            part = sum(a * b for a, b in zip(vector, unit, strict=True))
            vector[:] = [a - part * b for a, b in zip(vector, unit, strict=True)]
    return False
