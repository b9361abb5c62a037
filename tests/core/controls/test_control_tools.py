"""Tool tables."""

from __future__ import annotations

import pytest

from core.controls.control_tools import CommentedSize, CutterTool, commented_size, read_table, table_of
from core.units import Unit


def test_a_table_as_linuxcnc_writes_it() -> None:
    text = b"; my tools\nT1 P1 D.25 Z+1.5 ;end mill\r\n\nT12 P2 D-.5 Q3\nT1P1D.375Z0\n"
    table, findings = read_table(text)
    assert not findings
    assert table.get(1) == CutterTool(1, 0.375)
    assert table.get(12) == CutterTool(12, -0.5, 0.0, 3)
    assert table.get(2) is None


@pytest.mark.parametrize("line", [b"1 1 .5", b"P1 D.5", b"T1.5 D1", b"T1 Dx", b"T1 D99999999999", b"\xff\xfe\x00"])
def test_what_cannot_be_read_is_reported_by_line(line: bytes) -> None:
    table, findings = read_table(b"T3 D1\n" + line + b"\n")
    assert [finding.line for finding in findings] == [2]
    assert table.get(3) is not None
    assert findings[0].text.isprintable()


def test_a_diameter_without_unit_is_the_program_s() -> None:
    assert CutterTool(1, 0.5).diameter_mm(Unit.IN) == pytest.approx(12.7)
    assert CutterTool(1, 0.5, unit=Unit.MM).diameter_mm(Unit.IN) == 0.5


def test_tools_given_later_replace_those_of_the_table() -> None:
    both = table_of(CutterTool(1, 1.0), CutterTool(2, 2.0), CutterTool(2, 3.0))
    assert [both[number].diameter for number in (1, 2)] == [1.0, 3.0]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("(TOOL 1 END MILL DIAMETER 0.5000)", "0.5000"),
        ("(T1 D=10. CR=0. - ZMIN=-5. - FLAT END MILL)", "10"),
        ("N5 T1 M6 (T01 DIA .375)", ".375"),
        ("5 ; TOOL 1 DIAMETER 12.7", "12.7"),
        ("(TOOL 1 | 10MM FLAT | H1 | D1 |)", None),
        ("(T11 D=10.)", None),
        ("(T1 DIA 12MM)", "12MM"),
        ("(T1 DIA 1/2 END MILL)", "1/2"),
        ("(TOOL #1 0.5 DIA FLAT END MILL 3 FLUTE)", "0.5"),
        ("( 1/2 FLAT ENDMILL TOOL - 1 DIA. OFF. - 1 LEN. - 1 DIA. - .5 )", ".5"),
        ("(T1 10MM ENDMILL)", "10MM"),
        ("(T1 - 1/2 FLAT ENDMILL)", "1/2"),
        ("(T1 | 10. CARBIDE END MILL | H1)", "10"),
        ("N20 T1 M6 (8MM 3FL EM)", "8MM"),
        ("(T1 1/2 ENDMILL)", "1/2"),
        ("(T1 10. DIA 5 FLUTE)", "10"),
        ("(T1|10MM ENDMILL|H1|D1|TOOL DIA. - 10.)", "10MM"),
        ("(T1 H1 D1 DIA.=6.35)", "6.35"),
        ("(T1 1/0 ENDMILL)", None),
        ("(T1 D1 DIA)", None),
        ("(T1 DIAMETER 1.5.2)", None),
        ("(T1 BORE 2.5 DIA WITH .5 ENDMILL)", None),
        ("(T1 10MM ENDMILL, DIA 10IN)", None),
        ("(T1 18 FLAT CARBIDE ENDMILL)", None),
        ("(T1 .5 ENDMILL OR .375 ENDMILL)", None),
        ("(T1 20MM STICKOUT)", None),
        ("(T1 1 1/4 ENDMILL)", None),
        ("N20 T2 M6 (8MM ENDMILL)", None),
        ("(T1 D=1-1/4)", None),
        ("(T1 D=10,5)", None),
        ("(T1 SHANK DIA 10 CUT DIA 6)", None),
        ("(T1 CHANGE TO T2 D=12)", None),
        ("(T1 OFFSET D = 21)", None),
        ("(USE T1 D=0.0)", None),
        ("T1M6(10MM EM)", "10MM"),
        ("N5T1M06(10MM EM)", "10MM"),
        ("M6T1(1/2 ENDMILL)", "1/2"),
        ("T01M6;10MM EM", "10MM"),
        ("T11M6(10MM EM)", None),
        ("G0X1.T2M6(10MM EM)", None),
        ("5 TOOL CALL 1 Z S2000 ; 10MM EM", "10MM"),
        ("T1 (STEPOVER .5 DIA)", None),
        ("T1 (STEP OVER = .5 DIA)", None),
        ("T1 (.5 DIA STEPOVER)", None),
        ("T1 (D=10. STEPOVER .5 DIA)", "10"),
        ("T1 (.5 DIA STEPOVER .2)", ".5"),
        ("T1 (STEPDOWN .5 EM)", None),
        ("T1 (DEPTH .5 EM)", None),
        ("T1 (DEPTH OF CUT - 10MM EM)", None),
        ("T1 (10MM EM DEPTH 5MM)", "10MM"),
        ("T1 (1/2 EM, 2.5 DIA DEEP)", "1/2"),
        ("T1 (FINISH 2.5 DIA)", None),
        ("T1 (FINISH 10MM EM)", "10MM"),
        ("T1 (FINISH .5 DIA EM)", ".5"),
        ("T1 (STOCK .5 DIA)", None),
        ("(T1 | 1/2 FLAT ENDMILL | H1 | XY STOCK TO LEAVE - .01 | Z STOCK TO LEAVE - 0.)", "1/2"),
        ("T1 (LENGTH 2.5 EM)", None),
        ("T1 (LENGTH 3. DIA .5)", ".5"),
        ("T1 (2.0 LENGTH .5 EM)", None),
        ("T1 (DIA 10. LENGTH 75.)", "10"),
        ("T1 (FLUTE 1.0 EM)", None),
        ("T1 (4 FLUTE .5 EM)", ".5"),
        ("T1 (R 0.5 EM)", None),
        ("T1 (RAD .5 EM)", None),
        ("T1 (.5 DIA RAD)", None),
        ("T1 (BALL R 5. DIA 10.)", "10"),
        ("T1 (10MM BULL R 1.0 ENDMILL)", None),
        ("T1 (10MM EM CORNER RADIUS 1.)", "10MM"),
        ("T1 (BORE 2.5 DIA)", None),
        ("T1 (2.5 DIA HOLE)", None),
        ("T1 (ROUGH POCKET DIA 2.5)", None),
        ("T1 (FINISH PASS .5 DIA)", None),
        ("T1 (POCKET 10MM EM)", "10MM"),
        ("T1 M6", None),
        ("G41 T1 D=10.", None),
    ],
)
def test_a_comment_may_say_a_diameter(line: str, said: str | None) -> None:
    found = commented_size(["%", line, "(T1 D=99.)"], 1)
    assert found == (CommentedSize(2, said) if said else CommentedSize(3, "99"))
