"""What is proved of pieces beside their walls is so, and spares nothing that measuring everything would find."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, isnan, pi, sin
from random import Random

import numpy as np
import pytest

from core.comp.compensate import compensate
from core.geometry import aligned
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Side, Turn
from core.geometry.piece_arrays import piece_arrays
from core.tolerance import GOUGE
from core.verify import judge as module
from core.verify.beside import Beside, beside
from core.verify.judge import judge, judge_together
from core.verify.verdict import Verdict
from tests.bench.families import FAMILIES, Work
from tests.core.verify.brute import apart
from tests.core.verify.corpus import corpus
from tests.core.verify.mutants import MUTATIONS
from tests.core.verify.shapes import lines, moved
from tests.core.verify.test_brute import FAMILIES as SHAPES

GRANT = 1.1e-9


def zigzag(random: Random) -> Path:
    """Lines that turn back and forth by any angle, sharp and all but straight ones among them."""
    spots, heading = [(0.0, 0.0)], 0.0
    for _ in range(random.randint(3, 12)):
        heading += random.choice((1e-7, 1e-3, 0.1, 1.0, 2.0, 3.0, pi / 2.0)) * random.choice((-1.0, 1.0))
        size = random.choice((0.01, 0.5, 3.0))
        spots.append((spots[-1][0] + size * cos(heading), spots[-1][1] + size * sin(heading)))
    return lines(*spots)


def smooth(random: Random) -> Path:
    """Lines and arcs that all leave where the one before arrives, of up to half a turn and a little more."""
    place, heading = (0.0, 0.0), 0.0
    pieces: list[Piece] = []
    for _ in range(random.randint(2, 10)):
        radius, turn = random.choice((0.3, 0.51, 1.0, 4.0, 300.0)), random.choice((Turn.NONE, Turn.CW, Turn.CCW))
        if turn is Turn.NONE:
            end = _ahead(place, heading, random.choice((0.02, 1.0, 5.0)))
            pieces.append(Line(place, end))
        else:
            angle = random.choice((0.01, 0.5, pi / 2.0, 2.5, pi, 3.3))
            center = _ahead(place, heading + turn * pi / 2.0, radius)
            heading += turn * angle
            end = _ahead(center, heading - turn * pi / 2.0, radius)
            pieces.append(Arc(place, end, center, turn))
        place = end
    return Path.from_pieces(pieces)


def curve(random: Random) -> Path:
    """Small lines that turn steadily, one way or now one way and then the other."""
    spots, heading, bend = [(0.0, 0.0)], 0.0, random.choice((0.01, 0.08, 0.3)) * random.choice((-1.0, 1.0))
    for k in range(random.choice((30, 130))):
        heading += bend * (1.0 if k % 50 < 40 else -1.0)
        size = random.choice((0.02, 0.02, 0.2))
        spots.append((spots[-1][0] + size * cos(heading), spots[-1][1] + size * sin(heading)))
    return lines(*spots)


def _ahead(place: Point, heading: float, size: float) -> Point:
    return place[0] + size * cos(heading), place[1] + size * sin(heading)


CONTOURS: tuple[Callable[[Random], Path], ...] = (zigzag, smooth, curve, *SHAPES)


def compensated(random: Random) -> Iterator[tuple[Path, Side, float, Path]]:
    """Contours with a path beside them that may well gouge, far from the origin too."""
    for contour in CONTOURS:
        surface = moved(contour(random), random.uniform(-3.0, 3.0), random.choice(((0.0, 0.0), (1e4, -3e3))))
        side, radius, value = random.choice(list(Side)), random.choice((0.05, 0.5, 0.5, 1.5)), random.choice((1, 5, 20))
        path = compensate(surface, side, radius, value, closed=False).path
        if len(path):
            yield surface, side, radius, path


def found(surface: Path, side: Side, radius: float, path: Path) -> Beside:
    walls, moves = piece_arrays(surface), piece_arrays(path)
    whole = np.flatnonzero(path.numbers[moves.rows] % 1.0 == 0.0)
    likely = np.full(len(moves), -1)
    likely[whole] = np.searchsorted(surface.numbers[walls.rows], path.numbers[moves.rows][whole])
    return beside(moves, likely, walls, side.sign, radius, GRANT)


@pytest.mark.parametrize("seed", range(25))
def test_what_is_proved_is_no_nearer_than_the_radius(seed: int) -> None:
    for surface, side, radius, path in compensated(Random(seed)):
        own, rows, moves = found(surface, side, radius, path), piece_arrays(surface).rows, piece_arrays(path).rows
        near = [(own.piece[k], k) for k in range(len(rows)) if own.piece[k] >= 0]
        near += [(own.corner[k], k + both) for k in range(len(rows)) for both in (0, 1) if own.corner[k] >= 0]
        near += [(own.piece[k], k + 1) for k in range(len(rows) - 1) if own.proved[k]]
        near += [(own.piece[k + 1], k) for k in range(len(rows) - 1) if own.proved[k]]
        for i, k in near:
            assert apart(path[moves[i]], surface[rows[k]]) > radius - 20.0 * GRANT


def test_an_own_piece_that_begins_and_ends_within_what_is_granted_reaches_its_whole_wall() -> None:
    """Where it reaches all but a nanometer, the end of the reach would be another piece's, and settled by that."""
    surface = Path.from_pieces([Line((0.0, 0.0), (4.0, 0.0)), Arc((4.0, 0.0), (8.0, 4.0), (4.0, 4.0), Turn.CCW)])
    late, early = 5e-10, 4.0 - 5e-10
    up, along = 3.0 * sin(late / 4.0), 3.0 * cos(late / 4.0)
    ends = (4.0 + up, 4.0 - along), (4.0 + along, 4.0 - up)
    moves = piece_arrays(lines((late, 1.0), (early, 1.0)), Path.from_pieces([Arc(*ends, (4.0, 4.0), Turn.CCW)]))
    own = beside(moves, np.arange(2), piece_arrays(surface), 1, 1.0, GRANT)
    assert own.piece.tolist() == [0, 1]
    assert own.first.tolist() == [0.0, 0.0]
    assert own.last.tolist() == [1.0, 1.0]


def test_nothing_in_a_run_is_nearer_than_the_radius() -> None:
    random, pairs = Random(1), 0
    for _ in range(30):
        surface, side, radius = curve(random), random.choice(list(Side)), random.choice((0.05, 0.5))
        path = compensate(surface, side, radius, 20, closed=False).path
        own = found(surface, side, radius, path)
        if not own.runs:
            continue
        for step in range(2, 40):
            for k in np.flatnonzero(own.runs.ahead(step)).tolist():
                pairs += _clear(own, k, k + step, surface, path, radius)
            for k in np.flatnonzero(own.runs.behind(step)).tolist():
                pairs += _clear(own, k + step, k, surface, path, radius)
    assert pairs > 5000


def _clear(own: Beside, company: int, wall: int, surface: Path, path: Path, radius: float) -> int:
    """How many pieces there are in company; none is nearer to that wall than the radius."""
    pieces = [row for row in (own.piece[company].item(), own.corner[company].item()) if row >= 0]
    assert all(apart(path[row], surface[wall]) > radius - 100.0 * GRANT for row in pieces)
    return len(pieces)


@pytest.mark.parametrize("grant", [2e-9, 1e-8, 2e-8])
def test_what_is_granted_at_every_joint_of_a_run_adds_up_to_half_a_gouge(grant: float) -> None:
    """Walls that go straight on, each a grant lower than the one before, and moves that sink as much on top of it."""
    give = 0.9 * grant
    walls = piece_arrays(*[lines((k, -k * give), (k + 1.0, -k * give)) for k in range(60)])
    heights = [1.0 - k * give for k in range(60)]
    moves = piece_arrays(*[lines((k, y + give), (k + 1.0, y - give)) for k, y in enumerate(heights)])
    own = beside(moves, np.arange(60), walls, 1, 1.0, grant)
    assert own.runs
    longest = max(step for step in range(1, 59) if own.runs.ahead(step).any() or own.runs.behind(step).any())
    assert longest > 10
    assert 2.0 * grant * longest <= GOUGE / 2.0


def test_the_proofs_are_worth_a_test() -> None:
    counts = np.zeros((2, 4), np.intp)
    for seed in range(25):
        for surface, side, radius, path in compensated(Random(seed)):
            own, bent = found(surface, side, radius, path), bool(surface.turns.any())
            joints = len(own.proved)
            counts[int(bent)] += (own.proved.sum(), joints - own.proved.sum(), (own.corner >= 0).sum(), len(path))
    assert counts[0, :3].min() > 100
    assert counts[1, :2].min() > 50


def alike(one: Verdict, other: Verdict) -> None:
    """Both verdicts say the same."""
    assert one.clearance == pytest.approx(other.clearance, abs=1e-8) or isnan(one.clearance)
    for name in ("judged", "wrong_side", "loose", "backwards", "crosses_itself", "clean"):
        assert getattr(one, name) == getattr(other, name)
    gouges, same = (sorted((round(gouge.extent, 8), gouge.depth) for gouge in told.gouges) for told in (one, other))
    assert np.array(gouges) == pytest.approx(np.array(same), abs=2e-8)
    for stretch, same_stretch in zip(one.uncut, other.uncut, strict=True):
        assert stretch.thickness == pytest.approx(same_stretch.thickness, abs=1e-7)
        assert stretch.length == pytest.approx(same_stretch.length, abs=1e-6)
        assert (stretch.area is None) == (same_stretch.area is None)


def both_ways(monkeypatch: pytest.MonkeyPatch, surface: Path, side: Side, radius: float, path: Path) -> None:
    """Judging with all that can be proved says what measuring every pair says."""
    monkeypatch.setattr(module, "FEW", 0)
    monkeypatch.setattr(aligned, "FEW", 0)
    proved = judge(surface, side, radius, path)
    monkeypatch.setattr(module, "FEW", len(surface))
    alike(proved, judge(surface, side, radius, path))


@pytest.mark.parametrize("seed", range(10))
def test_a_verdict_is_that_of_measuring_every_pair(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    for surface, side, radius, path in compensated(Random(seed)):
        both_ways(monkeypatch, surface, side, radius, path)
        shaken = path.points + Random(seed).choice((1e-9, 1e-8, 1e-6, 1e-3)) * np.random.default_rng(seed).normal(
            size=path.points.shape
        )
        both_ways(monkeypatch, surface, side, radius, Path.of(shaken, path.centers, path.turns, path.numbers))
        wrong = np.random.default_rng(seed).permutation(path.numbers)
        both_ways(monkeypatch, surface, side, radius, Path.of(path.points, path.centers, path.turns, wrong))
        both_ways(monkeypatch, surface, side, radius, path.reversed())


def test_spoiled_paths_are_judged_alike_with_the_numbers_they_had(monkeypatch: pytest.MonkeyPatch) -> None:
    random = Random(5)
    for case in corpus(5, 12):
        right = compensate(case.surface, case.side, case.radius, 20, closed=case.closed).path
        for mutation in MUTATIONS:
            path = mutation(random, case).path()
            if len(path) == len(right):
                path = Path.of(path.points, path.centers, path.turns, right.numbers)
                both_ways(monkeypatch, case.surface, case.side, case.radius, path)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("count", [8, 130, 400])
def test_the_benchmarks_contours_are_judged_alike(
    family: Callable[[int], Work], count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    work = family(count)
    for value in (1, 8):
        for radius in (work.radius, work.accepted, 2.0 * work.radius):
            path = compensate(work.contour, work.side, radius, value, closed=work.closed).path
            if len(path):
                both_ways(monkeypatch, work.contour, work.side, radius, path)


def test_the_path_of_the_other_side_is_beside_nothing() -> None:
    surface = lines((0.0, 0.0), (4.0, 0.0), (6.0, 3.0))
    path = compensate(surface, Side.LEFT, 0.5, 3, closed=False).path
    assert (found(surface, Side.LEFT, 0.5, path).piece >= 0).all()
    for side, radius, moves in ((Side.RIGHT, 0.5, path), (Side.LEFT, 0.5001, path), (Side.LEFT, 0.5, path.reversed())):
        assert (found(surface, side, radius, moves).piece < 0).all()


def test_walls_that_turn_back_on_each_other_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three walls one over the other: what runs on the right side of the middle one is on the wrong side of two."""
    for back in (0.0, 1e-9, -1e-9):
        surface = lines((0.0, 0.0), (4.0, 0.0), (1.0, back), (6.0, 0.0))
        for side in Side:
            path = compensate(surface, side, 0.5, 1, closed=False).path
            both_ways(monkeypatch, surface, side, 0.5, path)


def test_a_loop_about_a_corner_is_no_corner_of_the_loops_beside_its_walls(monkeypatch: pytest.MonkeyPatch) -> None:
    """Loops follow each other as pieces do, but are not joined: an arc about a joint may begin or end in the wall."""
    monkeypatch.setattr(module, "FEW", 0)
    surface = lines((0.0, 0.0), (10.0, 0.0), (10.0, -10.0))
    one = Path.from_pieces([Line((0.0, 1.0), (10.0, 1.0))], [1.0])
    other = Path.from_pieces([Line((11.0, 0.0), (11.0, -10.0))], [2.0])
    for start, end in (((9.0, 0.0), (11.0, 0.0)), ((10.0, 1.0), (10.0, -1.0))):
        through = Path.from_pieces([Arc(start, end, (10.0, 0.0), Turn.CW)], [1.5])
        verdict = judge_together(surface, Side.LEFT, 1.0, (one, through, other))
        assert verdict.depth == pytest.approx(1.0, abs=1e-9)
    right = Path.from_pieces([Arc((10.0, 1.0), (11.0, 0.0), (10.0, 0.0), Turn.CW)], [1.5])
    assert judge_together(surface, Side.LEFT, 1.0, (one, right, other)).clean
