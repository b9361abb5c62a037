"""This module reads program files, and saves them without ever leaving a half-written one.

A save writes a temporary file in the same folder, forces it to disk and renames it over the old file: whatever
happens, the old or the new file is there.  A killed save may leave the temporary file, which a later opening removes.
"""

from __future__ import annotations

import errno
import os
import re
import stat
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import time
from typing import BinaryIO, Final
from zlib import adler32, crc32

from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import is_drawing
from core.program.file.read import StoreError, loads_bytes
from core.program.file.write import dumps
from core.program.model import Program

MAX_PROGRAM_BYTES: Final = 4_000_000
"""The size of the largest program file in bytes: about twenty thousand segments."""
SEARCHED_BYTES: Final = 4096
"""The number of bytes at the start of a file in which a program's key `format`, or its number, must appear."""
_PROGRAM: Final = re.compile(
    rb"(?:\xef\xbb\xbf)?(?:[ \t\r]*(?:#[^\n]*|[\w.-]+[ \t]*=[^\n]*)?\n)*?[ \t]*format[ \t]*=",
)
"""The beginning of a program: comments and keys up to the key `format`."""
MAX_SAVE_SECONDS: Final = 600
"""The age in seconds from which a temporary file is one of a save that was killed."""
MAX_NAME_BYTES: Final = 200
"""The most bytes of a file's name that the name of a hidden file beside it repeats."""


@dataclass(frozen=True, slots=True)
class Stamp:
    """The state of a file when it was read: enough to notice that somebody has written it since.

    Size in bytes, time of the last change in nanoseconds since 1970, and a checksum of the content.
    """

    size: int
    changed: int
    digest: str

    def same_content(self, other: Stamp | None) -> bool:
        """True if the contents are the same; the time does not count, since a copy changes it."""
        return other is not None and (self.size, self.digest) == (other.size, other.digest)


class NotAFileError(OSError):
    """The path is not a regular file; `what` says what it is."""

    def __init__(self, path: Path, mode: int) -> None:
        super().__init__(errno.EISDIR, "no file", str(path))
        self.what = _OTHER_THINGS.get(stat.filemode(mode)[0], "no file")


_OTHER_THINGS: Final = {"d": "a folder", "p": "a pipe", "s": "a socket", "c": "a device", "b": "a device"}
"""What is no file, by the letter that `ls -l` begins its line with."""


def read_file(path: Path, most: int) -> tuple[bytes, os.stat_result]:
    """Return a file's content and status; raise OSError if it is not a regular file or exceeds `most` bytes.

    Nothing else is opened: opening a pipe would block, and opening a device may have side effects.
    """
    _check_regular(path, path.stat())
    handle = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOCTTY)
    with os.fdopen(handle, "rb") as file:
        status = os.fstat(handle)
        _check_regular(path, status)
        if status.st_size > most:
            raise TooLargeError
        return _read_all(file, most), status


def read_start(path: Path, most: int = SEARCHED_BYTES) -> bytes | None:
    """Return the first `most` bytes of a file; None if it is not a regular file or cannot be read."""
    try:
        _check_regular(path, path.stat())
        with path.open("rb") as file:
            return file.read(most)
    except (OSError, ValueError):
        return None


def _check_regular(path: Path, status: os.stat_result) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise NotAFileError(path, status.st_mode)


def stamp_of_data(data: bytes, changed: int = 0) -> Stamp:
    """Return the stamp of a file with this content."""
    # a checksum against mistakes, not against forgery: hashlib would load OpenSSL at every start
    return Stamp(len(data), changed, f"{crc32(data):08x}{adler32(data):08x}")


def stamp_of(path: Path, most: int = MAX_PROGRAM_BYTES) -> Stamp | None:
    """Return the file's current stamp, None if it cannot be read."""
    try:
        data, status = read_file(path, most)
        return stamp_of_data(data, status.st_mtime_ns)
    except (OSError, ValueError):
        return None


def load(path: str | Path) -> Program:
    """Return the program in a file; StoreError says what is wrong with it and what to do."""
    path = Path(path)
    try:
        data, _ = read_file(path, MAX_PROGRAM_BYTES)
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
    try:
        return loads_bytes(data, str(path))
    except StoreError as error:
        kind = ""
        if is_drawing(path):
            kind = "a drawing, not a contour program. cutcomp import makes one of it."
        elif path.suffix.lower() in NC_SUFFIXES - {".txt"}:
            kind = "an NC program, not a contour program. cutcomp check tells what the controls do with it."
        if holds_program(data) or not kind:
            raise
        raise StoreError(f"{path} is {kind}") from error


def holds_program(data: bytes) -> bool:
    """True if a file's content, or its beginning, is that of a contour program."""
    return _PROGRAM.match(data[:SEARCHED_BYTES]) is not None


def load_from(stream: BinaryIO, name: str) -> Program:
    """Return the program read from a stream, such as a pipe; StoreError calls it `name`."""
    try:
        data = _read_all(stream)
    except (OSError, ValueError) as error:
        raise StoreError(f"{name} cannot be read: {why(error)}") from error
    return loads_bytes(data, name)


class TooLargeError(OSError):
    """The file is larger than the limit for its kind."""

    def __init__(self) -> None:
        super().__init__(errno.EFBIG, "too large")


def _read_all(file: BinaryIO, most: int = MAX_PROGRAM_BYTES) -> bytes:
    data = file.read(most + 1) or b""
    if len(data) > most:
        raise TooLargeError
    return data


def save(program: Program, path: str | Path) -> None:
    """Write a program to a file; see `write_data`."""
    write_text(path, dumps(program))


def write_text(path: str | Path, text: str) -> str:
    """Write a text to a file; see `write_data`."""
    try:
        data = text.encode()
    except ValueError as error:
        raise StoreError(f"{path} is not saved: {why(error)}") from error
    return write_data(path, data)


def write_data(path: str | Path, data: bytes) -> str:
    """Write a file, through a symbolic link if it is one; return why it was written in place, empty if it was not.

    The file keeps its owner, group, mode, extended attributes and links.  It is replaced in one step; if that would
    lose one of them, it is overwritten in place while a complete copy of the new content lies beside it.  After a
    StoreError the old file is unchanged and no temporary file is left.
    """
    try:
        return _write(Path(os.path.realpath(path)), data)
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} is not saved: {why(error)}") from error


def write_output(path: Path, text: str) -> None:
    """Write output made from a program, such as NC text; raise StoreError if it would replace a program."""
    refuse_program(path)
    write_text(path, text)


def refuse_program(path: Path) -> None:
    """Raise StoreError if the path is that of a program, which output must not replace."""
    if path.suffix.lower() == ".toml" or holds_program(read_start(path) or b""):
        raise StoreError(f"{path} is a program and would be overwritten. Choose another name.")


def temporary_path(target: Path) -> Path:
    """Return a temporary path for a file's new content."""
    return target.with_name(f".{short_name(target.name)}.{os.urandom(6).hex()}.tmp")


def remove_killed_saves(path: Path) -> None:
    """Remove the temporary files of this login's killed saves of a file; the journal holds what they were to write.

    Those that are younger than `MAX_SAVE_SECONDS` may still be written.
    """
    target = Path(os.path.realpath(path))
    name = re.compile(re.escape(f".{short_name(target.name)}.") + r"[0-9a-f]{12}\.tmp")
    with suppress(OSError):
        for file in target.parent.iterdir():
            if name.fullmatch(file.name):
                status = file.lstat()
                if status.st_uid == os.geteuid() and status.st_mtime < time() - MAX_SAVE_SECONDS:
                    file.unlink()


def short_name(name: str) -> str:
    """Return a file's name, cut so that a hidden name made from it stays within 255 bytes."""
    return name.encode("utf-8", "surrogateescape")[:MAX_NAME_BYTES].decode("utf-8", "ignore")


def _write(target: Path, data: bytes) -> str:
    old = _status(target)
    temporary = temporary_path(target)
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666 if old is None else 0o600)
    try:
        try:
            write_all(handle, data)
            reason = "" if old is None else _taken_on(handle, target, old)
            os.fsync(handle)
        finally:
            # some network folders report a full disk only here
            os.close(handle)
        if old is None:
            temporary.replace(target)
        elif reason := reason or _put_in_place_of(temporary, target):
            _write_in_place(target, data, old)
            temporary.unlink()
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    sync_folder(target.parent)
    return reason


def _put_in_place_of(temporary: Path, target: Path) -> str:
    """Rename a file over another; return why not if the folder protects other users' files, else an empty text."""
    try:
        temporary.replace(target)
    except PermissionError:
        if not target.exists():
            raise
        return "its folder lets nobody replace it"
    return ""


def _taken_on(handle: int, target: Path, old: os.stat_result) -> str:
    """Copy the old file's owner, group, mode and attributes; return what cannot be copied, empty if nothing."""
    if old.st_nlink > 1:
        return "it has more than one name"
    new = os.fstat(handle)
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.fchown(handle, old.st_uid, old.st_gid)
        except PermissionError:
            return "it stays its owner's" if new.st_uid != old.st_uid else "it keeps its group"
    os.fchmod(handle, stat.S_IMODE(old.st_mode))
    return _copy_attributes(handle, target)


def _copy_attributes(handle: int, target: Path) -> str:
    try:
        names = os.listxattr(target)
    except OSError:
        # a file system that has no attributes or does not list them
        return ""
    try:
        for name in names:
            os.setxattr(handle, name, os.getxattr(target, name))
    except OSError:
        return "it keeps its attributes"
    return ""


def _write_in_place(target: Path, data: bytes, old: os.stat_result) -> None:
    """Overwrite a file in place; restore the old content after an error."""
    before = target.read_bytes()
    handle = os.open(target, os.O_WRONLY | os.O_CLOEXEC | os.O_NOFOLLOW)
    try:
        try:
            if len(data) > old.st_size:
                _reserve(handle, len(data))
            _overwrite(handle, data)
        except BaseException:
            with suppress(OSError):
                _overwrite(handle, before)
            raise
    finally:
        os.close(handle)


def _reserve(handle: int, size: int) -> None:
    """Reserve room for a longer file before it is overwritten; some file systems cannot, which is no error."""
    try:
        os.posix_fallocate(handle, 0, size)
    except OSError as error:
        if error.errno not in (errno.ENOTSUP, errno.EOPNOTSUPP, errno.EINVAL, errno.ENODEV):
            raise


def _overwrite(handle: int, data: bytes) -> None:
    os.lseek(handle, 0, os.SEEK_SET)
    write_all(handle, data)
    os.ftruncate(handle, len(data))
    os.fsync(handle)


def _status(target: Path) -> os.stat_result | None:
    """Return the old file's status, None if there is none; raise OSError if it cannot be replaced."""
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
    """Write every byte; after an OSError some may be written."""
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def sync_folder(folder: Path) -> None:
    """Force a folder's new names to disk; some file systems cannot, but each file is complete all the same."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


_REASONS: Final[Mapping[int, str]] = {
    errno.ENOSPC: "the disk is full. Make room or save elsewhere.",
    errno.EDQUOT: "the disk is full. Make room or save elsewhere.",
    errno.EISDIR: "this is not a file. Choose the name of a file.",
    errno.ENOTDIR: "a part of the path is no folder. Check the name.",
    errno.ENOENT: "there is no such file or folder. Check the name.",
    errno.EROFS: "the disk is write protected. Choose another place.",
    errno.EFBIG: "the system lets nobody write a file of this size. Ask for a higher limit, or save elsewhere.",
    errno.ENAMETOOLONG: "the name is too long. Choose a shorter one.",
    errno.ELOOP: "its links lead round in a circle. Choose another file.",
    errno.ENXIO: "this is not a file. Choose the name of a file.",
    errno.EIO: "the disk or the network fails. Try again or choose another place.",
    errno.ESTALE: "the network folder is gone. Try again or choose another place.",
    errno.ETIMEDOUT: "the network does not answer. Try again or choose another place.",
    errno.EMFILE: "too many files are open. Close some and try again.",
    errno.ENFILE: "too many files are open. Close some and try again.",
    errno.ETXTBSY: "it is being run. Choose another name.",
    errno.EBUSY: "it is in use. Try again or choose another name.",
}


def why(error: OSError | ValueError) -> str:
    """Return why a file cannot be read or written, and the remedy."""
    if isinstance(error, NotAFileError):
        return f"this is {error.what}. Choose the name of a file."
    if isinstance(error, TooLargeError):
        return "it is too large. Choose another file."
    if not isinstance(error, OSError):
        return "that is not a file name. Choose another."
    if isinstance(error, TimeoutError) and error.errno is None:
        # the program's own limit, see `time_limits.within`
        return f"{error}."
    if error.errno in (errno.EACCES, errno.EPERM):
        # if the file does not exist, its folder is what refuses to find or create it
        exists = not isinstance(error.filename, str | Path) or os.path.lexists(error.filename)
        what = "it" if exists else "its folder"
        return f"{what} is protected. Ask for permission, or choose another place."
    reason = None if error.errno is None else _REASONS.get(error.errno)
    return reason or f"{error.strerror or 'the system refuses'}. Try again or choose another place."
