"""The Klartext control runs a program block by block, with its labels, repeats, Q parameters and conditions."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import isclose
from typing import Final

from core.controls.control_run import NOT_RUN_TEXT, AlarmError, ControlRun, Log, Spot
from core.controls.control_tools import ToolTable
from core.controls.klartext import cycles, leads, m_functions, path_functions, setup_blocks
from core.controls.klartext.center_path import CenterPathRecorder
from core.controls.klartext.corner_rounding import CornerBuffer
from core.controls.klartext.reader import Block, read_blocks
from core.controls.klartext.state import State
from core.controls.program_text import lines_of, quoted
from core.progress import Progress, silent

MAX_REPEATED_BLOCKS: Final = 50_000
"""Most blocks that jumps and repeats may run again before the run is given up."""

BLOCKS_BETWEEN: Final = 200
"""Blocks between two reports of progress."""

MAX_CALL_DEPTH: Final = 19
"""Most calls of subprograms within one another."""

_NAME: Final = r'(?:0+(?=\d))?("[^"]*"|\d+)'
"""A label's name or number; 02 is 2."""
_LABEL: Final = re.compile(rf"\s*{_NAME}\s*$", re.ASCII)
_CALL: Final = re.compile(rf"\s*LBL\s*{_NAME}\s*(?:REP\s*(\d{{1,5}})(?:/\d+)?)?\s*$", re.ASCII)
_SET: Final = re.compile(r"\s*(\d+)\s*=(.*)$", re.ASCII)
_FUNCTION: Final = re.compile(r"\s*(\d+)\s*:\s*(.*)$", re.ASCII)
_ASSIGNMENT: Final = re.compile(r"(Q[LR]?\d+)\s*=(.*)$", re.ASCII)
_WITH_VALUES: Final = re.compile(r"\s*DEF\s*(?:2[0-57-9]|39|[2-9]\d\d)(?!\d)", re.ASCII)
"""The cycles whose definition goes on in further lines, one Q parameter a line."""
_COMPARISON: Final = re.compile(r"EQU|NE(?!G)|GT|LT", re.ASCII)
_GOAL: Final = re.compile(rf"\s*LBL\s*{_NAME}\s*$", re.ASCII)
_READ: Final = re.compile(r"Q[LR]?\d+", re.ASCII)
_PASSED_OVER: Final = frozenset((15, 16, 18, 20, 26, 27))
"""Functions that print, read data of the control, wait, or write tables."""

_FORMULA_OF_FN: Final = {5: "SQRT", 6: "SIN", 7: "COS"}


def run_klartext(text: bytes, tools: ToolTable, share: float = 1.0, progress: Progress = silent) -> ControlRun:
    """Run a Klartext program with these tools, at a share of each tool's radius; no text makes it raise.

    Tools of the table take precedence over TOOL DEF of the same number.
    """
    log = Log()
    center = CenterPathRecorder(log, share)
    blocks = tuple(read_blocks(lines_of(text)))
    state = State(log, CornerBuffer(center), tools, blocks, _labels(blocks), share)
    stopped_at = None
    try:
        _run_blocks(state, progress)
        state.waiting.flush()
        center.finish()
    except AlarmError as alarm:
        log.add(alarm.finding)
        stopped_at = alarm.finding.line
        center.close()  # what is recorded so far stays
    return ControlRun(
        "klartext",
        state.unit,
        center.tape.moves(),
        log.all_findings(),
        stopped_at,
        tuple(center.stretches),
        frozenset(center.tape.unplaced),
        tuple(state.spindle),
    )


def _run_blocks(state: State, progress: Progress) -> None:
    left = len(state.blocks) + MAX_REPEATED_BLOCKS
    while state.next < len(state.blocks) and not state.ended:
        block = state.blocks[state.next]
        state.next += 1
        left -= 1
        if left % BLOCKS_BETWEEN == 0:
            progress(state.next / len(state.blocks))
        if left < 0:
            text = f"More than {MAX_REPEATED_BLOCKS} repeated blocks: the run ends here, not judged. Repeat fewer."
            state.log.stop("LIMIT", text, block)
        if block.skip:
            state.log.inform("SKIP", "Block skip is assumed off, so this block runs.", block)
        if block.more and not (block.head == "CYCL" and _WITH_VALUES.match(block.body)):
            text = "cutcomp reads a ~, which continues a block, only in CYCL DEF with Q parameters. Write one line."
            state.log.stop("BEYOND", text, block)
        BLOCK_FUNCTIONS.get(block.head, setup_blocks.unknown)(state, block)
        if state.cycle_due:
            state.cycle_due = False
            cycles.call(state, block)
    _check_end(state)


def _check_end(state: State) -> None:
    """Warn of what is missing at the end of the program, or follows it."""
    last = state.blocks[-1] if state.blocks else Block(1, "", "", 1, skip=False)
    if not state.begun:
        text = "BEGIN PGM is missing; millimeters are assumed. Write BEGIN PGM PART MM as the first block."
        state.log.warn("PROGRAM", text, Spot(1))
    elif not any(block.head == "END" for block in reversed(state.blocks)):
        state.log.warn("PROGRAM", "END PGM is missing; the file may be cut off.", last)
    end = next((index for index, block in enumerate(state.blocks) if block.head == "END"), len(state.blocks))
    not_run = next((block for block in state.blocks[end + 1 :] if block.head.isalpha()), None)
    if not_run is not None:
        state.log.warn("NOT_RUN", NOT_RUN_TEXT, not_run)
    if state.applied and state.side:
        text = "The program ends under compensation. Cancel it with an L block with R0, or with DEP."
        state.log.warn("PROGRAM", text, last)


def _labels(blocks: Sequence[Block]) -> Mapping[str, int]:
    """Return for each label the index of the block after its first LBL; LBL 0 ends a subprogram and is no label."""
    labels: dict[str, int] = {}
    for index, block in enumerate(blocks):
        if block.head == "LBL" and (name := _LABEL.match(block.body)) and name[1] != "0":
            labels.setdefault(name[1], index + 1)
    return labels


def _label(state: State, block: Block) -> None:
    """LBL n marks where to jump to; LBL 0 ends a subprogram."""
    name = _LABEL.match(block.body)
    if name is None:
        state.log.stop("LABEL", "LBL needs a number or a name in quotes.", block)
    if name[1] == "0" and state.calls:
        state.next = state.calls.pop()[1]


def _call(state: State, block: Block) -> None:
    """CALL LBL n runs a subprogram; with REP m it runs the part from LBL n to here m more times."""
    call = _CALL.match(block.body)
    if call is None:
        setup_blocks.unknown(state, block)
    elif call[2]:
        left = state.repeats.pop(state.next, int(call[2]))
        if left > 0:
            state.repeats[state.next] = left - 1
            _jump(state, block, call[1])
    else:
        if len(state.calls) >= MAX_CALL_DEPTH or any(name == call[1] for name, _ in state.calls):
            text = f"LBL {quoted(call[1])} calls itself, or more than {MAX_CALL_DEPTH} calls are nested. Write LBL 0."
            state.log.stop("LABEL", text, block)
        state.calls.append((call[1], state.next))
        _jump(state, block, call[1])


def _jump(state: State, block: Block, name: str) -> None:
    if name not in state.labels:
        state.log.stop("LABEL", f"There is no LBL {quoted(name)} in this program.", block)
    state.next = state.labels[name]


def _parameter(state: State, block: Block) -> None:
    """Q1 = formula sets a Q parameter."""
    assignment = _SET.match(block.body)
    if assignment is None:
        state.log.stop("Q", "A Q parameter needs = and a formula.", block)
    state.parameters[f"{block.head}{assignment[1]}"] = state.value(assignment[2], block)


def _function(state: State, block: Block) -> None:
    """FN 0 to FN 13: assignments, and jumps on a condition; functions that move nothing are skipped."""
    function = _FUNCTION.match(block.body)
    number = int(function[1][:4]) if function else -1
    rest = function[2] if function else ""
    if 9 <= number <= 12:
        _condition(state, block._replace(body=rest))
    elif 0 <= number <= 13 and (assignment := _ASSIGNMENT.match(rest)):
        name, formula = assignment.groups()
        operator = _FORMULA_OF_FN.get(number, "")
        state.parameters[name] = state.value(formula if operator in formula else f"{operator} {formula}", block)
    elif number in _PASSED_OVER:
        _pass_over(state, block, number, rest)
    else:
        setup_blocks.unknown(state, block)


def _pass_over(state: State, block: Block, number: int, rest: str) -> None:
    """Skip a function that moves nothing; what it reads has no value here, and stops the run when it is used."""
    names = _READ.findall(rest.partition("=")[0])
    for name in names:
        state.parameters.pop(name, None)
    text = f"FN {number} is skipped; it moves nothing."
    if names:
        text = f"FN {number} is skipped: only the control knows what it reads. {quoted(names[0])} has no value here."
    state.log.inform("IGNORED", text, block)


def _condition(state: State, block: Block) -> None:
    """IF a EQU, NE, GT or LT b GOTO LBL n: jump if the condition holds."""
    question, _, goal = block.body.strip().removeprefix("IF").partition("GOTO")
    sign, label = _COMPARISON.search(question), _GOAL.match(goal)
    if sign is None or label is None:
        setup_blocks.unknown(state, block)
    first = state.value(question[: sign.start()], block)
    second = state.value(question[sign.end() :], block)
    equal = isclose(first, second, rel_tol=0.0, abs_tol=1e-9)
    holds = {"EQU": equal, "NE": not equal, "GT": first > second and not equal, "LT": first < second and not equal}
    if holds[sign[0]]:
        _jump(state, block, label[1])


BLOCK_FUNCTIONS: Final[Mapping[str, Callable[[State, Block], None]]] = {
    "L": path_functions.line,
    "LP": path_functions.line,
    "CC": path_functions.pole,
    "RND": path_functions.corner,
    "CHF": path_functions.corner,
    "C": path_functions.circle,
    "CR": path_functions.radius_arc,
    "CT": path_functions.tangent_arc,
    "CP": path_functions.polar_circle,
    "CTP": path_functions.tangent_arc,
    "APPR": leads.approach,
    "DEP": leads.depart,
    "BEGIN": setup_blocks.begin,
    "END": setup_blocks.end,
    "BLK": partial(setup_blocks.skip, text="BLK FORM moves nothing and is skipped."),
    "TOOL": setup_blocks.tool,
    "CYCL": cycles.cycle,
    "TRANS": setup_blocks.transformation,
    "PLANE": setup_blocks.plane,
    "*": setup_blocks.structure,
    "(": setup_blocks.bracketed,
    "FUNCTION": setup_blocks.function,
    "DECLARE": partial(setup_blocks.skip, text="Text parameters move nothing and are skipped."),
    "QS": partial(setup_blocks.skip, text="Text parameters move nothing and are skipped."),
    "STOP": m_functions.only_functions,
    "M": m_functions.only_functions,
    "LBL": _label,
    "CALL": _call,
    "FN": _function,
    "IF": _condition,
    "Q": _parameter,
    "QL": _parameter,
    "QR": _parameter,
}
"""The function that runs a block, by its head word."""
