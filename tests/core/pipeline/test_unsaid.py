"""What a program leaves blank or says in vain, and what comes of it is said in words."""

from dataclasses import replace

import pytest

from core.finding import Severity
from core.pipeline.outline import outline
from core.pipeline.parameters import stocks
from core.program.model import ArcSegment, CutterComp, Entry, LineSegment, Parameters, Unread, changed
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, NOTCH, block, program


def told(part, code):
    (found,) = outline(part).blocks
    return [(one, sentence(one, part.unit)) for one in found.findings if one.code == code]


def fed(*feeds, plunge=5.0):
    """A contour whose segments have these feeds, None for blank."""
    segments = tuple(
        LineSegment(x_end=Entry(float(x)), y_end=Entry(0.0), feed=None if feed is None else Entry(feed))
        for x, feed in enumerate(feeds, 1)
    )
    plain = block(NOTCH, CutterComp.LEFT)
    return program(replace(plain, segments=segments, plunge_feed=None if plunge is None else Entry(plunge)))


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
    assert text == f"FEED is blank: {who} milled with PLUNGE FEED 5.0. Enter FEED."


def test_the_plunge_feed_is_told_in_the_programs_unit():
    ((_, text),) = told(replace(fed(None, plunge=500.0), unit=Unit.MM), "PLUNGE_FED")
    assert "PLUNGE FEED 500.0." in text


@pytest.mark.parametrize("part", [fed(8.0, None), fed(), fed(None, plunge=None)])
def test_nothing_is_told_of_a_typed_feed_nor_of_one_that_nothing_determines(part):
    assert told(part, "PLUNGE_FED") == []


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
@pytest.mark.parametrize("number", [None, Entry(0.0)])
def test_a_finish_allowance_without_a_finish_tool_is_told(name, label, number):
    parameters = changed(Parameters(), {name: Entry(2.6)})
    part = program(block(NOTCH, CutterComp.LEFT, finish_tool=number), parameters=parameters)
    ((one, text),) = told(part, "NOT_LEFT")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, 0, "finish_tool")
    assert text == (
        f"{label} 2.6000 is not left: FINISH TOOL is 0. Enter FINISH TOOL on START, or 0 in {label} "
        "on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize(
    ("tool", "allowance"), [(Entry(2.0), Entry(0.1)), (Entry(0.0), Entry(0.0)), (Entry(0.0), None), (None, None)]
)
def test_nothing_is_told_of_an_allowance_that_is_left_or_that_is_none(tool, allowance):
    parameters = Parameters(finish_xy=allowance, finish_z=allowance)
    assert told(program(block(NOTCH, CutterComp.LEFT, finish_tool=tool), parameters=parameters), "NOT_LEFT") == []


def pecked(clearance, peck=0.1, unit=Unit.IN):
    """A slot 0.25 deep with this PECK CLEARANCE and PECK DEPTH."""
    part = program(
        block(NOTCH, CutterComp.LEFT, peck_depth=Entry(peck)), parameters=Parameters(peck_clearance=Entry(clearance))
    )
    return replace(part, unit=unit)


@pytest.mark.parametrize("clearance", [0.0, -0.0, 0.00004])
def test_a_rapid_onto_the_floor_just_cut_is_told(clearance):
    ((one, text),) = told(pecked(clearance), "NO_CLEARANCE")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, None, "peck_clearance")
    assert text == (
        "PECK CLEARANCE is 0.0000: between pecks the tool comes down by rapid onto the floor it has just cut. "
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
        program(block(NOTCH, CutterComp.LEFT, peck_depth=Entry(0.1)), parameters=Parameters()),
        program(
            block(NOTCH, CutterComp.LEFT, peck_depth=Entry(0.1)),
            parameters=Parameters(peck_clearance=Unread("x", "no number")),
        ),
        program(
            block(NOTCH, CutterComp.LEFT, peck_depth=Entry(0.1), z_bottom=None),
            parameters=Parameters(peck_clearance=Entry(0.0)),
        ),
    ],
)
def test_nothing_is_told_where_no_rapid_comes_down_onto_a_floor(part):
    assert told(part, "NO_CLEARANCE") == []


def test_a_retract_clearance_that_a_field_shows_as_nothing_is_told():
    part = replace(pecked(0.1, unit=Unit.MM), parameters=Parameters(retract_clearance=Entry(0.0004)))
    ((one, text),) = told(part, "NO_CLEARANCE")
    assert (one.severity, one.field) == (Severity.WARNING, "retract_clearance")
    assert text == (
        "RETRACT CLEARANCE is 0.000: the tool comes by rapid onto the top of the material. "
        "Enter RETRACT CLEARANCE on PROGRAM PARAMETERS."
    )


@pytest.mark.parametrize("clearance", [0.0, -0.1])
def test_no_retract_clearance_and_one_below_zero_are_refused_in_the_same_words(clearance):
    part = replace(pecked(0.05), parameters=Parameters(retract_clearance=Entry(clearance)))
    ((one, text),) = told(part, "OUT_OF_RANGE")
    assert (one.severity, one.field) == (Severity.ERROR, "retract_clearance")
    assert text == "PROGRAM PARAMETERS: RETRACT CLEARANCE must be above 0, at most 10000."
    assert told(part, "NO_CLEARANCE") == []


def profiled(comp, offset, finish_xy=None, **changes):
    parameters = Parameters(max_offset=offset, finish_xy=finish_xy)
    return program(block(MID_SIDE_SQUARE, comp, **changes), parameters=parameters)


@pytest.mark.parametrize(("comp", "plain"), [(CutterComp.PROFILE_LEFT, "LEFT"), (CutterComp.PROFILE_RIGHT, "RIGHT")])
@pytest.mark.parametrize("offset", [None, Entry(0.0)])
def test_a_profile_without_max_offset_is_told_to_be_one_pass(comp, plain, offset):
    ((one, text),) = told(profiled(comp, offset), "ONE_PASS")
    assert (one.severity, one.segment, one.field) == (Severity.WARNING, 0, "cutter_comp")
    assert text == (
        f"MAX OFFSET is 0.0000: PROFILE {plain} makes one pass, the same as {plain}. "
        f"Enter MAX OFFSET on PROGRAM PARAMETERS, or {plain} in CUTTER COMP."
    )


def test_a_profile_whose_finish_allowance_is_all_of_max_offset_is_told():
    part = profiled(CutterComp.PROFILE_LEFT, Entry(0.1), Entry(0.1), finish_tool=Entry(2))
    ((one, text),) = told(part, "ONE_PASS")
    assert one.severity is Severity.WARNING
    assert text == (
        "MAX OFFSET 0.1000 is no more than FINISH XY 0.1000: PROFILE LEFT makes one roughing pass, the same as LEFT. "
        "Enter a larger MAX OFFSET on PROGRAM PARAMETERS, or LEFT in CUTTER COMP."
    )


@pytest.mark.parametrize(
    "part",
    [
        profiled(CutterComp.PROFILE_LEFT, Entry(0.1)),
        profiled(CutterComp.PROFILE_LEFT, Entry(0.1), Entry(0.2)),
        profiled(CutterComp.PROFILE_LEFT, Entry(0.2), Entry(0.1), finish_tool=Entry(2)),
        profiled(CutterComp.PROFILE_LEFT, Unread("x", "no number")),
        profiled(CutterComp.PROFILE_LEFT, Entry(-1.0)),
        profiled(CutterComp.LEFT, None),
        profiled(CutterComp.ON, None),
    ],
)
def test_nothing_is_told_of_a_profile_in_several_passes_and_where_there_is_none(part):
    assert told(part, "ONE_PASS") == []


@pytest.mark.parametrize("offset", [0.0, 0.05, 0.1, 0.3])
@pytest.mark.parametrize("finish", [None, 0.0, 0.1])
def test_one_pass_is_told_exactly_where_there_is_one(offset, finish):
    changes = {} if finish is None else {"finish_tool": Entry(2)}
    part = profiled(CutterComp.PROFILE_LEFT, Entry(offset), None if finish is None else Entry(finish), **changes)
    (found,) = outline(part).blocks
    passes = len(stocks(found, part)) - (finish is not None)
    assert bool(told(part, "ONE_PASS")) is (passes == 0)


def alone(segment, comp=CutterComp.LEFT):
    return program(replace(block(((0, 0),), comp), segments=(segment,)))


LINE = LineSegment(x_end=Entry(2.0), y_end=Entry(1.0), feed=Entry(8.0))
ARC = ArcSegment(x_center=Entry(0.0), y_center=Entry(1.0), feed=Entry(8.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT])
@pytest.mark.parametrize("segment", [LINE, replace(ARC, sweep=Entry(90.0))])
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
        alone(replace(ARC, sweep=Entry(360.0))),
        alone(replace(ARC, x_end=Entry(0.0), y_end=Entry(0.0))),
        alone(LineSegment(x_end=Entry(2.0))),
        alone(replace(LINE, x_end=Entry(0.0), y_end=Entry(0.0))),
        fed(8.0, None),
        fed(),
    ],
)
def test_a_full_circle_is_a_closed_contour_and_what_is_not_known_yet_is_told_by_itself(part):
    assert told(part, "ONE_SEGMENT") == []


def test_segments_without_length_do_not_count():
    part = alone(LINE)
    (one,) = part.blocks
    nothing = LineSegment(x_end=Entry(2.0), y_end=Entry(1.0))
    ((found, _),) = told(replace(part, blocks=(replace(one, segments=(LINE, nothing)),)), "ONE_SEGMENT")
    assert found.segment == 1


POINT = LineSegment(x_end=Entry(0.0), y_end=Entry(0.0))


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.PROFILE_RIGHT])
@pytest.mark.parametrize("count", [1, 3])
def test_a_contour_without_any_length_is_an_error(count, comp):
    part = alone(POINT, comp)
    (one,) = part.blocks
    ((found, text),) = told(replace(part, blocks=(replace(one, segments=(POINT,) * count),)), "NO_LENGTH")
    assert (found.severity, found.segment, found.field, found.at) == (Severity.ERROR, 1, "x_end", (0.0, 0.0))
    assert text == "No segment has a length: the contour is a point, and there is no path. Correct X END or Y END."


@pytest.mark.parametrize("segments", [(), (POINT, LINE), (LINE, POINT), (POINT, LineSegment(x_end=Entry(1.0)))])
def test_a_contour_that_has_a_length_or_may_get_one_is_no_point(segments):
    part = alone(POINT)
    (one,) = part.blocks
    assert told(replace(part, blocks=(replace(one, segments=segments),)), "NO_LENGTH") == []
