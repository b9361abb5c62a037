"""What is derived of an edited program is what is derived of it at once, to the last digit, whatever came before."""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin, tau

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from core.pipeline.derive import derive
from core.pipeline.derived import DerivedBlock
from core.program.model import Entry, Program, Segment
from core.units import Unit
from tests.core.program.parts import arc, blend, line, program

COUNT = 24
CORNERS = [(round(3.0 * cos(tau * k / COUNT), 4), round(3.0 * sin(tau * k / COUNT), 4)) for k in range(COUNT)]


def side(row: int, out: float = 1.0) -> Segment:
    x, y = CORNERS[(row + 1) % COUNT]
    if row % 4 == 1:
        return arc("CCW", x_end=out * x, y_end=out * y, radius=0.6, choice=0)
    return line(x_end=out * x, y_end=out * y)


def rounded(part: Program) -> Program:
    """With a blend at one corner."""
    (whole,) = part.blocks
    segments = whole.segments
    return replace(part, blocks=(replace(whole, segments=(*segments[:9], blend(0.05), *segments[9:])),))


def whole() -> Program:
    part = program(*(side(row) for row in range(COUNT)))
    (one,) = part.blocks
    x, y = CORNERS[0]
    return replace(part, blocks=(replace(one, x_start=Entry(x), y_start=Entry(y)),))


def edited(part: Program, row: int, out: float) -> Program:
    """The program with one segment's end farther out or in."""
    (one,) = part.blocks
    segments = list(one.segments)
    row %= len(segments)
    segments[row] = side(min(row, COUNT - 1), out)
    return replace(part, blocks=(replace(one, segments=tuple(segments)),))


def alike(found: DerivedBlock, fresh: DerivedBlock) -> bool:
    """Surface, chain, paths and deletions, what is told and the verdict's own numbers."""
    if found.findings != fresh.findings or (found.work is None) != (fresh.work is None):
        return False
    if found.work is None or fresh.work is None:
        return True
    paths = [(found.work.surface, fresh.work.surface)]
    paths += [(one.whole, other.whole) for one, other in zip(found.work.loops, fresh.work.loops, strict=True)]
    made, anew = found.work.compensated, fresh.work.compensated
    if made is not None and anew is not None:
        paths.append((made.raw, anew.raw))
        if list(made.deleted) != list(anew.deleted) or made.findings != anew.findings:
            return False
    names = ("points", "centers", "turns", "numbers")
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for a, b in paths for name in names)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.booleans(),
    st.lists(st.tuples(st.integers(0, COUNT), st.sampled_from((0.5, 0.97, 1.0, 1.01, 1.4))), min_size=1, max_size=5),
)
def test_edit_by_edit_is_as_at_once(blended: bool, edits: list[tuple[int, float]]) -> None:
    part = rounded(whole()) if blended else whole()
    found = derive(part)
    for row, out in edits:
        part = edited(part, row, out)
        found = derive(part, found)
        assert alike(found.blocks[0], derive(part).blocks[0])


def test_another_unit_leaves_nothing_of_the_one_before() -> None:
    part = whole()
    other = replace(part, unit=Unit.MM if part.unit is Unit.IN else Unit.IN)
    assert alike(derive(other, derive(part)).blocks[0], derive(other).blocks[0])
