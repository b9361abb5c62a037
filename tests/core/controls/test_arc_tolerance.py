"""Arcs whose radii differ at start and end: the limit of each control, and its alarm beyond that."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import pytest

from core.controls.iso.arcs import center_by_radius
from core.controls.registry import arc_tolerance
from core.finding import Finding, Severity
from core.units import Unit
from tests.core.controls.hand import findings_of, run_of
from tests.core.controls.rs274 import witness
from tests.rs274 import WITNESS

CONTROLS = ("threeblock", "rosettacnc", "nine-series", "linuxcnc")
CASES = [(unit, radius) for unit in Unit for radius in (1.0, 40.0, 3000.0)]
SCALE = {Unit.MM: 1.0, Unit.IN: 25.4}


def quarter(unit: Unit, radius: float, difference: float) -> str:
    """A quarter about the origin, from `radius` out to `difference` more, in program units."""
    code = "G71" if unit is Unit.MM else "G70"
    start, end = f"X{radius:.7f} Y0.", f"X0. Y{radius + difference:.7f}"
    return f"{code} G17 G90 F10.\nG0 X0. Y0.\nG1 {start}\nG3 {end} I{{i}} J0.\nM2\n".replace("{i}", f"{-radius:.7f}")


def program(control: str, unit: Unit, radius: float, difference: float) -> str:
    text = quarter(unit, radius, difference)
    if control == "threeblock":
        return text.replace(f"I{-radius:.7f}", "I0.")
    return text.replace("G70", "G20").replace("G71", "G21")


@pytest.mark.parametrize(("unit", "radius"), CASES)
@pytest.mark.parametrize("control", CONTROLS)
def test_radii_may_differ_up_to_the_limit_of_the_control(control: str, unit: Unit, radius: float) -> None:
    limit = arc_tolerance(control).largest_difference(radius * SCALE[unit], unit) / SCALE[unit]
    within, beyond = (run_of(program(control, unit, radius, share * limit), control) for share in (0.99, 1.01))
    assert within.stopped_at is None
    assert not findings_of(within, "ARC")
    (alarm,) = findings_of(beyond, "ARC")
    assert (alarm.severity, alarm.line, beyond.stopped_at) == (Severity.ERROR, 4, 4)
    assert alarm.lengths == pytest.approx((radius * SCALE[unit], (radius + 1.01 * limit) * SCALE[unit]), abs=1e-5)
    assert ("cutcomp assumes" in alarm.text) is (control != "linuxcnc")


@pytest.mark.parametrize(
    ("control", "start", "center", "hint"),
    [
        ("fanuc:a", "X10. Y0.", "I10. J10.", "If I and J are meant from the program's zero, write I0. J10."),
        ("fanuc:a", "X10.000001 Y0.", "I10. J10.", "If I and J are meant from the program's zero, write I0. J10."),
        ("linuxcnc", "X10. Y1.", "I10. J11.", "If I and J are meant from the program's zero, write I0. J10."),
        ("threeblock", "X10. Y0.", "I0. J10.", "If I and J are meant from the arc's start, write I10. J10."),
        ("threeblock", "X10. Y1.5", "I0. J10.", "If I and J are meant from the arc's start, write I10. J11.5"),
        ("threeblock", "X10. Y1.", "J10.", "If I and J are meant from the arc's start, write I10. J11."),
    ],
)
def test_the_alarm_suggests_the_center_that_is_right_in_the_other_mode(
    control: str, start: str, center: str, hint: str
) -> None:
    assert quarter_turn(control, start, center).text.endswith(f" {hint}")


@pytest.mark.parametrize(("control", "center"), [("fanuc:a", "I12. J10."), ("threeblock", "I1. J10.")])
def test_the_alarm_suggests_nothing_if_the_center_is_wrong_in_both_modes(control: str, center: str) -> None:
    assert "meant" not in quarter_turn(control, "X10. Y1.", center).text


@pytest.mark.parametrize("control", ["fanuc:a", "linuxcnc", "threeblock"])
def test_the_alarm_of_a_full_circle_suggests_no_other_center(control: str) -> None:
    metric = "G71" if control == "threeblock" else "G21"
    run = run_of(
        f"{metric} G17 G90 F100.\nG1 X10. Y5.\nG3 X10. Y5. {'I10. J5.' if control == 'threeblock' else 'I0. J0.'}\n",
        control,
    )
    assert run.stopped_at == 3
    assert "meant" not in run.findings[-1].text


def quarter_turn(control: str, start: str, center: str) -> Finding:
    """The alarm of a quarter circle from `start` to ten more in X and Y, with this center."""
    metric, (x, y) = "G71" if control == "threeblock" else "G21", (float(word[1:]) + 10 for word in start.split())
    run = run_of(f"{metric} G17 G90 F100.\nG1 {start}\nG3 X{x} Y{y} {center}\nM2\n", control)
    assert run.stopped_at == 3
    return run.findings[-1]


@pytest.mark.skipif(WITNESS is None, reason="LinuxCNC's rs274 is not installed")
@pytest.mark.parametrize(("unit", "radius"), CASES)
@pytest.mark.parametrize("share", [0.99, 1.01])
def test_the_limit_of_linuxcnc_is_that_of_the_interpreter(
    unit: Unit, radius: float, share: float, tmp_path: Path
) -> None:
    limit = arc_tolerance("linuxcnc").largest_difference(radius * SCALE[unit], unit) / SCALE[unit]
    text = program("linuxcnc", unit, radius, share * limit)
    assert bool(witness(text, tmp_path, {1: 0.5}, unit).refusal) is (share > 1.0)


def test_the_limit_of_linuxcnc_depends_on_unit_and_radius() -> None:
    limit = arc_tolerance("linuxcnc")
    assert limit.largest_difference(1.0, Unit.MM) == pytest.approx(0.01 * 2 * sqrt(2))
    assert limit.largest_difference(1.0, Unit.IN) == pytest.approx(0.001 * 2 * sqrt(2) * 25.4)
    assert limit.largest_difference(100.0, Unit.MM) == pytest.approx(0.1)


def test_klartext_accepts_sixteen_thousandths_at_any_radius() -> None:
    limit = arc_tolerance("klartext")
    assert [limit.largest_difference(radius, unit) for radius in (1.0, 1e4) for unit in Unit] == pytest.approx(
        [0.016] * 4
    )


@pytest.mark.parametrize("control", ["threeblock", "rosettacnc", "nine-series"])
def test_undocumented_limits_grow_with_the_radius_to_a_maximum(
    control: str,
) -> None:
    limit = arc_tolerance(control)
    for unit in Unit:
        allowed = [limit.largest_difference(radius, unit) for radius in (1.0, 50.0, 100.0, 3000.0)]
        assert allowed == pytest.approx([0.0127, 0.05, 0.0762, 0.0762])


@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
@pytest.mark.parametrize("turn", [1, -1])
def test_a_positive_radius_gives_the_short_arc_and_a_negative_one_the_long_arc(size: float, turn: int) -> None:
    start, end = (0.0, 0.0), (1.6 * size, 0.0)
    assert center_by_radius(start, end, size, turn) == pytest.approx((0.8 * size, 0.6 * size * turn))
    assert center_by_radius(start, end, -size, turn) == pytest.approx((0.8 * size, -0.6 * size * turn))
