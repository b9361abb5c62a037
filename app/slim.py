"""The same picture in fewer bytes, for lines that are slow.

Textual sends every piece of text with all of its colours before it and a reset behind it.  Here a colour is sent when
it changes, and blanks are sent in whatever ink there is: no one sees the ink of a blank.
"""

from __future__ import annotations

import re
from typing import Final, NamedTuple

from core.records import dataclass, field

TOKEN: Final = re.compile(
    r"\x1b\[([0-9;]*)m"
    r"|(\x1b\[[0-9]+;[0-9]+H|\r\n)"
    r"|(\x1b\[[0-?]*[ -/]*[@-~]|\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)|[\x00-\x1f\x7f])"
    r"|([^\x00-\x1f\x7f]+)"
)
"""A style; a place; another control sequence; text."""


class Style(NamedTuple):
    """What a control sequence switches on after a reset: attributes, ink, paper."""

    attributes: frozenset[str] = frozenset()
    ink: str = "39"
    paper: str = "49"


PLAIN: Final = Style()
SHOWN_ON_BLANKS: Final = frozenset({"4", "7", "9", "21", "53"})
"""Attributes that a blank shows: underlines, reverse, strike through, overline."""


def read(parameters: str) -> Style:
    """The style of a sequence's parameters, as they act after a reset."""
    attributes, ink, paper = set(), PLAIN.ink, PLAIN.paper
    rest = parameters.split(";")
    while rest:
        number = rest.pop(0)
        if number in ("38", "48") and rest:
            length = 2 if rest[0] == "5" else 4
            colour, rest = ";".join([number, *rest[:length]]), rest[length:]
            ink, paper = (colour, paper) if number == "38" else (ink, colour)
        elif len(number) > 1 and number[:-1] in ("3", "9"):
            ink = number
        elif number[:-1] in ("4", "10"):
            paper = number
        else:
            attributes.add(number)
    return Style(frozenset(attributes), ink, paper)


def change(now: Style, then: Style) -> str:
    """What makes one style of another."""
    if now == then:
        return ""
    if then == PLAIN:
        return "\x1b[0m"
    gone = now.attributes - then.attributes
    base = PLAIN if gone else now
    parts = ["0"] if gone else []
    parts += sorted(then.attributes - base.attributes)
    parts += [new for old, new in ((base.ink, then.ink), (base.paper, then.paper)) if old != new]
    return f"\x1b[{';'.join(parts)}m"


def alike_on_blanks(now: Style, then: Style) -> bool:
    """Whether blanks look the same in both."""
    shown = (now.attributes | then.attributes) & SHOWN_ON_BLANKS
    return not shown and now.paper == then.paper


def slim(data: str) -> str:
    """The text for the terminal with the same effect; it begins and ends in plain style."""
    pen = _Pen()
    wanted = PLAIN
    for style, place, other, text in TOKEN.findall(data):
        if text:
            pen.write(text, wanted)
        elif place:
            pen.out.append(place)
        elif other:
            pen.turn(wanted)
            pen.out.append(other)
        else:
            wanted = PLAIN if style in ("", "0") else read(style)
    pen.turn(PLAIN)
    return "".join(pen.out)


@dataclass(slots=True)
class _Pen:
    """What goes to the terminal, and the style it writes in just now."""

    now: Style = PLAIN
    out: list[str] = field(default_factory=list)

    def write(self, text: str, wanted: Style) -> None:
        if not (text.isspace() and alike_on_blanks(self.now, wanted)):
            self.turn(wanted)
        self.out.append(text)

    def turn(self, wanted: Style) -> None:
        self.out.append(change(self.now, wanted))
        self.now = wanted
