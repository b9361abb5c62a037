"""What a key costs in a run of 12 beside the same contour with all ends typed: `python -m tests.bench.run_keys`.

Twelve tangent arcs and lines are typed into the form both ways, in one process and in turn; the processor's time of a
digit counts until the screen is at rest, with all that the workers derive.
"""

from __future__ import annotations

import asyncio
import statistics
import sys
import time
from math import cos, pi, sin
from typing import Any

from core.program.model import Program
from tests.app.widget_pilot import operator
from tests.core.program.run_files import program_of, solved

COUNT = 12


def wave() -> dict[str, Any]:
    """Lines at 60 degrees up and down by turns, rounded by arcs of 5: two answers a joint are not among them."""
    segments: list[dict[str, Any]] = []
    for number in range(COUNT // 2):
        angle = 60.0 if number % 2 == 0 else 300.0
        tie = {} if number == 0 else {"tangent": True}
        segments.append({"kind": "LINE", "angle": angle, "length": 30.0, **tie})
        direction = "CW" if number % 2 == 0 else "CCW"
        segments.append({"kind": "ARC", "direction": direction, "radius": 5.0, "sweep": 120.0, "tangent": True})
    # the length of the first line follows from the end
    x, y = end_of(segments)
    del segments[0]["length"]
    del segments[-2]["length"]
    segments[-1] |= {"x_end": x, "y_end": y}
    return {"start": [0.0, 0.0], "segments": segments}


def end_of(segments: list[dict[str, Any]]) -> tuple[float, float]:
    """Where such a chain ends."""
    x = y = 0.0
    heading = pi / 3.0
    for segment in segments:
        if segment["kind"] == "LINE":
            x, y = x + segment["length"] * cos(heading), y + segment["length"] * sin(heading)
            continue
        turn = 1.0 if segment["direction"] == "CCW" else -1.0
        cx, cy = x - turn * 5.0 * sin(heading), y + turn * 5.0 * cos(heading)
        heading += turn * segment["sweep"] * pi / 180.0
        x, y = cx + turn * 5.0 * sin(heading), cy - turn * 5.0 * cos(heading)
    return x, y


def typed_out(case: dict[str, Any]) -> dict[str, Any]:
    """The same contour with nothing but ends and centers."""
    segments = []
    for segment, piece in zip(case["segments"], (each.piece for each in solved(case).segments), strict=True):
        assert piece is not None
        plain = {"kind": segment["kind"], "x_end": piece.end[0], "y_end": piece.end[1]}
        if segment["kind"] == "ARC":
            center = getattr(piece, "center")  # noqa: B009  # only arcs have one
            plain |= {"direction": segment["direction"], "x_center": center[0], "y_center": center[1]}
        segments.append(plain)
    return {"start": case["start"], "segments": segments}


async def digits(program: Program, keys: int) -> list[float]:
    """Processor's milliseconds of a digit in Y END of the last segment."""
    costs = []
    async with operator(program) as user:
        await user.press("ctrl+end", "tab", "tab", "tab", "end")
        for number in range(keys):
            await user.settle()
            begun = time.process_time()
            await user.press(str(number % 10))
            costs.append(1000.0 * (time.process_time() - begun))
            await user.press("backspace")
    return costs


def main() -> None:
    """Print both medians and their ratio."""
    rounds, keys = ([int(each) for each in sys.argv[1:]] + [4, 6][len(sys.argv) - 1 :])[:2]
    case = wave()
    run = solved(case).runs[0]
    assert (run.first, run.last, run.taken is not None) == (1, COUNT, True)
    programs = {"run of 12": program_of(case), "all ends typed": program_of(typed_out(case))}
    costs: dict[str, list[float]] = {name: [] for name in programs}
    for _ in range(rounds):
        for name, program in programs.items():
            costs[name] += asyncio.run(digits(program, keys))
    medians = {name: statistics.median(each) for name, each in costs.items()}
    for name, median in medians.items():
        print(f"{name:<16}{median:8.1f} ms a digit, median of {len(costs[name])}")
    print(f"ratio {medians['run of 12'] / medians['all ends typed']:.3f}")


if __name__ == "__main__":
    main()
