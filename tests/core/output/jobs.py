"""Small jobs for tests, in inches as a drawing has them."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from core.comp.compensated import CenterPath
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Point, Turn
from core.output.passes import Cutter, Floor, Job

INCH = 25.4


def inches(*points: Point) -> list[Point]:
    return [(x * INCH, y * INCH) for x, y in points]


def polyline(*points: Point) -> Path:
    """Lines through points given in inches."""
    known = inches(*points)
    return Path.from_pieces([Line(a, b) for a, b in pairwise(known)])


def arc(start: Point, end: Point, center: Point, turn: Turn) -> Arc:
    first, last, middle = inches(start, end, center)
    return Arc(first, last, middle, turn)


def path_of(*pieces: Piece) -> Path:
    return Path.from_pieces(pieces)


def floors(count: int, z: float = -0.25, feed: float = 10.0) -> tuple[Floor, ...]:
    return tuple(Floor(number, z * INCH, z * INCH, feed * INCH) for number in range(1, count + 1))


def job(path: Path, **changes: object) -> Job:
    """A slot along `path`, 0.25 deep in pecks of 0.1, tool 1 of 0.5."""
    made = Job(
        block=1,
        comp="ON",
        cutter=Cutter(1, 0.5 * INCH, "END MILL"),
        finisher=None,
        surface=path,
        floors=floors(len(path)),
        finish=(CenterPath(path),),
        rough=(),
        z_start=0.0,
        z_bottom=-0.25 * INCH,
        peck_depth=0.1 * INCH,
        finish_z=0.0,
        retract_clearance=0.1 * INCH,
        peck_clearance=0.05 * INCH,
        plunge_feed=20.0 * INCH,
        speed=300.0,
        safe_z=1.0 * INCH,
    )
    return replace(made, **changes)  # type: ignore[arg-type]  # the changes are named by the tests themselves
