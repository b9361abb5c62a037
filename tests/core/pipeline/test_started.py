"""A contour that is started elsewhere."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.advice.remedies import middle, started
from core.geometry.piece import Arc, Turn
from tests.core.comp.contours import mixed, shut


def test_the_middle_of_an_arc_lies_on_it():
    assert middle(Arc((1, 0), (-1, 0), (0, 0), Turn.CCW)) == pytest.approx((0, 1))
    assert middle(Arc((1, 0), (-1, 0), (0, 0), Turn.CW)) == pytest.approx((0, -1))
    assert middle(Arc((1, 0), (1, 0), (0, 0), Turn.CW)) == pytest.approx((-1, 0))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(mixed.map(shut), st.integers(0, 30))
def test_a_contour_started_elsewhere_is_the_same_contour(contour, row):
    row %= len(contour)
    other = started(contour, row)
    assert len(other) == len(contour) + 1
    assert other.points[0].tolist() == other.points[-1].tolist()
    assert other.lengths.sum() == pytest.approx(contour.lengths.sum(), rel=1e-9, abs=1e-6)
