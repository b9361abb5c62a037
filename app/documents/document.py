"""This module holds open documents: a contour program or an NC text with its file, both with the same methods."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import ClassVar, Final, Self, TypeVar

from app.documents.files import MAX_PROGRAM_BYTES, Stamp
from app.documents.journal import Journal, Kind, Place
from app.documents.lock import Owner
from app.documents.nc_text import MAX_NC_BYTES, NcText
from app.documents.programs import empty_program
from core.program.edit import FIRST_START, SEGMENT_FIELD, FormPlace
from core.program.file.read import loads_bytes
from core.program.file.write import dumps
from core.program.history import History
from core.program.model import Program


@dataclass(frozen=True, eq=False, slots=True)
class FileState:
    """The file of a document.

    `path` is None until it has a name.  `stamp` describes the file as it was last read or saved, None if no file could
    be read.  `holder` is somebody else who has it open: then the document is read-only.  `link_agreed`: the operator
    has agreed to write where a link leads.  `opening` distinguishes one opening of a file from another.
    """

    path: Path | None = None
    stamp: Stamp | None = None
    holder: Owner | None = None
    link_agreed: bool = False
    opening: object = field(default_factory=object)


@dataclass(frozen=True, eq=False, slots=True)
class ContourDocument:
    """A contour program with its undo history and cursor; `title` names the example that it began with."""

    kind: ClassVar[Kind] = Kind.CONTOUR
    history: History
    saved_program: Program
    file: FileState = field(default_factory=FileState)
    cursor: FormPlace = FIRST_START
    field_name: str = SEGMENT_FIELD
    title: str = ""

    @classmethod
    def of(cls, program: Program, file: FileState | None = None, *, title: str = "") -> Self:
        """Return the document of a program that is saved in its file or not edited yet."""
        return cls(History(program), program, FileState() if file is None else file, title=title)

    @classmethod
    def read(cls, data: bytes, file: FileState) -> Self:
        """Return the document of a file's content; StoreError says what is wrong with it."""
        return cls.of(loads_bytes(data, str(file.path)), file)

    @property
    def work(self) -> History:
        """What the edits have made."""
        return self.history

    @property
    def program(self) -> Program:
        """The current program."""
        return self.history.program

    @property
    def is_new(self) -> bool:
        """True if nothing has been typed into the program yet."""
        return self.program == empty_program(self.program.unit)

    @property
    def unsaved(self) -> bool:
        """True if the file does not hold the current program."""
        return self.program is not self.saved_program and self.program != self.saved_program

    @property
    def place(self) -> Place:
        """The cursor's block, segment and field name."""
        return (self.cursor.block, self.cursor.segment, self.field_name)

    def edited(self, history: History, cursor: FormPlace, name: str) -> Self:
        """Return the document after an edit, an undo, or a move of the cursor."""
        return replace(self, history=history, cursor=cursor, field_name=name)

    def data(self) -> bytes:
        """Return the content of the program's file."""
        return dumps(self.program).encode()

    def saved(self, file: FileState, written: Self) -> Self:
        """Return the document after it, or an earlier state of it, was written to a file."""
        return replace(self, file=file, saved_program=written.program)

    def restored(self, journal: Journal) -> Self:
        """Return the work of a journal of this kind with its cursor."""
        history = journal.work
        assert isinstance(history, History)
        match journal.place:
            case (int(block), int(segment), str(name)):
                return replace(self, history=history, cursor=FormPlace(block, segment), field_name=name)
            case _:
                return replace(self, history=history)

    def holds(self, journal: Journal) -> bool:
        """True if this is already the journal's program."""
        return isinstance(journal.work, History) and journal.work.program == self.program


@dataclass(frozen=True, eq=False, slots=True)
class NcDocument:
    """An NC text with its undo history, and the row of the cursor."""

    kind: ClassVar[Kind] = Kind.NC
    text: NcText = field(default_factory=NcText)
    file: FileState = field(default_factory=FileState)
    row: int = 0

    @classmethod
    def read(cls, data: bytes, file: FileState) -> Self:
        """Return the document of a file's content."""
        return cls(NcText.read(data), file)

    @property
    def work(self) -> NcText:
        """What the edits have made."""
        return self.text

    @property
    def unsaved(self) -> bool:
        """True if the file does not hold the current lines."""
        return self.text.unsaved

    @property
    def place(self) -> Place:
        """The cursor's row, from 0."""
        return (self.row,)

    def edited(self, text: NcText, row: int) -> Self:
        """Return the document after an edit, an undo, or a move of the cursor."""
        return replace(self, text=text, row=row)

    def data(self) -> bytes:
        """Return the file's content; unedited lines are the same byte for byte."""
        return self.text.data

    def saved(self, file: FileState, written: Self) -> Self:
        """Return the document after it, or an earlier state of it, was written to a file."""
        return replace(self, file=file, text=self.text.saved_as(written.text))

    def restored(self, journal: Journal) -> Self:
        """Return the work of a journal; if undoing it leads back to this text, nothing is unsaved there."""
        assert isinstance(journal.work, NcText)
        work = replace(journal.work, origin=self.text.origin)
        if self.file.stamp is not None:
            work = work.known_in(self.text)
        row = journal.place[0] if journal.place else work.past[-1].at if work.past else 0
        return replace(self, text=work, row=row if isinstance(row, int) else 0)

    def holds(self, journal: Journal) -> bool:
        """True if these are already the journal's lines."""
        return isinstance(journal.work, NcText) and "".join(journal.work.lines) == "".join(self.text.lines)


Document = ContourDocument | NcDocument
"""A document of either kind; it is a value, and every edit makes a new one."""
AnyDocument = TypeVar("AnyDocument", ContourDocument, NcDocument)

MAX_BYTES: Final = {Kind.CONTOUR: MAX_PROGRAM_BYTES, Kind.NC: MAX_NC_BYTES}
"""The size of the largest file of each kind in bytes."""
