"""Runs: what is asked of a control about an NC text, and the answer; worked out in a worker."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from textual.message import Message

from app.documents.nc_library import FolderLibrary
from app.documents.nc_text import NcText
from core.progress import Progress, part, silent
from core.units import Unit

if TYPE_CHECKING:
    from core.controls.control_tools import ToolId, ToolTable
    from core.draw.scene import Layer, Scene
    from core.finding import Finding
    from core.pipeline.checking import Answer, Asked
    from core.pipeline.nc_proof import Proof

RUN_SHARE: Final = 0.5
"""The part of the work that the run takes; the verdicts take the rest."""
MAX_GUESS_LINES: Final = 200
"""Lines that are looked at to guess which control a program is for."""
_KLARTEXT: Final = re.compile(r"\s*(\d+\s+)?BEGIN\s+PGM\b", re.IGNORECASE)
_REMEMBERED: Final = re.compile(r'(?<!\S)(?:(\d{1,4})|"([^"]+)")=([-+.e\d]{1,25})(in|mm)(?!\S)')
_TOOL: Final = re.compile(
    r'(?<![A-Z])(?:TOOL\s+(?:DEF|CALL)\s+"([^"]+)"|(?:TOOL\s+(?:DEF|CALL)\s+|[TD]\s*)(\d{1,4})(?![\d.]))',
    re.IGNORECASE,
)


@dataclass(frozen=True, eq=False, slots=True)
class Question:
    """A text on a control with these tools; equal only to itself."""

    text: NcText
    control: str
    tools: ToolTable
    unit: Unit | None = None
    folder: Path | None = None
    """Where programs that it calls by their numbers are looked for."""


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """A control's run of a text, in words, as moves and as a drawing; `judged` once the verdicts are in it."""

    question: Question
    answer: Answer
    proof: Proof
    scene: Scene
    judged: bool

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Everything found, by line."""
        return self.answer.findings


@dataclass
class Ran(Message):
    """A worker has run a text."""

    result: Result


@dataclass(eq=False)
class RanDotted(Message):
    """A worker has run and judged the text of a question on another control, whose path lies dotted under the first."""

    question: Question
    result: Result
    path: tuple[Layer, ...]


@dataclass
class Compared(Message):
    """A worker has run a text on every control."""

    answers: tuple[Answer, ...]


def run(question: Question, progress: Progress = silent) -> Result:
    """The program on its control without the verdicts, which take longer than the run."""
    from core.controls.registry import UnknownControl
    from core.pipeline.nc_proof import run_program

    library = FolderLibrary(question.folder)
    proof = run_program(question.text.data, question.control, question.tools, question.unit, library, progress)
    assert not isinstance(proof, UnknownControl), proof.text
    return _result(question, proof, judged=False)


def judge(result: Result, progress: Progress = silent) -> Result:
    """The same with the verdicts."""
    from core.pipeline.nc_proof import with_verdicts

    return _result(result.question, with_verdicts(result.proof, progress), judged=True)


def with_largest_tool(result: Result, progress: Progress = silent) -> Result:
    """The result with a finding that names the largest tool that is clean, where a smaller one is."""
    from core.pipeline.checking import with_largest_tool as fitted

    question = result.question
    answer = fitted(result.answer, result.proof.run, question.text.data, _asked(question, question.control), progress)
    return replace(result, answer=answer)


def run_dotted(own: Result, control: str, progress: Progress = silent) -> RanDotted:
    """The text of a result on another control, judged, with its path on the plane of that result."""
    from core.pipeline.nc_proof import dotted_path

    other = replace(own.question, control=control)
    result = judge(run(other, part(progress, 0.0, RUN_SHARE)), part(progress, RUN_SHARE, 1.0))
    return RanDotted(own.question, result, dotted_path(result.proof, own.proof.plane))


def _result(question: Question, proof: Proof, *, judged: bool) -> Result:
    from core.pipeline.checking import answered
    from core.pipeline.nc_proof import fixed_scene

    answer = answered(proof.run, proof.results, question.text.data)
    return Result(question, answer, proof, fixed_scene(proof), judged)


def compare(question: Question) -> tuple[Answer, ...]:
    """Every control's answer to a text."""
    from core.pipeline.checking import answer_all

    return answer_all(question.text.data, _asked(question, "all"), question.control)


def _asked(question: Question, control: str) -> Asked:
    from core.pipeline.checking import Asked

    library = FolderLibrary(question.folder)
    asked = Asked(control, question.tools, shop=False, unit=question.unit, library=library, names_options=False)
    # a list of controls has no room for it
    return replace(asked, fits=control != "all")


def tools_text(tools: ToolTable) -> str:
    """Tools and diameters in a line, `1=0.5in 2=12.0mm "ROUGH D10"=10.0mm`."""
    names = {each: f'"{each}"' if isinstance(each, str) else str(each) for each in tools.tools}
    return " ".join(f"{names[each]}={tool.diameter!r}{tool.unit or ''}".lower() for each, tool in tools.tools.items())


def read_tools(text: str) -> ToolTable:
    """The tools in such a line; what is no tool in it is passed over."""
    # this loads the controls, which the first paint does without
    from core.controls.control_tools import CutterTool, ToolTable, tool_id

    tools = []
    for number, name, diameter, unit in _REMEMBERED.findall(text):
        with suppress(ValueError):
            tools.append(CutterTool(tool_id(number or name), float(diameter), unit=Unit(unit.upper())))
    return ToolTable.of(*tools)


def likely_control(text: NcText, usual: str = "") -> str:
    """The control a text is most likely for: Klartext by its first words, else the usual one of whoever asks.

    Where there is none, or it reads Klartext alone, LinuxCNC, whose rules are checked.
    """
    from core.controls.registry import is_klartext, resolve

    rows = range(min(MAX_GUESS_LINES, len(text)))
    first = next((line for row in rows if (line := text.text(row)).strip()), "")
    if _KLARTEXT.match(first):
        return "klartext"
    known = resolve(usual)
    return known if isinstance(known, str) and not is_klartext(known) else "linuxcnc"


def first_tool(text: NcText) -> ToolId:
    """The number or name of the first tool or offset a text names outside its comments, 1 without any."""
    # this loads the controls, which the first paint does without
    from core.controls.control_tools import tool_id
    from core.controls.iso.reader import without_comments

    for row in range(min(MAX_GUESS_LINES, len(text))):
        found = _TOOL.search(without_comments(text.text(row).upper()))
        if found and (tool := tool_id(found[1] or found[2])):
            return tool
    return 1
