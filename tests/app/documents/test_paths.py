"""File names as typed by the operator."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.paths import as_program, is_folder, path_of_text, program_named, with_suffix

LONG = "中" * 100


def test_a_tilde_is_expanded_only_for_an_existing_user() -> None:
    assert path_of_text(" ~ ") == Path.home()
    assert path_of_text("~nobody_at_all/x") == Path("~nobody_at_all/x")


def test_a_suffix_is_added_only_to_a_name_without_one() -> None:
    assert with_suffix(Path("part"), ".nc") == Path("part.nc")
    assert with_suffix(Path("part.tap"), ".nc") == Path("part.tap")
    assert with_suffix(Path("/"), ".nc") == Path("/")
    assert with_suffix(Path(LONG), ".nc") == Path(f"{LONG}.nc")
    assert with_suffix(Path("bracket 1.5"), ".nc") == Path("bracket 1.5.nc")
    assert with_suffix(Path("part.theirs-2026-01-02"), ".nc") == Path("part.theirs-2026-01-02.nc")
    assert not is_folder(Path(LONG))


@pytest.mark.parametrize("name", ["bracket 1.5", "part.nc", "part.", "part"])
def test_every_program_name_ends_in_toml(name: str) -> None:
    assert as_program(Path(name)) == program_named(Path(name)) == Path(f"{name}.toml")
