"""Hanging folders and files keep nobody waiting."""

from __future__ import annotations

import os
from collections.abc import Iterator
from threading import Event

import pytest

from app.documents.time_limits import Disk, within


@pytest.fixture
def never() -> Iterator[Event]:
    """An event that is set only after the test."""
    event = Event()
    yield event
    event.set()


def test_work_done_in_time_returns_or_raises_unchanged() -> None:
    assert within(5.0, lambda: 3) == 3
    with pytest.raises(FileNotFoundError):
        within(5.0, lambda: os.scandir("/nowhere/at/all"))


def test_disk_work_is_done_one_piece_after_the_other(never: Event) -> None:
    disk = Disk()
    with pytest.raises(TimeoutError, match="no answer"):
        disk.do(never.wait, 0.05)
    with pytest.raises(TimeoutError, match="no answer"):
        disk.do(lambda: 3, 0.05)
    never.set()
    assert disk.do(lambda: 4) == 4


def test_work_that_takes_too_long_times_out(never: Event) -> None:
    with pytest.raises(TimeoutError, match="no answer"):
        within(0.05, never.wait)
