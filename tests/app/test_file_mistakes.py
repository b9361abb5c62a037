"""An operator's mistakes with files, on the screens: each ends in a plain sentence, and nothing is lost."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from textual.widgets import DataTable, Input

from app.app import CutcompApp
from app.documents.files import load
from app.documents.programs import example
from app.documents.service import DocumentService
from app.file_actions import session_of
from app.nc_proof.screen import ProofScreen
from app.screens.contour import ContourScreen
from app.screens.dialogs import Phrase, Question
from app.screens.home import HomeScreen
from app.session.session import Session
from core.program.model import Number
from tests.app.test_file_actions import DEAD, at_work, folder, journals
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator

__all__ = ["folder"]


def visible(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir() if not path.name.startswith(".")} - {"settings.toml"}


async def entered(one: Operator, action: str, name: str) -> None:
    """A name typed on SAVE AS or OPEN A PATH, over the one that stands there."""
    await one.app.run_action(action)
    await one.pilot.pause()
    one.screen.query_one("#entry", Input).value = name
    await one.press("enter")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("", "Type a name."),
        ("/", "this is a folder"),
        ("missing/x", "there is no such file or folder"),
        ("part.toml/x", "a part of the path is no folder"),
        ("~nobody_at_all/x", "there is no such file or folder"),
        ("x" * 300, "the name is too long"),
    ],
)
async def test_a_name_that_cannot_be_saved_under_is_said_and_the_next_character_replaces_it(folder, name, words):
    async with at_work(folder) as one:
        before = visible(folder)
        await entered(one, "app.save_as", name)
        assert words in one.prompt
        assert len(one.prompt) < 160
        assert visible(folder) == before
        await one.press("y", "enter")
        assert one.session.file == folder / "y.toml"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing/x.toml", "there is no such file or folder"),
        ("none.nc", "there is no such file or folder"),
        ("~nobody_at_all", "does not exist yet: saving makes it"),
        ("x" * 300, "the name is too long"),
        ("pyproject.toml", "not a cutcomp program"),
        ("pipe", "this is a pipe"),
        ("/dev/zero", "this is a device"),
        ("part", "part.toml is open already"),
    ],
)
async def test_what_cannot_be_opened_is_said_and_the_program_stays(folder, name, words):
    (folder / "pyproject.toml").write_text("[project]\nname = 'x'\n")
    os.mkfifo(folder / "pipe")
    async with at_work(folder) as one:
        await one.press("tab", "'7", "enter")
        await entered(one, "app.open_path", name)
        if isinstance(one.app.screen, Question):
            await one.press("escape")
        else:
            assert words in one.prompt
            assert len(one.prompt) < 160
        assert one.session.block.tool == Number(7.0)
        assert journals(folder) == [".part.toml.cutcomp-journal"]


async def test_a_folder_typed_as_a_path_shows_its_files(folder):
    async with at_work(folder) as one:
        await entered(one, "app.open_path", "..")
        assert isinstance(one.app.screen, HomeScreen)
        assert one.app.screen.folder.resolve() == folder.parent.resolve()


async def test_a_number_that_no_enter_followed_is_saved_and_asked_about(folder):
    async with at_work(folder) as one:
        await one.press("tab", "'7", "ctrl+s")
        assert load(folder / "part.toml").blocks[0].tool == Number(7.0)
        await one.press("'8", "ctrl+q")
        assert isinstance(one.app.screen, Question)
        await one.press("escape")
        assert one.session.block.tool == Number(8.0)


async def test_a_text_that_is_no_number_is_mended_before_it_is_saved(folder):
    async with at_work(folder) as one:
        await one.press("tab", "'9x", "ctrl+s")
        assert one.prompt.startswith("9x cannot be read.")
        assert load(folder / "part.toml").blocks[0].tool == Number(1.0)


async def test_a_line_of_an_nc_text_that_the_cursor_has_not_left_is_asked_about(folder):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as one:
        one.app.open_file(folder / "a.nc")
        await one.settle()
        await one.press("enter", "x", "ctrl+q")
        assert isinstance(one.app.screen, Question)
        await one.press("s")
    assert (folder / "a.nc").read_bytes() == b"xG20 G17\nM30\n"


async def test_quit_and_save_of_a_program_without_a_name_asks_for_one_and_then_leaves(folder):
    service = DocumentService(state=folder / "own")
    opened = service.new()
    app = CutcompApp(session_of(opened.document), surroundings=SURROUNDINGS, service=service, opened=opened)
    async with app.run_test(size=(80, 24)) as pilot:
        one = Operator(app, pilot)
        await one.press("'7", "ctrl+q", "s")
        assert isinstance(app.screen, Phrase)
        await one.press("escape")
        assert app.return_code is None
        await one.press("ctrl+q", "s", *"lid", "enter")
        assert app.return_code == 0
    assert load(folder / "lid.toml").blocks[0].tool == Number(7.0)


@pytest.mark.parametrize(("key", "saved"), [("d", b"G20 G17\nM30\n"), ("s", b"xG20 G17\nM30\n")])
async def test_a_program_opened_over_an_nc_text_asks_about_its_lines_and_closes_it(folder, key, saved):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as one:
        one.app.open_file(folder / "a.nc")
        await one.settle()
        await one.press("enter", "x", "down", "ctrl+o", "n", "enter")
        assert isinstance(one.app.screen, Question)
        assert "a.nc has changes" in one.app.screen.lines[0]
        await one.press("escape")
        assert len(one.app.proofs) == 1
        await one.press("enter", key)
        assert isinstance(one.app.screen, ContourScreen)
        assert one.session.title == "notch"
        assert [path.name for path in folder.iterdir() if path.name.startswith(".")] == []
    assert (folder / "a.nc").read_bytes() == saved


async def test_the_form_brought_to_the_front_over_an_nc_text_asks_about_its_lines(folder):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as one:
        one.app.open_file(folder / "a.nc")
        await one.settle()
        await one.press("enter", "x", "down", "escape")
        await one.app.run_action("app.contour")
        await one.settle()
        assert isinstance(one.app.screen, Question)
        await one.press("escape")
        assert isinstance(one.app.screen, ProofScreen)
        assert one.app.screen.document.unsaved


async def test_under_a_question_no_key_saves_opens_or_asks_a_second_one(folder):
    async with at_work(folder) as one:
        await one.press("tab", "'7", "enter", "ctrl+q")
        for key in ("ctrl+s", "ctrl+o", "ctrl+z", "x", "5"):
            await one.press(key)
            assert isinstance(one.app.screen, Question)
        assert load(folder / "part.toml").blocks[0].tool == Number(1.0)
        await one.press("ctrl+q")
        assert isinstance(one.app.screen, ContourScreen)
        assert one.session.block.tool == Number(7.0)


async def test_work_that_was_discarded_is_listed_among_the_files_and_comes_back(folder, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))
    async with at_work(folder, me=DEAD) as one:
        await one.press("tab", "'7", "enter")
        kept = (folder / ".part.toml.cutcomp-journal").read_bytes()
    (folder / ".part.toml.cutcomp-journal").write_bytes(kept)
    async with at_work(folder) as one:
        await one.press("d")
        assert "Ctrl+O lists it" in one.prompt
        assert one.session.block.tool == Number(1.0)
        await one.press("ctrl+o", "ctrl+end")
        table = one.screen.query_one("#programs", DataTable)
        assert [str(cell) for cell in table.get_row_at(table.cursor_row)][::4] == ["part.toml", "discarded"]
        assert one.prompt.startswith("Unsaved work on part.toml, discarded")
        await one.press("enter")
        assert isinstance(one.app.screen, Question)
        await one.press("r")
        assert one.session.block.tool == Number(7.0)
        assert one.session.file == folder / "part.toml"


async def test_what_may_only_be_looked_at_says_so_in_the_title_until_it_is_a_copy(folder):
    theirs = DocumentService(state=folder / "their-own")
    theirs.open(folder / "part.toml")
    async with at_work(folder) as one:
        await one.press("l")
        assert one.session.file_label == "LOOK ONLY part"
        await one.press("tab", "'7", "enter", "ctrl+s")
        assert one.prompt.endswith("SAVE AS (Ctrl+K) saves your own copy.")
        await entered(one, "app.save_as", "mine")
        assert one.session.file_label == "mine"
        assert one.session.block.tool == Number(1.0)
    theirs.stop()


async def test_what_is_typed_where_one_may_only_look_is_not_left_standing(folder):
    theirs = DocumentService(state=folder / "their-own")
    theirs.open(folder / "part.toml")
    async with at_work(folder) as one:
        await one.press("l", "tab", "tab", "tab", "tab", "'5")
        assert one.at == "x_start"
        await one.press("enter")
        assert (one.at, one.value("x_start")) == ("x_start", "2.0000")
        assert one.prompt.endswith("SAVE AS (Ctrl+K) makes a copy of your own.")
        assert one.app.shown is one.session
        await one.press("up", "up", "right")
        assert one.value("cutter_comp") == "LEFT"
    theirs.stop()


async def test_a_sentence_of_opening_goes_with_the_next_field_and_with_a_save(folder):
    async with at_work(folder) as one:
        assert one.prompt.startswith("Opened: ")
        await entered(one, "app.save_as", "mine")
        assert "Opened" not in one.prompt


async def test_characters_and_colors_that_were_chosen_are_kept(folder):
    async with at_work(folder) as one:
        await one.app.run_action("app.next_characters")
        await one.app.run_action("app.light_or_dark")
        text = (folder / "settings.toml").read_text()
        assert 'characters = "block"' in text
        assert 'theme = "light"' in text


async def test_a_question_for_which_there_is_no_room_is_not_answered_unread():
    async with operator(size=(20, 5)) as one:
        assert isinstance(one.app, CutcompApp)
        answers: list[str | None] = []
        lines = ["part.toml is open on another terminal since 7:15. Look at it, or take it over."]
        from app.documents.questions import Answer

        one.app.push_screen(
            Question("OPEN ALREADY", lines, [Answer("LOOK"), Answer("TAKE OVER")], "LOOK"), answers.append
        )
        await one.pilot.pause()
        await one.press("l", "t", "enter")
        assert answers == []
        await one.pilot.resize_terminal(80, 24)
        await one.pilot.pause()
        await one.press("t")
        assert answers == ["TAKE OVER"]


async def test_the_current_folder_may_go_away(folder, monkeypatch):
    gone = folder / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    service = DocumentService(state=folder / "own")
    opened = service.new()
    app = CutcompApp(Session.of(load(example("pocket"))), service=service, opened=opened)
    async with app.run_test(size=(80, 24)) as pilot:
        one = Operator(app, pilot)
        gone.rmdir()
        await entered(one, "app.save_as", "lid")
        assert "there is no such file or folder" in one.prompt
        await one.press("escape", "ctrl+o")
        assert isinstance(app.screen, HomeScreen)
    service.stop()


@pytest.mark.parametrize("action", ["app.post", "app.sheet"])
async def test_what_is_made_of_a_program_asks_before_another_folder_or_a_file_and_never_replaces_a_program(
    folder, action
):
    (folder.parent / "x.txt").write_text("somebody's")
    async with at_work(folder) as one:
        await one.app.run_action(action)
        await one.app.workers.wait_for_complete()
        await one.pilot.pause()
        screen = one.screen
        for name, title in (("../x.txt", "WRITE IN ANOTHER FOLDER?"), ("settings.toml", ""), ("note.txt", "REPLACE")):
            (folder / "note.txt").write_text("somebody's")
            screen.query_one("#entry", Input).value = name
            await one.press("enter")
            if not title:
                assert "is a program and would be overwritten" in one.prompt
                continue
            assert isinstance(one.app.screen, Question)
            assert one.app.screen.question.startswith(title)
            assert "Its content is replaced." in " ".join(one.app.screen.lines)
            await one.press("escape")
        assert {(folder.parent / "x.txt").read_text(), (folder / "note.txt").read_text()} == {"somebody's"}
        await one.press("enter", "r")
        await one.app.workers.wait_for_complete()
        assert (folder / "note.txt").read_text() != "somebody's"
