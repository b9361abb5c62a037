"""Help for a field: what it means, what may be typed into it, and its picture."""

from __future__ import annotations

from typing import Final

from app.screens.topics import topic_of
from core.program.fields import Field, range_of
from core.units import Kind, Unit

_HOW: Final = {
    Kind.LENGTH: "A number, a fraction (1 1/2), a sum (2.5-.125, 25.4/2), or another unit (12.7mm, .5in).",
    Kind.FEED: "A number in program units a minute, or another unit (500mm, 20in).",
    Kind.ANGLE: "Degrees, counter-clockwise from +X.",
    Kind.COUNT: "A whole number.",
    Kind.PERCENT: "A percentage.",
}


def field_help(one: Field, unit: Unit) -> tuple[str, ...]:
    """What a field means and what may be typed into it, in sentences, then its picture."""
    lines = [one.label, one.prompt]
    if one.choices:
        lines.append(f"Choices: {', '.join(one.choices)}. Space, left and right step; letters spell one.")
    elif one.kind is not Kind.TEXT:
        lines.append(_HOW[one.kind])
    if taken := range_of(one, unit):
        lines.append(f"{taken[0].upper()}{taken[1:]}.")
    topic = topic_of(one)
    return tuple(lines) if topic is None else (*lines[:2], topic.words, *lines[2:], *topic.picture)
