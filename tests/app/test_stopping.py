"""The screens survive a stop and a continue at any moment."""

from __future__ import annotations

import os
from collections.abc import Callable

import pytest

from app.terminal.driver import TerminalDriver


class Loop:
    """An event loop that only records the callbacks for later."""

    def __init__(self) -> None:
        self.later: list[Callable[[], None]] = []

    def call_soon_threadsafe(self, work: Callable[[], None]) -> None:
        self.later.append(work)


def test_a_stop_signal_during_a_write_takes_effect_after_it(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    monkeypatch.setattr(os, "kill", lambda *_: done.append("stop"))
    monkeypatch.setattr(TerminalDriver, "suspend_application_mode", lambda _: done.append("suspend"))
    monkeypatch.setattr(TerminalDriver, "resume_application_mode", lambda _: done.append("resume"))
    driver = object.__new__(TerminalDriver)
    loop = Loop()
    driver._loop, driver._auto_restart = loop, True  # type: ignore[assignment]  # as much of a loop as is needed
    driver._sigtstp_application()
    driver._sigcont_application()
    assert done == []
    for work in loop.later:
        work()
    assert done == ["suspend", "stop", "resume"]
