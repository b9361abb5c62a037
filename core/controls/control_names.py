"""Control names are what operators call each control, with a line about it and cutcomp's internal name for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final


@dataclass(frozen=True, slots=True)
class ControlName:
    """A control's name as typed and shown, its title, and a line about it and about each of its variants."""

    name: str
    title: str
    about: str
    variants: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ControlChoice:
    """One line of a list of controls: `control` is the full name for `registry.run`, the rest is for display."""

    control: str
    name: str
    title: str
    about: str


_SHARP: Final = {"a": "type A, corners by lines", "b": "type B, corners by lines"}
_FANUC: Final = _SHARP | {"c": "type C, G41 moves at once"}

CONTROL_NAMES: Final[Mapping[str, ControlName]] = {
    "fanuc": ControlName(
        "fanuc",
        "Fanuc mill",
        "0i, 16-21, 30i-32i",
        _FANUC | {f"{kind}-arc": f"type {kind.upper()}, sharp corners by arcs" for kind in "abc"},
    ),
    "haas": ControlName(
        "haas",
        "Haas mill",
        "as Fanuc, own alarms",
        {
            "a": "settings 43 A, 58 FANUC",
            "b": "settings 43 B, 58 FANUC",
            "a-yasnac": "settings 43 A, 58 YASNAC",
            "b-yasnac": "settings 43 B, 58 YASNAC",
        },
    ),
    "linuxcnc": ControlName("linuxcnc", "LinuxCNC", "2.4 and later, as its own interpreter runs it"),
    "klartext": ControlName("heidenhain", "HEIDENHAIN Klartext", "TNC conversational with RL, RR, APPR and DEP"),
    "rosettacnc": ControlName(
        "rosettacnc",
        "RosettaCNC",
        "G41 and G41.1",
        {"nist": "entry NIST", "easy": "entry Easy Lead-In", "normal": "entry Normal"},
    ),
    "nine-series": ControlName(
        "allen-bradley",
        "Allen-Bradley 9/Series",
        "Rockwell 8520 mill",
        _SHARP
        | {f"{kind}-g39": f"type {kind.upper()}, starts in G39" for kind in "ab"}
        | {f"{kind}-g39.1": f"type {kind.upper()}, starts in G39.1" for kind in "ab"},
    ),
    "threeblock": ControlName("three-block", "Three-block control", "older US mill: radius with T, reads 3 blocks"),
}
"""The names, by the internal name, in the order that lists show."""

_INTERNAL_NAMES: Final = {entry.name: name for name, entry in CONTROL_NAMES.items()}


def internal_name(control: str) -> str:
    """Return a typed name of a control with cutcomp's own name in place of the one that operators use."""
    name, colon, variant = control.strip().lower().partition(":")
    return f"{_INTERNAL_NAMES.get(name, name)}{colon}{variant}"


def display_name(control: str) -> str:
    """Return the name that operators type and read for a control's full or short internal name."""
    name, colon, variant = control.partition(":")
    return f"{CONTROL_NAMES[name].name if name in CONTROL_NAMES else name}{colon}{variant}"
