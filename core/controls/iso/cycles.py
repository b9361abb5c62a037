"""Drilling cycles, G73, G74 and G81 to G89: every hole as the moves that make it.

Depth, R and the peck stay until another cycle.  Under G91 R counts from the height at which the row of holes began, and
the depth from R.  G98 comes back to that height, G99 to R.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NoReturn

from core.controls.iso.rates import INVERSE
from core.controls.iso.words import Block, whole
from core.controls.moves import Plane, Point3, flat, solid
from core.finding import Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


_BACK: Final = 0.254
"""Millimeters (0.010 in) by which a peck comes back, or stays off the ground at its return."""

_AXES: Final = (("X", "Y", "Z"), ("Z", "X", "Y"), ("Y", "Z", "X"))
_PECKS: Final = (730, 830)
_FEEDS_OUT: Final = (740, 840, 850, 890)
_BORE: Final = 850
_TAPS: Final = (740, 840)
_DWELLS: Final = (820, 860, 890)
_OTHERS: Final = (870, 880)
_MOST: Final = 10_000


@dataclass(slots=True)
class Cycles:
    """What stays from hole to hole: the cycle, the height its row began at, R, depth and peck, in millimeters.

    `r` and `depth` are as written; `to_r` is G99.
    """

    code: int | None = None
    began: float = 0.0
    r: float = 0.0
    depth: float = 0.0
    peck: float = 0.0
    to_r: bool = False


@dataclass(frozen=True, slots=True)
class Hole:
    """One hole: its place in the plane, the heights of approach, R, ground and return."""

    first: float
    second: float
    over: float
    r: float
    ground: float
    back: float


def drill(machine: Machine, block: Block) -> None:
    """Runs a block of a cycle in force."""
    code = machine.mode or 0
    if machine.follower.active:
        text = "A drilling cycle does not go with compensation; write G40 before it, or G80 and another motion."
        machine.log.stop(machine.dialect.cycle_rule, text, block.line, block.column("GXYZ"))
    if not machine.dialect.cycles or code in _OTHERS:
        _only_positions(machine, block)
        return
    if machine.rates.mode == INVERSE:
        _stop(machine, "A drilling cycle does not go with G93; write G94.", block)
    if not machine.feed:
        machine.no_feed(block)
    fresh = machine.cycles.code != code
    _values(machine, code, block)
    _row(machine, code, block, fresh=fresh)


def _only_positions(machine: Machine, block: Block) -> None:
    text = "Only the positions of this drilling cycle are followed, its depth is not."
    machine.log.tell(Severity.WARNING, "CYCLE", text, block.line, 1)
    first, second, _ = flat(machine.target(block.words), machine.plane)
    _move(machine, block, solid(first, second, flat(machine.position, machine.plane)[2], machine.plane), 0)


def _stop(machine: Machine, text: str, block: Block, letters: str = "G") -> NoReturn:
    machine.log.stop("CYCLE", text, block.line, block.column(letters))


def _spindle(machine: Machine, code: int, block: Block) -> None:
    """Tapping needs its direction, G86 a spindle that turns; known only where the program's start is."""
    if code in _TAPS and machine.plane is not Plane.XY and machine.dialect.table_needed:
        _stop(machine, "In this plane the control taps along the wrong axes; write G17.", block)
    wanted = {740: -1, 840: 1}.get(code)
    turning = machine.rates.turning
    wrong = turning != wanted if wanted else code == 860 and not turning
    if machine.dialect.table_needed and wrong:
        way = {-1: "with M4", 1: "with M3", None: "with M3 or M4"}[wanted]
        _stop(machine, f"G{code // 10} needs a spindle that turns; start it {way}.", block)


def _values(machine: Machine, code: int, block: Block) -> None:
    """Takes R, depth and peck of a block; what the first block of a cycle lacks stops the run."""
    state, words, scale = machine.cycles, block.words, machine.scale
    fresh, letter = state.code != code, _AXES[machine.plane][2]
    if state.code is None:
        state.began = flat(machine.position, machine.plane)[2] - flat(machine.shift, machine.plane)[2]
    for one in ("R", letter) if fresh else ():
        if one not in words:
            _stop(machine, f"{one} is missing; the first block of G{code // 10} has to say it.", block)
    if "R" in words:
        state.r = words["R"] * scale
    if letter in words:
        state.depth = words[letter] * scale
    if "Q" in words:
        state.peck = words["Q"] * scale
    state.code = code


def _more(machine: Machine, code: int, block: Block) -> None:
    """What the first block of some cycles has to say besides: the peck, the time at the ground."""
    wanted = "Q" if code in _PECKS else "P" if code in _DWELLS and machine.dialect.table_needed else ""
    if wanted and wanted not in block.words:
        _stop(machine, f"{wanted} is missing; the first block of G{code // 10} has to say it.", block)


def _row(machine: Machine, code: int, block: Block, *, fresh: bool) -> None:
    """All holes of a block; `fresh` in the first one of a cycle."""
    state, plane = machine.cycles, machine.plane
    here = flat(machine.position, plane)
    origin = flat(machine.shift, plane)[2]
    r = state.r + origin + (state.began if machine.incremental else 0.0)
    ground = state.depth + (r if machine.incremental else origin)
    if r < ground:
        _stop(machine, "R lies below the ground of the hole; correct R or the depth.", block, "RXYZG")
    over, level = here[2], state.began + origin
    if level < r:
        _move(machine, block, solid(here[0], here[1], r, plane), 0)
        over = level = r
    if fresh:
        _more(machine, code, block)
    back = r if state.to_r else level
    over = over if over > r else back
    first, second, _ = flat(machine.target(block.words), plane)
    step = (first - here[0], second - here[1]) if machine.incremental else (0.0, 0.0)
    for index in range(_times(machine, block)):
        hole = Hole(first + index * step[0], second + index * step[1], over if not index else back, r, ground, back)
        _hole(machine, code, block, hole)


def _times(machine: Machine, block: Block) -> int:
    number = whole(block.words.get("L", 1.0))
    if number is None or not 0 < number <= _MOST:
        _stop(machine, f"L, how often the cycle runs, is a whole number from 1 to {_MOST}.", block, "L")
    return number


def _hole(machine: Machine, code: int, block: Block, hole: Hole) -> None:
    def to(height: float, mode: int) -> None:
        _move(machine, block, solid(hole.first, hole.second, height, machine.plane), mode)

    to(hole.over, 0)
    if hole.over != hole.r:
        to(hole.r, 0)
    _spindle(machine, code, block)
    if code in _PECKS:
        _pecks(machine, code, block, hole)
    else:
        to(hole.ground, 10)
    if code in _FEEDS_OUT:
        to(hole.r if code == _BORE else hole.back, 10)
    if code not in _FEEDS_OUT or code == _BORE:
        to(hole.back, 0)


def _pecks(machine: Machine, code: int, block: Block, hole: Hole) -> None:
    """G83 comes out to R between pecks, G73 only a little back."""

    def to(height: float, mode: int) -> None:
        _move(machine, block, solid(hole.first, hole.second, height, machine.plane), mode)

    depth, peck = hole.r - machine.cycles.peck, machine.cycles.peck
    if peck <= 0.0:
        _stop(machine, "Q, the depth of a peck, has to be larger than 0.", block, "QG")
    if (hole.r - hole.ground) / peck > _MOST:
        _stop(machine, f"That is more than {_MOST} pecks; correct Q.", block, "QG")
    while depth > hole.ground:
        to(depth, 10)
        if code == 830:
            to(hole.r, 0)
        to(depth + _BACK, 0)
        depth -= peck
    to(hole.ground, 10)


def _move(machine: Machine, block: Block, end: Point3, mode: int) -> None:
    kept, machine.mode = machine.mode, mode
    machine.straight(block, end)
    machine.mode = kept
