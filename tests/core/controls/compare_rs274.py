"""Runs programs on LinuxCNC's own interpreter and here, and prints what agrees.

`python -m tests.core.controls.compare_rs274 [COUNT]` compares random compensated programs and the distribution's
samples, with `broken` before the count programs with slips in them, with `speed` the time for 100,000 blocks.
"""

from __future__ import annotations

import sys
import tempfile
import tracemalloc
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from statistics import median

from core.controls.registry import UnknownControl, run
from core.controls.report import Run
from core.controls.tools import ToolTable
from core.units import Unit
from tests.core.controls.programs import RADIUS, broken, long, program, turned_to_zx
from tests.core.controls.rs274 import Witnessed, difference, printed, table_text, witness
from tests.rs274 import process

DIAMETERS = {1: 2 * RADIUS}


def outcome(
    text: str, folder: Path, diameters: dict[int, float] = DIAMETERS, unit: Unit = Unit.MM
) -> tuple[str, str]:  # fmt: skip
    """How a program fares on both: a word for the table, and what differs."""
    theirs = witness(text, folder, diameters, unit)
    ours = run(text.encode(), "linuxcnc", ToolTable.diameters(diameters, unit))
    assert not isinstance(ours, UnknownControl)
    return _fared(ours, theirs)


def _fared(ours: Run, theirs: Witnessed) -> tuple[str, str]:
    if ours.stopped_at and theirs.refusal:
        apart = difference(printed(ours), theirs.moves)
        return ("moves before the refusal differ", apart) if apart else (f"both refuse: {theirs.refusal}", "")
    if ours.stopped_at or theirs.refusal:
        said = ours.findings[-1].text if ours.stopped_at else theirs.refusal
        return ("only we refuse" if ours.stopped_at else "only rs274 refuses"), said
    apart = difference(printed(ours), theirs.moves)
    return ("moves differ", apart) if apart else ("same moves", "")


def programs(count: int) -> Iterable[tuple[str, str]]:
    """Named programs: every tenth in the plane G18."""
    for seed in range(count):
        text = program(seed)
        yield f"seed {seed}", turned_to_zx(text) if seed % 10 == 9 else text


SAMPLES = Path("/usr/share/linuxcnc/ncfiles")
"""Where the Debian package puts LinuxCNC's own sample programs."""

COMPENSATED = {
    "comp.ngc": "",
    "comp-g1.ngc": "",
    "comp311.ngc": "",
    "comp311_2.ngc": "",
    "gmoccapy_2_tools_with_cutter_radius_compensation.ngc": "",
    "lathecomp.ngc": "",
    "mmount.ngc": "its numbers are parameters, which are not worked out here",
}
"""Its samples that use compensation, and why one cannot be followed."""

SAMPLE_TOOLS = {number: diameter for number, diameter in enumerate((0.25, 0.125, 0.5, 0.1, 0.2, 0.0, 0.1, 0.3), 1)}


def sample_outcome(name: str, folder: Path) -> tuple[str, str]:
    """How a sample of the distribution fares on both."""
    text = (SAMPLES / name).read_text(errors="replace")
    theirs = witness(text, folder, SAMPLE_TOOLS, Unit.IN)
    ours = run(text.encode(), "linuxcnc", ToolTable.diameters(SAMPLE_TOOLS, Unit.IN))
    assert not isinstance(ours, UnknownControl)
    return _fared(ours, theirs)


MODAL_TOOLS = {1: 0.5, 2: 0.25}


def compare_broken(count: int) -> int:
    """Programs with slips: who refuses what; every difference is printed."""
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(count):
            text = broken(seed)
            fared, apart = outcome(text, Path(folder), MODAL_TOOLS, Unit.IN)
            counts[fared.partition(":")[0]] += 1
            if apart:
                print(f"{text!r}: {fared}: {apart}")
    for fared, number in counts.most_common():
        print(f"{number:6d}  {fared}")
    return 0


def compare_speed(runs: int) -> int:
    """Processor seconds for 100,000 blocks under compensation, the median of some runs in turn; and memory."""
    text, ours, theirs = long(100_000), [], []
    tools = ToolTable.diameters({1: 1.0}, Unit.MM)
    with tempfile.TemporaryDirectory() as name:
        program, table = Path(name) / "long.ngc", Path(name) / "tools.tbl"
        program.write_text(text)
        table.write_text(table_text({1: 1.0}, Unit.MM))
        for _ in range(runs):
            theirs.append(_spent(RUSAGE_CHILDREN, lambda: process(program, table)))
            ours.append(_spent(RUSAGE_SELF, lambda: run(text.encode(), "linuxcnc", tools)))
    one, other = median(theirs), median(ours)
    print(f"rs274 {one:.2f} s, here {other:.2f} s: {other / one:.2f} times as long")
    for count in (50_000, 100_000, 200_000):
        print(f"{count:7d} blocks: {_most_memory(long(count).encode(), tools) / 1e6:.0f} MB")
    return 0


def _spent(who: int, work: Callable[[], object]) -> float:
    """Processor seconds that some work takes, the system's part included."""
    before = getrusage(who)
    work()
    after = getrusage(who)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _most_memory(text: bytes, tools: ToolTable) -> int:
    """Bytes that a run needs at most besides its text."""
    tracemalloc.start()
    run(text, "linuxcnc", tools)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


def main(arguments: list[str]) -> int:
    """Prints the table, and each program that fares differently."""
    what = arguments.pop(0) if arguments and not arguments[0].isdecimal() else ""
    if what:
        return {"broken": compare_broken, "speed": compare_speed}[what](int(arguments[0]) if arguments else 5)
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for name, text in programs(int(arguments[0]) if arguments else 400):
            fared, apart = outcome(text, Path(folder))
            counts[fared] += 1
            if apart:
                print(f"{name}: {fared}: {apart}")
        for name, why in COMPENSATED.items() if SAMPLES.is_dir() else ():
            print(f"{name}: {': '.join(part for part in (*sample_outcome(name, Path(folder)), why) if part)}")
    for fared, count in counts.most_common():
        print(f"{count:6d}  {fared}")
    return 0 if all(fared.startswith(("same moves", "both refuse")) for fared in counts) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
