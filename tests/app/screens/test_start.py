"""The start screen by keys alone: lists, folders, names from the disk, and what is found out behind it."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.files import load, save
from app.documents.programs import empty_program, example
from app.painted.desk import Desk
from app.painted.screens.browse import listed
from app.painted.screens.contour import Contour
from app.painted.screens.start import Entry, Group, StartPage
from app.painted.session import Session
from app.painted.settings import Settings, taken_up
from app.painted.starting import begun, first_folder
from app.painted.survey import Facts, facts_of
from core.units import Unit
from tests.app.kept import ELSEWHERE, started
from tests.app.operator import Operator


def at_start(settings: Settings | None = None) -> Operator:
    """An operator who called the program without a file."""
    return Operator(begun(taken_up(Desk(Session.of(empty_program())), settings or Settings(), "")))


def page(operator: Operator) -> StartPage:
    assert isinstance(operator.desk.page, StartPage)
    return operator.desk.page


def looked(operator: Operator) -> Operator:
    """Every file looked at, as it happens behind the screen."""
    while (path := page(operator).wanted) is not None:
        known = page(operator).knowing(facts_of(path))
        operator.desk = replace(operator.desk, pages=(*operator.desk.pages[:-1], known))
    return operator


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name in ("notch", "plate-mm"):
        save(load(example(name)), tmp_path / f"{name}.toml")
        os.utime(tmp_path / f"{name}.toml", (1e9, 1e9))
    (tmp_path / "other.toml").write_text("format = 1\nx = 1")
    (tmp_path / "sub").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def lines(operator: Operator) -> list[str]:
    return [line[2:] for line in operator.part("body").splitlines()]


@pytest.mark.usefixtures("folder")
def test_names_dates_blocks_tools_and_verdicts() -> None:
    operator = at_start()
    assert any(line.startswith("notch") and line.endswith("...") for line in lines(operator))
    looked(operator)
    shown = {line.split()[0]: " ".join(line.split()[1:]) for line in lines(operator)[2:6]}
    assert shown["notch"] == "2001-09-09 1 1 GOUGE"
    assert shown["plate-mm"] == "2001-09-09 1 1 2 clean"
    assert shown["other"].endswith("unreadable")


def test_nothing_is_read_from_a_program_before_the_screen_stands(folder: Path) -> None:
    operator = at_start()
    assert page(operator).facts == {}
    assert page(operator).wanted == folder / "notch.toml"
    assert operator.press("down").desk.page is not None
    assert page(operator).wanted == folder / "other.toml"


@pytest.mark.usefixtures("folder")
def test_why_a_file_is_no_program_stands_on_the_prompt_line() -> None:
    operator = looked(at_start()).press("o")
    assert "other.toml" in operator.said
    assert operator.said.startswith("! ")


def test_enter_opens_and_folders_are_walked(folder: Path) -> None:
    operator = at_start().press("s")
    operator.press("enter")
    assert page(operator).folder == folder / "sub"
    operator.press("left")
    assert page(operator).folder == folder
    assert page(operator).entry is not None
    assert page(operator).entry.name == "sub"
    operator.press("home", "down", "enter")
    assert operator.session.file == folder / "notch.toml"
    assert isinstance(operator.desk.page, Contour)


@pytest.mark.usefixtures("folder")
def test_an_example_has_no_file_to_overwrite() -> None:
    operator = at_start().press("f", "enter")
    assert operator.session.file is None
    assert operator.session.program == load(example("flange"))


def test_recent_programs_stand_first_and_a_lost_one_says_so(folder: Path) -> None:
    settings = Settings((str(folder / "gone.toml"), str(folder / "notch.toml")))
    operator = looked(at_start(settings))
    assert lines(operator)[1].strip() == "ECENT"
    assert lines(operator)[2].split() == ["gone", "gone"]
    assert "not there any more" in operator.press("home").said


def test_recent_programs_of_one_name_are_told_apart_by_their_folders(folder: Path) -> None:
    names = ("north/op1/part", "south/op1/part", "south/op2/part", "south/op2/lid")
    operator = at_start(Settings(tuple(str(folder / f"{name}.toml") for name in names)))
    told = [line[:24].strip(" >") for line in lines(operator)[2:6]]
    assert told == ["part (north/op1)", "part (south/op1)", "part (op2)", "lid"]
    assert page(operator.press("p")).entry == page(operator).entries[1]


def test_one_name_in_a_folder_and_in_one_below_it_is_told_apart(folder: Path) -> None:
    near, far = folder / "part.toml", folder / folder.name / "part.toml"
    names = [entry.name for entry in page(at_start(Settings((str(near), str(far))))).entries[:2]]
    assert len(set(names)) == 2
    assert [entry.name for entry in page(at_start(Settings(("/part.toml", "/a/part.toml")))).entries[:2]] == [
        "part (/)",
        "part (a)",
    ]


@pytest.mark.usefixtures("folder")
def test_a_new_program_in_the_unit_that_was_chosen() -> None:
    operator = at_start().press("f3")
    assert operator.desk.settings.unit is Unit.MM
    assert operator.part("softkeys").split("F2 ")[1].split()[:4] == ["NEW", "PROGRAM", "│", "(MM)"]
    assert "INCH FOR NEW" in operator.part("softkeys")
    assert operator.press("f2").session.program.unit is Unit.MM
    assert isinstance(operator.desk.page, Contour)


def test_control_characters_in_names_never_reach_the_terminal(folder: Path) -> None:
    (folder / "a\x1b[2Jb\n.toml").write_text("x = 1")
    (folder / "d\x07ir").mkdir()
    operator = looked(at_start())
    for key in ("home", *["down"] * 12):
        assert all(line.isprintable() for line in operator.press(key).screen())


def test_a_name_that_is_no_unicode_does_not_stop_it(folder: Path) -> None:
    (folder / os.fsdecode(b"\xff\xfe.toml")).write_text("x = 1")
    operator = looked(at_start())
    assert all(line.isprintable() for line in operator.screen())


def test_a_folder_that_cannot_be_read_is_a_sentence(folder: Path) -> None:
    operator = at_start()
    (folder / "sub").rmdir()
    operator.press("s", "enter")
    assert "cannot be shown" in operator.said
    assert page(operator).folder == folder


def test_the_last_folder_where_this_one_has_no_program(folder: Path) -> None:
    assert first_folder(Settings(folder="/")) == folder
    os.chdir(folder / "sub")
    assert first_folder(Settings(folder=str(folder))) == folder
    assert first_folder(Settings(folder="/not/there")) == folder / "sub"


@pytest.mark.usefixtures("folder")
def test_from_the_program_screen_and_back() -> None:
    operator = Operator.at().press("f8", "f7", "f7", "f1")
    assert isinstance(operator.desk.page, StartPage)
    assert not isinstance(operator.press("f8").desk.page, StartPage)
    assert not operator.desk.exit


@pytest.mark.usefixtures("folder")
def test_the_first_screens_exit_leaves() -> None:
    assert at_start().press("escape", "8").desk.exit


def test_a_known_file_is_not_derived_again_until_it_changes(folder: Path) -> None:
    first = facts_of(folder / "notch.toml")
    assert facts_of(folder / "notch.toml", first) is first
    save(load(example("pocket")), folder / "notch.toml")
    assert facts_of(folder / "notch.toml", first).word == "uncut"
    assert facts_of(folder / "none.toml").word == "gone"


def test_work_left_behind_on_a_named_file_stands_in_the_list(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = tmp_path / "own"
    monkeypatch.setattr("app.painted.places.own_folder", lambda: own)
    path = folder / "notch.toml"
    started(own, path).press("tab").type("7").killed()
    operator = looked(at_start())
    assert next(line for line in lines(operator) if line.startswith("notch")).endswith(" 1 1       not saved")
    assert "Opening it asks whether you want it back" in operator.said
    left = facts_of(path)
    assert facts_of(path, left) == left
    started(own, path).press("d", "y").keeping.leave()
    assert facts_of(path, left).word == "GOUGE"


def test_work_that_goes_on_elsewhere_is_none_that_was_left(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = folder / "own"
    monkeypatch.setattr("app.painted.places.own_folder", lambda: own)
    started(own, folder / "notch.toml", ELSEWHERE).press("tab").type("7")
    assert facts_of(folder / "notch.toml").word == "GOUGE"


def test_long_names_keep_what_tells_them_apart(folder: Path) -> None:
    for end in ("left", "right"):
        save(load(example("notch")), folder / f"customer-4711-bracket-pocket-{end}.toml")
    assert len({line[:22] for line in lines(at_start()) if line.startswith("customer")}) == 2
    listing = at_start().press("f4").part("body")
    assert "pocket-left.toml" in listing
    assert "pocket-right.toml" in listing


def test_facts_of_a_screen_that_is_gone_are_dropped() -> None:
    assert StartPage().knowing(Facts(Path("a"))).unseen == ()


def test_toml_files_that_are_no_programs_are_not_listed(folder: Path) -> None:
    (folder / "pyproject.toml").write_text("[project]\nname = 'x'\n")
    assert "pyproject" not in {entry.name for entry in page(at_start()).entries}
    assert "pyproject.toml" not in {item.name for item in listed(folder)}
    assert "notch.toml" in {item.name for item in listed(folder)}


def test_opening_one_says_what_it_is_and_advises_nothing(folder: Path) -> None:
    (folder / "pyproject.toml").write_text("[project]\nname = 'x'\n")
    operator = at_start().press("f4").type("pyproject.toml")
    said = operator.session.said
    assert said is not None
    assert "not a cutcomp program" in said.text
    assert "remove" not in said.text


def test_the_cursor_starts_on_a_program(folder: Path) -> None:
    assert page(at_start()).entry == Entry(Group.FOLDER, folder / "notch.toml", "notch")
    assert page(at_start().press("s", "enter", "left", "home")).row == 0


def test_without_programs_here_the_cursor_starts_on_the_first_example(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "pyproject.toml").write_text("[project]\n")
    monkeypatch.chdir(tmp_path)
    entry = page(at_start()).entry
    assert entry is not None
    assert entry.group is Group.EXAMPLE


def test_walking_into_a_folder_goes_to_its_first_program(folder: Path) -> None:
    save(load(example("notch")), folder / "sub" / "part.toml")
    entry = page(at_start().press("s", "enter")).entry
    assert entry is not None
    assert entry.name == "part"
