"""A short run of the comparison with LinuxCNC, and its parts by hand."""

from __future__ import annotations

from math import inf

import pytest

from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Side, Turn
from tests import rs274
from tests.core.comp.contours import lines
from tests.reports.linuxcnc import BEST, MANY, ONE, printed, report
from tests.reports.linuxcnc_contours import KINDS, RADIUS, Part, corner_angle, part
from tests.reports.linuxcnc_differences import Case, Rule, differences, rule_of, witnessed

SQUARE = lines((0, 0), (500, 0), (500, 500), (0, 500))


def test_forty_contours_differ_by_named_rules_only(tmp_path):
    rs274.require()
    found = report(40, tmp_path)
    assert found.accepted == 40
    assert not found.unexplained
    assert all(found.equal[which] >= 20 for which in (ONE, MANY, BEST))
    assert list(printed(found))[-1] == "unexplained: 0"


def test_a_refused_contour_stops_none_of_its_neighbors(tmp_path):
    rs274.require()
    slot = lines((0, 0), (500, 0), (500, 50), (0, 50))
    sound = Part("square", SQUARE, Side.LEFT, closed=False)
    found = witnessed([sound, Part("slot", slot, Side.LEFT, closed=False), sound], tmp_path)
    assert [bool(one.refusal) for one in found] == [False, True, False]
    assert (
        list(found[0].path) == list(found[2].path) == list(compensate(SQUARE, Side.LEFT, RADIUS, 1, closed=False).path)
    )


def _rules(contour: Path, side: Side, tmp_path, lookahead: int = 1, rapid: frozenset[int] = frozenset()) -> set[Rule]:
    rs274.require()
    one = Part("by hand", contour, side, closed=False, rapid=rapid)
    (theirs,) = witnessed([one], tmp_path)
    assert not theirs.refusal
    ours = compensate(contour, side, RADIUS, lookahead, closed=False)
    case = Case(one, theirs, ours, best_path(contour, side, RADIUS, closed=False))
    return {rule_of(case, found) for found in differences(ours.path, theirs.path)}


@pytest.mark.parametrize("side", Side)
def test_a_square_is_the_same_on_both_sides(side, tmp_path):
    assert not _rules(SQUARE, side, tmp_path)


def test_a_corner_under_the_tangent_limit(tmp_path):
    assert _rules(lines((0, 0), (500, 0), (1000, -20)), Side.LEFT, tmp_path) == {Rule.TANGENT}
    assert not _rules(lines((0, 0), (500, 0), (1000, -30)), Side.LEFT, tmp_path)


def test_an_outside_corner_in_front_of_a_rapid_move(tmp_path):
    assert _rules(SQUARE, Side.RIGHT, tmp_path, rapid=frozenset({2})) == {Rule.RAPID}
    assert not _rules(SQUARE, Side.LEFT, tmp_path, rapid=frozenset({2}))


def test_an_inside_corner_beyond_its_segment_is_not_noticed_in_front_of_a_tangent(tmp_path):
    assert _rules(lines((0, 0), (500, 0), (500, 50), (500, 400)), Side.LEFT, tmp_path) == {Rule.BACKWARDS}


def test_a_notch_that_only_a_look_ahead_can_cross(tmp_path):
    notch = lines((0, 0), (500, 0), (500, -300), (650, -300), (650, 0), (1200, 0))
    step = lines((0, 0), (500, 0), (700, 300), (900, 0), (880, -500), (300, -200), (600, 900))
    assert {part(seed).name.split()[0] for seed in range(len(KINDS))} == {kind.__name__ for kind in KINDS}
    assert witnessed([Part("notch", notch, Side.LEFT, closed=False)], tmp_path)[0].refusal
    assert _rules(step, Side.LEFT, tmp_path, lookahead=9) == {Rule.LOOKAHEAD}


def _rounded(radius: float) -> Path:
    """Two walls with an arc between them, counter-clockwise."""
    arc = Arc((300, 0), (300 + radius, radius), (300, radius), Turn.CCW)
    return Path.from_pieces([Line((0, 0), (300, 0)), arc, Line(arc.end, (300 + radius, 500))])


REFUSED_THERE = {
    "an arc smaller than the tool": (_rounded(90), Side.LEFT, "Tool radius not less", {"VANISHED", "CORNER_MISSED"}),
    "an arc exactly as small as the tool": (_rounded(100), Side.LEFT, "Tool radius not less", set()),
    "a tiny arc in millimeters": (_rounded(0.001), Side.RIGHT, "Zero-radius arc", set()),
    "line, line, line": (lines((0, 500), (0, 0), (150, 0), (150, 500)), Side.LEFT, "concave", {"CORNER_MISSED"}),
    "the last corner before G40": (lines((0, 0), (500, 0), (500, 50)), Side.LEFT, "concave", {"CORNER_MISSED"}),
}


@pytest.mark.parametrize("name", REFUSED_THERE)
def test_what_linuxcnc_refuses_is_cut_or_reported_here(name, tmp_path):
    rs274.require()
    contour, side, sentence, told = REFUSED_THERE[name]
    (theirs,) = witnessed([Part(name, contour, side, closed=False)], tmp_path)
    assert sentence in theirs.refusal
    assert {one.code for one in compensate(contour, side, RADIUS, 1, closed=False).findings} <= told
    assert bool(compensate(contour, side, RADIUS, 1, closed=False).findings) is bool(told)


def test_an_arc_a_hair_larger_than_the_tool_and_three_offsets_in_one_point_are_alike(tmp_path):
    assert not _rules(_rounded(100.001), Side.LEFT, tmp_path)
    assert not _rules(_rounded(0.02), Side.RIGHT, tmp_path)
    assert not _rules(lines((0, 500), (0, 0), (200, 0), (200, 500)), Side.LEFT, tmp_path)


def test_differences_are_classified_by_the_pieces_around_them():
    path = compensate(SQUARE, Side.RIGHT, RADIUS, 1, closed=False).path
    assert not differences(path, list(path))
    (one,) = differences(path, [piece for row, piece in enumerate(path) if row != 2])
    assert (one.first, one.last, len(one.ours), len(one.theirs)) == (1.5, 2.5, 1, 0)
    (every,) = differences(path, [])
    assert (every.first, every.last) == (-inf, inf)


def test_corner_angles_are_positive_to_the_left():
    assert corner_angle(SQUARE, 1) == pytest.approx(1.5707963)
    assert corner_angle(SQUARE.reversed(), 1) == pytest.approx(-1.5707963)
