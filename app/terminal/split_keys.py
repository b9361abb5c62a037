"""Keys put together again that a link has split: the bytes of a key can arrive in pieces, and apart.

An arrow or a function key is sent as Esc and more characters.  Where the rest comes late, Esc would act by itself and
the rest be typed: `[D`, the rest of an arrow to the left, is a letter that answers questions.  So Esc waits for a rest
as long as ESCDELAY says; and a rest that comes even later is no key and no text, but is told.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

ESC: Final = "\x1b"
TORN: Final = "torn"
"""In place of characters: the rest of a key whose Esc has been taken for the key Esc."""
UNENDED: Final = "unended"
"""In place of characters: pasted text whose end did not come."""
TOLD: Final = {
    TORN: "The link split a key in two: the first part was taken for Esc. Look, and press it again.",
    UNENDED: "Pasted text came without its end: nothing of it was taken. Look, and type it or paste it again.",
}
"""What is said of them."""
DELAY: Final = 0.3
"""Seconds Esc waits for the rest of a key, unless the environment's ESCDELAY says how many milliseconds."""
TOGETHER: Final = 0.1
"""Seconds within which Esc and a character are one key, as a terminal sends it; fingers take longer."""
REST: Final = 1.0
"""Seconds a key that has certainly begun waits for its rest."""
PASTING: Final = 2.0
"""Seconds after the last byte of pasted text in which its end has to come."""
MOST: Final = 20_000
"""Characters of pasted text that are held; no field and no line takes as many."""
LATE: Final = 2.0
"""Seconds behind Esc, or behind a key told torn, in which the rest of a key is recognized."""
LONGEST: Final = 32
"""Characters of the longest key."""
WHOLE: Final = re.compile(r"\x1b\[\[?[0-?]*[ -/]*[A-Za-z~^@]")
"""A key or a report as ECMA-48 has them, but for brackets at the end: those are typed in formulas of NC programs.
With a second bracket, the Linux console's first function keys."""
BEGUN: Final = re.compile(r"\x1b(?:O|\[\[?[0-?]*[ -/]*)")
CLICK: Final = "\x1b[M"
"""A click of the mouse, asked for by another program: three characters follow it."""
PASTE: Final = "\x1b[200~"
PASTED: Final = "\x1b[201~"


def delay(environment: Mapping[str, str]) -> float:
    """Seconds that Esc waits."""
    asked = environment.get("ESCDELAY", "")
    return max(int(asked), 1) / 1000 if asked.isascii() and asked.isdigit() else DELAY


@dataclass(slots=True)
class Joined:
    """What has arrived and is no whole key yet; times are seconds of any clock that never goes back.

    `known` are keys of more than one character that are whole as they stand.  `held` begins with Esc, or, behind a
    key that was cut, with what the rest of it begins with; `paste` is what was pasted so far.
    `cut` is the beginning of a key whose rest did not come in time, and `escaped` when that was found.
    """

    known: Container[str]
    delay: float = DELAY
    held: str = ""
    paste: str | None = None
    begun: float = 0.0
    last: float = 0.0
    escaped: float = -LATE
    cut: str = ESC
    clicked: int = 0

    @property
    def due(self) -> float | None:
        """When `tick` is to be called if nothing arrives; None where nothing is held."""
        if self.paste is not None:
            return self.last + PASTING
        if not self.held:
            return None
        if self.held == ESC:
            return self.begun + self.delay
        return self.last + (TOGETHER if self.held == "O" else REST)

    def feed(self, text: str, now: float) -> Iterator[str]:
        """Whole keys, single characters, whole pastes and `TORN`, out of what has arrived."""
        self.last = now if text else self.last
        while text:
            if self.paste is None:
                yield from self._take(text[0], now)
                text = text[1:]
                continue
            body, end, text = (self.paste + text).partition(PASTED)
            # the last characters may be the beginning of the end
            short = body if len(body) <= MOST else body[:MOST] + body[-len(PASTED) :]
            self.paste = None if end else short
            if end:
                yield f"{PASTE}{short}{PASTED}"
        # a click's characters come with it
        self.clicked = 0

    def tick(self, now: float) -> Iterator[str]:
        """What is held, if its time is over."""
        if self.due is None or now < self.due:
            return
        if self.paste is not None:
            self.paste = None
            yield UNENDED
        elif self.held == ESC or self.held.startswith(f"{ESC}["):
            self.cut, self.held, self.escaped = self.held, "", now
            yield ESC if self.cut == ESC else TORN
        else:
            yield from self._as_typed()

    def _take(self, character: str, now: float) -> Iterator[str]:
        held = self.held
        if self.clicked:
            self.clicked -= 1
        elif character == ESC:
            yield from (self._torn(),) if held.startswith(f"{ESC}[") else self._as_typed()
            self.held, self.begun = ESC, now
        elif held == ESC and character not in "[O":
            yield from self._behind_escape(character, now)
        elif held or (now - self.escaped < LATE and self._goes_on(character)):
            self.held += character
            yield from self._grown(character, now)
        else:
            self.escaped = -LATE
            yield character

    def _goes_on(self, character: str) -> bool:
        """Whether this may be the rest of a key that was cut, or its beginning."""
        if self.cut == ESC:
            return character in "[O"
        key = self.cut + character
        return key in self.known or (WHOLE.fullmatch(key) or BEGUN.fullmatch(key)) is not None

    def _behind_escape(self, character: str, now: float) -> Iterator[str]:
        """Alt and a character in one packet, or two keys one after the other."""
        self.held = ""
        if now - self.begun <= TOGETHER:
            yield ESC + character
        else:
            yield from (ESC, character)

    def _grown(self, character: str, now: float) -> Iterator[str]:
        """What is held with one character more: a key, still the beginning of one, or no key."""
        late = self.held[0] != ESC
        key = self.cut + self.held if late else self.held
        if key in self.known or WHOLE.fullmatch(key):
            if late:
                yield self._torn()
            else:
                yield from self._whole()
        elif not BEGUN.fullmatch(key) or len(key) > LONGEST:
            self.held = self.held[:-1]
            yield from self._as_typed()
            yield from self._take(character, now)

    def _whole(self) -> Iterator[str]:
        key, self.held = self.held, ""
        if key == PASTE:
            self.paste = ""
        elif key == CLICK:
            self.clicked = 3
        else:
            yield key

    def _torn(self) -> str:
        """A key whose pieces came too far apart: neither Esc nor text."""
        self.held, self.escaped = "", -LATE
        return TORN

    def _as_typed(self) -> Iterator[str]:
        """What is held, key by key: it was no part of a longer one."""
        held, self.held, self.escaped = self.held, "", -LATE
        yield from held
