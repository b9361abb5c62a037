"""A line between a program's pseudo-terminal and ours: every byte late, and no more of them than the line takes."""

from __future__ import annotations

import fcntl
import os
import pty
import select
import struct
import termios
import time
import tty
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from random import Random
from threading import Event, Thread
from typing import Final

import pyte

from tests.terminal import Terminal

BITS: Final = 10
"""Bits a byte takes on a serial line, with its start and its stop."""
HELD: Final = 4096
"""Bytes a line holds before the program has to wait, as a serial port does."""
PIECE: Final = 64
TICK: Final = 0.002


@dataclass(frozen=True)
class Line:
    """`delay` seconds each way; `baud` None for a line that is never the slower one.

    Every typed byte comes up to `jitter` seconds later than the line would have it, each by itself; none overtakes.
    """

    delay: float = 0.0
    baud: int | None = None
    jitter: float = 0.0
    chance: Random = field(default_factory=lambda: Random(1), compare=False)

    @property
    def seconds(self) -> float:
        """Seconds a byte takes."""
        return 0.0 if self.baud is None else BITS / self.baud


LOCAL: Final = Line()


@dataclass
class Way:
    """One direction: bytes under way with the time each piece arrives, and when the line is free again."""

    line: Line
    source: int
    target: int
    under_way: deque[tuple[float, bytes]] = field(default_factory=deque)
    free: float = 0.0

    @property
    def open(self) -> bool:
        """Whether the line takes more; a program that is faster has to wait."""
        return (self.free - time.monotonic()) <= HELD * self.line.seconds

    def take(self) -> bool:
        """Bytes put on the line; no when the other end is gone."""
        try:
            data = os.read(self.source, PIECE if self.line.baud else 65536)
        except OSError:
            return False
        now = time.monotonic()
        self.free = max(self.free, now) + len(data) * self.line.seconds
        due = self.free + self.line.delay
        if not self.line.jitter:
            self.under_way.append((due, data))
        for byte in data if self.line.jitter else b"":
            before = self.under_way[-1][0] if self.under_way else 0.0
            late = due + self.line.jitter * self.line.chance.random()
            self.under_way.append((max(before, late), bytes([byte])))
        return bool(data)

    def deliver(self) -> None:
        """What has arrived by now."""
        while self.under_way and self.under_way[0][0] <= time.monotonic():
            with suppress(OSError):
                os.write(self.target, self.under_way.popleft()[1])


def relay(ways: tuple[Way, Way], done: Event) -> None:
    """Carry bytes both ways until done, or until an end is gone."""
    while not done.is_set():
        sources = [way.source for way in ways if way.open]
        ready, _, _ = select.select(sources, [], [], TICK)
        if not all(way.take() for way in ways if way.source in ready):
            return
        for way in ways:
            way.deliver()


class Relayed(Terminal):
    """A terminal at the far end; its size is told to the program's own."""

    inner: Terminal

    def resize(self, columns: int, rows: int) -> None:
        self.screen.resize(rows, columns)
        fcntl.ioctl(self.inner.fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))


@contextmanager
def relayed(inner: Terminal, line: Line) -> Iterator[Relayed]:
    """The far end of a line to a running program."""
    ours, theirs = pty.openpty()
    tty.setraw(theirs)
    done = Event()
    ways = (Way(replace(line, jitter=0.0), inner.fd, theirs), Way(line, theirs, inner.fd))
    carrier = Thread(target=relay, args=(ways, done), daemon=True)
    terminal = Relayed(inner.pid, ours, pyte.Screen(inner.screen.columns, inner.screen.lines))
    terminal.inner = inner
    carrier.start()
    try:
        yield terminal
    finally:
        done.set()
        carrier.join()
        os.close(ours)
        os.close(theirs)
