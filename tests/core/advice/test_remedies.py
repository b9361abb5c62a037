"""Remedies by themselves: another start, and the largest tool."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.advice.lookahead_table import CuttingSetup, judge_lookaheads
from core.advice.remedies import (
    largest_tool,
    lookahead_without_blends,
    restarted,
    start_mid_side,
)
from core.geometry.piece import Side
from core.progress import Stopped
from tests.core.comp.contours import lines, mixed, shut

DIAMETER_STEP = 0.001
"""Millimeters, as a screen in millimeters shows them."""

SLOT = lines((0, 2), (0, 0), (0.4, 0), (0.4, 2))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(mixed.map(shut), st.integers(0, 30))
def test_a_contour_started_elsewhere_is_the_same_contour(contour, row):
    row %= len(contour)
    other = restarted(contour, row)
    assert len(other) == len(contour) + 1
    assert other.points[0].tolist() == other.points[-1].tolist()
    assert other.lengths.sum() == pytest.approx(contour.lengths.sum(), rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("width", [0.2005, 0.3999, 0.4999])
def test_the_largest_tool_is_rounded_down(width):
    slot = lines((0, 2), (0, 0), (width, 0), (width, 2))
    found = largest_tool(CuttingSetup(slot, Side.LEFT, 0.25, False, 0.0, 0.0))
    assert found is not None
    assert width - DIAMETER_STEP < found.diameter <= width
    assert round(found.diameter / DIAMETER_STEP) * DIAMETER_STEP == pytest.approx(found.diameter, abs=1e-12)


def test_the_largest_tool_of_an_inch_program_is_one_that_its_screen_shows():
    inch_digit = 0.00254
    found = largest_tool(CuttingSetup(SLOT, Side.LEFT, 0.25, False, 0.0, 0.0, diameter_step=inch_digit))
    assert found is not None
    assert found.diameter == pytest.approx(157 * inch_digit)


def test_no_tool_is_looked_for_that_is_as_large_as_the_one_in_force():
    asked = CuttingSetup(SLOT, Side.LEFT, 0.25, False, 0.0, 0.0)
    assert largest_tool(asked, least=500) is None
    assert largest_tool(asked, least=401) is None
    assert largest_tool(asked, least=400).diameter == pytest.approx(0.4)


def test_a_start_in_the_middle_is_for_closed_contours_only():
    square = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
    asked = CuttingSetup(square, Side.LEFT, 0.25, True, 0.0, 0.0)
    found = start_mid_side(asked)
    assert (found.segment, found.at) == (1.0, (1.0, 0.0))
    assert found.value == judge_lookaheads(replace(asked, surface=restarted(square, 0))).recommended
    assert start_mid_side(replace(asked, closed=False)) is None
    assert start_mid_side(asked, max_starts=0) is None


@pytest.mark.parametrize("blend", [0.0, 0.5])
def test_blend_moves_are_left_out_only_where_there_are_any(blend):
    channel = lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6))
    assert lookahead_without_blends(CuttingSetup(channel, Side.LEFT, 0.25, False, blend, 0.0)) == (1 if blend else None)


def test_a_remedy_nobody_waits_for_is_not_tried():
    def canceled(_: float) -> None:
        raise Stopped

    with pytest.raises(Stopped):
        largest_tool(CuttingSetup(SLOT, Side.LEFT, 0.25, False, 0.0, 0.0), canceled)
