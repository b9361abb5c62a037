"""Mutants: correct center paths spoiled in small ways, and whether the judge notices.

`python -m tests.core.verify.mutants [contours]` prints a table for each of both.  Whether a mutant
truly gouges or leaves stock is decided by dense points (`oracle`), not by the judge.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, tau
from random import Random

import numpy as np

from core.geometry.path import Path
from core.geometry.piece import Side
from core.tolerance import GOUGE
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle
from tests.core.verify.corpus import MATTERS, STEP, Case, Chain, Truth, corpus
from tests.core.verify.finer import judge_finer

Mutation = Callable[[Random, Case], Chain]


def _size(random: Random) -> float:
    return float(10.0 ** random.uniform(-5.5, 0.3))


def shift_a_point(random: Random, case: Case) -> Chain:
    index, angle, size = random.randrange(len(case.path.points)), random.uniform(0.0, tau), _size(random)
    x, y = case.path.points[index]
    return case.path.moved(index, x + size * np.cos(angle).item(), y + size * np.sin(angle).item())


def shift_all(random: Random, case: Case) -> Chain:
    angle, size = random.uniform(0.0, tau), _size(random)
    dx, dy = size * np.cos(angle).item(), size * np.sin(angle).item()
    return Chain(tuple((x + dx, y + dy) for x, y in case.path.points), case.path.bulges)


def _an_arc(random: Random, case: Case) -> int | None:
    arcs = [k for k, bulge in enumerate(case.path.bulges) if bulge != 0.0]
    return random.choice(arcs) if arcs else None


def cut_an_arc_short(random: Random, case: Case) -> Chain:
    index = _an_arc(random, case)
    return case.path if index is None else case.path.bent(index, 0.0)


def flip_an_arc(random: Random, case: Case) -> Chain:
    index = _an_arc(random, case)
    return case.path if index is None else case.path.bent(index, -case.path.bulges[index])


def bend_a_move(random: Random, case: Case) -> Chain:
    index = random.randrange(len(case.path.bulges))
    return case.path.bent(index, case.path.bulges[index] + random.choice((-1.0, 1.0)) * _size(random) / 4.0)


def drop_a_point(random: Random, case: Case) -> Chain:
    if len(case.path.points) < 4:
        return case.path
    index = random.randrange(1, len(case.path.points) - 1)
    points, bulges = case.path.points, case.path.bulges
    return Chain(points[:index] + points[index + 1 :], (*bulges[: index - 1], 0.0, *bulges[index + 1 :]))


def swap_two_points(random: Random, case: Case) -> Chain:
    index, points = random.randrange(len(case.path.points) - 1), list(case.path.points)
    points[index], points[index + 1] = points[index + 1], points[index]
    return Chain(tuple(points), case.path.bulges)


def shorten_a_trim(random: Random, case: Case) -> Chain:
    """A joint drawn back along the earlier move."""
    index = random.randrange(1, len(case.path.points))
    (x0, y0), (x1, y1) = case.path.points[index - 1 : index + 1]
    share = min(0.9, _size(random) / max(hypot(x1 - x0, y1 - y0), 1e-9))
    return case.path.moved(index, x1 + share * (x0 - x1), y1 + share * (y0 - y1))


def lengthen_a_trim(random: Random, case: Case) -> Chain:
    """A joint pushed on in the earlier move's direction."""
    index = random.randrange(1, len(case.path.points))
    (x0, y0), (x1, y1) = case.path.points[index - 1 : index + 1]
    share = _size(random) / max(hypot(x1 - x0, y1 - y0), 1e-9)
    return case.path.moved(index, x1 - share * (x0 - x1), y1 - share * (y0 - y1))


def stop_early(random: Random, case: Case) -> Chain:
    keep = random.randrange(1, len(case.path.bulges) + 1)
    return Chain(case.path.points[: keep + 1], case.path.bulges[:keep])


def wider(random: Random, case: Case) -> Chain:
    return case.other(case.side, case.radius * (1.0 + random.choice((1e-2, 1e-3, 1e-4))))


def narrower(random: Random, case: Case) -> Chain:
    return case.other(case.side, case.radius * (1.0 - random.choice((1e-2, 1e-3, 1e-4))))


def on_the_other_side(_random: Random, case: Case) -> Chain:
    return case.other(Side.LEFT if case.side is Side.RIGHT else Side.RIGHT, case.radius)


def turned(random: Random, case: Case) -> Chain:
    angle = random.choice((-1.0, 1.0)) * _size(random) / 20.0
    turn = np.array(((np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))))
    points = (np.array(case.path.points) @ turn).tolist()
    return Chain(tuple((x, y) for x, y in points), case.path.bulges)


def backwards(_random: Random, case: Case) -> Chain:
    return Chain(case.path.points[::-1], tuple(-bulge for bulge in reversed(case.path.bulges)))


def cut_across(random: Random, case: Case) -> Chain:
    """Two points joined by one move, straight or bent, through whatever is there."""
    first, last = sorted(random.sample(range(len(case.path.points)), 2))
    points, bulges = case.path.points, case.path.bulges
    bulge = random.choice((0.0, 0.0, 0.2, -0.2))
    return Chain(points[: first + 1] + points[last:], (*bulges[:first], bulge, *bulges[last:]))


def dip(random: Random, case: Case) -> Chain:
    """A move that detours through a place next to its middle, up to three radii away."""
    index, off = random.randrange(len(case.path.bulges)), random.uniform(-3.0, 3.0) * case.radius
    (x0, y0), (x1, y1) = case.path.points[index : index + 2]
    size = max(hypot(x1 - x0, y1 - y0), 1e-9)
    place = ((x0 + x1) / 2.0 - off * (y1 - y0) / size, (y0 + y1) / 2.0 + off * (x1 - x0) / size)
    points, bulges = case.path.points, case.path.bulges
    bulges = (*bulges[:index], random.choice((0.0, 0.1)), random.choice((0.0, -0.1)), *bulges[index + 1 :])
    return Chain((*points[: index + 1], place, *points[index + 1 :]), bulges)


MUTATIONS: tuple[Mutation, ...] = (
    shift_a_point,
    shift_all,
    cut_an_arc_short,
    flip_an_arc,
    bend_a_move,
    drop_a_point,
    swap_two_points,
    shorten_a_trim,
    lengthen_a_trim,
    stop_early,
    wider,
    narrower,
    on_the_other_side,
    turned,
    backwards,
    cut_across,
    dip,
)


Judge = Callable[[Path, Side, float, Path], Verdict]


@dataclass
class Row:
    """Counts of one mutation."""

    mutants: int = 0
    gouging: int = 0
    gouge_caught: int = 0
    leaving: int = 0
    stock_caught: int = 0
    falsely_accused: int = 0

    @property
    def missed(self) -> int:
        return self.gouging - self.gouge_caught + self.leaving - self.stock_caught

    def count(self, judged: Judge, case: Case, path: Path, truth: Truth) -> None:
        """Judge one mutant and compare."""
        verdict = judged(case.surface, case.side, case.radius, path)
        self.mutants += 1
        self.gouging += truth.gouges
        self.gouge_caught += truth.gouges and _gouge_reported(truth, verdict, case)
        self.leaving += truth.stock > MATTERS
        self.stock_caught += truth.stock > MATTERS and _stock_reported(truth, verdict, len(case.surface))
        self.falsely_accused += _falsely(truth, verdict, case, path)


def _gouge_reported(truth: Truth, verdict: Verdict, case: Case) -> bool:
    """The wrong side is reported, and a gouge of the right depth; where the contour has no sides, of at least the
    radius."""
    if case.has_sides:
        right = abs(verdict.depth - truth.depth) < 1e-5 and (bool(verdict.wrong_side) or not truth.wrong_side)
        return right and not verdict.clean
    return not verdict.clean and verdict.depth > min(truth.depth, case.radius) - 1e-5


def _stock_reported(truth: Truth, verdict: Verdict, pieces: int) -> bool:
    """The largest thickness is right, and no less surface is reported than dense points find."""
    thickest = max((stretch.thickness for stretch in verdict.uncut), default=0.0)
    steps = STEP * (pieces + 2 * len(verdict.uncut))
    return thickest > truth.stock - 1e-5 and verdict.uncut_length > truth.left - steps


def _falsely(truth: Truth, verdict: Verdict, case: Case, path: Path) -> bool:
    """Something is reported that dense points do not find: a gouge, a wrong side, stock."""
    for gouge in verdict.gouges:
        # where the whole cutter is behind the surface, the gouge ends a tolerance short of the radius
        give = 2.0 * GOUGE if gouge.depth > case.radius else 1e-8
        if abs(oracle.apart(np.array([gouge.at]), case.surface)[0] - abs(case.radius - gouge.depth)) > give:
            return True
    for stretch in verdict.uncut:
        if abs(oracle.apart(np.array([stretch.thickest]), path)[0] - (case.radius + stretch.thickness)) > 1e-6:
            return True
    return bool(verdict.wrong_side) and case.closed and truth.behind <= 0.0


JUDGES: dict[str, Judge] = {"as it is": judge, "in many parts": judge_finer}

Table = dict[str, Row]
"""One row a mutation."""


def tables(seed: int, contours: int) -> dict[str, Table]:
    """Two tables over the same mutants of a corpus of contours: as they are, and parted into many pieces."""
    told = {name: {mutation.__name__: Row() for mutation in MUTATIONS} for name in JUDGES}
    random = Random(seed)
    for case in corpus(seed, contours):
        for mutation in MUTATIONS:
            path = mutation(random, case).path()
            if len(path):
                truth = Truth.of(case, path)
                for name, judged in JUDGES.items():
                    told[name][mutation.__name__].count(judged, case, path, truth)
    return told


def main() -> None:
    parser = argparse.ArgumentParser("tests.core.verify.mutants", description=__doc__)
    parser.add_argument("contours", type=int, nargs="?", default=100, help="contours whose paths are spoiled")
    told = tables(1, parser.parse_args().contours)
    for name, table in told.items():
        print(name)
        _print(table)


def _print(table: Table) -> None:
    words = ("mutants", "gouging", "caught", "stock", "caught", "missed", "falsely")
    print(f"{'mutation':20}" + "".join(f"{word:>9}" for word in words))
    sums = np.zeros(len(words), np.intp)
    for name, row in table.items():
        caught = (row.mutants, row.gouging, row.gouge_caught, row.leaving, row.stock_caught)
        counts = (*caught, row.missed, row.falsely_accused)
        print(f"{name.replace('_', ' '):20}" + "".join(f"{count:9}" for count in counts))
        sums += counts
    print(f"{'all':20}" + "".join(f"{count:9}" for count in sums) + "\n")


if __name__ == "__main__":
    main()
