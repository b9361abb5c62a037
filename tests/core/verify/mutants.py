"""Mutants: correct centre paths spoiled in small ways, and whether the judge notices.

`python -m tests.core.verify.mutants [contours]` prints the table.  Whether a mutant truly gouges or leaves stock is
decided by dense points (`oracle`), not by the judge.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import hypot, tan, tau
from random import Random

import numpy as np

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.geometry.side import Side
from core.tolerance import CLOSED
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle

MATTERS = 1e-4
"""Millimetres of gouge or stock from which a mutant must be caught."""

STEP = 0.02


@dataclass(frozen=True)
class Chain:
    """A path by its points and the bulges between them: the tangent of a quarter of each sweep, 0 for a line."""

    points: tuple[Point, ...]
    bulges: tuple[float, ...]

    def path(self) -> Path:
        pairs = zip(self.points, self.points[1:], self.bulges, strict=False)
        return Path.from_pieces([_piece(a, b, bulge) for a, b, bulge in pairs if a != b])

    @staticmethod
    def of(path: Path) -> Chain:
        bulges = [0.0 if isinstance(piece, Line) else tan(piece.sweep / 4.0) for piece in path]
        return Chain(tuple((x, y) for x, y in path.points.tolist()), tuple(bulges))

    def moved(self, index: int, x: float, y: float) -> Chain:
        """The chain with one point elsewhere; arcs keep their sweeps."""
        points = list(self.points)
        points[index] = (x, y)
        return Chain(tuple(points), self.bulges)

    def bent(self, index: int, bulge: float) -> Chain:
        """The chain with another bulge."""
        return Chain(self.points, (*self.bulges[:index], bulge, *self.bulges[index + 1 :]))


def _piece(a: Point, b: Point, bulge: float) -> Piece:
    if bulge == 0.0:
        return Line(a, b)
    (x0, y0), (x1, y1) = a, b
    rise = (1.0 - bulge * bulge) / (4.0 * bulge)
    centre = ((x0 + x1) / 2.0 - rise * (y1 - y0), (y0 + y1) / 2.0 + rise * (x1 - x0))
    return Arc(a, b, centre, Turn.CCW if bulge > 0.0 else Turn.CW)


@dataclass(frozen=True)
class Case:
    """A contour and its correct centre path; `other` is the path at another radius or on the other side."""

    surface: Path
    side: Side
    radius: float
    closed: bool
    path: Chain

    def other(self, side: Side, radius: float) -> Chain:
        return Chain.of(_compensated(self.surface, side, radius, closed=self.closed))


def _compensated(surface: Path, side: Side, radius: float, *, closed: bool) -> Path:
    return compensate(surface, side, radius, 20, closed=closed).path


def _outline(random: Random) -> tuple[Path, bool]:
    """A closed outline started in the middle of a side, or an open one; lines, and arcs bent in or out."""
    count, closed = random.randint(3, 8), random.random() < 0.7
    spread = random.choice((0.0, 0.3, 0.6))
    points = []
    for k in range(count):
        angle = tau * (k + random.uniform(-0.3, 0.3)) / count
        size = random.choice((5.0, 20.0)) * (1.0 - spread * random.random())
        points.append((size * np.cos(angle).item(), size * np.sin(angle).item()))
    bulges = [random.choice((0.0, 0.0, 0.0, 0.1, 0.3, -0.1, -0.3)) for _ in points]
    bulges[-1] = 0.0
    if closed:
        middle = ((points[-1][0] + points[0][0]) / 2.0, (points[-1][1] + points[0][1]) / 2.0)
        points, bulges = [middle, *points, middle], [0.0, *bulges]
    else:
        bulges = bulges[:-1]
    if random.random() < 0.5:
        points, bulges = points[::-1], [-bulge for bulge in reversed(bulges)]
    return Chain(tuple(points), tuple(bulges)).path(), closed


def corpus(seed: int, count: int) -> Iterator[Case]:
    """`count` contours whose path at look-ahead 20 neither gouges nor leaves its side by dense points."""
    random = Random(seed)
    while count:
        surface, closed = _outline(random)
        side, radius = random.choice(list(Side)), random.choice((0.25, 0.7, 1.5))
        path = _compensated(surface, side, radius, closed=closed)
        if len(path) and closed == (hypot(*(surface.points[0] - surface.points[-1])) <= CLOSED):
            case = Case(surface, side, radius, closed, Chain.of(path))
            if _simple(surface) and Truth.of(case, path).harmless:
                count -= 1
                yield case


def _simple(surface: Path) -> bool:
    """Points of each piece keep off all others but its neighbours."""
    shares = np.linspace(0.0, 1.0, 60)
    count = len(surface)
    for k in range(count):
        others = [j for j in range(count) if (j - k) % count not in (0, 1, count - 1)]
        inner = oracle.along(surface[k], shares)
        if any(oracle.apart(inner, surface.part(j, j + 1)).min() < 0.05 for j in others):
            return False
        for j in {(k + 1) % count, (k - 1) % count} - {k}:
            far = oracle.apart(oracle.along(surface[k], np.array((0.1, 0.25, 0.5, 0.75, 0.9))), surface.part(j, j + 1))
            if far.min() < 0.02:
                return False
    return True


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
)


@dataclass(frozen=True)
class Truth:
    """What dense points say: depth of the deepest gouge, the thickness left and on how much surface more than MATTERS
    is left, whether the path runs on the part's side."""

    depth: float
    stock: float
    left: float
    wrong_side: bool

    @property
    def harmless(self) -> bool:
        return self.depth < 1e-6 and not self.wrong_side

    @property
    def gouges(self) -> bool:
        return self.depth > MATTERS or self.wrong_side

    @staticmethod
    def of(case: Case, path: Path) -> Truth:
        depth = case.radius - oracle.extreme(path, case.surface, STEP, -1.0)
        stock = oracle.extreme(case.surface, path, STEP, 1.0) - case.radius
        total = float(case.surface.lengths.sum())
        left = total - oracle.length_near(case.surface, path, case.radius + MATTERS, STEP)
        wrong = case.closed and oracle.inside(path, case.surface, STEP) != _room_is_inside(case)
        return Truth(depth, stock, left, wrong)


def _room_is_inside(case: Case) -> bool:
    return (oracle.turning(case.surface) > 0.0) == (case.side is Side.LEFT)


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

    def count(self, case: Case, path: Path) -> None:
        """Judge one mutant and compare."""
        truth, verdict = Truth.of(case, path), judge(case.surface, case.side, case.radius, path)
        self.mutants += 1
        self.gouging += truth.gouges
        self.gouge_caught += truth.gouges and not verdict.clean and verdict.depth > min(truth.depth, case.radius) - 1e-5
        self.leaving += truth.stock > MATTERS
        self.stock_caught += truth.stock > MATTERS and _stock_told(truth, verdict, len(case.surface))
        self.falsely_accused += _falsely(truth, verdict, case, path)


def _stock_told(truth: Truth, verdict: Verdict, pieces: int) -> bool:
    """The largest thickness is right, and no less surface is told than dense points find."""
    told = max((stretch.thickness for stretch in verdict.uncut), default=0.0)
    steps = STEP * (pieces + 2 * len(verdict.uncut))
    return told > truth.stock - 1e-5 and verdict.uncut_length > truth.left - steps


def _falsely(truth: Truth, verdict: Verdict, case: Case, path: Path) -> bool:
    """Something is told that dense points do not find: a gouge, a wrong side, stock."""
    for gouge in verdict.gouges:
        if abs(oracle.apart(np.array([gouge.at]), case.surface)[0] - (case.radius - gouge.depth)) > 1e-8:
            return True
    for stretch in verdict.uncut:
        if abs(oracle.apart(np.array([stretch.thickest]), path)[0] - (case.radius + stretch.thickness)) > 1e-6:
            return True
    if verdict.wrong_side and case.closed:
        return not (truth.wrong_side or truth.depth > case.radius - 1e-6)
    return False


def table(seed: int, contours: int) -> dict[str, Row]:
    """One row a mutation over a corpus of contours."""
    rows = {mutation.__name__: Row() for mutation in MUTATIONS}
    random = Random(seed)
    for case in corpus(seed, contours):
        for mutation in MUTATIONS:
            path = mutation(random, case).path()
            if len(path):
                rows[mutation.__name__].count(case, path)
    return rows


def main() -> None:
    rows = table(1, int(sys.argv[1]) if len(sys.argv) > 1 else 100)
    print(
        f"{'mutation':22}{'mutants':>8}{'gouging':>9}{'caught':>8}{'stock':>8}{'caught':>8}{'missed':>8}{'falsely':>9}"
    )
    for name, row in rows.items():
        counts = (row.gouge_caught, row.leaving, row.stock_caught, row.missed)
        print(f"{name.replace('_', ' '):22}{row.mutants:8}{row.gouging:9}" + "".join(f"{n:8}" for n in counts), end="")
        print(f"{row.falsely_accused:9}")


if __name__ == "__main__":
    main()
