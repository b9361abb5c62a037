"""Terminals with sixteen colors, and colors on terminals with 256."""

from __future__ import annotations

import pytest
from rich.color import Color, ColorSystem
from textual.theme import Theme

from app.terminal.capabilities import few_colors
from app.theme import themes


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


@pytest.mark.parametrize("theme", [theme for theme in themes() if not theme.ansi], ids=lambda theme: theme.name)
def test_fields_stay_gray_and_differ_from_the_page_with_256_colors(theme: Theme) -> None:
    page, well, bar = (Color.parse(theme.variables[f"c-{role}"]) for role in ("bg", "well", "bar"))
    downgraded = [color.downgrade(ColorSystem.EIGHT_BIT).get_truecolor() for color in (page, well, bar)]
    assert all(color.red == color.green == color.blue for color in downgraded)
    assert downgraded[0] not in downgraded[1:]
