"""A program in another unit: every typed length and feed converted, everything else as it was."""

from __future__ import annotations

from dataclasses import replace

from core.program.fields import PARAMETERS, SETUP, START, TABLES, TOOL, Field, form_of
from core.program.model import Block, Entry, Part, Program, changed
from core.units import Kind, Unit, convert


def converted(program: Program, unit: Unit) -> Program:
    """The program with all its lengths and feeds in `unit`; blanks stay blank and take that unit's defaults."""
    if program.unit is unit:
        return program
    old = program.unit
    return replace(
        program,
        unit=unit,
        parameters=_each(program.parameters, PARAMETERS, old, unit),
        setup=_each(program.setup, SETUP, old, unit),
        tools=tuple(_each(tool, TOOL, old, unit) for tool in program.tools),
        blocks=tuple(_block(block, old, unit) for block in program.blocks),
    )


def _block(block: Block, old: Unit, new: Unit) -> Block:
    segments = tuple(_each(segment, TABLES[form_of(segment)], old, new) for segment in block.segments)
    return replace(_each(block, START, old, new), segments=segments)


def _each(part: Part, table: tuple[Field, ...], old: Unit, new: Unit) -> Part:
    """A copy with the table's lengths and feeds converted."""
    measures = (one.name for one in table if one.kind in (Kind.LENGTH, Kind.FEED))
    typed = {name: getattr(part, name) for name in measures}
    entries = {name: entry for name, entry in typed.items() if isinstance(entry, Entry)}
    return changed(part, {name: Entry(convert(entry.value, old, new)) for name, entry in entries.items()})
