"""Some dialogs on terminals far apart; `python -m tests.reports.dialogs` has all of them on all."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.reports import dialogs
from tests.reports.dialogs import DIALOGS, SIZES, named, on_an_xterm, one_kind, reached
from tests.reports.recorded import PLAIN
from tests.reports.terminals import Colors, Kind


@pytest.mark.parametrize("name", ["UNSAVED WORK", "SHIFT BLOCK"])
def test_a_dialog_can_be_read_and_left(name: str) -> None:
    assert on_an_xterm(name) == []


def test_dialogs_are_the_same_on_a_terminal_without_colors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dialogs, "DIALOGS", (named("UNITS"), named("OPEN ALREADY")))
    assert one_kind(Kind("vt100", Colors.FEW, "UTF-8")) == []


def test_no_dialog_is_left_out() -> None:
    asked = {"QUIT", "OPEN", "OPEN ALREADY", "UNSAVED WORK", "CHANGED MEANWHILE", "TAKEN OVER", "CONTROL", "PALETTE"}
    assert asked <= {dialog.name for dialog in DIALOGS}


def test_what_is_wrong_with_a_dialog_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A word that is not there, a dialog that does not come, colors where none are wanted."""
    monkeypatch.setattr(dialogs, "PATIENCE", 5.0)
    units = replace(named("UNITS"), words=("no such word",))
    monkeypatch.setattr(Kind, "shown", Colors.NONE)
    told = reached(units, PLAIN, SIZES[0]).trouble
    assert "'no such word' cannot be read" in told[0]
    assert "colors where none are wanted" in told[-1]
    never = replace(units, title="NO SUCH TITLE")
    assert "it does not come" in reached(never, PLAIN, SIZES[0]).trouble[0]
