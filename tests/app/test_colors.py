"""Focus, errors and tags are seen in sixteen colors and in none."""

from __future__ import annotations

import pytest
from rich.color import Color
from rich.style import Style

from app.painted.widgets.looks import FEW, MANY, style_of
from app.painted.widgets.painted import Rows
from app.painted.widgets.rows import Look
from app.terminal.driver import few_colors
from tests.app.pilots import app_on, loaded

EVERY = {"ansi": (True, False), "no color": (False, True), "full": (False, False)}


@pytest.mark.parametrize("name", EVERY)
async def test_the_cursor_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ansi, no_color = EVERY[name]
    if no_color:
        monkeypatch.setenv("NO_COLOR", "1")
    app = app_on("pocket")
    app.ansi_color = ansi
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "tab", "tab", "tab", "1", ".", ".", "5", "enter")
        cursor, plain, caret = (style_of(look, few_colors=ansi) for look in (Look.CURSOR, Look.TYPED, Look.CARET))
        seen = cursor.reverse if ansi else cursor.bgcolor != plain.bgcolor
        assert seen
        assert caret.underline
        text = app.screen.query_one(Rows).render_line(6).text
        assert "ERR       1..5" in text


def test_surface_path_and_gouge_differ_in_sixteen_colors() -> None:
    styles = [style_of(look, few_colors=True) for look in (Look.SURFACE, Look.PATH, Look.GOUGE, Look.LEAD)]
    assert len({(style.color, style.bold) for style in styles}) == 4


def test_few_colors_are_the_terminals_own() -> None:
    colors = [color for look in Look for color in _colors(style_of(look, few_colors=True))]
    assert all(color.number is None or color.number < 16 for color in colors)
    assert not any(color.triplet for color in colors)
    assert not any("italic" in written for written in FEW.values())


def test_every_look_has_colors() -> None:
    assert set(MANY) == set(Look)
    assert FEW.keys() <= set(Look)
    assert all(len(_colors(style_of(look, few_colors=False))) == 2 for look in Look)


def _colors(style: Style) -> list[Color]:
    return [color for color in (style.color, style.bgcolor) if color is not None]


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
def test_which_terminals_have_sixteen_colors(term: str, colorterm: str, few: bool) -> None:
    assert few_colors({"TERM": term, "COLORTERM": colorterm}) is few
    assert few_colors({"TERM": term, "COLORTERM": colorterm, "NO_COLOR": "1"})
    assert few_colors({"TERM": term, "COLORTERM": colorterm, "TEXTUAL_COLOR_SYSTEM": "standard"})
    assert not few_colors({"TERM": term, "COLORTERM": colorterm, "TEXTUAL_COLOR_SYSTEM": "256"})
