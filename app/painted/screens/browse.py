"""OPEN: the programs and the folders of a folder, or a path typed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from app.documents.naming import program_named, typed
from app.documents.programs import is_program
from app.painted.messages import Browse, Close, Do, Load, Message
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.session import Said, Session
from app.painted.widgets.field import Editing
from app.painted.widgets.header import printable
from app.painted.widgets.rows import Look, Row, Span, plain, shortened


@dataclass(frozen=True, slots=True)
class Item:
    """One line of the list: a folder, a program, or work that was set aside."""

    path: Path
    name: str
    folder: bool
    aside: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class BrowsePage(EntryPage):
    """A folder's items; a typed path wins over the item with the cursor."""

    layout: ClassVar[Layout] = Layout.TEXT
    folder: Path = Path()
    examples: Path = Path()
    items: tuple[Item, ...] = ()
    row: int = 0

    def softkeys(self, session: Session) -> Softkeys:
        """Open; the examples; a new program."""
        return {
            1: Softkey("OPEN", self._opened()),
            2: Softkey("NEW PROGRAM", (Load(None),)),
            3: Softkey("EXAMPLES", (Browse(self.examples),)),
            8: Softkey("CANCEL", (Close(),)),
        }

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Up and down over the list, Enter opens; anything else is the path."""
        steps = {"up": -1, "down": 1, "pageup": -8, "pagedown": 8}
        if key in steps:
            row = min(max(self.row + steps[key], 0), max(len(self.items) - 1, 0))
            return Answer(replace(self, row=row, entry=Editing("", 0), fresh=True))
        return self.accepted(self._opened()) if key == "enter" else self.typed(key, character)

    def softkeyed(self, session: Session, number: int, messages: tuple[Message, ...]) -> Answer:
        """OPEN is Enter."""
        return self.accepted(messages) if number == 1 else Answer(self, messages)

    def _opened(self) -> tuple[Message, ...]:
        text = self.entry.text.strip()
        if text:
            path = self.folder / typed(text)
            return (Browse(path),) if text.endswith("/") else (Load(program_named(path)),)
        if not self.items:
            return ()
        item = self.items[min(self.row, len(self.items) - 1)]
        if item.aside:
            from app.painted.copies import opening

            return (Do(opening(item.path)),)
        return (Browse(item.path),) if item.folder else (Load(item.path),)

    def view(self, session: Session, surface: Surface) -> View:
        """The list and the line for a path."""
        room = max(surface.body - 4, 1)
        top = max(0, min(self.row - room // 2, len(self.items) - room))
        shown = self.items[top : top + room]
        rows = [_item(item, on_it=index == self.row - top and not self.entry.text) for index, item in enumerate(shown)]
        if not rows:
            rows = [plain("   No programs here. Type a path, or F3 for the examples.", Look.LABEL)]
        title = plain(f" {printable(str(self.folder))[-(surface.width - 2) :]}", Look.LABEL)
        return View(
            (plain(" OPEN", Look.HEAD), title),
            ((), *rows, (), entry_row("PATH", self.entry, surface.width, fresh=self.replaced)),
            Said("Up and down choose, Enter opens. Or type a path; one that ends in / shows that folder."),
            1 + self.row - top,
        )


def _item(item: Item, *, on_it: bool) -> Row:
    text = shortened(f"{printable(item.name)}{'/' if item.folder else ''}", 60 if item.aside else 50)
    return (Span(" > " if on_it else "   ", Look.TAG), Span(text, Look.CURSOR if on_it else Look.TYPED))


def _is_program(path: Path) -> bool:
    return path.suffix.lower() == ".toml" and path.is_file() and is_program(path)


def listed(folder: Path) -> tuple[Item, ...]:
    """The folder above, the programs and the folders in a folder, each in order of names, then programs that were never
    saved, and work that was set aside, here or in this person's own folder; OSError if there is no such folder.
    """
    from app.painted import places
    from app.painted.copies import copies

    own = places.own_folder()
    inside = sorted(folder.iterdir(), key=lambda path: path.name.lower())
    folders = [Item(path, path.name, folder=True) for path in inside if not path.name.startswith(".") and path.is_dir()]
    programs = [Item(path, path.name, folder=False) for path in inside if _is_program(path)]
    new = [Item(path, f"never saved: {path.name}", folder=False) for path in places.never_saved(folder, own)]
    aside = [Item(path, name, folder=False, aside=True) for path, name in copies(folder, own, nc=False)]
    return (Item(folder.parent, "..", folder=True), *programs, *folders, *new, *aside)
