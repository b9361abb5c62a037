"""Folders and files that do not answer keep nobody waiting."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from app.documents import patience
from app.documents.patience import within
from app.painted import starting, survey
from app.painted.screens.start import StartPage
from app.painted.settings import Settings
from tests.app.operator import Operator


@pytest.fixture
def never() -> Iterator[Event]:
    """An event that comes when the test is over."""
    event = Event()
    yield event
    event.set()


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(starting, "FOLDER", 0.05)
    monkeypatch.setattr(survey, "FILE", 0.05)


def test_work_in_time_returns_and_raises_as_it_is() -> None:
    assert within(5.0, lambda: 3) == 3
    with pytest.raises(FileNotFoundError):
        within(5.0, lambda: os.scandir("/nowhere/at/all"))


def test_work_that_takes_too_long_is_given_up(never: Event) -> None:
    with pytest.raises(TimeoutError, match="no answer"):
        within(0.05, never.wait)


def test_a_dead_folder_is_told_and_the_rest_of_the_start_screen_stands(
    tmp_path: Path, never: Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    scandir = os.scandir

    def dead(folder: Any) -> Any:
        if Path(folder) == tmp_path:
            never.wait()
        return scandir(folder)

    monkeypatch.setattr(os, "scandir", dead)
    operator = Operator.at()
    operator.desk = starting.begun(operator.desk)
    page = operator.desk.page
    assert isinstance(page, StartPage)
    assert "cannot be shown: no answer" in operator.said
    assert [entry.name for entry in page.entries if entry.name == "pocket"] == ["pocket"]
    monkeypatch.setattr(os, "scandir", scandir)
    operator.press("f5")
    assert "cannot be shown" not in operator.said


def test_the_last_folder_may_be_dead(tmp_path: Path, never: Event, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    is_dir = Path.is_dir
    monkeypatch.setattr(Path, "is_dir", lambda path: never.wait() if path == Path("/dead") else is_dir(path))
    operator = Operator.at()
    operator.desk = starting.begun(operator.desk.__class__(operator.session, settings=Settings(folder="/dead")))
    assert "no answer" in operator.said


def test_a_dead_file_of_the_list_is_told_and_does_not_hold_up_the_others(
    tmp_path: Path, never: Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    stat = Path.stat
    monkeypatch.setattr(Path, "stat", lambda path, **how: never.wait() if path.name == "a.toml" else stat(path, **how))
    facts = survey.facts_of(tmp_path / "a.toml")
    assert (facts.word, facts.trouble[:16]) == ("no answer", "a.toml: no answe")
    assert survey.facts_of(tmp_path / "b.toml").word == "gone"
    assert patience.FILE > 1.0
