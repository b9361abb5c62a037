"""LinuxCNC programs with a code before, in and after compensation, for the interpreter itself to judge."""

from __future__ import annotations

HEAD = "G20 F9\nT1 M6\nG0 X0 Y0\n"

FRAMES = {
    "between compensated moves": HEAD + "G41 D1\nG1 X1\nX3\n{}\nG1 Y3 F8\nX1\nG40\nG1 X9\nX8 Y8\nM2\n",
    "in a compensated move": HEAD + "G41 D1\nG1 X1\nX3\nY3 {}\nX1\nG40\nG0 X9\nM2\n",
    "before the entry": HEAD + "G41 D1\n{}\nG1 X1 F8\nX3\nY3\nG40\nG0 X9\nM2\n",
    "after compensation": HEAD + "G41 D1\nG1 X1\nX3\nY3\nG40\n{}\nG0 X9\nX8 Y8\nM2\n",
    "without compensation": HEAD + "G1 X1\n{}\nX3\nY3\nG0 X9\nM2\n",
    "with its end": "G20 F9\nG41.1 D.5\nG1 X1\nX3\nG40 {}\nG1 X9 F8\nY4\nM2\n",
    "with its start": "G20 F9\nG0 X0\nG41.1 D.5 {}\nG1 X4 F8\nX6\nY8\nG40\nG1 X9\nM2\n",
}
"""Programs in inches around a code, tool 1 of diameter .5 and tool 2 of .25."""

CODES = (
    *("T2", "M6", "T2 M6", "G43 H1", "G43", "G43.1 Z.5", "G43.2 H1", "G49", "M48", "M49", "M50 P1", "M51 P1"),
    *("M52 P1", "M53 P1", "M62 P0", "M63 P0", "M64 P0", "M65 P0", "M66 P0 L0", "M67 E0 Q1", "M68 E0 Q1", "M70"),
    *("M71", "M72", "M19", "M19 R90", "M19 R90 Q2 P1", "M0", "M1", "M60", "M3", "M4 S5", "M5", "M7", "M8", "M9"),
    *("G10 L1 P1 R.1", "G10 L1 P2 R.1", "G10 L1 P1 Z1", "G10 L1 P9 R.1", "G10 L10 P1 R.1", "G10 L11 P1 R.1"),
    *("G10 L2 P1 X0", "G10 L2 P2 X1", "G10 L2 P0 X1", "G10 L20 P1 X0", "G10 L20 P2 X0", "G92 X0", "G92.1", "G92.2"),
    *("G92.3", "G52 X0", "G54", "G55", "G7", "G8", "G20", "G21", "G93 F5", "G94", "G94 F5", "G95", "G95 F5 S9"),
    *("G96 S100 D1000", "G97 S100", "G61", "G61.1", "G64", "G64 P.1 Q.1", "G98", "G99", "G90", "G91", "G90.1"),
    *("G91.1", "G17", "G18", "G28", "G80", "G4 P1", "G53 G0 X1", "G40"),
)

EXPLAINED = {
    "M73": "cutcomp restores nothing, and refuses where the control restores the modal state",
    "M61 Q2": "the interpreter loses the held move and goes back to its start; cutcomp refuses",
    "G10 L2 P2 R5": "cutcomp does not turn the coordinates",
    "G28.1": "cutcomp keeps no reference point",
    "M100": "the interpreter alone has no user's M codes; a machine may have",
    "#5220=2": "cutcomp refuses settings of the control itself",
}
"""Codes that fare differently here, and why that is right."""

PROGRAMS = {
    "a stop at an outside corner": "G41.1 D.5\nG1 X1\nX3\nM0\nX6 Y-3\nX9\nG40\nX10",
    "a stop at an inside corner": "G41.1 D.5\nG1 X1\nX3\nM0\nX6 Y3\nX9\nG40\nX10",
    "a stop before an arc": "G41.1 D.5\nG1 X1\nX3\nM0\nG3 X5 Y2 J2\nG1 X9\nG40\nX10",
    "a stop before a move shorter than the radius": "G41.1 D.5\nG1 X1\nX3\nM0\nY.1\nX9\nG40\nX10",
    "a stop before a tangent move that is too short": "G41.1 D.5\nG1 X1\nX3\nM0\nX3.1\nX4 Y9\nG40\nX10",
    "a stop after an arc at an outside corner": "G41.1 D.5\nG1 X1\nG3 X3 Y2 J2\nM0\nG1 X6 Y3\nX9\nG40\nX10",
    "stops among moves of z": "G41.1 D.5\nM0\nG1 X1\nM0\nX3\nZ1\nM0\nM0\nZ2\nM0\nY3\nM0\nG40\nM0\nX10",
    "a radius set before its use": "T1 M6\nG10 L1 P1 R.1\nG41\nG1 X1\nX3\nG40\nX4",
    "a radius set meanwhile": "T1 M6\nG41 D1\nG1 X1\nG10 L1 P1 R.1\nX3\nY3\nG40\nX4\nG41 D1 X2\nX0\nG40\nX-3",
    "a negative radius set": "G10 L1 P2 R-.1\nG41 D2\nG1 X1\nX3\nY3\nG40\nX4",
    "an orientation set": "G10 L1 P1 R.1 Q3\nG18\nG41 D1\nG1 X1\nX3\nZ3\nG40\nX4",
    "a shift forgotten meanwhile": "G1 X1\nG92 X0\nG41.1 D.5\nG1 X2\nX4\nG92.1\nY3\nX1\nG40\nX9",
    "a shift suspended and taken up": "G1 X1\nG92 X0\nG1 X2\nG92.2\nX4\nG92.3\nX1\nG52 X3\nX2\nG92.2\nX4\nG92.3\nX1",
    "a shift forgotten for good": "G1 X1\nG92 X0\nG1 X2\nG92.1\nX4\nG92.3\nX1",
    "offsets from where the axes stand": "G10 L2 P2 X1\nG55\nG1 X2\nG10 L20 P2 X7\nX8\nG10 L20 P1 X3 Y2\nG54\nX0 Y0",
    "offsets under a shift": "G92 X5\nG1 X6\nG10 L20 P1 X3 Y2\nG1 X0 Y0\nX1\nG10 L2 P0 X1\nX7\nG10 L2 P9 X4\nG59.3\nX1",
    "diameters": "G7\nG1 X4 Y1\nG2 X6 Y0 J-1\nG8 G1 X4\nG7 X#5420\nG91 X2\nG90\nG92 X0\nX8\nG8 X1",
    "diameters under compensation": "G7\nG41.1 D.5 G1 X4 Y1\nG1 X8\nY4\nG40 X2\nG28 X1\nG53 G0 X3\nG10 L2 P1 X3\nG0 X1",
    "a tool change at an offset point": "G41.1 D.5\nG1 X1\nX3\nG40\nT1 M6\nG0 X9\nG91 Y1\nG90 X4 Y4",
    "a tool change at an offset point in zx": "G18\nG41.1 D.5\nG1 X1\nX3\nG40\nT1 M6\nG0 X9\nZ4",
    "a tool set at an offset point": "G41.1 D.5\nG1 X1\nX3\nG40\nM61 Q2\nG0 X9\nG41 D2\nG1 X12\nX14\nG40\nX20 Y5",
    "a tool set before compensation": "T1 M6\nM61 Q2\nG41 D2\nG1 X1\nX3\nG40\nX4",
    "length offsets": "G1 Z1\nG43 H1\nX3\nZ1\nG43.1 Z.5 X.1\nX4\nG43.2 H2\nX5\nG49\nX7\nG43.1 G0 Z2",
    "feeds after a change of their meaning": "F8 G1 X1\nG94 F7\nX2\nG95 F1 S5\nX3\nG95 F2\nX4\nG94\nG0 X7",
}
"""Programs in inches with a feed in force and without their end."""
