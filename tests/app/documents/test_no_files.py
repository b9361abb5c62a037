"""Something else in place of a file is refused at once by what it is, and nobody reads without end."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from app.cli.control_options import bytes_of
from app.cli.shell import Unusable
from app.documents.drawing_files import drawing_bytes
from app.documents.files import load, write_output
from app.documents.journal_file import journal_path
from app.documents.programs import is_nc
from app.documents.service import Opened, Trouble
from app.documents.settings import load_settings
from app.documents.tool_tables import read_table
from core.program.file.read import StoreError
from core.units import Unit
from tests.app.documents.things import THINGS, put_something
from tests.app.documents.typist import number_in, service, started, words

pytestmark = pytest.mark.timeout(20)
ENDLESS = {"endless": "too large"}
EVERYTHING = THINGS | ENDLESS


@pytest.fixture(params=EVERYTHING)
def what(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_in_place_of_a_program(tmp_path: Path, what: str) -> None:
    path = tmp_path / "part.toml"
    put_something(path, what)
    with pytest.raises(StoreError, match=EVERYTHING[what]):
        load(path)
    opened = service(tmp_path / "own").open(path)
    assert isinstance(opened, Trouble)
    assert EVERYTHING[what] in opened.text
    assert not is_nc(path)


def test_in_place_of_an_nc_text(tmp_path: Path, what: str) -> None:
    path = tmp_path / "part.nc"
    put_something(path, what)
    opened = service(tmp_path / "own").open(path)
    assert isinstance(opened, Trouble)
    assert EVERYTHING[what] in opened.text
    with pytest.raises(Unusable, match=EVERYTHING[what]):
        bytes_of(path)


def test_in_place_of_a_tool_table(tmp_path: Path, what: str) -> None:
    path = tmp_path / "tool.tbl"
    put_something(path, what)
    with pytest.raises(StoreError, match=EVERYTHING[what]):
        read_table(path, Unit.IN, Unit.IN)


def test_in_place_of_settings(tmp_path: Path, what: str) -> None:
    path = tmp_path / "settings.toml"
    put_something(path, what)
    settings, trouble = load_settings(path)
    assert settings.recent == ()
    assert EVERYTHING[what] in trouble


def test_in_place_of_a_journal(own: Path, file: Path, what: str) -> None:
    """The work goes on; what stands there is moved aside, and the lists of files stand."""
    put_something(journal_path(file), what)
    operator = started(own, file)
    assert EVERYTHING[what] in operator.asked or what == "endless"
    assert "DAMAGED" in operator.asked or "In place of" in operator.asked
    operator.answer("CONTINUE").type(7)
    assert "kept-1 holds what was left before" in operator.said
    operator.save().left()
    assert number_in(file) == 7
    assert os.path.lexists(journal_path(file).with_name(f"{journal_path(file).name}.kept-1"))


def test_in_place_of_a_kept_copy(own: Path, file: Path, what: str) -> None:
    copy = journal_path(file).with_name(f"{journal_path(file).name}.kept-1")
    put_something(copy, what)
    opened = service(own).open(file, kept_copy=copy)
    assert isinstance(opened, Opened)
    assert opened.offer is None or "UNSAVED WORK" in words(opened.offer.ask)


def test_in_place_of_what_is_written(tmp_path: Path) -> None:
    for what in THINGS:
        path = tmp_path / what
        put_something(path, what)
        with pytest.raises(StoreError, match=THINGS[what]):
            write_output(path, "M30\n")


def test_a_program_behind_a_link_to_itself_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.toml").symlink_to(tmp_path / "a.toml")
    opened = service(tmp_path / "own").open(tmp_path / "a.toml")
    assert isinstance(opened, Trouble)
    assert "links lead round in a circle" in opened.text


def test_a_pipe_that_is_named_like_a_drawing_is_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "part.dxf"
    os.mkfifo(pipe)
    with pytest.raises(StoreError, match="cannot be read: this is a pipe"):
        drawing_bytes(pipe)
