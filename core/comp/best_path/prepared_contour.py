"""Prepared contour: a contour made ready for the global offset, and tests for whether it crosses itself or winds."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, tau
from typing import Final

import numpy as np

from core.comp import findings as comp_findings
from core.finding import Finding
from core.geometry.distance import distance
from core.geometry.intersect import MeetingKind, meet
from core.geometry.nearby import BoxTree, near_pairs, near_pairs_within, point_boxes
from core.geometry.path import EMPTY, Flags, Floats, Path, Points, Rows, as_complex, coordinates, next_in_ring, tangents
from core.geometry.piece_arrays import PieceArrays, even_centers, piece_arrays
from core.tolerance import CLEAR, JOINED, ON_PATH

_UNDER_HALF_TURN: Final = 3.1
"""Radians, safely under half a turn: with a sharper corner the angle does not tell whether it turns left or right."""

NOT_WHOLE_TURN: Final = 6.0
"""Radians; an arc that turns through less ends well away from its start."""

SEGMENTS_PER_RUN: Final = 16
"""Consecutive segments whose headings are compared together."""


@dataclass(frozen=True, eq=False, slots=True)
class PreparedContour:
    """`path` is the surface moved by -`origin` (2,) so that it lies around (0, 0); empty if it is refused."""

    path: Path
    origin: Floats
    findings: tuple[Finding, ...]


def prepare_contour(contour: Path, radius: float, *, closed: bool) -> PreparedContour:
    """Prepare the contour for the offset, or return why that is impossible.

    Zero-length segments are dropped.  An arc whose radii differ (by less than ARC_RADII) gets one radius.
    A closed contour's gap is bridged by a line with its last segment's number.
    """
    refused = comp_findings.contour_refusals(contour, radius, ())
    if refused:
        return PreparedContour(EMPTY, np.zeros(2), refused)
    points = as_complex(contour.points)
    kept = np.abs(points[1:] - points[:-1]) > JOINED
    if not kept.all():
        kept |= contour.lengths > JOINED
    dropped = (~kept).nonzero()[0]
    findings = tuple(comp_findings.zero_length(contour, dropped))
    contour = contour.without(dropped)
    if not len(contour):
        return PreparedContour(EMPTY, np.zeros(2), (*findings, *comp_findings.contour_refusals(contour, radius, ())))
    origin = (contour.points.min(axis=0) + contour.points.max(axis=0)) / 2.0
    path = _with_single_radii(
        Path.of(contour.points - origin, contour.centers - origin, contour.turns, contour.numbers)
    )
    return PreparedContour(_ended_at_start(path) if closed else path, origin, findings)


def _with_single_radii(path: Path) -> Path:
    """Return the path with one radius for each arc, which moves it nowhere by more than its two radii differ.

    An arc of more than half a turn whose center would move farther is first split in its middle, at the mean of its
    radii.
    """
    rows = path.turns.nonzero()[0]
    points, centers = as_complex(path.points), as_complex(path.centers).copy()
    start, end, center, turns = points[rows], points[rows + 1], centers[rows], path.turns[rows]
    centers[rows], slack = even_centers(start, end, center, turns)
    if not slack.any():
        return path
    large = (slack > 0.0) & (centers[rows] == center)
    if large.any():
        angles = np.mod(np.angle((end - center) * (start - center).conj()) * turns, tau)
        return _with_single_radii(_halved(path, rows[large], angles[large]))
    return Path(path.points, coordinates(centers), path.turns, path.numbers)


def _halved(path: Path, rows: Rows, angles: Floats) -> Path:
    """Split the arcs `rows`, which turn through `angles`, into halves that meet at the mean of each arc's radii."""
    points, center = as_complex(path.points), as_complex(path.centers)[rows]
    arm, last = points[rows] - center, points[rows + 1] - center
    size = (np.abs(arm) + np.abs(last)) / 2.0
    middle = center + arm / np.abs(arm) * size * np.exp(0.5j * angles * path.turns[rows])
    twice = np.sort(np.concatenate((np.arange(len(path)), rows)))
    points = np.insert(points, rows + 1, middle)
    return Path.of(coordinates(points), path.centers[twice], path.turns[twice], path.numbers[twice])


def _ended_at_start(path: Path) -> Path:
    """Return the path, made to end exactly at its start."""
    gap = float(np.abs(as_complex(path.points)[-1] - as_complex(path.points)[0]))
    if gap <= JOINED:
        points = path.points.copy()
        points[-1] = points[0]
        return Path(points, path.centers, path.turns, path.numbers)
    return Path.of(
        np.concatenate((path.points, path.points[:1])),
        np.concatenate((path.centers, path.points[-1:])),
        np.append(path.turns, 0).astype(np.int8),
        np.append(path.numbers, path.numbers[-1]),
    )


@dataclass(frozen=True, eq=False, slots=True)
class Walls:
    """The surface of an offset contour, with its pieces and a tree of their boxes."""

    path: Path
    pieces: PieceArrays
    tree: BoxTree

    @staticmethod
    def of(path: Path) -> Walls:
        """Make the walls of a surface."""
        pieces = piece_arrays(path)
        return Walls(path, pieces, BoxTree.of(pieces.boxes))

    def clear(self, points: Points, segments: Rows, radius: float) -> Flags:
        """Return (k,) True for points that are no nearer to any piece of the surface than the radius, within CLEAR.

        `segments` (k,) are the pieces that the points were offset from: most points that are not clear are too near to
        a vertex close to that piece.
        """
        clear = _clear_of_vertices(points, segments, as_complex(self.path.points), radius)
        rows = clear.nonzero()[0]
        if len(rows):
            candidates = points[rows]
            for i, j in near_pairs(point_boxes(candidates), self.tree, radius):
                clear[rows[i[distance(self.pieces.take(j), candidates[i]) < radius - CLEAR]]] = False
        return clear


def _clear_of_vertices(points: Points, segments: Rows, vertices: Points, radius: float) -> Flags:
    """True for points that are clear of the vertices 1, 2, 4, 8 ... segments ahead and back, until none is near."""
    clear = np.ones(len(points), np.bool_)
    step, near = 1, True
    while near and step < len(vertices):
        near = False
        for shift in (step, -step):
            rows = np.minimum(np.maximum(segments + shift, 0), len(vertices) - 1)
            distances = np.abs(points - vertices[rows])
            near |= bool((clear & (distances < 2.0 * radius) & (rows == segments + shift)).any())
            clear &= distances >= radius - CLEAR
        step *= 2
    return clear


def crosses_itself(path: Path, *, closed: bool) -> tuple[float, float] | None:
    """Return the numbers of two segments that cross, touch or run along each other away from their joint, or None.

    A full circle among other segments touches its neighbors with both ends.
    """
    circles = ((path.turns != 0) & (path.points[1:] == path.points[:-1]).all(axis=1)).nonzero()[0]
    if len(circles) and len(path) > 1:
        row = int(circles[0])
        return float(path.numbers[row]), float(path.numbers[row - 1 if row else 1])
    only_at_joint = _meet_next_only_at_joint(path)
    pieces = piece_arrays(path)
    for i, j in near_pairs_within(pieces.boxes, 2.0 * ON_PATH):
        i, j = pieces.rows[i], pieces.rows[j]
        at_joint_only = only_at_joint[i] & (j == i + 1)
        if closed and only_at_joint[-1]:
            at_joint_only |= j - i == len(path) - 1
        i, j = i[~at_joint_only], j[~at_joint_only]
        # among several crossings, report the one with the fewest segments between
        order = np.lexsort((i, j - i))
        i, j = i[order], j[order]
        met = meet(path, i, path, j)
        crossing_rows = met.pair[~_at_joint(path, i[met.pair], j[met.pair], met.points)]
        crossing_rows = np.concatenate((crossing_rows, (met.kinds == MeetingKind.OVERLAP).nonzero()[0]))
        if len(crossing_rows):
            return float(path.numbers[i[crossing_rows[0]]]), float(path.numbers[j[crossing_rows[0]]])
    return None


def _meet_next_only_at_joint(path: Path) -> Flags:
    """Return (n,) True for pieces that meet the next one (the last one: the first) only at their joint.

    That is so if the two together turn through less than half a turn.
    """
    first, last = tangents(path)
    turned = np.abs(np.angle(last.conj() * next_in_ring(first)))
    if path.turns.any():
        swept = np.abs(path.sweeps)
        tangent = _tangent_and_counter_turning(path, swept, turned)
        turned += swept + next_in_ring(swept)
        turned[tangent] = 0.0
    only_at_joint: Flags = turned <= _UNDER_HALF_TURN
    return only_at_joint


def _tangent_and_counter_turning(path: Path, swept: Floats, joint: Floats) -> Flags:
    """True for arcs that continue tangent into an arc of the other turn, so that their circles meet only at the joint.

    The chord between two circles' common points is no longer than the smaller diameter times the angle between them.
    """
    radii = np.abs(as_complex(path.points)[:-1] - as_complex(path.centers))
    tangent: Flags = 2.0 * np.minimum(radii, next_in_ring(radii)) * joint <= JOINED
    tangent &= path.turns * next_in_ring(path.turns) < 0
    tangent &= np.maximum(swept, next_in_ring(swept)) < NOT_WHOLE_TURN
    return tangent


def _at_joint(path: Path, i: Rows, j: Rows, at: Points) -> Flags:
    """True for points at the joint of neighbors i and j, or of the last and the first piece of a closed path."""
    points = as_complex(path.points)
    near = (j - i == 1) & (np.abs(at - points[j]) <= JOINED)
    around = (i == 0) & (j == len(path) - 1) & (np.abs(at - points[0]) <= JOINED) & (points[0] == points[-1])
    at_joint: Flags = near | around
    return at_joint


def winds(path: Path, radius: float) -> bool:
    """True if a place `radius` away from one segment, and as far on the other side of another, may be clear of both.

    `path` is open and does not cross itself.  Also True if that is hard to exclude.  BEST_PATH.md, "Winding", shows
    that the contour turns by more than half a turn between two such segments.
    """
    first, last = tangents(path)
    joints = np.angle(last[:-1].conj() * first[1:])
    if np.abs(joints).max(initial=0.0) > _UNDER_HALF_TURN:
        return True
    swept = path.sweeps
    heading = np.cumsum(np.stack((swept, np.append(joints, 0.0)), axis=1)).reshape(-1, 2)
    low, high = heading.min(axis=1), heading.max(axis=1)
    before = heading[:, 0] - swept
    low, high = np.minimum(low, before), np.maximum(high, before)
    return bool(high.max() - low.min() > pi + ON_PATH) and _faces_itself(path, radius, low, high)


def _faces_itself(path: Path, radius: float, low: Floats, high: Floats) -> bool:
    """True if there are segments within the cutter's width whose headings differ by more than half a turn."""
    pieces = piece_arrays(path)
    low, high = low[pieces.rows], high[pieces.rows]
    box, starts = pieces.boxes, np.arange(0, len(pieces), SEGMENTS_PER_RUN)
    low, high = np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)
    least, most = np.minimum.reduceat(box[:2], starts, axis=1), np.maximum.reduceat(box[2:], starts, axis=1)
    runs = np.concatenate((least, most))
    return any(
        bool((np.maximum(high[i] - low[j], high[j] - low[i]) > pi + ON_PATH).any())
        for i, j in near_pairs(runs, runs, 2.0 * (radius + ON_PATH))
    )
