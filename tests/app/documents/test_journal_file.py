"""Journals that are moved aside while they are written, and who may read them."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from app.documents.journal_file import JournalFile, asides, journal_path, place_of, set_aside, why_aside
from app.painted.journal import head_record, history_records
from core.program.history import History
from tests.app.documents.test_journal import CURSOR, HEAD, PART, add, begun, read, typed


def test_a_shorter_journal_never_takes_the_place_of_another_ones(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun(path)
    history = add(file, History(PART), typed(2.0))
    long = set_aside(path, "theirs")
    path.write_text("another's")
    file.replace(history_records(HEAD, history, CURSOR))
    assert file.aside is not None
    assert file.aside.read_text() == "another's"
    assert read(path.read_bytes()).history == history
    assert long.exists()


def test_where_a_journal_was_moved_to_tells_its_place_and_why(tmp_path: Path) -> None:
    path = journal_path(tmp_path / "a.b-c.toml")
    path.write_text("x")
    first = set_aside(path, "kept")
    assert (place_of(first), why_aside(first)) == (path, "kept")
    second = set_aside(first, "theirs-2025-03-04-060500-at-12")
    assert (place_of(second), why_aside(second)) == (path, "theirs-2025-03-04-060500-at-12")
    assert (place_of(path), why_aside(path)) == (path, "")
    assert asides(path) == [second]


def test_a_journal_is_as_readable_as_its_program(tmp_path: Path) -> None:
    program = tmp_path / "p.toml"
    program.touch()
    program.chmod(0o664)
    file = JournalFile(journal_path(program), program=program)
    file.add([head_record(HEAD, PART, CURSOR)])
    assert journal_path(program).stat().st_mode & 0o777 == 0o664


class Killed(BaseException):
    """The program ends here, whatever it is doing."""


def test_a_journal_that_begins_with_all_of_the_one_before_is_there_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = begun(tmp_path / "j")
    history = add(file, History(PART), typed(2.0))
    assert file.put_away()

    def half(handle: int, data: bytes) -> None:
        os.write(handle, data[: len(data) // 2])
        raise Killed

    monkeypatch.setattr("app.documents.journal_file.write_all", half)
    with pytest.raises(Killed):
        add(file, history, typed(3.0))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("nameless", [0, None])
def test_where_files_have_their_name_first_it_is_the_same_journal(
    nameless: int | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if nameless is not None:
        monkeypatch.setattr("app.documents.journal_file.NAMELESS", nameless)
    file = begun(tmp_path / "j")
    history = add(file, History(PART), typed(2.0))
    assert read((tmp_path / "j").read_bytes()).history == history
    assert file.standing() == tmp_path / "j"
    assert (tmp_path / "j").stat().st_mode & 0o777 == 0o600


def test_a_full_disk_leaves_no_half_journal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(handle: int, data: bytes) -> None:
        os.write(handle, data[:1])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    file = JournalFile(tmp_path / "j")
    with monkeypatch.context() as patch:
        patch.setattr("app.documents.journal_file.write_all", full)
        with pytest.raises(OSError, match="No space"):
            file.add([head_record(HEAD, PART, CURSOR)])
    assert list(tmp_path.iterdir()) == []
    file.add([])
    assert read((tmp_path / "j").read_bytes()).history == History(PART)


@pytest.mark.skipif(os.getuid() != 0, reason="only root may give a file to a group it is not in")
def test_a_group_that_cannot_be_given_may_do_what_everybody_may(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "p.toml"
    program.touch()
    program.chmod(0o664)
    os.chown(program, -1, 12345)

    def refused(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(os, "fchown", refused)
    file = JournalFile(journal_path(program), program=program)
    file.add([head_record(HEAD, PART, CURSOR)])
    assert journal_path(program).stat().st_mode & 0o777 == 0o644
