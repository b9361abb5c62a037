from dataclasses import replace

import numpy as np
import pytest

from core.advice.path_findings import move_names, path_findings
from core.comp.compensate import blend_in, blend_out
from core.comp.compensated import CenterPath
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Side
from core.pipeline.derive import better_path, derive, derive_block, with_better_paths
from core.pipeline.derived import Tag, solve_fields
from core.pipeline.jobs import stocks
from core.program.edit import set_unit
from core.program.model import CutterComp, LineSegment, Number, PathChoice, ProgramParameters, Unread, changed
from core.units import Unit, sentence
from core.verify.judge import judge
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program

IN = 25.4


def codes(result):
    return [finding.code for finding in result.findings]


def test_the_over_run_square_is_clean_at_cal_and_its_over_run_is_reported():
    part = program(block(OVER_RUN_SQUARE, CutterComp.RIGHT))
    (result,) = derive(part).blocks
    assert (result.lookahead.value, result.lookahead.tag) == (2, Tag.CAL)
    assert result.postable
    assert "OVER_RUN" in codes(result)
    assert len(result.paths.verdict.uncut) == 0

    mended = replace(part, blocks=(replace(part.blocks[0], lookahead=Number(4)),))
    (result,) = derive(mended).blocks
    assert (result.lookahead.value, result.lookahead.tag, result.lookahead.calculated) == (4, Tag.USR, 2)
    assert result.postable
    np.testing.assert_allclose(
        result.paths.loops[0].with_leads.points / IN, [(-1, -0.25), (-0.25, -0.25), (-0.25, -1)], atol=1e-9
    )
    assert result.paths.verdict.uncut_length / IN == pytest.approx(8.0, abs=1e-5)
    assert result.paths.verdict.surface_length / IN == pytest.approx(8.0, abs=1e-12)
    assert "USR_LOOKAHEAD" in codes(result)
    assert "OVER_RUN" in codes(result)
    assert "CROSSES_ITSELF" not in codes(result)


def test_errors_come_before_warnings_and_warnings_before_the_rest():
    (result,) = derive(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT))).blocks
    order = [list(Severity).index(finding.severity) for finding in result.findings]
    assert order == sorted(order)


def test_a_block_with_on_follows_the_contour_and_is_not_judged():
    (result,) = derive(program(block(NOTCH, CutterComp.ON))).blocks
    assert result.side is None
    assert result.paths.compensated is None
    assert result.paths.verdict is None
    np.testing.assert_allclose(result.paths.loops[0].with_leads.points / IN, NOTCH, atol=1e-12)


def test_blocks_are_numbered_by_their_place_in_the_program():
    first, second = block(NOTCH, CutterComp.LEFT), block(OUTSIDE_SQUARE, CutterComp.RIGHT)
    derived = derive(program(second, first))
    assert [derived_block.number for derived_block in derived.blocks] == [1, 2]
    assert derived.blocks[0].solved.closed
    alone, together = derive_block(derived.program, 2), derived.block(2)
    assert alone.paths.loops[0].with_leads.points.tolist() == together.paths.loops[0].with_leads.points.tolist()


def test_solved_fields_give_the_look_ahead_but_no_path():
    (result,) = solve_fields(program(block(OUTSIDE_SQUARE, CutterComp.RIGHT))).blocks
    assert result.lookahead.value == 3
    assert result.paths is None
    assert not result.complete
    assert not result.postable


def test_the_determined_part_is_compensated_while_the_rest_is_incomplete():
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    typed = replace(typed, segments=(*typed.segments[:2], LineSegment(), *typed.segments[3:]))
    (result,) = derive(program(typed)).blocks
    assert len(result.paths.surface) == 2
    assert "MISSING" in codes(result)
    assert not result.postable


def test_unreadable_text_blocks_posting():
    typed = replace(block(NOTCH, CutterComp.LEFT), lookahead=Number(3), plunge_feed=Unread("2..0", "two points"))
    (result,) = derive(program(typed)).blocks
    assert result.paths.verdict.clean
    assert not result.postable


def test_profile_steps_in_from_the_largest_offset_to_the_finish_stock():
    parameters = ProgramParameters(
        blend_offset=Number(0),
        blend_overlap=Number(0),
        max_offset=Number(1.0),
        pocket_overlap=Number(20.0),
        finish_xy=Number(0.02),
    )
    typed = block(OUTSIDE_SQUARE, CutterComp.PROFILE_RIGHT, finish_tool=Number(2))
    (result,) = derive(program(typed, parameters=parameters)).blocks
    # a diameter of 0.5 less 20 percent steps in by 0.4: 1.0, 0.6, 0.2, then the stock of 0.02
    assert [rough.stock / IN for rough in result.paths.rough] == pytest.approx([1.0, 0.6, 0.2, 0.02])
    assert result.radius / IN == pytest.approx(0.125)
    lowest = [float(rough.loops[0].path.points[:, 1].min()) / IN for rough in result.paths.rough]
    assert lowest == pytest.approx([-1.25, -0.85, -0.45, -0.27])
    assert float(result.paths.loops[0].with_leads.points[:, 1].min()) / IN == pytest.approx(-0.125)
    assert stocks(result, derive(program(typed, parameters=parameters)).program) == tuple(
        rough.stock for rough in result.paths.rough
    )


def test_too_many_side_passes_block_posting():
    parameters = ProgramParameters(max_offset=Number(1.01), pocket_overlap=Number(99.0))
    (result,) = derive(program(block(OUTSIDE_SQUARE, CutterComp.PROFILE_RIGHT), parameters=parameters)).blocks
    (finding,) = result.errors
    assert (finding.code, finding.field) == ("SIDE_PASSES", "max_offset")
    assert finding.text.startswith("MAX OFFSET makes more than 200 side passes. Reduce it or POCKET OVERLAP, ")


def test_a_gouging_roughing_pass_is_a_separate_error():
    """The roughing tool does not fit into the notch that the small finish tool clears."""
    slot = ((0, 0), (2, 0), (2, -1), (2.3, -1), (2.3, 0), (5, 0))
    typed = block(slot, CutterComp.LEFT, finish_tool=Number(2))
    (result,) = derive(program(typed)).blocks
    assert result.paths.verdict.clean
    assert [finding.code for finding in result.errors] == ["ROUGH_GOUGES"]


def test_a_roughing_pass_that_leaves_its_stock_has_no_finding():
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.02))
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT, finish_tool=Number(2))
    (result,) = derive(program(typed, parameters=parameters)).blocks
    (rough,) = result.paths.rough
    assert rough.verdict.clearance / IN == pytest.approx(0.27)
    assert not [code for code in codes(result) if code.startswith("ROUGH")]


def test_a_roughing_pass_that_cuts_into_its_stock_reports_what_it_leaves():
    """The first pass starts in an inside corner and cuts into the stock of the last wall, but not into the part."""
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.3))
    step = ((0.28, 0), (2, 0), (2, 2), (0, 2), (0, 0.5))
    typed = block(step, CutterComp.LEFT, finish_tool=Number(2))
    (result,) = derive(program(typed, parameters=parameters)).blocks
    (warning,) = [finding for finding in result.findings if finding.code == "ROUGH_STOCK"]
    assert warning.severity is Severity.WARNING
    assert warning.segment == 4
    assert warning.value / IN == pytest.approx(0.03)
    assert sentence(warning, Unit.IN).startswith("Roughing that should leave 0.3000 leaves only 0.0300 at X 0.0000")
    assert result.paths.verdict.clean


def test_stock_is_judged_on_the_path_that_is_posted():
    """The best path leaves its stock everywhere, even where the path of the control does not."""
    parameters = ProgramParameters(
        blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.3), path=PathChoice.BEST
    )
    step = ((0.28, 0), (2, 0), (2, 2), (0, 2), (0, 0.5))
    (result,) = derive(program(block(step, CutterComp.LEFT, finish_tool=Number(2)), parameters=parameters)).blocks
    assert not [code for code in codes(result) if code == "ROUGH_STOCK"]


def test_a_blend_arc_that_gouges_is_named():
    parameters = ProgramParameters(blend_offset=Number(0.9), blend_overlap=Number(0))
    narrow = ((1, 0), (2, 0), (2, 0.8), (0, 0.8), (0, 0), (1, 0))
    (result,) = derive(program(block(narrow, CutterComp.LEFT), parameters=parameters)).blocks
    assert [finding.code for finding in result.errors].count("BLEND_GOUGES") == 2
    moves = {finding.text.split(", by ")[1] for finding in result.errors if finding.code == "GOUGE"}
    assert moves == {"the blend-in arc.", "the blend-out arc."}


def test_a_move_past_start_that_gouges_is_named():
    """The overlap runs along the first segment again and gouges again."""
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0.5))
    hook = ((1, 0), (2, 0), (2, 1), (0.9, 1), (0.9, 0.3), (0, 0.3), (0, 0), (1, 0))
    (result,) = derive(program(block(hook, CutterComp.LEFT, lookahead=Number(1)), parameters=parameters)).blocks
    work = result.paths
    assert work is not None
    name = move_names(work)
    rows = np.cumsum([0, *(len(part) for loop in work.loops for part in (loop.lead_in, loop.path, loop.lead_out))])
    assert name(0, 1.0) == "the path of segment 1"
    assert name(rows[2] - 1, 0.0) == "the path of segment 7"
    assert name(rows[3] - 1, 0.0) == "the path of segment 1 past START"


def test_a_tool_larger_than_the_pocket_is_reported():
    tiny = ((0, 0), (0.2, 0), (0.2, 0.2), (0, 0.2), (0, 0))
    (pocket,) = derive(program(block(tiny, CutterComp.LEFT))).blocks
    assert "TOOL_LARGE" in codes(pocket)
    (island,) = derive(program(block(tiny, CutterComp.RIGHT))).blocks
    assert "TOOL_LARGE" not in codes(island)


def test_the_size_of_a_contour_is_not_judged_before_every_segment_is_determined():
    tiny = ((0, 0), (0.2, 0), (0.2, 0.2))
    one = block(tiny, CutterComp.LEFT)
    (unfinished,) = derive(program(replace(one, segments=(*one.segments, LineSegment())))).blocks
    assert not unfinished.solved.fully_determined
    assert "TOOL_LARGE" not in codes(unfinished)


DUMBBELL = (
    (1, 0),
    (2, 0),
    (2, 0.8),
    (3, 0.8),
    (3, 0),
    (5, 0),
    (5, 2),
    (3, 2),
    (3, 1.2),
    (2, 1.2),
    (2, 2),
    (0, 2),
    (0, 0),
    (1, 0),
)


def best(points, comp, **more):
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), path=PathChoice.BEST)
    return derive(program(block(points, comp, **more), parameters=parameters)).blocks[0]


def test_the_best_path_of_a_dumbbell_is_two_loops_judged_together():
    """The 0.5 cutter cannot enter the 0.4 passage between the two chambers."""
    result = best(DUMBBELL, CutterComp.LEFT)
    assert len(result.paths.loops) == 2
    assert result.postable
    assert [float(loop.path.lengths.sum()) / IN for loop in result.paths.loops] == pytest.approx([6.0, 6.0], abs=0.2)
    control = derive(program(block(DUMBBELL, CutterComp.LEFT, lookahead=Number(1)))).blocks[0]
    assert len(control.paths.loops) == 1
    assert not control.postable


def test_a_difference_at_the_corner_at_start_is_reported_for_the_last_segment():
    corners = ((0.0, 0.0), (0.0, 3.0), (5.0, 3.0), (5.0, 0.0), (0.0, 0.0))
    (result,) = with_better_paths(derive(program(block(corners, CutterComp.LEFT)))).blocks
    (difference,) = (finding for finding in result.findings if finding.code == "BEST_DIFFERS")
    assert difference.segment == 4.0


def test_the_additional_length_of_the_best_path_is_reported():
    """A look-ahead of three or more deletes most of the over-run square; its true offset runs all around."""
    (result,) = with_better_paths(derive(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT, lookahead=Number(4))))).blocks
    (difference,) = [finding for finding in result.findings if finding.code == "BEST_DIFFERS"]
    assert difference.value > 8 * IN


def test_the_best_path_equals_a_clean_and_complete_control_path():
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    control = derive(part).blocks[0]
    assert better_path(control) == ()
    result = best(MID_SIDE_SQUARE, CutterComp.LEFT)
    np.testing.assert_allclose(
        result.paths.loops[0].with_leads.points, control.paths.loops[0].with_leads.points, atol=1e-9
    )


def test_a_cutter_that_fits_nowhere_has_no_best_path_and_is_not_postable():
    tiny = ((0.2, 0), (0.4, 0), (0.4, 0.4), (0, 0.4), (0, 0), (0.2, 0))
    result = best(tiny, CutterComp.LEFT)
    assert result.paths.loops == ()
    assert "NO_PATH" in [finding.code for finding in result.errors]
    assert not result.postable


def test_the_path_is_the_same_in_the_other_unit():
    part = replace(program(block(NOTCH, CutterComp.LEFT)), parameters=ProgramParameters())
    inch, metric = derive(part).blocks[0], derive(set_unit(part, Unit.MM)).blocks[0]
    np.testing.assert_allclose(
        metric.paths.loops[0].with_leads.points, inch.paths.loops[0].with_leads.points, atol=1e-9
    )


@pytest.mark.parametrize(("height", "limit"), [(0.1, "Z START"), (-0.3, "Z BOTTOM")])
def test_a_z_end_outside_the_block_is_an_error_of_the_segment(height, limit):
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    steep = changed(typed.segments[1], {"z_end": Number(height)})
    (result,) = derive(program(replace(typed, segments=(typed.segments[0], steep, *typed.segments[2:])))).blocks
    (wrong,) = [finding for finding in result.errors if finding.code == "Z_END"]
    assert (wrong.segment, wrong.field) == (2.0, "z_end")
    assert limit in wrong.text


def test_a_path_that_leaves_the_part_and_turns_back_is_reported():
    (result,) = derive(program(block(NOTCH, CutterComp.LEFT))).blocks
    assert not {"AWAY", "BACKWARDS"} & set(codes(result))
    work, radius = result.paths, result.radius
    assert work is not None
    assert radius is not None
    start, end = (0.0, radius), (0.5 * IN, radius)
    corners = (start, (0.3 * IN, radius), (0.35 * IN, 2 * radius), (0.4 * IN, radius), (0.2 * IN, radius), end)
    path = Path.of(np.array(corners), np.array(corners[:-1]), np.zeros(5, np.int8), np.ones(5))
    loop = CenterPath(path, blend_in(path, Side.LEFT, 1.0), blend_out(path, Side.LEFT, 1.0, 0.0, closed=False))
    verdict = judge(work.surface, Side.LEFT, radius, [loop.with_leads])
    findings = path_findings(replace(work, loops=(loop,), verdict=verdict))
    against, away = (finding for finding in findings if finding.code in ("AWAY", "BACKWARDS"))
    assert against.text == "1 move runs against the direction of the contour."
    assert away.lengths[0] == pytest.approx(radius)
