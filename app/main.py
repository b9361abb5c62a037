"""The entry of the screens: prepares the terminal's side of Textual, then imports and runs the App."""

from __future__ import annotations

import gc
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from core.program.store import StoreError, load

if TYPE_CHECKING:
    from app.session import Session

UNUSABLE: Final = 2
"""Exit status: the file cannot be used."""


def run(path: Path | None, *, example: str | None = None) -> int:
    """Show the screens on a program file, an example or an empty program; returns the exit status."""
    prepare()
    from app import driver, keys
    from app.application import CutcompApp

    try:
        session = begin(path, example)
    except StoreError as error:
        print(f"cutcomp: {error}", file=sys.stderr)
        return UNUSABLE
    keys.teach()
    driver.be_lenient()
    app = CutcompApp(session)
    app.run(mouse=False)
    return app.return_code or 0


def prepare() -> None:
    """What must be so before Textual is imported.

    Without the first, F3 of some terminals is lost.  The imports make hundreds of thousands of objects that stay:
    looking through them again and again costs a tenth of the start, so the App switches the collector on again.
    """
    os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")
    gc.disable()


def begin(path: Path | None, example: str | None) -> Session:
    """The session to begin with; StoreError when the file is none."""
    from app import files
    from app.session import Session

    if example is not None:
        return Session.of(load(files.example(example)))
    if path is None:
        return Session.of(files.empty_program())
    if not path.exists() and path.parent.is_dir():
        return Session.of(files.empty_program(), path).saying(f"{path} does not exist yet: saving makes it.")
    return Session.of(load(path), path)
