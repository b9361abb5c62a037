"""Killed saves: the journal brings their content back, and what they leave beside the file is removed later."""

from __future__ import annotations

import os
import signal
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.documents import files
from app.documents.document_service import Trouble
from app.documents.files import temporary_path, write_data
from app.documents.journal_file import journal_path, new_path
from tests.app.documents.typist import changed_by_another, names, number_in, service, started


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


def grown_old(file: Path) -> None:
    """Let the temporary files be older than any save takes."""
    for name in temporaries(file):
        os.utime(file.with_name(name), (0, 0))


@pytest.mark.parametrize("call", ["write_all", "_taken_on", "_put_in_place_of"])
def test_the_content_of_a_save_killed_before_the_rename_comes_back_from_the_journal(
    state: Path, file: Path, call: str
) -> None:
    first = started(state, file).type(7)
    killed_while(file, first.document.data(), call)
    first.killed()
    assert len(temporaries(file)) == 1
    assert number_in(file) == 1
    grown_old(file)
    operator = started(state, file)
    assert temporaries(file) == []
    operator.answer("RESTORE")
    assert operator.number == 7
    assert operator.document.unsaved
    assert operator.undo().number == 1
    operator.redo().save()
    assert number_in(file) == 7
    operator.left()
    again = started(state, file)
    assert again.offer is None
    again.left()
    assert names(file) == []


def test_the_content_of_a_save_killed_while_writing_in_place_comes_back_from_the_journal(
    state: Path, file: Path
) -> None:
    other = file.with_name("other")
    other.hardlink_to(file)
    first = started(state, file).type(7)
    killed_while(file, first.document.data(), "_overwrite", half_overwritten)
    first.killed()
    assert len(file.read_bytes()) == 30
    operator = started(state, file)
    assert operator.answer("RESTORE").number == 7
    operator.save(None, "YOURS")
    assert number_in(file) == 7
    assert other.read_bytes() == file.read_bytes()
    operator.left()
    grown_old(file)
    started(state, file).left()
    assert temporaries(file) == []


def test_what_a_killed_save_left_stays_beside_a_file_that_cannot_be_read(state: Path, part: Path) -> None:
    data = content(part, 7)
    killed_while(part, data, "_taken_on")
    grown_old(part)
    part.write_bytes(data[:30])
    opened = service(state).open(part)
    assert isinstance(opened, Trouble)
    [left] = temporaries(part)
    assert part.with_name(left).read_bytes() == data


def test_a_save_in_progress_is_left_alone(state: Path, file: Path) -> None:
    path = temporary_path(file)
    path.write_bytes(b"half")
    assert started(state, file).offer is None
    assert path.exists()


def test_killed_saves_of_others_and_other_files_are_left_alone(
    state: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = [file.with_name(name) for name in (".part.tmp", f".{file.name}.tmp", f".{file.name}.0123.tmp", "part.tmp")]
    for path in others:
        path.write_text("somebody's")
    path = temporary_path(file)
    path.write_bytes(b"somebody's")
    for other in (*others, path):
        os.utime(other, (0, 0))
    monkeypatch.setattr(os, "geteuid", lambda: 4242)
    assert started(state, file).offer is None
    assert all(other.exists() for other in (*others, path))


def test_a_half_written_new_journal_is_removed(state: Path, file: Path) -> None:
    new_path(journal_path(file)).write_bytes(b"half of a journal")
    started(state, file).left()
    assert names(file) == []
