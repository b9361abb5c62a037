"""Crossings found by boxes and stretches are those of all pairs tested one by one."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.crossings import crossings
from core.comp.offset import RawChain, RawPart, offset
from core.geometry.intersect import MeetingKind, meet
from core.geometry.path import Path
from core.geometry.piece import Side
from tests.core.comp.contours import lines, mixed, polygons


def _all_pairs(chain: RawChain, lookahead: int, *, closed: bool) -> list[tuple[int, int]]:
    """Pairs of partners that are not path neighbors and within reach, in order of b, then a."""
    partners = [row for row, part in enumerate(chain.parts.tolist()) if part <= RawPart.CORNER]
    pairs = [
        (a, b)
        for a, b in combinations(partners, 2)
        if b - a > 1
        and chain.half_steps[b] - chain.half_steps[a] <= 2 * lookahead
        and not (b - a == 2 and chain.parts[a + 1] == RawPart.BRIDGE)
        and not (closed and (a, b) == (0, len(chain) - 1))
    ]
    return sorted(pairs, key=lambda pair: pair[::-1])


@settings(max_examples=100, deadline=None, derandomize=True)
@given(mixed | polygons, st.sampled_from(Side), st.floats(0.05, 2.0), st.integers(1, 20), st.booleans())
def test_all_pairs_within_reach_are_found(contour, side, radius, lookahead, closed):
    chain = offset(contour, side, radius)
    found = crossings(chain, 20, closed=closed).within(lookahead)
    pairs = np.array(_all_pairs(chain, lookahead, closed=closed), np.intp).reshape(-1, 2)
    met = meet(chain.raw, pairs[:, 0], chain.raw, pairs[:, 1])
    crossing = met.kinds[met.pair] == MeetingKind.CROSS
    assert np.array_equal(found.a, pairs[met.pair[crossing], 0])
    assert np.array_equal(found.b, pairs[met.pair[crossing], 1])
    assert np.array_equal(found.along_a, met.along_a[crossing])


@settings(max_examples=100, deadline=None, derandomize=True)
@given(mixed | polygons, st.sampled_from(Side), st.floats(0.05, 2.0), st.booleans())
def test_joints_are_found_at_every_lookahead(contour, side, radius, closed):
    chain = offset(contour, side, radius)
    bridges = np.flatnonzero(chain.parts == RawPart.BRIDGE)
    bridges = bridges[(chain.parts[bridges - 1] == RawPart.SEGMENT) & (chain.parts[bridges + 1] == RawPart.SEGMENT)]
    met = meet(chain.raw, bridges - 1, chain.raw, bridges + 1)
    joints = crossings(chain, 1, closed=closed).joints
    assert np.array_equal(joints.b, bridges[met.pair] + 1)
    assert np.array_equal(joints.along_a, met.along_a)


def test_crossings_do_not_depend_on_where_a_long_chain_is_cut():
    tooth = [(0.0, 0.0), (2.0, 0.0), (2.0, -0.3), (2.3, -0.3), (2.3, 0.0)]
    points = [(x + 4.0 * row, y) for row in range(3000) for x, y in tooth]
    chain = offset(lines(*points), Side.LEFT, 0.25)
    found = crossings(chain, 8, closed=False).others
    assert len(found) == 3000 - 1
    assert (np.diff(found.b) > 0).all()
    assert set((found.b - found.a).tolist()) == {int(found.b[0] - found.a[0])}


def test_cutter_that_just_fits_touches_and_does_not_cross():
    slot = lines((0, 0), (2, 0), (2, -1), (2.5, -1), (2.5, 0), (5, 0))
    chain = offset(slot, Side.LEFT, 0.25)
    assert not len(crossings(chain, 20, closed=False).others)


def test_first_and_last_of_a_closed_contour_are_no_pair():
    contour: Path = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
    chain = offset(contour, Side.LEFT, 0.25)
    assert not len(crossings(chain, 20, closed=True).others)
    assert len(crossings(chain, 20, closed=False).others) == 1
