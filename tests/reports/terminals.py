"""Terminals by what they are told to be: TERM, colors, locale; and the bytes their keys send."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product
from typing import Final

ESC: Final = "\x1b"
TERMS: Final = ("xterm", "xterm-256color", "screen", "tmux", "linux", "putty", "vt100", "vt220", "xterm-mono")
BARE: Final = ("vt100", "vt220", "xterm-mono")
"""Terminals without colors."""
NO_UTF_8: Final = ("vt100", "vt220")
"""Terminals without UTF-8."""
NAMED_256: Final = ("xterm", "screen", "tmux", "putty")
"""Terminals whose name with -256color behind it exists."""
LOCALES: Final = {"UTF-8": "C.UTF-8", "Latin-1": "de_DE.ISO-8859-1", "C": "C"}
FORMS: Final = ("LANG", "LC_CTYPE", "LC_ALL")
"""Variables that a locale is named in; the later ones count more."""
SETS: Final = {"UTF-8": "utf-8", "Latin-1": "latin-1", "C": "ascii"}
"""What the bytes of the screen are read as in each locale."""
SIZES: Final = ((80, 24), (132, 43), (200, 60), (20, 5))
MODES: Final = ("braille", "block", "ascii")


class Colors(StrEnum):
    """How many colors a terminal is told to have."""

    TRUE = "truecolor"
    MANY = "256"
    FEW = "16"
    NONE = "NO_COLOR"


@dataclass(frozen=True)
class Kind:
    """One terminal: the value of TERM, the colors, the locale's kind, and the drawing its operator asks for."""

    term: str
    colors: Colors
    locale: str
    asked: str = ""

    def __str__(self) -> str:
        return " ".join(one for one in (self.term, self.colors, self.locale, self.asked) if one)

    @property
    def environment(self) -> dict[str, str | None]:
        """What the program is started with; a name with 256 colors in it says so by itself."""
        values: dict[str, str | None] = {"TERM": self.term, "LANG": None, self.form: LOCALES[self.locale]}
        match self.colors:
            case Colors.TRUE:
                values["COLORTERM"] = "truecolor"
            case Colors.MANY if self.term in NAMED_256:
                values["TERM"] = f"{self.term}-256color"
            case Colors.MANY:
                values["TEXTUAL_COLOR_SYSTEM"] = "256"
            case Colors.FEW if "256" in self.term:
                values["TEXTUAL_COLOR_SYSTEM"] = "standard"
            case Colors.NONE:
                values["NO_COLOR"] = "1"
            case _:
                pass
        return values

    @property
    def form(self) -> str:
        """The variable that names the locale: each of them on some terminals."""
        return FORMS[(TERMS.index(self.term) + 2 * tuple(Colors).index(self.colors)) % len(FORMS)]

    @property
    def shown(self) -> Colors:
        """The colors it must get: sixteen are assumed where nothing is said, but not of a terminal without any."""
        return Colors.NONE if self.colors is Colors.FEW and self.term in BARE else self.colors

    @property
    def characters(self) -> str:
        """What the bytes of the screen are read as."""
        if self.asked in MODES[:-1]:
            return "utf-8"
        return "ascii" if self.locale == "UTF-8" and self.term in NO_UTF_8 else SETS[self.locale]

    @property
    def modes(self) -> tuple[str, ...]:
        """What the drawing can be drawn with, in the order of the key that changes it."""
        if self.asked:
            first = MODES.index(self.asked)
            return (*MODES[first:], *MODES[:first])
        if self.locale != "UTF-8" or self.term in NO_UTF_8:
            return MODES[-1:]
        return MODES[1:] if self.term == "linux" else MODES

    @property
    def by_asking(self) -> Kind | None:
        """The same terminal where its operator asks for what it does not draw with by itself; None where it does."""
        return None if MODES[0] in self.modes else replace(self, asked=MODES[0])

    @property
    def only_here(self) -> tuple[str, ...]:
        """The ways of drawing that are not had without asking."""
        return tuple(mode for mode in self.modes if not self.asked or mode not in replace(self, asked="").modes)


def kinds() -> tuple[Kind, ...]:
    """Every terminal, color and locale, and the same where its operator asks for braille."""
    plain = tuple(Kind(*one) for one in product(TERMS, Colors, LOCALES))
    return (*plain, *(asked for kind in plain if (asked := kind.by_asking) is not None))


def sampled() -> tuple[Kind, ...]:
    """Some of them: every pair of a terminal, its colors and its locale, and each by asking once."""
    turns = {one: number for every in (TERMS, Colors, LOCALES) for number, one in enumerate(every)}
    plain = (kind for kind in kinds() if (turns[kind.term] + turns[kind.colors] - turns[kind.locale]) % 3 == 0)
    chosen = tuple(kind for kind in plain if not kind.asked)
    asked = {kind.term: kind for kind in kinds() if kind.asked}
    return (*chosen, *asked.values())


def _tilde(*numbers: int) -> tuple[str, ...]:
    return tuple(f"[{number}~" for number in numbers)


def _letters(start: str, letters: str) -> tuple[str, ...]:
    return tuple(f"{start}{letter}" for letter in letters)


FOUR: Final = _letters("O", "PQRS")
OLD: Final = _tilde(11, 12, 13, 14, 15, 17, 18, 19)
XTERM: Final = FOUR + OLD[4:]
VT100_PLUS: Final = _letters("O", "PQRSTUVW")
CONSOLE: Final = _letters("[[", "ABCDE") + OLD[5:]
PUTTY: Final = {
    "ESC[n~": OLD,
    "Linux": CONSOLE,
    "Xterm R6": XTERM,
    "VT400": OLD,
    "VT100+": VT100_PLUS,
    "SCO": ("", "[N", "", *_letters("[", "PQRST")),
    "Xterm 216+": XTERM,
}
"""F1 to F8 in PuTTY's modes of function keys, without the ESC; empty where Esc and the digit have to do."""
FUNCTION_KEYS: Final = {"linux": CONSOLE, "vt100": VT100_PLUS, "vt220": VT100_PLUS, "putty": OLD}
"""F1 to F8 of each TERM; the others send what xterm sends."""

NAMED: Final = {
    "tab": "\t",
    "shift+tab": "\x1b[Z",
    "enter": "\r",
    "escape": ESC,
    "backspace": "\x7f",
    "delete": "\x1b[3~",
    "up": "\x1b[A",
    "down": "\x1b[B",
    "right": "\x1b[C",
    "left": "\x1b[D",
    "home": "\x1b[1~",
    "end": "\x1b[4~",
    "pageup": "\x1b[5~",
    "pagedown": "\x1b[6~",
    "space": " ",
    "insert": "\x1b[2~",
    "ctrl+home": "\x1b[1;5H",
    "ctrl+end": "\x1b[1;5F",
    "f9": "\x1b[20~",
    "f10": "\x1b[21~",
}
"""What every one of these terminals sends for a key that types nothing."""


def softkey(number: int, sequences: tuple[str, ...] = ()) -> bytes:
    """The bytes of a softkey: its function key, or Esc and the digit where there is none."""
    sequence = sequences[number - 1] if sequences else ""
    return (ESC + (sequence or str(number))).encode()


def sent(key: str, sequences: tuple[str, ...] = ()) -> bytes:
    """The bytes of a key by its name; `sequences` are those of F1 to F8."""
    if len(key) == 2 and key[0] == "f" and key[1] in "12345678":
        return softkey(int(key[1]), sequences)
    if key.startswith("ctrl+") and len(key) == 6:
        return bytes([ord(key[-1]) - 96])
    return NAMED.get(key, key).encode()
