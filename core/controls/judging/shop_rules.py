"""Shop rules for turning compensation on and off are checked on any control's run on request.

They are habits for every control: compensation goes on and off in a move of one axis, square to a move of one axis, at
full depth, clear of the component.  The component is what is programmed under compensation.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.stretch_paths import programmed_surface
from core.controls.moves import Moves
from core.finding import Finding, Severity
from core.geometry.distance import distance
from core.geometry.path import Floats, Path, point_of_row
from core.geometry.piece import Point, Side
from core.geometry.piece_arrays import piece_arrays
from core.tolerance import JOINED

MAX_SQUARE_COSINE: Final = 1e-6
"""Largest cosine between two directions at right angles."""


@dataclass(frozen=True, slots=True)
class PlaneMove:
    """A move in the plane: its start, its end and its source line."""

    start: Point
    end: Point
    line: int

    @property
    def axes(self) -> int:
        """The number of the plane's axes that move."""
        return sum(abs(b - a) > JOINED for a, b in zip(self.start, self.end, strict=True))

    def square_to(self, direction: Floats) -> bool:
        """True if the move is at right angles to a unit direction (2,)."""
        run = np.subtract(self.end, self.start)
        return bool(abs(run @ direction) <= MAX_SQUARE_COSINE * np.hypot(*run))


def check_shop_rules(run: ControlRun) -> tuple[Finding, ...]:
    """Return the findings of the shop rules H1 to H9 on a run, by line."""
    findings = [finding for stretch in run.stretches for finding in _stretch(run.moves, stretch)]
    return tuple(sorted(findings, key=lambda finding: (finding.line or 0, finding.code)))


def _stretch(moves: Moves, stretch: Stretch) -> list[Finding]:
    if len(stretch.programmed) <= stretch.entry:
        return []
    contour = programmed_surface(stretch)
    findings = [*_depths(moves, stretch), _side(stretch)]
    if not len(contour):
        return findings
    entry, leave = _entry(stretch), _exit(moves, stretch, contour)
    if not stretch.led_in:
        findings += _turning(entry, contour, on=True)
    findings += _clear("H2", entry.start, contour, stretch, entry.line)
    if leave is not None:
        if not stretch.led_out:
            findings += _turning(leave, contour, on=False)
        findings += _clear("H6", leave.start, contour.part(0, len(contour) - 1), stretch, int(contour.numbers[-1]))
    return findings


def _entry(stretch: Stretch) -> PlaneMove:
    """Return the programmed move that applies compensation."""
    first, second, _ = stretch.plane.axes
    points, row = stretch.programmed.points[:, [first, second]], stretch.entry
    return PlaneMove(point_of_row(points[row - 1]), point_of_row(points[row]), int(stretch.programmed.lines[row]))


def _exit(moves: Moves, stretch: Stretch, contour: Path) -> PlaneMove | None:
    """Return the programmed move that cancels compensation; None if there is none."""
    row = stretch.last - 1
    line = int(moves.lines[row])
    if not stretch.exit and line == int(stretch.programmed.lines[-1]):
        return None
    first, second, _ = stretch.plane.axes
    end = point_of_row(moves.points[row, [first, second]])
    return PlaneMove(point_of_row(contour.points[-1]), end, line)


def _turning(move: PlaneMove, contour: Path, *, on: bool) -> list[Finding]:
    """Check H3 and H4 where compensation turns on before the contour, H7 and H8 where it turns off after it."""
    verb, piece, findings = "on" if on else "off", 0 if on else -1, []
    if move.axes != 1:
        text = f"Compensation turns {verb} in a two-axis move; use a one-axis move, X or Y."
        findings.append(_warn("H4" if on else "H8", text, move.line))
    which, where, what = ("move after", "before", "next") if on else ("last move before", "after", "last")
    direction = contour.start_directions[0] if on else contour.end_directions[-1]
    run = contour.ends[piece] - contour.starts[piece]
    if contour.turns[piece] or np.min(np.abs(run)) > JOINED:
        text = f"The {which} compensation turns {verb} is not along one axis. Add a one-axis move {where} it."
        findings.append(_warn("H3" if on else "H7", text, int(contour.numbers[piece])))
    elif not move.square_to(direction):
        how = "start square to it" if on else "leave square to it"
        text = f"Compensation does not turn {verb} at 90 degrees to the {what} move; {how}."
        findings.append(_warn("H3" if on else "H7", text, move.line))
    return findings


def _clear(rule: str, at: Point, component: Path, stretch: Stretch, line: int) -> list[Finding]:
    """Check H2 and H6: the tool is a diameter clear of the part before and after the contour, if possible."""
    away = float(np.min(distance(piece_arrays(component), np.full(len(component), complex(*at))), initial=np.inf))
    if away >= 2.0 * stretch.radius - JOINED:
        return []
    where = "start before compensation turns on" if rule == "H2" else "finish before compensation turns off"
    text = f"The {where} is {{0}} from the part. Keep it a cutter diameter ({{1}}) away if you can."
    return [Finding(rule, Severity.WARNING, text, lengths=(away, 2.0 * stretch.radius), line=line, column=1)]


def _depths(moves: Moves, stretch: Stretch) -> list[Finding]:
    """Check H1 and H5: the tool axis moves only before compensation and after it, or once at its start."""
    height = stretch.plane.axes[2]
    programmed = stretch.programmed
    heights = programmed.points[:, height]
    sinking = np.flatnonzero(heights[1:] != heights[:-1]) + 1
    contour = np.flatnonzero(programmed.moving_in(stretch.plane)[stretch.entry + 1 :])
    begin = stretch.entry + 1 + int(contour[0]) if len(contour) else len(programmed)
    early = programmed.lines[sinking[sinking < begin]].tolist()
    text = "The tool reaches depth after compensation turns on. One such move is allowed; before it is better."
    findings = [Finding("H1", Severity.INFO, text, line=line, column=1) for line in early[:1]]
    text = "The tool axis moves again after compensation turns on. Move it to its final depth before."
    findings += [_warn("H1", text, line) for line in early[1:]]
    late = programmed.lines[sinking[sinking >= begin]].tolist()
    if not stretch.exit and len(late) == 0 and moves.points[stretch.last - 1, height] != heights[-1]:
        late.append(int(moves.lines[stretch.last - 1]))
    text = "The tool axis moves under compensation. Move it after compensation turns off."
    return findings + [_warn("H5", text, line) for line in dict.fromkeys(late)]


def _side(stretch: Stretch) -> Finding:
    climb = "left (RL, G41), climb" if stretch.side is Side.LEFT else "right (RR, G42), conventional"
    text = f"The tool runs {climb} milling with a right-hand cutter; to leave material add to the radius offset {{0}}."
    line = int(stretch.programmed.lines[stretch.entry])
    return Finding("H9", Severity.INFO, text, lengths=(stretch.radius,), line=line, column=1)


def _warn(rule: str, text: str, line: int) -> Finding:
    return Finding(rule, Severity.WARNING, text, line=line, column=1)
