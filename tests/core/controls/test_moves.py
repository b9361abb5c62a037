"""The neutral moves."""

from __future__ import annotations

from math import pi

import pytest

from core.controls.moves import Plane, Tape, flat, solid


def tape() -> Tape:
    made = Tape()
    made.straight((1.0, 0.0, 5.0), 0.0, 1, rapid=True)
    made.straight((1.0, 0.0, 0.0), 100.0, 2)
    made.arc((3.0, 0.0, -1.0), (2.0, 0.0, -1.0), -1, Plane.XY, 200.0, 3)
    made.arc((3.0, 0.0, -1.0), (3.0, 0.0, 0.0), 1, Plane.ZX, 200.0, 4)
    return made


def test_the_start_point_is_a_rapid_of_line_0() -> None:
    first = tape().moves()[0]
    assert (first.point, first.rapid, first.line) == ((0.0, 0.0, 0.0), True, 0)


def test_moves_read_back_as_recorded() -> None:
    moves = tape().moves()
    assert len(moves) == 5
    assert tape().last == (3.0, 0.0, -1.0)
    arc = moves[3]
    assert (arc.turn, arc.plane, arc.feed, arc.line) == (-1, Plane.XY, 200.0, 3)
    assert arc.center == (2.0, 0.0, -1.0)


def test_a_tape_goes_on_after_its_moves_were_asked_for() -> None:
    made = Tape((1.0, 2.0, 3.0))
    before = made.moves()
    made.straight((4.0, 5.0, 6.0), 10.0, 1)
    assert (len(before), len(made.moves()), before[0].point) == (1, 2, (1.0, 2.0, 3.0))


def test_a_tape_takes_moves_back() -> None:
    made = tape()
    made.straight((4.0, 5.0, 6.0), 10.0, 5)
    made.cut(5)
    assert made.last == tape().last
    assert len(made) == 5


def test_a_plane_s_path_leaves_out_what_stands_on_it() -> None:
    path = tape().moves().path()
    assert path.numbers.tolist() == [1.0, 3.0]
    assert path.turns.tolist() == [0, -1]
    assert path.sweeps.tolist() == pytest.approx([0.0, -pi])
    circle = tape().moves().path(Plane.ZX)
    assert circle.turns.tolist()[-1] == 1
    assert abs(float(circle.sweeps[-1])) == pytest.approx(2 * pi)


@pytest.mark.parametrize("plane", Plane)
def test_points_go_into_a_plane_and_back(plane: Plane) -> None:
    assert solid(*flat((1.0, 2.0, 3.0), plane), plane) == (1.0, 2.0, 3.0)


def test_moves_cannot_be_changed() -> None:
    moves = tape().moves()
    with pytest.raises(ValueError, match="read-only"):
        moves.points[0, 0] = 1.0
