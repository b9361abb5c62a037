"""Compensate: calculate a MILL CONTOUR block's center path under the look-ahead, and keep the result of every stage.

The stages: drop zero-length segments, offset to the raw chain, find the crossings, walk and prune, add blend moves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.comp import findings
from core.comp.blend_moves import blend_in, blend_out
from core.comp.compensated import Compensated
from core.comp.crossings import Candidates, crossings
from core.comp.offset import RawChain, offset
from core.comp.prune import prune
from core.finding import Finding
from core.geometry.path import Path, as_complex
from core.geometry.piece import Arc, Piece, Side
from core.tolerance import JOINED


def compensate(
    contour: Path,
    side: Side,
    radius: float,
    lookahead: int,
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> Compensated:
    """Calculate the center path of a contour, `radius` millimeters to `side`, at one look-ahead.

    `closed` is True if the programmed contour ends at its start; its first and last segments are then never tested
    against each other.  `blend` is the radius of the blend arcs, `overlap` the distance that a closed path runs past
    its start, millimeters, 0 = none.  A contour that cannot be compensated gives an empty path and an error finding.
    """
    return compensate_all(contour, side, radius, (lookahead,), closed=closed, blend=blend, overlap=overlap)[0]


def compensate_all(
    contour: Path,
    side: Side,
    radius: float,
    lookaheads: Sequence[int],
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> tuple[Compensated, ...]:
    """Run `compensate` at several look-aheads, in their order; those that test the same crossings share one walk."""
    if not lookaheads:
        return ()
    refused, common = findings.contour_refusals(contour, radius, lookaheads), list[Finding]()
    if not refused:
        contour, common = _with_length(contour)
        if not len(contour):
            refused = findings.contour_refusals(contour, radius, lookaheads)
    if not refused and closed:
        common += findings.start_in_corner_finding(contour, side, radius)
    first = Compensated(
        contour=contour,
        side=side,
        radius=radius,
        lookahead=lookaheads[0],
        closed=closed,
        findings=(*common, *refused),
    )
    if refused:
        return tuple(replace(first, lookahead=lookahead) for lookahead in lookaheads)
    chain = offset(contour, side, radius)
    candidates = crossings(chain, max(lookaheads), closed=closed)
    walked: dict[int, Compensated] = {}
    for lookahead in lookaheads:
        tested = candidates.count(lookahead)
        if tested not in walked:
            stages = replace(first, lookahead=lookahead, raw=chain.raw, tested=tested)
            walked[tested] = _walked(stages, chain, candidates, blend, overlap)
    return tuple(replace(walked[candidates.count(lookahead)], lookahead=lookahead) for lookahead in lookaheads)


def _walked(stages: Compensated, chain: RawChain, candidates: Candidates, blend: float, overlap: float) -> Compensated:
    """Return the path at a look-ahead, after the stages that do not depend on it."""
    contour, side, closed = stages.contour, stages.side, stages.closed
    within, last_wins = candidates.within(stages.lookahead), closed and len(contour) == 2
    pruned = prune(chain, candidates.joints, within, last_wins=last_wins)
    path_findings = findings.bridge_findings(contour, chain, pruned, stages.radius)
    if closed:
        path_findings += findings.most_deleted_finding(contour, pruned)
    if not len(pruned.path):
        path_findings.append(findings.NOTHING_LEFT)
    return replace(
        stages,
        path=pruned.path,
        bridged=pruned.bridged,
        deleted=pruned.deleted,
        lead_in=blend_in(pruned.path, side, blend),
        lead_out=blend_out(pruned.path, side, blend, overlap, closed=closed),
        findings=(*stages.findings, *path_findings),
    )


def _with_length(contour: Path) -> tuple[Path, list[Finding]]:
    """Return the contour without its zero-length segments, and a finding for each of them."""
    ends = as_complex(contour.points)
    near = (np.abs(ends[1:] - ends[:-1]) <= JOINED).nonzero()[0]
    dropped = np.array([row for row in near.tolist() if _is_point(contour[row])], np.intp)
    if not len(dropped):
        return contour, []
    return contour.without(dropped), findings.zero_length(contour, dropped)


def _is_point(piece: Piece) -> bool:
    """True if a piece with ends within JOINED has no length; an arc centered on its end has no direction there."""
    return piece.length <= JOINED or (isinstance(piece, Arc) and piece.center == piece.end)
