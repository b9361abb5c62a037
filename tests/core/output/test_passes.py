from itertools import pairwise
from math import hypot

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.comp.compensated import CenterPath
from core.controls.write.contour_pass import CenterMove
from core.geometry.path import Path
from core.geometry.piece import Line, Turn
from core.output.passes import Cutter, Floor, Job, Pass, heights, meets_solid, passes, peck_levels, z_steps
from tests.core.output.jobs import INCH, arc, job, path_of, polyline

SLOT = polyline((0, 0), (2, 0), (2, 1))
OUTER = polyline((0, 0.1), (1.9, 0.1), (1.9, 1))
RING = polyline((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))


def posted_move(motion: CenterMove) -> tuple[str, float, float, float]:
    word = "G0" if motion.rapid else "G1" if motion.turn == Turn.NONE else "G3" if motion.turn == Turn.CCW else "G2"
    return word, *(round(value / INCH, 9) + 0.0 for value in (motion.x, motion.y, motion.z))  # type: ignore[return-value]  # four of them


def posted_moves(work: Job) -> list[tuple[str, float, float, float]]:
    return [posted_move(motion) for each in passes(work) for motion in each.motions]


def in_inches(values: tuple[float, ...]) -> list[float]:
    return [round(level / INCH, 9) for level in values]


@pytest.mark.parametrize(
    ("bottom", "peck", "expected"),
    [
        (-0.25, 0.1, [-0.1, -0.2, -0.25]),
        (-0.3, 0.1, [-0.1, -0.2, -0.3]),
        (-0.25, 0.0, [-0.25]),
        (-0.25, 0.25, [-0.25]),
        (-0.25, 1.0, [-0.25]),
        (-0.7, 0.1, [-0.1, -0.2, -0.3, -0.4, -0.5, -0.6, -0.7]),
        (0.0, 0.1, [0.0]),
    ],
)
def test_levels_count_from_z_start_and_end_at_the_bottom(bottom, peck, expected):
    assert in_inches(peck_levels(0.0, bottom * INCH, peck * INCH)) == expected


def test_the_bottom_is_reached_exactly():
    assert peck_levels(1.0, -2.3, 0.7)[-1] == -2.3


def test_a_remainder_below_the_last_digit_is_no_separate_pass():
    assert peck_levels(0.0, -2.0005, 1.0) == (-1.0, -2.0005)
    assert peck_levels(0.0, -2.002, 1.0) == (-1.0, -2.0, -2.002)


@given(
    start=st.floats(-50, 50),
    depth=st.floats(0, 50),
    peck=st.floats(0.01, 10),
)
@settings(derandomize=True, max_examples=200)
def test_no_peck_is_deeper_than_peck_depth(start, depth, peck):
    depths = (start, *peck_levels(start, start - depth, peck))
    steps = [high - low for high, low in pairwise(depths)]
    assert depths[-1] == start - depth
    assert max(steps) <= peck + 1e-3 + 1e-9
    assert min(steps) > 1e-3 - 1e-9 or len(steps) == 1


def test_a_peck_retracts_returns_and_rapids_down_to_the_clearance():
    assert posted_moves(job(SLOT)) == [
        ("G0", 0, 0, 1.0),
        ("G0", 0, 0, 0.1),
        ("G1", 0, 0, -0.1),
        ("G1", 2, 0, -0.1),
        ("G1", 2, 1, -0.1),
        ("G0", 2, 1, 0.1),
        ("G0", 0, 0, 0.1),
        ("G0", 0, 0, -0.05),
        ("G1", 0, 0, -0.2),
        ("G1", 2, 0, -0.2),
        ("G1", 2, 1, -0.2),
        ("G0", 2, 1, 0.1),
        ("G0", 0, 0, 0.1),
        ("G0", 0, 0, -0.15),
        ("G1", 0, 0, -0.25),
        ("G1", 2, 0, -0.25),
        ("G1", 2, 1, -0.25),
        ("G0", 2, 1, 1.0),
    ]


def test_a_closed_contour_retracts_between_pecks():
    ups = [motion for motion in posted_moves(job(RING)) if motion[0] == "G0" and motion[3] == 0.1]
    assert len(ups) == 1 + 2 * 2


def test_a_pass_plunges_at_the_plunge_feed_and_cuts_at_the_feed_of_each_segment():
    work = job(SLOT, peck_depth=0.0, floors=(Floor(1, -6.35, -6.35, 100.0), Floor(2, -6.35, -6.35, 200.0)))
    (only,) = passes(work)
    assert [motion.feed for motion in only.motions] == [None, None, 508.0, 100.0, 200.0, None]


def test_blend_moves_take_the_feed_of_the_segment_next_to_them():
    run = CenterPath(SLOT, lead_in=polyline((-1, 0), (0, 0)), lead_out=polyline((2, 1), (2, 2)))
    work = job(SLOT, finish=(run,), peck_depth=0.0, floors=(Floor(1, -6.35, -6.35, 1.0), Floor(2, -6.35, -6.35, 2.0)))
    (only,) = passes(work)
    assert [motion.feed for motion in only.motions[3:-1]] == [1.0, 1.0, 2.0, 2.0]
    assert posted_move(only.motions[0])[1:3] == (-1, 0)


def summary(cut: Pass) -> tuple[int, float, float, bool]:
    return cut.cutter.number, round(cut.level / INCH, 9), cut.stock, cut.finishing


def test_each_depth_is_cut_from_the_largest_offset_to_the_full_size():
    outer, inner = CenterPath(OUTER, offset=2.0), CenterPath(SLOT, offset=1.0)
    work = job(SLOT, rough=(outer, inner), z_bottom=-0.2 * INCH)
    assert [summary(each) for each in passes(work)] == [
        (1, -0.1, 2.0, False),
        (1, -0.1, 1.0, False),
        (1, -0.1, 0.0, False),
        (1, -0.2, 2.0, False),
        (1, -0.2, 1.0, False),
        (1, -0.2, 0.0, False),
    ]


def with_finisher(diameter: float, **changes: object) -> Job:
    finisher = Cutter(2, diameter * INCH)
    given = {"rough": (CenterPath(OUTER, offset=0.5),), "finish_z": 0.05 * INCH, **changes}
    return job(SLOT, finisher=finisher, finish_tool=2, **given)


def test_the_finish_tool_cuts_the_remaining_stock_in_one_pass_at_full_depth():
    assert [summary(each) for each in passes(with_finisher(0.5))] == [
        (1, -0.1, 0.5, False),
        (1, -0.2, 0.5, False),
        (2, -0.25, 0.0, True),
    ]


def test_a_finish_tool_smaller_than_the_roughing_tool_pecks():
    summaries = [summary(each) for each in passes(with_finisher(0.25))]
    assert [each[1] for each in summaries if each[3]] == [-0.1, -0.2, -0.25]


@pytest.mark.parametrize(("max_offset", "levels_cut"), [(0.02, [-0.1, -0.2, -0.25]), (0.5, [-0.25])])
def test_a_finish_tool_wider_than_the_roughed_strip_pecks(max_offset, levels_cut):
    rough = (CenterPath(OUTER, offset=max_offset * INCH), CenterPath(OUTER, offset=0.02 * INCH))
    summaries = [summary(each) for each in passes(with_finisher(1.0, rough=rough))]
    assert [each[1] for each in summaries if each[3]] == levels_cut


def test_both_tools_run_on_the_contour_without_compensation():
    work = job(SLOT, finisher=Cutter(2, 12.7), finish_tool=2, finish_z=0.05 * INCH, peck_depth=0.0)
    assert [summary(each) for each in passes(work)] == [(1, -0.2, 0.0, False), (2, -0.25, 0.0, True)]


def test_each_tool_begins_and_ends_at_safe_z():
    all_passes = passes(with_finisher(0.5))
    heights_of = {number: [each.motions for each in all_passes if each.cutter.number == number] for number in (1, 2)}
    for motions in heights_of.values():
        assert motions[0][0].z == INCH
        assert motions[-1][-1].z == INCH


def test_rapids_in_xy_stay_above_z_start():
    """A rapid in XY, which is the way back to the start of each pass but the first, starts and ends above Z START."""
    motions = [motion for each in passes(job(SLOT)) for motion in each.motions]
    across = [
        (before.z, after.z)
        for before, after in pairwise(motions)
        if after.rapid and (after.x, after.y) != (before.x, before.y)
    ]
    assert len(across) == len(passes(job(SLOT))) - 1 == 2
    assert all(before > 0 and after > 0 for before, after in across)


def ramp(path: Path, *ends: float, **changes: object) -> Job:
    """A job with floors that climb from -0.25 to the given ends, one per segment."""
    starts = (-0.25, *ends)
    floors = tuple(
        Floor(number, low * INCH, high * INCH, 254.0)
        for number, (low, high) in enumerate(zip(starts, ends, strict=False), start=1)
    )
    return job(path, floors=floors, **changes)


def test_z_end_is_reached_evenly_along_a_line():
    work = ramp(SLOT, -0.25, -0.05, peck_depth=0.0)
    assert posted_moves(work)[2:-1] == [("G1", 0, 0, -0.25), ("G1", 2, 0, -0.25), ("G1", 2, 1, -0.05)]


def test_a_level_is_kept_until_the_floor_rises_to_it():
    work = ramp(polyline((0, 0), (2, 0)), 0.0, peck_depth=0.125 * INCH)
    first, second = ([posted_move(motion) for motion in each.motions[:-1]] for each in passes(work))
    assert first[2:] == [("G1", 0, 0, -0.125), ("G1", 1, 0, -0.125), ("G1", 2, 0, 0)]
    assert second[2:] == [("G1", 0, 0, -0.25), ("G1", 2, 0, 0)]


def test_a_helix_is_split_where_its_floor_rises_to_the_level():
    helix = path_of(arc((1, 0), (1, 0), (0, 0), Turn.CCW))
    work = ramp(helix, 0.0, peck_depth=0.125 * INCH)
    first, second = passes(work)
    half, rest = first.motions[3], first.motions[4]
    assert hypot(half.x + INCH, half.y) < 1e-9
    assert (half.z, rest.z) == (-0.125 * INCH, 0.0)
    assert half.turn is rest.turn is Turn.CCW
    assert [posted_move(motion)[0] for motion in second.motions] == ["G0", "G0", "G1", "G3", "G0"]


def test_a_piece_shortened_at_a_corner_has_the_height_of_the_contour_there():
    """The line of 2 in climbs 0.2; its center path stops 0.5 before the corner, where the tool rises vertically."""
    surface = polyline((0, 0), (2, 0), (2, 2))
    center = polyline((0, 0.5), (1.5, 0.5), (1.5, 2))
    work = ramp(surface, -0.05, -0.05, finish=(CenterPath(center),), peck_depth=0.0)
    assert posted_moves(work)[2:-1] == [
        ("G1", 0, 0.5, -0.25),
        ("G1", 1.5, 0.5, -0.1),
        ("G1", 1.5, 0.5, -0.05),
        ("G1", 1.5, 2, -0.05),
    ]


def test_a_corner_arc_keeps_the_height_of_its_corner():
    surface = polyline((0, 0), (1, 0), (1, 1))
    corner = arc((1, -0.5), (1.5, 0), (1, 0), Turn.CCW)
    first, last = polyline((0, -0.5), (1, -0.5))[0], polyline((1.5, 0), (1.5, 1))[0]
    center = Path.from_pieces((first, corner, last), (1.0, 1.5, 2.0))
    work = ramp(surface, -0.15, -0.05, finish=(CenterPath(center),), peck_depth=0.0)
    assert [motion[3] for motion in posted_moves(work)[2:-1]] == [-0.25, -0.15, -0.15, -0.05]


def test_heights_on_an_arc_follow_its_angle():
    surface = path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW))
    quarter = path_of(arc((0.5, 0), (0, 0.5), (0, 0), Turn.CCW))
    work = ramp(surface, -0.05, finish=(CenterPath(quarter),))
    assert (heights(work, work.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.15])


def test_a_point_just_before_the_start_of_an_arc_has_the_height_of_the_start():
    surface = path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW))
    for hair in (1e-9, -1e-9):
        begun = path_of(arc((0.5, hair), (0, 0.5), (0, 0), Turn.CCW))
        work = ramp(surface, -0.05, finish=(CenterPath(begun),))
        assert (heights(work, work.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.15])


def test_a_piece_beyond_its_line_keeps_the_height_at_the_end_of_the_line():
    surface = polyline((0, 0), (2, 0))
    work = ramp(surface, -0.05, finish=(CenterPath(polyline((-1, 1), (3, 1))),))
    assert (heights(work, work.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.05])


def test_heights_count_from_the_start_of_each_line():
    surface = polyline((3, 1), (5, 1))
    work = ramp(surface, -0.05, finish=(CenterPath(polyline((3.5, 1.5), (4, 1.5))),))
    assert (heights(work, work.finish[0])[0] / INCH).tolist() == pytest.approx([-0.2, -0.15])


def test_a_finish_tool_of_the_same_size_pecks_where_nothing_was_roughed():
    short = CenterPath(polyline((0, 0), (2, 0)), offset=0.5)
    rough_everywhere, rough_once = (with_finisher(0.5, rough=(run,)) for run in (CenterPath(SLOT, offset=0.5), short))
    assert [summary(each)[1] for each in passes(rough_everywhere) if each.finishing] == [-0.25]
    assert [summary(each)[1] for each in passes(rough_once) if each.finishing] == [-0.1, -0.2, -0.25]
    assert meets_solid(rough_once) == {2}
    assert meets_solid(job(SLOT)) == frozenset()


def test_steps_between_pieces_of_the_path_are_reported_with_their_place():
    surface = polyline((0, 0), (2, 0), (2, 2))
    work = ramp(surface, -0.05, -0.05, finish=(CenterPath(polyline((0, 0.5), (1.5, 0.5), (1.5, 2))),))
    (step,) = z_steps(work)
    assert step.rise / INCH == pytest.approx(0.05)
    assert step.number == 2.0
    assert step.at == pytest.approx((1.5 * INCH, 0.5 * INCH))
    assert z_steps(job(surface)) == []
    assert z_steps(ramp(surface, -0.05, -0.05)) == []


def test_a_safe_z_below_the_retract_clearance_is_raised_to_it():
    (only,) = passes(job(SLOT, peck_depth=0.0, safe_z=0.05 * INCH))
    assert [posted_move(motion)[3] for motion in only.motions if motion.rapid] == [0.1, 0.1]


def test_an_overlap_past_the_start_rises_to_a_higher_floor():
    """The first segment is at -0.05, the last at -0.25; the overlap runs over the first segment again."""
    floors = (Floor(1, -0.05 * INCH, -0.05 * INCH, 254.0), *(Floor(k, -6.35, -6.35, 254.0) for k in (2, 3, 4)))
    overlap = Path.from_pieces([Line((0.0, 0.0), (5.0, 0.0))], [1.0])
    run = CenterPath(RING, lead_out=overlap)
    work = job(RING, floors=floors, finish=(run,))
    assert heights(work, run)[-1].tolist() == pytest.approx([-0.05 * INCH, -0.05 * INCH])
