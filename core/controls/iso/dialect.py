"""Dialects: what the G and M codes of a word-address control are, as frozen data.

Codes are in tenths (G41.1 is 411).  A group holds the codes of which a block takes one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from types import MappingProxyType
from typing import Final

from core.controls.iso.arcs import USUAL_ARC_TOLERANCE, ArcTolerance
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.reader import PLAIN_SYNTAX, SWITCHES, Block, Syntax
from core.controls.moves import Plane
from core.units import Unit


class CodeAction(Enum):
    """What a G code makes the machine do."""

    MOTION = auto()
    CYCLE = auto()
    PLANE = auto()
    UNITS = auto()
    SIDE = auto()
    DISTANCE = auto()
    CENTERS = auto()
    SYSTEM = auto()
    SHIFT = auto()
    PRESET = auto()
    UNSHIFT = auto()
    HOME = auto()
    MACHINE = auto()
    DWELL = auto()
    RATE = auto()
    SPINDLE = auto()
    RETRACT = auto()
    MODE = auto()
    DATA = auto()
    LENGTH = auto()
    """A tool length offset on a control that shifts the position by it; its axis words are the offset."""
    SKIP = auto()
    TRANSFORM = auto()
    """Scaling, mirror image, rotation and polar coordinates, on and off."""
    UNAVAILABLE = auto()
    """A code that the control does not have and whose meaning is in force anyway: a warning."""
    UNSUPPORTED = auto()
    """A code that the control has and cutcomp does not support: the run stops."""
    OF_THIS_CONTROL = auto()
    """A code of this control alone, which its `Control` handles."""


@dataclass(frozen=True, slots=True)
class Code:
    """A G code: its modal group, what it does, and its value for that."""

    group: str
    action: CodeAction
    value: int = 0


def _group(group: str, action: CodeAction, *codes: int) -> dict[int, Code]:
    return {code: Code(group, action, code) for code in codes}


PLANES: Final[Mapping[int, Plane]] = MappingProxyType({170: Plane.XY, 180: Plane.ZX, 190: Plane.YZ})
"""The codes of the planes."""

COMMON_CODES: Final[Mapping[int, Code]] = MappingProxyType(
    {
        **_group("motion", CodeAction.MOTION, 0, 10, 20, 30, 800),
        **_group("motion", CodeAction.CYCLE, *range(810, 900, 10)),
        **_group("plane", CodeAction.PLANE, 170, 180, 190),
        **_group("units", CodeAction.UNITS, 200, 210),
        **_group("compensation", CodeAction.SIDE, 400, 410, 420),
        **_group("length", CodeAction.MODE, 430, 490),
        **_group("system", CodeAction.SYSTEM, 540, 550, 560, 570, 580, 590),
        **_group("distance", CodeAction.DISTANCE, 900, 910),
        **_group("feed", CodeAction.RATE, 930, 940, 950),
        **_group("once", CodeAction.DWELL, 40),
        **_group("once", CodeAction.HOME, 280, 300),
        **_group("once", CodeAction.PRESET, 920),
    }
)
"""What G codes are on every word-address control in cutcomp."""


CYCLES_APART: Final = (("cycle", CodeAction.CYCLE, tuple(range(810, 900, 10))), ("cycle", CodeAction.MOTION, (800,)))
"""G80 to G89 as a group of their own: G80 then ends the cycle and leaves the motion that stood before it.

In the group of the motions G80 leaves no motion in force, and counts for nothing next to another code of that group.
"""


def codes(*groups: tuple[str, CodeAction, tuple[int, ...]]) -> Mapping[int, Code]:
    """The common codes with those of a control over them."""
    added = {
        code: entry for group, action, numbers in groups for code, entry in _group(group, action, *numbers).items()
    }
    return MappingProxyType({**COMMON_CODES, **added})


@dataclass(frozen=True, slots=True)
class Dialect:
    """A control's way of reading: everything that is data rather than a rule of compensation.

    `mode` is the motion in force at the start, None where the control refuses axis words without one.
    `absolute_centers`: I, J, K count from the origin while positions do (G90), otherwise always from the arc's start.
    `moves_alone`: G0 or G1 without any axis is a move of no length.  `feed_needed`: an error without a feed.
    `loads_at_t`: the T word itself puts the tool in force; otherwise M6 does.  `table_needed`: a tool that is not in
    the table cannot be selected.  `unit_first`: the F of a block counts in the unit the block sets.
    `percent_ends`: a second line of % ends the program.  `end_needed`: M2, M30 or that line must stand at the end.
    `group_rule`: the rule's id for two G codes of one group.  `parameters`: how it keeps those of a program, None where
    nothing is known of them.  `cycles`: its drilling cycles are known; `cycle_rule` the rule that keeps them from
    compensation; `returns_to_r`: G99 is in force at the start.
    `cycle_r_needed`: a cycle's first block must have R.  `d_anywhere`: D, and H, may stand in any block.
    `dwell_takes_axes`: X with G4 is a time, or may be.  `rate_clears_feed`: after G94 and G95 there is no feed, also
    where they were in force.  `tool_data_kinds`: the L of G10 that set a tool's data.  `tells_unused`: words that
    nothing takes are reported.  `rule_names`: the control's own numbers for alarms.  `last_code_counts`: of two codes
    of one group the last counts, with a warning.  `repeat_letters`: how often a drilling cycle runs.
    `fanuc_cycles`: R and the depth of a cycle stay heights where G90 and G91 change, and 0 repeats only store them.
    `homes_all`: G28 without an axis moves all axes.  `m97_calls`: M97 calls a block of the program, and the P of M98
    is a program's number alone.  `program_names`: a name in angle brackets may stand for O and its number.
    `without_point`: what makes X10 ten least increments.  `diameters_apart`: D has a memory of its own, in diameters.
    `macro_codes`: the parameters that make G codes macros.  `g54_takes_p`: G54 P is G54.1 P.
    `max_repeated_blocks`: how many blocks subprograms and loops may run again before the run is given up.
    """

    codes: Mapping[int, Code]
    unit: Unit
    mode: int | None = 0
    absolute_centers: bool = False
    arc_tolerance: ArcTolerance = USUAL_ARC_TOLERANCE
    syntax: Syntax = PLAIN_SYNTAX
    moves_alone: bool = False
    feed_needed: bool = False
    loads_at_t: bool = False
    subprograms: bool = True
    table_needed: bool = False
    unit_first: bool = True
    percent_ends: bool = False
    end_needed: bool = False
    group_rule: str = "GROUP"
    parameters: ParameterStore | None = None
    cycles: bool = True
    cycle_rule: str = "CYCLE"
    returns_to_r: bool = False
    cycle_r_needed: bool = True
    d_anywhere: bool = False
    dwell_takes_axes: bool = True
    rate_clears_feed: bool = False
    tool_data_kinds: frozenset[int] = frozenset()
    tells_unused: bool = True
    rule_names: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    last_code_counts: bool = False
    repeat_letters: str = "L"
    fanuc_cycles: bool = False
    homes_all: bool = False
    m97_calls: bool = False
    program_names: bool = False
    without_point: str = ""
    diameters_apart: bool = False
    macro_codes: str = ""
    g54_takes_p: bool = False
    max_repeated_blocks: int = 400_000


_ALWAYS_TAKEN: Final = frozenset("NOXYZFSTABCUVW")
"""Words that have a meaning in any block; other axes than X, Y and Z are reported as axes."""

_TAKEN_BY_G: Final[Mapping[int, str]] = MappingProxyType(
    {40: "PXU", 100: "LPR", 400: "DIJK", 411: "DL", 421: "DL", 410: "DI", 420: "DI"}
    | {430: "H", 490: "H", 640: "P", 960: "D", 440: "H", 541: "P", 1540: "P"}
    | {50: "PR", 51: "QR", 80: "P", 390: "IJK", 510: "PIJK", 680: "R", 1030: "P", 1870: "PE"}
)
_TAKEN_BY_M: Final[Mapping[int, str]] = MappingProxyType({960: "PQL", 970: "PL", 980: "PL", 990: "P", 1980: "PL"})
_TAKEN_BY_ARC: Final = "IJKR"
_TAKEN_BY_CYCLE: Final = "RQPLIJK"


def p_is_of_g54(block: Block, mode: int | None) -> bool:
    """Whether a block's P stands with G54 alone: no other code in it, and no cycle in force, takes a P."""
    others = [code for code in block.g if code != 540]
    taken = any("P" in _TAKEN_BY_G.get(code, "") or code in (300, 650, 660) for code in others)
    by_m = any("P" in _TAKEN_BY_M.get(code, "") for code in block.m)
    cycle = mode not in (0, 10, 20, 30, 800, None) or any(730 <= code <= 890 and code != 800 for code in others)
    return 540 in block.g and "P" in block.words and not (taken or by_m or cycle)


def unused_words(block: Block, mode: int | None, dialect: Dialect) -> list[str]:
    """The words of a block that nothing in it takes, the motion in force being `mode`."""
    if _ALWAYS_TAKEN.issuperset(block.words):
        return []
    taken = set(_ALWAYS_TAKEN)
    for code in block.g:
        taken.update(_TAKEN_BY_G.get(code, ""))
    homes = 300 in block.g and dialect.parameters is ParameterStore.FANUC
    if homes or (dialect.g54_takes_p and p_is_of_g54(block, mode)):
        taken.add("P")
    for code in block.m:
        if code != 970 or dialect.m97_calls:
            taken.update(_TAKEN_BY_M.get(code, ""))
    if mode in (20, 30):
        taken.update(_TAKEN_BY_ARC)
    elif mode not in (0, 10, 800, None):
        taken.update(_TAKEN_BY_CYCLE)
    if dialect.d_anywhere:
        taken.update("DH")
    elif not SWITCHES.isdisjoint(block.g):
        taken.add("D")
    return [letter for letter in block.words if letter not in taken]
