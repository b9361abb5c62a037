"""BrowserDriver is Textual's driver for a browser page, with keys in order and a limit on waiting messages."""

from __future__ import annotations

import os
from functools import partial
from typing import Any, Final

from textual.app import App
from textual.drivers.web_driver import WebDriver
from textual.message import Message

from app.terminal.key_order import KeyOrder

LARGEST_QUEUE: Final = 1000
"""The most messages from the page that wait here; further ones wait in the pipe, and then in the page."""
CHECK_SECONDS: Final = 0.01
"""Seconds between two checks for room."""


class BrowserDriver(WebDriver):
    """The driver of screens that `cutcomp serve` has started."""

    def __init__(
        self, app: App[Any], *, debug: bool = False, mouse: bool = True, size: tuple[int, int] | None = None
    ) -> None:
        super().__init__(app, debug=debug, mouse=mouse, size=size)
        self.keys = KeyOrder(app)
        self._sent = 0
        """Messages passed on by the reader thread; only that thread counts here."""
        self._taken = 0
        """Messages taken in the event loop; only the loop counts here."""
        self._write = partial(self._write_all)

    def send_message(self, message: Message) -> None:
        """Pass a message from the page to the App in its turn; runs in the reader thread and waits for room."""
        while self._sent - self._taken + len(self.keys.waiting) >= LARGEST_QUEUE:
            if self.exit_event.wait(CHECK_SECONDS):
                return
        self._sent += 1
        self._loop.call_soon_threadsafe(self._take, message)

    def _take(self, message: Message) -> None:
        self._taken += 1
        self.keys.take(message)

    def _write_all(self, data: bytes) -> int:
        """Write all data; ignore that the page is gone, since the server then ends the program."""
        rest = memoryview(data)
        try:
            while rest:
                rest = rest[os.write(self.fileno, rest) :]
        except BrokenPipeError:
            pass
        return len(data)
