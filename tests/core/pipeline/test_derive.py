from dataclasses import replace

import numpy as np
import pytest

from core.advice.block_paths import Loop
from core.advice.path_findings import move_names, path_findings
from core.comp.blend_moves import blend_in, blend_out
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Side
from core.pipeline.derive import better_path, derive, derive_block, with_better_paths
from core.pipeline.derived import Tag
from core.pipeline.fields_stage import solve_fields
from core.pipeline.parameters import stocks
from core.program.edit import set_unit
from core.program.model import CutterComp, LineSegment, Number, PathChoice, ProgramParameters, Unread, changed
from core.units import Unit, sentence
from core.verify.judge import judge_together
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program

IN = 25.4


def codes(found):
    return [finding.code for finding in found.findings]


def test_the_over_run_square_is_clean_at_cal_and_its_over_run_is_told():
    part = program(block(OVER_RUN_SQUARE, CutterComp.RIGHT))
    (found,) = derive(part).blocks
    assert (found.lookahead.value, found.lookahead.tag) == (2, Tag.CAL)
    assert found.postable
    assert "OVER_RUN" in codes(found)
    assert len(found.paths.verdict.uncut) == 0

    mended = replace(part, blocks=(replace(part.blocks[0], lookahead=Number(4)),))
    (found,) = derive(mended).blocks
    assert (found.lookahead.value, found.lookahead.tag, found.lookahead.calculated) == (4, Tag.USR, 2)
    assert found.postable
    np.testing.assert_allclose(found.paths.center.points / IN, [(-1, -0.25), (-0.25, -0.25), (-0.25, -1)], atol=1e-9)
    assert found.paths.verdict.uncut_length / IN == pytest.approx(8.0, abs=1e-5)
    assert found.paths.verdict.surface_length / IN == pytest.approx(8.0, abs=1e-12)
    assert "USR_LOOKAHEAD" in codes(found)
    assert "OVER_RUN" in codes(found)
    assert "CROSSES_ITSELF" not in codes(found)


def test_errors_come_before_warnings_and_warnings_before_the_rest():
    (found,) = derive(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT))).blocks
    order = [list(Severity).index(finding.severity) for finding in found.findings]
    assert order == sorted(order)


def test_on_runs_on_the_contour_and_is_not_judged():
    (found,) = derive(program(block(NOTCH, CutterComp.ON))).blocks
    assert found.side is None
    assert found.paths.compensated is None
    assert found.paths.verdict is None
    np.testing.assert_allclose(found.paths.center.points / IN, NOTCH, atol=1e-12)


def test_every_block_has_its_place_in_the_program_as_its_number():
    first, second = block(NOTCH, CutterComp.LEFT), block(OUTSIDE_SQUARE, CutterComp.RIGHT)
    derived = derive(program(second, first))
    assert [found.number for found in derived.blocks] == [1, 2]
    assert derived.blocks[0].solved.closed
    alone, together = derive_block(derived.program, 2), derived.block(2)
    assert alone.paths.center.points.tolist() == together.paths.center.points.tolist()


def test_an_outline_knows_the_look_ahead_but_no_path():
    (found,) = solve_fields(program(block(OUTSIDE_SQUARE, CutterComp.RIGHT))).blocks
    assert found.lookahead.value == 3
    assert found.paths is None
    assert not found.known
    assert not found.postable


def test_the_part_that_is_determined_is_compensated_while_the_rest_is_typed():
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    typed = replace(typed, segments=(*typed.segments[:2], LineSegment(), *typed.segments[3:]))
    (found,) = derive(program(typed)).blocks
    assert len(found.paths.surface) == 2
    assert "MISSING" in codes(found)
    assert not found.postable


def test_text_that_cannot_be_read_blocks_posting():
    typed = replace(block(NOTCH, CutterComp.LEFT), lookahead=Number(3), plunge_feed=Unread("2..0", "two points"))
    (found,) = derive(program(typed)).blocks
    assert found.paths.verdict.clean
    assert not found.postable


def test_profile_comes_in_from_the_largest_offset_and_a_finish_tool_leaves_its_stock():
    parameters = ProgramParameters(
        blend_offset=Number(0),
        blend_overlap=Number(0),
        max_offset=Number(1.0),
        pocket_overlap=Number(20.0),
        finish_xy=Number(0.02),
    )
    typed = block(OUTSIDE_SQUARE, CutterComp.PROFILE_RIGHT, finish_tool=Number(2))
    (found,) = derive(program(typed, parameters=parameters)).blocks
    # 0.5 across less 20 percent steps in by 0.4: 1.0, 0.6, 0.2, then the stock of 0.02
    assert [one.stock / IN for one in found.paths.rough] == pytest.approx([1.0, 0.6, 0.2, 0.02])
    assert found.radius / IN == pytest.approx(0.125)
    lowest = [float(one.loops[0].path.points[:, 1].min()) / IN for one in found.paths.rough]
    assert lowest == pytest.approx([-1.25, -0.85, -0.45, -0.27])
    assert float(found.paths.center.points[:, 1].min()) / IN == pytest.approx(-0.125)
    assert stocks(found, derive(program(typed, parameters=parameters)).program) == tuple(
        one.stock for one in found.paths.rough
    )


def test_a_gouging_roughing_pass_is_an_error_of_its_own():
    """The stock's larger radius does not fit into the corner notch that the small finish tool clears."""
    slot = ((0, 0), (2, 0), (2, -1), (2.3, -1), (2.3, 0), (5, 0))
    typed = block(slot, CutterComp.LEFT, finish_tool=Number(2))
    (found,) = derive(program(typed)).blocks
    assert found.paths.verdict.clean
    assert [finding.code for finding in found.errors] == ["ROUGH_GOUGES"]


def test_a_roughing_pass_that_keeps_its_distance_says_nothing():
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.02))
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT, finish_tool=Number(2))
    (found,) = derive(program(typed, parameters=parameters)).blocks
    (rough,) = found.paths.rough
    assert rough.verdict.clearance / IN == pytest.approx(0.27)
    assert not [code for code in codes(found) if code.startswith("ROUGH")]


def test_a_roughing_pass_that_does_not_leave_its_stock_is_told_by_what_it_leaves():
    """The start in an inside corner lets the first pass run into the last wall's stock, yet not into the part."""
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.3))
    step = ((0.28, 0), (2, 0), (2, 2), (0, 2), (0, 0.5))
    typed = block(step, CutterComp.LEFT, finish_tool=Number(2))
    (found,) = derive(program(typed, parameters=parameters)).blocks
    (told,) = [finding for finding in found.findings if finding.code == "ROUGH_STOCK"]
    assert told.severity is Severity.WARNING
    assert told.segment == 4
    assert told.value / IN == pytest.approx(0.03)
    assert sentence(told, Unit.IN).startswith("Roughing that should leave 0.3000 leaves only 0.0300 at X 0.0000")
    assert found.paths.verdict.clean


def test_stock_is_judged_on_the_path_that_is_posted():
    """The best path has room for its stock wherever it runs, whatever the control's path would do."""
    parameters = ProgramParameters(
        blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.3), path=PathChoice.BEST
    )
    step = ((0.28, 0), (2, 0), (2, 2), (0, 2), (0, 0.5))
    (found,) = derive(program(block(step, CutterComp.LEFT, finish_tool=Number(2)), parameters=parameters)).blocks
    assert not [code for code in codes(found) if code == "ROUGH_STOCK"]


def test_a_blend_arc_that_gouges_is_named():
    parameters = ProgramParameters(blend_offset=Number(0.9), blend_overlap=Number(0))
    narrow = ((1, 0), (2, 0), (2, 0.8), (0, 0.8), (0, 0), (1, 0))
    (found,) = derive(program(block(narrow, CutterComp.LEFT), parameters=parameters)).blocks
    assert [finding.code for finding in found.errors].count("BLEND_GOUGES") == 2
    told = {finding.text.split(", by ")[1] for finding in found.errors if finding.code == "GOUGE"}
    assert told == {"the blend-in arc.", "the blend-out arc."}


def test_a_move_past_start_that_gouges_is_named():
    """The overlap runs along the first segment again, as wrong as the first time."""
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0.5))
    hook = ((1, 0), (2, 0), (2, 1), (0.9, 1), (0.9, 0.3), (0, 0.3), (0, 0), (1, 0))
    (found,) = derive(program(block(hook, CutterComp.LEFT, lookahead=Number(1)), parameters=parameters)).blocks
    work = found.paths
    assert work is not None
    name = move_names(work)
    rows = np.cumsum([0, *(len(part) for loop in work.loops for part in (loop.lead_in, loop.path, loop.lead_out))])
    assert name(0, 1.0) == "the path of 1"
    assert name(rows[2] - 1, 0.0) == "the path of 7"
    assert name(rows[3] - 1, 0.0) == "the path of 1 past START"


def test_a_tool_larger_than_the_part_is_said():
    tiny = ((0, 0), (0.2, 0), (0.2, 0.2), (0, 0.2), (0, 0))
    (found,) = derive(program(block(tiny, CutterComp.RIGHT))).blocks
    assert "TOOL_LARGE" in codes(found)


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
    """Between the two chambers is a passage of 0.4, which the cutter of 0.5 cannot enter."""
    found = best(DUMBBELL, CutterComp.LEFT)
    assert len(found.paths.loops) == 2
    assert found.postable
    assert [float(loop.path.lengths.sum()) / IN for loop in found.paths.loops] == pytest.approx([6.0, 6.0], abs=0.2)
    control = derive(program(block(DUMBBELL, CutterComp.LEFT, lookahead=Number(1)))).blocks[0]
    assert len(control.paths.loops) == 1
    assert not control.postable


def test_the_corner_over_start_is_told_as_the_last_segment():
    corners = ((0.0, 0.0), (0.0, 3.0), (5.0, 3.0), (5.0, 0.0), (0.0, 0.0))
    (found,) = with_better_paths(derive(program(block(corners, CutterComp.LEFT)))).blocks
    (more,) = (one for one in found.findings if one.code == "BEST_DIFFERS")
    assert more.segment == 4.0


def test_the_form_says_what_the_best_path_cuts_more():
    """From three on the look-ahead erases most of the over-run square; its true offset runs all round."""
    (found,) = with_better_paths(derive(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT, lookahead=Number(4))))).blocks
    (more,) = [finding for finding in found.findings if finding.code == "BEST_DIFFERS"]
    assert more.value > 8 * IN


def test_where_the_control_path_is_clean_and_complete_the_best_path_is_the_same():
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    control = derive(part).blocks[0]
    assert better_path(control) == ()
    found = best(MID_SIDE_SQUARE, CutterComp.LEFT)
    np.testing.assert_allclose(found.paths.center.points, control.paths.center.points, atol=1e-9)


def test_the_cutter_that_fits_nowhere_has_no_best_path_and_nothing_is_posted():
    tiny = ((0.2, 0), (0.4, 0), (0.4, 0.4), (0, 0.4), (0, 0), (0.2, 0))
    found = best(tiny, CutterComp.LEFT)
    assert found.paths.loops == ()
    assert "NO_PATH" in [finding.code for finding in found.errors]
    assert not found.postable


def test_the_same_part_is_cut_in_the_other_unit():
    part = replace(program(block(NOTCH, CutterComp.LEFT)), parameters=ProgramParameters())
    inch, metric = derive(part).blocks[0], derive(set_unit(part, Unit.MM)).blocks[0]
    np.testing.assert_allclose(metric.paths.center.points, inch.paths.center.points, atol=1e-9)


@pytest.mark.parametrize(("height", "limit"), [(0.1, "Z START"), (-0.3, "Z BOTTOM")])
def test_a_z_end_outside_the_block_is_an_error_of_its_segment(height, limit):
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    steep = changed(typed.segments[1], {"z_end": Number(height)})
    (found,) = derive(program(replace(typed, segments=(typed.segments[0], steep, *typed.segments[2:])))).blocks
    (wrong,) = [finding for finding in found.errors if finding.code == "Z_END"]
    assert (wrong.segment, wrong.field) == (2.0, "z_end")
    assert limit in wrong.text


def test_a_path_that_leaves_the_part_or_turns_back_is_told():
    (found,) = derive(program(block(NOTCH, CutterComp.LEFT))).blocks
    assert not {"AWAY", "BACKWARDS"} & set(codes(found))
    work, radius = found.paths, found.radius
    assert work is not None
    assert radius is not None
    start, end = (0.0, radius), (0.5 * IN, radius)
    corners = (start, (0.3 * IN, radius), (0.35 * IN, 2 * radius), (0.4 * IN, radius), (0.2 * IN, radius), end)
    path = Path.of(np.array(corners), np.array(corners[:-1]), np.zeros(5, np.int8), np.ones(5))
    loop = Loop(path, blend_in(path, Side.LEFT, 1.0), blend_out(path, Side.LEFT, 1.0, 0.0, closed=False))
    verdict = judge_together(work.surface, Side.LEFT, radius, [loop.whole])
    told = path_findings(replace(work, loops=(loop,), verdict=verdict))
    against, away = (one for one in told if one.code in ("AWAY", "BACKWARDS"))
    assert against.text == "1 move runs against the direction of the contour."
    assert away.lengths[0] == pytest.approx(radius)
