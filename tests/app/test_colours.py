"""Focus, errors and tags are seen in sixteen colours and in none."""

from __future__ import annotations

import pytest

from app.driver import few_colours
from app.widgets.rows import Rows
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
        cursor = app.screen.get_component_rich_style("look--cursor")
        plain = app.screen.get_component_rich_style("look--typed")
        caret = app.screen.get_component_rich_style("look--caret")
        seen = cursor.reverse if ansi else cursor.bgcolor != plain.bgcolor
        assert seen
        assert caret.underline
        text = app.screen.query_one(Rows).render_line(6).text
        assert "ERR       1..5" in text


async def test_surface_path_and_gouge_differ_in_sixteen_colours() -> None:
    app = app_on("pocket")
    app.ansi_color = True
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        styles = [app.screen.get_component_rich_style(f"look--{look}") for look in ("surface", "path", "gouge", "lead")]
        assert len({(style.color, style.bold) for style in styles}) == 4
        assert all(style.color is None or style.color.number is None or style.color.number < 16 for style in styles)


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
