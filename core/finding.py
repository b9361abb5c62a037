"""Findings: what the operator is told about a program, as values.

Readers of files and runs of controls raise errors of their own.

A finding's text is a sentence for the operator.  Lengths in it stand as `{value}`, `{x}`, `{y}` or
`{0}`, `{1}` ... (the rest of `lengths`), an area as `{area}`, filled in program units by `core.units.sentence`.
`{0~1}` is length 0 with as many decimals as tell it from length 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How much a finding weighs: an error blocks posting, a warning is shown, info explains."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True, slots=True)
class Finding:
    """One piece of trouble and the place it belongs to.

    `code` is a stable word such as GOUGE, or a control's rule id.  `segment` is a programmed number k
    or k + 1/2 for the corner arc after it; `field` a field's name in `core.program.fields`.
    `at` (x, y) and `value` are millimeters, `lengths` further millimeters named in the text.
    `line` and `column` count from 1 in a program somebody else wrote.  `area` is in square millimeters.
    `block` counts from 1 where the findings of several blocks are told together.
    """

    code: str
    severity: Severity
    text: str
    segment: float | None = None
    field: str | None = None
    at: tuple[float, float] | None = None
    value: float | None = None
    lengths: tuple[float, ...] = ()
    line: int | None = None
    column: int | None = None
    area: float | None = None
    block: int | None = None
