"""An operator's mistakes with files on the screens: each ends in a plain sentence, and nothing is lost."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from textual.widgets import DataTable, Input, Label

from app.app import CutcompApp
from app.documents.document_service import DocumentService, Opened
from app.documents.files import load
from app.documents.programs import example
from app.file_actions import session_of
from app.nc_proof.screen import ProofScreen
from app.screens.contour import ContourScreen
from app.screens.dialogs import Phrase, Question
from app.screens.home import HomeScreen
from app.session.session import Session
from core.program.file.write import dumps
from core.program.model import Number
from tests.app.test_file_actions import DEAD, at_work, folder, journals
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator

__all__ = ["folder"]


def visible(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir() if not path.name.startswith(".")} - {"settings.toml"}


async def entered(user: Operator, action: str, name: str) -> None:
    """Type a name over the one on SAVE AS or OPEN A PATH, and press Enter."""
    await user.app.run_action(action)
    await user.settle()
    user.screen.query_one("#entry", Input).value = name
    await user.press("enter")


UNUSABLE = {
    "": "Type a name.",
    "/": "this is a folder",
    "missing/x": "there is no such file or folder",
    "part.toml/x": "a part of the path is no folder",
    "~nobody_at_all/x": "there is no such file or folder",
    "x" * 300: "the name is too long",
}


async def test_an_unusable_file_name_is_explained_and_replaced_by_typing(folder):
    async with at_work(folder) as user:
        before = visible(folder)
        for name, words in UNUSABLE.items():
            await entered(user, "app.save_as", name)
            assert words in user.prompt, name
            assert len(user.prompt) < 160, name
            assert visible(folder) == before, name
            await user.press("escape")
        await entered(user, "app.save_as", "missing/x")
        await user.press("y", "enter")
        assert user.session.file == folder / "y.toml"


async def test_the_list_of_files_shows_every_verdict_in_full_beside_its_scrollbar(folder):
    for number in range(12):
        (folder / f"unread{number}.toml").write_text("format = 2\nunits = 3\n", encoding="utf-8")
    async with at_work(folder) as user:
        await user.press("ctrl+o")
        table = user.screen.query_one(DataTable)
        assert table.show_vertical_scrollbar
        shown = [
            "".join(segment.text for segment in strip) for strip in map(table.render_line, range(table.size.height))
        ]
        assert sum("? unreadable" in line for line in shown) >= 5
        await user.press("end")
        assert (table.cursor_row, table.scroll_x) == (table.row_count - 1, 0)
        await user.press("home")
        assert (table.cursor_row, table.scroll_x) == (0, 0)


UNOPENED = {
    "missing/x.toml": "there is no such file or folder",
    "none.nc": "there is no such file or folder",
    "x" * 300: "the name is too long",
    "pyproject.toml": "not a cutcomp program",
    "pipe": "this is a pipe",
    "/dev/zero": "this is a device",
    "part": "part.toml is open already",
}


async def test_a_failed_open_keeps_the_program(folder):
    (folder / "pyproject.toml").write_text("[project]\nname = 'x'\n")
    os.mkfifo(folder / "pipe")
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")
        for name, words in UNOPENED.items():
            await entered(user, "app.open_path", name)
            assert words in user.prompt, name
            assert len(user.prompt) < 160, name
            assert user.session.block.tool == Number(7.0), name
            assert journals(folder) == [".part.toml.cutcomp-journal"], name
            await user.press("escape")


async def test_a_new_name_to_open_asks_about_the_unsaved_work_and_back_keeps_the_program(folder):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")
        await entered(user, "app.open_path", "~nobody_at_all")
        question = user.app.screen
        assert isinstance(question, Question)
        assert question.lines == ("part.toml has changes that are not saved.",)
        await user.press("escape")
        assert user.prompt.startswith("Path of a program")
        assert user.session.block.tool == Number(7.0)
        assert journals(folder) == [".part.toml.cutcomp-journal"]


async def test_a_folder_typed_as_a_path_shows_its_files(folder):
    async with at_work(folder) as user:
        assert user.prompt.startswith("Opened: ")
        await entered(user, "app.save_as", "mine")
        assert "Opened" not in user.prompt, "a save removes the message"
        await entered(user, "app.open_path", "..")
        assert isinstance(user.app.screen, HomeScreen)
        assert user.app.screen.folder.resolve() == folder.parent.resolve()
        await user.app.run_action("app.open_path")
        await user.settle()
        assert Path(user.app.screen.query_one(Input).value).resolve() == folder.parent.resolve()
        await user.press("escape")
        await user.app.run_action("app.next_characters")
        await user.app.run_action("app.light_or_dark")
        text = (folder / "settings.toml").read_text()
        assert 'characters = "block"' in text
        assert 'theme = "light"' in text


async def test_a_number_typed_without_enter_is_saved_and_asked_about(folder):
    async with at_work(folder) as user:
        await user.press("tab", "'7")
        file, state = (user.screen.query_one(name, Label) for name in ("#file", "#undo"))
        assert (str(file.content), str(state.content)) == ("part", "saved")
        await user.press("escape", "'9x", "ctrl+s")
        assert user.prompt.startswith("9x cannot be read."), "an unreadable number is not saved"
        (said,) = [each.message for each in user.app._notifications]
        assert said == "NOT SAVED: correct the field, then Ctrl+S."
        assert load(folder / "part.toml").blocks[0].tool == Number(1.0)
        await user.press("escape", "'7", "ctrl+s")
        assert load(folder / "part.toml").blocks[0].tool == Number(7.0)
        await user.press("'8", "ctrl+q")
        assert isinstance(user.app.screen, Question)
        await user.press("escape")
        assert (user.value("tool"), user.session.block.tool) == ("8", Number(7.0))
        await user.press("enter")
        assert (str(file.content), str(state.content)) == ("part *", "not saved   undo 2")


async def test_an_nc_line_still_being_typed_is_asked_about(folder):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as user:
        user.app.open_file(folder / "a.nc")
        await user.settle()
        await user.press("enter", "x", "down", "escape")
        await user.app.run_action("app.contour")
        await user.settle()
        assert isinstance(user.app.screen, Question), "returning to the form"
        await user.press("escape")
        assert isinstance(user.app.screen, ProofScreen)
        assert user.app.screen.document.unsaved
        await user.press("ctrl+z", "enter", "x", "ctrl+q")
        assert isinstance(user.app.screen, Question), "quitting"
        await user.press("s")
    assert (folder / "a.nc").read_bytes() == b"xG20 G17\nM30\n"


async def test_saving_an_unnamed_program_at_quit_asks_for_a_name_and_then_leaves(folder):
    service = DocumentService(state=folder / "own")
    opened = service.new()
    app = CutcompApp(session_of(opened.document), surroundings=SURROUNDINGS, service=service, opened=opened)
    async with Operator.of(app) as user:
        await user.press("'7", "ctrl+q", "s")
        assert isinstance(app.screen, Phrase)
        await user.press("escape")
        assert app.return_code is None
        await user.press("ctrl+q", "s", *"lid", "enter")
        assert app.return_code == 0
    assert load(folder / "lid.toml").blocks[0].tool == Number(7.0)


@pytest.mark.parametrize(("key", "saved"), [("d", b"G20 G17\nM30\n"), ("s", b"xG20 G17\nM30\n")])
async def test_opening_a_program_over_an_edited_nc_text_asks_and_closes_the_text(folder, key, saved):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as user:
        user.app.open_file(folder / "a.nc")
        await user.settle()
        await user.press("enter", "x", "down", "ctrl+o", "n", "enter")
        assert isinstance(user.app.screen, Question)
        assert "a.nc has changes" in user.app.screen.lines[0]
        await user.press("escape")
        assert len(user.app.proofs) == 1
        await user.press("enter", key)
        assert isinstance(user.app.screen, ContourScreen)
        assert user.session.title == "notch"
        assert [path.name for path in folder.iterdir() if path.name.startswith(".")] == []
    assert (folder / "a.nc").read_bytes() == saved


async def test_no_key_saves_opens_or_asks_again_while_a_question_is_open(folder):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter", "ctrl+q")
        for key in ("ctrl+s", "ctrl+o", "ctrl+z", "x", "5"):
            await user.press(key)
            assert isinstance(user.app.screen, Question)
        assert load(folder / "part.toml").blocks[0].tool == Number(1.0)
        await user.press("ctrl+q")
        assert isinstance(user.app.screen, ContourScreen)
        assert user.session.block.tool == Number(7.0)


async def test_discarded_work_is_listed_among_the_files_and_can_be_restored(folder, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))
    async with at_work(folder, me=DEAD) as user:
        await user.press("tab", "'7", "enter")
        journal = (folder / ".part.toml.cutcomp-journal").read_bytes()
    (folder / ".part.toml.cutcomp-journal").write_bytes(journal)
    async with at_work(folder) as user:
        await user.press("d")
        assert "Ctrl+O lists it" in user.prompt
        assert user.session.block.tool == Number(1.0)
        await user.press("ctrl+o", "ctrl+end")
        table = user.screen.query_one("#programs", DataTable)
        assert [str(cell) for cell in table.get_row_at(table.cursor_row)][::4] == ["part.toml", "discarded"]
        assert user.prompt.startswith("Unsaved work on part.toml, discarded")
        await user.press("enter")
        assert isinstance(user.app.screen, Question)
        await user.press("r")
        assert user.session.block.tool == Number(7.0)
        assert user.session.file == folder / "part.toml"


async def test_the_title_says_look_only_until_a_copy_is_saved(folder):
    theirs = DocumentService(state=folder / "their-own")
    theirs.open(folder / "part.toml")
    async with at_work(folder) as user:
        await user.press("l")
        assert user.session.file_label == "LOOK ONLY part"
        await user.press("tab", "tab", "tab", "tab", "'5")
        assert user.at == "x_start"
        await user.press("enter")
        assert (user.at, user.value("x_start")) == ("x_start", "2.0000"), "typed text is removed"
        assert user.prompt.endswith("SAVE AS (Ctrl+K) makes a copy of your own.")
        assert user.app.displayed is user.session
        await user.press("up", "up", "right")
        assert user.value("cutter_comp") == "LEFT"
        await user.press("up", "'7", "enter", "ctrl+s")
        assert user.prompt.endswith("SAVE AS (Ctrl+K) saves your own copy.")
        await entered(user, "app.save_as", "mine")
        assert user.session.file_label == "mine"
        assert user.session.block.tool == Number(1.0)
    theirs.stop()


async def test_a_question_that_does_not_fit_cannot_be_answered():
    async with operator(size=(20, 5)) as user:
        assert isinstance(user.app, CutcompApp)
        answers: list[str | None] = []
        lines = ["part.toml is open on another terminal since 7:15. Look at it, or take it over."]
        from app.documents.questions import Answer

        user.app.push_screen(
            Question("OPEN ALREADY", lines, [Answer("LOOK"), Answer("TAKE OVER")], "LOOK"), answers.append
        )
        await user.settle()
        await user.press("l", "t", "enter")
        assert answers == []
        await user.pilot.resize_terminal(80, 24)
        await user.settle()
        await user.press("t")
        assert answers == ["TAKE OVER"]


async def test_a_deleted_current_folder_is_reported_on_saving(folder, monkeypatch):
    gone = folder / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    service = DocumentService(state=folder / "own")
    opened = service.new()
    app = CutcompApp(Session.of(load(example("pocket"))), service=service, opened=opened)
    async with Operator.of(app) as user:
        gone.rmdir()
        await entered(user, "app.save_as", "lid")
        assert "there is no such file or folder" in user.prompt
        await user.press("escape", "ctrl+o")
        assert isinstance(app.screen, HomeScreen)
    service.stop()


@pytest.mark.parametrize("name", ["lid.toml", "lid.nc"])
async def test_home_opens_where_the_folder_of_the_open_file_is_gone(folder, monkeypatch, name):
    gone = folder / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    (gone / name).write_text("M30\n" if name == "lid.nc" else dumps(load(example("pocket"))))
    service = DocumentService(state=folder / "own")
    opened = service.open(Path(name))
    assert isinstance(opened, Opened)
    app = CutcompApp(service=service, opened=opened)
    async with Operator.of(app) as user:
        shutil.rmtree(gone)
        await user.press("escape" if name == "lid.nc" else "ctrl+o")
        await user.finish()
        assert isinstance(user.screen, HomeScreen)
    service.stop()


@pytest.mark.parametrize("action", ["app.save_as", "app.post", "app.sheet"])
async def test_a_name_too_long_for_a_file_is_reported(folder, action):
    async with at_work(folder) as user:
        for name in ("n" * 300, f"../{'n' * 300}"):
            await user.app.run_action(action)
            await user.finish()
            await user.settle()
            user.screen.query_one("#entry", Input).value = name
            await user.press("enter")
            await user.finish()
            if isinstance(user.screen, Question):
                await user.press("w")
                await user.finish()
            assert "the name is too long" in user.prompt
            await user.app.run_action("app.back")
            await user.settle()


@pytest.mark.parametrize("action", ["app.post", "app.sheet"])
async def test_output_asks_before_another_folder_or_a_file_and_never_replaces_a_program(folder, action):
    (folder.parent / "x.txt").write_text("somebody's")
    async with at_work(folder) as user:
        await user.app.run_action(action)
        await user.finish()
        await user.settle()
        screen = user.screen
        for name, title in (("../x.txt", "WRITE IN ANOTHER FOLDER?"), ("settings.toml", ""), ("note.txt", "REPLACE")):
            (folder / "note.txt").write_text("somebody's")
            screen.query_one("#entry", Input).value = name
            await user.press("enter")
            if not title:
                assert "is a program and would be overwritten" in user.prompt
                continue
            assert isinstance(user.app.screen, Question)
            assert user.app.screen.question.startswith(title)
            assert "Its content is replaced." in " ".join(user.app.screen.lines)
            await user.press("escape")
        assert {(folder.parent / "x.txt").read_text(), (folder / "note.txt").read_text()} == {"somebody's"}
        await user.press("enter", "r")
        await user.finish()
        assert (folder / "note.txt").read_text() != "somebody's"
