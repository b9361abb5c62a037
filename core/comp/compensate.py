"""Compensate: a contour's center path under the control's look-ahead rule, every stage kept.

The stages: zero-length segments dropped, offset to the raw chain, crossings found, walked and pruned, blended.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from core.comp import trouble
from core.comp.blend import blend_in, blend_out
from core.comp.crossings import Candidates, crossings
from core.comp.offset import Chain, offset
from core.comp.prune import Pruned, prune
from core.comp.result import Compensated, Deletions
from core.finding import Finding
from core.geometry.path import EMPTY, Path, Rows, as_complex
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
    """The center path of a contour at `radius` millimeters to `side`, at one look-ahead.

    `closed` is whether the programmed contour ends at its start; its first and last segments are then never tested
    against each other.  `blend` is the radius of the blend arcs, `overlap` how far a closed contour runs past its
    start, millimeters, 0 = none.  A contour that cannot be compensated gives an empty path and an error finding.
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
    """`compensate` at several look-aheads, in their order; offsets and crossings are found once.

    Look-aheads that test the same crossings share their arrays: their `path` is one object.
    """
    return crossed(contour, side, radius, lookaheads, closed=closed, blend=blend, overlap=overlap).at(lookaheads)


def crossed(
    contour: Path,
    side: Side,
    radius: float,
    lookaheads: Sequence[int],
    *,
    closed: bool,
    blend: float = 0.0,
    overlap: float = 0.0,
) -> Crossed:
    """The stages of `compensate` that no look-ahead changes, as far as any of `lookaheads` has to know of them."""
    refused = trouble.refusal(contour, radius, lookaheads)
    if refused or not lookaheads:
        return Crossed(_Asked(contour, side, radius, closed, blend, overlap), None, refused)
    surface, common = _with_length(contour)
    asked = _Asked(surface, side, radius, closed, blend, overlap)
    if not len(surface):
        return Crossed(asked, None, (*common, *trouble.refusal(surface, radius, lookaheads)))
    if closed:
        common += trouble.inside_start(surface, side, radius)
    chain = offset(surface, side, radius)
    return Crossed(asked, (chain, crossings(chain, max(lookaheads), closed=closed)), tuple(common))


class _Asked(NamedTuple):
    """What is to be compensated, and how."""

    contour: Path
    side: Side
    radius: float
    closed: bool
    blend: float
    overlap: float


@dataclass(frozen=True, eq=False, slots=True)
class Crossed:
    """A contour offset, with the crossings of its raw chain: what all look-aheads it was made for have in common.

    `found` is None for a contour that has no center path at any of them; `common` tells why, or what is always told.
    """

    asked: _Asked
    found: tuple[Chain, Candidates] | None
    common: tuple[Finding, ...]

    def at(self, lookaheads: Sequence[int], known: Compensated | None = None) -> tuple[Compensated, ...]:
        """What these look-aheads make of the contour, in their order; one of them may be `known`, made by this before.

        Those that test the same crossings share their arrays: their `path` is one object.
        """
        if self.found is None:
            return tuple(_nothing(self.asked, value, self.common) for value in lookaheads)
        chain, candidates = self.found
        last_wins = self.asked.closed and len(self.asked.contour) == 2
        made = {} if known is None else dict(zip(candidates.counts([known.lookahead]), [known], strict=True))
        # one that is alone shares its path with none
        counts = candidates.counts(lookaheads) if made or len(lookaheads) > 1 else [0] * len(lookaheads)
        for value, count in zip(lookaheads, counts, strict=True):
            if count not in made:
                pruned = prune(chain, candidates.joints, candidates.within(value), last_wins=last_wins)
                made[count] = self._compensated(value, chain, pruned)
        return tuple(_at(made[count], value) for value, count in zip(lookaheads, counts, strict=True))

    def _compensated(self, lookahead: int, chain: Chain, pruned: Pruned) -> Compensated:
        """The pruned path with its blend moves and all that is to be said about it."""
        contour, side, radius, closed, blend, overlap = self.asked
        return Compensated(
            contour=contour,
            side=side,
            radius=radius,
            lookahead=lookahead,
            closed=closed,
            raw=chain.raw,
            path=pruned.path,
            bridged=pruned.bridged,
            deleted=pruned.deleted,
            lead_in=blend_in(pruned.path, side, blend),
            lead_out=blend_out(pruned.path, side, blend, overlap, closed=closed),
            findings=(*self.common, *_findings(contour, chain, pruned, radius, closed=closed)),
        )


def _at(one: Compensated, lookahead: int) -> Compensated:
    """What another look-ahead has made as well."""
    return one if one.lookahead == lookahead else replace(one, lookahead=lookahead)


def _findings(surface: Path, chain: Chain, pruned: Pruned, radius: float, *, closed: bool) -> list[Finding]:
    found = trouble.standing(surface, chain, pruned, radius)
    if closed:
        found += trouble.long_way(surface, pruned)
    if not len(pruned.path):
        found.append(trouble.nothing_left())
    return found


def _nothing(asked: _Asked, lookahead: int, findings: tuple[Finding, ...]) -> Compensated:
    """The answer to a contour that has no center path."""
    return Compensated(
        contour=asked.contour,
        side=asked.side,
        radius=asked.radius,
        lookahead=lookahead,
        closed=asked.closed,
        raw=EMPTY,
        path=EMPTY,
        bridged=np.empty(0, np.bool_),
        deleted=Deletions(np.empty(0), np.empty((0, 2)), np.empty((0, 2))),
        lead_in=EMPTY,
        lead_out=EMPTY,
        findings=findings,
    )


def _with_length(contour: Path) -> tuple[Path, list[Finding]]:
    """The contour without its zero-length segments, and a finding for each of them."""
    ends = as_complex(contour.points)
    near = (np.abs(ends[1:] - ends[:-1]) <= JOINED).nonzero()[0]
    points = [row for row in near.tolist() if _is_point(contour[row])]
    if not points:
        return contour, []
    dropped = np.array(points)
    return _without(contour, dropped), trouble.zero_length(contour, dropped)


def _is_point(piece: Piece) -> bool:
    """No longer than JOINED, of a piece whose ends are as near; an arc about its end has no direction there."""
    return piece.length <= JOINED or (isinstance(piece, Arc) and piece.center == piece.end)


def _without(contour: Path, dropped: Rows) -> Path:
    """The contour without some segments of no length: the next one starts where the one before ends."""
    kept = np.ones(len(contour), np.bool_)
    kept[dropped] = False
    points = np.concatenate((contour.points[:1], contour.points[1:][kept]))
    whole = (contour.points[1:] == contour.points[:-1]).all(axis=1)[kept].nonzero()[0]
    for row in whole[::-1].tolist():
        points[row] = points[row + 1]
    return Path.of(points, contour.centers[kept], contour.turns[kept], contour.numbers[kept])
