"""What gouges beyond doubt: no look-ahead is clean there, and no judge says otherwise."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensate import compensate_all
from core.geometry.piece import Side
from core.pipeline.beginning import Walls, gouge_at_once, gouging
from core.pipeline.derive import derive
from core.pipeline.remedies import started
from core.pipeline.table import Trial, table_of, trial_of
from core.verify.judge import rulings
from tests.bench.keys import gear
from tests.core.comp.contours import lines, mixed, shut

SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
SIDES = st.sampled_from(Side)
RADII = st.sampled_from([0.05, 0.1, 0.25, 0.5]) | st.floats(0.02, 1.5)
BLENDS = st.sampled_from([0.0, 0.1, 0.3, 1.0])
OVERLAPS = st.sampled_from([0.0, 0.05, 0.3])


def at_once(trial: Trial) -> bool:
    (found,) = gouge_at_once([trial], Walls.of(trial.surface), [(0, len(trial.surface) - 1)])
    return found


def test_an_inside_corner_gouges_where_it_is_the_start():
    assert at_once(Trial(SQUARE, Side.LEFT, 0.25, True, 0.0, 0.0))
    assert not at_once(Trial(started(SQUARE, 0), Side.LEFT, 0.25, True, 0.0, 0.0))
    assert not at_once(Trial(SQUARE, Side.RIGHT, 0.25, True, 0.0, 0.0))


def test_a_start_nearer_to_another_wall_than_the_radius():
    slot = lines((0, 2), (0, 0), (0.4, 0), (0.4, 2))
    assert not at_once(Trial(slot, Side.LEFT, 0.2, False, 0.0, 0.0))
    assert at_once(Trial(slot, Side.LEFT, 0.2005, False, 0.0, 0.0))


def test_blend_moves_across_a_channel():
    channel = lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6))
    assert at_once(Trial(channel, Side.LEFT, 0.25, False, 0.5, 0.0))
    assert not at_once(Trial(channel, Side.LEFT, 0.25, False, 0.05, 0.0))


def test_an_overlap_leads_out_behind_the_start():
    """The way out begins where the overlap ends: beside a rib there, and not beside it without the overlap."""
    ribbed = lines((-1, 0), (4, 0), (4, 4), (2, 4), (2, 1.2), (1.5, 1.2), (1.5, 4), (-4, 4), (-4, 0), (-1, 0))
    asked = Trial(ribbed, Side.LEFT, 0.25, True, 0.8, 0.0)
    assert not at_once(asked)
    assert at_once(replace(asked, overlap=2.0))
    assert table_of(replace(asked, overlap=2.0)).recommended is None


def test_each_start_of_a_gear_is_told_from_its_own_walls():
    part = gear(120)
    trial = trial_of(derive(part).blocks[0], part)
    assert trial is not None
    walls, rows = Walls.of(trial.surface), range(len(trial.surface))
    moved = [replace(trial, surface=started(trial.surface, row)) for row in rows]
    found = gouge_at_once(moved, walls, [(row, row) for row in rows])
    assert True in found
    assert False in found
    assert found == [at_once(replace(one, surface=one.surface)) or no for one, no in zip(moved, found, strict=True)]
    assert all(table_of(one).recommended is None for one, no in zip(moved, found, strict=True) if no)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed, SIDES, RADII, st.booleans(), BLENDS, OVERLAPS, st.integers(0, 20))
def test_what_gouges_beyond_doubt_is_clean_at_no_look_ahead(contour, side, radius, closed, blend, overlap, row):
    surface = shut(contour) if closed else contour
    if closed and row < len(surface):
        surface = started(surface, row)
    trial = Trial(surface, side, radius, closed, blend, overlap)
    if at_once(trial):
        assert table_of(trial).recommended is None


@settings(max_examples=150, deadline=None, derandomize=True)
@given(mixed, SIDES, RADII, st.booleans(), BLENDS)
def test_a_path_that_gouges_beyond_doubt_is_judged_so(contour, side, radius, closed, blend):
    surface = shut(contour) if closed else contour
    every = compensate_all(surface, side, radius, (1, 3, 8), closed=closed, blend=blend)
    wholes = [one.whole for one in every if len(one.path)]
    told = rulings(surface, side, radius, wholes)
    found = gouging(wholes, radius, Walls.of(surface))
    assert not any(no and ruling.clean for no, ruling in zip(found, told, strict=True))
