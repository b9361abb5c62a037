"""Files: read programs; save without ever leaving a half-written file.

A file is written next to its place, forced to the disk and renamed over the old one: whatever happens, the old
file or the new one is there, and nothing else is left.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final
from zlib import adler32, crc32

from core.program.file.read import StoreError, loads_bytes
from core.program.file.write import dumps
from core.program.model import Program

LARGEST_FILE: Final = 4_000_000
"""Bytes of the largest program file: about twenty thousand segments."""


@dataclass(frozen=True, slots=True)
class Stamp:
    """What a file was when it was read: enough to notice that somebody has written it since.

    Size in bytes, time of the last change in nanoseconds since 1970, and a sum over the content.
    """

    size: int
    changed: int
    digest: str

    def same_content(self, other: Stamp) -> bool:
        """Whether both are of the same content; the time does not count, since a copy changes it.

        Journals of format 1 hold only the first half of the sum.
        """
        digits = min(len(self.digest), len(other.digest))
        return self.size == other.size and self.digest[:digits] == other.digest[:digits]


class NotAFileError(OSError):
    """Something else stands where a file was to be read: `what` says what."""

    def __init__(self, path: Path, mode: int) -> None:
        super().__init__(errno.EISDIR, "no file", str(path))
        self.what = next(what for test, what in _OTHER_THINGS if test(mode))


_OTHER_THINGS: Final[tuple[tuple[Callable[[int], bool], str], ...]] = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (lambda mode: stat.S_ISCHR(mode) or stat.S_ISBLK(mode), "a device"),
    (lambda _: True, "no file"),
)


def read_file(path: Path, most: int) -> tuple[bytes, os.stat_result]:
    """A file's content, and its status; OSError at once for what is no file, and for one of more than `most` bytes.

    Nothing else is opened: a pipe would be waited for, and opening a device may do something.
    """
    _only_a_file(path, path.stat())
    handle = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOCTTY)
    with os.fdopen(handle, "rb") as file:
        status = os.fstat(handle)
        _only_a_file(path, status)
        return _whole(file, most), status


def read_start(path: Path, most: int) -> bytes:
    """The first bytes of a file; OSError at once for what is no file."""
    _only_a_file(path, path.stat())
    with path.open("rb") as file:
        return file.read(most)


def _only_a_file(path: Path, status: os.stat_result) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise NotAFileError(path, status.st_mode)


def stamp_of_data(data: bytes, changed: int = 0) -> Stamp:
    """The stamp of a file with this content."""
    # against mistakes, not against forgers: hashlib would load OpenSSL at every start
    return Stamp(len(data), changed, f"{crc32(data):08x}{adler32(data):08x}")


def stamp_of(path: Path, most: int = LARGEST_FILE) -> Stamp | None:
    """The file's stamp as it is now, None where there is no file that can be read."""
    try:
        data, status = read_file(path, most)
        return stamp_of_data(data, status.st_mtime_ns)
    except (OSError, ValueError):
        return None


def load(path: str | Path) -> Program:
    """The program of a file; StoreError says what is wrong with it and what to do."""
    path = Path(path)
    try:
        data, _ = read_file(path, LARGEST_FILE)
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
    return loads_bytes(data, str(path))


def load_from(stream: BinaryIO, name: str) -> Program:
    """The program that comes through a pipe; StoreError calls it `name`."""
    try:
        data = _whole(stream)
    except (OSError, ValueError) as error:
        raise StoreError(f"{name} cannot be read: {why(error)}") from error
    return loads_bytes(data, name)


def _whole(file: BinaryIO, most: int = LARGEST_FILE) -> bytes:
    data = file.read(most + 1) or b""
    if len(data) > most:
        raise OSError(errno.EFBIG, "too large")
    return data


def save(program: Program, path: str | Path) -> None:
    """Write a program's file in one step; see `write_text`."""
    write_text(path, dumps(program))


def write_text(path: str | Path, text: str) -> None:
    """Write a file in one step, through a symbolic link if there is one; its permissions stay.

    StoreError leaves the old file as it was and nothing next to it.
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
        raise StoreError(f"{path} is a program and would be overwritten. Choose another name.")


def _is_program(path: Path) -> bool:
    if path.suffix.lower() == ".toml":
        return True
    try:
        return read_start(path, 80).startswith(b"format =")
    except (OSError, ValueError):
        return False


def _replace(target: Path, data: bytes) -> None:
    old = _status(target)
    temporary = target.with_name(f".{target.name[:200]}.{os.urandom(6).hex()}.tmp")
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
    try:
        try:
            if old is not None:
                os.fchmod(handle, stat.S_IMODE(old.st_mode))
            write_all(handle, data)
            os.fsync(handle)
        finally:
            os.close(handle)
        temporary.replace(target)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    sync_folder(target.parent)


def _status(target: Path) -> os.stat_result | None:
    """The old file's status, None if there is none; an error for what cannot be replaced."""
    try:
        old = target.stat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(old.st_mode):
        raise NotAFileError(target, old.st_mode)
    if not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, "write protected")
    return old


def write_all(handle: int, data: bytes) -> None:
    """Write every byte; OSError leaves some of them written."""
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def sync_folder(folder: Path) -> None:
    """Force a new name in a folder to the disk; some file systems cannot, and then each file is whole all the same."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def why(error: OSError | ValueError) -> str:
    """The reason why a file cannot be read or written, and the remedy."""
    if isinstance(error, NotAFileError):
        return f"this is {error.what}. Choose the name of a file."
    match error.errno if isinstance(error, OSError) else None:
        case errno.ENOSPC | errno.EDQUOT:
            return "the disk is full. Make room or save elsewhere."
        case errno.EISDIR | errno.ENOTDIR:
            return "this is not a file. Choose the name of a file."
        case errno.ENOENT:
            return "there is no such file or folder. Check the name."
        case errno.EACCES | errno.EPERM:
            what = "it" if _there(error) else "its folder"
            return f"{what} is protected. Ask for permission, or choose another place."
        case errno.EROFS:
            return "the disk is write protected. Choose another place."
        case errno.EFBIG:
            return "it is too large for a program file. Choose another file."
        case errno.ENAMETOOLONG:
            return "the name is too long. Choose a shorter one."
        case None:
            return "that is not a file name. Choose another."
        case _:
            return (
                f"{error.strerror or error}. Try again or choose another place." if isinstance(error, OSError) else ""
            )


def _there(error: OSError | ValueError) -> bool:
    """Whether an error is about a file that there is: what cannot be made, or found, is kept out by its folder."""
    name = error.filename if isinstance(error, OSError) else None
    return not isinstance(name, str | Path) or os.path.lexists(name)
