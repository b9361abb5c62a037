"""Read-back runs a written program on its own control and compares its path with the intended one.

The control's path must match the block's within two of the last digits written or 0.001 mm, whichever is more.  A path
that differs passes only if it gouges nothing and leaves no more uncut than the block's, with a note that says how far
it differs; everything else is refused with the place and the reason.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot, tau
from typing import Final

import numpy as np

from core.controls.compared_contours import distances
from core.controls.compensation.elements import sweep
from core.controls.control_names import display_name
from core.controls.control_run import ControlRun, Stretch
from core.controls.control_tools import ToolTable
from core.controls.moves import Moves
from core.controls.registry import run
from core.controls.write.contour_pass import CenterMove, CompensatedPass, PassToWrite, WrittenLine, not_written
from core.finding import Finding, Severity
from core.geometry.path import Path, as_complex, coordinates
from core.geometry.piece import Point
from core.geometry.piece_arrays import even_centers
from core.units import Unit
from core.verify.judge import judge
from core.verify.verdict import Verdict

MIN_TOLERANCE: Final = 0.001
"""Millimeters by which the control's path may always differ."""

MAX_CENTER_SHIFT: Final = 0.01
"""Millimeters that an arc's center may move to even out its radii."""

MAX_COMPARED_PIECES: Final = 4000
"""Most pieces of a path that is compared if it differs; a longer one must match piece by piece."""


@dataclass(frozen=True, eq=False, slots=True)
class Intended:
    """A program as written, and the cuts it is for; `last_digit` is in millimeters.

    `leads`: the control's path has a move into the block's path and one out of it that the block's does not have.
    """

    control: str
    lines: tuple[WrittenLine, ...]
    cuts: tuple[PassToWrite, ...]
    tools: ToolTable
    unit: Unit
    last_digit: float
    leads: bool

    @property
    def control_name(self) -> str:
        """The control's name as operators know it."""
        return display_name(self.control)

    @property
    def text(self) -> str:
        """The text of the program."""
        return "\n".join(line.text for line in self.lines) + "\n"

    @property
    def tolerance(self) -> float:
        """Millimeters by which the control's path may differ without a note."""
        return max(MIN_TOLERANCE, 2 * self.last_digit)

    def segment(self, line: int | float | None) -> float | None:
        """Return the segment that a line of the program cuts."""
        return self.lines[int(line) - 1].segment if line and line <= len(self.lines) else None

    def located(self, finding: Finding, line: int | None) -> Finding:
        """Return a finding with the block and the segment that a line of the program cuts."""
        if not line or line > len(self.lines):
            return finding
        written = self.lines[line - 1]
        return replace(finding, segment=written.segment, block=written.block)


ComparedPaths = dict[tuple[int, bytes], Finding | None]
"""What comparing a path gave, by the block's path and the points of the control's."""


def read_back(intended: Intended, compared: ComparedPaths | None = None) -> tuple[Finding, ...]:
    """Return the control's answer to its program: errors if it is refused, and the notes on it.

    `compared` keeps the comparisons for another reading of a program that differs in its comments only.
    """
    made = run(intended.text.encode("ascii"), intended.control, intended.tools, intended.unit)
    stopped = _stopped(made, intended)
    if stopped:
        return stopped
    cuts = [cut for cut in intended.cuts if isinstance(cut, CompensatedPass)]
    if len(made.stretches) != len(cuts):
        return (not_written(f"The control makes {len(made.stretches)} compensated runs instead of {len(cuts)}."),)
    if (different := different_move(made, intended)) is not None:
        return (different,)
    compared = {} if compared is None else compared
    answers: ComparedPaths = {}
    for cut, stretch in zip(cuts, made.stretches, strict=True):
        moves = made.moves.part(stretch.first, stretch.last)
        key = (id(cut.compensated), moves.points[:, :2].tobytes())
        if not _level(made, stretch, cut, intended):
            return (not_written("A compensated run does not stay at its depth."),)
        if key not in compared:
            answer = compare_path(moves.path(), cut, intended)
            compared[key] = None if answer is None else replace(answer, block=cut.block)
        answers[key] = compared[key]
    findings = [answer for answer in answers.values() if answer is not None]
    errors = dict.fromkeys(answer for answer in findings if answer.severity is Severity.ERROR)
    differing = [answer for answer in findings if answer.severity is not Severity.ERROR]
    worst = sorted(differing, key=lambda note: note.lengths)[-1:]
    return (*errors, *worst, *_warnings(made, intended))


def different_move(made: ControlRun, intended: Intended) -> Finding | None:
    """Return an error if the control does not make a move without compensation as intended."""
    moves = made.moves
    here: Point | None = None
    for number, line in enumerate(intended.lines, 1):
        travel = line.travel
        if travel is None:
            continue
        before, here = here, (travel.x, travel.y)
        # the last move up to this line: a line to the tool's current position makes none
        row = int(np.searchsorted(moves.lines, number, side="right")) - 1
        differs = bool(moves.rapid[row]) != (travel.feed is None) or int(moves.turns[row]) != travel.turn
        if differs and (int(moves.lines[row]) == number or travel.turn):
            return not_written(f"{intended.control_name} runs line {number} of the program as a different move.")
        errors = np.abs(moves.points[row] - (travel.x, travel.y, travel.z))
        if travel.turn:
            center = np.abs(moves.centers[row, :2] - travel.center)
            errors = np.concatenate((errors, center, (_length_difference(moves, row, before, travel),)))
        # a comparison with NaN is false
        if not (errors <= intended.tolerance).all():
            text = f"{intended.control_name} ends line {number} of the program {{0}} off."
            return not_written(text, lengths=(float(errors.max()),))
    return None


def _length_difference(moves: Moves, row: int, before: Point | None, travel: CenterMove) -> float:
    """Return how far an arc's length differs in millimeters: a full turn if its ends became one point."""
    if before is None:
        return 0.0
    (x, y), (ex, ey) = moves.points[row - 1 : row + 1, :2].tolist()
    turned = sweep((x, y), (ex, ey), travel.center, travel.turn) or tau
    wanted = sweep(before, (travel.x, travel.y), travel.center, travel.turn) or tau
    return abs(turned - wanted) * hypot(travel.x - travel.center[0], travel.y - travel.center[1])


def _stopped(made: ControlRun, intended: Intended) -> tuple[Finding, ...]:
    """Return the alarms with the segments they belong to."""
    alarms = tuple(_alarm(finding, intended) for finding in made.findings if finding.severity is Severity.ERROR)
    return alarms or ((not_written("The control stops."),) if made.stopped_at is not None else ())


def _alarm(finding: Finding, intended: Intended) -> Finding:
    text = f"{intended.control_name} stops at line {finding.line} of the program, rule {finding.code}: {finding.text}"
    return intended.located(not_written(text, lengths=finding.lengths), finding.line)


def _warnings(made: ControlRun, intended: Intended) -> tuple[Finding, ...]:
    """Return the control's warnings, one for each rule."""
    first = {finding.code: finding for finding in reversed(made.findings) if finding.severity is Severity.WARNING}
    return tuple(
        intended.located(Finding(code, Severity.WARNING, finding.text, lengths=finding.lengths), finding.line)
        for code, finding in first.items()
    )


def _level(made: ControlRun, stretch: Stretch, cut: CompensatedPass, intended: Intended) -> bool:
    """True if all of a compensated run is at feed and at its depth."""
    rows = slice(stretch.first + 1, stretch.last)
    heights = made.moves.points[rows, 2]
    return not bool(made.moves.rapid[rows].any()) and bool((np.abs(heights - cut.depth) <= intended.tolerance).all())


def compare_path(made: Path, cut: CompensatedPass, intended: Intended) -> Finding | None:
    """Compare the control's path with the block's; return an error, a note if it differs, or None."""
    whole, tolerance = cut.compensated.with_leads, intended.tolerance
    inner = made.part(1, len(made) - 1) if intended.leads and len(made) > 2 else made
    if same_pieces(inner, whole, tolerance):
        apart, number = 0.0, 0.0
    elif max(len(inner), len(whole)) > MAX_COMPARED_PIECES:
        return not_written("The control's path differs, and is too long to compare.")
    else:
        # a distance measured from the block's path has no line of the program; the first one stands in for it
        first = float(inner.numbers[0]) if len(inner) else 0.0
        both = largest_distance(inner, whole), (largest_distance(whole, inner)[0], first)
        apart, number = both[int(np.argmax([distance for distance, _ in both]))]
    refused = _damage(made, inner, cut, intended, differs=not apart <= tolerance)
    if refused is not None or apart <= tolerance:
        return refused
    text = f"{intended.control_name} takes corners differently, by up to {{0}}. It does not gouge or leave more."
    return Finding("DIFFERS", Severity.WARNING, text, intended.segment(number), lengths=(apart,))


def same_pieces(made: Path, whole: Path, tolerance: float) -> bool:
    """True if two paths match piece by piece, apart from pieces of almost no length."""
    # a length of NaN is not short
    kept, wanted = ~(made.lengths <= tolerance), ~(whole.lengths <= tolerance)
    if int(kept.sum()) != int(wanted.sum()) or not np.array_equal(made.turns[kept], whole.turns[wanted]):
        return False
    ends = np.abs(made.ends[kept] - whole.ends[wanted]), np.abs(made.starts[kept] - whole.starts[wanted])
    centers = np.abs(made.centers[kept] - whole.centers[wanted])[whole.turns[wanted] != 0]
    return all(float(difference.max(initial=0.0)) <= tolerance for difference in (*ends, centers))


def largest_distance(path: Path, other: Path) -> tuple[float, float]:
    """Return the largest distance of a path's ends, quarters and middles from another path, and the piece's number.

    NaN counts as the largest distance; of several pieces equally far off the first one counts.
    """
    if not path.lengths.any() or not other.lengths.any():
        return (np.inf, 0.0) if path.lengths.any() or other.lengths.any() else (0.0, 0.0)
    apart, rows = distances(path, other, (0.0, 0.25, 0.5, 0.75, 1.0))
    worst = int(apart.argmax())
    return float(apart[worst]), float(path.numbers[rows[worst]])


def _damage(made: Path, inner: Path, cut: CompensatedPass, intended: Intended, *, differs: bool) -> Finding | None:
    """Return what the control's path does wrong: leads that cut, and if it differs, gouges and uncut surface."""
    contour, side = cut.compensated.contour, cut.compensated.side
    verdicts = [judge(contour, side, *judged) for judged in _judged_paths(made, inner, cut, differs=differs)]
    if not all(verdict.judged for verdict in verdicts):
        return not_written("The control's path cannot be judged.")
    if not verdicts:
        return None
    worst = max(verdicts, key=lambda verdict: verdict.depth)
    if worst.depth > intended.tolerance or (differs and worst.wrong_side):
        text = f"{intended.control_name} compensates this differently, and its path gouges the part by {{0}}."
        if not differs:
            text = f"The move into the cut or out of it, as {intended.control_name} needs it, gouges the part by {{0}}."
        segment = worst.gouges[0].surface_number if worst.gouges else None
        return not_written(text, segment, lengths=(worst.depth,))
    planned = judge(contour, side, cut.diameter / 2, cut.compensated.with_leads) if differs else verdicts[0]
    if not planned.judged:
        return not_written("The block's path cannot be judged.")
    if (more := _length_left(verdicts[0], intended) - _length_left(planned, intended)) > intended.tolerance:
        text = "compensates this differently, and its path leaves {0} more of the contour uncut."
        first = verdicts[0].uncut[0].first_number
        return not_written(f"{intended.control_name} {text}", first, lengths=(more,))
    return None


def _judged_paths(made: Path, inner: Path, cut: CompensatedPass, *, differs: bool) -> list[tuple[float, Path]]:
    """Return the radii and paths to judge: a path that differs as a whole, with its stock too; else the leads alone."""
    size = cut.diameter / 2
    if differs:
        return [(size, _evened(made)), *([(cut.compensated.radius, _evened(inner))] if cut.stock else [])]
    return [] if made is inner else [(size, made.part(0, 1)), (size, made.part(len(made) - 1, len(made)))]


def _evened(path: Path) -> Path:
    """Return the path with equal radii at both ends of each arc whose ends and center rounding has moved."""
    rows = path.turns.nonzero()[0]
    points, centers = as_complex(path.points), as_complex(path.centers).copy()
    moved, _ = even_centers(points[rows], points[rows + 1], centers[rows], path.turns[rows])
    centers[rows] = np.where(np.abs(moved - centers[rows]) <= MAX_CENTER_SHIFT, moved, centers[rows])
    return Path.of(path.points, coordinates(centers), path.turns, path.numbers)


def _length_left(verdict: Verdict, intended: Intended) -> float:
    """Return the length of surface left uncut, without what rounding alone leaves."""
    return sum(stretch.length for stretch in verdict.uncut if stretch.thickness > intended.tolerance)
