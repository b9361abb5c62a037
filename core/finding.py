"""Findings: messages to the operator about a program, as values.

File readers and simulated controls raise errors of their own.

A finding's text is a sentence for the operator.  It has placeholders for lengths, `{value}`, `{x}`, `{y}` or
`{0}`, `{1}` ... (of `lengths`), and for an area, `{area}`; `core.units.sentence` fills them in program units.
`{0~1}` is length 0 with enough decimals to tell it from length 1; `{0-}` is a largest length, rounded down so that it
still fits when it is typed, `{0+}` a smallest one, rounded up.
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
    """One message and the place it belongs to; all lengths are in millimeters."""

    code: str
    """A stable word such as GOUGE, or a control's rule id."""
    severity: Severity
    text: str
    """The sentence, in which {value}, {0}, {1} ... stand for `value` and `lengths`."""
    segment: float | None = None
    """A programmed number k, or k + 1/2 for the corner arc after it."""
    field: str | None = None
    """A field's name in `core.program.fields`."""
    at: tuple[float, float] | None = None
    value: float | None = None
    lengths: tuple[float, ...] = ()
    """Lengths that the text uses besides `value`."""
    line: int | None = None
    column: int | None = None
    """Line and column count from 1 in an imported program."""
    area: float | None = None
    """Square millimeters."""
    block: int | None = None
    """Counts from 1 if the findings of several blocks are listed together."""
    last_segment: float | None = None
    """Where the finding ends if it runs over several segments in the contour's order."""
    tool: int | str | None = None
    """The number or name of the tool whose size a control lacks."""
