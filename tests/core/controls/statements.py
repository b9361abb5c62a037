"""The makers' statements row by row: a small program for each, and what it must do by hand calculation.

Paths are in the notation of `hand.shape`; `path` None leaves them to the rules.  `rules` are the rules told, with the
line; a rule with a minus sign must not be told.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import NamedTuple


class Row(NamedTuple):
    """One statement: the control, the program, the diameters of its tools, and what must come."""

    statement: str
    control: str
    text: str
    tools: Mapping[str, float]
    path: tuple[tuple[object, ...], ...] | None = None
    rules: tuple[tuple[str, int], ...] = ()
    stops: int | None = None


_ON = "G0G41X0Y1.\nG1X0Y0F20.\n"
_OFF = "G1X9.\nY-9.\nG40X12.Y-12.\n"
_HALF = {"t1": 0.5}

THREEBLOCK = (
    Row(
        "data in the text: the length left out, the diameter negative, the tool called by it",
        "threeblock",
        "T5//-.5;\nG70G0G41X0Y1.\nG1X0Y0F20.\nX9.\nY-9.\nX4.\nG40Y-12.\n",
        {},
        (
            ("rapid", 0, 1),
            ("line", 0, -0.25),
            ("line", 8.75, -0.25),
            ("line", 8.75, -8.75),
            ("line", 4, -8.75),
            ("line", 4, -12),
        ),
    ),
    Row("both values", "threeblock", f"T4/.75/.2;\nG70{_ON}{_OFF}", {}, None, (("-TOOL", 1),)),
    Row("3.2768 in are allowed", "threeblock", f"T1//3.2768\nG70{_ON}{_OFF}", {}, None, (("-B4-MAX", 2),)),
    Row("3.2769 in are not", "threeblock", f"T1//3.2769\nG70{_ON}{_OFF}", {}, (), (("B4-MAX", 2),), 2),
    Row("nor are -3.2769 in", "threeblock", f"T1//-3.2769\nG70{_ON}{_OFF}", {}, (), (("B4-MAX", 2),), 2),
    Row("83.23 mm are allowed", "threeblock", f"G71T1//83.23\n{_ON}X99.\n", {}, None, (("-B4-MAX", 2),)),
    Row("the 83.321 mm printed are not", "threeblock", f"G71T1//83.321\n{_ON}X99.\n", {}, None, (("B4-MAX", 2),), 2),
    Row("tool numbers end at 24", "threeblock", "G70T25//.5\n", {}, (), (("B19-TRANGE", 1),), 1),
    Row("the tool comes before", "threeblock", f"G70{_ON}", {}, (), (("B5-TOOL", 1),), 1),
    Row("a tool without data", "threeblock", f"G70T3\n{_ON}", {}, (), (("B5-TOOL", 2),), 2),
    Row("the plane is XY", "threeblock", f"G70G18T1\n{_ON}", _HALF, (), (("B1-PLANE", 2),), 2),
    Row(
        "G41 with G0 or G1 only",
        "threeblock",
        "G70T1\nG1X1.F9.\nG3X2.Y1.I1.J1.\nG41X3.Y2.I2.J2.\n",
        _HALF,
        None,
        (("B2-MODE", 4),),
        4,
    ),
    Row(
        "diameter 0 turns nothing on, and nothing is refused then",
        "threeblock",
        "G70T1\nG0G41X0Y1.\nG1X0Y0F20.\nM8\nX9.\n",
        {"t1": 0},
        (("rapid", 0, 1), ("line", 0, 0), ("line", 9, 0)),
        (("B3-DIA0", 2), ("-B14-MCODE", 4)),
    ),
    Row(
        "outside corner from a line to a circle",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG2X5.Y-1.I4.J-1.\nG1Y-3.\nX6.\nG40X9.\n",
        {"t1": 0.5},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 5.25, -1, 4, -1),
            ("line", 5.25, -2.75),
            ("line", 6, -2.75),
            ("line", 9, -3),
        ),
    ),
    Row(
        "outside corner from a line to a circle that bends away",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG3X8.Y0I6.J0\nG1Y5.\nG40Y9.\n",
        {"t1": 0.5},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 4.25, 0, 4, 0),
            ("ccw", 7.75, 0, 6, 0),
            ("line", 7.75, 5),
            ("line", 8, 9),
        ),
    ),
    Row(
        "inside corner from a circle to a circle: circles of 1.25 about (4, -1) and (5, -2)",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG2X5.Y-1.I4.J-1.\nX6.Y-2.I5.J-2.\nG1Y-4.\nG40X9.\n",
        {"t1": 0.5},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 4.5 + sqrt(1.0625 / 2), -1.5 + sqrt(1.0625 / 2), 4, -1),
            ("cw", 6.25, -2, 5, -2),
            ("line", 6.25, -4),
            ("line", 9, -4),
        ),
    ),
    Row(
        "outside corner from a circle to a circle",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG2X5.Y-1.I4.J-1.\nX4.Y0I5.J0\nG1Y5.\nG40X9.\n",
        {"t1": 0.5},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 5.25, -1, 4, -1),
            ("cw", 5, -1.25, 5, -1),
            ("cw", 3.75, 0, 5, 0),
            ("line", 3.75, 5),
            ("line", 9, 5),
        ),
    ),
    Row(
        "inside corner of two lines",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY3.\nX2.\nG40X0\n",
        {"t1": 0.5},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 3.75, 0.25),
            ("line", 3.75, 2.75),
            ("line", 2, 2.75),
            ("line", 0, 3),
        ),
    ),
    Row(
        "outside corner of a 3-4-5 triangle is an arc about the corner",
        "threeblock",
        f"G70T1\n{_ON}X4.\nX1.Y-4.\nX0\nG40Y-9.\n",
        {"t1": 1.0},
        (
            ("rapid", 0, 1),
            ("line", 0, 0.5),
            ("line", 4, 0.5),
            ("cw", 4 + 0.4, -0.3, 4, 0),
            ("line", 1 + 0.4, -4.3),
            ("cw", 1, -4.5, 1, -4),
            ("line", 0, -4.5),
            ("line", 0, -9),
        ),
    ),
    Row(
        "G40 alone leaves with the next move",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-3.\nG40\nX9.\n",
        _HALF,
        (
            ("rapid", 0, 1),
            ("line", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 4.25, 0, 4, 0),
            ("line", 4.25, -3),
            ("line", 9, -3),
        ),
    ),
    Row("an M code in the block with G41 is allowed", "threeblock", f"G70T1\nM8{_ON}{_OFF}", _HALF, None, ()),
    Row(
        "an M code in the block with G40 is not",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-3.\nG40X9.M9\n",
        _HALF,
        None,
        (("B14-MCODE", 6),),
        6,
    ),
    Row("an M code behind it is", "threeblock", f"G70T1\n{_ON}X4.\nY-3.\nG40X9.\nM9\n", _HALF, None, ()),
    Row(
        "five blocks are the least",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG40X9.\n",
        _HALF,
        None,
        (("B7-MIN5", 5),),
        5,
    ),
    Row(
        "the other side needs G40",
        "threeblock",
        f"G70T1\n{_ON}X4.\nG42Y-3.\n",
        _HALF,
        None,
        (("B8-SIDE", 5),),
        5,
    ),
    Row("another tool needs G40", "threeblock", f"G70T1\n{_ON}X4.T2\n", _HALF, None, (("B9-AMOUNT", 4),), 4),
    Row("a block without a move", "threeblock", f"G70T1\n{_ON}F30.\n", _HALF, None, (("B10-NOMOVE", 4),), 4),
    Row(
        "a move back along its own line",
        "threeblock",
        f"G70T1\n{_ON}X4.\nX2.\n",
        _HALF,
        None,
        (("B11-COLLINEAR", 5),),
        5,
    ),
    Row(
        "Z with a straight move is not compensated",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-3.\nX2.Z-.5\nY-5.\nX0\nY-9.\nG40X-3.\n",
        _HALF,
        None,
        (("-B12-ZENDS", 6),),
    ),
    Row(
        "Z in the third compensated block",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-3.Z-.5\nX2.\nY-5.\nX0\nG40X-3.\n",
        _HALF,
        None,
        (("B12-ZENDS", 5),),
        5,
    ),
    Row(
        "Z in the third last compensated block",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-3.\nX2.Z-.5\nY-5.\nX0\nG40X-3.\n",
        _HALF,
        None,
        (("B12-ZENDS", 6),),
        9,
    ),
    Row(
        "a short block dwells: .08 in at 20 in a minute are .24 s",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-.08\nX9.\nY-9.\nG40X12.\n",
        {"t1": 0.01},
        None,
        (("B18-SHORT", 5),),
    ),
    Row(
        "a block of .09 in does not",
        "threeblock",
        f"G70T1\n{_ON}X4.\nY-.09\nX9.\nY-9.\nG40X12.\n",
        {"t1": 0.01},
        None,
        (("-B18-SHORT", 5),),
    ),
    Row(
        "the approach may be a rapid",
        "threeblock",
        "G70T1\nG0G41X0Y1.\nX0Y0\nG1X4.F20.\nY-3.\nG0G40X9.\n",
        _HALF,
        (
            ("rapid", 0, 1),
            ("rapid", 0, 0.25),
            ("line", 4, 0.25),
            ("cw", 4.25, 0, 4, 0),
            ("line", 4.25, -3),
            ("rapid", 9, -3),
        ),
    ),
    Row("no subprograms", "threeblock", "G70\nM98P1\n", {}, (), (("SUBPROGRAM", 2),), 2),
    Row("a tool offset the program does not know of", "threeblock", "G70G43H1\nG1X1.F9.\n", {}, None, ()),
)

_R = "G21 G17 F100\n"
_SIX = {"t1": 6}

ROSETTACNC = (
    Row("D is a tool's number", "rosettacnc:easy", f"{_R}G41 D7\n", _SIX, (), (("C1", 2),), 2),
    Row("D is not 0", "rosettacnc:easy", f"{_R}G41 D0\n", _SIX, (), (("C1", 2),), 2),
    Row("D is a whole number", "rosettacnc:easy", f"{_R}G41 D1.5\n", _SIX, (), (("C1", 2),), 2),
    Row("without D the loaded tool counts", "rosettacnc:easy", f"{_R}M6 T1\nG41\nG1 X9\nX20\n", _SIX,
        (("line", 9, 3), ("line", 20, 3))),
    Row("no tool and no D is radius 0", "rosettacnc:easy", f"{_R}G41\nG1 X9\nX20\n", _SIX,
        (("line", 9, 0), ("line", 20, 0)), (("RADIUS0", 2),)),
    Row("I comes off the radius", "rosettacnc:easy", f"{_R}G42 D1 I.5\nG1 X9\nX20\n", _SIX,
        (("line", 9, -2.5), ("line", 20, -2.5))),
    Row("a negative I adds to it", "rosettacnc:easy", f"{_R}G42 D1 I-.5\nG1 X9\nX20\n", _SIX,
        (("line", 9, -3.5), ("line", 20, -3.5))),
    Row("a diameter below 0 in the table changes the side", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nX20\n", {"t1": -6},
        (("line", 9, -3), ("line", 20, -3)), (("NEGATIVE", 2),)),
    Row("a tool of diameter 0 is told", "rosettacnc:normal", f"{_R}G41 D1\nG1 X9\nX20\n", {"t1": 0},
        (("line", 9, 0), ("line", 20, 0)), (("RADIUS0", 2),)),
    *(
        Row(f"{code} while on", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nX20\n{code}\n", _SIX, None, (("C2", 5),), 5)
        for code in ("G41 D1", "G42 D1", "G41.1 D6", "G42.1 D6")
    ),
    Row("G41.1 takes a diameter", "rosettacnc:easy", f"{_R}G41.1 D5\nG1 X9\nX20\n", {},
        (("line", 9, 2.5), ("line", 20, 2.5))),
    Row("G41.1 does not work in YZ", "rosettacnc:easy", f"{_R}G19\nG41.1 D5\n", {}, (), (("C3", 3),), 3),
    Row("G41 does", "rosettacnc:easy", f"{_R}G19\nG41 D1\nG1 Y9\nY20\n", _SIX, (("line", 0, 9), ("line", 0, 20))),
    Row("L is 0 to 9", "rosettacnc:easy", f"{_R}G18\nG41.1 D5 L10\n", {}, (), (("C4", 3),), 3),
    Row("L is a whole number", "rosettacnc:easy", f"{_R}G18\nG41.1 D5 L1.5\n", {}, (), (("C4", 3),), 3),
    Row("L goes with XZ only, 0 too", "rosettacnc:easy", f"{_R}G41.1 D5 L0\n", {}, (), (("C5", 2),), 2),
    Row("an orientation is told not to shift the moves", "rosettacnc:easy", f"{_R}G18\nG41.1 D5 L3\nG1 Z9\nZ20\n", {},
        None, (("ORIENTATION", 3),)),
    Row("nist: an inside arc no larger than the tool", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nG3 X12 Y3 J3\n", _SIX,
        None, (("C7", 4),), 4),
    Row("an inside arc that is larger", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nG3 X13 Y4 J4\n", _SIX,
        (("line", 9, 3), ("ccw", 10, 4, 9, 4))),
    Row("outside corners are arcs about the corner", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nX20\nY-9\n", _SIX,
        (("line", 9, 3), ("line", 20, 3), ("cw", 23, 0, 20, 0), ("line", 23, -9))),
    Row("a concave corner is an error with easy", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nX20\nY9\n", _SIX, None,
        (("C6", 5),), 5),
    Row("normal goes into it", "rosettacnc:normal", f"{_R}G41 D1\nG1 X9\nX20\nY9\nG40\nY20\n", _SIX,
        (("line", 9, 3), ("line", 17, 3), ("line", 17, 9), ("line", 20, 20))),
    Row("nist enters on the tangent to the tool: the corner at its end is outside", "rosettacnc:nist",
        f"{_R}G41 D1\nG1 X5\nX5 Y-9\nG40\nX20\n", _SIX,
        (("line", 5 - 3 * 0.6, 3 * 0.8), ("cw", 8, 0, 5, 0), ("line", 8, -9), ("line", 20, -9))),
    Row("nist: the entry is longer than the radius", "rosettacnc:nist", f"{_R}G41 D1\nG1 X3\n", _SIX, (),
        (("C8", 3),), 3),
    Row("after G40 the next move starts where the tool is", "rosettacnc:easy",
        f"{_R}G41 D1\nG1 X9\nX20\nG40\nG0 X30 Y10\n", _SIX, (("line", 9, 3), ("line", 20, 3), ("rapid", 30, 10))),
    Row("incremental moves count from the programmed point", "rosettacnc:easy",
        f"{_R}G41 D1\nG1 X9\nG91 X11\nY-9\nG90\nX0\n", _SIX,
        (("line", 9, 3), ("line", 20, 3), ("cw", 23, 0, 20, 0), ("line", 23, -9), ("cw", 20, -12, 20, -9),
         ("line", 0, -12))),
    Row("an exact semicircle by R", "rosettacnc", f"{_R}G91 G3 X-100 R50\n", {}, (("ccw", -100, 0, -50, 0),)),
    Row("a negative R is the long way", "rosettacnc", f"{_R}G2 X3 Y3 R-3\n", {}, (("cw", 3, 3, 0, 3),)),
    Row("I and J count from the arc's start", "rosettacnc", f"{_R}G1 X10\nG3 X20 Y10 J10\n", {},
        (("line", 10, 0), ("ccw", 20, 10, 10, 10))),
    Row("G52 does not add up", "rosettacnc", f"{_R}G52 X150\nG0 X1\nG52 X-150\nG0 X1\n", {},
        (("rapid", 151, 0), ("rapid", -149, 0))),
    Row("a work offset nobody set", "rosettacnc", f"{_R}G55\nG0 X1\n", {}, (("rapid", 1, 0),), (("OFFSET", 2),)),
    Row("scaling off and rotation off", "rosettacnc", f"G50 G69 G49 G40 {_R}G0 X1\n", {}, (("rapid", 1, 0),)),
    Row("rotation on is not followed", "rosettacnc", f"{_R}G68 X0 Y0 R45\n", {}, (), (("BEYOND", 2),), 2),
    Row("scaling on is not followed", "rosettacnc", f"{_R}G51 X2\n", {}, (), (("BEYOND", 2),), 2),
    Row("macro calls are not followed", "rosettacnc", f"{_R}G65 P1\n", {}, (), (("BEYOND", 2),), 2),
    Row("M99 with a block number is not followed", "rosettacnc", f"{_R}M98 P1\nM2\nO1\nM99 P5\n", {}, (),
        (("BRANCH", 5),), 5),
    Row("the plane stays", "rosettacnc:easy", f"{_R}G41 D1\nG1 X9\nX20\nG18\n", _SIX, None, (("C8", 5),), 5),
)  # fmt: skip

_N = "G20 G17 G1 F10\n"
_QUIET = "S9\n" * 30
_ENTERED = (("line", 1, 1.25), ("line", 3, 1.25))

NINE_SERIES = (
    *(
        Row(f"activation: {text!r}", "nine-series:a", f"{_N}{text}\nX3\n", _HALF, _ENTERED)
        for text in ("G41 D1 X1 Y1;\n", "D1;\nG41 X1 Y1;\n", "D1;\nG41;\nX1 Y1;\n", "G41\nD1 X1 Y1\n", "G41\nD1\nX1Y1")
    ),
    Row("blocks without motion before the entry", "nine-series:a", f"{_N}G41 D1\n{_QUIET}X1 Y1\nX3\n", _HALF,
        (("line", 1, 1.25), ("line", 3, 1.25)), (("-R5", 30),)),
    Row("a move out of the plane does not enter", "nine-series:a", f"{_N}G41 D1\nZ-1\nX1 Y1\nX3\n", _HALF,
        (("line", 0, 0), ("line", 1, 1.25), ("line", 3, 1.25)), (("R12", 3),)),
    Row("no start in G2", "nine-series:a", f"{_N}G2 X2 I1\nG41 D1 X4 I1\n", _HALF, None, (("R1", 3),), 3),
    Row("no circular entry", "nine-series:a", f"{_N}G41 D1\nG2 X2 I1\n", _HALF, (), (("R1", 3),), 3),
    Row("no circular exit", "nine-series:a", f"{_N}G41 D1 X1\nX3\nG40\nG2 X5 I1\n", _HALF, None, (("R2", 5),), 5),
    Row("D0 does not cancel", "nine-series:a", f"{_N}G41 D1 X1\nX3\nX5 D0\n", _HALF, None, (("R3", 4),)),
    Row("a negative radius changes the side", "nine-series:a", f"{_N}G41 D1 X1\nX3\n", {"t1": -0.5},
        (("line", 1, -0.25), ("line", 3, -0.25)), (("R4", 2),)),
    Row("the least length of generated blocks is told as taken for 0", "nine-series:a",
        f"{_N}G41 D1 X1\nX4\nX0 Y-4\nX-3\n", _HALF, None, (("AMP", 4),)),
    Row("without generated blocks nothing is told", "nine-series:a", f"{_N}G41 D1 X1\nX4\nY-3\n", _HALF, None,
        (("-AMP", 4),)),
    Row("the least feed inside arcs is told as taken for 0", "nine-series:a",
        f"{_N}G41 D1 X1\nX4\nG3 X5 Y1 J1\nG1 Y3\n", _HALF, None, (("MFR", 4),)),
    Row("outside arcs keep the centre's feed", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG2 X5 Y-1 J-1\nG1 Y-3\n", _HALF,
        (("line", 1, 0.25), ("line", 4, 0.25), ("cw", 5.25, -1, 4, -1), ("line", 5.25, -3)), (("-MFR", 4),)),
    Row("an arc that reverses the direction", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG3 X4.2 Y.2 J.2\n", _HALF, None,
        (("R9", 4),), 4),
    Row("R9 cannot be switched off", "nine-series:a", f"{_N}M800\nG41 D1 X1\nX4\nG3 X4.2 Y.2 J.2\n", _HALF, None,
        (("R9", 5), ("R11", 2)), 5),
    Row("Z among compensated blocks", "nine-series:a", f"{_N}G41 D1 X1\nX4\nZ-1\nY3\nX0\n", _HALF,
        (("line", 1, 0.25), ("line", 3.75, 0.25), ("line", 3.75, 0.25), ("line", 3.75, 2.75), ("line", 0, 2.75))),
    Row("a change of side between lines", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG42 X8\nY3\n", _HALF,
        (("line", 1, 0.25), ("line", 4, 0.25), ("line", 4, -0.25), ("line", 8.25, -0.25), ("line", 8.25, 3)),
        (("CHANGE", 4),)),
    Row("a change of side onto an arc: where the paths meet", "nine-series:a",
        f"{_N}G41 D1 X1\nX4\nG42 G2 X6 Y-2 J-2\nG1 Y-4\n", _HALF,
        (("line", 1, 0.25), ("line", 4, 0.25), ("line", 4, -0.25), ("cw", 5.75, -2, 4, -2), ("line", 5.75, -4))),
    Row("X with G4 is a time", "nine-series:a", f"{_N}X1\nG4 X3\nX2\n", {}, (("line", 1, 0), ("line", 2, 0)),
        (("DWELL", 3),)),
    Row("words nothing takes are told", "nine-series:a", f"{_N}X1 Q4\nX2 I3\n", {}, (("line", 1, 0), ("line", 2, 0)),
        (("UNUSED", 2), ("UNUSED", 3))),
    Row("repeats are whole", "nine-series:a", f"{_N}M98 P1 L2.5\nM30\nO1\nX1\nM99\n", {}, (), (("SUBPROGRAM", 2),), 2),
    Row("repeats", "nine-series", f"{_N}M98 P1 L2\nM30\nO1\nG91 X1\nG90\nM99\n", {}, (("line", 1, 0), ("line", 2, 0))),
    Row("no reference point under compensation", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG28 X0\n", _HALF, None,
        (("HOME", 4),), 4),
    Row("no other plane under compensation", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG18\n", _HALF, None,
        (("PLANE", 4),), 4),
    Row("G18 counts Z before X", "nine-series:a", f"{_N}G18\nG41 D1 Z1\nZ4\nX-3\n", _HALF,
        (("line", 0.25, 0), ("line", 0.25, 0), ("line", -3, 0))),
)  # fmt: skip

_L = "G20 G17 F10\n"

LINUXCNC = (
    Row("a diameter below 0 changes the side", "linuxcnc", f"{_L}G41 D1\nG1 X1\nX3\nM2\n", {"t1": -0.5},
        (("line", 1, -0.25), ("line", 3, -0.25)), (("NEGATIVE", 2),)),
    Row("G41.1 with a diameter below 0", "linuxcnc", f"{_L}G42.1 D-.5\nG1 X1\nX3\nM2\n", {},
        (("line", 1, 0.25), ("line", 3, 0.25)), (("NEGATIVE", 2),)),
    Row("a diameter of 0 is told", "linuxcnc", f"{_L}G41.1 D0\nG1 X1\nX3\nM2\n", {},
        (("line", 1, 0), ("line", 3, 0)), (("RADIUS0", 2),)),
    Row("X with G4 is a move", "linuxcnc", f"{_L}G1 X1\nG4 P1 X5\nM2\n", {}, (("line", 1, 0), ("line", 5, 0))),
    Row("repeats are whole", "linuxcnc", f"{_L}M98 P1 L1.5\nM2\nO1\nM99\n", {}, (), (("SUBPROGRAM", 2),), 2),
    Row("a helix under compensation", "linuxcnc", f"{_L}G42 D1\nG1 X1\nG2 X3 Y-2 Z-1 J-2\nG1 Y-4\nG40\nX9\nM2\n",
        _HALF, (("line", 1, -0.25), ("cw", 2.75, -2, 1, -2), ("line", 2.75, -4), ("line", 9, -4))),
    Row("G50 is none of its codes", "linuxcnc", f"{_L}G50\nM2\n", {}, (), (("CODE", 2),), 2),
    Row("G69 neither", "linuxcnc", f"{_L}G69\nM2\n", {}, (), (("CODE", 2),), 2),
)  # fmt: skip

ROWS = (*THREEBLOCK, *ROSETTACNC, *NINE_SERIES, *LINUXCNC)
