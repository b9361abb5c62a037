"""START: what must be typed, what contradicts itself, what a blank stands for."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.finding import Severity
from core.program.model import CutterComp, Entry, Tool, Unread
from core.program.solve.block import NEEDED, solve_block
from core.program.solve.solved import Solved
from core.units import Unit, sentence
from tests.core.program.parts import line, program

ALONG = line(x_end=1.0, y_end=0.0)


def findings(**start: object) -> list[str]:
    given = program(ALONG, unit=Unit.IN, start=start)
    found = solve_block(given.blocks[0], given).findings
    return [f"{one.code} {one.severity} {one.field}: {sentence(one, Unit.IN)}" for one in found]


def test_nothing_is_wrong_with_a_whole_start():
    assert findings() == []


@pytest.mark.parametrize("name", NEEDED)
def test_blanks_are_named(name):
    (text,) = findings(**{name: None})
    assert text.startswith(f"MISSING error {name}: ")
    assert text.endswith(" is blank: enter it on START.")


def test_a_wrong_tool_comes_before_what_is_still_blank():
    found = findings(tool=Entry(7.0), finish_tool=Entry(8.0), x_start=None, y_start=None)
    assert [text.split(":")[0] for text in found] == [
        "TOOL_MISSING error tool",
        "TOOL_MISSING error finish_tool",
        "MISSING error x_start",
        "MISSING error y_start",
    ]


def test_blanks_that_stand_for_zero_are_calculated():
    given = program(ALONG, start={"finish_tool": None, "peck_depth": None})
    block = solve_block(given.blocks[0], given)
    assert (block.values["finish_tool"], block.values["peck_depth"]) == (Solved(0.0), Solved(0.0))
    assert (block.peck_depth, block.finish_diameter) == (0.0, None)
    assert block.postable


@pytest.mark.parametrize(
    ("start", "text"),
    [
        ({"tool": Entry(5.0)}, "TOOL_MISSING error tool: Tool 5 is not in the tool table"),
        ({"finish_tool": Entry(5.0)}, "TOOL_MISSING error finish_tool: Tool 5 is not in the tool table"),
        ({"tool": Entry(2.5)}, "OUT_OF_RANGE error tool: TOOL must be a whole number from 1 to 9999."),
        ({"lookahead": Entry(21.0)}, "OUT_OF_RANGE error lookahead: CUTCOMP LOOKAHEAD must be a whole number"),
        ({"speed": Unread("x", "Type a number.")}, "UNREADABLE error speed: SPEED (RPM): x cannot be read."),
        (
            {"z_bottom": Entry(0.5)},
            "Z_ORDER error z_bottom: Z BOTTOM 0.5000 is above Z START 0.0000: it must be below.",
        ),
        ({"z_bottom": Entry(0.0)}, "Z_ORDER warning z_bottom: Z BOTTOM is at Z START: nothing is cut."),
    ],
)
def test_trouble_of_start(start, text):
    assert findings(**start)[0].startswith(text)


def test_no_segments():
    given = program()
    block = solve_block(given.blocks[0], given)
    (finding,) = block.findings
    assert (finding.code, finding.segment) == ("NO_SEGMENTS", 0)
    assert not block.postable
    assert not block.closed


@pytest.mark.parametrize("diameter", [None, Entry(0.0), Entry(-0.5)])
@pytest.mark.parametrize(("comp", "severity"), [(CutterComp.RIGHT, Severity.ERROR), (CutterComp.ON, Severity.WARNING)])
def test_a_tool_without_size_matters_less_on_the_contour(diameter, comp, severity):
    given = replace(program(ALONG, start={"cutter_comp": comp}), tools=(Tool(1, diameter=diameter),))
    block = solve_block(given.blocks[0], given)
    (finding,) = block.findings
    assert (finding.code, finding.severity, finding.field) == ("TOOL_DIAMETER", severity, "tool")
    assert block.tool_diameter is None


def test_both_tools():
    given = program(ALONG, start={"finish_tool": Entry(2.0)})
    given = replace(given, tools=(*given.tools, Tool(2, "FINISHER", Entry(0.25))))
    block = solve_block(given.blocks[0], given)
    assert (block.tool_diameter, block.tool_type, block.finish_diameter) == (0.5, "END MILL", 0.25)
