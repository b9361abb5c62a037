"""Findings on paths: contours that turn straight back, gaps, sizes, steps, blend arcs and roughing."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest

from core.advice.block_paths import BlockPaths, RoughPass
from core.advice.path_findings import (
    ZStep,
    better_path_findings,
    by_severity,
    move_names,
    nearest_place,
    open_finding,
    path_findings,
    size_warning,
    tight_arcs,
    turning_back,
    z_step_findings,
)
from core.comp.best_path.best_path import best_path
from core.comp.best_path.separation import separation
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.units import Unit, sentence
from core.verify.judge import judge
from tests.core.advice.works import work
from tests.core.comp.contours import lines


def rounded(turn: Turn) -> list[Piece]:
    """Two lines and an arc between them in the right or the wrong direction."""
    return [Line((0, 0), (2, 0)), Arc((2, 0), (3, 1), (2, 1), turn), Line((3, 1), (3, 4))]


def turned(*pieces: Piece, closed: bool = False) -> list[float | None]:
    path = Path.from_pieces(pieces, [float(number) for number in range(1, len(pieces) + 1)])
    return [finding.segment for finding in turning_back(path, closed=closed)]


def test_an_arc_of_the_wrong_direction_turns_back_at_both_ends() -> None:
    assert turned(*rounded(Turn.CCW)) == []
    assert turned(*rounded(Turn.CW)) == [2.0, 3.0]


@pytest.mark.parametrize(("angle", "turns"), [(0.0, True), (0.9, True), (1.1, False), (90.0, False), (180.0, False)])
def test_a_line_that_nearly_retraces_the_one_before_turns_back(angle: float, turns: float) -> None:
    end = 2.0 - cos(radians(angle)), sin(radians(angle))
    assert turned(Line((0, 0), (2, 0)), Line((2, 0), end)) == ([2.0] if turns else [])


def test_a_closed_contour_may_turn_back_at_its_start() -> None:
    pieces = (Line((0, 0), (2, 0)), Line((2, 0), (2, 2)), Line((2, 2), (3, 0)), Line((3, 0), (0, 0)))
    assert turned(*pieces) == []
    assert turned(*pieces, closed=True) == [1.0]


def test_the_cusps_between_scallops_do_not_turn_back() -> None:
    scallops = [Arc((2 * k, 0), (2 * k + 2, 0), (2 * k + 1, 0), Turn.CW) for k in range(3)]
    assert turned(*scallops) == []
    assert turned(Line((0, -1), (0, 0)), *scallops) == []
    assert turned(Line((0, 1), (0, 0)), *scallops) == [2.0]


def test_the_direction_of_the_arc_is_named_at_both_of_its_ends() -> None:
    path = Path.from_pieces(rounded(Turn.CW), [1.0, 2.0, 3.0])
    advice = [sentence(finding, Unit.MM).partition("Check ")[2] for finding in turning_back(path, closed=False)]
    assert advice == ["its DIRECTION and its end.", "DIRECTION of segment 2."]


def test_a_full_circle_does_not_turn_back() -> None:
    assert turned(Arc((1, 0), (1, 0), (0, 0), Turn.CCW), closed=True) == []


@pytest.mark.parametrize(("radius", "told"), [(0.99, False), (1.0, False), (1.01, True)])
def test_the_size_of_a_contour_includes_its_arcs(radius, told):
    """The points of this circle span 1 mm by 0."""
    half = Path.of(np.array([[0.0, 0], [1, 0], [0, 0]]), np.array([[0.5, 0], [1, 0]]), np.array([1, 0], np.int8))
    whole = Path.of(np.zeros((2, 2)), np.array([[1.0, 0]]), np.array([1], np.int8))
    assert bool(size_warning(radius, whole, Side.LEFT, closed=True)) is told
    assert bool(size_warning(radius / 2, half, Side.LEFT, closed=False)) is told


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_a_tool_may_be_larger_than_an_island(turn: Turn) -> None:
    """A boss of 6 mm; the same circle as a hole is smaller than the tool."""
    circle = Path.from_pieces([Arc((3, 0), (3, 0), (0, 0), turn)])
    outside, inside = (Side.RIGHT, Side.LEFT) if turn is Turn.CCW else (Side.LEFT, Side.RIGHT)
    assert not size_warning(5.0, circle, outside, closed=True)
    assert size_warning(5.0, circle, inside, closed=True)
    # an open edge encloses nothing, on either side
    edge = Path.from_pieces([Arc((3, 0), (-3, 0), (0, 0), turn)])
    assert size_warning(5.0, edge, outside, closed=False)
    assert size_warning(5.0, edge, inside, closed=False)


@pytest.mark.parametrize(
    ("gap", "closed", "code"),
    [(0.0, False, None), (0.002, True, "NEARLY_CLOSED"), (5.0, False, "NEARLY_CLOSED"), (5.1, False, "OPEN")],
)
def test_a_gap_is_reported_by_its_size_relative_to_the_tool(gap: float, closed: bool, code: str | None) -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (20, 20)), Line((20, 20), (0, gap))])
    assert [finding.code for finding in open_finding(surface, 5.0, closed=closed)] == ([code] if code else [])


@pytest.mark.parametrize(
    ("gap", "words"),
    [
        (0.0005, "ends 0.00002 from START, at X 0.0000 Y 0.00002."),
        (0.00001, "ends 0.0000004 from START, at X 0.0000 Y 0.0000004."),
        (1.27, "ends 0.0500 from START, at X 0.0000 Y 0.0500."),
    ],
)
def test_a_gap_is_shown_with_enough_digits(gap: float, words: str) -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (20, 20)), Line((20, 20), (0, gap))])
    (finding,) = open_finding(surface, 5.0, closed=True)
    assert words in sentence(finding, Unit.IN)


def test_two_segments_with_a_gap_are_an_open_contour() -> None:
    surface = Path.from_pieces([Line((0, 0), (20, 0)), Line((20, 0), (0, 1))])
    assert [finding.code for finding in open_finding(surface, 5.0, closed=False)] == []


def test_the_deepest_and_the_highest_step_are_reported_with_their_counts() -> None:
    steps = [ZStep(-1.0, 2.0, (0, 0)), ZStep(-3.0, 4.0, (5, 0)), ZStep(2.0, 6.0, (7, 1))]
    down, up = z_step_findings(steps)
    assert (down.segment, down.value, down.at) == (4.0, 3.0, (5, 0))
    assert sentence(down, Unit.MM).endswith("shortened there. There are 2 such places.")
    assert (up.segment, up.value) == (6.0, 2.0)
    assert "straight up 2.000" in sentence(up, Unit.MM)
    assert z_step_findings([]) == ()


SQUARE = lines((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))
NOTCH = lines((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))


def messages(paths: BlockPaths, code: str) -> list[tuple[Severity, float | None, str]]:
    findings = [finding for finding in path_findings(paths) if finding.code == code]
    return [(finding.severity, finding.segment, sentence(finding, Unit.MM)) for finding in findings]


def test_findings_are_sorted_by_severity_in_stable_order() -> None:
    names = ("b", Severity.INFO), ("a", Severity.WARNING), ("d", Severity.ERROR), ("c", Severity.WARNING)
    findings = by_severity([Finding(code, severity, "") for code, severity in names])
    assert [finding.code for finding in findings] == ["d", "a", "c", "b"]


def test_a_clean_path_has_no_findings_except_uncut_stretches() -> None:
    assert {finding.code for finding in path_findings(work(SQUARE, closed=True, blend=0.1, overlap=0.1))} == {"UNCUT"}


def test_a_blend_arc_that_gouges_is_an_error_at_either_end() -> None:
    narrow = lines((1, 0), (2, 0), (2, 0.8), (0, 0.8), (0, 0), (1, 0))
    paths = work(narrow, closed=True, blend=0.9)
    blends = messages(paths, "BLEND_GOUGES")
    assert [severity for severity, _, _ in blends] == [Severity.ERROR] * 2
    assert [segment for _, segment, _ in blends] == [3.0, 3.0]
    assert blends[0][2].startswith("The blend-in arc gouges ")
    assert blends[1][2].startswith("The blend-out arc gouges ")
    assert blends[1][2].endswith("Start elsewhere or reduce BLEND OFFSET with F4.")
    assert not messages(work(narrow, closed=True, blend=0.1), "BLEND_GOUGES")


def test_a_blend_arc_that_crosses_a_wall_is_reported_with_its_free_end() -> None:
    (begin, end) = messages(work(SQUARE, closed=True, blend=1.4), "BLEND_LEAVES")
    assert begin == (
        Severity.WARNING,
        1.0,
        "The blend-in arc from X -0.400 Y 1.650 crosses a wall. Reduce BLEND OFFSET with F4.",
    )
    assert end == (
        Severity.WARNING,
        5.0,
        "The blend-out arc to X 2.400 Y 1.650 crosses a wall. Reduce BLEND OFFSET with F4.",
    )


def test_moves_are_named_by_their_part_of_the_path() -> None:
    hook = lines((1, 0), (2, 0), (2, 1), (0.9, 1), (0.9, 0.3), (0, 0.3), (0, 0), (1, 0))
    paths = work(hook, closed=True, blend=0.1, overlap=0.5)
    (loop,) = paths.loops
    name, count = move_names(paths), len(loop.with_leads)
    assert "blend-in arc" in name(0, 1.0)
    assert name(1, 1.0).endswith("the path of segment 1")
    assert name(len(loop.lead_in) + len(loop.path) - 1, 7.0).endswith("the path of segment 7")
    assert name(count - 2, 1.0).endswith("the path of segment 1 past START")
    assert "blend-out arc" in name(count - 1, 1.0)
    with pytest.raises(IndexError):
        name(count, 1.0)


def test_roughing_into_the_part_is_an_error_and_into_its_stock_a_warning() -> None:
    slot = lines((0, 0), (2, 0), (2, -1), (2.3, -1), (2.3, 0), (5, 0))
    ((severity, segment, text),) = messages(work(slot, radius=0.125, lookahead=2, stocks=(0.125,)), "ROUGH_GOUGES")
    assert severity is Severity.ERROR
    assert segment in (2.0, 4.0)
    assert text.startswith("Roughing that leaves 0.125 gouges ")
    step = lines((0.28, 0), (2, 0), (2, 2), (0, 2), (0, 0.5))
    ((severity, segment, text),) = messages(work(step, radius=0.125, lookahead=2, stocks=(0.3,)), "ROUGH_STOCK")
    assert (severity, segment) == (Severity.WARNING, 4.0)
    assert text.startswith("Roughing that should leave 0.300 leaves only 0.1")


def test_roughing_that_skips_segments_or_has_no_room_is_reported() -> None:
    paths = work(NOTCH, radius=0.1, lookahead=3, stocks=(0.2, 0.01))
    assert messages(paths, "ROUGH_DELETES") == [
        (
            Severity.WARNING,
            2.0,
            "Roughing that leaves 0.200 skips segments 2, 3, 4: the next pass cuts solid stock there.",
        )
    ]
    assert paths.compensated is not None
    assert paths.verdict is not None
    none = RoughPass(0.2, (), paths.compensated, paths.verdict)
    assert messages(replace(paths, rough=(none,)), "ROUGH_EMPTY") == [
        (Severity.WARNING, None, "No room for the 0.200 roughing pass: skipped.")
    ]
    points = (0.35, 0), (2, 0), (2, 1.5), (0, 1.5), (0, 0), (0.35, 0)
    near_corner = work(lines(*points), radius=0.25, lookahead=4, closed=True, stocks=(0.1,))
    text = "The 0.100 roughing pass comes back to its start next to a corner and is skipped. "
    expected = [(Severity.WARNING, None, f"{text}Start in the middle of a side.")]
    assert messages(near_corner, "ROUGH_EMPTY") == expected
    beyond = RoughPass(0.2, paths.loops, paths.compensated, replace(paths.verdict, wrong_side=(0,)))
    assert messages(replace(paths, rough=(beyond,)), "ROUGH_GOUGES")[0][2].endswith("on the wrong side of the contour.")
    unjudged = RoughPass(0.2, paths.loops, paths.compensated, replace(paths.verdict, judged=False))
    assert messages(replace(paths, rough=(unjudged,)), "ROUGH_GOUGES")[0][2].endswith("cannot be judged.")


def test_the_additional_length_of_the_best_path_is_reported_with_its_place() -> None:
    paths = work(lines((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1)), Side.RIGHT, lookahead=4)
    best = best_path(paths.surface, Side.RIGHT, 0.25, closed=False)
    apart = separation(paths.compensated.path, best, 0.25)
    (difference,) = better_path_findings(best, apart)
    assert (difference.code, difference.severity) == ("BEST_DIFFERS", Severity.INFO)
    assert difference.value > 8.0
    assert difference.at == (0.25, -0.25)
    assert sentence(difference, Unit.MM).startswith("BEST runs ")
    assert better_path_findings(best, replace(apart, length=0.0013)) != ()
    # this would show as 0.0000 in inches
    assert better_path_findings(best, replace(apart, length=0.0012)) == ()
    same = work(SQUARE, closed=True)
    whole = best_path(SQUARE, Side.LEFT, 0.25, closed=True)
    assert better_path_findings(whole, separation(same.compensated.path, whole, 0.25)) == ()
    none = best_path(SQUARE, Side.LEFT, 2.0, closed=True)
    (nowhere,) = better_path_findings(none, separation(same.compensated.path, none, 2.0))
    assert (nowhere.code, nowhere.text) == ("NO_BEST", "The tool does not fit. Use a smaller one.")


@pytest.mark.parametrize(
    ("tool", "told"),
    [
        (0.5, None),
        (1.0, "The radius 0.750 is smaller than the tool's 1.000."),
        # enough digits to show the difference
        (0.7501, "The radius 0.7500 is smaller than the tool's 0.7501."),
    ],
)
def test_an_inside_arc_smaller_than_the_tool_is_named(tool: float, told: str | None) -> None:
    """A half-round notch of radius 0.75 in the middle of the top of a plate, the tool outside; the plate's corner is
    round by 0.25, which a tool of any size goes around."""
    notch = Arc((2.25, 4.0), (3.75, 4.0), (3.0, 4.0), Turn.CCW)
    corner = Arc((5.75, 4.0), (6.0, 3.75), (5.75, 3.75), Turn.CW)
    before: list[Piece] = [Line((0.0, 0.0), (0.0, 4.0)), Line((0.0, 4.0), (2.25, 4.0))]
    pieces = [*before, notch, Line((3.75, 4.0), (5.75, 4.0)), corner, Line((6.0, 3.75), (6.0, 0.0))]
    plate = Path.from_pieces([*pieces, Line((6.0, 0.0), (0.0, 0.0))], [float(number) for number in range(1, 8)])
    verdict = judge(plate, Side.LEFT, tool, best_path(plate, Side.LEFT, tool, closed=True).loops)
    findings = tight_arcs(verdict, plate, Side.LEFT, tool)
    assert [sentence(finding, Unit.MM).partition(" To cut")[0] for finding in findings] == ([told] if told else [])
    assert all((finding.segment, finding.value) == (3.0, 1.5) for finding in findings)


def test_the_nearest_place_is_where_the_path_comes_nearest_to_the_surface() -> None:
    assert nearest_place(None) is None
    wall = work(lines((0, 0), (2, 0), (2, 3)))
    assert nearest_place(replace(wall, verdict=None)) is None
    place = nearest_place(wall)
    assert place is not None
    assert place.distance == pytest.approx(0.25)
    assert (place.at, place.surface_at, place.surface_number) == ((0.0, 0.25), (0.0, 0.0), 1.0)
