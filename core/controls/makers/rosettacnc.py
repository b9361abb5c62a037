"""RosettaCNC with its three entries: `nist` (the default), `easy` and `normal`.

nist: every move ends at once where it can; the first one along the tangent from its end to the tool where it stands.
Every inside corner is an error, also that between the first two moves.  easy: the first move waits for the second one
and ends square to its start; later inside corners are errors.  normal: inside corners are where the offsets meet; that
the rest follows LinuxCNC is an interpretation.
"""

from __future__ import annotations

from math import acos, atan2, cos, hypot, pi, sin
from typing import Final, NoReturn

from core.controls.compensation.corners import Element, fits, square_end, square_start, turning
from core.controls.compensation.follower import Follower
from core.controls.compensation.one_move_queue import LookAhead, Rules
from core.controls.control_run import Log, Run
from core.controls.control_tools import ToolTable
from core.controls.iso.dialect import Dialect, Do, codes
from core.controls.iso.parameters import Kept
from core.controls.iso.runner import execute
from core.controls.iso.words import Block
from core.controls.makers.rosettacnc_words import Switch
from core.finding import Severity
from core.geometry.piece import Point, Side
from core.units import Unit

DIALECT: Final = Dialect(
    "rosettacnc",
    codes(
        ("compensation", Do.SIDE, (411, 421)),
        ("system", Do.SYSTEM, (591, 592, 593)),
        ("path", Do.MODE, (610, 640)),
        ("spindle", Do.SPINDLE, (960, 970)),
        ("retract", Do.RETRACT, (980, 990)),
        ("scaling", Do.MODE, (500,)),
        ("rotation", Do.MODE, (690,)),
        ("once", Do.SHIFT, (520,)),
        ("once", Do.MACHINE, (530,)),
        ("once", Do.DATA, (100,)),
        ("scaling", Do.BEYOND, (510,)),
        ("rotation", Do.BEYOND, (680,)),
        ("once", Do.BEYOND, (650, 660)),
    ),
    Unit.MM,
    parameters=Kept.MACRO_B,
    cycle_rule="C8",
)

TANGENT: Final = 0.01
"""Radians under which a corner is none, by the text of NIST."""


class Normal(LookAhead):
    """The entry `normal`: LinuxCNC's queue, in all three planes."""

    rules = Rules("C8", "C7", "C6", "C8")
    always = True

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.switch = Switch(self)

    def watch(self, block: Block) -> None:
        """What is refused."""
        self.switch.watch(block)

    def begin(self, side: Side, block: Block) -> None:
        """G41 and its kin."""
        self.turn_on(self.switch.offset(side, block))
        text = "The entry follows LinuxCNC: square to its own move. That is an interpretation."
        self.log.tell(Severity.INFO, "ENTRY", text, block.line, block.side_column())


class Nist(Follower):
    """The entry `nist`: no look-ahead at all."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.watching = True
        self.switch = Switch(self)
        self.offset = 0.0
        self.before: Element | None = None
        self.first = True

    def watch(self, block: Block) -> None:
        """What is refused, a change of unit among it."""
        self.switch.watch(block)
        if self.active and not {200, 210}.isdisjoint(block.g):
            text = "The unit is not changed under compensation. That is an interpretation, by NIST's list."
            self.log.stop("C8", text, block.line, block.side_column())

    def begin(self, side: Side, block: Block) -> None:
        """G41 and its kin."""
        self.offset = self.switch.offset(side, block)
        self.active, self.first, self.before = True, True, None

    def finish(self, _: Block) -> None:
        """G40: no move; the next one starts where the tool is."""
        if self.active and self.offset and not self.first:
            self.leave(entry=1, exits=0)
        self.active = False

    def travel(self, element: Element) -> None:
        """One element, at once."""
        if self._leaving and element.turn:
            self._refuse_arc(element, "The first move after G40 has to be straight")
        if not self.active or not self.offset:
            super().travel(element)
        elif self.first:
            self.enter(element)
        elif element.moves:
            self._corner(element)
            self.follow(element)
        else:
            self.note(element)
            self.straight(element, self.here)

    def enter(self, element: Element) -> None:
        """The first move ends so that it runs along the tangent from its end to the tool where it stands."""
        (sx, sy), (px, py) = element.start, element.end
        length, radius = hypot(px - sx, py - sy), abs(self.offset)
        if element.turn:
            self._refuse_arc(element, "An arc as first move has to touch the tool where it stands; write a line")
        if length <= radius:
            self._too_short(element, length)
        self.start_span(element)
        self.note(element)
        angle = atan2(sy - py, sx - px) - acos(radius / length) * (1 if self.offset > 0.0 else -1)
        way = angle - (pi / 2 if self.offset > 0.0 else -pi / 2)
        self.before = element._replace(arriving=(cos(way), sin(way)))
        self.straight(element, (px + radius * cos(angle), py + radius * sin(angle)))
        self.first = False

    def start_span(self, element: Element) -> None:
        """The stretch of compensated moves begins."""
        self.open_span(Side.LEFT if self.offset > 0.0 else Side.RIGHT, self.offset, element)

    def _refuse_arc(self, element: Element, what: str) -> NoReturn:
        self.log.stop("C8", f"{what}. That is an interpretation, by the rules of NIST.", element.line, 1)

    def _too_short(self, element: Element, length: float) -> None:
        text = "The first move is {0} long and has to be longer than the radius {1}. That is an interpretation."
        self.log.stop("C8", text, element.line, 1, lengths=(length, abs(self.offset)))

    def _corner(self, element: Element) -> None:
        before = self.before
        if before is None:
            return
        angle = turning(before, element) * (1 if self.offset > 0.0 else -1)
        if TANGENT < angle < pi - TANGENT:
            text = "An inside corner is an error with this entry; round it in the program or use the normal entry."
            self.log.stop("C6", text, element.line, 1, at=element.start)
        if abs(angle) <= TANGENT:
            return
        start = square_start(element, self.offset)
        if element.rapid:
            self.straight(element, start, low=True)
        else:
            self.bend(element, start, element.start, -1 if self.offset > 0.0 else 1, element.low)

    def follow(self, element: Element) -> None:
        """A move on its offset, to its square end."""
        if not fits(element, self.offset):
            text = "The arc's radius {0} has to be larger than the cutter's {1}; use a smaller cutter."
            self.log.stop("C7", text, element.line, 1, lengths=(element.radius, abs(self.offset)))
        self.note(element)
        end = square_end(element, self.offset)
        if element.turn:
            self.arc(element, end, element.center)
        else:
            self.straight(element, end)
        self.before = element


class Easy(Nist):
    """The entry `easy`: the first move waits for the second one."""

    def __init__(self, log: Log) -> None:
        super().__init__(log)
        self.held: Element | None = None
        self.standing: list[Element] = []

    def enter(self, element: Element) -> None:
        """Holds the first move; with the second one it ends square to that one's start."""
        if self.held is None:
            if element.turn:
                self._refuse_arc(element, "The first move has to be straight")
            self.start_span(element)
            self.note(element)
            self.held = element
        elif not element.moves:
            self.note(element)
            self.standing.append(element)
        else:
            self._end_entry(square_start(element, self.offset))
            self.follow(element)

    def _end_entry(self, point: Point) -> None:
        held, standing = self.held, self.standing
        self.held, self.standing, self.first = None, [], False
        for one in (held, *standing):
            if one is not None:
                self.straight(one, point)

    def finish(self, block: Block) -> None:
        """G40; a first move that still waits ends square to itself."""
        self.close()
        super().finish(block)

    def close(self) -> None:
        """The end of the program."""
        if self.held is not None:
            self._end_entry(square_end(self.held, self.offset))


def run(text: bytes, variant: str, tools: ToolTable, unit: Unit | None = None) -> Run:
    """A program as RosettaCNC runs it with the entry `nist`, `easy` or `normal`."""
    followers: dict[str, type[Follower]] = {"nist": Nist, "easy": Easy, "normal": Normal}
    return execute(text, f"rosettacnc:{variant}", DIALECT.starting(unit), tools, Log(), followers[variant])
