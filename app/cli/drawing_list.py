"""The work of `cutcomp import` on a drawing, done in a process of its own: it loads no control and no solver."""

from __future__ import annotations

from dataclasses import dataclass, replace

from core.importing.contours import FIT, MAX_TOLERANCE, TOLERANCE, ContourList, ImportOptions, Progress, contours_of
from core.importing.drawing import Drawing, DrawingError, DrawingUnit
from core.importing.dxf import read_dxf
from core.importing.listing import unit_question
from core.units import from_mm, to_mm


@dataclass(frozen=True, slots=True)
class Asked:
    """What the work needs of the arguments; lengths in the program's unit."""

    name: str
    damaged: bool
    unit: DrawingUnit | None
    tolerance: float | None
    fit: float | None
    layers: tuple[str, ...]


def list_drawing(data: bytes, asked: Asked, *, progress: Progress) -> ContourList:
    """The drawing and its contours; DrawingError UNITS or OPTION where the arguments do not fit the drawing."""
    drawing = read_dxf(data, asked.name, damaged=asked.damaged, progress=progress)
    unit = asked.unit or drawing.unit
    if unit is None:
        raise DrawingError("UNITS", f"{unit_question(drawing)}: add --units in or --units mm.")
    if asked.unit and drawing.unit and asked.unit is not drawing.unit:
        note = f"The file says {drawing.unit}: it is read as {asked.unit}, as --units says."
        drawing = replace(drawing, notes=(*drawing.notes, note))
    return contours_of(drawing, _options(asked, drawing, unit), progress)


def _options(asked: Asked, drawing: Drawing, unit: DrawingUnit) -> ImportOptions:
    """The options of the arguments, each checked."""
    program = unit.program_unit
    most = from_mm(MAX_TOLERANCE[program], program)
    for name, value in (("--tolerance", asked.tolerance), ("--fit", asked.fit)):
        if value is not None and not 0.0 <= value <= most:
            raise DrawingError("OPTION", f"{name} {value:g}: it must be from 0 to {most:g} {program}.")
    for layer in asked.layers:
        if layer not in drawing.layers:
            raise DrawingError("OPTION", f"--layer {layer}: the drawing has {', '.join(drawing.layers) or 'none'}.")
    tolerance = TOLERANCE[program] if asked.tolerance is None else to_mm(asked.tolerance, program)
    fit = to_mm(asked.fit, program) if asked.fit else FIT[program]
    return ImportOptions(unit, tolerance, fit, frozenset(asked.layers) or None)
