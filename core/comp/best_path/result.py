"""What the best path is handed on as."""

from __future__ import annotations

from dataclasses import dataclass

from core.finding import Finding
from core.geometry.path import Path


@dataclass(frozen=True, eq=False, slots=True)
class BestPath:
    """The loops of the best path in the contour's direction and the order of its segments; `closed` tells which are.

    A closed loop starts at the image of START if that is on it, else with the first segment of the contour it follows.
    An open contour has open chains too.  Pieces bear the programmed number k, corner arcs k + 1/2.
    Without loops, a finding says why.
    """

    loops: tuple[Path, ...]
    closed: tuple[bool, ...]
    findings: tuple[Finding, ...]
