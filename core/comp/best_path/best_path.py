"""The best path: the true offset of a whole contour, every place its cutter can reach and nothing it cannot.

The control's look-ahead rule does not bind it: it is trimmed globally, across the start too, in one or several loops.
It is made of the raw chain's pieces, cut wherever they meet: a slice belongs to the path where the cutter is clear of
every segment, whatever that segment's number.  So the best path is exact wherever the raw chain is.

Two things count as surface on both sides: an open contour, about whose ends the cutter could go, and a contour that
crosses itself, where over-run lead-ins are walls like any other segment; a finding says so.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from core.comp.best_path.fate import clear_slices
from core.comp.best_path.loops import loop_of
from core.comp.best_path.meetings import events
from core.comp.best_path.raw_offset import Raw, untrimmed
from core.comp.best_path.result import BestPath
from core.comp.best_path.separation import Separation, separation
from core.comp.best_path.slices import sliced
from core.comp.best_path.stitch import Stitched, chains, stitch
from core.comp.best_path.surface import Surface, crosses_itself, surface_of
from core.comp.best_path.trim import trimmed
from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.piece import Side
from core.tolerance import GOUGE

__all__ = ["BestPath", "Separation", "best_path", "separation"]

MOST_LOOPS: Final = 10_000
"""More loops than any part has: such a scribble is refused."""


def best_path(contour: Path, side: Side, radius: float, *, closed: bool) -> BestPath:
    """Every place of the cutter's center at `radius` millimeters from the contour on `side` that is clear of all of it.

    `closed` is whether the programmed contour ends at its start.  Never raises: a contour that cannot be offset, or
    beside which the cutter fits nowhere, gives no loops and an error finding.
    """
    surface = surface_of(contour, radius, closed=closed)
    if not len(surface.path):
        return BestPath((), (), surface.findings)
    crossing = crosses_itself(surface, closed=closed)
    findings = surface.findings if crossing is None else (*surface.findings, _crossing(crossing))
    chain = untrimmed(surface.path, side, radius, closed=closed, crossing=crossing is not None)
    raw = trimmed(chain, side.sign, radius)
    del chain
    found = events(raw, side.sign)
    if found is None:
        return BestPath((), (), (*findings, _tangled()))
    made = stitch(raw, clear_slices(raw, sliced(raw, found), surface, radius), side.sign)
    return _best(raw, made, surface, findings)


def _best(raw: Raw, made: Stitched, surface: Surface, findings: tuple[Finding, ...]) -> BestPath:
    """The loops longer than rounding, and what is to be said of them."""
    walked = [(rows, ring) for rows, ring in chains(made) if made.cut.size[rows].sum() > GOUGE]
    if len(walked) > MOST_LOOPS:
        return BestPath((), (), (*findings, _tangled()))
    loops = tuple(loop_of(raw, made.cut, rows, surface.origin) for rows, _ in walked)
    if not loops:
        findings = (*findings, _no_path())
    loose = np.concatenate([rows[made.loose[rows]] for rows, _ in walked] or [np.empty(0, np.intp)])
    if len(loose):
        findings = (*findings, _broken(raw, made, int(loose[0]), surface))
    return BestPath(loops, tuple(ring for _, ring in walked), findings)


def _no_path() -> Finding:
    text = "The tool fits nowhere beside this contour: there is no best path."
    return Finding("NO_PATH", Severity.ERROR, text)


def _tangled() -> Finding:
    text = "The contour lies on itself so often that no best path is worked out."
    return Finding("TANGLED", Severity.ERROR, text)


def _crossing(numbers: tuple[float, float]) -> Finding:
    one, other = numbers
    text = f"Segments {one:g} and {other:g} cross or touch: the best path takes every segment as a wall on both sides."
    return Finding("CROSSES_ITSELF", Severity.WARNING, text, one)


def _broken(raw: Raw, made: Stitched, row: int, surface: Surface) -> Finding:
    place = complex(made.cut.points[made.cut.last[row]])
    at = (place.real + float(surface.origin[0]), place.imag + float(surface.origin[1]))
    number = float(raw.numbers[made.cut.until[row]])
    return Finding("BEST_BROKEN", Severity.WARNING, "The best path does not close near X {x} Y {y}.", number, at=at)
