"""A drawing's contours as a scene: the chosen ones full, the others dim, with start and direction of travel."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise
from typing import Final

from core.draw.scene import Layer, Mark, Scene, Style, Symbol
from core.geometry.path import Path
from core.geometry.piece import Line, Piece
from core.importing.contour import Contour
from core.importing.nesting import box_of
from core.units import Unit

MAX_PIECES: Final = 2000
"""Pieces of the contours that are not chosen, from which on only their boxes are drawn."""


def contours_scene(contours: Sequence[Contour], chosen: Collection[int], unit: Unit) -> Scene:
    """The contours of a list; `chosen` are the numbers of those that are marked, or the one under the cursor."""
    others = [contour for contour in contours if contour.number not in chosen]
    boxed = sum(len(contour.pieces) for contour in others) > MAX_PIECES
    layers = [
        Layer(Path.from_pieces(_box(contour) if boxed else contour.pieces), Style.RAPID, dashed=True)
        for contour in others
    ]
    full = [contour for contour in contours if contour.number in chosen]
    layers += [Layer(Path.from_pieces(contour.pieces), Style.SURFACE) for contour in full]
    marks = tuple(mark for contour in full for mark in _start_marks(contour))
    return Scene(tuple(layers), marks=marks, unit=unit)


def _box(contour: Contour) -> tuple[Piece, ...]:
    left, bottom, right, top = box_of(contour.pieces)
    corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
    return tuple(Line(start, end) for start, end in pairwise(corners))


def _start_marks(contour: Contour) -> tuple[Mark, ...]:
    """Where a contour starts, and which way it is traveled from there."""
    first = contour.pieces[0]
    ahead = first.point_at(0.3)
    return (
        Mark(first.start, Style.START, Symbol.START),
        Mark(ahead, Style.START, Symbol.ARROW, first.direction_at(ahead)),
    )
