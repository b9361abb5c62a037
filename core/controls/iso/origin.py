"""Where a program counts from: work offsets, local shifts and presets; and the codes that take axis words for
themselves instead of moving there: G28, G52, G53, G92, G10.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from core.controls.iso.dialect import Code, Do
from core.controls.iso.words import Block
from core.controls.moves import Point3
from core.finding import Severity

if TYPE_CHECKING:
    from core.controls.iso.machine import Machine


ONCE: Final = frozenset((Do.HOME, Do.SHIFT, Do.PRESET, Do.MACHINE, Do.DATA))
"""What takes a block's axis words for itself."""

_ZERO: Final[Point3] = (0.0, 0.0, 0.0)
_G54: Final = 540
_G53: Final = 530


@dataclass(frozen=True, slots=True)
class Origin:
    """The work offsets by code in tenths, the one in force, and the shift of G52 or G92 on top, millimeters."""

    systems: Mapping[int, Point3] = field(default_factory=lambda: MappingProxyType({}))
    system: int = _G54
    local: Point3 = _ZERO

    @property
    def shift(self) -> Point3:
        """The program's origin."""
        base = self.systems.get(self.system, _ZERO)
        return base[0] + self.local[0], base[1] + self.local[1], base[2] + self.local[2]


def changed(machine: Machine, code: Code, block: Block) -> None:
    """Another work offset, or no G52 and G92 any more."""
    if code.do is Do.UNSHIFT:
        _shifted(machine, _ZERO)
    else:
        machine.origin = _selected(machine, code.value, block)
        machine.shift = machine.origin.shift


def _selected(machine: Machine, code: int, block: Block) -> Origin:
    """The origin with another work offset in force; one that the program did not set is taken as zero, and told."""
    if code not in machine.origin.systems and code != _G54:
        text = f"The offset of G{code / 10:g} is not in the program; it is taken as zero."
        machine.log.tell(Severity.WARNING, "OFFSET", text, block.line, block.column("G", code))
    return replace(machine.origin, system=code)


def run_once(machine: Machine, code: Code, block: Block) -> None:
    """Runs a code of `ONCE` with its block."""
    match code.do:
        case Do.SHIFT:
            _shifted(machine, _locally(machine, block, machine.origin.local))
        case Do.PRESET:
            _preset(machine, block)
        case Do.DATA:
            _offset_data(machine, block)
        case Do.HOME:
            _home(machine, block)
        case Do.DWELL:
            _dwell(machine, block)
        case _:
            _in_machine(machine, block)


def _dwell(machine: Machine, block: Block) -> None:
    """G4: X beside it is a time, and Y or Z have no place there; nothing moves."""
    wrong = next((letter for letter in "YZ" if letter in block.words), None)
    if wrong is not None:
        text = f"{wrong} beside G4 may be a move or nothing; write it in a block of its own."
        machine.log.stop("DWELL", text, block.line, block.column(wrong))
    if "X" in block.words:
        text = "X beside G4 is taken as the time to wait; nothing moves."
        machine.log.tell(Severity.INFO, "DWELL", text, block.line, block.column("X"))
    if machine.follower.active:
        machine.follower.idle(block)


def _locally(machine: Machine, block: Block, old: Point3) -> Point3:
    """A point of a block's axis words in millimeters, the old coordinate where there is none."""
    x, y, z = (
        block.words[letter] * machine.scale if letter in block.words else before
        for letter, before in zip("XYZ", old, strict=True)
    )
    return x, y, z


def _shifted(machine: Machine, local: Point3) -> None:
    machine.origin = replace(machine.origin, local=local)
    machine.shift = machine.origin.shift


def _preset(machine: Machine, block: Block) -> None:
    """G92: the origin moves so that the present position reads as written."""
    base = machine.origin.systems.get(machine.origin.system, _ZERO)
    reads = _locally(machine, block, _ZERO)
    local = [
        machine.position[axis] - reads[axis] - base[axis] if "XYZ"[axis] in block.words else machine.origin.local[axis]
        for axis in range(3)
    ]
    _shifted(machine, (local[0], local[1], local[2]))


def _offset_data(machine: Machine, block: Block) -> None:
    """G10 L2 P: a work offset is set; other data are not understood."""
    number = int(block.words.get("P", -1.0))
    if block.words.get("L") != 2.0 or not 0 <= number <= 6 or "R" in block.words:
        text = "Only work offsets are set here: G10 L2 P1 to P6 with X, Y, Z; set other data on the control."
        machine.log.stop("DATA", text, block.line, block.column("L"))
    code = _G53 + 10 * number if number else machine.origin.system
    old = machine.origin.systems.get(code, _ZERO)
    systems = {**machine.origin.systems, code: _locally(machine, block, old)}
    machine.origin = replace(machine.origin, systems=MappingProxyType(systems))
    machine.shift = machine.origin.shift


def _home(machine: Machine, block: Block) -> None:
    """G28, G30: by way of the block's point to the reference point, which is taken as machine zero."""
    text = "The reference point is not known; it is taken as the machine's zero."
    machine.log.tell(Severity.WARNING, "HOME", text, block.line, block.column("G"))
    mode, machine.mode = machine.mode, 0
    named = [letter in block.words for letter in "XYZ"]
    if any(named):
        machine.straight(block, machine.target(block.words))
    x, y, z = (
        0.0 if one or not any(named) else now for one, now in zip(named, machine.position, strict=True)
    )  # fmt: skip
    machine.straight(block, (x, y, z))
    machine.mode = mode


def _in_machine(machine: Machine, block: Block) -> None:
    """G53: this block counts from the machine's zero."""
    if machine.mode not in (0, 10) or machine.incremental:
        text = "G53 goes with G0 or G1 in absolute positions; write G90 G0 G53."
        machine.log.stop("MOTION", text, block.line, block.column("G", _G53))
    machine.straight(block, _locally(machine, block, machine.position))
