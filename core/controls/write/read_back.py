"""A written program read back by its own control, before anybody gets it: is the path the one that was meant?

The control's path has to be the block's within two of the last digits written, a thousandth of a millimeter at least.
A path that differs is let through only where it gouges nothing and leaves nothing more uncut than the block's, and
then with a note that says how far it differs; everything else is refused with the place and the reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, tau
from typing import Final

import numpy as np

from core.controls.compensation.corners import sweep
from core.controls.control_run import Run, Stretch
from core.controls.control_tools import ToolTable
from core.controls.moves import Moves
from core.controls.registry import UnknownControl, run
from core.controls.write.programmed_contour import Cut, Line, Plain, Travel, refusal
from core.finding import Finding, Severity
from core.geometry.distance import distance
from core.geometry.path import Path
from core.geometry.piece import Point
from core.geometry.piece_arrays import at, piece_arrays
from core.units import Unit
from core.verify.judge import judge
from core.verify.verdict import Verdict

LEAST: Final = 0.001
"""Millimeters by which the control's path may always differ."""

MOST_MOVED: Final = 0.01
"""Millimeters by which an arc's center may be moved to even out its radii."""

PIECES: Final = 4000
"""Pieces of a path up to which paths that differ are compared; a longer one has to be the same piece by piece."""


@dataclass(frozen=True, eq=False, slots=True)
class Meant:
    """A program that was written, what for, and how fine: `last_digit` in millimeters.

    `leads`: the control's path has a move into the block's path and one out of it that are not the block's.
    """

    control: str
    lines: tuple[Line, ...]
    cuts: tuple[Cut | Plain, ...]
    tools: ToolTable
    unit: Unit
    last_digit: float
    leads: bool

    @property
    def text(self) -> str:
        """The program."""
        return "\n".join(line.text for line in self.lines) + "\n"

    @property
    def tolerance(self) -> float:
        """Millimeters by which the control's path may differ without a word."""
        return max(LEAST, 2 * self.last_digit)

    def segment(self, line: int | float | None) -> float | None:
        """The segment a line of the program cuts."""
        return self.lines[int(line) - 1].segment if line and line <= len(self.lines) else None


@dataclass(frozen=True, slots=True)
class Told:
    """Why a program may not be handed out, and what is to be said with one that may."""

    errors: tuple[Finding, ...] = ()
    notes: tuple[Finding, ...] = ()


def read_back(meant: Meant) -> Told:
    """What the control does with the program."""
    made = run(meant.text.encode("ascii"), meant.control, meant.tools, meant.unit)
    assert not isinstance(made, UnknownControl), made.text
    stopped = _stopped(made, meant)
    if stopped:
        return Told(stopped)
    cuts = [cut for cut in meant.cuts if isinstance(cut, Cut)]
    if len(made.stretches) != len(cuts):
        text = f"The control makes {len(made.stretches)} compensated runs of {len(cuts)}."
        return Told((refusal(text),))
    if (other := _other_move(made, meant)) is not None:
        return Told((other,))
    told: dict[tuple[int, bytes], Told] = {}
    for cut, stretch in zip(cuts, made.stretches, strict=True):
        moves = made.moves.part(stretch.first, stretch.last)
        key = (id(cut.compensated), moves.points[:, :2].tobytes())
        if not _level(made, stretch, cut, meant):
            return Told((refusal("A compensated run does not stay at its depth."),))
        if key not in told:
            told[key] = _compared(moves.path(), cut, meant)
    errors = tuple(dict.fromkeys(one for each in told.values() for one in each.errors))
    differing = [one for each in told.values() for one in each.notes]
    worst = sorted(differing, key=lambda one: one.lengths)[-1:]
    return Told(errors, (*worst, *_warnings(made, meant)))


def _other_move(made: Run, meant: Meant) -> Finding | None:
    """A move without compensation that the control does not make as it was meant."""
    moves = made.moves
    here: Point | None = None
    for number, line in enumerate(meant.lines, 1):
        travel = line.travel
        if travel is None:
            continue
        before, here = here, (travel.x, travel.y)
        # the last move up to this line: a line that leads to where the tool stands already makes none
        row = int(np.searchsorted(moves.lines, number, side="right")) - 1
        other = bool(moves.rapid[row]) != (travel.feed is None) or int(moves.turns[row]) != travel.turn
        if other and (int(moves.lines[row]) == number or travel.turn):
            return refusal(f"{meant.control} makes another move of line {number} of the program.")
        offs = np.abs(moves.points[row] - (travel.x, travel.y, travel.z))
        if travel.turn:
            aside = np.abs(moves.centers[row, :2] - travel.center)
            offs = np.concatenate((offs, aside, (_longer(moves, row, before, travel),)))
        # what is no number is not near
        if not (offs <= meant.tolerance).all():
            text = f"{meant.control} ends line {number} of the program {{0}} elsewhere."
            return refusal(text, lengths=(float(offs.max()),))
    return None


def _longer(moves: Moves, row: int, before: Point | None, travel: Travel) -> float:
    """Millimeters by which an arc is not as long as it was meant: by a turn, where its ends became one point."""
    if before is None:
        return 0.0
    (x, y), (ex, ey) = moves.points[row - 1 : row + 1, :2].tolist()
    turned = sweep((x, y), (ex, ey), travel.center, travel.turn) or tau
    meant = sweep(before, (travel.x, travel.y), travel.center, travel.turn) or tau
    return abs(turned - meant) * hypot(travel.x - travel.center[0], travel.y - travel.center[1])


def _stopped(made: Run, meant: Meant) -> tuple[Finding, ...]:
    """The alarms, with the segments they belong to."""
    alarms = [one for one in made.findings if one.severity is Severity.ERROR]
    if made.stopped_at is not None or alarms:
        return tuple(_alarm(one, meant) for one in alarms) or (refusal("The control stops."),)
    return ()


def _alarm(one: Finding, meant: Meant) -> Finding:
    text = f"{meant.control} stops at line {one.line} of the program, rule {one.code}: {one.text}"
    return refusal(text, meant.segment(one.line), lengths=one.lengths)


def _warnings(made: Run, meant: Meant) -> tuple[Finding, ...]:
    """The control's warnings, each rule once."""
    first = {one.code: one for one in reversed(made.findings) if one.severity is Severity.WARNING}
    return tuple(
        Finding(code, Severity.WARNING, one.text, meant.segment(one.line), lengths=one.lengths)
        for code, one in first.items()
    )


def _level(made: Run, stretch: Stretch, cut: Cut, meant: Meant) -> bool:
    """All of a compensated run is at feed and at its depth."""
    rows = slice(stretch.first + 1, stretch.last)
    heights = made.moves.points[rows, 2]
    return not bool(made.moves.rapid[rows].any()) and bool((np.abs(heights - cut.depth) <= meant.tolerance).all())


def _compared(made: Path, cut: Cut, meant: Meant) -> Told:
    """The path the control makes, against the block's."""
    whole, tolerance = cut.compensated.whole, meant.tolerance
    inner = made.part(1, len(made) - 1) if meant.leads and len(made) > 2 else made
    if same(inner, whole, tolerance):
        apart, number = 0.0, 0.0
    elif max(len(inner), len(whole)) > PIECES:
        return Told((refusal("The control's path differs, and is too long for finding out how far."),))
    else:
        both = farthest(inner, whole), _by_segment(farthest(whole, inner), inner)
        apart, number = both[int(np.argmax([one for one, _ in both]))]
    trouble = _trouble(made, inner, cut, meant, moved=not apart <= tolerance)
    if trouble is not None:
        return Told((trouble,))
    if apart <= tolerance:
        return Told()
    text = f"{meant.control} goes round corners its own way, up to {{0}} off the block's path;"
    text += " its path gouges nothing and leaves nothing more."
    return Told((), (Finding("DIFFERS", Severity.WARNING, text, meant.segment(number), lengths=(apart,)),))


def _by_segment(found: tuple[float, float], inner: Path) -> tuple[float, float]:
    """A distance found from the block's side; it has no line, so the first one of the path stands for it."""
    return found[0], float(inner.numbers[0]) if len(inner) else 0.0


def same(made: Path, whole: Path, tolerance: float) -> bool:
    """Are two paths the same piece by piece, but for pieces of next to no length?"""
    kept, meant = made.lengths > tolerance, whole.lengths > tolerance
    if int(kept.sum()) != int(meant.sum()) or not np.array_equal(made.turns[kept], whole.turns[meant]):
        return False
    ends = np.abs(made.ends[kept] - whole.ends[meant]), np.abs(made.starts[kept] - whole.starts[meant])
    middles = np.abs(made.centers[kept] - whole.centers[meant])[whole.turns[meant] != 0]
    return all(float(one.max(initial=0.0)) <= tolerance for one in (*ends, middles))


def farthest(path: Path, other: Path) -> tuple[float, float]:
    """How far the ends and middles of a path's pieces lie from another path at most, and the number of that piece.

    A distance that is no number is farther than any other; of several pieces as far off it is that of the first place.
    """
    pieces, onto = piece_arrays(path), piece_arrays(other)
    if not len(pieces) or not len(onto):
        return (np.inf, 0.0) if len(pieces) or len(onto) else (0.0, 0.0)
    places = np.concatenate([at(pieces, np.full(len(pieces), part)) for part in (0.0, 0.25, 0.5, 0.75, 1.0)])
    apart = np.array([np.min(distance(onto, np.full(len(onto), place))) for place in places])
    most = int(apart.argmax())
    return float(apart[most]), float(path.numbers[pieces.rows[most % len(pieces)]])


def _trouble(made: Path, inner: Path, cut: Cut, meant: Meant, *, moved: bool) -> Finding | None:
    """What the control's path does wrong: leads that cut, and where it is another path, gouges and what is left."""
    verdicts = [
        judge(cut.compensated.contour, cut.compensated.side, *one) for one in _runs(made, inner, cut, moved=moved)
    ]
    if not all(verdict.judged for verdict in verdicts):
        return refusal("The control's path cannot be judged.")
    if not verdicts:
        return None
    worst = max(verdicts, key=_depth)
    if worst.depth > meant.tolerance or (moved and worst.wrong_side):
        text = f"{meant.control} compensates this another way, and its path gouges the part by {{0}}."
        if not moved:
            text = f"The move into the cut or out of it, as {meant.control} needs it, gouges the part by {{0}}."
        segment = worst.gouges[0].surface_number if worst.gouges else None
        return refusal(text, segment, lengths=(worst.depth,))
    if moved and (short := _left(verdicts[0], meant) - _left(_own_verdict(cut), meant)) > meant.tolerance:
        text = f"{meant.control} compensates this another way, and its path leaves {{0}} more of the contour uncut."
        return refusal(text, verdicts[0].uncut[0].first_number, lengths=(short,))
    return None


def _runs(made: Path, inner: Path, cut: Cut, *, moved: bool) -> list[tuple[float, Path]]:
    """What is to be judged, with the radius for it: everything of another path, its stock too, or the leads alone."""
    size = cut.diameter / 2
    if not moved:
        return [(size, made.part(0, 1)), (size, made.part(len(made) - 1, len(made)))] if made is not inner else []
    return [(size, _evened(made)), *([(cut.compensated.radius, _evened(inner))] if cut.stock else [])]


def _evened(path: Path) -> Path:
    """The path with the radii of each arc, which rounding has parted, made one: its center moves along the chord."""
    chord = path.ends - path.starts
    size = np.hypot(chord[:, 0], chord[:, 1])
    unit = chord / np.where(size == 0.0, 1.0, size)[:, None]
    aside = np.einsum("ij,ij->i", path.centers - (path.starts + path.ends) / 2, unit)
    small = (path.turns != 0) & (np.abs(aside) <= MOST_MOVED)
    centers = path.centers - np.where(small, aside, 0.0)[:, None] * unit
    return Path.of(path.points, centers, path.turns, path.numbers)


def _depth(verdict: Verdict) -> float:
    return verdict.depth


def _left(verdict: Verdict, meant: Meant) -> float:
    """Length of surface left, without what only rounding leaves."""
    return sum(stretch.length for stretch in verdict.uncut if stretch.thickness > meant.tolerance)


def _own_verdict(cut: Cut) -> Verdict:
    """On the block's own path."""
    one = cut.compensated
    return judge(one.contour, one.side, cut.diameter / 2, one.whole)
