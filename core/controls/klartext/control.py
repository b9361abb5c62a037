"""The Klartext control: runs a program's text block by block and gives its moves and findings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from core.controls.control_run import AlarmError, Log, Run
from core.controls.control_tools import ToolTable
from core.controls.klartext import circles, flow, functions, leading, motion, setup
from core.controls.klartext.blocks import Block, blocks
from core.controls.klartext.center import Center
from core.controls.klartext.record import Record
from core.controls.klartext.state import State
from core.controls.program_text import lines_of
from core.finding import Severity

JUMPED: Final = 50_000
"""Blocks that jumps and repeats may run again before the run is given up."""

HEADS: Final[Mapping[str, Callable[[State, Block], None]]] = MappingProxyType(
    {
        "L": motion.straight,
        "LP": motion.polar_straight,
        "CC": motion.center,
        "RND": motion.corner,
        "CHF": motion.corner,
        "C": circles.circle,
        "CR": circles.radius_arc,
        "CT": circles.tangent_arc,
        "CP": circles.polar_circle,
        "CTP": circles.polar_tangent,
        "APPR": leading.approach,
        "DEP": leading.leave,
        "BEGIN": setup.begin,
        "END": setup.end,
        "BLK": setup.ignored,
        "TOOL": setup.tool,
        "CYCL": setup.cycle,
        "TRANS": setup.transformation,
        "PLANE": setup.plane,
        "*": setup.structure,
        "STOP": functions.only_functions,
        "M": functions.only_functions,
        "LBL": flow.label,
        "CALL": flow.call,
        "FN": flow.function,
        "IF": flow.condition,
        "Q": flow.parameter,
        "QL": flow.parameter,
        "QR": flow.parameter,
    }
)


THIN: Final = 1e-7
"""Share of the tool's radius with which no contour is too narrow."""


def run(text: bytes, variant: str, tools: ToolTable) -> Run:  # noqa: ARG001  (the one variant is the empty one)
    """A program in Klartext with these tools; never raises for any text.

    Tools of the table count before TOOL DEF of the same number.
    """
    return _ran(text, tools, 1.0)


def programmed(text: bytes, tools: ToolTable) -> Run:
    """The same with a tool of next to no radius: its stretches tell the contour where the tool itself does not fit."""
    return _ran(text, tools, THIN)


def _ran(text: bytes, tools: ToolTable, share: float) -> Run:
    log = Log()
    center = Center(log, Record(share=share))
    read = tuple(blocks(lines_of(text)))
    state = State(log, center, tools, read, flow.labels_of(read), share=share)
    stopped = None
    try:
        _run(state)
        state.flush()
        center.finish()
    except AlarmError as alarm:
        log.add(alarm.finding)
        stopped = alarm.finding.line
        center.give_up()
    record = center.record
    return Run("klartext", state.unit, record.tape.moves(), log.closed(), stopped, tuple(record.stretches))


def _run(state: State) -> None:
    program = state.blocks
    limit = len(program) + JUMPED
    while state.next < len(program) and not state.ended:
        block = program[state.next]
        state.next += 1
        limit -= 1
        if limit < 0:
            text = f"More than {JUMPED} blocks are repeated. The run is given up here and not judged"
            state.stop("LIMIT", f"{text}: repeat them less often.", block)
        if block.skip:
            state.tell(Severity.INFO, "SKIP", "The block is run: block skip is taken as switched off.", block)
        HEADS.get(block.head, setup.unknown)(state, block)
    _close(state)


def _close(state: State) -> None:
    """Say what is missing at the end of the program."""
    last = state.blocks[-1] if state.blocks else Block(1, "", "", 1, skip=False)
    if not state.begun:
        text = "The program has no BEGIN PGM; millimeters are assumed. Write BEGIN PGM PART MM as its first block."
        state.log.tell(Severity.WARNING, "PROGRAM", text, 1, 1)
    elif not any(block.head == "END" for block in reversed(state.blocks)):
        state.tell(Severity.WARNING, "PROGRAM", "END PGM is missing; the file may be cut off.", last)
    if state.applied:
        text = "The program ends under compensation; cancel it with an L block with R0, or with DEP."
        state.tell(Severity.WARNING, "PROGRAM", text, last)
