"""The App: owns the one desk, hands keys to it, and has it painted."""

from __future__ import annotations

import os

os.environ.setdefault("TEXTUAL_DISABLE_KITTY_KEY", "1")

import sys
from pathlib import Path
from typing import ClassVar, Final

from textual.app import App

from app import driver, files, keys
from app.desk import Desk
from app.engine import Engine
from app.screens.frame import Frame, painted
from app.session import Session
from app.surroundings import Surroundings, real
from core.pipeline.derived import Derived, DerivedBlock
from core.pipeline.outline import outline
from core.program.store import StoreError, load

UNUSABLE: Final = 2
"""Exit status: the file cannot be used."""
PAUSE: Final = 0.1
"""Seconds without a key before a slow look-ahead table is calculated."""
MINUTE: Final = 60.0


class CutcompApp(App[int], inherit_bindings=False):
    """The screens.  The only place where the session changes hands."""

    CSS_PATH = "app.tcss"
    TITLE = "cutcomp"
    ENABLE_COMMAND_PALETTE = False
    BINDINGS: ClassVar = []

    def __init__(self, session: Session, around: Surroundings | None = None) -> None:
        super().__init__()
        self.desk = Desk(session)
        self.around = around or real()
        self.engine = Engine()
        self._cells = (80, 24)

    def get_default_screen(self) -> Frame:
        """The frame."""
        return Frame()

    def on_ready(self) -> None:
        """Once the first screen stands, fetch what it did not need."""
        self.set_interval(MINUTE, self.refresh_screen)
        self.run_worker(self._load, thread=True, group="load")

    def key(self, key: str, character: str | None) -> None:
        """A key was pressed."""
        self.desk = self.desk.press(key, character)
        self._advance()

    def paste(self, text: str) -> None:
        """Text was pasted."""
        self.desk = self.desk.paste(text)
        self._advance()

    def repaint(self, width: int, height: int) -> None:
        """The terminal has this size now."""
        self._cells = (width, height)
        self.refresh_screen()

    def refresh_screen(self) -> None:
        """Paint what changed."""
        frame = self.screen
        if isinstance(frame, Frame) and frame.is_mounted:
            known = self.engine.known(self.desk.session.found)
            frame.show(painted(self.desk, known, self.around, *self._cells))

    def _advance(self) -> None:
        """After every change of the desk: derive what is stale, paint, or leave."""
        if self.desk.exit:
            self.exit(0)
            return
        self._derive()
        self._tabulate()
        self.refresh_screen()

    def _load(self) -> None:
        self.engine.load()
        self.call_from_thread(self._loaded)

    def _loaded(self) -> None:
        self.engine.ready = True
        self._advance()

    def _derive(self) -> None:
        """Everything that follows from the program: now while it is fast, else in a thread."""
        session = self.desk.session
        if session.stale or not all(found.known for found in session.derived.blocks):
            if self.engine.fast("derive"):
                self._take(self.engine.derive(session.program, session.derived))
                return
            if session.stale:
                self._take(outline(session.program))
            if self.engine.ready:
                before = session.derived
                self.run_worker(lambda: self._derive_behind(before), thread=True, exclusive=True, group="derive")

    def _derive_behind(self, before: Derived) -> None:
        derived = self.engine.derive(self.desk.session.program, before)
        self.call_from_thread(self._derived, derived)

    def _derived(self, derived: Derived) -> None:
        self._take(derived)
        self._tabulate()
        self.refresh_screen()

    def _take(self, derived: Derived) -> None:
        self.desk = self.desk.knowing(derived)

    def _tabulate(self) -> None:
        """The look-ahead table of the block with the cursor, kept until the block changes."""
        session = self.desk.session
        found = session.found
        if self.engine.table_of is found or found.work is None:
            return
        if self.engine.fast("table"):
            self._tabled(found)
            return
        self.set_timer(PAUSE, lambda: self._tabulate_behind(found))

    def _tabled(self, found: DerivedBlock) -> None:
        self.engine.table = self.engine.make_table(found, self.desk.session.program)
        self.engine.table_of = found

    def _tabulate_behind(self, found: DerivedBlock) -> None:
        """In a thread, unless the block has changed meanwhile."""
        if self.desk.session.found is found and self.engine.table_of is not found:
            self.run_worker(lambda: self._table_thread(found), thread=True, exclusive=True, group="table")

    def _table_thread(self, found: DerivedBlock) -> None:
        self._tabled(found)
        self.call_from_thread(self.refresh_screen)


def run(path: Path | None, *, example: str | None = None) -> int:
    """Show the screens on a program file, an example or an empty program; returns the exit status."""
    try:
        session = _session(path, example)
    except StoreError as error:
        print(f"cutcomp: {error}", file=sys.stderr)
        return UNUSABLE
    keys.teach()
    driver.be_lenient()
    app = CutcompApp(session)
    app.run(mouse=False)
    return app.return_code or 0


def _session(path: Path | None, example: str | None) -> Session:
    if example is not None:
        return Session.of(load(files.example(example)))
    if path is None:
        return Session.of(files.empty_program())
    if not path.exists() and path.parent.is_dir():
        program = files.empty_program()
        return Session.of(program, path).saying(f"{path} does not exist yet: saving makes it.")
    return Session.of(load(path), path)
