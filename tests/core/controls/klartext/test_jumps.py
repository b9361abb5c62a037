"""Labels, subprograms, repeats, parameters and jumps."""

from __future__ import annotations

import pytest

from tests.core.controls.klartext.klartext_runs import clean, codes, flat, runs

START = "L X+0 Y+0 Z+1 R0 F100"


def xs(*blocks: str) -> list[float]:
    return [move[0] for move in flat(clean(START, *blocks))]


def test_a_part_is_repeated() -> None:
    assert xs("LBL 1", "L IX+5", "CALL LBL 1 REP 2") == [5, 10, 15]
    assert xs("LBL 1", "L IX+5", "CALL LBL 1 REP 2/2", "L IX+1") == [5, 10, 15, 16]
    assert xs("LBL 02", "L IX+5", "CALL LBL 2 REP 1", "FN 9: IF +1 EQU +1 GOTO LBL 003", "L IX+9", "LBL 3") == [5, 10]


def test_repeats_within_repeats() -> None:
    inner = ("LBL 2", "L IX+1", "CALL LBL 2 REP 1", "L IX+10", "CALL LBL 1 REP 1")
    assert xs("LBL 1", *inner) == [1, 2, 12, 13, 14, 24]


def test_a_subprogram_after_the_end() -> None:
    assert xs("CALL LBL 7", "L X+50", "CALL LBL 7", "L X+0 M2", "LBL 7", "L IX+1", "LBL 0") == [1, 50, 51, 0]


def test_subprograms_call_others_by_name() -> None:
    first = ('LBL "A"', "L IX+1", 'CALL LBL "B"', "LBL 0")
    second = ('LBL "B"', "L IX+10", "LBL 0")
    assert xs('CALL LBL "A"', "L IX+0.5 M30", *first, *second) == [1, 11, 11.5]


def test_lines_run_twice_are_reported_once() -> None:
    made = runs(START, "LBL 1", "L IX+5 M77", "CALL LBL 1 REP 9")
    assert codes(made) == [("M", 6)]


@pytest.mark.parametrize(
    "blocks",
    [
        ("CALL LBL 3",),
        ("LBL 1", "CALL LBL 1"),
        ("CALL LBL 1", "L X+1 M2", "LBL 1", "CALL LBL 2", "LBL 0", "LBL 2", "CALL LBL 1", "LBL 0"),
    ],
)
def test_missing_labels_and_recursion_stop(blocks: tuple[str, ...]) -> None:
    made = runs(START, *blocks)
    assert [code for code, _ in codes(made)] == ["LABEL"]


def test_an_endless_loop_is_given_up() -> None:
    made = runs(START, "LBL 1", "FN 9: IF +1 EQU +1 GOTO LBL 1")
    assert made.findings[0].code == "LIMIT"


def test_parameters_in_words() -> None:
    assert xs("Q1 = 5 + 2", "L X+Q1", "L X-Q1", "FN 4: Q2 = +Q1 DIV +2", "LX+Q2 FQ1") == [7, -7, 3.5]
    assert xs("QL3 = 4", "L XQL3", "FN 5: Q4 = +16", "L IX+Q4") == [4, 8]


def test_a_loop_on_a_condition() -> None:
    loop = ("LBL 1", "L X+Q1", "Q1 = Q1 + 1", "FN 12: IF +Q1 LT +4 GOTO LBL 1", "L X+9")
    assert xs("Q1 = 1", *loop) == [1, 2, 3, 9]


@pytest.mark.parametrize(("test", "jumps"), [("EQU +1", True), ("NE +1", False), ("GT +0", True), ("LT +1", False)])
def test_conditions(test: str, jumps: bool) -> None:
    number = {"E": 9, "N": 10, "G": 11, "L": 12}[test[0]]
    moves = xs(f"FN {number}: IF +1 {test} GOTO LBL 5", "L X+7", "LBL 5", "L X+8")
    assert moves == ([8] if jumps else [7, 8])


def test_the_tool_radius_is_a_parameter() -> None:
    assert xs("L X+Q108") == [5]


@pytest.mark.parametrize("block", ["L X+Q9", "Q1 = 1 / 0", "Q1", "FN 9: IF +Q9 EQU +1 GOTO LBL 1"])
def test_parameters_without_a_value_stop(block: str) -> None:
    assert codes(runs(START, block)) == [("Q", 5)]
