"""What the whole pipeline says of a contour: gaps, steps in Z, blend arcs, fields that all blocks share."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.finding import Finding, Severity
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.pipeline.fields_stage import solve_fields
from core.pipeline.parameters import stocks
from core.program.model import BlendSegment, CutterComp, LineSegment, Number, ProgramParameters, Segment, Unread
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, OUTSIDE_SQUARE, OVER_RUN_SQUARE, Points, block, program


def gaps(points: Points) -> list[Finding]:
    (found,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    return [one for one in found.findings if one.code in ("OPEN", "NEARLY_CLOSED")]


@pytest.mark.parametrize(
    ("end", "code", "apart"),
    [((0, 0.05), "NEARLY_CLOSED", 1.27), ((0.3, 0.4), "NEARLY_CLOSED", 12.7), ((0, 0.6), "OPEN", 15.24)],
)
def test_the_gap_is_a_warning_where_it_is_no_wider_than_the_tool(end: tuple[float, float], code: str, apart: float):
    (one,) = gaps((*OUTSIDE_SQUARE[:-1], end))
    assert (one.code, one.segment) == (code, 4.0)
    assert one.value == pytest.approx(apart)
    assert one.at == pytest.approx((25.4 * end[0], 25.4 * end[1]))


def test_a_closed_contour_is_not_open() -> None:
    assert gaps(OUTSIDE_SQUARE) == []


def test_a_gap_with_which_it_counts_as_closed_is_told_since_the_path_gouges_beside_it() -> None:
    (found,) = derive(program(block((*OUTSIDE_SQUARE[:-1], (0, 0.0001)), CutterComp.RIGHT))).blocks
    assert found.solved.closed
    (one,) = (one for one in found.findings if one.code == "NEARLY_CLOSED")
    assert one.severity is Severity.WARNING
    assert "is treated as closed but ends" in one.text
    assert one.value == pytest.approx(0.00254)


def test_two_lines_enclose_nothing() -> None:
    assert gaps(((0, 0), (2, 0), (0.1, 0))) == []


IN = 25.4


def sloped(*segments: Segment, comp: CutterComp = CutterComp.ON) -> DerivedBlock:
    """The block of these segments from 0, 0 and Z BOTTOM -0.25."""
    typed = replace(block(((0, 0), (1, 0)), comp), segments=segments)
    return derive(program(typed)).blocks[0]


def line(x: float, y: float, z: float | None = None) -> LineSegment:
    return LineSegment(x_end=Number(x), y_end=Number(y), z_end=None if z is None else Number(z))


def steps(found: DerivedBlock) -> list[tuple[float | None, float, str]]:
    """Of each step told: the segment behind it, how far, and the sentence."""
    told = [one for one in found.findings if one.code == "Z_STEP"]
    assert all(one.severity is Severity.WARNING for one in told)
    return [(one.segment, round(one.value / IN, 6), sentence(one, Unit.IN)) for one in told]


def test_a_blend_arc_that_takes_all_of_a_slope_leaves_a_step():
    found = sloped(line(2, 0), BlendSegment(radius=Number(1)), line(2, 1, -0.1), line(0, 1))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (4, 0.15)
    assert text == "The tool goes straight up 0.1500 at X 2.0000 Y 1.0000: the ramp to Z END is shortened there."


def test_a_z_end_on_a_segment_without_length_is_a_step():
    found = sloped(line(2, 0, -0.1), line(2, 0, -0.25), line(2, 1))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (3, 0.15)
    assert text.startswith("The tool goes straight down 0.1500 at X 2.0000 Y 0.0000")


def test_a_slope_that_an_inside_corner_or_the_look_ahead_takes_leaves_a_step():
    notch = (line(2, 0), line(2, -0.3, -0.1), line(2.3, -0.3), line(2.3, 0), line(5, 0))
    found = sloped(*notch, comp=CutterComp.LEFT)
    assert [(segment, value) for segment, value, _ in steps(found)] == [(3, 0.125)]
    (deleted,) = derive(program(replace(found.block, lookahead=Number(3)))).blocks
    assert [(segment, value) for segment, value, _ in steps(deleted)] == [(4.5, 0.15)]


def test_the_deepest_of_several_steps_is_told_with_their_number():
    found = sloped(line(1, 0, -0.1), line(1, 0, -0.2), line(2, 0, -0.05), line(2, 0, -0.25), line(3, 0))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (5, 0.2)
    assert text.endswith("There are 2 such places.")


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.RIGHT])
def test_slopes_that_follow_each_other_are_no_step(comp):
    found = sloped(line(2, 0, -0.1), line(4, 0, -0.2), BlendSegment(radius=Number(0.3)), line(4, 2), comp=comp)
    assert not steps(found)


@pytest.mark.parametrize("offset", [0.25, 1.0, 1.4, 3.0])
def test_a_blend_arc_that_begins_and_ends_beyond_a_wall_is_named(offset):
    square = ((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
    parameters = ProgramParameters(blend_offset=Number(offset), blend_overlap=Number(0))
    (found,) = derive(program(block(square, CutterComp.LEFT), parameters=parameters)).blocks
    told = [sentence(one, Unit.IN) for one in found.findings if one.code == "BLEND_LEAVES"]
    far = [f"{place:.4f}" for place in (1 - offset, 1 + offset, 0.25 + offset)]
    expected = [
        f"The blend-in arc from X {far[0]} Y {far[2]} crosses a wall. Reduce BLEND OFFSET.",
        f"The blend-out arc to X {far[1]} Y {far[2]} crosses a wall. Reduce BLEND OFFSET.",
    ]
    assert told == (expected if offset > 1.0 else [])


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Number(-1.0)])
def test_a_program_parameter_that_cannot_be_used_forbids_posting(typed):
    """It would otherwise be posted with the usual value, as if nothing had been typed."""
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    assert before.blocks[0].postable
    after = derive(replace(part, parameters=replace(part.parameters, retract_clearance=typed)))
    assert [finding.field for finding in after.blocks[0].errors] == ["retract_clearance"]


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Number(1e9)])
def test_a_safe_z_that_cannot_be_used_forbids_posting_and_changes_no_path(typed):
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    after = derive(replace(part, setup=replace(part.setup, safe_z=typed)))
    assert "safe_z" in [finding.field for finding in after.blocks[0].errors]
    ours, theirs = (one.blocks[0].paths.center.points.tolist() for one in (before, after))
    assert ours == theirs


def profiled(comp, offset, finish_xy=None, **changes):
    parameters = ProgramParameters(max_offset=offset, finish_xy=finish_xy)
    return program(block(MID_SIDE_SQUARE, comp, **changes), parameters=parameters)


@pytest.mark.parametrize("offset", [0.0, 0.05, 0.1, 0.3])
@pytest.mark.parametrize("finish", [None, 0.0, 0.1])
def test_one_pass_is_told_exactly_where_there_is_one(offset, finish):
    changes = {} if finish is None else {"finish_tool": Number(2)}
    part = profiled(CutterComp.PROFILE_LEFT, Number(offset), None if finish is None else Number(finish), **changes)
    (found,) = solve_fields(part).blocks
    passes = len(stocks(found, part)) - (finish is not None)
    assert ("ONE_PASS" in [finding.code for finding in found.findings]) is (passes == 0)


def test_it_is_a_warning_beside_the_path_that_names_the_place_and_what_to_do() -> None:
    (found,) = derive(program(block(((0, 0), (2, 0), (1, 0), (1, 3)), CutterComp.LEFT))).blocks
    (one,) = (one for one in found.findings if one.code == "TURNS_BACK")
    assert one.severity is Severity.WARNING
    assert (
        sentence(one, Unit.IN) == "This segment goes straight back over segment 1 at X 2.0000 Y 0.0000. Check its end."
    )
    warnings = [told for told in found.findings if told.severity is Severity.WARNING]
    assert warnings[0] == one
    assert {told.code for told in warnings[1:]} == {"PLUNGE_FED", "CROSSES_ITSELF"}


def test_where_the_center_runs_on_the_contour_it_may() -> None:
    (found,) = derive(program(block(((0, 0), (2, 0), (0, 0)), CutterComp.ON))).blocks
    assert all(one.code != "TURNS_BACK" for one in found.findings)


@pytest.mark.parametrize("points", [OUTSIDE_SQUARE, OVER_RUN_SQUARE, MID_SIDE_SQUARE])
def test_a_plain_part_does_not(points: tuple[tuple[float, float], ...]) -> None:
    (found,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    assert all(one.code != "TURNS_BACK" for one in found.findings)
