"""This module limits the wait for files: a folder on a lost network may take forever to answer."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, wait
from threading import Lock, Thread
from typing import Any, Final, TypeVar

FOLDER_SECONDS: Final = 2.0
"""The seconds that the start screen waits for a folder."""
FILE_SECONDS: Final = 5.0
"""The seconds that opening a file may take."""
DISK_SECONDS: Final = 0.5
"""The seconds that a keystroke waits for the disk before it goes on without it."""
EXIT_SECONDS: Final = 2.0
"""The seconds that the program waits for the disk when it ends."""

Result = TypeVar("Result")


class Disk:
    """Does disk work in a thread, one piece after another, so that there are never two writers.

    The thread ends when no work is left; the program does not wait for it at its own end.
    """

    def __init__(self) -> None:
        self._waiting = deque[tuple[Future[Any], Callable[[], Any]]]()
        self._lock = Lock()

    def do(self, work: Callable[[], Result]) -> Future[Result]:
        """Queue work behind all that is waiting, and return its future."""
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
            except Exception as raised:  # noqa: BLE001  # raised again where the result is used
                error = raised
            with self._lock:
                self._waiting.popleft()
                more = bool(self._waiting)
            if error is None:
                future.set_result(result)
            else:
                future.set_exception(error)

    def finish(self, work: Callable[[], object]) -> None:
        """Do the last work behind all that is waiting; wait no longer than `EXIT_SECONDS` for it."""
        wait([self.do(work)], EXIT_SECONDS)


def within(seconds: float, work: Callable[[], Result]) -> Result:
    """Return or raise what the work does; raise TimeoutError if it takes longer.

    After a timeout it goes on in a thread, and its result is dropped.
    """
    future = Disk().do(work)
    if not wait([future], seconds).done:
        raise TimeoutError("no answer, as from a network folder that is gone")
    return future.result()
