"""SETUP SHEET shows and writes the sheet that goes to the machine with the program."""

from __future__ import annotations

from asyncio import to_thread
from pathlib import Path
from typing import ClassVar

from textual import work
from textual.app import ComposeResult
from textual.containers import VerticalScroll
from textual.content import Content
from textual.widgets import Input, Static

from app.screens.entry_screen import EntryScreen, entry_keys
from app.session.posting import setup_sheet
from app.session.session import Session
from app.widgets.plain import PlainText
from app.widgets.softkeys import Softkey
from core.program.model import Program


class SheetScreen(EntryScreen):
    """The name of the sheet's file, and the sheet as text."""

    TITLE: ClassVar[str] = "SETUP SHEET"
    PROMPT: ClassVar[str] = "Name of the sheet, Enter writes it: .html with drawing, .txt text. Page Down: read on."
    SOFTKEYS: ClassVar[tuple[Softkey | None, ...]] = entry_keys(
        "WRITE",
        Softkey("PAGE WITH DRAWING", "ending('.html')", "PAGE"),
        Softkey("AS TEXT", "ending('.txt')", "TEXT"),
    )

    def compose_rest(self) -> ComposeResult:
        """Yield the sheet, which scrolls."""
        with VerticalScroll(id="sheet", can_focus=False):
            yield PlainText(id="sheet-text")

    def show_session(self, session: Session) -> None:
        """Make the sheet of the current program."""
        self._make(session.program)

    @work(exclusive=True, group="sheet", description="sheet")
    async def _make(self, program: Program) -> None:
        path = Path(Path(self._text).name or "part").with_suffix(".txt")
        text = await to_thread(setup_sheet, program, path, self.host.now())
        if self.is_live:
            self.query_one("#sheet-text", Static).update(Content(text))

    def action_ending(self, ending: str) -> None:
        """Change the suffix of the file name."""
        if Path(self.text).name:
            self._text = str(Path(self.text).with_suffix(ending))
            self.query_one("#entry", Input).value = self._text

    @work(exclusive=True, group="question")
    async def entered(self, text: str) -> None:
        """Write the sheet; ask before replacing a file."""
        program, now = self.current_session.program, self.host.now()
        written = await self.host.write_made(text, ".html", lambda path: setup_sheet(program, path, now))
        if written is None:
            return
        self.notify(f"Setup sheet: {written[0]}", timeout=4)
        self.app.call_later(self.app.run_action, "app.back")
