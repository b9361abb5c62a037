"""Engine: control path, verdict and best path of up to 100,000 segments, beside one another and beside their peers.

    .venv/bin/python -m tests.bench.engine [--most 10000]

Everything of a row takes its turn in the same rounds, and only ratios are printed: what one stage takes beside another,
how a stage grows when a contour has ten times the segments, and our times beside those of shapely, Clipper2 and
LinuxCNC's interpreter.  Processor time is measured, so that a busy machine changes little.  An exclamation mark stands
where a bar is passed; the bars for growth and memory hold from 10,000 segments on.
"""

from __future__ import annotations

import argparse
import tempfile
import time
import tracemalloc
from collections.abc import Callable, Hashable, Mapping
from functools import partial
from pathlib import Path as File
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from typing import Final, TypeVar

from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate
from core.verify.judge import judge
from tests.bench import peers
from tests.bench.families import FAMILIES, Work, gear

SIZES: Final = (100, 1_000, 10_000, 100_000)
STAGES: Final = ("control path", "verdict", "best path")

MOST_GROWTH: Final = 15.0
"""How many times longer a stage may take for ten times the segments."""
MOST_FOR_VERDICT: Final = 20.0
"""Control paths that a verdict may take, where there are 10,000 segments at most."""
MOST_BYTES: Final = 1024
"""Bytes a segment that a stage may need at its peak."""
MOST_OF_RS274: Final = 0.2
MOST_OF_BUFFER: Final = 1.5

LARGE: Final = 10_000

LEAST_SECONDS: Final = 0.005
"""A measurement repeats what is quicker until it has taken so long."""
SLOW_SECONDS: Final = 3.0
"""What is slower is measured once, and its memory not at all."""

Run = Callable[[], object]
Name = TypeVar("Name", bound=Hashable)


def main() -> None:
    """Print all tables."""
    parser = argparse.ArgumentParser("tests.bench.engine", description=__doc__)
    parser.add_argument("--most", type=int, default=SIZES[-1], help="largest number of segments (1000 is quick)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--family", nargs="+", default=[], metavar="NAME", help="these families only")
    options = parser.parse_args()
    sizes = [size for size in SIZES if size <= options.most][-2:]
    if not sizes:
        parser.error(f"--most is at least {SIZES[0]}")
    chosen = [family for family in FAMILIES if not options.family or family.__name__ in options.family]
    print(f"{'':28}{'for a control path':^22}{'growth for ten times the segments':^38}{'bytes a segment':^30}")
    print(f"{'family':<16}{'segments':>10}  {'verdict':>10}{'best path':>10}  ", end="")
    print("".join(f"{stage:>13}" for stage in STAGES), "".join(f"{stage:>13}" for stage in STAGES))
    for family in chosen:
        print_family(family, sizes, options.rounds)
    beside_peers(sizes, options.rounds)


def stages(work: Work) -> dict[str, Run]:
    """Control path with all its deletions, the verdict on it, and the best path."""
    path = compensate(work.contour, work.side, work.radius, work.lookahead, closed=work.closed).path
    return {
        "control path": partial(compensate, work.contour, work.side, work.radius, work.lookahead, closed=work.closed),
        "verdict": partial(judge, work.contour, work.side, work.radius, path),
        "best path": partial(best_path, work.contour, work.side, work.radius, closed=work.closed),
    }


def print_family(family: Callable[[int], Work], sizes: list[int], rounds: int) -> None:
    """A line for each size; the two sizes take turns, since minutes apart they would not see the same machine."""
    works = {size: family(size) for size in sizes}
    runs = {(size, stage): run for size in sizes for stage, run in stages(works[size]).items()}
    times = medians(runs, rounds)
    for row, size in enumerate(sizes):
        path = times[size, "control path"]
        verdict, best = times[size, "verdict"] / path, times[size, "best path"] / path
        words = marked(f"{verdict:.1f}", size <= LARGE and verdict > MOST_FOR_VERDICT, 10) + f"{best:>10.1f}  "
        for stage in STAGES:
            growth = times[size, stage] / times[sizes[row - 1], stage] if row else 0.0
            words += marked(f"{growth:.1f}" if row else "", size > LARGE and growth > MOST_GROWTH, 13)
        for stage in STAGES:
            needed = memory(works[size], runs[size, stage]) if times[size, stage] < SLOW_SECONDS else None
            words += marked(
                "slow" if needed is None else f"{needed:.0f}", size >= LARGE and (needed or 0.0) > MOST_BYTES, 13
            )
        print(f"{family.__name__:<16}{size:>10}  {words}", flush=True)


def marked(text: str, over: bool, width: int) -> str:
    """A cell of a table, with an exclamation mark where its bar is passed."""
    return f"{text}{'!' if over else ''}".rjust(width)


def timed(run: Run) -> float:
    """Seconds of one run, the mean of as many as fill LEAST_SECONDS."""
    runs, spent, began = 0, 0.0, processor_seconds()
    while spent < LEAST_SECONDS:
        run()
        runs, spent = runs + 1, processor_seconds() - began
    return spent / runs


def processor_seconds() -> float:
    """What this process and those it has waited for have spent."""
    children = getrusage(RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def medians(runs: Mapping[Name, Run], rounds: int) -> dict[Name, float]:
    """The median time of each, in rounds in which each takes its turn; what is slow runs once."""
    times: dict[Name, list[float]] = {name: [timed(run)] for name, run in runs.items()}
    for _ in range(rounds - 1):
        for name, run in runs.items():
            if times[name][0] < SLOW_SECONDS:
                times[name].append(timed(run))
    return {name: median(seconds) for name, seconds in times.items()}


def memory(work: Work, run: Run) -> float:
    """Peak of what is allocated by a stage, bytes a segment, by tracemalloc, which numpy reports to."""
    tracemalloc.start()
    run()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak / len(work.contour)


def beside_peers(sizes: list[int], rounds: int) -> None:
    """Our paths of the gear in parts of what the peers take; a peer is left out where its chords are too many."""
    work = gear(10)
    print(f"\nthe gear: our times divided by the peers'; peers offset chords within {peers.CHORD} mm of the arcs,")
    print(f"rs274 runs it at radius {work.accepted}, which it accepts, the others at {work.radius} with deletions")
    if not peers.CLIPPER:
        print("Clipper2 is not there: it comes with the extra `peers`")
    print(f"{'segments':>10}  {'stage':<14}" + "".join(f"{name:>14}" for name in peers.NAMES))
    for size in sizes:
        work = gear(size)
        with tempfile.TemporaryDirectory() as folder:
            others = peers.runs(work, File(folder))
            times = medians({**stages(work), **others}, rounds)
        for stage in ("control path", "best path"):
            cells = {name: times[stage] / times[name] for name in others}
            bars = {"rs274": MOST_OF_RS274} if stage == "control path" else {"buffer": MOST_OF_BUFFER}
            bars = bars if size >= LARGE else {}
            words = "".join(
                marked(f"{cells[name]:.2f}" if name in cells else "", cells.get(name, 0.0) > bars.get(name, 1e9), 14)
                for name in peers.NAMES
            )
            print(f"{size:>10}  {stage:<14}{words}", flush=True)


if __name__ == "__main__":
    main()
