"""Softkeys shows at the right edge what F1 to F8 do on a screen, and which of them act now."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.content import Content

from app.widgets.plain import PlainText

MAX_LABEL_CHARACTERS = 14
"""The most characters of a label on one line; a longer label breaks after its first word."""

LEGEND = (
    ("━━", "$c-part", "part"),
    ("──", "$c-path", "tool center"),
    ("··", "$c-cutter", "cutter"),
    ("━⢕", "$c-uncut", "left uncut"),
    ("╍╍", "$c-deleted", "deleted"),
    (" x", "$c-deleted", "deleted by"),
    ("⢕!", "$c-gouge", "gouge"),
    (" S", "$c-begin", "START"),
    (" o", "$c-begin", "plunge"),
)
"""The signs of the drawing with their colors and meanings."""


@dataclass(frozen=True, slots=True)
class Softkey:
    """A softkey: its label, the action it runs, and its short name for narrow terminals.

    `acts` is called with the screen; if it returns False, the key is dim, and pressing it says `idle`.
    """

    label: str
    action: str
    short: str
    acts: Callable[[Any], bool] = lambda _: True
    idle: str = ""


class SoftkeyLabel(PlainText):
    """The label of one softkey; a click presses the key."""

    def __init__(self, number: int) -> None:
        super().__init__(id=f"f{number}")
        self.number = number
        self._state: tuple[Softkey | None, bool, bool] | None = None

    def show(self, key: Softkey | None, *, acts: bool, short: bool) -> None:
        """Show the key bright or dim, with its short name if `short`; do nothing if it is shown so already."""
        if self._state == (key, acts, short):
            return
        self._state = key, acts, short
        cap, label, look = f" F{self.number} ", "" if key is None else key.label, "" if acts else "dim"
        if short:
            cap, label = cap.strip(), "" if key is None else key.short
        elif len(label) > MAX_LABEL_CHARACTERS:
            label = label.replace(" ", "\n     ", 1)
        words = (" ", (label, look)) if label or short else ()
        self.update(Text.assemble((cap, "reverse bold" if acts else "dim"), *words), layout=False)

    def on_click(self, event: events.Click) -> None:
        """Press the key."""
        event.stop()
        self.screen.call_later(self.screen.run_action, f"softkey({self.number})")


class Softkeys(Vertical):
    """F1 to F8, more keys of the screen, and the legend if there is room."""

    def __init__(
        self,
        keys: Sequence[Softkey | None],
        more: Sequence[tuple[str, str]] = (),
        acts: Callable[[Softkey], bool] = lambda _: True,
    ) -> None:
        super().__init__(id="softkeys")
        self.keys, self.more, self.acts = tuple(keys), tuple(more), acts
        self._labels = [SoftkeyLabel(number) for number in range(1, len(self.keys) + 1)]

    def compose(self) -> ComposeResult:
        """Yield the eight labels, the other keys and the legend."""
        yield from self._labels
        more = [Text.assemble((f"{key:>3} ", "reverse"), " ", label) for key, label in self.more]
        yield PlainText(Text("\n").join(more), id="more")
        legend = [Content.assemble("  ", (sign, role), f"  {meaning}") for sign, role, meaning in LEGEND]
        yield PlainText(Content("\n").join(legend), id="legend")

    def on_mount(self) -> None:
        """Show which keys act at first."""
        self.refresh_keys()

    def refresh_keys(self) -> None:
        """Show which keys act now."""
        short = self.screen.has_class("-narrow")
        for label, key in zip(self._labels, self.keys, strict=True):
            label.show(key, acts=key is not None and self.acts(key), short=short)
