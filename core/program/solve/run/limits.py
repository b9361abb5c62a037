"""The radius that would fit: where a typed RADIUS leaves a run without answer, the nearest one that does not."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Final

from core.finding import Finding
from core.program.solve.run import reasons
from core.program.solve.run.element import Element, Run
from core.program.solve.run.search import GRAZE_SHIFT, search

TRIED: Final = tuple(1.08**step for step in range(1, 60))
"""The factors by which a radius is made larger and smaller."""

HALVINGS: Final = 48
"""How often the way between a radius that fits and one that does not is halved."""

ABOUT_RADIUS: Final = frozenset(
    ("TOO_SMALL", "BEHIND", "NO_TANGENT", "NO_MEETING", "NO_LENGTH_LEFT", "INSIDE", "WRONG_SENSE", "OUT_OF_RANGE")
)
"""The codes for which a RADIUS may be to blame."""


@lru_cache(64)
def with_limit(run: Run, finding: Finding) -> Finding:
    """The finding, or that a RADIUS is too small or too large where another one would fit."""
    if finding.code not in ABOUT_RADIUS:
        return finding
    for index, element in enumerate(run.elements):
        if element.turn and "radius" in element.known and not _centered(element):
            limit = _limit(run, index)
            if limit is not None:
                return reasons.radius_limit(run, index, limit, least=limit > element.known["radius"])
    return finding


def _centered(element: Element) -> bool:
    return "x_center" in element.known and "y_center" in element.known


def _limit(run: Run, index: int) -> float | None:
    """The radius nearest to the typed one at which the run has an answer."""
    radius = run.elements[index].known["radius"]
    last = {1: radius, -1: radius}
    for factor in TRIED:
        for way in (1, -1):
            tried = radius * factor**way
            if _fits(run, index, tried):
                return _halved(run, index, last[way], tried)
            last[way] = tried
    return None


def _halved(run: Run, index: int, bad: float, good: float) -> float:
    for _ in range(HALVINGS):
        middle = (bad + good) / 2.0
        bad, good = (bad, middle) if _fits(run, index, middle) else (middle, good)
    return good


def _fits(run: Run, index: int, radius: float) -> bool:
    element = run.elements[index]
    typed = tuple((name, radius if name == "radius" else value) for name, value in element.typed)
    elements = (*run.elements[:index], replace(element, typed=typed), *run.elements[index + 1 :])
    # where it only just fits, the limit is where it does without any tolerance
    answers = search.__wrapped__(replace(run, elements=elements)).answers
    return any(answer.choice < 1 << GRAZE_SHIFT for answer in answers)
