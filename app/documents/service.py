"""The document service: opens documents, keeps every edit on the disk, saves, locks, takes over, offers what was left.

It knows no screen.  What an operator must be asked comes back as an `Ask`, what went wrong as a sentence.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final, Generic

from app.documents import questions, times
from app.documents.document import MAX_BYTES, AnyDocument, ContourDocument, Document, FileState, NcDocument
from app.documents.files import holds_program, load, read_file, refuse_program, stamp_of, stamp_of_data, why, write_data
from app.documents.interrupted import interrupted_saves
from app.documents.journal import Head, Journal, Kind, beginning, continuing
from app.documents.journal_file import SUFFIX, JournalFile, journal_path, new_path, set_aside, why_aside
from app.documents.left_overs import (
    Unreadable,
    elsewhere,
    journal_place,
    left_by_dead,
    left_of,
    new_journal,
    of_user,
    read,
    state_folder,
    unreadable,
    wants_answer,
)
from app.documents.lock import Lock, Owner, alive, held_by, myself, release, take, take_over, taken_by
from app.documents.paths import as_program, chosen, folder, is_folder, outside, printable_path, short_path, written_at
from app.documents.patience import FILE, within
from app.documents.programs import empty_program, example, examples
from app.documents.questions import GO_BACK, Ask, held_sentence, name_of, whole_name
from core.program.file.read import StoreError
from core.program.model import unread_texts
from core.units import Unit, printable

TEMPORARY: Final = ".tmp"
"""The end of the name of what an interrupted save leaves."""
MAX_JOURNAL_GROWTH: Final = {Kind.CONTOUR: 8_000_000, Kind.NC: 64_000_000}
"""Bytes of a journal that is not saved for very long; then it is begun anew with all work as it is."""


# ---- what comes back


@dataclass(frozen=True, slots=True)
class Notice:
    """A sentence for the prompt line."""

    text: str
    warning: bool = False


@dataclass(frozen=True, slots=True)
class Trouble:
    """Why nothing was done, as a sentence; `open_already` is the document that is open under this name here."""

    text: str
    open_already: Document | None = None


@dataclass(frozen=True, slots=True)
class Offer:
    """A question about a document that was opened; `left` is the work that it is about, at `path`."""

    ask: Ask
    path: Path | None = None
    left: Journal | Unreadable | None = None
    answered: frozenset[Path] = frozenset()


@dataclass(frozen=True, slots=True)
class Opened(Generic[AnyDocument]):
    """A document, what there is to say about it, and the next question, if there is one."""

    document: AnyDocument
    notice: Notice | None = None
    offer: Offer | None = None


@dataclass(frozen=True, slots=True)
class Saved(Generic[AnyDocument]):
    """A document that was written; `notice` says where, and what could not be kept."""

    document: AnyDocument
    notice: Notice


# ---- the service


@dataclass(slots=True)
class _Kept:
    """What is kept of one opening: the document as it was kept last, its journal, its lock.

    `whole` says that the journal must be begun anew; `failing` that the last edit is not on the disk; `warned` that
    somebody has taken the document over; `away` that the operator knows of a journal that is not beside its file.
    `copy` is the name under which a question would save.
    """

    known: Document
    journal: JournalFile | None = None
    lock: Lock | None = None
    whole: bool = False
    failing: bool = False
    warned: bool = False
    away: bool = False
    copy: Path | None = None


@dataclass(slots=True)
class DocumentService:
    """The documents that this process has open, each by its opening.

    `state` is this person's folder for journals that cannot be beside their file.
    """

    me: Owner = field(default_factory=lambda: myself(times.now()))
    state: Path = field(default_factory=state_folder)
    clock: Callable[[], str] = times.now
    _open: dict[object, _Kept] = field(default_factory=dict)

    def _from_now(self) -> Owner:
        """This process as the owner of a file that it opens now."""
        return replace(self.me, since=self.clock())

    # ---- open

    def new(self, unit: Unit = Unit.IN, *, offers: bool = False) -> Opened[ContourDocument]:
        """A new program without a name; `offers` asks about work without a name that was left, as at a start."""
        document = ContourDocument.of(empty_program(unit))
        self._open[document.file.opening] = _Kept(document)
        return self._next_offer(document) if offers else Opened(document)

    def example(self, name: str) -> Opened[ContourDocument]:
        """An example: it is nobody's to overwrite, and has no file until it is saved under a name."""
        document = ContourDocument.of(load(example(name)), title=name)
        self._open[document.file.opening] = _Kept(document)
        return Opened(document, Notice(f"Example {name}: SAVE gives it a name."))

    def open(self, path: Path, *, kept_copy: Path | None = None) -> Opened[Any] | Trouble:
        """The document of a file, whichever kind it is; a program that does not exist yet is a new one.

        `kept_copy` is a journal that was set aside, whose work is offered first.
        """
        if path.parent == examples():
            return self.example(path.stem)
        if _real_path(path) is None:
            return Trouble(f"{short_path(path)} cannot be opened: that is not a file name. Choose another.")
        if (kept := self._standing(path)) is not None:
            return Trouble(f"{printable(path.name)} is open already.", kept.known)
        try:
            document = within(FILE, lambda: self._read(path, kept_copy))
        except TimeoutError as error:
            return Trouble(f"{short_path(path)} cannot be opened: {error}.")
        except OSError as error:
            return Trouble(f"{short_path(path)} cannot be opened: {why(error)}")
        except StoreError as error:
            return Trouble(error.text)
        new = document.file.stamp is None and not os.path.lexists(path) and kept_copy is None
        word = f"{short_path(path)} does not exist yet: saving makes it." if new else f"Opened: {short_path(path)}"
        return self._begun(document, Notice(word), kept_copy)

    def copy_without_name(self, kept_copy: Path) -> Opened[ContourDocument]:
        """A new program in which the work of a kept copy that has no name is offered."""
        return self._begun(ContourDocument.of(empty_program()), None, kept_copy)

    def _standing(self, path: Path) -> _Kept | None:
        """What is open here under this name, or under another name of the same file."""
        real = _real_path(path)
        if real is None:
            return None
        return next((kept for kept in self._open.values() if _real_path(kept.known.file.path) == real), None)

    def changed(self, document: Document) -> bool:
        """Whether the file of a document is another than it was when it was read or saved last."""
        path, then = document.file.path, document.file.stamp
        now = None if path is None else stamp_of(path, MAX_BYTES[document.kind])
        return (now is None) is not (then is None) or not (now is None or then is None or now.same_content(then))

    def _read(self, path: Path, kept_copy: Path | None) -> Document:
        """The document of a file, or an empty one where only work on it was left; StoreError for neither."""
        named = FileState(path)
        program = path.suffix.lower() == ".toml"
        try:
            data, status = read_file(path, MAX_BYTES[Kind.NC])
        except FileNotFoundError as error:
            if kept_copy is not None and not program:
                return NcDocument(file=named)
            if kept_copy is not None or (program and path.parent.is_dir() and not path.is_symlink()):
                return ContourDocument.of(empty_program(), named)
            raise StoreError(f"{short_path(path)} cannot be opened: {why(error)}") from error
        except (OSError, ValueError) as error:
            trouble = StoreError(f"{short_path(path)} cannot be opened: {why(error)}")
            trouble.__cause__ = error
            return self._rescued(named, trouble, kept_copy)
        if not program and not holds_program(data):
            return NcDocument.read(data, replace(named, stamp=stamp_of_data(data, status.st_mtime_ns)))
        if len(data) > MAX_BYTES[Kind.CONTOUR]:
            raise StoreError(f"{short_path(path)} is too large for a program file. Choose another file.")
        try:
            return ContourDocument.read(data, replace(named, stamp=stamp_of_data(data, status.st_mtime_ns)))
        except StoreError as error:
            return self._rescued(named, error, kept_copy)

    def _rescued(self, file: FileState, error: StoreError, kept_copy: Path | None) -> ContourDocument:
        """An empty program in the place of a file that cannot be read, on which work that was left will be offered.

        It has no stamp: whoever saves it is asked, and what stands in the file is kept beside it.
        """
        assert file.path is not None
        wanted = None if kept_copy is None else read(kept_copy, Kind.CONTOUR)
        left = (journal for _, journal in left_by_dead(file.path, Kind.CONTOUR, self.state, self.me.user))
        empty = ContourDocument.of(empty_program(), file)
        saves = (save.journal(empty, self.me.user) for save in interrupted_saves(file.path, Kind.CONTOUR))
        journal = wanted or next(left, None) or next(filter(None, saves), None)
        if journal is None:
            raise error
        program = empty.restored(journal).program
        return ContourDocument.of(empty_program(program.unit), file)

    def _begun(self, document: AnyDocument, notice: Notice | None, kept_copy: Path | None) -> Opened[AnyDocument]:
        kept = self._open[document.file.opening] = _Kept(document)
        holder = self._lock(kept)
        if holder is not None:
            document = self._put(kept, replace(document, file=replace(document.file, holder=holder)))
            return Opened(document, notice, Offer(questions.open_already(holder, self.clock()), kept_copy))
        opened = self._next_offer(document, kept_copy)
        return replace(opened, notice=opened.notice or notice)

    def _put(self, kept: _Kept, document: AnyDocument) -> AnyDocument:
        kept.known = document
        return document

    def _lock(self, kept: _Kept) -> Owner | None:
        """Lock the file; who has it, if somebody else does.  Where no lock can be written, nothing can be saved."""
        kept.lock, path = None, kept.known.file.path
        if path is None:
            return None
        with suppress(OSError):
            lock = take(path, self._from_now())
            if isinstance(lock, Owner):
                return lock
            kept.lock = lock
            # what a program that was killed has not put in its place
            new_path(journal_path(path)).unlink(missing_ok=True)
        return None

    # ---- offers

    def answer(self, document: AnyDocument, offer: Offer, word: str) -> Opened[AnyDocument]:
        """What comes of the answer to an offer; GO BACK changes nothing, and it is asked again at the next start."""
        kept = self._open[document.file.opening]
        match word, offer.path, offer.left:
            case questions.TAKE_OVER, path, _:
                return self._take_over(kept, document, path)
            case questions.RESTORE, Path() as path, Journal() as journal:
                return self._restore(kept, document, path, journal)
            case questions.DISCARD, Path() as path, left if left is not None:
                return self._discard(document, path, left, offer.answered)
            case questions.NOT_MINE, Path() as path, Journal() as journal if wants_answer(path):
                return self._leave_to_owner(document, path, journal, offer.answered)
            case _, Path() as path, left if left is not None and word != GO_BACK:
                return self._next_offer(document, answered=offer.answered | {path})
            case _:
                return Opened(document)

    def _next_offer(
        self,
        document: AnyDocument,
        kept_copy: Path | None = None,
        answered: frozenset[Path] = frozenset(),
        notice: Notice | None = None,
    ) -> Opened[AnyDocument]:
        """The next question about work that was left; a journal that holds nothing new is removed.

        Of what is kept for somebody else, and of what was answered, nothing is asked; a notice tells of it.
        """
        for_others: list[str] = []
        # before a journal is answered: what it holds too is not asked about twice
        interrupted = tuple(self._interrupted(document))
        for path, left in self._left(document, kept_copy):
            if path in answered:
                continue
            ask = self._question(document, path, left, chosen=path == kept_copy)
            if isinstance(ask, str):
                for_others.append(ask)
            elif ask is not None:
                return Opened(document, notice, Offer(ask, path, left, answered))
        for path, journal in interrupted:
            if path not in answered:
                ask = questions.unsaved_work(
                    document, journal, mine=True, me=self.me, living=False, chosen=False, today=self.clock()
                )
                return Opened(document, notice, Offer(ask, path, journal, answered))
        return Opened(document, notice or (Notice(" ".join(for_others), warning=True) if for_others else None))

    def _interrupted(self, document: Document) -> Iterator[tuple[Path, Journal]]:
        """What an interrupted save has left and is nowhere else; the rest of such content is removed."""
        if document.file.path is None or document.file.holder is not None:
            return
        saves = tuple(interrupted_saves(document.file.path, document.kind))
        journals = [left for _, left in self._left(document, None) if isinstance(left, Journal)] if saves else []
        for save in saves:
            journal = save.journal(document, self.me.user)
            kept = [document.data(), *(document.restored(other).data() for other in journals)]
            if journal is None or save.data in kept:
                with suppress(OSError):
                    save.path.unlink()
            else:
                yield save.path, journal

    def _left(self, document: Document, kept_copy: Path | None) -> Iterator[tuple[Path, Journal | Unreadable]]:
        """What may be asked about; a copy that was chosen comes first."""
        if kept_copy is not None and (copy := read(kept_copy, document.kind) or unreadable(kept_copy)) is not None:
            yield kept_copy, copy
        for path, left in left_of(document.file.path, document.kind, self.state):
            if path != kept_copy:
                yield path, left

    def _question(
        self, document: Document, path: Path, left: Journal | Unreadable, *, chosen: bool
    ) -> Ask | str | None:
        """The question about work that was left, a sentence for those who are not asked, None where nothing is new."""
        today = self.clock()
        if isinstance(left, Unreadable):
            if why_aside(path) and not left.ours:
                return _kept_for(left.user, left.time, path, today)
            return questions.unreadable_work(document, path, left, today)
        living, mine = alive(left.head.owner), self._mine(path, left)
        if document.holds(left) and not left.damaged and not chosen:
            if not living:
                with suppress(OSError):
                    path.unlink()
            return None
        if not chosen and why_aside(path) and not mine:
            return _kept_for(left.head.owner.user, left.time, path, today)
        copy = chosen and not wants_answer(path)
        return questions.unsaved_work(document, left, mine=mine, me=self.me, living=living, chosen=copy, today=today)

    def _mine(self, path: Path, journal: Journal) -> bool:
        return of_user(journal.head.owner, path, self.state, self.me.user)

    def _take_over(self, kept: _Kept, document: AnyDocument, kept_copy: Path | None) -> Opened[AnyDocument]:
        """The file read again and locked by us."""
        path = document.file.path
        assert path is not None
        try:
            fresh = self._read(path, kept_copy)
            lock = take_over(path, self._from_now())
        except (OSError, StoreError) as error:
            return Opened(document, Notice(f"It cannot be taken over: {_reason(error)}", warning=True))
        if not isinstance(fresh, type(document)):
            return Opened(document, Notice("It cannot be taken over: the file is of another kind now.", warning=True))
        kept.lock = lock
        state = replace(fresh.file, opening=document.file.opening)
        taken = self._put(kept, replace(fresh, file=state))
        opened = self._next_offer(taken, kept_copy)
        notice = opened.notice or Notice(f"{name_of(taken)} is yours now.")
        return Opened(opened.document, notice, opened.offer)

    def _restore(self, kept: _Kept, document: AnyDocument, path: Path, journal: Journal) -> Opened[AnyDocument]:
        """The work as it was, with its undo; its journal begins anew with all of it."""
        now = document.file
        stamp = journal.head.stamp if now.stamp is not None else None
        work = document.restored(journal)
        work = self._put(kept, replace(work, file=replace(now, stamp=stamp)))
        try:
            aside = self._journal_of_restored(kept, work, path, journal)
        except (OSError, StoreError) as error:
            kept.journal = None
            return Opened(work, Notice(f"Restored. Not on disk: {_reason(error)}", warning=True))
        copy = f"{whole_name(aside)} stays; Ctrl+O lists it. " if aside is not None else ""
        return Opened(work, Notice(f"{copy}Your work is back. Ctrl+Z undoes it step by step, Ctrl+S saves it."))

    def _journal_of_restored(self, kept: _Kept, work: Document, path: Path, journal: Journal) -> Path | None:
        """A journal with all of it.  That of this user's own program that died goes; what stays aside is given back."""
        mine, living = self._mine(path, journal), alive(journal.head.owner)
        replaced = mine and not living and wants_answer(path) and not journal.damaged
        place, aside = journal_place(work.file.path, self.me, self.state), None
        if replaced and path == place:
            kept.journal = new_journal(path, work.file.path)
            kept.journal.replace(self._everything(work))
            return None
        if journal.damaged and mine and not living and wants_answer(path):
            aside = set_aside(path, "damaged") if path.exists() else None
        elif not replaced and path.exists():
            aside = self._out_of_the_way(path, journal)
        self._begin(kept, work)
        if replaced:
            # all of it is in the new journal
            path.unlink(missing_ok=True)
        return aside

    def _out_of_the_way(self, path: Path, journal: Journal) -> Path:
        """Make room without taking it from whoever typed it: he is asked still, if more is typed by the same user."""
        if why_aside(path):
            return path
        try:
            if not self._mine(path, journal):
                return set_aside(path, "kept")
            if alive(journal.head.owner):
                return set_aside(path, f"theirs-{times.stamp(self.clock())}-at-{path.stat().st_size}")
            return set_aside(path, "discarded")
        except PermissionError:
            # in its folder nothing may be renamed: it stays, and the next journal is elsewhere
            return path

    def _discard(
        self, document: AnyDocument, path: Path, left: Journal | Unreadable, answered: frozenset[Path]
    ) -> Opened[AnyDocument]:
        """The saved document; the work is kept under a name that is not offered again."""
        aside = path
        try:
            if isinstance(left, Journal) and path.suffix == TEMPORARY:
                aside = self._copy_of_save(document, path, left)
            elif isinstance(left, Journal) and alive(left.head.owner):
                aside = self._out_of_the_way(path, left)
            else:
                aside = set_aside(path, "discarded")
            notice = Notice(f"Kept as a backup in {whole_name(aside)}; Ctrl+O lists it.")
        except FileNotFoundError:
            gone = "Nothing is left to discard: whoever typed it has saved it or discarded it meanwhile."
            notice = Notice(f"{gone} Ctrl+O opens the file as it is now.", warning=True)
        except OSError as error:
            notice = Notice(f"The unsaved work cannot be renamed: {why(error)}", warning=True)
        return self._next_offer(document, answered=answered | {path, aside}, notice=notice)

    def _copy_of_save(self, document: Document, path: Path, journal: Journal) -> Path:
        """What an interrupted save has left, as a journal among the kept copies."""
        work, file = document.restored(journal), document.file.path
        copy = new_journal(journal_place(file, self.me, self.state).with_suffix(f"{SUFFIX}.saved"), file)
        copy.add(self._everything(work))
        copy.close()
        path.unlink()
        return set_aside(copy.path, "discarded")

    def _leave_to_owner(
        self, document: AnyDocument, path: Path, journal: Journal, answered: frozenset[Path]
    ) -> Opened[AnyDocument]:
        """The document without the work, which stays kept for whoever typed it."""
        aside = path
        try:
            aside = self._out_of_the_way(path, journal)
            notice = Notice(f"Kept for {printable(journal.head.owner.user)}: {whole_name(aside)}; Ctrl+O lists it.")
        except FileNotFoundError:
            notice = Notice("It was saved or discarded meanwhile. Ctrl+O opens the file as it is now.", warning=True)
        except OSError as error:
            notice = Notice(f"The unsaved work cannot be renamed: {why(error)}", warning=True)
        return self._next_offer(document, answered=answered | {path, aside}, notice=notice)

    # ---- keep

    def keep(self, document: Document) -> Notice | None:
        """Put on the disk what was edited since the last time; call it before the next key is read."""
        closed = document.file.opening not in self._open
        kept = self._open.setdefault(document.file.opening, _Kept(document))
        known, kept.known = kept.known, document
        if closed and document.unsaved:
            # edited behind its closing, which waited for the disk: it is open again, with all of its work
            self._lock(kept)
        elif document.same_edits(known):
            return None
        try:
            gone = self._write(kept, known, document)
        except (OSError, StoreError) as error:
            kept.failing = True
            return Notice(f"Not on disk: {_reason(error)} SAVE AS (Ctrl+K) saves elsewhere.", warning=True)
        was_failing, kept.failing = kept.failing, False
        return (
            self._taken_notice(kept)
            or self._place_notice(kept, gone=gone)
            or (Notice("Work is kept on the disk again.") if was_failing else None)
        )

    def _write(self, kept: _Kept, known: Document, document: Document) -> bool:
        """On the disk: beside the file, else in this person's own folder.  Whether the journal was gone before."""
        gone = kept.journal is not None and kept.journal.lost()
        if gone and kept.journal is not None:
            kept.journal.close()
            kept.journal = None
        try:
            if kept.journal is None:
                self._begin(kept, document)
            else:
                self._continue(kept, kept.journal, known, document)
        except (OSError, StoreError):
            if not self._begin_elsewhere(kept, document):
                raise
        kept.whole = False
        return gone

    def _continue(self, kept: _Kept, journal: JournalFile, known: Document, document: Document) -> None:
        records = None if kept.whole else document.records_since(known)
        if records is not None and journal.length <= MAX_JOURNAL_GROWTH[document.kind]:
            journal.add(continuing(records, document.place, self.clock()))
            return
        kept.whole = True
        journal.replace(self._everything(document))

    def _everything(self, document: Document) -> Iterator[Any]:
        """All work as the lines of a journal."""
        return beginning(document.kind, self._head(document), document.whole_records(), document.place, self.clock())

    def _head(self, document: Document) -> Head:
        path = document.file.path
        return Head(self.me, None if path is None else str(path.absolute()), document.file.stamp)

    def _begin(self, kept: _Kept, document: Document) -> None:
        """A journal with all work, beside the file if that can be; OSError where it can be nowhere."""
        path = document.file.path
        kept.journal = new_journal(journal_place(path, self.me, self.state), path)
        try:
            kept.journal.add(self._everything(document))
        except OSError:
            if not self._begin_elsewhere(kept, document):
                raise

    def _begin_elsewhere(self, kept: _Kept, document: Document) -> bool:
        """Put all work into this person's own folder; only when it is there its place beside is given up."""
        path = document.file.path
        if path is None or (kept.journal is not None and kept.journal.path.parent == self.state):
            return False
        try:
            other = new_journal(elsewhere(path, self.state), path)
            other.add(self._everything(document))
        except OSError:
            return False
        if kept.journal is not None:
            kept.journal.remove()
        kept.journal = other
        return True

    def _place_notice(self, kept: _Kept, *, gone: bool) -> Notice | None:
        """Say where the work is kept if not beside its file, that it was gone, and what was moved aside for it."""
        journal, path = kept.journal, kept.known.file.path
        if journal is None:
            return None
        aside, journal.aside = journal.aside, None
        sentences = []
        if gone:
            sentences.append(
                f"The journal of unsaved work was gone: all of it is in {printable_path(journal.path)} now."
            )
        elif path is not None and journal.path.parent == self.state and not kept.away:
            place = printable_path(str(journal.path.parent))
            sentences.append(f"The folder of {printable(path.name)} takes nothing: unsaved work is kept in {place}")
        kept.away = kept.away or journal.path.parent == self.state
        if aside is not None:
            sentences.append(f"{whole_name(aside)} holds what was left before; Ctrl+O lists it.")
        return Notice(" ".join(sentences), warning=True) if sentences else None

    def _taken_notice(self, kept: _Kept) -> Notice | None:
        """Say once that somebody has taken the document over."""
        owner = None if kept.lock is None or kept.warned else taken_by(kept.lock)
        if owner is None:
            return None
        kept.warned = True
        return Notice(f"{held_sentence(owner, self.clock())} SAVE AS (Ctrl+K) keeps your work.", warning=True)

    # ---- save

    def save(
        self, document: AnyDocument, path: Path | None = None, agreed: frozenset[str] = frozenset()
    ) -> Saved[AnyDocument] | Ask | Trouble:
        """Write a document to its own file or to another; `agreed` holds the answers to what was asked before.

        Ask again with the answer among `agreed`, until there is nothing to ask.
        """
        try:
            return self._save(document, path, agreed)
        except OSError as error:
            # such as that the current folder is gone
            return Trouble(f"{name_of(document)} is not saved: {why(error)}")

    def _save(
        self, document: AnyDocument, path: Path | None, agreed: frozenset[str]
    ) -> Saved[AnyDocument] | Ask | Trouble:
        kept, file = self._open[document.file.opening], document.file.path
        if path is None and file is None:
            return Trouble(f"{name_of(document)} has no name yet. SAVE AS (Ctrl+K) gives it one.")
        target = file if path is None else chosen(path, file)
        assert target is not None
        if document.kind is Kind.CONTOUR and target != file:
            target = as_program(target)
        if (trouble := self._refused(document, target)) is not None:
            return trouble
        if target != file:
            ask = None if agreed else self._before_another_file(document, target)
            return ask or self._written(kept, document, target, None)
        return self._save_own(kept, document, target, agreed)

    def _refused(self, document: Document, target: Path) -> Trouble | None:
        """Why a file is not written, whatever the operator answers."""
        name, holder = short_path(target), document.file.holder
        if _real_path(target) is None:
            return Trouble(f"{name} is not saved: that is not a file name. Choose another.")
        if is_folder(target):
            return Trouble(f"{name} is not saved: this is a folder. Type a file's name.")
        if holder is not None and target == document.file.path:
            return Trouble(f"{held_sentence(holder, self.clock())} SAVE AS (Ctrl+K) saves your own copy.")
        standing = self._standing(target)
        if standing is not None and standing.known.file.opening is not document.file.opening:
            return Trouble(f"{printable(target.name)} is open here, too. Type another name.", standing.known)
        try:
            if document.kind is Kind.NC:
                refuse_program(target)
        except StoreError as error:
            return Trouble(error.text)
        return None

    def _before_another_file(self, document: Document, target: Path) -> Ask | None:
        if outside(target, document.file.path):
            return questions.write_outside(target, document.file.path, held_by(target))
        return questions.replace_file(target, held_by(target)) if os.path.lexists(target) else None

    def _save_own(
        self, kept: _Kept, document: AnyDocument, path: Path, agreed: frozenset[str]
    ) -> Saved[AnyDocument] | Ask | Trouble:
        """Save under the name that it has."""
        today = self.clock()
        if not agreed or kept.copy is None or os.path.lexists(kept.copy):
            kept.copy = free_copy_name(path, "mine", today)
        copy = kept.copy
        if {questions.KEEP_BOTH, questions.THEIRS, questions.FILE_AS_IT_IS} & agreed:
            return self._written(kept, document, copy, None)
        if _leads_elsewhere(path) and not document.file.link_agreed and questions.WRITE_THERE not in agreed:
            return questions.write_through_link(path)
        owner = None if kept.lock is None else taken_by(kept.lock)
        if owner is not None and questions.WRITE_ANYWAY not in agreed:
            return questions.taken_over(path, owner, copy)
        theirs = None
        if questions.YOURS in agreed:
            try:
                theirs = put_theirs_aside(path, MAX_BYTES[document.kind], today)
            except StoreError as error:
                return Trouble(error.text)
        elif (ask := self._changed(document, path, copy, today)) is not None:
            return ask
        return self._written(kept, document, path, theirs, link_agreed=questions.WRITE_THERE in agreed)

    def _changed(self, document: Document, path: Path, copy: Path, today: str) -> Ask | None:
        """The question where the file is not as it was read."""
        then = document.file.stamp
        try:
            data, status = read_file(path, MAX_BYTES[document.kind])
        except (OSError, ValueError):
            return None
        now = stamp_of_data(data, status.st_mtime_ns)
        if then is not None and now.same_content(then):
            return None
        written = times.in_words(times.of(now.changed), today)
        return questions.changed_meanwhile(document, written, copy, document.compared(data))

    def _written(
        self, kept: _Kept, document: AnyDocument, path: Path, theirs: Path | None, *, link_agreed: bool = False
    ) -> Saved[AnyDocument] | Trouble:
        try:
            data = document.data()
            in_place = write_data(path, data)
        except (StoreError, ValueError) as error:
            cause = error.__cause__ or error
            reason = why(cause) if isinstance(cause, OSError | ValueError) else str(error)
            return Trouble(f"{short_path(path)} is not saved: {reason} SAVE AS (Ctrl+K) saves elsewhere.")
        before = document.file
        agreed = (before.link_agreed and path == before.path) or (link_agreed and _leads_elsewhere(path))
        state = replace(before, path=path, stamp=stamp_of_data(data), link_agreed=agreed)
        saved = self._put(kept, document.saved(state))
        if kept.journal is not None:
            kept.journal.remove()
        kept.journal, kept.whole, kept.failing, kept.away = None, False, False, False
        if path != before.path:
            saved = self._moved(kept, saved)
        other = "" if theirs is None else f" The other version is in {whole_name(theirs)}."
        reason = f", in place: {in_place}" if in_place else ""
        return Saved(saved, Notice(f"Saved: {written_at(path)}{reason}{other}{_marked(saved)}"))

    def _moved(self, kept: _Kept, document: AnyDocument) -> AnyDocument:
        """Under another name there is another lock."""
        if kept.lock is not None:
            release(kept.lock)
        kept.warned = False
        holder = self._lock(kept)
        return self._put(kept, replace(document, file=replace(document.file, holder=holder)))

    # ---- leave

    def close(self, document: Document) -> None:
        """The document is saved or given up: neither journal nor lock of it stays."""
        kept = self._open.pop(document.file.opening, None)
        if kept is None:
            return
        if kept.journal is not None:
            kept.journal.remove()
        if kept.lock is not None:
            release(kept.lock)

    def stop(self) -> None:
        """The end, wanted or not: what is not saved stays in the journals."""
        for kept in self._open.values():
            if kept.journal is not None and kept.known.unsaved:
                self._last_try(kept, kept.journal)
            elif kept.journal is not None:
                kept.journal.remove()
            if kept.lock is not None:
                release(kept.lock)
        self._open.clear()

    def _last_try(self, kept: _Kept, journal: JournalFile) -> None:
        """What could not be written before may find room by now."""
        try:
            if kept.whole or journal.lost():
                self._begin(kept, kept.known)
            elif journal.unwritten:
                journal.add(())
        except OSError:
            self._begin_elsewhere(kept, kept.known)
        if kept.journal is not None:
            kept.journal.close()


def free_copy_name(path: Path, whose: str, today: str) -> Path:
    """A free name such as `part.mine-2025-03-04-140509.toml`."""
    name = f"{path.stem}.{whose}-{times.stamp(today)}"
    free, number = path.with_name(f"{name}{path.suffix}"), 1
    while os.path.lexists(free):
        number += 1
        free = path.with_name(f"{name}-{number}{path.suffix}")
    return free


def put_theirs_aside(path: Path, most: int, today: str) -> Path:
    """Copy what stands in the file to a name of its own, which is returned; StoreError if that fails."""
    aside = free_copy_name(path, "theirs", today)
    try:
        # whole or not at all: no half copy may pass for the other version
        write_data(aside, read_file(path, most)[0])
    except (OSError, StoreError) as error:
        cause = error if isinstance(error, OSError) else error.__cause__
        reason = why(cause) if isinstance(cause, OSError) else str(error)
        raise StoreError(f"Nothing is saved: the other version cannot be copied, {reason}") from error
    return aside


def _real_path(path: Path | None) -> str | None:
    """The path without links; None for none and for a name that no file can have."""
    try:
        return None if path is None else os.path.realpath(path)
    except ValueError:
        return None
    except OSError:
        # the current folder is gone
        return str(path)


def _leads_elsewhere(path: Path) -> bool:
    """Whether a name is a link into another folder."""
    return path.is_symlink() and Path(os.path.realpath(path)).parent != folder(path)


def _kept_for(user: str, time: str, path: Path, today: str) -> str:
    """A sentence for those who are not asked."""
    when = times.short(time, today)
    return f"Unsaved work of {printable(user)}, {when}, is kept in {whole_name(path)}; Ctrl+O lists it."


def _marked(document: Document) -> str:
    """Says that what cannot be used is in the file too."""
    if isinstance(document, ContourDocument) and any(unread_texts(document.program)):
        return ", what is marked ERR as it was typed."
    return ""


def _reason(error: OSError | StoreError) -> str:
    return why(error) if isinstance(error, OSError) else error.text
