"""Best path: the true offset of a whole contour, with every place that the cutter can reach and none that it cannot.

BEST_PATH.md explains the stages with a picture.  Two kinds of contour are walls on both sides: an open contour, since
the cutter could go around its ends, and a contour that crosses itself, in which over-run lead-ins are walls like any
other segment; a finding says so.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.comp.best_path.prepared_contour import PreparedContour, Walls, crosses_itself, prepare_contour
from core.comp.best_path.raw_offset import RawOffset, raw_offset, trimmed
from core.comp.best_path.slices import sliced
from core.comp.best_path.stitch import StitchedSlices, chains, path_of_slices, stitch
from core.finding import Finding, Severity
from core.geometry.path import Path, Rows
from core.geometry.piece import Side, point_of
from core.tolerance import GOUGE, JOINED, WHISKER

MAX_LOOPS: Final = 10_000
"""More loops than any real part has: such a scribble is refused."""

NO_PATH: Final = Finding("NO_PATH", Severity.ERROR, "The tool does not fit: there is no best path.")
_TANGLED_TEXT: Final = "The contour overlaps itself too often; no best path is calculated."
TANGLED: Final = Finding("TANGLED", Severity.ERROR, _TANGLED_TEXT)


@dataclass(frozen=True, eq=False, slots=True)
class BestPath:
    """The loops of the best path in the contour's direction and the order of its segments; `closed` marks closed ones.

    A closed loop starts at the offset of START if that is on it, else with the first segment that it follows.
    An open contour has open chains too.  Pieces have the programmed number k, corner arcs k + 1/2.
    Without loops, a finding says why.
    """

    loops: tuple[Path, ...]
    closed: tuple[bool, ...]
    findings: tuple[Finding, ...]


def best_path(contour: Path, side: Side, radius: float, *, closed: bool) -> BestPath:
    """Return every position of the cutter's center `radius` mm from the contour on `side` that is clear of all of it.

    `closed` is True if the programmed contour ends at its start.  Never raises: a contour that cannot be offset, or
    that has no room for the cutter, gives no loops and an error finding.
    """
    surface = prepare_contour(contour, radius, closed=closed)
    if not len(surface.path):
        return BestPath((), (), surface.findings)
    crossing = crosses_itself(surface.path, closed=closed)
    findings = surface.findings
    if crossing is not None:
        a, b = crossing
        text = f"Segments {a:g} and {b:g} cross or touch: the best path takes every segment as a wall on both sides."
        findings = (*findings, Finding("CROSSES_ITSELF", Severity.WARNING, text, a))
    untrimmed = raw_offset(surface.path, side, radius, closed=closed, crossing=crossing is not None)
    raw = trimmed(untrimmed, side.sign, radius)
    del untrimmed
    slices = sliced(raw, side.sign)
    if slices is None:
        return BestPath((), (), (*findings, TANGLED))
    walls = Walls.of(surface.path)
    # the cutter is clear of the surface along all of a slice or nowhere; one that turns the wrong way is not clear
    candidates = (~slices.dead).nonzero()[0]
    points, piece = slices.middles(raw, candidates)
    slices = slices.take(candidates[walls.clear(points, raw.segment[piece], radius)])
    stitched = stitch(raw, slices, side.sign, walls, radius)
    return _best(raw, stitched, surface, findings)


def _best(
    raw: RawOffset, stitched: StitchedSlices, surface: PreparedContour, findings: tuple[Finding, ...]
) -> BestPath:
    """Return the best path: the loops longer than rounding, with their findings."""
    walked_chains = [(rows, ring) for rows, ring in chains(stitched) if not _is_rounding(stitched, rows)]
    if len(walked_chains) > MAX_LOOPS:
        return BestPath((), (), (*findings, TANGLED))
    loops = tuple(path_of_slices(raw, stitched, rows, surface.origin) for rows, _ in walked_chains)
    if not loops:
        return BestPath((), (), (*findings, NO_PATH))
    rows = np.concatenate([rows for rows, _ in walked_chains])
    notes = (*_joined_gap_finding(raw, stitched, rows, surface), *_broken_path_finding(raw, stitched, rows, surface))
    return BestPath(loops, tuple(ring for _, ring in walked_chains), (*findings, *notes))


def _is_rounding(stitched: StitchedSlices, rows: Rows) -> bool:
    """True if these slices are so short that rounding made them; the limit is larger where it left gaps in them."""
    return float(stitched.slices.size[rows].sum()) <= (WHISKER if (stitched.gaps[rows] > JOINED).any() else GOUGE)


def _joined_gap_finding(
    raw: RawOffset, stitched: StitchedSlices, rows: Rows, surface: PreparedContour
) -> tuple[Finding, ...]:
    """Report the largest gap on the path that rounding left between neighbors' offsets and that was closed."""
    slices, bridges = stitched.slices, stitched.gaps[rows]
    end_piece = slices.end_piece[rows]
    passed = np.zeros(len(raw) + 1)
    np.add.at(passed, slices.piece[rows], 1.0)
    np.add.at(passed, end_piece + (slices.end[rows] >= raw.lengths[end_piece] - JOINED), -1.0)
    joints = np.where(np.cumsum(passed)[:-1] > 0.0, raw.gaps, 0.0)
    joints[end_piece] = np.maximum(joints[end_piece], bridges)
    piece = int(np.argmax(joints))
    if joints[piece] <= JOINED:
        return ()
    at = point_of(complex(raw.end[piece]) + complex(*surface.origin))
    text = "Neighbors' offsets that miss each other by rounding are joined; the largest gap is {0~1}."
    number, gap = float(raw.numbers[piece]), float(joints[piece])
    return (Finding("BEST_JOINED", Severity.INFO, text, number, at=at, lengths=(gap, 0.0)),)


def _broken_path_finding(
    raw: RawOffset, stitched: StitchedSlices, rows: Rows, surface: PreparedContour
) -> tuple[Finding, ...]:
    """Warn about the first place where the path ends or begins although the cutter could go on."""
    slices = stitched.slices
    loose = rows[stitched.loose_end[rows] | stitched.loose_begin[rows]]
    if not len(loose):
        return ()
    row = int(loose[0])
    node, piece = (
        (slices.last[row], slices.end_piece[row]) if stitched.loose_end[row] else (slices.first[row], slices.piece[row])
    )
    at = point_of(complex(slices.points[node]) + complex(*surface.origin))
    text = "The best path does not close near X {x} Y {y}."
    return (Finding("BEST_BROKEN", Severity.WARNING, text, float(raw.numbers[piece]), at=at),)
