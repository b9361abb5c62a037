"""The drawing as rows: a block's scene rasterised for the room there is.

Imported only when the numeric library is loaded, after the first screen stands.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from re import DOTALL, compile
from typing import Final

from app.painted.screens.page import Sketch
from app.painted.widgets.rows import Look, Row, Span
from core.draw.characters import Mode
from core.draw.raster import Picture, draw
from core.draw.scene import Box, Scene, Style, Symbol
from core.draw.view import View
from core.geometry.piece import Point

ROOM_FOR_SCALE: Final = 10
"""In fewer rows the scale bar would cover the part."""
AGAIN: Final = frozenset({Style.UNCUT, Style.GOUGE})
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
    Style.NUMBER: Look.LABEL,
    Style.GOUGE_AREA: Look.GOUGE,
    Style.UNCUT_AREA: Look.UNCUT,
}
"""The look of each role of the drawing."""
BY_STYLE: Final = tuple(LOOKS[style] for style in Style)
"""The same by the number of the role."""
ALIKE: Final = compile(rb"(.)\1*", DOTALL)
"""Cells of one style side by side."""


def picture_rows(scene: Scene, sketch: Sketch, columns: int, rows: int, mode: str) -> tuple[Row, ...]:
    """The scene in columns x rows cells, in the window the sketch gives."""
    if rows < ROOM_FOR_SCALE:
        scene = replace(scene, unit=None)
    view = view_of(scene, sketch, columns, rows)
    return () if view is None else _rows(draw(scene, view, columns, rows, Mode(mode)))


def view_of(scene: Scene, sketch: Sketch, columns: int, rows: int) -> View | None:
    """The window the sketch gives; None where there is nothing to be seen."""
    # parts of the surface that are drawn once more cannot widen what spans the drawing
    bounds = scene.extent(without=AGAIN)
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
        return circle.center
    for layer in scene.layers:
        if layer.style is Style.CURRENT and (box := Scene((layer,)).bounds) is not None:
            return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    return next((mark.at for mark in scene.marks if mark.symbol is Symbol.START), None)


def _fitted(bounds: Box, columns: int, rows: int, *, scaled: bool) -> View:
    """All of the part, with the last row free where the scale bar stands in it."""
    if not scaled:
        return View.fit(bounds, columns, rows)
    return View.fit(bounds, columns, rows - 1).pan(0.0, -0.5 / rows, columns, rows)


def _rows(picture: Picture) -> tuple[Row, ...]:
    styles, columns = picture.styles.tobytes(), picture.styles.shape[1]
    return tuple(_row(text, styles[row * columns : row * columns + columns]) for row, text in enumerate(picture.rows))


@lru_cache(96)
def _row(text: str, styles: bytes) -> Row:
    """A row, its cells of one style in one span; most rows of a picture were in the one before."""
    return tuple(Span(text[run.start() : run.end()], BY_STYLE[run[0][0]]) for run in ALIKE.finditer(styles))
