"""A slow folder: keys wait for it, so that each acts on what the one before it has opened, saved or asked."""

from __future__ import annotations

import os
import time
from threading import current_thread, main_thread

import pytest

from app.documents.files import load
from app.documents.journal import Kind
from app.documents.journal_file import journal_path
from app.documents.programs import example
from app.documents.unsaved_work import read
from app.screens.dialogs import Question
from app.screens.sheet import SheetScreen
from core.program.history import History
from core.program.model import Number
from tests.app.test_file_actions import at_work, folder

__all__ = ["folder"]


class Folder:
    """A disk that takes a while for each fsync; `most` is the largest number of writers at once."""

    writers = 0
    most = 0


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Folder:
    """A slow disk."""
    disk, fsync = Folder(), os.fsync

    def slow(handle: int) -> None:
        disk.writers += 1
        disk.most = max(disk.most, disk.writers)
        time.sleep(0.15)
        disk.writers -= 1
        fsync(handle)

    monkeypatch.setattr(os, "fsync", slow)
    return disk


async def test_every_key_is_taken_and_on_disk_before_the_next_one(folder, disk):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")
        for number in (2, 3, 4):
            await user.app.run_action("screen.go(0)")
            await user.press("tab", f"'{number}", "enter")
            assert user.session.block.tool == Number(float(number))
            journal = read(journal_path(folder / "part.toml"), Kind.CONTOUR)
            assert journal is not None
            assert isinstance(journal.work, History)
            assert journal.work.program == user.session.program
        assert journal.work.undo_count == 4
        assert disk.most == 1


async def test_keys_after_a_save_edit_the_saved_program(folder, disk):
    async with at_work(folder) as user:
        await user.send("tab", "'7", "enter", "ctrl+s", "home", "tab", "'8", "tab")
        await user.settle()
        assert load(folder / "part.toml").blocks[0].tool == Number(7.0)
        assert user.session.unsaved
        journal = read(journal_path(folder / "part.toml"), Kind.CONTOUR)
        assert journal is not None
        assert isinstance(journal.work, History)
        assert journal.work.program == user.session.program
        await user.press("ctrl+s")
        assert load(folder / "part.toml").blocks[0] == user.session.program.blocks[0]
        assert not user.session.unsaved
        assert disk.most == 1


@pytest.mark.usefixtures("disk")
async def test_keys_after_a_save_that_asks_answer_its_question(folder):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")
        (folder / "part.toml").write_bytes(example("notch").read_bytes())
        await user.send("ctrl+s", "y")
        await user.settle()
        assert not isinstance(user.app.screen, Question)
        assert load(folder / "part.toml").blocks[0].tool == Number(7.0)
        assert not user.session.unsaved


@pytest.mark.usefixtures("disk")
async def test_keys_after_an_open_edit_the_opened_program(folder):
    (folder / "other.toml").write_bytes(example("notch").read_bytes())
    async with at_work(folder) as user:
        user.app.open_file(folder / "other.toml")
        await user.send("tab", "'7", "enter")
        await user.settle()
        assert user.session.file == folder / "other.toml"
        assert user.session.unsaved
        assert read(journal_path(folder / "other.toml"), Kind.CONTOUR) is not None
        assert not journal_path(folder / "part.toml").exists()


async def test_a_save_that_fails_says_so_and_the_work_stays_unsaved(folder, monkeypatch):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")

        def full(_handle: int) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(os, "fsync", full)
        before = (folder / "part.toml").read_bytes()
        await user.press("ctrl+s")
        assert "is not saved: the disk is full" in user.prompt
        assert user.session.unsaved
        assert (folder / "part.toml").read_bytes() == before


async def test_the_sheet_adds_no_suffix_to_a_name_that_is_not_a_file(folder):
    async with at_work(folder) as user:
        user.app.push_screen(SheetScreen("."))
        await user.settle()
        await user.press("f2", "f3")
        assert isinstance(user.screen, SheetScreen)
        assert user.screen.text == "."


@pytest.fixture
def folder_calls(folder, monkeypatch) -> list[str]:
    """The system calls that the main thread, which reads the keys, makes on the program's folder: they might hang."""
    calls = list[str]()

    def watched(name: str) -> None:
        real = getattr(os, name)

        def recorded(path, *arguments, **options):
            if current_thread() is main_thread() and str(path).startswith(str(folder)):
                calls.append(f"{name} {path}")
            return real(path, *arguments, **options)

        monkeypatch.setattr(os, name, recorded)

    for name in ("stat", "lstat", "open", "scandir", "listdir"):
        watched(name)
    return calls


async def test_the_main_thread_never_accesses_the_folder(folder, folder_calls):
    async with at_work(folder) as user:
        folder_calls.clear()
        written = []
        await user.press("tab", "'1", "enter", "ctrl+s")
        for action, name in (("app.post", "part.nc"), ("app.sheet", "part.html")):
            await user.app.run_action(action)
            await user.settle()
            await user.finish()
            await user.settle()
            await user.press("enter")
            await user.finish()
            await user.settle()
            written.append(folder / name)
        assert folder_calls == []
    assert all(path.exists() for path in written)
