"""What is offered when a program is opened: work that was left behind, and a program that somebody has open."""

from __future__ import annotations

import os
import shutil
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app import places, times
from app.files import opened
from app.filing import fresh
from app.messages import Close, Do, Open, Say
from app.screens.decide import Decide
from app.session import Session, Tone
from core.pipeline.outline import outline
from core.program.difference import differences
from core.program.disk import why
from core.program.journal import Recovered, history_records, moved_record
from core.program.journal_file import JournalFile, set_aside
from core.program.lock import alive, take_over
from core.program.store import StoreError
from core.units import printable

if TYPE_CHECKING:
    from app.desk import Desk
    from app.keeping import Keeping


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


def offered(keeping: Keeping, desk: Desk) -> Desk:
    """The desk, with the question on it if work was left behind; a journal that holds nothing new is removed."""
    for path, found in places.left(desk.session.file, keeping.own):
        if found.history.program == desk.session.program and not found.damaged and not alive(found.head.owner):
            path.unlink(missing_ok=True)
            continue
        return desk.take(Open(_question(keeping, desk, path, found)))
    return desk


def _question(keeping: Keeping, desk: Desk, path: Path, found: Recovered) -> Decide:
    restore = Do(lambda now: restored(keeping, now, path, found))
    discard = Do(lambda now: discarded(now, path))
    return Decide(
        "WORK THAT WAS NOT SAVED",
        tuple(_told(keeping, desk.session, found)),
        (("r", "RESTORE", (Close(), restore)), ("d", "DISCARD", (Close(), discard))),
        details=differences(desk.session.program, found.history.program),
    )


def _told(keeping: Keeping, session: Session, found: Recovered) -> list[str]:
    today, owner = keeping.clock(), found.head.owner
    what = "a program without a name" if session.file is None else printable(session.file.name)
    when = times.told(found.cursor.time, today)
    edits = len(found.history.past)
    by = (
        ""
        if (owner.user, owner.host) == (keeping.me.user, keeping.me.host)
        else f" by {printable(owner.user)} on {printable(owner.host)}"
    )
    lines = [
        f"Work on {what}{by} was not saved. The last of it was {when}, "
        f"{edits} edit{'s' if edits != 1 else ''} can be undone."
    ]
    stamp, base = session.guard.stamp, found.head.stamp
    if session.file is not None and stamp is not None and (base is None or not stamp.same_content(base)):
        lines.append(f"The file was written by somebody else since, {times.told(times.of(stamp.changed), today)}.")
    if found.damaged:
        lines.append("The end of it cannot be read and is kept aside.")
    if stamp is None and session.file is not None and session.file.exists():
        lines.append(f"{printable(session.file.name)} itself cannot be read as a program any more; it stays as it is.")
    against = "a new program" if stamp is None else "the saved file"
    return [*lines, f"Against {against}:"]


def restored(keeping: Keeping, desk: Desk, path: Path, found: Recovered) -> Desk:
    """The work as it was, with its undo; the journal goes on."""
    now, program = desk.session, found.history.program
    guard = replace(now.guard, stamp=found.head.stamp if now.guard.stamp is not None else None)
    session = Session(found.history, now.saved, outline(program), now.file, guard=guard)
    session = session.at(found.cursor.where, found.cursor.field)
    desk = fresh(desk, session)
    try:
        keeping.adopt(session, _taken(keeping, session, path, found))
    except (OSError, StoreError) as error:
        keeping.adopt(session, None)
        return desk.take(Say(f"Restored, but the journal cannot be written: {_reason(error)}", Tone.WARNING))
    return desk.take(Say("Your work is back as it was. Ctrl+Z takes it back step by step, Ctrl+S saves it."))


def _taken(keeping: Keeping, session: Session, path: Path, found: Recovered) -> JournalFile:
    """The journal of a dead program goes on; of one that may still write it, or has just removed it, a copy does."""
    head, cursor = keeping.head(session), keeping.cursor(session)
    if not path.exists():
        journal = JournalFile(path)
        journal.add(history_records(head, session.history, cursor))
        return journal
    if not alive(found.head.owner):
        if found.damaged:
            shutil.copyfile(path, path.with_name(f"{path.name}.damaged-{times.stamp(keeping.clock())}"))
        journal = JournalFile.resumed(path, found)
        journal.add([moved_record(head, cursor)])
        return journal
    os.link(path, path.with_name(f"{path.name}.theirs-{times.stamp(keeping.clock())}"))
    journal = JournalFile(path)
    journal.replace(history_records(head, session.history, cursor))
    return journal


def discarded(desk: Desk, path: Path) -> Desk:
    """The saved program; the work is kept under a name that is not offered again."""
    try:
        aside = set_aside(path, "discarded")
    except FileNotFoundError:
        told = "Nothing is left to discard: whoever typed it has saved it or given it up meanwhile."
        return desk.take(Say(f"{told} Ctrl+O opens the file as it is now.", Tone.WARNING))
    except OSError as error:
        return desk.take(Say(f"The work left behind cannot be put away: {_reason(error)}", Tone.WARNING))
    return desk.take(Say(f"Discarded. A copy is in {aside.name}."))


def _reason(error: OSError | StoreError) -> str:
    return why(error) if isinstance(error, OSError) else error.text
