"""Motion: what the tool does, as neutral moves, and passes that group them.  Millimeters and mm a minute."""

from __future__ import annotations

from dataclasses import dataclass

from core.geometry.piece import Point, Turn
from core.output.job import Cutter


@dataclass(frozen=True, slots=True)
class Motion:
    """One move from where the tool is to (x, y, z).

    A rapid has no `feed`.  `turn` NONE is a straight move; else the tool turns about `center`, in the XY plane, and z
    changes evenly with the angle; an arc that ends where it began in XY is one full turn.
    """

    x: float
    y: float
    z: float
    feed: float | None = None
    turn: Turn = Turn.NONE
    center: Point = (0.0, 0.0)

    @property
    def rapid(self) -> bool:
        """No feed: as fast as the machine can."""
        return self.feed is None


@dataclass(frozen=True, eq=False, slots=True)
class Pass:
    """One run at one depth, from above its plunge point to above its end.

    `side` of `sides` widths from outside in, of which one may be several runs, and `number` of `count` depths, at
    `level`; `stock` is what the run leaves on the side; `finishing` says that it is the
    finish tool's.  The first motion is a rapid in XY at a height that clears everything.
    """

    block: int
    cutter: Cutter
    speed: float
    level: float
    side: int
    sides: int
    number: int
    count: int
    stock: float
    finishing: bool
    motions: tuple[Motion, ...]
