"""The entry of the screens made of Textual's widgets: prepares the terminal, then runs the App."""

from __future__ import annotations

import gc
import os
import sys
from pathlib import Path
from typing import Any

from app.cli.shell import UNUSABLE, say
from app.documents.document import ContourDocument
from app.documents.naming import program_named
from app.documents.service import DocumentService, Opened, Trouble
from app.documents.settings import SettingsFile, load_settings, settings_file
from core.program.file.read import StoreError


def run(path: Path | None, *, example: str | None = None, characters: str = "", light: bool = False) -> int:
    """Show the screens on a program file, an example or an empty program; returns the exit status."""
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    # the imports make objects that stay: looking through them again and again costs a tenth of the start
    gc.disable()
    from app.app import CutcompApp
    from app.file_actions import session_of
    from app.terminal import character_set, driver, key_sequences
    from app.terminal.capabilities import monochrome
    from app.terminal.key_order import WidgetDriver
    from app.terminal.signals import Safety

    if reason := driver.refusal(os.environ):
        say(reason)
        return UNUSABLE
    service = DocumentService()
    try:
        opened = begin(service, path, example)
    except StoreError as error:
        say(str(error))
        return UNUSABLE
    if isinstance(opened, Trouble):
        say(opened.text)
        return UNUSABLE
    key_sequences.teach()
    if monochrome(os.environ):
        os.environ["NO_COLOR"] = "1"
    name, character_sets = driver.characters(character_set.own(os.environ), characters)
    settings, _ = load_settings(settings_file())
    if settings.characters in character_sets and not characters:
        character_sets = (settings.characters, *(each for each in character_sets if each != settings.characters))
    program = opened.document if isinstance(opened.document, ContourDocument) else service.new().document
    app = CutcompApp(
        session_of(program),
        character_sets=character_sets,
        few_colors=driver.few_colors(os.environ),
        light=light or settings.theme == "light",
        service=service,
        opened=opened,
        settings_file=SettingsFile(settings_file(), settings),
        home=path is None and example is None,
    )
    app.driver_class = WidgetDriver
    character_set.settle(sys.__stderr__, name)
    safety = Safety(lambda status: app.exit(status, return_code=status), service.stop)
    safety.arm()
    try:
        app.run(mouse=False)
    finally:
        service.stop()
    if safety.status is not None:
        safety.leave()
    return app.return_code or 0


def begin(service: DocumentService, path: Path | None, example: str | None) -> Opened[Any] | Trouble:
    """The document to begin with; StoreError when the file is none."""
    if example is not None:
        return service.example(example)
    return service.new(offers=True) if path is None else service.open(program_named(path))
