"""Largest blend: the largest BLEND OFFSET whose arcs cut nothing but stock, on every pass of a block."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Final

from core.advice.block_paths import BlockPaths
from core.comp.compensate import blend_in, blend_out
from core.comp.compensated import CenterPath
from core.finding import Finding
from core.geometry.path import Path
from core.geometry.piece import Side
from core.progress import Progress, silent
from core.tolerance import GOUGE
from core.verify.judge import judge_prepared
from core.verify.surface import Surface

BLEND_CODES: Final = frozenset({"BLEND_GOUGES", "BLEND_LEAVES"})
"""Codes of the findings that a smaller BLEND OFFSET may mend."""

COARSE_TRIALS: Final = 16
"""Sizes, evenly spaced from the typed one down, that are tried before the bisection: an arc may gouge, a smaller one
fit, and a still smaller one gouge again."""


def with_largest_blend(
    findings: Sequence[Finding],
    paths: BlockPaths,
    side: Side,
    size: Callable[[int], float],
    typed: int,
    progress: Progress = silent,
) -> tuple[Finding, ...]:
    """Add to the findings on blend arcs the largest BLEND OFFSET that fits; none if no finding is about them.

    `size` gives the millimeters of so many steps of a form's last digit; `typed` are the steps of what is in force.
    `progress` may raise Stopped before each pass is judged; how far the search is, is not known.
    """
    if not any(finding.code in BLEND_CODES for finding in findings):
        return tuple(findings)
    largest = largest_blend(paths, side, size, typed, progress)
    if largest is None:
        return tuple(findings)
    fits = "the largest that fits here is {0}" if largest else "only 0 fits here"
    lengths = (largest,) if largest else ()
    return tuple(
        replace(each, text=f"{each.text.removesuffix('.')}: {fits}.", lengths=lengths)
        if each.code in BLEND_CODES
        else each
        for each in findings
    )


def largest_blend(
    paths: BlockPaths, side: Side, size: Callable[[int], float], typed: int, progress: Progress = silent
) -> float | None:
    """Return the largest BLEND OFFSET in millimeters up to `typed` steps that fits, 0 if only that does.

    It is judged like the posted paths, and one step more does not fit.  None if the path gouges even without blends:
    then another number is wrong.
    """
    surface = Surface.prepare(paths.surface, side)

    def fits(steps: int) -> bool:
        for cut in _passes(paths):
            progress(0.0)
            if not _cuts_only_stock(surface, *cut, size(steps)):
                return False
        return True

    too_large = typed + 1
    for share in range(COARSE_TRIALS, -1, -1):
        fitting = typed * share // COARSE_TRIALS
        if fitting == 0 or fits(fitting):
            break
        too_large = fitting
    while too_large - fitting > 1:
        middle = (fitting + too_large) // 2
        fitting, too_large = (middle, too_large) if fits(middle) else (fitting, middle)
    if fitting:
        return size(fitting)
    assert paths.verdict is not None
    alone = [loop.path for loop in paths.loops]
    gouges = judge_prepared(surface, paths.verdict.radius, alone, measures_uncut=False).gouges
    return None if gouges else size(0)


def _passes(paths: BlockPaths) -> Iterator[tuple[tuple[CenterPath, ...], float, float]]:
    """Yield each pass of a block: its loops, the radius at which it is judged, and the depth that it may cut there."""
    assert paths.verdict is not None
    yield paths.loops, paths.verdict.radius, 0.0
    for rough in paths.rough:
        yield rough.loops, rough.verdict.radius, rough.stock + GOUGE


def _cuts_only_stock(surface: Surface, loops: Sequence[CenterPath], radius: float, stock: float, blend: float) -> bool:
    """True if the blend arcs of this radius on these loops go no deeper than the stock."""
    arcs = [arc for loop in loops for arc in _arcs(loop, surface.side, blend) if len(arc)]
    if not arcs:
        return True
    verdict = judge_prepared(surface, radius, arcs, measures_uncut=False)
    deep = any(gouge.depth > stock for gouge in verdict.gouges)
    return verdict.judged and not deep and not verdict.wrong_side


def _arcs(loop: CenterPath, side: Side, blend: float) -> tuple[Path, Path]:
    # the last piece of a way out with a blend is its arc; those before it are the overlap
    overlap = loop.lead_out.part(0, len(loop.lead_out) - 1) if len(loop.lead_out) else loop.lead_out
    last = overlap if len(overlap) else loop.path
    return blend_in(loop.path, side, blend), blend_out(last, side, blend, 0.0, closed=False)
