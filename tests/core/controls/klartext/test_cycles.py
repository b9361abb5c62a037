"""Cycles of which only the end is known, and the blocks between them and the contour."""

from __future__ import annotations

import pytest

from core.controls.control_run import ControlRun
from core.finding import Severity
from tests.core.controls.klartext.klartext_runs import codes, flat, points, runs

DRILLING = ("CYCL DEF 200 DRILLING ~", "  Q200=+2 ;SET-UP ~", " Q201=-20 ~", "Q203=+5 ;SURFACE ~", "Q204=+50")
CONTOUR = ("L X-20 Y+0 R0 FMAX", "L X+0 Y+0 RL F9", "L X+30", "L X+60 R0")


def compensated(made: ControlRun) -> list[tuple[float, ...]]:
    """The moves of the contour after a cycle."""
    assert made.stopped_at is None, made.findings
    return flat(made)[-3:]


def test_a_drilling_cycle_ends_above_its_hole_by_the_larger_clearance() -> None:
    made = runs("L X+3 Y+4 Z+9 R0 FMAX", *DRILLING, "CYCL CALL M3", "L X+7 FMAX")
    assert points(made, 1) == [(3, 4, 9), (3, 4, 55), (7, 4, 55)]
    assert codes(made) == [("IGNORED", 5), ("CYCLE", 10)]


def test_m99_calls_the_cycle_at_the_end_of_its_block() -> None:
    made = runs("L Z+9 R0 FMAX", *DRILLING, "L X+3 Y+4 FMAX M99", "L X+7 FMAX M99")
    assert points(made, 1)[-3:] == [(3, 4, 9), (3, 4, 55), (7, 4, 55)]


def test_a_call_at_a_position_counts_from_there() -> None:
    made = runs("L X+3 Y+4 Z+9 R0 FMAX", *DRILLING, "CYCL CALL POS X+20 Y+30 Z+0 FMAX", "L IX+7 FMAX")
    assert points(made)[-1] == (27, 30, 55)


@pytest.mark.parametrize(
    "cycle",
    [
        DRILLING,
        ("CYCL DEF 1.0 PECKING", "CYCL DEF 1.1 SET UP 2", "CYCL DEF 1.2 DEPTH -20"),
        ("CYCL DEF 4.0 POCKET MILLING", "CYCL DEF 4.1 SET UP 2"),
        ("CYCL DEF 251 RECTANGULAR POCKET ~", " Q215=0 ~", " Q218=60"),
        ("CYCL DEF 14.0 CONTOUR", "CYCL DEF 14.1 CONTOUR LABEL 1", "CYCL DEF 21 PILOT DRILLING"),
    ],
)
@pytest.mark.parametrize("call", ["CYCL CALL", "CYCL CALL PAT FMAX", "L X+1 Y+1 FMAX M99"])
def test_the_contour_behind_a_cycle_is_run_as_without_it(cycle: tuple[str, ...], call: str) -> None:
    bare = flat(runs("L X+0 Y+0 Z+9 R0 FMAX", *CONTOUR))[-3:]
    assert compensated(runs("L X+0 Y+0 Z+9 R0 FMAX", *cycle, call, *CONTOUR)) == bare


@pytest.mark.parametrize("number", [16, 22, 24, 25, 275])
def test_what_a_cycle_mills_along_a_contour_is_not_called_clean(number: int) -> None:
    made = runs("L X+0 Y+0 Z+9 R0 FMAX", f"CYCL DEF {number} CONTOUR", "CYCL CALL", "L X+5 FMAX")
    assert codes(made)[-1] == ("BEYOND", 6)
    assert made.stopped_at == 6


def test_a_pattern_calls_the_cycle_before_at_once() -> None:
    made = runs("L X+0 Y+0 Z+9 R0 FMAX", *DRILLING, "CYCL DEF 221 CARTESIAN PATTERN ~", " Q225=+15", *CONTOUR)
    assert ("CYCLE", 10) in codes(made)
    assert len(compensated(made)) == 3


def test_after_a_pocket_relative_words_start_from_an_unknown_place() -> None:
    made = runs("L X+1 Y+1 Z+1 FMAX", "CYCL DEF 251 RECTANGULAR POCKET", "CYCL CALL", "L IX+5 F9")
    assert codes(made)[-2:] == [("CYCLE", 6), ("POSITION", 7)]


@pytest.mark.parametrize("cycle", [DRILLING, ("CYCL DEF 1.0 PECKING", "CYCL DEF 1.1 SET UP 2")])
def test_after_a_pattern_the_tool_is_somewhere_over_its_points(cycle: tuple[str, ...]) -> None:
    made = runs("L X+1 Y+1 Z+9 FMAX", *cycle, "CYCL CALL PAT FMAX", "L X+5 F9")
    assert codes(made)[-2:] == [("CYCLE", 5 + len(cycle)), ("POSITION", 6 + len(cycle))]


@pytest.mark.parametrize("number", [26, 28, 400, 421])
def test_a_cycle_that_moves_the_contour_or_measures_it_is_not_followed(number: int) -> None:
    made = runs("L X+1 Y+1 Z+1 FMAX", f"CYCL DEF {number} SOMETHING", "L X+5 F9")
    assert codes(made)[-1] == ("BEYOND", 5)


def test_the_values_of_a_cycle_are_parameters() -> None:
    assert points(runs("L X+0 Y+0 Z+9 R0 FMAX", *DRILLING, "L X+Q204 FMAX"))[-1] == (50, 0, 9)


def test_a_block_number_may_begin_with_n() -> None:
    assert flat(runs("N10 L X+1 Y+2 Z+3 FMAX", "N20L X+5"), 1)[0] == (1, 2)


def test_the_values_of_a_cycle_may_be_parameters_or_stand_on_lines_of_their_own() -> None:
    loose = ("CYCL DEF 203 DRILLING", "Q200 = 2", "Q203 = 0", "Q204 = 20", "CYCL CALL")
    for cycle in (loose, ("Q1 = 20", "CYCL DEF 203 DRILLING ~", "Q200=2 ~", "Q203=0 ~", "Q204=+Q1", "CYCL CALL")):
        assert points(runs("L X+1 Y+2 Z+9 R0 FMAX", *cycle))[-1] == (1, 2, 20)


def test_a_value_that_is_not_known_leaves_the_height_open() -> None:
    made = runs("L X+1 Y+2 Z+9 R0 FMAX", "CYCL DEF 203 DRILLING ~", "Q200=2 ~", "Q203=+Q7 ~", "Q204=20", "CYCL CALL")
    assert points(made, 1) == [(1, 2, 9)]
    assert "from the next absolute words" in made.findings[-1].text


def test_what_a_milling_cycle_cuts_is_not_judged_and_that_is_a_warning_once() -> None:
    milled = "CYCL DEF 251 RECTANGULAR POCKET ~", "Q218=+60"
    made = runs(*milled, *(f"L X+{x} Y+0 R0 FMAX M99" for x in (0, 40, 80)))
    told = [finding.severity for finding in made.findings if finding.code == "CYCLE"]
    assert told == [Severity.WARNING, Severity.INFO, Severity.INFO]
    drilled = runs("L Z+9 R0 FMAX", *DRILLING, "L X+3 Y+4 FMAX M99")
    assert [finding.severity for finding in drilled.findings if finding.code == "CYCLE"] == [Severity.INFO]


def test_contour_cycles_give_their_values_in_further_lines() -> None:
    data = ("CYCL DEF 20 CONTOUR DATA ~", "  Q1=-20 ;MILLING DEPTH ~", "  Q7=+100 ;CLEARANCE HEIGHT")
    run = runs(*data, "CYCL DEF 22 ROUGH-OUT ~", "  Q10=+5 ;PLUNGING DEPTH", "L Z+Q7 R0 FMAX")
    assert run.stopped_at is None
    assert run.moves.points[-1, 2] == 100.0
    assert runs(*data, "CYCL DEF 22 ROUGH-OUT ~", "  Q10=+5 ;PLUNGING DEPTH", "CYCL CALL").stopped_at == 9


@pytest.mark.parametrize(
    ("cycle", "call", "axes"),
    [
        ("CYCL DEF 200 DRILLING", "CYCL CALL", "Z"),
        ("CYCL DEF 200 DRILLING", "CYCL CALL PAT", "X and Y and Z"),
        ("CYCL DEF 251 RECTANGULAR POCKET", "CYCL CALL", "X and Y and Z"),
    ],
)
def test_the_axes_whose_place_is_not_known_after_a_cycle_are_named(cycle: str, call: str, axes: str) -> None:
    made = runs("L X+1 Y+1 Z+1 R0 FMAX", cycle, call)
    assert made.findings[-1].text.endswith(f"; cutcomp takes {axes} from the next absolute words.")
    for axis in "XY":
        after = runs("L X+1 Y+1 Z+1 R0 FMAX", cycle, call, f"L I{axis}+5 F9")
        assert (("POSITION", 7) in codes(after)) is (axis in axes), axis
