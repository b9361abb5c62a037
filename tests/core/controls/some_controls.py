"""Controls for tests that need not run on every variant."""

from __future__ import annotations

from core.controls.registry import CONTROLS, resolve

FIRST_VARIANTS = tuple(str(resolve(name)) for name in CONTROLS)
"""The first variant of each control; the others differ from it only in how they compensate."""

ENTRY_VARIANTS = (
    *FIRST_VARIANTS,
    "rosettacnc:easy",
    "rosettacnc:normal",
    "nine-series:b",
    "fanuc:b",
    "fanuc:c",
    "haas:b",
)
"""A variant for each way in and out of compensation; the others differ from these only at corners."""
