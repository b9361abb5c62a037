"""The programs a control calls by their numbers: files of the folder a program is in, as in the control's memory."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.documents.files import read_file
from app.documents.nc_text import MAX_NC_BYTES

PROGRAM_FILE_NAMES: Final = (
    *("O{0:04}", "O{0:04}.nc", "{0:04}.nc", "{0}.nc"),
    *("O{0:04}.txt", "{0}.txt", "{0}.tap", "{0}.eia"),
)
"""How the file of program number {0} may be called that a control has in its memory."""


@dataclass(frozen=True, slots=True)
class FolderLibrary:
    """The programs of a folder by their numbers; None finds nothing, for a text that is in no folder yet."""

    folder: Path | None

    def __call__(self, number: int) -> tuple[str, bytes] | None:
        """The name and text of a program, None where there is no file of it that can be read."""
        for form in PROGRAM_FILE_NAMES if self.folder is not None else ():
            path = (self.folder or Path()) / form.format(number)
            if path.is_file():
                try:
                    text = read_file(path, MAX_NC_BYTES)[0]
                except (OSError, ValueError):
                    return None
                return "".join(sign if sign.isprintable() else "?" for sign in path.name), text
        return None
