"""A program in another unit: every typed length and feed converted, everything else as it was."""

from __future__ import annotations

from dataclasses import replace

from core.program.entries import unread_reason
from core.program.fields import PARAMETERS, SETUP, START, TABLES, TOOL, Field, default, form_of
from core.program.model import Block, Entry, Part, Program, Unread, changed
from core.units import Kind, Unit, convert


def converted(program: Program, unit: Unit) -> Program:
    """The program with all its lengths and feeds in `unit`.

    A blank parameter stood for the old unit's usual value, which is another one in the new unit: it is written out, so
    that the same part is cut.  One that comes to the new unit's usual value becomes a blank again.
    """
    if program.unit is unit:
        return program
    old = program.unit
    return replace(
        program,
        unit=unit,
        parameters=_usual(program.parameters, PARAMETERS, old, unit),
        setup=_usual(program.setup, SETUP, old, unit),
        tools=tuple(_each(tool, TOOL, old, unit) for tool in program.tools),
        blocks=tuple(_block(block, old, unit) for block in program.blocks),
    )


def _usual(part: Part, table: tuple[Field, ...], old: Unit, new: Unit) -> Part:
    """A copy converted, its blanks written out first and its usual values blank again."""
    there = _each(_pinned(part, table, old), table, old, new)
    usual = ((one.name, default(one.name, new)) for one in table if one.kind is Kind.LENGTH)
    return changed(there, {name: None for name, value in usual if value and getattr(there, name) == Entry(value)})


def _pinned(part: Part, table: tuple[Field, ...], unit: Unit) -> Part:
    """A copy whose blank lengths hold the unit's usual values, but for those that are 0 in every unit."""
    blank = (one.name for one in table if one.kind is Kind.LENGTH and getattr(part, one.name) is None)
    usual = ((name, default(name, unit)) for name in blank)
    return changed(part, {name: Entry(value) for name, value in usual if value})


def _block(block: Block, old: Unit, new: Unit) -> Block:
    segments = tuple(_each(segment, TABLES[form_of(segment)], old, new) for segment in block.segments)
    return replace(_each(block, START, old, new), segments=segments)


def _each(part: Part, table: tuple[Field, ...], old: Unit, new: Unit) -> Part:
    """A copy with the lengths and feeds converted; text stays, and what is against it is said in the new unit."""
    typed = [(one, getattr(part, one.name)) for one in table if one.kind in (Kind.LENGTH, Kind.FEED)]
    entries = {one.name: Entry(convert(held.value, old, new)) for one, held in typed if isinstance(held, Entry)}
    texts = {one.name: _again(held, one, new) for one, held in typed if isinstance(held, Unread)}
    return changed(part, {**entries, **texts})


def _again(text: Unread, one: Field, unit: Unit) -> Unread:
    return replace(text, reason=unread_reason(text.text, one, unit))
