"""The entry of the screens made of Textual's widgets: prepares the terminal, then runs the App."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from app.cli.shell import UNUSABLE, say
from app.documents.files import load
from app.documents.programs import empty_program
from app.documents.programs import example as example_file
from app.session.session import Session
from core.program.file.read import StoreError


def run(path: Path | None, *, example: str | None = None, characters: str = "", light: bool = False) -> int:
    """Show the screens on a program file, an example or an empty program; returns the exit status."""
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    from app.app import CutcompApp
    from app.terminal import character_set, driver, key_sequences
    from app.terminal.capabilities import monochrome
    from app.terminal.key_order import WidgetDriver
    from app.terminal.signals import Safety

    if reason := driver.refusal(os.environ):
        say(reason)
        return UNUSABLE
    try:
        session = begin(path, example)
    except StoreError as error:
        say(str(error))
        return UNUSABLE
    key_sequences.teach()
    if monochrome(os.environ):
        os.environ["NO_COLOR"] = "1"
    name, modes = driver.characters(character_set.own(os.environ), characters)
    app = CutcompApp(session, character_sets=modes, few_colors=driver.few_colors(os.environ), light=light)
    app.driver_class = WidgetDriver
    character_set.settle(sys.__stderr__, name)
    safety = Safety(lambda status: app.exit(status, return_code=status), lambda: None)
    safety.arm()
    app.run(mouse=False)
    if safety.status is not None:
        safety.leave()
    return app.return_code or 0


def begin(path: Path | None, example: str | None) -> Session:
    """The session to begin with; StoreError when the file is none."""
    if example is not None:
        return Session.of(load(example_file(example)), title=example)
    if path is None or not path.exists():
        return Session.of(empty_program(), path)
    return Session.of(load(path), path)
