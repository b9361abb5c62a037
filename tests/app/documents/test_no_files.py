"""Anything else in place of a file is refused at once and named; nothing is read endlessly."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from app.cli.control_options import bytes_of
from app.cli.shell import Unusable
from app.documents.document_service import Opened, Trouble
from app.documents.drawing_files import drawing_bytes
from app.documents.files import load, write_output
from app.documents.journal_file import journal_path
from app.documents.programs import is_nc
from app.documents.settings import Settings, load_settings
from app.documents.tool_tables import read_table
from core.program.file.read import StoreError
from core.units import Unit
from tests.app.documents.things import THINGS, put_something
from tests.app.documents.typist import number_in, service, started, words

pytestmark = pytest.mark.timeout(20)
ENDLESS = {"endless": "too large"}
EVERYTHING = THINGS | ENDLESS


@pytest.fixture(params=EVERYTHING)
def replacement(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_anything_in_place_of_a_program_is_refused_and_named(tmp_path: Path, replacement: str) -> None:
    path = tmp_path / "part.toml"
    put_something(path, replacement)
    with pytest.raises(StoreError, match=EVERYTHING[replacement]):
        load(path)
    opened = service(tmp_path / "own").open(path)
    assert isinstance(opened, Trouble)
    assert EVERYTHING[replacement] in opened.text
    assert not is_nc(path)


def test_anything_in_place_of_an_nc_text_is_refused_and_named(tmp_path: Path, replacement: str) -> None:
    path = tmp_path / "part.nc"
    put_something(path, replacement)
    opened = service(tmp_path / "own").open(path)
    assert isinstance(opened, Trouble)
    assert EVERYTHING[replacement] in opened.text
    with pytest.raises(Unusable, match=EVERYTHING[replacement]):
        bytes_of(path)


def test_anything_in_place_of_a_tool_table_is_refused_and_named(tmp_path: Path, replacement: str) -> None:
    path = tmp_path / "tool.tbl"
    put_something(path, replacement)
    with pytest.raises(StoreError, match=EVERYTHING[replacement]):
        read_table(path, Unit.IN, Unit.IN)


def test_anything_in_place_of_settings_is_ignored_and_named(tmp_path: Path, replacement: str) -> None:
    path = tmp_path / "settings.toml"
    put_something(path, replacement)
    settings, trouble = load_settings(path)
    assert settings == Settings()
    assert EVERYTHING[replacement] in trouble


def test_anything_in_place_of_a_journal_is_set_aside(state: Path, file: Path, replacement: str) -> None:
    """Work continues; the thing in the journal's place is set aside."""
    put_something(journal_path(file), replacement)
    operator = started(state, file)
    assert "UNSAVED WORK IS DAMAGED" in operator.asked
    assert (
        f"there is {THINGS[replacement]}" if replacement in THINGS else "is damaged and cannot be read"
    ) in operator.asked
    operator.answer("CONTINUE").type(7)
    assert "kept-1 holds what was left before" in operator.said
    operator.save().left()
    assert number_in(file) == 7
    assert os.path.lexists(journal_path(file).with_name(f"{journal_path(file).name}.kept-1"))


def test_a_document_opens_with_anything_in_place_of_a_kept_copy(state: Path, file: Path, replacement: str) -> None:
    copy = journal_path(file).with_name(f"{journal_path(file).name}.kept-1")
    put_something(copy, replacement)
    opened = service(state).open(file, kept_copy=copy)
    assert isinstance(opened, Opened)
    assert opened.offer is not None
    asked = words(opened.offer.ask)
    assert "UNSAVED WORK IS DAMAGED" in asked
    assert (f"there is {THINGS[replacement]}" if replacement in THINGS else "is damaged and cannot be read") in asked
    assert f"The file is {copy.name}." in asked


def test_output_is_not_written_to_anything_but_a_file(tmp_path: Path) -> None:
    for replacement in THINGS:
        path = tmp_path / replacement
        put_something(path, replacement)
        with pytest.raises(StoreError, match=THINGS[replacement]):
            write_output(path, "M30\n")


def test_a_link_to_itself_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.toml").symlink_to(tmp_path / "a.toml")
    opened = service(tmp_path / "own").open(tmp_path / "a.toml")
    assert isinstance(opened, Trouble)
    assert "links lead round in a circle" in opened.text


def test_a_pipe_named_like_a_drawing_is_refused_without_waiting(tmp_path: Path) -> None:
    pipe = tmp_path / "part.dxf"
    os.mkfifo(pipe)
    with pytest.raises(StoreError, match="cannot be read: this is a pipe"):
        drawing_bytes(pipe)
