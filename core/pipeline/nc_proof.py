"""Draws an NC program under proof: its run on a control, and the verdicts on its compensated stretches."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.controls.control_run import ControlRun, Stretch
from core.controls.judging.judged_contour import JudgedContour
from core.controls.moves import Moves, Plane
from core.draw.scene import Circle, Layer, Mark, Scene, Style, Symbol, contour_scene, joined_scenes
from core.geometry.path import Path, point_of_row
from core.geometry.path_parts import parts_between
from core.geometry.piece import Point


@dataclass(frozen=True, eq=False, slots=True)
class Proof:
    """A run and the verdicts on its compensated stretches; no verdicts until they are worked out."""

    run: ControlRun
    results: tuple[JudgedContour, ...]

    @property
    def plane(self) -> Plane:
        """The plane that is drawn: that of the first compensated stretch, XY if there is none."""
        return self.run.stretches[0].plane if self.run.stretches else Plane.XY


def fixed_scene(proof: Proof) -> Scene:
    """Return all that does not depend on the cursor: rapids, other moves, surfaces, center paths, gouges, uncut."""
    moves, plane = proof.run.moves, proof.plane
    feeds = ~moves.rapid
    for result in proof.results:
        # these are drawn as center paths
        feeds[result.stretch.first + 1 : result.stretch.last] &= result.stretch.plane is not plane
    layers = [Layer(path, Style.RAPID, dashed=True) for path in _parts(moves, plane, moves.rapid)]
    layers += [Layer(path, Style.LEAD) for path in _parts(moves, plane, feeds)]
    scenes = [_stretch_scene(result) for result in proof.results if result.stretch.plane is plane]
    return joined_scenes([Scene(tuple(layers), unit=proof.run.unit), *scenes])


def _parts(moves: Moves, plane: Plane, chosen: NDArray[np.bool_]) -> Iterator[Path]:
    """Yield the paths of consecutive chosen moves on the plane; row 0 is the start point."""
    return (run.path(plane) for run in moves.runs(chosen))


def _stretch_scene(result: JudgedContour) -> Scene:
    verdict, surface = result.verdict, result.surface
    return contour_scene(
        surface,
        path=result.center,
        gouges=[gouge.surface_at for gouge in verdict.gouges],
        uncut=parts_between(surface, verdict.uncut_ends),
    )


def scene_at_line(fixed: Scene, proof: Proof, line: int) -> Scene:
    """Add the moves of a line, and the cutter where they end, or where a line above left it."""
    moves, plane = proof.run.moves, proof.plane
    layers = [Layer(path, Style.CURRENT) for path in _parts(moves, plane, moves.lines == line)]
    at, row = cutter_at_line(proof, line)
    held = _stretch_at(proof, row)
    circles = () if held is None else (Circle(at, held.radius),)
    marks = (Mark(at, Style.CUTTER, Symbol.CENTER),)
    return Scene((*fixed.layers, *layers), circles, (*fixed.marks, *marks), fixed.unit)


def dotted_path(proof: Proof, plane: Plane) -> tuple[Layer, ...]:
    """Return the feed moves of a run on a plane, dotted, to lie under the scene of another control's run."""
    moves = proof.run.moves
    return tuple(Layer(path, Style.UNTAKEN, dashed=True) for path in _parts(moves, plane, ~moves.rapid))


def cutter_at_line(proof: Proof, line: int) -> tuple[Point, int]:
    """Return where the cutter is after a line, on the plane drawn, and the row of the move that brought it there.

    A line without moves leaves it where the last move of a line above it did.
    """
    moves = proof.run.moves
    rows = np.flatnonzero(moves.lines == line)
    if not len(rows):
        above = np.flatnonzero((moves.lines < line) & (moves.lines > 0))
        rows = above if len(above) else np.array([0])
    row = int(rows[-1])
    return point_of_row(moves.points[row, list(proof.plane.axes[:2])]), row


def _stretch_at(proof: Proof, row: int) -> Stretch | None:
    """Return the compensated stretch that a move belongs to, else the next one, else the last one."""
    later = [stretch for stretch in proof.run.stretches if row < stretch.last]
    return later[0] if later else proof.run.stretches[-1] if proof.run.stretches else None
