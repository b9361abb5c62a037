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

LOOK: Final = 0.1
"""Seconds between two looks whether a key is still making its way."""
MAX_LOOKS: Final = 10
"""So many looks in a row that see it stand still give it up: a widget that was removed answers nothing.  They are
counted one after the other, so that a program that was busy all the time is not taken for one that stands still."""
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
        self.on_its_way: _Walk | None = None
        """What goes round behind the key that was handed on last."""
        self._patience: TimerHandle | None = None

    def take(self, message: Message) -> None:
        """A message from the terminal."""
        if not isinstance(message, events.Key | events.Paste):
            self.app.post_message(message)
            return
        self.waiting.append(message)
        if self.on_its_way is None:
            self.send_next()

    def send_next(self) -> None:
        """Hand the next key on, if one waits."""
        if self._patience is not None:
            self._patience.cancel()
        if not self.waiting:
            self.on_its_way = None
            return
        # made before the key is sent: that goes to the widget that has the cursor now
        self.on_its_way = walk = _Walk(self)
        self.app.post_message(self.waiting.popleft())
        self._look(walk, -1, 0)
        walk.go()

    def _look(self, walk: _Walk, steps: int, still: int) -> None:
        """Give a walk up that has stood still for too long; `steps` are those of the last look."""
        still = still + 1 if walk.steps == steps else 0
        if still == MAX_LOOKS:
            self.send_next()
        else:
            self._patience = get_running_loop().call_later(LOOK, self._look, walk, walk.steps, still)

    def way(self) -> list[MessagePump]:
        """From the widget with the cursor up to the App."""
        if not self.app.screen_stack:
            return [self.app]
        return [*(self.app.focused or self.app.screen).ancestors_with_self]


class _Walk:
    """The callback that goes round behind one key."""

    def __init__(self, order: KeyOrder) -> None:
        self.order = order
        self.steps = 0
        self._rounds = FEWEST_ROUNDS
        self._taken = False
        """Whether somebody on the way has taken the callback in this round."""
        way = order.way()
        self._screen, self._rest = way[-2:], [order.app, *way]

    def go(self) -> None:
        """On to the next on the way, behind what waits there; one that is closed is passed over."""
        if self.order.on_its_way is not self:
            return
        self.steps += 1
        while self._rest:
            if self._rest.pop(0).post_message(events.Callback(self.go)):
                self._taken = True
                return
        # where nobody takes anything, not even the App, the program is leaving
        if self._taken:
            self._taken = False
            self._next_round()

    def _next_round(self) -> None:
        """Once more while there is something to wait for; else look a last time when all that was begun has run."""
        self._rounds -= 1
        if self._rounds > 0 or any(pump.message_queue_size for pump in self.order.way()):
            self._rest = self.order.way()
            self.go()
        else:
            get_running_loop().call_soon(self._end)

    def _end(self) -> None:
        """The next key; on another screen, which a worker too may have brought, go round as often again."""
        if self.order.on_its_way is not self:
            return
        way = self.order.way()
        if way[-2:] == self._screen:
            self.order.send_next()
        else:
            self._screen, self._rest, self._rounds = way[-2:], way, FEWEST_ROUNDS
            self.go()
