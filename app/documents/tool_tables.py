"""This module reads LinuxCNC tool tables from files and merges them into a program's own table."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Final

from app.documents.files import TooLargeError, read_file, why
from core.program.file.read import StoreError
from core.program.model import Number, Program, Tool
from core.program.tools import ImportedTools, decode_table, read_tool_table
from core.units import Kind, Unit, plain, show

MAX_TABLE_BYTES: Final = 1_000_000
"""The size of the largest tool table in bytes."""


def read_table(path: Path, unit: Unit, program: Unit) -> ImportedTools:
    """Return the tools in a table's file; raise StoreError if it cannot be read."""
    try:
        data, _ = read_file(path, MAX_TABLE_BYTES)
    except TooLargeError as error:
        raise StoreError(f"{path} is too large for a tool table.") from error
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
    return read_tool_table(decode_table(data), unit, program)


def merged(program: Program, tools: Iterable[Tool]) -> Program:
    """Return the program with these tools in its table; they replace tools of the same number."""
    table = {tool.number: tool for tool in (*program.tools, *tools)}
    return replace(program, tools=tuple(table[number] for number in sorted(table)))


def tool_line(tool: Tool, unit: Unit) -> str:
    """Return a tool as one line of the table."""
    size = show(tool.diameter.value, Kind.LENGTH, unit) if isinstance(tool.diameter, Number) else "no diameter"
    return f"T{tool.number:<5} {size:>11} {unit}  {plain(tool.type)}"
