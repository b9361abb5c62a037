"""How every screen looks, at 80x24 and at 132x43."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from textual.pilot import Pilot

from tests.app.pilots import app_on, loaded

SCREENS = {
    "start": ("overrun-square", ()),
    "start_usr": ("overrun-square", (*["tab"] * 11, "4", "enter")),
    "lookahead_field": ("overrun-square", ("tab",) * 11),
    "half_typed": ("pocket", (*["tab"] * 11, "1")),
    "line": ("pocket", ("7", "enter")),
    "arc": ("pocket", ("8", "enter", "tab")),
    "blend_arc": ("pocket", ("4", "enter", "tab")),
    "unreadable": ("pocket", ("tab", "tab", "tab", "tab", *"1..5", "enter")),
    "new_segment": ("pocket", ("ctrl+end", "right")),
    "lookahead_table": ("pocket", (*["tab"] * 11, "f4", "home")),
    "draw": ("pocket", ("8", "enter", "f7")),
    "draw_ascii": ("pocket", ("f7", "m", "m")),
    "findings": ("pocket", ("f7", "f3")),
    "tools": ("pocket", ("f6", "f2")),
    "part_setup": ("pocket", ("f5",)),
    "parameters": ("pocket", ("f4",)),
    "units": ("pocket", ("f4", "right")),
    "program": ("pocket", ("f8", "f3")),
    "post": ("notch", ("f8", "f6", "enter")),
    "leave": ("pocket", ("tab", "9", "ctrl+q")),
    "help": ("pocket", ("tab", "tab", "tab", "tab", "?")),
    "millimeters": ("plate-mm", ("2", "enter")),
}


@pytest.mark.parametrize("size", [(80, 24), (132, 43)], ids=["80x24", "132x43"])
@pytest.mark.parametrize("name", SCREENS)
def test_screen(name: str, size: tuple[int, int], snap_compare: Callable[..., Any]) -> None:
    example, keys = SCREENS[name]

    async def to_the_screen(pilot: Pilot[int]) -> None:
        await loaded(pilot)
        for key in keys:
            await pilot.press(key)
        await pilot.pause()

    assert snap_compare(app_on(example), terminal_size=size, run_before=to_the_screen)
