"""The look-ahead table of a block: every value cut and judged, and the value it recommends."""

from dataclasses import fields, replace

import pytest

from core.comp.lookahead import recommended
from core.output.passes import meets_solid
from core.pipeline.derive import advice_for_block, cutting_setup, derive, look_ahead_table
from core.pipeline.jobs import job
from core.program.edit import set_unit
from core.program.model import CutterComp, Number, PathChoice, ProgramParameters, Tool
from core.units import Unit, sentence
from core.verify.judge import judge
from tests.bench.keys import gear
from tests.core.pipeline.parts import NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE, block, program


def table(points, comp):
    part = program(block(points, comp))
    (found,) = derive(part).blocks
    return look_ahead_table(found, part)


def test_the_notch_is_clean_from_three_and_three_is_recommended():
    found = table(NOTCH, CutterComp.LEFT)
    assert [row.value for row in found.rows] == list(range(1, 21))
    assert [row.clean for row in found.rows] == [False] * 2 + [True] * 18
    assert found.row(2).gouge > 0.2 * 25.4
    assert found.row(3).gouge == 0.0
    assert found.row(3).deleted == (2.0, 3.0, 4.0)
    assert found.recommended == 3


def test_the_over_run_square_is_clean_at_every_value_and_cut_at_one_and_two():
    found = table(OVER_RUN_SQUARE, CutterComp.RIGHT)
    assert all(row.clean for row in found.rows)
    assert [row.uncut == 0.0 for row in found.rows] == [True] * 2 + [False] * 18
    assert found.recommended == 1


def test_there_is_no_table_without_compensation():
    assert table(OUTSIDE_SQUARE, CutterComp.ON) is None


def told(verdict):
    return [list(value) if name == "uncut" else value for name, value in _values(verdict)]


def _values(verdict):
    return [(one.name, getattr(verdict, one.name)) for one in fields(verdict)]


@pytest.mark.parametrize("choice", list(PathChoice))
@pytest.mark.parametrize("points", [NOTCH, OUTSIDE_SQUARE, OVER_RUN_SQUARE])
def test_every_value_is_judged_by_its_own_path(points, choice):
    part = program(block(points, CutterComp.RIGHT), parameters=ProgramParameters(path=choice))
    (found,) = derive(part).blocks
    assert found.paths is not None
    assert found.side is not None
    assert found.radius is not None
    rows = look_ahead_table(found, part).rows
    for row in rows:
        assert told(row.verdict) == told(judge(found.paths.surface, found.side, found.radius, row.compensated.whole))


class Fate:
    def __init__(self, value, clean, uncut):
        self.value, self.clean, self.uncut = value, clean, uncut


def test_the_recommended_value_is_clean_then_leaves_least_then_is_smallest():
    fates = [Fate(1, False, 0.0), Fate(2, True, 3.0), Fate(3, True, 1.0), Fate(4, True, 1.0 + 1e-9)]
    assert recommended(fates) == 3
    assert recommended(fates[:1]) is None
    assert recommended([]) is None


SLOT = ((0, 0), (40, 0), (40, -5), (52, -5), (52, 0), (90, 0))


def test_a_value_is_clean_only_if_its_roughing_passes_are():
    """The cutter of 8 fits into the slot of 12; the pass that leaves 8 does not, and needs a look-ahead of 3."""
    tools = (Tool(1, diameter=Number(8.0)),)
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), max_offset=Number(8.0))
    part = replace(program(block(SLOT, CutterComp.PROFILE_LEFT), parameters=parameters), unit=Unit.MM, tools=tools)
    (found,) = derive(part).blocks
    table = look_ahead_table(found, part)
    assert [row.clean for row in table.rows[:3]] == [False, False, True]
    assert table.recommended == 3
    assert table.row(1).gouge == pytest.approx(4.0, abs=0.5)


def test_segments_that_only_roughing_deletes_are_told():
    tools = (Tool(1, diameter=Number(8.0)), Tool(2, diameter=Number(8.0)))
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(3.0))
    typed = block(SLOT, CutterComp.LEFT, finish_tool=Number(2), lookahead=Number(3))
    part = replace(program(typed, parameters=parameters), unit=Unit.MM, tools=tools)
    (found,) = derive(part).blocks
    (told,) = [finding for finding in found.findings if finding.code == "ROUGH_DELETES"]
    assert told.text.endswith("skips segments 2, 3, 4: the next pass cuts solid stock there.")
    assert meets_solid(job(found, part)) == {2, 3, 4}


@pytest.mark.parametrize("start", [0.0, 1.0, 2.0, 3.0, 5.0, 10.0])
@pytest.mark.parametrize("unit", list(Unit))
def test_a_gap_of_the_forms_last_digit_is_closed_wherever_it_is(start, unit):
    points = ((start, 0), (start + 2, 0), (start + 2, 2), (start, 2), (start - 1, 1), (start + 0.0001, 0))
    part = set_unit(program(block(points, CutterComp.LEFT)), unit)
    assert derive(part).blocks[0].solved.closed


def test_what_forbids_posting_is_a_finding_of_the_block():
    part = program(block(NOTCH, CutterComp.LEFT, lookahead=Number(3), speed=Number(0)))
    assert [finding.code for finding in derive(part).blocks[0].errors] == ["OUT_OF_RANGE"]


def test_a_clean_contour_needs_nothing():
    part = program(block(OUTSIDE_SQUARE, CutterComp.RIGHT))
    found = advice_for_block(derive(part).blocks[0], part)
    assert found is not None
    assert not found.sentences


def test_without_compensation_nothing_is_known():
    part = program(block(OUTSIDE_SQUARE, CutterComp.ON))
    assert advice_for_block(derive(part).blocks[0], part) is None


def test_the_notch_is_told_the_look_ahead_that_is_clean():
    part = program(block(NOTCH, CutterComp.LEFT))
    found = advice_for_block(derive(part).blocks[0], part)
    assert found is not None
    assert [finding.code for finding in found.sentences] == ["CAL_NOT_CLEAN"]
    said = "CAL 2 gouges. Enter look-ahead 3, which does not gouge but leaves 0.9000 uncut."
    assert sentence(found.sentences[0], part.unit) == said
    assert found.sentences[0].at is not None
    assert found.tool is None
    assert found.start is None


@pytest.mark.parametrize("tries", range(8))
def test_remedies_nobody_waits_for_are_given_up_at_the_next_one(tries):
    """The gear tries six starts and one without blend moves: each is asked before, none after the answer was no."""
    part = gear(200)
    found = derive(part).blocks[0]
    asked: list[bool] = []

    def wanted() -> bool:
        still = bool(len(asked) < tries)
        asked.append(still)
        return still

    assert advice_for_block(found, part, wanted=wanted) is None
    assert asked == [True] * tries + [False]


def test_roughing_passes_are_cut_by_tool_where_a_finish_tool_follows():
    """TOOL is 0.5 across, FINISH TOOL 0.25: it leaves FINISH XY before."""
    rough = block(OUTSIDE_SQUARE, CutterComp.RIGHT)
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), finish_xy=Number(0.02))
    for finish, radius, rougher in ((Number(2), 0.125, 0.25), (None, 0.25, None)):
        part = program(replace(rough, finish_tool=finish), parameters=parameters)
        asked = cutting_setup(derive(part).blocks[0], part)
        assert asked.radius == pytest.approx(25.4 * radius)
        assert asked.rougher == (None if rougher is None else pytest.approx(25.4 * rougher))
