"""The mouse, when it is turned on, and the looks kept in the settings."""

from __future__ import annotations

import pytest
from textual.events import MouseEvent, MouseScrollDown, MouseScrollUp

from app import theme
from app.screens.contour import ContourScreen
from app.widgets.drawing import Drawing
from core.program.model import Number
from tests.app.widget_pilot import Operator, operator

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def click_at(user: Operator, drawing: Drawing, point: tuple[float, float]) -> None:
    """Click on a point (mm) of a drawing."""
    while drawing.drawn is None:
        await user.pilot.pause(0.01)
    column, row = drawing.drawn.view.cell(point, *drawing.size)
    # the frame takes one row above the picture
    await user.pilot.click(drawing, offset=(int(column), int(row) + 1))
    await user.settle()


async def test_softkeys_fields_and_list_rows_take_clicks():
    async with operator(size=(132, 43)) as user:
        await user.pilot.click(user.row("x_start").input)
        await user.press("'7.5", "enter")
        assert user.session.block.x_start == Number(7.5)
        await user.pilot.click("#f8")
        assert type(user.screen).__name__ == "ProgramScreen"
        await user.press("enter")
        await user.pilot.click("#segments", offset=(5, 6))
        await user.settle()
        assert user.session.place.segment == 4


async def test_a_click_in_the_drawing_goes_to_the_nearest_segment(user: Operator):
    await click_at(user, user.screen.query_one("#outline", Drawing), (4.75 * 25.4, 2.2 * 25.4))
    assert user.session.place.segment == 3
    await user.press("f7")
    await click_at(user, user.screen.query_one("#full-drawing", Drawing), (3.0 * 25.4, 0.25 * 25.4))
    assert user.session.place.segment == 1


async def test_a_click_on_the_number_of_a_finding_selects_it(user: Operator):
    assert isinstance(user.screen, ContourScreen)
    place = user.screen.entries[2].at
    assert place is not None
    await click_at(user, user.screen.query_one("#outline", Drawing), place)
    assert user.screen.selected_finding == 2
    assert user.session.place.segment == 0


async def roll(user: Operator, drawing: Drawing, event: type[MouseEvent]) -> None:
    """Turn the wheel over a drawing that is drawn."""
    while drawing.drawn is None:
        await user.pilot.pause(0.01)
    x, y, *_ = drawing.content_region
    user.app.post_message(event(None, x, y, 0, 0, 0, False, False, False))
    await user.settle()


@pytest.mark.parametrize("name", ["outline", "loupe", "full-drawing"])
async def test_the_wheel_zooms_in_every_drawing(user: Operator, name):
    if name == "full-drawing":
        await user.press("f7")
    drawing = user.screen.query_one(f"#{name}", Drawing)
    await roll(user, drawing, MouseScrollUp)
    near = drawing.subject.view.scale
    await roll(user, drawing, MouseScrollDown)
    await roll(user, drawing, MouseScrollDown)
    assert drawing.subject.view.scale == pytest.approx(near * 1.25**2)
    assert drawing.subject.view.center == drawing.drawn.view.center


async def test_theme_and_characters_are_kept_in_the_settings():
    async with operator() as user:
        for action in ("light_or_dark", "next_characters"):
            await user.app.run_action(action)
        held = user.app.settings_file.settings
        assert (held.theme, held.characters) == ("light", "block")
        assert user.app.theme == theme.LIGHT_THEME
