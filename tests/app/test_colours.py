"""Focus, errors and tags are seen in sixteen colours and in none."""

from __future__ import annotations

import pytest
from rich.color import Color
from rich.style import Style

from app.driver import few_colours
from app.widgets.looks import FEW, MANY, style_of
from app.widgets.painted import Rows
from app.widgets.rows import Look
from tests.app.pilots import app_on, loaded

EVERY = {"ansi": (True, False), "no colour": (False, True), "full": (False, False)}


@pytest.mark.parametrize("name", EVERY)
async def test_the_cursor_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ansi, no_colour = EVERY[name]
    if no_colour:
        monkeypatch.setenv("NO_COLOR", "1")
    app = app_on("pocket")
    app.ansi_color = ansi
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "tab", "tab", "tab", "1", ".", ".", "5", "enter")
        cursor, plain, caret = (style_of(look, few_colours=ansi) for look in (Look.CURSOR, Look.TYPED, Look.CARET))
        seen = cursor.reverse if ansi else cursor.bgcolor != plain.bgcolor
        assert seen
        assert caret.underline
        text = app.screen.query_one(Rows).render_line(6).text
        assert "ERR       1..5" in text


def test_surface_path_and_gouge_differ_in_sixteen_colours() -> None:
    styles = [style_of(look, few_colours=True) for look in (Look.SURFACE, Look.PATH, Look.GOUGE, Look.LEAD)]
    assert len({(style.color, style.bold) for style in styles}) == 4


def test_few_colours_are_the_terminals_own() -> None:
    colours = [colour for look in Look for colour in _colours(style_of(look, few_colours=True))]
    assert all(colour.number is None or colour.number < 16 for colour in colours)
    assert not any(colour.triplet for colour in colours)
    assert not any("italic" in written for written in FEW.values())


def test_every_look_has_colours() -> None:
    assert set(MANY) == set(Look)
    assert FEW.keys() <= set(Look)
    assert all(len(_colours(style_of(look, few_colours=False))) == 2 for look in Look)


def _colours(style: Style) -> list[Color]:
    return [colour for colour in (style.color, style.bgcolor) if colour is not None]


@pytest.mark.parametrize(
    ("term", "colorterm", "few"),
    [
        ("xterm", "", True),
        ("linux", "", True),
        ("vt100", "", True),
        ("screen", "", True),
        ("xterm", "truecolor", False),
        ("xterm-256color", "", False),
        ("tmux-256color", "", False),
        ("xterm-kitty", "", False),
    ],
)
def test_which_terminals_have_sixteen_colours(term: str, colorterm: str, few: bool) -> None:
    assert few_colours({"TERM": term, "COLORTERM": colorterm}) is few
    assert few_colours({"TERM": term, "COLORTERM": colorterm, "NO_COLOR": "1"})
    assert few_colours({"TERM": term, "COLORTERM": colorterm, "TEXTUAL_COLOR_SYSTEM": "standard"})
    assert not few_colours({"TERM": term, "COLORTERM": colorterm, "TEXTUAL_COLOR_SYSTEM": "256"})
