"""This module builds the questions about files that an operator is asked: title, lines and answers.

Every question also has the answer GO BACK, which changes nothing.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.documents import times
from app.documents.document import ContourDocument, Document
from app.documents.journal import Journal, Kind
from app.documents.lock import Owner
from app.documents.paths import folder, is_outside_folder, printable_path
from app.documents.unsaved_work import UNNAMED_PROGRAM, UnreadableWork
from core.units import printable

GO_BACK: Final = "GO BACK"
SAVE: Final = "SAVE"
DISCARD: Final = "DISCARD"
RESTORE: Final = "RESTORE"
NOT_MINE: Final = "LEAVE IT"
GO_ON: Final = "CONTINUE"
LOOK: Final = "LOOK"
TAKE_OVER: Final = "TAKE OVER"
REPLACE: Final = "REPLACE"
WRITE_THERE: Final = "WRITE THERE"
WRITE_ANYWAY: Final = "OVERWRITE"
KEEP_BOTH: Final = "KEEP BOTH"
YOURS: Final = "YOURS"
THEIRS: Final = "THEIRS"
FILE_AS_IT_IS: Final = "FILE AS IT IS"
ADD: Final = "ADD"
NEW_PROGRAM: Final = "NEW PROGRAM"


@dataclass(frozen=True, slots=True)
class Answer:
    """An answer: its word, whose first letter is its key, and what it does."""

    word: str
    effect: str = ""


@dataclass(frozen=True, slots=True)
class QuestionText:
    """A question: its title, the lines (what would be lost first), the answers, the word of the preselected one."""

    title: str
    lines: tuple[str, ...]
    answers: tuple[Answer, ...]
    safe: str = GO_BACK


# ---- names


def name_of(document: Document) -> str:
    """Return the name of a document in a sentence."""
    path = document.file.path
    if path is not None:
        return printable(path.name)
    return "The NC text" if document.kind is Kind.NC else "This program"


def person(owner: Owner) -> str:
    """Return a person's name in a sentence: the user, and the host if it is known."""
    return f"{printable(owner.user)}{f' on {printable(owner.host)}' if owner.host else ''}"


def held_sentence(owner: Owner, today: str) -> str:
    """Return the sentence that says who has a document open, and since when."""
    since = f" since {times.in_words(owner.since, today)}" if owner.since else ""
    return f"{person(owner)} has had this program open{since}."


def whole_name(path: Path) -> str:
    """Return a file's full name without control characters."""
    return printable_path(path.name)


# ---- before an import


def into_which(drawing: Path, document: Document) -> QuestionText:
    """Ask whether a drawing's contours go into the open program."""
    lines = (f"Contours of {printable(drawing.name)}:",)
    name = "the open program" if document.file.path is None else name_of(document)
    answers = (Answer(ADD, f"after the blocks of {name}"), Answer(NEW_PROGRAM, "of this drawing only"))
    return QuestionText("INTO WHICH PROGRAM?", lines, answers, safe=ADD)


# ---- before leaving


def leaving(title: str, documents: Sequence[Document], half_typed: str = "") -> QuestionText | None:
    """Ask before documents are closed, listing those with unsaved changes; None if all are saved.

    `half_typed` is the sentence on text that would be lost too.
    """
    unsaved = [document for document in documents if document.unsaved]
    if not unsaved and not half_typed:
        return None
    lines = tuple(map(_unsaved_sentence, unsaved)) + ((half_typed,) if half_typed else ())
    answers = (Answer(DISCARD, "the changes are lost"), Answer(SAVE, "then go on"))
    return QuestionText(title, lines, answers)


def _unsaved_sentence(document: Document) -> str:
    if document.file.path is not None:
        return f"{name_of(document)} has changes that are not saved."
    title = document.title if isinstance(document, ContourDocument) else ""
    return f"{title or name_of(document)} was never saved."


# ---- before a file is written


def before_writing(path: Path, file: Path | None, holder: Owner | None = None) -> QuestionText | None:
    """Ask before anything is written into another folder or over an existing file; None if neither.

    The lines say what would be replaced; `holder` has the file open.
    """
    target = Path(os.path.realpath(path))
    replaced = ["Its content is replaced." if target.exists() else "It leads nowhere."]
    replaced += [] if holder is None else [f"{person(holder)} has it open."]
    if is_outside_folder(path, file):
        whose = "current" if file is None else "program's"
        lines = [f"{printable_path(target)} is not in the {whose} folder,", f"{printable_path(folder(file))}."]
        lines += [f"{printable_path(path)} leads there."] if path.is_symlink() else []
        lines += replaced if target.exists() else []
        return QuestionText("WRITE IN ANOTHER FOLDER?", tuple(lines), (Answer(WRITE_THERE),))
    if os.path.lexists(path):
        where = f", which leads to {printable_path(target)}" if path.is_symlink() else ""
        first, *rest = replaced
        lines = [f"{printable_path(path)}{where} exists. {first}", *rest]
        return QuestionText("REPLACE THE FILE?", tuple(lines), (Answer(REPLACE),))
    return None


def write_through_link(path: Path) -> QuestionText:
    """Ask before a document's own file is written if it is a link into another folder."""
    target = printable_path(os.path.realpath(path))
    line = f"{printable_path(path)} is a link to {target} in another folder."
    return QuestionText("WRITE IN ANOTHER FOLDER?", (line,), (Answer(WRITE_THERE),))


def taken_over(path: Path, owner: Owner, copy: Path) -> QuestionText:
    """Ask before saving a document that somebody has taken over since it was opened."""
    lines = (f"{person(owner)} has taken {printable(path.name)} over.",)
    answers = (
        Answer(KEEP_BOTH, f"yours is saved as {whole_name(copy)}"),
        Answer(WRITE_ANYWAY, "under this name; the other terminal is warned"),
    )
    return QuestionText("TAKEN OVER: SAVE ANYWAY?", lines, answers, safe=KEEP_BOTH)


def changed_meanwhile(document: Document, written: str, copy: Path, *, readable: bool) -> QuestionText:
    """Ask which version gets the name if the file differs from what was read; both versions are kept.

    `written` is when the file was changed, in words; `readable`: the file can be opened as a document of this kind.
    """
    name = name_of(document)
    if document.file.stamp is None and not readable:
        # perhaps nobody has changed it: it could not be read when it was opened either
        title, word, first = "REPLACE THE FILE?", FILE_AS_IT_IS, f"{name} cannot be read. It was written {written}."
    else:
        title, word, first = "CHANGED MEANWHILE", THEIRS, f"{name} was changed by somebody else, {written}."
        first += "" if readable else " It is no program any more."
    answers = (
        Answer(YOURS, "the other one is kept under another name"),
        Answer(word, f"yours is saved as {whole_name(copy)}"),
    )
    lines = (first, "Which one gets the name? Both are kept.")
    return QuestionText(title, lines, answers)


# ---- when a file is opened


def open_already(owner: Owner, today: str) -> QuestionText:
    """Ask before opening a document that somebody else has open."""
    lines = (held_sentence(owner, today),)
    answers = (
        Answer(LOOK, "nothing can be changed; SAVE AS makes a copy of your own"),
        Answer(TAKE_OVER, "the other terminal is warned before it saves"),
    )
    return QuestionText("OPEN ALREADY", lines, answers, safe=LOOK)


def unsaved_work(
    document: Document, journal: Journal, *, mine: bool, me: Owner, living: bool, chosen: bool, today: str
) -> QuestionText:
    """Ask whether to restore unsaved work; `chosen`: the operator picked it in the list of kept copies."""
    owner, path, now = journal.owner, document.file.path, document.file.stamp
    name = "No name" if path is None else printable(path.name)
    by = "" if (owner.user, owner.host) == (me.user, me.host) else f" by {person(owner)}"
    count = len(journal.work.past)
    lines = [f"{name}{by}, {times.in_words(journal.time, today)}, {count} edit{'' if count == 1 else 's'}."]
    if path is not None and now is None and os.path.lexists(path):
        lines.append(f"{printable(path.name)} itself cannot be read; it stays as it is.")
    elif path is not None and now is None and document.kind is Kind.NC:
        lines.append("The file is gone. Saving writes it again.")
    elif now is not None and not now.same_content(journal.stamp):
        lines.append("The file was written since: by somebody else, or by this program just before its end.")
    if living and owner != me:
        lines.append("The other terminal may still be in use. It is warned before it saves.")
    if not mine:
        lines.append(f"It stays kept for {printable(owner.user)}, whatever you answer.")
    if journal.damaged:
        lines.append("The end of it cannot be read and is kept as a backup.")
    if chosen:
        refusal = Answer(NOT_MINE, "it stays in the list")
    elif mine:
        refusal = Answer(DISCARD, "kept as a backup; Ctrl+O lists it")
    else:
        refusal = Answer(NOT_MINE, "it stays kept for its owner")
    return QuestionText("UNSAVED WORK FOUND", tuple(lines), (Answer(RESTORE), refusal), safe=RESTORE)


def unreadable_work(document: Document, path: Path, left: UnreadableWork, today: str) -> QuestionText:
    """Report unsaved work that cannot be read, so that nobody overlooks it."""
    who, when = printable(left.user), times.in_words(left.time, today)
    name = UNNAMED_PROGRAM if document.file.path is None else printable(document.file.path.name)
    if left.what:
        lines = [f"In place of the unsaved work on {name} there is {left.what}."]
    elif left.hidden:
        lines = [f"{who} has unsaved work on {name}, {when}. You may not read it."]
        lines.append(f"It is kept, and {who} is asked about it at the next start on this program.")
    elif left.owner is not None:
        lines = [f"Another version of cutcomp wrote unsaved work on {name}, {when}."]
        lines.append("Only that version can read it. It is kept.")
    else:
        lines = [f"Unsaved work on {name}, {when}, is damaged and cannot be read.", "It is kept."]
    beside = document.file.path is not None and folder(document.file.path) == folder(path)
    lines.append(f"The file is {whole_name(path) if beside else printable_path(path)}.")
    answers = [Answer(GO_ON, "without it")]
    if left.ours and not left.hidden:
        answers.append(Answer(DISCARD, "kept as a backup; Ctrl+O lists it"))
    title = "UNSAVED WORK FOUND" if left.hidden or left.owner is not None else "UNSAVED WORK IS DAMAGED"
    return QuestionText(title, tuple(lines), tuple(answers), GO_ON)
