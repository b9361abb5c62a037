"""A SAFE Z that is set aside is said on the screen, with what takes its place."""

from dataclasses import replace

import pytest

from core.finding import Severity
from core.pipeline.outline import outline
from core.program.model import CutterComp, Entry, Parameters, PartSetup, Unread
from core.units import sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, block, program


def told(safe, *, z_start=0.0, retract=None):
    one = replace(block(MID_SIDE_SQUARE, CutterComp.LEFT), z_start=Entry(z_start))
    part = replace(program(one), setup=PartSetup(safe_z=safe), parameters=Parameters(retract_clearance=retract))
    (found,) = outline(part).blocks
    return [(one.severity, one.field, sentence(one, part.unit)) for one in found.findings if one.code == "SAFE_Z"]


@pytest.mark.parametrize("safe", [Entry(-1.0), Entry(0.0999)])
def test_a_safe_z_in_the_part_or_below_the_clearance_is_a_warning(safe):
    ((severity, field, text),) = told(safe)
    assert (severity, field) == (Severity.WARNING, "safe_z")
    assert text.startswith(f"SAFE Z {safe.value:.4f} is below Z 0.1000, RETRACT CLEARANCE 0.1000 over Z START 0.0000:")
    assert "0.1000 instead" in text


def test_the_usual_safe_z_is_told_when_z_start_is_above_it():
    ((severity, _, text),) = told(None, z_start=2.0)
    assert severity is Severity.INFO
    assert text.startswith("SAFE Z 1.0000 is below Z 2.1000")


@pytest.mark.parametrize("safe", [None, Entry(0.1), Unread("x", "no number"), Entry(1e300)])
def test_nothing_is_told_of_one_that_is_high_enough_or_refused(safe):
    assert told(safe) == []


def test_nothing_is_told_where_the_clearance_is_refused():
    assert told(Entry(-1.0), retract=Unread("x", "no number")) == []
