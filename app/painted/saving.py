"""Before a file is written: what the operator must be asked, so that nobody's work is overwritten unseen."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents import times
from app.documents.files import load, stamp_of, why, write_data
from app.documents.folders import folder, outside, printable_path
from app.documents.lock import held_by, taken_by
from app.documents.naming import is_folder
from app.painted.guard import THE_WAY
from app.painted.messages import Close, Message, Open, Post, Save, Say
from app.painted.screens.ask import Ask
from app.painted.screens.decide import Choose, shortened
from app.painted.session import Session, Tone
from core.program.file.read import StoreError
from core.program.history import differences
from core.units import printable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from app.painted.desk import Desk
    from core.program.model import Program


UNREADABLE: Final = "It is no program any more."
FEW: Final = 3
"""Differences of either version that are told one by one."""
AS_OPENED: Final = "It holds the same program as when it was opened here."


def asked(desk: Desk, path: Path, message: Save) -> Desk | None:
    """The desk with the question that must be answered before `path` is written; None where there is none."""
    if is_folder(path):
        return desk.take(Say(f"{printable_path(path)} is not saved: this is a folder. Type a file's name.", Tone.ERROR))
    session, own = desk.session, path == desk.session.file
    if own and session.guard.looking:
        return desk.take(Say(f"{session.guard.looking} Save your own copy. {THE_WAY}", Tone.ERROR))
    if not own and outside(path, session.file) and not message.linked:
        agreed = message._replace(path=path, linked=True, overwrite=True)
        return desk.take(Open(asking(path, session.file, agreed)))
    if own and leads_elsewhere(path) and not message.linked and not session.guard.linked:
        return desk.take(Open(_linked(path, message)))
    if not own:
        return None if message.overwrite or not there(path) else desk.take(Open(replacing(path, message)))
    if not message.taken and (question := _taken(session, path, message)):
        return desk.take(Open(question))
    return None if message.changed else _changed(desk, path, message)


def asking(path: Path, file: Path | None, agreed: Message, about: str = "") -> Ask:
    """The one question before a file outside is written; it says too what would be replaced there."""
    target = Path(os.path.realpath(path))
    link = f"{printable_path(path)} leads there." if path.is_symlink() else ""
    whose = "current" if file is None else "program's"
    stands = "A file of this name exists already. Its content is replaced." if target.exists() else ""
    owner = held_by(path)
    who = "" if owner is None else f"{printable(owner.user)} on {printable(owner.host)} has it open."
    lines = (
        f"{printable_path(target)} is not in the {whose} folder,",
        f"{printable_path(folder(file))}.",
        link,
        stands,
        who,
    )
    options = (("w", "WRITE THERE", (Close(), agreed)),)
    return Ask("WRITE IN ANOTHER FOLDER?", tuple(line for line in lines if line), options, about)


def there(path: Path) -> bool:
    """Whether the name is in use, be it by a link that leads to nothing."""
    return path.exists() or path.is_symlink()


def leads_elsewhere(path: Path) -> bool:
    """Whether a name is a link into another folder."""
    target = Path(os.path.realpath(path))
    return path.is_symlink() and target.parent != Path(os.path.realpath(path.parent))


def replacing(path: Path, message: Save | Post) -> Ask:
    """Somebody's file stands in the place."""
    target = f", which leads to {os.path.realpath(path)}" if path.is_symlink() else ""
    lines = [f"{printable_path(path)}{printable_path(target)} exists already. Its content is replaced."]
    owner = held_by(path)
    if owner is not None:
        lines.append(f"{printable(owner.user)} on {printable(owner.host)} has it open.")
    return Ask("REPLACE THE FILE?", tuple(lines), (("r", "REPLACE", (Close(), message._replace(overwrite=True))),))


def _linked(path: Path, message: Save) -> Ask:
    target = printable_path(os.path.realpath(path))
    lines = (f"{printable_path(path)} is a link to {target} in another folder.",)
    again = message._replace(linked=True)
    return Ask("WRITE IN ANOTHER FOLDER?", lines, (("w", "WRITE THERE", (Close(), again)),))


def _taken(session: Session, path: Path, message: Save) -> Ask | None:
    """Somebody has taken the program over: a copy, or writing all the same."""
    owner = None if session.guard.lock is None else taken_by(session.guard.lock)
    if owner is None:
        return None
    today = times.now()
    copy = beside(path, "mine", today)
    who = f"{printable(owner.user)} on {printable(owner.host)}"
    lines = (f"{who} has taken {printable(path.name)} over.", f"A copy of yours would be {printable_path(copy.name)}.")
    keep = ("k", "KEEP BOTH", (Close(), Save(copy, leave=message.leave)))
    write = ("w", "WRITE ALL THE SAME", (Close(), message._replace(taken=True)))
    return Ask("TAKEN OVER", lines, (keep, write))


def _changed(desk: Desk, path: Path, message: Save) -> Desk | None:
    """The file is not as it was read: both versions are kept, whichever gets the name."""
    stamp = desk.session.guard.stamp
    now = stamp_of(path)
    if now is None or (stamp is not None and now.same_content(stamp)):
        return None
    today = times.now()
    mine = beside(path, "mine", today)
    name, when, theirs = printable(path.name), times.in_words(times.of(now.changed), today), _read(path)
    title, label = "CHANGED MEANWHILE", "THEIRS"
    told, details = f"{name} was changed by somebody else {when}.", tuple(_differing(desk.session, theirs))
    if stamp is None and theirs is None:
        # nobody need have changed it: it could not be read when it was opened
        title, label = "REPLACE THE FILE?", "THE FILE AS IT IS"
        told, details = f"{name} cannot be read as a program. It was written {when}.", ()
    copy = f"yours to {printable_path(mine.name)}, with which you go on"
    both = f"Both are kept. Which gets the name? The other one is copied: {copy}."
    keep = ("t", label, (Close(), Save(mine, leave=message.leave)))
    yours = ("y", "YOURS", (Close(), message._replace(changed=True)))
    return desk.take(Open(Choose(title, (told, both), (keep, yours), details=details)))


def _read(path: Path) -> Program | None:
    """The program in the file, None where it is none."""
    try:
        return load(path)
    except StoreError:
        return None


def _differing(session: Session, theirs: Program | None) -> Iterator[str]:
    """What was changed in the file since it was opened, and what yours has otherwise."""
    if theirs is None:
        yield UNREADABLE
        return
    yield from shortened(differences(session.saved, theirs) or (AS_OPENED,), FEW)
    if yours := differences(theirs, session.program):
        yield "Against that yours has:"
        yield from shortened(yours, FEW)


def put_theirs_aside(path: Path) -> Path:
    """Copy what stands in the file to a name of its own, which is returned; StoreError if that fails."""
    aside = beside(path, "theirs", times.now())
    try:
        # whole or not at all: no half copy may pass for the other version
        write_data(aside, path.read_bytes())
    except (OSError, StoreError) as error:
        cause = error if isinstance(error, OSError) else error.__cause__
        reason = why(cause) if isinstance(cause, OSError) else str(error)
        raise StoreError(f"Nothing is saved: the other version cannot be copied, {reason}") from error
    return aside


def beside(path: Path, whose: str, today: str) -> Path:
    """A free name such as `part.mine-2025-03-04-140509.toml`."""
    name = f"{path.stem}.{whose}-{times.stamp(today)}"
    free, number = path.with_name(f"{name}{path.suffix}"), 1
    while there(free):
        number += 1
        free = path.with_name(f"{name}-{number}{path.suffix}")
    return free
