"""Settings: what is read, what is passed over, what is written and when."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.documents.files import save
from app.painted.settings import MOST, Keeper, Settings, dumps, load, loads
from core.units import Unit
from tests.app.operator import Operator

PATHS = st.text(st.characters(exclude_categories=("Cs", "Cc", "Zl", "Zp", "Zs", "Cf", "Cn", "Co")), max_size=30)


@given(
    st.lists(PATHS.map(lambda name: f"/{name}"), max_size=MOST, unique=True),
    st.sampled_from(["", "braille", "block", "ascii"]),
    st.sampled_from(list(Unit)),
)
def test_what_is_written_is_read_back(recent: list[str], mode: str, unit: Unit) -> None:
    settings = Settings(tuple(recent), mode, unit, "/a")
    assert loads(dumps(settings)) == settings


def test_the_last_used_stands_first_once_and_only_so_many_stay() -> None:
    settings = Settings()
    for number in range(MOST + 3):
        settings = settings.using(Path(f"/shop/{number}.toml"))
    settings = settings.using(Path("/shop/9.toml"))
    assert settings.recent[0] == "/shop/9.toml"
    assert len(settings.recent) == len(set(settings.recent)) == MOST
    assert settings.folder == "/shop"


@pytest.mark.parametrize("name", ["a\x1b[2J.toml", "a\nb.toml", "a\udcff.toml"])
def test_a_name_no_file_of_settings_can_hold_is_not_remembered(name: str) -> None:
    assert Settings().using(Path("/shop") / name) == Settings()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "recent = 3",
        'recent = [1, "relative", "/a\\u001b[2J"]',
        'mode = "neon"',
        "unit = []",
        "folder = 1",
        "unit = {}",
    ],
)
def test_what_is_of_no_use_is_passed_over(text: str) -> None:
    assert loads(text) == Settings()


@pytest.mark.parametrize("data", [b"recent = [", b"\xff\xfe\x00", b"a = 1\na = 2", b"x = 0x"])
def test_a_file_that_cannot_be_read_gives_the_usual_ones_and_a_sentence(tmp_path: Path, data: bytes) -> None:
    file = tmp_path / "settings.toml"
    file.write_bytes(data)
    settings, trouble = load(file)
    assert settings == Settings()
    assert trouble.endswith("The usual ones hold.")
    assert load(tmp_path)[1]
    assert load(tmp_path / "none.toml") == (Settings(), "")


def test_they_are_written_when_they_change_and_only_then(tmp_path: Path) -> None:
    keeper = Keeper(tmp_path / "deep" / "settings.toml")
    operator = Operator.at()
    operator.desk = keeper.keep(operator.desk)
    assert keeper.path is not None
    assert not keeper.path.exists()
    operator.desk = keeper.keep(operator.press("f7", "m").desk)
    assert load(keeper.path)[0].mode == "block"
    keeper.path.unlink()
    operator.desk = keeper.keep(operator.press("down").desk)
    assert not keeper.path.exists()


def test_a_file_that_was_opened_or_saved_is_recent(tmp_path: Path) -> None:
    keeper = Keeper()
    operator = Operator.at()
    file = tmp_path / "part.toml"
    operator.desk = replace(operator.desk, session=replace(operator.session, file=file))
    assert keeper.keep(operator.desk).settings.recent == ()
    save(operator.session.program, file)
    assert keeper.keep(operator.desk).settings.recent == (str(file),)


def test_a_disk_that_takes_nothing_is_told_once_and_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    keeper = Keeper(tmp_path / "file" / "settings.toml")
    operator = Operator.at().press("f7", "m")
    operator.desk = replace(operator.desk, session=operator.session.quiet())
    operator.desk = keeper.keep(operator.desk)
    assert "Settings are not kept" in operator.said
    operator.desk = keeper.keep(operator.press("m").desk)
    assert "not kept" not in operator.said
