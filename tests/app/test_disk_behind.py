"""A hanging folder: the screen keeps working and says so, and only one thread writes at a time."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from threading import Event, Lock, current_thread, main_thread

import pytest

from app import file_actions
from app.documents.files import load
from app.documents.journal import Kind
from app.documents.journal_file import journal_path
from app.documents.left_overs import read
from app.screens.dialogs import Question
from app.screens.sheet import SheetScreen
from core.program.history import History
from core.program.model import Number
from tests.app.test_file_actions import at_work, folder
from tests.app.widget_pilot import Operator

__all__ = ["folder"]


@dataclass
class Folder:
    """A disk that hangs while `hanging`; `most` is the largest number of writers that waited at once."""

    hanging: bool = False
    answers: Event = field(default_factory=Event)
    writers: int = 0
    most: int = 0
    lock: Lock = field(default_factory=Lock)

    def dies(self, user: Operator) -> None:
        self.hanging = True
        # longer than the program waits for the disk
        user.patience = 0.15

    async def comes_back(self, user: Operator) -> None:
        self.hanging = False
        self.answers.set()
        await user.app.workers.wait_for_complete()
        await user.settle()


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Iterator[Folder]:
    """A disk whose fsync hangs on request."""
    monkeypatch.setattr(file_actions, "DISK_SECONDS", 0.05)
    disk, fsync = Folder(), os.fsync

    def slow(handle: int) -> None:
        if disk.hanging:
            with disk.lock:
                disk.writers += 1
                disk.most = max(disk.most, disk.writers)
            disk.answers.wait(20)
            disk.writers -= 1
        fsync(handle)

    monkeypatch.setattr(os, "fsync", slow)
    yield disk
    disk.answers.set()


async def test_keys_work_while_the_folder_hangs_and_all_edits_are_kept_later(folder, disk):
    async with at_work(folder) as user:
        disk.dies(user)
        await user.press("tab", "'7", "enter")
        assert "The folder does not answer: still trying." in user.prompt
        for number in (2, 3, 4):
            await user.app.run_action("screen.go(0)")
            await user.press("tab")
            await user.press(f"'{number}", "enter")
            assert user.session.block.tool == Number(float(number))
            assert "does not answer" in user.prompt
        await disk.comes_back(user)
        assert "The folder answers again" in user.prompt
        journal = read(journal_path(folder / "part.toml"), Kind.CONTOUR)
        assert journal is not None
        assert isinstance(journal.work, History)
        assert journal.work.program == user.session.program
        assert journal.work.undo_count == 4
        assert disk.most == 1


async def test_edits_typed_while_a_save_hangs_are_kept_unsaved(folder, disk):
    async with at_work(folder) as user:
        await user.press("tab", "'7", "enter")
        disk.dies(user)
        await user.press("ctrl+s")
        assert "does not answer" in user.prompt
        await user.app.run_action("screen.go(0)")
        await user.press("tab", "'8", "enter", "ctrl+s")
        assert "does not answer" in user.prompt
        await disk.comes_back(user)
        assert load(folder / "part.toml").blocks[0].tool == Number(7.0)
        assert user.session.unsaved
        journal = read(journal_path(folder / "part.toml"), Kind.CONTOUR)
        assert journal is not None
        assert isinstance(journal.work, History)
        assert journal.work.program.blocks[0].tool == Number(8.0)
        await user.press("ctrl+s")
        assert load(folder / "part.toml").blocks[0].tool == Number(8.0)
        assert not user.session.unsaved
        assert disk.most == 1


async def test_a_program_whose_folder_hangs_can_be_left_after_a_question(folder, disk):
    async with at_work(folder) as user:
        disk.dies(user)
        await user.press("tab", "'7", "enter", "ctrl+q")
        assert isinstance(user.app.screen, Question)
        assert user.app.screen.lines[0] == "The folder does not answer."
        await user.press("escape", "ctrl+q", "l")
        assert user.app.return_code == 0
        disk.answers.set()


async def test_a_copy_can_be_saved_on_another_disk_while_the_folder_hangs(folder, disk, tmp_path):
    rescue = tmp_path / "rescue.toml"
    rescue.write_text("somebody's")
    async with at_work(folder) as user:
        disk.dies(user)
        await user.press("tab", "'7", "enter")
        # the other disk answers
        disk.hanging = False
        user.app.action_save_as()
        await user.settle()
        user.app.save_as(str(rescue))
        await user.app.workers.wait_for_complete([worker for worker in user.app.workers if worker.name == "_save_copy"])
        await user.settle()
        assert "is there already: type another name" in user.prompt
        assert rescue.read_text() == "somebody's"
        user.app.save_as(str(tmp_path / ("n" * 300)))
        await user.app.workers.wait_for_complete([worker for worker in user.app.workers if worker.name == "_save_copy"])
        await user.settle()
        assert "is not saved" in user.prompt
        user.app.save_as(str(tmp_path / "copy"))
        await user.app.workers.wait_for_complete([worker for worker in user.app.workers if worker.name == "_save_copy"])
        await user.settle()
        assert "A copy is in" in user.prompt
        assert load(tmp_path / "copy.toml").blocks[0].tool == Number(7.0)
        await disk.comes_back(user)
        assert "The folder answers again" in user.prompt
        assert user.session.unsaved


async def test_a_copy_of_an_nc_text_includes_the_line_being_typed(folder, disk, tmp_path):
    (folder / "a.nc").write_bytes(b"G20 G17\nM30\n")
    async with at_work(folder) as user:
        user.app.open_file(folder / "a.nc")
        await user.settle()
        disk.dies(user)
        await user.press("enter", "x", "down", "enter", "y")
        disk.hanging = False
        assert user.app.disk_is_behind()
        user.app.action_save_as()
        await user.settle()
        user.app.save_as(str(tmp_path / "copy.nc"))
        await user.app.workers.wait_for_complete([worker for worker in user.app.workers if worker.name == "_save_copy"])
        assert b"y" in (tmp_path / "copy.nc").read_bytes()
        await disk.comes_back(user)


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
            await user.app.workers.wait_for_complete()
            await user.settle()
            await user.press("enter")
            await user.app.workers.wait_for_complete()
            await user.settle()
            written.append(folder / name)
        assert folder_calls == []
    assert all(path.exists() for path in written)
