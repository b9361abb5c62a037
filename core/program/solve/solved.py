"""A block with its blanks calculated: what `core.program.solve.block` yields.

`Solved` is a calculated number and never a `Number`: the form shows it with the tag CAL and no edit turns
it into something typed.  Needs no numpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from core.finding import Finding, Severity
from core.geometry.piece import Piece, Point
from core.program.model import Coolant, Number, Relative, Unread


class Origin(StrEnum):
    """Where a number that was not typed comes from; the form shows it as the field's tag."""

    CALCULATED = "CAL"
    SAME = "SAME"
    """The coordinate of the segment before."""
    TOOL = "TOOL"
    """What TOOL SETUP proposes for the tool."""
    USUAL = "DEF"
    """What a blank usually means."""


@dataclass(frozen=True, slots=True)
class Solved:
    """A number that was not typed, in program units (degrees for an angle)."""

    value: float
    origin: Origin = Origin.CALCULATED


Value = Number | Relative | Solved | Unread | None


@dataclass(frozen=True, slots=True)
class SolvedSegment:
    """Segment `number` with every field's value by name.

    `piece` is its part of the surface in millimeters, None while it is not determined or has no length;
    neighbors of a BLEND ARC are already shortened.  `missing` names the fields of which one more is needed.
    `choices` are the pieces between which the operator picks, in the documented order.  `z_start`, `z_end` are
    millimeters, `feed` millimeters per minute.
    """

    number: int
    values: Mapping[str, Value]
    piece: Piece | None
    missing: tuple[str, ...] = ()
    choices: tuple[Piece, ...] = ()
    start: Point | None = None
    """Where it begins, as far as known, before any blending."""
    end: Point | None = None
    """Where it ends before any blending, None while it is not determined."""
    sketch: Piece | None = None
    """What to draw dashed while it is not determined."""
    z_start: float = 0.0
    z_end: float = 0.0
    feed: float | None = None
    findings: tuple[Finding, ...] = ()
    sharp: Piece | None = None
    """The piece as its fields say it, before any blending."""


@dataclass(frozen=True, slots=True)
class RunAnswer:
    """One solution of a run: its pieces with their segment numbers, before any blending, and their length together.

    A program takes it with `choice` on the run's first segment or, where the run is calculated from a pick, with that
    segment's PICK X and PICK Y at `pick` (millimeters).
    """

    pieces: tuple[tuple[int, Piece], ...]
    length: float
    choice: int | None = None
    pick: Point | None = None


@dataclass(frozen=True, slots=True)
class SolvedRun:
    """Segments `first` to `last`, calculated together.

    `answers` are all solutions, the shortest first, `taken` the index of the one in force.  While there is none, `code`
    says why, `missing` counts the values that are needed at least, and `sketch` is what is known of the run's pieces.
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

    `determined` is how many segments from the first on are determined; the surface known so far is theirs.
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
    """Where COOLANT comes from if it is not typed."""
    pieces: tuple[tuple[int, Piece], ...] = ()
    """(segment number, piece) of the determined surface from START on; segments without length are passed over."""
    runs: tuple[SolvedRun, ...] = ()
    """The stretches whose segments are calculated together, in order."""

    def run_of(self, number: int) -> SolvedRun | None:
        """The run of which a segment is a part."""
        return next((run for run in self.runs if run.first <= number <= run.last), None)

    @property
    def every_finding(self) -> tuple[Finding, ...]:
        """Findings of START and of all segments."""
        return (*self.findings, *(finding for segment in self.segments for finding in segment.findings))

    @property
    def whole(self) -> bool:
        """Every segment is determined: what is known of the surface is all of it."""
        return self.determined == len(self.segments)

    @property
    def postable(self) -> bool:
        """Everything is read and determined."""
        sound = all(finding.severity is not Severity.ERROR for finding in self.every_finding)
        return self.whole and bool(self.pieces) and sound
