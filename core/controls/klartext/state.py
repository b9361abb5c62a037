"""The state of a Klartext program carries over from block to block; it also evaluates the words of a block.

Lengths and feeds are in millimeters and millimeters per minute whatever the program's unit; positions are programmed.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from re import Pattern
from typing import Final, NoReturn

from core.controls.compensation.elements import Element
from core.controls.control_run import Log, SpindleChange, Spot
from core.controls.control_tools import ToolTable, tool_id
from core.controls.klartext.center_path import FeedAt, ProgrammedStep, Role
from core.controls.klartext.corner_rounding import CornerBuffer
from core.controls.klartext.formulas import evaluate
from core.controls.klartext.reader import WORD, Block, joined_name
from core.controls.moves import Plane
from core.controls.program_text import quoted
from core.controls.transform import Transform
from core.geometry.piece import Point
from core.tolerance import LARGEST_COORDINATE
from core.units import Unit, to_mm

AXIS_WORDS: Final[Mapping[str, tuple[int, bool]]] = {name: (index, False) for index, name in enumerate("XYZ")} | {
    f"I{name}": (index, True) for index, name in enumerate("XYZ")
}
"""Axis words: the index of the axis, and True if the value counts from the last programmed position."""

SIDE_WORDS: Final[Mapping[str, int]] = {"R0": 0, "RL": 1, "RR": -1}
EMPTY_WORDS: Final = frozenset("RFM")
"""Words that old controls show in every block, without a value where nothing changes."""

EMPTY_WORD_TEXT: Final = "{name} without a value changes nothing, as the TNC 155 and its relatives write it."
COMMON_WORDS: Final = frozenset(("R0", "RL", "RR", "F", "FMAX", "FAUTO", "M", "LA", "MB", "MAX"))
FEED_WORDS: Final = frozenset(("F", "FMAX", "FAUTO"))
ROTARY_AXES: Final = frozenset("ABC")
OTHER_AXES: Final = frozenset(f"{step}{name}" for step in ("", "I") for name in "ABCUVW")


class Words(dict[str, str]):
    """The words of a block by name, each with its number as written; R0, RL, RR, M3 ... are names without a number."""

    def __init__(self, block: Block) -> None:
        super().__init__()
        self.block = block

    def at(self, name: str) -> Spot:
        """Return the place of a word, or of the block's head if there is no such word."""
        return self.block.at(name)


@dataclass(slots=True)
class State:
    """What a program has set so far."""

    log: Log
    waiting: CornerBuffer
    """Takes the steps, and holds back those at a corner that is still to be rounded."""
    tools: ToolTable
    blocks: Sequence[Block]
    labels: Mapping[str, int]
    share: float = 1.0
    """The fraction of the tool radius that the run uses."""
    unit: Unit = Unit.MM
    begun: bool = False
    ended: bool = False
    next: int = 0
    calls: list[tuple[str, int]] = field(default_factory=list)
    repeats: dict[int, int] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    position: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    known: set[int] = field(default_factory=set)
    at_machine_place: set[int] = field(default_factory=set)
    """Axes that M91, M92, M140 or a tool change has sent to a place that only the machine knows."""
    lost: bool = False
    """The tool axis is one of them when the block starts."""
    shift: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    transform: Transform = field(default_factory=Transform)
    """Mirrors or turns what is programmed."""
    datum_moved: bool = False
    """The datum was shifted while a transform was in force."""
    pole: Point | None = None
    """In coordinates of `pole_plane`, the plane of the axes in CC."""
    pole_plane: Plane = Plane.XY
    cycle: int | None = None
    """The number of the cycle that a call runs."""
    cycle_due: bool = False
    """M99 calls it after the block."""
    feed: float = 0.0
    tool_feed: float = 0.0
    before: tuple[bool, float] = (False, 0.0)
    plane: Plane = Plane.XY
    defined: dict[str, float] = field(default_factory=dict)
    tool: str = ""
    speed: float | None = None
    spindle: list[SpindleChange] = field(default_factory=lambda: [SpindleChange()])
    radius: float | None = None
    feed_at: FeedAt = FeedAt.CENTER
    side: int = 0
    """The side of the last RL (+1), RR (-1) or R0 (0)."""
    applied: int = 0
    """The side in effect on the tool's path."""
    offset: float = 0.0
    """The path's signed radius."""
    ahead: int = 0
    """The number of blocks that M120 looks ahead."""
    reported_cycles: set[int] = field(default_factory=set)
    reported_empty: bool = False
    last: Element | None = None
    """The contour element just programmed; None if the next one cannot be tangent to it."""

    def note_spindle(self) -> None:
        """Note the tool, if it has a number, and the speed in force."""
        tool = int(self.tool) if self.tool.isdecimal() else None
        self.spindle.append(SpindleChange(len(self.waiting.center.tape), tool, self.speed))

    def words(self, block: Block, allowed: frozenset[str], pattern: Pattern[str] = WORD) -> Words:
        """Return the block's words, all of them allowed and none twice; M words have their numbers in their names."""
        words = Words(block)
        for written, number, junk in pattern.findall(block.body):
            name = joined_name(written)
            if name == "R" and number == "0":
                name, number = "R0", ""
            if name in EMPTY_WORDS and not number and not junk and self._is_empty(name, allowed):
                if not self.reported_empty:
                    self.log.inform("INTERPRETED", EMPTY_WORD_TEXT.format(name=name), block.at(name))
                self.reported_empty = True
                continue
            if name not in allowed and name in ROTARY_AXES and number and self.value(number, block, name) == 0.0:
                self.log.inform("AXIS", "Rotary axes at 0 tilt nothing and are skipped.", block.at(name))
                continue
            if name not in allowed:
                self._unknown(block, name or junk, number)
            if name == "M":
                name, number = f"M{number}", ""
            if name in words:
                self.log.stop("TWICE", f"{name} is written twice in this block. Keep one.", block.at(name))
            words[name] = number
        return words

    @staticmethod
    def _is_empty(name: str, allowed: frozenset[str]) -> bool:
        """True if a word without a value leaves what is in force, and does not lack the value it needs."""
        return name in allowed if name != "R" else "R" not in allowed and "R0" in allowed

    def _unknown(self, block: Block, name: str, number: str) -> NoReturn:
        code = "BEYOND"
        if name in OTHER_AXES and number:
            text = f"{name} is a rotary or parallel axis, which is not supported."
        elif name == "R" and number in ("+", "-"):
            text = "R+ and R- are for single-axis blocks, which are not supported. Write L with R0, RL or RR."
        else:
            written = block.body[block.at(name).column - block.begin :].split(maxsplit=1)[0]
            if written.startswith("QS"):
                text = f"cutcomp does not follow {quoted(written)}: a parameter that holds text. Write the text."
            elif written.startswith("#"):
                text = f"cutcomp does not follow {quoted(written)}: a row of a table. Write its values."
            else:
                code, text = "WORD", f"A {quoted(block.head)} block takes no word {quoted(written)}."
        self.log.stop(code, text, block.at(name))

    def number(self, words: Words, name: str) -> float:
        """Return the number of a word, or the value of its formula."""
        raw = words[name]
        try:
            value = float(raw)
        except ValueError:
            if not raw or raw in "+-":
                self.log.stop("NUMBER", f"{name} needs a number after it.", words.at(name))
            value = self.value(raw, words.block, name)
        if not -LARGEST_COORDINATE < value < LARGEST_COORDINATE:
            text = f"{name} {value:g} is too large: no machine goes beyond {LARGEST_COORDINATE:,.0f}."
            self.log.stop("NUMBER", text, words.at(name))
        return value

    def value(self, formula: str, block: Block, name: str = "") -> float:
        """Return the value of a formula; stop the run if it has none."""
        if "%" in formula:
            text = "cutcomp does not work out % in a formula: the sign of a remainder may differ. Write the result."
            self.log.stop("BEYOND", text, block.at(name))
        value = evaluate(formula, self.parameters)
        if isinstance(value, str):
            self.log.stop("Q", value, block.at(name))
        return value

    def length(self, words: Words, name: str) -> float:
        """Return the number of a word that is a length or a feed, in millimeters."""
        return to_mm(self.number(words, name), self.unit)

    def flat(self, position: Sequence[float], plane: Plane | None = None) -> tuple[Point, float]:
        """Return a position as a point of a plane, by default the working plane, and its coordinate across it."""
        first, second, third = (self.plane if plane is None else plane).axes
        return (position[first], position[second]), position[third]

    def target(self, words: Words) -> list[float]:
        """Return the position that the block's axis words lead to."""
        position, self.lost = self.position.copy(), self.plane.axes[2] in self.at_machine_place
        for name in words:
            if name in AXIS_WORDS:
                axis, relative = AXIS_WORDS[name]
                if not relative:
                    self.now_known({axis})
                elif AXIS_WORDS[name[1:]][0] == axis and name[1:] in words:
                    self.log.stop("TWICE", f"{name} and {name[1:]} are in one block. Keep one.", words.at(name))
                base = self.position[axis] if relative else self.shift[axis]
                position[axis] = base + self.length(words, name)
        return position

    def now_known(self, axes: Collection[int]) -> None:
        """Note that absolute words have set the position of these axes."""
        self.known.update(axes)
        self.at_machine_place.difference_update(axes)

    def lose(self, axes: Collection[int]) -> None:
        """Note that these axes go where only the machine knows."""
        self.known.difference_update(axes)
        self.at_machine_place.update(axes)

    def chosen_side(self, words: Words) -> None:
        """Take up the block's R0, RL or RR."""
        if SIDE_WORDS.keys().isdisjoint(words):
            return
        names = [name for name in SIDE_WORDS if name in words]
        if len(names) > 1:
            self.log.stop("TWICE", f"{names[0]} and {names[1]} are in one block. Keep one.", words.at(names[1]))
        side = SIDE_WORDS[names[0]]
        if side and side == -(self.applied or self.side):
            text = "The side changes without R0 between. Cancel in an L block with R0 first."
            self.log.stop("HE1", text, words.at(names[0]))
        self.side = side

    def chosen_feed(self, words: Words) -> tuple[bool, float]:
        """Return rapid and feed of the block: FMAX applies to this block alone, F from here on."""
        if FEED_WORDS.isdisjoint(words):
            return False, self.feed
        names = [name for name in words if name in FEED_WORDS]
        if len(names) > 1:
            self.log.stop("TWICE", f"{names[0]} and {names[1]} are in one block. Keep one.", words.at(names[1]))
        if "F" in words:
            self.feed = self.length(words, "F")
        elif "FAUTO" in words:
            self.feed = self.tool_feed
        if self.feed < 0.0:
            self.log.stop("NUMBER", "A feed cannot be negative.", words.at("F"))
        return "FMAX" in words, self.feed

    def push(self, step: ProgrammedStep) -> None:
        """Hand the next step on, to the center path."""
        ahead = self.ahead if step.role is Role.CONTOUR else 0
        self.waiting.push(step.placed(self.transform)._replace(ahead=ahead, lost=self.lost))

    def transformed(self, transform: Transform) -> None:
        """Mirror and turn what is programmed from here on; the tool stays where it is."""
        axes = self.plane.axes[:2]
        if not self.known.issuperset(axes):
            self.known.difference_update(axes)
        self.waiting.flush()
        x, y, z = self.position
        self.position = list(transform.undone(self.transform.applied((x, y, z))))
        self.transform, self.datum_moved, self.last, self.pole = transform, False, None, None

    def moving(self, block: Block, *, rapid: bool, feed: float) -> None:
        """Note that a block moves, and warn if its feed or its start is unknown."""
        self.before = (rapid, feed)
        if self.datum_moved or (self.transform and self.transform.plane is not self.plane):
            text = "cutcomp follows a mirror image or rotation only about a datum set before, in one working plane."
            self.log.stop("BEYOND", text, block)
        if rapid:
            return
        if not feed:
            self.log.warn("FEED", "This move has no feed: the control stops here. Write F or FMAX.", block)
        if len(self.known) < 3 and not self.known.issuperset(self.plane.axes[:2]):
            self.known.update(self.plane.axes[:2])
            where = "its last known place, or 0 at the beginning of the program"
            text = f"Where the tool stands is not known here; cutcomp takes {where}."
            self.log.warn("POSITION", f"{text} Write an L block with both axes before.", block)

    def apply(self, block: Block) -> None:
        """Apply RL or RR from here on, at the radius of the tool in the spindle."""
        if not self.side or self.applied == self.side:
            self.applied, self.offset = self.side, self.offset if self.side else 0.0
            return
        if self.radius is None and not self.tool:
            self._take_only_tool(block)
        if self.radius is None:
            text = "The tool's radius is unknown. Write TOOL DEF and TOOL CALL, or give the tool's diameter."
            if self.tool:
                text = f"The diameter of tool {self.tool} is unknown. Write TOOL DEF with its radius, or enter it."
            place = block.at("RL" if self.side > 0 else "RR")
            self.log.stop("TOOL", text, place, tool=tool_id(self.tool or "1"))
        if self.radius < 0.0:
            text = "Tool radius {0} with its deltas is negative: the tool runs on the other side of the contour."
            self.log.warn("TOOL", text, block, lengths=(self.radius,))
        elif not self.radius:
            self.log.warn("TOOL", "Tool radius 0: the center runs on the contour.", block)
        self.applied, self.offset = self.side, self.side * self.radius * self.share

    def _take_only_tool(self, block: Block) -> None:
        """Without a TOOL CALL, take the table's tool if the table has only one."""
        if len(self.tools) == 1:
            (tool,) = self.tools.values()
            self.tool, self.radius = str(tool.number), tool.diameter_mm(self.unit) / 2.0
            text = f"No TOOL CALL before this block: cutcomp takes tool {tool.number}, the only one given."
            self.log.inform("TOOL", text, block)

    def release(self) -> None:
        """Turn compensation off."""
        self.applied, self.offset, self.ahead = 0, 0.0, 0
