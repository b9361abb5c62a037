"""M120 LA computes the center path some blocks ahead, and leaves out what the tool cannot reach.

The control's manual says that M120 checks the blocks ahead for undercuts and for crossings of the path with itself, and
does not machine what lies between.  This is the look-ahead rule of a MILL CONTOUR block, so that rule is used here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from core.comp.compensate import compensate
from core.controls.compensation.elements import SAME_DIRECTION, Element, offset_end, sweep
from core.geometry.path import Path, point_of_row
from core.geometry.piece import Point, Side
from core.tolerance import JOINED


@dataclass(frozen=True, eq=False, slots=True)
class PathAhead:
    """The center path along some elements, where and in which direction it starts, and the elements left out.

    A piece's number is its element's row, and a half more at the corner after it.
    """

    path: Path
    start: Point
    direction: Point
    left_out: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Unreached:
    """The element at which the control would still stop, and why; `{0}` is the tool's radius.

    `before` is the known part of the path up to there.
    """

    row: int
    text: str
    before: PathAhead | None = None


def path_ahead(elements: Sequence[Element], offset: float, depth: int, begin: Point | None) -> PathAhead | Unreached:
    """Return the center path along joined elements, looked at `depth` blocks ahead, the tool `offset` to their left.

    `begin` is the point that the path has reached on the first element's offset; None starts square to its start.
    """
    side = Side.LEFT if offset > 0.0 else Side.RIGHT
    compensated = compensate(_contour(elements), side, abs(offset), depth, closed=False)
    path = compensated.path
    if not len(path):
        return Unreached(0, "the {0}-radius tool cannot reach any of this contour")
    start, direction = path[0].start, point_of_row(path.start_directions[0])
    if bool(compensated.bridged.any()):
        row = int(path.numbers[compensated.bridged][0])
        before = PathAhead(path.part(0, int((path.numbers < row).sum())), begin or start, direction)
        why = "the {0}-radius tool cannot get past this block within the blocks of LA"
        return Unreached(row, why, before)
    last, end = len(elements) - 1, path[-1].end
    if path.numbers[0] != 0.0:
        return Unreached(0, "the {0}-radius tool cannot reach any of this block, the first one of M120")
    if not _near(end, offset_end(elements[-1], offset)) or int(path.numbers[-1]) != last:
        return Unreached(last, "the {0}-radius tool cannot reach the end of this block, the last one of M120")
    if begin is not None and not _near(begin, start):
        if _trimmed_away(elements[0], start, begin, path[0].end):
            return Unreached(0, "the {0}-radius tool has no length left for this block between its neighbors")
        start = begin
    left_out = tuple(int(number) for number in compensated.deleted.segments.tolist() if number == int(number))
    return PathAhead(path, start, direction, left_out)


def _contour(elements: Sequence[Element]) -> Path:
    """Return the path of the elements, numbered from 0."""
    points = np.array([elements[0].start, *(element.end for element in elements)])
    turns = np.array([element.turn for element in elements], np.int8)
    return Path.of(
        points, np.array([element.center for element in elements]), turns, np.arange(len(elements), dtype=np.float64)
    )


def _near(first: Point, second: Point) -> bool:
    return abs(first[0] - second[0]) <= JOINED and abs(first[1] - second[1]) <= JOINED


def _trimmed_away(element: Element, start: Point, begin: Point, end: Point) -> bool:
    """True if an element's offset, trimmed to `begin`, would run backwards to its trimmed end."""
    if not element.turn:
        (wx, wy), dx, dy = element.start_direction, end[0] - begin[0], end[1] - begin[1]
        return dx * wx + dy * wy < -JOINED
    center, turn = element.center, element.turn
    trimmed = sweep(start, begin, center, turn)
    return trimmed > pi or trimmed > sweep(start, end, center, turn) + SAME_DIRECTION
