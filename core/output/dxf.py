"""Writes a scene as a DXF drawing: LINE, ARC and CIRCLE of R12, which every CAD system reads, on a layer for each role.

Lengths are in the program's unit.  $INSUNITS names it; R12 does not define that variable, but readers know it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import atan2, degrees
from typing import Final, NamedTuple

import numpy as np

from core.draw.scene import Scene, Style
from core.geometry.piece import Line, Piece, Point
from core.units import Unit, from_mm

MIN_DECIMALS: Final = 6
MAX_DECIMALS: Final = 10
"""Decimals of lengths: six, and as many more as a calculated end needs to come back within 0.000001 mm."""

ANGLE_DECIMALS: Final = 12
"""Decimals of degrees: at the largest radius of a form they stand for less than 0.000001 mm."""


class _Pen(NamedTuple):
    """A layer's name and its color by AutoCAD's index."""

    layer: str
    color: int


_PENS: Final[Mapping[Style, _Pen]] = {
    Style.SURFACE: _Pen("CONTOUR", 7),
    Style.PATH: _Pen("PATH", 4),
    Style.LEAD: _Pen("LEADS", 2),
    Style.UNCUT: _Pen("UNCUT", 1),
    Style.DELETED: _Pen("DELETED", 8),
    Style.RAPID: _Pen("ROUGH", 9),
}

_UNIT_CODES: Final[Mapping[Unit, tuple[int, int]]] = {Unit.IN: (1, 0), Unit.MM: (4, 1)}
"""$INSUNITS and $MEASUREMENT."""


def dxf(scene: Scene, unit: Unit) -> str:
    """Return the drawing as the text of a DXF file, without segments not determined yet and anything not finite."""
    lines = (*_header(unit), *_tables(), *_section("ENTITIES"), *_entities(scene, unit), "0", "ENDSEC", "0", "EOF")
    return "\n".join(lines) + "\n"


def _section(name: str) -> tuple[str, ...]:
    return "0", "SECTION", "2", name


def _header(unit: Unit) -> Iterator[str]:
    units, measurement = _UNIT_CODES[unit]
    yield from (*_section("HEADER"), "9", "$ACADVER", "1", "AC1009")
    yield from ("9", "$INSUNITS", "70", str(units), "9", "$MEASUREMENT", "70", str(measurement), "0", "ENDSEC")


def _tables() -> Iterator[str]:
    """Yield the line type and the layers."""
    yield from (*_section("TABLES"), "0", "TABLE", "2", "LTYPE", "70", "1")
    yield from ("0", "LTYPE", "2", "CONTINUOUS", "70", "0", "3", "Solid line", "72", "65", "73", "0", "40", "0.0")
    yield from ("0", "ENDTAB", "0", "TABLE", "2", "LAYER", "70", str(len(_PENS)))
    for pen in _PENS.values():
        yield from ("0", "LAYER", "2", pen.layer, "70", "0", "62", str(pen.color), "6", "CONTINUOUS")
    yield from ("0", "ENDTAB", "0", "ENDSEC")


def _entities(scene: Scene, unit: Unit) -> Iterator[str]:
    for layer in scene.layers:
        # segments that are not determined yet are dashed surface
        is_sketch = layer.dashed and layer.style is Style.SURFACE
        if layer.style in _PENS and not is_sketch:
            # the contour's layer has all of it, even parts that a screen draws in another role
            for path in [layer.path] if layer.style is Style.SURFACE else layer.parts:
                for piece in path:
                    yield from _entity(piece, _PENS[layer.style].layer, unit)


def _entity(piece: Piece, layer: str, unit: Unit) -> Iterator[str]:
    """Yield a piece as LINE, ARC or CIRCLE; arcs of DXF run counterclockwise."""
    center = () if isinstance(piece, Line) else piece.center
    if not np.isfinite((*piece.start, *piece.end, *center)).all():
        return
    if isinstance(piece, Line):
        yield from ("0", "LINE", "8", layer, *_point(10, piece.start, unit), *_point(11, piece.end, unit))
        return
    whole = piece.start == piece.end
    yield from ("0", "CIRCLE" if whole else "ARC", "8", layer, *_point(10, piece.center, unit))
    yield from ("40", _number(from_mm(piece.radius, unit)))
    if not whole:
        ends = (piece.start, piece.end) if piece.turn > 0 else (piece.end, piece.start)
        for code, end in zip(("50", "51"), ends, strict=True):
            yield from (code, _angle(piece.center, end))


def _point(code: int, point: Point, unit: Unit) -> tuple[str, ...]:
    x, y = (_number(from_mm(value, unit)) for value in point)
    return str(code), x, str(code + 10), y, str(code + 20), "0.0"


def _number(value: float) -> str:
    text = f"{value:.{MAX_DECIMALS}f}"
    short = text.rstrip("0")
    shortest = len(text) - MAX_DECIMALS + MIN_DECIMALS
    text = text[: max(len(short), shortest)]
    return text.removeprefix("-") if not text.strip("-0.") else text


def _angle(center: Point, end: Point) -> str:
    angle = degrees(atan2(end[1] - center[1], end[0] - center[0])) % 360.0
    return f"{angle:.{ANGLE_DECIMALS}f}"
