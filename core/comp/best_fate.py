"""Fate: along which slices the cutter is clear of the part.

Slices that are clear or not together make a COMPANY: those joined without an event between them, and across a crossing
those that turn to the cutter's side.  A company with one slice that turns the wrong way is not clear.  Of every other
company the distance to the surface is measured at some places, and at all of them if these disagree.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.comp.best_clear import clear
from core.comp.best_events import places
from core.comp.best_raw import Raw
from core.comp.best_slices import Slices, merged
from core.comp.best_surface import Surface
from core.geometry.intersect import Indices, Masks, Planes
from core.geometry.path import Floats

EVERY: Final = 64
"""Of a company's runs in their order the first and then one of so many are measured, and all that are long."""


def clear_slices(raw: Raw, cut: Slices, surface: Surface, radius: float) -> Slices:
    """The slices along which the cutter is nowhere nearer to the surface than the radius."""
    if not len(cut):
        return cut
    heads, run = _runs(cut)
    company = _companies(cut, heads, run)
    alive = _none(np.logical_or.reduceat(cut.dead, heads), company)
    sample = _longest(cut.end - cut.begin, heads, run)
    first = alive & (_rank(np.where(alive, company, -1)) % EVERY == 0)
    first |= alive & ((cut.end - cut.begin)[sample] > radius / 4.0)
    good = _measured(raw, cut, sample, first, surface, radius)
    whole, part = np.zeros((2, len(heads)), np.bool_)
    whole[company[good]] = True
    part[company[first & ~good]] = True
    doubtful = alive & whole[company] & part[company] & ~first
    good |= alive & whole[company] & ~part[company]
    good |= _measured(raw, cut, sample, doubtful, surface, radius)
    return cut.take(np.flatnonzero(good[run]))


def _measured(raw: Raw, cut: Slices, sample: Indices, asked: Masks, surface: Surface, radius: float) -> Masks:
    """Which of the runs that are asked about are clear, each measured in the middle of its sample slice."""
    good = asked.copy()
    rows = sample[asked]
    good[asked] = clear(surface, middles(raw, cut, rows), raw.segment[cut.piece[rows]], radius)
    return good


def _runs(cut: Slices) -> tuple[Indices, Indices]:
    """Slices that follow each other over joints without events: the first of each run, and each slice's run."""
    fresh = np.ones(len(cut), np.bool_)
    fresh[1:] = (cut.last[:-1] != cut.first[1:]) | cut.met[cut.first[1:]]
    return np.flatnonzero(fresh), np.cumsum(fresh) - 1


def _companies(cut: Slices, heads: Indices, run: Indices) -> Indices:
    """The least run of each run's company."""
    turning = np.flatnonzero(cut.turning >= 0)
    return merged(len(heads), run[turning], run[cut.turning[turning]])


def _none(dead: Masks, company: Indices) -> Masks:
    """Runs in whose company none is dead."""
    lost = np.zeros(len(dead), np.bool_)
    lost[company[dead]] = True
    return ~lost[company]


def _rank(company: Indices) -> Indices:
    """Each run's place in its company."""
    order = np.argsort(company, kind="stable")
    sort = company[order]
    rank = np.empty(len(company), np.intp)
    rank[order] = np.arange(len(company)) - np.searchsorted(sort, sort)
    return rank


def _longest(lengths: Floats, heads: Indices, run: Indices) -> Indices:
    """The first of the longest slices of each run."""
    rows = np.flatnonzero(lengths == np.maximum.reduceat(lengths, heads)[run])
    return rows[np.searchsorted(run[rows], np.arange(len(heads)))]


def middles(raw: Raw, cut: Slices, rows: Indices) -> Planes:
    """The points half way along slices."""
    return places(raw, cut.piece[rows], (cut.begin[rows] + cut.end[rows]) / 2.0)
