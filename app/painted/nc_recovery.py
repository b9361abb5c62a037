"""What is offered when an NC program is opened: changes that were left behind, whosever they are."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from app.documents import times
from app.documents.files import why
from app.documents.journal_file import JournalFile, set_aside, why_aside
from app.documents.lock import alive
from app.painted import places
from app.painted.messages import Close, Do, Open, Say
from app.painted.nc_journal import Found, differences, found_in, mark, whole
from app.painted.places import Unreadable
from app.painted.recovery import discarding, kept_for, of_unreadable, put_away, wants_answer
from app.painted.screens.ask import Option
from app.painted.screens.decide import Decide
from app.painted.session import Tone
from app.painted.widgets.header import printable as whole_name
from core.program.file.read import StoreError
from core.units import printable

if TYPE_CHECKING:
    from app.documents.nc_text import NcText
    from app.painted.desk import Desk
    from app.painted.nc_keeping import Kept, NcKeeping
    from app.painted.screens.proof import ProofPage


def offered(keeping: NcKeeping, desk: Desk, opening: object, answered: frozenset[Path] = frozenset()) -> Desk:
    """The desk with the question on it if changes were left behind; a journal that says nothing new is removed."""
    page, one, today, told = keeping.page(desk, opening), keeping.kept[opening], keeping.clock(), list[str]()
    for path in _waiting(page, one, keeping.own):
        found = None if path in answered else _found(path)
        if isinstance(found, Unreadable):
            if not why_aside(path) or found.ours:
                on = partial(offered, keeping, opening=opening, answered=answered | {path})
                question = of_unreadable(printable(one.file.name), path, found, today, on)
                return desk.take(Open(replace(question, about=one.file.name)))
            told.append(kept_for(found.user, found.time, path, today))
        elif found is None or alive(found.owner):
            continue
        elif _nothing_new(page, path, found):
            with suppress(OSError):
                path.unlink()
        elif path != page.earlier and why_aside(path) and not _own(keeping, path, found):
            told.append(kept_for(found.owner.user, found.time, path, today))
        else:
            return desk.take(Open(_question(keeping, page, path, found, answered)))
    return desk.take(Say(" ".join(told), Tone.WARNING)) if told else desk


def _waiting(page: ProofPage, one: Kept, own: Path) -> Iterator[Path]:
    """The journals that may be asked about; a copy that was chosen comes first."""
    if page.earlier is not None:
        yield page.earlier
    yield from (path for path in places.of_file(one.file, own) if path != page.earlier)


def _found(path: Path) -> Found | Unreadable | None:
    try:
        found = found_in(path.read_bytes())
    except OSError:
        found = None
    return found or places.unreadable(path)


def _nothing_new(page: ProofPage, path: Path, found: Found) -> bool:
    same = "".join(found.listing.lines) == "".join(page.listing.lines)
    return same and not found.damaged and path != page.earlier


def _own(keeping: NcKeeping, path: Path, found: Found) -> bool:
    return places.of_user(found.owner, path, keeping.own, keeping.me.user)


def _question(keeping: NcKeeping, page: ProofPage, path: Path, found: Found, answered: frozenset[Path]) -> Decide:
    own, again = _own(keeping, path, found), answered | {path}
    restore = (Close(), Do(lambda now: restored(keeping, now, page.opening, path, found)))
    leave = Do(lambda now: _left(keeping, now, page.opening, path, found, again))
    without: Option = ("d", "DISCARD" if own else "DON'T RESTORE", (Open(discarding(leave, own=own)),))
    if path == page.earlier and not wants_answer(path):
        without = ("l", "LEAVE IT", (Close(), Do(lambda now: offered(keeping, now, page.opening, again))))
    details = differences(page.listing, found.listing)
    name = "" if page.file is None else page.file.name
    options = (("r", "RESTORE", restore), without)
    return Decide("CHANGES THAT WERE NOT SAVED", _told(keeping, page, path, found), options, name, details)


def _told(keeping: NcKeeping, page: ProofPage, path: Path, found: Found) -> tuple[str, ...]:
    name = "" if page.file is None else printable(page.file.name)
    by = "" if found.owner.user == keeping.me.user else f" by {printable(found.owner.user)}"
    when, count = times.in_words(found.time, keeping.clock()), len(found.listing.past)
    lines = [
        f"Changes of {name}{by} were not saved. The last of them was {when}, "
        f"{count} change{'s' if count != 1 else ''} can be undone."
    ]
    if page.file is not None and not page.file.exists():
        lines.append("The file itself is gone: saving makes it anew.")
    elif found.file != mark(page.listing.origin):
        lines.append("The file was written since: by somebody else, or by this program just before its end.")
    if not _own(keeping, path, found):
        lines.append(f"They stay kept for {printable(found.owner.user)}, whatever you answer.")
    if found.damaged:
        lines.append("The end of it cannot be read and is kept aside.")
    return (*lines, "Against the file:")


def _left(keeping: NcKeeping, desk: Desk, opening: object, path: Path, found: Found, answered: frozenset[Path]) -> Desk:
    """The file as it is: one's own changes are put away, those of another stay for him."""
    if _own(keeping, path, found):
        then = put_away(desk, path)
    else:
        try:
            aside = path if why_aside(path) else set_aside(path, "kept")
        except OSError as error:
            return desk.take(Say(f"The work left behind cannot be put away: {why(error)}", Tone.WARNING))
        said = f"Kept for {printable(found.owner.user)}: {whole_name(aside.name)}; the list of files shows it."
        answered, then = answered | {aside}, desk.take(Say(said))
    following = offered(keeping, then, opening, answered)
    return following if len(following.pages) > len(then.pages) else then


def restored(keeping: NcKeeping, desk: Desk, opening: object, path: Path, found: Found) -> Desk:
    """The text as it was, with its undo; the journal begins anew with all of it."""
    page, one = keeping.page(desk, opening), keeping.kept[opening]
    listing = replace(found.listing, origin=page.listing.origin)
    if one.file.exists():
        listing = _known(listing, page.listing)
    page = replace(page, asked=page.asked.of(listing), earlier=None)
    one.listing = listing
    desk = keeping.put(desk, page.at_row(listing.past[-1].row if listing.past else 0))
    try:
        aside = _begun(keeping, one, path, found)
    except (OSError, StoreError) as error:
        one.journal = None
        reason = why(error) if isinstance(error, OSError) else error.text
        return desk.take(Say(f"Restored, but the journal cannot be written: {reason}", Tone.WARNING))
    copy = f"{whole_name(aside.name)} stays. " if aside is not None else ""
    sizes = "" if page.asked.tools.tools else " No tool's diameter and no control is kept: t and c give them again."
    return desk.take(Say(f"{copy}Your changes are back. u takes them back step by step, s saves them.{sizes}"))


def _known(work: NcText, file: NcText) -> NcText:
    """The work, knowing after which of its changes it is what the file holds: undone to there nothing is unsaved."""
    at = work.first
    for change in (None, *work.past, *reversed(work.future)):
        at = at if change is None else at.done(change)
        if at.lines == file.lines and at.encoding == file.encoding:
            return replace(work, saved=change)
    return work


def _begun(keeping: NcKeeping, one: Kept, path: Path, found: Found) -> Path | None:
    """A journal with all of it.  That of this user's own program that died goes; what stays aside is given back."""
    records = tuple(whole(one.listing, keeping.me, keeping.clock()))
    own, aside = _own(keeping, path, found) and wants_answer(path), None
    if own and not found.damaged and path == places.place(one.file, keeping.me, keeping.own):
        one.journal = JournalFile(path)
        one.journal.replace(records)
        return None
    if found.damaged and own:
        aside = set_aside(path, "damaged")
    elif not own:
        aside = path if why_aside(path) else set_aside(path, "kept")
    keeping.begin(one, records)
    if own and not found.damaged and one.journal is not None:
        # all of it is in the new journal, which may have taken its place
        old = one.journal.aside if one.journal.path == path else path
        one.journal.aside = None
        if old is not None:
            old.unlink(missing_ok=True)
    return aside
