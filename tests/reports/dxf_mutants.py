"""Damaged drawings: thousands of mutants of six DXF files, none of which may raise, last, or lose entities in silence.

`.venv/bin/python -m tests.reports.dxf_mutants [--count 10000] [--seed 1] [--damaged]`
"""

from __future__ import annotations

import argparse
import random
import traceback
from collections import Counter

from tests.core.importing.mutants import TIME_LIMIT, lost_in_silence, mutant, originals, outcome


def main() -> int:
    """Prints what became of the mutants; 1 where one raised, lasted or lost something."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--damaged", action="store_true", help="take what can be read of each")
    options = parser.parse_args()
    files = originals()
    whole = {name: outcome(data) for name, data in files.items()}
    codes: Counter[str] = Counter()
    faults, slowest = 0, 0.0
    for number in range(options.count):
        name = list(files)[number % len(files)]
        data = mutant(files[name], random.Random(f"{options.seed} {number}"))
        try:
            made = outcome(data, damaged=options.damaged)
        except Exception:  # noqa: BLE001  # what is looked for
            faults += 1
            print(f"{name} {number} raised:\n{traceback.format_exc(limit=-4)}")
            continue
        codes[f"{name}: {made.code or 'taken'}"] += 1
        slowest = max(slowest, made.seconds)
        if made.seconds > TIME_LIMIT or (not options.damaged and lost_in_silence(whole[name], made)):
            faults += 1
            print(f"{name} {number}: {made} of {whole[name].entities}")
    for what, count in sorted(codes.items()):
        print(f"{count:6} {what}")
    print(f"{options.count} mutants, slowest {slowest:.2f} s, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
