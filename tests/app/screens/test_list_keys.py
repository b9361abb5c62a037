"""F9, F10, Ctrl+N and Ctrl+P lead to segments and findings from every screen of a block."""

from __future__ import annotations

from dataclasses import replace

from textual.widget import Widget
from textual.widgets import OptionList

from app.screens.contour import ContourScreen
from app.screens.draw import DrawScreen
from app.screens.home import HomeScreen
from app.screens.post import PostScreen
from app.widgets.drawing import Drawing
from app.widgets.findings_list import FindingsList
from core.program.edit import FormPlace
from core.program.model import Number
from tests.app.widget_pilot import Operator, operator, session_on


async def run(user: Operator, action: str) -> None:
    """Run an action; drawings and advice are not waited for."""
    user.patience = 0.0
    await user.app.run_action(action)
    await user.settle()


def focused(user: Operator) -> str | None:
    return None if user.app.focused is None else user.app.focused.id


async def test_the_list_keys_lead_from_every_screen_to_the_lists():
    names = ("program", "lookahead", "draw", "parameters", "part_setup", "tools", "post")
    keys = (("f9", "segments"), ("f10", "findings"), ("ctrl+t", "segments"), ("ctrl+f", "findings"))
    async with operator() as user:
        for name, (key, panel) in zip(names, (*keys, *keys), strict=False):
            await run(user, f"app.{name}")
            assert not isinstance(user.screen, ContourScreen)
            await user.press(key)
            assert isinstance(user.screen, ContourScreen), (name, key)
            assert focused(user) == panel, (name, key)
            assert user.screen.query_one(f"#{panel}", Widget).display


async def test_next_and_previous_finding_lead_from_other_screens_to_the_loupe():
    async with operator() as user:
        for name, key, number in (("program", "ctrl+n", "1/3"), ("tools", "ctrl+p", "3/3")):
            user.app.move(user.session.place)
            await run(user, f"app.{name}")
            await user.press(key)
            assert isinstance(user.screen, ContourScreen), (name, key)
            assert number in user.screen.query_one("#loupe", Drawing).heading, (name, key)


async def test_draw_steps_through_its_own_findings_and_f10_goes_to_its_list_where_there_is_room():
    async with operator(size=(132, 43)) as user:
        await run(user, "app.draw")
        screen = user.screen
        assert isinstance(screen, DrawScreen)
        await user.press("ctrl+n", "ctrl+n")
        assert "2/3" in screen.drawing.heading
        await user.press("ctrl+p")
        assert "1/3" in screen.drawing.heading
        await user.press("f10")
        assert focused(user) == "draw-findings"
        await user.press("f10")
        assert focused(user) == "full-drawing"


async def test_enter_in_the_list_of_draw_goes_to_the_field_of_the_finding():
    async with operator(size=(132, 43)) as user:
        await run(user, "app.draw")
        await user.press("f10", "down", "enter")
        assert isinstance(user.screen, ContourScreen)
        assert user.session.place.segment == user.screen.entries[1].segment == 10


async def test_the_softkeys_of_draw_zoom_by_the_same_step_as_plus_and_minus():
    async with operator() as user:
        await run(user, "app.draw")
        screen = user.screen
        assert isinstance(screen, DrawScreen)
        scales = []
        for key in ("f3", "f4", "plus", "minus", "f5"):
            await user.press(key)
            await user.finish()
            assert screen.drawing.drawn is not None
            scales.append(screen.drawing.drawn.view.scale)
        assert scales[0] == scales[2] < scales[1] == scales[3] == scales[4]


async def test_a_half_typed_number_is_taken_before_the_lists_open():
    async with operator() as user:
        await run(user, "app.tools")
        await user.press("tab", "tab", "'.3", "f10")
        assert focused(user) == "findings"
        assert user.session.program.tools[0].diameter == Number(0.3)
        await run(user, "app.tools")
        await user.press("tab", "tab", "'1a5", "f10")
        assert not isinstance(user.screen, ContourScreen), "the text cannot be read"


async def test_the_files_have_neither_segments_nor_findings():
    async with operator() as user:
        await run(user, "app.home")
        await user.press("f9", "f10", "ctrl+n")
        assert isinstance(user.screen, HomeScreen)


async def test_f10_on_post_leads_to_what_must_be_corrected():
    async with operator("notch") as user:
        await run(user, "app.post")
        assert isinstance(user.screen, PostScreen)
        await user.press("f10", "enter")
        assert isinstance(user.screen, ContourScreen)


async def test_the_findings_of_another_block_begin_with_the_first_one():
    plate = session_on("plate-mm").program
    blank = replace(plate.blocks[0], z_bottom=None, plunge_feed=None, speed=None)
    async with operator() as user:
        await user.begin(replace(plate, blocks=(blank, blank)))
        findings = user.screen.query_one(FindingsList)
        await user.press("f10", "down", "down", "enter")
        assert findings.highlighted == 2
        user.app.move(FormPlace(2), "segment")
        await user.settle()
        assert findings.highlighted == 0
        await user.press("f9", "f10", "enter")
        assert user.at == "z_bottom"


async def test_a_list_without_findings_says_so_and_how_it_closes():
    async with operator("flange") as user:
        await user.press("f10", "f10")
        assert user.prompt == "There are no findings in this block. F10 closes."


async def test_f10_again_gives_the_findings_the_whole_height_and_closes_them_then():
    async with operator() as user:
        await user.press("f10")
        findings = user.screen.query_one("#findings", OptionList)
        assert findings.size.height == 8
        assert user.prompt.endswith("F10 makes it taller.")
        await user.press("f10")
        assert findings.size.height == 18
        assert user.prompt.endswith("F10 closes.")
        await user.press("tab")
        assert user.at == "segment"
        assert user.screen.query_one("#fields", Widget).display
        assert findings.size.height == 8
        await user.press("f10", "f10")
        assert not findings.display
        assert user.at == "segment"


async def test_f9_again_gives_the_segments_the_whole_height_of_a_narrow_terminal():
    async with operator(size=(60, 20)) as user:
        await user.press("f9")
        segments = user.screen.query_one("#segments", Widget)
        assert segments.size.height == 2
        assert user.prompt.endswith("F9 makes it taller.")
        await user.press("f9", "down")
        assert segments.size.height == 12
        assert user.prompt.endswith("F9 closes.")
        assert user.session.place.segment == 1
        await user.press("f9")
        assert not segments.display
        assert user.screen.query_one("#fields", Widget).display
        assert user.at == "segment"
