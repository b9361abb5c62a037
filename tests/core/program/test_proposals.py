"""Proposals of the tool table and COOLANT: filled into blanks, kept in files, posted."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.pipeline.derive import derive
from core.pipeline.post import post_center_path
from core.program.edit import FormPlace, Refused, choose, set_tool
from core.program.file.read import StoreError, loads
from core.program.file.write import dumps
from core.program.model import Coolant, Number, Program, Tool, Unread, changed
from core.program.solve.block import solve_block
from core.program.solve.solved import Origin, Solved, SolvedBlock
from core.units import Unit
from tests.core.program.parts import line, program

SQUARE = (line(y_end=20.0), line(x_end=20.0), line(y_end=0.0), line(x_end=0.0))
PROPOSING = Tool(1, "END MILL", Number(0.5), Number(2400.0), Number(12.0), Number(5.0), Coolant.FLOOD)


def part(tool: Tool = PROPOSING, **start: object) -> Program:
    """A metric square whose block leaves SPEED and PLUNGE FEED blank."""
    given = program(*SQUARE, start={"speed": None, "plunge_feed": None, "cutter_comp": "LEFT", **start})
    return replace(given, tools=(tool,))


def solved(given: Program) -> SolvedBlock:
    return solve_block(given.blocks[0], given)


def test_blanks_take_the_values_of_the_tool_table():
    block = solved(part())
    assert block.values["speed"] == Solved(2400.0, Origin.TOOL)
    assert block.values["plunge_feed"] == Solved(5.0, Origin.TOOL)
    assert (block.speed, block.plunge_feed) == (2400.0, 5.0)
    assert [segment.values["feed"] for segment in block.segments] == [Solved(12.0, Origin.TOOL)] * 4
    assert (block.coolant, block.coolant_origin) == (Coolant.FLOOD, Origin.TOOL)
    assert block.findings == ()


def test_typed_values_take_precedence_over_the_tool_table():
    block = solved(part(speed=Number(900.0), coolant=Coolant.OFF))
    assert block.speed == 900.0
    assert (block.coolant, block.coolant_origin) == (Coolant.OFF, None)
    given = part()
    first = changed(given.blocks[0].segments[1], {"feed": Number(7.0)})
    segments = (given.blocks[0].segments[0], first, *given.blocks[0].segments[2:])
    feeds = solved(replace(given, blocks=(replace(given.blocks[0], segments=segments),))).segments
    assert [segment.feed for segment in feeds] == [12.0, 7.0, 7.0, 7.0]
    assert feeds[2].values["feed"] == Solved(7.0)


def test_speed_and_plunge_feed_are_missing_without_proposals():
    block = solved(part(Tool(1, diameter=Number(0.5))))
    assert [finding.field for finding in block.findings] == ["plunge_feed", "speed"]
    assert (block.coolant, block.coolant_origin) == (Coolant.OFF, Origin.USUAL)


@pytest.mark.parametrize("speed", [Number(0.0), Unread("12o0", "Type a number.")])
def test_an_unusable_proposal_is_ignored(speed):
    block = solved(part(replace(PROPOSING, speed=speed)))
    assert "speed" in [finding.field for finding in block.findings]


def test_an_inch_program_proposes_in_inches():
    given = replace(part(), unit=Unit.IN)
    assert solved(given).segments[0].feed == pytest.approx(12.0 * 25.4)


def test_proposals_and_coolant_are_kept_in_a_file_of_format_2():
    given = part(coolant=Coolant.MIST)
    text = dumps(given)
    assert text.startswith("format = 2 ")
    assert 'coolant = "MIST"' in text
    assert loads(text, "part.toml") == given


def test_an_unknown_coolant_is_refused():
    text = dumps(part(coolant=Coolant.MIST)).replace('"MIST"', '"OIL"')
    with pytest.raises(StoreError, match="coolant cannot be OIL: write one of OFF, MIST, FLOOD"):
        loads(text, "part.toml")


def test_coolant_can_be_chosen_and_blanked():
    picked = choose(part(), FormPlace(1), "coolant", "MIST")
    assert isinstance(picked, Program)
    assert picked.blocks[0].coolant is Coolant.MIST
    assert choose(picked, FormPlace(1), "coolant", None) == part()


def test_a_proposal_out_of_range_is_refused():
    refused = set_tool(part(), replace(PROPOSING, speed=Number(-5.0)))
    assert refused == Refused("SPEED (RPM) must be a whole number from 1 to 100000.")


@pytest.mark.parametrize(("coolant", "code"), [(Coolant.MIST, "M7"), (Coolant.FLOOD, "M8"), (Coolant.OFF, None)])
def test_coolant_is_switched_on_after_the_spindle_and_off_before_it_stops(coolant, code):
    posted = post_center_path(derive(part(coolant=coolant)), name="PART")
    lines = [text for text in posted.text.splitlines() if text in ("M5", "M7", "M8", "M9") or text.endswith("M3")]
    assert lines == (["S2400 M3", code, "M9", "M5"] if code else ["S2400 M3", "M5"])
