"""Compensate: calculate a MILL CONTOUR block's center path under the look-ahead, and keep the result of every stage.

The stages: drop zero-length segments, offset to the raw chain, find the crossings, walk and prune, add blend moves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

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
    return offset_contour(contour, side, radius, (lookahead,), closed=closed).path_at(lookahead, blend, overlap)


@dataclass(frozen=True, eq=False, slots=True)
class OffsetContour:
    """An offset contour with the crossings of its raw chain: the stages that do not depend on the look-ahead.

    `chain` is None if the contour has no center path at any look-ahead; `findings` then say why.  Otherwise they apply
    at every look-ahead."""

    contour: Path
    side: Side
    radius: float
    closed: bool
    chain: RawChain | None
    candidates: Candidates | None
    findings: tuple[Finding, ...]

    def tested(self, lookahead: int) -> int:
        """Return how many crossings this look-ahead tests."""
        return self.candidates.count(lookahead) if self.candidates else 0

    def path_at(self, lookahead: int, blend: float, overlap: float) -> Compensated:
        """Return the contour's path at this look-ahead, no larger than the largest one that `offset_contour` got."""
        chain, candidates = self.chain, self.candidates
        if chain is None or candidates is None:
            return Compensated(
                contour=self.contour,
                side=self.side,
                radius=self.radius,
                lookahead=lookahead,
                closed=self.closed,
                findings=self.findings,
            )
        last_wins = self.closed and len(self.contour) == 2
        pruned = prune(chain, candidates.joints, candidates.within(lookahead), last_wins=last_wins)
        path_findings = findings.bridge_findings(self.contour, chain, pruned, self.radius)
        if self.closed:
            path_findings += findings.most_deleted_finding(self.contour, pruned)
        if not len(pruned.path):
            path_findings.append(findings.NOTHING_LEFT)
        return Compensated(
            contour=self.contour,
            side=self.side,
            radius=self.radius,
            lookahead=lookahead,
            closed=self.closed,
            raw=chain.raw,
            tested=self.tested(lookahead),
            path=pruned.path,
            bridged=pruned.bridged,
            deleted=pruned.deleted,
            lead_in=blend_in(pruned.path, self.side, blend),
            lead_out=blend_out(pruned.path, self.side, blend, overlap, closed=self.closed),
            findings=(*self.findings, *path_findings),
        )


def offset_contour(
    contour: Path, side: Side, radius: float, lookaheads: Sequence[int], *, closed: bool
) -> OffsetContour:
    """Run the stages of `compensate` that all of these look-aheads have in common."""
    refused = findings.contour_refusals(contour, radius, lookaheads)
    if refused:
        return OffsetContour(contour, side, radius, closed, None, None, refused)
    surface, common = _with_length(contour)
    if not len(surface):
        refused = (*common, *findings.contour_refusals(surface, radius, lookaheads))
        return OffsetContour(surface, side, radius, closed, None, None, refused)
    if closed:
        common += findings.start_in_corner_finding(surface, side, radius)
    chain = offset(surface, side, radius)
    candidates = crossings(chain, max(lookaheads), closed=closed)
    return OffsetContour(surface, side, radius, closed, chain, candidates, tuple(common))


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
    offset = offset_contour(contour, side, radius, lookaheads, closed=closed)
    first = {offset.tested(lookahead): lookahead for lookahead in reversed(lookaheads)}
    walked = {tested: offset.path_at(lookahead, blend, overlap) for tested, lookahead in first.items()}
    return tuple(replace(walked[offset.tested(lookahead)], lookahead=lookahead) for lookahead in lookaheads)
