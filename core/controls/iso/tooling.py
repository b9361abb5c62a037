"""Tools in a program: T words, tool data in the text, tool changes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from core.controls.control_tools import CutterTool, ToolTable, not_there
from core.controls.iso.words import Block, ToolData
from core.finding import Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


_CHANGE: Final = 60


def take(machine: Machine, block: Block) -> None:
    """What a block says of tools."""
    data = block.data
    if data is not None or "T" in block.words:
        number = data.number if data else machine.whole_word(block, "T")
        machine.follower.tool_called(number, block)
        if data is not None:
            _enter(machine, data, block)
        _select(machine, number, block)
    if _CHANGE in block.m:
        machine.tool = machine.next_tool


def _enter(machine: Machine, data: ToolData, block: Block) -> None:
    """Tool data in the text: what is left out stays as it is."""
    old = machine.tools.get(data.number) or CutterTool(data.number, 0.0)
    diameter = old.diameter if data.diameter is None else data.diameter
    unit = old.unit if data.diameter is None else machine.unit
    tool = CutterTool(data.number, diameter, old.length if data.length is None else data.length, 0, unit)
    machine.tools = machine.tools.with_tools(ToolTable.of(tool))
    if data.length is None and data.diameter is None:
        text = "This tool data sets neither length nor diameter; both stay as they are."
        machine.log.tell(Severity.INFO, "TOOL", text, block.line, block.column("T"))


def _select(machine: Machine, number: int, block: Block) -> None:
    if number and machine.dialect.table_needed and machine.tools.get(number) is None:
        machine.log.stop("TOOL", not_there(number), block.line, block.column("T"))
    machine.next_tool = number
    if machine.dialect.loads_at_t:
        machine.tool = number
