"""An offset whose radius is not that of the tool in the spindle is reported, with what the cutter then does."""

from __future__ import annotations

import pytest

from core.finding import Severity
from core.units import Unit, sentence
from tests.core.controls.hand import findings_of, run_of

PASS = "G0 X-20 Y-20\n{side} {offset} G1 X0 Y-10 F200\nY30\nX40\nY0\nX-10\nG40 X-20 Y-20\n"
CONTROLS = ("fanuc:a", "haas:a", "nine-series:a", "linuxcnc", "rosettacnc:normal")


def program(tool: int, offset: str, *, side: str = "G41") -> str:
    return f"G21 G17 G90\nT{tool} M6\n{PASS.format(side=side, offset=offset)}M30\n"


@pytest.mark.parametrize("control", CONTROLS)
def test_the_offset_of_a_smaller_tool_cuts_too_deep(control: str) -> None:
    run = run_of(program(2, "D1"), control, t1=10.0, t2=12.0)
    (said,) = findings_of(run, "OFFSET")
    assert (said.severity, said.line) == (Severity.WARNING, 4)
    assert sentence(said, Unit.MM) == (
        "D1 has the radius 5.000, tool 2 has 6.000: the cutter cuts 1.000 too deep, "
        "unless the program is the tool's center path."
    )


@pytest.mark.parametrize("control", CONTROLS)
def test_the_offset_of_a_larger_tool_leaves_stock(control: str) -> None:
    (said,) = findings_of(run_of(program(2, "D1"), control, t1=10.0, t2=9.0), "OFFSET")
    assert said.severity is Severity.INFO
    assert sentence(said, Unit.MM) == "D1 has the radius 5.000, tool 2 has 4.500: the cutter leaves 0.500 of stock."


@pytest.mark.parametrize("control", CONTROLS)
def test_a_tools_own_offset_and_a_tool_that_is_not_known_are_no_matter(control: str) -> None:
    assert not findings_of(run_of(program(2, "D2"), control, t1=10.0, t2=12.0), "OFFSET")
    if control not in ("linuxcnc", "rosettacnc:normal"):
        assert not findings_of(run_of(program(3, "D1"), control, t1=10.0), "OFFSET")


@pytest.mark.parametrize("control", ["linuxcnc", "rosettacnc:normal"])
def test_a_diameter_in_the_program_is_compared_too(control: str) -> None:
    (said,) = findings_of(run_of(program(1, "D8", side="G41.1"), control, t1=10.0), "OFFSET")
    assert (said.severity, said.lengths) == (Severity.WARNING, (4.0, 5.0))


def test_an_offset_that_the_program_sets_or_changes_is_compared_too() -> None:
    wear = program(5, "D5").replace("T5 M6", "G10 L12 P5 R0.05\nT5 M6")
    (said,) = findings_of(run_of(wear, "fanuc:a", t5=10.0), "OFFSET")
    assert (said.severity, said.value) == (Severity.WARNING, 4.95)
    changed = program(1, "D1").replace("X40\n", "D2 X40\n")
    (said,) = findings_of(run_of(changed, "fanuc:a", t1=10.0, t2=9.0), "OFFSET")
    assert (said.line, said.value) == (6, 0.5)


def test_a_difference_is_reported_once_for_an_offset_and_a_tool() -> None:
    twice = program(2, "D1").replace("M30\n", f"{PASS.format(side='G41', offset='D1')}M30\n")
    assert len(findings_of(run_of(twice, "fanuc:a", t1=10.0, t2=12.0), "OFFSET")) == 1


def test_every_offset_that_a_subprogram_is_called_with_is_reported() -> None:
    """The line of G41 is the same each time; the deepest cut is not the first one."""
    head = "G21 G17 G90\nT1 M6\n"
    calls = "".join(f"G10 L12 P1 R{radius}\nM98 P9\n" for radius in (5.5, 4.9, 0.5, 10.0))
    text = f"O1\n{head}{calls}M30\nO9\n{PASS.format(side='G41', offset='D1')}M99\n"
    said = findings_of(run_of(text, "fanuc:a", t1=10.0), "OFFSET")
    assert [finding.value for finding in said] == pytest.approx([0.5, 0.1, 4.5, 5.0])
    assert [finding.severity is Severity.WARNING for finding in said] == [False, True, True, False]
