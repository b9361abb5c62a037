"""This module reads drawing files in a separate process with progress, cancel and a time limit; the screen stays alive.

A file may be damaged in any way, and a small one may expand to a million shapes.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable
from contextlib import redirect_stderr, suppress
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection
from multiprocessing.resource_tracker import ensure_running
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from typing import Final, Generic, TypeVar, cast

from app.documents.files import TooLargeError, read_file, why
from core.importing.contours import ContourList, ImportOptions, contours_of
from core.importing.drawing import MAX_BYTES, Drawing, DrawingError, StageProgress
from core.importing.dxf import read_dxf
from core.program.file.read import StoreError
from core.units import Unit

Result = TypeVar("Result")

TIME_LIMIT: Final = 60.0
"""The most seconds that reading a drawing may take."""

PROGRESS_PAUSE: Final = 0.1
"""The least seconds between two progress messages."""

EXIT_WAIT: Final = 2.0
"""The most seconds that a worker may take to end after its pipe is closed."""


@dataclass(frozen=True, slots=True)
class Progress:
    """What a worker is doing, and how much of the whole is done."""

    stage: str
    done: int
    whole: int


def prepare_workers() -> None:
    """Start the resource tracker, in the main thread and with the real stderr, since Textual's has no descriptor."""
    with redirect_stderr(sys.__stderr__):
        ensure_running()


class Worker(Generic[Result]):
    """A function that runs in its own process, with picklable arguments and a `progress` callback.

    `poll` returns its progress or its result, and ends it after `limit` seconds; `cancel` ends it at once.
    """

    def __init__(self, function: Callable[..., Result], *arguments: object, limit: float = TIME_LIMIT) -> None:
        context = get_context("spawn")
        self._receiver, sender = context.Pipe(duplex=False)
        self._cache = TemporaryDirectory(prefix="cutcomp-")
        work = (sender, self._cache.name, function, arguments)
        self._process = context.Process(target=_work, args=work, daemon=True)
        self._limit, self._deadline = limit, time.monotonic() + limit
        self._process.start()
        sender.close()

    def poll(self, wait: float = 0.0) -> Progress | Result | None:
        """Return progress or the result; None if neither comes within `wait` seconds.

        Raise DrawingError if the function raised it, the time limit has passed, or the process has died.
        """
        try:
            arrived = self._receiver.poll(min(wait, max(self._deadline - time.monotonic(), 0.0)))
            message = self._receiver.recv() if arrived else None
        except (EOFError, OSError) as error:
            # a process that has closed its pipe ends by itself, with its own exit code
            self._process.join(EXIT_WAIT)
            killed = (self._process.exitcode or 0) < 0
            self.cancel()
            if killed:
                raise DrawingError("TOO_MUCH", "Reading the drawing was ended, perhaps for want of memory.") from error
            raise DrawingError("FAILED", "Reading the drawing failed: cutcomp has an error. Report it.") from error
        if not arrived and time.monotonic() >= self._deadline:
            message = DrawingError("TOO_MUCH", f"Reading the drawing takes longer than {self._limit:g} s.")
        if message is not None and not isinstance(message, Progress):
            self.cancel()
        if isinstance(message, DrawingError):
            raise message
        return cast("Progress | Result | None", message)

    def cancel(self) -> None:
        """End the process, whatever it is doing."""
        if self._process.is_alive():
            self._process.kill()
        self._process.join()
        self._receiver.close()
        self._cache.cleanup()

    def result(self) -> Result:
        """Wait for the result and return it."""
        try:
            while (message := self.poll(1.0)) is None or isinstance(message, Progress):
                pass
        except BaseException:
            self.cancel()
            raise
        return message


def read_and_list(
    data: bytes, name: str, program: Unit | None, *, damaged: bool = False, progress: StageProgress
) -> Drawing | ContourList:
    """Return a drawing's contours with the usual options for a program's unit, None for the drawing's unit.

    Return the drawing alone if the operator must first be asked for its unit or for the layers to take.
    """
    drawing = read_dxf(data, name, damaged=damaged, progress=progress)
    if drawing.unit is None or drawing.not_flat:
        return drawing
    return contours_of(drawing, ImportOptions.usual(drawing.unit, program), progress)


def _work(sender: Connection, cache: str, function: Callable[..., object], arguments: tuple[object, ...]) -> None:
    """Run the function in the worker process and send its result or error through the pipe."""
    # only the waiting process handles Ctrl+C
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()
    _spare_fonts(Path(cache))
    sent = 0.0

    def progress(stage: str, done: int, whole: int) -> None:
        nonlocal sent
        now = time.monotonic()
        if now - sent >= PROGRESS_PAUSE:
            sent = now
            sender.send(Progress(stage, done, whole))

    try:
        message: object = function(*arguments, progress=progress)
    except DrawingError as error:
        message = error
    except RecursionError:
        message = DrawingError("TOO_MUCH", "The drawing is nested too deep.")
    except MemoryError:
        message = DrawingError("TOO_MUCH", "The drawing needs more memory than there is.")
    with suppress(BrokenPipeError):
        sender.send(message)


def _end_with_parent() -> None:
    """End the worker process at once when the program that waits for it is gone, for whatever reason."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _spare_fonts(cache: Path) -> None:
    """Give ezdxf an empty font list: at its first import it would read every font and cache a list in the home folder.

    No contour needs a font, and a system may have thousands.
    """
    fonts = cache / "ezdxf" / "font_manager_cache.json"
    fonts.parent.mkdir()
    fonts.write_text('{"version": 2, "font-faces": []}', encoding="ascii")
    os.environ["XDG_CACHE_HOME"] = str(cache)


def drawing_bytes(path: Path) -> bytes:
    """Return a drawing file's content; raise StoreError if it is unreadable, DrawingError TOO_MUCH if too large."""
    try:
        return read_file(path, MAX_BYTES)[0]
    except TooLargeError as error:
        raise DrawingError("TOO_MUCH", f"{path.name} is too large: at most {MAX_BYTES:,} bytes are read.") from error
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
