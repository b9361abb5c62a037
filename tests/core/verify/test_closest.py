"""Where a center path comes nearest to the surface."""

from math import nan

import pytest

from core.geometry.path import EMPTY, Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.judge import judge
from core.verify.verdict import Approach

WALLS = Path.from_pieces([Line((0, 0), (10, 0)), Line((10, 0), (10, 10))])


def closest_approach(surface: Path, centers: list[Path], radius: float = 1.0) -> Approach | None:
    return judge(surface, Side.LEFT, radius, centers).closest


def test_a_path_beside_a_corner_is_nearest_where_it_begins():
    path = Path.from_pieces([Line((0, 1), (9, 1)), Line((9, 1), (9, 10))])
    found = closest_approach(WALLS, [path])
    assert found.distance == pytest.approx(1.0)
    assert found.at == pytest.approx((0, 1))
    assert found.surface_at == pytest.approx((0, 0))
    assert found.surface_number == 1.0


@pytest.mark.parametrize(
    ("path", "at", "surface_at", "number"),
    [
        (Path.from_pieces([Line((0, 2), (9.2, 1.5))]), (9.2, 1.5), (10, 1.5), 2.0),
        (Path.from_pieces([Arc((2, 3), (6, 3), (4, 3), Turn.CCW)]), (4, 1), (4, 0), 1.0),
        (
            Path.from_pieces([Line((0, 1), (4, 1)), Line((4, 1), (6, 0.5)), Line((6, 0.5), (8, 1))]),
            (6, 0.5),
            (6, 0),
            1.0,
        ),
        (Path.from_pieces([Line((5, 4), (5, 3))]), (5, 3), (5, 0), 1.0),
    ],
)
def test_the_place(path, at, surface_at, number):
    found = closest_approach(WALLS, [path])
    assert found.at == pytest.approx(at)
    assert found.surface_at == pytest.approx(surface_at)
    assert found.surface_number == number
    assert found.distance == judge(WALLS, Side.LEFT, 1.0, path).clearance


def test_the_deepest_gouge_is_the_nearest_place():
    path = Path.from_pieces([Line((0, 1), (4, 1)), Line((4, 1), (6, 0.5)), Line((6, 0.5), (8, 1))])
    verdict = judge(WALLS, Side.LEFT, 1.0, path)
    found = verdict.closest
    assert (found.at, found.surface_number) == (verdict.gouges[0].at, verdict.gouges[0].surface_number)
    assert verdict.radius - found.distance == pytest.approx(verdict.depth)


def test_of_several_loops_the_nearest():
    far, near = Path.from_pieces([Line((0, 3), (5, 3))]), Path.from_pieces([Line((5, 2), (7, 2))])
    assert closest_approach(WALLS, [far, near]).at == pytest.approx((5, 2))


def test_without_a_path_or_a_distance_there_is_no_place():
    path = Path.from_pieces([Line((0, 1), (9, 1))])
    assert closest_approach(WALLS, []) is None
    assert closest_approach(WALLS, [EMPTY]) is None
    assert closest_approach(EMPTY, [path]) is None
    assert closest_approach(WALLS, [path], nan) is None
