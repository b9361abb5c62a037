"""The centers of many arcs out of I, J, K or R words, and which of them are arcs without fault; see `controls.arcs`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from core.controls.iso.arcs import IN_PLANE, SHORTEST, THOUSANDTH, WHOLE_CHORD
from core.controls.moves import Floats, flat
from core.controls.series.elements import Elements, Points, hypots
from core.controls.series.words import Flags, Words

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine

Indices = NDArray[np.int64]


def centers(machine: Machine, words: Words, chords: Elements, rows: Indices, turn: Floats) -> tuple[Points, Flags]:
    """The centers of arcs with these chords, which stand in some rows of the words, and which arcs are sound."""
    by_radius, by_center = words.has("R")[rows], words.has("IJK")[rows]
    x, y = np.zeros(len(rows)), np.zeros(len(rows))
    sound = by_radius ^ by_center
    some = np.flatnonzero(sound & by_radius)
    (x[some], y[some]), sound[some] = _through(chords.of(some), _numbers(words, "R", rows[some], machine), turn[some])
    some = np.flatnonzero(sound & by_center)
    (x[some], y[some]), sound[some] = _given(machine, words, chords.of(some), rows[some])
    return (x, y), sound


def _numbers(words: Words, letter: str, rows: Indices, machine: Machine) -> Floats:
    """What a letter says in some rows in millimeters, 0 without it."""
    return words.values[letter][rows] * machine.scale if letter in words.values else np.zeros(len(rows))


def _through(chords: Elements, radius: Floats, turn: Floats) -> tuple[Points, Flags]:
    """By R: see `through`."""
    (sx, sy), (ex, ey) = chords.start, chords.end
    dx, dy = ex - sx, ey - sy
    chord, size = hypots(dx, dy), np.abs(radius)
    sound = (chord != 0.0) & ~((chord / 2 - size > SHORTEST) | (size == 0.0))
    chord, size = np.where(sound, chord, 1.0), np.where(sound, size, 1.0)
    away = np.sqrt(np.maximum(size * size - chord * chord / 4, 0.0)) * turn * np.where(radius > 0.0, 1.0, -1.0)
    away = np.where(chord / 2 / size > WHOLE_CHORD, 0.0, away)
    return ((sx + ex) / 2 - away * dy / chord, (sy + ey) / 2 + away * dx / chord), sound


def _given(machine: Machine, words: Words, chords: Elements, rows: Indices) -> tuple[Points, Flags]:
    """By I, J, K: see `given_center` and `about`."""
    first, second, standing = IN_PLANE[machine.plane]
    away = _numbers(words, first, rows, machine), _numbers(words, second, rows, machine)
    named = words.has(first)[rows], words.has(second)[rows]
    if machine.centers_from_origin:
        x, y, _ = flat(machine.shift, machine.plane)
        center, sound = (x + away[0], y + away[1]), named[0] & named[1]
    else:
        center, sound = (chords.start_x + away[0], chords.start_y + away[1]), named[0] | named[1]
    return center, sound & ~words.has(standing)[rows] & _alike(machine, chords, center)


def _alike(machine: Machine, chords: Elements, center: Points) -> Flags:
    """Arcs that have a radius, and the same at both ends as far as the control asks for it."""
    first = hypots(chords.start_x - center[0], chords.start_y - center[1])
    last = hypots(chords.end_x - center[0], chords.end_y - center[1])
    allowed = machine.dialect.arcs.allowed(machine.unit)
    apart = np.abs(first - last)
    unlike = (apart > allowed) & (apart > THOUSANDTH * np.maximum(first, last))
    return (np.minimum(first, last) >= SHORTEST) & ~unlike & (apart <= allowed * machine.dialect.arcs.worst)
