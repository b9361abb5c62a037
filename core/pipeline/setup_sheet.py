"""Makes a derived program's setup sheet, as text or as a page with a drawing of each block."""

from __future__ import annotations

from dataclasses import replace

from core.output.sheet import Sheet, as_page, as_text, sheet
from core.output.svg import svg
from core.pipeline.derive import remedy_for_gouge
from core.pipeline.derived import Derived
from core.pipeline.jobs import jobs
from core.pipeline.plot import block_scene
from core.pipeline.unit_question import unit_question
from core.units import sentence


def sheet_of(derived: Derived, *, name: str, day: str) -> Sheet:
    """Return the sheet of a program called `name`, printed on `day` (any text)."""
    program = derived.program
    made = sheet(jobs(derived), program.unit, name, program.setup.name, day)
    further = [*(remedy_for_gouge(block, program) for block in derived.blocks), unit_question(derived)]
    texts = tuple(sentence(finding, program.unit) for finding in further if finding is not None)
    return replace(made, errors=(*made.errors, *texts)) if made.errors else replace(made, notes=(*texts, *made.notes))


def sheet_text(derived: Derived, *, name: str, day: str) -> str:
    """Return the sheet as plain text."""
    return as_text(sheet_of(derived, name=name, day=day))


def sheet_page(derived: Derived, *, name: str, day: str) -> str:
    """Return the sheet as an HTML page, with the exact drawing of every block."""
    unit = derived.program.unit
    drawings = [svg(block_scene(block, None, unit), title=f"BLOCK {block.number}") for block in derived.blocks]
    return as_page(sheet_of(derived, name=name, day=day), drawings)
