"""Where the cutter is drawn for the segment with the cursor, and where it is not drawn at all."""

from dataclasses import replace

import numpy as np
import pytest

from app.documents.files import load
from app.documents.programs import example
from core.draw.characters import Mode
from core.draw.scene import Style
from core.draw.view import TALL, View
from core.pipeline.derive import derive
from core.pipeline.plot import LOUPE, Subject, block_scene, svg_of
from core.program.model import ArcSegment, CutterComp, Direction, LineSegment, Number, PathChoice
from core.units import Unit
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OVER_RUN_SQUARE, block, program


def derived(part):
    return derive(part).blocks[0]


def cutter_at(found, segment):
    """Where the cutter is drawn for a segment, None where none is."""
    circles = block_scene(found, segment, Unit.IN).circles
    return circles[0].center if circles else None


@pytest.mark.parametrize("lookahead", [None, Number(5.0)])
def test_on_a_deleted_segment_the_cutter_stands_where_the_path_passes_it(lookahead):
    pocket = load(example("pocket"))
    part = replace(pocket, blocks=(replace(pocket.blocks[0], lookahead=lookahead),))
    found = derived(part)
    (circle,) = block_scene(found, 9, Unit.IN).circles
    (meeting,) = [one.at for one in found.paths.compensated.deleted if one.segment == 9]
    assert circle.center == pytest.approx(meeting)


def test_a_deletion_within_a_later_one_leads_to_where_the_path_passes():
    """At 3 and more the notch's floor falls first to its walls' corner arcs or to both sides: always on the path."""
    for points, comp in ((NOTCH, CutterComp.LEFT), (OVER_RUN_SQUARE, CutterComp.RIGHT)):
        for value in range(1, 21):
            found = derived(program(block(points, comp, lookahead=Number(float(value)))))
            for segment in range(1, len(points)):
                apart = found.paths.loops[0].whole.points - cutter_at(found, segment)
                assert min(np.hypot(*apart.T)) < 1e-9


def test_where_nothing_is_determined_no_cutter_is_drawn():
    one = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    part = program(replace(one, segments=(*one.segments[:3], LineSegment(), *one.segments[3:])))
    found = derived(part)
    assert len(block_scene(found, 3, Unit.IN).circles) == 1
    for segment in (4, 5, 6):
        assert cutter_at(found, segment) is None


def test_segments_that_are_not_determined_are_drawn_each_by_itself():
    arc = ArcSegment(Direction.CCW, x_end=Number(-1.0), y_end=Number(0.0), radius=Number(2.0))
    one = block(((0.0, 0.0), (1.0, 0.0)), CutterComp.LEFT)
    found = derived(program(replace(one, segments=(*one.segments, arc))))
    choices = found.solved.segments[1].choices
    assert len(choices) > 1
    (dashed,) = [layer for layer in block_scene(found, 2, Unit.IN).layers if layer.dashed]
    assert [tuple(part) for part in dashed.parts] == [(choice,) for choice in choices]


def test_the_best_path_has_its_cutter_in_every_loop_and_none_where_it_does_not_run():
    pocket = load(example("pocket"))
    part = replace(pocket, parameters=replace(pocket.parameters, path=PathChoice.BEST))
    found = derived(part)
    numbers = {number for loop in found.paths.loops for number in loop.whole.numbers.tolist()}
    for segment in range(1, 12):
        assert (cutter_at(found, segment) is not None) is (segment in numbers)


def test_start_has_the_cutter_where_it_goes_down():
    found = derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT)))
    assert cutter_at(found, 0) == tuple(found.paths.center.points[0].tolist())


def test_the_whole_part_is_drawn_with_the_numbers_of_its_segments():
    subject = Subject(derived(program(block(MID_SIDE_SQUARE, CutterComp.RIGHT))), Unit.IN)
    drawn = subject.drawn(60, 20, Mode.BRAILLE)
    assert drawn.view == View.fit(drawn.bounds, 60, 20)
    assert set("12345") <= set("".join(drawn.picture.rows))


def test_in_a_drawing_of_44_columns_numbers_of_segments_would_crowd():
    """Three dots of the tool's radius are enough for numbers: here it has more in both drawings."""
    subject = Subject(derived(program(block(MID_SIDE_SQUARE, CutterComp.RIGHT))), Unit.IN)
    narrow, wide = ("".join(subject.drawn(columns, 40, Mode.BRAILLE).picture.rows) for columns in (44, 45))
    assert not set("12345") & set(narrow)
    assert set("12345") <= set(wide)


def test_a_loupe_shows_a_few_tools_around_its_middle():
    found = derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT)))
    whole, loupe = (Subject(found, Unit.IN, near=near).drawn(60, 20, Mode.BRAILLE).view for near in (None, (50.8, 0.0)))
    assert loupe.scale < whole.scale
    assert 20 * TALL * loupe.scale == pytest.approx(LOUPE * 0.25 * 25.4)


def test_the_legend_does_not_call_the_controls_path_behind_the_best_one_a_roughing_pass_alone():
    pocket = load(example("pocket"))
    part = replace(pocket, parameters=replace(pocket.parameters, path=PathChoice.BEST))
    assert ">roughing passes or control's path</text>" in svg_of(derive(part), title="")


@pytest.mark.parametrize(
    ("first", "last", "ends"),
    [
        ((2, 3), (3, 2), [[(2, 3), (3, 3)], [(3, 3), (3, 2)]]),
        ((3, 3), (3, 2), [[(3, 3), (3, 2)]]),
        ((2, 3), (3, 3), [[(2, 3), (3, 3)]]),
    ],
)
def test_only_what_lies_beyond_the_crossing_of_the_ends_is_drawn_as_lead(first, last, ends):
    found = derived(program(block((first, (5, 3), (5, 5), (3, 5), last), CutterComp.RIGHT)))
    assert found.paths.verdict.over_run_at == pytest.approx((3 * 25.4, 3 * 25.4))
    scene = block_scene(found, None, Unit.IN)
    drawn = [part for layer in scene.layers if layer.style is Style.LEAD for part in layer.parts]
    assert [(part.points / 25.4).tolist() for part in drawn] == [[pytest.approx(end) for end in part] for part in ends]


def test_an_arc_that_runs_past_the_corner_is_drawn_as_lead_from_there_on():
    one = block(((2, 3), (5, 3), (5, 5), (3, 5)), CutterComp.RIGHT)
    arc = ArcSegment(Direction.CW, x_end=Number(3.0), y_end=Number(1.0), x_center=Number(-7.0), y_center=Number(3.0))
    found = derived(program(replace(one, segments=(*one.segments, arc))))
    crossing = 104**0.5 - 7
    scene = block_scene(found, None, Unit.IN)
    first, last = [part for layer in scene.layers if layer.style is Style.LEAD for part in layer.parts]
    assert (first.points / 25.4).tolist() == [pytest.approx((2, 3)), pytest.approx((crossing, 3))]
    assert (last.points / 25.4).tolist() == [pytest.approx((crossing, 3)), pytest.approx((3, 1))]
    assert last.turns.tolist() == [-1]
