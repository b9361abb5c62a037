"""This module finds the programs that a control calls by number or label, in the calling program's folder."""

from __future__ import annotations

import re
from contextlib import suppress
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


def called_program(folder: Path | None, program: int | str) -> tuple[str, bytes] | None:
    """Return the name and text of a program in a folder, None if it has no readable file there, or no folder.

    A str is the label by which LinuxCNC calls a subprogram.
    """
    if folder is None:
        return None
    with suppress(OSError, ValueError):
        path = folder / f"{program}.ngc" if isinstance(program, str) else _numbered(folder, program)
        # a label must not lead to another folder
        if path is not None and path.parent == folder and path.is_file():
            return plain(path.name), read_file(path, MAX_NC_BYTES)[0]
    return None


def _numbered(folder: Path, number: int) -> Path | None:
    """Return the file named by a number, else the one whose first program has it."""
    named = (folder / form.format(number) for form in PROGRAM_FILE_NAMES)
    if (path := next((path for path in named if path.is_file()), None)) is not None:
        return path
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in NC_SUFFIXES)
    starts = ((path, _NUMBER.search(read_start(path) or b"")) for path in files[:MAX_SEARCHED_FILES])
    return next((path for path, first in starts if first and int(first[1]) == number), None)
