"""Programs for the pipeline's tests: golden contours as an operator types them, inch, tool 0.5 across."""

from __future__ import annotations

from dataclasses import replace

from core.program.edit import new_block
from core.program.model import Block, CutterComp, LineSegment, Number, Program, ProgramParameters, Tool, Typed, changed

OVER_RUN_SQUARE = ((-1, 0), (2, 0), (2, 2), (0, 2), (0, -1))
NOTCH = ((0, 0), (2, 0), (2, -0.3), (2.3, -0.3), (2.3, 0), (5, 0))
OUTSIDE_SQUARE = ((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))
MID_SIDE_SQUARE = ((1, 0), (2, 0), (2, 2), (0, 2), (0, 0), (1, 0))

Points = tuple[tuple[float, float], ...]


def block(points: Points, comp: CutterComp, **changes: Typed) -> Block:
    """A block of lines through these points."""
    segments = tuple(LineSegment(x_end=Number(x), y_end=Number(y)) for x, y in points[1:])
    (x, y), tool, bottom = points[0], Number(1), Number(-0.25)
    plain = replace(new_block(Program()), tool=tool, x_start=Number(x), y_start=Number(y), z_bottom=bottom)
    plain = replace(plain, plunge_feed=Number(20.0), speed=Number(300.0))
    return changed(replace(plain, cutter_comp=comp, segments=segments), changes)


def program(*blocks: Block, parameters: ProgramParameters | None = None) -> Program:
    """A program of these blocks with tools 1 (0.5) and 2 (0.25), and no blend moves unless parameters say so."""
    tools = (Tool(1, diameter=Number(0.5)), Tool(2, diameter=Number(0.25)))
    plain = ProgramParameters(blend_offset=Number(0), blend_overlap=Number(0))
    return Program(tools=tools, blocks=blocks, parameters=parameters or plain)
