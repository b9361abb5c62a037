"""The registry holds the controls by name and the one way to run a program on any of them.

A control's variant follows a colon: `rosettacnc:easy`.  `nine-series:b-g39.1` is type B that starts with G39.1 corners
in force; a G39 or G39.1 in the program changes them from there on, as on the control.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from core.controls.control_names import CONTROL_NAMES, ControlChoice, display_name, internal_name
from core.controls.control_run import ControlRun
from core.controls.control_tools import ToolTable
from core.controls.iso.arcs import ArcTolerance
from core.controls.iso.dialect import Dialect
from core.controls.iso.flow import MakeControl, ProgramLibrary, no_library
from core.controls.iso.iso_run import run_iso
from core.controls.klartext import control as klartext
from core.controls.klartext.path_functions import KLARTEXT_ARC_TOLERANCE
from core.controls.klartext.reader import is_klartext_text
from core.controls.makers import fanuc, haas, linuxcnc, nine_series, rosettacnc, threeblock
from core.controls.program_text import lines_of
from core.finding import Finding, Severity
from core.progress import Progress, silent
from core.units import Unit

NO_TOOLS: Final[ToolTable] = {}

TINY_SHARE: Final = 1e-7
"""Share of the tool's radius that fits into every contour, so that the stretches are the whole contour."""

MAX_BYTES_FOR_LANGUAGE: Final = 16_384
"""Bytes at the beginning of a program by which its language is recognized."""

_BLANKS: Final = b" \t\r\n\x00\xef\xbb\xbf\xff\xfe"
"""Blanks, line ends and encoding marks; a program of these alone is empty."""

_EMPTY: Final = Finding("EMPTY", Severity.ERROR, "The program is empty.", line=1, column=1)


@dataclass(frozen=True, slots=True)
class UnknownControl:
    """The answer to a name that belongs to no control; `text` lists the names that exist."""

    text: str


@dataclass(frozen=True, slots=True)
class RegisteredControl:
    """One control: its dialect (None for Klartext) and the factory of each of its variants, the default first."""

    dialect: Dialect | None
    variants: Mapping[str, MakeControl | None]
    compared: tuple[str, ...] = ("",)
    """The variants that a comparison shows."""


CONTROLS: Final[Mapping[str, RegisteredControl]] = {
    "threeblock": RegisteredControl(threeblock.DIALECT, {"": threeblock.ThreeBlock}),
    "rosettacnc": RegisteredControl(rosettacnc.DIALECT, rosettacnc.VARIANTS, tuple(rosettacnc.VARIANTS)),
    "nine-series": RegisteredControl(nine_series.DIALECT, nine_series.VARIANTS, ("a", "b")),
    "fanuc": RegisteredControl(fanuc.DIALECT, fanuc.VARIANTS, ("a", "b")),
    "haas": RegisteredControl(haas.DIALECT, haas.VARIANTS, ("a",)),
    "klartext": RegisteredControl(None, {"": None}),
    "linuxcnc": RegisteredControl(linuxcnc.DIALECT, {"": linuxcnc.LinuxCnc}),
}
"""The controls, in the order in which a comparison shows them."""


def arc_tolerance(control: str) -> ArcTolerance:
    """Return how far an arc's radii may differ on a control, by full or short name; KeyError for an unknown one."""
    dialect = CONTROLS[internal_name(control).partition(":")[0]].dialect
    return dialect.arc_tolerance if dialect else KLARTEXT_ARC_TOLERANCE


def is_klartext(control: str) -> bool:
    """True if a control, by its full or short name, reads Klartext; all others read word addresses."""
    return CONTROLS[internal_name(control).partition(":")[0]].dialect is None


def names() -> tuple[str, ...]:
    """Return every control with every variant."""
    return tuple(_joined(name, variant) for name, entry in CONTROLS.items() for variant in entry.variants)


def choices() -> tuple[ControlChoice, ...]:
    """Return every control with every variant, for a list to choose from: the best known first, each with a line."""
    return tuple(
        ControlChoice(
            full := _joined(name, variant),
            display_name(full),
            entry.title,
            f"{entry.variants[variant]}; {entry.about}" if variant else entry.about,
        )
        for name, entry in CONTROL_NAMES.items()
        for variant in CONTROLS[name].variants
    )


def compared() -> tuple[str, ...]:
    """Return the controls that a comparison shows side by side."""
    return tuple(_joined(name, variant) for name, entry in CONTROLS.items() for variant in entry.compared)


def _joined(name: str, variant: str) -> str:
    return f"{name}:{variant}" if variant else name


def reads(control: str, text: bytes) -> bool:
    """True if a control reads the language of a program or of a piece of one: Klartext or word addresses."""
    return is_klartext_text(lines_of(text[:MAX_BYTES_FOR_LANGUAGE])) == is_klartext(control)


def resolve(control: str) -> str | UnknownControl:
    """Return the full name of a control, with the default variant added, or the sentence that lists all controls."""
    name, _, variant = internal_name(control).partition(":")
    entry = CONTROLS.get(name)
    if entry is None or (variant and variant not in entry.variants):
        known = ", ".join(choice.name for choice in choices())
        return UnknownControl(f"No such control. Choose one of: {known}.")
    return _joined(name, variant or next(iter(entry.variants)))


def run(
    text: bytes,
    control: str,
    tools: ToolTable = NO_TOOLS,
    unit: Unit | None = None,
    library: ProgramLibrary = no_library,
    *,
    progress: Progress = silent,
) -> ControlRun:
    """Run a program's text on a control, by its full or short name; no text raises anything but Stopped.

    There must be a control of this name: `resolve` tells.  `unit` counts if the text names none; None is the one in
    which the control usually starts.  `library` finds the programs that a control calls from its memory.
    """
    full = resolve(control)
    assert not isinstance(full, UnknownControl), full.text
    made = _run(text, full, tools, unit, library, progress)
    if made.stretches and made.stops_within(made.stretches[-1]) and not made.endless:
        made = _with_rest_of_contour(made, _run(text, full, tools, unit, library, progress, TINY_SHARE))
    return made if text.strip(_BLANKS) else replace(made, findings=(_EMPTY,))


def _run(
    text: bytes,
    control: str,
    tools: ToolTable,
    unit: Unit | None,
    library: ProgramLibrary,
    progress: Progress,
    share: float = 1.0,
) -> ControlRun:
    """Run a program on a control, given by its full name, at a share of each tool's radius."""
    name, _, variant = control.partition(":")
    entry = CONTROLS[name]
    make = entry.variants[variant]
    if entry.dialect is None or make is None:
        return klartext.run_klartext(text, tools, share, progress)
    dialect = replace(entry.dialect, unit=unit or entry.dialect.unit)
    scaled = {number: replace(tool, diameter=share * tool.diameter) for number, tool in tools.items()}
    return run_iso(text, control, dialect, scaled, make, library, progress)


def _with_rest_of_contour(stopped: ControlRun, whole: ControlRun) -> ControlRun:
    """Return a run that stops within a contour with the rest of the contour at that height, which it may cut already.

    `whole` is the same program with almost no radius.
    """
    stretch, known = stopped.stretches[-1], len(stopped.stretches[-1].programmed)
    longer = next(iter(whole.stretches[len(stopped.stretches) - 1 :]), stretch)
    points = longer.programmed.points
    if stretch.changes or longer.changes or not np.array_equal(points[:known], stretch.programmed.points):
        return stopped
    other_heights = np.flatnonzero(points[known:, 2] != points[:known, 2].min())
    rows = known + int(other_heights[0]) if len(other_heights) else len(points)
    longer = replace(stretch, programmed=longer.programmed.part(0, rows), exit=max(rows - len(points) + longer.exit, 0))
    return replace(stopped, stretches=(*stopped.stretches[:-1], longer))


def run_with_tiny_tool(text: bytes, control: str, tools: ToolTable) -> ControlRun | None:
    """Rerun a stopped Klartext program with almost no radius, so that its stretches are the whole contour.

    None for another control, or if even that stops.
    """
    made = klartext.run_klartext(text, tools, TINY_SHARE) if is_klartext(control) else None
    return made if made and made.stopped_at is None else None
