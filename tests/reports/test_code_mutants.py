"""Code mutants are what they say, and only where a change could be noticed."""

from __future__ import annotations

from tests.reports.code_mutants import mutants_of

SOURCE = '''"""Docstring."""

LIMIT = 5


def depth(value: int = 3) -> float:
    """Docstring."""
    assert value > 0
    if value < LIMIT and "ä" not in "":
        value += 2
    return -1.5 - value
'''


def changes(kind: str) -> set[str]:
    found = (mutant for mutant in mutants_of("core/a.py", SOURCE) if mutant.kind == kind)
    return {mutant.words(SOURCE).partition(" => ")[2] for mutant in found}


def test_comparisons_are_flipped() -> None:
    assert changes("comparison") == {
        'if value >= LIMIT and "ä" not in "":',
        'if value < LIMIT and "ä" in "":',
    }


def test_statements_of_functions_are_dropped() -> None:
    assert changes("dropped") == {"pass"}
    assert len([one for one in mutants_of("core/a.py", SOURCE) if one.kind == "dropped"]) == 2


def test_signs_are_changed() -> None:
    assert changes("sign") == {"return 1.5 - value", "return -1.5 + value"}


def test_numbers_are_one_off() -> None:
    assert changes("off by one") == {"LIMIT = 6", "def depth(value: int = 4) -> float:", "value += 3"}
