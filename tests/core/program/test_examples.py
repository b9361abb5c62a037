"""The example parts are whole: everything typed, determined and in its range."""

from __future__ import annotations

from pathlib import Path

import pytest

from core.program.file.read import loads
from core.program.model import CutterComp, Number, Program
from core.program.solve.block import solve_block
from core.program.solve.solved import SolvedBlock
from core.units import Unit
from tests.core.program.parts import postable

EXAMPLES = Path(__file__).parents[3] / "app" / "examples"
NAMES = ("overrun-square", "pocket", "notch", "plate-mm", "flange")


def example(name: str) -> tuple[Program, list[SolvedBlock]]:
    part = loads((EXAMPLES / f"{name}.toml").read_text(), name)
    return part, [solve_block(block, part) for block in part.blocks]


def test_the_tested_examples_are_all_examples():
    assert {path.stem for path in EXAMPLES.glob("*.toml")} == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_every_example_is_determined(name):
    _, blocks = example(name)
    for block in blocks:
        assert block.all_findings == ()
        assert postable(block)


def test_the_overrun_square_has_the_values_of_the_screen_of_the_control():
    part, (solved,) = example("overrun-square")
    block = part.blocks[0]
    assert part.unit is Unit.IN
    assert (block.tool, block.cutter_comp, block.finish_tool) == (Number(1.0), CutterComp.RIGHT, Number(0.0))
    assert (block.x_start, block.y_start) == (Number(-1.0), Number(0.0))
    assert (block.z_start, block.z_bottom) == (Number(0.0), Number(-0.25))
    assert (block.plunge_feed, block.speed, block.peck_depth) == (Number(20.0), Number(300.0), Number(0.0))
    assert block.lookahead is None
    assert part.tools[0].diameter == Number(0.5)
    ends = [segment.end for segment in solved.segments]
    inches = [(round(end[0] / 25.4, 9), round(end[1] / 25.4, 9)) for end in ends if end]
    assert inches == [(2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, -1.0)]
    assert not solved.closed


def test_the_pocket_is_closed_and_has_eleven_segments():
    part, (solved,) = example("pocket")
    assert part.blocks[0].cutter_comp is CutterComp.LEFT
    assert (part.blocks[0].peck_depth, len(solved.segments)) == (Number(0.1), 11)
    assert solved.closed


def test_the_plate_is_metric_with_a_finish_tool_and_several_passes():
    part, (solved,) = example("plate-mm")
    assert part.unit is Unit.MM
    assert part.blocks[0].cutter_comp is CutterComp.PROFILE_LEFT
    assert (solved.tool_diameter, solved.finish_diameter) == (16.0, 12.0)
    assert part.parameters.max_offset == Number(12.0)
    assert solved.closed


def test_the_flange_has_two_closed_blocks():
    part, blocks = example("flange")
    assert [block.closed for block in blocks] == [True, True]
    assert [block.tool for block in part.blocks] == [Number(1.0), Number(2.0)]
