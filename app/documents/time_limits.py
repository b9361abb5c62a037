"""This module limits the time of work on files: a folder on a lost network may take forever to answer."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, wait
from threading import Lock, Thread
from typing import Final, TypeVar

FOLDER_SECONDS: Final = 2.0
"""The seconds that the start screen waits for a folder."""
FILE_SECONDS: Final = 5.0
"""The seconds that opening a file may take."""
EXIT_SECONDS: Final = 2.0
"""The seconds that the program waits for the disk when it ends."""

Result = TypeVar("Result")


class Disk:
    """Does disk work, one piece at a time, so that there are never two writers."""

    def __init__(self) -> None:
        self._lock = Lock()

    def do(self, work: Callable[[], Result], seconds: float | None = None) -> Result:
        """Return or raise what the work does; raise TimeoutError if it takes longer than `seconds`, None for no limit.

        The caller waits, but a signal still reaches it: a thread does the work.
        """

        def alone() -> Result:
            with self._lock:
                return work()

        return within(seconds, alone)


def within(seconds: float | None, work: Callable[[], Result]) -> Result:
    """Return or raise what the work does; raise TimeoutError if it takes longer.

    After a timeout it goes on in a thread, and its result is dropped.
    """
    future = Future[Result]()

    def run() -> None:
        try:
            future.set_result(work())
        except Exception as error:  # noqa: BLE001  # raised again below
            future.set_exception(error)

    Thread(target=run, name="disk", daemon=True).start()
    if not wait([future], seconds).done:
        raise TimeoutError("no answer, as from a network folder that is gone")
    return future.result()
