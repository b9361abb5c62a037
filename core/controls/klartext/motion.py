"""Straight path functions L and LP, the pole CC, and RND and CHF."""

from __future__ import annotations

from typing import Final

from core.controls.compensation.corners import line_element
from core.controls.klartext.blocks import Block
from core.controls.klartext.functions import functions, leaves_workpiece
from core.controls.klartext.polar import POLAR, polar_target
from core.controls.klartext.state import AXES, COMMON, SIDES, Blend, State, Words
from core.controls.klartext.steps import Role, Step
from core.finding import Severity
from core.tolerance import JOINED

NOT_YET: Final = "RL, RR or R0 beside the tool axis alone is taken to act in the next line of the working plane."

_LINE: Final = COMMON | frozenset(AXES)
_POLAR: Final = COMMON | POLAR
_CENTER: Final = frozenset(AXES)
_CORNER: Final = frozenset(("R", "F", "LEN"))


def straight(state: State, block: Block) -> None:
    """L: a straight line; in the block whose RL, RR or R0 is new it applies or cancels compensation."""
    words = state.words(block, _LINE)
    if "FMAX" in words or "MB" in words:
        state.chosen_side(block, words)
        if leaves_workpiece(state, block, words):
            return
    _line_to(state, block, words, state.target(block, words))


def polar_straight(state: State, block: Block) -> None:
    """LP: a straight line to a point given by distance and angle from the pole."""
    words = state.words(block, _POLAR)
    _line_to(state, block, words, polar_target(state, block, words)[0])


def _line_to(state: State, block: Block, words: Words, end: list[float]) -> None:
    state.chosen_side(block, words)
    rapid, feed = state.chosen_feed(block, words)
    corner = functions(state, block, words)
    start, low = state.flat(state.position)
    goal, high = state.flat(end)
    if goal == start and high == low:
        return
    state.moving(block, rapid=rapid, feed=feed)
    state.position = end
    element = line_element(start, goal, low, high, rapid, feed, block.line, block.column - len(block.head))
    if goal == start:
        state.last = None
        state.push(Step(Role.DEPTH, element, 0.0, state.plane))
        if state.side != state.applied and SIDES.keys() & words.keys():
            state.tell(Severity.INFO, "INTERPRETED", NOT_YET, block)
    elif state.side == state.applied:
        role = Role.CONTOUR if state.side else Role.FREE
        state.push(Step(role, element, state.offset, state.plane, corner, state.speed))
        state.last = element
    else:
        _change(state, block, Step(Role.EXIT, element, 0.0, state.plane))


def _change(state: State, block: Block, step: Step) -> None:
    """The line in which RL, RR or R0 takes effect."""
    state.last = None
    if state.side:
        state.apply(block)
        step = step._replace(role=Role.ENTRY, offset=state.offset)
    else:
        state.release()
    state.push(step)


def center(state: State, block: Block) -> None:
    """CC: the pole and circle center, by both axes of the plane; without words where the tool stands."""
    words, known = state.words(block, _CENTER), set(state.known)
    pole, height = state.flat(state.target(block, words))
    state.known = known
    if len(words) not in (0, 2) or height != state.flat(state.position)[1]:
        text = "CC needs both axes of the working plane, or none at all for where the tool stands."
        state.stop("ARC", text, block)
    state.pole = pole


def corner(state: State, block: Block) -> None:
    """RND R and CHF: a rounding or chamfer between the element before and the one behind."""
    body, head = block.body.lstrip(), block.column - len(block.head)
    bare = body != "" and body[0] in "+-.0123456789Q"
    if bare:  # the size stands without a name, as in CHF 5
        block = block._replace(body=f"LEN{body}", column=block.column + len(block.body) - len(body) - 3)
    words = state.words(block, _CORNER)
    name = next((one for one in ("R", "LEN") if one in words), "")
    if not name:
        state.stop("CORNER", f"{block.head} needs its size; write RND R5 or CHF 5.", block)
    size = state.length(block, words, name)
    if size <= JOINED:
        state.stop("CORNER", f"The size of {block.head} must be above 0.", block)
    if state.waiting is None or state.last is None or state.blend:
        state.stop("CORNER", "RND and CHF need a contour element directly before them; move the block.", block)
    feed = state.length(block, words, "F") if "F" in words else state.feed
    state.blend = Blend(block, size, block.head == "RND", feed, head)
