"""Only `app/terminal` uses what is private to Textual: a new version of it can break nothing else."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

APP = Path(__file__).parents[3] / "app"
ELSEWHERE = ("terminal", "cli")
"""The room that may, and the command line, which needs none of Textual."""


def trees() -> Iterator[tuple[Path, ast.Module]]:
    for path in sorted(APP.rglob("*.py")):
        yield path, ast.parse(path.read_text())


def private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__")


def own_names() -> set[str]:
    """Private names that the app defines itself."""
    found: set[str] = set()
    for _, tree in trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                found.add(node.name)
            elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and _is_self(node.value):
                found.add(node.attr)
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                found.add(node.target.id)
    return found


def _is_self(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id == "self"


def test_nothing_private_of_textual_is_used_outside_the_terminal() -> None:
    own, used = own_names(), []
    # os._exit is public, whatever it is called
    for path, tree in trees():
        if path.relative_to(APP).parts[0] in ELSEWHERE:
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and private(node.attr) and node.attr not in {*own, "_exit"}:
                used.append(f"{path.name}:{node.lineno} {node.attr}")
            elif isinstance(node, ast.ImportFrom) and any(map(private, (node.module or "").split("."))):
                used.append(f"{path.name}:{node.lineno} {node.module}")
    assert not used, used
