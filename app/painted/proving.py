"""What the proof screens have calculated: questions on a program text, and their answers.

Imported with the screens, so nothing here needs the numeric library before a question is answered.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from app.documents.nc_text import NcText

if TYPE_CHECKING:
    from core.controls.control_tools import ToolTable
    from core.draw.scene import Scene
    from core.finding import Finding
    from core.pipeline.checking import Answer
    from core.pipeline.nc_proof import Proof
    from core.units import Unit

SMALL: Final = 2000
"""Lines up to which an answer may be fast enough to be waited for."""
BEGINNING: Final = 200
"""Lines that are looked at to guess which control a program is for."""
_KLARTEXT: Final = re.compile(r"\s*(\d+\s+)?BEGIN\s+PGM\b", re.IGNORECASE)
_TOOL: Final = re.compile(r"(?:TOOL\s+(?:DEF|CALL)\s+|[TD]\s*)(\d{1,4})(?![\d.])", re.IGNORECASE)


@dataclass(frozen=True, eq=False, slots=True)
class Question:
    """A text on a control with these tools; `every` control is asked for where that is None.  Equal only to itself."""

    listing: NcText
    control: str | None
    tools: ToolTable
    unit: Unit | None = None

    @property
    def small(self) -> bool:
        """Whether the answer may be fast."""
        return len(self.listing) <= SMALL and self.control is not None

    def of(self, listing: NcText) -> Question:
        """The same asked of another text."""
        return replace(self, listing=listing)

    def answer(self) -> Told:
        """The answer; may take long, for a thread."""
        from core.controls.registry import UnknownControl
        from core.pipeline.checking import Asked, answer_all
        from core.pipeline.nc_proof import run_program

        data = self.listing.data
        if self.control is None:
            return Told(self, rows=answer_all(data, Asked("all", self.tools, shop=False, unit=self.unit)))
        proof = run_program(data, self.control, self.tools, self.unit)
        assert not isinstance(proof, UnknownControl), proof.text
        rest = Rest(self, proof)
        return rest.answer() if self.small else _told(self, proof, rest)


@dataclass(frozen=True, eq=False, slots=True)
class Rest:
    """The verdict on a long program, which takes longer than running it."""

    question: Question
    proof: Proof

    @property
    def small(self) -> bool:
        """Never fast."""
        return False

    def answer(self) -> Told:
        """The whole answer."""
        from core.pipeline.nc_proof import with_verdicts

        return _told(self.question, with_verdicts(self.proof), None)


def _told(question: Question, proof: Proof, rest: Rest | None) -> Told:
    from core.pipeline.checking import answered
    from core.pipeline.nc_proof import fixed_scene

    return Told(question, answered(proof.run, proof.results, question.listing.data), proof, fixed_scene(proof), rest)


@dataclass(frozen=True, eq=False, slots=True)
class Told:
    """An answer: in words, as moves, as a drawing; or a row for each control.

    `rest` is what is still to be worked out: the verdict of a long program.
    """

    question: Question
    answer: Answer | None = None
    proof: Proof | None = None
    ground: Scene | None = None
    rest: Rest | None = None
    rows: tuple[Answer, ...] = ()

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Everything found, by line."""
        return self.answer.findings if self.answer is not None else ()


def guess(listing: NcText) -> str:
    """The control a text is most likely for: Klartext by its first words, else LinuxCNC, whose rules are checked."""
    first = next((text for row in range(min(BEGINNING, len(listing))) if (text := listing.text(row)).strip()), "")
    return "klartext" if _KLARTEXT.match(first) else "linuxcnc"


def tool_in(listing: NcText) -> int:
    """The number of the first tool or offset a text names, 1 without any."""
    for row in range(min(BEGINNING, len(listing))):
        found = _TOOL.search(listing.text(row))
        if found and int(found[1]):
            return int(found[1])
    return 1
