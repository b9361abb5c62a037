"""What is told where compensation is asked for with radius 0: the cutter's center runs along the part's contour."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from core.finding import Finding, Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


RADIUS_ZERO: Final = frozenset(("RADIUS0", "B3-DIA0"))
"""Rules that tell of compensation that is asked for and moves nothing."""


def nothing_compensated(
    machine: Machine, why: str, line: int, column: int, *, code: str = "RADIUS0", severity: Severity = Severity.WARNING
) -> None:
    """Tell that nothing is compensated and how deep the tool cuts; `why` says what to do, or what is missing."""
    cut, lengths = _depth(machine)
    text = f"Nothing is compensated: {cut} into the part along the contour. {why}"
    machine.log.add(Finding(code, severity, text, lengths=lengths, line=line, column=column))


def _depth(machine: Machine) -> tuple[str, tuple[float, ...]]:
    """The loaded tool, or the only one there is, with its diameter {0} and radius {1} in millimeters if known."""
    known = machine.tools.tools
    number = machine.tool or (next(iter(known)) if len(known) == 1 else 0)
    tool = known.get(number)
    if tool is None or tool.diameter == 0.0:
        return "any cutter cuts by its radius", ()
    across = abs(tool.diameter_mm(machine.unit))
    return f"tool {number} of diameter {{0}} cuts {{1}}", (across, across / 2)
