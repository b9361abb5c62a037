"""Keeping NC programs that are being edited: after every key each change is on the disk, and the file is locked.

As with a program of contours, what a program that died has left behind is offered when its file is opened again.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app import places, times
from app.keeping import holder
from app.messages import Close, Do, Open, Say
from app.session import Tone
from core.program.disk import why
from core.program.journal_file import JournalFile, set_aside
from core.program.lock import Held, Lock, Owner, alive, myself, release, take, take_over, taken_by
from core.program.store import StoreError
from core.records import dataclass, field
from core.units import printable

if TYPE_CHECKING:
    from app.desk import Desk
    from app.listing import Listing
    from app.nc_journal import Found
    from app.screens.proof import ProofPage

LONGEST: Final = 64_000_000
"""Bytes of a journal that is not saved for very long; then it is begun anew."""


@dataclass(slots=True)
class Kept:
    """What is kept of one opened file: the text and the file as they were last, its journal, its lock."""

    listing: Listing
    file: Path
    journal: JournalFile | None = None
    lock: Lock | None = None
    failing: bool = False
    warned: bool = False


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
                one.journal.close()
            elif one.journal is not None:
                one.journal.remove()
            if one.lock is not None:
                release(one.lock)
        self.kept.clear()

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
            from app.screens.decide import Decide

            lines = (looking, "You can look at it and save a copy under another name. Or take it over.")
            over = (Close(), Do(lambda now: self._taken_over(now, page.opening)))
            options = (("l", "LOOK", (Close(),)), ("t", "TAKE OVER", over))
            return desk.take(Open(Decide("OPEN ALREADY", lines, options, file.name)))
        return self._offered(desk, page, one)

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
        from app.screens.proof_files import read

        page, one = _page(desk, opening), self.kept[opening]
        try:
            one.listing, one.lock = read(one.file), take_over(one.file, self.me)
        except (OSError, StoreError) as error:
            return desk.take(Say(f"It cannot be taken over: {_reason(error)}", Tone.ERROR))
        page = replace(page, asked=page.asked.of(one.listing), lock=one.lock, looking="")
        return self._offered(_put(desk, page).take(Say("The file is yours now.")), page, one)

    def _offered(self, desk: Desk, page: ProofPage, one: Kept) -> Desk:
        """The desk with the question on it if work was left behind; one that says nothing new is removed."""
        from app.nc_journal import differences, found_in
        from app.recovery import discarding, put_away
        from app.screens.decide import Decide

        path = places.place(one.file, self.me, self.own)
        try:
            found = found_in(path.read_bytes())
        except OSError:
            return desk
        if found is None or alive(found.owner):
            return desk
        if "".join(found.listing.lines) == "".join(page.listing.lines) and not found.damaged:
            path.unlink(missing_ok=True)
            return desk
        restore = (Close(), Do(lambda now: self._restored(now, page.opening, path, found)))
        options = (
            ("r", "RESTORE", restore),
            ("d", "DISCARD", (Open(discarding(Do(lambda now: put_away(now, path)))),)),
        )
        details = differences(page.listing, found.listing)
        told = self._told(page, found)
        return desk.take(Open(Decide("CHANGES THAT WERE NOT SAVED", told, options, one.file.name, details)))

    def _told(self, page: ProofPage, found: Found) -> tuple[str, ...]:
        from app.nc_journal import mark

        name = "" if page.file is None else printable(page.file.name)
        when, count = times.told(found.time, self.clock()), len(found.listing.past)
        lines = [
            f"Changes of {name} were not saved. The last of them was {when}, "
            f"{count} change{'s' if count != 1 else ''} can be undone."
        ]
        if found.file != mark(page.listing.origin):
            lines.append("The file was written by somebody else since.")
        if found.damaged:
            lines.append("The end of it cannot be read and is kept aside.")
        return (*lines, "Against the file:")

    def _restored(self, desk: Desk, opening: object, path: Path, found: Found) -> Desk:
        """The text as it was, with its undo; the journal begins anew with all of it."""
        page, one = _page(desk, opening), self.kept[opening]
        listing = replace(found.listing, origin=page.listing.origin)
        page = replace(page, asked=page.asked.of(listing))
        one.listing = listing
        desk = _put(desk, page.at_row(listing.past[-1].row if listing.past else 0))
        try:
            if found.damaged:
                set_aside(path, "damaged")
            one.journal = JournalFile(path)
            self._begin(one, listing, replace_it=not found.damaged)
        except (OSError, StoreError) as error:
            one.journal = None
            return desk.take(Say(f"Restored, but the journal cannot be written: {_reason(error)}", Tone.WARNING))
        sizes = "" if page.asked.tools.tools else " No tool's diameter and no control is kept: t and c give them again."
        return desk.take(Say(f"Your changes are back. u takes them back step by step, s saves them.{sizes}"))

    def _begin(self, one: Kept, listing: Listing, *, replace_it: bool) -> None:
        from app.nc_journal import whole

        assert one.journal is not None
        records = whole(listing, self.me, self.clock())
        if replace_it:
            one.journal.replace(records)
        else:
            one.journal.add(records)

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
        return self._noticed(desk, one)

    def _write(self, one: Kept, listing: Listing) -> None:
        from app.nc_journal import steps

        was, one.listing = one.listing, listing
        if one.journal is None:
            path = places.place(one.file, self.me, self.own)
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            one.journal = JournalFile(path)
            self._begin(one, listing, replace_it=False)
            return
        records = steps(was, listing, self.clock())
        if records is None or one.journal.length > LONGEST:
            self._begin(one, listing, replace_it=True)
        else:
            one.journal.add(records)

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
    from app.screens.proof import ProofPage

    return tuple(page for page in desk.pages if isinstance(page, ProofPage))


def _reason(error: OSError | StoreError) -> str:
    return why(error) if isinstance(error, OSError) else error.text


def _page(desk: Desk, opening: object) -> ProofPage:
    return next(page for page in proofs(desk) if page.opening is opening)


def _put(desk: Desk, page: ProofPage) -> Desk:
    return replace(desk, pages=tuple(page if one.opening is page.opening else one for one in desk.pages))
