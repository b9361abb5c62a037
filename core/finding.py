"""Findings: how every stage reports trouble, as values and never as exceptions.

A finding's text is a sentence for the operator.  Lengths in it stand as `{value}`, `{x}`, `{y}` or
`{0}`, `{1}` ... (the rest of `lengths`), an area as `{area}`, filled in program units by `core.units.sentence`.
`{0~1}` is length 0 with as many decimals as tell it from length 1.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import count, repeat
from operator import attrgetter
from typing import Final


class Severity(StrEnum):
    """How much a finding weighs: an error blocks posting, a warning is shown, info explains."""

    # an enumeration's own is written in Python
    __hash__ = str.__hash__

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True, slots=True)
class Finding:
    """One piece of trouble and the place it belongs to.

    `code` is a stable word such as GOUGE, or a control's rule id.  `segment` is a programmed number k
    or k + 1/2 for the corner arc behind it; `field` a field's name in `core.program.fields`.
    `at` (x, y) and `value` are millimeters, `lengths` further millimeters named in the text.
    `line` and `column` count from 1 in a program somebody else wrote.  `area` is in square millimeters.
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


_FIELDS: Final = Finding.__match_args__
_values: Final = attrgetter(*_FIELDS)


_PUT: Final = tuple(Finding.__dict__[name].__set__ for name in ("code", "severity", "segment", "field"))
"""The slots' own setters."""


class Unworded(Finding):
    """A finding of which everything but what it is and where it belongs is made by `tell(row)` when it is first read.

    A hundred sentences that nobody reads take longer than a picture.  It equals the finding that `tell` makes.
    """

    __slots__ = ("row", "tell")

    row: int
    tell: Callable[[int], Finding]

    @staticmethod
    def each(
        code: str, severity: Severity, segments: Sequence[float], tell: Callable[[int], Finding]
    ) -> Sequence[Finding]:
        """A finding of each segment and of no field; `tell` makes the one of a row of `segments`."""
        made = [object.__new__(Unworded) for _ in segments]
        own = (Unworded.__dict__[name].__set__ for name in Unworded.__slots__)
        values: list[Iterable[object]] = [repeat(code), repeat(severity), segments, repeat(None), count(), repeat(tell)]
        for put, each in zip((*_PUT, *own), values, strict=True):
            # all of them in one go: nothing but the setter is called
            deque(map(put, made, each), 0)
        return made

    def __getattr__(self, name: str) -> object:
        """A value that is not made yet: all of them are."""
        if name not in _FIELDS:
            raise AttributeError(name, name=name, obj=self)
        try:
            values = _values(self.tell(self.row))
        except AttributeError as error:
            # whoever asks whether there is such an attribute would take it for a no
            message = f"{self.code} of segment {self.segment} cannot be put into words"
            raise RuntimeError(message) from error
        for field, value in zip(_FIELDS, values, strict=True):
            object.__setattr__(self, field, value)
        return getattr(self, name)

    def __eq__(self, other: object) -> bool:
        """By value; of another code it is another one before it is read."""
        if not isinstance(other, Finding):
            return NotImplemented
        return self.code == other.code and _values(self) == _values(other)

    __hash__ = Finding.__hash__
