from __future__ import annotations

from dataclasses import replace

import pytest

from app.documents.files import load
from app.documents.programs import empty_program, example
from app.session.block_findings import EntryKind, block_findings
from core.finding import Finding, Severity
from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.units import Unit


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
