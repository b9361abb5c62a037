"""Which terminals have sixteen colors."""

from __future__ import annotations

import pytest

from app.terminal.driver import few_colors


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
