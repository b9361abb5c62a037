"""TerminalDriver connects Textual to the terminal; this module also decides which terminals can show the screens.

Textual's own driver fails at the first byte that is not UTF-8, and reads forever from a link that has dropped.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from codecs import getincrementaldecoder, lookup
from collections.abc import Iterator, Mapping
from time import monotonic
from types import FrameType
from typing import TYPE_CHECKING, Any, Final

from textual import events
from textual._ansi_sequences import ANSI_SEQUENCES_KEYS
from textual._xterm_parser import XTermParser
from textual.drivers.linux_driver import LinuxDriver
from textual.message import Message

from app.terminal.capabilities import ASCII, UTF_8, ascii_only, charset
from app.terminal.cell_diff import TerminalCells
from app.terminal.key_order import KeyOrder
from app.terminal.split_keys import KEY_WARNINGS, Joined, delay

if TYPE_CHECKING:
    from textual.app import App

CHARACTER_SETS: Final = ("braille", "block", "ascii")
CHECK_SECONDS: Final = 0.1
"""Seconds between two checks for the end of the program."""
MAX_READ_BYTES: Final = 4096
UNFIT_TERMS: Final = ("dumb", "unknown", "")
"""Values of TERM for terminals that cannot position the cursor."""
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
PLAIN_TERMS: Final = ("linux", "vt1", "vt2")
"""How TERM begins if the terminal may show a control sequence with a $ in it."""


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


def few_colors(environment: Mapping[str, str]) -> bool:
    """True if only the terminal's own sixteen colors are used, or none; by default TERM and COLORTERM decide.

    Without colors, the terminal's own text color and background stay; bold, underline and reverse video do the rest.
    """
    asked = environment.get("TEXTUAL_COLOR_SYSTEM", "auto").lower()
    if "NO_COLOR" in environment or asked != "auto":
        return "NO_COLOR" in environment or asked == "standard"
    true_color = environment.get("COLORTERM", "") in ("truecolor", "24bit")
    return not true_color and not any(word in environment.get("TERM", "") for word in ("256color", "direct", "kitty"))


def refusal(environment: Mapping[str, str]) -> str:
    """Return why the screens cannot run here; empty if they can."""
    if not all(stream is not None and stream.isatty() for stream in (sys.__stdin__, sys.__stderr__)):
        return (
            "the screens need a terminal, and here is none. Start it in a terminal window, or see the commands "
            "without a screen: cutcomp --help"
        )
    if environment.get("TERM", "") in UNFIT_TERMS:
        return (
            f"the terminal says TERM={environment.get('TERM', '')}, which cannot place a cursor. Set TERM to what it "
            "is, such as TERM=xterm or TERM=vt100, and start again."
        )
    return ""


def characters(environment: Mapping[str, str], wanted: str = "") -> tuple[str, tuple[str, ...]]:
    """Return the character set to write, and the sets that drawings can use, the one to begin with first.

    `wanted` is the operator's choice, which overrides the environment.  The fonts of the Linux console have no
    braille; a VT100 has no UTF-8 at all.
    """
    name = UTF_8 if wanted in CHARACTER_SETS[:-1] else charset(environment)
    if wanted not in CHARACTER_SETS[:-1] and name == UTF_8 and ascii_only(environment):
        name = ASCII
    if name != UTF_8:
        return name, CHARACTER_SETS[-1:]
    console = environment.get("TERM", "").startswith("linux") and wanted != CHARACTER_SETS[0]
    able = CHARACTER_SETS[1:] if console else CHARACTER_SETS
    first = able.index(wanted) if wanted else 0
    return name, (*able[first:], *able[:first])
