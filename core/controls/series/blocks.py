"""Plain blocks in a row through the modal machine: what `Machine.step` makes of each of them, for all at once.

A plain block has positions, an arc's center, F, and one of G0 to G3 at most.  Of all that is in force it changes the
motion, the feed and the position, and it ends in one element.  A block is left out, and with it all behind it, as soon
as the machine would say anything of it: words that have no place, no feed, no arc.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from core.controls.iso.rates import PER_MINUTE
from core.controls.moves import Floats
from core.controls.series import arcs
from core.controls.series.elements import Elements, Points, hypots, tangents
from core.controls.series.words import Flags, Words, leading
from core.tolerance import ON_PATH

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine

_CODES: Final = (0, 10, 20, 30)
_NONE: Final = -1.0
_CLOCKWISE: Final = 2.0


class Course(NamedTuple):
    """What plain blocks ask for: an element each, and what is in force behind each; `named`: G is written."""

    elements: Elements
    modes: Floats
    feeds: Floats
    points: tuple[Floats, Floats, Floats]
    named: Flags

    def settle(self, machine: Machine, count: int) -> None:
        """The machine stands behind the first `count` of the blocks."""
        if not count:
            return
        x, y, z = (float(one[count - 1]) for one in self.points)
        machine.position, machine.feed = (x, y, z), float(self.feeds[count - 1])
        if self.named[:count].any():
            machine.mode, machine.cycles.code = _CODES[int(self.modes[count - 1])], None


def ready(machine: Machine) -> bool:
    """Whether a plain block is nothing but an element now: not the first that moves, and F counts by the minute."""
    return machine.moved_in is not None and machine.rates.mode == PER_MINUTE


def course(machine: Machine, words: Words, line: int) -> Course:
    """The leading blocks of these words, the first of them on `line`, of which the machine says nothing."""
    modes = words.forward("G", 1.0, 0.0, _CODES.index(machine.mode) if machine.mode in _CODES else _NONE)
    feeds = words.forward("F", machine.scale, 0.0, machine.feed)
    centers, turning = words.has("IJKR"), modes >= _CLOCKWISE
    fine = np.where(turning, centers, words.has("XYZ") & ~centers) & (modes >= 0.0) & ((modes == 0.0) | (feeds != 0.0))
    words = words.first(leading(fine))
    modes, feeds, points = modes[: words.count], feeds[: words.count], _points(machine, words)
    elements = _lines(machine, points, modes, feeds, line)
    bent = np.flatnonzero(modes >= _CLOCKWISE)
    count = words.count
    if len(bent):
        sound = _bend(elements, bent, np.where(modes[bent] == _CLOCKWISE, -1.0, 1.0), machine, words)
        count = count if sound.all() else int(bent[leading(sound)])
    return Course(elements.part(0, count), modes, feeds, points, words.has("G"))


def _points(machine: Machine, words: Words) -> tuple[Floats, Floats, Floats]:
    """Where the blocks lead, x, y, z."""
    scale = machine.scale
    if machine.incremental:
        x, y, z = (words.added(letter, scale, now) for letter, now in zip("XYZ", machine.position, strict=True))
    else:
        known = zip("XYZ", machine.shift, machine.position, strict=True)
        x, y, z = (words.forward(letter, scale, base, now) for letter, base, now in known)
    return x, y, z


def _lines(
    machine: Machine, points: tuple[Floats, Floats, Floats], modes: Floats, feeds: Floats, line: int
) -> Elements:  # fmt: skip
    """The blocks as straight elements, whatever they are."""
    count, axes = len(modes), machine.plane.axes
    before = [np.concatenate(((now,), one))[:count] for now, one in zip(machine.position, points, strict=True)]
    first, second, third = ((before[axis], points[axis]) for axis in axes)
    dx, dy = first[1] - first[0], second[1] - second[0]
    size = hypots(dx, dy)
    size = np.where(size == 0.0, 1.0, size)
    way, start, end = (dx / size, dy / size), (first[0], second[0]), (first[1].copy(), second[1].copy())
    back = (start[0].copy(), start[1].copy(), np.zeros(count), *way, way[0].copy(), way[1].copy())
    lines = np.arange(line, line + count, dtype=np.float64)
    return Elements(*start, *end, *back, *third, np.where(modes == 0.0, 1.0, 0.0), feeds, lines)


def _bend(elements: Elements, rows: arcs.Indices, turn: Floats, machine: Machine, words: Words) -> Flags:
    """Makes the elements of some rows arcs, and tells of which of them the machine says nothing."""
    chords = elements.of(rows)
    apart = hypots(chords.start_x - chords.end_x, chords.start_y - chords.end_y)
    whole = (apart < ON_PATH) & ~words.has("R")[rows]
    end: Points = np.where(whole, chords.start_x, chords.end_x), np.where(whole, chords.start_y, chords.end_y)
    center, sound = arcs.centers(machine, words, chords._replace(end_x=end[0], end_y=end[1]), rows, turn)
    leaving, arriving = tangents(chords.start, center, turn), tangents(end, center, turn)
    heights, rest = (chords.low, chords.high), (chords.rapid, chords.feed, chords.line)
    elements.put(rows, Elements(*chords.start, *end, *center, turn, *leaving, *arriving, *heights, *rest))
    return sound
