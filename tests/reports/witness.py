"""LinuxCNC's compensated paths of many contours: one program for all of them, run again behind each that is refused."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path as File

from core.geometry.piece import Arc, Line, Piece, Side, Turn
from tests.reports.parts import RADIUS, Part
from tests.rs274 import MOVE, process

HEAD = "G21 G17 G40 G49 G80 G90 G91.1 G94 F1000\nG0 X0 Y0 Z-1\n"


@dataclass(frozen=True)
class Witnessed:
    """LinuxCNC's path beside a contour, or the sentence with which it refused."""

    path: tuple[Piece, ...]
    refusal: str


def witnessed(parts: Sequence[Part], folder: File) -> list[Witnessed]:
    """What LinuxCNC makes of every part, in their order."""
    found: list[Witnessed] = []
    while len(found) < len(parts):
        text = HEAD + "".join(_blocks(part, row) for row, part in enumerate(parts[len(found) :])) + "M2\n"
        paths, refusal = _run(text, folder)
        found += [Witnessed(path, "") for path in paths[:-1]]
        found.append(Witnessed((), refusal) if refusal else Witnessed(paths[-1], ""))
    return found


def _blocks(part: Part, height: int) -> str:
    """The blocks of one contour at a height of its own: a tangent entry, the contour, G40, and up to Z-1."""
    (x, y), (dx, dy) = part.contour.points[0].tolist(), part.contour.part(0, 1).start_directions[0].tolist()
    lines = [
        f"G0 X{x - 3 * RADIUS * dx:.10f} Y{y - 3 * RADIUS * dy:.10f}",
        f"Z{height}",
        f"{'G41.1' if part.side is Side.LEFT else 'G42.1'} D{2 * RADIUS:.10f}",
        f"G1 X{x:.10f} Y{y:.10f}",
        *(_block(piece, rapid=number in part.rapid) for number, piece in enumerate(part.contour, 1)),
        "G40",
        "G0 Z-1",
    ]
    return "\n".join(lines) + "\n"


def _block(piece: Piece, *, rapid: bool) -> str:
    end = f"X{piece.end[0]:.10f} Y{piece.end[1]:.10f}"
    if isinstance(piece, Line):
        return f"{'G0' if rapid else 'G1'} {end}"
    i, j = piece.center[0] - piece.start[0], piece.center[1] - piece.start[1]
    return f"{'G3' if piece.turn > 0 else 'G2'} {end} I{i:.10f} J{j:.10f}"


def _run(text: str, folder: File) -> tuple[list[tuple[Piece, ...]], str]:
    """The paths of all contours that were begun, and the sentence with which the last of them was refused."""
    program, table = folder / "program.ngc", folder / "tool.tbl"
    program.write_text(text, encoding="ascii")
    table.write_text("T1 P1 D1 Z0\n")
    ended = process(program, table)
    said = [line for line in ended.stderr.splitlines() if line.strip() and line.strip() != "executing"]
    return _paths(MOVE.findall(ended.stdout)), said[0] if said else ""


def _paths(printed: Sequence[tuple[str, str]]) -> list[tuple[Piece, ...]]:
    """The pieces at every height: behind the plunge and the entry, which end where the contour's path begins."""
    heights: dict[int, list[tuple[str, list[float]]]] = {}
    for name, numbers in printed:
        values = [float(value) for value in numbers.split(",")]
        if name == "SET_FEED_RATE":
            continue
        height = round(values[5] if name == "ARC_FEED" else values[2])
        if height >= 0:
            heights.setdefault(height, []).append((name, values))
    return [_path(moves) for _, moves in sorted(heights.items())]


def _path(moves: list[tuple[str, list[float]]]) -> tuple[Piece, ...]:
    if len(moves) < 2:
        return ()
    at, found = (moves[1][1][0], moves[1][1][1]), list[Piece]()
    for name, values in moves[2:]:
        end = (values[0], values[1])
        if name == "ARC_FEED":
            found.append(Arc(at, end, (values[2], values[3]), Turn.CCW if values[4] > 0 else Turn.CW))
        elif end != at:
            found.append(Line(at, end))
        at = end
    return tuple(found)
