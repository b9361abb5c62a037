"""Names of files as an operator types them; one that cannot be a name makes a sentence where it is used, never here."""

from __future__ import annotations

from pathlib import Path


def typed(text: str) -> Path:
    """The path of a typed name, the home folder filled in; a ~ that is nobody's home stays as it is."""
    path = Path(text.strip())
    try:
        return path.expanduser()
    except RuntimeError:
        return path


def is_drawing(path: Path) -> bool:
    """Whether a path is that of a drawing, by its ending."""
    return path.suffix.lower() == ".dxf"


def is_folder(path: Path) -> bool:
    """Whether there is such a folder; no for a name that no file can have."""
    try:
        return path.is_dir()
    except OSError:
        return False


def with_suffix(path: Path, suffix: str) -> Path:
    """The path with a suffix if it has none and is no folder: in `bracket 1.5` the 5 is none."""
    ending = path.suffix[1:]
    return path if is_folder(path) or (ending.isalnum() and ending[0].isalpha()) else path.with_name(path.name + suffix)


def as_program(path: Path) -> Path:
    """The path as the name of a program, which ends in .toml: no other file is listed."""
    return path if is_folder(path) or path.suffix.lower() == ".toml" else path.with_name(f"{path.name}.toml")


def program_named(path: Path) -> Path:
    """The program that a name means: what is there; else the name that SAVE AS would give it."""
    try:
        exists = path.exists() or path.is_symlink()
    except OSError:
        return path
    return path if exists else as_program(path)
