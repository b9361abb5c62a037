"""Nothing that was accepted is lost: killed after any key, the next start offers it back."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.lock import lock_path
from app.documents.programs import example
from app.painted.screens.contour import Contour
from app.painted.screens.decide import Decide
from app.painted.session import Session
from core.program.model import Number
from tests.app.kept import DEAD, asked, names, started


def equal(one: Session, other: Session) -> bool:
    return (one.history, one.where, one.field) == (other.history, other.where, other.field)


def test_killed_after_any_key_everything_accepted_comes_back(own: Path, part: Path) -> None:
    """The half-typed field is the only thing that may be gone."""
    keys = ["tab", "7", "enter", "tab", "tab", "2", ".", "5", "enter", "ctrl+z", "3", "enter", "f6", "f2", "7", "enter"]
    saved = load(part)
    for count in range(len(keys) + 1):
        first = started(own, part).press(*keys[:count])
        before = first.session
        first.killed()
        second = started(own, part)
        if before.program == saved:
            assert not isinstance(second.desk.page, Decide)
        else:
            assert isinstance(second.desk.page, Decide)
            second.press("r")
            assert second.session.history == before.history
            assert second.session.unsaved
        second.keeping.leave()
        assert names(part) == []


def test_undo_reaches_back_behind_two_crashes_and_a_save(own: Path, part: Path) -> None:
    begun = load(part)
    first = started(own, part).press("tab").type("7").press("ctrl+s", "tab").type("3")
    first.killed()
    second = started(own, part).press("r").press("down").type("2.5")
    second.killed()
    third = started(own, part).press("r")
    assert equal(third.session, second.session)
    while third.session.history.past:
        third.press("ctrl+z")
    assert third.session.program == begun
    while third.session.history.future:
        third.press("ctrl+y")
    assert third.session.history.program == second.session.program


def test_the_question_says_when_and_what_differs(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    told = asked(started(own, part, clock="2025-03-05T08:00:00+01:00"))
    assert "Work on part.toml was not saved. The last of it was on 4 Mar 2025 at 06:05, 1 edit can be undone." in told
    assert "Block 1: TOOL 7, was 1." in told


def test_the_question_has_no_way_around(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    again = started(own, part).press("escape", "enter", "f8", "x", "f3", "ctrl+z", "tab", "9", "enter")
    assert "TOOL 7" in asked(again)
    assert again.session.program == load(part)
    assert again.press("ctrl+q").desk.exit
    assert "TOOL 7" in asked(started(own, part))


def test_saving_with_the_question_unanswered_keeps_the_work(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    started(own, part).press("ctrl+s").killed()
    assert "TOOL 7" in asked(started(own, part))


def test_many_differences_are_counted(own: Path, part: Path) -> None:
    operator = started(own, part)
    for _ in range(5):
        operator.press("f8", "f3", "enter")
    operator.press("f8", "f7", "f4").type(".1", ".2", ".3", ".4", "50", ".6", ".7")
    operator.killed()
    assert "more." in asked(started(own, part))


def test_discarded_work_is_kept_aside_and_not_offered_again(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    assert "Discarded. A copy is in" in started(own, part).press("d", "y").said
    again = started(own, part)
    assert isinstance(again.desk.page, Contour)
    assert [name for name in names(part) if "discarded" in name] == [".part.toml.cutcomp-journal.discarded-1"]


@pytest.mark.parametrize("keys", [["ctrl+s", "ctrl+q"], ["ctrl+q", "s"], ["ctrl+q", "l"], ["ctrl+z", "ctrl+q"]])
def test_leaving_leaves_nothing_behind(own: Path, part: Path, keys: list[str]) -> None:
    assert started(own, part).press("tab").type("7").press(*keys).desk.exit
    assert names(part) == []
    assert not own.exists() or list(own.iterdir()) == []


def test_saved_there_is_no_journal_until_the_next_edit(own: Path, part: Path) -> None:
    operator = started(own, part).press("tab").type("7").press("ctrl+s")
    assert names(part) == [lock_path(part).name]
    operator.press("tab").type("3")
    assert len(names(part)) == 2


def test_killed_between_the_save_and_the_end_of_the_journal_there_is_nothing_to_ask(own: Path, part: Path) -> None:
    operator = started(own, part).press("tab").type("7")
    save(operator.session.program, part)
    operator.killed()
    assert isinstance(started(own, part).desk.page, Contour)
    assert names(part) == [lock_path(part).name]


def test_a_program_without_a_name_is_offered_at_the_next_start(own: Path) -> None:
    first = started(own).press("tab").type("7")
    first.killed()
    assert isinstance(started(own, me=replace(DEAD, user="x")).press("r").desk.page, Contour)
    other = started(own)
    assert "a program without a name" in asked(other)
    assert other.press("r").session.history == first.session.history
    other.keeping.leave()
    assert list(own.iterdir()) == []


def test_a_program_without_a_name_moves_beside_the_file_it_gets(own: Path, part: Path) -> None:
    operator = started(own).press("tab").type("7").press("ctrl+s", "delete", *str(part.parent / "new.toml"), "enter")
    assert list(own.iterdir()) == []
    operator.press("tab").type("3").killed()
    again = started(own, part.parent / "new.toml").press("r")
    assert again.session.history == operator.session.history
    assert again.session.history.undo_count == 2


def test_a_new_file_that_was_never_saved_is_offered(own: Path, part: Path) -> None:
    first = started(own, part.with_name("new.toml")).press("tab").type("7")
    first.killed()
    again = started(own, part.with_name("new.toml"))
    assert "Against a new program" in asked(again)
    assert again.press("r").session.history == first.session.history


def test_a_folder_that_cannot_be_written_has_its_journals_elsewhere(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    first = started(own, part).press("tab").type("7")
    first.killed()
    assert names(part) == [lock_path(part).name]
    assert [one.suffix for one in own.iterdir()] == [".cutcomp-journal"]
    assert started(own, part).press("r").session.history == first.session.history


def test_an_example_leaves_nothing_in_its_folder(own: Path) -> None:
    folder = example("pocket").parent
    before = sorted(folder.iterdir())
    operator = started(own).press("ctrl+o", *str(example("pocket")), "enter", "tab").type("7")
    assert sorted(folder.iterdir()) == before
    assert operator.session.file is None
    assert len(list(own.iterdir())) == 1


def test_another_program_opened_leaves_nothing_of_the_first(own: Path, part: Path) -> None:
    other = part.with_name("other.toml")
    save(load(example("notch")), other)
    operator = started(own, part).press("tab").type("7").press("ctrl+o", *str(other), "enter", "d")
    assert operator.session.file == other
    assert names(other) == [lock_path(other).name, "part.toml"]


def test_a_full_disk_is_told_and_the_work_goes_on(own: Path, part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    operator = started(own, part).press("tab").type("7")

    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        operator.press("up").type("8")
        assert "A crash would lose this: it is not on the disk, the disk is full." in operator.said
        assert "nothing is lost" not in operator.said
        operator.press("up").type("9")
        assert "the disk is full" in operator.said
        assert operator.block.tool == Number(9.0)
    operator.press("up").type("6")
    assert operator.said.startswith("Work is kept on the disk again.")
    operator.killed()
    again = started(own, part).press("r")
    assert again.session.history == operator.session.history


def test_damage_in_the_middle_is_told_and_the_whole_journal_kept(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7", "", "3")
    first.killed()
    journal = part.with_name(".part.toml.cutcomp-journal")
    data = journal.read_bytes()
    lines = data.splitlines(keepends=True)
    journal.write_bytes(b"".join([*lines[:2], b"?" + lines[2][1:], lines[2]]))
    again = started(own, part)
    assert "The end of it cannot be read and is kept aside." in asked(again)
    again.press("r")
    assert again.block.tool == Number(7.0)
    assert any("damaged" in name for name in names(part))


def test_a_journal_that_is_none_is_told_and_not_lost(own: Path, part: Path) -> None:
    journal = part.with_name(".part.toml.cutcomp-journal")
    journal.write_text("somebody's own")
    operator = started(own, part)
    assert "There is unsaved work on part.toml that cannot be read" in asked(operator)
    operator.press("g", "tab").type("7").press("ctrl+s", "ctrl+q")
    assert [part.with_name(name).read_text() for name in names(part)] == ["somebody's own"]
