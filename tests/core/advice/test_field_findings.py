"""Findings on the fields of a block that are blank, without effect, or too low."""

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


def findings_of(part, code):
    (typed,) = part.blocks
    findings = (*shared_findings(part), *field_findings(typed, solve_block(typed, part), part))
    return [(finding, sentence(finding, part.unit)) for finding in findings if finding.code == code]


def fed(*feeds, plunge=5.0):
    """A contour with these feeds, None for a blank one."""
    segments = tuple(
        LineSegment(x_end=Number(float(x)), y_end=Number(0.0), feed=None if feed is None else Number(feed))
        for x, feed in enumerate(feeds, 1)
    )
    plain = block(NOTCH, CutterComp.LEFT)
    return program(replace(plain, segments=segments, plunge_feed=None if plunge is None else Number(plunge)))


@pytest.mark.parametrize(
    ("feeds", "subject"),
    [
        ((None, None, None), "the contour is"),
        ((None,), "the contour is"),
        ((None, 8.0, None), "it is"),
        ((None, None, 8.0), "segments 1 to 2 are"),
    ],
)
def test_cutting_at_the_plunge_feed_is_reported(feeds, subject):
    ((finding, text),) = findings_of(fed(*feeds), "PLUNGE_FED")
    assert (finding.severity, finding.segment, finding.field) == (Severity.WARNING, 1, "feed")
    assert text == f"FEED is blank: {subject} cut at PLUNGE FEED 5.0. Enter FEED."


def test_the_plunge_feed_is_shown_in_program_units():
    ((_, text),) = findings_of(replace(fed(None, plunge=500.0), unit=Unit.MM), "PLUNGE_FED")
    assert "PLUNGE FEED 500.0." in text


def test_a_plunge_feed_faster_than_rapid_is_reported():
    """2400 is a SPEED (RPM), typed into the wrong field; 200 in a minute is the usual RAPID RATE."""
    ((finding, text),) = findings_of(fed(5.0, plunge=2400.0), "FAST_FEED")
    assert (finding.severity, finding.segment, finding.field) == (Severity.WARNING, 0, "plunge_feed")
    assert text == "PLUNGE FEED 2400.0 is faster than RAPID RATE 200.0. Correct it, or RAPID RATE with F4."
    assert not findings_of(fed(5.0, plunge=200.0), "FAST_FEED")
    assert not findings_of(fed(5.0, plunge=None), "FAST_FEED")
    assert not findings_of(replace(fed(5.0, plunge=5000.0), unit=Unit.MM), "FAST_FEED")


def test_a_feed_faster_than_the_typed_rapid_rate_is_reported_once():
    part = fed(80.0, 300.0, None, 400.0)
    assert not findings_of(part, "FAST_FEED"), "RAPID RATE is only assumed"
    part = replace(part, parameters=ProgramParameters(rapid_feed=Number(250.0)))
    ((finding, text),) = findings_of(part, "FAST_FEED")
    assert (finding.segment, finding.field) == (2, "feed")
    assert text == "FEED 300.0 is faster than RAPID RATE 250.0. Correct it, or RAPID RATE with F4."


@pytest.mark.parametrize("part", [fed(8.0, None), fed(), fed(None, plunge=None)])
def test_a_typed_or_unknown_feed_is_not_reported(part):
    assert findings_of(part, "PLUNGE_FED") == []


@pytest.mark.parametrize("proposed", [12.0, None])
def test_a_blank_feed_that_the_tool_table_fills_is_not_reported(proposed):
    part = fed(None, None)
    feed = None if proposed is None else Number(proposed)
    tools = tuple(replace(tool, feed=feed) for tool in part.tools)
    assert bool(findings_of(replace(part, tools=tools), "PLUNGE_FED")) == (proposed is None)


def test_an_unreadable_feed_is_not_reported_as_blank():
    part = fed(8.0)
    (typed,) = part.blocks
    unread = replace(typed.segments[0], feed=Unread("x", "no number"))
    assert findings_of(replace(part, blocks=(replace(typed, segments=(unread,)),)), "PLUNGE_FED") == []


def test_the_blank_feed_of_an_empty_segment_is_not_reported():
    part = fed(None)
    (typed,) = part.blocks
    assert findings_of(replace(part, blocks=(replace(typed, segments=(LineSegment(),)),)), "PLUNGE_FED") == []


@pytest.mark.parametrize(("name", "label"), [("finish_xy", "FINISH XY"), ("finish_z", "FINISH Z")])
@pytest.mark.parametrize("number", [None, Number(0.0)])
def test_a_finish_allowance_without_a_finish_tool_is_reported(name, label, number):
    parameters = changed(ProgramParameters(), {name: Number(2.6)})
    part = program(block(NOTCH, CutterComp.LEFT, finish_tool=number), parameters=parameters)
    ((finding, text),) = findings_of(part, "NOT_LEFT")
    assert (finding.severity, finding.segment, finding.field) == (Severity.WARNING, 0, "finish_tool")
    assert text == (
        f"{label} 2.6000 has no effect: FINISH TOOL is 0. Enter FINISH TOOL on START, or 0 in {label} "
        "on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize(
    ("tool", "allowance"), [(Number(2.0), Number(0.1)), (Number(0.0), Number(0.0)), (Number(0.0), None), (None, None)]
)
def test_a_finish_allowance_is_not_reported_if_it_is_zero_or_has_a_tool(tool, allowance):
    parameters = ProgramParameters(finish_xy=allowance, finish_z=allowance)
    assert (
        findings_of(program(block(NOTCH, CutterComp.LEFT, finish_tool=tool), parameters=parameters), "NOT_LEFT") == []
    )


def pecked(clearance, peck=0.1, unit=Unit.IN):
    """A slot 0.25 deep with this PECK CLEARANCE and PECK DEPTH."""
    part = program(
        block(NOTCH, CutterComp.LEFT, peck_depth=Number(peck)),
        parameters=ProgramParameters(peck_clearance=Number(clearance)),
    )
    return replace(part, unit=unit)


@pytest.mark.parametrize("clearance", [0.0, -0.0, 0.00004])
def test_a_rapid_down_to_the_last_floor_is_reported(clearance):
    ((finding, text),) = findings_of(pecked(clearance), "NO_CLEARANCE")
    assert (finding.severity, finding.segment, finding.field) == (Severity.WARNING, None, "peck_clearance")
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
def test_pecks_without_a_rapid_down_to_the_floor_are_not_reported(part):
    assert findings_of(part, "NO_CLEARANCE") == []


def test_a_retract_clearance_that_shows_as_zero_is_reported():
    part = replace(pecked(0.1, unit=Unit.MM), parameters=ProgramParameters(retract_clearance=Number(0.0004)))
    ((finding, text),) = findings_of(part, "NO_CLEARANCE")
    assert (finding.severity, finding.field) == (Severity.WARNING, "retract_clearance")
    assert text == (
        "RETRACT CLEARANCE is 0.000: the tool rapids right to the top of the stock. "
        "Enter RETRACT CLEARANCE on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize("clearance", [0.0, -0.1])
def test_a_zero_or_negative_retract_clearance_is_an_error(clearance):
    part = replace(pecked(0.05), parameters=ProgramParameters(retract_clearance=Number(clearance)))
    ((finding, text),) = findings_of(part, "OUT_OF_RANGE")
    assert (finding.severity, finding.field) == (Severity.ERROR, "retract_clearance")
    assert text == "PROGRAM PARAMETERS: RETRACT CLEARANCE must be above 0, at most 10000."
    assert findings_of(part, "NO_CLEARANCE") == []


def profiled(comp, offset, finish_xy=None, **changes):
    parameters = ProgramParameters(max_offset=offset, finish_xy=finish_xy)
    return program(block(MID_SIDE_SQUARE, comp, **changes), parameters=parameters)


@pytest.mark.parametrize(("comp", "plain"), [(CutterComp.PROFILE_LEFT, "LEFT"), (CutterComp.PROFILE_RIGHT, "RIGHT")])
@pytest.mark.parametrize("offset", [None, Number(0.0)])
def test_a_profile_without_max_offset_is_reported_as_one_pass(comp, plain, offset):
    ((finding, text),) = findings_of(profiled(comp, offset), "ONE_PASS")
    assert (finding.severity, finding.segment, finding.field) == (Severity.WARNING, 0, "cutter_comp")
    assert text == (
        f"MAX OFFSET is 0.0000: PROFILE {plain} makes one pass, the same as {plain}. "
        f"Enter MAX OFFSET on PROGRAM PARAMETERS, or {plain} in CUTTER COMP."
    )


def test_a_max_offset_no_larger_than_finish_xy_is_reported():
    part = profiled(CutterComp.PROFILE_LEFT, Number(0.1), Number(0.1), finish_tool=Number(2))
    ((finding, text),) = findings_of(part, "ONE_PASS")
    assert finding.severity is Severity.WARNING
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
def test_a_profile_in_several_passes_or_no_profile_is_not_reported(part):
    assert findings_of(part, "ONE_PASS") == []


def alone(segment, comp=CutterComp.LEFT):
    return program(replace(block(((0, 0),), comp), segments=(segment,)))


LINE = LineSegment(x_end=Number(2.0), y_end=Number(1.0), feed=Number(8.0))
ARC = ArcSegment(x_center=Number(0.0), y_center=Number(1.0), feed=Number(8.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT])
@pytest.mark.parametrize("segment", [LINE, replace(ARC, sweep=Number(90.0))])
def test_a_contour_of_one_segment_is_reported_as_an_open_path(segment, comp):
    ((finding, text),) = findings_of(alone(segment, comp), "ONE_SEGMENT")
    x, y = (2.0, 1.0) if segment is LINE else (-1.0, 1.0)
    assert (finding.severity, finding.segment) == (Severity.INFO, 1)
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
def test_a_closed_or_unknown_contour_is_not_reported_as_an_open_path(part):
    assert findings_of(part, "ONE_SEGMENT") == []


def test_a_single_line_with_only_its_x_end_is_an_open_path_that_keeps_y():
    ((_, text),) = findings_of(alone(LineSegment(x_end=Number(2.0))), "ONE_SEGMENT")
    assert "an open path from START to X 2.0000 Y 0.0000." in text


def test_segments_without_length_do_not_count():
    part = alone(LINE)
    (typed,) = part.blocks
    zero = LineSegment(x_end=Number(2.0), y_end=Number(1.0))
    ((finding, _),) = findings_of(replace(part, blocks=(replace(typed, segments=(LINE, zero)),)), "ONE_SEGMENT")
    assert finding.segment == 1


POINT = LineSegment(x_end=Number(0.0), y_end=Number(0.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.PROFILE_RIGHT])
@pytest.mark.parametrize("count", [1, 3])
def test_a_contour_without_any_length_is_an_error(count, comp):
    part = alone(POINT, comp)
    (typed,) = part.blocks
    ((finding, text),) = findings_of(replace(part, blocks=(replace(typed, segments=(POINT,) * count),)), "NO_LENGTH")
    assert (finding.severity, finding.segment, finding.field, finding.at) == (Severity.ERROR, 1, "x_end", (0.0, 0.0))
    assert text == "No segment has a length: the contour is a point, and there is no path. Correct X END or Y END."


@pytest.mark.parametrize("segments", [(), (POINT, LINE), (LINE, POINT), (POINT, LineSegment(x_end=Number(1.0)))])
def test_a_contour_with_a_known_or_possible_length_is_no_error(segments):
    part = alone(POINT)
    (typed,) = part.blocks
    assert findings_of(replace(part, blocks=(replace(typed, segments=segments),)), "NO_LENGTH") == []


def safe_z_findings(safe, *, z_start=0.0, retract=None):
    typed = replace(block(MID_SIDE_SQUARE, CutterComp.LEFT), z_start=Number(z_start))
    part = replace(
        program(typed), setup=PartSetup(safe_z=safe), parameters=ProgramParameters(retract_clearance=retract)
    )
    return [(finding.severity, finding.field, text) for finding, text in findings_of(part, "SAFE_Z")]


@pytest.mark.parametrize("safe", [Number(-1.0), Number(0.0999)])
def test_a_safe_z_in_the_part_or_below_the_clearance_is_a_warning(safe):
    ((severity, field, text),) = safe_z_findings(safe)
    assert (severity, field) == (Severity.WARNING, "safe_z")
    assert text.startswith(f"SAFE Z {safe.value:.4f} is below Z 0.1000, RETRACT CLEARANCE 0.1000 over Z START 0.0000:")
    assert "0.1000 instead" in text


def test_a_default_safe_z_below_z_start_is_reported():
    ((severity, _, text),) = safe_z_findings(None, z_start=2.0)
    assert severity is Severity.INFO
    assert text.startswith("SAFE Z 1.0000 is below Z 2.1000")


@pytest.mark.parametrize("safe", [None, Number(0.1), Unread("x", "no number"), Number(1e300)])
def test_a_safe_z_that_is_high_enough_or_refused_is_not_reported(safe):
    assert safe_z_findings(safe) == []


def test_safe_z_is_not_reported_if_the_clearance_is_refused():
    assert safe_z_findings(Number(-1.0), retract=Unread("x", "no number")) == []


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
    ((finding, text),) = findings_of(part, "Z_END")
    assert (finding.severity, finding.segment, finding.field) == (Severity.ERROR, 2.0, "z_end")
    assert text == expected


def test_z_ends_at_the_top_and_at_the_bottom_are_accepted():
    segments = tuple(
        LineSegment(x_end=Number(x), y_end=Number(0.0), z_end=Number(z)) for x, z in ((1.0, 0.0), (2.0, -0.25))
    )
    assert findings_of(program(replace(block(NOTCH, CutterComp.LEFT), segments=segments)), "Z_END") == []


def test_the_warning_of_a_typed_look_ahead_names_the_calculated_one():
    warning = typed_lookahead_warning(4, 8)
    assert (warning.code, warning.severity, warning.field) == ("USR_LOOKAHEAD", Severity.WARNING, "lookahead")
    assert warning.text == "USR 4 in force, CAL is 8. F3 goes back to CAL."


def test_a_finish_tool_without_an_allowance_is_reported():
    def part(**allowances):
        parameters = ProgramParameters(**allowances)
        return program(block(NOTCH, CutterComp.LEFT, finish_tool=Number(1)), parameters=parameters)

    ((finding, _),) = findings_of(part(), "NOTHING_LEFT")
    assert (finding.severity, finding.field) == (Severity.INFO, "finish_tool")
    assert not findings_of(part(finish_xy=Number(0.02)), "NOTHING_LEFT")
    assert not findings_of(part(finish_z=Number(0.02)), "NOTHING_LEFT")
    assert not findings_of(program(block(NOTCH, CutterComp.LEFT)), "NOTHING_LEFT")


def test_a_smaller_finish_tool_without_allowance_still_cuts_the_corners():
    part = program(block(NOTCH, CutterComp.LEFT, finish_tool=Number(9)))
    for diameter, count in ((0.1, 0), (5.0, 1)):
        tools = (*part.tools, Tool(9, "END MILL", Number(diameter)))
        assert len(findings_of(replace(part, tools=tools), "NOTHING_LEFT")) == count


@pytest.mark.parametrize(
    ("typed", "texts"),
    [
        ({"offset": 12.0}, ["OFFSET has no effect without PARALLEL TO. Enter PARALLEL TO, or blank OFFSET."]),
        ({"point_y": 5.0}, ["POINT Y has no effect without POINT X. Enter POINT X, or blank POINT Y."]),
        ({"point_dist": 5.0}, ["DISTANCE has no effect without POINT X. Enter POINT X, or blank DISTANCE."]),
        ({"point_x": 5.0, "point_y": 0.0, "point_dist": 0.0}, []),
    ],
)
def test_a_number_without_effect_is_reported(typed, texts):
    line = LineSegment(x_end=Number(9.0), y_end=Number(0.0))
    line = changed(line, {name: Number(value) for name, value in typed.items()})
    part = program(replace(block(NOTCH, CutterComp.LEFT), x_start=Number(0.0), y_start=Number(0.0), segments=(line,)))
    found = findings_of(part, "NO_PARTNER")
    assert [text for _, text in found] == texts
    assert all((finding.severity, finding.segment) == (Severity.WARNING, 1) for finding, _ in found)


@pytest.mark.parametrize(
    ("unit", "diameter", "bottom", "words"),
    [
        (Unit.IN, 2400.0, -0.25, "Tool 1 is 2400.0000 across, more than any usual cutter. Is its unit right?"),
        (Unit.IN, 20.0, -0.25, ""),
        (Unit.MM, 24000.0, -5.0, "Tool 1 is 24000.000 across, more than any usual cutter. Is its unit right?"),
        (Unit.MM, 500.0, -5.0, ""),
        (Unit.MM, 0.375, -1.0, "Tool 1 is 0.375 across. Was 3/8 in meant?"),
        (Unit.MM, 0.5, -6.0, "Tool 1 is 0.500 across. Was 1/2 in meant?"),
        (Unit.MM, 0.5, -1.0, ""),
        (Unit.MM, 0.4, -6.0, ""),
        (Unit.MM, 10.0, -6.0, ""),
        (Unit.IN, 0.375, -6.0, ""),
    ],
)
@pytest.mark.parametrize("name", ["tool", "finish_tool"])
def test_a_diameter_that_may_be_in_the_other_unit_is_a_warning(unit, diameter, bottom, words, name):
    calls = {"tool": Number(2), name: Number(1), "z_bottom": Number(bottom)}
    plain = changed(block(MID_SIDE_SQUARE, CutterComp.LEFT), calls)
    tools = (Tool(1, diameter=Number(diameter)), Tool(2, diameter=Number(0.4)))
    found = findings_of(replace(program(plain), unit=unit, tools=tools), "TOOL_SIZE")
    text = f"{words} The program is in {'INCH' if unit is Unit.IN else 'MM'}. F6 is TOOL SETUP."
    assert [(finding.severity, finding.segment, finding.field, sentence) for finding, sentence in found] == (
        [(Severity.WARNING, 0, name, text)] if words else []
    )
