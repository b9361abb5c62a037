"""Where LinuxCNC's compensated paths differ from ours, by segments, and the named rules that explain it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from math import ceil, dist, floor, inf, pi
from pathlib import Path as File
from typing import Final

import numpy as np

from core.comp.best_path.best_path import BestPath
from core.comp.compensated import Compensated
from core.comp.crossings import crossings
from core.comp.offset import RawPart as ChainPart
from core.comp.offset import offset
from core.geometry.path import Path
from core.geometry.piece import Arc, Line, Piece, Side, Turn
from core.tolerance import JOINED
from core.verify.judge import judge
from tests.core.verify.oracle import apart, least
from tests.reports.linuxcnc_contours import RADIUS, Part, corner_angle
from tests.rs274 import MOVE, process

PRINTED: Final = 2e-4
"""Points of two paths this near, in millimeters beside a cutter of 200, are one: LinuxCNC prints four decimals."""

SHORT: Final = 1e-3
"""Pieces shorter than this are left out of both paths: their ends can hardly be told apart in print."""


@dataclass(frozen=True)
class Difference:
    """Our pieces and theirs that stand for one another, and the numbers of our pieces before and behind them."""

    ours: tuple[Piece, ...]
    theirs: tuple[Piece, ...]
    first: float
    last: float


def differences(path: Path, theirs: Sequence[Piece]) -> list[Difference]:
    """Every difference of our path from theirs, along the way; none if they are the same."""
    numbered = [(piece, number) for piece, number in zip(path, path.numbers.tolist(), strict=True) if _long(piece)]
    ours, numbers = [piece for piece, _ in numbered], [-inf, *(number for _, number in numbered), inf]
    theirs = [piece for piece in theirs if _long(piece)]
    found, at = [], (0, 0)
    for i, j in [*_common(ours, theirs), (len(ours), len(theirs))]:
        if (i, j) != at:
            some = Difference(tuple(ours[at[0] : i]), tuple(theirs[at[1] : j]), numbers[at[0]], numbers[i + 1])
            found.append(some)
        at = (i + 1, j + 1)
    return found


def _long(piece: Piece) -> bool:
    """Whether a piece is long enough to be compared; an arc whose ends are one point in print is a full circle."""
    return dist(piece.start, piece.end) > SHORT or (isinstance(piece, Arc) and piece.length > SHORT)


def same(one: Piece, two: Piece) -> bool:
    """Whether two pieces are one to the printed decimals."""
    near = dist(one.start, two.start) < PRINTED and dist(one.end, two.end) < PRINTED
    if not near or isinstance(one, Arc) is not isinstance(two, Arc):
        return False
    if isinstance(one, Arc) and isinstance(two, Arc):
        return one.turn is two.turn and dist(one.center, two.center) < PRINTED
    return True


def _common(ours: Sequence[Piece], theirs: Sequence[Piece]) -> list[tuple[int, int]]:
    """The longest common sequence, as rows of both."""
    best = [[0] * (len(theirs) + 1) for _ in range(len(ours) + 1)]
    for i in reversed(range(len(ours))):
        for j in reversed(range(len(theirs))):
            longer = max(best[i + 1][j], best[i][j + 1])
            best[i][j] = best[i + 1][j + 1] + 1 if same(ours[i], theirs[j]) else longer
    return _walked(best, ours, theirs)


def _walked(best: list[list[int]], ours: Sequence[Piece], theirs: Sequence[Piece]) -> list[tuple[int, int]]:
    i = j = 0
    found = []
    while i < len(ours) and j < len(theirs):
        if best[i][j] == best[i + 1][j]:
            i += 1
        elif best[i][j] == best[i][j + 1]:
            j += 1
        else:
            found.append((i, j))
            i, j = i + 1, j + 1
    return found


HEAD = "G21 G17 G40 G49 G80 G90 G91.1 G94 F1000\nG0 X0 Y0 Z-1\n"


@dataclass(frozen=True)
class Witnessed:
    """LinuxCNC's path beside a contour, or the sentence with which it refused."""

    path: tuple[Piece, ...]
    refusal: str


def witnessed(parts: Sequence[Part], folder: File) -> list[Witnessed]:
    """What LinuxCNC makes of every part, in their order."""
    found: list[Witnessed] = []
    while len(found) < len(parts):
        text = HEAD + "".join(_blocks(part, row) for row, part in enumerate(parts[len(found) :])) + "M2\n"
        paths, refusal = _run(text, folder)
        found += [Witnessed(path, "") for path in paths[:-1]]
        found.append(Witnessed((), refusal) if refusal else Witnessed(paths[-1], ""))
    return found


def _blocks(part: Part, height: int) -> str:
    """The blocks of one contour at a height of its own: a tangent entry, the contour, G40, and up to Z-1."""
    (x, y), (dx, dy) = part.contour.points[0].tolist(), part.contour.part(0, 1).start_directions[0].tolist()
    lines = [
        f"G0 X{x - 3 * RADIUS * dx:.10f} Y{y - 3 * RADIUS * dy:.10f}",
        f"Z{height}",
        f"{'G41.1' if part.side is Side.LEFT else 'G42.1'} D{2 * RADIUS:.10f}",
        f"G1 X{x:.10f} Y{y:.10f}",
        *(_block(piece, rapid=number in part.rapid) for number, piece in enumerate(part.contour, 1)),
        "G40",
        "G0 Z-1",
    ]
    return "\n".join(lines) + "\n"


def _block(piece: Piece, *, rapid: bool) -> str:
    end = f"X{piece.end[0]:.10f} Y{piece.end[1]:.10f}"
    if isinstance(piece, Line):
        return f"{'G0' if rapid else 'G1'} {end}"
    i, j = piece.center[0] - piece.start[0], piece.center[1] - piece.start[1]
    return f"{'G3' if piece.turn > 0 else 'G2'} {end} I{i:.10f} J{j:.10f}"


def _run(text: str, folder: File) -> tuple[list[tuple[Piece, ...]], str]:
    """The paths of all contours that were begun, and the sentence with which the last of them was refused."""
    program, table = folder / "program.ngc", folder / "tool.tbl"
    program.write_text(text, encoding="ascii")
    table.write_text("T1 P1 D1 Z0\n")
    ended = process(program, table)
    said = [line for line in ended.stderr.splitlines() if line.strip() and line.strip() != "executing"]
    return _paths(MOVE.findall(ended.stdout)), said[0] if said else ""


def _paths(printed: Sequence[tuple[str, str]]) -> list[tuple[Piece, ...]]:
    """The pieces at every height: behind the plunge and the entry, which end where the contour's path begins."""
    heights: dict[int, list[tuple[str, list[float]]]] = {}
    for name, numbers in printed:
        values = [float(value) for value in numbers.split(",")]
        if name == "SET_FEED_RATE":
            continue
        height = round(values[5] if name == "ARC_FEED" else values[2])
        if height >= 0:
            heights.setdefault(height, []).append((name, values))
    return [_path(moves) for _, moves in sorted(heights.items())]


def _path(moves: list[tuple[str, list[float]]]) -> tuple[Piece, ...]:
    if len(moves) < 2:
        return ()
    at, found = (moves[1][1][0], moves[1][1][1]), list[Piece]()
    for name, values in moves[2:]:
        end = (values[0], values[1])
        if name == "ARC_FEED":
            found.append(Arc(at, end, (values[2], values[3]), Turn.CCW if values[4] > 0 else Turn.CW))
        elif end != at:
            found.append(Line(at, end))
        at = end
    return tuple(found)


TANGENT: Final = 0.05
"""LinuxCNC takes corners under so many radians for none."""

NOTICED: Final = 1e-3
"""A gouge deeper than this, in millimeters beside a cutter of 200, is none of LinuxCNC's printed decimals."""

STEP: Final = 0.5
"""Millimeters between points of a path that is measured by points."""


class Rule(StrEnum):
    """Why LinuxCNC's path is another one."""

    TANGENT = "a corner under 0.05 rad is none to LinuxCNC"
    REVERSAL = "a corner within 0.05 rad of turning back"
    RAPID = "no arc round a corner in front of a rapid move"
    BACKWARDS = "an inside corner beyond its segment's end: LinuxCNC runs back along it, unnoticed"
    OTHER_MEETING = "an inside corner whose offsets meet twice: LinuxCNC takes the other point"
    LOOKAHEAD = "pieces deleted where two cross off their corner: LinuxCNC looks at corners only"
    GOUGES = "LinuxCNC's path gouges, the best path never does"
    SEAM = "a closed contour's start: the best path is joined there, LinuxCNC's has two ends"
    CROSSES = "a contour that crosses itself: the best path has a loop for every side of it"
    UNEXPLAINED = "unexplained"


@dataclass(frozen=True, eq=False)
class Case:
    """A part with LinuxCNC's path and ours."""

    part: Part
    theirs: Witnessed
    ours: Compensated
    best: BestPath

    @cached_property
    def gouges(self) -> bool:
        """Whether LinuxCNC's path gouges or runs on the wrong side.

        At corners it takes for none it makes arcs of two radii, which the judge refuses: points are measured then.
        """
        path = Path.from_pieces(self.theirs.path)
        verdict = judge(self.part.contour, self.part.side, RADIUS, path)
        if verdict.judged:
            return verdict.depth > NOTICED or bool(verdict.wrong_side)
        return least(path, self.part.contour, STEP) < RADIUS * (1.0 - TANGENT**2)

    @cached_property
    def twice(self) -> frozenset[int]:
        """Inside corners whose two offsets meet in more than one point."""
        chain = offset(self.part.contour, self.part.side, RADIUS)
        joints = crossings(chain, 1, closed=self.part.closed).joints
        rows, counts = np.unique(joints.b, return_counts=True)
        return frozenset((chain.half_steps[rows[counts > 1]] // 2).tolist())

    @cached_property
    def deleted(self) -> frozenset[float]:
        """Numbers of the raw chain's segments and corner arcs that our path has lost."""
        return frozenset(self.ours.raw.numbers.tolist()) - frozenset(self.ours.path.numbers.tolist()) - self._bridges

    @cached_property
    def _bridges(self) -> frozenset[float]:
        chain = offset(self.part.contour, self.part.side, RADIUS)
        return frozenset(chain.raw.numbers[chain.parts == ChainPart.BRIDGE.value].tolist())

    @cached_property
    def bridged(self) -> frozenset[int]:
        """Corners our path bridges because their offsets miss each other."""
        return frozenset(floor(number) for number in self.ours.path.numbers[self.ours.bridged].tolist())


def rule_of(case: Case, found: Difference) -> Rule:
    """The first rule that holds at the place where our control's path differs."""
    for rule, holds in _RULES:
        if any(holds(case, found, corner) for corner in _corners(case.part, found)):
            return rule
    if any(found.first <= number <= found.last for number in case.deleted):
        return Rule.LOOKAHEAD
    return Rule.UNEXPLAINED


def _corners(part: Part, found: Difference) -> Iterator[int]:
    """The corners between the pieces in front of and behind a difference."""
    first, last = max(found.first, 1.0), min(found.last, float(len(part.contour)))
    return iter(range(floor(first), ceil(last)))


def _tangent(case: Case, found: Difference, corner: int) -> bool:
    """The corner is small, and LinuxCNC's path leaves ours by no more than such a corner's arc is long."""
    angle = abs(corner_angle(case.part.contour, corner))
    if not RADIUS * angle > JOINED or angle >= TANGENT:
        return False
    ends = np.array([end for piece in found.theirs for end in (piece.start, piece.end)])
    return bool(apart(ends.reshape(-1, 2), case.ours.path).max(initial=0.0) <= TANGENT * RADIUS)


def _reversal(case: Case, _: Difference, corner: int) -> bool:
    return abs(corner_angle(case.part.contour, corner)) > pi - TANGENT


def _rapid(case: Case, _: Difference, corner: int) -> bool:
    """An outside corner in front of a rapid move: LinuxCNC goes straight from one offset to the other."""
    outside = corner_angle(case.part.contour, corner) * case.part.side.sign < 0.0
    return outside and corner + 1 in case.part.rapid and isinstance(case.part.contour[corner], Line)


def _backwards(case: Case, _: Difference, corner: int) -> bool:
    return corner in case.bridged and case.gouges


def _twice(case: Case, _: Difference, corner: int) -> bool:
    return corner in case.twice


_RULES: Final[tuple[tuple[Rule, Callable[[Case, Difference, int], bool]], ...]] = (
    (Rule.TANGENT, _tangent),
    (Rule.REVERSAL, _reversal),
    (Rule.RAPID, _rapid),
    (Rule.BACKWARDS, _backwards),
    (Rule.OTHER_MEETING, _twice),
)


def best_rule_of(case: Case, found: Difference) -> Rule:
    """The first rule that holds at the place where the best path differs."""
    if any(one.code == "CROSSES_ITSELF" for one in case.best.findings):
        return Rule.CROSSES
    if case.gouges:
        return Rule.GOUGES
    if case.part.closed and (found.first == -inf or found.last == inf):
        return Rule.SEAM
    return rule_of(case, found)
