"""Runs on the MILL CONTOUR form: the header, missing values, CAL while typing, SOLUTION, refusals, the drawing."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.widgets.drawing import Drawing
from core.draw.scene import Style
from core.program.edit import FormPlace
from core.program.model import Number, Program
from tests.app.widget_pilot import Operator
from tests.core.program.run_files import program_of
from tests.core.program.test_calculated_runs import BAD, case_of, ccw, cw, line

pytestmark = pytest.mark.asyncio(loop_scope="module")

GOLDEN = json.loads((Path(__file__).parents[2] / "data/calculated_runs/golden.json").read_text(encoding="utf-8"))


def golden(number: str) -> Program:
    return program_of(next(case for case in GOLDEN if case["name"].startswith(number)))


def header(user: Operator) -> str:
    return str(user.screen.query_one("#segment-kind").render())


async def to(user: Operator, segment: int, field: str) -> None:
    """Move the cursor to a field of a segment."""
    user.app.move(FormPlace(1, segment), field)
    await user.settle()
    assert user.at == field


async def test_the_header_names_the_run_on_each_of_its_segments(user: Operator):
    case = case_of(line(x_end=-10, y_end=0), line(angle=30), line(x_end=100, y_end=0, angle=300))
    await user.begin(program_of(case))
    headers = []
    for _ in range(3):
        await user.press("pagedown")
        headers.append(header(user))
    assert headers == ["LINE", "LINE    RUN 2-3", "LINE    RUN 2-3"]


async def test_an_incomplete_run_counts_its_missing_values_on_each_segment(user: Operator):
    case = case_of(line(angle=0), ccw(tangent=True), line(tangent=True, angle=90, x_end=60, y_end=40))
    await user.begin(program_of(case))
    for _ in range(3):
        await user.press("pagedown")
        assert header(user).endswith("RUN 1-3  1 more value")
        assert user.prompt.startswith("Segments 1 to 3 need 1 more value: RADIUS of 2, or an end (X END or Y END)")
    await to(user, 2, "radius")
    assert user.prompt.startswith("Radius of the arc.\nSegments 1 to 3 need 1 more value: RADIUS of 2")
    await user.press("tab", "tab")
    assert user.at == "start_angle"
    assert user.prompt.startswith("Direction in which the arc starts, from +X.")
    await to(user, 2, "radius")
    await user.press("'10", "tab")
    assert header(user) == "ARC     RUN 1-3"
    assert (user.value("x_end"), user.tag("x_end")) == ("60.000", "CAL")


async def test_a_half_typed_number_recalculates_the_run_and_escape_restores_it(user: Operator):
    await user.begin(golden("c18"))
    await to(user, 2, "radius")
    assert (user.value("x_end"), user.tag("x_end")) == ("60.000", "CAL")
    await user.press("delete", "'2")
    assert (user.value("y_end"), user.tag("y_end"), user.value("radius")) == ("2.000", "CAL", "2")
    await user.press("'0")
    assert (user.value("y_end"), user.value("x_center")) == ("20.000", "40.000")
    assert user.session.history.undo_count == 0
    await user.press("escape")
    assert (user.value("y_end"), user.value("radius")) == ("10.000", "10.000")


async def test_a_half_typed_number_without_a_solution_keeps_its_text_and_undo_names_the_run(user: Operator):
    await user.begin(golden("c18"))
    await to(user, 2, "radius")
    await user.press("delete", "'7", "'0")
    assert user.value("radius") == "70"
    assert user.value("x_end") == ""
    await user.press("enter")
    assert "RADIUS 70.000 does not fit between segments 1 and 3: the largest is 39.999." in user.prompt
    await user.press("ctrl+z")
    assert user.prompt.startswith("Undone: RADIUS of segment 2, run 1-3, block 1.")
    assert user.value("y_end") == "10.000"
    await to(user, 2, "tangent")
    await user.press("space")
    assert user.value("tangent") == "NO"
    assert "1 more value" in header(user)
    await user.press("space")
    assert (user.value("tangent"), header(user)) == ("YES", "ARC     RUN 1-3")


async def test_solution_replaces_start_and_is_stepped_with_space_and_arrows(user: Operator):
    await user.begin(golden("c24"))
    await to(user, 2, "choice")
    assert not user.row("START").display
    assert user.row("choice").display
    assert user.row("choice").input is not None
    assert "? of 2" in str(user.row("choice").input.query_one("#label").render())
    ends = []
    for key in ("space", "space", "left", "right"):
        await user.press(key)
        ends.append((user.value("choice"), user.value("x_end")))
    assert ends == [("1 of 2", "68.678"), ("2 of 2", "66.604"), ("1 of 2", "68.678"), ("2 of 2", "66.604")]
    await user.press("ctrl+z")
    assert (user.session.place.segment, user.value("choice"), user.value("x_end")) == (1, "1 of 2", "18.413")


async def test_solution_appears_on_the_form_as_soon_as_two_solutions_fit(user: Operator):
    case = case_of(line(angle=30), line(x_end=70, y_end=10))
    await user.begin(program_of(case))
    await to(user, 2, "length")
    assert not user.row("choice").display
    await user.press("'40", "enter")
    assert user.prompt.startswith("Two solutions fit: pick one on SOLUTION.")
    await to(user, 1, "choice")
    await user.press("right")
    assert (user.value("choice"), user.value("x_end")) == ("1 of 2", "30.760")
    await to(user, 2, "length")
    await user.press("delete", "enter")
    assert not user.row("choice").display


async def test_enter_stops_at_solution_until_one_is_chosen(user: Operator):
    await user.begin(golden("c24"))
    await to(user, 2, "radius")
    stops = []
    for _ in range(4):
        await user.press("enter")
        stops.append((user.session.place.segment, user.at))
        if user.at == "choice":
            break
    assert stops[-1] == (2, "choice")
    await user.press("right")
    await to(user, 2, "feed")
    await user.press("enter")
    assert user.session.place.segment == 3


async def test_enter_stops_at_the_fields_of_the_last_arc_while_data_are_missing(user: Operator):
    case = case_of(ccw(x_center=0, y_center=20, radius=20), cw(radius=30, tangent=True), ccw(tangent=True))
    await user.begin(program_of(case))
    await to(user, 3, "x_end")
    await user.press("'80", "enter", "'45", "enter")
    assert user.at == "x_center"
    await user.press("'80", "enter", "'30", "enter")
    typed = user.session.block.segments[2]
    assert (typed.x_end, typed.y_end) == (Number(80.0), Number(45.0))
    assert (typed.x_center, typed.y_center) == (Number(80.0), Number(30.0))


async def test_an_incomplete_last_segment_says_that_the_next_one_may_complete_it(user: Operator):
    await user.begin(program_of(case_of(line(angle=30))))
    await to(user, 1, "x_end")
    assert user.prompt.endswith("Or Page Down: the next segment may give it.")
    await user.press("pagedown", "'100", "tab", "'0", "tab")
    assert "1 more value" in user.prompt
    assert "Page Down" not in user.prompt


# messages


KEYED = [bad for bad in BAD if bad[0] not in ("TANGENT_PLACE", "PARALLEL_TO", "RADII_DIFFER")]
"""Those of runs that a number completes; an arc between known points is no run."""


def last_number(case: dict[str, Any]) -> tuple[int, str, float]:
    """The last number typed in a case: its segment, field and value."""
    for number in range(len(case["segments"]), 0, -1):
        names = [name for name, value in case["segments"][number - 1].items() if isinstance(value, int | float)]
        names = [name for name in names if name != "tangent"]
        if names:
            return number, names[-1], case["segments"][number - 1][names[-1]]
    raise AssertionError(case)


def blanked(program: Program, segment: int, field: str) -> Program:
    """The program with a field of a segment blanked."""
    block = program.blocks[0]
    blank: dict[str, Any] = {field: None}
    before = replace(block.segments[segment - 1], **blank)
    segments = (*block.segments[: segment - 1], before, *block.segments[segment:])
    return replace(program, blocks=(replace(block, segments=segments),))


async def test_each_refusal_appears_as_soon_as_the_last_number_is_typed(user: Operator):
    for code, text, case in KEYED:
        segment, field, value = last_number(case)
        await user.begin(blanked(program_of(case), segment, field), segment, field)
        await user.press(f"'{value:g}", "enter")
        assert text in " ".join(user.prompt.split("\n")), code
        assert user.session.derived_block.solved.runs[0].code == code


async def test_blanking_either_of_two_contradicting_numbers_resolves_the_run(user: Operator):
    case = case_of(line(angle=30), line(x_end=100, y_end=0, angle=300))
    await user.begin(program_of(case))
    for field, answers in (("length", (1, None)), ("angle", (2, "PICK_SOLUTION"))):
        await user.begin(program_of(case), 2, "length")
        await user.press("'51", "enter")
        assert (user.at, "XY LENGTH is 51.000, but 50.000" in user.prompt) == ("length", True)
        await to(user, 2, field)
        await user.press("delete", "tab")
        run = user.session.derived_block.solved.runs[0]
        assert (len(run.answers), run.code) == answers, field


async def test_a_message_about_a_run_is_not_shown_on_segments_outside_it(user: Operator):
    case = case_of(line(angle=30), line(x_end=100, y_end=0, angle=120), line(x_end=0, y_end=50))
    await user.begin(program_of(case))
    await user.press("pagedown", "tab")
    assert "50.000 backwards" in user.prompt
    await user.press("pagedown", "pagedown", "tab")
    assert header(user) == "LINE"
    assert "backwards" not in user.prompt


async def test_a_typed_length_is_taken_and_leaves_two_solutions(user: Operator):
    case = case_of(cw(radius=12), line(tangent=True, x_end=50, y_end=-20))
    await user.begin(program_of(case))
    await to(user, 2, "length")
    await user.press("'45", "enter")
    assert user.session.block.segments[1].length == Number(45.0)
    assert user.session.derived_block.solved.runs[0].code == "PICK_SOLUTION"


# the drawing


def cells_drawn(user: Operator, style: Style) -> int:
    """The number of loupe cells drawn in a style."""
    picture = user.screen.query_one("#loupe", Drawing).drawn
    return 0 if picture is None else int((picture.picture.styles == style.value).sum())


async def drawn(user: Operator) -> None:
    """Wait for the drawings."""
    await user.finish()
    await user.settle()


async def test_other_solutions_are_dotted_while_the_cursor_is_on_their_run(user: Operator):
    await user.begin(golden("c24"))
    await to(user, 1, "choice")
    await drawn(user)
    surface_cells = cells_drawn(user, Style.SURFACE)
    assert surface_cells
    assert not cells_drawn(user, Style.UNTAKEN)
    pictures = []
    for _ in range(2):
        await user.press("space")
        await drawn(user)
        assert cells_drawn(user, Style.UNTAKEN) > 4
        loupe = user.screen.query_one("#loupe", Drawing).drawn
        assert loupe is not None
        pictures.append(loupe.picture.rows)
    assert pictures[0] != pictures[1]
    await user.press("ctrl+home")
    await drawn(user)
    assert not cells_drawn(user, Style.UNTAKEN)


async def test_an_undetermined_run_is_sketched_from_known_headings_and_centers(user: Operator):
    case = case_of(line(angle=0), ccw(x_center=50, y_center=20, radius=10), line(tangent=True, x_end=90))
    await user.begin(program_of(case))
    await user.press("pagedown")
    await drawn(user)
    assert user.session.derived_block.solved.runs[0].taken is None
    assert cells_drawn(user, Style.SURFACE) > 8
    await to(user, 2, "x_center")
    before = user.screen.query_one("#loupe", Drawing).drawn
    await user.press("delete", "'7", "'0")
    await drawn(user)
    after = user.screen.query_one("#loupe", Drawing).drawn
    assert before is not None
    assert after is not None
    assert before.picture.rows != after.picture.rows


async def test_a_contradiction_on_another_segment_is_named_with_its_number(user: Operator):
    text = "XY LENGTH is 49.000, but 50.000 by segments 1 and 2: correct or blank one of them."
    await user.begin(program_of(case_of(line(angle=30), line(x_end=100, y_end=0, angle=300, length=49))))
    await user.press("pagedown")
    assert user.prompt.startswith(f"Segment 2: {text}")
    await user.press("pagedown")
    assert user.prompt.startswith(text)


async def test_a_contradiction_that_names_its_segment_gets_no_number_before_it(user: Operator):
    segments = line(angle=30), line(tangent=True, angle=60, x_end=50, y_end=50)
    await user.begin(program_of(case_of(*segments)))
    await user.press("pagedown")
    assert user.prompt.startswith("Segment 2 is not tangent to the one before")
