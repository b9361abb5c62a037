"""Is an ARC that ends beside its start the full circle?  And what is said of it.

A contour that comes within 0.0001 in (0.00254 mm) of its START is closed, and an arc's two radii may differ as much: so
an arc whose end is typed as near to its start, about a typed center, ends where it starts and is the full circle.  The
start may be calculated and have more digits than a screen shows; whoever types the end as it reads there means the
start, and an arc of a few millionths is never meant.  SWEEP ANGLE makes an arc as short as it says.

Where the center has to be found from such an end, the rounding of the end would decide where it lies: it must be typed.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot, tau
from typing import Final

from core.finding import Finding, Severity
from core.geometry.piece import Arc, Point
from core.program.fields import Form, field
from core.program.solve.line import degrees
from core.tolerance import CLOSED, JOINED
from core.units import Kind, Unit, from_mm, show

_ENDS: Final = ("x_end", "y_end")
_CENTERS: Final = ("x_center", "y_center")

DOUBTFUL: Final = 10.0 * CLOSED
"""An arc whose end is no farther from its start than this may be a full circle that was typed with too few digits."""


def comes_back(start: Point, end: Point) -> bool:
    """Whether an end is so near to the start, in X and in Y, that it is the start."""
    return max(abs(end[0] - start[0]), abs(end[1] - start[1])) <= CLOSED


def center_needed(start: Point, known: Mapping[str, float]) -> tuple[tuple[str, ...], str] | None:
    """What is missing of the center of an arc that ends at its start, and the advice; None for another end."""
    typed = tuple(known.get(name, start[axis]) for axis, name in enumerate(_ENDS))
    blank = tuple(name for name in _CENTERS if name not in known)
    if not blank or not any(name in known for name in _ENDS) or not comes_back(start, (typed[0], typed[1])):
        return None
    text = f"the end is at the start. For the full circle enter {_labels(blank)}; for a shorter arc the center and "
    return blank, f"{text}SWEEP ANGLE, with X END and Y END blank."


def circle_finding(arc: Arc, known: Mapping[str, float], unit: Unit) -> Finding | None:
    """What is said of an arc that ends at its start or beside it; None where it is typed as it is."""
    if arc.start == arc.end:
        return _full(arc.start, known, unit)
    gap = hypot(arc.end[0] - arc.start[0], arc.end[1] - arc.start[1])
    if gap > (CLOSED if "sweep" in known else DOUBTFUL) or arc.length <= JOINED:
        return None
    text = f"The arc ends only {{value~0}} from its start and turns {degrees(abs(arc.sweep))} degrees. "
    text += "Enter SWEEP ANGLE 360 if the full circle is meant."
    return Finding("SHORT_ARC", Severity.WARNING, text, field="sweep", value=gap, lengths=(0.0,))


def _full(start: Point, known: Mapping[str, float], unit: Unit) -> Finding | None:
    """That the numbers typed make the full circle though they are not exactly those of one."""
    if "sweep" in known:
        if known["sweep"] == tau:
            return None
        text = f"SWEEP ANGLE {degrees(known['sweep'])} ends at the arc's start: it is the full circle. Enter 360."
        return Finding("FULL_CIRCLE", Severity.WARNING, text, field="sweep")
    typed = [(name, known[name], start[axis]) for axis, name in enumerate(_ENDS) if name in known]
    if all(abs(value - own) <= JOINED for _, value, own in typed):
        return None
    names = tuple(name for name, _, _ in typed)
    said, one = _labels(names), len(names) == 1
    if all(_reads(value, unit) == _reads(own, unit) for _, value, own in typed):
        weight, how = Severity.INFO, f"{said} read{'s' if one else ''} like the arc's start"
    else:
        weight, how = Severity.WARNING, f"{said} {'is' if one else 'are'} within {{0}} of the arc's start"
    text = (
        f"{how}: it is the full circle, and ends where it starts. For a shorter arc blank {said} and enter SWEEP ANGLE."
    )
    return Finding("FULL_CIRCLE", weight, text, field=names[0], lengths=(CLOSED,))


def _reads(value: float, unit: Unit) -> str:
    return show(from_mm(value, unit), Kind.LENGTH, unit)


def _labels(names: tuple[str, ...]) -> str:
    return " and ".join(field(Form.ARC, name).label for name in names)
