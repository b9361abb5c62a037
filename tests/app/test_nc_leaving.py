"""Leaving with an NC program that is not saved."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.app.test_nc_keeping import ME, TEXT, typist


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "part.nc"
    path.write_bytes(TEXT)
    return path


def test_the_question_before_leaving_names_the_nc_file(file: Path) -> None:
    one = typist(file, ME).press("x", "ctrl+q")
    assert "LEAVE?" in one.part("header")
    assert "part.nc" in one.part("header")
    one.press("escape", "ctrl+s")
    assert not one.page.unsaved


def test_the_question_before_leaving_saves_the_nc_file_too(file: Path) -> None:
    one = typist(file, ME).press("x", "ctrl+q")
    assert "SAVE AND LEAVE" in one.part("softkeys")
    one.press("s")
    assert one.desk.exit
    assert file.read_bytes() == one.page.listing.data


def test_nobody_leaves_where_the_nc_file_was_written_by_somebody_else(file: Path) -> None:
    one = typist(file, ME).press("x", "ctrl+q")
    file.write_bytes(b"G1 X9\n")
    one.press("s")
    assert not one.desk.exit
    assert "THE FILE HAS CHANGED" in one.part("header")
    assert one.press("escape").page.unsaved
    assert file.read_bytes() == b"G1 X9\n"
