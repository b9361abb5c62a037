"""KeyOrder hands on one key at a time: the next one goes when everything that the last one started is done.

Textual hands a key to the widget that has the cursor when the key is read.  If keys come together, pasted or held
back by a slow link, all would go to that one widget, although the first of them moves the cursor: a number would be
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

CHECK_SECONDS: Final = 0.1
"""Seconds between two checks on the progress of a key."""
MAX_LOOKS: Final = 10
"""Checks in a row without progress after which a key is given up: a removed widget never answers.  One check schedules
the next, so that a program that was busy all the time does not count as one without progress."""
FEWEST_ROUNDS: Final = 2
"""One round after the key, one after the message of a binding that it has run."""


class KeyOrder:
    """Hands messages from the terminal to the App, keys and pasted text one at a time.

    A key causes messages: from the App to the widget with the cursor, from there through its ancestors to the screen
    and the App, which runs the bindings, and those send messages the same way.  A callback that follows them through
    the same queues comes back when all of them have been handled; it repeats this until nothing waits in any queue.
    """

    def __init__(self, app: App[Any]) -> None:
        self.app = app
        self.waiting: deque[Message] = deque()
        self.current_walk: _Walk | None = None
        """The walk that follows the key handed on last; None if there is none."""
        self._patience: TimerHandle | None = None

    def take(self, message: Message) -> None:
        """Take a message from the terminal; keys and pasted text wait for their turn."""
        if not isinstance(message, events.Key | events.Paste):
            self.app.post_message(message)
            return
        self.waiting.append(message)
        if self.current_walk is None:
            self.send_next()

    def send_next(self) -> None:
        """Hand on the next key, if one is waiting."""
        if self._patience is not None:
            self._patience.cancel()
        if not self.waiting:
            self.current_walk = None
            return
        # made before the key is sent: the key goes to the widget that has the cursor now
        self.current_walk = walk = _Walk(self)
        self.app.post_message(self.waiting.popleft())
        self._look(walk, -1, 0)
        walk.go()

    def _look(self, walk: _Walk, steps: int, still: int) -> None:
        """Give up a walk without progress for too long; `steps` is its count at the last check."""
        still = still + 1 if walk.steps == steps else 0
        if still == MAX_LOOKS:
            self.send_next()
        else:
            self._patience = get_running_loop().call_later(CHECK_SECONDS, self._look, walk, walk.steps, still)

    def focus_path(self) -> list[MessagePump]:
        """Return the path from the widget with the cursor up to the App."""
        if not self.app.screen_stack:
            return [self.app]
        return [*(self.app.focused or self.app.screen).ancestors_with_self]

    def pumps(self) -> list[MessagePump]:
        """Return the widgets on that path and all others of the screen: a key can have work for any of them."""
        return [*self.focus_path(), *(self.app.screen.walk_children() if self.app.screen_stack else ())]


class _Walk:
    """The callback that follows one key from queue to queue."""

    def __init__(self, order: KeyOrder) -> None:
        self.order = order
        self.steps = 0
        self._rounds = FEWEST_ROUNDS
        self._taken = False
        """True if any queue has taken the callback in this round."""
        focus_path = order.focus_path()
        self._screen, self._rest = focus_path[-2:], [order.app, *focus_path]

    def go(self) -> None:
        """Go to the end of the next queue on the path; skip closed ones."""
        if self.order.current_walk is not self:
            return
        self.steps += 1
        while self._rest:
            if self._rest.pop(0).post_message(events.Callback(self.go)):
                self._taken = True
                return
        # if no queue takes the callback, not even the App's, the program is ending
        if self._taken:
            self._taken = False
            self._next_round()

    def _next_round(self) -> None:
        """Go around again while messages wait; else check once more after the callbacks already scheduled."""
        self._rounds -= 1
        if self._rounds > 0 or any(pump.message_queue_size for pump in self.order.pumps()):
            self._rest = self.order.focus_path()
            self.go()
        else:
            get_running_loop().call_soon(self._end)

    def _end(self) -> None:
        """Send the next key; if another screen is in front, also by a worker, go around as often again."""
        if self.order.current_walk is not self:
            return
        focus_path = self.order.focus_path()
        if focus_path[-2:] == self._screen:
            self.order.send_next()
        else:
            self._screen, self._rest, self._rounds = focus_path[-2:], focus_path, FEWEST_ROUNDS
            self.go()
