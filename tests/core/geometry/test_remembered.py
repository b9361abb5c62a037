"""Remembered: the same numbers asked again get the same answer, and any other number a new one."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Line, Turn
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.geometry.remembered import FEW, remembered

BENT = Arc((4.0, 0.0), (6.0, 2.0), center=(4.0, 2.0), turn=Turn.CCW)
PIECES = piece_arrays(Path.from_pieces([Line((0.0, 0.0), (4.0, 0.0)), BENT]))


class FarEnds:
    """A formula that counts how often it is asked."""

    def __init__(self) -> None:
        self.asked = 0
        self.of: Callable[..., tuple[Floats, ...]] = remembered(self._far_ends)

    def _far_ends(self, pieces: PieceArrays, more: Floats) -> tuple[Floats, ...]:
        self.asked += 1
        return (np.abs(pieces.end) + more,)


@pytest.fixture
def far_ends() -> FarEnds:
    return FarEnds()


def test_the_same_numbers_are_worked_out_once(far_ends: FarEnds) -> None:
    more = np.array((1.0, 2.0))
    (first,) = far_ends.of(PIECES, more)
    (again,) = far_ends.of(PIECES.take(np.arange(2)), more.copy())
    assert again is first
    assert far_ends.asked == 1
    assert first.tolist() == [5.0, np.hypot(6.0, 2.0) + 2.0]


def test_rows_do_not_matter(far_ends: FarEnds) -> None:
    (first,) = far_ends.of(PIECES, np.zeros(2))
    assert far_ends.of(replace(PIECES, rows=PIECES.rows + 7), np.zeros(2))[0] is first


@pytest.mark.parametrize("name", ["start", "vector", "arm", "turn", "angle", "radius", "length", "slack"])
def test_the_last_bit_of_any_number_asks_anew(far_ends: FarEnds, name: str) -> None:
    far_ends.of(PIECES, np.zeros(2))
    numbers = getattr(PIECES, name).copy()
    parts = numbers.view(np.float64)
    parts[-1] = np.nextafter(parts[-1], 9.0)
    other = replace(PIECES, **{name: numbers})
    (found,) = far_ends.of(other, np.zeros(2))
    assert far_ends.asked == 2
    assert found.tolist() == np.abs(other.end).tolist()


def test_the_last_bit_of_any_array_asks_anew(far_ends: FarEnds) -> None:
    for smallest in (0.0, 5e-324, -0.0):
        far_ends.of(PIECES, np.array((0.0, smallest)))
    assert far_ends.asked == 3


def test_other_pieces_than_before_are_asked_for_anew(far_ends: FarEnds) -> None:
    far_ends.of(PIECES, np.zeros(2))
    (turned,) = far_ends.of(PIECES.take(np.array((1, 0))), np.zeros(2))
    (one,) = far_ends.of(PIECES.take(np.array((0,))), np.zeros(1))
    assert turned.tolist() == [np.hypot(6.0, 2.0), 4.0]
    assert one.tolist() == [4.0]


def test_two_formulas_do_not_answer_for_each_other(far_ends: FarEnds) -> None:
    other = FarEnds()
    far_ends.of(PIECES, np.zeros(2))
    other.of(PIECES, np.zeros(2))
    assert (far_ends.asked, other.asked) == (1, 1)


def test_an_answer_that_is_kept_cannot_be_written_to(far_ends: FarEnds) -> None:
    (found,) = far_ends.of(PIECES, np.zeros(2))
    with pytest.raises(ValueError, match="read-only"):
        found[0] = 0.0


def test_many_pieces_are_not_kept(far_ends: FarEnds) -> None:
    many = PIECES.take(np.arange(FEW + 1) % 2)
    for _ in range(2):
        far_ends.of(many, np.zeros(FEW + 1))
    assert far_ends.asked == 2
