"""The segment list: a row for every segment."""

from __future__ import annotations

from textual.widgets import DataTable

from tests.app.widget_pilot import operator


async def test_a_corner_shows_its_size_instead_of_an_end() -> None:
    async with operator("pocket", size=(132, 43)) as user:
        table = user.screen.query_one("#segments", DataTable)
        assert [str(cell) for cell in table.get_row("4")][1:4] == [" BLEND", "r 0.5000", ""]
        assert [str(cell) for cell in table.get_row("5")][1:4] == [" LINE", "3.0000", "3.5000"]
        await user.press("7", "enter", "f2", "c", "'.125", "enter")
        assert [str(cell) for cell in table.get_row("7")][1:4] == [" CHAMFER", "c 0.1250", ""]


async def test_a_segment_that_stops_the_calculation_says_why() -> None:
    async with operator("pocket", size=(132, 43)) as user:
        table = user.screen.query_one("#segments", DataTable)
        await user.press("5", "enter", "enter", "'nin", "enter")
        assert str(table.get_row("5")[5]) == "  ✖ error"
        await user.press("escape", "'4.5.5", "escape", "ctrl+end", "pagedown")
        assert str(table.get_row("12")[5]) == "  ? missing"
