"""This module rejoins keys that a link has split: the bytes of a key may arrive in pieces, with pauses.

An arrow or a function key is sent as Esc and more characters.  If the rest came late, Esc would act by itself and the
rest would be typed: `[D`, the rest of a left arrow, has a letter that answers questions.  So Esc waits for a rest
as long as ESCDELAY says; a rest that comes even later is neither a key nor text, but is reported.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

ESC: Final = "\x1b"
TORN: Final = "torn"
"""Yielded in place of characters for a key whose pieces came too far apart."""
UNENDED: Final = "unended"
"""Yielded in place of characters for pasted text whose end did not come."""
KEY_WARNINGS: Final = {
    TORN: "The link split a key in two: the first part was taken for Esc. Look, and press it again.",
    UNENDED: "Pasted text came without its end: nothing of it was taken. Look, and type it or paste it again.",
}
"""What the operator reads about them."""
ESC_SECONDS: Final = 0.3
"""Seconds that Esc waits for the rest of a key, unless ESCDELAY in the environment gives milliseconds."""
SAME_KEY_SECONDS: Final = 0.1
"""Seconds within which Esc and a character are one key, as a terminal sends it; fingers take longer."""
REST_SECONDS: Final = 1.0
"""Seconds that a key which has certainly begun waits for its rest."""
PASTE_SECONDS: Final = 2.0
"""Seconds after the last byte of pasted text within which its end must come."""
MAX_PASTED: Final = 20_000
"""The most characters of pasted text that are kept; no field and no line takes as many."""
LATE_SECONDS: Final = 2.0
"""Seconds after Esc has acted, or a begun key has timed out, in which the rest of a key is recognized."""
MAX_KEY_LENGTH: Final = 32
"""The most characters of a key."""
WHOLE: Final = re.compile(r"\x1b\[\[?[0-?]*[ -/]*[A-Za-z~^@]")
"""A key or a report by ECMA-48, except those that end in a bracket, which is typed in formulas of NC programs.
Those with a second bracket are the first function keys of the Linux console."""
BEGUN: Final = re.compile(r"\x1b(?:O|\[\[?[0-?]*[ -/]*)")
CLICK: Final = "\x1b[M"
"""A mouse click in the form that another program has asked for: three characters follow it."""
PASTE: Final = "\x1b[200~"
PASTED: Final = "\x1b[201~"


def delay(environment: Mapping[str, str]) -> float:
    """Return the seconds that Esc waits."""
    asked = environment.get("ESCDELAY", "")
    return max(int(asked), 1) / 1000 if asked.isascii() and asked.isdigit() else ESC_SECONDS


@dataclass(slots=True)
class Joined:
    """Characters that have arrived and make no whole key yet; times are seconds of any clock that never goes back.

    `known` holds keys of several characters that are complete as they are.  `held` begins with Esc or, after a key
    that was cut, with the beginning of its rest; `paste` is the pasted text so far.
    `cut` is the beginning of a key whose rest did not come in time, and `escaped` the time when it was given up.
    """

    known: Container[str]
    delay: float = ESC_SECONDS
    held: str = ""
    paste: str | None = None
    begun: float = 0.0
    last: float = 0.0
    escaped: float = -LATE_SECONDS
    cut: str = ESC
    clicked: int = 0

    @property
    def due(self) -> float | None:
        """The time at which to call `tick` if nothing arrives; None if nothing is held."""
        if self.paste is not None:
            return self.last + PASTE_SECONDS
        if not self.held:
            return None
        if self.held == ESC:
            return self.begun + self.delay
        return self.last + (SAME_KEY_SECONDS if self.held == "O" else REST_SECONDS)

    def feed(self, text: str, now: float) -> Iterator[str]:
        """Yield whole keys, single characters, whole pastes and `TORN` from what has arrived."""
        self.last = now if text else self.last
        while text:
            if self.paste is None:
                yield from self._take(text[0], now)
                text = text[1:]
                continue
            body, end, text = (self.paste + text).partition(PASTED)
            # the last characters may begin the end marker
            short = body if len(body) <= MAX_PASTED else body[:MAX_PASTED] + body[-len(PASTED) :]
            self.paste = None if end else short
            if end:
                yield f"{PASTE}{short}{PASTED}"
        # the characters of a click come in the same piece of text
        self.clicked = 0

    def tick(self, now: float) -> Iterator[str]:
        """Yield what is held, if its time is up."""
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
            yield from self._after_escape(character, now)
        elif held or (now - self.escaped < LATE_SECONDS and self._continues_cut_key(character)):
            self.held += character
            yield from self._grown(character, now)
        else:
            self.escaped = -LATE_SECONDS
            yield character

    def _continues_cut_key(self, character: str) -> bool:
        """True if this may be the rest of a key that was cut, or the beginning of that rest."""
        if self.cut == ESC:
            return character in "[O"
        key = self.cut + character
        return key in self.known or (WHOLE.fullmatch(key) or BEGUN.fullmatch(key)) is not None

    def _after_escape(self, character: str, now: float) -> Iterator[str]:
        """Yield Alt and a character, if both came in one packet, or else two keys."""
        self.held = ""
        if now - self.begun <= SAME_KEY_SECONDS:
            yield ESC + character
        else:
            yield from (ESC, character)

    def _grown(self, character: str, now: float) -> Iterator[str]:
        """Handle the held characters after one more: a key, still the beginning of one, or no key."""
        late = self.held[0] != ESC
        key = self.cut + self.held if late else self.held
        if key in self.known or WHOLE.fullmatch(key):
            if late:
                yield self._torn()
            else:
                yield from self._whole()
        elif not BEGUN.fullmatch(key) or len(key) > MAX_KEY_LENGTH:
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
        """Drop a key whose pieces came too far apart: it is neither Esc nor text."""
        self.held, self.escaped = "", -LATE_SECONDS
        return TORN

    def _as_typed(self) -> Iterator[str]:
        """Yield what is held key by key: it is not part of a longer key."""
        held, self.held, self.escaped = self.held, "", -LATE_SECONDS
        yield from held
