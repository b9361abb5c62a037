"""The depth of gouges where the center itself is behind the surface, and the moves on the wrong side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, hypot, sin, sqrt, tau
from random import Random

import numpy as np
import pytest
from shapely.geometry import Polygon

from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.judge import judge
from core.verify.verdict import Verdict
from tests.core.verify import oracle
from tests.core.verify.corpus import Chain, gouged
from tests.core.verify.finer import MANY, in_parts
from tests.core.verify.oracle import chords
from tests.core.verify.shapes import lines, mirrored, square

PLATE = square(40.0)


@pytest.mark.parametrize(("end", "inside"), [((50, 1), 0.29357798), ((44, 0.6), 0.30353430), ((60, 4), 1.68888889)])
def test_a_move_through_a_corner_of_a_plate_gouges_beyond_the_radius(end: tuple[float, float], inside: float) -> None:
    """The ends of the move are outside the plate; in between, the center is inside by less than the radius."""
    for verdict in as_it_is_and_finer(PLATE, Side.RIGHT, 3.0, lines((-1, -2.5), end)):
        assert verdict.wrong_side == (0,)
        assert verdict.depth == pytest.approx(3.0 + inside, abs=1e-6)
        x, y = verdict.gouges[0].at
        assert y == pytest.approx(inside, abs=1e-6) or 40.0 - x == pytest.approx(inside, abs=1e-6)
        assert hypot(*np.subtract(verdict.gouges[0].at, verdict.gouges[0].surface_at)) == pytest.approx(
            inside, abs=1e-6
        )


def test_a_gouge_with_all_of_the_cutter_is_as_deep_as_the_diameter() -> None:
    verdict = judge(PLATE, Side.RIGHT, 3.0, lines((20, -10), (20, 15), (20, 3.5), (30, 3.5), (30, -10)))
    assert [gouge.depth for gouge in verdict.gouges] == [6.0, 6.0]
    places = np.array(sorted(gouge.at for gouge in verdict.gouges))
    assert places == pytest.approx(np.array(((20.0, 3.0), (30.0, 3.0))), abs=2e-6)
    assert verdict.wrong_side == (0, 1, 2, 3)


def test_a_path_wholly_inside_a_part_is_on_the_wrong_side_without_a_gouge() -> None:
    verdict = judge(PLATE, Side.RIGHT, 3.0, lines((10, 10), (30, 10), (30, 30)))
    assert not verdict.gouges
    assert verdict.wrong_side == (0, 1)
    nearer = judge(PLATE, Side.RIGHT, 3.0, lines((10, 2.5), (30, 2.75)))
    assert nearer.depth == pytest.approx(5.75)
    assert nearer.wrong_side == (0,)


def test_a_cutter_without_a_radius_is_on_the_wrong_side_behind_the_surface() -> None:
    """Without a radius nothing gouges, and the center may run on the surface."""
    clean = judge(PLATE, Side.RIGHT, 0.0, PLATE)
    assert clean.clean
    for radius in (0.0, 1e-6, 1e-5):
        verdict = judge(PLATE, Side.RIGHT, radius, lines((0, -5), (10, 0), (20, 0), (-20, 1), (-20, 30), (50, 41)))
        assert verdict.wrong_side == (2, 4)


def test_a_touch_from_outside_is_not_on_the_wrong_side() -> None:
    touching = judge(PLATE, Side.RIGHT, 3.0, lines((-5, 5), (5, -5)))
    assert touching.wrong_side == ()
    assert touching.depth == pytest.approx(3.0, abs=1e-9)


OPEN = lines((0, 0), (10, 0))


@pytest.mark.parametrize(
    ("move", "depth", "wrong"),
    [
        (lines((5, 4), (5, -0.5)), 1.5, True),
        (lines((9.5, 0.5), (10.5, -0.5)), 1.0, False),
        (lines((9.4, 0.5), (10.4, -0.5)), 1.1, True),
        (lines((-0.5, 0.5), (-0.5, -0.5), (0.25, -0.5), (-0.5, -0.5)), 1.5, True),
        (lines((-4, -4), (14, -4)), 0.0, True),
        (lines((5, 4), (5, -4)), 2.0, True),
    ],
)
def test_an_open_contour_is_gouged_from_behind_only_where_it_has_a_side(move: Path, depth: float, wrong: bool) -> None:
    """It has no side where its end is nearest; farther behind it than the radius there is no gouge."""
    for verdict in as_it_is_and_finer(OPEN, Side.LEFT, 1.0, move):
        assert verdict.depth == pytest.approx(depth, abs=1e-6)
        assert bool(verdict.wrong_side) == wrong


GROOVE = Path.from_pieces(
    [
        *lines((4, -5), (4, -3), (1.2, -3), (1, 0)),
        Arc((1.0, 0.0), (-1.0, 0.0), (0.0, 0.0), Turn.CW),
        *lines((-1, 0), (-1.2, -3), (-4, -3), (-4, -5), (4, -5)),
    ]
)
"""A half-round groove between two lips with edges sharper than a right angle."""


@pytest.mark.parametrize(
    ("radius", "move", "depth"),
    [
        (1.0, lines((0, 3), (0, 0)), 0.0),
        (0.5, lines((-0.3, 0), (0.3, 0)), 0.0),
        (1.5, lines((0, 3), (0, 0)), 0.5),
        (1.5, lines((0, -0.2), (0, 0.2)), 0.7),
    ],
)
def test_the_middle_of_a_groove_is_on_its_open_side(radius: float, move: Path, depth: float) -> None:
    """All of the arc and both of its edges are equally near there; the lips recede behind the edges."""
    for verdict in as_it_is_and_finer(GROOVE, Side.RIGHT, radius, move):
        assert verdict.wrong_side == ()
        assert verdict.depth == pytest.approx(depth, abs=1e-6)


BOSS = Path.from_pieces(
    [
        Line((-20.0, 0.0), (0.0, 0.0)),
        Arc((0.0, 0.0), (-5.0, 5.0), (0.0, 5.0), Turn.CW),
        *lines((-5, 5), (-5, 20), (20, 20), (20, -10), (-20, -10), (-20, 0)),
    ]
)
"""A plate with a round wall on it: the space between them narrows to nothing at (0, 0)."""


@pytest.mark.parametrize(("side", "wrong", "depth"), [(Side.LEFT, (0,), 2.5 + hypot(2.0, 0.3)), (Side.RIGHT, (), 0.5)])
def test_a_move_where_two_walls_touch_is_on_the_right_side_of_both(
    side: Side, wrong: tuple[int, ...], depth: float
) -> None:
    """The nearest point is a joint where the contour turns back on itself."""
    move = lines((2, -0.3), (2, 0.3))
    other = Side.LEFT if side is Side.RIGHT else Side.RIGHT
    mirror_image = judge(mirrored(BOSS), other, 2.5, mirrored(move))
    for verdict in (*as_it_is_and_finer(BOSS, side, 2.5, move), mirror_image):
        assert verdict.wrong_side == wrong
        assert verdict.depth == pytest.approx(depth, abs=1e-6)


ARMS = lines((0, 10), (0, 0), (4, 0), (4, 3))


def test_a_move_past_the_end_of_one_arm_is_behind_the_other_arm() -> None:
    """The move meets nothing: it is behind from where the other arm is as near as that end, 4.209 away, to its end."""
    inside = 1.0 + (5.75 - sqrt(5.75**2 - 0.5625 * 17.0)) / 0.28125
    for verdict in as_it_is_and_finer(ARMS, Side.RIGHT, 5.0, lines((9, 9), (1, 6))):
        assert verdict.depth == pytest.approx(5.0 + inside, abs=1e-6)
        assert verdict.wrong_side == (0,)


def test_a_move_that_only_ends_behind_an_open_contour_is_on_the_wrong_side() -> None:
    for verdict in as_it_is_and_finer(OPEN, Side.LEFT, 1.0, lines((-6, -2), (1, -2), (-6, -3))):
        assert verdict.wrong_side == (0, 1)


def as_it_is_and_finer(surface: Path, side: Side, radius: float, path: Path) -> Iterator[Verdict]:
    """The verdicts on the contour as it is and in many parts."""
    return (judged(surface, side, radius, path) for judged in (judge, in_many_walls))


def outline(random: Random) -> Path:
    """A closed contour of lines and arcs in either direction that does not cross itself."""
    while True:
        count = random.randint(3, 12)
        angles = [tau * (k + random.uniform(0.0, 0.6)) / count for k in range(count)]
        sizes = [random.uniform(2.0, 5.0) for _ in angles]
        points = [(size * cos(angle), size * sin(angle)) for size, angle in zip(sizes, angles, strict=True)]
        bulges = [random.choice((0.0, 0.0, 0.2, -0.2, 0.5, -0.5)) for _ in points]
        points.append(points[0])
        if random.random() < 0.5:
            points, bulges = points[::-1], [-bulge for bulge in reversed(bulges)]
        contour = Chain(tuple(points), tuple(bulges)).path()
        if (
            Polygon(chords(contour)).is_valid
            and not judge(contour, Side.LEFT, 1.0, lines((9, 9), (9, 8))).crosses_itself
        ):
            return contour


def moves(random: Random) -> Path:
    """A few straight and curved moves, far apart or close together."""
    x, y, size = random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), random.choice((0.3, 2.0, 6.0))
    points = [(x + random.gauss(0.0, size), y + random.gauss(0.0, size)) for _ in range(random.randint(2, 5))]
    return Chain(tuple(points), tuple(random.choice((0.0, 0.0, 0.4, -1.0)) for _ in points[1:])).path()


def in_many_walls(surface: Path, side: Side, radius: float, path: Path) -> Verdict:
    """The verdict on the same contour divided into many walls."""
    parts = -(-MANY // len(surface))
    return judge(in_parts(surface, [np.arange(1, parts) / parts] * len(surface)), side, radius, path)


@pytest.mark.parametrize("seed", range(2))
def test_random_moves_through_closed_contours_agree_with_the_oracle(seed: int) -> None:
    assert compared(seed, 8) > 15


def compared(seed: int, contours: int) -> int:
    """The number of paths that enter the part; each verdict must agree with sampled points and shapely."""
    random, inside = Random(seed), 0
    for _ in range(contours):
        surface, side = outline(random), random.choice(list(Side))
        for _ in range(6):
            path, radius = moves(random), random.choice((0.01, 0.1, 0.5, 2.0))
            verdicts = [judged(surface, side, radius, path) for judged in (judge, in_many_walls)]
            inside += _agree(surface, side, verdicts, path)
    return inside


def _agree(surface: Path, side: Side, verdicts: Sequence[Verdict], path: Path) -> bool:
    part = Polygon(chords(surface))
    room_inside = part.exterior.is_ccw == (side is Side.LEFT)
    for row in range(len(path)):
        move = path.part(row, row + 1)
        deep = oracle.deepest(move, surface, 0.01, room_inside=room_inside)
        line = chords(move)
        length = line.difference(part).length if room_inside else line.intersection(part).length
        for verdict in verdicts:
            assert (row in verdict.wrong_side) == (deep > 1e-6) or abs(deep) < 1e-5
            assert (row in verdict.wrong_side) == (length > 0.0) or length < 10.0 * sqrt(1e-5)
    deep = oracle.deepest(path, surface, 0.01, room_inside=room_inside)
    nearest = oracle.extreme(path, surface, 0.01, -1.0)
    for verdict in verdicts:
        assert verdict.depth == pytest.approx(gouged(verdict.radius, nearest, deep), abs=1e-6)
    return deep > 0.0


def spiral(random: Random) -> Path:
    """An open spiral: the part side of each turn faces the cutter side of the next."""
    count, turns, apart = random.randint(8, 40), random.uniform(0.8, 3.0), random.uniform(0.5, 3.0)
    angles = [turns * tau * k / count for k in range(count + 1)]
    points = [((1.0 + apart * a / tau) * cos(a), (1.0 + apart * a / tau) * sin(a)) for a in angles]
    return Chain(tuple(points), tuple(random.choice((0.0, 0.0, 0.1)) for _ in points[1:])).path()


@pytest.mark.parametrize("seed", range(3))
def test_moves_between_the_turns_of_a_spiral_have_the_same_depth_in_many_parts(seed: int) -> None:
    """Short moves check at more places whether a move changes sides between two arms."""
    random, gouging = Random(seed), 0
    for _ in range(25):
        surface, side, radius = spiral(random), random.choice(list(Side)), random.choice((0.1, 0.5, 2.0))
        path = moves(random)
        verdict = judge(surface, side, radius, path)
        finer = judge(surface, side, radius, in_parts(path, [np.arange(1, 8) / 8] * len(path)))
        assert verdict.depth == pytest.approx(finer.depth, abs=1e-7)
        assert verdict.wrong_side or not finer.wrong_side
        gouging += bool(verdict.gouges)
    assert gouging > 4


def test_a_path_through_the_gap_beside_an_uneven_arc_is_on_the_wrong_side() -> None:
    """The path meets nothing in the gap: its tip behind the gap gives the depth."""
    off, end = np.array((cos(-tau / 12), sin(-tau / 12))), 10.002 * np.array((cos(-tau / 12), sin(-tau / 12)))
    x, y = end.tolist()
    walls = [
        *lines((60, 0.5), (30, 0.3), (10, 0)),
        Arc((10.0, 0.0), (x, y), (0.0, 0.0), Turn.CCW),
        *lines((x, y), (x - 2, y - 8), (x - 2, y - 60)),
    ]
    along = np.array((-off[1], off[0]))
    begin, tip = ((10.001 * off + far * along).tolist() for far in (-1.0, 0.4))
    verdict = judge(Path.from_pieces(walls), Side.RIGHT, 0.5, lines(tuple(begin), tuple(tip)))
    assert verdict.wrong_side == (0,)
    assert verdict.depth == pytest.approx(0.9, abs=1e-3)
