"""A block as another look-ahead would make it, worked out behind FINDINGS for whoever asks on the look-ahead table."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from core.program.edit import FormPlace, Refused, type_field
from core.program.model import Number, Program

if TYPE_CHECKING:
    from app.painted.session import Session
    from core.pipeline.derived import DerivedBlock

SMALL: Final = 200
"""Segments up to which the answer may be fast enough to be waited for."""
TYPED: Final = "USR_LOOKAHEAD"
"""What is said of a typed value: nobody has typed this one."""


@dataclass(frozen=True, eq=False, slots=True)
class AtValue:
    """Block `number` of `session`'s program as it is at look-ahead `value`: `program` has it typed."""

    session: Session
    program: Program
    number: int
    value: int

    @staticmethod
    def of(session: Session, value: int | None) -> AtValue | None:
        """The question; None for the value in force, and where no field takes one."""
        if value is None or value == session.found.lookahead.value:
            return None
        number = session.where.block
        program = type_field(session.program, FormPlace(number), "lookahead", Number(float(value)))
        return None if isinstance(program, Refused) else AtValue(session, program, number, value)

    @property
    def small(self) -> bool:
        """Whether the answer may be fast."""
        return len(self.session.block.segments) <= SMALL

    def answer(self) -> FoundAt:
        """The block; needs the numeric library, and may take long: for a thread."""
        from core.pipeline.derive import derive

        found = derive(self.program).block(self.number)
        return FoundAt(self, replace(found, findings=tuple(one for one in found.findings if one.code != TYPED)))


@dataclass(frozen=True, eq=False, slots=True)
class FoundAt:
    """The answer."""

    asked: AtValue
    found: DerivedBlock
