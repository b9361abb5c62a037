"""This module finds the number that would fit if a typed one leaves a run without an answer: the other data give it.

For a RADIUS that is too small or too large, it is the nearest radius with which the run has an answer.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import remainder, tau
from typing import Final

from core.finding import Finding
from core.program.solve.reading import ANGLE_FIELDS, measured
from core.program.solve.run import reasons
from core.program.solve.run.branch import Run
from core.program.solve.run.search import GRAZE_SHIFT, search

TRIED_FACTORS: Final = tuple(1.08**step for step in range(1, 60))
"""The factors by which a radius is enlarged and reduced."""

HALVINGS: Final = 48
"""The number of times the interval between a radius that fits and one that does not is halved."""

LIMIT_DECIMALS: Final = 6
"""Decimals of a limit in millimeters: four of an inch and more."""

ABOUT_RADIUS: Final = frozenset(
    ("TOO_SMALL", "BEHIND", "NO_TANGENT", "NO_MEETING", "NO_LENGTH_LEFT", "INSIDE", "WRONG_SENSE", "OUT_OF_RANGE")
)
"""The codes for which a RADIUS may be to blame."""


@lru_cache(64)
def with_fitting_number(run: Run, finding: Finding) -> Finding:
    """Return the finding with the number that would fit instead of the typed one, if there is one.

    A contradiction names a number that was calculated with the wrong one; the other data give the right number only
    when the run is solved without it.
    """
    if finding.code == "CONTRADICTION":
        return _with_value_of_other_data(run, finding)
    if finding.code not in ABOUT_RADIUS:
        return finding
    for index, element in enumerate(run.elements):
        centered = {"x_center", "y_center"} <= element.known.keys()
        if element.turn and "radius" in element.known and not centered:
            limit = _limit(run, index)
            if limit is not None:
                return reasons.radius_limit(run, index, limit, least=limit > element.known["radius"])
    return finding


def _with_value_of_other_data(run: Run, finding: Finding) -> Finding:
    """Report the value that the contradicting number has in the run's answers without it, the nearest if several."""
    index = next(index for index, element in enumerate(run.elements) if element.number == finding.segment)
    element = run.elements[index]
    name = next((name for name in (finding.field, f"{finding.field}_inc") if name in element.known), None)
    if name is None:
        return finding
    typed = element.known[name]
    without_number = replace(element, typed=tuple(datum for datum in element.typed if datum[0] != name))
    answers = search(replace(run, elements=(*run.elements[:index], without_number, *run.elements[index + 1 :]))).answers
    values = [value for answer in answers if (value := measured(answer.pieces[index]).get(name)) is not None]
    if not values:
        return finding
    if name in ANGLE_FIELDS:
        nearest = min(values, key=lambda value: abs(remainder(value - typed, tau)))
        return reasons.angle_differs(run, index, name, typed, nearest)
    return reasons.length_differs(run, index, name, typed, min(values, key=lambda value: abs(value - typed)))


def _limit(run: Run, index: int) -> float | None:
    """Return the radius nearest to the typed one with which the run has an answer, None if no tried one has."""
    radius = run.elements[index].known["radius"]
    last_failed = {1: radius, -1: radius}
    for factor in TRIED_FACTORS:
        for sign in (1, -1):
            radius_tried = radius * factor**sign
            if _fits(run, index, radius_tried):
                limit = _bisected(run, index, last_failed[sign], radius_tried)
                # with the tolerance of an answer even the round number beside the limit fits
                rounded = round(limit, LIMIT_DECIMALS)
                return rounded if search(_with_radius(run, index, rounded)).answers else limit
            last_failed[sign] = radius_tried
    return None


def _bisected(run: Run, index: int, bad: float, good: float) -> float:
    for _ in range(HALVINGS):
        middle = (bad + good) / 2.0
        bad, good = (bad, middle) if _fits(run, index, middle) else (middle, good)
    return good


def _with_radius(run: Run, index: int, radius: float) -> Run:
    element = run.elements[index]
    typed = tuple((name, radius if name == "radius" else value) for name, value in element.typed)
    return replace(run, elements=(*run.elements[:index], replace(element, typed=typed), *run.elements[index + 1 :]))


def _fits(run: Run, index: int, radius: float) -> bool:
    # near the limit, count only answers that need no tolerance
    answers = search.__wrapped__(_with_radius(run, index, radius)).answers
    return any(answer.choice < 1 << GRAZE_SHIFT for answer in answers)
