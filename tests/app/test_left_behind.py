"""Work of others, and work that was set aside: it is told, kept, and offered to whoever typed it."""

from __future__ import annotations

import errno
import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.journal_file import journal_path
from app.documents.lock import Owner, myself
from app.painted.screens.contour import Contour
from app.painted.screens.decide import Decide
from core.program.model import Number
from tests.app.kept import DEAD, ELSEWHERE, asked, names, started

BOB = replace(DEAD, user="bob", pid=DEAD.pid + 1)
ALIVE = replace(myself("2025-03-04T06:01:00+01:00"), user="ann")
"""A program of ann's that still runs."""


def hide(monkeypatch: pytest.MonkeyPatch, hidden: Path) -> None:
    """Make one file one that we may not read, whatever it is called later."""
    inode, whole = hidden.stat().st_ino, Path.read_bytes

    def read(path: Path) -> bytes:
        if path.stat().st_ino == inode:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
        return whole(path)

    monkeypatch.setattr(Path, "read_bytes", read)


def test_the_journal_may_be_read_by_whoever_may_read_the_program(own: Path, part: Path) -> None:
    for mode in (0o660, 0o644, 0o600):
        part.chmod(mode)
        operator = started(own, part).press("tab").type("7")
        assert journal_path(part).stat().st_mode & 0o777 == mode
        operator.keeping.leave()


def test_work_of_another_is_offered_and_stays_kept_for_its_owner(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7", "", "3")
    first.killed()
    bob = started(own, part, BOB)
    assert "Work on part.toml by ann" in asked(bob)
    assert "It stays kept for ann, whatever you answer." in asked(bob)
    assert "DON'T RESTORE" in bob.part("softkeys")
    bob.press("d", "y")
    assert "Kept for ann: .part.toml.cutcomp-journal.kept-1" in bob.said
    bob.press("tab").type("9").press("ctrl+s", "ctrl+q")
    again = started(own, part)
    told = asked(again)
    assert "The file was written since" in told
    assert "TOOL 7, was 9" in told
    assert again.press("r").session.history == first.session.history


def test_work_of_another_that_was_restored_and_given_up_is_still_its_owners(own: Path, part: Path) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    started(own, part, BOB).press("r", "ctrl+q", "l")
    assert started(own, part).press("r").session.history == first.session.history


def test_work_of_another_that_was_restored_and_saved_is_not_asked_about(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    started(own, part, BOB).press("r", "ctrl+s", "ctrl+q")
    assert isinstance(started(own, part).desk.page, Contour)
    assert [name for name in names(part) if "journal" in name] == []


def test_what_is_kept_for_another_is_told_and_not_asked(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    started(own, part, BOB).press("d", "y").keeping.leave()
    bob = started(own, part, BOB)
    assert isinstance(bob.desk.page, Contour)
    assert "Unsaved work of ann, at 06:05, is kept in .part.toml.cutcomp-journal.kept-1" in bob.said


def test_work_that_may_not_be_read_is_told_and_never_lost(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    with monkeypatch.context() as patch:
        hide(patch, journal_path(part))
        patch.setattr(os, "getuid", lambda: 4242)
        bob = started(own, part, BOB)
        told = asked(bob)
        assert "has unsaved work on part.toml, from" in told
        assert "You may not read it." in told
        assert ".part.toml.cutcomp-journal" in told
        bob.press("g", "tab").type("9")
        assert ".part.toml.cutcomp-journal.kept-1" in bob.said
        bob.press("ctrl+s", "ctrl+q")
        assert ".part.toml.cutcomp-journal.kept-1" in started(own, part, BOB).said
    again = started(own, part)
    assert "TOOL 7, was 9" in asked(again)
    assert again.press("r").session.history == first.session.history


def test_a_damaged_beginning_is_told_with_the_files_name_and_kept(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7").killed()
    journal = journal_path(part)
    data = b"?" + journal.read_bytes()[1:]
    journal.write_bytes(data)
    operator = started(own, part)
    told = asked(operator)
    assert "There is unsaved work on part.toml that cannot be read: its beginning is damaged." in told
    assert journal.name in told
    operator.press("g", "tab").type("9")
    assert "journal.kept-1" in operator.said
    operator.press("ctrl+s", "ctrl+q")
    again = started(own, part)
    assert "journal.kept-1" in asked(again)
    again.press("p")
    assert "journal.discarded-1" in again.said
    assert [part.with_name(name).read_bytes() for name in names(part) if "journal" in name] == [data]
    again.press("ctrl+q")
    assert isinstance(started(own, part).desk.page, Contour)


def test_a_journal_of_no_bytes_is_nothing(own: Path, part: Path) -> None:
    journal_path(part).touch()
    operator = started(own, part)
    assert isinstance(operator.desk.page, Contour)
    operator.press("tab").type("9").press("ctrl+s", "ctrl+q")
    assert names(part) == []


def typed_on(own: Path, part: Path, answer: str) -> None:
    """One login, two programs: the second takes over and answers, the first one types on and dies."""
    first = started(own, part, ALIVE).press("tab").type("7")
    second = started(own, part, DEAD).press("t", *answer)
    first.press("tab").type("1.25")
    first.killed()
    # the program that is told to run has died
    data = b"".join(one.read_bytes() for one in part.parent.glob(".part*theirs*"))
    assert b"1.25" in data
    second.press("up" if answer == "r" else "tab").type("8").press("ctrl+s", "ctrl+q")


@pytest.mark.parametrize("answer", ["r", "dy"])
def test_what_was_typed_on_after_a_take_over_is_offered(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    typed_on(own, part, answer)
    monkeypatch.setattr("app.painted.places.alive", lambda owner: owner.pid not in (ALIVE.pid, DEAD.pid))
    monkeypatch.setattr("app.painted.recovery.alive", lambda owner: owner.pid not in (ALIVE.pid, DEAD.pid))
    again = started(own, part)
    assert "TOOL 7, was 8" in asked(again)
    again.press("r")
    assert again.session.history.undo_count == 2


@pytest.mark.parametrize("answer", ["r", "dy"])
def test_nothing_typed_on_after_a_take_over_is_nothing_to_offer(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    first = started(own, part, ALIVE).press("tab").type("7")
    started(own, part, DEAD).press("t", *answer, "tab").type("8").press("ctrl+s", "ctrl+q")
    first.killed()
    monkeypatch.setattr("app.painted.places.alive", lambda _: False)
    assert isinstance(started(own, part).desk.page, Contour)


def test_left_in_order_after_a_take_over_nothing_stays(own: Path, part: Path) -> None:
    first = started(own, part, ALIVE).press("tab").type("7")
    second = started(own, part, DEAD).press("t", "r")
    first.press("up").type("6").press("ctrl+q", "l")
    second.press("ctrl+q", "l")
    assert [name for name in names(part) if "journal" in name] == []


def test_a_program_on_another_host_that_was_taken_over_is_offered_to_its_user(own: Path, part: Path) -> None:
    """It may be alive; its user is asked as soon as it is his again."""
    started(own, part, ELSEWHERE).press("tab").type("7")
    ann = started(own, part, DEAD).press("t", "r", "up").type("8").press("ctrl+s", "ctrl+q")
    assert ann.desk.exit
    assert [name for name in names(part) if "journal" in name] == [".part.toml.cutcomp-journal.kept-1"]


def full(folder: Path, monkeypatch: pytest.MonkeyPatch, error: int = errno.ENOSPC) -> None:
    """From now on the disk of this folder takes nothing; others do."""
    whole = os.write
    folder = folder.resolve()

    def write(handle: int, data: bytes) -> int:
        if Path(f"/proc/self/fd/{handle}").readlink().parent == folder:
            raise OSError(error, os.strerror(error))
        return whole(handle, data)

    monkeypatch.setattr(os, "write", write)


@pytest.mark.parametrize("error", [errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO])
def test_where_the_programs_folder_takes_nothing_the_work_is_kept_elsewhere(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch, error: int
) -> None:
    with monkeypatch.context() as patch:
        full(part.parent, patch, error)
        first = started(own, part).press("tab").type("7")
        assert "The folder of part.toml takes nothing: until it is saved, the work is kept in" in first.said
        first.press("tab").type("1.25")
        first.killed()
        assert [name for name in names(part) if "journal" in name] == []
    again = started(own, part)
    assert "TOOL 7, was 1" in asked(again)
    assert again.press("r").session.history == first.session.history
    again.press("ctrl+s", "ctrl+q")
    assert list(own.iterdir()) == []
    assert names(part) == []


def test_a_disk_that_fills_up_later_loses_nothing_either(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(own, part).press("tab").type("7")
    with monkeypatch.context() as patch:
        full(part.parent, patch)
        first.press("tab").type("1.25")
        assert "takes nothing" in first.said
        assert [name for name in names(part) if "journal" in name] == []
    first.killed()
    again = started(own, part)
    assert again.press("r").session.history == first.session.history
    assert again.block.tool == Number(7.0)


def test_ended_by_a_signal_what_could_not_be_written_is_tried_once_more(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nothing(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    first = started(own, part)
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", nothing)
        first.press("tab").type("7")
        assert "A crash would lose this" in first.said
    first.keeping.close()
    assert started(own, part).press("r").session.history == first.session.history


def test_a_folder_in_which_nothing_may_be_renamed_has_the_next_work_elsewhere(
    own: Path, part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = started(own, part).press("tab").type("7")
    first.killed()
    whole = Path.rename

    def rename(path: Path, target: Path) -> Path:
        if path.parent == part.parent:
            raise PermissionError(errno.EPERM, "sticky")
        return whole(path, target)

    monkeypatch.setattr(Path, "rename", rename)
    bob = started(own, part, BOB).press("d", "y")
    assert isinstance(bob.desk.page, Contour)
    bob.press("tab").type("9").killed()
    assert len(list(own.iterdir())) == 1
    again = started(own, part)
    assert "TOOL 7" in asked(again)
    assert again.press("r").session.history == first.session.history


def test_the_copy_of_a_damaged_end_is_named(own: Path, part: Path) -> None:
    started(own, part).press("tab").type("7", "", "3").killed()
    journal = journal_path(part)
    lines = journal.read_bytes().splitlines(keepends=True)
    journal.write_bytes(b"".join([*lines[:2], b"?" + lines[2][1:], lines[2]]))
    operator = started(own, part).press("r")
    [copy] = [name for name in names(part) if "damaged" in name]
    assert copy in operator.said


def test_nobody_of_this_name(own: Path, part: Path) -> None:
    """A journal's owner is its writer, whoever the file belongs to."""
    started(own, part, Owner("carl", DEAD.host, DEAD.pid, "", "")).press("tab").type("7").killed()
    operator = started(own, part)
    assert isinstance(operator.desk.page, Decide)
    assert load(part) == operator.session.program
