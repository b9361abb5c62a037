"""Changes of NC programs that were left behind by others, kept elsewhere, or set aside."""

from __future__ import annotations

import errno
import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.journal_file import journal_path
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.screens.decide import Decide
from app.painted.screens.proof_files import browsing
from app.painted.session import Session
from tests.app.kept import DEAD, TIME
from tests.app.test_nc_keeping import ME, TEXT, Typist, asked, typist

BOB = replace(DEAD, user="bob")


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "part.nc"
    path.write_bytes(TEXT)
    monkeypatch.setattr("app.painted.places.own_folder", lambda: tmp_path / "own")
    return path


def journals(file: Path) -> list[str]:
    return sorted(one.name for one in file.parent.glob(".part*journal*"))


def test_changes_of_another_stay_kept_for_him(file: Path) -> None:
    typist(file).press("x").killed()
    bob = typist(file, BOB)
    assert "Changes of part.nc by ann were not saved." in asked(bob).lines[0]
    assert "They stay kept for ann, whatever you answer." in asked(bob).lines
    bob.press("d", "y")
    assert "Kept for ann: .part.nc.cutcomp-journal.kept-1" in bob.said
    bob.press("down", "x", "s", "f8")
    again = typist(file, ME)
    assert "The file was written since: by somebody else, or by this program just before its end." in asked(again).lines
    again.press("r")
    assert again.texts == ["G0 X1.", "\xb0 M30"]
    again.press("s")
    assert journals(file) == []


def test_changes_of_another_restored_and_given_up_are_still_his(file: Path) -> None:
    typist(file).press("x").killed()
    bob = typist(file, BOB).press("r")
    assert bob.texts == ["G0 X1.", "\xb0 M30"]
    bob.press("f8", "l")
    assert typist(file, ME).press("r").texts == ["G0 X1.", "\xb0 M30"]


def test_what_is_kept_for_another_is_told(file: Path) -> None:
    typist(file).press("x").killed()
    typist(file, BOB).press("d", "y")
    bob = typist(file, BOB)
    assert not isinstance(bob.desk.page, Decide)
    assert "Unsaved work of ann" in bob.said


def test_where_the_folder_takes_nothing_the_changes_are_kept_elsewhere(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = os.write

    def write(handle: int, data: bytes) -> int:
        if Path(f"/proc/self/fd/{handle}").readlink().parent == file.parent:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return whole(handle, data)

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", write)
        one = typist(file).press("x")
        assert "The folder of part.nc takes nothing" in one.said
        one.killed()
    assert journals(file) == []
    again = typist(file, ME).press("r")
    assert again.texts == ["G0 X1.", "\xb0 M30"]
    again.press("s")
    assert list((file.parent / "own").iterdir()) == []


def test_discarded_changes_come_back_by_keys(file: Path) -> None:
    typist(file).press("x").killed()
    typist(file, ME).press("d", "y", "f8")
    one = chosen(file)
    assert "LEAVE IT" in one.part("softkeys")
    one.press("r")
    assert one.texts == ["G0 X1.", "\xb0 M30"]
    assert journal_path(file).exists()


def test_a_file_that_is_gone_comes_back_from_its_copy(file: Path) -> None:
    typist(file).press("x").killed()
    typist(file, ME).press("d", "y", "f8")
    file.unlink()
    one = chosen(file)
    assert "The file itself is gone: saving makes it anew." in asked(one).lines
    one.press("r", "s")
    assert file.read_bytes() == b"G0 X1.\r\n\xb0 M30\r\n"


def test_a_text_without_lines_is_not_saved_while_its_file_is_gone(file: Path) -> None:
    file.write_bytes(b"M30\n")
    typist(file).press("x").killed()
    typist(file, ME).press("d", "y", "f8")
    file.unlink()
    one = chosen(file).press("r")
    assert one.texts == []
    assert one.page.unsaved


def chosen(file: Path) -> Typist:
    """The list of NC files, and down to the discarded work."""
    one = Typist(browsing(file.parent)(Desk(Session.of(empty_program()))), typist_keeping(file))
    rows = one.part("body").splitlines()[1:]
    row = next(row for row, line in enumerate(rows) if "discarded work" in line)
    assert "part.nc" in rows[row]
    return one.press(*["down"] * row, "enter")


def typist_keeping(file: Path):
    from app.painted.nc_keeping import NcKeeping

    return NcKeeping(ME, file.parent / "own", lambda: TIME)


def test_typed_on_after_a_take_over_the_changes_are_offered(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = typist(file, ME).press("x")
    second = typist(file, replace(DEAD, pid=DEAD.pid + 1)).press("t", "x")
    first.press("x")
    first.killed()
    second.press("s", "f8")
    monkeypatch.setattr("app.painted.nc_recovery.alive", lambda _: False)
    assert typist(file).press("r").texts == ["\xb0 M30"]
