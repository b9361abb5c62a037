"""Keys one after the other: the next one is handed on when all that the last one has set going is done.

Textual hands a key to the widget that has the cursor when the key is read.  Of keys that come together, pasted or held
back by a slow link, all would go to that one widget, though the first of them moves the cursor on: a number would be
typed into the wrong field.
"""

from __future__ import annotations

from asyncio import TimerHandle, get_running_loop
from collections import deque
from typing import Any, Final

from textual import events
from textual.app import App
from textual.message import Message
from textual.message_pump import MessagePump

LONGEST_WAIT: Final = 1.0
"""Seconds after which the next key is handed on all the same: a widget that was removed answers nothing."""
LOOKS: Final = 10
"""In so many pieces it is waited.  Pieces in which the program was late do not count: the key is still on its way."""
LONGEST_LATE: Final = 10.0
"""Seconds after which the next key is handed on in any case."""
FEWEST_ROUNDS: Final = 2
"""One behind the key, one behind the message of a binding that it has run."""


class KeyOrder:
    """Hands messages from the terminal to the App, keys and pasted text one at a time.

    What a key sets going are messages: from the App to the widget with the cursor, from there through its ancestors to
    the screen and the App, which runs the bindings, and those send messages the same way.  A callback that goes round
    behind them comes back when all of them have been handled; it goes on until nothing waits anywhere on its way.
    """

    def __init__(self, app: App[Any]) -> None:
        self.app = app
        self.waiting: deque[Message] = deque()
        self.on_its_way = 0
        """The number of the key on its way, 0 for none."""
        self._count = 0
        self._patience: TimerHandle | None = None

    def take(self, message: Message) -> None:
        """A message from the terminal."""
        if not isinstance(message, events.Key | events.Paste):
            self.app.post_message(message)
            return
        self.waiting.append(message)
        if not self.on_its_way:
            self._send()

    def _send(self) -> None:
        if self._patience is not None:
            self._patience.cancel()
            self._patience = None
        if not self.waiting:
            self.on_its_way = 0
            return
        self._count += 1
        self.on_its_way = self._count
        # taken before the key: it goes to the widget that has the cursor now
        way = self._way()
        self.app.post_message(self.waiting.popleft())
        self._wait(LOOKS, get_running_loop().time() + LONGEST_LATE)
        self._go(self._count, [self.app, *way], FEWEST_ROUNDS)

    def _wait(self, looks: int, end: float) -> None:
        """Hand the next key on after so many more looks that come in time."""
        loop, piece = get_running_loop(), LONGEST_WAIT / LOOKS
        due = loop.time() + piece

        def look() -> None:
            late = loop.time() > due + piece / 2
            if loop.time() > end or (looks == 1 and not late):
                self._send()
            else:
                self._wait(looks if late else looks - 1, end)

        self._patience = loop.call_later(piece, look)

    def _way(self) -> list[MessagePump]:
        """From the widget with the cursor up to the App."""
        if not self.app.screen_stack:
            return [self.app]
        return [*(self.app.focused or self.app.screen).ancestors_with_self]

    def _go(self, number: int, way: list[MessagePump], rounds: int) -> None:
        """On to the next on the way, behind what waits there; one that is closed is passed over."""
        if number != self.on_its_way:
            return
        while way:
            pump, *way = way
            if pump.call_later(self._go, number, way, rounds):
                return
        way = self._way()
        if rounds > 1 or any(pump.message_queue_size for pump in way):
            self._go(number, way, rounds - 1)
        else:
            self._send()
