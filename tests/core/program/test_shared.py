"""Fields of PROGRAM PARAMETERS and PART SETUP that cannot be used."""

from dataclasses import replace

import pytest

from core.program.fields import PARAMETERS, SETUP
from core.program.model import Entry, Program, Unread, changed
from core.program.solve.reading import shared_findings
from core.units import Kind, Unit


def told(program):
    return [(one.code, one.field, one.segment, one.text) for one in shared_findings(program)]


def test_blanks_and_usual_values_are_no_trouble():
    assert told(Program()) == []
    part = Program(Unit.MM, parameters=changed(Program().parameters, {"blend_offset": Entry(3.0)}))
    assert told(part) == []


@pytest.mark.parametrize("one", [one for one in PARAMETERS if one.kind is not Kind.CHOICE], ids=lambda one: one.name)
def test_unreadable_text_and_numbers_out_of_range_are_errors_of_their_screen(one):
    parameters = changed(Program().parameters, {one.name: Unread("1..2", "Two points.")})
    text = f"PROGRAM PARAMETERS: {one.label}: 1..2 cannot be read. Two points."
    assert told(Program(parameters=parameters)) == [("UNREADABLE", one.name, None, text)]
    parameters = changed(Program().parameters, {one.name: Entry(-1.0)})
    ((code, field, _, text),) = told(Program(parameters=parameters))
    assert (code, field) == ("OUT_OF_RANGE", one.name)
    assert text.startswith(f"PROGRAM PARAMETERS: {one.label} must be ")


def test_part_setup_too():
    setup = replace(Program().setup, work_offset=Entry(54.5), safe_z=Unread("x", "Why."))
    assert len(SETUP) == 3
    assert told(Program(setup=setup)) == [
        ("OUT_OF_RANGE", "work_offset", None, "PART SETUP: WORK OFFSET must be a whole number from 54 to 59."),
        ("UNREADABLE", "safe_z", None, "PART SETUP: SAFE Z: x cannot be read. Why."),
    ]
