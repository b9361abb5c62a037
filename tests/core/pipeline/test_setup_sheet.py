"""Setup sheets of whole programs."""

from __future__ import annotations

from app.documents.files import load
from core.pipeline.derive import derive
from core.pipeline.derived import solve_fields
from core.pipeline.setup_sheet import sheet_page, sheet_text
from core.program.edit import new_block
from core.program.model import Program
from tests.core.program.test_examples import EXAMPLES


def test_every_example_has_a_sheet_with_a_drawing_a_block():
    examples = sorted(EXAMPLES.glob("*.toml"))
    assert len(examples) > 3
    for path in examples:
        derived = derive(load(path))
        page = sheet_page(derived, name=path.stem, day="2026-01-02")
        assert page.count("<svg") == len(derived.blocks)
        text = sheet_text(derived, name=path.stem, day="2026-01-02")
        assert ("DO NOT RUN" in text) == any(found.errors for found in derived.blocks)
        for block in derived.blocks:
            assert f"LOOKAHEAD          {block.lookahead.tag} " in text


def test_a_program_that_is_only_begun_is_not_ready():
    program = Program()
    program = Program(blocks=(new_block(program),))
    for derived in (solve_fields(program), derive(program)):
        assert "DO NOT RUN" in sheet_text(derived, name="new", day="")
        assert "DO NOT RUN" in sheet_page(derived, name="new", day="")
