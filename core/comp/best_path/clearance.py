"""Clearance: along which slices the cutter is nowhere nearer to the surface than its radius.

Slices that are clear or not together make a GROUP: those that at crossings turn to each other on the cutter's side.
A group with one slice that turns the wrong way is not clear.  Of every other group the distance to the surface is
measured at a sample of slices, and at all of them if these disagree.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.comp.best_path.raw_offset import RawOffset
from core.comp.best_path.slices import Slices, least_of_connected
from core.geometry.nearby import nearest_pieces
from core.geometry.path import Flags, Path, Points, Rows
from core.geometry.piece_arrays import PieceArrays, piece_arrays
from core.tolerance import CLEAR

SAMPLE: Final = 64
"""Of a group's slices in their order the first and then one of so many are measured, and all that are long."""


def clear_slices(raw: RawOffset, cut: Slices, surface: Path, radius: float) -> Slices:
    """The slices along which the cutter is nowhere nearer to the surface than the radius."""
    if not len(cut):
        return cut
    turning = (cut.turning >= 0).nonzero()[0]
    group = least_of_connected(len(cut), turning, cut.turning[turning])
    lost = np.zeros(len(cut), np.bool_)
    lost[group[cut.dead]] = True
    alive = ~lost[group]
    sample = alive & ((_rank(np.where(alive, group, -1)) % SAMPLE == 0) | (cut.size > radius / 4.0))
    walls = piece_arrays(surface)
    good = _clear_in_middle(raw, cut, sample, walls, radius)
    clear, blocked = np.zeros((2, len(cut)), np.bool_)
    clear[group[good]] = True
    blocked[group[sample & ~good]] = True
    doubtful = alive & clear[group] & blocked[group] & ~sample
    good |= alive & clear[group] & ~blocked[group]
    good |= _clear_in_middle(raw, cut, doubtful, walls, radius)
    return cut.take(good.nonzero()[0])


def _clear_in_middle(raw: RawOffset, cut: Slices, asked: Flags, walls: PieceArrays, radius: float) -> Flags:
    """Which of the slices that are asked about are clear, each measured in its middle."""
    good = asked.copy()
    good[asked] = clear(cut.middles(raw, asked.nonzero()[0]), walls, radius)
    return good


def clear(points: Points, walls: PieceArrays, radius: float) -> Flags:
    """(k,) which points are no nearer to any piece of the surface than the radius, within CLEAR."""
    nearest = np.full(len(points), np.inf)
    k, _, apart = nearest_pieces(points, walls)
    nearest[k] = apart
    return nearest >= radius - CLEAR


def _rank(group: Rows) -> Rows:
    """Each slice's place in its group."""
    order = np.argsort(group, kind="stable")
    ordered = group[order]
    rank = np.empty(len(group), np.intp)
    rank[order] = np.arange(len(group)) - np.searchsorted(ordered, ordered)
    return rank
