"""This module opens, journals, saves and locks documents, and offers the unsaved work that earlier runs left behind.

It knows no screen.  A question for the operator comes back as a `QuestionText`, a failure as a sentence.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any, Final, Generic

from app.documents import files, paths, questions, times, unsaved_work
from app.documents.document import MAX_BYTES, AnyDocument, ContourDocument, Document, FileState, NcDocument
from app.documents.journal import Journal, Kind, beginning, continuing, records_between
from app.documents.journal_file import JournalFile, Record, journal_path, new_path, reason_set_aside, set_aside
from app.documents.lock import Lock, Owner, alive, held_by, myself, release, take, take_over, taken_by
from app.documents.programs import empty_program, example, examples
from app.documents.questions import GO_BACK, QuestionText, held_sentence, name_of, person, whole_name
from app.documents.time_limits import FILE_SECONDS, within
from app.documents.unsaved_work import UnreadableWork
from core.program.file.read import StoreError
from core.program.model import unread_texts
from core.units import Unit, printable

MAX_JOURNAL_GROWTH: Final = {Kind.CONTOUR: 8_000_000, Kind.NC: 64_000_000}
"""The length in bytes beyond which the journal of a document that stays unsaved is rewritten from its current work."""
SAVE_ELSEWHERE: Final = "SAVE AS (Ctrl+K) saves elsewhere."


# ---- what comes back


@dataclass(frozen=True, slots=True)
class Notice:
    """A sentence for the prompt line."""

    text: str
    warning: bool = False


@dataclass(frozen=True, slots=True)
class Trouble:
    """A sentence that says why nothing was done; `open_already` is the document that is already open here."""

    text: str
    open_already: Document | None = None


@dataclass(frozen=True, slots=True)
class Offer:
    """A question about an opened document; `left` is the unsaved work that it concerns, stored at `path`."""

    ask: QuestionText
    path: Path | None = None
    left: Journal | UnreadableWork | None = None


@dataclass(frozen=True, slots=True)
class Opened(Generic[AnyDocument]):
    """A document, a notice about it, and the next question, if there is one."""

    document: AnyDocument
    notice: Notice | None = None
    offer: Offer | None = None


@dataclass(frozen=True, slots=True)
class Saved(Generic[AnyDocument]):
    """A document that was written; `notice` says where, and what else the operator must know."""

    document: AnyDocument
    notice: Notice


# ---- the service


@dataclass(slots=True)
class _OpenDocument:
    """One open document as it was last kept, with its journal and its lock; `me` and `state` are the service's.

    `rewrite`: the journal must be rewritten from the current work.  `failing`: the last edit is not on disk.  `warned`:
    the operator knows that somebody has taken the document over.  `away`: the operator knows that the journal is not
    beside its file.  `copy` is the name that questions propose for a copy, `answered` the unsaved work that they were
    about.
    """

    latest: Document
    me: Owner
    state: Path
    journal: JournalFile | None = None
    lock: Lock | None = None
    rewrite: bool = False
    failing: bool = False
    warned: bool = False
    away: bool = False
    copy: Path | None = None
    answered: set[Path] = field(default_factory=set)

    # ---- the lock

    def take_lock(self, now: str) -> Owner | None:
        """Lock the file, or return who else has it; where no lock can be written, no save can be written either."""
        self.lock, path = None, self.latest.file.path
        if path is None:
            return None
        with suppress(OSError):
            lock = take(path, replace(self.me, since=now))
            if isinstance(lock, Owner):
                return lock
            self.lock = lock
            # a killed process may have left a new journal that it had not yet renamed
            new_path(journal_path(path)).unlink(missing_ok=True)
        return None

    def release_lock(self) -> None:
        if self.lock is not None:
            release(self.lock)

    def warning_of_owner(self, now: str) -> str:
        """Return once that somebody has taken the document over, empty otherwise."""
        owner = None if self.lock is None or self.warned else taken_by(self.lock)
        if owner is None:
            return ""
        self.warned = True
        return f"{held_sentence(owner, now)} SAVE AS (Ctrl+K) keeps your work."

    # ---- the journal

    def write(self, before: Document, now: str) -> bool:
        """Write the edits since `before` to the journal; return True if the old journal was gone.

        Raise OSError or StoreError if they cannot be written, neither beside the file nor in the user's folder.
        """
        journal, gone = self.journal, False
        if journal is not None and journal.lost():
            journal.close()
            # None until another one is begun: a journal without its first line could not be read
            self.journal = journal = None
            gone = True
        if journal is None:
            self.begin(now)
        else:
            try:
                records = None if self.rewrite else records_between(before.work, self.latest.work)
                self.rewrite = records is None or journal.length > MAX_JOURNAL_GROWTH[self.latest.kind]
                if records is None or self.rewrite:
                    journal.replace(self.all_records(now))
                else:
                    journal.add(continuing(records, self.latest.place, now))
            except (OSError, StoreError):
                if not self._begin_elsewhere(now):
                    raise
        self.rewrite = False
        return gone

    def all_records(self, now: str) -> Iterator[Record]:
        """Return all work as the records of a new journal."""
        document, path = self.latest, self.latest.file.path
        file = None if path is None else str(path.absolute())
        return beginning(Journal(self.me, file, document.file.stamp, document.work, document.place, now))

    def begin(self, now: str) -> None:
        """Begin a journal with all work, beside the file if possible, else elsewhere; raise OSError if both fail."""
        path = self.latest.file.path
        self.journal = unsaved_work.new_journal(unsaved_work.journal_place(path, self.me, self.state), path)
        try:
            self.journal.add(self.all_records(now))
        except OSError:
            if not self._begin_elsewhere(now):
                raise

    def _begin_elsewhere(self, now: str) -> bool:
        """Begin a journal with all work in the user's folder, then remove the one beside the file; False on failure."""
        path = self.latest.file.path
        if path is None or (self.journal is not None and self.journal.path.parent == self.state):
            return False
        try:
            other = unsaved_work.new_journal(unsaved_work.elsewhere(path, self.state), path)
            other.add(self.all_records(now))
        except OSError:
            return False
        self.drop_journal()
        self.journal = other
        return True

    def warning_of_journal(self, *, gone: bool) -> str:
        """Return that the journal was gone, that it is not beside its file, and what was moved aside for it."""
        journal, path = self.journal, self.latest.file.path
        if journal is None:
            return ""
        aside, journal.aside = journal.aside, None
        sentences = []
        if gone:
            sentences.append(
                f"The journal of unsaved work was gone: all of it is in {paths.printable_path(journal.path)} now."
            )
        elif path is not None and journal.path.parent == self.state and not self.away:
            place = paths.printable_path(str(journal.path.parent))
            sentences.append(f"The folder of {printable(path.name)} takes nothing: unsaved work is kept in {place}")
        self.away = self.away or journal.path.parent == self.state
        if aside is not None:
            sentences.append(f"{whole_name(aside)} holds what was left before; Ctrl+O lists it.")
        return " ".join(sentences)

    def drop_journal(self) -> None:
        """Remove the journal, if there is one: its work is saved or abandoned."""
        if self.journal is not None:
            self.journal.remove()
            self.journal = None

    def leave_journal(self, now: str) -> None:
        """Close the journal of unsaved work; try once more to write what failed before, as the disk may have room."""
        if self.journal is not None or self.failing:
            with suppress(OSError, StoreError):
                self.write(self.latest, now)
        if self.journal is not None:
            self.journal.close()


@dataclass(slots=True)
class DocumentService:
    """The documents that this process has open, by their `FileState.opening`.

    `state` is the user's folder for journals that cannot lie beside their file.
    """

    me: Owner = field(default_factory=lambda: myself(times.now()))
    state: Path = field(default_factory=unsaved_work.state_folder)
    clock: Callable[[], str] = times.now
    _open: dict[object, _OpenDocument] = field(default_factory=dict)

    def _entry(self, document: Document) -> _OpenDocument:
        return self._open.setdefault(document.file.opening, _OpenDocument(document, self.me, self.state))

    # ---- open

    def new(self, unit: Unit = Unit.IN, *, offers: bool = False) -> Opened[ContourDocument]:
        """Begin a program without a name; `offers` asks about unsaved work without a name, as at startup."""
        document = ContourDocument.of(empty_program(unit))
        self._entry(document)
        return self._next_offer(document) if offers else Opened(document)

    def example(self, name: str) -> Opened[ContourDocument]:
        """Open an example; SAVE cannot overwrite it, since it has no file until SAVE AS gives it a name."""
        document = ContourDocument.of(files.load(example(name)), title=name)
        self._entry(document)
        return Opened(document, Notice(f"Example {name}. Ctrl+S saves it under a name."))

    def open(self, path: Path, *, kept_copy: Path | None = None) -> Opened[Any] | Trouble:
        """Open a file of either kind; a contour program that does not exist yet begins empty.

        `kept_copy` is a journal that was set aside; its work is offered first.
        """
        if _real_path(path) is None:
            return Trouble(f"{paths.short_path(path)} cannot be opened: that is not a file name. Choose another.")
        if (entry := self._open_here(path)) is not None:
            return Trouble(f"{printable(path.name)} is open already.", entry.latest)
        try:
            if path.parent == examples():
                return self.example(path.stem)
            document = within(FILE_SECONDS, lambda: self._read(path, kept_copy))
        except OSError as error:
            return Trouble(f"{paths.short_path(path)} cannot be opened: {files.why(error)}")
        except StoreError as error:
            return Trouble(error.text)
        new = document.file.stamp is None and not os.path.lexists(path) and kept_copy is None
        name = paths.short_path(path)
        text = f"{name} does not exist yet: saving makes it." if new else f"Opened: {name}"
        return self._opened(document, Notice(text), kept_copy)

    def copy_without_name(self, kept_copy: Path) -> Opened[ContourDocument]:
        """Begin a new program and offer the work of a kept copy that has no file name."""
        return self._opened(ContourDocument.of(empty_program()), None, kept_copy)

    def _open_here(self, path: Path) -> _OpenDocument | None:
        """Return the document that is open here under this or another name of the same file, None if there is none."""
        real = _real_path(path)
        return next((entry for entry in self._open.values() if _real_path(entry.latest.file.path) == real), None)

    def changed(self, document: Document) -> bool:
        """True if a document's file differs from what was last read or saved."""
        path, then = document.file.path, document.file.stamp
        now = None if path is None else files.stamp_of(path, MAX_BYTES[document.kind])
        return not now.same_content(then) if now is not None else then is not None

    def _read(self, path: Path, kept_copy: Path | None) -> Document:
        """Read a file; return an empty document for a new file or for unsaved work alone, else raise StoreError."""
        named = FileState(path)
        program = path.suffix.lower() == ".toml"
        try:
            data, status = files.read_file(path, MAX_BYTES[Kind.NC])
        except FileNotFoundError as error:
            if kept_copy is not None and not program:
                return NcDocument(file=named)
            if kept_copy is not None or (program and path.parent.is_dir() and not path.is_symlink()):
                return ContourDocument.of(empty_program(), named)
            raise StoreError(f"{paths.short_path(path)} cannot be opened: {files.why(error)}") from error
        except (OSError, ValueError) as error:
            trouble = StoreError(f"{paths.short_path(path)} cannot be opened: {files.why(error)}")
            trouble.__cause__ = error
            return self._rescued(named, trouble, kept_copy)
        if not program and not files.holds_program(data):
            return NcDocument.read(data, replace(named, stamp=files.stamp_of_data(data, status.st_mtime_ns)))
        if len(data) > MAX_BYTES[Kind.CONTOUR]:
            raise StoreError(f"{paths.short_path(path)} is too large for a program file. Choose another file.")
        try:
            return ContourDocument.read(data, replace(named, stamp=files.stamp_of_data(data, status.st_mtime_ns)))
        except StoreError as error:
            return self._rescued(named, error, kept_copy)

    def _rescued(self, file: FileState, error: StoreError, kept_copy: Path | None) -> ContourDocument:
        """Return an empty program in place of an unreadable file if unsaved work on it exists, else raise `error`.

        It has no stamp, so a save asks first and can keep the file's content, unless not even its bytes can be read.
        """
        assert file.path is not None
        wanted = None if kept_copy is None else unsaved_work.read(kept_copy, Kind.CONTOUR)
        left = unsaved_work.work_of_dead_processes(file.path, self.state, self.me.user)
        journal = wanted or next(left, None)
        if journal is None:
            raise error
        program = ContourDocument.of(empty_program()).restored(journal).program
        return ContourDocument.of(empty_program(program.unit), file)

    def _opened(self, document: AnyDocument, notice: Notice | None, kept_copy: Path | None) -> Opened[AnyDocument]:
        entry = self._entry(document)
        holder = entry.take_lock(self.clock())
        if holder is not None:
            document = entry.latest = replace(document, file=replace(document.file, holder=holder))
            return Opened(document, notice, Offer(questions.open_already(holder, self.clock()), kept_copy))
        if document.file.path is not None and document.file.stamp is not None:
            files.remove_killed_saves(document.file.path)
        opened = self._next_offer(document, kept_copy)
        return replace(opened, notice=opened.notice or notice)

    # ---- offers

    def answer(self, document: AnyDocument, offer: Offer, word: str) -> Opened[AnyDocument]:
        """Apply the answer to an offer; GO BACK changes nothing, and the next start asks again."""
        entry = self._entry(document)
        match word, offer.path, offer.left:
            case questions.TAKE_OVER, path, _:
                return self._take_over(entry, document, path)
            case questions.RESTORE, Path() as path, Journal() as journal:
                return self._restore(entry, document, path, journal)
            case questions.DISCARD, Path() as path, left if left is not None:
                return self._put_away(document, path, left, "as a backup in")
            case questions.NOT_MINE, Path() as path, Journal() as journal if unsaved_work.wants_answer(path):
                return self._put_away(document, path, journal, f"for {printable(journal.owner.user)}:")
            case _, Path() as path, left if left is not None and word != GO_BACK:
                entry.answered.add(path)
                return self._next_offer(document)
            case _:
                return Opened(document)

    def _next_offer(
        self, document: AnyDocument, kept_copy: Path | None = None, notice: Notice | None = None
    ) -> Opened[AnyDocument]:
        """Return the document with the next question about unsaved work; remove journals that hold nothing new.

        Work that was answered or is kept for somebody else raises no question; a notice mentions the latter.
        """
        for_others: list[str] = []
        entry = self._entry(document)
        copy = None if kept_copy is None else unsaved_work.left_at(kept_copy, document.kind)
        chosen = [(kept_copy, copy)] if kept_copy is not None and copy is not None else []
        for path, left in chain(chosen, unsaved_work.unsaved_work_on(document.file.path, document.kind, self.state)):
            if path in entry.answered or (path == kept_copy and left is not copy):
                continue
            ask = self._question(document, path, left, chosen=path == kept_copy)
            if isinstance(ask, str):
                for_others.append(ask)
            elif ask is not None:
                return Opened(document, notice, Offer(ask, path, left))
        return Opened(document, notice or (Notice(" ".join(for_others), warning=True) if for_others else None))

    def _question(
        self, document: Document, path: Path, left: Journal | UnreadableWork, *, chosen: bool
    ) -> QuestionText | str | None:
        """Return the question about unsaved work, a sentence for users who are not asked, or None if nothing is new."""
        today = self.clock()
        if isinstance(left, UnreadableWork):
            if reason_set_aside(path) and not left.ours:
                return _kept_for(left.user, left.time, path, today)
            return questions.unreadable_work(document, path, left, today)
        living, mine = alive(left.owner), self._is_mine(path, left)
        if document.holds(left) and not left.damaged and not chosen:
            if not living:
                with suppress(OSError):
                    path.unlink()
            return None
        if not chosen and reason_set_aside(path) and not mine:
            return _kept_for(left.owner.user, left.time, path, today)
        copy = chosen and not unsaved_work.wants_answer(path)
        return questions.unsaved_work(document, left, mine=mine, me=self.me, living=living, chosen=copy, today=today)

    def _is_mine(self, path: Path, journal: Journal) -> bool:
        return unsaved_work.of_user(journal.owner, path, self.state, self.me.user)

    def _take_over(self, entry: _OpenDocument, document: AnyDocument, kept_copy: Path | None) -> Opened[AnyDocument]:
        """Read the file again and lock it for this process."""
        path = document.file.path
        assert path is not None
        try:
            fresh = self._read(path, kept_copy)
            lock = take_over(path, replace(self.me, since=self.clock()))
        except (OSError, StoreError) as error:
            return Opened(document, Notice(f"It cannot be taken over: {_reason(error)}", warning=True))
        if not isinstance(fresh, type(document)):
            return Opened(document, Notice("It cannot be taken over: the file is of another kind now.", warning=True))
        entry.lock = lock
        state = replace(fresh.file, opening=document.file.opening)
        taken = entry.latest = replace(fresh, file=state)
        opened = self._next_offer(taken, kept_copy)
        return replace(opened, notice=opened.notice or Notice(f"{name_of(taken)} is yours now."))

    def _restore(
        self, entry: _OpenDocument, document: AnyDocument, path: Path, journal: Journal
    ) -> Opened[AnyDocument]:
        """Restore the work with its undo history, and begin its journal anew with all of it."""
        now = document.file
        stamp = journal.stamp if now.stamp is not None else None
        work = document.restored(journal)
        work = entry.latest = replace(work, file=replace(now, stamp=stamp))
        try:
            aside = self._journal_of_restored(entry, work, path, journal)
        except (OSError, StoreError) as error:
            entry.journal = None
            return Opened(work, Notice(f"Restored. Not on disk: {_reason(error)}", warning=True))
        copy = f" {whole_name(aside)} holds a copy: Ctrl+O lists it." if aside is not None else ""
        owner, whose = journal.owner, "Your work is back."
        if (owner.user, owner.host) != (self.me.user, self.me.host):
            whose = f"The work of {person(owner)} is here."
        elif alive(owner) and owner != self.me:
            whose = "The other terminal's work is here."
        return Opened(work, Notice(f"{whose} Ctrl+Z undoes it step by step, Ctrl+S saves it.{copy}"))

    def _journal_of_restored(self, entry: _OpenDocument, work: Document, path: Path, journal: Journal) -> Path | None:
        """Begin a journal with the restored work; return the old journal's path unless it is replaced or gone."""
        wanted = unsaved_work.wants_answer(path)
        replaced = wanted and not journal.damaged and self._is_mine(path, journal) and not alive(journal.owner)
        if replaced and path == unsaved_work.journal_place(work.file.path, self.me, self.state):
            entry.journal = unsaved_work.new_journal(path, work.file.path)
            entry.journal.replace(entry.all_records(self.clock()))
            return None
        aside = None
        if not replaced and path.exists():
            aside = self._move_aside(path, journal, "damaged") if wanted else path
        entry.begin(self.clock())
        if replaced:
            # all of it is in the new journal
            path.unlink(missing_ok=True)
        return aside

    def _move_aside(self, path: Path, left: Journal | UnreadableWork, why: str) -> Path:
        """Set unsaved work aside, as `why` if it is ours and complete; else its author can be asked about it later."""
        mine = not isinstance(left, Journal) or self._is_mine(path, left)
        living = isinstance(left, Journal) and alive(left.owner)
        if mine and not living:
            return set_aside(path, why)
        if reason_set_aside(path):
            return path
        try:
            length = path.stat().st_size
            return set_aside(path, f"theirs-{times.for_file_name(self.clock())}-at-{length}" if mine else "kept")
        except PermissionError:
            # the folder forbids renaming: this journal stays, and the next one goes elsewhere
            return path

    def _put_away(
        self, document: AnyDocument, path: Path, left: Journal | UnreadableWork, whose: str
    ) -> Opened[AnyDocument]:
        """Return the document without the work, which is kept `whose`: as a backup, or for its author."""
        aside = path
        try:
            aside = self._move_aside(path, left, "discarded")
            notice = Notice(f"Kept {whose} {whole_name(aside)}; Ctrl+O lists it.")
        except FileNotFoundError:
            notice = Notice("It was saved or discarded meanwhile. Ctrl+O opens the file as it is now.", warning=True)
        except OSError as error:
            notice = Notice(f"The unsaved work cannot be renamed: {files.why(error)}", warning=True)
        self._entry(document).answered.update((path, aside))
        return self._next_offer(document, notice=notice)

    # ---- write the journal

    def keep(self, document: Document) -> Notice | None:
        """Write the edits since the last call to disk; call it before the next key is read."""
        closed = document.file.opening not in self._open
        entry = self._entry(document)
        before, entry.latest = entry.latest, document
        now = self.clock()
        if closed and document.unsaved:
            # edited while its closing waited for the disk: it is open again, with all of its work
            entry.take_lock(now)
        elif before.work.past is document.work.past and before.work.future is document.work.future:
            # nothing was edited, undone or redone
            return None
        try:
            gone = entry.write(before, now)
        except (OSError, StoreError) as error:
            entry.failing = True
            return Notice(f"Not on disk: {_reason(error)} {SAVE_ELSEWHERE}", warning=True)
        was_failing, entry.failing = entry.failing, False
        if warning := entry.warning_of_owner(now) or entry.warning_of_journal(gone=gone):
            return Notice(warning, warning=True)
        return Notice("Work is kept on the disk again.") if was_failing else None

    # ---- save

    def save(
        self, document: AnyDocument, path: Path | None = None, agreed: frozenset[str] = frozenset()
    ) -> Saved[AnyDocument] | QuestionText | Trouble:
        """Write a document to its own file or to `path`; `agreed` holds the answers to earlier questions.

        When a QuestionText comes back, call again with its answer added to `agreed`.
        """
        entry, file = self._entry(document), document.file.path
        target = file if path is None else paths.resolved_name(path, file)
        if target is None:
            return Trouble(f"{name_of(document)} has no name yet. SAVE AS (Ctrl+K) gives it one.")
        try:
            if document.kind is Kind.CONTOUR and target != file:
                target = paths.as_program(target)
            if (trouble := self._refusal(document, target)) is not None:
                return trouble
            if target == file:
                return self._save_own(entry, document, target, agreed)
            ask = None if agreed else questions.before_writing(target, file, held_by(target))
            return ask or self._write_file(entry, document, target, None)
        except OSError as error:
            # for example, the current folder is gone
            return Trouble(f"{name_of(document)} is not saved: {files.why(error)}")

    def _refusal(self, document: Document, target: Path) -> Trouble | None:
        """Return why a file cannot be written, whatever the operator answers; None if it can."""
        name, holder = paths.short_path(target), document.file.holder
        if _real_path(target) is None:
            return Trouble(f"{name} is not saved: that is not a file name. Choose another.")
        if paths.is_folder(target):
            return Trouble(f"{name} is not saved: this is a folder. Type a file's name.")
        if holder is not None and target == document.file.path:
            return Trouble(f"{held_sentence(holder, self.clock())} SAVE AS (Ctrl+K) saves your own copy.")
        open_here = self._open_here(target)
        if open_here is not None and open_here.latest.file.opening is not document.file.opening:
            return Trouble(f"{printable(target.name)} is open here, too. Type another name.", open_here.latest)
        try:
            if document.kind is Kind.NC and target != document.file.path:
                files.refuse_program(target)
        except StoreError as error:
            return Trouble(error.text)
        return None

    def _save_own(
        self, entry: _OpenDocument, document: AnyDocument, path: Path, agreed: frozenset[str]
    ) -> Saved[AnyDocument] | QuestionText | Trouble:
        """Save a document to its own file."""
        today = self.clock()
        if not agreed or entry.copy is None or os.path.lexists(entry.copy):
            entry.copy = free_copy_name(path, "mine", today)
        copy = entry.copy
        if {questions.KEEP_BOTH, questions.THEIRS, questions.FILE_AS_IT_IS} & agreed:
            return self._write_file(entry, document, copy, None)
        if _leads_elsewhere(path) and not document.file.link_agreed and questions.WRITE_THERE not in agreed:
            return questions.write_through_link(path)
        owner = None if entry.lock is None else taken_by(entry.lock)
        if owner is not None and questions.WRITE_ANYWAY not in agreed:
            return questions.taken_over(path, owner, copy)
        theirs = None
        if questions.YOURS in agreed:
            theirs = free_copy_name(path, "theirs", today)
            try:
                # written in one step: no half copy may pass for the other version
                files.write_data(theirs, files.read_file(path, MAX_BYTES[document.kind])[0])
            except (OSError, StoreError) as error:
                return Trouble(f"Nothing is saved: the other version cannot be copied, {_reason(error)}")
        elif (stop := self._ask_if_changed(document, path, copy, today)) is not None:
            return stop
        return self._write_file(entry, document, path, theirs, link_agreed=questions.WRITE_THERE in agreed)

    def _ask_if_changed(self, document: Document, path: Path, copy: Path, today: str) -> QuestionText | Trouble | None:
        """Return a question if the file differs from what was last read or saved, Trouble if it cannot be read."""
        try:
            data, status = files.read_file(path, MAX_BYTES[document.kind])
        except FileNotFoundError:
            return None
        except OSError as error:
            reason = files.why(error).partition(".")[0]
            return Trouble(
                f"{paths.short_path(path)} is not saved over what cannot be read: {reason}. {SAVE_ELSEWHERE}"
            )
        now = files.stamp_of_data(data, status.st_mtime_ns)
        if now.same_content(document.file.stamp):
            return None
        readable = False
        with suppress(StoreError):
            type(document).read(data, document.file)
            readable = True
        written = times.in_words(times.of_file(now.changed), today)
        return questions.changed_meanwhile(document, written, copy, readable=readable)

    def _write_file(
        self, entry: _OpenDocument, document: AnyDocument, path: Path, theirs: Path | None, *, link_agreed: bool = False
    ) -> Saved[AnyDocument] | Trouble:
        try:
            data = document.data()
            in_place = files.write_data(path, data)
        except (StoreError, ValueError) as error:
            return Trouble(f"{paths.short_path(path)} is not saved: {_reason(error)} {SAVE_ELSEWHERE}")
        before = document.file
        agreed = (before.link_agreed and path == before.path) or (link_agreed and _leads_elsewhere(path))
        state = replace(before, path=path, stamp=files.stamp_of_data(data), link_agreed=agreed)
        saved = entry.latest = document.saved(state, document)
        entry.drop_journal()
        entry.rewrite = entry.failing = entry.away = False
        if path != before.path:
            entry.release_lock()
            entry.warned = False
            saved = entry.latest = replace(saved, file=replace(state, holder=entry.take_lock(self.clock())))
        text = f"Saved: {paths.written_path(path)}{f', in place: {in_place}' if in_place else ''}"
        if isinstance(saved, ContourDocument) and any(unread_texts(saved.program)):
            text += ", what is marked ERR as it was typed."
        if theirs is not None:
            text = f"{text.removesuffix('.')}. The other version is in {whole_name(theirs)}."
        return Saved(saved, Notice(text))

    # ---- leave

    def close(self, document: Document) -> None:
        """Close a saved or abandoned document: remove its journal and its lock."""
        entry = self._open.pop(document.file.opening, None)
        if entry is not None:
            entry.drop_journal()
            entry.release_lock()

    def stop(self) -> None:
        """End the service, wanted or not; unsaved work stays in the journals."""
        for entry in self._open.values():
            if entry.latest.unsaved:
                entry.leave_journal(self.clock())
            else:
                entry.drop_journal()
            entry.release_lock()
        self._open.clear()


def free_copy_name(path: Path, whose: str, today: str) -> Path:
    """Return a free name such as `part.mine-2025-03-04-140509.toml`."""
    name = f"{path.stem}.{whose}-{times.for_file_name(today)}"
    free, number = path.with_name(f"{name}{path.suffix}"), 1
    while os.path.lexists(free):
        number += 1
        free = path.with_name(f"{name}-{number}{path.suffix}")
    return free


def _real_path(path: Path | None) -> str | None:
    """Return a path with its links resolved; None for None and for a name that no file can have."""
    try:
        return None if path is None else os.path.realpath(path)
    except ValueError:
        return None
    except OSError:
        # the current folder is gone
        return str(path)


def _leads_elsewhere(path: Path) -> bool:
    """True if a path is a link into another folder."""
    return path.is_symlink() and Path(os.path.realpath(path)).parent != paths.folder(path)


def _kept_for(user: str, time: str, path: Path, today: str) -> str:
    """Return the sentence for users who are not asked about the work."""
    when = times.in_words(time, today)
    return f"Unsaved work of {printable(user)}, {when}, is kept in {whole_name(path)}; Ctrl+O lists it."


def _reason(error: OSError | ValueError | StoreError) -> str:
    """Return what the system refused, or what a StoreError says if the system did not cause it."""
    cause = error.__cause__ if isinstance(error.__cause__, OSError) else error
    return files.why(cause) if isinstance(cause, OSError | ValueError) else str(error)
