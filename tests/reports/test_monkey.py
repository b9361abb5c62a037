"""A short walk of the monkey; `python -m tests.reports.monkey` is the long one."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from app.app import CutcompApp
from app.documents.document_service import DocumentService
from app.session.session import Session
from tests.app.widget_pilot import operator
from tests.reports import monkey
from tests.reports.monkey import MEGABYTE, Tally, report, run, screens, typed
from tests.reports.monkey_keys import Coverage, Monkey


def test_random_keys_do_no_harm() -> None:
    tally = run(20, seed=3)
    assert tally.wrong == []
    assert tally.keys >= 20
    assert tally.looks >= 1


def test_keys_that_do_something_are_counted() -> None:
    tally = typed("tab", "7", "enter", "f11", "f11", "f6")
    assert (tally.keys, tally.acted, tally.edits) == (6, 4, 1)
    assert set(tally.coverage.screens) == {"ContourScreen"} < set(screens())
    assert tally.wrong == []


def test_a_program_that_dies_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Session, "undone", lambda _: 1 / 0)
    # without the traceback that a terminal would show, with all that the App holds
    monkeypatch.setattr(CutcompApp, "_fatal_error", CutcompApp._close_messages_no_wait)
    told = typed("tab", "7", "enter", "ctrl+z", "tab").wrong
    assert told == [told[0]]
    assert told[0].startswith("ZeroDivisionError")
    assert told[0].endswith("after tab 7 enter ctrl+z")


def test_work_that_is_not_kept_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither in the journal nor in the file."""
    monkeypatch.setattr(DocumentService, "keep", lambda *_: None)
    monkeypatch.setattr(monkey, "loads", lambda *_: None)
    monkeypatch.setattr(monkey, "EVERY", 3)
    journal, file = typed("tab", "7", "enter").wrong
    assert "the journal does not bring back the program" in journal
    assert "does not come back from its file" in file


async def test_a_form_that_shows_something_else_is_found() -> None:
    async with operator("pocket") as at:
        assert list(monkey.form_troubles(at.app)) == []
        row = at.row("tool")
        row.cell = type(row.cell)("tool", "TOOL", "99", 0)
        assert any("TOOL shows '99'" in text for text in monkey.form_troubles(at.app))


async def test_a_cursor_out_of_sight_is_found() -> None:
    async with operator("pocket") as at:
        await at.press("f6")
        assert list(monkey.form_troubles(at.app)) == []
        at.screen.query_one("#tool-rows").display = False
        await at.settle()
        assert any("the cursor is nowhere" in text for text in monkey.form_troubles(at.app))
        while at.session.program.tools:
            await at.press("f1")
        assert list(monkey.form_troubles(at.app)) == []


async def test_nothing_acts_outside_the_cage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    one = Monkey(Random(1), tmp_path)
    async with operator("pocket") as at:
        assert isinstance(at.app, CutcompApp)
        await at.press("ctrl+s")
        assert one.caged(at.app, "enter") == "enter"
        await at.press("end", "'/../../../x")
        assert one.caged(at.app, "enter") == "escape"


def test_the_report_names_what_was_not_reached() -> None:
    tally = Tally(keys=1, memory=[(1, MEGABYTE)])
    tally.coverage = Coverage(seen={("DrawScreen", 1, "ALL"), ("DrawScreen", 2, "IN")})
    tally.coverage.pressed["DrawScreen", 1, "ALL"] += 1
    told = list(report(tally, 1.0, 1))
    assert "softkeys 1 of 2, not DrawScreen F2 IN" in told
    assert told[-1] == "failures 0"
