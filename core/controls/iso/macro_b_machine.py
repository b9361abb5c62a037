"""This module runs blocks of Fanuc and Haas mills, with offset memories, system variables and coordinate transforms.

Programmed points are converted to work coordinates before compensation: polar coordinates first, then rotation,
scaling and mirror image.  After a move to a machine position an axis is at an unknown place until its absolute word.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import atan2, hypot, tan
from typing import Final, NoReturn

from core.controls.compensation.elements import arc_element
from core.controls.control_run import Spot
from core.controls.control_tools import ToolTable
from core.controls.iso.arcs import IN_PLANE
from core.controls.iso.dialect import Code, CodeAction, Dialect, p_is_of_g54
from core.controls.iso.expressions import FaultError
from core.controls.iso.machine import TOOL_CHANGE, Control, Machine
from core.controls.iso.macro_b import VACANT
from core.controls.iso.modal_state import EXTERNAL_OFFSET, ORIGIN, TAKEN_AS_ZERO
from core.controls.iso.reader import Block, whole, whole_word
from core.controls.moves import Point3, flat, solid
from core.controls.transform import UNSCALED, Transform, rotated
from core.tolerance import ON_PATH
from core.units import Unit, from_mm, to_mm

_LENGTH_OFFSET_L: Final = 10
_LENGTH_WEAR_L: Final = 11
_RADIUS_OFFSET_L: Final = 12
_RADIUS_WEAR_L: Final = 13
"""The L of G10 that writes each memory of tool offsets."""

EXTENDED_SYSTEM: Final = 100_000
"""The key of work offset G54.1 P is this plus its P."""

HAAS_SYSTEMS: Final = tuple(range(1100, 1300, 10))
"""G110 to G129 of a Haas, the same as its G154 P1 to P20."""

LEAST_FACTOR: Final = 0.01
"""A smaller factor of G51 is one that was meant to have a decimal point."""

FIRST_BUILDER_CODE: Final = 1000
"""G codes from G100 on that the control does not have may call macros."""

_CANCEL_CODES: Final = (150, 500, 690)
"""Codes that cancel a transform and leave the axis words of their block for a move."""

_LINE_CODE: Final = 10
ARC_CODES: Final = frozenset({20, 30})

_CLOCK_VARIABLES: Final = (3001, 3002, 3011, 3012)
_POSITION_VARIABLES: Final = frozenset((5001, 5002, 5003, 5041, 5042, 5043))
_PROGRAM_VARIABLE: Final = 4115
"""The number of the program: a file that is run need not have one."""

_NO_EFFECT: Final = (3003, 3004, 3006, 3007)
_GROUP_VARIABLES: Final[Mapping[int, tuple[str, int]]] = {
    4001: ("motion", 0),
    4002: ("plane", 170),
    4003: ("distance", 900),
    4004: ("stroke", 230),
    4005: ("feed", 940),
    4006: ("units", 210),
    4007: ("compensation", 400),
    4008: ("length", 490),
    4009: ("cycle", 800),
    4010: ("retract", 980),
    4011: ("scaling", 500),
    4012: ("macro", 670),
    4013: ("spindle", 970),
    4014: ("system", 540),
    4015: ("path", 640),
    4016: ("rotation", 690),
    4017: ("polar", 150),
    4022: ("mirror", 501),
}
"""The code group whose code in force a variable reads, and the code in force at the start."""

_LAST_WORDS: Final[Mapping[int, str]] = {
    4102: "B",
    4107: "D",
    4109: "F",
    4111: "H",
    4113: "M",
    4114: "N",
    4119: "S",
    4120: "T",
}


class MacroMachine(Machine):
    """Runs the blocks of a Fanuc or Haas program.

    `memories` have the offsets as the program wrote them, in millimeters by number, for each L of G10.  `separate`: D
    has a memory apart from that of H, always or once the program writes to it; until then they share one.
    `unknown` are the axes whose position is unknown; `in_force` has the code of each group; `last_words` the values
    last programmed, for variables that read them; `line` is the line whose expressions are evaluated.
    `start_unknown`: the block's move starts at a machine position in the plane.  `has_height`: a Z has been programmed.
    `raised`: since then a change to another tool has raised it.  `probed`: a probe may have stopped the last move.
    `polar` is the radius and angle last programmed under G16, None without it.  `following` is the next block if the
    corner before it is to be rounded or chamfered; `corner_point` is that corner afterward.
    """

    def __init__(self, dialect: Dialect, control: Control, tools: ToolTable) -> None:
        super().__init__(dialect, control, tools)
        kinds = (_LENGTH_OFFSET_L, _LENGTH_WEAR_L, _RADIUS_OFFSET_L, _RADIUS_WEAR_L)
        self.memories: dict[int, dict[int, float]] = {kind: {} for kind in kinds}
        self.separate = dialect.diameters_apart
        self.transform = Transform()
        self.unknown: set[int] = set()
        self.in_force = dict(_GROUP_VARIABLES.values()) | {"units": 200 if dialect.unit is Unit.IN else 210}
        self.last_words: dict[str, float] = {}
        self.polar: tuple[float, float] | None = None
        self.current = Block(1, "")
        self.line = 1
        self.start_unknown = self.start_height_unknown = self.has_height = self.raised = self.probed = False
        self.following: Block | None = None
        self.corner_point: Point3 | None = None

    def step(self, block: Block) -> None:
        """Run one block, and only then update the words that variables read."""
        self.current, self.line, self.start_unknown, self.start_height_unknown = block, block.line, False, False
        super().step(block)
        for letter in _LAST_WORDS.values():
            if letter in block.words:
                self.last_words[letter] = block.words[letter]
        if block.m:
            self.last_words["M"] = block.m[-1] / 10

    def _grouped(self, block: Block) -> list[Code]:
        for number in block.g:
            if number >= FIRST_BUILDER_CODE and number not in self.dialect.codes:
                text = f"G{number / 10:g} may be a macro of the machine ({self.dialect.macro_codes}). Call it with G65."
                self.log.stop("CODE", text, block.at("G", number))
        codes = super()._grouped(block)
        for code in codes:
            if code.group in self.in_force:
                self.in_force[code.group] = code.value
            if code.group == "motion":
                self.in_force["cycle"] = 800
        return codes

    # points

    def target(self, words: Mapping[str, float], start: Point3 | None = None) -> Point3:
        """Return where a block's axis words lead, in millimeters in work coordinates."""
        if start is None:
            # after a corner the tool is where its rounding ended, but the program is at the corner
            start, self.corner_point = self.corner_point or self.position, None
        for axis, letter in enumerate("XYZ"):
            if letter in words and axis in self.unknown:
                if self.incremental and words[letter]:
                    text = f"Where {letter} stands after the move to the machine's point is not known. Write G90."
                    self.log.stop("FN-WHERE", text, self.current.at(letter))
                self.unknown.discard(axis)
                self.start_unknown |= axis in self.plane.axes[:2]
                self.start_height_unknown |= axis == 2
        if "Z" in words:
            self.start_height_unknown |= self.raised
            self.has_height, self.raised = True, False
        start = self.transform.undone(start)
        to = super().target(words, start) if self.polar is None else self._polar_target(words, start, *self.polar)
        return self.transform.applied(to)

    def _polar_target(self, words: Mapping[str, float], start: Point3, radius: float, angle: float) -> Point3:
        """Return the programmed point under G16: the plane's first axis is a radius, its second an angle in degrees."""
        first, second, third = ("XYZ"[axis] for axis in self.plane.axes)
        here, origin = flat(start, self.plane), flat(self.shift, self.plane)
        radius = words[first] * self.scale if first in words else radius
        if second in words:
            angle = words[second] + (angle if self.incremental else 0.0)
        self.polar = radius, angle
        center = here if self.incremental and first in words else origin
        height = here[2]
        if third in words:
            height = words[third] * self.scale + (here[2] if self.incremental else origin[2])
        if first not in words and second not in words:
            return solid(here[0], here[1], height, self.plane)
        x, y = rotated((radius, 0.0), angle)
        return solid(center[0] + x, center[1] + y, height, self.plane)

    def _motion(self, block: Block) -> None:
        if block.corner is not None:
            if self.mode in ARC_CODES:
                self._stop_at_arc_corner(block)
            if self.mode != _LINE_CODE or {"X", "Y", "Z"}.isdisjoint(block.words):
                self._stop_without_two_lines(block)
        super()._motion(block)

    def _stop_at_arc_corner(self, block: Block) -> NoReturn:
        text = "cutcomp follows ,R and ,C only between two straight moves. Write the corner's moves."
        self.log.stop("BEYOND", text, block)

    def _stop_without_two_lines(self, block: Block) -> NoReturn:
        text = "A rounding or chamfer stands between two straight moves. Write the second one in the next block."
        self.log.stop("PS0051", text, block)

    def _straight(self, block: Block, end: Point3, *, rapid: bool) -> None:
        following, self.following = self.following, None
        self._note_lost_height()
        if block.corner is None or block is not self.current:
            super()._straight(block, end, rapid=rapid)
            return
        if following is not None and not ARC_CODES.isdisjoint(following.g):
            self._stop_at_arc_corner(block)
        if following is None or rapid or not self._goes_on_straight(following):
            self._stop_without_two_lines(block)
        incremental = self.incremental
        self.incremental = 910 in following.g or (incremental and 900 not in following.g)
        polar = self.polar
        beyond = self.target(following.words, end)
        self.incremental, self.polar = incremental, polar
        self._cut_corner(block, end, beyond)

    def _note_lost_height(self) -> None:
        """Tell the tape if the height or the start of the next move is unknown, after a machine position or a probe."""
        self.control.tape.lost = 2 in self.unknown or self.start_height_unknown or self.raised or self.probed
        self.probed = False

    def _goes_on_straight(self, block: Block) -> bool:
        letters = {"XYZ"[axis] for axis in self.plane.axes[:2]}
        return {10, 900, 910}.issuperset(block.g) and not letters.isdisjoint(block.words)

    def _cut_corner(self, block: Block, corner: Point3, beyond: Point3) -> None:
        """Cut a corner with `,R` or `,C`: the line ends before it, and an arc or a line leads onto the next one."""
        assert block.corner is not None
        kind, value = block.corner[0], block.corner[1] * self.scale
        (ax, ay, low), (px, py, high) = flat(self.position, self.plane), flat(corner, self.plane)
        bx, by, beyond_height = flat(beyond, self.plane)
        first, second = hypot(px - ax, py - ay), hypot(bx - px, by - py)
        if not first or not second or not low == high == beyond_height or value < 0.0:
            text = "A rounding or chamfer needs two straight moves in the plane and a size above 0."
            self.log.stop("PS0051", text, block)
        into, out = ((px - ax) / first, (py - ay) / first), ((bx - px) / second, (by - py) / second)
        angle = atan2(into[0] * out[1] - into[1] * out[0], into[0] * out[0] + into[1] * out[1])
        reach = value if kind == "C" else value * tan(abs(angle) / 2)
        if reach > min(first, second):
            text = "The rounding or chamfer is longer than a move beside it: {0} of {1}. Write a smaller one."
            self.log.stop("PS0055", text, block, lengths=(reach, min(first, second)))
        start, end = (px - reach * into[0], py - reach * into[1]), (px + reach * out[0], py + reach * out[1])
        super()._straight(block, solid(*start, low, self.plane), rapid=False)
        if kind == "C" or not reach:
            super()._straight(block, solid(*end, low, self.plane), rapid=False)
        else:
            turn = 1 if angle > 0.0 else -1
            center = (start[0] - turn * value * into[1], start[1] + turn * value * into[0])
            self.position = solid(*end, low, self.plane)
            self.control.travel(arc_element(start, end, center, turn, low, low, self.feed, block.line))
        self.corner_point = corner

    def _arc(self, block: Block, turn: int) -> None:
        if self.unknown & set(self.plane.axes[:2]):
            text = "Where the arc starts is not known after the move to the machine's point."
            self.log.stop("FN-WHERE", f"{text} Write a straight move first.", block.at("G"))
        self._note_lost_height()
        words = dict(block.words)
        if "R" in words:
            for letter in "IJK":
                words.pop(letter, None)
            if self._ends_where_it_starts(words):
                text = "The arc with R ends where it starts: no move. A full circle needs I and J."
                self.log.warn("FN-R", text, block.at("R"))
                return
            words["R"] *= abs(self.transform.factors[0])
        elif self.transform:
            self._transform_center(words)
        super()._arc(replace(block, words=words), -turn if self.transform.flips(self.plane) else turn)

    def _ends_where_it_starts(self, words: Mapping[str, float]) -> bool:
        polar = self.polar
        (ax, ay, _), (bx, by, _) = flat(self.position, self.plane), flat(self.target(words), self.plane)
        self.polar = polar
        return hypot(bx - ax, by - ay) < 1e-9

    def _transform_center(self, words: dict[str, float]) -> None:
        first, second, _ = IN_PLANE[self.plane]
        vector = solid(words.get(first, 0.0), words.get(second, 0.0), 0.0, self.plane)
        turned = flat(self.transform.vector(vector), self.plane)
        if first in words or second in words:
            words[first], words[second] = turned[0], turned[1]

    # codes

    def _take_tool(self, block: Block) -> None:
        before = self.tool
        super()._take_tool(block)
        # with its tool already in the spindle, M6 may move nothing
        self.raised |= self.has_height and TOOL_CHANGE in block.m and self.tool != before

    def _act(self, code: Code, block: Block) -> None:
        if code.action is CodeAction.SIDE and code.value != 400 and self.transform.flips(self.plane):
            code = replace(code, value=830 - code.value)
        if code.action is CodeAction.UNAVAILABLE:
            text = f"G{code.value / 10:g} is not a code of this control; what it asks for is so anyway."
            self.log.warn("FN-G911", text, block.at("G", code.value))
            return
        super()._act(code, block)

    def _run_non_modal(self, code: Code, block: Block) -> None:
        if block.corner is not None and code.value not in _CANCEL_CODES:
            self._stop_without_two_lines(block)
        if code.action is CodeAction.TRANSFORM:
            self._set_transform(code.value, block)
            if code.value in _CANCEL_CODES:
                self._motion(block)
        elif code.action is CodeAction.SKIP:
            text = "Where a skip signal stops this move is not known; cutcomp runs it to its end."
            self.log.warn("FN-SKIP", text, block.at("G", 310))
            self._straight(block, self.target(block.words), rapid=False)
            self.probed = True
        else:
            super()._run_non_modal(code, block)

    def _set_transform(self, code: int, block: Block) -> None:
        words, state = block.words, self.transform
        self._check_order(code, block)
        match code:
            case 150:
                self.polar = None
            case 160:
                self.polar = (0.0, 0.0)
            case 500:
                self.transform = replace(state, factors=UNSCALED)
            case 690:
                self.transform = replace(state, angle=0.0)
            case 501:
                named = [axis for axis in range(3) if "XYZ"[axis] in words] or [0, 1, 2]
                kept = {axis: at for axis, at in state.mirror.items() if axis not in named}
                self.transform = replace(state, mirror=kept)
            case 511:
                coordinates = {axis: self._absolute(axis, words) for axis in range(3) if "XYZ"[axis] in words}
                self.transform = replace(state, mirror={**state.mirror, **coordinates})
            case 510:
                self._scale(block)
            case 680:
                self._rotate(block)

    def _absolute(self, axis: int, words: Mapping[str, float]) -> float:
        """Return a coordinate of a transform's block; without its word, the tool's before scaling and mirror image."""
        letter = "XYZ"[axis]
        if letter in words:
            return words[letter] * self.scale + self.shift[axis]
        return replace(self.transform, angle=0.0).undone(self.position)[axis]

    def _check_order(self, code: int, block: Block) -> None:
        """Stop if a transform begins out of order: mirror, scaling, rotation; warn if one ends before the rotation."""
        state, name, place = self.transform, f"G{code / 10:g}", block.at("G", code)
        before = "G68" if state.angle else "G51" if code == 511 and state.factors != UNSCALED else ""
        if before and code in (510, 511):
            text = f"cutcomp does not follow {name} while {before} is in force. Write it before {before}."
            self.log.stop("BEYOND", text, place)
        if code in (500, 501) and state.angle and (state.mirror or state.factors != UNSCALED):
            text = f"{name} stands before G69; cutcomp assumes that the rotation goes on as programmed."
            self.log.warn("FN-ROTATION", text, place)

    def _scale(self, block: Block) -> None:
        """Run G51 P, or G51 I J K of one size, negative ones for a mirror image about the center of scaling.

        Source: Fanuc 16i/18i-PB descriptions B-63682EN/01 p. 117, "Scaling of each axis (Mirror image)".
        """
        words = block.words
        letters = [letter for letter in "IJK" if letter in words]
        if bool(letters) == ("P" in words) or (letters and not self.dialect.scales_axes):
            text = "cutcomp follows G51 with one P for all axes only. Write out the moves that it scales or mirrors."
            self.log.stop("BEYOND", text, block.at("G", 510))
        if letters:
            factors = self._axis_factors(block, letters)
        else:
            factor = self._factor(block, "P")
            if factor <= 0.0:
                self.log.stop("PS0006", "The factor P of G51 must be larger than 0.", block.at("P"))
            factors = factor, factor, factor
        x, y, z = (self._absolute(axis, words) for axis in range(3))
        self.transform = replace(self.transform, factors=factors, fixed=(x, y, z))

    def _factor(self, block: Block, letter: str) -> float:
        number = block.words[letter]
        whole_number = any(word.letter == letter and "." not in word.number for word in block.written())
        factor = number / 1000 if whole_number else number
        if 0.0 < abs(factor) < LEAST_FACTOR:
            text = f"{letter} of G51 without a decimal point counts thousandths: here it is a factor of {factor:g}. "
            self.log.stop("BEYOND", f"{text}Write {letter}1. or {letter}1000 for 1.", block.at(letter))
        return factor

    def _axis_factors(self, block: Block, letters: Sequence[str]) -> Point3:
        x, y, z = (self._factor(block, letter) if letter in letters else 1.0 for letter in "IJK")
        if abs(x) != abs(y) or abs(x) != abs(z) or not x:
            text = "cutcomp follows G51 with I, J and K of one size only. Write out the moves that it scales."
            self.log.stop("BEYOND", text, block.at(letters[0]))
        if len(letters) < len("IJK"):
            text = "cutcomp takes 1 for the axes without I, J or K. The control takes them from parameter 5421."
            self.log.warn("FN-SCALE", text, block.at(letters[0]))
        if self.transform.mirror and min(x, y, z) < 0.0:
            text = "cutcomp does not follow a mirror image by G51 and one by G51.1 together. Write out the moves."
            self.log.stop("BEYOND", text, block.at("G", 510))
        return x, y, z

    def _rotate(self, block: Block) -> None:
        words, place = block.words, block.at("G", 680)
        if not {"I", "J", "K"}.isdisjoint(words):
            text = "cutcomp follows G68 with an angle R only. Write out the moves that it turns."
            self.log.stop("BEYOND", text, place)
        if "R" not in words:
            text = "G68 has no R: the control may turn by the angle of a parameter or setting. Write R."
            self.log.stop("BEYOND", text, place)
        if min(self.transform.factors) < 0.0:
            text = "cutcomp does not follow G68 under a mirror image by G51. Write out the moves."
            self.log.stop("BEYOND", text, place)
        if self.incremental:
            text = "cutcomp takes R of G68 as an angle from 0. Under G91 the control may add it to the angle in force."
            self.log.warn("FN-ROTATION", text, place)
        if self.transform.mirror or self.transform.factors != UNSCALED:
            text = "cutcomp assumes that the mirror image or scaling in force holds for the center of G68 too."
            self.log.warn("FN-ROTATION", text, place)
        first, second, _ = self.plane.axes
        center = self._absolute(first, words), self._absolute(second, words)
        self.transform = replace(self.transform, angle=words["R"], center=center, plane=self.plane)

    # origins and machine positions

    def _home(self, block: Block) -> None:
        """Run G28 or G30: move by way of the block's point to a machine position, which is not known here."""
        named = [axis for axis in range(3) if "XYZ"[axis] in block.words]
        if named:
            end = self.target(block.words)
            if end != self.position:
                self._straight(block, end, rapid=True)
        elif self.dialect.homes_all:
            named = [0, 1, 2]
        self._mark_unknown(named, block)

    def _move_in_machine(self, block: Block) -> None:
        """Run G53: move to a machine position, which is not known here."""
        self._mark_unknown([axis for axis in range(3) if "XYZ"[axis] in block.words], block)

    def _mark_unknown(self, axes: list[int], block: Block) -> None:
        """Mark axes as being at a machine position until their next absolute words; warn if X or Y goes there low."""
        height = self.position[2] - self.shift[2]
        known = self.has_height and not self.raised and 2 not in self.unknown
        if {0, 1} & set(axes) and known and height < -ON_PATH:
            named = " and ".join("XYZ"[axis] for axis in axes if axis < 2)
            text = (
                f"The tool is still at Z {{0}} when it goes to the machine's {named}. Raise it in a block before this."
            )
            self.log.warn("HOME", text, block.at("G"), lengths=(height,))
        self.unknown.update(axes)
        if axes:
            text = "The machine's points are not known to cutcomp; the move there is not shown."
            self.log.inform("HOME", text, block.at("G"))

    def _select_system(self, code: int, block: Block) -> None:
        if code in HAAS_SYSTEMS:
            name, number = f"G{code // 10}", HAAS_SYSTEMS.index(code) + 1
        elif code in (541, 1540) or (self.dialect.g54_takes_p and p_is_of_g54(block, self.mode)):
            text = "P is the number of a work offset, 1 to 300."
            number = whole_word(block, "P", self.log, "PS0030", text, 1, 300, default=1.0)
            name = f"G54.1 P{number}"
        else:
            super()._select_system(code, block)
            return
        if EXTENDED_SYSTEM + number not in self.origin.systems:
            self.log.warn("OFFSET", f"The offset of {name} {TAKEN_AS_ZERO}", block.at("G"))
        self.set_origin(replace(self.origin, system=EXTENDED_SYSTEM + number))

    def _set_data(self, block: Block) -> None:
        """Run G10: set work offsets (L2, L20) or tool offsets (L1, L10 to L13)."""
        if "L" not in block.words and "R" in block.words:
            text = "G10 with R and without L sets a tool's offset on old controls only. Write L10, L11, L12 or L13."
            self.log.stop("BEYOND", text, block.at("G", 100))
        kind, number = whole(block.words.get("L", 2.0)), whole(block.words.get("P", -1.0))
        if kind == 50 or kind == 52:
            text = "The program writes parameters of the control, and what follows may be wrong. Set them by hand."
            self.log.stop("FN-PARAMETER", text, block.at("L"))
        if number is None or number < 0:
            self.log.stop("PS0031", "G10 needs P and the number of the offset.", block.at("GP"))
        if kind == 1 or kind in self.memories:
            self._set_offset(_LENGTH_OFFSET_L if kind == 1 else kind, number, block)
        elif kind == 2 and number <= 6:
            self._set_work_offset(530 + 10 * number if number else EXTERNAL_OFFSET, block)
        elif kind == 20 and 1 <= number <= 300:
            self._set_work_offset(EXTENDED_SYSTEM + number, block)
        else:
            text = "G10 has L2 or L20 for work offsets, L1 and L10 to L13 for tool offsets. Correct L or P."
            self.log.stop("PS0031", text, block.at("LP"))

    def _set_work_offset(self, code: int, block: Block) -> None:
        old = self.origin.systems.get(code, ORIGIN)
        offset = self.axis_words(block, old)
        if self.incremental:
            x, y, z = (before + step for before, step in zip(old, self.axis_words(block, ORIGIN), strict=True))
            offset = (x, y, z)
        self.set_system(code, offset)

    def _set_offset(self, kind: int, number: int, block: Block) -> None:
        if "R" not in block.words:
            self.log.stop("PS0032", "G10 needs R and the value of the offset.", block.at("GL"))
        self._write_offset(kind, number, block.words["R"] * self.scale / self._radii_in(kind), add=self.incremental)
        if kind not in (_RADIUS_OFFSET_L, _RADIUS_WEAR_L) and not self.separate:
            text = "Lengths and radii are taken to share one memory, so this value is a radius for D too."
            self.log.inform("FN-SHARED", text, block.at("L"))

    def _radii_in(self, kind: int) -> float:
        """Return how many radii a value of this L is; warn once if it is 2, a diameter."""
        if kind not in (_RADIUS_OFFSET_L, _RADIUS_WEAR_L) or not self.dialect.diameters_apart:
            return 1.0
        if not self.log.has("HAAS-DIAMETER"):
            text = "D is taken as a diameter (setting 40 DIAMETER). With RADIUS the control uses twice this offset."
            self.log.warn("HAAS-DIAMETER", text, Spot(self.line))
        return 2.0

    def _write_offset(self, kind: int, number: int, value: float, *, add: bool = False) -> None:
        """Write a value in millimeters, or add it, to the memory of an L, and to that of D while they share one."""
        if kind in (_RADIUS_OFFSET_L, _RADIUS_WEAR_L):
            self.separate = True
        radii, kinds = self.memories[_RADIUS_OFFSET_L], [kind]
        if not self.separate:
            kinds.append(_RADIUS_WEAR_L if kind == _LENGTH_WEAR_L and number in radii else _RADIUS_OFFSET_L)
        before = self._geometry_radius(number) or 0.0
        for memory in (self.memories[each] for each in kinds):
            known = memory.get(number, before if memory is radii else 0.0)
            memory[number] = value + (known if add else 0.0)

    def offset_radius(self, number: int) -> float | None:
        """Return the radius of a D in millimeters, wear included; None if neither program nor table has it."""
        radius = self._geometry_radius(number)
        wear = self.memories[_RADIUS_WEAR_L].get(number, 0.0)
        return wear if radius is None and wear else None if radius is None else radius + wear

    def _geometry_radius(self, number: int) -> float | None:
        """Return the radius of a D without its wear: the program's, else that of the tool in the table."""
        radius, tool = self.memories[_RADIUS_OFFSET_L].get(number), self.tools.get(number)
        return tool.diameter_mm(self.unit) / 2 if radius is None and tool is not None else radius

    # variables

    def value_of(self, key: int | str) -> float | str | None:
        """Return a system variable, a sentence if it is not known before the control runs, or None if there is none."""
        if not isinstance(key, int):
            return None
        self._refuse_unknown_memory(key)
        if (offset := self._offset_place(key)) is not None:
            return self._offset_variable(*offset)
        if key in _GROUP_VARIABLES:
            code = self.in_force[_GROUP_VARIABLES[key][0]]
            return float(code - EXTENDED_SYSTEM) if code > EXTENDED_SYSTEM else code / 10
        if key in _LAST_WORDS:
            return self.last_words.get(_LAST_WORDS[key], VACANT)
        if key in _CLOCK_VARIABLES or 1000 <= key <= 1135:
            self._report_unknown_value(key)
            return 0.0
        if 3000 <= key <= 3999:
            return 0.0
        if key in _POSITION_VARIABLES:
            return self._position_variable(key)
        if 5021 <= key <= 5023 or 5061 <= key <= 5083 or key == _PROGRAM_VARIABLE:
            self._report_unknown_value(key)
            return VACANT
        return self._origin_variable(key)

    def _position_variable(self, key: int) -> float | str:
        """Return the programmed position (#5001 to #5003), the tool center's (#5041 to #5043), or why it is unknown."""
        axis, of_center = (key - 1) % 10, key >= 5041
        if axis in self.unknown:
            return f"Where {'XYZ'[axis]} stands after the move to the machine's point is not known. Move it first."
        if of_center and self.control.active:
            return "The next move decides where the center stands under compensation. Read #5001 to #5003 instead."
        point = self.control.tape.last if of_center else self.transform.undone(self.position)
        return from_mm(point[axis] - self.shift[axis], self.unit)

    def _report_unknown_value(self, key: int) -> None:
        text = f"The control knows #{key} only at run time; cutcomp takes nothing or 0."
        self.log.warn("FN-SYSTEM", text, Spot(self.line))

    def _refuse_unknown_memory(self, key: int) -> None:
        """Refuse a variable whose meaning depends on the control's model or its parameters."""
        if self.dialect.diameters_apart and key >= 10_000:
            raise FaultError("BEYOND", f"cutcomp does not follow #{key} on this control. Use #100 to #199.", 0)
        if not self.dialect.diameters_apart and 2401 <= key <= 2499:
            text = f"#{key} is a D only at parameter 6004#5 = 1, which is not followed. Use #13001 and up."
            raise FaultError("BEYOND", text, 0)

    def _offset_place(self, key: int) -> tuple[int, int] | None:
        """Return the L of G10 that writes a variable's memory, and the offset's number in it; None for any other."""
        if self.dialect.diameters_apart:
            row, index = divmod(key - 2001, 200)
            return (_LENGTH_OFFSET_L + row, index + 1) if 0 <= row < 4 else None
        if 2001 <= key <= 2400:
            return (_LENGTH_OFFSET_L, key - 2200) if key > 2200 else (_LENGTH_WEAR_L, key - 2000)
        kinds = {10: _LENGTH_WEAR_L, 11: _LENGTH_OFFSET_L, 12: _RADIUS_WEAR_L, 13: _RADIUS_OFFSET_L}
        return (kinds[key // 1000], key % 1000) if 10_001 <= key <= 13_999 else None

    def _offset_variable(self, kind: int, number: int) -> float:
        memory, tool = self.memories[kind], self.tools.get(number)
        value = memory.get(number, 0.0)
        if kind == _RADIUS_OFFSET_L:
            value = self._geometry_radius(number) or 0.0
        elif kind == _LENGTH_OFFSET_L and number not in memory:
            value = to_mm(tool.length, tool.unit or self.unit) if tool else 0.0
        return from_mm(value * self._radii_in(kind), self.unit)

    def _origin_variable(self, key: int) -> float | None:
        place = (EXTERNAL_OFFSET, key - 5201) if 5201 <= key <= 5203 else _work_offset_place(key)
        if place is not None:
            # a Haas keeps what G52 shifts in #5201 to #5203
            local = self.origin.local[place[1]] if self.dialect.diameters_apart and 5201 <= key <= 5203 else 0.0
            return from_mm(self.origin.systems.get(place[0], ORIGIN)[place[1]] + local, self.unit)
        return 0.0 if 5201 <= key <= 5328 or 2500 <= key <= 2806 or 7001 <= key <= 7999 else None

    def set_variable(self, key: int, value: float) -> bool:
        """Set a system variable; False if a program cannot."""
        millimeters = to_mm(value, self.unit)
        self._refuse_unknown_memory(key)
        if (offset := self._offset_place(key)) is not None:
            self._write_offset(*offset, millimeters / self._radii_in(offset[0]))
            return True
        if key in _NO_EFFECT or key in _CLOCK_VARIABLES or 1100 <= key <= 1135:
            return True
        if (place := _work_offset_place(key)) is None:
            return False
        origin = list(self.origin.systems.get(place[0], ORIGIN))
        origin[place[1]] = millimeters
        self.set_system(place[0], (origin[0], origin[1], origin[2]))
        return True


def _work_offset_place(key: int) -> tuple[int, int] | None:
    """Return the work offset and axis that a variable holds, from #5221, #7001 and #2500 on; None for any other."""
    number, axis = divmod(key - 5221, 20)
    if 0 <= number < 6 and axis <= 2:
        return 540 + 10 * number, axis
    number, axis = divmod(key - 7001, 20)
    if 7001 <= key <= 7943 and axis <= 2:
        return EXTENDED_SYSTEM + 1 + number, axis
    axis, number = divmod(key - 2500, 100)
    if not 0 <= axis <= 2 or number > 6:
        return None
    return 530 + 10 * number if number else EXTERNAL_OFFSET, axis
