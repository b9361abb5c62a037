"""What is offered when a program is opened: work that was left behind, and a program that somebody has open."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from app.documents import times
from app.documents.files import why, write_data
from app.documents.journal_file import JournalFile, set_aside, why_aside
from app.documents.lock import alive, take_over
from app.painted import places
from app.painted.filing import fresh
from app.painted.journal import Recovered, history_records, moved_record
from app.painted.messages import Close, Do, Open, Say
from app.painted.opened import opened
from app.painted.places import Unreadable
from app.painted.screens.ask import Ask, Option
from app.painted.screens.decide import Decide
from app.painted.session import Session, Tone
from app.painted.widgets.header import printable as whole
from core.pipeline.outline import outline
from core.program.file.read import StoreError
from core.program.history import differences
from core.units import printable

if TYPE_CHECKING:
    from app.documents.journal_file import Record
    from app.painted.desk import Desk
    from app.painted.keeping import Keeping


def looking(keeping: Keeping, session: Session) -> Decide:
    """The question of the second opener."""
    lines = (
        session.guard.looking,
        "You can look at it and save a copy under another name. Or take it over: the other one is told before saving.",
    )
    take = Do(lambda desk: taken_over(keeping, desk))
    return Decide("OPEN ALREADY", lines, (("l", "LOOK", (Close(),)), ("t", "TAKE OVER", (Close(), take))))


def taken_over(keeping: Keeping, desk: Desk) -> Desk:
    """The program read again and locked by us."""
    path = desk.session.file
    assert path is not None
    try:
        session = opened(path) if path.exists() else desk.session
        lock = take_over(path, keeping.me)
    except (OSError, StoreError) as error:
        return desk.take(Say(f"It cannot be taken over: {_reason(error)}", Tone.ERROR))
    session = replace(session, guard=replace(session.guard, lock=lock, looking=""))
    keeping.adopt(session, None)
    return offered(keeping, fresh(desk, session).take(Say("The program is yours now.")))


def offered(keeping: Keeping, desk: Desk, answered: frozenset[Path] = frozenset()) -> Desk:
    """The desk, with the question on it if work was left behind; a journal that holds nothing new is removed.

    Of what is kept for somebody else, and of what was `answered` already, nothing is asked again.
    """
    told: list[str] = []
    for path, found in _waiting(keeping, desk.session):
        if path in answered:
            continue
        if isinstance(found, Unreadable):
            if not (why_aside(path) and not found.ours):
                on = partial(_next, keeping, answered=answered | {path})
                return desk.take(Open(of_unreadable(_name(desk.session), path, found, keeping.clock(), on)))
            told.append(kept_for(found.user, found.time, path, keeping.clock()))
        elif _nothing_new(desk.session, path, found):
            with suppress(OSError):
                path.unlink()
        elif path != desk.session.guard.earlier and why_aside(path) and not _own(keeping, path, found):
            told.append(kept_for(found.head.owner.user, found.cursor.time, path, keeping.clock()))
        else:
            return desk.take(Open(_question(keeping, desk, path, found, answered)))
    return desk.take(Say(" ".join(told), Tone.WARNING)) if told else desk


def _waiting(keeping: Keeping, session: Session) -> Iterator[tuple[Path, Recovered | Unreadable]]:
    """What may be asked about; a copy that was chosen comes first."""
    earlier = session.guard.earlier
    if earlier is not None and (chosen := places.read(earlier) or places.unreadable(earlier)) is not None:
        yield earlier, chosen
    for path, found in places.found_of(session.file, keeping.own):
        if path != earlier:
            yield path, found


def _nothing_new(session: Session, path: Path, found: Recovered) -> bool:
    """Whether the file holds all of it; what somebody has chosen to see is told all the same."""
    same = found.history.program == session.program and not found.damaged
    return same and not alive(found.head.owner) and path != session.guard.earlier


def _own(keeping: Keeping, path: Path, found: Recovered) -> bool:
    return places.of_user(found.head.owner, path, keeping.own, keeping.me.user)


def kept_for(user: str, time: str, path: Path, today: str) -> str:
    """A sentence for those who are not asked."""
    when = times.in_words(time, today)
    return f"Unsaved work of {printable(user)}, {when}, is kept in {whole(path.name)}; Ctrl+O lists it."


def of_unreadable(name: str, path: Path, found: Unreadable, today: str, on: Callable[[Desk], Desk]) -> Decide:
    """Nobody can restore it; it must not be overlooked all the same.  `on` is what comes next."""
    who, when = printable(found.user), times.in_words(found.time, today).removeprefix("at ").removeprefix("on ")
    if found.hidden:
        told = f"{who} has unsaved work on {name}, from {when}. You may not read it."
        stays = f"It is kept, and {who} is asked about it at the next start on this program."
    else:
        told = f"There is unsaved work on {name} that cannot be read: its beginning is damaged. It is from {when}."
        stays = "It is kept; somebody who knows the format may get some of it back."
    lines = (told, stays, f"The file is {whole(path.name)}.")
    options = [("g", "GO ON", (Close(), Do(on)))]
    if found.ours and not found.hidden:
        options.append(("p", "PUT IT AWAY", (Close(), Do(lambda now: on(put_away(now, path))))))
    return Decide("WORK THAT CANNOT BE READ", lines, tuple(options))


def _question(keeping: Keeping, desk: Desk, path: Path, found: Recovered, answered: frozenset[Path]) -> Decide:
    restore = Do(lambda now: restored(keeping, now, path, found))
    again = answered | {path}
    own, leave = _own(keeping, path, found), Do(lambda now: discarded(keeping, now, path, found, answered))
    without: Option = ("d", "DISCARD" if own else "DON'T RESTORE", (Open(discarding(leave, own=own)),))
    if path == desk.session.guard.earlier and not wants_answer(path):
        without = ("l", "LEAVE IT", (Close(), Do(lambda now: offered(keeping, now, again))))
    return Decide(
        "WORK THAT WAS NOT SAVED",
        tuple(_told(keeping, desk.session, path, found)),
        (("r", "RESTORE", (Close(), restore)), without),
        details=differences(desk.session.program, found.history.program),
    )


def discarding(work: Do, *, own: bool = True) -> Ask:
    """Asked again: a link that splits a key in two may have typed the letter."""
    lines = ("The work is put away under another name and not offered again. Ctrl+O still lists it.",)
    if not own:
        lines = ("The work stays kept for whoever typed it, who is asked about it at the next start.",)
    return Ask("DISCARD IT?" if own else "GO ON WITHOUT IT?", lines, (("y", "YES", (Close(), Close(), work)),))


def wants_answer(path: Path) -> bool:
    """Whether a journal would be offered by itself, or is a copy that only somebody who looks for it sees."""
    return why_aside(path).partition("-")[0] in ("", "kept", "theirs")


def _name(session: Session) -> str:
    return "a program without a name" if session.file is None else printable(session.file.name)


def _told(keeping: Keeping, session: Session, path: Path, found: Recovered) -> list[str]:
    today, owner = keeping.clock(), found.head.owner
    when = times.in_words(found.cursor.time, today)
    edits = len(found.history.past)
    by = (
        ""
        if (owner.user, owner.host) == (keeping.me.user, keeping.me.host)
        else f" by {printable(owner.user)} on {printable(owner.host)}"
    )
    lines = [
        f"Work on {_name(session)}{by} was not saved. The last of it was {when}, "
        f"{edits} edit{'s' if edits != 1 else ''} can be undone."
    ]
    stamp, base = session.guard.stamp, found.head.stamp
    if session.file is not None and stamp is not None and (base is None or not stamp.same_content(base)):
        who = "by somebody else, or by this program just before its end"
        lines.append(f"The file was written since, {times.in_words(times.of(stamp.changed), today)}: {who}.")
    if alive(owner) and owner != keeping.me:
        lines.append("The other terminal may still be in use: who sits there can go on typing, and is told at saving.")
    if not _own(keeping, path, found):
        lines.append(f"It stays kept for {printable(owner.user)}, whatever you answer.")
    if found.damaged:
        lines.append("The end of it cannot be read and is kept aside.")
    if stamp is None and session.file is not None and session.file.exists():
        lines.append(f"{printable(session.file.name)} itself cannot be read as a program any more; it stays as it is.")
    return [*lines, f"Against {_against(session)}:"]


def _against(session: Session) -> str:
    """What the differences are told against."""
    if session.guard.stamp is not None:
        return "the saved file"
    return f"the example {session.title}" if session.title else "a new program"


def restored(keeping: Keeping, desk: Desk, path: Path, found: Recovered) -> Desk:
    """The work as it was, with its undo; the journal goes on."""
    now, program = desk.session, found.history.program
    guard = replace(now.guard, stamp=found.head.stamp if now.guard.stamp is not None else None, earlier=None)
    session = Session(found.history, now.saved, outline(program), now.file, guard=guard)
    session = session.at(found.cursor.where, found.cursor.field)
    desk = fresh(desk, session)
    try:
        journal, aside = _taken(keeping, session, path, found)
    except (OSError, StoreError) as error:
        keeping.adopt(session, None)
        return desk.take(Say(f"Restored, but the journal cannot be written: {_reason(error)}", Tone.WARNING))
    keeping.adopt(session, journal)
    said = "Your work is back. Ctrl+Z takes it back step by step, Ctrl+S saves it."
    copy = f"{whole(aside.name)} stays; Ctrl+O lists it. " if aside is not None else ""
    return desk.take(Say(f"{copy}{said}"))


def _taken(keeping: Keeping, session: Session, path: Path, found: Recovered) -> tuple[JournalFile, Path | None]:
    """The journal of a dead program of this user goes on; of any other one a copy does, and its own stays aside."""
    head, cursor, aside = keeping.head(session), keeping.cursor(session), None
    if path.exists() and wants_answer(path) and _own(keeping, path, found) and not alive(found.head.owner):
        if found.damaged:
            aside = path.with_name(f"{path.name}.damaged-{times.stamp(keeping.clock())}")
            write_data(aside, path.read_bytes())
        journal = JournalFile.resumed(path, found.length, found.total)
        journal.add([moved_record(head, cursor)])
        return journal, aside
    records = tuple(history_records(head, session.history, cursor))
    target = places.place(session.file, keeping.me, keeping.own)
    if path.exists() and not why_aside(path):
        try:
            aside = _left_aside(keeping, path, found)
        except OSError:
            if session.file is None:
                raise
            target = places.elsewhere(session.file, keeping.own)
    elif path.exists():
        aside = path
    return _begun(session, target, records, keeping.own), aside


def _begun(session: Session, target: Path, records: tuple[Record, ...], own: Path) -> JournalFile:
    """A journal with all of this; in this person's own folder where the program's takes nothing."""
    journal = places.journal_at(target, session.file)
    try:
        journal.add(records)
    except OSError:
        if session.file is None or target.parent == own:
            raise
        journal = places.journal_at(places.elsewhere(session.file, own), session.file)
        journal.add(records)
    return journal


def _left_aside(keeping: Keeping, path: Path, found: Recovered) -> Path:
    """Make room without taking it from whoever typed it: another user is asked still, or this one if more is typed."""
    if not _own(keeping, path, found):
        return path if why_aside(path) else set_aside(path, "kept")
    if alive(found.head.owner):
        return set_aside(path, f"theirs-{times.stamp(keeping.clock())}-at-{path.stat().st_size}")
    return set_aside(path, "discarded")


def discarded(
    keeping: Keeping, desk: Desk, path: Path, found: Recovered, answered: frozenset[Path] = frozenset()
) -> Desk:
    """The saved program; the work is kept under a name that is not offered again, but to another who typed it."""
    if (own := _own(keeping, path, found)) and not alive(found.head.owner):
        return _next(keeping, put_away(desk, path), answered | {path})
    try:
        aside = _left_aside(keeping, path, found)
    except FileNotFoundError:
        return put_away(desk, path)
    except OSError as error:
        desk = desk.take(Say(f"The work left behind cannot be put away: {_reason(error)}", Tone.WARNING))
        return _next(keeping, desk, answered | {path})
    kept = "Discarded. A copy is in" if own else f"Kept for {printable(found.head.owner.user)}:"
    return _next(keeping, desk.take(Say(f"{kept} {whole(aside.name)}; Ctrl+O lists it.")), answered | {path, aside})


def _next(keeping: Keeping, desk: Desk, answered: frozenset[Path]) -> Desk:
    """The next question, under what was said of this one."""
    then = offered(keeping, desk, answered)
    return then if len(then.pages) > len(desk.pages) else desk


def put_away(desk: Desk, path: Path) -> Desk:
    """Work that was left behind under a name that is not offered again, said with that name."""
    try:
        aside = set_aside(path, "discarded")
    except FileNotFoundError:
        told = "Nothing is left to discard: whoever typed it has saved it or given it up meanwhile."
        return desk.take(Say(f"{told} Ctrl+O opens the file as it is now.", Tone.WARNING))
    except OSError as error:
        return desk.take(Say(f"The work left behind cannot be put away: {_reason(error)}", Tone.WARNING))
    return desk.take(Say(f"Discarded. A copy is in {whole(aside.name)}; Ctrl+O lists it."))


def _reason(error: OSError | StoreError) -> str:
    return why(error) if isinstance(error, OSError) else error.text
