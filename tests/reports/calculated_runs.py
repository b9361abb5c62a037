"""How far calculated runs reach: random contours solved and judged, and random runs against brute force.

    python -m tests.reports.calculated_runs [CONTOURS] [RUNS] [FIRST SEED]

Each contour has as many data as unknowns, chosen at random.  Those whose data do not determine it (singular) are left
out.  Of the others it counts which the steps solve, which a pick on the drawing solves (within a fifth of the contour's
size of the true joint), and whether the contour that it was made from is among the answers; every answer is walked by a
judge that shares no code with the solver.  The runs are searched for all answers by Newton's method from thousands of
starts, and both sets are compared.
"""

from __future__ import annotations

import argparse
import math
import random
import time
from collections import Counter
from typing import Any

from tests.core.program.run_files import every_chain, keeps_coordinate
from tests.random_runs import BruteForce, apart, random_case, walk

SINGULAR = 1e-5
"""Data whose smallest singular value is no more than this part of the largest do not determine a contour."""

MET = 1e-7
"""What an answer may miss a typed number by, in millimeters."""


def contours(count: int, first: int) -> Counter[str]:
    """What became of `count` random contours."""
    told: Counter[str] = Counter()
    for seed in range(first, first + count):
        case, truth = random_case(seed)
        if keeps_coordinate(case):
            told["a line keeps a coordinate"] += 1
        elif BruteForce(case).condition(truth) < SINGULAR:
            told["singular"] += 1
        else:
            told["determined"] += 1
            told[_outcome(seed, case, truth, told)] += 1
    return told


def _outcome(seed: int, case: dict[str, Any], truth: list[dict[str, Any]], told: Counter[str]) -> str:
    chains, waits = every_chain(case, _picks(seed, case, truth))
    told["answers"] += len(chains)
    for chain in chains:
        missed = walk(case, chain)
        if missed > MET:
            told["ANSWERS THAT MISS A NUMBER"] += 1
            print(f"seed {seed}: an answer misses a typed number by {missed:.3g}")
    if any(apart(chain, truth) < 1e-6 for chain in chains):
        return "solved with a pick" if waits else "solved by the steps"
    if not waits:
        print(f"seed {seed}: the original is not among {len(chains)} answers")
        return "ORIGINAL MISSING"
    return "another answer than the original with a pick" if chains else "not solved"


def _picks(seed: int, case: dict[str, Any], truth: list[dict[str, Any]]) -> dict[int, tuple[float, float]]:
    """A point near the true end of each segment."""
    pick = random.Random(seed)
    xs = [case["start"][0], *(piece["x_end"] for piece in truth)]
    ys = [case["start"][1], *(piece["y_end"] for piece in truth)]
    size = max(max(xs) - min(xs), max(ys) - min(ys))
    picks = {}
    for number, piece in enumerate(truth, 1):
        reach, turn = 0.2 * size * math.sqrt(pick.random()), pick.uniform(0.0, math.tau)
        picks[number] = (piece["x_end"] + reach * math.cos(turn), piece["y_end"] + reach * math.sin(turn))
    return picks


def against_brute_force(count: int, first: int) -> Counter[str]:
    """Whether as many random runs of two to four segments have the same answers by brute force."""
    told: Counter[str] = Counter()
    seed = first
    while told["runs"] < count:
        case, truth = random_case(seed, 2, 4)
        seed += 1
        if keeps_coordinate(case) or BruteForce(case).condition(truth) < SINGULAR:
            continue
        chains, waits = every_chain(case)
        if waits:
            continue
        told["runs"] += 1
        others = BruteForce(case).answers(2500)
        told["answers"] += len(chains)
        told["answers of brute force"] += len(others)
        ours = [chain for chain in chains if not any(apart(chain, other) < 1e-3 for other in others)]
        theirs = [other for other in others if not any(apart(chain, other) < 1e-3 for chain in chains)]
        told["answers that brute force lacks"] += len(ours)
        told["ANSWERS THAT WE LACK"] += len(theirs)
        told["runs with the same answers"] += not ours and not theirs
        if ours or theirs:
            print(f"seed {seed - 1}: {len(chains)} answers, {len(others)} by brute force")
    return told


def report(contour_count: int, run_count: int, first: int) -> None:
    """Print both counts."""
    begun = time.perf_counter()
    told = contours(contour_count, first)
    print(f"{contour_count} random contours from seed {first}, {time.perf_counter() - begun:.0f} s")
    for name, number in sorted(told.items()):
        share = f" ({number / told['determined']:.1%})" if "solved" in name or "original" in name.lower() else ""
        print(f"  {number:7} {name}{share}")
    begun = time.perf_counter()
    told = against_brute_force(run_count, first)
    print(f"{run_count} random runs against brute force, {time.perf_counter() - begun:.0f} s")
    for name, number in sorted(told.items()):
        print(f"  {number:7} {name}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("contours", type=int, nargs="?", default=10000)
    parser.add_argument("runs", type=int, nargs="?", default=300)
    parser.add_argument("first", type=int, nargs="?", default=0)
    options = parser.parse_args()
    report(options.contours, options.runs, options.first)
