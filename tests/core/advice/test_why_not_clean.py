"""Advice on gouging paths: every remedy is tried, and slightly more than it allows fails."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from math import cos, pi, sin

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core.advice.lookahead_table import CuttingSetup, judge_lookaheads
from core.advice.remedies import MAX_NAMED_PLACES, advice_for, restarted
from core.comp.lookahead import calculated
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.units import Unit, sentence
from tests.bench.families import gear
from tests.core.comp.contours import lines, mixed, shut
from tests.progress import looks_until_stopped
from tests.properties import exercised, must_exercise

DIAMETER_STEP = 0.001
"""One last digit of a metric screen, in millimeters."""

SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
SLOT = lines((0, 2), (0, 0), (0.4, 0), (0.4, 2))
NOTCHED = lines((0, 0), (2, 0), (2, -0.5), (2.8, -0.5), (2.8, 0), (4, 0), (4, 2), (0, 2), (0, 0))
STAR = lines(
    *((r * cos(a), r * sin(a)) for a, r in ((pi / 2 + k * pi / 5, (1.0, 0.4)[k % 2]) for k in range(11))),
)


def setup(contour: Path, side: Side, radius: float = 0.25, *, closed: bool, blend: float = 0.0) -> CuttingSetup:
    return CuttingSetup(contour, side, radius, closed, blend, 0.0)


def advice_of(cutting: CuttingSetup) -> tuple[Finding, ...]:
    return advice_for(cutting, calculated(len(cutting.surface), closed=cutting.closed), judge_lookaheads(cutting))


def codes(advice: Sequence[Finding]) -> list[str]:
    return [finding.code for finding in advice]


def text_of(advice: Sequence[Finding]) -> str:
    return " ".join(sentence(finding, Unit.MM) for finding in advice)


def remedy(advice: Sequence[Finding], code: str) -> Finding | None:
    """The remedy with this code, if it is offered."""
    return next((finding for finding in advice if finding.code == code), None)


def look_ahead(finding: Finding) -> int:
    """The look-ahead that a remedy is offered with."""
    (value,) = re.findall(r"look-ahead (\d+)", finding.text)
    return int(value)


def test_an_inside_square_should_start_in_the_middle_of_a_side():
    cutting = setup(SQUARE, Side.LEFT, closed=True)
    advice = advice_of(cutting)
    assert codes(advice) == ["CAL_NOT_CLEAN", "START_MID_SIDE"]
    assert "START is in an inside corner, where no look-ahead helps." in text_of(advice)
    assert (advice[1].segment, advice[1].at) == (1, (1.0, 0.0))
    assert judge_lookaheads(replace(cutting, surface=restarted(SQUARE, 0))).row(look_ahead(advice[1])).clean
    assert restarted(SQUARE, 0).points.tolist() == [[1, 0], [2, 0], [2, 2], [0, 2], [0, 0], [1, 0]]


def test_a_contour_started_within_an_arc_keeps_the_centers_of_its_arcs():
    half, line = Arc((2, 0), (0, 0), (1, 0), Turn.CCW), Line((0, 0), (2, 0))
    (first, second, third) = restarted(Path.from_pieces([half, line]), 0)
    assert (first.center, first.end) == ((1, 0), (0, 0))
    assert first.start == pytest.approx((1, 1))
    assert (second.start, second.end) == ((0, 0), (2, 0))
    assert (third.center, third.start) == ((1, 0), (2, 0))
    assert third.end == pytest.approx((1, 1))


def test_a_start_at_a_chamfer_can_be_moved():
    chamfered = lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0))
    advice = advice_of(setup(chamfered, Side.LEFT, closed=True))
    start = remedy(advice, "START_MID_SIDE")
    assert start is not None
    assert start.segment is not None
    assert look_ahead(start) == 2
    row = int(start.segment) - 1
    assert judge_lookaheads(setup(restarted(chamfered, row), Side.LEFT, closed=True)).row(2).clean


def test_the_largest_tool_of_a_slot_is_its_width():
    cutting = setup(SLOT, Side.LEFT, closed=False)
    advice = advice_of(cutting)
    assert advice[-1].value == pytest.approx(0.4)
    assert codes(advice) == ["CAL_NOT_CLEAN", "TOO_SMALL", "TOOL_FITS"]
    assert "inside corner after segment 2" in text_of(advice)
    assert judge_lookaheads(replace(cutting, radius=0.2)).row(look_ahead(advice[-1])).clean
    assert judge_lookaheads(replace(cutting, radius=0.2 + DIAMETER_STEP / 2)).recommended is None


def test_an_inside_radius_smaller_than_the_tool_is_named():
    """A groove with a round end that no look-ahead can leave out."""
    groove = Path.from_pieces(
        [Line((3, 0), (0.2, 0)), Arc((0.2, 0), (0.2, 0.4), (0.2, 0.2), Turn.CW), Line((0.2, 0.4), (3, 0.4))]
    )
    advice = advice_of(setup(groove, Side.RIGHT, closed=False))
    (small,) = [finding for finding in advice if finding.code == "TOO_SMALL"]
    assert small.segment == 2
    assert small.value == pytest.approx(0.2)
    assert "Inside radius 0.200 of segment 2 is too small for tool radius 0.250." in text_of(advice)
    assert codes(advice)[-1] == "TOOL_FITS"
    assert advice[-1].value == pytest.approx(0.4, abs=1.5 * DIAMETER_STEP)


def test_a_hole_smaller_than_the_tool_needs_a_smaller_tool():
    hole = Path.from_pieces([Arc((1, 0), (1, 0), (0, 0), Turn.CCW)])
    cutting = setup(hole, Side.LEFT, 1.25, closed=True)
    assert judge_lookaheads(cutting).recommended is None
    advice = advice_of(cutting)
    assert "no path that can be cut" in text_of(advice)
    assert codes(advice)[-1] == "TOOL_FITS"
    assert advice[-1].value is not None
    assert 2.0 - 2 * DIAMETER_STEP <= advice[-1].value <= 2.0


def test_a_star_needs_a_smaller_tool_and_another_start():
    advice = advice_of(setup(STAR, Side.LEFT, closed=True))
    assert remedy(advice, "START_MID_SIDE") is None
    tool = remedy(advice, "TOOL_FITS")
    assert tool is not None
    assert tool.value is not None
    assert tool.value < 0.5
    assert "when the contour is started in the middle of segment" in text_of(advice)
    assert remedy(advice_of(setup(STAR, Side.LEFT, 0.05, closed=True)), "START_MID_SIDE") is not None
    assert not advice_of(setup(STAR, Side.RIGHT, closed=True))


def test_blend_moves_that_gouge_can_be_left_out():
    channel = lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6))
    advice = advice_of(setup(channel, Side.LEFT, closed=False, blend=0.5))
    assert "Without blend moves (BLEND OFFSET 0) look-ahead 1 is clean." in text_of(advice)


def test_a_tool_that_fits_only_without_blend_moves_is_named():
    """Blend moves of 3 mm gouge this slot with every tool."""
    slot = lines((15, 0), (30, 0), (30, 2.5), (0, 2.5), (0, 0), (15, 0))
    cutting = replace(setup(slot, Side.LEFT, 1.5, closed=True, blend=3.0), overlap=3.0)
    advice = advice_of(cutting)
    assert codes(advice)[-1] == "TOOL_BLENDLESS"
    assert not {"TOOL_FITS", "START_MID_SIDE", "START_BLENDLESS"}.intersection(codes(advice))
    assert advice[-1].value == pytest.approx(2.5)
    text = (
        "Tool too big; the largest that does not gouge without blend moves (BLEND OFFSET 0): 2.500, with look-ahead 1."
    )
    assert sentence(advice[-1], Unit.MM) == text
    assert judge_lookaheads(replace(cutting, radius=1.25, blend=0.0)).row(1).clean
    assert judge_lookaheads(replace(cutting, radius=1.25)).recommended is None


def test_a_tool_with_blend_moves_and_a_larger_one_without_are_both_named():
    square = lines((0, 0), (50, 0), (50, 50), (0, 50), (0, 0))
    cutting = replace(setup(square, Side.LEFT, 40.0, closed=True, blend=3.0), overlap=3.0)
    advice = advice_of(cutting)
    assert codes(advice)[-2:] == ["TOOL_FITS", "TOOL_BLENDLESS"]
    fits, larger = advice[-2:]
    assert fits.value is not None
    assert larger.value is not None
    assert fits.value < 45.0
    assert larger.value == pytest.approx(50.0, abs=2 * DIAMETER_STEP)
    blends = "without blend moves (BLEND OFFSET 0) when the contour is started in the middle of segment 1"
    assert f"the largest that does not gouge {blends}" in text_of(advice)
    small = replace(cutting, surface=restarted(square, 0), radius=larger.value / 2)
    assert judge_lookaheads(replace(small, blend=0.0)).row(look_ahead(larger)).clean
    assert judge_lookaheads(small).recommended is None


def test_another_start_without_blend_moves_keeps_the_tool():
    """The tool fits but its blend moves do not, so no smaller tool is needed."""
    square = lines((0, 0), (50, 0), (50, 50), (0, 50), (0, 0))
    cutting = replace(setup(square, Side.LEFT, 24.0, closed=True, blend=10.0), overlap=3.0)
    advice = advice_of(cutting)
    assert codes(advice) == ["CAL_NOT_CLEAN", "START_BLENDLESS"]
    text = "Start in the middle of segment 1, at X 25.000 Y 0.000, without blend moves (BLEND OFFSET 0): look-ahead 1"
    assert text in text_of(advice)
    moved = replace(cutting, surface=restarted(square, 0))
    assert judge_lookaheads(moved).recommended is None
    assert judge_lookaheads(replace(moved, blend=0.0)).row(1).clean


@pytest.mark.parametrize("blend", [0.0, 0.003])
def test_a_slightly_larger_tool_without_blend_moves_is_not_named(blend):
    advice = advice_of(setup(SLOT, Side.LEFT, closed=False, blend=blend))
    assert codes(advice)[-1] == "TOOL_FITS"
    assert "TOOL_BLENDLESS" not in codes(advice)


def test_advice_without_a_remedy_says_so():
    """Thirty segments lie beyond a slit of 2e-5: no look-ahead reaches so far and no tool is small enough."""
    slit = 1e-5
    angles = [-pi / 2 - slit - step * (pi - slit) / 15 for step in range(31)]
    cavity = [(cos(angle), 1 + sin(angle)) for angle in angles]
    advice = advice_of(setup(lines((-3, 0), *cavity, (3, 0)), Side.RIGHT, 0.02, closed=False))
    assert codes(advice)[0] == "CAL_NOT_CLEAN"
    assert "No look-ahead is clean." in text_of(advice)
    assert codes(advice)[-1] == "NOTHING_HELPS"
    assert "No look-ahead or tool was found that works. Check the contour's numbers." in text_of(advice)


def test_of_a_contour_that_crosses_itself_only_the_place_is_named():
    """A loop of thirty segments crosses the first line: a start or a tool could only delete it."""
    angles = [pi * (-0.5 + 11 / 180 * step) for step in range(31)]
    loop = [(cos(angle), 1 + sin(angle)) for angle in angles]
    (x, y), heading = loop[-1], angles[-1] + pi / 2
    crossing = lines((-3, 0), *loop, (x + cos(heading), y + sin(heading)))
    advice = advice_of(setup(crossing, Side.LEFT, 0.02, closed=False))
    assert codes(advice) == ["CAL_NOT_CLEAN", "CROSSING_FIRST"]
    assert "First look there for a wrong DIRECTION, sign or number." in text_of(advice)


def test_a_mistyped_start_of_a_closed_contour_is_reported():
    """One number of START is wrong: the first line starts on the next-to-last side, and no tool is small enough."""
    around = ((2, 0), (2, 2), (0, 2), (0, 1.2), (-0.1, 0.6), (0, 0))
    advice = advice_of(setup(lines((0, 1.5), *around), Side.RIGHT, closed=False))
    assert codes(advice)[-1] == "START_AT_END"
    assert (advice[-1].segment, advice[-1].at) == (0, (0.0, 0.0))
    assert "START may be mistyped: at X 0.000 Y 0.000, where the contour ends, it would close" in text_of(advice)
    whole = setup(lines((0, 0), *around), Side.RIGHT, closed=True)
    assert judge_lookaheads(whole).row(look_ahead(advice[-1])).clean


@pytest.mark.parametrize("first", [(0.5, 1), (0, 1)])
def test_no_mistyped_start_is_reported_when_two_numbers_differ_or_it_does_not_help(first):
    """Both numbers differ, or the corrected start is an inside corner too."""
    side = Side.LEFT if first == (0, 1) else Side.RIGHT
    advice = advice_of(setup(lines(first, (2, 0), (2, 2), (0, 2), (0, 0)), side, closed=False))
    assert "START_AT_END" not in codes(advice)


def test_many_small_places_are_counted():
    work = gear(50)
    advice = advice_of(setup(work.contour, work.side, 6.0, closed=True))
    named = [finding for finding in advice if finding.code == "TOO_SMALL"]
    assert len(named) == MAX_NAMED_PLACES + 1
    assert named[-1].text == "There are 24 such places."


sizes, radii, blends = st.floats(0.5, 4.0), st.floats(0.05, 0.6), st.sampled_from((0.0, 0.3, 2.0))


@st.composite
def pockets(draw: st.DrawFn) -> Path:
    """Rectangles with a notch that start at a corner or in the middle of a side."""
    wide, high, notch = draw(sizes), draw(sizes), draw(st.floats(0.1, 0.9))
    at = draw(st.floats(0.3, 0.6)) * wide
    end, far = at + notch / 2, at + notch / 2 + wide
    corners = [(0, 0), (at, 0), (at, -notch), (end, -notch), (end, 0), (far, 0), (far, high), (0, high)]
    first = draw(st.integers(0, 7))
    corners = [*corners[first:], *corners[:first]]
    if draw(st.booleans()):
        (x0, y0), (x1, y1) = corners[-1], corners[0]
        corners = [((x0 + x1) / 2, (y0 + y1) / 2), *corners]
    return lines(*corners, corners[0])


@st.composite
def slots(draw: st.DrawFn) -> Path:
    """A wall with one slot."""
    before, after, depth, width = draw(sizes), draw(sizes), draw(sizes), draw(st.floats(0.1, 1.0))
    return lines((-before, 0), (0, 0), (0, -depth), (width, -depth), (width, 0), (width + after, 0))


@st.composite
def channels(draw: st.DrawFn) -> CuttingSetup:
    """Open channels too narrow for the tool, or only for its blend moves."""
    radius, along, blend = draw(radii), draw(sizes), draw(st.sampled_from((0.3, 2.0)))
    high = 2 * radius * draw(st.floats(0.6, 1.8))
    walls = lines((0, 0), (along, 0), (along, high), (-along, high))
    return setup(walls, Side.LEFT, radius, closed=False, blend=blend)


def cutting_of(contour: Path, side: Side, radius: float, closed: bool, blend: float) -> CuttingSetup:
    whole = shut(contour) if closed else contour
    return replace(setup(whole, side, radius, closed=closed, blend=blend), overlap=blend)


needy = st.one_of(
    st.builds(cutting_of, pockets(), st.sampled_from(Side), radii, st.just(True), blends),
    st.builds(cutting_of, slots(), st.just(Side.LEFT), radii, st.just(True), blends),
    channels(),
    st.builds(
        cutting_of, mixed, st.sampled_from(Side), st.floats(0.2, 1.0), st.just(False), st.sampled_from((0.3, 2.0))
    ),
)
"""Contours of which many have no clean look-ahead, for different reasons."""


@must_exercise(0.02, "start", "start without blends", "tool", "tool without blends", "look-ahead without blends")
@settings(max_examples=35, derandomize=True)
@given(needy)
@example(cutting_of(SQUARE, Side.LEFT, 0.5, closed=True, blend=0.3))
@example(cutting_of(NOTCHED, Side.LEFT, 0.25, closed=True, blend=2.0))
@example(setup(lines((0, 0), (1, 0), (1, 0.4), (-1, 0.4)), Side.LEFT, closed=False, blend=0.3))
@example(setup(SLOT, Side.LEFT, closed=False))
@example(setup(STAR, Side.LEFT, closed=True))
@example(setup(lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6)), Side.LEFT, closed=False, blend=0.5))
@example(setup(lines((0, 0), (1, 0), (1, 0.6), (-1, 0.6)), Side.LEFT, closed=False, blend=0.3))
def test_every_remedy_makes_the_path_clean(cutting: CuttingSetup) -> None:
    advice = advice_of(cutting)
    plain = replace(cutting, blend=0.0)
    assert all(finding.severity is not Severity.ERROR for finding in advice)
    for name, code, tried in (
        ("start", "START_MID_SIDE", cutting),
        ("start without blends", "START_BLENDLESS", plain),
    ):
        start = remedy(advice, code)
        if start is not None:
            exercised(name)
            side = cutting.surface.numbers.tolist().index(start.segment)
            row = judge_lookaheads(replace(tried, surface=restarted(cutting.surface, side))).row(look_ahead(start))
            assert row.clean
            assert start.text.endswith(f"look-ahead {row.value} then {row.effect[0]}.")
    for name, code, tried in (("tool", "TOOL_FITS", cutting), ("tool without blends", "TOOL_BLENDLESS", plain)):
        tool = remedy(advice, code)
        if tool is not None:
            exercised(name)
            assert tool.value is not None
            small = replace(tried, radius=tool.value / 2)
            moved = [
                small,
                *(replace(small, surface=restarted(small.surface, row)) for row in range(len(small.surface))),
            ]
            assert any(
                judge_lookaheads(trial).row(look_ahead(tool)).clean
                for trial in (moved if cutting.closed else moved[:1])
            )
    blendless = remedy(advice, "BLENDLESS")
    if blendless is not None:
        exercised("look-ahead without blends")
        assert judge_lookaheads(plain).row(look_ahead(blendless)).clean
    tools = [finding.value or 0.0 for finding in advice if finding.code in ("TOOL_FITS", "TOOL_BLENDLESS")]
    assert tools == sorted(set(tools))


def test_a_clean_look_ahead_is_named_when_the_calculated_one_gouges():
    notch = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    advice = advice_of(setup(notch, Side.LEFT, closed=False))
    assert text_of(advice) == "CAL 2 gouges. Enter look-ahead 3, which does not gouge but leaves 0.900 uncut."
    assert not advice_of(setup(notch, Side.RIGHT, closed=False))


@pytest.mark.parametrize("tries", range(8))
def test_unwanted_advice_stops_before_the_next_remedy(tries):
    """Nothing helps this shape: the advice asks before each remedy and stops at the first no."""
    cutting = setup(STAR, Side.LEFT, closed=True, blend=0.1)
    table = judge_lookaheads(cutting)
    assert looks_until_stopped(lambda check: advice_for(cutting, 8, table, check), tries) == tries + 1


def test_the_largest_tool_has_the_radius_of_the_inside_corners():
    """A 60 by 30 pocket with corners of radius 6: tools from 12 to 30 are clean only because they delete corners."""
    pocket = Path.from_pieces(
        [
            Line((6, 0), (54, 0)),
            Arc((54, 0), (60, 6), (54, 6), Turn.CCW),
            Line((60, 6), (60, 24)),
            Arc((60, 24), (54, 30), (54, 24), Turn.CCW),
            Line((54, 30), (6, 30)),
            Arc((6, 30), (0, 24), (6, 24), Turn.CCW),
            Line((0, 24), (0, 6)),
            Arc((0, 6), (6, 0), (6, 6), Turn.CCW),
        ]
    )
    for radius in (17.5, 20.0):
        advice = advice_of(setup(pocket, Side.LEFT, radius, closed=True))
        tool = remedy(advice, "TOOL_FITS")
        assert tool is not None
        assert tool.value == 12.0
