"""Killed saves: the temporary files they leave beside the file are found, compared, and offered or removed."""

from __future__ import annotations

import os
import signal
import warnings
from collections.abc import Callable
from fcntl import LOCK_EX, flock
from pathlib import Path
from typing import Any

import pytest

from app.documents import files
from app.documents.files import temporary_path, write_data
from app.documents.journal_file import journal_path, new_path
from app.documents.left_overs import kept_copies
from app.documents.service import Opened
from tests.app.documents.typist import changed_by_another, names, number_in, started


def killed_while(file: Path, data: bytes, call: str, first_do: Callable[[int, bytes], object] | None = None) -> None:
    """Write a file in a process that is killed at this call of `files`, after it has called `first_do`."""

    def killed(*arguments: Any) -> None:
        if first_do is not None:
            first_do(*arguments)
        os.kill(os.getpid(), signal.SIGKILL)

    with warnings.catch_warnings():
        # the child uses no threads
        warnings.simplefilter("ignore", DeprecationWarning)
        pid = os.fork()
    if not pid:
        setattr(files, call, killed)
        try:
            write_data(file, data)
        finally:
            os._exit(1)
    _, status = os.waitpid(pid, 0)
    assert os.WIFSIGNALED(status)


def half_overwritten(handle: int, data: bytes) -> None:
    os.write(handle, data[:30])
    os.ftruncate(handle, 30)


def content(file: Path, number: float) -> bytes:
    """The content of the file if it held this number."""
    before = file.read_bytes()
    changed_by_another(file, number)
    data = file.read_bytes()
    file.write_bytes(before)
    return data


def temporaries(file: Path) -> list[str]:
    return [name for name in names(file) if name.endswith(".tmp")]


def test_a_save_killed_before_the_rename_is_offered(state: Path, file: Path) -> None:
    data = content(file, 7)
    killed_while(file, data, "_taken_on")
    killed_while(file, data, "_put_in_place_of")
    assert len(temporaries(file)) == 2
    assert number_in(file) == 1
    operator = started(state, file)
    assert f"UNSAVED WORK FOUND {file.name}, " in operator.asked
    operator.answer("RESTORE")
    assert operator.number == 7
    assert operator.document.unsaved
    assert operator.undo().number == 1
    operator.redo().save()
    assert number_in(file) == 7
    operator.left()
    again = started(state, file)
    assert again.offer is None
    assert temporaries(file) == []


def test_a_save_killed_while_writing_is_removed_and_not_offered(state: Path, file: Path) -> None:
    data = content(file, 7)

    killed_while(file, data, "write_all", lambda handle, whole: os.write(handle, whole[: len(whole) // 2]))
    assert len(temporaries(file)) == 1
    assert started(state, file).offer is None
    assert temporaries(file) == []


def test_a_save_killed_while_writing_in_place_is_restored_whole(state: Path, file: Path) -> None:
    other = file.with_name("other")
    other.hardlink_to(file)
    data = content(file, 7)

    killed_while(file, data, "_overwrite", half_overwritten)
    assert len(file.read_bytes()) == 30
    operator = started(state, file)
    assert operator.answer("RESTORE").number == 7
    operator.save(None, *(["YOURS"] if file.suffix == ".toml" else []))
    assert number_in(file) == 7
    assert other.read_bytes() == file.read_bytes()
    assert temporaries(file) == []


def test_a_discarded_save_stays_as_a_kept_copy(state: Path, file: Path) -> None:
    temporary_path(file, 5).touch()
    data = content(file, 7)
    temporary_path(file, len(data)).write_bytes(data)
    operator = started(state, file)
    assert operator.answer("DISCARD").number == 1
    assert "discarded-1; Ctrl+O lists it." in operator.said
    assert temporaries(file) == []
    operator.left()
    [copy] = kept_copies(file.parent, state)
    opened = operator.service.open(file, kept_copy=copy.path)
    assert isinstance(opened, Opened)
    operator.took(opened)
    assert operator.answer("RESTORE").number == 7


def test_a_killed_save_equal_to_the_journal_or_the_file_is_removed(state: Path, file: Path) -> None:
    operator = started(state, file).type(7)
    data = operator.document.data()
    temporary_path(file, len(data)).write_bytes(data)
    temporary_path(file, len(file.read_bytes())).write_bytes(file.read_bytes())
    operator.killed()
    again = started(state, file).answer("DISCARD")
    assert again.offer is None
    assert temporaries(file) == []


def test_a_save_in_progress_is_left_alone(state: Path, file: Path) -> None:
    data = content(file, 7)
    path = temporary_path(file, len(data))
    path.write_bytes(data)
    with path.open("rb") as held:
        flock(held, LOCK_EX)
        assert started(state, file).offer is None
    assert path.exists()


def test_killed_saves_of_others_and_other_files_are_left_alone(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = [file.with_name(name) for name in (".part.tmp", f".{file.name}.tmp", f".{file.name}.0123.tmp", "part.tmp")]
    for path in others:
        path.write_text("somebody's")
    data = content(file, 7)
    path = temporary_path(file, len(data))
    path.write_bytes(data)
    monkeypatch.setattr(os, "geteuid", lambda: 4242)
    assert started(state, file).offer is None
    assert all(other.exists() for other in (*others, path))


def test_zeros_left_by_a_power_cut_are_removed(state: Path, file: Path) -> None:
    temporary_path(file, 300).write_bytes(bytes(300))
    assert started(state, file).offer is None
    assert temporaries(file) == []


def test_a_half_written_new_journal_is_removed(state: Path, file: Path) -> None:
    new_path(journal_path(file)).write_bytes(b"half of a journal")
    started(state, file).left()
    assert names(file) == []
