"""Palette lists every action by name; a digit as the first key presses that softkey."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from typing import Any, ClassVar, Final

from textual import on
from textual.binding import Binding, BindingType
from textual.command import CommandPalette, DiscoveryHit, Hit, Hits, Provider
from textual.widgets import Input, OptionList

from app.screens.base import BaseScreen

ACTIONS: Final = (
    ("SAVE", "app.save", "Ctrl+S"),
    ("SAVE AS", "app.save_as", "under another name"),
    ("OPEN", "app.home", "Ctrl+O: the programs of a folder, the examples"),
    ("OPEN A PATH", "app.open_path", "type the name of a file"),
    ("NEW INCH", "app.new('IN')", "a new program in inches"),
    ("NEW MM", "app.new('MM')", "a new program in millimeters"),
    ("POST", "app.post", "write the NC file: export G-code"),
    ("SETUP SHEET", "app.sheet", "the sheet that goes to the machine"),
    ("DRAW", "app.draw", "F7: the drawing, finding by finding"),
    ("LOOKAHEAD TABLE", "app.lookahead", "what every value from 1 to 20 does"),
    ("MILL CONTOUR", "app.contour", "the form of the block"),
    ("PROGRAM", "app.program", "the list of blocks"),
    ("PROGRAM PARAMETERS", "app.parameters", "units, blends, allowances, clearances"),
    ("PART SETUP", "app.part_setup", "part name, work offset, safe height"),
    ("TOOL SETUP", "app.tools", "the tool table"),
    ("IMPORT TOOL TABLE", "app.import_tools", "tools from a LinuxCNC tool table"),
    ("IMPORT DRAWING", "app.open_path", "contours of a DXF file"),
    ("NC PROOF", "app.open_path", "what a control does with an NC program"),
    ("GUIDED FIRST PART", "app.guide", "a first part, step by step"),
    ("SHIFT BLOCK", "app.shift_block", "transform: move the whole block in X and Y"),
    ("ROTATE BLOCK", "app.rotate_block", "transform: turn the whole block about a point"),
    ("MIRROR BLOCK", "app.mirror_block", "transform: flip about a line; DIRECTION and CUTTER COMP. change sides"),
    ("REPEAT SEGMENTS, SHIFTED", "app.repeat_shifted", "copy segments, each moved from the one before"),
    ("REPEAT SEGMENTS, ROTATED", "app.repeat_rotated", "copy segments, each turned from the one before"),
    ("UNDO", "app.undo", "Ctrl+Z"),
    ("REDO", "app.redo", "Ctrl+Y"),
    ("CALCULATE", "app.calculate", "again, after Esc has stopped it"),
    ("CHARACTERS", "app.next_characters", "braille, half blocks or ASCII"),
    ("LIGHT / DARK", "app.light_or_dark", "the other colors"),
    ("MOUSE", "app.mouse", "clicks act here, or the terminal marks text with it"),
    ("KEYS, HELP", "app.help", "? or Ctrl+G"),
    ("QUIT", "app.quit", "Ctrl+Q: exit"),
)
"""Name, action and hint of each action that works on every screen."""
NOTHING_FOUND: Final = "No action has that name."
NAME_BEGINS: Final = 100.0
"""Added to the score of an action whose name begins with what is typed, above any other match."""
WORDS_BEGIN: Final = 0.01
"""The score of an action found by words of its name and hint, below any found by the letters of its name."""
GO_TO_SEGMENT: Final = re.compile(r"\D*(\d{1,5})\s*")


class Actions(Provider):
    """The screen's softkeys, its other actions, and the actions of all screens."""

    def _actions(self) -> Iterator[tuple[str, str, str]]:
        screen = self.screen
        if isinstance(screen, BaseScreen):
            for number, key in enumerate(screen.SOFTKEYS, 1):
                if key is not None and screen.key_acts(key):
                    yield key.label, f"screen.softkey({number})", f"F{number}"
            yield from screen.PALETTE_ACTIONS
        yield from ACTIONS

    def _unique(self) -> list[tuple[str, str, str]]:
        named: dict[str, tuple[str, str, str]] = {}
        for action in self._actions():
            named.setdefault(action[0], action)
        return list(named.values())

    async def discover(self) -> Hits:
        """Yield all actions before anything is typed."""
        for name, action, hint in self._unique():
            yield DiscoveryHit(name, partial(self.screen.run_action, action), help=hint)

    async def search(self, query: str) -> Hits:
        """Yield the actions that match; a number goes to that segment.

        If none matches, say so here at once: Textual does so half a second later and crashes if the palette has been
        closed by then.
        """
        matcher = self.matcher(query)
        scored = [
            (_score(matcher.match(name), query, name, hint), name, action, hint)
            for name, action, hint in self._unique()
        ]
        matches = [each for each in scored if each[0] > 0]
        for score, name, action, hint in matches:
            yield Hit(score, matcher.highlight(name), partial(self.screen.run_action, action), help=hint)
        number = GO_TO_SEGMENT.fullmatch(query)
        if number is not None:
            segment = int(number[1])
            yield Hit(1.0, f"GO TO SEGMENT {segment}", partial(self.app.run_action, f"app.segment({segment})"))
        elif not matches:
            app: Any = self.app
            yield Hit(1.0, NOTHING_FOUND, partial(app.say, NOTHING_FOUND), help="Delete letters, or go back with Esc")


def _score(matched: float, query: str, name: str, hint: str) -> float:
    """Return the rank of an action whose name matches the query by `matched`; 0 if it is not found."""
    if name.lower().startswith(query.strip().lower()):
        return matched + NAME_BEGINS
    words, parts = f"{name} {hint}".lower().split(), query.lower().split()
    found = all(any(word.startswith(part) for word in words) for part in parts)
    return matched or (WORDS_BEGIN if found else 0.0)


class Palette(CommandPalette):
    """The command palette; a digit from 1 to 8 as the first key presses the softkey of the screen below."""

    BINDINGS: ClassVar[list[BindingType]] = [Binding("ctrl+k,f8", "app.back", "Close", show=False)]

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Block paging while the list has no room: Textual would fail."""
        paging = action == "command_list" and str(parameters[0]).startswith("page_")
        if paging and not self.query_one(OptionList).scrollable_content_region:
            return False
        return super().check_action(action, parameters)

    def on_mount(self) -> None:
        """Turn off the cursor's blinking and the selection of the text on focus."""
        line = self.query_one(Input)
        line.select_on_focus = line.cursor_blink = False

    @on(Input.Changed)
    async def _first_digit(self, event: Input.Changed) -> None:
        """Press the softkey if the text is a single digit."""
        if event.value in tuple("12345678"):
            event.stop()
            app: Any = self.app
            app.pop_screen()
            await app.run_action(f"screen.softkey({event.value})")
