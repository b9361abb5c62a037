"""Many elements at once on the 9/Series, as long as there is nothing to be said of any of them."""

from __future__ import annotations

from math import pi, radians, tau
from typing import Final

import numpy as np

from core.controls.compensation.corners import WHOLE
from core.controls.makers.nine_words import NineWords
from core.controls.moves import Floats
from core.controls.report import Log
from core.controls.series.corners import after, radii, sweeps
from core.controls.series.elements import Elements, Points
from core.controls.series.generated import Joints, chained, joints
from core.controls.series.words import Flags, leading

TANGENT: Final = radians(0.05)
"""Inside corners under this angle whose offsets miss each other are tangent; the control's own limit is not known."""


class NineMany(NineWords):
    """The chain, run at once; `entering` until the entry has ended."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.entering = False

    @property
    def steady(self) -> bool:
        """Whether the next joint hangs on the held element and the next one alone."""
        at_work = self.active and not self.entering and self.leaving is None and not self.standing
        return at_work and self.held is not None and self.coming == self.offset != 0.0

    def at_once(self, elements: Elements) -> int:
        """All before the first one that has no joint or an alarm.

        The last of them goes as it would alone: what stood before it counts where compensation is interrupted.
        """
        if self.held is None:
            return 0
        first = elements.behind(self.held).part(0, elements.size)
        made = joints(first, elements, self.offset, self.corners, TANGENT)
        fits = (elements.turn == 0.0) | (radii(elements) - elements.turn * self.offset > 0.0)
        back = _runs_back(first, after(self.start, made.starts), made.ends)
        count = leading(elements.moves & fits & made.met & ~back) - 1
        if count > 0:
            self._run(first.part(0, count), elements.part(0, count), made.first(count))
        if count >= 0:
            self.travel(elements.one(count))
        return count + 1

    def _run(self, first: Elements, second: Elements, made: Joints) -> None:
        """Joints that are fine."""
        generated, inner = made.generated, first.turn * self.offset > 0.0
        if generated.any():
            self.generates(int(second.line[generated.argmax()]))
        if inner.any():
            self.slows(int(first.line[inner.argmax()]))
        run = first._replace(feed=_feeds(first, self.offset, inner))
        self.tape.extend(chained(run, second, made, self.plane, self.offset))
        self.note_all(second)
        self.held, self.start = second.one(-1), (made.starts[0].item(-1), made.starts[1].item(-1))
        self.elements += second.size


def _feeds(elements: Elements, offset: float, inner: Flags) -> Floats:
    """See `NineSeries.feed_of`."""
    radius = np.where(inner, radii(elements), 1.0)
    return np.where(inner, elements.feed * (radius - elements.turn * offset) / radius, elements.feed)


def _runs_back(elements: Elements, start: Points, end: Points) -> Flags:
    """Which run backwards from a start to an end: see `runs_back`; not where the start is not known."""
    found = (end[0] - start[0]) * elements.leaving_x + (end[1] - start[1]) * elements.leaving_y < -WHOLE
    at = np.flatnonzero(elements.turn)
    arcs, begin, stop = elements.of(at), (start[0][at], start[1][at]), (end[0][at], end[1][at])
    swept = sweeps(arcs.start, arcs.end, arcs.center, arcs.turn)
    found[at] = sweeps(begin, stop, arcs.center, arcs.turn) - np.where(swept == 0.0, tau, swept) > pi
    return found
