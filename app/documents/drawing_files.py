"""Drawing files: read in a process of their own, with a time limit, progress and cancel; the screen stays alive.

A file may be damaged in any way, and a small one may ask for a million shapes.
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
from core.importing.contours import Progress as ReportProgress
from core.importing.drawing import MAX_BYTES, Drawing, DrawingError
from core.importing.dxf import read_dxf
from core.program.file.read import StoreError
from core.units import Unit

Result = TypeVar("Result")

TIME_LIMIT: Final = 60.0
"""Seconds that a drawing may take."""

PROGRESS_PAUSE: Final = 0.1
"""Seconds between two messages of progress."""


@dataclass(frozen=True, slots=True)
class Progress:
    """What a worker is doing, and how much of it is done."""

    stage: str
    done: int
    whole: int


def prepare_workers() -> None:
    """Start what watches over processes, in the main thread: what stands in for stderr under Textual has no number."""
    with redirect_stderr(sys.__stderr__):
        ensure_running()


class Worker(Generic[Result]):
    """A function run in a process of its own; it takes the arguments and `progress`, both can be pickled.

    `poll` tells how far it is; `cancel` ends it at once.  After `limit` seconds it is ended.
    """

    def __init__(self, function: Callable[..., Result], *arguments: object, limit: float = TIME_LIMIT) -> None:
        context = get_context("spawn")
        self._here, there = context.Pipe(duplex=False)
        self._cache = TemporaryDirectory(prefix="cutcomp-")
        work = (there, self._cache.name, function, arguments)
        self._process = context.Process(target=_work, args=work, daemon=True)
        self._limit, self._deadline = limit, time.monotonic() + limit
        self._process.start()
        there.close()

    def poll(self, wait: float = 0.0) -> Progress | Result | None:
        """How far it is, or the result; None if neither comes within `wait` seconds.

        Raises DrawingError: what the function raised, or that the limit is passed or the process has died.
        """
        try:
            if self._here.poll(min(wait, max(self._deadline - time.monotonic(), 0.0))):
                return self._received(self._here.recv())
        except (EOFError, OSError) as error:
            self.cancel()
            raise DrawingError("TOO_MUCH", "Reading the drawing was ended, perhaps for want of memory.") from error
        if time.monotonic() >= self._deadline:
            self.cancel()
            raise DrawingError("TOO_MUCH", f"Reading the drawing takes longer than {self._limit:g} s.")
        return None

    def _received(self, message: object) -> Progress | Result:
        if isinstance(message, Progress):
            return message
        self.cancel()
        if isinstance(message, DrawingError):
            raise message
        return cast("Result", message)

    def cancel(self) -> None:
        """End the process, whatever it does."""
        if self._process.is_alive():
            self._process.kill()
        self._process.join()
        self._here.close()
        self._cache.cleanup()

    def result(self) -> Result:
        """Wait for the result."""
        try:
            while (message := self.poll(1.0)) is None or isinstance(message, Progress):
                pass
        except BaseException:
            self.cancel()
            raise
        return message


def read_and_list(
    data: bytes, name: str, program: Unit | None, *, damaged: bool = False, progress: ReportProgress
) -> Drawing | ContourList:
    """A drawing's contours with the usual options of a program's unit, None for that of the drawing.

    The drawing alone where something is to be asked first: its unit, or the layers to take.
    """
    drawing = read_dxf(data, name, damaged=damaged, progress=progress)
    if drawing.unit is None or drawing.not_flat:
        return drawing
    return contours_of(drawing, ImportOptions.usual(drawing.unit, program), progress)


def _work(there: Connection, cache: str, function: Callable[..., object], arguments: tuple[object, ...]) -> None:
    """In the process: the result or the error goes through the pipe."""
    # Ctrl+C is for the process that waits
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()
    _spare_fonts(Path(cache))
    sent = 0.0

    def progress(stage: str, done: int, whole: int) -> None:
        nonlocal sent
        now = time.monotonic()
        if now - sent >= PROGRESS_PAUSE:
            sent = now
            there.send(Progress(stage, done, whole))

    try:
        message: object = function(*arguments, progress=progress)
    except DrawingError as error:
        message = error
    except RecursionError:
        message = DrawingError("TOO_MUCH", "The drawing is nested too deep.")
    except MemoryError:
        message = DrawingError("TOO_MUCH", "The drawing needs more memory than there is.")
    with suppress(BrokenPipeError):
        there.send(message)


def _end_with_parent() -> None:
    """In the process: end at once when the program that waits for it is gone, however it went."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _spare_fonts(cache: Path) -> None:
    """Have ezdxf find an empty list of fonts: at its first import it would read every font and keep a list at home.

    No contour needs a font, and a system may have thousands.
    """
    fonts = cache / "ezdxf" / "font_manager_cache.json"
    fonts.parent.mkdir()
    fonts.write_text('{"version": 2, "font-faces": []}', encoding="ascii")
    os.environ["XDG_CACHE_HOME"] = str(cache)


def drawing_bytes(path: Path) -> bytes:
    """What a drawing file holds; StoreError where it cannot be read, DrawingError TOO_MUCH where it is too large."""
    try:
        return read_file(path, MAX_BYTES)[0]
    except TooLargeError as error:
        raise DrawingError("TOO_MUCH", f"{path.name} is too large: at most {MAX_BYTES:,} bytes are read.") from error
    except (OSError, ValueError) as error:
        raise StoreError(f"{path} cannot be read: {why(error)}") from error
