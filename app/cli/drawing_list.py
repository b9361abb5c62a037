"""This module reads a drawing for `cutcomp import` in a process of its own; it loads no control and no solver."""

from __future__ import annotations

import argparse
from dataclasses import replace

from core.importing import contours
from core.importing.contours import ContourList, ImportOptions
from core.importing.drawing import Drawing, DrawingError, DrawingUnit, StageProgress
from core.importing.dxf import read_dxf
from core.importing.listing import unit_question
from core.units import from_mm, to_mm


def list_drawing(data: bytes, options: argparse.Namespace, *, progress: StageProgress) -> ContourList:
    """Return the drawing and its contours; raise DrawingError UNITS or OPTION if the arguments do not fit them."""
    drawing = read_dxf(data, options.file.name, damaged=options.damaged, progress=progress)
    asked = DrawingUnit(options.units.upper()) if options.units else None
    unit = asked or drawing.unit
    if unit is None:
        raise DrawingError("UNITS", f"{unit_question(drawing)}: add --units in or --units mm.")
    if asked and drawing.unit and asked is not drawing.unit:
        note = f"The file says {drawing.unit}: it is read as {asked}, as --units says."
        drawing = replace(drawing, notes=(*drawing.notes, note))
    return contours.contours_of(drawing, _import_options(options, drawing, unit), progress)


def _import_options(options: argparse.Namespace, drawing: Drawing, unit: DrawingUnit) -> ImportOptions:
    """Return the checked options of the import; raise DrawingError OPTION if one does not fit the drawing."""
    program = unit.program_unit
    most = from_mm(contours.MAX_TOLERANCE[program], program)
    for name, value in (("--tolerance", options.tolerance), ("--fit", options.fit)):
        if value is not None and not 0.0 <= value <= most:
            raise DrawingError("OPTION", f"{name} {value:g}: it must be from 0 to {most:g} {program}.")
    for layer in options.layer:
        if layer not in drawing.layers:
            raise DrawingError("OPTION", f"--layer {layer}: the drawing has {', '.join(drawing.layers) or 'none'}.")
    tolerance = contours.JOIN_TOLERANCE[program] if options.tolerance is None else to_mm(options.tolerance, program)
    fit = to_mm(options.fit, program) if options.fit else contours.FIT_TOLERANCE[program]
    return ImportOptions(unit, tolerance, fit, frozenset(options.layer) or None)
