"""A drawing's contours as a scene: the chosen ones full, all others dim, with start and direction of travel."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from core.draw.scene import Layer, Mark, Scene, Style, Symbol
from core.geometry.path import Path
from core.geometry.piece import Line, Piece
from core.importing.contour import Contour
from core.importing.nesting import box_of
from core.units import Unit

MAX_PIECES: Final = 2000
"""Pieces of a list's contours, from which on only their boxes are drawn where they are not chosen."""

MAX_STARTS: Final = 30
"""Chosen contours that are shown with start and direction."""


def background(contours: Sequence[Contour]) -> Layer:
    """All contours of a list as one dim layer: it stays the same whichever of them is chosen."""
    boxed = sum(len(contour.pieces) for contour in contours) > MAX_PIECES
    pieces: list[Piece] = []
    drawn: list[bool] = []
    for contour in contours:
        own = _box(contour) if boxed else contour.pieces
        if pieces:
            # from the one before: not drawn
            pieces.append(Line(pieces[-1].end, own[0].start))
            drawn.append(False)
        pieces += own
        drawn += [True] * len(own)
    return Layer(Path.from_pieces(pieces), Style.RAPID, dashed=True, drawn=np.array(drawn, dtype=bool))


def contours_scene(dim: Layer, chosen: Iterable[Contour], unit: Unit) -> Scene:
    """The background of a list, and over it the contours that are marked, or the one under the cursor."""
    full = list(chosen)
    layers = [dim, *(Layer(Path.from_pieces(contour.pieces), Style.SURFACE) for contour in full)]
    marks = tuple(mark for contour in full[:MAX_STARTS] for mark in _start_marks(contour))
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
