"""The entry of the screens: prepares the terminal's side of Textual, then imports and runs the App."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.shell import UNUSABLE, say
from app.documents.files import load
from app.documents.naming import program_named
from app.painted.beforehand import prepare
from core.program.file.read import StoreError

if TYPE_CHECKING:
    from app.painted.application import CutcompApp
    from app.painted.keeping import Keeping
    from app.painted.nc_keeping import NcKeeping
    from app.painted.screens.page import Page
    from app.painted.session import Session


def run(
    path: Path | None,
    *,
    example: str | None = None,
    page: Callable[[], Page] | None = None,
    characters: str = "",
) -> int:
    """Show the screens on a program file, an example or an empty program; returns the exit status.

    `page` makes the only screen where it is another than those of the program, `characters` are those the operator
    wants the drawing in.
    """
    prepare()
    from app.terminal import driver
    from app.terminal import key_sequences as keys

    reason = "" if in_browser() else driver.refusal(os.environ)
    if reason:
        say(reason)
        return UNUSABLE
    try:
        session = begin(path, example)
        only = None if page is None else page()
    except StoreError as error:
        say(str(error))
        return UNUSABLE
    keys.teach()
    first = path is None and example is None and only is None
    return guarded(session, first=first, only=only, characters=characters)


def guarded(session: Session, *, first: bool = False, only: Page | None = None, characters: str = "") -> int:
    """The App on a session, with its work kept and its end in order; returns the exit status."""
    from app.painted.application import CutcompApp
    from app.painted.keeping import Keeping
    from app.painted.nc_keeping import NcKeeping
    from app.terminal import driver
    from app.terminal.capabilities import monochrome
    from app.terminal.signals import Safety

    keeping, nc_keeping = Keeping(), NcKeeping()
    if not in_browser() and monochrome(os.environ):
        os.environ["NO_COLOR"] = "1"
    few = not in_browser() and driver.few_colors(os.environ)
    app = CutcompApp(session, keep=lambda desk: nc_keeping.keep(keeping.keep(desk)), few_colors=few)
    keep_settings(app, first=first)
    if only is not None:
        app.desk = nc_keeping.keep(replace(app.desk, pages=(only,)))
    if not in_browser():
        settle_terminal(app, characters)
    safety = Safety(lambda status: app.exit(status, return_code=status), lambda: closed(keeping, nc_keeping))
    safety.arm()
    try:
        app.run(mouse=False)
    finally:
        closed(keeping, nc_keeping)
    if safety.status is not None:
        safety.leave()
    return app.return_code or 0


def closed(keeping: Keeping, nc_keeping: NcKeeping) -> None:
    """The end of the journals and locks."""
    try:
        keeping.close()
    finally:
        nc_keeping.close()


def settle_terminal(app: CutcompApp, wanted: str) -> None:
    """Our driver, and the characters that the terminal takes: those of last time if it can have them."""
    from app.terminal import character_set as charset
    from app.terminal import driver

    app.driver_class = driver.TerminalDriver
    name, modes = driver.characters(charset.own(os.environ), wanted)
    charset.settle(sys.__stderr__, name)
    mode = app.desk.settings.mode
    app.desk = replace(app.desk, modes=modes, mode=mode if mode in modes and not wanted else modes[0])


def in_browser() -> bool:
    """Whether `cutcomp serve` has started this: Textual's own driver then talks to the browser."""
    return bool(os.environ.get("TEXTUAL_DRIVER"))


def keep_settings(app: CutcompApp, *, first: bool) -> None:
    """Take up what stays from one time to the next, and keep it from now on; `first` begins with the start screen.

    That this file was the last one is put on the disk once the first screen stands.
    """
    from app.painted import settings

    file = settings.place()
    held, trouble = settings.load(file)
    keeper, keep = settings.Keeper(file, held), app.keep
    app.keep = lambda desk: keeper.keep(keep(desk))
    desk = settings.taken_up(app.desk, held, trouble)
    if first:
        from app.painted import starting

        desk = starting.begun(desk)
    app.desk = desk


def begin(path: Path | None, example: str | None) -> Session:
    """The session to begin with; StoreError when the file is none."""
    from app.documents import programs as files
    from app.painted.opened import opened
    from app.painted.session import Session

    if example is not None:
        return replace(Session.of(load(files.example(example))), title=example)
    if path is None:
        return Session.of(files.empty_program())
    path = program_named(path)
    if not path.exists() and path.parent.is_dir():
        return Session.of(files.empty_program(), path).saying(f"{path} does not exist yet: saving makes it.")
    try:
        return opened(path)
    except StoreError as error:
        from app.painted.rescue import rescued

        return rescued(path, error)
