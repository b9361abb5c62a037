"""The verdict's lines: a finding begins with what it weighs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.widgets.rows import text_of
from app.widgets.verdict import verdict_rows
from core.finding import Finding, Severity
from core.pipeline.outline import outline
from core.units import Unit
from tests.app.squares import square


@pytest.mark.parametrize(("weight", "mark"), [("error", "!!"), ("warning", "! "), ("info", "i ")])
def test_error_warning_and_information_have_marks_of_their_own(weight: str, mark: str) -> None:
    one = Finding("ANY", Severity(weight), "Told.")
    found = replace(outline(square().session.program).blocks[0], findings=(one,))
    told = [text_of(row) for row in verdict_rows(found, None, Unit.IN, None)]
    assert f" {mark} Told." in told
