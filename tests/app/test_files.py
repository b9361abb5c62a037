"""Saving, opening, posting and leaving, each as the operator does it."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.screens.ask import Ask
from app.painted.screens.contour import Contour
from app.painted.screens.program import ProgramPage
from app.painted.screens.save import SaveAsPage
from app.painted.session import Session
from core.output.objections import OVERRIDE
from core.program.model import Number
from tests.app.operator import Operator


def opened(name: str) -> Operator:
    """An operator on an example part that has no file of its own yet."""
    return Operator(Desk(Session.of(load(example(name)))))


def entered(operator: Operator, text: str) -> Operator:
    """A path typed over what the dialog offers."""
    return operator.press("delete", *text, "enter")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_save_asks_for_a_name_first_and_then_no_more(folder: Path) -> None:
    operator = opened("pocket").press("ctrl+s")
    assert "SAVE AS" in operator.part("header")
    entered(operator, str(folder / "part"))
    assert load(folder / "part.toml") == operator.session.program
    assert operator.session.file == folder / "part.toml"
    assert isinstance(operator.desk.page, Contour)
    operator.press("tab", "9", "ctrl+s")
    assert load(folder / "part.toml").blocks[0].tool == Number(9.0)
    assert not operator.session.unsaved


def test_another_file_is_replaced_only_after_asking(folder: Path) -> None:
    (folder / "part.toml").write_text("not ours")
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "part.toml"))
    assert isinstance(operator.desk.page, Ask)
    operator.press("escape")
    assert (folder / "part.toml").read_text() == "not ours"
    operator.press("enter", "r")
    assert load(folder / "part.toml") == operator.session.program
    assert isinstance(operator.desk.page, Contour)


@pytest.mark.parametrize("name", ["missing/part.toml", "."])
def test_what_cannot_be_saved_is_one_sentence_and_nothing_is_lost(folder: Path, name: str) -> None:
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / name))
    if isinstance(operator.desk.page, Ask):
        operator.press("r")
    assert "is not saved" in operator.said
    assert operator.session.file is None
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("keys", [(), ("f6",), ("f7",), ("f8",), ("tab", "9")])
def test_a_save_that_fails_says_how_to_save_elsewhere_and_it_is_so(folder: Path, keys: tuple[str, ...]) -> None:
    (folder / "sub").mkdir()
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "sub" / "part.toml"))
    (folder / "sub" / "part.toml").unlink()
    (folder / "sub").rmdir()
    operator.press(*keys, "ctrl+s")
    assert "part.toml is not saved" in operator.said
    assert operator.said.endswith("SAVE AS: F8 until PROGRAM, then F7, F3.")
    while not isinstance(operator.desk.page, ProgramPage):
        operator.press("f8")
    assert isinstance(operator.press("f7", "f3").desk.page, SaveAsPage)
    entered(operator, str(folder / "none" / "part.toml"))
    operator.press("w")
    assert "SAVE AS: " not in operator.said
    entered(operator, str(folder / "here.toml")).press("w")
    assert load(folder / "here.toml") == operator.session.program


def test_open_lists_programs_and_folders_and_opens_one(folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "note.txt").write_text("no program")
    entered(opened("notch").press("ctrl+s"), str(folder / "notch.toml"))
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "pocket.toml")).press("ctrl+o")
    assert [line.strip(" >") for line in operator.part("body").splitlines()[1:5]] == [
        "../",
        "notch.toml",
        "pocket.toml",
        "sub/",
    ]
    operator.press("down", "enter")
    assert operator.session.file == folder / "notch.toml"
    assert operator.said == f"Opened: {folder / 'notch.toml'}"


def test_opening_over_changes_asks(folder: Path) -> None:
    entered(opened("notch").press("ctrl+s"), str(folder / "notch.toml"))
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "pocket.toml"))
    changed = operator.press("tab", "9", "enter").session.program
    operator.press("ctrl+o", "down", "enter")
    assert "changes that are not saved" in operator.part("body")
    operator.press("s")
    assert load(folder / "pocket.toml") == changed
    operator.press("enter")
    assert operator.session.file == folder / "notch.toml"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("format = 1\nunits = 'IN'\ncolor = 3\n", ("line 3", "color")),
        ("format = 1\nunits = ", ("line 2",)),
        ("format = 1\nunits = 'IN'\n[[block]]\nkind = 'MILL CONTOUR'\nx_start = nan\n", ("line 5", "x_start")),
        ("format = 1\nunits = 'IN'\n[[block]]\nkind = 'MILL CONTOUR'\nspeed = 'fast'\n", ("line 5", "speed")),
    ],
)
def test_a_file_that_is_no_program_is_told_by_line_and_key(folder: Path, content: str, words: tuple[str, ...]) -> None:
    (folder / "bad.toml").write_text(content)
    operator = opened("pocket")
    before = operator.session.program
    operator.press("ctrl+o", *str(folder / "bad.toml"), "enter")
    for word in words:
        assert word in str(operator.session.said)
    assert operator.session.program is before
    assert (folder / "bad.toml").read_text() == content


def test_a_folder_that_is_not_there_is_told(folder: Path) -> None:
    operator = opened("pocket").press("ctrl+o", *f"{folder}/none/", "enter")
    assert "cannot be shown" in operator.said


def to_post(operator: Operator) -> Operator:
    return operator.press("f8", "f6")


def test_posting_writes_the_file(folder: Path) -> None:
    operator = entered(to_post(opened("pocket")), str(folder / "pocket"))
    text = (folder / "pocket.nc").read_text()
    assert "M30" in text
    assert "OVERRIDDEN" not in text
    assert "Posted" in operator.said
    assert "PROGRAM" in operator.part("header")


def test_a_path_that_gouges_is_posted_only_in_so_many_words(folder: Path) -> None:
    from core.pipeline.derive import derive

    operator = opened("notch")
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    entered(to_post(operator), str(folder / "square.nc"))
    assert "POST WITH GOUGE" in operator.said
    operator.type("yes")
    assert "Nothing was written" in operator.said
    assert list(folder.iterdir()) == []
    operator.press(*["backspace"] * 3).type(OVERRIDE)
    assert f"OVERRIDDEN BY THE OPERATOR: {OVERRIDE}" in (folder / "square.nc").read_text()


def test_what_is_unreadable_cannot_be_posted_in_any_words(folder: Path) -> None:
    from core.pipeline.derive import derive

    operator = opened("pocket").press("tab", "tab", "tab", "tab").type("2..5")
    operator.desk = operator.desk.knowing(derive(operator.session.program))
    entered(to_post(operator), str(folder / "pocket.nc"))
    assert "Mend this first" in operator.said
    assert "X START" in operator.said
    assert OVERRIDE not in "\n".join(operator.screen())
    operator.type(OVERRIDE)
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize(
    ("keys", "text", "word"), [(("tab",) * 4, "1..2", "X START"), (("4", "enter", "tab"), "9", "segment 4")]
)
def test_words_that_override_are_offered_only_where_they_do(
    folder: Path, keys: tuple[str, ...], text: str, word: str
) -> None:
    """A gouge beside a text that cannot be read, a blend arc that does not fit: no words help."""
    from app.cli.posting import nc_text
    from core.output.nc import Refusal
    from core.pipeline.derive import derive

    operator = opened("pocket").press(*keys).type(text)
    derived = derive(operator.session.program)
    operator.desk = operator.desk.knowing(derived)
    assert isinstance(nc_text(derived, "pocket", OVERRIDE, None), Refusal)
    to_post(operator)
    assert "cannot be posted" in operator.said
    entered(operator, str(folder / "pocket.nc"))
    assert word in operator.said
    assert OVERRIDE not in "\n".join(operator.screen())
    assert list(folder.iterdir()) == []


def test_posting_with_what_was_derived_before_the_last_edit_is_not_possible(folder: Path) -> None:
    """The NC text comes from the program, not from what the screens happen to show."""
    operator = opened("pocket").press("tab", "tab", "tab", "tab").type("2.1")
    entered(to_post(operator), str(folder / "pocket.nc"))
    assert not (folder / "pocket.nc").exists() or "X2.1" in (folder / "pocket.nc").read_text()


def test_leaving_asks_only_when_something_would_be_lost(folder: Path) -> None:
    assert opened("pocket").press("f8", "f8").desk.exit
    assert opened("pocket").press("ctrl+q").desk.exit
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "pocket.toml")).press("tab").type("9")
    operator.press("ctrl+q")
    assert not operator.desk.exit
    assert not operator.press("escape").desk.exit
    assert operator.press("ctrl+q", "l").desk.exit
    assert load(folder / "pocket.toml").blocks[0].tool == Number(1.0)


def test_save_and_leave_saves(folder: Path) -> None:
    operator = entered(opened("pocket").press("ctrl+s"), str(folder / "pocket.toml")).press("tab").type("9")
    operator.press("ctrl+q", "s")
    assert operator.desk.exit
    assert load(folder / "pocket.toml").blocks[0].tool == Number(9.0)


def test_save_and_leave_without_a_name_asks_for_one_and_then_leaves(folder: Path) -> None:
    operator = opened("pocket").press("tab").type("9").press("ctrl+q", "s")
    assert not operator.desk.exit
    assert entered(operator, str(folder / "part.toml")).desk.exit
    assert load(folder / "part.toml").blocks[0].tool == Number(9.0)
