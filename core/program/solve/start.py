"""START of a block: its point, depths, feeds and tools, with what is missing or wrong."""

from __future__ import annotations

from dataclasses import dataclass
from operator import attrgetter
from typing import Final

from core.finding import Finding, Severity
from core.geometry.piece import Point
from core.program.fields import Form, field
from core.program.model import Block, CutterComp, Program
from core.program.solve.reading import Reading, read
from core.program.solve.solved import Solved, Value
from core.program.tools import Called, called

NEEDED = ("tool", "x_start", "y_start", "z_start", "z_bottom", "plunge_feed", "speed")
"""The fields of START that must be typed."""

ZERO = ("finish_tool", "peck_depth")
"""The fields of START whose blank means 0: no finish tool, full depth in one pass."""


@dataclass(frozen=True, slots=True)
class Start:
    """START in millimeters, with its values as the form shows them."""

    values: dict[str, Value]
    point: Point | None
    known: dict[str, float]
    tool: Called
    finish: Called
    findings: tuple[Finding, ...]


_typed: Final = attrgetter(*(name for name in Block.__match_args__ if name != "segments"))


def made_of(block: Block, program: Program) -> tuple[object, ...]:
    """All that START of a block depends on."""
    return *_typed(block), program.tools, program.unit, not block.segments


def solve_start(block: Block, program: Program) -> Start:
    """START of a block as typed."""
    reading = read(Form.START, block, program.unit, 0)
    weight = Severity.WARNING if block.cutter_comp is CutterComp.ON else Severity.ERROR
    tool = called(program, block.tool, "tool", weight)
    finish = called(program, block.finish_tool, "finish_tool", weight)
    for name in ZERO:
        if reading.values[name] is None:
            reading.values[name] = Solved(0.0)
    known = reading.known
    point = (known["x_start"], known["y_start"]) if "x_start" in known and "y_start" in known else None
    # what was typed and is wrong comes before what is still to be typed: few of them are seen at once
    trouble = (*tool.findings, *finish.findings, *_depths(known), *_missing(reading), *_empty(block))
    return Start(reading.values, point, known, tool, finish, reading.findings + trouble)


def _missing(reading: Reading) -> tuple[Finding, ...]:
    blanks = (name for name in NEEDED if reading.values[name] is None)
    return tuple(
        Finding("MISSING", Severity.ERROR, f"{field(Form.START, name).label} is blank: enter it on START.", 0, name)
        for name in blanks
    )


def _depths(known: dict[str, float]) -> tuple[Finding, ...]:
    top, bottom = known.get("z_start"), known.get("z_bottom")
    if top is None or bottom is None or bottom < top:
        return ()
    if bottom > top:
        text = "Z BOTTOM {0} is above Z START {1}: it must be below."
        return (Finding("Z_ORDER", Severity.ERROR, text, 0, "z_bottom", lengths=(bottom, top)),)
    text = "Z BOTTOM is at Z START: nothing is cut."
    return (Finding("Z_ORDER", Severity.WARNING, text, 0, "z_bottom"),)


def _empty(block: Block) -> tuple[Finding, ...]:
    if block.segments:
        return ()
    text = "The contour has no segment yet: right arrow or Page Down on SEGMENT adds a LINE or an ARC."
    return (Finding("NO_SEGMENTS", Severity.ERROR, text, 0),)
