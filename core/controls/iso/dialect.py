"""A dialect says, as frozen data, which G and M codes a word-address control has and how it reads them.

Codes are in tenths (G41.1 is 411).  A block takes one code of each group.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from typing import Final

from core.controls.iso.arcs import USUAL_ARC_TOLERANCE, ArcTolerance
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.reader import COMPENSATION_CODES, PLAIN_SYNTAX, Block, Syntax
from core.controls.moves import Plane
from core.units import Unit


class CodeAction(Enum):
    """What a G code makes the machine do: up to SIDE in the order of execution, then the others."""

    MOTION = auto()
    PLANE = auto()
    UNITS = auto()
    DISTANCE = auto()
    OF_THIS_CONTROL = auto()
    """A code of this control alone, which its `Control` handles."""
    SIDE = auto()
    CYCLE = auto()
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
    """A tool length offset on a control that shifts the position by it; the axis words of G43.1 are the offset."""
    SKIP = auto()
    TRANSFORM = auto()
    """Scaling, mirror image, rotation or polar coordinates, on or off."""
    UNAVAILABLE = auto()
    """A code that the control does not have but whose meaning is in force anyway: a warning."""
    UNSUPPORTED = auto()
    """A code that the control has but cutcomp does not support: the run stops."""


@dataclass(frozen=True, slots=True)
class Code:
    """A G code: its modal group, its action, and the action's value."""

    group: str
    action: CodeAction
    value: int = 0


METRIC_CODES: Final = frozenset((210, 710))


def unit_of_code(code: int) -> Unit:
    """Return the unit that a code of CodeAction.UNITS chooses."""
    return Unit.MM if code in METRIC_CODES else Unit.IN


PLANE_OF_CODE: Final[Mapping[int, Plane]] = {170: Plane.XY, 180: Plane.ZX, 190: Plane.YZ}

CodeGroup = tuple[str, CodeAction, tuple[int, ...]]

_COMMON_CODES: Final[tuple[CodeGroup, ...]] = (
    ("motion", CodeAction.MOTION, (0, 10, 20, 30, 800)),
    ("motion", CodeAction.CYCLE, tuple(range(810, 900, 10))),
    ("plane", CodeAction.PLANE, (170, 180, 190)),
    ("units", CodeAction.UNITS, (200, 210)),
    ("compensation", CodeAction.SIDE, (400, 410, 420)),
    ("length", CodeAction.MODE, (430, 490)),
    ("system", CodeAction.SYSTEM, (540, 550, 560, 570, 580, 590)),
    ("distance", CodeAction.DISTANCE, (900, 910)),
    ("feed", CodeAction.RATE, (930, 940, 950)),
    ("once", CodeAction.DWELL, (40,)),
    ("once", CodeAction.HOME, (280, 300)),
    ("once", CodeAction.PRESET, (920,)),
)
"""The G codes of every word-address control in cutcomp."""

USUAL_CODES: Final[tuple[CodeGroup, ...]] = (
    ("path", CodeAction.MODE, (610, 640)),
    ("spindle", CodeAction.SPINDLE, (960, 970)),
    ("retract", CodeAction.RETRACT, (980, 990)),
    ("once", CodeAction.SHIFT, (520,)),
    ("once", CodeAction.MACHINE, (530,)),
    ("once", CodeAction.DATA, (100,)),
)
"""The further G codes of every such control but the oldest."""

CYCLES_APART: Final = (("cycle", CodeAction.CYCLE, tuple(range(810, 900, 10))), ("cycle", CodeAction.MOTION, (800,)))
"""G80 to G89 as a group of their own: G80 then ends the cycle and restores the motion in force before it.

In the motion group, G80 leaves no motion in force, and is ignored next to another code of that group.
"""


def codes(*groups: CodeGroup) -> Mapping[int, Code]:
    """Return the common codes with a control's own added; its own replace common ones."""
    every = (*_COMMON_CODES, *groups)
    return {code: Code(group, action, code) for group, action, numbers in every for code in numbers}


@dataclass(frozen=True, slots=True)
class Dialect:
    """How a control reads programs: everything that is data rather than a rule of compensation."""

    codes: Mapping[int, Code]
    unit: Unit
    mode: int | None = 0
    """The motion in force at the start; None if the control refuses axis words without one."""
    absolute_centers: bool = False
    """Under G90, I, J and K count from the origin, not from the arc's start."""
    arc_tolerance: ArcTolerance = USUAL_ARC_TOLERANCE
    arc_turns: bool = False
    """P is the number of turns of an arc."""
    syntax: Syntax = PLAIN_SYNTAX
    moves_alone: bool = False
    """G0 or G1 without an axis is a move of no length."""
    feed_needed: bool = False
    """A move at feed needs an F."""
    loads_at_t: bool = False
    """The T word itself puts the tool in force; otherwise M6 does."""
    subprograms: bool = True
    table_needed: bool = False
    """A tool that is not in the table cannot be selected."""
    unit_first: bool = True
    """The F of a block is in the unit that the block sets."""
    percent_ends: bool = False
    """A second line of % ends the program."""
    end_needed: bool = False
    """The program must end with M2, M30 or a second line of %."""
    group_rule: str = "GROUP"
    """The id of the rule against two G codes of one group."""
    parameters: ParameterStore | None = None
    """How the control keeps a program's parameters; None if nothing is known of them."""
    cycles: bool = True
    """Its drilling cycles are known."""
    cycle_rule: str = "CYCLE"
    """The id of the rule against drilling cycles under compensation."""
    returns_to_r: bool = False
    """G99 is in force at the start."""
    cycle_r_needed: bool = True
    """A cycle's first block must have R."""
    d_anywhere: bool = False
    """Any block may have D and H."""
    dwell_takes_axes: bool = True
    """X with G4 is a time, or may be."""
    rate_clears_feed: bool = False
    """G94 and G95 clear the feed even if already in force."""
    tool_data_kinds: frozenset[int] = frozenset()
    """The values of L with which G10 sets a tool's data."""
    reports_unused: bool = True
    """Words that nothing uses are reported."""
    rule_names: Mapping[str, str] = field(default_factory=dict)
    """The control's own alarm numbers, by the ids of the rules that controls share."""
    last_code_counts: bool = False
    """Of two codes of one group the last counts, with a warning."""
    repeat_letters: str = "L"
    """The letters for how often a drilling cycle runs."""
    fanuc_cycles: bool = False
    """A cycle's R and depth stay heights when G90 and G91 change, and 0 repeats only store them."""
    homes_all: bool = False
    """G28 without an axis moves all axes."""
    scales_axes: bool = False
    """G51 takes I, J and K."""
    m97_calls: bool = False
    """M97 calls a block of the program, and the P of M98 is only a program's number."""
    program_names: bool = False
    """A name in angle brackets may replace O and its number."""
    least_increment_setting: str = ""
    """Under which setting X10 is ten least increments, in words; empty if there is none."""
    diameters_apart: bool = False
    """D has a memory of its own, in diameters."""
    macro_codes: str = ""
    """The parameters that make G codes macros."""
    g54_takes_p: bool = False
    """G54 P is G54.1 P."""
    rounding_moves: bool = False
    """What rounding leaves between two equal positions is a move, as in LinuxCNC's interpreter."""
    max_repeated_blocks: int = 400_000
    """How many blocks subprograms and loops may repeat before cutcomp gives up the run."""


_ALWAYS_USED: Final = frozenset("NOXYZFSTABCUVW")
"""Words that have a meaning in any block; axes other than X, Y and Z are reported as axes."""

_USED_BY_G: Final[Mapping[int, str]] = (
    {40: "PXU", 100: "LPR", 400: "DIJK", 411: "DL", 421: "DL", 410: "DI", 420: "DI"}
    | {430: "H", 490: "H", 640: "P", 960: "D", 440: "H", 541: "P", 1540: "P"}
    | {50: "PR", 51: "QR", 80: "P", 390: "IJK", 510: "PIJK", 680: "R", 1030: "P", 1870: "PE"}
)
_USED_BY_M: Final[Mapping[int, str]] = {190: "PR", 960: "PQL", 970: "PL", 980: "PL", 990: "P", 1980: "PL"}
_USED_BY_ARC: Final = "IJKR"
_USED_BY_CYCLE: Final = "RQPLIJK"


def p_is_of_g54(block: Block, mode: int | None) -> bool:
    """True if a block's P belongs to its G54: no other code in the block, and no cycle in force, uses a P."""
    others = [code for code in block.g if code != 540]
    by_g = any("P" in _USED_BY_G.get(code, "") or code in (300, 650, 660) for code in others)
    by_m = any("P" in _USED_BY_M.get(code, "") for code in block.m)
    cycle = mode not in (0, 10, 20, 30, 800, None) or any(730 <= code <= 890 and code != 800 for code in others)
    return 540 in block.g and "P" in block.words and not (by_g or by_m or cycle)


def unused_words(block: Block, mode: int | None, dialect: Dialect) -> list[str]:
    """Return the words of a block that nothing in it uses; `mode` is the motion in force."""
    if _ALWAYS_USED.issuperset(block.words):
        return []
    used = set(_ALWAYS_USED)
    for code in block.g:
        used.update(_USED_BY_G.get(code, ""))
    homes = 300 in block.g and dialect.parameters is ParameterStore.FANUC
    if homes or (dialect.g54_takes_p and p_is_of_g54(block, mode)):
        used.add("P")
    for code in block.m:
        if code != 970 or dialect.m97_calls:
            used.update(_USED_BY_M.get(code, ""))
    if mode in (20, 30):
        used.update(_USED_BY_ARC)
    elif mode not in (0, 10, 800, None):
        used.update(_USED_BY_CYCLE)
    if dialect.d_anywhere:
        used.update("DH")
    elif not COMPENSATION_CODES.isdisjoint(block.g):
        used.add("D")
    return [letter for letter in block.words if letter not in used]
