"""The modal state of a word-address control is what stays in force between blocks.

All positions are in millimeters from machine zero; work offsets that the program does not set are zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Final

from core.controls.control_run import Log, Place
from core.controls.control_tools import CutterTool, ToolTable, missing_tool
from core.controls.iso.dialect import Dialect
from core.controls.iso.reader import Block, ToolData, whole_word
from core.controls.moves import Plane, Point3
from core.finding import Severity
from core.tolerance import GOUGE
from core.units import Unit

ORIGIN: Final[Point3] = (0.0, 0.0, 0.0)
G54: Final = 540

EXTERNAL_OFFSET: Final = 0
"""The key of the offset that shifts all work offsets, on controls that have one."""

TAKEN_AS_ZERO: Final = "is not in the program; it is taken as zero."
"""Ends the finding on a work offset that the program does not set: its positions compare with no other offset's."""

INVERSE_TIME: Final = 930
PER_MINUTE: Final = 940

RADIUS_ZERO: Final = frozenset(("RADIUS0", "B3-DIA0", "FN-D0"))
"""Rules that report compensation that is turned on but offsets nothing."""

_SPINDLE_TURN: Final = {30: 1, 40: -1, 50: 0, 190: 0}


def system_code(number: int) -> int:
    """Return the code in tenths of work offset 1 to 9: G54 to G59, G59.1 to G59.3."""
    return 530 + 10 * number if number <= 6 else 584 + number


@dataclass(frozen=True, slots=True)
class Origin:
    """The work offsets by code in tenths, the one in force, and the shift of G52 or G92 on top, in millimeters.

    `stored` is the shift that G92.3 restores.
    """

    systems: Mapping[int, Point3] = field(default_factory=dict)
    system: int = G54
    local: Point3 = ORIGIN
    stored: Point3 = ORIGIN

    @property
    def base(self) -> Point3:
        """The work offset in force plus the one that shifts all work offsets."""
        x, y, z = self.systems.get(self.system, ORIGIN)
        dx, dy, dz = self.systems.get(EXTERNAL_OFFSET, ORIGIN)
        return x + dx, y + dy, z + dz

    @property
    def shift(self) -> Point3:
        """The program's origin."""
        base = self.base
        return base[0] + self.local[0], base[1] + self.local[1], base[2] + self.local[2]


@dataclass(slots=True)
class Cycle:
    """What stays from hole to hole: the cycle, the height at which its row began, R, depth and peck, in millimeters.

    `r` and `depth` are as written, but on Fanuc's family they are heights even under G91; `to_r` is G99; `mode_before`
    is the motion in force before the cycle.
    """

    code: int | None = None
    mode_before: int | None = None
    began: float = 0.0
    r: float = 0.0
    depth: float = 0.0
    peck: float = 0.0
    to_r: bool = False


class ModalState:
    """The modal state and the operations on it.

    `position` is the programmed point and `shift` the program's origin, x, y, z in millimeters; `tool` is the number in
    force for compensation, 0 for none; `unit` is that of the words, `first_unit` that of the first motion; `feed` is in
    millimeters per minute, unless `rate` (G93, G94, G95) gives F another meaning; `speed` is in rpm, or under
    `surface_speed` (G96) that of the cutting edge; `turning` is +1 for M3, -1 for M4, 0 for neither.
    """

    def __init__(self, dialect: Dialect, tools: ToolTable, log: Log) -> None:
        self.dialect = dialect
        self.tools = tools
        self.compared_offsets = set[tuple[int, float]]()
        self.log = log
        self.unit = dialect.unit
        self.scale = 25.4 if dialect.unit is Unit.IN else 1.0
        self.first_unit: Unit | None = None
        self.unit_said = False
        self.mode = dialect.mode
        self.plane = Plane.XY
        self.position = ORIGIN
        self.origin = Origin()
        self.shift = ORIGIN
        self.incremental = False
        self.absolute_centers = dialect.absolute_centers
        self.feed = 0.0
        self.rate = PER_MINUTE
        self.speed = 0.0
        self.surface_speed = False
        self.turning = 0
        self.cycle = Cycle(to_r=dialect.returns_to_r)
        self.tool = 0
        self.next_tool = 0
        self.length_offset = ORIGIN
        self.ended = False

    def target(self, words: Mapping[str, float], start: Point3 | None = None) -> Point3:
        """Return where a block's axis words lead from the position or another point, in millimeters."""
        x, y, z = here = self.position if start is None else start
        base, scale = here if self.incremental else self.shift, self.scale
        if "X" in words:
            x = base[0] + words["X"] * scale
        if "Y" in words:
            y = base[1] + words["Y"] * scale
        if "Z" in words:
            z = base[2] + words["Z"] * scale
        return x, y, z

    def axis_words(self, block: Block, old: Point3) -> Point3:
        """Return a block's axis words in millimeters, the old coordinate for an axis without one."""
        x, y, z = (
            block.words[letter] * self.scale if letter in block.words else before
            for letter, before in zip("XYZ", old, strict=True)
        )
        return x, y, z

    @property
    def centers_from_origin(self) -> bool:
        """True if I, J, K count from the program's origin, False if they count from the arc's start."""
        return self.absolute_centers and not (self.incremental and self.dialect.absolute_centers)

    def set_origin(self, origin: Origin) -> None:
        """Make the program count from another origin."""
        self.origin, self.shift = origin, origin.shift

    def set_system(self, code: int, offset: Point3) -> None:
        """Set the work offset of a code, in millimeters."""
        systems = {**self.origin.systems, code: offset}
        self.set_origin(replace(self.origin, systems=systems))

    def set_length_offset(self, offset: Point3) -> None:
        """Set the tool length offset: the axes do not move, but the programmed point that they stand for changes."""
        x, y, z = (now - new + old for now, new, old in zip(self.position, offset, self.length_offset, strict=True))
        self.position, self.length_offset = (x, y, z), offset

    def set_rate(self, code: int) -> None:
        """Set G93, G94 or G95; clear the feed if the meaning of F changes, or if the control always clears it."""
        if code != self.rate or (self.dialect.rate_clears_feed and code != INVERSE_TIME):
            self.feed = 0.0
        self.rate = code

    def take_spindle(self, block: Block) -> None:
        """Take a block's S, M3, M4, M5 and M19."""
        if "S" in block.words:
            self.speed = abs(block.words["S"])
        for code in block.m:
            self.turning = _SPINDLE_TURN.get(code, self.turning)

    def feed_over(self, block: Block, length: float) -> float:
        """Return the feed of a move of this length, in millimeters per minute; 0 if it is not known."""
        place = block.at("FXYZIJ")
        if self.rate == INVERSE_TIME:
            if "F" not in block.words:
                self.log.stop("FEED", "Under G93 every move at feed needs its own F; write it in this block.", place)
            return block.words["F"] * length
        if not self.feed:
            self.no_feed(block)
            return 0.0
        if not self.speed or self.surface_speed:
            text = "G95 needs a known spindle speed. Program S in rpm."
            if self.dialect.feed_needed and not self.surface_speed:
                self.log.stop("FEED", text, place)
            self.log.warn("FEED", text, place)
        return 0.0 if self.surface_speed else self.feed * self.speed

    def no_feed(self, block: Block) -> None:
        """Report a move at feed without a feed; stop the run on a control that needs one."""
        text = "There is no feed; write F before the first move at feed."
        if self.dialect.feed_needed:
            self.log.stop("FEED", text, block.at("XYZIJ"))
        self.log.warn("FEED", text, block.at("XYZIJ"))

    def tool_number(self, block: Block) -> int | None:
        """Return the number of a block's tool data or T word, None without either."""
        if block.data:
            return block.data.number
        if "T" not in block.words:
            return None
        return whole_word(block, "T", self.log, "NUMBER", "T must be a whole number, 0 or more.")

    def select_tool(self, number: int, block: Block) -> None:
        """Select the tool of a T word, and enter its tool data, if there are any."""
        if block.data is not None:
            self._enter_tool_data(block.data, block)
        if number and self.dialect.table_needed and self.tools.get(number) is None:
            self.log.stop("TOOL", missing_tool(number), block.at("T"), tool=number)
        self.next_tool = number
        if self.dialect.loads_at_t:
            self.tool = number

    def _enter_tool_data(self, data: ToolData, block: Block) -> None:
        """Enter tool data into the tool table; what they leave out stays as it is."""
        old = self.tools.get(data.number) or CutterTool(data.number, 0.0)
        diameter = old.diameter if data.diameter is None else data.diameter
        unit = old.unit if data.diameter is None else self.unit
        tool = CutterTool(data.number, diameter, old.length if data.length is None else data.length, 0, unit)
        self.tools = {**self.tools, tool.number: tool}
        if data.length is None and data.diameter is None:
            text = "This tool data sets neither length nor diameter; both stay as they are."
            self.log.inform("TOOL", text, block.at("T"))

    def nothing_compensated(
        self, why: str, place: Place, *, code: str = "RADIUS0", severity: Severity = Severity.WARNING
    ) -> None:
        """Report that nothing is compensated and how deep the tool cuts; `why` says what to do, or what is missing."""
        tool = self.tools.get(self.tool or (next(iter(self.tools)) if len(self.tools) == 1 else 0))
        cut, lengths = "a cutter cuts its own radius too deep", tuple[float, ...]()
        if tool is not None and tool.diameter != 0.0:
            diameter = abs(tool.diameter_mm(self.unit))
            cut, lengths = f"tool {tool.number}, diameter {{0}}, cuts {{1}} too deep", (diameter, diameter / 2)
        text = f"Nothing is compensated: {cut} along the contour, unless the program is the tool's center path. {why}"
        self.log.report(severity, code, text, place, lengths=lengths)

    def compare_offset(self, radius: float, offset: str, place: Place) -> None:
        """Report an offset's radius (millimeters) that differs from that of the tool in the spindle, once for each."""
        tool = self.tools.get(self.tool)
        actual = 0.0 if tool is None else abs(tool.diameter_mm(self.unit)) / 2
        difference = radius - actual
        if radius <= 0.0 or actual == 0.0 or abs(difference) <= GOUGE or (self.tool, radius) in self.compared_offsets:
            return
        self.compared_offsets.add((self.tool, radius))
        effect = "leaves {value} of stock"
        if difference < 0.0:
            effect = "cuts {value} too deep, unless the program is the tool's center path"
        text = f"{offset} has the radius {{0}}, tool {self.tool} has {{1}}: the cutter {effect}."
        severity = Severity.WARNING if difference < 0.0 else Severity.INFO
        self.log.report(severity, "OFFSET", text, place, lengths=(radius, actual), value=abs(difference))
