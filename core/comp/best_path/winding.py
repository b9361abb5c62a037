"""Winding: can the cutter's one side come against the contour's other side?

Take a place X of the center that is clear of an open contour, touches one segment from its left and a later one from
its right.  X, its two feet and the contour between them make a loop that does not cross itself, so that its direction
turns by a full turn in all.  At the two feet it turns by a quarter to the left and by one to the right, at X by less
than a half: between its feet the contour turns by more than a half.  Where it does not, the other side cuts nothing.
"""

from __future__ import annotations

from math import pi, tau
from typing import Final

import numpy as np

from core.comp.best_path.surface import tangents
from core.comp.best_path.tree import near, piece_boxes, tree
from core.geometry.path import Floats, Path, as_complex
from core.geometry.piece import SLIVER
from core.tolerance import ON_PATH

GROUP: Final = 16
"""Segments taken together."""

_REVERSAL: Final = 3.1
"""Radians; whether a corner as sharp as this turns left or right is not told by its angle."""


def winds(path: Path, radius: float) -> bool:
    """May some place `radius` beside one segment and as far on the other side of another be clear of both?

    `path` is open and does not cross itself.  True where it may not be but that is not easily seen.
    """
    first, last = tangents(path)
    joints = np.angle(last[:-1].conj() * first[1:])
    if np.abs(joints).max(initial=0.0) > _REVERSAL:
        return True
    swept = np.zeros(len(path))
    arcs = path.turns.nonzero()[0]
    if len(arcs):
        turn = path.turns[arcs]
        angle = np.mod(np.angle(first[arcs].conj() * last[arcs]) * turn, tau)
        swept[arcs] = turn * np.where(angle > tau - SLIVER, 0.0, angle)
    heading = np.cumsum(np.stack((swept, np.append(joints, 0.0)), axis=1)).reshape(-1, 2)
    low, high = heading.min(axis=1), heading.max(axis=1)
    before = heading[:, 0] - swept
    low, high = np.minimum(low, before), np.maximum(high, before)
    return bool(high.max() - low.min() > pi + ON_PATH) and _faces_itself(path, radius, low, high)


def _faces_itself(path: Path, radius: float, low: Floats, high: Floats) -> bool:
    """Are there segments no farther apart than the cutter is wide whose headings differ by more than half a turn?"""
    points = as_complex(path.points)
    boxes = piece_boxes(points[:-1], points[1:], as_complex(path.centers), path.turns, ON_PATH)
    starts = np.arange(0, len(path), GROUP)
    low, high = np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)
    least, most = np.minimum.reduceat(boxes[:2], starts, axis=1), np.maximum.reduceat(boxes[2:], starts, axis=1)
    groups = tree(np.concatenate((least, most)))
    return any(
        bool((np.maximum(high[i] - low[j], high[j] - low[i]) > pi + ON_PATH).any())
        for i, j in near(groups, groups, 2.0 * radius)
    )
