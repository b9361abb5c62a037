"""Journals that were set aside: what OPEN lists of them, and the way back to the work in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents import times
from app.documents.journal_file import SUFFIX, journal_path, place_of, why_aside
from app.painted import places
from app.painted.messages import Load, Message, Say
from app.painted.session import Tone
from app.painted.widgets.header import printable

if TYPE_CHECKING:
    from app.painted.desk import Desk

MOST: Final = 20
"""So many are listed, the last ones; the folder holds the others."""
UNNAMED: Final = "a program without a name"
CUT: Final = 100
"""Characters from which on the name of a journal may not hold all of its file's name."""
WORDS: Final = {"kept": "kept", "discarded": "discarded", "theirs": "taken-over", "damaged": "damaged"}


def copies(folder: Path, own: Path, *, nc: bool) -> Iterator[tuple[Path, str]]:
    """The journals set aside in a folder and in a person's own one, the last one first, each as OPEN names it."""
    found = [path for place in dict.fromkeys((folder, own)) for path in _inside(place)]
    of_kind = [
        (time, path) for time, path in found if _is_nc(path) in (nc, None) and (not nc or _here(path, folder, own))
    ]
    today = times.now()
    for time, path in sorted(of_kind, reverse=True)[:MOST]:
        word = WORDS[why_aside(path).partition("-")[0]]
        when = times.in_words(times.of(time), today).removeprefix("on ")
        yield path, f"{word} work, {when}: {printable(_name(path))}"


def _here(path: Path, folder: Path, own: Path) -> bool:
    """Whether the journal of an NC program is about a file of this folder: it does not say of which one it is."""
    return path.name.startswith(".") or place_of(path) == places.elsewhere(file_of(path, folder), own)


def file_of(path: Path, folder: Path) -> Path:
    """The file in a folder that a journal is about."""
    return folder / _name(path)


def _inside(folder: Path) -> Iterator[tuple[int, Path]]:
    with suppress(OSError):
        for path in folder.glob(f".*{SUFFIX}.*") if folder != places.own_folder() else folder.glob(f"*{SUFFIX}.*"):
            if why_aside(path).partition("-")[0] in WORDS:
                with suppress(OSError):
                    yield path.stat().st_mtime_ns, path


def _name(path: Path) -> str:
    """The name of the file that the work is about."""
    name = place_of(path).name.removesuffix(SUFFIX)
    if name.startswith("."):
        return name[1:]
    return UNNAMED if name.startswith("unnamed-") else name.rpartition("-")[0]


def _is_nc(path: Path) -> bool | None:
    """Whether it is about an NC program; None where the name is so long that its end is cut off."""
    name = _name(path)
    if name == UNNAMED:
        return False
    return None if len(name) >= CUT else not name.lower().endswith(".toml")


def opening(path: Path) -> Callable[[Desk], Desk]:
    """What opens the file that a copy is about and offers the work in the copy."""

    def work(desk: Desk) -> Desk:
        found = places.read(path)
        if found is None:
            return desk.take(Say(f"{printable(path.name)} cannot be read; it stays where it is.", Tone.ERROR))
        message: Message = Load(_program(path, found.head.file), earlier=path)
        return desk.take(message)

    return work


def _program(path: Path, file: str | None) -> Path | None:
    """The program of a journal that names a file: beside it, should the folder have moved; a long name is cut there."""
    if file is None or not path.name.startswith("."):
        return None if file is None else Path(file)
    beside = path.with_name(Path(file).name)
    return beside if journal_path(beside) == place_of(path.resolve()) else path.with_name(_name(path))
