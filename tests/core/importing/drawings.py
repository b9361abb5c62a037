"""Drawings for tests: DXF text of entities, contours in any order and direction, and reading them at once."""

from __future__ import annotations

import itertools
import json
import random
import struct
from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import atan2, cos, degrees, pi, sin, tau
from pathlib import Path
from typing import Any

from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.importing.contours import ContourList, ImportOptions, contours_of
from core.importing.drawing import DrawingUnit
from core.importing.dxf import read_dxf

DATA = Path(__file__).parents[2] / "data" / "dxf"

MADE: list[dict[str, Any]] = json.loads((DATA / "dxf-made.json").read_text())
ELLIPSES: list[dict[str, Any]] = json.loads((DATA / "dxf-ellipse.json").read_text())


def dxf(*entities: Sequence[tuple[int, object]], units: int | None = 4, more: str = "") -> bytes:
    """A drawing of R12 with these entities, each a list of group codes with values, the kind first."""
    header = [] if units is None else [(9, "$INSUNITS"), (70, units)]
    tags: list[tuple[int, object]] = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), *header]
    text = _text([*tags, (0, "ENDSEC")]) + more + _text([(0, "SECTION"), (2, "ENTITIES")])
    text += "".join(_text(entity) for entity in entities) + _text([(0, "ENDSEC"), (0, "EOF")])
    return text.encode()


def binary(version: str, *tags: tuple[int, object]) -> bytes:
    """A binary drawing of these entities, in millimeters; group codes have one byte up to R12, two from then on."""
    head: list[tuple[int, object]] = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, version), (9, "$INSUNITS")]
    every = [*head, (70, 4), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES"), *tags, (0, "ENDSEC"), (0, "EOF")]
    data = b"AutoCAD Binary DXF\r\n\x1a\x00"
    for code, value in every:
        data += struct.pack("<B" if version <= "AC1009" else "<H", code)
        if isinstance(value, str):
            data += value.encode() + b"\0"
        else:
            data += struct.pack("<d" if code < 60 else "<h" if code < 80 else "<i", value)
    return data


def _text(tags: Iterable[tuple[int, object]]) -> str:
    return "".join(f"{code}\n{value}\n" for code, value in tags)


def block(name: str, *entities: Sequence[tuple[int, object]]) -> str:
    """A BLOCKS section of one block, for `more`."""
    head = [(0, "SECTION"), (2, "BLOCKS"), (0, "BLOCK"), (8, "0"), (2, name), (70, 0), (10, 0), (20, 0), (30, 0)]
    tail = [(0, "ENDBLK"), (8, "0"), (0, "ENDSEC")]
    return _text(head) + "".join(_text(entity) for entity in entities) + _text(tail)


def line(start: Point, end: Point, layer: str = "0", z: float = 0.0) -> list[tuple[int, object]]:
    """A LINE."""
    ends = [(10, start[0]), (20, start[1]), (30, z), (11, end[0]), (21, end[1]), (31, z)]
    return [(0, "LINE"), (8, layer), *ends]


def arc(center: Point, radius: float, begin: float, end: float, layer: str = "0") -> list[tuple[int, object]]:
    """An ARC, angles in degrees."""
    return [(0, "ARC"), (8, layer), (10, center[0]), (20, center[1]), (30, 0), (40, radius), (50, begin), (51, end)]


def circle(center: Point, radius: float, layer: str = "0") -> list[tuple[int, object]]:
    """A CIRCLE."""
    return [(0, "CIRCLE"), (8, layer), (10, center[0]), (20, center[1]), (30, 0), (40, radius)]


def ellipse(center: Point, axis: Point, ratio: float, layer: str = "0") -> list[tuple[int, object]]:
    """A whole ellipse; `axis` goes from the center to an end of the long axis."""
    tags: list[tuple[int, object]] = [(0, "ELLIPSE"), (8, layer), (10, center[0]), (20, center[1]), (30, 0.0)]
    return [*tags, (11, axis[0]), (21, axis[1]), (31, 0.0), (40, ratio), (41, 0.0), (42, tau)]


def square(x: float, y: float, size: float, layer: str = "0") -> list[list[tuple[int, object]]]:
    """Four LINEs."""
    corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size), (x, y)]
    return [line(start, end, layer) for start, end in itertools.pairwise(corners)]


def polyline(*corners: Point, closed: bool = True) -> list[tuple[int, object]]:
    """A POLYLINE of lines."""
    vertices = [tag for x, y in corners for tag in ((0, "VERTEX"), (8, "0"), (10, x), (20, y), (30, 0))]
    head = [(0, "POLYLINE"), (8, "0"), (66, 1), (70, int(closed)), (10, 0), (20, 0), (30, 0)]
    return [*head, *vertices, (0, "SEQEND")]


def entity(piece: Piece, decimals: int = 12) -> list[tuple[int, object]]:
    """A piece as LINE or ARC; DXF knows arcs counterclockwise only."""
    if isinstance(piece, Line):
        return line(_rounded(piece.start, decimals), _rounded(piece.end, decimals))
    if piece.start == piece.end:
        return circle(_rounded(piece.center, decimals), round(piece.radius, decimals))
    forward = piece if piece.turn is Turn.CCW else piece.reversed()
    assert isinstance(forward, Arc)
    (cx, cy) = forward.center
    angles = [degrees(atan2(y - cy, x - cx)) for x, y in (forward.start, forward.end)]
    center = _rounded(forward.center, decimals)
    begin, end = (round(angle, decimals) for angle in angles)
    return arc(center, round(forward.radius, decimals), begin, end)


def _rounded(point: Point, decimals: int) -> Point:
    return round(point[0], decimals), round(point[1], decimals)


def listed(data: bytes, **changes: Any) -> ContourList:
    """The contours of a drawing with the usual tolerances, but for what is changed."""
    drawing = read_dxf(data, "test.dxf")
    options = ImportOptions.usual(drawing.unit or DrawingUnit.MM)
    return contours_of(drawing, replace(options, **changes))


def drawing_file(name: str) -> bytes:
    """A file of the made table."""
    if name == "d18-3000.dxf":
        return circle_of_lines(3000)
    return (DATA / name).read_bytes()


def circle_of_lines(count: int, radius: float = 50.0) -> bytes:
    """A circle drawn by many lines, as exporters of splines do."""
    points = [(radius * cos(2 * pi * k / count), radius * sin(2 * pi * k / count)) for k in range(count)]
    ends = [*points[1:], points[0]]
    return dxf(*(line(start, end) for start, end in zip(points, ends, strict=True)))


def random_contour(seed: int) -> tuple[Piece, ...]:
    """A star-shaped closed contour of lines and arcs: rays to its corners in order, some sides bulged."""
    chance = random.Random(seed)
    count = chance.randint(3, 12)
    corners = []
    for number in range(count):
        angle = 2 * pi * (number + 0.8 * chance.random()) / count
        reach = chance.uniform(20.0, 60.0)
        corners.append((reach * cos(angle), reach * sin(angle)))
    pieces: list[Piece] = []
    for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
        bulge = chance.uniform(-0.3, 0.3) if chance.random() < 0.5 else 0.0
        pieces.append(_bulged(start, end, bulge) if abs(bulge) > 0.05 else Line(start, end))
    return tuple(pieces)


def _bulged(start: Point, end: Point, bulge: float) -> Arc:
    """The arc of a bulge: tan of a quarter of its sweep angle."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    height = (1.0 - bulge * bulge) / (4.0 * bulge)
    center = ((start[0] + end[0]) / 2 - height * dy, (start[1] + end[1]) / 2 + height * dx)
    return Arc(start, end, center, Turn.CCW if bulge > 0 else Turn.CW)
