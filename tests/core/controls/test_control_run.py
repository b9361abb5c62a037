"""Gathering findings."""

from __future__ import annotations

import pytest

from core.controls.control_run import MAX_ALIKE, MAX_FINDINGS_OF_A_RULE, AlarmError, Log, Spot
from core.units import Unit
from tests.core.controls.hand import run_of


def test_a_rule_is_reported_once_for_a_line() -> None:
    log = Log()
    for line in (4, 4, 3):
        log.warn("A", "Text.", Spot(line))
    assert [finding.line for finding in log.all_findings()] == [3, 4]


def test_a_rule_that_is_broken_everywhere_is_counted() -> None:
    log = Log()
    for line in range(1, MAX_FINDINGS_OF_A_RULE + 51):
        log.warn("A", "Text.", Spot(line))
    findings = log.all_findings()
    assert len(findings) == MAX_FINDINGS_OF_A_RULE + 1
    assert "50 more" in findings[-1].text


def test_information_that_repeats_itself_buries_nothing_else() -> None:
    log = Log()
    for line in range(1, 51):
        log.inform("A", "Skipped.", Spot(line))
    log.inform("A", "Another text.", Spot(60))
    log.warn("A", "A warning.", Spot(61))
    findings = log.all_findings()
    assert [finding.line for finding in findings] == [*range(1, MAX_ALIKE + 2), 60, 61]
    assert findings[MAX_ALIKE].text == f"A: {50 - MAX_ALIKE} more lines like these."


def test_of_information_whose_text_varies_no_more_is_kept_than_of_warnings() -> None:
    log = Log()
    for line in range(1, MAX_FINDINGS_OF_A_RULE + 51):
        log.inform("A", f"Note {line}.", Spot(line))
    log.warn("A", "A warning.", Spot(999))
    findings = log.all_findings()
    assert len(findings) == MAX_FINDINGS_OF_A_RULE + 2
    assert "50 more" in findings[-2].text
    assert log.has("A")
    assert not log.has("B")


def test_an_alarm_stops_at_its_own_line_or_another() -> None:
    with pytest.raises(AlarmError) as caught:
        Log().stop("A", "Text.", Spot(3))
    assert caught.value.line == 3
    with pytest.raises(AlarmError) as caught:
        Log().stop("A", "Text.", Spot(3), stops_at=9)
    assert (caught.value.line, caught.value.finding.line) == (9, 3)


@pytest.mark.parametrize(
    ("control", "text", "unit"),
    [
        ("linuxcnc", "T1 M6\nG20 G90\nG0 X1\nM2\n", Unit.IN),
        ("linuxcnc", "T1 M6\n(G20)\n; G20\nG21\nM2\n", Unit.MM),
        ("linuxcnc", "T1 M6 G 20\nM2\n", Unit.IN),
        ("linuxcnc", "T1 M6\nG0 X1\nM2\n", Unit.MM),
        ("linuxcnc", "T1 M6\nG20.1 G200\nG0 X1\nM2\n", Unit.MM),
        ("linuxcnc", "T1 M6\n#<g20>=1 #<no_g20>=2\nG21\nM2\n", Unit.MM),
        # with a move before it the unit in force at the move counts
        ("linuxcnc", "G0 X1\nT1 M6\nG20\nM2\n", Unit.MM),
        ("rosettacnc:nist", "?\nG20\nG0 X1\nM2\n", Unit.IN),
        ("nine-series:a", "?\nG70\nG0 X1.\nM2\n", Unit.IN),
        ("nine-series:a", "?\nG71\nG0 X1.\nM2\n", Unit.MM),
        ("fanuc:a", "?\nG21\nG0 X1.\nM30\n", Unit.MM),
        ("linuxcnc", "T1 M6\nG70\nG0 X1\nM2\n", Unit.MM),
    ],
)
def test_a_program_that_stops_before_it_names_its_unit_has_the_unit_named_below(control: str, text: str, unit: Unit):
    run = run_of(text, control)
    assert (run.stopped_at, run.unit) == (2 if text.startswith("G0") else 1, unit)


@pytest.mark.parametrize("control", ["linuxcnc", "klartext"])
def test_an_empty_program_is_refused_at_its_first_column(control: str) -> None:
    (finding,) = run_of("\n \n", control).findings
    assert (finding.code, finding.line, finding.column) == ("EMPTY", 1, 1)
