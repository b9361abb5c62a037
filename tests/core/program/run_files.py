"""Program files of runs given as plain data, and what becomes of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from core.pipeline.command_output import path_document
from core.pipeline.outline import outline
from core.program.file.read import loads
from core.program.model import Program
from core.program.solve.block import solve_block
from core.program.solve.solved import RunAnswer, SolvedBlock

Case = Mapping[str, Any]

HEAD = """format = 2
units = "{unit}"
[[tool]]
number = 1
diameter = 6.0
[[block]]
kind = "MILL CONTOUR"
cutter_comp = "ON"
tool = 1
x_start = {x!r}
y_start = {y!r}
z_start = 0.0
z_bottom = -5.0
plunge_feed = 100.0
speed = 1000
"""


def text_of(case: Case, choices: Mapping[int, int] | None = None, unit: str = "MM") -> str:
    """The program file of a case; `choices` are the picked solutions by segment number."""
    x, y = (float(number) for number in case["start"])
    lines = [HEAD.format(unit=unit, x=x, y=y)]
    for number, segment in enumerate(case["segments"], 1):
        lines.append("[[block.segment]]")
        lines += [f"{name} = {_written(name, value)}" for name, value in segment.items()]
        if choices and number in choices:
            lines.append(f"choice = {choices[number]}")
    return "\n".join(lines) + "\n"


def _written(name: str, value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    return repr(value) if name == "parallel" else repr(float(str(value)))


def program_of(case: Case, choices: Mapping[int, int] | None = None) -> Program:
    """The program of a case."""
    return loads(text_of(case, choices), "case.toml")


def solved(case: Case, choices: Mapping[int, int] | None = None) -> SolvedBlock:
    """The block of a case."""
    program = program_of(case, choices)
    return solve_block(program.blocks[0], program)


def document(case: Case, choices: Mapping[int, int] | None = None) -> dict[str, Any]:
    """What `path --json` says of the block."""
    blocks = path_document(outline(program_of(case, choices)))["blocks"]
    assert isinstance(blocks, list)
    block: dict[str, Any] = blocks[0]
    return block


def plain(answer: RunAnswer) -> list[dict[str, float]]:
    """An answer as plain data."""
    return [plain_piece(piece) for _, piece in answer.pieces]


def plain_piece(piece: Any) -> dict[str, float]:
    """A piece as plain data."""
    center = getattr(piece, "center", None)
    end = {"x_end": piece.end[0], "y_end": piece.end[1]}
    return end if center is None else end | {"x_center": center[0], "y_center": center[1]}


def codes(block: SolvedBlock) -> Sequence[str]:
    """The codes of the findings of the segments."""
    return [finding.code for segment in block.segments for finding in segment.findings]
