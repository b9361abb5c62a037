"""Some dialogs on terminals far apart; `python -m tests.reports.dialogs` has all of them on all."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.terminal.capabilities import lookalike
from tests.reports import dialogs
from tests.reports.dialogs import DIALOGS, SIZES, box, columns_of, inside, named, on_an_xterm, one_kind, reached
from tests.reports.recorded import PLAIN
from tests.reports.terminals import Colors, Kind


def test_a_dialog_can_be_read_and_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dialogs, "SIZES", SIZES[1:])
    assert on_an_xterm("UNSAVED WORK") == []


def test_a_dialog_is_the_same_on_a_terminal_without_colors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dialogs, "DIALOGS", (named("OPEN ALREADY"),))
    assert one_kind(Kind("vt100", Colors.FEW, "UTF-8")) == []


def test_a_frame_is_a_dialog_whatever_it_is_drawn_with() -> None:
    round_one = ("GOUGE", "ab ╭─ QUIT? ─╮ cd", "   │ S SAVE  │", "ef ╰─────────╯", "status")
    framed = ["╭─ QUIT? ─╮", "│ S SAVE  │", "╰─────────╯"]
    assert box(round_one) == framed
    assert box(tuple(map(lookalike, round_one))) == [lookalike(line) for line in framed]


def test_a_drawing_beside_a_dialog_takes_no_word_from_it() -> None:
    behind = ("+- PART -----------", "| | +- QUIT? -+ |  ", "| | |  SAVE   | |  ", "| | +---------+ |  ")
    framed = columns_of(replace(named("QUIT"), title="QUIT?"), behind)
    assert [inside(line) for line in framed] == ["+- QUIT? -+", "  SAVE   ", "+---------+"]


def test_no_dialog_is_left_out() -> None:
    asked = {"QUIT", "OPEN", "OPEN ALREADY", "UNSAVED WORK", "CHANGED MEANWHILE", "TAKEN OVER", "CONTROL", "PALETTE"}
    assert asked <= {dialog.name for dialog in DIALOGS}


def test_what_is_wrong_with_a_dialog_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    """A word that is not there, colors where none are wanted."""
    units = replace(named("UNITS"), words=("no such word",))
    monkeypatch.setattr(Kind, "shown", Colors.NONE)
    told = reached(units, PLAIN, SIZES[0]).trouble
    assert "'no such word' cannot be read" in told[0]
    assert "colors where none are wanted" in told[-1]


def test_a_dialog_that_does_not_appear_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dialogs, "PATIENCE", 0.1)
    never = replace(named("UNITS"), ready="", keys=(), title="NO SUCH TITLE")
    assert "it does not come" in reached(never, PLAIN, SIZES[0]).trouble[0]
