"""CHAMFERs in their places, and out of place."""

from __future__ import annotations

from math import dist, hypot, sqrt

import pytest

from core.geometry.piece import Arc, Line
from core.pipeline.derive import derive
from core.program.edit import FormPlace, Refused, insert_segment
from core.program.file.read import loads
from core.program.file.write import dumps
from core.program.model import ChamferSegment, LineSegment, Segment
from core.program.solve.block import solve_block
from core.program.solve.solved import SolvedBlock
from core.units import Unit, sentence
from tests.core.program.parts import arc, blend, chamfer, line, program

RIGHT, UP, LEFT = line(x_end=10.0, y_end=0.0), line(x_end=10.0, y_end=10.0), line(x_end=0.0, y_end=10.0)


def solved(*segments: Segment) -> SolvedBlock:
    given = program(*segments)
    return solve_block(given.blocks[0], given)


def texts(block: SolvedBlock) -> list[str]:
    return [f"{one.code} {one.segment} {one.field}: {sentence(one, Unit.MM)}" for one in block.all_findings]


def test_the_corner_of_two_lines_is_cut_off_by_the_same_length_on_both():
    block = solved(RIGHT, chamfer(2.0), UP)
    assert texts(block) == []
    assert [segment.piece for segment in block.segments] == [
        Line((0.0, 0.0), (8.0, 0.0)),
        Line((8.0, 0.0), (10.0, 2.0)),
        Line((10.0, 2.0), (10.0, 10.0)),
    ]
    assert (block.segments[1].end, block.fully_determined, block.determined) == ((10.0, 0.0), True, 3)


def test_the_corner_of_an_arc_is_cut_off_where_its_tangent_has_that_length():
    dome = solved(RIGHT, UP, chamfer(3.0), arc("CCW", x_end=10.0, y_end=0.0, x_center=10.0, y_center=5.0))
    piece, cut = dome.segments[3].piece, dome.segments[2].piece
    assert isinstance(piece, Arc)
    assert isinstance(cut, Line)
    assert cut.start == (10.0, 7.0)
    assert cut.end == pytest.approx((7.0, 9.0))
    assert dist(piece.start, (10.0, 5.0)) == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("segments", "words"),
    [
        ((chamfer(1.0), RIGHT), "CHAMFER_PLACE 1 length: A CHAMFER cannot be the first segment: put a LINE"),
        ((RIGHT, chamfer(1.0)), "CHAMFER_PLACE 2 length: A CHAMFER cannot be the last segment: add the LINE"),
        (
            (RIGHT, blend(1.0), chamfer(1.0), UP),
            "CHAMFER_PLACE 3 length: A CHAMFER cannot follow a BLEND ARC: delete one or put a segment between.",
        ),
        (
            (RIGHT, chamfer(10.5), UP),
            "CHAMFER_LENGTH 2 length: LENGTH 10.500 does not fit between segments 1 and 3: the largest that",
        ),
        ((RIGHT, ChamferSegment(), UP), "MISSING 2 length: More data needed: type LENGTH."),
        (
            (RIGHT, chamfer(1.0), line(x_end=20.0, y_end=0.0)),
            "CHAMFER_TANGENT 2 length: There is no corner to chamfer: segments 1 and 3 already run",
        ),
        (
            (RIGHT, chamfer(1.0), line(x_end=5.0, y_end=0.0)),
            "CHAMFER_LENGTH 2 length: No chamfer fits: segment 3 goes straight back along segment 1.",
        ),
    ],
)
def test_a_chamfer_that_cannot_be_says_why(segments, words):
    assert any(text.startswith(words) for text in texts(solved(*segments)))


def test_a_chamfer_takes_all_of_a_neighbor_and_nothing_is_left_to_cut():
    block = solved(RIGHT, chamfer(10.0), UP, chamfer(1.0), LEFT)
    words = "Segment 3 has no length left to chamfer: correct it or delete this CHAMFER."
    assert f"CHAMFER_LENGTH 4 length: {words}" in texts(block)


def test_two_chamfers_on_one_line_leave_its_middle():
    block = solved(RIGHT, chamfer(2.0), UP, chamfer(3.0), LEFT)
    assert block.segments[2].piece == Line((10.0, 2.0), (10.0, 7.0))
    assert sum(piece.length for _, piece in block.pieces) == pytest.approx(8.0 + 5.0 + 7.0 + hypot(2, 2) + 3 * sqrt(2))


def test_a_chamfer_is_inserted_between_two_segments_only():
    before = program(RIGHT, UP)
    assert not isinstance(insert_segment(before, FormPlace(1, 2), chamfer(1.0)), Refused)
    first = insert_segment(before, FormPlace(1, 1), chamfer(1.0))
    assert first == Refused("A CHAMFER cannot be the first segment: it stands between two others.")
    beside = insert_segment(program(RIGHT, blend(1.0), UP), FormPlace(1, 2), chamfer(1.0))
    assert beside == Refused("A CHAMFER cannot be next to a BLEND ARC.")


def test_a_chamfer_is_kept_in_a_file_of_format_2_and_others_stay_in_format_1():
    text = dumps(program(RIGHT, chamfer(2.0), UP))
    assert text.startswith("format = 2 ")
    assert loads(text, "part.toml") == program(RIGHT, chamfer(2.0), UP)
    assert dumps(program(RIGHT, UP)).startswith("format = 1 ")


def test_the_path_round_a_chamfered_corner_is_clean():
    given = program(
        line(x_end=20.0, y_end=0.0), chamfer(3.0), line(y_end=20.0), chamfer(3.0), line(x_end=0.0), line(y_end=0.0),
        start={"cutter_comp": "RIGHT"},
    )  # fmt: skip
    block = derive(given).block(1)
    assert block.paths is not None
    assert block.paths.verdict is not None
    assert not block.paths.verdict.gouges
    assert isinstance(given.blocks[0].segments[0], LineSegment)
