"""The dialogs on the terminals furthest apart; `python -m tests.reports.dialogs` has them on all."""

from __future__ import annotations

import pytest

from tests.reports import dialogs
from tests.reports.dialogs import NAMES, SCENES, one_kind
from tests.reports.terminals import Colors, Kind


@pytest.mark.parametrize("kind", [Kind("vt100", Colors.FEW, "UTF-8"), Kind("xterm-mono", Colors.FEW, "UTF-8")], ids=str)
def test_every_dialog_is_what_it_is_on_an_xterm(kind: Kind) -> None:
    assert one_kind(kind) == []


def test_no_screen_is_left_out() -> None:
    asked = {"START", "OPEN", "SAVE AS", "NC PROOF", "OPEN ALREADY", "recovery", "LEAVE", "CHANGED MEANWHILE"}
    assert asked <= set(NAMES)


def test_a_screen_that_is_wrong_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Colors where none are wanted, another text, a screen that does not come."""
    scene = next(one for one in SCENES if one.steps[0].name == "OPEN ALREADY")
    monkeypatch.setattr(dialogs, "SCENES", (scene,))
    monkeypatch.setattr(dialogs, "expected", lambda _: {"OPEN ALREADY": ["another"]})
    monkeypatch.setattr(Kind, "shown", Colors.NONE)
    told = one_kind(Kind("xterm", Colors.FEW, "UTF-8"))
    assert "colors where none are wanted" in told[0]
    assert "instead of 'another'" in told[1]
    assert "NC PROOF was not reached" in told[-1]
