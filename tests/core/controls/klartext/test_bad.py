"""Bad programs: each file says in its first line which rule stops it, and where."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from core.controls.control_tools import ToolTable
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
    made = run_klartext(text, ToolTable())
    (stop,) = [finding for finding in made.findings if finding.severity is Severity.ERROR]
    assert (stop.code, stop.line, stop.column) == (wanted[1], int(wanted[2]), int(wanted[3]))
    assert made.stopped_at == stop.line
    assert stop.text.endswith(".")


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
