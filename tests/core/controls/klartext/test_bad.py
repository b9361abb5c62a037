"""Bad programs: each file says in its first line which rule stops it, and where."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from core.controls.klartext.control import run_klartext
from core.finding import Severity
from tests.core.controls.klartext.klartext_runs import DATA, runs

FILES = sorted((DATA / "bad" / "klartext").glob("*.h"))
WANTED = re.compile(r"; (\w+) at line (\d+) column (\d+)")


def test_every_rule_of_the_control_has_a_bad_program() -> None:
    assert {f"HE{number}" for number in range(1, 8)} <= {file.stem.partition("-")[0] for file in FILES}


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_finding_names_the_place_where_a_rule_is_broken(file: Path) -> None:
    text = file.read_bytes()
    wanted = WANTED.match(text.decode())
    assert wanted is not None
    made = run_klartext(text, {})
    (stop,) = [finding for finding in made.findings if finding.severity is Severity.ERROR]
    assert (stop.code, stop.line, stop.column) == (wanted[1], int(wanted[2]), int(wanted[3]))
    assert made.stopped_at == stop.line
    assert stop.text.endswith(".")


POLE = "CC X+0 Y+0"
BLOCKS = {
    ("L X+5", "APPR LT X+10 Y+0 LEN0 RL"): "LEAD 6:18 LEN must be above 0.",
    ("L X+5", "APPR LT X+10 Y+0 LEN-5 RL"): "LEAD 6:18 LEN must be above 0.",
    ("L X+5", "APPR LCT X+10 Y+0 R-5 RL"): "LEAD 6:19 The radius of APPR LCT must be above 0.",
    ("L X+5", "APPR CT X+10 Y+0 CCA361 R5 RL"): "LEAD 6:18 CCA must be above 0, up to 360 degrees.",
    ("L X+5", "APPR CT X+10 Y+0 CCA0 R5 RL"): "LEAD 6:18 CCA must be above 0, up to 360 degrees.",
    ("L X+5", "APPR CT X+10 Y+0 R5 RL"): "LEAD 6:1 APPR CT needs CCA.",
    ("L X+5 RL", "L X+20", "DEP LT LEN5 X+9"): "WORD 7:1 DEP LT ends where its lead ends.",
    (POLE, "LP PR+5 IPR+3 PA0"): "TWICE 6:9 PR and IPR are in one block.",
    (POLE, "LP PR+5 PA0 IPA5"): "TWICE 6:13 PA and IPA are in one block.",
    ("L X+5", POLE, "CP PA+90 Z+5 DR+"): "ARC 7:1 A helix needs its angle as IPA.",
    ("L X+5", POLE, "CP IPA-90 Z+5 DR+"): "ARC 7:4 IPA needs the same sign as DR",
    ("CR X+10 Y+0 DR+",): "ARC 5:1 CR needs a radius.",
    ("CR X+10 Y+0 R+0.0 DR+",): "ARC 5:13 An arc cannot have the radius 0.",
    ("CR X+10 Y+0 R+5",): "ARC 5:1 The direction is missing.",
    ("L X+5", "CT X+5 Y+0"): "ARC 6:1 The end point must differ from the start point.",
    ("L X+5", "CT X+9 Y+0"): "ARC 6:1 The end point lies straight ahead or back",
    ("L X+5", "CHF -1", "L X+5 Y+5"): "CORNER 6:1 The size of CHF must be above 0.",
    ("L X+5", "RND", "L X+5 Y+5"): "CORNER 6:1 RND needs its size.",
    ("L X+5", "RND R9", "L X+5 Y+5"): "CORNER 6:1 The rounding is longer than the blocks it joins.",
    ("L X+5", "CHF 6", "L X+5 Y+9"): "CORNER 6:1 The chamfer is longer than the blocks it joins.",
    ("L X+5", "CHF 4", "L X+5 Y+3"): "CORNER 6:1 The chamfer is longer than the blocks it joins.",
    ("L X+5", "RND R1", "L X+9"): "CORNER 6:1 There is no corner to round.",
    ("L X+10", "CHF 1", "CC X+10 Y+2", "C X+12 Y+2 DR+"): "CORNER 6:1 A chamfer needs two straight blocks",
    ("CYCL DEF 7.1",): "WORD 5:1 A datum shift needs an axis and a value.",
    ("TRANS DATUM AXIS",): "WORD 5:1 A datum shift needs an axis and a value.",
    ("TOOL CALL 0 Z", "L X+5 RL", "L X+9"): "TOOL 6:1 Tool radius 0: the center runs on the contour.",
    ("TOOL CALL 2 Z", "L X+5 RL"): "TOOL 6:7 The diameter of tool 2 is unknown.",
    ("CYCL DEF 0",): "WORD 5:1 CYCL needs DEF with a number, or CALL.",
    ("CYCL DEF 12.0 PGM CALL", "CYCL CALL"): "BEYOND 6:1 Cycle 12 runs another file.",
    ("CYCL CALL",): "CYCLE 5:1 No cycle is defined before this call.",
    ("L X+5 RL", "L X+9", "CYCL DEF 200", "CYCL CALL"): "CYCLE 8:1 A cycle under compensation is not supported.",
}


@pytest.mark.parametrize("blocks", BLOCKS)
def test_a_short_program_has_its_finding(blocks: tuple[str, ...]) -> None:
    made = runs("L X+0 Y+0 Z+0 R0 F100", *blocks)
    found = [f"{finding.code} {finding.line}:{finding.column} {finding.text}" for finding in made.findings]
    assert any(text.startswith(BLOCKS[blocks]) for text in found), found


@pytest.mark.parametrize(
    "blocks",
    [
        ("L X+10 ~", "Y+20 F100"),
        ("L X+0 F9 ; SLOWLY ~", "L X+5"),
        ("* - POCKET ~", "L X+5"),
        ("CYCL CALL POS X+10 ~", "Y+70 Z+0 FMAX"),
        ("CYCL DEF 19.1 A+0 ~", "B+30"),
        ("CYCL DEF 7.1 X+10 ~", "Y+10"),
    ],
)
def test_a_block_that_goes_on_in_the_next_line_is_refused_but_for_a_cycle_with_values(blocks: tuple[str, ...]) -> None:
    made = runs("L X+0 Y+0 F9", *blocks)
    assert [(finding.code, finding.line) for finding in made.findings if finding.severity is Severity.ERROR] == [
        ("BEYOND", 5)
    ]


def test_a_comment_alone_continues_nothing() -> None:
    assert runs("L X+0 Y+0 F9", "; SLOWLY ~", "L X+5").moves.points[-1, 0] == 5.0


def test_a_line_too_long_that_continues_a_cycle_is_refused() -> None:
    made = runs("L X+0 Y+0 F9", "CYCL DEF 200 DRILLING ~", "Q200=+2 " + " " * 2000 + "Q201=-3")
    assert [(finding.code, finding.line) for finding in made.findings if finding.severity is Severity.ERROR] == [
        ("WORD", 5)
    ]
