"""Fate: along which slices the cutter is clear of the part.

Slices that are clear or not together make a COMPANY: those that at crossings turn to each other on the cutter's side.
A company with one slice that turns the wrong way is not clear.  Of every other company the distance to the surface is
measured at some places, and at all of them if these disagree.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.comp.best_path.clear import clear
from core.comp.best_path.raw_offset import Raw
from core.comp.best_path.slices import Slices, merged, middles
from core.comp.best_path.surface import Surface
from core.geometry.path import Flags, Rows

EVERY: Final = 64
"""Of a company's slices in their order the first and then one of so many are measured, and all that are long."""


def clear_slices(raw: Raw, cut: Slices, surface: Surface, radius: float) -> Slices:
    """The slices along which the cutter is nowhere nearer to the surface than the radius."""
    if not len(cut):
        return cut
    turning = (cut.turning >= 0).nonzero()[0]
    company = merged(len(cut), turning, cut.turning[turning])
    alive = _none(cut.dead, company)
    first = alive & (_rank(np.where(alive, company, -1)) % EVERY == 0)
    first |= alive & (cut.size > radius / 4.0)
    good = _measured(raw, cut, first, surface, radius)
    whole, part = np.zeros((2, len(cut)), np.bool_)
    whole[company[good]] = True
    part[company[first & ~good]] = True
    doubtful = alive & whole[company] & part[company] & ~first
    good |= alive & whole[company] & ~part[company]
    good |= _measured(raw, cut, doubtful, surface, radius)
    return cut.take(good.nonzero()[0])


def _measured(raw: Raw, cut: Slices, asked: Flags, surface: Surface, radius: float) -> Flags:
    """Which of the slices that are asked about are clear, each measured in its middle."""
    good = asked.copy()
    spots, piece = middles(raw, cut, asked.nonzero()[0])
    good[asked] = clear(surface, spots, raw.segment[piece], radius)
    return good


def _none(dead: Flags, company: Rows) -> Flags:
    """Slices in whose company none is dead."""
    lost = np.zeros(len(dead), np.bool_)
    lost[company[dead]] = True
    return ~lost[company]


def _rank(company: Rows) -> Rows:
    """Each slice's place in its company."""
    order = np.argsort(company, kind="stable")
    sort = company[order]
    rank = np.empty(len(company), np.intp)
    rank[order] = np.arange(len(company)) - np.searchsorted(sort, sort)
    return rank
