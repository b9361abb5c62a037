"""The last lines of every screen: the prompt, the progress in its place, and the status line below."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from shutil import disk_usage
from textwrap import wrap
from time import strftime
from typing import ClassVar, Final

from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.widgets import Label, ProgressBar

from app.documents.time_limits import within
from app.session.messages import Sentence, Tone
from app.session.session import Session
from app.session.work import Work
from app.widgets.plain import PlainLabel, PlainText, show_text
from core.units import Unit

MINUTE = 60.0
LOW_ON_DISK = 50_000_000
"""Bytes of free disk space below which it is shown as a warning."""

SPACED_UNITS: Final = {Unit.IN: "I N C H", Unit.MM: "M M"}
"""The unit, spaced out, for a new program and for the screen that posts it."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What the status line shows of the machine; tests pass a fixed clock and a fixed disk."""

    clock: Callable[[], str] = lambda: strftime("%H:%M")
    free: Callable[[], int] = lambda: within(0.2, lambda: disk_usage(Path.cwd()).free)


class Prompt(PlainText):
    """Two lines on what the field with the cursor takes, or why something was refused."""

    LINES: ClassVar[int] = 2

    def __init__(self) -> None:
        super().__init__(id="prompt")
        self.sentence = Sentence("")

    def has_room(self, text: str) -> bool:
        """Return whether a text is shown whole."""
        return len(wrap(text, max(self.content_size.width, 1))) <= self.LINES

    def show(self, sentence: Sentence) -> None:
        """Show a sentence in its tone; do nothing if it is shown already."""
        if sentence == self.sentence:
            return
        if sentence.tone is not self.sentence.tone:
            for tone in (Tone.WARNING, Tone.ERROR):
                self.set_class(sentence.tone is tone, f"-{tone}")
        self.sentence = sentence
        self.update(sentence.text, layout=False)


class Progress(Horizontal):
    """The bar of the fraction done, and the key that stops the work; in view only while there is work."""

    def compose(self) -> ComposeResult:
        """Yield the bar and the key."""
        yield ProgressBar(total=1.0, show_eta=False)
        yield PlainLabel("Esc stops")

    def show(self, work: Work) -> None:
        """Show how much of the work is done, and the key as soon as it acts."""
        if not self.children:
            # not composed yet
            return
        self.query_one(ProgressBar).progress = min(work.done, 1.0)
        self.query_one(PlainLabel).visible = work.stoppable


class Status(Horizontal):
    """Units and free disk space or progress, what is saved, undo and redo, and the clock.

    It reads the clock and the disk once a minute.
    """

    def __init__(self, surroundings: Surroundings) -> None:
        super().__init__(id="status")
        self.surroundings = surroundings
        self._unit = self._work = ""

    def compose(self) -> ComposeResult:
        """Yield three labels."""
        yield PlainLabel("", id="units")
        yield PlainLabel("", id="undo")
        yield PlainLabel("", id="clock")

    def on_mount(self) -> None:
        """Read the clock and the disk now, and then once a minute."""
        self.set_interval(MINUTE, self.read_machine)
        self.read_machine()

    def read_machine(self) -> None:
        """Show the time of day and the free disk space, or the progress of long work."""
        free: int | None = None
        with suppress(OSError):
            # the current folder may be gone, or on a network that does not answer
            free = self.surroundings.free()
        self._show("clock", self.surroundings.clock())
        room = "" if free is None else f"Free: {size_text(free)}"
        unit = f"Prog Units: {self._unit}   " if self._unit else ""
        self._show("units", self._work or f"{unit}{room}".rstrip())
        self.query_one("#units").set_class(free is not None and free < LOW_ON_DISK, "-warning")

    def show_program(self, session: Session) -> None:
        """Show the state of the contour program; the unit stands out until there is a segment."""
        undo, redo = session.history.undo_count, session.history.redo_count
        new = not any(block.segments for block in session.program.blocks)
        unit = f" {SPACED_UNITS[session.program.unit]} " if new else str(session.program.unit)
        # a file that does not exist yet has nothing saved in it
        saved = session.file is not None and not new
        self.show(unit, undo, redo, unsaved=session.unsaved, saved=saved, new=new)

    def show(self, unit: str, undo: int, redo: int, *, unsaved: bool, saved: bool, new: bool = False) -> None:
        """Show the unit, whether everything is in the file, and how many edits can be undone and redone."""
        texts = ["not saved" if unsaved else "saved" if saved else ""]
        texts += [f"undo {undo}"] if undo else []
        texts += [f"redo {redo}"] if redo else []
        self._show("undo", "   ".join(text for text in texts if text))
        if unit != self._unit:
            self._unit = unit
            self.query_one("#units").set_class(new, "-new")
            self.read_machine()

    def show_work(self, text: str) -> None:
        """Show the progress of long work in place of the units and the free disk space; empty for none."""
        if text != self._work:
            self._work = text
            self.read_machine()

    def _show(self, name: str, text: str) -> None:
        show_text(self.query_one(f"#{name}", Label), text)


def size_text(size: int) -> str:
    """Return bytes as whole gigabytes or megabytes."""
    return f"{size // 10**9} GB" if size >= 10**9 else f"{size // 10**6} MB"
