"""The driver for a page in a browser."""

from __future__ import annotations

import os
import sys
from threading import Thread
from time import sleep
from typing import Any

import pytest
from textual import events
from textual.app import App

from app.terminal.browser import LARGEST_QUEUE, BrowserDriver


async def test_keys_wait_in_the_page_while_the_program_is_busy(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    with os.fdopen(reading) as keys, os.fdopen(writing, "w"):
        monkeypatch.setattr(sys, "__stdin__", keys)
        app: App[Any] = App()
        driver, sent = BrowserDriver(app, size=(80, 24)), []

        def type_ahead() -> None:
            for _ in range(3 * LARGEST_QUEUE):
                driver.send_message(events.Key("a", "a"))
                sent.append("a")

        typist = Thread(target=type_ahead)
        typist.start()
        # sleep, not await: the event loop must take nothing meanwhile
        for _ in range(100):
            sleep(0.01)
            if len(sent) >= LARGEST_QUEUE:
                break
        sleep(0.05)
        held = len(sent)
        driver.exit_event.set()
        typist.join(10)
    assert held == LARGEST_QUEUE


async def test_output_for_a_closed_page_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as page, os.fdopen(os.pipe()[0]) as keys:
        monkeypatch.setattr(sys, "__stdin__", keys)
        monkeypatch.setattr(sys, "__stdout__", page)
        BrowserDriver(App(), size=(80, 24)).write("gone")
