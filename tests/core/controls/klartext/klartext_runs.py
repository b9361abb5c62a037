"""Running small Klartext programs and looking at what came out."""

from __future__ import annotations

from pathlib import Path

from core.controls.control_run import ControlRun
from core.controls.control_tools import ToolTable
from core.controls.klartext.control import run_klartext
from core.controls.moves import Move

DATA = Path(__file__).parents[3] / "data"
HEAD = "BEGIN PGM P MM\nTOOL DEF 1 L+0 R+{radius}\nTOOL CALL 1 Z S1000\n"
TOOLS: ToolTable = {}


def runs(*blocks: str, radius: float = 5.0, tools: ToolTable = TOOLS) -> ControlRun:
    """The blocks with a tool of this radius in the spindle; the first of them is line 4."""
    text = HEAD.format(radius=radius) + "".join(f"{block}\n" for block in blocks) + "END PGM P MM\n"
    return run_klartext(text.encode(), tools)


def clean(*blocks: str, radius: float = 5.0) -> ControlRun:
    """The same of a program that runs to its end with nothing to be said."""
    made = runs(*blocks, radius=radius)
    assert not made.findings, made.findings
    assert made.stopped_at is None
    return made


def flat(made: ControlRun, first: int = 2) -> list[tuple[float, ...]]:
    """The moves from a row on: x, y of a line; x, y, center x, y, turn of an arc."""
    return [_values(move) for move in list(made.moves)[first:]]


def _values(move: Move) -> tuple[float, ...]:
    x, y, _ = move.point
    return (x, y, *move.center[:2], move.turn) if move.turn else (x, y)


def points(made: ControlRun, first: int = 2) -> list[tuple[float, float, float]]:
    """The ends of the moves from a row on."""
    return [move.point for move in list(made.moves)[first:]]


def codes(made: ControlRun) -> list[tuple[str, int | None]]:
    """Rule and line of every finding."""
    return [(finding.code, finding.line) for finding in made.findings]
