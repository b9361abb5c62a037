"""Nothing that was accepted is lost: killed after any edit, the next start offers it; for both kinds of document."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from app.documents.journal_file import journal_path
from app.documents.left_overs import read
from app.documents.lock import lock_path
from app.documents.programs import example
from app.documents.service import Opened, Trouble
from core.units import Unit
from tests.app.documents.test_journal_file import GONE
from tests.app.documents.typist import DEAD, Typist, names, number_in, service, started


def test_killed_after_any_edit_everything_comes_back_with_its_undo(own: Path, file: Path) -> None:
    keys = ["7", "u", "3", "4", "u", "u", "r", "9"]
    for count in range(len(keys) + 1):
        first = started(own, file)
        for key in keys[:count]:
            first.undo() if key == "u" else first.redo() if key == "r" else first.type(float(key))
        unsaved, work = first.document.unsaved, first.work
        first.killed()
        second = started(own, file)
        assert (second.offer is not None) is unsaved
        if unsaved:
            assert second.answer("RESTORE").work == work
            assert second.document.unsaved
        second.left()
        assert names(file) == []


def test_the_cursor_comes_back(own: Path, file: Path) -> None:
    first = started(own, file).type(7)
    first.killed()
    assert started(own, file).answer("RESTORE").document.place == first.document.place


def test_undo_reaches_back_over_two_crashes_and_a_save(own: Path, file: Path) -> None:
    started(own, file).type(7).save().type(3).killed()
    second = started(own, file).answer("RESTORE").type(2)
    second.killed()
    third = started(own, file).answer("RESTORE")
    assert third.work == second.work
    third.undo().undo().undo()
    for _ in range(3):
        third.redo()
    assert third.number == 2
    third.undo().undo().undo()
    assert third.number == 1


def test_the_question_says_when_how_much_and_what_differs(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    later = started(own, file, clock="2025-03-05T08:00:00+01:00")
    assert f"UNSAVED WORK FOUND {file.name}, 4 Mar 2025 06:05, 1 edit." in later.asked
    assert "7" in later.asked
    later.left()
    started(own, file).answer("RESTORE").type(8).killed()
    assert f"{file.name}, 06:05 today, 2 edits." in started(own, file).asked


def test_going_back_keeps_the_question_for_the_next_start(own: Path, file: Path) -> None:
    first = started(own, file).type(7)
    first.killed()
    started(own, file).answer("GO BACK").left()
    assert started(own, file).answer("RESTORE").work == first.work


def test_an_edit_while_the_question_waits_keeps_both(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    other = started(own, file).type(9)
    assert "kept-1 holds what was left before" in other.said
    other.save().left()
    assert started(own, file).answer("RESTORE").number == 7


def test_discarded_work_is_a_backup_and_not_offered_again(own: Path, file: Path) -> None:
    started(own, file).type(7).killed()
    operator = started(own, file).answer("DISCARD")
    assert operator.said == f"Kept as a backup in .{file.name}.cutcomp-journal.discarded-1; Ctrl+O lists it."
    assert operator.number == 1
    operator.left()
    assert started(own, file).offer is None


def test_saved_there_is_no_journal_until_the_next_edit(own: Path, file: Path) -> None:
    operator = started(own, file).type(7).save()
    assert names(file) == [lock_path(file).name]
    assert number_in(file) == 7
    operator.type(3)
    assert journal_path(file).exists()
    operator.left()
    assert names(file) == []
    assert not own.exists() or list(own.iterdir()) == []


def test_undone_to_what_the_file_holds_nothing_is_unsaved(own: Path, file: Path) -> None:
    started(own, file).type(7, 8).killed()
    again = started(own, file).answer("RESTORE").undo()
    assert again.document.unsaved
    assert not again.undo().document.unsaved
    again.service.stop()
    assert names(file) == []


def test_an_end_nobody_asked_for_leaves_the_journal_and_no_lock(own: Path, file: Path) -> None:
    operator = started(own, file).type(7)
    operator.service.stop()
    assert names(file) == [journal_path(file).name]


def test_what_the_file_holds_by_now_is_not_offered(own: Path, file: Path) -> None:
    operator = started(own, file).type(7)
    operator.killed()
    file.write_bytes(operator.document.data())
    again = started(own, file)
    assert again.offer is None
    assert names(file) == [lock_path(file).name]


def test_a_program_without_a_name_is_offered_at_the_next_start_and_moves_beside_its_file(own: Path, part: Path) -> None:
    first = started(own).type(7)
    first.killed()
    other = started(own)
    assert "UNSAVED WORK FOUND No name, 06:05 today, 1 edit." in other.asked
    assert other.answer("RESTORE").work == first.work
    other.save(part.with_name("new"))
    assert list(own.iterdir()) == []
    other.type(3).killed()
    assert started(own, part.with_name("new.toml")).answer("RESTORE").work == other.work


def test_a_program_in_millimeters_is_compared_with_a_new_one_in_millimeters(own: Path) -> None:
    at_work = service(own)
    Typist(at_work, None).took(at_work.new(Unit.MM)).type(7).killed()
    asked = started(own).asked
    assert "Compared with a new program:" in asked
    assert "units" not in asked
    assert "BLEND OFFSET" not in asked


def test_a_program_that_was_never_saved_is_offered(own: Path, part: Path) -> None:
    new = part.with_name("new.toml")
    first = started(own, new)
    assert "does not exist yet: saving makes it." in first.said
    first.type(7).killed()
    again = started(own, new)
    assert "Compared with a new program:" in again.asked
    assert again.answer("RESTORE").work == first.work


def test_a_folder_that_cannot_be_written_has_its_journals_elsewhere(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    first = started(own, file).type(7)
    assert "takes nothing: unsaved work is kept in" in first.said
    assert first.type(8).said == ""
    first.killed()
    assert names(file) == [lock_path(file).name]
    assert [one.suffix for one in own.iterdir()] == [".cutcomp-journal"]
    again = started(own, file).answer("RESTORE")
    assert again.work == first.work
    again.left()
    assert list(own.iterdir()) == []


def test_an_example_leaves_nothing_in_its_folder(own: Path) -> None:
    folder = example("pocket").parent
    before = sorted(folder.iterdir())
    opened = service(own, DEAD).open(example("pocket"))
    assert isinstance(opened, Opened)
    assert opened.document.file.path is None
    operator = started(own)
    operator.took(operator.service.example("pocket")).type(7)
    assert sorted(folder.iterdir()) == before
    assert len(list(own.iterdir())) == 1


def test_a_full_disk_is_told_and_the_work_goes_on(own: Path, file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    operator = started(own, file).type(7)

    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        assert operator.type(8).said.startswith("Not on disk: the disk is full.")
        assert "SAVE AS (Ctrl+K) saves elsewhere." in operator.type(9).said
    assert operator.type(6).said == "Work is kept on the disk again."
    operator.killed()
    assert started(own, file).answer("RESTORE").work == operator.work


def test_an_edit_behind_the_closing_is_kept_with_all_work(own: Path, file: Path) -> None:
    operator = started(own, file).type(7)
    operator.service.close(operator.document)
    operator.type(8)
    operator.killed()
    assert started(own, file).answer("RESTORE").work == operator.work


def test_a_full_disk_from_the_first_edit_on_has_room_in_the_end(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    operator = started(own, file)
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        operator.type(7, 8)
        assert "Not on disk" in operator.said
    operator.service.stop()
    assert started(own, file).answer("RESTORE").number == 8


def test_a_file_is_open_once(own: Path, file: Path) -> None:
    operator = started(own, file)
    again = operator.service.open(file.parent / ".." / file.parent.name / file.name)
    assert isinstance(again, Trouble)
    assert again.text == f"{file.name} is open already."
    assert again.open_already is operator.document


@pytest.mark.parametrize("gone", GONE)
def test_a_journal_that_is_gone_is_made_anew_with_everything_and_said(
    own: Path, file: Path, gone: Callable[[Path], None]
) -> None:
    operator = started(own, file).type(7, 8)
    journal = journal_path(file)
    gone(journal)
    operator.type(9)
    assert operator.said.startswith("The journal of unsaved work was gone: all of it is in ")
    assert operator.type(10).said == ""
    operator.undo().killed()
    places = [journal, *own.glob("*.cutcomp-journal")]
    [place] = [path for path in places if path.exists()]
    assert str(place) in operator.said or place.exists()
    held = read(place)
    assert held is not None
    assert held.edits == 3
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(started(own / "x").document.data() if file.suffix == ".toml" else b"M30\n")
    assert started(own, file).answer("RESTORE").work == operator.work


def test_a_journal_folder_of_ones_own_that_is_gone_is_made_anew(own: Path) -> None:
    operator = started(own).type(7)
    shutil.rmtree(own)
    assert "was gone" in operator.type(8).said
    operator.killed()
    assert started(own).answer("RESTORE").work == operator.work


def test_a_journal_gone_at_the_end_is_made_anew_by_stopping(own: Path, file: Path) -> None:
    operator = started(own, file).type(7)
    journal_path(file).unlink()
    operator.service.stop()
    assert started(own, file).answer("RESTORE").number == 7
