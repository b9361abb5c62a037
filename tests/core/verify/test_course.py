"""Courses that are worked out together are those that are worked out alone."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.path import EMPTY, Path
from core.verify import course as module
from core.verify.columns import STRAIGHT, Columns
from core.verify.course import Course, courses
from tests.core.verify.shapes import lines, paths

NOWHERE = lines((1.0, 1.0), (1.0, 1.0), (1.0, 1.0))


@settings(deadline=None, max_examples=100, derandomize=True)
@given(st.lists(st.lists(st.one_of(paths(), st.sampled_from((EMPTY, NOWHERE))), max_size=3), min_size=1, max_size=4))
def test_together_is_as_alone(groups: list[list[Path]]) -> None:
    together = tuple(courses(*groups))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "FEW", -1)
        alone = tuple(courses(*groups))
    assert len(together) == len(alone) == len(groups)
    for one, other in zip(together, alone, strict=True):
        assert _same(one, other)


def _same(one: Course, other: Course) -> bool:
    for field in fields(one.pieces):
        assert np.array_equal(getattr(one.pieces, field.name), getattr(other.pieces, field.name))
    bent = one.pieces.arcs
    for rows, count in (((~bent).nonzero()[0][::-1], STRAIGHT), (bent.nonzero()[0][::2], len(Columns._fields))):
        if len(rows):
            columns = one.columns_at(rows, count)
            assert np.array_equal(columns, other.columns_at(rows, count))
            assert np.array_equal(columns, other.whole().columns_at(rows, count))
    return np.array_equal(one.stations, other.stations) and np.array_equal(one.boxes, other.boxes)
