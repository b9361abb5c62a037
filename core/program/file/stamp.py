"""What a program file was when it was read: enough to notice that somebody has written it since."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from zlib import adler32, crc32

from core.program.file.store import LARGEST_FILE


@dataclass(frozen=True, slots=True)
class Stamp:
    """Size in bytes, time of the last change in nanoseconds since 1970, and a sum over the content."""

    size: int
    changed: int
    digest: str

    def same_content(self, other: Stamp) -> bool:
        """Whether both are of the same content; the time does not count, since a copy changes it."""
        return (self.size, self.digest) == (other.size, other.digest)


def stamp_of_data(data: bytes, changed: int = 0) -> Stamp:
    """The stamp of a file with this content."""
    # against mistakes, not against forgers: hashlib would load OpenSSL at every start
    return Stamp(len(data), changed, f"{crc32(data):08x}{adler32(data):08x}")


def stamp_of(path: Path) -> Stamp | None:
    """The file's stamp as it is now, None where there is no file that can be read."""
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
            return stamp_of_data(data, os.fstat(file.fileno()).st_mtime_ns)
    except (OSError, ValueError):
        return None
