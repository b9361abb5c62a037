"""What the fields of a block leave blank, say without effect, or put too low."""

from dataclasses import replace

import pytest

from core.advice.field_findings import field_findings, typed_lookahead_warning
from core.finding import Severity
from core.program.model import (
    ArcSegment,
    CutterComp,
    LineSegment,
    Number,
    PartSetup,
    ProgramParameters,
    Tool,
    Unread,
    changed,
)
from core.program.solve.block import solve_block
from core.program.solve.reading import shared_findings
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, block, program


def told(part, code):
    (typed,) = part.blocks
    findings = (*shared_findings(part), *field_findings(typed, solve_block(typed, part), part))
    return [(finding, sentence(finding, part.unit)) for finding in findings if finding.code == code]


def fed(*feeds, plunge=5.0):
    """A contour whose segments have these feeds, None for blank."""
    segments = tuple(
        LineSegment(x_end=Number(float(x)), y_end=Number(0.0), feed=None if feed is None else Number(feed))
        for x, feed in enumerate(feeds, 1)
    )
    plain = block(NOTCH, CutterComp.LEFT)
    return program(replace(plain, segments=segments, plunge_feed=None if plunge is None else Number(plunge)))


@pytest.mark.parametrize(
    ("feeds", "who"),
    [
        ((None, None, None), "the contour is"),
        ((None,), "the contour is"),
        ((None, 8.0, None), "it is"),
        ((None, None, 8.0), "segments 1 to 2 are"),
    ],
)
def test_a_contour_that_is_milled_with_the_plunge_feed_is_told_so(feeds, who):
    ((one, text),) = told(fed(*feeds), "PLUNGE_FED")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, 1, "feed")
    assert text == f"FEED is blank: {who} cut at PLUNGE FEED 5.0. Enter FEED."


def test_the_plunge_feed_is_told_in_the_programs_unit():
    ((_, text),) = told(replace(fed(None, plunge=500.0), unit=Unit.MM), "PLUNGE_FED")
    assert "PLUNGE FEED 500.0." in text


@pytest.mark.parametrize("part", [fed(8.0, None), fed(), fed(None, plunge=None)])
def test_nothing_is_told_of_a_typed_feed_nor_of_one_that_nothing_determines(part):
    assert told(part, "PLUNGE_FED") == []


@pytest.mark.parametrize("proposed", [12.0, None])
def test_a_blank_feed_that_the_tool_table_fills_is_no_plunge_feed(proposed):
    part = fed(None, None)
    feed = None if proposed is None else Number(proposed)
    tools = tuple(replace(tool, feed=feed) for tool in part.tools)
    assert bool(told(replace(part, tools=tools), "PLUNGE_FED")) == (proposed is None)


def test_a_feed_that_cannot_be_read_is_an_error_and_no_blank():
    part = fed(8.0)
    (one,) = part.blocks
    unread = replace(one.segments[0], feed=Unread("x", "no number"))
    assert told(replace(part, blocks=(replace(one, segments=(unread,)),)), "PLUNGE_FED") == []


def test_a_segment_that_is_still_being_typed_is_not_told_of_its_feed():
    part = fed(None)
    (one,) = part.blocks
    assert told(replace(part, blocks=(replace(one, segments=(LineSegment(),)),)), "PLUNGE_FED") == []


@pytest.mark.parametrize(("name", "label"), [("finish_xy", "FINISH XY"), ("finish_z", "FINISH Z")])
@pytest.mark.parametrize("number", [None, Number(0.0)])
def test_a_finish_allowance_without_a_finish_tool_is_told(name, label, number):
    parameters = changed(ProgramParameters(), {name: Number(2.6)})
    part = program(block(NOTCH, CutterComp.LEFT, finish_tool=number), parameters=parameters)
    ((one, text),) = told(part, "NOT_LEFT")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, 0, "finish_tool")
    assert text == (
        f"{label} 2.6000 has no effect: FINISH TOOL is 0. Enter FINISH TOOL on START, or 0 in {label} "
        "on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize(
    ("tool", "allowance"), [(Number(2.0), Number(0.1)), (Number(0.0), Number(0.0)), (Number(0.0), None), (None, None)]
)
def test_nothing_is_told_of_an_allowance_that_is_left_or_that_is_none(tool, allowance):
    parameters = ProgramParameters(finish_xy=allowance, finish_z=allowance)
    assert told(program(block(NOTCH, CutterComp.LEFT, finish_tool=tool), parameters=parameters), "NOT_LEFT") == []


def pecked(clearance, peck=0.1, unit=Unit.IN):
    """A slot 0.25 deep with this PECK CLEARANCE and PECK DEPTH."""
    part = program(
        block(NOTCH, CutterComp.LEFT, peck_depth=Number(peck)),
        parameters=ProgramParameters(peck_clearance=Number(clearance)),
    )
    return replace(part, unit=unit)


@pytest.mark.parametrize("clearance", [0.0, -0.0, 0.00004])
def test_a_rapid_onto_the_floor_just_cut_is_told(clearance):
    ((one, text),) = told(pecked(clearance), "NO_CLEARANCE")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, None, "peck_clearance")
    assert text == (
        "PECK CLEARANCE is 0.0000: between pecks it rapids right to the last floor. "
        "Enter PECK CLEARANCE on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize(
    "part",
    [
        pecked(0.05),
        pecked(0.0001),
        pecked(0.0, peck=0.0),
        pecked(0.0, peck=0.25),
        pecked(0.0, peck=0.3),
        program(block(NOTCH, CutterComp.LEFT, peck_depth=Number(0.1)), parameters=ProgramParameters()),
        program(
            block(NOTCH, CutterComp.LEFT, peck_depth=Number(0.1)),
            parameters=ProgramParameters(peck_clearance=Unread("x", "no number")),
        ),
        program(
            block(NOTCH, CutterComp.LEFT, peck_depth=Number(0.1), z_bottom=None),
            parameters=ProgramParameters(peck_clearance=Number(0.0)),
        ),
    ],
)
def test_nothing_is_told_where_no_rapid_comes_down_onto_a_floor(part):
    assert told(part, "NO_CLEARANCE") == []


def test_a_retract_clearance_that_a_field_shows_as_nothing_is_told():
    part = replace(pecked(0.1, unit=Unit.MM), parameters=ProgramParameters(retract_clearance=Number(0.0004)))
    ((one, text),) = told(part, "NO_CLEARANCE")
    assert (one.severity, one.field) == (Severity.WARNING, "retract_clearance")
    assert text == (
        "RETRACT CLEARANCE is 0.000: the tool rapids right to the top of the stock. "
        "Enter RETRACT CLEARANCE on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize("clearance", [0.0, -0.1])
def test_no_retract_clearance_and_one_below_zero_are_refused_in_the_same_words(clearance):
    part = replace(pecked(0.05), parameters=ProgramParameters(retract_clearance=Number(clearance)))
    ((one, text),) = told(part, "OUT_OF_RANGE")
    assert (one.severity, one.field) == (Severity.ERROR, "retract_clearance")
    assert text == "PROGRAM PARAMETERS: RETRACT CLEARANCE must be above 0, at most 10000."
    assert told(part, "NO_CLEARANCE") == []


def profiled(comp, offset, finish_xy=None, **changes):
    parameters = ProgramParameters(max_offset=offset, finish_xy=finish_xy)
    return program(block(MID_SIDE_SQUARE, comp, **changes), parameters=parameters)


@pytest.mark.parametrize(("comp", "plain"), [(CutterComp.PROFILE_LEFT, "LEFT"), (CutterComp.PROFILE_RIGHT, "RIGHT")])
@pytest.mark.parametrize("offset", [None, Number(0.0)])
def test_a_profile_without_max_offset_is_told_to_be_one_pass(comp, plain, offset):
    ((one, text),) = told(profiled(comp, offset), "ONE_PASS")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, 0, "cutter_comp")
    assert text == (
        f"MAX OFFSET is 0.0000: PROFILE {plain} makes one pass, the same as {plain}. "
        f"Enter MAX OFFSET on PROGRAM PARAMETERS, or {plain} in CUTTER COMP."
    )


def test_a_profile_whose_finish_allowance_is_all_of_max_offset_is_told():
    part = profiled(CutterComp.PROFILE_LEFT, Number(0.1), Number(0.1), finish_tool=Number(2))
    ((one, text),) = told(part, "ONE_PASS")
    assert one.severity is Severity.WARNING
    assert text == (
        "MAX OFFSET 0.1000 is no more than FINISH XY 0.1000: PROFILE LEFT makes one roughing pass, the same as LEFT. "
        "Enter a larger MAX OFFSET on PROGRAM PARAMETERS, or LEFT in CUTTER COMP."
    )


@pytest.mark.parametrize(
    "part",
    [
        profiled(CutterComp.PROFILE_LEFT, Number(0.1)),
        profiled(CutterComp.PROFILE_LEFT, Number(0.1), Number(0.2)),
        profiled(CutterComp.PROFILE_LEFT, Number(0.2), Number(0.1), finish_tool=Number(2)),
        profiled(CutterComp.PROFILE_LEFT, Unread("x", "no number")),
        profiled(CutterComp.PROFILE_LEFT, Number(-1.0)),
        profiled(CutterComp.LEFT, None),
        profiled(CutterComp.ON, None),
    ],
)
def test_nothing_is_told_of_a_profile_in_several_passes_and_where_there_is_none(part):
    assert told(part, "ONE_PASS") == []


def alone(segment, comp=CutterComp.LEFT):
    return program(replace(block(((0, 0),), comp), segments=(segment,)))


LINE = LineSegment(x_end=Number(2.0), y_end=Number(1.0), feed=Number(8.0))
ARC = ArcSegment(x_center=Number(0.0), y_center=Number(1.0), feed=Number(8.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT])
@pytest.mark.parametrize("segment", [LINE, replace(ARC, sweep=Number(90.0))])
def test_a_contour_of_one_segment_is_told_to_be_an_open_path(segment, comp):
    ((one, text),) = told(alone(segment, comp), "ONE_SEGMENT")
    x, y = (2.0, 1.0) if segment is LINE else (-1.0, 1.0)
    assert (one.severity, one.segment) == (Severity.INFO, 1)
    assert text == (
        f"The contour is one segment: an open path from START to X {x:.4f} Y {y:.4f}. "
        "Right arrow or Page Down on SEGMENT adds the next one."
    )


@pytest.mark.parametrize(
    "part",
    [
        alone(replace(ARC, sweep=Number(360.0))),
        alone(replace(ARC, x_end=Number(0.0), y_end=Number(0.0))),
        alone(LineSegment(length=Number(2.0))),
        alone(replace(LINE, x_end=Number(0.0), y_end=Number(0.0))),
        fed(8.0, None),
        fed(),
    ],
)
def test_a_full_circle_is_a_closed_contour_and_what_is_not_known_yet_is_told_by_itself(part):
    assert told(part, "ONE_SEGMENT") == []


def test_a_lone_line_with_only_its_x_end_is_an_open_path_that_keeps_y():
    ((_, text),) = told(alone(LineSegment(x_end=Number(2.0))), "ONE_SEGMENT")
    assert "an open path from START to X 2.0000 Y 0.0000." in text


def test_segments_without_length_do_not_count():
    part = alone(LINE)
    (one,) = part.blocks
    nothing = LineSegment(x_end=Number(2.0), y_end=Number(1.0))
    ((found, _),) = told(replace(part, blocks=(replace(one, segments=(LINE, nothing)),)), "ONE_SEGMENT")
    assert found.segment == 1


POINT = LineSegment(x_end=Number(0.0), y_end=Number(0.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.PROFILE_RIGHT])
@pytest.mark.parametrize("count", [1, 3])
def test_a_contour_without_any_length_is_an_error(count, comp):
    part = alone(POINT, comp)
    (one,) = part.blocks
    ((found, text),) = told(replace(part, blocks=(replace(one, segments=(POINT,) * count),)), "NO_LENGTH")
    assert (found.severity, found.segment, found.field, found.at) == (Severity.ERROR, 1, "x_end", (0.0, 0.0))
    assert text == "No segment has a length: the contour is a point, and there is no path. Correct X END or Y END."


@pytest.mark.parametrize("segments", [(), (POINT, LINE), (LINE, POINT), (POINT, LineSegment(x_end=Number(1.0)))])
def test_a_contour_that_has_a_length_or_may_get_one_is_no_point(segments):
    part = alone(POINT)
    (one,) = part.blocks
    assert told(replace(part, blocks=(replace(one, segments=segments),)), "NO_LENGTH") == []


def safe_z_told(safe, *, z_start=0.0, retract=None):
    one = replace(block(MID_SIDE_SQUARE, CutterComp.LEFT), z_start=Number(z_start))
    part = replace(program(one), setup=PartSetup(safe_z=safe), parameters=ProgramParameters(retract_clearance=retract))
    return [(finding.severity, finding.field, text) for finding, text in told(part, "SAFE_Z")]


@pytest.mark.parametrize("safe", [Number(-1.0), Number(0.0999)])
def test_a_safe_z_in_the_part_or_below_the_clearance_is_a_warning(safe):
    ((severity, field, text),) = safe_z_told(safe)
    assert (severity, field) == (Severity.WARNING, "safe_z")
    assert text.startswith(f"SAFE Z {safe.value:.4f} is below Z 0.1000, RETRACT CLEARANCE 0.1000 over Z START 0.0000:")
    assert "0.1000 instead" in text


def test_the_usual_safe_z_is_told_when_z_start_is_above_it():
    ((severity, _, text),) = safe_z_told(None, z_start=2.0)
    assert severity is Severity.INFO
    assert text.startswith("SAFE Z 1.0000 is below Z 2.1000")


@pytest.mark.parametrize("safe", [None, Number(0.1), Unread("x", "no number"), Number(1e300)])
def test_nothing_is_told_of_one_that_is_high_enough_or_refused(safe):
    assert safe_z_told(safe) == []


def test_nothing_is_told_where_the_clearance_is_refused():
    assert safe_z_told(Number(-1.0), retract=Unread("x", "no number")) == []


@pytest.mark.parametrize(
    ("height", "expected"),
    [
        (0.1, "Z END 0.1000 is above Z START 0.0000; rapids would hit it. Enter -0.2500 to 0.0000."),
        (-0.3, "Z END -0.3000 is below Z BOTTOM -0.2500: no pass goes so deep. Enter -0.2500 to 0.0000."),
    ],
)
def test_a_z_end_outside_the_block_is_an_error_that_names_the_range(height, expected):
    typed = block(MID_SIDE_SQUARE, CutterComp.LEFT)
    steep = changed(typed.segments[1], {"z_end": Number(height)})
    part = program(replace(typed, segments=(typed.segments[0], steep, *typed.segments[2:])))
    ((finding, text),) = told(part, "Z_END")
    assert (finding.severity, finding.segment, finding.field) == (Severity.ERROR, 2.0, "z_end")
    assert text == expected


def test_z_ends_at_the_top_and_at_the_bottom_are_in_order():
    segments = tuple(
        LineSegment(x_end=Number(x), y_end=Number(0.0), z_end=Number(z)) for x, z in ((1.0, 0.0), (2.0, -0.25))
    )
    assert told(program(replace(block(NOTCH, CutterComp.LEFT), segments=segments)), "Z_END") == []


def test_a_typed_look_ahead_is_told_with_the_calculated_one():
    warning = typed_lookahead_warning(4, 8)
    assert (warning.code, warning.severity, warning.field) == ("USR_LOOKAHEAD", Severity.WARNING, "lookahead")
    assert warning.text == "USR 4 in force, CAL is 8. F3 goes back to CAL."


def test_a_finish_tool_for_which_nothing_is_left_is_told():
    def part(**allowances):
        parameters = ProgramParameters(**allowances)
        return program(block(NOTCH, CutterComp.LEFT, finish_tool=Number(1)), parameters=parameters)

    ((one, _),) = told(part(), "NOTHING_LEFT")
    assert (one.severity, one.field) == (Severity.INFO, "finish_tool")
    assert not told(part(finish_xy=Number(0.02)), "NOTHING_LEFT")
    assert not told(part(finish_z=Number(0.02)), "NOTHING_LEFT")
    assert not told(program(block(NOTCH, CutterComp.LEFT)), "NOTHING_LEFT")


def test_a_smaller_finish_tool_without_allowance_still_cuts_the_corners():
    part = program(block(NOTCH, CutterComp.LEFT, finish_tool=Number(9)))
    for diameter, count in ((0.1, 0), (5.0, 1)):
        tools = (*part.tools, Tool(9, "END MILL", Number(diameter)))
        assert len(told(replace(part, tools=tools), "NOTHING_LEFT")) == count
