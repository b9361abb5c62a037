"""Few keys: a plate is typed from its drawing, the keys are counted, and LinuxCNC's interpreter runs the result."""

from __future__ import annotations

from pathlib import Path

import pytest

from core.pipeline.derive import derive
from core.pipeline.post import post_center_path
from core.program.edit import FormPlace, new_block
from core.program.model import ArcSegment, BlendSegment, ChamferSegment, Coolant, LineSegment, Number, Program, Tool
from core.program.solve.solved import Origin, Solved
from core.units import Unit
from tests.app.widget_pilot import Operator, operator
from tests.rs274 import run

pytestmark = pytest.mark.asyncio(loop_scope="module")

END_MILL = Tool(1, "END MILL", Number(0.5), Number(2400.0), Number(12.0), Number(5.0), Coolant.FLOOD)
NAMES = {".": "full_stop", "-": "minus"}

PLATE = (
    "enter", "l", "enter",
    "'0", "enter", "'0", "enter",
    "'-.25", "down", "down", "down", "'.1", "enter",
    "enter", "'4", "enter",
    "b", "'.5", "enter",
    "'2.25", "enter", "enter",
    "a", "c", "enter", "'3.75", "enter", "'4", "enter", "'3", "enter", "'4", "enter",
    "'6", "enter", "enter",
    "c", "'.25", "enter",
    "enter", "'0", "enter",
    "b", "'.5", "enter",
    "'0", "enter",
)  # fmt: skip
"""A 6 x 4 plate cut outside, clockwise from (0, 0): two radii, a chamfer, a notch about (3, 4)."""


def new_program() -> Program:
    """A new inch program with tool 1 in TOOL SETUP."""
    program = Program(Unit.IN, tools=(END_MILL,))
    return Program(Unit.IN, tools=(END_MILL,), blocks=(new_block(program),))


def key_presses(keys: tuple[str, ...]) -> list[str]:
    """One key press for each typed letter."""
    presses: list[str] = []
    for key in keys:
        presses += [NAMES.get(letter, letter) for letter in key[1:]] if key.startswith("'") else [key]
    return presses


async def type_keys(user: Operator, keys: tuple[str, ...]) -> int:
    presses = key_presses(keys)
    await user.press(*presses)
    return len(presses)


async def test_the_plate_takes_at_most_seventy_keys_and_runs_on_linuxcnc(tmp_path: Path):
    async with operator(new_program()) as user:
        assert user.at == "tool"
        assert await type_keys(user, PLATE) <= 70
        program = user.session.program
    kinds = [type(segment) for segment in program.blocks[0].segments]
    assert kinds.count(BlendSegment) == 2
    assert kinds.count(ChamferSegment) == 1
    derived = derive(program)
    block = derived.block(1)
    assert [finding.code for finding in block.errors] == []
    assert block.solved.closed
    assert block.paths is not None
    assert block.paths.verdict is not None
    assert not block.paths.verdict.gouges
    posted = post_center_path(derived, name="PLATE")
    assert "S2400 M3" in posted.text
    assert "M8" in posted.text
    assert posted.text.count("PECK") >= 3
    ran = run(posted.text, {1: 0.5}, tmp_path)
    assert ran.accepted, ran.said
    corners = [(x, y) for name, x, y, *_ in ran.moves if name != "STRAIGHT_TRAVERSE"]
    xs, ys = zip(*corners, strict=True)
    # at X 0 and Y 0, the leads reach farther
    assert (max(xs), max(ys)) == pytest.approx((6.25, 4.25))
    assert {round(z, 4) for _, _, _, z, *_ in ran.moves if z < 0} >= {-0.1, -0.2, -0.25}


async def test_enter_moves_to_the_next_field_that_needs_a_value(user: Operator):
    await user.begin(new_program(), 0, "tool")
    await type_keys(user, ("enter", "enter", "enter", "'0", "enter", "'-.2", "enter"))
    assert (user.at, user.session.place.segment) == ("x_start", 0), "X START was left out"
    await user.begin(new_program(), 0, "tool")
    path = [user.at]
    for keys in (("enter",), ("l", "enter"), ("'0", "enter"), ("'0", "enter"), ("'-.2", "enter")):
        await type_keys(user, keys)
        path.append(user.at)
    assert path == ["tool", "cutter_comp", "x_start", "y_start", "z_bottom", "x_end"]
    assert user.session.place.segment == 1
    assert "A ARC, B BLEND ARC, C CHAMFER" in user.prompt
    await type_keys(user, ("a",))
    assert (user.at, str(user.screen.query_one("#segment-kind").render())) == ("direction", "ARC")
    assert len(user.session.block.segments) == 1


async def test_the_tags_show_the_origin_of_a_value(user: Operator):
    await user.begin(new_program(), 0, "tool")
    assert (user.tag("speed"), user.tag("plunge_feed"), user.tag("coolant")) == ("TOOL", "TOOL", "TOOL")
    await type_keys(user, (*PLATE[:15], "down"))
    assert (user.tag("x_end"), user.tag("feed")) == ("SAME", "TOOL")
    assert user.session.derived_block.solved.segments[0].values["x_end"] == Solved(0.0, Origin.SAME)


async def test_right_arrow_past_an_empty_segment_adds_no_second_one(user: Operator):
    await user.press("'5", "enter", "c", "'1", "enter")
    assert isinstance(user.session.block.segments[5], ChamferSegment), "C on SEGMENT inserts a chamfer after it"
    await user.press("ctrl+z", "ctrl+z", "ctrl+end", "right", "pagedown", "pagedown")
    assert len(user.session.block.segments) == 12
    assert isinstance(user.session.segment, LineSegment)
    assert user.prompt.startswith("Nothing is typed yet in segment 12")


async def test_del_blanks_coolant(user: Operator):
    user.app.move(FormPlace(1), "coolant")
    await user.press("f")
    assert user.session.block.coolant is not None
    await user.press("delete")
    assert user.session.block.coolant is None
    assert user.tag("coolant") == "DEF"


async def test_a_new_block_takes_the_values_and_the_last_feed_of_the_previous_block(user: Operator):
    await user.press("f8", "f2")
    before, block = user.session.program.blocks
    assert (block.speed, block.z_bottom, block.cutter_comp) == (before.speed, before.z_bottom, before.cutter_comp)
    assert (block.x_start, block.segments) == (None, ())
    await user.press("ctrl+end", "pagedown")
    assert user.session.place == FormPlace(2, 1)
    assert user.session.block.segments[0].feed == Number(12.0)
    await user.press("a")
    (arc,) = user.session.block.segments
    assert isinstance(arc, ArcSegment), "A on an empty LINE makes an arc of it"
    assert arc.feed == Number(12.0), "the feed stays when a letter changes the segment"


async def test_a_comma_is_a_decimal_point(user: Operator):
    await user.press("pagedown", "tab", "2", "comma", "5", "enter")
    assert user.session.block.segments[0].x_end == Number(2.5)
    await user.press("comma", "5", "enter")
    assert user.session.block.segments[0].y_end == Number(0.5)


async def test_a_new_line_left_empty_is_removed(user: Operator):
    await user.press("tab", "'1", "enter", "ctrl+end", "right")
    assert user.session.place.segment == 12
    await user.press("pageup")
    assert (len(user.session.block.segments), user.session.place.segment) == (11, 11)
    await user.press("'5", "enter", "f2", "pagedown")
    assert (len(user.session.block.segments), user.session.place.segment) == (11, 5)
    await user.press("ctrl+end", "right", "f8")
    assert len(user.session.block.segments) == 11
