"""A contour that starts and ends past its corner: the parts beyond the crossing are lead-in and lead-out."""

from __future__ import annotations

import pytest

from core.draw.scene import Style
from core.finding import Severity
from core.geometry.piece import Point
from core.pipeline.command_output import table_document
from core.pipeline.derive import advice_for_block, derive, look_ahead_table
from core.pipeline.derived import DerivedBlock
from core.pipeline.jobs import jobs
from core.pipeline.plot import block_scene
from core.pipeline.post import post_center_path
from core.program.model import CutterComp, Number
from core.units import Unit, sentence
from tests.core.pipeline.parts import MID_SIDE_SQUARE, OVER_RUN_SQUARE, Points, block, program

IN = 25.4
OVER_RUN_L = ((-1, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4), (0, -1), (-1, -1))


def derived(points: Points, lookahead: int | None = None, comp: CutterComp = CutterComp.RIGHT) -> DerivedBlock:
    typed = block(points, comp, lookahead=None if lookahead is None else Number(float(lookahead)))
    return derive(program(typed)).blocks[0]


def codes(found: DerivedBlock) -> list[str]:
    return [finding.code for finding in found.findings]


@pytest.mark.parametrize("lookahead", [None, 1, 2])
def test_a_look_ahead_of_one_or_two_keeps_all_of_the_over_run_square(lookahead):
    found = derived(OVER_RUN_SQUARE, lookahead)
    assert found.lookahead.calculated == 2
    assert found.paths.compensated.path.numbers.tolist() == [1, 1.5, 2, 2.5, 3, 3.5, 4]
    assert found.paths.verdict.clean
    assert found.paths.verdict.uncut_length == 0.0
    assert found.paths.verdict.surface_length == pytest.approx(8 * IN)
    assert found.postable


@pytest.mark.parametrize("lookahead", range(3, 21))
def test_a_larger_look_ahead_deletes_the_part_between_the_ends(lookahead):
    found = derived(OVER_RUN_SQUARE, lookahead)
    assert found.paths.compensated.path.numbers.tolist() == [1, 4]
    assert [deletion.at for deletion in found.paths.compensated.deleted] == [
        pytest.approx((-0.25 * IN, -0.25 * IN))
    ] * 2
    assert found.paths.verdict.uncut_length == pytest.approx(8 * IN)


@pytest.mark.parametrize("lookahead", [None, 1, 4])
def test_an_over_run_is_reported_once_as_information(lookahead):
    found = derived(OVER_RUN_SQUARE, lookahead)
    (told,) = [finding for finding in found.findings if finding.code == "OVER_RUN"]
    assert told.severity is Severity.INFO
    assert told.at == pytest.approx((0.0, 0.0))
    assert sentence(told, Unit.IN).startswith("Over-run at X 0.0000 Y 0.0000")
    assert "CROSSES_ITSELF" not in codes(found)


def test_the_table_recommends_what_keeps_the_part():
    part = program(block(OVER_RUN_SQUARE, CutterComp.RIGHT))
    (found,) = derive(part).blocks
    table = look_ahead_table(found, part)
    assert all(row.clean for row in table.rows)
    assert table.recommended == 1
    assert [row.deleted for row in table.rows[:3]] == [(), (), (2.0, 3.0)]
    assert advice_for_block(found, part, table) == ()
    assert [row["uncut"] for row in table_document(found, table, Unit.IN)["values"][:3]] == pytest.approx([0, 0, 8])


@pytest.mark.parametrize(
    ("lookahead", "kept"),
    [
        (None, [1, 1.5, 2, 2.5, 3, 4, 4.5, 5, 5.5, 6, 7]),
        (3, [1, 1.5, 2, 2.5, 3, 4, 4.5, 5, 5.5, 6, 7]),
        (4, [1, 1.5, 2, 2.5, 3, 4, 4.5, 5, 5.5, 6, 7]),
        (5, [1, 6, 7]),
        (20, [1, 6, 7]),
    ],
)
def test_an_l_whose_last_segment_does_not_cross_the_first_crosses_itself(lookahead, kept):
    found = derived(OVER_RUN_L, lookahead)
    assert found.lookahead.calculated == 4
    assert found.paths.compensated.path.numbers.tolist() == kept
    assert "OVER_RUN" not in codes(found)
    (told,) = [finding for finding in found.findings if finding.code == "CROSSES_ITSELF"]
    assert told.severity is Severity.WARNING


def leads(found: DerivedBlock) -> list[tuple[Point, Point]]:
    """The straight parts that are drawn as leads, in inches."""
    layers = [layer for layer in block_scene(found, None, Unit.IN).layers if layer.style is Style.LEAD]
    pieces = [piece for layer in layers for path in layer.parts for piece in path]
    return [((piece.start[0] / IN, piece.start[1] / IN), (piece.end[0] / IN, piece.end[1] / IN)) for piece in pieces]


def test_the_ends_beyond_the_crossing_are_drawn_as_leads():
    (first, last) = leads(derived(OVER_RUN_SQUARE))
    assert [*first[0], *first[1]] == pytest.approx([-1, 0, 0, 0])
    assert [*last[0], *last[1]] == pytest.approx([0, 0, 0, -1])
    assert leads(derived(OVER_RUN_L)) == []
    assert leads(derived(MID_SIDE_SQUARE)) == []


def test_an_end_that_stops_at_the_crossing_is_no_lead():
    corners = ((1.5, 0), (1.5, -1.5), (0, -1.5))
    for points, lead in (
        (((0, 0), *corners, (0, 0.1)), [0, 0, 0, 0.1]),
        (((-1, 0), (0, 0), *corners, (0, 0)), [-1, 0, 0, 0]),
    ):
        found = derived(points, comp=CutterComp.LEFT)
        assert "OVER_RUN" in codes(found)
        assert "GOUGE" not in codes(found)
        ((start, end),) = leads(found)
        assert [*start, *end] == pytest.approx(lead)


def test_the_head_of_the_nc_file_says_what_the_ends_are():
    part = derive(program(block(OVER_RUN_SQUARE, CutterComp.RIGHT, plunge_feed=Number(5.0), speed=Number(900.0))))
    note = "OVER-RUN AT X 0.0000 Y 0.0000: THE ENDS ARE LEAD-IN AND LEAD-OUT"
    assert jobs(part)[0].notes == (note,)
    assert f"({note})" in post_center_path(part, name="square").text
    assert not any("OVER-RUN" in line for line in jobs(derive(program(block(OVER_RUN_L, CutterComp.RIGHT))))[0].notes)
