"""Work of others, and work that was set aside: it is told, kept, and offered to whoever typed it."""

from __future__ import annotations

import errno
import os
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.documents.files import load, save
from app.documents.journal import Kind
from app.documents.journal_file import journal_path, set_aside
from app.documents.left_overs import KeptCopy, file_of_copy, kept_copies, never_saved
from app.documents.programs import example
from app.documents.questions import Ask
from app.documents.service import Opened, Trouble
from tests.app.documents.typist import (
    ALIVE,
    BOB,
    DEAD,
    ELSEWHERE,
    TIME,
    Typist,
    names,
    number_in,
    service,
    started,
    words,
)


def journals(file: Path) -> list[str]:
    return [name for name in names(file) if "journal" in name]


def hide(monkeypatch: pytest.MonkeyPatch, hidden: Path) -> None:
    """Make one file one that we may not read, whatever it is called later."""
    inode, real = hidden.stat().st_ino, os.open

    def opened(path: str | Path, flags: int, *rest: int, **options: int) -> int:
        if isinstance(path, Path) and path.exists() and path.stat().st_ino == inode:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
        return real(path, flags, *rest, **options)

    monkeypatch.setattr(os, "open", opened)


def test_the_journal_may_be_read_by_whoever_may_read_the_document(own: Path, file: Path) -> None:
    for mode in (0o660, 0o644, 0o600):
        file.chmod(mode)
        operator = started(own, file).type(7)
        assert journal_path(file).stat().st_mode & 0o777 == mode
        operator.left()


def test_work_of_another_is_offered_and_stays_kept_for_its_owner(own: Path, file: Path) -> None:
    first = started(own, file).type(7, 3)
    first.killed()
    bob = started(own, file, BOB)
    assert f"{file.name} by ann on" in bob.asked
    assert "It stays kept for ann, whatever you answer." in bob.asked
    assert "DISCARD" not in bob.asked
    bob.answer("LEAVE IT")
    assert bob.said == f"Kept for ann: .{file.name}.cutcomp-journal.kept-1; Ctrl+O lists it."
    bob.type(9).save().left()
    again = started(own, file)
    assert "The file was written since" in again.asked
    assert again.answer("RESTORE").work == first.work


def test_work_of_another_that_was_restored_and_given_up_is_still_its_owners(own: Path, file: Path) -> None:
    first = started(own, file).type(7)
    first.killed()
    started(own, file, BOB).answer("RESTORE").left()
    assert started(own, file).answer("RESTORE").work == first.work


def test_work_of_another_that_was_restored_and_saved_is_not_asked_about(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    started(own, file, BOB).answer("RESTORE").save().left()
    assert started(own, file).offer is None
    assert journals(file) == []


def test_what_is_kept_for_another_is_told_and_not_asked(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    started(own, file, BOB).answer("LEAVE IT").left()
    bob = started(own, file, BOB)
    assert bob.offer is None
    kept = f".{file.name}.cutcomp-journal.kept-1"
    assert bob.said == f"Unsaved work of ann, 06:05 today, is kept in {kept}; Ctrl+O lists it."


def test_work_that_may_not_be_read_is_told_and_never_lost(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(own, file).type(7)
    first.killed()
    with monkeypatch.context() as patch:
        hide(patch, journal_path(file))
        patch.setattr(os, "getuid", lambda: 4242)
        bob = started(own, file, BOB)
        assert f"has unsaved work on {file.name}, " in bob.asked
        assert "You may not read it." in bob.asked
        assert f".{file.name}.cutcomp-journal." in bob.asked
        bob.answer("CONTINUE").type(9)
        assert "cutcomp-journal.kept-1 holds what was left before" in bob.said
        bob.save().left()
        assert "cutcomp-journal.kept-1" in started(own, file, BOB).said
    again = started(own, file)
    assert again.answer("RESTORE").work == first.work


def test_a_damaged_beginning_is_told_with_the_files_name_and_kept(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    journal = journal_path(file)
    data = b"?" + journal.read_bytes()[1:]
    journal.write_bytes(data)
    operator = started(own, file)
    assert f"UNSAVED WORK IS DAMAGED Unsaved work on {file.name}, " in operator.asked
    assert f"The file is {journal.name}." in operator.asked
    operator.answer("CONTINUE").type(9)
    assert "journal.kept-1" in operator.said
    operator.save().left()
    again = started(own, file)
    assert "journal.kept-1" in again.asked
    assert "journal.discarded-1" in again.answer("DISCARD").said
    assert [file.with_name(name).read_bytes() for name in journals(file)] == [data]
    again.left()
    assert started(own, file).offer is None


def test_damage_in_the_middle_is_told_and_the_whole_journal_kept(own: Path, file: Path) -> None:
    started(own, file).type(7, 3).killed()
    journal = journal_path(file)
    lines = journal.read_bytes().splitlines(keepends=True)
    damaged = b"".join([*lines[:2], b"?" + lines[2][1:], lines[2]])
    journal.write_bytes(damaged)
    operator = started(own, file)
    assert "The end of it cannot be read and is kept as a backup." in operator.asked
    assert operator.answer("RESTORE").number == 7
    assert "journal.damaged-1 stays; Ctrl+O lists it." in operator.said
    assert journal.with_name(f"{journal.name}.damaged-1").read_bytes() == damaged
    operator.type(8).killed()
    assert started(own, file).answer("RESTORE").number == 8


@pytest.mark.parametrize("cut", [1, 7, 40])
def test_a_torn_end_costs_the_last_edit_only(own: Path, file: Path, cut: int) -> None:
    started(own, file).type(7, 3).killed()
    path = journal_path(file)
    path.write_bytes(path.read_bytes()[:-cut])
    assert started(own, file).answer("RESTORE").number == 7


@pytest.mark.parametrize("left", [b"somebody's own", b"\xff" * 99, b"00000000 {}\n"])
def test_what_is_no_journal_is_told_and_not_lost(own: Path, file: Path, left: bytes) -> None:
    journal_path(file).write_bytes(left)
    operator = started(own, file).answer("CONTINUE").type(7).save()
    operator.left()
    assert [file.with_name(name).read_bytes() for name in names(file)] == [left]


def test_a_journal_of_no_bytes_is_nothing(own: Path, file: Path) -> None:
    journal_path(file).touch()
    operator = started(own, file)
    assert operator.offer is None
    operator.type(9).save().left()
    assert names(file) == []


def typed_on(own: Path, file: Path, answer: str) -> None:
    """One login, two programs: the second takes over and answers, the first one types on and dies."""
    first = started(own, file, ALIVE).type(7)
    second = started(own, file, DEAD).answer("TAKE OVER")
    assert "The other terminal may still be in use" in second.asked
    second.answer(answer)
    first.type(125)
    first.killed()
    assert b"125" in b"".join(one.read_bytes() for one in file.parent.glob(".part*theirs*"))
    second.type(8).save().left()


def dead(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.documents.left_overs.alive", lambda _: False)
    monkeypatch.setattr("app.documents.service.alive", lambda _: False)


@pytest.mark.parametrize("answer", ["RESTORE", "DISCARD"])
def test_what_was_typed_on_after_a_take_over_is_offered(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    typed_on(own, file, answer)
    dead(monkeypatch)
    again = started(own, file)
    assert "2 edits." in again.asked
    assert again.answer("RESTORE").number == 125


@pytest.mark.parametrize("answer", ["RESTORE", "DISCARD"])
def test_nothing_typed_on_after_a_take_over_is_nothing_to_offer(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    first = started(own, file, ALIVE).type(7)
    started(own, file, DEAD).answer("TAKE OVER").answer(answer).type(8).save().left()
    first.killed()
    dead(monkeypatch)
    assert started(own, file).offer is None


def test_left_in_order_after_a_take_over_nothing_stays(own: Path, file: Path) -> None:
    first = started(own, file, ALIVE).type(7)
    second = started(own, file, DEAD).answer("TAKE OVER").answer("RESTORE")
    first.type(6).left()
    second.left()
    assert journals(file) == []


def test_a_document_of_another_host_that_was_taken_over_is_offered_to_its_user(own: Path, file: Path) -> None:
    """It may be alive; its user is asked as soon as it is his again."""
    started(own, file, ELSEWHERE).type(7)
    started(own, file, DEAD).answer("TAKE OVER").answer("RESTORE").type(8).save().left()
    assert journals(file) == [f".{file.name}.cutcomp-journal.kept-1"]


def full(folder: Path, monkeypatch: pytest.MonkeyPatch, error: int = errno.ENOSPC) -> None:
    """From now on the disk of this folder takes nothing; others do."""
    real = os.write
    folder = folder.resolve()

    def write(handle: int, data: bytes) -> int:
        if Path(f"/proc/self/fd/{handle}").readlink().parent == folder:
            raise OSError(error, os.strerror(error))
        return real(handle, data)

    monkeypatch.setattr(os, "write", write)


@pytest.mark.parametrize("error", [errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO])
@pytest.mark.parametrize("before", [(), (7,)])
def test_where_the_folder_takes_nothing_the_work_is_kept_elsewhere(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch, error: int, before: tuple[float, ...]
) -> None:
    """From the first edit on, or from a later one."""
    with monkeypatch.context() as patch:
        first = started(own, file).type(*before)
        full(file.parent, patch, error)
        first.type(8)
        assert f"The folder of {file.name} takes nothing: unsaved work is kept in {own}" in first.said
        first.type(125)
        first.killed()
        assert journals(file) == []
    again = started(own, file)
    assert again.answer("RESTORE").work == first.work
    again.save().left()
    assert list(own.iterdir()) == []
    assert names(file) == []


def test_a_folder_in_which_nothing_may_be_renamed_has_the_next_work_elsewhere(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(own, file).type(7)
    first.killed()
    real = Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.parent == file.parent:
            raise PermissionError(errno.EPERM, "sticky")
        return real(path, target)

    monkeypatch.setattr(Path, "rename", rename)
    bob = started(own, file, BOB).answer("LEAVE IT")
    bob.type(9).killed()
    assert len(list(own.iterdir())) == 1
    assert started(own, file).answer("RESTORE").work == first.work


# ---- files that cannot be read, or are gone


def test_the_work_on_a_file_that_is_cut_off_comes_back_and_what_stands_in_it_is_kept(own: Path, part: Path) -> None:
    started(own, part).type(7).killed()
    part.write_bytes(part.read_bytes()[:100])
    operator = started(own, part)
    assert "part.toml itself cannot be read; it stays as it is." in operator.asked
    assert operator.answer("RESTORE").number == 7
    rest = part.read_bytes()
    operator.save(None, "YOURS")
    assert number_in(part) == 7
    assert [one.read_bytes() for one in part.parent.glob("part.theirs-*")] == [rest]


def test_discarded_a_file_that_is_cut_off_stays_until_somebody_decides(own: Path, part: Path) -> None:
    started(own, part).type(7).killed()
    part.write_bytes(part.read_bytes()[:100])
    rest = part.read_bytes()
    operator = started(own, part).answer("DISCARD").type(3)
    ask = operator.try_to_save()
    assert isinstance(ask, Ask)
    assert "part.toml cannot be read. It was written" in words(ask)
    operator.save(None, "FILE AS IT IS")
    assert part.read_bytes() == rest
    assert operator.document.file.path.name.startswith("part.mine-")


def test_without_work_the_fault_of_the_file_is_told(own: Path, part: Path) -> None:
    part.write_bytes(b"no program")
    opened = service(own).open(part)
    assert isinstance(opened, Trouble)
    assert "line 1" in opened.text


def test_ones_own_work_that_was_moved_aside_comes_back_too(own: Path, part: Path) -> None:
    started(own, part).type(7).killed()
    set_aside(journal_path(part), "kept")
    part.write_bytes(b"no program")
    assert isinstance(service(own, BOB).open(part), Trouble)
    assert started(own, part).answer("RESTORE").number == 7


# ---- kept copies


def copies(own: Path, file: Path) -> list[KeptCopy]:
    return kept_copies(file.parent, own, Kind.CONTOUR if file.suffix == ".toml" else Kind.NC)


def chosen(operator: Typist, own: Path, file: Path) -> Typist:
    """The first of the kept copies, opened from the list."""
    copy = copies(own, file)[0].path
    operator.left()
    path = file_of_copy(copy, file.parent)
    assert path is not None
    return operator.took(opened(operator.service.open(path, kept_copy=copy)))


def opened(found: Opened[Any] | Trouble) -> Opened[Any]:
    assert isinstance(found, Opened), found
    return found


def test_a_discarded_copy_is_listed_and_comes_back(own: Path, file: Path) -> None:
    first = started(own, file).type(7)
    first.killed()
    operator = started(own, file).answer("DISCARD")
    assert copies(own, file)[0].sentence(TIME).startswith(f"Unsaved work on {file.name}, discarded ")
    assert [copy.name for copy in copies(own, file)] == [file.name]
    operator = chosen(operator, own, file)
    assert "LEAVE IT it stays in the list" in operator.asked
    assert operator.answer("RESTORE").work == first.work
    assert operator.document.file.path == file
    operator.save().left()
    assert number_in(file) == 7
    assert journals(file) == [f".{file.name}.cutcomp-journal.discarded-1"]


def test_left_alone_a_copy_stays_and_asks_nothing_more(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    operator = chosen(started(own, file).answer("DISCARD"), own, file).answer("LEAVE IT")
    assert (operator.offer, operator.number) == (None, 1)


def test_restored_from_a_copy_it_is_kept_anew(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    again = chosen(started(own, file).answer("DISCARD"), own, file).answer("RESTORE").type(25)
    again.killed()
    assert started(own, file).answer("RESTORE").work == again.work


def test_work_kept_for_another_can_be_had_too(own: Path, file: Path) -> None:
    first = started(own, file).type(7)
    first.killed()
    bob = chosen(started(own, file, BOB).answer("LEAVE IT"), own, file).answer("RESTORE")
    assert bob.work == first.work
    bob.left()
    assert started(own, file).answer("RESTORE").work == first.work


def test_a_copy_without_a_name_comes_back_in_a_new_program(own: Path, part: Path) -> None:
    first = started(own).type(7)
    first.killed()
    operator = started(own).answer("DISCARD")
    [copy] = kept_copies(part.parent, own, Kind.CONTOUR)
    assert copy.name == "a program without a name"
    assert file_of_copy(copy.path, part.parent) is None
    operator.took(operator.service.copy_without_name(copy.path)).answer("RESTORE")
    assert (operator.work, operator.document.file.path) == (first.work, None)


@pytest.mark.parametrize("letter", ["p", "\u90e8"])
def test_a_copy_whose_name_is_cut_is_listed(own: Path, part: Path, letter: str) -> None:
    file = part.rename(part.with_name(f"{letter * (240 // len(letter.encode()))}.toml"))
    started(own, file).type(7).killed()
    started(own, file).answer("DISCARD").left()
    [copy] = copies(own, file)
    assert file_of_copy(copy.path, file.parent) == file


def test_a_file_that_is_gone_comes_back_from_its_copy(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    operator = started(own, file).answer("DISCARD")
    file.unlink()
    chosen(operator, own, file).answer("RESTORE").save()
    assert number_in(file) == 7


def test_a_copy_of_a_folder_that_has_moved_is_about_the_file_beside_it(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    started(own, file).answer("DISCARD").left()
    moved = file.parent.with_name("moved")
    shutil.move(file.parent, moved)
    os.chdir(moved)
    [copy] = copies(own, moved / file.name)
    assert file_of_copy(copy.path, moved) == moved / file.name


def test_a_name_that_is_cut_in_the_name_of_its_journal_is_found_again(own: Path, part: Path) -> None:
    long = part.rename(part.with_name(f"{'p' * 210}.toml"))
    first = started(own, long).type(7)
    first.killed()
    operator = chosen(started(own, long).answer("DISCARD"), own, long).answer("RESTORE")
    assert operator.document.file.path == long
    assert operator.work == first.work


def test_a_copy_that_cannot_be_read_is_told(own: Path, file: Path) -> None:
    copy = journal_path(file).with_name(f".{file.name}.cutcomp-journal.kept-1")
    copy.write_text("nothing")
    found = opened(service(own).open(file, kept_copy=copy))
    assert found.offer is not None
    assert "is damaged and cannot be read" in words(found.offer.ask)


def test_programs_that_were_never_saved_are_listed(own: Path, part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    started(own, part.with_name("flap.toml")).type(7).killed()
    monkeypatch.setattr(os, "access", lambda *_: False)
    started(own, part.with_name("lid.toml")).type(7).killed()
    assert [path.name for path in never_saved(part.parent, own)] == ["flap.toml", "lid.toml"]


def test_a_journal_of_the_other_kind_is_damaged(own: Path, part: Path) -> None:
    save(load(example("notch")), part.with_name("other.toml"))
    started(own, part).type(7).killed()
    nc = part.with_name("x.nc")
    nc.write_bytes(b"M30\n")
    journal_path(part).rename(journal_path(nc))
    assert "is damaged" in started(own, nc, replace(DEAD, pid=DEAD.pid + 5)).asked
