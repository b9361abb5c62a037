"""No function and no file grows beyond what is read at one look."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]

FILE: Final = 300
"""Lines of a file."""

FUNCTION: Final = 40
"""Lines of a function, its decorators left out."""


def sources() -> list[Path]:
    return sorted(path for room in ("app", "core", "tests") for path in (ROOT / room).rglob("*.py"))


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def long_files(paths: list[Path], most: int) -> list[str]:
    return [name(path) for path in paths if len(path.read_text("utf-8").splitlines()) > most]


def long_functions(paths: list[Path], most: int) -> list[str]:
    found = []
    for path in paths:
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                lines = (node.end_lineno or node.lineno) - node.lineno + 1
                found += [f"{name(path)}: {node.name}, {lines} lines"] if lines > most else []
    return found


def test_no_file_is_longer_than_it_may_be():
    assert long_files(sources(), FILE) == []


def test_no_function_is_longer_than_it_may_be():
    assert long_functions(sources(), FUNCTION) == []


def test_longer_ones_are_seen():
    here = [Path(__file__)]
    assert long_files(here, 10) == ["tests/test_sizes.py"]
    assert [one.split(",")[0] for one in long_functions(here, 6)] == ["tests/test_sizes.py: long_functions"]
