"""The best path of drawings with 3 to 7 decimals: `python -m tests.reports.rounded_contours [--count 1000] [--seed 0]`.

Each drawing must give the same number of closed loops at every rounding, clean in the judge's eyes.  Where moving the
wall by the rounding itself opens or closes a neck, the numbers may differ: such drawings are listed, no failure.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter

from tests.core.comp.rounded import DECIMALS, drawing, widest_end_gap


def differences(seed: int) -> list[tuple[str, int]]:
    """What is wrong with a drawing, or is a neck, and at how many decimals."""
    part = drawing(seed)
    best = {decimals: part.best(decimals) for decimals in DECIMALS}
    usual = Counter(len(path.loops) for path in best.values()).most_common(1)[0][0]
    trouble = []
    for decimals, path in best.items():
        if any(finding.code == "BEST_BROKEN" for finding in path.findings) or not all(path.closed):
            trouble.append(("open", decimals))
        if widest_end_gap(path) > 10.0**-decimals:
            trouble.append(("ends apart", decimals))
        if path.loops and part.gouges(decimals):
            trouble.append(("gouge", decimals))
        if len(path.loops) != usual:
            trouble.append(("neck" if part.is_neck(decimals) else "other loops", decimals))
    return trouble


def main(arguments: list[str]) -> int:
    """Print what every drawing gives and the counts; 1 if anything but necks differs."""
    parser = argparse.ArgumentParser(description="best paths of rounded drawings")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    counts: Counter[str] = Counter()
    for seed in range(options.seed, options.seed + options.count):
        trouble = differences(seed)
        counts.update({kind for kind, _ in trouble} or {"the same loops"})
        for kind, decimals in trouble:
            print(f"drawing {seed}, {decimals} decimals: {kind}", flush=True)
    print(f"{options.count} drawings, {len(DECIMALS)} roundings each: {dict(counts)}")
    return 1 if set(counts) - {"the same loops", "neck"} else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
