"""Job: everything one MILL CONTOUR block needs to be cut and posted, in millimeters, mm a minute and radians.

Words: a *run* is one center path with its blend moves, cut in one go at one depth; the *plunge point* is where it
begins; a segment's *floor* is the height its Z START and Z END give it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from operator import attrgetter
from typing import Final, Protocol

from core.finding import Finding, Severity
from core.geometry.path import EMPTY, Path, joined
from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Cutter:
    """A tool as the table has it: `diameter` in millimeters."""

    number: int
    diameter: float
    type: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class Run:
    """One center path with its blend moves, joined end to start; `offset` is the stock it leaves on the side (mm)."""

    path: Path
    lead_in: Path = EMPTY
    lead_out: Path = EMPTY
    offset: float = 0.0

    @property
    def whole(self) -> Path:
        """Blend-in, path and blend-out as one path."""
        return joined((self.lead_in, self.path, self.lead_out))

    @property
    def plunge_point(self) -> Point | None:
        """Where the tool goes down; None for a run without pieces."""
        whole = self.whole
        return (float(whole.points[0, 0]), float(whole.points[0, 1])) if len(whole) else None


class Floor(Protocol):
    """What a job asks of a segment."""

    @property
    def number(self) -> int:
        """Its number, from 1."""

    @property
    def z_start(self) -> float:
        """Its height at its start (mm)."""

    @property
    def z_end(self) -> float:
        """Its height at its end (mm)."""

    @property
    def feed(self) -> float | None:
        """Its feed (mm a minute), None if not known."""


Level = tuple[float, float, float | None]
"""Z START, Z END and feed of a floor."""

_level: Final = attrgetter("z_start", "z_end", "feed")


@dataclass(frozen=True, eq=False, slots=True)
class Job:
    """One block, ready for passes.

    `surface` is the programmed contour; piece numbers of it and of every run are those of `floors`, k + 1/2 for the
    corner arc behind k.  `cutter` is the block's TOOL, `finisher` its FINISH TOOL; either is None when the block
    names none or the table has none, and then a finding says so.

    `finish` are the runs at full size, in order: one, or one for each loop of the best path.  `rough` are the runs
    before them, outermost first, cut by `cutter`: PROFILE's passes, and with a finish tool also the run that leaves
    FINISH XY.  Without a finish tool `cutter` cuts `finish` too.

    `finish_z` is the stock roughing leaves on the floor when a finish tool follows.  `peck_depth` 0 is full depth in
    one pass.  `lookahead` is text such as "CAL 8", empty for ON.  `findings` are all of the block's; any error among
    them blocks posting.  `notes` are further sentences for the posted header.  `levels` are the heights and feeds that
    floors have, each triple once.
    """

    block: int
    comp: str
    cutter: Cutter | None
    finisher: Cutter | None
    surface: Path
    floors: tuple[Floor, ...]
    finish: tuple[Run, ...]
    rough: tuple[Run, ...]
    z_start: float
    z_bottom: float
    peck_depth: float
    finish_z: float
    retract_clearance: float
    peck_clearance: float
    plunge_feed: float
    speed: float
    safe_z: float
    finish_tool: int = 0
    work_offset: int = 54
    lookahead: str = ""
    findings: tuple[Finding, ...] = ()
    notes: tuple[str, ...] = ()
    levels: frozenset[Level] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "levels", frozenset(map(_level, self.floors)))

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that block posting."""
        return tuple(finding for finding in self.findings if finding.severity is Severity.ERROR)
