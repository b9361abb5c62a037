"""Every rule of every control has a program that breaks it, and is found on the line where it is broken.

The programs stand in tests/data/bad, a folder for each control and a file for each rule.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from core.finding import Severity
from core.units import Unit
from tests.core.controls.hand import DATA, findings_of, run_of
from tests.core.controls.rs274 import witness
from tests.rs274 import WITNESS

ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO

TOOLS = {"t1": 0.5, "t2": 0.25, "t9": -0.5}

RULES: dict[str, dict[str, tuple[int, int, Severity]]] = {
    "threeblock": {
        "B1-PLANE": (3, 1, ERROR),
        "B2-MODE": (3, 1, ERROR),
        "B3-DIA0": (2, 3, INFO),
        "B4-MAX": (2, 3, ERROR),
        "B5-TOOL": (2, 1, ERROR),
        "B6-APPR": (3, 1, ERROR),
        "B7-MIN5": (5, 1, ERROR),
        "B8-SIDE": (5, 1, ERROR),
        "B9-AMOUNT": (5, 1, ERROR),
        "B10-NOMOVE": (5, 1, ERROR),
        "B11-COLLINEAR": (5, 1, ERROR),
        "B12-ZENDS": (6, 1, ERROR),
        "B12z-ZARC": (6, 1, WARNING),
        "B13-ZSEP": (8, 1, ERROR),
        "B14-MCODE": (5, 4, ERROR),
        "B15-G99": (5, 1, INFO),
        "B16-NARROW": (6, 1, WARNING),
        "B17-STEP": (5, 1, WARNING),
        "B18-SHORT": (4, 1, INFO),
        "B19-TRANGE": (1, 1, ERROR),
        "B20-G40ARC": (6, 3, ERROR),
        "B21-NOG40": (5, 1, ERROR),
        "B22-DECIMAL": (2, 1, WARNING),
    },
    "rosettacnc": {
        "C1": (3, 5, ERROR),
        "C2": (4, 1, ERROR),
        "C3": (2, 1, ERROR),
        "C4": (2, 10, ERROR),
        "C5": (2, 10, ERROR),
        "C6": (5, 1, ERROR),
        "C7": (5, 1, ERROR),
        "C8": (3, 1, ERROR),
    },
    "nine-series": {
        "R1": (3, 1, ERROR),
        "R2": (4, 1, ERROR),
        "R3": (4, 1, WARNING),
        "R4": (2, 1, INFO),
        "R5": (14, 1, WARNING),
        "R6": (4, 1, INFO),
        "R7": (5, 1, WARNING),
        "R8": (4, 1, ERROR),
        "R9": (4, 1, ERROR),
        "R10": (4, 1, ERROR),
        "R11": (2, 1, INFO),
        "R12": (3, 1, INFO),
    },
    "linuxcnc": {
        "N-OFFSETS": (6, 1, ERROR),
        "N-PROBE": (6, 1, ERROR),
        "N-PLANE": (6, 1, ERROR),
        "N-ONWHENON": (6, 1, ERROR),
        "N-HOME": (6, 1, ERROR),
        "N-G53": (6, 1, ERROR),
        "N-XZYZ": (4, 1, ERROR),
        "N-CONCAVE": (7, 1, ERROR),
        "N-GOUGE": (4, 1, ERROR),
        "N-DALONE": (3, 7, ERROR),
        "TWICE": (3, 8, ERROR),
        "N-DNEGATIVE": (3, 5, ERROR),
        "N-DBIG": (3, 5, ERROR),
        "N-ARCRADIUS": (6, 1, ERROR),
        "N-TWOG": (3, 4, ERROR),
        "N-ARCEXIT": (7, 1, ERROR),
        "N-CYCLE": (6, 1, ERROR),
        "N-MODE": (6, 1, ERROR),
        "N-DMISSING": (3, 1, ERROR),
        "N-ORIENTATION": (3, 10, ERROR),
        "N-WORDALONE": (3, 7, ERROR),
    },
}
"""Control, rule: line, column and severity."""

CASES = [(control, rule) for control, rules in RULES.items() for rule in rules]

GOES_ON = {"B21-NOG40"}
"""Errors that are found when nothing is left to stop."""


def program(control: str, rule: str) -> bytes:
    return (DATA / "bad" / control / f"{rule}.nc").read_bytes()


@pytest.mark.parametrize(("control", "rule"), CASES)
def test_the_finding_names_the_place_where_a_rule_is_broken(control: str, rule: str) -> None:
    tools = {"t1": 6.0, "t2": 3.0} if control == "rosettacnc" else TOOLS
    run = run_of(program(control, rule), control, **tools)
    found = findings_of(run, rule)[0]
    assert (found.line, found.column, found.severity) == RULES[control][rule]
    assert (run.stopped_at is not None) == (found.severity is ERROR and rule not in GOES_ON)
    assert len(found.text) > 20
    assert found.text[-1] == "."


@pytest.mark.parametrize("control", RULES)
def test_every_bad_program_is_in_the_table(control: str) -> None:
    assert {file.stem for file in (DATA / "bad" / control).glob("*.nc")} == set(RULES[control])


@pytest.mark.parametrize(
    ("control", "prefix", "last"), [("threeblock", "B", 22), ("rosettacnc", "C", 8), ("nine-series", "R", 12)]
)
def test_no_rule_is_without_a_program(control: str, prefix: str, last: int) -> None:
    heads = {rule.split("-")[0] for rule in RULES[control]}
    assert {f"{prefix}{number}" for number in range(1, last + 1)} <= heads


@pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")
@pytest.mark.parametrize("rule", RULES["linuxcnc"])
def test_linuxcnc_itself_refuses_the_program(rule: str, tmp_path: Path) -> None:
    diameters = {1: 0.5, 2: 0.25, 9: -0.5}
    assert witness(program("linuxcnc", rule).decode(), tmp_path, diameters, Unit.IN).refusal
