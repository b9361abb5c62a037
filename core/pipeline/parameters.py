"""Gives parameters in force, as typed or the default of `program.fields`, and the stock of each roughing pass."""

from __future__ import annotations

from typing import Final

from core.pipeline.derived import DerivedBlock
from core.program.fields import Form, default_value, field_of
from core.program.model import Number, Program
from core.units import Kind, to_mm

MAX_SIDE_PASSES: Final = 200
"""More passes than this are a typing mistake in MAX OFFSET, POCKET OVERLAP or the tool's diameter."""


def parameter(program: Program, name: str) -> float:
    """Return a number of PROGRAM PARAMETERS or PART SETUP as typed or its default; lengths in millimeters."""
    form, part = (Form.SETUP, program.setup) if hasattr(program.setup, name) else (Form.PARAMETERS, program.parameters)
    typed = getattr(part, name)
    value = typed.value if isinstance(typed, Number) else default_value(name, program.unit)
    assert value is not None
    return to_mm(value, program.unit) if field_of(form, name).kind in (Kind.LENGTH, Kind.FEED) else value


def stocks(block: DerivedBlock, program: Program) -> tuple[float, ...]:
    """Return what each pass before the finish path leaves on the surface, in millimeters, outermost first.

    PROFILE comes in from MAX OFFSET; each pass overlaps the one before by POCKET OVERLAP percent of the cutter's
    diameter.  A finish tool follows a roughing pass that leaves FINISH XY.  If there are more than MAX_SIDE_PASSES, the
    inner ones are left out.
    """
    assert block.solved.tool_diameter is not None
    finishing = block.solved.finish_diameter is not None
    least = parameter(program, "finish_xy") if finishing else 0.0
    widths: list[float] = []
    if block.profile:
        stock = parameter(program, "max_offset")
        step = block.solved.tool_diameter * (1.0 - parameter(program, "pocket_overlap") / 100.0)
        while stock > least + 1e-9 and step > 0.0 and len(widths) <= MAX_SIDE_PASSES:
            widths.append(stock)
            stock -= step
    return (*widths, least) if finishing else tuple(widths)
