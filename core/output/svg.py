"""Writes a scene as an SVG drawing: exact arcs, line weights by role, a legend.  Millimeters, Y up."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite, pi
from typing import Final
from xml.sax.saxutils import escape

import numpy as np

from core.draw.characters import round_length
from core.draw.scene import Box, Circle, Layer, Mark, Scene, Style, Symbol
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point
from core.units import from_mm, to_mm

SVG_DECIMALS: Final = 6
DRAWING_WIDTH: Final = 960
"""Width of the drawing on a screen in pixels; the height follows from it."""
TEXT_HEIGHT_SHARE: Final = 0.024
"""Height of letters as a fraction of the drawing's larger side."""
MARGIN_SHARE: Final = 0.06


@dataclass(frozen=True, slots=True)
class Pen:
    """The look of a role: `weight` in pixels, `dashes` in SVG's notation, and its text in the `legend`."""

    color: str
    weight: float
    legend: str
    dashes: str = ""


PEN_OF_STYLE: Final[Mapping[Style, Pen]] = {
    Style.AXIS: Pen("#9aa5ad", 0.7, "axes", "8 3 2 3"),
    Style.SURFACE: Pen("#1b1f23", 2.2, "part surface"),
    Style.PATH: Pen("#0b62c4", 1.3, "center path"),
    Style.LEAD: Pen("#00856a", 1.3, "blend moves"),
    Style.RAPID: Pen("#7a8894", 0.8, "roughing passes or control's path", "2 3"),
    Style.DELETED: Pen("#b45f06", 2.2, "deleted segments", "6 4"),
    Style.GOUGE: Pen("#c4001a", 2.6, "gouge"),
    Style.UNCUT: Pen("#8a2be2", 3.4, "uncut surface"),
    Style.CUTTER: Pen("#7a8894", 1.0, "cutter"),
    Style.START: Pen("#1b1f23", 1.6, "start, direction"),
    Style.CURRENT: Pen("#d18b00", 3.0, "current segment"),
    Style.SCALE: Pen("#1b1f23", 1.2, "scale"),
    Style.MESSAGE: Pen("#1b1f23", 1.0, "message"),
    Style.NUMBER: Pen("#1b1f23", 1.0, "segment number"),
    Style.GOUGE_AREA: Pen("#c4001a", 0.0, "gouged"),
    Style.UNCUT_AREA: Pen("#8a2be2", 0.0, "left uncut"),
    Style.UNTAKEN: Pen("#7a8894", 1.3, "other solutions", "1 4"),
    Style.BACKGROUND: Pen("#ffffff", 1.0, "background"),
}


def svg(scene: Scene, *, title: str) -> str:
    """Return the drawing as the text of an SVG file, without anything that is not finite."""
    x0, y0, x1, y1 = scene.bounds or (-1.0, -1.0, 1.0, 1.0)
    size = max(x1 - x0, y1 - y0) or 1.0
    roles = _roles(scene)
    margin, line = size * MARGIN_SHARE, size * TEXT_HEIGHT_SHARE * 1.6
    box = (x0 - margin, y0 - margin - line * (len(roles) + 1), x1 + margin, y1 + margin + line)
    lines = (
        *_head(box, title),
        *_axes(scene, (x0 - margin / 2, y0 - margin / 2, x1 + margin / 2, y1 + margin / 2)),
        *(_path(part, layer) for layer in scene.layers for part in layer.parts),
        *(_circle(circle) for circle in scene.circles if _finite(*circle.center, circle.radius)),
        *(_mark(mark, size * TEXT_HEIGHT_SHARE) for mark in scene.marks if _finite(*mark.at)),
        _text((x0, y1 + margin), title, size * TEXT_HEIGHT_SHARE * 1.2),
        *_legend(roles, (x0, y0 - margin - line), size * TEXT_HEIGHT_SHARE, line),
        *_scale(scene, (x1, y0 - margin - line), size),
        "</svg>",
    )
    return "\n".join(lines) + "\n"


def outline(piece: Piece) -> str:
    """Return the SVG path commands that continue from a piece's start: L, or A once or twice.

    An arc of more than a half turn is written as two halves, so that no viewer has to tell a full circle from none.
    """
    if isinstance(piece, Line):
        return f"L{_at(piece.end)}"
    if abs(piece.sweep) <= pi:
        return _arc(piece, piece.end)
    middle = piece.point_at(0.5)
    return f"{_arc(piece, middle)} {_arc(piece, piece.end)}"


def _arc(arc: Arc, end: Point) -> str:
    """Return half a turn or less of an arc; SVG's positive angles run clockwise on a drawing whose Y is up."""
    radius = _number(arc.radius)
    return f"A{radius} {radius} 0 0 {0 if arc.turn > 0 else 1} {_at(end)}"


def _at(point: Point) -> str:
    return f"{_number(point[0])} {_number(-point[1])}"


def _number(value: float) -> str:
    text = f"{value:.{SVG_DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _finite(*values: float) -> bool:
    return all(map(isfinite, values))


def _roles(scene: Scene) -> tuple[Style, ...]:
    used = {layer.style for layer in scene.layers if len(layer.path)}
    used |= {circle.style for circle in scene.circles} | {mark.style for mark in scene.marks}
    return tuple(sorted(used))


def _head(box: Box, title: str) -> Iterator[str]:
    x0, y0, x1, y1 = box
    wide, high = x1 - x0, y1 - y0
    view = " ".join(map(_number, (x0, -y1, wide, high)))
    height = _number(DRAWING_WIDTH * high / wide)
    yield f'<svg xmlns="http://www.w3.org/2000/svg" width="{DRAWING_WIDTH}" height="{height}" viewBox="{view}">'
    yield f"<title>{_plain(title)}</title>"
    yield "<style>"
    yield "path, circle { fill: none; vector-effect: non-scaling-stroke; stroke-linejoin: round }"
    yield "text { font-family: monospace; fill: #1b1f23 }"
    for style, pen in PEN_OF_STYLE.items():
        dashes = f"; stroke-dasharray: {pen.dashes}" if pen.dashes else ""
        yield f".{style.name.lower()} {{ stroke: {pen.color}; stroke-width: {pen.weight}px{dashes} }}"
    yield ".dashed { stroke-dasharray: 6 4 }"
    yield "</style>"
    yield f'<rect x="{_number(x0)}" y="{_number(-y1)}" width="100%" height="100%" fill="#ffffff"/>'


def _axes(scene: Scene, box: Box) -> Iterator[str]:
    """Yield the axes within the drawing."""
    x0, y0, x1, y1 = box
    if scene.axes and y0 <= 0.0 <= y1:
        yield _path_element(Style.AXIS, f"M{_at((x0, 0.0))} L{_at((x1, 0.0))}")
    if scene.axes and x0 <= 0.0 <= x1:
        yield _path_element(Style.AXIS, f"M{_at((0.0, y0))} L{_at((0.0, y1))}")


def _path(path: Path, layer: Layer) -> str:
    """Return one path of a layer; pieces that are not finite leave a gap."""
    values = np.hstack((path.starts, path.ends, path.centers))
    finite: list[bool] = np.logical_and.reduce(np.isfinite(values), axis=1).tolist()
    commands, joined = [], False
    for row in range(len(path)):
        if finite[row]:
            piece = path[row]
            commands.append(outline(piece) if joined else f"M{_at(piece.start)} {outline(piece)}")
        joined = finite[row]
    return _path_element(layer.style, " ".join(commands), dashed=layer.dashed)


def _path_element(style: Style, data: str, *, dashed: bool = False) -> str:
    return f'<path class="{style.name.lower()}{" dashed" if dashed else ""}" d="{data}"/>'


def _circle(circle: Circle) -> str:
    (x, y), look = circle.center, circle.style.name.lower()
    return f'<circle class="{look}" cx="{_number(x)}" cy="{_number(-y)}" r="{_number(circle.radius)}"/>'


def _mark(mark: Mark, size: float) -> str:
    """Return an arrowhead along the travel, a cross where something is wrong, or a ring at a start or plunge point."""
    ahead = complex(*mark.direction)
    ahead = ahead / abs(ahead) * size * 0.8 if abs(ahead) > 0.0 and _finite(*mark.direction) else complex(size)
    here, half = complex(*mark.at), size * 0.35
    if mark.symbol is Symbol.ARROW:
        wings = (here + ahead * 0.5 + ahead * turn for turn in (-0.8 + 0.45j, -0.8 - 0.45j))
        left, right = (_at((wing.real, wing.imag)) for wing in wings)
        tip = here + ahead * 0.5
        return _path_element(mark.style, f"M{left} L{_at((tip.real, tip.imag))} L{right}")
    if mark.symbol in (Symbol.GOUGE, Symbol.DELETED, Symbol.CENTER):
        x, y = mark.at
        first = f"M{_at((x - half, y - half))} L{_at((x + half, y + half))}"
        return _path_element(mark.style, f"{first} M{_at((x - half, y + half))} L{_at((x + half, y - half))}")
    return _circle(Circle(mark.at, half, mark.style))


def _legend(roles: tuple[Style, ...], corner: Point, size: float, line: float) -> Iterator[str]:
    x, y = corner
    for row, style in enumerate(roles):
        level = y - row * line
        yield _path_element(style, f"M{_at((x, level + size / 3))} L{_at((x + 4 * size, level + size / 3))}")
        yield _text((x + 5 * size, level), PEN_OF_STYLE[style].legend, size)


def _scale(scene: Scene, corner: Point, size: float) -> Iterator[str]:
    """Yield a bar of a round length in program units, at the right."""
    if scene.unit is None:
        return
    (x, y), letters = corner, size * TEXT_HEIGHT_SHARE
    length, decimals = round_length(from_mm(size * 0.25, scene.unit))
    left = x - to_mm(length, scene.unit)
    ends = " ".join(f"M{_at((end, y))} L{_at((end, y + letters))}" for end in (left, x))
    yield _path_element(Style.SCALE, f"{ends} M{_at((left, y + letters / 2))} L{_at((x, y + letters / 2))}")
    yield _text((left, y - 1.2 * letters), f"{length:.{decimals}f} {scene.unit}", letters)


def _text(at: Point, text: str, size: float) -> str:
    return f'<text x="{_number(at[0])}" y="{_number(-at[1])}" font-size="{_number(size)}">{_plain(text)}</text>'


def _plain(text: str) -> str:
    """Return text that XML allows: escaped, with a space for each character that does not print."""
    return escape("".join(character if character.isprintable() else " " for character in text))
