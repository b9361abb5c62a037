"""Setup blocks do not cut: program begin and end, tools, datum shifts, and blocks that are refused or skipped."""

from __future__ import annotations

import re
from math import inf
from typing import Final, NoReturn

from core.controls.control_tools import MAX_DIGITS, tool_id
from core.controls.klartext.reader import MAX_LINE_LENGTH, TOO_LONG, TOOL_WORD, Block
from core.controls.klartext.state import State, Words
from core.controls.moves import Plane
from core.controls.program_text import quoted
from core.units import Unit, to_mm

_BEGIN: Final = re.compile(r"\s*PGM(?:\s+(\S.*?))?\s+(MM|INCH)\s*$", re.ASCII)
_NUMBERED: Final = re.compile(r'\s*(DEF|CALL)\b\s*(?:"([^"]*)"|([+-]?\d+(?:[.,]\d+)?)(?![\d.])|(Q[LR]?\d+))?', re.ASCII)
_UNSUPPORTED: Final = (
    (re.compile(r"CALL\s*PGM|PGM\s*CALL", re.ASCII), "runs another file. Copy its blocks in."),
    (
        re.compile(r"F(?:L|LT|C|CT|POL|SELECT)\b", re.ASCII),
        "is free contour programming (FK), which is not supported. Write L, C, CR or CT with end points.",
    ),
    (re.compile(r"FN\b|IF\b", re.ASCII), "is not supported. Use FN 0 to 13 with numbers."),
    (re.compile(r"PLANE\b|TRANS\b", re.ASCII), "turns, mirrors or tilts, which is not supported."),
    (re.compile(r"PATTERN\b", re.ASCII), "names points for cycles, which is not supported."),
    (re.compile(r"FUNCTION\b|SEL\b", re.ASCII), "is not supported, and the path after it could be wrong."),
    (re.compile(r"[XYZ]\s*[-+]?[\d.Q]", re.ASCII), "is a paraxial block, which is not supported. Write L before it."),
)
"""Blocks that the control knows but cutcomp does not support, each with the end of the sentence about it."""

_SPATIAL: Final = re.compile(
    r"\s*SPATIAL\s+SPA\s*([-+.,\dQLR]+)\s+SPB\s*([-+.,\dQLR]+)\s+SPC\s*([-+.,\dQLR]+)\s+STAY\b", re.ASCII
)
MAX_WORN_SHARE: Final = 0.1
"""Share of a tool's radius that may be ground away; a DR that takes off more may be a mistake."""

_PLANE_OF_TOOL_AXIS: Final = {"Z": Plane.XY, "X": Plane.YZ, "Y": Plane.ZX}
_TOOL_DEF_WORDS: Final = frozenset(("L", "R", "R2", "DL", "DR", "DR2"))
_TOOL_CALL_WORDS: Final = frozenset(("S", "F", "DL", "DR", "DR2", "X", "Y", "Z"))
_SHIFT_WORDS: Final = {f"{step}{name}": axis for step in ("", "I") for axis, name in enumerate("XYZ")}


def begin(state: State, block: Block) -> None:
    """BEGIN PGM name MM or INCH."""
    name_and_unit = _BEGIN.match(block.body)
    if name_and_unit is None:
        state.log.stop("UNIT", "BEGIN PGM needs a name and MM or INCH. Write BEGIN PGM PART MM.", block)
    if state.begun:
        state.log.stop("PROGRAM", "A second program begins here. Keep one program in a file.", block)
    state.begun = True
    state.unit = Unit.IN if name_and_unit[2] == "INCH" else Unit.MM
    if state.unit is Unit.IN:
        text = "cutcomp takes F as inches per minute. Some of these controls take tenths of an inch per minute."
        state.log.inform("UNIT", text, block)


def end(state: State, block: Block) -> None:
    """END PGM."""
    if not block.body.strip().startswith("PGM"):
        state.log.stop("WORD", "END needs PGM, the program's name and unit.", block)
    state.ended = True


def skip(state: State, block: Block, text: str) -> None:
    """Skip a block that moves nothing."""
    state.log.inform("IGNORED", text, block)


def bracketed(state: State, block: Block) -> None:
    """Skip a line in brackets, a comment in other languages; before BEGIN PGM the bracket may be left open."""
    if state.begun and not block.body.rstrip().endswith(")"):
        unknown(state, block)
    state.log.inform("IGNORED", "A line in brackets is skipped as a comment.", block)


def structure(state: State, block: Block) -> None:
    """Skip a structuring line `* - text`."""


def plane(state: State, block: Block) -> None:
    """Skip PLANE RESET STAY, and PLANE SPATIAL STAY with angles of 0, which tilt nothing; refuse any other PLANE."""
    angles = _SPATIAL.match(block.body)
    if angles is not None and all(state.value(angle, block) == 0.0 for angle in angles.groups()):
        state.parameters |= dict.fromkeys(("Q120", "Q121", "Q122"), 0.0)
    elif block.body.split() != ["RESET", "STAY"]:
        unknown(state, block)
    skip(state, block, "PLANE without a tilt moves nothing and is skipped.")


def function(state: State, block: Block) -> None:
    """Skip FUNCTION RESET and FUNCTION MODE MILL, which are in force anyway; refuse any other FUNCTION."""
    if block.body.split()[:1] != ["RESET"] and block.body.split()[:2] != ["MODE", "MILL"]:
        unknown(state, block)
    skip(state, block, f"FUNCTION {' '.join(block.body.split())} moves nothing and is skipped.")


def unknown(state: State, block: Block) -> NoReturn:
    """Stop the program at a block that is unknown or not supported."""
    if block.head == TOO_LONG:
        state.log.stop("WORD", f"This line has more than {MAX_LINE_LENGTH} characters. No control takes it.", block)
    whole = block.head + block.body
    why = next((why for pattern, why in _UNSUPPORTED if pattern.match(whole)), "")
    if why:
        state.log.stop("BEYOND", f"{quoted(whole)} {why}", block)
    state.log.stop("WORD", f"{quoted(whole)} is not a Klartext block. Write L, C, CR, CT, APPR or DEP.", block)


def tool(state: State, block: Block) -> None:
    """TOOL DEF and TOOL CALL."""
    number = _NUMBERED.match(block.body)
    if number is None:
        unknown(state, block)
    rest = block.after(number.end())
    name = number[2] if number[2] is not None else (number[3] or "").replace(",", ".").removeprefix("+")
    if number[4]:
        value = state.value(number[4], block)
        if not (0.0 <= value < 10.0**MAX_DIGITS and value.is_integer()):
            state.log.stop("TOOL", f"{number[4]} is no tool number. Give it a whole number.", block.at(number[4]))
        name = str(int(value))
    if number[1] == "DEF":
        _define(state, name, state.words(rest, _TOOL_DEF_WORDS, TOOL_WORD))
    else:
        _call(state, name, state.words(rest, _TOOL_CALL_WORDS, TOOL_WORD))


def _define(state: State, name: str, words: Words) -> None:
    """TOOL DEF n L R: set a tool's radius; without R the block only names the next tool."""
    if not name:
        state.log.stop("TOOL", "TOOL DEF needs the tool's number. Write TOOL DEF 1 L+0 R+5.", words.block)
    if "R" in words:
        delta = state.length(words, "DR") if "DR" in words else 0.0
        state.defined[name] = state.length(words, "R") + delta


def _call(state: State, name: str, words: Words) -> None:
    if "F" in words:
        state.feed = state.tool_feed = state.length(words, "F")
    if "S" in words:
        state.speed = state.number(words, "S")
        state.note_spindle()
    if not name and not words.keys() & ({"DR"} | _PLANE_OF_TOOL_AXIS.keys()):
        return
    if state.applied and not state.side:
        text = "cutcomp assumes that R0 with the tool axis alone cancels compensation where the tool is changed."
        state.log.inform("INTERPRETED", text, words.block)
        state.waiting.flush()
        state.waiting.center.finish()
        state.release()
    if state.applied:
        text = "The tool cannot be changed under compensation. Cancel it with R0 or DEP first."
        state.log.stop("TOOL", text, words.block)
    state.waiting.flush()
    axes = sorted(words.keys() & _PLANE_OF_TOOL_AXIS.keys())
    if len(axes) > 1:
        state.log.stop("TWICE", f"{axes[0]} and {axes[1]} are both tool axes. Keep one.", words.at(axes[1]))
    if axes and _PLANE_OF_TOOL_AXIS[axes[0]] is not state.plane:
        state.plane, state.pole = _PLANE_OF_TOOL_AXIS[axes[0]], None
    if name not in ("", state.tool) and len(state.waiting.center.tape) > 1:
        # the machine raises the tool to where it changes it
        state.at_machine_place.add(state.plane.axes[2])
    state.tool = name or state.tool
    state.note_spindle()
    state.last = None
    _take_radius(state, words)


def _take_radius(state: State, words: Words) -> None:
    """Set the radius of the tool in force: from the tool table if it has the tool, else from TOOL DEF, with deltas."""
    delta = state.length(words, "DR") if "DR" in words else 0.0
    listed = state.tools.get(tool_id(state.tool))
    defined = state.defined.get(state.tool)
    if listed is not None:
        radius = listed.diameter_mm(state.unit) / 2.0
        if defined is not None and abs(radius - defined) > 0.0:
            text = "cutcomp takes radius {0} from the tool table, not radius {1} from TOOL DEF."
            state.log.inform("TOOL", text, words.block, lengths=(radius, defined))
    elif state.tool == "0":
        radius = 0.0
    else:
        radius = inf if defined is None else defined
    state.radius = None if radius == inf else radius + delta
    if state.radius is not None:
        if delta and state.radius > 0.0:
            text = "The tool radius is {0} with DR. It is judged as this wide."
            if delta < -MAX_WORN_SHARE * radius:
                text = "DR makes the tool radius {0} instead of {1}. Unless it is that worn, it cuts {2} too deep."
                state.log.warn("TOOL", text, words.at("DR"), lengths=(state.radius, radius, -delta))
            else:
                state.log.inform("TOOL", text, words.at("DR"), lengths=(state.radius,))
        state.parameters["Q108"] = state.radius / to_mm(1.0, state.unit)


def shift(state: State, block: Block) -> None:
    """Shift the datum: absolute words count from the unshifted datum, incremental ones from the last shift."""
    words = state.words(block, frozenset(_SHIFT_WORDS))
    if not words:
        state.log.stop("WORD", "A datum shift needs an axis and a value. Write X+10.", block)
    for name, axis in _SHIFT_WORDS.items():
        if name in words:
            value = state.length(words, name)
            state.shift[axis] = state.shift[axis] + value if name[0] == "I" else value
    state.pole = None
    state.datum_moved = bool(state.transform)


def transformation(state: State, block: Block) -> None:
    """TRANS DATUM AXIS and TRANS DATUM RESET: shift the datum, or undo the shift."""
    head = re.match(r"\s*DATUM\s+(AXIS|RESET)\b", block.body, re.ASCII)
    if head is None:
        unknown(state, block)
    elif head[1] == "AXIS":
        shift(state, block.after(head.end()))
    else:
        state.shift, state.pole = [0.0, 0.0, 0.0], None
        state.datum_moved = bool(state.transform)
