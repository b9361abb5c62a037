"""LinuxCNC 2.9 compensates with one move of look-ahead.

The first move ends square to itself.  After it, the queue holds one move in the plane until the next one is known; Z
moves may wait behind it.  An outside corner gets an arc, an inside corner trims both moves, and a corner under 0.05
radians counts as tangent.  At G40 the held move ends square; the next move goes straight from there to its own end
point.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from core.controls.compensation.element_queue import OneMoveQueue
from core.controls.control_run import Log
from core.controls.control_tools import missing_tool
from core.controls.iso.arcs import ArcTolerance
from core.controls.iso.code_support import D_AND_H_ANYWHERE
from core.controls.iso.dialect import PLANE_OF_CODE, USUAL_CODES, CodeAction, Dialect, codes
from core.controls.iso.expressions import ParameterStore
from core.controls.iso.machine import ARC_CENTER_LETTERS, G80, Control
from core.controls.iso.modal_state import system_code
from core.controls.iso.reader import COMPENSATION_CODES, Block, Syntax, whole, whole_word
from core.controls.moves import Plane, flat, solid
from core.geometry.piece import Side
from core.units import Unit

DIALECT: Final = Dialect(
    codes(
        *USUAL_CODES,
        ("motion", CodeAction.CYCLE, (382, 383, 384, 385, 730, 740)),
        ("motion", CodeAction.UNSUPPORTED, (50, 51, 52, 60, 61, 62, 330, 331, 700, 710, 711, 712, 720, 721, 722, 760)),
        ("once", CodeAction.UNSUPPORTED, (53, 281, 301)),
        ("compensation", CodeAction.SIDE, (411, 421)),
        ("centers", CodeAction.CENTERS, (901, 911)),
        ("system", CodeAction.SYSTEM, (591, 592, 593)),
        ("length", CodeAction.LENGTH, (430, 431, 432, 490)),
        ("path", CodeAction.MODE, (611,)),
        ("lathe", CodeAction.MODE, (70, 80)),
        ("once", CodeAction.UNSHIFT, (921, 922, 923)),
    ),
    Unit.MM,
    mode=None,
    syntax=Syntax(strict=True),
    arc_tolerance=ArcTolerance(inch=0.002828427, mm=0.02828427, most=100.0, interpreted=False),
    arc_turns=True,
    moves_alone=True,
    feed_needed=True,
    table_needed=True,
    unit_first=False,
    percent_ends=True,
    end_needed=True,
    group_rule="N-TWOG",
    parameters=ParameterStore.NGC,
    cycle_rule="N-CYCLE",
    returns_to_r=True,
    dwell_takes_axes=False,
    rate_clears_feed=True,
    tool_data_kinds=frozenset((1, 10, 11)),
    reports_unused=False,
    rounding_moves=True,
)

REFUSED_UNDER_COMPENSATION: Final = {
    **dict.fromkeys((520, 920), ("N-OFFSETS", "changes the origin")),
    **dict.fromkeys((540, 550, 560, 570, 580, 590, 591, 592, 593), ("N-OFFSETS", "changes the work offset")),
    **dict.fromkeys((280, 300), ("N-HOME", "goes to the reference point")),
    530: ("N-G53", "moves in machine coordinates"),
    **dict.fromkeys((430, 431, 432, 490), ("N-LENGTH", "changes the tool length offset")),
    **dict.fromkeys((610, 611, 640), ("N-MODE", "changes the path mode")),
    **dict.fromkeys((980, 990), ("N-MODE", "changes the retract mode")),
}
"""G codes that are refused while compensation is on, each with rule and reason."""

REFUSED_M: Final = {
    **dict.fromkeys((60, 610), ("N-TOOL", "changes the tool")),
    **dict.fromkeys((480, 490, 500, 510, 520, 530), ("N-OVERRIDE", "switches an override")),
    **dict.fromkeys((620, 630, 640, 650, 660, 670, 680), ("N-OUTPUT", "sets an output or waits for an input")),
}
"""M codes that are refused while compensation is on, also in the block of G40, because they run before it."""


class LinuxCnc(OneMoveQueue, Control):
    """What turns LinuxCNC's compensation on, and what it refuses while on; `diameters`: G7 is in force."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.diameters = False

    def before_block(self, block: Block) -> None:
        """Stop the run at words that no code in their block uses, and at codes that are not allowed."""
        self.machine.check_codes(block)
        if any(DIALECT.codes[code].action is CodeAction.UNSUPPORTED for code in block.g if code in DIALECT.codes):
            # the run stops at the code itself
            return
        words = block.words
        if "D" in words and COMPENSATION_CODES.isdisjoint(block.g) and 960 not in block.g:
            text = f"D needs G41, G42, G41.1 or G42.1 in its block. {D_AND_H_ANYWHERE}"
            self.log.stop("N-DALONE", text, block.at("D"))
        if not _OTHERS.isdisjoint(words) or block.m or len(block.g) > 1 or 40 in block.g:
            self._other_words(block)
        if not ARC_CENTER_LETTERS.isdisjoint(words):
            self._arc_words(block)
        for code in block.g:
            if code // 10 == 38 and code != 380:
                self.log.stop("N-PROBE", "cutcomp cannot know where the probe stops.", block.at("G", code))
        for letter in "FSN":
            if block.words.get(letter, 0.0) < 0.0:
                self.log.stop("N-NEGATIVE", f"{letter} cannot be negative.", block.at(letter))
        if block.m:
            self._check_m_groups(block)
            self._m_codes(block)
        self._take_diameters(block)

    def _take_diameters(self, block: Block) -> None:
        """G7 and G8: under G7 every X is a diameter, also in the block of G7."""
        if not _LATHE_CODES.isdisjoint(block.g):
            self.diameters = 70 in block.g
        if self.diameters and "X" in block.words:
            block.words["X"] /= 2.0

    def _check_m_groups(self, block: Block) -> None:
        """Stop the run if a block has more than four M codes, or two of one group."""
        if len(block.m) > MAX_M_CODES:
            text = f"A block can have {MAX_M_CODES} M codes. Write the others in another block."
            self.log.stop("GROUP", text, block.at("M", block.m[MAX_M_CODES]))
        for group in _M_GROUPS:
            taken = [code for code in block.m if code in group]
            if len(taken) > 1:
                text = f"M{taken[0] // 10} and M{taken[1] // 10} are of one group. Write them in two blocks."
                self.log.stop("GROUP", text, block.at("M", taken[1]))

    def _m_codes(self, block: Block) -> None:
        """Handle M codes that compensation or cutcomp refuses, that the machine's builder defines, and M61."""
        for code in block.m:
            place = block.at("M", code)
            if self.active and code in REFUSED_M:
                rule, what = REFUSED_M[code]
                what = f"M{code / 10:g} {what}, which is not allowed under compensation"
                self.log.stop(rule, f"{what}; write G40 in a block before it.", place)
            if code == _SET_TOOL_CODE:
                self._set_tool(block)
            if code in _RESTORE_CODES:
                text = f"cutcomp does not restore what M{code / 10:g} restores. Write the codes themselves."
                self.log.stop("BEYOND", text, place)
            if code >= 1000:
                text = f"What M{code / 10:g} does is set up on the machine; cutcomp takes it as moving nothing."
                self.log.inform("M", text, place)

    def _other_words(self, block: Block) -> None:
        """Check that M codes exist, that words have the code they need, and that the table has the tool of an H."""
        self._alone(block)
        for code in block.m:
            if code not in _KNOWN_M:
                text = f"M{code / 10:g} is not an M code of this control. Remove it."
                self.log.stop("CODE", text, block.at("M", code))
        given = {f"G{code}" for code in block.g} | {f"M{code}" for code in block.m}
        mode = self._motion(block)
        if mode is not None:
            given.add(f"G{mode}")
        for letter, codes_for in WORDS_NEED_CODES.items():
            if letter in block.words and given.isdisjoint(codes_for):
                text = f"No code in this block uses {letter}. Remove it."
                text = f"{text} {D_AND_H_ANYWHERE}" if letter == "H" else text
                self.log.stop("N-WORDALONE", text, block.at(letter))
        if 40 in block.g and block.words.get("P", -1.0) < 0.0:
            self.log.stop("N-WORDALONE", "G4 needs P and the seconds to wait.", block.at("G", 40))
        # H0 means no tool
        number = whole(block.words.get("H", 0.0))
        if number is None or (number and self.machine.tools.get(number) is None):
            self.log.stop("TOOL", missing_tool(number), block.at("H"), tool=number)

    def _alone(self, block: Block) -> None:
        """Check that calls and numbers of subprograms stand alone, and that only one G code takes the axis words."""
        if 980 in block.m or "O" in block.words:
            if block.g or len(block.m) > 1 or not _CALL_LETTERS.issuperset(block.words):
                text = "A call or a number of a subprogram must be alone in its block. Write the rest in another block."
                self.log.stop("SUBPROGRAM", text, block.at("OM"))
        elif not _TAKES_AXES.isdisjoint(block.g) and any(code <= 30 and code != 40 for code in block.g):
            text = "Two G codes of this block use its axis words. Write them in two blocks."
            self.log.stop("N-TWOG", text, block.at("G"))

    def _motion(self, block: Block) -> int | None:
        """Return the motion code that a block's words belong to."""
        given = [code for code in block.g if code in DIALECT.codes and DIALECT.codes[code].group == "motion"]
        return next((code for code in given if code != G80), given[0] if given else self.machine.mode)

    def _set_tool(self, block: Block) -> None:
        """M61 Q: set the number of the tool in the spindle, without a tool change."""
        number = whole(block.words.get("Q", -1.0))
        if number is None or number < 0:
            text = "M61 needs Q and the number of the tool that is in the spindle."
            self.log.stop("N-WORDALONE", text, block.at("M", _SET_TOOL_CODE))
        if number and self.machine.tools.get(number) is None:
            self.log.stop("TOOL", missing_tool(number), block.at("Q"), tool=number)
        self.machine.tool = number
        self.tool_changed()

    def tool_changed(self) -> None:
        """M6 and M61: take the position from the axes; after G40 that may be an offset point."""
        first, second = self.here
        self.machine.position = solid(first, second, flat(self.machine.position, self.plane)[2], self.plane)

    def _arc_words(self, block: Block) -> None:
        """Stop the run at I, J, K or R in a straight move, unless G10, G64 or M19 uses them."""
        if self._motion(block) in (0, 10) and not {100, 640}.intersection(block.g) and _ORIENT_CODE not in block.m:
            self.log.stop("N-WORDALONE", "I, J, K and R go with G2 and G3 only. Remove them.", block.at("IJKR"))

    def takes_effect(self, code: int, block: Block) -> bool:
        """Stop the run at what compensation refuses; return False for G92.1 to G92.3, which then do nothing."""
        if code in _SHIFT_CANCEL_CODES:
            text = f"The control ignores G{code / 10:g} under compensation; write G40 before it."
            self.log.warn("N-OFFSETS", text, block.at("G", code))
            return False
        if code in REFUSED_UNDER_COMPENSATION or (code == _G10 and self._sets_system_in_force(block)):
            rule, what = REFUSED_UNDER_COMPENSATION.get(code, ("N-OFFSETS", "changes the origin"))
            text = f"G{code / 10:g} {what}, which is not allowed under compensation; write G40 before it."
            self.log.stop(rule, text, block.at("G", code))
        if code in PLANE_OF_CODE and PLANE_OF_CODE[code] is not self.machine.plane:
            text = "The plane cannot be changed under compensation; write G40 before it."
            self.log.stop("N-PLANE", text, block.at("G", code))
        return True

    def _sets_system_in_force(self, block: Block) -> bool:
        """True if G10 L2 or L20 changes the work offset in force."""
        number = whole(block.words.get("P", -1.0))
        if whole(block.words.get("L", -1.0)) not in (2, 20) or number is None:
            return False
        return number == 0 or system_code(number) == self.machine.origin.system

    def program_stop(self) -> None:
        """M0, M1 and M60: run the held move to its own end at once."""
        self.run_out_at_stop()

    def compensation_on(self, side: Side, block: Block) -> None:
        """G41, G42, G41.1 and G42.1: turn compensation on."""
        if self.machine.plane is Plane.YZ:
            text = "Compensation works in the planes G17 and G18 only; write one of them before it."
            self.log.stop("N-XZYZ", text, block.at_side())
        if self.active:
            text = "Compensation is on already; write G40 before it is turned on again."
            self.log.stop("N-ONWHENON", text, block.at_side())
        radius, orientation = self.radius(block)
        self.note_programmed_radius(radius, "The diameter is negative: the tool runs on the other side.", block)
        self.turn_on(radius * side.sign, orientation)

    def radius(self, block: Block) -> tuple[float, int]:
        """Return the programmed radius, millimeters, negative to flip the side; and a lathe tool's orientation."""
        if not {411, 421}.isdisjoint(block.g):
            if "D" not in block.words:
                self.log.stop("N-DMISSING", "G41.1 and G42.1 need D and the cutter's diameter.", block.at_side())
            return block.words["D"] * self.machine.scale / 2, self._orientation(block)
        number = self.machine.tool
        if "D" in block.words:
            # D0 is the tool in the spindle
            text = "D is a tool number: a whole number, not below 0; a diameter goes with G41.1."
            number = whole_word(block, "D", self.log, "N-DNEGATIVE", text) or self.machine.tool
        tool = self.machine.tools.get(number)
        if tool is None:
            if number == 0 or "D" not in block.words:
                self.machine.nothing_compensated("No tool is loaded, so the radius is 0.", block.at_side())
                return 0.0, 0
            self.log.stop("N-DBIG", missing_tool(number), block.at("D"), tool=number)
        if tool.orientation not in (0, 9) and self.machine.plane is not Plane.ZX:
            self.log.stop("N-ORIENTATION", "The tool is a lathe tool and needs the plane G18.", block.at_side())
        return tool.diameter_mm(self.machine.unit) / 2, tool.orientation

    def _orientation(self, block: Block) -> int:
        if "L" in block.words and self.machine.plane is not Plane.ZX:
            text = "L, the orientation of a lathe tool, goes with G18 only. Remove it."
            self.log.stop("N-ORIENTATION", text, block.at("L"))
        return int(block.words.get("L", 0.0))


_G10: Final = 100
_ORIENT_CODE: Final = 190
_SET_TOOL_CODE: Final = 610
_LATHE_CODES: Final = frozenset((70, 80))
_SHIFT_CANCEL_CODES: Final = frozenset((921, 922, 923))
_RESTORE_CODES: Final = frozenset((720, 730))
_USER_M: Final = tuple(f"M{code}" for code in range(1000, 2000, 10))
_SWITCHED: Final = tuple(f"M{code}" for code in (500, 510, 520, 530, 620, 630, 640, 650, 660))
_CYCLE_CODES: Final = tuple(f"G{code}" for code in (730, *range(810, 900, 10)))

WORDS_NEED_CODES: Final[Mapping[str, frozenset[str]]] = {
    "L": frozenset(("G100", "G410", "G411", "G420", "G421", "M660", "M980", *_CYCLE_CODES)),
    "P": frozenset(("G20", "G30", "G40", "G100", "G640", "M190", "M980", "G740", *_CYCLE_CODES, *_SWITCHED, *_USER_M)),
    "Q": frozenset(("G100", "G640", "M190", "M610", "M660", "M670", "M680", *_CYCLE_CODES, *_USER_M)),
    "H": frozenset(("G430", "G432", "G760")),
    "E": frozenset(("G700", "G760", "M660", "M670", "M680")),
}
"""Words that a block may have only together with one of these codes."""

_OTHERS: Final = frozenset((*WORDS_NEED_CODES, "O"))
_CALL_LETTERS: Final = frozenset("OPLN")
_TAKES_AXES: Final = frozenset((100, 280, 300, 520, 920))
_KNOWN_M: Final = frozenset(
    10 * code for code in (*range(10), 19, 30, *range(48, 54), *range(60, 69), *range(70, 74), 98, 99, *range(100, 200))
)
MAX_M_CODES: Final = 4
_M_GROUPS: Final = tuple(
    frozenset(10 * code for code in group)
    for group in (
        (0, 1, 2, 30, 60, 99),
        (3, 4, 5, 19, *range(70, 74)),
        (6, 61),
        (7, 8, 9),
        range(48, 54),
        range(62, 69),
        range(100, 200),
    )
)
"""Stops, spindle, tool, coolant, overrides, outputs, user codes: the interpreter refuses two of a group in a block."""
