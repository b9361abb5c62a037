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

from app.painted.desk import Desk
from app.painted.screens.page import Page
from app.painted.session import SEGMENT

MOVES: Final = ("tab", "tab", "down", "up", "shift+tab", "left", "right", "pageup", "pagedown", "home", "end")
RARE: Final = ("ctrl+home", "ctrl+end", "delete", "backspace", "insert", "escape", "space", "f9", "f12", "shift+f1")
EVERYWHERE: Final = (*("ctrl+s", "ctrl+o", "ctrl+g", "ctrl+k", "ctrl+c") * 3, "ctrl+q")
ODD: Final = "é°ß中\u0301\u200b\x00\x9b\ufffd…│"
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
ACTING: Final = frozenset({"enter", "right", "left", *(f"f{number}" for number in range(1, 9)), *EVERYWHERE})
"""Keys that may write or open what a name says."""
WORD: Final = re.compile(r"[A-Z]{2,}")
"""What stays of a softkey's label; numbers and letters between them are values."""
MEDDLED: Final = 0.02
"""How often somebody else has written the file."""
LAST: Final = ("ProgramPage", "StartPage", "ProofPage")
"""Screens whose EXIT may leave the program: lives would be short."""


Key = tuple[str, int, str]
"""A softkey: the screen, its number, and the words on it without values, since one number may mean several things."""


def keys_of(desk: Desk) -> dict[int, Key]:
    """The softkeys of the screen that stands, by number."""
    name, keys = type(desk.page).__name__, desk.page.softkeys(desk.session)
    return {number: (name, number, " ".join(WORD.findall(key.label))) for number, key in keys.items()}


@dataclass
class Coverage:
    """Screens that stood, and softkeys that were there and were pressed."""

    screens: Counter[str] = field(default_factory=Counter)
    seen: set[Key] = field(default_factory=set)
    pressed: Counter[Key] = field(default_factory=Counter)

    def look(self, desk: Desk) -> None:
        """Take notice of the screen that stands."""
        self.screens[type(desk.page).__name__] += 1
        self.seen.update(keys_of(desk).values())

    def press(self, desk: Desk, key: str) -> None:
        """A key is about to be pressed."""
        digit = key if desk.armed else key.removeprefix("f") if key.startswith("f") else ""
        here = keys_of(desk)
        if digit in set("12345678") and int(digit) in here and not (desk.armed and not here[int(digit)][2]):
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

    def keys(self, desk: Desk) -> list[str]:
        """What it does next; on a screen with softkeys that it has never pressed, one of these sooner."""
        if self.chance.random() < UNTRIED and any(map(self._untried, keys_of(desk).values())):
            return self._softkey(desk)
        kind = self.chance.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
        match kind:
            case "softkey":
                return self._softkey(desk)
            case "number":
                field = desk.session.field != SEGMENT or self.chance.random() < 0.3
                return [*([] if field else ["tab"]), *self._number(), self.chance.choice(("enter", "tab", "down"))]
            case "segment":
                return ["ctrl+end", "pagedown", self.chance.choice("lab")]
            case "garbage":
                return [*self.chance.choices(string.punctuation + ODD + "0123456789", k=4), "enter"]
            case "letter":
                return [self.chance.choice(string.ascii_letters + "????" + string.digits + "+-<>=*./ ")]
            case _:
                return [self.chance.choice(self._plain(kind)) for _ in range(self.chance.randint(1, 3))]

    def _plain(self, kind: str) -> tuple[str, ...]:
        choices = {"move": (*MOVES, "enter"), "rare": RARE, "everywhere": EVERYWHERE}
        return choices.get(kind) or (f"ctrl+{'z' if kind == 'undo' else 'y'}",)

    def _number(self) -> str:
        plain = f"{self.chance.choice((0, 1, 1, 2, 3, -1, 0.5, -0.25, self.chance.uniform(-5, 8))):.4g}"
        return self.chance.choice((plain, plain, plain, f"{plain}+1/8", "1 1/2", "12.7mm", "25.4/2", "1", "4"))

    def _softkey(self, desk: Desk) -> list[str]:
        """One that is there, sooner one that was never pressed; by its function key or by Esc and the digit."""
        known = keys_of(desk)
        here = sorted(known) or [8]
        untried = [number for number, key in sorted(known.items()) if self._untried(key)]
        number = self.chance.choice(untried if untried and self.chance.random() < 0.8 else here)
        if number == 8 and type(desk.page).__name__ in LAST and self.chance.random() < 0.8:
            number = here[0]
        return [f"f{number}"] if self.chance.random() < 0.7 else ["ctrl+k", str(number)]

    def _untried(self, key: Key) -> bool:
        """Whether a softkey was never pressed, or leads to others."""
        return not self.coverage.pressed[key] or key[2] == "MORE"

    def caged(self, desk: Desk, key: str) -> str:
        """The key, or Esc where it could act on a name outside the cage."""
        outside = any(not self._inside(page) for page in desk.pages)
        acting = key in ACTING or desk.armed or type(desk.page).__name__ in ("Ask", "Choose", "Decide")
        return "escape" if outside and acting else key

    def meddle(self, file: Path | None) -> None:
        """Now and then somebody else saves another program under the name of the one that is open."""
        if file is None or not file.is_file() or self.cage not in _resolved(file).parents:
            return
        if self.chance.random() < MEDDLED:
            shutil.copy(self.cage / "examples" / "notch.toml", file)

    def _inside(self, page: Page) -> bool:
        folder = getattr(page, "folder", Path.cwd())
        entry = getattr(page, "entry", None)
        named = getattr(entry, "path", None) or folder / getattr(entry, "text", "").strip()
        return all(self.cage in (one, *one.parents) for one in (folder.resolve(), _resolved(named)))


def _resolved(name: Path) -> Path:
    """Where a name leads; the root for one that leads nowhere."""
    try:
        return name.expanduser().resolve()
    except (RuntimeError, ValueError, OSError):
        return Path("/")
