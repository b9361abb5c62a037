"""The drawing in its room: all of the part, and the scale bar beside it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from app.painted.screens.page import Sketch
from app.painted.widgets.drawing import BY_STYLE, _row, picture_rows
from app.painted.widgets.rows import Look
from core.draw.characters import Mode
from core.draw.raster import draw
from core.draw.scene import Layer, Scene, Style
from core.draw.view import View
from core.geometry.path import Path
from core.units import Unit


def upright(width: float, height: float) -> Scene:
    """A rectangle from zero, such as decides by its height how large it is drawn."""
    points = np.array([(0, 0), (width, 0), (width, height), (0, height), (0, 0)], float)
    path = Path.of(points, points[:-1], np.zeros(4, np.int8))
    return Scene((Layer(path, Style.SURFACE),), unit=Unit.IN)


@pytest.mark.parametrize("mode", [mode.value for mode in Mode])
@pytest.mark.parametrize(("columns", "rows"), [(59, 10), (59, 18), (80, 21), (120, 50)])
@pytest.mark.parametrize("size", [(3.0, 50.0), (40.0, 40.0), (500.0, 5.0)])
def test_fit_leaves_the_scale_bar_a_row_of_its_own(
    mode: str, columns: int, rows: int, size: tuple[float, float]
) -> None:
    drawn = picture_rows(upright(*size), Sketch(), columns, rows, mode)
    in_row = [{span.look for span in row} for row in drawn]
    assert Look.SCALE in in_row[-1]
    assert Look.SURFACE not in in_row[-1]
    # the bottom edge stands whole above it, the top edge is in sight
    edges = [row for row, looks in enumerate(in_row) if Look.SURFACE in looks]
    assert edges[-1] <= rows - 2
    longest = max(len(span.text) for span in drawn[edges[-1]] if span.look is Look.SURFACE)
    assert longest == max(len(span.text) for row in drawn for span in row if span.look is Look.SURFACE)


def test_a_low_drawing_has_no_scale_bar_and_all_its_rows() -> None:
    drawn = picture_rows(upright(3.0, 50.0), Sketch(), 59, 7, "ascii")
    assert not any(span.look is Look.SCALE for row in drawn for span in row)
    assert any(span.look is Look.SURFACE for span in drawn[-1])


@pytest.mark.parametrize("mode", [mode.value for mode in Mode])
def test_every_cell_has_its_character_and_the_look_of_its_style_taken_over_or_not(mode: str) -> None:
    scene = upright(3.0, 50.0)
    picture = draw(scene, View.fit(scene.bounds, 40, 11).pan(0.0, -0.5 / 12, 40, 12), 40, 12, Mode(mode))
    for _ in range(2):
        drawn = picture_rows(scene, Sketch(), 40, 12, mode)
        assert ["".join(span.text for span in row) for row in drawn] == list(picture.rows)
        looks = [[span.look for span in row for _ in span.text] for row in drawn]
        assert looks == [[BY_STYLE[style] for style in row] for row in picture.styles.tolist()]
        assert all(one.look is not other.look for row in drawn for one, other in pairwise(row))
    _row.cache_clear()
    assert picture_rows(scene, Sketch(), 40, 12, mode) == drawn
