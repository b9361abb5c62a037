"""Every look-ahead value of a contour, cut and judged."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import pytest

from core.advice.lookahead_table import CuttingSetup, Row, judge_lookaheads, recommended
from core.geometry.piece import Side
from core.verify.judge import judge
from tests.core.comp.contours import lines

NOTCH = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
SETUP = CuttingSetup(NOTCH, Side.LEFT, 0.25, False, 0.0, 0.0)
SLOT = CuttingSetup(lines((0, 0), (40, 0), (40, -5), (52, -5), (52, 0), (90, 0)), Side.LEFT, 4.0, False, 0.0, 0.0)


def test_the_table_has_a_row_for_every_value_with_its_path_and_verdict():
    table = judge_lookaheads(SETUP)
    assert [row.value for row in table.rows] == list(range(1, 21))
    assert [row.clean for row in table.rows] == [False] * 2 + [True] * 18
    assert table.recommended == 3
    for value in (1, 2, 3, 20):
        row = table.row(value)
        verdict = judge(NOTCH, Side.LEFT, 0.25, row.compensated.with_leads)
        assert (row.gouge, row.uncut) == (verdict.depth, verdict.uncut_length)
        assert row.value == row.compensated.lookahead == value
    assert table.row(3).deleted == (2.0, 3.0, 4.0)
    assert table.row(2).gouge > 0.2
    assert (table.notes, table.complete) == ((), False)


def test_roughing_passes_count_with_the_radius_of_their_own_tool():
    plain = judge_lookaheads(SLOT)
    assert plain.recommended == 1
    table = judge_lookaheads(replace(SLOT, stocks=(8.0,)))
    assert [row.clean for row in table.rows[:3]] == [False, False, True]
    assert table.recommended == 3
    assert table.row(1).gouge == pytest.approx(4.0, abs=0.5)
    assert table.row(1).verdict.clean
    wider = judge_lookaheads(replace(SLOT, stocks=(0.5,), rougher=12.0))
    assert wider.row(1).gouge > plain.row(1).gouge
    assert len(wider.row(1).rough) == 1


def test_progress_goes_from_pass_to_pass_to_the_end():
    shares: list[float] = []
    known: list[tuple[Row, ...]] = []
    table = judge_lookaheads(replace(SLOT, stocks=(8.0, 4.0)), shares.append, known.append)
    assert [len(rows) for rows in known] == sorted(len(rows) for rows in known)
    assert len(known) > 1
    assert all(len(row.rough) == 2 for row in known[0]), "a row is complete with its roughing passes"
    assert known[-1] == table.rows
    assert shares == sorted(shares)
    assert all(any(0 <= share - third / 3 <= 1 / 3 for share in shares) for third in range(3))
    assert shares[-1] <= 1.0


def test_blend_moves_are_part_of_what_is_judged():
    channel = CuttingSetup(lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6)), Side.LEFT, 0.25, False, 0.0, 0.0)
    assert judge_lookaheads(channel).recommended == 1
    assert judge_lookaheads(replace(channel, blend=0.5)).recommended is None


def test_a_contour_without_a_path_is_clean_at_no_value():
    hole = CuttingSetup(lines((0, 0), (1, 0), (1, 1), (0, 1), (0, 0)), Side.LEFT, 3.0, True, 0.0, 0.0)
    assert not any(row.clean for row in judge_lookaheads(hole).rows)


def test_the_effect_of_a_clean_value_names_what_stays_or_is_deleted():
    """The notch stays uncut; of one too shallow to be uncut only the steps are deleted."""
    text, lengths = judge_lookaheads(SETUP).row(3).effect
    assert text == "does not gouge but leaves {0} uncut"
    assert lengths == pytest.approx((0.9,))
    step = lines((0, 0), (2, 0), (2, -1e-5), (2.3, -1e-5), (2.3, 0), (5, 0))
    assert judge_lookaheads(replace(SETUP, surface=step)).row(2).effect == (
        "does not gouge but deletes segments 2 and 4",
        (),
    )
    wall = lines((0, 0), (2, 0), (2, 3))
    assert judge_lookaheads(replace(SETUP, surface=wall, side=Side.RIGHT)).row(3).effect == ("is clean", ())


class Outcome(NamedTuple):
    value: int
    clean: bool
    uncut: float


@pytest.mark.parametrize(
    ("outcomes", "value"),
    [
        ([], None),
        ([Outcome(1, False, 0.0)], None),
        ([Outcome(1, False, 0.0), Outcome(2, True, 3.0), Outcome(3, True, 1.0), Outcome(4, True, 1.0)], 3),
        ([Outcome(3, True, 1.0 + 1e-8), Outcome(4, True, 1.0)], 3),
        ([Outcome(3, True, 1.0 + 1e-6), Outcome(4, True, 1.0)], 4),
        ([Outcome(20, True, 0.0), Outcome(1, True, 0.5)], 20),
    ],
)
def test_the_recommended_value_is_the_least_clean_one_that_leaves_least(outcomes, value):
    assert recommended(outcomes) == value
