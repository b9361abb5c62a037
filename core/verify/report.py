"""Report: a verdict as findings, in a machinist's words."""

from __future__ import annotations

from collections.abc import Sequence
from math import isinf
from typing import Final

from core.finding import Finding, Severity
from core.geometry.path import Path
from core.geometry.stretch import stretch_lengths
from core.tolerance import STOCK
from core.verify.contact import AirCut
from core.verify.names import Names, by_number
from core.verify.verdict import Gouge, Uncut, UncutStretches, Verdict

DIGIT: Final = 0.00254
"""Millimeters: the last digit of a form in inches."""

SHOWN: Final = DIGIT / 2.0
"""Lengths below this would be told as zeros."""

SHOWN_AREA: Final = 0.033
"""Square millimeters below which an area would be told as zeros in inches."""

Shares = list[tuple[float, float]]
"""Segments by their numbers, and how much of each."""

UNCUT: Final = "UNCUT"
"""The code of a stretch that stays uncut."""

LISTED: Final = 12
"""A stretch over more segments is told by its first and its last alone."""


def findings(verdict: Verdict, surface: Path, names: Names = by_number) -> tuple[Finding, ...]:
    """What the operator must know: errors first, then warnings, then what stays uncut in the contour's order.

    `names` says what the moves of the judged path are.
    """
    if not verdict.judged:
        return (_unjudged(),)
    return (
        *(_gouge(gouge, names, verdict.radius) for gouge in verdict.gouges),
        *_wrong_side(verdict),
        *_crosses_itself(verdict),
        *_uncut(verdict.uncut, surface),
    )


def contact_findings(air_cuts: Sequence[AirCut], backwards: Sequence[int]) -> tuple[Finding, ...]:
    """What an operator should see of a path's cuts in the air and of the rows that are traveled backwards."""
    against: tuple[Finding, ...] = ()
    if backwards:
        count = len(backwards)
        text = f"{count} {'move runs' if count == 1 else 'moves run'} against the direction of the contour."
        against = (Finding("BACKWARDS", Severity.WARNING, text),)
    return (*against, *(_air_cut(stretch) for stretch in air_cuts))


def _air_cut(stretch: AirCut) -> Finding:
    text = "{value} of path does not touch the part: at X {x} Y {y} the cutter is {0} off it."
    return Finding(
        "AWAY",
        Severity.INFO,
        text,
        segment=stretch.first_number,
        at=stretch.farthest,
        value=stretch.length,
        lengths=(stretch.beyond,),
    )


def _unjudged() -> Finding:
    text = (
        "The path cannot be judged: a coordinate or the tool radius is no number a machine can have, "
        "or an arc's radii at its start and its end differ."
    )
    return Finding("UNJUDGED", Severity.ERROR, text)


def or_more(gouge: Gouge, radius: float) -> str:
    """What is said behind a depth that is told no farther than all of the cutter is behind the surface."""
    return " or more" if gouge.depth >= 2.0 * radius else ""


def _gouge(gouge: Gouge, names: Names, radius: float) -> Finding:
    """The segment is the surface's; `lengths` holds the length of path that gouges."""
    move = names(gouge.path_piece, gouge.path_number)
    fine = gouge.depth < SHOWN
    depth = "less than {1}" if fine else "{value}" + or_more(gouge, radius)
    text = f"{move} gouges segment {_number(gouge.surface_number)} by {depth} at X {{x}} Y {{y}}, over {{0}} of path."
    return Finding(
        "GOUGE",
        Severity.ERROR,
        text,
        segment=gouge.surface_number,
        at=gouge.surface_at,
        value=gouge.depth,
        lengths=(gouge.extent, DIGIT) if fine else (gouge.extent,),
    )


def _number(number: float) -> str:
    return f"{number:g}"


def _wrong_side(verdict: Verdict) -> tuple[Finding, ...]:
    if not verdict.wrong_side:
        return ()
    moves = len(verdict.wrong_side)
    text = f"The cutter runs on the part's side of the contour, on {moves} {'move' if moves == 1 else 'moves'}."
    return (Finding("WRONG_SIDE", Severity.ERROR, text),)


def _crosses_itself(verdict: Verdict) -> tuple[Finding, ...]:
    if not verdict.crosses_itself:
        return ()
    text = "The contour crosses or touches itself at X {x} Y {y}: its over-run counts as surface too."
    return (Finding("CROSSES_ITSELF", Severity.WARNING, text, at=verdict.crossing_at),)


def _uncut(uncut: UncutStretches, surface: Path) -> Sequence[Finding]:
    """A finding for each stretch."""
    return [_told(one, shares, surface) for one, shares in zip(uncut, _shares(uncut, surface), strict=True)]


def _told(uncut: Uncut, shares: Shares, surface: Path) -> Finding:
    """The segment is the one the stretch begins on; `lengths` holds the largest thickness, then each share.

    There is no thickness where there is no path.
    """
    where = _segments(uncut, surface)
    lengths: tuple[float, ...] = ()
    if isinf(uncut.thickness):
        text = f"Nothing of {where} is cut: there is no path."
    else:
        told = ""
        if len(shares) > 1:
            listed = [f"segment {number:g} {{{row}}}" for row, (number, _) in enumerate(shares, 1)]
            told = f" ({', '.join(listed)})"
        thick = "{0}" if uncut.thickness >= SHOWN else f"less than {{{len(shares) + 1}}}"
        area = "" if uncut.area is None or uncut.area < SHOWN_AREA else ", area {area}"
        text = f"{{value}} of {where} stays uncut{told}, {thick} at the thickest, at X {{x}} Y {{y}}{area}."
        lengths = (uncut.thickness, *[length for _, length in shares], DIGIT)
    return Finding(
        UNCUT,
        Severity.INFO,
        text,
        segment=uncut.first_number,
        at=uncut.thickest,
        value=uncut.length,
        lengths=lengths,
        area=uncut.area,
    )


def _shares(uncut: UncutStretches, surface: Path) -> list[Shares]:
    """How much of each segment a stretch takes, in the contour's order; few enough to be read."""
    parts = stretch_lengths(surface, uncut.ends)
    return [[one for one in part if one[1] > STOCK] if len(part) <= LISTED else [] for part in parts]


def _segments(uncut: Uncut, surface: Path) -> str:
    """The segments a stretch lies on, from the one it begins on to the one it ends on."""
    first, last = _number(uncut.first_number), _number(uncut.last_number)
    if first == last:
        return f"segment {first}"
    if uncut.first_number < uncut.last_number:
        return f"segments {first} to {last}"
    return f"segments {first} to {_number(float(surface.numbers[-1]))} and on over START to {last}"
