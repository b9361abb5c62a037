"""Findings of compensation: why it refuses a contour, and what the operator must know about a compensated one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from core.comp.offset import RawChain, RawPart
from core.comp.prune import Pruned
from core.finding import Finding, Severity
from core.geometry.path import Flags, Floats, Path, Rows, as_complex, point_of_row
from core.geometry.piece import Side
from core.tolerance import ARC_RADII, GOUGE, JOINED, LARGEST_COORDINATE

MAX_NAMED_PLACES: Final = 100
"""At most this many places of one kind are listed; a last finding then says how many there are in all."""


NO_PATH: Final = "NO_PATH"
"""The code of the error for a path with no length at all."""


def contour_refusals(contour: Path, radius: float, lookaheads: Sequence[int]) -> tuple[Finding, ...]:
    """Return why a contour cannot be compensated at all; empty if it can."""
    if not 0.0 < radius <= LARGEST_COORDINATE:
        return (_error("RADIUS", "The cutter's radius must be a number larger than 0."),)
    if min(lookaheads, default=1) < 1:
        return (_error("LOOKAHEAD", "The look-ahead must be 1 or more."),)
    if not len(contour):
        return (_error("EMPTY_CONTOUR", "The contour has no segment with a length."),)
    if not contour.reachable:
        return (_not_finite(contour),)
    return _not_arcs(contour)


def _error(code: str, text: str, segment: float | None = None) -> Finding:
    return Finding(code, Severity.ERROR, text, segment)


def _not_finite(contour: Path) -> Finding:
    points: Flags = np.logical_and.reduce(np.abs(contour.points) <= LARGEST_COORDINATE, axis=1)
    bad = ~(points[:-1] & points[1:] & (np.abs(contour.centers) <= LARGEST_COORDINATE).all(axis=1))
    text = "A coordinate of this segment is too large for any machine. Type it again."
    return _error("NOT_FINITE", text, float(contour.numbers[np.argmax(bad)]))


def _not_arcs(contour: Path) -> tuple[Finding, ...]:
    """Return errors for arcs whose radii at start and end differ by more than rounding, or have a radius of zero.

    If the radii differ by less, an arc whose ends are on one ray from its center may be a full turn or empty.
    """
    rows = contour.turns.nonzero()[0]
    points, centers = as_complex(contour.points), as_complex(contour.centers)[rows]
    first, last = np.abs(points[rows] - centers), np.abs(points[rows + 1] - centers)
    radii, ends = list[Finding](), list[Finding]()
    for row in ((np.abs(first - last) > JOINED) | (np.minimum(first, last) <= 2.0 * JOINED)).nonzero()[0].tolist():
        start, end = (complex(points[rows[row] + at] - centers[row]) for at in (0, 1))
        lengths, across = (float(first[row]), float(last[row])), start.conjugate() * end
        difference, number = abs(lengths[0] - lengths[1]), float(contour.numbers[rows[row]])
        if difference > ARC_RADII or (min(lengths) <= JOINED and abs(end - start) > JOINED):
            text = "Radius {0} at start, {1} at end. Check X CENTER, Y CENTER."
            radii.append(Finding("ARC_RADII", Severity.ERROR, text, number, lengths=lengths))
        elif difference > JOINED and abs(across.imag) <= JOINED * lengths[0] and across.real > 0.0:
            text = "The arc ends next to its start, {0} and {1} from its center. "
            text += "Move the end to the start for a full circle, or farther away."
            ends.append(Finding("ARC_ENDS", Severity.ERROR, text, number, lengths=lengths))
    return (*radii[:MAX_NAMED_PLACES], *ends[:MAX_NAMED_PLACES])


def zero_length(contour: Path, rows: Rows) -> list[Finding]:
    """Return a warning for each segment that is skipped because it has no length."""
    text = "No length: skipped. Type its end, or F1 deletes it."
    return _named("ZERO_LENGTH", text, contour.numbers[rows], contour.points[rows])


def start_in_corner_finding(contour: Path, side: Side, radius: float) -> list[Finding]:
    """Warn about a closed contour that starts in an inside corner: the cutter plunges into the last wall."""
    first, last = contour[0], contour[-1]
    bend = complex(*last.direction_at(last.end)).conjugate() * complex(*first.direction_at(first.start))
    if side.sign * bend.imag <= 0.0 or radius * (1.0 - bend.real) <= GOUGE:
        return []
    text = "START is in an inside corner: the cutter gouges the last wall. Start in the middle of a side."
    number, at = float(contour.numbers[0]), point_of_row(contour.points[0])
    return [Finding("START_INSIDE_CORNER", Severity.WARNING, text, number, at=at)]


def bridge_findings(contour: Path, chain: RawChain, pruned: Pruned, radius: float) -> list[Finding]:
    """Return warnings for the bridges that remain in the path: inside arcs and corners that the tool cannot enter."""
    rows = pruned.bridges
    if not len(rows):
        return []
    vanished = chain.parts[rows] == RawPart.VANISHED.value
    return [*_vanished(contour, chain, rows[vanished], radius), *_missed(contour, chain, rows[~vanished], radius)]


def _vanished(contour: Path, chain: RawChain, rows: Rows, radius: float) -> list[Finding]:
    segments = chain.half_steps[rows] // 2
    radii = np.abs(as_complex(contour.points)[segments] - as_complex(contour.centers)[segments])
    small = radii < radius - JOINED
    text = "Inside radius {value} is too small for the tool: the path runs straight across and may gouge."
    numbers, at = contour.numbers[segments[small]], contour.points[segments[small]]
    return _named("VANISHED", text, numbers, at, radii[small])


def _missed(contour: Path, chain: RawChain, rows: Rows, radius: float) -> list[Finding]:
    """Warn about bridged inside corners whose bridge enters a wall: by its length squared over the tool diameter."""
    points = as_complex(chain.raw.points)
    rows = rows[np.abs(points[rows + 1] - points[rows]) ** 2 > 2.0 * radius * GOUGE]
    text = "Corner too tight for the tool: the path runs straight across and may gouge."
    at = contour.points[chain.half_steps[rows] // 2 + 1]
    return _named("CORNER_MISSED", text, chain.raw.numbers[rows], at)


def most_deleted_finding(contour: Path, pruned: Pruned) -> list[Finding]:
    """Warn about a closed contour if the look-ahead deleted more than half of its length."""
    deleted = pruned.deleted.segments
    if not len(deleted):
        return []
    rows = np.isin(contour.numbers, deleted)
    lengths = contour.lengths
    deleted_length = float(lengths[rows].sum())
    if deleted_length <= lengths.sum() / 2.0:
        return []
    loss = f"LOOK-AHEAD deletes most of the part: {segment_list(deleted)}, {{value}} long."
    text = f"{loss} Press Space on LOOKAHEAD to find a value that keeps it."
    return [Finding("LONG_WAY", Severity.WARNING, text, float(deleted[0]), value=deleted_length)]


def nothing_left(chain: RawChain, pruned: Pruned, *, closed: bool) -> Finding:
    """Return why nothing is left of a path: the tool does not fit, or the path comes back to its start too early.

    It does that where START is as far from an inside corner as the tool's center from both walls; the look-ahead takes
    the whole contour for a loop then.
    """
    start = chain.raw.points[:1]
    back = np.hypot(*(pruned.deleted.at - start).T) <= JOINED
    if not closed or not back.any():
        return _error(NO_PATH, "Nothing is left of the path: the tool does not fit. Use a smaller one.")
    text = "Nothing is left of the path. Near the corner it meets its own start, X {x} Y {y}, and is deleted. "
    text += "Start in the middle of a side."
    return Finding(NO_PATH, Severity.ERROR, text, 0.0, "x_start", point_of_row(start[0]))


def segment_list(numbers: NDArray[np.float64]) -> str:
    """Return segment numbers as said on the shop floor: `segment 4`, `segments 2-3, 7`."""
    integers = numbers.astype(int)
    runs = np.split(integers, (np.diff(integers) != 1).nonzero()[0] + 1)
    words = [f"{run[0]}-{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs[:MAX_NAMED_PLACES]]
    return ("segments " if len(integers) > 1 else "segment ") + ", ".join(words)


def _named(code: str, text: str, numbers: Floats, at: Floats, values: Floats | None = None) -> list[Finding]:
    """Return a warning for each of the first MAX_NAMED_PLACES places; one more gives the total if there are more."""
    first = slice(MAX_NAMED_PLACES)
    sizes = [None] * len(numbers[first]) if values is None else values[first].tolist()
    rows = zip(numbers[first].tolist(), at[first].tolist(), sizes, strict=True)
    named = [Finding(code, Severity.WARNING, text, number, at=(x, y), value=value) for number, (x, y), value in rows]
    if len(numbers) > MAX_NAMED_PLACES:
        total = f"There are {len(numbers)} such places; the first {MAX_NAMED_PLACES} are listed."
        named.append(Finding(code, Severity.WARNING, total))
    return named
