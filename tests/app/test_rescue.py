"""A program file that cannot be read any more, with work on it left behind."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.cli.screens import begin
from app.documents.files import load, save
from app.documents.journal_file import journal_path, set_aside
from app.documents.programs import example
from app.painted.keeping import Keeping
from app.painted.screens.decide import Decide
from core.program.file.read import StoreError
from core.program.model import Number
from tests.app.kept import DEAD, TIME, Kept, started


@pytest.fixture
def part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    path = tmp_path / "part.toml"
    save(load(example("pocket")), path)
    return path


def broken(part: Path, own: Path) -> Kept:
    """Work that was left behind, its file cut off in the middle, the program started again."""
    started(own, part).press("tab").type("7").killed()
    part.write_bytes(part.read_bytes()[:100])
    keeping = Keeping(DEAD, own, lambda: TIME)
    from app.painted.desk import Desk

    return Kept(keeping.keep(Desk(begin(part, None))), keeping)


def test_the_work_comes_back_and_what_stands_in_the_file_is_kept(part: Path, tmp_path: Path) -> None:
    operator = broken(part, tmp_path / "own")
    assert isinstance(operator.desk.page, Decide)
    assert "itself cannot be read" in " ".join(operator.part("body").split())
    operator.press("r")
    assert operator.block.tool == Number(7.0)
    assert len(operator.block.segments) == 11
    rest = part.read_bytes()
    operator.press("ctrl+s", "y")
    assert load(part).blocks[0].tool == Number(7.0)
    assert [one.read_bytes() for one in tmp_path.glob("part.theirs-*")] == [rest]


def test_discarded_the_file_stays_as_it_is_until_somebody_decides(part: Path, tmp_path: Path) -> None:
    operator = broken(part, tmp_path / "own").press("d", "y")
    rest = part.read_bytes()
    operator.press("tab").type("3").press("ctrl+s")
    assert part.read_bytes() == rest
    told = " ".join(operator.part("body").split())
    assert "part.toml cannot be read as a program." in told
    assert "somebody else" not in told
    operator.press("t")
    assert part.read_bytes() == rest
    assert operator.session.file is not None
    assert operator.session.file.name.startswith("part.mine-")


def test_what_somebody_else_has_made_unreadable_is_told_as_changed(part: Path, tmp_path: Path) -> None:
    operator = started(tmp_path / "own", part).press("tab").type("3")
    part.write_bytes(b"no program")
    told = " ".join(operator.press("ctrl+s").part("body").split())
    assert "was changed by somebody else" in told
    assert "It is no program any more." in told


def test_opened_from_the_screens_the_work_is_offered_too(part: Path, tmp_path: Path) -> None:
    from app.painted.messages import Load

    started(tmp_path / "own", part).press("tab").type("7").killed()
    part.write_bytes(b"no program")
    operator = started(tmp_path / "own")
    operator.desk = operator.keeping.keep(operator.desk.take(Load(part)))
    assert isinstance(operator.desk.page, Decide)


def test_one_s_own_work_that_was_moved_aside_comes_back_too(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    started(part.parent / "own", part).press("tab").type("7").killed()
    set_aside(journal_path(part), "kept")
    part.write_bytes(b"no program")
    with pytest.raises(StoreError):
        begin(part, None)
    monkeypatch.setattr("app.painted.rescue.user", lambda: DEAD.user)
    assert begin(part, None).file == part


def test_without_work_the_file_s_fault_is_told(part: Path) -> None:
    part.write_bytes(b"no program")
    with pytest.raises(StoreError):
        begin(part, None)
