"""Prune: the control's walk along the raw chain, which trims, bridges and deletes under the look-ahead.

The pieces b come one after the other.  Each is first joined to its predecessor; then it is tested against what is
left of earlier pieces a within the look-ahead, and the earliest that crosses it wins: a ends there, b starts there,
everything between is deleted (the control's look-ahead note).  What is left of a piece is a range of distances
along it, so that the walk compares numbers and visits only pieces at which something is not settled by themselves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.comp.crossings import Crossings
from core.comp.offset import BRIDGE, Chain
from core.comp.result import Deletions
from core.comp.walk import Left, Walk
from core.geometry.path import EMPTY, Flags, Path, Rows, as_complex, coordinates
from core.tolerance import JOINED, ON_PATH


@dataclass(frozen=True, eq=False, slots=True)
class Pruned:
    """What the walk leaves: the path, its `bridged` pieces (len(path),), and the deleted segments.

    `bridges` are the rows of bridges of the chain that still stand.
    """

    path: Path
    bridged: Flags
    bridges: Rows
    deleted: Deletions


def prune(chain: Chain, joints: Crossings, others: Crossings, *, last_wins: bool = False) -> Pruned:
    """Walk the chain with the crossings of its joints and those of other pieces that the look-ahead tests.

    `last_wins`: a joint takes the latest point on the earlier piece (closed contours of two segments).
    """
    left, unsettled = _joined(chain, joints, last_wins=last_wins)
    met = np.empty(0, np.intp)
    if len(others) or len(unsettled):
        met = Walk(chain, left, joints, others).visit(unsettled)
    path, bridges = _what_is_left(chain, left)
    gone = np.frombuffer(left.gone, np.bool_)
    del left
    return Pruned(path, *bridges, _deletions(chain, others, met, gone))


def _joined(chain: Chain, joints: Crossings, *, last_wins: bool) -> tuple[Left, Rows]:
    """Trim every inside corner at its first crossing; also the pieces whose start is trimmed beyond their end."""
    count = len(chain)
    high, standing = np.empty(count), np.empty(count, np.uint8)
    high.fill(np.inf)
    standing.fill(1)
    left = Left(np.zeros(count), high, as_complex(chain.raw.points)[:-1].copy(), standing, bytearray(count))
    if not len(joints):
        return left, np.empty(0, np.intp)
    again = joints.b[1:] == joints.b[:-1]
    trims = joints
    if again.any():
        trims = joints.chosen(~np.append(again, False) if last_wins else ~np.append(False, again))
    left.high[trims.a], left.low[trims.b], left.starts[trims.b] = trims.along_a, trims.along_b, trims.points
    left.standing[trims.b - 1] = 0
    return left, (left.low > left.high + ON_PATH).nonzero()[0] + 2


def _what_is_left(chain: Chain, left: Left) -> tuple[Path, tuple[Flags, Rows]]:
    """The path of the pieces that still stand; which of them are bridges, and their rows in the chain."""
    alive = (left.standing > np.frombuffer(left.gone, np.uint8)).nonzero()[0]
    starts = np.concatenate((left.starts[alive], as_complex(chain.raw.points)[-1:]))
    real = _not_slivers(chain, left, alive, starts)
    if not real.all():
        alive, starts = alive[real], starts[np.append(real, True)]
    bridged = chain.parts[alive] >= BRIDGE
    if not len(alive):
        return EMPTY, (bridged, alive)
    turns = chain.raw.turns[alive]
    centers, arcs = starts[:-1].copy(), turns.nonzero()[0]
    centers[arcs] = as_complex(chain.raw.centers)[alive[arcs]]
    path = Path(coordinates(starts), coordinates(centers), turns, chain.raw.numbers[alive])
    return path, (bridged, alive[bridged])


def _not_slivers(chain: Chain, left: Left, alive: Rows, starts: NDArray[np.complex128]) -> Flags:
    """Which pieces still have a length: an arc trimmed to a point must not be taken for a full circle.

    One that is left for a whole turn but for rounding is made one: its ends in `starts` become the same numbers.
    """
    real = np.abs(starts[1:] - starts[:-1]) > JOINED
    near = (~real).nonzero()[0]
    if not len(near):
        return real
    arcs = near[chain.raw.turns[alive[near]] != 0]
    rest = left.high[alive[arcs]] - left.low[alive[arcs]]
    for row in np.isinf(rest).nonzero()[0].tolist():
        piece = int(alive[arcs[row]])
        rest[row] = chain.raw[piece].length - left.low[piece]
    whole = arcs[rest > JOINED]
    starts[whole + 1] = starts[whole]
    real[whole] = True
    return real


def _deletions(chain: Chain, others: Crossings, met: Rows, gone: Flags) -> Deletions:
    """The segments among the pieces that are gone, each by the first event, a row in `met`, that spans it."""
    if not len(met):
        return Deletions(np.empty(0), np.empty((0, 2)), np.empty((0, 2)))
    deleted = gone.nonzero()[0]
    deleted = deleted[chain.places[deleted] % 2 == 0]
    a, b = others.a[met], others.b[met]
    # events come in the order of b: the first that ends behind a piece spans it unless it begins behind it too
    event = b.searchsorted(deleted, side="right")
    while (behind := a[event] >= deleted).any():
        event[behind] += 1
    numbers, by = chain.raw.numbers, np.empty((len(event), 2))
    by[:, 0], by[:, 1] = numbers[a[event]], numbers[b[event]]
    return Deletions(numbers[deleted], by, coordinates(others.points[met[event]]))
