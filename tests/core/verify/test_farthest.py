"""Where a path is farthest from another one, by a search that is over as soon as one piece is the nearest."""

from __future__ import annotations

from math import asin

import numpy as np
import pytest

from core.geometry.path import Path
from core.geometry.piece import Arc, Turn
from core.geometry.piece_arrays import piece_arrays
from core.verify import farthest as module
from core.verify.farthest import farthest
from core.verify.pairs import Intervals, pairs_of, rounding_of
from tests.core.verify.shapes import lines


@pytest.mark.parametrize("begin", [-3.0, -2.0, -0.1])
@pytest.mark.parametrize("floor", [lines((-10, 0), (10, 0)), lines((-10, 0), (-2.5, 0), (2.5, 0), (10, 0))])
def test_the_farthest_place_at_the_top_of_an_arc_needs_no_search(
    begin: float, floor: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One wall is nearest to both ends of what is left: it knows itself where it is farthest."""
    monkeypatch.setattr(module, "MAX_DIVISIONS", 4)
    walked = piece_arrays(
        Path.from_pieces([Arc((begin, (25 - begin**2) ** 0.5 - 3.0), (3.0, 1.0), (0.0, -3.0), Turn.CW)])
    )
    other, whole = piece_arrays(floor), Intervals(np.zeros(1), walked.length)
    far = farthest(pairs_of(walked, other, rounding_of(other)), whole)
    assert far.distance.item() == pytest.approx(2.0, abs=1e-14)
    assert far.place.item() == pytest.approx(5.0 * asin(-begin / 5.0), abs=1e-9)


@pytest.mark.parametrize("begin", [0.0, 0.4])
def test_between_two_walls_it_is_where_both_are_as_far(begin: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MAX_DIVISIONS", 2)
    walked, other = piece_arrays(lines((0, 0), (4, 0))), piece_arrays(lines((-1, -1), (-1, 9), (5, 9), (5, -1)))
    stretch = Intervals(np.array([begin]), walked.length)
    far = farthest(pairs_of(walked, other, rounding_of(other)), stretch)
    assert (far.place.item(), far.distance.item()) == pytest.approx((2.0, 3.0), abs=1e-12)
