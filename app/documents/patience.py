"""Files that may not answer: a folder of a network that is gone keeps whoever asks it waiting, for ever at worst."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, wait
from threading import Lock, Thread
from typing import Any, Final, TypeVar

FOLDER: Final = 2.0
"""Seconds that the start screen waits for a folder."""
FILE: Final = 5.0
"""Seconds that opening a file may take."""
DISK: Final = 0.5
"""Seconds that the keys wait for the disk; then they go on without it."""
LAST: Final = 2.0
"""Seconds that the end of the program waits for the disk."""

Result = TypeVar("Result")


class Disk:
    """Does work on the disk in a thread, one piece after the other: there are never two writers.

    The thread ends when nothing is left to do; nobody waits for it at the end of the program.
    """

    def __init__(self) -> None:
        self._waiting = deque[tuple[Future[Any], Callable[[], Any]]]()
        self._lock = Lock()

    def do(self, work: Callable[[], Result]) -> Future[Result]:
        """Have work done after all that waits already."""
        future = Future[Result]()
        future.set_running_or_notify_cancel()
        with self._lock:
            self._waiting.append((future, work))
            idle = len(self._waiting) == 1
        if idle:
            Thread(target=self._run, name="disk", daemon=True).start()
        return future

    def _run(self) -> None:
        more = True
        while more:
            future, work = self._waiting[0]
            result, error = None, None
            try:
                result = work()
            except Exception as raised:  # noqa: BLE001  # raised again where the result is asked for
                error = raised
            with self._lock:
                self._waiting.popleft()
                more = bool(self._waiting)
            if error is None:
                future.set_result(result)
            else:
                future.set_exception(error)

    def finish(self, work: Callable[[], object]) -> None:
        """Do the last work behind all that waits; a folder that does not answer does not hold up the end."""
        wait([self.do(work)], LAST)


def within(seconds: float, work: Callable[[], Result]) -> Result:
    """What the work returns or raises; TimeoutError when it takes longer.

    It then goes on in a thread that nobody waits for any more.
    """
    future = Disk().do(work)
    if not wait([future], seconds).done:
        raise TimeoutError("no answer, as from a network folder that is gone")
    return future.result()
