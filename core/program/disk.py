"""What every file needs that must survive a power cut, and the sentences for disks that do not oblige."""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from pathlib import Path


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


def _there(error: OSError | ValueError) -> bool:
    """Whether an error is about a file that there is: what cannot be made, or found, is kept out by its folder."""
    name = error.filename if isinstance(error, OSError) else None
    return not isinstance(name, str | Path) or os.path.lexists(name)


def why(error: OSError | ValueError) -> str:
    """The reason why a file cannot be read or written, and the remedy."""
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
            return "this is no file name. Choose another."
        case _:
            return (
                f"{error.strerror or error}. Try again or choose another place." if isinstance(error, OSError) else ""
            )
