"""What would help: every remedy is tried again here, and a little more than it allows is shown to fail."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.advice.lookahead_table import CuttingSetup, judge_lookaheads
from core.advice.remedies import restarted
from core.advice.why_not_clean import MAX_NAMED_PLACES, Advice, advice_for
from core.comp.lookahead import calculated
from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from core.units import Unit, sentence
from tests.bench.families import gear
from tests.core.comp.contours import lines, mixed, shut
from tests.properties import exercised, must_exercise

DIAMETER_STEP = 0.001
"""Millimeters, as a screen in millimeters shows them."""

SQUARE = lines((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
SLOT = lines((0, 2), (0, 0), (0.4, 0), (0.4, 2))
STAR = lines(
    *((r * cos(a), r * sin(a)) for a, r in ((pi / 2 + k * pi / 5, (1.0, 0.4)[k % 2]) for k in range(11))),
)


def setup(contour: Path, side: Side, radius: float = 0.25, *, closed: bool, blend: float = 0.0) -> CuttingSetup:
    return CuttingSetup(contour, side, radius, closed, blend, 0.0)


def of(asked: CuttingSetup) -> Advice:
    found = advice_for(asked, calculated(len(asked.surface), closed=asked.closed), judge_lookaheads(asked))
    assert found is not None
    return found


def codes(found: Advice) -> list[str]:
    return [one.code for one in found.sentences]


def said(found: Advice) -> str:
    return " ".join(sentence(one, Unit.MM) for one in found.sentences)


def test_an_inside_square_is_to_be_started_mid_side():
    asked = setup(SQUARE, Side.LEFT, closed=True)
    found = of(asked)
    assert codes(found) == ["CAL_NOT_CLEAN", "START_MID_SIDE"]
    assert "START is in an inside corner, where no look-ahead helps." in said(found)
    assert found.start is not None
    assert (found.start.segment, found.start.at) == (1, (1.0, 0.0))
    assert judge_lookaheads(replace(asked, surface=restarted(SQUARE, 0))).row(found.start.value).clean
    assert restarted(SQUARE, 0).points.tolist() == [[1, 0], [2, 0], [2, 2], [0, 2], [0, 0], [1, 0]]


def test_a_contour_started_within_an_arc_keeps_the_centers_of_its_arcs():
    half, line = Arc((2, 0), (0, 0), (1, 0), Turn.CCW), Line((0, 0), (2, 0))
    (first, second, third) = restarted(Path.from_pieces([half, line]), 0)
    assert (first.center, first.end) == ((1, 0), (0, 0))
    assert first.start == pytest.approx((1, 1))
    assert (second.start, second.end) == ((0, 0), (2, 0))
    assert (third.center, third.start) == ((1, 0), (2, 0))
    assert third.end == pytest.approx((1, 1))


def test_a_chamfer_at_the_seam():
    chamfered = lines((0.1, 0), (2, 0), (2, 2), (0, 2), (0, 0.1), (0.1, 0))
    found = of(setup(chamfered, Side.LEFT, closed=True))
    assert found.start is not None
    assert found.start.value == 2
    row = int(found.start.segment) - 1
    assert judge_lookaheads(setup(restarted(chamfered, row), Side.LEFT, closed=True)).row(2).clean


def test_the_largest_tool_of_a_slot_is_its_width():
    asked = setup(SLOT, Side.LEFT, closed=False)
    found = of(asked)
    assert found.tool is not None
    assert found.tool.diameter == pytest.approx(0.4)
    assert codes(found) == ["CAL_NOT_CLEAN", "TOO_SMALL", "TOOL_FITS"]
    assert "inside corner after segment 2" in said(found)
    assert judge_lookaheads(replace(asked, radius=found.tool.diameter / 2)).row(found.tool.value).clean
    assert judge_lookaheads(replace(asked, radius=(found.tool.diameter + DIAMETER_STEP) / 2)).recommended is None


def test_an_inside_radius_smaller_than_the_tool_is_named():
    """A groove with a round end: no other wall lets the end be left out."""
    groove = Path.from_pieces(
        [Line((3, 0), (0.2, 0)), Arc((0.2, 0), (0.2, 0.4), (0.2, 0.2), Turn.CW), Line((0.2, 0.4), (3, 0.4))]
    )
    found = of(setup(groove, Side.RIGHT, closed=False))
    assert [one.segment for one in found.too_small] == [2]
    assert found.too_small[0].value == pytest.approx(0.2)
    assert "Inside radius 0.200 of segment 2 is too small for tool radius 0.250." in said(found)
    assert found.tool is not None
    assert found.tool.diameter == pytest.approx(0.4, abs=1.5 * DIAMETER_STEP)


def test_a_hole_smaller_than_the_tool():
    hole = Path.from_pieces([Arc((1, 0), (1, 0), (0, 0), Turn.CCW)])
    asked = setup(hole, Side.LEFT, 1.25, closed=True)
    assert judge_lookaheads(asked).recommended is None
    found = of(asked)
    assert "no path that can be cut" in said(found)
    assert found.tool is not None
    assert 2.0 - 2 * DIAMETER_STEP <= found.tool.diameter <= 2.0


def test_a_star_needs_a_smaller_tool_and_another_start():
    found = of(setup(STAR, Side.LEFT, closed=True))
    assert found.start is None
    assert found.tool is not None
    assert found.tool.diameter < 0.5
    assert "when the contour is started in the middle of segment" in said(found)
    assert of(setup(STAR, Side.LEFT, 0.05, closed=True)).start is not None
    assert not of(setup(STAR, Side.RIGHT, closed=True)).sentences


def test_blend_moves_that_alone_gouge():
    channel = lines((0, 0), (2, 0), (2, 0.6), (-2, 0.6))
    found = of(setup(channel, Side.LEFT, closed=False, blend=0.5))
    assert found.lookahead_without_blends == 1
    assert "BLEND OFFSET 0" in said(found)


def test_a_tool_that_only_the_blend_moves_keep_out_is_told_with_them_left_out():
    """A slot as wide as the tool: blend moves of 3 mm gouge with every tool in it."""
    slot = lines((15, 0), (30, 0), (30, 2.5), (0, 2.5), (0, 0), (15, 0))
    asked = replace(setup(slot, Side.LEFT, 1.5, closed=True, blend=3.0), overlap=3.0)
    found = of(asked)
    assert codes(found)[-1] == "TOOL_BLENDLESS"
    assert (found.tool, found.start, found.start_without_blends) == (None, None, None)
    assert found.tool_without_blends is not None
    assert found.tool_without_blends.diameter == pytest.approx(2.5)
    text = (
        "Tool too big; the largest that does not gouge without blend moves (BLEND OFFSET 0): 2.500, with look-ahead 1."
    )
    assert sentence(found.sentences[-1], Unit.MM) == text
    assert judge_lookaheads(replace(asked, radius=1.25, blend=0.0)).row(1).clean
    assert judge_lookaheads(replace(asked, radius=1.25)).recommended is None


def test_a_tool_with_blend_moves_and_a_larger_one_without_are_both_told():
    square = lines((0, 0), (50, 0), (50, 50), (0, 50), (0, 0))
    asked = replace(setup(square, Side.LEFT, 40.0, closed=True, blend=3.0), overlap=3.0)
    found = of(asked)
    assert codes(found)[-2:] == ["TOOL_FITS", "TOOL_BLENDLESS"]
    assert found.tool is not None
    assert found.tool_without_blends is not None
    assert found.tool.diameter < 45.0
    assert found.tool_without_blends.diameter == pytest.approx(50.0, abs=2 * DIAMETER_STEP)
    blends = "without blend moves (BLEND OFFSET 0) when the contour is started in the middle of segment 1"
    assert f"the largest that does not gouge {blends}" in said(found)
    small = replace(asked, surface=restarted(square, 0), radius=found.tool_without_blends.diameter / 2)
    assert judge_lookaheads(replace(small, blend=0.0)).row(found.tool_without_blends.value).clean
    assert judge_lookaheads(small).recommended is None


def test_another_start_without_blend_moves_keeps_the_tool():
    """The tool fits well, but its blend moves do not: no smaller one is needed."""
    square = lines((0, 0), (50, 0), (50, 50), (0, 50), (0, 0))
    asked = replace(setup(square, Side.LEFT, 24.0, closed=True, blend=10.0), overlap=3.0)
    found = of(asked)
    assert codes(found) == ["CAL_NOT_CLEAN", "START_BLENDLESS"]
    text = "Start in the middle of segment 1, at X 25.000 Y 0.000, without blend moves (BLEND OFFSET 0): look-ahead 1"
    assert text in said(found)
    moved = replace(asked, surface=restarted(square, 0))
    assert judge_lookaheads(moved).recommended is None
    assert judge_lookaheads(replace(moved, blend=0.0)).row(1).clean


@pytest.mark.parametrize("blend", [0.0, 0.003])
def test_a_tool_hardly_larger_without_blend_moves_is_not_told_of(blend):
    found = of(setup(SLOT, Side.LEFT, closed=False, blend=blend))
    assert codes(found)[-1] == "TOOL_FITS"
    assert found.tool_without_blends is None


def test_where_nothing_helps_it_says_so():
    """A loop of thirty segments that crosses the way in: no look-ahead reaches so far, and no tool is small enough."""
    angles = [pi * (-0.5 + 11 / 180 * step) for step in range(31)]
    loop = [(cos(angle), 1 + sin(angle)) for angle in angles]
    (x, y), heading = loop[-1], angles[-1] + pi / 2
    found = of(setup(lines((-3, 0), *loop, (x + cos(heading), y + sin(heading))), Side.LEFT, 0.02, closed=False))
    assert codes(found)[0] == "CAL_NOT_CLEAN"
    assert "No look-ahead is clean." in said(found)
    assert codes(found)[-1] == "NOTHING_HELPS"
    assert "No look-ahead or tool was found that works. Check the contour's numbers." in said(found)


def test_a_mistyped_start_of_a_closed_contour_is_told():
    """One number of START is wrong: the first line comes from the last side but one, and no tool is small enough."""
    around = ((2, 0), (2, 2), (0, 2), (0, 1.2), (-0.1, 0.6), (0, 0))
    found = of(setup(lines((0, 1.5), *around), Side.RIGHT, closed=False))
    assert codes(found)[-1] == "START_AT_END"
    assert found.start_at_end is not None
    assert found.start_at_end.at == (0.0, 0.0)
    assert found.sentences[-1].segment == 0
    assert "START may be mistyped: at X 0.000 Y 0.000, where the contour ends, it would close" in said(found)
    whole = setup(lines((0, 0), *around), Side.RIGHT, closed=True)
    assert judge_lookaheads(whole).row(found.start_at_end.value).clean


@pytest.mark.parametrize("first", [(0.5, 1), (0, 1)])
def test_another_start_is_told_only_where_one_number_of_it_is_wrong_and_it_helps(first):
    """Both numbers differ; or the start is an inside corner there as well."""
    side = Side.LEFT if first == (0, 1) else Side.RIGHT
    found = of(setup(lines(first, (2, 0), (2, 2), (0, 2), (0, 0)), side, closed=False))
    assert found.start_at_end is None
    assert "START_AT_END" not in codes(found)


def test_many_places_are_counted():
    work = gear(50)
    found = of(setup(work.contour, work.side, 6.0, closed=True))
    named = [one for one in found.sentences if one.code == "TOO_SMALL"]
    assert len(found.too_small) > MAX_NAMED_PLACES
    assert len(named) == MAX_NAMED_PLACES + 1
    assert f"There are {len(found.too_small)} such places." in named[-1].text


sizes, radii, blends = st.floats(0.5, 4.0), st.floats(0.05, 0.6), st.sampled_from((0.0, 0.3, 2.0))


@st.composite
def pockets(draw: st.DrawFn) -> Path:
    """Rectangles with a notch, from any corner or from the middle of any side."""
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
    before, behind, depth, width = draw(sizes), draw(sizes), draw(sizes), draw(st.floats(0.1, 1.0))
    return lines((-before, 0), (0, 0), (0, -depth), (width, -depth), (width, 0), (width + behind, 0))


@st.composite
def channels(draw: st.DrawFn) -> CuttingSetup:
    """An open channel, some too narrow for the tool and some only for its blend moves."""
    radius, along, blend = draw(radii), draw(sizes), draw(st.sampled_from((0.3, 2.0)))
    high = 2 * radius * draw(st.floats(0.6, 1.8))
    walls = lines((0, 0), (along, 0), (along, high), (-along, high))
    return setup(walls, Side.LEFT, radius, closed=False, blend=blend)


def asked_of(contour: Path, side: Side, radius: float, closed: bool, blend: float) -> CuttingSetup:
    whole = shut(contour) if closed else contour
    return replace(setup(whole, side, radius, closed=closed, blend=blend), overlap=blend)


needy = st.one_of(
    st.builds(asked_of, pockets(), st.sampled_from(Side), radii, st.just(True), blends),
    st.builds(asked_of, slots(), st.just(Side.LEFT), radii, st.just(True), blends),
    channels(),
    st.builds(asked_of, mixed, st.sampled_from(Side), st.floats(0.2, 1.0), st.just(False), st.sampled_from((0.3, 2.0))),
)
"""Contours of which many have no clean look-ahead, each for another reason."""


@must_exercise(0.01, "start", "start without blends", "tool", "tool without blends", "look-ahead without blends")
@settings(max_examples=120, derandomize=True)
@given(needy)
def test_every_remedy_holds(asked: CuttingSetup) -> None:
    found = of(asked)
    plain = replace(asked, blend=0.0)
    assert all(one.severity is not Severity.ERROR for one in found.sentences)
    for name, start, tried in (
        ("start", found.start, asked),
        ("start without blends", found.start_without_blends, plain),
    ):
        if start is not None:
            exercised(name)
            row = asked.surface.numbers.tolist().index(start.segment)
            assert judge_lookaheads(replace(tried, surface=restarted(asked.surface, row))).row(start.value).clean
    for name, tool, tried in (("tool", found.tool, asked), ("tool without blends", found.tool_without_blends, plain)):
        if tool is not None:
            exercised(name)
            small = replace(tried, radius=tool.diameter / 2)
            moved = [
                small,
                *(replace(small, surface=restarted(small.surface, row)) for row in range(len(small.surface))),
            ]
            assert any(judge_lookaheads(one).row(tool.value).clean for one in (moved if asked.closed else moved[:1]))
    if found.lookahead_without_blends is not None:
        exercised("look-ahead without blends")
        assert judge_lookaheads(plain).row(found.lookahead_without_blends).clean
    if found.tool is not None and found.tool_without_blends is not None:
        assert found.tool_without_blends.diameter > found.tool.diameter


def test_the_value_that_is_clean_is_told_where_the_calculated_one_is_not():
    notch = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
    found = of(setup(notch, Side.LEFT, closed=False))
    assert said(found) == "CAL 2 gouges. Enter look-ahead 3, which does not gouge but leaves 0.900 uncut."
    assert (found.tool, found.start) == (None, None)
    assert not of(setup(notch, Side.RIGHT, closed=False)).sentences


@pytest.mark.parametrize("tries", range(8))
def test_remedies_nobody_waits_for_are_given_up_at_the_next_one(tries):
    """A shape that nothing mends: each remedy is asked before, none after the answer was no."""
    asked = setup(STAR, Side.LEFT, closed=True, blend=0.1)
    answers: list[bool] = []

    def wanted() -> bool:
        answers.append(len(answers) < tries)
        return answers[-1]

    assert advice_for(asked, 8, judge_lookaheads(asked), wanted) is None
    assert answers == [True] * tries + [False]


def test_the_radius_of_an_inside_corner_is_the_tool_to_take():
    """A pocket of 60 by 30 with corners of radius 6: tools from 12 to 30 are clean only since they delete corners."""
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
        found = of(setup(pocket, Side.LEFT, radius, closed=True))
        assert found.tool is not None
        assert found.tool.diameter == 12.0
