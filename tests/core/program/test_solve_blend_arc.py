"""BLEND ARCs at right and wrong places."""

from __future__ import annotations

from random import Random

import pytest

from core.geometry.piece import Arc, Line
from core.program.model import BlendSegment, LineSegment, Segment, Unread
from core.program.solve.block import solve_block
from core.program.solve.solved import Solved, SolvedBlock
from core.units import Unit, sentence
from tests.core.program.parts import arc, blend, chamfer, line, postable, program


def solved(*segments: Segment) -> SolvedBlock:
    given = program(*segments)
    return solve_block(given.blocks[0], given)


def texts(block: SolvedBlock) -> list[str]:
    return [
        f"{finding.code} {finding.segment} {finding.field}: {sentence(finding, Unit.MM)}"
        for finding in block.all_findings
    ]


RIGHT, UP, LEFT = line(x_end=10.0, y_end=0.0), line(x_end=10.0, y_end=10.0), line(x_end=0.0, y_end=10.0)


def test_a_line_between_two_blends_is_shortened_at_both_ends():
    block = solved(RIGHT, blend(2.0), UP, blend(3.0), LEFT)
    assert texts(block) == []
    assert block.segments[2].piece == Line((10.0, 2.0), (10.0, 7.0))
    assert [number for number, _ in block.pieces] == [1, 2, 3, 4, 5]


def test_the_second_blend_must_fit_into_the_rest_of_the_line():
    block = solved(RIGHT, blend(6.0), UP, blend(5.0), LEFT)
    assert texts(block) == [
        "BLEND_RADIUS 4 radius: RADIUS 5.000 does not fit between segments 3 and 5: the largest that fits is 4.000."
    ]
    assert block.determined == 3
    assert block.segments[2].piece == Line((10.0, 6.0), (10.0, 10.0))
    assert block.segments[4].piece == Line((10.0, 10.0), (0.0, 10.0))


def test_a_line_used_up_by_a_blend_leaves_no_room_for_another():
    block = solved(RIGHT, blend(10.0), UP, blend(1.0), LEFT)
    words = "Segment 3 has no length left to blend: correct it or delete this BLEND ARC."
    assert texts(block) == [f"BLEND_RADIUS 4 radius: {words}"]
    assert block.segments[2].piece is None
    assert block.segments[2].end == (10.0, 10.0)


def test_blends_of_arcs_keep_their_centers():
    half = arc("CW", x_end=20.0, y_end=0.0, x_center=15.0, y_center=0.0)
    block = solved(RIGHT, blend(1.0), half)
    assert texts(block) == []
    piece = block.segments[2].piece
    assert isinstance(piece, Arc)
    assert piece.center == (15.0, 0.0)
    assert piece.end == (20.0, 0.0)
    assert block.segments[2].values["radius"] == Solved(5.0)


@pytest.mark.parametrize(
    ("segments", "at", "words"),
    [
        ((blend(1.0), RIGHT), 1, "cannot be the first segment: put a LINE or an ARC before it."),
        ((RIGHT, blend(1.0)), 2, "cannot be the last segment: add the LINE or ARC after it."),
        (
            (RIGHT, blend(1.0), blend(1.0), UP),
            3,
            "cannot follow another BLEND ARC: delete one or put a segment between.",
        ),
    ],
)
def test_a_blend_at_a_wrong_place_is_refused(segments, at, words):
    block = solved(*segments)
    assert f"BLEND_PLACE {at} radius: A BLEND ARC {words}" in texts(block)
    assert not postable(block)
    assert block.determined < len(segments)


def test_a_blend_without_a_corner_is_refused():
    block = solved(RIGHT, blend(1.0), line(x_end=20.0, y_end=0.0))
    words = "There is no corner to blend: segments 1 and 3 already run smoothly into each other."
    assert texts(block) == [f"BLEND_TANGENT 2 radius: {words}"]
    back = solved(RIGHT, blend(1.0), line(x_end=0.0, y_end=0.0))
    words = "No arc fits: segment 3 goes straight back along segment 1."
    assert texts(back) == [f"BLEND_RADIUS 2 radius: {words}"]


def test_a_blend_too_large_for_an_arc_is_refused():
    quarter = arc("CW", x_end=15.0, y_end=5.0, x_center=15.0, y_center=0.0)
    block = solved(RIGHT, blend(30.0), quarter)
    words = "RADIUS 30.000 does not fit between segments 1 and 3: the largest that fits is 20.000."
    assert texts(block) == [f"BLEND_RADIUS 2 radius: {words}"]


def test_a_blend_waits_for_its_neighbors():
    block = solved(RIGHT, blend(1.0), LineSegment(), UP)
    assert [finding.segment for finding in block.all_findings] == [3]
    assert block.determined == 1
    assert block.segments[0].piece == Line((0.0, 0.0), (10.0, 0.0))
    after = solved(RIGHT, LineSegment(), blend(1.0), UP)
    assert [finding.segment for finding in after.all_findings] == [2]


def test_a_blend_beside_a_segment_without_length_is_refused():
    block = solved(RIGHT, blend(1.0), line(x_end=10.0, y_end=0.0), UP)
    words = "Segment 3 has no length left to blend: correct it or delete this BLEND ARC."
    assert f"BLEND_RADIUS 2 radius: {words}" in texts(block)
    assert block.determined == 1


def test_a_blend_without_a_radius_is_incomplete():
    block = solved(RIGHT, BlendSegment(), UP)
    assert texts(block) == ["MISSING 2 radius: More data needed: type RADIUS."]
    assert block.segments[1].missing == ("radius",)
    assert block.segments[2].piece == Line((10.0, 0.0), (10.0, 10.0))
    unread = solved(RIGHT, BlendSegment(radius=Unread("x", "Type a number.")), UP)
    assert texts(unread) == ["UNREADABLE 2 radius: RADIUS: x cannot be read. Type a number."]
    assert unread.determined == 1


def bent(random: Random, x: float, y: float) -> Segment:
    """A line to a point, or an arc that begins there on the way from (10, 0)."""
    if random.random() < 0.5:
        return line(x_end=x, y_end=y)
    middle, up = complex(10 + x, y) / 2, 1j * complex(x - 10, y) * random.uniform(-1, 1)
    center = middle + up
    return arc(
        random.choice(("CW", "CCW")), x_end=x, y_end=y, x_center=round(center.real, 9), y_center=round(center.imag, 9)
    )


def test_the_largest_size_that_fits_a_corner_fits_when_it_is_typed_and_one_digit_more_does_not():
    random, named = Random(7), 0
    while named < 60:
        after = bent(random, round(random.uniform(-5, 25), 3), round(random.uniform(-15, 15), 3))
        for corner in (blend, chamfer):
            told = [finding for finding in solved(RIGHT, corner(40.0), after).all_findings if "largest" in finding.text]
            if not told:
                continue
            named += 1
            value = float(sentence(told[0], Unit.MM).removesuffix(".").split()[-1])
            assert not texts(solved(RIGHT, corner(value), after)), (value, after)
            assert texts(solved(RIGHT, corner(value + 0.001), after)), (value, after)
