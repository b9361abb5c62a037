"""Program files of runs given as plain data, and what becomes of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from core.pipeline.command_output import path_document
from core.pipeline.derived import solve_fields
from core.program.file.read import loads
from core.program.model import Program
from core.program.solve.block import solve_block
from core.program.solve.solved import RunAnswer, SolvedBlock, SolvedRun

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
    blocks = path_document(solve_fields(program_of(case, choices)))["blocks"]
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


def keeps_coordinate(case: Case) -> bool:
    """Whether a line has one end coordinate alone: it keeps the other one, which a random run does not mean."""
    alone = ({"x_end"}, {"y_end"}, {"x_end_inc"}, {"y_end_inc"})
    return any(each["kind"] == "LINE" and each.keys() - {"kind"} in alone for each in case["segments"])


Chain = list[dict[str, float]]


def every_chain(case: Case, picks: Mapping[int, tuple[float, float]] | None = None) -> tuple[list[Chain], bool]:
    """Every answer of a whole contour, and whether some way to pick leads to a run that the steps do not solve.

    All ways to pick one solution of each run, and of each segment with two.  Where the steps do not solve a run that
    begins at a segment in `picks`, the operator points there.
    """
    waits, chains = False, []
    waiting: list[tuple[Case, dict[int, int]]] = [(case, {})]
    while waiting:
        part, choices = waiting.pop()
        block = solved(part, choices)
        if block.fully_determined:
            chains.append([plain_segment(segment) for segment in document(part, choices)["segments"]])
            continue
        number, options = _open(block)
        waiting += [(part, {**choices, number: option}) for option in options]
        stuck = next((run for run in block.runs if run.code == "NOT_YET"), None)
        if not options and stuck is not None:
            waits = True
            waiting += [(pointed, choices) for pointed in _picked(part, stuck, picks or {}, choices)]
    return chains, waits


def _picked(
    case: Case, run: SolvedRun, picks: Mapping[int, tuple[float, float]], choices: dict[int, int]
) -> list[Case]:
    """The case with a pick on a run's first segment: the one given, and those at the answers to which it leads."""
    if run.first not in picks or "pick_x" in case["segments"][run.first - 1]:
        return []
    first = _pointed(case, run.first, picks[run.first])
    answers = next(other.answers for other in solved(first, choices).runs if other.first == run.first)
    return [_pointed(case, run.first, answer.pick) for answer in answers if answer.pick is not None]


def _pointed(case: Case, number: int, at: tuple[float, float]) -> Case:
    """The case with a pick on a segment."""
    segments = list(case["segments"])
    segments[number - 1] = {**segments[number - 1], "pick_x": at[0], "pick_y": at[1]}
    return {**case, "segments": segments}


def _open(block: SolvedBlock) -> tuple[int, list[int]]:
    """The first segment at which a solution is to be picked, and the solutions."""
    runs = [
        (run.first, [answer.choice for answer in run.answers if answer.choice is not None])
        for run in block.runs
        if run.taken is None
    ]
    alone = [(segment.number, list(range(len(segment.choices)))) for segment in block.segments if not segment.end]
    return min(((number, options) for number, options in (*runs, *alone) if len(options) > 1), default=(0, []))


def plain_segment(segment: Mapping[str, Any]) -> dict[str, float]:
    """A segment of `path --json` as plain data."""
    names = ("x_end", "y_end", "x_center", "y_center")
    return {name: segment[name]["value"] for name in names if name in segment}
