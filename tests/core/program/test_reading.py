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
from core.program.solve.reading import carry, fill, fill_angle, read
from core.program.solve.solved import Solved, Value
from core.units import Kind, Unit
from tests.core.program.parts import line


def test_lengths_feeds_and_angles_are_converted_and_counts_are_not():
    reading = read(Form.LINE, line(x_end=2.0, angle=180.0, feed=10.0), Unit.IN, 1)
    assert reading.known == {"x_end": 50.8, "angle": pi, "feed": 254.0}
    assert reading.findings == ()
    assert reading.values["x_end"] == Entry(2.0)
    assert reading.values["y_end"] is None


def test_faults_are_told_and_not_known():
    segment = LineSegment(x_end=Unread("1,5", "Type a point."), length=Entry(-2.0), y_end=Entry(float("inf")))
    reading = read(Form.LINE, segment, Unit.MM, 7)
    assert reading.known == {}
    assert [(one.code, one.segment, one.field) for one in reading.findings] == [
        ("UNREADABLE", 7, "x_end"),
        ("OUT_OF_RANGE", 7, "y_end"),
        ("OUT_OF_RANGE", 7, "length"),
    ]
    assert reading.values["x_end"] == Unread("1,5", "Type a point.")


@pytest.mark.parametrize("there", [Entry(1.0), Unread("x", "why")])
def test_only_blanks_are_filled(there):
    values: dict[str, Value] = {"x_end": there, "y_end": None, "angle": None, "feed": None}
    fill(values, {"x_end": 25.4, "y_end": 50.8}, Unit.IN)
    fill_angle(values, "angle", pi)
    carry(values, "feed", 254.0, Unit.IN)
    assert values == {"x_end": there, "y_end": Solved(2.0), "angle": Solved(180.0), "feed": Solved(10.0)}
    carry(values, "feed", 508.0, Unit.IN)
    fill_angle(values, "angle", 0.0)
    assert (values["feed"], values["angle"]) == (Solved(10.0), Solved(180.0))


def test_nothing_is_carried_from_nothing():
    values: dict[str, Value] = {"feed": None}
    carry(values, "feed", None, Unit.IN)
    assert values == {"feed": None}


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
            reading = read(form, changed(PARTS[form], {one.name: Entry(value)}), unit, 1)
            taken = check(one, value, unit) is None
            assert (one.name in reading.known) is taken
            assert len(reading.findings) == (not taken)


def _about(edge: float) -> tuple[float, float, float]:
    return nextafter(edge, -inf), edge, nextafter(edge, inf)
