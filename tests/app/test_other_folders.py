"""No path outside the chosen folder is written without asking: that of the program, else the current one."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.opened import opened
from app.painted.screens.ask import Ask
from app.painted.session import Session
from tests.app.operator import Operator


@pytest.fixture
def other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder; the program is in `job` beside it."""
    for name in ("job", "other"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path / "other")
    save(load(example("pocket")), tmp_path / "job" / "p.toml")
    return tmp_path / "other"


def at(file: str = "../job/p.toml") -> Operator:
    return Operator(Desk(opened(Path(file))))


def unnamed() -> Operator:
    return Operator(Desk(Session.of(load(example("pocket")))))


WAYS = {"post": ("f8", "f6"), "save": ("f8", "f7", "f3"), "sheet": ("f8", "f7", "f7", "f2")}
"""The keys to each dialog that asks for a name."""
NAMES = {"post": "x.txt", "save": "x.toml", "sheet": "x.txt"}
"""A name that each takes as it is."""


def named(operator: Operator, way: str, name: str) -> Operator:
    return operator.press(*WAYS[way], "delete", *name, "enter")


def files(folder: Path) -> list[str]:
    return sorted(str(one.relative_to(folder)) for one in folder.rglob("*") if one.is_file())


def body(operator: Operator) -> str:
    return "".join(operator.part("body").split())


@pytest.mark.parametrize("way", WAYS)
def test_a_bare_name_is_taken_beside_the_program_and_said_with_its_folder(other: Path, way: str) -> None:
    operator = named(at(), way, NAMES[way])
    assert files(other.parent) == ["job/p.toml", f"job/{NAMES[way]}"]
    assert str(other.parent / "job").replace(" ", "")[:40] in operator.said.replace(" ", "")


@pytest.mark.parametrize("way", WAYS)
def test_a_bare_name_without_a_program_s_file_is_in_the_current_folder(other: Path, way: str) -> None:
    operator = named(unnamed(), way, NAMES[way])
    assert files(other) == [NAMES[way]]
    assert NAMES[way] in operator.said
    assert str(other) not in operator.said.replace(" ", "")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["../{own}", "../other/{own}", "{tmp}/{own}", "../job/link-{own}"])
def test_a_path_outside_is_asked_once_with_the_whole_path(other: Path, way: str, name: str) -> None:
    job = other.parent / "job"
    (job / f"link-{NAMES[way]}").symlink_to(other.parent / "led.txt")
    before = files(other.parent)
    name = name.format(tmp=other.parent, own=NAMES[way])
    target = other.parent / "led.txt" if "link" in name else (other / name).resolve()
    operator = named(at(), way, name)
    assert isinstance(operator.desk.page, Ask)
    assert "WRITE IN ANOTHER FOLDER?" in operator.part("header")
    assert "".join(str(target).split()) in body(operator)
    assert files(other.parent) == before
    operator.press("escape")
    assert files(other.parent) == before
    operator.press("enter", "w")
    assert not isinstance(operator.desk.page, Ask)
    assert target.exists()


@pytest.mark.parametrize("way", WAYS)
def test_a_file_that_stands_outside_is_asked_about_in_the_same_question(other: Path, way: str) -> None:
    (other / NAMES[way]).write_text("somebody's")
    operator = named(at(), way, f"../other/{NAMES[way]}")
    assert "existsalready.Itscontentisreplaced." in body(operator)
    operator.press("w")
    assert (other / NAMES[way]).read_text() != "somebody's"


@pytest.mark.parametrize("way", WAYS)
def test_a_folder_inside_the_program_s_is_not_outside(other: Path, way: str) -> None:
    (other.parent / "job" / "nc").mkdir()
    named(at(), way, f"../job/nc/{NAMES[way]}")
    assert (other.parent / "job" / "nc" / NAMES[way]).exists()


def test_the_name_that_is_offered_is_beside_the_program(other: Path) -> None:
    at().press(*WAYS["post"], "enter")
    assert files(other.parent) == ["job/p.nc", "job/p.toml"]


def test_saved_elsewhere_that_folder_is_the_chosen_one(other: Path) -> None:
    operator = named(at(), "save", "../other/q.toml").press("w")
    named(operator, "post", "q.nc")
    assert files(other.parent) == ["job/p.toml", "other/q.nc", "other/q.toml"]


def test_an_nc_file_under_proof_is_saved_beside_itself(other: Path) -> None:
    from app.painted.screens.proof_files import opening

    (other.parent / "job" / "a.nc").write_text("G0 X1\n")
    operator = Operator(opening(Path("../job/a.nc"))(Desk(unnamed().session)))
    operator.press("S", "delete", *"b.nc", "enter")
    assert files(other.parent) == ["job/a.nc", "job/b.nc", "job/p.toml"]
    operator.press("S", "delete", *"../other/c.nc", "enter")
    assert "WRITE IN ANOTHER FOLDER?" in operator.part("header")
    operator.press("w")
    assert files(other) == ["c.nc"]
