"""What the App does with files: open, new, save, save as, leave, and every edit put on the disk at once.

The document service decides and knows no screen; what it asks is asked here in a dialog.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from textual import work
from textual.app import App

from app.documents.document import AnyDocument, ContourDocument, Document, NcDocument
from app.documents.folders import chosen
from app.documents.naming import is_drawing, typed
from app.documents.questions import DISCARD, GO_BACK, SAVE, Ask, held_sentence, leaving
from app.documents.service import DocumentService, Notice, Offer, Opened, Saved, Trouble
from app.documents.settings import Settings, SettingsFile
from app.screens.dialogs import Answer, Question
from app.session.messages import Tone
from app.session.session import SEGMENT, Session
from core.units import Unit

if TYPE_CHECKING:
    from app.nc_proof.screen import ProofScreen
    from app.screens.base import BaseScreen


class FileActions(App[int]):
    """The App's side of files; `service` is None where nothing is to be kept, as in a test of one screen."""

    service: DocumentService | None
    document: ContourDocument
    settings: Settings
    settings_file: SettingsFile
    waiting_offer: Offer | None

    # ---- what the App itself has

    def begin(self, session: Session) -> None:
        """Work on another program from now on."""
        raise NotImplementedError

    def say(self, text: str, tone: Tone = Tone.PLAIN) -> None:
        """A sentence on the prompt line."""
        raise NotImplementedError

    def bring_form(self) -> None:
        """MILL CONTOUR to the front."""
        raise NotImplementedError

    def show_nc(self, document: NcDocument) -> None:
        """NC PROOF on a text."""
        raise NotImplementedError

    @property
    def proof(self) -> ProofScreen | None:
        """NC PROOF, where it is in front."""
        raise NotImplementedError

    @property
    def proofs(self) -> list[ProofScreen]:
        """Every NC PROOF that is open."""
        raise NotImplementedError

    def show_screen(self, screen: BaseScreen) -> None:
        """A screen over all others."""
        raise NotImplementedError

    def show_drawing(self, path: Path, *, fresh: bool = False) -> None:
        """IMPORT on a drawing: its contours go to the open program, which takes the drawing's unit if it is `fresh`."""
        # shapely and numpy are not needed by the first paint
        from app.screens.import_drawing import ImportScreen

        self.show_screen(ImportScreen(path, fresh=fresh))

    # ---- every edit on the disk

    def keep(self, session: Session) -> None:
        """Put what was edited on the disk, before the next key is read."""
        self.document = self.document.edited(session.history, session.place, session.cursor.field or SEGMENT)
        if self.service is not None:
            self.tell(self.service.keep(self.document))

    def tell(self, notice: Notice | None) -> None:
        """What the service has to say."""
        if notice is not None:
            self.say(notice.text, Tone.WARNING if notice.warning else Tone.PLAIN)

    @property
    def looking(self) -> str:
        """Why nothing may be changed: somebody else has the file open; empty where it may."""
        holder = self.document.file.holder
        if holder is None or self.service is None:
            return ""
        return f"{held_sentence(holder, self.service.clock())} SAVE AS makes a copy of your own."

    def keep_settings(self, settings: Settings) -> None:
        """Settings as they are from now on."""
        self.settings = settings
        if text := self.settings_file.keep(settings):
            self.say(text, Tone.WARNING)

    def keep_nc(self, document: NcDocument) -> None:
        """Put what was edited in an NC text on the disk."""
        if self.service is not None:
            self.tell(self.service.keep(document))

    # ---- open

    def adopt(self, opened: Opened[Any]) -> None:
        """Work on a document that was opened, and ask what is to be asked about it."""
        document = opened.document
        if isinstance(document, NcDocument):
            self.show_nc(document)
        else:
            self.document = document
            self.begin(session_of(document))
            self.bring_form()
            if document.file.path is not None:
                self.keep_settings(self.settings.using(document.file.path))
        self.tell(opened.notice)
        if opened.offer is not None:
            self._ask_offer(document, opened.offer)

    @work(group="offer")
    async def _ask_offer(self, document: ContourDocument | NcDocument, offer: Offer) -> None:
        word = await self.ask(offer.ask)
        if self.service is not None:
            self.adopt(self.service.answer(document, offer, word))

    async def ask(self, ask: Ask) -> str:
        """The word of the answer to a question; only in a worker."""
        answers = [Answer(answer.word, answer.effect) for answer in ask.answers]
        return await self.push_screen_wait(Question(ask.title, [*ask.lines, *ask.details], answers, ask.safe))

    def open_file(self, path: Path) -> None:
        """Work on a file; what is not saved is asked about first."""
        self._open(path)

    @work(exclusive=True, group="question")
    async def _open(self, path: Path) -> None:
        if self.service is None:
            return
        where = chosen(path, self.document.file.path)
        if is_drawing(where):
            self.show_drawing(where)
            return
        if _is_program(where) and not await self.may_leave("OPEN?"):
            return
        result = self.service.open(where)
        if isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
            return
        if isinstance(result.document, ContourDocument):
            self.service.close(self.document)
        self.adopt(result)

    def action_new(self, unit: str) -> None:
        """A new program in this unit."""
        self._new(Unit(unit))

    @work(exclusive=True, group="question")
    async def _new(self, unit: Unit) -> None:
        if self.service is None or not await self.may_leave("NEW PROGRAM?"):
            return
        self.service.close(self.document)
        self.keep_settings(Settings(**{**_fields(self.settings), "unit": unit}))
        self.adopt(self.service.new(unit))

    async def may_leave(self, title: str) -> bool:
        """Whether the program may be left: it is saved, it has just been saved, or its changes are given up."""
        ask = leaving(title, [self.document])
        word = DISCARD if ask is None else await self.ask(ask)
        if word == SAVE:
            return await self.saved(None)
        return word == DISCARD

    # ---- save

    def action_save(self) -> None:
        """Save under the name the program, or the NC text in front, has, or ask for one."""
        if self.proof is not None:
            self._save_nc(self.proof, None)
        elif self.document.file.path is None:
            self.action_save_as()
        else:
            self._save(None)

    def action_save_as(self) -> None:
        """Ask for a name."""
        from app.screens.file_names import SaveAsScreen

        path = self.document.file.path if self.proof is None else self.proof.document.file.path
        name = str(path) if path is not None else f"{self.document.title or 'part'}.toml"
        self.show_screen(SaveAsScreen(name))

    def action_open_path(self) -> None:
        """Ask for the path of a file to open."""
        from app.screens.file_names import OpenPathScreen

        folder = self.settings.folder
        self.show_screen(OpenPathScreen(f"{folder}/" if folder else ""))

    def action_import_drawing(self) -> None:
        """Ask for the path of a drawing."""
        self.action_open_path()

    def save_as(self, text: str) -> None:
        """Save under a typed name."""
        if self.proofs and self.screen_stack[-2:-1] == self.proofs[-1:]:
            self._save_nc(self.proofs[-1], typed(text))
        else:
            self._save(typed(text))

    @work(exclusive=True, group="question")
    async def _save_nc(self, proof: ProofScreen, path: Path | None) -> None:
        if proof.document.file.path is None and path is None:
            self.action_save_as()
        elif await self.saved_nc(proof, path) and path is not None:
            await self.run_action("app.back")

    async def saved_nc(self, proof: ProofScreen, path: Path | None) -> bool:
        """Save an NC text, asking what is to be asked; whether it was saved."""
        if self.service is None or not proof.take_lines():
            return False
        result = await self._written(proof.document, path)
        if isinstance(result, Saved):
            proof.saved(result.document)
            self.notify(result.notice.text, timeout=4)
        return isinstance(result, Saved)

    def close_nc(self, document: NcDocument) -> None:
        """Leave an NC text; changes that are not saved are asked about."""
        self._close_nc(document)

    @work(exclusive=True, group="question")
    async def _close_nc(self, document: NcDocument) -> None:
        ask = leaving("LEAVE?", [document])
        word = DISCARD if ask is None else await self.ask(ask)
        if word == SAVE and self.proof is not None and not await self.saved_nc(self.proof, None):
            return
        if word != GO_BACK:
            if self.service is not None and self.proof is not None:
                self.service.close(self.proof.document)
            await self.run_action("app.back")

    async def _written(self, document: AnyDocument, path: Path | None) -> Saved[AnyDocument] | None:
        """Save a document, asking what is to be asked; None where it was not saved."""
        assert self.service is not None
        agreed: frozenset[str] = frozenset()
        while isinstance(result := self.service.save(document, path, agreed), Ask):
            word = await self.ask(result)
            if word == GO_BACK:
                return None
            agreed |= {word}
        if isinstance(result, Trouble):
            self.say(result.text, Tone.ERROR)
            return None
        return result

    @work(exclusive=True, group="question")
    async def _save(self, path: Path | None) -> None:
        if await self.saved(path) and path is not None:
            await self.run_action("app.back")

    async def saved(self, path: Path | None) -> bool:
        """Save, asking what is to be asked; whether it was saved."""
        if self.service is None:
            return False
        result = await self._written(self.document, path)
        if result is None:
            return False
        self.document = result.document
        self.begin(session_of(result.document, self.current_session))
        if result.document.file.path is not None:
            self.keep_settings(self.settings.using(result.document.file.path))
        self.notify(result.notice.text, timeout=4)
        return True

    @property
    def current_session(self) -> Session:
        """The session as it is now."""
        raise NotImplementedError

    # ---- leave

    async def action_quit(self) -> None:
        """Leave; asks where something is not saved."""
        self._leave()

    @work(exclusive=True, group="question")
    async def _leave(self) -> None:
        documents: list[Document] = [self.document, *(proof.document for proof in self.proofs)]
        ask = leaving("QUIT?", documents)
        word = DISCARD if ask is None else await self.ask(ask)
        if word == GO_BACK or (word == SAVE and not await self._all_saved()):
            return
        self._close(self.document)
        for proof in self.proofs:
            self._close(proof.document)
        self.exit(0)

    def _close(self, document: Document) -> None:
        if self.service is not None:
            self.service.close(document)

    async def _all_saved(self) -> bool:
        """Save everything that is open; whether all of it was saved."""
        for proof in self.proofs:
            if proof.document.unsaved and not await self.saved_nc(proof, None):
                return False
        return not self.document.unsaved or await self.saved(None)


def session_of(document: ContourDocument, before: Session | None = None) -> Session:
    """The session on a document; what was worked out `before` stays where the program is the same."""
    session = Session.of_history(
        document.history,
        document.saved_program,
        document.cursor,
        document.field_name,
        document.file.path,
        document.title,
    )
    return session if before is None or before.program is not session.program else session.like(before)


def _is_program(path: Path) -> bool:
    return path.suffix.lower() == ".toml"


def _fields(settings: Settings) -> dict[str, Any]:
    return {name: getattr(settings, name) for name in Settings.__slots__}
