"""Saves that were killed: what they have left beside the file is found, compared, and offered or removed."""

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
from app.documents.journal import Kind
from app.documents.journal_file import journal_path, new_path
from app.documents.left_overs import kept_copies
from app.documents.service import Opened
from tests.app.documents.typist import changed_by_another, names, number_in, started


def killed_while(file: Path, data: bytes, call: str, instead: Callable[[int, bytes], object] | None = None) -> None:
    """Write a file in a process that is killed at a call of the module, or that does something else there first."""

    def killed(*arguments: Any) -> None:
        if instead is not None:
            instead(*arguments)
        os.kill(os.getpid(), signal.SIGKILL)

    with warnings.catch_warnings():
        # the child does nothing with threads
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
    """What the file would hold with this number in it."""
    before = file.read_bytes()
    changed_by_another(file, number)
    data = file.read_bytes()
    file.write_bytes(before)
    return data


def temporaries(file: Path) -> list[str]:
    return [name for name in names(file) if name.endswith(".tmp")]


def test_killed_before_the_rename_the_save_is_offered(own: Path, file: Path) -> None:
    data = content(file, 7)
    killed_while(file, data, "_taken_on")
    killed_while(file, data, "_put_in_place_of")
    assert len(temporaries(file)) == 2
    assert number_in(file) == 1
    operator = started(own, file)
    assert f"UNSAVED WORK FOUND {file.name}, " in operator.asked
    operator.answer("RESTORE")
    assert operator.number == 7
    assert operator.document.unsaved
    assert operator.undo().number == 1
    operator.redo().save()
    assert number_in(file) == 7
    operator.left()
    again = started(own, file)
    assert again.offer is None
    assert temporaries(file) == []


def test_killed_while_it_is_written_nothing_is_offered_and_nothing_stays(own: Path, file: Path) -> None:
    data = content(file, 7)

    killed_while(file, data, "write_all", lambda handle, whole: os.write(handle, whole[: len(whole) // 2]))
    assert len(temporaries(file)) == 1
    assert started(own, file).offer is None
    assert temporaries(file) == []


def test_killed_while_it_is_written_in_place_the_whole_content_comes_back(own: Path, file: Path) -> None:
    other = file.with_name("other")
    other.hardlink_to(file)
    data = content(file, 7)

    killed_while(file, data, "_overwrite", half_overwritten)
    assert len(file.read_bytes()) == 30
    operator = started(own, file)
    assert operator.answer("RESTORE").number == 7
    operator.save(None, *(["YOURS"] if file.suffix == ".toml" else []))
    assert number_in(file) == 7
    assert number_in(other.with_name(file.name)) == 7
    assert temporaries(file) == []


def test_discarded_it_is_a_kept_copy(own: Path, file: Path) -> None:
    temporary_path(file, 5).touch()
    data = content(file, 7)
    temporary_path(file, len(data)).write_bytes(data)
    operator = started(own, file)
    assert operator.answer("DISCARD").number == 1
    assert "discarded-1; Ctrl+O lists it." in operator.said
    assert temporaries(file) == []
    operator.left()
    [copy] = kept_copies(file.parent, own, Kind.NC if file.suffix == ".nc" else Kind.CONTOUR)
    opened = operator.service.open(file, kept_copy=copy.path)
    assert isinstance(opened, Opened)
    operator.took(opened)
    assert operator.answer("RESTORE").number == 7


def test_what_the_journal_or_the_file_holds_too_is_removed_and_asked_about_once(own: Path, file: Path) -> None:
    operator = started(own, file).type(7)
    data = operator.document.data()
    temporary_path(file, len(data)).write_bytes(data)
    temporary_path(file, len(file.read_bytes())).write_bytes(file.read_bytes())
    operator.killed()
    again = started(own, file).answer("DISCARD")
    assert again.offer is None
    assert temporaries(file) == []


def test_what_is_being_written_is_left_alone(own: Path, file: Path) -> None:
    data = content(file, 7)
    path = temporary_path(file, len(data))
    path.write_bytes(data)
    with path.open("rb") as held:
        flock(held, LOCK_EX)
        assert started(own, file).offer is None
    assert path.exists()


def test_what_others_have_left_and_other_files_are_left_alone(
    own: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = [file.with_name(name) for name in (".part.tmp", f".{file.name}.tmp", f".{file.name}.0123.tmp", "part.tmp")]
    for path in others:
        path.write_text("somebody's")
    data = content(file, 7)
    path = temporary_path(file, len(data))
    path.write_bytes(data)
    monkeypatch.setattr(os, "geteuid", lambda: 4242)
    assert started(own, file).offer is None
    assert all(one.exists() for one in (*others, path))


def test_zeros_that_a_power_cut_has_left_are_removed(own: Path, file: Path) -> None:
    temporary_path(file, 300).write_bytes(bytes(300))
    assert started(own, file).offer is None
    assert temporaries(file) == []


def test_a_journal_that_was_not_put_in_its_place_is_removed(own: Path, file: Path) -> None:
    new_path(journal_path(file)).write_bytes(b"half of a journal")
    started(own, file).left()
    assert names(file) == []
