"""Only `app/terminal` uses private members of Textual, so a new version of Textual can break nothing else."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

APP = Path(__file__).parents[3] / "app"
UNCHECKED = ("terminal", "cli")
"""Rooms that are not checked: the one that may use them, and the command line, which does not use Textual."""


def trees() -> Iterator[tuple[Path, ast.Module]]:
    for path in sorted(APP.rglob("*.py")):
        yield path, ast.parse(path.read_text())


def private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__")


def own_names() -> set[str]:
    """The private names that the app itself defines."""
    names: set[str] = set()
    for _, tree in trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                names.add(node.name)
            elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and _is_self(node.value):
                names.add(node.attr)
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                names.add(node.target.id)
    return names


def _is_self(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id == "self"


def test_private_members_of_textual_are_used_only_in_the_terminal_room() -> None:
    app_names, used = own_names(), []
    # os._exit is public despite its name
    for path, tree in trees():
        if path.relative_to(APP).parts[0] in UNCHECKED:
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and private(node.attr) and node.attr not in {*app_names, "_exit"}:
                used.append(f"{path.name}:{node.lineno} {node.attr}")
            elif isinstance(node, ast.ImportFrom) and any(map(private, (node.module or "").split("."))):
                used.append(f"{path.name}:{node.lineno} {node.module}")
    assert not used, used
