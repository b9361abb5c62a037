"""What a program can read of the machine itself: position, tool, modes, under LinuxCNC's numbers and names."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from core.controls.moves import Plane, Point3
from core.controls.program_text import quoted
from core.units import Unit, from_mm

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


Look = Callable[["Machine", Any], float | str]
"""A value by number or name; a sentence where it is not known."""

_AXES: Final = {5420: 0, 5421: 1, 5422: 2, "_X": 0, "_Y": 1, "_Z": 2}
_PLANES: Final = {Plane.XY: 170.0, Plane.ZX: 180.0, Plane.YZ: 190.0}

_KEPT: Final = """
LINE MOTION_MODE PLANE CCOMP METRIC IMPERIAL ABSOLUTE INCREMENTAL INVERSE_TIME UNITS_PER_MINUTE UNITS_PER_REV
COORD_SYSTEM TOOL_OFFSET RETRACT_R_PLANE RETRACT_OLD_Z SPINDLE_RPM_MODE SPINDLE_CSS_MODE IJK_ABSOLUTE_MODE
LATHE_DIAMETER_MODE LATHE_RADIUS_MODE SPINDLE_ON SPINDLE_CW MIST FLOOD SPEED_OVERRIDE FEED_OVERRIDE ADAPTIVE_FEED
FEED_HOLD FEED RPM CURRENT_TOOL SELECTED_POCKET CURRENT_POCKET X Y Z A B C U V W ABS_X ABS_Y ABS_Z ABS_A ABS_B ABS_C
VALUE CALL_LEVEL REMAP_LEVEL SELECTED_TOOL VALUE_RETURNED TASK VMAJOR VMINOR
"""

NAMES: Final = frozenset(f"_{name}" for name in _KEPT.split())
"""Names that the control keeps itself."""


def numbered(machine: Machine, index: int) -> float | str:
    """Parameters from 5001 on."""
    if index in _AXES:
        if machine.follower.active:
            return "The position cannot be read under compensation; write G40 before it."
        return _read(machine, machine.position, _AXES[index])
    match index:
        case 5220:
            return _system(machine)[1]
        case 5400:
            return float(machine.tool)
        case 5410:
            tool = machine.tools.get(machine.tool)
            return from_mm(tool.diameter_mm(machine.unit), machine.unit) if tool else 0.0
        case _:
            return f"#{index} belongs to the control and is not known before it runs; write the number itself."


def named(machine: Machine, name: str) -> float | str:
    """Names of `NAMES`."""
    if name in _AXES:
        return _read(machine, machine.follower.place(machine.position), _AXES[name])
    values: dict[str, float] = {
        "_PLANE": _PLANES[machine.plane],
        "_METRIC": float(machine.unit is Unit.MM),
        "_IMPERIAL": float(machine.unit is Unit.IN),
        "_ABSOLUTE": float(not machine.incremental),
        "_INCREMENTAL": float(machine.incremental),
        "_IJK_ABSOLUTE_MODE": float(machine.absolute_centers),
        "_COORD_SYSTEM": _system(machine)[0],
        "_CURRENT_TOOL": float(machine.tool),
        "_SELECTED_TOOL": float(machine.next_tool),
    }
    if name in values:
        return values[name]
    return f"#<{quoted(name.lower())}> is not known before the control runs; write the number itself."


def _read(machine: Machine, at: Point3, axis: int) -> float:
    """A coordinate as the program counts now."""
    return from_mm(at[axis] - machine.shift[axis], machine.unit)


def _system(machine: Machine) -> tuple[float, float]:
    """The work offset in force: its code in tenths, and its number from 1."""
    code = machine.origin.system
    return float(code), float((code - 530) // 10 if code <= 590 else code - 584)
