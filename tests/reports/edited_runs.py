"""Whether a picked solution ever jumps: small edits upstream of random runs with several solutions.

    python -m tests.reports.edited_runs [RUNS] [EDITS] [FIRST SEED]

Each edit moves START by up to a hundredth of a millimeter.  A joint may move a hundred times as far; where it moves
farther, the answer has jumped, unless the run asks to pick again (PICK_SOLUTION).
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from math import dist, hypot
from typing import Any

from core.program.solve.solved import SolvedBlock
from tests.core.program.run_files import every_chain, keeps_coordinate, solved
from tests.random_runs import random_case


def edited(case: dict[str, Any], choices: dict[int, int], edits: int, pick: random.Random) -> Counter[str]:
    """What becomes of one picked solution."""
    told: Counter[str] = Counter()
    before = solved(case, choices)
    for _ in range(edits):
        step = (pick.uniform(-0.01, 0.01), pick.uniform(-0.01, 0.01))
        case = {**case, "start": [case["start"][0] + step[0], case["start"][1] + step[1]]}
        after = solved(case, choices)
        told["edits"] += 1
        if not after.fully_determined:
            told["asked again" if _asks(after) else "no answer any more"] += 1
            return told
        if _farthest(before, after) > 100.0 * hypot(*step) + 1e-9:
            told["JUMPED"] += 1
        before = after
    return told


def _asks(block: SolvedBlock) -> bool:
    return any(run.code == "PICK_SOLUTION" for run in block.runs)


def _farthest(first: SolvedBlock, second: SolvedBlock) -> float:
    """How far a joint moves at most."""
    pairs = zip(first.segments, second.segments, strict=True)
    return max(dist(a.end, b.end) for a, b in pairs if a.end is not None and b.end is not None)


def report(runs: int, edits: int, first: int) -> None:
    """Print what became of the solutions."""
    told: Counter[str] = Counter()
    seed = first
    while told["runs"] < runs:
        seed += 1
        case, _ = random_case(seed, 2, 4)
        block = solved(case)
        several = [run for run in block.runs if len(run.answers) > 1]
        if keeps_coordinate(case) or len(several) != 1 or every_chain(case)[1]:
            continue
        told["runs"] += 1
        for answer in several[0].answers:
            choices = {several[0].first: answer.choice or 0}
            if solved(case, choices).fully_determined:
                outcome = edited(case, choices, edits, random.Random(seed))
                told["picked solutions"] += 1
                told += outcome
                if outcome["JUMPED"]:
                    print(f"seed {seed}, choice {answer.choice}: jumped {outcome['JUMPED']} times")
    for name, number in sorted(told.items()):
        print(f"  {number:7} {name}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=int, nargs="?", default=50)
    parser.add_argument("edits", type=int, nargs="?", default=1000)
    parser.add_argument("first", type=int, nargs="?", default=0)
    options = parser.parse_args()
    report(options.runs, options.edits, options.first)
