"""What a block leaves blank or says in vain, where what comes of it is not what the operator may expect."""

from __future__ import annotations

from collections.abc import Iterator

from core.finding import Finding, Severity
from core.program.fields import Form, field
from core.program.model import Block, Entry, Program, Unread
from core.program.solved import SolvedBlock
from core.units import Kind, from_mm, show, to_mm


def unsaid_findings(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """A contour that is milled with PLUNGE FEED, and allowances that no finish tool takes: warnings."""
    yield from _plunge_fed(block, solved, program)
    yield from _not_left(block, program)


def _plunge_fed(block: Block, solved: SolvedBlock, program: Program) -> Iterator[Finding]:
    """The segments from the first on whose FEED is blank; not told before the first one is determined."""
    if not solved.determined or solved.plunge_feed is None:
        return
    count = len(block.segments)
    blank = next((index for index, one in enumerate(block.segments) if one.feed is not None), count)
    if not blank:
        return
    who = "the contour is" if blank == count else "it is" if blank == 1 else f"segments 1 to {blank} are"
    feed = show(from_mm(solved.plunge_feed, program.unit), Kind.FEED, program.unit)
    text = f"FEED is blank: {who} milled with PLUNGE FEED {feed}. Enter FEED."
    yield Finding("PLUNGE_FED", Severity.WARNING, text, 1, "feed")


def _not_left(block: Block, program: Program) -> Iterator[Finding]:
    """FINISH XY and FINISH Z while there is no finish tool."""
    tool = block.finish_tool
    if isinstance(tool, Unread) or (tool is not None and tool.value != 0.0):
        return
    for name in ("finish_xy", "finish_z"):
        typed = getattr(program.parameters, name)
        if not isinstance(typed, Entry) or typed.value <= 0.0:
            continue
        label = field(Form.PARAMETERS, name).label
        text = f"{label} {{value}} is not left: FINISH TOOL is 0. Enter FINISH TOOL on START, or 0 in {label} "
        value = to_mm(typed.value, program.unit)
        yield Finding("NOT_LEFT", Severity.WARNING, text + "on PROGRAM PARAMETERS.", 0, "finish_tool", value=value)
