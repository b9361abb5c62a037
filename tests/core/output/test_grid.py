from collections.abc import Iterable
from math import cos, hypot, pi, sin, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.piece import Arc, Line, Turn
from core.output.grid import ArcPart, Grid, arc_parts
from core.units import Unit

MM = Grid(Unit.MM)
IN = Grid(Unit.IN)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0.0"),
        (-0.0, "0.0"),
        (-0.000004, "0.0"),
        (0.000006, "0.00001"),
        (-0.000006, "-0.00001"),
        (2.0, "2.0"),
        (-12.5, "-12.5"),
        (1.234567, "1.23457"),
        (10000000.0, "10000000.0"),
    ],
)
def test_millimeters_have_five_decimals_at_most_and_one_at_least(value, text):
    assert MM.text(MM.steps(value)) == text


def test_inches_have_six():
    assert IN.text(IN.steps(25.4 / 3)) == "0.333333"
    assert IN.text(IN.steps(-2.54)) == "-0.1"


def chords(parts: Iterable[ArcPart]) -> list[bool]:
    """Of each part whether it is a chord."""
    return [part.center is None for part in parts]


def arc(radius: float, begin: float, sweep: float, center: tuple[float, float] = (0.0, 0.0)) -> Arc:
    def at(angle: float) -> tuple[float, float]:
        return center[0] + radius * cos(angle), center[1] + radius * sin(angle)

    return Arc(at(begin), at(begin + sweep), center, Turn.CCW if sweep > 0 else Turn.CW)


def test_an_ordinary_arc_is_one_arc_about_its_center():
    (part,) = arc_parts(arc(10.0, 0.0, pi / 2), MM)
    assert part.center == (-10000000, 0)


def test_a_full_circle_is_one_arc():
    circle = Arc((10.0, 0.0), (10.0, 0.0), (0.0, 0.0), Turn.CW)
    (part,) = arc_parts(circle, MM)
    assert part.end == (10.0, 0.0)


def test_an_arc_whose_ends_round_to_one_point_is_no_full_circle():
    """A hundredth of the last digit long: written as it is, a control would travel the whole circle."""
    parts = list(arc_parts(arc(10.0, 0.3, 1e-7), MM))
    assert chords(parts) == [True]


def test_nearly_a_full_circle_is_cut_in_two():
    parts = list(arc_parts(arc(10.0, 0.3, tau - 1e-7), MM))
    assert chords(parts) == [False, False]


def test_a_short_arc_that_rounding_turns_back_is_written_as_a_chord():
    """At its very top the start as written lies before the center as written, and the move straight down turns back."""
    top = 0.000005 + 1e-10
    center = (0.000003, top - 0.001)
    start, end = ((x, center[1] + (0.000001 - (x - center[0]) ** 2) ** 0.5) for x in (0.0000031, 0.0000049))
    short = Arc(start, end, center, Turn.CW)
    as_written = Arc((0.0, 0.00001), (0.0, 0.0), (0.000003, -0.000995), Turn.CW)
    assert MM.point(start) == (0, 1)
    assert MM.point(end) == (0, 0)
    assert short.sweep > -0.01
    assert as_written.sweep < -6.0
    assert chords(arc_parts(short, MM)) == [True]


def test_an_arc_of_hardly_any_angle_is_a_chord():
    """Ten last digits on a radius of 10 m: some controls take so small an angle for none, and none for a circle."""
    assert chords(arc_parts(arc(10_000.0, 0.3, 1e-7), MM)) == [True]


@pytest.mark.parametrize("grid", [IN, MM], ids=["in", "mm"])
@pytest.mark.parametrize("radius", [0.5, 10.0, 25.4, 5000.0])
@pytest.mark.parametrize("gap", [0.0005, 0.0015, 0.0025])
def test_no_arc_ends_within_a_closed_contours_tolerance_of_its_start(grid: Grid, radius: float, gap: float) -> None:
    """A control with fewer digits takes such an end for the start, and the arc for the full circle, or for none."""
    short = list(arc_parts(arc(radius, 0.3, gap / radius), grid))
    assert all(chords(short))
    long = list(arc_parts(arc(radius, 0.3, gap / radius - tau), grid))
    assert chords(long) == [False, False]


def test_a_speck_of_an_arc_is_chords():
    parts = list(arc_parts(arc(0.0005, 0.0, pi), MM))
    assert all(chords(parts))
    assert parts[-1].share == 1.0


radii = st.one_of(st.floats(1e-5, 1e-2), st.floats(0.01, 1.0), st.floats(1.0, 5000.0))
sweeps = st.one_of(
    st.floats(1e-8, 1e-3), st.floats(1e-3, tau - 1e-3), st.floats(1e-8, 1e-3).map(lambda short: tau - short)
)


@given(radius=radii, begin=st.floats(0, tau), size=sweeps, x=st.floats(-500, 500), y=st.floats(-500, 500))
@settings(derandomize=True, max_examples=400, deadline=None)
def test_what_is_written_is_as_long_as_what_was_meant_and_near_it(radius, begin, size, x, y):
    for unit, digit in ((Unit.MM, 1e-5), (Unit.IN, 25.4e-6)):
        for sweep in (size, -size):
            meant = arc(radius, begin, sweep, (x, y))
            length, worst, count = measured(meant, Grid(unit), digit)
            assert worst <= 5 * digit
            assert abs(length - meant.length) <= 6 * digit * count


def measured(meant: Arc, grid: Grid, digit: float) -> tuple[float, float, int]:
    """Length, largest distance from the true arc's circle, and number of the pieces as a control reads them."""
    place = (grid.steps(meant.start[0]) * digit, grid.steps(meant.start[1]) * digit)
    length, worst, count = 0.0, 0.0, 0
    for part in arc_parts(meant, grid):
        end = (grid.steps(part.end[0]) * digit, grid.steps(part.end[1]) * digit)
        piece: Arc | Line = Line(place, end)
        middle = ((place[0] + end[0]) / 2, (place[1] + end[1]) / 2)
        if part.center is not None:
            i, j = part.center[0] * digit / 10, part.center[1] * digit / 10
            piece = Arc(place, end, (place[0] + i, place[1] + j), meant.turn)
            worst = max(worst, abs(piece.radius - meant.radius))
            middle = end
        away = hypot(middle[0] - meant.center[0], middle[1] - meant.center[1])
        worst = max(worst, abs(away - meant.radius))
        length, place, count = length + piece.length, end, count + 1
    return length, worst, count
