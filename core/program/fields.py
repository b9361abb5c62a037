"""The fields of the screens: label, kind, range and prompt of everything that can be typed.

One table for the form, the reader of files, and the messages, so that a field has one name everywhere.
`name` is the attribute of the model and the key of the program file.
"""

from __future__ import annotations

from dataclasses import dataclass

from core.units import Kind


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `low` and `high` bound what may be typed (program units, inclusive), None is open."""

    name: str
    label: str
    kind: Kind
    prompt: str
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()
    above: float | None = None
    """A bound that itself is not allowed, such as 0 for a diameter."""
