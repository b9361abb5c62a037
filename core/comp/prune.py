"""Prune: the conversational control's walk along the raw chain, which trims, bridges and deletes under the look-ahead.

The walk takes the pieces b in order.  Each is first joined to its predecessor; then it is tested against the remaining
parts of earlier pieces a within the look-ahead, and the earliest that crosses it wins: a ends there, b starts there,
and everything between is deleted (LOOK_AHEAD.md).  The rest of a piece is a range of distances along it, and all
crossings are known beforehand, so the walk only compares numbers and visits only pieces that have crossings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from core.comp.compensated import NO_DELETIONS, Deletions
from core.comp.crossings import Crossings
from core.comp.offset import RawChain, RawPart
from core.geometry.path import EMPTY, Flags, Path, Points, Rows, as_complex, coordinates
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True, eq=False, slots=True)
class Pruned:
    """The result of the walk: the path, a flag for each of its `bridged` pieces (len(path),), and the deleted segments.

    `bridges` are the chain's rows of the bridges that remain.
    """

    path: Path
    bridged: Flags
    bridges: Rows
    deleted: Deletions


def prune(chain: RawChain, joints: Crossings, others: Crossings, *, last_wins: bool) -> Pruned:
    """Walk the chain, given the crossings at its joints and those of other pieces that the look-ahead tests.

    A joint takes its first point along the earlier piece that the piece still has, with `last_wins` only the last one
    (closed contours of two segments); if it has none, its bridge stays.  Of a piece's other crossings the first one on
    the remaining parts of both pieces counts: the earlier piece ends there, the later one starts there, and everything
    between is deleted.  A point at the very end of one piece and the very start of the other is not a crossing.
    """
    low, high, deleted = [0.0] * len(chain), [inf] * len(chain), np.zeros(len(chain), np.bool_)
    joint_rows, deleting_rows = list[int](), list[int]()
    joint_bounds, other_bounds = (
        crossings.b.searchsorted(np.arange(len(chain) + 1)).tolist() for crossings in (joints, others)
    )
    trims = list(zip(joints.along_a.tolist(), joints.along_b.tolist(), strict=True))
    columns = others.a, others.along_a, others.along_b, others.a_ends, others.b_ends
    cuts = list(zip(*(column.tolist() for column in columns), strict=True))
    for b in np.union1d(joints.b, others.b).tolist():
        rows = range(joint_bounds[b], joint_bounds[b + 1])
        for row in rows[-1:] if last_wins else rows:
            along_a, along_b = trims[row]
            if along_a >= low[b - 2] - ON_PATH:
                high[b - 2], low[b] = along_a, along_b
                joint_rows.append(row)
                break
        start = low[b]
        for row in range(other_bounds[b], other_bounds[b + 1]):
            a, along_a, along_b, a_ends, b_ends = cuts[row]
            first, last = low[a], high[a]
            if deleted[a] or along_b < start - ON_PATH or not first - ON_PATH <= along_a <= last + ON_PATH:
                continue
            if b_ends and along_a <= first + ON_PATH:
                continue
            if along_b <= start + ON_PATH and (a_ends or along_a >= last - ON_PATH):
                continue
            high[a], low[b], deleted[a + 1 : b] = along_a, along_b, True
            deleting_rows.append(row)
            break
    taken, deleting = joints.take(np.array(joint_rows, np.intp)), others.take(np.array(deleting_rows, np.intp))
    starts, remains = as_complex(chain.raw.points)[:-1].copy(), ~deleted
    starts[taken.b], remains[taken.b - 1] = taken.points, False
    starts[deleting.b] = deleting.points
    path, kept = _pruned_path(chain, remains, starts, low, high)
    bridged = chain.parts[kept] >= RawPart.BRIDGE
    return Pruned(path, bridged, kept[bridged], _deletions(chain, deleting, deleted))


def _pruned_path(
    chain: RawChain, remains: Flags, starts: Points, low: Sequence[float], high: Sequence[float]
) -> tuple[Path, Rows]:
    """Return the path of the pieces that remain, and their rows.

    Each remains from `low` to `high` millimeters along it, `high` infinite if its end is untrimmed, and starts at its
    point of `starts` (m,).  Pieces without length are left out: an arc trimmed to a point must not become a full
    circle.  An arc that remains a full turn within rounding gets equal ends, and so stays a full circle.
    """
    raw, rows = chain.raw, remains.nonzero()[0]
    points = np.append(starts[rows], as_complex(raw.points)[-1:])
    has_length = np.abs(points[1:] - points[:-1]) > JOINED
    for row in (~has_length & (raw.turns[rows] != 0)).nonzero()[0].tolist():
        piece = int(rows[row])
        if min(high[piece], raw[piece].length) - low[piece] > JOINED:
            points[row + 1], has_length[row] = points[row], True
    rows, points = rows[has_length], points[np.append(has_length, True)]
    if not len(rows):
        return EMPTY, rows
    return Path.of(coordinates(points), raw.centers[rows], raw.turns[rows], raw.numbers[rows]), rows


def _deletions(chain: RawChain, events: Crossings, is_deleted: Flags) -> Deletions:
    """Return the deleted segments, each with the first event, a crossing that deleted something, that spans it."""
    deleted = is_deleted.nonzero()[0]
    deleted = deleted[chain.half_steps[deleted] % 2 == 0]
    if not len(deleted):
        return NO_DELETIONS
    # events come in the order of b: the first that ends after a piece spans it, unless it also begins after it
    event = events.b.searchsorted(deleted, side="right")
    while (late := events.a[event] >= deleted).any():
        event[late] += 1
    numbers = chain.raw.numbers
    by = np.stack((numbers[events.a[event]], numbers[events.b[event]]), axis=1)
    return Deletions(numbers[deleted], by, coordinates(events.points[event]))
