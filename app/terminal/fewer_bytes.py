"""This module sends the same picture in fewer bytes, for slow lines.

Textual sends every piece of text with all of its colors before it and a reset after it.  Here a color is sent only
when it changes, and blanks are sent in any text color, which does not show on them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final, NamedTuple

TOKEN: Final = re.compile(
    r"\x1b\[([0-9;]*)m"
    r"|(\x1b\[[0-9]+;[0-9]+H|\r\n)"
    r"|(\x1b\[[0-?]*[ -/]*[@-~]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|[\x00-\x1f\x7f])"
    r"|([^\x00-\x1f\x7f]+)"
)
"""A style; a cursor position; another control sequence; text."""


class Style(NamedTuple):
    """What a control sequence turns on after a reset: attributes, text color (ink), background (paper)."""

    attributes: frozenset[str] = frozenset()
    ink: str = "39"
    paper: str = "49"


PLAIN_STYLE: Final = Style()
SHOWN_ON_BLANKS: Final = frozenset({"4", "7", "9", "21", "53"})
"""Attributes that show on a blank: underlines, reverse, strikethrough, overline."""


@lru_cache(256)
def style_of(parameters: str) -> Style:
    """Return the style that a sequence's parameters give after a reset."""
    attributes, ink, paper = set(), PLAIN_STYLE.ink, PLAIN_STYLE.paper
    rest = parameters.split(";")
    while rest:
        number = rest.pop(0)
        if number in ("38", "48") and rest:
            length = 2 if rest[0] == "5" else 4
            color, rest = ";".join([number, *rest[:length]]), rest[length:]
            ink, paper = (color, paper) if number == "38" else (ink, color)
        elif len(number) > 1 and number[:-1] in ("3", "9"):
            ink = number
        elif number[:-1] in ("4", "10"):
            paper = number
        else:
            attributes.add(number)
    return Style(frozenset(attributes), ink, paper)


@lru_cache(512)
def style_change(now: Style, then: Style) -> str:
    """Return the shortest sequence that changes one style into another."""
    if now == then:
        return ""
    if then == PLAIN_STYLE:
        return "\x1b[0m"
    lists = ["0", *_added(PLAIN_STYLE, then)], _added(now, then)
    return min((f"\x1b[{';'.join(codes)}m" for codes in lists[: 1 if now.attributes - then.attributes else 2]), key=len)


def _added(base: Style, then: Style) -> list[str]:
    """Return the parameters that change `base` into a style with all of its attributes."""
    colors = [new for old, new in ((base.ink, then.ink), (base.paper, then.paper)) if old != new]
    return [*sorted(then.attributes - base.attributes), *colors]


def alike_on_blanks(now: Style, then: Style) -> bool:
    """True if blanks look the same in both styles."""
    visible = (now.attributes | then.attributes) & SHOWN_ON_BLANKS
    return not visible and now.paper == then.paper


@dataclass(slots=True)
class Pen:
    """What goes to the terminal, and the style in force."""

    now: Style = PLAIN_STYLE
    out: list[str] = field(default_factory=list)

    def has(self, text: str, wanted: Style) -> bool:
        """True if this text can be written without a change of style."""
        return self.now == wanted or (text.isspace() and alike_on_blanks(self.now, wanted))

    def write(self, text: str, wanted: Style) -> None:
        """Write text in a style."""
        if not self.has(text, wanted):
            self.turn(wanted)
        self.out.append(text)

    def turn(self, wanted: Style) -> None:
        """Change to another style."""
        self.out.append(style_change(self.now, wanted))
        self.now = wanted
