"""This module finds every answer of a run: it follows the branches of the steps and checks each answer."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import dist
from typing import Final

from core.finding import Finding
from core.geometry.piece import Piece, Point
from core.program.solve.run.answer_check import Pieces, chain_of
from core.program.solve.run.branch import Branch, DeadEnd, Run
from core.program.solve.run.newton import polished
from core.program.solve.run.steps import STEPS

MAX_SAME_DISTANCE: Final = 1e-6
"""Millimeters within which two answers count as the same."""

MAX_BRANCHES: Final = 512
"""The most branches that are followed in one run; a run with more is not solved."""

GRAZE_SHIFT: Final = 12
"""The number of low bits of a choice that record the roots taken; higher bits record which of them are double."""


@dataclass(frozen=True, slots=True)
class Answer:
    """One solution of a run: its pieces, and the number by which a file picks it (CALCULATED_RUNS.md, section 6)."""

    choice: int
    pieces: Pieces

    @property
    def length(self) -> float:
        """The total length of its pieces, in millimeters."""
        return sum(piece.length for piece in self.pieces)


@dataclass(frozen=True, slots=True)
class Search:
    """All answers of a run, the shortest first; `stuck` is an incomplete branch to which no step applies, or None."""

    answers: tuple[Answer, ...]
    findings: tuple[Finding, ...]
    """Why branches were dropped: the first objection to each, those nearest to an answer first."""
    stuck: Branch | None
    known: Branch
    """The values known without a choice."""


CHAIN_WITH_OBJECTIONS: Final = 0
PIECE_IMPOSSIBLE: Final = 1
NO_CHAIN_YET: Final = 2
"""How far a dropped branch got, the farthest first."""


@lru_cache(512)
def search(run: Run) -> Search:
    """Return every answer that the steps give."""
    first = Branch(run)
    # how far a branch got, the number of objections to it, and the first of them
    dropped: list[tuple[int, int, Finding]] = []
    answers: list[Answer] = []
    stuck: Branch | None = None
    waiting, count = [first], 0
    while waiting and count < MAX_BRANCHES:
        branch, count = waiting.pop(), count + 1
        branch.settle()
        try:
            steps = () if branch.complete else STEPS
            next_branches = next((branches for step in steps if (branches := step(branch)) is not None), None)
        except DeadEnd as end:
            dropped.append((NO_CHAIN_YET, 0, end.finding))
            continue
        if next_branches is not None:
            waiting += reversed(next_branches)
        elif not branch.complete:
            stuck = stuck or branch
        else:
            chain, objections = chain_of(branch)
            if chain is not None and not objections:
                exact = run.missing == 0 and not any(branch.grazes)
                chain = polished(run, chain) if exact else chain
                if not any(same_pieces(chain, other.pieces, MAX_SAME_DISTANCE) for other in answers):
                    answers.append(Answer(_choice_of(branch), chain))
            else:
                stage = CHAIN_WITH_OBJECTIONS if chain is not None else PIECE_IMPOSSIBLE
                dropped.append((stage, len(objections), objections[0]))
    if waiting:
        stuck, answers = stuck or first, []
    answers.sort(key=lambda answer: (round(answer.length, 5), answer.choice))
    dropped.sort(key=lambda drop: drop[:2])
    return Search(tuple(answers), tuple(finding for *_, finding in dropped), stuck, first)


def _choice_of(branch: Branch) -> int:
    roots = sum(root << step for step, root in enumerate(branch.choices))
    return roots + sum(1 << (GRAZE_SHIFT + step) for step, grazing in enumerate(branch.grazes) if grazing)


def same_pieces(first: Pieces, second: Pieces, within: float) -> bool:
    """True if the ends and centers of two answers' pieces agree within `within` millimeters."""
    return all(
        dist(a, b) <= within
        for piece, other in zip(first, second, strict=True)
        for a, b in zip(_points(piece), _points(other), strict=True)
    )


def _points(piece: Piece) -> tuple[Point, ...]:
    center = getattr(piece, "center", piece.end)
    return piece.start, piece.end, center
