"""What blocks share and cannot be used forbids posting each of them."""

from dataclasses import replace

import pytest

from core.pipeline.derive import derive
from core.program.model import CutterComp, Entry, Unread
from tests.core.pipeline.parts import MID_SIDE_SQUARE, block, program


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Entry(-1.0)])
def test_a_program_parameter_that_cannot_be_used_forbids_posting(typed):
    """It would otherwise be posted with the usual value, as if nothing had been typed."""
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    assert before.blocks[0].postable
    after = derive(replace(part, parameters=replace(part.parameters, retract_clearance=typed)))
    assert [finding.field for finding in after.blocks[0].errors] == ["retract_clearance"]


@pytest.mark.parametrize("typed", [Unread("abc", "why"), Entry(1e9)])
def test_a_safe_z_that_cannot_be_used_forbids_posting_and_changes_no_path(typed):
    part = program(block(MID_SIDE_SQUARE, CutterComp.LEFT))
    before = derive(part)
    after = derive(replace(part, setup=replace(part.setup, safe_z=typed)))
    assert "safe_z" in [finding.field for finding in after.blocks[0].errors]
    ours, theirs = (one.blocks[0].work.center.points.tolist() for one in (before, after))
    assert ours == theirs
