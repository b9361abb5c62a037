"""The drawing as rows: a block's scene rasterised for the room there is.

Imported only when the numeric library is loaded, after the first screen stands.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np

from app.screens.page import Sketch
from app.widgets.rows import Look, Row, Span
from core.draw.mode import Mode
from core.draw.raster import Picture, draw
from core.draw.scene import Box, Gathered, Scene, Style, Symbol
from core.draw.view import View
from core.geometry.piece import Point

ROOM_FOR_SCALE: Final = 10
"""In fewer rows the scale bar would cover the part."""
AGAIN: Final = frozenset({Style.UNCUT, Style.DELETED, Style.GOUGE})
"""Roles of layers that are parts of the surface."""
LOOKS: Final = {
    Style.BACKGROUND: Look.PLAIN,
    Style.AXIS: Look.AXIS,
    Style.SURFACE: Look.SURFACE,
    Style.PATH: Look.PATH,
    Style.LEAD: Look.LEAD,
    Style.RAPID: Look.RAPID,
    Style.DELETED: Look.DELETED,
    Style.GOUGE: Look.GOUGE,
    Style.UNCUT: Look.UNCUT,
    Style.CUTTER: Look.CUTTER,
    Style.START: Look.START,
    Style.CURRENT: Look.CURRENT,
    Style.SCALE: Look.SCALE,
    Style.MESSAGE: Look.DIM,
}
"""The look of each role of the drawing."""
BY_STYLE: Final = tuple(LOOKS[style] for style in Style)
"""The same by the number of the role."""


def picture_rows(scene: Scene, sketch: Sketch, columns: int, rows: int, mode: str) -> tuple[Row, ...]:
    """The scene in columns x rows cells, in the window the sketch gives."""
    if rows < ROOM_FOR_SCALE:
        scene = replace(scene, unit=None)
    gathered = scene.gathered
    view = _view_of(gathered, sketch, columns, rows)
    return () if view is None else tuple(_rows(draw(scene, view, columns, rows, Mode(mode), gathered)))


def view_of(scene: Scene, sketch: Sketch, columns: int, rows: int) -> View | None:
    """The window the sketch gives; None where there is nothing to be seen."""
    return _view_of(scene.gathered, sketch, columns, rows)


def _view_of(gathered: Gathered, sketch: Sketch, columns: int, rows: int) -> View | None:
    scene = gathered.scene
    # parts of the surface that are drawn once more cannot widen what spans the drawing
    bounds = gathered.bounds(without=AGAIN)
    if bounds is None:
        return None
    return (
        _fitted(bounds, columns, rows, scaled=scene.unit is not None)
        .zoom(sketch.zoom / sketch.middle, _marked(scene))
        .zoom(sketch.middle)
        .pan(sketch.dx, sketch.dy, columns, rows)
    )


def _marked(scene: Scene) -> Point | None:
    """What enlarging keeps in the window: the cutter, else the segment under the cursor, else START."""
    for circle in scene.circles:
        return circle.centre
    for layer in scene.layers:
        if layer.style is Style.CURRENT and (box := Scene((layer,)).bounds) is not None:
            return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    return next((mark.at for mark in scene.marks if mark.symbol is Symbol.START), None)


def _fitted(bounds: Box, columns: int, rows: int, *, scaled: bool) -> View:
    """All of the part, with the last row free where the scale bar stands in it."""
    if not scaled:
        return View.fit(bounds, columns, rows)
    return View.fit(bounds, columns, rows - 1).pan(0.0, -0.5 / rows, columns, rows)


def _rows(picture: Picture) -> list[Row]:
    """The rows, their cells of one style in one span."""
    styles, text = picture.styles, "".join(picture.rows)
    begins = np.ones(styles.shape, np.bool_)
    begins[:, 1:] = styles[:, 1:] != styles[:, :-1]
    # of all cells one behind the other: that is asked once for the picture, and not row by row
    heads = begins.reshape(-1).nonzero()[0]
    starts, looks = heads.tolist(), styles.reshape(-1)[heads].tolist()
    both = zip(starts, [*starts[1:], len(text)], looks, strict=True)
    spans = [Span(text[head:tail], BY_STYLE[style]) for head, tail, style in both]
    edges = (heads % styles.shape[1] == 0).nonzero()[0].tolist()
    return [tuple(spans[first:behind]) for first, behind in pairwise([*edges, len(spans)])]
