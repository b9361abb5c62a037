"""Program frame, units, tools, M functions, and ignored or refused blocks."""

from __future__ import annotations

import pytest

from core.controls.control_tools import CutterTool, ToolTable, table_of
from core.controls.klartext.control import run_klartext
from core.finding import Severity
from core.units import Unit
from tests.core.controls.klartext.klartext_runs import clean, codes, flat, points, runs

NEAR = pytest.approx
CONTOUR = ("L X-20 Y+0 R0 FMAX", "L X+0 Y+0 RL F9", "L X+30", "L X+60 R0")
NONE: ToolTable = {}


def entry(*before: str, tools: ToolTable = NONE) -> float:
    """The distance of the tool from the contour."""
    return flat(runs(*before, *CONTOUR, tools=tools))[0][1]


def test_inch_programs_are_read_in_inches() -> None:
    tool = "TOOL DEF 1 L+0 R+.25\nTOOL CALL 1 Z DR+.01\n"
    moves = "L X+1 Y+0 F10\nCC X+0 Y+0\nCP PA+90 DR+\n"
    run = run_klartext(f"BEGIN PGM P INCH\n{tool}{moves}END PGM P INCH".encode(), NONE)
    assert run.unit is Unit.IN
    assert codes(run) == [("UNIT", 1), ("TOOL", 3)]
    assert run.moves[1].point == (25.4, 0, 0)
    assert run.moves[1].feed == 254
    assert flat(run)[0] == NEAR((0, 25.4, 0, 0, 1))


def test_the_radius_comes_from_the_tool_data() -> None:
    assert entry() == 5
    assert entry("TOOL CALL 1 Z S1 DL+1 DR-0.5") == 4.5
    assert entry("TOOL CALL DR+0.5") == 5.5
    assert entry("TOOL DEF 7 L+0 R+3", "TOOL CALL 7 Z") == 3
    assert entry('TOOL DEF "MILL 3" R1,5', 'TOOL CALL "MILL 3" Z S900 F100') == 1.5
    assert entry("TOOL DEF 9") == 5
    assert entry("TOOL DEF 3 L+1 R+2 R2+1", "TOOL CALL 3 Z DR2+0.1") == 2


def test_the_tool_table_takes_precedence_over_tool_def_and_is_reported() -> None:
    tools = table_of(CutterTool(1, 9.0), CutterTool(4, 0.25, unit=Unit.IN))
    run = runs("TOOL CALL 1 Z", *CONTOUR, tools=tools)
    assert [(finding.code, finding.severity) for finding in run.findings] == [("TOOL", Severity.INFO)] * 2
    assert entry("TOOL CALL 1 Z", tools=tools) == 4.5
    assert entry("TOOL CALL 4 Z", tools=tools) == NEAR(3.175)


def test_a_radius_that_dr_changes_is_reported() -> None:
    run = runs("TOOL CALL 1 Z S1 DL+1 DR-0.5", *CONTOUR)
    (told,) = run.findings
    assert (told.code, told.severity, told.line, told.lengths) == ("TOOL", Severity.INFO, 4, (4.5,))


def test_a_feed_in_the_tool_call_takes_effect() -> None:
    assert clean("TOOL CALL 1 Z F77", "L X+1 Y+1").moves[1].feed == 77


@pytest.mark.parametrize(
    ("blocks", "rule", "line"),
    [
        (("TOOL CALL 5 Z", *CONTOUR), "TOOL", 6),
        (("L X+0 Y+0 Z+1 R0 F9", "L X+9 RL", "L X+20", "TOOL CALL 1 Z"), "TOOL", 7),
        (("TOOL DEF L+0 R+5",), "TOOL", 4),
        (("TOOL CALL 1 Z X",), "TWICE", 4),
        (("TOOL NAME 1",), "WORD", 4),
        (("Q5 = -3", "TOOL CALL Q5 Z"), "TOOL", 5),
        (("Q5 = 1.5", "TOOL CALL Q5 Z"), "TOOL", 5),
        (("CYCL CALL",), "CYCLE", 4),
        (("L X+1 Y+1 FMAX M99",), "CYCLE", 4),
        (("CYCL",), "WORD", 4),
        (("TOOL CALL QS1 Z S1000",), "BEYOND", 4),
        (("CYCL DEF 12.0 PGM CALL", "CYCL DEF 12.1 OTHER", "CYCL CALL"), "BEYOND", 6),
        (("CYCL DEF 200 DRILLING", "L X+0 Y+0 FMAX", "L X+9 RL F9", "L X+20", "CYCL CALL"), "CYCLE", 8),
        (("CYCL DEF 200 DRILLING", "L X+0 Y+0 FMAX", "L X+9 RL F9", "CYCL DEF 220 POLAR PATTERN"), "CYCLE", 7),
        (("CYCL DEF 10.1 ROT+30", "CYCL DEF 8.1 X"), "BEYOND", 5),
        (("CYCL DEF 8.1 X", "CYCL DEF 10.1 ROT+30"), "BEYOND", 5),
        (("CYCL DEF 8.1 Z",), "BEYOND", 4),
        (("CYCL DEF 8.1 X+1",), "BEYOND", 4),
        (("CYCL DEF 10.1",), "WORD", 4),
        (("CYCL DEF 10.1 ROT+30", "CYCL DEF 7.1 X+10", "L X+1 FMAX"), "BEYOND", 6),
        (("CYCL DEF 10.1 ROT+30", "TRANS DATUM RESET", "L X+1 FMAX"), "BEYOND", 6),
        (("CYCL DEF 8.1 X", "TOOL CALL 1 Y", "L X+1 FMAX"), "BEYOND", 6),
        (("CYCL DEF 8.1 X", "L X+0 Y+0 Z+0 FMAX", "CC X+5 Z+0", "C X+0 Z+0 DR+ F9"), "BEYOND", 7),
        (("L X+0 Y+0 FMAX", "L X+9 RL F9", "L X+20", "CYCL DEF 8.1 X"), "CYCLE", 7),
        *(((f"CYCL DEF {cycle}.0",), "BEYOND", 4) for cycle in (26, 27, 28, 29)),
        (("CYCL DEF 10 ROT+5",), "BEYOND", 4),
        (("CYCL DEF 11.1 SCL 1.5",), "BEYOND", 4),
        (("CYCL DEF 19.1 A+0 B+15",), "BEYOND", 4),
        (("L X+1 Y+0 FMAX", "L X+5 F9", "CYCL DEF 247 DATUM SETTING"), "BEYOND", 6),
        (("PLANE RESET MOVE",), "BEYOND", 4),
        (("L X+1 Y+1 RL F9", "L Z+0 FMAX M91"), "BEYOND", 5),
        (("M89",), "BEYOND", 4),
        (("L Z+1 MB MAX",), "WORD", 4),
        (("CYCL DEF 7.1 #5",), "BEYOND", 4),
        (("Q1 = 7 % 4",), "BEYOND", 4),
        (("PATTERN DEF POS1 (X+5 Y+5 Z+0)",), "BEYOND", 4),
        (("PLANE SPATIAL SPA+10",), "BEYOND", 4),
        (("PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY",), "BEYOND", 4),
        (("PLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE ABST50",), "BEYOND", 4),
        (("FUNCTION TCPM F TCP",), "BEYOND", 4),
        (('SEL TABLE "X"',), "BEYOND", 4),
        (("Q8 = 30", "CYCL DEF 8.1 Y", "CYCL DEF 10.1 ROT+Q8"), "BEYOND", 6),
        (("L C+Q122 FMAX",), "Q", 4),
        (("L U+0",), "BEYOND", 4),
        (("CALL PGM OTHER",), "BEYOND", 4),
        (("FC DR+ R10",), "BEYOND", 4),
        (("FN 18: SYSREAD Q1 = ID1", "L X+Q1 F9"), "Q", 5),
        (("Q1 = 5", "FN 18: SYSREAD Q1 = ID1", "L X+Q1 F9"), "Q", 6),
        (("FN 14: ERROR = 1",), "BEYOND", 4),
        (("(X+1",), "WORD", 4),
        (("BEGIN PGM Q MM",), "PROGRAM", 4),
        (("L X+1 M91",), "BEYOND", 4),
        (("L X+1 A+90",), "BEYOND", 4),
        (("L X+1 R+",), "BEYOND", 4),
        (("L X+1 LA5",), "WORD", 4),
        (("X+30 R+ F100",), "BEYOND", 4),
        (("G1 X10",), "WORD", 4),
        (("L X+1 X+2",), "TWICE", 4),
        (("L X+1 IX+2",), "TWICE", 4),
        (("L X+1 F1 FMAX",), "TWICE", 4),
        (("L X+1 R0 RL",), "TWICE", 4),
        (("L X+\u0663",), "WORD", 4),
        (("L X",), "NUMBER", 4),
        (("L X+",), "NUMBER", 4),
        (("L X+99999999",), "NUMBER", 4),
        (("L X+1 F-3",), "NUMBER", 4),
        (("L X+1 M+",), "NUMBER", 4),
        (("CR X+1 Y+0 R DR+",), "NUMBER", 4),
        (("LBL",), "LABEL", 4),
        (("CHF",), "CORNER", 4),
        (("L X+0 Y+20 RL F300", "RND R5", "L Y+50"), "BEYOND", 5),
        (("L X+0 Y+20 RL F300", "L Y+50", "L X+50", "RND R5", "L Y+70 R0"), "BEYOND", 7),
        (("DEP PLT LEN5",), "WORD", 4),
        (("APPR XX",), "WORD", 4),
        (("END",), "WORD", 4),
        (("STOP X+1",), "WORD", 4),
        (("TRANS MIRROR AXIS X",), "BEYOND", 4),
    ],
)
def test_unsupported_or_wrong_blocks_stop_the_program(blocks: tuple[str, ...], rule: str, line: int) -> None:
    run = runs(*blocks)
    assert codes(run)[-1] == (rule, line)
    assert run.stopped_at == line
    assert run.findings[-1].severity is Severity.ERROR


@pytest.mark.parametrize(
    ("block", "rule", "severity"),
    [
        ("BLK FORM 0.1 Z X+0 Y+0 Z-20", "IGNORED", Severity.INFO),
        ("CYCL DEF 200 DRILLING", "IGNORED", Severity.INFO),
        ("(A PROGRAM OF THE SHOP)", "IGNORED", Severity.INFO),
        ("N20 (A PROGRAM OF THE SHOP)", "IGNORED", Severity.INFO),
        ("FN 18: SYSREAD Q1 = ID210 NR1", "IGNORED", Severity.INFO),
        ("FN 16: F-PRINT A.A / B.TXT", "IGNORED", Severity.INFO),
        ('DECLARE STRING QS1 = "A"', "IGNORED", Severity.INFO),
        ("CYCL DEF 10.1 ROT+0", "IGNORED", Severity.INFO),
        ("CYCL DEF 11.1 SCL 1.000", "IGNORED", Severity.INFO),
        ("PLANE SPATIAL SPA+0 SPB0 SPC-0 STAY SEQ+ TABLE ROT", "IGNORED", Severity.INFO),
        ("FUNCTION RESET TCPM", "IGNORED", Severity.INFO),
        ("L A0 C+0.000 FMAX", "AXIS", Severity.INFO),
        ("CYCL DEF 8.1", "IGNORED", Severity.INFO),
        ("CYCL DEF 11.1 SCL 1", "IGNORED", Severity.INFO),
        ("CYCL DEF 19.1 A+0 B+0 C+0", "IGNORED", Severity.INFO),
        ("PLANE RESET STAY", "IGNORED", Severity.INFO),
        ("L Z-1 R0 FMAX M91", "MACHINE", Severity.WARNING),
        ("L M140 MB MAX", "MACHINE", Severity.WARNING),
        ("M140 MB MAX", "MACHINE", Severity.WARNING),
        ("L X+1 F9 M120 LA5", "M", Severity.WARNING),
        ("L X+1 F9 M136", "M", Severity.WARNING),
        ("L X+1 F9 M42", "M", Severity.INFO),
        ("/ L X+1 F9", "SKIP", Severity.INFO),
        ("L X+1", "FEED", Severity.WARNING),
    ],
)
def test_ignored_and_warned_blocks_do_not_stop_the_run(block: str, rule: str, severity: Severity) -> None:
    run = runs("L X+0 Y+0 Z+1 FMAX", block, "L X+5 F9")
    assert [(finding.code, finding.severity, finding.line) for finding in run.findings] == [(rule, severity, 5)]
    assert points(run)[-1] == (5, 0, 1)


@pytest.mark.parametrize(
    ("block", "text"),
    [
        ("BLK FORM 0.1 Z X+0 Y+0 Z-20", "BLK FORM moves nothing and is skipped."),
        ("PLANE RESET STAY", "PLANE without a tilt moves nothing and is skipped."),
        ("FUNCTION MODE MILL", "FUNCTION MODE MILL moves nothing and is skipped."),
        ("CYCL DEF 32.1 T0.05", "Cycle 32 is skipped: it moves nothing."),
        ("CYCL DEF 200 DRILLING", "Cycle 200 is skipped: it moves nothing before it is called."),
    ],
)
def test_skipped_blocks_are_named(block: str, text: str) -> None:
    assert [finding.text for finding in runs(block).findings] == [text]


def test_a_tool_may_be_called_by_a_parameter() -> None:
    run = runs("TOOL DEF 7 L+0 R+5", "Q3 = 7", "TOOL CALL Q3 Z S500", "L X+0 Y+0 Z+1 FMAX", "L X+9 RL F9", "L X+20")
    assert [stretch.radius for stretch in run.stretches] == [5.0]


@pytest.mark.parametrize(
    "block", ["* - ROUGHING", "STOP M5", "M9", "L M3", "CYCL DEF 7.0 DATUM SHIFT", "TOOL CALL S500"]
)
def test_blocks_without_effect_have_no_findings(block: str) -> None:
    assert len(clean(block).moves) == 1


def test_m2_ends_the_program_after_its_block() -> None:
    run = clean("L X+1 Y+1 F9 M2", "this is never read")
    assert flat(run, 1) == [(1, 1)]


def test_a_program_without_its_frame_is_reported() -> None:
    run = run_klartext(b"L X+10 Y+10 R0 FMAX M3", NONE)
    assert codes(run) == [("PROGRAM", 1)]
    assert flat(run, 1) == [(10, 10)]
    assert codes(run_klartext(b"BEGIN PGM P MM\nL X+1 Y+1 FMAX\n", NONE)) == [("PROGRAM", 2)]
    assert codes(run_klartext(b"", NONE)) == [("PROGRAM", 1)]


def test_a_feed_move_from_an_unknown_position_is_reported() -> None:
    assert codes(runs("L X+1 F9", "L X+2")) == [("POSITION", 4)]


def test_all_line_ends_and_encodings_are_read() -> None:
    program = "BEGIN PGM P MM\nL X+1 Y+2 FMAX ; größer\nEND PGM P MM"
    for text in (program, program.replace("\n", "\r\n"), program.replace("\n", "\r")):
        for encoding in ("utf-8", "latin-1", "utf-16", "utf-8-sig"):
            assert flat(run_klartext(text.encode(encoding), NONE), 1) == [(1, 2)]


def test_findings_contain_no_control_characters_of_the_file() -> None:
    for junk in (b"\x1b[31m", b"L X+1 \x1b]0;hi\x07", b"\x00\x01", b"LBL {0}", "L X+1 \u202e".encode()):
        run = run_klartext(b"BEGIN PGM P MM\n" + junk, NONE)
        assert run.stopped_at == 2
        assert all(character.isprintable() for character in run.findings[-1].text)
        assert "{0}" not in run.findings[-1].text


def test_a_datum_setting_before_any_move_is_ignored() -> None:
    run = runs("CYCL DEF 247 DATUM SETTING ~", "  Q339=+1 ;DATUM NUMBER", "L X+1 Y+1 FMAX")
    assert codes(run) == [("IGNORED", 4)]
    assert flat(run, 1) == [(1, 1)]


def test_incremental_words_after_a_machine_position_are_reported() -> None:
    run = runs("L X+1 Y+1 Z+1 FMAX", "L X+0 R0 FMAX M92", "L IX+5 F9")
    assert codes(run) == [("MACHINE", 5), ("POSITION", 6)]


def test_a_program_without_tool_call_takes_the_only_tool_and_reports_it() -> None:
    text = "\n".join(CONTOUR).encode()
    one_tool, two_tools = table_of(CutterTool(7, 9.0)), table_of(CutterTool(7, 9.0), CutterTool(8, 4.0))
    run = run_klartext(text, one_tool)
    assert flat(run)[0][1] == 4.5
    assert ("TOOL", 2) in codes(run)
    assert run_klartext(text, two_tools).stopped_at == 2
    assert run_klartext(text, NONE).stopped_at == 2
    assert run_klartext(f"TOOL CALL 3 Z\n{text.decode()}".encode(), one_tool).stopped_at == 3


def test_an_axis_at_a_machine_position_is_unknown_until_it_is_programmed() -> None:
    for block, position in (("L X+5 IY+1 F9", "POSITION"), ("L IX+5 Y+1 F9", "")):
        run = runs("L X+0 Y+0 Z+1 FMAX", "L Y+9 FMAX M91", block)
        assert [finding.code for finding in run.findings] == ["MACHINE", *filter(None, (position,))]


def test_a_header_before_begin_pgm_may_have_open_brackets() -> None:
    text = "( SHEET\n(   MACHINE: A\n(\nBEGIN PGM P MM\nL X+1 Y+2 FMAX\n{}END PGM P MM\n"
    assert flat(run_klartext(text.format("").encode(), NONE), 1) == [(1, 2)]
    assert run_klartext(text.format("( OPEN\n").encode(), NONE).stopped_at == 6


def test_a_rotation_of_0_and_a_scale_of_1_may_be_parameters() -> None:
    run = runs("Q8 = 0", "Q9 = 1", "CYCL DEF 10.1 ROT+Q8", "CYCL DEF 11.1 SCL Q9", "L X+1 Y+1 FMAX")
    assert run.stopped_at is None


def test_a_plane_without_tilt_sets_its_axis_angles() -> None:
    run = runs("PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY", "L A+Q120 C+Q122 FMAX", "L X+1 Y+1 FMAX")
    assert flat(run, 1) == [(1, 1)]


def test_a_blank_may_separate_a_sign_from_its_number() -> None:
    assert flat(runs("L X + 3 Y- 4 FMAX"), 1) == [(3, -4)]


@pytest.mark.parametrize(
    ("blocks", "end"),
    [
        (("CYCL DEF 7.1 X+5 Y+1", "CYCL DEF 7.2 IX+1", "L X+1 Y+1 Z+0"), (7, 2, 0)),
        (("TRANS DATUM AXIS X+5 Z+6", "L X+1 Y+1 Z+1"), (6, 1, 7)),
        (("TRANS DATUM AXIS X+5 Y+6", "TRANS DATUM RESET", "L X+1 Y+1 Z+1"), (1, 1, 1)),
    ],
)
def test_a_datum_shift_counts_from_the_unshifted_datum_or_from_the_last_shift(
    blocks: tuple[str, ...], end: tuple[float, ...]
) -> None:
    assert points(runs("L X+9 Y+9 Z+9 R0 F100", *blocks))[-1] == end
