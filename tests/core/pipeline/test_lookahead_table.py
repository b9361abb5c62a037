"""The look-ahead table of a block: every value compensated and judged, and the recommended value."""

from dataclasses import fields, replace
from typing import Any

import pytest

from core.advice.lookahead_table import recommended
from core.output.passes import meets_solid
from core.pipeline.derive import advice_for_block, cutting_setup, derive, look_ahead_table
from core.pipeline.jobs import job
from core.program.edit import set_unit
from core.program.model import CutterComp, Number, PathChoice, ProgramParameters, Tool
from core.units import Unit, sentence
from core.verify.judge import judge
from tests.bench.keys import gear
from tests.core.pipeline.parts import NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program
from tests.progress import looks_until_stopped


def table(points, comp):
    part = program(block(points, comp))
    (derived,) = derive(part).blocks
    return look_ahead_table(derived, part)


def test_the_notch_is_clean_from_a_look_ahead_of_three_which_is_recommended():
    values = table(NOTCH, CutterComp.LEFT)
    assert [row.value for row in values.rows] == list(range(1, 21))
    assert [row.clean for row in values.rows] == [False] * 2 + [True] * 18
    assert values.row(2).gouge > 0.2 * 25.4
    assert values.row(3).gouge == 0.0
    assert values.row(3).deleted == (2.0, 3.0, 4.0)
    assert values.recommended == 3


def test_the_over_run_square_is_clean_at_every_value_and_complete_at_one_and_two():
    values = table(OVER_RUN_SQUARE, CutterComp.RIGHT)
    assert all(row.clean for row in values.rows)
    assert [row.uncut == 0.0 for row in values.rows] == [True] * 2 + [False] * 18
    assert values.recommended == 1


def test_there_is_no_table_without_compensation():
    assert table(OUTSIDE_SQUARE, CutterComp.ON) is None


def comparable(verdict):
    return [list(value) if name == "uncut" else value for name, value in _values(verdict)]


def _values(verdict):
    return [(field.name, getattr(verdict, field.name)) for field in fields(verdict)]


@pytest.mark.parametrize("choice", list(PathChoice))
@pytest.mark.parametrize("points", [NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE])
def test_every_value_is_judged_by_its_own_path(points, choice):
    part = program(block(points, CutterComp.RIGHT), parameters=ProgramParameters(path=choice))
    (derived,) = derive(part).blocks
    assert derived.paths is not None
    assert derived.side is not None
    assert derived.radius is not None
    rows = look_ahead_table(derived, part).rows
    for row in rows:
        assert comparable(row.verdict) == comparable(
            judge(derived.paths.surface, derived.side, derived.radius, row.compensated.with_leads)
        )


class Judged:
    def __init__(self, value, clean, uncut):
        self.value, self.clean, self.uncut = value, clean, uncut


def test_the_recommended_value_is_clean_then_leaves_least_then_is_smallest():
    rows: list[Any] = [Judged(1, False, 0.0), Judged(2, True, 3.0), Judged(3, True, 1.0), Judged(4, True, 1.0 + 1e-9)]
    assert recommended(rows) == 3
    assert recommended(rows[:1]) is None
    assert recommended([]) is None


SLOT = ((0, 0), (40, 0), (40, -5), (52, -5), (52, 0), (90, 0))


def test_a_value_is_clean_only_if_its_roughing_passes_are_clean():
    """The 8 mm cutter fits into the 12 mm slot; the pass that leaves 8 mm does not and needs a look-ahead of 3."""
    tools = (Tool(1, diameter=Number(8.0)),)
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), max_offset=Number(8.0))
    part = replace(program(block(SLOT, CutterComp.PROFILE_LEFT), parameters=parameters), unit=Unit.MM, tools=tools)
    (derived,) = derive(part).blocks
    table = look_ahead_table(derived, part)
    assert [row.clean for row in table.rows[:3]] == [False, False, True]
    assert table.recommended == 3
    assert table.row(1).gouge == pytest.approx(4.0, abs=0.5)


def test_segments_that_only_roughing_deletes_are_reported():
    tools = (Tool(1, diameter=Number(8.0)), Tool(2, diameter=Number(8.0)))
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(3.0))
    typed = block(SLOT, CutterComp.LEFT, finish_tool=Number(2), lookahead=Number(3))
    part = replace(program(typed, parameters=parameters), unit=Unit.MM, tools=tools)
    (derived,) = derive(part).blocks
    (warning,) = [finding for finding in derived.findings if finding.code == "ROUGH_DELETES"]
    assert warning.text.endswith("skips segments 2, 3, 4: the next pass cuts solid stock there.")
    assert meets_solid(job(derived, part)) == {2, 3, 4}


@pytest.mark.parametrize("start", [0.0, 1.0, 2.0, 3.0, 5.0, 10.0])
@pytest.mark.parametrize("unit", list(Unit))
def test_a_gap_of_the_last_digit_is_closed_anywhere(start, unit):
    points = ((start, 0), (start + 2, 0), (start + 2, 2), (start, 2), (start - 1, 1), (start + 0.0001, 0))
    part = set_unit(program(block(points, CutterComp.LEFT)), unit)
    assert derive(part).blocks[0].solved.closed


def test_a_field_that_prevents_posting_is_an_error_of_the_block():
    part = program(block(NOTCH, CutterComp.LEFT, lookahead=Number(3), speed=Number(0)))
    assert [finding.code for finding in derive(part).blocks[0].errors] == ["OUT_OF_RANGE"]


def test_a_clean_contour_gets_empty_advice():
    part = program(block(OUTSIDE_SQUARE, CutterComp.RIGHT))
    assert advice_for_block(derive(part).blocks[0], part) == ()


def test_a_block_without_compensation_gets_no_advice():
    part = program(block(OUTSIDE_SQUARE, CutterComp.ON))
    assert advice_for_block(derive(part).blocks[0], part) == ()


def test_the_advice_for_the_notch_names_the_clean_look_ahead():
    part = program(block(NOTCH, CutterComp.LEFT))
    advice = advice_for_block(derive(part).blocks[0], part)
    assert [finding.code for finding in advice] == ["CAL_NOT_CLEAN"]
    text = "CAL 2 gouges. Enter look-ahead 3, which does not gouge but leaves 0.9000 uncut."
    assert sentence(advice[0], part.unit) == text
    assert advice[0].at is not None


@pytest.mark.parametrize("tries", range(8))
def test_unwanted_advice_stops_before_the_next_remedy(tries):
    """The gear tries six starts and one without blend moves; the advice asks before each and stops at the first no."""
    part = gear(200)
    derived = derive(part).blocks[0]
    asked = looks_until_stopped(lambda check: advice_for_block(derived, part, progress=check), tries)
    assert asked == tries + 1


def test_the_first_tool_roughs_before_a_finish_tool():
    """TOOL with a diameter of 0.5 leaves FINISH XY for FINISH TOOL with 0.25."""
    rough = block(OUTSIDE_SQUARE, CutterComp.RIGHT)
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.02))
    for finish, radius, rougher in ((Number(2), 0.125, 0.25), (None, 0.25, None)):
        part = program(replace(rough, finish_tool=finish), parameters=parameters)
        cutting = cutting_setup(derive(part).blocks[0], part)
        assert cutting.radius == pytest.approx(25.4 * radius)
        assert cutting.rougher == (None if rougher is None else pytest.approx(25.4 * rougher))
