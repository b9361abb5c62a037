"""Runs of programs in a shape that a person can compare with a calculation by hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from core.controls import registry
from core.controls.control_run import ControlRun
from core.controls.iso.iso_run import run_iso
from core.controls.makers import linuxcnc
from core.finding import Finding
from core.units import from_mm
from tests.tool_tables import end_mills

DATA = Path(__file__).parents[2] / "data"


def run_of(text: str | bytes, control: str, **diameters: float) -> ControlRun:
    """The run of a program with tools named t1, t2 ... of these diameters in program units."""
    table = end_mills({int(name[1:]): value for name, value in diameters.items()})
    program = text.encode() if isinstance(text, str) else text
    return registry.run(program, control, table)


def run_until_given_up(text: str, blocks: int, **diameters: float) -> ControlRun:
    """The run of a program on LinuxCNC, given up when this many blocks have been repeated."""
    table = end_mills({int(name[1:]): value for name, value in diameters.items()})
    dialect = replace(linuxcnc.DIALECT, max_repeated_blocks=blocks)
    return run_iso(text.encode(), "linuxcnc", dialect, table, linuxcnc.LinuxCnc)


def sample(name: str, control: str, **diameters: float) -> ControlRun:
    """The run of a sample program."""
    return run_of((DATA / "nc" / name).read_bytes(), control, **diameters)


def findings_of(run: ControlRun, code: str) -> list[Finding]:
    """The findings of one rule."""
    return [finding for finding in run.findings if finding.code == code]


def lines_and_ends(run: ControlRun, line: int | None = None) -> list[tuple[float, float]]:
    """The end points X, Y of the moves (of one line), in program units, to nine decimals."""
    return [
        (round(from_mm(move.point[0], run.unit), 9), round(from_mm(move.point[1], run.unit), 9))
        for move in run.moves
        if move.line and (line is None or move.line == line)
    ]


def shape(run: ControlRun, start: int = 1) -> list[tuple[object, ...]]:
    """Every move from a row on: its turn as letter, its end and an arc's center in X, Y, program units."""
    letters = {0: "line", 1: "ccw", -1: "cw"}
    out: list[tuple[object, ...]] = []
    for move in list(run.moves)[start:]:
        values = [*move.point[:2], *(move.center[:2] if move.turn else ())]
        name = "rapid" if move.rapid else letters[move.turn]
        out.append((name, *(from_mm(value, run.unit) for value in values)))
    return out


def same(shapes: Sequence[tuple[object, ...]], wanted: Sequence[tuple[object, ...]], within: float = 1e-6) -> bool:
    """Whether two shapes agree in kind, and in every number to a tolerance."""
    if len(shapes) != len(wanted):
        return False
    for one, other in zip(shapes, wanted, strict=True):
        if one[0] != other[0] or len(one) != len(other):
            return False
        if any(abs(float(str(a)) - float(str(b))) > within for a, b in zip(one[1:], other[1:], strict=True)):
            return False
    return True
