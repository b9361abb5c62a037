"""Crossing contours: compensated contours of a program that cut into one another.

Each contour is judged with its own path first.  A path may cut the wall of another contour too: an island too near to
a pocket, a contour at a wrong place.  Nothing in a program says which walls are meant to stay: such a cut is a doubt,
no gouge.  A contour whose whole wall is cut away only roughed the part, and nothing is told of it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.moves import Moves, Plane
from core.controls.rapids_at_depth import CutContour
from core.controls.repeated_passes import Shape, shape
from core.geometry.nearby import near_pairs
from core.geometry.path import Floats, Path
from core.tolerance import ON_PATH
from core.verify.judge import judge, judge_together
from core.verify.surface import Leads
from core.verify.verdict import Gouge

WHOLE: Final = 0.99
"""Share of its radius within which a cutter comes to all of a wall that it cuts away."""


@dataclass(frozen=True, eq=False, slots=True)
class _Pass:
    """Moves of one radius in a compensated stretch, and the shapes of the contours that the stretch cuts."""

    moves: Moves
    radius: float
    own: frozenset[Shape]


def cuts_of_other_contours(run: ControlRun, contours: Sequence[CutContour]) -> tuple[Gouge, ...]:
    """What compensated moves in XY cut of contours of other stretches that are cut no deeper than they run.

    The deepest cut of each contour, in the order of the lines of the moves.  A gouge's `path_number` is that line,
    `surface_number` the contour's.
    """
    walls, passes = _walls(contours), _passes(run, contours)
    if len(run.stretches) < 2 or not walls or not passes:
        return ()
    shapes, highest = list(walls), list(walls.values())
    bounds = _bounds([contour.path for contour in highest])
    reach = max(one.radius for one in passes)
    found = list[Gouge]()
    for rows, near in near_pairs(bounds, _bounds([one.moves.path() for one in passes]), reach):
        pairs = defaultdict[int, list[_Pass]](list)
        for row, index in zip(rows.tolist(), near.tolist(), strict=True):
            if shapes[row] not in passes[index].own:
                pairs[row].append(passes[index])
        for row, others in pairs.items():
            if gouges := _cuts(highest[row], others):
                found.append(max(gouges, key=lambda gouge: gouge.depth))
    return tuple(sorted(found, key=lambda gouge: gouge.path_number))


def _walls(contours: Sequence[CutContour]) -> dict[Shape, CutContour]:
    """The contours in XY by their shapes, each where it is cut highest."""
    walls = dict[Shape, CutContour]()
    for contour in contours:
        if contour.stretch.plane is Plane.XY and len(contour.path):
            known = walls.setdefault(shape(contour.path), contour)
            if contour.top > known.top:
                walls[shape(contour.path)] = contour
    return walls


def _passes(run: ControlRun, contours: Sequence[CutContour]) -> list[_Pass]:
    """The compensated moves of a run in XY, by stretch and radius."""
    passes = list[_Pass]()
    for stretch in run.stretches:
        if stretch.plane is not Plane.XY:
            continue
        own = frozenset(shape(one.path) for one in contours if _belongs(one.stretch, stretch))
        passes += [_Pass(run.moves.part(part.first, part.last), part.radius, own) for part in stretch.parts()]
    return [one for one in passes if len(one.moves.path())]


def _belongs(part: Stretch, stretch: Stretch) -> bool:
    return stretch.first <= part.first < stretch.last


def _bounds(paths: Sequence[Path]) -> Floats:
    """(4, n) the box of each path."""
    boxes = [path.boxes for path in paths]
    return np.array([(*box[:2].min(axis=1), *box[2:].max(axis=1)) for box in boxes]).T.reshape(4, -1)


def _cuts(contour: CutContour, passes: Sequence[_Pass]) -> list[Gouge]:
    """What the passes cut of a contour; nothing where they cut all of it away."""
    gouges, centers = list[Gouge](), dict[Shape, tuple[Path, float]]()
    for one in passes:
        for center in _low(one.moves, contour.top):
            centers.setdefault((*shape(center), str(one.radius).encode()), (center, one.radius))
    for center, radius in centers.values():
        if any(True for _ in near_pairs(center.boxes, contour.path.boxes, radius)):
            verdict = judge(contour.path, contour.stretch.side, radius, center, contour.accepted, leads=Leads.MOVES)
            gouges += verdict.gouges
    if not gouges:
        return []
    least = WHOLE * min(radius for _, radius in centers.values())
    paths = [center for center, _ in centers.values()]
    verdict = judge_together(contour.path, contour.stretch.side, least, paths, contour.accepted, leads=Leads.MOVES)
    return gouges if verdict.uncut else []


def _low(moves: Moves, top: float) -> Iterator[Path]:
    """The parts of these moves that are no higher than this."""
    low = moves.points[:, 2] <= top + ON_PATH
    low[1:] &= low[:-1]
    low[:1] = False
    rows = np.flatnonzero(low)
    for part in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else ():
        path = moves.part(int(part[0]) - 1, int(part[-1]) + 1).path()
        if len(path):
            yield path
