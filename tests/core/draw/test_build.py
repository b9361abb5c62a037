import numpy as np
import pytest

from core.draw.scene import Circle, Mark, Style, Symbol, contour_scene
from core.geometry.path import EMPTY, Path
from core.geometry.path_parts import PathParts
from core.geometry.piece import Arc, Line, Turn
from core.units import Unit

SQUARE = Path.from_pieces([Line((0, 0), (4, 0)), Line((4, 0), (4, 4)), Line((4, 4), (0, 4)), Line((0, 4), (0, 0))])
SHIFTED = Path.from_pieces([Line((0, -1), (4, -1))])
LEAD = Path.from_pieces([Arc((-1, -2), (0, -1), (0, -2), Turn.CW)])


def test_the_current_segment_lies_over_everything_and_the_surface_below():
    one, parts = (SHIFTED,), PathParts(SHIFTED, np.array([True]))
    scene = contour_scene(
        SQUARE, path=SHIFTED, leads=(LEAD,), deleted=parts, uncut=parts, rough=one, current=SHIFTED, sketches=parts
    )
    assert [(layer.style, layer.dashed) for layer in scene.layers] == [
        (Style.SURFACE, True),
        (Style.SURFACE, False),
        (Style.RAPID, True),
        (Style.LEAD, False),
        (Style.PATH, False),
        (Style.UNCUT, False),
        (Style.DELETED, True),
        (Style.CURRENT, False),
    ]


def test_marks_tell_travel_plunge_start_and_trouble():
    scene = contour_scene(SQUARE, path=SHIFTED, leads=(LEAD,), start=(0, 0), gouges=[(1, 1)], meetings=[(2, 2)])
    assert scene.marks == (
        Mark((2, -1), Style.START, Symbol.ARROW, (4, 0)),
        Mark((-1, -2), Style.LEAD, Symbol.PLUNGE),
        Mark((0, 0), Style.START, Symbol.START),
        Mark((2, 2), Style.DELETED, Symbol.DELETED),
        Mark((1, 1), Style.GOUGE, Symbol.GOUGE),
    )


def test_without_a_path_the_arrow_stands_on_the_surface_and_nothing_plunges():
    scene = contour_scene(SQUARE, unit=Unit.IN)
    assert [mark.symbol for mark in scene.marks] == [Symbol.ARROW]
    assert scene.unit is Unit.IN


def test_the_arrow_on_an_arc_points_along_it_in_its_middle():
    half = Path.from_pieces([Arc((1, 0), (-1, 0), (0, 0), Turn.CW)])
    (mark,) = contour_scene(half).marks
    assert mark.at == pytest.approx((0, -1))
    assert mark.direction == pytest.approx((-1, 0))


def test_a_full_circle_has_its_arrow_opposite_the_start():
    ring = Path.from_pieces([Arc((1, 0), (1, 0), (0, 0), Turn.CCW)])
    (mark,) = contour_scene(ring).marks
    assert mark.at == pytest.approx((-1, 0))
    assert mark.direction == pytest.approx((0, -1))


def test_the_cutter_is_a_circle():
    assert contour_scene(SQUARE, cutter=((1, 2), 0.5)).circles == (Circle((1, 2), 0.5),)


def test_an_empty_contour_has_an_empty_scene():
    scene = contour_scene(EMPTY)
    assert (scene.layers, scene.circles, scene.marks) == ((), (), ())
