"""Tool tables for tests of the controls."""

from __future__ import annotations

from collections.abc import Mapping

from core.controls.control_tools import CutterTool, ToolTable, table_of
from core.units import Unit


def end_mills(diameters: Mapping[int, float], unit: Unit | None = None) -> ToolTable:
    """A table of end mills of these diameters, by number."""
    return table_of(*(CutterTool(number, diameter, unit=unit) for number, diameter in diameters.items()))
