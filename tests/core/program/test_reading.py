"""Typed fields as millimeters and radians."""

from __future__ import annotations

from math import inf, nan, nextafter, pi
from typing import Any

import pytest

from core.program.fields import TABLES, Form, bounds, check
from core.program.model import (
    ArcSegment,
    BlendSegment,
    Block,
    Entry,
    LineSegment,
    Parameters,
    PartSetup,
    Unread,
    changed,
)
from core.program.solve.reading import read_form
from core.program.solve.solved import Solved
from core.units import Kind, Unit
from tests.core.program.parts import line


def test_lengths_feeds_and_angles_are_converted_and_counts_are_not():
    reading = read_form(Form.LINE, line(x_end=2.0, angle=180.0, feed=10.0), Unit.IN, 1)
    assert reading.known == {"x_end": 50.8, "angle": pi, "feed": 254.0}
    assert reading.findings == ()
    assert reading.values["x_end"] == Entry(2.0)
    assert reading.values["y_end"] is None


def test_faults_are_told_and_not_known():
    segment = LineSegment(x_end=Unread("1,5", "Type a point."), length=Entry(-2.0), y_end=Entry(float("inf")))
    reading = read_form(Form.LINE, segment, Unit.MM, 7)
    assert reading.known == {}
    assert [(one.code, one.segment, one.field) for one in reading.findings] == [
        ("UNREADABLE", 7, "x_end"),
        ("OUT_OF_RANGE", 7, "y_end"),
        ("OUT_OF_RANGE", 7, "length"),
    ]
    assert reading.values["x_end"] == Unread("1,5", "Type a point.")


@pytest.mark.parametrize("typed", [Entry(1.0), Unread("x", "why")])
def test_only_blanks_are_filled(typed):
    reading = read_form(Form.LINE, LineSegment(x_end=typed), Unit.IN, 1)
    reading.fill({"x_end": 3.0, "y_end": 2.0, "feed": None})
    assert reading.values["x_end"] == typed
    assert (reading.values["y_end"], reading.values["feed"]) == (Solved(2.0), None)
    reading.fill({"y_end": 4.0})
    assert reading.values["y_end"] == Solved(2.0)


PARTS: dict[Form, Any] = {
    Form.START: Block(),
    Form.LINE: LineSegment(),
    Form.ARC: ArcSegment(),
    Form.BLEND: BlendSegment(),
    Form.PARAMETERS: Parameters(),
    Form.SETUP: PartSetup(),
}


@pytest.mark.parametrize("unit", Unit)
@pytest.mark.parametrize("form", PARTS)
def test_a_number_is_known_exactly_where_its_field_takes_it(form: Form, unit: Unit):
    numbers = [one for one in TABLES[form] if one.kind not in (Kind.CHOICE, Kind.TEXT)]
    assert numbers
    for one in numbers:
        edges = {
            0.0,
            1.0,
            2.5,
            -3.0,
            54.0,
            1e300,
            *(edge for edge in (*bounds(one, unit), one.above) if edge is not None),
        }
        for value in (nan, inf, -inf, *(near for edge in edges for near in _about(edge))):
            reading = read_form(form, changed(PARTS[form], {one.name: Entry(value)}), unit, 1)
            taken = check(one, value, unit) is None
            assert (one.name in reading.known) is taken
            assert len(reading.findings) == (not taken)


def _about(edge: float) -> tuple[float, float, float]:
    return nextafter(edge, -inf), edge, nextafter(edge, inf)
