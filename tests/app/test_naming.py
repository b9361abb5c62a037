"""Names that no file can have are told in a sentence, on every screen that takes a name."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from app.documents.files import load
from app.documents.folders import folder_in_words
from app.documents.naming import as_program, is_folder, program_named, typed, with_suffix
from app.documents.programs import example
from app.painted.desk import Desk
from app.painted.opened import opened
from app.painted.screens.browse import listed
from core.pipeline.derive import derive
from tests.app.operator import Operator

LONG = "中" * 100
SCREENS = {
    "save as": ("f8", "ctrl+s"),
    "post": ("f8", "f6"),
    "sheet": ("f8", "f7", "f7", "f2"),
    "open": ("ctrl+o",),
    "tool table": ("f6", "f3"),
}


def test_a_home_that_is_nobodys_stays_as_it_is_typed() -> None:
    assert typed(" ~ ") == Path.home()
    assert typed("~nobody_at_all/x") == Path("~nobody_at_all/x")


def test_a_suffix_where_there_is_none() -> None:
    assert with_suffix(Path("part"), ".nc") == Path("part.nc")
    assert with_suffix(Path("part.tap"), ".nc") == Path("part.tap")
    assert with_suffix(Path("/"), ".nc") == Path("/")
    assert with_suffix(Path(LONG), ".nc") == Path(f"{LONG}.nc")
    assert with_suffix(Path("bracket 1.5"), ".nc") == Path("bracket 1.5.nc")
    assert with_suffix(Path("part.theirs-2026-01-02"), ".nc") == Path("part.theirs-2026-01-02.nc")
    assert not is_folder(Path(LONG))


@pytest.mark.parametrize("name", ["bracket 1.5", "part.nc", "part.", "part"])
def test_a_program_ends_in_toml_or_no_list_would_show_it(name: str) -> None:
    assert as_program(Path(name)) == program_named(Path(name)) == Path(f"{name}.toml")


def test_a_program_under_another_name_is_found_and_saved_under_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "part.cfg"
    path.write_bytes(example("pocket").read_bytes())
    assert program_named(Path("part.cfg")) == Path("part.cfg")
    operator = Operator(Desk(opened(path)))
    operator.press("f8", "f7", "f3", "enter")
    assert operator.said == "Saved: part.cfg"
    assert [one.name for one in tmp_path.iterdir()] == ["part.cfg"]


def test_the_name_of_a_program_with_a_point_in_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    operator = Operator.at(load(example("pocket"))).press("f8", "ctrl+s")
    assert f"Anamewithoutafoldergoesinto{tmp_path}" in "".join(operator.part("body").split())
    operator.press(*("space" if one == " " else one for one in "bracket 1.5"), "enter")
    assert operator.said == "Saved: bracket 1.5.toml"
    assert (tmp_path / "bracket 1.5.toml").exists()
    assert "bracket 1.5" in operator.screen()[1]


def test_a_bare_name_leads_beside_the_file_that_is_open(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for file, folder in ((Path("p.toml"), tmp_path), (Path("job/p.toml"), tmp_path / "job"), (Path("/x/p.toml"), "/x")):
        assert folder_in_words(file) == str(folder)


def test_a_suffix_in_capitals_is_one_and_is_listed(tmp_path: Path) -> None:
    path = tmp_path / "x.TOML"
    assert as_program(path) == path
    path.write_bytes(example("pocket").read_bytes())
    assert "x.TOML" in [one.name for one in listed(tmp_path)]


@pytest.mark.parametrize(
    ("screen", "text"), product(SCREENS, (LONG, "a" * 199, "~nobody_at_all", "~", "/", "..", "a.toml/b"))
)
def test_a_name_that_cannot_be_one_ends_nothing(
    screen: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "a.toml").write_text("")
    operator = Operator.at().press(*SCREENS[screen], *text)
    operator.screen()
    operator.press("enter")
    assert operator.screen()


def test_what_is_wrong_with_a_name_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert "the name is too long" in Operator.at().press("f8", "ctrl+s", *LONG, "enter").said
    assert "this is a folder" in Operator.at().press("f8", "ctrl+s", "/", "enter").said
    for keys in (("f6",), ("f6", "f5")):
        operator = Operator.at(load(example("pocket")))
        operator.desk = operator.desk.knowing(derive(operator.session.program))
        assert "this is a folder" in operator.press("f8", *keys, "delete", "/", "f1").said
    assert "no such file" in Operator.at().press("f8", "ctrl+s", *"~nobody_at_all/x", "enter").said
