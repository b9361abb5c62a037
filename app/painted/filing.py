"""What the program does with files: save, open, post, leave; trouble becomes one sentence on the prompt line."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, assert_never

from app.documents.files import refuse_program, stamp_of_data, write_output, write_text
from app.documents.folders import chosen, outside, printable_path, written_at
from app.documents.naming import as_program, is_folder, with_suffix
from app.documents.patience import FILE, within
from app.documents.programs import empty_program, examples, is_nc
from app.painted.guard import THE_WAY
from app.painted.messages import Browse, Close, Do, Leave, Load, Open, Post, Save, Say, Swap
from app.painted.opened import opened
from app.painted.saving import asked, asking, leads_elsewhere, put_theirs_aside, replacing, there
from app.painted.screens.ask import Ask, Option
from app.painted.screens.browse import BrowsePage, listed
from app.painted.screens.save import SaveAsPage
from app.painted.session import Session, Tone
from app.painted.widgets.words import in_spite, placed
from core.finding import Severity
from core.program.file.read import StoreError
from core.program.file.write import dumps
from core.program.model import Program, unread_texts
from core.units import Unit

if TYPE_CHECKING:
    from app.painted.desk import Desk
    from core.output.nc import Posted


def carry_out(desk: Desk, message: Save | Browse | Load | Post | Leave) -> Desk:
    """One message that touches files."""
    match message:
        case Save():
            return _save(desk, message)
        case Browse(folder):
            return _browse(desk, folder)
        case Load():
            return _load(desk, message)
        case Post():
            return _post(desk, message)
        case Leave():
            return _leave(desk, message)
        case _:
            assert_never(message)


def _save(desk: Desk, message: Save) -> Desk:
    session = desk.session
    path = session.file if message.path is None else _as_program(chosen(message.path, session.file), session.file)
    if path is None:
        return desk.take(Open(SaveAsPage.of(session, leave=message.leave)))
    if (question := asked(desk, path, message)) is not None:
        return question
    try:
        theirs = put_theirs_aside(path) if message.changed else None
        text = dumps(session.program)
        write_text(path, text)
    except StoreError as error:
        # where a name is being typed already, another one is
        way = "" if isinstance(desk.page, SaveAsPage) else f" {THE_WAY}"
        return _failed(desk, f"{error}{way}")
    named = session.named(path, stamp_of_data(text.encode()), linked=message.linked and leads_elsewhere(path))
    desk = _without(replace(desk, session=named), SaveAsPage)
    other = "" if theirs is None else f" The other version is in {printable_path(theirs.name)}."
    return (
        replace(desk, exit=True)
        if message.leave
        else desk.take(Say(f"Saved: {written_at(path)}{other}{_marked(session.program)}"))
    )


def _marked(program: Program) -> str:
    """That what cannot be used is in the file too."""
    return ", what is marked ERR as it was typed." if any(unread_texts(program)) else ""


def _as_program(path: Path, own: Path | None) -> Path:
    """The name of a program; the one it has already stays whatever it is."""
    return path if path == own else as_program(path)


def _browse(desk: Desk, folder: Path | None) -> Desk:
    here = folder or (desk.session.file.parent if desk.session.file else Path())
    try:
        here = here.expanduser().resolve()
        page = BrowsePage(folder=here, examples=examples(), items=listed(here))
    except OSError as error:
        return _failed(desk, f"{here} cannot be shown: {error.strerror or error}.")
    return desk.take(Swap(page) if isinstance(desk.page, BrowsePage) else Open(page))


def _load(desk: Desk, message: Load) -> Desk:
    session = desk.session
    if message.path is not None and is_nc(message.path):
        from app.painted.screens.proof_files import opening

        return desk.take(Do(opening(message.path)))
    if session.unsaved and not message.unsaved:
        open_it = message._replace(unsaved=True)
        keep = (Close(), Save()) if session.file is not None else (Close(), Open(SaveAsPage.of(session)))
        options = (("s", "SAVE FIRST", keep), ("d", "OPEN WITHOUT SAVING", (Close(), open_it)))
        return desk.take(Open(Ask("NOT SAVED", ("The program has changes that are not saved.",), options)))
    if any(page.unsaved for page in desk.pages):
        return _failed(desk, "The NC file under proof has changes that are not saved: Ctrl+S on its screen saves them.")
    if message.path is None:
        empty = _wanting(Session.of(empty_program(desk.settings.unit)), message.earlier)
        return fresh(desk, empty).take(Say("A new program."))
    try:
        session = _wanting(_opened(message.path, message.earlier), message.earlier)
    except StoreError as error:
        return _failed(desk, error)
    if message.path.parent == examples():
        # an example is nobody's to overwrite: it has no file until it is saved under a name
        own = replace(Session.of(session.program), title=message.path.stem)
        return fresh(desk, own).take(Say(f"Example {message.path.stem}: SAVE gives it a name."))
    return fresh(desk, session).take(Say(f"Opened: {message.path}"))


def _wanting(session: Session, earlier: Path | None) -> Session:
    """The session that is asked about work in a journal that was set aside."""
    return replace(session, guard=replace(session.guard, earlier=earlier))


def _opened(path: Path, earlier: Path | None) -> Session:
    """A program, or the work on it that was left behind where its file cannot be read; StoreError for neither.

    Work in the journal `earlier`, which was set aside and is wanted back, is such work too.
    """
    try:
        return within(FILE, lambda: opened(path))
    except TimeoutError as error:
        raise StoreError(f"{path} cannot be opened: {error}.") from error
    except StoreError as error:
        from app.painted.rescue import rescued

        return rescued(path, error, earlier)


def fresh(desk: Desk, session: Session) -> Desk:
    """The desk with another program, its list of blocks below the form."""
    return replace(desk, session=session, pages=type(desk)(session).pages)


def _post(desk: Desk, message: Post) -> Desk:
    from app.cli.posting import posted_anew
    from core.output.nc import Refusal

    path, unit = with_suffix(chosen(message.path, desk.session.file), ".nc"), desk.session.program.unit
    try:
        refuse_program(path)
    except StoreError as error:
        return _failed(desk, error)
    if is_folder(path):
        return _failed(desk, f"{printable_path(path)} is not written: this is a folder. Type a file's name.")
    question = _before_posting(desk.session.file, path, message)
    if question is not None and message.clear:
        return desk.take(Open(question))
    result = posted_anew(desk.session, path.stem, message.override, message.control)
    if isinstance(result, Refusal):
        return _failed(desk, f"Nothing was written: {placed(result.findings[0], unit)}")
    # only now: nobody is asked where to write, or over what, if nothing will be written
    if question is not None:
        return desk.take(Open(question))
    try:
        write_output(path, result.text)
    except StoreError as error:
        return _failed(desk, error)
    return desk.take(Close()).take(_said_of(result, written_at(path), unit))


def _before_posting(file: Path | None, path: Path, message: Post) -> Ask | None:
    """What must be answered before the NC file is written there."""
    if outside(path, file) and not message.linked:
        return asking(path, file, message._replace(path=path, linked=True, overwrite=True))
    return replacing(path, message._replace(path=path)) if there(path) and not message.overwrite else None


def _said_of(result: Posted, name: str, unit: Unit) -> Say:
    """What was posted, in spite of what, and what is to be said with it."""
    told = " ".join(placed(note, unit) for note in result.notes)
    file = f"{name}, {result.text.count(chr(10))} lines."
    if result.overridden:
        return Say(f"Posted {in_spite(result.overridden)}: {file} The file says so. {told}".rstrip(), Tone.WARNING)
    grave = any(note.severity is not Severity.INFO for note in result.notes)
    return Say(f"Posted: {file} {told}".rstrip(), Tone.WARNING if grave else Tone.PLAIN)


def _leave(desk: Desk, message: Leave) -> Desk:
    listing = any(page.unsaved for page in desk.pages)
    if message.unsaved or not (desk.session.unsaved or listing):
        return replace(desk, exit=True)
    if listing:
        too = " So has the program." if desk.session.unsaved else ""
        saves = _listing_saved(desk)
        how = "" if saves else " Ctrl+S on its screen saves them."
        lines = (f"The NC file under proof has changes that are not saved.{too}{how}",)
        without = ("l", "LEAVE UNSAVED", (Leave(unsaved=True),))
        return desk.take(Open(Ask("LEAVE?", lines, (*saves, without), _name_of_listing(desk))))
    options = (("s", "SAVE AND LEAVE", (Close(), Save(leave=True))), ("l", "LEAVE UNSAVED", (Leave(unsaved=True),)))
    lost = "The program has changes that are not saved."
    if desk.session.file is None:
        lost = "It was never saved: leaving unsaved gives it all up."
    return desk.take(Open(Ask("LEAVE?", (lost,), options)))


def _listing_saved(desk: Desk) -> tuple[Option, ...]:
    """The answer that saves the NC file on top; none where it is another one, below, that is not saved."""
    from app.painted.screens.proof_files import saving_and_leaving
    from app.painted.screens.proof_tool import proof_page

    return (("s", "SAVE AND LEAVE", (Close(), saving_and_leaving())),) if proof_page(desk).unsaved else ()


def _name_of_listing(desk: Desk) -> str:
    """The NC file that is not saved, by its name."""
    from app.painted.nc_keeping import proofs

    return next((page.file.name for page in proofs(desk) if page.unsaved and page.file is not None), "")


def _without(desk: Desk, kind: type[SaveAsPage]) -> Desk:
    """The desk without the dialog that has done its work."""
    return replace(desk, pages=desk.pages[:-1]) if isinstance(desk.page, kind) else desk


def _failed(desk: Desk, error: StoreError | str) -> Desk:
    return desk.take(Say(str(error), Tone.ERROR))
