"""The shop rules on small Klartext and ISO programs that each break one rule."""

from __future__ import annotations

import pytest

from core.controls.control_run import ControlRun
from core.controls.judging.shop_rules import check_shop_rules
from core.controls.registry import run
from core.finding import Severity
from tests.tool_tables import end_mills

HEAD = "BEGIN PGM P MM\nTOOL DEF 1 L+0 R+5\nTOOL CALL 1 Z F100\n"
APPLY = ("L X-20 Y-30 Z+2 R0 FMAX", "L Z-5", "L Y+0 RL")
CONTOUR = ("L X+40", "L Y-60", "L X-20")
CANCEL = ("L Y-90 R0", "L Z+50 FMAX")


def klartext(*blocks: str) -> ControlRun:
    finished = run((HEAD + "\n".join(blocks) + "\nEND PGM P MM\n").encode(), "klartext")
    assert isinstance(finished, ControlRun)
    assert finished.stopped_at is None, finished.findings
    return finished


def broken(*blocks: str) -> list[tuple[str, int | None]]:
    """The broken rules, without the one that only explains the side."""
    return [(finding.code, finding.line) for finding in check_shop_rules(klartext(*blocks)) if finding.code != "H9"]


def test_a_program_by_the_rules_breaks_no_rule() -> None:
    assert broken(*APPLY, *CONTOUR, *CANCEL) == []


def test_one_depth_move_after_applying_is_tolerated_as_information() -> None:
    blocks = ("L X-20 Y-30 Z+2 R0 FMAX", "L Y+0 RL", "L Z-5", *CONTOUR, *CANCEL)
    (depth,) = [candidate for candidate in check_shop_rules(klartext(*blocks)) if candidate.code != "H9"]
    assert (depth.code, depth.line, depth.severity) == ("H1", 6, Severity.INFO)


def test_depth_in_steps_after_applying_breaks_h1() -> None:
    blocks = ("L X-20 Y-30 Z+2 R0 FMAX", "L Y+0 Z+1 RL", "L Z-5", "L Z-6", *CONTOUR, *CANCEL)
    findings = [finding for finding in check_shop_rules(klartext(*blocks)) if finding.code == "H1"]
    assert [(finding.line, finding.severity) for finding in findings] == [
        (5, Severity.INFO), (6, Severity.WARNING), (7, Severity.WARNING),
    ]  # fmt: skip


def test_a_start_within_a_diameter_of_the_component_breaks_h2() -> None:
    blocks = ("L X-20 Y-9 Z-5 R0 FMAX", "L Y+0 RL", *CONTOUR, *CANCEL)
    assert broken(*blocks) == [("H2", 5)]
    (finding, *_) = [candidate for candidate in check_shop_rules(klartext(*blocks)) if candidate.code == "H2"]
    assert finding.lengths == pytest.approx((9.0, 10.0))


def test_applying_along_the_contour_breaks_h3() -> None:
    assert broken("L X-40 Y+0 Z-5 R0 FMAX", "L X-20 RL", *CONTOUR, *CANCEL) == [("H3", 5)]


def test_a_first_move_of_two_axes_breaks_h3() -> None:
    assert broken(*APPLY, "L X+40 Y+10", "L Y-60", "L X-20", *CANCEL) == [("H3", 7)]


def test_applying_in_two_axes_breaks_h4() -> None:
    blocks = ("L X-30 Y-30 Z-5 R0 FMAX", "L X-20 Y+0 RL", *CONTOUR, *CANCEL)
    assert broken(*blocks) == [("H3", 5), ("H4", 5)]


def test_depth_in_the_contour_breaks_h5() -> None:
    assert broken(*APPLY, "L X+40", "L Z-6", "L Y-60 Z-7", "L X-20", *CANCEL) == [("H5", 8), ("H5", 9)]


def test_depth_while_canceling_breaks_h5() -> None:
    assert broken(*APPLY, *CONTOUR, "L Y-90 Z+50 R0") == [("H5", 10)]


def test_depth_that_waits_for_the_end_of_a_contour_breaks_h5() -> None:
    program = "G21 G90 G17\nG0 X-20. Y-30. Z2.\nG1 Z-5. F99\nG41 D1 Y0\nX40.\nY-60.\nZ9.\nM30\n"
    finished = run(program.encode(), "fanuc:a", end_mills({1: 10.0}))
    assert isinstance(finished, ControlRun)
    assert [finding.line for finding in check_shop_rules(finished) if finding.code == "H5"] == [7]


def test_a_finish_within_a_diameter_of_the_component_breaks_h6() -> None:
    assert broken(*APPLY, "L X+40", "L Y-60", "L X+31", "L Y-90 R0") == [("H6", 9)]


def test_canceling_along_the_last_move_breaks_h7() -> None:
    assert broken(*APPLY, *CONTOUR, "L X-60 R0") == [("H7", 10)]


def test_a_last_move_of_two_axes_breaks_h7() -> None:
    assert broken(*APPLY, "L X+40", "L Y-60", "L X-20 Y-70", "L Y-90 R0") == [("H7", 9)]


def test_canceling_in_two_axes_breaks_h8() -> None:
    assert broken(*APPLY, *CONTOUR, "L X-30 Y-90 R0") == [("H7", 10), ("H8", 10)]


@pytest.mark.parametrize(("side", "words"), [("RL", "climb"), ("RR", "conventional")])
def test_the_side_is_explained(side: str, words: str) -> None:
    blocks = (*APPLY[:2], f"L Y+0 {side}", "L X+40", "L X+40 Y+60", "L Y+90 R0")
    (finding,) = [candidate for candidate in check_shop_rules(klartext(*blocks)) if candidate.code == "H9"]
    assert words in finding.text
    assert finding.lengths == (5.0,)


def test_leads_of_the_control_need_no_square_moves() -> None:
    blocks = ("L X-60 Y-60 Z-5 R0 FMAX", "APPR LCT X-20 Y+0 R5 RL", *CONTOUR, "DEP LCT X-60 Y-90 R5")
    assert broken(*blocks) == []


def test_a_program_without_compensation_breaks_no_rule() -> None:
    assert check_shop_rules(klartext("L X+1 Y+1 R0")) == ()


ISO = "G21 G90 G17 T1 M6\nG0 X-20 Y-30\nG1 Z-5 F100\n{}G1 X-20\nG40 {}\nM2\n"


@pytest.mark.parametrize("control", ["linuxcnc", "nine-series:a"])
@pytest.mark.parametrize(
    ("entry", "leaving", "rules"),
    [
        ("G41 D1 G1 Y0\nX40\nY-60\n", "G1 Y-90", []),
        ("G41 D1 G1 X-10 Y0\nX40\nY-60\n", "G1 Y-90", ["H3", "H4"]),
        ("G41 D1 G1 Y0\nX40\nG1 Z-7\nY-60\n", "G1 X-40 Y-90", ["H5", "H7", "H8"]),
    ],
)
def test_iso_programs_are_checked_by_the_same_rules(control: str, entry: str, leaving: str, rules: list[str]) -> None:
    finished = run(ISO.format(entry, leaving).encode(), control, end_mills({1: 10.0}))
    assert isinstance(finished, ControlRun)
    assert finished.stopped_at is None, finished.findings
    assert sorted({finding.code for finding in check_shop_rules(finished)} - {"H9"}) == rules
