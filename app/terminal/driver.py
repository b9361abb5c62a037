"""TerminalDriver connects Textual to the terminal; `teach` adds key sequences that Textual does not know.

Textual's own driver fails at the first byte that is not UTF-8, and reads forever from a link that has dropped.
Textual has no public way to add a sequence, so `teach` writes into its table; a test types each into a pseudo-terminal.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from codecs import getincrementaldecoder, lookup
from collections.abc import Iterator
from enum import StrEnum
from time import monotonic
from types import FrameType
from typing import TYPE_CHECKING, Any, Final, cast

from textual import events
from textual._ansi_sequences import ANSI_SEQUENCES_KEYS
from textual._xterm_parser import XTermParser
from textual.drivers.linux_driver import LinuxDriver
from textual.keys import Keys
from textual.message import Message

from app.terminal.capabilities import ASCII, UTF_8
from app.terminal.cell_diff import TerminalCells
from app.terminal.key_order import KeyOrder
from app.terminal.split_keys import KEY_WARNINGS, Joined, delay

if TYPE_CHECKING:
    from textual.app import App

CHECK_SECONDS: Final = 0.1
"""Seconds between two checks for the end of the program."""
MAX_READ_BYTES: Final = 4096
ERASING_TERMS: Final = (
    "xterm",
    "putty",
    "linux",
    "rxvt",
    "alacritty",
    "kitty",
    "foot",
    "wezterm",
    "konsole",
    "vte",
    "gnome",
)
"""How TERM begins if erased cells take the color in force; other terminals use their own background."""
SOFTKEYS: Final = (Keys.F1, Keys.F2, Keys.F3, Keys.F4, Keys.F5, Keys.F6, Keys.F7, Keys.F8)
VT100_PLUS: Final = "PQRSTUVW"
"""PuTTY in VT100+ mode sends ESC O and these letters for F1 to F8; Textual knows the first four."""

SCO_KEYS: Final = {
    "N": Keys.F2,
    "P": Keys.F4,
    "Q": Keys.F5,
    "R": Keys.F6,
    "S": Keys.F7,
    "T": Keys.F8,
    "G": Keys.PageDown,
}
"""PuTTY in SCO mode sends ESC [ and these letters.  Its F1 begins like a mouse click, and its F3 is what other
terminals send when their window loses the focus: for these two the operator types Esc and the digit."""
PLAIN_TERMS: Final = ("linux", "vt1", "vt2")
"""How TERM begins if the terminal may show a control sequence with a $ in it."""


AtOnce = StrEnum("AtOnce", "alt+1 alt+2 alt+3 alt+4 alt+5 alt+6 alt+7 alt+8")
"""Esc and a digit in one packet, named as Textual names Alt and the digit from terminals with a newer protocol."""


class TerminalDriver(LinuxDriver):
    """A driver that replaces bytes that it cannot decode, and treats the end of its input as a hangup.

    It sends only what differs from what the terminal shows, or everything if that may have been overwritten.  Keys
    reach the App one at a time.
    """

    def __init__(
        self, app: App[Any], *, debug: bool = False, mouse: bool = True, size: tuple[int, int] | None = None
    ) -> None:
        super().__init__(app, debug=debug, mouse=mouse, size=size)
        self.cells = TerminalCells(self._get_terminal_size, os.environ.get("TERM", "").startswith(ERASING_TERMS))
        self.suspended = False
        self.keys = KeyOrder(app)

    def write(self, data: str) -> None:
        """Send a picture to the terminal in as few bytes as show it."""
        if sent := self.cells.write(data):
            super().write(sent)

    def send_message(self, message: Message) -> None:
        """Pass a message from the terminal to the App in its turn; the reader thread calls this."""
        self._loop.call_soon_threadsafe(self.keys.take, message)

    def send_all(self) -> None:
        """Send everything again, whatever the terminal shows; safe in a signal handler."""
        self.cells.forget()
        self.send_message(events.Callback(self._repaint))

    def _repaint(self) -> None:
        self._app.refresh()

    def start_application_mode(self) -> None:
        """Start or resume; a resize signal at the same size redraws too: something else may have used the terminal."""
        super().start_application_mode()  # type: ignore[no-untyped-call]  # Textual's own
        resized = signal.getsignal(signal.SIGWINCH)

        def changed(number: int, frame: FrameType | None) -> None:
            if callable(resized):
                resized(number, frame)
            self.send_all()

        signal.signal(signal.SIGWINCH, changed)

    def stop_application_mode(self) -> None:
        """Give the terminal back, for a while or for good; at the end, ignore Ctrl+Z, which could stop a save."""
        if not self.suspended:
            signal.signal(signal.SIGTSTP, signal.SIG_IGN)
        super().stop_application_mode()

    def _sigtstp_application(self, *_: object) -> None:
        """Stop between two tasks: a handler in the middle of a write would wait forever for the write's end."""
        self._loop.call_soon_threadsafe(super()._sigtstp_application)

    def _sigcont_application(self, *_: object) -> None:
        """Resume between two tasks, too."""
        self._loop.call_soon_threadsafe(super()._sigcont_application)

    def suspend_application_mode(self) -> None:
        """Give the terminal back for a while."""
        self.suspended = True
        super().suspend_application_mode()

    def resume_application_mode(self) -> None:
        """Resume, also after a stop without warning; redraw, since the terminal shows what others left on it."""
        if not self.suspended:
            self.suspend_application_mode()
        self.suspended = False
        super().resume_application_mode()
        self.send_all()

    def _request_terminal_sync_mode_support(self) -> None:
        """Send the query, except to terminals that may show the end of it as a letter."""
        if not os.environ.get("TERM", "").startswith(PLAIN_TERMS):
            super()._request_terminal_sync_mode_support()

    def _query_in_band_window_resize(self) -> None:
        """Send no query: its answer would change nothing here, since a signal reports a new size."""

    def run_input_thread(self) -> None:
        """Read keys until the program ends or the link drops."""
        parser, joined = XTermParser(self._debug), Joined(ANSI_SEQUENCES_KEYS, delay(os.environ))
        decode = getincrementaldecoder(input_charset())(errors="replace").decode
        while not self.exit_event.is_set():
            patience = CHECK_SECONDS if joined.due is None else min(CHECK_SECONDS, max(joined.due - monotonic(), 0.0))
            # bytes that are there at the time of a check belong together, however late this thread had its turn
            if select.select([self.fileno], [], [], patience)[0]:
                data = read_input(self.fileno)
                if not data:
                    os.kill(os.getpid(), signal.SIGHUP)
                    return
                keys = joined.feed(decode(data), monotonic())
            else:
                keys = joined.tick(monotonic())
            for key in keys:
                for message in messages_of_key(parser, key):
                    self.process_message(message)


def redraw(app: App[Any]) -> None:
    """Send everything again, whatever others have written on the terminal."""
    driver = app._driver
    if isinstance(driver, TerminalDriver):
        driver.send_all()
    else:
        app.refresh()


def has_mouse(app: App[Any]) -> bool:
    """True if clicks reach the program."""
    return isinstance(app._driver, TerminalDriver) and app._driver._mouse


def take_mouse(app: App[Any], wanted: bool) -> None:
    """Take the mouse from the terminal, which uses it to select and copy text, or give it back."""
    driver = app._driver
    if isinstance(driver, TerminalDriver):
        # Textual changes the mouse mode only while `_mouse` is True
        driver._mouse = True
        driver._enable_mouse_support() if wanted else driver._disable_mouse_support()
        driver._mouse = wanted


def messages_of_key(parser: XTermParser, key: str) -> Iterator[Message]:
    """Yield what Textual's parser makes of a whole key; an unknown key sequence gives nothing, never text."""
    if key in KEY_WARNINGS:
        yield events.Key(key, None)
        return
    yield from parser.feed(key)
    if parser._timeout_time is not None:
        # the parser waits for more, but nothing follows
        parser._timeout_time = 0.0
        rest = list(parser.tick())
        yield from () if key.startswith(("\x1b[", "\x1bO")) else rest


def input_charset() -> str:
    """Return the character set in which keys arrive: that of the screen, or UTF-8 if that is ASCII."""
    screen = ASCII if sys.__stderr__ is None else lookup(sys.__stderr__.encoding).name
    return UTF_8 if screen == ASCII else screen


def read_input(handle: int) -> bytes:
    """Return what was typed; empty at the end of the input or if the link has dropped."""
    try:
        return os.read(handle, MAX_READ_BYTES)
    except OSError:
        return b""


def teach() -> None:
    """Add the sequences to Textual's table."""
    table = cast("dict[str, tuple[StrEnum | Keys, ...]]", ANSI_SEQUENCES_KEYS)
    for number, both in enumerate(AtOnce, 1):
        table[f"\x1b{number}"] = (both,)
    for key, letter in zip(SOFTKEYS, VT100_PLUS, strict=True):
        table[f"\x1bO{letter}"] = (key,)
    for letter, key in SCO_KEYS.items():
        table[f"\x1b[{letter}"] = (key,)
    # this is how Enter arrives if it was pressed before the screens had the terminal
    table["\n"] = (Keys.Enter,)
