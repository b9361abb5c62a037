"""This module finds the programs to begin with: files, example parts, an empty program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.files import holds_program, read_start
from core.program.edit import new_block
from core.program.model import Number, Program, Tool
from core.units import Unit


def example(name: str) -> Path:
    """Return the file of an example part."""
    return examples() / f"{name}.toml"


def examples() -> Path:
    """Return the folder of the example parts."""
    return Path(__file__).parents[1] / "examples"


def empty_program(unit: Unit = Unit.IN) -> Program:
    """Return a new program: one block and an end mill."""
    program = Program(unit, tools=(Tool(1, diameter=Number(0.5 if unit is Unit.IN else 12.0)),))
    return replace(program, blocks=(new_block(program),))


def is_program(path: Path) -> bool:
    """True if a file may be a contour program; an unreadable file may be one."""
    start = read_start(path)
    return start is None or holds_program(start)


def is_nc(path: Path) -> bool:
    """True if a file exists and is not a contour program, which is TOML with a `format` key."""
    try:
        return path.suffix.lower() != ".toml" and path.is_file() and not is_program(path)
    except OSError:
        # a name that no file can have
        return False
