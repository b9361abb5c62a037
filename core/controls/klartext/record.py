"""The record of a Klartext run: the center's moves on a tape, and beside them what is programmed."""

from __future__ import annotations

from dataclasses import dataclass, field

from core.controls.control_run import Stretch
from core.controls.klartext.steps import Role, Step
from core.controls.moves import Point3, Tape, flat, solid
from core.geometry.piece import Point, Side


@dataclass(slots=True)
class Record:
    """Center moves on `tape`; `stretches` of them made under compensation, the open one's surface on `programmed`.

    `share` is the share of the tool's radius that is run with.
    """

    tape: Tape = field(default_factory=Tape)
    stretches: list[Stretch] = field(default_factory=list)
    programmed: Tape | None = None
    entry: Step | None = None
    first: int = 0
    leaving: int = 0
    led_out: bool = False
    share: float = 1.0

    def at(self, step: Step) -> Point3:
        """Where the center stands, in the coordinates of the step's plane."""
        return flat(self.tape.last, step.plane)

    def line(self, end: Point, height: float, step: Step, *, lead: bool = False) -> None:
        """A straight move at the step's feed, or at that of the block before it."""
        x, y, z = solid(end[0], end[1], height, step.plane)
        element = step.element
        rapid, feed = step.before if lead else (element.rapid, element.feed)
        self.tape.row((x, y, z), (x, y, z), 0, 0, feed, element.line, rapid=rapid)

    def arc(self, end: Point, height: float, center: Point, turn: int, step: Step, feed: float | None = None) -> None:
        """An arc in the step's plane, at the step's feed unless given."""
        stop, middle = solid(*end, height, step.plane), solid(*center, height, step.plane)
        element = step.element
        speed = element.feed if feed is None else feed
        self.tape.row(stop, middle, turn, step.plane, speed, element.line, rapid=element.rapid)

    def plain(self, step: Step, end: Point) -> None:
        """The step's element as programmed, but ending at `end`."""
        element = step.element
        if element.turn:
            self.arc(end, element.high, element.center, element.turn, step)
        else:
            self.line(end, element.high, step)

    def sink(self, step: Step) -> None:
        """The tool axis alone, where the center stands."""
        x, y, _ = self.at(step)
        self.line((x, y), step.element.high, step)

    def open(self, step: Step) -> None:
        """Compensation begins: the next moves are a stretch."""
        self.programmed, self.entry = Tape(self.tape.last), step
        self.first, self.leaving = len(self.tape) - 1, 0
        self.remember(step)

    def remember(self, step: Step) -> None:
        """Put the step's element on the tape of what is programmed."""
        if self.programmed is None:
            return
        element, plane = step.element, step.plane if step.element.turn else 0
        stop = solid(*element.end, element.high, step.plane)
        center = solid(*element.center, element.high, step.plane) if element.turn else stop
        rapid, feed, line = element.rapid, element.feed, element.line
        self.programmed.row(stop, center, element.turn, plane, feed, line, rapid=rapid)
        self.leaving = int(step.role in (Role.EXIT, Role.DEPARTURE))
        self.led_out = step.role is Role.DEPARTURE

    def close(self) -> None:
        """Compensation ends: keep the stretch, unless it is the path itself or only its entry."""
        entry, programmed = self.entry, self.programmed
        self.entry, self.programmed = None, None
        if entry is None or programmed is None or not entry.offset or len(self.tape) <= self.first + 1:
            return
        side = Side.LEFT if entry.offset > 0.0 else Side.RIGHT
        moves, last = programmed.moves(), len(self.tape)
        leads = (entry.role is Role.APPROACH, self.led_out)
        stretch = Stretch(
            side, abs(entry.offset) / self.share, entry.plane, moves, 1, self.leaving, self.first, last, *leads
        )
        self.stretches.append(stretch)
