"""Where the tool goes straight up or down in the middle of a path, or a blend arc leads through a wall, it is told."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.finding import Severity
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.program.model import BlendSegment, CutterComp, Entry, LineSegment, Parameters, Segment
from core.units import Unit, sentence
from tests.core.pipeline.parts import block, program

IN = 25.4


def sloped(*segments: Segment, comp: CutterComp = CutterComp.ON) -> DerivedBlock:
    """The block of these segments from 0, 0 and Z BOTTOM -0.25."""
    typed = replace(block(((0, 0), (1, 0)), comp), segments=segments)
    return derive(program(typed)).blocks[0]


def line(x: float, y: float, z: float | None = None) -> LineSegment:
    return LineSegment(x_end=Entry(x), y_end=Entry(y), z_end=None if z is None else Entry(z))


def steps(found: DerivedBlock) -> list[tuple[float | None, float, str]]:
    """Of each step told: the segment behind it, how far, and the sentence."""
    told = [one for one in found.findings if one.code == "Z_STEP"]
    assert all(one.severity is Severity.WARNING for one in told)
    return [(one.segment, round(one.value / IN, 6), sentence(one, Unit.IN)) for one in told]


def test_a_blend_arc_that_takes_all_of_a_slope_leaves_a_step():
    found = sloped(line(2, 0), BlendSegment(radius=Entry(1)), line(2, 1, -0.1), line(0, 1))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (4, 0.15)
    assert text == "The tool goes straight up 0.1500 at X 2.0000 Y 1.0000: the slope of a Z END is cut off there."


def test_a_z_end_on_a_segment_without_length_is_a_step():
    found = sloped(line(2, 0, -0.1), line(2, 0, -0.25), line(2, 1))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (3, 0.15)
    assert text.startswith("The tool goes straight down 0.1500 at X 2.0000 Y 0.0000")


def test_a_slope_that_an_inside_corner_or_the_look_ahead_takes_leaves_a_step():
    notch = (line(2, 0), line(2, -0.3, -0.1), line(2.3, -0.3), line(2.3, 0), line(5, 0))
    found = sloped(*notch, comp=CutterComp.LEFT)
    assert [(segment, value) for segment, value, _ in steps(found)] == [(3, 0.125)]
    (deleted,) = derive(program(replace(found.block, lookahead=Entry(3)))).blocks
    assert [(segment, value) for segment, value, _ in steps(deleted)] == [(4.5, 0.15)]


def test_the_deepest_of_several_steps_is_told_with_their_number():
    found = sloped(line(1, 0, -0.1), line(1, 0, -0.2), line(2, 0, -0.05), line(2, 0, -0.25), line(3, 0))
    ((segment, value, text),) = steps(found)
    assert (segment, value) == (5, 0.2)
    assert text.endswith("There are 2 such places.")


@pytest.mark.parametrize("comp", [CutterComp.ON, CutterComp.LEFT, CutterComp.RIGHT])
def test_slopes_that_follow_each_other_are_no_step(comp):
    found = sloped(line(2, 0, -0.1), line(4, 0, -0.2), BlendSegment(radius=Entry(0.3)), line(4, 2), comp=comp)
    assert not steps(found)


@pytest.mark.parametrize("offset", [0.25, 1.0, 1.4, 3.0])
def test_a_blend_arc_that_begins_and_ends_beyond_a_wall_is_named(offset):
    square = ((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
    parameters = Parameters(blend_offset=Entry(offset), blend_overlap=Entry(0))
    (found,) = derive(program(block(square, CutterComp.LEFT), parameters=parameters)).blocks
    told = [sentence(one, Unit.IN) for one in found.findings if one.code == "BLEND_LEAVES"]
    far = [f"{place:.4f}" for place in (1 - offset, 1 + offset, 0.25 + offset)]
    expected = [
        f"Blend-in crosses a wall, from X {far[0]} Y {far[2]}. Make BLEND OFFSET smaller.",
        f"Blend-out crosses a wall, to X {far[1]} Y {far[2]}. Make BLEND OFFSET smaller.",
    ]
    assert told == (expected if offset > 1.0 else [])
