"""The makers' statements row by row, all controls."""

from __future__ import annotations

from tests.core.controls.statement import Row
from tests.core.controls.statements_threeblock import THREEBLOCK

_HALF = {"t1": 0.5}
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
    Row("outside arcs keep the center's feed", "nine-series:a", f"{_N}G41 D1 X1\nX4\nG2 X5 Y-1 J-1\nG1 Y-3\n", _HALF,
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
