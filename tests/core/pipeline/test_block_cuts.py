"""Blocks that cut into one another's contours; the depths are worked out by hand beside each case."""

from __future__ import annotations

import pytest

from core.finding import Severity
from core.pipeline.derive import BLOCKS_SHARE, derive
from core.program.model import Block, CutterComp, Number, PathChoice, ProgramParameters
from core.progress import Stopped
from tests.core.pipeline.parts import Points, block, program

POCKET = ((1, 0), (4, 0), (4, 3), (0, 3), (0, 0), (1, 0))
"""Counterclockwise with the tool on the left: inside."""


def box(left: float, bottom: float, right: float, top: float) -> Points:
    """A clockwise rectangle: with the tool on the left, an island."""
    return ((left, bottom), (left, top), (right, top), (right, bottom), (left, bottom))


def island(left: float, bottom: float, right: float, top: float, **changes: Number) -> Block:
    return block(box(left, bottom, right, top), CutterComp.LEFT, **changes)


def cuts(*blocks: Block, parameters: ProgramParameters | None = None) -> list[tuple[int, str, float]]:
    """The block that cuts into another one, the sentence, and the depth in inches."""
    derived = derive(program(*blocks, parameters=parameters))
    findings = [(each.number, found) for each in derived.blocks for found in each.findings]
    assert not any(found.severity is Severity.ERROR for _, found in findings)
    return [
        (number, found.text, round((found.value or 0.0) / 25.4, 4))
        for number, found in findings
        if found.code == "OTHER_BLOCK"
    ]


def test_an_island_too_near_to_its_pocket() -> None:
    """The island is 0.4 from the pocket's left wall and the cutter 0.5 across: each path cuts 0.1 into the other."""
    pocket, near = block(POCKET, CutterComp.LEFT), island(0.4, 1, 2, 2)
    first, second = cuts(pocket, near)
    assert first[::2] == (1, 0.1)
    assert first[1] == (
        "The path of segment 4 cuts {value} into the contour of block 2 at X {x} Y {y}. "
        "Check that this wall may be cut."
    )
    assert second[::2] == (2, 0.1)
    assert second[1].startswith("The path of segment 1 cuts {value} into the contour of block 1 ")
    assert not cuts(pocket, island(0.5, 1, 2, 2))


def test_a_lead_in_that_cuts_an_island() -> None:
    """The blend-in arc of radius 0.75 begins 0.75 beside and above X 2, Y 0.25: at X 1.25, Y 1, within the island."""
    blends = ProgramParameters(blend_offset=Number(0.75), blend_overlap=Number(0))
    pocket = block(((2, 0), *POCKET[1:-1], (2, 0)), CutterComp.LEFT)
    found = cuts(pocket, island(1, 0.9, 1.5, 2.2), parameters=blends)
    assert found[0][0] == 1
    assert found[0][1].startswith("The blend-in arc ")


@pytest.mark.parametrize("peck", [0.0, 0.1])
def test_only_what_comes_down_to_the_floor_counts(peck: float) -> None:
    """The island is cut 0.1 deep: the pocket, at 0.25, cuts into it; its own path is a step in the pocket's wall."""
    pocket = block(POCKET, CutterComp.LEFT, peck_depth=Number(peck))
    assert [number for number, *_ in cuts(pocket, island(0.4, 1, 2, 2, z_bottom=Number(-0.1)))] == [1]


@pytest.mark.parametrize("finish", [Number(1), Number(2)])
def test_one_contour_in_two_blocks_is_one_wall(finish: Number) -> None:
    assert not cuts(block(POCKET, CutterComp.LEFT), block(POCKET, CutterComp.LEFT, tool=finish))


def test_a_roughing_contour_that_is_cut_away_is_no_wall() -> None:
    """The pocket is roughed 0.1 smaller on each side."""
    rough = block(((1, 0.1), (3.9, 0.1), (3.9, 2.9), (0.1, 2.9), (0.1, 0.1), (1, 0.1)), CutterComp.LEFT)
    assert not cuts(rough, block(POCKET, CutterComp.LEFT))


def test_a_groove_without_compensation_through_a_wall() -> None:
    """The groove runs from inside the pocket through its wall: the whole cutter is behind it."""
    groove = block(((2, 1.5), (6, 1.5)), CutterComp.ON)
    [(number, text, _)] = cuts(block(POCKET, CutterComp.LEFT), groove)
    assert number == 2
    assert text.startswith("The path of segment 1 runs through the contour of block 1 at X {x} Y {y}. ")


SLOT = ((5, 2), (3, 2), (3, 1), (5, 1))
"""From X 3 out to the right, its walls at Y 1 and Y 2; it runs on past a profile's edge at X 4."""


def test_a_slot_open_to_the_edge_is_named_once() -> None:
    """The profile's path crosses the slot's walls at X 4.25: only where the slot runs on outside the part."""
    profile, slot = island(0, 0, 4, 3), block(SLOT, CutterComp.LEFT)
    [(number, text, _)] = cuts(profile, slot)
    assert number == 2
    assert text.startswith("The path of segment 1 runs through the contour of block 1 ")
    assert [number for number, *_ in cuts(slot, profile)] == [1]
    assert not cuts(island(0, 0, 4, 3, z_bottom=Number(-0.5)), slot)


def test_each_block_that_cuts_into_one_contour_is_named() -> None:
    left = tuple((4 - x, y) for x, y in reversed(SLOT))
    profile, slots = island(0, 0, 4, 3), (block(SLOT, CutterComp.LEFT), block(left, CutterComp.LEFT))
    assert [number for number, *_ in cuts(profile, *slots)] == [2, 3]
    assert [number for number, *_ in cuts(profile, *slots, slots[0])] == [2, 3, 4]


def test_the_deepest_of_many_loops_is_told() -> None:
    """Necks of 0.1 part 12 chambers, a loop each; the highest reaches up to Y 1.055, 0.04 beyond the contour."""
    tops = (1.039, 1.055, 1.018, 1.042, 1.033, 1.036, 1.027, 1.048, 1.03, 1.021, 1.045, 1.024)
    chambers = [
        (1.2 * number + x, y)
        for number, top in reversed(list(enumerate(tops)))
        for x, y in ((1, 0.1), (1, top), (0, top), (0, 0.1))
    ]
    pocket = block(((-0.2, 0), (14.2, 0), *chambers, (-0.2, 0.1), (-0.2, 0)), CutterComp.LEFT)
    parameters = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), path=PathChoice.BEST)
    found = cuts(pocket, island(-1, 1.015, 15, 3), parameters=parameters)
    assert [depth for number, _, depth in found if number == 1] == [0.04]


def test_two_sides_that_run_on_past_their_corner() -> None:
    bottom = block(((5, 0), (-1, 0)), CutterComp.LEFT)
    right = block(((4, 4), (4, -1)), CutterComp.LEFT)
    assert not cuts(bottom, right)


def test_a_pocket_that_runs_on_past_the_edge_is_named_once() -> None:
    """Both are closed and cross at X 4: each path runs through the other contour."""
    profile, pocket = island(0, 0, 4, 3), block(((5, 1.5), *SLOT, (5, 1.5)), CutterComp.LEFT)
    assert [number for number, *_ in cuts(profile, pocket)] == [2]
    assert [number for number, *_ in cuts(pocket, profile)] == [2]


def test_the_comparison_of_blocks_can_be_stopped() -> None:
    shares: list[float] = []
    derive(program(*(island(x, 0, x + 0.5, 0.5) for x in range(4))), progress=shares.append)
    assert shares == sorted(shares)
    assert len([share for share in shares if share > BLOCKS_SHARE]) >= 3
    with pytest.raises(Stopped):
        derive(program(block(POCKET, CutterComp.LEFT), island(0.4, 1, 2, 2)), progress=stop_after_blocks)


def stop_after_blocks(share: float) -> None:
    if share > BLOCKS_SHARE:
        raise Stopped


def test_a_block_that_cannot_be_posted_is_not_compared() -> None:
    pocket = block(POCKET, CutterComp.LEFT)
    derived = derive(program(pocket, island(0.4, 1, 2, 2, tool=Number(9))))
    assert not any(found.code == "OTHER_BLOCK" for each in derived.blocks for found in each.findings)


def test_a_finish_tool_and_side_passes_cut_too() -> None:
    """PROFILE RIGHT comes in from 1.0 outside the island: it cuts into the pocket, whose wall is 0.6 away."""
    wide = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0), max_offset=Number(1))
    around = island(0.6, 1, 2, 2)
    assert not cuts(block(POCKET, CutterComp.LEFT), around, parameters=wide)
    profile = block(box(0.6, 1, 2, 2), CutterComp.PROFILE_LEFT)
    assert [number for number, *_ in cuts(block(POCKET, CutterComp.LEFT), profile, parameters=wide)] == [2]
