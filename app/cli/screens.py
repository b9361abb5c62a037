"""This module starts the screens: it opens the document, prepares Textual for the terminal and runs the App.

`cutcomp proof` opens the screen NC PROOF on a file.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.cli.shell import NOTHING_ASKED, STATUS_UNUSABLE, TerminalOptions, Unusable, prepare, reported, say
from app.documents.document_service import DocumentService, Notice, Opened, Trouble
from app.documents.nc_text import NC_SUFFIXES
from app.documents.paths import is_drawing, is_folder, program_named
from app.documents.programs import is_nc
from app.documents.settings import SettingsFile, load_settings, settings_file
from app.documents.time_limits import EXIT_SECONDS

if TYPE_CHECKING:
    from textual.driver import Driver

    from app.app import CutcompApp
    from core.pipeline.checking import CheckRequest


def run(
    path: Path | None,
    *,
    example: str | None = None,
    check_request: CheckRequest | None = None,
    options: TerminalOptions = NOTHING_ASKED,
) -> int:
    """Show the screens on a program, an NC file, a drawing, an example or a folder; return the exit status.

    `check_request` holds the control, the tools and the unit of an NC file.
    """
    from app.terminal.capabilities import refusal

    if reason := "" if in_browser() else refusal(os.environ):
        say(reason)
        return STATUS_UNUSABLE
    if path is not None and check_request is None and is_folder(path):
        try:
            os.chdir(path)
        except OSError as error:
            say(f"{path}: {error.strerror}.")
            return STATUS_UNUSABLE
        path = None
    drawing = path if path is not None and check_request is None and is_drawing(path) else None
    service = DocumentService()
    opened: Opened[Any] | Trouble
    if drawing is not None:
        opened = service.new()
    else:
        opened = service.open(path) if check_request and path else begin(service, path, example)
    if isinstance(opened, Trouble):
        say(opened.text)
        return STATUS_UNUSABLE
    home = path is None and example is None
    app = make_app(service, opened, options, check_request, home=home)
    app.drawing = drawing
    return run_to_the_end(service, app, mouse=options.mouse or app.settings.mouse)


@reported
def proof(arguments: list[str]) -> int:
    """Run the command; return the exit status."""
    import argparse

    from app.cli.control_options import add_options, control_of, tools_of
    from core.pipeline.checking import CheckRequest
    from core.units import Unit

    parser = argparse.ArgumentParser(
        "cutcomp proof", description="The listing of an NC program, the path a control makes of it, and its findings."
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="an NC program")
    parser.add_argument("--control", metavar="NAME[:VARIANT]", help="the control; the screen changes it by key")
    add_options(parser)
    options = parser.parse_args(arguments)
    control = "" if options.control is None else control_of(options.control)
    request = CheckRequest(control, tools_of(options), shop=False, unit=Unit(options.units) if options.units else None)
    if options.file.is_file() and not is_nc(options.file):
        raise Unusable(f"{options.file} is a program, not an NC file: cutcomp {options.file} opens it.")
    prepare()
    return run(options.file, check_request=request)


def in_browser() -> bool:
    """True if `cutcomp serve` has started this process: a page then takes the place of the terminal."""
    return bool(os.environ.get("TEXTUAL_DRIVER"))


def begin(service: DocumentService, path: Path | None, example: str | None) -> Opened[Any] | Trouble:
    """Return the document to begin with, or the trouble with it."""
    if example is not None:
        return service.example(example)
    if path is not None and path.suffix.lower() in NC_SUFFIXES and not path.exists():
        return Trouble(f"{path}: there is no such NC program.")
    return service.new(offers=True) if path is None else service.open(program_named(path))


def make_app(
    service: DocumentService,
    opened: Opened[Any],
    options: TerminalOptions,
    check_request: CheckRequest | None,
    *,
    home: bool,
) -> CutcompApp:
    """Return the App on a document, set up for the terminal and with the settings of last time."""
    from app.app import CutcompApp
    from app.terminal import capabilities, driver

    driver.teach()
    driver_class: type[Driver]
    if in_browser():
        from app.terminal.browser import BrowserDriver

        driver_class, character_sets, few_colors = BrowserDriver, capabilities.CHARACTER_SETS, False
    else:
        if capabilities.monochrome(os.environ):
            os.environ["NO_COLOR"] = "1"
        environment = capabilities.operators_environment(os.environ)
        name, character_sets = capabilities.characters(environment, options.characters)
        capabilities.set_charset(sys.__stderr__, name)
        driver_class, few_colors = driver.TerminalDriver, capabilities.few_colors(os.environ)
    settings, trouble = load_settings(settings_file())
    if trouble and opened.notice is None:
        opened = replace(opened, notice=Notice(trouble, warning=True))
    if settings.characters in character_sets and not options.characters:
        character_sets = (settings.characters, *(each for each in character_sets if each != settings.characters))
    app = CutcompApp(
        character_sets=character_sets,
        few_colors=few_colors,
        light=options.light or settings.theme == "light",
        service=service,
        opened=opened,
        settings_file=SettingsFile(settings_file(), settings),
        home=home,
        check_request=check_request,
    )
    app.driver_class = driver_class
    return app


def run_to_the_end(service: DocumentService, app: CutcompApp, *, mouse: bool = False) -> int:
    """Run the App to its end, wanted or not; unsaved work stays in the journals."""
    from app.terminal.signals import Safety

    def stop_service() -> None:
        with suppress(TimeoutError):
            app.disk.do(service.stop, EXIT_SECONDS)

    safety = Safety(lambda status: app.exit(status, return_code=status), stop_service)
    safety.arm()
    try:
        app.run(mouse=mouse)
    finally:
        stop_service()
    if safety.status is not None:
        safety.leave()
    return app.return_code or 0
