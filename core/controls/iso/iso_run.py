"""This module runs a word-address program on a control, row by row, up to its end or an alarm."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from core.controls.control_run import AlarmError, ControlRun, Log, Spot
from core.controls.control_tools import ToolTable
from core.controls.iso.dialect import CodeAction, Dialect, unit_of_code
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.flow import Flow, MakeControl, OWordFlow, ProgramLibrary, no_library
from core.controls.iso.machine import Machine
from core.controls.iso.macro_b_flow import MacroFlow
from core.controls.iso.macro_b_machine import MacroMachine
from core.controls.iso.reader import without_comments
from core.controls.moves import Moves
from core.controls.program_text import BYTE_ORDER_MARKS, capitals, lines_of
from core.progress import Progress, silent
from core.units import Unit

LINES_BETWEEN: Final = 200
"""Lines between two reports of progress."""


_CR_ALONE: Final = re.compile(rb"\r(?!\n)")
_G_WORD: Final = re.compile(r"(?<![A-Z_<])G[ \t]*0*(\d{1,4})(?!\d|\.0*[1-9])")


def run_iso(
    text: bytes,
    name: str,
    dialect: Dialect,
    tools: ToolTable,
    make: MakeControl,
    library: ProgramLibrary = no_library,
    progress: Progress = silent,
) -> ControlRun:
    """Run a program's text on a control: `make` makes the control, `name` is its full name in the result.

    No text raises anything but Stopped.
    """
    log = Log(rule_names=dialect.rule_names)
    control = make(log)
    lines = lines_of(text)
    if dialect.parameters is ParameterStore.FANUC:
        machine: Machine = (with_macros := MacroMachine(dialect, control, tools))
        flow: Flow = MacroFlow(lines, with_macros, library)
    else:
        machine = Machine(dialect, control, tools)
        flow = (OWordFlow if dialect.parameters is ParameterStore.NGC else Flow)(lines, machine, library)
    stopped_at = None
    try:
        if dialect.syntax.strict and text.startswith(BYTE_ORDER_MARKS):
            fault = "The file begins with a byte order mark, which this control does not read. Save it as plain ASCII."
            log.stop("WORD", fault, Spot(1))
        if dialect.syntax.strict and (cr_alone := _CR_ALONE.search(text)):
            fault = "This line ends with CR alone, which this control does not take for its end. Save the file with LF."
            log.stop("WORD", fault, Spot(text.count(b"\n", 0, cr_alone.start()) + 1))
        _run(flow, machine, progress)
    except AlarmError as alarm:
        log.add(alarm.finding)
        stopped_at = alarm.line
    control.close_stretch()
    flow.finish(alarmed=stopped_at is not None)
    unit = machine.first_unit or machine.unit
    if stopped_at is not None and machine.first_unit is None and not machine.unit_said:
        unit = _first_unit_said(lines, dialect) or unit
    run = ControlRun(
        name,
        unit,
        control.tape.moves(),
        log.all_findings(),
        stopped_at,
        tuple(control.stretches),
        frozenset(control.tape.unplaced),
        tuple(machine.spindle),
        tuple(machine.setups),
        dict(flow.variables.common) if isinstance(flow, MacroFlow) else {},
    )
    return _by_main_lines(run, flow)


def _first_unit_said(lines: Sequence[str], dialect: Dialect) -> Unit | None:
    """Return the unit that a program would have had if it had not stopped before; None if it names none."""
    for line in lines:
        for word in _G_WORD.finditer(without_comments(capitals(line))):
            code = dialect.codes.get(10 * int(word[1]))
            if code is not None and code.action is CodeAction.UNITS:
                return unit_of_code(code.value)
    return None


def _run(flow: Flow, machine: Machine, progress: Progress) -> None:
    run_lines = 0
    while flow.at < len(flow.lines):
        line = flow.at = flow.at + 1
        run_lines += 1
        if run_lines % LINES_BETWEEN == 0:
            progress(line / len(flow.lines))
        flow.count_repeat(line)
        for block in flow.blocks(line):
            machine.step(block)
            if machine.ended or not flow.follow_call(block):
                machine.control.end(flow.at)
                return
        if flow.ends_here(line):
            break
    flow.end_of_file()
    machine.control.end(flow.at)


def _by_main_lines(run: ControlRun, flow: Flow) -> ControlRun:
    """Return the run with each line of a called file replaced by the line that calls it."""
    if not flow.called_from:
        return run
    findings = []
    for finding in run.findings:
        line, place = flow.origin_of(finding.line or 0)
        text = f"{place}: {finding.text}" if place else finding.text
        findings.append(replace(finding, text=text, line=line or None, column=1 if place else finding.column))

    def moved(moves: Moves) -> Moves:
        return replace(moves, lines=np.array([flow.origin_of(line)[0] for line in moves.lines.tolist()], np.int32))

    return replace(
        run,
        findings=tuple(findings),
        moves=moved(run.moves),
        stretches=tuple(replace(stretch, programmed=moved(stretch.programmed)) for stretch in run.stretches),
        stopped_at=None if run.stopped_at is None else flow.origin_of(run.stopped_at)[0],
    )
