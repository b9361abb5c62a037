"""The file of a journal: every line on disk when `add` returns, full disks, files that vanish or are set aside."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from app.documents.journal import Journal, beginning, continuing
from app.documents.journal import records_between as between
from app.documents.journal_file import (
    JournalFile,
    Record,
    journal_path,
    journals_set_aside,
    new_path,
    original_path,
    reason_set_aside,
    set_aside,
)
from core.program.history import History
from tests.app.documents.test_journal import HEAD, PART, PLACE, STEPS, TIME, EditStep, read, typed


def records_of(history: History) -> Iterator[Record]:
    """The records of a whole history."""
    return beginning(Journal(*HEAD, history, PLACE, TIME))


def records_between(old: History, new: History) -> list[Record]:
    records = between(old, new)
    assert records is not None
    return list(continuing(records, PLACE, TIME))


def first_records() -> list[Record]:
    return list(records_of(History(PART)))


def begun_journal(path: Path) -> JournalFile:
    file = JournalFile(path)
    file.add(first_records())
    return file


def add(file: JournalFile, old: History, step: EditStep) -> History:
    new = step(old)
    records = records_between(old, new)
    file.add(records)
    return new


def test_every_edit_is_in_the_file_when_add_returns(tmp_path: Path) -> None:
    path, history = tmp_path / "j", History(PART)
    file = begun_journal(path)
    for step in STEPS:
        history = add(file, history, step)
        assert read(path.read_bytes()).work == history
    file.remove()
    assert list(tmp_path.iterdir()) == []


def test_an_existing_journal_is_set_aside(tmp_path: Path) -> None:
    path = tmp_path / "j"
    path.write_text("somebody else's")
    begun_journal(path).remove()
    assert [child.read_text() for child in tmp_path.iterdir()] == ["somebody else's"]


def test_remove_leaves_the_journal_of_another_program(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun_journal(path)
    aside = set_aside(path, "taken")
    path.write_text("another's")
    file.remove()
    assert path.read_text() == "another's"
    assert not aside.exists(), "its own is gone, whatever it was called by then"


def test_replacing_a_long_journal_makes_it_shorter(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun_journal(path)
    history = History(PART)
    for number in range(50):
        history = add(file, history, typed(float(number)))
    long = path.stat().st_size
    file.replace(records_of(History(history.program)))
    assert path.stat().st_size < long / 3
    history = add(file, History(history.program), typed(77.0))
    assert read(path.read_bytes()).work == history


def test_edits_made_on_a_full_disk_are_written_once_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A partial write is undone; the next edit writes everything."""
    path = tmp_path / "j"
    file = begun_journal(path)
    history = add(file, History(PART), typed(2.0))
    before = path.read_bytes()
    real = os.write

    def full(handle: int, data: bytes) -> int:
        if len(data) > 4:
            return real(handle, data[:4])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", lambda handle, data: full(handle, data) if len(data) > 10 else full(handle, b""))
        for number in (3.0, 4.0):
            after = typed(number)(history)
            records = records_between(history, after)
            with pytest.raises(OSError, match="No space"):
                file.add(records)
            history = after
            assert path.read_bytes() == before
    history = add(file, history, typed(5.0))
    assert read(path.read_bytes()).work == history


def test_a_full_disk_starts_no_journal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    file = JournalFile(tmp_path / "j")
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        with pytest.raises(OSError, match="No space"):
            file.add(first_records())
    assert list(tmp_path.iterdir()) == []
    history = add(file, History(PART), typed(2.0))
    assert read((tmp_path / "j").read_bytes()).work == history


def test_the_journal_of_a_link_lies_beside_the_linked_file(tmp_path: Path) -> None:
    (tmp_path / "shop").mkdir()
    (tmp_path / "shop" / "part.toml").touch()
    (tmp_path / "link.toml").symlink_to(tmp_path / "shop" / "part.toml")
    assert journal_path(tmp_path / "link.toml") == tmp_path / "shop" / ".part.toml.cutcomp-journal"


def test_a_shorter_journal_never_overwrites_another_programs_journal(tmp_path: Path) -> None:
    path = tmp_path / "j"
    file = begun_journal(path)
    history = add(file, History(PART), typed(2.0))
    long = set_aside(path, "theirs")
    path.write_text("another's")
    file.replace(records_of(history))
    assert file.aside is not None
    assert file.aside.read_text() == "another's"
    assert read(path.read_bytes()).work == history
    assert long.exists()


def test_the_name_of_a_set_aside_journal_gives_its_place_and_reason(tmp_path: Path) -> None:
    path = journal_path(tmp_path / "a.b-c.toml")
    path.write_text("x")
    first = set_aside(path, "kept")
    assert (original_path(first), reason_set_aside(first)) == (path, "kept")
    second = set_aside(first, "theirs-2025-03-04-060500-at-12")
    assert (original_path(second), reason_set_aside(second)) == (path, "theirs-2025-03-04-060500-at-12")
    assert (original_path(path), reason_set_aside(path)) == (path, "")
    new_path(path).write_text("half of one")
    assert list(journals_set_aside(path)) == [second]


def test_a_journal_has_the_permissions_of_its_program(tmp_path: Path) -> None:
    program = tmp_path / "p.toml"
    program.touch()
    program.chmod(0o664)
    file = JournalFile(journal_path(program), program=program)
    file.add(first_records())
    assert journal_path(program).stat().st_mode & 0o777 == 0o664


class Killed(BaseException):
    """The program ends here."""


@pytest.mark.parametrize("again", [False, True])
def test_a_journal_interrupted_at_its_start_is_whole_or_absent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, again: bool
) -> None:
    """This includes replacing a longer journal."""
    path = tmp_path / "j"
    file = begun_journal(path) if again else JournalFile(path)

    def half(handle: int, data: bytes) -> None:
        os.write(handle, data[: len(data) // 2])
        raise Killed

    monkeypatch.setattr("app.documents.journal_file.write_all", half)
    with pytest.raises(Killed):
        file.replace(first_records()) if again else file.add(first_records())
    remaining = [child for child in tmp_path.iterdir() if child != new_path(path)]
    assert remaining == ([path] if again else [])
    if again:
        assert read(path.read_bytes()).work == History(PART)
        monkeypatch.undo()
        begun_journal(tmp_path / "other").replace(first_records())
        file.replace(first_records())
        assert not new_path(path).exists()


def test_a_new_journal_is_private_and_holds_the_edits(tmp_path: Path) -> None:
    file = begun_journal(tmp_path / "j")
    history = add(file, History(PART), typed(2.0))
    assert read((tmp_path / "j").read_bytes()).work == history
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
            file.add(first_records())
    assert list(tmp_path.iterdir()) == []
    file.add([])
    assert read((tmp_path / "j").read_bytes()).work == History(PART)


@pytest.mark.skipif(os.getuid() != 0, reason="only root may give a file to a group it is not in")
def test_a_journal_whose_group_cannot_be_set_gives_it_the_permissions_of_others(
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
    file.add(first_records())
    assert journal_path(program).stat().st_mode & 0o777 == 0o644


# ---- gone while in use


def gone_by_removing(path: Path) -> None:
    path.unlink()


def gone_by_moving(path: Path) -> None:
    shutil.move(path, path.with_name("elsewhere"))


def gone_by_replacing(path: Path) -> None:
    path.with_name("other").write_bytes(b"another's")
    path.with_name("other").replace(path)


def gone_by_emptying(path: Path) -> None:
    os.truncate(path, 0)


def gone_by_writing(path: Path) -> None:
    with path.open("ab") as file:
        file.write(b"x")


def gone_with_its_folder(path: Path) -> None:
    shutil.rmtree(path.parent)


def gone_with_its_folder_moved(path: Path) -> None:
    path.parent.rename(path.parent.with_name("moved"))


GONE = [
    gone_by_removing,
    gone_by_moving,
    gone_by_replacing,
    gone_by_emptying,
    gone_by_writing,
    gone_with_its_folder,
    gone_with_its_folder_moved,
]


@pytest.mark.parametrize("gone", GONE)
def test_a_lost_journal_is_noticed(tmp_path: Path, gone: Callable[[Path], None]) -> None:
    path = tmp_path / "shop" / "j"
    path.parent.mkdir()
    file = begun_journal(path)
    assert not file.lost()
    gone(path)
    assert file.lost()
    file.close()


def test_a_journal_set_aside_by_a_colleague_is_not_lost(tmp_path: Path) -> None:
    file = begun_journal(tmp_path / "j")
    set_aside(tmp_path / "j", "theirs")
    assert not file.lost()


def test_a_journal_begun_meanwhile_by_another_program_is_not_overwritten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "j"

    def begun_by_another(handle: int, data: bytes) -> None:
        os.write(handle, data)
        if not path.exists():
            path.write_text("another's")

    file = JournalFile(path)
    with monkeypatch.context() as patch:
        patch.setattr("app.documents.journal_file.write_all", begun_by_another)
        with pytest.raises(FileExistsError):
            file.add(first_records())
    assert path.read_text() == "another's"
    file.add([])
    assert file.aside is not None
    assert file.aside.read_text() == "another's"
    assert read(path.read_bytes()).work == History(PART)
