"""Compared controls show which controls run a program, stop or gouge, and where their paths part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.controls.compared_contours import MAX_SAME_DISTANCE, Parting, apart
from core.controls.contour_translation import run_by_contour
from core.controls.control_run import ControlRun, Stretch
from core.controls.control_tools import ToolTable
from core.controls.iso.flow import ProgramLibrary, no_library
from core.controls.judging.judged_contour import JudgedContour
from core.controls.judging.judged_runs import judge_run
from core.controls.moves import Moves
from core.controls.registry import compared, reads, run, run_with_tiny_tool
from core.controls.write.read_back import MIN_TOLERANCE
from core.controls.write.rewritten_stretch import NotTranslated
from core.geometry.path import EMPTY, Floats, Path
from core.progress import Progress, part, silent
from core.units import Unit

RUN_SHARE: Final = 0.3
"""The share of a control's progress that the run takes; its verdicts take the rest."""

MAX_POINT_PAIRS: Final = 1_000_000
"""Most pairs of points that are measured for one line."""


@dataclass(frozen=True, eq=False, slots=True)
class Compared:
    """A control's run of the program, and its verdicts.

    `parting` is where its path leaves that of the control `reference`; None if it does not.  If this control does not
    read the program's language, it has run the contour as the control `contour_of` reads it.
    """

    control: str
    run: ControlRun
    results: tuple[JudgedContour, ...]
    parting: Parting | None
    contour_of: str = ""
    reference: str = ""


@dataclass(frozen=True, slots=True)
class OtherLanguage:
    """A control that does not read the program's language, and why its contour is not compared either."""

    control: str
    why: str = ""


def compare(
    text: bytes,
    tools: ToolTable,
    unit: Unit | None = None,
    library: ProgramLibrary = no_library,
    reference: str = "",
    progress: Progress = silent,
) -> tuple[Compared | OtherLanguage, ...]:
    """Run the program on every control, in the registry's order; `unit` applies if it names none, inches by default.

    The `reference`, by its full name, comes first, and the others are compared with it if it runs the program.  A
    control of another language gets the contour as the first control reads it that runs the program to its end.  If
    none does, a control that stops because of the tool's radius reads it with a thinner tool.
    """
    first: ControlRun | None = None
    rows: list[Compared | OtherLanguage] = []
    controls = tuple(dict.fromkeys((reference, *compared()) if reference else compared()))
    for number, control in enumerate(controls):
        of_this = part(progress, number / len(controls), (number + 1) / len(controls))
        if not reads(control, text):
            rows.append(OtherLanguage(control))
            continue
        done = run(text, control, tools, unit or Unit.IN, library, progress=part(of_this, 0.0, RUN_SHARE))
        where = None if first is None else parting(first.moves, done.moves)
        results = judge_run(done, part(of_this, RUN_SHARE, 1.0))
        rows.append(Compared(control, done, results, where, reference="" if first is None else first.control))
        if first is None and done.stopped_at is None:
            first = done
    whole = first or next(filter(None, (run_with_tiny_tool(text, row.control, tools) for row in rows)), None)
    return tuple(
        _by_contour(row.control, whole, paths=first is not None) if isinstance(row, OtherLanguage) else row
        for row in rows
    )


def _by_contour(control: str, first: ControlRun | None, *, paths: bool) -> Compared | OtherLanguage:
    """Run the first run's contours on a control of another language; `paths`: also find where the paths part."""
    if first is None:
        return OtherLanguage(control, "no control runs this program to the end")
    made = run_by_contour(first, control)
    if isinstance(made, NotTranslated):
        return OtherLanguage(control, made.text)
    done, digit = made
    where = _centers_part(first, done, max(MIN_TOLERANCE, 2 * digit)) if paths else None
    return Compared(control, done, judge_run(done), where, first.control, first.control)


def _centers_part(first: ControlRun, other: ControlRun, tolerance: float) -> Parting | None:
    """Return where the paths along the contours of two runs part, without leads; the other may have stopped early."""
    for ours, theirs in zip(first.stretches, other.stretches, strict=False):
        lines = set(theirs.programmed.lines.tolist())
        path, other_path = _along(first, ours, lines), _along(other, theirs, lines)
        where = apart(other_path, path, tolerance)
        if where is None and other.stopped_at is None:
            where = apart(path, other_path, tolerance)
        if where is not None:
            return where
    return None


def _along(done: ControlRun, stretch: Stretch, lines: set[int]) -> Path:
    """Return a stretch's path from the first to the last piece that belongs to a line of the contour."""
    path = done.moves.part(stretch.first, stretch.last).path(stretch.plane)
    rows = [row for row, line in enumerate(path.numbers.tolist()) if line and int(line) in lines]
    return path.part(rows[0], rows[-1] + 1) if rows else EMPTY


def parting(first: Moves, other: Moves) -> Parting | None:
    """Return where two lists of moves of one program part, line by line; None if all lines that both have agree.

    Each point that a line's moves go through is compared with the nearest one of the other list.
    """
    ours, theirs = _points_by_line(first), _points_by_line(other)
    distances = {line: _distance(ours[line], theirs[line]) for line in sorted(ours.keys() & theirs.keys())}
    lines = [line for line, distance in distances.items() if distance > MAX_SAME_DISTANCE]
    if not lines:
        return None
    farthest = max(lines, key=distances.__getitem__)
    return Parting(lines[0], farthest, distances[farthest])


def _points_by_line(moves: Moves) -> dict[int, Floats]:
    """Return for each line the points (n, 3) at which its moves begin and end."""
    order = np.argsort(moves.lines[1:], kind="stable") + 1
    lines = moves.lines[order]
    groups = np.split(order, np.flatnonzero(np.diff(lines)) + 1) if len(order) else []
    return {int(moves.lines[rows[0]]): np.vstack((moves.points[rows - 1], moves.points[rows])) for rows in groups}


def _distance(first: Floats, other: Floats) -> float:
    """Return how far apart the points (n, 3) of two lines are at most; of very many points only the last ones count."""
    if len(first) * len(other) > MAX_POINT_PAIRS:
        return float(np.linalg.norm(first[-1] - other[-1]))
    between = np.linalg.norm(first[:, None, :] - other[None, :, :], axis=2)
    return float(max(between.min(axis=0).max(), between.min(axis=1).max()))
