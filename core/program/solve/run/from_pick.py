"""This module finds the answers near the operator's pick, for a run that `steps` do not solve, by Newton's method.

The pick is a point near the first unknown joint of the run, nearly always the end of its first segment.  The answer
nearest to it is taken, or none (CALCULATED_RUNS.md, section 7).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import atan2, cos, dist, hypot, pi, sin, sqrt, tau
from typing import Final

from core.geometry.piece import Arc, Point
from core.program.solve.run.answer_check import objections
from core.program.solve.run.branch import Run
from core.program.solve.run.newton import HEADING, SIZE, SWEEP, ChainProblem, Numbers, newton_root, slopes
from core.program.solve.run.search import MAX_SAME_DISTANCE, Answer, same_pieces, search

STARTS_PER_PICK: Final = 48

FARTHEST_PICK: Final = 0.4
"""Largest distance of an answer's joint from its pick, as a fraction of the run's size."""

NEARBY_SHARE: Final = 0.01
"""Distance of other picks that must give the same answer, as a fraction of the run's size."""

SINGULAR_PIVOT: Final = 1e-7
"""Smallest pivot, as a fraction of the largest, for data that determine an answer."""


@dataclass(frozen=True, slots=True)
class Picked:
    """The answers near a pick, the shortest first, and the index of the one that is taken, if any.

    `joint` is the first unknown joint, to which the pick refers: the end of element `joint` - 1.
    """

    joint: int
    answers: tuple[Answer, ...] = ()
    taken: int | None = None


@lru_cache(64)
def picked_answers(run: Run, pick: Point) -> Picked:
    """Return the answers that the starts about a pick lead to, and the one nearest to the pick."""
    known = search(run).known
    problem = ChainProblem(run, known)
    joint = next((index for index in range(1, len(run.elements) + 1) if known.joint(index) is None), 1)
    answers = _answers(problem, joint, pick)
    answers.sort(key=lambda answer: round(answer.length, 5))
    return Picked(joint, tuple(answers), _nearest(answers, joint, pick, problem.scale))


def _nearest(answers: list[Answer], joint: int, pick: Point, size: float) -> int | None:
    """Return the index of the answer nearest to the pick and to all picks nearby; None if they differ or it is far."""
    if not answers:
        return None
    reach = NEARBY_SHARE * size
    picks = [pick, *((pick[0] + reach * cos(turn), pick[1] + reach * sin(turn)) for turn in (0.0, pi / 2, pi, -pi / 2))]
    nearest = {min(range(len(answers)), key=lambda index: _distances(answers[index], joint, at)) for at in picks}
    taken = nearest.pop()
    far = _distances(answers[taken], joint, pick)[0] > FARTHEST_PICK * size
    return None if nearest or far else taken


def _distances(answer: Answer, joint: int, pick: Point) -> tuple[float, ...]:
    """Return the distances of a pick from the joint, from the later joints and from the centers, to break ties."""
    following = answer.pieces[joint - 1 :]
    points = [piece.end for piece in following] + [piece.center for piece in following if isinstance(piece, Arc)]
    return tuple(round(dist(point, pick), 4) for point in points)


def _answers(problem: ChainProblem, joint: int, pick: Point) -> list[Answer]:
    """Return all checked answers that the starts lead to; none if the data leave an answer free to move."""
    answers: list[Answer] = []
    for start in _starts(problem, joint, pick):
        root = newton_root(problem, start)
        chain = None if root is None else problem.chain(root)
        if root is None or chain is None or objections(problem.run, chain):
            continue
        if any(same_pieces(chain, answer.pieces, MAX_SAME_DISTANCE * 10) for answer in answers):
            continue
        if _free(problem, root):
            return []
        answers.append(Answer(0, chain))
    return answers


def _starts(problem: ChainProblem, joint: int, pick: Point) -> Iterator[Numbers]:
    """Yield starts, most of which pass near the pick; the other numbers spread evenly (square roots of primes)."""
    for count in range(STARTS_PER_PICK):
        spread = ((_spread(count, index), angular) for index, angular in enumerate(problem.angular))
        numbers = [share * tau if angular else problem.scale * (0.05 + 1.2 * share**2) for share, angular in spread]
        if count % 8 != 7:
            _aim(problem, joint, pick, numbers, count)
        yield numbers


def _spread(count: int, index: int) -> float:
    """Return a number from 0 to 1, spread evenly over the starts and different for each unknown."""
    return (0.5 + (count + 1) * sqrt(_PRIMES[index % len(_PRIMES)])) % 1.0


_PRIMES: Final = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53)


def _aim(problem: ChainProblem, joint: int, pick: Point, numbers: Numbers, count: int) -> None:
    """Set the unknown numbers of the element before the joint so that it ends at the pick, and aim later headings."""
    index, turn = joint - 1, problem.run.elements[joint - 1].turn
    start = problem.walk(numbers)[index].start
    vector = (pick[0] - start[0], pick[1] - start[1])
    turned = problem.values(numbers)[index, SWEEP] / 2.0 * turn
    aimed = {(index, HEADING): atan2(vector[1], vector[0]) - turned}
    chord = hypot(*vector)
    aimed[index, SIZE] = chord / max(0.2, 2.0 * abs(sin(turned))) if turn else chord
    numbers[:] = [aimed.get(unknown, number) for unknown, number in zip(problem.unknown, numbers, strict=True)]
    end = problem.run.elements[-1].known
    for at, (following, quantity) in enumerate(problem.unknown):
        if count % 2 and following >= joint and quantity == HEADING:
            x, y = problem.walk(numbers)[following].start
            numbers[at] = atan2(end.get("y_end", y) - y, end.get("x_end", x + 1.0) - x)


def _free(problem: ChainProblem, root: Numbers) -> bool:
    """True if the data leave an answer free to move: its derivatives are dependent (Gram-Schmidt)."""
    columns = slopes(problem, root, problem.residuals(root))
    sizes = [problem.scale if angular else 1.0 for angular in problem.angular]
    vectors = [[value / size for value in column] for column, size in zip(columns, sizes, strict=True)]
    largest = max((hypot(*vector) for vector in vectors), default=0.0)
    while vectors:
        vectors.sort(key=lambda vector: hypot(*vector))
        head = vectors.pop()
        length = hypot(*head)
        if length <= SINGULAR_PIVOT * largest:
            return True
        unit = [value / length for value in head]
        for vector in vectors:
            part = sum(a * b for a, b in zip(vector, unit, strict=True))
            vector[:] = [a - part * b for a, b in zip(vector, unit, strict=True)]
    return False
