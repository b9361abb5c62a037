"""Report turns a verdict into findings, in a machinist's words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import isfinite, isinf
from typing import Final

import numpy as np

from core.finding import Finding, Severity
from core.geometry.path import Path
from core.tolerance import GOUGE, SMALLEST_SHOWN_LENGTH, STOCK
from core.verify.air_cuts import AirCut
from core.verify.verdict import Gouge, OverRun, Uncut, UnevenArc, Verdict

LAST_INCH_DIGIT: Final = 0.00254
"""Millimeters: the last digit of a form in inches."""

MAX_NAMED_CORNERS: Final = 6
"""Corners of one kind that are named; the rest are only counted."""

Names = Callable[[int, float], str]
"""Returns the name of a move from its row in the judged path and its number."""


def by_number(_row: int, number: float) -> str:
    """Name a move by its number alone: k is the path of segment k, k + 1/2 the path at the corner after it."""
    return f"the path of segment {int(number)}" if number == int(number) else f"the path at {_corner(number)}"


def move_name(path: Path, row: int, surface: Path) -> str:
    """Name a move of a compensated path: along a segment, around a corner, or straight across a place too tight."""
    number = path.numbers[row].item()
    if number != int(number):
        arc = f"the corner arc after segment {int(number)}"
        return arc if path.turns[row] else f"the straight move across {_corner(number)}"
    segment = np.flatnonzero(surface.numbers == number)
    if len(segment) and surface.turns[segment[0]] and not path.turns[row]:
        return f"the straight move across segment {int(number)}"
    return f"the path of segment {int(number)}"


def _corner(number: float) -> str:
    return f"the corner after segment {int(number)}"


def verdict_findings(verdict: Verdict, surface: Path, names: Names = by_number) -> tuple[Finding, ...]:
    """Return the findings of a verdict: gouges, wrong side, crossings, then uncut stretches in the contour's order.

    `names` names the moves of the judged path.
    """
    if not verdict.judged:
        return (_unjudged(verdict.uneven_arc),)
    return (
        *(_gouge(gouge, names, verdict.radius) for gouge in verdict.gouges),
        *_wrong_side(verdict, surface),
        *_crossing(verdict),
        *_uncut_findings(verdict, surface),
    )


def contact_findings(air_cuts: Sequence[AirCut], backwards: Sequence[int]) -> tuple[Finding, ...]:
    """Return the findings on a path's air cuts and on its moves that run against the contour."""
    against: tuple[Finding, ...] = ()
    if backwards:
        count = len(backwards)
        text = f"{count} {'move runs' if count == 1 else 'moves run'} against the direction of the contour."
        against = (Finding("BACKWARDS", Severity.WARNING, text),)
    return (*against, *(_air_cut(stretch) for stretch in air_cuts))


def _air_cut(stretch: AirCut) -> Finding:
    return Finding(
        "AWAY",
        Severity.INFO,
        "{value} of path cuts air: {0} off the part at X {x} Y {y}.",
        segment=stretch.first_number,
        at=stretch.thickest,
        value=stretch.length,
        lengths=(stretch.thickness,),
    )


def _unjudged(arc: UnevenArc | None) -> Finding:
    """Return the finding that says why the path was not judged."""
    if arc is None:
        text = "Not judged: a coordinate or the tool radius is not a number, or too large for any machine."
        return Finding("UNJUDGED", Severity.ERROR, text)
    which = "segment" if arc.on_surface else "path of segment"
    if isfinite(arc.difference):
        text = f"Not judged: the arc's radii at start and end, in {which} {arc.number:g}, differ by {{value}}."
        return Finding("UNJUDGED", Severity.ERROR, text, segment=arc.number, value=arc.difference)
    text = f"Not judged: the arc in {which} {arc.number:g} may be empty or a full circle."
    return Finding("UNJUDGED", Severity.ERROR, text, segment=arc.number)


def or_more(gouge: Gouge, radius: float) -> str:
    """Return " or more" for a gouge in which the whole cutter is inside the part: its depth is not measured further."""
    return " or more" if gouge.depth >= 2.0 * radius else ""


def _gouge(gouge: Gouge, names: Names, radius: float) -> Finding:
    """Return the finding on a gouge: its segment is the surface's, `lengths` holds the length of path that gouges."""
    fine = gouge.depth < SMALLEST_SHOWN_LENGTH
    depth = "less than {1}" if fine else "{value}" + or_more(gouge, radius)
    move = names(gouge.path_piece, gouge.path_number)
    return Finding(
        "GOUGE",
        Severity.ERROR,
        f"GOUGE {depth} deep in segment {gouge.surface_number:g} at X {{x}} Y {{y}}, by {move}.",
        segment=gouge.surface_number,
        at=gouge.surface_at,
        value=gouge.depth,
        lengths=(gouge.extent, LAST_INCH_DIGIT) if fine else (gouge.extent,),
    )


def _wrong_side(verdict: Verdict, surface: Path) -> tuple[Finding, ...]:
    if not verdict.wrong_side:
        return ()
    moves = len(verdict.wrong_side)
    mostly = 2 * moves >= len(surface) or 2.0 * verdict.uncut_length >= verdict.surface_length
    count = f"{moves} {'move' if moves == 1 else 'moves'}"
    text = f"The cutter is on the wrong side for {count}. Check CUTTER COMP."
    if not mostly:
        # changing CUTTER COMP would put the rest of the path on the wrong side
        text = f"The path crosses the contour: {count} on the wrong side."
    return (Finding("WRONG_SIDE", Severity.ERROR, text),)


def _crossing(verdict: Verdict) -> tuple[Finding, ...]:
    if verdict.over_run is not None:
        return (_over_run(verdict.over_run),)
    if not verdict.crosses_itself:
        return ()
    text = "The contour crosses itself at X {x} Y {y}."
    return (Finding("CROSSES_ITSELF", Severity.WARNING, text, at=verdict.crossing_at),)


def enumerated(noun: str, numbers: Sequence[float]) -> str:
    """Return numbers as words of a sentence: `line 3`, `lines 3 and 4`, `lines 3, 4 and 9`."""
    *names, last = (f"{int(number)}" for number in dict.fromkeys(map(int, numbers)))
    return f"{noun}s {', '.join(names)} and {last}" if names else f"{noun} {last}"


def _over_run(over_run: OverRun) -> Finding:
    """Say that the contour's ends are leads; warn if they may be walls, or if START or the last end may be mistyped."""
    if not over_run.doubtful and over_run.lead_numbers:
        which = enumerated("segment", over_run.lead_numbers)
        text = f"Over-run at X {{x}} Y {{y}}. Taken for lead beyond it: {which}. Check that no wall is cut there."
        return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at)
    if not over_run.doubtful:
        text = "Over-run at X {x} Y {y}: the ends are lead-in and lead-out."
        return Finding("OVER_RUN", Severity.INFO, text, at=over_run.at)
    length, on = max(over_run.lead_in, over_run.lead_out), f"{over_run.last_number:g}"
    text = f"START is on segment {on}; the last {{value}}, past START, is taken for lead-out. Check START."
    if over_run.lead_in > over_run.lead_out:
        on = f"{over_run.first_number:g}"
        text = f"The contour ends on segment {on}; the first {{value}}, before it, is taken for lead-in. Check START."
    return Finding("OVER_RUN", Severity.WARNING, text, at=over_run.at, value=length)


def _uncut_findings(verdict: Verdict, surface: Path) -> Iterator[Finding]:
    """Yield the uncut stretches in the contour's order; equal inside corners sharper than the cutter share one."""
    corners_of_row = {corners[0]: corners for corners in _equal_corners(verdict, surface)}
    later = {row for corners in corners_of_row.values() for row in corners[1:]}
    for row, stretch in enumerate(verdict.uncut):
        if row in corners_of_row:
            yield _corners(tuple(verdict.uncut[corner] for corner in corners_of_row[row]))
        elif row not in later:
            yield _uncut(stretch, surface)


def _equal_corners(verdict: Verdict, surface: Path) -> list[list[int]]:
    """Group the uncut stretches at corners of two lines that are sharper than the cutter: rows of two or more alike.

    A cutter of radius r leaves (r - f) (1 / cos(t / 2) - 1) at a corner of two lines that turn by t with a rounding of
    radius f, 0 if it is sharp.  If a stretch has another thickness, its corner is not the only cause.
    """
    order, ends, count = surface.numbers.argsort(), verdict.uncut_ends, len(surface)
    first, last = (order[np.searchsorted(surface.numbers, number, sorter=order)] for number in (ends.first, ends.last))
    between, middle, arcs = (last - first) % count - 1, (first + 1) % count, surface.turns != 0
    corner = ~arcs[first] & ~arcs[last] & ((between == 0) | ((between == 1) & arcs[middle]))
    cosines = (surface.end_directions[first] * surface.start_directions[last]).sum(axis=1)
    roundings = np.where(between == 1, surface.radii[middle], 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = (verdict.radius - roundings) * (1.0 / np.sqrt((1.0 + cosines) / 2.0) - 1.0)
    thickness = np.array([stretch.thickness for stretch in verdict.uncut])
    # between opposite lines, or without a path, there is no number
    measured = np.flatnonzero(corner & np.isfinite(expected) & np.isfinite(thickness))
    rows = measured[np.abs(thickness[measured] - expected[measured]) <= STOCK]
    rows = rows[thickness[rows].argsort(kind="stable")]
    groups = np.split(rows, np.flatnonzero(np.diff(thickness[rows]) > GOUGE) + 1)
    return [sorted(group.tolist()) for group in groups if len(group) > 1]


def _corners(corners: Sequence[Uncut]) -> Finding:
    """Return one finding on equal inside corners sharper than the cutter, with the first one's segment and place."""
    named = ", ".join(f"{corner.first_number:g}-{corner.last_number:g}" for corner in corners[:MAX_NAMED_CORNERS])
    more = f" and {len(corners) - MAX_NAMED_CORNERS} more" if len(corners) > MAX_NAMED_CORNERS else ""
    areas = [corner.area for corner in corners if corner.area is not None]
    thick = "{0}" if corners[0].thickness >= SMALLEST_SHOWN_LENGTH else "less than {1}"
    return Finding(
        "UNCUT",
        Severity.INFO,
        f"{len(corners)} inside corners are sharper than the cutter: {thick} left in each, segments {named}{more}.",
        segment=corners[0].first_number,
        at=corners[0].thickest,
        value=sum(corner.length for corner in corners),
        lengths=(corners[0].thickness, LAST_INCH_DIGIT),
        area=sum(areas) if len(areas) == len(corners) else None,
    )


def _uncut(uncut: Uncut, surface: Path) -> Finding:
    """Return the finding on an uncut stretch, from its first segment to its last; `lengths` holds its thickness.

    Without a path there is no thickness.
    """
    where = _segments(uncut, surface)
    if isinf(uncut.thickness):
        text = f"UNCUT: nothing of {where} is cut. There is no path."
    else:
        thick = "{0}" if uncut.thickness >= SMALLEST_SHOWN_LENGTH else "less than {1}"
        text = f"UNCUT {thick} thick, {{value}} long, {where} at X {{x}} Y {{y}}."
    return Finding(
        "UNCUT",
        Severity.INFO,
        text,
        segment=uncut.first_number,
        at=uncut.thickest,
        value=uncut.length,
        lengths=() if isinf(uncut.thickness) else (uncut.thickness, LAST_INCH_DIGIT),
        area=uncut.area,
        last_segment=uncut.last_number,
    )


def _segments(uncut: Uncut, surface: Path) -> str:
    """Name the segments of a stretch, from the one it begins on to the one it ends on."""
    first, last = f"{uncut.first_number:g}", f"{uncut.last_number:g}"
    if first == last:
        return f"segment {first}"
    if uncut.first_number < uncut.last_number:
        return f"segments {first}-{last}"
    through = "" if uncut.first_number == surface.numbers[-1] else f"-{float(surface.numbers[-1]):g}"
    return f"segments {first}{through} and over START to {last}"
