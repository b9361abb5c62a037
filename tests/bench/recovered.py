"""Start with work to be recovered beside the empty start: `python -m tests.bench.recovered`.

A program of 1,000 segments was changed and not saved when its program died; the next start has to offer the work.
Both starts are made in turn, so that both see the same machine; their medians and the median ratio are printed.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
from pathlib import Path
from typing import Final

from app.documents.files import save
from tests.app.documents.typist import started
from tests.bench.keys import first_paint, gear
from tests.terminal import cutcomp

BOUND: Final = 1.5
"""How many times as long as the empty start the other may take."""


def left_behind(folder: Path, segments: int) -> Path:
    """A program's file, and beside it the journal of work that nobody has saved."""
    file = folder / "gear.toml"
    save(gear(segments), file)
    started(folder / "own", file).type(7).killed()
    return file


def main() -> int:
    """Print the medians and the ratio; exit status 1 above the bound."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--segments", type=int, default=1000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        file = left_behind(Path(name), options.segments)
        empty, ours = [], []
        for _ in range(options.rounds):
            empty.append(first_paint(cutcomp(str(file.with_name("new.toml"))), "MILL CONTOUR"))
            ours.append(first_paint(cutcomp(str(file)), "RESTORE"))
    ratio = statistics.median(one / other for one, other in zip(ours, empty, strict=True))
    print(
        f"empty start {1000 * statistics.median(empty):.0f} ms   with {options.segments} segments to recover "
        f"{1000 * statistics.median(ours):.0f} ms   {ratio:.2f}:1, bound {BOUND}"
    )
    return 0 if ratio < BOUND else 1


if __name__ == "__main__":
    sys.exit(main())
