"""A contour of an NC program, and the block made from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import dist
from typing import Any, Final, NamedTuple

from core.controls.control_tools import ToolId
from core.geometry.piece import Piece, Side
from core.importing.contour import Contour, ContourKind
from core.importing.segments import ImportedBlock, block_of
from core.program.edit import set_tool
from core.program.model import ArcSegment, Block, CutterComp, LineSegment, Number, Program, Tool
from core.tolerance import CLOSED
from core.units import Unit, from_mm

SAME_HEIGHT: Final = 1e-4
"""Largest difference of two heights of one depth, in millimeters."""


class NcError(Exception):
    """An NC program gives no contour; the text says why, with the line.

    `needs_center`: the operator must give the side and the diameter; `tool`: the diameter of that tool.
    """

    def __init__(self, text: str, *, needs_center: bool = False, tool: ToolId | None = None) -> None:
        super().__init__(text)
        self.needs_center = needs_center
        self.tool = tool


@dataclass(frozen=True, slots=True)
class CenterPathTool:
    """The operator's tool for a program of the tool center: its side, None for ON, and its diameter.

    The diameter is in the program's unit.
    """

    side: Side | None
    diameter: float


class Cut(NamedTuple):
    """A piece with its feed (mm/min), its height at the end, and its line."""

    piece: Piece
    feed: float
    z: float
    line: int


@dataclass(frozen=True, eq=False, slots=True)
class NcContour:
    """A contour of a program.

    `radius` is that of the last pass in millimeters, None if the tool center runs on the contour; `depths` are those of
    its passes, in order.  `tool` and `speed` are the last ones named before it.
    """

    cuts: tuple[Cut, ...]
    side: Side | None
    radius: float | None
    depths: tuple[float, ...]
    tool: int | None
    speed: float | None
    plunge_feed: float | None = None
    lookahead: int | None = None
    """The look-ahead that gives the program's path, None for the calculated one."""
    notes: tuple[str, ...] = ()

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces of the contour."""
        return tuple(cut.piece for cut in self.cuts)

    @property
    def closed(self) -> bool:
        """True if it ends where it starts."""
        return dist(self.cuts[0].piece.start, self.cuts[-1].piece.end) <= CLOSED


@dataclass(frozen=True, eq=False, slots=True)
class NcProgram:
    """The contours of a program, and its unit."""

    unit: Unit
    contours: tuple[NcContour, ...]
    notes: tuple[str, ...] = ()


def nc_blocks(program: Program, read: NcProgram) -> tuple[Program, list[ImportedBlock]]:
    """Return the program with a block for each contour and the tools that its table lacked, and those blocks.

    Raises `segments.DoesNotFitError`.
    """
    imported: list[ImportedBlock] = []
    for number, contour in enumerate(read.contours, 1):
        program = _with_tool(program, contour)
        imported.append(_block(number, contour, program))
    return replace(program, blocks=(*program.blocks, *(item.block for item in imported))), imported


def _with_tool(program: Program, contour: NcContour) -> Program:
    """Add the contour's tool to the tool table, unless it has a tool of that number."""
    if contour.tool is None or contour.radius is None or any(tool.number == contour.tool for tool in program.tools):
        return program
    diameter = Number(round(from_mm(2.0 * contour.radius, program.unit), 6))
    added = set_tool(program, Tool(contour.tool, diameter=diameter))
    return added if isinstance(added, Program) else program


def _block(number: int, contour: NcContour, program: Program) -> ImportedBlock:
    kind = ContourKind.OUTSIDE if contour.closed else ContourKind.OPEN
    pieces = contour.pieces
    plain = Contour(number, pieces, contour.closed, kind, (), len(pieces))
    item = block_of(plain, program)
    notes = [*contour.notes, *(note for note in item.notes if "is open" not in note)]
    block = _with_values(item.block, contour, program.unit, notes)
    return replace(item, block=block, notes=tuple(notes))


def _with_values(block: Block, contour: NcContour, unit: Unit, notes: list[str]) -> Block:
    """Return the block with the program's side, tool, speed, feeds, heights and depths."""
    comp = CutterComp.ON if contour.side is None else CutterComp(contour.side.value)
    values: dict[str, Any] = {"cutter_comp": comp, **_depths(contour, unit, notes)}
    for name, value in (("tool", contour.tool), ("lookahead", contour.lookahead), ("speed", contour.speed)):
        if value:
            values[name] = Number(float(value))
    if contour.plunge_feed:
        values["plunge_feed"] = _typed(contour.plunge_feed, unit, 3)
    return _with_feeds_and_heights(replace(block, **values), contour, unit)


def _typed(value: float, unit: Unit, decimals: int) -> Number:
    return Number(round(from_mm(value, unit), decimals) + 0.0)


def _depths(contour: NcContour, unit: Unit, notes: list[str]) -> dict[str, Number]:
    """Return the lowest depth as Z BOTTOM and, if the step between depths is even, PECK DEPTH and Z START."""
    falling = list(dict.fromkeys(round(depth, 4) for depth in contour.depths))
    bottom = {"z_bottom": _typed(min(falling), unit, 4)}
    steps = [above - below for above, below in pairwise(falling)]
    if not steps:
        return bottom
    if min(steps) > 0.0 and max(steps) - min(steps) <= 2.0 * SAME_HEIGHT:
        top = falling[0] + steps[0]
        return bottom | {"peck_depth": _typed(steps[0], unit, 4), "z_start": _typed(top, unit, 4)}
    depths = ", ".join(f"{from_mm(depth, unit):.4f}" for depth in falling)
    notes.append(f"The depths {depths} are not even steps: PECK DEPTH is not set.")
    return bottom


def _with_feeds_and_heights(block: Block, contour: NcContour, unit: Unit) -> Block:
    """Give each segment its feed, and the height at its end, where they differ from those before it."""
    feed, height, segments = None, contour.cuts[0].z, []
    for segment, cut in zip(block.segments, contour.cuts, strict=True):
        assert isinstance(segment, LineSegment | ArcSegment)
        if cut.feed > 0.0 and cut.feed != feed:
            segment, feed = replace(segment, feed=_typed(cut.feed, unit, 3)), cut.feed
        if abs(cut.z - height) > SAME_HEIGHT:
            segment, height = replace(segment, z_end=_typed(cut.z, unit, 4)), cut.z
        segments.append(segment)
    return replace(block, segments=tuple(segments))
