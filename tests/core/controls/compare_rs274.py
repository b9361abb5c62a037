"""Runs programs on LinuxCNC's own interpreter and here, and prints what agrees.

`python -m tests.core.controls.compare_rs274 [COUNT]` compares random compensated contours, programs of other kinds and
the distribution's samples, with `broken` before the count programs with slips in them, with `speed` the time and the
memory for 100,000 blocks.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import tracemalloc
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from statistics import median
from subprocess import DEVNULL

from core.controls.compensation.element_queue import ARC_RUN_AT_STOP
from core.controls.control_run import ControlRun
from core.controls.control_tools import ToolTable
from core.controls.registry import run
from core.units import Unit
from tests.core.controls.compensated_codes import CODES, FRAMES, PROGRAMS
from tests.core.controls.compensated_codes import EXPLAINED as EXPLAINED_CODES
from tests.core.controls.cycle_programs import drilled, timed
from tests.core.controls.distribution import COMPENSATED, LIBRARY, SAMPLES, TOOLS, called, sample
from tests.core.controls.macro_programs import SAME, generated, whole
from tests.core.controls.programs import (
    MODAL,
    RADIUS,
    broken,
    long,
    long_klartext,
    long_threeblock,
    program,
    stopped,
    turned_to_zx,
)
from tests.core.controls.rs274 import Witnessed, difference, printed, table_text, witness
from tests.rs274 import process
from tests.tool_tables import end_mills

DIAMETERS = {1: 2 * RADIUS}


def outcome(
    text: str, folder: Path, diameters: dict[int, float] = DIAMETERS, unit: Unit = Unit.MM
) -> tuple[str, str]:  # fmt: skip
    """How a program fares on both: a word for the table, and what differs."""
    theirs = witness(text, folder, diameters, unit)
    ours = run(text.encode(), "linuxcnc", end_mills(diameters, unit))
    return _fared(ours, theirs)


def _fared(ours: ControlRun, theirs: Witnessed) -> tuple[str, str]:
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


def sample_outcome(text: str, folder: Path) -> tuple[str, str]:
    """How a program of the distribution fares on both, with its tools."""
    return outcome(text, folder, TOOLS, Unit.IN)


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


LONG: dict[str, Callable[[int], str]] = {
    **dict.fromkeys(("linuxcnc", "rosettacnc:nist", "rosettacnc:easy", "rosettacnc:normal"), long),
    **dict.fromkeys(("nine-series:a", "nine-series:b-g39.1"), long),
    "threeblock": long_threeblock,
    "klartext": long_klartext,
}
"""The controls and the long program that each of them runs to its end: all the same but for the way of writing."""


def compare_speed(runs: int) -> int:
    """Processor seconds for 100,000 blocks under compensation, the median of some runs in turn; and memory."""
    theirs, silent = list[float](), list[float]()
    ours: dict[str, list[float]] = {name: [] for name in LONG}
    texts = {name: make(100_000).encode() for name, make in LONG.items()}
    tools = end_mills({1: 1.0}, Unit.MM)
    with tempfile.TemporaryDirectory() as name:
        program, table = Path(name) / "long.ngc", Path(name) / "tools.tbl"
        program.write_text(long(100_000))
        table.write_text(table_text({1: 1.0}, Unit.MM))
        for _ in range(runs):
            theirs.append(_spent(RUSAGE_CHILDREN, lambda: process(program, table)))
            silent.append(_spent(RUSAGE_CHILDREN, lambda: process(program, table, DEVNULL)))
            for control, spent in ours.items():
                spent.append(_spent(RUSAGE_SELF, partial(_whole, texts[control], control, tools)))
    pipe, nothing = median(theirs), median(silent)
    print(f"rs274 into a pipe {pipe:.2f} s, into nothing {nothing:.2f} s; here")
    for control, spent in ours.items():
        here = median(spent)
        print(f"{control:20} {here:.2f} s: {here / pipe:.2f} and {here / nothing:.2f} times as long")
    for count in (50_000, 100_000, 200_000):
        print(f"{count:7d} blocks: {_most_memory(long(count).encode(), tools) / 1e6:.0f} MB")
    return 0


def _whole(text: bytes, control: str, tools: ToolTable) -> None:
    """Runs a program, to its end."""
    made = run(text, control, tools)
    assert made.stopped_at is None, (control, made.findings[-1])


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


EXPLAINED = {
    "contour 955": "the interpreter's own entry arc ends 72 beside the line it should meet; here it is refused"
}
"""Programs that fare differently, and why that is right."""

KINDS: dict[str, tuple[int, Callable[[int], str]]] = {
    "parameters and O-words": (150, generated),
    "drilling cycles": (150, drilled),
    "feeds by time and by turn": (100, timed),
}
"""Generated programs besides the contours: how many, and what makes them."""


def _code_cases() -> Iterable[tuple[str, str, dict[int, float], Unit]]:
    """Every code around compensation, and programs of stops, tool data and shifts."""
    for frame, text in FRAMES.items():
        for code in (*CODES, *EXPLAINED_CODES):
            yield f"a code {frame}, {code}", text.format(code), MODAL_TOOLS, Unit.IN
    for name, body in PROGRAMS.items():
        yield f"written by hand, {name}", whole(body), MODAL_TOOLS, Unit.IN


def _cases(count: int) -> Iterable[tuple[str, str, dict[int, float], Unit]]:
    """Kind and number, text, tools and unit of each program."""
    for name, text in programs(count):
        yield f"contour {name.removeprefix('seed ')}", text, DIAMETERS, Unit.MM
    for seed in range(min(count, 150)):
        yield f"a stop under compensation {seed}", stopped(seed), DIAMETERS, Unit.MM
    for kind, (number, make) in KINDS.items():
        for seed in range(min(number, count)):
            text = make(seed)
            yield f"{kind} {seed}", text, MODAL_TOOLS, Unit.MM if "G21" in text else Unit.IN
    for name, body in (*MODAL.items(), *((name, whole(body)) for name, body in SAME.items())):
        yield f"written by hand, {name}", body, MODAL_TOOLS, Unit.IN
    yield from _code_cases()
    for name in LIBRARY if SAMPLES.is_dir() else ():
        yield f"the distribution's {name}", called(name), TOOLS, Unit.IN
    for name in COMPENSATED if SAMPLES.is_dir() else ():
        yield f"the distribution's {name}", sample(name), TOOLS, Unit.IN


def _explanation(name: str, apart: str) -> str:
    """Why a program runs differently; empty if the reason is unknown."""
    if apart == ARC_RUN_AT_STOP:
        return "the interpreter cuts into the corner after a stop, in a way that depends on what it ran before"
    of_code = EXPLAINED_CODES.get(name.rpartition(", ")[2], "")
    return EXPLAINED.get(name) or of_code or COMPENSATED.get(name.removeprefix("the distribution's "), "")


def main(arguments: list[str]) -> int:
    """Prints the table, and each program that fares differently."""
    parser = argparse.ArgumentParser("tests.core.controls.compare_rs274", description=__doc__)
    parser.add_argument("what", nargs="?", choices=("alike", "broken", "speed"), default="alike")
    parser.add_argument("count", type=int, nargs="?", help="contours (1000), programs with slips (5), or runs (5)")
    options = parser.parse_args(["alike", *arguments] if arguments and arguments[0].isdecimal() else arguments)
    if options.what != "alike":
        return {"broken": compare_broken, "speed": compare_speed}[options.what](options.count or 5)
    counts: Counter[str] = Counter()
    left = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, text, tools, unit in _cases(options.count or 1000):
            fared, apart = outcome(text, Path(folder), tools, unit)
            counts[fared] += 1
            if apart:
                why = _explanation(name, apart)
                print(f"{name}: {fared}: {why or apart}")
                left += not why
    for fared, count in counts.most_common():
        print(f"{count:6d}  {fared}")
    print(f"{counts.total():6d}  programs; differences that are not explained: {left}")
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
