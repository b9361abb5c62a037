"""Programs of a few blocks, and the finding that a control must make of each: its rule, place and first words."""

from __future__ import annotations

import pytest

from tests.core.controls.hand import ran

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
    "G51 X0 I1. J2.": "BEYOND 2:1 cutcomp follows G51 with one P",
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
}
OTHERS = {
    ("rosettacnc:normal", "G41.1\nG1 X5"): "C1 2:1 G41.1 and G42.1 need D",
    ("rosettacnc:normal", "G41.1 D2\nG1 X5\nX9\nG40\nG2 X12 Y3 R3"): "C8 6:1 The first move after G40 is straight",
    ("rosettacnc:nist", "G41 D1\nG1 X9\nG20"): "C8 4:1 The unit cannot change under compensation.",
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
    run = ran(f"{unit} F9.\n{blocks}\nM30\n", control, t1=5.0)
    found = [f"{finding.code} {finding.line}:{finding.column} {finding.text}" for finding in run.findings]
    assert any(text.startswith(words) for text in found), found


@pytest.mark.parametrize(("control", "stops"), [("linuxcnc", True), ("fanuc:a", True), ("nine-series:a", False)])
@pytest.mark.parametrize("move", ["G1 X2.", "G2 X2. Y0 I1. J0"])
def test_lines_and_arcs_without_a_feed_are_reported(move: str, control: str, stops: bool) -> None:
    """Only some controls stop; under G93, where each move needs its own F, all do."""
    for mode, words in (("", "There is no feed;"), ("G95\n", "There is no feed;"), ("G93\n", "Under G93 every move")):
        run = ran(f"G21\n{mode}{move}\nM30\n", control)
        (finding,) = [finding for finding in run.findings if finding.text.startswith(words)]
        line = 3 if mode else 2
        assert (finding.line, run.stopped_at) == (line, line if stops or "G93" in mode else None), mode
    for feed in ("F9.", "G93 F9."):
        run = ran(f"G21\n{move} {feed}\nM30\n", control)
        assert (run.stopped_at, run.findings) == (None, ()), feed
