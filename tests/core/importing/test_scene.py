"""The scene of a list of contours, and how long a list of many takes."""

from __future__ import annotations

from time import process_time

from core.draw.scene import Style, Symbol
from core.importing.listing import background, contours_scene, rows_of, table
from core.units import Unit
from tests.core.importing.drawings import circle_of_lines, dxf, listed, square

LIMIT = 2.0
"""Seconds of processor time, which other programs hardly change; a fifth of it is usual."""


def test_the_chosen_contour_is_full_and_has_a_start_and_a_direction() -> None:
    contours = listed(dxf(*square(0, 0, 20), *square(5, 5, 5))).contours
    scene = contours_scene(background(contours), contours[1:], Unit.MM)
    styles = [(layer.style, layer.dashed) for layer in scene.layers]
    assert styles == [(Style.RAPID, True), (Style.SURFACE, False)]
    assert [mark.symbol for mark in scene.marks] == [Symbol.START, Symbol.ARROW]
    assert scene.marks[0].at == contours[1].start
    assert scene.bounds == (0.0, 0.0, 20.0, 20.0)


def test_many_pieces_are_drawn_as_boxes() -> None:
    contours = listed(circle_of_lines(3000)).contours
    assert len(background(contours).path) == 4


def test_three_thousand_entities_are_listed_in_two_seconds() -> None:
    data = circle_of_lines(3000)
    listed(data)
    begin = process_time()
    head, row = table(rows_of(listed(data).contours), Unit.MM)
    assert process_time() - begin < LIMIT
    assert dict(zip(head.split(), row.split(), strict=False))["pieces"] == "3000"
