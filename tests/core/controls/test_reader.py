"""Reading lines into words, with columns for faults."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.controls.control_run import AlarmError, Log
from core.controls.iso.reader import PLAIN_SYNTAX, Block, Syntax, ToolData, read_line, tenths, whole
from core.controls.klartext.control import run_klartext
from core.controls.program_text import lines_of, quoted
from core.finding import Finding
from tests.properties import exercised, must_exercise


def block(text: str, syntax: Syntax = PLAIN_SYNTAX) -> Block:
    (only,) = read_line(text, 1, Log(), syntax)
    return only


def alarm(text: str) -> Finding | None:
    try:
        read_line(text, 1, Log(), Syntax(semicolon_ends=True, tool_data=True))
    except AlarmError as caught:
        return caught.finding
    return None


def fault(text: str) -> tuple[str, int | None]:
    with pytest.raises(AlarmError) as caught:
        read_line(text, 3, Log())
    assert caught.value.finding.line == 3
    return caught.value.finding.code, caught.value.finding.column


@pytest.mark.parametrize(
    "text", ["G1X1.5Y-.25F20.", "g1 x1.5 y-.25 f20.", "  G01  X 1.5\tY-.25 F20", "G1X+1.5Y-0.25F20;end"]
)
def test_words_may_touch_be_spaced_or_be_lowercase(text: str) -> None:
    read = block(text)
    assert read.g == [10]
    assert read.words == {"X": 1.5, "Y": -0.25, "F": 20.0}


def test_codes_are_counted_in_tenths() -> None:
    read = block("G41.1 G90 M6 M03")
    assert (read.g, read.m) == ([411, 900], [60, 30])
    assert (tenths(41.1), tenths(41.15), tenths(-1.0), tenths(1e9)) == (411, None, None, None)
    assert (whole(3.00001), whole(2.5)) == (3, None)


@pytest.mark.parametrize("text", ["", "   ", "%", "(nothing)", "; nothing", "(a)(b) ; c"])
def test_lines_without_words_have_no_block(text: str) -> None:
    assert read_line(text, 1, Log()) == []


def test_comments_may_be_anywhere() -> None:
    assert block("G1 (to X9) X2 (Y9) ; Y8").words == {"X": 2.0}
    assert block("(a;b) X2").words == {"X": 2.0}


def test_columns_count_from_1_and_include_comments() -> None:
    read = block("(X9) G1 X2")
    assert (read.at("X").column, read.at("G", 10).column, read.at("Z").column) == (9, 6, 1)


@pytest.mark.parametrize(
    ("text", "code", "column"),
    [
        ("G1 X1 X2", "TWICE", 7),
        ("G1 X", "WORD", 4),
        ("G1 X1 ?", "WORD", 7),
        ("G1 X1..2", "WORD", 7),
        ("G1 X[1+2]", "MACRO", 4),
        ("#1=2", "MACRO", 1),
        ("G1 X#1", "MACRO", 4),
        ("G1 (open", "COMMENT", 4),
        ("G1 X1) Y2", "WORD", 6),
        ("G1.55 X1", "CODE", 1),
        ("X1" + "0" * 30, "NUMBER", 1),
    ],
)
def test_faults_have_a_column(text: str, code: str, column: int) -> None:
    assert fault(text) == (code, column)


def test_blanks_may_be_insignificant() -> None:
    read = block("G4 1 X1 .5 Y - 2", Syntax(strict=True))
    assert (read.g, read.words) == ([410], {"X": 1.5, "Y": -2.0})
    assert fault("G4 1 X1")[0] == "WORD"


def test_tool_data_follow_slashes() -> None:
    assert block("T4/.75/.2", Syntax(tool_data=True)).data == ToolData(4, 0.75, 0.2)
    assert block("T5//-.5", Syntax(tool_data=True)).data == ToolData(5, None, -0.5)


def test_a_semicolon_may_end_a_block() -> None:
    blocks = read_line("G1X1;X2;Y3.", 1, Log(), Syntax(semicolon_ends=True, tool_data=True))
    assert [read_block.words for read_block in blocks] == [{"X": 1.0}, {"X": 2.0}, {"Y": 3.0}]
    assert [read_block.at("XY").column for read_block in blocks] == [3, 6, 9]


def test_a_semicolon_in_a_comment_ends_no_block() -> None:
    blocks = read_line("G1X1(ROUGH;FINISH)Y2;Y3", 1, Log(), Syntax(semicolon_ends=True))
    assert [read.words for read in blocks] == [{"X": 1.0, "Y": 2.0}, {"Y": 3.0}]


def test_text_after_the_end_of_a_block_is_reported() -> None:
    log = Log()
    (read,) = read_line("T5//-.5;        For tool 5, DIA=-.5", 1, log, Syntax(semicolon_ends=True, tool_data=True))
    assert read.data == ToolData(5, None, -0.5)
    assert [(finding.code, finding.column) for finding in log.findings] == [("TEXT", 17)]


def test_block_skip_is_ignored_and_reported() -> None:
    log = Log()
    (read,) = read_line("/G1X1", 1, log)
    assert read.words == {"X": 1.0}
    assert [finding.code for finding in log.findings] == ["SKIP"]


def test_a_block_skip_with_a_number_is_named() -> None:
    with pytest.raises(AlarmError) as caught:
        read_line("/2 X40.", 1, Log())
    assert caught.value.finding.text == "cutcomp knows no block skip with a number on this control. Write / alone."
    assert caught.value.finding.column == 2


def test_a_slash_within_the_block_is_a_fault() -> None:
    with pytest.raises(AlarmError) as caught:
        read_line("/G1X1/Y2", 1, Log())
    assert (caught.value.finding.code, caught.value.finding.column) == ("WORD", 6)
    assert "takes / only at the beginning of a block" in caught.value.finding.text


@pytest.mark.parametrize(
    "text", [b"G1\nX2\n", b"G1\r\nX2", b"G1\rX2\r", b"\xef\xbb\xbfG1\nX2", "G1\nX2".encode("utf-16")]
)
def test_all_line_ends_and_encodings_are_read(text: bytes) -> None:
    assert lines_of(text) == ["G1", "X2"]


def test_bytes_that_are_no_text_are_still_lines() -> None:
    assert lines_of(b"\xff\x00\x81\nG1") == ["\xff\x00\x81", "G1"]
    assert lines_of(b"") == []


def test_letters_that_only_look_like_ascii_are_not_words() -> None:
    assert fault("\u017f500")[0] == "WORD"


def test_quoted_text_has_no_control_characters() -> None:
    assert quoted("\x1b[2J\x07{x}") == "?[2J??x?"
    assert quoted("A" * 100) == "A" * 24 + "..."
    assert quoted(" " * 10 + "A" * 22) == "A" * 22


@pytest.mark.timeout(60)
@pytest.mark.parametrize("piece", ["X1", "(", "()", "1", " ", ";", ")(", "X"])
def test_a_line_of_two_hundred_kilobytes_is_read_to_its_end(piece: str) -> None:
    """A quadratic reader would take many minutes."""
    finding = alarm(piece * (200_000 // len(piece)))
    assert finding is None or len(finding.text) < 200


@must_exercise(0.02, "read", "fault")
@given(st.text(max_size=60) | st.lists(st.sampled_from(["G1", "X-2.5", "#1", " ", "(a)", "(", "Y"])).map("".join))
@settings(max_examples=300, derandomize=True)
def test_any_text_is_read_or_has_a_fault(text: str) -> None:
    finding = alarm(text)
    exercised("read" if finding is None else "fault")
    assert finding is None or finding.text.isprintable()
    assert finding is None or (finding.column or 0) >= 1


def test_a_number_too_large_for_any_machine_is_named_with_the_limit() -> None:
    finding = alarm("G1 X20000000. Y0")
    assert finding is not None
    assert finding.text == "X20000000. is too large: no machine goes beyond 10,000,000."
    made = run_klartext(b"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L X+20000000 FMAX\n3 END PGM A MM\n", {})
    assert made.findings[-1].text == "X 2e+07 is too large: no machine goes beyond 10,000,000."
