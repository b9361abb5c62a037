"""Work of other people and work that was set aside is reported, kept, and offered to whoever typed it."""

from __future__ import annotations

import errno
import os
import shutil
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest

from app.documents.document_service import Opened, Trouble
from app.documents.files import load, save
from app.documents.journal_file import JOURNAL_SUFFIX, journal_path, lines, set_aside
from app.documents.programs import example
from app.documents.questions import QuestionText
from app.documents.unsaved_work import KeptCopy, file_of_copy, kept_copies, never_saved
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
    """Make a file unreadable for us, whatever its later name is."""
    inode, real = hidden.stat().st_ino, os.open

    def opened(path: str | Path, flags: int, *rest: int, **options: int) -> int:
        if isinstance(path, Path) and path.exists() and path.stat().st_ino == inode:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
        return real(path, flags, *rest, **options)

    monkeypatch.setattr(os, "open", opened)


def test_the_journal_has_the_permissions_of_the_document(state: Path, file: Path) -> None:
    for mode in (0o660, 0o644, 0o600):
        file.chmod(mode)
        operator = started(state, file).type(7)
        assert journal_path(file).stat().st_mode & 0o777 == mode
        operator.left()


def test_work_of_another_user_is_offered_and_kept_for_its_owner(state: Path, file: Path) -> None:
    ann = started(state, file).type(7, 3)
    ann.killed()
    bob = started(state, file, BOB)
    assert f"{file.name} by ann on" in bob.asked
    assert "It stays kept for ann, whatever you answer." in bob.asked
    assert "DISCARD" not in bob.asked
    bob.answer("LEAVE IT")
    assert bob.said == f"Kept for ann: .{file.name}.cutcomp-journal.kept-1; Ctrl+O lists it."
    bob.type(9).save().left()
    again = started(state, file)
    assert "The file was written since" in again.asked
    assert again.answer("RESTORE").work == ann.work


def test_restored_and_abandoned_work_still_belongs_to_its_owner(state: Path, file: Path) -> None:
    first = started(state, file).type(7)
    first.killed()
    started(state, file, BOB).answer("RESTORE").left()
    assert started(state, file).answer("RESTORE").work == first.work


def test_restored_and_saved_work_of_another_user_is_not_offered_again(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    started(state, file, BOB).answer("RESTORE").save().left()
    assert started(state, file).offer is None
    assert journals(file) == []


def test_work_kept_for_another_user_is_mentioned_without_a_question(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    started(state, file, BOB).answer("LEAVE IT").left()
    bob = started(state, file, BOB)
    assert bob.offer is None
    kept = f".{file.name}.cutcomp-journal.kept-1"
    assert bob.said == f"Unsaved work of ann, 06:05 today, is kept in {kept}; Ctrl+O lists it."


def test_unreadable_work_of_another_user_is_reported_and_kept(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(state, file).type(7)
    first.killed()
    with monkeypatch.context() as patch:
        hide(patch, journal_path(file))
        patch.setattr(os, "getuid", lambda: 4242)
        bob = started(state, file, BOB)
        assert f"has unsaved work on {file.name}, " in bob.asked
        assert "You may not read it." in bob.asked
        assert f".{file.name}.cutcomp-journal." in bob.asked
        bob.answer("CONTINUE").type(9)
        assert "cutcomp-journal.kept-1 holds what was left before" in bob.said
        bob.save().left()
        assert "cutcomp-journal.kept-1" in started(state, file, BOB).said
    again = started(state, file)
    assert again.answer("RESTORE").work == first.work


def test_a_journal_with_a_damaged_first_line_is_reported_by_name_and_kept(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    journal = journal_path(file)
    data = b"?" + journal.read_bytes()[1:]
    journal.write_bytes(data)
    operator = started(state, file)
    assert f"UNSAVED WORK IS DAMAGED Unsaved work on {file.name}, " in operator.asked
    assert f"The file is {journal.name}." in operator.asked
    operator.answer("CONTINUE").type(9)
    assert "journal.kept-1" in operator.said
    operator.save().left()
    again = started(state, file)
    assert "journal.kept-1" in again.asked
    assert "journal.discarded-1" in again.answer("DISCARD").said
    assert [file.with_name(name).read_bytes() for name in journals(file)] == [data]
    again.left()
    assert started(state, file).offer is None


def test_a_journal_damaged_in_the_middle_is_reported_and_kept_whole(state: Path, file: Path) -> None:
    started(state, file).type(7, 3).killed()
    journal = journal_path(file)
    lines = journal.read_bytes().splitlines(keepends=True)
    damaged = b"".join([*lines[:2], b"?" + lines[2][1:], lines[2]])
    journal.write_bytes(damaged)
    operator = started(state, file)
    assert "The end of it cannot be read and is kept as a backup." in operator.asked
    assert operator.answer("RESTORE").number == 7
    assert "journal.damaged-1 holds a copy: Ctrl+O lists it." in operator.said
    assert journal.with_name(f"{journal.name}.damaged-1").read_bytes() == damaged
    operator.type(8).killed()
    assert started(state, file).answer("RESTORE").number == 8


@pytest.mark.parametrize("cut", [1, 7, 40])
def test_a_torn_end_loses_only_the_last_edit(state: Path, file: Path, cut: int) -> None:
    started(state, file).type(7, 3).killed()
    path = journal_path(file)
    path.write_bytes(path.read_bytes()[:-cut])
    assert started(state, file).answer("RESTORE").number == 7


@pytest.mark.parametrize("left", [b"somebody's own", b"\xff" * 99, b"00000000 {}\n"])
def test_a_file_that_is_not_a_journal_is_kept(state: Path, file: Path, left: bytes) -> None:
    journal_path(file).write_bytes(left)
    operator = started(state, file).answer("CONTINUE").type(7).save()
    operator.left()
    assert [file.with_name(name).read_bytes() for name in names(file)] == [left]


def test_an_empty_journal_is_ignored(state: Path, file: Path) -> None:
    journal_path(file).touch()
    operator = started(state, file)
    assert operator.offer is None
    operator.type(9).save().left()
    assert names(file) == []


def typed_on(state: Path, file: Path, answer: str) -> None:
    """One user, two programs: the second takes over and answers; the first types on and dies."""
    first = started(state, file, ALIVE).type(7)
    second = started(state, file, DEAD).answer("TAKE OVER")
    assert "The other terminal may still be in use" in second.asked
    second.answer(answer)
    if answer == "RESTORE":
        assert second.said.startswith(
            "The other terminal's work is here. Ctrl+Z undoes it step by step, Ctrl+S saves it."
        )
        assert second.said.endswith(" holds a copy: Ctrl+O lists it.")
    first.type(125)
    first.killed()
    assert b"125" in b"".join(path.read_bytes() for path in file.parent.glob(".part*theirs*"))
    second.type(8).save().left()


def dead(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.documents.unsaved_work.alive", lambda _: False)
    monkeypatch.setattr("app.documents.document_service.alive", lambda _: False)


@pytest.mark.parametrize("answer", ["RESTORE", "DISCARD"])
def test_edits_typed_after_a_take_over_are_offered(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    typed_on(state, file, answer)
    dead(monkeypatch)
    again = started(state, file)
    assert "2 edits." in again.asked
    assert again.answer("RESTORE").number == 125


@pytest.mark.parametrize("answer", ["RESTORE", "DISCARD"])
def test_nothing_is_offered_when_nothing_was_typed_after_a_take_over(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    first = started(state, file, ALIVE).type(7)
    started(state, file, DEAD).answer("TAKE OVER").answer(answer).type(8).save().left()
    first.killed()
    dead(monkeypatch)
    assert started(state, file).offer is None


def test_closing_both_programs_after_a_take_over_leaves_no_journal(state: Path, file: Path) -> None:
    first = started(state, file, ALIVE).type(7)
    second = started(state, file, DEAD).answer("TAKE OVER").answer("RESTORE")
    first.type(6).left()
    second.left()
    assert journals(file) == []


def test_taken_over_work_of_another_host_is_kept(state: Path, file: Path) -> None:
    """Its program may still be alive."""
    started(state, file, ELSEWHERE).type(7)
    started(state, file, DEAD).answer("TAKE OVER").answer("RESTORE").type(8).save().left()
    assert journals(file) == [f".{file.name}.cutcomp-journal.kept-1"]


def full(folder: Path, monkeypatch: pytest.MonkeyPatch, error: int = errno.ENOSPC) -> None:
    """From now on, every write into this folder fails; other folders still work."""
    real = os.write
    folder = folder.resolve()

    def write(handle: int, data: bytes) -> int:
        if Path(f"/proc/self/fd/{handle}").readlink().parent == folder:
            raise OSError(error, os.strerror(error))
        return real(handle, data)

    monkeypatch.setattr(os, "write", write)


@pytest.mark.parametrize("error", [errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO])
@pytest.mark.parametrize("before", [(), (7,)])
def test_work_is_kept_elsewhere_when_its_folder_cannot_be_written(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch, error: int, before: tuple[float, ...]
) -> None:
    """Writing fails from the first edit on, or from a later one."""
    with monkeypatch.context() as patch:
        first = started(state, file).type(*before)
        full(file.parent, patch, error)
        first.type(8)
        assert f"The folder of {file.name} takes nothing: unsaved work is kept in {state}" in first.said
        first.type(125)
        first.killed()
        assert journals(file) == []
    again = started(state, file)
    assert again.answer("RESTORE").work == first.work
    again.save().left()
    assert list(state.iterdir()) == []
    assert names(file) == []


def test_the_next_work_is_kept_elsewhere_when_a_journal_cannot_be_renamed(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(state, file).type(7)
    first.killed()
    real = Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.parent == file.parent:
            raise PermissionError(errno.EPERM, "sticky")
        return real(path, target)

    monkeypatch.setattr(Path, "rename", rename)
    bob = started(state, file, BOB).answer("LEAVE IT")
    bob.type(9).killed()
    assert len(list(state.iterdir())) == 1
    assert started(state, file).answer("RESTORE").work == first.work


# ---- files that cannot be read or are gone


def test_work_on_a_truncated_file_is_restored_and_the_file_is_kept(state: Path, part: Path) -> None:
    started(state, part).type(7).killed()
    part.write_bytes(part.read_bytes()[:100])
    operator = started(state, part)
    assert "part.toml itself cannot be read; it stays as it is." in operator.asked
    assert operator.answer("RESTORE").number == 7
    remainder = part.read_bytes()
    operator.save(None, "YOURS")
    assert number_in(part) == 7
    assert [path.read_bytes() for path in part.parent.glob("part.theirs-*")] == [remainder]


def test_a_truncated_file_stays_until_the_operator_decides(state: Path, part: Path) -> None:
    started(state, part).type(7).killed()
    part.write_bytes(part.read_bytes()[:100])
    remainder = part.read_bytes()
    operator = started(state, part).answer("DISCARD").type(3)
    ask = operator.try_to_save()
    assert isinstance(ask, QuestionText)
    assert "part.toml cannot be read. It was written" in words(ask)
    operator.save(None, "FILE AS IT IS")
    assert part.read_bytes() == remainder
    assert operator.document.file.path.name.startswith("part.mine-")


def test_the_fault_of_a_file_without_unsaved_work_is_reported(state: Path, part: Path) -> None:
    part.write_bytes(b"no program")
    opened = service(state).open(part)
    assert isinstance(opened, Trouble)
    assert "line 1" in opened.text


def test_work_that_was_set_aside_is_restored_for_its_owner_only(state: Path, part: Path) -> None:
    started(state, part).type(7).killed()
    set_aside(journal_path(part), "kept")
    part.write_bytes(b"no program")
    assert isinstance(service(state, BOB).open(part), Trouble)
    assert started(state, part).answer("RESTORE").number == 7


# ---- kept copies


def copies(state: Path, file: Path) -> list[KeptCopy]:
    return kept_copies(file.parent, state)


def chosen(operator: Typist, state: Path, file: Path) -> Typist:
    """Open the first of the kept copies from the list."""
    copy = copies(state, file)[0].path
    operator.left()
    path = file_of_copy(copy, file.parent)
    assert path is not None
    return operator.took(opened(operator.service.open(path, kept_copy=copy)))


def opened(result: Opened[Any] | Trouble) -> Opened[Any]:
    assert isinstance(result, Opened), result
    return result


def test_a_discarded_copy_is_listed_and_can_be_restored(state: Path, file: Path) -> None:
    first = started(state, file).type(7)
    first.killed()
    operator = started(state, file).answer("DISCARD")
    assert copies(state, file)[0].sentence(TIME).startswith(f"Unsaved work on {file.name}, discarded ")
    assert [copy.name for copy in copies(state, file)] == [file.name]
    operator = chosen(operator, state, file)
    assert "LEAVE IT it stays in the list" in operator.asked
    assert operator.answer("RESTORE").work == first.work
    assert operator.document.file.path == file
    operator.save().left()
    assert number_in(file) == 7
    assert journals(file) == [f".{file.name}.cutcomp-journal.discarded-1"]


def test_a_copy_left_alone_asks_nothing_more(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    operator = chosen(started(state, file).answer("DISCARD"), state, file).answer("LEAVE IT")
    assert (operator.offer, operator.number) == (None, 1)


def test_work_restored_from_a_copy_is_journaled_again(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    again = chosen(started(state, file).answer("DISCARD"), state, file).answer("RESTORE").type(25)
    again.killed()
    assert started(state, file).answer("RESTORE").work == again.work


def test_another_user_can_restore_kept_work(state: Path, file: Path) -> None:
    first = started(state, file).type(7)
    first.killed()
    bob = chosen(started(state, file, BOB).answer("LEAVE IT"), state, file).answer("RESTORE")
    assert bob.work == first.work
    bob.left()
    assert started(state, file).answer("RESTORE").work == first.work


def test_an_unnamed_copy_is_restored_into_a_new_program(state: Path, part: Path) -> None:
    first = started(state).type(7)
    first.killed()
    operator = started(state).answer("DISCARD")
    [copy] = kept_copies(part.parent, state)
    assert copy.name == "a program without a name"
    assert file_of_copy(copy.path, part.parent) is None
    operator.took(operator.service.copy_without_name(copy.path)).answer("RESTORE")
    assert (operator.work, operator.document.file.path) == (first.work, None)


@pytest.mark.parametrize("letter", ["p", "\u90e8"])
def test_a_copy_with_a_shortened_name_is_listed(state: Path, part: Path, letter: str) -> None:
    file = part.rename(part.with_name(f"{letter * (240 // len(letter.encode()))}.toml"))
    started(state, file).type(7).killed()
    started(state, file).answer("DISCARD").left()
    [copy] = copies(state, file)
    assert file_of_copy(copy.path, file.parent) == file


def test_a_deleted_file_is_restored_from_its_copy(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    operator = started(state, file).answer("DISCARD")
    file.unlink()
    chosen(operator, state, file).answer("RESTORE").save()
    assert number_in(file) == 7


def test_a_copy_in_a_moved_folder_belongs_to_the_file_beside_it(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    started(state, file).answer("DISCARD").left()
    moved = file.parent.with_name("moved")
    shutil.move(file.parent, moved)
    os.chdir(moved)
    [copy] = copies(state, moved / file.name)
    assert file_of_copy(copy.path, moved) == moved / file.name


def test_a_file_is_found_although_its_journal_has_a_shortened_name(state: Path, part: Path) -> None:
    long = part.rename(part.with_name(f"{'p' * 210}.toml"))
    first = started(state, long).type(7)
    first.killed()
    operator = chosen(started(state, long).answer("DISCARD"), state, long).answer("RESTORE")
    assert operator.document.file.path == long
    assert operator.work == first.work


def test_an_unreadable_copy_is_reported(state: Path, file: Path) -> None:
    copy = journal_path(file).with_name(f".{file.name}.cutcomp-journal.kept-1")
    copy.write_text("nothing")
    opening = opened(service(state).open(file, kept_copy=copy))
    assert opening.offer is not None
    assert "is damaged and cannot be read" in words(opening.offer.ask)


@pytest.mark.parametrize("named", [True, False])
def test_work_of_another_version_is_reported_and_kept(state: Path, file: Path, *, named: bool) -> None:
    state.mkdir(exist_ok=True)
    journal = journal_path(file) if named else state / f"unnamed-mill-3-1-2{JOURNAL_SUFFIX}"
    written, _ = lines([{"journal": 2, "owner": asdict(DEAD), "base": {}}, {"do": "TOOL", "delta": {}}])
    journal.write_bytes(written)
    operator = started(state, file if named else None)
    name = file.name if named else "a program without a name"
    assert operator.asked.startswith(f"UNSAVED WORK FOUND Another version of cutcomp wrote unsaved work on {name}, ")
    assert f"It is kept. The file is {journal.name if named else journal}." in operator.asked
    operator.answer("CONTINUE").type(7).killed()
    kept = [path for path in journal.parent.iterdir() if path.name.startswith(journal.name)]
    assert written in [path.read_bytes() for path in kept]


def test_work_that_another_version_is_doing_is_not_asked_about(state: Path) -> None:
    state.mkdir(exist_ok=True)
    written, _ = lines([{"journal": 2, "owner": asdict(ALIVE), "base": {}}])
    (state / f"unnamed-mill-3-1-2{JOURNAL_SUFFIX}").write_bytes(written)
    assert started(state).offer is None


def test_never_saved_programs_are_listed(state: Path, part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    started(state, part.with_name("flap.toml")).type(7).killed()
    monkeypatch.setattr(os, "access", lambda *_: False)
    started(state, part.with_name("lid.toml")).type(7).killed()
    copied = part.with_name(f"plate.toml{JOURNAL_SUFFIX}")
    copied.write_bytes(journal_path(part.with_name("flap.toml")).read_bytes())
    assert [path.name for path in never_saved(part.parent, state)] == ["flap.toml", "lid.toml"]


def test_a_journal_of_the_other_kind_is_reported_as_damaged(state: Path, part: Path) -> None:
    save(load(example("notch")), part.with_name("other.toml"))
    started(state, part).type(7).killed()
    nc = part.with_name("x.nc")
    nc.write_bytes(b"M30\n")
    journal_path(part).rename(journal_path(nc))
    assert "is damaged" in started(state, nc, replace(DEAD, pid=DEAD.pid + 5)).asked
