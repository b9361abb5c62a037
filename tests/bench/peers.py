"""Other programs that offset contours, on the same contour: shapely, Clipper2 and LinuxCNC's interpreter."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from math import acos
from pathlib import Path as File
from typing import Final

import numpy as np
import shapely

from core.geometry.path import Floats, Path
from core.geometry.piece import Arc, Side
from tests.bench.families import Work
from tests.rs274 import WITNESS, process

CHORD: Final = 1e-3
"""The largest distance in millimeters of a chord from its arc."""

CLIPPER: Final = find_spec("pyclipr") is not None
"""Whether Clipper2 is installed."""

MOST_CHORDS: Final = 2_000_000
"""Longer polygons are not given to the peers."""

NAMES: Final = ("rs274", "offset_curve", "buffer", "clipper2")


def runs(work: Work, folder: File) -> dict[str, Callable[[], object]]:
    """The peers that are installed and accept this many chords, each ready to run."""
    made: dict[str, Callable[[], object] | None] = {"rs274": _accepted(interpreter(work, folder))}
    points = chords(work.contour)
    if len(points) <= MOST_CHORDS:
        made |= {
            "offset_curve": offset_curve(work, points),
            "buffer": buffer(work, points),
            "clipper2": clipper(work, points),
        }
    return {name: run for name, run in made.items() if run is not None}


def _accepted(run: Callable[[], subprocess.CompletedProcess[str]] | None) -> Callable[[], object] | None:
    """The interpreter's run, which has to reach the program's end."""
    if run is None:
        return None

    def accepted() -> None:
        done = run()
        assert "PROGRAM_END" in done.stdout, done.stderr

    return accepted


def chords(path: Path) -> Floats:
    """(k, 2) points of a path whose arcs are chords within CHORD of them."""
    radii, sweeps = path.radii, np.abs(path.sweeps)
    angles = np.array([2.0 * acos(max(1.0 - CHORD / radius, -1.0)) if radius > 0.0 else 1.0 for radius in radii])
    counts = np.maximum(np.ceil(sweeps / angles), 1.0).astype(np.intp)
    piece = np.repeat(np.arange(len(path)), counts)
    share = (np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[piece]
    radial = (path.starts - path.centers)[piece]
    angle = share * path.sweeps[piece]
    turned = np.stack(
        (
            radial[:, 0] * np.cos(angle) - radial[:, 1] * np.sin(angle),
            radial[:, 0] * np.sin(angle) + radial[:, 1] * np.cos(angle),
        ),
        axis=1,
    )
    points = np.where(path.turns[piece, None] == 0, path.starts[piece], path.centers[piece] + turned)
    return np.concatenate((points, path.points[-1:]))


def offset_curve(work: Work, points: Floats) -> Callable[[], object]:
    """shapely's one-sided offset with round corners."""
    line, segments = shapely.LineString(points), _quadrants(work.radius)
    return lambda: line.offset_curve(work.side.sign * work.radius, quad_segs=segments, join_style="round")


def buffer(work: Work, points: Floats) -> Callable[[], object]:
    """shapely's buffer: of the polygon where the contour is closed, else of the line."""
    segments = _quadrants(work.radius)
    if not work.closed:
        line = shapely.LineString(points)
        return lambda: line.buffer(work.radius, quad_segs=segments)
    polygon = shapely.Polygon(points)
    outwards = (work.side is Side.RIGHT) is bool(shapely.is_ccw(polygon.exterior))
    return lambda: polygon.buffer(work.radius if outwards else -work.radius, quad_segs=segments)


def clipper(work: Work, points: Floats) -> Callable[[], object] | None:
    """Clipper2's offset of the closed polygon or of the open line, in whole units of 0.1 micrometer, if it is there."""
    if not CLIPPER:
        return None
    pyclipr, scale = import_module("pyclipr"), 1e4

    def run() -> object:
        offsetter = pyclipr.ClipperOffset()
        offsetter.scaleFactor = int(scale)
        offsetter.arcTolerance = CHORD * scale
        kind = pyclipr.EndType.Polygon if work.closed else pyclipr.EndType.Round
        offsetter.addPaths([points], pyclipr.JoinType.Round, kind)
        return offsetter.execute(-work.radius if work.closed and work.side is Side.LEFT else work.radius)

    return run


def _quadrants(radius: float) -> int:
    return max(int(np.ceil(np.pi / 2.0 / (2.0 * acos(max(1.0 - CHORD / radius, 0.0))))), 1)


def interpreter(work: Work, folder: File) -> Callable[[], subprocess.CompletedProcess[str]] | None:
    """The whole process of LinuxCNC's interpreter for the same contour, if it is installed."""
    if WITNESS is None:
        return None
    program, table = folder / "program.ngc", folder / "tool.tbl"
    program.write_text("\n".join(_program(work)) + "\n", encoding="ascii")
    table.write_text("T1 P1 D1 Z0\n")
    return lambda: process(program, table)


def _program(work: Work) -> list[str]:
    (x, y), (dx, dy) = work.contour.points[0].tolist(), work.contour.part(0, 1).start_directions[0].tolist()
    side = "G41.1" if work.side is Side.LEFT else "G42.1"
    lines = [
        "G21 G17 G40 G90 G91.1 G94 F1000",
        f"G0 X{x - 3 * work.accepted * dx:.8f} Y{y - 3 * work.accepted * dy:.8f}",
    ]
    lines += [f"{side} D{2 * work.accepted:.8f}", f"G1 X{x:.8f} Y{y:.8f}"]
    for piece in work.contour:
        end = f"X{piece.end[0]:.8f} Y{piece.end[1]:.8f}"
        if isinstance(piece, Arc):
            i, j = piece.center[0] - piece.start[0], piece.center[1] - piece.start[1]
            lines.append(f"{'G3' if piece.turn > 0 else 'G2'} {end} I{i:.8f} J{j:.8f}")
        else:
            lines.append(f"G1 {end}")
    return [*lines, "G40", f"G0 X{x:.8f}", "M2"]
