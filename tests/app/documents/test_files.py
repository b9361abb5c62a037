"""Program files on disk: saved whole or not at all, with every refusal in a sentence."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from app.documents import files
from app.documents.files import load, save, write_output
from core.program.file.read import StoreError
from core.program.file.write import dumps
from core.program.model import Program
from tests.core.program.stored import PART, TEXT


def test_a_saved_program_loads_unchanged(tmp_path):
    path = tmp_path / "part.toml"
    save(PART, path)
    assert dumps(load(path)) == TEXT
    save(Program(), str(path))
    assert load(str(path)) == Program()
    assert list(tmp_path.iterdir()) == [path]


def test_a_byte_order_mark_is_ignored(tmp_path):
    path = tmp_path / "part.toml"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.encode())
    assert dumps(load(path)) == TEXT


def test_saving_keeps_the_file_mode(tmp_path):
    path = tmp_path / "part.toml"
    save(PART, path)
    path.chmod(0o640)
    save(Program(), path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_new_file_has_the_default_mode(tmp_path):
    (tmp_path / "usual").touch()
    save(PART, tmp_path / "part.toml")
    assert (tmp_path / "part.toml").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_saving_through_a_link_keeps_the_link(tmp_path):
    real, link = tmp_path / "real.toml", tmp_path / "link.toml"
    save(Program(), real)
    link.symlink_to(real)
    save(PART, link)
    assert link.is_symlink()
    assert dumps(load(real)) == TEXT


def refusal(act: Callable[[], object]) -> str:
    with pytest.raises(StoreError) as error:
        act()
    return error.value.text


def test_loading_anything_but_a_file_is_refused(tmp_path):
    assert refusal(lambda: load(tmp_path)).endswith("this is a folder. Choose the name of a file.")
    missing = tmp_path / "none.toml"
    words = f"{missing} cannot be read: there is no such file or folder. Check the name."
    assert refusal(lambda: load(missing)) == words
    assert refusal(lambda: load(tmp_path / "a\0b")).endswith("that is not a file name. Choose another.")
    assert refusal(lambda: load(tmp_path / ("n" * 300))).endswith("the name is too long. Choose a shorter one.")
    os.mkfifo(tmp_path / "pipe")
    assert refusal(lambda: load(tmp_path / "pipe")).endswith("this is a pipe. Choose the name of a file.")


def test_loading_a_file_that_is_not_text_or_too_large_is_refused(tmp_path):
    path = tmp_path / "part.toml"
    path.write_bytes(b'format = 1\nunits = "\xb0"\n')
    assert "line 2: this is not UTF-8 text" in refusal(lambda: load(path))
    path.write_bytes(b"#" * (files.MAX_PROGRAM_BYTES + 1))
    assert "it is too large. Choose another file." in refusal(lambda: load(path))


def test_loading_a_protected_file_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)

    def forbidden(*_args: object, **_named: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    with monkeypatch.context() as patch:
        patch.setattr(os, "open", forbidden)
        message = refusal(lambda: load(path))
    assert message.endswith("it is protected. Ask for permission, or choose another place.")


def test_saving_to_an_impossible_path_is_refused(tmp_path):
    assert refusal(lambda: save(PART, tmp_path)).endswith("this is a folder. Choose the name of a file.")
    nowhere = tmp_path / "none" / "part.toml"
    assert refusal(lambda: save(PART, nowhere)).startswith(f"{nowhere} is not saved: there is no such file or folder.")
    assert refusal(lambda: save(PART, tmp_path / "a\0b")).endswith("that is not a file name. Choose another.")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("call", ["write", "fsync", "fchmod", "close"])
@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.ENOSPC, "the disk is full"),
        (errno.EDQUOT, "the disk is full"),
        (errno.EIO, "the disk or the network fails"),
    ],
)
def test_a_failing_disk_leaves_only_the_old_file(tmp_path, monkeypatch, call, number, words):
    path = tmp_path / "part.toml"
    save(PART, path)
    real = getattr(os, call)

    def failing(*args: object) -> None:
        if call == "close":
            real(*args)
        raise OSError(number, os.strerror(number))

    with monkeypatch.context() as patch:
        patch.setattr(os, call, failing)
        assert words in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


def test_a_failing_rename_leaves_only_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)

    def failing(*_args: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", failing)
        assert "the disk is write protected" in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


def test_partial_writes_are_completed(tmp_path, monkeypatch):
    real = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: real(handle, data[:5]))
    save(PART, tmp_path / "part.toml")
    assert (tmp_path / "part.toml").read_text() == TEXT


def test_a_write_protected_file_is_not_replaced(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"
    save(PART, path)
    path.chmod(0o444)
    monkeypatch.setattr(os, "access", lambda *_args: False)
    assert "it is protected" in refusal(lambda: save(Program(), path))
    assert dumps(load(path)) == TEXT


@pytest.mark.parametrize("number", [errno.EACCES, errno.EPERM])
def test_a_protected_folder_is_reported_as_the_folder(tmp_path, monkeypatch, number):
    path = tmp_path / "part.toml"
    save(PART, path)
    real = os.open

    def protected(name: str | Path, flags: int, *args: int) -> int:
        if flags & os.O_CREAT:
            raise PermissionError(number, os.strerror(number), str(name))
        return real(name, flags, *args)

    with monkeypatch.context() as patch:
        patch.setattr(os, "open", protected)
        message = refusal(lambda: save(Program(), path))
    assert message == f"{path} is not saved: its folder is protected. Ask for permission, or choose another place."
    assert dumps(load(path)) == TEXT


def test_an_interrupted_save_leaves_nothing_behind(tmp_path, monkeypatch):
    path = tmp_path / "part.toml"

    def interrupted(_handle: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        save(PART, path)
    assert list(tmp_path.iterdir()) == []


def test_a_file_size_limit_leaves_only_the_old_file(tmp_path):
    """The kernel refuses the write: the child process may write files of at most 100 bytes."""
    path = tmp_path / "part.toml"
    save(PART, path)
    script = (
        "import resource, signal, sys; from app.documents.files import StoreError, load, save\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "part = load(sys.argv[1])\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "try: save(part, sys.argv[1])\n"
        "except StoreError as error: print(error.text)\n"
    )
    result = subprocess.run([sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=True)
    assert result.stdout.strip().startswith(f"{path} is not saved: the system lets nobody write a file of this size.")
    assert dumps(load(path)) == TEXT
    assert list(tmp_path.iterdir()) == [path]


def test_output_never_overwrites_a_program(tmp_path):
    part, other, fresh = tmp_path / "part.toml", tmp_path / "renamed", tmp_path / "part.nc"
    save(Program(), part)
    other.write_bytes(part.read_bytes())
    for target in (part, other, tmp_path / "new.toml"):
        with pytest.raises(StoreError, match="Choose another name"):
            write_output(target, "M2")
    assert part.read_bytes() == other.read_bytes()
    assert load(part) == Program()
    write_output(fresh, "M2")
    assert fresh.read_text() == "M2"


def test_output_does_not_wait_for_a_pipe(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(StoreError, match="this is a pipe"):
        write_output(tmp_path / "pipe", "M2")
