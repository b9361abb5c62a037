"""M functions end the program, change the path, or only leave a finding."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from core.controls.compensation.corner_rules import CornerRules
from core.controls.klartext.center_path import KLARTEXT_CORNERS, M97, M98, FeedAt
from core.controls.klartext.reader import Block
from core.controls.klartext.state import AXIS_WORDS, State, Words
from core.controls.program_text import quoted

MAX_LOOK_AHEAD: Final = 99
"""Most blocks that M120 can look ahead."""

M120_SKIPS: Final = "cutcomp assumes M120 skips what lies between two crossings of the path within LA blocks."

_FEED_FUNCTIONS: Final[Mapping[int, FeedAt]] = {109: FeedAt.EDGE, 110: FeedAt.INSIDE_EDGE, 111: FeedAt.CENTER}
_CORNER_FUNCTIONS: Final[Mapping[int, CornerRules]] = {97: M97, 98: M98}
_IGNORED_FUNCTIONS: Final = frozenset((0, 1, 3, 4, 5, 6, 7, 8, 9, 13, 14))
_MOVING_FUNCTIONS: Final = frozenset((89, 91, 92, 114, 128, 130, 140, 144))
_CYCLE_CALL: Final = 99
_MACHINE_POSITION_FUNCTIONS: Final = frozenset(("M91", "M92", "M140"))
_FUNCTION_OF_WORD: Final[Mapping[str, str]] = {"LA": "M120", "MB": "M140", "MAX": "M140"}
_DIFFERENT_ON_CONTROL: Final[Mapping[int, str]] = {
    90: "the control rounds corners that run without compensation",
    103: "the control lowers the feed of plunging moves",
    112: "the control rounds corners within a tolerance",
    124: "the control leaves out points of short lines",
    136: "the control takes F in millimeters per revolution",
}


def functions(state: State, words: Words) -> CornerRules:
    """Apply the block's M words, and return the rules of the corner at its end."""
    corner = KLARTEXT_CORNERS
    for name in words:
        if name == "M120":
            _look_ahead(state, words)
        elif name[0] == "M" and name not in _FUNCTION_OF_WORD:
            corner = _function(state, words.block, name, corner)
    for name, owner in _FUNCTION_OF_WORD.items():
        if name in words and owner not in words:
            text = f"{name} belongs to {owner}. Write it with {owner}, or leave it out."
            state.log.stop("WORD", text, words.at(name))
    return corner


def _function(state: State, block: Block, name: str, corner: CornerRules) -> CornerRules:
    if not name[1:].isdecimal():
        state.log.stop("NUMBER", "M needs a whole number after it.", block.at(name))
    code = int(name[1:])
    if code in (2, 30):
        state.ended = True
    elif code == _CYCLE_CALL:
        state.cycle_due = True
    elif code in _FEED_FUNCTIONS:
        state.feed_at = _FEED_FUNCTIONS[code]
    elif code in _CORNER_FUNCTIONS:
        return _CORNER_FUNCTIONS[code]
    elif code in _MOVING_FUNCTIONS:
        state.log.stop("BEYOND", f"{quoted(name)} moves the axes, which is not supported.", block.at(name))
    elif code in _DIFFERENT_ON_CONTROL:
        state.log.warn("M", f"{name} is not supported: {_DIFFERENT_ON_CONTROL[code]}.", block.at(name))
    elif code not in _IGNORED_FUNCTIONS:
        state.log.inform("M", f"cutcomp assumes {quoted(name)} moves nothing.", block.at(name))
    return corner


def _look_ahead(state: State, words: Words) -> None:
    """M120 LA n looks ahead from this block on until R0; without LA, or with LA0, it is off."""
    depth = state.number(words, "LA") if "LA" in words else 0.0
    if not 0.0 <= depth <= MAX_LOOK_AHEAD or depth != int(depth):
        state.log.stop("NUMBER", f"LA is a whole number of blocks up to {MAX_LOOK_AHEAD}.", words.at("LA"))
    if depth and not state.side:
        state.log.warn("M", "M120 has no effect in this block. Write it in a block with RL or RR.", words.at("M120"))
    elif depth:
        state.log.inform("INTERPRETED", M120_SKIPS, words.at("M120"))
    state.ahead = int(depth) if state.side else 0


def only_functions(state: State, block: Block) -> None:
    """Run STOP, or a block of M words alone."""
    whole = block
    if block.head != "STOP":
        whole = block._replace(body=block.head + block.body, begin=block.begin - len(block.head))
    words = state.words(whole, frozenset(("M", "LA", "MB", "MAX")))
    if not leaves_workpiece(state, words):
        functions(state, words)


def leaves_workpiece(state: State, words: Words) -> bool:
    """True if uncompensated M91, M92 or M140 sends axes where only the machine knows; the move is then left out."""
    if _MACHINE_POSITION_FUNCTIONS.isdisjoint(words) or state.applied or state.side:
        return False
    state.lose({AXIS_WORDS[name][0] for name in words.keys() & AXIS_WORDS.keys()})
    if "M140" in words:
        state.lose({state.plane.axes[2]})
    state.waiting.flush()
    state.last = None
    text = "This move ends where only the machine knows, and is skipped. The next absolute words set the position."
    state.log.warn("MACHINE", text, words.block)
    return True
