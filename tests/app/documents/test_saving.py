"""Saving: the questions asked first, a file open twice, and files changed by somebody else; both versions are kept."""

from __future__ import annotations

import errno
import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents import questions
from app.documents.document import MAX_BYTES
from app.documents.document_service import Opened, Saved, Trouble
from app.documents.files import load, save
from app.documents.journal_file import journal_path
from app.documents.lock import lock_path
from app.documents.paths import short_path
from app.documents.programs import empty_program, example
from app.documents.questions import QuestionText
from tests.app.documents.typist import (
    DEAD,
    ELSEWHERE,
    Typist,
    changed_by_another,
    names,
    number_in,
    service,
    started,
    words,
)
from tests.app.nc_lines import changed


def ask(operator: Typist, path: Path | None = None, *answers: str) -> QuestionText:
    question = operator.try_to_save(path, *answers)
    assert isinstance(question, QuestionText), question
    return question


def trouble(operator: Typist, path: Path | None = None, *answers: str) -> str:
    result = operator.try_to_save(path, *answers)
    assert isinstance(result, Trouble), result
    return result.text


# ---- names


def test_an_unnamed_program_is_saved_only_under_a_new_name(state: Path, part: Path) -> None:
    operator = started(state).type(7)
    assert trouble(operator) == "This program has no name yet. SAVE AS (Ctrl+K) gives it one."
    operator.save(part.with_name("other"))
    assert operator.said == "Saved: other.toml"
    assert operator.document.file.path == part.with_name("other.toml")
    assert not operator.document.unsaved
    assert number_in(part.with_name("other.toml")) == 7


def test_another_file_is_replaced_only_after_a_question(state: Path, file: Path) -> None:
    other = file.with_name(f"other{file.suffix}")
    other.write_text("not ours")
    operator = started(state, file).type(7)
    question = ask(operator, other)
    assert (question.title, [answer.word for answer in question.answers]) == ("REPLACE THE FILE?", ["REPLACE"])
    assert other.read_text() == "not ours"
    operator.save(other, "REPLACE")
    assert number_in(other) == 7
    assert number_in(file) == 1
    assert not lock_path(file).exists()
    assert lock_path(other).exists()
    assert not journal_path(file).exists()


def test_replacing_a_file_that_somebody_has_open_says_who(state: Path, file: Path) -> None:
    other = file.with_name(f"other{file.suffix}")
    other.write_bytes(file.read_bytes())
    started(state, other, ELSEWHERE, clock=ELSEWHERE.since)
    operator = started(state, file).type(7)
    assert "bob on office has it open." in words(ask(operator, other))
    operator.save(other, "REPLACE")
    assert operator.document.file.holder == ELSEWHERE


def test_a_failed_save_is_one_sentence_and_loses_nothing(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    assert trouble(operator, file.parent) == f"{file.parent} is not saved: this is a folder. Type a file's name."
    assert "there is no such file or folder. Check the name." in trouble(operator, file.parent / "none" / file.name)
    assert "that is not a file name" in trouble(operator, file.parent / "a\0b")
    assert "the name is too long" in trouble(operator, file.parent / ("n" * 300))
    assert operator.document.unsaved
    assert journal_path(file).exists()


def test_an_nc_text_never_overwrites_a_program(state: Path, tmp_path: Path) -> None:
    part, nc = tmp_path / "part.toml", tmp_path / "part.nc"
    save(empty_program(), part)
    nc.write_bytes(b"M30\n")
    operator = started(state, nc).type(7)
    assert "is a program and would be overwritten" in trouble(operator, part)
    assert "is a program and would be overwritten" in trouble(operator, part, "REPLACE")
    assert load(part) == empty_program()


def test_nothing_is_saved_over_a_file_that_is_open_here(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    other = file.with_name(f"other{file.suffix}")
    other.write_bytes(file.read_bytes())
    assert isinstance(operator.service.open(other), Opened)
    assert trouble(operator, other) == f"{other.name} is open here, too. Type another name."


# ---- other folders


@pytest.fixture
def outside(state: Path, file: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Typist, Path]:
    """A document in `shop`, opened from the folder `other` beside it."""
    other = file.parent.with_name("other")
    other.mkdir()
    monkeypatch.chdir(other)
    return started(state, Path("..") / "shop" / file.name).type(7), other


def test_a_bare_name_is_saved_beside_the_document_and_reported_with_its_folder(outside: tuple[Typist, Path]) -> None:
    operator, other = outside
    name = f"new{operator.document.file.path.suffix}"
    operator.save(Path(name))
    beside = other.with_name("shop") / name
    assert number_in(beside) == 7
    assert operator.said == f"Saved: {beside}"


@pytest.mark.parametrize("spelling", ["../{name}", "../other/{name}", "{whole}/{name}", "link-{name}"])
def test_saving_outside_the_folder_asks_once_with_the_full_path(outside: tuple[Typist, Path], spelling: str) -> None:
    operator, other = outside
    name = f"new{operator.document.file.path.suffix}"
    shop = other.with_name("shop")
    (shop / f"link-{name}").symlink_to(other / name)
    path = Path(spelling.format(name=name, whole=other))
    question = ask(operator, path)
    assert question.title == "WRITE IN ANOTHER FOLDER?"
    target = shop.parent / name if spelling == "../{name}" else other / name
    assert str(target.resolve()) in words(question)
    assert not target.exists()
    operator.save(path, "WRITE THERE")
    assert number_in(target) == 7


def test_one_question_covers_another_folder_and_replacing_a_file(outside: tuple[Typist, Path]) -> None:
    operator, other = outside
    target = other / f"there{operator.document.file.path.suffix}"
    target.write_text("somebody's")
    assert "Its content is replaced." in words(ask(operator, target))
    assert number_in(operator.save(target, "WRITE THERE").document.file.path) == 7


def test_saving_into_a_subfolder_asks_nothing(outside: tuple[Typist, Path]) -> None:
    operator, other = outside
    inside = other.with_name("shop") / "inside"
    inside.mkdir()
    operator.save(inside / f"new{operator.document.file.path.suffix}")


def test_saving_through_a_link_into_another_folder_asks_once(state: Path, file: Path) -> None:
    link = file.parent.parent / f"link{file.suffix}"
    link.symlink_to(file)
    operator = started(state, link).type(7)
    assert "is a link to" in words(ask(operator))
    assert number_in(file) == 1
    operator.save(None, "WRITE THERE")
    assert number_in(file) == 7
    assert link.is_symlink()
    operator.type(8).save()
    assert number_in(file) == 8


# ---- a file open twice


def test_the_second_opener_may_look_and_save_a_copy(state: Path, file: Path) -> None:
    started(state, file, replace(ELSEWHERE, since="2025-03-04T04:00:00+01:00"), clock=ELSEWHERE.since)
    operator = started(state, file)
    assert "OPEN ALREADY bob on office has had this program open since 05:00 today." in operator.asked
    later = started(state, file, clock="2025-03-06T08:00:00+01:00")
    assert "since 4 Mar 2025 05:00." in later.asked
    operator.answer("LOOK")
    assert operator.document.file.holder == ELSEWHERE
    assert trouble(operator).endswith("open since 05:00 today. SAVE AS (Ctrl+K) saves your own copy.")
    operator.save(file.with_name(f"mine{file.suffix}"))
    assert operator.document.file.holder is None
    operator.type(7).save()
    assert number_in(file.with_name(f"mine{file.suffix}")) == 7
    assert lock_path(file).exists()


def test_the_second_opener_may_take_over_the_work_of_the_first(state: Path, file: Path) -> None:
    first = started(state, file, ELSEWHERE).type(7)
    second = started(state, file).answer("TAKE OVER")
    assert f"UNSAVED WORK FOUND {file.name} by bob on office" in second.asked
    second.answer("RESTORE")
    assert second.work == first.work
    first.type(8)
    assert "has had this program open" in first.said
    assert first.said.endswith("SAVE AS (Ctrl+K) keeps your work.")
    assert "has had" not in first.type(9).said
    second.save()
    assert number_in(file) == 7


def test_taking_over_before_anything_was_typed_asks_nothing_more(state: Path, file: Path) -> None:
    first = started(state, file, ELSEWHERE)
    second = started(state, file).answer("TAKE OVER")
    assert second.asked == ""
    first.type(7)
    assert "has had this program open" in first.said


def test_work_saved_after_a_take_over_is_no_longer_discardable(state: Path, file: Path) -> None:
    first = started(state, file, ELSEWHERE).type(7)
    second = started(state, file).answer("TAKE OVER")
    first.save(None, "OVERWRITE")
    second.answer("LEAVE IT")
    assert "It was saved or discarded meanwhile." in second.said


def test_restoring_work_that_its_owner_has_saved_gives_it_a_new_journal(state: Path, file: Path) -> None:
    first = started(state, file, ELSEWHERE).type(7)
    second = started(state, file).answer("TAKE OVER")
    first.save(None, "OVERWRITE")
    second.answer("RESTORE")
    assert second.said.startswith("The work of bob on office is here.")
    assert journal_path(file).exists()


def test_the_first_opener_is_asked_before_it_saves_after_a_take_over(state: Path, file: Path) -> None:
    first = started(state, file, ELSEWHERE).type(7)
    started(state, file).answer("TAKE OVER").answer("LEAVE IT").type(3).save()
    question = ask(first)
    assert question.title == "TAKEN OVER: SAVE ANYWAY?"
    assert f"ann on {DEAD.host} has taken {file.name} over." in words(question)
    # the answer comes a little later
    first.service.clock = lambda: "2025-03-04T06:05:09+01:00"
    first.save(None, "KEEP BOTH")
    assert number_in(file) == 3
    mine = first.document.file.path
    assert mine.name.startswith("part.mine-")
    assert f"yours is saved as {mine.name}" in words(question)
    assert number_in(mine) == 7


@pytest.mark.parametrize(("answer", "number", "whose"), [("THEIRS", 3, "mine"), ("YOURS", 7, "theirs")])
def test_a_file_changed_by_another_program_is_noticed_and_both_versions_are_kept(
    state: Path, file: Path, answer: str, number: float, whose: str
) -> None:
    operator = started(state, file).type(7)
    changed_by_another(file, 3)
    question = ask(operator)
    assert question.title == "CHANGED MEANWHILE"
    assert f"{file.name} was changed by somebody else" in words(question)
    assert "Both are kept." in words(question)
    operator.save(None, answer)
    assert number_in(file) == number
    [copy] = [name for name in names(file) if whose in name and not name.startswith(".")]
    assert copy in operator.said or operator.document.file.path.name == copy
    if whose == "theirs":
        assert operator.said == f"Saved: {file.name}. The other version is in {copy}."
    assert {number_in(file.with_name(copy)), number_in(file)} == {3, 7}
    assert not operator.document.unsaved


def test_a_file_too_large_to_read_is_not_overwritten(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    size = MAX_BYTES[operator.document.kind] + 1
    os.truncate(file, size)
    assert trouble(operator) == (
        f"{short_path(file)} is not saved over what cannot be read: it is too large. SAVE AS (Ctrl+K) saves elsewhere."
    )
    assert file.stat().st_size == size
    operator.save(file.with_name(f"mine{file.suffix}"))
    assert not operator.document.unsaved


def test_an_nc_text_with_a_line_of_a_contour_program_can_be_saved_again(state: Path, tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_bytes(b"G20\nM2\n")
    operator = started(state, file)
    for line in ("format = 1", "G21"):
        operator.keep(operator.document.edited(changed(operator.document.text, 0, line), 0))
        operator.save()
    assert file.read_bytes() == b"G21\nM2\n"


def test_a_file_written_since_the_crash_is_reported_before_restoring_and_saving(state: Path, file: Path) -> None:
    started(state, file).type(7).killed()
    changed_by_another(file, 3)
    operator = started(state, file)
    assert "The file was written since: by somebody else, or by this program just before its end." in operator.asked
    operator.answer("RESTORE")
    assert ask(operator).title == "CHANGED MEANWHILE"


@pytest.mark.parametrize("call", ["write", "fsync"])
def test_a_full_disk_leaves_no_half_copy_of_the_other_version(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch, call: str
) -> None:
    operator = started(state, file).type(7)
    changed_by_another(file, 3)
    theirs, before = file.read_bytes(), names(file)

    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, call, full)
        text = trouble(operator, None, "YOURS")
    assert (
        text == "Nothing is saved: the other version cannot be copied, the disk is full. Make room or save elsewhere."
    )
    assert (file.read_bytes(), names(file)) == (theirs, before)


def test_a_file_rewritten_with_the_same_content_counts_as_unchanged(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    file.write_bytes(file.read_bytes())
    assert operator.save().said == f"Saved: {file.name}"


def test_a_file_made_unreadable_by_somebody_else_counts_as_changed(state: Path, part: Path) -> None:
    operator = started(state, part).type(3)
    part.write_bytes(b"no program")
    assert "It is no program any more." in words(ask(operator))


# ---- leaving


def test_leaving_asks_only_when_work_would_be_lost(state: Path, file: Path) -> None:
    operator = started(state, file)
    assert questions.leaving("QUIT?", [operator.document]) is None
    operator.type(7)
    unnamed = started(state).type(3).document
    question = questions.leaving("QUIT?", [operator.document, unnamed])
    assert question is not None
    assert question.lines == (f"{file.name} has changes that are not saved.", "This program was never saved.")
    example = questions.leaving("QUIT?", [replace(unnamed, title="pocket")])
    assert example is not None
    assert example.lines == ("pocket was never saved.",)
    assert [answer.word for answer in question.answers] == ["DISCARD", "SAVE"]
    assert question.safe == "GO BACK"


def test_saving_reports_unreadable_values_kept_as_typed(state: Path, part: Path) -> None:
    from core.program.edit import FormPlace, type_field
    from core.program.model import Program, Unread

    operator = started(state, part)
    document = operator.document
    program = type_field(document.program, FormPlace(1), "x_start", Unread("2..5", "no number"))
    assert isinstance(program, Program)
    operator.keep(document.edited(document.history.do(program, "X START"), FormPlace(1), "x_start"))
    assert operator.save().said == "Saved: part.toml, what is marked ERR as it was typed."


def test_saving_an_nc_text_changes_only_the_edited_line(state: Path, tmp_path: Path) -> None:
    nc = tmp_path / "part.nc"
    nc.write_bytes(b"\xef\xbb\xbfG0 X1\r\nG1 \xb0\r(no end)")
    operator = started(state, nc)
    operator.keep(operator.document.edited(changed(operator.document.text, 1, "G1"), 1)).save()
    assert nc.read_bytes() == b"\xef\xbb\xbfG0 X1\r\nG1\r(no end)"


def test_an_example_can_be_saved_under_a_new_name(state: Path, part: Path) -> None:
    documents = service(state)
    opened = documents.example("notch")
    assert opened.document.title == "notch"
    saved = documents.save(opened.document, part.with_name("notch"))
    assert isinstance(saved, Saved)
    assert load(part.with_name("notch.toml")) == load(example("notch"))
