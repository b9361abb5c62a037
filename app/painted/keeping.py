"""Keeping work: after every key what was accepted is on the disk before the next key is read.

Keeping also means: a lock on the program's file while it is open, and the offer of what an earlier program that died
has left behind.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents import times
from app.documents.files import why
from app.documents.journal_file import JournalFile
from app.documents.lock import Held, Owner, myself, release, take, taken_by
from app.painted import places
from app.painted.messages import Open, Say
from app.painted.session import Session, Tone
from app.painted.widgets.header import printable as whole
from core.program.file.read import StoreError
from core.units import printable

if TYPE_CHECKING:
    from app.documents.journal_file import Record
    from app.painted.desk import Desk
    from app.painted.journal import Cursor, Head

LONGEST: Final = 8_000_000
"""Bytes of a journal that is not saved for very long; then it is begun anew with the last `STEPS` edits."""
STEPS: Final = 500


@dataclass(slots=True)
class Keeping:
    """The journal and the lock of the program on the desk; `known` is the session as it was kept last.

    `moved` says that the next line must tell who works on which file now; `failing` that the last line is not on the
    disk; `warned` that somebody has taken the program over; `away` that the operator knows of a journal that is not
    beside its file.
    """

    me: Owner = field(default_factory=lambda: myself(times.now()))
    own: Path = field(default_factory=places.own_folder)
    clock: Callable[[], str] = times.now
    known: Session | None = None
    journal: JournalFile | None = None
    moved: bool = False
    failing: bool = False
    warned: bool = False
    away: bool = False

    def keep(self, desk: Desk) -> Desk:
        """After a key: put on the disk what it has changed."""
        session, known = desk.session, self.known
        if desk.exit:
            self.leave()
            return desk
        if known is None or session.guard.origin is not known.guard.origin:
            return self.open(desk)
        if session.history is not known.history:
            desk = self._record(desk, known)
        if session.saved is not known.saved or session.file != known.file:
            desk = self._saved(desk, known)
        self.known = desk.session
        return desk

    def open(self, desk: Desk) -> Desk:
        """Another program is on the desk: lock it, and offer what was left behind of it."""
        first = self.known is None
        self.leave()
        desk = self._locked(desk)
        session = self.known = desk.session
        if session.guard.looking:
            from app.painted import recovery

            return desk.take(Open(recovery.looking(self, session)))
        asked = first or session.file is not None or session.guard.earlier is not None
        return self._offered(desk) if asked else desk

    def _offered(self, desk: Desk) -> Desk:
        """The desk with the question on it if work was left behind."""
        session = desk.session
        if session.guard.earlier is None and next(places.found_of(session.file, self.own), None) is None:
            return desk
        from app.painted import recovery

        return recovery.offered(self, desk)

    def leave(self) -> None:
        """The program is saved or given up: nothing of it stays behind."""
        if self.journal is not None:
            self.journal.remove()
        self._let_go()

    def close(self) -> None:
        """The end, wanted or not: what is not saved stays in the journal."""
        if self.journal is not None and (self.known is None or not self.known.unsaved):
            self.journal.remove()
        elif self.journal is not None:
            self._last_try(self.journal)
        self._let_go()

    def _last_try(self, journal: JournalFile) -> None:
        """What could not be written before may find room by now."""
        try:
            if journal.unwritten:
                journal.add(())
        except OSError:
            if self.known is not None:
                self._elsewhere(self.known)
        if self.journal is not None:
            self.journal.close()

    def adopt(self, session: Session, journal: JournalFile | None) -> None:
        """Go on with a restored session, and with its journal if it could be taken."""
        self.known, self.journal, self.moved = session, journal, False

    def head(self, session: Session) -> Head:
        """Whose work it is, and on which file."""
        from app.painted.journal import Head

        return Head(self.me, None if session.file is None else str(session.file), session.guard.stamp)

    def cursor(self, session: Session) -> Cursor:
        """Where the operator is."""
        from app.painted.journal import Cursor

        return Cursor(session.where, session.field, self.clock())

    def _let_go(self) -> None:
        lock = None if self.known is None else self.known.guard.lock
        if lock is not None:
            release(lock)
        self.known, self.journal = None, None
        self.moved = self.failing = self.warned = self.away = False

    def _locked(self, desk: Desk) -> Desk:
        """The program's file locked; where no lock can be written, nothing can be saved either."""
        session = desk.session
        if session.file is None:
            return desk
        with suppress(OSError):
            found = take(session.file, self.me)
            if isinstance(found, Held):
                guard = replace(session.guard, lock=None, looking=holder(found.owner, self.clock()))
            else:
                guard = replace(session.guard, lock=found, looking="")
            return replace(desk, session=replace(session, guard=guard))
        return desk

    def _record(self, desk: Desk, known: Session) -> Desk:
        """The edits of one key."""
        session = desk.session
        try:
            self._write(session, known)
        except (OSError, StoreError) as error:
            return self._trouble(desk, error)
        was, self.failing = self.failing, False
        if was and session.said is None:
            return desk.take(Say("Work is kept on the disk again."))
        return self._noticed(self._whereabouts(desk))

    def _whereabouts(self, desk: Desk) -> Desk:
        """Say once where the work is kept if not beside its file, and what had to be moved aside for it."""
        file, journal = desk.session.file, self.journal
        if journal is None:
            return desk
        aside, journal.aside = journal.aside, None
        if file is not None and journal.path.parent == self.own and not self.away:
            self.away = True
            return desk.take(Say(away(file, journal.path), Tone.WARNING))
        if aside is not None:
            return desk.take(Say(f"{whole(aside.name)} holds what was left behind; Ctrl+O lists it.", Tone.WARNING))
        return desk

    def _write(self, session: Session, known: Session) -> None:
        """On the disk: beside the program, else in this person's own folder."""
        try:
            self._in_place(session, known)
        except (OSError, StoreError):
            if not self._elsewhere(session):
                raise

    def _elsewhere(self, session: Session) -> bool:
        """Put all of the work into this person's own folder; only when it is there its place beside is given up."""
        from app.painted.journal import history_records

        if session.file is None or (self.journal is not None and self.journal.path.parent == self.own):
            return False
        try:
            other = places.journal_at(places.elsewhere(session.file, self.own), session.file)
            other.add(history_records(self.head(session), session.history, self.cursor(session)))
        except OSError:
            return False
        if self.journal is not None:
            self.journal.remove()
        self.journal, self.moved = other, False
        return True

    def _in_place(self, session: Session, known: Session) -> None:
        from app.painted.journal import edit_records, history_records

        cursor = self.cursor(session)
        records = edit_records(known.history, session.history, cursor)
        if self.journal is None:
            self.journal = places.journal_at(self._place(session), session.file)
            self.journal.add(history_records(self.head(session), session.history, cursor))
        elif records is None or self.journal.length > LONGEST:
            short = replace(session.history, past=session.history.past[-STEPS:])
            self.journal.replace(history_records(self.head(session), short, cursor))
        else:
            self.journal.add((*self._move(session, cursor), *records))
        self.moved = False

    def _place(self, session: Session) -> Path:
        return places.place(session.file, self.me, self.own)

    def _move(self, session: Session, cursor: Cursor) -> tuple[Record, ...]:
        from app.painted.journal import moved_record

        return (moved_record(self.head(session), cursor),) if self.moved else ()

    def _trouble(self, desk: Desk, error: OSError | StoreError) -> Desk:
        """Tell once, and again with every edit that has nothing else to say; the work goes on."""
        told, self.failing = self.failing, True
        if told and desk.session.said is not None:
            return desk
        reason = why(error) if isinstance(error, OSError) else error.text
        return desk.take(Say(f"A crash would lose this: it is not on the disk, {reason}", Tone.WARNING))

    def _noticed(self, desk: Desk) -> Desk:
        """Say once that somebody has taken the program over."""
        lock = desk.session.guard.lock
        owner = None if lock is None or self.warned else taken_by(lock)
        if owner is None:
            return desk
        self.warned = True
        who = holder(owner, self.clock())
        return desk.take(Say(f"{who} SAVE AS keeps your work.", Tone.WARNING))

    def _saved(self, desk: Desk, known: Session) -> Desk:
        """After a save there is no journal; after a save under another name there is another lock."""
        session = desk.session
        if self.journal is not None and self.journal.put_away():
            self.journal = self._next_journal(session, self.journal)
        else:
            self.journal = None
        if session.file == known.file:
            return desk
        if known.guard.lock is not None:
            release(known.guard.lock)
        return self._locked(desk)

    def _next_journal(self, session: Session, before: JournalFile) -> JournalFile | None:
        """The one after a save: it begins with all that the one before held, so that undo reaches back behind both."""
        self.moved, self.away = True, False
        try:
            after = places.journal_at(self._place(session), session.file)
        except OSError:
            return None
        return replace(after, unwritten=before.unwritten, total=before.total)


def away(file: Path, journal: Path) -> str:
    """Where work on a file is kept whose folder takes nothing, as a sentence."""
    folder = whole(str(journal.parent))
    return f"The folder of {printable(file.name)} takes nothing: until it is saved, the work is kept in {folder}"


def holder(owner: Owner, today: str) -> str:
    """Who has a program open, as a sentence."""
    where = f" on {printable(owner.host)}" if owner.host else ""
    when = times.in_words(owner.since, today).removeprefix("at ").removeprefix("on ")
    since = f" since {when}" if owner.since else ""
    return f"{printable(owner.user)}{where} has this program open{since}."
