"""Where the parts of a screen stand, at every size."""

from __future__ import annotations

from dataclasses import fields
from itertools import combinations

import pytest

from app.painted.screens.page import Layout
from app.painted.screens.plan import Plan, plan
from app.painted.widgets.rows import Area


def areas(places: Plan) -> list[Area]:
    every = [getattr(places, part.name) for part in fields(Plan)]
    return [area for area in every if area.width > 0 and area.height > 0]


def overlap(one: Area, other: Area) -> bool:
    beside = one.x + one.width <= other.x or other.x + other.width <= one.x
    return not (beside or one.y + one.height <= other.y or other.y + other.height <= one.y)


@pytest.mark.parametrize("told", [0, 1, 4, 40])
@pytest.mark.parametrize("layout", Layout)
def test_no_parts_overlap_and_none_leaves_the_terminal(layout: Layout, told: int) -> None:
    for width in (1, 2, 19, 20, 40, 59, 60, 79, 80, 81, 109, 110, 132, 200):
        for height in (*range(1, 30), 43, 60):
            found = areas(plan(width, height, layout, told))
            assert not any(overlap(one, other) for one, other in combinations(found, 2))
            assert all(area.x >= 0 and area.x + area.width <= width for area in found)
            assert all(area.y >= 0 and area.y + area.height <= height for area in found)


def test_the_native_size() -> None:
    places = plan(80, 24, Layout.FORM)
    assert places.header == Area(0, 0, 59, 2)
    assert places.body == Area(0, 2, 59, 9)
    assert places.verdict == Area(0, 11, 59, 4)
    assert places.drawing == Area(0, 15, 59, 6)
    assert places.softkeys == Area(59, 0, 21, 21)
    assert places.prompt == Area(0, 21, 80, 2)
    assert places.status == Area(0, 23, 80, 1)
    assert places.notice.height == 0


def test_a_wide_terminal_has_the_drawing_beside_the_form_in_full_height() -> None:
    assert plan(132, 43, Layout.FORM).drawing == Area(59, 0, 52, 40)


def test_the_verdicts_findings_stand_on_the_same_line_on_form_and_table() -> None:
    # the form's first line is the strip, which the table itself replaces
    assert plan(80, 24, Layout.FORM).verdict.y + 1 == plan(80, 24, Layout.TABLE).verdict.y


@pytest.mark.parametrize(("width", "height"), [(79, 24), (80, 23), (20, 5), (1, 2)])
def test_a_terminal_that_is_too_small_is_told_so(width: int, height: int) -> None:
    assert plan(width, height, Layout.FORM).notice.height == 1


def test_a_tiny_terminal_still_has_a_line_for_the_field_and_one_for_the_prompt() -> None:
    assert plan(20, 5, Layout.FORM, 4).prompt.height == 4
    assert plan(20, 5, Layout.FORM, 9).prompt == Area(0, 0, 20, 5)
    assert plan(80, 24, Layout.FORM, 9) == plan(80, 24, Layout.FORM)
    places = plan(20, 5, Layout.FORM)
    assert places.body.height >= 1
    assert places.prompt.height == 1
