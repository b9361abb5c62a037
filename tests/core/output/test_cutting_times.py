from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from core.geometry.piece import Turn
from core.output.passes import Times, block_times, minutes_text, program_times, times_text
from tests.core.output.jobs import INCH, arc, floors, job, path_of, polyline

SLOT = job(polyline((0, 0), (2, 0)), peck_depth=0.0)
"""From SAFE Z 1.0 at rapid to 0.1, at 20 in/min to -0.25, 2.0 at 10 in/min, at rapid back to 1.0."""


def test_a_slot_takes_what_a_hand_calculation_says():
    times = block_times(SLOT, 200.0 * INCH)
    assert times.cut == pytest.approx(0.35 / 20.0 + 2.0 / 10.0)
    assert times.rapid == pytest.approx((0.9 + 1.25) / 200.0)
    assert times.total == pytest.approx(times.cut + times.rapid)


def test_an_arc_takes_its_length_and_not_its_chord():
    half = job(path_of(arc((0, 0), (2, 0), (1, 0), Turn.CW)), peck_depth=0.0)
    assert block_times(half, 200.0 * INCH).cut == pytest.approx(0.35 / 20.0 + pi / 10.0)


def test_half_the_feed_takes_twice_as_long():
    slower = replace(SLOT, floors=floors(len(SLOT.floors), feed=5.0))
    assert block_times(slower, 200.0 * INCH).cut == pytest.approx(0.35 / 20.0 + 2.0 / 5.0)


def test_a_program_also_takes_the_rapids_from_block_to_block():
    far = job(polyline((50, 0), (52, 0)), peck_depth=0.0)
    one = block_times(SLOT, 200.0 * INCH)
    both = program_times([SLOT, far], 200.0 * INCH)
    assert both.cut == pytest.approx(2.0 * one.cut)
    # from X 2 to X 50
    assert both.rapid == pytest.approx(2.0 * one.rapid + 48.0 / 200.0)


def test_a_program_moves_at_the_highest_safe_z_of_its_blocks():
    higher = replace(SLOT, safe_z=2.0 * INCH)
    both = program_times([SLOT, higher], 200.0 * INCH)
    # 1.0 more up and 1.0 more down than the first block alone, and back from X 2 to X 0
    assert both.rapid == pytest.approx(2.0 * block_times(higher, 200.0 * INCH).rapid + 2.0 / 200.0)


@pytest.mark.parametrize(
    ("minutes", "text"),
    [(0.0, "0:00"), (0.2175, "0:13"), (2.0 + 5 / 60, "2:05"), (62.0, "1:02:00"), (float("inf"), "-")],
)
def test_minutes_are_shown_with_seconds_and_hours(minutes, text):
    assert minutes_text(minutes) == text


def test_cut_rapid_and_total_stand_in_one_line():
    assert times_text(Times(3.5, 0.2)) == "cut 3:30, rapid 0:12, total 3:42"


def test_cut_and_rapid_add_up_to_the_total():
    assert times_text(Times(66.7 / 60, 0.6 / 60)) == "cut 1:07, rapid 0:00, total 1:07"
    assert times_text(Times(0.5, float("inf"))) == "cut 0:30, rapid -, total -"
