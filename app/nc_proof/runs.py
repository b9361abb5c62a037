"""This module runs an NC text on a control and returns the result; workers call it."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from app.documents.nc_library import called_program
from app.documents.nc_text import NcText
from core.progress import Progress, part, silent
from core.units import Unit

if TYPE_CHECKING:
    from core.controls.control_run import ControlRun
    from core.controls.control_tools import ToolId, ToolTable
    from core.controls.judging.judged_contour import JudgedContour
    from core.draw.scene import Layer, Scene
    from core.pipeline.checking import Answer, CheckRequest
    from core.pipeline.nc_proof import Proof

RUN_SHARE: Final = 0.5
"""The share of the progress that the run takes; the verdicts take the rest."""
MAX_GUESS_LINES: Final = 200
"""Most lines that are read to guess a program's control and its first tool."""
_KLARTEXT: Final = re.compile(r"\s*(\d+\s+)?BEGIN\s+PGM\b", re.IGNORECASE)
_WRITTEN_FOR: Final = re.compile(r"^\(WRITTEN BY CUTCOMP FOR (\S+):", re.MULTILINE)
_HEADER_UNIT: Final = re.compile(r"^\(UNITS (INCH|MM)\)", re.MULTILINE)
_HEADER_TOOL: Final = re.compile(r"^\(TOOL (\d{1,4}) DIAMETER (\d*\.?\d+):", re.MULTILINE)
_HEADER_OFFSET: Final = re.compile(r"^\(OFFSET D(\d{1,4}) RADIUS (\d*\.?\d+)", re.MULTILINE)
_REMEMBERED: Final = re.compile(r'(?<!\S)(?:(\d{1,4})|"([^"]+)")=([-+.e\d]{1,25})(in|mm)(?!\S)')
_TOOL: Final = re.compile(
    r'(?<![A-Z])(?:TOOL\s+(?:DEF|CALL)\s+"([^"]+)"|(?:TOOL\s+(?:DEF|CALL)\s+|[TD]\s*)(\d{1,4})(?![\d.]))',
    re.IGNORECASE,
)


@dataclass(frozen=True, eq=False, slots=True)
class RunRequest:
    """A text to run on a control with these tools; equal only to itself."""

    text: NcText
    control: str
    tools: ToolTable
    unit: Unit | None = None
    folder: Path | None = None
    """The folder of the programs that the text calls by number."""


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """A control's run of a text as words, moves and a drawing; `judged` once it holds the verdicts.

    `dotted` is its path, if it is to be drawn under that of another control.
    """

    request: RunRequest
    answer: Answer
    proof: Proof
    scene: Scene
    judged: bool
    dotted: tuple[Layer, ...] = ()


def run(request: RunRequest, progress: Progress = silent) -> Result:
    """Run the program on its control, without the verdicts, which take longer than the run."""
    from core.controls import registry

    data, library = request.text.data, partial(called_program, request.folder)
    done = registry.run(data, request.control, request.tools, request.unit, library, progress=progress)
    return _result(request, done, ())


def judge(result: Result, progress: Progress = silent) -> Result:
    """Return the result with the verdicts added."""
    from core.controls.judging.judged_runs import judge_run

    return _result(result.request, result.proof.run, judge_run(result.proof.run, progress), judged=True)


def with_largest_tool(result: Result, progress: Progress = silent) -> Result:
    """Return the result; if the tool is too big, a finding names the largest tool that is clean."""
    from core.pipeline.checking import with_largest_tool as fitted

    request = result.request
    answer = fitted(
        result.answer, result.proof.run, request.text.data, _check_request(request, request.control), progress
    )
    return replace(result, answer=answer)


def run_dotted(main: Result, control: str, progress: Progress = silent) -> Result:
    """Run and judge the same text on another control; its path lies on the main result's plane."""
    from core.pipeline.nc_proof import dotted_path

    other = replace(main.request, control=control)
    result = judge(run(other, part(progress, 0.0, RUN_SHARE)), part(progress, RUN_SHARE, 1.0))
    return replace(result, dotted=dotted_path(result.proof, main.proof.plane))


def _result(
    request: RunRequest, done: ControlRun, results: tuple[JudgedContour, ...], *, judged: bool = False
) -> Result:
    from core.pipeline.checking import answered
    from core.pipeline.nc_proof import Proof, fixed_scene

    answer, proof = answered(done, results, request.text.data, request.tools), Proof(done, results)
    return Result(request, answer, proof, fixed_scene(proof), judged)


def compare(request: RunRequest, progress: Progress = silent) -> tuple[Answer, ...]:
    """Return every control's answer to the text."""
    from core.pipeline.checking import answer_all

    return answer_all(request.text.data, _check_request(request, "all"), request.control, progress)


def _check_request(request: RunRequest, control: str) -> CheckRequest:
    from core.pipeline.checking import CheckRequest

    return CheckRequest(
        control,
        request.tools,
        shop=False,
        unit=request.unit,
        library=partial(called_program, request.folder),
        names_options=False,
        # the list of all controls has no room for the largest tool
        fits=control != "all",
    )


def tools_text(tools: ToolTable) -> str:
    """Return tools and diameters as one line, `1=0.5in 2=12.0mm "ROUGH D10"=10.0mm`."""
    names = {each: f'"{each}"' if isinstance(each, str) else str(each) for each in tools}
    return " ".join(f"{names[each]}={tool.diameter!r}{tool.unit or ''}".lower() for each, tool in tools.items())


def read_tools(text: str) -> ToolTable:
    """Read the tools from such a line; skip anything that is not a tool."""
    # imported here: this loads the controls, which the first paint must not
    from core.controls.control_tools import CutterTool, table_of, tool_id

    tools = []
    for number, name, diameter, unit in _REMEMBERED.findall(text):
        with suppress(ValueError):
            tools.append(CutterTool(tool_id(number or name), float(diameter), unit=Unit(unit.upper())))
    return table_of(*tools)


def likely_control(text: NcText, usual: str) -> str:
    """Return the likely control of a text: the one in cutcomp's header, Klartext, else the caller's `usual` one.

    Return LinuxCNC, whose rules are checked, if `usual` is not a control or is one that reads only Klartext.
    """
    from core.controls.registry import is_klartext, resolve

    head = _head(text)
    if _KLARTEXT.match(head.lstrip()):
        return "klartext"
    written = _WRITTEN_FOR.search(head)
    if written and isinstance(known := resolve(written[1]), str):
        return known
    known = resolve(usual)
    return known if isinstance(known, str) and not is_klartext(known) else "linuxcnc"


def header_tools(text: NcText) -> ToolTable:
    """Return the tools and offsets that the header of a program posted by cutcomp tells the operator to enter."""
    from core.controls.control_tools import CutterTool, table_of

    head = _head(text)
    unit = _HEADER_UNIT.search(head)
    if unit is None or not _WRITTEN_FOR.search(head):
        return {}
    sizes = [(int(number), float(diameter)) for number, diameter in _HEADER_TOOL.findall(head)]
    # an offset has the number and the radius that the control uses, whatever the tool's number is
    sizes += [(int(number), 2.0 * float(radius)) for number, radius in _HEADER_OFFSET.findall(head)]
    units = Unit.IN if unit[1] == "INCH" else Unit.MM
    return table_of(*(CutterTool(number, diameter, unit=units) for number, diameter in dict(sizes).items()))


def _head(text: NcText) -> str:
    return "\n".join(text.text(row) for row in range(min(MAX_GUESS_LINES, len(text))))


def first_tool(text: NcText) -> ToolId:
    """Return the number or name of the first tool or offset outside comments, or 1 if there is none."""
    # imported here: this loads the controls, which the first paint must not
    from core.controls.control_tools import tool_id
    from core.controls.iso.reader import without_comments

    for row in range(min(MAX_GUESS_LINES, len(text))):
        match = _TOOL.search(without_comments(text.text(row).upper()))
        if match and (tool := tool_id(match[1] or match[2])):
            return tool
    return 1
