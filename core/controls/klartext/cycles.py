"""This module handles CYCL DEF and its calls; it skips a cycle's own moves, up to the end position if that is known.

A drilling cycle ends over its hole; the older cycles 1 to 5, 17 and 18, and the cycles 212 to 215, end where they
began.  The end of others is not known, so only the next absolute words give the tool's position.
"""

from __future__ import annotations

import re
from typing import Final

from core.controls.klartext.center_path import ProgrammedStep, Role
from core.controls.klartext.formulas import evaluate
from core.controls.klartext.path_functions import straight_element
from core.controls.klartext.reader import Block
from core.controls.klartext.setup_blocks import shift
from core.controls.klartext.state import AXIS_WORDS, COMMON_WORDS, State
from core.controls.transform import Transform
from core.finding import Severity
from core.units import to_mm

_CYCLE: Final = re.compile(r"\s*(DEF|CALL)\s*(?:(\d+)(?:\.(\d+))?)?", re.ASCII)
_POSITION: Final = re.compile(r"\s*CALL\s*(POS|PAT)?", re.ASCII)
_VALUE: Final = re.compile(r"Q(\d{1,3})\s*=\s*(\S+)", re.ASCII)
_HEIGHT_PARAMETERS: Final = frozenset(("Q200", "Q203", "Q204"))
"""Set-up clearance, surface and 2nd set-up clearance."""

_ANY_NUMBER: Final = r"([-+.,\dQLR]+)"
_MIRRORED_AXES: Final = re.compile(r"\s*([XYZ])\b", re.ASCII)
_ROTATION: Final = re.compile(rf"\s*(I?)ROT\s*{_ANY_NUMBER}\s*", re.ASCII)
_NEUTRAL: Final = {
    11: (re.compile(rf"\s*SCL\s*{_ANY_NUMBER}\s*", re.ASCII), 1.0),
    19: (re.compile(rf"(?:\s*A\s*{_ANY_NUMBER})?(?:\s*B\s*{_ANY_NUMBER})?(?:\s*C\s*{_ANY_NUMBER})?\s*", re.ASCII), 0.0),
}
"""Cycles that scale or tilt: their words, and the value at which these change nothing."""

_OLD_CYCLES: Final = frozenset((7, 8, 10, *_NEUTRAL))
"""Cycles whose first line, with .0 after the number, only names them."""

_TRANSFORM_CYCLES: Final = frozenset((8, 10, 11, 19, 26, 27, 28, 29, 247))
"""Cycles that change where the contour lies."""

_PATTERN_CYCLES: Final = frozenset((220, 221))
"""Cycles that run the cycle before them at many points as soon as they are defined."""

_DRILLING_CYCLES: Final = frozenset((*range(200, 208), 209, 240, 241))
_TAPPING_CYCLES: Final = frozenset((1, 2, 17, 18))
_RETURNING_CYCLES: Final = _TAPPING_CYCLES | {3, 4, 5, 212, 213, 214, 215}
_CYCLES_WITHOUT_CALL: Final = frozenset((9, 13, 14, 20, 32, 39))
"""Cycles without a call: a dwell, an orientation, data of a contour or a tolerance."""

_CONTOUR_CYCLES: Final = frozenset((6, 16, 22, 23, 24, 25, *range(271, 277)))
"""Cycles that offset and mill a contour by themselves: what they cut would not be judged."""

_PROGRAM_CALL_CYCLE: Final = 12
_FIRST_PROBE: Final = 400

SKIPPED_TEXT: Final = "The moves of cycle {} are skipped; {}."
NOT_JUDGED: Final = "What cycle {} mills is not judged; {}."


def cycle(state: State, block: Block) -> None:
    """CYCL DEF and CYCL CALL: shift the datum; other cycles wait for their call, which skips their moves."""
    head = _CYCLE.match(block.body)
    number = int(head[2][:6]) if head and head[2] else 0
    rest = block.after(head.end()) if head else block
    if head is not None and head[1] == "CALL" and not number:
        _call_block(state, block)
    elif head is None or head[1] == "CALL" or not number:
        state.log.stop("WORD", "CYCL needs DEF with a number, or CALL.", block)
    elif number in _OLD_CYCLES and head[3] == "0":
        pass  # only the cycle's name; what it does comes in the blocks after it
    elif number == 7:
        if head[3]:
            shift(state, rest)
    elif number in (8, 10) and head[3]:
        _transform(state, rest, number)
    elif number in _NEUTRAL and _is_neutral(state, block, number, rest.body):
        state.log.inform("IGNORED", f"Cycle {number} is skipped: these values turn, mirror and scale nothing.", block)
    elif number == 247 and state.waiting.step is None and len(state.waiting.center.tape) == 1:
        # nothing has moved yet
        state.log.inform("IGNORED", "Cycle 247 selects the workpiece datum. All positions count from it.", block)
    elif number in _TRANSFORM_CYCLES or number >= _FIRST_PROBE:
        text = f"Cycle {number} moves or transforms the contour, which is not supported. Write out its moves."
        state.log.stop("BEYOND", text, block)
    else:
        _define(state, block, number)


def _transform(state: State, block: Block, number: int) -> None:
    """CYCL DEF 8.1 X Y mirrors axes, CYCL DEF 10.1 ROT or IROT turns the plane; without axes or at 0 that ends.

    Both are about the datum, and ROT counts from the working plane's first axis.  Sources: HEIDENHAIN TNC 426/430
    user's manual, coordinate transformation cycles and example 10.11 (datum shift, then rotation about it); TNC 310
    Pilot p. 8 (reference axis of ROT); TNC 320 user's manual p. 108 (cycles 7, 8 and 10 in the working plane).
    """
    if state.applied or state.side:
        text = f"Cycle {number} under compensation is not supported. Cancel it in an L block with R0 before."
        state.log.stop("CYCLE", text, block)
    before, datum = state.transform, state.shift
    axes, angle = set(before.mirror), before.angle
    if number == 8:
        axes = {"XYZ".index(name) for name in _MIRRORED_AXES.findall(block.body)}
    else:
        words = _ROTATION.fullmatch(block.body)
        if words is None:
            state.log.stop("WORD", "Cycle 10 needs ROT and an angle. Write ROT+30.", block)
        angle = state.value(words[2], block) + (angle if words[1] else 0.0)
    if state.plane.axes[2] in axes or (number == 8 and _MIRRORED_AXES.sub("", block.body).strip()):
        state.log.stop("BEYOND", "cutcomp follows cycle 8 with axes of the working plane only, as in X Y.", block)
    if axes and angle:
        text = "cutcomp does not follow a mirror image and a rotation together. Write out the moves."
        state.log.stop("BEYOND", text, block)
    mirror, center = {axis: datum[axis] for axis in axes}, state.flat(datum)[0]
    transform = Transform(mirror, angle=angle, center=center, plane=state.plane)
    if not before and not transform:
        state.log.inform("IGNORED", f"Cycle {number} is skipped: these values turn, mirror and scale nothing.", block)
    state.transformed(transform)


def _is_neutral(state: State, block: Block, number: int, body: str) -> bool:
    """True if a cycle's values change nothing."""
    pattern, neutral = _NEUTRAL[number]
    words = pattern.fullmatch(body)
    if words is None:
        return False
    return all(state.value(value, block) == neutral for value in words.groups() if value is not None)


def _define(state: State, block: Block, number: int) -> None:
    """Define a cycle that waits for its call, or a pattern, which calls the cycle before it at once."""
    if number in _PATTERN_CYCLES:
        _pass_over(state, block, number, None, pattern=True)
        return
    _take_values(state, block)
    text = f"Cycle {number} is skipped: it moves nothing."
    if number not in _CYCLES_WITHOUT_CALL:
        state.cycle = number
        text = f"Cycle {number} is skipped: it moves nothing before it is called."
    state.log.inform("IGNORED", text, block)


def _take_values(state: State, block: Block) -> None:
    """Forget the last heights, and set the cycle's values as parameters unless they cannot be evaluated here."""
    for name in _HEIGHT_PARAMETERS:
        state.parameters.pop(name, None)
    for name, formula in _VALUE.findall("\n".join((block.body, *block.more))):
        value = evaluate(formula, state.parameters)
        if isinstance(value, float):
            state.parameters[f"Q{name}"] = value


def _end_height(state: State) -> float | None:
    """Return the tool axis's height at a drilling cycle's end, in millimeters: the larger clearance above Q203."""
    values = state.parameters
    if not values.keys() >= _HEIGHT_PARAMETERS:
        return None
    height = to_mm(values["Q203"] + max(values["Q200"], values["Q204"]), state.unit)
    return height + state.shift[state.plane.axes[2]]


def _call_block(state: State, block: Block) -> None:
    """CYCL CALL: call the cycle here, at a position with POS, or at all points of a pattern with PAT."""
    head = _POSITION.match(block.body)
    rest = block.after(head.end() if head else 0)
    if head and head[1] == "POS":
        words = state.words(rest, COMMON_WORDS | frozenset(AXIS_WORDS))
        _refuse_compensated(state, block)
        for index, value in enumerate(state.target(words)):
            state.position[index] = value
    elif head and head[1] == "PAT" and state.cycle is not None:
        _pass_over(state, block, state.cycle, None, pattern=True)
        return
    else:
        state.words(rest, frozenset(("M",)))
    call(state, block)


def call(state: State, block: Block) -> None:
    """Call the cycle defined last, for CYCL CALL or M99."""
    if state.cycle is None:
        state.log.stop("CYCLE", "No cycle is defined before this call. Write its CYCL DEF before.", block)
    if state.cycle == _PROGRAM_CALL_CYCLE:
        state.log.stop("BEYOND", "Cycle 12 runs another file. Copy its blocks in.", block)
    if state.cycle in _CONTOUR_CYCLES:
        text = f"Cycle {state.cycle} mills a contour by itself, which is not supported. Nothing of it is judged."
        state.log.stop("BEYOND", text, block)
    _pass_over(state, block, state.cycle, _end_height(state))


def _refuse_compensated(state: State, block: Block) -> None:
    if state.applied or state.side:
        text = "A cycle under compensation is not supported. Cancel it in an L block with R0 before."
        state.log.stop("CYCLE", text, block)


def _pass_over(state: State, block: Block, number: int, height: float | None, *, pattern: bool = False) -> None:
    """Skip a cycle's moves, and set where it ends, or make that unknown until the next absolute words.

    After a pattern, the tool is over the last of its points.
    """
    _refuse_compensated(state, block)
    state.waiting.flush()
    state.last = None
    severity, template = Severity.WARNING, NOT_JUDGED
    if number in _DRILLING_CYCLES or number in _TAPPING_CYCLES or number in state.reported_cycles:
        severity, template = Severity.INFO, SKIPPED_TEXT
    state.reported_cycles.add(number)
    if number in _RETURNING_CYCLES and not pattern:
        state.log.report(severity, "CYCLE", template.format(number, "it ends where it began"), block)
        return
    third = state.plane.axes[2]
    if number in _DRILLING_CYCLES and height is not None:
        end = state.position.copy()
        end[third] = height
        if end != state.position:
            element = straight_element(state, block, end, rapid=True, feed=0.0)
            state.push(ProgrammedStep(Role.DEPTH, element, 0.0, state.plane))
        state.position = end
        state.now_known({third})
        state.log.inform("CYCLE", SKIPPED_TEXT.format(number, "it ends above its hole"), block)
        return
    unknown = {third} if number in _DRILLING_CYCLES and not pattern else {0, 1, 2}
    state.known -= unknown
    names = " and ".join("XYZ"[axis] for axis in sorted(unknown))
    text = template.format(number, f"cutcomp takes {names} from the next absolute words")
    state.log.report(severity, "CYCLE", text, block)
