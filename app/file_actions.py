"""FileActions opens, creates, saves and closes files, and writes every edit to disk at once.

The document service makes the decisions and knows no screens; this module shows its questions as dialogs.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from textual import work

from app.derivation_actions import DerivationActions
from app.documents import paths, questions
from app.documents.document import AnyDocument, ContourDocument, Document, NcDocument
from app.documents.document_service import DocumentService, Notice, Offer, Opened, Trouble
from app.documents.files import refuse_program, why, write_output
from app.documents.nc_text import NC_SUFFIXES
from app.documents.questions import QuestionText
from app.documents.settings import Settings, SettingsFile
from app.documents.time_limits import Disk
from app.documents.unsaved_work import file_of_copy
from app.screens.base import BaseScreen
from app.screens.dialogs import Phrase, Question
from app.session.messages import Tone
from app.session.session import Session
from core.program.edit import SEGMENT_FIELD, Edited, FormPlace, Refused
from core.program.file.read import StoreError
from core.units import Unit

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from core.pipeline.checking import CheckRequest

Result = TypeVar("Result")


class FileActions(DerivationActions):
    """The App's part for files: `disk` does all work on them, one task after the other, and keys wait for it.

    So a key acts on what the one before it has opened, saved or asked, however slow the folder is.
    """

    service: DocumentService
    document: ContourDocument
    settings_file: SettingsFile
    disk: Disk

    def show_drawing(self, path: Path, *, fresh: bool = False) -> None:
        """Open IMPORT on a drawing for the open program, which takes the drawing's unit if it is `fresh`."""
        # imported here: the first paint must not load shapely and numpy
        from app.screens.import_drawing import ImportScreen

        self.push_screen(ImportScreen(path, fresh=fresh))

    # ---- every edit goes to disk

    def keep(self, session: Session) -> None:
        """Write the session's edits to disk before the next key is read."""
        self.document = self.document.edited(session.history, session.place, session.cursor.field or SEGMENT_FIELD)
        self.keep_document(self.document)

    def keep_document(self, document: Document) -> None:
        """Write a document's edits to disk, or say why they are not there."""
        self.show_notice(self.disk.do(lambda: self.service.keep(document)))

    def apply(self, edited: Edited, label: str) -> bool:
        """Apply an edit, or say why it is refused; return whether it was applied."""
        if isinstance(edited, Refused):
            self.say(edited.text, Tone.ERROR)
            return False
        if self.read_only_reason:
            self.try_out(None)
            self.say(self.read_only_reason, Tone.ERROR)
            return False
        self._change(self.session.with_program(edited, label))
        return True

    def move(self, place: FormPlace, field: str | None = SEGMENT_FIELD) -> None:
        """Put the cursor of the MILL CONTOUR form on a segment, and there on a field.

        Remove a new segment that is still empty when the cursor leaves it.
        """
        session, here = self.session, self.session.place
        if place != here and (without_empty := session.without_empty()) is not session:
            session = without_empty
            if place.block == here.block and place.segment > here.segment:
                place = FormPlace(place.block, place.segment - 1)
        self._change(session.at(place, field))

    def action_undo(self) -> None:
        """Undo one edit; discard half-typed text."""
        label = self.session.history.undo_label
        self._undo_or_redo("undo", label, self.session.undone, f"Undone: {label}. Ctrl+Y brings it back.")

    def action_redo(self) -> None:
        """Redo one edit; discard half-typed text."""
        label = self.session.history.redo_label
        self._undo_or_redo("redo", label, self.session.redone, f"Redone: {label}.")

    def _undo_or_redo(self, action: str, label: str | None, changed: Callable[[], Session], message: str) -> None:
        """Undo or redo; a screen with its own document does so on that document instead."""
        if isinstance(self.screen, BaseScreen):
            if self.screen.undo_or_redo_own_document(action):
                return
            self.screen.forget_typed()
        if label is None:
            self.say(f"There is nothing to {action}.")
            return
        self._change(changed())
        # a message that offers Ctrl+Z must not stay once it is pressed: pressed again, it would undo another edit
        self.clear_notifications()
        self.say(message)

    def _change(self, session: Session) -> None:
        """Write the journal, then set the session, then start the calculation."""
        before = self.session
        if session is before:
            # for example, a number was retyped unchanged
            self.try_out(None)
            return
        self.keep(session)
        self.session = session
        self.displayed = session
        self._advise_later()
        if session.program is not before.program:
            self.part_is_drawn = self.part_is_drawn and any(block.segments for block in session.program.blocks)
            self._derive(session.program)
        elif session.place.block != before.place.block:
            self._make_table()

    def drop_empty_segment(self) -> None:
        """Remove the new segment with the cursor if nothing was typed in it."""
        self._change(self.session.without_empty())

    def show_notice(self, notice: Notice | None) -> None:
        """Show the service's notice, if any."""
        if notice is not None:
            self.say(notice.text, Tone.WARNING if notice.warning else Tone.PLAIN)

    @property
    def read_only_reason(self) -> str:
        """Why the program is read-only: someone else has the file open; empty if it may be edited."""
        holder = self.document.file.holder
        if holder is None:
            return ""
        return f"{questions.held_sentence(holder, self.service.clock())} SAVE AS (Ctrl+K) makes a copy of your own."

    @property
    def settings(self) -> Settings:
        """The user's settings."""
        return self.settings_file.settings

    def keep_settings(self, settings: Settings) -> None:
        """Use these settings from now on and save them."""
        if text := self.settings_file.keep(settings):
            self.say(text, Tone.WARNING)

    # ---- open

    def show_opened(self, opened: Opened[Any]) -> None:
        """Show an opened document, then its notice and its question."""
        document = opened.document
        if isinstance(document, NcDocument):
            proof = self.proof
            if proof is not None and proof.document.file.opening is document.file.opening:
                proof.show_document(document)
            else:
                self.show_nc(document)
        else:
            self.document = document
            self.switch_session(session_of(document))
            self._uncover(0)
            self.keep_settings(self.settings.using(document.file.path))
        self.show_notice_and_ask(opened)

    def show_notice_and_ask(self, opened: Opened[Any]) -> None:
        """Show the notice of an opened document and ask its question, such as whether to restore unsaved work."""
        self.show_notice(opened.notice)
        if opened.offer is not None:
            self._ask_offer(opened.document, opened.offer)

    @work(group="offer", description="offer")
    async def _ask_offer(self, document: AnyDocument, offer: Offer) -> None:
        """Ask, then show the resulting document; if it is the same one, the screen stays, even HOME."""
        word = await self.ask(offer.ask)
        opened = self.disk.do(lambda: self.service.answer(document, offer, word))
        if opened.document is not document:
            self.show_opened(opened)
        else:
            self.show_notice_and_ask(opened)

    async def ask(self, ask: QuestionText) -> str:
        """Ask a question and return the answer's word; call only in a worker."""
        return await self.push_screen_wait(Question(ask.title, ask.lines, ask.answers, ask.safe))

    @work(group="question")
    async def open_file(self, path: Path, *, kept_copy: bool = False) -> None:
        """Open a file or a drawing, or show a folder; a kept copy is offered as work on its original file.

        Ask first about unsaved changes.
        """
        service, here = self.service, self.document.file.path

        def opened() -> Opened[Any] | Trouble | Path:
            if not kept_copy:
                where = paths.resolved_name(path, here)
                if where.suffix.lower() not in NC_SUFFIXES and not paths.is_drawing(where):
                    # any other name means a cutcomp program
                    where = paths.program_named(where)
                return where if paths.is_folder(where) or paths.is_drawing(where) else service.open(where)
            file = file_of_copy(path, path.parent)
            return service.copy_without_name(path) if file is None else service.open(file, kept_copy=path)

        result = self.disk.do(opened)
        if isinstance(result, Trouble) and result.open_already is not None:
            await self._open_already(result, opened, again=kept_copy)
        elif isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
        elif isinstance(result, Path) and paths.is_drawing(result):
            await self._open_drawing(result)
        elif isinstance(result, Path):
            self.show_folder(result)
        elif isinstance(result.document, ContourDocument) and not await self._close_everything("OPEN?"):
            # only one program can be open
            self.disk.do(lambda: service.close(result.document))
        else:
            self.show_opened(result)

    async def _open_drawing(self, path: Path) -> None:
        """Open IMPORT on a drawing; unless the open program is new, ask whether to import into it or a new one."""
        if not self.disk.do(path.is_file):
            self.say(f"{paths.short_path(path)}: there is no such drawing.", Tone.ERROR)
            return
        program, fresh = self.document.program, self.document.is_new
        if not fresh:
            word = await self.ask(questions.into_which(path, self.document))
            if word == questions.GO_BACK:
                return
            if word == questions.NEW_PROGRAM:
                if not await self._new("NEW PROGRAM?", program.unit):
                    return
                fresh = True
        self.show_drawing(path, fresh=fresh)

    async def _open_already(
        self, trouble: Trouble, opened: Callable[[], Opened[Any] | Trouble | Path], *, again: bool
    ) -> None:
        """Show the document that is already open; reopen it if its file has changed or a kept copy was chosen."""
        document = trouble.open_already
        assert document is not None
        again = again or self.disk.do(lambda: self.service.changed(document))
        if not again or document.kind is not self.document.kind:
            proof = next((proof for proof in self.proofs if proof.document.file.opening is document.file.opening), None)
            self._uncover(0 if proof is None else self.screen_stack.index(proof))
            self.say(trouble.text)
        elif await self._close_everything("OPEN AGAIN?"):
            result = self.disk.do(opened)
            self.show_opened(result if isinstance(result, Opened) else self.service.new())
            if isinstance(result, Trouble):
                self.say(result.text, Tone.ERROR)

    @work(group="question")
    async def action_new(self, unit: str) -> None:
        """Start a new program in this unit."""
        await self._new("NEW PROGRAM?", Unit(unit))

    @work(group="question")
    async def action_guide(self) -> None:
        """Start the guided first part."""
        if await self._new("GUIDED FIRST PART?", Unit.IN):
            self.guided = True

    async def _new(self, title: str, unit: Unit) -> bool:
        """Start a new program if everything open may be closed; return whether it was started."""
        if not await self._close_everything(title):
            return False
        self.show_opened(self.service.new(unit))
        return True

    async def _close_everything(self, title: str) -> bool:
        return await self.close_documents(title, self.proofs, program=True)

    async def close_documents(self, title: str, proofs: Sequence[ProofScreen], *, program: bool = False) -> bool:
        """Close NC texts, and the program too if asked to, unless the operator keeps unsaved work open.

        Closing removes their journals and locks.  Return whether they were closed.
        """
        if not await self._may_close(title, proofs, program=program):
            return False
        closing = (*((self.document,) if program else ()), *(proof.document for proof in proofs))

        def close() -> None:
            for document in closing:
                self.service.close(document)

        self.disk.do(close)
        return True

    async def _may_close(self, title: str, proofs: Sequence[ProofScreen], *, program: bool) -> bool:
        """Return whether documents may be closed: they are saved, or the operator saves or discards the changes."""
        if not all(proof.take_lines() for proof in proofs):
            return False
        ours = [self.document] if program else []
        half_typed = self.screen.half_typed_sentence if program and isinstance(self.screen, BaseScreen) else ""
        ask = questions.leaving(title, [*ours, *(proof.document for proof in proofs)], half_typed)
        word = questions.DISCARD if ask is None else await self.ask(ask)
        if word != questions.SAVE:
            return word == questions.DISCARD
        if half_typed and not self.take_typed():
            return False
        for proof in proofs:
            if proof.document.unsaved and not await self.saved(proof, None):
                return False
        return not program or not self.document.unsaved or await self.saved(None, None)

    def show_nc(self, document: NcDocument, check_request: CheckRequest | None = None) -> None:
        """Open NC PROOF on a text; `check_request` holds the control, tools and unit of the command line."""
        from app.nc_proof.screen import ProofScreen

        path, settings = document.file.path, self.settings
        remembered = "" if path is None else settings.tools_of(path)
        self.push_screen(ProofScreen(document, check_request, settings.control, remembered))

    def show_folder(self, folder: Path, at: Path | None = None) -> None:
        """Open HOME on a folder, with the cursor on the file `at`."""
        from app.screens.home import HomeScreen

        self.push_screen(HomeScreen(folder, at))

    # ---- save

    @property
    def _in_front(self) -> Document:
        """The NC text in front, or else the program."""
        return self.document if self.proof is None else self.proof.document

    def action_save(self) -> None:
        """Save the NC text in front, or else the program, under its name; ask for a name if it has none."""
        if not self.take_typed():
            # the prompt says what is wrong with the text
            self.notify("NOT SAVED: correct the field, then Ctrl+S.", timeout=4)
            return
        if self._in_front.file.path is None:
            self.action_save_as()
        else:
            self._save(self.proof, None)

    def action_save_as(self) -> None:
        """Ask for a name to save under."""
        from app.screens.entry_screen import SaveAsScreen

        path = self._in_front.file.path
        name = str(path) if path is not None else f"{self.document.title or 'part'}.toml"
        self.push_screen(SaveAsScreen(name))

    def action_open_path(self) -> None:
        """Ask for the path of a file to open, in the folder that HOME shows, or else in the last one used."""
        from app.screens.entry_screen import OpenPathScreen
        from app.screens.home import HomeScreen

        folder = str(self.screen.folder) if isinstance(self.screen, HomeScreen) else self.settings.folder
        self.push_screen(OpenPathScreen(f"{folder}/" if folder else ""))

    def save_as(self, text: str) -> None:
        """Save under a typed name."""
        proof = self.proofs[-1] if self.proofs and self.screen_stack[-2:-1] == self.proofs[-1:] else None
        if proof is not None:
            old = proof.document.file.path
            self._save(proof, paths.with_suffix(paths.path_of_text(text), ".nc" if old is None else old.suffix))
        else:
            self._save(None, paths.path_of_text(text))

    async def write_made(self, text: str, suffix: str, make: Callable[[Path], str]) -> tuple[str, str] | None:
        """Write the text from `make` under a typed name; return where it was written and the text, None if it was not.

        Ask before replacing a file; report the errors of `make` and the disk.  Call only in a worker.
        """
        file = self.session.file
        path = self.disk.do(lambda: paths.with_suffix(paths.resolved_name(paths.path_of_text(text), file), suffix))

        def before() -> QuestionText | None:
            refuse_program(path)
            return questions.before_writing(path, file)

        def written(made: str) -> str:
            write_output(path, made)
            return paths.written_path(path)

        try:
            ask = self.disk.do(before)
            if ask is not None and await self.ask(ask) == questions.GO_BACK:
                return None
            made = await asyncio.to_thread(make, path)
            return self.disk.do(partial(written, made)), made
        except StoreError as error:
            self.say(error.text, Tone.ERROR)
        except OSError as error:
            # for example, no file can have so long a name
            self.say(f"{paths.short_path(path)} is not saved: {why(error)}", Tone.ERROR)
        return None

    @work(group="question", description="close")
    async def close_nc(self, proof: ProofScreen) -> None:
        """Close an NC text; ask about unsaved changes."""
        if await self.close_documents("LEAVE?", [proof]) and self.proof is not None:
            path = self.proof.document.file.path
            await self.run_action("app.back")
            if len(self.screen_stack) == 1 and self.document.is_new and path is not None:
                # cutcomp was started on an NC text: go to its folder, not to a form that was never used
                file = paths.current_folder() / path
                self.show_folder(file.parent, file)

    @work(group="question")
    async def _save(self, proof: ProofScreen | None, path: Path | None) -> None:
        from app.screens.entry_screen import SaveAsScreen

        # the operator may have left SAVE AS while it waited for the disk
        if await self.saved(proof, path) and path is not None and isinstance(self.screen, SaveAsScreen):
            self.pop_screen()

    async def saved(self, proof: ProofScreen | None, path: Path | None) -> bool:
        """Save the NC text of a screen or else the program, asking questions as needed; return whether it was saved."""
        if proof is None:
            self.drop_empty_segment()
        elif not proof.take_lines():
            return False
        document: Any = self.document if proof is None else proof.document
        if path is None and document.file.path is None:
            name = await self.push_screen_wait(
                Phrase("SAVE AS", [f"{questions.name_of(document)} needs a name. Enter saves it."])
            )
            if not name.strip():
                return False
            path = paths.path_of_text(name)
        agreed = frozenset[str]()
        while isinstance(result := self.disk.do(partial(self.service.save, document, path, agreed)), QuestionText):
            word = await self.ask(result)
            if word == questions.GO_BACK:
                return False
            agreed |= {word}
        if isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
            return False
        if proof is not None:
            proof.saved(result.document)
        else:
            self.document = self.document.saved(result.document.file, result.document)
            self.switch_session(session_of(self.document, self.session))
            self.keep_settings(self.settings.using(self.document.file.path))
            self.clear_notice()
        self.notify(result.notice.text, timeout=4)
        return True

    # ---- quit

    async def action_quit(self) -> None:
        """Quit; ask about unsaved changes and half-typed text."""
        self._leave()

    @work(group="question")
    async def _leave(self) -> None:
        if await self._close_everything("QUIT?"):
            self.exit(0)


def session_of(document: ContourDocument, before: Session | None = None) -> Session:
    """Return the session on a document; reuse the results of `before` if the program is the same."""
    session = replace(
        Session.of(document.program, document.title),
        history=document.history,
        saved=document.saved_program,
        file=document.file.path,
        look_only=document.file.holder is not None,
    )
    if before is not None and before.program is session.program:
        return replace(session, derived=before.derived, cursor=before.cursor, table=before.table)
    untouched = document.field_name == SEGMENT_FIELD and not document.history.past
    return session if untouched else session.at(document.cursor, document.field_name)
