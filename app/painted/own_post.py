"""Whether a control's own program can be posted, worked out behind POST NC before anybody asks for it."""

from __future__ import annotations

from dataclasses import dataclass

from core.finding import Finding
from core.program.model import Program


@dataclass(frozen=True, eq=False, slots=True)
class OwnPost:
    """A program for a control, by the control's full name."""

    program: Program
    control: str

    @property
    def small(self) -> bool:
        """Never fast: the text is run through the control's rules."""
        return False

    def answer(self) -> OwnPosted:
        """What posting would meet; needs the numeric library, and may take long: for a thread."""
        from app.cli.posting import nc_text
        from core.output.nc import Refusal
        from core.pipeline.derive import derive

        # no rule asks for the file's name
        result = nc_text(derive(self.program), "part", None, self.control)
        if isinstance(result, Refusal):
            return OwnPosted(self, against=result.findings)
        return OwnPosted(self, notes=result.notes)


@dataclass(frozen=True, eq=False, slots=True)
class OwnPosted:
    """What forbids posting; where nothing does, what is to be said with the text."""

    asked: OwnPost
    against: tuple[Finding, ...] = ()
    notes: tuple[Finding, ...] = ()
