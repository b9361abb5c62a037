"""Findings of the whole pipeline: gaps, steps in Z, blend arcs, fields that all blocks share."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.finding import Finding, Severity
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock, solve_fields
from core.pipeline.jobs import stocks
from core.program.model import BlendSegment, CutterComp, LineSegment, Number, ProgramParameters, Segment, Unread
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, OUTSIDE_SQUARE, OVER_RUN_SQUARE, Points, block, program


def gaps(points: Points) -> list[Finding]:
    (derived,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    return [finding for finding in derived.findings if finding.code in ("OPEN", "NEARLY_CLOSED")]


@pytest.mark.parametrize(
    ("end", "code", "apart"),
    [((0, 0.05), "NEARLY_CLOSED", 1.27), ((0.3, 0.4), "NEARLY_CLOSED", 12.7), ((0, 0.6), "OPEN", 15.24)],
)
def test_a_gap_is_reported_by_its_width_and_place(end: tuple[float, float], code: str, apart: float):
    (finding,) = gaps((*OUTSIDE_SQUARE[:-1], end))
    assert (finding.code, finding.segment) == (code, 4.0)
    assert finding.value == pytest.approx(apart)
    assert finding.at == pytest.approx((25.4 * end[0], 25.4 * end[1]))


def test_a_closed_contour_is_not_open() -> None:
    assert gaps(OUTSIDE_SQUARE) == []


def test_a_tiny_gap_in_a_closed_contour_is_a_warning() -> None:
    (derived,) = derive(program(block((*OUTSIDE_SQUARE[:-1], (0, 0.0001)), CutterComp.RIGHT))).blocks
    assert derived.solved.closed
    (finding,) = (finding for finding in derived.findings if finding.code == "NEARLY_CLOSED")
    assert finding.severity is Severity.WARNING
    assert "is treated as closed but ends" in finding.text
    assert finding.value == pytest.approx(0.00254)


def test_two_lines_have_no_gap() -> None:
    assert gaps(((0, 0), (2, 0), (0.1, 0))) == []


IN = 25.4


def sloped(*segments: Segment, comp: CutterComp = CutterComp.ON) -> DerivedBlock:
    """The block of these segments that starts at 0, 0 with Z BOTTOM -0.25."""
    typed = replace(block(((0, 0), (1, 0)), comp), segments=segments)
    return derive(program(typed)).blocks[0]


def line(x: float, y: float, z: float | None = None) -> LineSegment:
    return LineSegment(x_end=Number(x), y_end=Number(y), z_end=None if z is None else Number(z))


def steps(derived_block: DerivedBlock) -> list[tuple[float | None, float, str]]:
    """The segment after each reported step, its height and its message."""
    warnings = [finding for finding in derived_block.findings if finding.code == "Z_STEP"]
    assert all(finding.severity is Severity.WARNING for finding in warnings)
    return [(finding.segment, round(finding.value / IN, 6), sentence(finding, Unit.IN)) for finding in warnings]


def test_a_blend_arc_that_replaces_a_slope_leaves_a_step():
    derived_block = sloped(line(2, 0), BlendSegment(radius=Number(1)), line(2, 1, -0.1), line(0, 1))
    ((segment, value, text),) = steps(derived_block)
    assert (segment, value) == (4, 0.15)
    assert text == "The tool goes straight up 0.1500 at X 2.0000 Y 1.0000: the ramp to Z END is shortened there."


def test_a_z_end_on_a_segment_without_length_is_a_step():
    derived_block = sloped(line(2, 0, -0.1), line(2, 0, -0.25), line(2, 1))
    ((segment, value, text),) = steps(derived_block)
    assert (segment, value) == (3, 0.15)
    assert text.startswith("The tool goes straight down 0.1500 at X 2.0000 Y 0.0000")


def test_a_slope_that_a_corner_or_the_look_ahead_shortens_leaves_a_step():
    notch = (line(2, 0), line(2, -0.3, -0.1), line(2.3, -0.3), line(2.3, 0), line(5, 0))
    derived_block = sloped(*notch, comp=CutterComp.LEFT)
    assert [(segment, value) for segment, value, _ in steps(derived_block)] == [(3, 0.125)]
    (deleted,) = derive(program(replace(derived_block.block, lookahead=Number(3)))).blocks
    assert [(segment, value) for segment, value, _ in steps(deleted)] == [(4.5, 0.15)]


def test_the_deepest_of_several_steps_is_reported_with_their_count():
    derived_block = sloped(line(1, 0, -0.1), line(1, 0, -0.2), line(2, 0, -0.05), line(2, 0, -0.25), line(3, 0))
    ((segment, value, text),) = steps(derived_block)
    assert (segment, value) == (5, 0.2)
    assert text.endswith("There are 2 such places.")


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.RIGHT])
def test_consecutive_slopes_are_no_step(comp):
    derived_block = sloped(line(2, 0, -0.1), line(4, 0, -0.2), BlendSegment(radius=Number(0.3)), line(4, 2), comp=comp)
    assert not steps(derived_block)


@pytest.mark.parametrize("offset", [0.25, 1.0, 1.4, 3.0])
def test_blend_arcs_that_cross_a_wall_are_reported(offset):
    square = ((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
    parameters = ProgramParameters(blend_offset=Number(offset), blend_overlap=Number(0))
    (derived_block,) = derive(program(block(square, CutterComp.LEFT), parameters=parameters)).blocks
    messages = [sentence(finding, Unit.IN) for finding in derived_block.findings if finding.code == "BLEND_LEAVES"]
    far = [f"{place:.4f}" for place in (1 - offset, 1 + offset, 0.25 + offset)]
    remedy = "crosses a wall. Reduce BLEND OFFSET with F4: the largest that fits here is 0.7500."
    expected = [
        f"The blend-in arc from X {far[0]} Y {far[2]} {remedy}",
        f"The blend-out arc to X {far[1]} Y {far[2]} {remedy}",
    ]
    assert messages == (expected if offset > 1.0 else [])


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Number(-1.0)])
def test_an_unusable_program_parameter_prevents_posting(typed):
    """Otherwise it would be posted with the default value, as if nothing had been typed."""
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    assert before.blocks[0].postable
    after = derive(replace(part, parameters=replace(part.parameters, retract_clearance=typed)))
    assert [finding.field for finding in after.blocks[0].errors] == ["retract_clearance"]


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Number(1e9)])
def test_an_unusable_safe_z_prevents_posting_and_changes_no_path(typed):
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    after = derive(replace(part, setup=replace(part.setup, safe_z=typed)))
    assert "safe_z" in [finding.field for finding in after.blocks[0].errors]
    ours, theirs = (derived.blocks[0].paths.loops[0].with_leads.points.tolist() for derived in (before, after))
    assert ours == theirs


def profiled(comp, offset, finish_xy=None, **changes):
    parameters = ProgramParameters(max_offset=offset, finish_xy=finish_xy)
    return program(block(MID_SIDE_SQUARE, comp, **changes), parameters=parameters)


@pytest.mark.parametrize("offset", [0.0, 0.05, 0.1, 0.3])
@pytest.mark.parametrize("finish", [None, 0.0, 0.1])
def test_one_pass_is_reported_exactly_when_there_is_one(offset, finish):
    changes = {} if finish is None else {"finish_tool": Number(2)}
    part = profiled(CutterComp.PROFILE_LEFT, Number(offset), None if finish is None else Number(finish), **changes)
    (solved,) = solve_fields(part).blocks
    passes = len(stocks(solved, part)) - (finish is not None)
    assert ("ONE_PASS" in [finding.code for finding in solved.findings]) is (passes == 0)


def test_a_segment_that_turns_back_is_a_warning_with_place_and_remedy() -> None:
    (derived_block,) = derive(program(block(((0, 0), (2, 0), (1, 0), (1, 3)), CutterComp.LEFT))).blocks
    (finding,) = (finding for finding in derived_block.findings if finding.code == "TURNS_BACK")
    assert finding.severity is Severity.WARNING
    assert (
        sentence(finding, Unit.IN)
        == "This segment goes straight back over segment 1 at X 2.0000 Y 0.0000. Check its end."
    )
    warnings = [warning for warning in derived_block.findings if warning.severity is Severity.WARNING]
    assert warnings[0] == finding
    assert {warning.code for warning in warnings[1:]} == {"PLUNGE_FED", "CROSSES_ITSELF"}


def test_a_contour_may_turn_back_without_compensation() -> None:
    (derived_block,) = derive(program(block(((0, 0), (2, 0), (0, 0)), CutterComp.ON))).blocks
    assert all(finding.code != "TURNS_BACK" for finding in derived_block.findings)


@pytest.mark.parametrize("points", [OUTSIDE_SQUARE, OVER_RUN_SQUARE, MID_SIDE_SQUARE])
def test_a_plain_part_does_not_turn_back(points: tuple[tuple[float, float], ...]) -> None:
    (derived_block,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    assert all(finding.code != "TURNS_BACK" for finding in derived_block.findings)
