"""SETUP SHEET: its lines on the screen, and the file it is written to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Final, Self

from app.documents.files import refuse_program, write_output
from app.documents.naming import typed, with_suffix
from app.painted.messages import Close, Do, Message, Open, Say
from app.painted.screens.ask import Ask
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.header import header, printable
from app.painted.widgets.rows import Look, plain
from core.program.file.read import StoreError

if TYPE_CHECKING:
    from app.painted.desk import Desk

PAGES: Final = (".html", ".htm")


@dataclass(frozen=True, eq=False, slots=True)
class SheetPage(EntryPage):
    """The name of the sheet's file: .html is a page with the drawing, anything else is text."""

    layout: ClassVar[Layout] = Layout.TEXT

    @classmethod
    def of(cls, session: Session) -> Self:
        """The page with the program's name and the suffix .html."""
        name = Path("part.html") if session.file is None else session.file.with_suffix(".html")
        return cls(Editing.of(str(name)))

    def softkeys(self, session: Session) -> Softkeys:
        """A page, a text, or neither."""
        return {
            1: Softkey("WRITE", self._written(self.entry.text)),
            2: Softkey("AS PAGE WITH DRAWING", (Do(_renamed(".html")),)),
            3: Softkey("AS TEXT", (Do(_renamed(".txt")),)),
            8: Softkey("CANCEL", (Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter writes; down steps between page and text."""
        if key in ("up", "down"):
            suffix = ".txt" if Path(self.entry.text.strip()).suffix in PAGES else ".html"
            return Answer(self, (Do(_renamed(suffix)),))
        return Answer(self, self._written(self.entry.text)) if key == "enter" else self.typed(key, character)

    def _written(self, text: str) -> tuple[Message, ...]:
        if not text.strip():
            return (Say("Type a name for the sheet.", Tone.ERROR),)
        return (Do(writing(with_suffix(typed(text), ".html"))),)

    def view(self, session: Session, surface: Surface) -> View:
        """The name and what the sheet holds."""
        told = (
            "Part, tools, start point, clamping room, depths, passes,",
            "look-ahead, feeds, speed and findings of every block.",
            ".html is a page with the drawing, .txt is text.",
        )
        rows = (
            entry_row("FILE", self.entry, surface.width, fresh=self.fresh),
            (),
            *(plain(f" {line}", Look.LABEL) for line in told),
        )
        said = Said("Type the name of the sheet, Enter writes it. Up and down change between page and text.")
        return View(header("SETUP SHEET", plain(""), session, surface.width), ((), *rows), said, 1)

    def help(self, session: Session) -> tuple[str, ...]:
        """What the sheet is for."""
        return (
            "SETUP SHEET",
            "The sheet that goes to the machine with the program. It says DO NOT RUN while anything "
            "stands against posting.",
        )


def _renamed(suffix: str) -> Callable[[Desk], Desk]:
    """What gives the name another ending."""

    def work(desk: Desk) -> Desk:
        page = desk.page
        if not isinstance(page, SheetPage) or not page.entry.text.strip():
            return desk
        name = Path(page.entry.text.strip())
        entry = Editing.of(str(name.with_suffix(suffix) if name.name else name))
        return replace(desk, pages=(*desk.pages[:-1], replace(page, entry=entry, fresh=True)))

    return work


def writing(name: Path, *, agreed: bool = False) -> Callable[[Desk], Desk]:
    """What writes the sheet, asking first where a file is in its place, or where that is in another folder."""

    def work(desk: Desk) -> Desk:
        from datetime import datetime

        from app.documents.folders import chosen, outside, written_at
        from app.painted.saving import asking
        from app.session.posting import setup_sheet

        file = desk.session.file
        path = with_suffix(chosen(name, file), ".html")
        again = Do(writing(path, agreed=True))
        try:
            refuse_program(path)
        except StoreError as error:
            return desk.take(Say(str(error), Tone.ERROR))
        if outside(path, file) and not agreed:
            return desk.take(Open(asking(path, file, again)))
        if path.exists() and not agreed:
            lines = (f"{printable(str(path))} exists already. Its content is replaced.",)
            return desk.take(Open(Ask("REPLACE THE FILE?", lines, (("r", "REPLACE", (Close(), again)),))))
        try:
            write_output(path, setup_sheet(desk.session.program, path, datetime.now().astimezone()))
        except StoreError as error:
            return desk.take(Say(str(error), Tone.ERROR))
        return desk.take(Close()).take(Say(f"Setup sheet: {written_at(path)}"))

    return work
