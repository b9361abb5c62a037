"""What is open: a contour program or an NC text, each with its file; both can do the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import ClassVar, Final, Self, TypeVar

from app.documents import contour_journal, nc_journal
from app.documents.files import LARGEST_FILE, Stamp
from app.documents.journal import Journal, Kind, Place
from app.documents.journal_file import Record
from app.documents.lock import Owner
from app.documents.nc_text import MAX_NC_BYTES, Change, NcText
from app.documents.programs import empty_program
from core.program import history as program_history
from core.program.edit import FormPlace
from core.program.file.read import StoreError, loads_bytes
from core.program.file.write import dumps
from core.program.history import History
from core.program.model import Program

SEGMENT: Final = "segment"
"""The field on which the cursor stands when a program is opened."""
FIRST_START: Final = FormPlace(1, 0)
"""START of block 1."""


@dataclass(frozen=True, eq=False, slots=True)
class FileState:
    """The file of a document.

    `path` is None until it has a name.  `stamp` is the file's as it was read or saved last, None where there was none
    that could be read.  `holder` is somebody else who has it open: then the document may only be looked at.
    `link_agreed` says that the operator agreed to write where a link leads.  `opening` tells one opening of a file from
    another.
    """

    path: Path | None = None
    stamp: Stamp | None = None
    holder: Owner | None = None
    link_agreed: bool = False
    opening: object = field(default_factory=object)


@dataclass(frozen=True, eq=False, slots=True)
class ContourDocument:
    """A contour program with its undo and the cursor; `title` names the example that it began with."""

    kind: ClassVar[Kind] = Kind.CONTOUR
    history: History
    saved_program: Program
    file: FileState = field(default_factory=FileState)
    cursor: FormPlace = FIRST_START
    field_name: str = SEGMENT
    title: str = ""

    @classmethod
    def of(cls, program: Program, file: FileState | None = None, *, title: str = "") -> Self:
        """A program that its file holds, or that nobody has edited."""
        return cls(History(program), program, FileState() if file is None else file, title=title)

    @classmethod
    def read(cls, data: bytes, file: FileState) -> Self:
        """The program of a file's content; StoreError says what is wrong with it."""
        return cls.of(loads_bytes(data, str(file.path)), file)

    @property
    def program(self) -> Program:
        """The program as it is now."""
        return self.history.program

    @property
    def is_new(self) -> bool:
        """Nothing has been typed into the program yet."""
        return self.program == empty_program(self.program.unit)

    @property
    def unsaved(self) -> bool:
        """The file does not hold the program as it is now."""
        return self.program is not self.saved_program and self.program != self.saved_program

    @property
    def place(self) -> Place:
        """Block, segment and name of the field."""
        return (self.cursor.block, self.cursor.segment, self.field_name)

    def edited(self, history: History, cursor: FormPlace, name: str) -> Self:
        """After an edit, an undo, or a move of the cursor."""
        return replace(self, history=history, cursor=cursor, field_name=name)

    def data(self) -> bytes:
        """The text of the program's file."""
        return dumps(self.program).encode()

    def saved(self, file: FileState) -> Self:
        """After the file was written."""
        return replace(self, file=file, saved_program=self.program)

    def after_saving(self, saved: Self) -> Self:
        """This work, of which an earlier state was saved while it went on."""
        return replace(self, file=saved.file, saved_program=saved.saved_program)

    def same_edits(self, other: Document) -> bool:
        """Whether nothing was edited, undone or redone between the two."""
        return isinstance(other, ContourDocument) and self.history is other.history

    def whole_records(self) -> Iterator[Record]:
        """All work, as the records of a journal that begins."""
        return contour_journal.whole_records(self.history)

    def records_since(self, before: Document) -> list[Record] | None:
        """The edits since an earlier state; None where the one does not lead to the other."""
        if not isinstance(before, ContourDocument):
            return None
        return contour_journal.records_between(before.history, self.history)

    def restored(self, journal: Journal) -> Self:
        """The work of a journal, the cursor where it was; ValueError for one of an NC text."""
        history, place = _history_of(journal), journal.place
        match place:
            case (int(block), int(segment), str(name)):
                return replace(self, history=history, cursor=FormPlace(block, segment), field_name=name)
            case _:
                return replace(self, history=history)

    def holds(self, journal: Journal) -> bool:
        """Whether this is the program of a journal already."""
        return _history_of(journal).program == self.program

    def work_of(self, data: bytes) -> History | None:
        """A file's program as one edit; None where it is no program."""
        try:
            return self.history.do(loads_bytes(data, ""), "SAVE")
        except StoreError:
            return None

    def differences(self, journal: Journal) -> tuple[str, ...]:
        """What the program of a journal has otherwise; a new program is compared in the units of the journal's."""
        mine, left = self.program, _history_of(journal).program
        if mine.unit is not left.unit and self.is_new:
            mine = empty_program(left.unit)
        return program_history.differences(mine, left)

    def compared(self, data: bytes) -> tuple[tuple[str, ...], tuple[str, ...]] | None:
        """What a file's program has otherwise than the saved one, and what this has otherwise than it.

        None where it is no program.
        """
        try:
            theirs = loads_bytes(data, "")
        except StoreError:
            return None
        return program_history.differences(self.saved_program, theirs), program_history.differences(
            theirs, self.program
        )


def _history_of(journal: Journal) -> History:
    if not isinstance(journal.work, History):
        raise ValueError("a journal of an NC text")
    return journal.work


@dataclass(frozen=True, eq=False, slots=True)
class NcDocument:
    """An NC text with its undo, and the row of the cursor."""

    kind: ClassVar[Kind] = Kind.NC
    text: NcText = field(default_factory=NcText)
    file: FileState = field(default_factory=FileState)
    row: int = 0

    @classmethod
    def read(cls, data: bytes, file: FileState) -> Self:
        """The text of a file's content."""
        return cls(NcText.read(data), file)

    @property
    def unsaved(self) -> bool:
        """The file does not hold the lines as they are."""
        return self.text.unsaved

    @property
    def place(self) -> Place:
        """The row of the cursor, from 0."""
        return (self.row,)

    def edited(self, text: NcText, row: int) -> Self:
        """After an edit, an undo, or a move of the cursor."""
        return replace(self, text=text, row=row)

    def data(self) -> bytes:
        """The file's content: what nobody touched byte by byte."""
        return self.text.data

    def saved(self, file: FileState) -> Self:
        """After the file was written."""
        return replace(self, file=file, text=self.text.written(self.text.data))

    def after_saving(self, saved: Self) -> Self:
        """This work, of which an earlier state was saved while it went on."""
        text = replace(self.text, origin=saved.text.origin, saved=saved.text.saved)
        return replace(self, file=saved.file, text=text)

    def same_edits(self, other: Document) -> bool:
        """Whether nothing was edited, undone or redone between the two."""
        past, future = self.text.past, self.text.future
        return isinstance(other, NcDocument) and past is other.text.past and future is other.text.future

    def whole_records(self) -> Iterator[Record]:
        """All work, as the records of a journal that begins."""
        return nc_journal.whole_records(self.text)

    def records_since(self, before: Document) -> list[Record] | None:
        """The edits since an earlier state; None where the one does not lead to the other."""
        if not isinstance(before, NcDocument):
            return None
        return nc_journal.records_between(before.text, self.text)

    def restored(self, journal: Journal) -> Self:
        """The work of a journal; where an undo of it leads back to this text, nothing is unsaved there."""
        text = _text_of(journal)
        work = replace(text, origin=self.text.origin)
        if self.file.stamp is not None:
            work = nc_journal.known_in_file(work, self.text)
        row = journal.place[0] if journal.place else work.past[-1].row if work.past else 0
        return replace(self, text=work, row=row if isinstance(row, int) else 0)

    def holds(self, journal: Journal) -> bool:
        """Whether these are the lines of a journal already."""
        return "".join(_text_of(journal).lines) == "".join(self.text.lines)

    def work_of(self, data: bytes) -> NcText | None:
        """A file's lines as one edit; of another encoding they are none."""
        text = NcText.read(data, self.text.encoding)
        same = text.encoding == self.text.encoding
        return self.text.done(Change(0, self.text.lines, text.lines)) if same else None

    def differences(self, journal: Journal) -> tuple[str, ...]:
        """What the lines of a journal have otherwise."""
        return nc_journal.differences(self.text, _text_of(journal))

    def compared(self, data: bytes) -> tuple[tuple[str, ...], tuple[str, ...]] | None:
        """What a file's lines have otherwise than the file as it was opened, and what these have otherwise than it."""
        theirs = NcText.read(data)
        opened = NcText.read(self.text.origin)
        return nc_journal.differences(opened, theirs, "was"), nc_journal.differences(theirs, self.text, "theirs")


def _text_of(journal: Journal) -> NcText:
    if not isinstance(journal.work, NcText):
        raise ValueError("a journal of a contour program")
    return journal.work


Document = ContourDocument | NcDocument
"""Either kind; a value, so that every edit makes a new one."""
AnyDocument = TypeVar("AnyDocument", ContourDocument, NcDocument)

MAX_BYTES: Final = {Kind.CONTOUR: LARGEST_FILE, Kind.NC: MAX_NC_BYTES}
"""Bytes of the largest file of a kind."""
