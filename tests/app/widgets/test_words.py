"""Numbers in words."""

from __future__ import annotations

import pytest

from app.painted.widgets.words import length, number, numbers, pair, place, segment, shortened
from core.units import Unit


@pytest.mark.parametrize(
    ("segments", "text"),
    [((), ""), ((2.0,), "2"), ((2.0, 3.0, 4.0, 7.0), "2-4 7"), ((3.0, 2.5, 2.0), "2-3"), ((2.5,), "")],
)
def test_runs_of_segments_are_joined_and_corner_arcs_left_out(segments: tuple[float, ...], text: str) -> None:
    assert numbers(segments) == text


def test_lengths_come_in_program_units() -> None:
    assert length(12.7, Unit.IN) == "0.5000"
    assert length(12.7, Unit.MM) == "12.700"
    assert place((25.4, -12.7), Unit.IN) == "X 1.0000 Y -0.5000"
    assert number(3.5) == "corner 3-4"


def test_a_corner_stands_between_two_segments() -> None:
    assert segment(3.0) == "segment 3"
    assert segment(3.5) == "corner 3-4"
    assert pair(3.0, 5.0) == "3 and 5"
    assert pair(3.0, 5.5) == "3 and corner 5-6"
    assert pair(3.5, 5.5) == "corners 3-4 and 5-6"


def test_what_does_not_fit_is_left_out_by_whole_words() -> None:
    text = "gouges by 0.1500 at line 12, before"
    assert shortened(text, len(text)) == text
    assert shortened(text, 31) == "gouges by 0.1500 at line 12 …"
    assert shortened(text, 15) == "gouges by …"
    for width in range(1, len(text)):
        short = shortened(text, width)
        assert len(short) <= width
        assert short.endswith("…")
        assert set(short.removesuffix("…").split()) <= {word.rstrip(",") for word in text.split()}
