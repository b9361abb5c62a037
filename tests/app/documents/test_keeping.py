"""No accepted edit is lost: after a kill, the next start offers the work, for both kinds of document."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from app.documents.document_service import Opened, Trouble
from app.documents.journal_file import journal_path
from app.documents.lock import lock_path
from app.documents.programs import example
from app.documents.unsaved_work import read
from core.units import Unit
from tests.app.documents.test_journal_file import GONE
from tests.app.documents.typist import DEAD, Typist, names, number_in, service, started


def test_a_kill_after_any_edit_loses_neither_work_nor_undo(state: Path, file: Path) -> None:
    keys = ["7", "u", "3", "4", "u", "u", "r", "9"]
    for count in range(len(keys) + 1):
        first = started(state, file)
        for key in keys[:count]:
            first.undo() if key == "u" else first.redo() if key == "r" else first.type(float(key))
        unsaved, work = first.document.unsaved, first.work
        first.killed()
        second = started(state, file)
        assert (second.offer is not None) is unsaved
        if unsaved:
            assert second.answer("RESTORE").work == work
            assert second.document.unsaved
        second.left()
        assert names(file) == []


def test_the_cursor_position_is_restored(state: Path, file: Path) -> None:
    first = started(state, file).type(7)
    first.killed()
    assert started(state, file).answer("RESTORE").document.place == first.document.place


def test_undo_reaches_back_past_two_crashes_and_a_save(state: Path, file: Path) -> None:
    started(state, file).type(7).save().type(3).killed()
    second = started(state, file).answer("RESTORE").type(2)
    second.killed()
    third = started(state, file).answer("RESTORE")
    assert third.work == second.work
    third.undo().undo().undo()
    for _ in range(3):
        third.redo()
    assert third.number == 2
    third.undo().undo().undo()
    assert third.number == 1


def test_the_question_states_time_and_amount(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    later = started(state, file, clock="2025-03-05T08:00:00+01:00")
    assert f"UNSAVED WORK FOUND {file.name}, 4 Mar 2025 06:05, 1 edit." in later.asked
    later.left()
    again = started(state, file).answer("RESTORE")
    assert again.number == 7
    again.type(8).killed()
    assert f"{file.name}, 06:05 today, 2 edits." in started(state, file).asked


def test_going_back_repeats_the_question_at_the_next_start(state: Path, file: Path) -> None:
    first = started(state, file).type(7)
    first.killed()
    started(state, file).answer("GO BACK").left()
    assert started(state, file).answer("RESTORE").work == first.work


def test_an_edit_while_the_question_is_open_keeps_both_works(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    other = started(state, file).type(9)
    assert "kept-1 holds what was left before" in other.said
    other.save().left()
    assert started(state, file).answer("RESTORE").number == 7


def test_discarded_work_is_kept_as_a_backup_and_not_offered_again(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    operator = started(state, file).answer("DISCARD")
    assert operator.said == f"Kept as a backup in .{file.name}.cutcomp-journal.discarded-1; Ctrl+O lists it."
    assert operator.number == 1
    operator.left()
    assert started(state, file).offer is None


def test_a_save_removes_the_journal_until_the_next_edit(state: Path, file: Path) -> None:
    operator = started(state, file).type(7).save()
    assert names(file) == [lock_path(file).name]
    assert number_in(file) == 7
    operator.type(3)
    assert journal_path(file).exists()
    operator.left()
    assert names(file) == []
    assert not state.exists() or list(state.iterdir()) == []


def test_work_undone_to_the_state_of_the_file_is_not_unsaved(state: Path, file: Path) -> None:
    started(state, file).type(7, 8).killed()
    again = started(state, file).answer("RESTORE").undo()
    assert again.document.unsaved
    assert not again.undo().document.unsaved
    again.service.stop()
    assert names(file) == []


def test_an_unexpected_end_leaves_the_journal_and_no_lock(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    operator.service.stop()
    assert names(file) == [journal_path(file).name]


def test_work_that_the_file_already_holds_is_not_offered(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    operator.killed()
    file.write_bytes(operator.document.data())
    again = started(state, file)
    assert again.offer is None
    assert names(file) == [lock_path(file).name]


def test_an_unnamed_program_is_offered_at_the_next_start_and_can_be_saved(state: Path, part: Path) -> None:
    first = started(state).type(7)
    first.killed()
    other = started(state)
    assert "UNSAVED WORK FOUND No name, 06:05 today, 1 edit." in other.asked
    assert other.answer("RESTORE").work == first.work
    other.save(part.with_name("new"))
    assert list(state.iterdir()) == []
    other.type(3).killed()
    assert started(state, part.with_name("new.toml")).answer("RESTORE").work == other.work


def test_an_unnamed_metric_program_comes_back_with_its_unit(state: Path) -> None:
    at_work = service(state)
    Typist(at_work, None).took(at_work.new(Unit.MM)).type(7).killed()
    again = started(state)
    assert "No name, 06:05 today, 1 edit." in again.asked
    assert again.answer("RESTORE").number == 7
    assert again.document.program.unit is Unit.MM


def test_a_never_saved_program_is_offered(state: Path, part: Path) -> None:
    new = part.with_name("new.toml")
    first = started(state, new)
    assert "does not exist yet: saving makes it." in first.said
    first.type(7).killed()
    again = started(state, new)
    assert "new.toml, 06:05 today, 1 edit." in again.asked
    assert again.answer("RESTORE").work == first.work


def test_the_journal_of_a_read_only_folder_is_kept_elsewhere(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    first = started(state, file).type(7)
    assert "takes nothing: unsaved work is kept in" in first.said
    assert first.type(8).said == ""
    first.killed()
    assert names(file) == [lock_path(file).name]
    assert [path.suffix for path in state.iterdir()] == [".cutcomp-journal"]
    again = started(state, file).answer("RESTORE")
    assert again.work == first.work
    again.left()
    assert list(state.iterdir()) == []


def test_editing_an_example_leaves_its_folder_unchanged(state: Path) -> None:
    folder = example("pocket").parent
    before = sorted(folder.iterdir())
    opened = service(state, DEAD).open(example("pocket"))
    assert isinstance(opened, Opened)
    assert opened.document.file.path is None
    operator = started(state)
    operator.took(operator.service.example("pocket")).type(7)
    assert sorted(folder.iterdir()) == before
    assert len(list(state.iterdir())) == 1


def test_a_full_disk_is_reported_and_work_continues(state: Path, file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    operator = started(state, file).type(7)

    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        assert operator.type(8).said.startswith("Not on disk: the disk is full.")
        assert "SAVE AS (Ctrl+K) saves elsewhere." in operator.type(9).said
    assert operator.type(6).said == "Work is kept on the disk again."
    operator.killed()
    assert started(state, file).answer("RESTORE").work == operator.work


def test_an_edit_after_closing_is_kept_with_all_work(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    operator.service.close(operator.document)
    operator.type(8)
    operator.killed()
    assert started(state, file).answer("RESTORE").work == operator.work


def test_edits_made_on_a_full_disk_are_kept_by_stopping_with_room(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    operator = started(state, file)
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        operator.type(7, 8)
        assert "Not on disk" in operator.said
    operator.service.stop()
    assert started(state, file).answer("RESTORE").number == 8


def test_a_file_can_be_opened_only_once(state: Path, file: Path) -> None:
    operator = started(state, file)
    again = operator.service.open(file.parent / ".." / file.parent.name / file.name)
    assert isinstance(again, Trouble)
    assert again.text == f"{file.name} is open already."
    assert again.open_already is operator.document


@pytest.mark.parametrize("gone", GONE)
def test_a_lost_journal_is_rewritten_in_full_and_reported(
    state: Path, file: Path, gone: Callable[[Path], None]
) -> None:
    operator = started(state, file).type(7, 8)
    journal = journal_path(file)
    gone(journal)
    operator.type(9)
    assert operator.said.startswith("The journal of unsaved work was gone: all of it is in ")
    assert operator.type(10).said == ""
    operator.undo().killed()
    places = [journal, *state.glob("*.cutcomp-journal")]
    [place] = [path for path in places if path.exists()]
    kept = read(place)
    assert kept is not None
    assert len(kept.work.past) == 3
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(started(state / "x").document.data() if file.suffix == ".toml" else b"M30\n")
    assert started(state, file).answer("RESTORE").work == operator.work


@pytest.mark.parametrize("killed", [True, False])
def test_a_lost_journal_begins_anew_as_soon_as_a_folder_takes_it(state: Path, file: Path, *, killed: bool) -> None:
    data = file.read_bytes()
    operator = started(state, file).type(7)
    shutil.rmtree(file.parent)
    state.touch()
    assert operator.type(8).said.startswith("Not on disk: ")
    file.parent.mkdir()
    file.write_bytes(data)
    if killed:
        assert operator.type(9).said == "Work is kept on the disk again."
        operator.killed()
    else:
        operator.service.stop()
    state.unlink()
    assert started(state, file).answer("RESTORE").work == operator.work


def test_a_journal_that_cannot_begin_anew_does_not_keep_the_program_from_ending(state: Path) -> None:
    operator = started(state).type(7)
    shutil.rmtree(state)
    state.touch()
    operator.service.stop()


def test_a_lost_state_folder_is_created_again(state: Path) -> None:
    operator = started(state).type(7)
    shutil.rmtree(state)
    assert "was gone" in operator.type(8).said
    operator.killed()
    assert started(state).answer("RESTORE").work == operator.work


def test_stopping_rewrites_a_lost_journal(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    journal_path(file).unlink()
    operator.service.stop()
    assert started(state, file).answer("RESTORE").number == 7
