"""The programs one begins with: a file, an example part, an empty program."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Final

from core.program.edit import new_block
from core.program.model import Number, Program, Tool
from core.units import Unit

_PROGRAM: Final = re.compile(rb"^\s*format\s*=", re.MULTILINE)


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
        with path.open("rb") as file:
            return _PROGRAM.search(file.read(4096)) is not None
    except OSError:
        return True


def is_nc(path: Path) -> bool:
    """Whether an existing file is none of our own programs, which are TOML with a format."""
    return path.suffix.lower() != ".toml" and path.is_file() and not is_program(path)
