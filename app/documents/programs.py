"""The programs one begins with: a file, an example part, an empty program."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Final

from app.documents.files import read_start
from core.program.edit import new_block
from core.program.model import Number, Program, Tool
from core.units import Unit

_PROGRAM: Final = re.compile(rb"^\s*format\s*=", re.MULTILINE)
SEARCHED_BYTES: Final = 4096
"""Bytes in which a program says that it is one."""


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


def holds_program(data: bytes) -> bool:
    """Whether the content of a file, or its beginning, is that of one of our own programs."""
    return _PROGRAM.search(data[:SEARCHED_BYTES]) is not None


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
