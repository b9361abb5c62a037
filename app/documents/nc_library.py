"""This module finds the programs that a control calls by number or label, in the calling program's folder."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.documents.files import read_file, read_start
from app.documents.nc_text import MAX_NC_BYTES, NC_SUFFIXES
from core.units import plain

PROGRAM_FILE_NAMES: Final = (
    *("O{0:04}", "O{0:04}.nc", "{0:04}.nc", "{0}.nc"),
    *("O{0:04}.txt", "{0}.txt", "{0}.tap", "{0}.eia"),
)
"""The names that the file of program number {0} may have; the folder stands for the control's memory."""

MAX_SEARCHED_FILES: Final = 500
_NUMBER: Final = re.compile(rb"^[ \t]*[O:][ \t]*([0-9]{1,8})(?![0-9.])", re.MULTILINE | re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class FolderLibrary:
    """The programs of a folder by number or label; None, for a text without a folder, finds none."""

    folder: Path | None

    def __call__(self, program: int | str) -> tuple[str, bytes] | None:
        """Return the name and text of a program, None if it has no readable file.

        A str is the label by which LinuxCNC calls a subprogram.
        """
        if self.folder is None:
            return None
        path = self._labeled(program) if isinstance(program, str) else self._numbered(program)
        if path is None:
            return None
        try:
            text = read_file(path, MAX_NC_BYTES)[0]
        except (OSError, ValueError):
            return None
        return plain(path.name), text

    def _labeled(self, label: str) -> Path | None:
        """Return the file named by a label; None if the label leads to another folder or there is no such file."""
        assert self.folder is not None
        path = self.folder / f"{label}.ngc"
        with suppress(OSError, ValueError):
            return path if path.parent == self.folder and path.is_file() else None
        return None

    def _numbered(self, number: int) -> Path | None:
        assert self.folder is not None
        named = (self.folder / form.format(number) for form in PROGRAM_FILE_NAMES)
        return next((path for path in named if path.is_file()), None) or self._beginning_with(number)

    def _beginning_with(self, number: int) -> Path | None:
        """Return the file whose first program has this number, whatever the file's name."""
        assert self.folder is not None
        with suppress(OSError):
            files = sorted(path for path in self.folder.iterdir() if path.suffix.lower() in NC_SUFFIXES)
            for path in files[:MAX_SEARCHED_FILES]:
                if (first := _NUMBER.search(read_start(path) or b"")) and int(first[1]) == number:
                    return path
        return None
