"""The side of the part, compared with the winding of dense polygons, and places without a side."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.verify.judge import judge
from tests.core.verify import oracle
from tests.core.verify.corpus import Chain
from tests.core.verify.shapes import lines, mirrored, moved


def star(random: Random) -> Path:
    """A closed outline about the origin with curved sides and sharp points, in either direction."""
    count = random.randint(3, 9)
    angles = sorted(random.uniform(0.0, 2.0 * np.pi) for _ in range(count))
    sizes = [random.choice((1.0, 4.0, 10.0)) for _ in angles]
    points = [(r * np.cos(a).item(), r * np.sin(a).item()) for r, a in zip(sizes, angles, strict=True)]
    bulges = [random.choice((0.0, 0.0, 0.05, -0.05, 0.2)) for _ in points]
    points.append(points[0])
    if random.random() < 0.5:
        points, bulges = points[::-1], [-bulge for bulge in reversed(bulges)]
    return Chain(tuple(points), tuple(bulges)).path()


@pytest.mark.parametrize("seed", range(20))
def test_moves_near_closed_outlines_are_on_the_expected_side(seed: int) -> None:
    random = Random(seed)
    outline = star(random)
    if judge(outline, Side.LEFT, 0.01, lines((50, 50), (51, 50))).crosses_itself:
        outline = lines((0, 0), (9, 0), (9, 9), (4.5, 4.6), (0, 9), (0, 0))
    room_is_left_inside = oracle.turning(outline) > 0.0
    for _ in range(12):
        x, y = random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)
        move = lines((x, y), (x + 0.02, y))
        if oracle.least(move, outline, 0.01) < 0.1:
            continue
        inside = oracle.inside(move, outline, 0.001)
        for side in Side:
            wrong = inside != (room_is_left_inside == (side is Side.LEFT))
            assert judge(outline, side, 0.05, move).wrong_side == ((0,) if wrong else ())


@pytest.mark.parametrize("seed", range(20))
def test_leads_far_from_a_closed_outline_are_on_the_expected_side(seed: int) -> None:
    """A lead is on the wrong side if any part of it is inside the part."""
    random, checked = Random(seed), 0
    outline, radius = star(random), random.choice((0.005, 0.05, 0.3))
    if judge(outline, Side.LEFT, 0.01, lines((50, 50), (51, 50))).crosses_itself:
        outline = lines((0, 0), (9, 0), (9, 9), (4.5, 4.6), (0, 9), (0, 0))
    room_is_left_inside = oracle.turning(outline) > 0.0
    for side in Side:
        path = compensate(outline, side, radius, 20, closed=True).path
        ends = path.points[[0, -1]].tolist() if len(path) else [(0.1, 0.1), (0.2, 0.2)]
        far = [(x + random.gauss(0.0, 2.0), y + random.gauss(0.0, 2.0)) for x, y in ends]
        leads = lines(far[0], tuple(ends[0])), lines(tuple(ends[1]), far[1])
        center = Path.from_pieces([*leads[0], *path, *leads[1]]) if len(path) else leads[0]
        for judged_side in Side:
            room_inside = room_is_left_inside == (judged_side is Side.LEFT)
            wrong_side = judge(outline, judged_side, radius, center).wrong_side
            for row, lead in zip((0, len(center) - 1), leads if len(path) else leads[:1], strict=False):
                points, _ = oracle.samples(lead, 0.005)
                in_part = oracle.encloses(outline, points) != room_inside
                apart = oracle.apart(points, outline)
                # between samples 0.005 apart a lead can only cross walls within half that distance of a sample
                if (in_part & (apart > 0.01)).any() or (not in_part.any() and apart.min() > 0.0026):
                    checked += 1
                    assert (row in wrong_side) == in_part.any()
    assert checked >= 2


HOOK = Path.from_pieces([Line((0, 0), (10, 0)), Arc((10, 0), (10, 4), (10, 2), Turn.CCW), Line((10, 4), (3, 4))])


@pytest.mark.parametrize(
    ("move", "left", "right"),
    [
        (lines((4, 2), (6, 2.1)), True, False),
        (lines((4, -1), (6, -1)), False, True),
        (lines((13, 2), (14, 2)), False, True),
        (lines((5, 6), (7, 6)), False, True),
        (lines((-1, 1), (-1, -1)), True, True),
        (lines((2, 5), (2, 4)), True, True),
    ],
)
def test_moves_near_an_open_hook_are_on_the_expected_side(move: Path, left: bool, right: bool) -> None:
    for change in (lambda path: path, lambda path: moved(path, 2.0, (100.0, -50.0))):
        assert judge(change(HOOK), Side.LEFT, 0.5, change(move)).clean == left
        assert judge(change(HOOK), Side.RIGHT, 0.5, change(move)).clean == right
    assert judge(mirrored(HOOK), Side.RIGHT, 0.5, mirrored(move)).clean == left


def test_a_path_around_the_end_of_a_wall_is_on_the_wrong_side_behind_it() -> None:
    wall = lines((0, 0), (10, 0))
    path = lines((5, 1), (12, 1), (12, -4), (5, -4), (4, -4))
    assert judge(wall, Side.LEFT, 1.0, path).wrong_side == (2, 3)


def test_a_gouging_move_behind_a_wall_is_on_the_wrong_side_too() -> None:
    verdict = judge(lines((0, 0), (10, 0)), Side.LEFT, 1.0, lines((5, -0.5), (6, -0.5)))
    assert verdict.depth == pytest.approx(1.5)
    assert verdict.wrong_side == (0,)


def test_a_line_out_and_back_has_room_on_both_sides() -> None:
    spike = lines((0, 0), (10, 0), (0, 0))
    around = lines((5, 1), (12, 1), (12, -1), (5, -1))
    assert judge(spike, Side.RIGHT, 0.5, around).clean
    assert judge(spike, Side.LEFT, 0.5, around).clean


def test_a_short_over_run_has_no_side_and_a_long_one_has_one() -> None:
    loop = lines((-30, 0), (2, 0), (2, 2), (0, 2), (0, -1))
    behind = lines((-20, 1), (-19, 1))
    assert judge(loop, Side.RIGHT, 0.25, behind).wrong_side == (0,)
    over_run = lines((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1))
    assert judge(over_run, Side.RIGHT, 0.25, lines((-0.6, 0.3), (-0.5, 0.3))).clean
