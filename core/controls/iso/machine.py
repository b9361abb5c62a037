"""The machine executes the blocks of a word-address program, each block's codes in the order that controls use.

It passes programmed elements to a `Control`, which compensates them and makes the moves.
"""

from __future__ import annotations

from dataclasses import replace
from math import dist, hypot, tau
from typing import Final

from core.controls.compensation.elements import arc_element, element_sweep, line_element, single_turns
from core.controls.compensation.recorder import Recorder
from core.controls.control_run import SetupChange, SpindleChange, Spot
from core.controls.control_tools import ToolTable, missing_tool
from core.controls.iso import cycles
from core.controls.iso.arcs import IN_PLANE, NoArc, center_by_radius, given_center
from core.controls.iso.code_support import CONTROLS_WITH_CODE, OFFSETS_ANYWHERE, TOOL_DATA, lathe_cycle, only_on
from core.controls.iso.dialect import PLANE_OF_CODE, Code, CodeAction, Dialect, unit_of_code, unused_words
from core.controls.iso.modal_state import G54, ORIGIN, PER_MINUTE, TAKEN_AS_ZERO, ModalState, system_code
from core.controls.iso.reader import Block, whole, whole_word
from core.controls.moves import Plane, Point3, flat, without_rounding
from core.geometry.piece import Point, Side
from core.tolerance import ON_PATH
from core.units import Unit, from_mm

NON_MODAL_ACTIONS: Final = frozenset(
    (
        CodeAction.HOME,
        CodeAction.SHIFT,
        CodeAction.PRESET,
        CodeAction.MACHINE,
        CodeAction.DATA,
        CodeAction.SKIP,
        CodeAction.TRANSFORM,
    )
)
"""The actions that use a block's axis words for themselves."""

_G43_1: Final = 431
_G43_2: Final = 432
_G49: Final = 490

_OTHER_AXES: Final = "ABCUVW"
_ARC_TURNS: Final = {20: -1, 30: 1}
_G53: Final = 530
G80: Final = 800
_SURFACE_SPEED: Final = 960
TOOL_CHANGE: Final = 60
_PLANE_CODES: Final = {Plane.XY: 170.0, Plane.ZX: 180.0, Plane.YZ: 190.0}
_POSITION_PARAMETERS: Final = {5420: 0, 5421: 1, 5422: 2, "_X": 0, "_Y": 1, "_Z": 2}
_LINE_CODES: Final = (0, 10)
_MOTION_CODES: Final = frozenset((0, 10, 20, 30))
_END_CODES: Final = frozenset((20, 300))
_STOP_CODES: Final = frozenset((0, 10, 600))
MAX_TURNS: Final = 1_000
"""Most turns of an arc that are followed."""

ARC_CENTER_LETTERS: Final = frozenset("IJKR")


LEFT_OPEN: Final = "The program ends under compensation. Write G40 and a move away from the part."


class Control(Recorder):
    """What a control adds to its machine: compensation, and its own rules for blocks."""

    machine: Machine

    def compensation_on(self, side: Side, block: Block) -> None:
        """Handle G41 or G42, also if already active, before the block's motion."""

    def compensation_off(self, block: Block) -> None:
        """Handle G40 before the block's motion."""

    def before_block(self, block: Block) -> None:
        """Look at a block before any of it takes effect."""

    def tool_called(self, number: int, block: Block) -> None:
        """Handle a T word or tool data before it takes effect."""

    def tool_changed(self) -> None:
        """Handle M6 after it has taken effect."""

    def block_without_motion(self, block: Block) -> None:
        """Handle a block without motion under compensation, after its codes."""

    def maker_code(self, code: int, block: Block) -> None:
        """Handle a G code of this control alone, in tenths."""

    def takes_effect(self, _code: int, _block: Block) -> bool:
        """True if a G code does anything under compensation, asked in its turn; one that is refused stops the run."""
        return True

    def note_programmed_radius(self, radius: float, flips: str, block: Block) -> None:
        """Report the radius of a block with G41 or G42 if it is 0, negative, or not that of the tool in the spindle."""
        if radius == 0.0:
            self.machine.nothing_compensated("The radius is 0.", block.at_side())
        self.note_radius(radius, "NEGATIVE", flips, block.at_side())
        if "D" in block.words:
            self.machine.compare_offset(radius, f"D{block.words['D']:g}", block.at("D"))

    def vector_of(self, block: Block) -> Point | None:
        """Return the vector in the plane that a block gives with I, J, K, millimeters; None if it gives none."""
        first, second, _ = IN_PLANE[self.plane]
        x, y = (block.words.get(letter, 0.0) * self.machine.scale for letter in (first, second))
        return (x, y) if first in block.words or second in block.words else None

    def program_stop(self) -> None:
        """Handle M0, M1 or M60 after the block's motion."""

    def end_of_program(self) -> None:
        """Handle the end of the program."""

    def end(self, line: int) -> None:
        """Handle the end of the program at this line, and warn if it is still under compensation."""
        if self.active and self.machine.side_on:
            self.log.warn("OPEN", LEFT_OPEN, Spot(line))
        self.end_of_program()


class Machine(ModalState):
    """Runs blocks on a control."""

    def __init__(self, dialect: Dialect, control: Control, tools: ToolTable) -> None:
        super().__init__(dialect, tools, control.log)
        self.control, self.side_on = control, False
        self.spindle = [SpindleChange()]
        self.other_axes: dict[str, float] = {}
        self.setups = [SetupChange()]
        self.setup_numbers: dict[tuple[object, ...], int] = {(0,): 0}
        control.machine, control.unit = self, self.unit

    def step(self, block: Block) -> None:
        """Run one block: its codes, then its motion."""
        self.control.before_block(block)
        non_modal = self._codes(block)
        if non_modal is None:
            self._motion(block)
        elif not self.control.active or self.control.takes_effect(non_modal.value, block):
            self._run_non_modal(non_modal, block)
        if not _STOP_CODES.isdisjoint(block.m):
            self.control.program_stop()
        if not _END_CODES.isdisjoint(block.m):
            self.ended = True

    def value_of(self, key: int | str) -> float | str | None:
        """Return a machine value by number or name, a sentence why it has none, or None if it is not known yet."""
        if key in _POSITION_PARAMETERS:
            if self.control.active and isinstance(key, int):
                return "The position cannot be read under compensation; write G40 before it."
            position = self.position if isinstance(key, int) else self.control.readable_position(self.position)
            return from_mm(position[_POSITION_PARAMETERS[key]] - self.shift[_POSITION_PARAMETERS[key]], self.unit)
        tool, system = self.tools.get(self.tool), self.origin.system
        values: dict[int | str, float] = {
            5220: float((system - 530) // 10 if system <= 590 else system - 584),
            5400: float(self.tool),
            5410: from_mm(tool.diameter_mm(self.unit), self.unit) if tool else 0.0,
            "_PLANE": _PLANE_CODES[self.plane],
            "_METRIC": float(self.unit is Unit.MM),
            "_IMPERIAL": float(self.unit is Unit.IN),
            "_ABSOLUTE": float(not self.incremental),
            "_INCREMENTAL": float(self.incremental),
            "_IJK_ABSOLUTE_MODE": float(self.absolute_centers),
            "_COORD_SYSTEM": float(system),
            "_CURRENT_TOOL": float(self.tool),
            "_SELECTED_TOOL": float(self.next_tool),
        }
        return values.get(key)

    def _codes(self, block: Block) -> Code | None:
        """Run all of a block but its motion; return the code that uses the block's axis words for itself, if any."""
        codes = self._grouped(block)
        for code in codes:
            if code.action is CodeAction.RATE:
                self.set_rate(code.value)
            elif code.action is CodeAction.UNITS and self.dialect.unit_first:
                self._set_units(code.value)
        if not self.dialect.unit_first and "F" in block.words:
            self.feed = block.words["F"] * self.scale
        self.take_spindle(block)
        self._take_tool(block)
        self._note_spindle()
        non_modal = None
        for code in codes:
            if self._takes_axis_words(code):
                non_modal = code
            elif not self.control.active or self.control.takes_effect(code.value, block):
                self._set(code, block)
        self._take_other_axes(block, homes=non_modal is not None and non_modal.action is CodeAction.HOME)
        self._note_setup()
        if self.dialect.unit_first and "F" in block.words:
            self.feed = block.words["F"] * self.scale
        if self.dialect.reports_unused:
            self._warn_of_unused(block)
        return non_modal

    def _takes_axis_words(self, code: Code) -> bool:
        if code.action is CodeAction.DWELL:
            return self.dialect.dwell_takes_axes
        return code.action in NON_MODAL_ACTIONS or (code.action is CodeAction.LENGTH and code.value == _G43_1)

    def check_codes(self, block: Block) -> None:
        """Stop the run at an unknown G code."""
        for number in block.g:
            if number not in self.dialect.codes:
                text = f"cutcomp does not know G{number / 10:g} on this control. Remove it or write the control's code."
                text = f"{text} {only_on(CONTROLS_WITH_CODE.get(number, ()))}".rstrip()
                self.log.stop("CODE", lathe_cycle(number, block.words) or text, block.at("G", number))

    def _grouped(self, block: Block) -> list[Code]:
        """Return a block's G codes in execution order; stop at an unknown one or, on most controls, two of a group."""
        self.check_codes(block)
        known, groups = list[Code](), set[str]()
        for number in block.g:
            code = self.dialect.codes[number]
            if number == G80 and code.group == "motion" and self._moves_in(block):
                continue
            if code.group in groups and self.dialect.last_code_counts:
                known = [other for other in known if other.group != code.group]
                text = f"G{number / 10:g} is the second G code of its group in this block; the last one counts."
                self.log.warn(self.dialect.group_rule, text, block.at("G", number))
            elif code.group in groups:
                text = f"G{number / 10:g} is the second G code of its group in this block; keep one."
                self.log.stop(self.dialect.group_rule, text, block.at("G", number))
            groups.add(code.group)
            known.append(code)
        if {"motion", "cycle"} <= groups and any(code.action is CodeAction.CYCLE for code in known):
            rule, place = self.dialect.group_rule, block.at("G")
            if not self.dialect.last_code_counts:
                text = "cutcomp does not know which counts, the motion or the cycle. Write them in two blocks."
                self.log.stop(rule, text, place)
            self.log.warn(rule, "G0 to G3 next to a drilling cycle cancels the cycle. Write them in two blocks.", place)
            known = [code for code in known if code.action is not CodeAction.CYCLE]
        known.sort(key=lambda code: min(code.action.value, CodeAction.SIDE.value + 1))
        return known

    def _moves_in(self, block: Block) -> bool:
        """True if a block has a code of the motion group besides G80."""
        known = (self.dialect.codes.get(number) for number in block.g if number != G80)
        return any(code is not None and code.group == "motion" for code in known)

    def _set(self, code: Code, block: Block) -> None:
        match code.action:
            case CodeAction.MOTION if code.value == G80 and code.group == "cycle":
                self.mode = self.mode if self.mode in _MOTION_CODES else self.cycle.mode_before
                self.cycle.code = None
            case CodeAction.MOTION:
                self.mode, self.cycle.code = code.value, None
            case CodeAction.CYCLE:
                self.cycle.mode_before = self.mode if self.mode in _MOTION_CODES else self.cycle.mode_before
                self.mode = code.value
            case CodeAction.PLANE:
                self.plane = self.control.plane = PLANE_OF_CODE[code.value]
            case CodeAction.UNITS:
                self._set_units(code.value)
            case CodeAction.DISTANCE:
                self.incremental = code.value == 910
            case CodeAction.CENTERS:
                self.absolute_centers = code.value == 901
            case CodeAction.SPINDLE:
                self.surface_speed = code.value == _SURFACE_SPEED
            case CodeAction.RETRACT:
                self.cycle.to_r = code.value == 990
            case _:
                self._act(code, block)

    def _act(self, code: Code, block: Block) -> None:
        """Run a code that does more than set a value."""
        match code.action:
            case CodeAction.SIDE if code.value == 400:
                self.side_on = False
                self.control.compensation_off(block)
            case CodeAction.SIDE:
                self.side_on = True
                self.control.compensation_on(Side.LEFT if code.value // 10 == 41 else Side.RIGHT, block)
            case CodeAction.SYSTEM:
                self._select_system(code.value, block)
            case CodeAction.UNSHIFT:
                # G92.1 forgets the shift of G52 and G92, G92.2 suspends it, G92.3 restores it
                stored = ORIGIN if code.value == 921 else self.origin.stored
                local = stored if code.value == 923 else ORIGIN
                self.set_origin(replace(self.origin, local=local, stored=stored))
            case CodeAction.LENGTH:
                self._take_length(code.value, block)
            case CodeAction.OF_THIS_CONTROL:
                self.control.maker_code(code.value, block)
            case CodeAction.UNSUPPORTED:
                text = f"cutcomp does not support G{code.value / 10:g}. Write out the moves that it makes or changes."
                self.log.stop("BEYOND", lathe_cycle(code.value, block.words) or text, block.at("G", code.value))

    def _set_units(self, code: int) -> None:
        self.unit = self.control.unit = unit_of_code(code)
        self.scale = 1.0 if self.unit is Unit.MM else 25.4
        self.unit_said = True

    def _take_tool(self, block: Block) -> None:
        number, before = self.tool_number(block), self.tool
        if number is not None:
            self.control.tool_called(number, block)
            self.select_tool(number, block)
        if TOOL_CHANGE in block.m:
            self.tool = self.next_tool
            self.control.tool_changed()
        if self.control.active and self.side_on and 400 not in block.g and self.tool != before:
            text = f"Tool {self.tool} is loaded, and compensation goes on with the radius in force. Write G40 first."
            self.log.warn("OFFSET", text, block.at("TM"))

    def _note_spindle(self) -> None:
        """Note the tool and the speed in force, if one has changed; without an M6, the tool is that of the T."""
        change = SpindleChange(len(self.control.tape), self.tool or self.next_tool or None, self.speed or None)
        if change[1:] != self.spindle[-1][1:]:
            self.spindle.append(change)

    def _take_other_axes(self, block: Block, *, homes: bool) -> None:
        """Note where the axes are that are not followed, 0 if the block homes them; warn when a new one appears."""
        for letter in _OTHER_AXES:
            if letter not in block.words:
                continue
            if letter not in self.other_axes:
                self.log.warn("AXIS", f"cutcomp does not follow axis {letter}, only X, Y and Z.", block.at(letter))
            before = self.other_axes.get(letter, 0.0) if self.incremental else 0.0
            self.other_axes[letter] = 0.0 if homes else before + block.words[letter]

    def _note_setup(self) -> None:
        """Note the work offset that the program does not set, and the other axes that are not at 0, on a change."""
        system = self.origin.system
        unknown = 0 if system == G54 or system in self.origin.systems else system
        setup = (unknown, *sorted(item for item in self.other_axes.items() if item[1]))
        number = self.setup_numbers.setdefault(setup, len(self.setup_numbers))
        if number != self.setups[-1].number:
            self.setups.append(SetupChange(len(self.control.tape), number))

    def _warn_of_unused(self, block: Block) -> None:
        """Warn of words that no code uses: a control may do something with them that cutcomp does not follow."""
        unused = unused_words(block, self.mode, self.dialect)
        if unused:
            text = f"No code in this block uses {' and '.join(unused)}. cutcomp ignores it."
            if not {"D", "H"}.isdisjoint(unused):
                text = f"{text} {only_on(OFFSETS_ANYWHERE)}"
            self.log.warn("UNUSED", text, block.at("".join(unused)))

    def _motion(self, block: Block) -> None:
        words, mode = block.words, self.mode
        centered = mode in _ARC_TURNS and not ARC_CENTER_LETTERS.isdisjoint(words)
        if "X" in words or "Y" in words or "Z" in words or centered:
            self._travel(block, mode)
        elif self.dialect.moves_alone and not _MOTION_CODES.isdisjoint(block.g):
            if mode in _ARC_TURNS:
                self.log.stop("ARC", "The arc has neither end point nor center; write them.", block.at("G", mode))
            self._straight(block, self.position, rapid=mode == 0)
        elif self.control.active:
            self.control.block_without_motion(block)

    def _travel(self, block: Block, mode: int | None) -> None:
        if mode in _LINE_CODES:
            self._straight(block, self.target(block.words), rapid=mode == 0)
        elif mode in _ARC_TURNS:
            self._arc(block, _ARC_TURNS[mode])
        elif mode is None or mode == G80:
            self.log.stop("MOTION", "Axis words without a motion in force; write G0, G1, G2 or G3.", block.at("XYZ"))
        else:
            self._drill(block)

    def _straight(self, block: Block, end: Point3, *, rapid: bool) -> None:
        if not self.dialect.rounding_moves:
            end = without_rounding(end, self.position)
        feed = self.feed
        if not rapid and self.rate != PER_MINUTE:
            feed = self.feed_over(block, dist(self.position, end))
        elif not rapid and not feed:
            self.no_feed(block)
        self._first_motion(block)
        ax, ay, low = flat(self.position, self.plane)
        bx, by, high = flat(end, self.plane)
        self.position = end
        self.control.travel(line_element((ax, ay), (bx, by), low, high, rapid, feed, block.line))

    def _first_motion(self, block: Block) -> None:
        if self.first_unit is not None:
            return
        self.first_unit = self.unit
        if not self.unit_said:
            name = "inches" if self.unit is Unit.IN else "millimeters"
            self.log.inform("UNIT", f"The program does not say its unit; cutcomp takes {name}.", block.at("XYZ"))

    def _arc(self, block: Block, turn: int) -> None:
        if not self.feed and self.rate == PER_MINUTE:
            self.no_feed(block)
        self._first_motion(block)
        end = self.target(block.words)
        ax, ay, low = flat(self.position, self.plane)
        bx, by, high = flat(end, self.plane)
        start, stop = (ax, ay), (bx, by)
        if hypot(ax - bx, ay - by) < ON_PATH and "R" not in block.words:
            stop = start
        center = self._center(block, start, stop, turn)
        self.position = end
        turns = self._turns(block)
        element = arc_element(start, stop, center, turn, low, high, self.feed, block.line)
        if self.rate != PER_MINUTE:
            length = hypot((element_sweep(element) + tau * (turns - 1)) * element.radius, high - low)
            element = element._replace(feed=self.feed_over(block, length))
        for each in single_turns(element, turns):
            self.control.travel(each)

    def _turns(self, block: Block) -> int:
        """Return the number of turns of an arc, 1 for one that ends when it first reaches its end."""
        if not self.dialect.arc_turns:
            return 1
        text = f"P, the number of turns of an arc, is a whole number from 1 to {MAX_TURNS}."
        return whole_word(block, "P", self.log, "ARC", text, 1, MAX_TURNS, default=1.0)

    def _center(self, block: Block, start: Point, end: Point, turn: int) -> Point:
        """Return the center of an arc; an impossible arc stops the run."""
        if "R" in block.words and {"I", "J", "K"}.isdisjoint(block.words):
            center = center_by_radius(start, end, block.words["R"] * self.scale, turn)
        else:
            center = self._given_center(block, start, end, absolute=self.centers_from_origin)
        if isinstance(center, NoArc):
            place = block.at("R" if "R" in block.words else "IJK")
            rule = center.fault if center.fault in self.dialect.rule_names else "ARC"
            text = center.text + self._fits_otherwise(block, start, end)
            self.log.stop(rule, text, place, lengths=center.lengths)
        return center

    def _given_center(self, block: Block, start: Point, end: Point, *, absolute: bool) -> Point | NoArc:
        """Return the center from I, J and K, counted from the program's origin or from the arc's start."""
        origin = flat(self.shift, self.plane) if absolute else None
        center = given_center(block.words, self.plane, start, self.scale, origin)
        if isinstance(center, NoArc):
            return center
        return self.dialect.arc_tolerance.refused(start, end, center, self.unit) or center

    def _fits_otherwise(self, block: Block, start: Point, end: Point) -> str:
        """Return what to write if the center is right when counted the other way; "" if it is wrong both ways.

        It is "" for a full circle too, for which any center is right.
        """
        absolute = self.centers_from_origin
        center = self._given_center(block, start, end, absolute=not absolute)
        if "R" in block.words or start == end or isinstance(center, NoArc):
            return ""
        first, second, _ = IN_PLANE[self.plane]
        zero = flat(self.shift, self.plane)[:2] if absolute else start
        meant = "the arc's start" if absolute else "the program's zero"
        numbers = ((coordinate - reference) / self.scale for coordinate, reference in zip(center, zero, strict=True))
        # every control reads a decimal point
        i, j = (f"{round(number, 5) + 0.0:.5f}".rstrip("0") for number in numbers)
        return f" If {first} and {second} are meant from {meant}, write {first}{i} {second}{j}"

    def _drill(self, block: Block) -> None:
        if self.control.active:
            text = "A drilling cycle does not go with compensation; write G40 before it, or G80 and another motion."
            self.log.stop(self.dialect.cycle_rule, text, block.at("GXYZ"))
        for end, rapid in cycles.drill(self, block):
            self._straight(block, end, rapid=rapid)

    def _run_non_modal(self, code: Code, block: Block) -> None:
        """Run a code that uses the block's axis words for itself: G28, G30, G52, G53, G92, G10, G4, G43.1."""
        match code.action:
            case CodeAction.SHIFT:
                local = self.axis_words(block, self.origin.local)
                self.set_origin(replace(self.origin, local=local, stored=local))
            case CodeAction.PRESET:
                local = self._reading_as_written(block, self.origin.base, self.origin.local)
                self.set_origin(replace(self.origin, local=local, stored=local))
            case CodeAction.DATA:
                self._set_data(block)
            case CodeAction.HOME:
                self._home(block)
            case CodeAction.DWELL:
                self._dwell(block)
            case CodeAction.LENGTH:
                self.set_length_offset(self.axis_words(block, self.length_offset))
                if self._moves_in(block):
                    self._motion(block)
            case _:
                self._move_in_machine(block)

    def _take_length(self, code: int, block: Block) -> None:
        """Set the length offset to that of a tool in the table (G43), add it (G43.2), or cancel it (G49)."""
        number = whole(block.words.get("H", float(self.tool)))
        tool = None if number is None or code == _G49 else self.tools.get(number)
        x, y, z = self.length_offset if code == _G43_2 else ORIGIN
        self.set_length_offset((x, y, z + (tool.length_mm(self.unit) if tool else 0.0)))

    def _select_system(self, code: int, block: Block) -> None:
        """Select a work offset; one that the program did not set is taken as zero, and except for G54 reported."""
        if code not in self.origin.systems and code != G54:
            self.log.warn("OFFSET", f"The offset of G{code / 10:g} {TAKEN_AS_ZERO}", block.at("G", code))
        self.set_origin(replace(self.origin, system=code))

    def _reading_as_written(self, block: Block, rest: Point3, old: Point3) -> Point3:
        """Return the offset that makes the position read as written on the rest of the origin; old for other axes."""
        words = self.axis_words(block, ORIGIN)
        x, y, z = (
            self.position[axis] - words[axis] - rest[axis] if "XYZ"[axis] in block.words else old[axis]
            for axis in range(3)
        )
        return x, y, z

    def _set_data(self, block: Block) -> None:
        """Run G10: set a work offset, or a tool's data where the control has that; other data stop the run."""
        kind = whole(block.words.get("L", -1.0))
        if kind == 2 or (kind == 20 and self.dialect.tool_data_kinds):
            self._set_system(block, from_here=kind == 20)
        elif kind in self.dialect.tool_data_kinds:
            self._set_tool(block)
        else:
            settable = "work offsets: G10 L2 P1 to P6 with X, Y, Z"
            text = f"cutcomp sets only {settable}. {only_on(TOOL_DATA.get(kind or 0, ()))}".rstrip()
            self.log.stop("DATA", f"{text} Set other data on the control.", block.at("L"))

    def _set_system(self, block: Block, *, from_here: bool) -> None:
        """Run G10 L2 P: set a work offset; with L20, so that the current position reads as written."""
        number, most = whole(block.words.get("P", -1.0)), 9 if self.dialect.tool_data_kinds else 6
        if self.dialect.tool_data_kinds and block.words.get("R", 0.0):
            text = "cutcomp does not follow a work offset with a rotation R, and the path after it would be wrong."
            self.log.stop("BEYOND", text, block.at("R"))
        if number is None or not 0 <= number <= most or block.words.get("R", 0.0):
            text = f"A work offset is set by G10 L2 P1 to P{most} with X, Y, Z, without a rotation R."
            self.log.stop("DATA", text, block.at("R" if "R" in block.words else "PL"))
        code = system_code(number) if number else self.origin.system
        old = self.origin.systems.get(code, ORIGIN)
        offset = self._reading_as_written(block, self.origin.local, old) if from_here else self.axis_words(block, old)
        self.set_system(code, offset)

    def _set_tool(self, block: Block) -> None:
        """Run G10 L1 P R: set the radius of a tool in the table; its length has no effect in the plane."""
        number = whole(block.words.get("P", -1.0))
        tool = None if number is None else self.tools.get(number)
        if tool is None:
            self.log.stop("TOOL", missing_tool(number), block.at("PL"), tool=number)
        text = "Q, the orientation of a lathe tool, is a whole number from 0 to 9."
        orientation = whole_word(block, "Q", self.log, "DATA", text, 0, 9, default=tool.orientation)
        tool = replace(tool, orientation=orientation)
        if "R" in block.words:
            tool = replace(tool, diameter=2.0 * block.words["R"], unit=self.unit)
        self.tools = {**self.tools, tool.number: tool}

    def _home(self, block: Block) -> None:
        """Run G28 or G30: move by way of the block's point to the reference point, taken as machine zero."""
        self.log.warn("HOME", "The reference point is not known; cutcomp takes the machine's zero.", block.at("G"))
        named = [letter in block.words for letter in "XYZ"]
        if any(named):
            self._straight(block, self.target(block.words), rapid=True)
        elif self.dialect.moves_alone:
            self._straight(block, self.position, rapid=True)
        homed = named if any(named) else [True] * 3
        x, y, z = (0.0 if home else now for home, now in zip(homed, self.position, strict=True))
        self._straight(block, (x, y, z), rapid=True)

    def _dwell(self, block: Block) -> None:
        """Run G4: X in its block is a time, Y and Z do not belong there; nothing moves."""
        wrong = next((letter for letter in "YZ" if letter in block.words), None)
        if wrong is not None:
            text = f"{wrong} with G4 may or may not move the axis. Put it in its own block."
            self.log.stop("DWELL", text, block.at(wrong))
        if "X" in block.words:
            self.log.inform("DWELL", "cutcomp takes X with G4 as the time to wait; nothing moves.", block.at("X"))
        if self.control.active:
            self.control.block_without_motion(block)

    def _move_in_machine(self, block: Block) -> None:
        """Run G53: count this block from machine zero."""
        if self.mode not in _LINE_CODES or self.incremental:
            text = "G53 goes with G0 or G1 in absolute positions; write G90 G0 G53."
            self.log.stop("MOTION", text, block.at("G", _G53))
        self._straight(block, self.axis_words(block, self.position), rapid=self.mode == 0)
