"""The place of the cutter drawn for the segment with the cursor, and segments without a cutter."""

from dataclasses import replace

import numpy as np
import pytest

from app.documents.files import load
from app.documents.programs import example
from core.draw.characters import Mode
from core.draw.scene import Mark, Scene, Style, Symbol
from core.draw.view import CELL_HEIGHT, View
from core.geometry.piece import Line
from core.pipeline.derive import derive, look_ahead_table
from core.pipeline.plot import LOUPE_HEIGHT_RADII, SceneSubject, Subject, block_scene, nearest_segment, svg_of
from core.program.model import ArcSegment, CutterComp, Direction, LineSegment, Number, PathChoice
from core.units import Unit
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OVER_RUN_SQUARE, block, program


def derived(part):
    return derive(part).blocks[0]


def cutter_at(derived_block, segment):
    """The center of the cutter drawn for a segment, None if none is drawn."""
    circles = block_scene(derived_block, segment, Unit.IN).circles
    return circles[0].center if circles else None


@pytest.mark.parametrize("lookahead", [None, Number(5.0)])
def test_the_cutter_of_a_deleted_segment_is_where_the_path_passes_it(lookahead):
    pocket = load(example("pocket"))
    part = replace(pocket, blocks=(replace(pocket.blocks[0], lookahead=lookahead),))
    derived_block = derived(part)
    (circle,) = block_scene(derived_block, 9, Unit.IN).circles
    (meeting,) = [deletion.at for deletion in derived_block.paths.compensated.deleted if deletion.segment == 9]
    assert circle.center == pytest.approx(meeting)


def test_the_cutter_of_a_deletion_within_another_one_is_on_the_path():
    """From 3 on, the floor of the notch is deleted by corner arcs or both sides, always on the path."""
    for points, comp in ((NOTCH, CutterComp.LEFT), (OVER_RUN_SQUARE, CutterComp.RIGHT)):
        for value in range(1, 21):
            derived_block = derived(program(block(points, comp, lookahead=Number(float(value)))))
            for segment in range(1, len(points)):
                apart = derived_block.paths.loops[0].with_leads.points - cutter_at(derived_block, segment)
                assert min(np.hypot(*apart.T)) < 1e-9


def test_no_cutter_is_drawn_for_an_undetermined_segment():
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    part = program(replace(typed, segments=(*typed.segments[:3], LineSegment(), *typed.segments[3:])))
    derived_block = derived(part)
    assert len(block_scene(derived_block, 3, Unit.IN).circles) == 1
    for segment in (4, 5, 6):
        assert cutter_at(derived_block, segment) is None


def test_the_choices_of_an_undetermined_segment_are_drawn_separately():
    arc = ArcSegment(Direction.CCW, x_end=Number(-1.0), y_end=Number(0.0), radius=Number(2.0))
    typed = block(((0.0, 0.0), (1.0, 0.0)), CutterComp.LEFT)
    derived_block = derived(program(replace(typed, segments=(*typed.segments, arc))))
    choices = derived_block.solved.segments[1].choices
    assert len(choices) > 1
    (dashed,) = [layer for layer in block_scene(derived_block, 2, Unit.IN).layers if layer.dashed]
    assert [tuple(part) for part in dashed.parts] == [(choice,) for choice in choices]


def test_what_is_known_of_an_undetermined_line_is_drawn_dashed():
    typed = block(((0.0, 0.0), (1.0, 0.0)), CutterComp.LEFT)
    toward = LineSegment(x_end=Number(2.0), angle=Number(90.0))
    derived_block = derived(program(replace(typed, segments=(*typed.segments, toward))))
    assert derived_block.solved.determined == 1
    (dashed,) = [layer for layer in block_scene(derived_block, 2, Unit.IN).layers if layer.dashed]
    assert [tuple(part) for part in dashed.parts] == [(Line((25.4, 0.0), (50.8, 0.0)),)]


def test_the_best_path_has_a_cutter_only_for_segments_it_follows():
    pocket = load(example("pocket"))
    part = replace(pocket, parameters=replace(pocket.parameters, path=PathChoice.BEST))
    derived_block = derived(part)
    numbers = {number for loop in derived_block.paths.loops for number in loop.with_leads.numbers.tolist()}
    for segment in range(1, 12):
        assert (cutter_at(derived_block, segment) is not None) is (segment in numbers)


def test_the_cutter_of_start_is_at_the_plunge():
    derived_block = derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT)))
    assert cutter_at(derived_block, 0) == tuple(derived_block.paths.loops[0].with_leads.points[0].tolist())


def test_the_whole_part_is_drawn_with_the_numbers_of_its_segments():
    subject = Subject(derived(program(block(MID_SIDE_SQUARE, CutterComp.RIGHT))), Unit.IN)
    drawn = subject.drawn(60, 20, Mode.BRAILLE)
    assert drawn.view == View.fit(drawn.bounds, 60, 20)
    assert set("12345") <= set("".join(drawn.picture.rows))


def test_segment_numbers_are_left_out_in_a_narrow_drawing():
    """A tool radius of three dots is enough for numbers; both drawings have more."""
    subject = Subject(derived(program(block(MID_SIDE_SQUARE, CutterComp.RIGHT))), Unit.IN)
    narrow, wide = ("".join(subject.drawn(columns, 40, Mode.BRAILLE).picture.rows) for columns in (44, 45))
    assert not set("12345") & set(narrow)
    assert set("12345") <= set(wide)


def test_a_loupe_shows_a_few_tool_diameters_around_its_center():
    derived_block = derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT)))
    whole, loupe = (
        Subject(derived_block, Unit.IN, near=near).drawn(60, 20, Mode.BRAILLE).view for near in (None, (50.8, 0.0))
    )
    assert loupe.scale < whole.scale
    assert 20 * CELL_HEIGHT * loupe.scale == pytest.approx(LOUPE_HEIGHT_RADII * 0.25 * 25.4)


def test_the_legend_names_the_control_path_behind_the_best_path():
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
def test_only_the_parts_beyond_the_crossing_are_drawn_as_leads(first, last, ends):
    derived_block = derived(program(block((first, (5, 3), (5, 5), (3, 5), last), CutterComp.RIGHT)))
    assert derived_block.paths.verdict.over_run_at == pytest.approx((3 * 25.4, 3 * 25.4))
    scene = block_scene(derived_block, None, Unit.IN)
    drawn = [part for layer in scene.layers if layer.style is Style.LEAD for part in layer.parts]
    assert [(part.points / 25.4).tolist() for part in drawn] == [[pytest.approx(end) for end in part] for part in ends]


def test_the_part_of_an_arc_past_the_corner_is_drawn_as_a_lead():
    typed = block(((2, 3), (5, 3), (5, 5), (3, 5)), CutterComp.RIGHT)
    arc = ArcSegment(Direction.CW, x_end=Number(3.0), y_end=Number(1.0), x_center=Number(-7.0), y_center=Number(3.0))
    derived_block = derived(program(replace(typed, segments=(*typed.segments, arc))))
    crossing = 104**0.5 - 7
    scene = block_scene(derived_block, None, Unit.IN)
    first, last = [part for layer in scene.layers if layer.style is Style.LEAD for part in layer.parts]
    assert (first.points / 25.4).tolist() == [pytest.approx((2, 3)), pytest.approx((crossing, 3))]
    assert (last.points / 25.4).tolist() == [pytest.approx((crossing, 3)), pytest.approx((3, 1))]
    assert last.turns.tolist() == [-1]


def test_the_segment_nearest_to_a_point_is_named():
    square = derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT)))
    for segment, at in enumerate(((1.5, 0.1), (1.9, 1.0), (1.0, 2.5), (0.1, 1.0), (0.5, -0.1)), 1):
        assert nearest_segment(square, (at[0] * 25.4, at[1] * 25.4)) == segment
    assert nearest_segment(derived(program(block(NOTCH[:1], CutterComp.LEFT))), (0.0, 0.0)) is None


def test_gouged_and_uncut_regions_and_the_cross_are_in_the_picture():
    """The notch, 0.3 wide and deep, is cut by a tool of 0.5, or left uncut with a larger look-ahead."""
    for lookahead, style in ((1, Style.GOUGE_AREA), (3, Style.UNCUT_AREA)):
        notch = derived(program(block(NOTCH, CutterComp.LEFT, lookahead=Number(lookahead))))
        drawn = Subject(notch, Unit.IN, near=(2.15 * 25.4, 0.0)).drawn(60, 20, Mode.BRAILLE)
        styles = {style for row in drawn.picture.styles for style in row}
        assert styles & {Style.GOUGE_AREA, Style.UNCUT_AREA} == {style}
    crossed = Subject(notch, Unit.IN, cross=(2.15 * 25.4, -20.0)).drawn(60, 20, Mode.BRAILLE)
    assert crossed.picture != Subject(notch, Unit.IN).drawn(60, 20, Mode.BRAILLE).picture


def test_the_place_where_a_path_cuts_into_another_contour_is_marked():
    """The groove runs through the left wall, X 0, with its edge at Y 1.25."""
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT), block(((1, 1), (-1, 1)), CutterComp.ON))
    scene = block_scene(derive(part).blocks[1], None, Unit.IN)
    [(x, y)] = [mark.at for mark in scene.marks if mark.symbol is Symbol.GOUGE]
    assert x == pytest.approx(0.0)
    assert 0.75 <= y / 25.4 <= 1.25


def test_the_contour_that_a_path_cuts_into_is_dotted_where_it_is_in_view():
    """The view is that of the groove alone, X -1 to 1; the square reaches X 2."""
    square, groove = block(MID_SIDE_SQUARE, CutterComp.LEFT), block(((1, 1), (-1, 1)), CutterComp.ON)
    drawn = [
        Subject(derive(program(*blocks)).blocks[-1], Unit.IN).drawn(60, 20, Mode.BRAILLE)
        for blocks in ((square, groove), (groove,))
    ]
    assert drawn[0].bounds == drawn[1].bounds
    dotted = [any(Style.UNTAKEN in row for row in each.picture.styles) for each in drawn]
    assert dotted == [True, False]


def test_a_row_of_the_look_ahead_table_is_drawn_with_its_own_path():
    part = program(block(NOTCH, CutterComp.LEFT, lookahead=Number(1)))
    notch = derived(part)
    row = look_ahead_table(notch, part).rows[2]
    for scene, path in (
        (block_scene(notch, None, Unit.IN, row), row.compensated.path),
        (block_scene(notch, None, Unit.IN), notch.paths.loops[0].path),
    ):
        (drawn,) = [layer for layer in scene.layers if layer.style is Style.PATH]
        (only,) = drawn.parts
        assert only.points.tolist() == path.points.tolist()


@pytest.mark.parametrize("mode", list(Mode))
def test_a_scene_is_drawn_in_the_view_that_fits_it_or_in_the_one_chosen(mode):
    scene = block_scene(derived(program(block(MID_SIDE_SQUARE, CutterComp.LEFT))), None, Unit.IN)
    drawn = SceneSubject(scene, Unit.IN).drawn(60, 20, mode)
    assert drawn.view == View.fit(drawn.bounds, 60, 20)
    assert (len(drawn.picture.rows), {len(row) for row in drawn.picture.rows}) == (20, {60})
    assert drawn.scale_bar.endswith("in") or drawn.scale_bar.endswith("IN")
    chosen = View((0.0, 0.0), 1.0)
    assert SceneSubject(scene, Unit.IN, chosen).drawn(60, 20, mode).view == chosen
    for nothing in (
        SceneSubject(Scene(), Unit.IN).drawn(60, 20, mode),
        SceneSubject(scene, Unit.IN).drawn(60, 0, mode),
    ):
        assert nothing is None


def test_an_outline_is_the_surface_with_its_numbered_places_alone():
    subject = Subject(derived(program(block(NOTCH, CutterComp.LEFT))), Unit.IN)
    trouble = Mark((2.15 * 25.4, 0.0), Style.GOUGE, Symbol.NUMBER, text="7")
    drawn = replace(subject, outline=True, trouble=(trouble,)).drawn(60, 20, Mode.ASCII)
    styles = {Style(style) for row in drawn.picture.styles for style in row}
    assert styles == {Style.BACKGROUND, Style.SURFACE, Style.GOUGE}
    assert "".join(drawn.picture.rows).count("7") == 1


def test_a_cutter_of_a_few_dots_leaves_the_surface_and_its_faults():
    subject = Subject(derived(program(block(NOTCH, CutterComp.LEFT))), Unit.IN)
    small, large = (subject.drawn(*size, Mode.BRAILLE).picture.styles for size in ((12, 4), (120, 40)))
    seen = [{Style(style) for row in styles for style in row} for styles in (small, large)]
    assert [Style.PATH in each for each in seen] == [False, True]
    assert Style.GOUGE in seen[0]
