"""What a program leaves blank or says in vain, and what comes of it is said in words."""

from dataclasses import replace

import pytest

from core.finding import Severity
from core.pipeline.outline import outline
from core.program.model import CutterComp, Entry, LineSegment, Parameters, Unread, changed
from core.units import Unit, sentence
from tests.core.pipeline.parts import NOTCH, block, program


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
