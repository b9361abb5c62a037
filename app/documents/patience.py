"""Files that may not answer: a folder of a network that is gone keeps whoever asks it waiting, for ever at worst."""

from __future__ import annotations

from collections.abc import Callable
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Final, TypeVar

FOLDER: Final = 2.0
"""Seconds that the start screen waits for a folder."""
FILE: Final = 5.0
"""Seconds that opening a file may take."""

Result = TypeVar("Result")


def within(seconds: float, work: Callable[[], Result]) -> Result:
    """What the work returns or raises; TimeoutError when it takes longer.

    It then goes on in a thread that nobody waits for any more, not at the end of the program either.
    """
    answers: SimpleQueue[tuple[Result | None, BaseException | None]] = SimpleQueue()

    def run() -> None:
        try:
            answers.put((work(), None))
        except Exception as error:  # noqa: BLE001  # raised again below, in the thread that asked
            answers.put((None, error))

    Thread(target=run, name="patience", daemon=True).start()
    try:
        result, error = answers.get(timeout=seconds)
    except Empty:
        raise TimeoutError("no answer, as from a network folder that is gone") from None
    if error is not None:
        raise error
    return result  # type: ignore[return-value]  # None only where the work itself returns it
