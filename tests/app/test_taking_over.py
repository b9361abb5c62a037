"""Two who have one program open, and files that somebody else changed: both works are kept."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.lock import lock_path
from app.documents.programs import example
from core.program.file.write import dumps
from core.program.model import Number
from tests.app.kept import DEAD, ELSEWHERE, asked, names, started


def test_a_file_written_by_another_since_the_crash_is_told_and_kept(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    part.write_text(dumps(load(example("notch"))))
    operator = started(own, part)
    assert "by somebody else, or by this program just before its end" in asked(operator)
    operator.press("r", "ctrl+s")
    assert "CHANGED MEANWHILE" in operator.part("header")
    told = " ".join(operator.part("body").split())
    assert "It holds the same program as when it was opened here. Against that yours has:" in told
    assert "TOOL 7, was 1" in told
    assert "no program" not in told
    assert load(part) == load(example("notch"))


def test_the_second_opener_may_look(own: Path, part: Path) -> None:
    started(own, part, ELSEWHERE)
    operator = started(own, part, DEAD)
    assert "bob on office has this program open since 05:00." in asked(operator)
    later = started(own, part, DEAD, clock="2025-03-06T08:00:00+01:00")
    assert "bob on office has this program open since 4 Mar 2025 at 05:00." in asked(later)
    operator.press("l", "tab").type("7")
    assert operator.session.program == load(part)
    assert operator.said.endswith(
        "Nothing can be changed but in your own copy. SAVE AS: F8 until PROGRAM, then F7, F3."
    )
    assert "Save your own copy. SAVE AS: F8 until" in operator.press("escape", "ctrl+s").said
    operator.press("f8", "f7", "f3", "delete", *str(part.with_name("mine.toml")), "enter", "enter", "tab").type("7")
    assert operator.session.file == part.with_name("mine.toml")
    assert operator.session.history.undo_count == 1
    assert lock_path(part).exists()


def test_what_may_only_be_looked_at_says_so_in_every_title(own: Path, part: Path) -> None:
    started(own, part, ELSEWHERE)
    operator = started(own, part, DEAD)
    for keys in (["l"], ["tab"], ["7"], ["escape", "f8"], ["f7", "f5"]):
        operator.press(*keys)
        assert "LOOK ONLY part" in operator.part("header")
        assert "part*" not in operator.part("header")
    copy = started(own, part, DEAD).press("l", "f8", "f7", "f3", "delete", *"mine.toml", "enter")
    assert "LOOK ONLY" not in copy.part("header")
    assert "mine" in copy.part("header")


def test_replacing_a_file_that_somebody_has_open_says_who(own: Path, part: Path) -> None:
    started(own, part, ELSEWHERE)
    operator = started(own).press("tab").type("7").press("ctrl+s", "delete", *str(part), "enter")
    assert "bob on office has it open." in " ".join(operator.part("body").split())
    assert load(part).blocks[0].tool == Number(1.0)


def test_the_second_opener_may_take_over_with_the_work_of_the_first(own: Path, part: Path) -> None:
    first = started(own, part, ELSEWHERE).press("tab").type("7")
    second = started(own, part, DEAD).press("t")
    assert "Work on part.toml by bob on office was not saved" in asked(second)
    second.press("r")
    assert second.session.history == first.session.history
    first.press("up").type("8")
    assert "has this program open" in first.said
    assert "SAVE AS keeps your work." in first.said
    second.press("ctrl+s")
    assert load(part).blocks[0].tool == Number(7.0)


def test_discarding_what_its_owner_has_saved_meanwhile_says_so(own: Path, part: Path) -> None:
    first = started(own, part, ELSEWHERE).press("tab").type("7")
    second = started(own, part, DEAD).press("t")
    first.press("ctrl+s", "w")
    second.press("d", "y")
    assert "Nothing is left to discard: whoever typed it has saved it" in second.said
    assert "Ctrl+O opens the file as it is now." in second.said


def test_restoring_it_then_keeps_it_in_a_journal_of_its_own(own: Path, part: Path) -> None:
    first = started(own, part, ELSEWHERE).press("tab").type("7")
    second = started(own, part, DEAD).press("t")
    first.press("ctrl+s", "w")
    second.press("r")
    assert "Your work is back." in second.said
    assert second.keeping.journal is not None
    second.killed()
    assert started(own, part).session.history.program == second.session.program


def test_the_first_one_notices_before_it_saves(own: Path, part: Path) -> None:
    first = started(own, part, ELSEWHERE).press("tab").type("7")
    started(own, part, DEAD).press("t", "d", "y", "tab").type("3").press("ctrl+s")
    first.press("ctrl+s")
    assert "TAKEN OVER" in first.part("header")
    first.press("k")
    assert load(part).blocks[0].tool == Number(3.0)
    mine = first.session.file
    assert mine is not None
    assert mine.name.startswith("part.mine-")
    assert load(mine).blocks[0].tool == Number(7.0)


@pytest.mark.parametrize(("key", "tool", "whose"), [("t", 3.0, "mine"), ("y", 7.0, "theirs")])
def test_a_file_changed_by_another_is_noticed_and_both_are_kept(
    own: Path, part: Path, key: str, tool: float, whose: str
) -> None:
    operator = started(own, part).press("tab").type("7")
    theirs = load(part)
    save(started(own, part.with_name("x.toml")).press("tab").type("3").session.program, part)
    other = load(part)
    assert other != theirs
    operator.press("ctrl+s")
    told = " ".join(operator.part("body").split())
    assert "was changed by somebody else" in told
    since, yours = told.split("Against that yours has:")
    assert "Block 1: TOOL 3, was 1." in since
    assert "Block 1: TOOL 7, was 3." in yours
    assert "Both are kept. Which gets the name?" in since
    assert "T THEIRS Y YOURS Esc back, nothing changes" in since
    operator.press(key)
    assert load(part).blocks[0].tool == Number(tool)
    copies = [name for name in names(part) if whose in name and name.endswith(".toml")]
    assert len(copies) == 1
    assert copies[0] in operator.said
    kept = load(part.with_name(copies[0]))
    assert {kept.blocks[0].tool, load(part).blocks[0].tool} == {Number(3.0), Number(7.0)}
    assert not operator.session.unsaved


@pytest.mark.parametrize("call", ["write", "fsync"])
def test_a_full_disk_leaves_no_half_copy_of_the_other_version(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch, call: str
) -> None:
    operator = started(own, part).press("tab").type("7")
    save(started(own, part.with_name("x.toml")).press("tab").type("3").session.program, part)
    theirs, before = part.read_bytes(), names(part)
    operator.press("ctrl+s")

    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, call, full)
        operator.press("y")
    assert "Nothing is saved: the other version cannot be copied, the disk is full." in operator.said
    assert (part.read_bytes(), names(part)) == (theirs, before)


def test_written_again_with_the_same_content_is_no_change(own: Path, part: Path) -> None:
    operator = started(own, part).press("tab").type("7")
    part.write_bytes(part.read_bytes())
    assert "Saved" in operator.press("ctrl+s").said


def test_a_link_into_another_folder_is_asked_once(own: Path, part: Path) -> None:
    link = part.parent.parent / "link.toml"
    link.symlink_to(part)
    operator = started(own, link).press("tab").type("7").press("ctrl+s")
    assert "is a link to" in " ".join(operator.part("body").split())
    assert load(part).blocks[0].tool == Number(1.0)
    operator.press("w")
    assert load(part).blocks[0].tool == Number(7.0)
    assert "Saved" in operator.press("tab").type("8").press("ctrl+s").said


def test_an_nc_file_is_never_written_through_a_link_unasked(own: Path, part: Path) -> None:
    (part.parent / "part.nc").symlink_to(part.parent.parent / "elsewhere.nc")
    operator = started(own, part).press("f8", "f6", "enter")
    assert "leads there." in " ".join(operator.part("body").split())
    assert "WRITE IN ANOTHER FOLDER?" in operator.part("header")
    assert not (part.parent.parent / "elsewhere.nc").exists()


def test_many_differences_leave_the_question_and_its_answers_on_the_screen(own: Path, part: Path) -> None:
    operator = started(own, part)
    for number in range(1, 9):
        operator.press(str(number), "enter", "tab").type(f"{number}.5").press("home", *["up"] * 8)
    part.write_text(dumps(load(example("flange"))))
    told = " ".join(operator.press("ctrl+s").part("body").split())
    assert "Which gets the name?" in told
    assert "T THEIRS Y YOURS Esc back, nothing changes" in told
    assert "Against that yours has:" in told
