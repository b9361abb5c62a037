"""NC PROOF and files: opened, saved, left."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import save
from app.documents.programs import empty_program
from app.painted.desk import Desk
from app.painted.messages import Load
from app.painted.screens.program import ProgramPage
from app.painted.screens.proof import ProofPage
from app.painted.screens.proof_files import ProofBrowse, browsing, opening
from app.painted.session import Session
from tests.app.prover import SQUARE, Prover, square


def test_saving_writes_the_file_and_only_what_was_changed(tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_bytes(SQUARE.replace(b"\n", b"\r\n"))
    prover = Prover.of(file.read_bytes(), "threeblock", file).press("x", "s")
    assert prover.said.startswith("Saved:")
    assert file.read_bytes() == SQUARE.replace(b"\n", b"\r\n").split(b"\r\n", 1)[1]
    assert not prover.page.unsaved
    assert prover.page.fresh
    assert prover.press("u").page.unsaved


def test_saving_under_another_name_asks_before_it_replaces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    other = tmp_path / "other.nc"
    prover = square().press("S", *str(other), "enter")
    assert other.read_bytes() == SQUARE
    assert prover.page.file == other
    other.write_bytes(b"theirs")
    prover.press("s")
    assert "THE FILE HAS CHANGED" in "\n".join(prover.screen())
    prover.press("escape")
    assert other.read_bytes() == b"theirs"
    prover.press("s", "r")
    assert other.read_bytes() == SQUARE


def test_what_cannot_be_written_is_said_and_nothing_is_lost(tmp_path: Path) -> None:
    prover = square("threeblock", tmp_path / "none" / "part.nc").press("x", "s")
    assert "not saved" in prover.said
    assert prover.page.unsaved


def test_leaving_with_changes_is_asked_about() -> None:
    prover = square().press("f8")
    assert prover.desk.exit
    prover = square().press("x", "f8")
    assert "LEAVE?" in "\n".join(prover.screen())
    assert prover.press("escape").desk.exit is False
    assert prover.press("ctrl+q", "l").desk.exit


def test_leaving_offers_to_save_the_file_on_top_alone_and_asks_about_the_others(tmp_path: Path) -> None:
    prover = below(tmp_path).press("ctrl+q", "s")
    assert (tmp_path / "c.nc").read_bytes() != SQUARE
    assert not prover.desk.exit
    assert "LEAVE?" in "\n".join(prover.screen())
    assert "SAVE AND LEAVE" not in "\n".join(prover.screen())
    assert "Ctrl+S on its screen" in " ".join("\n".join(prover.screen()).split())


def test_the_program_screens_open_an_nc_file(tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    file.write_bytes(b"0 BEGIN PGM P MM\n1 END PGM P MM\n")
    desk = Desk(Session.of(empty_program())).take(Load(file))
    assert isinstance(desk.page, ProofPage)
    assert desk.page.control == "klartext"
    assert not desk.press("f8").exit


def test_a_file_is_chosen_from_a_folder(tmp_path: Path) -> None:
    (tmp_path / "b.nc").write_bytes(SQUARE)
    (tmp_path / "a.toml").write_text("format = 1\n")
    session = replace(Session.of(empty_program()), file=tmp_path / "a.toml")
    prover = Prover(Desk(session)).press("f8", "f7", "f7", "f5")
    text = "\n".join(prover.screen())
    assert "b.nc" in text
    assert "a.toml" not in text
    assert isinstance(prover.press("down", "enter").desk.page, ProofPage)
    assert "line 3" not in prover.said


@pytest.mark.parametrize("keys", [("f8",), ("escape", "8"), ("x", "f8"), ("down", "f8")])
def test_nothing_is_opened_where_the_choice_is_given_up(tmp_path: Path, keys: tuple[str, ...]) -> None:
    (tmp_path / "b.nc").write_bytes(SQUARE)
    session = replace(Session.of(empty_program()), file=tmp_path / "a.toml")
    prover = Prover(Desk(session)).press("f8", "f7", "f7", "f5")
    assert isinstance(prover.desk.page, ProofBrowse)
    assert "F8 CANCEL" in "\n".join(prover.screen())
    assert isinstance(prover.press(*keys).desk.page, ProgramPage)
    assert prover.session == session


def test_its_first_softkey_opens(tmp_path: Path) -> None:
    (tmp_path / "b.nc").write_bytes(SQUARE)
    session = replace(Session.of(empty_program()), file=tmp_path / "a.toml")
    prover = Prover(Desk(session)).press("f8", "f7", "f7", "f5", "down", "f1")
    assert prover.page.file == tmp_path / "b.nc"


def below(tmp_path: Path) -> Prover:
    """Two files under proof, the one with a change over the other, which has one too."""
    (tmp_path / "b.nc").write_bytes(SQUARE)
    (tmp_path / "c.nc").write_bytes(SQUARE)
    prover = Prover(Desk(Session.of(empty_program())))
    for name in ("b.nc", "c.nc"):
        prover.desk = opening(tmp_path / name)(prover.desk)
        prover.press("x")
    return prover


@pytest.mark.parametrize(("name", "said"), [("c.nc", "here it is"), ("b.nc", "F8 goes back")])
def test_a_file_stands_on_the_desk_once(tmp_path: Path, name: str, said: str) -> None:
    (tmp_path / "deeper").mkdir()
    prover = below(tmp_path)
    before = prover.desk.pages
    prover.desk = browsing(tmp_path)(prover.desk)
    prover.desk = opening(tmp_path / "deeper" / ".." / name)(prover.desk)
    assert prover.desk.pages == before
    assert f"{name} is open already" in prover.said
    assert said in prover.said


def test_nothing_is_saved_over_a_file_that_stands_below(tmp_path: Path) -> None:
    prover = below(tmp_path).press("S", *["backspace"] * 80, *str(tmp_path / "b.nc"), "enter")
    assert (tmp_path / "b.nc").read_bytes() == SQUARE
    assert "b.nc is open below this screen" in prover.said


def test_what_is_no_file_is_a_sentence(tmp_path: Path) -> None:
    desk = opening(tmp_path)(Desk(Session.of(empty_program())))
    assert "is not opened" in desk.session.said.text


def test_unsaved_lines_are_not_lost_to_another_program(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text('format = 1\nunits = "IN"\n')
    prover = square().press("x")
    desk = prover.desk.take(Load(tmp_path / "a.toml"))
    assert isinstance(desk.page, ProofPage)
    assert "not saved" in desk.session.said.text


def test_an_nc_file_never_takes_the_place_of_a_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    part = tmp_path / "part.toml"
    save(empty_program(), part)
    before = part.read_bytes()
    prover = square().press("S", *str(part), "enter")
    assert "is a program and would be overwritten" in prover.said
    prover.press("r")
    assert part.read_bytes() == before
