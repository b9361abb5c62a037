"""Runs on the MILL CONTOUR form: the header, what is missing, CAL while typing, SOLUTION, refusals, the drawing."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.screens.contour import ContourScreen
from app.session.session import Session
from app.widgets.drawing import Drawing
from core.draw.scene import Style
from core.program.edit import FormPlace
from core.program.model import Number, Program
from tests.app.widget_pilot import Operator, operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import BAD, case_of, ccw, cw, line

GOLDEN = json.loads((Path(__file__).parents[2] / "data/calculated_runs/golden.json").read_text(encoding="utf-8"))


def golden(number: str) -> Program:
    return program_of(next(case for case in GOLDEN if case["name"].startswith(number)))


def header(one: Operator) -> str:
    return str(one.screen.query_one("#segment-kind").render())


async def to(one: Operator, segment: int, field: str) -> None:
    """The cursor to a field of a segment."""
    await one.press("ctrl+home", *["pagedown"] * segment)
    assert isinstance(one.screen, ContourScreen)
    await one.press(*["tab"] * one.screen.names().index(field))
    assert one.at == field


async def test_every_segment_of_a_run_says_so_in_the_header():
    case = case_of(line(x_end=-10, y_end=0), line(angle=30), line(x_end=100, y_end=0, angle=300))
    async with operator(program_of(case)) as one:
        seen = []
        for _ in range(3):
            await one.press("pagedown")
            seen.append(header(one))
    assert seen == ["LINE", "LINE    RUN 2-3", "LINE    RUN 2-3"]


async def test_a_waiting_run_counts_what_is_missing_on_each_of_its_segments():
    case = case_of(line(angle=0), ccw(tangent=True), line(tangent=True, angle=90, x_end=60, y_end=40))
    async with operator(program_of(case)) as one:
        for _ in range(3):
            await one.press("pagedown")
            assert header(one).endswith("RUN 1-3  1 more value")
            assert one.prompt.startswith("Segments 1 to 3 need 1 more value: RADIUS of 2, or an end (X END or Y END)")
        await to(one, 2, "radius")
        await one.press("'10", "tab")
        assert header(one) == "ARC     RUN 1-3"
        assert (one.value("x_end"), one.tag("x_end")) == ("60.000", "CAL")


async def test_a_half_typed_number_moves_the_calculated_fields_of_the_run_and_escape_brings_them_back():
    async with operator(golden("c18")) as one:
        await to(one, 2, "radius")
        assert (one.value("x_end"), one.tag("x_end")) == ("60.000", "CAL")
        await one.press("delete", "'2")
        assert (one.value("y_end"), one.tag("y_end"), one.value("radius")) == ("2.000", "CAL", "2")
        await one.press("'0")
        assert (one.value("y_end"), one.value("x_center")) == ("20.000", "40.000")
        assert one.session.history.undo_count == 0
        await one.press("escape")
        assert (one.value("y_end"), one.value("radius")) == ("10.000", "10.000")


async def test_undo_names_the_run_whose_calculated_fields_come_back():
    async with operator(golden("c18")) as one:
        await to(one, 2, "radius")
        await one.press("delete", "'2", "tab", "ctrl+z")
        assert one.prompt.startswith("Undone: RADIUS of segment 2, run 1-3, block 1.")
        assert one.value("y_end") == "10.000"


async def test_a_half_typed_number_that_undetermines_the_run_leaves_its_text_alone():
    async with operator(golden("c18")) as one:
        await to(one, 2, "radius")
        await one.press("delete", "'7", "'0")
        assert one.value("radius") == "70"
        assert one.value("x_end") == ""
        await one.press("enter")
        assert "RADIUS 70.000 does not fit between segments 1 and 3: the largest is 40.000." in one.prompt


async def test_solution_is_stepped_with_space_and_arrows_and_takes_the_line_of_start():
    async with operator(golden("c24")) as one:
        await to(one, 2, "choice")
        assert not one.row("START").display
        assert one.row("choice").display
        ends = []
        for key in ("space", "space", "left", "right"):
            await one.press(key)
            ends.append((one.value("choice"), one.value("x_end")))
        assert ends == [("1 of 2", "68.678"), ("2 of 2", "66.604"), ("1 of 2", "68.678"), ("2 of 2", "66.604")]
        await one.press("ctrl+z")
        assert (one.session.place.segment, one.value("choice"), one.value("x_end")) == (1, "1 of 2", "18.413")


async def test_solution_shows_how_many_there_are_while_none_is_taken():
    async with operator(golden("c24")) as one:
        await to(one, 2, "choice")
        assert one.row("choice").input is not None
        assert "? of 2" in str(one.row("choice").input.query_one("#label").render())


async def test_a_choice_that_comes_up_while_typing_is_offered_on_a_form_that_stood_before():
    case = case_of(line(angle=30), line(x_end=70, y_end=10))
    async with operator(program_of(case)) as one:
        await to(one, 2, "length")
        assert not one.row("choice").display
        await one.press("'40", "enter")
        assert one.prompt.startswith("Two solutions fit: pick one on SOLUTION.")
        await to(one, 1, "choice")
        await one.press("right")
        assert (one.value("choice"), one.value("x_end")) == ("1 of 2", "30.760")
        await to(one, 2, "length")
        await one.press("delete", "enter")
        assert not one.row("choice").display


async def test_enter_stops_at_solution_until_one_is_taken():
    async with operator(golden("c24")) as one:
        await to(one, 2, "radius")
        stops = []
        for _ in range(4):
            await one.press("enter")
            stops.append((one.session.place.segment, one.at))
            if one.at == "choice":
                break
        assert stops[-1] == (2, "choice")
        await one.press("right")
        await to(one, 2, "feed")
        await one.press("enter")
        assert one.session.place.segment == 3


async def test_enter_goes_through_the_last_arc_of_a_run_while_data_are_missing():
    case = case_of(ccw(x_center=0, y_center=20, radius=20), cw(radius=30, tangent=True), ccw(tangent=True))
    async with operator(program_of(case)) as one:
        await to(one, 3, "x_end")
        await one.press("'80", "enter", "'45", "enter")
        assert one.at == "x_center"
        await one.press("'80", "enter", "'30", "enter")
        typed = one.session.block.segments[2]
    assert (typed.x_end, typed.y_end) == (Number(80.0), Number(45.0))
    assert (typed.x_center, typed.y_center) == (Number(80.0), Number(30.0))


async def test_tangent_is_switched_by_space():
    async with operator(golden("c18")) as one:
        await to(one, 2, "tangent")
        await one.press("space")
        assert one.value("tangent") == "NO"
        assert "1 more value" in header(one)
        await one.press("space")
        assert (one.value("tangent"), header(one)) == ("YES", "ARC     RUN 1-3")


async def test_a_last_segment_that_waits_says_that_the_next_one_may_give_it():
    async with operator(program_of(case_of(line(angle=30)))) as one:
        await to(one, 1, "x_end")
        assert one.prompt.endswith("Or Page Down: the next segment may give it.")
        await one.press("pagedown", "'100", "tab", "'0", "tab")
        assert "1 more value" in one.prompt
        assert "Page Down" not in one.prompt


# what is said


KEYED = [bad for bad in BAD if bad[0] not in ("TANGENT_PLACE", "PARALLEL_TO")]


def last_number(case: dict[str, Any]) -> tuple[int, str, float]:
    """The last number that is typed in a case: its segment, its field and its value."""
    for number in range(len(case["segments"]), 0, -1):
        names = [name for name, value in case["segments"][number - 1].items() if isinstance(value, int | float)]
        names = [name for name in names if name != "tangent"]
        if names:
            return number, names[-1], case["segments"][number - 1][names[-1]]
    raise AssertionError(case)


def blanked(program: Program, segment: int, field: str) -> Program:
    """The program before a field of a segment was typed."""
    block = program.blocks[0]
    blank: dict[str, Any] = {field: None}
    before = replace(block.segments[segment - 1], **blank)
    segments = (*block.segments[: segment - 1], before, *block.segments[segment:])
    return replace(program, blocks=(replace(block, segments=segments),))


async def test_each_refusal_stands_on_the_form_as_soon_as_the_last_number_is_typed():
    async with operator() as one:
        for code, text, case in KEYED:
            segment, field, value = last_number(case)
            one.app.begin(Session.of(blanked(program_of(case), segment, field)).at(FormPlace(1, segment), field))
            await one.settle()
            assert one.at == field
            await one.press(f"'{value:g}", "enter")
            assert text in " ".join(one.prompt.split("\n")), code
            assert one.session.derived_block.solved.runs[0].code == code


@pytest.mark.parametrize("field", ["length", "angle"])
async def test_two_numbers_that_contradict_are_both_named_and_blanking_either_mends_it(field: str):
    case = case_of(line(angle=30), line(x_end=100, y_end=0, angle=300))
    async with operator(program_of(case)) as one:
        await to(one, 2, "length")
        await one.press("'51", "enter")
        assert (one.at, "XY LENGTH is 51.000, but 50.000" in one.prompt) == ("length", True)
        await to(one, 2, field)
        await one.press("delete", "tab")
        run = one.session.derived_block.solved.runs[0]
        assert (len(run.answers), run.code) == ((1, None) if field == "length" else (2, "PICK_SOLUTION"))


async def test_what_the_cursor_does_not_stand_on_is_not_said_of_segments_outside_the_run():
    case = case_of(line(angle=30), line(x_end=100, y_end=0, angle=120), line(x_end=0, y_end=50))
    async with operator(program_of(case)) as one:
        await one.press("pagedown", "tab")
        assert "50.000 backwards" in one.prompt
        await one.press("pagedown", "pagedown", "tab")
        assert header(one) == "LINE"
        assert "backwards" not in one.prompt


async def test_a_typed_angle_of_one_segment_is_taken_without_an_end():
    case = case_of(cw(radius=12), line(tangent=True, x_end=50, y_end=-20))
    async with operator(program_of(case)) as one:
        await to(one, 2, "length")
        await one.press("'45", "enter")
        assert one.session.block.segments[1].length == Number(45.0)
        assert one.session.derived_block.solved.runs[0].code == "PICK_SOLUTION"


# the drawing


def part_drawn(one: Operator, style: Style) -> int:
    """Cells of the loupe in the looks of a style."""
    drawn = one.screen.query_one("#loupe", Drawing).drawn
    return 0 if drawn is None else int((drawn.picture.styles == style.value).sum())


async def drawn(one: Operator) -> None:
    """Wait for the drawings."""
    await one.app.workers.wait_for_complete()
    await one.pilot.pause()


async def test_solutions_that_are_not_taken_are_dotted_while_the_cursor_is_on_their_run():
    async with operator(golden("c24")) as one:
        await to(one, 1, "choice")
        await drawn(one)
        dashed = part_drawn(one, Style.SURFACE)
        assert dashed
        assert not part_drawn(one, Style.UNTAKEN)
        pictures = []
        for _ in range(2):
            await one.press("space")
            await drawn(one)
            assert part_drawn(one, Style.UNTAKEN) > 4
            shown = one.screen.query_one("#loupe", Drawing).drawn
            assert shown is not None
            pictures.append(shown.picture.rows)
        assert pictures[0] != pictures[1]
        await one.press("ctrl+home")
        await drawn(one)
        assert not part_drawn(one, Style.UNTAKEN)


async def test_an_undetermined_run_is_sketched_as_far_as_headings_and_centers_are_known():
    case = case_of(line(angle=0), ccw(x_center=50, y_center=20, radius=10), line(tangent=True, x_end=90))
    async with operator(program_of(case)) as one:
        await one.press("pagedown")
        await drawn(one)
        assert one.session.derived_block.solved.runs[0].taken is None
        assert part_drawn(one, Style.SURFACE) > 8
        await to(one, 2, "x_center")
        before = one.screen.query_one("#loupe", Drawing).drawn
        await one.press("delete", "'7", "'0")
        await drawn(one)
        after = one.screen.query_one("#loupe", Drawing).drawn
        assert before is not None
        assert after is not None
        assert before.picture.rows != after.picture.rows
