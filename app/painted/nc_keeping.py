"""Keeping NC programs that are being edited: after every key each change is on the disk, and the file is locked.

As with a program of contours, what a program that died has left behind is offered when its file is opened again.
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
from app.documents.lock import Held, Lock, Owner, myself, release, take, take_over, taken_by
from app.painted import places
from app.painted.keeping import away, holder
from app.painted.messages import Close, Do, Open, Say
from app.painted.session import Tone
from app.painted.widgets.header import printable as whole_name
from core.program.file.read import StoreError

if TYPE_CHECKING:
    from app.documents.nc_text import NcText
    from app.painted.desk import Desk
    from app.painted.nc_journal import Record
    from app.painted.screens.proof import ProofPage

LONGEST: Final = 64_000_000
"""Bytes of a journal that is not saved for very long; then it is begun anew."""


@dataclass(slots=True)
class Kept:
    """What is kept of one opened file: the text and the file as they were last, its journal, its lock."""

    listing: NcText
    file: Path
    journal: JournalFile | None = None
    lock: Lock | None = None
    failing: bool = False
    warned: bool = False
    away: bool = False


@dataclass(slots=True)
class NcKeeping:
    """The journals and locks of the NC files that are open, by their openings."""

    me: Owner = field(default_factory=lambda: myself(times.now()))
    own: Path = field(default_factory=places.own_folder)
    clock: Callable[[], str] = times.now
    kept: dict[object, Kept] = field(default_factory=dict)

    def keep(self, desk: Desk) -> Desk:
        """After a key: put on the disk what it has changed."""
        if desk.exit:
            self._let_go(set(self.kept))
            return desk
        pages = proofs(desk)
        self._let_go(self.kept.keys() - {page.opening for page in pages})
        for page in pages:
            if page.file is None:
                continue
            if page.opening not in self.kept:
                desk = self._open(desk, page, page.file)
            else:
                desk = self._changed(desk, page, self.kept[page.opening], page.file)
        return desk

    def close(self) -> None:
        """The end, wanted or not: what is not saved stays in the journal."""
        for one in self.kept.values():
            if one.journal is not None and one.listing.unsaved:
                self._last_try(one, one.journal)
            elif one.journal is not None:
                one.journal.remove()
            if one.lock is not None:
                release(one.lock)
        self.kept.clear()

    def _last_try(self, one: Kept, journal: JournalFile) -> None:
        """What could not be written before may find room by now."""
        from app.painted.nc_journal import whole

        try:
            if journal.unwritten:
                journal.add(())
        except OSError:
            self._elsewhere(one, tuple(whole(one.listing, self.me, self.clock())))
        if one.journal is not None:
            one.journal.close()

    def _let_go(self, openings: set[object]) -> None:
        """Files that are closed, saved or given up: nothing of them stays behind."""
        for opening in openings:
            one = self.kept.pop(opening)
            if one.journal is not None:
                one.journal.remove()
            if one.lock is not None:
                release(one.lock)

    def _open(self, desk: Desk, page: ProofPage, file: Path) -> Desk:
        """A file that has just been opened: lock it, and offer what was left behind of it."""
        one = self.kept[page.opening] = Kept(page.listing, file)
        looking = self._lock(one)
        desk = _put(desk, replace(page, lock=one.lock, looking=looking))
        if looking:
            from app.painted.screens.decide import Decide

            lines = (looking, "You can look at it and save a copy under another name. Or take it over.")
            over = (Close(), Do(lambda now: self._taken_over(now, page.opening)))
            options = (("l", "LOOK", (Close(),)), ("t", "TAKE OVER", over))
            return desk.take(Open(Decide("OPEN ALREADY", lines, options, file.name)))
        return self._offered(desk, page)

    def _lock(self, one: Kept) -> str:
        """Lock the file; who has it already, if somebody does.  Where no lock can be written nothing can be saved."""
        with suppress(OSError):
            found = take(one.file, self.me)
            if isinstance(found, Held):
                return holder(found.owner, self.clock())
            one.lock = found
        return ""

    def _taken_over(self, desk: Desk, opening: object) -> Desk:
        """The file read again and locked by us."""
        from app.painted.screens.proof_files import read

        page, one = _page(desk, opening), self.kept[opening]
        try:
            one.listing, one.lock = read(one.file), take_over(one.file, self.me)
        except (OSError, StoreError) as error:
            return desk.take(Say(f"It cannot be taken over: {_reason(error)}", Tone.ERROR))
        page = replace(page, asked=page.asked.of(one.listing), lock=one.lock, looking="")
        return self._offered(_put(desk, page).take(Say("The file is yours now.")), page)

    def _offered(self, desk: Desk, page: ProofPage) -> Desk:
        """The desk with the question on it if changes were left behind."""
        file = self.kept[page.opening].file
        if page.earlier is None and next(places.of_file(file, self.own), None) is None:
            return desk
        from app.painted.nc_recovery import offered

        return offered(self, desk, page.opening)

    def page(self, desk: Desk, opening: object) -> ProofPage:
        """The page of one opening."""
        return _page(desk, opening)

    def put(self, desk: Desk, page: ProofPage) -> Desk:
        """The desk with a page as it is now."""
        return _put(desk, page)

    def _changed(self, desk: Desk, page: ProofPage, one: Kept, file: Path) -> Desk:
        """The changes of one key; after a save there is no journal."""
        listing, was = page.listing, one.listing
        if file != one.file or listing.saved is not was.saved:
            return self._saved(desk, page, one, file)
        if listing.past is was.past and listing.future is was.future:
            return desk
        try:
            self._write(one, listing)
        except (OSError, StoreError) as error:
            return self._trouble(desk, one, error)
        one.failing = False
        return self._noticed(self._whereabouts(desk, one), one)

    def _whereabouts(self, desk: Desk, one: Kept) -> Desk:
        """Say once where the work is kept if not beside its file, and what had to be moved aside for it."""
        if one.journal is None:
            return desk
        aside, one.journal.aside = one.journal.aside, None
        if one.journal.path.parent == self.own and not one.away:
            one.away = True
            return desk.take(Say(away(one.file, one.journal.path), Tone.WARNING))
        if aside is not None:
            return desk.take(Say(f"{whole_name(aside.name)} holds what was left behind before.", Tone.WARNING))
        return desk

    def _write(self, one: Kept, listing: NcText) -> None:
        """On the disk: beside the file, else in this person's own folder."""
        from app.painted.nc_journal import whole

        was, one.listing = one.listing, listing
        try:
            self._in_place(one, was)
        except (OSError, StoreError):
            if not self._elsewhere(one, tuple(whole(listing, self.me, self.clock()))):
                raise

    def _in_place(self, one: Kept, was: NcText) -> None:
        from app.painted.nc_journal import steps, whole

        if one.journal is None:
            path = places.place(one.file, self.me, self.own)
            one.journal = places.journal_at(path, one.file)
            one.journal.add(whole(one.listing, self.me, self.clock()))
            return
        records = steps(was, one.listing, self.clock())
        if records is None or one.journal.length > LONGEST:
            one.journal.replace(whole(one.listing, self.me, self.clock()))
        else:
            one.journal.add(records)

    def begin(self, one: Kept, records: tuple[Record, ...]) -> None:
        """A journal that begins with these lines, beside the file if that can be; OSError if it can be nowhere."""
        one.journal = places.journal_at(places.place(one.file, self.me, self.own), one.file)
        try:
            one.journal.add(records)
        except OSError:
            if not self._elsewhere(one, records):
                raise

    def _elsewhere(self, one: Kept, records: tuple[Record, ...]) -> bool:
        """Put all of it into this person's own folder; only when it is there its place beside is given up."""
        if one.journal is not None and one.journal.path.parent == self.own:
            return False
        try:
            other = places.journal_at(places.elsewhere(one.file, self.own), one.file)
            other.add(records)
        except OSError:
            return False
        if one.journal is not None:
            one.journal.remove()
        one.journal = other
        return True

    def _trouble(self, desk: Desk, one: Kept, error: OSError | StoreError) -> Desk:
        """Tell once; the work goes on."""
        told, one.failing = one.failing, True
        if told and desk.session.said is not None:
            return desk
        return desk.take(Say(f"A crash would lose this: it is not on the disk, {_reason(error)}", Tone.WARNING))

    def _noticed(self, desk: Desk, one: Kept) -> Desk:
        """Say once that somebody has taken the file over."""
        owner = None if one.lock is None or one.warned else taken_by(one.lock)
        if owner is None:
            return desk
        one.warned = True
        return desk.take(Say(f"{holder(owner, self.clock())} S saves your text under another name.", Tone.WARNING))

    def _saved(self, desk: Desk, page: ProofPage, one: Kept, file: Path) -> Desk:
        """After a save: no journal; under another name another lock."""
        if one.journal is not None:
            one.journal.remove()
        one.journal, one.listing = None, page.listing
        if file == one.file:
            return desk
        if one.lock is not None:
            release(one.lock)
        one.file, one.lock, one.warned = file, None, False
        looking = self._lock(one)
        return _put(desk, replace(page, lock=one.lock, looking=looking))


def proofs(desk: Desk) -> tuple[ProofPage, ...]:
    """The pages on the desk whose text is a file being edited; nothing of them is imported before there is one."""
    if not any(page.opening is not None for page in desk.pages):
        return ()
    from app.painted.screens.proof import ProofPage

    return tuple(page for page in desk.pages if isinstance(page, ProofPage))


def _reason(error: OSError | StoreError) -> str:
    return why(error) if isinstance(error, OSError) else error.text


def _page(desk: Desk, opening: object) -> ProofPage:
    return next(page for page in proofs(desk) if page.opening is opening)


def _put(desk: Desk, page: ProofPage) -> Desk:
    return replace(desk, pages=tuple(page if one.opening is page.opening else one for one in desk.pages))
