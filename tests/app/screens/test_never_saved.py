"""Programs that were never saved and of which work was left behind, on the start screen and on OPEN."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.journal_file import SUFFIX, journal_path
from app.painted.keeping import Keeping
from app.painted.survey import facts_of
from tests.app.kept import DEAD, ELSEWHERE, TIME, Kept, asked, started
from tests.app.screens.test_start import at_start, folder, lines, looked, page

__all__ = ["folder"]


@pytest.mark.parametrize("closed", [False, True])
def test_work_left_behind_on_a_program_that_was_never_saved_stands_in_the_list(
    folder: Path, monkeypatch: pytest.MonkeyPatch, *, closed: bool
) -> None:
    own = folder / "own"
    monkeypatch.setattr("app.painted.places.own_folder", lambda: own)
    path = folder / "flap.toml"
    if closed:
        monkeypatch.setattr("os.access", lambda *_: False)
    started(own, path).press("tab").type("7").killed()
    (folder / f".lost.nc{SUFFIX}").write_text("an NC program's own")
    operator = looked(at_start())
    assert [line.split() for line in lines(operator)[3:5]] == [
        ["flap", "not", "saved"],
        ["notch", "2001-09-09", "1", "1", "GOUGE"],
    ]
    assert "Opening it asks whether you want it back" in operator.said
    assert "never saved: flap.toml" in operator.press("f4").part("body")
    back = started(own, path).press("r")
    back.press("ctrl+s").keeping.leave()
    assert facts_of(path).word == "not ready"
    assert [entry.name for entry in page(at_start()).entries].count("flap") == 1


@pytest.mark.parametrize("left", [b"?" * 300, b""])
def test_work_that_cannot_be_read_on_a_program_that_was_never_saved_is_told(
    left: bytes, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.painted.places.own_folder", lambda: folder / "own")
    journal_path(folder / "flap.toml").write_bytes(left)
    operator = looked(at_start())
    if not left:
        assert "flap" not in {entry.name for entry in page(operator).entries}
        return
    assert "flap" in {entry.name for entry in page(operator).entries}
    assert facts_of(folder / "flap.toml").word == "unreadable"
    assert "cannot be read. It is kept" in operator.said
    keeping = Keeping(DEAD, folder / "own", lambda: TIME)
    opened = Kept(keeping.keep(operator.press("enter").desk), keeping)
    assert "There is unsaved work on flap.toml that cannot be read" in asked(opened)


def test_a_program_that_somebody_types_and_has_not_saved_is_open(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = folder / "own"
    monkeypatch.setattr("app.painted.places.own_folder", lambda: own)
    started(own, folder / "flap.toml", ELSEWHERE).press("tab").type("7")
    assert facts_of(folder / "flap.toml").word == "open"
    assert "flap" in {entry.name for entry in page(at_start()).entries}
