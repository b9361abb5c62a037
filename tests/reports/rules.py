"""Named rules by which LinuxCNC's path may differ from ours, each a predicate on the place where they differ."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from math import ceil, floor, inf, pi
from typing import Final

import numpy as np

from core.comp.best_path.best_path import BestPath
from core.comp.crossings import crossings
from core.comp.offset import Part as ChainPart
from core.comp.offset import offset
from core.comp.result import Compensated
from core.geometry.path import Path
from core.geometry.piece import Line
from core.tolerance import JOINED
from core.verify.judge import judge
from tests.core.verify.oracle import apart, least
from tests.reports.alike import Difference
from tests.reports.parts import RADIUS, Part, corner_angle
from tests.reports.witness import Witnessed

TANGENT: Final = 0.05
"""LinuxCNC takes corners under so many radians for none."""

NOTICED: Final = 1e-3
"""A gouge deeper than this, in millimeters beside a cutter of 200, is none of LinuxCNC's printed decimals."""

STEP: Final = 0.5
"""Millimeters between points of a path that is measured by points."""


class Rule(StrEnum):
    """Why LinuxCNC's path is another one."""

    TANGENT = "a corner under 0.05 rad is none to LinuxCNC"
    REVERSAL = "a corner within 0.05 rad of turning back"
    RAPID = "no arc round a corner in front of a rapid move"
    BACKWARDS = "an inside corner beyond its segment's end: LinuxCNC runs back along it, unnoticed"
    OTHER_MEETING = "an inside corner whose offsets meet twice: LinuxCNC takes the other point"
    LOOKAHEAD = "pieces deleted where two cross off their corner: LinuxCNC looks at corners only"
    GOUGES = "LinuxCNC's path gouges, the best path never does"
    SEAM = "a closed contour's start: the best path is joined there, LinuxCNC's has two ends"
    CROSSES = "a contour that crosses itself: the best path has a loop for every side of it"
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True, eq=False)
class Case:
    """A part with LinuxCNC's path and ours."""

    part: Part
    theirs: Witnessed
    ours: Compensated
    best: BestPath

    @cached_property
    def gouges(self) -> bool:
        """Whether LinuxCNC's path gouges or runs on the wrong side.

        At corners it takes for none it makes arcs of two radii, which the judge refuses: points are measured then.
        """
        path = Path.from_pieces(self.theirs.path)
        verdict = judge(self.part.contour, self.part.side, RADIUS, path)
        if verdict.judged:
            return verdict.depth > NOTICED or bool(verdict.wrong_side)
        return least(path, self.part.contour, STEP) < RADIUS * (1.0 - TANGENT**2)

    @cached_property
    def twice(self) -> frozenset[int]:
        """Inside corners whose two offsets meet in more than one point."""
        chain = offset(self.part.contour, self.part.side, RADIUS)
        joints = crossings(chain, 1, closed=self.part.closed).joints
        rows, counts = np.unique(joints.b, return_counts=True)
        return frozenset((chain.places[rows[counts > 1]] // 2).tolist())

    @cached_property
    def deleted(self) -> frozenset[float]:
        """Numbers of the raw chain's segments and corner arcs that our path has lost."""
        return frozenset(self.ours.raw.numbers.tolist()) - frozenset(self.ours.path.numbers.tolist()) - self._bridges

    @cached_property
    def _bridges(self) -> frozenset[float]:
        chain = offset(self.part.contour, self.part.side, RADIUS)
        return frozenset(chain.raw.numbers[chain.parts == ChainPart.BRIDGE.value].tolist())

    @cached_property
    def bridged(self) -> frozenset[int]:
        """Corners our path bridges because their offsets miss each other."""
        return frozenset(floor(number) for number in self.ours.path.numbers[self.ours.bridged].tolist())


def rule_of(case: Case, found: Difference) -> Rule:
    """The first rule that holds at the place where our control's path differs."""
    for rule, holds in _RULES:
        if any(holds(case, found, corner) for corner in _corners(case.part, found)):
            return rule
    if any(found.first <= number <= found.last for number in case.deleted):
        return Rule.LOOKAHEAD
    return Rule.UNEXPLAINED


def _corners(part: Part, found: Difference) -> Iterator[int]:
    """The corners between the pieces in front of and behind a difference."""
    first, last = max(found.first, 1.0), min(found.last, float(len(part.contour)))
    return iter(range(floor(first), ceil(last)))


def _tangent(case: Case, found: Difference, corner: int) -> bool:
    """The corner is small, and LinuxCNC's path leaves ours by no more than such a corner's arc is long."""
    angle = abs(corner_angle(case.part.contour, corner))
    if not RADIUS * angle > JOINED or angle >= TANGENT:
        return False
    ends = np.array([end for piece in found.theirs for end in (piece.start, piece.end)])
    return bool(apart(ends.reshape(-1, 2), case.ours.path).max(initial=0.0) <= TANGENT * RADIUS)


def _reversal(case: Case, _: Difference, corner: int) -> bool:
    return abs(corner_angle(case.part.contour, corner)) > pi - TANGENT


def _rapid(case: Case, _: Difference, corner: int) -> bool:
    """An outside corner in front of a rapid move: LinuxCNC goes straight from one offset to the other."""
    outside = corner_angle(case.part.contour, corner) * case.part.side.sign < 0.0
    return outside and corner + 1 in case.part.rapid and isinstance(case.part.contour[corner], Line)


def _backwards(case: Case, _: Difference, corner: int) -> bool:
    return corner in case.bridged and case.gouges


def _twice(case: Case, _: Difference, corner: int) -> bool:
    return corner in case.twice


_RULES: Final[tuple[tuple[Rule, Callable[[Case, Difference, int], bool]], ...]] = (
    (Rule.TANGENT, _tangent),
    (Rule.REVERSAL, _reversal),
    (Rule.RAPID, _rapid),
    (Rule.BACKWARDS, _backwards),
    (Rule.OTHER_MEETING, _twice),
)


def best_rule_of(case: Case, found: Difference) -> Rule:
    """The first rule that holds at the place where the best path differs."""
    if any(one.code == "CROSSES_ITSELF" for one in case.best.findings):
        return Rule.CROSSES
    if case.gouges:
        return Rule.GOUGES
    if case.part.closed and (found.first == -inf or found.last == inf):
        return Rule.SEAM
    return rule_of(case, found)
