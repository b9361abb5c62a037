from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.session.block_findings import EntryKind, block_findings
from core.finding import Finding, Severity
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.program.model import CutterComp, Number, ProgramParameters
from core.units import Unit
from tests.core.pipeline.parts import block as slot
from tests.core.pipeline.parts import program


@pytest.fixture(scope="module")
def pocket() -> DerivedBlock:
    return derive(load(example("pocket"))).block(1)


def test_gouges_come_first_and_uncut_stock_is_sorted_by_area(pocket):
    gouge = Finding("GOUGE", Severity.ERROR, "GOUGE {value} deep.", 3.0, None, (1.0, 2.0), 12.7)
    block = replace(pocket, findings=(*pocket.findings, gouge))
    entries = block_findings(block, None, Unit.IN)
    assert entries[0].title == "GOUGE 0.5000 deep"
    assert (entries[0].where, entries[0].segment, entries[0].at) == ("segment 3", 3, (1.0, 2.0))
    kinds = [entry.kind for entry in entries]
    assert kinds == sorted(kinds)
    areas = [entry.area for entry in entries if entry.kind is EntryKind.UNCUT]
    assert len(areas) > 1
    assert areas == sorted(areas, reverse=True)


def test_the_first_finding_of_the_pocket_is_its_largest_uncut_area(pocket):
    first = block_findings(pocket, None, Unit.IN)[0]
    assert (first.title, first.where, first.segment) == ("UNCUT 0.3624 thick", "segment 8-10", 8)
    assert first.at is not None


def test_values_still_to_be_typed_have_their_own_kind():
    entries = block_findings(derive(empty_program()).block(1), None, Unit.IN)
    assert {entry.kind for entry in entries} <= {EntryKind.TO_TYPE, EntryKind.ERROR}
    assert EntryKind.TO_TYPE in {entry.kind for entry in entries}


def test_a_gouge_of_a_blend_arc_is_listed_once_with_its_remedy():
    """A slot 0.6 wide and a blend arc of 0.3: both arcs gouge the far wall."""
    points = ((0.5, 0.0), (1.0, 0.0), (1.0, 0.6), (0.0, 0.6), (0.0, 0.0), (0.5, 0.0))
    blends = ProgramParameters(blend_offset=Number(0.3), blend_overlap=Number(0.1))
    part = derive(program(slot(points, CutterComp.LEFT), parameters=blends)).block(1)
    codes = [finding.code for finding in part.findings]
    assert (codes.count("GOUGE"), codes.count("BLEND_GOUGES")) == (2, 2), "scripts read both"
    first, second, *rest = block_findings(part, None, Unit.IN)
    assert not [entry for entry in rest if entry.kind is EntryKind.GOUGE]
    advice = "Start elsewhere or reduce BLEND OFFSET with F4: the largest that fits here is 0.1000."
    assert first.text == f"GOUGE 0.2000 deep in segment 3 at X 0.2000 Y 0.6000, by the blend-in arc. {advice}"
    assert second.text == f"GOUGE 0.2000 deep in segment 3 at X 0.9000 Y 0.6000, by the blend-out arc. {advice}"
    assert {first.field, second.field} == {"blend_offset"}
