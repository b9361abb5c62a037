"""A short walk of the monkey; `python -m tests.reports.monkey` is the long one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest

from app.app import CutcompApp
from app.documents.service import DocumentService
from app.session.session import Session
from tests.app.widget_pilot import operator
from tests.reports import monkey
from tests.reports.monkey import MEGABYTE, Tally, report, run, screens
from tests.reports.monkey_keys import Coverage, Monkey


def test_random_keys_on_many_screens() -> None:
    tally = run(300, seed=3)
    assert tally.wrong == []
    assert tally.keys >= 300
    assert tally.acted > 150
    assert tally.looks >= 10
    assert len(set(tally.coverage.screens) & set(screens())) >= 5


BROKEN: dict[str, tuple[Any, str, Callable[..., Any], str]] = {
    "an exception": (Session, "undone", lambda _: 1 / 0, "ZeroDivisionError"),
    "a forgotten journal": (DocumentService, "keep", lambda *_: None, "the journal does not bring back"),
    "a changed file": (monkey, "loads", lambda *_: None, "does not come back from its file"),
}
"""What is broken on purpose, and what must be told of it."""


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_program_is_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    where, attribute, instead, told = BROKEN[name]
    monkeypatch.setattr(where, attribute, instead)
    assert any(told in text for text in run(200, seed=1).wrong)


async def test_a_form_that_shows_something_else_is_found() -> None:
    async with operator("pocket") as at:
        assert list(monkey.form_troubles(at.app)) == []
        row = at.row("tool")
        row.cell = type(row.cell)("tool", "TOOL", "99", 0)
        assert any("TOOL shows '99'" in text for text in monkey.form_troubles(at.app))


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
