"""Every part of the judge against shapely's chords and buffers, which know nothing of walls and moves."""

from __future__ import annotations

from random import Random

import pytest
from shapely import Polygon, box
from shapely.geometry.base import BaseGeometry

from core.geometry.piece import Side
from tests.core.verify import oracle
from tests.core.verify.corpus import Case, corpus
from tests.core.verify.mutants import JUDGES, MUTATIONS

CLEAR = 1e-3
"""Millimeters of gouge or stock from which buffers can be trusted to show it."""


def material(case: Case) -> BaseGeometry | None:
    """What the cutter has to keep out of, where the contour bounds it."""
    inner = Polygon(oracle.chords(case.surface))
    if not (case.closed and inner.is_valid):
        return None
    cutter_is_inside = inner.exterior.is_ccw == (case.side is Side.LEFT)
    return box(-100.0, -100.0, 100.0, 100.0).difference(inner) if cutter_is_inside else inner


def test_the_judge_and_shapely_agree() -> None:
    random, gouging, leaving = Random(0), 0, 0
    for case in corpus(100, 3):
        kept_out = material(case)
        for mutation in MUTATIONS:
            path = mutation(random, case).path()
            line, walls = oracle.chords(path), oracle.chords(case.surface)
            entered = kept_out is not None and bool(
                line.buffer(case.radius - CLEAR, quad_segs=64).intersection(kept_out).area > CLEAR**2
            )
            left = walls.difference(line.buffer(case.radius + CLEAR, quad_segs=64)).length
            gouging, leaving = gouging + entered, leaving + (left > 0.0)
            closest = line.distance(walls)
            for judged in JUDGES.values():
                verdict = judged(case.surface, case.side, case.radius, path)
                assert verdict.clearance == pytest.approx(closest, abs=3.0 * oracle.CHORD)
                assert not (entered and verdict.clean)
                assert entered or kept_out is None or (verdict.depth < 2.0 * CLEAR and not verdict.wrong_side)
                assert verdict.uncut_length > left - CLEAR
    assert gouging >= 6
    assert leaving >= 11
