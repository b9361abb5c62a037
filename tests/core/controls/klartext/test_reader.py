"""Program text into blocks: numbers, comments, continuation lines, places."""

from __future__ import annotations

import pytest

from core.controls.klartext.reader import MAX_LINE_LENGTH, TOO_LONG, WORD, Block, is_klartext_text, read_blocks


def only(line: str) -> Block:
    (block,) = read_blocks([line])
    return block


def test_block_numbers_and_blanks_stand_before_the_head() -> None:
    assert only("  12 L X+1 ; go") == Block(1, "L", " X+1", 7, skip=False)
    assert only("L X+1").begin == 2
    assert only("/ 7 L X+1") == Block(1, "L", " X+1", 6, skip=True)


def test_lower_case_counts_and_other_alphabets_keep_their_length() -> None:
    assert only("l x+1") == Block(1, "L", " X+1", 2, skip=False)
    assert only("L ß").body == " ß"


def test_glued_heads() -> None:
    assert [only(line).head for line in ("LX+1", "CCX+1", "CX+1", "LIX1", "CTX", "LBL 1")] == [
        "L", "CC", "C", "L", "CTX", "LBL",
    ]  # fmt: skip


def test_empty_lines_and_comments_are_no_blocks() -> None:
    assert list(read_blocks(["", "   ", "; only this", "14", "15 ; that"])) == []


def test_a_line_that_ends_in_a_tilde_goes_on_in_the_next() -> None:
    lines = ["5 CYCL DEF 200 DRILLING ~", " Q200=2 ;CLEARANCE ~", " Q201=-20 ;DEPTH", "6 L X+1"]
    assert [(block.line, block.head) for block in read_blocks(lines)] == [(1, "CYCL"), (4, "L")]


def test_a_sign_that_begins_nothing_is_a_head_of_its_own() -> None:
    assert only("  % junk")[:4] == (1, "%", " JUNK", 4)
    assert only("* - TOOL 3").head == "*"


def test_a_line_of_a_megabyte_is_not_read() -> None:
    assert only("L X+1 " * 170_000) == Block(1, TOO_LONG, "", 1, skip=False)
    assert only("L" + " " * (MAX_LINE_LENGTH - 4) + "X+1").head == "L"


def test_words() -> None:
    found = [word[:2] for word in WORD.findall("X+10 IY-.5 RL F100 FMAXM3 R0 DR- PA Q5 LEN 7 R-Q3 RLF5")]
    assert found == [
        ("X", "+10"), ("IY", "-.5"), ("RL", ""), ("F", "100"), ("FMAX", ""), ("M", "3"), ("R", "0"), ("DR", "-"),
        ("PA", "Q5"), ("LEN", "7"), ("R", "-Q3"), ("RL", ""), ("F", "5"),
    ]  # fmt: skip


def test_places_of_words() -> None:
    block = only("12 L X+1 RL M3")
    assert block.at("RL").column == 10
    assert block.at("M3").column == 13
    assert block.at("Y").column == 4


@pytest.mark.parametrize(
    "text",
    [
        "0 BEGIN PGM A MM",
        "; a note\n(a header)\n  0  begin pgm a mm\nG0 X1\nG0 X2",
        "L X+1 Y+2 R0 FMAX",
        "N10 L Z-5 F100\nN20 LX+1",
        "CC X+0 Y+0\nCP IPA+90 DR+",
        "TOOL CALL 1 Z S1000",
        "M3\nRND R5\n/ 5 CR X+1 R+4 DR-",
        "LBL 1\nL IX+1\nCALL LBL 1 REP 3",
        "CYCL DEF 200 DRILLING",
        "APPR LCT X+1 Y+2 R5 RL",
    ],
)
def test_a_program_or_a_piece_of_one_is_known_as_klartext(text: str) -> None:
    assert is_klartext_text(text.split("\n"))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "M3\nT1 M6",
        "%\nO1000 (CC X+0)\nG0 X1 Y2",
        "G17 G20\nX1. Y2.\nL1",
        "N10 G1 X+1 Y+2 F100\nN20 X+2",
        "C90.\nG0 X1",
        "(L X+1 Y+2)",
    ],
)
def test_word_addresses_are_no_klartext(text: str) -> None:
    assert not is_klartext_text(text.split("\n"))
