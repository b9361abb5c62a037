"""Our center paths beside LinuxCNC's own, over many contours: `python -m tests.reports.linuxcnc [--count 1000]`.

Every contour is compensated by LinuxCNC's interpreter, by us at look-ahead 1 and at one larger than the contour, and
by the best path.  A difference is a stretch of path; each is put down to a named rule whose predicate holds there.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path as File

from core.comp.best_path.best_path import BestPath, best_path
from core.comp.compensate import compensate_all
from core.geometry.path import EMPTY, Path
from core.verify.judge import judge
from tests.reports.linuxcnc_contours import RADIUS, Part, part
from tests.reports.linuxcnc_differences import (
    Case,
    Difference,
    Rule,
    Witnessed,
    best_rule_of,
    differences,
    rule_of,
    witnessed,
)

BATCH = 50
FAR = 99
"""A look-ahead larger than any of the contours."""

ONE, MANY, BEST = "look-ahead 1", "look-ahead over all", "best path"


@dataclass
class Report:
    """Counts: contours drawn, refusals by sentence and by whether our path is clean, and paths equal or not by rule."""

    drawn: int = 0
    accepted: int = 0
    refused: Counter[tuple[str, bool]] = field(default_factory=Counter)
    equal: Counter[str] = field(default_factory=Counter)
    rules: Counter[tuple[str, Rule]] = field(default_factory=Counter)
    unexplained: list[str] = field(default_factory=list)


def report(accepted: int, folder: File) -> Report:
    """Draw contours until LinuxCNC has accepted so many of them."""
    found = Report()
    for one, theirs in _pairs(folder):
        found.drawn += 1
        if theirs.refusal:
            found.refused[theirs.refusal, _clean_here(one)] += 1
            continue
        found.accepted += 1
        _compare(found, one, theirs)
        if found.accepted == accepted:
            return found
    raise AssertionError("the contours never end")


def _pairs(folder: File) -> Iterator[tuple[Part, Witnessed]]:
    for first in count(0, BATCH):
        parts = [part(seed) for seed in range(first, first + BATCH)]
        yield from zip(parts, witnessed(parts, folder), strict=True)


def _clean_here(one: Part) -> bool:
    """Whether our path of a contour that LinuxCNC refuses gouges nothing."""
    (done,) = compensate_all(one.contour, one.side, RADIUS, (FAR,), closed=one.closed)
    return len(done.path) > 0 and judge(one.contour, one.side, RADIUS, done.path).clean


def _compare(found: Report, one: Part, theirs: Witnessed) -> None:
    best = best_path(one.contour, one.side, RADIUS, closed=one.closed)
    near, far = compensate_all(one.contour, one.side, RADIUS, (1, FAR), closed=one.closed)
    _count(found, ONE, Case(one, theirs, near, best), near.path, rule_of)
    _count(found, MANY, Case(one, theirs, far, best), far.path, rule_of)
    _count(found, BEST, Case(one, theirs, far, best), _longest(best), best_rule_of)


def _longest(best: BestPath) -> Path:
    return max(best.loops, key=lambda loop: float(loop.lengths.sum()), default=EMPTY)


def _count(found: Report, which: str, case: Case, path: Path, name: Callable[[Case, Difference], Rule]) -> None:
    """Count a path as equal, or once under every rule that its differences fall under."""
    rules = {name(case, one) for one in differences(path, case.theirs.path)}
    found.equal[which] += not rules
    for rule in rules:
        found.rules[which, rule] += 1
    if Rule.UNEXPLAINED in rules:
        found.unexplained.append(f"{which}: {case.part.name}")


def printed(found: Report) -> Iterator[str]:
    """The report as lines of text."""
    yield f"{found.drawn} contours drawn, {found.accepted} accepted by LinuxCNC"
    for (sentence, clean), number in found.refused.most_common():
        yield f"{number:6d}  refused, {'clean here' if clean else 'not clean here either'}: {sentence}"
    for which in (ONE, MANY, BEST):
        yield f"{found.equal[which]:6d}  equal: {which}"
        for rule in Rule:
            if found.rules[which, rule]:
                yield f"{found.rules[which, rule]:6d}    different: {rule}"
    yield f"unexplained: {len(found.unexplained)}"
    yield from found.unexplained


def main(arguments: list[str]) -> int:
    """Print the report; 1 if a difference has no name."""
    parser = argparse.ArgumentParser(description="compare our center paths with LinuxCNC's")
    parser.add_argument("--count", type=int, default=1000, help="so many accepted contours")
    with tempfile.TemporaryDirectory() as folder:
        found = report(parser.parse_args(arguments).count, File(folder))
    print("\n".join(printed(found)))
    return 1 if found.unexplained else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
