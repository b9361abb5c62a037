"""What a monkey presses: every kind of key, more of those that get somewhere, and nothing outside its cage."""

from __future__ import annotations

import random
import re
import shutil
import string
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from textual.screen import Screen
from textual.widgets import Input

from app.app import CutcompApp
from app.screens.base import BaseScreen
from app.screens.entry_screen import EntryScreen
from app.screens.home import HomeScreen
from app.widgets.field import NumberField

MOVES: Final = ("tab", "tab", "down", "up", "shift+tab", "left", "right", "pageup", "pagedown", "home", "end")
RARE: Final = ("ctrl+home", "ctrl+end", "delete", "backspace", "insert", "escape", "space", "f9", "f10", "f12")
EVERYWHERE: Final = (*("ctrl+s", "ctrl+o", "ctrl+g", "ctrl+k", "ctrl+t", "ctrl+n", "ctrl+l") * 3, "ctrl+q")
ODD: Final = "é°ß中\u0301\u200b\ufffd…│"
"""Characters that no field takes, and some that take no cell or two of them."""
WEIGHTS: Final = {
    "softkey": 20,
    "number": 20,
    "move": 25,
    "segment": 7,
    "undo": 5,
    "redo": 3,
    "rare": 5,
    "everywhere": 3,
    "letter": 10,
    "garbage": 3,
}
UNTRIED: Final = 0.5
"""How often a softkey that was never pressed is preferred to everything else."""
WORD: Final = re.compile(r"[A-Z]{2,}")
"""What stays of a softkey's label; numbers and letters between them are values."""
MEDDLED: Final = 0.02
"""How often somebody else has written the file."""
SIZES: Final = ((80, 24), (80, 24), (132, 43), (110, 30), (60, 20), (20, 5), (1, 1))
STARTS: Final = ("file", "none", "example", "locked", "proof", "proof")
"""What a life begins with: a program, HOME, an example, a program somebody else has open, an NC program."""
LEAVING: Final = ("HomeScreen", "ProofScreen")
"""Screens whose F8 may leave the program or the text: lives would be short."""


Key = tuple[str, int, str]
"""A softkey: the screen, its number, and the words on it without values, since one number may mean several things."""


def keys_of(screen: Screen[object]) -> dict[int, Key]:
    """The softkeys of the screen that stands and that act now, by number."""
    # a screen that is still being made has none yet
    if not isinstance(screen, BaseScreen) or not screen.is_mounted:
        return {}
    name, found = type(screen).__name__, {}
    for number, key in enumerate(screen.SOFTKEYS, 1):
        if key is not None and screen.key_acts(key):
            found[number] = (name, number, " ".join(WORD.findall(key.label)))
    return found


@dataclass
class Coverage:
    """Screens that stood, and softkeys that were there and were pressed."""

    screens: Counter[str] = field(default_factory=Counter)
    seen: set[Key] = field(default_factory=set)
    pressed: Counter[Key] = field(default_factory=Counter)

    def look(self, screen: Screen[object]) -> None:
        """Take notice of the screen that stands."""
        self.screens[type(screen).__name__] += 1
        self.seen.update(keys_of(screen).values())

    def press(self, screen: Screen[object], key: str) -> None:
        """A key is about to be pressed."""
        digit = key.removeprefix("f") if key.startswith("f") else ""
        here = keys_of(screen)
        if digit in set("12345678") and int(digit) in here:
            self.pressed[here[int(digit)]] += 1

    def missing(self) -> list[Key]:
        """Softkeys that nobody has pressed."""
        return sorted(self.seen - set(self.pressed))

    def add(self, other: Coverage) -> None:
        self.screens.update(other.screens)
        self.seen |= other.seen
        self.pressed.update(other.pressed)


@dataclass
class Monkey:
    """Presses keys; `chance` makes it do the same again, `cage` is the folder it may not leave."""

    chance: random.Random
    cage: Path
    coverage: Coverage = field(default_factory=Coverage)

    def keys(self, app: CutcompApp) -> list[str]:
        """What it does next; on a screen with softkeys that it has never pressed, one of these sooner."""
        screen = app.screen
        if self.chance.random() < UNTRIED and any(not self.coverage.pressed[key] for key in keys_of(screen).values()):
            return self._softkey(screen)
        kind = self.chance.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
        match kind:
            case "softkey":
                return self._softkey(screen)
            case "number":
                into = isinstance(app.focused, NumberField) and app.focused.name != "segment"
                return [*([] if into else ["tab"]), *self._number(), self.chance.choice(("enter", "tab", "down"))]
            case "segment":
                return ["ctrl+end", "pagedown", self.chance.choice("labc")]
            case "garbage":
                return [*self.chance.choices(string.punctuation + ODD + "0123456789", k=4), "enter"]
            case "letter":
                return [self.chance.choice(string.ascii_letters + "????" + string.digits + "+-<>=*./ ")]
            case _:
                return [self.chance.choice(self._plain(kind)) for _ in range(self.chance.randint(1, 3))]

    def start(self) -> str:
        """What the next life begins with."""
        return self.chance.choice(STARTS)

    def size(self) -> tuple[int, int]:
        """Columns and rows of the terminal."""
        return self.chance.choice(SIZES)

    def _plain(self, kind: str) -> tuple[str, ...]:
        choices = {"move": (*MOVES, "enter"), "rare": RARE, "everywhere": EVERYWHERE}
        return choices.get(kind) or (f"ctrl+{'z' if kind == 'undo' else 'y'}",)

    def _number(self) -> str:
        plain = f"{self.chance.choice((0, 1, 1, 2, 3, -1, 0.5, -0.25, self.chance.uniform(-5, 8))):.4g}"
        return self.chance.choice((plain, plain, plain, f"{plain}+1/8", "12.7mm", "25.4/2", "1", "4"))

    def _softkey(self, screen: Screen[object]) -> list[str]:
        """One that is there, sooner one that was never pressed."""
        known = keys_of(screen)
        here = sorted(known) or [8]
        untried = [number for number, key in sorted(known.items()) if not self.coverage.pressed[key]]
        number = self.chance.choice(untried if untried and self.chance.random() < 0.8 else here)
        if number == 8 and type(screen).__name__ in LEAVING and self.chance.random() < 0.8:
            number = here[0]
        return [f"f{number}" if self.chance.random() < 0.7 else f"alt+{number}"]

    def caged(self, app: CutcompApp, key: str) -> str:
        """The key, or Esc where it could act on a name outside the cage."""
        return key if all(self._inside(screen) for screen in app.screen_stack) else "escape"

    def meddle(self, file: Path | None) -> None:
        """Now and then somebody else saves another program under the name of the one that is open."""
        if file is None or not file.is_file() or self.cage not in _resolved(file).parents:
            return
        if self.chance.random() < MEDDLED:
            shutil.copy(self.cage / "examples" / "notch.toml", file)

    def _inside(self, screen: Screen[object]) -> bool:
        named = []
        if isinstance(screen, HomeScreen):
            named.append(screen.folder)
        if isinstance(screen, EntryScreen):
            named += [Path(line.value.strip() or ".") for line in screen.query(Input)]
        return all(self.cage in (one, *one.parents) for one in map(_resolved, named))


@dataclass
class Typist(Monkey):
    """Types these keys one after the other, in a program on a terminal of 80x24."""

    script: list[str] = field(default_factory=list)

    def keys(self, app: CutcompApp) -> list[str]:  # noqa: ARG002 - what is shown changes nothing
        """The next key."""
        return [self.script.pop(0)]

    def start(self) -> str:
        """The life begins with a program."""
        return "file"

    def size(self) -> tuple[int, int]:
        """An ordinary terminal."""
        return 80, 24


def _resolved(name: Path) -> Path:
    """Where a name leads; the root for one that leads nowhere."""
    try:
        return name.expanduser().resolve()
    except (RuntimeError, ValueError, OSError):
        return Path("/")
