"""A simulated operator who types into a document through the service and may be killed at any moment."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.documents.document import ContourDocument, Document, FileState, NcDocument
from app.documents.document_service import DocumentService, Notice, Offer, Opened, Saved, Trouble
from app.documents.lock import Owner, myself
from app.documents.questions import QuestionText
from core.program.edit import FormPlace, type_field
from core.program.model import Number, Program
from tests.app.nc_lines import changed

TIME = "2025-03-04T06:05:00+01:00"
DEAD = Owner("ann", myself("").host, 2**22 + 17, "", "2025-03-04T06:00:00+01:00")
"""A process of this host that is always dead."""
BOB = replace(DEAD, user="bob", pid=DEAD.pid + 1)
ALIVE = replace(myself("2025-03-04T06:01:00+01:00"), user="ann")
"""A running program of ann's."""
ELSEWHERE = Owner("bob", "office", 7, "", "2025-03-04T05:00:00+01:00")
"""A process of another host, which may be alive."""
NC = b"G20 G17\r\nG0 X1.\r\n\xb0 M30\r\n"


@dataclass
class Typist:
    """Uses the service as the App does: every edit is kept before the next one."""

    service: DocumentService
    document: Any
    offer: Offer | None = None
    notice: Notice | None = None

    def took(self, opened: Opened[Any]) -> Typist:
        self.document, self.notice, self.offer = opened.document, opened.notice, opened.offer
        return self

    @property
    def said(self) -> str:
        return "" if self.notice is None else self.notice.text

    @property
    def asked(self) -> str:
        """The words of the open question."""
        return "" if self.offer is None else words(self.offer.ask)

    def answer(self, word: str) -> Typist:
        assert self.offer is not None
        assert word == "GO BACK" or word in [answer.word for answer in self.offer.ask.answers]
        return self.took(self.service.answer(self.document, self.offer, word))

    def keep(self, document: Document) -> Typist:
        self.document = document
        self.notice = self.service.keep(document)
        return self

    def type(self, *numbers: float) -> Typist:
        """One edit per number: TOOL of block 1, or the first line of the text."""
        for number in numbers:
            document = self.document
            if isinstance(document, ContourDocument):
                program = type_field(document.program, FormPlace(1), "tool", Number(float(number)))
                assert isinstance(program, Program)
                history = document.history.do(program, "TOOL")
                self.keep(document.edited(history, FormPlace(1), "tool"))
            else:
                self.keep(document.edited(changed(document.text, 0, f"T{number:g}"), 0))
        return self

    def undo(self) -> Typist:
        document = self.document
        if isinstance(document, ContourDocument):
            return self.keep(document.edited(document.history.undo(), document.cursor, document.field_name))
        return self.keep(document.edited(document.text.undo(), document.row))

    def redo(self) -> Typist:
        document = self.document
        if isinstance(document, ContourDocument):
            return self.keep(document.edited(document.history.redo(), document.cursor, document.field_name))
        return self.keep(document.edited(document.text.redo(), document.row))

    def try_to_save(self, path: Path | None = None, *answers: str) -> QuestionText | Trouble | Saved[Any]:
        return self.service.save(self.document, path, frozenset(answers))

    def save(self, path: Path | None = None, *answers: str) -> Typist:
        saved = self.try_to_save(path, *answers)
        assert isinstance(saved, Saved), saved
        self.document, self.notice = saved.document, saved.notice
        return self

    @property
    def number(self) -> float:
        """The number typed last."""
        document = self.document
        if isinstance(document, NcDocument):
            return float(document.text.text(0).removeprefix("T").partition(" ")[0].replace("G20", "1"))
        tool = document.program.blocks[0].tool
        assert isinstance(tool, Number)
        return tool.value

    @property
    def work(self) -> object:
        """Everything that can be undone and redone, for comparisons."""
        document = self.document
        if isinstance(document, ContourDocument):
            return document.history
        states = [document.text]
        while states[-1].past:
            states.append(states[-1].undo())
        return ([state.lines for state in states], len(document.text.future))

    def killed(self) -> None:
        """Simulate kill -9: only the file handles are closed, so that tests can open many."""
        for kept in self.service._open.values():
            if kept.journal is not None:
                kept.journal.close()

    def left(self) -> None:
        """Close the document, saved or given up."""
        self.service.close(self.document)


def words(ask: QuestionText) -> str:
    return " ".join((ask.title, *ask.lines, *(f"{answer.word} {answer.effect}" for answer in ask.answers)))


def service(state: Path, me: Owner = DEAD, clock: str = TIME) -> DocumentService:
    return DocumentService(me, state, lambda: clock)


def started(state: Path, file: Path | None = None, me: Owner = DEAD, clock: str = TIME) -> Typist:
    """The program started on a file, or on none; `state` is the user's state folder."""
    documents = service(state, me, clock)
    opened = documents.new(offers=True) if file is None else documents.open(file)
    assert isinstance(opened, Opened), opened
    return Typist(documents, None).took(opened)


def number_in(file: Path) -> float:
    """The number that a file holds."""
    kind = NcDocument if file.suffix == ".nc" else ContourDocument
    return Typist(service(file.parent), kind.read(file.read_bytes(), FileState(file))).number


def changed_by_another(file: Path, number: float) -> None:
    """Another program writes the file and ignores locks."""
    kind = NcDocument if file.suffix == ".nc" else ContourDocument
    documents = service(file.parent.parent / "another's", ELSEWHERE)
    copy = file.parent.parent / file.name
    copy.write_bytes(file.read_bytes())
    opened = documents.open(copy)
    assert isinstance(opened, Opened)
    assert isinstance(opened.document, kind)
    file.write_bytes(Typist(documents, opened.document).type(number).document.data())
    documents.close(opened.document)
    copy.unlink()


def names(path: Path) -> list[str]:
    """The names of the files beside a document."""
    return sorted(child.name for child in path.parent.iterdir() if child != path)
