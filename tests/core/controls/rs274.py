"""LinuxCNC's own interpreter as a witness: runs a program and reads the moves it prints."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

from core.controls.control_run import ControlRun
from core.controls.moves import Moves, Plane
from core.units import Unit
from tests.rs274 import process

DIGIT = 1.2e-4
"""Program units by which four printed decimals may be off."""

_CALL = re.compile(r"^\s*\d+\s+\S+\s+(\w+)\(([^)]*)\)")


@dataclass(frozen=True)
class Printed:
    """One move as printed: line or arc, its end (x, y, z), of an arc center and turn; the feed; millimeters.

    `digit` is how far the printed decimals may be off.
    """

    end: tuple[float, float, float]
    rapid: bool
    center: tuple[float, float] | None = None
    turn: int = 0
    feed: float = 0.0
    digit: float = 0.0


@dataclass(frozen=True)
class Witnessed:
    """The moves of a program and the sentence with which it was refused, empty if it ran."""

    moves: tuple[Printed, ...]
    refusal: str


def table_text(diameters: dict[int, float], unit: Unit) -> str:
    """A tool table as the interpreter reads it when it runs alone: in inches, whatever the program is in."""
    scale = 1.0 if unit is Unit.IN else 25.4
    return "".join(f"T{number} P{number} D{value / scale:.12f} Z0\n" for number, value in diameters.items())


def witness(program: str, folder: Path, diameters: dict[int, float], unit: Unit) -> Witnessed:
    """What the interpreter makes of a program."""
    text, table = folder / "program.ngc", folder / "tools.tbl"
    text.write_text(program)
    table.write_text(table_text(diameters, unit))
    return run_witness(text, table)


def run_witness(text: Path, table: Path) -> Witnessed:
    """What the interpreter makes of a program's file with the file of a tool table."""
    done = process(text, table)
    printed = done.stdout.splitlines()
    said = [line for line in done.stderr.splitlines() if line.strip() and line.strip() != "executing"]
    return Witnessed(tuple(_moves(printed)), said[0] if said else "")


@dataclass
class _Feeds:
    """The interpreter's feed: the rate in millimeters, whether it is per turn, and the turns per minute."""

    scale: float = 1.0
    rate: float = 0.0
    by_turn: bool = False
    speed: float = 0.0

    def hear(self, name: str, numbers: str) -> None:
        if name == "SET_FEED_RATE":
            self.rate = float(numbers) * self.scale
        elif name == "USE_LENGTH_UNITS":
            self.scale = 1.0 if numbers == "CANON_UNITS_MM" else 25.4
        elif name == "SET_FEED_MODE":
            self.by_turn = numbers.split(",")[1].strip() == "1"
        elif name == "SET_SPINDLE_SPEED":
            self.speed = float(numbers.split(",")[1])

    @property
    def feed(self) -> float:
        return self.rate * self.speed if self.by_turn else self.rate


def _moves(lines: list[str]):
    plane, origin, feeds = Plane.XY, (0.0, 0.0, 0.0), _Feeds()
    offsets = {"SET_G5X_OFFSET": origin, "SET_G92_OFFSET": origin}
    for line in lines:
        found = _CALL.match(line)
        if found is None:
            continue
        name, numbers = found[1], found[2]
        feeds.hear(name, numbers)
        if name == "SELECT_PLANE":
            plane = {"CANON_PLANE_XY": Plane.XY, "CANON_PLANE_XZ": Plane.ZX, "CANON_PLANE_YZ": Plane.YZ}[numbers]
        elif name in offsets:
            x, y, z = (float(number) * feeds.scale for number in numbers.split(",")[-6:-3])
            offsets[name] = (x, y, z)
            x, y, z = (sum(axis) for axis in zip(*offsets.values(), strict=True))
            origin = (x, y, z)
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            x, y, z = (float(number) * feeds.scale for number in numbers.split(",")[:3])
            rapid = name == "STRAIGHT_TRAVERSE"
            end = (x + origin[0], y + origin[1], z + origin[2])
            yield Printed(end, rapid, feed=0.0 if rapid else feeds.feed, digit=feeds.scale * DIGIT)
        elif name == "ARC_FEED":
            arc = _arc([float(number) for number in numbers.split(",")], plane, origin, feeds.scale)
            yield replace(arc, feed=feeds.feed, digit=feeds.scale * DIGIT)


def _arc(numbers: list[float], plane: Plane, origin: tuple[float, float, float], scale: float) -> Printed:
    turn = numbers[4]
    first, second, cx, cy, _, height = (number * scale for number in numbers[:6])
    axes = plane.axes
    end = [0.0, 0.0, 0.0]
    for axis, value in zip(axes, (first, second, height), strict=True):
        end[axis] = value + origin[axis]
    return Printed((end[0], end[1], end[2]), False, (cx + origin[axes[0]], cy + origin[axes[1]]), int(turn))


def printed(run: ControlRun) -> tuple[Printed, ...]:
    """A run's moves in the same form."""
    return tuple(_printed(run.moves))


def _printed(moves: Moves):
    for move in moves.part(1, len(moves)) if len(moves) > 1 else ():
        first, second, _ = move.plane.axes
        center = (move.center[first], move.center[second]) if move.turn else None
        yield Printed(move.point, move.rapid, center, move.turn, 0.0 if move.rapid else move.feed)


def difference(ours: tuple[Printed, ...], theirs: tuple[Printed, ...]) -> str:
    """The first difference between two lists of moves, empty if they are the same to the printed decimals."""
    for index, (one, other) in enumerate(zip(ours, theirs, strict=False)):
        pairs = [*zip(one.end, other.end, strict=True), *zip(one.center or (), other.center or (), strict=False)]
        apart = max(abs(first - second) for first, second in pairs)
        same_kind = one.turn == other.turn and one.rapid == other.rapid
        fed_alike = abs(one.feed - other.feed) <= 2e-3 + 1e-3 * abs(other.feed)
        if not same_kind or apart > other.digit or not fed_alike:
            return f"move {index}: {one} against {other}"
    if len(ours) != len(theirs):
        return f"{len(ours)} moves against {len(theirs)}"
    return ""
