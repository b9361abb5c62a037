"""KeyOrder hands on one key at a time: the next one goes when everything that the last one started is done.

Textual hands a key to the widget that has the cursor when the key is read.  If keys come together, pasted or held
back by a slow link, all would go to that one widget, although the first of them moves the cursor: a number would be
typed into the wrong field.
"""

from __future__ import annotations

from asyncio import Task, get_running_loop, sleep, wait
from collections import deque
from typing import Any, Final

from textual import events
from textual.app import App
from textual.message import Message
from textual.message_pump import MessagePump

CHECK_SECONDS: Final = 0.1
"""Seconds between two checks on the progress of a key."""
MAX_LOOKS: Final = 10
"""Checks without progress after which a key is given up: a removed widget never answers.  One check follows the other,
so that a program that was busy all the time does not count as one without progress."""
FEWEST_ROUNDS: Final = 2
"""One round after the key, one after the message of a binding that it has run."""


class KeyOrder:
    """Hands messages from the terminal to the App, keys and pasted text one at a time.

    A key causes messages: from the App to the widget with the cursor, from there through its ancestors to the screen
    and the App, which runs the bindings, and those send messages the same way.  A callback that follows them through
    the same queues comes back when all of them have been handled; this is repeated until nothing waits in any queue.
    """

    def __init__(self, app: App[Any]) -> None:
        self.app = app
        self.waiting: deque[Message] = deque()
        self._handing_on: Task[None] | None = None

    @property
    def busy(self) -> bool:
        """True until everything is done that the keys so far have started."""
        return self._handing_on is not None and not self._handing_on.done()

    def take(self, message: Message) -> None:
        """Take a message from the terminal; keys and pasted text wait for their turn, a mouse behind them too."""
        if isinstance(message, events.Key | events.Paste) or (self.busy and isinstance(message, events.MouseEvent)):
            self.waiting.append(message)
            if not self.busy:
                self._handing_on = get_running_loop().create_task(self._hand_on())
        else:
            self.app.post_message(message)

    async def _hand_on(self) -> None:
        while self.waiting:
            # taken before the key is sent: the key goes to the widget that has the cursor now
            path = self._focus_path()
            self.app.post_message(self.waiting.popleft())
            try:
                await self._follow([self.app, *path])
            except TimeoutError:
                # the next key may go all the same
                continue

    async def _follow(self, pumps: list[MessagePump]) -> None:
        """Follow a key from queue to queue; raise TimeoutError if one of them never answers."""
        front, rounds = pumps[-2:], FEWEST_ROUNDS
        # if no queue takes the callback, not even the App's, the program is ending
        while any([await self._passed(pump) for pump in pumps]):
            rounds -= 1
            pumps = self._focus_path()
            if rounds > 0 or any(pump.message_queue_size for pump in self._pumps()):
                continue
            # once more after the callbacks already scheduled
            await sleep(0)
            pumps = self._focus_path()
            if pumps[-2:] == front:
                return
            # another screen is in front, also by a worker: as many rounds again
            front, rounds = pumps[-2:], FEWEST_ROUNDS

    async def _passed(self, pump: MessagePump) -> bool:
        """Wait until a queue has handled all that it holds now; return False if it is closed."""
        passed = get_running_loop().create_future()
        if not pump.post_message(events.Callback(lambda: passed.set_result(None))):
            return False
        for _ in range(MAX_LOOKS):
            await wait([passed], timeout=CHECK_SECONDS)
            if passed.done():
                return True
        raise TimeoutError

    def _focus_path(self) -> list[MessagePump]:
        """Return the path from the widget with the cursor up to the App."""
        if not self.app.screen_stack:
            return [self.app]
        return [*(self.app.focused or self.app.screen).ancestors_with_self]

    def _pumps(self) -> list[MessagePump]:
        """Return the widgets on that path and all others of the screen: a key can have work for any of them."""
        return [*self._focus_path(), *(self.app.screen.walk_children() if self.app.screen_stack else ())]
