"""The programs one begins with: a file, an example part, an empty program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.documents.files import SEARCHED_BYTES, holds_program, read_start
from core.program.edit import new_block
from core.program.model import Number, Program, Tool
from core.units import Unit


def example(name: str) -> Path:
    """The file of an example part."""
    return examples() / f"{name}.toml"


def examples() -> Path:
    """The folder of the example parts."""
    from importlib.resources import files as packaged

    return Path(str(packaged("app").joinpath("examples")))


def empty_program(unit: Unit = Unit.IN) -> Program:
    """What a new program begins with: one block and an end mill."""
    program = Program(unit, tools=(Tool(1, diameter=Number(0.5 if unit is Unit.IN else 12.0)),))
    return replace(program, blocks=(new_block(program),))


def is_program(path: Path) -> bool:
    """Whether a file may be one of our own programs; one that cannot be read may be."""
    try:
        return holds_program(read_start(path, SEARCHED_BYTES))
    except OSError:
        return True


def is_nc(path: Path) -> bool:
    """Whether an existing file is none of our own programs, which are TOML with a format."""
    try:
        return path.suffix.lower() != ".toml" and path.is_file() and not is_program(path)
    except OSError:
        # a name that no file can have
        return False
