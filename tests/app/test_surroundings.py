"""What the status line takes from outside the program."""

from __future__ import annotations

from itertools import count
from pathlib import Path
from time import strftime

import pytest

from app.painted import surroundings
from app.painted.surroundings import Surroundings, free_memory, time_of_day
from tests.app.pilots import app_on, loaded

TOLD = "MemTotal:       24684084 kB\nMemFree:        21775096 kB\nMemAvailable:   23715944 kB\nBuffers: 74704 kB\n"


@pytest.mark.parametrize(
    ("text", "free"),
    [(TOLD + "Cached: 1 kB\n" * 100, 23715944), ("MemTotal: 1 kB\n", 0), ("MemAvailable: much kB\n", 0), ("", 0)],
)
def test_free_memory_is_what_the_kernel_calls_available(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, free: int
) -> None:
    (tmp_path / "meminfo").write_text(text)
    monkeypatch.setattr(surroundings, "MEMORY", tmp_path / "meminfo")
    assert free_memory() == free


def test_no_free_memory_is_told_where_the_kernel_does_not_say(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surroundings, "MEMORY", tmp_path / "nothing")
    assert free_memory() == 0


def test_the_clock_has_hours_and_minutes() -> None:
    before = strftime("%H:%M")
    assert time_of_day() in (before, strftime("%H:%M"))


async def test_keys_ask_for_the_surroundings_once_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    asked, now = count(), [100.0]
    monkeypatch.setattr("app.painted.application.perf_counter", lambda: now[0])
    app = app_on("pocket")
    app.around = Surroundings(lambda: "12:00", lambda: next(asked))
    async with app.run_test(size=(80, 24)) as pilot:
        await loaded(pilot)
        await pilot.press("tab", "tab", "tab")
        first = next(asked)
        now[0] += 1.0
        await pilot.press("tab", "tab")
        assert first == 1
        assert next(asked) == 3
        assert app.then.free() == 2
