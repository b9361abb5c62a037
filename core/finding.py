"""Findings: messages to the operator about a program, as values.

File readers and simulated controls raise errors of their own.

A finding's text is a sentence for the operator.  It has placeholders for lengths, `{value}`, `{x}`, `{y}` or
`{0}`, `{1}` ... (of `lengths`), and for an area, `{area}`; `core.units.sentence` fills them in program units.
`{0~1}` is length 0 with enough decimals to tell it from length 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """The severity of a finding: an error blocks posting, a warning is displayed, info explains."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True, slots=True)
class Finding:
    """One message and the place it belongs to.

    `code` is a stable word such as GOUGE, or a control's rule id.  `segment` is a programmed number k
    or k + 1/2 for the corner arc after it; `field` a field's name in `core.program.fields`.
    `last_segment` is where the finding ends if it runs over several segments in the contour's order.
    `at` (x, y) and `value` are millimeters, `lengths` further millimeters that the text uses.
    `line` and `column` count from 1 in an imported program.  `area` is in square millimeters.
    `block` counts from 1 if the findings of several blocks are listed together.
    `tool` is the number or name of the tool whose size a control lacks.
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
    last_segment: float | None = None
    tool: int | str | None = None
