"""The sample blocks of the shop's sheet with a tool of radius 5, against values worked out by hand.

The approaches go from (10, 10) to (30, 20), where the contour sets off to (40, 35): direction (2, 3) / sqrt 13, and
to its right, where RR has the tool, (3, -2) / sqrt 13.  The departures leave (30, 20), where the contour ends going
up; its right is +X.
"""

from __future__ import annotations

from math import hypot, sqrt

import pytest

from core.controls.control_run import ControlRun
from core.controls.klartext.control import run_klartext
from core.verify.judge import judge
from tests.core.controls.klartext.klartext_runs import DATA, flat

WAY = (2 / sqrt(13), 3 / sqrt(13))
RIGHT = (3 / sqrt(13), -2 / sqrt(13))
NEAR = pytest.approx


def sample(name: str) -> ControlRun:
    made = run_klartext((DATA / "klartext" / f"{name}.h").read_bytes(), {})
    assert made.stopped_at is None
    assert not made.findings
    return made


def off_the_line(distance: float, along: float = 0.0) -> tuple[float, float]:
    """The point right of (30, 20) by a distance, and so far along the contour."""
    return 30 + distance * RIGHT[0] + along * WAY[0], 20 + distance * RIGHT[1] + along * WAY[1]


def test_appr_lt_runs_the_length_along_the_contour_one_radius_next_to_it() -> None:
    moves = flat(sample("appr_lt"), 1)
    assert moves[0] == (10.0, 10.0)
    assert moves[1] == NEAR(off_the_line(5, -15), abs=1e-6)
    assert moves[2] == NEAR(off_the_line(5), abs=1e-6)
    assert moves[2] == NEAR((34.160251, 17.226499), abs=1e-6)
    assert moves[3] == NEAR(off_the_line(5, sqrt(325)), abs=1e-6)
    assert moves[4] == (60.0, 35.0)


def test_appr_ln_comes_square_from_length_and_radius_away() -> None:
    moves = flat(sample("appr_ln"), 1)
    assert moves[1] == NEAR(off_the_line(20), abs=1e-6)
    assert moves[2] == NEAR(off_the_line(5), abs=1e-6)


def test_appr_ct_comes_over_half_a_circle_clockwise() -> None:
    moves = flat(sample("appr_ct"), 1)
    assert moves[1] == NEAR(off_the_line(21), abs=1e-6)
    assert moves[2] == NEAR((*off_the_line(5), *off_the_line(13), -1), abs=1e-6)


def test_appr_lct_comes_by_a_line_and_an_arc_tangent_to_each_other() -> None:
    moves = flat(sample("appr_lct"), 1)
    cx, cy = off_the_line(15)
    reach = hypot(10 - cx, 10 - cy)
    along = sqrt(reach**2 - 100)
    vx, vy = (10 - cx) / reach, (10 - cy) / reach
    touch = (cx + 10 / reach * (10 * vx + along * vy), cy + 10 / reach * (10 * vy - along * vx))
    assert moves[1] == NEAR(touch, abs=1e-6)
    assert moves[1] == NEAR((38.918847, 21.023630), abs=1e-6)
    assert moves[2] == NEAR((*off_the_line(5), cx, cy, -1), abs=1e-6)


@pytest.mark.parametrize("name", ["appr_lt", "appr_ln", "appr_ct"])
def test_the_way_to_the_lead_is_as_fast_as_the_block_before(name: str) -> None:
    moves = sample(name).moves
    assert moves[2].rapid
    assert not moves[3].rapid
    assert moves[3].feed == 200.0


def test_appr_lct_runs_at_its_own_feed_from_its_start() -> None:
    moves = sample("appr_lct").moves
    assert [(moves[row].rapid, moves[row].feed) for row in (2, 3)] == [(False, 200.0)] * 2


DEPARTURES: dict[str, list[tuple[float, ...]]] = {
    "dep_lt": [(35.0, 32.5)],
    "dep_ln": [(55.0, 20.0)],
    "dep_ct": [(51.0, 20.0, 43.0, 20.0, -1)],
    "dep_lct": [(43.0, 12.0, 43.0, 20.0, -1), (10.0, 12.0)],
}


@pytest.mark.parametrize("name", DEPARTURES)
def test_departures(name: str) -> None:
    moves = flat(sample(name))
    assert moves[0] == NEAR((50.0, 5.0), abs=1e-6)
    assert moves[1] == NEAR((35.0, 5.0), abs=1e-6)
    assert moves[2] == NEAR((35.0, 20.0), abs=1e-6)
    assert moves[3:] == [NEAR(want, abs=1e-6) for want in DEPARTURES[name]]


@pytest.mark.parametrize("name", DEPARTURES)
def test_a_departure_runs_at_the_feed_in_force_and_ends_compensation(name: str) -> None:
    made = sample(name)
    assert not any(move.rapid for move in list(made.moves)[2:])
    (stretch,) = made.stretches
    assert (stretch.entry, stretch.exit, stretch.radius, stretch.side.value) == (1, 1, 5.0, "RIGHT")
    assert (stretch.first, stretch.last) == (1, len(made.moves))


def test_a_program_with_one_of_everything_runs_to_its_end() -> None:
    made = run_klartext((DATA / "klartext" / "part.h").read_bytes(), {})
    assert made.stopped_at is None, made.findings
    assert {finding.code for finding in made.findings} == {"IGNORED", "TOOL"}
    assert [stretch.radius for stretch in made.stretches] == [NEAR(4.0)] * 2
    first, second = made.stretches
    surface = first.programmed.part(first.entry, len(first.programmed) - first.exit).path()
    assert judge(surface, first.side, first.radius, made.moves.part(first.first, first.last).path()).clean
    around = made.moves.part(second.first, second.last)
    assert [move.turn for move in around][2:] == [1, 1, 1, 1]
    assert around[2].point == NEAR((57, 40, 1))
    assert around[4].point == NEAR((57, 40, -3))
