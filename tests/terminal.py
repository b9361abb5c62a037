"""A program in a real pseudo-terminal, its screen read through a terminal emulator."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import select
import signal
import struct
import sys
import tempfile
import termios
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import pyte

PASSED_ON = ("PATH", "HOME", "LD_LIBRARY_PATH", "PYTHONPATH", "VIRTUAL_ENV")


def cutcomp(*arguments: str) -> list[str]:
    """The command that starts the screens with these arguments."""
    return [sys.executable, "-m", "app", *arguments]


@dataclass
class Answer:
    """What came back after a key: how many bytes, and how long the first and the last of them took (seconds)."""

    count: int
    first: float
    last: float


@dataclass
class Terminal:
    """One running program: `pid`, its pseudo-terminal `fd`, the emulator's screen, and all bytes `seen`."""

    pid: int
    fd: int
    screen: pyte.Screen
    stream: pyte.ByteStream = field(init=False)
    seen: bytearray = field(default_factory=bytearray)

    def __post_init__(self) -> None:
        self.stream = pyte.ByteStream(self.screen)

    def read(self, *, quiet: float, longest: float = 10.0) -> Answer:
        """Feed the emulator until nothing has come for `quiet` seconds."""
        begun = time.perf_counter()
        count, first, last = 0, 0.0, 0.0
        while time.perf_counter() - begun < longest:
            ready, _, _ = select.select([self.fd], [], [], quiet)
            if not ready:
                break
            try:
                data = os.read(self.fd, 65536)
            except OSError:
                break
            if not data:
                break
            last = time.perf_counter() - begun
            first = first or last
            count += len(data)
            self.seen += data
            self.stream.feed(data)
        return Answer(count, first, last)

    def until(self, *texts: str, longest: float = 60.0) -> float:
        """Seconds until one of `texts` stands on the screen; AssertionError with the screen if none ever does."""
        begun = time.perf_counter()
        shown = self.text
        while not any(text in shown for text in texts):
            if time.perf_counter() - begun > longest:
                raise AssertionError(f"{' or '.join(texts)} did not appear:\n{shown}")
            if self.read(quiet=0.02, longest=0.02).count:
                shown = self.text
        return time.perf_counter() - begun

    def resize(self, columns: int, rows: int) -> None:
        """Give the terminal another size; the program is told by the system."""
        self.screen.resize(rows, columns)
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def send(self, keys: bytes) -> None:
        """Type these bytes."""
        os.write(self.fd, keys)

    @property
    def text(self) -> str:
        """The screen as lines of text."""
        # as the emulator's own `display`, which measures every character again
        lines = (self.screen.buffer[row] for row in range(self.screen.lines))
        return "\n".join("".join(line[column].data for column in range(self.screen.columns)).rstrip() for line in lines)

    def ended(self) -> int | None:
        """The exit status once the program has ended."""
        pid, status = os.waitpid(self.pid, os.WNOHANG)
        return None if pid == 0 else os.waitstatus_to_exitcode(status)

    def status(self, longest: float = 20.0) -> int:
        """The exit status of a program that is leaving; AssertionError with the screen if it goes on."""
        begun = time.monotonic()
        while time.monotonic() - begun < longest:
            if self.read(quiet=0.02, longest=0.05).count == 0:
                # a terminal whose program is leaving is closed before the program has ended
                time.sleep(0.01)
            if (ended := self.ended()) is not None:
                return ended
        raise AssertionError(f"still running:\n{self.text}")


@contextlib.contextmanager
def running(
    arguments: Sequence[str],
    *,
    columns: int = 80,
    rows: int = 24,
    environment: Mapping[str, str | None] | None = None,
    cwd: str | None = None,
) -> Iterator[Terminal]:
    """Run `arguments` in a pseudo-terminal of this size; it is killed at the end if it has not left by itself.

    A variable that is None in the environment is not set at all.

    What it keeps in its person's folders is gone afterwards, unless the environment names these folders.
    """
    with tempfile.TemporaryDirectory() as folders:
        kept = {name: os.environ[name] for name in PASSED_ON if name in os.environ}
        own = {"XDG_STATE_HOME": folders, "XDG_CONFIG_HOME": folders}
        values = {**kept, "TERM": "xterm-256color", "LANG": "C.UTF-8", **own, **(environment or {})}
        given = {name: value for name, value in values.items() if value is not None}
        with _forked(arguments, given, columns, rows, cwd) as terminal:
            yield terminal


@contextlib.contextmanager
def _forked(
    arguments: Sequence[str], values: Mapping[str, str], columns: int, rows: int, cwd: str | None
) -> Iterator[Terminal]:
    pid, fd = pty.fork()
    if pid == 0:
        # whoever starts the tests may ignore it
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        if cwd is not None:
            os.chdir(cwd)
        os.execvpe(arguments[0], list(arguments), values)
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
    terminal = Terminal(pid, fd, pyte.Screen(columns, rows))
    try:
        yield terminal
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
        with contextlib.suppress(ChildProcessError):
            os.waitpid(pid, 0)
        os.close(fd)
