"""Contours that are not determined to their end."""

from __future__ import annotations

from app.documents.files import load
from app.documents.programs import example
from core.pipeline.derive import derive
from core.program.edit import FormPlace, Refused, type_field
from core.program.model import Program


def without_end(number: int, part: str = "pocket") -> Program:
    """An example with both ends of a segment blank; with one of them a LINE keeps the other coordinate."""
    outcome = load(example(part))
    for name in ("x_end", "y_end"):
        edited = type_field(outcome, FormPlace(1, number), name, None)
        assert not isinstance(edited, Refused)
        outcome = edited
    return outcome


def test_an_undetermined_end_is_not_reported_as_open() -> None:
    found = derive(without_end(6)).blocks[0]
    assert not {"OPEN", "NEARLY_CLOSED"} & {one.code for one in found.findings}
