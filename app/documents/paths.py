"""This module reads file paths as an operator types them, finds the chosen folder, and names paths in sentences.

The chosen folder is that of the open file, or the current one for work without a name.  A name without a folder means a
file there, and nothing is written elsewhere without a question.  An impossible path is reported where it is used.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

from core.units import plain

MAX_PATH_IN_SENTENCE: Final = 60
"""The most characters of a path in a sentence."""


# ---- typed names


def path_of_text(text: str) -> Path:
    """Return the path of a typed name with ~ expanded, unless no home folder is known for it."""
    path = Path(text.strip())
    try:
        return path.expanduser()
    except RuntimeError:
        return path


def is_drawing(path: Path) -> bool:
    """True if a path has the ending of a drawing."""
    return path.suffix.lower() == ".dxf"


def is_folder(path: Path) -> bool:
    """True if the folder exists; False also for a name that no file can have."""
    try:
        return path.is_dir()
    except OSError:
        return False


def with_suffix(path: Path, suffix: str) -> Path:
    """Add a suffix unless the path has one or is a folder; the 5 of `bracket 1.5` is no suffix."""
    ending = path.suffix[1:]
    return path if is_folder(path) or (ending.isalnum() and ending[0].isalpha()) else path.with_name(path.name + suffix)


def as_program(path: Path) -> Path:
    """Return the path as the name of a program: only files that end in .toml are listed."""
    return path if is_folder(path) or path.suffix.lower() == ".toml" else path.with_name(f"{path.name}.toml")


def program_named(path: Path) -> Path:
    """Return the program that a name means: the file if it exists, else the name that SAVE AS would give it."""
    try:
        exists = path.exists() or path.is_symlink()
    except OSError:
        return path
    return path if exists else as_program(path)


# ---- the chosen folder


def resolved_name(path: Path, file: Path | None) -> Path:
    """Return where a typed name leads: beside the open file if it names no folder."""
    return path if file is None or path.name != str(path) else file.parent / path


def is_outside_folder(path: Path, file: Path | None) -> bool:
    """True if a file would be written outside the chosen folder, even through a link; False for a folder."""
    return not is_folder(path) and not Path(os.path.realpath(path)).is_relative_to(folder(file))


def folder(file: Path | None) -> Path:
    """Return the chosen folder as an absolute path without links."""
    return Path(os.path.realpath(file.parent if file is not None else current_folder()))


def current_folder() -> Path:
    """Return the current folder, or the home folder if that is gone."""
    try:
        return Path.cwd()
    except OSError:
        return Path.home()


# ---- in sentences


def written_path(path: Path) -> str:
    """Name a file that was written: by its absolute path if it is not in the current folder."""
    here = Path(os.path.realpath(path)).parent == folder(None)
    return printable_path(path.name) if here else printable_path(Path(os.path.normpath(current_folder() / path)))


def printable_path(path: Path | str) -> str:
    """Return a path without control characters."""
    return plain(str(path))


def short_path(path: Path | str) -> str:
    """Return a path for a sentence: only the end of a long one."""
    text = printable_path(path)
    return text if len(text) <= MAX_PATH_IN_SENTENCE else f"...{text[3 - MAX_PATH_IN_SENTENCE :]}"
