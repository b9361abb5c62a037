"""Runs a program: lines in order, subprograms and loops in their places, until its end or an alarm."""

from __future__ import annotations

from collections.abc import Callable

from core.controls.compensation.follower import Follower
from core.controls.control_run import AlarmError, Log, Run
from core.controls.control_tools import ToolTable
from core.controls.iso.dialect import Dialect
from core.controls.iso.flow import Flow
from core.controls.iso.machine import Machine
from core.controls.iso.words import Block, read_line
from core.controls.program_text import lines_of


def execute(
    text: bytes,
    name: str,
    dialect: Dialect,
    tools: ToolTable,
    log: Log,
    make: Callable[[Log], Follower],
) -> Run:
    """A program on a control, compensated by the follower that `make` gives."""
    follower = make(log)
    machine = Machine(dialect, follower, tools, log)
    stopped_at = None
    try:
        _run(Flow(lines_of(text), dialect, log), machine)
    except AlarmError as alarm:
        log.add(alarm.finding)
        stopped_at = alarm.line
    follower.close_span()
    unit = machine.moved_in or machine.unit
    return Run(name, unit, follower.tape.moves(), log.closed(), stopped_at, tuple(follower.stretches))


def _run(flow: Flow, machine: Machine) -> None:
    """Runs lines until the program ends."""
    lines, dialect, log, values = flow.lines, flow.dialect, flow.log, flow.values
    if values is not None:
        values.machine = machine
    while flow.at < len(lines):
        line = flow.at = flow.at + 1
        text = lines[line - 1]
        flow.next_line(line)
        if flow.owords is not None and flow.follow(line - 1):
            continue
        for block in read_line(text, line, log, dialect.syntax, values):
            machine.step(block)
            if block.moves_only:
                continue
            if machine.ended or (_calls(block) and not flow.after(block)):
                machine.follower.close()
                return
        if dialect.percent_ends and text.strip() == "%":
            flow.percents += 1
            if flow.percents > 1:
                break
    flow.ended()
    machine.follower.close()


def _calls(block: Block) -> bool:
    return bool(block.m) or "O" in block.words
