"""The engine's times side by side with its peers', in one run: `python -m tests.bench.engine [--most 100000]`.

Medians of rounds in which everything of a row takes its turn.  Milliseconds.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
import tracemalloc
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path as File
from typing import Final

from core.comp.best_path.best_path import best_path
from core.comp.compensate import compensate
from core.pipeline.derive import derive
from core.pipeline.lookahead_table import look_ahead_table
from core.verify.judge import judge
from tests.bench import peers
from tests.bench.families import FAMILIES, Work, gear
from tests.bench.keys import gear as typed_gear
from tests.bench.pace import RS274_SECONDS, SEGMENTS, pace

LOOKAHEAD: Final = 8
SIZES: Final = (10, 100, 1_000, 10_000, 100_000)
OURS: Final = ("control path", "verdict", "best path")
LEAST_SECONDS: Final = 0.002
"""A measurement repeats what is quicker until it has taken so long."""


def timed(run: Callable[[], object]) -> float:
    """Milliseconds of one run, the mean of as many as fill LEAST_SECONDS."""
    runs, spent, began = 0, 0.0, time.perf_counter()
    while spent < LEAST_SECONDS:
        run()
        runs, spent = runs + 1, time.perf_counter() - began
    return 1000.0 * spent / runs


def once(run: Callable[[], object]) -> float:
    """Milliseconds of one run."""
    began = time.perf_counter()
    run()
    return 1000.0 * (time.perf_counter() - began)


def medians(runs: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """The median time of each, in rounds in which each takes its turn."""
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            times[name].append(timed(run))
    return {name: statistics.median(some) for name, some in times.items()}


def ours(work: Work) -> dict[str, Callable[[], object]]:
    """Control path, verdict on it, best path."""
    path = compensate(work.contour, work.side, work.radius, LOOKAHEAD, closed=work.closed).path
    return {
        "control path": control(work),
        "verdict": lambda: judge(work.contour, work.side, work.radius, path),
        "best path": best(work),
    }


def control(work: Work) -> Callable[[], object]:
    """The control's path at LOOKAHEAD with all its deletions."""
    return lambda: compensate(work.contour, work.side, work.radius, LOOKAHEAD, closed=work.closed)


def best(work: Work) -> Callable[[], object]:
    """The best path."""
    return lambda: best_path(work.contour, work.side, work.radius, closed=work.closed)


def bytes_a_segment(work: Work, run: Callable[[], object]) -> float:
    """Peak of what is allocated while a path is made, by tracemalloc, which numpy reports to."""
    run()
    tracemalloc.start()
    run()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak / len(work.contour)


def families(sizes: tuple[int, ...], rounds: int) -> dict[tuple[str, int], dict[str, float]]:
    """Every family at every size; prints as it goes."""
    found = {}
    print(f"{'family':<10}{'segments':>9}{'path':>10}{'verdict':>10}{'best':>10}   us/segment  verdict  best")
    for family in FAMILIES:
        for count in sizes:
            row = medians(ours(family(count)), rounds if count < 100_000 else 3)
            found[family.__name__, count] = row
            path, verdict, best = (row[name] for name in OURS)
            print(
                f"{family.__name__:<10}{count:>9}{path:>10.3f}{verdict:>10.3f}{best:>10.3f}"
                f"{1000 * path / count:>13.2f}{verdict / path:>8.1f}x{best / path:>5.1f}x",
                flush=True,
            )
    return found


def beside_peers(sizes: tuple[int, ...], rounds: int) -> dict[str, float]:
    """The gear, by us and by the peers; a peer is left out where its chords are too many.

    Returned are the times of the largest size.
    """
    print(f"\nthe gear at look-ahead {LOOKAHEAD}, milliseconds; in brackets how many times our control path")
    print(f"peers offset chords within {peers.CHORD} mm, at most {peers.MOST_CHORDS} of them;")
    print(
        f"rs274 runs it at radius {gear(10).accepted}, which it accepts, the others at {gear(10).radius} with deletions"
    )
    if not peers.CLIPPER:
        print("Clipper2 is not there: it comes with the extra `peers`")
    row: dict[str, float] = {}
    for count in sizes:
        work = gear(count)
        with tempfile.TemporaryDirectory() as folder:
            runs = {"control path": control(work), **_peers(work, File(folder))}
            row = medians(runs, rounds if count < 100_000 else 3)
        own = row["control path"]
        print(f"{count:>9}  " + "  ".join(f"{name} {value:.2f} ({value / own:.1f}x)" for name, value in row.items()))
    return row


def _peers(work: Work, folder: File) -> dict[str, Callable[[], object]]:
    points = peers.chords(work.contour)
    runs: dict[str, Callable[[], object]] = {}
    if len(points) <= peers.MOST_CHORDS:
        named = (("offset_curve", peers.offset_curve), ("buffer", peers.buffer), ("clipper2", peers.clipper))
        made = {name: peer(work, points) for name, peer in named}
        runs = {name: run for name, run in made.items() if run is not None}
    process = peers.interpreter(work, folder)
    return runs if process is None else {**runs, "rs274": accepted(process)}


def accepted(process: Callable[[], subprocess.CompletedProcess[str]]) -> Callable[[], object]:
    """The interpreter's run, which has to reach the program's end."""

    def run() -> object:
        done = process()
        assert "PROGRAM_END" in done.stdout, done.stderr
        return done

    return run


def small(rounds: int, slower: float | None) -> None:
    """What stands beside the form: the look-ahead table, and everything derived of a program of ten segments.

    `slower` is how many times slower this machine is than the one the bars were set on, None where nobody knows.
    """
    large, ten = typed_gear(200), typed_gear(12)
    ten = replace(ten, blocks=(replace(ten.blocks[0], segments=ten.blocks[0].segments[:10]),))
    (block,) = derive(large).blocks
    assert block.work is not None
    assert len(block.work.surface) == 200
    runs: dict[str, Callable[[], object]] = {
        "look-ahead table, 200 segments": lambda: look_ahead_table(block, large),
        "all derived, 200 segments": lambda: derive(large),
        "all derived, 10 segments": lambda: derive(ten),
    }
    print()
    if slower is not None:
        print(f"rs274 took {slower:.1f} times the {RS274_SECONDS} s of the machine the bars were set on")
    found = medians(runs, 4 * rounds)
    # by itself it finds its code and data where it has just left them
    found["all derived, 10 segments, again and again"] = statistics.median(
        once(lambda: derive(ten)) for _ in range(100)
    )
    for name, value in found.items():
        there = "" if slower is None else f", there {value / slower:.2f} ms"
        print(f"{name}: {value:.2f} ms{there}")


def slowness(row: Mapping[str, float], count: int) -> float | None:
    """How many times slower than there this machine is, by rs274's own time for the gear; None where it did not run."""
    if count != SEGMENTS or "rs274" not in row:
        return None
    return row["rs274"] / (1000.0 * RS274_SECONDS)


def ratios(found: Mapping[tuple[str, int], Mapping[str, float]], sizes: tuple[int, ...], rounds: int) -> None:
    """The families against one another, and growth from the second largest size to the largest, if there are two."""
    most = sizes[-1]
    times = {name: row["control path"] for (name, count), row in found.items() if count == most}
    middle = statistics.median(times.values())
    print(f"\nat {most} segments the median family takes {middle:.1f} ms")
    for name, value in times.items():
        print(f"{name:<10}{value / middle:>6.2f} x the median{grown(name, sizes, rounds)}")


def grown(name: str, sizes: tuple[int, ...], rounds: int) -> str:
    """How the time per segment of a family grows to the largest size; nothing if only one is measured.

    The two sizes take turns: minutes apart they would not see the same machine.
    """
    if len(sizes) < 2:
        return ""
    family = next(one for one in FAMILIES if one.__name__ == name)
    before, most = sizes[-2:]
    row = medians({str(count): control(family(count)) for count in (before, most)}, rounds)
    return f"   time per segment {row[str(most)] / row[str(before)] * before / most:.2f} x that at {before}"


def main(arguments: list[str]) -> None:
    """Print all tables."""
    parser = argparse.ArgumentParser(description="times of the engine and its peers")
    parser.add_argument("--most", type=int, default=SIZES[-1], help="the largest number of segments")
    parser.add_argument("--rounds", type=int, default=7)
    options = parser.parse_args(arguments)
    sizes = tuple(count for count in SIZES if count <= options.most)
    if not sizes:
        parser.error(f"--most is at least {SIZES[0]}")
    print(pace())
    found = families(sizes, options.rounds)
    ratios(found, sizes, options.rounds)
    print("\npeak above the input, bytes a segment (tracemalloc):")
    for name, path in (("control path", control), ("best path", best)):
        works = [(family.__name__, family(sizes[-1])) for family in FAMILIES]
        print(f"{name}: " + "  ".join(f"{family} {bytes_a_segment(work, path(work)):.0f}" for family, work in works))
    peers_at_most = beside_peers(sizes, options.rounds)
    small(options.rounds, slowness(peers_at_most, sizes[-1]))
    print(pace())


if __name__ == "__main__":
    main(sys.argv[1:])
