"""INCH or MM? is asked once when a part looks typed in the other unit; the unit is shown large in two places."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from textual.widgets import Label, Static

from app.__main__ import main
from app.documents.files import load, save
from app.documents.programs import example as example_path
from app.screens.dialogs import Question
from app.screens.parameters import ParametersScreen
from app.screens.post import PostScreen
from core.pipeline.derive import derive, remedy_for_gouge
from core.pipeline.setup_sheet import sheet_page, sheet_text
from core.pipeline.unit_question import unit_question
from core.program.model import Block, CutterComp, Number, Program, Tool
from core.units import Unit, sentence
from tests.app.widget_pilot import Operator
from tests.core.program.parts import arc, line, program

LARGE = "The tool is 0.5000 across, more than half of the part's smaller side, 0.9000. The program is in INCH."
GOUGED = "CUTCOMP LOOKAHEAD 3 does not gouge but leaves 0.9000 uncut."


def plate(width: float, height: float, tool: float, unit: Unit = Unit.IN) -> Program:
    """A rectangle cut outside with a tool of this diameter."""
    ends = [(0, 0), (0, height), (width, height), (width, 0), (0, 0)]
    lines = tuple(line(x_end=x, y_end=y, feed=9) for x, y in ends[1:])
    return replace(program(*lines), unit=unit, tools=(Tool(1, "END MILL", Number(tool)),))


def question(part: Program) -> str:
    finding = unit_question(derive(part))
    return "" if finding is None else sentence(finding, part.unit)


def test_a_tool_larger_than_half_the_smaller_side_asks_for_the_unit() -> None:
    assert question(plate(4, 0.9, 0.5)) == f"INCH or MM? {LARGE}"
    assert question(plate(4, 1.0, 0.5)) == ""


@pytest.mark.parametrize(
    ("part", "text"),
    [
        (plate(0.24, 0.2, 0.01), "INCH or MM? The part is only 0.2400 by 0.2000. The program is in INCH."),
        (plate(0.26, 0.2, 0.01), ""),
        (plate(5.9, 4, 1, Unit.MM), "INCH or MM? The part is only 5.900 by 4.000. The program is in MM."),
        (plate(6.1, 4, 1, Unit.MM), ""),
    ],
)
def test_a_very_small_part_asks_for_the_unit(part: Program, text: str) -> None:
    assert question(part) == text


def test_a_tool_that_fits_into_a_hole_asks_nothing() -> None:
    """6 mm in a hole of 8 mm is ordinary; around a boss of that size it may be a unit mixed up."""
    circle = arc("CCW", x_center=0, y_center=0, x_end=4, y_end=0, sweep=360, feed=100)
    hole = replace(program(circle, x=4.0), tools=(Tool(1, "END MILL", Number(6.0)),))
    assert question(hole) == ""
    block = replace(hole.blocks[0], cutter_comp=CutterComp.RIGHT)
    boss = replace(hole, blocks=(block,))
    assert question(boss).startswith("INCH or MM? The tool is 6.000 across, more than half")


def test_an_open_contour_asks_nothing() -> None:
    closed = plate(0.2, 0.2, 0.5)
    block = closed.blocks[0]
    assert question(replace(closed, blocks=(replace(block, segments=block.segments[:-1]),))) == ""


@pytest.mark.asyncio(loop_scope="module")
async def test_a_number_that_cannot_be_read_asks_nothing_about_the_other_contours(user: Operator) -> None:
    """A slot in a large plate: the plate's size is unknown while one of its numbers cannot be read."""
    large, slot = plate(4, 3, 0.5), plate(1, 0.375, 0.25)
    both = replace(large, blocks=(*large.blocks, *slot.blocks))
    assert question(both) == ""
    await user.begin(both)
    await user.begin(both, 2, "x_end")
    await user.press("'1.2.3", "enter")
    assert user.prompt == "1.2.3 is not a number."


@pytest.mark.asyncio(loop_scope="module")
async def test_the_form_asks_once(user: Operator) -> None:
    await user.begin(plate(4, 0.9, 0.5))
    assert user.prompt == f"INCH or MM? {LARGE} UNITS is in PROGRAM PARAMETERS."
    await user.press("down", "up")
    assert "INCH or MM?" not in user.prompt
    await user.press("ctrl+z")
    assert "INCH or MM?" not in user.prompt


@pytest.mark.asyncio(loop_scope="module")
async def test_posting_asks_until_it_is_answered_and_continues(user: Operator) -> None:
    await user.begin(plate(4, 0.9, 0.5))
    for answer in ("escape", "i"):
        user.app.action_post()
        await user.settle()
        question_screen = user.app.screen
        assert isinstance(question_screen, Question)
        assert question_screen.lines == (f"INCH or MM? {LARGE}",)
        await user.press(answer)
    assert isinstance(user.app.screen, PostScreen)
    await user.press("escape")
    user.app.action_post()
    await user.settle()
    assert isinstance(user.app.screen, PostScreen)


@pytest.mark.asyncio(loop_scope="module")
async def test_choosing_the_other_unit_opens_program_parameters(user: Operator) -> None:
    await user.begin(plate(4, 0.9, 0.5))
    user.app.action_post()
    await user.settle()
    await user.press("m")
    assert isinstance(user.app.screen, ParametersScreen)


@pytest.mark.asyncio(loop_scope="module")
async def test_the_unit_is_shown_large_on_a_new_program_and_on_post(user: Operator) -> None:
    await user.begin(plate(40, 30, 5))
    for unit, word in ((Unit.IN, "I N C H"), (Unit.MM, "M M")):
        await user.begin(Program(unit=unit, blocks=(Block(),)))
        units = user.screen.query_one("#units", Label)
        assert word in str(units.content)
        assert units.has_class("-new")
        await user.begin(plate(40, 30, 5, unit))
        assert word not in str(user.screen.query_one("#units", Label).content)
        user.app.action_post()
        await user.settle()
        assert isinstance(user.app.screen, PostScreen), "an ordinary part is posted without a question"
        assert str(user.screen.query_one(".head-unit", Label).content) == word


def test_the_post_command_warns_about_the_unit(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    save(plate(4, 0.9, 0.5), tmp_path / "part.toml")
    main(["post", str(tmp_path / "part.toml")])
    assert f"warning: INCH or MM? {LARGE}" in capsys.readouterr().err


def test_a_refusal_names_its_block_and_a_clean_look_ahead(capsys: pytest.CaptureFixture[str]) -> None:
    for control in ([], ["--control", "linuxcnc"]):
        assert main(["post", str(example_path("notch")), *control]) == 1
        err = capsys.readouterr().err
        assert "nothing was posted. Block 1, segment 4: GOUGE 0.2500 deep" in err
        assert f"Block 1: {GOUGED}" in err


@pytest.mark.asyncio(loop_scope="module")
async def test_the_post_screen_names_the_clean_look_ahead(user: Operator) -> None:
    await user.begin("notch")
    user.app.action_post()
    await user.settle()
    await user.finish()
    await user.settle()
    assert f"Block 1: {GOUGED}" in str(user.screen.query_one("#post-findings", Static).content)


def test_the_sheet_names_the_clean_look_ahead_and_asks_for_the_unit() -> None:
    notch = derive(load(example_path("notch")))
    for write in (sheet_text, sheet_page):
        text = " ".join(write(notch, name="notch", day="").split())
        assert f"Block 1: {GOUGED}" in text.replace("! ", "")
    sheet = sheet_text(derive(plate(4, 0.9, 0.5)), name="plate", day="")
    assert "INCH or MM? The tool is 0.5000 across" in sheet
    assert "READY to post. Know before you run it:" in sheet


def test_the_largest_tool_is_named_rounded_down_when_no_look_ahead_is_clean() -> None:
    """A slot 10 mm wide in an inch program: 0.3937 is clean, 0.3938 is not."""
    ends = [(0.0, 0.0), (10 / 25.4, 0.0), (10 / 25.4, 2.0)]
    sides = (line(x_end=x, y_end=y, feed=9) for x, y in ends)
    slot = program(*sides, start={"cutter_comp": CutterComp.LEFT, "x_start": Number(0.0), "y_start": Number(2.0)})
    parameters = replace(slot.parameters, blend_offset=Number(0.0))
    part = replace(slot, unit=Unit.IN, parameters=parameters, tools=(Tool(1, "END MILL", Number(0.5)),))
    remedy = remedy_for_gouge(derive(part).block(1), part)
    assert remedy is not None
    assert (
        sentence(remedy, Unit.IN)
        == "Block 1: the tool is too big; the largest that does not gouge: 0.3937, with look-ahead 1."
    )
