"""This module adds and reads options that several commands share: the control, the tools, the unit."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.cli.shell import Unusable
from app.documents.files import read_file, why
from app.documents.nc_text import MAX_NC_BYTES
from app.documents.paths import printable_path
from core.controls.control_tools import CutterTool, ToolTable, read_table, table_of, tool_id
from core.controls.program_text import quoted
from core.program.tools import table_faults
from core.units import Kind, Unit, Unreadable, parse


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for the tools and the unit."""
    add_tool_options(parser)
    parser.add_argument("--units", choices=("IN", "MM"), type=str.upper, help="the unit of a program that names none")


def add_tool_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for the tools."""
    parser.add_argument(
        "--tools", type=Path, metavar="TABLE", help="a tool table as LinuxCNC writes it, in the program's unit"
    )
    parser.add_argument(
        "--tool",
        action="append",
        default=[],
        metavar="N=DIAMETER",
        help="a tool's diameter in the program's unit, or with mm or in after it: 1=.5, 2=6mm, 3=1/2; "
        "a Klartext tool by its name: ROUGH_D10=10",
    )


def control_of(text: str) -> str:
    """Return the full name of a control; raise Unusable if there is none of that name."""
    # this loads every control; a drawing needs none
    from core.controls.registry import UnknownControl, resolve

    control = resolve(text)
    if isinstance(control, UnknownControl):
        raise Unusable(f"--control {quoted(text)}: {control.text}")
    return control


def tools_of(options: argparse.Namespace) -> ToolTable:
    """Return the tools that --tools and --tool name; raise Unusable if they cannot be read."""
    table: ToolTable = {}
    if options.tools is not None:
        table, findings = read_table(bytes_of(options.tools))
        if findings:
            raise Unusable(table_faults(printable_path(options.tools), findings))
    named = [_tool(text) for text in options.tool]
    numbers = [tool.number for tool in named]
    twice = next((number for number in numbers if numbers.count(number) > 1), None)
    if twice is not None:
        raise Unusable(f"--tool: tool {twice} has two diameters. Keep one.")
    return {**table, **table_of(*named)}


def _tool(text: str) -> CutterTool:
    """Return the tool in N=DIAMETER or NAME=DIAMETER, the diameter as in a form's field: `1=.5`, `2=6mm`, `3=1/2`."""
    name, _, diameter = text.rpartition("=")
    inches, millimeters = (parse(diameter, Kind.LENGTH, unit) for unit in (Unit.IN, Unit.MM))
    if not name.strip() or isinstance(inches, Unreadable) or isinstance(millimeters, Unreadable):
        reason = f" {inches.reason}" if isinstance(inches, Unreadable) and diameter.strip() else ""
        raise Unusable(f"--tool {quoted(text)}: write a tool and a diameter, as in 1=.5, 2=6mm or 3=1/2.{reason}")
    tool = tool_id(name.strip())
    if inches == millimeters:
        # no unit is written, so the program's applies
        return CutterTool(tool, inches)
    metric = "mm" in diameter.lower()
    return CutterTool(tool, millimeters if metric else inches, unit=Unit.MM if metric else Unit.IN)


def bytes_of(path: Path) -> bytes:
    """Return the bytes of a file; raise Unusable if it cannot be read."""
    try:
        return read_file(path, MAX_NC_BYTES)[0]
    except (OSError, ValueError) as error:
        raise Unusable(f"{printable_path(path)}: {why(error)}") from error
