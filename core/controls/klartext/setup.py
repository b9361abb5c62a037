"""What a Klartext program sets before it moves: its name and unit, the blank, tools, datum shifts."""

from __future__ import annotations

import re
from math import inf
from typing import Final

from core.controls.klartext.blocks import LONGEST, TOO_LONG, TOOL_WORD, Block
from core.controls.klartext.state import State, Words
from core.controls.moves import Plane
from core.controls.program_text import quoted
from core.finding import Severity
from core.units import Unit, to_mm

_BEGIN: Final = re.compile(r"\s*PGM(?:\s+(\S+))?\s+(MM|INCH)\s*$", re.ASCII)
_NUMBERED: Final = re.compile(r'\s*(DEF|CALL)\b\s*(?:"([^"]*)"|([+-]?\d+(?:[.,]\d+)?)(?![\d.]))?', re.ASCII)
_CYCLE: Final = re.compile(r"\s*(DEF|CALL)\s*(?:(\d+)(?:\.(\d+))?)?", re.ASCII)
_NEUTRAL: Final = {
    8: re.compile(r"\s*", re.ASCII),
    10: re.compile(r"\s*ROT\s*[+-]?0*(?:\.0*)?\s*", re.ASCII),
    11: re.compile(r"\s*SCL\s*\+?0*1(?:\.0*)?\s*", re.ASCII),
    19: re.compile(r"(?:\s*[ABC]\s*[+-]?0+(?:\.0*)?)*\s*", re.ASCII),
}
"""Cycles that turn, mirror, scale or tilt, and what stands behind them where they do none of it."""

_BEYOND: Final = (
    (re.compile(r"CALL\s*PGM|PGM\s*CALL", re.ASCII), "runs another file, which is not read here; copy its blocks in."),
    (re.compile(r"F(?:L|LT|C|CT|POL|SELECT)\b", re.ASCII), "is free contour programming (FK), which is not worked out"
     " here; write L, C, CR or CT with end points."),
    (re.compile(r"FN\b|IF\b", re.ASCII), "is a function that is not worked out here; FN 0 to 13 with numbers are."),
    (re.compile(r"PLANE\b|TRANS\b", re.ASCII), "turns, mirrors or tilts, which is not worked out here."),
)  # fmt: skip
"""Blocks that the control knows and that are not followed here, and what is to be said of them."""

_PLANES: Final = {"Z": Plane.XY, "X": Plane.YZ, "Y": Plane.ZX}
_AXES: Final = frozenset(_PLANES)
_DEF: Final = frozenset(("L", "R", "R2", "DL", "DR", "DR2"))
_CALL: Final = frozenset(("S", "F", "DL", "DR", "DR2", "X", "Y", "Z"))
_SHIFTING: Final = {f"{step}{name}": axis for step in ("", "I") for axis, name in enumerate("XYZ")}


def begin(state: State, block: Block) -> None:
    """BEGIN PGM name MM or INCH."""
    found = _BEGIN.match(block.body)
    if found is None:
        state.stop("UNIT", "BEGIN PGM needs a name and MM or INCH; write BEGIN PGM PART MM.", block)
    if state.begun:
        state.stop("PROGRAM", "A second program begins here; keep one program in a file.", block)
    state.begun = True
    state.unit = Unit.IN if found[2] == "INCH" else Unit.MM
    if state.unit is Unit.IN:
        text = "F is taken as inches a minute; some of these controls take tenths of an inch a minute."
        state.tell(Severity.INFO, "UNIT", text, block)


def end(state: State, block: Block) -> None:
    """END PGM."""
    if not block.body.strip().startswith("PGM"):
        state.stop("WORD", "The program ends with END PGM, its name and unit.", block)
    state.ended = True


def ignored(state: State, block: Block) -> None:
    """BLK FORM and the like: nothing that moves."""
    state.tell(Severity.INFO, "IGNORED", f"{quoted(block.head)} moves nothing and is passed over.", block)


def structure(state: State, block: Block) -> None:
    """A structuring line `* - text`."""


def plane(state: State, block: Block) -> None:
    """PLANE RESET STAY, which undoes a tilting there is none of; any other PLANE is not worked out here."""
    if block.body.split() != ["RESET", "STAY"]:
        unknown(state, block)
    ignored(state, block)


def unknown(state: State, block: Block) -> None:
    """A block that is not understood, or not worked out here: the program stops."""
    if block.head == TOO_LONG:
        state.stop("WORD", f"This line has more than {LONGEST} signs; no control takes it.", block)
    whole = block.head + block.body
    why = next((why for pattern, why in _BEYOND if pattern.match(whole)), "")
    text = "is not understood here; write L, C, CR, CT, APPR or DEP."
    state.stop("WORD", f"{quoted(whole)} {why or text}", block)


def tool(state: State, block: Block) -> None:
    """TOOL DEF and TOOL CALL."""
    found = _NUMBERED.match(block.body)
    if found is None:
        unknown(state, block)
        return
    rest = block._replace(body=" " * found.end() + block.body[found.end() :])
    name = found[2] if found[2] is not None else (found[3] or "").replace(",", ".").removeprefix("+")
    if found[1] == "DEF":
        _define(state, rest, name, state.words(rest, _DEF, TOOL_WORD))
    else:
        _call(state, rest, name, state.words(rest, _CALL, TOOL_WORD))


def _define(state: State, block: Block, name: str, words: Words) -> None:
    """TOOL DEF n L R: without a radius it only names the tool that comes next."""
    if not name:
        state.stop("TOOL", "TOOL DEF needs the tool's number; write TOOL DEF 1 L+0 R+5.", block)
    if "R" in words:
        delta = state.length(block, words, "DR") if "DR" in words else 0.0
        state.defined[name] = state.length(block, words, "R") + delta


def _call(state: State, block: Block, name: str, words: Words) -> None:
    if "F" in words:
        state.feed = state.tool_feed = state.length(block, words, "F")
    if not name and not words.keys() & ({"DR"} | _AXES):
        return
    if state.applied:
        text = "The tool cannot be changed under compensation; cancel it with R0 or DEP first."
        state.stop("TOOL", text, block)
    state.flush()
    axes = sorted(words.keys() & _AXES)
    if len(axes) > 1:
        state.stop("TWICE", f"{axes[0]} and {axes[1]} stand as tool axes; keep one.", block, axes[1])
    if axes and _PLANES[axes[0]] is not state.plane:
        state.plane, state.pole = _PLANES[axes[0]], None
    state.tool = name or state.tool
    state.last = None
    delta = state.length(block, words, "DR") if "DR" in words else 0.0
    _take(state, block, delta)


def _take(state: State, block: Block, delta: float) -> None:
    """Radius of the tool in force: of the tool table if it has the tool, else of TOOL DEF, with the deltas."""
    listed = state.tools.get(int(state.tool)) if state.tool.isdecimal() and len(state.tool) < 9 else None
    defined = state.defined.get(state.tool)
    if listed is not None:
        radius = listed.diameter_mm(state.unit) / 2.0
        if defined is not None and abs(radius - defined) > 0.0:
            text = "The tool table's radius {0} is taken instead of the radius {1} of TOOL DEF."
            state.tell(Severity.INFO, "TOOL", text, block, "", radius, defined)
    elif state.tool == "0":
        radius = 0.0
    else:
        radius = inf if defined is None else defined
    state.radius = None if radius == inf else radius + delta
    if state.radius is not None:
        state.parameters["Q108"] = state.radius / to_mm(1.0, state.unit)


def cycle(state: State, block: Block) -> None:
    """CYCL DEF and CYCL CALL: the datum shift is done, cycles that wait for their call are passed over."""
    found = _CYCLE.match(block.body)
    number = int(found[2][:6]) if found and found[2] else 0
    rest = block._replace(body=" " * found.end() + block.body[found.end() :]) if found else block
    if found is None or found[1] == "CALL" or not number:
        text = "Cycles are not worked out here: their moves are not known, so the run ends before them."
        state.stop("WORD", text, block)
    elif number == 7:
        if found[3] not in (None, "0"):
            shift(state, rest)
    elif number in _NEUTRAL and found[3] == "0":
        return  # only the cycle's name; what it does stands behind it
    elif number in _NEUTRAL and _NEUTRAL[number].fullmatch(rest.body):
        text = f"Cycle {number} is passed over: here it turns nothing, mirrors nothing and scales nothing."
        state.tell(Severity.INFO, "IGNORED", text, block)
    elif number == 247 and len(state.center.record.tape) == 1 and state.waiting is None:
        text = "Cycle 247 chooses the workpiece's datum, from which everything is quoted."
        state.tell(Severity.INFO, "IGNORED", text, block)
    elif number in (8, 10, 11, 19, 26, 27, 28, 29, 220, 221, 247) or number >= 400:
        text = f"Cycle {number} changes where things are; it is not worked out here."
        state.stop("WORD", text, block)
    else:
        text = f"Cycle {number} is passed over: it moves nothing before it is called."
        state.tell(Severity.INFO, "IGNORED", text, block)


def shift(state: State, block: Block) -> None:
    """A datum shift: absolute words count from the unshifted datum, incremental ones from the last shift."""
    words = state.words(block, frozenset(_SHIFTING))
    if not words:
        state.stop("WORD", "A datum shift needs an axis and a value here; write X+10.", block)
    for name, axis in _SHIFTING.items():
        if name in words:
            value = state.length(block, words, name)
            state.shift[axis] = state.shift[axis] + value if name[0] == "I" else value
    state.pole = None


def transformation(state: State, block: Block) -> None:
    """TRANS DATUM AXIS and TRANS DATUM RESET."""
    found = re.match(r"\s*DATUM\s+(AXIS|RESET)\b", block.body, re.ASCII)
    if found is None:
        unknown(state, block)
    elif found[1] == "AXIS":
        shift(state, block._replace(body=" " * found.end() + block.body[found.end() :]))
    else:
        state.shift, state.pole = [0.0, 0.0, 0.0], None
