"""Motions as lines of NC text: G0 to G3 with the axes that change, F where it changes, I and J from the start."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Final

from core.geometry.piece import Arc, Turn
from core.output.grid import FINER, Bow, Grid, turn_word, written
from core.output.motion import Motion
from core.units import from_mm

FEED_DECIMALS: Final = 3


@dataclass(frozen=True, slots=True)
class Place:
    """Where the tool is, in millimeters, and the feed in force as text; an axis whose place is not known is None."""

    x: float | None = None
    y: float | None = None
    z: float | None = None
    feed: str = ""


@dataclass(frozen=True, slots=True)
class Written:
    """Lines of NC text and where the tool is after them."""

    lines: tuple[str, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class _Step:
    """One line to be: its G word, where it ends, and for an arc its I and J."""

    word: str
    target: Place
    center: str = ""


def nc_lines(motions: Iterable[Motion], place: Place, grid: Grid) -> Written:
    """The motions as text, begun at `place`.

    A rapid never moves Z together with X and Y: up comes before, down after.  What would be no move as written is
    left out.
    """
    texts: list[str] = []
    for motion in motions:
        for step in _steps(motion, place, grid):
            text = _line(step, place, grid)
            place = step.target if text else replace(step.target, feed=place.feed)
            texts += [text] if text else []
    return Written(tuple(texts), place)


def feed_text(feed: float, grid: Grid) -> str:
    """A feed in program units a minute, without needless zeros."""
    whole, _, decimal = f"{from_mm(feed, grid.unit):.{FEED_DECIMALS}f}".partition(".")
    return f"{whole}.{decimal.rstrip('0') or '0'}"


def _steps(motion: Motion, place: Place, grid: Grid) -> Iterator[_Step]:
    if motion.feed is None:
        return _rapid(motion, place)
    feed = feed_text(motion.feed, grid)
    if motion.turn is Turn.NONE:
        return iter((_Step("G1", Place(motion.x, motion.y, motion.z, feed)),))
    return _arc(motion, place, feed, grid)


def _rapid(motion: Motion, place: Place) -> Iterator[_Step]:
    """Up, across, down: whichever of them there is."""
    high = motion.z if place.z is None else max(motion.z, place.z)
    yield _Step("G0", replace(place, z=high))
    yield _Step("G0", Place(motion.x, motion.y, high, place.feed))
    yield _Step("G0", Place(motion.x, motion.y, motion.z, place.feed))


def _arc(motion: Motion, place: Place, feed: str, grid: Grid) -> Iterator[_Step]:
    assert place.x is not None
    assert place.y is not None
    assert place.z is not None
    arc = Arc((place.x, place.y), (motion.x, motion.y), motion.center, motion.turn)
    for part in written(arc, grid):
        z = motion.z if part.part == 1.0 else place.z + part.part * (motion.z - place.z)
        target = Place(*part.end, z, feed)
        if isinstance(part, Bow):
            i, j = (grid.text(steps, FINER) for steps in part.center)
            yield _Step(turn_word(motion.turn), target, f" I{i} J{j}")
        else:
            yield _Step("G1", target)


def _line(step: _Step, place: Place, grid: Grid) -> str:
    """The step as text, empty if nothing moves."""
    axes = "".join(
        _axis(name, old, new, grid, always=bool(step.center) and name != "Z")
        for name, old, new in (
            ("X", place.x, step.target.x),
            ("Y", place.y, step.target.y),
            ("Z", place.z, step.target.z),
        )
    )
    feed = f" F{step.target.feed}" if step.target.feed != place.feed else ""
    return f"{step.word}{axes}{step.center}{feed}" if axes else ""


def _axis(name: str, old: float | None, new: float | None, grid: Grid, *, always: bool) -> str:
    if new is None:
        return ""
    steps = grid.steps(new)
    moved = old is None or grid.steps(old) != steps
    return f" {name}{grid.text(steps)}" if moved or always else ""
