"""A square written for a control, and what the control does with it."""

from __future__ import annotations

from itertools import pairwise

from core.comp.compensate import compensate
from core.comp.compensated import Compensated
from core.controls.control_run import ControlRun
from core.controls.registry import names, run
from core.controls.write.contour_pass import CompensatedPass, PassToWrite
from core.controls.write.iso_program import tools_of
from core.controls.write.iso_style import STYLE_OF_CONTROL
from core.controls.write.written_program import Posted, Refusal, write_program
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Line as Straight
from core.geometry.piece import Point, Side
from core.units import Unit

INCH = 25.4
EVERY = names()


def outline(*points: Point) -> Path:
    """Lines through points, in inches."""
    scaled = [(x * INCH, y * INCH) for x, y in points]
    return Path.from_pieces([Straight(a, b) for a, b in pairwise(scaled)])


SQUARE = outline((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))


def squared(side: Side, blend: float = 0.125, overlap: float = 0.0) -> Compensated:
    """The square from mid-side, for a half-inch cutter."""
    return compensate(SQUARE, side, 0.25 * INCH, 4, closed=True, blend=blend * INCH, overlap=overlap * INCH)


def cut(one: Compensated, *, tool: int = 1, stock: float = 0.0, depth: float = -0.25) -> CompensatedPass:
    """One run at a depth (inches), 10 inches a minute."""
    feeds = {int(number): 10.0 * INCH for number in one.contour.numbers}
    size = 2 * (one.radius - stock * INCH)
    up, near = 1.0 * INCH, 0.1 * INCH
    return CompensatedPass(
        compensated=one, tool=tool, diameter=size, stock=stock * INCH, speed=300.0, feeds=feeds,
        plunge_feed=20.0 * INCH, travel=up, near=near, depth=depth * INCH, leave=up,
    )  # fmt: skip


def write(control: str, *cuts: PassToWrite, remarks: tuple[str, ...] = ()) -> Posted | Refusal:
    """The program in inches."""
    return write_program(cuts, control, Unit.IN, "PART", lambda _: remarks)


def text_of(control: str, *cuts: PassToWrite) -> str:
    found = write(control, *cuts)
    assert isinstance(found, Posted), found
    return found.text


def run_written(control: str, text: str, *cuts: PassToWrite) -> ControlRun:
    """What the control does with a program and the tools it counts on."""
    tools = (
        tools_of(cuts, STYLE_OF_CONTROL[control])
        if control in STYLE_OF_CONTROL
        else tools_of(cuts, STYLE_OF_CONTROL["linuxcnc"])
    )
    made = run(text.encode(), control, tools, Unit.IN)
    assert isinstance(made, ControlRun)
    return made


def refused(control: str, *cuts: CompensatedPass) -> Finding:
    found = write(control, *cuts)
    assert isinstance(found, Refusal), found
    return found.findings[0]
