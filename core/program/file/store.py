"""Program files: read whole and strictly, written so that there is always one whole file.

A file is written beside its place, forced to the disk and renamed over the old one: whatever happens, the old
file or the new one is there, and nothing else is left behind.
"""

from __future__ import annotations

import errno
import os
import stat
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, Final

from core.program.disk import sync_folder, why, write_all
from core.program.file.end import cut_off
from core.program.file.read import StoreError, read_program
from core.program.file.write import written
from core.program.model import Program

__all__ = ["LARGEST_FILE", "StoreError", "dumps", "load", "load_from", "loads", "save", "write_output", "write_text"]

LARGEST_FILE: Final = 4_000_000
"""Bytes of the largest program file: about twenty thousand segments."""


def loads(text: str, name: str) -> Program:
    """The program of a file's text; StoreError names `name`, line and key."""
    return read_program(text, name)


def dumps(program: Program) -> str:
    """A program as the text of its file."""
    return written(program)


def load(path: str | Path) -> Program:
    """The program of a file; StoreError says what is wrong with it and what to do."""
    path = Path(path)
    try:
        data = _content(path)
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
    return _decoded(data, str(path))


def load_from(stream: BinaryIO, name: str) -> Program:
    """The program that comes through a pipe; StoreError calls it `name`."""
    try:
        data = _whole(stream)
    except (OSError, ValueError) as error:
        raise StoreError(f"{name} cannot be read: {why(error)}") from error
    return _decoded(data, name)


def _decoded(data: bytes, name: str) -> Program:
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        whole = data[: error.start].decode("utf-8-sig")
        if error.end == len(data) and (lost := cut_off(whole)) is not None:
            raise StoreError(f"{name}, {lost}") from error
        line = data.count(b"\n", 0, error.start) + 1
        raise StoreError(f"{name}, line {line}: this is not UTF-8 text. Save it as UTF-8, or open a copy.") from error
    return read_program(text, name)


def _content(path: Path) -> bytes:
    if not stat.S_ISREG(path.stat().st_mode):
        raise IsADirectoryError(errno.EISDIR, "no file")
    with path.open("rb") as file:
        return _whole(file)


def _whole(file: BinaryIO) -> bytes:
    data = file.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise OSError(errno.EFBIG, "too large")
    return data


def save(program: Program, path: str | Path) -> None:
    """Write a program's file in one step; see `write_text`."""
    write_text(path, written(program))


def write_text(path: str | Path, text: str) -> None:
    """Write a file in one step, through a symbolic link if there is one; its permissions stay.

    StoreError leaves the old file as it was and nothing beside it.
    """
    try:
        data = text.encode()
    except ValueError as error:
        raise StoreError(f"{path} is not saved: {why(error)}") from error
    write_data(path, data)


def write_data(path: str | Path, data: bytes) -> None:
    """The same with bytes."""
    try:
        target = Path(os.path.realpath(path))
        _replace(target, data)
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} is not saved: {why(error)}") from error


def write_output(path: Path, text: str) -> None:
    """Write what is made of a program, such as NC text or a drawing; StoreError rather than over a program."""
    refuse_program(path)
    write_text(path, text)


def refuse_program(path: Path) -> None:
    """StoreError where what is made of a program would be written over one."""
    if _is_program(path):
        raise StoreError(f"{path} is a program, which would be lost: nothing is written. Name another file.")


def _is_program(path: Path) -> bool:
    if path.suffix.lower() == ".toml":
        return True
    if not path.is_file():
        # a pipe would be waited for
        return False
    try:
        with path.open("rb") as file:
            return file.readline(80).startswith(b"format =")
    except OSError:
        return False


def _replace(target: Path, data: bytes) -> None:
    old = _status(target)
    beside = target.with_name(f".{target.name[:200]}.{os.urandom(6).hex()}.tmp")
    handle = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
    try:
        try:
            if old is not None:
                os.fchmod(handle, stat.S_IMODE(old.st_mode))
            write_all(handle, data)
            os.fsync(handle)
        finally:
            os.close(handle)
        beside.replace(target)
    except BaseException:
        with suppress(OSError):
            beside.unlink()
        raise
    sync_folder(target.parent)


def _status(target: Path) -> os.stat_result | None:
    """The old file's status, None if there is none; an error for what cannot be replaced."""
    try:
        old = target.stat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(old.st_mode):
        raise IsADirectoryError(errno.EISDIR, "no file")
    if not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, "write protected")
    return old
