"""How the start screen comes to be: which folder, which lists, and what its keys do to the desk."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.documents import programs as files
from app.documents.patience import FOLDER, within
from app.painted import places
from app.painted.messages import Say
from app.painted.screens.program import ProgramPage
from app.painted.screens.start import SHOWN, Entry, Group, StartPage
from app.painted.session import Tone
from app.painted.settings import Settings
from core.units import Unit

if TYPE_CHECKING:
    from app.painted.desk import Desk


def begun(desk: Desk) -> Desk:
    """The desk with the start screen below what already asks."""
    settings, folder, trouble = desk.settings, Path.cwd(), ""
    try:
        folder = within(FOLDER, lambda: first_folder(settings))
    except OSError as error:
        trouble = _trouble(folder, error)
    page = _page(settings, folder, first=True, trouble=trouble)
    return replace(desk, pages=(ProgramPage(), page, *desk.pages[2:]))


def shown(desk: Desk) -> Desk:
    """The start screen put on top, in the folder of the program."""
    file = desk.session.file
    folder = file.parent if file is not None else first_folder(desk.settings)
    return replace(desk, pages=(*desk.pages, _page(desk.settings, folder, first=False)))


def first_folder(settings: Settings) -> Path:
    """The folder one is in, if there are programs in it; else the last one used, if it is still there."""
    here, last = Path.cwd(), Path(settings.folder or os.curdir)
    if settings.folder and last.is_dir() and not any(not entry.folder for entry in _inside(here)):
        return last
    return here


def walk(folder: Path) -> Callable[[Desk], Desk]:
    """What shows another folder."""

    def work(desk: Desk) -> Desk:
        page = desk.page
        if not isinstance(page, StartPage):
            return desk
        try:
            entries = _entries(desk.settings, folder)
        except OSError as error:
            return desk.take(Say(_trouble(folder, error), Tone.ERROR))
        inside = [row for row, entry in enumerate(entries) if entry.group is Group.FOLDER]
        back = (row for row in inside[1:] if entries[row].path == page.folder)
        there = next((row for row in inside if not entries[row].folder), inside[0])
        page = replace(page, folder=folder, entries=entries, row=next(back, there), unseen=_files(entries), trouble="")
        settings = replace(desk.settings, folder=str(folder)) if str(folder).isprintable() else desk.settings
        return replace(desk, pages=(*desk.pages[:-1], page), settings=settings)

    return work


def other_unit(unit: Unit) -> Callable[[Desk], Desk]:
    """What makes new programs begin in another unit."""

    def work(desk: Desk) -> Desk:
        page = desk.page
        if not isinstance(page, StartPage):
            return desk
        settings = replace(desk.settings, unit=unit)
        desk = replace(desk, settings=settings, pages=(*desk.pages[:-1], replace(page, unit=unit)))
        return desk.take(Say(f"New programs begin in {unit}."))

    return work


def guide(desk: Desk) -> Desk:
    """What begins the guided first part."""
    from app.painted.guide import begin

    return begin(desk)


def _page(settings: Settings, folder: Path, *, first: bool, trouble: str = "") -> StartPage:
    """The screen; of a folder that cannot be read, or has kept us waiting already, only what is to be said."""
    entries = tuple(_lists(settings, ()))
    try:
        entries = entries if trouble else _entries(settings, folder)
    except OSError as error:
        folder, trouble = Path.home(), _trouble(folder, error)
    row = next((row for row, entry in enumerate(entries) if not entry.folder), 0)
    return StartPage(folder, entries, settings.unit, first, row, unseen=_files(entries), trouble=trouble)


def _trouble(folder: Path, error: OSError) -> str:
    return f"{folder} cannot be shown: {error.strerror or error}."


def _files(entries: tuple[Entry, ...]) -> tuple[Path, ...]:
    return tuple(dict.fromkeys(entry.path for entry in entries if not entry.folder))


def _entries(settings: Settings, folder: Path) -> tuple[Entry, ...]:
    """The whole list; OSError when the folder cannot be read, or does not answer."""
    return tuple(_lists(settings, within(FOLDER, lambda: tuple(_inside(folder)))))


def _lists(settings: Settings, inside: tuple[Entry, ...]) -> Iterator[Entry]:
    recent = [Path(name) for name in settings.recent]
    for path in recent:
        yield Entry(Group.RECENT, path, _told_apart(path, recent))
    yield from inside
    for path in sorted(files.example("pocket").parent.glob("*.toml")):
        yield Entry(Group.EXAMPLE, path, path.stem)


def _told_apart(path: Path, among: list[Path]) -> str:
    """A program's name, and where others have the same, as much of its folder as no other one has."""
    others = [other.parent.parts for other in among if other.stem == path.stem and other != path]
    if not others:
        return path.stem
    folder = path.parent.parts
    ends = (folder[-many:] for many in range(1, len(folder)))
    end = next((end for end in ends if all(other[-len(end) :] != end for other in others)), folder)
    return f"{path.stem} ({Path(*end)})"


def _inside(folder: Path) -> Iterator[Entry]:
    """The folder above, the programs and the folders of a folder in order of names."""
    with os.scandir(folder) as found:
        inside = sorted(found, key=lambda one: one.name.lower())
    yield Entry(Group.FOLDER, folder.parent, "..", folder=True)
    programs = [one for one in inside if one.name.lower().endswith(".toml") and not one.is_dir()]
    folders = [one for one in inside if not one.name.startswith(".") and one.is_dir()]
    saved = [path for path in (Path(one.path) for one in programs[:SHOWN]) if files.is_program(path)]
    for path in sorted((*saved, *places.never_saved(folder, places.own_folder())), key=lambda path: path.name.lower()):
        yield Entry(Group.FOLDER, path, path.name.removesuffix(".toml"))
    for one in folders[:SHOWN]:
        yield Entry(Group.FOLDER, Path(one.path), one.name, folder=True)
