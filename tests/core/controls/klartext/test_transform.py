"""Mirror images and rotations place the contour before the tool radius is added."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry.piece import Side
from tests.core.controls.klartext.klartext_runs import clean, flat, runs

NEAR = pytest.approx
PART = (
    "L X-30 Y-30 R0 FMAX",
    "L Z-5 F200",
    "APPR CT X-20 Y+0 CCA90 R+8 RL F300",
    "L Y+20",
    "RND R5",
    "L IX+40",
    "L Y-20 M97",
    "CC X+0 Y-20",
    "C X-20 Y-20 DR-",
    "LP PR+20 PA+180",
    "L Y+0",
    "DEP LCT X-30 Y-30 R8",
)
DATUM = ("CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+100", "CYCL DEF 7.2 Y+50")


def test_a_contour_turned_by_90_degrees_by_hand() -> None:
    """About X100 Y50, X10 Y0 comes to X100 Y60 and X30 Y0 to X100 Y80; the tool of 5 runs on the left of it, at X95."""
    blocks = (
        "CYCL DEF 10.0 ROTATION",
        "CYCL DEF 10.1 ROT+90",
        "L X+0 Y+0 R0 FMAX",
        "L X+10 RL F9",
        "L X+30",
        "L X+50 R0",
    )
    made = clean(*DATUM, *blocks)
    assert flat(made, 1) == [(100, 50), (95, 60), (95, 80), (100, 100)]


def test_a_mirrored_contour_by_hand() -> None:
    """X10 comes to X90, and the tool runs on the other side of the contour, at the same Y."""
    blocks = ("CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X", "L X+0 Y+0 R0 FMAX", "L X+10 RL F9", "L X+30", "L X+50 R0")
    made = clean(*DATUM, *blocks)
    assert flat(made, 1) == [(100, 50), (90, 55), (70, 55), (50, 50)]
    assert [stretch.side for stretch in made.stretches] == [Side.RIGHT]


@pytest.mark.parametrize(
    ("cycle", "matrix", "turn"),
    [
        ("CYCL DEF 10.1 ROT+30", ((0.75**0.5, -0.5), (0.5, 0.75**0.5)), 1),
        ("CYCL DEF 10.1 IROT-90", ((0, 1), (-1, 0)), 1),
        ("CYCL DEF 8.1 X", ((-1, 0), (0, 1)), -1),
        ("CYCL DEF 8.1 Y", ((1, 0), (0, -1)), -1),
        ("CYCL DEF 8.1 X Y", ((-1, 0), (0, -1)), 1),
    ],
)
def test_the_whole_path_is_mirrored_or_turned_about_the_datum(
    cycle: str, matrix: tuple[tuple[float, float], ...], turn: int
) -> None:
    plain, moved = clean(*PART).moves, clean(*DATUM, cycle, *PART).moves
    expected = plain.points.copy()
    expected[1:, :2] = plain.points[1:, :2] @ np.array(matrix).T + (100.0, 50.0)
    assert len(moved) == len(plain) > 12
    assert np.abs(moved.points - expected).max() < 1e-9
    assert (moved.turns == turn * plain.turns).all()


def test_the_tool_stays_where_it_is_when_a_rotation_begins_or_ends() -> None:
    blocks = ("L X+10 Y+0 FMAX", "CYCL DEF 10.1 ROT+90", "L IX+5 FMAX", "CYCL DEF 10.1 ROT+0", "L IX+5 FMAX")
    assert flat(clean(*blocks), 1) == [(10, 0), NEAR((10, 5)), NEAR((15, 5))]


def test_a_datum_may_move_before_the_rotation_about_it_ends() -> None:
    """The tool moves only after both; example 10.11 of the TNC 426 manual ends them in the other order."""
    blocks = ("CYCL DEF 10.1 ROT+90", "L X+10 Y+0 FMAX", "CYCL DEF 7.1 X+0", "CYCL DEF 7.2 Y+0", "CYCL DEF 10.1 ROT+0")
    assert flat(clean(*DATUM, *blocks, "L X+1 Y+2 FMAX"), 1) == [(100, 60), (1, 2)]


def test_incremental_rotations_add_up() -> None:
    made = clean("CYCL DEF 10.1 IROT+30", "CYCL DEF 10.1 IROT+60", "L X+10 Y+0 FMAX")
    assert flat(made, 1) == [NEAR((0, 10))]


def test_a_mirror_image_of_what_has_become_the_tool_axis_stops_the_run() -> None:
    """Taken over by its place in the plane, the mirror image of X would have become one of Y."""
    made = runs("CYCL DEF 8.1 X", "TOOL CALL 1 X S1000", "CYCL DEF 10.1 ROT+0", "L Y+10 Z+0 FMAX")
    assert [(finding.code, finding.line) for finding in made.findings][-1] == ("BEYOND", 6)
    assert made.stopped_at == 6
