"""What NC PROOF does with files: open, save under its own name or another, choose one from a folder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from os.path import realpath
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from app.documents.files import refuse_program, why, write_data
from app.documents.folders import chosen, outside, written_at
from app.documents.naming import is_folder, typed
from app.documents.nc_text import MAX_NC_BYTES, NC_SUFFIXES, NcText
from app.painted.messages import Close, Do, Leave, Message, Open, Say
from app.painted.saving import asking
from app.painted.screens.ask import Ask
from app.painted.screens.browse import BrowsePage, Item
from app.painted.screens.entry import EntryPage, entry_row
from app.painted.screens.page import Answer, Layout, Softkey, Softkeys, Surface, View
from app.painted.screens.proof_tool import proof_page, put
from app.painted.session import Said, Session, Tone
from app.painted.widgets.field import Editing
from app.painted.widgets.rows import Look, plain
from core.program.file.read import StoreError
from core.units import printable

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from app.painted.screens.proof import ProofPage


def read(path: Path) -> NcText:
    """The text of a file; StoreError says why there is none."""
    try:
        if path.is_file() and path.stat().st_size > MAX_NC_BYTES:
            raise StoreError(f"{printable(str(path))} is too large: more than {MAX_NC_BYTES // 1_000_000} megabytes.")
        return NcText.read(path.read_bytes())
    except (OSError, ValueError) as error:
        raise StoreError(f"{printable(str(path))} is not opened: {why(error)}") from error


def opening(path: Path, earlier: Path | None = None) -> Callable[[Desk], Desk]:
    """A file put under proof, on top of everything; `earlier` is a journal set aside, whose changes are offered.

    That one holds all of the text: a file that is gone is then an empty one.
    """

    def work(desk: Desk) -> Desk:
        from app.painted.screens.proof import ProofPage

        try:
            gone = earlier is not None and not path.exists()
            page = replace(ProofPage.of(NcText() if gone else read(path), path), earlier=earlier)
        except StoreError as error:
            return desk.take(Say(str(error), Tone.ERROR))
        pages = desk.pages[:-1] if isinstance(desk.page, BrowsePage) else desk.pages
        if (open_already := _standing(desk, path)) is not None:
            where = "here it is" if open_already is pages[-1] else "it lies below this screen, F8 goes back"
            return replace(desk, pages=pages).take(Say(f"{printable(path.name)} is open already: {where}."))
        return replace(desk, pages=(*pages, page)).take(Say(f"Tried on {page.control}: c takes the next control."))

    return work


def _standing(desk: Desk, path: Path) -> ProofPage | None:
    """The page on the desk that has this file: two of them would write into one journal."""
    from app.painted.screens.proof import ProofPage

    here = (page for page in desk.pages if isinstance(page, ProofPage) and page.file is not None)
    return next((page for page in here if realpath(page.file or path) == realpath(path)), None)


def saving(path: Path | None = None, *, agreed: bool = False) -> Do:
    """The listing written, under its own name or another; `agreed`: what stands there may be replaced."""
    return Do(lambda desk: _saved(desk, path, agreed=agreed))


def saving_and_leaving() -> Do:
    """The listing written, and the program left; what else is not saved, or is in the way, is asked about."""

    def work(desk: Desk) -> Desk:
        written = _saved(desk, None, agreed=False)
        asked = len(written.pages) > len(desk.pages) or proof_page(written).unsaved
        return written if asked else written.take(Leave())

    return Do(work)


def _saved(desk: Desk, path: Path | None, *, agreed: bool) -> Desk:
    page = proof_page(desk)
    target = page.file if path is None else chosen(path, page.file)
    if target is None:
        return desk.take(Open(SaveListing.of(page)))
    if said := _refused(desk, page, target):
        return desk.take(Say(said, Tone.ERROR))
    if not agreed and target != page.file and outside(target, page.file):
        return desk.take(Open(asking(target, page.file, saving(target, agreed=True), target.name)))
    if not agreed and (question := _question(page, target)) is not None:
        replaced = (("r", "REPLACE", (Close(), saving(path, agreed=True))),)
        return desk.take(Open(Ask(question[0], (question[1],), replaced, target.name)))
    data = page.listing.data
    try:
        write_data(target, data)
    except StoreError as error:
        return desk.take(Say(str(error), Tone.ERROR))
    desk = replace(desk, pages=desk.pages[:-1]) if isinstance(desk.page, SaveListing) else desk
    written = replace(page, asked=page.asked.of(page.listing.written(data)), file=target, looking="")
    told = None if page.told is None or not page.fresh else replace(page.told, question=written.asked)
    return put(desk, replace(written, told=told)).take(Say(f"Saved: {written_at(target)}"))


def _refused(desk: Desk, page: ProofPage, target: Path) -> str:
    """Why a file is not written, whatever the operator answers; empty where it may be."""
    if page.looking and target == page.file:
        return f"{page.looking} S saves a copy under another name."
    if _standing(desk, target) not in (None, page):
        return f"{printable(target.name)} is open below this screen. Type another name."
    try:
        refuse_program(target)
    except StoreError as error:
        return str(error)
    return ""


def _question(page: ProofPage, target: Path) -> tuple[str, str] | None:
    """What is to be asked before a file is written, if anything."""
    name = printable(str(target))
    if target != page.file:
        return ("REPLACE THE FILE?", f"{name} exists already. Its content is replaced.") if target.exists() else None
    try:
        same = target.read_bytes() == page.listing.origin
    except OSError:
        return None
    return None if same else ("THE FILE HAS CHANGED", f"{name} was written by somebody else since it was opened.")


@dataclass(frozen=True, eq=False, slots=True)
class SaveListing(EntryPage):
    """SAVE AS: the name of the NC file."""

    layout: ClassVar[Layout] = Layout.TEXT

    @classmethod
    def of(cls, page: ProofPage) -> SaveListing:
        """The page with the name the file has."""
        return cls(Editing.of("part.nc" if page.file is None else str(page.file)))

    def softkeys(self, session: Session) -> Softkeys:
        """Save, or not."""
        return {1: Softkey("SAVE", self._named()), 8: Softkey("CANCEL", (Close(),))}

    def press(self, key: str, character: str | None, session: Session) -> Answer | None:
        """Enter saves."""
        return Answer(self, self._named()) if key == "enter" else self.typed(key, character)

    def _named(self) -> tuple[Message, ...]:
        text = self.entry.text.strip()
        return (saving(typed(text)),) if text else (Say("Type a name for the file.", Tone.ERROR),)

    def view(self, session: Session, surface: Surface) -> View:
        """The name."""
        body = ((), entry_row("FILE", self.entry, surface.width, fresh=self.fresh))
        said = Said("Type the name of the NC file, Enter saves. Left arrow changes the name that stands there.")
        return View((plain(" SAVE NC FILE AS", Look.HEAD), ()), body, said, 1)


@dataclass(frozen=True, eq=False, slots=True)
class ProofBrowse(BrowsePage):
    """The NC programs of a folder."""

    def softkeys(self, session: Session) -> Softkeys:
        """Open, or not."""
        return {1: Softkey("OPEN", self._opened()), 8: Softkey("CANCEL", (Close(),))}

    def _opened(self) -> tuple[Message, ...]:
        text = self.entry.text.strip()
        if not text and not self.items:
            return ()
        item = self.items[min(self.row, len(self.items) - 1)] if self.items else None
        if item is not None and item.aside and not text:
            from app.painted.copies import file_of

            return (Do(opening(file_of(item.path, self.folder), item.path)),)
        path = self.folder / typed(text) if text or item is None else item.path
        folder = is_folder(path) if text or item is None else item.folder
        return (Do(browsing(path)),) if folder else (Do(opening(path)),)


def browsing(folder: Path | None = None) -> Callable[[Desk], Desk]:
    """The NC programs of a folder to choose from, of the program's where none is named."""

    def work(desk: Desk) -> Desk:
        here = folder or (desk.session.file.parent if desk.session.file else Path())
        try:
            here = here.expanduser().resolve()
            page = ProofBrowse(folder=here, items=listed(here))
        except OSError as error:
            return desk.take(Say(f"{here} cannot be shown: {why(error)}", Tone.ERROR))
        pages = desk.pages[:-1] if isinstance(desk.page, ProofBrowse) else desk.pages
        return replace(desk, pages=(*pages, page))

    return work


def listed(folder: Path) -> tuple[Item, ...]:
    """The folder above, the NC programs and the folders in a folder, then work set aside; OSError if it has none."""
    from app.painted.copies import copies
    from app.painted.places import own_folder

    inside = sorted(folder.iterdir(), key=lambda path: path.name.lower())
    folders = [Item(path, path.name, folder=True) for path in inside if not path.name.startswith(".") and path.is_dir()]
    files = [path for path in inside if path.suffix.lower() in NC_SUFFIXES and path.is_file()]
    aside = [Item(path, name, folder=False, aside=True) for path, name in copies(folder, own_folder(), nc=True)]
    programs = [Item(path, path.name, folder=False) for path in files]
    return (Item(folder.parent, "..", folder=True), *programs, *folders, *aside)
