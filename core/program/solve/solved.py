"""This module defines a block with its blanks calculated, as `core.program.solve.block` returns it.

A `Solved` is a number that was not typed and never a `Number`: the form shows it with the tag of its origin, such as
CAL, and no edit turns it into a typed one.  This module needs no numpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from core.finding import Finding
from core.geometry.piece import Piece, Point
from core.program.model import Coolant, Number, Relative, Unread


class Origin(StrEnum):
    """The source of a number that was not typed; the form shows it as the field's tag."""

    CALCULATED = "CAL"
    SAME = "SAME"
    """A coordinate kept from the segment before."""
    TOOL = "TOOL"
    """A proposal of TOOL SETUP for the tool."""
    USUAL = "DEF"
    """The default for a blank."""


@dataclass(frozen=True, slots=True)
class Solved:
    """A number that was not typed, in program units (degrees for an angle)."""

    value: float
    origin: Origin = Origin.CALCULATED


Value = Number | Relative | Solved | Unread | None


@dataclass(frozen=True, slots=True)
class SolvedSegment:
    """Segment `number` with every field's value by name.

    `piece` is its part of the surface in millimeters, None if it is not determined or has no length; the neighbors of
    a BLEND ARC or CHAMFER are already shortened.  `missing` names fields of which one more is needed.  `choices` are
    the pieces from which the operator picks, in the documented order.  `z_start` and `z_end` are in millimeters, `feed`
    in millimeters per minute.
    """

    number: int
    values: Mapping[str, Value]
    piece: Piece | None
    missing: tuple[str, ...] = ()
    choices: tuple[Piece, ...] = ()
    start: Point | None = None
    """Its start before any blending, None if not known."""
    end: Point | None = None
    """Its end before any blending, None if not determined."""
    sketch: Piece | None = None
    """The piece to draw dashed while it is not determined."""
    z_start: float = 0.0
    z_end: float = 0.0
    feed: float | None = None
    findings: tuple[Finding, ...] = ()
    sharp: Piece | None = None
    """The piece that its fields give, before any blending."""


@dataclass(frozen=True, slots=True)
class RunAnswer:
    """One solution of a run: its pieces with their segment numbers, before any blending.

    A program selects it with `choice` on the run's first segment or, if the run is calculated from a pick, with that
    segment's PICK X and PICK Y set to `pick` (millimeters).
    """

    pieces: tuple[tuple[int, Piece], ...]
    choice: int | None = None
    pick: Point | None = None

    @property
    def length(self) -> float:
        """The total length of its pieces, in millimeters."""
        return sum(piece.length for _, piece in self.pieces)


@dataclass(frozen=True, slots=True)
class SolvedRun:
    """Segments `first` to `last`, calculated together.

    `answers` are all solutions, the shortest first; `taken` is the index of the one in force.  If it is None, `code`
    says why, `missing` is the least number of values still needed, and `sketch` shows what is known of the pieces.
    """

    first: int
    last: int
    answers: tuple[RunAnswer, ...] = ()
    taken: int | None = None
    code: str | None = None
    missing: int = 0
    sketch: tuple[Piece, ...] = ()


@dataclass(frozen=True, slots=True)
class SolvedBlock:
    """A whole block: START's values and its segments.  Lengths in millimeters, feeds in millimeters per minute.

    `determined` is the number of leading segments that are determined; the known surface consists of these.
    """

    values: Mapping[str, Value]
    segments: tuple[SolvedSegment, ...]
    closed: bool
    determined: int
    tool_diameter: float | None
    tool_type: str
    finish_diameter: float | None
    z_start: float | None
    z_bottom: float | None
    plunge_feed: float | None
    speed: float | None
    peck_depth: float
    findings: tuple[Finding, ...]
    coolant: Coolant = Coolant.OFF
    coolant_origin: Origin | None = None
    """The origin of COOLANT, None if it is typed."""
    pieces: tuple[tuple[int, Piece], ...] = ()
    """(segment number, piece) of the determined surface from START on; segments without length are omitted."""
    runs: tuple[SolvedRun, ...] = ()
    """The runs of segments that are calculated together, in order."""

    def run_of(self, number: int) -> SolvedRun | None:
        """Return the run that contains a segment, None if there is none."""
        return next((run for run in self.runs if run.first <= number <= run.last), None)

    @property
    def all_findings(self) -> tuple[Finding, ...]:
        """The findings of START and of all segments."""
        return (*self.findings, *(finding for segment in self.segments for finding in segment.findings))

    @property
    def fully_determined(self) -> bool:
        """True if every segment is determined, so that the whole surface is known."""
        return self.determined == len(self.segments)


@dataclass(frozen=True, slots=True)
class Solution:
    """What SOLUTION steps through at a segment: the answers of its run, the shortest first, or its own two solutions.

    `number` is the segment whose `choice` or pick selects one; `taken` is the index of the one in force, or None.
    """

    number: int
    answers: tuple[RunAnswer, ...]
    taken: int | None

    @property
    def label(self) -> str:
        """The text in the field, such as `2 of 4`, or `? of 4` if none is taken."""
        return f"{'?' if self.taken is None else self.taken + 1} of {len(self.answers)}"

    @property
    def labels(self) -> tuple[str, ...]:
        """The text in the field for each answer."""
        return tuple(f"{index} of {len(self.answers)}" for index in range(1, len(self.answers) + 1))


def solution_at(block: SolvedBlock, number: int) -> Solution | None:
    """Return the solutions to choose from at a segment; None if there is no choice."""
    run = block.run_of(number)
    if run is not None and (len(run.answers) > 1 or (run.answers and run.taken is None)):
        return Solution(run.first, run.answers, run.taken)
    if not 1 <= number <= len(block.segments):
        return None
    segment = block.segments[number - 1]
    if len(segment.choices) < 2:
        return None
    answers = tuple(RunAnswer(((number, piece),), choice) for choice, piece in enumerate(segment.choices))
    taken = None if segment.sharp is None else segment.choices.index(segment.sharp)
    return Solution(number, answers, taken)


def untaken_pieces(block: SolvedBlock, number: int) -> tuple[tuple[Piece, ...], ...]:
    """Return the pieces of the answers not taken at a segment, none until one is taken; a drawing shows them dotted."""
    solution = solution_at(block, number)
    if solution is None or solution.taken is None:
        return ()
    others = (answer for index, answer in enumerate(solution.answers) if index != solution.taken)
    return tuple(tuple(piece for _, piece in answer.pieces) for answer in others)
