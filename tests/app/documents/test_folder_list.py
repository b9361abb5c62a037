"""The facts in the list of files: unsaved work takes precedence over the verdict on the saved program."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path
from threading import Event

import pytest

from app.documents import folder_list
from app.documents.files import load
from app.documents.folder_list import Outcome, facts_of, openable_files
from app.documents.journal_file import JOURNAL_SUFFIX, journal_path
from app.documents.programs import examples
from app.session.posting import setup_sheet
from tests.app.documents.typist import ELSEWHERE, started


@pytest.fixture(autouse=True)
def person(state: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folder_list, "state_folder", lambda: state)
    monkeypatch.setattr(folder_list, "user", lambda: "ann")


def names(folder: Path) -> list[str]:
    return [program.name for program in openable_files(folder) if not (program.folder or program.example)]


def test_a_saved_program_shows_its_verdict(part: Path) -> None:
    facts = facts_of(part)
    assert (facts.outcome, facts.blocks, facts.tools, facts.trouble) == (Outcome.UNCUT, "1", "1", "")
    assert facts_of(part, facts) is facts


def test_unsaved_work_takes_precedence_over_the_verdict(state: Path, part: Path) -> None:
    before = facts_of(part)
    started(state, part).type(7).killed()
    facts = facts_of(part, before)
    assert (facts.outcome, facts.blocks) == (Outcome.NOT_SAVED, "1")
    assert "Opening it asks whether you want it back." in facts.trouble
    started(state, part).answer("RESTORE").save().left()
    assert facts_of(part, facts).outcome is not Outcome.NOT_SAVED


def test_work_equal_to_the_file_does_not_count_as_unsaved(state: Path, part: Path) -> None:
    operator = started(state, part).type(7)
    operator.killed()
    part.write_bytes(operator.document.data())
    assert facts_of(part).outcome is not Outcome.NOT_SAVED


@pytest.mark.parametrize("closed", [False, True])
def test_a_never_saved_program_is_listed(
    state: Path, part: Path, monkeypatch: pytest.MonkeyPatch, *, closed: bool
) -> None:
    if closed:
        monkeypatch.setattr(os, "access", lambda *_: False)
    started(state, part.with_name("flap.toml")).type(7).killed()
    part.with_name(f".lost.nc{JOURNAL_SUFFIX}").write_text("an NC text's own")
    assert names(part.parent) == ["flap", "part"]
    assert facts_of(part.with_name("flap.toml")).outcome is Outcome.NOT_SAVED


def test_damaged_work_on_a_never_saved_program_is_reported(part: Path) -> None:
    journal_path(part.with_name("flap.toml")).write_bytes(b"?" * 300)
    facts = facts_of(part.with_name("flap.toml"))
    assert facts.outcome is Outcome.UNREADABLE
    assert "cannot be read. It is kept" in facts.trouble
    journal_path(part.with_name("flap.toml")).write_bytes(b"")
    assert names(part.parent) == ["part"]


def test_a_never_saved_program_being_typed_counts_as_open(state: Path, part: Path) -> None:
    started(state, part.with_name("flap.toml"), ELSEWHERE).type(7)
    assert facts_of(part.with_name("flap.toml")).outcome is Outcome.OPEN
    assert names(part.parent) == ["flap", "part"]


def test_a_hanging_file_does_not_delay_the_others(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    never, real = Event(), Path.stat
    monkeypatch.setattr(folder_list, "FILE_SECONDS", 0.05)
    monkeypatch.setattr(
        Path, "stat", lambda path, **rest: never.wait(5) if path.name == "a.toml" else real(path, **rest)
    )
    facts = facts_of(part.with_name("a.toml"))
    assert facts.outcome is Outcome.UNREADABLE
    assert "no answer" in facts.trouble
    never.set()
    assert facts_of(part.with_name("b.toml")).trouble.startswith("This file is not there any more")


def test_opening_a_hanging_file_is_reported(state: Path, part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from app.documents import document_service as module
    from app.documents.document_service import Trouble
    from tests.app.documents.typist import service

    never = Event()
    monkeypatch.setattr(module, "FILE_SECONDS", 0.05)
    monkeypatch.setattr("app.documents.files.read_file", lambda *_: never.wait(5))
    opened = service(state).open(part)
    never.set()
    assert isinstance(opened, Trouble)
    assert "cannot be opened: no answer" in opened.text


def test_drawings_and_nc_programs_are_listed_after_the_programs(part: Path) -> None:
    for name in ("a.NC", "b.dxf", "c.tap", "d.pdf", ".e.nc"):
        (part.parent / name).write_text("M30\n")
    (part.parent / "f.nc").mkdir()
    (part.parent / "sheet.txt").write_text(setup_sheet(load(part), part.parent / "sheet.txt", datetime.now(UTC)))
    (part.parent / "x.txt").write_text("G0 X0\nM30\n")
    listed = [
        (program.name, program.kind)
        for program in openable_files(part.parent)
        if not (program.folder or program.example)
    ]
    others = [("b.dxf", "drawing"), ("a.NC", "NC program"), ("c.tap", "NC program"), ("x.txt", "NC program")]
    assert listed == [(part.stem, ""), *others]


def test_each_example_is_listed_once_in_the_examples_folder() -> None:
    listed = [program for program in openable_files(examples()) if program.program]
    assert listed
    assert all(program.example for program in listed)
    assert len({program.path for program in listed}) == len(listed)
