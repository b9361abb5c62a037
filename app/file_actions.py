"""What the App does with files: open, new, save, save as, leave, and every edit put on the disk at once.

The document service decides and knows no screen; what it asks is asked here in a dialog.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from concurrent.futures import Future, wait
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

from textual import work

from app.derivation_actions import DerivationActions
from app.documents.document import AnyDocument, ContourDocument, Document, NcDocument
from app.documents.files import refuse_program, why, write_data, write_output
from app.documents.folders import chosen, short_path, written_at
from app.documents.left_overs import file_of_copy
from app.documents.naming import is_drawing, is_folder, program_named, typed, with_suffix
from app.documents.nc_text import NC_SUFFIXES
from app.documents.patience import DISK, FILE, Disk, within
from app.documents.questions import (
    DISCARD,
    GO_BACK,
    LEAVE,
    NEW_PROGRAM,
    SAVE,
    Ask,
    before_output,
    held_sentence,
    into_which,
    leaving,
    name_of,
    not_answering,
)
from app.documents.service import DocumentService, Notice, Offer, Opened, Saved, Trouble
from app.documents.settings import Settings, SettingsFile
from app.screens.base import BaseScreen
from app.screens.dialogs import Phrase, Question
from app.session.derivation import Request
from app.session.messages import Tone
from app.session.session import SEGMENT, Session
from core.program.edit import Edited, FormPlace, Refused
from core.program.file.read import StoreError
from core.units import Unit

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from core.pipeline.checking import Asked

Result = TypeVar("Result")

NO_ANSWER: Final = "The folder does not answer: still trying. You can go on; it is not on the disk yet."
ANSWERS: Final = "The folder answers again: all work is on the disk."


class FileActions(DerivationActions):
    """The App's side of files: all work on them is done by `disk`, one piece after the other.

    The keys wait half a second for it; then they go on, and what is edited meanwhile is kept when the folder answers.
    """

    service: DocumentService
    document: ContourDocument
    settings: Settings
    settings_file: SettingsFile

    def __init__(self, *, ansi_color: bool | None = None) -> None:
        super().__init__(ansi_color=ansi_color)
        self.disk = Disk()
        self._behind = set[Future[Any]]()
        self._edited_meanwhile = False

    def show_drawing(self, path: Path, *, fresh: bool = False) -> None:
        """IMPORT on a drawing: its contours go to the open program, which takes the drawing's unit if it is `fresh`."""
        # shapely and numpy are not needed by the first paint
        from app.screens.import_drawing import ImportScreen

        self.push_screen(ImportScreen(path, fresh=fresh))

    # ---- the disk, which may not answer

    def _ask_disk(self, work: Callable[[], Result]) -> Future[Result]:
        """Have work done on the disk; waits for it a moment, unless the disk is behind already."""
        future = self.disk.do(work)
        if not self._behind:
            wait([future], DISK)
        self._behind.add(future)
        if not future.done():
            self.say(NO_ANSWER, Tone.WARNING)
        return future

    async def _answer(self, future: Future[Result]) -> Result:
        try:
            return future.result() if future.done() else await asyncio.wrap_future(future)
        finally:
            self._behind.discard(future)
            if self._edited_meanwhile:
                # behind what the caller makes of the answer
                self.call_later(self._keep_rest)

    async def on_disk(self, work: Callable[[], Result]) -> Result:
        """What work on the disk returns; only in a worker."""
        return await self._answer(self._ask_disk(work))

    def disk_is_behind(self) -> bool:
        """Whether the disk has still to answer; then it says so."""
        if self._behind:
            self.say(NO_ANSWER, Tone.WARNING)
        return bool(self._behind)

    # ---- every edit on the disk

    def keep(self, session: Session) -> None:
        """Put what was edited on the disk, before the next key is read."""
        self.document = self.document.edited(session.history, session.place, session.cursor.field or SEGMENT)
        self.keep_document(self.document)

    def keep_document(self, document: Document) -> None:
        """Put what was edited in a document on the disk."""
        if self.disk_is_behind():
            self._edited_meanwhile = True
            return
        future = self._ask_disk(lambda: self.service.keep(document))
        if future.done():
            self._behind.discard(future)
            self.tell(future.result())
        else:
            self._kept_late(future)

    @work(group="disk")
    async def _kept_late(self, future: Future[Notice | None]) -> None:
        self.tell(await self._answer(future) or Notice(ANSWERS))

    def _keep_rest(self) -> None:
        """Keep what was edited while the disk was behind."""
        if self._behind or not self._edited_meanwhile:
            return
        self._edited_meanwhile = False
        for document in self._all_open():
            self.keep_document(document)

    def apply(self, edited: Edited, label: str) -> bool:
        """Take an edit, or say why it is refused; whether it was taken."""
        if isinstance(edited, Refused):
            self.say(edited.text, Tone.ERROR)
            return False
        if self.looking:
            self.try_out(None)
            self.say(self.looking, Tone.ERROR)
            return False
        self._change(self.session.with_program(edited, label))
        return True

    def move(self, place: FormPlace, field: str | None = SEGMENT) -> None:
        """Put the cursor of the MILL CONTOUR form on a segment, and there on a field.

        A new segment in which nothing was typed is gone once the cursor has left it.
        """
        session, here = self.session, self.session.place
        if place != here and (rest := session.without_empty()) is not session:
            session = rest
            if place.block == here.block and place.segment > here.segment:
                place = FormPlace(place.block, place.segment - 1)
        self._change(session.at(place, field))

    def action_undo(self) -> None:
        """Take one edit back; what is half-typed is forgotten."""
        label = self.session.history.undo_label
        self._turn("undo", label, self.session.undone, f"Undone: {label}. Ctrl+Y brings it back.")

    def action_redo(self) -> None:
        """Make one undone edit again; what is half-typed is forgotten."""
        label = self.session.history.redo_label
        self._turn("redo", label, self.session.redone, f"Done again: {label}.")

    def _turn(self, action: str, label: str | None, turned: Callable[[], Session], done: str) -> None:
        """Undo or redo, on a screen with a document of its own that document's."""
        if isinstance(self.screen, BaseScreen):
            if self.screen.take_over(action):
                return
            self.screen.forget_typed()
        if label is None:
            self.say(f"There is nothing to {action}.")
            return
        self._change(turned())
        self.say(done)

    def _change(self, session: Session) -> None:
        """The journal first, then the session, then what follows from it."""
        before = self.session
        if session is before:
            # such as a number typed over with the same one
            self.try_out(None)
            return
        self.keep(session)
        self.session = session
        self.shown = session
        self._advise_later()
        if session.program is not before.program:
            self._derive(Request(session.program))

    def drop_empty_segment(self) -> None:
        """Take a new segment with the cursor away in which nothing was typed."""
        self._change(self.session.without_empty())

    def tell(self, notice: Notice | None) -> None:
        """What the service has to say."""
        if notice is not None:
            self.say(notice.text, Tone.WARNING if notice.warning else Tone.PLAIN)

    @property
    def looking(self) -> str:
        """Why nothing may be changed: somebody else has the file open; empty where it may."""
        holder = self.document.file.holder
        if holder is None:
            return ""
        return f"{held_sentence(holder, self.service.clock())} SAVE AS (Ctrl+K) makes a copy of your own."

    def keep_settings(self, settings: Settings) -> None:
        """Settings as they are from now on."""
        self.settings = settings
        if text := self.settings_file.keep(settings):
            self.say(text, Tone.WARNING)

    # ---- open

    def adopt(self, opened: Opened[Any]) -> None:
        """Work on a document that was opened, and ask what is to be asked about it."""
        document = opened.document
        if isinstance(document, NcDocument):
            proof = self.proof
            if proof is not None and proof.document.file.opening is document.file.opening:
                proof.show_document(document)
            else:
                self.show_nc(document)
        else:
            self.document = document
            self.begin(session_of(document))
            self._uncover(0)
            if document.file.path is not None:
                self.keep_settings(self.settings.using(document.file.path))
        self.tell_and_ask(opened)

    def tell_and_ask(self, opened: Opened[Any]) -> None:
        """Say what there is to say of a document that was opened, and ask about work that was left."""
        self.tell(opened.notice)
        if opened.offer is not None:
            self._ask_offer(opened.document, opened.offer)

    @work(group="offer", description="offer")
    async def _ask_offer(self, document: AnyDocument, offer: Offer) -> None:
        """Ask, and work on what comes of the answer; where nothing does, the screen stays, HOME too."""
        word = await self.ask(offer.ask)
        opened = await self.on_disk(lambda: self.service.answer(document, offer, word))
        if opened.document is not document:
            self.adopt(opened)
        else:
            self.tell_and_ask(opened)

    async def ask(self, ask: Ask) -> str:
        """The word of the answer to a question; only in a worker."""
        return await self.push_screen_wait(Question(ask.title, ask.lines, ask.answers, ask.safe, ask.details))

    @work(group="question")
    async def open_file(self, path: Path, *, kept_copy: bool = False) -> None:
        """Work on a file, or show a folder; of a kept copy the work is offered on the file that it is about.

        What is not saved is asked about first.
        """
        if self.disk_is_behind():
            return
        service, here = self.service, self.document.file.path

        def opened() -> Opened[Any] | Trouble | Path:
            if not kept_copy:
                where = _named(chosen(path, here))
                return where if is_folder(where) or is_drawing(where) else service.open(where)
            file = file_of_copy(path, path.parent)
            return service.copy_without_name(path) if file is None else service.open(file, kept_copy=path)

        result = await self.on_disk(opened)
        if isinstance(result, Trouble) and result.open_already is not None:
            await self._open_already(result, opened, again=kept_copy)
        elif isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
        elif isinstance(result, Path) and is_drawing(result):
            await self._open_drawing(result)
        elif isinstance(result, Path):
            self.show_folder(result)
        else:
            await self._begun(result)

    async def _open_drawing(self, path: Path) -> None:
        """IMPORT on a drawing, into a new program, or into the open one, which is asked unless that is new itself."""
        program, fresh = self.document.program, self.document.is_new
        if not fresh:
            word = await self.ask(into_which(path, self.document))
            if word == GO_BACK:
                return
            if word == NEW_PROGRAM:
                if not await self._new("NEW PROGRAM?", program.unit):
                    return
                fresh = True
        self.show_drawing(path, fresh=fresh)

    async def _begun(self, opened: Opened[Any]) -> None:
        """Work on what was opened; of programs there is only one."""
        document = opened.document
        if isinstance(document, ContourDocument):
            if not await self.may_close("OPEN?", self._all_open()):
                await self.on_disk(lambda: self.service.close(document))
                return
            await self.close_documents(self._all_open())
        self.adopt(opened)

    async def _open_already(
        self, trouble: Trouble, opened: Callable[[], Opened[Any] | Trouble | Path], *, again: bool
    ) -> None:
        """Show what is open; read it again where its file is another by now, or where a copy of it is wanted."""
        document = trouble.open_already
        assert document is not None
        again = again or await self.on_disk(lambda: self.service.changed(document))
        if not again or document.kind is not self.document.kind:
            proof = next((proof for proof in self.proofs if proof.document.file.opening is document.file.opening), None)
            if proof is None:
                self._uncover(0)
            else:
                self._uncover(self.screen_stack.index(proof))
            self.say(trouble.text)
        elif await self.may_close("OPEN AGAIN?", self._all_open()):
            await self.close_documents(self._all_open())
            result = await self.on_disk(opened)
            self.adopt(result if isinstance(result, Opened) else self.service.new())
            if isinstance(result, Trouble):
                self.say(result.text, Tone.ERROR)

    @work(group="question")
    async def action_new(self, unit: str) -> None:
        """A new program in this unit."""
        if await self._new("NEW PROGRAM?", Unit(unit)):
            self.keep_settings(replace(self.settings, unit=Unit(unit)))

    @work(group="question")
    async def action_guide(self) -> None:
        """A first part, step by step."""
        if await self._new("GUIDED FIRST PART?", Unit.IN):
            self.guided = True

    async def _new(self, title: str, unit: Unit) -> bool:
        """Work on a new program where everything that is open may be closed; whether it may."""
        if self.disk_is_behind() or not await self.may_close(title, self._all_open()):
            return False
        await self.close_documents(self._all_open())
        self.adopt(self.service.new(unit))
        return True

    def _all_open(self) -> list[Document]:
        return [self.document, *(proof.document for proof in self.proofs)]

    async def may_close(self, title: str, documents: Iterable[Document]) -> bool:
        """Whether documents may be closed: they are saved, they have just been saved, or their changes are given up."""
        openings = {document.file.opening for document in documents}
        proofs = [proof for proof in self.proofs if proof.document.file.opening in openings]
        if not all(proof.take_lines() for proof in proofs):
            return False
        ours = [self.document] if self.document.file.opening in openings else []
        ask = leaving(title, [*ours, *(proof.document for proof in proofs)])
        word = DISCARD if ask is None else await self.ask(ask)
        if word != SAVE:
            return word == DISCARD
        for proof in proofs:
            if proof.document.unsaved and not await self.saved_nc(proof, None):
                return False
        return not ours or not self.document.unsaved or await self.saved(None)

    async def close_documents(self, documents: Iterable[Document]) -> None:
        """Neither journal nor lock of these stays."""
        closing = tuple(documents)

        def close() -> None:
            for document in closing:
                self.service.close(document)

        await self.on_disk(close)

    def show_nc(self, document: NcDocument, asked: Asked | None = None) -> None:
        """NC PROOF on a text, with the control, the tools and the unit that were asked for at the start."""
        from app.nc_proof.screen import ProofScreen

        path, settings = document.file.path, self.settings
        remembered = "" if path is None else settings.tools_of(path)
        self.push_screen(ProofScreen(document, self.keep_document, asked, settings.control, remembered))

    def show_folder(self, folder: Path, at: Path | None = None) -> None:
        """HOME with the files of a folder, the cursor on one of them."""
        from app.screens.home import HomeScreen

        self.push_screen(HomeScreen(folder, at))

    # ---- save

    def action_save(self) -> None:
        """Save under the name the program, or the NC text in front, has, or ask for one."""
        if self.disk_is_behind() or not self.take_typed():
            return
        if self.proof is not None:
            self._save_nc(self.proof, None)
        elif self.document.file.path is None:
            self.action_save_as()
        else:
            self._save(None)

    def action_save_as(self) -> None:
        """Ask for a name."""
        from app.screens.save_and_open import SaveAsScreen

        path = self.document.file.path if self.proof is None else self.proof.document.file.path
        name = str(path) if path is not None else f"{self.document.title or 'part'}.toml"
        self.push_screen(SaveAsScreen(name))

    def action_open_path(self) -> None:
        """Ask for the path of a file to open."""
        from app.screens.save_and_open import OpenPathScreen

        folder = self.settings.folder
        self.push_screen(OpenPathScreen(f"{folder}/" if folder else ""))

    def save_as(self, text: str) -> None:
        """Save under a typed name; while a folder does not answer, only a copy on another disk."""
        proof = self.proofs[-1] if self.proofs and self.screen_stack[-2:-1] == self.proofs[-1:] else None
        if self.disk_is_behind():
            if proof is not None and not proof.take_lines():
                return
            self._save_copy(self.document if proof is None else proof.document, typed(text))
        elif proof is not None:
            old = proof.document.file.path
            self._save_nc(proof, with_suffix(typed(text), ".nc" if old is None else old.suffix))
        else:
            self._save(typed(text))

    @work(group="question")
    async def _save_copy(self, document: AnyDocument, path: Path) -> None:
        """Write a copy of what the disk does not take yet; it asks nothing, so it replaces no file."""

        def write() -> str:
            named = chosen(path, document.file.path)
            named = program_named(named) if isinstance(document, ContourDocument) else with_suffix(named, ".nc")
            if named.exists():
                raise StoreError(f"{short_path(named)} is there already: type another name.")
            write_data(named, document.data())
            return written_at(named)

        try:
            written = await asyncio.to_thread(within, FILE, write)
        except TimeoutError:
            self.say("That folder does not answer either. Type a name on another disk, such as ~/copy.", Tone.ERROR)
        except StoreError as error:
            self.say(error.text, Tone.ERROR)
        except (OSError, ValueError) as error:
            self.say(f"{short_path(path)} is not saved: {why(error)}", Tone.ERROR)
        else:
            self._leave_save_as()
            self.say(f"A copy is in {written}. {name_of(document)} itself still waits for its folder.", Tone.WARNING)

    @work(group="question")
    async def _save_nc(self, proof: ProofScreen, path: Path | None) -> None:
        if proof.document.file.path is None and path is None:
            self.action_save_as()
        elif await self.saved_nc(proof, path) and path is not None:
            self._leave_save_as()

    async def saved_nc(self, proof: ProofScreen, path: Path | None) -> bool:
        """Save an NC text, asking what is to be asked; whether it was saved."""
        if not proof.take_lines():
            return False
        result = await self._written(proof.document, path)
        if isinstance(result, Saved):
            proof.saved(result.document)
            self.notify(result.notice.text, timeout=4)
        return isinstance(result, Saved)

    async def write_made(self, text: str, suffix: str, make: Callable[[Path], str]) -> tuple[str, str] | None:
        """Write what is made of the program under a typed name: in words where it stands, and its text; None for none.

        Asks before a file is replaced; says what `make` and the disk refuse.  Only in a worker.
        """
        file = self.session.file
        path = await self.on_disk(lambda: with_suffix(chosen(typed(text), file), suffix))

        def before() -> Ask | None:
            refuse_program(path)
            return before_output(path, file)

        def written(made: str) -> str:
            write_output(path, made)
            return written_at(path)

        try:
            ask = await self.on_disk(before)
            if ask is not None and await self.ask(ask) == GO_BACK:
                return None
            made = await asyncio.to_thread(make, path)
            return await self.on_disk(partial(written, made)), made
        except StoreError as error:
            self.say(error.text, Tone.ERROR)
            return None

    @work(group="question", description="close")
    async def close_nc(self, document: NcDocument) -> None:
        """Leave an NC text; changes that are not saved are asked about."""
        if self.disk_is_behind():
            return
        if await self.may_close("LEAVE?", [document]) and self.proof is not None:
            document = self.proof.document
            await self.close_documents([document])
            await self.run_action("app.back")
            if len(self.screen_stack) == 1 and self.document.is_new and document.file.path is not None:
                # started on an NC text: a form in which nothing was typed is not where its reader comes from
                path = document.file.path.absolute()
                self.show_folder(path.parent, path)

    async def _written(self, document: AnyDocument, path: Path | None) -> Saved[AnyDocument] | None:
        """Save a document, asking what is to be asked; None where it was not saved."""
        agreed = frozenset[str]()
        if path is None and document.file.path is None:
            name = await self.push_screen_wait(
                Phrase("SAVE AS", [f"{name_of(document)} needs a name. Enter saves it."])
            )
            if not name.strip():
                return None
            path = typed(name)
        while isinstance(result := await self.on_disk(partial(self.service.save, document, path, agreed)), Ask):
            word = await self.ask(result)
            if word == GO_BACK:
                return None
            agreed |= {word}
        if isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
            return None
        return result

    @work(group="question")
    async def _save(self, path: Path | None) -> None:
        if await self.saved(path) and path is not None:
            self._leave_save_as()

    def _leave_save_as(self) -> None:
        """Back from SAVE AS, unless somebody has left it while the disk was behind."""
        from app.screens.save_and_open import SaveAsScreen

        if isinstance(self.screen, SaveAsScreen):
            self.pop_screen()

    async def saved(self, path: Path | None) -> bool:
        """Save, asking what is to be asked; whether it was saved."""
        self.drop_empty_segment()
        result = await self._written(self.document, path)
        if result is None:
            return False
        self.document = self.document.after_saving(result.document)
        self.begin(session_of(self.document, self.session))
        if self.document.file.path is not None:
            self.keep_settings(self.settings.using(self.document.file.path))
        self.quiet()
        self.notify(result.notice.text, timeout=4)
        return True

    # ---- leave

    async def action_quit(self) -> None:
        """Leave; asks where something is not saved."""
        if self.take_typed():
            self._leave()

    @work(group="question")
    async def _leave(self) -> None:
        if self._behind:
            # the thread that waits for the folder ends with the program
            if await self.ask(not_answering()) == LEAVE:
                self.exit(0)
        elif await self.may_close("QUIT?", self._all_open()):
            await self.close_documents(self._all_open())
            self.exit(0)


def _named(path: Path) -> Path:
    """The file that a typed name means; one that ends like an NC program or a drawing is no program."""
    return path if path.suffix.lower() in NC_SUFFIXES or is_drawing(path) else program_named(path)


def session_of(document: ContourDocument, before: Session | None = None) -> Session:
    """The session on a document; what was worked out `before` stays where the program is the same."""
    session = Session.of_history(
        document.history,
        document.saved_program,
        document.cursor,
        document.field_name,
        document.file.path,
        document.title,
        look_only=document.file.holder is not None,
    )
    return session if before is None or before.program is not session.program else session.like(before)
