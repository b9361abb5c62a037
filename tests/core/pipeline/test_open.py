"""A contour that does not come back to its START is told to be open."""

from __future__ import annotations

import pytest

from core.finding import Finding, Severity
from core.pipeline.derive import derive
from core.program.model import CutterComp
from tests.core.pipeline.parts import OUTSIDE_SQUARE, Points, block, program


def told(points: Points) -> list[Finding]:
    (found,) = derive(program(block(points, CutterComp.RIGHT))).blocks
    return [one for one in found.findings if one.code in ("OPEN", "NEARLY_CLOSED")]


@pytest.mark.parametrize(
    ("end", "code", "apart"),
    [((0, 0.05), "NEARLY_CLOSED", 1.27), ((0.3, 0.4), "NEARLY_CLOSED", 12.7), ((0, 0.6), "OPEN", 15.24)],
)
def test_the_gap_is_a_warning_where_it_is_no_wider_than_the_tool(end: tuple[float, float], code: str, apart: float):
    (one,) = told((*OUTSIDE_SQUARE[:-1], end))
    assert (one.code, one.segment) == (code, 4.0)
    assert one.value == pytest.approx(apart)
    assert one.at == pytest.approx((25.4 * end[0], 25.4 * end[1]))


def test_a_closed_contour_is_not_open() -> None:
    assert told(OUTSIDE_SQUARE) == []


def test_a_gap_with_which_it_counts_as_closed_is_told_since_the_path_gouges_beside_it() -> None:
    (found,) = derive(program(block((*OUTSIDE_SQUARE[:-1], (0, 0.0001)), CutterComp.RIGHT))).blocks
    assert found.solved.closed
    (one,) = (one for one in found.findings if one.code == "NEARLY_CLOSED")
    assert one.severity is Severity.WARNING
    assert "counts as closed, but it ends at" in one.text
    assert one.value == pytest.approx(0.00254)


def test_two_lines_enclose_nothing() -> None:
    assert told(((0, 0), (2, 0), (0.1, 0))) == []
