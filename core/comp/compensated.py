"""Compensated: the center path of a contour and the results of all stages on the way to it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from core.finding import Finding
from core.geometry.path import EMPTY, Flags, Floats, Path, joined, point_of_row
from core.geometry.piece import Point, Side


@dataclass(frozen=True, slots=True)
class Deleted:
    """Segment `segment` was deleted because pieces `by` met at `at` (millimeters)."""

    segment: float
    by: tuple[float, float]
    at: tuple[float, float]


@dataclass(frozen=True, eq=False, slots=True)
class Deletions:
    """All deletions in order of segment: `segments` (m,), `by` (m, 2) piece numbers, `at` (m, 2)."""

    segments: Floats
    by: Floats
    at: Floats

    def __len__(self) -> int:
        return len(self.segments)

    def __iter__(self) -> Iterator[Deleted]:
        rows = zip(self.segments.tolist(), self.by.tolist(), self.at.tolist(), strict=True)
        return (Deleted(segment, (a, b), (x, y)) for segment, (a, b), (x, y) in rows)


NO_DELETIONS: Final = Deletions(np.empty(0), np.empty((0, 2)), np.empty((0, 2)))


@dataclass(frozen=True, eq=False, slots=True)
class CenterPath:
    """One center path with its blend moves, joined end to start; `offset` is the stock it leaves on the side (mm)."""

    path: Path = EMPTY
    lead_in: Path = EMPTY
    lead_out: Path = EMPTY
    offset: float = 0.0

    @property
    def with_leads(self) -> Path:
        """Blend-in, path and blend-out as one path."""
        return joined((self.lead_in, self.path, self.lead_out))

    @property
    def plunge_point(self) -> Point | None:
        """The point where the tool goes down; None for a run without pieces."""
        path = self.with_leads
        return point_of_row(path.points[0]) if len(path) else None


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Compensated(CenterPath):
    """A contour's center path at one look-ahead, with its stages.

    `raw` is the chain of all offset pieces, corner arcs and provisional bridges before any test; `path` is what is
    left of it.  `bridged` (len(path),) marks pieces of `path` that are provisional bridges never replaced.
    `lead_out` begins with the overlap.  Millimeters.  `tested` is the number of crossings that the look-ahead tests:
    look-aheads of one contour with equal numbers make the same path.
    """

    contour: Path
    side: Side
    radius: float
    lookahead: int
    closed: bool
    findings: tuple[Finding, ...]
    raw: Path = EMPTY
    tested: int = 0
    bridged: Flags = field(default_factory=lambda: np.empty(0, np.bool_))
    deleted: Deletions = NO_DELETIONS
