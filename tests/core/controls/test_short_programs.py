"""Programs of a few blocks, and the finding that a control must make of each: its rule, place and first words."""

from __future__ import annotations

import pytest

from tests.core.controls.hand import lines_and_ends, run_of

FANUC = {
    "#[0-5]=1.": "PS0115 2:1 The number of a variable cannot be negative.",
    "X#[0-5]": "PS0115 2:2 #-5 is not a variable",
    "#0=1.": "PS0116 2:1 #0 is always vacant",
    "#5041=1.": "PS0116 2:1 #5041 cannot be set",
    "#5201=5.": "PS0116 2:1 #5201 cannot be set",
    "#1=FOO[1.]": "PS0114 2:4 This control has no function FOO.",
    "#1=POW[1.]": "PS0114 2:4 POW takes two values.",
    "#1=SIN[1.,2.]": "PS0114 2:4 SIN takes one value.",
    "#1=2. #2=3.": "PS0127 2:7 A second assignment in this block",
    "#1": "PS0114 2:1 A variable needs = and a value",
    "GOTO 5 X\nN5": "PS0114 2:8 X cannot follow GOTO.",
    "GOTO 6\nN5": "PS0128 2:6 There is no block N6",
    "WHILE [#1 LT 3]": "PS0114 2:15 WHILE needs DO",
    "IF [#1 EQ #0] THEN #2=1. X": "PS0127 2:26 X cannot follow an assignment.",
    "END1 X": "PS0114 2:6 X cannot follow here.",
    "M98": "PS0076 2:1 The call needs P",
    "G65": "PS0076 2:1 The call needs P",
    "G65 P2 L-1\nM30\nO2\nM99": "PS0007 2:8 L is a number of times from 1 to 9999.",
    "G65 P2\nM30\nO2\nG65 P2\nM99": "PS0077 5:1 Macros run more than 4 deep.",
    "M98 P2\nM30\nO2\nM99 P77": "PS0128 5:5 There is no block N77",
    "G1 X9. ,R1.": "PS0051 2:1 A rounding or chamfer stands between two straight moves.",
    "G1 X9. ,R1.\nG4 P1\nY9.": "PS0051 2:1 A rounding or chamfer stands between two straight moves.",
    "G1 X9. ,R1.\nG2 X12. Y3. R3.": "BEYOND 2:1 cutcomp follows ,R and ,C only between two straight moves.",
    "G2 X0 Y0 R5.": "FN-R 2:10 The arc with R ends where it starts: no move.",
    "G91.1": "FN-G911 2:1 G91.1 is not a code of this control",
    "G31 X5.": "FN-SKIP 2:1 Where a skip signal stops this move is not known",
    "G51 X0 I1. J2.": "BEYOND 2:8 cutcomp follows G51 with I, J and K of one size only",
    "G51 X0 Y0 P0": "PS0006 2:11 The factor P of G51",
    "G68 X0 Y0": "BEYOND 2:1 G68 has no R",
    "G10 L3 P1 R5.": "PS0031 2:5 G10 has L2 or L20",
    "G10 L2 P7 X5.": "PS0031 2:5 G10 has L2 or L20",
    "G10 L10 P1 R5.": "FN-SHARED 2:5 Lengths and radii are taken to share one memory",
    "G10 L11 P1 R5.": "FN-SHARED 2:5 Lengths and radii are taken to share one memory",
    "X#5061": "FN-SYSTEM 2:1 The control knows #5061 only at run time",
    "X#3001": "FN-SYSTEM 2:1 The control knows #3001 only at run time",
    "G93 G81 Z-5. R1. F2.": "PS0005 2:1 A drilling cycle does not go with G93",
    "G83 Z-5. R1. Q0": "PS0005 2:1 Q, the depth of a peck, must be larger than 0.",
    "G83 Z-5. R1. Q.00001": "PS0005 2:1 That is more than 10000 pecks",
    "G41 D1 G1 X9.\nX20.\nG41 X30.\nG40 X40.": "FN-G2 4:1 G41 or G42 is in force already",
    "G81 Z-5. R1. F0": "PS0011 2:5 There is no feed",
    "G1 G81 X1. Z-5. R1.": "GROUP 2:1 G0 to G3 next to a drilling cycle cancels the cycle.",
    "#<a>=1.": "BEYOND 2:1 cutcomp does not follow named variables such as A.",
    "M98 P2 L10000\nM30\nO2\nM99": "PS0007 2:8 L is a number of times from 1 to 9999.",
    "G1 X9. ,R-1.\nY9.": "PS0051 2:1 A rounding or chamfer needs two straight moves in the plane and a size above 0.",
    "G1 X9. Z1. ,C1.\nY9.": "PS0051 2:1 A rounding or chamfer needs two straight moves in the plane",
    "G51 X0 Y0 P2.\nG68 X0 Y0 R30.\nG50": "FN-ROTATION 4:1 G50 stands before G69;",
    "G51 X0 Y0 P2.\nG51.1 X0": "BEYOND 3:1 cutcomp does not follow G51.1 while G51 is in force.",
    "G68 X0 Y0 R30.\nG51 X0 Y0 P2.": "BEYOND 3:1 cutcomp does not follow G51 while G68 is in force.",
    "G68 X0 Y0 I1. R30.": "BEYOND 2:1 cutcomp follows G68 with an angle R only.",
    "G91 G68 X0 Y0 R30.": "FN-ROTATION 2:5 cutcomp takes R of G68 as an angle from 0.",
    "G51 X0 P9": "BEYOND 2:8 P of G51 without a decimal point counts thousandths: here it is a factor of 0.009.",
    "G10 L20 X1.": "PS0031 2:1 G10 needs P",
    f"G65 P2 {' '.join(['I1.'] * 11)}\nM30\nO2\nX#34\nM99": "PS0115 5:2 #34 is not a variable",
    "G41 D0 G1 X9.\nX20.": "FN-D0 2:1 Nothing is compensated",
    "G41 D1 G1 X9.\nX20.\nY3.\nX0\nY20.": "PS0041 4:1 The tool does not fit along this move",
    "G41 D1 G1 X9.\nX20.\nG3 X22. Y2. R2.": "PS0041 4:1 The arc radius {0} is smaller than the cutter radius {1}.",
    "G54 P2 X1.": "OFFSET 2:1 The offset of G54.1 P2 is not in the program",
    "G54 P2 G80 X1.": "OFFSET 2:1 The offset of G54.1 P2 is not in the program",
    "G28 P2 X1.": "UNUSED 2:5 No code in this block uses P.",
    "G1 X1. Q2.": "UNUSED 2:8 No code in this block uses Q.",
    "X#34": "PS0115 2:2 #34 is not a variable",
    "X#200": "PS0115 2:2 #200 is not a variable",
    "X#1136": "PS0115 2:2 #1136 is not a variable",
    "X#1135": "FN-SYSTEM 2:1 The control knows #1135 only at run time",
    "X#2000": "PS0115 2:2 #2000 is not a variable",
    "X#2401": "BEYOND 2:1 #2401 is a D only at parameter 6004#5 = 1",
    "X#4021": "PS0115 2:2 #4021 is not a variable",
    "X#4115": "FN-SYSTEM 2:1 The control knows #4115 only at run time",
    "X#5083": "FN-SYSTEM 2:1 The control knows #5083 only at run time",
    "X#10000": "PS0115 2:2 #10000 is not a variable",
    "X#14000": "PS0115 2:2 #14000 is not a variable",
    "#1136=1.": "PS0116 2:1 #1136 cannot be set",
    "#2507=1.": "PS0116 2:1 #2507 cannot be set",
    "#7961=1.": "PS0116 2:1 #7961 cannot be set",
    "G41 D1 G1 X9.\nX20.\nM0\nG4 P1\nG4 P1\nG4 P1\nG2 X30. I5.": "FN-N2-ARC 8:1 The arc after a square end begins",
}
LINUXCNC = {
    "G83 X1 Z-5 R1 Q0": "CYCLE 2:1 Q, the depth of a peck, must be larger than 0.",
    "G83 X1 Z-5 R1 Q.0000001": "CYCLE 2:1 That is more than 10000 pecks",
    "G93 G81 X1 Z-5 R1 F2": "CYCLE 2:1 A drilling cycle does not go with G93",
    "G18 G84 X1 Y-5 R1": "CYCLE 2:1 In this plane the control taps along the wrong axes",
    "O[1+1] if [1 EQ 1]": "OWORD 2:8 Only call takes an expression as label.",
    "O[1.5] call": "OWORD 2:8 The label of a subprogram must be a whole number.",
    "O1 sub\nO2 endsub": "OWORD 2:4 sub has no matching endsub",
    "O1 sub\nG1 X1\nO1 endsub\nO1 call\nO1 endsub": "OWORD 6:4 endsub is not in a called subprogram.",
    "X[]": "MACRO 2:3 A value is missing before ].",
    "#1=EXISTS[5]": "MACRO 2:10 EXISTS takes a name",
    "G10 L2 P10 X1": "DATA 2:5 A work offset is set by G10 L2 P1 to P9",
    "G10 L2 P1 R5": "BEYOND 2:11 cutcomp does not follow a work offset with a rotation R",
    "G91 G53 G0 X1": "MOTION 2:5 G53 goes with G0 or G1 in absolute positions",
    "G43 H7": "TOOL 2:5 The tool table has no tool 7.",
    "G41.1": "N-DMISSING 2:1 G41.1 and G42.1 need D",
    "G17 G41.1 D1 L3": "N-ORIENTATION 2:14 L, the orientation of a lathe tool, goes with G18 only.",
    "G10 L1 P1 R.1 Q3\nG41 D1": "N-ORIENTATION 3:1 The tool is a lathe tool",
    "G10 L1 P1 R.1 Q10": "DATA 2:15 Q, the orientation of a lathe tool, is a whole number from 0 to 9.",
    "G10 L1 P3 R3": "TOOL 2:5 The tool table has no tool 3.",
    "G10 P1 X1": "DATA 2:1 cutcomp sets only work offsets",
    "G0 X0\nF0 G81 X1 Z-5 R1": "FEED 3:8 There is no feed",
    "G82 X1 Z-1 R1": "CYCLE 2:1 P is missing: the first G82 block needs it.",
    "G86 X1 Z-1 R1 P1": "CYCLE 2:1 G86 needs a spindle that turns; start it with M3 or M4.",
    "M4\nG84 X1 Z-1 R1": "CYCLE 3:1 G84 needs a spindle that turns; start it with M3.",
    "M3\nG74 X1 Z-1 R1": "CYCLE 3:1 G74 needs a spindle that turns; start it with M4.",
    "X[[-2]**.5]": "MACRO 2:7 ** has no value for these numbers.",
    "X[1+SIN 5]": "MACRO 2:5 A value is missing before SIN5].",
    "X5,2": "WORD 2:3 A comma is no decimal point here.",
    "O1 if": "OWORD 2:4 if needs a condition in square brackets.",
    "O[1+] call": "MACRO 2:5 A value is missing before ]CALL.",
    "O1 sub\nO2 sub\nO2 endsub\nO1 endsub": "OWORD 3:4 A subprogram begins inside a subprogram.",
    "O1 sub\nO2 endsub\nO1 endsub\nO1 call\nO2 sub\nO2 endsub": "OWORD 3:4 This endsub does not match",
    "M98 P5\nM2\nO5\nO6 return\nM99": "OWORD 5:4 A subprogram called by M98 ends with M99;",
    "M61 Q-1": "N-WORDALONE 2:1 M61 needs Q",
    "M61 Q2": "TOOL 2:5 The tool table has no tool 2.",
    "M1 M3 M6 M7 M48": "GROUP 2:13 A block can have 4 M codes.",
    **{
        f"M{first} M{second}": f"GROUP 2:{len(first) + 3} M{first} and M{second} are of one group."
        for first, second in map(
            str.split,
            ("0 1", "2 30", "60 99", "3 4", "5 19", "70 73", "6 61", "7 8", "8 9", "48 53", "62 68", "100 199"),
        )
    },
    **{f"M{code}": f"CODE 2:1 M{code} is not an M code" for code in (10, 18, 20, 29, 31, 47, 54, 59, 69, 74, 97, 200)},
    **{f"M{code}": f"M 2:1 What M{code} does is set up on the machine" for code in (100, 199)},
    **{f"M{code}": f"BEYOND 2:1 cutcomp does not restore what M{code} restores." for code in (72, 73)},
    **{f"{letter}1": f"N-WORDALONE 2:1 No code in this block uses {letter}." for letter in "LPQHE"},
    "M98 P2 X1": "SUBPROGRAM 2:1 A call or a number of a subprogram must be alone",
    "G28 G0 X1": "N-TWOG 2:1 Two G codes of this block use its axis words.",
    "G92 G3 X1 Y1 R1": "N-TWOG 2:1 Two G codes of this block use its axis words.",
    "G4 P-1": "N-WORDALONE 2:1 G4 needs P",
    "G1 X1 I2": "N-WORDALONE 2:7 I, J, K and R go with G2 and G3 only.",
    "F-1": "N-NEGATIVE 2:1 F cannot be negative.",
    "G19 G41 D1": "N-XZYZ 2:5 Compensation works in the planes G17 and G18 only",
    "G41 D1 G1 X9\nG10 L20 P1 X3": "N-OFFSETS 3:1 G10 changes the origin",
    "G41 D1 G1 X9\nG10 L2 P0 X3": "N-OFFSETS 3:1 G10 changes the origin",
}
OTHERS = {
    ("rosettacnc:normal", "G41.1\nG1 X5"): "C1 2:1 G41.1 and G42.1 need D",
    ("rosettacnc:normal", "G41.1 D2\nG1 X5\nX9\nG40\nG2 X12 Y3 R3"): "C8 6:1 The first move after G40 is straight",
    ("rosettacnc:nist", "G41 D1\nG1 X9\nG20"): "C8 4:1 The unit cannot change under compensation.",
    ("rosettacnc:easy", "G41 D1\nG2 X9 Y0 I4.5 J0"): "C8 3:1 The first move must be straight.",
    ("rosettacnc:easy", "G41 D1\nG1 X9\nX20\nG40\nG2 X30 Y0 R5"): "C8 6:1 The first move after G40 must be straight.",
    ("nine-series:a", "G1 G81 X1. Z-5. R1."): "GROUP 2:1 cutcomp does not know which counts",
    ("nine-series:a", "G2 G41 D1 X30. I15. J0"): "R1 2:4 Compensation cannot be started in G2 or G3",
    ("nine-series:a", "G41 D1\nG2 X30. I15. J0"): "R1 3:1 Compensation cannot be started in G2 or G3",
    ("nine-series:a", "G41 D1 G1 X9.\nX20.\nG40\nG2 X30. I5. J0"): "R2 5:1 Block format error",
    ("nine-series:a", "M800\nG41 D1 G1 X9.\nX20.\nY3.\nX0\nY9."): "R8 5:1 The compensated move runs backwards",
    ("nine-series:b", "G41 D1 G1 X0 Y9.\nX20.\nY0\nG40 X0"): "TYPE-B 2:1 cutcomp takes the generated blocks",
    ("nine-series:a", "G30 X1. P2"): "UNUSED 2:9 No code in this block uses P.",
    ("nine-series:a", "G10 L2 P7 X1."): "DATA 2:5 A work offset is set by G10 L2 P1 to P6",
    ("nine-series:a", "G10 L20 P1 X1."): "DATA 2:5 cutcomp sets only work offsets",
    ("threeblock", "T5//"): "TOOL 2:1 This tool data sets neither length nor diameter",
    ("threeblock", "T1\nG41 G1 X9.\nG18 X20."): "B1-PLANE 4:1 Compensation works in the XY plane only",
    ("haas:a", "M97 P8\nM30\nN7 G1 X1.\nM99"): "PS0128 2:1 There is no block N8",
    ("haas:a", "G18 G41 D1 G1 X9."): "H344 2:5 Older Haas controls compensate in G17 only",
    (
        "threeblock",
        "G91\nG3 X1. Y1. I0 J1.",
    ): "G91-CENTER 3:12 Under G91 cutcomp counts the center from",
}
ROWS = [
    *(("fanuc:a", blocks, words) for blocks, words in FANUC.items()),
    *(("linuxcnc", blocks, words) for blocks, words in LINUXCNC.items()),
    *((control, blocks, words) for (control, blocks), words in OTHERS.items()),
]


@pytest.mark.parametrize(("control", "blocks", "words"), ROWS)
def test_a_short_program_has_its_finding(control: str, blocks: str, words: str) -> None:
    unit = "G71" if control == "threeblock" else "G21"
    run = run_of(f"{unit} F9.\n{blocks}\nM30\n", control, t1=5.0)
    found = [f"{finding.code} {finding.line}:{finding.column} {finding.text}" for finding in run.findings]
    assert any(text.startswith(words) for text in found), found


@pytest.mark.parametrize(("control", "stops"), [("linuxcnc", True), ("fanuc:a", True), ("nine-series:a", False)])
@pytest.mark.parametrize("move", ["G1 X2.", "G2 X2. Y0 I1. J0"])
def test_lines_and_arcs_without_a_feed_are_reported(move: str, control: str, stops: bool) -> None:
    """Only some controls stop; under G93, where each move needs its own F, all do."""
    for mode, words in (("", "There is no feed;"), ("G95\n", "There is no feed;"), ("G93\n", "Under G93 every move")):
        run = run_of(f"G21\n{mode}{move}\nM30\n", control)
        (finding,) = [finding for finding in run.findings if finding.text.startswith(words)]
        line = 3 if mode else 2
        assert (finding.line, run.stopped_at) == (line, line if stops or "G93" in mode else None), mode
    for feed in ("F9.", "G93 F9."):
        run = run_of(f"G21\n{move} {feed}\nM30\n", control)
        assert (run.stopped_at, run.findings) == (None, ()), feed


FANUC_VALUES = {
    # at the start, but for G1
    **{f"X#{key}": x for key, x in zip(range(4001, 4009), (1, 17, 90, 23, 94, 21, 40, 49), strict=True)},
    **{f"X#{key}": x for key, x in zip(range(4009, 4018), (80, 98, 50, 67, 97, 54, 64, 69, 15), strict=True)},
    "X#4022": 50.1,
    "X#13001": 2.5,
    # the last words
    "B4. D3\nX[#4102+#4107]": 7.0,
    "F33.\nX#4109": 33.0,
    "H3\nX#4111": 3.0,
    "M3 M8\nX#4113": 8.0,
    "N70 T4 S200\nX[#4114+#4119+#4120]": 274.0,
    # offsets: lengths and radii, worn and not, by G10 and by variables
    "G10 L10 P3 R7.\nX[#11003+#2203]": 14.0,
    "G10 L11 P3 R.25\nX[#10003+#2003]": 0.5,
    "G10 L12 P3 R1.5\nX#13003": 1.5,
    "G10 L13 P3 R.25\nX#12003": 0.25,
    "#2201=1.5\nX#11001": 1.5,
    "#2400=1.5\nX#11200": 1.5,
    "#2001=1.5\nX#10001": 1.5,
    "#2200=1.5\nX#10200": 1.5,
    "#10001=1.5\nX#2001": 1.5,
    "#13999=1.5\nX#13999": 1.5,
    # work offsets, of the place Y0 in the axis X
    "#5221=3.\nX#2501": 6.0,
    "#5321=3.\nG59 X#2506": 6.0,
    "#2500=2.\nX#5201": 4.0,
    "G10 L2 P1 X3.\nX#5221": 6.0,
    "G10 L2 P0 X3.\nX1.": 4.0,
    "G10 L20 P2 X3.\nG54.1 P2 X#7021": 6.0,
    "#7941=2.\nG54.1 P48 X1.": 3.0,
    # where it stands
    "X3. Y4. Z5.\nY0\nX[#5001+#5002+#5003]": 8.0,
    "X3.\nX[#5041+#5043]": 3.0,
    # calls
    "G91\nM98 P2 L3\nM30\nO2\nX1.\nM99": 3.0,
    "G91\nM98 P30002\nM30\nO2\nX1.\nM99": 3.0,
    "G65 P2 L2 X3.\nM30\nO2\nG91 X#24\nM99": 6.0,
    "#3=1.23456\nX[ROUND[#3]+1.]": 2.235,
}
"""The X at the end, in millimeters."""


@pytest.mark.parametrize("blocks", FANUC_VALUES)
def test_a_short_fanuc_program_ends_at(blocks: str) -> None:
    run = run_of(f"G21 F9.\nG1\n{blocks}\nM30\n", "fanuc:a", t1=5.0)
    ends = lines_and_ends(run) or [(0.0, 0.0)]
    assert (run.stopped_at, ends[-1]) == (None, (FANUC_VALUES[blocks], 0.0))


def test_each_letter_of_g65_sets_its_variable() -> None:
    letters = [f"{letter}{number}" for letter, number in zip("ABCIJKDEF", range(1, 10), strict=True)]
    letters += ["H11", "M13", *(f"{letter}{number}" for number, letter in enumerate("QRSTUVWXYZ", 17))]
    words = " ".join(f"{each[0]}{each[1:]}." for each in letters)
    moves = "\n".join(f"X#{each[1:]}" for each in letters)
    run = run_of(f"G21 F9.\nG65 P2 {words} I27. J28. K29.\nM30\nO2\nG1\n{moves}\nM99\n", "fanuc:a")
    # the second I, J and K are #7 to #9
    again = {"D7": 27.0, "E8": 28.0, "F9": 29.0}
    wanted = [again.get(each, float(each[1:])) for each in letters]
    assert [x for x, _ in lines_and_ends(run)] == wanted


OTHER_ENDS = {
    ("rosettacnc:easy", "G41 D1\nG1 X9\nG40\nX20"): (20.0, 0.0),
    ("fanuc:a", "G41 D1 G1 X9.\nX20.\nG40\nZ5."): (20.0, 2.5),
    ("fanuc:a", "G41 D1 G1 X9.\nX20.\nG40 Z5."): (20.0, 2.5),
    ("fanuc:a", "G41 D1 G1 X9.\nX20.\nG40 Z5.\nX30."): (30.0, 0.0),
    ("fanuc:a", "G41 D1 G1 X9.\nG92 X0\nX20.\nX30."): (39.0, 2.5),
    ("fanuc:a", f"G65 P2 {' '.join(f'I{n}.' for n in range(1, 12))}\nM30\nO2\nG1 X#31\nM99"): (10.0, 0.0),
    ("linuxcnc", "G0 X1\nG10 L20 P1 X3\nG1 X4"): (2.0, 0.0),
    ("linuxcnc", "G0 X1\nG10 L20 P2 X3\nG55 G1 X4"): (2.0, 0.0),
    ("linuxcnc", "G10 L2 P9 X1\nG59.3 G1 X1"): (2.0, 0.0),
    ("linuxcnc", "G10 L1 P1 R3 Q9\nG41 D1 G1 X20"): (20.0, 3.0),
    ("linuxcnc", "G41 D1 G1 X9\nG10 L20 P2 X3\nX20"): (20.0, 2.5),
    ("linuxcnc", "G41 D1 G1 X9\nG10 L1 P1 R3\nX20"): (20.0, 2.5),
    ("linuxcnc", "M61 Q1\nG41 G1 X9"): (9.0, 2.5),
    ("linuxcnc", "G1 X4\nG7 X12\nG8"): (6.0, 0.0),
    ("haas:a", "M97 P7 L2\nM30\nN7 G91 G1 X1.\nM99"): (2.0, 0.0),
    ("haas:a", "M97 P7\nM30\nN7 G91 G1 X1.\nM99"): (1.0, 0.0),
}


@pytest.mark.parametrize(("control", "blocks"), OTHER_ENDS)
def test_a_short_program_ends_at(control: str, blocks: str) -> None:
    run = run_of(f"G21 F9.\n{blocks}\nM30\n", control, t1=5.0)
    assert (run.stopped_at, lines_and_ends(run)[-1]) == (None, OTHER_ENDS[control, blocks])


@pytest.mark.parametrize(
    "block",
    [
        "G30 X1. P2",
        "G4 P1",
        "G4 X1.",
        "G10 L2 P1 X0",
        "G2 X1. Y1. R1.",
        "G2 X0 Y0 I1. J0",
        "G81 X1. Z-1. R1. K1",
        "G82 X1. Z-1. R1. P1",
        "G83 X1. Z-1. R1. Q1.",
        "G43 H1",
        "G54.1 P1 X0",
        "G68 X0 Y0 R30.",
        "G51 X0 Y0 P2.",
        "G54 P2 G81 Z-1. R1.",
        "G54 P2 G73 Z-1. R1. Q1.",
        "G54 G4 P1",
        "G54 M98 P1\nM30\nO1\nM99",
        "X1. D1 H1",
    ],
)
def test_a_word_that_a_code_of_its_block_uses_is_not_reported(block: str) -> None:
    run = run_of(f"G21 F9.\nG55\n{block}\nM30\n", "fanuc:a", t1=5.0)
    assert {finding.code for finding in run.findings} <= {"OFFSET", "HOME", "DWELL"}, run.findings
    assert not any("G54.1 P2" in finding.text for finding in run.findings)


ORIGINS = "G52 X1.|G92 X1.|G54|G55|G56|G57|G58|G59"
UNDER_COMPENSATION = {
    ("linuxcnc", "N-OFFSETS"): f"{ORIGINS}|G59.1|G59.2|G59.3|G92.1|G92.2|G92.3",
    ("linuxcnc", "N-HOME"): "G28|G30",
    ("linuxcnc", "N-G53"): "G53 G0 X1",
    ("linuxcnc", "N-LENGTH"): "G43 H1|G43.1 Z1|G43.2 H1|G49",
    ("linuxcnc", "N-MODE"): "G61|G61.1|G64|G98|G99",
    ("linuxcnc", "N-TOOL"): "M6|M61 Q1",
    ("linuxcnc", "N-OVERRIDE"): "M48|M49|M50|M51|M52|M53",
    ("linuxcnc", "N-OUTPUT"): "M62 P1|M63 P1|M64 P1|M65 P1|M66 P1|M67 E1 Q1|M68 E1 Q1",
    ("linuxcnc", "N-PLANE"): "G18|G19",
    ("linuxcnc", ""): "G17|G90|G94|M7|M3|G4 P1",
    ("threeblock", "ORIGIN"): "G4|G28|G30|G92 X1.|G54|G55|G56|G57|G58|G59|G20|G21|G70|G71",
    ("threeblock", "B10-NOMOVE"): "G90|G45|G44",
    ("threeblock", "B14-MCODE"): "M3",
    ("fanuc:a", "FN-G5"): f"{ORIGINS}|G54.1 P1|G28 X20.|G30 X20.|G53 X20.",
    ("fanuc:a", "FN-N2"): "M0|M1",
    ("fanuc:a", "FN-TRANSFORM"): "G68 X0 Y0 R30.|G51 X0 Y0 P2.|G51.1 X0",
    ("fanuc:a", "PS0036"): "G31 X25.",
    ("fanuc:a", "PS0037"): "G18|G19",
    ("fanuc:a", ""): "M8|G69|G50|G50.1 X0|G17|G90",
    ("haas:a", "FN-G5"): "G110|G129|G154 P1",
    ("nine-series:a", "R7"): f"{ORIGINS}|G92.1",
    ("nine-series:a", "HOME"): "G28 X20.|G30 X20.|G53 X20.",
    ("nine-series:a", "PLANE"): "G17|G18|G19",
    ("nine-series:a", ""): "M8|G90|G94",
}
"""What a control does at these blocks under compensation; nothing where the rule is empty."""


@pytest.mark.parametrize(
    ("control", "rule", "block"),
    [(control, rule, block) for (control, rule), blocks in UNDER_COMPENSATION.items() for block in blocks.split("|")],
)
def test_a_block_under_compensation_has_its_rule(control: str, rule: str, block: str) -> None:
    first = "G71 F9. T1" if control == "threeblock" else "G21 F9. T1 M6"
    side = "G41 D1" if control != "threeblock" else "G41"
    run = run_of(f"{first}\n{side} G1 X9.\nX20.\n{block}\nY-30.\n", control, t1=5.0)
    assert rule in [finding.code for finding in run.findings if finding.line == 4] or not rule
    assert rule or not [finding for finding in run.findings if finding.line == 4]


OPEN = "G21 G17 G40 G90\nT4 M6\nG0 X-30. Y-30.\nG41 D4 G1 X0. Y-15. F400.\nY40.\nX60.\n{cancel}X90. Y20.\n{late}M2\n"


@pytest.mark.parametrize(
    ("control", "rule"),
    [
        ("linuxcnc", "OPEN"),
        ("rosettacnc:normal", "OPEN"),
        ("nine-series:a", "OPEN"),
        ("fanuc:a", "FN-OPEN"),
        ("haas:a", "H349"),
    ],
)
@pytest.mark.parametrize(("cancel", "late"), [("", ""), ("G40 ", ""), ("", "G40\n")])
def test_a_program_that_ends_under_compensation_is_told(cancel: str, late: str, control: str, rule: str) -> None:
    run = run_of(OPEN.format(cancel=cancel, late=late), control, t4=10.0)
    told = [(finding.code, finding.line) for finding in run.findings if "ends under compensation" in finding.text]
    assert told == ([] if cancel or late else [(rule, 8)])
