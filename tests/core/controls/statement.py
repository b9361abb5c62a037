"""One statement of a maker: a small program, and what it must do by hand calculation.

Paths are in the notation of `hand.shape`; `path` None leaves them to the rules.  `rules` are the rules told, with the
line; a rule with a minus sign must not be told.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class Row(NamedTuple):
    """One statement: the control, the program, the diameters of its tools, and what must come."""

    statement: str
    control: str
    text: str
    tools: Mapping[str, float]
    path: tuple[tuple[object, ...], ...] | None = None
    rules: tuple[tuple[str, int], ...] = ()
    stops: int | None = None
