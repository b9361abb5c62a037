"""The chosen folder: that of the file that is open, the current one for work without a name.

A name without a folder is taken beside the file that is open; nothing is written outside of it unasked.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

from app.documents.naming import is_folder
from core.units import plain

MAX_PATH_IN_SENTENCE: Final = 60
"""Characters of a path in a sentence."""


def chosen(path: Path, file: Path | None) -> Path:
    """Where a typed name leads: one without a folder beside the file that is open."""
    return path if file is None or path.name != str(path) else file.parent / path


def outside(path: Path, file: Path | None) -> bool:
    """Whether writing a path would write outside the chosen folder, be it through a link; a folder is not written."""
    return not is_folder(path) and not Path(os.path.realpath(path)).is_relative_to(folder(file))


def folder(file: Path | None) -> Path:
    """The chosen folder as a whole path without links."""
    return Path(os.path.realpath(file.parent if file is not None else current_folder()))


def current_folder() -> Path:
    """The current folder, or the home folder where that is gone."""
    try:
        return Path.cwd()
    except OSError:
        return Path.home()


def written_at(path: Path) -> str:
    """A file that was written: the whole path where it is not in the current folder."""
    here = Path(os.path.realpath(path)).parent == folder(None)
    return printable_path(path.name) if here else printable_path(Path(os.path.normpath(current_folder() / path)))


def printable_path(path: Path | str) -> str:
    """A whole path without control characters."""
    return plain(str(path))


def short_path(path: Path | str) -> str:
    """A path as a sentence names it: of a long one the end, so that what the sentence says has room behind it."""
    text = printable_path(path)
    return text if len(text) <= MAX_PATH_IN_SENTENCE else f"...{text[3 - MAX_PATH_IN_SENTENCE :]}"
