"""Softkeys, prompt and status line as text."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.programs import empty_program
from app.painted.screens.page import Softkey
from app.painted.session import Said, Session, Tone
from app.painted.widgets.header import header
from app.painted.widgets.prompt import needed, prompt_rows
from app.painted.widgets.rows import text_of
from app.painted.widgets.softkeys import softkey_rows
from app.painted.widgets.status import status_row


def test_eight_keys_share_the_height_and_labels_wrap() -> None:
    rows = [text_of(row) for row in softkey_rows({3: Softkey("RECALCULATE LOOKAHEAD"), 8: Softkey("EXIT")}, 21)]
    assert [row.split()[1] for row in rows if "F" in row] == [f"F{number}" for number in range(1, 9)]
    first = next(index for index, row in enumerate(rows) if "F3" in row)
    assert rows[first : first + 2] == ["│ F3 RECALCULATE", "│    LOOKAHEAD"]


def test_of_a_long_name_beginning_and_end_are_told() -> None:
    session = replace(Session.of(empty_program()), file=Path("bracket.mine-2026-11-22-133333.toml"))
    _, second = header("", (), session, 80)
    assert text_of(second).strip() == "bracket.min…11-22-133333"


def test_any_height_is_possible() -> None:
    for height in range(30):
        assert len(softkey_rows({1: Softkey("DELETE SEGMENT")}, height)) == height


def test_an_error_is_marked_without_color() -> None:
    assert text_of(prompt_rows(Said("It is wrong.", Tone.ERROR), 80)[0]) == " !! It is wrong."


def test_a_long_sentence_takes_two_lines_and_then_an_ellipsis() -> None:
    rows = prompt_rows(Said("word " * 60), 40)
    assert len(rows) == 2
    assert text_of(rows[1]).endswith("…")
    assert all(len(text_of(row)) <= 40 for row in rows)


@pytest.mark.parametrize("folder", [60, 64, 66, 150])
def test_behind_a_long_path_the_reason_can_be_read(folder: int) -> None:
    said = Said(f"/{'shop' * (folder // 4)}/part.toml is not saved: the disk is full. Make room.", Tone.ERROR)
    rows = " ".join(" ".join(map(text_of, prompt_rows(said, 80))).split())
    assert rows.startswith("!! /shop")
    assert rows.endswith("part.toml is not saved: the disk is full. Make room.")


def test_a_path_that_fits_in_two_lines_is_told_whole() -> None:
    path = "/home/operator/parts/2026/november/customer/order-1234/drawing-56/bracket.nc"
    rows = [text_of(row).strip() for row in prompt_rows(Said(f"Posted: {path}, 75 lines."), 80)]
    assert "".join(rows) == f"Posted: {path}, 75 lines."
    assert rows[0].endswith("/")


def test_where_there_is_room_for_all_of_it_none_is_cut() -> None:
    said = Said("word " * 12)
    rows = prompt_rows(said, 20, needed(said, 20))
    assert " ".join(" ".join(map(text_of, rows)).split()) == said.text.strip()


def test_control_characters_of_a_files_name_do_not_reach_the_terminal() -> None:
    assert "\x1b" not in text_of(prompt_rows(Said("Opened: \x1b[2J.toml"), 80)[0])


def test_the_status_line() -> None:
    session = Session.of(empty_program())
    assert text_of(status_row(session, "16:51", 16034847, 80)) == (
        " Prog Units: IN   Free: 16034847" + " " * 42 + "16:51 "
    )
    for width in range(30):
        assert len(text_of(status_row(session, "16:51", 16034847, width))) == width
