"""Draws a list's contours as a scene: the chosen ones full, the others dim, with start and direction of travel."""

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
"""Above this many pieces in a list, contours that are not chosen are drawn as their boxes."""

MAX_STARTS: Final = 30
"""Most chosen contours that are drawn with start and direction."""


def background(contours: Sequence[Contour]) -> Layer:
    """Return all contours of a list as one dim layer, the same for every choice."""
    boxed = sum(len(contour.pieces) for contour in contours) > MAX_PIECES
    pieces: list[Piece] = []
    drawn: list[bool] = []
    for contour in contours:
        outline = _box(contour) if boxed else contour.pieces
        if pieces:
            # the line from the contour before is not drawn
            pieces.append(Line(pieces[-1].end, outline[0].start))
            drawn.append(False)
        pieces += outline
        drawn += [True] * len(outline)
    return Layer(Path.from_pieces(pieces), Style.RAPID, dashed=True, drawn=np.array(drawn, dtype=bool))


def contours_scene(dim: Layer, chosen: Iterable[Contour], unit: Unit) -> Scene:
    """Return the background of a list, with the marked contours, or the one under the cursor, over it."""
    full = list(chosen)
    layers = [dim, *(Layer(Path.from_pieces(contour.pieces), Style.SURFACE) for contour in full)]
    marks = tuple(mark for contour in full[:MAX_STARTS] for mark in _start_marks(contour))
    return Scene(tuple(layers), marks=marks, unit=unit)


def _box(contour: Contour) -> tuple[Piece, ...]:
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
