from itertools import pairwise
from math import hypot

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.path import Path
from core.geometry.piece import Line, Turn
from core.output.passes import (
    CenterPath,
    Cutter,
    Floor,
    Job,
    Motion,
    Pass,
    heights,
    levels,
    meets_solid,
    passes,
    z_steps,
)
from tests.core.output.jobs import INCH, arc, job, path_of, polyline

SLOT = polyline((0, 0), (2, 0), (2, 1))
OUTER = polyline((0, 0.1), (1.9, 0.1), (1.9, 1))
RING = polyline((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))


def shown(motion: Motion) -> tuple[str, float, float, float]:
    word = "G0" if motion.rapid else "G1" if motion.turn is Turn.NONE else "G3" if motion.turn is Turn.CCW else "G2"
    return word, *(round(value / INCH, 9) + 0.0 for value in (motion.x, motion.y, motion.z))  # type: ignore[return-value]  # four of them


def all_shown(one: Job) -> list[tuple[str, float, float, float]]:
    return [shown(motion) for each in passes(one) for motion in each.motions]


def in_inches(found: tuple[float, ...]) -> list[float]:
    return [round(level / INCH, 9) for level in found]


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
def test_levels_are_counted_from_z_start_and_end_at_the_bottom(bottom, peck, expected):
    assert in_inches(levels(0.0, bottom * INCH, peck * INCH)) == expected


def test_the_bottom_is_reached_exactly():
    assert levels(1.0, -2.3, 0.7)[-1] == -2.3


def test_a_rest_a_machine_cannot_show_is_no_pass_of_its_own():
    assert levels(0.0, -2.0005, 1.0) == (-1.0, -2.0005)
    assert levels(0.0, -2.002, 1.0) == (-1.0, -2.0, -2.002)


@given(
    start=st.floats(-50, 50),
    depth=st.floats(0, 50),
    peck=st.floats(0.01, 10),
)
@settings(derandomize=True, max_examples=200)
def test_no_peck_is_deeper_than_peck_depth(start, depth, peck):
    found = (start, *levels(start, start - depth, peck))
    steps = [high - low for high, low in pairwise(found)]
    assert found[-1] == start - depth
    assert max(steps) <= peck + 1e-3 + 1e-9
    assert min(steps) > 1e-3 - 1e-9 or len(steps) == 1


def test_a_peck_goes_up_back_and_down_to_the_clearance():
    assert all_shown(job(SLOT)) == [
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


def test_a_closed_contour_retracts_between_pecks_too():
    ups = [motion for motion in all_shown(job(RING)) if motion[0] == "G0" and motion[3] == 0.1]
    assert len(ups) == 1 + 2 * 2


def test_feeds_are_the_plunge_feed_down_and_the_segments_own_along():
    one = job(SLOT, peck_depth=0.0, floors=(Floor(1, -6.35, -6.35, 100.0), Floor(2, -6.35, -6.35, 200.0)))
    (found,) = passes(one)
    assert [motion.feed for motion in found.motions] == [None, None, 508.0, 100.0, 200.0, None]


def test_blend_moves_take_the_feed_and_height_of_the_end_they_stand_at():
    run = CenterPath(SLOT, lead_in=polyline((-1, 0), (0, 0)), lead_out=polyline((2, 1), (2, 2)))
    one = job(SLOT, finish=(run,), peck_depth=0.0, floors=(Floor(1, -6.35, -6.35, 1.0), Floor(2, -6.35, -6.35, 2.0)))
    (found,) = passes(one)
    assert [motion.feed for motion in found.motions[3:-1]] == [1.0, 1.0, 2.0, 2.0]
    assert shown(found.motions[0])[1:3] == (-1, 0)


def told(one: Pass) -> tuple[int, float, float, bool]:
    return one.cutter.number, round(one.level / INCH, 9), one.stock, one.finishing


def test_all_offsets_of_a_depth_come_before_the_next_depth_and_the_full_size_last():
    outer, inner = CenterPath(OUTER, offset=2.0), CenterPath(SLOT, offset=1.0)
    one = job(SLOT, rough=(outer, inner), z_bottom=-0.2 * INCH)
    assert [told(each) for each in passes(one)] == [
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


def test_the_finish_tool_follows_in_one_pass_at_full_depth_over_the_stock_left():
    assert [told(each) for each in passes(with_finisher(0.5))] == [
        (1, -0.1, 0.5, False),
        (1, -0.2, 0.5, False),
        (2, -0.25, 0.0, True),
    ]


def test_a_smaller_finish_tool_pecks():
    found = [told(each) for each in passes(with_finisher(0.25))]
    assert [each[1] for each in found if each[3]] == [-0.1, -0.2, -0.25]


def test_on_the_contour_itself_both_tools_run_the_same_path():
    one = job(SLOT, finisher=Cutter(2, 12.7), finish_tool=2, finish_z=0.05 * INCH, peck_depth=0.0)
    assert [told(each) for each in passes(one)] == [(1, -0.2, 0.0, False), (2, -0.25, 0.0, True)]


def test_each_tool_begins_and_ends_at_safe_z():
    found = passes(with_finisher(0.5))
    heights_of = {number: [each.motions for each in found if each.cutter.number == number] for number in (1, 2)}
    for motions in heights_of.values():
        assert motions[0][0].z == INCH
        assert motions[-1][-1].z == INCH


def test_rapids_never_go_below_what_is_cut():
    """Rapid moves in XY stay above Z START; rapids down stop above the depth reached there before."""
    for each in passes(job(SLOT)):
        before = each.motions[0]
        for motion in each.motions[1:]:
            if motion.rapid and (motion.x, motion.y) != (before.x, before.y):
                assert motion.z > 0
                assert before.z > 0
            before = motion


def ramp(path: Path, *ends: float, **changes: object) -> Job:
    """Floors that climb from -0.25 to the given ends, one a segment."""
    starts = (-0.25, *ends)
    floors = tuple(
        Floor(number, low * INCH, high * INCH, 254.0)
        for number, (low, high) in enumerate(zip(starts, ends, strict=False), start=1)
    )
    return job(path, floors=floors, **changes)


def test_z_end_is_reached_evenly_along_a_line():
    one = ramp(SLOT, -0.25, -0.05, peck_depth=0.0)
    assert all_shown(one)[2:-1] == [("G1", 0, 0, -0.25), ("G1", 2, 0, -0.25), ("G1", 2, 1, -0.05)]


def test_a_level_above_the_floor_is_kept_until_the_floor_meets_it():
    one = ramp(polyline((0, 0), (2, 0)), 0.0, peck_depth=0.125 * INCH)
    first, second = ([shown(motion) for motion in each.motions[:-1]] for each in passes(one))
    assert first[2:] == [("G1", 0, 0, -0.125), ("G1", 1, 0, -0.125), ("G1", 2, 0, 0)]
    assert second[2:] == [("G1", 0, 0, -0.25), ("G1", 2, 0, 0)]


def test_a_helix_is_cut_where_its_floor_meets_the_level():
    helix = path_of(arc((1, 0), (1, 0), (0, 0), Turn.CCW))
    one = ramp(helix, 0.0, peck_depth=0.125 * INCH)
    first, second = passes(one)
    half, rest = first.motions[3], first.motions[4]
    assert hypot(half.x + INCH, half.y) < 1e-9
    assert (half.z, rest.z) == (-0.125 * INCH, 0.0)
    assert half.turn is rest.turn is Turn.CCW
    assert [shown(motion)[0] for motion in second.motions] == ["G0", "G0", "G1", "G3", "G0"]


def test_a_piece_shortened_at_a_corner_has_the_height_the_drawing_gives_there():
    """The line of 2 in climbs 0.2; its center path stops 0.5 before the corner, then the tool lifts straight up."""
    surface = polyline((0, 0), (2, 0), (2, 2))
    center = polyline((0, 0.5), (1.5, 0.5), (1.5, 2))
    one = ramp(surface, -0.05, -0.05, finish=(CenterPath(center),), peck_depth=0.0)
    assert all_shown(one)[2:-1] == [
        ("G1", 0, 0.5, -0.25),
        ("G1", 1.5, 0.5, -0.1),
        ("G1", 1.5, 0.5, -0.05),
        ("G1", 1.5, 2, -0.05),
    ]


def test_a_corner_arc_keeps_its_corners_height():
    surface = polyline((0, 0), (1, 0), (1, 1))
    corner = arc((1, -0.5), (1.5, 0), (1, 0), Turn.CCW)
    first, last = polyline((0, -0.5), (1, -0.5))[0], polyline((1.5, 0), (1.5, 1))[0]
    center = Path.from_pieces((first, corner, last), (1.0, 1.5, 2.0))
    one = ramp(surface, -0.15, -0.05, finish=(CenterPath(center),), peck_depth=0.0)
    assert [motion[3] for motion in all_shown(one)[2:-1]] == [-0.25, -0.15, -0.15, -0.05]


def test_heights_on_an_arc_follow_its_angle():
    surface = path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW))
    quarter = path_of(arc((0.5, 0), (0, 0.5), (0, 0), Turn.CCW))
    one = ramp(surface, -0.05, finish=(CenterPath(quarter),))
    assert (heights(one, one.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.15])


def test_rounding_before_an_arcs_first_point_puts_it_not_at_the_arcs_end():
    surface = path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW))
    for hair in (1e-9, -1e-9):
        begun = path_of(arc((0.5, hair), (0, 0.5), (0, 0), Turn.CCW))
        one = ramp(surface, -0.05, finish=(CenterPath(begun),))
        assert (heights(one, one.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.15])


def test_a_piece_beyond_its_line_keeps_the_height_of_the_lines_end():
    surface = polyline((0, 0), (2, 0))
    one = ramp(surface, -0.05, finish=(CenterPath(polyline((-1, 1), (3, 1))),))
    assert (heights(one, one.finish[0])[0] / INCH).tolist() == pytest.approx([-0.25, -0.05])


def test_heights_count_from_a_lines_own_start():
    surface = polyline((3, 1), (5, 1))
    one = ramp(surface, -0.05, finish=(CenterPath(polyline((3.5, 1.5), (4, 1.5))),))
    assert (heights(one, one.finish[0])[0] / INCH).tolist() == pytest.approx([-0.2, -0.15])


def test_a_finish_tool_as_large_pecks_where_no_roughing_has_been():
    short = CenterPath(polyline((0, 0), (2, 0)), offset=0.5)
    rough_everywhere, rough_once = (with_finisher(0.5, rough=(run,)) for run in (CenterPath(SLOT, offset=0.5), short))
    assert [told(each)[1] for each in passes(rough_everywhere) if each.finishing] == [-0.25]
    assert [told(each)[1] for each in passes(rough_once) if each.finishing] == [-0.1, -0.2, -0.25]
    assert meets_solid(rough_once) == {2}
    assert meets_solid(job(SLOT)) == frozenset()


def test_steps_between_pieces_of_the_path_are_reported_with_their_place():
    surface = polyline((0, 0), (2, 0), (2, 2))
    one = ramp(surface, -0.05, -0.05, finish=(CenterPath(polyline((0, 0.5), (1.5, 0.5), (1.5, 2))),))
    (step,) = z_steps(one)
    assert step.rise / INCH == pytest.approx(0.05)
    assert step.number == 2.0
    assert step.at == pytest.approx((1.5 * INCH, 0.5 * INCH))
    assert z_steps(job(surface)) == []
    assert z_steps(ramp(surface, -0.05, -0.05)) == []


def test_safe_z_below_the_retract_clearance_is_raised_to_it():
    (found,) = passes(job(SLOT, peck_depth=0.0, safe_z=0.05 * INCH))
    assert [shown(motion)[3] for motion in found.motions if motion.rapid] == [0.1, 0.1]


def test_an_overlap_past_the_start_is_lifted_over_a_higher_floor():
    """Closed: the first segment begins at -0.05, the last ends at -0.25; the overlap runs over the first again."""
    floors = (Floor(1, -0.05 * INCH, -0.05 * INCH, 254.0), *(Floor(k, -6.35, -6.35, 254.0) for k in (2, 3, 4)))
    overlap = Path.from_pieces([Line((0.0, 0.0), (5.0, 0.0))], [1.0])
    run = CenterPath(RING, lead_out=overlap)
    one = job(RING, floors=floors, finish=(run,))
    assert heights(one, run)[-1].tolist() == pytest.approx([-0.05 * INCH, -0.05 * INCH])
