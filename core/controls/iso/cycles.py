"""This module turns drilling cycles, G73, G74 and G81 to G89, into the moves that make each hole.

R, depth and peck stay in force until another cycle.  Under G91, R counts from the height at which the row of holes
began, and the depth from R: on Fanuc's family in the block that has them, elsewhere in every block that uses them.
G98 retracts to that height, G99 to R.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from core.controls.iso.modal_state import INVERSE_TIME, ModalState
from core.controls.iso.reader import Block, whole_word
from core.controls.moves import Plane, Point3, flat, solid

CHIP_CLEARANCE: Final = 0.254
"""Millimeters (0.010 in) by which G73 retracts after a peck, and G83's return stops short of the last depth."""

MAX_REPEATS: Final = 10_000

_PECK_CYCLES: Final = (730, 830)
_FEEDS_OUT: Final = (740, 840, 850, 890)
_BORING_CYCLE: Final = 850
_TAPPING_CYCLES: Final = (740, 840)
_DWELL_CYCLES: Final = (820, 860, 890)
_CYCLES_NOT_FOLLOWED: Final = (870, 880)

DrillMove = tuple[Point3, bool]
"""The end of a straight move, and whether it is a rapid."""


@dataclass(frozen=True, slots=True)
class Hole:
    """One hole: its position in the plane, and the heights of approach, R, bottom and retract."""

    first: float
    second: float
    approach: float
    r: float
    bottom: float
    retract: float
    plane: Plane

    def at(self, height: float) -> Point3:
        """Return the point on the hole's axis at a height."""
        return solid(self.first, self.second, height, self.plane)


def drill(state: ModalState, block: Block) -> Iterator[DrillMove]:
    """Yield the moves of a block of the cycle in force; a block that lacks a word stops the run."""
    code = state.mode or 0
    if not state.dialect.cycles or code in _CYCLES_NOT_FOLLOWED:
        state.log.warn("CYCLE", "cutcomp follows this cycle's hole positions but not its depth.", block)
        first, second, _ = flat(state.target(block.words), state.plane)
        yield solid(first, second, flat(state.position, state.plane)[2], state.plane), True
        return
    if state.rate == INVERSE_TIME:
        state.log.stop("CYCLE", "A drilling cycle does not go with G93; write G94.", block.at("G"))
    if not state.feed:
        state.no_feed(block)
    is_first = state.cycle.code != code
    _take_values(state, code, block)
    yield from _holes(state, code, block, is_first=is_first)


def _take_values(state: ModalState, code: int, block: Block) -> None:
    """Take R, depth and peck from a block; a first block of a cycle that lacks a word stops the run."""
    cycle, words, scale = state.cycle, block.words, state.scale
    letter = "XYZ"[state.plane.axes[2]]
    if cycle.code is None:
        cycle.began = flat(state.position, state.plane)[2] - flat(state.shift, state.plane)[2]
    for needed in ("R", letter) if cycle.code != code else ():
        if needed == "R" and needed not in words and not state.dialect.cycle_r_needed:
            cycle.r = 0.0 if _counts_from_here(state) else cycle.began
            state.log.inform("CYCLE", "The cycle has no R; cutcomp takes the height at which it begins.", block.at("G"))
        elif needed not in words:
            state.log.stop("CYCLE", f"{needed} is missing: the first G{code // 10} block needs it.", block.at("G"))
    to_heights = state.incremental and state.dialect.fanuc_cycles
    if "R" in words:
        cycle.r = words["R"] * scale + (cycle.began if to_heights else 0.0)
    if letter in words:
        cycle.depth = words[letter] * scale + (cycle.r if to_heights else 0.0)
    if "Q" in words:
        cycle.peck = words["Q"] * scale
    cycle.code = code


def _counts_from_here(state: ModalState) -> bool:
    """True if R in force counts from the height where the row began, and the depth from R."""
    return state.incremental and not state.dialect.fanuc_cycles


def _holes(state: ModalState, code: int, block: Block, *, is_first: bool) -> Iterator[DrillMove]:
    """Yield the moves of all holes of a block; `is_first` for the first block of a cycle."""
    cycle, plane = state.cycle, state.plane
    repeats = _repeats(state, block)
    if not repeats:
        return
    here = flat(state.position, plane)
    origin = flat(state.shift, plane)[2]
    r = cycle.r + origin + (cycle.began if _counts_from_here(state) else 0.0)
    bottom = cycle.depth + (r if _counts_from_here(state) else origin)
    if r < bottom:
        state.log.stop("CYCLE", "R is below the bottom of the hole. Correct R or the depth.", block.at("RXYZG"))
    height, level = here[2], cycle.began + origin
    if level < r:
        yield solid(here[0], here[1], r, plane), True
        height = level = r
    # the first block of some cycles also needs the peck, or the time at the bottom
    needed = "Q" if code in _PECK_CYCLES else "P" if code in _DWELL_CYCLES and state.dialect.table_needed else ""
    if is_first and needed and needed not in block.words:
        state.log.stop("CYCLE", f"{needed} is missing: the first G{code // 10} block needs it.", block.at("G"))
    back = r if cycle.to_r else level
    height = height if height > r else back
    for index in range(repeats):
        first, second, _ = flat(state.target(block.words), plane)
        yield from _hole(state, code, block, Hole(first, second, back if index else height, r, bottom, back, plane))


def _repeats(state: ModalState, block: Block) -> int:
    letters = state.dialect.repeat_letters
    letter = next((letter for letter in letters if letter in block.words), letters[0])
    least = 0 if state.dialect.fanuc_cycles else 1
    text = f"{letter}, how often the cycle runs, is a whole number from {least} to {MAX_REPEATS}."
    return whole_word(block, letter, state.log, "CYCLE", text, least, MAX_REPEATS, default=1.0)


def _hole(state: ModalState, code: int, block: Block, hole: Hole) -> Iterator[DrillMove]:
    yield hole.at(hole.approach), True
    if hole.approach != hole.r:
        yield hole.at(hole.r), True
    _check_spindle(state, code, block)
    if code in _PECK_CYCLES:
        yield from _pecks(state, code, block, hole)
    else:
        yield hole.at(hole.bottom), False
    if code in _FEEDS_OUT:
        yield hole.at(hole.r if code == _BORING_CYCLE else hole.retract), False
    if code not in _FEEDS_OUT or code == _BORING_CYCLE:
        yield hole.at(hole.retract), True


def _check_spindle(state: ModalState, code: int, block: Block) -> None:
    """Check that tapping has its spindle direction, and G86 a turning spindle, if the state at the start is known."""
    if not state.dialect.table_needed:
        return
    if code in _TAPPING_CYCLES and state.plane is not Plane.XY:
        state.log.stop("CYCLE", "In this plane the control taps along the wrong axes; write G17.", block.at("G"))
    wanted = {740: -1, 840: 1}.get(code)
    turning = state.turning
    if turning != wanted if wanted else code == 860 and not turning:
        start_command = {-1: "with M4", 1: "with M3", None: "with M3 or M4"}[wanted]
        state.log.stop("CYCLE", f"G{code // 10} needs a spindle that turns; start it {start_command}.", block.at("G"))


def _pecks(state: ModalState, code: int, block: Block, hole: Hole) -> Iterator[DrillMove]:
    """Yield the pecks of a hole: between them G83 retracts to R, and G73 only a little."""
    peck = state.cycle.peck
    if peck <= 0.0:
        state.log.stop("CYCLE", "Q, the depth of a peck, must be larger than 0.", block.at("QG"))
    if (hole.r - hole.bottom) / peck > MAX_REPEATS:
        state.log.stop("CYCLE", f"That is more than {MAX_REPEATS} pecks; correct Q.", block.at("QG"))
    depth = hole.r - peck
    while depth > hole.bottom:
        yield hole.at(depth), False
        if code == 830:
            yield hole.at(hole.r), True
        yield hole.at(depth + CHIP_CLEARANCE), True
        depth -= peck
    yield hole.at(hole.bottom), False
