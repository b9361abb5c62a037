"""What is written in regular expressions means the same to every Python that the program runs on."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Final

import pytest

GROUP_KEPT: Final = re.compile(r"\)(?:[*+?]|\{+[0-9,]*\}+)\+")
"""A group repeated possessively: up to Python 3.11.4 it loses what its inside takes back, and matches wrongly."""


ROOT: Final = Path(__file__).parents[1]


def sources() -> list[Path]:
    return sorted(path for room in ("app", "core") for path in (ROOT / room).rglob("*.py"))


def kept_groups(source: str) -> list[int]:
    """Lines whose texts have such a group."""
    texts = (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Constant))
    return [one.lineno for one in texts if isinstance(one.value, str) and GROUP_KEPT.search(one.value)]


def test_no_group_is_repeated_possessively() -> None:
    found = {path.relative_to(ROOT).as_posix(): kept_groups(path.read_text("utf-8")) for path in sources()}
    assert {path: lines for path, lines in found.items() if lines} == {}


@pytest.mark.parametrize("text", ['r"(?:ab?c)*+"', 'rf"(?:{WORD}\\n)++"', 'r"(a)?+b"', 'rf"(?:a|b){{2,3}}+"'])
def test_one_that_is_would_be_found(text: str) -> None:
    assert kept_groups(f"X = {text}") == [1]


def test_a_sign_may_be() -> None:
    assert kept_groups('X = r"[0-9]++(?:[.][0-9]*+)?"') == []
