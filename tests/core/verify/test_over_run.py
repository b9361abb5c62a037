"""Contours that start or end past their corner: the parts beyond the corner are leads, not contour."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, radians, sin, sqrt

import pytest

from core.finding import Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.verify.judge import judge
from core.verify.report import verdict_findings
from core.verify.surface import Leads
from tests.core.verify.shapes import lines, mirrored

R = 0.25
SQUARE = ((1.5, 0.0), (1.5, -1.5), (0.0, -1.5))
CROSSING_AT_A_JOINT = {
    "first": lines((-1, 0), (0, 0), *SQUARE, (0, 0.1)),
    "last": lines((-0.1, 0), *SQUARE, (0, 0), (0, 1)),
    "both": lines((-1, 0.5), (0, 0), *SQUARE, (0, 0), (-0.5, 1)),
    "no run-out": lines((-1, 0), (0, 0), *SQUARE, (0, 0)),
    "no run-in": lines((0, 0), *SQUARE, (0, 0), (0, 1)),
}
IN_SEVERAL_MOVES = {
    "in and out": lines((-1, 0), (-0.5, 0), *SQUARE, (0, 0.5), (0, 0.8), (0, 1)),
    "joint at the corner": lines((-1, 0), (-0.5, 0), (0, 0), *SQUARE, (0, 0), (0, 0.5), (0, 1)),
    "rounded": lines((-1, 0.0001), (-0.5, 0), *SQUARE, (0, 0.5), (-0.0001, 1)),
    "joints on the wall": lines((-1, 0), (0.5, 0), (1, 0), *SQUARE, (0, -1), (0, 1)),
}
OVER_RUNS = {
    "starts at the corner": lines((0, 0), *SQUARE, (0, 0.1)),
    "ends at the corner": lines((-0.1, 0), *SQUARE, (0, 0)),
    **CROSSING_AT_A_JOINT,
    **IN_SEVERAL_MOVES,
}
Motion = Callable[[Path], Path]
MOTIONS: dict[str, tuple[Motion, Side]] = {
    "as drawn": (lambda path: path, Side.LEFT),
    "mirrored": (mirrored, Side.RIGHT),
    "reversed": (Path.reversed, Side.RIGHT),
    "mirrored and reversed": (lambda path: mirrored(path).reversed(), Side.LEFT),
}


def around(radius: float) -> Path:
    """The path outside the square that starts and ends past the corner at the origin."""
    return Path.from_pieces(
        [
            Line((-1, radius), (1.5, radius)),
            Arc((1.5, radius), (1.5 + radius, 0), (1.5, 0), Turn.CW),
            Line((1.5 + radius, 0), (1.5 + radius, -1.5)),
            Arc((1.5 + radius, -1.5), (1.5, -1.5 - radius), (1.5, -1.5), Turn.CW),
            Line((1.5, -1.5 - radius), (0, -1.5 - radius)),
            Arc((0, -1.5 - radius), (-radius, -1.5), (0, -1.5), Turn.CW),
            Line((-radius, -1.5), (-radius, 1)),
        ]
    )


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_segments_beyond_the_corner_are_leads(contour: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    verdict = judge(move(OVER_RUNS[contour]), side, R, move(around(R)))
    assert verdict.over_run_at == pytest.approx((0.0, 0.0), abs=1e-9)
    assert not verdict.crosses_itself
    assert verdict.surface_length == pytest.approx(6.0)
    assert verdict.clean
    assert verdict.uncut == ()


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_a_lead_that_nicks_the_corner_gouges_by_the_depth_there(contour: str, motion: str) -> None:
    """The line from (-1, 0) to (0, R) passes the corner at less than the radius."""
    move, side = MOTIONS[motion]
    nick = lines((-1, 0), (0, R), (1, R))
    verdict = judge(move(OVER_RUNS[contour]), side, R, move(nick))
    assert verdict.depth == pytest.approx(R - R / sqrt(1 + R * R))
    assert judge(move(OVER_RUNS[contour]), side, R, move(around(R - 0.01))).depth == pytest.approx(0.01)


OVERLAPS = {
    "begun in a wall": (lines((0.5, 0), *SQUARE, (0, 0), (0.9, 0)), lines((0, 0), *SQUARE, (0, 0))),
    "ended in an arc": (
        Path.from_pieces(
            [
                Line((-1, 0), (1.5, 0)),
                *lines(*SQUARE, (0, -0.3)),
                Arc((0, -0.3), (0.3, 0), (0.3, -0.3), Turn.CW),
                Line((0.3, 0), (0.8, 0)),
            ]
        ),
        Path.from_pieces(
            [
                Line((0.3, 0), (1.5, 0)),
                *lines(*SQUARE, (0, -0.3)),
                Arc((0, -0.3), (0.3, 0), (0.3, -0.3), Turn.CW),
            ]
        ),
    ),
    "begun in an arc": (
        Path.from_pieces(
            [
                Arc((0.3 - 0.18, -0.06), (0.3 + 0.18, -0.06), (0.3, -0.3), Turn.CW),
                *lines((0.48, -0.06), (2, -0.06), (2, -2), (0, -2), (0, -0.3)),
                Arc((0, -0.3), (0.3, 0), (0.3, -0.3), Turn.CW),
            ]
        ),
        Path.from_pieces(
            [
                Arc((0, -0.3), (0.3 + 0.18, -0.06), (0.3, -0.3), Turn.CW),
                *lines((0.48, -0.06), (2, -0.06), (2, -2), (0, -2), (0, -0.3)),
            ]
        ),
    ),
}


@pytest.mark.parametrize("motion", [name for name in MOTIONS if "reversed" not in name])
@pytest.mark.parametrize("name", OVERLAPS)
@pytest.mark.parametrize("radius", [R, 0.1])
def test_an_overlap_along_the_first_wall_does_not_change_the_verdict(radius: float, name: str, motion: str) -> None:
    (move, side), (overlapped, once) = MOTIONS[motion], OVERLAPS[name]
    path = move(around(R))
    verdict, expected = (judge(move(contour), side, radius, path) for contour in (overlapped, once))
    assert not verdict.crosses_itself
    assert verdict.depth == pytest.approx(expected.depth, abs=1e-9)
    assert verdict.surface_length == pytest.approx(expected.surface_length)
    assert verdict.uncut_length == pytest.approx(expected.uncut_length, abs=1e-9)
    assert verdict.wrong_side == expected.wrong_side


def test_a_last_wall_beside_or_opposite_the_first_one_is_a_wall() -> None:
    for end in ((0.9, 0.1), (0.9, -0.1)):
        assert judge(lines((0.5, 0), *SQUARE, (0, 0), end), Side.LEFT, R, around(R)).surface_length > 6.0
    back = judge(lines((0.5, 0), *SQUARE, (0, 0.0), (0, -0.7)), Side.LEFT, R, around(R))
    assert back.surface_length == pytest.approx(6.2)


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("contour", OVER_RUNS)
def test_the_ends_are_walls_when_the_tool_is_inside(contour: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    inside = Side.LEFT if side is Side.RIGHT else Side.RIGHT
    verdict = judge(move(OVER_RUNS[contour]), inside, R, move(lines((0.5, -0.5), (1, -0.5))))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


@pytest.mark.parametrize(
    "contour",
    [
        lines((-1, 0), (0, 0), *SQUARE, (0, 0.1), (-1, 0.1)),
        lines((-1, 0.1), (-1, 0), (0, 0), *SQUARE, (0, 0.1)),
        lines((-1, 0), (-0.6, 0.1), (0, 0), *SQUARE, (-0.3, -1.5), (-0.3, 1)),
        lines((-8, 0), (0, 0), *SQUARE, (0, 0.1)),
    ],
)
def test_crossings_of_other_segments_and_overlong_ends_are_no_over_runs(contour: Path) -> None:
    verdict = judge(contour, Side.LEFT, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


def test_a_contour_whose_ends_meet_has_no_over_run() -> None:
    for end in ((0.0, 0.0), (0.0, -0.002)):
        verdict = judge(lines((0, 0), *SQUARE, end), Side.LEFT, R, around(R))
        assert verdict.over_run_at is None
        assert not verdict.crosses_itself
        assert verdict.clean


def test_ends_that_overlap_within_the_closing_tolerance_are_leads() -> None:
    for contour in (lines((0, 0), *SQUARE, (0, 0.002)), lines((-0.001, 0), *SQUARE, (0, 0.001))):
        verdict = judge(contour, Side.LEFT, R, around(R))
        assert verdict.over_run_at == pytest.approx((0.0, 0.0), abs=1e-9)
        assert verdict.clean
        inside = judge(contour, Side.RIGHT, R, lines((0.5, -0.5), (1, -0.5)))
        assert inside.over_run_at is None
        assert not inside.gouges


def test_a_full_circle_is_no_over_run_of_a_line_that_crosses_it() -> None:
    """The crossing line shares only one point with the circle: all of the circle is a wall."""
    circle = Arc((2, 0), (2, 0), (0, 0), Turn.CCW)
    contour = Path.from_pieces([circle, Line((2, 0), (4, 1)), Line((4, 1), (0.5, 3))])
    crossing = Path.from_pieces([circle, Line((2, 0), (4, 0)), Line((4, 0), (4, 1)), Line((4, 1), (0, 1))])
    cut = lines((2.5, 0.1), (1.9, 0.1))
    for surface in (contour, crossing, crossing.reversed()):
        for side in Side:
            verdict = judge(surface, side, R, cut)
            assert verdict.over_run_at is None
            assert verdict.depth >= R - 0.005


TAIL = lines((-1, 0), *SQUARE, (0, 1))
TAIL_ARCS = (Arc((-1.5, -0.5), (-1, 0), (-1, -0.5), Turn.CW), Arc((0, 1), (-0.5, 1.5), (-0.5, 1), Turn.CCW))
WITH_ARCS = Path.from_pieces([TAIL_ARCS[0], *TAIL, TAIL_ARCS[1]])


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("part", [slice(None), slice(1, None), slice(None, -1)])
def test_arcs_before_or_after_an_over_run_are_leads_if_several_moves_may_lead(part: slice, motion: str) -> None:
    move, side = MOTIONS[motion]
    contour = move(Path.from_pieces(list(WITH_ARCS)[part]))
    assert judge(contour, side, R, move(around(R))).over_run_at is None
    verdict = judge(contour, side, R, move(around(R)), leads=Leads.MOVES)
    assert verdict.over_run_at == pytest.approx((0.0, 0.0), abs=1e-9)
    assert verdict.surface_length == pytest.approx(6.0)
    assert verdict.clean
    assert judge(contour, side, R, move(around(R - 0.01)), leads=Leads.MOVES).depth == pytest.approx(0.01)


def test_an_arc_that_crosses_the_part_is_no_lead() -> None:
    into = Arc((0, 1), (0.5, -0.5), (-2.75, -0.75), Turn.CW)
    verdict = judge(Path.from_pieces([*TAIL, into]), Side.LEFT, R, around(R), leads=Leads.MOVES)
    assert verdict.over_run_at is None
    assert verdict.crosses_itself


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize(
    ("part", "beyond"), [(slice(None), [1, 2, 5, 6]), (slice(1, None), [1, 4, 5]), (slice(None, -1), [1, 2, 5])]
)
def test_a_lead_may_have_one_bend_if_several_moves_may_lead(part: slice, beyond: list[int], motion: str) -> None:
    """Compensation begins a move before the over-run or ends a move after it."""
    move, side = MOTIONS[motion]
    pieces = [Line((-1.5, -0.5), (-1, 0)), *TAIL, Line((0, 1), (-1, 1))][part]
    contour = move(Path.from_pieces(pieces))
    assert judge(contour, side, R, move(around(R))).over_run_at is None
    verdict = judge(contour, side, R, move(around(R)), leads=Leads.MOVES)
    assert verdict.over_run_at == pytest.approx((0.0, 0.0), abs=1e-9)
    assert verdict.over_run is not None
    assert verdict.clean
    assert judge(contour, side, R, move(around(R - 0.01)), leads=Leads.MOVES).depth == pytest.approx(0.01)
    assert sorted(verdict.over_run.lead_numbers) == beyond


def test_a_long_part_of_a_wall_beyond_the_crossing_is_listed_as_a_lead() -> None:
    """A third of the first wall counts as a lead, so the last segment may be mistyped."""
    contour = lines((-0.75, 0), *SQUARE, (0, 0), (0, 1))
    verdict = judge(contour, Side.LEFT, R, around(R), leads=Leads.MOVES)
    assert verdict.over_run is not None
    assert verdict.over_run.lead_numbers == (1.0, 5.0)
    short = judge(lines((-0.25, 0), *SQUARE, (0, 0), (0, 1)), Side.LEFT, R, around(R), leads=Leads.MOVES)
    assert short.over_run is not None
    assert short.over_run.lead_numbers == ()


def test_a_lead_has_at_most_one_bend_and_none_on_the_part_side() -> None:
    once = Path.from_pieces([*TAIL, Line((0, 1), (-1, 1))])
    twice = Path.from_pieces([*once, Line((-1, 1), (-1, 2))])
    for contour, side in ((twice, Side.LEFT), (once, Side.RIGHT)):
        verdict = judge(contour, side, R, around(R), leads=Leads.MOVES)
        assert verdict.over_run_at is None
        assert verdict.crosses_itself


@pytest.mark.parametrize(
    ("contour", "text"),
    [
        (
            lines((0, 1.5), (2, 0), (2, 2), (0, 2), (0, 0)),
            "START is on segment 4; the last {value}, past START, is taken for lead-out.",
        ),
        (
            lines((0, 1.5), (2, 0), (2, 2), (0, 2), (0, 1.2), (0, 0)),
            "START is on segment 4; the last {value}, past START, is taken for lead-out.",
        ),
        (
            lines((0, 0), (0, 2), (2, 2), (2, 0), (0, 1.5)),
            "The contour ends on segment 1; the first {value}, before it, is taken for lead-in.",
        ),
    ],
)
def test_a_long_lead_on_an_end_segment_is_reported_as_a_possibly_mistyped_start(contour: Path, text: str) -> None:
    side = Side.RIGHT if contour.points[0][1] else Side.LEFT
    verdict = judge(contour, side, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at == pytest.approx((0.0, 1.5))
    (over_run,) = [finding for finding in verdict_findings(verdict, contour) if finding.code == "OVER_RUN"]
    assert over_run.severity is Severity.WARNING
    assert over_run.text.startswith(text)
    assert over_run.text.endswith("Check START.")
    assert over_run.value == pytest.approx(1.5)


@pytest.mark.parametrize("contour", [*OVER_RUNS.values(), TAIL, lines((0, 0), *SQUARE, (0, 0.4))])
def test_short_or_separate_or_crossing_leads_are_information(contour: Path) -> None:
    verdict = judge(contour, Side.LEFT, R, around(R))
    (over_run,) = [finding for finding in verdict_findings(verdict, contour) if finding.code == "OVER_RUN"]
    assert over_run.severity is Severity.INFO


def test_long_leads_at_both_ends_are_named_as_possible_walls() -> None:
    """The lead-in is 3 of the first line's 4.5, the lead-out 1 of the last line's 2.5."""
    contour = lines((-3, 0), *SQUARE, (0, 1))
    (over_run, *_) = verdict_findings(judge(contour, Side.LEFT, R, around(R)), contour)
    assert (over_run.code, over_run.severity) == ("OVER_RUN", Severity.WARNING)
    assert "Taken for lead beyond it: segments 1 and 4. " in over_run.text


def test_a_long_lead_in_several_moves_of_one_line_is_named_as_a_possible_wall() -> None:
    """Of its 4.5, 3 lie beyond the crossing, as in one move, but only 0.1 of the move that crosses."""
    contour = lines((-3, 0), (-1, 0), (-0.1, 0), (0.5, 0), *SQUARE, (0, 0.2))
    (over_run, *_) = verdict_findings(judge(contour, Side.LEFT, R, around(R)), contour)
    assert (over_run.code, over_run.severity) == ("OVER_RUN", Severity.WARNING)
    assert "Taken for lead beyond it: segments 1, 2, 3 and 7. " in over_run.text


def test_chords_that_count_as_one_straight_line_have_no_over_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """A drop of 280 degrees and two tangents that cross; a line may bend by so much here that 40 chords are enough."""
    monkeypatch.setattr("core.verify.surface.IN_LINE", 0.2)
    turns = [radians(7 * chord - 50) for chord in range(41)]
    x, y = sin(turns[-1]) + 2 * cos(turns[-1]), -cos(turns[-1]) + 2 * sin(turns[-1])
    drop = lines((x, -y), *((sin(turn), -cos(turn)) for turn in turns), (x, y))
    verdict = judge(drop, Side.LEFT, 0.1, lines((9, 9), (8, 9)), leads=Leads.MOVES)
    assert verdict.crosses_itself
    assert verdict.over_run is None


LEAF_CENTER = (0.75, 2.25)
LEAF_FOOT = (0.0, 2.25 - sqrt(3.25**2 + 0.25**2 - 0.75**2))
LEAF_BACK = (Line((4, 2), (0, 2)), Line((0, 2), (0, -2.5)))


def arc(start: tuple[float, float], end: tuple[float, float]) -> Arc:
    """An arc on the lower edge of the leaf."""
    return Arc(start, end, LEAF_CENTER, Turn.CCW)


LEAVES: dict[str, list[Piece]] = {
    "crosses": [arc((-1, -0.5), (4, 2)), *LEAF_BACK],
    "starts at the corner": [arc(LEAF_FOOT, (4, 2)), *LEAF_BACK],
    "ends at the corner": [arc((-1, -0.5), (4, 2)), LEAF_BACK[0], Line((0, 2), LEAF_FOOT)],
    "arc that leads in": [arc((-1, -0.5), LEAF_FOOT), arc(LEAF_FOOT, (4, 2)), *LEAF_BACK],
    "arc that leads out": [
        arc(LEAF_FOOT, (4, 2)),
        LEAF_BACK[0],
        Line((0, 2), LEAF_FOOT),
        Arc(LEAF_FOOT, (-1, LEAF_FOOT[1] - 1), (-1, LEAF_FOOT[1]), Turn.CW),
    ],
}


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("name", LEAVES)
def test_an_over_run_of_arcs_is_a_lead(name: str, motion: str) -> None:
    move, side = MOTIONS[motion]
    other = Side.LEFT if side is Side.RIGHT else Side.RIGHT
    leaf = Path.from_pieces([arc(LEAF_FOOT, (4, 2)), LEAF_BACK[0], Line((0, 2), LEAF_FOOT)])
    verdict = judge(move(Path.from_pieces(LEAVES[name])), other, R, lines((9, 9), (8, 9)))
    assert verdict.over_run_at == pytest.approx(LEAF_FOOT, abs=1e-9)
    assert verdict.surface_length == pytest.approx(float(leaf.lengths.sum()))


def test_straight_leads_of_a_full_circle_are_leads() -> None:
    circle = Arc((2, 0), (2, 0), (0, 0), Turn.CW)
    contour = Path.from_pieces([Line((4, -1), (2, 0)), circle, Line((2, 0), (4, 1))])
    verdict = judge(contour, Side.LEFT, R, Path.from_pieces([Arc((2 + R, 0), (2 + R, 0), (0, 0), Turn.CW)]))
    assert verdict.over_run_at == pytest.approx((2.0, 0.0))
    assert verdict.clean
    assert verdict.uncut == ()
