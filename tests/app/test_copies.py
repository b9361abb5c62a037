"""Work that was set aside is listed by OPEN and can be had back."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load
from app.painted.screens.contour import Contour
from app.painted.screens.decide import Decide
from core.program.model import Number
from tests.app.kept import DEAD, Kept, asked, names, started


@pytest.fixture(autouse=True)
def person(own: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.painted.places.own_folder", lambda: own)


def chosen(operator: Kept, words: str) -> Kept:
    """Ctrl+O, and down to the line with these words."""
    operator.press("ctrl+o")
    lines = operator.part("body").splitlines()[1:]
    row = next(row for row, line in enumerate(lines) if words in line)
    return operator.press(*["down"] * row, "enter")


def test_discarded_work_comes_back_by_keys(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    operator = started(own, part).press("d", "y")
    assert "Ctrl+O lists it" in operator.said
    chosen(operator, "part.toml")
    operator.press("ctrl+o")
    body = operator.part("body")
    assert "discarded work, " in body
    assert ": part.toml" in body
    chosen(operator.press("escape"), "discarded work")
    assert "TOOL 7, was 1" in asked(operator)
    assert "LEAVE IT" in operator.part("softkeys")
    operator.press("r")
    assert operator.session.history == first.session.history
    assert operator.session.file == part
    operator.press("ctrl+s", "ctrl+q")
    assert load(part).blocks[0].tool == Number(7.0)
    assert [name for name in names(part) if "journal" in name] == [".part.toml.cutcomp-journal.discarded-1"]


def test_left_alone_it_stays_and_asks_nothing_more(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    operator = chosen(started(own, part).press("d", "y"), "discarded work").press("l")
    assert isinstance(operator.desk.page, Contour)
    assert operator.session.program == load(part)


def test_restored_from_a_copy_it_is_kept_anew(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    first = chosen(started(own, part).press("d", "y"), "discarded work").press("r").press("down").type("2.5")
    first.killed()
    assert started(own, part).press("r").session.history == first.session.history


def test_work_kept_for_another_can_be_had_too(own: Path, part: Path) -> None:
    from dataclasses import replace

    first = started(own, part).press("tab").type("7")
    first.killed()
    bob = started(own, part, replace(DEAD, user="bob", pid=DEAD.pid + 1)).press("d", "y")
    chosen(bob, "kept work").press("r")
    assert bob.session.history == first.session.history
    bob.press("ctrl+q", "l")
    assert started(own, part).press("r").session.history == first.session.history


def test_a_program_without_a_name(own: Path) -> None:
    first = started(own).press("tab").type("7")
    first.killed()
    operator = chosen(started(own).press("d", "y"), "a program without a name").press("r")
    assert operator.session.history == first.session.history
    assert operator.session.file is None


def test_what_is_not_saved_is_asked_about_first(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    operator = chosen(started(own, part).press("d", "y", "tab").type("9"), "discarded work")
    assert "NOT SAVED" in operator.part("header")
    operator.press("s")
    chosen(operator.press("escape"), "discarded work")
    assert "TOOL 7, was 9" in asked(operator)


def test_a_file_that_is_gone_comes_back_from_its_copy(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    operator = started(own, part).press("d", "y")
    part.unlink()
    chosen(operator, "discarded work").press("r", "ctrl+s")
    assert load(part) == first.session.program


def test_a_file_that_is_cut_off_does_not_keep_its_copy_from_anybody(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    operator = started(own, part).press("d", "y")
    part.write_bytes(part.read_bytes()[:100])
    chosen(operator, "discarded work")
    assert "itself cannot be read" in asked(operator)
    operator.press("r")
    assert operator.session.history == first.session.history
    rest = part.read_bytes()
    operator.press("ctrl+s", "y")
    assert load(part) == first.session.program
    assert [one.read_bytes() for one in part.parent.glob("part.theirs-*")] == [rest]


def test_a_copy_that_cannot_be_read_says_so(own: Path, part: Path) -> None:
    part.with_name(".part.toml.cutcomp-journal.kept-1").write_text("nothing")
    operator = started(own, part)
    assert isinstance(operator.desk.page, Decide)
    operator.press("g")
    assert "cannot be read" in chosen(operator, "kept work").said


def test_a_name_that_is_cut_in_the_journal_s_name_is_found_again(own: Path, part: Path) -> None:
    long = part.rename(part.with_name(f"{'p' * 210}.toml"))
    first = started(own, long).press("tab").type("7")
    first.killed()
    operator = started(own, long).press("d", "y").press("ctrl+o")
    rows = operator.part("body").splitlines()[1:]
    row = next(row for row, line in enumerate(rows) if "discarded work" in line)
    operator.press(*["down"] * row, "enter", "r")
    assert operator.session.file == long
    assert operator.session.history == first.session.history
