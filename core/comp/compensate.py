"""Compensate: calculate a MILL CONTOUR block's center path under the look-ahead, and keep the result of every stage.

The stages: drop zero-length segments, offset to the raw chain, find the crossings, walk and prune, add blend moves.

Blend moves are the quarter circles on which the cutter approaches the path and leaves it.  With E the path's end point,
t its direction there and n the normal away from the material, a blend arc of radius B has its center at E + B n; it
comes from E + B n - B t (the plunge point), or leaves to E + B n + B t.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf
from typing import Final

import numpy as np

from core.comp import findings
from core.comp.compensated import Compensated
from core.comp.crossings import Candidates, crossings
from core.comp.offset import RawChain, offset
from core.comp.prune import prune
from core.finding import Finding
from core.geometry.path import EMPTY, Floats, Path, as_complex, joined
from core.geometry.piece import Arc, Line, Piece, Point, Side, point_of
from core.tolerance import CLOSED, JOINED


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
    by_tested_count: dict[int, Compensated] = {}
    for lookahead in lookaheads:
        tested_count = candidates.count(lookahead)
        if tested_count not in by_tested_count:
            stages = replace(first, lookahead=lookahead, raw=chain.raw, tested=tested_count)
            by_tested_count[tested_count] = _path_at_lookahead(stages, chain, candidates, blend, overlap)
    return tuple(replace(by_tested_count[candidates.count(lookahead)], lookahead=lookahead) for lookahead in lookaheads)


def _path_at_lookahead(
    stages: Compensated, chain: RawChain, candidates: Candidates, blend: float, overlap: float
) -> Compensated:
    """Return the path at a look-ahead, after the stages that do not depend on it."""
    contour, side, closed = stages.contour, stages.side, stages.closed
    within, last_wins = candidates.within(stages.lookahead), closed and len(contour) == 2
    pruned = prune(chain, candidates.joints, within, last_wins=last_wins)
    path_findings = findings.bridge_findings(contour, chain, pruned, stages.radius)
    if closed:
        path_findings += findings.most_deleted_finding(contour, pruned)
    if not len(pruned.path):
        path_findings.append(findings.nothing_left(chain, pruned, closed=closed))
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


MAX_CLOSING_GAP: Final = 2.0 * CLOSED
"""Millimeters: largest gap between the ends of a closed contour's path; a gap in the contour also turns a segment."""


def blend_in(path: Path, side: Side, blend: float) -> Path:
    """Return the arc of radius `blend` mm (0 = none) tangent to the path at its start, with the path's first number."""
    if not len(path) or blend <= 0.0:
        return EMPTY
    first = path[0]
    along = complex(*first.direction_at(first.start))
    start, center = _quarter_circle(first.start, -along, along, side, blend)
    return _arc(start, first.start, center, side, path.numbers[:1])


def blend_out(path: Path, side: Side, blend: float, overlap: float, *, closed: bool) -> Path:
    """Return the moves after the path: the overlap, then the arc of radius `blend` millimeters, with the last number.

    If a closed contour's path ends where it starts, it runs `overlap` millimeters past the start before it leaves:
    it repeats its own first pieces, under their own numbers.
    """
    overlap_path = past_start(path, overlap) if closed else EMPTY
    last_path = overlap_path if len(overlap_path) else path
    if not len(last_path) or blend <= 0.0:
        return overlap_path
    last = last_path[-1]
    along = complex(*last.direction_at(last.end))
    end, center = _quarter_circle(last.end, along, along, side, blend)
    return joined((overlap_path, _arc(last.end, end, center, side, last_path.numbers[-1:])))


def _arc(start: Point, end: Point, center: Point, side: Side, number: Floats) -> Path:
    turn = np.array((side.sign,), np.int8)
    return Path(np.array((start, end)), np.array((center,)), turn, number)


def past_start(path: Path, overlap: float) -> Path:
    """Return the path's first `overlap` millimeters, at most one lap, if it ends where it starts; else nothing.

    A contour counts as closed even with a small gap between its ends, and so does its path; the overlap then begins
    with a straight move to the path's start.
    """
    gap = abs(complex(*(path.points[-1] - path.points[0]).tolist())) if len(path) else inf
    if overlap <= JOINED or gap > MAX_CLOSING_GAP:
        return EMPTY
    pieces, remaining = [], overlap
    for piece in path:
        if remaining <= JOINED:
            break
        pieces.append(
            piece
            if piece.length <= remaining + JOINED
            else replace(piece, end=piece.point_at(remaining / piece.length))
        )
        remaining -= piece.length
    numbers = path.numbers[: len(pieces)].tolist()
    if gap > JOINED:
        return Path.from_pieces([Line(path[-1].end, path[0].start), *pieces], [numbers[0], *numbers])
    # it starts at the same point within rounding; a full circle stays full
    first, start = pieces[0], path[-1].end
    pieces[0] = replace(first, start=start, end=start if first.end == first.start else first.end)
    return Path.from_pieces(pieces, numbers)


def _quarter_circle(at: Point, outer: complex, along: complex, side: Side, blend: float) -> tuple[Point, Point]:
    """Return the far end, toward `outer` from the center, and the center of the quarter circle at a path's end."""
    center = complex(*at) + blend * side.sign * 1j * along
    return point_of(center + blend * outer), point_of(center)
