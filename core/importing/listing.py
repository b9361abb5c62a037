"""Displays a drawing's contours: rows, with equal circles folded into one, the sentences around them, and a scene.

In the scene the chosen contours are full and the others dim, with start and direction of travel.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import isfinite
from typing import Final

import numpy as np

from core.draw.scene import Layer, Mark, Scene, Style, Symbol
from core.geometry.path import Path
from core.geometry.path_parts import parts_of
from core.geometry.piece import Line, Piece, Point
from core.importing.contour import Contour, ContourKind, fit_sentence
from core.importing.contours import ContourList
from core.importing.drawing import BSpline, Drawing, EllipseArc, Shape, counted
from core.importing.nesting import box_of
from core.importing.nodes import SAME_POINT
from core.tolerance import JOINED
from core.units import Kind, Unit, decimals_shown, from_mm, length_text, show

SAME_SIZE: Final = 1e-4
"""Step in millimeters to which radii are rounded to find equal circles."""

ELLIPSE_SAMPLES: Final = 33
"""Points on an ellipse that give its size when the unit is asked."""


Row = tuple[Contour, ...]
"""A row of the list: one contour, or circles of equal size, kind and layer inside the same contour."""


def rows_of(contours: Sequence[Contour]) -> tuple[Row, ...]:
    """Return the rows of the list, in its order."""
    rows: dict[object, list[Contour]] = {}
    for contour in contours:
        radius = contour.circle
        key: object = contour.number
        if radius is not None and not contour.problems:
            key = (round(radius / SAME_SIZE), contour.kind, contour.layers, contour.inside)
        rows.setdefault(key, []).append(contour)
    return tuple(map(tuple, rows.values()))


def matching(contours: Sequence[Contour], text: str, unit: Unit) -> tuple[Contour, ...]:
    """Return the contours whose row contains a text: the filter of `/`."""
    sought = text.strip().lower()
    return tuple(contour for contour in contours if sought in " ".join(cells_of((contour,), unit)).lower())


def cells_of(row: Row, unit: Unit) -> tuple[str, ...]:
    """Return a row's cells: number, kind, layer, pieces, length, size, and how many circles it folds."""
    contour = row[0]
    indent = "  " * contour.depth
    more = f"x {len(row)}" if len(row) > 1 else ""
    length = length_text(contour.length, unit)
    return (
        str(contour.number),
        f"{indent}{contour.kind}",
        contour.layer,
        str(contour.drawn),
        length,
        size_of(contour, unit),
        more,
    )


HEADINGS: Final = ("chain", "kind", "layer", "pieces", "length", "size", "")


def size_of(contour: Contour, unit: Unit) -> str:
    """Return width and height, or the diameter of a circle, as text."""
    if contour.circle is not None:
        return f"diameter {length_text(2.0 * contour.circle, unit)}"
    width, height = (length_text(size, unit) for size in contour.size)
    return f"{width} x {height}"


def table(rows: Sequence[Row], unit: Unit) -> Iterator[str]:
    """Yield the rows as lines of text, each with its problems below it."""
    cells = [HEADINGS, *(cells_of(row, unit) for row in rows)]
    widths = [max(len(line[column]) for line in cells) for column in range(len(HEADINGS))]
    right = (0, 3, 4)
    for number, line in enumerate(cells):
        texts = (
            text.rjust(width) if column in right else text.ljust(width)
            for column, (text, width) in enumerate(zip(line, widths, strict=True))
        )
        yield "  ".join(texts).rstrip()
        if number:
            contour = rows[number - 1][0]
            problems = [
                f"{contour.kind} {text}" if contour.kind is ContourKind.OPEN else text for text in contour.problems
            ]
            yield from (f"      {text}." for text in (*problems, fit_sentence(contour, unit)) if text)


def sentences(listed: ContourList, unit: Unit) -> Iterator[str]:
    """Yield a sentence for each result of reading, clean-up and chaining; every change of the drawing has one."""
    drawing, options, cleaned = listed.drawing, listed.options, listed.cleaned
    yield from listed.notes
    if drawing.skipped:
        yield f"skipped: {counted(drawing.skipped)}."
    if drawing.hidden:
        layers = ", ".join(f"{count} on {layer}" for layer, count in drawing.hidden.items())
        yield f"frozen, off or invisible, not taken: {layers}."
    tolerance = length_text(options.tolerance, unit)
    if cleaned.tiny:
        yield f"{_were(cleaned.tiny, 'piece', f'shorter than TOLERANCE {tolerance}')} dropped."
    if cleaned.duplicates:
        difference, at = cleaned.largest_difference
        extent = (
            f", off by up to {_gap_text(difference, unit)} at {_place(at, unit)}" if difference > SAME_POINT else ""
        )
        yield f"{_were(cleaned.duplicates, 'equal piece')} dropped{extent}."
    if cleaned.overlaps:
        yield f"{_were(cleaned.overlaps, 'overlapping piece')} joined."
    if cleaned.shared:
        yield f"{_were(cleaned.shared, 'piece', 'drawn twice')} kept for two contours."
    yield f"largest gap {_gap_text(listed.gap, unit)}."
    for branch in listed.branches:
        yield f"branch at {_place(branch.at, unit)}: {branch.end_count - 1} ways."


def _were(count: int, noun: str, which: str = "") -> str:
    return " ".join(
        filter(None, (str(count), noun if count == 1 else f"{noun}s", which, "was" if count == 1 else "were"))
    )


def _place(point: Point, unit: Unit) -> str:
    x, y = (length_text(value, unit) for value in point)
    return f"X {x} Y {y}"


def _gap_text(gap: float, unit: Unit) -> str:
    """Return a gap with enough decimals to differ from 0; `none` if rounding explains it."""
    if gap <= JOINED:
        return "none"
    usual = decimals_shown(Kind.LENGTH, unit)
    texts = (f"{from_mm(gap, unit):.{decimals}f}" for decimals in itertools.count(usual))
    return next(text for text in texts if text.strip("0."))


def unit_question(drawing: Drawing) -> str:
    """Return a drawing's size in both units, such as `140 x 30: as IN 140.0000 x 30.0000, as MM 140.000 x 30.000`."""
    width, height = extent(drawing)
    inch, mm = (
        " x ".join(show(size, Kind.LENGTH, unit) for size in (width, height)) for unit in (Unit.IN, Unit.MM)
    )  # fmt: skip
    names = f"has a unit that is not read ({drawing.other_unit})" if drawing.other_unit else "names no unit"
    return f"The drawing {names}. {width:.6g} x {height:.6g}: as IN {inch}, as MM {mm}"


def extent(drawing: Drawing) -> tuple[float, float]:
    """Return the width and height of a drawing in its own unit."""
    boxes = [_box(drawn.shape) for drawn in drawing.shapes]
    if not boxes:
        return 0.0, 0.0
    left, bottom, right, top = np.array(boxes).T
    return float(right.max() - left.min()), float(top.max() - bottom.min())


def _box(shape: Shape) -> tuple[float, float, float, float]:
    match shape:
        case Line(start, end):
            points = [complex(*start), complex(*end)]
        case EllipseArc():
            points = shape.at(np.linspace(shape.begin, shape.end, ELLIPSE_SAMPLES))[0].tolist()
        case BSpline(points=rows):
            points = rows.tolist()
    finite = [point for point in points if isfinite(point.real) and isfinite(point.imag)]
    across, up = [point.real for point in finite], [point.imag for point in finite]
    return min(across), min(up), max(across), max(up)


MAX_PIECES: Final = 2000
"""Above this many pieces in a list, contours that are not chosen are drawn as their boxes."""

MAX_STARTS: Final = 30
"""Most chosen contours that are drawn with start and direction."""


def background(contours: Sequence[Contour]) -> Layer:
    """Return all contours of a list as one dim layer, the same for every choice."""
    boxed = sum(len(contour.pieces) for contour in contours) > MAX_PIECES
    outlines = parts_of(_outline(contour) if boxed else contour.pieces for contour in contours)
    return Layer(outlines.path, Style.RAPID, dashed=True, drawn=outlines.in_part)


def contours_scene(dim: Layer, chosen: Iterable[Contour], unit: Unit) -> Scene:
    """Return the background of a list, with the marked contours, or the one under the cursor, over it."""
    full = list(chosen)
    layers = [dim, *(Layer(Path.from_pieces(contour.pieces), Style.SURFACE) for contour in full)]
    marks = tuple(mark for contour in full[:MAX_STARTS] for mark in _start_marks(contour))
    return Scene(tuple(layers), marks=marks, unit=unit)


def _outline(contour: Contour) -> tuple[Piece, ...]:
    left, bottom, right, top = box_of(contour.pieces)
    corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
    return tuple(Line(start, end) for start, end in pairwise(corners))


def _start_marks(contour: Contour) -> tuple[Mark, ...]:
    """Return the marks of a contour's start and of its direction of travel there."""
    first = contour.pieces[0]
    ahead = first.point_at(0.3)
    return (
        Mark(first.start, Style.START, Symbol.START),
        Mark(ahead, Style.START, Symbol.ARROW, first.direction_at(ahead)),
    )
