"""The App and files: open, save, leave, and every edit on disk."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from textual.widgets import DataTable, Static

from app.app import CutcompApp
from app.documents import times
from app.documents.document_service import DocumentService, Opened
from app.documents.files import load
from app.documents.folder_list import Facts
from app.documents.lock import myself
from app.documents.programs import example
from app.documents.settings import Settings, SettingsFile, load_settings
from app.file_actions import session_of
from app.nc_proof.screen import ProofScreen
from app.screens.dialogs import Question
from app.screens.home import HomeScreen
from app.screens.import_drawing import ImportScreen
from core.program.edit import FormPlace
from core.program.model import Number
from core.units import Unit
from tests.app.widget_pilot import SURROUNDINGS, Operator, operator

DATA = Path(__file__).parents[1] / "data" / "dxf"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    shop = tmp_path / "shop"
    shop.mkdir()
    (shop / "part.toml").write_bytes(example("pocket").read_bytes())
    monkeypatch.chdir(shop)
    return shop


@asynccontextmanager
async def at_work(folder: Path, name: str = "part.toml", **options) -> AsyncIterator[Operator]:
    """The program started on a file; without a name, on HOME, where unnamed left-over work is offered."""
    service = DocumentService(state=folder / "own", **options)
    opened = service.open(folder / name) if name else service.new(offers=True)
    assert isinstance(opened, Opened)
    app = CutcompApp(
        session_of(opened.document),
        surroundings=SURROUNDINGS,
        service=service,
        opened=opened,
        home=not name,
        settings_file=SettingsFile(folder / "settings.toml", Settings()),
    )
    async with Operator.of(app) as user:
        yield user
        await user.settle()
    service.stop()


DEAD = replace(myself(times.now()), pid=4194305)
"""Ourselves in a process that no longer exists."""


def journals(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name.endswith("-journal")]


async def test_an_edit_is_journaled_before_the_next_key_until_it_is_saved(folder):
    async with at_work(folder) as user:
        assert journals(folder) == []
        await user.press("pagedown", "tab", "'5.5", "enter")
        assert journals(folder) == [".part.toml.cutcomp-journal"]
        await user.press("ctrl+s")
        assert journals(folder) == []
        assert load(folder / "part.toml") == user.session.program
        assert not user.session.unsaved
        assert user.session.history.undo_count == 1


async def test_a_new_empty_segment_is_not_saved(folder):
    before = load(folder / "part.toml").blocks[0].segments
    async with at_work(folder) as user:
        for number, keys in {"2.5": ["ctrl+s"], "2.75": ["ctrl+q", "s"]}.items():
            user.app.move(FormPlace(1), "x_start")
            await user.press(f"'{number}", "enter", "ctrl+end", "pagedown")
            assert len(user.session.block.segments) == len(before) + 1
            await user.press(*keys)
            assert not user.session.unsaved
            block = load(folder / "part.toml").blocks[0]
            assert (block.x_start, block.segments) == (Number(float(number)), before)


async def test_work_of_a_killed_program_is_offered_and_restored_with_its_undo(folder):
    async with at_work(folder, me=DEAD) as user:
        await user.press("pagedown", "tab", "'5.5", "enter")
        journal = (folder / ".part.toml.cutcomp-journal").read_bytes()
    (folder / ".part.toml.cutcomp-journal").write_bytes(journal)
    async with at_work(folder) as user:
        assert isinstance(user.app.screen, Question)
        await user.press("r")
        assert user.session.block.segments[0].x_end == Number(5.5)
        assert user.session.history.undo_count == 1


@pytest.mark.parametrize(
    ("key", "questions"), [("escape", 1), ("d", 0)], ids=["asked again at the next start", "kept as a backup"]
)
async def test_home_stays_after_a_question_that_restored_no_work(folder, key, questions):
    async with at_work(folder, "", me=DEAD) as user:
        await user.press("f3", "'2", "enter")
        [journal] = (folder / "own").glob("unnamed-*")
        data = journal.read_bytes()
    journal.write_bytes(data)
    async with at_work(folder, "") as user:
        assert isinstance(user.app.screen, Question)
        await user.press("f3", "f1")
        assert isinstance(user.app.screen, Question), "no softkey of the screen behind it answers"
        await user.press(key)
        assert isinstance(user.app.screen, HomeScreen)
        await user.press("f3")
        assert user.session.program.unit is Unit.MM
    async with at_work(folder, "") as user:
        assert sum(isinstance(screen, Question) for screen in user.app.screen_stack) == questions


@pytest.mark.parametrize(("answer", "name"), [("a", "part.toml"), ("n", None)], ids=["added", "a new program"])
async def test_a_drawing_is_added_to_the_open_program_or_begins_a_new_one(folder, answer, name):
    (folder / "square.dxf").write_bytes((DATA / "d01-square.dxf").read_bytes())
    async with at_work(folder) as user:
        await user.press("ctrl+o", "s", "enter")
        assert isinstance(user.app.screen, Question)
        await user.press(answer)
        assert isinstance(user.app.screen, ImportScreen)
        assert (None if user.session.file is None else user.session.file.name) == name
        assert user.app.document.is_new is (name is None)


async def test_a_drawing_begins_a_program_without_a_question_when_nothing_was_typed(folder):
    (folder / "square.dxf").write_bytes((DATA / "d01-square.dxf").read_bytes())
    async with at_work(folder, "") as user:
        await user.press("s", "enter")
        assert isinstance(user.app.screen, ImportScreen)


async def test_an_nc_program_in_the_list_opens_under_proof(folder):
    (folder / "job.nc").write_text("G20 G17 G90\nT1 M6\nG0 X1\nM30\n")
    async with at_work(folder, "") as user:
        assert isinstance(user.app.screen, HomeScreen)
        await user.press("j")
        assert user.app.screen.chosen is not None
        assert user.app.screen.chosen.kind == "NC program"
        assert str(user.app.screen.query_one("#folder", Static).content).endswith("1 program, 1 NC program")
        await user.press("enter")
        assert isinstance(user.app.screen, ProofScreen)
        assert user.app.screen.document.file.path == folder / "job.nc"


async def test_save_as_changes_the_name_and_returns_to_the_form(folder):
    async with at_work(folder) as user:
        await user.app.run_action("app.save_as")
        await user.press(*"other", "enter")
        assert load(folder / "other.toml") == user.session.program
        assert user.session.file == folder / "other.toml"
        assert user.at == "segment"
        assert load_settings(folder / "settings.toml")[0].folder == str(folder)


async def test_save_as_asks_before_replacing_a_file(folder):
    (folder / "other.toml").write_bytes(example("notch").read_bytes())
    async with at_work(folder) as user:
        await user.app.run_action("app.save_as")
        await user.send(*"other", "enter")
        await user.settle()
        assert isinstance(user.app.screen, Question)
        await user.press("escape")
        assert load(folder / "other.toml") == load(example("notch"))
        await user.press("enter", "r")
        assert load(folder / "other.toml") == user.session.program


async def test_a_message_about_a_program_disappears_with_the_next_one(folder):
    async with at_work(folder) as user:
        user.app.say("Example pocket. Ctrl+S saves it under a name.")
        await user.press("ctrl+o", "f2")
        assert user.session.file is None
        assert user.prompt == "Tool number. Space lists the tools."


async def test_a_message_is_gone_when_its_screen_comes_back_from_behind_another_one(folder):
    async with at_work(folder) as user:
        await user.press("f1")
        assert user.prompt == "START cannot be deleted."
        await user.press("ctrl+o", "escape")
        assert user.at == "segment"
        assert user.prompt.startswith("Enter a segment number")


async def test_a_name_that_is_too_long_for_its_column_ends_with_dots(folder):
    (folder / "holder for the small vise.dxf").write_bytes((DATA / "d01-square.dxf").read_bytes())
    async with at_work(folder) as user:
        await user.press("ctrl+o", *"holder")
        row = user.app.screen.query_one("#programs", DataTable).get_row_at(1)
        assert str(row[0]) == "holder for the s…"


async def test_a_folder_says_that_it_is_one(folder):
    (folder / "drawings of the customer").mkdir()
    async with at_work(folder) as user:
        await user.press("ctrl+o")
        table = user.app.screen.query_one("#programs", DataTable)
        (row,) = (cells for cells in map(table.get_row_at, range(table.row_count)) if str(cells[0]).startswith("draw"))
        assert (str(row[0]), str(row[-1])) == ("drawings of the …", "folder")


async def test_letters_typed_in_quick_succession_spell_one_name(folder):
    for name in ("part-b.nc", "part-c.nc", "pin.nc"):
        (folder / name).write_text("M30\n")
    async with at_work(folder) as user:
        await user.press("ctrl+o")
        home = user.app.screen
        assert isinstance(home, HomeScreen)
        await user.press("p", "i")
        assert home.chosen.name == "pin.nc"
        home._typed.last = 0.0
        await user.press(*"part-c")
        assert home.chosen.name == "part-c.nc"
        # no name continues or begins with this letter
        await user.press("z")
        assert home.chosen.name == "part-c.nc"
        # the program has the name itself, the NC programs only begin with it
        home._typed.last = 0.0
        await user.press(*"part")
        assert home.chosen.path == folder / "part.toml"


async def test_home_lists_files_written_while_another_screen_was_in_front(folder):
    async with at_work(folder) as user:
        await user.press("ctrl+o")
        home = user.app.screen
        assert isinstance(home, HomeScreen)
        (folder / "a.nc").write_text("M30\n")
        await user.press("ctrl+o")
        assert "a.nc" in [program.name for program in home.listed]
        assert home.chosen.path == folder / "part.toml"
        (folder / "b.nc").write_text("M30\n")
        await user.press("question_mark", "escape")
        assert "b.nc" in [program.name for program in home.listed]


async def test_a_preview_that_arrives_while_home_closes_is_dropped(folder, monkeypatch):
    unmounted = []

    def on_unmount(home: HomeScreen) -> None:
        home._show_preview(folder / "part.toml", "part", None)
        home._show_facts(Facts(folder / "part.toml"))
        unmounted.append(home)

    monkeypatch.setattr(HomeScreen, "on_unmount", on_unmount, raising=False)
    async with at_work(folder) as user:
        await user.press("ctrl+o", "f2")
        assert len(unmounted) == 1
        assert not isinstance(user.app.screen, HomeScreen)


async def test_quit_asks_about_unsaved_work_and_go_back_keeps_it(folder):
    async with at_work(folder) as user:
        await user.press("pagedown", "tab", "'5.5", "enter", "ctrl+q")
        assert isinstance(user.app.screen, Question)
        await user.press("escape")
        assert user.session.block.segments[0].x_end == Number(5.5)
        await user.press("ctrl+q", "s")
    assert load(folder / "part.toml").blocks[0].segments[0].x_end == Number(5.5)
    assert journals(folder) == []


async def test_opening_another_program_asks_about_unsaved_work(folder):
    async with at_work(folder) as user:
        await user.press("pagedown", "tab", "'5.5", "enter", "ctrl+o")
        assert isinstance(user.app.screen, HomeScreen)
        await user.finish()
        await user.press("n", "enter")
        assert isinstance(user.app.screen, Question)
        await user.press("d")
        assert user.session.title == "notch"
        assert load(folder / "part.toml") == load(example("pocket"))
        assert journals(folder) == []


async def test_a_program_opened_with_look_cannot_be_edited(folder):
    theirs = DocumentService(state=folder / "their-own")
    theirs.open(folder / "part.toml")
    async with at_work(folder) as user:
        assert isinstance(user.app.screen, Question)
        await user.press("l")
        await user.press("tab", "'2")
        assert user.app.displayed is not user.session
        await user.press("enter")
        assert "SAVE AS" in user.prompt
        assert user.app.displayed is user.session
        await user.press("pagedown", "tab", "'5.5", "enter")
        assert user.session.program == load(example("pocket"))
        assert "SAVE AS" in user.prompt
    theirs.stop()


async def test_a_drawing_that_is_not_there_raises_no_question(part: Path) -> None:
    async with operator("pocket") as user:
        user.app.open_file(part.with_name("gone.dxf"))
        await user.settle()
        assert user.prompt.endswith("gone.dxf: there is no such drawing.")
        assert len(user.app.screen_stack) == 1
