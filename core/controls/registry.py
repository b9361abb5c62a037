"""The controls by name, and the one way to run a program on any of them.

A control's variant follows a colon: `rosettacnc:easy`.  `nine-series:b-g39.1` is type B that starts with G39.1
corners in force; a G39 or G39.1 in the program changes them from there on, as on the control.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final

from core.controls.control_run import Run
from core.controls.control_tools import ToolTable
from core.controls.iso.arcs import ArcRadii
from core.controls.klartext import control as klartext
from core.controls.klartext import path_functions
from core.controls.makers import linuxcnc, nine_series, rosettacnc, threeblock
from core.controls.program_text import lines_of
from core.finding import Finding, Severity
from core.units import Unit

Control = Callable[[bytes, str, ToolTable, Unit | None], Run]
"""Runs a program's text on a variant of a control with these tools; never raises for any text.

The unit is the one in force at the start, None for the one that the control usually starts in.
"""

NO_TOOLS: Final = ToolTable()

_NOTHING: Final = b" \t\r\n\x00\xef\xbb\xbf\xff\xfe"
"""Blanks, line ends and the marks of encodings: of these alone is an empty program."""

_EMPTY: Final = Finding("EMPTY", Severity.ERROR, "The program is empty; there is nothing to run.", line=1, column=1)


@dataclass(frozen=True, slots=True)
class UnknownControl:
    """A name that belongs to no control; `text` says which there are."""

    text: str


@dataclass(frozen=True, slots=True)
class Entry:
    """One control: what runs it, how far the radii of an arc may differ on it, its variants (the first is the default)
    and those a comparison shows.
    """

    control: Control
    arc_radii: ArcRadii
    variants: tuple[str, ...] = ("",)
    compared: tuple[str, ...] = ("",)


def _klartext(text: bytes, variant: str, tools: ToolTable, _: Unit | None) -> Run:
    """Klartext says its unit itself."""
    return klartext.run(text, variant, tools)


CONTROLS: Final[Mapping[str, Entry]] = MappingProxyType(
    {
        "threeblock": Entry(threeblock.run, threeblock.DIALECT.arc_radii),
        "rosettacnc": Entry(rosettacnc.run, rosettacnc.DIALECT.arc_radii, rosettacnc.ENTRIES, rosettacnc.ENTRIES),
        "nine-series": Entry(nine_series.run, nine_series.DIALECT.arc_radii, nine_series.VARIANTS, ("a", "b")),
        "klartext": Entry(_klartext, path_functions.ARC_RADII),
        "linuxcnc": Entry(linuxcnc.run, linuxcnc.DIALECT.arc_radii),
    }
)
"""The controls, in the order a comparison shows them."""


def arc_radii(control: str) -> ArcRadii:
    """How far the radii of an arc may differ on a control, by its full or short name."""
    return CONTROLS[control.partition(":")[0]].arc_radii


def names() -> tuple[str, ...]:
    """Every control with every variant, as it can be asked for."""
    return tuple(_joined(name, variant) for name, entry in CONTROLS.items() for variant in entry.variants)


def compared() -> tuple[str, ...]:
    """The controls a comparison shows side by side."""
    return tuple(_joined(name, variant) for name, entry in CONTROLS.items() for variant in entry.compared)


def _joined(name: str, variant: str) -> str:
    return f"{name}:{variant}" if variant else name


_BEGINS: Final = re.compile(r"\s*+(?:[0-9]++\s++)?BEGIN\s++PGM\b", re.IGNORECASE)


def reads(control: str, text: bytes) -> bool:
    """Whether a control reads the language a program is written in: Klartext begins with BEGIN PGM."""
    klartext_text = _BEGINS.match("\n".join(lines_of(text[:4096]))) is not None
    return klartext_text == control.startswith("klartext")


def resolve(control: str) -> str | UnknownControl:
    """The full name of a control, the default variant added; or the sentence that says which there are."""
    name, _, variant = control.strip().lower().partition(":")
    entry = CONTROLS.get(name)
    if entry is None or (variant and variant not in entry.variants):
        return UnknownControl(f"There is no such control; there are {', '.join(names())}.")
    return _joined(name, variant or entry.variants[0])


def run(text: bytes, control: str, tools: ToolTable = NO_TOOLS, unit: Unit | None = None) -> Run | UnknownControl:
    """A program's text on a control, by the control's full or short name; `unit` where the text names none."""
    full = resolve(control)
    if isinstance(full, UnknownControl):
        return full
    name, _, variant = full.partition(":")
    made = CONTROLS[name].control(text, variant, tools, unit)
    return made if text.strip(_NOTHING) else replace(made, findings=(_EMPTY,))


def programmed(text: bytes, control: str, tools: ToolTable = NO_TOOLS) -> Run | None:
    """The run of a text that alarms, with next to no radius, so that its stretches tell the whole contour.

    None where a control has no such run, or where even that stops.
    """
    if control != "klartext":
        return None
    made = klartext.programmed(text, tools)
    return made if made.stopped_at is None else None
